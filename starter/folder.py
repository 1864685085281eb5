"""The folder of a learner's copies: a name within the workbook, or a path anywhere else."""

import os
import re
from pathlib import Path

from starter.errors import CLOSED, WorkbookError
from starter.paths import ROOT, START

DEFAULT = "work"
NAME = re.compile(r"work[\w-]*")


def find(wanted: str, command: str = START) -> Path:
    """Return the folder of a learner's copies, made if need be; `command` is what was typed."""
    folder = path_of(wanted)
    is_here = ROOT in (folder, *folder.parents)
    # Within the workbook only what .gitignore keeps out of commits can hold answers.
    if is_here and not (is_inside(folder) and NAME.fullmatch(folder.name)):
        raise WorkbookError(
            f"{wanted!r} cannot be the folder of your copies: give a name such as work-anna, "
            "which starts with work and has only letters, digits, - and _, "
            "or the path of a folder outside of the workbook, such as ~/cam."
        )
    if os.path.lexists(folder) and not folder.is_dir():
        raise WorkbookError(
            f"{wanted} is a file, or a link to nowhere: it cannot be the folder of your copies. "
            "Move it away, or give another name with --work."
        )
    try:
        folder.mkdir(parents=not is_here, exist_ok=True)
    except OSError as error:
        if error.errno not in CLOSED:
            raise
    if not os.access(folder, os.W_OK | os.X_OK):
        raise WorkbookError(
            f"You may not write in {folder}: give the path of a folder of your own for your "
            f"copies, for example: {command} --work ~/cam"
        )
    return folder


def path_of(wanted: str) -> Path:
    """Return where a folder is: a mere name is one in the workbook, all else is a path."""
    is_path = wanted in (".", "..", "~") or os.sep in wanted or (os.altsep or os.sep) in wanted
    if not is_path:
        return ROOT / wanted
    path = Path(os.path.abspath(os.path.expanduser(wanted)))  # noqa: PTH100, PTH111 - "~nobody" too
    return path.parent.resolve() / path.name  # a link in the workbook stays one


def is_inside(work: Path) -> bool:
    """Tell whether a folder of copies is in the workbook's own."""
    return work.parent == ROOT


def served(work: Path) -> Path:
    """Return the folder that JupyterLab shows: the workbook's, or that of copies elsewhere."""
    return ROOT if is_inside(work) else work


def shown(work: Path) -> str:
    """Return what a folder of copies is called: by its name, elsewhere by its path.

    One in the home is named from there, "~/cam": copies that a class gets say nobody's name.
    """
    home = Path(os.path.expanduser("~")).resolve()  # noqa: PTH111 - where there is none, too
    if is_inside(work):
        return work.name
    return f"~/{work.relative_to(home).as_posix()}" if home in work.parents else str(work)


def option(work: Path) -> str:
    """Return the option that asks for a folder of copies as it is to be typed, if it needs one."""
    if work == ROOT / DEFAULT:
        return ""
    return f" --work {typed(shown(work))}"


def typed(path: str) -> str:
    """Return a path as it is to be typed into a terminal."""
    return path if re.fullmatch(r"(~/)?[\w./\\:-]+", path) else f'"{path}"'
