"""What it costs to make a law and know its factors, and how long the code of it all is."""

import random
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from statistics import median

import numpy as np
from findings import Finding, say

from cammotion import MotionLaw, law_from_points, scca

PACKAGE = Path(__file__).parent.parent / "src" / "cammotion"
MS = 1000
LAWS, TABLES = 200, 9
POINTS = {180: 15, 10_000: 50}  # and the most ms for so many
LINES = {"laws and machine": 3000, "the package without lessons": 8708}
LONGEST = 300


def measure_factors() -> list[Finding]:
    """Make SCCA laws and laws from points, and ask each for Cv, Ca, Cj and Cq."""
    rng = random.Random(1)  # noqa: S311 - no secret
    parts = [sorted(rng.random() for _ in range(2)) for _ in range(LAWS + 1)]
    first, *times = [
        time_factors(lambda b=b, e=e: scca(b, e - b, 1 - e))
        for b, e in parts  # type: ignore[misc]
    ]
    say(
        f"the first SCCA law of a process {first:.1f} ms, the slowest of the others {max(times):.1f}"
    )
    findings = [Finding(f"SCCA law and its four factors, median of {LAWS}", median(times), 3, "ms")]
    for count, limit in POINTS.items():
        places = np.linspace(0, 1, count)
        ways = places - np.sin(2 * np.pi * places) / (2 * np.pi)
        spent = [time_factors(partial(law_from_points, places, ways)) for _ in range(TABLES)]
        findings.append(
            Finding(f"law from {count} points to its factors", median(spent), limit, "ms")
        )
    return findings


def time_factors(make: Callable[[], MotionLaw]) -> float:
    """Return the time in ms from nothing to the four factors of a law."""
    started = time.perf_counter()
    law = make()
    _ = (law.Cv, law.Ca, law.Cj, law.Cq)
    return MS * (time.perf_counter() - started)


def measure_lines() -> list[Finding]:
    """Count the lines of the small shared package, and of all but the lessons' exercises."""
    lines = {
        path: len(path.read_text("utf-8").splitlines())
        for path in (*PACKAGE.rglob("*.py"), *PACKAGE.rglob("*.pyi"))
    }
    small = {path: n for path, n in lines.items() if path.parent.name in {"laws", "machine"}}
    rest = sum(n for path, n in lines.items() if not path.name.startswith("lesson_"))
    longest = max(small, key=lambda path: small[path])
    sizes = dict(zip(LINES, (sum(small.values()), rest), strict=True))
    return [
        *(Finding(f"lines of {what}", sizes[what], most, "") for what, most in LINES.items()),
        Finding(
            f"lines of {longest.name}, the longest file of the two",
            small[longest],
            LONGEST,
            "",
        ),
    ]
