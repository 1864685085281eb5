"""How far an answer to an exercise may be rounded: what has to hold for each learner's numbers."""

import math
import re
from collections.abc import Iterator

import pytest
from by_hand import ALL_SLIPS
from judging import is_right

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.number_exercise import NumberExercise

_ASKED = re.compile(r", to (three|four) digits$")
_DIGITS = {"three": 3, "four": 4}


def asked_digits(exercise: NumberExercise, machine: MillAndDie) -> int:
    """Return to how many digits a question asks for its answer, 2 where it says nothing."""
    found = _ASKED.search(exercise.wanted_for(machine))
    return _DIGITS[found[1]] if found else 2


def rounded(value: float, digits: int) -> float:
    return float(f"{value:.{digits}g}")


def assert_rounded_as_asked_is_right(exercise: NumberExercise, machine: MillAndDie) -> None:
    right = exercise.solution(machine)
    for digits in range(asked_digits(exercise, machine), 8):
        assert is_right(exercise, rounded(right, digits), machine), (machine.who, digits)


def assert_two_digits_are_enough(exercise: NumberExercise, machine: MillAndDie) -> None:
    """Unless they are too far off, or a slip's, a half of which may go up or down."""
    right = exercise.solution(machine)
    if asked_digits(exercise, machine) > 2:
        two = rounded(right, 2)
        too_far = abs(two - right) > 0.012 * right
        half = 0.5 * 10 ** (math.floor(math.log10(abs(two))) - 1)
        of_a_slip = any(
            abs(two - float(slip.leads_to(machine))) <= half * (1 + 1e-9) for slip in exercise.slips
        )
        half_way = rounded(right, 3) != pytest.approx(rounded(right, 2), rel=0.004)
        assert too_far or of_a_slip or half_way, machine.who


def assert_no_wrong_way_is_right(exercise: NumberExercise, machine: MillAndDie) -> None:
    """More than four digits are never asked for; slips that agree in four are rare."""
    for value in _wrong_ways(exercise, machine):
        assert not is_right(exercise, value, machine), (machine.who, value)
    right, digits = exercise.solution(machine), asked_digits(exercise, machine)
    for slip in exercise.slips:
        value = float(slip.leads_to(machine))
        if value != pytest.approx(right, rel=1e-9 if digits < 4 else 1e-3):
            assert not is_right(exercise, rounded(value, digits), machine), (machine.who, value)


def _wrong_ways(exercise: NumberExercise, machine: MillAndDie) -> Iterator[float]:
    """Return what the known wrong ways lead to, where it is not the right number after all.

    That it may be exactly, or to the four digits that are the most that is asked for. A number
    that was rounded on the way is no wrong way.
    """
    right = exercise.solution(machine)
    by_hand = [s for s in ALL_SLIPS if s.number == exercise.number and s.said != "rounded"]
    ways = [slip.answer for slip in exercise.slips] + [slip.answer for slip in by_hand]
    for value in {float(way(machine)) for way in ways}:
        if value != rounded(right, 4) and value != pytest.approx(right, rel=1e-9):
            yield value
