"""Run the linters and tests, pin the dependencies."""

import contextlib
import os
import subprocess
from collections.abc import Iterator

from starter import installer, processes
from starter.errors import WorkbookError
from starter.paths import ROOT, VENV_PYTHON

FRESH = ROOT / "tests" / "run_fresh.py"
LINTERS = ("ruff check .", "ruff format --check .", "mypy")
# One file of tests more at a time than there are processors: some wait for a browser or a server.
# Each is run by one process, which makes its fixtures once, in the order of conftest.py.
AT_ONCE = min(4, (os.cpu_count() or 1) + 1)
IN_PARALLEL = ("-n", str(AT_ONCE), "--dist", "loadfile", "--no-loadscope-reorder")
_LONGEST_LOADING = 60  # seconds


def test(arguments: list[str]) -> int:
    """Run the linters and pytest; only pytest with arguments, only machines with --fresh."""
    if arguments[:1] == ["--fresh"]:
        return run_python(str(FRESH), *arguments[1:])
    if arguments:
        print("pytest")
        return run_module("pytest", *arguments)
    failed = []
    with _compiling_the_tests():
        for number, step in enumerate(LINTERS, 1):
            print(f"[{number}/4] {step}")
            if run_module(*step.split()) != 0:
                failed.append(step)
    if failed:
        print(f"Failed before pytest: {', '.join(failed)}")
    print("[4/4] pytest")
    code = run_module("pytest", *IN_PARALLEL)
    return code or (1 if failed else 0)


@contextlib.contextmanager
def _compiling_the_tests() -> Iterator[None]:
    """Let pytest load all tests beside the linters, of which each has one processor.

    What it compiles each process of tests would compile for itself.
    """
    loading = subprocess.Popen(
        [str(VENV_PYTHON), "-m", "pytest", "--collect-only", "-qq"],
        cwd=ROOT,
        env=processes.environ(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        yield
        processes.stop(loading, grace=_LONGEST_LOADING)
    finally:
        processes.stop(loading)


def run_module(*arguments: str) -> int:
    """Run a module of the environment in the workbook's folder; return its exit code."""
    return run_python("-m", *arguments)


def run_python(*arguments: str) -> int:
    """Run the environment's Python in the workbook's folder; return its exit code.

    If a signal ended it, that is what a shell makes of it.
    """
    command = [str(VENV_PYTHON), *arguments]
    child = subprocess.Popen(command, cwd=ROOT, env=processes.environ(), text=True)
    code = processes.wait_for(child)
    return code if code >= 0 else 128 - code


def lock(upgrade: bool) -> None:
    """Write environment.txt anew from pyproject.toml."""
    uv = installer.find_uv()
    if not uv:
        raise WorkbookError("lock needs uv (https://docs.astral.sh/uv/): install it first.")
    command = [
        *(uv, "pip", "compile", "--quiet", "--universal", "--python-version=3.11"),
        *("--no-emit-index-url", "--no-emit-find-links"),
        *("--custom-compile-command=python3 workbook.py lock", "--output-file=environment.txt"),
        *(["--upgrade"] if upgrade else []),
        "-",
    ]
    if subprocess.run(command, cwd=ROOT, input="-e .[lab,site,test]\n", text=True).returncode != 0:
        raise WorkbookError("environment.txt was not written: uv's lines above say why.")
    print("environment.txt is up to date with pyproject.toml.")
