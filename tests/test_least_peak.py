"""The least peak of all parts at once: no motions are below the bound, and it is not far below."""

import math
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
from crowds import Small, designs, draw, draw_any, keeps, least_by_trying
from machines import DOWN_DEG, RULE, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion.quantities import InputError, WrongAnswerError
from cammotion.whole import joint_search as search_module
from cammotion.whole.asked_of_all import read_task
from cammotion.whole.joint_bound import Outline, outline
from cammotion.whole.least_peak import LeastPeak, least_peak
from cammotion.whole.mixed import Mixed, Rows
from cammotion.whole.parts import Part
from cammotion.whole.sides import sides_of

STILL = {"mill": [DOWN_DEG], "die": [DOWN_DEG]}
TRAVEL = {"die": (0, 50)}
BALANCED = 0.94285  # m/s2, both with cycloids
NEAR = 1e-4  # of a bound: what the solver leaves


@cache
def both(gap: float = 0.02) -> LeastPeak:
    return least_peak(make_diagram(), RULE, still=STILL, travel_mm=TRAVEL, gap=gap)


def peak(design: cm.TimingDiagram) -> float:
    return max(design.peak_acceleration(name) for name in design.names)


# Mill and die


def test_mill_and_die_are_bounded_within_two_percent() -> None:
    found = both()
    assert 0.62 < found.bound < found.reached < 0.65
    assert found.gap <= 0.02
    assert found.gap == pytest.approx(1 - found.bound / found.reached)


def test_a_die_that_may_leave_its_stroke_comes_below_what_is_proved_within_it() -> None:
    free = least_peak(make_diagram(), RULE, still=STILL, gap=0.01)
    held = both(gap=0.01)
    assert 0.629 < free.bound < free.reached < 0.633
    assert 0.635 < held.bound < held.reached < 0.642


def test_the_design_keeps_what_it_has_to() -> None:
    design = both().design
    assert design is not None
    assert cm.find_violations(design, RULE) == ()
    angles = np.linspace(*DOWN_DEG, 50)
    for motion in make_diagram().motions:
        assert np.allclose(design[motion.name].position_mm(angles), motion.position_mm(angles))
    assert design["die"].range_mm[0] >= 0
    peaks = [design.peak_acceleration(name) for name in ("mill", "die")]
    assert max(peaks) == both().reached


def test_the_balanced_cycloids_are_above_it() -> None:
    wider = make_diagram().with_motion(make_mill(163.267))
    found = cm.widest_move(wider, "die", RULE).diagram
    peaks = [found.peak_acceleration(name) for name in ("mill", "die")]
    assert max(peaks) == pytest.approx(BALANCED, abs=5e-5)
    assert max(peaks) > both().reached > both().bound


def test_where_no_motions_were_found_yet_all_may_be_better() -> None:
    found = replace(both(), design=None)
    assert (found.reached, found.gap) == (math.inf, 1)
    assert repr(found).startswith("No motions were found yet; no motions of mill and die can")


def test_it_says_so_with_its_conditions() -> None:
    lines = repr(both()).splitlines()
    assert len(lines) > 1  # a notebook would break a longer one within its words
    assert max(map(len, lines)) <= 100
    text = " ".join(lines)
    assert "no motions of mill and die can have less than 0.6" in text
    assert "the die stands from 205 to 305 deg and stays within 0 to 50 mm" in text
    assert "1 rule kept" in text
    assert "2000 pieces/h" in text


@pytest.mark.parametrize("alone", ["mill", "die"])
def test_one_part_alone_agrees_with_the_least_acceleration(alone: str) -> None:
    travel: dict[str, tuple[float, float]] = {"die": (0, 50)} if alone == "die" else {}
    known = cm.least_acceleration(
        make_diagram(), alone, RULE, still=[DOWN_DEG], travel_mm=travel.get(alone), cells=360
    )
    found = least_peak(make_diagram(), RULE, still={alone: [DOWN_DEG]}, travel_mm=travel, gap=0.002)
    assert found.bound <= known.reached
    assert known.bound <= found.reached
    assert found.gap < 0.005


