"""A motion law: one expression S(x); everything else is derived from it, nothing is typed.

With x = t/tm the time and S = h/hm the displacement, both made dimensionless, a law runs from
S(0) = 0 to S(1) = 1. The motion of a machine follows by scaling:

    h = hm S,   v = hm/tm V,   a = hm/tm^2 A,   j = hm/tm^3 J,

with V, A and J the first three derivatives of S. Their largest magnitudes are the peak factors
Cv, Ca and Cj.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import sympy
from numpy.typing import ArrayLike

from cammotion.laws.branches import Branch, cut_at_turns, turns_of, where
from cammotion.laws.zones import (
    Zone,
    as_series,
    compile_zones,
    cut,
    derive,
    exact,
    join,
    multiply,
    x,
)
from cammotion.quantities import Floats, InputError, Numbers, Quantity

_TIME = Quantity("dimensionless time x = t/tm", "", example=0.5, high=1.0, low_included=True)
_WAY = Quantity("dimensionless displacement S", "", example=0.5, high=1.0, low_included=True)

_SHARE = Quantity("share of constant velocity", "", example=0.5, high=0.999, low_included=True)

_ROUNDING = 1e-12  # by so much the ends of a law may miss 0 and 1
_JUMP = 1e-9  # what is smaller at a joint is rounding

_JERK = 3  # the highest derivative a law is asked for


@dataclass(frozen=True, eq=False)
class MotionLaw:
    """A motion law: its name and its one expression `s` in the symbol `x`, 0 <= x <= 1.

    `also_called` lists the other names under which the field knows the same law; `sampled_at` the
    places of the points through which a law of `law_from_points` goes.

    >>> parabola_up = MotionLaw("square", x**2)
    >>> parabola_up.v
    2*x
    >>> parabola_up(0.5)
    0.25
    """

    name: str
    s: sympy.Expr
    also_called: tuple[str, ...] = ()
    sampled_at: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        expression = isinstance(self.s, sympy.Expr)
        others = sorted(map(str, self.s.free_symbols - {x})) if expression else []
        if not expression or others:
            said = f"has the symbol {', '.join(others)}" if others else f"is {self.s!r}"
            raise InputError(
                f"The expression of the law {self.name!r} {said}; it has to be a SymPy expression "
                "in cammotion.x alone: give, for example, 3*x**2 - 2*x**3."
            )

    @property
    def is_sampled(self) -> bool:
        """Whether the law goes through points, by a curve that somebody chose."""
        return bool(self.sampled_at)

    @property
    def v(self) -> sympy.Expr:
        """The dimensionless velocity V = dS/dx."""
        return join(self._zones(1))

    @property
    def a(self) -> sympy.Expr:
        """The dimensionless acceleration A = dV/dx."""
        return join(self._zones(2))

    @property
    def j(self) -> sympy.Expr:
        """The dimensionless jerk J = dA/dx; the impulses of `jerk_impulses` are not in it."""
        return join(self._zones(3))

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Numbers:
        """Return S (or V, A, J for derivative 1, 2, 3) at `x`.

        `x` is dimensionless, 0 to 1, a number or an array of any shape; the result has its shape
        and no unit. Raises InputError for an `x` outside the motion or another derivative.

        >>> MotionLaw("cubic", 3 * x**2 - 2 * x**3)([0, 0.5, 1], derivative=1)
        array([0. , 1.5, 0. ])
        """
        if not (isinstance(derivative, int) and 0 <= derivative <= _JERK):
            raise InputError(
                f"The derivative is {derivative!r}; it has to be 0 for S, 1 for V, 2 for A "
                "or 3 for J."
            )
        if derivative not in self._functions:
            self._functions[derivative] = compile_zones(self._pieces(derivative))
        values = self._functions[derivative](_checked(x))
        return values if np.ndim(values) else float(values)

    @property
    def Cv(self) -> float:  # noqa: N802 (the field's symbol)
        """The velocity factor: the largest abs(V); infinite where S jumps."""
        return self._peak(1)

    @property
    def Ca(self) -> float:  # noqa: N802
        """The acceleration factor: the largest abs(A); infinite where V jumps.

        >>> print(f"{MotionLaw('cubic', 3 * x**2 - 2 * x**3).Ca:.3f}")
        6.000
        """
        return self._peak(2)

    @property
    def Cj(self) -> float:  # noqa: N802
        """The jerk factor: the largest abs(J); infinite where A jumps, also from or to a dwell."""
        return self._peak(3)

    @cached_property
    def Cq(self) -> float:  # noqa: N802
        """The torque factor of the inertia: the largest abs(V A)."""
        pairs = enumerate(zip(self._pieces(1), self._pieces(2), strict=True))
        return _largest(
            v._replace(curve=multiply(v.curve, a.curve) or self._power(number))
            for number, (v, a) in pairs
        )

    @cached_property
    def Cj_inside(self) -> float:  # noqa: N802
        """The largest abs(J) away from the jumps of A."""
        return _largest(self._pieces(3))

    @cached_property
    def jerk_impulses(self) -> tuple[tuple[float, float], ...]:
        """Where A jumps, and by how much; before the move and after it A is 0.

        >>> MotionLaw("cubic", 3 * x**2 - 2 * x**3).jerk_impulses
        ((0.0, 6.0), (1.0, 6.0))
        """
        return self._jumps(2)

    @cached_property
    def is_symmetric(self) -> bool:
        """Whether the second half is the first half turned about the middle."""
        places = np.mod(np.arange(1, 40) * np.sqrt(2), 1)
        return bool(np.allclose(self(places), 1 - self(1 - places), rtol=0, atol=_ROUNDING))

    def with_constant_velocity(self, share: float) -> "MotionLaw":
        """Return the law with a share of constant velocity put into the middle of it.

        `share` is the part of the time, from 0 on and below 1. Raises InputError for another one,
        and for a law that is not symmetric.

        >>> print(f"{MotionLaw('cubic', 3 * x**2 - 2 * x**3).with_constant_velocity(0.5).Cv:.3f}")
        1.200
        """
        part = exact(_SHARE.number(share))
        if not self.is_symmetric:
            raise InputError(
                f"The law {self.name!r} is not symmetric, so that it has no middle: give a law "
                "whose second half mirrors the first."
            )
        if not part:
            return self
        half = sympy.Rational(1, 2)
        middle = next(zone for zone in self._zones(0) if zone.high >= half)
        steepest = sympy.diff(middle.curve, x).xreplace({x: half})
        velocity = 1 / (part + (1 - part) / steepest)
        ends = (1 - part) / 2
        scale = velocity * (1 - part) / steepest
        zones = [
            Zone(
                scale * zone.curve.xreplace({x: x / (1 - part)}),
                zone.low * float(1 - part),
                min(zone.high, 0.5) * float(1 - part),
            )
            for zone in self._zones(0)
            if zone.low < half
        ]
        zones.append(Zone(half + velocity * (x - half), float(ends), 0.5))
        title = f"{self.name}, {float(part):.4g} constant velocity"
        return MotionLaw(title, mirrored(zones), (), self._sampled_with(float(1 - part)))

    def _sampled_with(self, rest: float) -> tuple[float, ...]:
        """Return where the points come to lie when both halves take `rest` of their time."""
        first = (place * rest for place in self.sampled_at if place <= 1 / 2)
        second = (1 - (1 - place) * rest for place in self.sampled_at if place >= 1 / 2)
        return (*first, *second)

    @cached_property
    def branches(self) -> tuple[Branch, ...]:
        """The law cut at each joint and wherever S turns; that no turn is missed is proved."""
        return cut_at_turns(self._pieces(0))

    @property
    def is_monotone(self) -> bool:
        """Whether S rises from the start to the end and never falls."""
        return all(branch.s_high >= branch.s_low for branch in self.branches)

    def inverse(self, s: ArrayLike) -> Numbers:
        """Return the first x at which the law has come to S = s.

        `s` is dimensionless, 0 to 1, a number or an array of any shape; the result has its shape.
        It is solved for until the last bit of x. Raises InputError for an `s` out of range, and
        for a law that turns on its way and so passes some places more than once, and for one that
        does not go from 0 to 1.

        >>> print(f"{MotionLaw('cubic', 3 * x**2 - 2 * x**3).inverse(0.104):.5f}")
        0.20000
        """
        places = _WAY.array(s)
        self.check_way()
        if not self.is_monotone:
            raise InputError(
                f"The law {self.name!r} turns back on its way, so that it passes some places more "
                "than once: use where_above, which returns every interval."
            )
        roots = [self._first(place) for place in places.flat]
        return np.reshape(roots, places.shape) if places.ndim else roots[0]

    def where_above(self, s: float) -> list[tuple[float, float]]:
        """Return the intervals of x in which S > s, in order; solved for, not sampled.

        >>> MotionLaw("cubic", 3 * x**2 - 2 * x**3).where_above(0.5)
        [(0.5, 1.0)]
        """
        return where(self.branches, s, 1)

    def where_below(self, s: float) -> list[tuple[float, float]]:
        """Return the intervals of x in which S < s; else like `where_above`."""
        return where(self.branches, s, -1)

    def check_way(self) -> None:
        """Raise InputError unless the law goes from S(0) = 0 to S(1) = 1."""
        start, end = self.branches[0].s_low, self.branches[-1].s_high
        if max(abs(start), abs(end - 1)) > _ROUNDING:
            raise InputError(
                f"The law {self.name!r} goes from S(0) = {start:g} to S(1) = {end:g}; a move goes "
                "from 0 to 1: subtract S(0), and divide by S(1) - S(0)."
            )

    def __repr__(self) -> str:
        sampled = f", sampled at {len(self.sampled_at)} points" if self.is_sampled else ""
        return f"MotionLaw({self.name!r}{sampled})"

    @cached_property
    def _functions(self) -> dict[int, Callable[[Floats], Floats]]:
        """S, V, A and J compiled for arrays, each when it is first asked for."""
        return {}

    @cached_property
    def _derived(self) -> list[tuple[Zone, ...]]:
        """The zones of S, V, ..., as far as they have been asked for."""
        return [cut(self.s)]

    def _zones(self, derivative: int) -> tuple[Zone, ...]:
        """Return the zones of a curve as expressions."""
        while len(self._derived) <= derivative:
            self._derived.append(derive(self._derived[-1]))
        return self._derived[derivative]

    @cached_property
    def _reckoned(self) -> list[tuple[Zone, ...]]:
        return [as_series(self._zones(0))]

    def _pieces(self, derivative: int) -> tuple[Zone, ...]:
        """Return the zones of a curve to reckon with, as series wherever they can be."""
        while len(self._reckoned) <= derivative:
            self._reckoned.append(derive(self._reckoned[-1]))
        return self._reckoned[derivative]

    def _power(self, number: int) -> sympy.Expr:
        """Return V A in a zone as an expression."""
        return self._zones(1)[number].curve * self._zones(2)[number].curve

    def _peak(self, derivative: int) -> float:
        """Return the largest magnitude of a curve, infinity where the one before it jumps."""
        if derivative not in self._peaks:
            jumps = any(self._jumps(lower) for lower in range(derivative))
            self._peaks[derivative] = math.inf if jumps else _largest(self._pieces(derivative))
        return self._peaks[derivative]

    @cached_property
    def _peaks(self) -> dict[int, float]:
        return {}

    def _jumps(self, derivative: int) -> tuple[tuple[float, float], ...]:
        """Return where a curve jumps and by how much; outside of the move it stands still."""
        zones = self._pieces(derivative)
        starts = [zone.value(zone.low) for zone in zones]
        ends = [zone.value(zone.high) for zone in zones]
        after = 1.0 if derivative == 0 else 0.0
        places = [*(zone.low for zone in zones), 1.0]
        sizes = np.subtract([*starts, after], [0.0, *ends])
        return tuple(
            (place, float(size))
            for place, size in zip(places, sizes, strict=True)
            if abs(size) > _JUMP
        )

    def _first(self, s: float) -> float:
        branch = next((branch for branch in self.branches if s <= branch.s_high), self.branches[-1])
        if s <= branch.s_low:
            return branch.low
        return branch.high if s >= branch.s_high else branch.solve(s)


def _checked(x: ArrayLike) -> Floats:
    """Return times as an array, each of them from 0 to 1; many floats at once take no detour."""
    if type(x) is np.ndarray and x.dtype == np.float64 and x.size:
        times: Floats = x
        if times.min() >= 0 and times.max() <= 1:
            return times
    return _TIME.array(x)


def mirrored(half: Iterable[Zone]) -> sympy.Expr:
    """Return the expression whose second half is the first one turned about (1/2, 1/2)."""
    zones = list(half)
    turned = (
        Zone(1 - z.curve.xreplace({x: 1 - x}), 1 - z.high, 1 - z.low) for z in reversed(zones)
    )
    return join([*zones, *turned])


def _largest(zones: Iterable[Zone]) -> float:
    """Return the largest magnitude: it lies at an end of a zone or where the curve turns."""
    return max(
        abs(zone.value(place)) for zone in zones for place in (zone.low, *turns_of(zone), zone.high)
    )
