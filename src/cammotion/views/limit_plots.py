"""Pictures of limits: what is proved to be out of reach, and what was reached.

A limit is computed at some points. Between two of them it is drawn as the step that is proved
there, never as a chord: a chord of a curve that bends up lies above it, and would shade motions
that exist. The colours have roles: grey is out of reach, blue the best that was found, orange a
design with a named law.
"""

import operator
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from cammotion.arguments import checked
from cammotion.limits.least import LeastAcceleration
from cammotion.quantities import Floats, InputError, Quantity, in_decimals
from cammotion.views.ends import POINTS_PER_INCH, Pair, inches
from cammotion.views.named import labels_of
from cammotion.views.names import (
    TITLE,
    add_legend,
    by_name,
    labels,
    name_line,
    names_that_fit,
    plain,
    text_px,
)
from cammotion.views.pictures import on_paper
from cammotion.views.plots import COLOURS, styled
from cammotion.whole.least_peak import LeastPeak

BEST, NAMED = COLOURS[:2]
OUT_OF_REACH = "#e4e4e4"
_DARK = "#555555"
_GAP = 0.042  # between two labels, of the height of the picture
_NEAR = 0.2  # of its width: labels of points so near to each other keep their distance
_AWAY, _SIZE = 0.04, 10  # of a label: how far from its point, of the width, and its size

_PEAK = Quantity("peak acceleration", "m/s²", example=0.7)
_END = Quantity("end of an axis", "m/s2", example=1.5, low_included=True)
_BELOW, _ABOVE = 0.18, 0.14  # room for words, as shares of what is drawn between
_AROUND = 1.5  # as far beyond the ends of a front the axes go


