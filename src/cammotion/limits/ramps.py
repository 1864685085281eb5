"""A motion law from pieces over which the acceleration is a straight line.

Neighbours with one line in common are made one zone of the law, so that of hundreds of pieces a
few zones remain.
"""

from typing import NamedTuple

import numpy as np

from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.series import Series
from cammotion.quantities import Floats

_SAME = 1e-8  # accelerations that differ by so much of the largest are one


class Piece(NamedTuple):
    """A time over which the acceleration is a straight line."""

    seconds: float
    starting: float
    ending: float

    @property
    def slope(self) -> float:
        """The jerk."""
        return (self.ending - self.starting) / self.seconds

    @property
    def gained(self) -> float:
        """The velocity gained."""
        return self.seconds * (self.starting + self.ending) / 2

    @property
    def moved(self) -> float:
        """The way made, from rest."""
        return self.seconds**2 * (self.starting / 3 + self.ending / 6)

    def before(self, time: float) -> "Piece":
        """Return what comes before a time within it."""
        return Piece(time, self.starting, self.starting + self.slope * time)

    def after(self, time: float) -> "Piece":
        """Return what comes after a time within it."""
        return Piece(self.seconds - time, self.starting + self.slope * time, self.ending)


def law_of(pieces: list[Piece], change_mm: float) -> MotionLaw:
    """Return the law of a move by `change_mm` from rest to rest."""
    pieces = _closed(_merged(pieces), change_mm)
    total = sum(piece.seconds for piece in pieces)
    series, place, s, v = [], 0.0, 0.0, 0.0
    for number, piece in enumerate(pieces, 1):
        seconds = piece.seconds / total
        scaled = Piece(
            seconds,
            piece.starting * total**2 / change_mm,
            piece.ending * total**2 / change_mm,
        )
        end = 1.0 if number == len(pieces) else place + seconds
        series.append(Series((s, v, scaled.starting / 2, scaled.slope / 6), (), place, end))
        place, s, v = end, s + v * seconds + scaled.moved, v + scaled.gained
    return MotionLaw("least acceleration", Curve(series))


def _merged(pieces: list[Piece]) -> list[Piece]:
    """Return the pieces with those made one whose accelerations are one line."""
    rounding = _SAME * max(abs(end) for piece in pieces for end in piece[1:])
    found: list[Piece] = []
    for piece in pieces:
        if piece.seconds <= 0:
            continue
        if found and _is_one_line(found[-1], piece, rounding):
            before = found.pop()
            piece = Piece(before.seconds + piece.seconds, before.starting, piece.ending)
        found.append(piece)
    return found


def _is_one_line(one: Piece, other: Piece, rounding: float) -> bool:
    bend = (one.slope - other.slope) * min(one.seconds, other.seconds)
    return abs(one.ending - other.starting) <= rounding and abs(bend) <= rounding


def _closed(pieces: list[Piece], change_mm: float) -> list[Piece]:
    """Return the pieces without the rounding of what found them: ending at rest, in its place.

    The accelerations are changed as little as this takes. What is constant stays so, what is
    continuous too, and where a move begins or ends without acceleration it does so still.
    """
    ends = np.array([piece[1:] for piece in pieces])
    share = _free_ends(ends)
    seconds = [piece.seconds for piece in pieces]
    effect = np.array([_outcome(seconds, column.reshape(-1, 2)) for column in share.T]).T
    for _ in range(2):
        missing = np.array([0.0, change_mm]) - _outcome(seconds, ends)
        scale = np.abs(effect).max(axis=1)
        change = np.linalg.lstsq(effect / scale[:, None], missing / scale, rcond=None)[0]
        ends = ends + (share @ change).reshape(-1, 2)
    return [Piece(time, *map(float, both)) for time, both in zip(seconds, ends, strict=True)]


def _free_ends(ends: Floats) -> Floats:
    """Return which ends of the pieces change together: a column for each that is free."""
    count = len(ends)
    rounding = _SAME * np.abs(ends).max()
    if np.all(np.abs(ends[:, 0] - ends[:, 1]) <= rounding):
        return np.repeat(np.eye(count), 2, axis=0)
    corners = np.zeros((2 * count, count + 1))
    for piece in range(count):
        corners[2 * piece, piece] = corners[2 * piece + 1, piece + 1] = 1.0
    values = np.append(ends[:, 0], ends[-1, 1])
    inner = (np.arange(count + 1) % count > 0) | (np.abs(values) > rounding)
    return corners[:, inner]


def _outcome(seconds: list[float], ends: Floats) -> Floats:
    """Return the velocity and the place, from rest, at the end of pieces."""
    place = velocity = 0.0
    for time, both in zip(seconds, ends, strict=True):
        piece = Piece(time, *both)
        place += velocity * time + piece.moved
        velocity += piece.gained
    return np.array([velocity, place])
