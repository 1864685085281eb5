"""Pictures of moves and their peaks.

Every function takes the thing to draw and an optional `ax`, labels it with units and returns the
Axes. Colours are told apart by the colour-blind (Okabe and Ito), and never carry a meaning alone:
line styles and direct labels say the same. No global Matplotlib setting is touched.
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from matplotlib.text import Annotation
from matplotlib.ticker import LogLocator, NullLocator

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.machine.kinematics import Move
from cammotion.quantities import Floats, InputError, as_text, one_of
from cammotion.views.corners import corners
from cammotion.views.ends import (
    LINE_INCHES,
    POINTS_PER_INCH,
    apart,
    inches,
    label_ends,
    overfull,
    would_meet,
)
from cammotion.views.names import labels as short_labels
from cammotion.views.names import name_line, plain
from cammotion.views.pictures import blank_axes, on_paper

# six of Okabe and Ito's, which Matplotlib knows as "okabe_ito" only from 3.11 on
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#000000")
LINE_STYLES = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)))
REFERENCE_STYLE: dict[str, Any] = {"color": "#555555", "linestyle": "--", "linewidth": 2}

CURVES = {
    "displacement": "displacement h in mm",
    "velocity": "velocity v in m/s",
    "acceleration": "acceleration a in m/s²",
    "jerk": "jerk j in m/s³",
}
_EVEN = np.linspace(0.0, 1.0, 241)  # of the time of a move
_WIDTH_INCHES, _HEIGHT_INCHES, _BAR_INCHES = 7.5, 4.2, 0.24
WRITTEN = 11  # the size of a name at a curve, in points
_WIDE = 3000  # where a scale ends so many times above its beginning, 20 and 50 have no room
_HIGHER = 1.25  # so many times as high as all others is the bar of an infinite peak


def sample_curve(move: Move, curve: str) -> tuple[Floats, Floats]:
    """Return times in s and the values of a `curve` of the move at them, both of one length.

    The times are even ones, and those at which the curve turns or may jump: no peak lies between.
    `curve` is one of "displacement" (mm), "velocity" (m/s), "acceleration" (m/s2), "jerk" (m/s3).
    Raises InputError for another.

    >>> time, h = sample_curve(Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000), "displacement")
    >>> float(time[-1]), float(h[-1])
    (0.275, 50.0)
    """
    derivative = [*CURVES].index(one_of("curve", curve, CURVES))
    own = corners(as_law(move.law).curve.derived(derivative))
    time = move.time_s * np.union1d(_EVEN, own)
    functions = move.displacement_mm, move.velocity, move.acceleration, move.jerk
    return time, np.asarray(functions[derivative](time))


@checked
@on_paper
def plot_curves(
    moves: Move | Iterable[Move],
    *,
    curve: str = "acceleration",
    labels: Sequence[str] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw one curve of each move against time and return the Axes.

    `curve` is one of "displacement", "velocity", "acceleration" and "jerk"; `labels`, one for each
    move, stand at the end of its curve, or under its lowest place, or all at the side where they
    would meet, and are the indexing angles unless given. Where the peak is infinite, which no curve
    shows, the label says so. Raises InputError for an unknown curve, no move, and labels of another
    number.

    >>> die = Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    >>> plot_curves(die, curve="velocity").get_ylabel()
    'velocity v in m/s'
    """
    moves, labels = _labelled(moves, labels)
    curve = one_of("curve", curve, CURVES)
    height = _HEIGHT_INCHES if len(moves) <= len(COLOURS) else LINE_INCHES * len(moves) / 0.77
    size = _WIDTH_INCHES, max(height, _HEIGHT_INCHES)
    ax = styled(ax, "time t in s", CURVES[curve], size)
    ax.margins(x=0.08, y=0.12)
    lines, said, places, offsets = [], [], [], []
    for number, (move, name) in enumerate(zip(moves, short_labels(labels), strict=True)):
        time, values = sample_curve(move, curve)
        line = style_line(ax.plot(time, values)[0], number)
        lines.append(name_line(line, name, labels[number]))
        said.append(name if math.isfinite(_peak(move, curve)) else f"{name}, peak ∞")
        at, offset = _free_place(time, values)
        places.append((time[at], values[at]))
        offsets.append(offset)
    ax.axhline(0, color="#000000", linewidth=0.8)
    if would_meet(ax, said, places, offsets, WRITTEN):
        label_ends(ax, lines, [height for _, height in places], said)
        return ax
    for number, name in enumerate(said):
        write(ax, name, places[number], colour(number), offsets[number])
    return ax


