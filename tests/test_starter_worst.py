"""The worst for the learner's copies: a start that is killed, a full disk, two starts at once."""

import errno
import json
import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from small_workbook import keep, move_starter, notebook, raiser

from starter import browser, commands, copies, environment, notebooks

NAMES = {"00_start_here.ipynb", "02_maximum_acceleration.ipynb"}
LEARNERS = {
    "01_mine.ipynb": b'{"cells": [], "metadata": {}}',
    "progress.json": b'{"02.1": "right"}',
    ".film.part": b"half a download",
}
needs_fork = pytest.mark.skipif(sys.platform == "win32", reason="no fork, no SIGKILL, no flock")

# What the child processes below have in common: the small workbook, whose environment is ready.
READY = """
import json, os, signal, sys
sys.path.insert(0, sys.argv[1])
from starter import commands, copies, environment, folder
environment.ensure = lambda: None

def fork():
    child = os.fork()
    if not child:
        sys.stdout = open(os.devnull, "w")
    return child
"""


@pytest.fixture(autouse=True)
def root(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Work in a small workbook, whose environment is ready, in a folder the learner has used."""
    monkeypatch.setattr(environment, "ensure", lambda: None)
    root = move_starter(tmp_path, monkeypatch)
    # So long that only a part of it is in the file before the end is written.
    long = json.dumps(notebook("02_maximum_acceleration", "x" * 30_000))
    (root / "notebooks" / "02_maximum_acceleration.ipynb").write_text(long)
    (root / "work").mkdir()
    for name, content in LEARNERS.items():
        (root / "work" / name).write_bytes(content)
    return root


def run_ready(root: Path, script: str) -> str:
    """Run a script with the starter of a small workbook and return what it says."""
    command = [sys.executable, "-c", READY + script, str(root)]
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout


def whole_copies(root: Path) -> dict[str, bytes]:
    """Return what the copies are when nothing goes wrong."""
    shutil.copytree(root / "work", root / "work-well")
    copies.lay_missing(root / "work-well")
    return {name: (root / "work-well" / name).read_bytes() for name in NAMES}


# Start in a folder for each moment, and be killed there before the next line runs.
KILL_AT_EVERY_LINE = """
import shutil
os.fsync = lambda _: None  # it matters only when the power fails

def killer(lines):
    def trace(frame, event, argument):
        nonlocal lines
        if not frame.f_code.co_filename.startswith(sys.argv[1]):
            return None
        lines -= event == "line"
        if lines < 0:
            os.kill(os.getpid(), signal.SIGKILL)
        return trace
    return trace

def is_killed(lines):
    work = folder.find(f"work-{lines}")
    child = fork()
    if not child:
        sys.settrace(killer(lines))
        copies.lay_missing(work)
        os._exit(0)
    return os.waitpid(child, 0)[1] == signal.SIGKILL

lines = 0
shutil.copytree(folder.ROOT / "work", folder.ROOT / "work-0")
while is_killed(lines):
    lines += 1
    shutil.copytree(folder.ROOT / "work", folder.ROOT / f"work-{lines}")
print(lines)
"""


@needs_fork
def test_a_start_may_be_killed_at_any_line(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No half copy has a copy's name, the learner's files stay, and the next start mends all."""
    monkeypatch.setattr("os.fsync", lambda _: None)
    whole = whole_copies(root)
    moments = int(run_ready(root, KILL_AT_EVERY_LINE))
    halves = 0
    for moment in range(moments):
        work = root / f"work-{moment}"
        left = keep(work)
        parts = [name for name in left if copies.PART.fullmatch(name)]
        assert len(parts) <= 1
        assert {name: left[name] for name in left if name not in parts}.items() <= (
            LEARNERS | whole
        ).items()
        halves += any(left[name] not in whole.values() for name in parts)
        copies.lay_missing(work)
        assert keep(work) == LEARNERS | whole
    assert moments > 50
    assert halves > 2, "it was killed in the middle of writing too"


KILL_WHILE_WRITING = """
for _ in range(5):
    child = fork()
    if not child:
        os.fsync = lambda _: os.kill(os.getpid(), signal.SIGKILL)
        commands.run(sys.argv[2:] or ["setup"])
    assert os.waitpid(child, 0)[1] == signal.SIGKILL
    print(len(os.listdir(folder.ROOT / "work")))
"""


@needs_fork
def test_litter_does_not_grow_with_each_kill(root: Path) -> None:
    """A start removes what the one before it left."""
    one_more = len(LEARNERS) + 1
    assert run_ready(root, KILL_WHILE_WRITING).split() == [str(one_more)] * 5


def test_a_page_that_a_killed_lab_left_goes(root: Path) -> None:
    """It holds a token; that of a lab started just now stays, and so does what is not ours."""
    work = root / "work"
    for name in ("lab-page-abcd_123", "lab-page-empty_12", "lab-page-just_now", "lab-page-mine"):
        (work / f".{name}").mkdir()
        if "empty" not in name:
            (work / f".{name}" / browser.PAGE).write_text("token")
        if "just_now" not in name:
            os.utime(work / f".{name}", (time.time() - 100,) * 2)
    with browser.private_folder(work) as private:
        left = {path.name for path in work.iterdir() if path.is_dir()}
    assert left == {private.name, ".lab-page-just_now", ".lab-page-mine"}
    assert browser.PRIVATE_NAME.fullmatch(private.name)
    assert not private.exists()


def fail_to_open(path: Path, mode: str = "r", *arguments: Any, **options: Any) -> Any:
    """Open a file, unless it is to be written."""
    if "w" in mode:
        raise OSError(errno.ENOSPC, "full", str(path))
    return OPEN(path, mode, *arguments, **options)


OPEN = Path.open
FULL = raiser(OSError(errno.ENOSPC, "full"))


@pytest.mark.parametrize("arguments", [["setup"], ["fresh", "02"]])
@pytest.mark.parametrize(
    "step",
    [
        {"pathlib.Path.open": fail_to_open},
        {"os.fsync": FULL},
        {"os.link": FULL, "pathlib.Path.rename": FULL},
        {"pathlib.Path.mkdir": FULL},
    ],
    ids=" and ".join,
)
def test_a_disk_full_at_any_step_is_said(
    root: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    step: dict[str, Callable[..., Any]],
    arguments: list[str],
) -> None:
    """Nothing half-made stays, nothing of the learner's goes, and the next start works."""
    whole = whole_copies(root)
    with monkeypatch.context() as full:
        for name, fail in step.items():
            full.setattr(name, fail)
        assert commands.run(arguments) == 1
    assert "The disk is full. Make room and start again." in capsys.readouterr().err
    assert keep(root / "work") == LEARNERS
    assert commands.run(["setup"]) == 0
    assert keep(root / "work") == LEARNERS | whole


# Leave so many pages free and start; make room and start again; take away what was laid.
FILL = """
import contextlib, io
work, filler = folder.ROOT / "work", folder.ROOT / "work" / "filler"

def start():
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()):
        code = commands.run(["setup"])
    return code, said.getvalue(), {
        path.name: path.read_bytes().decode() for path in work.iterdir() if path != filler
    }

for pages in range(40):
    with contextlib.suppress(OSError), filler.open("wb", buffering=0) as file:
        while file.write(bytes(4096)):
            pass
    os.truncate(filler, filler.stat().st_size - 4096 * pages)
    full = start()
    filler.unlink()
    print(json.dumps([full, start()]))
    for name in os.listdir(work):
        if name.startswith(("00", "02")):
            (work / name).unlink()
"""
ON_A_SMALL_DISK = """
mount -t tmpfs -o size=400k none "$1/work" && cp -R "$1/work-mine/." "$1/work" && "$2" -c "$3" "$1"
"""


def can_mount() -> bool:
    """Tell whether we may mount a disk of our own that nobody else sees."""
    unshare = shutil.which("unshare") if sys.platform == "linux" else None
    command = [str(unshare), "-Urm", "mount", "-t", "tmpfs", "none", "/tmp"]  # noqa: S108
    return unshare is not None and subprocess.run(command, check=False).returncode == 0


@pytest.mark.skipif(not can_mount(), reason="no disk of our own can be mounted here")
def test_a_disk_that_is_really_full(root: Path) -> None:
    """Whole copies or none, however many pages are free: words, and well when there is room."""
    before = {name: content.decode() for name, content in LEARNERS.items()}
    whole = {name: content.decode() for name, content in whole_copies(root).items()}
    (root / "work").rename(root / "work-mine")
    (root / "work").mkdir()
    unshare = ["unshare", "-Urm", "sh", "-c", ON_A_SMALL_DISK, "sh"]
    command = [*unshare, str(root), sys.executable, READY + FILL]
    said = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True).stdout
    results = [json.loads(line) for line in said.splitlines()]
    for (code, words, left), again in results:
        assert (code == 0) == (left == before | whole)
        assert (code, words) in [(0, ""), (1, "The disk is full. Make room and start again.\n")]
        assert left.items() <= (before | whole).items()
        assert again == [0, "", before | whole]
    assert {len(left) for (_, _, left), _ in results} == {3, 4, 5}, "none, one and both copied"


