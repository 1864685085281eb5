"""The learner's copies: they keep every byte, whatever happens to the workbook's notebooks."""

import errno
import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from small_workbook import change, move_starter, notebook, raiser

from starter import commands, copies, notebooks
from starter.errors import WorkbookError


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook."""
    return move_starter(tmp_path, monkeypatch)


def test_copies_survive_edits_and_updates(root: Path) -> None:
    """The learner's files keep every byte; news are said, and new notebooks are laid."""
    work = copies.work_folder("work-anna")
    copies.lay_missing(work)
    assert not copies.notices(work)
    copy = work / "02_maximum_acceleration.ipynb"
    change(copy, "my answer")
    assert not copies.notices(work)
    change(root / "notebooks" / copy.name, "better")
    (root / "notebooks" / "03_overlap.ipynb").write_text(json.dumps(notebook("new")))
    before = {path: path.read_bytes() for path in work.iterdir()}
    copies.lay_missing(work)
    assert {path: path.read_bytes() for path in before} == before
    assert (work / "03_overlap.ipynb").exists()
    (notice,) = copies.notices(work)
    assert notice.startswith("02_maximum_acceleration: the workbook has a newer version")
    assert "fresh 02 --work work-anna" in notice


def test_new_outputs_are_no_new_version(root: Path) -> None:
    """Only the cells' types and sources count."""
    work = copies.work_folder("work")
    copies.lay_missing(work)
    content = notebook("02_maximum_acceleration", output_type="stream", name="stdout", text="4")
    (root / "notebooks" / "02_maximum_acceleration.ipynb").write_text(json.dumps(content))
    assert not copies.notices(work)


def test_a_fresh_copy_ends_the_notices(root: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """`fresh` numbers its copies; any copy with the current version will do."""
    copies.lay_missing(copies.work_folder("work"))
    change(root / "notebooks" / "02_maximum_acceleration.ipynb", "better")
    for wanted, ending in (
        ("02", "-fresh"),
        ("2", "-fresh-2"),
        ("02_maximum_acceleration", "-fresh-3"),
    ):
        assert commands.run(["fresh", wanted]) == 0
        path = Path("work") / f"02_maximum_acceleration{ending}.ipynb"
        assert str(path) in capsys.readouterr().out
        assert (root / path).exists()
    assert not copies.notices(root / "work")


def test_strange_copies_are_left_alone(root: Path) -> None:
    """Unreadable, renamed upstream, or without a note: said in words, not touched."""
    work = copies.work_folder("work")
    copies.lay_missing(work)
    (work / "00_start_here.ipynb").write_text('{"cells": [')
    (work / "02_maximum_acceleration.ipynb").write_text(json.dumps(notebook("my own")))
    (work / "notes.ipynb").write_text(json.dumps(notebook("not of the workbook")))
    (root / "notebooks" / "01_old.ipynb").write_text(json.dumps(notebook("old")))
    copies.lay_missing(work)
    (root / "notebooks" / "01_old.ipynb").unlink()
    before = {path: path.read_bytes() for path in work.iterdir()}
    copies.lay_missing(work)
    assert {path: path.read_bytes() for path in work.iterdir()} == before
    unreadable, gone, silent = copies.notices(work)
    assert unreadable.startswith("00_start_here: your copy is not readable")
    assert gone.startswith("01_old: is no longer part of the workbook")
    assert "does not tell its version" in silent


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL")
def test_a_killed_start_leaves_no_half_copy(root: Path) -> None:
    """Killed while it writes, it leaves at most a part file, which the next start removes."""
    work = copies.work_folder("work")
    script = (
        "import os, signal, sys; sys.path.insert(0, sys.argv[1])\n"
        "from starter import copies\n"
        "os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL)\n"
        "copies.lay_missing(copies.work_folder('work'))"
    )
    killed = subprocess.run([sys.executable, "-c", script, str(root)], check=False)
    assert killed.returncode == -signal.SIGKILL
    assert [path.name for path in work.iterdir()] == [".00_start_here.ipynb.part"]
    copies.lay_missing(work)
    assert sorted(path.name for path in work.iterdir()) == [
        "00_start_here.ipynb",
        "02_maximum_acceleration.ipynb",
    ]


def test_a_full_disk_leaves_no_half_copy(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing stays under the real name, nor under the temporary one."""
    work = copies.work_folder("work")
    monkeypatch.setattr("os.fsync", raiser(OSError(errno.ENOSPC, "full")))
    with pytest.raises(OSError, match="full"):
        copies.lay_missing(work)
    assert not list(work.iterdir())


@pytest.mark.parametrize("links", [True, False])
def test_a_taken_name_is_not_overwritten(monkeypatch: pytest.MonkeyPatch, links: bool) -> None:
    """Not even by a start that did not see the file come, with and without hard links."""
    if not links:
        monkeypatch.setattr("os.link", raiser(OSError(errno.EPERM, "no links")))
    source, work = notebooks.originals()[0], copies.work_folder("work")
    taken, free = work / "taken.ipynb", work / "free.ipynb"
    taken.write_text("mine")
    copies.lay(source, taken)
    copies.lay(source, free)
    assert taken.read_text() == "mine"
    assert json.loads(free.read_text())["metadata"]["workbook"]["source"] == source.name
    assert sorted(path.name for path in work.iterdir()) == ["free.ipynb", "taken.ipynb"]


@pytest.mark.parametrize("name", ["workbook.py", "notebooks", "work/x", "../work", "work x", ""])
def test_other_folders_are_refused(name: str) -> None:
    """Only what .gitignore keeps out of commits can hold the learner's copies."""
    with pytest.raises(WorkbookError, match="work-anna"):
        copies.work_folder(name)
