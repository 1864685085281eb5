"""Disc cams: the published cases, and followers that are rolled over what was written to a file."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

import dxfgrabber  # type: ignore[import-untyped]
import numpy as np
import pytest
from machines import Array
from rolling import Outline, arm_angle, dense, face_height, roller_height

import cammotion as cm

DIE = cm.EXAMPLE.die
AFTER = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram["die"]
ROLLER = cm.TranslatingRoller(10)
PLACES = np.arange(0.5, 360, 7.3)
JERKY = cm.motion(  # its cam is good at samples, and has a cusp between two of them
    "jerky", cm.rise(25.6, over_deg=0.01, law="3-4-5 polynomial"), cm.return_(25.6, over_deg=359.99)
)
UPRIGHT = {"pressure_angle_deg": 90, "profile_radius_mm": 3}


def harmonic(stroke_mm: float = 50) -> cm.Motion:
    """Return 180 up and 180 down, by the cosine."""
    up, down = (f(stroke_mm, over_deg=180, law="simple harmonic") for f in (cm.rise, cm.return_))
    return cm.motion("harmonic", up, down)


def drawn(rng: np.random.Generator) -> cm.Motion:
    """Return a motion with dwells, drawn laws, and sometimes a part of constant velocity."""
    laws = ["cycloidal", "3-4-5 polynomial", "modified sine", "modified trapezoid"]
    up, down = rng.uniform(80, 140, 2)
    rise = (
        cm.fifth_degree_linear(rng.uniform(0.1, 0.5))
        if rng.random() < 0.3
        else laws[rng.integers(4)]
    )
    parts = (
        cm.rise(30, over_deg=up, law=rise),
        cm.dwell(40),
        cm.return_(30, over_deg=down, law=laws[rng.integers(4)]),
        cm.dwell(320 - up - down),
    )
    return cm.motion("drawn", *parts, start_deg=rng.uniform(0, 500))


def outline_of(cam: Any, folder: Path, tolerance: float = 0.001) -> Outline:
    """Write a cam as DXF, read it with another program, and return the profile's dense points."""
    path = cm.write_cam(cam, folder / "cam.dxf", tolerance_mm=tolerance)
    assert path.stat().st_size < 300_000
    (profile,) = [e for e in dxfgrabber.readfile(str(path)).entities if e.layer == "PROFILE"]
    assert profile.is_closed
    corners = zip(profile.points, profile.bulge, strict=True)
    return dense([(x, y, bulge) for (x, y, *_), bulge in corners])


def lift_of(motion: cm.Motion, angle: float) -> float:
    return float(motion.position_mm(angle)) - motion.range_mm[0]


@pytest.mark.parametrize("offset", [0, 12, -9])
@pytest.mark.parametrize("motion", [DIE, AFTER, drawn(np.random.default_rng(3))], ids=str)
def test_a_roller_on_the_written_cam_is_lifted_as_wanted(
    motion: cm.Motion, offset: float, tmp_path: Path
) -> None:
    follower = cm.TranslatingRoller(10, offset_mm=offset)
    cam = cm.RollerCam(motion, follower, cm.smallest_prime_radius(motion, follower))
    outline = outline_of(cam, tmp_path)
    lowest = math.sqrt(cam.prime_radius_mm**2 - offset**2)
    allowed = 0.001 / math.cos(math.radians(cam.largest_pressure_angle.value))
    for angle in PLACES:
        height = roller_height(outline, angle, 10, -offset)
        assert height - lowest == pytest.approx(lift_of(motion, angle), abs=allowed)


def test_a_motion_with_a_limited_jerk_is_lifted_as_wanted(tmp_path: Path) -> None:
    """The motion with the least peak that keeps the rule, from the linear program."""
    example = cm.EXAMPLE
    best = cm.least_acceleration(
        example.diagram, "die", example.rule, still=[(205, 305)], jerk_m_per_s3=15, cells=120
    )
    cam = cm.RollerCam(best.motion, ROLLER, cm.smallest_prime_radius(best.motion, ROLLER))
    outline = outline_of(cam, tmp_path)
    allowed = 0.001 / math.cos(math.radians(cam.largest_pressure_angle.value))
    for angle in PLACES:
        height = roller_height(outline, angle, 10, 0) - cam.prime_radius_mm
        assert height == pytest.approx(lift_of(best.motion, angle), abs=allowed)


