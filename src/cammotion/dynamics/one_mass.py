"""One mass on a spring, driven by a motion law: its exact response, during the move and after it.

The cam moves one end of the spring by the law, from rest to rest; the mass is at the other end.
With S the displacement of the cam, Z the deflection of the spring and S + Z the position of the
mass, all as parts of the stroke, over x = t/tm,

    Z'' + 2 D w Z' + w^2 Z = -A,    w = 2 pi tau,

where D is the damping ratio and tau = tm/Tn the period ratio: how often the mass, left alone and
undamped, swings during the move. (w is the natural angular frequency times tm.)

In a zone of the law, where A is a polynomial and waves, there is a motion of the same form that
obeys the equation: the forced one. Two forced motions do not meet at a joint. What is between them
sets off a free swing there, which makes position and velocity go on without a jump. The response
is the forced motion of the zone less the free swings of all joints that have passed. Its numbers
are those of `MoveResponse`, which needs no formula and has none that is 0/0 in resonance.
"""

from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import sympy
from numpy.typing import ArrayLike
from sympy.simplify.fu import TR8

from cammotion.alike import Alike
from cammotion.dynamics.chain import UNDERDAMPED, tuned_mass
from cammotion.dynamics.forcing import check_velocity
from cammotion.dynamics.response import MoveResponse
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.piece import Piece, Placed
from cammotion.laws.reader import Zone, cut
from cammotion.laws.series import Series
from cammotion.laws.spline import Spline
from cammotion.laws.symbols import exact, x
from cammotion.machine.kinematics import MM_PER_M, Move
from cammotion.quantities import InputError, Numbers, Quantity

_TIME = Quantity("dimensionless time x = t/tm", "", example=1.5, low=-1e6, high=1e6)
_ORDER = Quantity(
    "derivative (position, velocity, acceleration)", "", example=2, high=2, low_included=True
)
SWINGS = Quantity(
    "period ratio (swings during the move)",
    "",
    example=4,
    low=1e-6,
    high=1000,
    low_included=True,
)
_SAME, _PROBES = 1e-12, (0.3123, 0.7411)  # zones that differ by less there are one
_ROUNDS = 8  # each halves how many waves are multiplied
_ACCELERATION = 2  # the highest derivative a response is asked for
tau, zeta = sympy.symbols("tau zeta", positive=True)


class OneMass(Alike):
    """A mass on a spring that a `law` drives from rest to rest once, and then leaves alone.

    `law` is a name or a law, `swings` the period ratio tau = tm/Tn: how often the mass, alone and
    undamped, swings during the move (its natural frequency in Hz times the indexing time in s),
    1e-6 to 1000. `damping_ratio` is dimensionless, from 0 (none) to 0.99. Each may be a symbol
    instead; then there are expressions and no numbers. Cam and mass rest before the move.
    Raises InputError for other numbers, for an unknown law, for one that does not go from 0 to 1,
    for one whose velocity jumps, and for one that is not made of polynomials and waves; and, asked
    for `z` or `a`, where nothing damps a mass that swings as a wave of its law.

    >>> soft = OneMass("cycloidal", swings=1.25)
    >>> print(f"{soft.peak:.3f}, {soft.amplification:.2f} times the cam's")
    19.011, 3.03 times the cam's
    """

    made_of = ("law", "_of")

    def __init__(self, law: str | MotionLaw, swings: Any, damping_ratio: Any = 0.02) -> None:
        self.law = as_law(law)
        given = {tau: (SWINGS, swings), zeta: (UNDERDAMPED, damping_ratio)}
        self._of = {
            s: v if getattr(v, "free_symbols", None) else q.number(v) for s, (q, v) in given.items()
        }
        check_velocity(self.law)
        if not all(map(_is_of_waves, self.law.curve.pieces)):
            _zones(self.law)  # refuses a law that has none

    @property
    def z(self) -> sympy.Expr:
        """The deflection of the spring as a part of the stroke, an expression in x for any x.

        >>> n = sympy.Symbol("n", positive=True)
        >>> OneMass("constant acceleration", n, 0).z.subs({x: 0.125, n: 4}).evalf(3)
        -0.0127
        """
        return self._written(0)

    @property
    def a(self) -> sympy.Expr:
        """The acceleration of the mass, A + Z'', an expression in x for any x; hm/tm^2 makes m/s^2.

        >>> n = sympy.Symbol("n", positive=True)
        >>> OneMass("constant acceleration", n, 0).a.subs({x: 0.125, n: 4}).evalf(3)
        8.00
        """
        return self._written(_ACCELERATION)

    def __call__(self, x: ArrayLike, derivative: int = 0) -> Numbers:
        """Return the position of the mass (or its velocity, acceleration for 1, 2) at `x`.

        `x` = t/tm is dimensionless, 0 when the move begins and 1 when it ends, a number or an array
        of any shape; the result has its shape. It is a part of the stroke hm, of hm/tm or of
        hm/tm^2. Raises InputError for another derivative, and where a number is a symbol.

        >>> print(f"{OneMass('cycloidal', swings=4)(0.5):.4f}")
        0.4998
        """
        times, order = _TIME.array(x), _ORDER.whole(derivative)
        if order == 0:
            return self._response.position_mm(times) / MM_PER_M
        return (self._response.velocity, self._response.acceleration)[order - 1](times)

    @cached_property
    def peak(self) -> float:
        """The largest magnitude of the mass's acceleration, during the move and after it.

        It is a factor like Ca: times hm/tm^2 it is in m/s^2. Raises InputError where a number is a
        symbol.

        >>> print(f"{OneMass('constant acceleration', swings=5, damping_ratio=0).peak:.3f}")
        16.000
        """
        end = 1 + 1 / self._number(tau)  # after the move each swing is less than the one before
        return self._response.peak_acceleration(over=(0, end)).value

    @property
    def amplification(self) -> float:
        """How many times the cam's peak acceleration the mass's peak is.

        >>> print(f"{OneMass('cycloidal', swings=200, damping_ratio=0.1).amplification:.3f}")
        1.000
        """
        return self.peak / self.law.Ca

    def __repr__(self) -> str:
        numbers = f"swings={self._of[tau]}, damping_ratio={self._of[zeta]}"
        return f"OneMass({self.law.name!r}, {numbers})"

    @cached_property
    def _response(self) -> MoveResponse:
        """What it does over a move of 1 m in 1 s, in which the factors are m, m/s and m/s2."""
        swings, damping = self._number(tau), self._number(zeta)
        move = Move(stroke_mm=MM_PER_M, angle_deg=360, rate_per_hour=3600, law=self.law)
        return MoveResponse(tuned_mass(swings, damping), move)

    def _number(self, symbol: sympy.Symbol) -> float:
        value = self._of[symbol]
        if not isinstance(value, float):
            raise InputError(
                f"{self!r} has symbols and no numbers: ask for its expressions z and a, or give "
                "numbers for swings and damping."
            )
        return value

    def _written(self, derivative: int) -> sympy.Expr:
        values = {s: v if isinstance(v, sympy.Expr) else exact(v) for s, v in self._of.items()}
        written = _response(self.law, derivative).xreplace(values)
        if written.has(sympy.nan, sympy.zoo):
            raise InputError(
                f"{self!r} swings just as a wave of its law, and undamped, where its formula is "
                "0/0: call it for numbers, which have a limit there, or "
                "give some damping, or other swings."
            )
        return written


