"""The explorer of the overlap, without a browser: what it judges, against the package's solvers."""

import re
from contextlib import suppress
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
import sympy as sp
from explored import at_corners, control_of, drawn, limits_of, lines_of, peaks_said
from machines import OVERSHOOTING, RULE, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion.machine.motions import Motion
from cammotion.rules.conditions import Condition
from cammotion.rules.rule import Violation
from cammotion.views.explorers.overlap import B_MILL, START, B_m
from cammotion.views.live.figure import LiveFigure

DIAGRAM = make_diagram()
CONTROLS = B_m, START, B_MILL
AT = np.linspace(0.013, 359.987, 400)
LATE = cm.MotionLaw("late {x}", cm.x**3 * (4 - 3 * cm.x))
SAMPLED = cm.law_from_points(np.linspace(0, 1, 9), np.linspace(0, 1, 9) ** 2, name="<b>points</b>")


@pytest.fixture
def figure() -> LiveFigure:
    return cm.explore_overlap(DIAGRAM, RULE, contact_mm=20)


def margin_of(figure: LiveFigure) -> sp.Symbol:
    """Return the symbol of the margin, whose value is the number of the chosen name."""
    (symbol,) = (symbol for symbol in figure.values if symbol.name == "margin")
    return symbol


def set_margin(figure: LiveFigure, margin_mm: float) -> None:
    symbol = margin_of(figure)
    figure.values = {symbol: symbol.options.index(f"{margin_mm:g} mm")}


class Explored:
    """An explorer beside the diagram and the rule that its controls stand for."""

    def __init__(self, given: cm.TimingDiagram, rule: cm.ClearanceRule, contact_mm: float) -> None:
        self.figure = cm.explore_overlap(given, rule, contact_mm=contact_mm)
        self.given, self.start_rule, self.contact_mm = given, rule, contact_mm
        self.mill, self.die = (given[half.motion] for half in (rule.only_while, rule.when))

    @property
    def rule(self) -> cm.ClearanceRule:
        """The rule with the margin that is set."""
        limit = self.contact_mm - float(self.figure.chosen["margin"].removesuffix(" mm"))
        return replace(self.start_rule, when=replace(self.start_rule.when, limit_mm=limit))

    @property
    def diagram(self) -> cm.TimingDiagram:
        """The diagram that is set."""
        angle, start, mill_deg, _ = self.figure.values.values()
        mill = cm.with_angle(self.mill, mill_deg)
        return self.given.with_motion(mill).with_motion(moved(self.die, angle, start))

    def check(self) -> None:
        """Compare all that is said and drawn with what the package computes."""
        diagram, text = self.diagram, self.figure.text
        peaks = [diagram.peak_acceleration(motion.name) for motion in (self.die, self.mill)]
        assert peaks_said(text) == pytest.approx(peaks, abs=5.1e-4)
        violations = cm.find_violations(diagram, self.rule)
        if violations:
            self._check_collision(max(violations, key=lambda found: found.excess_mm), text)
        else:
            left = cm.smallest_clearance(diagram, self.rule).clearance_mm
            (said,) = re.findall(
                r"The rule is kept. At the tightest place, [^ ]+ deg, ([^ ]+) mm", text
            )
            assert float(said) == pytest.approx(max(left, 0), rel=6e-3, abs=1e-8)
        self._check_timing(diagram)
        self._check_map(diagram, violations)

    def _check_collision(self, worst: Violation, text: str) -> None:
        die, mill = re.escape(self.die.name), re.escape(self.mill.name)
        said = rf"RULE BROKEN: the {die} is (.*) mm too deep at (.*) deg, while the {mill} is not "
        ((excess, angle),) = re.findall(said, text)
        assert float(excess) == pytest.approx(worst.excess_mm, rel=6e-3)
        there = float(self.diagram.offset_mm(self.die.name, float(angle)))
        at_worst = float(self.diagram.offset_mm(self.die.name, worst.angle_deg))
        stroke = np.ptp(self.die.range_mm)
        assert there == pytest.approx(at_worst, abs=0.01 * stroke)  # the angle has five digits

    def _check_timing(self, diagram: cm.TimingDiagram) -> None:
        low, high = limits_of(self.figure, "Timing")
        lines = lines_of(self.figure, "Timing")
        for motion, line in zip((self.mill, self.die), lines, strict=True):
            heights = drawn(self.figure, line["y"], AT)
            assert low <= np.min(heights) <= np.max(heights) <= high
            apart = np.asarray(diagram.position_mm(motion.name, AT)) - heights
            if motion.is_indexing:  # whole pitches from a stop
                apart = apart - motion.start_mm
                apart -= motion.pitch_mm * np.round(apart / motion.pitch_mm)
            assert apart == pytest.approx(0, abs=1e-6)
        before = lines_of(self.figure, "Timing", "reference")[1]
        as_it_was = np.asarray(self.die.position_mm(AT))
        assert drawn(self.figure, before["y"], AT) == pytest.approx(as_it_was, abs=1e-6)

    def _check_map(self, diagram: cm.TimingDiagram, violations: tuple[Violation, ...]) -> None:
        (line,) = lines_of(self.figure, "Clearance map")
        for motion, axis in ((self.mill, "x"), (self.die, "y")):
            offsets = np.asarray(diagram.offset_mm(motion.name, AT))
            assert drawn(self.figure, line[axis], AT) == pytest.approx(offsets, abs=1e-6)
        (marked,) = lines_of(self.figure, "Clearance map", "alarm")
        arcs = [((AT - each.start_deg) % 360, each) for each in violations]
        broken = [since < each.end_deg - each.start_deg for since, each in arcs]
        found = drawn(self.figure, marked["where"], AT) > 0
        assert np.array_equal(found, np.any([np.zeros(len(AT), bool), *broken], axis=0))

    def check_button(self) -> None:
        """Press the button, and compare what it sets with the solver's answer."""
        before, least = self.figure.values, control_of(self.figure, B_m)["low"]
        found = None
        with suppress(cm.InputError):
            found = cm.widest_move(self.diagram, self.die.name, self.rule, each_way=False)
        self.figure.press(f"Widest move of the {self.die.name}")
        if found is None or found.angle_deg < least:
            assert f"no move of {least:g} deg or more that keeps the" in self.figure.text
            assert self.figure.values == before
            return
        assert "has no move" not in self.figure.text
        assert self.figure.values[B_m] == pytest.approx(found.angle_deg, abs=1e-6)
        turned = self.figure.values[START] - found.start_deg
        assert (turned + 180) % 360 - 180 == pytest.approx(0, abs=1e-6)
        assert "RULE BROKEN" not in self.figure.text


