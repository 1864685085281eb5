"""Where moves meet a limit, wherever they are in the turn and whatever their angles are.

A move with a law meets a limit at a fixed share of its indexing angle. So the arcs over which a
condition holds begin and end at angles that are sums of starts and angles of moves, each times a
number. This is what lets all starts and angles be found by a program that is linear.

Where that is in the turn of today does not matter, and so it is read off a motion of the same
moves that are all as wide and have a dwell between any two. There each crossing is in one move and
no other, also where a dwell is as high as the limit: one that is there today or one that can come
about.
"""

from collections.abc import Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.arcs import ROUNDING_DEG, Arc, complement, unwrap
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import InputError
from cammotion.rules.conditions import Condition

_ROUNDING = 1e-9  # of the angle of a move


class Place(NamedTuple):
    """How far a move of a part is in time, as a share of its angle: one for each law it may have.

    It is that of the turn in which the first move begins, or of so many `turns` later.
    """

    part: int
    move: int
    shares: tuple[float, ...]
    turns: int


class Span(NamedTuple):
    """An arc from one end to the other: a place in a move, or an angle in deg that stays.

    Where it is the dwell `after` a move of a part and no more, it may come to be none, and then it
    breaks no rule.
    """

    start: Place | float
    end: Place | float
    after: tuple[int, int] | None = None


def fixed_spans(motion: Motion, condition: Condition) -> list[Span]:
    """Return where a motion that stays as it is keeps a condition."""
    return [Span(*arc) for arc in _arcs(motion, condition)]


def spans(
    part: int, motion: Motion, laws: Sequence[Sequence[MotionLaw]], condition: Condition
) -> list[Span]:
    """Return where a part of a number keeps a condition, whatever its starts and angles are.

    `laws` are those that each move may have, as many for one as for another. Raises InputError
    where one of them meets the limit another number of times than another.
    """
    tried = []
    for chosen in zip(*laws, strict=True):
        spread = _spread(motion, chosen)
        found, place = _arcs(spread, condition), partial(_place, part, spread)
        if found == [(0.0, DEG_PER_TURN)]:  # all of the turn, which no move bounds
            tried.append([Span(*found[0])])
        else:
            tried.append([Span(place(start), place(end)) for start, end in found])
    if len({tuple(map(_shape, found)) for found in tried}) > 1:
        raise InputError(
            f"The laws for the {motion.name} do not all meet its limit of {condition.limit_mm:g} "
            "mm as often: give laws of one kind, all of them monotone."
        )
    return [_joined(of_each_law, len(laws)) for of_each_law in zip(*tried, strict=True)]


def _arcs(motion: Motion, condition: Condition) -> list[Arc]:
    beyond = motion.where_beyond(condition.limit_mm)
    return unwrap(beyond if condition.is_beyond else complement(beyond))


def _spread(motion: Motion, laws: Sequence[MotionLaw]) -> Motion:
    """Return the moves by these laws from 0 deg on, each as wide as the dwell that is after it."""
    ends = np.linspace(0.0, DEG_PER_TURN, 2 * len(laws) + 1).tolist()
    segments: list[Segment] = []
    for number, (move, law) in enumerate(zip(motion.moves, laws, strict=True)):
        start, end, on = ends[2 * number : 2 * number + 3]
        low, high = move.from_mm, move.to_mm
        segments += [
            Segment(from_deg=start, to_deg=end, from_mm=low, to_mm=high, law=law),
            Segment(from_deg=end, to_deg=on, from_mm=high, to_mm=high),
        ]
    return Motion(motion.name, tuple(segments), motion.stops)


def _place(part: int, spread: Motion, angle_deg: float) -> Place:
    """Return the place of an angle, in the one move that is there."""
    turns = (angle_deg + ROUNDING_DEG) // DEG_PER_TURN
    within = angle_deg - turns * DEG_PER_TURN
    shares = enumerate((within - move.from_deg) / move.angle_deg for move in spread.moves)
    [(move, share)] = [one for one in shares if -_ROUNDING <= one[1] <= 1 + _ROUNDING]
    is_edge = abs(share - round(share)) < _ROUNDING
    return Place(part, move, (float(round(share)) if is_edge else share,), int(turns))


def _shape(span: Span) -> tuple[tuple[int, int] | None, ...]:
    """Return what of a span is the same for laws of one kind."""
    ends = span.start, span.end
    return tuple((end.move, end.turns) if isinstance(end, Place) else None for end in ends)


def _joined(of_each_law: Sequence[Span], moves: int) -> Span:
    """Return a span of so many moves by one law each as that of the moves by any of these."""
    start, end = (_joined_ends(list(ends)) for ends in list(zip(*of_each_law, strict=True))[:2])
    if not (isinstance(start, Place) and isinstance(end, Place)):
        return Span(start, end)
    on = (start.turns * moves + start.move + 1) == end.turns * moves + end.move
    is_dwell = on and set(start.shares) == {1.0} and set(end.shares) == {0.0}
    return Span(start, end, (start.part, start.move) if is_dwell else None)


def _joined_ends(ends: Sequence[Place | float]) -> Place | float:
    places = [end for end in ends if isinstance(end, Place)]
    shares = tuple(share for place in places for share in place.shares)
    return places[0]._replace(shares=shares) if places else ends[0]
