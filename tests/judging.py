"""Exercises by their kinds, machines to try them with, and how an answer is judged."""

from collections.abc import Iterator
from typing import Any

import pytest

from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Exercise, Slip
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.variants import machine_for

MACHINES = [EXAMPLE, machine_for(), *(machine_for(f"learner {n}") for n in range(5))]
"""Of the source, of a learner without a name, and of a few more; `--fresh` draws new ones."""
NUMBERS = [exercise for exercise in EXERCISES.values() if isinstance(exercise, NumberExercise)]
CHOICES = [exercise for exercise in EXERCISES.values() if isinstance(exercise, ChoiceExercise)]
FORMULAS = [e for e in EXERCISES.values() if isinstance(e, ExpressionExercise)]
ACCELERATION = FORMULAS[0]
"""The one of notebook 02, in three variables; the others are in one."""


def number_id(exercise: Exercise) -> str:
    return exercise.number


each_exercise = pytest.mark.parametrize("exercise", EXERCISES.values(), ids=number_id)
each_number = pytest.mark.parametrize("exercise", NUMBERS, ids=number_id)
each_formula = pytest.mark.parametrize("exercise", FORMULAS, ids=number_id)
each_choice = pytest.mark.parametrize("exercise", CHOICES, ids=number_id)


def say(exercise: Exercise, answer: Any, machine: MillAndDie = EXAMPLE) -> str:
    """Return the reason that a wrong answer gets."""
    verdict = exercise.judge(answer, machine)
    assert verdict.state == "wrong", f"{answer!r} for {exercise.number}"
    return verdict.text


def is_right(exercise: Exercise, answer: Any, machine: MillAndDie = EXAMPLE) -> bool:
    return exercise.judge(answer, machine).state == "right"


def reasons_of(exercise: Exercise) -> Iterator[str]:
    """Return all reasons of an exercise for a wrong answer."""
    slips: tuple[Slip, ...] = getattr(exercise, "slips", ())
    yield from (slip.reason for slip in slips)
    yield from getattr(exercise, "reasons", {}).values()
