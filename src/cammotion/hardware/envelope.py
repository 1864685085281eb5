"""The geometry of a roller on a cam: how the cam sees and pushes it, and how its path bends.

Complex numbers in mm about the cam's axis, in the machine's frame. Seen from the cam, which turns
clockwise, everything is turned counterclockwise by the cam angle.
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from cammotion.hardware.followers import Places, RollerFollower
from cammotion.quantities import Floats


class Lift(NamedTuple):
    """The displacement in mm from the lowest position, and two derivatives by the cam angle.

    The derivatives are in mm/rad and mm/rad².
    """

    lift: Floats
    slope: Floats
    bend: Floats


def pitch_tangent(
    follower: RollerFollower, lift: Floats, slope: Floats, prime: Any
) -> tuple[Places, Places]:
    """Return the pitch curve and its derivative by the rad, before the cam's turn.

    `prime` is the radius of the prime circle in mm, a number or an array.
    """
    place, way, _ = follower.place(lift, prime)
    return place, way * slope + 1j * place


def pressure_angle(follower: RollerFollower, lift: Lift, prime: Any) -> Floats:
    """Return the angle in deg from the normal of the pitch curve to the follower's way."""
    _, way, _ = follower.place(lift.lift, prime)
    _, tangent = pitch_tangent(follower, lift.lift, lift.slope, prime)
    return np.degrees(np.angle(1j * way / tangent))


def curvature(follower: RollerFollower, lift: Lift, prime: Any) -> Floats:
    """Return the curvature of the pitch curve in 1/mm, above 0 where it bulges outwards."""
    place, way, turn = follower.place(lift.lift, prime)
    first, second = way * lift.slope, way * lift.bend + turn * lift.slope**2
    tangent, bend = first + 1j * place, second + 2j * first - place
    return np.asarray((tangent.conj() * bend).imag / np.abs(tangent) ** 3)


def points(place: NDArray[np.complexfloating], angle_deg: ArrayLike) -> Floats:
    """Return places as the cam at 0 deg has them, as points (x, y) in an array (..., 2)."""
    seen = place * np.exp(1j * np.radians(np.asarray(angle_deg, dtype=float)))
    return np.stack([seen.real, seen.imag], axis=-1)
