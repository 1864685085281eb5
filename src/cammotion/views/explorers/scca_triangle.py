"""The triangle of the SCCA family: what stays of it while the explorer's point moves."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import withStroke

from cammotion.laws.scca_family import LEAST_CA, NAMED_PARTS, acceleration_factor
from cammotion.quantities import Floats

_CORNERS = np.array([[0, 0], [0.5, 3**0.5 / 2], [1, 0]])  # of b = 1, of c = 1 and of d = 1
_CORNER_WORDS = {"b = 1: sine": (0, -12), "c = 1: constant": (0, 27), "d = 1: cosine": (0, -39)}
_NAME_OFFSETS = ((0, 12), (0, -12), (12, 0), (0, -12), (0, -12))
_LEVELS = (4.2, 4.5, 5, 5.5, 6, 7, 8)
_GREY = "#555555"


def draw_triangle(ax: Axes) -> None:
    """Draw the triangle of all b, c and d, the named laws in it, and lines of one Ca."""
    ax.set_axis_off()
    ax.set_aspect("equal")
    ax.set_xlim(-0.14, 1.14)
    ax.set_ylim(-0.29, 1.1)
    _draw_levels(ax)
    ax.fill(*_CORNERS.T, facecolor="none", edgecolor="#000000", linewidth=1.5)
    for corner, (words, offset) in zip(_CORNERS, _CORNER_WORDS.items(), strict=True):
        _write(ax, words, corner, offset, _GREY)
    for (name, parts), offset in zip(NAMED_PARTS.items(), _NAME_OFFSETS, strict=True):
        at = place(*parts)
        ax.plot(*at, "o", color="#000000", markersize=6)
        words = name if name == "constant acceleration" else name.replace(" ", "\n")
        _write(ax, words, at, offset)


def place(b: Any, c: Any, d: Any) -> Floats:
    """Return the place in the triangle, its last axis x and y."""
    return np.asarray(np.stack([b, c, d], axis=-1) @ _CORNERS)


def _write(
    ax: Axes, words: str, at: Floats, offset: tuple[float, float], color: str = "#000000"
) -> None:
    """Write words beside a point, away from it by the offset, and readable over lines."""
    across, up = offset
    ax.annotate(
        words,
        (at[0], at[1]),
        offset,
        textcoords="offset points",
        fontsize=10.5,
        color=color,
        linespacing=1.1,
        ha="left" if across else "center",
        va="bottom" if up > 0 else "top" if up < 0 else "center",
        path_effects=[withStroke(linewidth=3, foreground="#f4f8fc")],
    )


def _draw_levels(ax: Axes) -> None:
    """Draw the lines of one Ca over the triangle, and label them."""
    share = np.linspace(0, 1, 61)
    b, of_rest = np.meshgrid(share, share)
    d = (1 - b) * of_rest
    x, y = np.moveaxis(place(b, 1 - b - d, d), -1, 0)
    values = acceleration_factor(b, d)
    ax.contourf(x, y, values, levels=[LEAST_CA, *_LEVELS, 9], cmap="Blues", alpha=0.35)
    lines = ax.contour(x, y, values, levels=_LEVELS, colors="#7799bb", linewidths=1)
    ax.clabel(lines, fmt="%g", fontsize=9, colors="#335577", manual=_level_places())
    ax.text(-0.1, 0.62, "blue lines:\nequal Ca", fontsize=10.5, color="#335577", linespacing=1.1)


def _level_places() -> list[Floats]:
    """Return where the lines of one Ca are labelled: below the names, 4.2 above them."""
    b = np.linspace(0, 1, 201)
    factors = acceleration_factor(b, 0.7 * (1 - b))
    crossings = (np.interp(level, factors, b) for level in _LEVELS[1:])
    return [np.array([0.67, 0.5]), *(place(b, 0.3 * (1 - b), 0.7 * (1 - b)) for b in crossings)]
