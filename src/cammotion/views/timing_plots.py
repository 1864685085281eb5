"""Pictures of timing diagrams and of clearances, with units at every axis."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Patch, Rectangle
from matplotlib.text import Annotation
from mpl_toolkits.axes_grid1 import make_axes_locatable  # type: ignore[import-untyped]

from cammotion.arguments import checked
from cammotion.machine.arcs import arcs
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN, over_time
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity, one_of
from cammotion.rules.checks import as_rules, every_rule, find_violations
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition
from cammotion.rules.rule import Rule
from cammotion.views.bars import HATCHES, draw_bars
from cammotion.views.broken import BROKEN, draw_broken
from cammotion.views.displacement import curve_angles, displacement
from cammotion.views.ends import POINTS_PER_INCH, inches
from cammotion.views.lanes import (
    LANE_INCHES,
    SHARED_AXIS,
    Values,
    curves_of,
    draw_lanes,
    draw_shared,
    room_inches,
    say_infinite,
    show_turn,
)
from cammotion.views.named import labels_of, readable
from cammotion.views.names import TITLE, add_legend, by_name, labels, name_line, text_px
from cammotion.views.pictures import blank_axes, on_paper
from cammotion.views.plots import CURVES, WRITTEN, colour, style_axes, style_line, styled, write

BAR_INCHES, CURVES_INCHES, ROW_INCHES = 0.33, 2.6, 1.4
WIDTH_INCHES, LEFT_INCHES, RIGHT_INCHES = 9.0, 1.125, 0.9  # of a notebook's page, and its margins
_TITLE_INCHES = 0.45  # beside the names of the rows, for what they show
DOT_DEG, LABELLED_DOT_DEG = 5, 15
ROOM = 0.03  # of an axis, so that it does not hide a path along it
_BELOW = 0.085  # of the axis, in which a label has room below its dot
ROWS: dict[str, Callable[[TimingDiagram, str, Any], Any]] = {
    "velocity": TimingDiagram.velocity,
    "acceleration": TimingDiagram.acceleration,
    "jerk": TimingDiagram.jerk,
}
OVERLAP: dict[str, Any] = {"facecolor": "#e4e4e4", "edgecolor": "#9a9a9a", "hatch": "..."}
_LOWER_LEFT = (-3.0, -17.0)  # of a dot, in points, where the name of its angle stands
_ROUNDING = 1e-10  # of a derivative, as a share of what the moves have
_FORBIDDEN, _BESIDE = "forbidden", 4.0  # written in a region, or so many points beside it
_SPAN = Quantity("span of the axis", "mm", example=5)


@checked
@on_paper
def plot_timing(
    diagram: TimingDiagram,
    *,
    rules: Rule | Iterable[Rule] = (),
    rows: Sequence[str] = (),
    ax: Axes | None = None,
) -> Axes:
    """Draw a timing diagram as the trade does; return the Axes of the displacements.

    Displacement in mm over the cam angle, one curve a mechanism; beneath it a bar for each, hatched
    where it moves, with the angles of its segments. Grey is where two move at once, or, with
    `rules`, where the two motions of a rule do. A broken rule is marked on the two mechanisms that
    it is about, and named if it has a name. `rows`, any of "velocity", "acceleration" and "jerk",
    are drawn below over the same cam angle; a row names the mechanisms whose peak is infinite. More
    than four mechanisms get a lane each, with a scale of its own and its range beside it. Long
    names are shortened; the words of the picture have them in full. Raises InputError for more than
    24 mechanisms, for an unknown row, and for a rule about a motion that the diagram lacks.

    >>> import cammotion as cm
    >>> ax = plot_timing(cm.EXAMPLE.diagram, rules=cm.EXAMPLE.rule, rows=["acceleration"])
    >>> ax.get_ylabel()
    'displacement in mm'
    """
    rows = [one_of("row", row, ROWS) for row in rows]
    given = every_rule(diagram, rules)
    names = labels(readable(diagram).names)
    in_lanes = len(names) > SHARED_AXIS
    heights = [LANE_INCHES * len(names)] * (1 + len(rows))
    if not in_lanes:
        heights = [CURVES_INCHES, *[ROW_INCHES for _ in rows]]
    bars_inches = BAR_INCHES * len(names)
    if ax is None:
        ax = _page(names, sum(heights) + bars_inches + 0.2 * len(rows))
    style_axes(ax, "", "displacement in mm")
    divider = make_axes_locatable(ax)
    bars = divider.append_axes("bottom", size=bars_inches, pad=0.12, sharex=ax)
    lower = [
        divider.append_axes("bottom", size=height, pad=0.2, sharex=ax) for height in heights[1:]
    ]
    show_turn(ax)
    _draw_curves(ax, diagram)
    draw_bars(bars, diagram.motions, names)
    for axis, row in zip(lower, rows, strict=True):
        style_axes(axis, "", CURVES[row].replace(" in ", "\nin "))
        _draw_curves(axis, diagram, row)
    _shade(ax, bars, diagram, given)
    _share_angle(ax, bars, *lower)
    return ax


@checked
@on_paper
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
    motions are on their way. `span_mm` is how long the horizontal axis is. Raises InputError for
    no design, and for a rule about a motion that one of them lacks.

    >>> import cammotion as cm
    >>> plot_clearance(cm.EXAMPLE.diagram, cm.EXAMPLE.rule).get_xlabel()
    'mill: distance from a stop in mm'
    """
    named = designs if isinstance(designs, Mapping) else {"": designs}
    if not named:
        raise InputError("There is no design to draw: give a TimingDiagram, or several by name.")
    first = next(iter(named.values()))
    spelled = [as_rules(diagram, rule)[0] for diagram in named.values()]
    rule = spelled[0]
    across, up = rule.only_while, rule.when
    called = labels_of(first)
    x, y = (describe_offset(first[half.motion], called[half.motion]) for half in (across, up))
    lowest, highest = _ends(named, up.motion)
    leftmost, rightmost = _across(named, rule, span_mm)
    ax = styled(ax, x, y, (7.5, 4.6))
    wide, high = (rightmost - leftmost) or 1.0, (highest - lowest) or 1.0
    ax.set_xlim(leftmost - ROOM * wide, leftmost + wide)
    ax.set_ylim(lowest - ROOM * high, lowest + 1.1 * high)
    region = _forbidden_region(rule, ax)
    ax.add_patch(region)
    short = by_name(named, TITLE)
    angles: dict[tuple[float, float], str] = {}
    ink = ""
    for number, (name, diagram) in enumerate(named.items()):
        if found := _draw_path(ax, diagram, rule, number):
            angles, ink = found, colour(number)
        if any(named):
            name_line(ax.lines[-2], short[name], name)
    for place, label in angles.items():  # of one path; the others have theirs below or above
        _keep_inside(ax, write(ax, label, place, ink, offset=_LOWER_LEFT))
    if any(named):
        add_legend(ax, loc="upper left", bbox_to_anchor=(1, 1), frameon=False)
    if min(region.get_width(), region.get_height()) > 0:  # or it lies where nobody comes
        _name_region(ax, region)
        when, only = rule.motions
        region.set_label(
            f"forbidden where the {when} is {rule.when} and the {only} not {rule.only_while}"
        )
    return ax


