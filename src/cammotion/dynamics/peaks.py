"""Where a quantity of a driven follower is least and largest, between samples too.

The quantity is known anywhere together with its slope and the slope of that. Where the slope
changes its sign between two samples is a turn; it is narrowed by Newton's steps, and halved where
these lead out. All turns that can be the least or the largest are narrowed at once.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from cammotion.quantities import Floats, InputError, Quantity, shorten

_STEPS = 60
_CLOSE = 1e-9  # of the way between two samples: the value is off by the square of that


class Peak(NamedTuple):
    """A largest or smallest value, and at which place it is."""

    value: float
    at: float


Integers = NDArray[np.intp]
Asked = Callable[[Integers, Floats], Floats]
"""Of runs by number and places in them: value, slope, and its slope, in three rows."""


def extremes(quantity: Asked, runs: Sequence[Floats]) -> tuple[tuple[Peak, int], ...]:
    """Return the least and the largest value and place over runs of samples, each with its run."""
    which = np.repeat(np.arange(len(runs)), [len(run) for run in runs])
    places = np.concatenate(runs)
    values, slopes, _ = quantity(which, places)
    low, high = float(values.min()), float(values.max())
    same = which[1:] == which[:-1]
    reach = np.maximum(np.abs(slopes[1:]), np.abs(slopes[:-1])) * np.diff(places)
    tops = np.maximum(values[1:], values[:-1]) + reach >= high
    bottoms = np.minimum(values[1:], values[:-1]) - reach <= low
    turns = same & (slopes[1:] * slopes[:-1] < 0) & (tops | bottoms)
    first = np.flatnonzero(turns)
    found = narrowed(quantity, which[first], places[first], places[first + 1])
    which = np.append(which, which[first])
    places = np.append(places, found)
    values = np.append(values, quantity(which[-len(first) :], found)[0] if len(first) else [])
    ends = (int(np.argmin(values)), int(np.argmax(values)))
    return tuple((Peak(float(values[n]), float(places[n])), int(which[n])) for n in ends)


def narrowed(quantity: Asked, which: Integers, lows: Floats, highs: Floats) -> Floats:
    """Return where between two places each a slope is zero that changes its sign there."""
    if not len(which):
        return lows
    rising = quantity(which, lows)[1] < 0  # the slope rises: a bottom
    lows, highs, close = lows.copy(), highs.copy(), _CLOSE * (highs - lows)
    places = (lows + highs) / 2
    for _ in range(_STEPS):
        _, slopes, bends = quantity(which, places)
        before = (slopes < 0) == rising
        lows, highs = np.where(before, places, lows), np.where(before, highs, places)
        with np.errstate(all="ignore"):
            stepped = places - slopes / bends
        is_inside = (stepped >= lows) & (stepped <= highs)
        following = np.where(is_inside, stepped, (lows + highs) / 2)
        if np.all(np.abs(following - places) < close):
            return following
        places = following
    return places


def ordered(quantity: Quantity, over: Any, turn: float = 0.0) -> tuple[float, float]:
    """Return two places to look between; raise InputError unless they are two in order.

    What goes on from turn to turn can be looked at over the end of one, which is said.
    """
    ends = quantity.array(over)
    if ends.shape != (2,) or not ends[0] < ends[1]:
        further = ""
        if ends.shape == (2,) and ends[1] < ends[0] < ends[1] + turn:
            further = f" Over the end of a turn they are ({ends[0]:g}, {ends[1] + turn:g})."
        raise InputError(
            f"The places to look between are {shorten(over)}: give two in order, in "
            f"{quantity.unit}.{further}"
        )
    return float(ends[0]), float(ends[1])
