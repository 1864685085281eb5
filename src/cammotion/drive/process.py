"""Forces that the process has on a mechanism."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike

from cammotion.machine.diagram import name_of
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE, PART_ANGLE
from cammotion.quantities import Floats, InputError, Numbers, Quantity, keep_numbers, plain

_ARC = replace(PART_ANGLE, name="arc of the force")
_FORCE = Quantity("force of the process", "N", example=400, low=-math.inf)


@dataclass(frozen=True, kw_only=True)
class ProcessForce:
    """A force in N that the process has on a mechanism over an arc of the turn.

    Above 0 it pushes towards lower positions, so that a rise works against it. It goes evenly from
    `force_N` to `last_N`; without that it stays what it is. `to_deg` is above `from_deg`, and above
    360 where the arc crosses 360. Raises InputError for numbers that are not finite, and an arc
    that is not above 0 and at most 360 deg.

    >>> pressing = ProcessForce(motion="die", from_deg=190, to_deg=205, force_N=0, last_N=600)
    >>> pressing.at([180, 195, 204.99, 210]).round(1)
    array([  0. , 200. , 599.6,   0. ])
    """

    motion: str | Motion
    from_deg: float
    to_deg: float
    force_N: float  # noqa: N815 - newton
    last_N: float | None = None  # noqa: N815

    def __post_init__(self) -> None:
        object.__setattr__(self, "motion", name_of(self.motion))
        ends = {"from_deg": CAM_ANGLE.number, "to_deg": CAM_ANGLE.number}
        forces = [name for name in ("force_N", "last_N") if getattr(self, name) is not None]
        keep_numbers(self, **ends, **dict.fromkeys(forces, _FORCE.number))
        if self.to_deg <= self.from_deg:
            turns = 1 + (self.from_deg - self.to_deg) // DEG_PER_TURN
            raise InputError(
                f"The force begins at {self.from_deg:g} deg and ends at {self.to_deg:g} deg: if it "
                "goes on over the end of the turn, give "
                f"to_deg={self.to_deg + turns * DEG_PER_TURN:g}."
            )
        _ARC.number(self.to_deg - self.from_deg)

    def at(self, angle_deg: ArrayLike) -> Numbers:
        """Return the force in N at a cam angle in deg, 0 outside of the arc."""
        angle = CAM_ANGLE.array(angle_deg)
        return plain(force_beside(self, angle, angle))


def force_beside(force: ProcessForce, angle: Floats, beside: Floats | float) -> Floats:
    """Return the force in N at an angle, at an end of its arc as it is at the angle beside it."""
    width, since = force.to_deg - force.from_deg, (beside - force.from_deg) % DEG_PER_TURN
    last = force.force_N if force.last_N is None else force.last_N
    found = force.force_N + (last - force.force_N) * (since + angle - beside) / width
    return np.where(since < width, found, 0.0)
