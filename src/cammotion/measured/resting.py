"""A smoothed table that rests over its dwells, where it had a little of the noise left."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TypeAlias

import numpy as np

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.measured.cam_table import CamTable
from cammotion.measured.smoothing import spline_through
from cammotion.quantities import Floats

Stay: TypeAlias = tuple[int, int, float]
"""The first and the last point of a dwell, which count on over the end of the turn; its height."""

_WIDEST_DEG = 10.0  # at either end of a dwell, over which its positions become its height
_FEWEST = 3  # points of a dwell
_SLIGHT = 0.3  # of the peak: more acceleration than a dwell may change


def eased(table: CamTable, stays: Sequence[Stay]) -> tuple[CamTable, list[Stay]]:
    """Return the table with its positions over these dwells brought to their heights, and those.

    They go over to it within the dwell, so that velocity and acceleration do not jump. Left out is
    a dwell that would change the acceleration by more than three tenths of its peak, as a slow turn
    does.

    >>> angles = np.arange(0.0, 360.0, 10)
    >>> lift = 20 * LAWS["cycloidal"](np.clip(np.minimum(angles, 350 - angles) / 120, 0, 1))
    >>> lift[12:24] += 1e-4 * np.sin(angles[12:24])
    >>> smooth, stays = eased(CamTable(angles, lift, is_cycle=True), [(12, 23, 20.0)])
    >>> stays, bool(np.ptp(smooth.position_mm[13:23]) == 0)
    ([(13, 22, 20.0)], True)
    """
    size, positions, kept = table.angle_deg.size, table.position_mm, []
    peak = np.abs(_bends(table, positions)).max()
    for first, last, height in stays:
        turns, which = np.divmod(np.arange(first, last + 1), size)
        angles = table.angle_deg[which] + DEG_PER_TURN * turns
        width = min(_WIDEST_DEG, (angles[-1] - angles[0]) / 3)
        ends = 1 - np.minimum(angles - angles[0], angles[-1] - angles) / width
        share = LAWS["3-4-5 polynomial"](np.clip(ends, 0, 1))
        inside = first + np.flatnonzero(ends <= 0)
        rested = positions.copy()
        rested[which] = height + share * (positions[which] - height)
        change = np.abs(_bends(table, rested - positions)).max()
        if inside.size >= _FEWEST and change <= _SLIGHT * peak:
            positions = rested
            kept.append((int(inside[0]), int(inside[-1]), height))
    return replace(table, position_mm=positions), kept


def _bends(table: CamTable, positions: Floats) -> Floats:
    """Return the second derivatives, in mm/deg2, of the periodic spline through some positions."""
    return np.asarray(spline_through(table, positions)(table.angle_deg, 2))
