"""Segments: the rises, returns and dwells of which a motion is made."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from cammotion.laws.catalogue import as_law
from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.series import Series
from cammotion.machine.arcs import ROUNDING_DEG, Arc, arcs
from cammotion.machine.kinematics import DEG_PER_TURN, FULL_TURN_DEG
from cammotion.quantities import InputError, Quantity, keep_numbers

CAM_ANGLE = Quantity("cam angle", "deg", example=180, low=-math.inf)
POSITION = Quantity("position", "mm", example=50, low=-math.inf)
LIMIT = Quantity("limit", "mm", example=19, low=-math.inf)
PART_ANGLE = Quantity("angle of a segment", "deg", example=55, high=FULL_TURN_DEG)
_ANY_ANGLE = replace(PART_ANGLE, low=-math.inf, high=math.inf)


def part_angle(angle_deg: float) -> float:
    """Return the angle of a segment in deg; raise InputError for none, or for more than a turn."""
    angle = _ANY_ANGLE.number(angle_deg)
    if 1.1 * FULL_TURN_DEG < angle <= 2 * FULL_TURN_DEG:
        raise InputError(
            f"The angle of a segment is {angle:g} deg, and a turn of the cam is 360: give at most "
            f"that, or {angle / 2:.12g} if you count the 720 deg of a crankshaft."
        )
    if angle == 0:
        what = "The angle of a segment is 0 deg; leave it out, or let it take an angle"
        raise InputError(f"{what}: give for example 55 deg.")
    return PART_ANGLE.number(angle)


@dataclass(frozen=True, kw_only=True)
class Segment:
    """A part of a motion between two cam angles: a rise, a return or a dwell.

    The angles are in deg, the positions in mm. `law` is a motion law, given by its name or itself;
    a dwell has none. Raises InputError for numbers that are not finite, an angle that is not above
    0, a dwell between two positions, a move between one and the same, and a law that is unknown or
    does not go from 0 to 1.

    >>> Segment(from_deg=150, to_deg=205, from_mm=0, to_mm=50, law="cycloidal").kind
    'rise'
    """

    from_deg: float
    to_deg: float
    from_mm: float
    to_mm: float
    law: str | MotionLaw | None = None

    def __post_init__(self) -> None:
        keep_numbers(
            self,
            from_deg=CAM_ANGLE.number,
            from_mm=POSITION.number,
            to_deg=CAM_ANGLE.number,
            to_mm=POSITION.number,
        )
        span = f"from {self.from_deg:.12g} to {self.to_deg:.12g} deg"
        if self.angle_deg < 0:
            later = self.from_deg + (self.angle_deg % DEG_PER_TURN or DEG_PER_TURN)
            raise InputError(
                f"The segment {span} ends before it begins: if it goes on over 360 deg, let it "
                f"end at {later:.12g} deg."
            )
        part_angle(self.angle_deg)
        if self.law is not None:
            object.__setattr__(self, "law", as_law(self.law))  # looked up once
            as_law(self.law).check_way()
        if self.is_dwell and self.change_mm:
            raise InputError(
                f"The dwell {span} begins at {self.from_mm:.12g} mm and ends at "
                f"{self.to_mm:.12g} mm; a dwell stays where it is: give it one position, or a law, "
                "for example 'cycloidal'."
            )
        if not self.is_dwell and not self.change_mm:
            raise InputError(
                f"The move {span} begins and ends at {self.from_mm:.12g} mm: give it a stroke, or "
                "make it a dwell (law=None)."
            )

    @property
    def angle_deg(self) -> float:
        """The cam angle that it takes."""
        return self.to_deg - self.from_deg

    @property
    def change_mm(self) -> float:
        """How far it goes: above 0 for a rise, below 0 for a return, 0 for a dwell."""
        return self.to_mm - self.from_mm

    @property
    def is_dwell(self) -> bool:
        """Whether the mechanism stands still."""
        return self.law is None

    @property
    def row(self) -> tuple[str | float, ...]:
        """Its angles in deg, its positions in mm, and the name of its law."""
        law = as_law(self.law).name if self.law else self.kind
        return self.from_deg, self.to_deg, self.from_mm, self.to_mm, law

    @property
    def kind(self) -> str:
        """One of 'rise', 'return' and 'dwell'."""
        return "dwell" if self.is_dwell else "rise" if self.change_mm > 0 else "return"

    @cached_property
    def curve(self) -> Curve:
        """The position in mm over the cam angle in deg, as a curve."""
        if self.law is None:
            return Curve([Series((self.from_mm,), (), self.from_deg, self.to_deg)])
        law = as_law(self.law)
        return law.curve.placed(self.from_deg, self.angle_deg, self.from_mm, self.change_mm)


def with_dwells(moves: Sequence[Segment]) -> Iterator[Segment]:
    """Yield the moves of a turn, each with the dwell that follows it until the next one begins."""
    ends = [*(move.from_deg for move in moves[1:]), moves[0].from_deg + DEG_PER_TURN]
    for move, end in zip(moves, ends, strict=True):
        yield move
        if end - move.to_deg > ROUNDING_DEG:
            height = move.to_mm
            yield Segment(from_deg=move.to_deg, to_deg=end, from_mm=height, to_mm=height)


def arcs_of(segments: Sequence[Segment]) -> list[Arc]:
    """Return the arcs of the turn that segments take, like the moves of a motion."""
    return arcs((segment.from_deg, segment.to_deg) for segment in segments)


def told(difference: float) -> str:
    """Return the size of a difference of angles or positions, with all digits that count.

    >>> told(360 - 210.8888888)
    '149.1111112'
    """
    return f"{round(abs(difference), 9):.12g}"
