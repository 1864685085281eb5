"""Polynomials and waves: read from expressions, derived, evaluated and enclosed."""

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from machines import examples

from cammotion import LAWS, x
from cammotion.laws.curve import Curve
from cammotion.laws.expression import Expression
from cammotion.laws.reader import read as read_piece
from cammotion.laws.series import Series

PI = sympy.pi
CURVES = [
    3 * x**2 - 2 * x**3,
    1 - (1 - x) ** 5 / 3 + sympy.sqrt(2) * x,
    x - sympy.sin(2 * PI * x) / (2 * PI) + sympy.cos(PI * (5 * x - 1) / 3),
    (x - sympy.Float(0.3)) ** 3 * 7 - sympy.sin(7 - 31 * x) * sympy.exp(-1) ** 2,
    x - sympy.sin(14 * PI * (x - sympy.Rational(1, 99))) / 44,
    sympy.Integer(2),
]


def read(curve: sympy.Expr, low: float = 0.0, high: float = 1.0) -> Series:
    series = read_piece(curve, low, high)
    assert isinstance(series, Series)
    return series


def derivatives(series: Series) -> list[Series]:
    found = [series]
    while len(found) < 5:
        found.append(found[-1].derivative)
    return found


def exact(curve: sympy.Expr, place: float) -> float:
    return float(curve.subs(x, sympy.Rational(place)).evalf(40))


@pytest.mark.parametrize("curve", CURVES, ids=str)
@pytest.mark.parametrize("low", [0.0, 0.37])
def test_a_series_is_the_expression_once_more(curve: sympy.Expr, low: float) -> None:
    places = np.linspace(low, 1, 7)
    for order, series in enumerate(derivatives(read(curve, low))):
        wanted = [exact(sympy.diff(curve, x, order), place) for place in places]
        close = pytest.approx(wanted, rel=1e-13, abs=1e-15 * series.size(1))
        assert series.over(places) == close
        assert [series.at(place) for place in places] == close


@pytest.mark.parametrize(
    "curve",
    [
        *(sympy.exp(x), x * sympy.sin(x), 1 / (1 + x), sympy.sqrt(1 + x), sympy.sin(x**2)),
        *(x**31, sympy.Float(2) ** x),
    ],
    ids=str,
)
def test_any_other_form_is_left_as_it_is(curve: sympy.Expr) -> None:
    assert isinstance(read_piece(curve, 0.0, 1.0), Expression)


@pytest.mark.parametrize("name", LAWS)
def test_every_zone_of_the_catalogue_is_a_series(name: str) -> None:
    assert not any(isinstance(piece, Expression) for piece in LAWS[name].curve.pieces)


def test_what_cancels_is_nothing() -> None:
    """Constants that SymPy does not see to be zero, as they come out of a mirrored law."""
    nothing = sympy.sqrt(6) - sympy.sqrt(2) * sympy.sqrt(3, evaluate=False) + x**2 - x**2
    assert read(nothing + x).at(0) == 0
    assert read(1 - sympy.cos(PI * x)).derivative.at(1) == 0
    assert read(x + (1 - x) ** 2 - x**2 + x).turns == []


places = st.floats(0, 1)


@examples(100)
@given(st.sampled_from(CURVES), places, places, places, st.integers(0, 4))
def test_no_value_lies_outside_of_the_bounds(
    curve: sympy.Expr, one: float, other: float, share: float, order: int
) -> None:
    series = derivatives(read(curve))[order]
    low, high = sorted([one, other])
    place = min(low + share * (high - low), high)
    least, most = series.bounds(low, high)
    assert least - 1e-30 <= series.at(place) <= most + 1e-30  # less than that is taken for 0
    assert most - least <= 2 * series.size(1) * (1 + 1e-9)


@pytest.mark.parametrize(("low", "high"), [(0, 1), (0.1, 0.4), (0.6, 0.99)])
@pytest.mark.parametrize("curve", CURVES, ids=str)
def test_a_series_turns_where_its_expression_does(
    curve: sympy.Expr, low: float, high: float
) -> None:
    turns = read(curve, low, high).turns
    assert turns == pytest.approx(Expression(curve, low, high).turns, rel=1e-9)


@examples(40)
@given(st.lists(st.integers(1, 59), min_size=1, max_size=5, unique=True), st.floats(0, 0.01))
def test_no_turn_of_a_polynomial_is_missed(roots: list[int], low: float) -> None:
    slope = sympy.prod(x - sympy.Rational(root, 60) for root in roots)
    curve = sympy.expand(sympy.integrate(slope, x))
    turns = sorted(root / 60 for root in roots)
    assert read(curve, low).turns == pytest.approx(turns, abs=1e-9)


@examples(40)
@given(st.floats(1e-4, 0.4), st.integers(1, 12), st.floats(0, 1))
def test_no_turn_of_a_wave_is_missed(half: float, waves: int, start: float) -> None:
    """Each wave turns twice, `half` of its length before and after its steepest place."""
    phase = 2 * PI * (waves * x - sympy.Rational(start))
    steepness = sympy.cos(2 * PI * sympy.Rational(half))
    curve = sympy.sin(phase) / (2 * PI * waves) - steepness * x
    sides = [start + n + side * half for n in range(-2, waves + 2) for side in (-1, 1)]
    turns = sorted(side / waves for side in sides if 1e-6 < side < waves - 1e-6)
    found = read(curve).turns
    inside = [turn for turn in found if 1e-6 < turn * waves < waves - 1e-6]
    assert inside == pytest.approx(turns, abs=1e-9)


@pytest.mark.parametrize("name", ["modified trapezoid", "4-5-6-7 polynomial", "Gutman 1-3"])
def test_peaks_are_the_same_with_and_without_series(name: str) -> None:
    law = LAWS[name]
    for order in range(4):
        slow = [
            Expression(sympy.diff(zone.expression, x, order), zone.low, zone.high)
            for zone in law.curve.pieces
        ]
        assert law.curve.derived(order).largest == pytest.approx(Curve(slow).largest, rel=1e-12)


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (sympy.sin(3 * x), sympy.cos(5 * x + 1)),
        (sympy.sin(3 * x + 1), sympy.sin(3 * x - 2)),  # the difference is a constant
        (sympy.cos(3 * x), sympy.sin(-3 * x)),  # the sum is one
        (2 - sympy.cos(4 * x), 3 * sympy.sin(4 * x) - 1),
        (x**2 - 1, 3 * x + 2),
        (sympy.Integer(4), x + sympy.sin(2 * x)),
    ],
    ids=str,
)
def test_a_product_is_that_of_the_values(one: sympy.Expr, other: sympy.Expr) -> None:
    low, high = 0.25, 0.75
    product = read(one, low, high).times(read(other, low, high))
    assert product is not None
    for place in np.linspace(low, high, 7):
        right = float((one * other).subs(x, sympy.Rational(float(place))))
        assert product.at(place) == pytest.approx(right, rel=1e-13, abs=1e-15)
        assert product.derivative.at(place) == pytest.approx(
            float(sympy.diff(one * other, x).subs(x, sympy.Rational(float(place)))), rel=1e-13
        )


def test_a_wave_times_a_slope_is_no_series() -> None:
    wave, slope = read(sympy.sin(x)), read(x)
    assert wave.times(slope) is None
    assert slope.times(wave) is None
