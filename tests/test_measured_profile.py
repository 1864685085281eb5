"""Points of a profile give the lift back, whatever probe went round, and noise stays what it is."""

import math
from typing import Any

import numpy as np
import pytest
from fresh.check_profiles import profiles
from fresh.drawing import draw
from machines import Array

import cammotion as cm
from cammotion import CamTable, FlatFacedCam, InputError, ProfileLift, RollerCam, lift_from_profile
from cammotion.hardware.traced_profile import Traced

DIE = cm.EXAMPLE.die
FLAT = "flat face"
ROLLERS: list[tuple[Any, float]] = [
    (cm.TranslatingRoller(10), 160),
    (cm.TranslatingRoller(10, offset_mm=30), 160),
    (cm.TranslatingRoller(10, offset_mm=-20), 160),
    (cm.SwingingRoller(10, arm_mm=150, pivot_mm=220), 170),
]
UP, DOWN = (make(50, over_deg=180, law="cycloidal") for make in (cm.rise, cm.return_))
VALVE = cm.motion("valve", UP, DOWN)


def probed(cam: RollerCam, angles: Array, radius: float) -> Array:
    """Return the centres of a probe of some radius that touches where the roller does."""
    return cam.cutter_mm(angles, radius) if radius else cam.profile_mm(angles)


def noisy(points: Array, size: float, seed: int = 0) -> Array:
    return np.asarray(points + np.random.default_rng(seed).normal(0, size, points.shape))


def off_um(lift: ProfileLift, motion: cm.Motion) -> Array:
    """Return by how much a lift is off a motion, but for the lowest, which noise lowers."""
    off = lift.position_mm - motion.position_mm(lift.angle_deg)
    return np.asarray(1000 * (off - np.median(off)))


@pytest.mark.parametrize("radius", [0, 2, 10, 16])
@pytest.mark.parametrize(("follower", "prime"), ROLLERS)
def test_the_die_comes_back(follower: Any, prime: float, radius: float) -> None:
    cam = RollerCam(DIE, follower, prime)
    x, y = probed(cam, np.arange(0, 360, 0.5), radius).T
    lift = lift_from_profile(x, y, follower=follower, probe_radius_mm=radius, count=90)
    assert lift.prime_radius_mm == pytest.approx(prime, abs=1e-5)
    assert np.array_equal(lift.angle_deg, np.arange(0, 360, 4))
    assert np.abs(off_um(lift, DIE)).max() < 0.01
    assert lift.off_mm < 1e-4
    table = CamTable(lift.angle_deg, lift.position_mm, is_cycle=True)
    assert table.even_step_deg == 4


DWELLS, MOVES = ((0, 150), (205, 305)), ((150, 205), (305, 360))
UNEVEN: dict[str, Any] = {
    "dense in moves": [
        place for w, d in ((DWELLS, 1), (MOVES, 0.1)) for e in w for place in np.arange(*e, d)
    ],
    "drawn": np.random.default_rng(3).uniform(0, 360, 1500),
}


@pytest.mark.parametrize("name", UNEVEN)
def test_the_steps_between_points_need_not_be_alike(name: str) -> None:
    """Beside a step ten times as long as the next one no point is a stray."""
    cam = RollerCam(DIE, cm.TranslatingRoller(10), 160)
    x, y = cam.cutter_mm(np.sort(UNEVEN[name]), 2).T
    lift = lift_from_profile(x, y, follower=cam.follower, probe_radius_mm=2)
    assert np.abs(off_um(lift, DIE)).max() < 1


def test_a_stray_among_uneven_points_is_one() -> None:
    cam = RollerCam(DIE, cm.TranslatingRoller(10), 160)
    angles = np.sort(UNEVEN["dense in moves"])
    x, y = cam.profile_mm(angles).T * np.where(angles == 250, 1.001, 1)  # a fifth of a mm
    with pytest.raises(
        InputError, match=r"The point at 250 deg of cam angle lies about 0\.2 mm off"
    ):
        lift_from_profile(x, y, follower=cam.follower)


