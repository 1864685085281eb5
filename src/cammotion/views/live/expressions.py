"""What may stand in a live figure: expressions of SymPy, and what is said of those that may not."""

from collections.abc import Iterator
from contextlib import contextmanager, suppress
from numbers import Integral
from typing import Any

import numpy as np
import sympy as sp

from cammotion.laws.motion_law import MotionLaw
from cammotion.quantities import InputError, is_real, shorten

NOW = sp.Dummy("now", real=True)
"""Where the clock stands. In a line the variable runs: what of it moves depends on this."""

_LONGEST = 70  # of an expression in a sentence
_MOST = 10**300  # beyond it a number is none in a page
_UNDONE = sp.Derivative, sp.Integral, sp.Sum, sp.Product, sp.Limit, sp.Subs
_ATOMS = sp.Symbol, sp.Lambda, sp.Number, sp.NumberSymbol, sp.logic.boolalg.BooleanAtom


def as_expression(value: Any) -> sp.Basic:
    """Return a number or an expression as SymPy has it; raise InputError for anything else.

    Text is refused, since reading it as a formula would run it.
    """
    if isinstance(value, sp.Expr | sp.logic.boolalg.Boolean):
        return value
    if isinstance(value, MotionLaw):
        raise InputError(
            f"{shorten(value)} is a law and no expression: take its s, v, a or j, like law.s."
        )
    number = value[()] if isinstance(value, np.ndarray) else value  # np.array(0.5) is one number
    with suppress(OverflowError):  # of Fraction(10**400)
        if is_real(number):
            is_whole = isinstance(number, Integral)
            return sp.Integer(int(number)) if is_whole else sp.Float(float(number))
    raise InputError(
        f"A live figure cannot draw {shorten(value)}: give an expression of SymPy, "
        "for example sp.sin(t), or a number."
    )


def as_curve(value: Any) -> sp.Expr:
    """Return an expression that can be drawn; raise InputError for a condition too."""
    curve = as_expression(value)
    if not isinstance(curve, sp.Expr):
        raise InputError(
            f"{shortly(curve)} is a condition and no curve: draw sp.Piecewise((1, condition), "
            "(0, True)), which is 1 where it holds."
        )
    return curve


def as_condition(given: Any) -> sp.Basic:
    """Return what has to hold; of a number or an expression, that it is above 0."""
    if isinstance(given, bool):
        raise InputError(
            f"The condition of a sentence is {given} already: compare symbols by <, > or "
            "sp.Eq(k, 1), since k == 1 asks whether two expressions look alike."
        )
    condition = as_expression(given)
    return condition > 0 if isinstance(condition, sp.Expr) else condition


def shortly(expression: Any) -> str:
    """Return an expression as text, cut where it is too long for a sentence."""
    text = str(expression)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


def parts_of(expression: sp.Basic) -> dict[sp.Basic, None]:
    """Return all that an expression is made of, itself too; what comes again is walked only once.

    SymPy's `atoms` and `has` walk through each repetition, which in a long formula are most.
    """
    parts: dict[sp.Basic, None] = {}
    left = [expression]
    while left:
        part = left.pop()
        if part not in parts:
            parts[part] = None
            left.extend(part.args)
    return parts


def check_computable(expression: sp.Basic) -> None:
    """Raise InputError for what no formula can be made of, whatever its functions are."""
    parts = parts_of(expression)
    for undone in (part for part in parts if isinstance(part, _UNDONE)):
        raise InputError(
            f"{shortly(undone)} is not worked out, and a live figure cannot do that: call .doit() "
            "on the expression, and look whether it has become a formula."
        )
    if sp.I in parts or sp.zoo in parts:
        raise InputError(
            f"{shortly(expression)} is not real: a live figure draws real numbers only, take "
            "its real part or its magnitude."
        )
    for atom in (
        part for part in parts if not part.args or isinstance(part, sp.core.expr.AtomicExpr)
    ):
        if not isinstance(atom, _ATOMS):
            raise InputError(
                f"A live figure cannot compute {shortly(atom)}, which is in "
                f"{shortly(expression)}: write a number or a symbol in its place."
            )
        if isinstance(atom, sp.Rational) and max(abs(atom.p), atom.q) > _MOST:
            raise InputError(
                "An expression contains a number of more than 300 digits, which a live figure "
                "cannot compute: choose larger units."
            )


@contextmanager
def refusing_the_endless() -> Iterator[None]:
    """Raise InputError where an expression is nested so deeply that Python gives up."""
    try:
        yield
    except (RecursionError, SyntaxError, MemoryError):
        raise InputError(
            "An expression of this live figure is nested too deeply: simplify it, or give parts of "
            "it a symbol of their own in values."
        ) from None
