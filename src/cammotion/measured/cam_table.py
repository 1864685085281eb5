"""A table of a cam: the position of its follower at some cam angles, as measured or printed."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from cammotion.alike import Alike
from cammotion.arguments import checked
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats, InputError, Quantity

DERIVATIVE = Quantity("derivative", "", example=1, high=2, low_included=True)
ANGLE = Quantity("cam angle", "deg", example=10, low=-1e6, high=1e6)
_ANGLE = replace(ANGLE, name="cam angle of the table")
_POSITION = Quantity("position of the table", "mm", example=5, low=-1e6, high=1e6)
_STEP = Quantity("step of the positions", "mm", example=0.01, high=1e6, low_included=True)
_FEWEST = 8  # points
_NARROW_DEG = 1e-6  # between two points, at least
_EVEN = 1e-6  # by such a share of their mean the steps of even angles may differ


@checked
@dataclass(frozen=True, eq=False)
class CamTable(Alike):
    """Positions of a follower over the cam angle, from a measurement, a drawing or a program.

    `angle_deg` are the cam angles in deg, which rise by 1e-6 at least; `position_mm` the positions
    in mm, as many, at least 8. `step_mm` is the step in mm to which the positions are rounded as
    printed, 0 where it is not known. `is_cycle` says that the table is one whole turn, closed in
    itself: its first point comes again after 360 deg, and is not repeated as the last. `said` is a
    sentence on what a file was taken for, empty where there was no file. Both arrays are kept as
    copies that cannot be changed. Raises InputError for what is no such table.

    >>> angles = np.arange(0, 360, 10)
    >>> table = CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), is_cycle=True)
    >>> table
    CamTable(36 points every 10 deg, a whole turn, 0 to 50 mm)
    """

    angle_deg: Floats
    position_mm: Floats
    step_mm: float = 0.0
    is_cycle: bool = False
    said: str = ""

    def __post_init__(self) -> None:
        angles, positions = _column(_ANGLE, self.angle_deg), _column(_POSITION, self.position_mm)
        if angles.ndim != 1 or angles.shape != positions.shape or angles.size < _FEWEST:
            raise InputError(
                f"The table has {angles.size} angles and {positions.size} positions: give two "
                f"lists of the same length, with at least {_FEWEST} numbers each."
            )
        _check_order(angles, self.is_cycle)
        known = {"angle_deg": angles, "position_mm": positions}
        self.__dict__.update(known | {"step_mm": _STEP.number(self.step_mm)})

    @cached_property
    def even_step_deg(self) -> float | None:
        """The step of the angles in deg if all are alike (over the end of a cycle too), or None.

        >>> CamTable([0, 1, 2, 3, 4, 5, 6, 8], [0, 1, 2, 3, 3, 2, 1, 0]).even_step_deg is None
        True
        """
        closing = [self.angle_deg[0] + DEG_PER_TURN] if self.is_cycle else []
        steps = np.diff([*self.angle_deg, *closing])
        is_even = np.ptp(steps) <= _EVEN * np.mean(steps)
        return float(np.mean(steps)) if is_even else None

    def mirrored(self) -> "CamTable":
        """Return the table with the return that mirrors it: from its last angle back as it came.

        A table over half a turn becomes a cycle. Raises InputError for one that is a cycle already,
        or goes over more than half a turn.

        >>> angles = np.arange(0, 190, 10)
        >>> CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), step_mm=0.01).mirrored()
        CamTable(36 points every 10 deg, a whole turn, 0 to 50 mm in steps of 0.01)
        """
        span = self.angle_deg[-1] - self.angle_deg[0]
        if self.is_cycle or span > DEG_PER_TURN / 2 * (1 + _EVEN):
            raise InputError(
                f"The table {'is a cycle' if self.is_cycle else f'goes over {span:g} deg'} and "
                "cannot be mirrored: give a table without its return, over 180 deg at most."
            )
        is_cycle = span >= DEG_PER_TURN / 2 * (1 - _EVEN)
        back = slice(-2, 0, -1) if is_cycle else slice(-2, None, -1)
        angles = [*self.angle_deg, *(2 * self.angle_deg[-1] - self.angle_deg[back])]
        positions = [*self.position_mm, *self.position_mm[back]]
        return CamTable(np.array(angles), np.array(positions), self.step_mm, is_cycle, self.said)

    def __repr__(self) -> str:
        step = self.even_step_deg
        low, high = float(self.position_mm.min()), float(self.position_mm.max())
        ends = f"{self.angle_deg[0]:g} to {self.angle_deg[-1]:g} deg"
        parts = [
            f"{self.angle_deg.size} points" + ("" if step is None else f" every {step:g} deg"),
            "a whole turn" if self.is_cycle else ends,
            f"{low:.6g} to {high:.6g} mm" + (f" in steps of {s:g}" if (s := self.step_mm) else ""),
        ]
        return f"CamTable({', '.join(parts)})"


def _column(quantity: Quantity, values: ArrayLike) -> Floats:
    column = quantity.array(values).copy()
    column.flags.writeable = False
    return column


def _check_order(angles: Floats, is_cycle: bool) -> None:
    steps, turn = np.diff(angles), 2 * np.pi
    if is_cycle and turn * (1 - 2 / angles.size) < np.ptp(angles) <= turn:
        raise InputError(
            f"The cycle goes from {angles[0]:g} to {angles[-1]:g} deg, which in radians is a turn: "
            "give the cam angles in deg, for example np.degrees(angles)."
        )
    if np.min(steps) < _NARROW_DEG:
        n = int(np.argmax(steps < _NARROW_DEG))
        raise InputError(
            f"The cam angle of the table is {angles[n + 1]:g} deg (at position {n + 1}) after "
            f"{angles[n]:g} deg; it has to rise by at least {_NARROW_DEG:g} deg from point to "
            "point: sort the points by their angle, and give each angle once."
        )
    if is_cycle and angles[-1] - angles[0] > DEG_PER_TURN - _NARROW_DEG:
        raise InputError(
            f"The cycle goes from {angles[0]:g} to {angles[-1]:g} deg; a turn is 360 deg, and its "
            "first point comes again at the end: leave out the last point, or give is_cycle=False."
        )
