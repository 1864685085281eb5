"""The learner's copies: they keep every byte, whatever happens to the workbook's notebooks."""

import errno
import json
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from small_workbook import change, keep, move_starter, notebook, raiser

from starter import commands, copies, environment, folder, notebooks
from starter.errors import WorkbookError


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook, whose environment is ready."""
    monkeypatch.setattr(environment, "ensure", lambda: None)
    return move_starter(tmp_path, monkeypatch)


@pytest.fixture
def start(capsys: pytest.CaptureFixture[str]) -> Callable[..., list[str]]:
    """Return a function that starts the workbook and returns the lines that it says."""

    def start(*arguments: str) -> list[str]:
        assert commands.run([*(arguments or ["setup"])]) == 0
        return capsys.readouterr().out.splitlines()

    return start


def rename(path: Path, name: str) -> None:
    """Rename a notebook."""
    path.rename(path.with_name(f"{name}.ipynb"))


@pytest.mark.parametrize("option", [[], ["--work", "work-anna"]])
def test_an_edit_survives_an_update(
    root: Path, start: Callable[..., list[str]], option: list[str]
) -> None:
    """The news are said, with the command that works, as often as one starts; no byte changes."""
    assert start("setup", *option)[0].startswith("Copied all 2 notebooks to work")
    work = root / ["work", *option][-1]
    copy = work / "02_maximum_acceleration.ipynb"
    change(copy, "my answer")
    (work / "progress.json").write_text('{"02.1": "right"}')
    change(root / "notebooks" / copy.name, "better")
    (root / "notebooks" / "03_overlap.ipynb").write_text(json.dumps(notebook("new")))
    mine = keep(work)
    assert start("setup", *option)[0].startswith("Copied 03_overlap to work")
    news, ready = start("setup", *option)
    assert [news, ready] == start("setup", *option)
    assert ready.startswith("The workbook is ready")
    assert news.startswith("02_maximum_acceleration: the workbook has a newer version")
    assert "Yours is untouched" in news
    command = news.split("`")[1].split()
    assert command[1:] == ["workbook.py", "fresh", "02", *option]
    for ending in ("fresh", "fresh-2", "fresh-3"):
        laid = work / f"{copy.stem}-{ending}.ipynb"
        assert start(*command[2:]) == [f"A fresh copy: {laid.relative_to(root)}"]
        assert mine.items() <= keep(work).items()
        change(laid, f"my answer in {laid.stem}")
        mine = keep(work)
    assert start("setup", *option) == [ready]
    assert keep(work) == mine


def test_new_outputs_are_no_new_version(root: Path) -> None:
    """Only the cells' types and sources count."""
    work = folder.find("work")
    copies.lay_missing(work)
    content = notebook("02_maximum_acceleration", output_type="stream", name="stdout", text="4")
    (root / "notebooks" / "02_maximum_acceleration.ipynb").write_text(json.dumps(content))
    assert not copies.notices(work)


def test_fresh_takes_a_number_or_a_name_of_a_lesson(
    root: Path, start: Callable[..., list[str]]
) -> None:
    """The solution has the same number, and is not copied."""
    add_solution(root)
    for wanted in ("02", "2", "02_maximum_acceleration", "02_maximum_acceleration.ipynb"):
        start("fresh", wanted)
    with pytest.raises(WorkbookError, match="There is no notebook ''"):
        notebooks.find("")
    laid = [json.loads(path.read_text()) for path in (root / "work").iterdir()]
    assert len(laid) == 4
    assert all(copy["cells"][0]["source"] == ["02_maximum_acceleration"] for copy in laid)


def add_solution(root: Path) -> Path:
    """Add a solution to the workbook."""
    path = root / "notebooks" / "solutions" / "02_answers.ipynb"
    path.parent.mkdir()
    path.write_text(json.dumps(notebook("solved")))
    return path


def test_solutions_are_not_copied_but_reached(root: Path, start: Callable[..., list[str]]) -> None:
    """A link in a lesson leads from the learner's copy to the same file as from the original."""
    solution = add_solution(root)
    lesson = root / "notebooks" / "02_maximum_acceleration.ipynb"
    link = "../notebooks/solutions/02_answers.ipynb"
    change(lesson, f"[the solution]({link})")
    start()
    assert sorted(keep(root / "work")) == ["00_start_here.ipynb", lesson.name]
    copy = root / "work" / lesson.name
    assert link in copy.read_text()
    assert (copy.parent / link).samefile(solution)
    assert (lesson.parent / link).samefile(solution)


