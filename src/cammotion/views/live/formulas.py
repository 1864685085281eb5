"""The formulas of a live figure: SymPy expressions, printed for JavaScript and for NumPy alike.

What has no closed form can still stand in an expression: `largest`, `place_of_largest` and
`inverse` are searched for where the formula is evaluated, by the same steps in both languages.
"""

from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Any, ClassVar

import numpy as np
import sympy as sp
from sympy.printing.codeprinter import PrintMethodNotImplementedError
from sympy.printing.jscode import JavascriptCodePrinter
from sympy.printing.numpy import NumPyPrinter

from cammotion.quantities import Floats, InputError

SAMPLES, HALVINGS, NARROWINGS = 200, 60, 48
_GOLDEN = (5**0.5 - 1) / 2
_LONG_CONSTANT = 6  # parts, from which on a number is shorter than its formula


class Largest(sp.Function):  # type: ignore[misc]
    """The largest value of a function between two places; made by `largest`."""

    nargs, is_real = 3, True


class PlaceOfLargest(sp.Function):  # type: ignore[misc]
    """Where a function is largest between two places; made by `place_of_largest`."""

    nargs, is_real = 3, True


class PlaceOfValue(sp.Function):  # type: ignore[misc]
    """Where a monotone function has a value, between two places; made by `inverse`."""

    nargs, is_real = 4, True


_SEARCHES = {Largest: "largest", PlaceOfLargest: "place_of_largest", PlaceOfValue: "inverse"}


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
    return PlaceOfValue(*_bound(expression, span), sp.sympify(value))


def _bound(expression: Any, span: tuple[Any, Any, Any]) -> tuple[sp.Lambda, sp.Expr, sp.Expr]:
    symbol, low, high = span
    return sp.Lambda(symbol, sp.sympify(expression)), sp.sympify(low), sp.sympify(high)


class _Printer:
    """What both printers do alike: short names, formulas that are there already, and searches.

    `known` says which formula an expression in the figure's `variable` is.
    """

    def __init__(self, names: Mapping[sp.Symbol, str], known: Mapping[sp.Expr, int]) -> None:
        settings = {"strict": True, "order": "none"}
        super().__init__(settings | self._own_settings)  # type: ignore[call-arg]
        self.names, self.known = dict(names), known
        (self.variable,) = (symbol for symbol, name in names.items() if name == "x")

    _own_settings: ClassVar[dict[str, Any]] = {}
    _arrow: str
    _call: str

    def _print(self, expression: Any, **kwargs: Any) -> Any:
        is_whole = isinstance(expression, sp.Expr) and not expression.is_Atom
        number = self.known.get(expression) if is_whole else None
        if number is not None:
            return self._call.format(number, self.names[self.variable])
        return str(super()._print(expression, **kwargs))  # type: ignore[misc]

    def _print_Symbol(self, symbol: sp.Symbol) -> str:  # noqa: N802 - SymPy's way to be asked
        return str(self.names[symbol])

    _print_Dummy = _print_Symbol  # noqa: N815

    def _print_search(self, search: sp.Function) -> str:
        function, *others = search.args
        (symbol,) = function.variables
        outside = dict(self.names)
        self.names[symbol] = f"z{len(outside)}"
        body = self._arrow.format(self.names[symbol], self._print(function.expr))
        self.names = outside
        return f"{_SEARCHES[type(search)]}({', '.join([body, *map(self._print, others)])})"

    _print_Largest = _print_PlaceOfLargest = _print_PlaceOfValue = _print_search  # noqa: N815

    def _print_Mod(self, mod: sp.Mod) -> str:  # noqa: N802 - the % of JavaScript keeps the sign
        value, turn = mod.args
        return f"({self._print(value - turn * sp.floor(value / turn))})"

    def _print_Mul(self, product: sp.Mul) -> str:  # noqa: N802
        return str(super()._print_Mul(self._folded(product, as_Add=False)))  # type: ignore[misc]

    def _print_Add(self, total: sp.Add, order: Any = None) -> str:  # noqa: N802
        return str(super()._print_Add(self._folded(total, as_Add=True), order=order))  # type: ignore[misc]

    def _folded(self, expression: sp.Expr, **which: bool) -> sp.Expr:
        """Return a product or sum with what is constant in it as one number, if that is shorter."""
        constant, other = expression.as_independent(*expression.free_symbols, **which)
        if sum(1 for _ in sp.preorder_traversal(constant)) < _LONG_CONSTANT:
            return expression
        number = constant.evalf(17)
        return expression.func(number, other, evaluate=False) if number.is_Float else expression

    def _print_Float(self, number: sp.Float) -> str:  # noqa: N802 - the shortest that is the same
        return f"({float(number)!r})" if number < 0 else repr(float(number))


