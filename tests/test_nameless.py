"""Without a name no answer can be copied: no number of a lesson is right for its exercises."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from bs4 import BeautifulSoup
from judging import NUMBERS, is_right, number_id

import cammotion as cm
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.variants import NAMELESS

NOTEBOOKS = Path(__file__).parent.parent / "notebooks"
EXERCISE = re.compile(r"cm\.(ask|check|choose|variant|progress)\(")
NUMBER = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?:e[+-]?\d+)?")
COPIED = {
    *("01.1", "01.3", "02.1", "03.1", "03.2", "03.3", "03.4", "03.5", "05.5", "06.3", "06.4"),
}
"""Answers for the source's numbers that stand in their lessons: the test below has to find them."""


def texts(lesson: str) -> Iterator[str]:
    """Return all that a lesson says before and after its exercises, with its stored outputs."""
    (path,) = NOTEBOOKS.glob(f"{lesson}_*.ipynb")
    for cell in json.loads(path.read_text("utf-8"))["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "code" and EXERCISE.search(source):
            continue
        yield source
        for output in cell.get("outputs", ()):
            yield "".join(output.get("text", ""))
            for kind, data in output.get("data", {}).items():
                if kind in {"text/plain", "text/markdown", "text/latex"}:
                    yield "".join(data)
                if kind == "text/html":
                    yield BeautifulSoup("".join(data), "html.parser").get_text(" ")


def printed(lesson: str) -> list[float]:
    """Return all numbers that stand in a lesson."""
    return sorted({float(number) for text in texts(lesson) for number in NUMBER.findall(text)})


def accepted(exercise: NumberExercise, machine: MillAndDie) -> list[float]:
    """Return the numbers of its lesson that are right for an exercise."""
    found = printed(exercise.number[:2])
    return [number for number in found if is_right(exercise, number, machine)]


@pytest.mark.parametrize("exercise", NUMBERS, ids=number_id)
def test_no_number_of_its_lesson_is_taken_for_an_answer(exercise: NumberExercise) -> None:
    assert accepted(exercise, NAMELESS) == []


def test_with_the_numbers_of_the_source_it_would_be() -> None:
    """Otherwise the test above would prove nothing."""
    assert {e.number for e in NUMBERS if accepted(e, EXAMPLE)} >= COPIED


@pytest.mark.parametrize("exercise", NUMBERS, ids=number_id)
def test_nor_is_the_answer_for_the_numbers_of_the_source(exercise: NumberExercise) -> None:
    assert not is_right(exercise, exercise.solution(EXAMPLE), NAMELESS)


def test_the_questions_are_about_the_nameless_from_the_start() -> None:
    assert cm.variant("") == NAMELESS
    assert f"{NAMELESS.mill_angle_deg:g} degrees of each turn" in cm.ask("01.1").text
    assert not cm.check("01.1", EXAMPLE.die_angle_deg).is_right
    assert cm.check("01.1", NAMELESS.die_angle_deg).is_right


def test_no_wrong_way_leads_to_the_right_number() -> None:
    for exercise in NUMBERS:
        for slip in exercise.slips:
            assert not is_right(exercise, slip.leads_to(NAMELESS), NAMELESS), slip.reason
