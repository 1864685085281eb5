"""The force between follower and cam, against closed forms and published cases."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from machines import Array

import cammotion as cm

CYCLOID = cm.motion(
    "f", cm.rise(10, over_deg=120), cm.dwell(30), cm.return_(10, over_deg=120), cm.dwell(90)
)
EXAM = cm.FollowerLoad(mass_kg=1.8, stiffness_N_per_mm=15, preload_N=2.5 * 15)


def by_hand(load: cm.FollowerLoad, rate: float, at: Array) -> Array:
    """Return mass times acceleration and the spring, from the cycloid's own formulas."""
    x, tm = at / 120, 3600 / rate / 3
    a = 2 * math.pi * 0.010 / tm**2 * np.sin(2 * math.pi * x)
    s = 10 * (x - np.sin(2 * math.pi * x) / (2 * math.pi))
    return load.mass_kg * a + load.stiffness_N_per_mm * s + load.preload_N + load.weight_N


def test_an_exam_question_without_an_answer() -> None:
    """1000 rpm, at 100 deg: -61.69 N, so that the follower has left; it does from 779.8 on."""
    assert EXAM.force_N(CYCLOID, 100, 60 * 1000) == pytest.approx(-61.69, abs=5e-3)
    assert EXAM.lift_off_rate(CYCLOID) / 60 == pytest.approx(779.8, abs=0.05)


@pytest.mark.parametrize("weight", [0, 17.66, -17.66])
def test_forces_of_a_cycloid(weight: float) -> None:
    load = cm.FollowerLoad(mass_kg=1.8, stiffness_N_per_mm=15, preload_N=37.5, weight_N=weight)
    at = np.linspace(0.01, 119.99, 24001)
    expected = by_hand(load, 50_000, at)
    assert load.force_N(CYCLOID, at, 50_000) == pytest.approx(expected)
    least = load.least_force(CYCLOID, 50_000)
    assert least.value == pytest.approx(float(expected.min()), abs=1e-3)
    mirrored = min(least.at_deg, 270 - least.at_deg)  # the return is the rise's mirror image
    assert mirrored == pytest.approx(float(at[expected.argmin()]), abs=0.02)


def test_a_spring_as_it_is_needed_just_keeps_contact() -> None:
    preload = EXAM.needed_preload_N(CYCLOID, 60_000)
    kept = cm.FollowerLoad(mass_kg=1.8, stiffness_N_per_mm=15, preload_N=preload)
    assert kept.least_force(CYCLOID, 60_000).value == pytest.approx(0, abs=1e-9)
    assert kept.lift_off_rate(CYCLOID) == pytest.approx(60_000)
    assert EXAM.needed_preload_N(CYCLOID, 100) == 0


def test_a_light_follower_under_a_third_of_a_newton() -> None:
    """It leaves where mass times 2 pi h/tm² is the preload, and the move is a third of a turn."""
    tm = math.sqrt(2 * math.pi * 0.010 * 0.01 / 0.3)
    load = cm.FollowerLoad(mass_kg=0.01, preload_N=0.3)
    assert load.lift_off_rate(CYCLOID) == pytest.approx(3600 / (3 * tm))


@pytest.mark.parametrize("times", [1e-15, 1e9])
def test_a_follower_of_another_size_leaves_at_the_same_rate(times: float) -> None:
    """Mass and spring so many times as large: below 1e-12 N a force counted as so much."""
    usual = cm.FollowerLoad(mass_kg=12, preload_N=10, stiffness_N_per_mm=0.1)
    other = cm.FollowerLoad(
        mass_kg=12 * times, preload_N=10 * times, stiffness_N_per_mm=0.1 * times
    )
    assert other.lift_off_rate(CYCLOID) == pytest.approx(usual.lift_off_rate(CYCLOID))


def test_a_follower_that_nothing_holds_leaves_at_once() -> None:
    assert cm.FollowerLoad(mass_kg=1).lift_off_rate(CYCLOID) == 0
    assert cm.FollowerLoad(mass_kg=1, weight_N=-20, preload_N=10).lift_off_rate(CYCLOID) == 0
    flat = cm.motion("f", cm.dwell(360))
    assert cm.FollowerLoad(mass_kg=1, preload_N=1).lift_off_rate(flat) == math.inf


