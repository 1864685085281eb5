"""Where a law rises and where it falls, and where it is above or below a height."""

from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from typing import NamedTuple

from cammotion.laws.turning import bisect, turning_points
from cammotion.laws.zones import Zone, compile_curve, x


class Branch(NamedTuple):
    """A part of a law over which S only rises or only falls (or stands): x and S at its ends."""

    low: float
    high: float
    s_low: float
    s_high: float
    curve: Callable[[float], float]

    def solve(self, s: float) -> float:
        """Return the x at which S = s, a value between those at the ends."""
        rising = self.s_high > self.s_low
        return bisect(lambda x: (self.curve(x) < s) == rising, self.low, self.high)


def cut_at_turns(zones: Iterable[Zone]) -> tuple[Branch, ...]:
    """Return the zones of a curve, each cut where the curve turns."""
    return tuple(
        Branch(low, high, zone.value(low), zone.value(high), compile_curve(zone.curve, "math"))
        for zone in zones
        for low, high in pairwise([zone.low, *turns_of(zone), zone.high])
    )


def turns_of(zone: Zone) -> list[float]:
    """Return where the curve of a zone turns, in order."""
    return turning_points(zone.curve, x, zone.low, zone.high)


def where(branches: Iterable[Branch], s: float, side: int) -> list[tuple[float, float]]:
    """Return the intervals of x in which a curve is above s (side 1) or below it (-1), in order."""
    found: list[tuple[float, float]] = []
    for low, high in _parts(branches, s, side):
        touches = found and found[-1][1] == low
        found.append((found.pop()[0] if touches else low, high))
    return found


def _parts(branches: Iterable[Branch], s: float, side: int) -> Iterator[tuple[float, float]]:
    for branch in branches:
        low, high = side * (branch.s_low - s), side * (branch.s_high - s)
        if min(low, high) >= 0 < max(low, high):
            yield branch.low, branch.high
        elif high > 0:
            yield branch.solve(s), branch.high
        elif low > 0:
            yield branch.low, branch.solve(s)
