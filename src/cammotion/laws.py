"""Motion laws: one expression S(x) each; everything else is derived from it, nothing is typed.

With x = t/tm the time and S = h/hm the displacement, both made dimensionless, a law runs from
S(0) = 0 to S(1) = 1. The motion of a machine follows by scaling:

    h = hm S,   v = hm/tm V,   a = hm/tm^2 A,   j = hm/tm^3 J,

with V, A and J the first three derivatives of S. Their largest magnitudes are the peak factors
Cv, Ca and Cj.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np
import sympy
from numpy.typing import ArrayLike

from cammotion.checks import Floats, InputError, Numbers, Quantity, one_of

x = sympy.Symbol("x")
"""The dimensionless time t/tm, the variable of every law."""

_TIME = Quantity("dimensionless time x = t/tm", "", example=0.5, high=1.0, low_included=True)

_JERK = 3  # the highest derivative a law is asked for

# Fine enough to part the extremes of every law of the catalogue; each is then solved for exactly.
_BRACKETS = 720


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

    def __repr__(self) -> str:
        return f"MotionLaw({self.name!r})"

    @cached_property
    def _functions(self) -> tuple[Callable[[Floats], Floats], ...]:
        """S, V, A, J and the slope of J, compiled for arrays."""
        expressions = (self.s, self.v, self.a, self.j, sympy.diff(self.j, x))
        return tuple(_compile(expression) for expression in expressions)

    def _peak(self, derivative: int) -> float:
        """Solve for the largest magnitude: it lies at an end or where the slope is zero."""
        curve, slope = self._functions[derivative], self._functions[derivative + 1]
        places = np.concatenate([[0.0, 1.0], _roots(slope)])
        return float(np.abs(curve(places)).max())


def _compile(expression: sympy.Expr) -> Callable[[Floats], Floats]:
    if not expression.free_symbols:  # lambdify would return one number, whatever the shape
        return lambda places: np.full(np.shape(places), float(expression))
    function: Callable[[Floats], Floats] = sympy.lambdify(x, expression, "numpy")
    return function


def _roots(function: Callable[[Floats], Floats]) -> Floats:
    """Solve function(x) = 0 in [0, 1] wherever it changes its sign, by bisection."""
    grid = np.linspace(0.0, 1.0, _BRACKETS + 1)
    values = function(grid)
    changes = np.flatnonzero(np.signbit(values[:-1]) != np.signbit(values[1:]))
    low, high, sign = grid[changes], grid[changes + 1], np.signbit(values[changes])
    for _ in range(60):  # 60 halvings leave less than one unit in the last place
        middle = (low + high) / 2
        before = np.signbit(function(middle)) == sign
        low, high = np.where(before, middle, low), np.where(before, high, middle)
    return low


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
