"""The smoothing spline of a table of a cam, with error bars through to the acceleration."""

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cammotion.alike import Alike
from cammotion.arguments import checked
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, RATE, cycle_time, into_turn
from cammotion.measured.cam_table import ANGLE, DERIVATIVE, CamTable
from cammotion.measured.differences import ERROR
from cammotion.measured.smoother import AnyPoints, EvenCycle, Smoother, chosen_amount
from cammotion.quantities import Floats, InputError, Numbers, Quantity, plain

AMOUNT = Quantity("amount of smoothing", "", example=1e-6, high=1e12, low_included=True)


@dataclass(frozen=True, eq=False)
class SmoothedTable(Alike):
    """The smoothing spline of a `table`, with its `amount` in rad^4.

    `position_mm` are its positions in mm at the table's angles, `error_mm` the root mean square of
    the reading error in mm that the points themselves suggest: what was smoothed away, over the
    root of the share that noise would lose of its mean square; 0 without smoothing.
    """

    table: CamTable
    amount: float
    position_mm: Floats
    error_mm: float
    _smoother: Smoother = field(repr=False, compare=False)

    def __repr__(self) -> str:
        count = self.position_mm.size
        return f"SmoothedTable({count} points by {self.amount:.4g}, error {self.error_mm:.4g} mm)"

    @property
    def as_table(self) -> CamTable:
        """The table with the smoothed positions in place of its own."""
        return replace(self.table, position_mm=self.position_mm, step_mm=0.0)

    def at(
        self, angle_deg: ArrayLike, derivative: int = 0, *, rate_per_hour: float | None = None
    ) -> Numbers:
        """Return the position in mm (or velocity in m/s, acceleration in m/s2) at a cam angle.

        `derivative` is 0, 1 or 2, and for 1 and 2 `rate_per_hour` says how often the camshaft turns
        in an hour. The result has the shape of `angle_deg`. Raises InputError for another
        derivative, for a velocity or an acceleration without a rate, and for angles outside of a
        table that is no cycle.
        """
        order = DERIVATIVE.whole(derivative)
        if order and rate_per_hour is None:
            raise InputError(
                f"The derivative {order} by the time goes by how fast the cam turns: give the rate "
                "in turns an hour, for example rate_per_hour=900."
            )
        low, high = float(self.table.angle_deg[0]), float(self.table.angle_deg[-1])
        if self.table.is_cycle:
            _, angle = into_turn(ANGLE.array(angle_deg), low)
        else:
            angle = Quantity("cam angle", "deg", low, low, high, True).array(angle_deg)
        values = self._spline(angle, order)
        if rate_per_hour is None:
            return plain(values)
        per_second = DEG_PER_TURN / cycle_time(RATE.number(rate_per_hour))
        return plain(values * (per_second**order / (MM_PER_M if order else 1)))

    def acceleration(self, rate_per_hour: float) -> Floats:
        """Return the acceleration in m/s2 at the table's angles, at a rate in turns an hour."""
        return np.asarray(self.at(self.table.angle_deg, 2, rate_per_hour=rate_per_hour))

    def acceleration_rms(self, rate_per_hour: float, error_rms_mm: float | None = None) -> Floats:
        """Return the error bars in m/s2 of the acceleration at the table's angles.

        They are the root mean squares of what random reading errors do to it that know nothing of
        each other, with a root mean square of `error_rms_mm`; without it, of the `error_mm` that
        the points suggest. What smoothing takes from the true motion is not in them: the more
        smoothing, the smaller the bars, and the further off may be what they stand on.
        """
        error = self.error_mm if error_rms_mm is None else ERROR.number(error_rms_mm)
        per_second = 2 * np.pi / cycle_time(RATE.number(rate_per_hour))
        scale = error * per_second**2 / MM_PER_M
        return np.asarray(self._smoother.spreads(self.amount) * scale)

    @cached_property
    def _spline(self) -> Any:
        return spline_through(self.table, self.position_mm)


def spline_through(table: CamTable, positions: Floats) -> Any:
    """Return the cubic spline through positions at a table's angles; that of a cycle is closed."""
    from scipy.interpolate import CubicSpline  # it takes a second to load

    if not table.is_cycle:
        return CubicSpline(table.angle_deg, positions, bc_type="natural")
    angles = np.append(table.angle_deg, table.angle_deg[0] + DEG_PER_TURN)
    return CubicSpline(angles, np.append(positions, positions[0]), bc_type="periodic")


@checked
def smoothed(table: CamTable, amount: float | None = None) -> SmoothedTable:
    """Return the smoothing spline of a table: a periodic one of a cycle, else one with free ends.

    `amount` is in rad^4; a harmonic of rank k is divided by 1 + amount k^4, nearly as long as k is
    far below half the number of points. So the rank that is halved is amount^(-1/4): with 1e-4 it
    is the tenth. 0 is the spline through all points. Without an amount it is chosen by generalised
    cross-validation, which takes what neighbours do not have in common for reading error: a table
    of few points and a motion with corners can deceive it, so look at what it has chosen. Raises
    InputError for an amount below 0, and for over 1000 points that are no cycle of even angles.

    >>> turn = np.arange(36) * 10
    >>> reading = (25 - 25 * np.cos(np.radians(turn))).round(1)
    >>> found = smoothed(CamTable(turn, reading, step_mm=0.1, is_cycle=True))
    >>> print(f"{found.acceleration(900)[0]:.3f} +- {found.acceleration_rms(900)[0]:.3f} m/s2")
    0.062 +- 0.002 m/s2
    """
    smoother = _smoother(table)
    modes = smoother.modes(table.position_mm)
    taken = chosen_amount(smoother, modes) if amount is None else AMOUNT.number(amount)
    positions = smoother.smoothed(table.position_mm, taken)
    left = np.sum((table.position_mm - positions) ** 2)
    lost = 1 - 1 / (1 + taken * smoother.eigenvalues)  # of each mode
    error = float(np.sqrt(left / np.sum(lost**2))) if taken else 0.0
    return SmoothedTable(table, taken, positions, error, smoother)


def _smoother(table: CamTable) -> Smoother:
    if table.is_cycle and table.even_step_deg is not None:
        return EvenCycle(table.angle_deg.size)
    places = np.radians(table.angle_deg)
    if table.is_cycle:
        return AnyPoints(places, "periodic", 2 * np.pi)
    return AnyPoints(places, "natural")
