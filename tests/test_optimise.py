"""The best starts, angles and laws of all moves: against orders, balances and an evolution."""

import os
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy
from crowds import LAWS, designs, draw, keeps
from machines import DOWN_DEG, RULE, make_diagram, make_die, make_mill
from scipy.optimize import differential_evolution

import cammotion as cm
from cammotion.limits.frame import rests_at
from cammotion.quantities import InputError, WrongAnswerError
from cammotion.whole.mixed import Mixed, Rows
from cammotion.whole.optimise import Optimised, optimise
from cammotion.whole.wide_moves import Found

STILL = {"mill": [DOWN_DEG], "die": [DOWN_DEG]}
BALANCE_DEG, BALANCED = 163.267, 0.94285  # deg and m/s2, both with cycloids


def peak(design: cm.TimingDiagram) -> float:
    return max(design.peak_acceleration(name) for name in design.names)


# Mill and die


def test_the_balance_is_found() -> None:
    found = optimise(make_diagram(), RULE, still=STILL)
    assert found.design["mill"].moves[0].angle_deg == pytest.approx(BALANCE_DEG, abs=5e-4)
    assert found.peaks == pytest.approx({"mill": BALANCED, "die": BALANCED}, abs=5e-6)
    assert found.reached == pytest.approx(found.bound, rel=1e-6)
    assert cm.find_violations(found.design, RULE) == ()


def test_the_die_alone_is_as_wide_as_its_widest_move() -> None:
    widest = cm.widest_move(make_diagram(), "die", RULE)
    found = optimise(make_diagram(), RULE, still={"die": [DOWN_DEG]})
    assert found.reached == pytest.approx(widest.peak_acceleration, rel=1e-6)
    assert found.design["mill"] == make_mill()


def test_a_kept_middle_of_the_mill_leaves_the_die_less() -> None:
    """Nothing asks the mill to move about 75 deg but the rule and the die themselves."""
    held = optimise(make_diagram(), RULE, still=STILL, starts_deg={"mill": [(0, 0)]})
    assert held.design["mill"].start_deg == pytest.approx(0, abs=1e-6)
    assert held.reached > BALANCED + 1e-3
    narrow = optimise(make_diagram(), RULE, still=STILL, angles_deg={"die": [(55, 60), None]})
    down, up = narrow.design["die"].moves
    assert 55 - 1e-6 <= down.angle_deg <= 60 + 1e-6
    assert up.angle_deg >= 60 - 1e-5
    assert narrow.reached > BALANCED
    assert narrow.peaks["mill"] < held.peaks["mill"]  # to which a wider return would do harm


@pytest.mark.parametrize("begins", [(0, 360), (350, 360), (-10, 0), (710, 720)])
def test_a_range_of_starts_is_one_in_every_turn(begins: tuple[float, float]) -> None:
    """The best mill begins at 353.366 deg, and by its motion of today at 0 deg."""
    found = optimise(make_diagram(), RULE, still=STILL, starts_deg={"mill": [begins]})
    assert found.reached == pytest.approx(BALANCED, abs=5e-6)


def test_a_move_may_begin_wherever_its_still_arcs_let_it() -> None:
    """Its start of today is nearer to this range of the turn before, where it has to stand."""
    parts = cm.rise(50, over_deg=40), cm.dwell(10), cm.return_(50, over_deg=40), cm.dwell(270)
    machine = cm.TimingDiagram([cm.motion("slide", *parts)], 2000)
    asked: dict[str, Any] = {"still": {"slide": [(340, 350)]}}
    late = optimise(machine, [], **asked, starts_deg={"slide": [(250, 260), None]})
    assert [move.angle_deg for move in late.design["slide"].moves] == pytest.approx([45, 45])
    at_random = [
        optimise(machine, [], **asked, starts_deg={"slide": [(start, start), None]}).reached
        for start in np.random.default_rng(3).uniform(-10, 335, 8)
    ]
    assert optimise(machine, [], **asked).reached <= min(at_random) * (1 + 1e-6)


