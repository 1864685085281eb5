"""Formulas as answers: the right one in any form, and why another one is wrong."""

import functools
import itertools
import re
from typing import Any

import numpy as np
import pytest
import sympy
from judging import ACCELERATION, each_formula, is_right, say

from cammotion.teaching.example import EXAMPLE
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.variants import NAMELESS

t, h_m, t_m = sympy.symbols("t h_m t_m")
FORMULA = h_m / t_m**2 * (6 - 12 * t / t_m)


def as_function(t: float, h_m: float, t_m: float) -> float:
    return h_m / t_m**2 * (6 - 12 * t / t_m)


def in_another_order(h_m: float, t_m: float, t: float) -> float:
    return as_function(t, h_m, t_m)


def with_numpy(t: Any, h_m: Any, t_m: Any) -> Any:
    return np.asarray(np.multiply(h_m / t_m**2, 6 - 12 * np.divide(t, t_m)))


class WithCall:
    """A formula as an object."""

    def __call__(self, *place: float) -> float:
        """Return the acceleration."""
        return as_function(*place)


def with_symbols(**assumed: bool) -> sympy.Expr:
    """Return the formula in symbols with assumptions."""
    return FORMULA.subs({s: sympy.Symbol(s.name, **assumed) for s in (t, h_m, t_m)})


def derived() -> sympy.Expr:
    """Derive the formula as a lesson does."""
    t, h_m, t_m = sympy.symbols("t h_m t_m", positive=True)
    return sympy.diff(h_m * (3 * (t / t_m) ** 2 - 2 * (t / t_m) ** 3), t, 2)


RIGHT_FORMULAS: dict[str, Any] = {
    "expanded": sympy.expand(FORMULA),
    "factored": 6 * h_m * (t_m - 2 * t) / t_m**3,
    "positive symbols": with_symbols(positive=True),
    "real symbols": with_symbols(real=True),
    "derived": derived(),
    "lambda": lambda t, h, tm: h / tm**2 * (6 - 12 * t / tm),
    "def": as_function,
    "named, in another order": in_another_order,
    "with NumPy": with_numpy,
    "vectorised": np.vectorize(as_function),
    "lambdified": sympy.lambdify((t, h_m, t_m), FORMULA),
    "SymPy's Lambda": sympy.Lambda((t, h_m, t_m), FORMULA),
    "Lambda, in another order": sympy.Lambda((h_m, t_m, t), FORMULA),
    "an object": WithCall(),
    "partly applied": functools.partial(as_function),
    "returns SymPy": lambda *place: FORMULA.subs(zip((t, h_m, t_m), place, strict=True)),
}


@pytest.mark.parametrize("formula", RIGHT_FORMULAS.values(), ids=RIGHT_FORMULAS)
def test_the_right_formula_in_every_sensible_form(formula: Any) -> None:
    assert is_right(ACCELERATION, formula), ACCELERATION.judge(formula, EXAMPLE)


ODD_FORMULAS: list[tuple[Any, str]] = [
    (FORMULA * (1 + sympy.Rational(1, 1000)), r"within 0\.1 % .* probably rounded\. Keep"),
    (FORMULA * (1 + sympy.Rational(1, 100)), r"1\.01 times what it should be"),
    (-FORMULA, "not the sign"),
    (6 * h_m / t_m**2 * sympy.cos(sympy.pi * t / t_m), "right at both ends and wrong between"),
    (FORMULA + t, "another formula"),
    (sympy.Symbol("hm") * FORMULA, "contains hm. Write an expression in t, h_m, t_m"),
    (str(FORMULA), "without quotes"),
    ([FORMULA], "several values .*list"),
    (sympy.Matrix([FORMULA]), "several values"),
    (sympy.Eq(FORMULA, sympy.Symbol("a")), r"equation: give the side with the formula, \.rhs or"),
    (True, "is no formula"),
    (3.0, "one number, .* no t or h_m or t_m in it"),
    (sympy.sqrt(-h_m), "real, finite"),
    (sympy.zoo + t, "divided by zero"),
    (sympy.Derivative(t**2, t), "still to be worked out"),
    (h_m * sympy.Integral(t, t), "still to be worked out"),
    (lambda t, h_m, t_m: None, "returns nothing. Has return been forgotten"),  # noqa: ARG005
    (lambda t, h_m, t_m: "3", "what your function returns. This is a text"),  # noqa: ARG005
    (lambda t, h_m, t_m: [t], "what your function returns. This may hold several"),  # noqa: ARG005
    (lambda t, h_m, t_m: FORMULA, "what your function returns. There still is h_m"),  # noqa: ARG005
    (lambda t: t, "stopped with TypeError"),
    (lambda t, h_m, t_m: 1 / 0, "stopped with ZeroDivisionError"),  # noqa: ARG005
    (print, "returns nothing"),
]


