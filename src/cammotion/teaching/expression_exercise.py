"""Exercises whose answer is a formula: an expression of SymPy or a function of the learner's."""

import inspect
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence, Sized
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np
import sympy

from cammotion.quantities import Floats, shorten
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import Exercise, Slip, led_to
from cammotion.teaching.reading import OddAnswerError, to_number
from cammotion.teaching.reasons import COMMON_RATIOS, in_one

_PLACES = 24
_FACTOR = (
    "The form is right, but all of it is {} times what it should be. Which constant factor is "
    "missing, or too many?"
)
_ENDS_ONLY = (
    "It is right at both ends and wrong between. The ends alone do not prove a formula: try the "
    "middle, or a quarter of the way."
)
_ROUNDED = (
    "Everywhere this is within {} % of the right formula: a number in it was probably rounded. "
    "Keep fractions, like 5/12, or all the digits."
)
_NEARLY = 0.005
_NUMBER = (
    "This is one number, the same everywhere: there is no {} in it, and what is asked for depends "
    "on that."
)
_STANDS_FOR = (
    "There is {0} in it, which stands for {1}. Put brackets around all of it, and write "
    ".subs({0}, {1}) behind them."
)
_ANOTHER = "This is another formula. Put in numbers for which you know the result, and see."


@dataclass(frozen=True, kw_only=True)
class ExpressionExercise(Exercise):
    """A formula in named `variables`, compared with the right one at many places.

    `answer` is for a machine an expression in symbols of these names; whatever their assumptions,
    symbols are known by their names alone. The places lie `between` two values, the same for each
    variable; if the formula runs along a move, `along` is the variable that goes from 0 to the
    value of the variable `until`. `stands_for` says what a symbol of the question that is none of
    the variables is made of.
    """

    variables: tuple[str, ...]
    answer: Callable[[MillAndDie], sympy.Expr]
    slips: tuple[Slip, ...] = ()
    along: str = ""
    until: str = ""
    stands_for: Mapping[str, str] = field(default_factory=dict, hash=False)
    between: tuple[float, float] = (0.2, 2.0)
    tolerance: float = 1e-6

    @property
    def wanted(self) -> str:
        """What kind of answer is asked for, in words."""
        them = "it" if len(self.variables) == 1 else "them"
        return f"an expression in {', '.join(self.variables)}, or a function of {them}"

    def solution(self, machine: MillAndDie) -> sympy.Expr:
        """Return the right expression for a machine."""
        expression: sympy.Expr = led_to(self.answer, machine)
        return expression

    def find_fault(self, answer: Any, machine: MillAndDie) -> str:
        """Return why a formula is wrong; "" if it is right."""
        places, solution = self._places(), self.solution(machine)
        given, right = self._values(answer, places), self._values(solution, places)
        if self._same(given, right):
            return ""
        known = in_one(
            slip.reason
            for slip in self.slips
            if (wrong := slip.leads_to(machine)) is not sympy.nan  # where nobody goes this way
            and self._same(given, self._values(wrong, places))
        )
        return (
            known
            or self._constant(given, right)
            or _rounded(given, right)
            or _constant_factor(given, right)
            or self._at_ends(answer, solution)
            or _ANOTHER
        )

    @property
    def faults(self) -> tuple[str, ...]:
        """All that `find_fault` may return, with … in the place of a number that it measures."""
        slips = (slip.reason for slip in self.slips)
        said = (each.format("…") for each in (_ROUNDED, _FACTOR))
        number = _NUMBER.format(" or ".join(self.variables))
        return (*slips, *COMMON_RATIOS.values(), number, *said, _ENDS_ONLY, _ANOTHER)

    def _constant(self, given: Floats, right: Floats) -> str:
        """Say so if a formula is a number, and the right one is none."""
        is_number = np.all(given == given[0]) and not np.all(right == right[0])
        return _NUMBER.format(" or ".join(self.variables)) if is_number else ""

    def _at_ends(self, answer: Any, solution: sympy.Expr) -> str:
        """Say so if a formula is right at both ends of the move."""
        if not self.along:
            return ""
        along, until = self.variables.index(self.along), self.variables.index(self.until)
        for share in (0, 1):
            places = self._places()
            places[along] = share * places[until]
            if not self._same(self._values(answer, places), self._values(solution, places)):
                return ""
        return _ENDS_ONLY

    def _places(self) -> Floats:
        """Return a row of values for each variable, the same ones each time."""
        roots = np.sqrt([2.0, 3.0, 5.0, 7.0, 11.0])[: len(self.variables), None]
        shares = np.mod(np.arange(1, _PLACES + 1) * roots, 1)
        low, high = self.between
        places = low + (high - low) * shares
        if self.along:  # stay within the move
            along, until = self.variables.index(self.along), self.variables.index(self.until)
            places[along] = shares[along] * places[until]
        return np.asarray(places)

    def _values(self, answer: Any, places: Floats) -> Floats:
        if isinstance(answer, str | bytes):
            raise OddAnswerError("This is a text. Write the expression itself, without quotes.")
        if isinstance(answer, Iterable | Sized):
            raise OddAnswerError(
                f"This may hold several values (it is of type {type(answer).__name__}). What is "
                f"asked for is {self.wanted}."
            )
        is_function = callable(answer) and not isinstance(answer, sympy.Basic)
        if is_function or isinstance(answer, sympy.Lambda):
            values = self._call(answer, places)
        else:
            values = self._evaluate(answer, places)
        if not np.all(np.isfinite(values)) or not np.allclose(values.imag, 0, atol=1e-12):
            raise OddAnswerError("It does not give a real, finite number everywhere.")
        return np.asarray(values.real)

    def _call(self, function: Callable[..., Any], places: Floats) -> Any:
        """Call a function of the learner's, whatever it does."""
        ordered = places[_order(function, self.variables)]
        try:
            with warnings.catch_warnings(action="ignore"):  # a warning would cost points
                results = [function(*place) for place in ordered.T.tolist()]
        except Exception as raised:
            raise OddAnswerError(
                f"Your function stopped with {type(raised).__name__} ({shorten(str(raised))}) when "
                f"it was called with numbers for {', '.join(self.variables)}."
            ) from None
        if any(result is None for result in results):
            raise OddAnswerError("Your function returns nothing. Has return been forgotten?")
        try:
            return np.array([to_number(result, "one number") for result in results], complex)
        except OddAnswerError as odd:
            raise OddAnswerError(f"Look at what your function returns. {odd}") from None

    def _evaluate(self, answer: Any, places: Floats) -> Any:
        try:
            expression = sympy.sympify(answer, strict=True)
        except (sympy.SympifyError, TypeError, ValueError):
            expression = None
        if isinstance(expression, sympy.Equality):
            raise OddAnswerError(
                "This is an equation: give the side with the formula, .rhs or .lhs."
            )
        if not isinstance(expression, sympy.Expr):
            raise OddAnswerError(f"{shorten(answer)} is no formula. Write {self.wanted}.")
        names = {symbol.name for symbol in expression.free_symbols}
        for name in names & self.stands_for.keys():
            raise OddAnswerError(_STANDS_FOR.format(name, self.stands_for[name]))
        function = _function_of(expression, self.variables, self.wanted)
        with np.errstate(all="ignore"):
            return np.asarray(function(*places), dtype=np.complex128) + np.zeros(_PLACES)

    def _same(self, one: Floats, other: Floats) -> bool:
        scale = float(np.abs(other).max()) or 1.0
        return bool(np.all(np.abs(one - other) <= self.tolerance * scale))