def test_a_velocity_that_is_rounding_is_a_rest() -> None:
    """As at the joints of a motion: a law that a fit has made is seldom at rest to the last digit.

    The advice that a machine is given asks the same.
    """
    for velocity, rests in ((1e-7, True), (1e-5, False)):
        law = cm.polynomial((0, velocity, 0), (1, 0, 0))
        assert rests_at(law, 0) is rests
        assert rests_at(law, 1)
    smooth = cm.polynomial((0, 1e-7, 0), (1, 0, 0))
    assert optimise(make_diagram(), RULE, still=STILL, laws=[smooth]).design.peak_jerk("die") < 99


def test_of_a_list_each_move_gets_the_best_law() -> None:
    one = {name: optimise(make_diagram(), RULE, still=STILL, laws=[name]).reached for name in LAWS}
    found = optimise(make_diagram(), RULE, still=STILL, laws=LAWS)
    assert found.reached <= min(one.values()) * (1 + 1e-4)
    assert one["cycloidal"] == pytest.approx(BALANCED, abs=5e-6)
    only_mill = optimise(make_diagram(), RULE, still=STILL, laws={"mill": ["modified sine"]})
    assert only_mill.design["mill"].moves[0].law == cm.LAWS["modified sine"]
    assert only_mill.design["die"].moves[0].law == cm.LAWS["cycloidal"]


def test_a_force_is_balanced_by_masses() -> None:
    mass = {"mill": 40, "die": 12}
    found = optimise(make_diagram(), RULE, still=STILL, weights=mass, unit="N")
    forces = [mass[name] * one for name, one in found.peaks.items()]
    assert forces[0] == pytest.approx(forces[1], rel=1e-5)
    assert found.reached == max(forces)
    assert repr(found).startswith(f"{found.reached:.4f} N (before: ")
    shaft = cm.Camshaft(make_diagram(), {n: cm.FollowerLoad(mass_kg=kg) for n, kg in mass.items()})
    for still in (STILL, {name.upper(): arcs for name, arcs in STILL.items()}):
        assert optimise(shaft, RULE, still=still, minimise="force").design == found.design
    light = cm.Camshaft(make_diagram(), {"die": cm.FollowerLoad(mass_kg=12)})
    with pytest.raises(cm.InputError, match="There is no load of a motion 'mill'"):
        optimise(light, RULE, still=STILL, minimise="force")


def test_a_limit_for_one_part_is_kept() -> None:
    found = optimise(make_diagram(), RULE, still=STILL, weights={"mill": 0}, at_most={"mill": 1.0})
    assert found.peaks["mill"] <= 1.0 + 1e-6
    assert found.reached == found.peaks["die"] < BALANCED


def test_with_the_largest_held_the_next_is_made_small() -> None:
    """A part that has nothing to do with the hardest one gets all of its turn."""
    slow = cm.motion(
        "slow", cm.rise(5, over_deg=20), cm.dwell(100), cm.return_(5, over_deg=30), cm.dwell(210)
    )
    machine = cm.TimingDiagram([make_mill(), make_die(), slow], 2000)
    found = optimise(machine, RULE, still=STILL | {"slow": [(20, 120)]})
    assert sum(move.angle_deg for move in found.design["slow"].moves) == pytest.approx(260)
    assert found.reached == pytest.approx(BALANCED, abs=5e-6)


