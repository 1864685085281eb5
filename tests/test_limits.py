"""The least peak acceleration: between two bounds that close, and against formulas and laws."""

import math
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from crowds import draw_any
from hypothesis import assume, given
from hypothesis import strategies as st
from long_arrays import assert_near
from machines import DOWN_DEG, RULE, examples, make_diagram, make_die, make_mill
from scipy.optimize import brentq

import cammotion as cm
from cammotion import ClearanceRule, TimingDiagram, beyond, within
from cammotion.limits.least import LeastAcceleration, least_acceleration
from cammotion.limits.ramps import Ramp, law_of
from cammotion.machine.motions import Motion

OFF_MM = float(make_mill().offset_mm(135))
EXAMPLE = ClearanceRule(beyond("die", 19), only_while=within("mill", OFF_MM))
LOOSE = ClearanceRule(beyond("die", 1000), only_while=within("mill", 0.65))  # never binds
STILL = [DOWN_DEG]
TRAVEL = (0, 50)
TURN_S = 1.8
PER_S = (360 / TURN_S) ** 2 / 1000  # mm/deg2 -> m/s2

FREE = 31 / 2425 * PER_S
HELD = 50 / (70 / (2 - math.sqrt(0.76))) ** 2 * PER_S  # in 0..50 mm
SOLVED = 1e-7  # of the value: what the solver may round, and the price of needless changes
JERK = 20


@cache
def solve(
    travel: tuple[float, float] | None = None,
    jerk: float = math.inf,
    cells: int = 180,
    rule: ClearanceRule = EXAMPLE,
) -> LeastAcceleration:
    return least_acceleration(
        make_diagram(), "die", rule, still=STILL, travel_mm=travel, jerk_m_per_s3=jerk, cells=cells
    )


def gap(found: LeastAcceleration) -> float:
    return found.reached / found.bound - 1


# Formulas


@pytest.mark.parametrize(("travel", "exact"), [(None, FREE), (TRAVEL, HELD)])
@pytest.mark.parametrize("cells", [12, 36, 77, 90, 180, 360, 720])
def test_the_formula_lies_between_the_bounds(
    travel: tuple[float, float] | None, exact: float, cells: int
) -> None:
    found = solve(travel, cells=cells)
    assert found.bound <= exact * (1 + 1e-9)
    assert found.reached >= exact * (1 - 1e-9)
    assert gap(found) < 2.5 * (36 / cells) ** 2 + 1e-6


def test_the_formulas_are_those_of_the_source() -> None:
    assert pytest.approx(0.5113402, abs=5e-8) == FREE
    assert pytest.approx(0.5195432, abs=5e-8) == HELD
    lowest, highest = solve(cells=720).motion.range_mm
    assert lowest == pytest.approx(-4.0103, abs=5e-5)
    assert highest == pytest.approx(50, abs=1e-9)


@pytest.mark.parametrize("jerk", [math.inf, JERK])
@pytest.mark.parametrize("travel", [None, TRAVEL])
def test_half_a_cell_leaves_a_quarter_of_the_gap(
    travel: tuple[float, float] | None, jerk: float
) -> None:
    """On average: whether a node lies where the acceleration changes is a matter of luck."""
    coarse, fine = (gap(solve(travel, jerk, cells)) for cells in (45, 360))
    assert 2.5**3 < coarse / fine < 6**3 or fine < 1e-6


@pytest.mark.parametrize("jerk", [math.inf, JERK])
@pytest.mark.parametrize("travel", [None, TRAVEL])
def test_a_finer_grid_is_never_worse(travel: tuple[float, float] | None, jerk: float) -> None:
    """Each grid has the nodes of the one before, so that more is known and more is possible."""
    found = [solve(travel, jerk, cells) for cells in (36, 72, 144, 288)]
    for coarse, fine in pairwise(found):
        assert fine.bound >= coarse.bound * (1 - SOLVED)
        assert fine.reached <= coarse.reached * (1 + 2e-5)  # the way out of 0..50 mm is mended


def test_limits_that_lie_beside_the_even_grid() -> None:
    """0.65 mm are left at 134.9617 deg; the formulas hold for any angle at which the mill waits."""
    [(start, end)] = make_mill().where_beyond(0.65)
    way = 360 - 305 + start
    assert way == pytest.approx(205 - end)
    weights = np.maximum(way - (np.arange(130_000) + 0.5) / 1000, 0)
    least = max(31 / (np.abs(weights - c).sum() / 1000) for c in np.linspace(4, 6, 201)) * PER_S
    for cells in (90, 180, 720):
        found = solve(cells=cells, rule=RULE)
        assert found.bound <= least * (1 + 1e-6)
        assert found.reached >= least * (1 - 1e-6)
    assert gap(solve(cells=720, rule=RULE)) < 1e-4
    held = 50 / (way / (2 - math.sqrt(0.76))) ** 2 * PER_S
    found = solve(TRAVEL, cells=720, rule=RULE)
    assert found.bound <= held <= found.reached
    assert gap(found) < 1e-4


