"""Environments of their own, to try places in that are not the workbook's own .venv.

Their tools live in .venv-places. REQUIRE_PLACES=1 makes it.
"""

import json
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
TOOLS = ROOT / ".venv-places"
NEEDED = ("jupyter-repo2docker==2026.4.0", "uv>=0.9")
VERSIONS = """
import json, re
from importlib.metadata import distributions
print(json.dumps({re.sub("[-_.]+", "-", d.metadata["Name"]).lower(): d.version
                  for d in distributions()}))
"""


def require_tools() -> None:
    """Install the tools if they are asked for; skip where they are neither asked for nor there."""
    if os.environ.get("REQUIRE_PLACES") == "1":
        run([sys.executable, "-m", "venv", str(TOOLS)], ROOT)
        run([str(TOOLS / "bin" / "pip"), "install", "-q", *NEEDED], ROOT)
    elif not (TOOLS / "bin" / "uv").exists():
        pytest.skip(
            f"NOT TESTED as on Binder and in Colab: there is no {TOOLS.name}. To make it: "
            "REQUIRE_PLACES=1 python3 workbook.py test tests/test_binder.py tests/test_colab.py"
        )


def run(command: list[str], folder: Path, **variables: str) -> str:
    """Run a command, and return all that it prints; fail with that if it fails."""
    ran = subprocess.run(
        command,
        cwd=folder,
        env={name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | variables,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        timeout=600,
    )
    assert ran.returncode == 0, f"{shlex.join(command)}\n{ran.stdout}"
    return ran.stdout


def copy_workbook(folder: Path) -> Path:
    """Copy what a commit of the workbook as it stands would hold, and return the copy."""
    listed = run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], ROOT)
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():  # and not just deleted
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


class Fresh:
    """An environment with nothing in it but pip."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.programs = folder, folder / "bin"
        self.uv = str(TOOLS / "bin" / "uv")
        run([self.uv, "venv", "-q", "--seed", "-p", sys.executable, str(folder)], ROOT)

    def python(self, *arguments: str, at: Path, **variables: str) -> str:
        """Run its Python."""
        return run([str(self.programs / "python"), *arguments], at, **variables)

    def install(self, requirements: str, at: Path) -> None:
        """Install a file of requirements as pip does, but from what uv has fetched before."""
        python = str(self.programs / "python")
        run([self.uv, "pip", "install", "-q", "-p", python, "-r", requirements], at)

    def versions(self) -> dict[str, str]:
        """Return what is installed, without pip and what came with it."""
        found: dict[str, str] = json.loads(self.python("-I", "-c", VERSIONS, at=self.folder))
        return {name: found[name] for name in found.keys() - {"pip", "setuptools", "wheel"}}
