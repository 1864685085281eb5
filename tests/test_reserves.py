"""What is left until a rule breaks, against shifts and windows of samples."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import RULE, Array, die_mm, examples, make_diagram, make_die, make_mill, mill_off_mm
from scipy.ndimage import maximum_filter1d

import cammotion as cm

STEP = 0.01
AT: Array = np.linspace(0, 360, 36_000, endpoint=False)
MIDDLE = 80.0  # of the mill: later than in the source, so that early and late differ
DIAGRAM = make_diagram(make_mill(middle_deg=MIDDLE), make_die(100))
DIE, MILL = die_mm(AT, 100), mill_off_mm(AT, middle_deg=MIDDLE)


def windowed(values: Array, deg: float) -> Array:
    """Return the largest of the values within so many deg before and after."""
    return np.asarray(maximum_filter1d(values, 2 * round(deg / STEP) + 1, mode="wrap"))


def breaks(die: Array, mill: Array) -> bool:
    return bool(np.any((die > 19) & (mill > 0.65)))


def first_shift(way: int) -> float:
    """Return the first shift of the die in deg, later for 1, with which the rule breaks."""
    return next(n * STEP for n in range(36_000) if breaks(np.roll(DIE, way * n), MILL))


def test_how_much_earlier_and_later_the_die_may_be() -> None:
    (full,) = cm.reserves(DIAGRAM, RULE)
    assert full.early_deg == pytest.approx(first_shift(-1), abs=2 * STEP)
    assert full.late_deg == pytest.approx(first_shift(1), abs=2 * STEP)
    assert full.late_deg > full.early_deg + 5
    assert full.deg == full.early_deg
    assert full.times == math.inf
    for way, reserve in ((-1, full.early_deg), (1, full.late_deg)):
        for more, is_broken in ((-1e-6, False), (1e-6, True)):
            moved = DIAGRAM.with_motion(DIAGRAM["die"].shifted(way * (reserve + more)))
            assert bool(cm.find_violations(moved, RULE)) == is_broken


@pytest.mark.parametrize(("phase", "off"), [(0, 0), (0.5, 0), (0, 0.1), (0.5, 0.1), (1.5, 0.3)])
def test_what_errors_leave(phase: float, off: float) -> None:
    (left,) = cm.reserves(DIAGRAM, RULE, phase_deg=phase, off_mm=off)
    open_mill = windowed(MILL, 2 * phase) + off > 0.65
    assert left.when_mm == pytest.approx(19 - off - DIE[open_mill].max(), abs=0.02)
    deep_die = windowed(DIE, 2 * phase) + off > 19
    assert left.other_mm == pytest.approx(0.65 - off - MILL[deep_die].max(), abs=0.02)
    (full,) = cm.reserves(DIAGRAM, RULE)
    assert left.deg <= full.deg - 2 * phase + 1e-9


@pytest.mark.parametrize(("phase", "off"), [(0.5, 0), (0, 0.1), (0.5, 0.1), (3, 0.01)])
def test_how_many_times_the_errors_a_rule_bears(phase: float, off: float) -> None:
    (left,) = cm.reserves(DIAGRAM, RULE, phase_deg=phase, off_mm=off)
    low, high = 0.0, 1000.0
    for _ in range(40):
        times = (low + high) / 2
        die = windowed(DIE, min(2 * phase * times, 180)) + off * times
        low, high = (low, times) if breaks(die, MILL + off * times) else (times, high)
    assert left.times == pytest.approx(low, rel=0.01)


@examples(30)
@given(st.floats(60, 120), st.floats(0.05, 3), st.floats(-1, 1), st.floats(-1, 1))
def test_no_errors_within_the_bearable_break_the_rule(
    angle: float, phase: float, one: float, other: float
) -> None:
    """Any phases within what is borne are free, and of all of them some are just not."""
    machine = make_diagram(make_mill(), make_die(angle))
    (left,) = cm.reserves(machine, RULE, phase_deg=phase)
    borne = left.times * phase

    def shifted(die: float, mill: float) -> cm.TimingDiagram:
        moved = machine.with_motion(machine["die"].shifted(die))
        return moved.with_motion(machine["mill"].shifted(mill))

    assert not cm.find_violations(shifted(0.9999 * one * borne, 0.9999 * other * borne), RULE)
    worst = 1.0001 * borne
    assert any(cm.find_violations(shifted(way * worst, -way * worst), RULE) for way in (-1, 1))


def test_the_first_to_break_comes_first_and_errors_have_names() -> None:
    loose = cm.ClearanceRule(cm.beyond("die", 40), only_while=cm.within("mill", 10))
    first, second = cm.reserves(DIAGRAM, [loose, RULE], phase_deg=0.5, off_mm=0.1)
    assert (first.rule, second.rule) == (RULE, loose)
    assert 1 < first.times < second.times
    (of_die,) = cm.reserves(DIAGRAM, RULE, phase_deg={"die": 1})
    (of_both,) = cm.reserves(DIAGRAM, RULE, phase_deg=0.5)
    assert (of_die.early_deg, of_die.late_deg) == pytest.approx(
        (of_both.early_deg, of_both.late_deg)
    )
    (worn,) = cm.reserves(DIAGRAM, RULE, off_mm={"die": 0.1})
    (full,) = cm.reserves(DIAGRAM, RULE)
    assert worn.when_mm == pytest.approx(full.when_mm - 0.1)


def test_a_broken_rule_has_less_than_nothing_left() -> None:
    wide = make_diagram(make_mill(), make_die(127))
    (broken,) = cm.reserves(wide, RULE, phase_deg=0.5)
    spread = cm.reserves(make_diagram(make_mill(), make_die(124.8)), RULE, phase_deg=0.5)[0]
    (violation, _) = cm.find_violations(wide, RULE)
    assert broken.times == 0
    assert spread.times < 1
    assert spread.deg < 0
    (sharp,) = cm.reserves(wide, RULE)
    assert sharp.deg == pytest.approx(violation.start_deg - violation.end_deg)
    assert sharp.when_mm == pytest.approx(-violation.excess_mm)
    assert sharp.times == 0
    assert "broken; left are" in str(sharp)


def test_what_cannot_break_has_no_end() -> None:
    shallow = cm.ClearanceRule(cm.beyond("die", 60), only_while=cm.within("mill", 0.65))
    (never,) = cm.reserves(DIAGRAM, shallow, phase_deg=5)
    assert (never.deg, never.times, never.other_mm) == (math.inf,) * 3
    assert never.when_mm == pytest.approx(60 - DIE[windowed(MILL, 10) > 0.65].max(), abs=0.02)


def test_a_peak_within_reach_counts() -> None:
    """A gate that is up for a moment 15 deg after the mill is gone, and may be 20 deg early."""
    parts = cm.rise(20, over_deg=30), cm.return_(20, over_deg=20), cm.dwell(310)
    gone = make_mill().where_beyond(0.65)[0][1]
    gate = cm.motion("gate", *parts, start_deg=gone + 15 - 30)
    rule = cm.ClearanceRule(cm.beyond("gate", 5), only_while=cm.within("mill", 0.65))
    (left,) = cm.reserves(make_diagram(make_mill(), gate), rule, phase_deg={"gate": 20})
    assert left.when_mm == pytest.approx(5 - 20)


def test_a_widest_move_has_nothing_left() -> None:
    (touched,) = cm.reserves(cm.widest_move(make_diagram(), "die", RULE).diagram, RULE)
    assert 0 <= touched.deg < 1e-6
    assert [touched.when_mm, touched.other_mm] == pytest.approx([0, 0], abs=1e-6)
    assert "only while the mill is within 0.65 mm: kept; left are" in str(touched)


def test_to_touch_is_to_have_nothing_left_wherever_the_turn_begins() -> None:
    found = cm.widest_move(make_diagram(), "die", RULE).diagram
    for later in np.random.default_rng(5).uniform(0, 360, 60):
        turned = make_diagram(*(motion.shifted(later) for motion in found.motions))
        (touched,) = cm.reserves(turned, RULE)
        assert abs(touched.deg) < 1e-6


@pytest.mark.parametrize(
    ("errors", "said"),
    [
        ({"phase_deg": -1}, "phase error is -1 deg"),
        ({"off_mm": -1}, "error of the position is -1 mm"),
        ({"phase_deg": {"dye": 1}}, "There is no motion 'dye': did you mean 'die'"),
        ({"off_mm": "much"}, "error of the position has to be a number in mm"),
    ],
)
def test_bad_errors(errors: dict[str, float], said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.reserves(DIAGRAM, RULE, **errors)


@pytest.mark.parametrize(
    ("deg", "mm"), [(0, 0), (1, 0), (0, 2), (1.5, 0.5), (20, 0), (0, 12), (8, 10)]
)
@pytest.mark.parametrize("name", ["die", "mill"])
def test_the_widest_move_that_keeps_a_reserve(name: str, deg: float, mm: float) -> None:
    """A tenth of a degree more, and samples no longer have the reserve; and it names the rule."""
    machine = make_diagram(make_mill(), make_die())
    found = cm.widest_move(machine, name, RULE, reserve_deg=deg, reserve_mm=mm)
    (left,) = cm.reserves(found.diagram, RULE, phase_deg={"die": deg})
    assert left.deg >= -1e-6
    assert left.when_mm >= mm - 1e-6
    assert min(left.deg, left.when_mm - mm) == pytest.approx(0, abs=1e-5)
    assert found.tight is not None
    smallest = cm.smallest_clearance(found.diagram, found.tight.rule)
    assert found.tight.rule == RULE
    assert found.tight.clearance_mm == pytest.approx(smallest.clearance_mm, abs=1e-9)
    for more, is_short in ((-0.1, False), (0.1, True)):
        width = found.angle_deg + more
        die, mill = (width, 150) if name == "die" else (55, width)
        deep = windowed(die_mm(AT, die), deg) + mm > 19
        assert bool(np.any(deep & (mill_off_mm(AT, mill) > 0.65))) == is_short


def test_a_reserve_that_there_is_not() -> None:
    with pytest.raises(cm.InputError, match="keeps the rules with 80 deg and 0 mm to spare: how"):
        cm.widest_move(make_diagram(), "die", RULE, reserve_deg=80)
    with pytest.raises(cm.InputError, match="reserve is -1 deg"):
        cm.widest_move(make_diagram(), "die", RULE, reserve_deg=-1)
    with pytest.raises(cm.InputError, match="reserve is -1 mm"):
        cm.widest_move(make_diagram(), "die", RULE, reserve_mm=-1)


def test_a_distance_bears_few_errors_often() -> None:
    """Of ten thousandths of a mm it was told to be without errors."""
    low = cm.motion("low", cm.rise(30, over_deg=90), cm.dwell(90), cm.return_(30, over_deg=180))
    high = cm.motion("high", cm.dwell(360), start_mm=67)
    rule = cm.DistanceRule("high", above="low", at_least_mm=0)
    diagram = cm.TimingDiagram([low, high], 2000)
    for off_mm in (1e-3, 1e-6, 1e-9):
        (left,) = cm.reserves(diagram, rule, off_mm=off_mm)
        assert left.times == pytest.approx(37 / 2 / off_mm, rel=1e-6)
    assert "∞ deg early, ∞ deg late, 37 mm of the high" in str(left)
    assert "Reserve(∞ deg: " in repr(left)
