"""Curves over [0, 1] in zones: a motion law may be put together from several expressions."""

import math
from collections.abc import Callable, Iterable
from fractions import Fraction
from itertools import pairwise, zip_longest
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import sympy

from cammotion.laws.series import Series
from cammotion.laws.series_reader import series_of
from cammotion.quantities import Floats

x = sympy.Symbol("x")
"""The dimensionless time t/tm, the variable of every law."""

_DIGITS = 20  # of constants that are computed before the curve is: more than a float has
_MANY = 16  # zones, from which on a table of them is quicker than one after the other


Curve: TypeAlias = Any
"""A smooth curve in `x`: a SymPy expression, which comes without types, or a Series."""


class Zone(NamedTuple):
    """A smooth curve in `x`, an expression or a series, and the interval in which it holds."""

    curve: Curve
    low: float
    high: float

    def value(self, place: float) -> float:
        """Return the exact value at a place, rounded once: S(1) is 1 and nothing beside it."""
        if isinstance(self.curve, Series):
            return self.curve.value(place)
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
    merged: list[Zone] = []
    for zone in zones:
        if merged and merged[-1].curve == zone.curve:
            merged[-1] = merged[-1]._replace(high=zone.high)
        else:
            merged.append(zone)
    *first, last = merged
    if not first:
        return last.curve
    ends = ((zone.curve, x <= exact(zone.high)) for zone in first)
    return sympy.Piecewise(*ends, (last.curve, True), evaluate=False)


def exact(number: float) -> sympy.Rational:
    """Return the simple fraction that a float stands for: 1/3 for 0.333..."""
    fraction = Fraction(number).limit_denominator(10**6)
    is_near = math.isclose(fraction, number, rel_tol=1e-14, abs_tol=1e-15)
    return sympy.Rational(fraction if is_near else Fraction(number))


def as_series(zones: Iterable[Zone]) -> tuple[Zone, ...]:
    """Return the zones with a series for each expression that is one."""
    return tuple(
        zone._replace(curve=series_of(zone.curve, zone.low, zone.high) or zone.curve)
        for zone in zones
    )


def derive(zones: Iterable[Zone]) -> tuple[Zone, ...]:
    """Return the derivative, zone by zone."""
    return tuple(zone._replace(curve=_derivative(zone.curve)) for zone in zones)


def multiply(one: Curve, other: Curve) -> Series | None:
    """Return the product of two series of one zone; None if it is no series, or they are none."""
    both = isinstance(one, Series) and isinstance(other, Series)
    return one.times(other) if both else None


def _derivative(curve: Curve) -> Curve:
    return curve.derive() if isinstance(curve, Series) else sympy.diff(curve, x)


def compile_curve(curve: Curve, library: str) -> Callable[[Any], Any]:
    """Compile a smooth curve for the "numpy" or the "math" of `library`."""
    if isinstance(curve, Series):
        return curve.over if library == "numpy" else curve.at
    if not curve.free_symbols:  # lambdify would return one number, whatever the shape
        constant = float(curve)
        return lambda places: np.full(np.shape(places), constant)
    from sympy.codegen.rewriting import create_expand_pow_optimization, optimize  # rarely needed

    products = create_expand_pow_optimization(8)  # x*x*x: a power costs ten times a product
    form = optimize(curve.evalf(_DIGITS), [products])
    function: Callable[[Any], Any] = sympy.lambdify(x, form, library)
    return function


def compile_zones(zones: Iterable[Zone]) -> Callable[[Floats], Floats]:
    """Compile zones for arrays; each is evaluated at its own places only."""
    zones = tuple(zones)
    if len(zones) == 1:
        return compile_curve(zones[0].curve, "numpy")
    joints = np.array([zone.high for zone in zones[:-1]])
    polynomials = [
        zone.curve for zone in zones if isinstance(zone.curve, Series) and not zone.curve.waves
    ]
    if _MANY < len(zones) == len(polynomials):
        return _compile_table(joints, polynomials)
    fillers = [_filler(zone.curve) for zone in zones]

    def evaluate(places: Floats) -> Floats:
        flat = np.ravel(places)
        values = np.empty_like(flat)
        if flat.size and np.all(flat[1:] >= flat[:-1]):  # in order, as in every plot
            ends = [0, *np.searchsorted(flat, joints, side="right"), flat.size]
            for fill, (start, end) in zip(fillers, pairwise(ends), strict=True):
                fill(flat[start:end], values[start:end])
        else:
            which = np.searchsorted(joints, flat, side="left")
            for number, fill in enumerate(fillers):
                here = np.flatnonzero(which == number)
                part = np.empty(len(here))
                fill(flat[here], part)
                values[here] = part
        return values.reshape(np.shape(places))

    return evaluate


def _filler(curve: Curve) -> Callable[[Floats, Floats], object]:
    """Return the function that fills an array with the values at places."""
    if isinstance(curve, Series):
        return curve.over
    function = compile_curve(curve, "numpy")
    return lambda places, out: np.copyto(out, function(places))


def _compile_table(joints: Floats, polynomials: list[Series]) -> Callable[[Floats], Floats]:
    """Compile many polynomials, each about its origin, as one table of their coefficients."""
    origins = np.array([polynomial.origin for polynomial in polynomials])
    rows = zip_longest(*(polynomial.factors[::-1] for polynomial in polynomials), fillvalue=0.0)
    first, *table = [np.array(row) for row in rows][::-1]

    def evaluate(places: Floats) -> Floats:
        which = np.searchsorted(joints, places, side="left")
        u = places - origins[which]
        values = first[which]
        for factors in table:
            values = values * u + factors[which]
        return values

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
