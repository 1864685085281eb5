"""A motion made wider or narrower: what of it stays in place, and which angles it can take."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import product
from typing import NamedTuple

from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import with_dwells
from cammotion.quantities import InputError
from cammotion.rules.conditions import after
from cammotion.rules.rule import Rule

NARROW_DEG = 1e-4  # a move that takes no time, for all that a cam can do
_VELOCITY, _ACCELERATION = 1, 2  # the orders of these derivatives
_DIGITS = 9  # behind the point of a sum of angles; what differs by less is rounding
_REST = 1e-6  # of the mean velocity: a law that is slower at its ends rests there


def rests_at(law: MotionLaw, end: int) -> bool:
    """Tell whether a law is at rest at its beginning, 0, or its end, 1."""
    return abs(float(law(end, 1))) <= _REST


def hands_over(motion: Motion) -> bool:
    """Tell whether moves go on with a velocity that those before have left them, without a jump.

    It would jump there if one of them got another angle or law.
    """
    laws = [as_law(move.law) for move in motion.moves]
    if all(rests_at(law, end) for law in laws for end in (0, 1)):  # also of what never moves
        return False
    return not motion.steps(1)


def is_usual(motion: Motion) -> bool:
    """Tell whether a motion is of the build that can be widened about what stays of it."""
    return len(motion.moves) == (1 if motion.is_indexing else 2)


class Event(NamedTuple):
    """Where a rule can begin or cease to hold: a move's number and Bm, and the cam angle."""

    move: int
    bm: float
    rule: Rule
    at_deg: float


class Frame:
    """A motion made wider or narrower about what stays in place.

    Place x of a move then stands at the cam angle anchor + (x - share) Bm, so every angle at which
    the motion meets a limit shifts in proportion to Bm. `room` is what the turn has for all moves.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion, moves = motion, motion.moves
        if not is_usual(motion):
            build = "one move" if motion.is_indexing else "one rise and one return"
            raise InputError(
                f"The motion {motion.name!r} has {len(moves)} moves, and only one with {build} can "
                "be widened symmetrically: give it that, or ask optimise for the angles of "
                "all its moves, with the arcs over which it has to stand."
            )
        if hands_over(motion):
            raise InputError(
                f"The moves of the motion {motion.name!r} go on with a velocity that another has "
                "left them, and with other angles it would jump: give it moves that rest where "
                "they meet, or build it anew with each angle."
            )
        first, last = moves[0], moves[-1]
        if motion.is_indexing:
            self.anchors = [(first, (first.from_deg + first.to_deg) / 2, 0.5)]
            self.room = float(DEG_PER_TURN)
        else:
            self.anchors = [(first, first.to_deg, 1.0), (last, last.from_deg, 0.0)]
            self.room = DEG_PER_TURN - (last.from_deg - first.to_deg)

    @property
    def has_two_angles(self) -> bool:
        """Whether its moves have different angles now."""
        angles = [move.angle_deg for move, _, _ in self.anchors]
        return max(angles) - min(angles) > ROUNDING_DEG

    def with_angles(self, angles: Sequence[float]) -> Motion:
        """Return the motion with these indexing angles Bm, one for each move."""
        moves = [
            replace(move, from_deg=anchor - share * bm, to_deg=anchor + (1 - share) * bm)
            for (move, anchor, share), bm in zip(self.anchors, angles, strict=True)
        ]
        return replace(self.motion, segments=tuple(with_dwells(moves)))

    def angles_at(self, limit_mm: float, angle_deg: float) -> Iterator[tuple[int, float]]:
        """Yield every Bm with which a move meets a limit at a cam angle, and the move's number."""
        meetings = [end for arc in self.motion.where_beyond(limit_mm) for end in arc]
        for number, (move, anchor, share) in enumerate(self.anchors):
            ways = [(after(m, move.from_deg) - move.from_deg) / move.angle_deg for m in meetings]
            for place in {0.0, 1.0, *(way for way in ways if 0 < way < 1)} - {share}:
                for turn in (-1, 0, 1):
                    since = angle_deg + turn * DEG_PER_TURN - anchor % DEG_PER_TURN
                    if NARROW_DEG < (bm := since / (place - share)) < self.room:
                        yield number, bm

    def candidates(self, events: Iterable[Event], each_way: bool) -> Iterator[tuple[float, ...]]:
        """Yield the indexing angles that can be the widest, the best first.

        One angle for all moves: the widest first. Each its own: the smallest peak first, and of
        two that share the whole room with each other also what one leaves to the other. Where a
        velocity jumps at any angle, the largest sum of both first, and then the least velocity.
        """
        count = len(self.anchors)
        bms = [{event.bm for event in events if event.move == n} for n in (0, 1)]
        if not each_way or count == 1:
            most = self.room / count
            one_angle = {most, *(bm for bm in bms[0] | bms[1] if bm < most)}
            yield from ((bm,) * count for bm in sorted(one_angle, reverse=True))
            return
        now = [move.angle_deg for move, _, _ in self.anchors]
        even = self._even_share()
        rises, returns = ({*found, bm} for found, bm in zip(bms, now, strict=True))
        pairs = {
            (rise, back)
            for rise, back in (
                (even, self.room - even),
                *product(rises, returns),
                *((rise, self.room - rise) for rise in rises),
                *((self.room - back, back) for back in returns),
            )
            if min(rise, back) > NARROW_DEG and rise + back <= self.room + ROUNDING_DEG
        }
        yield from sorted(pairs, key=self._rank)

    def met(self, events: Iterable[Event], angles: Sequence[float]) -> list[Event]:
        """Return the events at which the motion with these angles is, in the order of the turn."""
        start = self.with_angles(angles).moves[0].from_deg
        met = [e for e in events if abs(e.bm - angles[e.move]) <= ROUNDING_DEG]
        return sorted(met, key=lambda event: after(event.at_deg, start))

    def _rank(self, angles: Sequence[float]) -> tuple[float, float]:
        most = max(
            width**self._order / bm**self._order
            for width, bm in zip(self._even, angles, strict=True)
        )
        wide = -round(sum(angles), _DIGITS)
        return (most, wide) if self._order == _ACCELERATION else (wide, most)

    def _even_share(self) -> float:
        """Return the angle of the first move with which both, sharing the room, peak alike."""
        first, last = self._even
        return self.room * first / (first + last)

    @cached_property
    def _order(self) -> int:
        """The order of the derivative that is made small: 2, or 1 if that is infinite anyway."""
        return _VELOCITY if math.isinf(self.motion.peak(_ACCELERATION)) else _ACCELERATION

    @cached_property
    def _even(self) -> list[float]:
        """Angles of the moves with which this derivative has one peak in all of them."""
        peaks = [
            abs(move.change_mm) * as_law(move.law).curve.derived(self._order).largest
            for move, _, _ in self.anchors
        ]
        return [peak ** (1 / self._order) for peak in peaks]
