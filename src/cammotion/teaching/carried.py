"""An error that is carried forward: a later answer that is right for a wrong earlier one."""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import Exercise, GoingOn, NumberExercise, Slip


def link(exercises: Iterable[Exercise]) -> dict[str, Exercise]:
    """Return exercises by their numbers; those that go on from earlier ones know their slips.

    The earlier ones come first. An error is carried on over more than one exercise.
    """
    linked: dict[str, Exercise] = {}
    for exercise in exercises:
        if isinstance(exercise, NumberExercise) and exercise.goes_on_from:
            linked[exercise.number] = replace(exercise, carried=tuple(_carry(exercise, linked)))
        else:
            linked[exercise.number] = exercise
    return linked


def _carry(exercise: NumberExercise, linked: dict[str, Exercise]) -> Iterator[Slip]:
    for number, going_on in exercise.goes_on_from.items():
        earlier = linked[number]
        if isinstance(earlier, NumberExercise):
            head = f"What you did here is right, but with a wrong answer to {number}."
            for slip in earlier.slips:
                yield Slip(_after(slip, going_on), f"{head} {slip.reason}")
            for slip in earlier.carried:  # it names the exercise that it comes from
                yield Slip(_after(slip, going_on), slip.reason)


def _after(slip: Slip, going_on: GoingOn) -> Callable[[MillAndDie], float]:
    def answer(machine: MillAndDie) -> float:
        """Return what an earlier slip leads to, NaN where nobody would go on with it."""
        try:
            return float(going_on(machine, float(slip.answer(machine))))
        except (ValueError, ZeroDivisionError):
            return math.nan

    return answer
