"""What wrong answers to the exercises show, for many machines, and how to look into a picture."""

import math
import re
from collections.abc import Iterable, Iterator
from functools import cache
from itertools import combinations
from xml.etree import ElementTree

import numpy as np
import pytest
from judging import MACHINES, NUMBERS, number_id
from machines import Array

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.shown import frame
from cammotion.teaching.shown.choosing import show_answer
from cammotion.teaching.shown.frame import DIE, Shown
from cammotion.views.names import text_px

SHOWN = [exercise for exercise in NUMBERS if exercise.shows]
TIMES = (0.05, 0.3, 0.6, 0.9, 0.97, 1.03, 1.1, 1.5, 2.2, 20)
SVG = "{http://www.w3.org/2000/svg}"
FITS = "just|closes|as long as the question|with the angle of the question"
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
        for answer, shown in shown_of_wrong(exercise, machine)
    ]


def shown_of_wrong(exercise: NumberExercise, machine: MillAndDie) -> Iterator[tuple[float, Shown]]:
    """Yield the wrong answers that show something, with what they show."""
    for answer in answers(exercise, machine):
        if exercise.judge(answer, machine).state == "wrong" and (
            shown := show_answer(exercise, answer, machine)
        ):
            yield answer, shown


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


def assert_whole(shown: Shown) -> None:
    """See that a picture is small and all its words stand in it, none over another."""
    root = ElementTree.fromstring(shown.svg)  # noqa: S314 - our own
    assert int(root.attrib["width"]) <= 520
    assert int(root.attrib["height"]) <= 200
    assert root.findtext(f"{SVG}title") == shown.line
    written = " ".join([shown.line, *(str(text.text) for text in texts(shown))])
    assert not re.search("nan|inf|e[+-]", written + " ".join(map(str, root.iter())))
    assert len(shown.svg) < 8000
    assert 20 < len(shown.line) < 260
    assert_texts_keep_apart(shown)


def assert_texts_keep_apart(shown: Shown) -> None:
    boxes = []
    for text in texts(shown):
        # the widest of the fonts is allowed for, which this machine may not have
        width = text_px(str(text.text), 12)
        shift = {"start": 0.0, "middle": width / 2, "end": width}[text.attrib["text-anchor"]]
        left, y = float(text.attrib["x"]) - shift, float(text.attrib["y"])
        assert left >= 0, text.text
        assert left + width <= frame.WIDTH, text.text
        assert 10 <= y <= frame.HEIGHT - 3, text.text
        boxes.append((left, left + width, y - 10, y + 3))
    for (left, right, top, bottom), (other, end, high, low) in combinations(boxes, 2):
        assert right <= other or end <= left or bottom <= high or low <= top, shown.line


def assert_tells_nothing(
    exercise: NumberExercise, machine: MillAndDie, answer: float, shown: Shown
) -> None:
    """See that what a wrong answer shows has the right number nowhere, and does not fit."""
    right = exercise.solution(machine)
    known = [answer, *numbers(exercise.question(machine))]
    for number in numbers(" ".join([shown.line, *(str(text.text) for text in texts(shown))])):
        is_known = any(math.isclose(number, other, rel_tol=6e-3) for other in known)
        assert is_known or not math.isclose(number, right, rel_tol=0.01), shown.line
    assert not re.search(FITS, shown.line), answer


def assert_right_fits(exercise: NumberExercise, machine: MillAndDie) -> None:
    """See that a right answer fits however it is rounded, and what lacks digits is not shown."""
    right = exercise.solution(machine)
    for answer in (right, float(f"{right:.3g}"), float(f"{right:.2g}")):
        verdict, shown = exercise.judge(answer, machine), show_answer(exercise, answer, machine)
        if verdict.state == "right":
            assert shown is not None
            assert re.search(FITS, shown.line)
        elif "so few digits" in verdict.text:
            assert shown is None


def assert_any_number_breaks_nothing(
    exercise: NumberExercise, machine: MillAndDie, times: Iterable[float]
) -> None:
    """See that what is drawn is whole, and no error keeps it away, many times off too."""
    assert exercise.shows is not None
    right = exercise.solution(machine)
    for factor in times:
        shown = show_answer(exercise, float(right * factor), machine)
        assert shown is None or 1.99e-3 < factor < 501
        if shown:
            exercise.shows(machine, float(right * factor))
            assert_texts_keep_apart(shown)


def is_red(shown: Shown) -> bool:
    return "url(#alarm)" in shown.svg
