"""Which tests run a line of the package: each test by itself, watched by coverage."""

import json
import os
import signal
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import suppress
from itertools import accumulate, zip_longest
from pathlib import Path

from breaking import ROOT, Mutant

SLOW = ("browser", "nbgrader", "hub", "binder", "colab", "notebook", "conftest")
PASSED = 0
_SETTINGS = "[run]\nrelative_files = true\nsource = src/cammotion\n"


class Running:
    """Runs pytest in a copy of the workbook; `stop` ends what runs."""

    def __init__(self) -> None:
        self._processes: set[subprocess.Popen[bytes]] = set()

    def pytest(self, copy: Path, given: Iterable[str], seconds: float, *before: str) -> int | None:
        """Return pytest's exit code, None if it takes longer; `before` watches over it."""
        command = [sys.executable, *before, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
        plugins = ("-p", "no:nbval", "-p", "single_tests", "-o", "addopts=--doctest-modules")
        paths = os.pathsep.join(map(str, (copy / "src", Path(__file__).parent)))
        process = subprocess.Popen(
            [*command, *plugins, *given],
            cwd=copy,
            env={**os.environ, "PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": ""},
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


def watch(running: Running, copy: Path, test: str, limit: float, kept: Path) -> None:
    """Run a file of tests in a copy of the workbook; keep what each test runs, and its time.

    It stops where the tests fail, or take too long.
    """
    from coverage import CoverageData

    lines, new = _kept(test, kept), copy / ".coverage-lines"
    settings = copy / ".coverage-settings"
    settings.write_text(_SETTINGS, "utf-8")
    before = ("-m", "coverage", "run", f"--rcfile={settings}", f"--data-file={new}")
    times = f"--times={lines.with_suffix('.times')}"
    if running.pytest(copy, [test, times], limit, *before) != PASSED:
        sys.exit(f"{test} fails, or takes too long, with nothing broken.")
    data = CoverageData(str(new))
    data.read()
    new.rename(lines)


def is_watched(test: str, kept: Path) -> bool:
    """Return whether it is kept what the tests of a file run."""
    return _kept(test, kept).exists()


def _kept(test: str, kept: Path) -> Path:
    return kept / f"{test.replace('/', '-')}.lines"


class Covered:
    """What each test runs, and how long it takes: two files in a folder for each file of tests."""

    def __init__(self, folder: Path) -> None:
        self._lines = [*folder.glob("*.lines")]
        self.seconds: dict[str, float] = {}
        for times in folder.glob("*.times"):
            self.seconds |= json.loads(times.read_text("utf-8"))
        self._tests: dict[str, list[str]] = defaultdict(list)
        for test in self.seconds:
            self._tests[file_of(test)].append(test)

    def tests_of(self, mutant: Mutant, most: float) -> list[str]:
        """Return the tests that may tell that a line is changed, those of a file together.

        What runs when a file is loaded is held to all that runs in it. Tests of the starter start
        it as another program, which nobody watches: all of them. Of more than so many seconds in
        all, `most`, each file of tests gives what tells most a second, in turn; where there is
        time left, its other tests come last, which may look at what was made once and kept.
        """
        path = mutant.path.relative_to(ROOT).as_posix()
        if path.startswith("starter/"):
            order = [test for test in self.seconds if "starter" in test or "workbook" in test]
        else:
            order = self._order(self._ran(path), mutant.told_on)
        spent = accumulate((self.seconds[test] for test in order), initial=0.0)
        chosen = [test for test, before in zip(order, spent, strict=False) if before <= most]
        files = {file: place for place, file in enumerate(dict.fromkeys(map(file_of, order)))}
        return sorted(chosen, key=lambda test: files[file_of(test)])

    def _order(self, ran: Mapping[int, set[str]], changed: Iterable[int]) -> list[str]:
        """Return the tests in the order in which they are worth their time."""
        told: Counter[str] = Counter()  # a line tells the less, the more tests run it
        for tests in ran.values():
            told.update(dict.fromkeys(tests, 1 / len(tests)))
        here = {test for line in changed for test in ran.get(line, ())} or {*told}
        running = _by_files(here, lambda test: told[test] / self.seconds[test])
        others = {test for file in running for test in self._tests[file]} - here
        beside = _by_files(others, lambda test: 1 / self.seconds[test])
        return [*_in_turn(running), *_in_turn(beside)]

    def _ran(self, path: str) -> dict[int, set[str]]:
        """Return which tests run each line of a file of the package, when it is loaded or later."""
        from coverage import CoverageData

        ran: dict[int, set[str]] = defaultdict(set)
        for kept in self._lines:
            lines = CoverageData(str(kept))
            lines.read()
            for line, names in lines.contexts_by_lineno(path).items():
                for name in names:  # of a test, of a file for what its tests share, or none
                    ran[line].update([name] if name in self.seconds else self._tests.get(name, ()))
        return ran


def file_of(test: str) -> str:
    """Return the file of tests in which a test stands."""
    return test.partition("::")[0]


def _by_files(tests: Iterable[str], telling: Callable[[str], float]) -> dict[str, list[str]]:
    """Return the tests of each file, one of each function first, what tells most first."""
    again: Counter[str] = Counter()
    files: dict[str, list[tuple[int, str]]] = defaultdict(list)
    for test in sorted(tests, key=telling, reverse=True):
        function = test.partition("[")[0]
        files[file_of(test)].append((again[function], test))
        again[function] += 1
    return {
        file: [test for _, test in sorted(rounds, key=lambda each: each[0])]
        for file, rounds in files.items()
    }


def _in_turn(files: Mapping[str, list[str]]) -> Iterator[str]:
    """Yield the first test of each file, then the second of each."""
    for some in zip_longest(*files.values()):
        yield from filter(None, some)
