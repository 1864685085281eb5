"""The folder of pages on a disk: what others have made, or have laid into it, is left alone."""

import shutil
import tempfile
from collections.abc import Collection, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path

from cammotion.files import remedy
from cammotion.quantities import InputError, shorten

MARKER = "made-by-workbook"
_MARK = "workbook.py site made this folder, and writes it anew."


def check_free(folder: Path) -> None:
    """Raise InputError where there is something that `workbook.py site` has not made."""
    with _told(folder):
        if not folder.exists() and not folder.is_symlink():
            return
        is_folder = folder.is_dir() and not folder.is_symlink()
        if is_folder and (_is_ours(folder) or not any(folder.iterdir())):
            return
    what = "is a file" if folder.is_file() else "was not made by this command"
    raise InputError(
        f"{shorten(folder.name, of=str)} is there already, {what}, and was left as it is: give "
        "another folder with --folder."
    )


def write(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write the files into a folder that is made anew, or not at all.

    What somebody has laid into the folder is in the new one, too. Raises InputError where there is
    something else, where that has the name of a page, or where nothing can be written.
    """
    check_free(folder)
    marked = "\n".join([_MARK, *sorted(files), ""]).encode()
    with (
        _told(folder),
        tempfile.TemporaryDirectory(prefix=f".{folder.name}-", dir=folder.parent) as beside,
    ):
        made = Path(beside) / folder.name
        if folder.exists():
            _keep_others(folder, made, files)
        for name, content in {MARKER: marked, **files}.items():
            file = made / name
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_bytes(content)
        _put(made, folder, Path(beside) / "before")


def _is_ours(folder: Path) -> bool:
    """Tell whether this command made a folder; the environment has a file of this name too."""
    return _told_by(folder)[:1] == [_MARK]


def _told_by(folder: Path) -> list[str]:
    """Return the lines of a folder's marker: what it is, and which files were written."""
    marker = folder / MARKER
    return marker.read_text("utf-8", "replace").splitlines() if marker.is_file() else []


def _keep_others(folder: Path, made: Path, files: Collection[str]) -> None:
    """Copy what this command has not written, unless a file of that name is to be written."""
    written = _told_by(folder)[1:] or files  # an earlier version did not say which
    own = {folder / name for name in (MARKER, *written)}
    for name in files:
        if folder / name not in own and (folder / name).exists():
            raise InputError(
                f"{shorten(name, of=str)} in {shorten(folder.name, of=str)} was not written by "
                "this command, which would put a file of that name there: take it out, or give "
                "another folder with --folder."
            )

    def copy(source: str, target: str) -> str:
        with _told(folder):  # else all errors are collected, as text without their numbers
            return str(shutil.copy2(source, target))

    shutil.copytree(
        folder,
        made,
        symlinks=True,
        copy_function=copy,
        ignore=lambda here, names: [name for name in names if Path(here, name) in own],
    )


@contextmanager
def _told(folder: Path) -> Iterator[None]:
    """Say in a sentence why a folder cannot be written, or not even be looked at."""
    try:
        yield
    except OSError as wrong:
        raise InputError(
            f"The folder {shorten(folder.name, of=str)} cannot be written "
            f"({wrong.strerror or shorten(str(wrong))}): "
            f"{remedy(wrong, 'give one in a folder that is there and that you may write to')}."
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
