"""Find, read and write notebooks."""

import hashlib
import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

from starter.errors import WorkbookError, incomplete
from starter.paths import NOTEBOOKS

TABLES = NOTEBOOKS / "data"


class Notebook(NamedTuple):
    """A notebook; its version is a hash of the cells' types and sources, not of outputs."""

    content: dict[str, Any]
    version: str


def originals() -> list[Path]:
    """List the workbook's own notebooks, in order; their solutions are not among them."""
    return notebooks_in(NOTEBOOKS)


def solutions() -> list[Path]:
    """List the worked solutions, in order: they are not among the learner's copies."""
    return notebooks_in(NOTEBOOKS / "solutions")


def tables() -> list[Path]:
    """List the files that lessons read, in order."""
    return sorted(TABLES.glob("[!.]*.csv"))


def pictures() -> list[Path]:
    """List the pictures that notebooks show, in order."""
    return sorted((NOTEBOOKS / "images").glob("[!.]*.svg"))


def notebooks_in(folder: Path) -> list[Path]:
    """List the notebooks of a folder; macOS puts a hidden `._name` beside each on some disks."""
    return sorted(folder.glob("[!.]*.ipynb"))


def find(wanted: str) -> Path:
    """Find the workbook's own notebook with this number (2 or 02) or name."""
    for path in originals():
        number = number_of(path.stem)
        if wanted in (path.name, path.stem) or (wanted and wanted.zfill(len(number)) == number):
            return path
    known = ", ".join(path.stem for path in originals()) or "none"
    raise WorkbookError(f"There is no notebook {wanted!r}. Known are: {known}.")


def number_of(name: str) -> str:
    """Return the number that a notebook's name begins with."""
    return name.split("_")[0]


def read(path: Path) -> Notebook | None:
    """Read a notebook; return None if it is none."""
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        cells = [(cell["cell_type"], "".join(cell["source"])) for cell in content["cells"]]
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        return None
    return Notebook(content, hashlib.sha256(json.dumps(cells).encode()).hexdigest()[:16])


def read_original(path: Path) -> Notebook:
    """Read one of the workbook's own notebooks, which has to be readable."""
    notebook = read(path)
    if notebook is None:
        raise incomplete(f"{path.name} is unreadable")
    return notebook


def strip_outputs(content: dict[str, Any]) -> None:
    """Take from a notebook what was shown when it was run: a copy begins with nothing told."""
    for cell in content["cells"]:
        if cell["cell_type"] == "code":
            cell.update(outputs=[], execution_count=None)


def change_text(content: dict[str, Any], change: Callable[[str], str]) -> None:
    """Change what a notebook tells, as against what it computes."""
    for cell in content["cells"]:
        told = "".join(cell["source"])
        if cell["cell_type"] == "markdown" and (changed := change(told)) != told:
            cell["source"] = changed.splitlines(keepends=True)


def write(path: Path, content: dict[str, Any]) -> None:
    """Write a notebook as nbformat writes it, through to the disk."""
    with path.open("w", encoding="utf-8", newline="\n") as file:
        file.write(json.dumps(content, indent=1, ensure_ascii=False, sort_keys=True) + "\n")
        file.flush()
        os.fsync(file.fileno())


def part_of(path: Path) -> Path:
    """Return the name under which a file is written before it is complete."""
    return path.with_name(f".{path.name}.part")
