"""Bands: the room of an indexing motion about a stop, over an arc, whichever stop that is.

A turret that has to be within 0.65 mm of a stop while the die is down is so at one and the same
stop as long as the die stays down; one that has to be away from its stops is between the same two.
At which is not said: that is a whole number, to be found together with the motion.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cammotion.machine.arcs import Arc
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError
from cammotion.rules.conditions import Condition
from cammotion.rules.rule import ROUNDING_MM


@dataclass(frozen=True)
class Band:
    """The room over one arc: from `low_mm` to `high_mm` above a stop that is not said.

    Stop number 0 is at 0 mm, the others every `spacing_mm`. `nodes` are the numbers of the nodes
    in the arc, `ahead_mm` how much further than at the node the motion is in the arc: a pitch for
    the nodes of an arc that goes on over the end of the grid.
    """

    nodes: NDArray[np.intp]
    ahead_mm: Floats
    low_mm: float
    high_mm: float
    spacing_mm: float

    def limits_mm(self, stop: float) -> tuple[Floats, Floats]:
        """Return the least and the largest position at its nodes, about one stop."""
        place = stop * self.spacing_mm - self.ahead_mm
        return place + self.low_mm, place + self.high_mm

    def stops_at(self, places: Floats) -> Floats:
        """Return for a position at each of its nodes the number of the stop that it is about."""
        above = places + self.ahead_mm - self.low_mm + ROUNDING_MM
        return np.floor(above / self.spacing_mm)

    def agrees(self, other: "Band") -> bool:
        """Whether there are stops for both, at which a node in both arcs has any room."""
        _, here, there = np.intersect1d(self.nodes, other.nodes, return_indices=True)
        if not here.size:
            return True
        apart = self.ahead_mm[here[0]] - other.ahead_mm[there[0]]
        least, most = other.low_mm - self.high_mm + apart, other.high_mm - self.low_mm + apart
        slack = ROUNDING_MM / self.spacing_mm
        return bool(math.floor(most / self.spacing_mm + slack) >= least / self.spacing_mm - slack)


def make_band(
    motion: Motion, condition: Condition, arc: Arc, nodes: Any, ahead_mm: Floats
) -> Band | None:
    """Return the band in which an indexing motion keeps a condition; None if it always does.

    Raises InputError if it never does, or not over such an arc.
    """
    limit, pitch = condition.limit_mm, abs(motion.pitch_mm)
    is_wide = limit >= pitch / 2 - ROUNDING_MM
    if condition.is_beyond and limit == 0:
        raise InputError(
            f"The {motion.name} has to be beyond 0 mm of a stop; a motion that only passes its "
            "stop is not covered here: give a limit above 0 mm."
        )
    if is_wide and not condition.is_beyond:
        return None
    if is_wide:
        raise InputError(
            f"No motion keeps all of this: with a pitch of {pitch:g} mm the {motion.name} is never "
            f"{condition} of a stop; give a limit from 0 to below {pitch / 2:g} mm."
        )
    if arc[1] - arc[0] >= DEG_PER_TURN:
        raise InputError(
            f"No motion keeps all of this: the {motion.name} has to be {condition} of a stop over "
            "the whole turn, and so cannot go on to the next: weaken the rules."
        )
    first = motion.start_mm % pitch
    low, high = (limit, pitch - limit) if condition.is_beyond else (-limit, limit)
    return Band(nodes, ahead_mm, first + low, first + high, pitch)


def check_agree(name: str, bands: Sequence[Band], angle_deg: Floats) -> None:
    """Raise InputError if at some node one condition and another exclude each other."""
    for one, other in combinations(bands, 2):
        if not one.agrees(other):
            angle = angle_deg[np.intersect1d(one.nodes, other.nodes)[0]] % DEG_PER_TURN
            raise InputError(
                f"No motion keeps all of this: at {angle:g} deg the rules want the {name} nearer "
                "to a stop, and farther from it, than it can be at once: weaken one of them."
            )