@checked
@on_paper
def plot_jerk_price(
    found: Iterable[LeastAcceleration],
    named: Mapping[str, Pair] | None = None,
    *,
    unlimited_m_per_s2: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the least peak acceleration over the limit to the jerk; return the Axes.

    `found` are results of `least_acceleration`, each with another limit to the jerk, at least two.
    Grey is what is proved for all motions: with a jerk between two limits no peak is below the
    bound at the larger one. The blue line joins the peaks that were reached. `named` are the peak
    jerk in m/s3 and the peak acceleration in m/s2 of designs, by name, in orange; those with more
    jerk than the largest limit are left out. `unlimited_m_per_s2` is drawn as the level without a
    limit. Raises InputError for fewer than two limits, and for results of several mechanisms.

    >>> import cammotion as cm
    >>> found = [
    ...     cm.least_acceleration(
    ...         cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule, still=[(205, 305)], jerk_m_per_s3=limit,
    ...         cells=90)
    ...     for limit in (8, 12, 20)]
    >>> plot_jerk_price(found, {"cycloidal": (8.12, 0.806)}).get_xlabel()
    'peak jerk of the die in m/s³'
    """
    best = sorted(found, key=lambda each: each.jerk_m_per_s3)
    limits = np.array([each.jerk_m_per_s3 for each in best])
    if len({*limits}) < 2 or not np.isfinite(limits).all():  # noqa: PLR2004 - a curve has two ends
        raise InputError(
            "The price of a jerk is a curve over the limits to it: give results of "
            "least_acceleration with at least two different jerk limits, for example 8 and 12 m/s³."
        )
    if len(names := {each.motion.name for each in best}) > 1:
        raise InputError(
            f"The price of a jerk is that of one mechanism, and these results are for {len(names)}"
            ": give results of least_acceleration for the same one."
        )
    unlimited = None if unlimited_m_per_s2 is None else _PEAK.number(unlimited_m_per_s2)
    name = labels_of(best[0].design)[best[0].motion.name]
    across, up = f"peak jerk of the {name} in m/s³", f"peak acceleration of the {name} in m/s²"
    ax = styled(ax, across, up, (7.5, 4.6), layout="constrained")
    reached = np.array([each.reached for each in best])
    _shade(ax, limits, np.array([each.bound for each in best]))
    ax.plot(limits, reached, color=BEST, linewidth=2, label="least peak that was reached")
    shown = {law: point for law, point in (named or {}).items() if point[0] <= limits[-1]}
    heights = [*reached, *[point[1] for point in shown.values()]]
    if unlimited is not None:
        ax.axhline(unlimited, color=_DARK, linestyle="--", linewidth=1.5)
        text = f"jerk without limit: {in_decimals(unlimited, 3)}"
        ax.annotate(text, (limits[-1], unlimited), (-4, -5), **_OFFSET, ha="right", va="top")
        heights.append(unlimited)
    ax.set(xlim=limits[[0, -1]], ylim=_room(min(heights), max(heights)))
    ax.plot(*_columns(shown.values()), "o", color=NAMED, label="named laws")
    _label_points(ax, shown)
    add_legend(ax, loc="upper right")
    return ax


@checked
@on_paper
def plot_front(
    found: Iterable[LeastPeak],
    curves: Mapping[str, Iterable[Pair]] | None = None,
    points: Mapping[str, Pair] | None = None,
    *,
    ends_m_per_s2: Pair | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw what two mechanisms can have at best, the peak of one against the other's.

    `found` are results of `least_peak` for the same two mechanisms, at least two, with other
    limits or weights. Of each this is proved: in no motions of both are both peaks below its bound
    and its limit, which are a corner of what is drawn in grey. The blue line joins the pairs that
    were reached. `curves` are dashed orange ones of (one peak, other peak) in m/s2, by name,
    `points` single ones; `ends_m_per_s2` are the ends of both axes, around what was reached unless
    given. Returns the Axes; raises InputError for fewer than two results, and for such as are not
    of two mechanisms.

    >>> import cammotion as cm
    >>> asked = {
    ...     "rules": cm.EXAMPLE.rule, "still": {"mill": [(205, 305)], "die": [(205, 305)]},
    ...     "weights": {"mill": 0}, "gap": 0.1, "seconds": 9}
    >>> found = [
    ...     cm.least_peak(cm.EXAMPLE.diagram, at_most={"mill": limit}, **asked)
    ...     for limit in (0.5, 0.6)]
    >>> plot_front(found, points={"notebook 03": (1.117, 0.806)}).get_ylabel()
    'peak acceleration of the die in m/s²'
    """
    results, curves, points = [*found], curves or {}, points or {}
    _check_front(results)
    corners = sorted(tuple(_corner(each)) for each in results)
    reached = sorted(
        tuple(map(each.design.peak_acceleration, each.parts)) for each in results if each.design
    )
    low, high = (_END.number(end) for end in ends_m_per_s2 or _around([*corners, *reached]))
    if low >= high:
        raise InputError(
            f"The ends of the axes are {low:g} and {high:g} m/s2: give the lower one first, for "
            "example (0.3, 1.5)."
        )
    called = labels_of(results[0].diagram)
    across, up = (f"peak acceleration of the {called[name]} in m/s²" for name in results[0].parts)
    ax = styled(ax, across, up, (6, 5.6), layout="constrained")
    sides, heights = _columns(corners)
    heights = np.maximum.accumulate(heights[::-1])[::-1]  # of all corners to the right
    _shade(ax, np.append(0.0, sides), np.append(heights[0], heights))
    ax.plot(*_columns(reached), color=BEST, linewidth=2, label="the best that was found, any law")
    for name, label in by_name(curves, TITLE).items():
        ax.plot(*_columns(curves[name]), "--", color=NAMED, linewidth=2)
        name_line(ax.lines[-1], label, name)
    ax.plot([0, high], [0, high], ":", color=_DARK, label="both equally hard driven")
    ax.set(xlim=(low, high), ylim=(low, high), aspect="equal")
    for point in points.values():
        ax.plot(*point, "o", color=NAMED)
    _label_points(ax, points)
    add_legend(ax, loc="upper right")
    return ax


def _check_front(results: Sequence[LeastPeak]) -> None:
    """Raise InputError for what is not at least two results for the same two mechanisms."""
    names = {each.parts for each in results}
    if len(results) < 2 or len(names) > 1 or len(results[0].parts) != 2:  # noqa: PLR2004
        raise InputError(
            "A front is a curve of two mechanisms: give at least two results of least_peak for "
            "the same two, for example with other limits at_most={'mill': 0.6}."
        )


def _room(low: float, high: float) -> Pair:
    """Return the ends of an axis on which values from low to high leave room for words."""
    size = max(high - low, 0.1 * high)
    return max(low - _BELOW * size, 0.0), high + _ABOVE * size


def _around(pairs: Iterable[Sequence[float]]) -> Pair:
    """Return round ends of both axes some way beyond all peaks of pairs that are finite."""
    peaks = [peak for pair in pairs for peak in pair if 0 < peak < np.inf]
    low, high = min(peaks, default=0.3) / _AROUND, max(peaks, default=1.0) * _AROUND
    return float(f"{low:.2g}"), float(f"{high:.2g}")


_OFFSET: dict[str, Any] = {"textcoords": "offset points", "color": "#333333", "fontsize": 10}


def _shade(ax: Axes, x: Floats, bound: Floats) -> None:
    """Shade what is below a falling bound, known at some x: up to each, the bound at it."""
    ax.fill_between(x, bound, 0, step="pre", color=OUT_OF_REACH, linewidth=0)
    place: dict[str, Any] = {"xycoords": "axes fraction", "color": _DARK, "fontsize": 10}
    ax.annotate("proved: no motion here", (0.12, 0.03), **place)


def _corner(found: LeastPeak) -> list[float]:
    """Return two peaks in m/s2 that no motions of both parts are below: a limit, or the bound."""
    return [
        found.bound / weight if weight else found.at_most[name]
        for name, weight in found.weights.items()
    ]


def _columns(points: Iterable[Sequence[float]]) -> Floats:
    return np.array([*points], dtype=np.float64).reshape(-1, 2).T


def _label_points(ax: Axes, points: Mapping[str, Pair]) -> None:
    """Write names beside points, from below upwards, none over another nor beyond the axes."""
    left, right = ax.get_xlim()
    width, height = right - left, np.ptp(ax.get_ylim())
    point = width / (POINTS_PER_INCH * inches(ax)[0])

    def longs(names: Iterable[str]) -> list[float]:
        return [_AWAY * width + point * text_px(name, _SIZE) for name in names]

    rooms = [max(x - left, right - x) for x, _ in points.values()]
    called = names_that_fit(
        [*points],
        lambda names: all(map(operator.le, longs(names), rooms)),
        most=TITLE,
        called=labels,
    )
    placed: list[tuple[float, float, float]] = []
    named = zip(points.values(), called, longs(called), strict=True)
    for (x, y), label, long in sorted(named, key=lambda each: each[0][1]):
        way = 1 if long <= right - x or right - x >= x - left else -1
        low, high = sorted((x, x + way * max(long, _NEAR * width)))
        near = [at for one, other, at in placed if one < high and low < other]
        level = max([y, *[at + _GAP * height for at in near]])
        placed.append((low, high, level))
        written = ax.annotate(
            label,
            (x, y),
            (x + way * _AWAY * width, level),
            fontsize=_SIZE,
            color="#333333",
            ha="left" if way > 0 else "right",
            va="center",
            arrowprops={"arrowstyle": "-", "color": "#999999"},
        )
        plain(written)
        written.set_in_layout(False)
