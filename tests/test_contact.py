"""A follower that leaves its cam: closed forms, published cases, and integration step by step."""

import math
import time
from typing import Any

import numpy as np
import pytest
import sympy as sp
from fresh.check_contacts import compare, integrated

import cammotion as cm

IN, LB, G = 25.4, 4.4482216152605, 386.0  # mm, N; in/s²
CYCLOID = cm.motion(
    "f", cm.rise(10, over_deg=120), cm.dwell(30), cm.return_(10, over_deg=120), cm.dwell(90)
)
EXAM = cm.FollowerLoad(mass_kg=1.8, stiffness_N_per_mm=15, preload_N=37.5)
RPM = 60


def made(law: str | cm.MotionLaw = "cycloidal") -> cm.Motion:
    """Return a rise and a return of 20 mm with two dwells, of any law."""
    return cm.motion(
        "f",
        cm.rise(20, over_deg=70, law=law),
        cm.dwell(50),
        cm.return_(20, over_deg=100, law=law),
        cm.dwell(140),
        start_deg=35,
    )


@pytest.mark.parametrize(
    ("law", "stiffness", "bounce"),
    [
        ("cycloidal", 0.0, 0.0),
        ("cycloidal", 1.5, 0.5),
        ("constant acceleration", 1.5, 0.0),
        ("modified sine", 0.0, 0.5),
    ],
)
def test_flights_against_integration(law: str, stiffness: float, bounce: float) -> None:
    load = cm.FollowerLoad(mass_kg=4, stiffness_N_per_mm=stiffness, preload_N=30, weight_N=8)
    rate = 1.6 * load.lift_off_rate(made(law))
    found = cm.follower_flights(made(law), load, rate, turns=1, restitution=bounce)
    assert len(found) >= 1
    compare(found, integrated(made(law), load, rate, bounce, 1), 20)


def test_it_leaves_above_the_rate_at_which_it_does_and_not_below() -> None:
    rate = EXAM.lift_off_rate(CYCLOID)
    assert rate / RPM == pytest.approx(779.8, abs=0.05)
    assert not len(cm.follower_flights(CYCLOID, EXAM, rate * (1 - 1e-9)))
    for above in (2e-5, 1e-3):
        found = cm.follower_flights(CYCLOID, EXAM, rate * (1 + above))
        assert len(found) == 6  # in each turn on the rise and on the return
        assert found[0].leaves_at_deg == pytest.approx(88, abs=5)
    assert not len(cm.follower_flights(CYCLOID, EXAM, rate * (1 + 1e-7)))  # 1e-14 mm high


def test_the_exam_question_without_an_answer() -> None:
    """At 1000 rpm and 100 deg, where a force is asked for, the follower is in the air."""
    found = cm.follower_flights(CYCLOID, EXAM, 1000 * RPM)
    assert EXAM.force_N(CYCLOID, 100, 1000 * RPM) == pytest.approx(-61.69, abs=5e-3)
    assert found[0].leaves_at_deg < 100 < found[0].lands_at_deg
    assert found.force_N(100) == 0
    assert found.gap_mm(100) > 0
    assert found.position_mm(100) == pytest.approx(CYCLOID.position_mm(100) + found.gap_mm(100))
    compare(found, integrated(CYCLOID, EXAM, 1000 * RPM, 0), 10)


def test_another_exam_question_with_its_damper() -> None:
    """3-4-5, 10 rad/s, 7.5 kg, 10 N and 100 N/m: -6.617 N; with 2.74 N s/m the -6.471 N known."""
    law = "3-4-5 polynomial"
    motion = cm.motion(
        "f",
        cm.rise(10, over_deg=90, law=law),
        cm.dwell(45),
        cm.return_(10, over_deg=180, law=law),
        cm.dwell(45),
    )
    load, rate = cm.FollowerLoad(mass_kg=7.5, stiffness_N_per_mm=0.1, preload_N=10), 18000 / math.pi
    least = load.least_force(motion, rate)
    assert least == pytest.approx((-6.617, 70.861), abs=1e-3)
    at = np.linspace(0, 90, 90001)
    damped = load.force_N(motion, at, rate) + 2.74 * motion.derivative(1, at, rate)
    assert damped.min() == pytest.approx(-6.471, abs=5e-4)
    assert at[damped.argmin()] == pytest.approx(71.0, abs=0.01)
    torque = damped * motion.derivative(1, at, rate) / 10
    assert torque.max() == pytest.approx(0.22696, abs=5e-6)


