"""Overlap: the figures of the source, and every verdict against plain NumPy formulas."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from itertools import product
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from machines import (
    CURVES,
    DIPPING,
    MONOTONE,
    RULE,
    TURNING,
    WAVY,
    Array,
    die_mm,
    examples,
    make_diagram,
    make_die,
    make_mill,
    mill_off_mm,
)

import cammotion as cm
from cammotion import ClearanceRule, MotionLaw, TimingDiagram, beyond, within
from cammotion.limits.frame import Frame
from cammotion.limits.widest import WidestMove, with_angle
from cammotion.rules.conditions import Condition

TOLERANCE_MM = 1e-7  # by so much a plain formula may miss a limit
DENSE = np.linspace(0, 360, 180_001)
COARSE = np.linspace(0, 360, 7201)


def shifted(diagram: TimingDiagram, phase_deg: float) -> TimingDiagram:
    """Return the diagram with all motions later by an angle."""
    return replace(
        diagram,
        motions=[
            replace(
                motion,
                segments=[
                    replace(s, from_deg=s.from_deg + phase_deg, to_deg=s.to_deg + phase_deg)
                    for s in motion.segments
                ],
            )
            for motion in diagram.motions
        ],
    )


def exact_place(way: mpmath.mpf) -> mpmath.mpf:
    """Return where the cycloid has come to a part of its way, to 30 digits."""
    mpmath.mp.dps = 30
    cycloid: Callable[[Any], Any] = lambda x: x - mpmath.sin(2 * mpmath.pi * x) / (2 * mpmath.pi)  # noqa: E731
    return mpmath.findroot(lambda x: cycloid(x) - way, (0, 1), solver="anderson", tol=1e-50)


def exact_widest_deg() -> tuple[mpmath.mpf, mpmath.mpf]:
    """Return the widest angle of the die, and the angle at which it is tight, to 30 digits."""
    tight = 150 * (1 - exact_place(mpmath.mpf("0.65") / 100))
    return (205 - tight) / (1 - exact_place(mpmath.mpf(19) / 50)), tight


# The figures of the source


def test_without_overlap_no_rule_is_broken() -> None:
    assert cm.find_violations(make_diagram(), RULE) == ()
    assert cm.smallest_clearance(make_diagram(), RULE).clearance_mm == 19


def test_the_first_improvement() -> None:
    """70 deg: the mill has an effective angle of 120 deg, and the die waits for all of it."""
    off = make_mill().offset_mm(135)
    [(start, end)] = make_mill().where_beyond(off)
    assert end - start == pytest.approx(120)
    rule = ClearanceRule(beyond("die", 0), only_while=within("mill", off))
    widest = cm.widest_move(make_diagram(), "die", rule)
    assert widest.angle_deg == pytest.approx(70, abs=1e-9)
    assert widest.peak_acceleration == pytest.approx(2.565, abs=5e-4)
    assert widest.start_deg == pytest.approx(135)


def test_the_reading_of_the_source() -> None:
    """The mill counts as there at 135 deg, where it has 0.6451 mm to go."""
    off = make_mill().offset_mm(135)
    rule = ClearanceRule(beyond("die", 19), only_while=within("mill", off))
    widest = cm.widest_move(make_diagram(), "die", rule)
    assert widest.angle_deg == pytest.approx(124.84, abs=5e-3)
    assert widest.start_deg == pytest.approx(80.16, abs=5e-3)
    assert widest.peak_acceleration == pytest.approx(0.8064, abs=5e-5)
    before = make_diagram().peak_acceleration("die")
    assert before / widest.peak_acceleration == pytest.approx(5.15, abs=5e-3)
    assert widest.tight is not None
    assert widest.tight.angle_deg == pytest.approx(135)


def test_exactly_0_65_mm() -> None:
    angle, tight = exact_widest_deg()
    widest = cm.widest_move(make_diagram(), "die", RULE)
    assert widest.angle_deg == pytest.approx(float(angle), abs=1e-10)
    assert widest.angle_deg == pytest.approx(124.9053, abs=5e-5)
    assert widest.start_deg == pytest.approx(80.0947, abs=5e-5)
    assert widest.peak_acceleration == pytest.approx(0.80547, abs=5e-6)
    assert widest.tight is not None
    assert widest.tight.angle_deg == pytest.approx(float(tight), abs=1e-10)
    assert widest.tight.angle_deg == pytest.approx(134.9617, abs=5e-5)
    assert widest.tight.clearance_mm == pytest.approx(0, abs=1e-9)
    assert widest.tight.rule == RULE


def test_the_tight_point_is_where_both_motions_stand_at_their_limits() -> None:
    """Not where the die only begins to move while the mill passes the limit of another rule."""
    start = cm.widest_move(make_diagram(), "die", RULE).start_deg
    passing = ClearanceRule(
        beyond("die", 49), only_while=within("mill", make_mill().offset_mm(start))
    )
    widest = cm.widest_move(make_diagram(), "die", [passing, RULE])
    assert widest.tight is not None
    assert widest.tight.rule == RULE


def test_the_widest_move_is_in_its_diagram() -> None:
    widest = cm.widest_move(make_diagram(), "die", [RULE])
    assert widest.mechanism == "die"
    down, up = widest.diagram["die"].moves
    assert (down.angle_deg, up.angle_deg) == pytest.approx((widest.angle_deg, widest.angle_deg))
    assert (down.to_deg, up.from_deg) == (205, 305)
    assert widest.diagram["mill"] == make_mill()
    assert widest.diagram.rate_per_hour == 2000


def test_the_widest_move_does_not_depend_on_the_one_before() -> None:
    expected = cm.widest_move(make_diagram(), "die", RULE).angle_deg
    for angle in (1, 55, 100, 129.9, 130):
        diagram = make_diagram(make_mill(), make_die(angle))
        assert cm.widest_move(diagram, "die", RULE).angle_deg == pytest.approx(expected, abs=1e-10)


# Violations


def too_wide(by_deg: float, law: str | MotionLaw = "cycloidal") -> TimingDiagram:
    """Return the diagram with a die that moves wider than the widest."""
    diagram = make_diagram(make_mill(), make_die(law=law))
    widest = cm.widest_move(diagram, "die", RULE)
    return make_diagram(make_mill(), make_die(widest.angle_deg + by_deg, law=law))


def test_a_die_of_130_deg_collides() -> None:
    diagram = make_diagram(make_mill(), make_die(130))
    rising, falling = sorted(cm.find_violations(diagram, RULE), key=lambda v: v.start_deg)
    share = 1 - float(exact_place(mpmath.mpf(19) / 50))
    tight = float(exact_widest_deg()[1])
    assert (rising.start_deg, rising.end_deg) == pytest.approx(
        (150 - tight, 305 + 130 * share - 360)
    )
    assert (falling.start_deg, falling.end_deg) == pytest.approx((205 - 130 * share, tight))
    assert falling.angle_deg == falling.end_deg
    depth = die_mm(np.array([tight]), 130)[0]
    assert falling.excess_mm == pytest.approx(depth - 19)
    assert str(falling) == (
        "the die is 2.14 mm too deep at 134.96 deg, while the mill is not within 0.65 mm "
        "(from 132.105 to 134.962 deg)"
    )


@pytest.mark.parametrize("law", MONOTONE, ids=str)
def test_a_violation_of_a_millionth_of_a_degree_is_found(law: MotionLaw) -> None:
    share = 1 - law.inverse(19 / 50)
    found = cm.find_violations(too_wide(1e-6 / share, law), RULE)
    assert len(found) == 2
    for violation in found:
        assert violation.end_deg - violation.start_deg == pytest.approx(1e-6, abs=1e-9)
        assert 0 < violation.excess_mm < 1e-6


@examples(40)
@given(st.floats(-1000, 1000))
def test_it_is_found_wherever_it_lies(phase: float) -> None:
    share = 1 - cm.LAWS["cycloidal"].inverse(19 / 50)
    diagram = shifted(too_wide(1e-6 / share), phase)
    found = cm.find_violations(diagram, RULE)
    assert [v.end_deg - v.start_deg for v in found] == pytest.approx([1e-6] * 2, abs=1e-9)
    tight = float(exact_widest_deg()[1])
    ends = sorted((tight + phase) % 360 for tight in (tight, 150 - tight + 1e-6))
    assert sorted(v.end_deg % 360 for v in found) == pytest.approx(ends, abs=2e-9)


def test_no_grid_would_see_it() -> None:
    share = 1 - cm.LAWS["cycloidal"].inverse(19 / 50)
    diagram = too_wide(1e-6 / share)
    for samples in (360, 720, 3600, 10_000, 100_000):
        angles = np.linspace(0, 360, samples + 1)
        both = (diagram.position_mm("die", angles) > 19) & (
            diagram.offset_mm("mill", angles) > 0.65
        )
        assert not both.any()
    assert len(cm.find_violations(diagram, RULE)) == 2


def test_the_ends_of_a_violation_are_exact() -> None:
    """To 1e-9 deg, against roots of 30 digits; each end on its own law and limit."""
    share = 1 - exact_place(mpmath.mpf(19) / 50)
    tight = exact_widest_deg()[1]
    for angle in (124.91, 125, 127.3, 130):
        diagram = make_diagram(make_mill(), make_die(angle))
        rising, falling = sorted(cm.find_violations(diagram, RULE), key=lambda v: v.start_deg)
        assert falling.start_deg == pytest.approx(float(205 - angle * share), abs=1e-9)
        assert falling.end_deg == pytest.approx(float(tight), abs=1e-9)
        assert rising.start_deg == pytest.approx(float(150 - tight), abs=1e-9)
        assert rising.end_deg == pytest.approx(float(305 + angle * share - 360), abs=1e-9)


@pytest.mark.parametrize("law", [*MONOTONE, *TURNING], ids=str)
def test_touching_is_no_violation(law: MotionLaw) -> None:
    widest = cm.widest_move(make_diagram(make_mill(), make_die(law=law)), "die", RULE)
    assert cm.find_violations(widest.diagram, RULE) == ()
    again = make_diagram(make_mill(), make_die(widest.angle_deg, law=law))
    assert cm.find_violations(again, RULE) == ()


@examples(40)
@given(st.floats(-1000, 1000))
def test_touching_is_no_violation_wherever_it_is(phase: float) -> None:
    diagram = shifted(make_diagram(), phase)
    for rule in (RULE, ClearanceRule(beyond("die", 0), only_while=within("mill", 0))):
        widest = cm.widest_move(diagram, "die", rule)
        assert cm.find_violations(widest.diagram, rule) == ()
    assert widest.angle_deg == pytest.approx(55, abs=1e-9)


def test_two_motions_may_share_a_limit_or_an_end() -> None:
    """The die leaves its top where the mill comes to its stop, at 150 and 360 deg."""
    rule = ClearanceRule(beyond("die", 0), only_while=within("mill", 0))
    assert cm.find_violations(make_diagram(), rule) == ()
    assert len(cm.find_violations(make_diagram(make_mill(), make_die(55 + 1e-6)), rule)) == 2


def test_a_violation_across_360_deg_is_one_arc() -> None:
    diagram = make_diagram(make_mill(middle_deg=0), make_die(10, down_deg=(300, 400)))
    [violation] = cm.find_violations(diagram, RULE)
    tight, share = float(exact_widest_deg()[1]), 1 - float(exact_place(mpmath.mpf(19) / 50))
    assert violation.start_deg == pytest.approx(285 + 150 - tight, abs=1e-9)
    assert violation.end_deg == pytest.approx(400 + 10 * share, abs=1e-9)
    assert violation.excess_mm == 31
    assert str(violation).startswith(
        "the die is 31 mm too deep at 300.04 deg, while the mill is not within 0.65 mm "
        "(from 300.038 to 45.6"
    )


def test_a_violation_of_the_whole_turn_ends_at_360() -> None:
    rule = ClearanceRule(beyond("die", -1), only_while=beyond("mill", 60))
    [violation] = cm.find_violations(make_diagram(), rule)
    assert (violation.start_deg, violation.end_deg, violation.excess_mm) == (0, 360, 51)
    assert str(violation).endswith("while the mill is not beyond 60 mm (from 0 to 360 deg)")


def test_a_short_bump_of_a_law_is_found() -> None:
    """The die dips above its top by less than a nanometre too much, over 2e-3 deg."""
    lowest = 50 * DIPPING(4 / 15)
    bend = 50 * float(DIPPING.a.subs(cm.x, 4 / 15)) / 55**2  # in mm/deg2
    limit = lowest + bend / 2 * 1e-3**2
    rule = ClearanceRule(within("die", limit), only_while=beyond("mill", 200))
    [found] = cm.find_violations(make_diagram(make_mill(), make_die(law=DIPPING)), rule)
    assert (found.start_deg + found.end_deg) / 2 == pytest.approx(150 + 55 * 4 / 15, abs=1e-6)
    assert found.end_deg - found.start_deg == pytest.approx(2e-3, rel=1e-3)
    assert found.angle_deg == pytest.approx(150 + 55 * 4 / 15, abs=1e-9)
    assert found.excess_mm == pytest.approx(limit - lowest, rel=1e-4)
    assert " mm too near at " in str(found)


def test_violations_come_in_the_order_of_the_rules_and_of_the_angle() -> None:
    deeper = ClearanceRule(beyond("die", 30), only_while=within("mill", 0.65))
    diagram = make_diagram(make_mill(220), make_die(130))
    found = cm.find_violations(diagram, [deeper, RULE])
    assert [violation.rule for violation in found] == [deeper, deeper, RULE, RULE]
    starts = [violation.start_deg for violation in found]
    assert starts[:2] == sorted(starts[:2])
    assert starts[2:] == sorted(starts[2:])


# The smallest clearance

HALVES = [beyond, within]


def plain_room(condition: Condition, values: Array) -> Array:
    """Return how far the values are from a condition, below 0 where it holds."""
    sign = 1 if condition.is_beyond else -1
    return sign * (condition.limit_mm - values)


def plain_values(die: float | Array = 55, mill: float = 150, curve: str = "cycloidal") -> Any:
    """Return a function from a condition to the values of its motion at dense angles."""
    own = CURVES[curve]
    return lambda condition: (
        die_mm(COARSE, die, curve=own)
        if condition.motion == "die"
        else mill_off_mm(COARSE, mill, curve=own)
    )


@pytest.mark.parametrize("law", [MONOTONE[0], MONOTONE[7], *TURNING], ids=str)
@pytest.mark.parametrize(("one", "other"), [*product(HALVES, HALVES)])
@pytest.mark.parametrize("order", [1, -1])
def test_the_smallest_clearance_agrees_with_samples(
    law: MotionLaw, one: Callable[..., Condition], other: Callable[..., Condition], order: int
) -> None:
    for die_deg, limit, mill_limit in ((55, 19, 0.65), (124, 33, 12), (130, 7, 40)):
        halves = [one("die", limit), other("mill", mill_limit)][::order]
        rule = ClearanceRule(halves[0], only_while=halves[1])
        diagram = make_diagram(make_mill(law=law), make_die(die_deg, law=law))
        found = cm.smallest_clearance(diagram, rule)
        values = plain_values(die_deg, curve=law.name)
        rooms = plain_room(rule.when, values(rule.when))
        is_open = plain_room(rule.only_while, values(rule.only_while)) > 0
        sampled = rooms[is_open].min(initial=math.inf)
        assert found.clearance_mm == pytest.approx(sampled, abs=0.15)  # 0.05 deg of a steep wave
        assert found.clearance_mm <= sampled + 1e-9
        if found.angle_deg is not None:
            at = round(found.angle_deg % 360 / 0.05)
            assert rooms[at] == pytest.approx(found.clearance_mm, abs=0.15)
            assert is_open[[at - 1, at, (at + 1) % len(COARSE)]].any()


def test_the_clearance_of_the_mill_is_smallest_half_way() -> None:
    """Half-way between two stops it is 50 mm from both, though its law does not turn there."""
    rule = ClearanceRule(beyond("mill", 20), only_while=beyond("die", 60))
    found = cm.smallest_clearance(make_diagram(), rule)
    assert (found.clearance_mm, found.angle_deg) == (-30, 75)
    [violation] = cm.find_violations(make_diagram(), rule)
    assert (violation.excess_mm, violation.angle_deg) == (30, 75)


def test_the_clearance_of_each_rule() -> None:
    always = ClearanceRule(beyond("die", 19), only_while=within("mill", 50))
    tight, free = cm.find_clearances(make_diagram(make_mill(), make_die(100)), [RULE, always])
    assert 0 < tight.clearance_mm < 19
    assert tight.angle_deg == pytest.approx(15.0383, abs=5e-5)
    assert (free.clearance_mm, free.angle_deg, free.rule) == (math.inf, None, always)
    both = make_diagram(make_mill(), make_die(100))
    assert cm.smallest_clearance(both, [always, RULE]) == tight
    assert cm.smallest_clearance(both, always) == free


@pytest.mark.parametrize("die_deg", [65, 71.25, 72, 100])
def test_of_two_places_with_one_clearance_the_first_is_named(die_deg: float) -> None:
    """The die comes up as it went down, and no last digit may choose between the two."""
    found = cm.smallest_clearance(make_diagram(make_mill(), make_die(die_deg)), RULE)
    assert found.angle_deg == pytest.approx(15.0383, abs=5e-5)


def test_a_place_is_named_where_it_begins_and_not_where_the_turn_is_cut() -> None:
    die = cm.motion(
        "die",
        cm.rise(20, over_deg=40),
        cm.dwell(60),
        cm.return_(20, over_deg=40),
        cm.dwell(220),
        start_deg=300,
    )
    mill = cm.motion(
        "mill",
        cm.rise(10, over_deg=40),
        cm.dwell(160),
        cm.return_(10, over_deg=40),
        cm.dwell(120),
        start_deg=260,
    )
    rule, machine = ClearanceRule(beyond("die", 15), within("mill", 9)), make_diagram(die, mill)
    (violation,) = cm.find_violations(machine, rule)
    assert (violation.excess_mm, violation.angle_deg) == (5, 340)
    found = cm.smallest_clearance(machine, rule)
    assert (found.clearance_mm, found.angle_deg) == (-5, 340)


def test_clearance_and_violation_say_the_same() -> None:
    for angle in (55, 70, 100, 124, 126, 130):
        diagram = make_diagram(make_mill(), make_die(angle))
        clearance = cm.smallest_clearance(diagram, RULE).clearance_mm
        excess = [violation.excess_mm for violation in cm.find_violations(diagram, RULE)]
        assert (clearance < 0) == bool(excess)
        if excess:
            assert max(excess) == -clearance


# The widest move against a search in plain formulas


def is_broken(
    rules: list[ClearanceRule], values: dict[str, Array], tolerance: float = TOLERANCE_MM
) -> bool:
    """Return whether any sample breaks a rule by more than a tolerance."""
    return any(
        (
            (plain_room(rule.when, values[rule.when.motion]) < -tolerance)
            & (plain_room(rule.only_while, values[rule.only_while.motion]) > tolerance)
        ).any()
        for rule in rules
    )


SEVERAL = [
    RULE,
    ClearanceRule(beyond("die", 2), only_while=within("mill", 20)),
    ClearanceRule(beyond("mill", 35), only_while=within("die", 0.5)),
]

MACHINES: dict[str, tuple[str, str, list[ClearanceRule]]] = {
    **{f"die {law.name}": (law.name, "cycloidal", [RULE]) for law in [*MONOTONE, *TURNING]},
    **{f"mill {law.name}": ("cycloidal", law.name, [RULE]) for law in MONOTONE},
    "several rules": ("cycloidal", "cycloidal", SEVERAL),
    "several, other laws": ("wavy", "mod. sine", SEVERAL),
    "both turning": ("dipping", "overshooting", [*SEVERAL[1:]]),
}
LAW_OF = {law.name: law for law in [*MONOTONE, *TURNING]}


@pytest.mark.parametrize("name", MACHINES)
@pytest.mark.parametrize("motion", ["die", "mill"])
def test_the_widest_move_is_the_widest(name: str, motion: str) -> None:
    """No dense sample breaks a rule at the solution, and one does 0.01 deg further."""
    die_law, mill_law, rules = MACHINES[name]
    diagram = make_diagram(make_mill(170, law=LAW_OF[mill_law]), make_die(law=LAW_OF[die_law]))
    widest = cm.widest_move(diagram, motion, rules)
    for further, expected in ((0, False), (0.01, True)):
        die, mill = (widest.angle_deg + further if motion == it else base for it, base in BASES)
        values = {
            "die": die_mm(DENSE, die, curve=CURVES[die_law]),
            "mill": mill_off_mm(DENSE, mill, curve=CURVES[mill_law]),
        }
        assert is_broken(rules, values) == expected
    assert widest.tight is not None
    assert widest.tight.clearance_mm == pytest.approx(0, abs=1e-6)


BASES = (("die", 55), ("mill", 170))


def test_a_gate_closes_as_slowly_as_the_die_lets_it() -> None:
    """A rule the other way round: the gate may be nearly closed only while the die is up."""
    gate = cm.motion(
        "gate",
        *[cm.return_(60, over_deg=20), cm.dwell(40), cm.rise(60, over_deg=20), cm.dwell(280)],
        start_deg=20,
        start_mm=60,
    )
    rule = ClearanceRule(within("gate", 42), only_while=within("die", 3.5))
    widest = cm.widest_move(make_diagram(gate, make_die()), "gate", rule)
    for further, expected in ((0, False), (0.01, True)):
        width = widest.angle_deg + further
        gate_mm = 60 - die_mm(DENSE, width, stroke_mm=60, down_deg=(40, 80))
        assert is_broken([rule], {"gate": gate_mm, "die": die_mm(DENSE)}) == expected
    assert widest.tight is not None
    assert widest.diagram["gate"].position_mm(60) == 0


@dataclass(frozen=True)
class Case:
    """A machine of any proportions with rules in any direction, and which motion to widen."""

    stroke_mm: int
    down_deg: tuple[int, int]
    mill_deg: int
    middle_deg: int
    laws: tuple[MotionLaw, MotionLaw]
    rules: list[ClearanceRule]
    motion: str

    @property
    def diagram(self) -> TimingDiagram:
        """The timing diagram of the two motions."""
        die_law, mill_law = self.laws
        return make_diagram(
            make_mill(self.mill_deg, middle_deg=self.middle_deg, law=mill_law),
            make_die(5, stroke_mm=self.stroke_mm, down_deg=self.down_deg, law=die_law),
        )

    @property
    def room_deg(self) -> float:
        """The widest that a move can be in a turn."""
        start, end = self.down_deg
        return (360 - (end - start)) / 2 if self.motion == "die" else 360

    def is_broken(self, width_deg: float, cam_deg: Array) -> bool:
        """Return whether a sample breaks a rule, with moves of that width."""
        die_curve, mill_curve = (CURVES[law.name] for law in self.laws)
        width = {"die": 5.0, "mill": float(self.mill_deg), self.motion: width_deg}
        values = {
            "die": die_mm(
                cam_deg,
                width["die"],
                stroke_mm=self.stroke_mm,
                down_deg=self.down_deg,
                curve=die_curve,
            ),
            "mill": mill_off_mm(
                cam_deg, width["mill"], middle_deg=self.middle_deg, curve=mill_curve
            ),
        }
        return is_broken(self.rules, values)

    def is_surely_broken(self, width_deg: float) -> bool:
        """Look again at many more angles where few show nothing."""
        return self.is_broken(width_deg, COARSE) or self.is_broken(width_deg, DENSE)


@st.composite
def cases(draw: st.DrawFn) -> Case:
    """Make a case; the limits are never exactly where a motion dwells."""
    stroke, start = draw(st.integers(5, 80)), draw(st.integers(0, 359))
    rules = []
    for _ in range(draw(st.integers(1, 2))):
        halves = [
            draw(st.sampled_from(HALVES))("die", draw(st.integers(1, stroke - 1)) - 0.37),
            draw(st.sampled_from(HALVES))("mill", draw(st.integers(1, 40)) - 0.37),
        ]
        first = draw(st.integers(0, 1))
        rules.append(ClearanceRule(halves[first], only_while=halves[1 - first]))
    laws = st.sampled_from([*MONOTONE[:4], *TURNING[:2]])
    return Case(
        stroke_mm=stroke,
        down_deg=(start, start + draw(st.integers(10, 250))),
        mill_deg=draw(st.integers(30, 250)),
        middle_deg=draw(st.integers(0, 359)),
        laws=(draw(laws), draw(laws)),
        rules=rules,
        motion=draw(st.sampled_from(["die", "mill"])),
    )


def widest_or_none(case: Case) -> WidestMove | None:
    """Return the widest move, or None where none keeps the rules."""
    try:
        return cm.widest_move(case.diagram, case.motion, case.rules)
    except cm.InputError as refusal:
        if not str(refusal).startswith(f"No move of the {case.motion} keeps the rules: "):
            raise
        return None


@examples(30)
@given(cases())
def test_a_search_in_small_steps_finds_no_wider_move(case: Case) -> None:
    """Every Bm that the search tries above the solution is broken, and the solution is not."""
    widest = widest_or_none(case)
    beginning = 1 if widest is None else widest.angle_deg + 1
    assert all(case.is_surely_broken(width) for width in np.arange(beginning, case.room_deg, 3.0))
    if widest is not None:
        assert not case.is_broken(widest.angle_deg, DENSE)
        assert (widest.tight is None) == (widest.angle_deg == case.room_deg)


def test_a_motion_is_given_another_angle_about_what_stays() -> None:
    assert with_angle(make_mill(), 170) == make_mill(170)
    assert with_angle(make_mill(), 360).moves[0].from_deg == -105
    wider = with_angle(make_die(), 130)
    assert [segment.kind for segment in wider.segments] == ["rise", "dwell", "return"]
    assert wider.position_mm(DENSE) == pytest.approx(die_mm(DENSE, 130), abs=1e-9)
    for angle in (0, -5, 130.1, math.nan):
        with pytest.raises(cm.InputError, match=r"^The indexing angle is .* at most 130 deg: give"):
            with_angle(make_die(), angle)


def test_the_turn_itself_may_be_the_bound() -> None:
    free = ClearanceRule(beyond("die", 60), only_while=within("mill", 0.65))
    die = cm.widest_move(make_diagram(), "die", free)
    assert (die.angle_deg, die.tight) == (130, None)
    assert [segment.kind for segment in die.diagram["die"].segments] == ["rise", "dwell", "return"]
    mill = cm.widest_move(make_diagram(), "mill", free)
    assert (mill.angle_deg, mill.tight) == (360, None)


def test_the_mill_is_widened_about_its_middle() -> None:
    widest = cm.widest_move(make_diagram(), "mill", RULE)
    [move] = widest.diagram["mill"].moves
    assert (move.from_deg + move.to_deg) / 2 == pytest.approx(75)
    assert widest.start_deg == pytest.approx((75 - widest.angle_deg / 2) % 360)
    assert widest.diagram["die"] == make_die()
    assert widest.diagram["mill"].stops == 24


@examples(40)
@given(st.floats(0.5, 49), st.floats(0.5, 49), st.floats(0.01, 30), st.floats(0.01, 30))
def test_a_larger_limit_never_gives_a_narrower_move(
    depth: float, other_depth: float, off: float, other_off: float
) -> None:
    assume(depth != other_depth and off != other_off)
    for law in (MONOTONE[0], WAVY):
        diagram = make_diagram(make_mill(), make_die(20, law=law))
        angles = [
            cm.widest_move(
                diagram, "die", ClearanceRule(beyond("die", d), only_while=within("mill", o))
            ).angle_deg
            for d, o in (
                (min(depth, other_depth), min(off, other_off)),
                (max(depth, other_depth), min(off, other_off)),
                (max(depth, other_depth), max(off, other_off)),
            )
        ]
        assert angles == sorted(angles)


def smaller(diagram: TimingDiagram, by: float) -> TimingDiagram:
    """Return a diagram with every length a part of what it was."""
    motions = [
        replace(
            motion,
            segments=[
                replace(s, from_mm=s.from_mm * by, to_mm=s.to_mm * by) for s in motion.segments
            ],
        )
        for motion in diagram.motions
    ]
    return TimingDiagram(motions, diagram.rate_per_hour)


@pytest.mark.parametrize("by", [0.015, 1e-3])
def test_a_tiny_machine_collides_where_a_large_one_does(by: float) -> None:
    """Strokes and clearances below 1 mm are like others."""
    rule = ClearanceRule(beyond("die", 19 * by), only_while=within("mill", 0.65 * by))
    for angle in (55, 130):
        large = make_diagram(make_mill(), make_die(angle))
        tiny = smaller(large, by)
        found, wanted = cm.find_violations(tiny, rule), cm.find_violations(large, RULE)
        assert len(found) == len(wanted) == (0 if angle == 55 else 2)
        for one, other in zip(found, wanted, strict=True):
            assert one.start_deg == pytest.approx(other.start_deg, abs=1e-6)
            assert one.end_deg == pytest.approx(other.end_deg, abs=1e-6)
            assert one.excess_mm == pytest.approx(by * other.excess_mm, rel=1e-5)
        left, right = (
            cm.smallest_clearance(diagram, which).clearance_mm
            for diagram, which in ((tiny, rule), (large, RULE))
        )
        assert left == pytest.approx(by * right, rel=1e-6)
    tiny = smaller(make_diagram(), by)
    widest = cm.widest_move(tiny, "die", rule).angle_deg
    assert widest == pytest.approx(cm.widest_move(make_diagram(), "die", RULE).angle_deg)


def test_more_rules_never_give_a_wider_move() -> None:
    each = [cm.widest_move(make_diagram(), "die", rule).angle_deg for rule in SEVERAL]
    assert cm.widest_move(make_diagram(), "die", SEVERAL).angle_deg <= min(each)


# Refusals


def test_no_move_at_all_is_refused_in_words() -> None:
    """The die is down from 205 on, and the mill is under way until 230 deg."""
    with pytest.raises(cm.InputError) as refusal:
        cm.widest_move(make_diagram(make_mill(middle_deg=155), make_die()), "die", RULE)
    said = str(refusal.value)
    assert said.startswith(
        "No move of the die keeps the rules: however quickly it moves, the die is 31 mm too "
        "deep at 205 deg, while the mill is not within 0.65 mm (from 205 to 214.9"
    )
    assert said.endswith(" deg). Move its dwell, or give the other motion less of the turn.")


def test_only_a_simple_motion_is_widened() -> None:
    twice = cm.motion(
        "die", *[cm.rise(50, over_deg=60), cm.return_(50, over_deg=60), cm.dwell(60)] * 2
    )
    steps = cm.indexing_motion("mill", *[cm.rise(50, over_deg=60), cm.dwell(120)] * 2, stops=24)
    still = cm.motion("table", cm.dwell(360))
    rule = ClearanceRule(beyond("die", 60), only_while=within("mill", 60))
    for name, moves, build in (
        ("die", 4, "one rise and one return"),
        ("mill", 2, "one move"),
        ("table", 0, "one rise and one return"),
    ):
        match = rf"^The motion '{name}' has {moves} moves, and only one with {build} can be widened"
        with pytest.raises(cm.InputError, match=match):
            cm.widest_move(make_diagram(twice, steps, still), name, rule)


QUESTIONS: list[Callable[..., object]] = [
    cm.find_violations,
    cm.find_clearances,
    cm.smallest_clearance,
    lambda diagram, rules: cm.widest_move(diagram, "die", rules),
]


@pytest.mark.parametrize("question", QUESTIONS)
def test_every_question_refuses_what_it_cannot_answer(question: Callable[..., object]) -> None:
    for rules in (None, 3, "die", [RULE, None], beyond("die", 19)):
        with pytest.raises(cm.InputError, match=r"rules.*: give (one or a list|a ClearanceRu)"):
            question(make_diagram(), rules)
    unknown = ClearanceRule(beyond("punch", 19), only_while=within("mill", 0.65))
    with pytest.raises(cm.InputError, match=r"^There is no motion 'punch': use one of 'mill', 'di"):
        question(make_diagram(), [RULE, unknown])
    unknown = ClearanceRule(beyond("die", 19), only_while=within("turret", 0.65))
    with pytest.raises(cm.InputError, match=r"^There is no motion 'turret': use one of 'mill', "):
        question(make_diagram(), unknown)


def test_no_rule_is_broken_by_nothing_and_leaves_the_widest_move() -> None:
    nothing: list[Any] = []
    empty: Iterable[Any]
    for empty in (nothing, (), set(), {}.values(), iter(nothing), (rule for rule in nothing)):
        assert cm.find_violations(make_diagram(), empty) == ()
    assert cm.find_clearances(make_diagram(), set()) == ()
    for none in ("", b"", 0, None):
        with pytest.raises(cm.InputError, match="give one or a list"):
            cm.find_violations(make_diagram(), none)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match="There is no rule, and so no clearance"):
        cm.smallest_clearance(make_diagram(), [])
    free = cm.widest_move(make_diagram(), "die", [])
    assert free.angle_deg > cm.widest_move(make_diagram(), "die", RULE).angle_deg


@pytest.mark.parametrize(
    ("limits_mm", "why"),
    [((60, 0.65), "the die is never beyond 60 mm"), ((19, 60), "the mill is always within 60 mm")],
)
def test_a_rule_that_nothing_can_break_is_said_to_be_one(
    limits_mm: tuple[float, float], why: str
) -> None:
    rule = ClearanceRule(beyond("die", limits_mm[0]), within("mill", limits_mm[1]))
    found = cm.widest_move(make_diagram(), "die", [RULE, rule])
    assert found.idle == (why,)
    assert repr(found).endswith(f"; a rule that nothing can break: {why})")
    shown = cm.animate(make_diagram(), rules=rule)
    assert f"; rule kept: {why})" in shown.description
    assert (
        "rules kept (2 cannot be broken)"
        in cm.animate(
            make_diagram(), rules=[rule, ClearanceRule(beyond("die", 70), within("mill", 0.65))]
        ).svg
    )
    assert cm.widest_move(make_diagram(), "die", RULE).idle == ()


@pytest.mark.parametrize(
    "rule",
    [
        ClearanceRule(beyond("die", 19), cm.moving("mill")),
        ClearanceRule(cm.standing("mill"), within("die", 19)),
    ],
)
def test_no_rule_is_idle_that_another_timing_breaks(rule: ClearanceRule) -> None:
    """A mill that moves all the turn never stands; today's does, and the rule is broken."""
    assert cm.find_violations(make_diagram(), rule)
    wide = cm.widest_move(make_diagram(), "mill", rule)
    assert wide.angle_deg == 360
    assert (wide.idle, rule.idle(wide.diagram)) == ((), "")


