"""Pictures of timing diagrams and of clearances, with units at every axis."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Rectangle
from mpl_toolkits.axes_grid1 import make_axes_locatable  # type: ignore[import-untyped]

from cammotion.arguments import checked
from cammotion.machine.arcs import Arc, arcs
from cammotion.machine.clearance import ClearanceRule, Condition, as_rules, find_violations
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import InputError, Quantity, one_of
from cammotion.views.displacement import SAMPLED_DEGS, curve_angles, displacement
from cammotion.views.pictures import blank_axes
from cammotion.views.plots import CURVES, colour, mixed, style_axes, style_line, write

TICK_DEG = 30
SHARED_AXIS = 4  # so many curves can be told apart on one scale; more get a lane each
LANE = 0.75  # the share of a lane that a curve fills
BAR_INCHES, ROW_INCHES = 0.33, 1.4
DOT_DEG, LABELLED_DOT_DEG = 5, 15
ROOM = 0.03  # of an axis, so that it does not hide a path along it
ROWS: dict[str, Callable[[TimingDiagram, str, Any], Any]] = {
    "velocity": TimingDiagram.velocity,
    "acceleration": TimingDiagram.acceleration,
    "jerk": TimingDiagram.jerk,
}
HATCHES = {"rise": "///", "return": "\\\\\\", "dwell": ""}
OVERLAP: dict[str, Any] = {"facecolor": "#e4e4e4", "edgecolor": "#9a9a9a", "hatch": "..."}
BROKEN: dict[str, Any] = {"facecolor": "#f9c9c0", "edgecolor": "#b3200e", "hatch": "xx"}
_SPAN = Quantity("span of the axis", "mm", example=5)
_NARROWEST_LABEL_DEG = 12


@checked
def plot_timing(
    diagram: TimingDiagram,
    *,
    rules: ClearanceRule | Iterable[ClearanceRule] = (),
    rows: Sequence[str] = (),
    ax: Axes | None = None,
) -> Axes:
    """Draw a timing diagram as the trade does; return the Axes of the displacements.

    Displacement in mm over the cam angle, one curve a mechanism; beneath it a bar for each, hatched
    where it moves, with the angles of its segments. Grey is where two move at once, or, with
    `rules`, where the two motions of a rule do; a broken rule is marked. `rows`,
    any of "velocity", "acceleration" and "jerk", are drawn below over the same cam angle; a row
    names the mechanisms whose peak is infinite. More than four mechanisms get a lane each, with a
    scale of its own. Raises InputError for an unknown row, and for a rule about a motion that the
    diagram lacks.

    >>> import cammotion as cm
    >>> ax = plot_timing(cm.EXAMPLE.diagram, rules=cm.EXAMPLE.rule, rows=["acceleration"])
    >>> ax.get_ylabel()
    'displacement in mm'
    """
    rows = [one_of("row", row, ROWS) for row in rows]
    given = as_rules(diagram, rules) if rules else ()
    names = as_diagram(diagram).names
    if ax is None:
        curves = 2.6 if len(names) <= SHARED_AXIS else 0.42 * len(names)
        height = curves + BAR_INCHES * len(names) + (ROW_INCHES + 0.2) * len(rows)
        ax = blank_axes(9, height / 0.77)
    style_axes(ax, "", "displacement in mm")
    divider = make_axes_locatable(ax)
    bars = divider.append_axes("bottom", size=BAR_INCHES * len(names), pad=0.12, sharex=ax)
    lower = [divider.append_axes("bottom", size=ROW_INCHES, pad=0.2, sharex=ax) for _ in rows]
    _draw_displacements(ax, diagram)
    _draw_bars(bars, diagram)
    for axis, row in zip(lower, rows, strict=True):
        _draw_row(axis, diagram, row)
    _shade(ax, diagram, given)
    _share_angle(ax, bars, *lower)
    return ax


@checked
def plot_clearance(
    designs: TimingDiagram | Mapping[str, TimingDiagram],
    rule: ClearanceRule,
    *,
    span_mm: float | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw where two motions are to each other through the turn, and where they may not be.

    Horizontally the motion of `rule.only_while` (of a mill, how far it is from a stop), vertically
    that of `rule.when`, both in mm. The hatched region is forbidden. Each of the `designs`, a
    diagram or several by their names, is a path, with a dot every 5 deg of cam angle where both
    motions are on their way. `span_mm` is how far the horizontal axis goes. Raises InputError for
    no design, and for a rule about a motion that one of them lacks.

    >>> import cammotion as cm
    >>> plot_clearance(cm.EXAMPLE.diagram, cm.EXAMPLE.rule).get_xlabel()
    'mill: distance from a stop in mm'
    """
    named = designs if isinstance(designs, Mapping) else {"": designs}
    if not named:
        raise InputError("There is no design to draw: give a TimingDiagram, or several by name.")
    for diagram in named.values():
        as_rules(diagram, rule)
    if ax is None:
        ax = blank_axes(7.5, 4.6)
    across, up = rule.only_while, rule.when
    style_axes(ax, describe_offset(across, named), describe_offset(up, named))
    highest = max(diagram[up.motion].offset_mm(SAMPLED_DEGS).max() for diagram in named.values())
    widest = max(diagram[across.motion].offset_mm(SAMPLED_DEGS).max() for diagram in named.values())
    near = min(widest, max(8 * across.limit_mm, 0.05 * widest))
    broken = [
        violation for diagram in named.values() for violation in find_violations(diagram, rule)
    ]
    span = widest if broken else near  # no broken rule outside the picture
    if span_mm is not None:
        span = _SPAN.number(span_mm)
    ax.set_xlim(-ROOM * span, span)
    ax.set_ylim(-ROOM * highest, 1.1 * highest)
    region = _forbidden_region(rule, ax)
    ax.add_patch(region)
    labels: dict[tuple[float, float], str] = {}
    for number, (name, diagram) in enumerate(named.items()):
        labels = _draw_path(ax, diagram, rule, number, name) or labels
    for place, label in labels.items():  # the last path's; the others have theirs below or above
        write(ax, label, place, colour(number), offset=(-3, -17))
    if any(named):
        ax.legend(loc="upper left", bbox_to_anchor=(1, 1), frameon=False, fontsize=10)
    middle_x, middle_y = region.get_center()
    write(ax, "forbidden", (middle_x, middle_y), BROKEN["edgecolor"], offset=(0, 0))
    return ax


