"""Segments: the rises, returns and dwells of which a motion is made."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cammotion.laws.catalogue import MotionLaw, as_law
from cammotion.machine.arcs import Arc
from cammotion.machine.kinematics import DEG_PER_TURN, STROKE, dimensional, indexing_time
from cammotion.quantities import Floats, InputError, Quantity

CAM_ANGLE = Quantity("cam angle", "deg", example=180, low=-math.inf)
POSITION = Quantity("position", "mm", example=50, low=-math.inf)
PART_ANGLE = Quantity("angle of a segment", "deg", example=55, high=DEG_PER_TURN)


@dataclass(frozen=True, kw_only=True)
class Segment:
    """A piece of a motion between two cam angles: a rise, a return or a dwell.

    The angles are in deg, the positions in mm. `law` is the name of a motion law or a law; a dwell
    has none. Raises InputError for numbers that are not finite, an angle that is not above 0, a
    dwell between two positions, a move between one and the same, and a law that is unknown or does
    not go from 0 to 1.

    >>> Segment(from_deg=150, to_deg=205, from_mm=0, to_mm=50, law="cycloidal").kind
    'rise'
    """

    from_deg: float
    to_deg: float
    from_mm: float
    to_mm: float
    law: str | MotionLaw | None = None

    def __post_init__(self) -> None:
        for end in ("from", "to"):
            for quantity, field in ((CAM_ANGLE, f"{end}_deg"), (POSITION, f"{end}_mm")):
                object.__setattr__(self, field, quantity.number(getattr(self, field)))
        PART_ANGLE.number(self.angle_deg)
        if self.law is not None:
            as_law(self.law).check_way()
        span = f"from {self.from_deg:g} to {self.to_deg:g} deg"
        if self.is_dwell and self.change_mm:
            raise InputError(
                f"The dwell {span} begins at {self.from_mm:g} mm and ends at {self.to_mm:g} mm; a "
                "dwell stays where it is: give it one position, or a law, for example 'cycloidal'."
            )
        if not self.is_dwell and not self.change_mm:
            raise InputError(
                f"The move {span} begins and ends at {self.from_mm:g} mm: give it a stroke, or "
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
    def kind(self) -> str:
        """One of 'rise', 'return' and 'dwell'."""
        return "dwell" if self.is_dwell else "rise" if self.change_mm > 0 else "return"

    @property
    def turning_degs(self) -> list[float]:
        """Where the position can be largest or smallest: at the ends, and where the law turns."""
        branches = () if self.law is None else as_law(self.law).branches[:-1]
        return [self.from_deg, *(self._angle_at(part.high) for part in branches), self.to_deg]

    def position_mm(self, angle_deg: ArrayLike) -> Floats:
        """Return the position in mm at cam angles within the segment, as an array."""
        return np.asarray(self.from_mm + self.change_mm * self._law_at(angle_deg, 0))

    def derivative(self, order: int, angle_deg: ArrayLike, rate_per_hour: float) -> Floats:
        """Return velocity, acceleration or jerk (order 1, 2, 3) at a machine rate, in m and s."""
        time = indexing_time(self.angle_deg, rate_per_hour)
        values = self._law_at(angle_deg, order)
        return np.asarray(dimensional(order, values, self.change_mm, time))

    def where_above(self, limit_mm: float) -> list[Arc]:
        """Return the intervals of cam angle over which the position is above a limit."""
        return self._where(limit_mm, 1)

    def where_below(self, limit_mm: float) -> list[Arc]:
        """Return the intervals of cam angle over which the position is below a limit."""
        return self._where(limit_mm, -1)

    def _where(self, limit_mm: float, side: int) -> list[Arc]:
        if self.law is None:
            is_there = side * (self.from_mm - limit_mm) > 0
            return [(self.from_deg, self.to_deg)] if is_there else []
        law, s = as_law(self.law), (limit_mm - self.from_mm) / self.change_mm
        parts = law.where_above(s) if side * self.change_mm > 0 else law.where_below(s)
        return [(self._angle_at(low), self._angle_at(high)) for low, high in parts]

    def _angle_at(self, place: float) -> float:
        return self.to_deg if place == 1 else self.from_deg + place * self.angle_deg

    def _law_at(self, angle_deg: ArrayLike, order: int) -> Floats:
        angles = np.asarray(angle_deg, dtype=np.float64)
        if self.law is None:
            return np.zeros_like(angles)
        places = np.clip((angles - self.from_deg) / self.angle_deg, 0.0, 1.0)
        return np.asarray(as_law(self.law)(places, order))


@dataclass(frozen=True)
class Part:
    """What is said of a segment before it has its place; made by `rise`, `return_` and `dwell`."""

    angle_deg: float
    change_mm: float = 0.0
    law: str | MotionLaw | None = None


def rise(stroke_mm: float, *, over_deg: float, law: str | MotionLaw = "cycloidal") -> Part:
    """Return a rise by `stroke_mm` over a cam angle of `over_deg`, by a motion law.

    Both are numbers above 0, the angle at most 360 deg. Raises InputError for others, and for an
    unknown law. What it is good for shows `motion`.
    """
    as_law(law)
    return Part(PART_ANGLE.number(over_deg), STROKE.number(stroke_mm), law)


def return_(stroke_mm: float, *, over_deg: float, law: str | MotionLaw = "cycloidal") -> Part:
    """Return a return, a `rise` the other way; the plain word `return` belongs to Python."""
    as_law(law)
    return Part(PART_ANGLE.number(over_deg), -STROKE.number(stroke_mm), law)


def dwell(angle_deg: float) -> Part:
    """Return a dwell over `angle_deg`, a number above 0 and at most 360 deg."""
    return Part(PART_ANGLE.number(angle_deg))
