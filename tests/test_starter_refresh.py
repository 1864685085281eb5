"""Notebooks executed anew: all or nothing, and the same bytes every time."""

import json
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from small_workbook import move_starter, notebook, raiser

from starter import commands, environment, notebooks, refresh
from starter.errors import WorkbookError

WIDGET = "application/vnd.jupyter.widget-view+json"
SLIDER = "import ipywidgets\nipywidgets.IntSlider(7)"


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook, with the environment that runs the tests."""
    root = move_starter(tmp_path, monkeypatch)
    monkeypatch.setattr(refresh, "VENV_PYTHON", Path(sys.executable))
    monkeypatch.setattr(environment, "ensure", lambda: None)
    return root


def test_when_a_cell_ran_is_not_kept() -> None:
    cell = {"cell_type": "code", "metadata": {"execution": {"iopub.status.idle": "2026"}, "a": 1}}
    refresh.remove_traces(cell)
    assert cell["metadata"] == {"a": 1}


def test_refresh_is_repeatable(tmp_path: Path) -> None:
    """Twice the same bytes: no trace of when and where, of former outputs or a widget's id."""
    raw = notebook("print(1, flush=True)\nprint(2, flush=True)", "1 + 2", SLIDER)
    used = notebook(*("".join(cell["source"]) for cell in raw["cells"]), **showing({WIDGET: "{}"}))
    used["metadata"] = {"widgets": {}, "language_info": {"name": "python", "version": "3.0"}}
    paths = notebooks.originals()
    for path, content in zip(paths, (raw, used), strict=True):
        path.write_text(json.dumps(content))
    folders = [tmp_path / path.stem for path in paths]
    with ThreadPoolExecutor() as pool:  # at the same time, for it takes seconds
        once, twice = pool.map(refresh.execute, paths, folders)
    assert json.dumps(once) == json.dumps(twice)
    assert once["metadata"] == refresh.NOTEBOOK_METADATA
    assert [cell["execution_count"] for cell in once["cells"]] == [1, 2, 3]
    assert [cell["id"] for cell in once["cells"]] == ["cell-0", "cell-1", "cell-2"]
    printed, three, slider = ([*cell["outputs"]] for cell in once["cells"])
    assert [output["text"] for output in printed] == [["1\n", "2\n"]]
    assert [output["data"] for output in three] == [{"text/plain": ["3"]}]
    assert [output["data"] for output in slider] == [{"text/plain": ["IntSlider(value=7)"]}]


def showing(data: dict[str, Any]) -> dict[str, Any]:
    """Make an output that shows this."""
    return {"output_type": "display_data", "metadata": {}, "data": data}


@pytest.mark.parametrize(
    ("shown", "stored"),
    [
        (["image/png", "text/plain", WIDGET], ["image/png", "text/plain"]),
        (["text/html"], ["text/html"]),
        ([WIDGET], ["text/plain"]),
    ],
)
def test_a_widgets_id_is_not_stored(shown: list[str], stored: list[str]) -> None:
    """What stands beside it stays, and something does even if it stood alone."""
    output = showing(dict.fromkeys(shown, "x"))
    refresh.drop_widget_view(output)
    assert list(output["data"]) == stored


def test_a_picture_is_stored_as_a_png_with_its_words() -> None:
    """And nothing else is: HTML that holds none stays."""
    picture = '<style></style><img class="cm-paper" alt="a" src="data:image/png;base64,AA==">'
    shown, other = (showing({"text/html": html, "text/plain": "a"}) for html in (picture, "<b>"))
    for output in (shown, other):
        refresh.keep_as_png(output)
    assert shown["data"] == {"image/png": "AA==", "text/plain": "a"}
    assert shown["metadata"] == {"image/png": {"alt": "a"}}
    assert other["data"] == {"text/html": "<b>", "text/plain": "a"}


def test_refresh_replaces_all_or_nothing(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """If the second notebook fails, the first is not replaced either."""
    failure = WorkbookError("cell 2 raised ZeroDivisionError")
    results = iter([lambda: notebook("new"), raiser(failure)])
    monkeypatch.setattr(refresh, "execute", lambda _path, _folder: next(results)())
    before = [path.read_bytes() for path in notebooks.originals()]
    assert commands.run(["refresh"]) == 1
    assert "cell 2 raised ZeroDivisionError" in capsys.readouterr().err
    assert [path.read_bytes() for path in notebooks.originals()] == before


@pytest.mark.parametrize("chosen", [["02"], []])
def test_refresh_takes_those_named_or_all(
    root: Path, monkeypatch: pytest.MonkeyPatch, chosen: list[str]
) -> None:
    """They are written as nbformat writes them, and nothing else stays."""
    monkeypatch.setattr(refresh, "execute", lambda _path, _folder: notebook("new"))
    first, second = notebooks.originals()
    before = first.read_text()
    assert commands.run(["refresh", *chosen]) == 0
    new = json.dumps(notebook("new"), indent=1, sort_keys=True) + "\n"
    assert second.read_text() == new
    assert first.read_text() == (before if chosen else new)
    assert sorted((root / "notebooks").iterdir()) == [first, second]


@pytest.mark.parametrize(
    ("chosen", "order"),
    [
        (
            [],
            ["00_start_here", "02_maximum_acceleration", "solutions/02_answers", "solutions/99_x"],
        ),
        (["2"], ["02_maximum_acceleration", "solutions/02_answers"]),
        (["00"], ["00_start_here"]),
    ],
)
def test_solutions_are_refreshed_after_their_lessons(
    root: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    chosen: list[str],
    order: list[str],
) -> None:
    """A number means the lesson and its solution."""
    monkeypatch.setattr(refresh, "execute", lambda _path, _folder: notebook("new"))
    (root / "notebooks" / "solutions").mkdir()
    for name in ("99_x", "02_answers"):
        (root / "notebooks" / "solutions" / f"{name}.ipynb").write_text(json.dumps(notebook("old")))
    assert commands.run(["refresh", *chosen]) == 0
    assert [line.split()[1] for line in capsys.readouterr().out.splitlines()] == order
    for path in [*notebooks.originals(), *notebooks.solutions()]:
        assert ("new" in path.read_text()) == (refresh.name_of(path) in order)


def test_the_failing_cell_is_named() -> None:
    """An error that a cell announces by its tag is none."""
    content = notebook("1 / 0", output_type="error", ename="ZeroDivisionError", evalue="by zero")
    assert refresh.first_error(content) == "cell 1 raised ZeroDivisionError: by zero"
    content["cells"][0]["metadata"]["tags"] = ["raises-exception"]
    assert not refresh.first_error(content)
