"""Notebooks in JupyterLab as README starts it: run, moved, seen small, saved, opened anew.

Each test run takes one of each kind; `python benchmarks/measure.py browsers` takes them all, in two
browsers and two front ends.
"""

import json

import nbformat
import pytest
from lab import ROOT, LabPage
from walking import Walk

from cammotion.views.live.figure import MIME

NOTEBOOKS = sorted(path.name for path in (ROOT / "notebooks").glob("[0-9]*.ipynb"))
# ipywidgets' own controls, players beside a figure, a pad that is dragged beside a choice
KINDS = ("00", "04", "05")
FAULTY = "faulty.ipynb"
FAULTS = {
    "<img src='data:image/svg+xml,<svg xmlns=%22http://www.w3.org/2000/svg%22/>'>": "no name: <img",
    "<input type='text'>": "no name: <input",
    "<div class='cm-figure'><p style='width:3000px'>wide</p></div>": "cut at 1366 px: <p",
    "<img alt='far' src='http://127.0.0.1:1/far.png'>": "http://127.0.0.1:1/far.png",
    "<label>dead <input type='range' min=0 max=9></label>": "slider 'dead' moves nothing",
    "<div class='cm-player' onkeydown='event.preventDefault()'><svg></svg>"
    "<button>Play</button></div>": "does not lead out",
}


@pytest.mark.parametrize("name", [name for name in NOTEBOOKS if name.startswith(KINDS)])
def test_nothing_is_found_wrong(jupyter: LabPage, name: str) -> None:
    walk = walk_through(jupyter, name)
    assert walk.take() == []
    stored = json.loads((ROOT / "notebooks" / name).read_text("utf-8"))
    outputs = [output for cell in stored["cells"] for output in cell.get("outputs", [])]
    assert walk.living == sum(MIME in output.get("data", {}) for output in outputs)
    assert walk.moved.total() > walk.living


def walk_through(jupyter: LabPage, name: str) -> Walk:
    """Return somebody who will open a notebook where another one is open."""
    return Walk(jupyter.window, jupyter.address, f"{jupyter.work}/{name}", is_one_page=True)


def test_what_is_wrong_is_found(jupyter: LabPage) -> None:
    cells = [nbformat.v4.new_code_cell(f"1 / 0  # {ROOT.name}")]  # type: ignore[no-untyped-call]
    for html in FAULTS:
        source = f"from IPython.display import HTML\nHTML({html!r})"
        cells.append(nbformat.v4.new_code_cell(source))  # type: ignore[no-untyped-call]
    kernel = {"name": "python3", "display_name": "Python 3"}
    notebook = nbformat.v4.new_notebook(  # type: ignore[no-untyped-call]
        cells=[*cells[1:], cells[0]], metadata={"kernelspec": kernel}
    )
    nbformat.write(notebook, ROOT / jupyter.work / FAULTY)  # type: ignore[no-untyped-call]
    jupyter.window.evaluate("() => { window.patienceMs = 300; }")
    findings = walk_through(jupyter, FAULTY).take()
    expected = [*FAULTS.values(), "ZeroDivisionError"]
    found = "\n".join(findings)
    assert [fault for fault in expected if fault not in found] == []
