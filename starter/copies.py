"""The learner's copies: laid, never overwritten, and said to be old when they are."""

import contextlib
import os
import re
import secrets
import shutil
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from starter import notebooks, processes
from starter.errors import WorkbookError
from starter.paths import ROOT, START, first_free

DEFAULT_WORK = "work"
# Narrow, so that no file of the learner's or of another program is taken for ours.
PART = re.compile(r"\..+\.(?:ipynb|csv)\.[0-9a-f]{16}\.part")
OTHER = "Another start is copying notebooks"


class Copy(NamedTuple):
    """A notebook in the learner's folder; `told` if it says itself what it is a copy of.

    One that is unreadable has no version.
    """

    name: str
    source: str
    version: str
    told: bool


def work_folder(name: str) -> Path:
    """Return the folder of a learner's copies, made if need be."""
    if not re.fullmatch(r"work[\w-]*", name):
        raise WorkbookError(
            f"{name!r} cannot be the folder of your copies: give a name such as work-anna, "
            "which starts with work and has only letters, digits, - and _."
        )
    folder = ROOT / name
    if os.path.lexists(folder) and not folder.is_dir():
        raise WorkbookError(
            f"{name} is a file, or a link to nowhere: it cannot be the folder of your copies. "
            "Move it away, or give another name with --work."
        )
    folder.mkdir(exist_ok=True)
    return folder


def lay_missing(work: Path) -> None:
    """Copy the notebooks that the learner does not have yet, and say what is with the others."""
    originals = notebooks.originals()
    with processes.only_one_in(work, OTHER):
        remove_left_overs(work)
        missing = [path for path in originals if not os.path.lexists(work / path.name)]
        for path in missing:
            lay(path, work / path.name)
        lay_tables(work)
    if missing:
        names = ", ".join(path.stem for path in missing)
        what = f"all {len(missing)} notebooks" if missing == originals else names
        print(f"Copied {what} to {work.name}/, which is yours to write in.")
    for notice in notices(work):
        print(notice)


def remove_left_overs(work: Path) -> None:
    """Remove what a killed start was writing."""
    for path in work.iterdir():
        if PART.fullmatch(path.name):
            with contextlib.suppress(OSError):  # in use, or closed to us: it does no harm
                path.unlink()


def lay(source: Path, target: Path) -> bool:
    """Copy a notebook without its outputs; return False if the name is taken.

    A note in the copy says what it is a copy of.
    """
    content, version = notebooks.read_original(source)
    notebooks.strip_outputs(content)
    content.setdefault("metadata", {})["workbook"] = {"source": source.name, "version": version}
    # A name of its own: where folders cannot be locked, two starts must not share a part.
    part = target.with_name(f".{target.name}.{secrets.token_hex(8)}.part")
    try:
        notebooks.write(part, content)
        return move_without_overwriting(part, target)
    finally:
        with contextlib.suppress(OSError):  # a virus scanner looks at it: the next start will do
            part.unlink(missing_ok=True)


def lay_tables(work: Path) -> None:
    """Copy the tables that lessons read into the folder data, where the learner's lie too."""
    folder = work / notebooks.TABLES.name
    missing = [path for path in notebooks.tables() if not os.path.lexists(folder / path.name)]
    for path in missing:
        part = work / f".{path.name}.{secrets.token_hex(8)}.part"
        try:
            folder.mkdir(exist_ok=True)
            shutil.copyfile(path, part)
            move_without_overwriting(part, folder / path.name)
        except FileExistsError:  # data is a file of the learner's
            print(f"{work.name}/{folder.name} is no folder: {path.name} could not be laid there.")
        finally:
            with contextlib.suppress(OSError):
                part.unlink(missing_ok=True)


def lay_fresh(source: Path, work: Path) -> Path:
    """Lay a fresh copy of a notebook beside the learner's, and return its path."""
    with processes.only_one_in(work, OTHER):
        while True:
            target = first_free(work / f"{source.stem}-fresh.ipynb")
            if lay(source, target):
                return target


def move_without_overwriting(part: Path, target: Path) -> bool:
    """Give a complete file its name; return False if the name is taken."""
    try:
        os.link(part, target)
    except FileExistsError:
        return False
    except OSError:  # a file system without hard links
        if os.path.lexists(target):
            return False
        part.rename(target)
    return True


def notices(work: Path) -> list[str]:
    """Say what is with the learner's copies that are unreadable, old, or of a notebook now gone."""
    versions = {path.name: notebooks.read_original(path).version for path in notebooks.originals()}
    copies = [recognize(path) for path in sorted(work.glob("[!.]*.ipynb"))]
    ours = {copy.source for copy in copies if copy.told or not copy.version}
    lines = []
    for source in sorted(ours.union(versions)):
        found = [copy for copy in copies if copy.source == source]
        trouble = find_trouble(source, found, versions)
        if trouble:
            comfort = reassure(source, found, versions.get(source), work.name)
            lines.append(f"{Path(source).stem}: {trouble} {comfort}")
    return lines


def recognize(path: Path) -> Copy:
    """Find out what a notebook in the learner's folder is a copy of."""
    notebook = notebooks.read(path)
    if notebook is None:
        return Copy(path.stem, path.name, version="", told=False)
    try:
        note = notebook.content["metadata"]["workbook"]
        return Copy(path.stem, str(note["source"]), str(note["version"]), told=True)
    except (KeyError, TypeError):
        return Copy(path.stem, path.name, notebook.version, told=False)


def find_trouble(source: str, found: list[Copy], versions: dict[str, str]) -> str:
    """Say what is with the learner's copies of a notebook; nothing if one of them is current."""
    if not all(copy.version for copy in found):
        return "what you have by this name is not readable as a notebook."
    if source not in versions:
        return f"the workbook no longer has a notebook of this name{successor(source, versions)}."
    if not found:  # although what was missing has been laid
        return "what you have by this name is a copy of another notebook."
    if versions[source] in {copy.version for copy in found}:
        return ""
    if found[0].told:
        return "the workbook has a newer version than your copy."
    return "your copy differs from the workbook's and does not tell its version."


def successor(gone: str, names: Iterable[str]) -> str:
    """Say, in brackets, where a notebook that is gone went: renumbered, renamed, or unknown."""
    number, _, title = Path(gone).stem.partition("_")
    stems = [Path(name).stem for name in names]
    for stem in stems:
        if title and stem.partition("_")[2] == title:
            return f" (it is {stem} now)"
    for stem in stems:
        if notebooks.number_of(stem) == number:
            return f" ({number} is {stem} now)"
    return ""


def reassure(source: str, found: list[Copy], version: str | None, work: str) -> str:
    """Say that the learner's copies stay, and how to get a fresh one if there is one to get."""
    stem = Path(source).stem
    names = [copy.name for copy in found]
    yours = "Yours" if names in ([], [stem]) else f"Yours ({', '.join(names)})"
    if version in {None, *(copy.version for copy in found)}:
        return f"{yours} is untouched."
    option = "" if work == DEFAULT_WORK else f" --work {work}"
    command = f"{START} fresh {notebooks.number_of(stem)}{option}"
    return f"{yours} is untouched; `{command}` lays a fresh copy beside it."
