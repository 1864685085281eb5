"""The dial of the camshaft: its hand goes round once a turn."""

from typing import Any

import drawsvg as draw

from cammotion.views.animation import svg
from cammotion.views.animation.keyframes import CAMSHAFT


def draw_dial(turn_s: float) -> Any:
    """Draw the dial about (0, 0), 38 px wide; a turn lasts `turn_s` seconds."""
    dial = draw.Group()
    dial.append(draw.Circle(0, 0, 19, fill="white", stroke=svg.GREY, stroke_width=1.2))
    ticks = draw.Path(stroke=svg.GREY, stroke_width=1.5, fill="none")
    for x, y in ((0, -1), (1, 0), (0, 1), (-1, 0)):
        ticks.M(19 * x, 19 * y).L(14 * x, 14 * y)
    hand = svg.moving(CAMSHAFT, turn_s, "rotate", data={"part": "hand"})
    hand.append(draw.Path(fill=svg.INK).M(-2, 4).L(0, -16).L(2, 4).Z())
    dial.extend([ticks, hand, draw.Circle(0, 0, 3, fill=svg.INK)])
    dial.append_title("cam angle: one turn of the camshaft")
    return dial