@pytest.mark.parametrize("question", QUESTIONS[:3])
@pytest.mark.parametrize("diagram", [None, 3, make_die()], ids=["None", "3", "a motion"])
def test_rules_are_for_a_diagram(question: Callable[..., object], diagram: object) -> None:
    with pytest.raises(cm.InputError, match=r"^The diagram is .*: give a TimingDiagram"):
        question(diagram, RULE)


def test_an_unknown_motion_is_not_widened() -> None:
    with pytest.raises(cm.InputError, match=r"^There is no motion 'punch': use one of 'mill', 'di"):
        cm.widest_move(make_diagram(), "punch", RULE)


@pytest.mark.parametrize("half", [None, "die", 19, RULE], ids=["None", "die", "19", "a rule"])
def test_a_rule_is_made_of_conditions(half: Any) -> None:
    match = r"^ClearanceRule is given (when|only_while)=.*: give a condition, made with beyond"
    with pytest.raises(cm.InputError, match=match):
        ClearanceRule(half, only_while=within("mill", 0.65))
    with pytest.raises(cm.InputError, match=match):
        ClearanceRule(beyond("die", 19), only_while=half)


def test_a_rule_is_about_two_motions() -> None:
    match = r"^Both halves of the clearance rule are about 'die': name two motions\.$"
    with pytest.raises(cm.InputError, match=match):
        ClearanceRule(beyond("die", 19), only_while=within("die", 0.65))


