"""The lesson plans of docs/teaching.md: a lesson runs without what its 45 minutes leave out."""

import ast
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "teaching.md").read_text("utf-8")
PLANS = dict(re.findall(r"^## (\d\d) · (.*?)(?=^## )", PAGE, re.MULTILINE | re.DOTALL))
ROW = re.compile(r"^\| (.+) \| (\d+|–) \| (\d+|–) \|$", re.MULTILINE)
CALLED = {  # by the headings of the lessons
    "a machine of their own": "your own machine",
    "their own machine, shown to a neighbour": "your own machine",
    "the table of their own machine": "your machine",
    "the contest": "check yourself",
}


def left_out(lesson: str) -> Iterator[str]:
    """Give what the 45 minutes leave out: each part of a row with a dash, or "in 90 minutes"."""
    for what, short, _ in ROW.findall(PLANS[lesson]):
        more = what.lower() if short == "–" else what.lower().partition("in 90 minutes ")[2]
        for part in filter(None, re.split("; |, and | and ", more.removeprefix("with "))):
            yield CALLED.get(part, part.removeprefix("the "))


def sections(lesson: str) -> list[tuple[str, list[str]]]:
    """Return a lesson's headings, those above each before it, with the code cells below."""
    (path,) = (ROOT / "notebooks").glob(f"{lesson}_*.ipynb")
    found, above = list[tuple[str, list[str]]](), list[str]()
    cells: list[dict[str, Any]] = json.loads(path.read_text("utf-8"))["cells"]
    for cell in cells:
        source = "".join(cell["source"])
        if cell["cell_type"] == "code":
            found[-1][1].append(source)
        elif heading := re.match(r"(#+) (.+)", source):
            above = [*above[: len(heading[1]) - 1], heading[2].lower()]
            found.append((" / ".join(above[1:]), []))
    return found


def read_in(source: str) -> set[str]:
    """Return the names that a cell reads."""
    nodes = ast.walk(ast.parse(source))
    return {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)}


def given_in(source: str) -> set[str]:
    """Return the names that a cell gives, with those of its functions and their arguments."""
    found = set[str]()
    for node in ast.walk(ast.parse(source)):
        match node:
            case ast.Name(id=name, ctx=ast.Store()) | ast.arg(arg=name):
                found.add(name)
            case ast.FunctionDef(name=name) | ast.alias(name=name):
                found.add(getattr(node, "asname", None) or name)
    return found


def kept(lesson: str) -> list[str]:
    """Return the code cells of the 45 minutes."""
    parts = [*left_out(lesson)]
    of_each = (
        cells for heading, cells in sections(lesson) if not any(part in heading for part in parts)
    )
    return [source for cells in of_each for source in cells]


def lacking(lesson: str) -> set[str]:
    """Return the names that the cells of the 45 minutes read before one of them gives them."""
    whole = [source for _, cells in sections(lesson) for source in cells]
    of_the_lesson = set[str]().union(*(given_in(source) for source in whole))
    given, lost = set[str](), set[str]()
    for source in kept(lesson):
        given |= given_in(source)
        lost |= read_in(source) & (of_the_lesson - given)
    return lost


@pytest.mark.parametrize("lesson", PLANS)
def test_what_a_plan_leaves_out_is_a_section(lesson: str) -> None:
    headings = [heading for heading, _ in sections(lesson)]
    for part in left_out(lesson):
        assert any(part in heading for heading in headings), part


@pytest.mark.parametrize("lesson", PLANS)
def test_a_lesson_runs_without_what_its_plan_leaves_out(lesson: str) -> None:
    assert lacking(lesson) == set()


@pytest.mark.parametrize("lesson", PLANS)
def test_no_plan_leaves_out_a_prediction_or_its_answer(lesson: str) -> None:
    made = {name for source in kept(lesson) for name in re.findall(r"(\w+) = cm.predict", source)}
    shown = {name for source in kept(lesson) for name in re.findall(r"(\w+)\.reveal", source)}
    assert made == shown
    whole = [source for _, cells in sections(lesson) for source in cells]
    assert len(made) == sum(source.count("cm.predict(") for source in whole)


@pytest.mark.parametrize("lesson", PLANS)
def test_the_class_stops_at_a_heading_for_each_prediction(lesson: str) -> None:
    """The page says: at each that begins with *Predict*."""
    for heading, cells in sections(lesson):
        asks = any("cm.predict(" in source for source in cells)
        assert asks <= heading.rpartition(" / ")[2].startswith("predict"), heading


def test_the_play_has_its_minutes_before_it_is_predicted() -> None:
    """What turns round is told in the section before."""
    assert "when the torque turns round" not in left_out("08")


@pytest.mark.parametrize("lesson", PLANS)
def test_the_minutes_of_a_plan_make_its_lesson(lesson: str) -> None:
    rows = ROW.findall(PLANS[lesson])
    for column, minutes in ((1, 45), (2, 90)):
        assert sum(int(row[column]) for row in rows if row[column] != "–") == minutes