@checked
@on_paper
def plot_peaks(
    moves: Iterable[Move], *, labels: Sequence[str] | None = None, ax: Axes | None = None
) -> Axes:
    """Draw the peak acceleration of each move as a bar, its value above it; return the Axes.

    `labels`, one for each move, stand under the bars and are the indexing angles unless given;
    where these or the values have no room, the bars lie. The bar of an infinite peak, under the
    sign ∞, is hatched and a quarter longer than all others. Raises InputError for no move, and for
    labels of another number.

    >>> die = Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    >>> plot_peaks([die], labels=["die"]).get_ylabel()
    'peak acceleration a_max in m/s²'
    """
    across, up = "" if labels else "indexing angle Bm", "peak acceleration a_max in m/s²"
    moves, labels = _labelled(moves, labels)
    names = short_labels(labels)
    peaks = np.array([move.peak_acceleration for move in moves])
    values = [as_text(peak, "#.3g") for peak in peaks]
    width = 0.775 * _WIDTH_INCHES if ax is None else inches(ax)[0]
    is_flat = overfull(names, width) or overfull(values, width)
    height = max(_HEIGHT_INCHES, _BAR_INCHES * len(names) / 0.77) if is_flat else _HEIGHT_INCHES
    ax = styled(ax, *((up, across) if is_flat else (across, up)), (_WIDTH_INCHES, height))
    highest = max(peaks[np.isfinite(peaks)], default=1.0)
    heights = np.where(np.isfinite(peaks), peaks, _HIGHER * highest)
    places = range(len(names))
    draw = ax.barh if is_flat else ax.bar
    bars = draw(places, heights, 0.6, color=COLOURS[0])
    axis = ax.yaxis if is_flat else ax.xaxis
    axis.set_ticks(places, names)
    plain(*axis.get_ticklabels())
    if is_flat:
        ax.invert_yaxis()
    for bar, peak in zip(bars, peaks, strict=True):
        bar.set(hatch="" if math.isfinite(peak) else "//", edgecolor="white", linewidth=0)
    ax.bar_label(bars, values, padding=3, fontsize=11, color="black")
    ax.margins(x=0.12 if is_flat else None, y=None if is_flat else 0.12)
    ax.grid(visible=False, axis="y" if is_flat else "x")
    return ax


@checked
@on_paper
def plot_inverse_square(moves: Iterable[Move], *, ax: Axes | None = None) -> Axes:
    """Draw peak acceleration against indexing angle on logarithmic scales; return the Axes.

    The moves are the points. The line over them is the law a_max ~ 1/Bm^2, put through the first
    move alone: that the other points lie on it is the evidence. The moves may differ only in
    their angle, and their peaks are finite; for others it raises InputError.

    >>> angles = 55, 110
    >>> dies = [Move(stroke_mm=50, angle_deg=angle, rate_per_hour=2000) for angle in angles]
    >>> [text.get_text() for text in plot_inverse_square(dies).texts[:2]]
    ['55°: 4.15', '110°: 1.04']
    """
    moves, _ = _labelled(moves, None)
    first = moves[0]
    if any(replace(move, angle_deg=first.angle_deg) != first for move in moves):
        raise InputError(
            "The moves differ in more than their angle: give them one stroke, one machine rate "
            "and one law, or the inverse-square law of the angle cannot be seen."
        )
    if math.isinf(first.peak_acceleration):
        raise InputError(
            "The peak acceleration of these moves is infinite at any angle, because the velocity "
            "of their law jumps: give moves by a law with a finite Ca, for example 'cycloidal'."
        )
    size = _WIDTH_INCHES, _HEIGHT_INCHES
    ax = styled(ax, "indexing angle Bm in deg", "peak acceleration a_max in m/s²", size)
    angles = np.array([move.angle_deg for move in moves])
    line = np.geomspace(angles.min() / 1.3, angles.max() * 1.3, 2)
    law = first.peak_acceleration * (first.angle_deg / line) ** 2
    ax.loglog(line, law, color=COLOURS[1], linestyle="--", linewidth=2)
    peaks = [move.peak_acceleration for move in moves]
    ax.loglog(angles, peaks, "o", color=COLOURS[0], markersize=9)
    ax.set_xlim(line[0], line[1] * 1.25)
    _plain_ticks(ax)
    heights = ax.transData.transform([*zip(angles, peaks, strict=True)])[:, 1]
    heights *= POINTS_PER_INCH / ax.figure.dpi
    raised = apart(heights, LINE_INCHES * POINTS_PER_INCH, -math.inf, math.inf) - heights
    raised -= min(raised.min(), 0.0)  # no name comes down upon a point
    for angle, peak, up in zip(angles, peaks, raised, strict=True):
        write(ax, f"{angle:g}°: {as_text(peak, '#.3g')}", (angle, peak), offset=(8, 4 + up))
    middle = np.sqrt(line.prod())
    on_line = (middle, law[0] * (line[0] / middle) ** 2)
    write(ax, "slope −2:\ntwice the angle,\na quarter", on_line, COLOURS[1], offset=(-8, -54))
    return ax


