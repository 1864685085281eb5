"""A polynomial and waves, the form of most zones of motion laws, in plain floats.

It stands about the beginning of its zone, in u = x - low, so that terms which cancel each other
far from there are no concern. Sums, products and derivatives of such series are series again.
"""

import math
from collections.abc import Callable, Iterable
from functools import cached_property, partial
from itertools import zip_longest
from typing import Any, NamedTuple

import numpy as np
import sympy

from cammotion.laws.expression import Expression
from cammotion.laws.piece import Piece
from cammotion.laws.symbols import x
from cammotion.laws.turning import Proved
from cammotion.quantities import Floats

_ULP = math.ulp(1.0)
_QUARTER = math.pi / 2
_OFTEN = 1e5  # rad, over which a wave turns too often to be asked for each time
_NOTHING = 4 * _ULP  # what is left of terms that cancel each other, as a share of their size


class Wave(NamedTuple):
    """A wave, amplitude * sin(frequency * u + phase + quarters * pi/2)."""

    amplitude: float
    frequency: float
    phase: float
    quarters: int = 0

    def at(self, u: float) -> float:
        """Return the value at one place."""
        value = (math.cos if self.quarters % 2 else math.sin)(self.frequency * u + self.phase)
        return self.amplitude * (-value if self.quarters % 4 > 1 else value)

    def over(self, u: Floats, out: Floats) -> None:
        """Put the values at many places into `out`."""
        np.multiply(u, self.frequency, out=out)
        if self.phase:
            out += self.phase
        (np.cos if self.quarters % 2 else np.sin)(out, out=out)
        out *= -self.amplitude if self.quarters % 4 > 1 else self.amplitude

    def upright(self) -> "Wave":
        """Return it with a frequency above 0, and as a sine or a cosine."""
        a, f, phase, n = self if self.frequency > 0 else (-self.amplitude, *(-v for v in self[1:]))
        return Wave(-a if n % 4 > 1 else a, f, phase, int(n % 2))

    def crests(self, low: float, high: float) -> list[float]:
        """Return the places in ]low, high[ where a wave about `low` is highest or lowest."""
        half = math.pi / self.frequency
        first = low + half / 2 - (self.phase + self.quarters * math.pi / 2) / self.frequency
        count = math.ceil((high - low) / abs(half)) + 1
        first = low + (first - low) % half  # the first one, on the side to which `half` leads
        turns = (first + n * half for n in range(-count, count))
        return sorted(turn for turn in turns if low < turn < high)

    def bounds(self, start: float, end: float) -> tuple[float, float]:
        """Return the least and the most from one place to another, but for rounding."""
        values = self.at(start), self.at(end)
        first = (self.frequency * start + self.phase) / _QUARTER + self.quarters
        last = (self.frequency * end + self.phase) / _QUARTER + self.quarters
        if first > last:
            first, last = last, first
        crest, trough = (1, 3) if self.amplitude > 0 else (3, 1)
        top = abs(self.amplitude)
        return (
            -top if _passes(first, last, trough) else min(values),
            top if _passes(first, last, crest) else max(values),
        )


