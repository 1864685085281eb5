"""What every disc cam is: a motion that it gives, a profile, and where that is undercut.

The cam turns clockwise under its follower. Points of the cam are in mm about its axis, as it lies
at 0 deg of cam angle, x to the right and y up. The profile is the envelope of all places of the
roller or the face as the cam sees them: it is exact, and no base circle plus displacement.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from numpy.typing import ArrayLike

from cammotion.bracketed import Extreme, Function, largest, where_positive
from cammotion.hardware.envelope import Lift
from cammotion.laws.piece import Piece
from cammotion.machine.arcs import unwrap
from cammotion.machine.kinematics import DEG_PER_TURN, into_turn
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE
from cammotion.quantities import Floats, InputError, Numbers, as_text

PER_RAD = math.degrees(1.0)  # a slope in mm/deg becomes one in mm/rad


@dataclass(frozen=True)
class Undercut:
    """An arc over which a profile is cut away, because its radius of curvature would be below 0.

    `start_deg` and `end_deg` are cam angles, the end above 360 where it runs on into the next turn;
    `worst_deg` is where most is missing, and `missing_mm` how much the radius is short of 0 there.
    """

    start_deg: float
    end_deg: float
    worst_deg: float
    missing_mm: float

    def __str__(self) -> str:
        missing = as_text(self.missing_mm, ".4g")
        return (
            f"the profile is undercut from {self.start_deg:.5g} to {self.end_deg:.5g} deg: at "
            f"{self.worst_deg:.5g} deg its radius of curvature would be -{missing} mm"
        )


class DiscCam(ABC):
    """What a cam is, whatever its follower; RollerCam and FlatFacedCam are those that there are."""

    motion: Motion

    @abstractmethod
    def profile_mm(self, angle_deg: ArrayLike) -> Floats:
        """Return the points (x, y) in mm that touch the follower, in an array (..., 2)."""

    @abstractmethod
    def profile_radius_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return the profile's radius of curvature in mm; below 0: hollow or undercut."""

    @property
    @abstractmethod
    def undercuts(self) -> tuple[Undercut, ...]:
        """Where the profile is undercut, in order; empty for a cam that can be made."""

    @property
    @abstractmethod
    def sharpest(self) -> Extreme:
        """The least radius of curvature in mm of the curve that leads the follower, and where.

        That is the pitch curve, of a roller's centre, and the profile for a flat face.
        """

    def lift(self, angle_deg: ArrayLike) -> Lift:
        """Return the displacement from the lowest position and two derivatives by the rad.

        Where two segments meet, they are those of the one that begins there.
        """
        return Lift(*self.derivatives(angle_deg, 3))

    def derivatives(self, angle_deg: ArrayLike, count: int) -> list[Floats]:
        """Return the first so many of what `lift` returns."""
        start, curve = self.motion.start_deg, self.motion.curve
        phase = curve.begun(into_turn(CAM_ANGLE.array(angle_deg), start)[1])
        first, *others = (
            curve.derived(order)(phase, "right") * PER_RAD**order for order in range(count)
        )
        return [first - self.motion.range_mm[0], *others]

    def _largest(self, of: Callable[[Lift], Floats]) -> Extreme:
        """Return the largest value over the turn of what the lift says, and where it is."""
        pieces = self.motion.curve.pieces
        return largest(lambda piece, at: of(lift_of(self.motion, piece, at)), pieces)


def lift_of(motion: Motion, piece: Piece, places: Floats) -> Lift:
    """Return displacement and derivatives from one piece of a motion, at both its ends too."""
    slope = piece.derivative
    values = (part.over(places.copy()) for part in (piece, slope, slope.derivative))
    lift, first, second = values
    return Lift(lift - motion.range_mm[0], first * PER_RAD, second * PER_RAD**2)


def travel_mm(motion: Motion) -> float:
    """Return how far a motion goes, in mm."""
    low, high = motion.range_mm
    return high - low


def check_motion(motion: Motion) -> None:
    """Raise InputError for a motion that no disc cam can give."""
    if motion.is_indexing:
        raise InputError(
            f"The motion '{motion.name}' moves on from stop to stop, and a disc cam brings its "
            "follower back in each turn: an indexing motion is cut as a barrel, globoidal or "
            "parallel index cam."
        )
    if jumps := motion.steps(1):
        raise InputError(
            f"The velocity of the motion '{motion.name}' jumps at {jumps[0][0]:g} deg, so that its "
            "cam would have a corner: give moves whose velocities meet, for example from rest to "
            "rest."
        )


def undercuts_of(
    excess: Function, pieces: Sequence[Piece], missing: Callable[[float], float]
) -> tuple[Undercut, ...]:
    """Return the arcs over which `excess` is above 0; `missing` says how much at the worst."""
    found = []
    for start, end in unwrap(where_positive(excess, pieces)):
        inside = [part for piece in pieces for part in _inside(piece, start, end)]
        worst = largest(excess, inside)
        found.append(Undercut(start, end, worst.at_deg, missing(worst.value)))
    return tuple(found)


def _inside(piece: Piece, start: float, end: float) -> Iterator[Piece]:
    """Yield what of a piece lies in an arc, whatever turn its own angles are of."""
    first, last = ((at - start) // DEG_PER_TURN for at in (piece.low, piece.high))
    for turn in range(int(first) - 1, int(last) + 1):
        back = turn * DEG_PER_TURN
        low, high = max(piece.low, start + back), min(piece.high, end + back)
        if low < high:
            yield piece.restricted(low, high)
