"""Whether every question that is asked again, with fresh numbers, can be solved."""

import itertools
import sys
import time
from pathlib import Path

from findings import Finding, say

sys.path.append(str(Path(__file__).parent.parent / "tests"))

from fresh.check_questions import ASKED, rounds

from cammotion.teaching.variants import machine_for

DRAWS = 10_000


def measure_again() -> list[Finding]:
    """Draw 10,000 questions with fresh numbers; each has to be solvable and in range."""
    started, drawn, unsound = time.perf_counter(), 0, 0
    for number in itertools.count():
        own = machine_for(f"one of many {number}")
        for exercise in ASKED:
            try:
                rounds(exercise, own, 1)
            except AssertionError as fault:
                unsound += 1
                say(str(fault))
        drawn += len(ASKED)
        if drawn >= DRAWS:
            break
    say(f"{drawn} draws in {time.perf_counter() - started:.0f} s")
    return [Finding(f"of {DRAWS} questions asked again, unsound", unsound, 0, "")]
