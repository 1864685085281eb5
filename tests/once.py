"""What all processes of a run of tests share: the first that needs it makes it."""

import atexit
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path

from filelock import FileLock

_FOLDER = "WORKBOOK_TESTS_FOLDER"  # conftest.py says which


def _folder_of_the_run() -> Path:
    if _FOLDER not in os.environ:  # this is no run of tests, but a benchmark
        os.environ[_FOLDER] = tempfile.mkdtemp(prefix="workbook-")
        atexit.register(shutil.rmtree, os.environ[_FOLDER], ignore_errors=True)
    return Path(os.environ[_FOLDER])


def made_once(name: str, make: Callable[[Path], object]) -> Path:
    """Return the folder of this name; `make` makes it unless it is there."""
    folder = _folder_of_the_run() / name
    with FileLock(f"{folder}.lock"):
        if not folder.exists():
            with tempfile.TemporaryDirectory(dir=folder.parent) as beside:
                make(Path(beside) / name)
                (Path(beside) / name).rename(folder)
    return folder
