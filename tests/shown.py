"""What wrong answers to the exercises show, for many machines, and how to look into a picture."""

import re
from functools import cache
from xml.etree import ElementTree

import numpy as np
import pytest
from judging import MACHINES, NUMBERS, number_id
from machines import Array

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import NumberExercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.shown.choosing import show_answer
from cammotion.teaching.shown.frame import DIE, Shown

SHOWN = [exercise for exercise in NUMBERS if exercise.shows]
TIMES = (0.05, 0.3, 0.6, 0.9, 0.97, 1.03, 1.1, 1.5, 2.2, 20)
SVG = "{http://www.w3.org/2000/svg}"
NUMBER = re.compile(r"\d+(?:\.\d+)?")
each_shown = pytest.mark.parametrize("exercise", SHOWN, ids=number_id)


def numbers(text: str) -> list[float]:
    return [float(number) for number in NUMBER.findall(text)]


def answers(exercise: NumberExercise, machine: MillAndDie) -> list[float]:
    """Return all its slips, and numbers near and far."""
    right = exercise.solution(machine)
    slips = [float(slip.leads_to(machine)) for slip in exercise.slips]
    return [*slips, *(right * times for times in TIMES)]


@cache
def wrong(number: str) -> list[tuple[MillAndDie, float, Shown]]:
    """Return what is shown of wrong answers to an exercise, for all machines."""
    exercise = EXERCISES[number]
    assert isinstance(exercise, NumberExercise)
    return [
        (machine, answer, shown)
        for machine in MACHINES
        for answer in answers(exercise, machine)
        if (shown := show_answer(exercise, answer, machine))
        and exercise.judge(answer, machine).state == "wrong"
    ]


def texts(shown: Shown) -> list[ElementTree.Element]:
    return ElementTree.fromstring(shown.svg).findall(f"{SVG}text")  # noqa: S314 - our own


def curve(shown: Shown) -> Array:
    """Return the points of the thick line in the colour of the die, in px."""
    root = ElementTree.fromstring(shown.svg)  # noqa: S314 - our own
    (path,) = [
        path
        for path in root.findall(f"{SVG}path")
        if path.get("stroke") == DIE and "stroke-dasharray" not in path.attrib
    ]
    return np.array([point.split() for point in path.attrib["d"][1:].split("L")], dtype=float)


def is_red(shown: Shown) -> bool:
    return "url(#alarm)" in shown.svg
