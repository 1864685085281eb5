"""The disc cam of a roller follower, open or with a groove."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.bracketed import Extreme
from cammotion.hardware.disc_cam import (
    DiscCam,
    Undercut,
    check_motion,
    lift_of,
    travel_mm,
    undercuts_of,
)
from cammotion.hardware.envelope import (
    Lift,
    curvature,
    pitch_tangent,
    points,
    pressure_angle,
)
from cammotion.hardware.followers import CUTTER, PRIME, RollerFollower
from cammotion.laws.piece import Piece
from cammotion.machine.arcs import Arc, arcs
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Numbers, keep_numbers, plain

_FINE_DEG, _SEEN_MM = 0.05, 1e-3
_SHARP = 1e-9  # of the roller: so little too sharp is rounding


@checked
@dataclass(frozen=True)
class RollerCam(DiscCam):
    """A cam whose follower has a roller.

    `motion` comes back to where it began; `prime_radius_mm` is the distance of the roller's centre
    from the cam's axis at the motion's lowest position. Raises InputError for an indexing motion,
    for one whose velocity jumps, and for a prime circle that the follower cannot have.

    >>> import cammotion as cm
    >>> cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(10), prime_radius_mm=60)
    >>> cam.profile_mm(0).round(3)
    array([ 0., 50.])
    >>> steepest, at_deg = cam.largest_pressure_angle
    >>> print(f"{steepest:.2f} deg at {at_deg:.2f} deg")
    51.81 deg at 174.14 deg
    """

    motion: Motion
    follower: RollerFollower
    prime_radius_mm: float

    def __post_init__(self) -> None:
        check_motion(self.motion)
        keep_numbers(self, prime_radius_mm=PRIME.number)
        self.follower.check(self.prime_radius_mm, travel_mm(self.motion))

    @property
    def roller_radius_mm(self) -> float:
        """The radius of the roller in mm."""
        return self.follower.radius_mm

    def pitch_mm(self, angle_deg: ArrayLike) -> Floats:
        """Return the pitch curve, on which the roller's centre is, as points (..., 2) in mm."""
        (lift,) = self.derivatives(angle_deg, 1)
        return points(self.follower.place(lift, self.prime_radius_mm)[0], angle_deg)

    @checked
    def profile_mm(self, angle_deg: ArrayLike, *, outer: bool = False) -> Floats:
        """Return the points (x, y) in mm that touch the roller, in an array (..., 2).

        With `outer` they are those of the far flank of a groove. Exact: each lies on the normal of
        the pitch curve, a radius away.
        """
        return self._beside(angle_deg, self.roller_radius_mm if outer else -self.roller_radius_mm)

    @checked
    def cutter_mm(self, angle_deg: ArrayLike, radius_mm: float, *, outer: bool = False) -> Floats:
        """Return the way of a cutter's centre, as points (..., 2) in mm, of another radius.

        The cutter makes the profile, or with `outer` the far flank of a groove. Raises InputError
        for one that is too large for a hollow of the profile, or for the groove.

        >>> import cammotion as cm
        >>> cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(10), prime_radius_mm=160)
        >>> cam.cutter_mm(0, 16).round(6)
        array([  0., 166.])
        """
        radius = CUTTER.number(radius_mm)
        most = self.roller_radius_mm if outer else self.hollowest.value + self.roller_radius_mm
        if radius > most:
            where = (
                "the groove is as wide as the roller"
                if outer
                else f"at {self.hollowest.at_deg:.5g} deg the profile has a hollow"
            )
            raise InputError(
                f"The radius of the cutter is {radius:.7g} mm, and {where}, of {most:.6g} mm: give "
                f"a cutter of at most {_floored(most):.7g} mm."
            )
        return self._beside(
            angle_deg, self.roller_radius_mm - radius if outer else radius - self.roller_radius_mm
        )

    def _beside(self, angle_deg: ArrayLike, away_mm: float) -> Floats:
        """Return the curve beside the pitch curve, so many mm outwards, as points (..., 2)."""
        lift, slope = self.derivatives(angle_deg, 2)
        place, tangent = pitch_tangent(self.follower, lift, slope, self.prime_radius_mm)
        return points(place - 1j * away_mm * tangent / np.abs(tangent), angle_deg)

    def pressure_angle_deg(self, angle_deg: ArrayLike) -> Numbers:
        """Return the angle in deg between the cam's push and the way that the roller can go.

        Above 0 where the push leans the way the cam turns, as it does on a rise.
        """
        return plain(self._pressure(self.lift(angle_deg)))

    def pitch_radius_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return the radius of curvature of the pitch curve in mm, below 0 where it is hollow."""
        with np.errstate(divide="ignore"):
            return plain(1 / self._curvature(self.lift(angle_deg)))

    def profile_radius_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return the profile's radius of curvature in mm: the pitch curve's less the roller's.

        Below 0 where it is hollow, and where it is undercut.
        """
        return plain(self.pitch_radius_mm(angle_deg) - self.roller_radius_mm)

    @cached_property
    def largest_pressure_angle(self) -> Extreme:
        """The largest pressure angle in deg on either side, counted positive, and where it is."""
        return self._largest(lambda lift: np.abs(self._pressure(lift)))

    @cached_property
    def sharpest(self) -> Extreme:
        """The least radius of the pitch curve in mm where it bulges outwards, and where it is."""
        found = self._largest(self._curvature)
        return Extreme(1 / found.value, found.at_deg)

    @cached_property
    def hollowest(self) -> Extreme:
        """The least radius of the pitch curve in mm where it is hollow, and where it is.

        The radius is counted positive, and infinite for a curve that is nowhere hollow.
        """
        found = self._largest(lambda lift: -self._curvature(lift))
        return Extreme(1 / found.value if found.value > 0 else math.inf, found.at_deg)

    @cached_property
    def undercuts(self) -> tuple[Undercut, ...]:
        """Where the pitch curve is sharper than the roller, so that the profile has a cusp.

        The ends of the arcs are bracketed to 1e-9 deg.
        """
        return self._sharper_than_roller(1)

    @cached_property
    def outer_undercuts(self) -> tuple[Undercut, ...]:
        """Where the far flank of a groove has a cusp: its pitch curve is too hollow."""
        return self._sharper_than_roller(-1)

    @checked
    def cut_away(self, *, outer: bool = False) -> list[Arc]:
        """Return the arcs over which the cutter has taken the profile away elsewhere in the turn.

        There the roller cannot be where it should: the profile's point lies inside the roller at
        another cam angle. An undercut is the nearest case of it; a hollow between two lobes that is
        narrower than the roller is another. Sampled each 0.05 deg; less than 1e-3 mm is rounding.

        >>> import cammotion as cm
        >>> cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(10), prime_radius_mm=25)
        >>> cam.undercuts, cam.cut_away()
        ((), [])
        """
        from scipy.spatial import cKDTree  # it takes a second to load, and 40 MB

        angles = np.arange(0, DEG_PER_TURN, _FINE_DEG)
        tree = cKDTree(self.pitch_mm(angles))
        nearest, _ = tree.query(self.profile_mm(angles, outer=outer))
        gone = nearest < self.roller_radius_mm - _SEEN_MM
        return arcs(
            (angle - _FINE_DEG / 2, angle + _FINE_DEG / 2) for angle in angles[gone].tolist()
        )

    def _sharper_than_roller(self, side: int) -> tuple[Undercut, ...]:
        def excess(piece: Piece, at: Floats) -> Floats:
            bent = side * self._curvature(lift_of(self.motion, piece, at))
            return bent * self.roller_radius_mm - 1 - _SHARP

        return undercuts_of(
            excess,
            self.motion.curve.pieces,
            lambda worst: self.roller_radius_mm - self.roller_radius_mm / (worst + 1),
        )

    def _pressure(self, lift: Lift) -> Floats:
        return pressure_angle(self.follower, lift, self.prime_radius_mm)

    def _curvature(self, lift: Lift) -> Floats:
        return curvature(self.follower, lift, self.prime_radius_mm)


def _floored(length_mm: float) -> float:
    """Return a length with a thousandth of a mm, or four digits if it is small, but no longer."""
    scale = 10.0 ** max(3, 3 - math.floor(math.log10(length_mm)))
    return math.floor(scale * length_mm) / scale
