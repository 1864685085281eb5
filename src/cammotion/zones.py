"""Curves over [0, 1] in zones: a motion law may be put together from several expressions."""

from collections.abc import Callable, Iterable
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import sympy
from sympy.codegen.rewriting import create_expand_pow_optimization, optimize

from cammotion.checks import Floats

x = sympy.Symbol("x")
"""The dimensionless time t/tm, the variable of every law."""

_DIGITS = 20  # of constants that are computed before the curve is: more than a float has
_LARGEST = 1e5  # a larger coefficient costs more digits than Horner's rule is worth
_PRODUCTS = create_expand_pow_optimization(8)  # x*x*x: a power costs ten times a product


class Zone(NamedTuple):
    """A smooth expression in `x` and the interval in which it holds."""

    curve: sympy.Expr
    low: float
    high: float

    def value(self, place: float) -> float:
        """Return the exact value at a place, rounded once: S(1) is 1 and nothing beside it."""
        return float(self.curve.subs(x, sympy.Rational(place)))


def cut(curve: sympy.Expr) -> tuple[Zone, ...]:
    """Cut a curve at its joints.

    >>> [(zone.low, zone.high) for zone in cut(sympy.Piecewise((x, x <= 0.25), (x**2, True)))]
    [(0.0, 0.25), (0.25, 1.0)]
    """
    if not curve.has(sympy.Piecewise):
        return (Zone(curve, 0.0, 1.0),)
    plain = _in_order(curve)
    if plain:
        return plain
    pieces = sympy.piecewise_fold(curve).as_expr_set_pairs(sympy.Interval(0, 1))
    zones = (Zone(piece, float(where.inf), float(where.sup)) for piece, where in pieces)
    return tuple(sorted((z for z in zones if z.low < z.high), key=lambda zone: zone.low))


def join(zones: Iterable[Zone]) -> sympy.Expr:
    """Return the zones as one expression, each up to and with its end."""
    *first, last = zones
    if not first:
        return last.curve
    ends = ((zone.curve, x <= sympy.nsimplify(zone.high, rational=True)) for zone in first)
    return sympy.Piecewise(*ends, (last.curve, True))


def derive(zones: Iterable[Zone]) -> tuple[Zone, ...]:
    """Return the derivative, zone by zone."""
    return tuple(zone._replace(curve=sympy.diff(zone.curve, x)) for zone in zones)


def compile_curve(curve: sympy.Expr, library: str) -> Callable[[Any], Any]:
    """Compile a smooth expression: constants computed beforehand, polynomials by Horner's rule."""
    if not curve.free_symbols:  # lambdify would return one number, whatever the shape
        constant = float(curve)
        return lambda places: np.full(np.shape(places), constant)
    form = optimize(_by_horner(curve).evalf(_DIGITS), [_PRODUCTS])
    function: Callable[[Any], Any] = sympy.lambdify(x, form, library)
    return function


def _by_horner(curve: sympy.Expr) -> sympy.Expr:
    """Return a polynomial by Horner's rule, unless its coefficients would cancel each other."""
    if not curve.is_polynomial(x):
        return curve
    polynomial = sympy.Poly(curve, x)
    is_tame = max(abs(float(factor)) for factor in polynomial.all_coeffs()) < _LARGEST
    return sympy.horner(polynomial) if is_tame else curve


def compile_zones(zones: Iterable[Zone]) -> Callable[[Floats], Floats]:
    """Compile zones for arrays; each is evaluated at its own places only."""
    zones = tuple(zones)
    functions = [compile_curve(zone.curve, "numpy") for zone in zones]
    if len(functions) == 1:
        return functions[0]
    joints = [zone.high for zone in zones[:-1]]

    def evaluate(places: Floats) -> Floats:
        flat = np.ravel(places)
        values = np.empty_like(flat)
        if flat.size and np.all(flat[1:] >= flat[:-1]):  # in order, as in every plot
            ends = [0, *np.searchsorted(flat, joints, side="right"), flat.size]
            for function, (start, end) in zip(functions, pairwise(ends), strict=True):
                values[start:end] = function(flat[start:end])
        else:
            which = np.searchsorted(joints, flat, side="left")
            for number, function in enumerate(functions):
                here = np.flatnonzero(which == number)
                values[here] = function(flat[here])
        return values.reshape(np.shape(places))

    return evaluate


def _in_order(curve: sympy.Expr) -> tuple[Zone, ...]:
    """Cut a curve that is written as x <= a, x <= b, ..., else; return () for any other."""
    zones: list[Zone] = []
    for piece, condition in curve.args if isinstance(curve, sympy.Piecewise) else ():
        low = zones[-1].high if zones else 0.0
        if condition == sympy.true:
            high = 1.0
        elif isinstance(condition, sympy.Le | sympy.Lt) and condition.lhs == x:
            high = float(condition.rhs) if condition.rhs.is_number else -1.0
        else:
            high = -1.0
        if not low < high <= 1 or piece.has(sympy.Piecewise):
            return ()
        zones.append(Zone(piece, low, high))
    return tuple(zones) if zones and zones[-1].high == 1 else ()
