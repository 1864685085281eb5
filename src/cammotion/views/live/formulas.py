"""The formulas of a live figure: SymPy expressions, printed for JavaScript and for NumPy alike.

What has no closed form can still stand in an expression: `largest`, `place_of_largest` and
`inverse` are searched for where the formula is evaluated, by the same steps in both languages.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache, cached_property
from typing import Any

import numpy as np
import sympy as sp
from sympy.printing.codeprinter import PrintMethodNotImplementedError

from cammotion.quantities import Floats, InputError, listed, shorten
from cammotion.views.live.expressions import NOW, as_curve, as_expression, check_computable, shortly
from cammotion.views.live.printers import JavaScript, Python, SearchBase, is_search

SAMPLES, HALVINGS, NARROWINGS = 200, 60, 48
_GOLDEN = (5**0.5 - 1) / 2
_POLE, _ENDLESS = 1e-7, 100  # so near a peak a value a hundred times as small: it has no end


class Largest(SearchBase):
    """The largest value of a function between two places; made by `largest`."""

    nargs, is_real, code = 3, True, "largest"


class PlaceOfLargest(SearchBase):
    """Where a function is largest between two places; made by `place_of_largest`."""

    nargs, is_real, code = 3, True, "place_of_largest"


class PlaceOfValue(SearchBase):
    """Where a monotone function has a value, between two places; made by `inverse`."""

    nargs, is_real, code = 4, True, "inverse"


def largest(expression: Any, span: tuple[Any, Any, Any]) -> sp.Expr:
    """Return the largest value of an expression while a symbol goes over a `span`, as SymPy has it.

    `span` is (symbol, low, high), as for `sympy.integrate`. It is searched for when a figure needs
    it: the best of 201 samples, narrowed to the last digits. A peak narrower than the span's 200th
    part may be missed.

    >>> import sympy as sp
    >>> t, T = sp.symbols("t T")
    >>> largest(sp.sin(t), (t, 0, T)).free_symbols
    {T}
    """
    return Largest(*_bound(expression, span))


def place_of_largest(expression: Any, span: tuple[Any, Any, Any]) -> sp.Expr:
    """Return where an expression is largest while a symbol goes over a `span`, as SymPy has it.

    `span` is (symbol, low, high), and the search that of `largest`.

    >>> import sympy as sp
    >>> t, T = sp.symbols("t T")
    >>> place_of_largest(sp.sin(t), (t, 0, T)).free_symbols
    {T}
    """
    return PlaceOfLargest(*_bound(expression, span))


def inverse(expression: Any, span: tuple[Any, Any, Any], value: Any) -> sp.Expr:
    """Return where an expression has a `value`, as SymPy has it; over the `span` it is monotone.

    `span` is (symbol, low, high). It is found by halving when a figure needs it, and is not a
    number (nan) where the value is not reached within the span.

    >>> import sympy as sp
    >>> x, depth = sp.symbols("x depth")
    >>> inverse(x**2, (x, 0, 1), depth).free_symbols
    {depth}
    """
    return PlaceOfValue(*_bound(expression, span), as_curve(value))


def _bound(expression: Any, span: tuple[Any, Any, Any]) -> tuple[sp.Lambda, sp.Expr, sp.Expr]:
    symbol, *ends = listed(span) or (None,)
    if not isinstance(symbol, sp.Symbol) or len(ends) != 2:  # noqa: PLR2004
        raise InputError(
            f"The span of a search is {shorten(span)}: give (symbol, low, high), for example "
            "(t, 0, 1)."
        )
    low, high = map(as_curve, ends)
    return sp.Lambda(symbol, as_curve(expression)), low, high


class Formulas:
    """The formulas of one figure: added as expressions, kept once each, and numbered.

    `names` says for each symbol what it is called in a formula: x and y what runs, c0, c1, ... the
    settings, p0, ... the pinned settings, q0, ... what follows from them.
    """

    def __init__(self, names: Mapping[sp.Symbol, str]) -> None:
        self.names = dict(names)
        self.quantities: list[str] = []
        self.javascript: list[str] = []
        self._known: dict[sp.Expr, int] = {}
        self._python: list[str] = []
        self._python_quantities: list[str] = []

    def add_quantity(self, symbol: sp.Symbol, expression: sp.Expr) -> None:
        """Let a symbol stand for what follows from the settings and earlier quantities."""
        javascript, python = self._print(expression)
        self.names[symbol] = f"q{len(self.quantities)}"
        self.quantities.append(javascript)
        self._python_quantities.append(python)

    def add(self, expression: Any) -> int:
        """Return the number of a formula, a new one unless it is there already.

        Raises InputError for what no formula can be made of, and says why.
        """
        expression = as_expression(expression)
        if expression not in self._known:
            for piece in _moving_in(expression):
                if piece != expression:
                    self.add(piece)
            javascript, python = self._print(expression)
            self._known[expression] = len(self.javascript)
            self.javascript.append(javascript)
            self._python.append(python)
        return self._known[expression]

    def at(self, settings: Iterable[float], pinned: Iterable[float]) -> list[Callable[..., Any]]:
        """Return the formulas as functions of x and y, floats or arrays, for these settings."""
        formulas: list[Callable[..., Any]] = []
        with np.errstate(all="ignore"):
            formulas.extend(self._compiled(formulas, *map(np.float64, (*settings, *pinned))))
        return formulas

    @cached_property
    def _compiled(self) -> Callable[..., Any]:
        """One function, of the list to be filled, settings and pinned settings, of all formulas."""
        body = "".join(
            f"{self._called(expression)}(lambda x=0.0, y=0.0: {formula}),"
            for expression, formula in zip(self._known, self._python, strict=True)
        )
        body = f"({body})"
        for number, quantity in reversed(list(enumerate(self._python_quantities))):
            body = f"(lambda q{number}: {body})({quantity})"
        settings = [name for name in self.names.values() if name[0] == "c"]  # in their order
        arguments = ["f", *settings, *(name.replace("c", "p") for name in settings)]
        return sp.lambdify(arguments, body, modules=[_FOUND_BY, vars(np)])  # type: ignore[no-any-return]

    def _called(self, expression: sp.Expr) -> str:
        """Return what a formula is handed to: a search takes one number, and its time."""
        if not is_search(expression):
            return ""
        runs = {self.names.get(symbol) for symbol in expression.free_symbols} & {"x", "y"}
        return "pointwise" if runs else "once"

    def _print(self, expression: sp.Expr) -> tuple[str, str]:
        """Return an expression in both languages."""
        check_computable(expression)
        self._check_symbols(expression)
        printers = JavaScript(self.names, self._known), Python(self.names, self._known)
        try:
            javascript, python = (printer._print(expression) for printer in printers)
        except PrintMethodNotImplementedError as refused:
            function = str(refused).split(": ")[1].splitlines()[0].strip("<>'").split(".")[-1]
            raise InputError(
                f"A live figure cannot compute {function}, which is in {shortly(expression)}: "
                "write it by other functions (sin, cos, exp, log, sqrt, Piecewise, ...)."
            ) from None
        return javascript.replace("Math.", ""), python

    def _check_symbols(self, expression: sp.Expr) -> None:
        unknown = sorted(
            (s for s in expression.free_symbols if s not in self.names), key=lambda s: s.name
        )
        if unknown:
            self._refuse_symbol(expression, unknown[0])

    def _refuse_symbol(self, expression: sp.Expr, unknown: sp.Symbol) -> None:
        name = unknown.name
        same = [known for known in self.names if known.name == name]
        if same:
            raise InputError(
                f"There are two symbols {name}, since a symbol with other assumptions is another: "
                f"use the one that stands in {shortly(expression)} in the controls and values too."
            )
        whole = f"{shortly(expression)} contains" if expression != unknown else "A figure needs"
        raise InputError(
            f"{whole} {name}, which is neither the variable nor a control: "
            f"add it to the controls, {{{name}: (low, high)}}, or give it a value, "
            f"values={{{name}: ...}}."
        )


def _moving_in(expression: sp.Basic) -> Iterator[sp.Piecewise]:
    """Return the outermost pieces that move with the clock, which all lines of a picture share."""
    if NOW in expression.free_symbols:
        if isinstance(expression, sp.Piecewise):
            yield expression
        else:
            for part in expression.args:
                yield from _moving_in(part)


def find_largest(function: Callable[[Any], Any], low: float, high: float) -> float:
    """Return the largest value of a function from low to high, by the steps of `formulas.js`."""
    return _search(function, low, high)[1]


def find_place_of_largest(function: Callable[[Any], Any], low: float, high: float) -> float:
    """Return where a function is largest from low to high, by the steps of `formulas.js`."""
    return _search(function, low, high)[0]


def find_inverse(function: Callable[[Any], Any], low: float, high: float, wanted: float) -> float:
    """Return where a monotone function has a value, by the steps of `formulas.js`; else nan."""
    low, high = np.float64(low), np.float64(high)
    sign = 1 if function(high) >= function(low) else -1
    if not sign * (function(low) - wanted) <= 0 <= sign * (function(high) - wanted):
        return np.nan
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if sign * (function(middle) - wanted) < 0:
            low = middle
        else:
            high = middle
    return (low + high) / 2


def _search(function: Callable[[Any], Any], low: float, high: float) -> tuple[float, float]:
    places = np.float64(low) + np.arange(SAMPLES + 1) * (high - low) / SAMPLES
    values: Floats = np.broadcast_to(np.asarray(function(places), dtype=float), places.shape)
    best = int(np.argmax(np.where(np.isnan(values), -np.inf, values)))
    a, b = places[max(best - 1, 0)], places[min(best + 1, SAMPLES)]
    for _ in range(NARROWINGS):
        c, d = b - (b - a) * _GOLDEN, a + (b - a) * _GOLDEN
        if function(c) > function(d):
            b = d
        else:
            a = c
    between = (a + b) / 2
    there = float(function(between))
    if there > values[best]:
        near = _POLE * (high - low)
        beside = max(float(function(between - near)), float(function(between + near)))
        return float(between), math.inf if there > _ENDLESS * abs(beside) else there
    return float(places[best]), float(values[best])


def pointwise(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that takes an array one number at a time, as a search has to."""
    known = cache(function)

    def at(x: Any = 0.0, y: Any = 0.0) -> Any:
        return known(x, y) if np.ndim(x) == 0 else np.array([known(each, y) for each in x])

    return at


def once(function: Callable[[], Any]) -> Callable[..., Any]:
    """Return a function of x and y which is the same at all of them, and searches only once."""
    known = cache(function)
    return lambda x=0.0, y=0.0: known()  # noqa: ARG005 - formulas are called alike


def select(conditions: list[Any], values: list[Any], default: float) -> Any:
    """Return what `numpy.select` does; of single numbers, as a search asks for, much sooner."""
    for each in (*conditions, *values):
        if isinstance(each, np.ndarray):
            return np.select(conditions, values, default)
    for condition, value in zip(conditions, values, strict=True):
        if condition:
            return np.float64(value)
    return np.float64(default)


_FOUND_BY: dict[str, Callable[..., Any]] = {
    "select": select,
    "once": once,
    "pointwise": pointwise,
    "largest": find_largest,
    "place_of_largest": find_place_of_largest,
    "inverse": find_inverse,
}
