"""Beside a follower that leaves its cam: displacements and force over the turn, with a cursor."""

from collections.abc import Iterable
from typing import Any, NamedTuple

from cammotion.machine.arcs import Arc
from cammotion.quantities import Floats
from cammotion.views.animation import svg
from cammotion.views.animation.charts import (
    Chart,
    LabelledCurve,
    Lane,
    draw_cursor,
    name_angle,
    round_ticks,
)
from cammotion.views.animation.keyframes import Trace

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
    yield draw_cursor([(lift, 0.0), (force, top)], turn_s)
    yield name_angle(force, top)


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
    room = 0.06 * high
    return Lane(curves, -room, high + room, round_ticks(0, high), 0, _LANE_PX)
