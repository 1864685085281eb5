"""The quickest move from rest to rest that keeps limits of velocity, acceleration and jerk.

The acceleration rises with the largest jerk, stays, falls, and so does its mirror image, with a
part at the largest velocity between the two: seven segments, some of which may be missing. With tj
the time in which the acceleration rises and ta that until the largest velocity,

    v = a (ta - tj),   a = j tj,   hm = v (ta + tv),   tm = 2 ta + tv,

and each is as large as its limit lets it be, the velocity first.
"""

import math
from typing import NamedTuple

from cammotion.arguments import checked
from cammotion.laws.curve import mirrored
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.series import Series
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, RATE, STROKE, Move, cycle_time
from cammotion.quantities import InputError, Quantity, WrongAnswerError

_VELOCITY = Quantity("largest velocity", "m/s", example=0.5)
_ACCELERATION = Quantity("largest acceleration", "m/s2", example=4)
_JERK = Quantity("largest jerk", "m/s3", example=200)
_SAME = 1e-9  # by such a share a peak may pass its limit, and so short a segment is none
_BELOW = 1 - 1e-4  # of a rate that is said in five digits, so that they are not too many
_LEAST = 1e-6  # of its time, for which the move at least speeds up, and its acceleration rises


class _Times(NamedTuple):
    """How long in s the acceleration rises, until the velocity is largest, and how long it is."""

    rising: float
    speeding: float
    even: float

    @property
    def total(self) -> float:
        """How long the whole move takes."""
        return 2 * self.speeding + self.even


@checked
def quickest_move(
    stroke_mm: float,
    *,
    acceleration_m_per_s2: float,
    velocity_m_per_s: float = math.inf,
    jerk_m_per_s3: float = math.inf,
    rate_per_hour: float,
) -> Move:
    """Return the move over a stroke that takes the least time with these limits, from rest to rest.

    The limits are the largest acceleration, velocity and jerk; what is left out is not limited.
    `rate_per_hour` is the machine rate, at which the move's `angle_deg` is the least that a cam
    needs; its `law` is a motion law like any other. No motion from rest to rest is quicker with
    these limits. Raises InputError for limits that are not above 0, and where a turn is too short
    for the move.

    >>> import cammotion as cm
    >>> move = quickest_move(50, acceleration_m_per_s2=4, jerk_m_per_s3=200, rate_per_hour=2000)
    >>> print(f"{move.time_s:.4f} s, {move.angle_deg:.2f} deg, Ca = {move.law.Ca:.3f}")
    0.2445 s, 48.90 deg, Ca = 4.782
    >>> rise = cm.rise(move.stroke_mm, over_deg=move.angle_deg, law=move.law)
    """
    stroke_mm = STROKE.number(stroke_mm)
    stroke = stroke_mm / MM_PER_M
    v, j = limit_of(_VELOCITY, velocity_m_per_s), limit_of(_JERK, jerk_m_per_s3)
    a = _ACCELERATION.number(acceleration_m_per_s2)
    times = _times(stroke, v, a, j)
    if times.speeding < _LEAST * times.total:
        raise InputError(
            f"The largest acceleration is {a:g} m/s2, with which the move speeds up for less than "
            f"a millionth of its time: give a smaller one, for example "
            f"{0.9 * v**2 / (_LEAST * stroke):.3g} m/s2."
        )
    if 0 < times.rising < _LEAST * times.total:
        raise InputError(
            f"The largest jerk is {j:g} m/s3, which the move needs for less than a millionth of "
            "its time: leave it out, and it is not limited."
        )
    rate = RATE.number(rate_per_hour)
    turn = float(cycle_time(rate))
    if times.total > turn:
        raise InputError(
            f"The quickest move of {stroke_mm:g} mm takes {times.total:.4g} s, and a turn at "
            f"{rate:g} pieces/h only {turn:.4g} s: allow more, or run at most "
            f"{_BELOW * rate * turn / times.total:.5g} pieces/h."
        )
    angle = DEG_PER_TURN * times.total / turn
    move = Move(stroke_mm=stroke_mm, angle_deg=angle, rate_per_hour=rate, law=_law(times))
    peaks = (move.peak_velocity, move.peak_acceleration, move.peak_jerk)
    for limit, peak in zip((v, a, j), peaks, strict=True):
        if peak > limit * (1 + _SAME):
            raise WrongAnswerError("quickest_move", f"a peak of {peak:g} is above {limit:g}")
    return move


def limit_of(quantity: Quantity, limit: float) -> float:
    """Return a limit as its quantity is read, or infinity for none."""
    is_free = isinstance(limit, float) and limit == math.inf
    return math.inf if is_free else quantity.number(limit)


def _times(stroke: float, v: float, a: float, j: float) -> _Times:
    """Return the times of the quickest move over a stroke in m; v and j may be infinite."""
    if v < math.inf:
        rising = min(a / j, math.sqrt(v / j))
        speeding = 2 * rising if rising < a / j else rising + v / a
        if v * speeding <= stroke:
            return _Times(rising, speeding, stroke / v - speeding)
    rising = min(a / j, math.cbrt(stroke / (2 * j)))
    if rising < a / j:
        return _Times(rising, 2 * rising, 0.0)
    return _Times(rising, rising / 2 + math.sqrt(rising**2 / 4 + stroke / a), 0.0)


def _law(times: _Times) -> MotionLaw:
    """Return the law: its jerk is constant in each segment, and those of no length are left out."""
    rising, speeding, even = (time / times.total for time in times[:3])
    v = 1 / (speeding + even)
    a = v / (speeding - rising)
    jerk = a / rising if rising else 0.0
    first, level, last = rising, speeding - rising, 0.5 if even < _SAME else speeding
    ends = ((0.0, first), (first, level), (level, last), (last, 0.5))
    pieces, s, slope = [], 0.0, 0.0
    for (low, high), (start, third) in zip(
        ends, ((0.0, jerk), (a, 0.0), (a, -jerk), (0.0, 0.0)), strict=True
    ):
        if high - low > _SAME:
            pieces.append(Series((s, slope, start / 2, third / 6), (), low, high))
            s, slope = pieces[-1].at(high), pieces[-1].derivative.at(high)
    return MotionLaw(f"seven-segment, {rising:.4g} and {speeding:.4g}", mirrored(pieces))
