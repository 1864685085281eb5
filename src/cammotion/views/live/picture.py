"""A live figure as it stands, drawn once: for a reader who has neither kernel nor script."""

import io
import math
import re
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.patches import Rectangle
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator, MultipleLocator
from matplotlib.transforms import BboxBase

from cammotion.quantities import Floats
from cammotion.views.broken import BROKEN
from cammotion.views.ends import POINTS_PER_INCH
from cammotion.views.names import add_legend, as_label, plain, wrap
from cammotion.views.pictures import on_paper
from cammotion.views.plots import REFERENCE_STYLE, colour, style_axes, style_line, write
from cammotion.views.scales import short_number

Functions = Sequence[Callable[..., Any]]

_SAMPLES = 800
_WIDTH_IN, _HEIGHT_IN = 8.2, 0.0145  # of a picture, and of a pixel of a panel's height
_LABEL_IN, _NUMBERS_IN, _ROOM_IN = 0.95, 0.6, 0.14  # left of, under and between panels
_EDGE_IN = 0.05  # between the edge of the picture and a label that takes more than that
_PLAIN = range(-2, 5)  # powers of ten of the numbers that have room at an axis
_IN_UNIT = re.compile(r"\bin (?=[^\s\d])(?!.*\bin [^\s\d])", re.DOTALL)  # the last of a label
_LABEL = 11  # the size of a label, in points
_NUMBER_PX = 40, 16  # so wide, and so high, is a number at an axis
_HIGH = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")
_STYLES = {
    "alarm": {"color": BROKEN["edgecolor"], "linewidth": 5, "alpha": 0.8},
    "reference": REFERENCE_STYLE | {"linewidth": 1.2},
    "frame": {"color": "#000000", "linewidth": 1.2},
}
_HALO = withStroke(linewidth=3, foreground="white")  # words over lines stay readable
_CLEAR_PX, _TRIED = 5, 15  # a legend is so far from a curve; places tried across and up
_SPIKE = 20  # so many times as wide as nine tenths of the values is what belongs to a pole


@on_paper
def draw(description: dict[str, Any], now: Functions, then: Functions, clock: float) -> bytes:
    """Return a PNG of a described figure: `now` its formulas as set, `then` as pinned.

    `clock` is where the variable stands.
    """
    columns = description["columns"]
    width, height = _WIDTH_IN, _HEIGHT_IN * max(sum(p["height"] for p in c) for c in columns)
    figure = Figure(figsize=(width, height), dpi=100, facecolor="white")
    grid = figure.add_gridspec(1, len(columns), width_ratios=description["shares"])
    _make_room(figure, grid, _LABEL_IN)
    for number, column in enumerate(columns):
        room = _ROOM_IN if column[0]["shares_x"] else _NUMBERS_IN
        ratios = [panel["height"] for panel in column]
        hspace = 1.6 * room * len(column) / height
        inner = grid[number].subgridspec(len(column), 1, height_ratios=ratios, hspace=hspace)
        for place, panel in enumerate(column):
            drawn = _Drawn(figure.add_subplot(inner[place]), panel, now, clock)
            drawn.draw(then if description["pin"] else None, panel is column[-1])
    _add_legends(figure.axes)
    canvas = FigureCanvasAgg(figure)
    if (needed := max(map(_left_of, figure.axes))) > _LABEL_IN:
        _make_room(figure, grid, needed + _EDGE_IN)
    is_wrapped = [_wrap_label(ax) for ax in figure.axes]
    if any(is_wrapped):
        needed = _EDGE_IN + max(map(_below, figure.axes))
        figure.subplots_adjust(bottom=max(needed, _NUMBERS_IN) / height)
    for ax in figure.axes:
        _free_curves(ax)
    picture = io.BytesIO()
    quick = {"compress_level": 3}  # a cell that runs waits for it
    canvas.print_png(picture, pil_kwargs=quick)  # type: ignore[no-untyped-call]
    return picture.getvalue()


def _make_room(figure: Figure, grid: GridSpec, left_in: float) -> None:
    """Leave so much left of each column of panels, and the usual on the other sides."""
    width, height = figure.get_size_inches()
    column = (width - _ROOM_IN) / grid.ncols - left_in
    figure.subplots_adjust(
        left=left_in / width,
        right=1 - _ROOM_IN / width,
        bottom=_NUMBERS_IN / height,
        top=1 - _ROOM_IN / height,
        wspace=left_in / column,
    )


def _left_of(ax: Axes) -> float:
    """Return what an axis takes left of its panel, with its numbers and its label, in inches."""
    taken = ax.yaxis.get_tightbbox()
    return 0.0 if taken is None else (ax.bbox.x0 - taken.x0) / ax.figure.dpi


def _wrap_label(ax: Axes) -> bool:
    """Break the label under a panel that is wider than it; return whether it is in lines now."""
    label, room = ax.xaxis.label, ax.bbox.width / ax.figure.dpi
    if label.get_window_extent().width / ax.figure.dpi <= room + 2 * _ROOM_IN:
        return False
    label.set_text("\n".join(wrap(label.get_text(), room * POINTS_PER_INCH, _LABEL)))
    return True


