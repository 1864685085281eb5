"""The plate cam that gives a die exactly its motion, through a roller and a rocking lever.

Places are complex numbers in mm about the lever's pivot, x to the right and y up. On the left the
lever carries the roller, which runs on top of the cam; on the right it holds the die's pin in a
slot, so that the tangent of the lever's angle is the pin's height over the slot's distance. The
cam turns clockwise.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats, InputError
from cammotion.views.animation.dies import Die

Places = NDArray[np.complex128]
STEEPEST_DEG = 35.0  # beyond, the cam pushes the lever's bearing more than the lever
STEP_DEG = 1.0
_SIZES = (2.2, 4.2, 1.48, 0.28)  # both arms and both radii, as shares of the die's travel


@dataclass(frozen=True)
class PlateCam:
    """The cam for a die, and the lever between them; lengths in mm, cam angles in deg."""

    die: Die
    roller_arm: float
    die_arm: float
    prime_radius: float
    roller_radius: float

    @classmethod
    def fitting(cls, die: Die) -> "PlateCam":
        """Return a cam as large as the die's travel asks for; InputError if none is good."""
        cam = cls(die, *(share * die.travel for share in _SIZES))
        cam.check()
        return cam

    @cached_property
    def axis(self) -> complex:
        """The cam's axis, under the roller, as low as the prime circle needs."""
        lowest = self.roller_centre([0.0, *self.angles_deg]).imag.min()
        return complex(-self.roller_arm, lowest - self.prime_radius)

    @cached_property
    def angles_deg(self) -> Floats:
        """Cam angles of a turn, close where the die moves; of a dwell the two ends."""
        parts = [
            np.linspace(
                segment.from_deg,
                segment.to_deg,
                2 if segment.is_dwell else int(np.ceil(segment.angle_deg / STEP_DEG)) + 1,
            )
            for segment in self.die.motion.segments
        ]
        turn = np.mod(np.concatenate(parts), DEG_PER_TURN).round(9)
        return np.union1d(turn, [0.0, DEG_PER_TURN])

    def pin_height(self, angle_deg: ArrayLike, order: int = 0) -> Floats:
        """Return how high the die's pin is over the pivot, or a derivative in mm/deg."""
        motion = self.die.motion
        low, high = motion.range_mm
        phase = motion.start_deg + np.mod(
            np.asarray(angle_deg, float) - motion.start_deg, DEG_PER_TURN
        )
        way = np.asarray(motion.curve.derived(order)(phase))
        up = -1.0 if self.die.goes_down_as_it_rises else 1.0
        return up * (way if order else way - (low + high) / 2)

    def lever_deg(self, angle_deg: ArrayLike) -> Floats:
        """Return the lever's angle in deg, positive where the die is high."""
        return np.degrees(np.arctan2(self.pin_height(angle_deg), self.die_arm))

    def roller_centre(self, angle_deg: ArrayLike) -> Places:
        """Return where the roller's centre is."""
        return np.asarray(-self.roller_arm * np.exp(1j * np.radians(self.lever_deg(angle_deg))))

    def profile(self, angle_deg: ArrayLike) -> Places:
        """Return the points that touch the roller, about the cam's axis, as they lie at 0 deg.

        They are the envelope of the roller's places as the cam sees them: its centre, and from
        there the radius along the normal, which is known from the derivative.
        """
        pitch, slope, _ = self._pitch_curve(angle_deg)
        return pitch + self.roller_radius * 1j * slope / np.abs(slope)

    def pressure_angle_deg(self, angle_deg: ArrayLike) -> Floats:
        """Return the angle between the push of the cam and the way that the roller can go."""
        _, slope, _ = self._pitch_curve(angle_deg)
        turned = np.exp(1j * np.radians(angle_deg))
        way = 1j * self.roller_centre(angle_deg) * turned
        push = 1j * slope
        along = np.abs((push * way.conj()).real) / np.abs(push * way)
        return np.degrees(np.arccos(np.minimum(along, 1.0)))

    def sharpest_radius(self, angle_deg: ArrayLike) -> float:
        """Return the least radius in mm of the pitch curve where it bulges outwards."""
        _, slope, bend = self._pitch_curve(angle_deg)
        curvature = (slope.conj() * bend).imag / np.abs(slope) ** 3
        return float(1 / curvature.max())

    def check(self) -> None:
        """Raise InputError for a cam that would jam, or whose profile would be cut away."""
        angles = np.linspace(0, DEG_PER_TURN, 3601)
        steepest = float(self.pressure_angle_deg(angles).max())
        if steepest > STEEPEST_DEG:
            raise InputError(
                f"The pressure angle of the cam for '{self.die.motion.name}' reaches "
                f"{steepest:.1f} deg; it may be at most {STEEPEST_DEG:g}: give the motion more "
                "angle or less stroke."
            )
        sharpest = self.sharpest_radius(angles)
        if sharpest <= self.roller_radius:
            raise InputError(
                f"The pitch curve of the cam for '{self.die.motion.name}' has a radius of "
                f"{sharpest:.1f} mm and the roller one of {self.roller_radius:g} mm, so that the "
                "profile is undercut: give the motion more angle or less stroke."
            )

    def _pitch_curve(self, angle_deg: ArrayLike) -> tuple[Places, Places, Places]:
        """Return the roller's centre as the cam sees it, with two derivatives by the radian."""
        height, rate, bend = (
            self.pin_height(angle_deg, order) * np.degrees(1) ** order for order in range(3)
        )
        square = self.die_arm**2 + height**2
        turn = rate * self.die_arm / square
        turn_on = bend * self.die_arm / square - 2 * height * self.die_arm * rate**2 / square**2
        roller = self.roller_centre(angle_deg)
        seen = roller - self.axis
        first = 1j * turn * roller
        second = (1j * turn_on - turn**2) * roller
        back = np.exp(1j * np.radians(angle_deg))  # undoes the cam's clockwise turn
        return (
            seen * back,
            (first + 1j * seen) * back,
            (second + 2j * first - seen) * back,
        )
