"""Break the package in small ways and see whether a test fails: what lives is not tested.

``.venv/bin/python benchmarks/mutants.py --seed 1 --count 150`` breaks a copy of the workbook, one
place at a time: a comparison, a sign, a number, a returned value, a removed statement. First the
tests that speak of the broken file run; what they do not kill meets all quick tests. The survivors
are printed as diffs, for somebody to judge whether they change anything at all.
"""

import argparse
import ast
import compileall
import contextlib
import difflib
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, replace
from functools import cache
from itertools import islice
from pathlib import Path
from py_compile import PycInvalidationMode
from queue import SimpleQueue
from typing import Any, Literal

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
TESTS = ROOT / "tests"
LEFT_OUT = ("teaching/lessons/", "__init__.py", "__init__.pyi")
SLOW = ("browser", "nbgrader", "notebook", "solutions", "conftest")
_PASSED, _NOT_RUN = 0, (4, 5)  # exit codes of pytest
_WHOLE = 6  # times as long as the nearest tests the quick suite may take: half an hour alone
FEW, NEAREST = 3, 6  # test files: with fewer, those of the importers count too; at most so many
SOLVING = {"laws", "machine", "limits", "exchange"}  # the rooms that random machines try
NOT_COPIED = (".git", ".venv*", "work", "work-*", "__pycache__", ".*_cache", ".hypothesis")

OPERATORS: dict[type, tuple[type, ...]] = {
    ast.Lt: (ast.LtE, ast.Gt),
    ast.LtE: (ast.Lt, ast.Gt),
    ast.Gt: (ast.GtE, ast.Lt),
    ast.GtE: (ast.Gt, ast.Lt),
    ast.Eq: (ast.NotEq,),
    ast.NotEq: (ast.Eq,),
    ast.Is: (ast.IsNot,),
    ast.IsNot: (ast.Is,),
    ast.In: (ast.NotIn,),
    ast.NotIn: (ast.In,),
    ast.Add: (ast.Sub,),
    ast.Sub: (ast.Add,),
    ast.Mult: (ast.Div,),
    ast.Div: (ast.Mult,),
    ast.FloorDiv: (ast.Div,),
    ast.Mod: (ast.Add,),
    ast.Pow: (ast.Mult,),
    ast.And: (ast.Or,),
    ast.Or: (ast.And,),
}

Fate = Literal["died near", "died in the quick suite", "took too long", "lives"]


@dataclass(frozen=True)
class Mutant:
    """A file with one place changed: the bytes from `start` to `end`."""

    path: Path
    line: int
    raw: bytes
    start: int
    end: int
    new: str
    tests: tuple[str, ...] = ()

    @property
    def whole(self) -> str:
        """The file as it was."""
        return self.raw.decode()

    @property
    def text(self) -> str:
        """The file with the change."""
        return (self.raw[: self.start] + self.new.encode() + self.raw[self.end :]).decode()

    @property
    def is_python(self) -> bool:
        """Whether the file can still be read."""
        with contextlib.suppress(SyntaxError):
            ast.parse(self.text)
            return True
        return False

    @property
    def name(self) -> str:
        """Where it is."""
        return f"{self.path.relative_to(ROOT)}:{self.line}"

    @property
    def diff(self) -> str:
        """What it changes."""
        texts = self.whole.splitlines(), self.text.splitlines()
        lines = difflib.unified_diff(*texts, n=1, lineterm="")
        return "\n".join(line for line in lines if not line.startswith(("---", "+++")))


def mutants_of(path: Path) -> Iterator[Mutant]:
    """Yield every mutant of a file; some may no longer be Python."""
    raw = path.read_bytes()
    tree = ast.parse(raw)
    starts = np.cumsum([0, *(len(line) for line in raw.splitlines(keepends=True))])
    for node in _nodes(tree):
        for old, new in _changes(node):
            start = starts[old.lineno - 1] + old.col_offset
            end = starts[old.end_lineno - 1] + old.end_col_offset
            yield Mutant(path, old.lineno, raw, start, end, new)


def _nodes(tree: ast.AST) -> Iterator[Any]:
    """Yield what may be changed: no annotation, no docstring."""
    for field, value in ast.iter_fields(tree):
        if field in {"annotation", "returns", "type_params"}:
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                if isinstance(child, ast.expr | ast.stmt):
                    yield child
                yield from _nodes(child)


def _changes(node: Any) -> Iterator[tuple[Any, str]]:
    """Yield what may stand in the place of a node, or of a part of it."""
    if isinstance(node, ast.Constant):
        yield from ((node, other) for other in _other_constants(node.value))
    elif isinstance(node, ast.expr):
        yield from ((node, other) for other in _other_operators(node))
    elif isinstance(node, ast.Return) and not _is_none(node.value):
        yield node, "return None"
    elif _does_something(node):
        yield node, "pass"
    if isinstance(node, ast.If | ast.IfExp):
        yield node.test, f"(not ({ast.unparse(node.test)}))"


