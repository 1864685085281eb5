"""A smooth piece of a curve: what every kind of them is asked, and a piece put elsewhere."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
import sympy

from cammotion.alike import Alike
from cammotion.laws.symbols import x
from cammotion.quantities import Floats

Number: TypeAlias = Any  # SymPy comes without types
"""A float, or an exact number of SymPy that stays exact in the expressions made of it."""


class Piece(Alike, ABC):
    """A smooth curve from `low` to `high`."""

    low: float
    high: float
    is_constant = False

    @abstractmethod
    def at(self, place: float) -> float:
        """Return the value at one place; what is left of terms that cancel each other is 0."""

    @abstractmethod
    def over(self, places: Floats, out: Floats | None = None) -> Floats:
        """Return the values at many places, in an array of their shape; in `out`, if given."""

    @property
    @abstractmethod
    def derivative(self) -> "Piece":
        """The derivative, made once."""

    @abstractmethod
    def torque(self) -> "Piece":
        """Return the product of the first and the second derivative."""

    @property
    @abstractmethod
    def expression(self) -> sympy.Expr:
        """It as an expression in `x`."""

    @property
    def value(self) -> Callable[[float], float]:
        """The function that returns the value at one place, for solvers that ask thousands."""
        return self.at

    @property
    @abstractmethod
    def turns(self) -> list[float]:
        """Where between its ends it turns, in order; that no turn is missed is proved."""

    @abstractmethod
    def restricted(self, low: float, high: float) -> "Piece":
        """Return the part of it between two of its places."""

    @cached_property
    def corners(self) -> list[tuple[float, float]]:
        """Places and values at its ends and where it turns: between two it rises or falls."""
        return [(place, self.at(place)) for place in (self.low, *self.turns, self.high)]

    @cached_property
    def extremes(self) -> tuple[float, float]:
        """The least and the largest value."""
        values = [value for _, value in self.corners]
        return min(values), max(values)

    def solve(self, height: float, low: float, high: float) -> float:
        """Return where between two places it passes a height, if it only rises or falls there."""
        value = self.value
        rising = value(high) > value(low)
        return bisect(lambda place: (value(place) < height) == rising, low, high)


class Placed(Piece):
    """A piece drawn elsewhere: offset + factor * inner((place - shift) / width).

    A negative `width` turns it round. Turns and extremes are those of the inner piece, which finds
    them once for all its places.
    """

    made_of = ("inner", "shift", "width", "_offset", "factor")

    def __init__(
        self, inner: Piece, shift: Number, width: Number, offset: Number, factor: Number
    ) -> None:
        self.inner, self._exact = inner, (shift, width, offset, factor)
        self.shift, self.width = float(shift), float(width)
        self._offset, self.factor = float(offset), float(factor)
        self.low, self.high = sorted(map(self._out, (inner.low, inner.high)))

    def at(self, place: float) -> float:
        """Return the value at one place."""
        return self._offset + self.factor * self.inner.at(self._in(place))

    def over(self, places: Floats, out: Floats | None = None) -> Floats:
        """Return the values at many places; in `out`, if given."""
        if self.inner.is_constant:
            values = np.empty(np.shape(places)) if out is None else out
            values[...] = self.at(self.low)
            return values
        turned = self.shift - places if self.width < 0 else places - self.shift
        if abs(self.width) != 1:
            turned /= abs(self.width)
        values = self.inner.over(turned, out)
        if self.factor == -1:
            return np.subtract(self._offset, values, out=values)
        values *= self.factor
        if self._offset:
            values += self._offset
        return values

    @cached_property
    def derivative(self) -> "Piece":
        """The derivative, made once."""
        shift, width, _, factor = self._exact
        return Placed(self.inner.derivative, shift, width, 0.0, factor / width)

    def torque(self) -> "Piece":
        """Return the product of the first and the second derivative."""
        shift, width, _, factor = self._exact
        return Placed(self.inner.torque(), shift, width, 0.0, factor**2 / width**3)

    @cached_property
    def expression(self) -> sympy.Expr:
        """It as an expression in `x`."""
        shift, width, offset, factor = self._exact
        return offset + factor * self.inner.expression.xreplace({x: (x - shift) / width})

    @cached_property
    def turns(self) -> list[float]:
        """Where between its ends it turns, in order."""
        return sorted(map(self._out, self.inner.turns))

    @cached_property
    def extremes(self) -> tuple[float, float]:
        """The least and the largest value."""
        ends = [self._offset + self.factor * value for value in self.inner.extremes]
        return min(ends), max(ends)

    def restricted(self, low: float, high: float) -> "Placed":
        """Return the part of it between two of its places."""
        inside = sorted((self._in(low), self._in(high)))
        return Placed(self.inner.restricted(*inside), *self._exact)

    def solve(self, height: float, low: float, high: float) -> float:
        """Return where between two places it passes a height, if it only rises or falls there."""
        inside = sorted((self._in(low), self._in(high)))
        return self._out(self.inner.solve((height - self._offset) / self.factor, *inside))

    def _in(self, place: float) -> float:
        inside = (place - self.shift) / self.width
        return min(max(inside, self.inner.low), self.inner.high)

    def _out(self, inside: float) -> float:
        return self.shift + self.width * inside


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


def bisect_many(is_before: Callable[[Floats], Any], low: Floats, high: Floats) -> Floats:
    """Return the same as `bisect` for many at once, in an array.

    >>> bisect_many(lambda x: x * x < [2, 3], np.array([1.0, 1.0]), np.array([2.0, 2.0]))
    array([1.41421356, 1.73205081])
    """
    while np.any(halved := (low < (middle := (low + high) / 2)) & (middle < high)):
        before = is_before(middle)
        low = np.where(halved & before, middle, low)
        high = np.where(halved & ~before, middle, high)
    return high
