"""Key frames: a quantity over the turn of the camshaft, linear between a few cam angles.

Where a motion dwells, its two ends are enough. Where it moves, a chord over an angle d leaves the
curve by at most d^2/8 times the largest second derivative; so the peak factor Ca of the law says
how many chords keep within a tolerance, and nothing has to be searched for.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cammotion.laws.catalogue import as_law
from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import Floats

TOLERANCE_MM = 0.06
TOLERANCE_SHARE = 1.2e-3  # of a move: small strokes are drawn large
MOST_CHORDS = 200  # within the tolerance up to a move of 3 m; beyond, the drawing stays small
ACCELERATION_CHORDS = 64  # of one move; the law may jump, which a chord makes steep


@dataclass(frozen=True)
class Trace:
    """Cam angles from 0 to 360 deg, in order, and the values there; at a jump there are two."""

    angles_deg: Floats
    values: Floats

    def at(self, angle_deg: float) -> float:
        """Return the value between the key frames."""
        return float(np.interp(angle_deg, self.angles_deg, self.values))

    def scaled(self, factor: float, start: float = 0.0) -> "Trace":
        """Return `start` and `factor` times the values: mm made pixels."""
        return Trace(self.angles_deg, start + factor * self.values)


def trace_position(motion: Motion) -> Trace:
    """Return the position in mm; an indexing motion goes on over the end of its turn.

    >>> import cammotion as cm
    >>> mill = cm.indexing_motion(
    ...     "mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24, start_deg=300)
    >>> trace = trace_position(mill)
    >>> [round(trace.at(angle), 3) for angle in (0, 90, 300, 360)]
    [-69.355, 0.0, 0.0, 30.645]
    """
    return _trace(motion, _position_angles, Segment.position_mm, motion.pitch_mm)


def trace_acceleration(motion: Motion, rate_per_hour: float) -> Trace:
    """Return the acceleration in m/s2 at a machine rate in pieces/h."""
    return _trace(motion, _acceleration_angles, lambda s, at: s.derivative(2, at, rate_per_hour))


def _trace(
    motion: Motion,
    angles_of: Callable[[Segment], Floats],
    curve: Callable[[Segment, Floats], Floats],
    gain: float = 0.0,
) -> Trace:
    """Lay the segments into the turn from 0 to 360 deg; each turn earlier is a `gain` less."""
    pieces = []
    for segment in motion.segments:
        first = math.floor(segment.from_deg / DEG_PER_TURN)
        for turn in range(first, math.ceil(segment.to_deg / DEG_PER_TURN)):
            start = turn * DEG_PER_TURN
            low, high = max(segment.from_deg, start), min(segment.to_deg, start + DEG_PER_TURN)
            if high - low < ROUNDING_DEG:
                continue
            inner = [angle for angle in angles_of(segment) if low < angle < high]
            angles = np.array([low, *inner, high])
            pieces.append((angles - start, curve(segment, angles) - turn * gain))
    pieces.sort(key=lambda piece: float(piece[0][0]))
    frames = np.column_stack([np.concatenate(part) for part in zip(*pieces, strict=True)])
    is_new = np.any(np.abs(np.diff(frames, axis=0)) > TOLERANCE_SHARE * TOLERANCE_MM, axis=1)
    angles, values = frames[np.append(True, is_new)].T
    return Trace(angles, values)


def _position_angles(segment: Segment) -> Floats:
    if segment.law is None:
        return np.empty(0)
    way = abs(segment.change_mm)
    tolerance = min(TOLERANCE_MM, TOLERANCE_SHARE * way)
    chords = math.ceil(math.sqrt(way * as_law(segment.law).Ca / (8 * tolerance)))
    even = np.linspace(segment.from_deg, segment.to_deg, min(chords, MOST_CHORDS) + 1)
    return np.union1d(even, segment.turning_degs)


def _acceleration_angles(segment: Segment) -> Floats:
    chords = 0 if segment.law is None else ACCELERATION_CHORDS
    return np.linspace(segment.from_deg, segment.to_deg, chords + 1)
