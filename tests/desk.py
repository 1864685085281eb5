"""A learner's desk to try the progress on: a folder of copies, and kernels that begin anew."""

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import cammotion as cm
from cammotion.teaching import session
from cammotion.teaching.places import FILE, GRADING, SWITCH, find_place
from cammotion.teaching.session import Session
from cammotion.teaching.store import LOCK, Store

STRANGERS = {
    "empty": b"",
    "cut off": b'{"exercises": {"01.1": {"sta',
    "a list": b"[1, 2]",
    "a number": b"3",
    "null": b"null",
    "a list within": b'{"exercises": [1]}',
    "a number within": b'{"exercises": {"01.1": 3}}',
    "not UTF-8": b"\xff\xfe\x00",
    "nested beyond all bounds": b"[" * 100_000,
    "a number of 5000 digits": b'{"exercises": {"01.1": {"tries": ' + b"9" * 5000 + b"}}}",
}
"""Files that cannot be read."""


def sit_down(parent: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sit down in the folder of the copies of a workbook, for the time of a test."""
    folder = parent / "book" / "work"
    folder.mkdir(parents=True)
    (folder.parent / "workbook.py").touch()
    monkeypatch.chdir(folder)
    for name in (GRADING, SWITCH):
        monkeypatch.delenv(name, raising=False)
    for name in ("HOME", "USERPROFILE"):
        monkeypatch.setenv(name, str(parent / "home"))
    before = session._SESSION
    restart()
    yield folder
    session._SESSION = before


def restart() -> Session:
    """Begin anew, as a new kernel does."""
    session._SESSION = Session(Store(find_place))
    return session._SESSION


def read_file(folder: Path) -> Any:
    return json.loads((folder / FILE).read_text(encoding="utf-8"))


def line_of(number: str) -> str:
    """Return what the progress says of an exercise."""
    (line,) = (line for line in cm.progress().lines if line.number == number)
    return line.said


def files_in(folder: Path) -> list[str]:
    """Return what is in a folder, without the empty file that is only locked."""
    return sorted(path.name for path in folder.iterdir() if path.name != LOCK)
