"""What is written at a turret: its stops, a scale, and the names of its dies."""

import math
from collections.abc import Iterable
from typing import Any, Protocol

import drawsvg as draw

from cammotion.machine.motions import Motion
from cammotion.quantities import plural
from cammotion.views.animation import svg
from cammotion.views.animation.aside import Named, names_aside
from cammotion.views.animation.dies import Die
from cammotion.views.names import text_px
from cammotion.views.scales import round_down

CAPTION_PX = 44  # for what is said of the turret, below names at its sides
ABOVE_PX = 36  # above them, where the dies are guided


class Placed(Protocol):
    """What has to be known of a turret and its place: lengths in mm, `scale` in px per mm."""

    number: int
    motion: Motion
    stops: int
    step: float
    dies: list[Die]
    degs: list[float]
    radius: float
    guide: float
    unit: float
    tool_width: float
    width: float
    panel: float
    scale: float
    centre: float
    is_to_scale: bool
    is_crowded: bool

    def at(self, radius: float, deg: float) -> tuple[float, float]:
        """Return the place in px at so many mm from the centre and deg from the top."""


def turret_texts(turret: Placed) -> Iterable[Any]:
    """Yield all texts, and the bar of the scale, from the panel's corner on."""
    note = "" if turret.is_to_scale else ", pitch not to scale"
    stops = plural(turret.stops, "stop")
    bar = round_down(0.25 * turret.width / turret.scale)
    right, low = turret.width - 10, turret.panel - 10
    room = turret.width - bar * turret.scale - 40
    style: dict[str, Any] = {"fill": svg.dark(turret.number), "font_weight": "bold"}
    said = f"{turret.motion.name}: {stops}{note}"
    fits = text_px(said, svg.NORMAL, bold=True) <= room
    lines = [said] if fits else [f"{stops}{note}", turret.motion.name]  # from below
    for number, line in enumerate(lines):
        yield svg.label(line, 8, low - 15 * number, width=room, **style)
    left = right - bar * turret.scale
    ends = draw.Path(stroke=svg.INK, stroke_width=1.5, fill="none")
    ends.M(svg.px(left), low - 5).v(5).H(svg.px(right)).v(-5)
    yield ends
    yield svg.label(f"{bar:g} mm", right, low - 7, text_anchor="end", size=svg.SMALL)
    yield from _names_aside(turret) if turret.is_crowded else _names_beside(turret)


def name_room(turret: Placed, deg: float) -> float:
    """Return how wide a name beside its die may be, in px, up to its neighbour and the edge."""
    x, _ = _beside(turret, deg)
    room = x if deg < 0 else turret.width - x
    return min(_outside(turret) * math.radians(turret.step) * turret.scale, room) - 6


def _names_aside(turret: Placed) -> Iterable[Any]:
    """Yield the names at both sides, each with a line to where its die is guided."""
    named = []
    for die, deg in zip(turret.dies, turret.degs, strict=True):
        x, y = turret.at(turret.radius + turret.guide, deg)
        named.append(Named(die.number, die.motion.name, x + turret.width / 2, y + turret.centre))
    return names_aside(named, turret.width, (ABOVE_PX, turret.panel - CAPTION_PX))


def _names_beside(turret: Placed) -> Iterable[Any]:
    """Yield each name beside its guide: to the left of one on the left."""
    for die, deg in zip(turret.dies, turret.degs, strict=True):
        x, y = _beside(turret, deg)
        yield svg.label(
            die.motion.name,
            x,
            y + turret.centre + 4,
            width=name_room(turret, deg),
            text_anchor="end" if deg < 0 else "start",
            fill=svg.dark(die.number),
            font_weight="bold",
        )


def _beside(turret: Placed, deg: float) -> tuple[float, float]:
    """Return where a name begins, in px from the panel's left and from the turret's centre."""
    x, y = turret.at(_outside(turret), deg)
    side, angle = (-1 if deg < 0 else 1), math.radians(abs(deg))
    beside = turret.tool_width * math.cos(angle) / 2 + 0.1 * turret.unit * math.sin(angle)
    return x + turret.width / 2 + side * (beside * turret.scale + 6), y


def _outside(turret: Placed) -> float:
    return turret.radius + turret.guide + 0.08 * turret.unit
