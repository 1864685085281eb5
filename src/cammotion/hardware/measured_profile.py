"""From points of a profile back to the lift of its follower: the inverse of a disc cam.

A probe of some radius has gone round the cam. Beside the curve of its centres, farther out by what
the roller's radius is larger, lies the pitch curve; where a point of that is in the follower's way
says both the lift and the cam angle. For a flat face it is the normal that says the angle, and how
far out along it the profile reaches.
"""

import math
from dataclasses import dataclass
from itertools import takewhile

import numpy as np
from numpy.typing import ArrayLike

from cammotion.alike import Alike
from cammotion.arguments import checked
from cammotion.hardware.followers import Places, RollerFollower, SwingingRoller, TranslatingRoller
from cammotion.hardware.traced_profile import Traced
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats, InputError, Quantity, as_text, shorten

PROBE = Quantity("radius of the probe", "mm", example=2, low_included=True)
POINT = Quantity("coordinate of a point of the profile", "mm", example=50, low=-1e5, high=1e5)
COUNT = Quantity("count of angles", "", example=360, low=8, high=1e5, low_included=True)

_FLAT = "flat face"
_FEWEST = 36
_WIDEST_DEG = 12.0  # between two points, as seen from the axis
_SAME_RAD = 1e-9  # so far from the first point to the last a turn is not exceeded
_ON = 0.1  # of a step: so near to the polygon of points, another one is on their curve
_NOISE, _ROUNDING = 10.0, 3e-5  # times the noise, and of the size: so far off an answer may be


@dataclass(frozen=True, eq=False)
class ProfileLift(Alike):
    """The lift that a measured profile gives its follower.

    `angle_deg` are even cam angles in deg from 0 up to 360, without it, and `position_mm` the
    positions in mm there, from the lowest: `CamTable(lift.angle_deg, lift.position_mm,
    is_cycle=True)` is their table. `prime_radius_mm` is the radius of the prime circle in mm, or
    of the base circle of a flat face.

    `off_mm` is by how much, at most, a follower put there misses the curve through the points or
    cuts into it, in mm. It says how well that curve was followed, and not how far the lift is off
    the cam: the curve has the noise of the points in it, and so has the lift, with an `off_mm` that
    may be far less.

    The lowest position is taken as 0, and noise lowers it, where a cam dwells at the bottom by some
    two to three times its root mean square: the whole lift is too high, and `prime_radius_mm` too
    small, by about so much. The median of `position_mm` over that dwell is how much it is.
    """

    angle_deg: Floats
    position_mm: Floats
    prime_radius_mm: float
    off_mm: float

    def __repr__(self) -> str:
        lift = f"{self.angle_deg.size} angles, up to {as_text(self.position_mm.max(), '.4g')} mm"
        circle = f"over a circle of {as_text(self.prime_radius_mm, '.4g')} mm"
        return f"ProfileLift({lift} {circle}, within {self.off_mm:.2g} mm of the points)"


@checked
def lift_from_profile(  # noqa: PLR0913 - what is known of a measurement
    x_mm: ArrayLike,
    y_mm: ArrayLike,
    *,
    follower: RollerFollower | str,
    probe_radius_mm: float = 0.0,
    clockwise: bool = True,
    count: int = 360,
) -> ProfileLift:
    """Return the lift that a measured disc cam gives its follower, at even cam angles.

    `x_mm` and `y_mm` are the centres of a probe of radius `probe_radius_mm`, or points of the
    surface if that is 0, in order once round the cam either way, in mm about its axis as it lies at
    0 deg of cam angle, y up to the follower. At least 36 are needed, and they may be unevenly
    spaced. `follower` is a TranslatingRoller, a SwingingRoller or "flat face". The cam turns
    `clockwise` under it, as those of the package do, or the other way; the pivot of an arm stays on
    the right. `count` is how many even angles are asked for.

    Exact but for what a curve through the points leaves open between them; noise is not smoothed
    away, and lowers what is taken as 0, as ProfileLift says. Raises InputError for points that are
    not once round the axis, for a hollow into which the probe or the follower does not reach, for a
    probe so large that nothing is left of the cam, and for steps so uneven that noise would sway
    the curve over a long one by ten times as much; a place of the cam is told by the cam angle at
    which it is above the axis.

    >>> import cammotion as cm
    >>> cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(10), prime_radius_mm=160)
    >>> x, y = cam.cutter_mm(np.arange(0, 360, 0.5), 2).T  # the centres of a probe of 2 mm
    >>> lift = lift_from_profile(x, y, follower=cam.follower, probe_radius_mm=2)
    >>> off = lift.position_mm - cam.motion.position_mm(lift.angle_deg)
    >>> print(f"{lift.prime_radius_mm:.3f} mm, {np.abs(off).max() < 1e-4}")
    160.000 mm, True
    """
    radius = PROBE.number(probe_radius_mm)
    if isinstance(follower, TranslatingRoller | SwingingRoller):
        away = follower.radius_mm - radius
    elif isinstance(follower, str) and follower.casefold() == _FLAT:
        follower, away = _FLAT, -radius
    else:
        raise InputError(
            f"The follower is {shorten(follower)}: give a TranslatingRoller, a SwingingRoller or "
            f"{_FLAT!r}."
        )
    places, way = COUNT.whole(count), 1
    if not clockwise and isinstance(follower, SwingingRoller):  # its pivot stays on the right
        clockwise, way = True, -1
    traced = Traced(_checked(x_mm, y_mm, clockwise=clockwise), away, follower, way)
    allowed = _NOISE * traced.noise_mm + _ROUNDING * traced.size_mm
    traced.refuse_gaps(allowed)
    traced.refuse_kinks()
    traced.refuse_strays()
    degrees = np.arange(places, dtype=np.float64) * (DEG_PER_TURN / places)
    answers = [*traced.answers(np.radians(way * degrees))]
    if not answers:
        traced.refuse_turning_back()
    off, position = min(answers, key=lambda each: each[0])
    if off > allowed:
        traced.refuse_cut(off)
    lowest = float(position.min())
    circle = traced.prime_of(lowest)
    _check_circle(circle, radius, 0.0 if isinstance(follower, str) else follower.radius_mm)
    return ProfileLift(degrees, position - lowest, circle, off)


