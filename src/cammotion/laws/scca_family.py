"""The SCCA family: sine - constant - cosine acceleration, five of the named laws among it."""

import math
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any, NamedTuple

import numpy as np
import sympy
from numpy.typing import ArrayLike

from cammotion.laws.motion_law import MotionLaw, mirrored
from cammotion.laws.turning import bisect
from cammotion.laws.zones import Zone, exact, x
from cammotion.quantities import Floats, InputError, Numbers, Quantity

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
_CURVES = range(4)  # S, V, A and J
_pi, _half = sympy.pi, sympy.Rational(1, 2)


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
    zones = _first_half(*_exact_parts(b, c, d))
    half = [Zone(curve, float(low), float(high)) for curve, low, high in zones]
    return MotionLaw(name or f"SCCA({b:g}, {c:g}, {d:g})", mirrored(half), also_called)


class SccaCurves:
    """The curves and factors of such a law in plain numbers, fast enough to follow a hand.

    They come from the same expressions as those of `scca`, compiled once for every b, c and d.
    Takes b, c and d as `scca` does, and raises the same InputError; `parts` are the three, cleared
    of rounding.

    >>> cycloidal = SccaCurves(0.5, 0, 0.5)
    >>> print(f"{cycloidal.Ca:.4f} {cycloidal.Cj:.4f} {cycloidal.Cq:.4f}")
    6.2832 39.4784 8.1621
    """

    def __init__(self, b: float, c: float, d: float) -> None:
        b, c, d = map(float, _exact_parts(b, c, d))
        self.parts = b, c, d
        compiled = zip(self.parts, _compiled_zones(), strict=True)
        self._zones = [zone.of(b, c, d) for part, zone in compiled if part]

    def sample(self, count: int) -> Floats:
        """Return x, S, V, A and J at `count` places of every zone, its ends included.

        All are dimensionless. The shape is (zones, 5, count), with the zones of both halves in
        order: what jumps between two of them has a value in each.

        >>> SccaCurves(0, 1, 0).sample(2)[:, 3]  # A
        array([[ 4.,  4.],
               [-4., -4.]])
        """
        share = np.linspace(0, 1, count)
        first = [_with_places(zone, share) for zone in self._zones]
        return np.array([*first, *map(_turned, reversed(first))])

    @property
    def Cv(self) -> float:  # noqa: N802 (the field's symbol)
        """The velocity factor: V in the middle."""
        last = self._zones[-1]
        return float(last.curves(last.high)[1])

    @property
    def Ca(self) -> float:  # noqa: N802
        """The acceleration factor."""
        return float(acceleration_factor(self.parts[0], self.parts[2]))

    @property
    def Cj(self) -> float:  # noqa: N802
        """The jerk factor: abs(J) at the ends or in the middle; infinite where A jumps."""
        return math.inf if self.jumps_at_ends or self.jumps_in_middle else self.Cj_inside

    @property
    def Cj_inside(self) -> float:  # noqa: N802
        """The largest abs(J) away from the jumps of A: at an end of a zone."""
        ends = (zone.curves(place)[3] for zone in self._zones for place in (zone.low, zone.high))
        return float(max(map(abs, ends)))

    @property
    def Cq(self) -> float:  # noqa: N802
        """The torque factor of the inertia, the largest abs(V A).

        Up to the last zone of the first half V rises and A does not fall. There V A turns once, if
        at all: where its slope A^2 + V J is 0.
        """
        last = self._zones[-1]

        def is_rising(place: float) -> bool:
            _, v, a, j = last.curves(place)
            return bool(a * a + v * j > 0)

        _, v, a, _ = last.curves(bisect(is_rising, last.low, last.high))
        return float(v * a)

    @property
    def jumps_at_ends(self) -> bool:
        """Whether A jumps at the start and at the end of the move."""
        return self.parts[0] == 0

    @property
    def jumps_in_middle(self) -> bool:
        """Whether A jumps in the middle of the move."""
        return self.parts[2] == 0


def acceleration_factor(b: ArrayLike, d: ArrayLike) -> Numbers:
    """Return Ca of the law with these b and d, dimensionless; c is what they leave of 1.

    They are numbers or arrays of one shape, each from 0 to 1. Raises InputError for others.

    >>> acceleration_factor([0, 0.5], [0, 0.5])
    array([4.        , 6.28318531])
    """
    parts = _PART.array(b), _PART.array(d)
    most = np.max(np.add(*parts))
    if most > 1 + _ROUNDING:
        raise InputError(f"b + d of the SCCA law is {most:g}: let b and d add up to at most 1.")
    return _compiled_peak()(*parts)


