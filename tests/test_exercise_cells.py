"""Each lesson asks all of its exercises, in cells that nbgrader can grade, with nothing filled in.

This needs no nbgrader; test_nbgrader.py lets the real one grade the same cells.
"""

import ast
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from cammotion.teaching.exercise import ChoiceExercise
from cammotion.teaching.lessons import EXERCISES

NOTEBOOKS = Path(__file__).parent.parent / "notebooks"
LESSONS = sorted({number.split(".")[0] for number in EXERCISES})
VARIANT = 'cm.variant("")'

Cells = list[dict[str, Any]]


def code_cells(lesson: str) -> Cells:
    """Return the code cells of a lesson's notebook, the source of each as one text."""
    (path,) = NOTEBOOKS.glob(f"{lesson}_*.ipynb")
    cells = json.loads(path.read_text("utf-8"))["cells"]
    codes = [cell for cell in cells if cell["cell_type"] == "code"]
    return [{**cell, "source": "".join(cell["source"])} for cell in codes]


def grading(number: str) -> dict[str, Any]:
    """Return what nbgrader has to find in the metadata of a check's cell, by its schema 3."""
    return {
        "schema_version": 3,
        "grade": True,
        "solution": False,
        "locked": True,
        "task": False,
        "points": 1,
        "grade_id": f"check-{number.replace('.', '-')}",
        "cell_type": "code",
    }


def is_open(source: str, name: str) -> bool:
    """Tell whether a cell of code sets a name to None and no other name to anything."""
    match ast.parse(source).body:
        case [ast.Assign(targets=[ast.Name(id=found)], value=ast.Constant(value=None))]:
            return found == name
    return False


def faults(cells: Cells, lesson: str) -> list[str]:
    """Say what is wrong with the exercises of a lesson."""
    sources = [cell["source"] for cell in cells]
    numbers = [number for number in EXERCISES if number.startswith(f"{lesson}.")]
    wanted = [f'cm.check("{number}", answer_{number[3:]})' for number in numbers]
    found = [] if sources.count(f"me = {VARIANT}\nme") == 1 else [f"not one cell with {VARIANT}"]
    if (checks := [source for source in sources if "cm.check(" in source]) != wanted:
        return [*found, f"the checks are {checks}, not {wanted}"]
    for number, check in zip(numbers, wanted, strict=True):
        at = sources.index(check)
        ask = "choose" if isinstance(EXERCISES[number], ChoiceExercise) else "ask"
        if sources[at - 2] != f'cm.{ask}("{number}")':
            found.append(f"{number}: not asked by cm.{ask} two cells before its check")
        if not is_open(sources[at - 1], f"answer_{number[3:]}"):
            found.append(f"{number}: not a lone answer of None before its check")
        if cells[at]["metadata"].get("nbgrader") != grading(number):
            found.append(f"{number}: not graded as {grading(number)}")
    asked = sum(source.startswith(("cm.ask(", "cm.choose(")) for source in sources)
    graded = sum("nbgrader" in cell["metadata"] for cell in cells)
    if not asked == graded == len(numbers):
        found.append(f"{asked} are asked and {graded} are graded, not {len(numbers)}")
    return found


@pytest.mark.parametrize("lesson", LESSONS)
def test_each_exercise_can_be_answered_and_graded(lesson: str) -> None:
    assert faults(code_cells(lesson), lesson) == []


def place(cells: Cells, start: str) -> int:
    """Return where the first cell is whose source begins with a text."""
    return next(at for at, cell in enumerate(cells) if cell["source"].startswith(start))


def replacing(start: str, old: str, new: str) -> Callable[[Cells], None]:
    """Return an edit of the first cell whose source begins with a text."""

    def edit(cells: Cells) -> None:
        cell = cells[place(cells, start)]
        assert old in cell["source"]
        cell["source"] = cell["source"].replace(old, new)

    return edit


def grading_by(**changes: object) -> Callable[[Cells], None]:
    """Return an edit of the first check's metadata."""
    return lambda cells: cells[place(cells, "cm.check")]["metadata"]["nbgrader"].update(changes)


def swap(cells: Cells) -> None:
    """Ask the second exercise before the first."""
    at = place(cells, "cm.ask")
    cells[at : at + 6] = cells[at + 3 : at + 6] + cells[at : at + 3]


SPOILT: dict[str, Callable[[Cells], object]] = {
    "filled in": replacing("answer_1", "None", "55"),
    "more in an answer's cell": replacing("answer_1", "None", "None\nhalf = 55"),
    "a name in it": replacing("me", '""', '"Anna"'),
    "a choice that is only asked": replacing("cm.choose", "choose", "ask"),
    "a check of another answer": replacing("cm.check", "answer_1", "answer_2"),
    "no metadata": lambda cells: cells[place(cells, "cm.check")]["metadata"].clear(),
    "the id of another": grading_by(grade_id="check-01-2"),
    "an older schema": grading_by(schema_version=2),
    "not locked": grading_by(locked=False),
    "no check": lambda cells: cells.pop(place(cells, "cm.check")),
    "a check twice": lambda cells: cells.append(cells[place(cells, "cm.check")]),
    "asked twice": lambda cells: cells.append(cells[place(cells, "cm.ask")]),
    "another cell graded": lambda cells: cells[0]["metadata"].update(nbgrader=grading("01.1")),
    "another order": swap,
}


@pytest.mark.parametrize("fault", SPOILT)
def test_a_spoilt_lesson_is_refused(fault: str) -> None:
    cells = code_cells("01")
    SPOILT[fault](cells)
    assert faults(cells, "01")