def _other_constants(value: Any) -> set[str]:
    if isinstance(value, bool):
        return {str(not value)}
    return {repr(n) for n in {value + 1, 2 * value} - {value}} if _is_number(value) else set()


def _other_operators(node: Any) -> Iterator[str]:
    if isinstance(node, ast.Compare):
        for place, op in enumerate(node.ops):
            for other in OPERATORS.get(type(op), ()):
                yield _with(node, ops=[*node.ops[:place], other(), *node.ops[place + 1 :]])
    elif isinstance(node, ast.BinOp | ast.BoolOp):
        for other in OPERATORS.get(type(node.op), ()):
            yield _with(node, op=other())
    elif isinstance(node, ast.UnaryOp):
        yield f"({ast.unparse(node.operand)})"


def _does_something(node: Any) -> bool:
    """Tell what can be left out without a name that is missing later."""
    if isinstance(node, ast.Assign):
        return not isinstance(node.targets[0], ast.Name | ast.Tuple)
    is_call = isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)
    return is_call or isinstance(node, ast.AugAssign | ast.Raise)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float)


def _is_none(value: ast.expr | None) -> bool:
    return value is None or (isinstance(value, ast.Constant) and value.value is None)


def _with(node: Any, **changed: Any) -> str:
    fields = {**dict(ast.iter_fields(node)), **changed}
    return f"({ast.unparse(type(node)(**fields))})"


def files() -> list[Path]:
    """Return the files that are broken."""
    found = [*(ROOT / "src" / "cammotion").rglob("*.py"), *(ROOT / "starter").glob("*.py")]
    return sorted(path for path in found if not any(word in str(path) for word in LEFT_OUT))


@cache
def quick_tests() -> dict[Path, Counter[str]]:
    """Return the test files that take no minutes, and how often each speaks of a name."""
    paths = (p for p in TESTS.glob("test_*.py") if not any(word in p.name for word in SLOW))
    return {path: _spoken(path) for path in sorted(paths)}


@cache
def near_tests(path: Path) -> tuple[str, ...]:
    """Return the doctests of a file and the test files that speak most of what it defines."""
    of_starter = path.parent.name == "starter"
    tests = {
        test: names
        for test, names in quick_tests().items()
        if of_starter == ("starter" in test.name or "workbook" in test.name)
    }
    words = {path.stem, *({path.parent.name} if "views" in path.parts else ())}
    own = [test for test in tests if any(f"_{word}" in test.stem for word in words)]
    scores = _scores(tests, _defined(path))
    if len(scores) < FEW:
        for importer in files():
            if re.search(rf"\b{path.stem} import", importer.read_text(encoding="utf-8")):
                scores += _scores(tests, _defined(importer))
    nearest = tests if of_starter else [test for test, _ in scores.most_common(NEAREST)]
    doctests = [] if of_starter else [path]
    general = [] if of_starter else [TESTS / "test_house.py"]
    general += [TESTS / "test_fresh.py"] if SOLVING & {*path.parts} else []
    general += [TESTS / "test_readme.py"] if "views" in path.parts else []
    return _relative(dict.fromkeys([*doctests, *own, *nearest, *general]))


def _relative(paths: Iterable[Path]) -> tuple[str, ...]:
    return tuple(str(path.relative_to(ROOT)) for path in paths)


def _spoken(path: Path) -> Counter[str]:
    """Count the names that a file imports or takes out of a module or an object."""
    nodes = [*ast.walk(ast.parse(path.read_text(encoding="utf-8")))]
    names = [node.name for node in nodes if isinstance(node, ast.alias)]
    return Counter([*names, *(node.attr for node in nodes if isinstance(node, ast.Attribute))])


