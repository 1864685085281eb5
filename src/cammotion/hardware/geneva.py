"""The Geneva wheel: a driver with a pin turns a slotted wheel, and it has no law to choose.

The driver turns evenly, by alpha from the middle of the index. With n slots and lambda =
sin(pi/n), the ratio of the pin's radius to the distance of the axes, the wheel is at

    beta = atan( lambda sin(alpha) / (1 - lambda cos(alpha)) ),

and the pin enters and leaves along the slot, at alpha = -+(pi/2 - pi/n). Derivatives by alpha are
ratios: times the driver's omega, or its square, they are the wheel's velocity and acceleration.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy
from numpy.typing import ArrayLike

from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.symbols import x
from cammotion.quantities import Numbers, Quantity, keep_numbers, plain

_SLOTS = Quantity("number of slots", "", example=8, low=3, high=60, low_included=True)
_DERIVATIVE = Quantity("derivative", "", example=1, high=2, low_included=True)
_ROUNDING = 1e-12
_SMALL = 1e-16  # a term of the series that changes no digit


@dataclass(frozen=True)
class Geneva:
    """An external Geneva wheel with a number of `slots`, from 3 to 60.

    Raises InputError for another number.

    >>> wheel = Geneva(8)
    >>> print(f"{wheel.peak_velocity:.3f} omega, {wheel.peak_acceleration:.3f} omega^2")
    0.620 omega, 0.700 omega^2
    >>> wheel.angle_deg, wheel.share_of_turn
    (135.0, 0.375)
    """

    slots: int

    def __post_init__(self) -> None:
        keep_numbers(self, slots=_SLOTS.whole)

    @property
    def ratio(self) -> float:
        """The radius of the pin over the distance of the axes, sin(pi/n)."""
        return math.sin(math.pi / self.slots)

    @property
    def angle_deg(self) -> float:
        """By how much the driver turns during the index, 180 - 360/n, in deg."""
        return 180 - 360 / self.slots

    @property
    def share_of_turn(self) -> float:
        """For which part of a turn of the driver the wheel moves, (n - 2)/(2 n)."""
        return (self.slots - 2) / (2 * self.slots)

    @property
    def peak_velocity(self) -> float:
        """The largest velocity of the wheel over omega: lambda/(1 - lambda), in the middle."""
        return self.ratio / (1 - self.ratio)

    @property
    def peak_alpha_deg(self) -> float:
        """Where the acceleration is largest, in deg of the driver before and after the middle."""
        half = (1 + self.ratio**2) / (4 * self.ratio)
        return math.degrees(math.acos(math.sqrt(half**2 + 2) - half))

    @property
    def peak_acceleration(self) -> float:
        """The largest acceleration of the wheel over omega^2."""
        return abs(float(self(self.peak_alpha_deg, 2)))

    @property
    def entry_acceleration(self) -> float:
        """The acceleration over omega^2 with which the pin enters and leaves, tan(pi/n).

        It is not zero: the wheel has stood still, and the torque is there at once.

        >>> print(f"{Geneva(4).entry_acceleration:.3f}")
        1.000
        """
        return math.tan(math.pi / self.slots)

    def __call__(self, alpha_deg: ArrayLike, derivative: int = 0) -> Numbers:
        """Return beta in rad, or its first or second derivative by alpha, at alpha in deg.

        `alpha_deg` is a number or an array, 0 in the middle of the index. Raises InputError for an
        angle at which the pin is out of the slot.

        >>> print(f"{Geneva(6)(30):.4f} rad")
        0.4153 rad
        """
        end = self.angle_deg / 2 * (1 + _ROUNDING)
        quantity = Quantity("driver angle", "deg", example=0, low=-end, high=end, low_included=True)
        alpha, k = np.radians(quantity.array(alpha_deg)), self.ratio
        order = _DERIVATIVE.whole(derivative)
        if order == 0:
            return plain(np.arctan2(k * np.sin(alpha), 1 - k * np.cos(alpha)))
        under = 1 - 2 * k * np.cos(alpha) + k**2
        if order == 1:
            return plain(k * (np.cos(alpha) - k) / under)
        return plain(-k * (1 - k**2) * np.sin(alpha) / under**2)

    @cached_property
    def law(self) -> MotionLaw:
        """The index as a motion law over x = t/tm, to compare with others; it cannot be chosen.

        The arc tangent is a sum of waves, lambda^k sin(k alpha)/k for k = 1, 2, ..., of which so
        many are taken that no digit is missing: of three slots several hundred, and then the
        factors of the law take seconds.

        >>> wheel = Geneva(8).law
        >>> print(f"Cv {wheel.Cv:.3f}, Ca {wheel.Ca:.3f}, Cj {wheel.Cj}")
        Cv 1.860, Ca 4.946, Cj inf
        """
        most = math.ceil(math.log(_SMALL) / math.log(self.ratio))
        half = sympy.Rational(1, 2)
        alpha = math.pi * (1 - 2 / self.slots) * (x - half)
        whole = self.slots / (2 * math.pi)
        waves = (  # as they are: SymPy would look through each of them for a simpler form
            whole * self.ratio**k / k * sympy.sin(k * alpha, evaluate=False)
            for k in range(1, most + 1)
        )
        return MotionLaw(f"Geneva wheel, {self.slots} slots", half + sympy.Add(*waves))