@pytest.mark.parametrize("up_mm", [-5, -0.3, 0.1, 1])
def test_a_stray_among_dense_points_is_no_hollow(up_mm: float) -> None:
    cam, angles = RollerCam(DIE, cm.TranslatingRoller(10), 160), np.arange(3600) / 10
    x, y = cam.profile_mm(angles).T * np.where(angles == 250, 1 + up_mm / 200, 1)
    with pytest.raises(
        InputError, match=r"The point at 250 deg of cam angle lies about [\d.]+ mm off"
    ):
        lift_from_profile(x, y, follower=cam.follower)


@pytest.mark.parametrize("noise_mm", [0.002, 0.02])
@pytest.mark.parametrize("seed", range(6))
def test_noise_beside_steps_that_are_far_longer_is_told(seed: int, noise_mm: float) -> None:
    """Beside steps of a tenth of a degree, one of five is swayed by thirty times the noise."""
    cam = RollerCam(DIE, cm.TranslatingRoller(10), 160)

    def lift_by(wide: float) -> ProfileLift:
        parts = [np.arange(*e, d) for ends, d in ((DWELLS, wide), (MOVES, 0.1)) for e in ends]
        points = cam.profile_mm(np.sort(np.concatenate(parts)))
        return lift_from_profile(*noisy(points, noise_mm, seed).T, follower=cam.follower)

    with pytest.raises(InputError, match=r"is 5[\d.]+ times as long as one beside it"):
        lift_by(5)
    assert np.abs(off_um(lift_by(1), DIE)).max() < 10 * 1000 * noise_mm


def test_noise_of_points_close_together_is_no_kink() -> None:
    cam = RollerCam(DIE, cm.TranslatingRoller(10), 160)
    x, y = noisy(cam.cutter_mm(np.arange(3600) / 10, 2), 6e-3).T
    lift = lift_from_profile(x, y, follower=cam.follower, probe_radius_mm=2)
    assert 4 < off_um(lift, DIE).std() < 8


@pytest.mark.parametrize("radius", [0, 2, 16])
@pytest.mark.parametrize(("follower", "prime"), ROLLERS)
@pytest.mark.parametrize("count", [360, 3600])
def test_noise_of_a_micrometre_stays_one(
    follower: Any, prime: float, radius: float, count: int
) -> None:
    cam = RollerCam(DIE, follower, prime)
    x, y = noisy(probed(cam, np.arange(count) * 360 / count, radius), 1e-3).T
    lift = lift_from_profile(x, y, follower=follower, probe_radius_mm=radius)
    assert lift.angle_deg.size == 360
    off = off_um(lift, DIE)
    assert 0.7 < off.std() < 1.3
    assert np.abs(off).max() < 6
    assert lift.off_mm < 0.01


def test_noise_shifts_the_whole_lift_and_off_mm_is_not_that_noise() -> None:
    """As the docstring says, with a way to find the shift."""
    cam, noise = RollerCam(DIE, cm.TranslatingRoller(10), 160), 3e-3
    x, y = noisy(cam.profile_mm(np.arange(0, 360.0)), noise).T
    lift = lift_from_profile(x, y, follower=cam.follower)
    off = lift.position_mm - DIE.position_mm(lift.angle_deg)
    shift = np.median(lift.position_mm[DIE.position_mm(lift.angle_deg) == 0])
    assert 2 * noise < shift < 3 * noise
    assert np.median(off) == pytest.approx(shift, abs=0.3 * noise)
    assert lift.prime_radius_mm - 160 == pytest.approx(-shift, abs=0.3 * noise)
    assert lift.off_mm < 0.1 * noise < off.std()
    assert repr(lift).endswith(f", within {lift.off_mm:.2g} mm of the points)")