def test_other_moves_of_the_hardest_part_take_nothing_from_the_next_part() -> None:
    """A pusher that goes in twice a turn: two of its moves could be wider, for nothing."""
    there, back, wait = cm.rise(40, over_deg=45), cm.return_(40, over_deg=45), cm.dwell(15)
    moves = there, wait, back, wait, there, wait, back
    pusher = cm.motion("pusher", *moves, cm.dwell(135), start_deg=115)
    dial = cm.indexing_motion("dial", cm.rise(131, over_deg=110), cm.dwell(250), stops=12)
    machine = cm.TimingDiagram([dial, pusher], 5400)
    rule = cm.ClearanceRule(cm.beyond("pusher", 6), only_while=cm.within("dial", 0.5))
    still = {"pusher": [(160, 175), (280, 295)], "dial": [(170, 290)]}
    found = optimise(machine, rule, still=still)
    assert [move.angle_deg for move in found.design["pusher"].moves] == pytest.approx(4 * [52.5])
    limit = {"pusher": found.peaks["pusher"] * (1 + 1e-6)}
    alone = optimise(machine, rule, still=still, weights={"pusher": 0}, at_most=limit)
    assert found.peaks["dial"] == pytest.approx(alone.peaks["dial"], rel=1e-5)
    wide = found.design.with_motion(
        cm.with_angle(found.design["dial"], found.design["dial"].moves[0].angle_deg + 0.01)
    )
    assert cm.find_violations(wide, rule)


def test_a_turret_may_stand_at_a_pause_alone() -> None:
    law = "modified trapezoid"
    short, long = (cm.rise(50, over_deg=wide, law=law) for wide in (40, 120))
    table = cm.indexing_motion("table", short, cm.dwell(100), long, cm.dwell(100), stops=8)
    found = optimise(cm.TimingDiagram([table], 2000), [], still={"table": [(60, 120)]})
    wide = cm.rise(50, over_deg=150, law=law)
    by_hand = cm.indexing_motion("table", wide, cm.dwell(60), wide, stops=8, start_deg=-90)
    expected = cm.TimingDiagram([by_hand], 2000).peak_acceleration("table")
    assert found.reached == pytest.approx(expected)
    assert found.design["table"].position_mm(60) == 50


def test_a_search_that_was_cut_off_says_how_much_better_another_could_be() -> None:
    found = optimise(make_diagram(), RULE, still=STILL)
    assert found.is_best
    assert "too short" not in repr(found)
    cut_off = replace(found, bound=0.5)
    assert not cut_off.is_best
    assert "no such moves have less than 0.5000 m/s²; the time was too short" in repr(cut_off)


def test_it_says_where_each_move_is() -> None:
    text = repr(optimise(make_diagram(), RULE, still=STILL))
    assert "0.9429 m/s² (before: 4.1542)" in text
    assert "  rise over 163.267 deg from 353.366 deg, cycloidal" in text
    assert "  return over 115.447 deg from 305.000 deg, cycloidal" in text


# What is there today


@pytest.fixture(name="touching")
def fixture_touching() -> cm.TimingDiagram:
    """Return mill and die, which leaves its rest as the mill comes to it: no gap between both."""
    return make_diagram(make_mill(), make_die())


REST = cm.ClearanceRule(cm.beyond("die", 0), only_while=cm.within("mill", 0))
ALONE = {"die": STILL["die"]}


@pytest.mark.parametrize(
    "asked",
    [
        {"still": ALONE},
        {"still": STILL, "at_most": {"mill": 1.1170107212763709, "die": 4.154172103920388}},
        {"still": STILL, "angles_deg": {"mill": [(150, 150)], "die": [(55, 55)] * 2}},
        {"still": STILL, "angles_deg": {"die": [(55, 55)] * 2}},
        {"still": ALONE, "minimise": "torque", "seconds": 0.5},
    ],
)
def test_what_is_kept_today_is_never_refused(
    touching: cm.TimingDiagram, asked: dict[str, Any]
) -> None:
    """Arcs that just touch: the solver's rounding kept them a little apart, and so from each other.

    The bound, too, is then what no diagram is below, today's among them.
    """
    shaft = cm.Camshaft(touching, {"mill": cm.FollowerLoad(mass_kg=40)})
    found = optimise(shaft if "minimise" in asked else touching, REST, **asked)
    assert found.design["die"] == touching["die"]
    if "minimise" not in asked:
        assert found.bound <= peak(touching)
        assert found.reached <= peak(touching)


