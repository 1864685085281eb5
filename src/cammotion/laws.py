"""Motion laws: one expression S(x) each; everything else is derived from it, nothing is typed.

With x = t/tm the time and S = h/hm the displacement, both made dimensionless, a law runs from
S(0) = 0 to S(1) = 1. The motion of a machine follows by scaling:

    h = hm S,   v = hm/tm V,   a = hm/tm^2 A,   j = hm/tm^3 J,

with V, A and J the first three derivatives of S. Their largest magnitudes are the peak factors
Cv, Ca and Cj.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
import sympy
from numpy.typing import ArrayLike

from cammotion.checks import Floats, InputError, Numbers, Quantity, one_of
from cammotion.turning import bisect, turning_points

x = sympy.Symbol("x")
"""The dimensionless time t/tm, the variable of every law."""

_TIME = Quantity("dimensionless time x = t/tm", "", example=0.5, high=1.0, low_included=True)
_WAY = Quantity("dimensionless displacement S", "", example=0.5, high=1.0, low_included=True)

_ROUNDING = 1e-12  # by so much the ends of a law may miss 0 and 1

_JERK = 3  # the highest derivative a law is asked for


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


@dataclass(frozen=True, eq=False)
class MotionLaw:
    """A motion law: its name and its one expression `s` in the symbol `x`, 0 <= x <= 1.

    `also_called` lists the other names under which the field knows the same law.

    >>> parabola_up = MotionLaw("square", x**2)
    >>> parabola_up.v
    2*x
    >>> parabola_up(0.5)
    0.25
    """

    name: str
    s: sympy.Expr
    also_called: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        expression = isinstance(self.s, sympy.Expr)
        others = sorted(map(str, self.s.free_symbols - {x})) if expression else []
        if not expression or others:
            said = f"has the symbol {', '.join(others)}" if others else f"is {self.s!r}"
            raise InputError(
                f"The expression of the law {self.name!r} {said}; it has to be a SymPy expression "
                "in cammotion.x alone: give, for example, 3*x**2 - 2*x**3."
            )

    @cached_property
    def v(self) -> sympy.Expr:
        """The dimensionless velocity V = dS/dx."""
        return sympy.diff(self.s, x)

    @cached_property
    def a(self) -> sympy.Expr:
        """The dimensionless acceleration A = dV/dx."""
        return sympy.diff(self.v, x)

    @cached_property
    def j(self) -> sympy.Expr:
        """The dimensionless jerk J = dA/dx."""
        return sympy.diff(self.a, x)

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Numbers:
        """Return S (or V, A, J for derivative 1, 2, 3) at `x`.

        `x` is dimensionless, 0 to 1, a number or an array of any shape; the result has its shape
        and no unit. Raises InputError for an `x` outside the motion or another derivative.

        >>> LAWS["cycloidal"]([0, 0.25, 0.5], derivative=1)
        array([0., 1., 2.])
        """
        if not (isinstance(derivative, int) and 0 <= derivative <= _JERK):
            raise InputError(
                f"The derivative is {derivative!r}; it has to be 0 for S, 1 for V, 2 for A "
                "or 3 for J."
            )
        values = self._functions[derivative](_TIME.array(x))
        return values if np.ndim(values) else float(values)

    @cached_property
    def Cv(self) -> float:  # noqa: N802 (the field's symbol)
        """The velocity factor: the largest abs(V)."""
        return self._peak(1)

    @cached_property
    def Ca(self) -> float:  # noqa: N802
        """The acceleration factor: the largest abs(A).

        >>> print(f"{LAWS['cycloidal'].Ca:.9f}")  # 2 pi
        6.283185307
        """
        return self._peak(2)

    @cached_property
    def Cj(self) -> float:  # noqa: N802
        """The jerk factor: the largest abs(J)."""
        return self._peak(3)

    @cached_property
    def branches(self) -> tuple[Branch, ...]:
        """The law cut at each joint and wherever S turns; that no turn is missed is proved."""
        return tuple(
            Branch(low, high, _value(zone, low), _value(zone, high), _compile(zone, "math"))
            for zone, start, end in _zones(self.s)
            for low, high in pairwise([start, *turning_points(zone, x, start, end), end])
        )

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

        >>> print(f"{LAWS['cycloidal'].inverse(19 / 50):.5f}")
        0.43927
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

        >>> LAWS["cycloidal"].where_above(0.5)
        [(0.5, 1.0)]
        """
        return _joined(self._parts(s, 1))

    def where_below(self, s: float) -> list[tuple[float, float]]:
        """Return the intervals of x in which S < s; else like `where_above`."""
        return _joined(self._parts(s, -1))

    def check_way(self) -> None:
        """Raise InputError unless the law goes from S(0) = 0 to S(1) = 1."""
        start, end = self.branches[0].s_low, self.branches[-1].s_high
        if max(abs(start), abs(end - 1)) > _ROUNDING:
            raise InputError(
                f"The law {self.name!r} goes from S(0) = {start:g} to S(1) = {end:g}; a move goes "
                "from 0 to 1: subtract S(0), and divide by S(1) - S(0)."
            )

    def __repr__(self) -> str:
        return f"MotionLaw({self.name!r})"

    @cached_property
    def _functions(self) -> tuple[Callable[[Floats], Floats], ...]:
        """S, V, A and J, compiled for arrays."""
        return tuple(_compile(curve, "numpy") for curve in (self.s, self.v, self.a, self.j))

    def _peak(self, derivative: int) -> float:
        """Return the largest magnitude: it lies at an end, at a joint, or where the curve turns."""
        curve = (self.s, self.v, self.a, self.j)[derivative]
        return max(
            abs(_value(zone, place))
            for zone, start, end in _zones(curve)
            for place in (start, *turning_points(zone, x, start, end), end)
        )

    def _first(self, s: float) -> float:
        branch = next((branch for branch in self.branches if s <= branch.s_high), self.branches[-1])
        if s <= branch.s_low:
            return branch.low
        return branch.high if s >= branch.s_high else branch.solve(s)

    def _parts(self, s: float, side: int) -> Iterator[tuple[float, float]]:
        """Yield where S is above s (side 1) or below (-1), branch by branch."""
        for branch in self.branches:
            low, high = side * (branch.s_low - s), side * (branch.s_high - s)
            if min(low, high) >= 0 < max(low, high):
                yield branch.low, branch.high
            elif high > 0:
                yield branch.solve(s), branch.high
            elif low > 0:
                yield branch.low, branch.solve(s)


