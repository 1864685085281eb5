"""Files that are read and written for the learner: nothing that is there already is lost."""

import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from cammotion.quantities import InputError, shorten

_NO_NAME = re.compile(r'[<>:"/\\|?*\x00-\x1f\x7f\ud800-\udfff]')  # in no name of a file
_DEVICE = re.compile(r"(con|prn|aux|nul|com\d|lpt\d)(\..*)?", re.IGNORECASE)
_LONGEST = 60  # characters of a file's name


def write_new(path: str | Path, text: str | bytes, *, overwrite: bool = False) -> Path:
    """Write a file of text, its line ends as they are, or of bytes, and return its path.

    A file that is there already is left as it is, with an InputError, unless `overwrite` is True.
    """
    path = as_path(path)
    try:
        content = text if isinstance(text, bytes) else text.encode("utf-8")
    except UnicodeEncodeError as wrong:
        near = wrong.object[max(wrong.start - 10, 0) : wrong.end + 10]
        raise InputError(
            f"The text {shorten(near)} holds half a character, which no file can keep: write the "
            "name again."
        ) from None
    return write_new_bytes(path, content, overwrite=overwrite)


def write_new_bytes(path: str | Path, content: bytes, *, overwrite: bool = False) -> Path:
    """Write a file of any kind and return its path; raises InputError like `write_new`."""
    path = as_path(path)
    if not isinstance(overwrite, bool):
        raise InputError(f"The overwrite is {shorten(overwrite)}: give True or False.")
    try:
        with path.open("wb" if overwrite else "xb") as file:
            file.write(content)
    except FileExistsError:
        raise InputError(
            f"The file {_name(path)} is there already and was left as it is: choose another name, "
            "or add overwrite=True."
        ) from None
    except OSError as wrong:
        raise InputError(
            f"The file {_name(path)} cannot be written ({wrong.strerror}): choose a folder that is "
            "there and that you may write to."
        ) from None
    return path


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


def is_folder(path: Path) -> bool:
    """Tell whether a path is that of a folder; one that is too long for the system is of none."""
    try:
        return path.is_dir()
    except OSError:
        return False


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
    return shorten(path.name, of=str)


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
