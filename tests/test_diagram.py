"""Timing diagrams: the motions of a machine by angle and by time, and their peaks."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import MONOTONE, RATE, examples, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion import TimingDiagram
from cammotion.machine.motions import Motion

DIAGRAM = make_diagram()
OVERLAPPED = make_diagram(make_mill(), make_die(124.84))
CURVES = ["position_mm", "offset_mm", "velocity", "acceleration", "jerk"]


@pytest.fixture(params=CURVES)
def curve(request: pytest.FixtureRequest) -> Any:
    return getattr(DIAGRAM, request.param)


def test_the_die_of_the_source_by_angle_and_by_time() -> None:
    """A turn takes 1.8 s, so that 0.8875 s are 177.5 deg: the middle of the rise."""
    assert DIAGRAM.cycle_time_s == 1.8
    assert DIAGRAM.angle_deg(0.8875) == 177.5
    assert DIAGRAM.position_mm("die", 177.5) == DIAGRAM.position_mm("die", time_s=0.8875) == 25
    assert DIAGRAM.velocity("die", 177.5) == pytest.approx(2 * 0.050 / 0.275)
    assert DIAGRAM.acceleration("die", 150 + 55 / 4) == pytest.approx(4.15417, abs=5e-6)
    assert DIAGRAM.acceleration("die", 360 - 55 / 4) == pytest.approx(4.15417, abs=5e-6)
    assert DIAGRAM.jerk("die", 177.5) == pytest.approx(-94.9, abs=0.05)


def test_the_peaks_of_the_source() -> None:
    assert DIAGRAM.peak_velocity("die") == pytest.approx(0.3636, abs=5e-5)
    assert DIAGRAM.peak_acceleration("die") == pytest.approx(4.15417, abs=5e-6)
    assert DIAGRAM.peak_jerk("die") == pytest.approx(94.9, abs=0.05)
    assert DIAGRAM.peak_acceleration("mill") == pytest.approx(1.117, abs=5e-4)
    assert OVERLAPPED.peak_acceleration("die") == pytest.approx(0.8064, abs=1e-4)


@examples(50)
@given(st.floats(-50, 50))
def test_velocity_is_the_slope_of_the_position_over_time(time: float) -> None:
    step = 1e-5
    for name in DIAGRAM.names:
        before, after = OVERLAPPED.position_mm(name, time_s=[time - step, time + step])
        way = (after - before) / 1000
        if name == "mill" and abs(way) > 1:
            continue  # from the last stop to the first
        slope = way / (2 * step)
        assert OVERLAPPED.velocity(name, time_s=time) == pytest.approx(slope, abs=1e-5)


@examples(50)
@given(st.floats(-1e3, 1e3))
def test_a_time_is_an_angle(time: float) -> None:
    for name in CURVES:
        curve = getattr(OVERLAPPED, name)
        at_angle = curve("die", OVERLAPPED.angle_deg(time))
        assert curve("die", time_s=time) == at_angle


def test_shapes_follow_the_argument(curve: Any) -> None:
    assert isinstance(curve("die", 30), float)
    assert isinstance(curve("mill", time_s=1), float)
    assert curve("die", [30, 40]).shape == (2,)
    assert curve("mill", time_s=np.zeros((2, 3))).shape == (2, 3)


def test_the_curves_of_a_diagram_are_those_of_its_motions() -> None:
    angles = np.linspace(0, 360, 37)
    for name in DIAGRAM.names:
        motion = DIAGRAM[name]
        assert (DIAGRAM.position_mm(name, angles) == motion.position_mm(angles)).all()
        assert (DIAGRAM.offset_mm(name, angles) == motion.offset_mm(angles)).all()
        for order, curve in enumerate((DIAGRAM.velocity, DIAGRAM.acceleration, DIAGRAM.jerk), 1):
            assert (curve(name, angles) == motion.derivative(order, angles, RATE)).all()


def test_the_moves_of_a_motion_are_told() -> None:
    down, up = DIAGRAM.moves("die")
    assert down == up == cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    [mill] = DIAGRAM.moves("mill")
    assert mill.time_s == 0.75
    cubic = make_diagram(make_die(70, law=MONOTONE[3])).moves("die")
    assert [move.law for move in cubic] == [MONOTONE[3]] * 2


def test_the_harder_of_two_moves_counts() -> None:
    quick_return = cm.motion(
        "die", cm.rise(50, over_deg=110), cm.return_(50, over_deg=55), cm.dwell(195)
    )
    diagram = make_diagram(quick_return, cm.motion("table", cm.dwell(360)))
    slow, quick = diagram.moves("die")
    assert quick.peak_acceleration > slow.peak_acceleration
    assert diagram.peak_acceleration("die") == pytest.approx(quick.peak_acceleration, rel=1e-14)
    assert diagram.peak_velocity("die") == pytest.approx(quick.peak_velocity, rel=1e-14)
    assert diagram.peak_jerk("die") == pytest.approx(quick.peak_jerk, rel=1e-14)
    peaks = diagram.peak_velocity, diagram.peak_acceleration, diagram.peak_jerk
    assert [peak("table") for peak in peaks] == [0, 0, 0]


def test_a_motion_is_asked_for_by_its_name() -> None:
    assert DIAGRAM.names == ("mill", "die")
    assert DIAGRAM["die"] == make_die()
    wider = DIAGRAM.with_motion(make_die(70))
    assert wider.names == DIAGRAM.names
    assert [segment.angle_deg for segment in wider["die"].moves] == [70, 70]
    assert DIAGRAM["die"] == make_die()


def test_where_two_motions_overlap() -> None:
    assert DIAGRAM.overlap("mill", "die") == []
    [falling, rising] = sorted(OVERLAPPED.overlap("mill", "die"))
    assert falling == pytest.approx((0, 69.84))
    assert rising == pytest.approx((80.16, 150))
    earlier = make_diagram(make_mill(middle_deg=60), make_die())
    assert earlier.overlap("die", "mill") == [(345, 360)]


def test_a_motion_that_is_named_twice_does_not_overlap_itself() -> None:
    assert OVERLAPPED.overlap("die", "Die", OVERLAPPED["die"]) == OVERLAPPED.overlap("die") == []
    assert OVERLAPPED.overlap("die", "mill", "DIE") == OVERLAPPED.overlap()


def test_an_overlap_across_360_deg_is_one_arc() -> None:
    late = make_diagram(make_mill(middle_deg=0), make_die(124.84))
    [across] = late.overlap("mill", "die")
    assert across == pytest.approx((305, 360 + 69.84))


UNKNOWN = r"^There is no motion '?{}'?: use one of 'mill', 'die'\.$"


@pytest.mark.parametrize("name", ["punch", "dies irae", None, 3])
def test_an_unknown_motion_is_refused_with_the_known(curve: Any, name: Any) -> None:
    with pytest.raises(cm.InputError, match=UNKNOWN.format(name)):
        curve(name, 30)


@pytest.mark.parametrize("ask", ["moves", "peak_acceleration", "overlap", "__getitem__"])
def test_so_is_it_by_every_other_question(ask: str) -> None:
    with pytest.raises(cm.InputError, match=UNKNOWN.format("punch")):
        getattr(DIAGRAM, ask)("punch")


def test_a_new_motion_is_not_added_by_replacing() -> None:
    with pytest.raises(cm.InputError, match=UNKNOWN.format("punch")):
        DIAGRAM.with_motion(cm.motion("punch", cm.dwell(360)))


def test_a_curve_is_asked_for_at_an_angle_or_a_time(curve: Any) -> None:
    match = r"^A curve is asked for at a cam angle or at a time, .*: give angle_deg=180 or time_s="
    with pytest.raises(cm.InputError, match=match):
        curve("die")
    with pytest.raises(cm.InputError, match=match):
        curve("die", 30, time_s=0.15)


@pytest.mark.parametrize("motions", [None, 3, "die", [None], [make_die(), "mill"]], ids=repr)
def test_a_diagram_is_made_of_motions(motions: Any) -> None:
    match = r"^TimingDiagram is given motions(\[\d\])?=.*: give (a list, each )?a motion, made with"
    with pytest.raises(cm.InputError, match=match):
        TimingDiagram(motions, RATE)
    with pytest.raises(cm.InputError, match="The diagram has no motion: give at least one"):
        TimingDiagram([], RATE)


def test_two_motions_of_one_name_are_refused() -> None:
    same: list[Motion] = [make_die(), make_mill(), make_die(70)]
    match = r"^2 motions of the diagram are called 'die': give each its own name\.$"
    with pytest.raises(cm.InputError, match=match):
        TimingDiagram(same, RATE)


def test_diagrams_are_told_apart_by_what_they_are() -> None:
    assert make_diagram() == DIAGRAM
    assert make_diagram() != OVERLAPPED
    assert TimingDiagram([make_die()], RATE) == TimingDiagram((make_die(),), float(RATE))
    assert hash(make_diagram()) == hash(DIAGRAM)


def test_a_diagram_at_another_rate_is_the_same_one_but_faster() -> None:
    """Half as fast again: velocities by 3/2, accelerations by its square, jerks by its cube."""
    faster = OVERLAPPED.at_rate(3000)
    assert faster.motions == OVERLAPPED.motions
    assert faster.cycle_time_s == 1.2
    for power, peak in enumerate(["peak_velocity", "peak_acceleration", "peak_jerk"], start=1):
        for name in faster.names:
            slower = getattr(OVERLAPPED, peak)(name)
            assert getattr(faster, peak)(name) == pytest.approx(1.5**power * slower)
    with pytest.raises(cm.InputError, match="machine rate is 0 pieces/h"):
        OVERLAPPED.at_rate(0)


def test_a_mechanism_is_given_by_its_name_or_itself() -> None:
    diagram, rule = cm.EXAMPLE.diagram, cm.EXAMPLE.rule
    die, mill = diagram["die"], diagram["mill"]
    assert diagram[die] is die
    assert diagram.position_mm(die, 177.5) == diagram.position_mm("die", 177.5) == 25
    assert diagram.peak_acceleration(die) == diagram.peak_acceleration("die")
    assert diagram.overlap(die, "mill") == diagram.overlap()
    assert cm.beyond(die, 19) == cm.beyond("die", 19)
    assert cm.ClearanceRule(cm.moving(die), cm.standing(mill)) == cm.ClearanceRule(
        cm.moving("die"), cm.standing("mill")
    )
    assert cm.DistanceRule(die, mill, 5) == cm.DistanceRule("die", "mill", 5)
    assert cm.widest_move(diagram, die, rule) == cm.widest_move(diagram, "die", rule)
    of_itself, of_its_name = (
        cm.least_acceleration(diagram, which, rule, still=[(205, 305)], cells=60)
        for which in (die, "die")
    )
    assert of_itself == of_its_name
    force = cm.ProcessForce(motion=die, from_deg=190, to_deg=205, force_N=100)
    assert force == cm.ProcessForce(motion="die", from_deg=190, to_deg=205, force_N=100)
    shaft = cm.Camshaft(diagram, {"die": cm.FollowerLoad(mass_kg=12)}, [force])
    assert shaft.force_N(die, 200) == shaft.force_N("die", 200)
    assert shaft.torque_N_m(200, motion=die) == shaft.torque_N_m(200, motion="die")
    assert shaft.peak_force(die) == shaft.peak_force("die")


def test_a_motion_that_the_diagram_has_not_is_refused() -> None:
    diagram, later = cm.EXAMPLE.diagram, cm.EXAMPLE.die.shifted(5)
    shaft = cm.Camshaft(diagram, {"die": cm.FollowerLoad(mass_kg=12)})
    for wrong in (
        lambda: diagram.position_mm(later, 0),
        lambda: cm.widest_move(diagram, later, cm.EXAMPLE.rule),
        lambda: cm.least_acceleration(diagram, later, cm.EXAMPLE.rule, still=[(205, 305)]),
        lambda: shaft.force_N(later, 0),
    ):
        with pytest.raises(cm.InputError, match=r"^The motion 'die' is another one in the diag.*"):
            wrong()
    with pytest.raises(cm.InputError, match="There is no motion 'pin'"):
        diagram[cm.motion("pin", cm.dwell(360))]
    assert diagram.with_motion(later).position_mm(later, 182.5) == 25