def press(*names: str, **changes: float) -> cm.Motion:
    """Return a die with a rise and a return over angles of their own."""
    rise, back = changes.get("rise", 60.0), changes.get("back", 70.0)
    return cm.motion(
        names[0] if names else "die",
        cm.rise(50, over_deg=rise),
        cm.dwell(100),
        cm.return_(50, over_deg=back),
        cm.dwell(260 - rise - back),
        start_deg=205 - rise,
    )


def test_rise_and_return_of_two_angles_keep_two() -> None:
    """One angle for both made of 60 and 70 deg a rise and a return over 60, and pushed harder."""
    mill, rule = cm.EXAMPLE.mill.shifted(-30), cm.EXAMPLE.rule
    diagram = cm.TimingDiagram([mill, press()], 2000)
    own, one = (
        cm.widest_move(diagram, "die", rule, each_way=each_way) for each_way in (None, False)
    )
    rise, back = own.angles_deg
    assert back < rise
    assert one.angles_deg == pytest.approx((back, back))
    assert own.angle_deg == back
    assert not cm.find_violations(own.diagram, rule)
    for wider in ((rise + 0.001, back), (rise, back + 0.001)):
        die = press(rise=wider[0], back=wider[1])
        assert cm.find_violations(cm.TimingDiagram([mill, die], 2000), rule)


