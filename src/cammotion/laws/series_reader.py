"""SymPy's expressions read as series, where they have that form."""

from functools import lru_cache, reduce
from itertools import zip_longest

import mpmath
import sympy

from cammotion.laws.series import BITS, NOTHING, Number, Series, Wave

_TAME = 1e5  # larger terms that cancel each other would leave too few digits of a float
_HIGHEST = 30  # the degree up to which powers are multiplied out


def series_of(curve: sympy.Expr, low: float, high: float) -> Series | None:
    """Return a smooth expression in one symbol as a series about `low`; None for another form.

    >>> x = sympy.Symbol("x")
    >>> series_of(x**2 + sympy.cos(sympy.pi * x), 0, 1).derive().value(1)
    2.0
    >>> series_of(sympy.exp(x), 0, 1)
    """
    try:
        with mpmath.workprec(BITS):
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
    return _constant(mpmath.mpmathify(curve._to_mpmath(BITS)))


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
    product = one.times(other)
    if product is None or len(product.powers) > _HIGHEST:
        raise _OtherFormError
    return product


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
    return number if abs(number) > NOTHING else mpmath.mpf(0)
