"""Pictures of fits, as a workshop draws them: the zero line, and tolerance zones to scale in um."""

from collections.abc import Iterable
from textwrap import fill

import numpy as np
from matplotlib.axes import Axes

from cammotion.arguments import checked
from cammotion.hardware.fits import Fit, Limits
from cammotion.quantities import InputError
from cammotion.views.ends import POINTS_PER_INCH
from cammotion.views.pictures import on_paper
from cammotion.views.plots import COLOURS, styled

HOLE, SHAFT = COLOURS[:2]
_APART, _WIDTH = 4.0, 0.9  # from fit to fit, and how wide a zone is
_INK = "#1b1b1b"
_SIZE, _LINE = 11, 28  # of a text in points, and how many letters a line has
_GAP, _NAME = 3.0, 11.0  # points between a zone and its numbers, and from its name to them
_CLEAR, _ROOM = 0.135, _NAME + 1.2 * _SIZE  # above all zones: by their span, and in points at least


@checked
@on_paper
def plot_fit(fits: Fit | Iterable[Fit], *, ax: Axes | None = None) -> Axes:
    """Draw the tolerance zones of a fit, or of several side by side; return the Axes.

    The zero line is the nominal diameter, and the scale is in um. Of each fit the hole's zone is on
    the left and the shaft's on the right, with the upper and the lower deviation at their ends.
    Beside them arrows span the largest and the smallest clearance, or interference, in um. Raises
    InputError for no fit.

    >>> import cammotion as cm
    >>> plot_fit(cm.Fit("40 H7/g6")).get_ylabel()
    'deviation in µm'
    """
    fits = [fits] if isinstance(fits, Fit) else [*fits]
    if not fits:
        raise InputError("There is no fit to draw: give for example cm.Fit('40 H7/g6').")
    size = 1.6 + 2.9 * len(fits), 4.2
    ax = styled(ax, "", "deviation in µm", size, layout="constrained")
    ax.grid(visible=False, axis="x")
    ax.axhline(0, color=_INK, linewidth=1.5)
    lowest, highest = _span(fits)
    clear = _clear(ax) * (highest - lowest)
    ax.set_ylim(lowest - clear, highest + clear)
    for number, fit in enumerate(fits):
        left = _APART * number
        _draw_zone(ax, left, fit.hole, HOLE, "")
        _draw_zone(ax, left + 1, fit.shaft, SHAFT, "//")
        _draw_arrow(ax, left + 1.9, fit.shaft.lower_um, fit.hole.upper_um)
        _draw_arrow(ax, left + 2.6, fit.shaft.upper_um, fit.hole.lower_um)
    ax.set_xlim(-0.75, _APART * (len(fits) - 1) + 3.1)
    starts = _APART * np.arange(len(fits))
    names = [f"{fit.designation}\n{fill(fit.summary, _LINE)}" for fit in fits]
    ax.set_xticks(starts + 1.2, names, fontsize=_SIZE)
    ax.tick_params(axis="x", length=0)
    return ax


def _clear(ax: Axes) -> float:
    """Return how much is left above and below all zones, by their span: room for a number there."""
    tall = ax.get_window_extent().height * POINTS_PER_INCH / ax.figure.dpi
    return max(_CLEAR, _ROOM / max(tall - 2 * _ROOM, _ROOM))


def _span(fits: Iterable[Fit]) -> tuple[float, float]:
    """Return the lowest and the highest deviation of all, zero among them."""
    parts = [part for fit in fits for part in (fit.hole, fit.shaft)]
    lows, highs = [part.lower_um for part in parts], [part.upper_um for part in parts]
    return min(0, *lows), max(0, *highs)


def _draw_zone(ax: Axes, middle: float, part: Limits, colour: str, hatch: str) -> None:
    """Draw the zone of a hole or a shaft, its name in it and its deviations at its ends."""
    bar = ax.bar(middle, part.width_um, _WIDTH, bottom=part.lower_um, color=colour)
    bar.patches[0].set(hatch=hatch, edgecolor="white", linewidth=0)
    upper, lower = part.signed
    ends = ax.transData.transform([(middle, part.lower_um), (middle, part.upper_um)])
    tall = float(np.ptp(ends[:, 1])) * POINTS_PER_INCH / ax.figure.dpi
    away = max(_GAP, _NAME - tall / 2)
    _write(ax, upper, (middle, part.upper_um), away)
    _write(ax, lower, (middle, part.lower_um), -away)
    box = {"facecolor": "white", "edgecolor": "none", "pad": 1.5}
    level = (part.upper_um + part.lower_um) / 2
    ax.text(
        middle, level, part.zone, bbox=box, ha="center", va="center", color=_INK, fontsize=_SIZE
    )


def _draw_arrow(ax: Axes, at: float, low: float, high: float) -> None:
    """Draw how far it is from the shaft's surface to the hole's: below zero is interference."""
    for level, colour in ((low, SHAFT), (high, HOLE)):
        ax.plot([at - 0.25, at + 0.25], [level, level], color=colour, linewidth=2)
    if high != low:
        arrow = {"arrowstyle": "<->", "color": _INK, "shrinkA": 0, "shrinkB": 0}
        ax.annotate("", (at, high), (at, low), arrowprops=arrow, fontsize=10)
    _write(ax, f"{high - low:g}", (at, max(low, high)))


def _write(ax: Axes, text: str, at: tuple[float, float], away: float = _GAP) -> None:
    """Write a number so many points above a place, or below it."""
    ax.annotate(
        text,
        at,
        (0, away),
        textcoords="offset points",
        ha="center",
        va="bottom" if away > 0 else "top",
        color=_INK,
        fontsize=_SIZE,
        bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.6},
    )