def _below(ax: Axes) -> float:
    """Return what an axis takes under its panel, with its numbers and its label, in inches."""
    taken = ax.xaxis.get_tightbbox()
    return 0.0 if taken is None else (ax.bbox.y0 - taken.y0) / ax.figure.dpi


def _add_legends(axes: Sequence[Axes]) -> None:
    """Name the lines where several have names, unless a panel above has said the same."""
    said: list[list[str]] = []
    for ax in axes:
        _, names = ax.get_legend_handles_labels()
        if len(names) > 1 and names not in said:
            add_legend(ax)
        said.append(names)


def _free_curves(ax: Axes) -> None:
    """Move a legend that hides a curve to the nearest place where it hides nothing, if any.

    Left of a bare panel the room of numbers and label is free, too.
    """
    if (legend := ax.get_legend()) is None:
        return
    ax.apply_aspect()
    curves = [one for one in ax.lines if one.get_transform() == ax.transData]  # not the cursor
    shapes = [
        *((one.get_path().transformed(one.get_transform()), False) for one in curves),
        *((one.get_path().transformed(one.get_transform()), True) for one in ax.patches),
    ]

    numbers = [axis.get_tightbbox() for axis in (ax.xaxis, ax.yaxis) if ax.axison]
    words = [*filter(None, numbers), *(text.get_window_extent() for text in ax.texts)]

    def hides_curve(box: BboxBase) -> bool:
        around = box.padded(_CLEAR_PX)
        return any(path.intersects_bbox(around, filled) for path, filled in shapes)

    hides = legend.get_window_extent()
    if not hides_curve(hides):
        return
    panel, room = ax.bbox, ax.get_position(original=True).transformed(ax.figure.transFigure)
    left = room.x0 if ax.axison else room.x0 - _LABEL_IN * ax.figure.dpi
    moves = [
        (x - hides.x0, y - hides.y0)
        for x in np.linspace(left + _CLEAR_PX, room.x1 - hides.width - _CLEAR_PX, _TRIED)
        for y in np.linspace(room.y0, room.y1 - hides.height - _CLEAR_PX, _TRIED)
    ]
    boxes = [(move, hides.translated(*move)) for move in moves]
    free = [m for m, box in boxes if not (box.count_overlaps(words) or hides_curve(box))]
    if free:
        x, y = min(free, key=lambda move: math.hypot(*move))
        place = hides.x0 + x - panel.x0, hides.y0 + y - panel.y0
        legend.set_loc((place[0] / panel.width, place[1] / panel.height))


