"""Where a function of the cam angle is largest, and where it is above zero.

What a cam is asked has no bounds that would prove its turns, as a motion has: the pressure angle
and the curvature are quotients of its displacement and two derivatives. So each smooth piece is
sampled closely, what is largest among the samples is searched for between its neighbours, and where
the sign changes is bracketed. A peak narrower than two samples could be missed.
"""

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from typing import NamedTuple, Protocol, TypeVar

import numpy as np

from cammotion.laws.piece import Piece
from cammotion.machine.arcs import Arc, arcs
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats, InputError

Function = Callable[[Piece, Floats], Floats]


class Stretch(Protocol):
    """A part of the turn, of which it is known where its derivatives turn: a piece is one."""

    @property
    def low(self) -> float:
        """Where it begins."""

    @property
    def high(self) -> float:
        """Where it ends."""

    @property
    def turns(self) -> list[float]:
        """Where it turns, in order."""

    @property
    def derivative(self) -> "Stretch":
        """Its derivative."""


S = TypeVar("S", bound=Stretch)

_STEP_DEG = 0.25
_LEAST_SAMPLES = 33
_SHARES = np.linspace(0, 1, 9)  # of a part between two cuts, where it is looked at
_NEAR = 5e-2  # samples so near to a level, as a share of all, may have one above it beside them
_CLOSE_DEG = 1e-10
_TWINS = 1e-9  # of a piece: so near to each other, two places are one that was computed twice


class Extreme(NamedTuple):
    """A largest or smallest value, and the cam angle in deg at which it is."""

    value: float
    at_deg: float


def largest(function: Callable[[S, Floats], Floats], pieces: Sequence[S]) -> Extreme:
    """Return the largest value of a function over the pieces of a turn, and where it is."""
    (value, place), _ = summit(function, pieces)
    return Extreme(value, place % DEG_PER_TURN)


def summit(function: Callable[[S, Floats], Floats], pieces: Sequence[S]) -> tuple[Extreme, S]:
    """Return the largest value, its place as its piece counts it, and the piece."""
    sampled = [function(piece, samples(piece)) for piece in pieces]
    top = max(values.max() for values in sampled)
    near = top - _NEAR * (top - min(values.min() for values in sampled))
    found = [
        (summit, piece)
        for piece, values in zip(pieces, sampled, strict=True)
        if values.max() >= near
        for summit in _summits(function, piece, values, near)
    ]
    return max(found, key=lambda each: each[0].value)


def where_positive(function: Callable[[S, Floats], Floats], pieces: Sequence[S]) -> list[Arc]:
    """Return the arcs of the turn over which a function is above 0, their ends to 1e-9 deg."""
    found: list[Arc] = []
    for piece in pieces:
        places = samples(piece)
        values = function(piece, places)
        near = -_NEAR * np.ptp(values)
        hidden = [s for s in _summits(function, piece, values, near) if s.value > 0]
        places = np.union1d(places, [summit.at_deg for summit in hidden])
        found.extend(_positive(function, piece, places))
    return arcs(found)


def samples(piece: Stretch) -> Floats:
    """Return places in a piece, close to one another and some between two cuts, with both ends."""
    count = max(_LEAST_SAMPLES, int(np.ceil((piece.high - piece.low) / _STEP_DEG)) + 1)
    ends = np.array([piece.low, *cuts(piece), piece.high])
    between = ends[:-1, None] + np.diff(ends)[:, None] * _SHARES
    places = np.union1d(np.linspace(piece.low, piece.high, count), between)
    is_apart = np.diff(places, append=np.inf) > _TWINS * (piece.high - piece.low)
    is_apart[0] = True
    return places[is_apart]


def cuts(piece: Stretch) -> list[float]:
    """Return in order where a piece's first three derivatives turn.

    Near there what is made of them has its peaks. And there, where the third has steps as in a law
    from points, the second has its kinks: between two cuts it is smooth.
    """
    curve: Stretch = piece
    found = set[float]()
    for _ in range(3):
        curve = curve.derivative
        with suppress(InputError):  # some turn so often that it cannot be proved
            found.update(curve.turns)
    return sorted(found)


def _positive(function: Callable[[S, Floats], Floats], piece: S, places: Floats) -> Iterator[Arc]:
    """Yield arcs in order over which a function is above 0 at all of the places in them."""
    is_above = function(piece, places) > 0
    start = piece.low
    for number in np.flatnonzero(is_above[1:] != is_above[:-1]):
        root = root_of(partial(function, piece), *places[number : number + 2])
        if is_above[number]:
            yield start, root
        start = root
    if is_above[-1]:
        yield start, piece.high


def _summits(
    function: Callable[[S, Floats], Floats], piece: S, values: Floats, least: float
) -> Iterator[Extreme]:
    """Yield what is largest beside each sample of at least this height that is a local summit.

    Of a level stretch the ends are enough.
    """
    places = samples(piece)
    wider = np.concatenate([[-np.inf], values, [-np.inf]])
    before, after = wider[:-2], wider[2:]
    is_level = (values == before) & (values == after)
    is_summit = (values >= before) & (values >= after) & (values >= least) & ~is_level
    for number in np.flatnonzero(is_summit):
        sampled = Extreme(float(values[number]), float(places[number]))
        low, high = places[max(int(number) - 1, 0)], places[min(int(number) + 1, len(places) - 1)]
        found = searched(partial(function, piece), low, high)
        yield found if found.value > sampled.value else sampled


def root_of(function: Callable[[Floats], Floats], low: float, high: float) -> float:
    """Return where a function is 0 between two places at which its signs differ."""
    from scipy.optimize import brentq  # it takes a second to load

    return float(brentq(lambda place: float(function(np.array([place]))[0]), low, high))


def searched(function: Callable[[Floats], Floats], low: float, high: float) -> Extreme:
    """Return what is largest between two places, where there is one summit between them."""
    from scipy.optimize import minimize_scalar

    found = minimize_scalar(
        lambda place: -float(function(np.array([place]))[0]),
        bounds=(low, high),
        method="bounded",
        options={"xatol": _CLOSE_DEG},
    )
    return Extreme(-float(found.fun), float(found.x))
