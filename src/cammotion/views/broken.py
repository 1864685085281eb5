"""Broken rules in a timing diagram: marked on the two mechanisms that each is about, and named."""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import Rectangle

from cammotion.machine.arcs import Arc, arcs
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import plural
from cammotion.rules.rule import Rule, Violation
from cammotion.views.displacement import curve_angles, displacement
from cammotion.views.lanes import LANE_SHARE, SHARED_AXIS
from cammotion.views.names import MOST, as_label, plain, printable, short

BROKEN: dict[str, Any] = {"facecolor": "#f9c9c0", "edgecolor": "#b3200e", "hatch": "xx"}
_MOST_LINES, _LINE_POINTS, _ABOVE_POINTS = 3, 13, 24  # of what is said above the key
_ROW, _BEYOND = 0.45, 0.12  # half of a row of bars; how far a mark goes beyond its lane
_WIDE = 6.0  # of the mark along a curve, in points


def draw_broken(
    ax: Axes, bars: Axes, diagram: TimingDiagram, violations: Sequence[Violation]
) -> list[Arc]:
    """Mark where rules are broken, on the curves and on the bars; return these arcs of the turn."""
    for rule, where in _by_rule(violations):
        numbers = [diagram.names.index(name) for name in rule.motions]
        mark = _mark_lanes if len(diagram.names) > SHARED_AXIS else _mark_curves
        for start, end in where:
            name = printable(rule.name) or "rule"
            label = as_label(f"{name} broken from {start:.5g} to {end:.5g} deg")
            mark(ax, diagram, numbers, (start, end), label)
            for row in numbers:
                box = (start, row - _ROW), end - start, 2 * _ROW
                bars.add_artist(Rectangle(*box, **BROKEN, linewidth=1, zorder=0.5))
    _say_names(ax, violations)
    return arcs((found.start_deg, found.end_deg) for found in violations)


def _by_rule(violations: Iterable[Violation]) -> Iterator[tuple[Rule, list[Arc]]]:
    found: dict[Rule, list[Arc]] = {}
    for one in violations:
        found.setdefault(one.rule, []).append((one.start_deg, one.end_deg))
    yield from ((rule, arcs(these)) for rule, these in found.items())


def _mark_lanes(
    ax: Axes, diagram: TimingDiagram, numbers: Sequence[int], arc: Arc, label: str
) -> None:
    """Mark the lanes of two mechanisms, and link the marks."""
    style = BROKEN | {"hatch": "x", "linewidth": 1, "zorder": 0.6}
    start, end = arc
    bottoms = [len(diagram.names) - 1 - number for number in numbers]
    for said, bottom in zip((label, ""), bottoms, strict=True):
        box = (start, bottom - _BEYOND), end - start, LANE_SHARE + 2 * _BEYOND
        ax.add_patch(Rectangle(*box, **style, label=said))
    low, high = min(bottoms) + LANE_SHARE + _BEYOND, max(bottoms) - _BEYOND
    link = [[(at, low), (at, high)] for at in arc]
    ax.add_collection(
        LineCollection(link, colors=BROKEN["edgecolor"], linewidths=1, zorder=0.6), autolim=False
    )


def _mark_curves(
    ax: Axes, diagram: TimingDiagram, numbers: Sequence[int], arc: Arc, label: str
) -> None:
    """Mark an arc for all to see, and in it the curves of two mechanisms."""
    start, end = arc
    ax.axvspan(start, end, **BROKEN, linewidth=0, zorder=0.5, label=label)
    style = {"colors": BROKEN["edgecolor"], "linewidths": _WIDE, "alpha": 0.5, "zorder": 1.5}
    for number in numbers:
        motion = diagram.motions[number]
        inside = curve_angles(motion)
        inside = np.array([start, *inside[(inside > start) & (inside < end)], end])
        curve = np.column_stack([inside, displacement(motion, inside)])
        ax.add_collection(LineCollection([curve], **style), autolim=False)


def _say_names(ax: Axes, violations: Sequence[Violation]) -> None:
    """Say above the key which rules with a name are broken."""
    names = list(dict.fromkeys(one.rule.name for one in violations if one.rule.name))
    lines = [f"broken: {short(name, 2 * MOST)}" for name in names[:_MOST_LINES]]
    if len(names) > _MOST_LINES:
        lines[-1] += f" (and {len(names) - _MOST_LINES} more)"
    nameless = len({one.rule for one in violations if not one.rule.name})
    if lines and nameless:
        lines[-1] += f" (and {plural(nameless, 'rule')} without a name)"
    for number, line in enumerate(reversed(lines)):
        text = ax.annotate(
            line,
            (1, 1),
            xycoords="axes fraction",
            xytext=(0, _ABOVE_POINTS + number * _LINE_POINTS),
            textcoords="offset points",
            ha="right",
            fontsize=10,
            color=BROKEN["edgecolor"],
        )
        plain(text)