class _Forced(NamedTuple):
    """A zone of the law: its acceleration, the forced motion in it, and where it ends."""

    acceleration: sympy.Expr
    motion: sympy.Expr
    end: sympy.Expr


_w = 2 * sympy.pi * tau
_STILL = _Forced(sympy.Integer(0), sympy.Integer(0), sympy.Integer(0))


@lru_cache(maxsize=64)
def _response(law: MotionLaw, derivative: int) -> sympy.Expr:
    """Return Z, Z' or the acceleration of the mass, in x, tau and zeta."""
    zones = [_STILL, *_zones(law), _STILL]
    pieces, swings = [], []
    for before, after in pairwise(zones):
        between = after.motion - before.motion
        start, rate = (between.diff(x, order).subs(x, before.end) for order in range(2))
        for _ in range(derivative):  # the derivative of a free swing is one too
            start, rate = rate, -(_w**2) * start - 2 * zeta * _w * rate
        swing = _swing(x - before.end, start, rate)
        swings.append(sympy.Piecewise((swing, x > before.end), (0, True)))
    for zone in zones[:-1]:
        given = zone.acceleration if derivative == _ACCELERATION else 0
        pieces.append((zone.motion.diff(x, derivative) + given, x <= zone.end))
    return sympy.Piecewise(*pieces, (0, True), evaluate=False) - sympy.Add(*swings)


def _is_of_waves(piece: Piece) -> bool:
    """Whether a piece is known to be of polynomials and waves; to write that out takes seconds."""
    while isinstance(piece, Placed):
        piece = piece.inner
    return isinstance(piece, Series | Spline)


@lru_cache(maxsize=64)
def _zones(law: MotionLaw) -> tuple[_Forced, ...]:
    merged: list[Zone] = []
    for zone in cut(law.name, law.a):
        is_same = merged and all(
            abs(float((zone.expression - merged[-1].expression).subs(x, at))) < _SAME
            for at in _PROBES
        )
        merged.append(zone if not is_same else Zone(merged.pop().expression, zone.low, zone.high))
    return tuple(_Forced(a, _forced(law, a), exact(high)) for a, _, high in merged)


def _forced(law: MotionLaw, acceleration: sympy.Expr) -> sympy.Expr:
    """Return the motion of the form of A that obeys the equation: Z'' + 2 D w Z' + w^2 Z = -A."""
    forced = power = sympy.Integer(0)
    for term in sympy.Add.make_args(_as_sum(acceleration)):
        if term.is_polynomial(x):
            power += term
            continue
        square = sympy.simplify(-term.diff(x, 2) / term)  # of its frequency
        if square.has(x):
            raise InputError(
                f"The acceleration of the law {law.name!r} has the term {term}, which is no power "
                "and no wave: give a law of polynomials, sines and cosines."
            )
        gap, drag = _w**2 - square, 2 * zeta * _w
        forced -= (gap * term - drag * term.diff(x)) / (gap**2 + drag**2 * square)
    factor, before = 1 / _w**2, sympy.Integer(0)
    while power != 0:
        forced -= factor * power
        factor, before = -(2 * zeta * _w * factor + before) / _w**2, factor
        power = power.diff(x)
    return forced


def _as_sum(expression: sympy.Expr) -> sympy.Expr:
    """Return it as a sum, in which products of waves are sums of waves, and theirs again."""
    for _ in range(_ROUNDS):
        before, expression = expression, sympy.expand(TR8(expression))
        if expression == before:
            break
    return expression


def _swing(since: sympy.Expr, start: sympy.Expr, rate: sympy.Expr) -> sympy.Expr:
    """Return a free swing from its value and its rate of change at its start."""
    damped = _w * sympy.sqrt(1 - zeta**2)
    sine = (rate + zeta * _w * start) / damped * sympy.sin(damped * since)
    return sympy.exp(-zeta * _w * since) * (start * sympy.cos(damped * since) + sine)
