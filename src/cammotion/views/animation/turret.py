"""The drawing of a turret, an indexing motion, with the dies above its stops."""

import copy
import math
import operator
from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Any

import drawsvg as draw
import numpy as np

from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.rules.rule import Rule
from cammotion.views.animation import svg
from cammotion.views.animation.aside import ASIDE_PX
from cammotion.views.animation.dies import Die, find_dies
from cammotion.views.animation.keyframes import Trace, trace_position
from cammotion.views.animation.turret_texts import ABOVE_PX, CAPTION_PX, name_room, turret_texts
from cammotion.views.names import text_px
from cammotion.views.plots import colour

TURRET_PX, _BELOW_PX = 192, 6
_LAND = 0.22  # of gap and pocket together: what is left of the rim below a pocket
_STROKE_PX = 1.8
HALF_TURN = 180.0
_NAME_PX = 110  # at most so much is left free for the name of an outer die
_FEW = 3  # dies that have their names beside them; more have them at both sides
_ROW_PX = 15  # of a name there


class Turret:
    """A turret and its dies, in px about the turret's centre, up being negative."""

    def __init__(self, number: int, motion: Motion, dies: list[Die], width: float) -> None:
        self.number, self.motion, self.dies = number, motion, dies
        self.names: Sequence[str] = [motion.name, *(die.motion.name for die in dies)]
        self.width, self.panel = width, TURRET_PX if dies else 0.6 * TURRET_PX
        self.stops = motion.stops or 1
        self.step = 360 / self.stops
        self.degs = [(place - (len(dies) - 1) / 2) * self.step for place in range(len(dies))]
        true_pitch = abs(motion.pitch_mm)
        self.pocket = max((die.pocket for die in dies), default=0.3 * true_pitch)
        gap = max((die.gap for die in dies), default=0.0)
        self.unit = gap + self.pocket
        self.tool = self.pocket + 0.1 * self.unit
        self.guide = gap + self.tool + 0.05 * self.unit  # from the rim up to its lower edge
        self.above = self.guide + 0.22 * self.unit if dies else 0.2 * self.unit
        self.pitch = self._drawn_pitch(true_pitch)
        self.is_to_scale = self.pitch == true_pitch
        self.radius = self.stops * self.pitch / (2 * math.pi)
        self.inner = max(self.radius - self.pocket - _LAND * self.unit, 0.1 * self.radius)
        self.tool_width = 0.3 * self.pitch
        tolerance = min((die.tolerance_mm for die in dies), default=0.0)
        loose = self.tool_width + 2 * tolerance * self.pitch / true_pitch
        self.pocket_width = min(loose, 0.9 * self.pitch, 1.4 * self.radius)
        names = [text_px(die.motion.name, svg.NORMAL, bold=True) for die in self.dies]
        widest = max(names, default=0.0)
        self.scale, self.centre = self._fit(widest + 12)
        rooms = [name_room(self, deg) for deg in self.degs]
        self.is_crowded = len(dies) > _FEW or any(map(operator.gt, names, rooms))
        if self.is_crowded:
            self.panel = max(TURRET_PX, _ROW_PX * (len(dies) + 1) / 2 + ABOVE_PX + CAPTION_PX)
            self.scale, self.centre = self._fit(ASIDE_PX + 12, CAPTION_PX)
        self.height: float = self.panel + _BELOW_PX
        self.stroke_px = _STROKE_PX

    @classmethod
    def find(
        cls, diagram: TimingDiagram, rules: Iterable[Rule], left: list[str], width: float
    ) -> "list[Turret]":
        """Return a turret for each indexing motion that is left, with the dies of the rules."""
        dies = find_dies(diagram, rules)
        return [
            cls(diagram.names.index(name), diagram[name], above, width)
            for name, above in dies.items()
            if name in left
        ]

    def _drawn_pitch(self, true_pitch: float) -> float:
        """Return the pitch, unless the pockets would not fit into the turret, or not be seen."""
        high = self.above + self.pocket + _LAND * self.unit
        least = max(0.3 * high, 4 * math.pi * self.pocket / self.stops)
        return max(min(true_pitch, 1.2 * high), least) if self.dies else true_pitch

    def _fit(self, name_px: float, below_px: float = 0.0) -> tuple[float, float]:
        """Return px per mm, and how far below the panel's top the centre is.

        With several dies it leaves `name_px` free at either side; `below_px` are free below it.
        """
        angles = np.radians(self.degs or [0.0])
        outer = self.radius + self.above
        is_small = self.radius <= max(self.above, 1.2 * self.pitch)
        lowest = -self.radius if is_small else min(self.inner * np.cos(angles))
        bottom = min(lowest, *(outer * np.cos(angles) - self.tool_width))
        top = max(outer * np.cos(angles) + 0.6 * self.tool_width * np.abs(np.sin(angles)))
        across = 2 * max(outer * np.abs(np.sin(angles))) + 1.5 * self.tool_width
        least = across if self.dies else min(2.4 * self.pitch, 2.2 * self.radius)
        most = name_px if below_px else min(name_px, _NAME_PX)
        beside = 2 * most if len(self.dies) > 1 else 0
        fits = (self.width - beside) / max(across, least)
        scale = min((self.panel - 8 - below_px) / (top - bottom), fits)
        spare = self.panel - 8 - below_px - (top - bottom) * scale if below_px else 0.0
        return float(scale), float(4 + top * scale + spare / 2)

    @cached_property
    def turning(self) -> Trace:
        """The angle in deg to which the turret has turned, away from a stop under the dies."""
        return self.turned_by(trace_position(self.motion))

    def turned_by(self, position: Trace) -> Trace:
        """Return the angle to which it has turned by a trace of its position."""
        per_mm = 360 / (self.stops * abs(self.motion.pitch_mm))
        return position.scaled(per_mm, self.degs[0] if self.degs else 0.0)

    @property
    def seen(self) -> float:
        """The angle in deg from the top to where the rim leaves the panel."""
        half = self.width / 2 / (self.radius * self.scale)
        is_whole = self.centre < self.panel or half >= 1
        return HALF_TURN if is_whole else math.degrees(math.asin(half))

    def draw(self, turn_s: float, broken_arcs: dict[str, list[Arc]]) -> Any:
        """Draw it all in a panel from (0, 0) on; `broken_arcs` are arcs by motion."""
        # the id tells the size: in a page with several drawings, one id always means the same
        clip = draw.ClipPath(id=f"cm-panel-{self.width:.0f}-{self.panel:.0f}")
        clip.append(svg.box(0, 0, self.width, self.panel))
        panel = draw.Group(clip_path=clip)
        panel.append(svg.box(0.5, 0.5, self.width - 1, self.panel - 1, fill="#fafafa"))
        about_centre = svg.placed(self.width / 2, self.centre)
        about_centre.append(self.draw_wheel(self.turning, turn_s))
        for die, deg in zip(self.dies, self.degs, strict=True):
            about_centre.append(self._die(die, deg, turn_s, broken_arcs.get(die.motion.name, [])))
        if self.turning.values.any():
            about_centre.append(self.draw_arrow())
        panel.append(about_centre)
        panel.extend(turret_texts(self))
        panel.append(
            svg.box(0.5, 0.5, self.width - 1, self.panel - 1, fill="none", stroke="#c8c8c8")
        )
        return panel

    def at_scale(self, px_per_mm: float, width: float) -> "Turret":
        """Return the turret for another drawing, of which it fills a part `width` px wide."""
        other = copy.copy(self)
        other.scale, other.width = px_per_mm, width
        other.centre, other.panel = self.radius * px_per_mm, 0.0  # out of sight
        return other

    def draw_wheel(self, turning: Trace, turn_s: float) -> Any:
        """Draw the rim about the turret's centre, turning by an angle in deg."""
        turret = draw.Group(transform=f"rotate({svg.px(turning.values[0], 4):g})")
        data = {"part": "turret", "motion": self.number}
        wheel = svg.moving(turning, turn_s, "rotate", data=data)
        wheel.append(self._rim())
        turret.append(wheel)
        return turret

    def _rim(self) -> Any:
        """Draw the rim with a pocket at each stop that comes into sight."""
        swing = self.turning.values
        reach = self.seen + self.step
        first = math.floor((-reach - swing.max()) / self.step)
        last = math.ceil((reach - swing.min()) / self.step)
        is_whole = last - first + 1 >= self.stops
        if is_whole:
            first, last = 0, self.stops - 1
        path = draw.Path(
            fill=svg.pale(self.number),
            stroke=colour(self.number),
            stroke_width=self.stroke_px,
            stroke_linejoin="round",
        )
        half = math.degrees(math.asin(self.pocket_width / 2 / self.radius))
        start = first * self.step - (half if is_whole else self.step / 2)
        path.M(*self.at(self.radius, start))
        for stop in range(first, last + 1):
            deg = stop * self.step
            if not is_whole or stop > first:
                self._arc(path, self.radius, start, deg - half)
            self._pocket(path, deg)
            start = deg + half
        if is_whole:
            self._arc(path, self.radius, start, 360 - half)
            path.Z()
            whole = draw.Group()
            whole.append(path)
            hub = {"fill": "#fafafa", "stroke": colour(self.number), "stroke_width": 1}
            whole.append(draw.Circle(0, 0, svg.px(0.12 * self.radius * self.scale), **hub))
            return whole
        end = last * self.step + self.step / 2
        self._arc(path, self.radius, start, end)
        path.L(*self.at(self.inner, end))
        self._arc(path, self.inner, end, first * self.step - self.step / 2)
        return path.Z()

    def _pocket(self, path: Any, deg: float) -> None:
        half, bottom = self.pocket_width / 2, max(self.radius - self.pocket, 0.15 * self.radius)
        top = math.sqrt(self.radius**2 - half**2)
        for x, up in ((-half, bottom), (half, bottom), (half, top)):
            path.L(*self.at(math.hypot(x, up), deg + math.degrees(math.atan2(x, up))))

    def _arc(self, path: Any, radius: float, start: float, end: float) -> None:
        r = svg.px(radius * self.scale)
        path.A(r, r, 0, int(abs(end - start) > HALF_TURN), int(end > start), *self.at(radius, end))

    def at(self, radius: float, deg: float) -> tuple[float, float]:
        """Return the place in px at so many mm from the centre and deg from the top."""
        way, angle = radius * self.scale, math.radians(deg)
        return svg.px(way * math.sin(angle)), svg.px(-way * math.cos(angle))

    def _die(self, die: Die, deg: float, turn_s: float, broken_arcs: list[Arc]) -> Any:
        """Draw a die that slides in its guide towards the centre."""
        s = self.scale
        half, tool = self.tool_width / 2 * s, self.tool * s
        tip = -(self.radius + die.gap) * s
        shape = {
            "fill": svg.pale(die.number),
            "stroke": colour(die.number),
            "stroke_width": _STROKE_PX,
        }
        depth = die.depth.scaled(s)
        body = svg.moving(
            depth,
            turn_s,
            data={"part": "body", "motion": die.number, "px-per-mm": svg.px(s, 6)},
        )
        ram = (die.travel + (0.4 * self.unit if self.is_crowded else self.above + self.unit)) * s
        body.append(svg.box(-0.3 * half, tip - tool - ram, 0.6 * half, ram, **shape))
        body.append(svg.box(-half, tip - tool, 2 * half, tool, **shape))
        body.extend(svg.alarm(broken_arcs, turn_s, (-half, tip - tool, 2 * half, tool)))
        placed = svg.placed(0, depth.values[0], body)
        guide = -(self.radius + self.guide) * s
        height = 0.17 * self.unit * s
        group = draw.Group(transform=f"rotate({svg.px(deg, 4):g})")
        group.append(placed)
        for side in (-1, 1):  # two jaws, between which the ram is seen to slide
            left = side * 0.3 * half - (0.7 * half if side < 0 else 0)
            group.append(
                svg.box(left, guide - height, 0.7 * half, height, fill="#d0d0d0", stroke="#555555")
            )
        return group

    def draw_arrow(self) -> Any:
        """Draw which way the turret turns."""
        way = 1 if self.motion.pitch_mm > 0 else -1
        outside = self.radius + 0.13 * self.unit
        free = min(self.seen, 75)
        ends = (-0.78 * free, -0.42 * free)
        if self.dies:
            wide = math.degrees(self.pitch / self.radius)
            ends = (self.degs[0] - 0.8 * wide, self.degs[0] - 0.45 * wide)
        start, end = ends[::way]
        style = {"stroke": colour(self.number), "stroke_width": 2.5}
        line = draw.Path(**style, fill="none").M(*self.at(outside, start))
        self._arc(line, outside, start, end)
        head = draw.Path(fill=colour(self.number))
        tip = math.degrees(9 / (outside * self.scale)) * way
        five = 5 / self.scale
        head.M(*self.at(outside + five, end)).L(*self.at(outside, end + tip))
        head.L(*self.at(outside - five, end)).Z()
        arrow = draw.Group()
        arrow.extend([line, head])
        return arrow
