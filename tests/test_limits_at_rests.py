"""Limits that are as high as a part rests: its dwell is within, and where it moves is beyond."""

import numpy as np
import pytest
from resting import draw, search

import cammotion as cm

Arcs = dict[str, list[tuple[float, float]]]


def best(diagram: cm.TimingDiagram, rule: cm.ClearanceRule, still: Arcs) -> cm.Optimised:
    found = cm.optimise(diagram, rule, still=still)
    assert cm.find_violations(found.design, rule) == ()
    assert found.reached == pytest.approx(found.bound, rel=1e-4)
    return found


def turned(diagram: cm.TimingDiagram, *motions: cm.Motion) -> cm.TimingDiagram:
    for motion in motions:
        diagram = diagram.with_motion(motion)
    return diagram


def test_a_die_may_rest_only_while_a_gate_is_open() -> None:
    """The gate opens in 60 deg at most, from its still arc to the next; then the die waits."""
    stroke = {"rise": cm.rise(50, over_deg=110), "return_": cm.return_(50, over_deg=110)}
    die = cm.motion(
        "die", stroke["rise"], cm.dwell(30), stroke["return_"], cm.dwell(110), start_deg=240
    )
    gate = cm.motion(
        "gate",
        *(cm.rise(50, over_deg=7), cm.dwell(112), cm.return_(50, over_deg=20), cm.dwell(221)),
        start_deg=126,
    )
    diagram = cm.TimingDiagram([die, gate], 2000)
    rule = cm.ClearanceRule(cm.within("die", 0), only_while=cm.beyond("gate", 10))
    still: Arcs = {"die": [(350, 380)], "gate": [(120, 125), (185, 190), (270, 275)]}
    found = best(diagram, rule, still)
    assert found.reached == pytest.approx(2 * np.pi * 0.05 / (60 / 360 * 1.8) ** 2)
    top = found.design["die"].moves[1]
    assert 125 < top.to_deg % 360 < 275


def test_a_rise_of_two_stages_with_its_dwell_at_the_limit() -> None:
    """A design by hand, which keeps all that is asked, is no better than the best."""
    slide = cm.motion(
        "slide",
        *(cm.rise(20, over_deg=40), cm.dwell(60), cm.rise(30, over_deg=40), cm.dwell(20)),
        *(cm.return_(50, over_deg=80), cm.dwell(120)),
    )
    arm = cm.motion(
        "arm",
        *(cm.rise(50, over_deg=20), cm.dwell(50), cm.return_(50, over_deg=20), cm.dwell(270)),
        start_deg=102,
    )
    diagram = cm.TimingDiagram([slide, arm], 2000)
    rule = cm.ClearanceRule(cm.beyond("arm", 5), only_while=cm.beyond("slide", 20))
    still: Arcs = {"slide": [(70, 75), (145, 150), (300, 310)], "arm": [(130, 132), (300, 305)]}
    wider = cm.motion(
        "arm",
        *(cm.rise(50, over_deg=72), cm.dwell(4), cm.return_(50, over_deg=130), cm.dwell(154)),
        start_deg=57,
    )
    longer = cm.motion(
        "slide",
        *(cm.rise(20, over_deg=70), cm.dwell(5), cm.rise(30, over_deg=70), cm.dwell(5)),
        *(cm.return_(50, over_deg=150), cm.dwell(60)),
    )
    by_hand = turned(diagram, wider, longer)
    assert cm.find_violations(by_hand, rule) == ()
    found = best(diagram, rule, still)
    assert found.reached <= by_hand.peak_acceleration("arm") < diagram.peak_acceleration("arm")


@pytest.mark.parametrize("angle_deg", [200, 250, 300])
def test_a_table_stands_only_while_an_arm_is_near(angle_deg: float) -> None:
    """A wide arc, of which the table of today is at the edge: it is moved with the dwell."""
    table = cm.indexing_motion("table", cm.rise(100, over_deg=300), cm.dwell(60), stops=8)
    arm = cm.motion(
        "arm",
        *(cm.rise(50, over_deg=120), cm.dwell(40), cm.return_(50, over_deg=120), cm.dwell(80)),
        start_deg=10,
    )
    diagram = cm.TimingDiagram([table, arm], 2000)
    rule = cm.ClearanceRule(cm.within("table", 0), only_while=cm.within("arm", 1))
    still: Arcs = {"table": [(325, 330)]}
    angles = {"table": [(angle_deg, angle_deg)]}
    late, early = (
        turned(diagram, cm.with_angle(table, angle_deg).shifted(start)) for start in (0, 15)
    )
    if angle_deg == 200:  # the dwell is wider than the arm is near
        with pytest.raises(cm.InputError, match="No starts and angles"):
            cm.optimise(diagram, rule, still=still, angles_deg=angles)
        assert cm.find_violations(late, rule)
        assert cm.find_violations(early, rule)
        return
    found = cm.optimise(diagram, rule, still=still, angles_deg=angles)
    assert cm.find_violations(found.design, rule) == ()
    assert found.design["table"].moves[0].angle_deg == pytest.approx(angle_deg)


def test_a_dwell_that_is_none_breaks_no_rule() -> None:
    """The slide turns at the limit, at an angle and no longer: as it is judged, so it is sought."""
    slide = cm.motion(
        "slide", cm.rise(50, over_deg=150), cm.dwell(60), cm.return_(50, over_deg=150)
    )
    arm = cm.motion(
        "arm",
        *(cm.rise(50, over_deg=60), cm.dwell(20), cm.return_(50, over_deg=60), cm.dwell(220)),
        start_deg=-70,
    )
    diagram = cm.TimingDiagram([slide, arm], 2000)
    rule = cm.ClearanceRule(cm.within("slide", 0), only_while=cm.within("arm", 10))
    assert cm.find_violations(diagram, rule) == ()
    found = best(diagram, rule, {"slide": [(165, 170)]})
    assert found.reached == pytest.approx(2 * np.pi * 0.05 / (177.5 / 360 * 1.8) ** 2)
    rise, back = found.design["slide"].moves
    assert back.to_deg == rise.from_deg + 360


@pytest.mark.parametrize("seed", range(12))  # more are drawn in tests/fresh
def test_no_search_at_random_finds_better_moves(seed: int) -> None:
    rng = np.random.default_rng(seed + 40)
    machine = draw(rng)
    found = cm.optimise(machine.diagram, machine.made_rules(), still=machine.still)
    assert machine.is_kept(machine.times(found.design))
    other = machine.design(search(machine, rng, 400))
    assert found.reached <= max(map(other.peak_acceleration, machine.still)) * (1 + 1e-4)