@pytest.mark.parametrize("limit", [0.7, 1.117])
def test_a_limit_of_one_gives_the_front(limit: float) -> None:
    """A mill that is quicker than the balance leaves more to the die, also that of the source."""
    found = least_peak(
        make_diagram(),
        RULE,
        still=STILL,
        travel_mm=TRAVEL,
        weights={"mill": 0},
        at_most={"mill": limit},
        gap=0.05,
    )
    assert found.design is not None
    assert found.design.peak_acceleration("mill") <= limit * (1 + 1e-6)
    assert found.reached == found.design.peak_acceleration("die")
    assert found.bound < both().bound
    assert found.gap <= 0.05


def test_weights_are_masses_and_the_peak_a_force() -> None:
    mass = {"mill": 40, "die": 12}
    found = least_peak(
        make_diagram(), RULE, still=STILL, travel_mm=TRAVEL, weights=mass, unit="N", gap=0.05
    )
    assert found.design is not None
    forces = [mass[name] * found.design.peak_acceleration(name) for name in mass]
    assert found.reached == pytest.approx(max(forces))
    assert found.gap <= 0.05
    assert found.bound < 40 * both().reached
    assert " N; no motions" in repr(found)


# By other ways


@pytest.mark.parametrize(
    "given",
    [
        Small(9, ((5, 6), (5, 6)), (50, 0), 100, 19, 0.65),
        Small(9, ((2, 4), (3, 4)), (30, 0), -60, 5, 2),
        Small(8, ((1, 2), (5, 6)), (40, 0), 80, 30, 10),
    ],
)
def test_all_choices_of_a_small_grid(given: Small) -> None:
    step = 360 / given.nodes
    ((a, b), (c, d)), (high, _) = given.still, given.places
    down, up = cm.rise(high, over_deg=30), cm.return_(high, over_deg=30)
    slide = cm.motion(
        "slide",
        down,
        cm.dwell((b - a) * step),
        up,
        cm.dwell(300 - (b - a) * step),
        start_deg=a * step - 30,
    )
    move = cm.rise if given.pitch > 0 else cm.return_
    turret = cm.indexing_motion(
        "turret",
        cm.dwell((d - c) * step),
        move(abs(given.pitch), over_deg=360 - (d - c) * step),
        stops=12,
        start_deg=c * step,
    )
    rule = cm.ClearanceRule(
        cm.beyond("slide", given.limit), only_while=cm.within("turret", given.near)
    )
    diagram = cm.TimingDiagram([slide, turret], 2000)
    arcs = [(a * step, b * step)], [(c * step, d * step)]
    parts = [
        Part(motion, tuple(still), (-math.inf, math.inf), 1.0, math.inf)
        for motion, still in zip(diagram.motions, arcs, strict=True)
    ]
    angles = np.linspace(0, 360, given.nodes, endpoint=False, dtype=np.float64)
    exact = least_by_trying(given)
    assert np.isfinite(exact)
    for share in (1.02, 1.2, 1.5):
        found = outline(parts, sides_of(diagram, parts, [rule]), angles, share * exact, 60)
        assert found.bound * share == pytest.approx(1, rel=NEAR)
    assert outline(parts, sides_of(diagram, parts, [rule]), angles, 0.99 * exact, 60).bound > 1


@pytest.mark.parametrize("seed", range(3))  # more are drawn in tests/fresh
def test_no_design_is_below_the_bound(seed: int) -> None:
    rng = np.random.default_rng(seed + 100)
    crowd = draw(rng, 2 + seed % 3)
    found = least_peak(
        crowd.diagram,
        crowd.rules,
        still=crowd.still,
        travel_mm=crowd.travel_mm,
        gap=0.1,
        seconds=20,
    )
    others = [
        max(design.peak_acceleration(name) for name in design.names)
        for design in designs(crowd, rng)
        if keeps(crowd, design)
    ]
    assert others
    assert found.bound <= min(others)
    assert found.reached <= min(others)
    assert found.design is not None
    assert keeps(crowd, found.design)
    assert found.gap < 0.15


@pytest.mark.parametrize("seed", range(3))
def test_rules_of_any_kind(seed: int) -> None:
    """Turrets and slides, beyond and within: each part in turn is made as good as it can be."""
    rng = np.random.default_rng(seed + 70000)
    crowd = draw_any(rng)
    if not crowd.rules:
        return
    asked: dict[str, Any] = {"still": crowd.still, "travel_mm": crowd.travel_mm}
    found = least_peak(crowd.diagram, crowd.rules, **asked, gap=0.1, seconds=10)
    design = found.design
    assert design is not None
    assert keeps(crowd, design)
    others = [peak(crowd.diagram), peak(design)]
    for name in design.names:
        own = [r for r in crowd.rules if name in {r.when.motion, r.only_while.motion}]
        if own:
            arcs, travel = crowd.still[name], crowd.travel_mm.get(name)
            design = cm.least_acceleration(
                design, name, own, still=arcs, travel_mm=travel, cells=90
            ).design
            others.append(peak(design))
    assert found.bound <= min(others) * (1 + 1e-6)


