"""Checks of turrets: at which stop they are best is tried out, and motions are made by hand."""

import math

import numpy as np
from turrets import ANGLES, Turret, draw, draw_motion, least_by_trying

import cammotion as cm
from fresh.drawing import Machine

CELLS, BY_HAND = 90, 100
NEAR, NEAR_MM = 1e-6, 1e-5


def turrets(machine: Machine) -> None:
    """Draw a turret; see that nothing beats its bound, and that what is found keeps to its dies.

    Where two duties share one place and no more, it may be refused or found.
    """
    rng = machine.rng
    turret = draw(rng)
    least = least_by_trying(turret)
    angles, jerky = turret.still[0][0] + ANGLES, bool(rng.random() < 0.5)
    drawn = [draw_motion(turret, rng, jerky) for _ in range(BY_HAND)]
    good = [peak for places, peak, _ in drawn if not turret.strays_mm(places, angles, 0.26)]
    try:
        found = cm.least_acceleration(
            turret.diagram(),
            "mill",
            turret.rules(),
            still=[arc[:2] for arc in turret.still],
            cells=CELLS,
        )
    except cm.InputError as refusal:
        if math.isfinite(least) and not str(refusal).startswith("On a grid of 9"):
            raise AssertionError(f"{turret} can be, but: {refusal}") from refusal
        return
    assert found.bound <= found.reached
    assert found.bound <= min(good, default=math.inf) * (1 + NEAR), f"{turret}: {min(good)} can be"
    if not math.isfinite(least):
        least = least_by_trying(turret, may_touch=True)
    assert least <= found.reached * (1 + NEAR), f"{turret}: none is below {least}"
    _check_kept(turret, found.motion)


def _check_kept(turret: Turret, motion: cm.Motion) -> None:
    angles = np.linspace(0, 360, 7201)
    strays = turret.strays_mm(motion.position_mm(angles), angles)
    assert strays < NEAR_MM, f"{turret}: strays by {strays} mm"
    for start, end, place in turret.still:
        off = motion.position_mm(np.linspace(start, end, 9)) - place
        turns = off / (24 * turret.pitch_mm)
        assert np.abs(turns - np.round(turns)).max() < NEAR_MM, f"{turret} does not stand"
