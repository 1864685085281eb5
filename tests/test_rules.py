"""Rules about moving and standing, and names of rules, against samples."""

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import (
    OVERSHOOTING,
    RULE,
    Array,
    die_mm,
    examples,
    make_diagram,
    make_die,
    make_mill,
    mill_off_mm,
)
from numpy.typing import NDArray

import cammotion as cm
from cammotion.rules.rule import Violation

AT: Array = np.arange(0, 360, 0.01)
DEEP = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.standing("mill"))


def is_moving(start: float, width: float) -> NDArray[np.bool_]:
    """Return where a move that begins and lasts so is under way."""
    return np.asarray((AT - start) % 360 < width, dtype=np.bool_)


def arcs_of(broken: NDArray[np.bool_]) -> float:
    """Return over how many deg something holds."""
    return float(broken.mean() * 360)


@examples(30)
@given(st.floats(20, 129), st.floats(60, 300), st.floats(0, 360))
def test_a_die_that_may_be_deep_only_while_the_mill_stands(
    angle: float, width: float, middle: float
) -> None:
    machine = make_diagram(make_mill(width, middle_deg=middle), make_die(angle))
    found = cm.find_violations(machine, DEEP)
    die, moves = die_mm(AT, angle), is_moving(middle - width / 2, width)
    broken = sum(v.end_deg - v.start_deg for v in found)
    assert broken == pytest.approx(arcs_of((die > 19) & moves), abs=0.1)
    clearance = cm.smallest_clearance(machine, DEEP).clearance_mm
    assert clearance == pytest.approx(19 - die[moves].max(), abs=0.05)
    reverse = cm.ClearanceRule(cm.moving("mill"), only_while=cm.within("die", 19))
    assert [(v.start_deg, v.end_deg) for v in cm.find_violations(machine, reverse)] == [
        (v.start_deg, v.end_deg) for v in found
    ]
    assert cm.smallest_clearance(machine, reverse).clearance_mm == pytest.approx(clearance)


def test_two_that_never_move_at_once() -> None:
    rule = cm.ClearanceRule(cm.moving("die"), only_while=cm.standing("mill"), name=" one by one ")
    assert str(rule) == "one by one: the die may be moving only while the mill is standing"
    assert cm.find_violations(make_diagram(), rule) == ()
    assert cm.find_clearances(make_diagram(), rule)[0].clearance_mm == 0  # one ends, one begins
    (free,) = cm.find_clearances(make_diagram(make_mill(149), make_die(54)), rule)
    assert (free.clearance_mm, free.angle_deg) == (np.inf, None)
    both = make_diagram(make_mill(), make_die(95))
    found = cm.find_violations(both, rule)
    assert [(v.start_deg, v.end_deg) for v in found] == [(0, 40), (110, 150)]
    start, end = die_mm(np.array([0.0, 150.0]), 95)  # 40 deg before it is up, and after it began
    assert [v.excess_mm for v in found] == pytest.approx([start, end])
    assert start == pytest.approx(end)
    assert str(found[0]).startswith("one by one: the die is ")
    assert "mm on its way at" in str(found[0])
    assert "while the mill is not standing (from 0 to 40 deg)" in str(found[0])


@pytest.mark.parametrize("high", [0.2, 0.7, 5.2])
def test_moves_that_follow_each_other_leave_0_mm_and_no_rounding_less(high: float) -> None:
    """A clearance below 0 says that a rule is broken; it was -1e-16 mm."""
    up, down = (make(high + 3, over_deg=100) for make in (cm.rise, cm.return_))
    die = cm.motion("die", up, cm.dwell(100), down, cm.dwell(60), start_mm=-3, start_deg=33.3)
    blink = cm.rise(9, over_deg=30), cm.dwell(30), cm.return_(9, over_deg=40), cm.dwell(260)
    machine = make_diagram(die, cm.motion("flap", *blink, start_deg=133.3))
    rule = cm.ClearanceRule(cm.moving("die"), only_while=cm.standing("flap"))
    assert cm.find_violations(machine, rule) == ()
    assert cm.smallest_clearance(machine, rule).clearance_mm == 0


def test_one_of_two_always_moves() -> None:
    rule = cm.ClearanceRule(cm.standing("die"), only_while=cm.moving("mill"))
    found = cm.find_violations(make_diagram(), rule)
    assert [(v.start_deg, v.end_deg, v.excess_mm) for v in found] == [(205, 305, 0)]
    other = cm.ClearanceRule(cm.standing("die"), only_while=cm.standing("mill"))
    (broken,) = cm.find_violations(make_diagram(), other)
    assert (broken.start_deg, broken.end_deg, broken.excess_mm) == (0, 150, 50)


