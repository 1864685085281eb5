"""Turning points: all of them, and none that is not there."""

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from machines import DIPPING, MONOTONE, WAVY, Array, examples

import cammotion as cm
from cammotion import MotionLaw, x
from cammotion.laws.piece import bisect
from cammotion.laws.reader import read as read_piece

PI = sympy.pi
MANY_TURNS = [
    sympy.sin(30 * PI * x) + x,
    sympy.sin(7 * PI * x) + sympy.sin(11 * PI * x) / 2 + sympy.cos(23 * PI * x) / 3,
    x - sympy.sin(62 * PI * x) / 20,
    sympy.exp(-3 * x) * sympy.cos(40 * x),
    sympy.sin(100 * x**2),
    sympy.chebyshevt(7, 2 * x - 1),
]


def turning_points(curve: sympy.Expr, low: float, high: float) -> list[float]:
    """Return the turns of the piece as which a curve is read."""
    return read_piece(curve, low, high).turns


def sampled_turns(curve: sympy.Expr, samples: int) -> Array:
    """Return about where the slope changes its sign from one sample to the next."""
    places = (np.arange(samples) + 0.5) / samples
    signs = np.sign(sympy.lambdify(x, sympy.diff(curve, x))(places))
    return np.asarray(places[1:][signs[1:] != signs[:-1]])


@pytest.mark.parametrize("curve", MANY_TURNS, ids=str)
def test_every_one_of_many_turns_is_found(curve: sympy.Expr) -> None:
    sampled = sampled_turns(curve, 200_000)
    assert len(sampled) > 5
    assert turning_points(curve, 0, 1) == pytest.approx(sampled, abs=1e-5)


@examples(10)
@given(st.sets(st.integers(1, 59), min_size=2, max_size=5))
def test_a_polynomial_turns_at_the_simple_roots_of_its_slope(roots: set[int]) -> None:
    """At the double root, the first one, the curve stands for a moment and goes on."""
    flat = roots.pop()
    slope = sympy.prod(60 * x - root for root in roots) * (60 * x - flat) ** 2
    curve = sympy.expand(sympy.integrate(slope, x))
    turns = sorted(root / 60 for root in roots)
    assert turning_points(curve, 0, 1) == pytest.approx(turns, abs=1e-10)


def test_a_wave_of_very_many_turns_is_refused() -> None:
    """A single wave too, whose turns are known: to ask each of them would take minutes."""
    with pytest.raises(cm.InputError, match=r"turns so often, .* or it is a quotient with so wide"):
        MotionLaw("wave", sympy.sin(PI / 2 * (4 * 10**8 + 1) * x)).where_above(0.5)
    assert len(MotionLaw("wave", sympy.sin(PI / 2 * 2001 * x)).where_above(0.5)) == 501


def test_two_turns_close_together_are_found() -> None:
    """They are 1e-5 apart, 7 such pairs; 720 samples, a usual number, see none of them."""
    half, wave = 5e-6, 14 * PI
    steepness = 1 / sympy.cos(wave * sympy.Rational(half))
    curve = x - steepness * sympy.sin(wave * (x - sympy.Rational(1, 99))) / wave
    pairs = [n / 7 + 1 / 99 + side for n in range(7) for side in (-half, half)]
    assert turning_points(curve, 0, 1) == pytest.approx(pairs, abs=1e-9)
    assert len(sampled_turns(curve, 720)) == 0


def test_a_turn_is_exact_to_the_last_bit() -> None:
    assert turning_points(DIPPING.s, 0, 1) == pytest.approx([4 / 15], abs=1e-15)
    bottom = np.arccos(2 / (3 * np.pi)) / (6 * np.pi)  # of the first of three waves
    turns = [bottom, *(n / 3 + side * bottom for n in (1, 2) for side in (-1, 1)), 1 - bottom]
    assert turning_points(WAVY.s, 0, 1) == pytest.approx(turns, abs=1e-15)


def test_where_a_curve_lingers_at_its_turn_it_is_as_good_as_there() -> None:
    """About a triple root of the slope the curve is so flat that its place hardly matters."""
    [turn] = turning_points((60 * x - 7) ** 4, 0, 1)
    assert (60 * turn - 7) ** 4 < 1e-12


def test_a_flat_top_is_met_without_halving_for_ever() -> None:
    """The acceleration of Freudenstein's 1-3-5 is flattest where it is largest: J'' is 0 there."""
    waves = sympy.sin(2 * PI * x) + sympy.sin(6 * PI * x) / 6 + sympy.sin(10 * PI * x) / 50
    assert turning_points(waves, 0, 1) == pytest.approx([0.25, 0.75], abs=1e-4)


@pytest.mark.parametrize("law", MONOTONE, ids=str)
def test_flat_ends_are_no_turns(law: MotionLaw) -> None:
    """At the ends of most laws V, A and even J are 0: halving an interval there could go on."""
    if not law.s.has(sympy.Piecewise):
        assert turning_points(law.s, 0, 1) == []
    assert law.is_monotone


def test_only_what_lies_between_the_ends_counts() -> None:
    wave = sympy.cos(2 * PI * x)
    assert turning_points(wave, 0, 1) == [0.5]
    assert turning_points(wave, 0.6, 0.9) == []
    assert turning_points(wave, -0.75, 1.25) == pytest.approx([-0.5, 0, 0.5, 1], abs=1e-16)


def test_what_does_not_move_does_not_turn() -> None:
    assert turning_points(sympy.Integer(1), 0, 1) == []
    assert turning_points(x, 0, 1) == []


@pytest.mark.parametrize(
    ("curve", "function"),
    [(sympy.besselj(0, x), "besselj"), (sympy.Max(x, 1 - x), "Max"), (abs(x - 0.5), "Abs")],
)
def test_a_function_without_a_proof_is_refused(curve: sympy.Expr, function: str) -> None:
    fix = "use sin, cos, tan, exp, log, sqrt, powers and Piecewise"
    with pytest.raises(
        cm.InputError, match=rf"^The law uses the function .*{function}.*: {fix}\.$"
    ):
        turning_points(curve, 0, 1)


@given(st.floats(-1e3, 1e3), st.floats(1e-3, 1e3))
@examples(100)
def test_bisection_ends_at_the_first_float(place: float, way: float) -> None:
    found = bisect(lambda here: here < place, place - way, place + way)
    assert found == place


@pytest.mark.parametrize(("low", "high"), [(2, 5), (1, 6)])
@pytest.mark.parametrize("is_turned", [False, True])
def test_a_jerk_that_is_infinitely_steep_at_an_end_turns_where_it_turns(
    low: int, high: int, is_turned: bool
) -> None:
    """Its slope, 2 p x^(p - 1) - q x^(q - 1), is infinite at 0, of no sign for intervals."""
    p, q = sympy.Rational(low, 7), sympy.Rational(high, 7)
    terms = ((2, p), (-1, q))
    law = sum(factor * x ** (n + 3) / ((n + 3) * (n + 2) * (n + 1)) for factor, n in terms)
    law = law.subs(x, 1 - x) if is_turned else law
    jerk = read_piece(law, 0, 1).derivative.derivative.derivative
    turn = float((2 * p / q) ** (1 / (q - p)))
    turns = [turn] if turn < 1 else []
    assert jerk.turns == pytest.approx([1 - place for place in turns] if is_turned else turns)
