"""The machine of a timing diagram: turrets with the dies above them, and slides for the rest."""

import math
from collections.abc import Iterable
from typing import Any

import drawsvg as draw

from cammotion.machine.arcs import Arc
from cammotion.machine.clearance import ClearanceRule
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.views.animation import svg
from cammotion.views.animation.dies import find_dies
from cammotion.views.animation.keyframes import trace_position
from cammotion.views.animation.turret import Turret, panel_height
from cammotion.views.plots import colour

SLIDE_PX = 124
SLIDES_IN_ROW = 5


def scene_height(diagram: TimingDiagram, rules: Iterable[ClearanceRule]) -> float:
    """Return how high the machine's drawing is, in px."""
    dies = find_dies(diagram, rules)
    slides = len(diagram.motions) - len(dies) - sum(map(len, dies.values()))
    turrets = sum(panel_height(above) + 6 for above in dies.values())
    return turrets + math.ceil(slides / SLIDES_IN_ROW) * SLIDE_PX


def draw_scene(
    diagram: TimingDiagram,
    rules: Iterable[ClearanceRule],
    collisions: dict[str, list[Arc]],
    width: float,
    turn_s: float,
) -> Any:
    """Draw the machine from (0, 0) to the right and down; `collisions` are arcs by motion."""
    scene, top = draw.Group(), 0.0
    dies = find_dies(diagram, rules)
    for name, above in dies.items():
        number = diagram.names.index(name)
        turret = Turret(number, diagram[name], above, width, turn_s)
        scene.append(svg.placed(0, top, turret.draw(collisions)))
        top += turret.height + 6
    drawn = {*dies, *(die.motion.name for above in dies.values() for die in above)}
    slides = [(n, m) for n, m in enumerate(diagram.motions) if m.name not in drawn]
    rows = math.ceil(len(slides) / SLIDES_IN_ROW)
    per_row = math.ceil(len(slides) / rows) if rows else 1
    for place, (number, motion) in enumerate(slides):
        row, column = divmod(place, per_row)
        slide = _draw_slide(
            number, motion, width / per_row, turn_s, collisions.get(motion.name, [])
        )
        scene.append(svg.placed(column * width / per_row, top + row * SLIDE_PX, slide))
    return scene


def _draw_slide(
    number: int, motion: Motion, width: float, turn_s: float, collisions: list[Arc]
) -> Any:
    """Draw a block that goes up and down along a scale in mm."""
    low, high = motion.range_mm
    top, track, middle = 16.0, 64.0, max(width / 2 + 12, 64)
    scale = track / ((high - low) or 1)
    group = draw.Group()
    scale_line = draw.Path(stroke=svg.GREY, stroke_width=1.2, fill="none")
    for share in (0, 0.25, 0.5, 0.75, 1):
        scale_line.M(svg.px(middle - 18), svg.px(top + share * track)).h(
            -(4 + 4 * (share % 0.5 == 0))
        )
    scale_line.M(svg.px(middle - 18), top).v(track)
    group.append(scale_line)
    for value, y in ((high, top), (low, top + track))[: 2 if high > low else 1]:
        text = svg.label(
            svg.short_number(value), middle - 29, y + 4, text_anchor="end", size=svg.SMALL
        )
        group.append(text)
    rail = {"fill": "#e8e8e8", "stroke": "#bbbbbb", "stroke_width": 1}
    group.append(svg.box(middle - 3, top - 8, 6, track + 16, **rail))
    position = trace_position(motion)
    height = position.scaled(-scale, top + track + low * scale)
    body = svg.moving(
        height, turn_s, data={"part": "body", "motion": number, "px-per-mm": svg.px(scale, 6)}
    )
    shape = {"fill": svg.pale(number), "stroke": colour(number), "stroke_width": 2}
    body.append(svg.box(-14, -7, 28, 14, **shape))
    body.append(svg.box(-21, -0.75, 7, 1.5, fill=svg.INK))  # points at the scale
    if collisions:
        alarm = svg.seen_during(collisions, turn_s)
        alarm.append(svg.alarm_area(-14, -7, 28, 14))
        alarm.append(svg.box(-14, -7, 28, 14, fill="none", stroke=svg.ALARM, stroke_width=3.5))
        body.append(alarm)
    group.append(svg.placed(middle, height.values[0], body))
    style = {"text_anchor": "middle", "fill": svg.dark(number), "font_weight": "bold"}
    lines = svg.wrapped(motion.name, width - 6, svg.SMALL, bold=True)
    for line, y in zip(lines, (top + track + 22, top + track + 35), strict=False):
        group.append(svg.label(line, width / 2, y, width=width - 4, size=svg.SMALL, **style))
    return group
