"""The followers of a disc cam: where they are, and where they can go.

Places are complex numbers in mm about the cam's axis, x to the right and y up, as the machine
stands. The follower is above the cam, and the cam turns clockwise.
"""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cammotion.quantities import Floats, InputError, Quantity, keep_numbers

Places = NDArray[np.complex128]

ROLLER = Quantity("radius of the roller", "mm", example=10)
OFFSET = Quantity("offset of the follower", "mm", example=5, low=-math.inf)
ARM = Quantity("arm of the follower", "mm", example=80)
PIVOT = Quantity("distance of the follower's pivot", "mm", example=100)
CUTTER = Quantity("radius of the cutter", "mm", example=8)
PRIME = Quantity("radius of the prime circle", "mm", example=50)


class RollerFollower(ABC):
    """A follower that touches the cam with a roller."""

    radius_mm: float

    @abstractmethod
    def place(self, lift_mm: Floats, prime_radius_mm: Any) -> tuple[Places, Places, Places]:
        """Return where the roller's centre is, its way there (of length 1), and how that turns.

        `lift_mm` is counted from the prime circle.
        """

    @abstractmethod
    def body(self, roller: complex, length_mm: float) -> list[complex]:
        """Return the line that is drawn of the follower, with its roller at a place."""

    @abstractmethod
    def primes(self, travel_mm: float) -> tuple[float, float]:
        """Return between which radii in mm a prime circle has to be, for a travel in mm."""

    def check(self, prime_radius_mm: float, travel_mm: float) -> None:
        """Raise InputError for a prime circle with which the follower cannot be built."""
        reach, high = self.primes(travel_mm)
        low = max(reach, self.radius_mm)
        if not low < high:
            raise InputError(
                f"With this follower no prime circle has a travel of {travel_mm:g} mm: the arm "
                "does not reach so far. Give a longer arm, or a shorter travel."
            )
        if not low < prime_radius_mm < high:
            most = f" and less than {high:.6g}" if math.isfinite(high) else ""
            example = (low + high) / 2 if most else 1.5 * low
            raise InputError(
                f"The radius of the prime circle is {prime_radius_mm:g} mm; with this follower it "
                f"has to be more than {low:.6g}{most} mm, which the roller, the offset or the arm "
                f"ask for: give for example {example:.4g} mm."
            )


@dataclass(frozen=True)
class TranslatingRoller(RollerFollower):
    """A roller on a slide that goes straight up.

    `radius_mm` is the roller's. `offset_mm` is how far the slide stands beside the cam's axis, on
    the side on which it makes the pressure angle of the rise smaller; below 0 on the other side.
    Raises InputError for a radius that is not above 0 mm.

    >>> TranslatingRoller(10).offset_mm
    0.0
    """

    radius_mm: float
    offset_mm: float = 0.0

    def __post_init__(self) -> None:
        keep_numbers(self, radius_mm=ROLLER.number, offset_mm=OFFSET.number)

    def place(self, lift_mm: Floats, prime_radius_mm: Any) -> tuple[Places, Places, Places]:
        """Return where the roller's centre is, its way there, and how that turns: not at all."""
        height = np.sqrt(prime_radius_mm**2 - self.offset_mm**2) + lift_mm
        return 1j * height - self.offset_mm, np.full(np.shape(height), 1j), np.zeros_like(height)

    def body(self, roller: complex, length_mm: float) -> list[complex]:
        """Return the slide, over the roller."""
        return [roller, roller + 1j * (self.radius_mm + length_mm)]

    def primes(self, travel_mm: float) -> tuple[float, float]:  # noqa: ARG002 - it goes as far
        """Return between which radii a prime circle has to be: the slide has to reach it."""
        return abs(self.offset_mm), math.inf


@dataclass(frozen=True)
class SwingingRoller(RollerFollower):
    """A roller on an arm that swings about a pivot to the right of the cam's axis.

    `radius_mm` is the roller's, `arm_mm` the distance from the pivot to its centre, `pivot_mm` that
    from the pivot to the cam's axis. The displacement is counted along the roller's way: divided by
    the arm it is the angle in rad. Raises InputError for a length that is not above 0 mm.

    >>> import math
    >>> math.degrees(50 / SwingingRoller(10, arm_mm=100, pivot_mm=120).arm_mm).__round__(2)
    28.65
    """

    radius_mm: float
    arm_mm: float
    pivot_mm: float

    def __post_init__(self) -> None:
        keep_numbers(self, radius_mm=ROLLER.number, arm_mm=ARM.number, pivot_mm=PIVOT.number)

    def place(self, lift_mm: Floats, prime_radius_mm: Any) -> tuple[Places, Places, Places]:
        """Return where the roller's centre is, its way there, and how that turns by the mm."""
        arm, pivot = self.arm_mm, self.pivot_mm
        lowest = np.arccos((prime_radius_mm**2 - pivot**2 - arm**2) / (2 * pivot * arm))
        along = np.exp(1j * (lowest - lift_mm / arm))
        return pivot + arm * along, -1j * along, -along / arm

    def body(self, roller: complex, length_mm: float) -> list[complex]:  # noqa: ARG002 - it ends
        """Return the arm, from the roller to its pivot."""
        return [roller, complex(self.pivot_mm)]

    def primes(self, travel_mm: float) -> tuple[float, float]:
        """Return between which radii a prime circle has to be: the arm has to reach all places."""
        square = self.pivot_mm**2 + self.arm_mm**2
        swing = min(travel_mm / self.arm_mm, math.pi)
        longest = math.sqrt(square + 2 * self.pivot_mm * self.arm_mm * math.cos(swing))
        return abs(self.pivot_mm - self.arm_mm), longest
