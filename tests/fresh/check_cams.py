"""Checks of the cam of a motion: the smallest prime circle, where it is undercut, and rolling."""

import numpy as np

import cammotion as cm
from cammotion.hardware.outline import arcs_along
from fresh.drawing import Machine
from fresh.sampling import Array, Track, tracks_of

BESIDE_DEG = 1e-4  # of a joint, on either side
AROUND_DEG = np.linspace(-3, 3, 6001)  # of a sample, which are at most 2.5 deg apart
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
        cam = cm.RollerCam(motion, follower, prime)
        _check_outline(cam, max(travel * rng.choice([1e-2, 1e-4]), 1e-6))
        _check_rolling(cam, track, follower.offset_mm, rng)


def followers(machine: Machine) -> None:
    """Try a flat face, an arm, and the force of each follower."""
    for name, track in tracks_of(machine.diagram).items():
        motion = machine.diagram[name]
        if not motion.is_indexing and not motion.steps(1):
            _check_face(track, motion)
            _check_arm(track, motion, machine.rng)
            _check_load(track, motion, machine)


def _check_face(track: Track, motion: cm.Motion) -> None:
    """Compare the smallest base circle and the contact with displacement and derivatives."""
    lift, slope, bend = _derivatives(track, motion.range_mm[0])
    travel = float(np.ptp(motion.range_mm))
    sum_of_both = lift + bend  # often small, of two that are large: looked at twice
    around = _angles(track)[sum_of_both.argmin()] + AROUND_DEG
    nearby, _, nearby_bend = _derivatives(track, motion.range_mm[0], around)
    needed = max(0.0, -float(min(sum_of_both.min(), (nearby + nearby_bend).min())))
    base = cm.smallest_base_radius(motion)
    near = 1e-6 * (travel + float(np.abs(bend).max()))
    assert base > needed - near, f"{motion.name}: base circle {base}, needed {needed}"
    assert base < 1.02 * needed + near, f"{motion.name}: base circle {base}, enough {needed}"
    cam = cm.FlatFacedCam(motion, base + travel)
    assert cam.undercuts == ()
    assert np.allclose(cam.face_mm, [-slope.max(), -slope.min()], rtol=2e-2, atol=near)
    angles = _angles(track)
    face = 1j * (cam.base_radius_mm + lift) - slope  # the line's point, and how it goes on
    points = cam.profile_mm(angles) @ [1, 1j]
    assert np.allclose(points * np.exp(-1j * np.radians(angles)), face, atol=near)


def _check_arm(track: Track, motion: cm.Motion, rng: np.random.Generator) -> None:
    """Turn an arm by hand: the roller touches the profile, and the push leans as it is said."""
    travel = float(np.ptp(motion.range_mm))
    arm, pivot = travel * rng.uniform(1.5, 4), travel * rng.uniform(1.5, 4)
    follower = cm.SwingingRoller(travel * rng.uniform(0.05, 0.2), arm_mm=arm, pivot_mm=pivot)
    low, high = follower.primes(travel)
    prime = rng.uniform(max(low, follower.radius_mm), high)
    try:
        cam = cm.RollerCam(motion, follower, prime)
    except cm.InputError:
        assert not max(low, follower.radius_mm) < prime < high
        return
    angles = _angles(track)
    lift, slope, _ = _derivatives(track, motion.range_mm[0])
    swung = np.arccos((prime**2 - pivot**2 - arm**2) / (2 * pivot * arm)) - lift / arm
    centre = (pivot + arm * np.exp(1j * swung)) * np.exp(1j * np.radians(angles))
    size = pivot + arm
    assert np.allclose(cam.pitch_mm(angles) @ [1, 1j], centre, atol=1e-7 * size)
    apart = np.abs(cam.profile_mm(angles) @ [1, 1j] - centre)
    assert np.allclose(apart, follower.radius_mm, atol=1e-7 * size)
    turned, back = np.exp(1j * swung), np.exp(-1j * np.radians(angles))
    tangent = -1j * turned * slope + 1j * centre * back  # of the path, before the cam's turn
    cosine = np.abs((tangent.conj() * -1j * turned * 1j).real) / np.abs(tangent)
    said = np.abs(np.cos(np.radians(cam.pressure_angle_deg(angles))))
    assert np.allclose(said, cosine, atol=1e-6), f"{motion.name}: pressure angle"


