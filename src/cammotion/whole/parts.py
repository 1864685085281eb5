"""Parts whose motions are all sought at once: where each has to stand, and how far it can get.

Angles are cam angles in deg, positions are in mm and accelerations in mm/deg2. Positions of an
indexing motion go on from turn to turn, counted as in the diagram.
"""

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cammotion.limits.corridors import NEAR_DEG
from cammotion.limits.standing import at_rest, unrolled_mm
from cammotion.machine.arcs import Arc
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats
from cammotion.rules.conditions import Condition

_SLACK_MM = 1e-9


class Stand(NamedTuple):
    """A motion stands at `place_mm` from one cam angle to another."""

    start_deg: float
    end_deg: float
    place_mm: float


class Interval(NamedTuple):
    """The positions from `low_mm` to `high_mm`, both included."""

    low_mm: float
    high_mm: float


@dataclass(frozen=True)
class Part:
    """A part whose motion is free but for what is said here.

    `motion` is the one in the diagram; over the `still` arcs, in the order in which they begin in
    the turn, it stands where that one does.
    `weight` is what its peak counts, `cap` what it may be at most in mm/deg2.
    """

    motion: Motion
    still: tuple[Arc, ...]
    travel_mm: tuple[float, float]
    weight: float
    cap: float

    @property
    def stands(self) -> list[Stand]:
        """Where it stands, in the order of the angles, over a turn from the first one on."""
        places = unrolled_mm(self.motion, np.array(self.still).mean(axis=1))
        return [Stand(*arc, place) for arc, place in zip(self.still, places.tolist(), strict=True)]

    @property
    def at_rest(self) -> Motion | None:
        """The motion that stands all of the turn; None if it has to move."""
        return at_rest(self.motion, np.array([stand.place_mm for stand in self.stands]))

    @property
    def middles_deg(self) -> list[float]:
        """The middle of each arc over which it may move."""
        stands = self.stands
        following = [*(start for start, _, _ in stands[1:]), stands[0].start_deg + DEG_PER_TURN]
        return [(end + on) / 2 for (_, end, _), on in zip(stands, following, strict=True)]

    def most(self, peak: float) -> float:
        """Return the acceleration that it may have if no weighted peak is above `peak`."""
        return min(self.cap, peak / self.weight if self.weight else math.inf)

    def standing(self, angle_deg: Floats) -> Floats:
        """Return where it has to stand at each angle; nan where it may move."""
        places = np.full(len(angle_deg), np.nan)
        for start, end, place in self.stands:
            turns = np.floor((angle_deg - start + NEAR_DEG) / DEG_PER_TURN)
            since = angle_deg - turns * DEG_PER_TURN - start
            here = since <= end - start + NEAR_DEG
            places[here] = place + self.motion.pitch_mm * turns[here]
        return places

    def reach(self, angle_deg: Floats, most: float) -> tuple[Floats, Floats]:
        """Return the lowest and the highest position at each angle that any such motion can have.

        Between two stands it leaves the one at rest and comes to the other at rest, and is pushed
        with no more than `most`. So at the velocity v it is no higher than after a full push that
        turns to a full brake in time to have v; and, seen from the end, the same. The one limit
        grows with v and the other falls, so that the lower of both is highest where they agree.
        """
        low = self.standing(angle_deg)
        high = low.copy()
        stands, pitch = self.stands, self.motion.pitch_mm
        start, end, place = stands[0]
        later = Stand(start + DEG_PER_TURN, end + DEG_PER_TURN, place + pitch)
        for before, after in zip(stands, [*stands[1:], later], strict=True):
            turns = np.floor((angle_deg - before.end_deg) / DEG_PER_TURN)
            since = angle_deg - turns * DEG_PER_TURN - before.end_deg
            gap = after.start_deg - before.end_deg
            here = (since > 0) & (since < gap) & np.isnan(high)
            t = since[here]
            top = _highest(before.place_mm, after.place_mm, t, gap - t, most)
            bottom = -_highest(-before.place_mm, -after.place_mm, t, gap - t, most)
            high[here], low[here] = top + pitch * turns[here], bottom + pitch * turns[here]
        least, largest = self.travel_mm
        return np.maximum(low, least), np.minimum(high, largest)


def _highest(first: float, last: float, t: Floats, u: Floats, most: float) -> Floats:
    """Return the highest position t after a rest at `first` and u before one at `last`."""
    if math.isinf(most):
        return np.full(len(t), np.inf)
    agree = most * (t - u) / 2 - 2 * (first - last + most * (t**2 - u**2) / 2) / (t + u)
    fastest = most * np.minimum(t, u)
    v = np.clip(agree, -fastest, fastest)
    from_first = first + most * t**2 / 2 - (most * t - v) ** 2 / (4 * most)
    to_last = last + most * u**2 / 2 - (most * u + v) ** 2 / (4 * most)
    found: Floats = np.minimum(from_first, to_last)
    return found


def intervals(motion: Motion, condition: Condition, low: float, high: float) -> list[Interval]:
    """Return the positions between `low` and `high` at which a condition holds, in pieces.

    The limit is always included, so that no position is left out at which it holds.
    """
    limit, pitch = condition.limit_mm, abs(motion.pitch_mm)
    if not motion.is_indexing:
        ends = (limit, math.inf) if condition.is_beyond else (-math.inf, limit)
        return [Interval(*ends)] if ends[0] <= high and ends[1] >= low else []
    if limit >= pitch / 2 and not condition.is_beyond:
        return [Interval(-math.inf, math.inf)]  # it always holds
    if limit > pitch / 2 and condition.is_beyond:
        return []
    stop = motion.start_mm % pitch
    least, most = (limit, pitch - limit) if condition.is_beyond else (-limit, limit)
    first = math.ceil((low - stop - most - _SLACK_MM) / pitch)
    last = math.floor((high - stop - least + _SLACK_MM) / pitch)
    return [
        Interval(stop + k * pitch + least, stop + k * pitch + most) for k in range(first, last + 1)
    ]
