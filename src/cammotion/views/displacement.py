"""Where a motion is through the turn that is drawn, from 0 to 360 deg: for every picture of it."""

import numpy as np
from numpy.typing import ArrayLike

from cammotion.limits.standing import unrolled_mm
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats

SAMPLED_DEGS = np.linspace(0.0, DEG_PER_TURN, 721)
_LEAST = 33  # places of a move


def displacement(motion: Motion, angle_deg: ArrayLike) -> Floats:
    """Return the position in mm; of an indexing motion, from the stop it is nearest at 0 deg.

    `angle_deg` are cam angles in deg, an array of any shape. An indexing motion goes on over the
    end of its turn, and is not set back where its stops close the turret.

    >>> import cammotion as cm
    >>> belt = cm.indexing_motion("belt", cm.rise(100, over_deg=150), cm.dwell(210), stops=1)
    >>> displacement(belt, [0, 75, 360])
    array([  0.,  50., 100.])
    """
    if motion.stops is None:
        return np.asarray(motion.position_mm(angle_deg))
    at_zero = (unrolled_mm(motion, 0.0) - motion.start_mm) / motion.pitch_mm
    stop_mm = motion.start_mm + motion.pitch_mm * np.round(at_zero)
    return np.asarray(unrolled_mm(motion, angle_deg) - stop_mm)


def curve_angles(motion: Motion) -> Floats:
    """Return cam angles, 0 to 360 deg, close enough for a curve and with its corners in it.

    A short move has as many as a longer one: its acceleration may be nothing at each half degree.

    >>> import cammotion as cm
    >>> parts = cm.rise(1, over_deg=0.5), cm.dwell(179.5), cm.return_(1, over_deg=180)
    >>> int(np.sum(curve_angles(cm.motion("pin", *parts)) <= 0.5))
    33
    """
    corners = np.concatenate([motion.turning_degs, within_short_moves(motion)])
    return np.union1d(SAMPLED_DEGS, np.mod(corners, DEG_PER_TURN))


def within_short_moves(motion: Motion) -> Floats:
    """Return cam angles close enough for a curve in the moves of a motion that are short."""
    short = [
        np.linspace(move.from_deg, move.to_deg, _LEAST)
        for move in motion.moves
        if move.angle_deg < _LEAST * SAMPLED_DEGS[1]
    ]
    return np.concatenate([np.empty(0), *short])
