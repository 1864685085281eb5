"""The folder of pages on a disk: what is in it was made by us, or it is left alone."""

import tempfile
from collections.abc import Mapping
from pathlib import Path

from cammotion.files import is_folder
from cammotion.quantities import InputError, shorten

MARKER = "made-by-workbook"
_MARK = "workbook.py site made this folder, and writes it anew.\n"


def check_free(folder: Path) -> None:
    """Raise InputError where there is something that `workbook.py site` has not made."""
    if not folder.exists() and not folder.is_symlink():
        return
    is_ours = is_folder(folder) and not folder.is_symlink() and (folder / MARKER).is_file()
    is_empty = is_folder(folder) and not folder.is_symlink() and not any(folder.iterdir())
    if not is_ours and not is_empty:
        raise InputError(
            f"{shorten(folder.name, of=str)} is there already, was not made by this command, and "
            "was left as it is: give another folder with --folder."
        )


def write(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write the files into a folder that is made anew, or not at all.

    Raises InputError where there is something else, or where nothing can be written.
    """
    check_free(folder)
    try:
        with tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as beside:
            made = Path(beside) / folder.name
            for name, content in {MARKER: _MARK.encode(), **files}.items():
                file = made / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content)
            _put(made, folder, Path(beside) / "before")
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
