"""The environment of a class server, made by the commands of docs/classroom.md.

It is `.venv-hub`. REQUIRE_HUB=1 makes it, and brings it up to date; it needs root, since each
student is an account of the system, and a Python that these accounts may run.
"""

import atexit
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from functools import cache
from pathlib import Path

import pytest
from environments import ROOT, Environment, run

PAGE = (ROOT / "docs" / "classroom.md").read_text("utf-8")
PLACE = "/opt/cammotion"  # on the page
PYTHON_OF_ALL = Path("/usr/bin/python3")
PROXY = "configurable-http-proxy@5.3.0"  # the engine's own, from npm
IS_OLD = "import sys; sys.exit(sys.version_info < (3, 11))"
OPEN = 0o001


def require_hub() -> Path:
    """Return the environment of the hub; without one say what is not tested."""
    if os.environ.get("REQUIRE_HUB") == "1":
        return installed()
    if is_made(ROOT / ".venv-hub") and is_root():
        return ROOT / ".venv-hub"
    pytest.skip(
        "NOT TESTED on a hub: that needs root, who makes accounts for the students, and .venv-hub. "
        "To make it: REQUIRE_HUB=1 python3 workbook.py test tests/test_hub.py"
    )


def is_root() -> bool:
    return sys.platform == "linux" and os.getuid() == 0


def is_made(folder: Path) -> bool:
    """Tell whether an environment is complete: its proxy comes last."""
    return proxy_of(folder).exists() and is_open(folder)


def proxy_of(folder: Path) -> Path:
    return folder / "node_modules" / ".bin" / "configurable-http-proxy"


@cache
def installed() -> Path:
    """Make the environment, or bring it up to date; this takes long only the first time."""
    if not is_root():
        pytest.fail("REQUIRE_HUB=1 needs root, on Linux: each student is an account of the system")
    folder = ROOT / ".venv-hub"
    if not is_open(ROOT):  # students could not read it there
        folder = Path(tempfile.mkdtemp(prefix="cammotion-hub-"))
        folder.chmod(0o755)
        atexit.register(shutil.rmtree, folder, ignore_errors=True)
    pins = folder / "pins.txt"
    environment = Environment(folder).make(python_of_all())
    lines = (ROOT / "environment.txt").read_text("utf-8").splitlines()
    pins.write_text("\n".join(line for line in lines if not line.startswith("-e")), "utf-8")
    environment.install("-c", pins, *wanted(), for_others=True)
    environment.python("-m", "pip", *unwanted(), at=folder)
    run("npm", "install", "--silent", "--no-save", "--prefix", folder, PROXY)
    return folder


def wanted() -> list[str]:
    """Return what the page installs with pip."""
    (line,) = re.findall(r"^\S+/bin/python -m pip install -c \S+ (.+)$", PAGE, re.MULTILINE)
    return shlex.split(line)


def unwanted() -> list[str]:
    """Return what the page then lets pip do to take something away."""
    (line,) = re.findall(r"^\S+/bin/python -m pip (uninstall .+)$", PAGE, re.MULTILINE)
    return shlex.split(line)


def python_of_all() -> Path:
    """Return a Python that every account may run: ours, or that of the system."""
    for python in (Path(sys.executable).resolve(), PYTHON_OF_ALL):
        if is_open(python) and subprocess.run([python, "-c", IS_OLD], check=False).returncode == 0:
            return python
    pytest.fail(
        f"Students cannot run {Path(sys.executable).resolve()}, and {PYTHON_OF_ALL} is not there "
        "or older than 3.11: install python3."
    )


def is_open(path: Path) -> bool:
    """Tell whether everybody may go there."""
    return path.exists() and all(one.stat().st_mode & OPEN for one in (path, *path.parents))
