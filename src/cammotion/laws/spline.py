"""Many short polynomials as one piece of a curve, reckoned with all at once."""

from functools import cached_property
from typing import Any

import numpy as np
import sympy

from cammotion.laws.piece import Piece
from cammotion.laws.series import Series, about
from cammotion.laws.symbols import x
from cammotion.quantities import Floats


class Spline(Piece):
    """Polynomials of degree three at most, each from one knot to the next.

    `rows` holds the coefficients, the highest power first, a column for each polynomial in
    u = x - knot. The slope of each is a parabola at most, so that its zeros have a closed form.
    """

    made_of = ("knots", "rows")

    def __init__(self, knots: Floats, rows: Floats) -> None:
        self.knots, self.rows = knots, rows
        self.low, self.high = float(knots[0]), float(knots[-1])

    def at(self, place: float) -> float:
        """Return the value at one place."""
        return float(self.over(np.array([place]))[0])

    def over(self, places: Floats, out: Floats | None = None) -> Floats:
        """Return the values at many places; in `out`, if given."""
        which = np.searchsorted(self.knots[1:-1], places, side="left")
        values = self._inside(which, places - self.knots[which])
        if out is None:
            return values
        out[...] = values
        return out

    def restricted(self, low: float, high: float) -> "Spline":
        """Return the part of it between two of its places."""
        first = int(np.searchsorted(self.knots[1:-1], low, side="right"))
        last = int(np.searchsorted(self.knots[1:-1], high, side="left"))
        rows, move = self.rows[:, first : last + 1].copy(), low - self.knots[first]
        rows[:, 0] = about(rows[::-1, 0], move)[::-1]  # the first polynomial begins later now
        return Spline(np.array([low, *self.knots[first + 1 : last + 1], high]), rows)

    @cached_property
    def derivative(self) -> "Spline":
        """The derivative, made once."""
        degree = len(self.rows) - 1
        factors = np.arange(degree, 0, -1)[:, None]
        return Spline(self.knots, self.rows[:-1] * factors if degree else 0 * self.rows)

    def torque(self) -> "Spline":
        """Return the product of the first and the second derivative; S is a cubic at most."""
        v, a = self.derivative.rows, self.derivative.derivative.rows
        product = np.zeros((len(v) + len(a) - 1, v.shape[1]))
        for n, row in enumerate(a):
            product[n : n + len(v)] += row * v
        return Spline(self.knots, product)

    @cached_property
    def turns(self) -> list[float]:
        """Where between its ends it turns, in order; of steps, each knot."""
        if len(self.rows) == 1:
            return [float(knot) for knot in self.knots[1:-1]]
        slope = self.derivative
        zeros = np.unique(np.concatenate([slope._zeros, self.knots[1:-1]]))
        ends = np.concatenate([self.knots[:1], zeros, self.knots[-1:]])
        signs = np.sign(slope.over((ends[:-1] + ends[1:]) / 2))
        moving = signs != 0
        turned = signs[moving][1:] != signs[moving][:-1]
        found = ends[:-1][moving][1:][turned]
        return [float(turn) for turn in found if self.low < turn < self.high]

    @cached_property
    def extremes(self) -> tuple[float, float]:
        """The least and the largest value, on both sides of every knot."""
        every = np.arange(self.rows.shape[1])
        ends = self.rows[-1], self._inside(every, np.diff(self.knots))
        values = np.concatenate([*ends, self.over(self.derivative._zeros)])
        return float(values.min()), float(values.max())

    @cached_property
    def expression(self) -> sympy.Expr:
        """It as an expression in `x`, with a case for each polynomial."""
        *first, last = (
            Series(tuple(column[::-1]), (), low).expression
            for low, column in zip(self.knots.tolist(), self.rows.T.tolist(), strict=False)
        )
        ends = self.knots[1:-1].tolist()
        cases = ((one, x <= sympy.Float(end)) for one, end in zip(first, ends, strict=True))
        return sympy.Piecewise(*cases, (last, True), evaluate=False) if first else last

    def _inside(self, which: Any, u: Floats) -> Floats:
        values: Floats = self.rows[0][which]
        for row in self.rows[1:]:
            values = values * u + row[which]
        return values

    @cached_property
    def _zeros(self) -> Floats:
        """Where a polynomial of degree two at most is zero, strictly between its knots."""
        width = np.diff(self.knots)
        a, b, c = np.vstack([np.zeros((3 - len(self.rows), len(width))), self.rows])
        with np.errstate(all="ignore"):
            half = -(b + np.copysign(np.sqrt(b * b - 4 * a * c), b)) / 2  # no cancellation
            roots = np.concatenate([half / a, c / half])
        starts, widths = np.tile(self.knots[:-1], 2), np.tile(width, 2)
        inside = (roots > 0) & (roots < widths)  # nan, where there is none, is neither
        return np.asarray(np.sort(starts[inside] + roots[inside]))
