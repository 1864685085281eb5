"""The curves of the mechanisms of a timing diagram: a few on one scale, or a lane for each.

Each is named beside it, where its name covers no other and stays in the frame.
"""

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.transforms import Affine2D

from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats
from cammotion.views.corners import corners
from cammotion.views.displacement import curve_angles
from cammotion.views.ends import POINTS_PER_INCH, inches
from cammotion.views.names import as_label, labels, plain, printable, short_names, text_px
from cammotion.views.plots import colour, dark, style_line, write
from cammotion.views.scales import from_to

SHARED_AXIS = 4  # so many curves can be told apart on one scale; more get a lane each
TICK_DEG = 30
LANE_INCHES = 0.36
LANE_SHARE = 0.75  # of a lane, that a curve fills
BEFORE_DEG = 1e-6  # so near before a jump is just before it
_NAME, _SMALL = 11, 10  # the size of a name at its curve, and beside its lane, in points
_SAID = 74  # columns of what is said above a row

Values: TypeAlias = Callable[[Motion, Floats], Floats]
"""What a curve shows of a motion at cam angles in deg."""


@dataclass(frozen=True)
class Curve:
    """The curve of one mechanism: its number, its name in full and in short, and its values."""

    number: int
    motion: Motion
    label: str
    angles: Floats
    values: Floats

    @property
    def range(self) -> tuple[float, float]:
        """Its least and its largest value."""
        return float(self.values.min()), float(self.values.max())


def curves_of(
    motions: Sequence[Motion],
    values: Values,
    angles: Floats | None = None,
    *,
    turns_of: int = 0,
) -> list[Curve]:
    """Return the curve of each motion, at its own angles or at these, with a short name.

    Its own angles are also those at which its derivative of the order `turns_of` turns, and both
    sides of each place at which that may jump.
    """
    named = zip(motions, labels([motion.name for motion in motions]), strict=True)
    found = []
    for number, (motion, label) in enumerate(named):
        at = _angles(motion, turns_of) if angles is None else angles
        found.append(Curve(number, motion, label, at, np.asarray(values(motion, at))))
    return found


def _angles(motion: Motion, order: int) -> Floats:
    if not order:
        return curve_angles(motion)
    curve = motion.curve.derived(order)
    before_closing = curve.high - BEFORE_DEG
    own = [*corners(curve), before_closing]
    return np.union1d(curve_angles(motion), np.mod(own, DEG_PER_TURN))


def draw_lanes(ax: Axes, curves: Sequence[Curve], peaks: Sequence[float] | None) -> None:
    """Draw each curve in a lane of its own: its name to the left, its range to the right.

    `peaks` are those of a quantity that is 0 at rest; where one is infinite, that is said.
    """
    for curve in curves:
        low, high = curve.range
        bottom = len(curves) - 1 - curve.number
        lane = lane_over(bottom, low, high)
        line = ax.plot(curve.angles, curve.values, transform=lane + ax.transData)[0]
        style_line(line, curve.number).set_label(as_label(printable(curve.motion.name)))
        if peaks is not None:
            ax.axhline(lane.transform((0, 0))[1], color="#999999", linewidth=0.8, zorder=1)
        infinite = peaks is not None and math.isinf(peaks[curve.number])
        said = f"{from_to(low, high)}{', peak ∞' if infinite else ''}"
        say_beside(ax, bottom + LANE_SHARE / 2, said)
    name_lanes(ax, [curve.label for curve in curves])


def lane_over(bottom: float, low: float, high: float) -> Affine2D:
    """Return what lays a curve from a low to a high value into the lane over a bottom."""
    scale = LANE_SHARE / ((high - low) or 1)
    return Affine2D().translate(0, -low).scale(1, scale).translate(0, bottom)


