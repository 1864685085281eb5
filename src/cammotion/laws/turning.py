"""Where a curve turns from rising to falling or back, with no turn missed.

Samples can step over a turn; bounds over a whole interval cannot. They can prove that some
derivative of the curve is nowhere zero in an interval. Then the derivative before it only rises or
only falls there, and is zero once at most, at a place that halving finds; between such places the
one before that only rises or falls, and so on down to the slope, whose zeros are the turns. Where
no derivative can be proved to keep its sign the interval is halved, at most to where the curve
cannot change by more than `NEGLIGIBLE`, however it turns.
"""

from abc import abstractmethod
from collections.abc import Iterator
from functools import cached_property
from itertools import pairwise
from math import isfinite

from cammotion.laws.piece import Piece, bisect
from cammotion.quantities import InputError

NEGLIGIBLE = 1e-13
"""The change of a curve that is taken for none, where a motion law changes by 1."""

_ORDERS = 6  # a slope with a zero of higher order is met by halving
_BUDGET = 2_500_000  # terms to bound, which takes one to three seconds
_SAMPLES, _TAME = 8, 1e-6  # more rounding than that, as a share of some values, hides the curve
_REFUSAL = (
    "The curve turns so often, its terms cancel each other so nearly, or it is a quotient with so "
    "wide bounds, that its turning points cannot be proved in a reasonable time: give a simpler "
    "expression, or a table of its points to law_from_points."
)
_Run = tuple[int, float, float]  # 1 for rising or -1 for falling, and from where to where


class Proved(Piece):
    """A smooth piece with bounds, by which its turns are found and proved to be all."""

    @property
    @abstractmethod
    def cost(self) -> int:
        """How many terms it takes to bound it once."""

    @abstractmethod
    def bounds(self, low: float, high: float) -> tuple[float, float]:
        """Return what every value between two places certainly lies between."""

    @property
    @abstractmethod
    def derivative(self) -> "Proved":
        """The derivative, made once."""

    @property
    def turns(self) -> list[float]:
        """Where between its ends it turns, in order.

        Raises InputError where that would take more than some seconds: for a curve that turns many
        thousand times, is nested deep or a quotient, or whose terms cancel so that rounding rules.
        """
        if isinstance(self._turns, str):
            raise InputError(self._turns)
        return self._turns

    @cached_property
    def _turns(self) -> list[float] | str:
        """Where it turns, or why that is not told: to find that out takes seconds too."""
        try:
            runs = [*_Slopes(self).runs(self.low, self.high)]
        except InputError as refusal:
            return str(refusal)
        return [(end + start) / 2 for (s, _, end), (t, start, _) in pairwise(runs) if s != t]


class _Slopes:
    """The slope of a curve (order 0) and its derivatives over intervals."""

    def __init__(self, curve: Proved) -> None:
        self._curve, self._chain = curve, [curve.derivative]
        self._spent, low, high = 0, curve.low, curve.high
        roundings = (most - least for least, most in (curve.bounds(p, p) for p in (low, high)))
        self._negligible = max(NEGLIGIBLE, *roundings)
        places = (low + n * (high - low) / _SAMPLES for n in range(_SAMPLES + 1))
        sizes = [abs(curve.at(place)) for place in places]
        if not all(map(isfinite, sizes)) or self._negligible > _TAME * max(1.0, *sizes):
            raise InputError(_REFUSAL)

    def runs(self, low: float, high: float) -> Iterator[_Run]:
        """Yield in order where the curve rises or falls; what is negligible is left out."""
        order = next((n for n in range(_ORDERS) if self._is_signed(n, low, high)), None)
        if order is not None:
            ends = [low, high]
            for lower in reversed(range(order)):
                ends = [low, *self._zeros(lower, ends), high]
            for start, end in pairwise(ends):
                if sign := self._sign_between(start, end):
                    yield sign, start, end
        elif self._matters(low, middle := (low + high) / 2, high):
            yield from self.runs(low, middle)
            yield from self.runs(middle, high)

    def _bounds(self, order: int, low: float, high: float) -> tuple[float, float]:
        slope = self._of(order)
        self._spent += slope.cost
        if self._spent > _BUDGET:
            raise InputError(_REFUSAL)
        return slope.bounds(low, high)

    def _sign(self, order: int, low: float, high: float) -> int:
        """Return 1 or -1 where it is proved to keep this sign over the interval, 0 elsewhere."""
        least, most = self._bounds(order, low, high)
        return 1 if least > 0 else -1 if most < 0 else 0

    def _is_signed(self, order: int, low: float, high: float) -> bool:
        """Whether it is proved to keep its sign, and those before it to be finite at the ends."""
        least, most = self._bounds(order, low, high)
        return (least > 0 or most < 0) and (not order or isfinite(most - least))

    def _matters(self, low: float, middle: float, high: float) -> bool:
        """Whether there is a float between two places, and the curve may change between them."""
        if not low < middle < high:
            return False
        change = (high - low) * max(map(abs, self._bounds(0, low, high)))
        if not isfinite(change):
            least, most = self._curve.bounds(low, high)
            change = most - least
        return change > self._negligible

    def _sign_between(self, low: float, high: float) -> int:
        """Return the sign of a slope that does not change it; here and there it may touch zero."""
        shares = (number / (_ORDERS + 2) for number in range(1, _ORDERS + 2))
        places = (low + share * (high - low) for share in shares)
        return next(filter(None, (self._sign(0, place, place) for place in places)), 0)

    def _zeros(self, order: int, ends: list[float]) -> list[float]:
        """Return where it changes its sign, if between two of the `ends` it only rises or falls."""
        signs = [self._sign(order, end, end) for end in ends]
        slope = self._of(order)
        return [
            bisect(lambda place, up=other: slope.at(place) * up <= 0, start, end)  # type: ignore[misc]
            for (start, end), (sign, other) in zip(pairwise(ends), pairwise(signs), strict=True)
            if sign * other < 0
        ]

    def _of(self, order: int) -> Proved:
        while len(self._chain) <= order:
            self._chain.append(self._chain[-1].derivative)
        return self._chain[order]