@pytest.mark.parametrize(
    "asked",
    [
        {"angles_deg": {"mill": [(150, 150)], "die": [(56, 56), (55, 55)]}},
        {
            "starts_deg": {"mill": [(1, 2)]},
            "angles_deg": {"mill": [(150, 150)], "die": [(55, 55)] * 2},
        },
        {"laws": ["modified sine"], "angles_deg": {"mill": [(150, 150)], "die": [(55, 55)] * 2}},
    ],
)
def test_today_is_no_answer_where_it_is_not_allowed(
    touching: cm.TimingDiagram, asked: dict[str, Any]
) -> None:
    if "laws" in asked:
        found = optimise(touching, REST, still=STILL, **asked)
        assert found.design["die"].moves[0].law == cm.LAWS["modified sine"]
    else:
        with pytest.raises(InputError, match="No starts and angles"):
            optimise(touching, REST, still=STILL, **asked)


def test_what_is_good_today_stays_as_it_is() -> None:
    found = optimise(make_diagram(), RULE, still=STILL).design
    assert optimise(found, RULE, still=STILL).design == found


def test_what_is_found_worse_than_today_is_not_returned(monkeypatch: pytest.MonkeyPatch) -> None:
    """A bound that today's peak refutes is none, too."""
    best = optimise(make_diagram(), RULE, still=STILL).design
    monkeypatch.setattr("cammotion.whole.optimise.place", lambda *_: Found(None, np.inf))
    found = optimise(best, RULE, still=STILL)
    assert (found.design, found.bound) == (best, 0)


def test_no_move_is_given_up_for_rounding() -> None:
    """What the solver said of all moves was more than each had by its rounding: all seemed stuck.

    The second rise of B was left at 13.883 deg. A and C are as they bind it, with a limit as high
    as a rest.
    """
    p, q, h = "3-4-5 polynomial", "4-5-6-7 polynomial", "simple harmonic"
    a = cm.motion(
        "A",
        *(
            cm.rise(30.537765209, over_deg=131.31, law=h),
            cm.return_(30.537765209, over_deg=206.87, law=q),
        ),
        cm.dwell(21.82),
    )
    b = cm.motion(
        "B",
        *(cm.rise(40.849229145, over_deg=15.18), cm.dwell(91.44)),
        *(cm.rise(40.849229145, over_deg=102.7, law=p), cm.dwell(89.51)),
        cm.return_(81.69845829, over_deg=61.17, law=h),
        start_deg=720.5,
        start_mm=5,
    )
    c = cm.motion(
        "C",
        *(cm.rise(15.783223134, over_deg=60.5, law=p), cm.dwell(86.81)),
        *(cm.return_(15.783223134, over_deg=109.78, law=q), cm.dwell(102.91)),
        start_mm=-3,
    )
    rules = [
        cm.ClearanceRule(cm.within("C", -2.4720759590745067), cm.within("B", 45.849229145)),
        cm.ClearanceRule(cm.beyond("A", 0.30537765209), cm.within("B", 11.806015872630443)),
    ]
    still: dict[str, Any] = {
        "A": [(338.18, 360)],
        "B": [(735.68, 827.12), (929.82, 1019.33)],
        "C": [(95.77098391392956, 119.10839839897778)],
    }
    found = optimise(cm.TimingDiagram([a, b, c], 5400), rules, still=still)
    assert found.design["B"].moves[1].angle_deg == pytest.approx(102.7)


# By other ways


