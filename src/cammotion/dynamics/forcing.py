"""The acceleration of a curve as what drives a follower: polynomials and waves, piece by piece.

Such a drive is the outcome of a linear system itself: the derivatives of a polynomial follow from
one another, and a wave from the wave a quarter of a turn later. That system beside the follower's
makes one, which has no drive any more, and whose solution is one exponential.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import chebyshev

from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.piece import Piece, Placed
from cammotion.laws.series import Series, about
from cammotion.laws.spline import Spline
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError

TOLERANCE = 1e-12
"""What a piece that is neither polynomial nor wave may be off, as a share of its largest value."""

_DEGREE = 12  # of the polynomials that such a piece is cut into
_MOST = 1000  # of them
_SAMPLES = 65


class Forcing(NamedTuple):
    """A polynomial and waves from `low` to `high`, in u = place - low.

    `powers` are coefficients by rising power, `waves` are triples of amplitude, frequency and
    phase of a sine.
    """

    low: float
    high: float
    powers: tuple[float, ...] = ()
    waves: tuple[tuple[float, float, float], ...] = ()

    @property
    def kind(self) -> tuple[int, tuple[float, ...]]:
        """What forcings have in common that one system brings forth."""
        return len(self.powers), tuple(frequency for _, frequency, _ in self.waves)

    def placed(self, shift: float, width: float, factor: float) -> "Forcing":
        """Return factor * it((place - shift) / width), over its own part of the places."""
        low, high = shift + width * self.low, shift + width * self.high
        if width < 0:
            span = self.high - self.low
            powers: Sequence[float] = about(self.powers, span)
            waves = ((a, f / width, p + f * span) for a, f, p in self.waves)
            low, high = high, low
        else:
            powers, waves = self.powers, ((a, f / width, p) for a, f, p in self.waves)
        return Forcing(
            low,
            high,
            tuple(factor * each / width**n for n, each in enumerate(powers)),
            tuple((factor * a, f, p) for a, f, p in waves),
        )


class Generator:
    """The linear system that brings forth all of some forcings of one kind."""

    def __init__(self, forcings: Sequence[Forcing]) -> None:
        self._forcings = forcings
        self._count, self._frequencies = forcings[0].kind
        self._width = max(each.high - each.low for each in forcings)

    @cached_property
    def matrix(self) -> Floats:
        """The matrix of it, square; its states are derivatives, and sines with their cosines."""
        size = self._count + 2 * len(self._frequencies)
        matrix = np.zeros((size, size))
        for n in range(self._count - 1):
            matrix[n, n + 1] = 1 / self._width
        for n, frequency in enumerate(self._frequencies):
            at = self._count + 2 * n
            matrix[at, at + 1], matrix[at + 1, at] = frequency, -frequency
        return matrix

    @cached_property
    def sum(self) -> Floats:
        """Of which states the forcing is the sum: 1 for those, 0 for the others."""
        size = self._count + 2 * len(self._frequencies)
        chosen = np.zeros(size)
        chosen[: min(self._count, 1)] = 1
        chosen[self._count :: 2] = 1
        return chosen

    @cached_property
    def starts(self) -> Floats:
        """The states at the beginnings, a row for each forcing."""
        sizes = [math.factorial(n) * self._width**n for n in range(self._count)]
        return np.array(
            [
                [*(a * size for a, size in zip(each.powers, sizes, strict=True)), *_waves(each)]
                for each in self._forcings
            ]
        )


def _waves(forcing: Forcing) -> Iterator[float]:
    for amplitude, _, phase in forcing.waves:
        yield amplitude * math.sin(phase)
        yield amplitude * math.cos(phase)


def accelerations(curve: Curve) -> list[Forcing]:
    """Return the second derivative of a curve as polynomials and waves, one after the other.

    What is neither is cut into polynomials that are off by `TOLERANCE`; InputError is raised where
    that cannot be done.
    """
    return [each for piece in curve.pieces for each in _read(piece.derivative.derivative)]


def check_velocity(drive: MotionLaw | Motion) -> None:
    """Raise InputError for a law or a motion whose velocity jumps, or a law that is no move."""
    if isinstance(drive, Motion):
        jumps = [f"{drive.name!r} jumps (at {angle:g} deg)" for angle, _ in drive.steps(1)]
    else:
        drive.check_way()
        jumps = [] if np.isfinite(drive.Ca) else [f"the law {drive.name!r} jumps"]
    if jumps:
        raise InputError(
            f"The velocity of {jumps[0]}, which takes an infinite acceleration: give laws whose "
            "velocity goes on without a jump."
        )


def _read(piece: Piece) -> list[Forcing]:
    if isinstance(piece, Series):
        waves = [(a, f, p + n % 4 * math.pi / 2) for a, f, p, n in piece.waves if a]
        powers = piece.powers
        while powers and not powers[-1]:
            powers = powers[:-1]
        return [Forcing(piece.low, piece.high, powers, tuple(waves))]
    if isinstance(piece, Spline):
        ends, columns = piece.knots.tolist(), piece.rows[::-1].T.tolist()
        return [Forcing(*each) for each in zip(ends, ends[1:], map(tuple, columns), strict=False)]
    if isinstance(piece, Placed):
        shift, width, factor = piece.shift, piece.width, piece.factor
        placed = [each.placed(shift, width, factor) for each in _read(piece.inner)]
        return placed if width > 0 else placed[::-1]
    return _approximated(piece)


def _approximated(piece: Piece) -> list[Forcing]:
    """Return polynomials through the values at Chebyshev's places, halved until they fit."""
    size = np.abs(piece.over(np.linspace(piece.low, piece.high, _SAMPLES))).max()
    found: list[Forcing] = []
    waiting = [(piece.low, piece.high)]
    while waiting:
        low, high = waiting.pop()
        middle, half = (low + high) / 2, (high - low) / 2
        factors = chebyshev.chebinterpolate(_scaled(piece, middle, half), _DEGREE)
        if np.abs(factors[-3:]).sum() <= TOLERANCE * size:
            powers = about(chebyshev.cheb2poly(factors).tolist(), -1.0)
            in_place = (each / half**n for n, each in enumerate(powers))
            found.append(Forcing(low, high, tuple(in_place)))
        else:
            waiting += [(middle, high), (low, middle)]
        if len(found) + len(waiting) > _MOST:
            raise InputError(
                f"The acceleration about {low:g} bends too sharply for polynomials to follow it, "
                "or its terms cancel each other too nearly: give a smoother law, or fewer terms."
            )
    return found


def _scaled(piece: Piece, middle: float, half: float) -> Callable[[Any], Any]:
    return lambda at: piece.over(middle + half * at)
