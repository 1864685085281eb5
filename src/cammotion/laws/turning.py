"""Where a curve turns from rising to falling or back, with no turn missed.

Samples can step over a turn. Interval arithmetic cannot: put a whole interval of x into an
expression and it gives back an interval that certainly holds every value the expression takes
there; so do the bounds of a series. So it can prove that some derivative of the curve is nowhere
zero in an interval. Then the derivative before it only rises or only falls there, and is zero once
at most, at a place that halving finds; between such places the one before that only rises or
falls, and so on down to the slope, whose zeros are the turns. Where no derivative can be proved to
keep its sign the interval is halved, at most to where the curve cannot change by more than
`NEGLIGIBLE`, however it turns.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import sympy
from mpmath import iv

from cammotion.laws.series import Series
from cammotion.quantities import InputError

NEGLIGIBLE = 1e-13
"""The change of a curve that is taken for none, where a motion law changes by 1."""

Interval = Any  # mpmath's intervals come without types
Branch = tuple[int, float, float]
"""1 for rising or -1 for falling, and from where to where."""

_KNOWN = ("sin", "cos", "tan", "exp", "log", "sqrt")
_NAMES = {"mpf": iv.mpf, "pi": iv.pi, "E": iv.e} | {name: getattr(iv, name) for name in _KNOWN}
_ORDERS = 6  # a slope with a zero of higher order is met by halving


def turning_points(
    curve: sympy.Expr | Series, symbol: sympy.Symbol, low: float, high: float
) -> list[float]:
    """Return in order every place in ]low, high[ at which a smooth `curve` turns.

    `curve` is a SymPy expression in `symbol`, or a series, without a kink between `low` and
    `high`. Raises InputError for one with a function that interval arithmetic does not know.

    >>> x = sympy.Symbol("x")
    >>> turning_points(x * (1 - x) ** 2, x, 0, 1)  # up, and down from 1/3 on
    [0.3333333333333333]
    """
    is_series = isinstance(curve, Series)
    if is_series and curve.is_straight:
        return []
    slopes = _SeriesSlopes(curve) if is_series else _ExpressionSlopes(curve, symbol)
    branches = _branches(slopes, low, high)
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


class _Slopes(ABC):
    """The slope of a curve and its derivatives over intervals."""

    @abstractmethod
    def bounds(self, order: int, low: float, high: float) -> tuple[float, float]:
        """Enclose the slope (order 0), or a derivative of it, over an interval."""

    def sign(self, order: int, low: float, high: float) -> int:
        """Return 1 or -1 where it is proved to keep this sign over the interval, 0 elsewhere."""
        least, most = self.bounds(order, low, high)
        return 1 if least > 0 else -1 if most < 0 else 0

    def sign_at(self, order: int, place: float) -> int:
        """Return the sign at one place, where it is known to pass zero only once."""
        return self.sign(order, place, place)

    def sign_between(self, low: float, high: float) -> int:
        """Return the sign of a slope that does not change it; here and there it may touch zero."""
        shares = (number / (_ORDERS + 2) for number in range(1, _ORDERS + 2))
        places = (low + share * (high - low) for share in shares)
        return next(filter(None, (self.sign(0, place, place) for place in places)), 0)

    def zeros(self, order: int, ends: list[float]) -> list[float]:
        """Return where it changes its sign, if between two of the `ends` it only rises or falls."""
        signs = [self.sign(order, end, end) for end in ends]
        return [
            bisect(lambda place, s=sign: self.sign_at(order, place) == s, start, end)  # type: ignore[misc]
            for (start, end), (sign, other) in zip(pairwise(ends), pairwise(signs), strict=True)
            if sign * other < 0
        ]


class _ExpressionSlopes(_Slopes):
    """Those of an expression, by interval arithmetic; each is made when it is needed."""

    def __init__(self, curve: sympy.Expr, symbol: sympy.Symbol) -> None:
        slope = sympy.factor(sympy.diff(curve, symbol))
        unknown = sorted({f.func.__name__ for f in slope.atoms(sympy.Function)} - {*_KNOWN})
        if unknown:
            raise InputError(
                f"The law uses the function {', '.join(unknown)}, whose turning points cannot be "
                f"proved: use {', '.join(_KNOWN)}, powers and Piecewise."
            )
        self._symbol = symbol
        self._expressions = [slope]
        self._functions: list[Callable[[Interval], Interval]] = []

    def bounds(self, order: int, low: float, high: float) -> tuple[float, float]:
        while len(self._functions) <= order:
            expression = self._expressions[-1]
            self._functions.append(sympy.lambdify(self._symbol, expression, modules=[_NAMES]))
            self._expressions.append(sympy.diff(expression, self._symbol))
        over = iv.convert(self._functions[order](iv.mpf([low, high])))
        return over.a, over.b


class _SeriesSlopes(_Slopes):
    """Those of a series, by its own bounds."""

    def __init__(self, curve: Series) -> None:
        self._series = [curve.derive()]

    def bounds(self, order: int, low: float, high: float) -> tuple[float, float]:
        return self._of(order).bounds(low, high)

    def sign_at(self, order: int, place: float) -> int:
        value = self._of(order).at(place)
        return 1 if value > 0 else -1 if value < 0 else 0

    def _of(self, order: int) -> Series:
        while len(self._series) <= order:
            self._series.append(self._series[-1].derive())
        return self._series[order]


def _branches(slopes: _Slopes, low: float, high: float) -> Iterator[Branch]:
    """Yield in order where the curve rises or falls; what is negligible is left out."""
    order = next((n for n in range(_ORDERS) if slopes.sign(n, low, high)), None)
    if order is not None:
        ends = [low, high]
        for lower in reversed(range(order)):
            ends = [low, *slopes.zeros(lower, ends), high]
        for start, end in pairwise(ends):
            if sign := slopes.sign_between(start, end):
                yield sign, start, end
    elif (high - low) * max(map(abs, slopes.bounds(0, low, high))) > NEGLIGIBLE:
        middle = (low + high) / 2
        yield from _branches(slopes, low, middle)
        yield from _branches(slopes, middle, high)