def test_without_rules_each_way_gets_the_angle_that_makes_both_as_hard() -> None:
    slide = cm.motion(
        "slide",
        *(cm.rise(50, over_deg=60, law="cycloidal"), cm.dwell(100)),
        *(cm.return_(50, over_deg=70, law="modified trapezoid"), cm.dwell(130)),
    )
    found = cm.widest_move(cm.TimingDiagram([slide], 2000), "slide", [], each_way=True)
    rise, back = found.diagram["slide"].moves
    assert rise.angle_deg + back.angle_deg == pytest.approx(260)
    ratio = cm.LAWS["cycloidal"].Ca / cm.LAWS["modified trapezoid"].Ca
    assert rise.angle_deg / back.angle_deg == pytest.approx(math.sqrt(ratio), rel=1e-6)


def test_without_rules_each_way_at_even_speeds_is_as_fast_as_the_other() -> None:
    """There is no acceleration that could be as large: of such moves the speeds are compared."""
    even = cm.MotionLaw("constant velocity", cm.x)
    slide = cm.motion(
        "slide",
        *(cm.rise(50, over_deg=60, law=even), cm.dwell(100)),
        *(cm.return_(50, over_deg=70, law=even), cm.dwell(130)),
    )
    found = cm.widest_move(cm.TimingDiagram([slide], 2000), "slide", [], each_way=True)
    assert found.angles_deg == pytest.approx((130, 130))


