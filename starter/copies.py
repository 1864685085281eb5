"""The learner's copies: laid, never overwritten, and said to be old when they are."""

import contextlib
import os
import re
import secrets
import shutil
from collections.abc import Iterable
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from starter import folder, notebooks, processes
from starter.paths import NOTEBOOKS, START, first_free

# Narrow, so that no file of the learner's or of another program is taken for ours.
PART = re.compile(r"\..+\.(?:ipynb|csv|svg)\.[0-9a-f]{16}\.part")
OTHER = "Another start is copying notebooks"
# Links of lessons and of solutions, and what they are in copies elsewhere.
ELSEWHERE = {"](../../notebooks/": "](../../", "](../notebooks/": "](notebooks/"}
# Commands of lessons that ask for a folder of copies, if it is not the usual one; and files in it.
COMMAND = re.compile(r"`(python3 workbook\.py(?: (?:setup|fresh|report)\b[^`\n]*)?)`")
IN_WORK = re.compile(rf"\b{folder.DEFAULT}(/[\w./-]+)")


class Copy(NamedTuple):
    """A notebook in the learner's folder; `told` if it says itself what it is a copy of.

    One that is unreadable has no version.
    """

    name: str
    source: str
    version: str
    told: bool


def lay_missing(work: Path) -> None:
    """Copy the notebooks that the learner does not have yet, and say what is with the others."""
    originals = notebooks.originals()
    with processes.only_one_in(work, OTHER):
        remove_left_overs(work)
        missing = [path for path in originals if not os.path.lexists(work / path.name)]
        for path in missing:
            lay(path, work / path.name, work)
        lay_beside(work)
    if missing:
        names = ", ".join(path.stem for path in missing)
        what = f"all {len(missing)} notebooks" if missing == originals else names
        print(f"Copied {what} to {folder.shown(work)}/, which is yours to write in.")
    for notice in notices(work):
        print(notice)


def remove_left_overs(work: Path) -> None:
    """Remove what a killed start was writing."""
    for path in work.iterdir():
        if PART.fullmatch(path.name):
            with contextlib.suppress(OSError):  # in use, or closed to us: it does no harm
                path.unlink()


def lay(source: Path, target: Path, work: Path) -> bool:
    """Copy a file of the workbook into the learner's folder; return False if the name is taken."""
    # A name of its own: where folders cannot be locked, two starts must not share a part.
    part = work / f".{target.name}.{secrets.token_hex(8)}.part"
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        if source.suffix == ".ipynb":
            notebooks.write(part, copy_of(source, work))
        else:
            shutil.copyfile(source, part)
        return move_without_overwriting(part, target)
    finally:
        with contextlib.suppress(OSError):  # a virus scanner looks at it: the next start will do
            part.unlink(missing_ok=True)


def copy_of(source: Path, work: Path) -> dict[str, Any]:
    """Return a notebook without its outputs; a note in it says what it is a copy of.

    Elsewhere than in the workbook its links lead to what is laid there; the commands that it
    names are for this folder.
    """
    content, version = notebooks.read_original(source)
    notebooks.strip_outputs(content)
    notebooks.change_text(content, partial(suit, work=work))
    content.setdefault("metadata", {})["workbook"] = {"source": source.name, "version": version}
    return content


def suit(text: str, work: Path) -> str:
    """Return a text of a lesson with the links and commands that are right for a folder."""
    if not folder.is_inside(work):
        for old, new in ELSEWHERE.items():
            text = text.replace(old, new)
    if not folder.option(work):
        return text

    def for_this_folder(command: re.Match[str]) -> str:
        here = IN_WORK.sub(lambda file: folder.typed(folder.shown(work) + file[1]), command[1])
        return f"`{here}{folder.option(work)}`"

    text = COMMAND.sub(for_this_folder, text)
    return text.replace(f"the folder `{folder.DEFAULT}`", f"the folder `{folder.shown(work)}`")


def lay_beside(work: Path) -> None:
    """Copy what notebooks need beside them: the tables that lessons read, elsewhere also more."""
    needed = {notebooks.TABLES.name: notebooks.tables()}
    if not folder.is_inside(work):
        needed |= {f"{NOTEBOOKS.name}/images": notebooks.pictures()}
        needed |= {f"{NOTEBOOKS.name}/solutions": notebooks.solutions()}
    for name, sources in needed.items():
        for source in sources:
            target = work / name / source.name
            try:
                if not os.path.lexists(target):
                    lay(source, target, work)
            except (FileExistsError, NotADirectoryError):  # a file of the learner's
                print(f"{folder.shown(work)}/{name} is no folder: {source.name} was not laid.")


def lay_fresh(source: Path, work: Path) -> Path:
    """Lay a fresh copy of a notebook beside the learner's, and return its path."""
    with processes.only_one_in(work, OTHER):
        while True:
            target = first_free(work / f"{source.stem}-fresh.ipynb")
            if lay(source, target, work):
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
            comfort = reassure(source, found, versions.get(source), folder.option(work))
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


def reassure(source: str, found: list[Copy], version: str | None, option: str) -> str:
    """Say that the learner's copies stay, and how to get a fresh one if there is one to get."""
    stem = Path(source).stem
    names = [copy.name for copy in found]
    yours = "Yours" if names in ([], [stem]) else f"Yours ({', '.join(names)})"
    if version in {None, *(copy.version for copy in found)}:
        return f"{yours} is untouched."
    command = f"{START} fresh {notebooks.number_of(stem)}{option}"
    return f"{yours} is untouched; `{command}` lays a fresh copy beside it."