class Series(Proved):
    """A polynomial in u = x - `low`, its coefficients by rising power, and waves in u.

    `write` makes the expression for which it stands, with exact numbers, when that is asked for.
    """

    made_of = ("powers", "waves", "low", "high")

    def __init__(
        self,
        powers: tuple[float, ...],
        waves: tuple[Wave, ...] = (),
        low: float = 0.0,
        high: float = 1.0,
        write: Callable[[], sympy.Expr] | None = None,
    ) -> None:
        self.powers, self.waves, self.low, self.high, self._write = powers, waves, low, high, write
        self.is_constant = len(powers) == 1 and not waves

    def __getstate__(self) -> dict[str, Any]:
        made = {"expression": self.expression} if self._write else {}
        return super().__getstate__() | {"_write": None} | made

    @property
    def cost(self) -> int:
        """How many terms it takes to bound it once."""
        return 4 + 2 * len(self.powers) + 4 * len(self.waves)

    @cached_property
    def turns(self) -> list[float]:
        """Where between its ends it turns, in order; of a line or a single wave that is known."""
        if len(self.powers) <= 2 and not self.waves:  # noqa: PLR2004 - a straight line
            return []
        if len(self.powers) == len(self.waves) == 1:
            (wave,) = self.waves
            if abs(wave.frequency) * (self.high - self.low) < _OFTEN:
                return wave.crests(self.low, self.high)
        return super().turns

    @cached_property
    def derivative(self) -> "Series":
        """The derivative, made once."""
        powers = tuple(n * self.powers[n] for n in range(1, len(self.powers))) or (0.0,)
        waves = (Wave(a * f, f, phase, n + 1) for a, f, phase, n in self.waves)
        return Series(powers, tuple(waves), self.low, self.high)

    def restricted(self, low: float, high: float) -> "Series":
        """Return the part of it between two of its places."""
        powers, move = about(self.powers, low - self.low), low - self.low
        waves = (wave._replace(phase=wave.phase + wave.frequency * move) for wave in self.waves)
        return Series(tuple(powers), tuple(waves), low, high, partial(getattr, self, "expression"))

    def torque(self) -> Piece:
        """Return the product of the first and the second derivative."""
        v, a = self.derivative, self.derivative.derivative
        return v.times(a) or Expression(v.expression * a.expression, self.low, self.high)

    def plus(self, other: "Series") -> "Series":
        """Return the sum with another one over the same zone."""
        powers = tuple(a + b for a, b in zip_longest(self.powers, other.powers, fillvalue=0.0))
        return Series(powers, self.waves + other.waves, self.low, self.high)

    def times(self, other: "Series") -> "Series | None":
        """Return the product with another one over the same zone; None if that is no series."""
        if any(len(one.powers) > 1 and by.waves for one, by in ((self, other), (other, self))):
            return None
        powers = np.convolve(self.powers, other.powers).tolist()
        waves = [
            wave._replace(amplitude=by.powers[0] * wave.amplitude)
            for series, by in ((self, other), (other, self))
            for wave in series.waves
            if by.powers[0]
        ]
        for a, f, phase, n in self.waves:  # half the cosine of the difference less that of the sum
            for b, g, other_phase, m in other.waves:
                for side in (-1, 1):
                    turned = n + side * m + 1
                    beat = Wave(-side * a * b / 2, f + side * g, phase + side * other_phase, turned)
                    if abs(beat.frequency) > _NOTHING * abs(f):
                        waves.append(beat)
                    else:
                        powers[0] += beat._replace(frequency=0.0).at(0.0)
        return Series(tuple(powers), _merged(waves), self.low, self.high)

    def at(self, place: float) -> float:
        """Return the value at one place; what is left of terms that cancel each other is 0."""
        value = self.value(place)
        if abs(value) > self._rounding:  # that of the whole zone, which is known
            return value
        return value if abs(value) > _NOTHING * self.size(place - self.low) else 0.0

    @cached_property
    def value(self) -> Callable[[float], float]:
        """The function that returns the value at one place, but for rounding."""
        low, factors = self.low, self.powers[::-1]
        waves = [
            (-a if n % 4 > 1 else a, f, phase, math.cos if n % 2 else math.sin)
            for a, f, phase, n in self.waves
        ]

        def evaluate(place: float) -> float:
            u, value = place - low, 0.0
            for factor in factors:
                value = value * u + factor
            for amplitude, frequency, phase, wave in waves:
                value += amplitude * wave(frequency * u + phase)
            return value

        return evaluate

    @cached_property
    def _rounding(self) -> float:
        return _NOTHING * self.size(self.high - self.low)

    def over(self, places: Floats, out: Floats | None = None) -> Floats:
        """Return the values at many places; in `out`, if given: new memory takes time."""
        values = np.empty(np.shape(places)) if out is None else out
        if len(self.powers) == 1:
            values[...] = self.powers[0]
        if self.is_constant:
            return values
        u = places - self.low if self.low else places
        grown: Floats | float = self.powers[-1]  # which fills no array to be multiplied at once
        for factor in self.powers[-2::-1]:
            grown = np.multiply(u, grown, out=values)
            if factor:
                values += factor
        part = np.empty_like(values) if self.waves else values
        for wave in self.waves:
            wave.over(u, part)
            values += part
        return values

    def bounds(self, low: float, high: float) -> tuple[float, float]:
        """Return what every value between two places of the zone certainly lies between."""
        start, end = low - self.low, high - self.low
        least, most = _polynomial_bounds(self.powers, start, end)
        turns = 0.0
        for wave in self.waves:
            some, others = wave.bounds(start, end)
            least, most = least + some, most + others
            turns = max(turns, abs(wave.frequency) * end)
        operations = 4 * (len(self.powers) + len(self.waves) + turns + 2)
        slack = operations * _ULP * self.size(end)  # more than rounding can come to
        return least - slack, most + slack

    def size(self, width: float) -> float:
        """Return the sum of the magnitudes of all terms, at most, up to u = `width`."""
        size = 0.0
        for factor in reversed(self.powers):
            size = size * abs(width) + abs(factor)
        return size + sum(abs(wave.amplitude) for wave in self.waves)

    @cached_property
    def expression(self) -> sympy.Expr:
        """It as an expression in `x`."""
        if self._write:
            return self._write()
        u = x - sympy.Float(self.low) if self.low else x
        powers = (sympy.Float(a) * u**n for n, a in enumerate(self.powers) if a)
        waves = (a * sympy.sin(f * u + phase + n * sympy.pi / 2) for a, f, phase, n in self.waves)
        return sympy.Add(*powers, *waves)