def test_a_cam_that_is_as_small_as_can_be_is_not_undercut() -> None:
    """A radius that is the roller's but for rounding was called undercut, and not written."""
    for over_deg in (30, 45, 60, 75, 90):
        for radius_mm in (2, 5, 8, 11):
            lift = cm.motion(
                "lift",
                *(cm.rise(10, over_deg=over_deg), cm.dwell(60), cm.return_(10, over_deg=over_deg)),
                cm.dwell(300 - 2 * over_deg),
            )
            roller = cm.TranslatingRoller(radius_mm)
            prime = cm.smallest_prime_radius(lift, roller, pressure_angle_deg=80)
            assert cm.RollerCam(lift, roller, prime).undercuts == ()


@pytest.mark.parametrize("steepest_deg", [80, 84])
def test_the_smallest_prime_circle_leaves_all_of_the_profile(steepest_deg: float) -> None:
    """It had no undercut, and yet half a roller was cut away where it is used elsewhere.

    So no centre of the roller comes nearer to a point of the profile than its radius.
    """
    lift = cm.motion("lift", cm.rise(10, over_deg=30), cm.return_(10, over_deg=30), cm.dwell(300))
    prime = cm.smallest_prime_radius(lift, cm.TranslatingRoller(1), pressure_angle_deg=steepest_deg)

    def nearest(radius: float) -> float:
        cam, angles = cm.RollerCam(lift, cm.TranslatingRoller(1), radius), np.arange(0, 360, 0.2)
        around, touched = cam.pitch_mm(angles), cam.profile_mm(angles)
        return min(float(np.hypot(*(around - point).T).min()) for point in touched)

    assert nearest(prime) > 1 - 2e-3
    if steepest_deg == 84:  # else the pressure angle asks for more
        assert nearest(prime - 0.05) < 1 - 2e-3


def test_an_arm_that_is_too_short_for_its_travel_is_told_so() -> None:
    """It was asked for a radius of more than 30 and less than 30 mm."""
    far = cm.motion("far", cm.rise(188.5, over_deg=180), cm.return_(188.5, over_deg=180))
    arm = cm.SwingingRoller(14, arm_mm=60, pivot_mm=90)
    with pytest.raises(cm.InputError, match=r"no prime circle has a travel of 188\.5 mm: the arm"):
        cm.RollerCam(far, arm, prime_radius_mm=60)
    with pytest.raises(cm.InputError, match=r"more than 10 mm, .* give for example 15 mm"):
        cm.RollerCam(AFTER, ROLLER, prime_radius_mm=5)


def test_the_cutter_that_is_advised_fits() -> None:
    cam = cm.RollerCam(cm.EXAMPLE.die, ROLLER, prime_radius_mm=100)
    with pytest.raises(cm.InputError, match="give a cutter of at most") as refusal:
        cam.cutter_mm(0, 1000)
    advised = float(str(refusal.value).rpartition("at most ")[2].removesuffix(" mm."))
    assert np.shape(cam.cutter_mm(0, advised)) == (2,)
    assert advised > cam.hollowest.value + 10 - 0.01


@pytest.mark.parametrize("motion", [AFTER, drawn(np.random.default_rng(4))], ids=str)
def test_a_swinging_roller_is_lifted_as_wanted(motion: cm.Motion, tmp_path: Path) -> None:
    follower = cm.SwingingRoller(10, arm_mm=150, pivot_mm=165)
    prime = cm.smallest_prime_radius(motion, follower, pressure_angle_deg=40)
    cam = cm.RollerCam(motion, follower, prime)
    outline = outline_of(cam, tmp_path)
    lowest = math.acos((prime**2 - 150**2 - 165**2) / (2 * 150 * 165))
    allowed = 0.001 / math.cos(math.radians(cam.largest_pressure_angle.value))
    for angle in PLACES:
        turned_by = lowest - arm_angle(outline, angle, 10, 150, 165)
        assert 150 * turned_by == pytest.approx(lift_of(motion, angle), abs=allowed)