@pytest.mark.parametrize("is_turned", [False, True])
def test_where_a_velocity_jumps_each_way_the_widest_pair_is_taken(is_turned: bool) -> None:
    """The peak is infinite at any angle; a rise at one speed and a cycloidal return, or turned.

    The cycloid is twice as fast in its middle as on the average, and so gets twice as much.
    """
    laws = ["constant velocity", "cycloidal"][:: -1 if is_turned else 1]
    slide = cm.motion(
        "slide",
        *(cm.rise(50, over_deg=60, law=laws[0]), cm.dwell(99)),
        *(cm.return_(50, over_deg=70, law=laws[1]), cm.dwell(131)),
    )
    found = cm.widest_move(cm.TimingDiagram([slide], 2000), "slide", [], each_way=True)
    assert found.angles_deg == pytest.approx((174, 87) if is_turned else (87, 174))
    assert found.diagram.peak_velocity("slide") == pytest.approx(50 / 87 * 360 / 1.8 / 1000)


def test_each_way_is_never_worse_than_one_angle_for_both() -> None:
    rng = np.random.default_rng(11)
    better = 0
    for _ in range(25):
        mill = cm.EXAMPLE.mill.shifted(rng.uniform(-40, 40))
        diagram = cm.TimingDiagram([mill, press(rise=40, back=40)], 2000)
        try:
            one = cm.widest_move(diagram, "die", cm.EXAMPLE.rule)
        except cm.InputError:
            continue
        own = cm.widest_move(diagram, "die", cm.EXAMPLE.rule, each_way=True)
        assert not cm.find_violations(own.diagram, cm.EXAMPLE.rule)
        assert own.peak_acceleration <= one.peak_acceleration * (1 + 1e-9)
        better += max(own.angles_deg) > one.angle_deg + 1
    assert better > 5


