"""Which answers are shown: those that differ enough to be seen, and tell no right number."""

import math
import re
from collections.abc import Iterator
from typing import Any

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.reading import to_number
from cammotion.teaching.rounding import FEWEST, is_rounded
from cammotion.teaching.shown.frame import Shown

_NEAREST = 0.01  # so near to the right answer nothing is to be seen
_FARTHEST = 500.0  # what is a unit off, like mm for m, is no machine any more
_ROUNDED = 0.012  # a number so near to the right one might be taken for it
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
_TEXT = re.compile(r"<text[^>]*>([^<]*)</text>")


def show_answer(exercise: Exercise, answer: Any, machine: MillAndDie) -> Shown | None:
    """Return what an answer of any type would do in a machine; never raise.

    None for an exercise that shows nothing, for what is no number or an absurd one, and where
    nothing would be seen. A right answer that is rounded is shown as if it were not.
    """
    if not isinstance(exercise, NumberExercise) or exercise.shows is None:
        return None
    try:
        given, right = to_number(answer, exercise.wanted), exercise.solution(machine)
        if exercise.judge(answer, machine).state == "right":
            return exercise.shows(machine, right)
        ratio = given / right
        if not 1 / _FARTHEST < ratio < _FARTHEST or abs(ratio - 1) < _NEAREST:
            return None
        if is_rounded(given, right, FEWEST):  # right, but for the digits that are missing
            return None
        shown = exercise.shows(machine, given)
        known = [given, *plain_numbers(exercise.question(machine))]
        return None if shown is None or tells(shown, right, known) else shown
    except Exception:  # a picture may be missing, the sentence never
        return None


def tells(shown: Shown, right: float, known: list[float]) -> bool:
    """Tell whether the right number stands in line or picture, though it is not known already."""
    written = plain_numbers(" ".join([shown.line, *_TEXT.findall(shown.svg)]))
    return any(
        _is_near(number, right) and not any(_is_near(number, other) for other in known)
        for number in written
    )


def plain_numbers(text: str) -> Iterator[float]:
    """Yield the numbers that stand in a text, without their signs."""
    return map(float, _NUMBER.findall(text))


def _is_near(number: float, other: float) -> bool:
    return math.isclose(number, other, rel_tol=_ROUNDED)