def test_from_below_by_weights() -> None:
    """From 305 deg on, u = 0, to its middle at u = 130 the free die makes -31 mm until u = 70.

    The integral of (70 - u)+ a is -31, that of a is 0; so 31 <= a times that of |(70 - u)+ - c|,
    whatever c is.
    """
    u = (np.arange(130_000) + 0.5) / 1000
    bounds = {c: 31 / (np.abs(np.maximum(70 - u, 0) - c).sum() / 1000) for c in range(70)}
    assert max(bounds, key=lambda c: bounds[c]) == 5
    assert bounds[5] == pytest.approx(31 / 2425, rel=1e-6)
    found = solve(cells=720)
    pushes = found.design.acceleration("die", 305 + u) / PER_S
    assert (np.maximum(70 - u, 0) * pushes).sum() / 1000 == pytest.approx(-31, abs=1e-3)
    assert pushes.sum() / 1000 == pytest.approx(0, abs=1e-3)
    assert found.bound == pytest.approx(bounds[5] * PER_S, rel=1e-6)


def reach_19_mm(peak: float, jerk: float) -> float:
    """Return how far a free die is, in mm, from 19 mm when the mill starts, by ramps of jerk.

    Its acceleration goes from 0 to -peak, from there to +peak, and stays so until the middle.
    """
    middle, when, ramp = TURN_S * 130 / 360, TURN_S * 70 / 360, peak / jerk
    switch = middle / 2 + ramp / 4  # the velocity is 0 in the middle
    corners = [0, ramp, switch - ramp, switch + ramp, middle]
    times = np.linspace(0, when, 200_001)
    pushes = np.interp(times, corners, [0, -peak, -peak, peak, peak])
    steps = (pushes[1:] + pushes[:-1]) / 2 * (when - (times[1:] + times[:-1]) / 2)
    return float(31 + 1000 * steps.sum() * when / 200_000)


@pytest.mark.parametrize("jerk", [10, 20, 60])
def test_ramps_of_jerk_that_are_solved_for_are_as_good(jerk: float) -> None:
    peak = brentq(lambda a: reach_19_mm(a, jerk), 0.3, 2)
    found = solve(jerk=jerk, cells=720)
    assert found.bound <= peak * (1 + 1e-6)
    assert found.reached == pytest.approx(peak, rel=2e-3)
    assert gap(found) < 2e-3


def make_step(stroke_mm: float, angle_deg: float, start_deg: float = 40) -> Motion:
    """Return a die that only has to come from one place to another over an angle."""
    return cm.motion(
        "die",
        cm.rise(stroke_mm, over_deg=angle_deg),
        cm.dwell(20),
        cm.return_(stroke_mm, over_deg=320 - angle_deg),
        cm.dwell(20),
        start_deg=start_deg,
    )


def solve_step(stroke: float, angle: float, start: float = 40, **more: Any) -> LeastAcceleration:
    still = [(start + angle, start + angle + 20), (start + 340, start + 360)]
    diagram = make_diagram(make_mill(), make_step(stroke, angle, start))
    return least_acceleration(diagram, "die", LOOSE, still=still, **more)


@pytest.mark.parametrize(
    ("stroke", "angle", "cells"), [(50, 90, 360), (7, 33.3, 720), (80, 160, 90)]
)
def test_from_rest_to_rest_nothing_beats_the_parabola(
    stroke: float, angle: float, cells: int
) -> None:
    """Half the time forward and half the time back: 4 h / T2."""
    exact = 4 * stroke / angle**2 * PER_S
    found = solve_step(stroke, angle, cells=cells)
    assert found.bound <= exact * (1 + SOLVED)
    assert found.reached >= exact * (1 - SOLVED)
    assert gap(found) < 20 * (360 / cells / angle) ** 2


@pytest.mark.parametrize("share", [1.02, 1.5, 4, 50])
def test_from_rest_to_rest_with_ramps(share: float) -> None:
    """With ramps of A/J the way is h = T/2 (T/2 - A/J) A; J has to be at least 32 h / T3."""
    stroke, angle = 50, 100
    time = TURN_S * angle / 360
    jerk = share * 32 * stroke / 1000 / time**3
    exact = (jerk * time - math.sqrt((jerk * time) ** 2 - 32 * stroke / 1000 * jerk / time)) / 4
    assert (time / 2) * (time / 2 - exact / jerk) * exact == pytest.approx(stroke / 1000)
    found = solve_step(stroke, angle, jerk_m_per_s3=jerk, cells=720)
    assert found.bound <= exact * (1 + SOLVED)
    assert found.reached >= exact * (1 - SOLVED)
    assert gap(found) < 0.01


