"""A driven row of masses, stepped through by an integrator of SciPy that knows nothing of modes.

The masses' own positions are followed, from plain matrices, and the integrator starts anew at each
joint of the cam's motion.
"""

from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any

import numpy as np
import sympy
from scipy.integrate import DOP853

import cammotion as cm
from fresh.sampling import Array, joints_of

RTOL = 3e-14
INSIDE = 1e-13  # of the way between two joints
Drive = tuple[float, float, Callable[[float], float]]
"""From where to where in s, and the acceleration of the cam over the time in m/s2."""


def drives_of(motion: cm.Motion, rate_per_hour: float) -> list[Drive]:
    """Return the cam's acceleration over a turn, piece by piece."""
    per_deg = 10.0 / rate_per_hour  # s
    found = []
    for segment in motion.segments:
        if segment.law is None:
            ends = (a - motion.start_deg for a in (segment.from_deg, segment.to_deg))
            start, end = (angle * per_deg for angle in ends)
            found.append((start, end, lambda _: 0.0))
            continue
        start = (segment.from_deg - motion.start_deg) * per_deg
        way = segment.to_mm - segment.from_mm
        found += drives_of_law(cm.as_law(segment.law), way, segment.angle_deg * per_deg, start)
    return found


def drives_of_law(
    law: cm.MotionLaw, stroke_mm: float, time_s: float, start_s: float = 0.0
) -> list[Drive]:
    """Return the acceleration of a move by a law, piece by piece."""
    bend = sympy.lambdify(cm.x, sympy.diff(law.s, cm.x, 2), "math")
    size = stroke_mm / 1000 / time_s**2

    def between(low: float, high: float) -> Drive:
        first, last = low + INSIDE * (high - low), high - INSIDE * (high - low)
        start, end = start_s + low * time_s, start_s + high * time_s
        return start, end, lambda at: size * bend(min(max((at - start_s) / time_s, first), last))

    return [between(*ends) for ends in pairwise([0.0, *joints_of(law), 1.0])]


def swings_of(row: "Row") -> float:
    """Return an angular frequency in 1/s above all of the row's."""
    return float(2 * np.sqrt(np.max(row.springs) / np.min(row.masses)))


def fastest_of(row: "Row") -> float:
    """Return a rate in 1/s above all of the row's, of swings and of what its dampers stop."""
    return max(swings_of(row), float(4 * np.max(row.dampers) / np.min(row.masses)))


class Row:
    """Masses in a row behind the cam, in SI units."""

    def __init__(self, masses: Any, springs: Any, dampers: Any) -> None:
        each = (np.asarray(values, float) for values in (masses, springs, dampers))
        self.masses, self.springs, self.dampers = each

    @classmethod
    def of(cls, chain: cm.Chain) -> "Row":
        """Return the row that was said of a chain."""
        stiff, damped = np.array(chain.stiffnesses_N_per_mm), np.array(chain.dampings_N_s_per_mm)
        return cls(chain.masses_kg, 1000 * stiff, 1000 * damped)

    def pushes(self, away: Array, rates: Array) -> Array:
        """Return what springs and dampers push the masses with, from their distances to the cam."""
        ahead, sooner = np.concatenate([[0.0], away[:-1]]), np.concatenate([[0.0], rates[:-1]])
        force = self.springs * (ahead - away) + self.dampers * (sooner - rates)
        return np.asarray(force - np.append(force[1:], 0.0))

    def stepped(
        self, drives: Sequence[Drive], times: Array, away: Array, rates: Array, size: float
    ) -> tuple[Array, Array, Array]:
        """Return distances to the cam in m, rates and accelerations at times in order, by rows.

        After them comes the state at the end, in one array. `size` is a distance that counts.
        """
        count = len(self.masses)
        state = np.concatenate([away, rates])
        found = np.empty((len(times), 2 * count))
        units = np.eye(2 * count)
        moved = [self.pushes(each[:count], each[count:]) / self.masses for each in units]
        matrix = np.vstack([units[count:], np.transpose(moved)])
        atol = RTOL * size * np.repeat([1.0, swings_of(self)], count)
        for low, high, given in drives:

            def rate(at: float, state: Array, given: Any = given) -> Array:
                changes = matrix @ state
                changes[count:] -= given(at)
                return changes

            inside = np.flatnonzero((times >= low) & (times < high))
            for at, stop in pairwise([low, *times[inside], high]):
                if stop > at:
                    state = _step(rate, at, stop, state, atol)
                found[inside[times[inside] == stop]] = state
        found[times >= drives[-1][1]] = state
        return found, found @ matrix[count:].T, state


def _step(rate: Any, low: float, high: float, state: Array, atol: Array) -> Array:
    solver = DOP853(rate, low, state, high, rtol=RTOL, atol=atol)
    while solver.status == "running":
        solver.step()
    assert solver.status == "finished"
    return np.asarray(solver.y)