def test_what_may_only_be_read_is_said(
    root: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """If nothing is missing nothing is written, even if litter cannot be removed."""
    refuse = raiser(PermissionError(errno.EACCES, "no", str(root / "work")))
    with monkeypatch.context() as closed:
        closed.setattr(notebooks, "write", refuse)
        assert commands.run(["setup"]) == 1
    assert f"No permission to write {root / 'work'}" in capsys.readouterr().err
    assert keep(root / "work") == LEARNERS
    copies.lay_missing(root / "work")
    (root / "work" / ".00_start_here.ipynb.0123456789abcdef.part").write_text("half")
    mine = keep(root / "work")
    for name in ("pathlib.Path.unlink", "os.link", "pathlib.Path.rename"):
        monkeypatch.setattr(name, refuse)
    monkeypatch.setattr(notebooks, "write", refuse)
    assert commands.run(["setup"]) == 0
    assert keep(root / "work") == mine


# Four starts at the same moment, in a new folder each round.
AT_ONCE = """
for number in range(10):
    gate, opener = os.pipe()
    children = []
    for _ in range(4):
        children += [fork()]
        if not children[-1]:
            os.close(opener)
            os.read(gate, 1)
            os._exit(commands.run(["setup", f"--work=work-{number}"]))
    os.close(opener)
    os.close(gate)
    print(*[os.waitpid(child, 0)[1] for child in children])
"""


@needs_fork
def test_many_starts_at_once(root: Path) -> None:
    """All of them end well, and every copy is whole."""
    whole = whole_copies(root)
    assert run_ready(root, AT_ONCE).splitlines() == ["0 0 0 0"] * 10
    for number in range(10):
        assert keep(root / f"work-{number}") == whole


@needs_fork
def test_a_start_waits_while_another_one_copies(root: Path) -> None:
    """What looks like litter may be in the making; the lock tells."""
    import fcntl

    part = root / "work" / ".02_maximum_acceleration.ipynb.0123456789abcdef.part"
    part.write_text("half")
    command = [sys.executable, "-c", READY + "sys.exit(commands.main(['setup']))", str(root)]
    lock = os.open(root / "work", os.O_RDONLY)
    fcntl.flock(lock, fcntl.LOCK_EX)
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout
        assert process.stdout.readline() == (
            "Another start is copying notebooks: waiting until it ends.\n"
        )
        assert set(keep(root / "work")) == {*LEARNERS, part.name}
        os.close(lock)
        assert process.wait() == 0
    assert set(keep(root / "work")) == {*LEARNERS, *NAMES}


@needs_fork
def test_without_locks_two_starts_do_not_mix(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Another start runs just when a copy is half written: as on some network folders."""
    whole = whole_copies(root)
    monkeypatch.setattr("fcntl.flock", raiser(OSError(errno.ENOLCK, "no locks")))
    write, calls = notebooks.write, []

    def write_while_another_starts(path: Path, content: dict[str, Any]) -> None:
        calls.append(path)
        write(path, content)
        if len(calls) == 1:
            assert commands.run(["setup"]) == 0

    monkeypatch.setattr(notebooks, "write", write_while_another_starts)
    assert commands.run(["setup"]) == 0
    assert len(set(calls)) == len(calls) > len(NAMES), "no two starts write the same file"
    assert keep(root / "work") == LEARNERS | whole