def test_parts_that_can_stand_need_no_push() -> None:
    """Without a work to do the die stays down, and the mill has to move: it alone counts."""
    rest = least_peak(make_diagram(), RULE, still={"die": [DOWN_DEG]}, travel_mm=TRAVEL, gap=0.1)
    assert rest.reached > 0.5
    free = cm.ClearanceRule(cm.beyond("die", 60), only_while=cm.within("mill", 0.65))
    found = least_peak(make_diagram(), free, still={"die": [DOWN_DEG]}, gap=0.1)
    assert found.reached == pytest.approx(0, abs=1e-6)
    assert found.gap == 0


def test_what_never_moves_has_the_least_peak_there_is() -> None:
    table = cm.motion("table", cm.dwell(360))
    for others in ([], [cm.EXAMPLE.mill]):
        diagram = cm.TimingDiagram([table, *others], 2000)
        found = cm.least_peak(diagram, [], still={"table": [(0, 300)]}, seconds=2)
        assert (found.bound, found.reached, found.gap) == (0, 0, 0)


def test_still_arcs_in_each_other_are_one() -> None:
    arcs = [(220, 250), (205, 260), (600, 665)]
    (part,) = read_task(make_diagram(), RULE, still={"die": arcs}, weights=None, at_most=None).parts
    assert part.still == (DOWN_DEG,)


def beside_a_table(*halves: cm.ClearanceRule) -> cm.LeastPeak:
    table = cm.motion("table", cm.dwell(360), start_mm=5)
    machine = cm.TimingDiagram([make_mill(), table], 2000)
    still = {"mill": [DOWN_DEG], "table": [(0, 100)]}
    return cm.least_peak(machine, halves, still=still, seconds=1)


def test_what_stands_at_its_limit_is_not_beyond_it() -> None:
    """The mill has to wait for the table, and so has less of the turn than today."""
    waits, goes = (
        beside_a_table(cm.ClearanceRule(cm.beyond("mill", 0.65), only_while=cm.beyond("table", mm)))
        for mm in (5, 4.9)
    )
    assert waits.bound > 2 * goes.reached


def test_motions_that_stay_at_a_limit_are_none() -> None:
    """Where the mill passes on, the table may be neither beyond 5 mm nor within."""
    found = beside_a_table(
        *(
            cm.ClearanceRule(half("table", 5), only_while=cm.within("mill", 0.65))
            for half in (cm.beyond, cm.within)
        )
    )
    assert found.design is None


def test_a_move_shorter_than_a_cell_is_seen() -> None:
    """The turret has 4 deg, between two of 60 nodes; alone it needs a = 4 h / t^2."""
    turret = cm.indexing_motion("turret", cm.rise(9, over_deg=4), cm.dwell(356), stops=3)
    diagram = cm.TimingDiagram([turret, make_die()], 2000)
    rule = cm.ClearanceRule(cm.beyond("die", 60), only_while=cm.within("turret", 1))
    found = least_peak(diagram, rule, still={"turret": [(4, 360)]}, gap=0.01, seconds=10)
    alone = 4 * 9e-3 / cm.indexing_time(4, 2000) ** 2
    assert found.bound == pytest.approx(alone, rel=0.01)
    assert found.bound <= alone <= found.reached * (1 + 1e-9)


def test_a_tiny_pitch_beside_a_hard_driven_part_is_left_out() -> None:
    """Pushed as hard as the slide, the turret could get past thousands of stops."""
    turret = cm.indexing_motion("turret", cm.rise(0.05, over_deg=300), cm.dwell(60), stops=8)
    slide = cm.motion(
        "slide", cm.rise(42, over_deg=9), cm.dwell(200), cm.return_(42, over_deg=9), cm.dwell(142)
    )
    diagram = cm.TimingDiagram([turret, slide], 5000)
    rule = cm.ClearanceRule(cm.beyond("slide", 50), only_while=cm.within("turret", 0.01))
    still = {"turret": [(300, 360)], "slide": [(9, 209)]}
    found = least_peak(diagram, rule, still=still, gap=0.02, seconds=5)
    assert 0 <= found.bound <= found.reached


