"""A live figure as it stands, drawn once: for a reader who has neither kernel nor script."""

import io
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from cammotion.quantities import Floats
from cammotion.views.plots import REFERENCE_STYLE, colour, style_axes, style_line, write
from cammotion.views.timing_plots import COLLISION

Functions = Sequence[Callable[..., Any]]

_SAMPLES = 800
_WIDTH_IN, _HEIGHT_IN = 8.2, 0.0145  # of a picture, and of a pixel of a panel's height
_STYLES = {
    "alarm": {"color": COLLISION["edgecolor"], "linewidth": 5, "alpha": 0.8},
    "reference": REFERENCE_STYLE | {"linewidth": 1.2},
    "frame": {"color": "#000000", "linewidth": 1.2},
}
_SPIKE = 20  # so many times as wide as nine tenths of the values is what belongs to a pole


def draw(
    description: dict[str, Any], now: Functions, then: Functions, clock: float
) -> bytes:
    """Return a PNG of a described figure: `now` its formulas as set, `then` as pinned.

    `clock` is where the variable stands.
    """
    columns = description["columns"]
    heights = [sum(panel["height"] for panel in column) for column in columns]
    figure = Figure(
        figsize=(_WIDTH_IN, max(heights) * _HEIGHT_IN), dpi=100, facecolor="white", layout="tight"
    )
    grid = figure.add_gridspec(1, len(columns), width_ratios=description["shares"])
    for place, column in zip(grid, columns, strict=True):
        ratios = [panel["height"] for panel in column]
        inner = place.subgridspec(len(column), 1, height_ratios=ratios)
        for spot, panel in zip(inner, column, strict=True):
            ax = figure.add_subplot(spot)
            is_last = panel is column[-1] or not panel["shares_x"]
            _draw_panel(ax, panel, now, then if description["pin"] else None, clock, is_last)
    picture = io.BytesIO()
    FigureCanvasAgg(figure).print_png(picture)  # type: ignore[no-untyped-call]
    return picture.getvalue()


def _draw_panel(  # noqa: PLR0913 - what a panel needs, each once
    ax: Axes,
    panel: dict[str, Any],
    now: Functions,
    then: Functions | None,
    clock: float,
    is_last: bool,
) -> None:
    style_axes(ax, panel["x_label"] if is_last else "", panel["y_label"].replace(" in ", "\nin "))
    ax.tick_params(labelbottom=is_last)
    ax.margins(x=0.02)
    for line in panel["lines"]:
        if then is not None and line["role"] == "own":
            ax.plot(*_sampled(line, then), **REFERENCE_STYLE)
        (drawn,) = ax.plot(*_sampled(line, now))
        drawn.set_label(line["name"] or "_")
        _style(drawn, line)
    for text, x, y in panel["words"]:
        ax.text(x, y, text, fontsize=10, ha="center", va="top")
    _set_limits(ax, panel, now)
    for box in panel["boxes"]:
        _draw_box(ax, box, now, clock)
    for point in panel["points"]:
        at = now[point["x"]](clock), now[point["y"]](clock)
        ax.plot(*at, "o", color=colour(point["colour"]), markersize=12 if point["drags"] else 7)
        if point["name"]:
            write(ax, point["name"], at)
    if panel["has_cursor"]:
        ax.axvline(clock, color="#555555", linewidth=1)
    if panel["equal"]:
        ax.set_aspect("equal")
    if panel["bare"]:
        ax.set_axis_off()
    if sum(bool(line["name"]) for line in panel["lines"]) > 1:
        ax.legend(fontsize=10)


def _style(drawn: Any, line: dict[str, Any]) -> None:
    if line["role"] == "own":
        style_line(drawn, line["colour"])
    else:
        drawn.set(**_STYLES[line["role"]])


def _draw_box(ax: Axes, box: dict[str, Any], now: Functions, clock: float) -> None:
    edges = [*ax.get_xlim(), *ax.get_ylim()]
    sides = ["x_low", "x_high", "y_low", "y_high"]
    x0, x1, y0, y1 = (
        edge if box[side] is None else float(now[box[side]](clock))
        for side, edge in zip(sides, edges, strict=True)
    )
    ax.add_patch(Rectangle((x0, y0), x1 - x0, y1 - y0, **COLLISION, alpha=0.6, linewidth=0))
    ax.set(xlim=edges[:2], ylim=edges[2:])
    if box["name"]:
        middle = (max(x0, edges[0]) + min(x1, edges[1])) / 2, (y0 + min(y1, edges[3])) / 2
        write(ax, box["name"], middle, COLLISION["edgecolor"], offset=(0, 0))


def _set_limits(ax: Axes, panel: dict[str, Any], now: Functions) -> None:
    if panel["x_limits"]:
        ax.set_xlim(*(float(now[end]()) for end in panel["x_limits"]))
    if panel["y_limits"]:
        ax.set_ylim(*(float(now[end]()) for end in panel["y_limits"]))
        return
    drawn = [np.asarray(line.get_ydata(), dtype=float) for line in ax.lines]
    values = np.concatenate([np.empty(0), *drawn])
    values = values[np.isfinite(values)]
    if values.size:
        few, most = np.quantile(values, [0.05, 0.95])
        if 0 < _SPIKE * (most - few) < np.ptp(values):
            ax.set_ylim(max(values.min(), 2 * few - most), min(values.max(), 2 * most - few))


def _sampled(line: dict[str, Any], now: Functions) -> tuple[Floats, Floats]:
    """Return x and y of a line, corners in it; not a number where it is broken."""
    low, high = (float(now[end]()) for end in line["over"])
    gap = 1e-9 * (high - low)
    joints = [float(now[joint]()) for joint in line["joints"]]
    sides = [place + side for place in joints for side in (-gap, gap) if low < place < high]
    places = np.sort(np.concatenate([np.linspace(low, high, _SAMPLES + 1), sides]))
    with np.errstate(all="ignore"):
        y = np.array(np.broadcast_to(now[line["y"]](places), places.shape), dtype=float)
        x = places if line["x"] is None else now[line["x"]](places)
    x = np.array(np.broadcast_to(x, places.shape), dtype=float)
    if line["where"] is not None:
        y[~(now[line["where"]](places) > 0)] = np.nan
    y[~np.isfinite(y)] = np.nan
    return x, y
