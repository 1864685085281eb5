"""Expressions of motion laws as text, and text read as an expression without running any of it.

What may be written is `x`, numbers, pi and E, + - * / **, the functions of `FUNCTIONS`, and cases:
Piecewise((2*x**2, x <= 1/2), (1 - 2*(1 - x)**2, True)).
"""

import ast
import warnings
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import sympy
from sympy.printing.str import StrPrinter

from cammotion.laws.symbols import x
from cammotion.quantities import InputError, shorten

FUNCTIONS: dict[str, Any] = {
    name: getattr(sympy, name)
    for name in ("sin", "cos", "tan", "exp", "log", "sinh", "cosh", "tanh", "sqrt")
}
"""The functions that an expression may use, by their names."""

ALLOWED = f"x, numbers, pi, E, + - * / **, {', '.join(FUNCTIONS)} and Piecewise"
"""What an expression may be written in, in words."""

_NAMES = {"x": x, "pi": sympy.pi, "E": sympy.E}
_FORMS = (sympy.Add, sympy.Mul, sympy.Pow, *list(FUNCTIONS.values())[:-1])
_DEEPEST, _MOST_PARTS = 150, 50_000  # levels and parts of an expression
_STEEP = 10  # levels that a function or a power counts: its third derivative grows with each
_LARGEST = 1000  # exponent, and number of which a function is taken: more could take for ever
_BITS = 20_000  # of a whole number


def expression_as_text(expression: sympy.Expr) -> str:
    """Return an expression in `x` as text that `expression_from_text` reads; floats in full.

    >>> expression_as_text(0.1 * x + sympy.sin(2 * sympy.pi * x) / 3)
    '0.1*x + sin(2*pi*x)/3'
    """
    others = {part: sympy.Float(float(part)) for part in _other_numbers(expression)}
    return str(_Printer().doprint(expression.xreplace(others)))


def expression_from_text(text: str) -> sympy.Expr:
    """Return the expression that a text says; raise InputError for any other text.

    Nothing of it is run, whatever it says, and what could take for ever is refused.

    >>> expression_from_text("3*x**2 - 2*x**3")
    -2*x**3 + 3*x**2
    """
    try:
        tree = parsed(text)
        _check_size(tree)
        return _read_cases(tree)
    except InputError:
        raise
    except (SyntaxError, TypeError, ValueError, ArithmeticError, MemoryError, RecursionError):
        raise InputError(
            f"The expression {shorten(text)} cannot be read: look for a bracket or a sign too "
            f"many. It may have {ALLOWED}."
        ) from None


def parsed(text: str) -> Any:
    """Return the parts of a text that is one expression of Python's; nothing is run."""
    with warnings.catch_warnings(action="ignore"):  # of what looks odd in Python
        return ast.parse(text.strip(), mode="eval").body


class _Printer(StrPrinter):  # type: ignore[misc]
    """SymPy's own text, but floats with all their digits."""

    def _print_Float(self, number: sympy.Float) -> str:  # noqa: N802 - SymPy's name
        return repr(float(number))


def _other_numbers(expression: sympy.Basic) -> Iterator[sympy.Expr]:
    """Yield the numbers that have no text here, like gamma(1/3)."""
    if isinstance(expression, sympy.Expr) and not expression.free_symbols:
        known = expression.is_Rational or expression.is_Float or expression in _NAMES.values()
        if known or not isinstance(expression, _FORMS):
            yield from () if known else (expression,)
            return
    for part in expression.args:
        yield from _other_numbers(part)


def _check_size(tree: Any) -> None:
    waiting, parts = [(tree, 0)], 0
    while waiting:
        node, depth = waiting.pop()
        parts += 1
        if depth > _DEEPEST or parts > _MOST_PARTS:
            raise InputError(
                f"The expression has more than {_DEEPEST} levels or {_MOST_PARTS} parts: give a "
                "shorter one, or a table of its points to law_from_points."
            )
        for child in ast.iter_child_nodes(node):  # a sum is one level, however long it is
            goes_on = _is_sum(node) and _is_sum(child) and child is node.left
            is_steep = isinstance(node, ast.Call) or isinstance(getattr(node, "op", None), ast.Pow)
            waiting.append((child, depth + (_STEEP if is_steep else not goes_on)))