@pytest.mark.parametrize(("motion", "base"), [(DIE, 330), (VALVE, 40)])
@pytest.mark.parametrize("radius", [0, 3])
@pytest.mark.parametrize("noise", [0, 1e-3])
@pytest.mark.parametrize("count", [360, 3600])
def test_a_flat_face(
    motion: cm.Motion, base: float, radius: float, noise: float, count: int
) -> None:
    angles = np.arange(count) * 360 / count
    cam = FlatFacedCam(motion, base)
    outwards = np.radians(angles + 90)  # the normal of what a face touches
    centres = cam.profile_mm(angles) + radius * np.stack([np.cos(outwards), np.sin(outwards)], 1)
    x, y = noisy(centres, noise).T
    lift = lift_from_profile(x, y, follower=FLAT, probe_radius_mm=radius)
    assert lift.prime_radius_mm == pytest.approx(base, abs=1e-5 + 5 * noise)
    assert np.abs(off_um(lift, motion)).max() < (6 if noise else 0.01)


def test_an_eccentric_circle_is_known_in_closed_form() -> None:
    """A circle of radius 40 about (0, 12): the centre of a roller of 8 is 48 from its middle."""
    turned = np.radians(np.arange(0, 360, 0.25))
    x, y = 43 * np.cos(turned), 12 + 43 * np.sin(turned)  # a probe of 3 mm
    lift = lift_from_profile(x, y, follower=cm.TranslatingRoller(8), probe_radius_mm=3)
    seen = np.radians(lift.angle_deg)
    wanted = 12 * np.cos(seen) + np.sqrt(48**2 - (12 * np.sin(seen)) ** 2)
    assert lift.position_mm == pytest.approx(wanted - 36, abs=1e-7)
    assert lift.prime_radius_mm == pytest.approx(36, abs=1e-7)
    face = lift_from_profile(x, y, follower=FLAT, probe_radius_mm=3)
    assert face.position_mm == pytest.approx(12 * (1 + np.cos(seen)), abs=1e-7)
    assert face.prime_radius_mm == pytest.approx(28, abs=1e-7)


def test_order_closing_point_and_sense_do_not_matter() -> None:
    cam = RollerCam(DIE, cm.TranslatingRoller(10, offset_mm=20), 160)
    points = cam.profile_mm(np.arange(0, 360, 0.5))
    lift = lift_from_profile(*points.T, follower=cam.follower)
    for other in (points[::-1], np.roll(points, 100, axis=0), np.vstack([points, points[:1]])):
        again = lift_from_profile(*other.T, follower=cam.follower)
        assert again.position_mm == pytest.approx(lift.position_mm, abs=1e-6)
    mirrored = lift_from_profile(
        -points[:, 0], points[:, 1], follower=cam.follower, clockwise=False
    )
    assert mirrored.position_mm == pytest.approx(lift.position_mm, abs=1e-9)


STEEP = RollerCam(
    cm.motion(
        "steep",
        cm.rise(50, over_deg=35),
        cm.dwell(100),
        cm.return_(50, over_deg=60, law="modified sine"),
        cm.dwell(165),
        start_deg=150,
    ),
    cm.TranslatingRoller(5, offset_mm=45),
    60,
)


def test_the_first_point_may_lie_on_a_flank_that_turns_back() -> None:
    """Seen from the axis the last points pass it, beside it: they were to be left out."""
    for first in (330, 345):
        points = np.roll(STEEP.cutter_mm(np.arange(720) / 2, 2), -first, axis=0)
        lift = lift_from_profile(*points.T, follower=STEEP.follower, probe_radius_mm=2, count=36)
        assert np.abs(off_um(lift, STEEP.motion)).max() < 0.01
    again = np.vstack([points, (points[:3] + points[1:4]) / 2])
    with pytest.raises(InputError, match=r"^The last 3 points .* over the first ones again"):
        lift_from_profile(*again.T, follower=STEEP.follower, probe_radius_mm=2)


def test_an_arm_keeps_its_pivot_whichever_way_the_cam_turns() -> None:
    """The same steel, turned the other way, lifts it as before, but in the other order."""
    arm = cm.SwingingRoller(10, arm_mm=100, pivot_mm=110)
    points = RollerCam(DIE, arm, 80).profile_mm(np.arange(0, 360, 0.5))
    one, other = (
        lift_from_profile(*points.T, follower=arm, clockwise=way) for way in (True, False)
    )
    assert other.position_mm == pytest.approx(np.roll(one.position_mm[::-1], 1), abs=1e-6)