def _name_region(ax: Axes, region: Rectangle) -> None:
    """Write what a region is in its middle; beside one that is too narrow, where there is room."""
    middle_x, middle_y = region.get_center()
    left, right = region.get_x(), region.get_x() + region.get_width()
    start, end = ax.get_xlim()
    wide = region.get_width() / (end - start) * inches(ax)[0] * POINTS_PER_INCH
    place, offset = middle_x, 0.0
    if wide < text_px(_FORBIDDEN, WRITTEN):
        place, offset = (right, _BESIDE) if end - right > left - start else (left, -_BESIDE)
    write(ax, _FORBIDDEN, (place, middle_y), BROKEN["edgecolor"], offset=(offset, 0))


def _keep_inside(ax: Axes, written: Annotation) -> None:
    """Move what is written lower left of a point to the right, off the axis and its numbers."""
    right, up = _LOWER_LEFT
    over = (ax.bbox.x0 - written.get_window_extent().x0) * POINTS_PER_INCH / ax.figure.dpi
    written.set_position((right + max(0.0, over), up))


def _across(
    designs: Mapping[str, TimingDiagram], rule: ClearanceRule, span_mm: float | None
) -> tuple[float, float]:
    """Return from where to where the horizontal axis goes: over what there is to see of the rule.

    What goes out from 0 is of interest up to some times its limit, unless the rule is broken.
    """
    left, right = _ends(designs, rule.only_while.motion)
    if span_mm is not None:
        return left, left + _SPAN.number(span_mm)
    if left:
        return left, right + ROOM * (right - left)
    if any(find_violations(diagram, rule) for diagram in designs.values()):
        return left, right
    return left, min(right, max(8 * rule.only_while.limit_mm, 0.05 * right))


def _ends(designs: Mapping[str, TimingDiagram], name: str) -> tuple[float, float]:
    """Return from where to where a motion goes in all designs; from 0 on if that is not far."""
    motions = [diagram[name] for diagram in designs.values()]
    offsets = [motion.offset_mm(curve_angles(motion)) for motion in motions]
    low, high = float(min(map(np.min, offsets))), float(max(map(np.max, offsets)))
    rounding = 1e-9 * (high - low)
    return 0.0 if -rounding <= low <= high - low else low, high


