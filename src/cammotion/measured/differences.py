"""Velocity and acceleration of a table by finite differences, and what a reading error does to it.

With three neighbouring points at t-a, t and t+b the parabola through them has at t

    velocity      (-b/a y1 + (b/a - a/b) y2 + a/b y3) / (a + b),
    acceleration  2 (y1/a - (1/a + 1/b) y2 + y3/b) / (a + b),

on even points (y3 - y1)/(2 dt) and (y1 - 2 y2 + y3)/dt^2. Both are sums of weights times readings.
So readings that are each off by at most e change them by at most e times the sum of the weights'
magnitudes (signs of the errors as those of the weights), and errors independent of each other, with
a root mean square of e, by e times the root of the sum of their squares.
"""

from dataclasses import dataclass

import numpy as np

from cammotion.alike import Alike
from cammotion.arguments import checked
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, RATE, cycle_time
from cammotion.measured.cam_table import CamTable
from cammotion.quantities import Floats, Quantity

ERROR = Quantity("reading error", "mm", example=0.01, low_included=True)


@dataclass(frozen=True, eq=False)
class Differences(Alike):
    """Velocity in m/s and acceleration in m/s2 at some cam angles in deg, by finite differences.

    `velocity_weights` and `acceleration_weights` are arrays of three rows: what a mm of the point
    before, at and after an angle adds to both, in m/s and m/s2.
    """

    angle_deg: Floats
    velocity: Floats
    acceleration: Floats
    velocity_weights: Floats
    acceleration_weights: Floats

    def __repr__(self) -> str:
        velocity, acceleration = (abs(each).max() for each in (self.velocity, self.acceleration))
        peaks = f"up to {velocity:.4g} m/s and {acceleration:.4g} m/s²"
        return f"Differences({self.angle_deg.size} angles, {peaks})"

    def velocity_bound(self, error_mm: float) -> Floats:
        """Return by how much in m/s readings off by at most `error_mm` change each velocity."""
        return _bound(self.velocity_weights, error_mm)

    def acceleration_bound(self, error_mm: float) -> Floats:
        """Return by how much in m/s2 readings off by at most `error_mm` change each acceleration.

        On even angles it is 4 e/dt^2, reached by errors of alternating sign; a single reading that
        is off gives 2 e/dt^2, and where all are off alike there is no change.
        """
        return _bound(self.acceleration_weights, error_mm)

    def velocity_rms(self, error_rms_mm: float) -> Floats:
        """Return the root mean square in m/s of what random errors do to each velocity.

        They are those of `acceleration_rms`. On even angles it is e/(sqrt(2) dt).
        """
        return _rms(self.velocity_weights, error_rms_mm)

    def acceleration_rms(self, error_rms_mm: float) -> Floats:
        """Return the root mean square in m/s2 of what random errors do to each acceleration.

        `error_rms_mm` is their own root mean square, and they know nothing of each other; rounding
        to a step has step/sqrt(12). On even angles it is sqrt(6) e/dt^2.
        """
        return _rms(self.acceleration_weights, error_rms_mm)


@checked
def differences(table: CamTable, rate_per_hour: float) -> Differences:
    """Return velocity and acceleration of a table by finite differences at a rate.

    `rate_per_hour` counts the turns of the camshaft in an hour: a quarter turn a second is 900.
    The angles are those of the table, of one that is no cycle without the first and the last. They
    may be uneven; then the acceleration is exact for parabolas only, on even angles for cubics too.
    Raises InputError for a rate that is not above 0.

    >>> angles = np.arange(0, 360, 10)
    >>> table = CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), is_cycle=True)
    >>> found = differences(table, rate_per_hour=900)
    >>> print(f"{found.acceleration[0]:.4f} m/s2 +- {found.acceleration_bound(0.01)[0]:.4f}")
    0.0615 m/s2 +- 0.0032
    """
    seconds_per_deg = cycle_time(RATE.number(rate_per_hour)) / DEG_PER_TURN
    angles, positions = table.angle_deg, table.position_mm
    if table.is_cycle:
        angles = np.array([angles[-1] - DEG_PER_TURN, *angles, angles[0] + DEG_PER_TURN])
        positions = np.array([positions[-1], *positions, positions[0]])
    steps = np.diff(angles)
    if table.even_step_deg is not None:
        steps = np.full_like(steps, table.even_step_deg)  # without the rounding of the angles
    before, after = steps[:-1] * seconds_per_deg, steps[1:] * seconds_per_deg
    both = (before + after) * MM_PER_M
    ratio = after / before
    slope = np.array([-ratio, ratio - 1 / ratio, 1 / ratio]) / both
    bend = 2 * np.array([1 / before, -1 / before - 1 / after, 1 / after]) / both
    three = np.array([positions[:-2], positions[1:-1], positions[2:]])
    velocity, acceleration = (np.sum(weights * three, axis=0) for weights in (slope, bend))
    return Differences(angles[1:-1], velocity, acceleration, slope, bend)


def _rms(weights: Floats, error_rms_mm: float) -> Floats:
    return np.asarray(np.sqrt(np.sum(weights**2, axis=0)) * ERROR.number(error_rms_mm))


def _bound(weights: Floats, error_mm: float) -> Floats:
    return np.asarray(np.sum(np.abs(weights), axis=0) * ERROR.number(error_mm))