@pytest.mark.parametrize("seed", range(3))  # more are drawn in tests/fresh
def test_never_worse_than_one_after_the_other_and_never_below_the_bound(seed: int) -> None:
    rng = np.random.default_rng(seed + 500)
    crowd = draw(rng, 2 + seed % 5)
    found = optimise(crowd.diagram, crowd.rules, still=crowd.still, laws=LAWS)
    assert cm.find_violations(found.design, crowd.rules) == ()
    others = [peak(design) for design in designs(crowd, rng) if keeps(crowd, design)]
    assert found.reached <= min(others) * (1 + 1e-4)
    least = cm.least_peak(
        crowd.diagram, crowd.rules, still=crowd.still, travel_mm=crowd.travel_mm, gap=0.3, seconds=3
    )
    assert least.bound <= found.reached


def test_an_evolution_finds_nothing_better() -> None:
    """Every start and angle within 2 deg and more of the best, each design checked by the rules."""
    best = optimise(make_diagram(), RULE, still=STILL).reached

    def cost(x: Any) -> float:
        start, width, down, up = x
        mill = make_mill(width, middle_deg=start + width / 2)
        die = make_die(down, up_deg=up)
        design = make_diagram(mill, die)
        excess = sum(one.end_deg - one.start_deg for one in cm.find_violations(design, RULE))
        return peak(design) + excess

    ranges = [(-20, 5), (140, 190), (80, 125), (80, 125)]
    found = differential_evolution(cost, ranges, seed=1, maxiter=30, popsize=8, tol=1e-9)
    assert found.fun >= best * (1 - 1e-6)
    assert found.fun <= best * 1.05


# Nonsense


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"still": {}}, "No part is free"),
        ({"still": {"wheel": [DOWN_DEG]}}, "no motion 'wheel'"),
        ({"laws": "cycloidal"}, "give a list"),
        ({"laws": []}, "is empty"),
        ({"laws": ["no law"]}, "no motion law 'no law'"),
        ({"laws": {"wheel": ["cubic"]}}, "no free part 'wheel'"),
        ({"laws": [cm.CONSTANT_VELOCITY]}, "does not rest at both its ends"),
        ({"starts_deg": [(0, 1)]}, "give a dictionary"),
        ({"starts_deg": {"wheel": [None]}}, "no free part 'wheel'"),
        ({"starts_deg": {"mill": [(2, 1)]}}, "the smaller one first"),
        ({"starts_deg": {"mill": [None, None]}}, "it has 1 moves"),
        ({"starts_deg": {"mill": [(210, 300)]}}, "would lie in a still arc"),
        ({"starts_deg": {"die": [(250, 260), None]}}, "would lie in a still arc"),
        ({"angles_deg": {"die": [(131, 140), (131, 140)]}}, "No starts and angles"),
        ({"angles_deg": {"die": [(400, 500), None]}}, "from 400 to 500 deg; it can be from"),
        ({"angles_deg": {"die": [None, (0, 0)]}}, "from 0 to 0 deg; it can be from"),
        ({"at_most": {"mill": 0.3}}, "No starts and angles"),
        ({"seconds": -1}, "time is -1 s"),
    ],
)
def test_what_makes_no_sense_is_said(changed: dict[str, Any], words: str) -> None:
    asked: dict[str, Any] = {"still": STILL} | changed
    with pytest.raises(InputError, match=words):
        optimise(make_diagram(), RULE, **asked)


@pytest.mark.parametrize("solver", [cm.optimise, cm.least_peak])
def test_where_parts_have_to_stand_against_a_rule_is_said(solver: Any) -> None:
    early = make_die(down_deg=(100, 200))
    with pytest.raises(InputError, match=r"From 100 to 1\S+ deg the die has to stand, and there"):
        solver(make_diagram(make_mill(), early), RULE, still={"die": [(100, 200)]})
    late = make_diagram(make_mill(30, middle_deg=170), early)
    both = {"mill": [(0, 150)], "die": [(100, 140)]}
    assert solver(late, RULE, still=both).design


