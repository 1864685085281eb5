"""Pictures of a way over two corners, and of the weight that proves how good it can get."""

from collections.abc import Mapping, Sequence
from contextlib import suppress

import numpy as np
import sympy as sp
from matplotlib.axes import Axes
from mpl_toolkits.axes_grid1 import make_axes_locatable  # type: ignore[import-untyped]

from cammotion.arguments import checked
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import POSITION
from cammotion.quantities import Floats, InputError, shorten
from cammotion.views.broken import BROKEN
from cammotion.views.displacement import within_short_moves
from cammotion.views.ends import Pair
from cammotion.views.named import labels_of
from cammotion.views.names import TITLE, add_legend, by_name, name_line
from cammotion.views.pictures import on_paper
from cammotion.views.plots import COLOURS, REFERENCE_STYLE, style_axes, style_line, styled, write


@checked
@on_paper
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
    first = next(iter(designs.values()))
    name = first[motion].name
    start, span = still[1], (still[0] - still[1]) % DEG_PER_TURN
    if not span:
        raise InputError(
            f"The {name} stands from {still[0]:g} to {still[1]:g} deg, which is no time or the "
            "whole turn: give where it stands, for example still=(205, 305)."
        )
    motions = [design[name] for design in designs.values()]
    if usual_mm is not None:
        usual_mm = POSITION.number(usual_mm)
    u = np.linspace(0, span, 1041)[:-1]  # where it is back it stands, without acceleration
    size = 7.5, 5.4 if with_acceleration else 3.4
    ax = styled(ax, "", f"height y of the {labels_of(first)[name]} in mm", size)
    lower = _add_below(ax) if with_acceleration else ax
    called = by_name(designs, TITLE)
    for number, (title, design) in enumerate(designs.items()):
        own = np.mod(within_short_moves(motions[number]) - start, DEG_PER_TURN)
        at = np.union1d(u, own[own < span])
        way = design.position_mm(name, start + at) - design.position_mm(name, start)
        up = 1 if way[np.abs(way).argmax()] > 0 else -1
        name_line(style_line(ax.plot(at, up * way)[0], number), called[title], title)
        if with_acceleration:
            acceleration = up * design.acceleration(name, start + at)
            name_line(style_line(lower.plot(at, acceleration)[0], number), called[title], title)
    _draw_corners(ax, corners)
    if usual_mm is not None:
        ax.axhline(usual_mm, **REFERENCE_STYLE)
        write(ax, f"{usual_mm:g} mm", (0, usual_mm), REFERENCE_STYLE["color"], offset=(2, -16))
    _mark_places(ax, lower, start, [0, corners[0][0], _middle(corners), corners[1][0], span])
    ax.set(xlim=(0, span), ylim=(0, 1.25 * ax.get_ylim()[1]))
    add_legend(ax, loc="upper right")
    return ax


@checked
@on_paper
def plot_weight(
    weight: sp.Expr, span: tuple[sp.Symbol, float, float], *, ax: Axes | None = None
) -> Axes:
    """Draw a weight of the acceleration over the cam angle; return the Axes.

    `weight` is an expression in deg, and `span` the symbol in it and its ends in deg. Its area,
    which is shaded and counted positive on both sides of zero, times the peak acceleration is the
    most that can be reached. Raises InputError for a span without a width, and for a weight that is
    not a finite number all over it.

    >>> u = sp.Symbol("u")
    >>> plot_weight(65 - u, (u, 0, 130)).get_ylabel()
    'weight in deg'
    """
    symbol, low, high = span
    if not low < high:
        raise InputError(
            f"The span of the weight goes from {low:g} to {high:g} deg: give the lower end first, "
            f"for example ({symbol}, 0, 130)."
        )
    places = np.linspace(float(low), float(high), 1041)
    heights = _heights(weight, symbol, places)
    ax = styled(ax, f"{symbol} in deg", "weight in deg", (7.5, 2.4), layout="constrained")
    style_line(ax.plot(places, heights)[0], 0)
    ax.fill_between(places, heights, color=COLOURS[0], alpha=0.25, linewidth=0)
    ax.axhline(0, color="#000000", linewidth=0.8)
    ax.set_xlim(low, high)
    return ax


def _heights(weight: sp.Expr, symbol: sp.Symbol, places: Floats) -> Floats:
    """Return a weight at these places; raise InputError where it is no finite number."""
    heights = np.array(np.nan)
    if not weight.free_symbols - {symbol}:
        with np.errstate(all="ignore"), suppress(Exception):  # of whatever NumPy cannot compute
            heights = np.asarray(sp.lambdify(symbol, weight)(places))
    if heights.dtype.kind not in "if" or not np.isfinite(heights).all():
        raise InputError(
            f"The weight is {shorten(weight)}: give an expression in {symbol} alone that is a "
            "finite real number everywhere in the span."
        )
    return np.broadcast_to(heights, places.shape)


def _add_below(ax: Axes) -> Axes:
    """Return axes for the acceleration, below and over the same angle."""
    lower: Axes = make_axes_locatable(ax).append_axes("bottom", size=1.5, pad=0.2, sharex=ax)
    style_axes(lower, "", "acceleration\nin m/s²")
    ax.tick_params(labelbottom=False)
    return lower


def _mark_places(ax: Axes, lower: Axes, start: float, places: Sequence[float]) -> None:
    """Write these u below, and above them the cam angles in deg."""
    lower.set_xticks(places)
    lower.set_xlabel(f"u, the cam angle from {start:g} deg on, in deg", fontsize=11)
    above = ax.secondary_xaxis("top")
    above.set_xticks(places, [f"{(start + place) % DEG_PER_TURN:g}" for place in places])
    above.set_xlabel("cam angle in deg", fontsize=11)


def _middle(corners: tuple[Pair, Pair]) -> float:
    return sum(u for u, _ in corners) / 2


def _draw_corners(ax: Axes, corners: tuple[Pair, Pair]) -> None:
    """Hatch what is below two corners, and draw the line in the middle between them."""
    across, heights = zip(*corners, strict=True)
    ax.fill_between(across, heights, **BROKEN, alpha=0.6, linewidth=0)
    ax.plot(across, heights, "o", color=BROKEN["edgecolor"])
    for u, y in corners:
        write(ax, f"({u:g}, {y:g})", (u, y), BROKEN["edgecolor"], offset=(8, 4))
    middle = _middle(corners)
    ax.axvline(middle, **REFERENCE_STYLE)
    write(ax, "mirror line", (middle, heights[0] / 2), REFERENCE_STYLE["color"], offset=(6, 0))
