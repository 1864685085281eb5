"""A small workbook to try the starter on: nothing it does here reaches the real one."""

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

import pytest

import starter.commands  # with it come all modules of the starter
import starter.paths

REPOSITORY = starter.paths.ROOT
LAUNCHER = REPOSITORY / "workbook.py"
STARTER = REPOSITORY / "starter"


def notebook(*sources: str, **output: Any) -> dict[str, Any]:
    """Make a notebook of code cells."""
    cells: list[dict[str, Any]] = [
        {
            "cell_type": "code",
            "id": f"cell-{number}",
            "metadata": {},
            "execution_count": None,
            "outputs": [output] if output else [],
            "source": [source],
        }
        for number, source in enumerate(sources)
    ]
    return {"cells": cells, "metadata": {}, "nbformat": 4, "nbformat_minor": 5}


def lay_out(parent: Path) -> Path:
    """Lay out a small workbook in a folder with a space and an umlaut in its name."""
    root = parent / "wörk book"
    (root / "src" / "cammotion").mkdir(parents=True)
    (root / "notebooks").mkdir()
    shutil.copy(LAUNCHER, root)
    shutil.copytree(STARTER, root / "starter")
    shutil.copytree(REPOSITORY / "etc", root / "etc")
    (root / "environment.txt").write_text("-e .\nno-such-package==1.0\n")
    (root / "pyproject.toml").write_text("[project]\nname = 'cammotion'\nversion = '0'\n")
    for name in ("00_start_here", "02_maximum_acceleration"):
        (root / "notebooks" / f"{name}.ipynb").write_text(json.dumps(notebook(name)))
    return root


def move_starter(parent: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Let the starter, for the time of a test, work in a small workbook."""
    root = lay_out(parent)
    for name, module in list(sys.modules.items()):
        for constant, value in list(vars(module).items()) if name.startswith("starter.") else ():
            if isinstance(value, Path):
                monkeypatch.setattr(module, constant, root / value.relative_to(REPOSITORY))
    return root


def change(path: Path, source: str) -> None:
    """Change the first cell of a notebook and nothing else."""
    content = json.loads(path.read_text())
    content["cells"][0]["source"] = [source]
    path.write_text(json.dumps(content))


def keep(folder: Path) -> dict[str, bytes | str]:
    """Return all that is in a folder: the bytes of files, where links point, and what folders."""
    return {
        path.relative_to(folder).as_posix(): str(path.readlink())
        if path.is_symlink()
        else path.read_bytes()
        if path.is_file()
        else "a folder"
        for path in folder.rglob("*")
    }


def run(root: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Start the workbook in `root` as a user would, from another folder."""
    return subprocess.run(
        [sys.executable, str(root / "workbook.py"), *arguments],
        cwd=root.anchor,
        env=os.environ,
        capture_output=True,
        encoding="utf-8",
        timeout=60,
        check=False,
    )


def assert_refused(result: subprocess.CompletedProcess[str], *words: str) -> None:
    """Check that a run failed with a sentence and without a traceback."""
    assert result.returncode != 0
    assert "Traceback" not in result.stderr
    for word in words:
        assert word in result.stderr


def raiser(error: BaseException) -> Callable[..., NoReturn]:
    """Make a function that raises."""

    def fail(*_arguments: object, **_options: object) -> NoReturn:
        raise error

    return fail