def _is_sum(node: ast.AST) -> bool:
    return isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add | ast.Sub)


def _terms(node: Any) -> Iterator[Any]:
    """Yield the terms of a sum, the last one first."""
    while _is_sum(node):
        term = _read(node.right)
        yield term if isinstance(node.op, ast.Add) else -term
        node = node.left
    yield _read(node)


def _read(node: ast.AST) -> Any:
    """Return what a part of the text says."""
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return sympy.sympify(number)
        case ast.Name(id=name) if name in _NAMES:
            return _NAMES[name]
        case ast.UnaryOp(op=ast.USub() | ast.UAdd() as sign, operand=inner):
            return -_read(inner) if isinstance(sign, ast.USub) else _read(inner)
        case ast.BinOp(op=sign) if type(sign) in _SIGNS:
            return _SIGNS[type(sign)](node)
        case ast.Call(func=ast.Name(id=name), args=[inner], keywords=[]) if name in FUNCTIONS:
            return FUNCTIONS[name](_tame(_read(inner)))
    raise InputError(
        f"The expression holds {shorten(ast.unparse(node))}: it may have only {ALLOWED}."
    )


def _read_cases(node: ast.AST) -> Any:
    """Return what the whole text says; only the whole can be in cases."""
    match node:
        case ast.Call(func=ast.Name(id="Piecewise"), args=[*first, last], keywords=[]):
            cases, ends = [_case(case, ast.Compare) for case in first], [0.0]
            for _, condition in cases:
                ends.append(float(condition.rhs))
            if not all(low < high < 1 for low, high in pairwise(ends)):
                raise InputError(
                    "The cases of the expression are not in order: let each end at a larger x "
                    "than the one before it, and the last one, with True, go on to 1."
                )
            return sympy.Piecewise(*cases, _case(last, ast.Constant), evaluate=False)
    return _read(node)


def _case(node: ast.AST, kind: type[ast.AST]) -> tuple[Any, Any]:
    """Return the expression and the condition of a case, x <= a number, or True."""
    match node:
        case ast.Tuple(elts=[inner, ast.Constant(value=True)]) if kind is ast.Constant:
            return _read(inner), sympy.true
        case ast.Tuple(
            elts=[inner, ast.Compare(left=ast.Name(id="x"), ops=[ast.LtE()], comparators=[end])]
        ) if kind is ast.Compare:
            return _read(inner), sympy.Le(x, _tame(_read(end)), evaluate=False)
    raise InputError(
        f"The case {shorten(ast.unparse(node))} cannot be read: write each one like "
        "(2*x**2, x <= 1/2), and the last one with True."
    )


def _product(node: ast.BinOp) -> Any:
    left, right = _read(node.left), _read(node.right)
    return left * right if isinstance(node.op, ast.Mult) else left / right


def _power(node: ast.BinOp) -> Any:
    base, exponent = _read(node.left), _tame(_read(node.right))
    if base.is_Rational and exponent.is_number:
        bits = max(base.p.bit_length(), base.q.bit_length())
        if bits * abs(exponent) > _BITS:
            raise InputError(f"The expression holds a number of more than {_BITS} bits.")
    return base**exponent


def _sum(node: ast.BinOp) -> Any:
    return sympy.Add(*_terms(node))


def _tame(number: Any) -> Any:
    """Return what is no number, or a real one of ordinary size; raise InputError for others."""
    if number.is_number and not abs(complex(number)) <= _LARGEST:
        raise InputError(
            f"The expression holds a power or a function of a number like {shorten(str(number))}: "
            f"keep such numbers below {_LARGEST}."
        )
    return number


_SIGNS: dict[type[ast.operator], Callable[[ast.BinOp], Any]] = {
    ast.Add: _sum,
    ast.Sub: _sum,
    ast.Mult: _product,
    ast.Div: _product,
    ast.Pow: _power,
}
