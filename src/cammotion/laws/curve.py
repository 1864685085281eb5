"""A curve in smooth pieces: values, derivatives, steps, turns, largest value and crossings.

A motion law is a curve over the time from 0 to 1, a motion one over the cam angle of a turn. What
is asked of them is asked here, of both alike.
"""

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import pairwise
from typing import Literal, NamedTuple

import numpy as np
import sympy

from cammotion.alike import Alike
from cammotion.laws.piece import Number, Piece, Placed, bisect_many
from cammotion.quantities import Floats, is_rising

_SAME_PLACE = 1e-12  # what the ends of two pieces may differ by and be one joint
_FEW = 8  # that are solved for one by one, which is quicker
_ROUNDING = 1e-10  # what a sum of angles in deg may miss a joint by


class Branch(NamedTuple):
    """A part over which a curve only rises or only falls (or stands): its ends, their heights."""

    low: float
    high: float
    at_low: float
    at_high: float
    piece: Piece

    def solve(self, height: float) -> float:
        """Return where it passes a height between those at its ends."""
        return self.piece.solve(height, self.low, self.high)

    def reach(self, heights: Floats) -> Floats:
        """Return where it comes to each height, if it rises; its ends for those beyond them."""
        if heights.size <= _FEW:
            roots = np.array([self.solve(height) for height in heights])
        else:
            ends = (np.full(heights.shape, end) for end in (self.low, self.high))
            roots = bisect_many(lambda places: self.piece.over(places) < heights, *ends)
        roots = np.where(heights >= self.at_high, self.high, roots)
        return np.where(heights <= self.at_low, self.low, roots)


class Curve(Alike):
    """Smooth pieces one after the other, without a gap between them."""

    made_of = ("pieces",)

    def __init__(self, pieces: Iterable[Piece]) -> None:
        self.pieces = tuple(pieces)
        self.low, self.high = self.pieces[0].low, self.pieces[-1].high

    @cached_property
    def derivative(self) -> "Curve":
        """The derivative, piece by piece, made once."""
        return Curve(piece.derivative for piece in self.pieces)

    def derived(self, order: int) -> "Curve":
        """Return the derivative of that order; of order 0 it is the curve itself."""
        curve = self
        for _ in range(order):
            curve = curve.derivative
        return curve

    def placed(self, shift: Number, width: Number, offset: Number, factor: Number) -> "Curve":
        """Return offset + factor * curve((x - shift) / width), over its own part of x."""
        pieces = [Placed(piece, shift, width, offset, factor) for piece in self.pieces]
        return Curve(pieces if float(width) > 0 else pieces[::-1])

    def between(self, low: float, high: float) -> list[Piece]:
        """Return what lies between two places, in pieces."""
        parts = ((max(low, p.low), min(high, p.high), p) for p in self.pieces)
        return [p.restricted(start, end) for start, end, p in parts if end - start > _SAME_PLACE]

    @cached_property
    def branches(self) -> tuple[Branch, ...]:
        """The curve cut at each joint and wherever it turns; that no turn is missed is proved."""
        return tuple(
            Branch(low, high, at_low, at_high, piece)
            for piece in self.pieces
            for (low, at_low), (high, at_high) in pairwise(piece.corners)
        )

    @cached_property
    def extremes(self) -> tuple[float, float]:
        """The least and the largest value."""
        ends = [piece.extremes for piece in self.pieces]
        return min(least for least, _ in ends), max(most for _, most in ends)

    @property
    def largest(self) -> float:
        """The largest magnitude."""
        return max(map(abs, self.extremes))

    @cached_property
    def ends(self) -> tuple[float, float]:
        """The values at both ends."""
        return self.pieces[0].at(self.low), self.pieces[-1].at(self.high)

    @cached_property
    def steps(self) -> tuple[tuple[float, float], ...]:
        """Each joint between two pieces, and by how much the curve steps up there."""
        return tuple(
            (before.high, after.at(after.low) - before.at(before.high))
            for before, after in pairwise(self.pieces)
        )

    def where(self, height: float, side: int, rounding: float = 0.0) -> list[tuple[float, float]]:
        """Return the intervals, in order, over which it is above a height (1) or below it (-1).

        They are solved for. What begins or ends a branch within `rounding` of the height is at it.
        """
        found: list[tuple[float, float]] = []
        for low, high in self._parts(height, side, rounding):
            touches = found and low - found[-1][1] <= _SAME_PLACE
            found.append((found.pop()[0] if touches else low, high))
        return found

    def _parts(self, height: float, side: int, rounding: float) -> Iterator[tuple[float, float]]:
        for branch in self.branches:
            low, high = side * (branch.at_low - height), side * (branch.at_high - height)
            low, high = (0.0 if abs(end) <= rounding else end for end in (low, high))
            if min(low, high) >= 0 < max(low, high):
                yield branch.low, branch.high
            elif high > 0:
                yield branch.solve(height), branch.high
            elif low > 0:
                yield branch.low, branch.solve(height)

    def __call__(
        self, places: Floats, joint_of: Literal["left", "right"] = "left", rises: bool | None = None
    ) -> Floats:
        """Return the values, each piece evaluated at its own places only.

        At a joint it is the value of the piece to the "left", or of that to the "right". Whether
        the places rise, as in every plot, is found out if it is not said.
        """
        flat = np.ravel(places)
        if len(self.pieces) == 1:
            return self.pieces[0].over(flat).reshape(np.shape(places))
        values = np.empty_like(flat)
        if is_rising(flat) if rises is None else rises:
            side: Literal["left", "right"] = "right" if joint_of == "left" else "left"
            cuts = np.searchsorted(flat, self._joints, side=side)
            for piece, (start, end) in zip(
                self.pieces, pairwise([0, *cuts, flat.size]), strict=True
            ):
                if start < end:
                    piece.over(flat[start:end], values[start:end])
        else:
            which = np.searchsorted(self._joints, flat, side=joint_of)
            for number in np.unique(which):
                here = which == number
                values[here] = self.pieces[number].over(flat[here])
        return values.reshape(np.shape(places))

    def begun(self, places: Floats) -> Floats:
        """Return places of a closed curve, so that to the "right" of a joint is what begins there.

        What misses a joint by the rounding of sums is there, and the end is the beginning.
        """
        ends = np.array([self.low, *self._joints, self.high])
        near = ends[np.searchsorted(ends[:-1], places - _ROUNDING)]
        settled = np.where(np.abs(places - near) <= _ROUNDING, near, places)
        return np.where(settled == self.high, self.low, settled)

    @cached_property
    def _joints(self) -> Floats:
        return np.array([piece.low for piece in self.pieces[1:]])


def mirrored(half: Sequence[Piece]) -> Curve:
    """Return the curve whose second half is the first one turned about (1/2, 1/2)."""
    one = sympy.Integer(1)
    return Curve([*half, *(Placed(piece, one, -1, one, -1) for piece in reversed(half))])