def test_a_rule_between_two_others_is_reported_and_not_obeyed() -> None:
    broken = cm.ClearanceRule(cm.beyond("ram", 1), only_while=cm.within("mill", 0.1))
    diagram = cm.TimingDiagram([cm.EXAMPLE.mill, cm.EXAMPLE.die, press("ram", rise=100)], 2000)
    found = cm.widest_move(diagram, "die", [broken, cm.EXAMPLE.rule])
    assert found.angle_deg == pytest.approx(124.8369, abs=1e-4)
    assert found.elsewhere == cm.find_violations(diagram, broken)
    assert len(found.elsewhere) > 0
    assert cm.widest_move(diagram, "die", cm.EXAMPLE.rule).elsewhere == ()


def test_a_wrong_answer_is_an_error_that_asks_to_be_reported(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """A solver that misses the widest candidates, and one that takes a broken rule for kept."""
    module = "cammotion.limits.widest"
    few = Frame.candidates
    for narrow in (90.0, 124.83):  # the widest is 124.8369
        with monkeypatch.context() as broken:
            broken.setattr(Frame, "candidates", lambda *given, bm=narrow: [(bm, bm), *few(*given)])
            with pytest.raises(cm.WrongAnswerError, match=f"more than {narrow} deg.*report it"):
                cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule)
    monkeypatch.setattr(f"{module}._keeps", lambda *_: True)
    with pytest.raises(cm.WrongAnswerError, match="breaks a rule"):
        cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule)


def test_a_full_turn_is_a_turn_whatever_its_last_digit() -> None:
    for angle in np.random.default_rng(3).uniform(1, 359, 300):
        table = cm.indexing_motion(
            "table", cm.rise(100, over_deg=angle), cm.dwell(360 - angle), stops=8, start_deg=angle
        )
        assert cm.widest_move(
            cm.TimingDiagram([table, cm.EXAMPLE.die], 2000),
            "table",
            cm.ClearanceRule(cm.beyond("die", 99), only_while=cm.within("table", 0.65)),
        ).angle_deg == pytest.approx(360)