def _defined(path: Path) -> set[str]:
    """Return the names that a file defines, those of its methods too."""
    nodes = [*ast.walk(ast.parse(path.read_text(encoding="utf-8")))]
    kinds = ast.FunctionDef | ast.ClassDef
    names = {node.name for node in nodes if isinstance(node, kinds)}
    stored = {n.id for n in nodes if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    return {name for name in names if not name.startswith("__")} | {
        name for name in stored if name.isupper() and not name.startswith("_")
    }


def _scores(tests: Mapping[Path, Counter[str]], names: set[str]) -> Counter[Path]:
    counts = {test: sum(spoken[name] for name in names) for test, spoken in tests.items()}
    return Counter({test: count for test, count in counts.items() if count})


class Bench:
    """Copies of the workbook, one for each process, in which mutants are tried."""

    def __init__(self, folder: Path, processes: int, seconds: float, near_only: bool) -> None:
        self.seconds, self.near_only = seconds, near_only
        self.free: SimpleQueue[Path] = SimpleQueue()
        self.running: set[subprocess.Popen[bytes]] = set()
        for number in range(processes):
            copy = folder / str(number)
            shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(*NOT_COPIED))
            # a broken file is known by its text, the others are not compiled for each mutant
            compileall.compile_dir(
                copy / "src", quiet=1, invalidation_mode=PycInvalidationMode.CHECKED_HASH
            )
            self.free.put(copy)

    def is_whole(self) -> bool:
        """Whether all quick tests pass while nothing is broken."""
        copy = self.free.get()
        try:
            return self._run(copy, _relative(quick_tests()), _WHOLE * self.seconds) == _PASSED
        finally:
            self.free.put(copy)

    def fate(self, mutant: Mutant) -> Fate:
        """Try a mutant in a free copy; the copy is whole again afterwards."""
        copy = self.free.get()
        broken = copy / mutant.path.relative_to(ROOT)
        try:
            broken.write_text(mutant.text, encoding="utf-8")
            steps: list[tuple[Fate, tuple[str, ...], float]] = [
                ("died near", mutant.tests, self.seconds)
            ]
            if not self.near_only:
                whole = _relative(quick_tests()), _WHOLE * self.seconds
                steps.append(("died in the quick suite", *whole))
            for fate, tests, seconds in steps:
                code = self._run(copy, tests, seconds)
                if code != _PASSED:
                    return "took too long" if code is None else fate
            return "lives"
        finally:
            broken.write_text(mutant.whole, encoding="utf-8")
            self.free.put(copy)

    def _run(self, copy: Path, tests: Iterable[str], seconds: float) -> int | None:
        """Run tests in a copy; return pytest's exit code, None if it takes too long."""
        environment = {
            **os.environ,
            "PYTHONPATH": str(copy / "src"),
            "PYTHONDONTWRITEBYTECODE": "1",
        }
        command = [sys.executable, "-m", "pytest", "-x", "-q", "-p", "no:cacheprovider"]
        process = subprocess.Popen(
            [*command, "-p", "no:nbval", "-o", "addopts=--doctest-modules", *tests],
            cwd=copy,
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            start_new_session=True,
        )
        self.running.add(process)
        try:
            code = process.wait(seconds)
            if code in _NOT_RUN:
                raise RuntimeError(f"pytest cannot run {tests} (exit code {code})")
            return code
        except subprocess.TimeoutExpired:
            return None
        finally:
            self.running.discard(process)
            _end(process)

    def stop(self) -> None:
        """End what runs."""
        for process in [*self.running]:
            _end(process)


def _end(process: "subprocess.Popen[bytes]") -> None:
    """End a process with all that it has started, and wait for it."""
    with contextlib.suppress(ProcessLookupError, PermissionError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def parse_arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description="Break the package, and see whether tests fail.")
    parser.add_argument("--count", type=int, default=150, help="how many mutants (150)")
    parser.add_argument("--seed", type=int, default=0, help="which ones (0)")
    parser.add_argument("--only", default="", help="a word that the path of the file contains")
    parser.add_argument("--near-only", action="store_true", help="leave out the quick suite")
    parser.add_argument("--seconds", type=float, default=600, help="for the nearest tests (600)")
    parser.add_argument("--processes", type=int, default=2, help="at a time (2)")
    return parser.parse_args()


def main() -> int:
    """Try the mutants and print what lives."""
    options = parse_arguments()
    every = [mutant for path in files() if options.only in str(path) for mutant in mutants_of(path)]
    order = np.random.default_rng(options.seed).permutation(len(every))
    chosen = islice((every[n] for n in order if every[n].is_python), options.count)
    mutants = [replace(mutant, tests=near_tests(mutant.path)) for mutant in chosen]
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.processes) as pool:
        bench = Bench(Path(folder), options.processes, options.seconds, options.near_only)
        try:
            fates = _try(mutants, bench, pool)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
            bench.stop()
    died = len(mutants) - fates["lives"]
    print(f"Of {len(mutants)} mutants out of {len(every)}, {died} died: {dict(fates)}")
    return 1 if fates["lives"] else 0


def _try(mutants: list[Mutant], bench: Bench, pool: ThreadPoolExecutor) -> Counter[Fate]:
    """Try the mutants, tell of each, and count how they end."""
    started = time.monotonic()
    is_whole = pool.submit(bench.is_whole)
    fates: Counter[Fate] = Counter()
    tried = {pool.submit(bench.fate, mutant): mutant for mutant in mutants}
    for done in as_completed(tried):
        mutant, fate = tried[done], done.result()
        fates[fate] += 1
        place = f"[{fates.total()}/{len(mutants)}]"
        print(f"{place} {mutant.name}: {fate} ({time.monotonic() - started:.0f} s)", flush=True)
        if fate == "lives":
            print(mutant.diff, flush=True)
        if is_whole.done() and not is_whole.result():
            break
    if not is_whole.result():
        sys.exit("The quick tests fail, or take too long, with nothing broken.")
    return fates


if __name__ == "__main__":
    sys.exit(main())