def test_less_jerk_than_that_is_refused() -> None:
    time = TURN_S * 100 / 360
    with pytest.raises(cm.InputError, match=r"^No motion keeps all of this: allow more jerk or mo"):
        solve_step(50, 100, jerk_m_per_s3=0.98 * 1.6 / time**3, cells=180)


def test_a_grid_that_is_too_coarse_is_not_held_against_all_motions() -> None:
    jerk = 1.001 * 1.6 / (TURN_S * 100 / 360) ** 3
    with pytest.raises(cm.InputError, match=r"^On a grid of .* cells no motion keeps .*: take"):
        solve_step(50, 100, jerk_m_per_s3=jerk, cells=37)
    assert solve_step(50, 100, jerk_m_per_s3=jerk, cells=720).bound > 0


def test_where_nothing_drives_it_the_motion_stays() -> None:
    found = least_acceleration(make_diagram(), "die", LOOSE, still=STILL, cells=90)
    assert (found.bound, found.reached) == (0, 0)
    assert found.motion.moves == ()
    assert found.motion.range_mm == (50, 50)


@pytest.mark.parametrize("travel", [None, (0, 50), (50, 60), (0, 1e6)])
@pytest.mark.parametrize("jerk", [math.inf, 20])
def test_a_motion_that_may_stand_all_the_turn_is_found_to_stand(
    travel: tuple[float, float] | None, jerk: float
) -> None:
    """It stood at an end of its travel, and the solver held it off by a thousandth of a wiggle."""
    found = least_acceleration(
        make_diagram(), "die", [], still=STILL, travel_mm=travel, jerk_m_per_s3=jerk, cells=90
    )
    assert (found.bound, found.reached, found.motion.moves) == (0, 0, ())
    assert repr(found) == "Nothing makes the die move: it can stand all the turn."


def test_a_motion_that_stands_at_a_limit_of_beyond_has_to_leave_it() -> None:
    """At 50 mm it is not beyond that, by however little."""
    rule = ClearanceRule(within("die", 50), only_while=within("mill", OFF_MM))
    found = least_acceleration(make_diagram(), "die", rule, still=STILL, cells=90)
    assert cm.find_violations(make_diagram(), rule) != ()
    assert cm.find_violations(found.design, rule) == ()


def test_the_cells_that_are_told_are_those_that_were_asked_for() -> None:
    """The ends of its still arc are nodes of their own, which nobody asked for."""
    jerk = 1.001 * 1.6 / (TURN_S * 100 / 360) ** 3
    for cells in (31, 37):
        with pytest.raises(cm.InputError, match=f"^On a grid of {cells} cells no motion keeps"):
            solve_step(50, 100, jerk_m_per_s3=jerk, cells=cells)


def test_between_two_arcs_at_one_height_it_stays_too() -> None:
    found = least_acceleration(
        make_diagram(), "die", EXAMPLE, still=[(205, 230), (250, 270), (280, 305)], cells=90
    )
    assert [segment.kind for segment in found.motion.segments] == ["return", "rise", "dwell"]
    assert found.bound == pytest.approx(solve(cells=90).bound, rel=0.01)


# The motion that is found


@cache
def solve_mill(**more: Any) -> LeastAcceleration:
    diagram = cm.widest_move(make_diagram(), "die", RULE).diagram
    return least_acceleration(diagram, "mill", RULE, still=STILL, **more)


CASES: dict[str, Callable[[], LeastAcceleration]] = {
    "free": lambda: solve(cells=360),
    "held": lambda: solve(TRAVEL, cells=360),
    "free, with limited jerk": lambda: solve(jerk=JERK, cells=360),
    "held, with limited jerk": lambda: solve(TRAVEL, JERK, cells=360),
    "coarse": lambda: solve(TRAVEL, cells=36),
    "coarse, with limited jerk": lambda: solve(TRAVEL, JERK, cells=36),
    "beside the grid": lambda: solve(TRAVEL, JERK, 90, RULE),
    "step": lambda: solve_step(50, 90, cells=90),
    "step over 360 deg": lambda: solve_step(50, 90, 300, jerk_m_per_s3=JERK * 2, cells=90),
    "mill": lambda: solve_mill(cells=180),
    "mill, with limited jerk": lambda: solve_mill(cells=180, jerk_m_per_s3=JERK),
}


STILL_ARCS: dict[str, list[tuple[float, float]]] = {
    "step": [(130, 150), (380, 400)],
    "step over 360 deg": [(390, 410), (640, 660)],
}