def describe_offset(condition: Condition, designs: Mapping[str, TimingDiagram]) -> str:
    """Return the label of an axis of the clearance map."""
    motion = next(iter(designs.values()))[condition.motion]
    what = "distance from a stop" if motion.is_indexing else "position"
    return f"{motion.name}: {what} in mm"


def _draw_displacements(ax: Axes, diagram: TimingDiagram) -> None:
    in_lanes = len(diagram.motions) > SHARED_AXIS
    ticks: dict[float, str] = {}
    for number, motion in enumerate(diagram.motions):
        angles = curve_angles(motion)
        heights = displacement(motion, angles)
        if in_lanes:
            low, high = heights.min(), heights.max()
            lane = len(diagram.motions) - 1 - number
            heights = lane + LANE * (heights - low) / ((high - low) or 1)
            ticks[lane + LANE / 2] = "{:g} to {:g}".format(*np.round([low, high], 6) + 0.0)
        style_line(ax.plot(angles, heights, label=motion.name)[0], number)
        middle = _highest_stay(motion)
        top = float(np.interp(middle, angles, heights))
        write(ax, motion.name, (middle, top), colour(number), offset=(0, -4 if in_lanes else 5))
    if in_lanes:
        ax.set_yticks([*ticks], [*ticks.values()])
        ax.tick_params(axis="y", length=0)
        ax.grid(visible=False, axis="y")
        ax.set_ylim(-0.2, len(diagram.motions) + 0.1)
    else:
        ax.margins(y=0.14)


def _highest_stay(motion: Motion) -> float:
    """Return the cam angle of the middle of the longest dwell furthest from the start."""
    within = [segment for segment in motion.segments if segment.is_dwell] or motion.segments
    far = max(within, key=lambda s: (abs(s.from_mm - motion.start_mm), s.angle_deg))
    return min(max((far.from_deg + far.to_deg) / 2 % DEG_PER_TURN, 12), DEG_PER_TURN - 12)


def _draw_bars(ax: Axes, diagram: TimingDiagram) -> None:
    style_axes(ax, "", "")
    for number, motion in enumerate(diagram.motions):
        for segment in motion.segments:
            parts = arcs([(segment.from_deg, segment.to_deg)])  # two where it runs on over 360
            for part in parts:
                label = f"{motion.name}: {segment.kind} from {part[0]:.5g} to {part[1]:.5g} deg"
                _draw_bar(ax, number, part, segment).set_label(label)
            start, end = max(parts, key=lambda part: part[1] - part[0])
            if end - start >= _NARROWEST_LABEL_DEG:
                middle, label = (start + end) / 2, f"{segment.angle_deg:.5g}°"
                box = {"facecolor": "white", "edgecolor": "none", "pad": 1}
                ax.text(middle, number, label, fontsize=10, ha="center", va="center", bbox=box)
    ax.set_ylim(len(diagram.motions) - 0.45, -0.55)
    ax.set_yticks(range(len(diagram.motions)), diagram.names)
    ax.tick_params(axis="y", length=0)
    ax.spines["left"].set_visible(False)


