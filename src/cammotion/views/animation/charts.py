"""The charts below the machine: its timing diagram and its accelerations, with a common cursor."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import drawsvg as draw
import numpy as np
from matplotlib.ticker import MaxNLocator

from cammotion.machine.arcs import Arc
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.views.animation import svg
from cammotion.views.animation.keyframes import CAMSHAFT, Trace
from cammotion.views.ends import apart
from cammotion.views.lanes import SHARED_AXIS
from cammotion.views.names import text_px, wrap
from cammotion.views.plots import colour
from cammotion.views.scales import more_digits, short_number

LEFT_PX = 48  # for the scale
GAP_PX, WIDEST_LABEL_PX = 7, 110  # beside the ends of the curves, and for what stands there
FLAT = 25  # so many times smaller than another, a curve is flat beside it
HEADING_PX, TICKS_PX = 18, 18
_TICK_DEG, _LABELLED_DEG = 30, 60
LABEL_PX = 14  # from one name at the ends of curves to the next
_LINES = 2  # of a long one


@dataclass(frozen=True)
class LabelledCurve:
    """A curve of the mechanism with this number, and what stands at its end."""

    number: int
    label: str
    trace: Trace


def fits_at_end(label: str) -> bool:
    """Whether a label has room at the end of its curve, in two lines of small letters."""
    return len(wrap(label, WIDEST_LABEL_PX, svg.SMALL, bold=True)) <= _LINES


@dataclass(frozen=True)
class Lane:
    """A part of a chart with a scale of its own, `top` px below the chart's top."""

    curves: Sequence[LabelledCurve]
    low: float
    high: float
    ticks: Sequence[float]
    top: float
    height: float
    is_bare: bool = False

    def y(self, value: float) -> float:
        """Return where a value is, in px below the chart's top."""
        return self.top + self.height * (self.high - value) / (self.high - self.low)

    def line(self, curve: LabelledCurve) -> Trace:
        """Return a curve in px below the chart's top."""
        return curve.trace.scaled(-self.height / (self.high - self.low), self.y(0))


@dataclass(frozen=True)
class Chart:
    """Lanes over the cam angle from 0 to 360 deg, `width` px wide without scale and labels."""

    heading: str
    lanes: Sequence[Lane]
    width: float
    alarm: str = "rule broken"

    @property
    def height(self) -> float:
        """How high the lanes are together, in px."""
        return self.lanes[-1].top + self.lanes[-1].height

    @property
    def whole_height(self) -> float:
        """How high it is with its heading and its ticks, in px."""
        return HEADING_PX + self.height + TICKS_PX

    def x(self, angle_deg: float) -> float:
        """Return where a cam angle is, in px to the right of the chart's left."""
        return angle_deg / DEG_PER_TURN * self.width

    def draw(self, alarms: Iterable[Arc] = ()) -> Any:
        """Draw all that does not move from (0, 0) on, with `alarms` marked as broken rules."""
        plot = svg.placed(LEFT_PX, HEADING_PX)
        found = list(alarms)
        for start, end in found:
            plot.append(svg.alarm_area(self.x(start), 0, self.x(end) - self.x(start), self.height))
        self._draw_grid(plot)
        for lane in self.lanes:
            self._draw_lane(plot, lane)
        room = self.width + GAP_PX + WIDEST_LABEL_PX
        heading = svg.label(self.heading, LEFT_PX, 11, width=room, size=svg.SMALL)
        return svg.placed(0, 0, heading, plot, *(self._draw_key() if found else ()))

    def draw_dots(self, turn_s: float) -> Any:
        """Draw the dots that follow the curves at the cursor, which moves with their group."""
        dots = svg.placed(0, HEADING_PX)
        for lane in self.lanes:
            for curve in lane.curves:
                height = lane.line(curve)
                dot = svg.moving(height, turn_s, data={"part": "dot", "motion": curve.number})
                fill = colour(curve.number)
                dot.append(draw.Circle(0, 0, 4, fill=fill, stroke="white", stroke_width=1.2))
                dots.append(svg.placed(0, height.values[0], dot))
        return dots

    def _draw_grid(self, plot: Any) -> None:
        grid = draw.Path(stroke="#dddddd", stroke_width=0.8, fill="none")
        for angle in range(0, DEG_PER_TURN + 1, _TICK_DEG):
            grid.M(svg.px(self.x(angle)), 0).v(svg.px(self.height))
            if angle % _LABELLED_DEG == 0:
                place = self.x(angle), self.height + 13
                plot.append(svg.label(f"{angle}°", *place, size=svg.SMALL, text_anchor="middle"))
        for lane in self.lanes:
            for tick in lane.ticks:
                grid.M(0, svg.px(lane.y(tick))).h(svg.px(self.width))
        plot.append(grid)

    def _draw_lane(self, plot: Any, lane: Lane) -> None:
        zero = draw.Path(stroke=svg.INK, stroke_width=0.9, fill="none")
        if lane.low <= 0 <= lane.high:
            plot.append(zero.M(0, svg.px(lane.y(0))).h(svg.px(self.width)))
        more = more_digits(lane.low, lane.high)
        for tick in lane.ticks:
            text = short_number(tick, more, lane.high - lane.low)
            low = lane.top + lane.height
            y = min(max(lane.y(tick) + 4, lane.top + 10), low)  # within its own lane
            plot.append(svg.label(text, -6, y, size=svg.SMALL, text_anchor="end"))
        ends = []
        for curve in lane.curves:
            line = lane.line(curve)
            xs = [self.x(angle) for angle in line.angles_deg]
            style = svg.line_style(curve.number)
            plot.append(svg.polyline(zip(xs, line.values, strict=True), **style))
            ends.append(line.values[-1])
        is_long = any(
            text_px(curve.label, svg.NORMAL, bold=True) > WIDEST_LABEL_PX for curve in lane.curves
        )
        size, most = (svg.SMALL, _LINES) if is_long or lane.is_bare else (svg.NORMAL, 1)
        pitch = LABEL_PX * most
        edge = 4 + (pitch - LABEL_PX) / 2
        places = apart(ends, pitch, lane.top + edge, lane.top + lane.height - edge)
        if lane.is_bare:
            places = np.array([lane.top + lane.height / 2])
        for curve, place in zip(lane.curves, places, strict=True):
            plot.extend(self._name(curve, place, size, most))

    def _name(self, curve: LabelledCurve, place: float, size: int, most: int) -> Iterable[Any]:
        """Write what stands at a curve's end about a height, in so many lines at most."""
        lines = wrap(curve.label, WIDEST_LABEL_PX, size, bold=True, most=most)
        first = place + 4 - LABEL_PX / 2 * (len(lines) - 1)
        bold: dict[str, Any] = {"fill": svg.dark(curve.number), "font_weight": "bold"}
        for number, line in enumerate(lines):
            at = self.width + GAP_PX, first + LABEL_PX * number
            yield svg.label(line, *at, width=WIDEST_LABEL_PX, size=size, **bold)

    def _draw_key(self) -> Iterable[Any]:
        right = LEFT_PX + self.width
        yield svg.alarm_area(right - 96, 1, 18, 11)
        yield svg.label(self.alarm, right - 74, 11, size=svg.SMALL, fill=svg.ALARM)