@lru_cache(maxsize=2**10)
def _function_of(
    expression: sympy.Expr, variables: tuple[str, ...], wanted: str
) -> Callable[..., Any]:
    """Return an expression as a function; kept, since this takes longer than all the rest."""
    plain = {name: sympy.Symbol(name) for name in variables}
    symbols = {symbol.name: symbol for symbol in expression.free_symbols}
    if unknown := sorted(symbols.keys() - plain.keys()):
        raise OddAnswerError(f"Your expression contains {', '.join(unknown)}. Write {wanted}.")
    renamed = expression.xreplace({symbol: plain[name] for name, symbol in symbols.items()})
    if expression.has(sympy.zoo):
        raise OddAnswerError("Something in it is divided by zero.")
    if expression.has(sympy.Derivative, sympy.Integral):
        raise OddAnswerError("A part of it is still to be worked out: write .doit() behind it.")
    function: Callable[..., Any] = sympy.lambdify([*plain.values()], renamed, "numpy")
    return function


def _order(function: Callable[..., Any], variables: Sequence[str]) -> list[int]:
    """Return the order in which a function takes the variables; theirs if it has other names."""
    try:
        if isinstance(function, sympy.Lambda):
            names = [*map(str, function.signature)]
        else:
            names = [*inspect.signature(function).parameters]
    except (TypeError, ValueError):  # a built-in function
        names = []
    return [variables.index(name) for name in (names if set(names) == {*variables} else variables)]


def _rounded(given: Floats, right: Floats) -> str:
    """Say so if a formula is nearly right, everywhere."""
    off = float(np.abs(given / np.where(right, right, np.nan) - 1).max())
    return _ROUNDED.format(f"{100 * off:.1g}") if off <= _NEARLY else ""


def _constant_factor(given: Floats, right: Floats) -> str:
    """Say so if a formula is right but for a constant factor."""
    where = np.abs(right) > 1e-9 * np.abs(right).max()
    ratios = given[where] / right[where]
    ratio = float(np.median(ratios))
    if not np.allclose(ratios, ratio, rtol=1e-6, atol=0) or ratio == 0:
        return ""
    known = (said for value, said in COMMON_RATIOS.items() if np.isclose(ratio, value, rtol=1e-6))
    return next(known, "") or _FACTOR.format(f"{ratio:.4g}")
