"""Files that are read and written for the learner: nothing that is there already is lost."""

import errno
import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from cammotion.quantities import InputError, shorten

_NO_NAME = re.compile(r'[<>:"/\\|?*\x00-\x1f\x7f\ud800-\udfff]')  # in no name of a file
_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
_LONGEST = 60  # characters of a file's name
_NO_TABLE = {  # endings that stand for something else than a table of text
    *(".ods", ".fods", ".xls", ".xlsx", ".xlsm", ".xlsb", ".numbers"),
    *(".doc", ".docx", ".odt", ".pdf", ".html", ".htm", ".json", ".xml", ".py", ".ipynb", ".zip"),
    *(".svg", ".png", ".jpg", ".jpeg", ".gif", ".dxf", ".dwg", ".stp", ".step"),
}
_FULL = (errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC))  # Windows knows no quota


def write_new(path: str | Path, text: str | bytes, *, overwrite: bool = False) -> Path:
    """Write a file of text, its line ends as they are, or of bytes, and return its path.

    A file that is there already is left as it is, with an InputError, unless `overwrite` is True;
    and it stays whole where the new one cannot be written.
    """
    path = as_path(path)
    content = text if isinstance(text, bytes) else _encoded(text)
    _write({path: content}, overwrite=overwrite)
    return path


def write_all(texts: Mapping[Path, str], *, overwrite: bool = False) -> None:
    """Write files of text, all of them or none; raises InputError like `write_new`."""
    _write({path: _encoded(text) for path, text in texts.items()}, overwrite=overwrite)


def _encoded(text: str) -> bytes:
    try:
        return text.encode("utf-8")
    except UnicodeEncodeError as wrong:
        near = wrong.object[max(wrong.start - 10, 0) : wrong.end + 10]
        raise InputError(
            f"The text {shorten(near)} holds half a character, which no file can keep: write the "
            "name again."
        ) from None


def _write(contents: Mapping[Path, bytes], *, overwrite: bool) -> None:
    """Write all files beside their places, which they take only when all are whole.

    Whatever stands in the way of one, all is as it was before.
    """
    if not isinstance(overwrite, bool):
        raise InputError(f"The overwrite is {shorten(overwrite)}: give True or False.")
    with ExitStack() as undo:
        parts = {path: _part(path, overwrite=overwrite, undo=undo) for path in contents}
        for path, (part, _) in parts.items():
            with _told(path):
                part.write_bytes(contents[path])
        for path, (part, target) in parts.items():
            with _told(path):
                if part != target:
                    before = target.read_bytes()
                    part.replace(target)
                    undo.callback(target.write_bytes, before)  # a new one then goes as a whole
        undo.pop_all()


def _part(path: Path, *, overwrite: bool, undo: ExitStack) -> tuple[Path, Path]:
    """Return the file to write to, which `undo` takes away, and where it belongs."""
    with _told(path):
        target = Path(os.path.realpath(path)) if overwrite else path  # a link stays a link
        if not overwrite or not target.exists():
            target.open("xb").close()
            undo.callback(target.unlink, missing_ok=True)
        elif not target.is_file():  # a device takes what is written; a folder refuses it
            return target, target
        else:
            target.open("r+b").close()  # what may not be written to may not be replaced
        handle, name = tempfile.mkstemp(prefix=".cammotion-", dir=target.parent)
        os.close(handle)
        part = Path(name)
        undo.callback(part.unlink, missing_ok=True)
        shutil.copymode(target, part)
        return part, target


@contextmanager
def _told(path: Path) -> Iterator[None]:
    """Say in a sentence why a file cannot be written."""
    try:
        yield
    except FileExistsError:
        raise InputError(
            f"The file {_name(path)} is there already and was left as it is: choose another name, "
            "or add overwrite=True."
        ) from None
    except OSError as wrong:
        raise InputError(
            f"The file {_name(path)} cannot be written ({wrong.strerror}): "
            f"{remedy(wrong, 'choose a folder that is there and that you may write to')}."
        ) from None


def remedy(wrong: OSError, otherwise: str) -> str:
    """Return what to do where nothing can be written: make room on a full disk, or `otherwise`."""
    return "make room on the disk" if wrong.errno in _FULL else otherwise


def read_text(path: str | Path) -> str:
    """Return the text of a file in UTF-8, its line ends as they are, without a mark at its start.

    Raises InputError for a file that is not there, that cannot be read, or is no such text.
    """
    path = as_path(path)
    return decode(_name(path), read_bytes(path))


