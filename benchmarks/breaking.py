"""Small ways to break a file: what another sign, number or comparison would make of it."""

import ast
import contextlib
import difflib
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
_FEW = 12  # files that take a name
LEFT_OUT = ("teaching/lessons/", "__init__.py", "__init__.pyi")

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


@dataclass(frozen=True)
class Mutant:
    """A file with one place changed: the bytes from `start` to `end`."""

    path: Path
    line: int
    raw: bytes
    start: int
    end: int
    new: str
    lines: range
    """From where the statement begins to where the changed place ends."""

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
    def names(self) -> set[str]:
        """What is named by the statement, if it is in no function and runs when it is loaded."""
        if self.around:
            return set()
        nodes = ast.walk(ast.parse(self.raw))
        return {_given(node) for node in nodes if getattr(node, "lineno", 0) in self.lines} - {""}

    @property
    def around(self) -> range:
        """The lines of the outermost function in whose body it is, if it is in one."""
        for node in ast.walk(ast.parse(self.raw)):
            if isinstance(node, ast.FunctionDef):
                body = range(node.body[0].lineno, (node.end_lineno or 0) + 1)
                if self.line in body:
                    return body
        return range(0)

    def told_on(self) -> dict[Path, set[int]]:
        """Return the lines that may tell of it: its own, or those in which its names are taken.

        What many files take is looked for in its own file only.
        """
        if not (names := self.names):
            return {self.path: {*self.lines}}
        lines = {path: {n for name in names for n in _takers(path)[name]} for path in _package()}
        taking = {path: found for path, found in lines.items() if found}
        return taking if len(taking) <= _FEW else {self.path: lines[self.path]}

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
    for first, node in _nodes(tree, 1):
        for old, new in _changes(node):
            start = starts[old.lineno - 1] + old.col_offset
            end = starts[old.end_lineno - 1] + old.end_col_offset
            lines = range(min(first, old.lineno), old.end_lineno + 1)  # a decorator is above
            yield Mutant(path, old.lineno, raw, start, end, new, lines)


@cache
def _takers(path: Path) -> defaultdict[str | None, set[int]]:
    """Return the lines of a file in which each name is taken."""
    found: defaultdict[str | None, set[int]] = defaultdict(set)
    for node in ast.walk(ast.parse(path.read_bytes())):
        found[_taken(node)].add(getattr(node, "lineno", 0))
    return found


def _given(node: ast.AST) -> str:
    """Return the name that a place gives to something, if any."""
    if isinstance(node, ast.ClassDef | ast.FunctionDef):
        return node.name
    return node.id if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) else ""


def _taken(node: ast.AST) -> str | None:
    """Return the name by which a place takes something, if any."""
    if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load):
        return node.id
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.arg if isinstance(node, ast.keyword) else None


def _nodes(tree: ast.AST, first: int) -> Iterator[tuple[int, Any]]:
    """Yield what may be changed, no annotation and no docstring, and where its statement begins."""
    for field, value in ast.iter_fields(tree):
        if field in {"annotation", "returns", "type_params"}:
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST):
                at = child.lineno if isinstance(child, ast.stmt) else first
                if isinstance(child, ast.expr | ast.stmt):
                    yield at, child
                yield from _nodes(child, at)


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
    return [path for path in _package() if not any(word in str(path) for word in LEFT_OUT)]


def _package() -> list[Path]:
    found = [*(ROOT / "src" / "cammotion").rglob("*.py"), *(ROOT / "starter").glob("*.py")]
    return sorted(found)