@pytest.mark.parametrize("number", range(10))  # more are drawn in tests/fresh
def test_motions_of_drawn_machines_come_back(number: int) -> None:
    profiles(draw("profile", number))


def let_down(profile: Array, radius: float, angles: Array) -> Array:
    """Return where the centre of a disc of that radius is, let down on a profile by hand."""
    turned = np.exp(1j * np.radians(angles))
    surface = profile @ [1, 1j]
    centres = []
    for turn in turned:
        seen = surface / turn
        under = seen[np.abs(seen.real) < radius]
        centres.append(1j * (under.imag + np.sqrt(radius**2 - under.real**2)).max() * turn)
    return np.stack([np.real(centres), np.imag(centres)], axis=-1)


HEART = cm.motion("heart", cm.rise(30, over_deg=50), cm.return_(30, over_deg=50), cm.dwell(260))


def test_a_hollow_that_the_probe_does_not_reach_is_refused() -> None:
    cam = RollerCam(HEART, cm.TranslatingRoller(4), 60)
    profile = cam.profile_mm(np.linspace(0, 360, 40_000))
    angles, radius = np.arange(0, 360, 0.5), cam.hollowest.value - 4
    good = let_down(profile, 0.8 * radius, angles)
    lift = lift_from_profile(*good.T, follower=cam.follower, probe_radius_mm=0.8 * radius)
    assert np.abs(off_um(lift, HEART)).max() < 20
    large = let_down(profile, 2 * radius, angles)
    with pytest.raises(InputError, match=r"a kink inwards at .*smaller probe"):
        lift_from_profile(*large.T, follower=cam.follower, probe_radius_mm=2 * radius)


def test_a_hollow_that_the_roller_does_not_reach_is_refused() -> None:
    cam = RollerCam(HEART, cm.TranslatingRoller(4), 60)
    points = cam.profile_mm(np.arange(0, 360, 0.5))
    for large in (cm.TranslatingRoller(90), cm.TranslatingRoller(150)):
        with pytest.raises(
            InputError, match=r"hollow .* into which the follower does not reach|off"
        ):
            lift_from_profile(*points.T, follower=large)
    with pytest.raises(InputError, match=r"a hollow or a flat at .* does not reach"):
        lift_from_profile(*points.T, follower=FLAT)


CIRCLE, FINER = (np.exp(1j * np.radians(np.arange(0, 360, step))) for step in (4.0, 2.5))
REFUSED: list[tuple[Any, str]] = [
    (50 * CIRCLE[::3], "has 30 points; at least 36"),
    (50 * CIRCLE + 80, "go 0 times round the axis"),
    (50 * CIRCLE - 50, "go 0 times round the axis"),  # a point lies on it
    (50 * np.exp(2j * np.angle(CIRCLE)) + 20 * CIRCLE, "go 2 times round the axis"),
    (50 * CIRCLE[:60], "leave 124 deg out after position 59"),
    (50 * np.delete(FINER, range(40, 44)), r"leave 12\.5 deg out after position 39"),
    (50 * np.insert(CIRCLE, 7, CIRCLE[6]), "at positions 6 and 7 are one"),
    (
        50 * CIRCLE * np.where(np.arange(90) == 40, 1.02, 1),
        "The point at 70 deg of cam angle lies about 1 mm off",
    ),
    (
        50 * CIRCLE[[*range(30), 34, 33, 32, 31, *range(35, 90)]],
        "leave 20 deg out after position 29.* put them in order",
    ),
    (
        50 * CIRCLE[[*range(90), 0, 1]],
        "^The last 2 points .* over the first ones again: leave them",
    ),
    (50 * CIRCLE[[*range(90), 0]] * np.exp(1e-3j * (np.arange(91) == 90)), "^The last point goes"),
    (50 * CIRCLE[[*range(7), *range(5, 90)]], "at positions 5 and 7 are one"),
    ([math.nan, *50 * CIRCLE[1:]], "^The coordinate of a point of the profile is nan"),
]


