"""Names of many curves, at their right ends: none over another."""

from collections.abc import Sequence
from itertools import combinations
from typing import TypeAlias

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgb
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from cammotion.quantities import Floats
from cammotion.views.names import plain, text_px

Pair: TypeAlias = tuple[float, float]

LINE_INCHES = 0.21  # between two names
POINTS_PER_INCH = 72


def label_ends(
    ax: Axes, lines: Sequence[Line2D], heights: Sequence[float], names: Sequence[str]
) -> None:
    """Write the name of each line at its right end, moved apart where they would meet."""
    ends = ax.transData.transform([(0, height) for height in heights])
    gap = LINE_INCHES * ax.figure.dpi / ax.bbox.height
    shares = apart(ax.transAxes.inverted().transform(ends)[:, 1], gap)
    for line, name, share in zip(lines, names, shares, strict=True):
        sample = ax.plot([1.01, 1.09], [share, share], transform=ax.transAxes, clip_on=False)[0]
        sample.update_from(line)  # its dashes, since two may have one colour
        sample.set(transform=ax.transAxes, clip_on=False, label=f"_{name}")
        text = ax.annotate(
            name,
            (1.1, share),
            xycoords="axes fraction",
            color=[0.7 * part for part in to_rgb(line.get_color())],
            fontsize=10,
            va="center",
        )
        plain(text)


def would_meet(
    ax: Axes, names: Sequence[str], places: Sequence[Pair], offsets: Sequence[Pair], size: float
) -> bool:
    """Return whether two names would lie over one another at places, off them by so many points."""
    middles = ax.transData.transform(places) * POINTS_PER_INCH / ax.figure.dpi + np.array(offsets)
    halves = [0.92 * text_px(name, size) / 2 for name in names]  # in the font that is here
    return any(
        abs(one[0] - other[0]) < half + width and abs(one[1] - other[1]) < size
        for (one, half), (other, width) in combinations(zip(middles, halves, strict=True), 2)
    )


def overfull(names: Sequence[str], width: float) -> bool:
    """Return whether names do not fit side by side into so many inches."""
    return max(text_px(name, 10) for name in names) / POINTS_PER_INCH * len(names) > width


def inches(ax: Axes) -> tuple[float, float]:
    """Return how wide and how high axes are, in inches."""
    locate = ax.get_axes_locator()  # of axes that others have been put below
    box = ax.get_position(original=True) if locate is None else locate(ax, None)  # type: ignore[arg-type]
    page = ax.figure.bbox
    return box.width * page.width / ax.figure.dpi, box.height * page.height / ax.figure.dpi


def apart(places: ArrayLike, gap: float, low: float = 0.0, high: float = 1.0) -> Floats:
    """Return places in the same order, a gap apart at least, from low on, up to high if it holds.

    >>> apart([0.5, 0.5, 0.2], 0.052).round(3)
    array([0.474, 0.526, 0.2  ])
    """
    given = np.asarray(places, dtype=np.float64)
    if not given.size:
        return given
    order = np.argsort(given, kind="stable")
    steps = np.arange(given.size) * gap
    free = np.clip(given[order], low, high) - steps  # which may not fall: pooled where they do
    pools: list[list[float]] = []
    for each in free:
        pools.append([each])
        while len(pools) > 1 and np.mean(pools[-2]) > np.mean(pools[-1]):
            pools[-2:] = [pools[-2] + pools[-1]]
    placed = np.concatenate([np.full(len(pool), np.mean(pool)) for pool in pools])
    placed = np.clip(placed, low, max(high - steps[-1], low)) + steps
    found = np.empty_like(placed)
    found[order] = placed
    return np.asarray(found)