@pytest.mark.parametrize("motion", [AFTER, harmonic(), drawn(np.random.default_rng(5))], ids=str)
def test_a_flat_face_is_lifted_as_wanted(motion: cm.Motion, tmp_path: Path) -> None:
    base = max(cm.smallest_base_radius(motion, profile_radius_mm=5), 20)
    outline = outline_of(cm.FlatFacedCam(motion, base), tmp_path)
    for angle in PLACES:
        height = face_height(outline, angle)
        assert height - base == pytest.approx(lift_of(motion, angle), abs=0.001)


def test_a_flat_face_with_harmonic_motion_runs_on_a_circle(tmp_path: Path) -> None:
    """A textbook's problem: 50 mm, least radius 25 mm; the profile is a circle about (0, -25)."""
    cam = cm.FlatFacedCam(harmonic(), base_radius_mm=25)
    circle = np.abs(outline_of(cam, tmp_path) + 25j)
    assert circle == pytest.approx(50, abs=1e-6)
    assert cam.face_mm == pytest.approx((-25, 25))
    assert cam.sharpest.value == pytest.approx(50)


def test_an_eccentric_circle_comes_back() -> None:
    """Roller 10 on a circle of 40 mm that turns about a point 15 mm off its centre."""
    at = np.linspace(0, 360, 721)[:-1]
    lift = 15 * np.cos(np.radians(at - 180)) + np.sqrt(50**2 - 15**2 * np.sin(np.radians(at)) ** 2)
    up = cm.law_from_points(np.linspace(0, 1, 361), (lift[:361] - lift[0]) / (lift[360] - lift[0]))
    way = lift[360] - lift[0]
    down = up.reversed()
    motion = cm.motion(
        "eccentric", cm.rise(way, over_deg=180, law=up), cm.return_(way, over_deg=180, law=down)
    )
    cam = cm.RollerCam(motion, cm.TranslatingRoller(10), prime_radius_mm=35)
    x, y = cam.profile_mm(np.linspace(1, 359, 359)).T
    assert np.hypot(x, y + 15) == pytest.approx(40, abs=2e-3)
    steepest = cam.largest_pressure_angle.value
    assert steepest == pytest.approx(math.degrees(math.asin(15 / 50)), abs=1e-3)


def test_the_textbooks_flat_face_and_parabola() -> None:
    """S = k theta², 10 mm at 60 deg: at 45 deg 5.625 mm, touched 14.324 mm off the axis."""
    law = cm.MotionLaw("parabola up", cm.x**2)
    rest = cm.return_(10, over_deg=300, law=cm.MATCHED)
    cam = cm.FlatFacedCam(cm.motion("f", cm.rise(10, over_deg=60, law=law), rest), 100)
    assert cam.lift(45).lift == pytest.approx(5.625)
    assert abs(cam.contact_mm(45)) == pytest.approx(14.324, abs=5e-4)


def test_what_overlap_is_worth_in_steel() -> None:
    """The closed form for a slide over the axis: the largest of s'/tan 30 deg - s."""
    for motion, printed in ((DIE, 156.835), (AFTER, 57.640)):
        prime = cm.smallest_prime_radius(motion, ROLLER)
        at = np.linspace(0, 360, 72001)
        slope = np.gradient(motion.position_mm(at), np.radians(at))
        lift = motion.position_mm(at) - motion.range_mm[0]
        needed = np.abs(slope) / math.tan(math.radians(30)) - lift
        assert prime == pytest.approx(float(needed.max()), rel=1e-5)
        assert prime == pytest.approx(printed, abs=5e-4)


@pytest.mark.parametrize("seed", range(6))
def test_the_smallest_prime_circle_is_good_and_a_smaller_one_is_not(seed: int) -> None:
    rng = np.random.default_rng(seed)
    motion = drawn(rng)
    followers = cm.TranslatingRoller(rng.uniform(5, 15), offset_mm=rng.uniform(-10, 20))
    limits = rng.uniform(20, 40), rng.uniform(0, 8)
    asked = {"pressure_angle_deg": limits[0], "profile_radius_mm": limits[1]}
    prime = cm.smallest_prime_radius(motion, followers, **asked)
    assert is_good(cm.RollerCam(motion, followers, prime + 1e-6), *limits)
    assert not is_good(cm.RollerCam(motion, followers, prime - 0.01), *limits)


