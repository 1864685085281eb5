"""A live figure in the page: what the hardest move would need over another angle or rate."""

import math
from html import escape

import sympy as sp

from cammotion.laws.catalogue import as_law
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M
from cammotion.machine.segments import Segment
from cammotion.own import Machine
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import Control, Line, Panel, Point, Say
from cammotion.whole.optimise import turn_peak

_NARROWEST, _WIDEST = 0.4, 3.0  # times the angle of today
_STEP_DEG, _FEWEST = 0.1, 100  # of its slider; steps of one for a short move
_SLOWEST, _FASTEST = 0.4, 2.5  # times the rate of today
_FIT = (  # the frame is as high as the figure in it, also when that gets another width
    "new ResizeObserver(([{target}]) => this.style.height = "
    "target.offsetHeight + this.offsetHeight - this.clientHeight + 'px')"
    ".observe(this.contentDocument.body)"
)


def live_figure(machine: Machine) -> str:
    """Return the figure in a frame of its own; nothing if it has no move with a peak."""
    moves = [m for m in machine.diagram[machine.hardest].moves if math.isfinite(turn_peak(m))]
    if not moves:
        return ""
    move = max(moves, key=turn_peak)
    name = f"The {move.kind} of the {machine.hardest}"
    figure = _figure(move, machine.diagram.rate_per_hour, name)
    return (
        f"<p>{escape(name)}, which is driven hardest: what it would need over another angle, at "
        f'another rate.</p>\n<div class="screen"><iframe title="{escape(name)}" '
        f'onload="{_FIT}" srcdoc="{escape(figure.as_page())}"></iframe></div>\n'
    )


def _figure(move: Segment, rate: float, name: str) -> LiveFigure:
    """Return the figure of a move from rest to rest, today at a rate in pieces/h."""
    law, way = as_law(move.law), abs(move.change_mm) / MM_PER_M
    B, at, N = sp.symbols("B at N", positive=True)  # noqa: N806 - the symbols of the lessons
    per_factor = way / (B / DEG_PER_TURN * 3600 / N) ** 2
    peak, least = law.Ca * per_factor, 4 * per_factor  # such a law rests at both its ends
    low = _NARROWEST * move.angle_deg
    high = min(_WIDEST * move.angle_deg, float(DEG_PER_TURN))
    step = min(_STEP_DEG, (high - low) / _FEWEST)
    return explore(
        Panel(
            lines=[
                Line(y=peak, name=law.name, colour=0),
                Line(y=least, name="none from rest to rest is below", colour=1),
            ],
            points=[Point(x=at, y=peak.subs(B, at), colour=0)],
            y="peak acceleration in m/s²",
            x="angle of the move in deg",
            height=260,
        ),
        (B, low, high),
        {
            at: Control(
                low=low, high=high, step=step, start=move.angle_deg, name="its angle", unit="deg"
            ),
            N: Control(
                low=_SLOWEST * rate,
                high=_FASTEST * rate,
                step=rate / 100,
                start=rate,
                name="rate",
                unit="pieces/h",
            ),
        },
        says=[Say("peak of the move: {a:.4g} m/s²", {"a": peak.subs(B, at)})],
        title=name,
    )
