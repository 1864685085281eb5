"""The indexer, against the worked example, closed forms, dense samples and a table set free."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp
from long_arrays import assert_near
from machines import HALF
from scipy.integrate import quad

import cammotion as cm

NAMES = list(cm.LAWS)
X = np.linspace(0, 1, 20001)


def table(law: str | cm.MotionLaw = "modified sine", **more: float) -> cm.Indexer:
    return cm.Indexer(38.5, stops=8, time_s=0.75, law=law, **more)


def test_the_worked_example_to_its_printed_digits() -> None:
    """The source takes Am = 5.53; the law's own factor is 4 pi^2/(4 + pi)."""
    rounded, exact = 5.53, 4 * math.pi**2 / (4 + math.pi)
    found = table(friction_N_m=10)
    alpha = (math.pi / 4) / 0.75**2
    assert f"{alpha * rounded:.3f}" == "7.721"
    assert f"{38.5 * alpha * rounded:.3f}" == "297.271"
    assert found.peak_acceleration_rad_per_s2 == pytest.approx(alpha * exact, rel=1e-12)
    assert found.inertia_torque_N_m * rounded / exact == pytest.approx(297.2715, abs=1e-4)
    assert f"{found.peak_torque_N_m:.3f}" == "307.162"
    assert cm.Indexer(38.5, 8, 0.75, friction_N_m=10, safety=1.5).required_torque_N_m == (
        pytest.approx(1.5 * (38.5 * alpha * exact + 10))
    )


def test_another_makers_rotary_table() -> None:
    """CODESYS: 8 stops in 2000 ms, of which the index takes 400 ms; modified sine 27.135 rad/s2."""
    assert f"{cm.Indexer(1, 8, 0.4).peak_acceleration_rad_per_s2:.3f}" == "27.135"


@pytest.mark.parametrize("name", NAMES)
def test_torque_and_power_are_the_law_scaled(name: str) -> None:
    law, found = cm.LAWS[name], table(name, friction_N_m=10, work_N_m=4)
    step, drag = math.pi / 4, 14
    omega, alpha = law(X, 1) * step / 0.75, law(X, 2) * step / 0.75**2
    assert_near(found.velocity_rad_per_s(X), omega, rel=1e-6)
    assert_near(found.torque_N_m(X), 38.5 * alpha + drag, rel=1e-6)
    assert_near(found.power_W(X), (38.5 * alpha + drag) * omega, rel=1e-6)
    assert found.peak_torque_N_m == pytest.approx(38.5 * law.Ca * step / 0.75**2 + drag)
    assert found.peak_power_W == pytest.approx(found.power_W(X).max(), rel=1e-6)
    assert found.peak_power_W >= found.power_W(X).max() * (1 - 1e-12)
    assert found.peak_velocity_rad_per_s == pytest.approx(omega.max(), rel=1e-7)


@pytest.mark.parametrize("name", NAMES)
def test_without_friction_the_power_is_cq(name: str) -> None:
    found = table(name)
    known = 38.5 * (math.pi / 4) ** 2 / 0.75**3 * cm.LAWS[name].Cq
    assert found.peak_power_W == pytest.approx(known, rel=1e-9)


def test_cq_of_the_cycloid_by_hand() -> None:
    """V A = 2 pi (1 - cos u) sin u is largest at u = 120 deg: 2 pi 3 sqrt(3)/4."""
    known = 38.5 * (math.pi / 4) ** 2 / 0.75**3 * 2 * math.pi * 3 * math.sqrt(3) / 4
    assert table("cycloidal").peak_power_W == pytest.approx(known)


def test_the_camshaft_gives_the_power_of_the_table() -> None:
    found = table(friction_N_m=10)
    shaft = math.radians(150) / 0.75
    assert_near(found.camshaft_torque_N_m(X, 150) * shaft, found.power_W(X), rel=1e-6)
    assert found.peak_camshaft_torque_N_m(150) == pytest.approx(found.peak_power_W / shaft)
    work = np.trapezoid(found.camshaft_torque_N_m(X, 150), X) * math.radians(150)
    assert work == pytest.approx(10 * math.pi / 4)  # friction alone takes energy