def is_good(cam: cm.RollerCam, steepest_deg: float, radius_mm: float) -> bool:
    """Judge by differences of the pitch curve alone."""
    at = np.linspace(0, 360, 40001)
    pitch = cam.pitch_mm(at) @ [1, 1j]
    step = np.radians(at[1])
    tangent = (pitch[2:] - pitch[:-2]) / 2 / step
    bend = (pitch[2:] - 2 * pitch[1:-1] + pitch[:-2]) / step**2
    radius = np.abs(tangent) ** 3 / (tangent.conj() * bend).imag
    way = 1j * np.exp(1j * np.radians(at[1:-1]))
    steep = np.abs(np.degrees(np.angle(way / (-1j * tangent))))
    bulges = radius > 0
    least = radius[bulges].min() - cam.roller_radius_mm
    return bool(steep.max() <= steepest_deg + 1e-4 and least >= radius_mm - 1e-3)


@pytest.mark.parametrize("law", ["cycloidal", "modified sine", "3-4-5 polynomial"])
def test_a_flat_faced_cam_that_is_as_small_as_can_be_is_not_undercut(law: str) -> None:
    """Some of them had a radius of -3.5e-15 mm and were called undercut."""
    for angle in np.arange(40.0, 80):
        up, down = cm.rise(10, over_deg=angle, law=law), cm.return_(10, over_deg=angle - 7, law=law)
        motion = cm.motion("m", up, cm.dwell(33), down, cm.dwell(334 - 2 * angle))
        least = cm.smallest_base_radius(motion)
        assert cm.FlatFacedCam(motion, least).undercuts == ()
        (*_, worst) = sorted(cm.FlatFacedCam(motion, least - 0.01).undercuts, key=_missing)
        assert worst.missing_mm == pytest.approx(0.01)


def _missing(cut: cm.Undercut) -> float:
    return cut.missing_mm


def test_the_largest_cutter_of_a_tiny_groove_is_told_with_its_digits() -> None:
    """A groove of 0.0004567 mm: the advice was a cutter of at most 0 mm."""
    cam = cm.RollerCam(DIE, cm.TranslatingRoller(4.567e-4), prime_radius_mm=60)
    with pytest.raises(cm.InputError, match=r"give a cutter of at most 0\.0004567 mm"):
        cam.cutter_mm(0, 1e-3, outer=True)


def test_undercut_arcs_end_where_the_pitch_curve_is_as_sharp_as_the_roller() -> None:
    cam = cm.RollerCam(DIE, cm.TranslatingRoller(14), prime_radius_mm=15)
    assert len(cam.undercuts) == 2
    for cut in cam.undercuts:
        ends = np.array([cut.start_deg, cut.end_deg])
        assert cam.pitch_radius_mm(ends) == pytest.approx(14, abs=1e-6)
        inside = np.linspace(cut.start_deg + 1e-3, cut.end_deg - 1e-3, 101)
        assert np.all(cam.profile_radius_mm(inside) < 0)
        worst = float(cam.profile_radius_mm(inside).min())
        assert cut.missing_mm == pytest.approx(-worst, rel=1e-3)
    others = np.setdiff1d(np.arange(0, 360, 0.5), _within(cam.undercuts))
    radius = cam.pitch_radius_mm(others)
    assert np.all((radius < 0) | (radius > 14))


def _within(cuts: tuple[cm.Undercut, ...]) -> Array:
    at = np.arange(0, 360, 0.5)
    return at[np.any([(cut.start_deg <= at) & (at <= cut.end_deg) for cut in cuts], axis=0)]


