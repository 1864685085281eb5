"""A follower as masses in a row, each on a spring and a damper: what it does when it swings.

    cam --(k1, b1)-- m1 --(k2, b2)-- m2 -- ...

The track is closed: the cam pushes and pulls. With S the displacement of the cam and S + z1,
S + z2, ... the positions of the masses, the springs and dampers feel z alone, and

    M z'' + B z' + K z = -M (1, 1, ...) S''.

Springs in a row are a product K = C' k C with the plain differences C. Its modes are had from the
singular values of sqrt(k) C / sqrt(m), which keeps the digits of a soft spring beside a hard one.
In these modes, each measured by its energy, the system is a rotation and a loss; so its solution
never grows, and no rounding does.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from cammotion.machine.kinematics import MM_PER_M
from cammotion.quantities import Floats, InputError, Quantity, shorten

MASS = Quantity("mass", "kg", example=12)
STIFFNESS = Quantity("stiffness of a spring", "N/mm", example=50)
DAMPING = Quantity("damping", "N s/mm", example=0.05, low_included=True)
NATURAL = Quantity("natural frequency", "Hz", example=12)
DAMPING_RATIO = Quantity("damping ratio", "", example=0.02, low_included=True)
UNDERDAMPED = replace(DAMPING_RATIO, high=0.99)  # of a mass that swings, which has a formula


@dataclass(frozen=True, eq=False)
class System:
    """Modes of a follower, by a unit of time of the caller.

    `frequencies` are angular and undamped, in rising order, `damping` is the symmetric matrix that
    takes energy from the modes, `modes` has a column for each: how far each mass goes (a row) when
    the mode is 1 in the unit of 1/sqrt(mass). `push` is how much an acceleration of the cam drives
    each mode. The state is (frequency * mode, rate of the mode), for all modes.
    """

    frequencies: Floats
    damping: Floats
    modes: Floats
    push: Floats

    def by(self, unit_s: float) -> "System":
        """Return it with another unit of time, so many of the present ones."""
        return System(self.frequencies * unit_s, self.damping * unit_s, self.modes, self.push)

    @cached_property
    def matrix(self) -> Floats:
        """The matrix A of the state x in x' = A x + input * S''."""
        w = np.diag(self.frequencies)
        return np.block([[0 * w, w], [-w, -self.damping]])

    @cached_property
    def input(self) -> Floats:
        """What the acceleration S'' of the cam adds to the rate of the state."""
        return np.concatenate([0 * self.push, -self.push])

    def rows(self, derivative: int) -> Floats:
        """Return the matrix that makes of a state the masses' deflection z, or its rate z' (1).

        Or (2) their acceleration S'' + z'', in which that of the cam cancels.
        """
        none = 0 * self.modes
        if derivative == 0:
            return np.hstack([self.modes / self.frequencies, none])
        if derivative == 1:
            return np.hstack([none, self.modes])
        return -self.modes @ np.hstack([np.diag(self.frequencies), self.damping])


