"""Forces and torque of a camshaft, against sums over samples and the balance of energy."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import MONOTONE, examples, make_diagram, make_die, make_mill
from shafts import AT, COUNT, DIE, PRESSING, SHAFT, SPEED, TURN_S, die, forces, mill, torque

import cammotion as cm
from cammotion import x

OVERSHOOTING = cm.MotionLaw(
    "overshooting, from rest to rest", 10 * x**3 - 15 * x**4 + 6 * x**5 + 40 * x**4 * (1 - x) ** 3
)


def test_forces_and_torque_of_cycloids() -> None:
    inside = AT[::997]
    for name, expected in forces(inside).items():
        assert SHAFT.force_N(name, inside) == pytest.approx(expected, abs=1e-8)
    assert SHAFT.torque_N_m(inside) == pytest.approx(torque(inside), abs=1e-9)
    both = SHAFT.torque_N_m(inside, motion="die") + SHAFT.torque_N_m(inside, motion="mill")
    assert both == pytest.approx(torque(inside), abs=1e-9)
    assert isinstance(SHAFT.torque_N_m(100), float)
    assert SHAFT.torque_N_m([[100], [200]]).shape == (2, 1)


def test_peak_mean_and_root_mean_square_are_those_of_samples() -> None:
    sampled = torque(AT)
    peak = SHAFT.peak_torque()
    assert peak.value == pytest.approx(sampled[np.abs(sampled).argmax()], abs=2e-3)
    assert abs(peak.value) >= np.abs(sampled).max() - 1e-9
    assert peak.at_deg == pytest.approx(AT[np.abs(sampled).argmax()], abs=0.01)
    assert SHAFT.mean_torque_N_m == pytest.approx(sampled.mean(), abs=1e-5)
    assert SHAFT.mean_power_W == pytest.approx(sampled.mean() * SPEED, abs=1e-5)
    assert SHAFT.rms_torque_N_m == pytest.approx(math.sqrt((sampled**2).mean()), abs=1e-5)
    for name, expected in forces(AT).items():
        force = SHAFT.peak_force(name)
        assert abs(force.value) == pytest.approx(np.abs(expected).max(), rel=1e-4)
        assert abs(force.value) >= np.abs(expected).max() - 1e-9


def test_in_a_turn_the_shaft_pays_for_process_and_friction_alone() -> None:
    """Masses, springs and weights give back what they took."""
    rise = np.linspace(190, 205, 1_000_001)
    pressed = np.trapezoid(100 + 40 * (rise - 190), die(rise).mm / 1000)
    paid = float(pressed) + 20 * 0.1 + 35 * 0.1  # J: friction over 100 mm each
    assert SHAFT.mean_torque_N_m * 2 * math.pi == pytest.approx(paid, rel=1e-9)
    free = cm.Camshaft(SHAFT.diagram, SHAFT.loads)
    assert free.mean_torque_N_m == pytest.approx(0, abs=1e-12)
    assert free.rms_torque_N_m > 1


def test_a_force_of_the_process_may_name_its_mechanism_in_any_case() -> None:
    pressing = cm.ProcessForce(motion="DIE", from_deg=190, to_deg=205, force_N=5000)
    shaft = cm.Camshaft(SHAFT.diagram, SHAFT.loads, process=[pressing])
    same = cm.Camshaft(SHAFT.diagram, SHAFT.loads, process=[replace(pressing, motion="die")])
    assert shaft == same
    free = cm.Camshaft(SHAFT.diagram, SHAFT.loads)
    assert abs(shaft.peak_torque().value) > 2 * abs(free.peak_torque().value)


@examples(25)
@given(
    st.sampled_from([OVERSHOOTING, *MONOTONE]),
    st.floats(40, 170),
    st.floats(0, 360),
    st.floats(0, 30),
    st.floats(500, 9000),
)
def test_the_balance_of_energy(
    law: cm.MotionLaw, angle: float, start: float, friction: float, rate: float
) -> None:
    """Friction is paid over the whole way, also over that of a law that overshoots."""
    motion = make_die(min(angle, 129), law=law).shifted(start)
    diagram = cm.TimingDiagram([motion], rate)
    shaft = cm.Camshaft(diagram, {"die": DIE}, friction_N={"die": friction})
    even = np.linspace(0, 1, 200_001)
    way = np.abs(np.diff(law(even))).sum() * 50 / 1000
    assert shaft.mean_torque_N_m * 2 * math.pi == pytest.approx(2 * friction * way, abs=1e-7)


def test_a_weight_that_a_lift_carries_on_is_paid_for() -> None:
    """An indexing motion does not give back what it has lifted: 200 N over 100 mm are 20 J."""
    lift = cm.Camshaft(
        make_diagram(make_mill()), {"mill": cm.FollowerLoad(mass_kg=20, weight_N=200)}
    )
    assert lift.mean_torque_N_m * 2 * math.pi == pytest.approx(20)


def test_friction_holds_back_from_where_a_move_begins() -> None:
    """By hand: 4 h/tm^2 of 12 kg, and 20 N against the motion from its very first angle on."""
    up, down = (
        move(50, over_deg=60, law="constant acceleration") for move in (cm.rise, cm.return_)
    )
    moved = cm.motion("die", up, cm.dwell(90), down, cm.dwell(150), start_deg=150.1)
    load = {"die": cm.FollowerLoad(mass_kg=12)}
    shaft = cm.Camshaft(make_diagram(moved), load, friction_N={"die": 20})
    mass = 12 * 4 * 0.050 / (60 / 360 * TURN_S) ** 2
    ends = np.add([150.1, 210.1, 300.1, 330.1, 360.1], [0, 0, 0, 360, -360])
    expected = [mass + 20, 0, -mass - 20, mass - 20, 0]
    assert shaft.force_N("die", ends) == pytest.approx(expected)


def test_a_spring_counts_from_the_lowest_position() -> None:
    """The same die on a frame that is 30 mm higher asks the same."""
    parts = cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=55), cm.dwell(150)
    high = cm.motion("die", *parts, start_deg=150, start_mm=30)
    low, raised = (cm.Camshaft(make_diagram(m), {"die": DIE}) for m in (make_die(), high))
    assert raised.force_N("die", 250) == low.force_N("die", 250) == 5 * 50 + 217.7
    assert raised.peak_force("die").value == pytest.approx(low.peak_force("die").value)


def test_a_turret_asks_what_its_indexer_says() -> None:
    """The inertia over the square of the radius at which its mm are measured is its mass."""
    radius = 24 * 0.100 / (2 * math.pi)
    load = cm.FollowerLoad(mass_kg=38.5 / radius**2)
    for law in ("cycloidal", "modified sine", "modified trapezoid"):
        shaft = cm.Camshaft(make_diagram(make_mill(150, law=law)), {"mill": load})
        indexer = cm.Indexer(38.5, stops=24, time_s=0.75, law=law)
        expected = indexer.peak_camshaft_torque_N_m(150)
        assert abs(shaft.peak_torque().value) == pytest.approx(expected, rel=1e-9)
        assert shaft.energy_swing_J == pytest.approx(indexer.kinetic_energy_J, rel=1e-9)


def test_the_speed_swings_as_its_energy_has_it() -> None:
    """By the whole energy of drive and masses, with a speed that is free to swing."""
    heavy = 200.0
    shaft = cm.Camshaft(SHAFT.diagram, SHAFT.loads, SHAFT.process, SHAFT.friction_N, heavy)
    step = 2 * math.pi / COUNT
    slopes = die(AT).velocity / SPEED, mill(AT).velocity / SPEED  # m/rad
    found = forces(AT)
    rest = (found["die"] - 12 * die(AT).acceleration) * slopes[0]
    rest += (found["mill"] - 40 * mill(AT).acceleration) * slopes[1]
    energy = heavy * SPEED**2 / 2 + np.cumsum(rest.mean() - rest) * step
    speeds = np.sqrt(2 * energy / (heavy + 12 * slopes[0] ** 2 + 40 * slopes[1] ** 2))
    swing = (speeds.max() - speeds.min()) / speeds.mean()
    assert shaft.speed_ripple == pytest.approx(swing, rel=5e-3)
    assert 0.005 < swing < 0.01


def test_a_speed_that_would_swing_widely_is_warned_of() -> None:
    def ripple(inertia: float) -> float:
        return cm.Camshaft(make_diagram(), {"die": DIE}, inertia_kg_m2=inertia).speed_ripple

    energy = cm.Camshaft(make_diagram(), {"die": DIE}).energy_swing_J
    just = energy / (0.2 * SPEED**2)
    assert ripple(1.001 * just) == pytest.approx(0.2, rel=2e-3)  # without a warning, as all tests
    with pytest.warns(UserWarning, match=r"speed would swing by 20 %.*larger inertia_kg_m2"):
        ripple(0.999 * just)


@pytest.mark.parametrize("start", [-1e-17, -1e-12, 1e-12, 359.9999999999])
def test_a_motion_that_begins_just_beside_the_turn(start: float) -> None:
    motion = make_die().shifted(210 + start)  # from 0 deg on
    shaft, sharp = (
        cm.Camshaft(make_diagram(m), {"die": DIE}) for m in (motion, make_die().shifted(210))
    )
    assert len(shaft.spans) == len(sharp.spans)
    assert shaft.rms_torque_N_m == pytest.approx(sharp.rms_torque_N_m)
    assert abs(shaft.peak_torque().value) == pytest.approx(abs(sharp.peak_torque().value))


def test_a_start_speeds_up_the_masses_too() -> None:
    """All that moves has the energy of the inertia that is reflected."""
    some = AT[::997]
    energy = 2 * SPEED**2 / 2 + 12 * die(some).velocity ** 2 / 2 + 40 * mill(some).velocity ** 2 / 2
    assert SHAFT.reflected_inertia_kg_m2(some) * SPEED**2 / 2 == pytest.approx(energy)
    assert SHAFT.reflected_inertia_kg_m2(180) == SHAFT.at_rate(500).reflected_inertia_kg_m2(180)


def test_twice_the_rate_is_four_times_the_torque_of_masses() -> None:
    load = {"mill": cm.FollowerLoad(mass_kg=40)}
    shaft = cm.Camshaft(make_diagram(), load)
    assert shaft.at_rate(4000).rms_torque_N_m == pytest.approx(4 * shaft.rms_torque_N_m)
    assert shaft.at_rate(4000).mean_torque_N_m == pytest.approx(0, abs=1e-12)


def test_a_step_of_the_process_counts_from_both_sides() -> None:
    """The die is pulled with up to 3000 N until 195 deg: the largest force is just before that."""
    pulled = cm.ProcessForce(motion="die", from_deg=185, to_deg=195, force_N=0, last_N=-3000)
    shaft = cm.Camshaft(make_diagram(), {"die": cm.FollowerLoad(mass_kg=12)}, [pulled])
    peak = shaft.peak_force("die")
    expected = 12 * 2 * math.pi * 0.050 / 0.275**2 * math.sin(2 * math.pi * 45 / 55) - 3000
    assert peak.value == pytest.approx(expected)
    assert peak.at_deg == pytest.approx(195)


def test_what_ends_is_not_added_to_what_begins() -> None:
    """Friction ends at 205 deg, where the die stands, and there the process begins to press."""
    pressing = cm.ProcessForce(motion="die", from_deg=205, to_deg=305, force_N=600)
    load = {"die": cm.FollowerLoad(mass_kg=12)}
    shaft = cm.Camshaft(make_diagram(), load, [pressing], friction_N={"die": 100})
    assert shaft.peak_force("die").value == 600
    (limit,) = cm.rate_limits(shaft, force_N=650)
    moving = shaft.at_rate(limit.rate_per_hour)
    assert abs(moving.peak_force("die").value) == pytest.approx(650)


def test_a_force_that_is_about_to_end_counts_in_the_torque() -> None:
    """By hand, just before 175 deg: 150 N times the slope, the masses next to nothing."""
    pulled = cm.ProcessForce(motion="die", from_deg=172, to_deg=175, force_N=-160, last_N=150)
    shaft = cm.Camshaft(make_diagram(), {"die": cm.FollowerLoad(mass_kg=1)}, [pulled])
    slope = 0.050 / math.radians(55) * (1 - math.cos(2 * math.pi * 25 / 55))
    assert shaft.at_rate(1e-3).peak_torque().value == pytest.approx(150 * slope, rel=1e-6)


def test_a_force_over_the_end_of_the_turn() -> None:
    force = cm.ProcessForce(motion="die", from_deg=350, to_deg=370, force_N=10, last_N=30)
    assert force.at([345, 350, 0, 365, 10]).tolist() == [0, 10, 20, 25, 0]


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"loads": {"dye": DIE}}, "There is no motion 'dye': did you mean 'die'"),
        ({"loads": {"die": 12}}, "A load of a motion is 12: give a FollowerLoad, for example"),
        ({"loads": [DIE]}, r"The loads are \["),
        ({"friction_N": {"mill": 3}}, "There is no load of a motion 'mill': use one of 'die'"),
        ({"friction_N": {"die": -3}}, "friction is -3 N"),
        ({"friction_N": 3}, "The forces of friction are 3: give them by the name of each load"),
        ({"process": [400]}, r"forces of the process are \[400\]: give a list of ProcessForce"),
        ({"process": 400}, "forces of the process are 400"),
        ({"inertia_kg_m2": -1}, "inertia of the drive is -1 kg m2"),
        ({"loads": {"mill": DIE}}, "'mill' moves on from stop to stop, and no spring"),
    ],
)
def test_bad_shafts(given: dict[str, object], said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.Camshaft(**{"diagram": make_diagram(), "loads": {"die": DIE}} | given)  # type: ignore[arg-type]


def test_what_cannot_be_asked() -> None:
    with pytest.raises(cm.InputError, match="There is no load of a motion 'dye'"):
        SHAFT.force_N("dye", 0)
    with pytest.raises(cm.InputError, match="There is no load of a motion 'dye'"):
        SHAFT.peak_force("dye")
    with pytest.raises(cm.InputError, match="inertia of the drive is 0 kg m2"):
        _ = cm.Camshaft(make_diagram(), {"die": DIE}).speed_ripple
    jumping = make_die(law=cm.CONSTANT_VELOCITY)
    with pytest.raises(cm.InputError, match="velocity of 'die' jumps at 0 deg"):
        cm.Camshaft(make_diagram(jumping), {"die": DIE})
    with pytest.raises(cm.InputError, match="There is no load of a motion 'die'"):
        cm.Camshaft(make_diagram(), {"mill": cm.FollowerLoad(mass_kg=40)}, [PRESSING])
    with pytest.raises(cm.InputError, match=r"begins at 10 deg and .* give to_deg=370"):
        cm.ProcessForce(motion="die", from_deg=10, to_deg=10, force_N=1)
    with pytest.raises(cm.InputError, match="force of the process is inf N"):
        cm.ProcessForce(motion="die", from_deg=10, to_deg=20, force_N=math.inf)
