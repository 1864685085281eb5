"""A motion law: one expression S(x); everything else is derived from it, nothing is typed.

With x = t/tm the time and S = h/hm the displacement, both made dimensionless, a law runs from
S(0) = 0 to S(1) = 1. The motion of a machine follows by scaling:

    h = hm S,   v = hm/tm V,   a = hm/tm^2 A,   j = hm/tm^3 J,

with V, A and J the first three derivatives of S. Their largest magnitudes are the peak factors
Cv, Ca and Cj.
"""

import math
from dataclasses import replace
from functools import cached_property

import numpy as np
import sympy
from numpy.typing import ArrayLike

from cammotion.alike import Alike
from cammotion.arguments import called
from cammotion.laws.curve import Curve, mirrored
from cammotion.laws.reader import cut, read, write
from cammotion.laws.series import Series
from cammotion.laws.symbols import exact, x
from cammotion.quantities import (
    Floats,
    InputError,
    Numbers,
    Quantity,
    WrongAnswerError,
    plain,
    shorten,
)

_TIME = Quantity("dimensionless time x = t/tm", "", example=0.5, high=1.0, low_included=True)
_ROUNDING = 1e-12  # of S
_WAY = replace(_TIME, name="dimensionless displacement S", rounding=_ROUNDING)
_HEIGHT = Quantity("displacement S", "", example=0.5, low=-math.inf)
_ORDER = Quantity("derivative (S, V, A, J)", "", example=2, high=3, low_included=True)
_SHARE = Quantity("share of constant velocity", "", example=0.5, high=0.999, low_included=True)
_MISSED = 1e-9  # by so much S may miss 0 and 1 at its ends, and what was solved for
JUMP = 1e-6  # what is smaller at a joint, as a share of the largest value, is rounding
_HALF = sympy.Rational(1, 2)


