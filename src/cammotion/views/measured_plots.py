"""Pictures of a measured cam: its acceleration with what readings leave open, its harmonics."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import MultipleLocator
from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M
from cammotion.measured.cam_table import CamTable
from cammotion.measured.differences import ERROR, differences
from cammotion.measured.inch import MM_PER_INCH
from cammotion.measured.smoothing import SmoothedTable
from cammotion.quantities import Floats, InputError, Quantity, as_text, one_of
from cammotion.views.ends import POINTS_PER_INCH, apart, inches
from cammotion.views.names import (
    TITLE,
    add_legend,
    add_legend_below,
    as_label,
    by_name,
    name_line,
    text_px,
)
from cammotion.views.pictures import on_paper
from cammotion.views.plots import colour, style_line, styled

METRES = {"m": 1.0, "in": MM_PER_INCH / MM_PER_M}
_PLACES = 1441
_DOTS = 100  # more points are a line
_EIGHTH = DEG_PER_TURN / 8
_WIDE = 0.8  # of the way between two ranks, for all bars of a rank
_TOLD = 3  # of the bars have their value above them
_TICKS = 12  # at most, of ranks
_STEPS = (2, 5, 10, 20, 50, 100, 200, 500, 1000)  # of ranks from tick to tick
_VALUE, _OVER, _APART = 9, 3, 11  # of a value in points: its size, how far it is over its bar and
# from the middle of another one, where there are many bars
_ROW, _COLUMNS = 20, 3  # of a legend: a row of it in points, and how many columns it has
_LOW = 0.1  # a height below it is told with three digits, not with two decimals
_HEADROOM = 0.2  # over the highest bar, of it


@checked
@on_paper
def plot_measured(
    tables: Mapping[str, CamTable | SmoothedTable],
    rate_per_hour: float,
    *,
    unit: str = "m",
    error_mm: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the acceleration of each table over the cam angle, and return the Axes.

    Of a `CamTable` it is that of its second differences, with a point at each of them, and with a
    bar of what readings off by at most `error_mm` leave open. Of a `SmoothedTable` it is the
    spline's, within a band of one root mean square to both sides, of reading errors with a root
    mean square of `error_mm`, or of the one that its points suggest. `rate_per_hour` counts the
    turns of the camshaft. `unit` is "m", or "in" for in/s2 with m/s2 on the right. Raises
    InputError for no table, and for another unit.

    >>> angles = np.arange(0, 360, 10)
    >>> cam = CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), is_cycle=True)
    >>> plot_measured({"cam": cam}, 900).get_ylabel()
    'acceleration in m/s²'
    """
    if not isinstance(tables, Mapping) or not tables:
        raise InputError('There is no table to draw: give each a name, as in {"cam": table}.')
    unit = one_of("unit of length", unit, METRES)
    if error_mm is not None:
        error_mm = ERROR.number(error_mm)
    curves = [_curve(table, rate_per_hour, error_mm) for table in tables.values()]
    ax = _axes(ax, "cam angle in deg", "acceleration", unit)
    called = by_name(tables, TITLE)
    for number, (name, table) in enumerate(tables.items()):
        is_smooth = isinstance(table, SmoothedTable)
        angle, *both = curves[number]
        values, open_by = (each / METRES[unit] for each in both)
        line = name_line(style_line(ax.plot(angle, values)[0], number), called[name], name)
        if is_smooth:
            low, high = values - open_by, values + open_by
            ax.fill_between(angle, low, high, color=colour(number), alpha=0.25, lw=0)
        else:
            if angle.size <= _DOTS:
                line.set(marker="o", markersize=3.5)
            if error_mm:
                ax.errorbar(angle, values, open_by, fmt="none", ecolor=colour(number), capsize=3)
    ax.axhline(0, color="#000000", linewidth=0.8)
    ax.margins(x=0.01)
    ax.xaxis.set_major_locator(MultipleLocator(_EIGHTH))
    add_legend_below(ax, _COLUMNS)
    return ax


