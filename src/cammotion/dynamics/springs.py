"""What gives way between cam and follower: springs in a row, and how fast a mass on them swings."""

import math

import numpy as np
from numpy.typing import ArrayLike

from cammotion.dynamics.chain import MASS, NATURAL, STIFFNESS
from cammotion.machine.kinematics import MM_PER_M, RATE, cycle_time


def springs_in_series(stiffness_N_per_mm: ArrayLike) -> float:  # noqa: N803 - newton
    """Return the stiffness in N/mm of springs one behind the other, given in N/mm each.

    Each carries the whole force, and the ways in which they give add up: 1/k = sum of 1/k_i. Raises
    InputError unless each is a finite number above 0; a rigid part is left out.

    >>> springs_in_series([20, 20])
    10.0
    """
    return float(1 / np.sum(1 / STIFFNESS.array(stiffness_N_per_mm)))


def natural_frequency(stiffness_N_per_mm: float, mass_kg: float) -> float:  # noqa: N803
    """Return how many times a second a mass in kg on a spring in N/mm swings, undamped: in Hz.

    It is sqrt(k/m) / (2 pi). Raises InputError unless both are finite and above 0.

    >>> print(f"{natural_frequency(39.478, 1):.3f} Hz")
    31.623 Hz
    """
    stiffness = STIFFNESS.number(stiffness_N_per_mm) * MM_PER_M
    return math.sqrt(stiffness / MASS.number(mass_kg)) / (2 * math.pi)


def critical_harmonic(frequency_Hz: float, rate_per_hour: float) -> float:  # noqa: N803
    """Return how many swings of a frequency in Hz there are in a turn of the camshaft.

    At `rate_per_hour` turns an hour (the pieces per hour of a machine that makes one a turn) the
    harmonic of the whole number nearest to it is nearest to resonance. Raises InputError unless
    both are finite and above 0.

    >>> critical_harmonic(4.5, 900)
    18.0
    """
    return float(NATURAL.number(frequency_Hz) * cycle_time(RATE.number(rate_per_hour)))