def test_the_energy_is_what_the_first_half_puts_in() -> None:
    found = table("cycloidal")
    half = X[X <= 0.5]
    put_in = np.trapezoid(found.power_W(half), half) * 0.75
    assert found.kinetic_energy_J == pytest.approx(put_in, rel=1e-6)


@pytest.mark.parametrize(
    ("name", "mean_square"),
    [
        ("cycloidal", 2 * math.pi**2),
        ("constant acceleration", 16),
        ("simple harmonic", math.pi**4 / 8),
        ("cubic", 12),
        ("3-4-5 polynomial", 120 / 7),
    ],
)
def test_the_rms_torque_in_closed_form(name: str, mean_square: float) -> None:
    alpha = 38.5 * math.pi / 4 / 0.75**2
    known = math.sqrt((alpha**2 * mean_square + 10**2) * 0.75 / 1.8)
    assert table(name, friction_N_m=10).rms_torque_N_m(1.8) == pytest.approx(known, rel=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_the_rms_torque_by_integration(name: str) -> None:
    law, found = cm.LAWS[name], table(name, friction_N_m=10)
    joints = [piece.low for piece in law.curve.pieces[1:]]
    total = quad(lambda x: found.torque_N_m(x) ** 2, 0, 1, points=joints, limit=200)[0]
    assert found.rms_torque_N_m(0.75) == pytest.approx(math.sqrt(total), rel=1e-9)


def test_the_torque_turns_where_friction_no_longer_brakes_enough() -> None:
    assert table("cycloidal").braking[0] == pytest.approx((0.5, 1.0))
    per_a = 38.5 * math.pi / 4 / 0.75**2
    ((start, end),) = table("cycloidal", friction_N_m=100).braking
    angle = math.asin(100 / (per_a * 2 * math.pi))
    assert start == pytest.approx(0.5 + angle / (2 * math.pi))
    assert end == pytest.approx(1 - angle / (2 * math.pi))
    assert table("cycloidal", friction_N_m=400).braking == []
    assert table("cycloidal", friction_N_m=400).impact_rad_per_s(0.02) == 0


@pytest.mark.parametrize("name", ["cycloidal", "modified sine", "modified trapezoid", "cubic"])
@pytest.mark.parametrize("friction", [0, 25])
def test_the_impact_of_a_table_that_is_let_go(name: str, friction: float) -> None:
    found, gap = table(name, friction_N_m=friction), math.radians(0.05)
    start, dt = found.braking[0][0], 1e-6
    x = start + np.arange(0, 400_000) * dt
    x = x[x <= 1]
    slowed = found.velocity_rad_per_s(start) - friction / 38.5 * (x - start) * 0.75
    relative = slowed - found.velocity_rad_per_s(x)
    ahead = np.cumsum(relative) * dt * 0.75
    hit = np.searchsorted(ahead, gap)
    assert found.impact_rad_per_s(0.05) == pytest.approx(relative[hit], rel=1e-4)


@pytest.mark.parametrize("friction", [50, 200, 250])
def test_a_table_gains_on_its_drive_after_braking_too(friction: float) -> None:
    """Its drive does not brake any more, and is slower still: nearly all of the gain is used up."""
    found = table(friction_N_m=friction)
    start = found.braking[0][0]
    x = np.linspace(start, 1, 100_001)
    step, slowed = (x[1] - x[0]) * 0.75, friction / 38.5 * (x - start) * 0.75
    relative = found.velocity_rad_per_s(start) - slowed - found.velocity_rad_per_s(x)
    ahead = np.cumsum(relative) * step
    most = np.argmax(ahead)
    assert x[most] > found.braking[0][1]
    hit = np.searchsorted(ahead[:most], 0.999 * ahead[most])
    asked = math.degrees(0.999 * ahead[most])
    assert found.impact_rad_per_s(asked) == pytest.approx(relative[hit], rel=1e-3)
    with pytest.raises(cm.InputError, match="gains only"):
        found.impact_rad_per_s(math.degrees(1.001 * ahead[most]))


@pytest.mark.parametrize("name", ["cycloidal", "modified sine", "modified trapezoid"])
def test_a_small_backlash_sees_only_the_jerk_of_the_crossover(name: str) -> None:
    """Of the drive that falls back by J t^3/6: v = (9 J b^2 / 2)^(1/3)."""
    gap = math.radians(1e-5)
    jerk = abs(float(cm.LAWS[name](0.5, 3))) * math.pi / 4 / 0.75**3
    known = (4.5 * jerk * gap**2) ** (1 / 3)
    assert table(name).impact_rad_per_s(1e-5) == pytest.approx(known, rel=1e-3)


def test_a_rotor_and_a_geneva_wheel_fit_in() -> None:
    wheel = cm.Rotor({"all": cm.OwnInertia(mass_kg=211.04, inertia_kg_m2=38.5)})
    found = cm.Indexer(wheel, 8, 0.75, cm.Geneva(8).law)
    speed = math.radians(135) / 0.75
    assert found.peak_torque_N_m == pytest.approx(38.5 * cm.Geneva(8).peak_acceleration * speed**2)
    assert found.torque_N_m(0.0) == pytest.approx(38.5 * math.tan(math.pi / 8) * speed**2)


WEIGHTLESS = cm.OwnInertia(mass_kg=8, inertia_kg_m2=0)


def test_a_cycle_that_is_the_index_but_for_the_last_digit_is_one() -> None:
    """0.1 + 0.2 s are more than 0.3."""
    all_of_it = cm.Indexer(38.5, stops=8, time_s=0.1 + 0.2)
    assert all_of_it.rms_torque_N_m(0.3) == pytest.approx(all_of_it.rms_torque_N_m(0.1 + 0.2))


BACK = cm.law_from_points([0, 0.2, 0.4, 0.6, 0.8, 1], [0, -0.1, 0.2, 0.9, 1.15, 1])


def test_friction_acts_against_a_law_that_goes_backwards() -> None:
    """It drove the table on: Camshaft is another computation, samples are a third."""
    found = cm.Indexer(1, 8, 0.5, BACK, friction_N_m=20, work_N_m=3)
    inside = X[1:-1]
    speed, alpha = found.velocity_rad_per_s(inside), found.acceleration_rad_per_s2(inside)
    torque = alpha + 3 + 20 * np.sign(speed)
    assert_near(found.torque_N_m(inside), torque, rel=1e-9)
    assert found.torque_N_m(0.1) == pytest.approx(-17.1127, abs=1e-4)
    assert found.peak_torque_N_m == pytest.approx(np.abs(torque).max(), rel=1e-3)
    assert found.peak_power_W == pytest.approx(np.abs(torque * speed).max(), rel=1e-6)
    assert found.rms_torque_N_m(0.5) == pytest.approx(np.sqrt(np.mean(torque**2)), rel=1e-3)
    negative = [(inside > low) & (inside < high) for low, high in found.braking]
    assert np.array_equal(np.any(negative, axis=0), torque < 0)
    turret = cm.indexing_motion("t", cm.rise(8, over_deg=100, law=BACK), cm.dwell(260), stops=8)
    radius = 8 * 0.008 / (2 * math.pi)  # m, so that the loads are 1 kg m2 and 20 N m
    shaft = cm.Camshaft(
        cm.TimingDiagram([turret], 2000),
        {"t": cm.FollowerLoad(mass_kg=1 / radius**2)},
        friction_N={"t": 20 / radius},
    )
    free = cm.Indexer(1, 8, 0.5, BACK, friction_N_m=20)
    asked = free.camshaft_torque_N_m(inside[::97], 100)
    assert shaft.torque_N_m(100 * inside[::97]) == pytest.approx(asked)
    assert abs(shaft.peak_torque().value) == pytest.approx(free.peak_camshaft_torque_N_m(100))


BUMP = cm.x**4 * (1 - cm.x) ** 3
STOPPED: list[tuple[sp.Expr, float, float, float]] = [
    (40 * BUMP, 450, 0, 0.02),  # hit long before friction would stop it
    (40 * BUMP, 450, 0, 8.4),
    (300 * BUMP * (0.8 - cm.x), 450, 0, 38.5),  # law and table stand at the end
    (-200 * (cm.x - cm.x**2) ** 3 * (1 - cm.x), 10, 0, 0.02),  # begins backwards
    (-200 * (cm.x - cm.x**2) ** 3 * (1 - cm.x), 10, 30, 0.3),
    (40 * BUMP, 100, 250, 12.8),  # turned back by its work
]


@pytest.mark.parametrize(("more", "friction", "work", "backlash"), STOPPED)
def test_a_free_table_may_be_stopped(
    more: sp.Expr, friction: float, work: float, backlash: float
) -> None:
    """It was refused for any law that goes backwards later; here friction acts step by step."""
    law = cm.MotionLaw("back", cm.LAWS["3-4-5 polynomial"].s + more)
    found = table(law, friction_N_m=friction, work_N_m=work)
    x, dt = np.linspace(found.braking[0][0], 1, 10_001, retstep=True)
    drive = found.velocity_rad_per_s(x).tolist()
    speed, ahead, step = drive[0], 0.0, dt * 0.75
    for driven in drive[1:]:
        held = math.copysign(friction, speed) if speed else -min(friction, work)
        after = speed - (work + held) / 38.5 * step
        speed = 0.0 if speed * after < 0 and friction >= work else after
        ahead += (speed - driven) * step
        if ahead >= math.radians(backlash):
            break
    assert found.impact_rad_per_s(backlash) == pytest.approx(speed - driven, rel=5e-3)


ANY: Any = cm  # what a learner may type, unseen by a type checker
BAD: list[tuple[Callable[[], object], str]] = [
    (lambda: ANY.Indexer(-38.5, 8, 0.75), r"inertia is -38.5 kg m2.*for example 38.5 kg m2"),
    (lambda: ANY.Indexer(0, 8, 0.75), r"inertia is 0 kg m2"),
    (
        lambda: ANY.Indexer(cm.Disc(radius_mm=500, mass_kg=43), 8, 0.75),
        r"not Disc\(.*: give a Rotor of its parts, or for example 38.5 kg m2\.$",
    ),
    (lambda: ANY.Indexer(cm.Rotor({"hub": WEIGHTLESS}), 8, 0.75), r"inertia is 0 kg m2"),
    (lambda: ANY.Indexer(38.5, 1, 0.75), r"number of stops is 1.*at least 2.*for example 8"),
    (lambda: ANY.Indexer(38.5, 7.5, 0.75), r"stops is 7.5; it has to be a whole number.*8"),
    (lambda: ANY.Indexer(38.5, 8, 0), r"indexing time is 0 s.*for example 0.75 s"),
    (lambda: ANY.Indexer(38.5, 8, math.inf), r"indexing time is inf s"),
    (
        lambda: ANY.Indexer(38.5, 8, 0.75, "sine"),
        r"no motion law 'sine': did you mean 'modified sine'",
    ),
    (lambda: ANY.Indexer(38.5, 8, 0.75, cm.CONSTANT_VELOCITY), r"velocity.*jumps.*'modified sine'"),
    (lambda: ANY.Indexer(38.5, 8, 0.75, HALF), r"law 'half' goes from .* to S\(1\) = 0.5"),
    (lambda: table(friction_N_m=-10), r"friction torque is -10 N m.*at least 0.*10 N m"),
    (lambda: table(work_N_m=math.nan), r"work torque is nan N m"),
    (lambda: table(safety=0.5), r"safety factor is 0.5.*at least 1.*1.5"),
    (lambda: table().camshaft_torque_N_m(0.5, 0), r"indexing angle is 0 deg"),
    (lambda: table().peak_camshaft_torque_N_m(361), r"indexing angle is 361 deg.*at most 360"),
    (lambda: table().rms_torque_N_m(0.5), r"cycle time is 0.5 s.*at least 0.75 s"),
    (lambda: table().rms_torque_N_m(-1), r"cycle time is -1 s"),
    (lambda: table().torque_N_m(1.5), r"x = t/tm is 1.5"),
    (lambda: table().impact_rad_per_s(0), r"backlash is 0 deg.*0.02 deg"),
    (lambda: table().impact_rad_per_s(40), r"backlash is 40 deg.*gains only .* smaller"),
]


@pytest.mark.parametrize(("make", "said"), BAD)
def test_what_makes_no_sense_is_refused_with_what_would_do(
    make: Callable[[], object], said: str
) -> None:
    with pytest.raises(cm.InputError, match=said):
        make()


def test_what_notebook_08_says_of_the_mill() -> None:
    """A steel disc of 24 stops, 100 mm apart on its rim; our own assumption of its mass."""
    wheel = cm.Disc(radius_mm=2400 / (2 * math.pi), thickness_mm=40, density_kg_per_m3=7850)

    def mill(law: str, angle: float) -> tuple[float, float]:
        found = cm.Indexer(
            wheel.inertia_kg_m2, 24, cm.indexing_time(angle, 2000), law, friction_N_m=5
        )
        return found.peak_torque_N_m, found.peak_camshaft_torque_N_m(angle)

    now, better = mill("cycloidal", 150), mill("modified sine", 163.267)
    assert [round(100 * (1 - b / a)) for a, b in zip(now, better, strict=True)] == [22, 44]
    for angle in (150, 163.267):
        laws = {law: mill(law, angle) for law in ("cycloidal", "modified trapezoid")}
        assert laws["modified trapezoid"][0] < laws["cycloidal"][0]
        assert laws["modified trapezoid"][1] > laws["cycloidal"][1]


def test_what_notebook_08_says_of_the_flywheel() -> None:
    index = table(friction_N_m=10)
    shaft = 2 * math.pi / 1.8
    assert index.kinetic_energy_J / (0.1 * shaft**2) > index.inertia_kg_m2
    assert 10 * math.pi / 4 / 1.8 == pytest.approx(4.4, abs=0.05)
    assert index.peak_power_W == pytest.approx(321, abs=0.5)


def test_a_law_from_points_is_reckoned_between_its_knots() -> None:
    """Its A goes straight from knot to knot: root mean square and power, against samples."""
    places = np.linspace(0, 1, 12)
    wave = 0.02 * np.sin(np.pi * places) ** 2 * np.sin(20 * places)
    law = cm.law_from_points(places, places**2 * (3 - 2 * places) + wave)
    table = cm.Indexer(10, 8, 0.5, law, friction_N_m=3)
    x = np.linspace(0, 1, 400_001)
    torque, step = table.torque_N_m(x), 2 * np.pi / 8
    assert_near(torque, 10 * step / 0.25 * law(x, 2) + 3, rel=1e-6)
    mean_square = (np.sum(torque**2) - (torque[0] ** 2 + torque[-1] ** 2) / 2) / (x.size - 1)
    assert table.rms_torque_N_m(1) == pytest.approx(np.sqrt(mean_square / 2), rel=1e-8)
    power = np.abs(torque * law(x, 1)) * step / 0.5
    assert power.max() <= table.peak_power_W == pytest.approx(power.max(), rel=1e-5)