def test_rothbart_figure_8_7() -> None:
    """P = 3: 1/4 of the rise in 40 deg, the rest in 120; loads in lb as printed, 20,250 in/s²."""
    x = cm.x
    skew = cm.MotionLaw(
        "parabola, p = 3",
        sp.Piecewise(
            (4 * x**2, x <= sp.Rational(1, 4)), (1 - sp.Rational(4, 3) * (1 - x) ** 2, True)
        ),
    )
    motion = cm.motion(
        "f",
        cm.rise(1.25 * IN, over_deg=160, law=skew),
        cm.dwell(20),
        cm.return_(1.25 * IN, over_deg=160),
        cm.dwell(20),
    )
    load = cm.FollowerLoad(
        mass_kg=2 * LB / (G * IN / 1000),
        stiffness_N_per_mm=51.2 * LB / IN,
        preload_N=14 * LB,
        weight_N=12 * LB,
    )
    rate, near = 1200 * RPM, 1e-6
    up = motion.derivative(2, 20, rate) * 1000 / IN
    assert up == pytest.approx(20_250)  # print has 20,200
    seen = [load.standing_N(0) / LB]
    for at in (near, 40 - near, 40 + near, 160 - near):
        seen.append(load.force_N(motion, at, rate) / LB)
    seen.append(load.standing_N(1.25 * IN) / LB)
    assert seen == pytest.approx([26, 130.9, 146.9, 7.0, 55.0, 90], abs=0.05)
    spring = load.stiffness_N_per_mm * 1.25 * IN + load.preload_N
    assert spring / LB == pytest.approx(78)
    assert (load.force_N(motion, 40 + near, rate) - 30 * LB) / LB == pytest.approx(-23, abs=0.03)
    rise_alone = 1200 * math.sqrt(42 / (6750 * 2 / G))
    assert rise_alone == pytest.approx(1315, abs=0.2)
    slow = cm.motion(
        "f",
        cm.rise(1.25 * IN, over_deg=160, law=skew),
        cm.return_(1.25 * IN, over_deg=200, law=skew.reversed()),
    )
    assert load.lift_off_rate(slow) / RPM == pytest.approx(min(1315.1, 1315.1 * 200 / 160), abs=0.1)


def test_a_flight_without_a_spring_is_a_throw() -> None:
    """Constant acceleration up to the middle: thrown there at 2 hm/tm, landed on the dwell."""
    motion, rate = made("constant acceleration"), 8000
    load = cm.FollowerLoad(mass_kg=2, weight_N=2 * 9.81)
    tm = 70 / 360 * 3600 / rate
    speed, fall = 2 * 0.020 / tm, 9.81
    top = 0.010 + speed**2 / (2 * fall)
    lands = speed / fall + math.sqrt(2 * (top - 0.020) / fall)
    (first, *_) = cm.follower_flights(motion, load, rate)
    assert first.leaves_at_deg == pytest.approx(35 + 35)
    assert first.lands_at_deg == pytest.approx(70 + lands * rate / 10, abs=1e-9)
    assert first.lands_at_deg < 35 + 120  # on the upper dwell
    assert first.impact_m_per_s == pytest.approx(math.sqrt(2 * fall * (top - 0.020)), rel=1e-12)


@pytest.mark.parametrize("preload", [1.0, 30.0])
def test_a_flight_over_many_turns_is_a_throw_too(preload: float) -> None:
    """It was stepped over turn by turn, and too far away it could not arrive."""
    die, turn_s = cm.EXAMPLE.die, 0.1
    load, began = cm.FollowerLoad(mass_kg=12, preload_N=preload), time.perf_counter()
    found = cm.follower_flights(die, load, 36000)
    assert time.perf_counter() - began < 2
    (flight,) = found
    start, pull = flight.leaves_at_deg, 1000 * preload / 12
    speed = die.derivative(1, start, 36000) * 1000

    def over(angle: Any) -> Any:
        since = (angle - start) / 360 * turn_s
        thrown = die.position_mm(start) + speed * since - pull * since**2 / 2
        return thrown - die.position_mm(angle)

    lands = flight.lands_at_deg
    assert lands - start > 360 * 50
    assert over(lands) == pytest.approx(0, abs=1e-6)
    assert np.all(over(np.linspace(lands - 720, lands - 1e-3, 20001)) > 0)
    top = start + speed / pull / turn_s * 360
    about = over(np.linspace(top - 360, top + 360, 20001)).max()
    assert flight.gap_mm == pytest.approx(about, rel=1e-6)