def styled(
    ax: Axes | None, xlabel: str, ylabel: str, size: tuple[float, float], *, layout: Any = "none"
) -> Axes:
    """Return the axes with the workbook's look; without any those of a new picture, in inches."""
    ax = blank_axes(*size, layout=layout) if ax is None else ax
    style_axes(ax, xlabel, ylabel)
    return ax


def style_axes(ax: Axes, xlabel: str, ylabel: str) -> None:
    """Give the axes the workbook's look: labels, grid, readable text, no box."""
    ax.set_facecolor("white")
    ax.set_xlabel(xlabel, fontsize=11)
    ax.set_ylabel(ylabel, fontsize=11)
    plain(ax.xaxis.label, ax.yaxis.label)
    ax.tick_params(labelsize=10)
    ax.grid(visible=True, color="#dddddd", linewidth=0.8)
    ax.set_axisbelow(True)
    ax.spines[["top", "right"]].set_visible(False)


def style_line(line: Line2D, number: int) -> Line2D:
    """Give a line the colour and the dashes of its number."""
    line.set(color=colour(number), linestyle=dashes_of(number), linewidth=2)
    return line


def dashes_of(number: int) -> Any:
    """Return the line style of a number: where a colour comes again it has other dashes.

    >>> colour(0) == colour(6), dashes_of(0), dashes_of(6)
    (True, '-', '--')
    """
    return LINE_STYLES[(number + number // len(COLOURS)) % len(LINE_STYLES)]


def colour(number: int) -> str:
    """Return the colour of the line with that number, the first being 0."""
    return COLOURS[number % len(COLOURS)]


def dark(number: int) -> tuple[float, float, float]:
    """Return the colour of that number for a text, red, green and blue from 0 to 1."""
    return mixed(colour(number), "black", 0.4)


def mixed(name: str, other: str, share: float) -> tuple[float, float, float]:
    """Return red, green and blue, 0 to 1, of a colour with a share of another in it.

    >>> mixed("#000000", "white", 0.75)
    (0.75, 0.75, 0.75)
    """
    pairs = zip(to_rgb(name), to_rgb(other), strict=True)
    red, green, blue = ((1 - share) * part + share * more for part, more in pairs)
    return red, green, blue


def write(
    ax: Axes,
    text: str,
    at: tuple[float, float],
    color: str = "#000000",
    offset: tuple[float, float] = (0, 6),
) -> Annotation:
    """Write a text as it is beside a point, `offset` in points (1/72 inch), also over curves."""
    written = ax.annotate(
        text,
        at,
        offset,
        textcoords="offset points",
        color=color,
        fontsize=WRITTEN,
        ha="left" if offset[0] > 0 else "right" if offset[0] else "center",
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 1},
    )
    plain(written)
    return written


def _free_place(time: Floats, values: Floats) -> tuple[int, tuple[float, float]]:
    """Return where a curve's label is not in the way of others: the sample, and how far off it.

    Curves of moves that all begin at 0 s lie over one another where they are high, and apart
    where they brake.
    """
    if values.min() >= 0:
        return -1, (0, 6)
    lowest = np.flatnonzero(values <= values.min() * (1 - 1e-9))
    middle = np.searchsorted(time[lowest], time[lowest].mean())
    return int(lowest[middle]), (0, -17)


def _labelled(
    moves: Move | Iterable[Move], labels: Sequence[str] | None
) -> tuple[list[Move], list[str]]:
    moves = [moves] if isinstance(moves, Move) else [*moves]
    if not moves:
        raise InputError(
            "There is nothing to draw: give one Move or a list of them, for example "
            "[Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)]."
        )
    if labels is None:
        labels = [f"{move.angle_deg:g}°" for move in moves]
    if len(labels) != len(moves):
        raise InputError(
            f"There are {len(moves)} moves but {len(labels)} labels: give one label for each move."
        )
    return moves, list(labels)


def _peak(move: Move, curve: str) -> float:
    return move.stroke_mm if curve == "displacement" else float(getattr(move, f"peak_{curve}"))


def _plain_ticks(ax: Axes) -> None:
    """Write 50 and 0.5 on logarithmic axes where Matplotlib would write powers of ten."""
    for axis in (ax.xaxis, ax.yaxis):
        low, high = axis.get_view_interval()
        subs = (1, 2, 5) if high < _WIDE * low else (1,)
        axis.set_major_locator(LogLocator(subs=subs))
        axis.set_minor_locator(NullLocator())
        axis.set_major_formatter(lambda value, _: as_text(value, "g"))
