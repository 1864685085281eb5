"""The force between a follower and its cam, and the spring that keeps them together."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.bracketed import Extreme, Function, largest, where_positive
from cammotion.dynamics.forcing import check_velocity
from cammotion.laws.piece import Piece
from cammotion.machine.arcs import Arc
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, RATE, cycle_time
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Numbers, Quantity, keep_numbers, plain

MASS = Quantity("mass of the follower", "kg", example=12)
STIFFNESS = Quantity("stiffness of the spring", "N/mm", example=5, low_included=True)
PRELOAD = Quantity("preload of the spring", "N", example=100, low_included=True)
LIFT = Quantity("height over the lowest position", "mm", example=10, low=-math.inf)
WEIGHT = Quantity("weight on the cam", "N", example=117.7, low=-math.inf)

_LEAST = 1e-12  # of what presses at most: less is nothing, where only rounding pulls


@dataclass(frozen=True, kw_only=True)
class FollowerLoad:
    """What presses a rigid follower on its cam, in the direction of its motion.

    `mass_kg` moves with the follower. The spring has `preload_N` at the motion's lowest position
    and gains `stiffness_N_per_mm` for each mm. `weight_N` is the part of the weight that presses on
    the cam: 9.81 times the mass for a follower above its cam, the negative for one that hangs.
    Friction and the force of the process are left out. Raises InputError for a mass that is not
    above 0, and a stiffness or preload below 0; and, asked about a motion that moves on from stop
    to stop, for a spring that would have to go with it.

    >>> import cammotion as cm
    >>> load = FollowerLoad(mass_kg=12)
    >>> least = load.least_force(cm.EXAMPLE.die, 2000)
    >>> print(f"{least.value:.2f} N at {least.at_deg:.2f} deg")
    -49.85 N at 191.25 deg
    """

    mass_kg: float
    stiffness_N_per_mm: float = 0.0  # noqa: N815 - newton
    preload_N: float = 0.0  # noqa: N815
    weight_N: float = 0.0  # noqa: N815

    def __post_init__(self) -> None:
        keep_numbers(
            self,
            mass_kg=MASS.number,
            stiffness_N_per_mm=STIFFNESS.number,
            preload_N=PRELOAD.number,
            weight_N=WEIGHT.number,
        )

    @checked
    def force_N(self, motion: Motion, angle_deg: ArrayLike, rate_per_hour: float) -> Numbers:  # noqa: N802
        """Return the force in N between follower and cam at a cam angle; below 0 it has left it."""
        check_spring(self, motion)
        lift = np.asarray(motion.position_mm(angle_deg)) - motion.range_mm[0]
        push = self.mass_kg * motion.derivative(2, angle_deg, rate_per_hour)
        return plain(push + self._standing(lift))

    def standing_N(self, lift_mm: Numbers) -> Numbers:  # noqa: N802
        """Return the force in N of spring and weight at a height in mm over the lowest position.

        >>> FollowerLoad(mass_kg=2, stiffness_N_per_mm=5, preload_N=100).standing_N(10)
        150.0
        """
        return plain(self._standing(LIFT.array(lift_mm)))

    @checked
    def where_loose(self, motion: Motion, rate_per_hour: float) -> list[Arc]:
        """Return the arcs of the turn, in deg, over which spring and weight are too weak at a rate.

        There the force on a follower that stayed on the cam would be below 0. The ends are
        bracketed to 1e-9 deg. Raises InputError for a motion whose velocity jumps, here and below:
        there the force has no bound.

        >>> import cammotion as cm
        >>> load = FollowerLoad(mass_kg=12, preload_N=10)
        >>> for start, end in load.where_loose(cm.EXAMPLE.die, 2000):
        ...     print(f"{start:.2f} to {end:.2f} deg")
        179.27 to 203.23 deg
        306.77 to 330.73 deg
        """
        return where_positive(self._lack(motion, rate_per_hour), motion.curve.pieces)

    @checked
    def least_force(self, motion: Motion, rate_per_hour: float) -> Extreme:
        """Return the least force in N between follower and cam in a turn, and where it is."""
        found = largest(self._lack(motion, rate_per_hour), motion.curve.pieces)
        return Extreme(-found.value, found.at_deg)

    @checked
    def needed_preload_N(self, motion: Motion, rate_per_hour: float) -> float:  # noqa: N802
        """Return the least preload in N with which the follower stays on the cam at a rate.

        A spring of this stiffness has to have it at the motion's lowest position. What follows the
        springs and the gap between parts ask for is not in it: a margin of a half is usual.
        """
        return max(self.preload_N - self.least_force(motion, rate_per_hour).value, 0.0)

    @checked
    def lift_off_rate(self, motion: Motion) -> float:
        """Return the machine rate in pieces/h above which the follower leaves the cam.

        It is infinite where nothing pulls the follower off, and 0 where it does not even rest on
        the cam.
        """

        def pull(piece: Piece, places: Floats) -> Floats:
            return np.maximum(-self._inertia(1.0) * _bend(piece, places), 0.0)

        def share(piece: Piece, places: Floats) -> Floats:
            standing = self._standing_at(motion, piece, places)
            return np.asarray(pull(piece, places) / np.maximum(standing, _LEAST * most))

        self._check(motion)
        low, high = motion.range_mm
        least, most = self._standing(np.array([0.0, high - low]))  # it grows with the height
        if least < 0:
            return 0.0
        pieces = motion.curve.pieces
        if largest(pull, pieces).value <= 0:
            return math.inf
        return 1 / math.sqrt(largest(share, pieces).value) if most > 0 else 0.0

    def _check(self, motion: Motion) -> None:
        check_velocity(motion)
        check_spring(self, motion)

    def _standing(self, lift_mm: Floats) -> Floats:
        return np.asarray(self.stiffness_N_per_mm * lift_mm + self.preload_N + self.weight_N)

    def _lack(self, motion: Motion, rate_per_hour: float) -> Function:
        """Return the force in N that is lacking to stay on the cam, below 0 where there is one."""
        self._check(motion)
        per_deg = self._inertia(rate_per_hour)

        def lack(piece: Piece, places: Floats) -> Floats:
            return -(per_deg * _bend(piece, places) + self._standing_at(motion, piece, places))

        return lack

    def _inertia(self, rate_per_hour: float) -> float:
        """Return the force in N that a second derivative of 1 mm/deg² asks for at a rate."""
        per_second = DEG_PER_TURN / cycle_time(RATE.number(rate_per_hour))
        return float(self.mass_kg * per_second**2 / MM_PER_M)

    def _standing_at(self, motion: Motion, piece: Piece, places: Floats) -> Floats:
        return self._standing(piece.over(places.copy()) - motion.range_mm[0])


def check_spring(load: FollowerLoad, motion: Motion) -> None:
    """Raise InputError for a spring on a motion that does not come back."""
    if motion.is_indexing and load.stiffness_N_per_mm:
        raise InputError(
            f"The motion {motion.name!r} moves on from stop to stop, and no spring goes with it: "
            "give its load without stiffness_N_per_mm."
        )


def _bend(piece: Piece, places: Floats) -> Floats:
    return piece.derivative.derivative.over(places.copy())
