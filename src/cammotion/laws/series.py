"""A polynomial and waves: the form of most zones of motion laws, and quick in all that is asked.

SymPy can do all of it with any expression, but takes its time. Here the constants of a zone are
there already, with far more digits than a float has (`series_reader` computes them); a derivative
is a product for each term, and a value or a bound a few sums.
"""

import math
from collections.abc import Callable
from functools import cached_property, reduce
from typing import Any, NamedTuple

import mpmath
import numpy as np

from cammotion.quantities import Floats

BITS = 170
"""Of every constant: 51 digits."""
NOTHING = 1e-30
"""What is left of a sum of such constants that cancel each other."""

Number = Any  # mpmath's numbers come without types


class Wave(NamedTuple):
    """A wave, amplitude * sin(frequency * u + phase + quarters * pi/2)."""

    amplitude: Number
    frequency: Number
    phase: Number
    quarters: int = 0


class Term(NamedTuple):
    """A wave in floats: amplitude * function(frequency * u + phase)."""

    amplitude: float
    frequency: float
    phase: float
    is_cosine: bool


class Series:
    """A polynomial in u = x - `origin`, its coefficients by rising power, and waves in u."""

    def __init__(
        self, powers: list[Number], waves: list[Wave] | None = None, origin: float = 0.0
    ) -> None:
        self.powers = powers
        self.waves = waves or []
        self.origin = origin

    @property
    def is_straight(self) -> bool:
        """Whether it is a straight line."""
        return len(self.powers) <= 2 and not self.waves  # noqa: PLR2004

    def derive(self) -> "Series":
        """Return the derivative."""
        with mpmath.workprec(BITS):
            powers = [n * factor for n, factor in enumerate(self.powers)][1:]
            waves = [
                Wave(a * frequency, frequency, phase, quarters + 1)
                for a, frequency, phase, quarters in self.waves
            ]
            return Series(powers or [mpmath.mpf(0)], waves, self.origin)

    def times(self, other: "Series") -> "Series | None":
        """Return the product with another one about the same origin; None if that is no series."""
        if any(len(a.powers) > 1 and b.waves for a, b in ((self, other), (other, self))):
            return None
        with mpmath.workprec(BITS):
            powers = [mpmath.mpf(0)] * (len(self.powers) + len(other.powers) - 1)
            for n, a in enumerate(self.powers):
                for m, b in enumerate(other.powers):
                    powers[n + m] += a * b
            waves = [
                wave._replace(amplitude=by.powers[0] * wave.amplitude)
                for series, by in ((self, other), (other, self))
                for wave in series.waves
                if by.powers[0]
            ]
            for one in self.waves:
                for another in other.waves:
                    constant, beats = _beat(one, another)
                    powers[0] += constant
                    waves += beats
            return Series(powers, waves, self.origin)

    def value(self, place: float) -> float:
        """Return the value at x = `place`, computed with many digits and rounded once."""
        with mpmath.workprec(BITS):
            u = mpmath.mpf(place) - self.origin
            value = reduce(lambda sum_, factor: sum_ * u + factor, reversed(self.powers))
            for amplitude, frequency, phase, quarters in self.waves:
                angle = frequency * u + phase + quarters * mpmath.pi / 2
                value += amplitude * mpmath.sin(angle)
            return float(value) if abs(value) > NOTHING else 0.0

    @cached_property
    def at(self) -> Callable[[float], float]:
        """The function that returns the value at one x, in floats."""
        origin, factors = self.origin, self.factors
        terms = [
            (amplitude, frequency, phase, math.cos if is_cosine else math.sin)
            for amplitude, frequency, phase, is_cosine in self._terms
        ]

        def value(place: float) -> float:
            u, value = place - origin, 0.0
            for factor in factors:
                value = value * u + factor
            for amplitude, frequency, phase, wave in terms:
                value += amplitude * wave(frequency * u + phase)
            return value

        return value

    def over(self, places: Floats, out: Floats | None = None) -> Floats:
        """Return the values at many places, in floats; in `out`, if given.

        By Horner's rule, and wave by wave. An array in memory that was not used before takes
        longer to get than to fill, so that as few are made as can be.
        """
        values = np.empty(np.shape(places)) if out is None else out
        first, *factors = self.factors
        values[...] = first
        if not (factors or self._terms):
            return values
        u = places - self.origin if self.origin else places
        for factor in factors:
            values *= u
            if factor:
                values += factor
        angle = np.empty_like(values) if self._terms else values
        for amplitude, frequency, phase, is_cosine in self._terms:
            np.multiply(u, frequency, out=angle)
            if phase:
                angle += phase
            (np.cos if is_cosine else np.sin)(angle, out=angle)
            angle *= amplitude
            values += angle
        return values

    def bounds(self, low: float, high: float) -> tuple[float, float]:
        """Return what every value in [low, high] certainly lies between; `origin` <= `low`."""
        start, end = low - self.origin, high - self.origin
        least = most = 0.0
        at_start = at_end = 1.0
        for factor in reversed(self.factors):
            rising = factor > 0
            least += factor * (at_start if rising else at_end)
            most += factor * (at_end if rising else at_start)
            at_start *= start
            at_end *= end
        for term in self._terms:
            some, others = _bounds(term, start, end)
            least, most = least + some, most + others
        slack = self._slack(end)
        return least - slack, most + slack

    @cached_property
    def factors(self) -> list[float]:
        """The coefficients in floats, the highest power first."""
        return [float(factor) for factor in reversed(self.powers)]

    @cached_property
    def _terms(self) -> list[Term]:
        return [
            Term(float(-a if n % 4 > 1 else a), float(frequency), float(phase), n % 2 == 1)
            for a, frequency, phase, n in self.waves
        ]

    def size(self, width: float) -> float:
        """Return the sum of the magnitudes of all terms, at most, `width` from the origin on."""
        size = 0.0
        for factor in self.factors:
            size = size * width + abs(factor)
        return size + sum(abs(term.amplitude) for term in self._terms)

    def _slack(self, width: float) -> float:
        """Return more than the rounding errors of floats can come to, `width` from the origin."""
        turns = max((abs(term.frequency) * width for term in self._terms), default=0.0)
        operations = 4 * len(self.factors) + 4 * len(self._terms) + 4 * turns + 8
        return operations * math.ulp(1.0) * self.size(width)