@pytest.mark.parametrize("name", CASES)
def test_the_motion_keeps_what_it_has_to(name: str) -> None:
    found = CASES[name]()
    before, after = (diagram[found.motion.name] for diagram in (found.diagram, found.design))
    rule = LOOSE if "step" in name else RULE if name.startswith(("mill", "beside")) else EXAMPLE
    assert cm.find_violations(found.design, rule) == ()
    if name.startswith(("held", "coarse", "beside")):
        lowest, highest = after.range_mm
        assert lowest >= -1e-9
        assert highest <= 50 + 1e-9
    for start, end in STILL_ARCS.get(name, STILL):
        angles = np.linspace(start, end, 101)
        assert after.position_mm(angles) == pytest.approx(before.position_mm(angles), abs=1e-9)
    assert after.segments[-1].to_deg - after.segments[0].from_deg == pytest.approx(360)
    assert after.pitch_mm == pytest.approx(before.pitch_mm, abs=1e-9)
    assert (after.name, after.stops) == (before.name, before.stops)


@pytest.mark.parametrize("name", CASES)
def test_its_curves_are_derivatives_of_each_other(name: str) -> None:
    found = CASES[name]()
    design, which = found.design, found.motion.name
    angles = found.motion.start_deg + np.linspace(0, 360, 18_001)
    step = TURN_S / 18_000
    inner = (angles[1:] + angles[:-1]) / 2
    place, speed, push = (
        curve(which, angles) for curve in (design.position_mm, design.velocity, design.acceleration)
    )
    slopes = np.diff(place) / step / 1000
    assert_near(slopes, design.velocity(which, inner), abs=found.reached * step)
    means = np.diff(speed) / step
    away = np.abs(means - design.acceleration(which, inner)) > 1e-6 * found.reached
    if found.jerk_m_per_s3 == math.inf:
        assert away.sum() < 50  # it jumps there
    else:
        assert np.abs(np.diff(push)).max() <= found.jerk_m_per_s3 * step * (1 + 1e-6)
        assert np.abs(means - design.acceleration(which, inner)).max() <= found.jerk_m_per_s3 * step


@pytest.mark.parametrize("name", CASES)
def test_its_peaks_are_what_is_said_of_it(name: str) -> None:
    found = CASES[name]()
    design, which = found.design, found.motion.name
    angles = np.linspace(0, 360, 36_001) + 1e-4
    pushes = np.abs(design.acceleration(which, angles))
    assert pushes.max() == pytest.approx(found.reached, rel=2e-3)
    assert pushes.max() <= found.reached * (1 + 1e-12)
    assert found.bound <= found.reached * (1 + SOLVED)
    if found.jerk_m_per_s3 < math.inf:
        moves = found.motion.moves
        cut = moves[0].to_deg if len(moves) == 2 and moves[0].to_deg == moves[1].from_deg else 1e9
        far = np.abs((angles - cut + 180) % 360 - 180) > 360 / 90
        jerks = np.abs(design.jerk(which, angles[far]))
        assert jerks.max() <= found.jerk_m_per_s3 * (1 + 1e-6)
        assert jerks.max() > (0.8 if "coarse" in name else 0.999) * found.jerk_m_per_s3


@pytest.mark.parametrize("jerk", [math.inf, JERK])
def test_it_stays_off_its_limits_by_more_than_the_solver_rounds(jerk: float) -> None:
    for travel in (None, TRAVEL):
        found = solve(travel, jerk, cells=360)
        assert 5e-7 < cm.smallest_clearance(found.design, EXAMPLE).clearance_mm < 1e-5


@pytest.mark.parametrize(("bend", "zones"), [(0.0, 2), (1e-9, 2), (2e-8, 4)])
def test_ramps_of_one_line_are_one_zone(bend: float, zones: int) -> None:
    """Long ones as short ones: what counts is the acceleration, a hundred-millionth of it."""
    up = [Ramp(10, 0, 1), Ramp(10, 1, 2 + 10 * bend)]
    law = law_of([*up, *(Ramp(each.seconds, -each.starting, -each.ending) for each in up)], 1.0)
    assert len(law.curve.pieces) == zones


def test_the_law_of_the_motion_has_few_zones() -> None:
    """As many as the acceleration has straight lines, not as many as the grid has cells."""
    for found in (solve(cells=720), solve(TRAVEL, cells=720), solve(jerk=JERK, cells=720)):
        for move in found.motion.moves:
            assert isinstance(move.law, cm.MotionLaw)
            assert len(move.law.curve.branches) < 40


def test_where_a_rise_and_a_return_meet_the_acceleration_goes_on() -> None:
    found = solve(jerk=JERK, cells=360)
    back, down = found.motion.moves
    assert back.to_deg == down.from_deg
    before, after = (found.design.acceleration("die", back.to_deg + side) for side in (-1e-7, 1e-7))
    assert before == pytest.approx(after, abs=1e-5)
    assert after > 0.9 * found.reached  # the lowest point, pushed up


# The laws


@pytest.mark.parametrize("name", cm.LAWS)
def test_no_law_beats_the_bound(name: str) -> None:
    widest = cm.widest_move(make_diagram(make_mill(), make_die(law=name)), "die", EXAMPLE)
    assert widest.peak_acceleration >= solve(TRAVEL, cells=360).bound
    jerk = widest.diagram.peak_jerk("die")
    if jerk < math.inf:
        found = solve(TRAVEL, jerk, cells=360)
        assert solve(TRAVEL, cells=360).bound <= found.bound <= widest.peak_acceleration
        assert found.reached <= widest.peak_acceleration
        if name == "modified trapezoid":
            assert widest.peak_acceleration < 1.05 * found.bound