def _joined(parts: Iterable[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return the intervals with those that touch made one."""
    found: list[tuple[float, float]] = []
    for low, high in parts:
        if found and found[-1][1] == low:
            low = found.pop()[0]
        found.append((low, high))
    return found


def _zones(curve: sympy.Expr) -> list[tuple[sympy.Expr, float, float]]:
    """Cut a curve over [0, 1] at its joints into smooth expressions, each with its interval."""
    if not curve.has(sympy.Piecewise):
        return [(curve, 0.0, 1.0)]
    pieces = sympy.piecewise_fold(curve).as_expr_set_pairs(sympy.Interval(0, 1))
    zones = [(piece, float(where.inf), float(where.sup)) for piece, where in pieces]
    return sorted((zone for zone in zones if zone[1] < zone[2]), key=lambda zone: zone[1])


def _value(curve: sympy.Expr, place: float) -> float:
    """Return the exact value, rounded once: at an end S is 0 or 1 and nothing beside it."""
    return float(curve.subs(x, sympy.Rational(place)))


def _compile(curve: sympy.Expr, library: str) -> Callable[[Any], Any]:
    if not curve.free_symbols:  # lambdify would return one number, whatever the shape
        return lambda places: np.full(np.shape(places), float(curve))
    function: Callable[[Any], Any] = sympy.lambdify(x, curve, library)
    return function


def _catalogue(*laws: MotionLaw) -> Mapping[str, MotionLaw]:
    return MappingProxyType({law.name: law for law in laws})


LAWS: Mapping[str, MotionLaw] = _catalogue(
    MotionLaw(
        "cycloidal",
        x - sympy.sin(2 * sympy.pi * x) / (2 * sympy.pi),
        also_called=("inclined sine", "Bestehorn"),
    ),
)
"""The catalogue: every known law under its name."""


def as_law(law: str | MotionLaw) -> MotionLaw:
    """Return the law of that name, or the law itself; an unknown name raises InputError.

    >>> as_law("cycloidal")
    MotionLaw('cycloidal')
    """
    return law if isinstance(law, MotionLaw) else LAWS[one_of("motion law", law, LAWS)]