class _JavaScript(_Printer, JavascriptCodePrinter):  # type: ignore[misc]
    _arrow, _call = "({})=>{}", "f{}({})"

    def _print_Piecewise(self, pieces: sp.Piecewise) -> str:  # noqa: N802 - without line ends
        *conditional, (last, condition) = pieces.args
        if condition is not sp.true:
            conditional.append((last, condition))
            last = sp.nan
        choices = (f"{self._print(cond)}?{self._print(value)}:" for value, cond in conditional)
        return f"({''.join(choices)}{self._print(last)})"

    def _print_Pow(self, power: sp.Pow) -> str:  # noqa: N802 - a root of -1 is not real, as in Python
        if power.exp == sp.Rational(1, 3):
            return f"pow({self._print(power.base)}, 1/3)"
        return str(super()._print_Pow(power))

    def _print_NaN(self, _nan: Any) -> str:  # noqa: N802
        return "NaN"

    def _print_Infinity(self, _infinity: Any) -> str:  # noqa: N802
        return "Infinity"

    def _print_NegativeInfinity(self, _infinity: Any) -> str:  # noqa: N802
        return "(-Infinity)"


class _Python(_Printer, NumPyPrinter):  # type: ignore[misc]
    _arrow, _call = "(lambda {}: {})", "f[{}]({})"
    _own_settings: ClassVar[dict[str, Any]] = {"fully_qualified_modules": False}

    def _print_Max(self, largest: sp.Max) -> str:  # noqa: N802 - SymPy's own fails on mixed shapes
        return self._nest("maximum", largest.args)

    def _print_Min(self, least: sp.Min) -> str:  # noqa: N802
        return self._nest("minimum", least.args)

    def _print_And(self, conditions: sp.And) -> str:  # noqa: N802 - likewise
        return self._nest("logical_and", conditions.args)

    def _print_Or(self, conditions: sp.Or) -> str:  # noqa: N802
        return self._nest("logical_or", conditions.args)

    def _nest(self, function: str, arguments: tuple[sp.Expr, ...]) -> str:
        first, *others = map(self._print, arguments)
        for other in others:
            first = f"{function}({first}, {other})"
        return str(first)


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
        expression = sp.sympify(expression)
        if expression not in self._known:
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
        body = "".join(f"(lambda x=0.0, y=0.0: {formula})," for formula in self._python)
        body = f"({body})"
        for number, quantity in reversed(list(enumerate(self._python_quantities))):
            body = f"(lambda q{number}: {body})({quantity})"
        settings = sorted(name for name in self.names.values() if name[0] == "c")
        ordered = sorted(settings, key=lambda name: int(name[1:]))
        arguments = ["f", *ordered, *(name.replace("c", "p") for name in ordered)]
        symbols = [sp.Symbol(argument) for argument in arguments]
        return sp.lambdify(symbols, body, modules=[_FOUND_BY, "numpy"])  # type: ignore[no-any-return]

    def _print(self, expression: sp.Expr) -> tuple[str, str]:
        """Return an expression in both languages."""
        self._check(expression)
        printers = _JavaScript(self.names, self._known), _Python(self.names, self._known)
        try:
            javascript, python = (printer._print(expression) for printer in printers)
        except PrintMethodNotImplementedError as refused:
            function = str(refused).split(": ")[1].splitlines()[0]
            raise InputError(
                f"A live figure cannot compute {function}, which is in {shortly(expression)}: "
                "write it by other functions (sin, cos, exp, log, sqrt, Piecewise, ...)."
            ) from None
        return javascript.replace("Math.", ""), python

    def _check(self, expression: sp.Expr) -> None:
        unknown = sorted(
            (s for s in expression.free_symbols if s not in self.names), key=lambda s: s.name
        )
        if unknown:
            self._refuse_symbol(expression, unknown[0])
        if expression.has(sp.I, sp.zoo):
            raise InputError(
                f"{shortly(expression)} is not real: a live figure draws real numbers only, take "
                "its real part or its magnitude."
            )

    def _refuse_symbol(self, expression: sp.Expr, unknown: sp.Symbol) -> None:
        name = unknown.name
        same = [known for known in self.names if known.name == name]
        if same:
            raise InputError(
                f"There are two symbols {name}, since a symbol with other assumptions is another: "
                f"use the one that stands in {shortly(expression)} in the controls and values too."
            )
        raise InputError(
            f"{shortly(expression)} contains {name}, which is neither the variable nor a control: "
            f"add it to the controls, {{{name}: (low, high)}}, or give it a value, "
            f"values={{{name}: ...}}."
        )


def shortly(expression: sp.Expr) -> str:
    """Return an expression as text, cut where it is too long for a sentence."""
    text = str(expression)
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}..."


_LONGEST = 70  # of an expression in a sentence


def find_largest(function: Callable[[Any], Any], low: float, high: float) -> float:
    """Return the largest value of a function from low to high, by the steps of `formulas.js`."""
    return _search(function, low, high)[1]


def find_place_of_largest(function: Callable[[Any], Any], low: float, high: float) -> float:
    """Return where a function is largest from low to high, by the steps of `formulas.js`."""
    return _search(function, low, high)[0]


def find_inverse(function: Callable[[Any], Any], low: float, high: float, wanted: float) -> float:
    """Return where a monotone function has a value, by the steps of `formulas.js`; else nan."""
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
    places = low + np.arange(SAMPLES + 1) * (high - low) / SAMPLES
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
        return float(between), there
    return float(places[best]), float(values[best])


_FOUND_BY: dict[str, Callable[..., float]] = {
    "largest": find_largest,
    "place_of_largest": find_place_of_largest,
    "inverse": find_inverse,
}
