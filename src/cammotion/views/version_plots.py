"""The picture of two versions of a machine: their motions over one another, and what that cost."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from mpl_toolkits.axes_grid1 import make_axes_locatable  # type: ignore[import-untyped]

from cammotion.arguments import checked
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, as_text
from cammotion.versions.comparison import Comparison, Effect
from cammotion.views.displacement import curve_angles, displacement
from cammotion.views.lanes import (
    LANE_INCHES,
    LANE_SHARE,
    lane_over,
    name_lanes,
    room_inches,
    say_beside,
    show_turn,
)
from cammotion.views.named import readable
from cammotion.views.names import add_legend, as_label, by_name, plain, printable
from cammotion.views.pictures import blank_axes, on_paper
from cammotion.views.plots import colour, mixed, style_axes
from cammotion.views.scales import from_to
from cammotion.views.timing_plots import WIDTH_INCHES

_BAR_INCHES, _EDGES_INCHES, _GAP_INCHES = 0.3, 0.9, 0.75
_LEAST_INCHES, _RIGHT_INCHES = 4.8, 1.3  # of the angles, and beside them for what is said
_DRAWN = ("peak acceleration", "peak force", "peak torque", "rms torque")
_BEFORE: dict[str, Any] = {"color": "#777777", "linestyle": (0, (4, 2)), "linewidth": 1.4}
_FULL = 100  # per cent
_MOST = 30  # bars
_SAID = 9  # the size of what is said beside lanes and bars


@checked
@on_paper
def plot_comparison(comparison: Comparison) -> Axes:
    """Draw two versions of a machine, and return the Axes of the displacements.

    Each mechanism has a lane with its displacement over the cam angle, as it was in grey dashes and
    as it is in colour, on one scale. Below are the peaks that are other ones now, in per cent of
    what they were, with both numbers beside them: accelerations, and of camshafts forces and
    torque; of more than 30 the camshaft's and those that changed most. A peak that was or is
    infinite, or was none, has its numbers alone. `compare` makes the comparison. Raises InputError
    for more than 24 mechanisms.

    >>> import cammotion as cm
    >>> after = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram
    >>> ax = plot_comparison(cm.compare(cm.EXAMPLE.diagram, after))
    >>> [text.get_text() for text in ax.get_yticklabels()]
    ['mill', 'die']
    """
    before, after = readable(comparison.before), readable(comparison.after)
    names = list(dict.fromkeys([*after.names, *before.names]))
    effects = [e for e in comparison.effects if e.what in _DRAWN and _is_told(e)]
    effects = _most_telling(effects, names)
    lanes, bars = LANE_INCHES * len(names), _BAR_INCHES * max(len(effects), 1)
    below = bars + _GAP_INCHES if effects else 0.0
    every = list(dict.fromkeys([*names, *(effect.of for effect in effects)]))
    called = by_name(every)
    rows = [f"{called[effect.of]}, {effect.what}" for effect in effects]
    left = room_inches([*called.values(), *rows]) + 0.3
    width = max(WIDTH_INCHES, left + _LEAST_INCHES + _RIGHT_INCHES)
    ax = blank_axes(width, lanes + below + _EDGES_INCHES)
    ax.figure.subplots_adjust(
        left=left / width, right=1 - _RIGHT_INCHES / width, top=0.95, bottom=0.1
    )
    style_axes(ax, "cam angle in deg", "")
    _draw_lanes(ax, before, after, called, names)
    if effects:
        axes = make_axes_locatable(ax).append_axes("bottom", size=bars, pad=_GAP_INCHES)
        _draw_bars(axes, effects, rows, names)
    key = [
        Line2D([], [], **_BEFORE, label="before"),
        Line2D([], [], color="#000000", linewidth=2, label="after"),
    ]
    add_legend(ax, handles=key, loc="lower right", bbox_to_anchor=(1, 1), ncols=2, frameon=False)
    return ax


def _draw_lanes(
    ax: Axes,
    before: TimingDiagram,
    after: TimingDiagram,
    called: Mapping[str, str],
    names: Sequence[str],
) -> None:
    for number, name in enumerate(names):
        versions = [d[name] if name in d.names else None for d in (before, after)]
        curves = [None if m is None else _curve(m) for m in versions]
        heights = np.concatenate([curve[1] for curve in curves if curve is not None])
        low, high = float(heights.min()), float(heights.max())
        bottom = len(names) - 1 - number
        lane = lane_over(bottom, low, high)
        for curve, is_after in zip(curves, (False, True), strict=True):
            if curve is not None:
                angles, values = curve
                (line,) = ax.plot(angles, values, transform=lane + ax.transData)
                line.set(**({"color": colour(number), "linewidth": 2} if is_after else _BEFORE))
                said = f"{printable(name)} {'after' if is_after else 'before'}"
                line.set_label(as_label(said))
        said = f"{from_to(low, high)} mm"
        say_beside(ax, bottom + LANE_SHARE / 2, said, _SAID)
    name_lanes(ax, [called[name] for name in names])
    show_turn(ax)


def _curve(motion: Motion) -> tuple[Floats, Floats]:
    angles = curve_angles(motion)
    return angles, displacement(motion, angles)


def _is_told(effect: Effect) -> bool:
    """Whether both versions have it, and it is in per cent or another one now."""
    return None not in effect.shown and (effect.times is not None or effect.is_change)


def _most_telling(effects: Sequence[Effect], names: Sequence[str]) -> list[Effect]:
    """Return, in their order, the camshaft's and those that doubled or halved most often.

    From or to nothing or infinity is most of all.
    """

    def telling(effect: Effect) -> tuple[bool, float]:
        change = abs(math.log2(effect.times)) if effect.times else math.inf
        return effect.of not in names, change

    most = sorted(effects, key=telling, reverse=True)[:_MOST]
    return [effect for effect in effects if effect in most]


def _draw_bars(
    ax: Axes, effects: Sequence[Effect], rows: Sequence[str], names: Sequence[str]
) -> None:
    style_axes(ax, "after, in per cent of before", "")
    for row, effect in enumerate(effects):
        share = _FULL * (effect.times or 0.0)
        number = names.index(effect.of) if effect.of in names else None
        face = "#dddddd" if number is None else mixed(colour(number), "white", 0.6)
        edge = "#000000" if number is None else colour(number)
        ax.barh(row, share, 0.6, facecolor=face, edgecolor=edge)
        before, after = (as_text(value or 0.0, ".3g") for value in effect.shown)
        said = f"{before} → {after} {effect.unit}"
        say_beside(ax, row, said, _SAID)
    ax.axvline(_FULL, color="#000000", linewidth=1)
    ax.set_yticks(range(len(rows)), rows)
    plain(*ax.get_yticklabels())
    ax.set_ylim(len(rows) - 0.5, -0.5)
    ax.tick_params(axis="y", length=0)
    ax.grid(visible=False, axis="y")