class _Drawn:
    """A panel on its axes."""

    def __init__(self, ax: Axes, panel: dict[str, Any], now: Functions, clock: float) -> None:
        self.ax, self.panel, self.now, self.clock = ax, panel, now, clock

    def draw(self, then: Functions | None, is_last: bool) -> None:
        """Draw all that is in it, and numbers under it unless the panel below has the same."""
        ax, panel = self.ax, self.panel
        has_numbers = is_last or not panel["shares_x"]
        what, within, unit = panel["y_label"].rpartition(" in ")
        label = f"{what}\nin {unit}" if within else unit
        style_axes(ax, panel["x_label"] if has_numbers else "", label)
        ax.tick_params(labelbottom=has_numbers)
        ax.margins(x=0.02)
        ax.xaxis.set_major_locator(MaxNLocator(6))  # few, since each number costs time
        ax.yaxis.set_major_locator(MaxNLocator(5))
        self._draw_lines(then)
        self._set_limits()
        self._set_ticks()
        self._break_at_poles()
        for box in panel["boxes"]:
            self._draw_box(box)
        for text, x, y in panel["words"]:
            plain(ax.text(x, y, text, fontsize=10, ha="center", va="center", path_effects=[_HALO]))
        self._draw_points()
        for axis in (ax.xaxis, ax.yaxis):
            _take_out_a_power(axis)
        if panel["equal"]:
            ax.set_aspect("equal")
        if panel["bare"]:
            ax.set_axis_off()

    def _draw_lines(self, then: Functions | None) -> None:
        for line in self.panel["lines"]:
            if line["role"] == "area":
                curve = _sampled(line, self.now, self.clock)
                shade = self.ax.fill_between(*curve, alpha=0.25, linewidth=0)
                shade.set_color(colour(line["colour"]))
                continue
            is_own = line["role"] == "own"
            if then is not None and is_own:
                self.ax.plot(*_sampled(line, then, self.clock), **REFERENCE_STYLE)
            (drawn,) = self.ax.plot(*_sampled(line, self.now, self.clock))
            drawn.set_label(as_label(line["name"]) or "_")
            if is_own:
                style_line(drawn, line["colour"])
            else:
                drawn.set(**_STYLES[line["role"]])

    def _draw_points(self) -> None:
        for point in self.panel["points"]:
            at = self._at(point["x"]), self._at(point["y"])
            size = 12 if point["drags"] else 7
            self.ax.plot(*at, "o", color=colour(point["colour"]), markersize=size)
            if point["name"]:
                write(self.ax, point["name"], at)
        if self.panel["has_cursor"]:
            self.ax.axvline(self.clock, color="#555555", linewidth=1)
            for line in (line for line in self.panel["lines"] if line["role"] == "own"):
                at = self.clock, self._at(line["y"])
                self.ax.plot(*at, "o", color=colour(line["colour"]), markersize=6)

    def _draw_box(self, box: dict[str, Any]) -> None:
        edges = [*self.ax.get_xlim(), *self.ax.get_ylim()]
        sides = ["x_low", "x_high", "y_low", "y_high"]
        x0, x1, y0, y1 = (
            edge if box[side] is None else self._at(box[side])
            for side, edge in zip(sides, edges, strict=True)
        )
        region = Rectangle((x0, y0), x1 - x0, y1 - y0, **BROKEN, alpha=0.6, linewidth=0)
        self.ax.add_patch(region)
        self.ax.set(xlim=edges[:2], ylim=edges[2:])
        left, right = max(x0, edges[0]), min(x1, edges[1])
        low, high = max(y0, edges[2]), min(y1, edges[3])
        if box["name"] and left < right and low < high:
            middle = (left + right) / 2, (low + high) / 2
            words = {"fontsize": 11, "color": BROKEN["edgecolor"], "path_effects": [_HALO]}
            plain(self.ax.text(*middle, box["name"], ha="center", va="center", **words))

    def _set_limits(self) -> None:
        """Take the limits that are given; else let no spike beside a pole flatten the rest."""
        if self.panel["x_limits"]:
            self.ax.set_xlim(*(self._at(end) for end in self.panel["x_limits"]))
        if self.panel["y_limits"]:
            self.ax.set_ylim(*(self._at(end) for end in self.panel["y_limits"]))
            return
        drawn = [np.asarray(line.get_ydata(), dtype=float) for line in self.ax.lines]
        values = np.concatenate([np.empty(0), *drawn])
        values = values[np.isfinite(values)]
        if values.size:
            few, most = np.quantile(values, [0.05, 0.95])
            if 0 < _SPIKE * (most - few) < np.ptp(values):
                low, high = 2 * few - most, 2 * most - few
                self.ax.set_ylim(max(values.min(), low), min(values.max(), high))

    def _set_ticks(self) -> None:
        """Take the steps that are given, or every second or third where they have no room."""
        sizes = self.ax.bbox.size
        for axis, wide, size, name in zip(
            (self.ax.xaxis, self.ax.yaxis), _NUMBER_PX, sizes, ("x_ticks", "y_ticks"), strict=True
        ):
            if step := self.panel[name]:
                low, high = axis.get_view_interval()
                every = math.ceil((high - low) / step * wide / size)
                axis.set_major_locator(MultipleLocator(step * max(every, 1)))

    def _break_at_poles(self) -> None:
        """Let no line go from above the picture to below it: there is a pole between."""
        low, high = self.ax.get_ylim()
        for line in self.ax.lines:
            y = np.array(line.get_ydata(), dtype=float)
            side = np.where(y > high, 1, np.where(y < low, -1, 0))
            y[1:][side[1:] * side[:-1] < 0] = np.nan
            line.set_ydata(y)

    def _at(self, formula: int) -> float:
        return float(self.now[formula](self.clock, self.clock))


def _take_out_a_power(axis: Axis) -> None:
    """Write numbers that have no room at an axis with a power of ten beside the unit."""
    largest = float(np.abs(axis.get_view_interval()).max())
    power = math.floor(math.log10(largest)) if 0 < largest < math.inf else 0
    if power not in _PLAIN and _IN_UNIT.search(axis.get_label_text()):
        axis.set_major_formatter(lambda value, _: short_number(value / 10.0**power))
        high = str(power).translate(_HIGH)
        axis.set_label_text(_IN_UNIT.sub(rf"\g<0>10{high} ", axis.get_label_text()))


def _sampled(line: dict[str, Any], now: Functions, clock: float) -> tuple[Floats, Floats]:
    """Return x and y of a line, corners in it; not a number where it is broken."""
    low, high = (float(now[end]()) for end in line["over"])
    gap = 1e-9 * (high - low)
    joints = [float(now[joint]()) for joint in line["joints"]]
    sides = [place + side for place in joints for side in (-gap, gap) if low < place < high]
    places = np.sort(np.concatenate([np.linspace(low, high, _SAMPLES + 1), sides]))
    with np.errstate(all="ignore"):
        y = np.array(np.broadcast_to(now[line["y"]](places, clock), places.shape), dtype=float)
        x = places if line["x"] is None else now[line["x"]](places, clock)
    x = np.array(np.broadcast_to(x, places.shape), dtype=float)
    if line["where"] is not None:
        y[~(now[line["where"]](places, clock) > 0)] = np.nan
    y[~np.isfinite(y)] = np.nan
    return x, y