def decode(name: str, content: bytes) -> str:
    """Return the text in UTF-8 that a file of this name holds; raises like `read_text`."""
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as wrong:
        line, byte = content.count(b"\n", 0, wrong.start) + 1, content[wrong.start]
        raise InputError(
            f"The file {name} cannot be read: its line {line} has the byte {byte:#04x}, "
            "which is no character in UTF-8. Save it in the spreadsheet as 'CSV UTF-8'."
        ) from None


def read_bytes(path: str | Path, *, at_most: int | None = None) -> bytes:
    """Return what a file holds; raise InputError for one that is not there or cannot be read.

    So for one of more than `at_most` bytes, of which no more are read.
    """
    path = as_path(path)
    try:
        with path.open("rb") as file:
            content = file.read() if at_most is None else file.read(at_most + 1)
    except (FileNotFoundError, NotADirectoryError):
        raise InputError(f"There is no file {_name(path)}: give the path of one.") from None
    except OSError as wrong:
        raise InputError(
            f"The file {_name(path)} cannot be read ({wrong.strerror}): give a file that you may "
            "read."
        ) from None
    if at_most is not None and len(content) > at_most:
        raise InputError(
            f"The file {_name(path)} has more than {at_most / 1e6:g} MB, far more than a table of "
            "this kind needs: give the table alone."
        )
    return content


def ending(path: Any, of: str, among: Sequence[str]) -> str:
    """Return the ending of a file's name in small letters; raise InputError for another one.

    `of` says what the file is of.

    >>> ending("chart.PDF", "chart", [".pdf", ".svg"])
    '.pdf'
    """
    found = as_path(path).suffix.lower()
    if found in among:
        return found
    *others, last = among
    asked = f"{', '.join(others)} or {last}" if others else last
    raise InputError(
        f"The file of the {of} is called {_name(as_path(path))}: let its name end in {asked}."
    )


def table_ending(path: Any, others: Sequence[str] = ()) -> str:
    """Return the ending of the name of a table in CSV, or in one of the `others`, in small letters.

    Raises InputError for one that is known to stand for something else.

    >>> table_ending("mine.CSV"), table_ending("mine"), table_ending("mine.xlsx", [".xlsx"])
    ('.csv', '', '.xlsx')
    """
    found = as_path(path).suffix.lower()
    if found in _NO_TABLE.difference(others):
        raise InputError(
            f"The file {shorten(as_path(path).name)} would be CSV under the name of another "
            f"format: let its name end in {' or '.join(['.csv', *others])}."
        )
    return found


def is_folder(path: Path) -> bool:
    """Tell whether a path is that of a folder; one that is too long for the system is of none."""
    try:
        return path.is_dir()
    except OSError:
        return False


def check_folder(path: Path, name: str, otherwise: str) -> None:
    """Raise InputError for what is no folder, by its `name`; `otherwise`: what to do with none."""
    if not is_folder(path):
        if os.path.exists(path):  # noqa: PTH110 - no error where a path is too long
            raise InputError(f"{name} is a file: give a folder.")
        raise InputError(f"There is no folder {name}: {otherwise}.")


def as_path(path: Any) -> Path:
    """Return the path of a file; raise InputError for what can be none."""
    if not isinstance(path, str | Path):
        raise InputError(f"The path of the file is {shorten(path)}: give one like 'machine.csv'.")
    try:
        is_path = "\0" not in str(path) and bool(str(path).encode("utf-8", "surrogateescape"))
    except UnicodeEncodeError:
        is_path = False
    if not is_path:
        raise InputError(
            f"The path {shorten(str(path))} holds a character that no path may have, or none at "
            "all: give one like 'machine.csv'."
        )
    return Path(path)


def _name(path: Path) -> str:
    return shorten(path.name or str(path), of=str)


def stems(names: Iterable[str]) -> Iterator[str]:
    """Yield for each name one that every system takes for a file, each another one."""
    taken: set[str] = set()
    for name in names:
        stem = _NO_NAME.sub("_", name)[:_LONGEST].strip(". ") or "_"
        stem = f"_{stem}" if _DEVICE.fullmatch(stem) else stem
        number, free = 1, stem
        while free.casefold() in taken:
            number += 1
            free = f"{stem} {number}"
        taken.add(free.casefold())
        yield free
