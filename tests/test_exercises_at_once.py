"""Several notebooks write the progress at once, whatever the folder knows of locks."""

import errno
import json
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path

import pytest
from desk import files_in, read_file, restart, sit_down

import cammotion as cm
from cammotion.teaching import lock, store
from cammotion.teaching.places import FILE
from cammotion.teaching.store import LOCK

ANSWERS = 40
BUSY = """
import errno, os, sys
from cammotion.teaching.places import find_place
from cammotion.teaching.store import Store, count

def refuse(*_):
    raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

if "no locks" in sys.argv[2]:
    import fcntl
    fcntl.flock = refuse
store = Store(find_place)
print("ready", flush=True)
sys.stdin.readline()
for i in range(int(sys.argv[3])):
    store.change("exercises", "01.1", lambda before: {"tries": count(before, "tries") + 1})
    store.update("predictions", f"{sys.argv[1]}.{i}", text=str(i))
print(store.complaint)
"""
"""Counts in one record, as its twins do, and makes records of its own."""


@pytest.fixture(autouse=True)
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sit down in the folder of the copies of a workbook."""
    yield from sit_down(tmp_path, monkeypatch)


def set_to_work(folders: list[Path], how: str = "", answers: int = ANSWERS) -> list[str]:
    """Let a process in each folder answer at the same time; return what they say at the end."""
    kernels = [
        subprocess.Popen(
            [sys.executable, "-c", BUSY, str(number), how, str(answers)],
            cwd=folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        for number, folder in enumerate(folders)
    ]
    for kernel in kernels:
        assert kernel.stdout is not None
        assert kernel.stdout.readline() == "ready\n"
    for kernel in kernels:
        assert kernel.stdin is not None
        kernel.stdin.write("go\n")
        kernel.stdin.flush()
    said = [kernel.communicate(timeout=120)[0].strip() for kernel in kernels]
    assert [kernel.returncode for kernel in kernels] == [0] * len(kernels)
    return said


def assert_nothing_is_lost(folder: Path, kernels: int) -> None:
    content = read_file(folder)
    assert content["exercises"]["01.1"]["tries"] == ANSWERS * kernels
    assert len(content["predictions"]) == ANSWERS * kernels


@pytest.mark.parametrize("kernels", [2, 4])
def test_kernels_that_write_at_once_lose_nothing(work: Path, kernels: int) -> None:
    assert set_to_work([work] * kernels) == [""] * kernels
    assert_nothing_is_lost(work, kernels)
    assert files_in(work) == [FILE]


@pytest.mark.skipif(sys.platform == "win32", reason="its locks are there on every drive")
def test_nor_where_the_folder_knows_no_locks(work: Path) -> None:
    """As on some network drives: a file that is there or not takes the place of the lock."""
    assert set_to_work([work, work], "no locks") == ["", ""]
    assert_nothing_is_lost(work, 2)
    assert files_in(work) == [FILE]


def test_nor_where_something_else_has_the_name_of_the_lock(work: Path) -> None:
    (work / LOCK).mkdir()
    assert set_to_work([work, work]) == ["", ""]
    assert_nothing_is_lost(work, 2)


def test_nor_where_two_folders_share_a_file_by_links(work: Path) -> None:
    """A learner who keeps the file in a folder that is synchronized, say."""
    shared, other = work.parent / "cloud", work.parent / "work-other"
    for folder in (shared, other):
        folder.mkdir()
    for folder in (work, other):
        (folder / FILE).symlink_to(shared / FILE)
    assert set_to_work([work, other]) == ["", ""]
    assert_nothing_is_lost(shared, 2)
    assert all((folder / FILE).is_symlink() for folder in (work, other))


@pytest.fixture
def held(work: Path) -> Iterator[threading.Event]:
    """Let somebody hold the lock until the event is set."""
    holds, over = threading.Event(), threading.Event()

    def hold() -> None:
        with lock.only_one(work / LOCK, 1):
            holds.set()
            over.wait(30)

    holder = threading.Thread(target=hold)
    holder.start()
    assert holds.wait(30)
    yield over
    over.set()
    holder.join()


def test_who_has_waited_once_waits_no_longer_until_the_lock_is_free(
    held: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    waited: list[float] = []
    long, short = store._PATIENCE_S, store._WHEN_TRIED_S

    def soon(file: Path, seconds: float) -> AbstractContextManager[None]:
        waited.append(seconds)
        return lock.only_one(file, 0.01 if not held.is_set() else 30)

    monkeypatch.setattr(store, "only_one", soon)
    restart()
    for answer in (140, 70):
        cm.check("01.1", answer)
    assert waited == [long, *[short] * (len(waited) - 1)]
    assert len(waited) > 1
    held.set()
    waited.clear()
    for answer in (140, 70):
        cm.check("01.1", answer)
    assert waited == [short, *[long] * (len(waited) - 1)]
    assert len(waited) > 1


def test_while_a_lock_is_held_for_long_nothing_is_written_and_nothing_lost(
    work: Path, held: threading.Event, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Writing without the lock would lose what its holder writes."""
    monkeypatch.setattr(store, "_PATIENCE_S", 0.05)
    restart()
    said = cm.check("01.1", 140)
    assert "could not be written (another notebook has been writing to it" in said.text
    assert cm.check("01.1", 70).is_right
    assert cm.progress().right == 1
    assert files_in(work) == []
    held.set()
    theirs = {"01.1": {"tries": 5, "state": "wrong", "who": ""}, "01.2": {"state": "right"}}
    (work / FILE).write_text(json.dumps({"exercises": theirs}))
    for _ in range(100):  # the holder is let go now
        if not cm.check("01.3", 1).note:
            break
    exercises = read_file(work)["exercises"]
    assert exercises["01.1"]["tries"] == 7  # made again on what the file then held
    assert exercises["01.1"]["state"] == "right"
    assert exercises["01.2"] == {"state": "right"}


def test_a_kernel_that_was_killed_while_it_held_the_lock_stops_nobody(work: Path) -> None:
    """Neither kind of lock."""
    for flock in ("", "import fcntl; fcntl.flock = no; "):
        killed = (
            "import os; from pathlib import Path; from cammotion.teaching import lock\n"
            f"def no(*_): raise OSError({errno.ENOLCK}, 'no')\n"
            f"{flock}lock.only_one(Path({LOCK!r}), 1).__enter__(); os._exit(1)"
        )
        ran = subprocess.run([sys.executable, "-c", killed], cwd=work, check=False)
        assert ran.returncode == 1
    assert set_to_work([work], answers=1) == [""]
    if sys.platform != "win32":
        assert set_to_work([work], "no locks", answers=1) == [""]
    assert read_file(work)["exercises"]["01.1"]["tries"] == 2