def test_a_part_reaches_no_farther_than_it_is_pushed() -> None:
    """Full push and full brake to the middle of the free arc and back, in closed form."""
    part = Part(make_die(), (DOWN_DEG,), (-math.inf, math.inf), 1.0, math.inf)
    low, high = part.reach(np.array([205.0, 255.0, 75.0]), 0.01)
    assert low[:2].tolist() == high[:2].tolist() == [50, 50]
    assert high[2] == pytest.approx(50 + 0.01 * 65**2)  # 130 deg to rest, at the middle
    assert low[2] == pytest.approx(50 - 0.01 * 65**2)


# Stopped, asked for nonsense


def test_a_time_that_is_too_short_still_gives_a_true_bound() -> None:
    found = least_peak(make_diagram(), RULE, still=STILL, travel_mm=TRAVEL, gap=0, seconds=0.5)
    assert 0 < found.bound < both().reached
    assert found.design is not None


@pytest.mark.parametrize("seconds", [1, 2])
def test_no_program_gets_more_time_than_is_left(
    seconds: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The first design of single moves was sought for five seconds, and the clock began then."""
    asked: list[float] = []
    solve = Rows.solve

    def timed(rows: Rows, limit: float = np.inf) -> Mixed:
        asked.append(limit)
        return solve(rows, limit)

    monkeypatch.setattr(Rows, "solve", timed)
    least_peak(make_diagram(), RULE, still=STILL, gap=0.3, seconds=seconds)
    limited = [limit for limit in asked if np.isfinite(limit)]
    assert limited
    assert max(limited) <= seconds


def test_progress_is_told_and_an_interrupt_keeps_the_best() -> None:
    seen: list[LeastPeak] = []

    def stop(found: LeastPeak) -> None:
        seen.append(found)
        if len(seen) == 2:
            raise KeyboardInterrupt

    found = least_peak(make_diagram(), RULE, still=STILL, travel_mm=TRAVEL, gap=0, progress=stop)
    assert found == seen[-1]
    assert 0.55 < seen[0].bound <= seen[1].bound <= seen[1].reached <= seen[0].reached


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"still": {}}, "No part is free"),
        ({"still": [(205, 305)]}, "give a dictionary"),
        ({"still": {"wheel": [DOWN_DEG]}}, "no motion 'wheel'"),
        ({"still": {"die": [(100, 305)]}}, "the die moves"),
        ({"travel_mm": {"mill": (0, 50)}}, "leave out its travel"),
        ({"weights": {"mill": -1}}, "weight is -1"),
        ({"weights": {"mill": 0}}, "has the weight 0 and no limit"),
        ({"weights": {"wheel": 1}}, "no free part 'wheel'"),
        ({"weights": dict.fromkeys(STILL, 0), "at_most": dict.fromkeys(STILL, 2)}, "All weights"),
        ({"gap": -0.1}, "gap is -0.1"),
        ({"seconds": 0}, "time is 0 s"),
        ({"at_most": {"mill": 0.2}}, "No motions keep all of this"),
    ],
)
def test_what_makes_no_sense_is_said(changed: dict[str, Any], words: str) -> None:
    asked: dict[str, Any] = {"still": STILL, "gap": 0.1, "seconds": 20} | changed
    with pytest.raises(InputError, match=words):
        least_peak(make_diagram(), RULE, **asked)


@pytest.mark.parametrize("begins_well", [True, False])
def test_a_wrong_bound_is_never_given_out(
    begins_well: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As of a solver that says of everything below 2 m/s2 that it cannot be."""
    per_m = 1000 * (make_diagram().cycle_time_s / 360) ** 2

    def too_high(parts: Any, sides: Any, angles: Any, peak: float, *_: Any, **more: Any) -> Outline:
        if peak < 2 * per_m:
            return Outline(angles, math.inf)
        found = outline(parts, sides, angles, 0.7 * per_m, 60, **more)
        return replace(found, bound=1.0)

    monkeypatch.setattr(search_module, "outline", too_high)
    if not begins_well:
        monkeypatch.setattr(search_module, "best_moves", lambda *_: None)
    words = "the bound is above 0.67" if begins_well else "less than the bound"
    with pytest.raises(WrongAnswerError, match=words):
        least_peak(make_diagram(), RULE, still=STILL, travel_mm=TRAVEL)