@pytest.mark.parametrize("preload", [0.2, 0.24])  # the error, and half of the gap
def test_the_gap_of_a_flight_that_a_rising_cam_ends_before_its_top(preload: float) -> None:
    low, high = (
        (cm.rise(h, over_deg=b), cm.return_(h, over_deg=b)) for h, b in ((10, 60), (100, 80))
    )
    lifter = cm.motion("f", *low, cm.dwell(20), *high, cm.dwell(60))
    first = cm.follower_flights(lifter, cm.FollowerLoad(mass_kg=1, preload_N=preload), 6000)[0]
    at = np.linspace(first.leaves_at_deg, first.lands_at_deg, 10_001)
    since = (at - at[0]) / 600  # s
    thrown = lifter.position_mm(at[0]) + 1000 * lifter.derivative(1, at[0], 6000) * since
    gaps = thrown - 500 * preload * since**2 - lifter.position_mm(at)
    assert gaps[-1] == pytest.approx(0, abs=1e-6)
    assert first.gap_mm == pytest.approx(gaps.max(), rel=1e-6)


@pytest.mark.parametrize("rate", [36000, 360000])
def test_a_follower_that_hardly_anything_presses_is_refused_soon(rate: float) -> None:
    began = time.perf_counter()
    with pytest.raises(cm.InputError, match=r"leaves its cam at .* flies for .* turns, so weakly"):
        cm.follower_flights(cm.EXAMPLE.die, cm.FollowerLoad(mass_kg=12, preload_N=0.01), rate)
    assert time.perf_counter() - began < 2


def test_energy_is_kept_in_flight() -> None:
    load = cm.FollowerLoad(mass_kg=3, stiffness_N_per_mm=0.8, preload_N=25, weight_N=-5)
    rate = 2 * load.lift_off_rate(made())
    found = cm.follower_flights(made(), load, rate)

    def energy(at: float, speed: float) -> float:
        lift = float(made().position_mm(at)) / 1000
        return 1.5 * speed**2 + 400 * lift**2 + 20 * lift

    for flight in found:
        first = float(made().derivative(1, flight.leaves_at_deg, rate))
        last = float(made().derivative(1, flight.lands_at_deg, rate)) - flight.impact_m_per_s
        before = energy(flight.leaves_at_deg, first)
        assert energy(flight.lands_at_deg, last) == pytest.approx(before, rel=1e-10)


def test_bounces_come_to_rest_and_it_is_said() -> None:
    """On a dwell each bounce is so much smaller, and all of them last as a series says."""
    motion, rate = made("constant acceleration"), 14_000
    load = cm.FollowerLoad(mass_kg=2, preload_N=60)
    found = cm.follower_flights(motion, load, rate, turns=1, restitution=0.4)
    first = found[0]
    assert first.lands_at_deg < 35 + 120
    end = first.lands_at_deg + 2 * 0.4 * first.impact_m_per_s / 30 / 0.6 * rate / 10
    assert found.stuck_at_deg[0] == pytest.approx(end, abs=1e-3)
    bounces = [f for f in found if f.lands_at_deg <= found.stuck_at_deg[0]]
    impacts = np.array([f.impact_m_per_s for f in bounces])
    assert impacts[1:6] / impacts[:5] == pytest.approx(0.4, rel=1e-9)
    assert f"first at {found.stuck_at_deg[0]:.6g} deg" in str(found)


def test_a_ball_that_loses_nothing_bounces_on() -> None:
    flat = made("constant acceleration")
    load = cm.FollowerLoad(mass_kg=2, preload_N=60)
    found = cm.follower_flights(flat, load, 14_000, turns=4, restitution=1)
    assert len(found) > 6
    assert not found.stuck_at_deg
    assert all(a.lands_at_deg == b.leaves_at_deg for a, b in zip(found, [*found][1:], strict=False))
    chattering = cm.follower_flights(flat, load, 14_000, turns=3, restitution=0.999)
    assert len(chattering) < 4000


