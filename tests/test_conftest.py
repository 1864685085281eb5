"""nbval, set up as for the notebooks, fails where an output changed."""

import json
from pathlib import Path
from shutil import copy
from typing import Any

import pytest

pytest_plugins = ["pytester"]

TOP = Path(__file__).parents[1]
PLAIN = {"text/plain": "x"}

Cell = dict[str, Any]


def cell(source: str, *outputs: Cell) -> Cell:
    """Make a cell that was run and stored these outputs."""
    return {
        "cell_type": "code",
        "execution_count": 1,
        "metadata": {},
        "source": source,
        "outputs": list(outputs),
    }


def printing(new: str, stored: str, stream: str = "stdout") -> Cell:
    """Make a cell that prints one text and stored another."""
    source = f"import sys\nprint({new!r}, file=sys.{stream})"
    return cell(source, {"output_type": "stream", "name": stream, "text": f"{stored}\n"})


def showing(new: dict[str, str], stored: dict[str, str]) -> Cell:
    """Make a cell that shows one MIME bundle and stored another."""
    output = {"output_type": "display_data", "metadata": {}, "data": stored}
    return cell(f"display({new}, raw=True)", output)


CELLS = {
    "printed text same": (printing("9.375", "9.375"), "passed"),
    "printed text differs": (printing("9.375", "9.376"), "failed"),
    "warning differs": (printing("new", "old", "stderr"), "failed"),
    "plain text differs": (showing({"text/plain": "y"}, PLAIN), "failed"),
    "html differs": (showing({"text/html": "<b>y</b>"}, {"text/html": "<b>x</b>"}), "failed"),
    "svg differs": (showing({"image/svg+xml": "<g/>"}, {"image/svg+xml": "<a/>"}), "failed"),
    "output gone": (cell("pass", *showing(PLAIN, PLAIN)["outputs"]), "failed"),
    "output new": (cell("display({'text/plain': 'x'}, raw=True)"), "failed"),
    "raises": (cell("1 / 0"), "failed"),
    "latex differs": (showing(PLAIN | {"text/latex": "y"}, PLAIN | {"text/latex": "x"}), "passed"),
    "latex new": (showing(PLAIN | {"text/latex": "y"}, PLAIN), "passed"),
    "png differs": (
        showing(PLAIN | {"image/png": "BB=="}, PLAIN | {"image/png": "AA=="}),
        "passed",
    ),
    "picture": (
        showing(
            PLAIN | {"text/html": '<img class="cm-paper" src="data:image/png;base64,AA==">'},
            PLAIN | {"image/png": "AA=="},
        ),
        "passed",
    ),
    "picture gone": (
        showing(PLAIN | {"text/html": "<img>"}, PLAIN | {"image/png": "AA=="}),
        "failed",
    ),
}


def write(path: Path, *made: Cell) -> None:
    cells = [{**one, "id": f"cell-{n}"} for n, one in enumerate(made)]
    notebook = {"nbformat": 4, "nbformat_minor": 5, "metadata": {}, "cells": cells}
    path.write_text(json.dumps(notebook), encoding="utf-8")


def verdicts_of(pytester: pytest.Pytester, name: str) -> list[str]:
    for settings in ("pyproject.toml", "conftest.py"):
        copy(TOP / settings, pytester.path)
    reports = pytester.inline_run(name).getreports("pytest_runtest_logreport")
    return [report.outcome for report in reports if report.when == "call"]


def test_solutions_share_a_kernel_and_find_nothing_of_each_other(pytester: pytest.Pytester) -> None:
    folder = pytester.path / "solutions"
    folder.mkdir()
    write(
        folder / "01.ipynb",
        cell("import cammotion, os, pathlib"),
        cell("mine = pathlib.Path('kernel').write_text(str(os.getpid()))"),
    )
    asked = "open('kernel').read() == str(os.getpid()), 'mine' in dir(), 'cammotion' in sys.modules"
    told = {"output_type": "stream", "name": "stdout", "text": "True False False\n"}
    write(folder / "02.ipynb", cell(f"import os, sys\nprint({asked})", told))
    assert verdicts_of(pytester, "solutions") == 3 * ["passed"]


def test_nbval_judges_each_change(pytester: pytest.Pytester) -> None:
    write(pytester.path / "changed.ipynb", *(made for made, _ in CELLS.values()))
    verdicts = verdicts_of(pytester, "changed.ipynb")
    expected = {change: verdict for change, (_, verdict) in CELLS.items()}
    assert dict(zip(CELLS, verdicts, strict=True)) == expected
