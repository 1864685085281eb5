"""The variable of every law, and numbers as SymPy keeps them."""

import math
from fractions import Fraction

import sympy

x = sympy.Symbol("x")
"""The dimensionless time t/tm, the variable of every law."""


def exact(number: float) -> sympy.Rational:
    """Return the simple fraction that a float stands for: 1/3 for 0.333..."""
    fraction = Fraction(number).limit_denominator(10**6)
    is_near = math.isclose(fraction, number, rel_tol=1e-14, abs_tol=1e-15)
    return sympy.Rational(fraction if is_near else Fraction(number))
