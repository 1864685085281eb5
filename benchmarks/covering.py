"""Which tests run a line of the package: each test by itself, watched by coverage."""

import json
import os
import shutil
import signal
import subprocess
import sys
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from contextlib import suppress
from itertools import accumulate, zip_longest
from pathlib import Path

from breaking import ROOT, Mutant

SLOW = ("browser", "nbgrader", "hub", "binder", "colab", "notebook", "conftest")
PASSED = 0
_LITTLE = 1e-6  # what a test tells that runs no line of the file
_QUICK = 0.1  # s, of which there may be many
_SHORT = 0.05  # s that a test takes at least, with what it shares with others
_TEXTS = sorted((ROOT / "tests" / "data").glob("*.txt"))
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


def watch(running: Running, copy: Path, test: str, limit: float, kept: Path) -> bool:
    """Run a file of tests in a copy of the workbook; keep what each test runs, and its time.

    It is False where the tests fail, or take too long: then nothing is kept.
    """
    lines, new = _kept(test, kept), copy / ".coverage-lines"
    settings = copy / ".coverage-settings"
    settings.write_text(_SETTINGS, "utf-8")
    before = ("-m", "coverage", "run", f"--rcfile={settings}", f"--data-file={new}")
    times = f"--times={lines.with_suffix('.times')}"
    if running.pytest(copy, [test, times], limit, *before) != PASSED:
        return False
    shutil.move(new, lines)
    return True


def is_watched(test: str, kept: Path) -> bool:
    """Return whether it is kept what the tests of a file run."""
    return _kept(test, kept).exists()


def _kept(test: str, kept: Path) -> Path:
    return kept / f"{test.replace('/', '-')}.lines"


class Covered:
    """What each test runs, and how long it takes: two files in a folder for each file of tests."""

    def __init__(self, folder: Path) -> None:
        self.seconds: dict[str, float] = {}
        self._tests: dict[str, list[str]] = defaultdict(list)
        self._lines: list[tuple[Path, set[str]]] = []
        for lines in sorted(folder.glob("*.lines")):
            seconds = json.loads(lines.with_suffix(".times").read_text("utf-8"))
            for test, lasted in seconds.items():
                self.seconds[test] = max(lasted, _SHORT)
                self._tests[file_of(test)].append(test)
            self._lines.append((lines, {*map(file_of, seconds)}))

    def tests_of(self, mutant: Mutant, most: float) -> list[str]:
        """Return the tests that may tell that a line is changed, those of a file together.

        First those that run it; then those that run its function, which may have made something
        while a file was loaded; then the others of their files, which may look at what was made
        once and kept. What runs when a file is loaded is told first by files of tests that read a
        text with its name, then by those that run a line with it, in any file of the package, by
        files that say it, and by all that have loaded it. Tests of the starter start it as another
        program, which nobody watches: all of them. Of more than so many seconds in all, `most`,
        each file of tests gives what tells most a second, in turn.
        """
        chosen: list[str] = []
        left = most
        for tests in self._groups(mutant):
            spent = accumulate((self.seconds[test] for test in tests), initial=0.0)
            some = [test for test, before in zip(tests, spent, strict=False) if before <= left]
            files = {file: place for place, file in enumerate(dict.fromkeys(map(file_of, some)))}
            chosen += sorted(some, key=lambda test: files[file_of(test)])
            left -= sum(self.seconds[test] for test in some)
        return chosen

    def _groups(self, mutant: Mutant) -> Iterator[list[str]]:
        """Yield tests that are less and less likely to tell, in the order to choose from them."""
        path = mutant.path.relative_to(ROOT).as_posix()
        if path.startswith("starter/"):
            yield [
                *self._of(file for file in self._tests if "starter" in file or "workbook" in file)
            ]
            return
        ran, loading = self._ran(path)
        told: Counter[str] = Counter()  # a line tells the less, the more tests run it
        for tests in ran.values():
            told.update(dict.fromkeys(tests, 1 / max(len(tests), 1)))
        here: set[str] = set()
        for taking, lines in mutant.told_on().items():
            there, _ = self._ran(taking.relative_to(ROOT).as_posix())
            here |= {test for line in lines for test in there.get(line, ())}
        quick = {test for test in here if self.seconds[test] <= _QUICK}
        around = {test for line in mutant.around for test in ran.get(line, ())}
        groups = [quick, here, around, self._of(map(file_of, here | around))]
        if names := mutant.names:
            saying = {file for file in loading if _says(file, names)}
            keeping = {file for file in loading if _says_kept(file, names)}
            groups = [self._of(keeping), *groups, self._of(saying), self._of(loading)]
        known: set[str] = set()
        for some in groups:
            yield _in_turn(some - known, lambda t: (told[t] or _LITTLE) / self.seconds[t])
            known |= some

    def _of(self, files: Iterable[str]) -> set[str]:
        return {test for file in {*files} for test in self._tests[file]}

    def _ran(self, path: str) -> tuple[dict[int, set[str]], set[str]]:
        """Return which tests run each line of a file of the package, and which files load it."""
        from coverage import CoverageData

        ran: dict[int, set[str]] = defaultdict(set)
        loading: set[str] = set()
        for kept, files in self._lines:
            lines = CoverageData(str(kept))
            lines.read()
            for line, names in lines.contexts_by_lineno(path).items():
                for name in names:  # of a test, of a file for what its tests share, or none
                    ran[line].update([name] if name in self.seconds else self._tests.get(name, ()))
                    loading.update([file_of(name)] if name else files)
        return ran, loading


def _says(file: str, names: Iterable[str]) -> bool:
    """Tell whether a file of tests says one of the names."""
    said = (ROOT / file).read_text("utf-8")
    return any(name in said for name in names)


def _says_kept(file: str, names: Iterable[str]) -> bool:
    """Tell whether a text that a file of tests reads says one of the names."""
    said = (ROOT / file).read_text("utf-8")
    kept = (path.read_text("utf-8") for path in _TEXTS if f'"{path.name}"' in said)
    return any(name in text for text in kept for name in names)


def file_of(test: str) -> str:
    """Return the file of tests in which a test stands."""
    return test.partition("::")[0]


def _in_turn(tests: Iterable[str], telling: Callable[[str], float]) -> list[str]:
    """Return a test of each file, then another; of a function one first, what tells most first."""
    again: Counter[str] = Counter()
    files: dict[str, list[tuple[int, str]]] = defaultdict(list)
    for test in sorted(tests, key=telling, reverse=True):
        function = test.partition("[")[0]
        files[file_of(test)].append((again[function], test))
        again[function] += 1
    rounds = (sorted(some, key=lambda each: each[0]) for some in files.values())
    return [each[1] for turn in zip_longest(*rounds) for each in turn if each]