@pytest.mark.parametrize("formula", ["4/(1 - 2.003*r)", "4.01/(1 - 2*r)"])
def test_a_right_formula_with_rounded_numbers_is_told_so(formula: str) -> None:
    """Nothing is said of a factor that would be missing: none is."""
    said = say(EXERCISES["06.2"], sympy.sympify(formula))
    assert re.search("probably rounded. Keep fractions", said)
    assert "factor" not in said


@pytest.mark.parametrize(("formula", "said"), ODD_FORMULAS)
def test_a_wrong_formula_is_told_why(formula: Any, said: str, capsys: Any) -> None:
    assert re.search(said, say(ACCELERATION, formula))
    capsys.readouterr()  # what print has printed


@each_formula
def test_each_slip_in_the_formula_gets_its_own_reason(exercise: ExpressionExercise) -> None:
    assert len({slip.reason for slip in exercise.slips}) == len(exercise.slips) > 0
    for slip in exercise.slips:
        assert say(exercise, slip.leads_to(NAMELESS), NAMELESS) == slip.reason


@each_formula
def test_each_formula_in_several_forms(exercise: ExpressionExercise) -> None:
    right, symbols = exercise.solution(EXAMPLE), sympy.symbols(exercise.variables)
    other = {symbol: sympy.Symbol(symbol.name, positive=True) for symbol in symbols}
    for form in (sympy.expand(right), sympy.factor(right), sympy.together(right)):
        for formula in (form, form.subs(other), sympy.lambdify(symbols, form)):
            assert is_right(exercise, formula)
    for factor in (1.001, -1):
        assert not is_right(exercise, factor * right)


RANGES: dict[str, dict[str, tuple[float, float]]] = {
    "02.2": {"h_m": (0.1, 3), "t_m": (0.1, 3)},
    "05.4": {"p": (0, 1)},
    "06.2": {"r": (0, 1 / 8)},
}
"""Between what a quantity can lie: a share is part of a whole, two ramps of r fit into a quarter.

The longest pause of 06.2 leaves no more than that.
"""


@each_formula
def test_formulas_are_compared_where_the_quantities_can_lie(exercise: ExpressionExercise) -> None:
    seen: list[tuple[float, ...]] = []

    def watch(*place: float) -> float:
        seen.append(place)
        return 1.0

    say(exercise, watch)  # it is called at these places, and then at the ends of a move
    by_name = dict(zip(exercise.variables, np.array(seen[:24]).T, strict=True))
    for name, (low, high) in RANGES[exercise.number].items():
        values = by_name[name]
        assert ((low < values) & (values < high)).all()
        assert len({*values}) >= 20
        assert np.ptp(values) > 0.5 * (min(high, 2) - low)
    if exercise.along:
        shares = by_name[exercise.along] / by_name[exercise.until]
        assert ((shares > 0) & (shares < 1)).all()
        assert np.ptp(shares) > 0.8
    for one, other in itertools.combinations(by_name.values(), 2):
        assert abs(np.corrcoef(one, other)[0, 1]) < 0.9, "two quantities always go together"