def moved(die: Motion, angle: float, start: float) -> Motion:
    """Return a die with both moves over an angle from a start on, by the words of the package."""
    down, up = die.moves
    work = up.from_deg - down.to_deg
    rest = 360 - work - 2 * angle
    parts = [
        cm.rise(down.change_mm, over_deg=angle, law=down.law),  # type: ignore[arg-type]
        *([cm.dwell(work)] if work > 1e-9 else []),
        cm.return_(-up.change_mm, over_deg=angle, law=up.law),  # type: ignore[arg-type]
        *([cm.dwell(rest)] if rest > 1e-9 else []),
    ]
    return cm.motion(die.name, *parts, start_deg=start, start_mm=die.start_mm)


def make(mill: Motion, *die: Any, limit: float, within: float, **place: float) -> Any:
    """Return a diagram of a mill and a die, and their rule."""
    motion = cm.motion("die {y}", *die, **place)
    only_while = cm.within(mill.name, within)
    return make_diagram(mill, motion), cm.ClearanceRule(cm.beyond("die {y}", limit), only_while)


def turret(name: str, pitch_mm: float, over_deg: float, law: Any = LATE, **place: float) -> Motion:
    """Return an indexing motion with one move, back if the pitch is below 0."""
    move = (cm.rise if pitch_mm > 0 else cm.return_)(abs(pitch_mm), over_deg=over_deg, law=law)
    return cm.indexing_motion(name, move, cm.dwell(360 - over_deg), stops=3, **place)


