"""SymPy's expressions read as pieces of a curve, and pieces written as one expression."""

import math
from collections.abc import Iterable
from contextlib import suppress
from functools import lru_cache, partial, reduce
from typing import Any, NamedTuple

import sympy

from cammotion.laws.expression import Expression, real_number
from cammotion.laws.piece import Piece
from cammotion.laws.series import Series, Wave
from cammotion.laws.symbols import exact, x
from cammotion.quantities import InputError, shorten

_TAME = 1e5  # larger terms that cancel each other would leave too few digits of a float
_HIGHEST = 30  # the degree up to which powers are multiplied out
_MOST = 200  # terms that a series may have


class Zone(NamedTuple):
    """An expression in `x`, and from where to where it holds."""

    expression: sympy.Expr
    low: float
    high: float


def cut(name: str, law: Any) -> tuple[Zone, ...]:
    """Cut the expression of a law at its joints.

    Raises InputError for what is no expression in `x` alone, or not defined from 0 to 1.

    >>> [(low, high) for _, low, high in cut("", sympy.Piecewise((x, x <= 0.25), (x**2, True)))]
    [(0.0, 0.25), (0.25, 1.0)]
    """
    is_expression = isinstance(law, sympy.Expr) and not isinstance(law, sympy.Lambda)
    others = sorted(map(str, law.free_symbols - {x})) if is_expression else []
    if not is_expression or others:
        said = f"has the symbol {', '.join(others)}" if others else f"is {shorten(law)}"
        said += ", but not that of cammotion (from cammotion import x)" if "x" in others else ""
        raise InputError(
            f"The expression of the law {shorten(name)} {said}; it has to be a SymPy expression in "
            "cammotion.x alone: give, for example, 3*x**2 - 2*x**3."
        )
    if not law.has(sympy.Piecewise):
        return (Zone(law, 0.0, 1.0),)
    if plain := _in_order(law):
        return plain
    found: list[Zone] = []
    with suppress(NotImplementedError, AttributeError):  # SymPy knows not where a case holds
        pieces = sympy.piecewise_fold(law).as_expr_set_pairs(sympy.Interval(0, 1))
        found = [Zone(piece, float(where.inf), float(where.sup)) for piece, where in pieces]
    zones = sorted((z for z in found if z.low < z.high), key=lambda zone: zone.low)
    cuts = [end for zone in zones for end in (zone.low, zone.high)]
    if (cuts[:1], cuts[1:-1:2], cuts[-1:]) != ([0], cuts[2::2], [1]):
        raise InputError(
            f"The cases of the law {shorten(name)} do not follow each other from x = 0 to 1: write "
            "them in order, as (S, x <= a), and the last one with the condition True."
        )
    return tuple(zones)


def write(zones: Iterable[tuple[sympy.Expr, float, float]]) -> sympy.Expr:
    """Return the zones as one expression, each up to and with its end."""
    merged: list[tuple[sympy.Expr, float, float]] = []
    for expression, low, high in zones:
        if merged and merged[-1][0] == expression:
            low = merged.pop()[1]
        merged.append((expression, low, high))
    *first, last = merged
    if not first:
        return last[0]
    cases = ((expression, x <= exact(high)) for expression, _, high in first)
    return sympy.Piecewise(*cases, (last[0], True), evaluate=False)


def read(expression: sympy.Expr, low: float, high: float) -> Piece:
    """Return an expression as a piece: a series wherever it can be one.

    >>> read(sympy.cos(x), 0.5, 1.0).at(1.0)
    0.5403023058681398
    """
    series = _series(expression, low)
    if series is None or series.size(high - low) > _TAME:
        piece = Expression(expression, low, high)
        piece.check_is_smooth()
        return piece
    powers = series.powers
    while len(powers) > 1 and not powers[-1]:
        powers = powers[:-1]
    return Series(powers, series.waves, low, high, write=partial(sympy.sympify, expression))


@lru_cache(maxsize=10_000)
def _series(expression: sympy.Expr, low: float) -> Series | None:
    """Read an expression at x = low + u; None for one of another form.

    What two zones have in common is read once.
    """
    if expression.is_Symbol:
        return Series((low, 1.0), (), low)
    if not expression.free_symbols:
        return Series((real_number(expression),), (), low)
    if isinstance(expression, sympy.sin | sympy.cos):
        return _wave(_series(expression.args[0], low), int(isinstance(expression, sympy.cos)))
    if expression.is_Add or expression.is_Mul:
        parts = [_series(part, low) for part in expression.args]
        return reduce(_plus if expression.is_Add else _times, parts)
    if expression.is_Pow and expression.exp.is_Integer and 0 < expression.exp <= _HIGHEST:
        return reduce(_times, [_series(expression.base, low)] * int(expression.exp))
    return None


def _plus(one: Series | None, other: Series | None) -> Series | None:
    return one.plus(other) if one and other else None


def _times(one: Series | None, other: Series | None) -> Series | None:
    if not (one and other) or len(one.waves) * len(other.waves) > _MOST:
        return None
    product = one.times(other)
    return product if product and len(product.powers) <= _HIGHEST + 1 else None


def _wave(angle: Series | None, quarters: int) -> Series | None:
    if not angle or angle.waves or len(angle.powers) != 2:  # noqa: PLR2004 - a straight line
        return None
    phase, frequency = angle.powers
    turned = round(phase / (math.pi / 2))
    phase -= turned * math.pi / 2
    if abs(phase) < 4 * math.ulp(1.0) * (1 + abs(turned)):
        phase = 0.0
    return Series((0.0,), (Wave(1.0, frequency, phase, quarters + turned),), angle.low)


def _in_order(expression: sympy.Expr) -> tuple[Zone, ...]:
    """Cut what is written as x <= a, x <= b, ..., else, a hundred times sooner; () for the rest."""
    zones: list[Zone] = []
    for piece, condition in expression.args if isinstance(expression, sympy.Piecewise) else ():
        low, high = zones[-1].high if zones else 0.0, -1.0
        if condition == sympy.true:
            high = 1.0
        elif isinstance(condition, sympy.Le | sympy.Lt) and condition.lhs == x:
            high = float(condition.rhs) if condition.rhs.is_number else -1.0
        if not low < high <= 1 or piece.has(sympy.Piecewise):
            return ()
        zones.append(Zone(piece, low, high))
    return tuple(zones) if zones and zones[-1].high == 1 else ()
