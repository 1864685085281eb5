"""Which tests run a line of the package: each file of tests alone, watched by coverage."""

import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import accumulate
from pathlib import Path

from breaking import ROOT, Mutant

SLOW = ("browser", "nbgrader", "hub", "binder", "colab", "notebook", "conftest")
PASSED = 0
Lines = dict[str, list[int]]
_WATCHED = "src/cammotion,starter"


class Running:
    """Runs pytest in a copy of the workbook; `stop` ends what runs."""

    def __init__(self) -> None:
        self._processes: set[subprocess.Popen[bytes]] = set()

    def pytest(self, copy: Path, tests: Iterable[str], seconds: float, *before: str) -> int | None:
        """Return pytest's exit code, None if it takes longer; `before` watches over it."""
        command = [sys.executable, *before, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
        process = subprocess.Popen(
            [*command, "-p", "no:nbval", "-o", "addopts=--doctest-modules", *tests],
            cwd=copy,
            env={**os.environ, "PYTHONPATH": str(copy / "src"), "PYTHONDONTWRITEBYTECODE": "1"},
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        self._processes.add(process)
        try:
            return process.wait(seconds)
        except subprocess.TimeoutExpired:
            return None
        finally:
            self._processes.discard(process)
            _end(process)

    def stop(self) -> None:
        """End what runs."""
        for process in [*self._processes]:
            _end(process)


def _end(process: "subprocess.Popen[bytes]") -> None:
    """End a process with all that it has started, and wait for it."""
    with suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def quick_tests() -> list[str]:
    """Return the test files that take no minutes, and the rooms of the package for doctests."""
    tests = (p for p in (ROOT / "tests").glob("test_*.py") if not any(w in p.name for w in SLOW))
    rooms = (p.parent for p in (ROOT / "src" / "cammotion").glob("*/__init__.py"))
    return sorted(str(path.relative_to(ROOT)) for path in (*tests, *rooms))


def watch(running: Running, copy: Path, test: str, limit: float) -> tuple[float, Lines]:
    """Run a file of tests in a copy of the workbook; return its time, and the lines by paths.

    It stops where the tests fail, or take too long.
    """
    from coverage import CoverageData

    data, begun = copy / f".coverage-{test.replace('/', '-')}", time.monotonic()
    before = ("-m", "coverage", "run", f"--source={_WATCHED}", f"--data-file={data}")
    if running.pytest(copy, [test], limit, *before) != PASSED:
        sys.exit(f"{test} fails, or takes too long, with nothing broken.")
    seconds = time.monotonic() - begun
    found = CoverageData(str(data))
    found.read()
    paths = {file: str(Path(file).relative_to(copy.resolve())) for file in found.measured_files()}
    lines = {path: [*(found.lines(file) or ())] for file, path in paths.items()}
    data.unlink()
    return seconds, lines


@dataclass
class Covered:
    """What each file of tests runs, and how long it takes, by paths in the workbook."""

    seconds: dict[str, float] = field(default_factory=dict)
    lines: dict[str, dict[str, list[int]]] = field(default_factory=dict)

    def add(self, test: str, seconds: float, lines: Lines) -> None:
        """Keep what was seen of a file of tests."""
        self.seconds[test] = seconds
        for path, ran in lines.items():
            self.lines.setdefault(path, {})[test] = ran

    def tests_of(self, mutant: Mutant, most: float) -> list[str]:
        """Return the tests that run a changed line, those that tell most of its file first.

        That is by the second. A line tells the less, the more tests run it: what a file does when
        it is loaded, all do. Those of the starter start it as another program, which nobody
        watches: all of them. Of more than so many seconds in all, `most`, only the first.
        """
        path = str(mutant.path.relative_to(ROOT))
        here = {test: {*lines} for test, lines in self.lines.get(path, {}).items()}
        if path.startswith("starter/"):
            tests = [test for test in self.seconds if "starter" in test or "workbook" in test]
        else:
            ran = Counter(line for lines in here.values() for line in lines)
            tests = sorted(
                (test for test, lines in here.items() if lines.intersection(mutant.lines)),
                key=lambda test: self.seconds[test] / sum(1 / ran[line] for line in here[test]),
            )
        spent = accumulate((self.seconds[test] for test in tests), initial=0.0)
        return [test for test, before in zip(tests, spent, strict=False) if before <= most]

    def save(self, file: Path) -> None:
        """Write it down for another run."""
        file.write_text(json.dumps(vars(self)), encoding="utf-8")


def read_covered(file: Path) -> Covered:
    """Read what was written down before."""
    return Covered(**json.loads(file.read_text(encoding="utf-8")))
