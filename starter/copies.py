"""The learner's copies: laid, never overwritten, and said to be old when they are."""

import os
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from starter import notebooks
from starter.errors import WorkbookError
from starter.paths import ROOT, START, first_free

DEFAULT_WORK = "work"


class Copy(NamedTuple):
    """A notebook in the learner's folder; `told` if it says itself what it is a copy of."""

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
    if folder.exists() and not folder.is_dir():
        raise WorkbookError(f"{name} is a file, and cannot be the folder of your copies.")
    folder.mkdir(exist_ok=True)
    return folder


def lay_missing(work: Path) -> None:
    """Copy the notebooks that the learner does not have yet, and say which copies are old."""
    for left_over in work.glob(".*.part"):
        left_over.unlink(missing_ok=True)
    missing = [path for path in notebooks.originals() if not os.path.lexists(work / path.name)]
    for path in missing:
        lay(path, work / path.name)
    if missing:
        print(f"Copied {len(missing)} notebooks to {work.name}/: these copies are yours.")
    for notice in notices(work):
        print(notice)


def lay(source: Path, target: Path) -> None:
    """Copy a notebook, with a note of what it is a copy of; never overwrite."""
    content, version = notebooks.read_original(source)
    content.setdefault("metadata", {})["workbook"] = {"source": source.name, "version": version}
    part = notebooks.part_of(target)
    try:
        notebooks.write(part, content)
        move_without_overwriting(part, target)
    finally:
        part.unlink(missing_ok=True)


def lay_fresh(source: Path, work: Path) -> Path:
    """Lay a fresh copy of a notebook beside the learner's, and return its path."""
    target = first_free(work / f"{source.stem}-fresh.ipynb")
    lay(source, target)
    return target


def move_without_overwriting(part: Path, target: Path) -> None:
    """Give a complete file its name, unless the name is taken."""
    try:
        os.link(part, target)
    except FileExistsError:
        return
    except OSError:  # a file system without hard links
        if not os.path.lexists(target):
            part.rename(target)


def notices(work: Path) -> list[str]:
    """Say which of the learner's copies are unreadable, without a source, or old."""
    versions = {path.name: notebooks.read_original(path).version for path in notebooks.originals()}
    read = {path.stem: recognize(path) for path in sorted(work.glob("*.ipynb"))}
    copies = [copy for copy in read.values() if copy]
    unreadable = [name for name in read if read[name] is None]
    gone = [copy.name for copy in copies if copy.told and copy.source not in versions]
    return [
        *(f"{name}: your copy is not readable as a notebook; it stays." for name in unreadable),
        *(
            f"{name}: is no longer part of the workbook (renamed or removed); your copy stays."
            for name in gone
        ),
        *(age_notice(copy, work.name) for copy in old_ones(versions, copies)),
    ]


def recognize(path: Path) -> Copy | None:
    """Find out what a notebook in the learner's folder is a copy of."""
    notebook = notebooks.read(path)
    if notebook is None:
        return None
    try:
        note = notebook.content["metadata"]["workbook"]
        return Copy(path.stem, note["source"], note["version"], told=True)
    except (KeyError, TypeError):
        return Copy(path.stem, path.name, notebook.version, told=False)


def old_ones(versions: dict[str, str], copies: list[Copy]) -> Iterator[Copy]:
    """Yield one copy of each notebook of which no copy has the current version."""
    for source, version in versions.items():
        found = [copy for copy in copies if copy.source == source]
        if found and version not in {copy.version for copy in found}:
            yield found[0]


def age_notice(copy: Copy, work: str) -> str:
    """Say that a copy is old, and how to get a fresh one."""
    name = Path(copy.source).stem
    trouble = (
        "the workbook has a newer version than your copy."
        if copy.told
        else "your copy differs from the workbook's and does not tell its version."
    )
    option = "" if work == DEFAULT_WORK else f" --work {work}"
    command = f"{START} fresh {notebooks.number_of(name)}{option}"
    return f"{name}: {trouble} Yours is untouched; `{command}` lays a fresh copy beside it."