def about(powers: Iterable[float], place: float) -> list[float]:
    """Return the coefficients of a polynomial about another place."""
    moved = list(powers)
    for first in range(len(moved) - 1):
        for n in range(len(moved) - 2, first - 1, -1):
            moved[n] += place * moved[n + 1]
    return moved


def _polynomial_bounds(powers: tuple[float, ...], start: float, end: float) -> tuple[float, float]:
    """Return what a polynomial lies between over 0 <= start <= end, but for rounding.

    Term by term, which is best near zero, and term by term about the middle, where it is best.
    """
    least = most = 0.0
    at_start = at_end = 1.0
    for factor in powers:
        rises = factor > 0
        least += factor * (at_start if rises else at_end)
        most += factor * (at_end if rises else at_start)
        at_start, at_end = at_start * start, at_end * end
    if len(powers) <= 2 or start == end:  # noqa: PLR2004 - a straight line, or a place
        return least, most
    middle, half = (start + end) / 2, (end - start) / 2
    centre, *others = about(powers, middle)
    low = high = centre
    size = 1.0
    for n, factor in enumerate(others, 1):
        size *= half
        reach = abs(factor) * size
        low -= reach if n % 2 or factor < 0 else 0.0
        high += reach if n % 2 or factor > 0 else 0.0
    return max(least, low), min(most, high)


def _passes(first: float, last: float, which: int) -> bool:
    """Return whether a number that leaves `which` when divided by 4 lies between two others."""
    return math.ceil((first - which) / 4) <= math.floor((last - which) / 4)


def _merged(waves: Iterable[Wave]) -> tuple[Wave, ...]:
    """Return the waves with those of one frequency and one phase added up."""
    found: dict[tuple[Any, ...], Wave] = {}
    for wave in map(Wave.upright, waves):
        like = f"{wave.frequency:.13g}", *wave[2:]
        before = found[like].amplitude if like in found else 0.0
        found[like] = wave._replace(amplitude=before + wave.amplitude)
    return tuple(wave for wave in found.values() if wave.amplitude)
