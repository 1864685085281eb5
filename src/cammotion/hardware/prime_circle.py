"""The smallest cam for a motion: prime circle, or base circle of a flat face, solved for."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import Any

import numpy as np

from cammotion.arguments import checked
from cammotion.bracketed import samples, summit
from cammotion.hardware.disc_cam import check_motion, lift_of, travel_mm
from cammotion.hardware.envelope import Lift, curvature, pressure_angle
from cammotion.hardware.flat_faced_cam import FlatFacedCam
from cammotion.hardware.followers import RollerFollower
from cammotion.hardware.roller_cam import RollerCam
from cammotion.laws.piece import Piece
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity, WrongAnswerError

STEEPEST = Quantity("pressure angle", "deg", example=30, high=90)
SHARPEST = Quantity("least radius of the profile", "mm", example=2, low_included=True)

_RADII = 64  # prime circles that are tried between the least and the largest
_HALVINGS = 36
_ROUNDS = 30  # of the worst place and the least radius there, by turns
_ENOUGH = 1e-11  # a share of the pressure angle, or of the curvature, that is rounding
_CLOSE_MM = 1e-11
_CUT_HALVINGS = 14  # what cut_away sees is no finer
_AROUND_DEG = np.arange(0, DEG_PER_TURN, 0.1)


@checked
def smallest_prime_radius(
    motion: Motion,
    follower: RollerFollower,
    *,
    pressure_angle_deg: float = 30,
    profile_radius_mm: float = 0,
) -> float:
    """Return the radius in mm of the smallest prime circle for a motion, solved for.

    With it the pressure angle is nowhere larger than `pressure_angle_deg`, and the profile, where
    it bulges outwards, has at least `profile_radius_mm` of radius, so that it is nowhere undercut;
    and nothing of it is cut away elsewhere in the turn, as `RollerCam.cut_away` says, which large
    pressure angles and narrow hollows bring about. Of a slide, a pressure angle of 90 asks for the
    last two alone. The usual rules are 30 deg for a slide, and for the pitch curve a radius of two
    to three times the roller's. What lies between two of 64 prime circles that are tried, and is
    good in between alone, is missed.

    Raises InputError for a motion that no disc cam can give, and where no prime circle will do.

    >>> import cammotion as cm
    >>> after = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram["die"]
    >>> for die in (cm.EXAMPLE.die, after):
    ...     print(f"{smallest_prime_radius(die, cm.TranslatingRoller(10)):.2f} mm")
    156.84 mm
    57.64 mm
    """
    check_motion(motion)
    steepest = STEEPEST.number(pressure_angle_deg)
    sharpest = follower.radius_mm + SHARPEST.number(profile_radius_mm)
    asked = _Asked(motion, follower, steepest, sharpest)
    return asked.not_cut_away(asked.solved())


@checked
def smallest_base_radius(motion: Motion, *, profile_radius_mm: float = 0) -> float:
    """Return the radius in mm of the smallest base circle of a cam with a flat face, solved for.

    With it the profile has at least `profile_radius_mm` of radius everywhere, so that it is not
    undercut: it is that less the least sum of the displacement and its second derivative by the
    rad, or 0 where this is not above 0 and every base circle will do. Raises InputError for a
    motion that no disc cam can give.

    >>> import cammotion as cm
    >>> print(f"{smallest_base_radius(cm.EXAMPLE.die):.2f} mm")
    295.57 mm
    """
    wanted = SHARPEST.number(profile_radius_mm)
    unit = FlatFacedCam(motion, base_radius_mm=1.0)
    return max(wanted + unit.base_radius_mm - unit.sharpest.value, 0.0)


@dataclass(frozen=True)
class _Asked:
    """What is asked of a prime circle."""

    motion: Motion
    follower: RollerFollower
    steepest_deg: float
    sharpest_mm: float

    def solved(self) -> float:
        """Return the least radius that is good all over the turn.

        It is found among samples of the turn first, and then by turns: where is this prime circle
        worst, and which is the next that is good there?
        """
        from scipy.optimize import brentq  # it takes a second to load, and 40 MB

        radius, step = self._among_samples()
        for _ in range(_ROUNDS):
            (worst, place), piece = self._worst(radius)
            if worst <= _ENOUGH:
                return radius
            excess = partial(self._excess_at, piece, place)
            beyond = next((b for b in self._wider(radius, step) if excess(b) < 0), None)
            if beyond is None:
                raise InputError(self._impossible(radius))
            radius = brentq(excess, radius, beyond, xtol=_CLOSE_MM) + 2 * _CLOSE_MM
        raise WrongAnswerError(
            "smallest_prime_radius", f"at {place:g} deg {radius:g} mm is off by {worst:.2g} of it"
        )

    def not_cut_away(self, radius: float) -> float:
        """Return a good radius, or the next one with which nothing is cut away elsewhere."""
        if self._is_left(radius):
            return radius
        low = radius
        for high in self._wider(radius, radius / _RADII):
            if self._is_left(high) and self._worst(high)[0][0] <= _ENOUGH:
                return self._between(low, float(high))
            low = float(high)
        raise InputError(
            f"With no prime circle of this follower the roller reaches all of its profile; with "
            f"that of {radius:.5g} mm some of it is cut away, as RollerCam.cut_away says. Give the "
            "moves more angle or less stroke, or take a smaller roller."
        )

    def _between(self, low: float, high: float) -> float:
        """Return the least radius that will do between one that will not and one that will."""
        for _ in range(_CUT_HALVINGS):
            middle = (low + high) / 2
            will_do = self._is_left(middle) and self._worst(middle)[0][0] <= _ENOUGH
            low, high = (low, middle) if will_do else (middle, high)
        return high

    def _is_left(self, radius: float) -> bool:
        """Tell whether all of the profile is left; one that goes round evenly does not cross."""
        cam = RollerCam(self.motion, self.follower, float(radius))
        points = cam.profile_mm(_AROUND_DEG) @ np.array([1, 1j])
        turned = np.angle(np.roll(points, -1) / points)
        return bool(np.all(turned > 0) or np.all(turned < 0)) or not cam.cut_away()

    def _worst(self, radius: float) -> tuple[Any, Piece]:
        return summit(partial(self._excess_of, prime=radius), self._pieces)

    def _wider(self, radius: float, step: float) -> Floats:
        """Return larger radii, first by steps that double, of an arm also evenly to its largest."""
        wider = radius + step * 2.0 ** np.arange(60)
        high = self._limits[1]
        if math.isfinite(high):
            wider = np.union1d(wider[wider < high], np.linspace(radius, high, _RADII)[1:-1])
        return np.asarray(wider)

    def _among_samples(self) -> tuple[float, float]:
        """Return the least radius that is good at samples, and how finely it is known."""
        lifts = [lift_of(self.motion, piece, samples(piece)) for piece in self._pieces]
        lift = Lift(*map(np.concatenate, zip(*lifts, strict=True)))
        radii = self._radii(lift)
        worst = np.array([self._excess(lift, radius).max() for radius in radii])
        good = np.flatnonzero(worst <= 0)
        if not good.size:
            raise InputError(self._impossible(float(radii[worst.argmin()])))
        high = low = radii[good[0]]
        if good[0]:
            low = radii[good[0] - 1]
            for _ in range(_HALVINGS):
                middle = (low + high) / 2
                is_good = self._excess(lift, middle).max() <= 0
                low, high = (low, middle) if is_good else (middle, high)
        return float(high), float(max(high - low, _CLOSE_MM))

    def _radii(self, lift: Lift) -> Floats:
        """Return radii from the least to one that is surely large enough, or the largest there is.

        The pressure angle of a slide falls with the radius. Its pitch curve is flat enough where
        the height over the axis is more than the sum below.
        """
        low, high = self._limits
        low = max(low, self.follower.radius_mm)
        if math.isinf(high):
            beside = np.abs(lift.slope).max() + low
            flat = self.sharpest_mm + np.abs(lift.bend).max() + 3 * beside
            high = low + flat + beside / math.tan(math.radians(self.steepest_deg))
        inside = _CLOSE_MM * (high - low)
        return np.geomspace(low + inside, high - inside, _RADII)

    def _impossible(self, best_mm: float) -> str:
        return (
            f"No prime circle of this follower keeps the pressure angle within "
            f"{self.steepest_deg:g} deg and the pitch curve's radius over {self.sharpest_mm:g} mm; "
            f"the nearest to it has {best_mm:.5g} mm. Give the moves more angle or less stroke, "
            "the follower another pivot or a longer arm, or take a smaller roller."
        )

    def _excess(self, lift: Lift, prime: Any) -> Floats:
        """Return by which share more than is allowed is asked, of whichever is worse."""
        steep = np.abs(pressure_angle(self.follower, lift, prime)) / self.steepest_deg
        sharp = curvature(self.follower, lift, prime) * self.sharpest_mm
        return np.asarray(np.maximum(steep, sharp) - 1)

    def _excess_of(self, piece: Piece, places: Floats, prime: float) -> Floats:
        return self._excess(lift_of(self.motion, piece, places), prime)

    def _excess_at(self, piece: Piece, place: float, prime: float) -> float:
        return float(self._excess_of(piece, np.array([place]), prime)[0])

    @cached_property
    def _limits(self) -> tuple[float, float]:
        """Between which radii in mm the follower can have a prime circle."""
        return self.follower.primes(travel_mm(self.motion))

    @property
    def _pieces(self) -> Sequence[Piece]:
        return self.motion.curve.pieces
