"""Beside a follower that leaves its cam: displacements and force over the turn, with a cursor."""

from collections.abc import Iterable
from typing import Any, NamedTuple

import drawsvg as draw
from matplotlib.ticker import MaxNLocator

from cammotion.machine.arcs import Arc
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats
from cammotion.views.animation import svg
from cammotion.views.animation.charts import HEADING_PX, LEFT_PX, Chart, LabelledCurve, Lane
from cammotion.views.animation.keyframes import CAMSHAFT, Trace

CAM, FOLLOWER = 1, 0  # the numbers of their colours
_CHART_PX, _LANE_PX = 372.0, 112.0


class Curves(NamedTuple):
    """What is drawn over the cam angles in deg; `air` are the arcs in which the follower is off.

    `cam` and `follower` are displacements in mm, the second with its gap `magnify` times as large;
    `force` is in N.
    """

    angles: Floats
    cam: Floats
    follower: Floats
    force: Floats
    air: list[Arc]
    magnify: float


def draw_charts(curves: Curves, turn_s: float) -> Iterable[Any]:
    """Draw displacement and force over the cam angle, with a cursor through both."""
    gap = f", gap {curves.magnify:g} times" if curves.magnify > 1 else ""
    lift = Chart(f"displacement in mm{gap}", [_lifts(curves)], _CHART_PX, "in the air")
    force = Chart("force between cam and follower in N", [_force(curves)], _CHART_PX)
    top = lift.whole_height + 8
    yield lift.draw(curves.air)
    yield svg.placed(0, top, force.draw())
    way = CAMSHAFT.scaled(_CHART_PX / DEG_PER_TURN)
    cursor = svg.moving(way, turn_s, "x", data={"part": "cursor"})
    line = draw.Path(stroke=svg.INK, stroke_width=1.4, fill="none")
    for chart, at in ((lift, 0.0), (force, top)):
        line.M(0, svg.px(at + HEADING_PX)).v(svg.px(chart.height))
        cursor.append(svg.placed(0, at, chart.draw_dots(turn_s)))
    cursor.insert(0, line)
    yield svg.placed(LEFT_PX, 0, cursor)
    below = top + force.whole_height + 12
    middle = LEFT_PX + _CHART_PX / 2
    yield svg.label("cam angle", middle, below, size=svg.SMALL, text_anchor="middle")


def _lifts(curves: Curves) -> Lane:
    drawn = [
        LabelledCurve(FOLLOWER, "follower", Trace(curves.angles, curves.follower)),
        LabelledCurve(CAM, "cam", Trace(curves.angles, curves.cam)),
    ]
    return _lane(drawn, float(curves.follower.max()))


def _force(curves: Curves) -> Lane:
    curve = LabelledCurve(FOLLOWER, "force", Trace(curves.angles, curves.force))
    return _lane([curve], float(curves.force.max()) or 1.0)  # always in the air: any scale


def _lane(curves: list[LabelledCurve], high: float) -> Lane:
    ticks = MaxNLocator(4, steps=[1, 2, 5, 10]).tick_values(0, high)
    room = 0.06 * high
    return Lane(curves, -room, high + room, [t for t in ticks if 0 <= t <= high], 0, _LANE_PX)