def describe_offset(motion: Motion, name: str) -> str:
    """Return the label of an axis of the clearance map, for a motion that is called so there."""
    what = "distance from a stop" if motion.is_indexing else "position"
    return f"{name}: {what} in mm"


def _page(names: Sequence[str], height: float) -> Axes:
    """Return the axes of a picture as wide as a notebook's page, with room for names."""
    left = max(LEFT_INCHES, room_inches(names) + _TITLE_INCHES)
    in_lanes = len(names) > SHARED_AXIS
    right = WIDTH_INCHES - (room_inches(["−1000 to 1000"]) + 0.15 if in_lanes else RIGHT_INCHES)
    ax = blank_axes(WIDTH_INCHES, height / 0.77)
    ax.figure.subplots_adjust(left=left / WIDTH_INCHES, right=right / WIDTH_INCHES)
    return ax


def _draw_curves(ax: Axes, diagram: TimingDiagram, row: str | None = None) -> None:
    """Draw the displacements, or a row below them: on one scale, or each in its lane."""
    values = displacement if row is None else _derivative(diagram, row)
    order = 0 if row is None else 1 + [*ROWS].index(row)
    in_lanes = len(diagram.names) > SHARED_AXIS
    curves = curves_of(diagram.motions, values, turns_of=order)
    peaks = None if row is None else [getattr(diagram, f"peak_{row}")(n) for n in diagram.names]
    if in_lanes:
        draw_lanes(ax, curves, peaks)
        return
    draw_shared(ax, curves, is_named=row is None)
    if peaks is not None:
        say_infinite(ax, curves, peaks)


def _derivative(diagram: TimingDiagram, row: str) -> Values:
    """Return the function of a row's values, 0 if all are rounding beside what moves have."""
    order = 1 + [*ROWS].index(row)

    def values(motion: Motion, angles: Floats) -> Floats:
        found = np.asarray(ROWS[row](diagram, motion.name, angles))
        usual = max((abs(m.change_mm) / m.angle_deg**order for m in motion.moves), default=0.0)
        least = _ROUNDING * float(over_time(order, usual, diagram.cycle_time_s))
        return found if np.abs(found).max() > least else np.zeros_like(found)

    return values


def _shade(ax: Axes, bars: Axes, diagram: TimingDiagram, rules: tuple[Rule, ...]) -> None:
    groups: list[Sequence[str]] = [rule.motions for rule in rules]
    overlaps = [arc for names in groups or [diagram.names] for arc in diagram.overlap(*names)]
    grey: dict[str, Any] = {"facecolor": "white", "edgecolor": "#555555"}
    key = [Patch(**grey, hatch=hatch, label=kind) for kind, hatch in HATCHES.items()]
    is_calm = len(diagram.names) > SHARED_AXIS  # dots behind many lanes are in their way
    style = OVERLAP | {"hatch": ""} if is_calm else OVERLAP
    for start, end in arcs(overlaps):
        span = f"overlap from {start:.5g} to {end:.5g} deg"
        ax.axvspan(start, end, **style, linewidth=0, zorder=0.4, label=span)
    if overlaps:
        key.append(Patch(**style, label="overlap"))
    if draw_broken(ax, bars, diagram, find_violations(diagram, rules)):
        key.append(Patch(**BROKEN, label="rule broken"))
    add_legend(
        ax, handles=key, loc="lower right", bbox_to_anchor=(1, 1), ncols=len(key), frameon=False
    )


def _share_angle(*axes: Axes) -> None:
    for ax in axes[:-1]:
        ax.tick_params(axis="x", labelbottom=False)
    axes[-1].set_xlabel("cam angle in deg", fontsize=11)


def _draw_path(
    ax: Axes, diagram: TimingDiagram, rule: ClearanceRule, number: int
) -> dict[tuple[float, float], str]:
    """Draw a path with its dots; return where the cam angles belong that name some of them.

    A path comes by a place more than once if the ways to and fro are alike.
    """
    across, up = diagram[rule.only_while.motion], diagram[rule.when.motion]
    close = np.union1d(curve_angles(across), curve_angles(up))
    path = [np.asarray(motion.offset_mm(close)) for motion in (across, up)]
    style_line(ax.plot(*path)[0], number)
    angles = np.arange(0, DEG_PER_TURN, DOT_DEG)
    x, y = np.asarray(across.offset_mm(angles)), np.asarray(up.offset_mm(angles))
    left, low = (float(np.min(way) + 1e-9 * np.ptp(way)) for way in path)  # where both rest
    under_way = (x > left) & (y > low) & (x <= ax.get_xlim()[1]) & (y <= ax.get_ylim()[1])
    ax.plot(x[under_way], y[under_way], "o", color=colour(number), markersize=5)
    bottom, top = ax.get_ylim()
    high = y > bottom + _BELOW * (top - bottom)
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