def _check_load(track: Track, motion: cm.Motion, machine: Machine) -> None:
    """Find the least force and the rate at which contact is lost among samples."""
    rng, rate = machine.rng, machine.diagram.rate_per_hour
    travel = float(np.ptp(motion.range_mm))
    mass, stiffness = rng.uniform(0.1, 20), rng.uniform(0, 5)
    heaviest = mass * float(np.abs(_push(track, _angles(track), rate)).max())
    preload = heaviest * rng.uniform(0.01, 2)
    load = cm.FollowerLoad(mass_kg=mass, stiffness_N_per_mm=stiffness, preload_N=preload)

    def shares(angles: Array) -> tuple[Array, Array]:
        """Return the force, and what the inertia pulls as a share of what holds it."""
        lift, _, _ = _derivatives(track, motion.range_mm[0], angles)
        pull, standing = mass * _push(track, angles, rate), stiffness * lift + preload
        return pull + standing, -pull / standing

    angles = _angles(track)
    force, pulled = shares(angles)
    # the spring grows so fast that a summit may be narrower than the samples are apart
    around = shares(angles[force.argmin()] + AROUND_DEG)[0].min()
    least, sampled_least = load.least_force(motion, rate).value, min(force.min(), around)
    size = float(np.abs(force).max()) + stiffness * travel
    assert least < sampled_least + 1e-6 * size, f"{motion.name}: {least}, but {sampled_least}"
    assert least > sampled_least - 2e-2 * size, f"{motion.name}: {least}, and only {sampled_least}"
    nearby = shares(angles[pulled.argmax()] + AROUND_DEG)[1].max()
    most, leaves = float(max(pulled.max(), nearby)), load.lift_off_rate(motion)
    if most > 0:
        sampled = rate / np.sqrt(most)
        assert 0.97 * sampled < leaves < sampled * (1 + 1e-6), f"{motion.name}: off at {leaves}"


def _push(track: Track, angles: Array, rate: float) -> Array:
    """Return the acceleration in m/s2."""
    return track.curve(2, angles) * (rate / 10) ** 2 / 1000


def _derivatives(
    track: Track, low_mm: float, angles: Array | None = None
) -> tuple[Array, Array, Array]:
    """Return displacement and two derivatives by the rad: at angles, or beside all joints."""
    angles = _angles(track) if angles is None else angles
    lift, slope, bend = (track.curve(order, angles) * np.degrees(1) ** order for order in range(3))
    return lift - low_mm, slope, bend


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
    sharp = curvature * cam.roller_radius_mm
    within = np.zeros(angles.shape, bool)
    for cut in cam.undercuts:
        turned = np.mod(angles - cut.start_deg, 360)
        within |= turned < cut.end_deg - cut.start_deg
    wrong = within != (sharp > 1)
    assert not np.any(wrong & (np.abs(sharp - 1) > 1e-3)), f"undercuts {cam.undercuts}"


def _check_outline(cam: cm.RollerCam, tolerance: float) -> None:
    """Look between the corners of the outline how far the profile is off the arcs."""
    outline = arcs_along(cam.profile_mm, cam.motion, tolerance)
    corners = outline.points_mm @ [1, 1j]
    turns = np.append(outline.angles_deg[1:], outline.angles_deg[0]) - outline.angles_deg
    places = outline.angles_deg[:, None] + np.mod(turns, 360)[:, None] * np.linspace(0, 1, 23)
    exact = cam.profile_mm(places.ravel()).reshape(*places.shape, 2) @ [1, 1j]
    chords = np.roll(corners, -1) - corners
    along = (exact - corners[:, None]) / chords[:, None]  # each chord from 0 to 1
    bulge = outline.bulges[:, None]
    with np.errstate(divide="ignore", invalid="ignore"):
        centre = 0.5 + 1j * (1 / bulge - bulge) / 4
        off = np.where(
            np.abs(bulge) < 1e-7,
            np.abs(along.imag),
            np.abs(np.abs(along - centre) - np.abs(centre)),
        )
    worst = float((off * np.abs(chords[:, None])).max())
    assert worst < tolerance, f"{cam.motion.name}: {worst} mm off, allowed {tolerance}"


def _check_rolling(
    cam: cm.RollerCam, track: Track, offset: float, rng: np.random.Generator
) -> None:
    if cam.cut_away():
        return
    profile = cam.profile_mm(np.linspace(0, 360, FINE)) @ [1, 1j]
    radius = cam.roller_radius_mm
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
    lift, slope, bend = _derivatives(track, low_mm)
    height = np.sqrt(prime**2 - offset**2) + lift
    beside = slope - offset
    turn = height**2 - height * bend + beside * (2 * slope - offset)
    return np.degrees(np.arctan2(beside, height)), turn / (height**2 + beside**2) ** 1.5
