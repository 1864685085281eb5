"""Pictures of limits: what is proved to be out of reach, what was reached, and how it is proved.

A limit is computed at some points. Between two of them it is drawn as the step that is proved
there, never as a chord: a chord of a curve that bends up lies above it, and would shade motions
that exist. The colours have roles: grey is out of reach, blue the best that was found, orange a
design with a named law.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from mpl_toolkits.axes_grid1 import make_axes_locatable  # type: ignore[import-untyped]

from cammotion.arguments import checked
from cammotion.limits.least import LeastAcceleration
from cammotion.machine.diagram import TimingDiagram, name_of
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import POSITION
from cammotion.quantities import Floats, InputError, Quantity, shorten
from cammotion.views.broken import BROKEN
from cammotion.views.names import TITLE, add_legend, labels, name_line, plain
from cammotion.views.pictures import blank_axes
from cammotion.views.plots import COLOURS, REFERENCE_STYLE, style_axes, style_line, write
from cammotion.whole.least_peak import LeastPeak

BEST, NAMED = COLOURS[:2]
OUT_OF_REACH = "#e4e4e4"
_DARK = "#555555"
_GAP = 0.042  # between two labels, of the height of the picture
_NEAR = 0.2  # of its width: labels of points so near to each other keep their distance

_PEAK = Quantity("peak acceleration", "m/s²", example=0.7)
_END = Quantity("end of an axis", "m/s2", example=1.5, low_included=True)
Pair = tuple[float, float]


@checked
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
    limit. Raises InputError for fewer than two limits.

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
    name = _called(best[0])
    ax = _square(ax, (7.5, 4.6), f"peak jerk of the {name} in m/s³", name)
    reached = np.array([each.reached for each in best])
    _shade(ax, limits, np.array([each.bound for each in best]))
    ax.plot(limits, reached, color=BEST, linewidth=2, label="least peak that was reached")
    if unlimited_m_per_s2 is not None:
        unlimited = _PEAK.number(unlimited_m_per_s2)
        ax.axhline(unlimited, color=_DARK, linestyle="--", linewidth=1.5)
        text = f"jerk without limit: {unlimited:.3f}"
        ax.annotate(text, (limits[-1], unlimited), (-4, -5), **_OFFSET, ha="right", va="top")
    shown = {law: point for law, point in (named or {}).items() if point[0] <= limits[-1]}
    heights = [*reached, *[point[1] for point in shown.values()]]
    ax.set(xlim=limits[[0, -1]], ylim=(min(heights) - 0.16, max(heights) + 0.06))
    ax.plot(*_columns(shown.values()), "o", color=NAMED, label="named laws")
    _label_points(ax, shown)
    add_legend(ax, loc="upper right")
    return ax


@checked
def plot_front(
    found: Iterable[LeastPeak],
    curves: Mapping[str, Iterable[Pair]] | None = None,
    points: Mapping[str, Pair] | None = None,
    *,
    ends_m_per_s2: Pair = (0.3, 1.5),
    ax: Axes | None = None,
) -> Axes:
    """Draw what two mechanisms can have at best, the peak of one against the other's.

    `found` are results of `least_peak` for the same two mechanisms, at least two, with other
    limits or weights. Of each this is proved: in no motions of both are both peaks below its bound
    and its limit, which are a corner of what is drawn in grey. The blue line joins the pairs that
    were reached. `curves` are dashed orange ones of (one peak, other peak) in m/s2, by name,
    `points` single ones; `ends_m_per_s2` are the ends of both axes. Returns the Axes; raises
    InputError for fewer than two results, and for such as are not of two mechanisms.

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
    results = [*found]
    names = {each.parts for each in results}
    if len(results) < 2 or len(names) > 1 or len(results[0].parts) != 2:  # noqa: PLR2004
        raise InputError(
            "A front is a curve of two mechanisms: give at least two results of least_peak for "
            "the same two, for example with other limits at_most={'mill': 0.6}."
        )
    low, high = (_END.number(end) for end in ends_m_per_s2)
    if low >= high:
        raise InputError(
            f"The ends of the axes are {low:g} and {high:g} m/s2: give the lower one first, for "
            "example (0.3, 1.5)."
        )
    one, other = (_label(results[0].diagram, name) for name in results[0].parts)
    ax = _square(ax, (6, 5.6), f"peak acceleration of the {one} in m/s²", other)
    sides, heights = _columns(sorted(tuple(_corner(each)) for each in results))
    heights = np.maximum.accumulate(heights[::-1])[::-1]  # of all corners to the right
    _shade(ax, np.append(0.0, sides), np.append(heights[0], heights))
    reached = sorted(
        tuple(map(each.design.peak_acceleration, each.parts)) for each in results if each.design
    )
    ax.plot(*_columns(reached), color=BEST, linewidth=2)
    ax.lines[-1].set_label("the best that was found, any law")
    for name, label in _labelled(curves or {}):
        ax.plot(*_columns((curves or {})[name]), "--", color=NAMED, linewidth=2)
        name_line(ax.lines[-1], label, name)
    ax.plot([0, high], [0, high], ":", color=_DARK, label="both equally hard driven")
    for name, label in _labelled(points or {}):
        point = (points or {})[name]
        ax.plot(*point, "o", color=NAMED)
        plain(ax.annotate(label, point, (8, 4), **_OFFSET))
    ax.set(xlim=(low, high), ylim=(low, high), aspect="equal")
    add_legend(ax, loc="upper right")
    return ax


