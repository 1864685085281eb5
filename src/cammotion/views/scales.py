"""Scales for pictures and numbers for readouts, also where a peak is infinite."""

import math

import numpy as np
from matplotlib.ticker import LogLocator
from numpy.typing import ArrayLike

_ONE_TWO_FIVE = LogLocator(subs=(1, 2, 5))
_ROOM = 1.05


def drawn_peak(peak: float, *curves: ArrayLike) -> float:
    """Return what a scale has to hold: the peak, of an infinite one the largest value drawn.

    `curves` are the values that are drawn, finite arrays of any length.

    >>> drawn_peak(4.5, [1.0, 4.4]), drawn_peak(math.inf, [1.0, -4.4], [2.0])
    (4.5, 4.4)
    """
    if math.isfinite(peak):
        return peak
    return max((float(np.abs(curve).max()) for curve in curves), default=0.0)


def round_up(value: float) -> float:
    """Return the next of ... 1, 2, 5, 10, 20 ... above a value, for an axis with a little room.

    For 0, where nothing moves, it is 1.

    >>> round_up(4.154), round_up(0)
    (5.0, 1.0)
    """
    return _steps(_ROOM * value, 10 * _ROOM * value)[0] if value else 1.0


def round_down(value: float) -> float:
    """Return the largest of ... 1, 2, 5, 10, 20 ... that is not above a value, itself above 0.

    >>> round_down(4.154)
    2.0
    """
    return _steps(value / 10, value)[-1]


def as_text(value: float, digits: str) -> str:
    """Return a number in so many `digits`, a format of Python's, and an infinite one as a sign.

    >>> as_text(4.154, ".3g"), as_text(math.inf, ".3g")
    ('4.15', '∞')
    """
    return format(value, digits) if math.isfinite(value) else "∞"


def has_ratio(peak: float, reference: float) -> bool:
    """Return whether a peak can be said as a multiple of another: 0 and infinity have none."""
    return math.isfinite(peak) and math.isfinite(reference) and reference > 0


def _steps(low: float, high: float) -> list[float]:
    return [float(tick) for tick in _ONE_TWO_FIVE.tick_values(low, high) if low <= tick <= high]
