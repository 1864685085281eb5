"""The explorer of the overlap: how far one motion may go while the other is on its way."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import ipywidgets
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from cammotion.limits.widest import widest_move, with_angle
from cammotion.machine.clearance import (
    ClearanceRule,
    Violation,
    as_rules,
    find_violations,
    smallest_clearance,
)
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity
from cammotion.views.live import Explorer, LiveFigure, NumberControl
from cammotion.views.movement import curve_angles, movement
from cammotion.views.plots import REFERENCE_STYLE, style_axes, style_line, write
from cammotion.views.scales import as_text, has_ratio
from cammotion.views.timing_plots import (
    COLLISION,
    clearance_path,
    describe_offset,
    forbidden_region,
    place_forbidden_region,
)

_MOST_MARGIN_MM = 5
_BROKEN: dict[str, Any] = {"color": COLLISION["edgecolor"], "linewidth": 6, "alpha": 0.8}


class OverlapExplorer(Explorer):
    """The two motions of a clearance rule, to be changed; made by `explore_overlap`.

    In the words of the running example: the die may be deep only while the mill is near a stop. The
    die keeps the length of its dwell at the bottom, the mill the middle of its move.
    """

    def __init__(self, diagram: TimingDiagram, rule: ClearanceRule, contact_mm: float) -> None:
        self.reference, self._rule, self._contact_mm = diagram, rule, contact_mm
        self._die, self._mill = diagram[rule.when.motion], diagram[rule.only_while.motion]
        self._refusal = ""
        (down, up), (index,) = self._die.moves, self._mill.moves
        die, mill = self._die.name, self._mill.name
        most = (DEG_PER_TURN - (up.from_deg - down.to_deg)) / 2
        margin = contact_mm - rule.when.limit_mm
        start = down.from_deg % DEG_PER_TURN
        self.angle = NumberControl(f"{die}: angle Bm, deg", down.angle_deg, 20, most, 0.5)
        self.start = NumberControl(f"{die}: start, deg", start, 0, DEG_PER_TURN, 0.5)
        self.mill_angle = NumberControl(f"{mill}: angle, deg", index.angle_deg, 40, 240, 1)
        self.margin = NumberControl("margin, mm", margin, 0, _MOST_MARGIN_MM, 0.1)
        widen = ipywidgets.Button(description=f"Widest move of the {die}", layout={"width": "19em"})
        widen.on_click(lambda _: self.widen())
        figure = Figure(figsize=(9.4, 4.2), dpi=100, facecolor="white")
        figure.subplots_adjust(left=0.07, right=0.99, bottom=0.13, top=0.95, wspace=0.2)
        self._time, self._map = figure.subplots(1, 2, width_ratios=[3, 2])
        moving = [*self._prepare_time(self._time), *self._prepare_map(self._map)]
        live = LiveFigure(figure, moving, layout={"max_width": "100%", "width": "940px"})
        super().__init__([self.angle, self.start, self.mill_angle, self.margin], [widen], live)

    @property
    def rule(self) -> ClearanceRule:
        """The clearance rule, with the margin that the controls show."""
        limit = self._contact_mm - self.margin.value
        return replace(self._rule, when=replace(self._rule.when, limit_mm=limit))

    @property
    def diagram(self) -> TimingDiagram:
        """The timing diagram that the controls show."""
        die = with_angle(self._die, self.angle.value)
        die = die.shifted(self.start.value - die.start_deg)
        mill = with_angle(self._mill, self.mill_angle.value)
        return self.reference.with_motion(mill).with_motion(die)

    def widen(self) -> None:
        """Give the die the widest move that keeps the rule, about its dwell where it now is."""
        try:
            widest = widest_move(self.diagram, self._die.name, self.rule)
        except InputError as none:
            self._refusal = str(none)
            self.update()
        else:
            self.start.value, self.angle.value = widest.start_deg, widest.angle_deg

    def follow(self) -> str:
        """Draw the chosen design; return its peaks, and the collision or the clearance left."""
        diagram, rule = self.diagram, self.rule
        violations = find_violations(diagram, rule)
        broken = [np.linspace(found.start_deg, found.end_deg, 25) for found in violations]
        for motion, line, mark in zip(
            self._motions(diagram), self._lines, self._marks, strict=True
        ):
            angles = curve_angles(motion)
            line.set_data(angles, movement(motion, angles))
            inside = [arc % DEG_PER_TURN for arc in broken]
            mark.set_data(_joined(inside), _joined([movement(motion, arc) for arc in inside]))
        self._path.set_data(*clearance_path(diagram, rule))
        offsets = [_joined([m.offset_mm(arc) for arc in broken]) for m in self._motions(diagram)]
        self._broken_path.set_data(*offsets)
        place_forbidden_region(self._region, rule, self._map)
        peaks = [self._describe(diagram, motion) for motion in reversed(self._motions(diagram))]
        verdict, self._refusal = self._refusal or self._judge(diagram, violations), ""
        return "\n".join([*peaks, verdict])

    def _motions(self, diagram: TimingDiagram) -> list[Motion]:
        return [diagram[self._mill.name], diagram[self._die.name]]

    def _describe(self, diagram: TimingDiagram, motion: Motion) -> str:
        move = motion.moves[0]
        peak, before = (d.peak_acceleration(motion.name) for d in (diagram, self.reference))
        compared = f", before {as_text(before, '.3f')}"
        if has_ratio(peak, before):
            compared = f" = {peak / before:.3g} × {before:.3f}"
        start, end = move.from_deg % DEG_PER_TURN, move.to_deg % DEG_PER_TURN
        return (
            f"{motion.name}: {move.angle_deg:.5g} deg, from {start:.5g} to {end:.5g} deg, "
            f"a_max = {as_text(peak, '.3f')} m/s²{compared}"
        )

    def _judge(self, diagram: TimingDiagram, violations: Sequence[Violation]) -> str:
        if violations:
            return f"COLLISION: {max(violations, key=lambda found: found.excess_mm)}"
        left = smallest_clearance(diagram, self.rule)
        where = "" if left.angle_deg is None else f", at {left.angle_deg:.4g} deg"
        return f"No collision. The smallest clearance is {max(left.clearance_mm, 0):.3g} mm{where}."

    def _prepare_time(self, ax: Axes) -> list[Any]:
        """Draw what stays of the timing diagram; return what will move."""
        style_axes(ax, "cam angle in deg", "movement in mm")
        ax.set_xlim(0, DEG_PER_TURN)
        ax.set_xticks(range(0, DEG_PER_TURN + 1, 60))
        motions = self._motions(self.reference)
        highest = max(motion.range_mm[1] for motion in motions)
        ax.set_ylim(-0.05 * highest, 1.12 * highest)
        for motion in motions:
            angles = curve_angles(motion)
            ax.plot(angles, movement(motion, angles), **REFERENCE_STYLE | {"linewidth": 1.2})
        self._lines = [style_line(ax.plot([], [])[0], number) for number in range(len(motions))]
        self._marks = [ax.plot([], [], **_BROKEN)[0] for _ in motions]
        labels = [*(motion.name for motion in motions), "as it was", "collision"]
        handles = [*self._lines, ax.lines[0], self._marks[0]]
        ax.legend(handles, labels, loc="center right", bbox_to_anchor=(1, 0.73), fontsize=10)
        return [*self._lines, *self._marks]

    def _prepare_map(self, ax: Axes) -> list[Any]:
        """Draw what stays of the clearance map; return what will move."""
        names = {"": self.reference}
        style_axes(
            ax,
            describe_offset(self._rule.only_while, names),
            describe_offset(self._rule.when, names),
        )
        ax.set_xlim(0, 8 * self._rule.only_while.limit_mm)
        ax.set_ylim(0, 1.1 * self._die.range_mm[1])
        self._region = forbidden_region(self._rule, ax)
        ax.add_patch(self._region)
        self._path = style_line(ax.plot([], [])[0], 1)
        self._broken_path = ax.plot([], [], **_BROKEN)[0]
        middle = 4.3 * self._rule.only_while.limit_mm, 0.8 * self._die.range_mm[1]
        word = write(ax, "forbidden", middle, COLLISION["edgecolor"])
        return [self._region, word, self._path, self._broken_path]


def explore_overlap(
    diagram: TimingDiagram, rule: ClearanceRule, *, contact_mm: float
) -> OverlapExplorer:
    """Return an explorer of the two motions of a clearance rule: angle, start, and margin.

    `rule.when` is about a motion with one rise and one return, which is the one to be `beyond`;
    `rule.only_while` about an indexing motion with one move, `within`. `contact_mm` is where the
    first would touch, in mm; the margin is what the rule stays short of it. Raises InputError for
    a rule of another kind, and for a `contact_mm` that the rule lets the motion pass.

    >>> import cammotion as cm
    >>> explorer = explore_overlap(cm.EXAMPLE.diagram, cm.EXAMPLE.rule, contact_mm=20)
    >>> explorer.widen()
    >>> print(explorer.text.splitlines()[0])
    die: 124.84 deg, from 80.163 to 205 deg, a_max = 0.806 m/s² = 0.194 × 4.154
    """
    as_rules(diagram, rule)
    contact = Quantity("position of contact", "mm", example=20).number(contact_mm)
    die, mill = diagram[rule.when.motion], diagram[rule.only_while.motion]
    shapes = [segment.kind for segment in die.moves] == ["rise", "return"] and mill.is_indexing
    sides = rule.when.is_beyond and not rule.only_while.is_beyond
    if not (shapes and sides and len(mill.moves) == 1 and rule.when.limit_mm <= contact):
        raise InputError(
            f"The rule '{rule}' cannot be explored: give one in which a motion that rises and "
            "returns once may be beyond a limit, short of contact_mm, only while an indexing "
            "motion with one move is within another."
        )
    return OverlapExplorer(diagram, rule, contact)


def _joined(parts: Sequence[Floats]) -> Floats:
    """Return the parts in one, with a break (nan) after each, so that no line joins them."""
    return np.concatenate([np.empty(0), *(np.append(part, np.nan) for part in parts)])
