"""The columns of the animation: what is said and drawn of each design, from top to bottom."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import drawsvg as draw
import numpy as np

from cammotion.machine.arcs import Arc, arcs, unwrap
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import as_text
from cammotion.rules.checks import find_violations, idle_rules
from cammotion.rules.rule import Rule, Violation
from cammotion.views.animation import svg
from cammotion.views.animation.charts import (
    GAP_PX,
    LEFT_PX,
    WIDEST_LABEL_PX,
    Chart,
    LabelledCurve,
    acceleration_lane,
    draw_cursor,
    fits_at_end,
    name_angle,
    timing_lanes,
)
from cammotion.views.animation.dial import draw_dial
from cammotion.views.animation.dies import find_dies
from cammotion.views.animation.keyframes import trace_acceleration, trace_position
from cammotion.views.animation.scene import Scene
from cammotion.views.names import names_that_fit, printable, text_px, wrap

INNER_PX, HEADER_PX, TIMING_PX, ACCELERATION_PX = 406, 64, 110, 80
SIGN_PX = 26  # above the machine, where a broken rule is said: a machine has room for it nowhere
ALARMS, ALARM_PX = 3, 38  # so many are written below the machine
FEW = 3  # so many accelerations can be told apart, and named in a line
_BROKEN = "RULE BROKEN"


def _longest_first(arc: Arc) -> float:
    start, end = arc
    return round(start - end, 6)  # arcs that are alike stay in their order


@dataclass(frozen=True)
class Design:
    """A column of the animation: a timing diagram, its title and the rules that hold for it."""

    title: str
    diagram: TimingDiagram
    rules: tuple[Rule, ...]
    in_full: tuple[str, ...] = ()  # what its short names stand for

    @cached_property
    def violations(self) -> tuple[Violation, ...]:
        """Where its rules are broken."""
        return find_violations(self.diagram, self.rules)

    @property
    def accelerated(self) -> list[str]:
        """The motions whose acceleration is drawn: the dies, or all, or the hardest driven."""
        dies = [
            die.motion.name for dies in find_dies(self.diagram, self.rules).values() for die in dies
        ]
        names = dies or list(self.diagram.names)
        return names if len(names) <= FEW else [self._hardest]

    @property
    def _hardest(self) -> str:
        return max(self.diagram.names, key=self.diagram.peak_acceleration)

    @property
    def peaks(self) -> str:
        """The peak accelerations in words; of many motions only the largest."""
        names = self.diagram.names
        all_of_them = len(names) <= FEW
        peaks = [
            f"{name} {as_text(self.diagram.peak_acceleration(name), '.3g')}"
            for name in (names if all_of_them else [self._hardest])
        ]
        return f"{'' if all_of_them else 'largest '}peak acceleration: {', '.join(peaks)} m/s²"

    def headline(self, room: float) -> str:
        """Return the peaks in so many px: the largest first, where not all have room."""
        if text_px(self.peaks, svg.NORMAL) <= room:
            return self.peaks
        largest = as_text(self.diagram.peak_acceleration(self._hardest), ".3g")
        said, names = f"largest peak: {largest} m/s², ", self.diagram.names
        left = room - text_px(said, svg.NORMAL)
        called = names_that_fit(
            names, lambda these: all(text_px(name, svg.NORMAL) <= left for name in these)
        )
        return said + called[names.index(self._hardest)]

    @property
    def verdict(self) -> str:
        """Whether and where a rule is broken, the longest arc first; nothing without a rule.

        Of one that nothing can break it says why.
        """
        arcs_in_words = [
            f"{start:.4g} to {end % DEG_PER_TURN or DEG_PER_TURN:.4g}°"
            for start, end in sorted(unwrap(self._broken), key=_longest_first)
        ]
        if arcs_in_words:
            return f"{_BROKEN} from {' and from '.join(arcs_in_words)}"
        idle = " and ".join(self._idle.values())
        return f"{self._kept}: {idle}" if idle else self._kept

    def short_verdict(self, room: float) -> str:
        """Return the verdict in so many px: only how much and how many, where not all fits."""
        if text_px(self.verdict, svg.NORMAL, bold=bool(self._broken)) <= room:
            return self.verdict
        if self._broken:
            degrees = sum(end - start for start, end in self._broken)
            return f"{_BROKEN} over {degrees:.4g}° of the turn"
        return f"{self._kept} ({len(self._idle)} cannot be broken)"

    @property
    def _kept(self) -> str:
        return ("", "rule kept", "rules kept")[min(len(self.rules), 2)]

    @cached_property
    def _idle(self) -> dict[Rule, str]:
        return idle_rules(self.diagram, self.rules)

    @property
    def _broken(self) -> list[Arc]:
        """The arcs over which any rule is broken."""
        return arcs((broken.start_deg, broken.end_deg) for broken in self.violations)

    def state(self, angle_deg: float) -> str:
        """Return where each motion is at a cam angle, in words."""
        return ", ".join(
            f"{motion.name} {as_text(motion.offset_mm(angle_deg), '.3g')} mm from a stop"
            if motion.is_indexing
            else f"{motion.name} at {as_text(motion.position_mm(angle_deg), '.4g')} mm"
            for motion in self.diagram.motions
        )

    def describe(self) -> str:
        """Return the peaks, the verdict and every broken rule in words."""
        told = [self.peaks, self.verdict, *map(str, self.violations)]
        return "; ".join(filter(None, told))

    def broken_arcs(self) -> dict[str, list[Arc]]:
        """Return for each motion that collides the arcs over which it does.

        Of a turret and a die it is the die.
        """
        found: dict[str, list[Arc]] = {}
        for broken in self.violations:
            pair = broken.rule.motions
            movers = [name for name in pair if not self.diagram[name].is_indexing]
            for name in movers or pair:
                found.setdefault(name, []).append((broken.start_deg, broken.end_deg))
        return {name: arcs(these) for name, these in found.items()}


class Layout:
    """What the columns have in common, so that they can be compared across."""

    def __init__(
        self, designs: Iterable[Design], turn_s: float, magnify: float | None = None
    ) -> None:
        designs = list(designs)
        self.turn_s = turn_s
        self._scenes = [
            Scene(design.diagram, design.rules, INNER_PX, magnify) for design in designs
        ]
        self.scene = max(scene.height for scene in self._scenes)
        self.top = HEADER_PX + (SIGN_PX if any(design.violations for design in designs) else 0)
        self.alarm = ALARM_PX * max(len(design.violations[:ALARMS]) for design in designs)
        self.peak = max(_drawn_peak(d.diagram, n) for d in designs for n in d.accelerated)
        labels = [
            curve.label
            for design in designs
            for curve in (*self._displacements(design), *self._accelerations(design))
        ]
        widest = min(
            max(text_px(label, svg.NORMAL, bold=True) for label in labels), WIDEST_LABEL_PX
        )
        self.chart = INNER_PX - LEFT_PX - GAP_PX - widest
        self.timing = max(self._timing(design).whole_height for design in designs)
        self.acceleration_top = self.top + self.scene + self.alarm + self.timing + 10
        self.height = self.acceleration_top + self._acceleration(designs[0]).whole_height + 24

    def draw_column(self, design: Design, number: int) -> Any:
        """Draw a design from (0, 0) on."""
        column = draw.Group(data_design=number)
        column.append(self._header(design))
        broken_arcs = design.broken_arcs()
        scene = self._scenes[number].draw(self.turn_s, broken_arcs)
        column.append(svg.placed(0, self.top, scene))
        every = arcs(arc for these in broken_arcs.values() for arc in these)
        if every:
            column.append(self._alarm(design, every))
        timing, acceleration = self._timing(design), self._acceleration(design)
        timing_top = self.top + self.scene + self.alarm + 4
        column.append(svg.placed(0, timing_top, timing.draw(every)))
        column.append(svg.placed(0, self.acceleration_top, acceleration.draw()))
        column.append(name_angle(acceleration, self.acceleration_top))
        both = [(timing, timing_top), (acceleration, self.acceleration_top)]
        column.append(draw_cursor(both, self.turn_s))
        return column

    def _header(self, design: Design) -> Any:
        room = INNER_PX - 62
        header = svg.placed(
            0,
            0,
            svg.label(design.title, 0, 20, width=room, size=svg.LARGE, font_weight="bold"),
            svg.label(design.headline(room), 0, 39, width=room),
        )
        if design.verdict:
            alarmed: dict[str, Any] = (
                {"fill": svg.ALARM, "font_weight": "bold"} if design.violations else {}
            )
            header.append(svg.label(design.short_verdict(room), 0, 56, width=room, **alarmed))
        header.append(svg.placed(INNER_PX - 27, 24, draw_dial(self.turn_s)))
        name: dict[str, Any] = {"size": svg.SMALL, "text_anchor": "middle"}
        header.append(svg.label("camshaft", INNER_PX - 27, 57, **name))
        return header

    def _alarm(self, design: Design, every: list[Arc]) -> Any:
        """Draw the word above the machine, the frame round it, and what collides below."""
        alarm = draw.Group()
        machine = svg.seen_during(every, self.turn_s)
        frame = {"fill": "none", "stroke": svg.ALARM, "stroke_width": 4}
        machine.append(svg.box(0, self.top, INNER_PX, self.scene - 6, **frame))
        machine.append(svg.box(INNER_PX - 136, HEADER_PX, 136, SIGN_PX, fill=svg.ALARM))
        plain: dict[str, Any] = {"fill": "white", "stroke": "none", "font_weight": "bold"}
        word: dict[str, Any] = {"text_anchor": "middle", "size": svg.LARGE}
        machine.append(svg.label(_BROKEN, INNER_PX - 68, HEADER_PX + 19, **word, **plain))
        alarm.append(machine)
        for slot, broken in enumerate(design.violations[:ALARMS]):
            top = self.top + self.scene + slot * ALARM_PX
            seen = svg.seen_during(arcs([(broken.start_deg, broken.end_deg)]), self.turn_s)
            seen.append(svg.box(0, top, INNER_PX, ALARM_PX - 4, fill=svg.PALE_ALARM))
            alarm.append(seen)
            small: dict[str, Any] = {"size": svg.SMALL, "fill": svg.ALARM, "stroke": "none"}
            lines = wrap(printable(str(broken)), INNER_PX - 8, svg.SMALL, most=2)
            for line, y in zip(lines, (top + 13, top + 28), strict=False):
                alarm.append(svg.label(line, 4, y, width=INNER_PX - 8, **small))
        return alarm

    def _displacements(self, design: Design) -> list[LabelledCurve]:
        called = names_that_fit(design.diagram.names, lambda names: all(map(fits_at_end, names)))
        return [
            LabelledCurve(number, called[number], trace_position(motion))
            for number, motion in enumerate(design.diagram.motions)
        ]

    def _accelerations(self, design: Design) -> list[LabelledCurve]:
        diagram, names = design.diagram, design.accelerated
        peaks = [as_text(diagram.peak_acceleration(name), ".3g") for name in names]

        def said(called: Sequence[str]) -> list[str]:
            return [f"{peak} {name}" for peak, name in zip(peaks, called, strict=True)]

        called = names_that_fit(names, lambda these: all(map(fits_at_end, said(these))))
        told = said(called) if len(names) > 1 else [f"max {peaks[0]}"]
        return [
            LabelledCurve(
                diagram.names.index(name),
                label,
                trace_acceleration(diagram[name], diagram.rate_per_hour),
            )
            for name, label in zip(names, told, strict=True)
        ]

    def _timing(self, design: Design) -> Chart:
        lanes = timing_lanes(self._displacements(design), TIMING_PX)
        return Chart("displacement in mm", lanes, self.chart)

    def _acceleration(self, design: Design) -> Chart:
        lane = acceleration_lane(self._accelerations(design), self.peak, ACCELERATION_PX)
        of = " and ".join(design.accelerated)
        heading = f"acceleration of the {of} in m/s²"
        if text_px(heading, svg.SMALL) > INNER_PX - LEFT_PX:  # the unit is not what is cut
            heading = f"acceleration in m/s² of the {of}"
        return Chart(heading, [lane], self.chart)


def _drawn_peak(diagram: TimingDiagram, name: str) -> float:
    """Return what a scale has to hold: the peak, of an infinite one the largest value drawn."""
    peak = diagram.peak_acceleration(name)
    if math.isfinite(peak):
        return peak
    return float(np.abs(trace_acceleration(diagram[name], diagram.rate_per_hour).values).max())
