"""The turn in spans over which all motions are smooth, and sums over the mechanisms in them."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from cammotion.bracketed import cuts, root_of, samples
from cammotion.laws.piece import Piece
from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.kinematics import DEG_PER_TURN, over_time
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError

_NODES = 16  # with which a span is integrated


class Moved(NamedTuple):
    """A mechanism at some angles: position in mm, velocity in m/s, acceleration in m/s2."""

    position_mm: Floats
    velocity: Floats
    acceleration: Floats


class _Part(NamedTuple):
    """The piece of a motion that a span lies in, and what leads from the span's angles to it."""

    piece: Piece
    shift_deg: float


class Span:
    """A part of the turn, in which each motion is within one piece of its curve.

    No derivative turns in it, as far as that could be proved, and no motion turns back.
    """

    def __init__(self, low: float, high: float, motions: Iterable[Motion]) -> None:
        self.low, self.high, self.middle = low, high, (low + high) / 2
        self._parts = {motion.name: _part(motion, self.middle) for motion in motions}

    @property
    def turns(self) -> list[float]:
        """No place: it is cut wherever something turns."""
        return []

    @property
    def derivative(self) -> "Span":
        """It again, since it is cut for all derivatives."""
        return self

    def moves(self, name: str) -> bool:
        """Whether a motion moves in it."""
        return not self._parts[name].piece.is_constant

    def way(self, name: str) -> float:
        """Return 1 where a motion rises, -1 where it falls, 0 where it stands."""
        piece, shift = self._parts[name]
        return float(np.sign(piece.derivative.at(self.middle + shift)))

    def moved(self, name: str, angles: Floats, cycle_time_s: float) -> Moved:
        """Return how a motion moves at angles within the span."""
        piece, shift = self._parts[name]
        orders = (piece, piece.derivative, piece.derivative.derivative)
        position, *derivatives = (curve.over(angles + shift) for curve in orders)
        first, second = (over_time(n, d, cycle_time_s) for n, d in enumerate(derivatives, 1))
        return Moved(position, first, second)


SpanFunction = Callable[[Span, Floats], Floats]


def spans(motions: Sequence[Motion], ends_deg: Iterable[float]) -> tuple[Span, ...]:
    """Return the turn from 0 to 360 deg, cut where a motion is not smooth, and at these ends."""
    turn = float(DEG_PER_TURN)
    inner = {end % turn for motion in motions for end in _ends(motion)}
    ends = [0.0]
    for end in sorted(inner | {end % turn for end in ends_deg}):
        if end - ends[-1] > ROUNDING_DEG:
            ends.append(end)
    if turn - ends[-1] <= ROUNDING_DEG:  # as what is just before 0 becomes
        ends.pop()
    return tuple(Span(low, high, motions) for low, high in pairwise([*ends, turn]))


def ways(name: str, over: Sequence[Span], angles_deg: Floats) -> Floats:
    """Return the way of a motion at any angles; where a span begins, what begins there."""
    lows = [span.low for span in over]
    numbers = np.searchsorted(lows, (angles_deg + ROUNDING_DEG) % DEG_PER_TURN, side="right") - 1
    return np.array([span.way(name) for span in over])[numbers]


def nodes(span: Span) -> tuple[Floats, Floats]:
    """Return places in a span, and the weights in deg with which values there are integrated."""
    places, weights = _gauss(np.array([span.low, span.high]))
    return places.ravel(), weights.ravel()


def running_extremes(function: SpanFunction, over: Iterable[Span]) -> tuple[float, float]:
    """Return the least and the largest value of a function's integral from 0 deg on.

    They are where the function passes 0, which is solved for between close samples.
    """
    total, seen = 0.0, [0.0]
    for span in over:
        places = np.sort([*samples(span), *_roots(function, span)])
        sums = total + np.cumsum(_integrals(function, span, places))
        seen += [float(sums.min()), float(sums.max())]
        total = float(sums[-1])
    return min(seen), max(seen)


def _roots(function: SpanFunction, span: Span) -> Iterator[float]:
    places = samples(span)
    values = function(span, places)
    for number in np.flatnonzero(values[1:] * values[:-1] < 0):
        yield root_of(partial(function, span), *places[number : number + 2])


def _integrals(function: SpanFunction, span: Span, places: Floats) -> Floats:
    """Return the integrals between each two neighbours of some places in a span."""
    inside, weights = _gauss(places)
    values = function(span, inside.ravel()).reshape(inside.shape)
    return np.asarray((values * weights).sum(axis=1))


def _gauss(places: Floats) -> tuple[Floats, Floats]:
    """Return the nodes of Gauss and Legendre between each two neighbours, and their weights."""
    inside, weights = np.polynomial.legendre.leggauss(_NODES)
    half = np.diff(places)[:, None] / 2
    return places[:-1, None] + half * (1 + inside), half * weights


def _ends(motion: Motion) -> Iterator[float]:
    """Yield where a motion turns, where its derivatives do, and where its pieces meet."""
    for piece in motion.curve.pieces:
        yield from (piece.low, piece.high, *cuts(piece))
        with suppress(InputError):  # some turn so often that it cannot be proved
            yield from piece.turns


def _part(motion: Motion, angle: float) -> _Part:
    turns = (angle - motion.curve.low) // DEG_PER_TURN
    there = angle - turns * DEG_PER_TURN
    pieces = motion.curve.pieces
    piece = next((piece for piece in pieces if there <= piece.high), pieces[-1])
    return _Part(piece, -turns * DEG_PER_TURN)
