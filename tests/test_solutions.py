"""The worked solutions are right, for the source's numbers and for anybody's."""

import json
import re
from pathlib import Path
from typing import Any

import pytest

import cammotion as cm
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.messages import Feedback

NOTEBOOKS = Path(__file__).parent.parent / "notebooks"
SOLUTIONS = sorted((NOTEBOOKS / "solutions").glob("*.ipynb"))
LESSONS = sorted({number.split(".")[0] for number in EXERCISES})
VARIANT = 'cm.variant("")'
CHECK = re.compile(r'cm\.check\("([\d.]+)", (\w+)\)')
LEARNERS = ["", "Anna", *(f"learner {number}" for number in range(3))]


def code_cells(path: Path) -> list[str]:
    cells = json.loads(path.read_text("utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


def work_through(path: Path, who: str) -> dict[str, Feedback]:
    """Execute a solution with the numbers of a learner; return what each check says."""
    names: dict[str, Any] = {}
    said = {}
    for source in code_cells(path):
        exec(source.replace(VARIANT, f"cm.variant({who!r})"), names)  # noqa: S102 - our own
        for number, answer in CHECK.findall(source):
            said[number] = cm.check(number, names[answer])
    cm.variant()
    return said


def test_every_lesson_with_exercises_has_its_solutions() -> None:
    assert [path.name for path in SOLUTIONS] == [f"{lesson}_solutions.ipynb" for lesson in LESSONS]


@pytest.mark.parametrize("path", SOLUTIONS, ids=lambda path: path.stem)
def test_every_exercise_is_asked_and_worked_in_order(path: Path) -> None:
    wanted = [number for number in EXERCISES if number.split(".")[0] == path.name[:2]]
    source = "\n".join(code_cells(path))
    assert re.findall(r'cm\.ask\("([\d.]+)"\)', source) == wanted
    assert [number for number, _ in CHECK.findall(source)] == wanted
    assert source.count(VARIANT) == 1


@pytest.mark.parametrize("who", LEARNERS)
@pytest.mark.parametrize("path", SOLUTIONS, ids=lambda path: path.stem)
def test_each_answer_is_right_for_everybody(path: Path, who: str) -> None:
    for number, feedback in work_through(path, who).items():
        assert feedback.is_right, f"{number}: {feedback}"


def test_an_answer_for_other_numbers_is_not_right() -> None:
    """Otherwise the test above would prove nothing."""
    cm.variant("learner 1")
    right = EXERCISES["02.1"].solution(cm.variant("learner 2"))
    cm.variant("learner 1")
    assert not cm.check("02.1", right).is_right
    cm.variant()