def test_what_repeats() -> None:
    load = cm.FollowerLoad(mass_kg=4, stiffness_N_per_mm=1, preload_N=30)
    rate = 1.3 * load.lift_off_rate(made())
    found = cm.follower_flights(made(), load, rate, turns=4)
    assert found.period == 1
    assert len(found.last_turn) == len(found) // 4
    assert found.begins_at_deg == 35
    slow = cm.follower_flights(made(), load, rate / 2)
    assert (len(slow), slow.period) == (0, 1)
    assert "does not leave its cam" in str(slow)
    wild = cm.follower_flights(made(), load, 4 * rate, turns=6, restitution=0.8)
    assert wild.period is None


@pytest.mark.parametrize("turns", [-3, 28_000, 1_000_000])
def test_flights_are_the_same_however_many_turns_on(turns: int) -> None:
    load = cm.FollowerLoad(mass_kg=4, preload_N=30, weight_N=8)
    rate, back = 1.6 * load.lift_off_rate(made()), turns * 360
    near = cm.follower_flights(made(), load, rate, restitution=0.5)
    far = cm.follower_flights(made().shifted(back), load, rate, restitution=0.5)
    assert (far.begins_at_deg, far.period) == (35 + back, near.period)
    ends = np.array([flight[:2] for flight in near]) + back
    assert np.array([flight[:2] for flight in far]) == pytest.approx(ends, rel=1e-15)
    assert [flight[2:] for flight in far] == [flight[2:] for flight in near]
    assert far.stuck_at_deg == pytest.approx([at + back for at in near.stuck_at_deg], rel=1e-15)
    assert far.stuck_at_deg
    for at in near[0].leaves_at_deg + np.array([1, 5]):
        assert far.gap_mm(at + back) == pytest.approx(near.gap_mm(at), abs=1e-6)


def test_on_the_cam_force_and_place_are_the_cams() -> None:
    load = cm.FollowerLoad(mass_kg=4, stiffness_N_per_mm=1, preload_N=30)
    rate = 1.5 * load.lift_off_rate(made())
    found = cm.follower_flights(made(), load, rate)
    at = np.linspace(35, 35 + 3 * 360, 20_001)
    air = np.zeros(at.shape, bool)
    for leaves, lands, *_ in found:
        air |= (at > leaves) & (at < lands)
    assert np.all(found.gap_mm(at)[air] > 0)
    assert np.all(found.gap_mm(at)[~air] == 0)
    assert np.all(found.force_N(at)[air] == 0)
    assert found.force_N(at)[~air] == pytest.approx(load.force_N(made(), at[~air], rate))
    assert np.all(found.force_N(at) >= -1e-6)
    for flight in found:
        assert found.gap_mm(np.linspace(flight[0], flight[1], 5001)).max() == pytest.approx(
            flight.gap_mm
        )
    with pytest.raises(cm.InputError, match="at most 1115 deg"):
        found.gap_mm(1200)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"motion": "die"}, "motion='die': give a motion"),
        ({"motion": cm.EXAMPLE.mill}, "moves on from stop to stop"),
        ({"motion": made(cm.MotionLaw("line", cm.x))}, "has a velocity that jumps"),
        ({"load": 12}, "load=12: give a FollowerLoad"),
        ({"load": cm.FollowerLoad(mass_kg=2)}, "with 0 N, .* give a preload above 0 N"),
        (
            {"load": cm.FollowerLoad(mass_kg=2, preload_N=5, weight_N=-19.6)},
            "with -14.6 N, .* above 19.6 N",
        ),
        ({"rate_per_hour": 0}, "machine rate is 0"),
        ({"turns": 0}, "number of turns is 0"),
        ({"restitution": 1.2}, "restitution is 1.2"),
    ],
)
def test_what_is_refused(given: dict[str, Any], words: str) -> None:
    whole: dict[str, Any] = {"motion": made(), "load": EXAM, "rate_per_hour": 2000} | given
    motion, load, rate = (whole.pop(name) for name in ("motion", "load", "rate_per_hour"))
    with pytest.raises(cm.InputError, match=words):
        cm.follower_flights(motion, load, rate, **whole)
