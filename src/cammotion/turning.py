"""Where a curve turns from rising to falling or back, with no turn missed.

Samples can step over a turn. Interval arithmetic cannot: put a whole interval of x into an
expression and it gives back an interval that certainly holds every value the expression takes
there. If that of the slope leaves out zero, then the curve does not turn in the interval; if that
of the second derivative does, then it turns there once at most. Otherwise the interval is halved,
down to where the curve cannot change by more than `NEGLIGIBLE`, however it turns.
"""

from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import sympy
from mpmath import iv

from cammotion.checks import InputError

NEGLIGIBLE = 1e-13
"""The change of a curve that is taken for none, where a motion law changes by 1."""

Interval = Any  # mpmath's intervals come without types
Branch = tuple[int, float, float]
"""1 for rising or -1 for falling, and from where to where."""

_KNOWN = ("sin", "cos", "tan", "exp", "log", "sqrt")
_NAMES = {"mpf": iv.mpf, "pi": iv.pi, "E": iv.e} | {name: getattr(iv, name) for name in _KNOWN}


def turning_points(curve: sympy.Expr, symbol: sympy.Symbol, low: float, high: float) -> list[float]:
    """Return in order every place in ]low, high[ at which a smooth `curve` turns.

    `curve` is a SymPy expression in `symbol`, without a kink between `low` and `high`. Raises
    InputError for one with a function that interval arithmetic does not know.

    >>> x = sympy.Symbol("x")
    >>> turning_points(x * (1 - x) ** 2, x, 0, 1)  # up, and down from 1/3 on
    [0.3333333333333333]
    """
    slope = sympy.factor(sympy.diff(curve, symbol))
    slope_over = _enclose(slope, symbol)
    bend_over = _enclose(sympy.diff(slope, symbol), symbol)
    branches = _branches(slope_over, bend_over, low, high)
    return [(end + start) / 2 for (s, _, end), (t, start, _) in pairwise(branches) if s != t]


def bisect(is_before: Callable[[float], bool], low: float, high: float) -> float:
    """Return the first float in ]low, high] that does not come before what is looked for.

    >>> bisect(lambda x: x * x < 2, 1, 2) == 2**0.5
    True
    """
    while low < (middle := (low + high) / 2) < high:
        if is_before(middle):
            low = middle
        else:
            high = middle
    return high


def _enclose(expression: sympy.Expr, symbol: sympy.Symbol) -> Callable[[float, float], Interval]:
    """Compile an expression into a function that encloses its values over an interval."""
    unknown = sorted({f.func.__name__ for f in expression.atoms(sympy.Function)} - {*_KNOWN})
    if unknown:
        raise InputError(
            f"The law uses the function {', '.join(unknown)}, whose turning points cannot be "
            f"proved: use {', '.join(_KNOWN)}, powers and Piecewise."
        )
    function = sympy.lambdify(symbol, expression, modules=[_NAMES])
    return lambda low, high: iv.convert(function(iv.mpf([low, high])))


def _branches(
    slope: Callable[[float, float], Interval],
    bend: Callable[[float, float], Interval],
    low: float,
    high: float,
) -> Iterator[Branch]:
    """Yield in order where the curve rises or falls; what is negligible is left out."""
    over = slope(low, high)
    if sign := _sign(over):
        yield sign, low, high
    elif _sign(bend(low, high)):
        yield from _at_most_two(slope, low, high)
    elif (high - low) * abs(over).b > NEGLIGIBLE:
        middle = (low + high) / 2
        yield from _branches(slope, bend, low, middle)
        yield from _branches(slope, bend, middle, high)


def _at_most_two(
    slope: Callable[[float, float], Interval], low: float, high: float
) -> Iterator[Branch]:
    """Yield the branches of a curve that bends one way only."""
    first, last = _sign(slope(low, low)), _sign(slope(high, high))
    if first * last < 0:
        turn = bisect(lambda place: _sign(slope(place, place)) == first, low, high)
        yield first, low, turn
        yield last, turn, high
    elif first or last:
        yield first or last, low, high


def _sign(over: Interval) -> int:
    """Return 1 or -1 for an interval on one side of zero, 0 for one that touches it."""
    return 1 if over.a > 0 else -1 if over.b < 0 else 0
