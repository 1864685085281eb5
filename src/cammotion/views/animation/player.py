"""The player of an animation in the lab: play, pause, scrub and slow down, by mouse or keyboard."""

import math
from pathlib import Path
from typing import Any

import anywidget
import traitlets

from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Quantity
from cammotion.views import paper

SHOWN_ANGLE = Quantity("cam angle", "deg", example=180, high=DEG_PER_TURN, low_included=True)
SHORTEST_S, LONGEST_S = 1.0, 40.0  # how long a turn may last on the screen
_SPEEDS = [step * 10.0**decade for decade in range(-6, 4) for step in (1, 2, 5)]

MODULE = Path(__file__).with_name("player.js")
LOOK = Path(__file__).with_name("player.css").read_text(encoding="utf-8")


class Player(anywidget.AnyWidget):
    """Shows an SVG with a clock and drives the clock; made by `MovingPicture.player`.

    `angle_deg` is the cam angle: set it to move the machine there. It follows the page whenever
    the player is paused or scrubbed.
    """

    _esm = MODULE
    _css = LOOK + paper.RULE
    svg = traitlets.Unicode().tag(sync=True)
    turn_s = traitlets.Float().tag(sync=True)
    cycle_s = traitlets.Float().tag(sync=True)
    speeds = traitlets.List(traitlets.Float()).tag(sync=True)
    speed = traitlets.Float().tag(sync=True)
    angle_deg: Any = traitlets.TraitType(0.0).tag(sync=True)  # checked below, in our own words

    def __init__(self, svg: str, *, turn_s: float, cycle_s: float, reader: dict[str, Any]) -> None:
        self._reader = reader
        super().__init__(svg=svg, **clock_of(turn_s, cycle_s))

    @traitlets.validate("angle_deg")
    def _check_angle(self, proposal: Any) -> float:
        return SHOWN_ANGLE.number(proposal["value"])

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """Show `reader`'s picture and text beside the widget, for a reader without a kernel."""
        bundle = super()._repr_mimebundle_(**kwargs)
        data, metadata = bundle or ({}, {})
        return data | self._reader, metadata


def clock_of(turn_s: float, cycle_s: float) -> dict[str, Any]:
    """Return what a player knows beside its SVG: how long a turn takes, there and in the machine.

    >>> clock_of(9, 1.8)["speed"]
    0.2
    """
    speeds = speeds_for(cycle_s)
    wanted = math.log(cycle_s / turn_s)
    speed = min(speeds, key=lambda speed: abs(math.log(speed) - wanted))
    return {"turn_s": turn_s, "cycle_s": cycle_s, "speeds": speeds, "speed": speed}


def speeds_for(cycle_s: float) -> list[float]:
    """Return speeds to choose from, 1 being real time, for a turn that takes `cycle_s`.

    >>> speeds_for(1.8)
    [0.05, 0.1, 0.2, 0.5, 1.0]
    """
    fit = [speed for speed in _SPEEDS if SHORTEST_S <= cycle_s / speed <= LONGEST_S]
    return sorted({*fit, 1.0})
