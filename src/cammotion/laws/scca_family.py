"""The SCCA family: sine - constant - cosine acceleration, five of the named laws among it."""

import math
from functools import partial
from typing import Any, NamedTuple

import sympy

from cammotion.arguments import checked
from cammotion.laws.curve import mirrored
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.series import Series, Wave
from cammotion.laws.symbols import exact, x
from cammotion.quantities import InputError, Quantity

NAMED_PARTS: dict[str, tuple[float, float, float]] = {
    "constant acceleration": (0, 1, 0),
    "simple harmonic": (0, 0, 1),
    "modified trapezoid": (0.25, 0.5, 0.25),
    "modified sine": (0.25, 0, 0.75),
    "cycloidal": (0.5, 0, 0.5),
}
"""The named laws of the family, and their b, c and d."""

LEAST_CA = 4
"""The least Ca of any law from rest to rest: 1 is the integral of (1/2 - x) A, at most Ca/4."""

_PART = Quantity("zone of the SCCA law", "", example=0.25, high=1.0, low_included=True)
_ROUNDING = 1e-9
_pi = sympy.pi


@checked
def scca(
    b: float, c: float, d: float, *, name: str = "", also_called: tuple[str, ...] = ()
) -> MotionLaw:
    """Return a law of the family sine - constant - cosine acceleration.

    The acceleration rises as a sine over b/2 of the time, is constant over c/2 and falls as a
    cosine over d/2, to the middle; the second half mirrors the first. b, c and d are dimensionless,
    from 0 to 1, and add up to 1. With b = 0 or d = 0 that zone is left out, and the acceleration
    jumps there. Raises InputError for others.

    >>> print(f"{scca(0.25, 0.5, 0.25).Ca:.5f}")  # 8 pi / (2 + pi)
    4.88812
    """
    b, c, d = map(_PART.number, (b, c, d))
    parts = _exact_parts(b, c, d)
    half = [_piece(number, parts) for number, part in enumerate(parts) if part]
    title = name or f"SCCA({b:g}, {c:g}, {d:g})"
    return MotionLaw(title, mirrored(half), also_called)


def _exact_parts(b: float, c: float, d: float) -> tuple[sympy.Rational, ...]:
    """Return b, c and d as fractions that add up to 1."""
    parts = [exact(part) for part in (b, c, d)]
    if abs(sum(parts) - 1) > _ROUNDING:
        raise InputError(
            f"The zones of the SCCA law, {b:.12g} + {c:.12g} + {d:.12g}, add up to "
            f"{float(sum(parts)):.12g}: let b, c and d add up to 1."
        )
    b_, c_, d_ = parts[0], parts[1], 1 - parts[0] - parts[1]
    if d_ < 0 or not parts[2]:  # rounding must not become a zone
        return b_ / (b_ + c_), c_ / (b_ + c_), sympy.Integer(0)
    return b_, c_, d_


def scca_factor(b: Any, d: Any, pi: Any = _pi) -> Any:
    """Return Ca of the law with these b and d; c is what they leave of 1.

    They are symbols, numbers or arrays, and so is pi. With it a law comes to 1/2 in the middle.

    >>> scca_factor(0, 0)
    4
    """
    return 4 * pi**2 / ((pi**2 - 8) * (b**2 - d**2) - 2 * pi * (pi - 2) * b + pi**2)


class _Zone(NamedTuple):
    """A zone of the first half: a polynomial in u = x - low and a wave, sine or cosine."""

    powers: tuple[Any, ...]
    amplitude: Any
    frequency: Any
    is_cosine: bool
    low: Any
    high: Any


def _zone(number: int, parts: tuple[Any, ...], pi: Any) -> _Zone:
    """Return S in the first, second or third zone, for floats or for exact numbers."""
    b, c, d = parts
    peak = scca_factor(b, d, pi)
    first, second = b / 2, (b + c) / 2  # where the zones end
    v_1 = peak * b / pi
    s_1 = v_1 * (b / 2 - b / pi)
    if number == 0:
        return _Zone((0, v_1), -v_1 * b / pi, pi / b, False, 0, first)
    if number == 1:
        return _Zone((s_1, v_1, peak / 2), 0, 0, False, first, second)
    fall = peak * (d / pi) ** 2
    s_2, v_2 = s_1 + v_1 * c / 2 + peak * c**2 / 8, v_1 + peak * c / 2
    return _Zone((s_2 + fall, v_2), -fall, pi / d, True, second, (b + c + d) / 2)


def _piece(number: int, parts: tuple[sympy.Rational, ...]) -> Series:
    """Return a zone in floats; its expression is exact, and made when it is asked for."""
    in_floats = tuple(map(float, parts))
    powers, amplitude, frequency, is_cosine, low, high = _zone(number, in_floats, math.pi)
    waves = (Wave(amplitude, frequency, 0.0, int(is_cosine)),) if amplitude else ()
    return Series(powers, waves, low, high, write=partial(zone_expression, number, parts))


def zone_expression(number: int, parts: tuple[Any, ...]) -> sympy.Expr:
    """Return S in the first, second or third zone, for exact numbers or symbols b, c and d."""
    zone = _zone(number, parts, _pi)
    u = x - zone.low
    wave = (sympy.cos if zone.is_cosine else sympy.sin)(zone.frequency * u)
    return sum(power * u**n for n, power in enumerate(zone.powers)) + zone.amplitude * wave
