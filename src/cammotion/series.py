"""A polynomial and waves: the form of most zones of motion laws, and quick in all that is asked.

SymPy can do all of it with any expression, but takes its time. Here the constants of a zone are
computed once, with far more digits than a float has; then a derivative is a product for each
term, and a value or a bound a few sums.
"""

import math
from collections.abc import Callable
from functools import cached_property, lru_cache, reduce
from itertools import zip_longest
from typing import Any, NamedTuple

import mpmath
import numpy as np
import sympy

from cammotion.checks import Floats

_BITS = 170  # of every constant: 51 digits
_NOTHING = 1e-30  # what is left of a sum of such constants that cancel each other
_TAME = 1e5  # larger terms that cancel each other would leave too few digits of a float
_HIGHEST = 30  # the degree up to which powers are multiplied out

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
        with mpmath.workprec(_BITS):
            powers = [n * factor for n, factor in enumerate(self.powers)][1:]
            waves = [
                Wave(a * frequency, frequency, phase, quarters + 1)
                for a, frequency, phase, quarters in self.waves
            ]
            return Series(powers or [mpmath.mpf(0)], waves, self.origin)

    def value(self, place: float) -> float:
        """Return the value at x = `place`, computed with many digits and rounded once."""
        with mpmath.workprec(_BITS):
            u = mpmath.mpf(place) - self.origin
            value = reduce(lambda sum_, factor: sum_ * u + factor, reversed(self.powers))
            for amplitude, frequency, phase, quarters in self.waves:
                angle = frequency * u + phase + quarters * mpmath.pi / 2
                value += amplitude * mpmath.sin(angle)
            return float(value) if abs(value) > _NOTHING else 0.0

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


def series_of(curve: sympy.Expr, low: float, high: float) -> Series | None:
    """Return a smooth expression in one symbol as a series about `low`; None for another form.

    >>> x = sympy.Symbol("x")
    >>> series_of(x**2 + sympy.cos(sympy.pi * x), 0, 1).derive().value(1)
    2.0
    >>> series_of(sympy.exp(x), 0, 1)
    """
    try:
        with mpmath.workprec(_BITS):
            series = _moved(_collect(curve), low)
    except ValueError:  # another form, or a number that is none
        return None
    return series if series.size(high - low) < _TAME else None


class _OtherFormError(ValueError):
    """The expression is no sum of a polynomial and waves."""


@lru_cache(maxsize=10_000)
def _collect(curve: sympy.Expr) -> Series:
    """Return an expression as a series about 0; the constants of a law come back in each zone."""
    if curve.is_Symbol:
        return Series([mpmath.mpf(0), mpmath.mpf(1)])
    if curve.is_Add or curve.is_Mul:
        return reduce(_add if curve.is_Add else _multiply, map(_collect, curve.args))
    if curve.is_Pow:
        return _power(curve)
    if isinstance(curve, sympy.sin | sympy.cos):
        return _wave(_collect(curve.args[0]), int(isinstance(curve, sympy.cos)))
    if curve.free_symbols:
        raise _OtherFormError
    return _constant(mpmath.mpmathify(curve._to_mpmath(_BITS)))


def _constant(number: Number) -> Series:
    if not (isinstance(number, mpmath.mpf) and mpmath.isfinite(number)):
        raise _OtherFormError
    return Series([number])


def _is_constant(series: Series) -> bool:
    return len(series.powers) == 1 and not series.waves


def _add(one: Series, other: Series) -> Series:
    powers = [a + b for a, b in zip_longest(one.powers, other.powers, fillvalue=mpmath.mpf(0))]
    return Series(powers, one.waves + other.waves)


def _multiply(one: Series, other: Series) -> Series:
    if _is_constant(other):
        one, other = other, one
    if _is_constant(one):
        factor = one.powers[0]
        waves = [wave._replace(amplitude=factor * wave.amplitude) for wave in other.waves]
        return Series([factor * power for power in other.powers], waves)
    if one.waves or other.waves or len(one.powers) + len(other.powers) > _HIGHEST:
        raise _OtherFormError
    powers = [mpmath.mpf(0)] * (len(one.powers) + len(other.powers) - 1)
    for n, a in enumerate(one.powers):
        for m, b in enumerate(other.powers):
            powers[n + m] += a * b
    return Series(powers)


def _power(curve: sympy.Expr) -> Series:
    base, exponent = _collect(curve.base), curve.exp
    if exponent.is_Integer and 0 < exponent <= _HIGHEST:
        return reduce(_multiply, [base] * int(exponent))
    if not (_is_constant(base) and base.powers[0] and not exponent.free_symbols):
        raise _OtherFormError
    return _constant(base.powers[0] ** _collect(exponent).powers[0])


def _wave(angle: Series, quarters: int) -> Series:
    if angle.waves or len(angle.powers) > 2:  # noqa: PLR2004 (a straight line)
        raise _OtherFormError
    phase, *rest = angle.powers
    if not rest:
        return Series([mpmath.cos(phase) if quarters else mpmath.sin(phase)])
    return Series([mpmath.mpf(0)], [Wave(mpmath.mpf(1), rest[0], phase, quarters)])


def _moved(series: Series, origin: float) -> Series:
    """Return a series about 0 as one about another place, with each phase as small as can be."""
    powers = [*series.powers]
    for start in range(len(powers) - 1):
        for n in reversed(range(start, len(powers) - 1)):
            powers[n] += origin * powers[n + 1]
    waves = []
    for amplitude, frequency, start_phase, quarters in series.waves:
        phase = start_phase + frequency * origin
        turned = int(mpmath.nint(phase / (mpmath.pi / 2)))
        phase -= turned * mpmath.pi / 2
        waves.append(Wave(amplitude, frequency, _cleared(phase), quarters + turned))
    powers = [_cleared(power) for power in powers]
    while len(powers) > 1 and not powers[-1]:
        powers.pop()
    return Series(powers, waves, origin)


def _cleared(number: Number) -> Number:
    return number if abs(number) > _NOTHING else mpmath.mpf(0)


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
