"""Sets of cam angles: arcs of a turn, each from one angle to another.

A set is a sorted list of arcs (start, end) that do not touch, 0 <= start < end <= 360 deg. An arc
that runs on into the next turn is held in two parts; `unwrap` shows it in one. What is shorter
than `ROUNDING_DEG`, an arc or a gap between two, is the rounding of its ends and dropped.
"""

from collections.abc import Iterable
from itertools import pairwise

from cammotion.machine.kinematics import DEG_PER_TURN

Arc = tuple[float, float]

ROUNDING_DEG = 1e-9


def arcs(pieces: Iterable[Arc]) -> list[Arc]:
    """Return the set that covers all the pieces, given at any angles, each at most a turn long.

    >>> arcs([(350, 380), (15, 30)])
    [(0.0, 30.0), (350.0, 360.0)]
    """
    found: list[Arc] = []
    for start, end in sorted(part for piece in pieces for part in _within_a_turn(*piece)):
        if found and start <= found[-1][1] + ROUNDING_DEG:
            start, end = found[-1][0], max(found.pop()[1], end)
        found.append((start, end))
    return found


def complement(these: list[Arc]) -> list[Arc]:
    """Return the rest of the turn.

    >>> complement([(0, 30), (350, 360)])
    [(30, 350)]
    """
    ends = [0.0, *(angle for arc in these for angle in arc), float(DEG_PER_TURN)]
    return [arc for arc in zip(ends[::2], ends[1::2], strict=True) if _is_arc(*arc)]


def intersect(these: list[Arc], those: list[Arc]) -> list[Arc]:
    """Return what is in both sets.

    >>> intersect([(0, 30), (350, 360)], [(20, 355)])
    [(20, 30), (350, 355)]
    """
    both = ((max(a, c), min(b, d)) for a, b in these for c, d in those)
    return sorted(arc for arc in both if _is_arc(*arc))


def unwrap(these: list[Arc]) -> list[Arc]:
    """Return the arcs with the one that crosses 360 deg in one piece, its end above 360.

    >>> unwrap([(0, 30), (100, 120), (350, 360)])
    [(100, 120), (350, 390)]
    """
    crosses = len(these) > 1 and these[0][0] == 0 and these[-1][1] == DEG_PER_TURN
    if not crosses:
        return list(these)
    return [*these[1:-1], (these[-1][0], these[0][1] + DEG_PER_TURN)]


def _within_a_turn(start: float, end: float) -> list[Arc]:
    turn = float(DEG_PER_TURN)
    if end - start >= turn:
        return [(0.0, turn)]
    back = start // turn * turn
    start, end = start - back, end - back
    cuts = [start, turn, end] if start < turn < end else [start, end]
    parts = [(_snap(low % turn), _snap(high - low + low % turn)) for low, high in pairwise(cuts)]
    return [(low, high) for low, high in parts if _is_arc(low, high)]


def _snap(angle: float) -> float:
    """Return 0 or 360 for what differs from it by rounding, so that `unwrap` knows it again."""
    ends = (0.0, float(DEG_PER_TURN))
    return next((end for end in ends if abs(angle - end) <= ROUNDING_DEG), angle)


def _is_arc(start: float, end: float) -> bool:
    return end - start > ROUNDING_DEG
