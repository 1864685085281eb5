"""Pictures of limits: what is proved to be out of reach, and what was reached.

A limit is computed at some points. Between two of them it is drawn as the step that is proved
there, never as a chord: a chord of a curve that bends up lies above it, and would shade motions
that exist. The colours have roles: grey is out of reach, blue the best that was found, orange a
design with a named law.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

from cammotion.limits.least import LeastAcceleration
from cammotion.quantities import Floats, InputError
from cammotion.views.plots import COLOURS, style_axes

BEST, NAMED = COLOURS[:2]
OUT_OF_REACH = "#e4e4e4"
_DARK = "#555555"
_GAP = 0.042  # between two labels, of the height of the picture
_NEAR = 0.2  # of its width: labels of points so near to each other keep their distance

Pair = tuple[float, float]


def plot_jerk_price(
    found: Iterable[LeastAcceleration],
    named: Mapping[str, Pair] | None = None,
    *,
    unlimited: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the least peak acceleration over the limit to the jerk; return the Axes.

    `found` are results of `least_acceleration`, each with another limit to the jerk, at least two.
    Grey is what is proved for all motions: with a jerk between two limits no peak is below the
    bound at the larger one. The blue line joins the peaks that were reached. `named` are the peak
    jerk in m/s3 and the peak acceleration in m/s2 of designs, by name, in orange; those with more
    jerk than the largest limit are left out. `unlimited`, in m/s2, is drawn as the level without a
    limit. Raises InputError for fewer than two limits.

    >>> import cammotion as cm
    >>> found = [
    ...     cm.least_acceleration(
    ...         cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule, still=[(205, 305)], jerk_limit=limit,
    ...         cells=90)
    ...     for limit in (8, 12, 20)]
    >>> plot_jerk_price(found, {"cycloidal": (8.12, 0.806)}).get_xlabel()
    'peak jerk of the die in m/s³'
    """
    best = sorted(found, key=lambda each: each.jerk_limit)
    limits = np.array([each.jerk_limit for each in best])
    if len({*limits}) < 2 or not np.isfinite(limits).all():  # noqa: PLR2004 - a curve has two ends
        raise InputError(
            "The price of a jerk is a curve over the limits to it: give results of "
            "least_acceleration with at least two different jerk limits, for example 8 and 12 m/s³."
        )
    name = best[0].motion.name
    ax = _square(ax, (7.5, 4.6), f"peak jerk of the {name} in m/s³", name)
    reached = np.array([each.reached for each in best])
    _shade(ax, limits, np.array([each.bound for each in best]))
    ax.plot(limits, reached, color=BEST, linewidth=2, label="least peak that was reached")
    if unlimited is not None:
        ax.axhline(unlimited, color=_DARK, linestyle="--", linewidth=1.5)
        text = f"jerk without limit: {unlimited:.3f}"
        ax.annotate(text, (limits[-1], unlimited), (-4, -5), **_OFFSET, ha="right", va="top")
    shown = {law: point for law, point in (named or {}).items() if point[0] <= limits[-1]}
    heights = [*reached, *[point[1] for point in shown.values()]]
    ax.set(xlim=limits[[0, -1]], ylim=(min(heights) - 0.16, max(heights) + 0.06))
    ax.plot(*_columns(shown.values()), "o", color=NAMED, label="named laws")
    _label_points(ax, shown)
    ax.legend(loc="upper right", fontsize=10)
    return ax