@called
class MotionLaw(Alike):
    """A motion law: its `name` and its one expression `s` in `cammotion.x`, 0 <= x <= 1.

    `also_called` lists its other names in the field; `curve` is S over x, to reckon with. (`s` may
    be given as a `Curve`; its expression is made when it is asked for.) A law cannot be changed.
    Raises InputError for a name that is no text, for what is no expression in x alone, and unless
    S, V, A and J are real and finite.

    >>> parabola_up = MotionLaw("square", x**2)
    >>> parabola_up.v
    2*x
    >>> parabola_up(0.5)
    0.25
    """

    name: str
    curve: Curve
    also_called: tuple[str, ...]
    made_of = ("name", "curve")

    def __init__(self, name: str, s: sympy.Expr | Curve, also_called: tuple[str, ...] = ()) -> None:
        if not isinstance(name, str):
            raise InputError(f"The name of a law is {shorten(name)}: give a text in quotes.")
        curve = s if isinstance(s, Curve) else Curve(read(*zone) for zone in cut(name, s))
        known = {"name": name, "curve": curve, "also_called": also_called}
        self.__dict__.update(known if s is curve else known | {"s": s})

    def __setattr__(self, name: str, _: object) -> None:
        raise AttributeError(f"A motion law cannot be changed: make another one with its {name}.")

    @cached_property
    def s(self) -> sympy.Expr:
        """The dimensionless displacement S, an expression in x."""
        return self._derived(0)

    @property
    def v(self) -> sympy.Expr:
        """The dimensionless velocity V = dS/dx, an expression in x."""
        return self._derived(1)

    @property
    def a(self) -> sympy.Expr:
        """The dimensionless acceleration A = dV/dx, an expression in x."""
        return self._derived(2)

    @property
    def j(self) -> sympy.Expr:
        """The dimensionless jerk J = dA/dx; the impulses of `jerk_impulses` are not in it."""
        return self._derived(3)

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Numbers:
        """Return S (or V, A, J for derivative 1, 2, 3) at `x`.

        `x` is dimensionless, 0 to 1, a number or an array of any shape; the result has its shape
        and no unit. Raises InputError for an `x` outside the motion or another derivative.

        >>> MotionLaw("cubic", 3 * x**2 - 2 * x**3)([0, 0.5, 1], derivative=1)
        array([0. , 1.5, 0. ])
        """
        places, rises = _TIME.rising(x)
        return plain(self.curve.derived(_ORDER.whole(derivative))(places, rises=rises))

    @property
    def Cv(self) -> float:  # noqa: N802 (the field's symbol)
        """The velocity factor: the largest abs(V); infinite where S jumps."""
        return self._peak(1)

    @property
    def Ca(self) -> float:  # noqa: N802
        """The acceleration factor: the largest abs(A); infinite where V jumps.

        >>> MotionLaw("cubic", 3 * x**2 - 2 * x**3).Ca
        6.0
        """
        return self._peak(2)

    @property
    def Cj(self) -> float:  # noqa: N802
        """The jerk factor: the largest abs(J); infinite where A jumps, also from or to a dwell."""
        return self._peak(3)

    @cached_property
    def Cq(self) -> float:  # noqa: N802
        """The torque factor of the inertia: the largest abs(V A) away from the jumps of V."""
        halves = self.curve.between(0.0, 0.5) + self.curve.between(0.5, 1.0)  # less cancels there
        return Curve(piece.torque() for piece in halves).largest

    @property
    def Cj_inside(self) -> float:  # noqa: N802
        """The largest abs(J) away from the jumps of A."""
        return self.curve.derived(3).largest

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
        ways = np.asarray(self(np.linspace(0, 1, 20_001)))
        return bool(np.allclose(ways, 1 - ways[::-1], rtol=0, atol=_ROUNDING))

    def reversed(self) -> "MotionLaw":
        """Return the law run backwards, 1 - S(1 - x): the return that mirrors a rise in time.

        >>> late = MotionLaw("square", x**2).reversed()
        >>> late.s, late(0.5)
        (1 - (1 - x)**2, 0.75)
        """
        curve = self.curve.placed(sympy.Integer(1), -1, sympy.Integer(1), -1)
        return MotionLaw(f"{self.name}, reversed", curve)

    def part(self, start: float, end: float) -> "MotionLaw":
        """Return the part of the law between two x, stretched to go from 0 to 1 in both.

        Of a rise-return law, the part up to the top is a rise, that from the top on a return.
        Raises InputError unless 0 <= start < end <= 1, and for two places with the same S.

        >>> MotionLaw("square", x**2).part(0.5, 1)(0.5)
        0.4166666666666667
        """
        low, high = _TIME.number(start), _TIME.number(end)
        s_low, way = self(low), self(high) - self(low)
        if min(high - low, abs(way)) <= _MISSED:
            raise InputError(
                f"From x = {low:g} to {high:g} the law {self.name!r} changes S by {way:g}: give "
                "two places in order, between which it moves."
            )
        part, span = Curve(self.curve.between(low, high)), high - low
        curve = part.placed(-low / span, 1 / span, -s_low / way, 1 / way)
        curve.pieces[0].low, curve.pieces[-1].high = 0.0, 1.0  # without the rounding
        return MotionLaw(f"{self.name}, {low:g} to {high:g}", curve)

    def with_constant_velocity(self, share: float) -> "MotionLaw":
        """Return the law with a share of constant velocity put into the middle of it.

        `share` is the part of the time, from 0 to 0.999. Raises InputError for another one, and for
        a law that is not symmetric, stands in its middle, or would go back there as far as on.

        >>> print(f"{MotionLaw('cubic', 3 * x**2 - 2 * x**3).with_constant_velocity(0.5).Cv:.3f}")
        1.200
        """
        part = exact(_SHARE.number(share))
        speed = self(0.5, 1)
        lacks = {
            "is not symmetric": not self.is_symmetric,
            "stands in its middle": abs(speed) < _MISSED,
            "would go back there as far as it goes on": abs(part * speed + 1 - part) < _MISSED,
        }
        if lack := next((words for words, is_so in lacks.items() if is_so), ""):
            raise InputError(
                f"The law {self.name!r} {lack}, so that no constant velocity can be put in there."
            )
        if not part:
            return self
        shorter = (1 - part) / self._middle_velocity
        velocity = 1 / (part + shorter)
        scale = velocity * shorter
        first = Curve(self.curve.between(0.0, 0.5)).placed(0, 1 - part, 0, scale)
        line = Series((float(_HALF - velocity * part / 2), float(velocity)), (), first.high, 0.5)
        line.expression = _HALF + velocity * (x - _HALF)
        title = f"{self.name}, {float(part):.4g} constant velocity"
        return MotionLaw(title, mirrored([*first.pieces, line]))

    @property
    def is_monotone(self) -> bool:
        """Whether S rises from the start to the end and never falls."""
        ways = [branch.at_high - branch.at_low for branch in self.curve.branches]
        return min([*ways, *(by for _, by in self.curve.steps)]) >= -_ROUNDING

    def inverse(self, s: ArrayLike) -> Numbers:
        """Return the first x at which the law has come to S = s.

        `s` is dimensionless, 0 to 1, a number or an array of any shape; the result has its shape.
        It is solved for until the last bit of x, and checked. Raises InputError for an `s` out of
        range, and for a law that turns on its way or does not go from 0 to 1.

        >>> print(f"{MotionLaw('cubic', 3 * x**2 - 2 * x**3).inverse(0.104):.5f}")
        0.20000
        """
        places = _WAY.array(s)
        self.check_way()
        if not self.is_monotone:
            raise InputError(
                f"The law {self.name!r} turns back on its way, and so passes some places more than "
                "once: use where_above, which returns every interval."
            )
        roots = np.clip(self._first(places.ravel()), 0.0, 1.0).reshape(places.shape)
        sides = [self.curve(roots, side) for side in ("left", "right")]  # apart at a joint only
        off = np.abs(places - np.clip(places, np.min(sides, 0), np.max(sides, 0))) > _MISSED
        if np.any(off):
            raise WrongAnswerError("law.inverse", f"{self.name!r} is not at S = {places[off]}")
        return plain(roots)

    def where_above(self, s: float) -> list[tuple[float, float]]:
        """Return the intervals of x in which S > s, in order; solved for, not sampled.

        >>> MotionLaw("cubic", 3 * x**2 - 2 * x**3).where_above(0.5)
        [(0.5, 1.0)]
        """
        return self.curve.where(_HEIGHT.number(s), 1, _ROUNDING)

    def where_below(self, s: float) -> list[tuple[float, float]]:
        """Return the intervals of x in which S < s, in order; solved for, not sampled."""
        return self.curve.where(_HEIGHT.number(s), -1, _ROUNDING)

    def check_way(self) -> None:
        """Raise InputError unless the law goes from S(0) = 0 to S(1) = 1 without a jump."""
        start, end = self.curve.ends
        if not max(abs(start), abs(end - 1)) <= _MISSED:  # nan is none
            back = "cut it at its top, as with part(0, 0.5) and part(0.5, 1)"
            fix = "subtract S(0), and divide by S(1) - S(0)" if abs(end - start) > _MISSED else back
            raise InputError(
                f"The law {self.name!r} goes from S(0) = {start:.10g} to S(1) = {end:.10g}; a move "
                f"goes from 0 to 1: {fix}."
            )
        if jumps := self._jumps(0):
            raise InputError(f"The law {self.name!r} jumps at x = {jumps[0][0]:g}: join its cases.")

    def __repr__(self) -> str:
        return f"MotionLaw({shorten(self.name)})"

    @property
    def _middle_velocity(self) -> sympy.Expr:
        middle = next(piece for piece in self.curve.pieces if piece.high >= _HALF)
        return sympy.diff(middle.expression, x).xreplace({x: _HALF}).doit()

    def _derived(self, order: int) -> sympy.Expr:
        return write((sympy.diff(p.expression, x, order), p.low, p.high) for p in self.curve.pieces)

    def _peak(self, derivative: int) -> float:
        """Return the largest magnitude of a curve, infinity where the one before it jumps."""
        jumps = any(self._jumps(lower) for lower in range(derivative))
        return math.inf if jumps else self.curve.derived(derivative).largest

    def _jumps(self, derivative: int) -> tuple[tuple[float, float], ...]:
        """Return where a curve jumps and by how much; outside of the move it stands still."""
        curve = self.curve.derived(derivative)
        after = 0.0 if derivative or abs(curve.ends[1]) <= JUMP else 1.0  # it comes back, or stays
        steps = ((0.0, curve.ends[0]), *curve.steps, (1.0, after - curve.ends[1]))
        return tuple((at, by) for at, by in steps if abs(by) > JUMP * curve.largest)

    def _first(self, heights: Floats) -> Floats:
        found, left = np.full(heights.shape, 1.0), np.full(heights.shape, True)
        for branch in self.curve.branches:
            here = left & (heights <= branch.at_high)
            found[here], left = branch.reach(heights[here]), left & ~here
        return found