DOWN, UP = cm.rise(50, over_deg=55), cm.return_(50, over_deg=55)
MACHINES = {
    "the example": (DIAGRAM, RULE, 20),
    "a die that turns back at once": (
        *make(make_mill(), DOWN, UP, cm.dwell(250), start_deg=200, limit=19, within=0.65),
        20,
    ),
    "a die that hardly turns": (
        *make(make_mill(30), cm.rise(9, over_deg=12), cm.dwell(330), cm.return_(9, over_deg=12),
              cm.dwell(6), start_deg=100, limit=4, within=0.65),
        4.5,
    ),
    "two laws, another height, starts past 360": (
        *make(
            turret("mill {0} <b>", 30, 120, start_deg=-700, start_mm=26.3),
            cm.rise(70, over_deg=75, law=SAMPLED), cm.dwell(70),
            cm.return_(70, over_deg=75, law=LATE), cm.dwell(140),
            start_deg=1300, start_mm=-40, limit=-10, within=2,
        ),
        -8,
    ),
    "a mill through 0 deg, and back": (
        *make(turret("$\\frac$", -80, 100, "cubic", start_deg=310),
              DOWN, cm.dwell(80), UP, cm.dwell(170), start_deg=60, limit=30, within=0),
        30,
    ),
    "two ways that take nearly all": (
        *make(turret("mill", 10, 50), cm.rise(5, over_deg=178), cm.return_(5, over_deg=178),
              cm.dwell(4), start_deg=120, limit=2.5, within=1),
        3,
    ),
    "a limit at the start, contact at the end": (
        *make(make_mill(100), DOWN, cm.dwell(100), UP, cm.dwell(150), start_deg=150, limit=0,
              within=49.9),
        50,
    ),
    "infinite peaks": (
        *make(turret("mill", 100, 150, cm.MotionLaw("line", cm.x)), DOWN, cm.dwell(100),
              cm.return_(50, over_deg=55, law=cm.MATCHED), cm.dwell(150), start_deg=150, limit=19,
              within=0.65),
        20,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MACHINES)
def test_every_machine_is_judged_as_the_package_judges_it(name: str) -> None:
    explored = Explored(*MACHINES[name])
    for _ in at_corners(explored.figure, margin_of(explored.figure)):
        explored.check()
        before = explored.figure.values
        explored.check_button()
        explored.figure.values = before
    rng = np.random.default_rng(7)
    for _ in range(5):
        ranges = [control_of(explored.figure, symbol) for symbol in CONTROLS]
        numbers = [rng.uniform(each["low"], each["high"]) for each in ranges]
        explored.figure.values = dict(zip(CONTROLS, numbers, strict=True))
        explored.check()
        explored.check_button()
    assert explored.figure.picture()


def test_every_corner_of_the_controls() -> None:
    explored = Explored(DIAGRAM, RULE, 20)
    for _ in at_corners(explored.figure, *explored.figure.values):
        explored.check()


def test_a_collision_turns_up_at_once_and_is_named() -> None:
    explored = Explored(DIAGRAM, RULE, 20)
    explored.figure.values = {B_m: 130, START: 75}
    worst = cm.find_violations(explored.diagram, RULE)[0]
    said = f"RULE BROKEN: the die is 2.14 mm too deep at {worst.angle_deg:.5g} deg, while the mill"
    assert f"{said} is not within 0.65 mm" in explored.figure.text
    (mark,) = lines_of(explored.figure, "Clearance map", "alarm")
    near = np.array([134.9617 - 2e-4, 134.9617 + 2e-4])  # where the mill is near its stop
    assert [*(drawn(explored.figure, mark["where"], near) > 0)] == [True, False]
    explored.figure.values = {START: 82, B_m: 123}
    assert "The rule is kept" in explored.figure.text


def test_the_button_finds_the_widest_move(figure: LiveFigure) -> None:
    figure.press("Widest move of the die")
    assert figure.values[B_m] == pytest.approx(124.9053, abs=1e-4)
    assert figure.values[START] == pytest.approx(205 - figure.values[B_m])
    assert "deg, 0 mm are left." in figure.text
    set_margin(figure, 0)
    assert "The rule is kept" in figure.text
    figure.press("Widest move of the die")
    assert figure.values[B_m] == pytest.approx(127.25, abs=5e-3)
    assert "a_max = 0.776 m/s²" in figure.text


def test_no_rounding_is_said_of_the_room_that_is_used_up() -> None:
    figure = cm.explore_overlap(cm.EXAMPLE.diagram, cm.EXAMPLE.rule, contact_mm=20)
    figure.press("Widest move of the die")
    assert "die: 124.84 deg, from 80.163 to 205 deg, a_max = 0.806 m/s²" in figure.text
    assert "The rule is kept. At the tightest place, 15 deg, 0 mm are left." in figure.text


def test_equal_peaks_are_found_where_the_source_has_them(figure: LiveFigure) -> None:
    figure.values = {B_MILL: 163.267}
    figure.press("Widest move of the die")
    assert figure.values[B_m] == pytest.approx(115.447, abs=5e-3)
    assert peaks_said(figure.text) == pytest.approx([0.943, 0.943])


def test_where_no_move_is_free_it_says_so_and_nothing_changes(figure: LiveFigure) -> None:
    figure.values = {START: 0}  # down and at work in the middle of the mill's move
    before = figure.values
    figure.press("Widest move of the die")
    assert "has no move of 20 deg or more that keeps the rule" in figure.text
    assert figure.values == before
    figure.values = {START: 150}
    assert "no move" not in figure.text


def test_the_margin_moves_the_forbidden_region(figure: LiveFigure) -> None:
    (box,) = figure.description["columns"][1][0]["boxes"]
    for margin in (1, 3):
        set_margin(figure, margin)
        corner = figure._now[box["x_low"]](), figure._now[box["y_low"]]()
        assert corner == pytest.approx((0.65, 20 - margin))


def rule_of(first: Condition, second: Condition) -> cm.ClearanceRule:
    return cm.ClearanceRule(first, only_while=second)


@pytest.mark.parametrize(
    ("rule", "said"),
    [
        (rule_of(cm.beyond("mill", 19), cm.within("die", 0.65)), "cannot be explored: give one in"),
        (rule_of(cm.within("die", 19), cm.within("mill", 0.65)), "cannot be explored: give one in"),
        (
            rule_of(cm.beyond("die", 21), cm.within("mill", 0.65)),
            "contact is 20 mm.*give a contact_mm of at least 21 mm",
        ),
        (rule_of(cm.beyond("die", -1), cm.within("mill", 0.65)), "the die above its start, 0 mm"),
        (rule_of(cm.beyond("die", 19), cm.within("mill", 50)), "half of its pitch, 50 mm"),
        (rule_of(cm.beyond("die", 19), cm.within("mill", -0.1)), "mill is -0.1 mm, .* at least 0"),
    ],
    ids=str,
)
def test_the_overlap_needs_a_rule_of_its_kind(rule: cm.ClearanceRule, said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.explore_overlap(DIAGRAM, rule, contact_mm=20)


def test_two_angles_are_refused() -> None:
    """With one for both it said of a machine that breaks its rule that the rule is kept."""
    die = cm.motion("die", DOWN, cm.dwell(90), cm.return_(50, over_deg=150), cm.dwell(65))
    with pytest.raises(cm.InputError, match=r"over 55 deg and returns over 150 deg.*explore_ways"):
        cm.explore_overlap(make_diagram(make_mill(), die), RULE, contact_mm=20)


def test_a_law_that_turns_back_is_refused() -> None:
    for diagram in (
        make_diagram(make_mill(law=OVERSHOOTING), make_die()),
        make_diagram(make_mill(), make_die(law=OVERSHOOTING)),
    ):
        with pytest.raises(cm.InputError, match="turns back on its way, and this explorer looks"):
            cm.explore_overlap(diagram, RULE, contact_mm=20)


def test_a_die_that_never_comes_to_its_limit_may_move_as_it_likes() -> None:
    rule = cm.ClearanceRule(cm.beyond("die", 49), only_while=cm.within("mill", 0.65))
    figure = cm.explore_overlap(DIAGRAM, rule, contact_mm=53)
    set_margin(figure, 0)
    figure.values = {START: 0}  # at work in the middle of the mill's move
    assert "no move" not in figure.text
    figure.press("Widest move of the die")
    assert figure.values[B_m] == 130