def _exact_parts(b: float, c: float, d: float) -> tuple[sympy.Rational, ...]:
    """Return b, c and d as fractions that add up to 1."""
    parts = [exact(_PART.number(part)) for part in (b, c, d)]
    if abs(sum(parts) - 1) > _ROUNDING:
        raise InputError(
            f"The zones of the SCCA law, {b:g} + {c:g} + {d:g}, add up to {float(sum(parts)):g}: "
            "let b, c and d add up to 1."
        )
    b_, c_, d_ = parts[0], parts[1], 1 - parts[0] - parts[1]
    if d_ < 0 or not parts[2]:  # rounding must not become a zone
        return b_ / (b_ + c_), c_ / (b_ + c_), sympy.Integer(0)
    return b_, c_, d_


def _peak(b: sympy.Expr, d: sympy.Expr) -> sympy.Expr:
    """Return the largest acceleration, with which the law comes to 1/2 in the middle."""
    return 4 * _pi**2 / ((_pi**2 - 8) * (b**2 - d**2) - 2 * _pi * (_pi - 2) * b + _pi**2)


def _first_half(
    b: sympy.Expr, c: sympy.Expr, d: sympy.Expr
) -> Iterator[tuple[sympy.Expr, sympy.Expr, sympy.Expr]]:
    """Yield S in each zone of the first half and from where to where; a zone of 0 is left out.

    b, c and d are fractions, for one law, or symbols, for all of them.
    """
    peak = _peak(b, d)
    first, second = b / 2, (b + c) / 2  # where the zones end
    v_1, s_1 = peak * b / _pi, peak * b / _pi * (b / 2 - b / _pi)
    v_2 = v_1 + peak * c / 2
    s_2 = s_1 + v_1 * c / 2 + peak * c**2 / 8
    if b != 0:
        yield peak * b / _pi * (x - b / _pi * sympy.sin(_pi * x / b)), sympy.Integer(0), first
    if c != 0:
        u = x - first
        yield s_1 + v_1 * u + peak * u**2 / 2, first, second
    if d != 0:
        w = x - second
        yield s_2 + v_2 * w + peak * (d / _pi) ** 2 * (1 - sympy.cos(_pi * w / d)), second, _half


class _NumericZone(NamedTuple):
    """S, V, A and J as a function of x, and from where to where they hold."""

    curves: Callable[[Any], Any]
    low: float
    high: float


class _CompiledZone(NamedTuple):
    """The same for all b, c and d: functions of (x, b, c, d), and of (b, c, d)."""

    curves: Callable[..., Any]
    ends: Callable[..., tuple[float, float]]

    def of(self, *parts: float) -> _NumericZone:
        """Return the zone of one law."""
        return _NumericZone(lambda places: self.curves(places, *parts), *self.ends(*parts))


@cache
def _compiled_zones() -> tuple[_CompiledZone, ...]:
    """Compile the three zones of the first half; V, A and J are derived from S."""
    parts = sympy.symbols("b c d")
    return tuple(
        _CompiledZone(
            sympy.lambdify(
                (x, *parts), [sympy.diff(curve, x, n) for n in _CURVES], "numpy", cse=True
            ),
            sympy.lambdify(parts, (low, high), "math"),
        )
        for curve, low, high in _first_half(*parts)
    )


@cache
def _compiled_peak() -> Callable[..., Any]:
    parts = sympy.symbols("b d")
    function: Callable[..., Any] = sympy.lambdify(parts, _peak(*parts), "numpy")
    return function


def _with_places(zone: _NumericZone, share: Floats) -> Floats:
    """Return x, S, V, A and J at these shares of a zone."""
    places = zone.low + (zone.high - zone.low) * share
    return np.array(np.broadcast_arrays(places, *zone.curves(places)))


def _turned(zone: Floats) -> Floats:
    """Return a zone turned about (1/2, 1/2): S(1 - x) = 1 - S(x), and each derivative of it."""
    places, s, v, a, j = zone[:, ::-1]
    return np.array([1 - places, 1 - s, v, -a, j])
