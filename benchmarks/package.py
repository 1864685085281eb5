"""What the package and its commands cost."""

import json
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

from execution import execute, make_notebook, read_notebook
from findings import Finding, ratio_of_medians, say

ROOT = Path(__file__).parent.parent
LESSON = ROOT / "notebooks" / "02_maximum_acceleration.ipynb"
WORK = "work-benchmark"
MOST_TEST_S = 480
HEAVY = {"sympy", "matplotlib"}
SAME_IMPORTS = """
import ipywidgets, matplotlib.pyplot, numpy, sympy
import cammotion.views.live.explore, cammotion.views.plots
"""


def time_by_turns(
    one: Callable[[], object], other: Callable[[], object], rounds: int
) -> tuple[list[float], list[float]]:
    """Call two things by turns and return their times in s."""
    times: tuple[list[float], list[float]] = ([], [])
    for _ in range(rounds):
        for call, spent in zip((one, other), times, strict=True):
            spent.append(seconds_of(call))
    return times


def seconds_of(call: Callable[[], object]) -> float:
    """Return how long a call takes."""
    started = time.perf_counter()
    call()
    return time.perf_counter() - started


def run_python(code: str) -> str:
    """Run code in a fresh Python and return what it prints."""
    return subprocess.run(
        [sys.executable, "-c", code], check=True, capture_output=True, text=True
    ).stdout


def measure_import() -> list[Finding]:
    """Import the package, and NumPy, in fresh processes."""
    own, yardstick = time_by_turns(
        lambda: run_python("import cammotion"), lambda: run_python("import numpy"), rounds=15
    )
    loaded = json.loads(
        run_python("import cammotion, json, sys; print(json.dumps([*sys.modules]))")
    )
    return [
        Finding("import cammotion : import numpy", ratio_of_medians(own, yardstick), 1.2, "x"),
        Finding("of SymPy and Matplotlib, loaded by it", len(HEAVY & {*loaded}), 0, ""),
    ]


def measure_lesson() -> list[Finding]:
    """Execute notebook 02 in a new kernel, and one that only imports the same packages."""
    lesson, imports = read_notebook(LESSON), make_notebook(SAME_IMPORTS)
    own, floor = time_by_turns(lambda: execute(lesson), lambda: execute(imports), rounds=3)
    say(f"medians: {median(own):.2f} s and {median(floor):.2f} s")
    return [Finding("notebook 02 : its imports alone", ratio_of_medians(own, floor), 2, "x")]


def measure_setup() -> list[Finding]:
    """Set up again where everything is in place."""
    command = ["setup", "--work", WORK]
    try:
        run_workbook(*command)
        again = median(seconds_of(lambda: run_workbook(*command)) for _ in range(5))
    finally:
        shutil.rmtree(ROOT / WORK, ignore_errors=True)
    return [Finding("workbook.py setup, the second time", again, 2, "s")]


def measure_test() -> list[Finding]:
    """Run the whole test command."""
    return [Finding("workbook.py test", seconds_of(lambda: run_workbook("test")), MOST_TEST_S, "s")]


def run_workbook(*arguments: str) -> None:
    """Run workbook.py, with what it says beside the table."""
    subprocess.run(
        [sys.executable, ROOT / "workbook.py", *arguments], check=True, stdout=sys.stderr
    )
