"""The catalogue of motion laws, and the families from which further ones are made.

Names clash in this field. Each law lists the other names under which it is known; what is a
different law in spite of a like name is said where it is made.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import sympy

from cammotion.arguments import checked
from cammotion.laws.curve import mirrored
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.reader import read
from cammotion.laws.scca_family import scca
from cammotion.laws.symbols import exact, x
from cammotion.quantities import InputError, Quantity, one_of, shorten

_half, _pi, _ROUNDING = sympy.Rational(1, 2), sympy.pi, 1e-9
_BOUNDARY = Quantity("boundary value", "", example=0, low=-1e9, high=1e9, low_included=True)


@checked
def polynomial(
    start: Sequence[float],
    end: Sequence[float],
    *,
    name: str = "",
    also_called: tuple[str, ...] = (),
    may_leave: bool = False,
) -> MotionLaw:
    """Return the polynomial law with given values at both ends, solved exactly.

    `start` and `end` hold s, v, a and, if wanted, j, all dimensionless, at x = 0 and x = 1. A law
    begins at s = 0 and ends at s = 1; its degree is the number of values less one. Raises
    InputError for other values, and for a curve that leaves [0, 1], unless it `may_leave` it.

    >>> polynomial((0, 0, 0), (1, 0, 0)).s
    6*x**5 - 15*x**4 + 10*x**3
    """
    values = [_boundary(side, which) for which, side in (("start", start), ("end", end))]
    if values[0][0] != 0 or values[1][0] != 1:
        raise InputError(
            f"The polynomial goes from s = {float(values[0][0]):.12g} to "
            f"{float(values[1][0]):.12g}; a motion law goes from 0 to 1: scale the values."
        )
    curve = _through(values[0], values[1], sympy.Integer(1))
    title = name or f"polynomial of degree {len(values[0]) + len(values[1]) - 1}"
    law = MotionLaw(title, curve, also_called)
    worst = max(law.curve.extremes, key=lambda s: abs(s - 0.5))
    if abs(worst - 0.5) > 0.5 + _ROUNDING and not may_leave:
        side = "dips below 0" if worst < 0 else "rises above 1"
        bent = any((*values[0][2:], *values[1][2:]))
        rest = ", accelerations and jerks nearer to 0" if bent else ""
        raise InputError(
            f"The polynomial {side}, to S = {worst:.4g}: choose end velocities nearer to 1{rest}, "
            "or join a straight line with fifth_degree_linear."
        )
    return law


@checked
def fifth_degree_linear(share: float, *, name: str = "") -> MotionLaw:
    """Return a straight line in the middle, joined at both ends by polynomials of degree five.

    `share` is the part of the time with constant velocity, from 0 to 0.99. The velocity is
    2/(1 + share), so that over each end the mean velocity is half of it; velocity and acceleration
    are continuous. Raises InputError for another share.

    >>> print(f"{fifth_degree_linear(0.5).Cv:.4f}")
    1.3333
    """
    limits = Quantity("share of the straight line", "", example=0.5, high=0.99, low_included=True)
    part = exact(limits.number(share))
    velocity, joint = 2 / (1 + part), (1 - part) / 2
    height = _half - velocity * part / 2
    rest, moving = (sympy.Integer(0),) * 3, (height, velocity, sympy.Integer(0))
    zones = [(_through(rest, moving, joint), 0.0, float(joint))]
    if part:
        zones.append((_half + velocity * (x - _half), float(joint), 0.5))
    title = name or f"fifth degree + linear, {float(part):.4g} constant velocity"
    return MotionLaw(title, mirrored([read(*zone) for zone in zones]))


def _sines(*amplitudes: float | sympy.Rational) -> sympy.Expr:
    """Return x less sines of one, three and five periods, with these amplitudes over 2 pi."""
    waves = (a * sympy.sin(2 * n * _pi * x) for n, a in zip((1, 3, 5), amplitudes, strict=False))
    return x - sum(waves) / (2 * _pi)


_ratio, _m = sympy.Rational, sympy.Rational(1125, 1192)

_KNOWN: dict[str, tuple[Callable[[], Any], tuple[str, ...]]] = {
    "constant acceleration": (lambda: scca(0, 1, 0).curve, ("parabolic",)),
    "simple harmonic": (lambda: (1 - sympy.cos(_pi * x)) / 2, ("cosine",)),
    "cycloidal": (lambda: _sines(1), ("inclined sine", "Bestehorn")),
    "modified trapezoid": (lambda: scca(0.25, 0.5, 0.25).curve, ("modified trapezoidal",)),
    "modified sine": (lambda: scca(0.25, 0, 0.75).curve, ("modified sinusoidal",)),
    "3-4-5 polynomial": (lambda: polynomial((0, 0, 0), (1, 0, 0)).s, ("fifth degree",)),
    "4-5-6-7 polynomial": (lambda: polynomial((0,) * 4, (1, 0, 0, 0)).s, ("seventh degree",)),
    "Gutman 1-3": (lambda: _sines(_ratio(15, 16), _ratio(1, 48)), ()),
    "Freudenstein 1-3": (lambda: _sines(_ratio(27, 28), _ratio(1, 84)), ()),
    "Freudenstein 1-3-5": (lambda: _sines(_m, _m / 54, _m / 1250), ()),
    "cubic": (lambda: 3 * x**2 - 2 * x**3, ("2-3 polynomial",)),
    "MCV50": (
        lambda: LAWS["modified sine"].with_constant_velocity(0.5).curve,
        ("modified sine with 50 % constant velocity",),
    ),
}
"""For each name what makes S, an expression or a curve, and the other names of the law."""

_OTHERS = {other: name for name, (_, others) in _KNOWN.items() for other in others}


class Catalogue(Mapping[str, MotionLaw]):
    """Laws by their names, in any case, or by others; each made when it is first asked for."""

    def __init__(self) -> None:
        self._made: dict[str, MotionLaw] = {}

    def __getitem__(self, name: str) -> MotionLaw:
        name = one_of("motion law", name, _KNOWN, _OTHERS)
        if name not in self._made:
            make, others = _KNOWN[name]
            self._made[name] = MotionLaw(name, make(), others)
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(_KNOWN)

    def __len__(self) -> int:
        return len(_KNOWN)


LAWS: Mapping[str, MotionLaw] = Catalogue()
"""The catalogue: every known law under its name."""

CONSTANT_VELOCITY = MotionLaw("constant velocity", x)
"""The law of a move that goes on at one speed, for between two moves that join it."""


def as_law(law: Any) -> MotionLaw:
    """Return the law of that name, or the law itself; raise InputError for anything else.

    >>> as_law("cycloidal")
    MotionLaw('cycloidal')
    """
    if isinstance(law, MotionLaw):
        return law
    if isinstance(law, sympy.Expr):
        raise InputError(f"The law is an expression, {shorten(law)}: give MotionLaw('mine', ...).")
    name = one_of("motion law", law, [*_KNOWN, CONSTANT_VELOCITY.name], _OTHERS)
    return CONSTANT_VELOCITY if name == CONSTANT_VELOCITY.name else LAWS[name]


def _boundary(given: Any, which: str) -> tuple[sympy.Rational, ...]:
    values = _BOUNDARY.array(given)
    if values.ndim != 1 or len(values) not in (3, 4):
        raise InputError(
            f"The values at the {which} are {shorten(given)}: give s, v and a there, and j if you "
            "like, for example (0, 0, 0)."
        )
    return tuple(exact(float(value)) for value in values)


def _through(
    start: Sequence[sympy.Rational], end: Sequence[sympy.Rational], high: sympy.Rational
) -> sympy.Expr:
    """Return the polynomial with these values and derivatives at 0 and at another place.

    By Newton's divided differences; of places that are the same, the derivative over n!.
    """
    low = sympy.Integer(0)
    places, given = [low] * len(start) + [high] * len(end), {low: start, high: end}

    def difference(first: int, last: int) -> sympy.Rational:
        at, to, order = places[first], places[last], last - first
        if at == to:
            return given[at][order] / math.factorial(order)
        return (difference(first + 1, last) - difference(first, last - 1)) / (to - at)

    factors = [low]  # by rising power
    for last, place in reversed([*enumerate(places)]):
        factors = [a - place * b for a, b in zip([low, *factors], [*factors, low], strict=True)]
        factors[0] += difference(0, last)
    return sympy.Add(*(factor * x**power for power, factor in enumerate(factors)))
