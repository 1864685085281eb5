"""The bars beneath a timing diagram: the segments of each mechanism, with their angles."""

from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import Rectangle

from cammotion.machine.arcs import Arc, arcs
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.views.ends import POINTS_PER_INCH, inches
from cammotion.views.lanes import name_rows
from cammotion.views.names import as_label, short
from cammotion.views.plots import colour, mixed, style_axes

HATCHES = {"rise": "///", "return": "\\\\\\", "dwell": ""}
_NORMAL, _SMALL = 10, 8  # sizes of the angles on the bars, in points
_DIGIT, _SIGN = 6.4, 5.0  # how wide a digit and the sign of a degree are at the normal size
_HATCHED = 5.0  # of a bar that moves, in points: what an angle leaves free at either side of it


def draw_bars(ax: Axes, motions: Sequence[Motion], names: Sequence[str]) -> None:
    """Draw a row of bars for each motion, from the top down, with its name beside it."""
    style_axes(ax, "", "")
    width, height = (POINTS_PER_INCH * length for length in inches(ax))
    points, row = width / DEG_PER_TURN, height / len(motions)  # of a degree, of a row
    papers = []
    for number, motion in enumerate(motions):
        for segment in motion.segments:
            parts = arcs([(segment.from_deg, segment.to_deg)])  # two where it runs on over 360
            for part in parts:
                span = f"{segment.kind} from {part[0]:.5g} to {part[1]:.5g} deg"
                bar = _draw_bar(ax, number, part, segment)
                bar.set_label(as_label(f"{short(motion.name)}: {span}"))
            start, end = max(parts, key=lambda part: part[1] - part[0])
            label = f"{segment.angle_deg:.5g}°"
            wide = _DIGIT * (len(label) - 1) + _SIGN
            free = (end - start) * points - (0 if segment.is_dwell else 2 * _HATCHED)
            room = free / wide
            if room >= _SMALL / _NORMAL:
                size = _NORMAL if room >= 1 else _SMALL
                at = (start + end) / 2, number
                text = ax.text(*at, label, fontsize=size, ha="center", va="center", color="black")
                text.set_in_layout(False)  # it is within its bar: nobody has to measure it
                share = size / _NORMAL / 2
                across = min((share * wide + 1) / points, (end - start) / 2)
                papers.append(_paper(at, across, (share * 13 + 1) / row))
    ax.add_collection(PolyCollection(papers, facecolor="white", zorder=2), autolim=False)
    ax.set_ylim(len(motions) - 0.45, -0.55)
    ax.set_yticks(range(len(motions)), names)
    name_rows(ax)
    ax.spines["left"].set_visible(False)


def _paper(at: tuple[float, float], across: float, up: float) -> list[tuple[float, float]]:
    """Return the corners of what is white behind an angle, so far to each side of its middle."""
    x, y = at
    return [(x + a * across, y + b * up) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


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
    ax.add_artist(bar)  # as a patch it would move the limits, which takes longer than drawing it
    bar.set_in_layout(False)
    return bar