def test_a_follower_that_does_not_rest_in_a_dwell_has_no_rate() -> None:
    """Where it does not rest on its cam nothing has to pull it off: the dwell is enough."""
    load = cm.FollowerLoad(mass_kg=1, stiffness_N_per_mm=1, weight_N=-10)
    risen = cm.motion(
        "m", cm.rise(50, over_deg=90), cm.dwell(90), cm.return_(50, over_deg=90), cm.dwell(90)
    )
    assert load.least_force(risen, 1).value == pytest.approx(-10)
    assert load.lift_off_rate(risen) == 0
    assert load.lift_off_rate(cm.motion("s", cm.dwell(360))) == 0


ASKED: list[Callable[..., object]] = [
    lambda load, motion: load.lift_off_rate(motion),
    lambda load, motion: load.needed_preload_N(motion, 3600),
    lambda load, motion: load.least_force(motion, 36_000),
    lambda load, motion: load.where_loose(motion, 36_000),
]


@pytest.mark.parametrize("asked", ASKED)
def test_a_velocity_that_jumps_takes_any_follower_off(asked: Callable[..., object]) -> None:
    law = cm.CONSTANT_VELOCITY
    jumping = cm.motion(
        "m", cm.rise(9, over_deg=180, law=law), cm.return_(9, over_deg=180, law=law)
    )
    with pytest.raises(cm.InputError, match=r"velocity of 'm' jumps .at 0 deg.*infinite"):
        asked(cm.FollowerLoad(mass_kg=1, preload_N=10), jumping)


@pytest.mark.parametrize("asked", [*ASKED, lambda load, motion: load.force_N(motion, 750, 3600)])
def test_no_spring_goes_with_a_turret(asked: Callable[..., object]) -> None:
    """Its force would grow from turn to turn; without a spring there is a force of the mass."""
    assert asked(cm.FollowerLoad(mass_kg=12, weight_N=5), cm.EXAMPLE.mill) is not None
    with pytest.raises(cm.InputError, match="'mill' moves on from stop to stop, and no spring"):
        asked(EXAM, cm.EXAMPLE.mill)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"mass_kg": 0}, "mass of the follower is 0 kg"),
        ({"mass_kg": -2}, "mass of the follower is -2 kg"),
        ({"mass_kg": 1, "stiffness_N_per_mm": -1}, "stiffness of the spring is -1 N/mm"),
        ({"mass_kg": 1, "preload_N": -1}, "preload of the spring is -1 N"),
        ({"mass_kg": "heavy"}, "mass of the follower has to be a number"),
    ],
)
def test_bad_loads(given: dict[str, float], said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.FollowerLoad(**given)


def test_hertz_between_steel_cylinders() -> None:
    """The textbook's 0.418 times the root of F E / b and the sum of the curvatures."""
    for radius in (60.0, -30.0):
        curvature = 1 / 10 + 1 / radius
        textbook = 0.418 * math.sqrt(500 * 210_000 / 12 * curvature)
        pressure = cm.hertz_pressure(500, radius, roller_radius_mm=10, width_mm=12)
        assert pressure == pytest.approx(textbook, rel=1e-3)
    assert cm.hertz_pressure([-5, 0], 60, roller_radius_mm=10, width_mm=12).tolist() == [0, 0]
    straight = cm.hertz_pressure(500, 1e12, roller_radius_mm=10, width_mm=12)
    for flat in (math.inf, -math.inf):  # as profile_radius_mm says of a straight flank
        both = cm.hertz_pressure([500, 0], [flat, -9], roller_radius_mm=10, width_mm=12)
        assert both == pytest.approx([straight, 0])
    with pytest.raises(cm.InputError, match="profile is nan"):
        cm.hertz_pressure(500, [math.inf, math.nan], roller_radius_mm=10, width_mm=12)
    assert straight == pytest.approx(0.418 * math.sqrt(500 * 210_000 / 120), rel=1e-3)
    with pytest.raises(cm.InputError, match="-9 mm, which the roller of 10 mm cannot touch"):
        cm.hertz_pressure(500, [60, -9], roller_radius_mm=10, width_mm=12)
