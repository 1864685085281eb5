"""What binds the moves of parts that are free, and what is found of them."""

from dataclasses import dataclass
from typing import NamedTuple

from cammotion.laws.motion_law import MotionLaw
from cammotion.whole.crossings import Span

NARROWEST_DEG = 1e-3
"""A move over less is none."""


class Begin(NamedTuple):
    """A range in deg in which a move begins, in one of the turns from the first to the last."""

    range_deg: tuple[float, float]
    turns: tuple[int, int]


@dataclass(frozen=True)
class Mover:
    """A part whose moves are free in these ranges, from the least to the largest, in deg.

    Each move has `laws` to choose from, and for each of them what its peak is, weighted, if it
    takes 1 deg (`costs`, all 0 if it does not count), and the least angle that its limit allows.
    Some have to begin in a range of the turn besides, and `ends` are the angles by which it has to
    have ended.
    """

    laws: tuple[tuple[MotionLaw, ...], ...]
    costs: tuple[tuple[float, ...], ...]
    narrowest: tuple[tuple[float, ...], ...]
    starts: tuple[tuple[float, float], ...]
    begins: tuple[Begin | None, ...]
    angles: tuple[tuple[float, float], ...]
    ends: tuple[float, ...]


@dataclass(frozen=True)
class Placed:
    """A move that was found: where it begins, its indexing angle, and which law it has."""

    start_deg: float
    angle_deg: float
    law: MotionLaw


class Apart(NamedTuple):
    """Two spans that may not overlap, each of a part or of one that stays as it is."""

    one: Span
    other: Span
