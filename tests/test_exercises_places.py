"""Progress is kept wherever a notebook runs, said where, and whatever lies in its place."""

import codecs
import errno
import json
import os
import stat
from collections.abc import Iterator
from pathlib import Path

import pytest
from desk import files_in, line_of, read_file, restart, sit_down
from small_workbook import raiser

import cammotion as cm
from cammotion.teaching import places
from cammotion.teaching.places import FILE, GRADING, SWITCH
from cammotion.teaching.store import LOCK

needs_fifo = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="Windows has no FIFO")


@pytest.fixture(autouse=True)
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sit down in the folder of the copies of a workbook; there is a home beside it."""
    (tmp_path / "home").mkdir()
    yield from sit_down(tmp_path, monkeypatch)


def go_to(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Open a notebook in another folder."""
    folder.mkdir(parents=True, exist_ok=True)
    monkeypatch.chdir(folder)
    restart()


@pytest.mark.parametrize(
    ("place", "kept"),
    [
        ("home/course", "home/course"),  # a hub, with a package that was installed
        ("home/course/work", "home/course/work"),
        ("book/notebooks", "book/notebooks"),  # a copy of the repository, as nbgitpuller makes it
        ("book/notebooks/solutions", "book/notebooks"),
        ("book", "book"),
        ("with ümlaut", "with ümlaut"),
    ],
)
def test_elsewhere_it_is_kept_where_the_notebook_is_and_said_where(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: str, kept: str
) -> None:
    go_to(tmp_path / place, monkeypatch)
    file = tmp_path / kept / FILE
    where = f"Your progress is kept in {file}."
    assert "kept in" not in cm.check("01.1", None).text
    assert cm.check("01.1", 140).text.endswith(where)
    assert "kept in" not in cm.check("01.1", 70).text  # once is enough
    cm.predict("01.half", "mm").field.value = "3"
    restart()
    assert cm.progress().text.endswith(f"\n{where}")
    assert cm.progress().right == 1
    assert cm.predict("01.half", "mm").prediction == "3"
    assert file.is_file()
    assert [*tmp_path.rglob(FILE)] == [file]