def draw_cursor(charts: Sequence[tuple[Chart, float]], turn_s: float) -> Any:
    """Draw the cursor through charts, each with its top, and the dots on their curves."""
    way = CAMSHAFT.scaled(charts[0][0].width / DEG_PER_TURN)
    cursor = svg.moving(way, turn_s, "x", data={"part": "cursor"})
    line = draw.Path(stroke=svg.INK, stroke_width=1.4, fill="none")
    for chart, top in charts:
        line.M(0, svg.px(top + HEADING_PX)).v(svg.px(chart.height))
        cursor.append(svg.placed(0, top, chart.draw_dots(turn_s)))
    cursor.insert(0, line)
    return svg.placed(LEFT_PX, 0, cursor)


def name_angle(lowest: Chart, top: float) -> Any:
    """Write under the lowest chart what all of them are over."""
    middle, below = LEFT_PX + lowest.width / 2, top + lowest.whole_height + 12
    return svg.label("cam angle", middle, below, size=svg.SMALL, text_anchor="middle")


def timing_lanes(curves: Sequence[LabelledCurve], height: float) -> list[Lane]:
    """Return one lane for a few curves in mm, or a low one for each of many.

    Each also has its own where on one scale the smallest could not be read.
    """
    spans = [span for curve in curves if (span := float(np.ptp(curve.trace.values)))]
    if len(curves) <= SHARED_AXIS and max(spans, default=1) < FLAT * min(spans, default=1):
        return [_lane(curves, 0, height)]
    low = 32.0
    return [
        _lane([curve], number * (low + 5), low, bare=True) for number, curve in enumerate(curves)
    ]


def acceleration_lane(curves: Sequence[LabelledCurve], peak: float, height: float) -> Lane:
    """Return a lane that reaches as far up as down, for a peak that may be another design's."""
    top = 1.12 * (peak or 1.0)
    return Lane(curves, -top, top, round_ticks(-top, top), 0, height)


def round_ticks(low: float, high: float) -> list[float]:
    """Return about four round numbers from a low to a high value.

    >>> round_ticks(-50, 130)
    [-50.0, 0.0, 50.0, 100.0]
    """
    ticks = MaxNLocator(4, steps=[1, 2, 5, 10]).tick_values(low, high)
    return [float(tick) for tick in ticks if low <= tick <= high]


def _lane(curves: Sequence[LabelledCurve], top: float, height: float, bare: bool = False) -> Lane:
    low = min(float(curve.trace.values.min()) for curve in curves)
    high = max(float(curve.trace.values.max()) for curve in curves)
    if low == high:
        low, high = low - 1, high + 1
    ticks = [low, high] if bare else round_ticks(low, high)
    room = 0.06 * (high - low)
    return Lane(curves, low - room, high + room, ticks, top, height, bare)