_AMPLITUDE = Quantity("amplitude", "m/s2", example=3, low_included=True)


@checked
@on_paper
def plot_harmonics(
    amplitudes: Mapping[str, ArrayLike],
    *,
    unit: str = "m",
    critical: int | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the harmonics of accelerations as bars over their rank, 1 being the first of each.

    `amplitudes` are lists in m/s2, by name; `unit` "in" draws them in in/s2, with m/s2 on the
    right. The three largest of each have their rank above them, unless they are 0, and the
    `critical` rank too, in a frame. Returns the Axes; raises InputError for no amplitudes, and for
    another unit.

    >>> plot_harmonics({"cam": [3, 0, 1]}).get_xlabel()
    'rank of the harmonic'
    """
    if not amplitudes:
        raise InputError('There are no harmonics to draw: give a name, as in {"cam": amplitudes}.')
    unit = one_of("unit of length", unit, METRES)
    drawn = {n: np.ravel(_AMPLITUDE.array(a)) / METRES[unit] for n, a in amplitudes.items()}
    last = max(heights.size for heights in drawn.values())
    if critical is not None:
        critical = Quantity("rank", "", example=last, high=last).whole(critical)
    ax = _axes(ax, "rank of the harmonic", "amplitude of acceleration", unit)
    wide = _WIDE / len(amplitudes)
    bars: list[_Bar] = []
    told: list[_Bar] = []
    called = by_name(amplitudes, TITLE)
    for number, (name, heights) in enumerate(drawn.items()):
        left = np.arange(1, heights.size + 1) - _WIDE / 2 + wide * (number + 0.5)
        style: dict[str, Any] = {"color": colour(number), "hatch": "//" if number else ""}
        drawn_bars = ax.bar(left, heights, wide, label=as_label(called[name]), **style)
        drawn_bars[0].set_gid(str(name))
        these = [
            _Bar(rank, *bar) for rank, bar in enumerate(zip(left, heights, strict=True), start=1)
        ]
        largest = {*(np.argsort(-heights)[:_TOLD] + 1)}
        told += [
            bar for bar in these if bar.rank == critical or (bar.rank in largest and bar.height)
        ]
        bars += these
    if critical:
        ax.axvspan(critical - 0.5, critical + 0.5, color="#000000", alpha=0.08, linewidth=0)
    step = next((each for each in _STEPS if last <= each * _TICKS), last // _TICKS + 1)
    ax.set_xticks(np.arange(step, last + 1, step))
    ax.margins(x=0.01, y=_HEADROOM)
    _tell(ax, bars, told, wide)
    return ax


class _Bar(NamedTuple):
    """A bar of a rank: where its middle is, and how high it is."""

    rank: int
    x: float
    height: float

    @property
    def value(self) -> str:
        """What is said above it."""
        digits = "#.3g" if 0 < self.height < _LOW else ".2f"
        return f"{self.rank}: {as_text(self.height, digits)}"


_ABOVE: dict[str, Any] = {
    "textcoords": "offset points",
    "ha": "center",
    "va": "bottom",
    "fontsize": 9,
    "color": "black",
    "rotation": 90,
}


def _tell(ax: Axes, bars: Sequence[_Bar], told: Sequence[_Bar], bar_width: float) -> None:
    """Write values above their bars, and the legend where neither bars nor values are.

    Dense bars are narrower than a value: those of neighbours are moved apart, and stand above all
    bars that they would hide.
    """
    legend = add_legend(ax, loc="upper right")
    wide, high = _laid_out(ax)
    left, right = ax.get_xlim()
    is_dense = bar_width / (right - left) * wide < _APART
    long = max((text_px(bar.value, _VALUE) + _OVER for bar in told), default=0.0)
    if is_dense:
        ax.margins(y=_headroom(long, high))
    top = ax.get_ylim()[1]
    half = _VALUE / 2 * (right - left) / wide
    places = np.array([bar.x for bar in told])
    if is_dense:
        near, far = left + half, right - half
        gap = min(_APART / wide, 1 / len(told)) * (far - near)
        places = apart(places, gap, near, far)
    ends = [(bar.x + _WIDE / 2, bar.height) for bar in bars]
    for bar, x in zip(told, places, strict=True):
        hidden = [each.height for each in bars if is_dense and abs(each.x - x) < half]
        y = max([bar.height, *hidden])
        ax.annotate(bar.value, (x, y), (0, _OVER), **_ABOVE)
        ends.append((x + half, y + long / high * top))
    corner = legend.get_window_extent().transformed(ax.transAxes.inverted())
    is_over = any((x - left) / (right - left) > corner.x0 and y / top > corner.y0 for x, y in ends)
    if is_over:
        rows = -(-len(legend.get_texts()) // _COLUMNS)
        ax.margins(y=_headroom(long, high - rows * _ROW))
        place: dict[str, Any] = {"loc": "lower right", "bbox_to_anchor": (1, 1)}
        add_legend(ax, **place, ncols=_COLUMNS, frameon=False)


def _headroom(long: float, high: float) -> float:
    """Return what is left over the highest bar, of it, where values are so long in points."""
    return max(_HEADROOM, long / max(high - long, long))


def _laid_out(ax: Axes) -> tuple[float, float]:
    """Return how wide and how high axes are in points, once the picture is laid out."""
    figure = ax.get_figure(root=True)
    assert figure is not None  # noqa: S101 - axes that are drawn in have one
    figure.draw_without_rendering()
    wide, high = inches(ax)
    return POINTS_PER_INCH * wide, POINTS_PER_INCH * high


def _axes(ax: Axes | None, across: str, up: str, unit: str) -> Axes:
    """Return styled axes in a unit, with metres on the right where it is the inch."""
    metres = METRES[unit]
    ax = styled(ax, across, f"{up} in {unit}/s²", (7.5, 4.2), layout="constrained")
    if unit != "m":
        ways = (lambda y: np.asarray(y) * metres, lambda y: np.asarray(y) / metres)
        right = ax.secondary_yaxis("right", functions=ways)
        right.set_ylabel("in m/s²", fontsize=11)
        right.tick_params(labelsize=10)
    return ax


def _curve(
    table: CamTable | SmoothedTable, rate: float, error_mm: float | None
) -> tuple[Floats, Floats, Floats]:
    if isinstance(table, SmoothedTable):
        return _spline(table, rate, error_mm)
    return _points(table, rate, error_mm)


def _points(table: CamTable, rate: float, error_mm: float | None) -> tuple[Floats, Floats, Floats]:
    """Return angles, the acceleration there, and the bound of what readings leave open."""
    found = differences(table, rate)
    bound = found.acceleration_bound(error_mm or 0.0)
    if table.is_cycle:
        return _closed(found.angle_deg), _closed(found.acceleration, 0), _closed(bound, 0)
    return found.angle_deg, found.acceleration, bound


def _spline(
    found: SmoothedTable, rate: float, error_mm: float | None
) -> tuple[Floats, Floats, Floats]:
    """Return many angles, the acceleration there, and the root mean square of what is open."""
    places, bars = found.table.angle_deg, found.acceleration_rms(rate, error_mm)
    if found.table.is_cycle:
        places, bars = _closed(places), _closed(bars, 0)
    angle = np.linspace(places[0], places[-1], _PLACES)
    values = np.asarray(found.at(angle, 2, rate_per_hour=rate))
    return angle, values, np.interp(angle, places, bars)


def _closed(values: Floats, more: float = DEG_PER_TURN) -> Floats:
    """Return a turn with its first value, and so much `more`, at its end again."""
    return np.append(values, values[0] + more)