def plot_front(
    found: Iterable[tuple[LeastAcceleration, LeastAcceleration]],
    designs: Mapping[str, Iterable[Pair]] | None = None,
    points: Mapping[str, Pair] | None = None,
    *,
    ends: Pair = (0.3, 1.5),
    ax: Axes | None = None,
) -> Axes:
    """Draw what two mechanisms can have at best, the peak of one against the other's.

    `found` are pairs of results of `least_acceleration`, for one mechanism and for the other, over
    what they share between them; at least two pairs. The more the one has, the less is left for
    the other. So between two pairs each has at least its peak where it has more: grey is what is
    proved, in steps. The blue line joins the pairs that were reached. `designs` are dashed orange
    curves of (one peak, other peak) in m/s2, by name, `points` single ones; `ends` are the ends of
    both axes in m/s2. Returns the Axes; raises InputError for fewer than two pairs.

    >>> import cammotion as cm
    >>> found = []
    >>> for angle in (140, 160):
    ...     given = cm.EXAMPLE.diagram.with_motion(cm.with_angle(cm.EXAMPLE.mill, angle))
    ...     asked = {"rules": cm.EXAMPLE.rule, "still": [(205, 305)], "cells": 90}
    ...     die = cm.least_acceleration(given, "die", **asked)
    ...     found.append((cm.least_acceleration(die.design, "mill", **asked), die))
    >>> plot_front(found, points={"notebook 03": (1.117, 0.806)}).get_ylabel()
    'peak acceleration of the die in m/s²'
    """
    pairs = sorted(found, key=lambda pair: pair[0].bound)
    if len(pairs) < 2:  # noqa: PLR2004 - a curve has two ends
        raise InputError(
            "A front is a curve: give at least two pairs of results of least_acceleration."
        )
    one, other = (each.motion.name for each in pairs[0])
    ax = _square(ax, (6, 5.6), f"peak acceleration of the {one} in m/s²", other)
    sides, heights = (np.array([pair[n].bound for pair in pairs]) for n in (0, 1))
    _shade(ax, np.append(0.0, sides), np.append(heights[0], heights))
    ax.plot(*_columns([(a.reached, b.reached) for a, b in pairs]), color=BEST, linewidth=2)
    ax.lines[-1].set_label("the best that was found, any law")
    for name, curve in (designs or {}).items():
        ax.plot(*_columns(curve), "--", color=NAMED, linewidth=2, label=name)
    ax.plot([0, ends[1]], [0, ends[1]], ":", color=_DARK, label="both equally hard driven")
    for name, point in (points or {}).items():
        ax.plot(*point, "o", color=NAMED)
        ax.annotate(name, point, (8, 4), **_OFFSET)
    ax.set(xlim=ends, ylim=ends, aspect="equal")
    ax.legend(loc="upper right", fontsize=10)
    return ax


_OFFSET: dict[str, Any] = {"textcoords": "offset points", "color": "#333333", "fontsize": 10}


def _square(ax: Axes | None, size: Pair, xlabel: str, name: str) -> Axes:
    if ax is None:
        _, ax = plt.subplots(figsize=size, facecolor="white", layout="constrained")
    style_axes(ax, xlabel, f"peak acceleration of the {name} in m/s²")
    return ax


def _shade(ax: Axes, x: Floats, bound: Floats) -> None:
    """Shade what is below a falling bound, known at some x: up to each, the bound at it."""
    ax.fill_between(x, bound, 0, step="pre", color=OUT_OF_REACH, linewidth=0)
    ax.annotate("proved: no motion here", (0.12, 0.03), xycoords="axes fraction", color=_DARK)


def _columns(points: Iterable[Sequence[float]]) -> Floats:
    return np.array([*points], dtype=np.float64).reshape(-1, 2).T


def _label_points(ax: Axes, points: Mapping[str, Pair]) -> None:
    """Write names to the right of points, from below upwards, none over another."""
    width, height = np.ptp(ax.get_xlim()), np.ptp(ax.get_ylim())
    placed: list[Pair] = []
    for name, (x, y) in sorted(points.items(), key=lambda item: item[1][1]):
        near = [at[1] for at in placed if abs(at[0] - x) < _NEAR * width]
        level = max([y, *[at + _GAP * height for at in near]])
        placed.append((x, level))
        ax.annotate(
            name,
            (x, y),
            (x + 0.04 * width, level),
            fontsize=10,
            color="#333333",
            va="center",
            arrowprops={"arrowstyle": "-", "color": "#999999"},
        )
