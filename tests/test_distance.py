"""The distance of two parts on one axis, against samples of the laws' own formulas."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import CURVES, MONOTONE, Array, examples, make_diagram, make_mill

import cammotion as cm

AT: Array = np.linspace(0, 360, 72_000, endpoint=False)
LAWS = {law.name: law for law in MONOTONE}


def part(
    name: str, start: float, width: float, *, low_mm: float = 0, law: str = "cycloidal"
) -> cm.Motion:
    """Return a part that goes up by 40 mm and down again at once."""
    return cm.motion(
        name,
        cm.rise(40, over_deg=width, law=LAWS[law]),
        cm.return_(40, over_deg=width, law=LAWS[law]),
        cm.dwell(360 - 2 * width),
        start_deg=start,
        start_mm=low_mm,
    )


def heights(start: float, width: float, *, low_mm: float = 0, law: str = "cycloidal") -> Array:
    """Return where such a part is."""
    return heights_at(AT, start, width, low_mm=low_mm, law=law)


def heights_at(
    at: Array, start: float, width: float, *, low_mm: float = 0, law: str = "cycloidal"
) -> Array:
    since = (at - start) % 360
    up, down = (np.clip(x, 0, 1) for x in (since / width, since / width - 1))
    return np.asarray(low_mm + 40 * (CURVES[law](up) - CURVES[law](down)))


STARTS = st.floats(-400, 400)
WIDTHS = st.floats(20, 170)


@examples(40)
@given(
    st.tuples(STARTS, STARTS),
    st.tuples(WIDTHS, WIDTHS),
    st.floats(-30, 60),
    st.sampled_from(["cycloidal", "3-4-5", "harmonic", "parabolic", "mod. sine"]),
    st.floats(-50, 50),
)
def test_any_two_parts(
    starts: tuple[float, float], widths: tuple[float, float], low: float, law: str, least: float
) -> None:
    (one, other), (width, wide) = starts, widths
    machine = make_diagram(part("a", one, width, low_mm=low), part("b", other, wide, law=law))
    rule = cm.DistanceRule("a", above="b", at_least_mm=least)
    sampled = heights(one, width, low_mm=low) - heights(other, wide, law=law)
    found = rule.smallest(machine)
    assert found.value == pytest.approx(sampled.min(), abs=1e-4)
    assert found.value <= sampled.min() + 1e-9
    gap = machine.position_mm("a", found.at_deg) - machine.position_mm("b", found.at_deg)
    assert gap == pytest.approx(found.value, abs=1e-9)
    near = np.abs(sampled - least) < 1e-6
    inside = np.zeros(AT.shape, bool)
    for start, end in rule.violated_arcs(machine):
        inside |= (AT - start) % 360 <= end - start
    assert np.all((inside == (sampled < least)) | near)
    (clearance,) = cm.find_clearances(machine, rule)
    assert clearance.clearance_mm == pytest.approx(found.value - least, abs=1e-9)
    violations = cm.find_violations(machine, rule)
    assert max([v.excess_mm for v in violations], default=0) == pytest.approx(
        max(least - found.value, 0), abs=1e-6
    )


@pytest.mark.parametrize("start", [100.11, 0.11, 1000.11, -700.11])
def test_a_peak_that_is_narrower_than_any_step_is_seen(start: float) -> None:
    still = cm.motion("a", cm.dwell(360), start_mm=45)
    machine = make_diagram(still, part("b", start, 0.02))
    rule = cm.DistanceRule("a", above="b", at_least_mm=10)
    assert rule.smallest(machine).value == pytest.approx(5)
    assert rule.smallest(machine).at_deg == pytest.approx((start + 0.02) % 360)
    assert len(rule.violated_arcs(machine)) == 1


def test_to_touch_is_no_violation_and_an_arc_may_cross_the_turn() -> None:
    touching = make_diagram(part("a", 0, 90, low_mm=5), part("b", 0, 90))
    assert cm.DistanceRule("a", above="b", at_least_mm=5).violated_arcs(touching) == []
    crossing = make_diagram(part("a", 100, 90, low_mm=30), part("b", 300, 90))
    ((start, end),) = cm.DistanceRule("a", above="b", at_least_mm=0).violated_arcs(crossing)
    assert start < 360 < end
    assert (start + end) / 2 == pytest.approx(390)
    always = cm.DistanceRule("a", above="b", at_least_mm=100)
    assert always.violated_arcs(crossing) == [(0, 360)]


@pytest.mark.parametrize(
    ("names", "least", "said"),
    [
        (("a", "a"), 5, "distance rule is about 'a' twice"),
        (("a", "b"), np.inf, "least distance is inf mm"),
        (("a", "c"), 5, "There is no motion 'c'"),
        (("mill", "a"), 5, "'mill' moves on from stop to stop"),
        (("a", "mill"), 5, "'mill' moves on from stop to stop"),
    ],
)
def test_what_is_no_distance(names: tuple[str, str], least: float, said: str) -> None:
    machine = make_diagram(part("a", 0, 90), part("b", 10, 90), make_mill())
    with pytest.raises(cm.InputError, match=said):
        cm.find_violations(machine, cm.DistanceRule(names[0], above=names[1], at_least_mm=least))


STEP = 0.1
GRID: Array = np.arange(0, 360, STEP)
UPPER = heights_at(GRID, 10, 100, low_mm=22)
LOWER = heights_at(GRID, 0, 90)
PAIR = make_diagram(part("a", 10, 100, low_mm=22), part("b", 0, 90))
KEPT = cm.DistanceRule("a", above="b", at_least_mm=3, name="a over b")


def least(early: float = 0, late: float = 0, off: float = 0) -> float:
    """Return the least distance of the samples, with the part early or late by so much."""
    turns = range(-round(late / STEP), round(early / STEP) + 1)
    return float(min((np.roll(UPPER, -n) - LOWER).min() for n in turns)) - off


def test_what_is_left_of_a_distance() -> None:
    (full,) = cm.reserves(PAIR, KEPT)
    first = [
        next(n * STEP for n in range(3_600) if (np.roll(UPPER, way * n) - LOWER).min() < 3)
        for way in (-1, 1)
    ]
    assert [full.early_deg, full.late_deg] == pytest.approx(first, abs=2 * STEP)
    assert full.when_mm == full.other_mm == pytest.approx(least() - 3, abs=1e-4)
    assert "a over b: the a stays at least 3 mm above the b: kept; left are" in str(full)
    for way, reserve in ((-1, full.early_deg), (1, full.late_deg)):
        for more, is_broken in ((-1e-4, False), (1e-4, True)):
            moved = PAIR.with_motion(PAIR["a"].shifted(way * (reserve + more)))
            assert bool(cm.find_violations(moved, KEPT)) == is_broken


def test_what_errors_leave_of_a_distance() -> None:
    (left,) = cm.reserves(PAIR, KEPT, phase_deg={"a": 1, "b": 0.5}, off_mm=0.2)
    assert left.when_mm == pytest.approx(least(1.5, 1.5, 0.4) - 3, abs=0.05)
    low, high = 0.0, 10.0
    for _ in range(20):
        times = (low + high) / 2
        kept = least(1.5 * times, 1.5 * times, 0.4 * times) >= 3
        low, high = (times, high) if kept else (low, times)
    assert left.times == pytest.approx(low, rel=0.02)
    always = cm.DistanceRule("a", above="b", at_least_mm=-100)
    assert cm.reserves(PAIR, always)[0].deg == np.inf


def test_the_widest_move_that_keeps_a_distance() -> None:
    """The lower part rises earlier the wider its move is, and comes nearer to the upper one."""
    rise, stay, back = cm.rise(40, over_deg=40), cm.dwell(100), cm.return_(40, over_deg=40)
    lower = cm.motion("b", rise, stay, back, cm.dwell(180), start_deg=100)
    upper = cm.motion("a", *(cm.rise(60, over_deg=150), cm.return_(60, over_deg=210)), start_mm=15)
    machine = make_diagram(upper, lower)
    rule = cm.DistanceRule("a", above="b", at_least_mm=2)
    found = cm.widest_move(machine, "b", rule)
    at = np.arange(0, 360, 0.01)
    above = upper.position_mm(at)

    def keeps(bm: float) -> bool:
        up = np.clip((at - 140 + bm) / bm, 0, 1)
        down = np.clip((at - 240) / bm, 0, 1)
        curve = CURVES["cycloidal"]
        return bool((above - 40 * (curve(up) - curve(down))).min() >= 2 - 1e-9)

    widths = np.arange(10, 130, 0.05)
    widest = max(bm for bm in widths if keeps(bm))
    assert found.angle_deg == pytest.approx(widest, abs=0.1)
    assert found.tight is not None
    assert found.tight.clearance_mm == pytest.approx(0, abs=1e-6)
    assert cm.find_violations(found.diagram, rule) == ()
    spare = cm.widest_move(machine, "b", rule, reserve_deg=2, reserve_mm=0.5)
    assert spare.angle_deg < found.angle_deg
    (left,) = cm.reserves(spare.diagram, cm.DistanceRule("a", above="b", at_least_mm=2.5))
    assert left.deg == pytest.approx(2, abs=1e-4)
    with pytest.raises(cm.InputError, match="one angle: give each_way=False"):
        cm.widest_move(machine, "b", rule, each_way=True)


def test_what_knows_no_distance_says_so() -> None:
    with pytest.raises(cm.InputError, match="does not say between which positions the a may be"):
        cm.least_acceleration(PAIR, "a", KEPT, still=[(220, 350)])
    with pytest.raises(cm.InputError, match="plot_clearance is given rule="):
        cm.plot_clearance(PAIR, KEPT)  # type: ignore[arg-type]


def narrow(name: str, at: float, mm: float) -> cm.Motion:
    """Return a part that is 40 mm higher for a moment, or 40 mm lower for mm = 40."""
    parts = [cm.rise(40, over_deg=0.02), cm.return_(40, over_deg=0.02), cm.dwell(359.96)]
    if mm:
        parts[:2] = parts[1::-1]
    return cm.motion(name, *parts, start_deg=at - 0.02, start_mm=mm)


def test_moments_that_errors_bring_together_are_seen() -> None:
    """A dip of the part and a peak of the lower one, 2 deg apart, with 2.5 deg between them."""
    machine = make_diagram(narrow("a", 100.07, 40), narrow("b", 102.07, 0))
    rule = cm.DistanceRule("a", above="b", at_least_mm=-10)
    (left,) = cm.reserves(machine, rule, phase_deg={"a": 2.5})
    assert left.when_mm == pytest.approx(-40 + 10)
    (right,) = cm.reserves(machine, rule, phase_deg={"a": 1.5})
    assert right.when_mm == pytest.approx(10)


def test_a_moment_just_within_reach_is_met_where_it_comes_into_reach() -> None:
    falling = part("a", -60, 90, low_mm=60)  # on its way down from 30 to 120 deg
    machine = make_diagram(falling, narrow("b", 57.13, 0))
    (left,) = cm.reserves(
        machine, cm.DistanceRule("a", above="b", at_least_mm=0), phase_deg={"b": 10}
    )
    lowest = heights_at(np.array([67.13]), -60, 90, low_mm=60)[0]
    assert left.when_mm == pytest.approx(lowest - 40, abs=1e-3)