def _beat(one: Wave, other: Wave) -> tuple[Number, list[Wave]]:
    """Return the product of two waves: half the cosine of the difference less that of the sum."""
    half = one.amplitude * other.amplitude / 2
    total = Wave(
        -half,
        one.frequency + other.frequency,
        one.phase + other.phase,
        one.quarters + other.quarters + 1,
    )
    difference = Wave(
        half,
        one.frequency - other.frequency,
        one.phase - other.phase,
        one.quarters - other.quarters + 1,
    )
    constant, waves = mpmath.mpf(0), []
    for wave in (total, difference):
        if abs(wave.frequency) > NOTHING:
            waves.append(wave)
        else:
            constant += wave.amplitude * mpmath.sin(wave.phase + wave.quarters * mpmath.pi / 2)
    return constant, waves


def _bounds(term: Term, start: float, end: float) -> tuple[float, float]:
    """Return the least and the most of a wave from u = start to u = end."""
    angles = [term.frequency * u + term.phase for u in (start, end)]
    wave: Callable[[float], float] = math.cos if term.is_cosine else math.sin
    values = [term.amplitude * wave(angle) for angle in angles]
    quarters = sorted(angle / (math.pi / 2) + term.is_cosine for angle in angles)
    highest = _passes(quarters, 1 if term.amplitude > 0 else 3)
    lowest = _passes(quarters, 3 if term.amplitude > 0 else 1)
    top = abs(term.amplitude)
    return -top if lowest else min(values), top if highest else max(values)


def _passes(quarters: list[float], which: int) -> bool:
    """Return whether a number that leaves `which` when divided by 4 lies between two others."""
    return math.ceil((quarters[0] - which) / 4) <= math.floor((quarters[1] - which) / 4)