@checked
def plot_detour(  # noqa: PLR0913 - each is a part of the picture
    designs: Mapping[str, TimingDiagram],
    motion: str | Motion,
    *,
    still: Pair,
    corners: tuple[Pair, Pair],
    usual_mm: float | None = None,
    with_acceleration: bool = False,
    ax: Axes | None = None,
) -> Axes:
    """Draw how a motion leaves its place, gets over two corners and comes back; return the Axes.

    The height y in mm, counted from where the motion stands from `still[0]` to
    `still[1]` deg, is drawn over u, the cam angle in deg from `still[1]` on, for each of the
    `designs` by name; the upper axis has the cam angle itself. `corners` are two points (u, y):
    the region below them, which no motion may enter, is hatched, and the middle between them is
    the mirror line. `usual_mm` is drawn as the height that was meant; `with_acceleration` adds the
    acceleration in m/s2 below, upwards positive. Raises InputError for no design, and for a motion
    that a diagram lacks.

    >>> import cammotion as cm
    >>> ax = plot_detour(
    ...     {"cycloid": cm.EXAMPLE.diagram}, "die", still=(205, 305), corners=((70, 31), (190, 31)))
    >>> ax.get_ylabel()
    'height y of the die in mm'
    """
    if not designs:
        raise InputError("There is no design to draw: give a TimingDiagram, or several by name.")
    name = name_of(motion)
    start, span = still[1], (still[0] - still[1]) % DEG_PER_TURN
    if not span:
        raise InputError(
            f"The {name} stands from {still[0]:g} to {still[1]:g} deg, which is no time or the "
            "whole turn: give where it stands, for example still=(205, 305)."
        )
    u = np.linspace(0, span, 1041)[:-1]  # where it is back it stands, without acceleration
    if ax is None:
        height = 5.4 if with_acceleration else 3.4
        ax = blank_axes(7.5, height)
    names = next(iter(designs.values())).names
    called = dict(zip(names, labels(names), strict=True)).get(name, "")
    style_axes(ax, "", f"height y of the {called} in mm")
    lower = ax
    if with_acceleration:
        lower = make_axes_locatable(ax).append_axes("bottom", size=1.5, pad=0.2, sharex=ax)
        style_axes(lower, "", "acceleration\nin m/s²")
        ax.tick_params(labelbottom=False)
    for number, (label, (title, design)) in enumerate(
        zip(labels([*designs], TITLE), designs.items(), strict=True)
    ):
        way = design.position_mm(name, start + u) - design.position_mm(name, start)
        up = 1 if way[np.abs(way).argmax()] > 0 else -1
        name_line(style_line(ax.plot(u, up * way)[0], number), label, title)
        if with_acceleration:
            acceleration = up * design.acceleration(name, start + u)
            line = style_line(lower.plot(u, acceleration)[0], number)
            name_line(line, label, title)
    _draw_corners(ax, corners)
    if usual_mm is not None:
        usual_mm = POSITION.number(usual_mm)
        ax.axhline(usual_mm, **REFERENCE_STYLE)
        write(ax, f"{usual_mm:g} mm", (0, usual_mm), REFERENCE_STYLE["color"], offset=(2, -16))
    places = [0, corners[0][0], sum(corner[0] for corner in corners) / 2, corners[1][0], span]
    lower.set_xticks(places)
    lower.set_xlabel(f"u, the cam angle from {start:g} deg on, in deg", fontsize=11)
    above = ax.secondary_xaxis("top")
    above.set_xticks(places, [f"{(start + place) % DEG_PER_TURN:g}" for place in places])
    above.set_xlabel("cam angle in deg", fontsize=11)
    ax.set(xlim=(0, span), ylim=(0, 1.25 * ax.get_ylim()[1]))
    add_legend(ax, loc="upper right")
    return ax