def test_the_solutions_beside_copies_elsewhere_keep_it_with_the_copies(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As `--work ~/cam` lays them, whether a lesson or a solution is run first."""
    copies = tmp_path / "cam"
    solutions = copies / "notebooks" / "solutions"
    for folder in (solutions, copies, solutions):
        go_to(folder, monkeypatch)
        (copies / "01_timing_diagram.ipynb").touch()
        cm.check("01.1", 70)
        assert [*tmp_path.rglob(FILE)] == [copies / FILE]


def test_among_the_copies_it_is_said_when_it_is_asked_for(work: Path) -> None:
    assert "kept" not in cm.check("01.1", 70).text
    assert cm.progress().text.endswith(f"\nYour progress is kept in {work / FILE}.")


def test_it_stays_where_it_is_when_the_notebook_changes_its_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_to(tmp_path / "home" / "course", monkeypatch)
    cm.check("01.1", 70)
    monkeypatch.chdir(tmp_path)
    cm.check("01.2", 0.3846)
    assert len(read_file(tmp_path / "home" / "course")["exercises"]) == 2
    assert not (tmp_path / FILE).exists()


def test_a_place_is_not_named_while_nothing_can_be_written_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_to(tmp_path / "home", monkeypatch)
    with monkeypatch.context() as full:
        full.setattr("os.fsync", raiser(OSError(errno.ENOSPC, "full")))
        assert "is kept in" not in cm.check("01.1", 140).text
    assert "is kept in" in cm.check("01.1", 70).text


def close(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Let a folder be one that may only be read, also for root."""
    monkeypatch.setattr(
        os, "access", lambda path, _: not Path(path).resolve().is_relative_to(folder)
    )


def test_a_folder_that_may_only_be_read_gives_way_to_the_home(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    close(tmp_path / "share", monkeypatch)
    go_to(tmp_path / "share" / "notebooks", monkeypatch)
    kept = tmp_path / "home" / "cammotion-progress"
    assert f"Your progress is kept in {kept / FILE}." in cm.check("01.1", 70).text
    assert read_file(kept)["exercises"]["01.1"]["state"] == "right"


def test_where_nothing_can_be_written_that_is_said(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    close(tmp_path, monkeypatch)
    go_to(tmp_path / "share", monkeypatch)
    said = cm.check("01.1", 70).text
    assert "Your progress is kept only until this notebook is closed: it cannot be" in said
    assert f"written in {tmp_path / 'share'} nor in {tmp_path / 'home'}" in said
    assert SWITCH in cm.progress().text
    assert cm.progress().right == 1
    assert not [*tmp_path.rglob(FILE)]


@pytest.mark.parametrize("content", ['{"epochs": 12}', "[1, 2]", '{"a": {"b": {"c": 1}}}', "3"])
def test_a_file_of_another_program_is_left_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, content: str
) -> None:
    theirs = tmp_path / "thesis" / FILE
    theirs.parent.mkdir()
    theirs.write_text(content)
    go_to(theirs.parent, monkeypatch)
    assert "cammotion-progress" in cm.check("01.1", 70).text
    assert theirs.read_text() == content
    assert files_in(theirs.parent) == [FILE]


@needs_fifo
def test_nor_is_what_is_no_file_at_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "thesis"
    folder.mkdir()
    os.mkfifo(folder / FILE)
    go_to(folder, monkeypatch)
    assert "cammotion-progress" in cm.check("01.1", 70).text
    assert stat.S_ISFIFO((folder / FILE).stat().st_mode)


@pytest.mark.parametrize("named", ["~", "", "absolute"])
def test_a_hub_can_name_the_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, named: str
) -> None:
    folder = tmp_path / "deep" / "er" if named == "absolute" else tmp_path / "home" / "kept"
    words = {"~": "~/kept", "": "kept", "absolute": str(folder)}
    monkeypatch.setenv(SWITCH, words[named])
    go_to(tmp_path / "share", monkeypatch)
    assert f"Your progress is kept in {folder / FILE}." in cm.check("01.1", 70).text
    assert (folder / FILE).is_file()
    assert [*(tmp_path / "share").iterdir()] == []


def test_the_home_of_nobody_can_hold_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(SWITCH, "~nobody-of-this-name/course")
    go_to(tmp_path / "share", monkeypatch)
    said = cm.check("01.1", 70).text
    assert "it cannot be written in ~nobody-of-this-name/course. The variable" in said
    assert cm.progress().right == 1
    assert not [*tmp_path.rglob(FILE)]


def test_the_folder_of_copies_goes_before_what_is_named(
    work: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for value in (str(tmp_path / "kept"), "off"):
        monkeypatch.setenv(SWITCH, value)
        restart()
        cm.check("01.1", 70)
        assert (work / FILE).is_file()
        (work / FILE).unlink()


def test_it_can_be_switched_off(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, value in ((SWITCH, "Off"), (GRADING, "1")):
        with monkeypatch.context() as switched:
            switched.setenv(name, value)
            go_to(tmp_path / "course", switched)
            assert "kept" not in cm.check("01.1", 70).text
            assert cm.progress().text.endswith("Your progress is not kept.")
    assert [*tmp_path.rglob(FILE)] == []


def test_a_folder_that_is_gone_before_the_first_answer(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_to(tmp_path / "gone", monkeypatch)
    monkeypatch.setattr(places, "_here", lambda: None)
    assert "cammotion-progress" in cm.check("01.1", 70).text


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-32"])
def test_a_mark_of_the_encoding_is_no_damage(work: Path, encoding: str) -> None:
    """Editors on Windows put one in front."""
    cm.check("01.1", 70)
    cm.variant("Jörg")
    text = json.dumps(read_file(work), ensure_ascii=False)
    (work / FILE).write_text(text, encoding=encoding)
    assert (work / FILE).read_bytes()[:2] in (codecs.BOM_UTF8[:2], codecs.BOM_UTF16_LE)
    restart()
    assert cm.progress().right == 1
    assert cm.check("01.2", 0.3846).note == ""
    assert read_file(work)["learner"]["variant"]["name"] == "Jörg"
    assert files_in(work) == [FILE]


@needs_fifo
@pytest.mark.parametrize("by_link", [False, True])
def test_a_pipe_is_not_waited_for(work: Path, by_link: bool) -> None:
    pipe = work / ("pipe" if by_link else FILE)
    os.mkfifo(pipe)
    if by_link:
        (work / FILE).symlink_to(pipe)
    assert "It was kept as progress-unreadable-1.json" in cm.check("01.1", 70).text
    assert line_of("01.1") == "right, 1 try"
    assert stat.S_ISFIFO((work / "progress-unreadable-1.json").stat().st_mode)
    assert stat.S_ISREG((work / FILE).lstat().st_mode)


@needs_fifo
def test_nor_is_one_with_the_name_of_the_lock(work: Path) -> None:
    os.mkfifo(work / LOCK)
    assert cm.check("01.1", 70).note == ""
    restart()
    assert cm.progress().right == 1


def test_a_link_stays_a_link(work: Path, tmp_path: Path) -> None:
    """To a file that is there, and to one that is not there yet."""
    (tmp_path / "cloud").mkdir()
    (work / FILE).symlink_to(tmp_path / "cloud" / "mine.json")
    for number, (exercise, answer) in enumerate([("01.1", 70), ("01.2", 0.3846)], 1):
        assert cm.check(exercise, answer).note == ""
        restart()
        assert cm.progress().right == number
        assert (work / FILE).is_symlink()
    assert len(json.loads((tmp_path / "cloud" / "mine.json").read_text())["exercises"]) == 2


def test_a_link_that_leads_nowhere_is_said(work: Path, tmp_path: Path) -> None:
    """The stick is not in: what is done is kept until it is."""
    (work / FILE).symlink_to(tmp_path / "stick" / FILE)
    assert "could not be written (No such file or directory)" in cm.check("01.1", 70).text
    assert cm.progress().right == 1
    (tmp_path / "stick").mkdir()
    assert cm.check("01.2", 0.3846).note == ""
    assert len(read_file(tmp_path / "stick")["exercises"]) == 2


def test_a_link_to_itself_is_replaced(work: Path) -> None:
    (work / FILE).symlink_to(FILE)
    assert cm.check("01.1", 70).is_right
    restart()
    assert cm.progress().right == 1


@pytest.mark.skipif(os.name == "nt", reason="Windows knows no such rights")
def test_who_may_read_a_notebook_may_read_the_file(work: Path) -> None:
    """A teacher, say, of the group that owns a shared drive."""
    before = os.umask(0o027)
    try:
        cm.check("01.1", 70)
    finally:
        os.umask(before)
    assert stat.S_IMODE((work / FILE).stat().st_mode) == 0o640


@pytest.mark.skipif(os.name == "nt", reason="Windows knows no such rights")
def test_who_may_read_the_file_stays_as_it_is(work: Path) -> None:
    cm.check("01.1", 70)
    (work / FILE).chmod(0o640)
    cm.check("01.2", 0.3846)
    assert stat.S_IMODE((work / FILE).stat().st_mode) == 0o640


@pytest.mark.parametrize(
    ("content", "is_ours"),
    [("{", True), ("", True), ("{}", True), ("[]", False), ('{"other": 1}', False)],
)
def test_a_damaged_file_is_ours_and_another_ones_is_not(
    tmp_path: Path, content: str, *, is_ours: bool
) -> None:
    folder = tmp_path / "some"
    folder.mkdir()
    (folder / FILE).write_text(content)
    assert places._may_keep(folder) is is_ours
