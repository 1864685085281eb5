"""The disc cam of a follower with a flat face."""

from dataclasses import dataclass
from functools import cached_property

from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.bracketed import Extreme
from cammotion.hardware.disc_cam import (
    PER_RAD,
    DiscCam,
    Undercut,
    check_motion,
    lift_of,
    travel_mm,
    undercuts_of,
)
from cammotion.hardware.envelope import Lift, points
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, Numbers, Quantity, keep_numbers, plain

_BASE = Quantity("radius of the base circle", "mm", example=50)
_SHARP = 1e-9  # of the largest radius: so little too sharp is rounding


@checked
@dataclass(frozen=True)
class FlatFacedCam(DiscCam):
    """A cam whose follower has a flat face, square to its way.

    `base_radius_mm` is how far the face is from the cam's axis at the motion's lowest position.
    Raises InputError for an indexing motion, and for one whose velocity jumps.

    >>> import cammotion as cm
    >>> up, down = (make(50, over_deg=180, law="simple harmonic") for make in (cm.rise, cm.return_))
    >>> cam = cm.FlatFacedCam(cm.motion("valve", up, down), base_radius_mm=25)
    >>> cam.profile_radius_mm([0, 100, 200]).round(9)
    array([50., 50., 50.])
    """

    motion: Motion
    base_radius_mm: float

    def __post_init__(self) -> None:
        check_motion(self.motion)
        keep_numbers(self, base_radius_mm=_BASE.number)

    def profile_mm(self, angle_deg: ArrayLike) -> Floats:
        """Return the points (x, y) in mm that touch the face, in an array (..., 2)."""
        lift = self.lift(angle_deg)
        return points(1j * (self.base_radius_mm + lift.lift) - lift.slope, angle_deg)

    def profile_radius_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return the profile's radius of curvature in mm, below 0 where it is undercut.

        It is the base radius, the displacement and its second derivative by the rad together.
        """
        return plain(self._radius(self.lift(angle_deg)))

    def contact_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return how far right of the cam's axis the face is touched, in mm; left is below 0."""
        return plain(-self.lift(angle_deg).slope)

    @cached_property
    def face_mm(self) -> tuple[float, float]:
        """How far left and right of the cam's axis the face is touched, in mm; left is below 0.

        A face has to be wider by half the length of the contact, and a little more.
        """
        slope = self.motion.curve.derivative.extremes
        return -slope[1] * PER_RAD, -slope[0] * PER_RAD

    @cached_property
    def sharpest(self) -> Extreme:
        """The least radius of curvature of the profile in mm, and where it is."""
        found = self._largest(lambda lift: -self._radius(lift))
        return Extreme(-found.value, found.at_deg)

    @cached_property
    def undercuts(self) -> tuple[Undercut, ...]:
        """Where the profile's radius would be below 0; the ends are bracketed to 1e-9 deg."""
        allowed = _SHARP * (self.base_radius_mm + travel_mm(self.motion))
        return undercuts_of(
            lambda piece, at: -self._radius(lift_of(self.motion, piece, at)) - allowed,
            self.motion.curve.pieces,
            lambda worst: worst + allowed,
        )

    def _radius(self, lift: Lift) -> Floats:
        return self.base_radius_mm + lift.lift + lift.bend
