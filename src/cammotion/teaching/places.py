"""Where the progress of a learner is kept: with the learner's copies, wherever they are."""

import json
import os
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

FILE = "progress.json"
KINDS = ("exercises", "predictions", "learner")
SOLUTIONS = ("notebooks", "solutions")  # where they lie, beside the lessons and copies elsewhere
GRADING = "NBGRADER_EXECUTION"  # nbgrader sets it while it executes a notebook
SWITCH = "CAMMOTION_PROGRESS"
"""Names a folder for the progress of notebooks outside of a workbook's copies, or says "off"."""
_AT_HOME = "cammotion-progress"


class Place(NamedTuple):
    """The folder of the file, None where nothing is kept; and what would surprise a learner."""

    folder: Path | None
    remark: str = ""


def find_place() -> Place:
    """Find the folder in which this kernel keeps what is done.

    That is the folder of the learner's copies, if the kernel runs in one. Else it is what the
    variable CAMMOTION_PROGRESS names, and without it the folder of the notebook: where the whole
    workbook is there, one for all its notebooks. What may only be read, or has a `progress.json`
    of another program, gives way to a folder in the learner's home.
    """
    if GRADING in os.environ:
        return Place(None)
    here = _here()
    if copies := _copies_around(here):
        return Place(copies)
    wanted = os.environ.get(SWITCH, "").strip()
    if wanted.lower() == "off":
        return Place(None)
    home = _home()
    if wanted:
        named = _named(wanted)
        folders = [named and (home or Path()) / named]
    else:
        folders = [_top(here), home and home / _AT_HOME]
    candidates = [folder for folder in folders if folder]
    for folder in candidates:
        if _may_keep(folder):
            return Place(folder, f"Your progress is kept in {folder / FILE}.")
    tried = " nor in ".join(map(str, candidates)) or wanted or "any folder"
    return Place(
        None,
        f"Your progress is kept only until this notebook is closed: it cannot be written in "
        f"{tried}. The variable {SWITCH} can name another folder.",
    )


def _here() -> Path | None:
    with suppress(OSError):  # the folder may be gone
        return Path.cwd()
    return None


def _home() -> Path | None:
    with suppress(RuntimeError):  # a user without one
        return Path.home()
    return None


def _named(wanted: str) -> Path | None:
    with suppress(RuntimeError):  # ~nobody
        return Path(wanted).expanduser()
    return None


def _copies_around(here: Path | None) -> Path | None:
    """Return the folder of copies beside a workbook.py in which a folder is."""
    top = _top(here)
    return top if top and top.name.startswith("work") and _is_in_workbook(top) else None


def _top(here: Path | None) -> Path | None:
    """Return the folder itself, or the one that holds all notebooks of a workbook, or copies."""
    for folder in (here, *here.parents) if here else ():
        if _is_in_workbook(folder):
            return folder
    return _copies_with_solutions(here) or here


def _copies_with_solutions(here: Path | None) -> Path | None:
    """Return the folder of copies outside of a workbook in whose solutions a folder is."""
    if here and here.parts[-2:] == SOLUTIONS:
        copies = here.parents[1]
        return copies if any(copies.glob("[0-9][0-9]_*.ipynb")) else None
    return None


def _is_in_workbook(folder: Path) -> bool:
    return (folder.parent / "workbook.py").is_file()


def _may_keep(folder: Path) -> bool:
    """Tell whether a file of ours may be in a folder, or be laid there."""
    try:
        nearest = next(one for one in (folder, *folder.parents) if os.path.lexists(one))
        return os.access(nearest, os.W_OK | os.X_OK) and nearest.is_dir() and _is_ours(folder)
    except (OSError, StopIteration):
        return False


def _is_ours(folder: Path) -> bool:
    """Tell whether the file is free, or of this workbook; a damaged one is taken for ours."""
    file = folder / FILE
    if not os.path.lexists(file):
        return True
    if not file.is_file():
        return False
    try:
        content = json.loads(file.read_bytes())
    except (OSError, ValueError, RecursionError):
        return True
    return isinstance(content, dict) and (not content or any(kind in content for kind in KINDS))
