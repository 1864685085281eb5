"""From the machine rate N, the indexing angle Bm and the stroke hm to tm, v, a and their peaks.

One piece a turn: a turn of the camshaft lasts T = 3600/N seconds, and a move over Bm degrees lasts
tm = Bm/360 T. Lengths come in mm; velocity, acceleration and jerk are returned in m/s, m/s2 and
m/s3. Units are converted here, or with the numbers from here.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.quantities import Floats, Numbers, Quantity, broadcast, keep_numbers, plain

STROKE = Quantity("stroke", "mm", example=50)
FULL_TURN_DEG = 360 * (1 + 1e-12)  # as 150 + 210.00000000000003 deg is
ANGLE = Quantity("indexing angle", "deg", example=55, high=FULL_TURN_DEG)
RATE = Quantity("machine rate", "pieces/h", example=2000)

_CYCLES = Quantity("rate", "cycles/min", example=40)
_TURN = Quantity("angle of the part", "deg", example=30, low=-math.inf)
_RADIUS = Quantity("radius", "mm", example=80)

SECONDS_PER_HOUR = 3600
SECONDS_PER_MINUTE = MINUTES_PER_HOUR = 60
DEG_PER_TURN = 360
MM_PER_M = UM_PER_MM = 1000
STANDARD_GRAVITY = 9.80665  # m/s2, by definition


def into_turn(angle_deg: Floats, start_deg: float) -> tuple[Floats, Floats]:
    """Return how many turns after the one from `start_deg` on angles lie, and where within that."""
    turns, since = np.divmod(angle_deg - start_deg, DEG_PER_TURN)
    full = since >= DEG_PER_TURN  # as NumPy has it for -5e-324
    return turns + full, np.where(full, 0.0, since) + start_deg


def cycle_time(rate_per_hour: ArrayLike) -> Numbers:
    """Return the time of one turn, T = 3600/N.

    `rate_per_hour` is the machine rate N in pieces/h, a number or an array; the result in s has
    its shape. Raises InputError for a rate that is not a finite number above 0.

    >>> cycle_time(2000)
    1.8
    """
    return plain(SECONDS_PER_HOUR / RATE.array(rate_per_hour))


def per_minute(cycles: ArrayLike) -> Numbers:
    """Return a machine rate in pieces/h, given in cycles a minute: what a camshaft turns in rpm.

    A cycle is one turn of the camshaft and one piece. `cycles` is a number or an array, above 0.
    Raises InputError for others.

    >>> import cammotion as cm
    >>> cm.TimingDiagram([cm.EXAMPLE.die], rate_per_hour=per_minute(40))
    TimingDiagram(die at 2400 pieces/h)
    """
    return plain(_CYCLES.array(cycles) * MINUTES_PER_HOUR)


def arc_mm(angle_deg: ArrayLike, radius_mm: ArrayLike) -> Numbers:
    """Return how many mm a point at a radius goes along its arc while its part turns by some deg.

    So a part that swings or turns is described: all of it in mm at one radius. An acceleration in
    m/s2 there is 1000/radius_mm times as much in rad/s2. Both are numbers or arrays that broadcast.
    Raises InputError for what is not finite, and a radius that is not above 0.

    >>> import cammotion as cm
    >>> up, down = (arc_mm(angle, radius_mm=80) for angle in (30, 30))
    >>> arm = cm.motion("arm", cm.rise(up, over_deg=90), cm.return_(down, over_deg=270))
    >>> print(f"{arm.range_mm[1]:.2f} mm")
    41.89 mm
    """
    angle, radius = _TURN.array(angle_deg), _RADIUS.array(radius_mm)
    broadcast(angle_deg=angle, radius_mm=radius)
    return plain(np.radians(angle) * radius)


def indexing_time(angle_deg: ArrayLike, rate_per_hour: ArrayLike) -> Numbers:
    """Return the time of one move, tm = Bm/360 * 3600/N.

    `angle_deg` is the indexing angle Bm in deg, above 0 and at most 360; `rate_per_hour` the
    machine rate N in pieces/h. Both may be arrays that broadcast; the result is in s. Raises
    InputError for a value out of range.

    >>> indexing_time(55, 2000)
    0.275
    """
    angle, rate = ANGLE.array(angle_deg), RATE.array(rate_per_hour)
    broadcast(angle_deg=angle, rate_per_hour=rate)
    return plain(angle * SECONDS_PER_HOUR / (DEG_PER_TURN * rate))


def peak_velocity(
    stroke_mm: ArrayLike,
    angle_deg: ArrayLike,
    rate_per_hour: ArrayLike,
    law: str | MotionLaw = "cycloidal",
) -> Numbers:
    """Return the peak velocity of a move, v_max = Cv hm/tm, in m/s.

    The stroke in mm, the indexing angle in deg (at most 360) and the machine rate in pieces/h are
    numbers or arrays that broadcast. Raises InputError for others and for an unknown law.

    >>> print(f"{peak_velocity(50, 55, 2000):.4f} m/s")
    0.3636 m/s
    """
    return _peak(1, _of_a_move(law).Cv, stroke_mm, angle_deg, rate_per_hour)


def peak_acceleration(
    stroke_mm: ArrayLike,
    angle_deg: ArrayLike,
    rate_per_hour: ArrayLike,
    law: str | MotionLaw = "cycloidal",
) -> Numbers:
    """Return the peak acceleration of a move, a_max = Ca hm/tm^2, in m/s2.

    `stroke_mm` is the stroke hm in mm, `angle_deg` the indexing angle Bm in deg (above 0, at most
    360), `rate_per_hour` the machine rate N in pieces/h; numbers or arrays that broadcast. `law`
    is the name of a motion law or a law; for the cycloidal one Ca = 2 pi. Raises InputError for a
    value out of range, and a law that is unknown or does not go from 0 to 1.

    >>> print(f"{peak_acceleration(50, 55, 2000):.3f} m/s2")
    4.154 m/s2
    >>> peak_acceleration(50, [55, 110], 2000).round(3)  # twice the angle, a quarter
    array([4.154, 1.039])
    """
    return _peak(2, _of_a_move(law).Ca, stroke_mm, angle_deg, rate_per_hour)


def peak_jerk(
    stroke_mm: ArrayLike,
    angle_deg: ArrayLike,
    rate_per_hour: ArrayLike,
    law: str | MotionLaw = "cycloidal",
) -> Numbers:
    """Return the peak jerk of a move, j_max = Cj hm/tm^3, in m/s3.

    The stroke in mm, the indexing angle in deg (at most 360) and the machine rate in pieces/h are
    numbers or arrays that broadcast. Raises InputError for others and for an unknown law.

    >>> print(f"{peak_jerk(50, 55, 2000):.1f} m/s3")
    94.9 m/s3
    """
    return _peak(3, _of_a_move(law).Cj, stroke_mm, angle_deg, rate_per_hour)


@dataclass(frozen=True, kw_only=True)
class Move:
    """One move: a stroke, made over an indexing angle, at a machine rate, by a motion law.

    >>> die = Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    >>> die.time_s
    0.275
    >>> print(f"{die.peak_acceleration:.3f} m/s2")
    4.154 m/s2
    """

    stroke_mm: float
    angle_deg: float
    rate_per_hour: float
    law: str | MotionLaw = "cycloidal"

    def __post_init__(self) -> None:
        keep_numbers(
            self, stroke_mm=STROKE.number, angle_deg=ANGLE.number, rate_per_hour=RATE.number
        )
        object.__setattr__(self, "law", _of_a_move(self.law))  # looked up once

    @cached_property
    def time_s(self) -> float:
        """The indexing time tm in s."""
        return float(indexing_time(self.angle_deg, self.rate_per_hour))

    @property
    def peak_velocity(self) -> float:
        """The peak velocity in m/s."""
        return float(peak_velocity(*self._numbers, self.law))

    @property
    def peak_acceleration(self) -> float:
        """The peak acceleration in m/s2."""
        return float(peak_acceleration(*self._numbers, self.law))

    @property
    def peak_jerk(self) -> float:
        """The peak jerk in m/s3."""
        return float(peak_jerk(*self._numbers, self.law))

    def displacement_mm(self, time_s: ArrayLike) -> Numbers:
        """Return the displacement h in mm at `time_s`, 0 to tm, a number or an array."""
        return self._curve(0, time_s) * MM_PER_M

    def velocity(self, time_s: ArrayLike) -> Numbers:
        """Return the velocity v in m/s at `time_s`, 0 to tm, a number or an array."""
        return self._curve(1, time_s)

    def acceleration(self, time_s: ArrayLike) -> Numbers:
        """Return the acceleration a in m/s2 at `time_s`, 0 to tm, a number or an array."""
        return self._curve(2, time_s)

    def jerk(self, time_s: ArrayLike) -> Numbers:
        """Return the jerk j in m/s3 at `time_s`, 0 to tm, a number or an array."""
        return self._curve(3, time_s)

    @property
    def _numbers(self) -> tuple[float, float, float]:
        return self.stroke_mm, self.angle_deg, self.rate_per_hour

    def _curve(self, derivative: int, time_s: ArrayLike) -> Numbers:
        tm = self.time_s
        time = Quantity("time", "s", tm / 2, high=tm, low_included=True, rounding=1e-12 * tm)
        factor = as_law(self.law)(time.array(time_s) / tm, derivative)
        return dimensional(derivative, factor, self.stroke_mm, tm)


def dimensional(derivative: int, factor: Numbers, stroke_mm: Numbers, time_s: Numbers) -> Numbers:
    """Return factor * hm/tm^derivative in m and s: a value of S, V, A or J made h, v, a or j."""
    return factor * stroke_mm / MM_PER_M / time_s**derivative


def over_time(derivative: int, value: Numbers, cycle_time_s: float) -> Numbers:
    """Return a derivative by the cam angle, in mm/deg^n, as one by the time, in m/s^n."""
    return value / MM_PER_M * (DEG_PER_TURN / cycle_time_s) ** derivative


def _peak(
    derivative: int,
    factor: float,
    stroke_mm: ArrayLike,
    angle_deg: ArrayLike,
    rate_per_hour: ArrayLike,
) -> Numbers:
    stroke, angle, rate = STROKE.array(stroke_mm), ANGLE.array(angle_deg), RATE.array(rate_per_hour)
    broadcast(stroke_mm=stroke, angle_deg=angle, rate_per_hour=rate)
    return plain(dimensional(derivative, factor, stroke, indexing_time(angle, rate)))


def _of_a_move(law: str | MotionLaw) -> MotionLaw:
    """Return the law; raise InputError for one that does not go from 0 to 1."""
    found = as_law(law)
    found.check_way()
    return found
