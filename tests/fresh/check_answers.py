"""Checks of answers: a learner whom no test has seen is judged as those in the tests are."""

import numpy as np
import pytest
from by_hand import RIGHT
from judging import NUMBERS
from rounding import (
    assert_no_wrong_way_is_right,
    assert_rounded_as_asked_is_right,
    assert_two_digits_are_enough,
)
from shown import (
    assert_any_number_breaks_nothing,
    assert_right_fits,
    assert_tells_nothing,
    assert_whole,
    shown_of_wrong,
)

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.variants import machine_for
from fresh.drawing import Machine


def answers(machine: Machine) -> None:
    """Answer an exercise as a new learner does: machine after machine, one after the other."""
    exercise = NUMBERS[machine.number % len(NUMBERS)]
    learner = machine_for(f"{machine.seed} {machine.number}")
    assert exercise.solution(learner) == pytest.approx(RIGHT[exercise.number](learner))
    assert_rounded_as_asked_is_right(exercise, learner)
    assert_two_digits_are_enough(exercise, learner)
    assert_no_wrong_way_is_right(exercise, learner)
    if exercise.shows:
        _see(exercise, learner, machine.rng)


def _see(exercise: NumberExercise, learner: MillAndDie, rng: np.random.Generator) -> None:
    """Look at what right and wrong answers show."""
    assert_right_fits(exercise, learner)
    for answer, shown in shown_of_wrong(exercise, learner):
        assert_whole(shown)
        assert_tells_nothing(exercise, learner, answer, shown)
    assert_any_number_breaks_nothing(exercise, learner, 10 ** rng.uniform(-4, 4, 10))
