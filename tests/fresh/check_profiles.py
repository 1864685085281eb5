"""Points of a profile, as uneven as a hand takes them: the motion comes back."""

import numpy as np

import cammotion as cm
from fresh.drawing import Machine, Rng

NEAR = 3e-5  # of the travel and the radius
POINTS, STEP_DEG = 2400, 0.15
KINK = 0.05  # rad that the probe may turn from one point to the next and still show the hollow


def profiles(machine: Machine) -> None:
    """Go round the cam of each motion that comes back with a probe."""
    rng = machine.rng
    for motion in machine.diagram.motions:
        if not motion.is_indexing and not motion.steps(1):
            check_profile(motion, rng)


def check_profile(motion: cm.Motion, rng: Rng) -> None:
    """Draw a roller and a probe; see that the points give the motion back."""
    travel = float(np.ptp(motion.range_mm))
    roller = travel * rng.uniform(0.1, 0.4)
    follower = cm.TranslatingRoller(roller, offset_mm=travel * float(rng.choice([0, 0.2])))
    least = cm.smallest_prime_radius(
        motion, follower, pressure_angle_deg=40, profile_radius_mm=roller / 2
    )
    if least > 20 * travel:
        return
    cam = cm.RollerCam(motion, follower, 1.2 * least)
    if cam.cut_away() or cam.hollowest.value < 2 * roller:
        return
    angles = np.sort(np.arange(POINTS) * STEP_DEG + rng.uniform(0, 0.07, POINTS))
    radius = float(rng.choice([0, 0.5, 1.3])) * roller
    x, y = (cam.cutter_mm(angles, radius) if radius else cam.profile_mm(angles)).T
    if np.hypot(np.diff(x), np.diff(y)).max() > KINK * (cam.hollowest.value - radius):
        return  # too few points in the hollow, which may be refused
    lift = cm.lift_from_profile(x, y, follower=follower, probe_radius_mm=radius)
    places = motion.position_mm(lift.angle_deg) - motion.range_mm[0]
    lowest = places.min()  # it may be lower between two of these angles
    off = np.append(
        lift.position_mm - places + lowest, lift.prime_radius_mm - cam.prime_radius_mm - lowest
    )
    assert np.abs(off).max() < NEAR * (travel + cam.prime_radius_mm), f"{motion.name}: {roller}"
