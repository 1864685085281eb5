"""The catalogue of motion laws, and the families from which further ones are made.

Names clash in this field. Each law lists the other names under which it is known; what is a
different law in spite of a like name is said where it is made.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import sympy

from cammotion.laws.motion_law import MotionLaw, mirrored
from cammotion.laws.reader import read_pieces
from cammotion.laws.scca_family import NAMED_PARTS, scca
from cammotion.laws.symbols import exact, x
from cammotion.quantities import InputError, Quantity, one_of, shorten

_half, _pi = sympy.Rational(1, 2), sympy.pi
_ROUNDING = 1e-9
_BOUNDARY_COUNTS = (3, 4)
_BOUNDARY = Quantity("boundary value", "", example=0, low=-1e9)


def polynomial(
    start: Sequence[float],
    end: Sequence[float],
    *,
    name: str = "",
    also_called: tuple[str, ...] = (),
) -> MotionLaw:
    """Return the polynomial law with given values at both ends, solved exactly.

    `start` and `end` hold s, v, a and, if wanted, j, all dimensionless, at x = 0 and x = 1. A law
    begins at s = 0 and ends at s = 1; its degree is the number of values less one. Raises
    InputError for other values, and for a curve that leaves [0, 1] on its way, as it easily does
    with a velocity at an end.

    >>> polynomial((0, 0, 0), (1, 0, 0)).s
    6*x**5 - 15*x**4 + 10*x**3
    """
    values = [_boundary(side, which) for which, side in (("start", start), ("end", end))]
    if values[0][0] != 0 or values[1][0] != 1:
        raise InputError(
            f"The polynomial goes from s = {float(values[0][0]):g} to {float(values[1][0]):g}; a "
            "motion law goes from 0 to 1: scale the values."
        )
    curve = _through(values[0], values[1], sympy.Integer(0), sympy.Integer(1))
    degree = len(values[0]) + len(values[1]) - 1
    law = MotionLaw(name or f"polynomial of degree {degree}", curve, also_called)
    worst = max(law.curve.extremes, key=lambda s: max(-s, s - 1))
    if max(-worst, worst - 1) > _ROUNDING:
        side = "dips below 0" if worst < 0 else "rises above 1"
        raise InputError(
            f"The polynomial {side}, to S = {worst:.4g}: choose end velocities nearer to 1, or "
            "join a straight line with fifth_degree_linear."
        )
    return law


def fifth_degree_linear(share: float, *, name: str = "") -> MotionLaw:
    """Return a straight line in the middle, joined at both ends by polynomials of degree five.

    `share` is the part of the time with constant velocity, from 0 on and below 1. The velocity is
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
    zones = [(_through(rest, moving, sympy.Integer(0), joint), 0.0, float(joint))]
    if part:
        zones.append((_half + velocity * (x - _half), float(joint), 0.5))
    title = name or f"fifth degree + linear, {float(part):.4g} constant velocity"
    return MotionLaw.of_curve(title, mirrored(read_pieces(zones)))


class Catalogue(Mapping[str, MotionLaw]):
    """Laws by their names, each made when it is first asked for."""

    def __init__(self, makers: Mapping[str, Callable[[], MotionLaw]]) -> None:
        self._makers = dict(makers)
        self._made: dict[str, MotionLaw] = {}

    def __getitem__(self, name: str) -> MotionLaw:
        if name not in self._made:
            self._made[name] = self._makers[name]()
        return self._made[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)


def _sines(first: Any, third: Any, fifth: Any = 0) -> sympy.Expr:
    """Return x less sines of one, three and five periods, with these amplitudes over 2 pi."""
    amplitudes = {1: first, 3: third, 5: fifth}
    return x - sum(a * sympy.sin(2 * n * _pi * x) for n, a in amplitudes.items()) / (2 * _pi)


def _ratio(over: int, under: int) -> sympy.Rational:
    return sympy.Rational(over, under)


