"""Key frames: a quantity over the turn of the camshaft, linear between a few cam angles.

Where a motion dwells, its two ends are enough. Where it moves, a chord over an angle d leaves the
curve by at most d^2/8 times the largest second derivative; so the peak factor Ca of the law says
how many chords keep within a tolerance, and nothing has to be searched for.
"""

import math
from dataclasses import dataclass

import numpy as np

from cammotion.laws.catalogue import as_law
from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.kinematics import DEG_PER_TURN, cycle_time, over_time
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import Floats
from cammotion.views.corners import corners
from cammotion.views.displacement import displacement

TOLERANCE_MM = 0.06
TOLERANCE_SHARE = 1.2e-3  # of a move: small strokes are drawn large
MOST_CHORDS = 200  # within the tolerance up to a move of 3 m; beyond, the drawing stays small
ACCELERATION_CHORDS = 64  # of one move, beside the corners of its acceleration
_SAME_DEG = 7e-5
_SAME_SHARE = 1e-6  # of the largest acceleration: a smaller jump is not seen


@dataclass(frozen=True)
class Trace:
    """Cam angles from 0 to 360 deg, in order, and the values there; at a jump there are two."""

    angles_deg: Floats
    values: Floats

    def scaled(self, factor: float, start: float = 0.0) -> "Trace":
        """Return `start` and `factor` times the values: mm made pixels."""
        return Trace(self.angles_deg, start + factor * self.values)


CAMSHAFT = Trace(*(np.array([0.0, DEG_PER_TURN]) for _ in range(2)))
"""The cam angle itself."""


def trace_position(motion: Motion, finer: float = 1.0) -> Trace:
    """Return the `displacement` in mm; of an indexing motion it goes on over the turn's end.

    It is so many times `finer` than a drawing needs that is not magnified.

    >>> import cammotion as cm
    >>> late = trace_position(cm.EXAMPLE.mill.shifted(300))
    >>> np.interp([0, 90, 300, 360], late.angles_deg, late.values).round(3)
    array([ 30.645, 100.   , 100.   , 130.645])
    """
    angles = np.concatenate([_position_angles(segment, finer) for segment in motion.segments])
    in_turn = np.union1d(np.mod(angles, DEG_PER_TURN), [0.0, DEG_PER_TURN])
    least = TOLERANCE_SHARE * TOLERANCE_MM / finer
    return _thinned(in_turn, displacement(motion, in_turn), least)


def trace_acceleration(motion: Motion, rate_per_hour: float) -> Trace:
    """Return the acceleration in m/s2 at a machine rate in pieces/h; at a jump from both sides.

    Each segment is laid into the turn from 0 to 360 deg, in two parts where it goes over the end.
    """
    parts = []
    for segment in motion.segments:
        first = math.floor(segment.from_deg / DEG_PER_TURN)
        for turn in range(first, math.ceil(segment.to_deg / DEG_PER_TURN)):
            start = turn * DEG_PER_TURN
            low, high = max(segment.from_deg, start), min(segment.to_deg, start + DEG_PER_TURN)
            if high - low < ROUNDING_DEG:
                continue
            inner = [angle for angle in _acceleration_angles(segment) if low < angle < high]
            angles = np.array([low, *inner, high])
            values = segment.curve.derived(2)(angles)
            parts.append((angles - start, over_time(2, values, cycle_time(rate_per_hour))))
    parts.sort(key=lambda part: float(part[0][0]))
    angles, values = (np.concatenate(of_all) for of_all in zip(*parts, strict=True))
    return _thinned(angles, values, _SAME_SHARE * float(np.abs(values).max()))


def _thinned(angles: Floats, values: Floats, least: float) -> Trace:
    """Return the frames without those that are where the one before is, less than `least` off."""
    is_new = (np.diff(angles) > _SAME_DEG) | (np.abs(np.diff(values)) > least)
    kept = np.append(True, is_new)
    kept[-1] = True  # the end of the turn
    return Trace(angles[kept], values[kept])


def _position_angles(segment: Segment, finer: float) -> Floats:
    if segment.law is None:
        return np.array([segment.from_deg, segment.to_deg])
    law, way = as_law(segment.law), abs(segment.change_mm)
    tolerance = min(TOLERANCE_MM, TOLERANCE_SHARE * way) / finer
    bend = law.curve.derived(2).largest  # where V jumps, a chord ends anyway
    chords = math.ceil(math.sqrt(way * bend / (8 * tolerance)))
    even = np.linspace(segment.from_deg, segment.to_deg, min(chords, MOST_CHORDS) + 1)
    return np.union1d(even, [branch.high for branch in segment.curve.branches])


def _acceleration_angles(segment: Segment) -> Floats:
    if segment.law is None:
        return np.array([segment.from_deg, segment.to_deg])
    even = np.linspace(segment.from_deg, segment.to_deg, ACCELERATION_CHORDS + 1)
    return np.union1d(even, corners(segment.curve.derived(2)))