def test_the_mill_could_be_moved_more_gently() -> None:
    found = solve_mill(cells=360)
    assert found.bound < 0.7948 < found.reached + 1e-4
    assert gap(found) < 1e-3
    assert found.diagram.peak_acceleration("mill") == pytest.approx(1.117, abs=5e-4)
    angles = np.array([210.0, 300.0])
    assert found.motion.offset_mm(angles) == pytest.approx([0, 0], abs=1e-9)
    assert found.motion.position_mm(570) - found.motion.position_mm(210) == pytest.approx(100)
    assert cm.find_violations(found.design, RULE) == ()


def test_a_mill_that_stands_until_the_turn_is_over() -> None:
    """Its still arc ends where its segments begin anew, a pitch further on."""
    found = least_acceleration(make_diagram(), "mill", LOOSE, still=[(200, 360)], cells=180)
    exact = 4 * 100 / 200**2 * PER_S
    assert found.bound <= exact * (1 + SOLVED)
    assert found.reached == pytest.approx(exact, rel=1e-3)
    [move] = found.motion.moves
    assert (move.from_deg % 360, move.angle_deg, move.change_mm) == pytest.approx((0, 200, 100))


@pytest.mark.parametrize("still", [[(0, 200), (180, 370)], [(10, 200), (200, 369), (369, 370)]])
def test_what_stands_over_the_whole_turn_has_no_peak(still: list[tuple[float, float]]) -> None:
    table = cm.motion("table", cm.dwell(360), start_mm=5)
    rule = cm.ClearanceRule(cm.beyond("mill", 0.65), only_while=cm.beyond("table", 4))
    diagram = cm.TimingDiagram([make_mill(), table], 2000)
    alone = least_acceleration(diagram, "table", rule, still=still, cells=60)
    assert alone.bound == alone.reached == 0
    hop = cm.motion("table", cm.rise(1, over_deg=0.5), cm.return_(1, over_deg=0.5), cm.dwell(359))
    quick = diagram.with_motion(hop.shifted(369))
    assert least_acceleration(quick, "table", [], still=[(10, 369)], cells=60).reached == 0
    found = cm.least_peak(
        diagram, rule, still={"mill": [DOWN_DEG], "table": still}, gap=0.05, seconds=5
    )
    assert found.design is not None
    assert found.design["table"].range_mm == (5, 5)


def test_a_mill_that_also_stands_between_two_stops_still_knows_its_stops() -> None:
    steps = cm.rise(50, over_deg=60), cm.dwell(30), cm.rise(50, over_deg=60), cm.dwell(210)
    mill = cm.indexing_motion("mill", *steps, stops=24)
    still = [(70, 80), (205, 305)]
    found = least_acceleration(make_diagram(mill, make_die()), "mill", RULE, still=still, cells=180)
    assert cm.find_violations(found.design, RULE) == ()
    assert found.motion.offset_mm([75, 250]) == pytest.approx([50, 0])
    with pytest.raises(
        cm.InputError,
        match=r"^In its still arcs the indexing motion 'mill' stands at none of its st",
    ):
        least_acceleration(
            make_diagram(mill, make_die()), "mill", LOOSE, still=[(70, 80)], cells=90
        )


def test_a_mill_that_has_to_go_away_from_its_stop_and_come_back() -> None:
    """Over 0 deg, where its own segments begin."""
    mill = cm.indexing_motion(
        "mill", cm.dwell(100), cm.rise(100, over_deg=100), cm.dwell(160), stops=24
    )
    parts = cm.rise(10, over_deg=5), cm.dwell(20), cm.return_(10, over_deg=5), cm.dwell(330)
    gate = cm.motion("gate", *parts, start_deg=345)
    rule = ClearanceRule(beyond("gate", 5), only_while=beyond("mill", 3))
    diagram = make_diagram(mill, gate)
    found = least_acceleration(diagram, "mill", rule, still=[(60, 90), (250, 300)], cells=180)
    assert cm.find_violations(found.design, rule) == ()
    first, *others = [move.kind for move in found.motion.moves]
    assert (first, sorted(others)) == ("rise", ["return", "rise"])  # before the stop or after it
    assert found.bound <= found.reached <= 1.01 * found.bound


# Any machine


@dataclass(frozen=True)
class Case:
    """A machine, and what is asked of one of its motions."""

    diagram: TimingDiagram
    motion: str
    rule: ClearanceRule
    still: list[tuple[float, float]]
    jerk: float

    def solve(self, **changes: Any) -> LeastAcceleration:
        """Look for the least acceleration on a coarse grid, with these changes to the case."""
        given = replace(self, **changes)
        return least_acceleration(
            given.diagram,
            given.motion,
            given.rule,
            still=given.still,
            jerk_m_per_s3=given.jerk,
            cells=60,
        )


