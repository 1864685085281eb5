"""Checks of the cam of a motion: the smallest prime circle, where it is undercut, and rolling."""

import numpy as np

import cammotion as cm
from fresh.drawing import Machine
from fresh.sampling import Array, Track, tracks_of

BESIDE_DEG = 1e-4  # of a joint, on either side
FINE = 40_000  # points of a profile that a roller is let down on
LIFT_MM = 2e-3


def cams(machine: Machine) -> None:
    """Size a cam for each motion that comes back, and roll a follower over it."""
    for name, track in tracks_of(machine.diagram).items():
        motion = machine.diagram[name]
        if motion.is_indexing or motion.steps(1):
            continue
        travel = float(np.ptp(motion.range_mm))
        rng = machine.rng
        follower = cm.TranslatingRoller(
            travel * rng.uniform(0.05, 0.5), offset_mm=travel * rng.choice([0, 0.3, -0.2])
        )
        steepest, least = rng.uniform(15, 60), travel * rng.choice([0, 0.1])
        prime = cm.smallest_prime_radius(
            motion, follower, pressure_angle_deg=steepest, profile_radius_mm=least
        )
        _check_smallest(track, follower, prime, (steepest, least), motion.range_mm[0])
        lowest = 1.001 * max(follower.radius_mm, abs(follower.offset_mm))
        other = max(prime * rng.uniform(0.4, 1.2), lowest)
        _check_undercuts(track, cm.RollerCam(motion, follower, other), follower.offset_mm)
        _check_rolling(cm.RollerCam(motion, follower, prime), track, follower.offset_mm, rng)


def _check_smallest(
    track: Track,
    follower: cm.TranslatingRoller,
    prime: float,
    limits: tuple[float, float],
    low_mm: float,
) -> None:
    steepest, least = limits
    pressure, curvature = _judged(track, follower.offset_mm, prime, low_mm)
    asked = max(
        float(np.abs(pressure).max()) / steepest,
        float(curvature.max()) * (follower.radius_mm + least),
    )
    lowest = max(follower.radius_mm, abs(follower.offset_mm))
    assert asked < 1 + 1e-6, f"prime circle {prime}: {asked} of what is allowed"
    assert asked > 0.98 or prime < 1.001 * lowest, f"{prime}: only {asked} of what is allowed"


def _check_undercuts(track: Track, cam: cm.RollerCam, offset: float) -> None:
    angles = _angles(track)
    _, curvature = _judged(track, offset, cam.prime_radius_mm, cam.motion.range_mm[0])
    sharp = curvature * cam.roller_mm
    within = np.zeros(angles.shape, bool)
    for cut in cam.undercuts:
        turned = np.mod(angles - cut.start_deg, 360)
        within |= turned < cut.end_deg - cut.start_deg
    wrong = within != (sharp > 1)
    assert not np.any(wrong & (np.abs(sharp - 1) > 1e-3)), f"undercuts {cam.undercuts}"


def _check_rolling(
    cam: cm.RollerCam, track: Track, offset: float, rng: np.random.Generator
) -> None:
    if cam.cut_away():
        return
    profile = cam.profile_mm(np.linspace(0, 360, FINE)) @ [1, 1j]
    radius = cam.roller_mm
    lowest = np.sqrt(cam.prime_radius_mm**2 - offset**2)
    step = float(np.abs(np.diff(profile)).max())
    if step > radius / 4:  # a move over a hundredth of a degree has a cam of kilometres
        return
    coarse = step**2 / radius
    for angle in rng.uniform(0, 360, 6):
        seen = profile * np.exp(-1j * np.radians(angle))
        under = seen[np.abs(seen.real + offset) < radius]
        height = (under.imag + np.sqrt(radius**2 - (under.real + offset) ** 2)).max() - lowest
        wanted = track.curve(0, angle) - cam.motion.range_mm[0]
        assert abs(height - wanted) < LIFT_MM + coarse, (
            f"{cam}: at {angle} deg {height}, not {wanted}"
        )


def _angles(track: Track) -> Array:
    return np.concatenate([track.grid - BESIDE_DEG, track.grid + BESIDE_DEG])


def _judged(track: Track, offset: float, prime: float, low_mm: float) -> tuple[Array, Array]:
    """Return pressure angle and curvature of the pitch curve, by the textbook's formulas."""
    angles = _angles(track)
    lift, slope, bend = (track.curve(order, angles) * np.degrees(1) ** order for order in range(3))
    height = np.sqrt(prime**2 - offset**2) + lift - low_mm
    beside = slope - offset
    turn = height**2 - height * bend + beside * (2 * slope - offset)
    return np.degrees(np.arctan2(beside, height)), turn / (height**2 + beside**2) ** 1.5