@pytest.mark.parametrize(
    ("now", "words"),
    [
        ("02_accelerations", " (02 is 02_accelerations now)"),
        ("05_maximum_acceleration", " (it is 05_maximum_acceleration now)"),
        ("05_accelerations", ""),
        ("", ""),
    ],
)
def test_a_notebook_renamed_or_removed_upstream_stays(
    root: Path, start: Callable[..., list[str]], now: str, words: str
) -> None:
    """It is said which one it was and where it went, and what is new is laid as usual."""
    start()
    start("fresh", "02")
    work = root / "work"
    rename(work / "02_maximum_acceleration-fresh.ipynb", "mine")
    change(work / "02_maximum_acceleration.ipynb", "my answer")
    mine = keep(work)
    original = root / "notebooks" / "02_maximum_acceleration.ipynb"
    if now:
        rename(original, now)
    else:
        original.unlink()
    *copied, gone, ready = start()
    assert copied == ([f"Copied {now} to work/, which is yours to write in."] if now else [])
    new = {f"{now}.ipynb"} if now else set()
    assert set(keep(work)) == {*mine, *new}
    assert mine.items() <= keep(work).items()
    assert start() == [gone, ready]
    assert gone == (
        f"02_maximum_acceleration: the workbook no longer has a notebook of this name{words}. "
        "Yours (02_maximum_acceleration, mine) is untouched."
    )


def test_renumbered_notebooks_are_told_by_their_titles(
    root: Path, start: Callable[..., list[str]]
) -> None:
    """Also when another one has the number now."""
    start()
    rename(root / "notebooks" / "02_maximum_acceleration.ipynb", "03_maximum_acceleration")
    (root / "notebooks" / "02_new.ipynb").write_text(json.dumps(notebook("new")))
    assert "(it is 03_maximum_acceleration now)" in start()[1]


def test_a_deleted_copy_comes_back_and_a_renamed_one_stays(
    root: Path, start: Callable[..., list[str]]
) -> None:
    """Under a name that another notebook needs, it stays too, and this is said."""
    start()
    work = root / "work"
    (work / "00_start_here.ipynb").unlink()
    rename(work / "02_maximum_acceleration.ipynb", "03_overlap")
    (root / "notebooks" / "03_overlap.ipynb").write_text(json.dumps(notebook("new")))
    mine = keep(work)
    copied, taken, _ready = start()
    assert copied.startswith("Copied 00_start_here, 02_maximum_acceleration to work/")
    assert mine.items() <= keep(work).items()
    assert taken.startswith("03_overlap: what you have by this name is a copy of another notebook")
    start(*taken.split("`")[1].split()[2:])
    assert len(start()) == 1


def make_link(path: Path) -> None:
    """Put a link to nowhere in place of a file."""
    path.unlink()
    path.symlink_to("nowhere")


def make_folder(path: Path) -> None:
    """Put a folder in place of a file."""
    path.unlink()
    path.mkdir()


@pytest.mark.parametrize(
    "spoil",
    [
        lambda path: path.write_text('{"cells": ['),
        lambda path: path.write_text(""),
        lambda path: path.write_text("[" * 100_000),
        lambda path: path.write_text("[]"),
        lambda path: path.write_bytes(b"\xff\xfe"),
        make_folder,
        pytest.param(
            make_link, marks=pytest.mark.skipif(sys.platform == "win32", reason="links need rights")
        ),
    ],
)
def test_an_unreadable_copy_is_left_alone_and_said(
    root: Path, start: Callable[..., list[str]], spoil: Callable[[Path], object]
) -> None:
    """Half a notebook, an empty one, no text at all, a folder, a link to nowhere."""
    start()
    spoil(root / "work" / "00_start_here.ipynb")
    (root / "work" / "my own.ipynb").write_text("")
    mine = keep(root / "work")
    first, second, _ready = start()
    trouble = "what you have by this name is not readable as a notebook. Yours is untouched"
    assert first.startswith(f"00_start_here: {trouble}; `")
    assert second == f"my own: {trouble}."
    assert keep(root / "work") == mine
    start(*first.split("`")[1].split()[2:])
    assert mine.items() <= keep(root / "work").items()
    assert "`" not in start()[0], "there is a fresh copy already"


def test_a_copy_without_its_note_is_left_alone(root: Path, start: Callable[..., list[str]]) -> None:
    """Some tools drop the note, or write odd things; notebooks of the learner's own have none."""
    start()
    work = root / "work"
    (work / "02_maximum_acceleration.ipynb").write_text(json.dumps(notebook("my own")))
    (work / "notes.ipynb").write_text(json.dumps(notebook("not of the workbook")))
    odd = notebook("odd")
    notes: list[object] = [None, 1, "x", {}, {"source": [], "version": {}}]
    for number, note in enumerate(notes):
        odd["metadata"]["workbook"] = note
        (work / f"odd-{number}.ipynb").write_text(json.dumps(odd))
    mine = keep(work)
    said = start()
    assert keep(work) == mine
    assert len(said) == 3
    assert said[0].startswith("02_maximum_acceleration: your copy differs from the workbook's and")
    assert said[1].startswith("[]: the workbook no longer has")