@st.composite
def cases(draw: st.DrawFn, motions: tuple[str, ...] = ("die", "mill")) -> Case:
    angles = st.floats(0, 720).map(lambda angle: round(angle, 3))
    length, stroke, start = draw(st.integers(20, 150)), draw(st.integers(5, 80)), draw(angles)
    die = make_die(draw(st.floats(5, 100)), stroke_mm=stroke, down_deg=(start, start + length))
    width, middle = draw(st.integers(30, 250)), start + length / 2 + draw(st.integers(140, 220))
    mill = make_mill(width, middle_deg=middle)
    rule = ClearanceRule(
        beyond("die", stroke * draw(st.floats(0.05, 0.95))),
        only_while=within("mill", draw(st.floats(0.2, 40))),
    )
    motion = draw(st.sampled_from(motions))
    inner = draw(st.floats(0, 0.3)) * length
    still = [(start + inner, start + length - inner)]
    if motion == "mill":
        half = (360 - width) / 2 * draw(st.floats(0.2, 1))
        still = [(middle + 180 - half, middle + 180 + half)]
    jerk = draw(st.sampled_from([math.inf, math.inf, 200.0, 2000.0]))
    return Case(
        cm.TimingDiagram([mill, die], draw(st.integers(500, 5000))), motion, rule, still, jerk
    )


@pytest.mark.parametrize(("seed", "name"), [(103, "part 0"), (682, "part 1")])
def test_what_turns_between_two_nodes_is_held_in_its_corridor(seed: int, name: str) -> None:
    """It turns back in the middle of a cell, so far from both nodes that it takes some rounds."""
    crowd = draw_any(np.random.default_rng(seed))
    rules = [rule for rule in crowd.rules if name in rule.motions]
    asked: Any = {"still": crowd.still[name], "travel_mm": crowd.travel_mm.get(name)}
    coarse, fine = (
        cm.least_acceleration(crowd.diagram, name, rules, cells=cells, **asked)
        for cells in (40, 360)
    )
    assert fine.bound <= coarse.reached <= 1.001 * fine.bound
    assert cm.find_violations(coarse.design, rules) == ()


REFUSALS = r"^(No motion keeps all of this|At .* has to stand|On a grid of .* take more cells)"


def solve_or_skip(case: Case, **changes: Any) -> LeastAcceleration:
    try:
        return case.solve(**changes)
    except cm.InputError as refusal:
        assume(not re.match(REFUSALS, str(refusal)))
        raise


@examples(25)
@given(cases())
def test_on_any_machine_the_motion_keeps_the_rule_and_the_bounds_their_order(case: Case) -> None:
    found = solve_or_skip(case)
    assert found.bound <= found.reached * (1 + 1e-6)
    assert cm.find_violations(found.design, case.rule) == ()
    [(start, end)] = case.still
    angles = np.linspace(start, end, 11)
    offs = [diagram[case.motion].offset_mm(angles) for diagram in (case.diagram, found.design)]
    assert offs[0] == pytest.approx(offs[1], abs=1e-8)


@examples(8)
@given(cases(), st.floats(-400, 400))
def test_when_the_turn_begins_does_not_matter(case: Case, way: float) -> None:
    found = solve_or_skip(case)
    later = case.solve(
        diagram=replace(case.diagram, motions=[m.shifted(way) for m in case.diagram.motions]),
        still=[(start + way, end + way) for start, end in case.still],
    )
    assert later.bound == pytest.approx(found.bound, rel=1e-5, abs=1e-9)
    turned = case.solve(still=[(start - 360, end - 360) for start, end in case.still])
    assert turned.bound == pytest.approx(found.bound, rel=1e-5, abs=1e-9)


@examples(8)
@given(cases(("die",)))
def test_with_which_segment_a_motion_begins_does_not_matter(case: Case) -> None:
    found = solve_or_skip(case)
    first, *others = case.diagram["die"].segments
    last = replace(first, from_deg=first.from_deg + 360, to_deg=first.to_deg + 360)
    begun = replace(case.diagram["die"], segments=[*others, last])
    other = solve_or_skip(case, diagram=case.diagram.with_motion(begun))
    assert other.bound <= found.reached * (1 + 1e-6)  # the grid begins elsewhere
    assert found.bound <= other.reached * (1 + 1e-6)


def larger(case: Case, factor: float) -> Case:
    """Return the case with all lengths so many times longer."""

    def halves(condition: Any) -> Any:
        return replace(condition, limit_mm=factor * condition.limit_mm)

    motions = [
        replace(
            motion,
            segments=[
                replace(s, from_mm=factor * s.from_mm, to_mm=factor * s.to_mm)
                for s in motion.segments
            ],
        )
        for motion in case.diagram.motions
    ]
    rule = ClearanceRule(halves(case.rule.when), only_while=halves(case.rule.only_while))
    return replace(
        case, diagram=replace(case.diagram, motions=motions), rule=rule, jerk=factor * case.jerk
    )