def _draw_bar(ax: Axes, row: int, span: Arc, segment: Segment) -> Rectangle:
    start, end = span
    half = 0.06 if segment.is_dwell else 0.36
    bar = Rectangle(
        (start, row - half),
        end - start,
        2 * half,
        facecolor="white" if segment.is_dwell else mixed(colour(row), "white", 0.75),
        edgecolor=colour(row),
        hatch=HATCHES[segment.kind],
        linewidth=1.2,
    )
    ax.add_patch(bar)
    return bar


def _draw_row(ax: Axes, diagram: TimingDiagram, row: str) -> None:
    style_axes(ax, "", CURVES[row].replace(" in ", "\nin "))
    for number, motion in enumerate(diagram.motions):
        angles = curve_angles(motion)
        values = ROWS[row](diagram, motion.name, angles)
        style_line(ax.plot(angles, values, label=motion.name)[0], number)
    ax.axhline(0, color="#000000", linewidth=0.8)
    peak = getattr(diagram, f"peak_{row}")
    if infinite := [name for name in diagram.names if math.isinf(peak(name))]:
        said = f"peak ∞: {', '.join(infinite)}"
        ax.text(1, 1.01, said, ha="right", va="bottom", fontsize=10, transform=ax.transAxes)
    ax.margins(y=0.1)


def _shade(ax: Axes, diagram: TimingDiagram, rules: tuple[ClearanceRule, ...]) -> None:
    groups: list[Sequence[str]] = [(rule.when.motion, rule.only_while.motion) for rule in rules]
    overlaps = [arc for names in groups or [diagram.names] for arc in diagram.overlap(*names)]
    violations = find_violations(diagram, rules) if rules else ()
    where_broken = [(broken.start_deg, broken.end_deg) for broken in violations]
    grey: dict[str, Any] = {"facecolor": "white", "edgecolor": "#555555"}
    key = [Patch(**grey, hatch=hatch, label=kind) for kind, hatch in HATCHES.items()]
    for label, found, style in (
        ("overlap", overlaps, OVERLAP),
        ("rule broken", where_broken, BROKEN),
    ):
        for start, end in arcs(found):
            span = f"{label} from {start:.5g} to {end:.5g} deg"
            ax.axvspan(start, end, **style, linewidth=0, zorder=0.5, label=span)
        if found:
            key.append(Patch(**style, label=label))
    ax.legend(handles=key, loc="lower right", bbox_to_anchor=(1, 1), ncols=len(key), frameon=False)


def _share_angle(*axes: Axes) -> None:
    axes[0].set_xlim(0, DEG_PER_TURN)
    axes[0].set_xticks(range(0, DEG_PER_TURN + 1, TICK_DEG))
    for ax in axes[:-1]:
        ax.tick_params(axis="x", labelbottom=False)
    axes[-1].set_xlabel("cam angle in deg", fontsize=11)


def _draw_path(
    ax: Axes, diagram: TimingDiagram, rule: ClearanceRule, number: int, name: str
) -> dict[tuple[float, float], str]:
    """Draw a path with its dots; return where the cam angles belong that name some of them.

    A path comes by a place more than once if the ways to and fro are alike.
    """
    across, up = diagram[rule.only_while.motion], diagram[rule.when.motion]
    close = np.union1d(curve_angles(across), curve_angles(up))
    style_line(ax.plot(across.offset_mm(close), up.offset_mm(close), label=name)[0], number)
    angles = np.arange(0, DEG_PER_TURN, DOT_DEG)
    x, y = np.asarray(across.offset_mm(angles)), np.asarray(up.offset_mm(angles))
    under_way = (x > 0) & (y > 0) & (x <= ax.get_xlim()[1]) & (y <= ax.get_ylim()[1])
    ax.plot(x[under_way], y[under_way], "o", color=colour(number), markersize=5)
    high = y > 2 * ROOM * ax.get_ylim()[1]  # a label has room below its dot
    named = under_way & high & (angles % LABELLED_DOT_DEG == 0)
    found: dict[tuple[float, float], list[str]] = {}
    for across_mm, up_mm, angle in zip(x[named], y[named], angles[named], strict=True):
        found.setdefault((round(across_mm, 6), round(up_mm, 6)), []).append(str(angle))
    return {place: f"{'/'.join(names)}°" for place, names in found.items()}


def _forbidden_region(rule: ClearanceRule, ax: Axes) -> Rectangle:
    """Return the rectangle of a clearance map in which both halves of the rule are broken."""
    left, right = _side(rule.only_while.opposite, ax.get_xlim())
    low, high = _side(rule.when, ax.get_ylim())
    return Rectangle((left, low), right - left, high - low, **BROKEN, alpha=0.6, linewidth=1.5)


def _side(condition: Condition, limits: tuple[float, float]) -> tuple[float, float]:
    low, high = limits
    return (condition.limit_mm, high) if condition.is_beyond else (low, condition.limit_mm)
