"""A smooth piece that is known only as an expression, of any form that has derivatives."""

from collections.abc import Callable
from functools import cached_property, lru_cache
from math import inf, isfinite, nan
from typing import Any

import numpy as np
import sympy
from mpmath import iv

from cammotion.laws.symbols import x
from cammotion.laws.turning import Proved
from cammotion.quantities import Floats, InputError, shorten

_KNOWN = ("sin", "cos", "tan", "exp", "log", "sqrt")
_NAMES = {"mpf": iv.mpf, "pi": iv.pi, "E": iv.e} | {name: getattr(iv, name) for name in _KNOWN}
_FORMS = (sympy.Add, sympy.Mul, sympy.Pow, *(getattr(sympy, name) for name in _KNOWN[:-1]))
_LONGEST = 2000  # operations of a derivative, from which on nothing is proved with it
_SMOOTH = 4  # S and so many less one of its derivatives have to be finite
_PARTS = 200  # into which a zone may be cut to see that


class Expression(Proved):
    """An expression in `x`, evaluated as it is written, and bounded by interval arithmetic."""

    made_of = ("_expression", "low", "high")

    def __init__(self, expression: sympy.Expr, low: float, high: float) -> None:
        self._expression, self.low, self.high = expression, low, high

    @property
    def expression(self) -> sympy.Expr:
        """It as an expression in `x`."""
        return self._expression

    @cached_property
    def cost(self) -> int:
        """How many terms it takes to bound it once."""
        return 10 * int(self._expression.count_ops())

    def at(self, place: float) -> float:
        """Return the value at one place; not a number where it has none that is real."""
        try:
            return float(_compile(self._expression, "math")(place))
        except (ArithmeticError, ValueError, TypeError):
            return nan

    def over(self, places: Floats, out: Floats | None = None) -> Floats:
        """Return the values at many places; in `out`, if given."""
        function = _compile(self._expression, "numpy")
        with np.errstate(all="ignore"):
            values = function(places) + np.zeros(np.shape(places))
            if np.isnan(np.sum(values)):  # rounding may put a place where it has no value
                values = function(np.clip(places, self.low, self.high)) + np.zeros_like(values)
        if out is None:
            return np.asarray(values)
        out[...] = values
        return out

    def bounds(self, low: float, high: float) -> tuple[float, float]:
        """Return what every value between two places certainly lies between.

        That is what interval arithmetic says, and the value in the middle changed by half the way
        times the slope: the nearer the two places, the better the second.
        """
        naive = self._enclose(low, high)
        if low == high:
            return naive
        middle, half = (low + high) / 2, (high - low) / 2
        centre, slope = self._enclose(middle, middle), self.derivative._enclose(low, high)
        reach = half * max(map(abs, slope)) * (1 + 1e-15)
        return max(naive[0], centre[0] - reach), min(naive[1], centre[1] + reach)

    @cached_property
    def derivative(self) -> "Expression":
        """The derivative, made once."""
        return Expression(sympy.diff(self._expression, x), self.low, self.high)

    def restricted(self, low: float, high: float) -> "Expression":
        """Return the part of it between two of its places."""
        return Expression(self._expression, low, high)

    def torque(self) -> "Expression":
        """Return the product of the first and the second derivative."""
        v = self.derivative
        return Expression(v.expression * v.derivative.expression, self.low, self.high)

    def check_is_smooth(self) -> None:
        """Raise InputError unless S, V, A and J are proved to be real and finite everywhere."""
        curves: list[Expression] = [self]
        while len(curves) < _SMOOTH:
            curves.append(curves[-1].derivative)
        waiting, cuts = [(self.low, self.high)], 0
        while waiting:
            low, high = waiting.pop()
            found = [curve._enclose(low, high) for curve in curves]
            found += [(curve.at(low), curve.at(high)) for curve in curves]  # floats overflow
            if all(isfinite(end) for each in found for end in each):
                continue
            cuts += 1
            if cuts > _PARTS:
                raise InputError(
                    f"The law is not real and finite about x = {round(low, 6):g}, or its velocity, "
                    "acceleration or jerk is not: give an expression that has three finite "
                    "derivatives from x = 0 to 1."
                )
            middle = (low + high) / 2
            waiting += [(middle, high), (low, middle)]

    def _enclose(self, low: float, high: float) -> tuple[float, float]:
        """Return the bounds that interval arithmetic finds; infinite where it finds none."""
        if self._over_intervals is None:
            return -inf, inf
        try:
            found = iv.convert(self._over_intervals(iv.mpf([low, high])))
        except (ArithmeticError, ValueError, TypeError, iv.ComplexResult):
            return -inf, inf
        least, most = float(found.a), float(found.b)
        finite = [abs(end) for end in (least, most) if isfinite(end)]
        slack = 1e-15 * max(finite, default=0)  # numbers like 1/3 are floats in the formula
        return (least - slack, most + slack) if least <= most else (-inf, inf)

    @cached_property
    def _over_intervals(self) -> Callable[[Any], Any] | None:
        """It for intervals; None for one so long that nothing would be gained."""
        if self._expression.count_ops() > _LONGEST:
            return None
        simple = self._expression.rewrite([sympy.sinh, sympy.cosh, sympy.tanh], sympy.exp)
        parts = (part for part in sympy.preorder_traversal(simple) if part.args)
        others = {part.func.__name__ for part in parts if not isinstance(part, _FORMS)} - {"Tuple"}
        if others:
            raise InputError(
                f"The law uses the function {', '.join(sorted(others))}, whose turning points "
                f"cannot be proved: use {', '.join(_KNOWN)}, powers and Piecewise."
            )
        return _compile(simple, "intervals")


@lru_cache(maxsize=512)
def _compile(expression: sympy.Expr, library: str) -> Callable[[Any], Any]:
    modules = [_NAMES] if library == "intervals" else library
    function: Callable[[Any], Any] = sympy.lambdify(x, expression, modules, cse=True)
    return function


@lru_cache(maxsize=10_000)
def real_number(expression: sympy.Expr) -> float:
    """Return a constant as a float; raise InputError for one that is not real and finite."""
    try:
        value = float(expression)
    except (TypeError, OverflowError):
        value = inf
    if not isfinite(value):
        raise InputError(
            f"The law holds the number {shorten(expression, of=str)}, which is not real and "
            "finite: a position is."
        )
    return value
