"""Whatever is given as an answer: no exception, always a sentence, nothing wrong taken as right."""

import math
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from itertools import cycle
from typing import Any, NoReturn

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from judging import ACCELERATION, CHOICES, FORMULAS, NUMBERS
from machines import examples

from cammotion.teaching.example import EXAMPLE
from cammotion.teaching.exercise import ChoiceExercise, Exercise, Verdict
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.variants import machine_for

MACHINE = machine_for("fuzz")
FAST = [e for e in NUMBERS if e.number not in {"04.1", "04.3", "05.2", "06.4"}]
"""Without those that take more than a millisecond for an answer."""
SOLUTIONS = {exercise: exercise.solution(MACHINE) for exercise in FAST}
IN_TURN = cycle(FAST)
BATCH = 20
ROUNDED = 0.012  # by so much a number may be off that is rounded to two digits


def refuse(*_: Any, **__: Any) -> NoReturn:
    raise RuntimeError("no")


@dataclass(frozen=True)
class Near:
    """An answer that is near to the right one of an exercise, or right."""

    exercise: NumberExercise
    answer: Any


@dataclass
class Frame:
    """What pandas gives: a column that can be iterated over and made an array."""

    values: tuple[float, ...] = (4.154,)

    def __iter__(self) -> Iterator[float]:
        return iter(self.values)

    def __len__(self) -> int:
        return len(self.values)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return np.array(self.values)


ODD = [
    sympy.Symbol("q"),
    Frame(),
    math,
    int,
    object,
    refuse,
    print,
    np.sin,
    sympy.sin,
    NotImplemented,
    Verdict("right", ""),
]
DTYPES = "?bhilqBHILQefdgFDGSUVOMm"
ARRAYS = [np.zeros(shape, dtype) for dtype in DTYPES for shape in ((), (1,), (0,), (3,), (2, 2))]
ODD_SYMPY = [
    *(sympy.zoo, sympy.nan, sympy.oo, -sympy.oo, sympy.I, sympy.true, sympy.EmptySet),
    *(sympy.Integer(10) ** 400, sympy.Rational(1, 3), sympy.sqrt(-2), sympy.Symbol("t") / 0),
    *(sympy.Matrix([[1, 2]]), sympy.Eq(sympy.Symbol("t"), 2), sympy.Interval(0, 1)),
    sympy.Piecewise((1, sympy.Symbol("t") < 1)),
    sympy.Integral(sympy.Symbol("t"), (sympy.Symbol("t"), 0, 1)),
    sympy.Function("f")(1),
    sympy.Function("f"),
    sympy.Lambda(sympy.Symbol("t"), 1),
    sympy.Derivative(sympy.Symbol("t"), sympy.Symbol("t")),
    sympy.FiniteSet(1, 2),
    sympy.Tuple(1, 2),
    sympy.O(sympy.Symbol("t")),
]

near_one = st.floats(0.98, 1.02) | st.sampled_from([1, -1, 1000, 2 * math.pi, 0.5, 0.9959, 1.0041])
near_right = st.builds(
    lambda exercise, factor, as_type: Near(exercise, as_type(SOLUTIONS[exercise] * factor)),
    st.sampled_from(FAST),
    near_one,
    st.sampled_from([float, np.float64, np.array, sympy.Float, Fraction, complex]),
)
plain = st.one_of(
    st.none(),
    st.just(...),
    st.booleans(),
    st.integers(),
    st.integers(-(10**400), 10**400),
    st.floats(),
    st.complex_numbers(),
    st.fractions(),
    st.decimals(),
    st.text(),
    st.characters(categories=["Cs", "Cc", "Nd"]),
    st.binary(),
    st.sampled_from("abcdABCD"),
    st.dates(),
)
hashable = st.integers() | st.text(max_size=3) | st.floats()
ANYTHING = st.one_of(
    plain,
    near_right,
    near_right,
    st.sampled_from(ODD),
    st.sampled_from(ARRAYS),
    st.sampled_from(ODD_SYMPY),
    st.lists(plain, max_size=3),
    st.recursive(st.integers(), lambda inner: st.lists(inner, max_size=2), max_leaves=5),
    st.tuples(plain),
    st.sets(hashable, max_size=3),
    st.dictionaries(hashable, plain, max_size=2),
)


def read(answer: Any) -> complex:
    """Read a number that was taken as right, in another way than the package does."""
    return complex(np.asarray(answer, dtype=object).item())


def let_go(answer: Any) -> Any:
    return answer.answer if type(answer) is Near else answer


def assert_sound(exercise: Exercise, answer: Any) -> None:
    verdict = exercise.judge(answer, MACHINE)
    assert verdict.state in {"open", "right", "wrong"}
    assert verdict.text.strip()
    assert len(verdict.text) < 500
    if verdict.state == "right" and isinstance(exercise, NumberExercise):
        right = exercise.solution(MACHINE)
        off = abs(read(answer) - right)
        rounded = [float(f"{right:.{digits}g}") for digits in (2, 3, 4)]
        is_rounded = min(abs(read(answer) - one) for one in rounded) <= 1e-9 * right
        is_rounded &= off <= ROUNDED * right
        assert is_rounded or off <= exercise.tolerance * right / (1 - exercise.tolerance)
    if verdict.state == "right" and isinstance(exercise, ChoiceExercise):
        assert exercise.answer in str(answer).casefold()