def test_a_move_that_overshoots_is_at_its_end_on_the_way_there_too() -> None:
    """It passes its end at three fifths of the move, as near to standing as it comes."""
    die = cm.motion(
        "die",
        *(cm.rise(50, over_deg=100, law=OVERSHOOTING), cm.dwell(100)),
        *(cm.return_(50, over_deg=100), cm.dwell(60)),
    )
    flap = cm.motion(
        "flap", cm.rise(9, over_deg=180), cm.return_(9, over_deg=160), cm.dwell(20), start_deg=70
    )
    rule = cm.ClearanceRule(cm.standing("flap"), only_while=cm.moving("die"))
    (found,) = cm.find_clearances(make_diagram(die, flap), rule)
    assert (found.clearance_mm, found.angle_deg) == pytest.approx((0, 60), abs=1e-9)


@pytest.mark.parametrize("rule", [DEEP, DEEP.reverse])
def test_the_widest_move_while_the_other_stands(rule: cm.ClearanceRule) -> None:
    found = cm.widest_move(make_diagram(), "die", rule)
    moves = is_moving(0, 150)
    kept = [bm for bm in np.arange(55, 130, 0.05) if die_mm(AT, bm)[moves].max() <= 19]
    assert found.angle_deg == pytest.approx(max(kept), abs=0.1)
    assert found.tight is not None
    (left,) = cm.reserves(found.diagram, rule)
    assert left.deg == pytest.approx(0, abs=1e-6)


def test_the_widest_move_of_a_part_that_has_to_stand() -> None:
    rule = cm.ClearanceRule(cm.moving("die"), only_while=cm.within("mill", 0.65))
    found = cm.widest_move(make_diagram(), "die", rule)
    away = [end for arc in make_mill().where_beyond(0.65) for end in arc]
    assert found.angle_deg == pytest.approx(min(205 - away[1], 360 + away[0] - 305))
    assert found.tight is not None
    assert found.tight.rule == rule
    mill = cm.widest_move(
        make_diagram(), "mill", cm.ClearanceRule(cm.moving("die"), cm.standing("mill"))
    )
    assert mill.angle_deg == pytest.approx(150)


@pytest.mark.parametrize("phase", [0, 0.5, 2])
def test_what_is_left_for_a_part_that_has_to_stand(phase: float) -> None:
    machine = make_diagram(make_mill(120), make_die(50))
    (left,) = cm.reserves(machine, DEEP, phase_deg=phase)
    deep = AT[die_mm(AT, 50) > 19]
    early, late = deep.min() - (75 + 60), 360 + (75 - 60) - deep.max()
    assert left.early_deg == pytest.approx(early - 2 * phase, abs=0.03)
    assert left.late_deg == pytest.approx(late - 2 * phase, abs=0.03)
    assert left.other_mm == np.inf
    reach = (AT - (15 - 2 * phase)) % 360 < 120 + 4 * phase
    assert left.when_mm == pytest.approx(19 - die_mm(AT, 50)[reach].max(), abs=0.05)


def test_a_name_is_named_wherever_the_rule_is_broken() -> None:
    rule = cm.ClearanceRule(cm.beyond("die", 19), cm.within("mill", 0.65), "die clear of mill")
    machine = make_diagram(make_mill(), make_die(130))
    (first, *_) = cm.find_violations(machine, rule)
    assert str(first).startswith("die clear of mill: the die is ")
    assert repr(rule).startswith("ClearanceRule(die clear of mill: the die may be beyond")
    assert str(cm.reserves(machine, rule)[0]).startswith("die clear of mill: ")
    assert cm.find_clearances(machine, rule)[0].clearance_mm == (
        cm.find_clearances(machine, RULE)[0].clearance_mm
    )
    with pytest.raises(cm.InputError, match="name=3: give a text"):
        cm.ClearanceRule(rule.when, rule.only_while, 3)  # type: ignore[arg-type]


def test_an_acceleration_knows_who_stands_but_not_whether_its_own_part_does() -> None:
    sharp = cm.least_acceleration(make_diagram(), "die", DEEP, still=[(205, 305)], cells=120)
    assert (
        cm.find_violations(
            sharp.design, cm.ClearanceRule(cm.beyond("die", 19.001), cm.standing("mill"))
        )
        == ()
    )
    loose = cm.least_acceleration(make_diagram(), "die", RULE, still=[(205, 305)], cells=120)
    assert sharp.reached > loose.reached
    own = cm.ClearanceRule(cm.moving("die"), only_while=cm.standing("mill"))
    with pytest.raises(cm.InputError, match="does not say between which positions the die may be"):
        cm.least_acceleration(make_diagram(), "die", own, still=[(205, 305)])
    away = mill_off_mm(AT)[is_moving(0, 150)]
    assert away.max() == pytest.approx(50, abs=0.01)


def test_pictures_and_explorers_take_or_refuse_every_kind() -> None:
    assert cm.animate(make_diagram(), rules=[DEEP, RULE]).description
    words = r"not covered here: say it by beyond and within.* broken, find_violations tells\.$"
    with pytest.raises(cm.InputError, match=words):
        cm.plot_clearance(make_diagram(), DEEP)
    with pytest.raises(cm.InputError, match="not covered here"):
        cm.explore_overlap(make_diagram(), DEEP, contact_mm=20)


