"""Conditions of one motion, of which a clearance rule has two: where it is, or whether it moves."""

import math
from dataclasses import dataclass, field, replace

import numpy as np

from cammotion.arguments import checked
from cammotion.machine.arcs import ROUNDING_DEG, Arc, complement
from cammotion.machine.diagram import TimingDiagram, name_of
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import LIMIT, Segment, arcs_of
from cammotion.quantities import InputError, as_text, keep_numbers


@dataclass(frozen=True)
class Condition:
    """What a motion's offset may be: beyond a limit in mm, or within it (the limit included).

    The offset is `Motion.offset_mm`: the position, or of an indexing motion the distance from the
    nearest stop. Made by `beyond` and `within`. One that `is_eased` has a limit that is a little
    farther off than what a user gave.
    """

    motion: str
    limit_mm: float
    is_beyond: bool
    is_eased: bool = field(default=False, compare=False, repr=False, kw_only=True)

    def __post_init__(self) -> None:
        keep_numbers(self, limit_mm=LIMIT.number)

    @property
    def opposite(self) -> "Condition":
        """The condition that holds exactly where this one does not."""
        return replace(self, is_beyond=not self.is_beyond)

    def eased(self, mm: float) -> "Condition":
        """Return the condition that holds where this one is so near as to hold."""
        limit = self.limit_mm + (-mm if self.is_beyond else mm)
        return replace(self, limit_mm=limit, is_eased=True)

    def check(self, diagram: TimingDiagram) -> None:
        """Raise InputError for a limit that no distance from a stop can have."""
        motion = diagram[self.motion]
        if motion.is_indexing and self.limit_mm < 0 and not self.is_eased:
            raise InputError(
                f"The limit of the {motion.name} is {self.limit_mm:g} mm, and of an indexing "
                "motion the way to its nearest stop counts, which is never below 0: give at least "
                f"0 mm, for example {replace(self, limit_mm=-self.limit_mm)}."
            )

    def arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs of the turn over which it holds."""
        beyond = diagram[self.motion].where_beyond(self.limit_mm)
        return beyond if self.is_beyond else complement(beyond)

    def room_mm(self, diagram: TimingDiagram, angle_deg: float) -> float:
        """Return how far the motion still is from the condition; below 0 where it holds."""
        offset = float(diagram[self.motion].offset_mm(angle_deg))
        return self.limit_mm - offset if self.is_beyond else offset - self.limit_mm

    def turning_degs(self, diagram: TimingDiagram) -> tuple[float, ...]:
        """Return the cam angles at which the room can be least."""
        return diagram[self.motion].offset_turning_degs

    def describe_fault(self, excess_mm: float, at_deg: float) -> str:
        """Say in words how far its motion goes too far, at a cam angle."""
        return f"is {as_text(excess_mm, '.3g')} mm {self._fault} at {at_deg:.5g} deg"

    @property
    def _fault(self) -> str:
        return "too deep" if self.is_beyond else "too near"

    def __str__(self) -> str:
        """Say it in words."""
        return f"{'beyond' if self.is_beyond else 'within'} {self.limit_mm:g} mm"


@dataclass(frozen=True)
class Moving(Condition):
    """Whether a motion moves, or stands; its limit is 0 mm. Made by `moving` and `standing`.

    No error of its position makes a part move that stands: its room for that is infinite. One that
    moves goes too far by its way from the nearer end of its move.
    """

    def eased(self, mm: float) -> "Moving":  # noqa: ARG002 - there is no limit to be eased
        """Return it again."""
        return self

    def arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs of the turn over which it holds."""
        moves = arcs_of(diagram[self.motion].moves)
        return moves if self.is_beyond else complement(moves)

    def room_mm(self, diagram: TimingDiagram, angle_deg: float) -> float:
        """Return how far the motion still is from the condition; below 0 where it holds."""
        ways = [_way_mm(move, angle_deg) for move in diagram[self.motion].moves]
        under_way = [way for way in ways if way is not None]
        if not under_way:
            return math.inf if self.is_beyond else 0.0
        return 0.0 - max(under_way) if self.is_beyond else max(under_way)

    def turning_degs(self, diagram: TimingDiagram) -> tuple[float, ...]:
        """Return the cam angles at which the room can be least."""
        motion = diagram[self.motion]
        passed = (
            end
            for move in motion.moves
            for mm in (move.from_mm, (move.from_mm + move.to_mm) / 2, move.to_mm)
            for arc in move.curve.where(mm, 1)
            for end in arc
        )
        return (*motion.turning_degs, *passed)

    def describe_fault(self, excess_mm: float, at_deg: float) -> str:
        """Say in words how far its motion goes too far, at a cam angle; one that stands, stands."""
        if not self.is_beyond:
            return f"stands at {at_deg:.5g} deg"
        return super().describe_fault(excess_mm, at_deg)

    @property
    def _fault(self) -> str:
        return "on its way"

    def __str__(self) -> str:
        """Say it in words."""
        return "moving" if self.is_beyond else "standing"


@checked
def beyond(motion: str | Motion, limit_mm: float) -> Condition:
    """Return the condition that a motion is further than `limit_mm`, for a `ClearanceRule`.

    Further up: a part that works downwards from 0 has to be described with its depth upwards.
    An indexing motion counts from its nearest stop, both ways alike, and its limit is at least 0.

    >>> str(beyond("die", 19))
    'beyond 19 mm'
    """
    return Condition(name_of(motion), limit_mm, True)


@checked
def within(motion: str | Motion, limit_mm: float) -> Condition:
    """Return the condition that a motion is at most at `limit_mm`, for a `ClearanceRule`.

    An indexing motion counts from its nearest stop, both ways alike, and its limit is at least 0.

    >>> str(within("mill", 0.65))
    'within 0.65 mm'
    """
    return Condition(name_of(motion), limit_mm, False)


@checked
def moving(motion: str | Motion) -> Condition:
    """Return the condition that a motion is in one of its moves, for a `ClearanceRule`.

    >>> import cammotion as cm
    >>> print(cm.ClearanceRule(moving("mill"), only_while=cm.within("die", 19)))
    the mill may be moving only while the die is within 19 mm
    """
    return Moving(name_of(motion), 0.0, True)


@checked
def standing(motion: str | Motion) -> Condition:
    """Return the condition that a motion is in one of its dwells, for a `ClearanceRule`.

    >>> import cammotion as cm
    >>> print(cm.ClearanceRule(cm.beyond("die", 19), only_while=standing("mill")))
    the die may be beyond 19 mm only while the mill is standing
    """
    return Moving(name_of(motion), 0.0, False)


def after(angle: float, start: float) -> float:
    """Return the angle in the turn that begins at `start`."""
    return start + (angle - start) % DEG_PER_TURN


def _way_mm(move: Segment, angle_deg: float) -> float | None:
    """Return how far a move is from its nearer end; None where it is over, or not begun."""
    place = after(angle_deg, move.from_deg - ROUNDING_DEG)
    if place > move.to_deg + ROUNDING_DEG:
        return None
    if min(place - move.from_deg, move.to_deg - place) <= ROUNDING_DEG:
        return 0.0
    height = float(move.curve(np.array([place]))[0])
    return min(abs(height - move.from_mm), abs(height - move.to_mm))