@pytest.mark.parametrize("limit_mm", [45, 49, 49.5])
def test_rules_that_leave_a_part_no_height_are_said_to_be_too_strong(limit_mm: float) -> None:
    """While the mill passes its middle the die may be neither beyond 19 mm nor within."""
    rules = [
        cm.ClearanceRule(half("die", 19), only_while=cm.within("mill", limit_mm))
        for half in (cm.beyond, cm.within)
    ]
    with pytest.raises(InputError, match="No starts and angles of these moves keep all of this"):
        optimise(make_diagram(), rules, still=STILL)


def test_a_force_over_an_arc_without_a_sample_in_a_move_is_no_error() -> None:
    table = cm.indexing_motion(
        "table", cm.rise(275, over_deg=120, law="modified sine"), cm.dwell(240), stops=8
    )
    press = cm.motion(
        "press",
        *(cm.rise(40, over_deg=70), cm.dwell(80), cm.return_(40, over_deg=70), cm.dwell(140)),
        start_deg=130,
    )
    loads = {
        "table": cm.FollowerLoad(mass_kg=103.5),
        "press": cm.FollowerLoad(mass_kg=20, weight_N=-196),
    }
    shaft = cm.Camshaft(
        cm.TimingDiagram([table, press], 3000),
        loads,
        process=[cm.ProcessForce(motion="press", from_deg=190, to_deg=200, force_N=0, last_N=5000)],
        friction_N={"table": 200.0},
    )
    rule = cm.ClearanceRule(cm.beyond("press", 5), cm.within("table", 0.2))
    still = {"table": [(200, 280)], "press": [(200, 280)]}
    found = cm.optimise(shaft, rule, still=still, minimise="torque", seconds=4)
    assert found.reached == pytest.approx(found.tried[0], rel=1e-6)
    assert found.reached < abs(shaft.peak_torque().value)


def test_a_wrong_answer_is_never_given_out(monkeypatch: pytest.MonkeyPatch) -> None:
    from cammotion.whole import movers

    monkeypatch.setattr(movers, "_apart", lambda *_: iter(()))  # as if there were no rules
    with pytest.raises(WrongAnswerError, match="too deep"):
        optimise(make_diagram(), RULE, still=STILL)


@pytest.mark.parametrize("turns", [-30, 4, 100])
def test_a_part_may_begin_some_turns_later(turns: int) -> None:
    diagram = make_diagram()
    later = diagram.with_motion(diagram["die"].shifted(360 * turns))
    found = optimise(later, RULE, still=STILL)
    assert found.reached == pytest.approx(optimise(diagram, RULE, still=STILL).reached)


def test_without_moves_there_is_nothing_to_place() -> None:
    table = cm.motion("table", cm.dwell(360))
    diagram = cm.TimingDiagram([table, make_diagram()["mill"]], 2000)
    rule = cm.ClearanceRule(cm.beyond("table", 5), only_while=cm.within("mill", 0.65))
    found = optimise(diagram, rule, still={"table": [(0, 300)]})
    assert found.reached == 0
    assert found.design == diagram


def test_rules_of_steep_moves_are_kept_to_the_last_digit() -> None:
    """A slide that is 4 mm on at each deg, held by the one beside it: rounding would show."""
    moves = cm.rise(120, over_deg=40), cm.dwell(60), cm.return_(120, over_deg=40)
    gripper = cm.motion("gripper", *moves, cm.dwell(220), start_deg=150)
    moves = cm.rise(30, over_deg=35), cm.dwell(115), cm.return_(30, over_deg=35)
    ejector = cm.motion("ejector", *moves, cm.dwell(175), start_deg=110)
    rule = cm.ClearanceRule(cm.beyond("gripper", 80), only_while=cm.beyond("ejector", 25))
    diagram = cm.TimingDiagram([gripper, ejector], 2000)
    still = {"gripper": [(190, 250)], "ejector": [(200, 240)]}
    found = optimise(diagram, rule, still=still)
    assert cm.find_violations(found.design, rule) == ()
    assert found.reached < diagram.peak_acceleration("gripper")