def name_lanes(ax: Axes, names: Sequence[str]) -> None:
    """Write the names to the left of their lanes, from the top down, and end the axis there."""
    count = len(names)
    ax.set_yticks([count - 1 - number + LANE_SHARE / 2 for number in range(count)], names)
    name_rows(ax)
    ax.grid(visible=False, axis="y")
    ax.set_ylim(-0.25, count)


def name_rows(ax: Axes) -> None:
    """Let the numbers of the vertical axis, which are names, be names in their colours."""
    ax.tick_params(axis="y", length=0)
    for number, text in enumerate(ax.get_yticklabels()):
        text.set_color(dark(number))
        plain(text)


def say_beside(ax: Axes, y: float, said: str, size: float = _SMALL) -> None:
    """Write to the right of axes, at a height that their vertical axis counts."""
    plain(ax.text(1.01, y, said, fontsize=size, va="center", transform=ax.get_yaxis_transform()))


def show_turn(ax: Axes) -> None:
    """Let the horizontal axis be one turn, with a number every 30 deg."""
    ax.set_xlim(0, DEG_PER_TURN)
    ax.set_xticks(range(0, DEG_PER_TURN + 1, TICK_DEG))


def room_inches(names: Iterable[str]) -> float:
    """Return how wide names beside rows become, in inches."""
    return max(text_px(name, _SMALL) for name in names) / POINTS_PER_INCH


def draw_shared(ax: Axes, curves: Sequence[Curve], *, is_named: bool) -> None:
    """Draw a few curves on one scale; where `is_named`, each with its name at it."""
    for curve in curves:
        line = ax.plot(curve.angles, curve.values)[0]
        style_line(line, curve.number).set_label(as_label(printable(curve.motion.name)))
    ax.margins(y=0.14 if is_named else 0.1)
    if is_named:
        _name_curves(ax, curves)
    else:
        ax.axhline(0, color="#000000", linewidth=0.8)


def say_infinite(ax: Axes, curves: Sequence[Curve], peaks: Sequence[float]) -> None:
    """Say above a row whose peaks are infinite."""
    endless = [
        curve.motion.name for curve, peak in zip(curves, peaks, strict=True) if math.isinf(peak)
    ]
    if endless:
        said = f"peak ∞: {', '.join(short_names(endless, _SAID // len(endless)))}"
        plain(ax.text(1, 1.01, said, ha="right", va="bottom", fontsize=10, transform=ax.transAxes))


def _name_curves(ax: Axes, curves: Sequence[Curve]) -> None:
    """Write each name over its curve, as near to its highest stay as others leave room."""
    low, high = ax.get_ylim()
    across, up = inches(ax)
    line = 1.4 * _NAME / POINTS_PER_INCH / up * (high - low)
    taken: list[tuple[float, float, float]] = []
    for curve in curves:
        half = text_px(curve.label, _NAME) / POINTS_PER_INCH / across * DEG_PER_TURN / 2
        wanted = min(max(_highest_stay(curve.motion), half), DEG_PER_TURN - half)
        places = np.linspace(half, max(DEG_PER_TURN - half, half), 73)
        found = []
        for place in [wanted, *sorted(places, key=lambda angle: abs(angle - wanted))]:
            height = float(np.interp(place, curve.angles, curve.values))
            clear = all(
                abs(place - x) >= half + width or abs(height - y) >= line for x, y, width in taken
            )
            found.append((not clear, place, height))
            if clear:
                break
        _, place, height = min(found, key=lambda each: each[0])
        taken.append((place, height, half))
        write(ax, curve.label, (place, height), colour(curve.number), offset=(0, 5))


def _highest_stay(motion: Motion) -> float:
    """Return the cam angle of the middle of the longest dwell furthest from the start."""
    within = [segment for segment in motion.segments if segment.is_dwell] or motion.segments
    far = max(within, key=lambda s: (abs(s.from_mm - motion.start_mm), s.angle_deg))
    return min(max((far.from_deg + far.to_deg) / 2 % DEG_PER_TURN, 12), DEG_PER_TURN - 12)
