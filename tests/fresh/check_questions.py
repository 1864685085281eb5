"""Checks of questions with fresh numbers: solvable, in range, told from wrong ways, complete."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np
import sympy

from cammotion.machine.diagram import TimingDiagram
from cammotion.teaching import again
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Exercise
from cammotion.teaching.fit_numbers import FIT_CHOICES
from cammotion.teaching.follower_numbers import FOLLOWER_CHOICES
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.measured_numbers import MEASURED_CHOICES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.table_numbers import TABLE_CHOICES
from cammotion.teaching.variants import LAW_CHOICES, machine_for
from fresh.drawing import Machine

ASKED = [one for one in EXERCISES.values() if not isinstance(one, ChoiceExercise)]
LARGEST = {"deg": 360.0, "%": 100.0, "s": 3.0, "ms": 3000.0, "mm": 600.0}
"""A turn, the whole, the longest turn of a machine, and the largest cam of a die."""
OTHERS: dict[str, Any] = {
    "rate_per_hour": 2111,
    "pitch_mm": 93.0,
    "stops": 18,
    "mill_angle_deg": 133.0,
    "work_deg": 87.0,
    "wait_mm": 17.3,
    "pocket_mm": 33.3,
    "gap_mm": 1.25,
    "margin_mm": 1.75,
    "die_mass_kg": 7.7,
}
CHOICES: dict[str, Mapping[str, Sequence[Any]]] = {
    "laws": LAW_CHOICES,
    "table": TABLE_CHOICES,
    "measured": MEASURED_CHOICES,
    "follower": FOLLOWER_CHOICES,
    "fits": FIT_CHOICES,
}


def questions(machine: Machine) -> None:
    """Ask an exercise twice with fresh numbers: machine after machine, one after the other."""
    who = f"{machine.seed} {machine.number}"
    rounds(ASKED[machine.number % len(ASKED)], machine_for(who), 2)


def rounds(exercise: Exercise, own: MillAndDie, count: int) -> None:
    """Look at the first rounds of an exercise."""
    before = [exercise.solution(own)]
    for turn, drawn in enumerate(islice(again.fresh_machines(exercise, own), count), 1):
        where = f"{exercise.number} of {own.who!r}, round {turn}"
        for answer in {*before[:1], *before[-2:]}:
            assert exercise.judge(answer, drawn).state == "wrong", f"{where}: as before"
        before.append(exercise.solution(drawn))
        _is_sound(exercise, drawn, where)
        _is_complete(exercise, drawn, where)


def _is_sound(exercise: Exercise, drawn: MillAndDie, where: str) -> None:
    right = exercise.solution(drawn)
    assert exercise.judge(right, drawn).state == "right", where
    if isinstance(exercise, NumberExercise):
        assert 0 < right < LARGEST.get(exercise.unit, math.inf), f"{where}: {right}"
        assert exercise.judge(float(f"{right:.4g}"), drawn).state == "right", f"{where}: {right}"
    elif not isinstance(right, TimingDiagram):
        assert isinstance(right, sympy.Expr)
        values = sympy.lambdify(sorted(right.free_symbols, key=str), right)
        for place in np.linspace(0.01, 0.12, 5):
            assert math.isfinite(values(*[place] * len(right.free_symbols))), where
    for slip in getattr(exercise, "slips", ()):
        assert exercise.judge(slip.answer(drawn), drawn).state != "right", f"{where}: {slip.reason}"


def _is_complete(exercise: Exercise, drawn: MillAndDie, where: str) -> None:
    """Change what a question does not tell: its answer has to stay."""
    text, right = again.whole_question(exercise, drawn), exercise.solution(drawn)
    for name, other in _others(drawn):
        if again.whole_question(exercise, other) == text:
            same = exercise.judge(exercise.solution(other), drawn).state == "right"
            assert same, f"{where} does not tell {name}: {right}\n{text}"


def _others(drawn: MillAndDie) -> Iterator[tuple[str, MillAndDie]]:
    for name, value in OTHERS.items():
        yield name, replace(drawn, **{name: value})
    for part, each in CHOICES.items():
        record = getattr(drawn, part)
        for name, choices in each.items():
            for value in _in_one_place(getattr(record, name), choices):
                other: Any = replace(record, **{name: value})
                yield f"{part}.{name}", replace(drawn, **{part: other})


def _in_one_place(own: Any, choices: Sequence[Any]) -> Iterator[Any]:
    """Yield another choice, of a tuple one for each place that is another one there."""
    if not isinstance(own, tuple):
        yield next(one for one in choices if one != own)
        return
    for place, number in enumerate(own):
        others = (one[place] for one in choices if one[place] != number)
        for other in islice(others, 1):
            parts = [*own[:place], other, *own[place + 1 :]]
            yield type(own)(*parts) if hasattr(own, "_fields") else tuple(parts)