def _sine_law(name: str, *amplitudes: Any, also_called: tuple[str, ...] = ()) -> MotionLaw:
    return MotionLaw(name, _sines(*amplitudes), also_called)


def _scca_law(name: str, *also_called: str) -> MotionLaw:
    return scca(*NAMED_PARTS[name], name=name, also_called=also_called)


def _mcv50() -> MotionLaw:
    half = LAWS["modified sine"].with_constant_velocity(0.5)
    return MotionLaw("MCV50", half.s, ("modified sine with 50 % constant velocity",))


_m = _ratio(1125, 1192)

LAWS: Mapping[str, MotionLaw] = Catalogue(
    {
        "constant acceleration": lambda: _scca_law("constant acceleration", "parabolic"),
        "simple harmonic": lambda: MotionLaw(
            "simple harmonic", (1 - sympy.cos(_pi * x)) / 2, ("cosine",)
        ),
        "cycloidal": lambda: _sine_law(
            "cycloidal", 1, 0, also_called=("inclined sine", "Bestehorn")
        ),
        "modified trapezoid": lambda: _scca_law("modified trapezoid", "modified trapezoidal"),
        "modified sine": lambda: _scca_law("modified sine", "modified sinusoidal"),
        "3-4-5 polynomial": lambda: polynomial(
            (0, 0, 0), (1, 0, 0), name="3-4-5 polynomial", also_called=("fifth degree",)
        ),
        "4-5-6-7 polynomial": lambda: polynomial(
            (0, 0, 0, 0), (1, 0, 0, 0), name="4-5-6-7 polynomial", also_called=("seventh degree",)
        ),
        "Gutman 1-3": lambda: _sine_law("Gutman 1-3", _ratio(15, 16), _ratio(1, 48)),
        "Freudenstein 1-3": lambda: _sine_law("Freudenstein 1-3", _ratio(27, 28), _ratio(1, 84)),
        "Freudenstein 1-3-5": lambda: _sine_law(
            "Freudenstein 1-3-5", _m, _m * _ratio(1, 54), _m * _ratio(1, 1250)
        ),
        "cubic": lambda: MotionLaw("cubic", 3 * x**2 - 2 * x**3, ("2-3 polynomial",)),
        "MCV50": _mcv50,
    }
)
"""The catalogue: every known law under its name."""


def as_law(law: Any) -> MotionLaw:
    """Return the law of that name, or the law itself; raise InputError for anything else.

    >>> as_law("cycloidal")
    MotionLaw('cycloidal')
    """
    return law if isinstance(law, MotionLaw) else LAWS[one_of("motion law", law, LAWS)]


def _boundary(given: Any, which: str) -> tuple[sympy.Rational, ...]:
    values = _BOUNDARY.array(given)
    if values.ndim != 1 or len(values) not in _BOUNDARY_COUNTS:
        raise InputError(
            f"The values at the {which} are {shorten(given)}: give s, v and a there, and j if you "
            "like, for example (0, 0, 0)."
        )
    return tuple(exact(float(value)) for value in values)


def _through(
    start: Sequence[sympy.Rational],
    end: Sequence[sympy.Rational],
    low: sympy.Rational,
    high: sympy.Rational,
) -> sympy.Expr:
    """Return the polynomial with these values and derivatives at two places.

    By Newton's divided differences; of places that are the same, the derivative over n!.
    """
    places = [low] * len(start) + [high] * len(end)
    given = {low: start, high: end}

    def difference(first: int, last: int) -> sympy.Rational:
        at, to, order = places[first], places[last], last - first
        if at == to:
            return given[at][order] / math.factorial(order)
        return (difference(first + 1, last) - difference(first, last - 1)) / (to - at)

    factors = [sympy.Integer(0)]  # by rising power
    for last, place in reversed([*enumerate(places)]):
        factors = [a - place * b for a, b in zip([0, *factors], [*factors, 0], strict=True)]
        factors[0] += difference(0, last)
    return sympy.Add(*(factor * x**power for power, factor in enumerate(factors)))
