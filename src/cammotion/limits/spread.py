"""Rules for mechanisms that run early or late, or are off their places: kept, whatever they do.

A mechanism that may run early or late does over wider arcs what it did: a condition is spread by so
many deg. What two spread arcs have in common is a violation that the errors can bring about. Of two
parts on one axis the lower one is taken where it is highest within the deg.
"""

from dataclasses import dataclass, replace
from functools import singledispatch

import numpy as np

from cammotion.machine.arcs import Arc, arcs, complement
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition, after
from cammotion.rules.distance import DistanceRule
from cammotion.rules.rule import Rule


@dataclass(frozen=True)
class Spread(Condition):
    """A condition as it may hold when its motion runs early or late by up to `deg`.

    Below 0 it is the condition as it holds for certain: its opposite may not.
    """

    sharp: Condition
    deg: float

    @property
    def opposite(self) -> "Spread":
        """The condition that holds exactly where this one does not."""
        return spread(self.sharp.opposite, -self.deg)

    def eased(self, mm: float) -> "Spread":
        """Return the condition that holds where this one is so near as to hold."""
        return spread(self.sharp.eased(mm), self.deg)

    def check(self, diagram: TimingDiagram) -> None:
        """Raise InputError for a limit that no distance from a stop can have."""
        self.sharp.check(diagram)

    def arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs over which it may hold, or holds for certain."""
        sharp = self.sharp.arcs(diagram)
        if self.deg >= 0:
            return _widened(sharp, self.deg)
        return complement(_widened(complement(sharp), -self.deg))

    def room_mm(self, diagram: TimingDiagram, angle_deg: float) -> float:
        """Return the least room that it may have, or of one for certain the largest."""
        width = abs(self.deg)
        start, end = angle_deg - width, angle_deg + width
        turns = (after(turn, start) for turn in self.turning_degs(diagram))
        places = (start, angle_deg, end, *(turn for turn in turns if turn < end))
        rooms = [self.sharp.room_mm(diagram, place) for place in places]
        return min(rooms) if self.deg >= 0 else max(rooms)

    def turning_degs(self, diagram: TimingDiagram) -> tuple[float, ...]:
        """Return the cam angles at which the room can be least."""
        return self.sharp.turning_degs(diagram)


def spread(condition: Condition, deg: float) -> Spread:
    """Return a condition as it may hold so many deg earlier or later."""
    return Spread(condition.motion, condition.limit_mm, condition.is_beyond, condition, deg)


@dataclass(frozen=True, repr=False)
class SpreadDistance(DistanceRule):
    """A distance that is kept also when the part runs early or late against the lower one."""

    early_deg: float = 0.0
    late_deg: float = 0.0

    def distance_mm(self, diagram: TimingDiagram, angle_deg: Floats) -> Floats:
        """Return the least distance that there may be while the part is at these cam angles."""
        part, below = (diagram[name] for name in self.motions)
        window = self.early_deg + self.late_deg
        return np.asarray(
            part.position_mm(angle_deg) - _highest(below, angle_deg - self.early_deg, window)
        )

    def cuts_of(self, motion: Motion) -> list[float]:
        """Return where a motion is not smooth, and where such a place comes into reach."""
        places = super().cuts_of(motion)
        return [at + way for at in places for way in (-self.late_deg, 0.0, self.early_deg)]


@singledispatch
def with_errors(rule: Rule, phase_deg: float, off_mm: tuple[float, float]) -> Rule:
    """Return the rule that is kept where this one is kept with errors of its two motions.

    Against each other they are early or late by `phase_deg`, and off their places by `off_mm`.
    """
    raise NotImplementedError(f"errors of {type(rule).__name__}")


@with_errors.register
def _(rule: ClearanceRule, phase_deg: float, off_mm: tuple[float, float]) -> ClearanceRule:
    kept = rule.only_while.opposite.eased(off_mm[1]).opposite
    return ClearanceRule(spread(rule.when.eased(off_mm[0]), phase_deg), kept, rule.name)


@with_errors.register
def _(rule: DistanceRule, phase_deg: float, off_mm: tuple[float, float]) -> SpreadDistance:
    least = rule.at_least_mm + sum(off_mm)
    return SpreadDistance(rule.part, rule.above, least, rule.name, phase_deg, phase_deg)


def tightened(rule: Rule, motion: str, deg: float, mm: float) -> Rule:
    """Return the rule that is kept where this one keeps a reserve in deg, and in mm of `when`.

    What is spread of a clearance rule is the half that is not about `motion`, whose own limit so
    stays sharp.
    """
    if isinstance(rule, ClearanceRule) and rule.when.motion == motion:
        return replace(rule, when=rule.when.eased(mm), only_while=spread(rule.only_while, -deg))
    return with_errors(rule, deg, (mm, 0.0))


def _highest(motion: Motion, angle_deg: Floats, window_deg: float) -> Floats:
    """Return the highest position in the window that begins at each cam angle."""
    ends = motion.position_mm(angle_deg), motion.position_mm(angle_deg + window_deg)
    corners = np.array([corner for piece in motion.curve.pieces for corner in piece.corners])
    since = (corners[:, :1] - np.ravel(angle_deg)) % DEG_PER_TURN
    inside = np.where(since <= window_deg, corners[:, 1:], -np.inf).max(axis=0)
    return np.asarray(np.maximum(np.maximum(*ends), inside.reshape(np.shape(angle_deg))))


def _widened(these: list[Arc], deg: float) -> list[Arc]:
    return arcs((start - deg, end + deg) for start, end in these)
