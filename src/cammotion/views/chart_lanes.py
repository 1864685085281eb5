"""The lanes of a timing chart on paper: curves with an angle at each corner."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.text import Text
from numpy.typing import ArrayLike

from cammotion.laws.catalogue import as_law
from cammotion.machine.arcs import Arc, arcs
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.measured.inch import MM_PER_INCH
from cammotion.quantities import as_text, plural
from cammotion.views.displacement import curve_angles, displacement
from cammotion.views.ends import POINTS_PER_INCH
from cammotion.views.names import (
    TITLE,
    as_label,
    cut,
    labels,
    names_that_fit,
    plain,
    printable,
    text_px,
    wrap,
)
from cammotion.views.scales import from_to, short_number, trimmed

_GRID_DEG, _NUMBERED_DEG = 10, 30
FULL_MM = 14.0  # of a lane whose texts have their full size
_LEAST_CURVE, _MOST_CURVE = 0.25, 0.5  # of a lane that a curve fills
_NAME, _SMALL, _ANGLE = 9.0, 7.0, 7.0  # sizes of texts in points, in a lane that is high enough
_LEAST = 0.6  # of these sizes, in a low one
MM_PER_POINT = MM_PER_INCH / POINTS_PER_INCH
_APART_MM = 0.6  # between two angles
_LEFT_MM, _RIGHT_MM = 37.0, 30.0  # of room for texts beside the lanes
_BESIDE = 0.88  # of a lane is filled by them, if it is not too high
_CLOSE = 0.97  # of the size of letters: lines that are nearer would touch
_MORE = 2  # digits of a stroke than of a number at a scale: a workshop sets it by them


class _Box(NamedTuple):
    """Where a text stands on the page, in mm."""

    left: float
    right: float
    bottom: float
    top: float

    def meets(self, other: "_Box") -> bool:
        """Whether two texts would touch."""
        beside = self.left >= other.right + _APART_MM or other.left >= self.right + _APART_MM
        return not (beside or self.bottom >= other.top or other.bottom >= self.top)


class Beside(NamedTuple):
    """What is said beside a lane."""

    stroke: str
    peak: str
    laws: list[str]


def beside(motion: Motion, peak: float, radius_mm: float | None) -> Beside:
    """Return what is said of a motion, its peak acceleration in m/s2 being known."""
    low, high = motion.range_mm
    way = abs(motion.pitch_mm) if motion.is_indexing else high - low
    turned = "" if radius_mm is None else f" ({short_number(math.degrees(way / radius_mm))}°)"
    if motion.is_indexing:
        stroke = f"{short_number(way, _MORE)} mm{turned}, {plural(motion.stops or 0, 'stop')}"
    else:
        stroke = f"{from_to(low, high, _MORE)} mm{turned}"
    return Beside(stroke, f"{as_text(peak, '.3g')} m/s²", _laws(motion))


def _laws(motion: Motion) -> list[str]:
    """Return the laws of a motion, a line for each; with an arrow if up and down have their own."""
    ways = [("↑", "rise"), ("↓", "return")]
    laws = {
        arrow: list(dict.fromkeys(as_law(m.law).name for m in motion.moves if m.kind == kind))
        for arrow, kind in ways
    }
    up, down = laws.values()
    if not up or not down or up == down:
        return up or down or ["stands"]
    return [f"{arrow} {law}" for arrow, names in laws.items() for law in names]


@dataclass(frozen=True, kw_only=True)
class Paper:
    """The part of a page in which the lanes are, 0 deg at its left and 360 at its right.

    Lengths are in mm on A4; letters and lines are `scale` times as large on the page.
    """

    ax: Axes = field(kw_only=False)
    left: float
    right: float
    top: float
    bottom: float
    lanes: int
    scale: float

    @cached_property
    def lane_mm(self) -> float:
        """How high a lane is."""
        return min((self.top - self.bottom) / self.lanes, 5 * FULL_MM)

    @property
    def share(self) -> float:
        """By how much texts are smaller than in a lane that is high enough."""
        return min(1.0, max(_LEAST, self.lane_mm / FULL_MM))

    @property
    def name_lines(self) -> int:
        """How many lines a name may have over the stroke."""
        row = 1.15 * _NAME * self.share * MM_PER_POINT
        return 2 if 3 * row <= _BESIDE * min(self.lane_mm, FULL_MM) else 1

    @property
    def small_lines(self) -> int:
        """How many lines of small letters have room beside a lane."""
        row = _CLOSE * _SMALL * self.share * MM_PER_POINT
        return int(_BESIDE * min(self.lane_mm, FULL_MM) / row)

    @property
    def curve_mm(self) -> float:
        """How high a curve is: what the angles over and under it leave."""
        free = self.lane_mm - 2 * (self.letter_mm + self.gap_mm)
        return min(max(free, _LEAST_CURVE * self.lane_mm), _MOST_CURVE * self.lane_mm)

    @property
    def letter_mm(self) -> float:
        """How high the angle of a corner is."""
        return 1.15 * _ANGLE * self.share * MM_PER_POINT

    @property
    def gap_mm(self) -> float:
        """How far the angle of a corner is from it."""
        return 0.7 * self.share

    def base(self, number: int) -> float:
        """Return where the curve of a motion is lowest."""
        return self.floor(number) + (self.lane_mm - self.curve_mm) / 2

    def write(self, x: float, y: float, text: str, size: float, **style: Any) -> Text:
        """Write a text as it is, its size in points."""
        known: dict[str, Any] = {"va": "center", "zorder": 5, "fontsize": self.scale * size}
        written = self.ax.text(x, y, text, **known | style)
        plain(written)
        return written

    def line(self, x: ArrayLike, y: ArrayLike, width: float, **style: Any) -> Line2D:
        """Draw a black line, its width in points."""
        known: dict[str, Any] = {"color": "black", "zorder": 1, "linewidth": self.scale * width}
        return self.ax.plot(x, y, **known | style)[0]

    def across(self, angle_deg: float) -> float:
        """Return where a cam angle is."""
        return self.left + angle_deg / DEG_PER_TURN * (self.right - self.left)

    def floor(self, number: int) -> float:
        """Return where the lane of a motion begins, from below."""
        return self.top - (number + 1) * self.lane_mm


def draw_grid(paper: Paper, left: float, right: float) -> None:
    """Draw a line every 10 deg, with numbers every 30, and one between any two lanes."""
    lowest = paper.floor(paper.lanes - 1)
    for angle in range(0, DEG_PER_TURN + 1, _GRID_DEG):
        is_numbered = angle % _NUMBERED_DEG == 0
        x = paper.across(angle)
        grey, line = ("#777777", 0.5) if is_numbered else ("#bbbbbb", 0.3)
        paper.line([x, x], [lowest, paper.top], line, color=grey)
        if is_numbered:
            paper.write(x, paper.top + 1, f"{angle}°", _SMALL, ha="center", va="bottom")
            paper.write(x, lowest - 1, f"{angle}°", _SMALL, ha="center", va="top")
    for number in range(paper.lanes + 1):
        y = paper.top - number * paper.lane_mm
        paper.line([left, right], [y, y], 0.4)
    y = paper.top + 1
    paper.write(paper.left - 9, y, "stroke", _SMALL, ha="right", va="bottom")
    paper.write(paper.right + 9, y, "peak, laws", _SMALL, va="bottom")


def lane_names(paper: Paper, names: Sequence[str]) -> list[list[str]]:
    """Return each name in the lines that it has beside its lane, no two alike.

    A long one is shortened once, to what has room, so that what tells it apart is not cut off.
    """

    def lines(name: str) -> list[str]:
        return wrap(name, _LEFT_MM / MM_PER_POINT, _NAME * paper.share, bold=True)

    def fits(called: Sequence[str]) -> bool:
        return all(len(lines(name)) <= paper.name_lines for name in called)

    return [lines(name) for name in names_that_fit(names, fits, most=TITLE, called=labels)]


def draw_lane(paper: Paper, number: int, motion: Motion, name: Sequence[str], said: Beside) -> None:
    """Draw a motion in its lane, with its name, in lines, and what else is said beside it."""
    angles = curve_angles(motion)
    values = displacement(motion, angles)
    low, high = float(values.min()), float(values.max())
    base, scale = paper.base(number), paper.curve_mm / ((high - low) or 1.0)
    x = [paper.across(angle) for angle in angles]
    curve = paper.line(x, base + (values - low) * scale, 1.6 * paper.share, zorder=3)
    curve.set_label(as_label(printable(motion.name)))
    joints = _joints(motion)
    heights = base + (displacement(motion, joints) - low) * scale
    corners = [(paper.across(at), y, at) for at, y in zip(joints, heights.tolist(), strict=True)]
    _write_angles(paper, corners, base + paper.curve_mm / 2)
    _write_beside(paper, number, (*name, said.stroke), (paper.left - 2, "right", _LEFT_MM))
    laws = _as_many(said.laws, paper.small_lines - 1)
    _write_beside(paper, number, (said.peak, *laws), (paper.right + 2, "left", _RIGHT_MM))


def draw_violation(paper: Paper, rows: Sequence[int], arc: Arc) -> None:
    """Hatch an arc in the lanes of two motions."""
    for start, end in arcs([arc]):
        width = paper.across(end) - paper.across(start)
        for row in rows:
            corner = paper.across(start), paper.floor(row)
            box = Rectangle(corner, width, paper.lane_mm, hatch="xxx", fill=False)
            box.set(edgecolor="#555555", linewidth=0.8 * paper.scale, zorder=2)
            paper.ax.add_patch(box)


def _joints(motion: Motion) -> list[float]:
    """Return the cam angles at which segments meet, 0 to 360, a whole turn counting as 0."""
    return sorted({round(s.from_deg % DEG_PER_TURN, 9) % DEG_PER_TURN for s in motion.segments})


def _write_angles(
    paper: Paper, corners: Sequence[tuple[float, float, float]], middle: float
) -> None:
    """Write the angle of each corner over or under it, beside those that are there already."""
    size = _ANGLE * paper.share
    taken: list[_Box] = []
    for x, y, angle in corners:
        text = trimmed(angle, 2)
        boxes = list(_places(paper, x, y, middle, text_px(text, size) * MM_PER_POINT))
        free = (box for box in boxes if not any(box.meets(other) for other in taken))
        box = next(free, boxes[0])
        taken.append(box)
        centre = (box.left + box.right) / 2, (box.bottom + box.top) / 2
        dot = 2.2 * paper.share * paper.scale
        paper.line([x], [y], 0, marker="o", markersize=dot, zorder=4)
        written = paper.write(*centre, text, size, ha="center")
        written.set_bbox({"facecolor": "white", "edgecolor": "none", "pad": 0.2})


def _places(paper: Paper, x: float, y: float, middle: float, width: float) -> Iterator[_Box]:
    """Yield where the angle of a corner may stand, the best first."""
    high, gap = paper.letter_mm, paper.gap_mm
    over, under = (y + gap, y + gap + high), (y - gap - high, y - gap)
    for bottom, top in (over, under) if y > middle else (under, over):
        for shift in (-0.5, -0.95, -0.05):
            left = min(max(x + shift * width, paper.left + 0.3), paper.right - width - 0.3)
            yield _Box(left, left + width, bottom, top)


def _as_many(laws: Sequence[str], lines: int) -> Sequence[str]:
    """Return the laws that so many lines hold; where there are more, the last line counts them."""
    if len(laws) <= lines:
        return laws
    return [*laws[: lines - 1], f"and {len(laws) - lines + 1} more"]


def _write_beside(
    paper: Paper, number: int, lines: Sequence[str], place: tuple[float, str, float]
) -> None:
    """Write some lines beside a lane; the place is x, the side at which they are even, the room."""
    middle = paper.floor(number) + paper.lane_mm / 2
    x, side, room = place
    for row, line in enumerate(lines):
        is_name = side == "right" and row < len(lines) - 1
        size = (_NAME if is_name else _SMALL) * paper.share
        shown = cut(line, room / MM_PER_POINT, size, bold=is_name)
        share = 0.5 - (row + 0.5) / len(lines)
        y = middle + _BESIDE * share * min(paper.lane_mm, FULL_MM)
        weight = "bold" if is_name else "normal"
        paper.write(x, y, shown, size, ha=side, weight=weight)
