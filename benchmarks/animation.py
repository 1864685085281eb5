"""How soon the animation is ready and how large it is, beside another package's of one cam."""

import json
import subprocess
import sys
from statistics import median

from findings import Finding, ratio_of_medians, say

ROUNDS = 5
OWN = """
import json, time
import cammotion as cm
import cammotion.views.animation
mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
die = cm.motion(
    "die", cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=55), cm.dwell(150),
    start_deg=150,
)
rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
before = cm.TimingDiagram([mill, die], rate_per_hour=2000)
after = cm.widest_move(before, "die", rule).diagram
started = time.perf_counter()
svg = cm.animate({"no overlap": before, "overlap": after}, rules=rule).svg
print(json.dumps([time.perf_counter() - started, len(svg.encode()) / 1000]))
"""
# As in that package's own example of a cam with a roller follower.
RIVAL = """
import json, time
import matplotlib
matplotlib.use("agg")
from mechanism import Cam
started = time.perf_counter()
cam = Cam(
    motion=[("Dwell", 150), ("Rise", 50, 55), ("Dwell", 100), ("Fall", 50, 55)],
    degrees=True, omega=3.49,
)
cam.get_animation(kind="cycloidal", base=100, roller_radius=10, length=40, width=10, inc=5)
print(json.dumps([time.perf_counter() - started, 0]))
"""


def measure_animation() -> list[Finding]:
    """Make the animation of both designs in fresh processes, by turns with the other package."""
    own, rival, size = [], [], 0.0
    for number in range(ROUNDS):
        say(f"animations, round {number + 1} of {ROUNDS}")
        seconds, size = run(OWN)
        own.append(seconds)
        rival.append(run(RIVAL)[0])
    say(f"medians: {median(own):.3f} s for two designs, {median(rival):.2f} s for its one cam")
    return [
        Finding("animation of both designs, after imports", median(own), 0.3, "s"),
        Finding("its size", size, 60, "kB"),
        Finding(
            "times sooner than one cam of `mechanism`", ratio_of_medians(rival, own), 10, "x", True
        ),
    ]


def run(code: str) -> tuple[float, float]:
    """Run code in a fresh Python; return the two numbers that it prints."""
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    if "No module named 'mechanism'" in ran.stderr:
        sys.exit("Only this measure needs another package: python -m pip install -e '.[benchmark]'")
    if ran.returncode != 0:
        raise RuntimeError(ran.stderr)
    seconds, size = json.loads(ran.stdout)
    return seconds, size
