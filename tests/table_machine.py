"""An indexing table from above, and beside it the torque that it takes, over one cycle.

It is one SVG that moves by itself, like that of `animate`.
"""

from collections.abc import Iterable
from typing import Any

import drawsvg as draw
import numpy as np

from cammotion.hardware.indexer import Indexer
from cammotion.machine.kinematics import ANGLE, DEG_PER_TURN
from cammotion.views.animation import svg
from cammotion.views.animation.keyframes import CAMSHAFT, Trace
from cammotion.views.animation.picture import TURN
from cammotion.views.plots import colour
from cammotion.views.scales import short_number

WIDTH_PX, HEIGHT_PX = 760, 330
_CENTRE, _RADIUS, _STATIONS, _STATION = (165.0, 165.0), 140.0, 0.86, 14.0
_LEFT, _RIGHT, _ZERO, _HIGH = 390.0, 730.0, 175.0, 110.0  # of the chart
_SAMPLES = 121
_TABLE, _DRIVEN, _DRIVING = 0, 0, 1  # numbers of colours


def table_machine(indexer: Indexer, angle_deg: float, *, turn_s: float = 5.0) -> str:
    """Return the SVG of a table that makes an index over `angle_deg` of its cycle, and then rests.

    `turn_s` is how long a cycle takes in the SVG, in s. Raises InputError for an angle that is not
    above 0 and at most 360 deg.
    """
    return _Drawing(indexer, ANGLE.number(angle_deg), TURN.number(turn_s)).draw()


class _Drawing:
    """The table on the left, the torque on the right, by one clock."""

    def __init__(self, indexer: Indexer, angle_deg: float, turn_s: float) -> None:
        self.indexer, self.angle_deg, self.turn_s = indexer, angle_deg, turn_s
        x = np.linspace(0, 1, _SAMPLES)
        self.angles, self.torques = x * angle_deg, indexer.torque_N_m(x)
        self.turned = np.degrees(np.cumsum(indexer.velocity_rad_per_s(x)) * indexer.time_s / x.size)
        self.turned *= DEG_PER_TURN / indexer.stops / self.turned[-1]

    def draw(self) -> str:
        """Draw it all and return the SVG."""
        title = "A table moves on from stop to stop"
        drawing = svg.sheet(WIDTH_PX, HEIGHT_PX, title, self._description)
        drawing.append(svg.placed(*_CENTRE, *self._table()))
        drawing.extend([*self._chart(), *self._said(), self._dot()])
        return str(drawing.as_svg(header=""))

    @property
    def _description(self) -> str:
        most = self.indexer.peak_torque_N_m
        return (
            f"A round table with {self.indexer.stops} stations, from above. It moves on by one "
            f"station in {self.indexer.time_s:g} s and stands for the rest of the cycle. Beside it "
            f"the torque over the cycle: up to {most:.0f} N m to set it going, about as much "
            "the other way to stop it."
        )

    def _table(self) -> Iterable[Any]:
        """Draw the table, which turns by one station, and a mark that stands still."""
        turning = svg.moving(self._trace(self.turned), self.turn_s, "rotate")
        line = {"stroke": colour(_TABLE), "stroke_width": 2}
        turning.append(draw.Circle(0, 0, _RADIUS, fill=svg.pale(_TABLE), **line))
        for number in range(self.indexer.stops):
            angle = 2 * np.pi * number / self.indexer.stops
            place = _STATIONS * _RADIUS * np.array([np.sin(angle), -np.cos(angle)])
            turning.append(draw.Circle(*map(svg.px, place), _STATION, fill="white", **line))
            spoke = draw.Path(stroke=colour(_TABLE), stroke_width=1, stroke_opacity=0.4)
            inner, outer = (share * place for share in (0.3, 1 - _STATION / np.hypot(*place)))
            turning.append(spoke.M(*map(svg.px, inner)).L(*map(svg.px, outer)))
        yield turning
        yield draw.Circle(0, 0, 22, fill="white", **line)
        yield draw.Path(fill=svg.INK).M(-7, -_RADIUS - 16).h(14).l(-7, 12).Z()

    def _chart(self) -> Iterable[Any]:
        """Draw the axes and the torque over one cycle."""
        yield svg.label("torque of the drive on the table, in N m", _LEFT, 24)
        ink = {"stroke": svg.GREY, "stroke_width": 1, "fill": "none"}
        yield draw.Path(**ink).M(_LEFT, _ZERO).H(_RIGHT)
        yield draw.Path(**ink).M(_LEFT, _ZERO - _HIGH - 20).V(_ZERO + _HIGH + 10)
        for value in (np.max(self.torques), np.min(self.torques)):
            text = short_number(round(float(value)))
            yield svg.label(text, _LEFT - 6, self._y(value) + 4, text_anchor="end")
        yield svg.label("0", _LEFT - 6, _ZERO + 4, text_anchor="end")
        yield svg.label("one cycle", _RIGHT, _ZERO + 18, text_anchor="end")
        points = zip(self._x(self.angles), self._y(self.torques), strict=True)
        ends = [(_LEFT, _ZERO), *points, (self._x(self.angle_deg), _ZERO), (_RIGHT, _ZERO)]
        yield svg.polyline(ends, **svg.line_style(_TABLE))

    def _said(self) -> Iterable[Any]:
        """Say who pushes, while it lasts."""
        brakes = [(a * self.angle_deg, b * self.angle_deg) for a, b in self.indexer.braking[:1]]
        start = brakes[0][0] if brakes else self.angle_deg
        phases = (
            ("the drive pushes the table", [(0.0, start)], _DRIVEN),
            ("the table pushes the drive", brakes, _DRIVING),
            ("the table stands, work is done", [(self.angle_deg, float(DEG_PER_TURN))], 2),
        )
        for text, during, number in phases:
            if during and during[0][0] < DEG_PER_TURN:
                seen = svg.seen_during(during, self.turn_s)
                style: dict[str, Any] = {"fill": svg.dark(number), "font_weight": "bold"}
                seen.append(svg.label(text, _LEFT + 6, HEIGHT_PX - 14, **style))
                yield seen

    def _dot(self) -> Any:
        """Draw the point that runs along the curve."""
        across = svg.moving(CAMSHAFT.scaled((_RIGHT - _LEFT) / DEG_PER_TURN), self.turn_s, "x")
        up = svg.moving(self._trace(self._y(self.torques), rest=_ZERO), self.turn_s, "y")
        up.append(draw.Circle(_LEFT, svg.px(self._y(self.torques[0])), 5, fill=colour(1)))
        across.append(up)
        return across

    def _trace(self, values: Any, rest: float | None = None) -> Trace:
        """Return values over the index, and how it goes on over the rest of the cycle."""
        last = values[-1] if rest is None else rest
        angles, values = np.append(self.angles, self.angle_deg), np.append(values, last)
        if self.angle_deg < DEG_PER_TURN:
            angles, values = np.append(angles, DEG_PER_TURN), np.append(values, last)
        return Trace(angles, values)

    def _x(self, angle_deg: Any) -> Any:
        return _LEFT + (_RIGHT - _LEFT) * angle_deg / DEG_PER_TURN

    def _y(self, torque: Any) -> Any:
        return _ZERO - _HIGH * torque / self.indexer.peak_torque_N_m