def test_names_in_another_case_are_the_same_motions() -> None:
    loud = cm.ClearanceRule(cm.beyond("DIE", 19), only_while=cm.within("Mill", 0.65))
    for motion, rule in (("Die", RULE), ("die", loud), ("DIE", loud)):
        found = cm.widest_move(make_diagram(), motion, rule)
        assert found.angle_deg == pytest.approx(124.905, abs=1e-3)
        assert found.mechanism == "die"
        best = cm.least_acceleration(make_diagram(), motion, rule, still=[(205, 305)], cells=90)
        assert best.reached > 0.5
    wide = make_diagram(make_mill(), make_die(130))
    assert cm.find_violations(wide, loud) == cm.find_violations(wide, RULE)
    with pytest.raises(cm.InputError, match="Both halves of the clearance rule are about 'die'"):
        cm.find_violations(wide, cm.ClearanceRule(cm.beyond("die", 1), cm.within("Die", 2)))


def test_what_is_broken_by_nothing_is_broken_by_0_and_not_by_less() -> None:
    """Both stand, or the die is just where it may not be; no more than that can be said in mm."""
    machine = make_diagram(make_mill(), make_die(50))
    for rule in (
        cm.ClearanceRule(cm.standing("die"), only_while=cm.moving("mill")),
        cm.ClearanceRule(cm.within("die", 0), only_while=cm.standing("mill")),
    ):
        found = cm.find_violations(machine, rule)
        assert found
        for one in found:
            assert one.excess_mm == 0
            assert " is 0 mm " in str(one) or " stands at " in str(one)


def test_of_a_part_that_stands_where_it_may_not_it_is_said_that_it_stands() -> None:
    """It was called "0 mm short of moving"."""
    rule = cm.ClearanceRule(cm.standing("mill"), only_while=cm.moving("die"))
    (broken,) = cm.find_violations(make_diagram(), rule)
    said = "the die stands at 205 deg, while the mill is not moving (from 205 to 305 deg)"
    assert str(broken) == said


@pytest.mark.parametrize("make", [cm.beyond, cm.within])
@pytest.mark.parametrize("where", ["when", "only_while"])
def test_no_way_to_a_stop_is_below_0(make: Any, where: str) -> None:
    """Such a rule could never be broken, or never be kept; its limit is a slip."""
    halves = {"when": cm.beyond("die", 19), "only_while": cm.within("die", 19)}
    rule = cm.ClearanceRule(**halves | {where: make("mill", -0.65)})
    still: Any = {"die": [(205, 305)]}
    words = (
        rf"limit of the mill is -0\.65 mm, .* at least 0 mm, for example {make.__name__} 0\.65 mm"
    )
    for ask in (
        cm.find_violations,
        cm.find_clearances,
        lambda diagram, rule: cm.widest_move(diagram, "die", rule),
        lambda diagram, rule: cm.optimise(diagram, rule, still=still),
        lambda diagram, rule: cm.Machine("press", diagram, [rule]),
    ):
        with pytest.raises(cm.InputError, match=words):
            ask(make_diagram(), rule)
    depth = cm.ClearanceRule(cm.beyond("die", -5), only_while=make("mill", 0))
    assert isinstance(cm.find_violations(make_diagram(), depth), tuple)
    reserve = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0))
    for name in ("die", "mill"):  # what is kept in hand is no limit that anyone gave
        found = cm.widest_move(make_diagram(), name, reserve, reserve_mm=0.5)
        assert cm.find_violations(found.diagram, reserve) == ()


@pytest.mark.parametrize("make", [cm.moving, cm.standing, lambda it: cm.beyond(it, 19)])
@pytest.mark.parametrize("motion", [None, 5, ["die"]])
def test_a_condition_is_about_a_motion_by_its_name_or_itself(make: Any, motion: Any) -> None:
    with pytest.raises(cm.InputError, match=rf"is given motion={re.escape(repr(motion))}: give a"):
        make(motion)


def test_an_arc_of_no_length_is_not_said() -> None:
    found = Violation(RULE, 170.0, 170.0000002, 31.0, 170.0000001)
    assert (
        str(found) == "the die is 31 mm too deep at 170 deg, while the mill is not within 0.65 mm"
    )


def test_a_clearance_says_where_it_is_and_nothing_where_nothing_can_break_its_rule() -> None:
    (near,) = cm.find_clearances(make_diagram(make_mill(), make_die(120)), RULE)
    at = f"{near.angle_deg:.5g}"
    assert repr(near) == f"Clearance({near.clearance_mm:.4g} mm at {at} deg: {RULE})"
    parts = cm.return_(50, over_deg=70), cm.dwell(130), cm.rise(50, over_deg=80), cm.dwell(80)
    gate = cm.motion("mill", *parts, start_deg=50, start_mm=50)
    over_the_end = cm.find_clearances(make_diagram(gate, make_die().shifted(-120)), RULE)
    assert [one.angle_deg for one in over_the_end] == [85.0]  # not 445, in the turn after it
    never = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 50))  # of 100
    (free,) = cm.find_clearances(make_diagram(), never)
    assert repr(free) == f"Clearance(∞ mm: {never})"
