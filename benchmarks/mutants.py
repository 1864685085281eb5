"""Break the package in small ways and see whether a test fails: what lives is not tested.

``.venv/bin/python benchmarks/mutants.py --seed 1 --count 150`` breaks a copy of the workbook, one
place at a time: a comparison, a sign, a number, a returned value, a removed statement. First
coverage watches which lines each quick test runs. Then each mutant meets the tests that run its
line, those that tell most of its file a second first, until one fails. A line that all tests run
would take half an hour with each mutant that lives: `--most 300` leaves it at so many seconds. The
survivors are printed as diffs, for somebody to judge whether they change anything at all. It needs
coverage: `python -m pip install -e '.[benchmark]'`.
"""

import argparse
import compileall
import contextlib
import json
import math
import shutil
import signal
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor, as_completed
from itertools import islice
from pathlib import Path
from py_compile import PycInvalidationMode
from queue import SimpleQueue
from typing import Literal

import numpy as np
from breaking import ROOT, Mutant, files, mutants_of
from covering import PASSED, Covered, Running, file_of, is_watched, quick_tests, watch

NOT_COPIED = (".git", ".venv*", "work", "work-*", "__pycache__", ".*_cache", ".hypothesis")
_LONGER = 3  # times as long as without a mutant a test may take, and a minute

Fate = Literal["died", "took too long", "lives"]


class Bench:
    """Copies of the workbook, one for each process, in which tests run."""

    def __init__(self, folder: Path, processes: int) -> None:
        self.running = Running()
        self._free: SimpleQueue[Path] = SimpleQueue()
        for number in range(processes):
            copy = folder / str(number)
            shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*NOT_COPIED))
            # a broken file is known by its text, the others are not compiled for each mutant
            compileall.compile_dir(
                copy / "src", quiet=1, invalidation_mode=PycInvalidationMode.CHECKED_HASH
            )
            self._free.put(copy)

    @contextlib.contextmanager
    def copy(self) -> Iterator[Path]:
        """Lend a copy that nobody uses."""
        copy = self._free.get()
        try:
            yield copy
        finally:
            self._free.put(copy)

    def watch(self, test: str, limit: float, kept: Path) -> bool:
        """See which lines each test of a file runs, and how long it takes; False if it fails."""
        with self.copy() as copy:
            return watch(self.running, copy, test, limit, kept)

    def fate(self, mutant: Mutant, covered: Covered, most: float) -> Fate:
        """Try a mutant in a free copy, with tests of so many seconds at `most`.

        The copy is whole again afterwards.
        """
        if not (tests := covered.tests_of(mutant, most)):
            return "lives"
        seconds = 60 + _LONGER * sum(covered.seconds[test] for test in tests)
        with self.copy() as copy:
            broken, chosen = copy / mutant.path.relative_to(ROOT), copy / ".chosen.json"
            chosen.write_text(json.dumps(tests), encoding="utf-8")
            files = dict.fromkeys(map(file_of, tests))
            try:
                broken.write_text(mutant.text, encoding="utf-8")
                code = self.running.pytest(copy, [f"--chosen={chosen}", *files], seconds)
            finally:
                broken.write_text(mutant.whole, encoding="utf-8")
        if code is None:
            return "took too long"
        return "lives" if code == PASSED else "died"


def parse_arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description="Break the package, and see whether tests fail.")
    parser.add_argument("--count", type=int, default=150, help="how many mutants (150)")
    parser.add_argument("--seed", type=int, default=0, help="which ones (0)")
    parser.add_argument("--only", default="", help="a word that the path of the file contains")
    parser.add_argument("--lines", type=Path, help="keep here which tests run which lines")
    parser.add_argument("--seconds", type=float, default=1200, help="for a file of tests (1200)")
    parser.add_argument(
        "--most", type=float, default=math.inf, help="seconds of tests for each mutant (no limit)"
    )
    parser.add_argument("--processes", type=int, default=2, help="at a time (2)")
    return parser.parse_args()


def main() -> int:
    """Try the mutants and print what lives."""
    options = parse_arguments()
    every = [mutant for path in files() if options.only in str(path) for mutant in mutants_of(path)]
    order = np.random.default_rng(options.seed).permutation(len(every))
    mutants = [*islice((every[n] for n in order if every[n].is_python), options.count)]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.processes) as pool:
        bench, kept = Bench(Path(folder), options.processes), options.lines or Path(folder, "lines")
        kept.mkdir(parents=True, exist_ok=True)
        try:
            _cover(bench, pool, kept, options.seconds)
            fates = _try(mutants, Covered(kept), bench, pool, options.most)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            bench.running.stop()
    died = len(mutants) - fates["lives"]
    print(f"Of {len(mutants)} mutants out of {len(every)}, {died} died: {dict(fates)}")
    return 1 if fates["lives"] else 0


def _cover(bench: Bench, pool: ThreadPoolExecutor, kept: Path, limit: float) -> None:
    """See which tests run which lines; only those are run of which nothing is kept.

    What fails with nothing broken ends the run, once all the others are kept.
    """
    tests = [test for test in quick_tests() if not is_watched(test, kept)]
    watched = {pool.submit(bench.watch, test, limit, kept): test for test in tests}
    failed = []
    for number, done in enumerate(as_completed(watched), 1):
        failed += [] if done.result() else [watched[done]]
        print(f"[{number}/{len(tests)}] {watched[done]}", flush=True)
    if failed:
        sys.exit(f"With nothing broken fail, or take too long: {', '.join(failed)}.")


def _try(
    mutants: list[Mutant], covered: Covered, bench: Bench, pool: ThreadPoolExecutor, most: float
) -> Counter[Fate]:
    """Try the mutants, tell of each, and count how they end."""
    started = time.monotonic()
    fates: Counter[Fate] = Counter()
    tried = {pool.submit(bench.fate, mutant, covered, most): mutant for mutant in mutants}
    for done in as_completed(tried):
        mutant, fate = tried[done], done.result()
        fates[fate] += 1
        place = f"[{fates.total()}/{len(mutants)}]"
        print(f"{place} {mutant.name}: {fate} ({time.monotonic() - started:.0f} s)", flush=True)
        if fate == "lives":
            print(mutant.diff, flush=True)
    return fates


if __name__ == "__main__":
    sys.exit(main())