@pytest.mark.parametrize(("roller", "prime"), [(15, 32), (20, 32), (24, 32), (30, 40)])
def test_what_is_cut_away_is_where_a_roller_does_not_come_down(roller: float, prime: float) -> None:
    """Two lobes close together, and the roller rolled over all points of the profile."""
    up, down = cm.rise(40, over_deg=70), cm.return_(40, over_deg=70)
    motion = cm.motion("lobes", up, down, cm.dwell(40), up, down, cm.dwell(40))
    cam = cm.RollerCam(motion, cm.TranslatingRoller(roller), prime_radius_mm=prime)
    pitch = cam.pitch_mm(np.arange(0, 360, 0.1)) @ [1, 1j]
    profile = cam.profile_mm(np.arange(0, 360, 0.05)) @ [1, 1j]
    left = [point for point in profile if np.abs(point - pitch).min() > roller - 1e-4]
    gone = cam.cut_away()
    for angle in np.arange(0.5, 180, 3.0):
        high = roller_height(np.array(left), angle, roller, 0) - prime - lift_of(motion, angle)
        if any(start + 1 < angle < end - 1 for start, end in gone):
            assert high < -1e-3
        if not any(start - 1 < angle < end + 1 for start, end in gone):
            assert high == pytest.approx(0, abs=2e-4)
    whole = cam.pitch_mm(np.arange(0, 360, 0.01)) @ [1, 1j]
    for start, end in gone:
        within, beside = ((start + by, end - by) for by in (0.06, -0.06))
        for angles, is_gone in ((within, True), (beside, False)):
            for point in cam.profile_mm(np.array(angles)) @ [1, 1j]:
                assert (np.abs(point - whole).min() < roller - 1e-3) == is_gone


def test_a_groove_has_a_far_flank_of_its_own() -> None:
    """The roller fits where the pitch curve is smooth, and the far flank has a cusp in a hollow."""
    up, down = cm.rise(40, over_deg=70), cm.return_(40, over_deg=70)
    motion = cm.motion("lobes", up, down, cm.dwell(40), up, down, cm.dwell(40))
    cam = cm.RollerCam(motion, cm.TranslatingRoller(20), prime_radius_mm=32)
    assert cam.undercuts == ()
    assert cam.hollowest.value == pytest.approx(14.548, abs=1e-3)
    assert len(cam.outer_undercuts) == 4
    (first, *_) = cam.outer_undercuts
    assert cam.pitch_radius_mm([first.start_deg, first.end_deg]) == pytest.approx(-20, abs=1e-6)
    at = np.arange(0.0, 360, 0.5)
    near, far = cam.profile_mm(at), cam.profile_mm(at, outer=True)
    assert np.hypot(*(far - near).T) == pytest.approx(40)
    assert np.hypot(*((far + near) / 2 - cam.pitch_mm(at)).T) == pytest.approx(0, abs=1e-9)
    for cutter, flank in ((cam.cutter_mm(at, 16), near), (cam.cutter_mm(at, 16, outer=True), far)):
        assert np.hypot(*(cutter - flank).T) == pytest.approx(16)
    assert np.all(np.hypot(*(cam.cutter_mm(at, 16) - cam.pitch_mm(at)).T) < 4 + 1e-9)


def test_a_cutter_that_is_too_large_is_refused() -> None:
    """A cutter in a hollow touches the profile twice where it is wider than that."""
    cam = cm.RollerCam(DIE, ROLLER, prime_radius_mm=60)
    most = cam.hollowest.value + 10
    at = np.arange(0, 360, 0.1)
    profile = cam.profile_mm(at) @ [1, 1j]
    way = cam.cutter_mm(at, most - 0.01) @ [1, 1j]
    assert min(np.abs(place - profile).min() for place in way) > most - 0.02
    with pytest.raises(cm.InputError, match=f"has a hollow, of {most:.6g} mm: give a cutter"):
        cam.cutter_mm(at, most + 0.01)
    with pytest.raises(cm.InputError, match="as wide as the roller, of 10 mm"):
        cam.cutter_mm(at, 10.5, outer=True)
    with pytest.raises(cm.InputError, match="radius of the cutter is 0 mm"):
        cam.cutter_mm(at, 0)


