"""The magnifier under a turret: both edges of each die where they pass the rim, many times larger.

What decides there is small: a pocket that is 0.65 mm off is hardly a pixel in the drawing above.
"""

from collections.abc import Iterable, Sequence
from typing import Any

import drawsvg as draw

from cammotion.machine.arcs import Arc, complement
from cammotion.quantities import Quantity
from cammotion.views.animation import svg
from cammotion.views.animation.dies import Die
from cammotion.views.animation.keyframes import trace_position
from cammotion.views.animation.turret import Turret
from cammotion.views.plots import colour
from cammotion.views.scales import round_down

MAGNIFICATION = Quantity("magnification", "", example=10, low=1, high=50)
LENS_PX, _GAP_PX = 104.0, 6.0
_RIM = 0.6  # how far below a lens's top the rim is, as a share of its height
_NEAR = 0.9  # of what is seen above the rim: from there on a die is shown
_INWARDS = 0.12  # of a lens's width: so far from its middle, towards the other lens, the edge is
_BAR = 0.12  # of a lens's width, at most
_SIDES = {"left": -1, "right": 1}


class Magnifier:
    """Two lenses for each die of a turret, in rows that come right under its drawing."""

    names: Sequence[str] = ()  # the turret has drawn these motions

    def __init__(self, turret: Turret, times: float) -> None:
        self.turret, self.times, self.width = turret, times, turret.width
        self.lens_width = (self.width - _GAP_PX) / 2
        self.height = (LENS_PX + _GAP_PX) * len(turret.dies)
        self.scale = turret.scale * times
        self.half = turret.tool_width / 2
        self.large = turret.at_scale(self.scale, 2 * (self.half * self.scale + self.lens_width))
        self.turning = turret.turned_by(trace_position(turret.motion, times))

    def draw(self, turn_s: float, broken_arcs: dict[str, list[Arc]]) -> Any:
        """Draw it from (0, 0) to the right and down; `broken_arcs` are arcs by motion."""
        group = draw.Group()
        for row, (die, deg) in enumerate(zip(self.turret.dies, self.turret.degs, strict=True)):
            found = broken_arcs.get(die.motion.name, [])
            for column, side in enumerate(_SIDES):
                wheel = self.large.draw_wheel(self.turning, turn_s)
                upright = draw.Group([wheel], transform=f"rotate({svg.px(-deg, 4):g})")
                lens = self._lens(side, upright, self._die(die, turn_s, found))
                lens.extend([*self._cover(die, turn_s), *self._texts(die, side)])
                lens.extend(self._frame(found, turn_s))
                x, y = column * (self.lens_width + _GAP_PX), row * (LENS_PX + _GAP_PX)
                group.append(svg.placed(x, y, lens))
                group.append(self._mark(deg, side))
        return group

    def _edge_x(self, side: str) -> float:
        return self.lens_width * (0.5 - _INWARDS * _SIDES[side])

    def _lens(self, side: str, *about_centre: Any) -> Any:
        """Draw what is seen of parts about the turret's centre, of which the die stands upright."""
        # as with the panel, the id tells the size
        clip = draw.ClipPath(id=f"cm-lens-{self.lens_width:.0f}-{LENS_PX:.0f}")
        clip.append(svg.box(0, 0, self.lens_width, LENS_PX))
        seen = draw.Group(clip_path=clip, data_lens=side)
        seen.append(svg.box(0, 0, self.lens_width, LENS_PX, fill="#fafafa"))
        x = self._edge_x(side) - _SIDES[side] * self.half * self.scale
        y = _RIM * LENS_PX + self.turret.radius * self.scale
        seen.append(svg.placed(x, y, *about_centre))
        return seen

    def _die(self, die: Die, turn_s: float, broken_arcs: list[Arc]) -> Any:
        down = die.depth_by(trace_position(die.motion, self.times)).scaled(self.scale)
        data = {"part": "edge", "motion": die.number, "px-per-mm": svg.px(self.scale, 6)}
        body = svg.moving(down, turn_s, data=data)
        tip = -(self.turret.radius + die.gap) * self.scale
        high, half = self.turret.tool * self.scale, self.half * self.scale
        shape = {"fill": svg.pale(die.number), "stroke": colour(die.number), "stroke_width": 1.8}
        body.append(svg.box(-half, tip - high, 2 * half, high, **shape))
        if broken_arcs:
            red = svg.seen_during(broken_arcs, turn_s)
            alarm = {"fill": svg.PALE_ALARM, "stroke": svg.ALARM, "stroke_width": 1.8}
            red.append(svg.box(-half, tip - high, 2 * half, high, **alarm))
            body.append(red)
        return svg.placed(0, down.values[0], body)

    def _cover(self, die: Die, turn_s: float) -> Iterable[Any]:
        """Cover the lens while the die is far from the rim and the turret may rush by."""
        near = die.where_deeper(die.gap - _NEAR * _RIM * LENS_PX / self.scale)
        if away := complement(near):
            cover = svg.seen_during(away, turn_s)
            cover.append(svg.box(0, 0, self.lens_width, LENS_PX, fill="#f4f4f4"))
            said: dict[str, Any] = {"size": svg.SMALL, "fill": svg.GREY, "text_anchor": "middle"}
            for line, y in (("here the edge is seen", -2), ("when it is near the rim", 13)):
                at = self.lens_width / 2, LENS_PX / 2 + y
                cover.append(svg.label(line, *at, width=self.lens_width - 8, **said))
            yield cover

    def _texts(self, die: Die, side: str) -> Iterable[Any]:
        text = f"{side} edge, {self.times:g} : 1"
        bar = round_down(_BAR * self.lens_width / self.scale)
        outer, way = (8.0, 1) if side == "left" else (self.lens_width - 8, -1)
        low = LENS_PX - 8
        to: dict[str, Any] = {"size": svg.SMALL, "text_anchor": "start" if way > 0 else "end"}
        yield svg.label(text, outer, 15, font_weight="bold", **to)
        if len(self.turret.dies) > 1:
            bold: dict[str, Any] = {"fill": svg.dark(die.number), "font_weight": "bold"}
            yield svg.label(die.motion.name, outer, 29, width=self.lens_width - 16, **bold, **to)
        ends = draw.Path(stroke=svg.INK, stroke_width=1.5, fill="none")
        yield ends.M(svg.px(outer), low - 5).v(5).h(svg.px(way * bar * self.scale)).v(-5)
        yield svg.label(f"{bar:g} mm", outer, low - 8, **to)

    def _frame(self, broken_arcs: list[Arc], turn_s: float) -> Iterable[Any]:
        """Draw the lens's frame, which is red while the die collides."""
        at = (0.5, 0.5, self.lens_width - 1, LENS_PX - 1)
        yield svg.box(*at, fill="none", stroke=svg.GREY)
        if broken_arcs:
            red = svg.seen_during(broken_arcs, turn_s)
            red.append(svg.box(*at, fill="none", stroke=svg.ALARM, stroke_width=3.5))
            yield red

    def _mark(self, deg: float, side: str) -> Any:
        """Draw in the turret's drawing above what the lens shows."""
        wide, high = self.lens_width / self.times, LENS_PX / self.times
        edge = _SIDES[side] * self.half * self.turret.scale
        x = edge - self._edge_x(side) / self.times
        y = -self.turret.radius * self.turret.scale - _RIM * high
        mark = svg.box(x, y, wide, high, fill="none", stroke=svg.INK, stroke_width=0.8)
        turned = draw.Group([mark], transform=f"rotate({svg.px(deg, 4):g})")
        return svg.placed(self.width / 2, self.turret.centre - self.turret.height, turned)
