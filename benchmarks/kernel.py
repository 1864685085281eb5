"""How long a tick of a slider takes in the kernel."""

import ast
import json
import statistics
import time
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from execution import QUIET
from findings import Finding, judge_ticks, percentile_95, say
from jupyter_client.manager import start_new_kernel

SWEEPS = {"angle": range(20, 221), "rate": range(500, 5001, 50), "stroke": range(5, 101)}
ROUNDS = 4
TICKS = 200
THIN = 16  # interact is slow: in each round it makes every 16th tick of a sweep, and other ones
SETUP = f"""
%matplotlib inline
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
from kernel import time_explorers_as_json, time_ticks_as_json
"""


def measure_ticks() -> list[Finding]:
    """Time the explorer's ticks and those of `interact`, by turns in one kernel."""
    times = json.loads(run_in_kernel(SETUP, "time_ticks_as_json()"))
    return judge_ticks("slider tick in the kernel", times["own"], times["rival"], 33, 10)


def measure_explorers() -> list[Finding]:
    """Move every control of the other explorers over its range, in one kernel."""
    times = json.loads(run_in_kernel(SETUP, "time_explorers_as_json()"))
    for name, own in times.items():
        say(f"{name}: median {statistics.median(own):.1f} ms of {len(own)} ticks")
    return [
        Finding(f"tick of {name}: 95th percentile", percentile_95(own), 33, "ms")
        for name, own in times.items()
    ]


def run_in_kernel(code: str, expression: str) -> str:
    """Run code in a fresh kernel and return the text that an expression gives there."""
    manager, client = start_new_kernel(extra_arguments=[QUIET])
    try:
        reply = client.execute_interactive(
            code, user_expressions={"value": expression}, output_hook=lambda _: None
        )["content"]
    finally:
        client.stop_channels()
        manager.shutdown_kernel()
    answer = reply.get("user_expressions", {}).get("value", reply)
    if answer["status"] != "ok":
        raise RuntimeError("\n".join(answer["traceback"]))
    return str(ast.literal_eval(answer["data"]["text/plain"]))


def time_ticks_as_json() -> str:
    """Move the sliders of both figures over their ranges, as a hand would; runs in the kernel."""
    from rival import interact_with

    from cammotion.machine.kinematics import Move
    from cammotion.views.explorers.move import B_m, N, explore_move, h_m

    die = Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    figure, symbols = explore_move(die), {"angle": B_m, "rate": N, "stroke": h_m}
    *sliders, _ = interact_with(die).widget.children
    rivals = {slider.description: slider for slider in sliders}
    times: dict[str, list[float]] = {"own": [], "rival": []}
    for number in range(ROUNDS):
        for name, values in SWEEPS.items():
            times["own"] += sweep_figure(figure, symbols[name], values)
            times["rival"] += sweep(rivals[name], values[number * THIN // ROUNDS :: THIN])
    return json.dumps(times)


def time_explorers_as_json() -> str:
    """Move the controls of the other explorers over their ranges; runs in the kernel."""
    import cammotion as cm

    mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
    down, up = cm.rise(50, over_deg=55), cm.return_(50, over_deg=55)
    die = cm.motion("die", down, cm.dwell(100), up, cm.dwell(150), start_deg=150)
    diagram = cm.TimingDiagram([mill, die], rate_per_hour=2000)
    rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
    explorers = {
        "explore_shares": cm.explore_shares(diagram),
        "explore_overlap": cm.explore_overlap(diagram, rule, contact_mm=20),
        "explore_scca": cm.explore_scca(),
    }
    times: dict[str, list[float]] = {name: [] for name in explorers}
    for name, figure in explorers.items():
        for symbol, control in zip(figure.values, figure.description["controls"], strict=True):
            low, high = control["low"], control["high"]
            values = [low + (high - low) * n / TICKS for n in range(TICKS)]
            times[name] += sweep_figure(figure, symbol, values)
    return json.dumps(times)


def sweep_figure(figure: Any, symbol: Any, values: Iterable[float]) -> list[float]:
    """Set a control of a live figure and let it say its sentences, as a script does: in ms."""
    before, times = figure.values, []
    for value in values:
        started = time.perf_counter()
        figure.values = {symbol: value}
        figure.text.splitlines()
        times.append((time.perf_counter() - started) * 1000)
    figure.values = before
    return times


def sweep(control: Any, values: Iterable[float]) -> list[float]:
    """Set one value after the other and return the time of each in ms; then set things back."""
    default, times = control.value, []
    for value in values:
        started = time.perf_counter()
        control.value = value
        times.append((time.perf_counter() - started) * 1000)
    control.value = default
    return times
