"""Notebooks in JupyterLab as README starts it: run, moved, seen small, saved, opened anew.

Each test run takes one of each kind; `python benchmarks/measure.py browsers` takes them all, in two
browsers and two front ends.
"""

import json
import shutil
from collections.abc import Iterator

import nbformat
import pytest
from lab import ROOT, require_chromium, running_browser, running_lab
from walking import Walk
from windows import ChromiumWindow

from cammotion.views.live.figure import MIME

WORK = "work-notebooks-test"
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


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[ChromiumWindow, str]]:
    """Start JupyterLab and open it at its first notebook."""
    require_chromium()
    home = tmp_path_factory.mktemp("jupyter")
    try:
        with running_browser() as browser, running_lab(home, WORK) as address:
            window = ChromiumWindow(browser)
            Walk(window, address, f"{WORK}/{NOTEBOOKS[0]}").open()
            yield window, address
    finally:
        shutil.rmtree(ROOT / WORK, ignore_errors=True)


@pytest.mark.parametrize("name", [name for name in NOTEBOOKS if name.startswith(KINDS)])
def test_nothing_is_found_wrong(opened: tuple[ChromiumWindow, str], name: str) -> None:
    walk = Walk(*opened, f"{WORK}/{name}", is_one_page=True)
    assert walk.take() == []
    stored = json.loads((ROOT / "notebooks" / name).read_text("utf-8"))
    outputs = [output for cell in stored["cells"] for output in cell.get("outputs", [])]
    assert walk.living == sum(MIME in output.get("data", {}) for output in outputs)
    assert walk.moved.total() > walk.living


def test_what_is_wrong_is_found(opened: tuple[ChromiumWindow, str]) -> None:
    cells = [nbformat.v4.new_code_cell(f"1 / 0  # {ROOT.name}")]  # type: ignore[no-untyped-call]
    for html in FAULTS:
        source = f"from IPython.display import HTML\nHTML({html!r})"
        cells.append(nbformat.v4.new_code_cell(source))  # type: ignore[no-untyped-call]
    kernel = {"name": "python3", "display_name": "Python 3"}
    notebook = nbformat.v4.new_notebook(  # type: ignore[no-untyped-call]
        cells=[*cells[1:], cells[0]], metadata={"kernelspec": kernel}
    )
    nbformat.write(notebook, ROOT / WORK / FAULTY)  # type: ignore[no-untyped-call]
    window, _ = opened
    window.evaluate("() => { window.patienceMs = 300; }")
    findings = Walk(*opened, f"{WORK}/{FAULTY}", is_one_page=True).take()
    expected = [*FAULTS.values(), "ZeroDivisionError"]
    found = "\n".join(findings)
    assert [fault for fault in expected if fault not in found] == []