@examples(8)
@given(cases())
def test_twice_the_rate_is_four_times_the_acceleration_and_twice_the_size_twice(
    case: Case,
) -> None:
    found = solve_or_skip(case)
    faster = replace(case.diagram, rate_per_hour=2 * case.diagram.rate_per_hour)
    quick = case.solve(diagram=faster, jerk=8 * case.jerk)
    assert quick.bound == pytest.approx(4 * found.bound, rel=1e-5, abs=1e-9)
    large = larger(case, 2).solve()
    assert large.bound == pytest.approx(2 * found.bound, rel=1e-5, abs=1e-9)


@examples(8)
@given(cases())
def test_less_freedom_never_lowers_the_bound(case: Case) -> None:
    found = solve_or_skip(case)
    freer = case.solve(jerk=math.inf)
    assert freer.bound <= found.bound * (1 + 1e-6) + 1e-9


# Words and refusals


def test_it_says_between_which_values_the_least_lies() -> None:
    found = solve(TRAVEL, cells=90)
    low, high = np.floor(found.bound * 1e4) / 1e4, np.ceil(found.reached * 1e4) / 1e4
    assert repr(found) == (
        f"The least peak acceleration of the die lies between {low:.4f} and {high:.4f} m/s²."
    )
    assert (low, high) == (0.5193, 0.5203)
    assert found.design["mill"] == make_mill()


NUMBERS = [
    (
        {"jerk_m_per_s3": math.nan},
        r"^The jerk limit is nan m/s³; .* above 0 m/s³: give for ex.* 20 m",
    ),
    ({"jerk_m_per_s3": -math.inf}, r"^The jerk limit is -inf m/s³; "),
    ({"jerk_m_per_s3": -5}, r"^The jerk limit is -5 m/s³; "),
    ({"jerk_m_per_s3": 0}, r"^The jerk limit is 0 m/s³; "),
    (
        {"jerk_m_per_s3": "20"},
        r"^The jerk limit has to be a number in m/s³, not '20': give it as a n",
    ),
    (
        {"jerk_m_per_s3": np.array([20.0, 30.0])},
        r"^The jerk limit has to be a single number here, ",
    ),
    (
        {"cells": 11},
        r"^The number of cells is 11; .* at least 12 and at most 2880: give for .* 720",
    ),
    ({"cells": 11.4}, r"^The number of cells is 11.4; "),
    ({"cells": 90.5}, r"^The number of cells is 90.5; .* a whole number at least 12 and at most"),
    ({"cells": 2881}, r"^The number of cells is 2881; "),
    ({"cells": math.nan}, r"^The number of cells is nan; "),
    ({"cells": None}, r"^The number of cells has to be a number, not None: give for example 720"),
    ({"travel_mm": (50, 0)}, r"^The travel goes from 50 to 0 mm; give the lower end first, for ex"),
    ({"travel_mm": (50, 50)}, r"^The travel goes from 50 to 50 mm; "),
    ({"travel_mm": (0, math.nan)}, r"^The position is nan mm; "),
    (
        {"travel_mm": 50},
        r"^The travel is 50: give its lower and its upper end in mm, for .*\(0, 50\)",
    ),
    ({"travel_mm": (0, 40)}, r"^At 205 deg the die has to stand at 50 mm, where the rules or the "),
]
ARCS = [
    ([], r"^The arcs over which the die has to stand are \[\]: give at least one, for example st"),
    (None, r"^The arcs over which the die has to stand are None: give at least one"),
    (3, r"^The arcs over which the die has to stand are 3: give at least one"),
    ((205, 305), r"^A still arc is 205: give a list of pairs of cam angles, for example \[\(205"),
    ([(205, 305, 310)], r"^A still arc is \(205, 305, 310\): give a list of pairs of cam angles"),
    ([(305, 205)], r"^The still arc goes from 305 to 205 deg; it has to end after it begins and "),
    ([(205, 205)], r"^The still arc goes from 205 to 205 deg; "),
    (
        [(205, 565)],
        r"^The still arc goes from 205 to 565 deg; .* within a turn: let it go, for example",
    ),
    ([(205, math.inf)], r"^The cam angle is inf deg; "),
    ([(205, "305")], r"^The cam angle has to be a number in deg, not '305': give it as a num"),
    ([(205, 310)], r"^In the still arc from 205 to 310 deg the die moves, from 305 to 310 deg; a "),
    (
        [(205, 305), (100, 151)],
        r"^In the still arc from 100 to 151 deg the die moves, from 150 to ",
    ),
    ([(-155, -50)], r"^In the still arc from -155 to -50 deg the die moves, from 305 to 310 deg; "),
]