@pytest.mark.parametrize(("points", "said"), REFUSED, ids=[said for _, said in REFUSED])
@pytest.mark.parametrize("follower", [cm.TranslatingRoller(10), FLAT])
def test_points_of_no_cam_are_refused(points: Any, said: str, follower: Any) -> None:
    with pytest.raises(InputError, match=said):
        lift_from_profile(np.real(points), np.imag(points), follower=follower)


def test_a_flat_face_is_one_in_any_case() -> None:
    x, y = 50 * CIRCLE.real, 50 * CIRCLE.imag
    lifts = [lift_from_profile(x, y, follower=face) for face in (FLAT, "Flat Face")]
    assert lifts[0] == lifts[1]


@pytest.mark.parametrize("follower", [FLAT, cm.TranslatingRoller(15)])
@pytest.mark.parametrize("probe", [30, 40])
def test_a_probe_inside_of_which_no_cam_is_left(follower: Any, probe: float) -> None:
    """Its centres go round on 30 mm: a circle of -10 mm was returned."""
    x, y = 30 * CIRCLE.real, 30 * CIRCLE.imag
    with pytest.raises(InputError, match="leaves a cam whose radius would be -"):
        lift_from_profile(x, y, follower=follower, probe_radius_mm=probe)
    smaller = lift_from_profile(x, y, follower=follower, probe_radius_mm=29)
    roller = 0 if follower == FLAT else 15
    assert smaller.prime_radius_mm - roller == pytest.approx(1, abs=1e-3)


@pytest.mark.parametrize(("clockwise", "told"), [(True, 40), (False, 320)])
@pytest.mark.parametrize(
    "follower", [cm.TranslatingRoller(10), cm.SwingingRoller(10, arm_mm=80, pivot_mm=120)]
)
def test_a_point_is_told_by_the_cam_angle_at_which_it_is_above_the_axis(
    follower: Any, clockwise: bool, told: int
) -> None:
    """An arm's cam that turns the other way counted against its own cam angles."""
    angles = np.arange(0, 360.0, 2)
    points = 50 * np.exp(1j * np.radians(angles + 90))
    points[20] *= 1.01  # 40 deg against the clock from the top
    with pytest.raises(InputError, match=rf"The point at {told} deg of cam angle lies about"):
        lift_from_profile(points.real, points.imag, follower=follower, clockwise=clockwise)


def test_what_is_given_wrongly() -> None:
    x, y = 50 * CIRCLE.real, 50 * CIRCLE.imag
    with pytest.raises(InputError, match="arrays of shape"):
        lift_from_profile(x, y[1:], follower=FLAT)
    with pytest.raises(InputError, match="follower is 'round'"):
        lift_from_profile(x, y, follower="round")
    with pytest.raises(InputError, match="radius of the probe is -1"):
        lift_from_profile(x, y, follower=FLAT, probe_radius_mm=-1)
    with pytest.raises(InputError, match="count of angles is 3"):
        lift_from_profile(x, y, follower=FLAT, count=3)
    with pytest.raises(InputError, match="cannot be 60 mm off the axis"):
        lift_from_profile(x, y, follower=cm.TranslatingRoller(10, offset_mm=70))
    with pytest.raises(InputError, match="cannot be 60 mm off the axis"):
        lift_from_profile(x, y, follower=cm.SwingingRoller(10, arm_mm=20, pivot_mm=200))


@pytest.mark.parametrize("window", [2, 5, 13])
def test_normals_over_more_points_scatter_as_those_of_parabolas_do(window: int) -> None:
    """The slope of a least-squares parabola in its middle is that of a straight line."""
    angles, noise = np.radians(np.arange(0, 360, 0.5)), 1e-3
    points = 100 * np.exp(1j * angles) + noisy(np.zeros((720, 2)), noise) @ [1, 1j]
    turned = np.angle(Traced(points, 0, "flat face")._tangents(window) / (1j * np.exp(1j * angles)))
    places = 100 * math.radians(0.5) * np.arange(-window, window + 1)
    assert np.std(turned) == pytest.approx(noise / math.sqrt(np.sum(places**2)), rel=0.15)