@checked
def plot_weight(
    weight: sp.Expr, span: tuple[sp.Symbol, float, float], *, ax: Axes | None = None
) -> Axes:
    """Draw a weight of the acceleration over the cam angle; return the Axes.

    `weight` is an expression in deg, and `span` the symbol in it and its ends in deg. Its area,
    which is shaded and counted positive on both sides of zero, times the peak acceleration is the
    most that can be reached.

    >>> u = sp.Symbol("u")
    >>> plot_weight(65 - u, (u, 0, 130)).get_ylabel()
    'weight in deg'
    """
    symbol, low, high = span
    places = np.linspace(float(low), float(high), 1041)
    if weight.free_symbols - {symbol} or (not weight.is_extended_real and not weight.free_symbols):
        raise InputError(
            f"The weight is {shorten(weight)}: give a real expression in {symbol} alone."
        )
    heights = np.broadcast_to(sp.lambdify(symbol, weight)(places), places.shape)
    if ax is None:
        ax = blank_axes(7.5, 2.4, layout="constrained")
    style_axes(ax, f"{symbol} in deg", "weight in deg")
    style_line(ax.plot(places, heights)[0], 0)
    ax.fill_between(places, heights, color=BEST, alpha=0.25, linewidth=0)
    ax.axhline(0, color="#000000", linewidth=0.8)
    ax.set_xlim(low, high)
    return ax


def _draw_corners(ax: Axes, corners: tuple[Pair, Pair]) -> None:
    """Hatch what is below two corners, and draw the line in the middle between them."""
    (from_u, _), (to_u, _) = corners
    ax.fill_between(*_columns(corners), **BROKEN, alpha=0.6, linewidth=0)
    ax.plot(*_columns(corners), "o", color=BROKEN["edgecolor"])
    for u, y in corners:
        write(ax, f"({u:g}, {y:g})", (u, y), BROKEN["edgecolor"], offset=(8, 4))
    middle = (from_u + to_u) / 2
    ax.axvline(middle, **REFERENCE_STYLE)
    write(ax, "mirror line", (middle, corners[0][1] / 2), REFERENCE_STYLE["color"], offset=(6, 0))


_OFFSET: dict[str, Any] = {"textcoords": "offset points", "color": "#333333", "fontsize": 10}


def _square(ax: Axes | None, size: Pair, xlabel: str, name: str) -> Axes:
    if ax is None:
        ax = blank_axes(*size, layout="constrained")
    style_axes(ax, xlabel, f"peak acceleration of the {name} in m/s²")
    return ax


def _shade(ax: Axes, x: Floats, bound: Floats) -> None:
    """Shade what is below a falling bound, known at some x: up to each, the bound at it."""
    ax.fill_between(x, bound, 0, step="pre", color=OUT_OF_REACH, linewidth=0)
    ax.annotate("proved: no motion here", (0.12, 0.03), xycoords="axes fraction", color=_DARK)


def _corner(found: LeastPeak) -> list[float]:
    """Return two peaks in m/s2 that no motions of both parts are below: a limit, or the bound."""
    return [
        found.bound / weight if weight else found.at_most[name]
        for name, weight in found.weights.items()
    ]


def _columns(points: Iterable[Sequence[float]]) -> Floats:
    return np.array([*points], dtype=np.float64).reshape(-1, 2).T


def _label_points(ax: Axes, points: Mapping[str, Pair]) -> None:
    """Write names to the right of points, from below upwards, none over another."""
    width, height = np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim())
    placed: list[Pair] = []
    for name, label in sorted(_labelled(points), key=lambda pair: points[pair[0]][1]):
        x, y = points[name]
        near = [at[1] for at in placed if abs(at[0] - x) < _NEAR * width]
        level = max([y, *[at + _GAP * height for at in near]])
        placed.append((x, level))
        written = ax.annotate(
            label,
            (x, y),
            (x + 0.04 * width, level),
            fontsize=10,
            color="#333333",
            va="center",
            arrowprops={"arrowstyle": "-", "color": "#999999"},
        )
        plain(written)


def _called(found: LeastAcceleration) -> str:
    """Return what the motion of a result is called in a picture."""
    return _label(found.design, found.motion.name)


def _label(diagram: TimingDiagram, name: str) -> str:
    return dict(zip(diagram.names, labels(diagram.names), strict=True))[name]


def _labelled(given: Iterable[str]) -> list[tuple[str, str]]:
    """Return names, each with the short one that is written for it."""
    names = [*given]
    return [*zip(names, labels(names, TITLE), strict=True)]