@pytest.mark.parametrize(
    ("make", "said"),
    [
        (lambda: cm.RollerCam(cm.EXAMPLE.mill, ROLLER, 60), "moves on from stop to stop"),
        (lambda: cm.FlatFacedCam(cm.EXAMPLE.mill, 60), "moves on from stop to stop"),
        (lambda: cm.RollerCam(cast(Any, "die"), ROLLER, 60), "motion='die': give a motion"),
        (
            lambda: cm.RollerCam(DIE, cast(Any, "roller"), 60),
            "give a TranslatingRoller or a SwingingRoller",
        ),
        (lambda: cm.RollerCam(DIE, ROLLER, 10), "more than 10 mm"),
        (lambda: cm.RollerCam(DIE, cm.TranslatingRoller(5, 30), 30), "more than 30 mm"),
        (lambda: cm.RollerCam(DIE, cm.SwingingRoller(10, 100, 120), 219), "less than 213.2"),
        (lambda: cm.RollerCam(DIE, cm.SwingingRoller(10, 100, 150), 40), "more than 50"),
        (lambda: cm.TranslatingRoller(0), "radius of the roller is 0 mm"),
        (lambda: cm.SwingingRoller(10, -1, 100), "arm of the follower is -1 mm"),
        (lambda: cm.FlatFacedCam(DIE, 0), "radius of the base circle is 0 mm"),
        (lambda: cm.smallest_prime_radius(DIE, ROLLER, pressure_angle_deg=91), "at most 90 deg"),
        (lambda: cm.smallest_prime_radius(cm.EXAMPLE.mill, ROLLER), "moves on from stop to stop"),
        (
            lambda: cm.smallest_prime_radius(DIE, cm.SwingingRoller(10, 60, 80)),
            "No prime circle of this follower keeps the pressure angle within 30 deg",
        ),
        (
            lambda: cm.smallest_prime_radius(JERKY, cm.SwingingRoller(12, 150, 75), **UPRIGHT),
            "No prime circle of this follower .* the pitch curve's radius over 15 mm",
        ),
    ],
)
def test_what_cannot_be_a_cam_is_refused_in_words(make: Callable[[], Any], said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        make()


def test_a_velocity_that_jumps_makes_no_cam() -> None:
    line = cm.MotionLaw("line", cm.x)
    motion = cm.motion(
        "conveyor", cm.rise(50, over_deg=180, law=line), cm.return_(50, over_deg=180)
    )
    with pytest.raises(cm.InputError, match="velocity of the motion 'conveyor' jumps at 0 deg"):
        cm.RollerCam(motion, ROLLER, 60)


def test_a_prime_circle_without_a_demand_on_its_radius_is_the_least_that_the_follower_has() -> None:
    flat = cm.motion("flat", cm.rise(1, over_deg=180), cm.return_(1, over_deg=180))
    asked = {"pressure_angle_deg": 90, "profile_radius_mm": 0}
    assert cm.smallest_prime_radius(flat, ROLLER, **asked) == pytest.approx(10, abs=1)


@pytest.mark.parametrize("later", [100, 160, 200, 300])
def test_an_undercut_is_found_in_whatever_turn_its_move_is_told(later: float) -> None:
    """Moves past 360 deg belong to the next turn, and undercuts are told within one."""
    follower = cm.TranslatingRoller(16)
    usual = cm.RollerCam(DIE, follower, prime_radius_mm=20).undercuts
    moved = cm.RollerCam(DIE.shifted(later), follower, prime_radius_mm=20).undercuts
    places = {round((cut.worst_deg + later) % 360, 3): cut for cut in usual}
    assert len(places) == 2
    for cut in moved:
        before = places.pop(round(cut.worst_deg % 360, 3))
        assert cut.missing_mm == pytest.approx(before.missing_mm)
        assert cut.end_deg - cut.start_deg == pytest.approx(before.end_deg - before.start_deg)
    assert not places


def test_where_two_segments_meet_a_cam_is_bent_as_by_the_one_that_begins() -> None:
    """The ends of a table's moves are sums: 0.1 + 50.2 is no 50.3, and yet it is that joint."""
    parts = cm.rise(10, over_deg=50.2, law="constant acceleration"), cm.dwell(100)
    back = cm.return_(10, over_deg=100), cm.dwell(109.8)
    motion = cm.motion("press", *parts, *back, start_deg=0.1)
    assert motion.segments[0].to_deg > 50.3
    cam = cm.FlatFacedCam(motion, base_radius_mm=1000)
    assert cam.profile_radius_mm([50.3, 410.3, 100]) == pytest.approx([1010] * 3)
    begins = 1000 + 4 * 10 / math.radians(50.2) ** 2  # base circle, lift and its bend
    assert cam.profile_radius_mm(0.1 + 360) == pytest.approx(begins)
