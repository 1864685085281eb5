"""The least acceleration of turrets: at which stop they are best is a part of the answer."""

import math
from dataclasses import replace
from itertools import product
from typing import Any

import numpy as np
import pytest
from scipy import sparse
from turrets import ANGLES, Duty, Turret, draw, draw_motion, least_by_trying

import cammotion as cm
from cammotion import ClearanceRule, beyond, within
from cammotion.limits.least import LeastAcceleration, least_acceleration
from cammotion.limits.linear import Program, solve


def make_case(*die: Any, start_deg: float, move_deg: float = 150) -> cm.TimingDiagram:
    """Return a mill with a pitch of 100 mm and a die of these parts."""
    rest = cm.dwell(360 - sum(part.angle_deg for part in die))
    mill = cm.indexing_motion(
        "mill", cm.rise(100, over_deg=move_deg), cm.dwell(360 - move_deg), stops=24
    )
    return cm.TimingDiagram([mill, cm.motion("die", *die, rest, start_deg=start_deg)], 2000)


def near(limit_mm: float) -> ClearanceRule:
    return ClearanceRule(beyond("die", 19), only_while=within("mill", limit_mm))


def single_index(over_deg: float) -> float:
    """Return the peak acceleration of an index by constant acceleration, in m/s2."""
    return 4 * 0.1 / (1.8 * over_deg / 360) ** 2


@pytest.mark.parametrize("cells", [48, 180])
def test_a_die_that_is_down_in_the_middle_of_the_present_move(cells: int) -> None:
    """The mill need not be half-way there: it goes on later, over 158 deg from 192 on."""
    diagram = make_case(
        cm.rise(50, over_deg=2), cm.dwell(120), cm.return_(50, over_deg=2), start_deg=76
    )
    found = least_acceleration(diagram, "mill", near(0.65), still=[(350, 360)], cells=cells)
    assert found.bound <= single_index(158) == pytest.approx(0.641, abs=5e-4)
    assert found.bound <= found.reached <= 1.01 * found.bound
    assert cm.find_violations(found.design, near(0.65)) == ()


def test_a_die_that_is_down_from_before_the_middle_until_after_the_move() -> None:
    """Nothing was possible, it was said; an index from 204 to 350 deg is."""
    diagram = make_case(
        cm.rise(50, over_deg=2), cm.dwell(128), cm.return_(50, over_deg=2), start_deg=70
    )
    found = least_acceleration(diagram, "mill", near(0.65), still=[(350, 360)], cells=180)
    assert found.bound <= found.reached <= single_index(146)
    assert cm.find_violations(found.design, near(0.65)) == ()


def test_a_present_motion_that_breaks_the_rule() -> None:
    """The die is still deep when the mill is half-way: the stop it is at changed there."""
    die = cm.rise(50, over_deg=55), cm.dwell(145), cm.return_(50, over_deg=55)
    diagram = make_case(*die, start_deg=150, move_deg=34)
    assert len(cm.find_violations(diagram, near(13))) == 1
    found = least_acceleration(diagram, "mill", near(13), still=[(350, 360)], cells=48)
    assert found.reached < 2.7
    assert cm.find_violations(found.design, near(13)) == ()


# Against a way that knows nothing of the package


def solve_turret(turret: Turret, **more: Any) -> LeastAcceleration:
    still = [arc[:2] for arc in turret.still]
    return least_acceleration(turret.diagram(), "mill", turret.rules(), still=still, **more)


def solve_unless_coarse(turret: Turret, least: float, **more: Any) -> LeastAcceleration | None:
    """Return what is found; None where nothing is possible, or not on a grid of 90 cells."""
    try:
        return solve_turret(turret, cells=90, **more)
    except cm.InputError as refusal:
        if math.isfinite(least) and not str(refusal).startswith("On a grid of 9"):
            raise
        return None


@pytest.mark.parametrize("seed", range(8))  # more are drawn in tests/fresh
def test_every_choice_of_stops_tried_is_as_good(seed: int) -> None:
    turret = draw(np.random.default_rng(seed))
    least = least_by_trying(turret)
    found = solve_unless_coarse(turret, least)
    if not found:
        return
    assert least <= found.reached * (1 + 1e-6)
    assert found.bound <= found.reached
    angles = np.linspace(0, 360, 7201)
    assert turret.strays_mm(found.motion.position_mm(angles), angles) < 1e-5
    for start, end, place in turret.still:
        off = found.motion.position_mm(np.linspace(start, end, 9)) - place
        turns = off / (24 * turret.pitch_mm)
        assert turns == pytest.approx(np.round(turns), abs=1e-8)