def test_the_answer_is_what_it_is_called() -> None:
    found = optimise(make_diagram(), [RULE], still=STILL)
    assert isinstance(found, Optimised)
    assert found.diagram == make_diagram()


def test_a_law_whose_velocity_jumps_is_refused() -> None:
    """It rests at its ends, and jumps within: no angle makes its peak finite."""
    x, quarter = cm.x, sympy.Rational(1, 4)
    part = sympy.Piecewise((0 * x, x <= quarter), (2 * (x - quarter), x <= 3 * quarter), (1, True))
    law = cm.MotionLaw("stop and go", part)
    choices: list[list[str | cm.MotionLaw]] = [[law], ["cycloidal", law]]
    for laws in choices:
        with pytest.raises(cm.InputError, match="velocity of the law 'stop and go' jumps"):
            cm.optimise(make_diagram(), RULE, still=STILL, laws=laws)


@pytest.mark.parametrize("minimise", ["peak", "torque"])
def test_too_short_a_time_is_no_proof(minimise: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """It was told that no starts and angles keep the rules; those of today may be known to."""
    monkeypatch.setattr(Rows, "solve", lambda *_: Mixed(None, None))
    shaft = cm.Camshaft(make_diagram(), {"die": cm.FollowerLoad(mass_kg=12)})
    short: dict[str, Any] = {"still": STILL, "minimise": minimise, "seconds": 0.2}
    kept = cm.optimise(shaft, RULE, **short)
    assert (kept.design, kept.bound, kept.is_best) == (make_diagram(), 0, False)
    with pytest.raises(cm.InputError, match=r"In .* s no starts .* nor that there are none: give"):
        cm.optimise(shaft, RULE, starts_deg={"die": [(140, 149), None]}, **short)


def test_no_part_gets_harder_for_nothing() -> None:
    """The hardest part cannot move; which of two goes first through the gaps of a third decides."""
    wide = cm.rise(60, over_deg=15), cm.dwell(140), cm.return_(60, over_deg=15), cm.dwell(190)
    hard = cm.motion("hard", *wide)
    waves = [
        part
        for rest in (30, 140, 130)
        for part in (
            cm.rise(10, over_deg=5),
            cm.dwell(10),
            cm.return_(10, over_deg=5),
            cm.dwell(rest),
        )
    ]
    gate = cm.motion("gate", *waves)
    first, second = (
        cm.motion(
            name,
            *(cm.rise(5, over_deg=over), cm.dwell(work), cm.return_(5, over_deg=over)),
            cm.dwell(360 - 2 * over - work),
            start_deg=gate.moves[at].to_deg,
        )
        for name, over, work, at in (("first", 63, 14, 3), ("second", 58.5, 13, 5))
    )
    diagram = cm.TimingDiagram([hard, gate, first, second], rate_per_hour=2000)
    rules = [cm.ClearanceRule(cm.beyond("gate", 1), cm.within(n, 0.2)) for n in ("first", "second")]
    still = {"hard": [(15, 155), (170, 360)], "first": [(6, 12)], "second": [(6, 12)]}
    found = optimise(diagram, rules, still=still)
    today = sorted(map(diagram.peak_acceleration, still), reverse=True)
    design = sorted(found.peaks.values(), reverse=True)
    assert design[0] == pytest.approx(today[0])
    assert design[1] <= today[1] * (1 + 1e-5)


def test_what_is_printed_after_a_solution_is_seen(capfd: pytest.CaptureFixture[str]) -> None:
    rows = Rows()
    rows.unknown(0.0, 1.0, cost=1.0)
    assert rows.solve().bound == 0
    os.write(1, b"seen")
    os.write(2, b"told")
    assert capfd.readouterr() == ("seen", "told")