@given(st.lists(ANYTHING, min_size=BATCH, max_size=BATCH))
@examples(3000 // BATCH)
def test_three_thousand_answers_of_every_type(answers: list[Any]) -> None:
    for drawn in answers:
        exercise = drawn.exercise if type(drawn) is Near else next(IN_TURN)
        assert_sound(exercise, let_go(drawn))
        assert_sound(CHOICES[0], let_go(drawn))


@pytest.mark.parametrize("exercise", EXERCISES.values(), ids=lambda exercise: exercise.number)
def test_every_odd_object_is_answered_by_every_exercise(exercise: Exercise) -> None:
    for answer in (*ODD, *ARRAYS, *ODD_SYMPY):
        assert_sound(exercise, answer)


@pytest.mark.parametrize("exercise", NUMBERS, ids=lambda exercise: exercise.number)
def test_no_number_is_taken_as_right_beyond_the_tolerance(exercise: NumberExercise) -> None:
    right = exercise.solution(MACHINE)
    for factor in (*np.linspace(0.98, 1.02, 81), -1, 0, 10, 0.1, 1000, 0.001, np.pi, 0.5, 2, 1e300):
        assert_sound(exercise, factor * right)


PLACES: Mapping[ExpressionExercise, list[dict[str, float]]] = {
    exercise: [
        {"t": 0.3 * t_m, "h_m": h_m, "t_m": t_m}
        if exercise is ACCELERATION
        else {exercise.variables[0]: share}
        for h_m, t_m, share in [(0.5, 0.7, 0.1), (1.3, 1.9, 0.2), (0.5, 1.9, 0.23)]
    ]
    for exercise in FORMULAS
}


def formulas(exercise: ExpressionExercise) -> st.SearchStrategy[Any]:
    """Return formulas made of an exercise's variables and of its right one."""
    symbols = sympy.symbols(exercise.variables)
    right = exercise.solution(EXAMPLE)
    return st.recursive(
        st.sampled_from([*symbols, sympy.Integer(2), sympy.pi, right]),
        lambda inner: combined(inner, symbols[0]),
        max_leaves=4,
    )


def combined(inner: st.SearchStrategy[Any], symbol: sympy.Symbol) -> st.SearchStrategy[Any]:
    """Return formulas made of two others."""
    return st.builds(
        lambda combine, one, other: combine(one, other),
        st.sampled_from(
            [
                lambda one, other: one + other,
                lambda one, other: one * other,
                lambda one, other: one / other,
                lambda one, other: one - other,
                lambda one, _: one**2,
                lambda one, _: sympy.sin(one),
                lambda one, _: sympy.log(one),
                lambda one, other: sympy.Piecewise((one, symbol < 1), (other, True)),
            ]
        ),
        inner,
        inner,
    )


FORMULAS_OF = st.sampled_from(FORMULAS).flatmap(
    lambda exercise: st.tuples(st.just(exercise), formulas(exercise))
)


@given(FORMULAS_OF)
@examples(100)
def test_no_wrong_formula_is_taken_as_right(drawn: tuple[ExpressionExercise, Any]) -> None:
    exercise, formula = drawn
    verdict = exercise.judge(formula, EXAMPLE)
    assert verdict.text.strip()
    if verdict.state == "right":
        for place in PLACES[exercise]:
            right = exercise.solution(EXAMPLE).subs(place)
            assert complex(formula.subs(place)) == pytest.approx(complex(right))


@pytest.mark.parametrize("exercise", FORMULAS, ids=lambda exercise: exercise.number)
@given(ANYTHING)
@examples(60)
def test_functions_that_return_anything(exercise: ExpressionExercise, answer: Any) -> None:
    verdict = exercise.judge(lambda *_: let_go(answer), MACHINE)
    assert verdict.state == "wrong"
    assert verdict.text.strip()


RAISED = [RuntimeError("no"), RecursionError(), MemoryError(), StopIteration(), AssertionError()]


@pytest.mark.parametrize("error", RAISED, ids=repr)
def test_functions_that_raise(error: Exception) -> None:
    def raising(*_: float) -> float:
        raise error

    assert f"stopped with {type(error).__name__}" in ACCELERATION.judge(raising, MACHINE).text


@pytest.mark.parametrize("leave", [KeyboardInterrupt, SystemExit])
def test_who_wants_to_leave_may(leave: type[BaseException]) -> None:
    def leaving(*_: float) -> float:
        raise leave

    with pytest.raises(leave):
        ACCELERATION.judge(leaving, MACHINE)


def nested(depth: int) -> list[Any]:
    """Return lists within lists, deeper than Python can go."""
    inner: list[Any] = []
    for _ in range(depth):
        inner = [inner]
    return inner


HUGE: dict[str, Callable[[], Any]] = {
    "list": lambda: [1.0] * 10**6,
    "nested list": lambda: nested(10**5),
    "array": lambda: np.zeros(10**7),
    "text": lambda: "a" * 10**6,
    "dict": lambda: dict.fromkeys(range(10**5)),
    "bytes": lambda: b"a" * 10**6,
}


@pytest.mark.parametrize("make", HUGE.values(), ids=HUGE)
@pytest.mark.parametrize("exercise", [NUMBERS[0], CHOICES[0], *FORMULAS], ids=lambda e: e.number)
def test_a_huge_answer_is_judged_without_being_looked_through(
    exercise: Exercise, make: Callable[[], Any]
) -> None:
    answer = make()
    exercise.judge(1, MACHINE)  # what is worked out once
    started = time.process_time()  # whatever else the machine is busy with
    verdict = exercise.judge(answer, MACHINE)
    assert time.process_time() - started < 0.1
    assert verdict.state == "wrong"
    assert len(verdict.text) < 300
