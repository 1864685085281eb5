"""The harmonics of a cycle: which whole numbers of swings in a turn its displacement is made of.

With n even points at the angles theta_j the displacement is, at these points and exactly,

    y = mean + sum over k = 1 .. n/2 of a_k cos(k theta - phi_k).

The last rank, n/2 for an even n, is Nyquist's: its swing has two points, and only its cosine can be
seen in them. Of a true a cos(k theta - phi) the points show a cos(phi) there, so that amplitude and
phase cannot be told apart; and any harmonic above looks like one below: n - k like k.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from cammotion.alike import Alike
from cammotion.arguments import checked
from cammotion.machine.kinematics import MM_PER_M, RATE, cycle_time
from cammotion.measured.cam_table import ANGLE, DERIVATIVE, CamTable
from cammotion.quantities import Floats, InputError, Numbers, one_of, plain


@dataclass(frozen=True, eq=False)
class Harmonics(Alike):
    """Mean in mm of a cycle, and of each rank 1, 2 ... n/2 amplitude in mm and phase in deg.

    The k-th harmonic is amplitude cos(k angle - phase). `points` is n, the number of points.
    """

    points: int
    mean_mm: float
    rank: Floats
    amplitude_mm: Floats
    phase_deg: Floats

    def __repr__(self) -> str:
        largest = self.amplitude_mm.max(initial=0.0)
        return f"Harmonics({self.rank.size} of {self.points} points, up to {largest:.4g} mm)"

    @property
    def nyquist(self) -> float:
        """The rank n/2: what is above it folds back, what is at it has no phase.

        >>> turn = np.arange(36) * 10
        >>> harmonics(CamTable(turn, np.cos(np.radians(18 * turn + 60)), is_cycle=True)).nyquist
        18.0
        """
        return self.points / 2

    def acceleration(
        self, rate_per_hour: float, of: Literal["displacement", "differences"] = "displacement"
    ) -> Floats:
        """Return the amplitude in m/s2 of each harmonic of the acceleration.

        That of the "displacement" is (k omega)^2 times its own; that of its second "differences"
        4 sin(k dtheta/2)^2/dt^2 times, which is less: at Nyquist's rank by pi^2/4 = 2.47. Raises
        InputError for a rate that is not above 0.
        """
        turn_s = cycle_time(RATE.number(rate_per_hour))
        per_turn = 2 * np.pi * self.rank
        if one_of("kind of acceleration", of, ("displacement", "differences")) == "differences":
            per_turn = 2 * self.points * np.sin(np.pi * self.rank / self.points)
        return np.asarray(self.amplitude_mm * (per_turn / turn_s) ** 2 / MM_PER_M)

    def rebuilt(self, number: int, angle_deg: ArrayLike, derivative: int = 0) -> Numbers:
        """Return the position in mm that the first `number` harmonics give at a cam angle in deg.

        `derivative` 1 or 2 gives mm/rad or mm/rad2. The result has the shape of `angle_deg`. Raises
        InputError unless `number` is a whole number from 0 to the last rank, and for another
        derivative.
        """
        last = len(self.rank)
        if not isinstance(number, int | np.integer) or not 0 <= number <= last:
            raise InputError(
                f"The number of harmonics is {number!r}; this table has {last}: give a whole "
                f"number from 0 to {last}."
            )
        order, angle = DERIVATIVE.whole(derivative), np.radians(ANGLE.array(angle_deg))
        rank, first = self.rank[:number], slice(0, number)
        quarter = order * np.pi / 2
        waves = np.cos(np.multiply.outer(angle, rank) - np.radians(self.phase_deg[first]) + quarter)
        mean = self.mean_mm if order == 0 else 0.0
        return plain(mean + waves @ (self.amplitude_mm[first] * rank**order))

    @checked
    def residual_mm(self, number: int, table: CamTable) -> Floats:
        """Return what `number` harmonics leave of a table, in mm at each of its points."""
        return np.asarray(table.position_mm - self.rebuilt(number, table.angle_deg))


@checked
def harmonics(table: CamTable) -> Harmonics:
    """Return the harmonics of a table that is a cycle with even angles, by the discrete transform.

    Raises InputError for another table: half a cycle has to be `mirrored()` or completed first.

    >>> turn = np.arange(36) * 10
    >>> found = harmonics(CamTable(turn, 25 - 25 * np.cos(np.radians(turn)), is_cycle=True))
    >>> print(f"{found.amplitude_mm[0]:.3f} mm, {abs(found.phase_deg[0]):.0f} deg")
    25.000 mm, 180 deg
    """
    check_even_cycle(table, "harmonics")
    positions = table.position_mm
    number, half = positions.size, positions.size // 2
    rank = np.arange(1, half + 1, dtype=float)
    waves = np.fft.rfft(positions)[1:] * 2 / number
    if number % 2 == 0:
        waves[-1] /= 2  # at Nyquist's rank k and -k are one
    waves *= np.exp(-1j * rank * np.radians(table.angle_deg[0]))
    phase = -np.degrees(np.angle(waves))
    return Harmonics(number, float(positions.mean()), rank, np.abs(waves), phase)


def check_even_cycle(table: CamTable, what: str) -> None:
    """Raise InputError unless a table is a whole turn with even angles."""
    if not table.is_cycle:
        raise InputError(
            f"The table goes from {table.angle_deg[0]:g} to {table.angle_deg[-1]:g} deg and is "
            f"no cycle; {what} are of a whole turn: use table.mirrored() if it returns as it rose, "
            "or add the points that are missing and is_cycle=True."
        )
    if table.even_step_deg is None:
        raise InputError(
            f"The angles of the table are uneven; {what} need even ones: measure at even angles, "
            "or read them from a spline, smoothed(table).at(angles)."
        )
