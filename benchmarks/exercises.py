"""What it costs to have an answer checked, and to see what is done."""

import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from findings import Finding, percentile_95, say
from package import seconds_of

import cammotion as cm
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.places import FILE
from cammotion.teaching.shown.choosing import show_answer
from cammotion.teaching.variants import machine_for

MS = 1000
ROUNDS = 20
CHECK_MS, PROGRESS_MS, SHOWN_MS = 50, 100, 100
PREDICTIONS = 200
KINDS = ("right", "wrong", "odd")
ODD: list[Any] = [None, "x", "4.15 m/s2", float("nan"), [1.0] * 1000, np.zeros(5), object(), 1j]


def measure_exercises() -> list[Finding]:
    """Check answers to all exercises, with a full file of progress, and show the progress."""
    with sit_down() as file:
        first = {number: MS * seconds_of(partial(cm.check, number, 1.0)) for number in EXERCISES}
        times = {kind: time_checks(kind) for kind in KINDS}
        progress = [MS * seconds_of(lambda: cm.progress().html) for _ in range(ROUNDS)]
        say(f"{file.stat().st_size / 1000:.0f} kB of progress")
    slowest = max(first, key=lambda number: first[number])
    say(f"the first check of each, the slowest of them {slowest}: {first[slowest]:.1f} ms")
    for kind, spent in times.items():
        say(f"{kind}: 95th percentile {percentile_95(spent):.1f} ms, {len(spent)} checks")
    return [
        *[
            Finding(f"check of answers that are {kind}, median", median(spent), CHECK_MS, "ms")
            for kind, spent in times.items()
        ],
        Finding(
            "check, the first of each exercise, median", median(first.values()), CHECK_MS, "ms"
        ),
        Finding("progress, median", median(progress), PROGRESS_MS, "ms"),
    ]


def measure_shown() -> list[Finding]:
    """Draw what wrong answers would do, in new machines of 20 learners, their solves included."""
    times: dict[str, list[float]] = {}
    for count in range(ROUNDS):
        for number, exercise in EXERCISES.items():
            if getattr(exercise, "shows", None):
                known, machine = (machine_for(f"learner {count}") for _ in range(2))
                for answer in make_answers("wrong", exercise.solution(known)):
                    draw = partial(draw_answer, exercise, answer, machine)
                    times.setdefault(number, []).append(MS * seconds_of(draw))
    for number, spent in times.items():
        say(f"{number}: median {median(spent):.1f} ms, largest {max(spent):.1f} ms")
    spent = [time for each in times.values() for time in each]
    say(f"{len(spent)} answers to {len(times)} exercises")
    return [
        Finding("what an answer would do, median", median(spent), SHOWN_MS, "ms"),
        Finding("what an answer would do, largest", max(spent), SHOWN_MS, "ms"),
    ]


def draw_answer(exercise: Exercise, answer: Any, machine: MillAndDie) -> str:
    """Return the HTML of what an answer would do, "" where nothing is shown."""
    shown = show_answer(exercise, answer, machine)
    return shown.html if shown else ""


@contextmanager
def sit_down() -> Iterator[Path]:
    """Work in a folder of copies with a full file of progress; give the file."""
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as book:
        work = Path(book) / "work"
        work.mkdir()
        (Path(book) / "workbook.py").touch()
        record = {"state": "wrong", "tries": 99, "hints": 3, "who": "someone of a long name"}
        content = {
            "exercises": dict.fromkeys(EXERCISES, record),
            "predictions": {f"{n}.key": {"text": "about 55 deg"} for n in range(PREDICTIONS)},
        }
        (work / FILE).write_text(json.dumps(content), encoding="utf-8")
        os.chdir(work)
        try:
            yield work / FILE
        finally:
            os.chdir(before)


def time_checks(kind: str) -> list[float]:
    """Return the times in ms of checks of one kind of answer, for a variant in each round."""
    times = []
    for count in range(ROUNDS):
        machine = cm.variant(count)
        for number, exercise in EXERCISES.items():
            for answer in make_answers(kind, exercise.solution(machine)):
                times.append(MS * seconds_of(partial(cm.check, number, answer)))
    return times


def make_answers(kind: str, right: Any) -> list[Any]:
    """Return answers of a kind to an exercise, from its right answer."""
    if kind == "right":
        return [right]
    if kind == "odd":
        return ODD
    return (
        [letter for letter in "abcd" if letter != right]
        if isinstance(right, str)
        else [
            right * 1.234,
            right * 2,
        ]
    )