@dataclass(frozen=True)
class Chain:
    """Masses in a row behind a cam, each on a spring and a damper, the first one's on the cam.

    `masses_kg` are one or more, `stiffnesses_N_per_mm` as many, above 0. `dampings_N_s_per_mm` are
    as many, from 0 on, as large as you like; left out, nothing damps. Raises InputError for others.

    >>> row = Chain([12, 3], [4000, 500])
    >>> row.natural_Hz.round(2)
    array([ 59.  , 101.19])
    """

    masses_kg: Sequence[float]
    stiffnesses_N_per_mm: Sequence[float]  # noqa: N815 - newton
    dampings_N_s_per_mm: Sequence[float] = ()  # noqa: N815

    def __post_init__(self) -> None:
        masses = _numbers(MASS, self.masses_kg)
        springs = _numbers(STIFFNESS, self.stiffnesses_N_per_mm)
        dampers = _numbers(DAMPING, self.dampings_N_s_per_mm) or (0.0,) * len(masses)
        if not len(masses) == len(springs) == len(dampers) > 0:
            raise InputError(
                f"The follower has {len(masses)} masses, {len(springs)} springs and {len(dampers)} "
                "dampers: give each mass a spring and a damper, which may be 0."
            )
        object.__setattr__(self, "masses_kg", masses)
        object.__setattr__(self, "stiffnesses_N_per_mm", springs)
        object.__setattr__(self, "dampings_N_s_per_mm", dampers)

    @property
    def mass_matrix(self) -> Floats:
        """The matrix M in kg, square."""
        return np.diag(self.masses_kg)

    @property
    def stiffness_matrix(self) -> Floats:
        """The matrix K in N/m, square and symmetric.

        >>> two_masses(1, 1, k1_N_per_mm=3, k2_N_per_mm=2).stiffness_matrix
        array([[ 5000., -2000.],
               [-2000.,  2000.]])
        """
        return self._in_a_row(self.stiffnesses_N_per_mm)

    @property
    def damping_matrix(self) -> Floats:
        """The matrix B in N s/m, square and symmetric."""
        return self._in_a_row(self.dampings_N_s_per_mm)

    @property
    def natural_Hz(self) -> Floats:  # noqa: N802
        """The undamped natural frequencies in Hz, in rising order, one for each mass.

        >>> equal = two_masses(1, 1, k1_N_per_mm=1, k2_N_per_mm=1)
        >>> (equal.natural_Hz * 2 * np.pi / np.sqrt(1000)).round(6)
        array([0.618034, 1.618034])
        """
        return np.asarray(self.system.frequencies / (2 * np.pi))

    @property
    def modes(self) -> Floats:
        """How far the masses go in each undamped mode: a row for each mass, a column for each mode.

        The largest number of a mode is 1. The modes are in the order of `natural_Hz`.

        >>> two_masses(1, 1, k1_N_per_mm=1, k2_N_per_mm=1).modes.round(3)
        array([[ 0.618,  1.   ],
               [ 1.   , -0.618]])
        """
        modes = self.system.modes
        furthest = np.argmax(np.abs(modes), axis=0)
        return np.asarray(modes / modes[furthest, np.arange(len(furthest))])

    @property
    def roots_per_s(self) -> Floats:
        """The roots of the damped system in 1/s, complex, two for each mass, slowest decay first.

        Each free motion is a sum of exp(root * t); a root without imaginary part does not swing.
        Two roots that meet, as with a damping ratio of 1, are exact to half of the digits only.
        """
        roots = np.linalg.eigvals(self.system.matrix).astype(complex)
        return np.asarray(roots[np.lexsort((roots.imag, -roots.real))])

    @property
    def damping_ratios(self) -> Floats:
        """The damping ratio of each undamped mode, dimensionless; at 1 it ceases to swing.

        It counts what the dampers take from the mode by itself. That is all of it for one mass, and
        wherever the dampers go as the springs; else modes also damp each other: see `roots_per_s`.
        """
        system = self.system
        return np.asarray(np.diag(system.damping) / (2 * system.frequencies))

    @cached_property
    def system(self) -> System:
        """Its modes by the second, in kg, N/m and m."""
        masses = np.sqrt(np.array(self.masses_kg))
        differences = np.eye(len(masses)) - np.eye(len(masses), k=-1)
        springs = np.sqrt(MM_PER_M * np.array(self.stiffnesses_N_per_mm))[:, None]
        dampers = np.sqrt(MM_PER_M * np.array(self.dampings_N_s_per_mm))[:, None]
        _, frequencies, across = np.linalg.svd(springs * differences / masses)
        modes = across[::-1].T / masses[:, None]
        losses = dampers * differences @ modes
        push = modes.T @ masses**2
        return System(frequencies[::-1], losses.T @ losses, modes, push)

    def _in_a_row(self, each: Any) -> Floats:
        size = len(each)
        differences = np.eye(size) - np.eye(size, k=-1)
        return np.asarray(differences.T * (MM_PER_M * np.array(each)) @ differences)


def two_masses(  # noqa: PLR0913 - the source's six
    m1_kg: float,
    m2_kg: float,
    *,
    k1_N_per_mm: float,  # noqa: N803 - newton
    k2_N_per_mm: float,  # noqa: N803
    b1_N_s_per_mm: float = 0.0,  # noqa: N803
    b2_N_s_per_mm: float = 0.0,  # noqa: N803
) -> Chain:
    """Return the follower of two masses: cam -(k1, b1)- m1 -(k2, b2)- m2, on a closed track.

    Masses in kg and stiffnesses in N/mm are above 0, dampings in N s/mm from 0 on. Raises
    InputError for others.

    >>> two_masses(8, 2, k1_N_per_mm=900, k2_N_per_mm=400).natural_Hz.round(1)
    array([44.9, 84.7])
    """
    return Chain((m1_kg, m2_kg), (k1_N_per_mm, k2_N_per_mm), (b1_N_s_per_mm, b2_N_s_per_mm))


def tuned_mass(natural_Hz: float, damping_ratio: float = 0.0, *, mass_kg: float = 1.0) -> Chain:  # noqa: N803
    """Return the follower of one mass on a spring that swings with a natural frequency in Hz.

    `damping_ratio` is from 0 on: 1 is critical. `mass_kg` matters for forces alone. Raises
    InputError for others.

    >>> tuned_mass(12, 0.02).natural_Hz.round(9)
    array([12.])
    """
    w, mass = 2 * math.pi * NATURAL.number(natural_Hz), MASS.number(mass_kg)
    ratio = DAMPING_RATIO.number(damping_ratio)
    return Chain([mass], [mass * w**2 / MM_PER_M], [2 * ratio * mass * w / MM_PER_M])


def _numbers(quantity: Quantity, values: Any) -> tuple[float, ...]:
    is_alone = isinstance(values, np.ndarray) and not values.ndim  # iterable by its kind alone
    if isinstance(values, str) or is_alone or not isinstance(values, Iterable):
        raise InputError(
            f"Of the {quantity.name} a list is wanted, a number for each mass, and not "
            f"{shorten(values)}: give for example [{quantity.example:g}]."
        )
    return tuple(quantity.number(value) for value in values)