@pytest.mark.parametrize("seed", [154])
def test_the_finer_the_tried_grid_the_nearer_it_comes(seed: int) -> None:
    """It has no nodes at the ends of arcs, so that it only comes near from below."""
    turret = draw(np.random.default_rng(seed))
    found = solve_turret(turret, cells=180)
    coarse, fine = (least_by_trying(turret, nodes) for nodes in (200, 700))
    assert coarse < fine <= found.reached
    assert found.reached - fine < 0.6 * (found.reached - coarse)


@pytest.mark.parametrize("seed", range(10))
def test_no_motion_made_by_hand_is_below_the_bound(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turret, jerky = draw(rng), bool(rng.random() < 0.5)
    angles = turret.still[0][0] + ANGLES
    drawn = [draw_motion(turret, rng, jerky) for _ in range(300)]
    good = [motion for motion in drawn if not turret.strays_mm(motion[0], angles, 0.26)]
    if not good:
        return
    places, peak, jerk = min(good, key=lambda motion: motion[1])
    more = {"travel_mm": (places.min() - 0.01, places.max() + 0.01)} if seed % 3 == 0 else {}
    found = solve_unless_coarse(turret, peak, jerk_m_per_s3=jerk * (1 + 1e-9), **more)
    assert not found or found.bound <= peak * (1 + 1e-6)


def test_two_arcs_close_to_each_other() -> None:
    """2.25 deg from away to near: what counts is the step from the one to the other, not a stop."""
    duties = Duty(401.503, 413.477, 2.603, True), Duty(415.731, 427.727, 0.13, False)
    turret = Turret(26.03, ((225.426, 275.46, -290.5),), duties)
    found = solve_turret(turret, cells=360)
    assert least_by_trying(turret) <= found.reached
    assert found.bound <= found.reached < 25


def test_two_dies_that_hold_a_turret_at_two_stops_at_once() -> None:
    """Of the one it is seen over 0.2 deg alone, before it may leave its first still arc."""
    duties = Duty(-250.163, -155.283, 25.584, False), Duty(-218.82, -73.549, 38.376, False)
    still = (-286.049, -249.955, 179.47), (-111.539, -73.634, 264.75)
    turret = Turret(85.28, still, duties)
    assert least_by_trying(turret) == math.inf
    with pytest.raises(cm.InputError, match="No motion keeps all of this"):
        solve_turret(turret, cells=90)
    later = Duty(-249.9, -155.283, 25.584, False), duties[1]
    assert math.isfinite(least_by_trying(Turret(85.28, still, later)))


def test_a_turret_that_can_only_stand_where_near_and_away_meet() -> None:
    """At the tenth of a pitch that the one calls near and the other away it keeps to both."""
    duties = (
        Duty(-170.59, -18.19, 14.348, False),
        Duty(51.393, 65.869, 14.348, False),
        Duty(-160.281, -103.42, 14.348, True),
    )
    turret = Turret(-143.48, ((-286.236, -227.886, 252.93),), duties)
    assert least_by_trying(turret) == math.inf
    found = solve_turret(turret, cells=90)
    assert found.bound <= found.reached
    assert least_by_trying(turret, may_touch=True) <= found.reached
    both = np.linspace(-159, -104, 50)
    off = np.mod(found.motion.position_mm(both) - 252.93, 143.48)
    assert np.minimum(off, 143.48 - off) == pytest.approx(14.348, abs=1e-5)


def test_a_turret_of_one_stop_and_a_travel_within_the_turn_in_which_it_begins() -> None:
    """From 0 to 100 mm while it goes from 37 to 397 deg, and so at 0 mm at 37 deg."""
    parts = cm.rise(50, over_deg=75), cm.rise(50, over_deg=75), cm.dwell(210)
    mill = cm.indexing_motion("mill", *parts, stops=1, start_deg=37)
    diagram = cm.TimingDiagram([mill, cm.EXAMPLE.die], 2000)
    rule = cm.EXAMPLE.rule
    found = least_acceleration(
        diagram, "mill", rule, still=[(205, 305)], travel_mm=(0, 100), cells=90
    )
    open_ended = replace(found.motion, stops=24)
    places = open_ended.position_mm(np.linspace(37, 396.9, 1000))
    assert places[0] == pytest.approx(0, abs=1e-5)
    assert places.min() > -1e-5
    assert places.max() < 100 + 1e-5
    freer = least_acceleration(diagram, "mill", rule, still=[(205, 305)], cells=90)
    assert freer.bound < found.bound


# Words and refusals


def mill_rule(own: Any, depth_mm: float = 19) -> ClearanceRule:
    return ClearanceRule(beyond("die", depth_mm), only_while=own)


NEVER = [
    (mill_rule(beyond("mill", 50)), "pitch of 100 mm the mill is never beyond 50 mm of a stop; gi"),
    (mill_rule(within("mill", 10), -1), "the mill has to be within 10 mm of a stop over the whole"),
    (
        [mill_rule(within("mill", 10)), mill_rule(beyond("mill", 11), 25)],
        "at 177.5 deg the rules want the mill nearer to a stop, and farther from it, than it can",
    ),
]


@pytest.mark.parametrize(("rules", "why"), NEVER)
def test_what_no_turret_can_do_is_refused(rules: Any, why: str) -> None:
    with pytest.raises(cm.InputError, match=r"^No motion keeps all of this: .*" + why):
        least_acceleration(cm.EXAMPLE.diagram, "mill", rules, still=[(345, 355)])


def test_a_turret_that_stands_about_two_stops_within_one_arc_is_refused() -> None:
    die = cm.rise(50, over_deg=2), cm.dwell(238), cm.return_(50, over_deg=2)
    diagram = make_case(*die, start_deg=300)
    with pytest.raises(cm.InputError, match=r"^At 340 deg the mill has to stand at 100 mm, where "):
        least_acceleration(diagram, "mill", near(2), still=[(340, 358), (170, 180)])


def test_what_is_not_covered_is_said() -> None:
    with pytest.raises(cm.InputError, match=r"^The mill has to be beyond 0 mm of a stop; a motion"):
        least_acceleration(
            cm.EXAMPLE.diagram, "mill", mill_rule(beyond("mill", 0)), still=[(205, 305)]
        )


def test_what_always_holds_asks_for_nothing() -> None:
    rule = mill_rule(within("mill", 50))
    found = least_acceleration(cm.EXAMPLE.diagram, "mill", rule, still=[(205, 305)], cells=90)
    assert found.reached == pytest.approx(single_index(260), rel=1e-3)


# Whole numbers


def small_program(rng: np.random.Generator) -> Program:
    """Return a program of four numbers from -3 to 3, the last three of them whole."""
    rows, limits = rng.integers(-5, 6, (4, 4)), rng.integers(-6, 7, 4)
    bounds = np.array([[-3.0, 3.0]] * 4)
    none = [sparse.csr_matrix((1, 4))], [np.zeros(1)]
    at_most = [sparse.csr_matrix(rows.astype(float))], [limits.astype(float)]
    objective = rng.integers(-9, 10, 4).astype(float)
    return Program(objective, at_most, none, bounds, "Nothing.", whole=range(1, 4))


@pytest.mark.parametrize("seed", range(15))
def test_a_program_with_whole_numbers_is_as_good_as_the_best_of_all(seed: int) -> None:
    program = small_program(np.random.default_rng(seed))
    first, *rest = program.objective
    rows, limits = program.at_most[0][0].toarray(), program.at_most[1][0]
    best = math.inf
    for whole in product(range(-3, 4), repeat=3):
        room = limits - rows[:, 1:] @ np.array(whole)
        steep, flat = rows[:, 0] != 0, rows[:, 0] == 0
        ends = room[steep] / rows[steep, 0]
        low = max([-3.0, *ends[rows[steep, 0] < 0]])
        high = min([3.0, *ends[rows[steep, 0] > 0]])
        if low <= high + 1e-12 and np.all(room[flat] >= 0):
            best = min(best, min(first * low, first * high) + float(np.dot(rest, whole)))
    if math.isinf(best):
        with pytest.raises(cm.InputError, match=r"^Nothing\.$"):
            solve(program)
        return
    found = solve(program)
    assert found.bound == pytest.approx(best, abs=1e-7)
    assert program.objective @ found.unknowns == pytest.approx(best, abs=1e-5)