def _check_circle(circle_mm: float, probe_mm: float, roller_mm: float) -> None:
    """Raise InputError where the probe is so large that nothing is left of the cam."""
    cam = circle_mm - roller_mm
    if cam <= _ROUNDING * probe_mm:
        raise InputError(
            f"A probe of {probe_mm:g} mm on these points leaves a cam whose radius would be "
            f"{as_text(cam, '.4g')} mm at its lowest: give the centres of the probe about the axis "
            "of the cam, and its radius."
        )


def _checked(x_mm: ArrayLike, y_mm: ArrayLike, *, clockwise: bool) -> Places:
    """Return the points in order against the clock, of a cam that turns clockwise."""
    x, y = POINT.array(x_mm), POINT.array(y_mm)
    if x.ndim != 1 or x.shape != y.shape:
        raise InputError(
            f"The points of the profile are arrays of shape {x.shape} in x and {y.shape} in y: "
            "give two lists of the same length."
        )
    points = x + 1j * y
    size = float(np.abs(points).max())
    if abs(points[-1] - points[0]) <= 1e-9 * size:  # the first point once more
        points = points[:-1]
    if len(points) < _FEWEST:
        raise InputError(
            f"The profile has {len(points)} points; at least {_FEWEST} are needed: measure more."
        )
    ends = np.append(points, points[0])
    same = np.flatnonzero(np.abs(np.diff(ends)) <= 1e-9 * size)
    if same.size:
        raise _twice(same[0], (same[0] + 1) % len(points))
    _check_round(points, ends)
    _, first, which = np.unique(points, return_index=True, return_inverse=True)
    again = np.flatnonzero(first[which] < np.arange(len(points)))
    if again.size:
        raise _twice(first[which[again[0]]], again[0])
    area = (ends[:-1].conj() * ends[1:]).imag.sum()
    if not clockwise:
        points, area = -points.conj(), -area
    return points if area > 0 else points[::-1]


def _twice(first: int, second: int) -> InputError:
    return InputError(
        f"The points of the profile at positions {first} and {second} are one: give each point "
        "once."
    )


def _check_round(points: Places, ends: Places) -> None:
    """Raise InputError unless the points go once round the axis, without a gap or an overlap."""
    if np.abs(points).min() > 0:
        turned = np.angle(ends[1:] / ends[:-1])
        turns = round(abs(float(turned.sum())) / (2 * math.pi))
    else:
        turned, turns = np.zeros(1), 0
    if turns != 1:
        raise InputError(
            f"The points of the profile go {turns} times round the axis, and a disc cam goes once "
            "round it: give x and y about the axis, in order, and each point once."
        )
    passed = float(turned[:-1].sum()) * np.sign(turned.sum()) - 2 * math.pi
    again = _again(points) if passed > _SAME_RAD else 0
    if again:
        last = f"last {again} points of the profile go" if again > 1 else "last point goes"
        raise InputError(
            f"The {last} over the first ones again: leave {'them' if again > 1 else 'it'} out."
        )
    worst = int(np.abs(turned).argmax())
    if math.degrees(abs(turned[worst])) > _WIDEST_DEG:
        raise InputError(
            f"The points of the profile leave {math.degrees(abs(turned[worst])):.3g} deg out after "
            f"position {worst}, as seen from the axis: measure there too, or put them in order."
        )


def _again(points: Places) -> int:
    """Return how many of the last points lie on the polygon of the first ones, beyond its start.

    Where a flank turns back, as seen from the axis, the last points pass the first one beside it.
    """
    starts, steps = points[: len(points) // 2], np.diff(points[: len(points) // 2 + 1])
    lengths = np.abs(steps)
    near = _ON * np.maximum(lengths, np.median(lengths))

    def is_over(point: complex) -> bool:
        shares = ((point - starts) / steps).real.clip(0, 1)
        off = np.abs(point - starts - shares * steps)
        return bool((off < near).any() and off.min() <= (1 - _SAME_RAD) * abs(point - points[0]))

    return sum(1 for _ in takewhile(is_over, points[::-1]))
