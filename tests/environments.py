"""Environments of their own, beside the workbook's .venv, to try other places in.

They are made with uv where it is on the PATH, in seconds, and else with pip.
"""

import json
import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path
from sysconfig import get_path

ROOT = Path(__file__).parent.parent
ON_WINDOWS = os.name == "nt"
VERSIONS = """
import json, re
from importlib.metadata import distributions
print(json.dumps({re.sub("[-_.]+", "-", d.metadata["Name"]).lower(): d.version
                  for d in distributions()}))
"""
TELL_PACKAGES = "import sysconfig; print(sysconfig.get_path('purelib'))"
NOT_OURS = {"PYTHONPATH", "PYTHONDONTWRITEBYTECODE"}  # each process would compile all anew
Word = str | Path


def run(*command: Word, at: Path = ROOT, told: str = "", **variables: str) -> str:
    """Run a command in a folder, and return all that it prints; fail with that if it fails.

    It is `told` this text, and given these variables. All may read what it makes.
    """
    words = [str(word) for word in command]
    ran = subprocess.run(
        words,
        cwd=at,
        env={name: value for name, value in os.environ.items() if name not in NOT_OURS} | variables,
        umask=0o022,
        input=told,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        timeout=600,
    )
    assert ran.returncode == 0, f"{shlex.join(words)}\n{ran.stdout}"
    return ran.stdout


def copy_workbook(folder: Path) -> Path:
    """Copy what a commit of the workbook as it stands would hold, and return the copy."""
    listed = run("git", "ls-files", "-z", "--cached", "--others", "--exclude-standard")
    for name in filter(None, listed.split("\0")):
        if (ROOT / name).is_file():  # and not just deleted
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, folder / name)
    return folder


class Environment:
    """The environment in a folder; `make` brings it there, and up to date."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.programs = folder / ("Scripts" if ON_WINDOWS else "bin")

    def program(self, name: str) -> Path:
        """Return the path of one of its programs."""
        return self.programs / (f"{name}.exe" if ON_WINDOWS else name)

    @property
    def packages(self) -> Path:
        """The folder in which its packages are."""
        return Path(self.python("-c", TELL_PACKAGES, at=self.folder).strip())

    def make(self, python: Word = sys.executable) -> "Environment":
        """Make it, with this Python and pip, if it is not there."""
        if not self.program("python").exists():
            uv = shutil.which("uv")
            maker: Iterable[Word] = (
                (uv, "venv", "-q", "--seed", "-p", python) if uv else (python, "-m", "venv")
            )
            run(*maker, self.folder)
        return self

    def install(self, *wanted: Word, at: Path = ROOT, for_others: bool = False) -> None:
        """Install what pip would by these words, in a folder.

        What is `for_others` is compiled: they cannot. Else it is when it is imported.
        """
        python, uv = self.program("python"), shutil.which("uv")
        tool: Iterable[Word] = (python, "-m", "pip", "install")
        if uv:  # as pip always does, take the package as it is now
            tool = (uv, "pip", "install", "-p", python, "--reinstall-package", "cammotion")
        run(*tool, "-q", *wanted, at=at)
        if uv:  # pip compiles what it installs
            self._borrow_compiled()
        if uv and for_others:
            run(python, "-m", "compileall", "-q", self.packages)

    def _borrow_compiled(self) -> None:
        """Take what Python has compiled for us of the files that uv has linked in both places."""
        theirs, ours = self.packages, Path(get_path("purelib"))
        for compiled in ours.rglob(f"*.{sys.implementation.cache_tag}.pyc"):
            source = ours / compiled.parent.parent / f"{compiled.name.partition('.')[0]}.py"
            same, taken = (theirs / each.relative_to(ours) for each in (source, compiled))
            if not taken.exists() and same.exists() and same.samefile(source):
                taken.parent.mkdir(exist_ok=True)
                taken.hardlink_to(compiled)

    def python(self, *words: Word, at: Path, **variables: str) -> str:
        """Run its Python."""
        return run(self.program("python"), *words, at=at, **variables)

    def versions(self) -> dict[str, str]:
        """Return what is installed, without pip and what came with it."""
        found: dict[str, str] = json.loads(self.python("-I", "-c", VERSIONS, at=self.folder))
        return {name: found[name] for name in found.keys() - {"pip", "setuptools", "wheel"}}
