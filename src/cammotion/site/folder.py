"""The folder of pages on a disk: what is in it was made by us, or it is left alone."""

import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from cammotion.quantities import InputError, shorten

MARKER = "made-by-workbook"
_MARK = b"workbook.py site made this folder, and writes it anew.\n"


def check_free(folder: Path) -> None:
    """Raise InputError where there is something that `workbook.py site` has not made."""
    with _told(folder):
        if not folder.exists() and not folder.is_symlink():
            return
        is_folder = folder.is_dir() and not folder.is_symlink()
        if is_folder and (_is_ours(folder) or not any(folder.iterdir())):
            return
    raise InputError(
        f"{shorten(folder.name, of=str)} is there already, was not made by this command, and was "
        "left as it is: give another folder with --folder."
    )


def write(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write the files into a folder that is made anew, or not at all.

    Raises InputError where there is something else, or where nothing can be written.
    """
    check_free(folder)
    with (
        _told(folder),
        tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as beside,
    ):
        made = Path(beside) / folder.name
        for name, content in {MARKER: _MARK, **files}.items():
            file = made / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        _put(made, folder, Path(beside) / "before")


def _is_ours(folder: Path) -> bool:
    """Tell whether this command made a folder; the environment has a file of this name too."""
    marker = folder / MARKER
    return marker.is_file() and marker.read_bytes().split() == _MARK.split()  # any line end


@contextmanager
def _told(folder: Path) -> Iterator[None]:
    """Say in a sentence why a folder cannot be written, or not even be looked at."""
    try:
        yield
    except OSError as wrong:
        raise InputError(
            f"The folder {shorten(folder.name, of=str)} cannot be written ({wrong.strerror}): give "
            "one in a folder that is there and that you may write to."
        ) from None


def _put(made: Path, folder: Path, before: Path) -> None:
    """Put what was made where the folder is, which is kept where that fails."""
    was_there = folder.exists()
    if was_there:
        folder.rename(before)
    try:
        made.rename(folder)
    except OSError:
        if was_there:
            before.rename(folder)
        raise