@pytest.mark.parametrize(("more", "match"), NUMBERS)
def test_numbers_that_make_no_sense_are_refused(more: dict[str, Any], match: str) -> None:
    with pytest.raises(cm.InputError, match=match):
        least_acceleration(make_diagram(), "die", EXAMPLE, still=STILL, **more)


@pytest.mark.parametrize(("still", "match"), ARCS)
def test_arcs_over_which_it_cannot_stand_are_refused(still: Any, match: str) -> None:
    with pytest.raises(cm.InputError, match=match):
        least_acceleration(make_diagram(), "die", EXAMPLE, still=still, cells=12)


def test_an_arc_over_which_a_table_moves_is_named() -> None:
    """It was told to stand at none of its stops, where it stands from 150 to 360 deg."""
    with pytest.raises(cm.InputError, match=r"arc from 0 to 10 deg the mill moves, from 0 to 10 d"):
        least_acceleration(make_diagram(), "mill", EXAMPLE, still=[(0, 10)], cells=12)


def test_what_is_no_question_is_refused() -> None:
    with pytest.raises(cm.InputError, match=r"^There is no motion 'punch': use one of 'mill', 'di"):
        least_acceleration(make_diagram(), "punch", EXAMPLE, still=STILL)
    with pytest.raises(cm.InputError, match=r"^The clearance rules are None: give one or a list"):
        least_acceleration(make_diagram(), "die", None, still=STILL)  # type: ignore[arg-type]
    unknown = ClearanceRule(beyond("punch", 19), only_while=within("mill", 0.65))
    with pytest.raises(cm.InputError, match=r"^There is no motion 'punch'"):
        least_acceleration(make_diagram(), "die", unknown, still=STILL)


def test_a_rule_that_does_not_let_it_stand_is_refused() -> None:
    early = make_diagram(make_mill(middle_deg=155), make_die())
    match = r"^At 205 deg the die has to stand at 50 mm, where the rules or the travel do not let"
    with pytest.raises(cm.InputError, match=match):
        least_acceleration(early, "die", EXAMPLE, still=STILL)


def test_too_little_jerk_is_refused() -> None:
    with pytest.raises(cm.InputError, match=r"^No motion keeps all of this: allow more jerk or mo"):
        least_acceleration(make_diagram(), "die", EXAMPLE, still=STILL, jerk_m_per_s3=1, cells=90)


def test_where_the_simplex_method_cannot_tell_another_one_does() -> None:
    """It gives up on this one with a status that is unknown."""
    die = make_die(5, stroke_mm=78, down_deg=(0, 100))
    diagram = cm.TimingDiagram([make_mill(144, middle_deg=194), die], 4006)
    rule = ClearanceRule(beyond("die", 3.9000000000000004), only_while=within("mill", 0.2))
    still = [(18.358299237389232, 81.64170076261077)]
    with pytest.raises(cm.InputError, match=r"^(No|On a grid of 5. cells no) motion keeps all of"):
        least_acceleration(diagram, "die", rule, still=still, jerk_m_per_s3=200, cells=60)


def test_an_infinite_jerk_limit_is_none() -> None:
    for none in (math.inf, np.float64(np.inf)):
        found = least_acceleration(
            make_diagram(), "die", EXAMPLE, still=STILL, jerk_m_per_s3=none, cells=36
        )
        assert found.bound == solve(cells=36).bound


@pytest.mark.parametrize("later", [0.09057481868815, 0.7, 1 / 3])
def test_a_turret_within_its_travel_is_so_wherever_its_turn_begins(later: float) -> None:
    """Its still arc begins but for rounding where the turn does, and not in the turn before."""
    start = 92 + later
    over = 210.74337245684052 - start
    parts = cm.rise(50, over_deg=over, law="cubic"), cm.dwell(360 - over)
    turret = cm.indexing_motion("turret", *parts, stops=7, start_deg=start)
    machine = TimingDiagram([turret], 2000)
    end = start - 360
    for still in ((end - 241.34, end), (end - 241.34, np.nextafter(end, 0))):
        found = least_acceleration(machine, "turret", [], still=[still], travel_mm=TRAVEL, cells=12)
        assert found.bound <= found.reached <= machine.peak_acceleration("turret")


def test_the_motion_of_today_is_kept_where_a_grid_has_no_better_one() -> None:
    parts = cm.rise(5, over_deg=24.247), cm.dwell(63.362), cm.return_(5, over_deg=24.247)
    slide = cm.motion("slide", *parts, cm.dwell(248.144)).with_law("constant acceleration")
    machine = TimingDiagram([slide], 2000)
    still = [(24.247, 87.609), (111.856, 331.702)]
    found = least_acceleration(machine, "slide", [], still=still, cells=180)
    assert found.bound <= found.reached <= machine.peak_acceleration("slide")