def test_files_that_the_starter_did_not_lay_are_not_touched(
    root: Path, start: Callable[..., list[str]]
) -> None:
    """The package's progress, half a download, what macOS and JupyterLab put beside a file."""
    work = folder.find("work")
    for name in (
        "progress.json",
        ".progress.json.part",
        ".film.part",
        ".02_maximum_acceleration.ipynb.part",
        "._02_maximum_acceleration.ipynb",
        ".~02_maximum_acceleration.ipynb",
        "my own/02_maximum_acceleration.ipynb",
    ):
        (work / name).parent.mkdir(exist_ok=True)
        (work / name).write_bytes(b"mine")
    (work / ".folder.part").mkdir()
    (root / "notebooks" / "._00_start_here.ipynb").write_bytes(b"macOS")
    mine = keep(work)
    assert len(start()) == 2
    assert mine.items() <= keep(work).items()
    assert set(keep(work)) - set(mine) == {"00_start_here.ipynb", "02_maximum_acceleration.ipynb"}


@pytest.mark.parametrize("links", [True, False])
def test_a_taken_name_is_not_overwritten(monkeypatch: pytest.MonkeyPatch, links: bool) -> None:
    """Not even by a start that did not see the file come, with and without hard links."""
    if not links:
        monkeypatch.setattr("os.link", raiser(OSError(errno.EPERM, "no links")))
    source, work = notebooks.originals()[0], folder.find("work")
    taken, free = work / "taken.ipynb", work / "free.ipynb"
    taken.write_text("mine")
    assert not copies.lay(source, taken, work)
    assert copies.lay(source, free, work)
    assert taken.read_text() == "mine"
    assert json.loads(free.read_text())["metadata"]["workbook"]["source"] == source.name
    assert sorted(path.name for path in work.iterdir()) == ["free.ipynb", "taken.ipynb"]


@pytest.mark.parametrize(
    "name", ["workbook.py", "notebooks", "work/x", "work x", "", ".", "./anna", "../wörk book/a"]
)
def test_other_folders_of_the_workbook_are_refused(
    root: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    """Only what .gitignore keeps out of commits can hold the learner's copies."""
    monkeypatch.chdir(root)
    with pytest.raises(WorkbookError, match="work-anna"):
        folder.find(name)


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights")
def test_a_work_folder_that_is_none_is_refused(root: Path) -> None:
    """A link to a folder elsewhere is one; a file, or a link to nowhere, is not."""
    (root / "work").symlink_to("elsewhere")
    with pytest.raises(WorkbookError, match="link to nowhere"):
        folder.find("work")
    (root / "elsewhere").mkdir()
    copies.lay_missing(folder.find("work"))
    assert len(list((root / "elsewhere").iterdir())) == 2
    (root / "work-file").write_text("mine")
    with pytest.raises(WorkbookError, match="work-file is a file"):
        folder.find("work-file")


def lay_a_table(root: Path) -> Path:
    """Put a table into the workbook, and return it."""
    table = root / "notebooks" / "data" / "cam.csv"
    table.parent.mkdir()
    table.write_bytes(b"angle in deg,position in mm\r\n0,0\r\n")
    return table


def test_tables_that_lessons_read_are_laid_and_never_written_over(
    root: Path, start: Callable[..., list[str]]
) -> None:
    table = lay_a_table(root)
    (table.parent / ".hidden.csv").write_text("")
    start("setup", "--work", "work-anna")
    laid = root / "work-anna" / "data" / "cam.csv"
    assert laid.read_bytes() == table.read_bytes()
    assert [path.name for path in laid.parent.iterdir()] == ["cam.csv"]
    assert not [*(root / "work-anna").glob(".*.part")]
    laid.write_text("mine")
    table.write_text("newer")
    start("setup", "--work", "work-anna")
    assert laid.read_text() == "mine"
    laid.unlink()
    start("setup", "--work", "work-anna")
    assert laid.read_text() == "newer"


def test_a_file_in_the_place_of_the_folder_of_tables_stays(
    root: Path, start: Callable[..., list[str]]
) -> None:
    lay_a_table(root)
    (root / "work").mkdir()
    (root / "work" / "data").write_text("mine")
    assert "work/data is no folder: cam.csv was not laid." in start("setup")
    assert (root / "work" / "data").read_text() == "mine"
