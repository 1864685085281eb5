"""The drawing of a slide, a block that goes up and down: for every motion of no other kind."""

import math
from collections.abc import Iterable, Sequence
from typing import Any

import drawsvg as draw

from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.rules.rule import Rule
from cammotion.views.animation import svg
from cammotion.views.animation.keyframes import trace_position
from cammotion.views.names import names_that_fit, wrap
from cammotion.views.plots import colour
from cammotion.views.scales import more_digits, short_number

SLIDE_PX = 124
IN_ROW = 5
_TOP, _TRACK = 16.0, 64.0
_LINE, _LINES = 13, 3  # of a name


class Slide:
    """A block on a rail beside a scale in mm."""

    def __init__(self, number: int, motion: Motion, width: float, name: str) -> None:
        self.number, self.motion, self.width = number, motion, width
        self.names: Sequence[str] = [motion.name]
        self._name_lines = _lines(name, width, most=_LINES)
        self.height: float = SLIDE_PX + _LINE * max(len(self._name_lines) - 2, 0)

    @classmethod
    def find(
        cls,
        diagram: TimingDiagram,
        rules: Iterable[Rule],  # noqa: ARG003 - a slide needs none
        left: list[str],
        width: float,
    ) -> "list[Slide]":
        """Return a slide for each motion that is left, in rows of equal length."""
        rows = math.ceil(len(left) / IN_ROW)
        each = width / math.ceil(len(left) / rows) if rows else width

        def fit(names: Sequence[str]) -> bool:
            return all(len(_lines(name, each)) <= _LINES for name in names)

        called = zip(left, names_that_fit(left, fit), strict=True)
        return [
            cls(diagram.names.index(name), diagram[name], each, short) for name, short in called
        ]

    def draw(self, turn_s: float, broken_arcs: dict[str, list[Arc]]) -> Any:
        """Draw it from (0, 0) to the right and down; `broken_arcs` are arcs by motion."""
        low, high = self.motion.range_mm
        middle, bottom = max(self.width / 2 + 12, 64), _TOP + _TRACK
        scale = _TRACK / ((high - low) or 1)
        group = draw.Group()
        group.extend(self._scale(low, high, middle - 18))
        rail = {"fill": "#e8e8e8", "stroke": "#bbbbbb", "stroke_width": 1}
        group.append(svg.box(middle - 3, _TOP - 8, 6, _TRACK + 16, **rail))
        height = trace_position(self.motion).scaled(-scale, bottom + low * scale)
        data = {"part": "body", "motion": self.number, "px-per-mm": svg.px(scale, 6)}
        body = svg.moving(height, turn_s, data=data)
        shape = {"fill": svg.pale(self.number), "stroke": colour(self.number), "stroke_width": 2}
        body.append(svg.box(-14, -7, 28, 14, **shape))
        body.append(svg.box(-21, -0.75, 7, 1.5, fill=svg.INK))  # points at the scale
        body.extend(svg.alarm(broken_arcs.get(self.motion.name, []), turn_s, (-14, -7, 28, 14)))
        group.append(svg.placed(middle, height.values[0], body))
        bold: dict[str, Any] = {"fill": svg.dark(self.number), "font_weight": "bold"}
        for number, line in enumerate(self._name_lines):
            at, room = (self.width / 2, bottom + 22 + _LINE * number), self.width - 4
            group.append(
                svg.label(line, *at, width=room, size=svg.SMALL, text_anchor="middle", **bold)
            )
        return group

    def _scale(self, low: float, high: float, right: float) -> Iterable[Any]:
        """Draw the ticks, and the numbers at both ends; one number where nothing moves."""
        ticks = draw.Path(stroke=svg.GREY, stroke_width=1.2, fill="none")
        for share in (0, 0.25, 0.5, 0.75, 1):
            length = 4 + 4 * (share % 0.5 == 0)
            ticks.M(svg.px(right), svg.px(_TOP + share * _TRACK)).h(-length)
        yield ticks.M(svg.px(right), _TOP).v(_TRACK)
        more = more_digits(low, high)
        for value, y in ((high, _TOP), (low, _TOP + _TRACK))[: 2 if high > low else 1]:
            text, at = short_number(value, more), (right - 11, y + 4)
            yield svg.label(text, *at, text_anchor="end", size=svg.SMALL)


def _lines(name: str, width: float, most: int | None = None) -> list[str]:
    """Return the lines of a name below a slide so wide, at most so many."""
    return wrap(name, width - 6, svg.SMALL, bold=True, most=most)
