"""The two languages of a formula: JavaScript and NumPy code, printed from one expression."""

from collections.abc import Mapping
from typing import Any, ClassVar

import sympy as sp
from sympy.printing.jscode import JavascriptCodePrinter
from sympy.printing.numpy import NumPyPrinter
from sympy.utilities.iterables import sift

from cammotion.views.live.expressions import NOW, parts_of

_LONG_CONSTANT = 6  # parts, from which on a number is shorter than its formula


class SearchBase(sp.Function):  # type: ignore[misc]
    """What has no closed form, but is searched for: of a function, between two places.

    `code` is what the search is called in both languages. SymPy's printers ask only for such
    base classes of functions whose names end in Base.
    """

    code: str


def is_search(expression: sp.Basic) -> bool:
    """Return whether there is something to search for in an expression."""
    return any(isinstance(part, SearchBase) for part in parts_of(expression))


def _folded(expression: sp.Expr) -> sp.Expr:
    """Return a product or sum whose constant parts are one number, if that is shorter."""
    constants, others = sift(expression.args, lambda part: part.is_number, binary=True)
    length = sum(1 for part in constants for _ in sp.preorder_traversal(part))
    if length < _LONG_CONSTANT or not others:
        return expression
    number = expression.func(*constants).evalf(17)
    return expression.func(number, *others, evaluate=False) if number.is_Float else expression


class _Printer:
    """What both printers do alike: short names, formulas that are there already, and searches.

    `known` says which formula an expression in the figure's `variable` is.
    """

    def __init__(self, names: Mapping[sp.Symbol, str], known: Mapping[sp.Expr, int]) -> None:
        settings = {"strict": True, "order": "none"}
        super().__init__(settings | self._own_settings)  # type: ignore[call-arg]
        self.names, self.known = dict(names), known
        self._printed: dict[sp.Basic, str] = {}  # with these names: much comes more than once
        (self.variable,) = (symbol for symbol, name in names.items() if name == "x")

    _own_settings: ClassVar[dict[str, Any]] = {}
    _arrow: str
    _nested = "{}"
    _call: str

    def _print(self, expression: Any, **kwargs: Any) -> Any:
        is_whole = isinstance(expression, sp.Expr) and not expression.is_Atom
        number = self.known.get(expression) if is_whole else None
        if number is not None:
            moves = ",y" * (NOW in expression.free_symbols)
            return self._call.format(number, self.names[self.variable] + moves)
        if not is_whole:
            return str(super()._print(expression, **kwargs))  # type: ignore[misc]
        if expression not in self._printed:
            self._printed[expression] = str(super()._print(expression, **kwargs))  # type: ignore[misc]
        return self._printed[expression]

    def _print_Symbol(self, symbol: sp.Symbol) -> str:  # noqa: N802 - SymPy's way to be asked
        return str(self.names[symbol])

    _print_Dummy = _print_Symbol  # noqa: N815

    def _print_SearchBase(self, search: SearchBase) -> str:  # noqa: N802
        function, *others = search.args
        (symbol,) = function.variables
        outside = self.names, self._printed
        self.names, self._printed = dict(self.names), {}
        self.names[symbol] = f"z{len(self.names)}"
        body = self._arrow.format(self.names[symbol], self._print(function.expr))
        if is_search(function.expr):
            body = self._nested.format(body)
        self.names, self._printed = outside
        return f"{search.code}({', '.join([body, *map(self._print, others)])})"

    def _print_Mod(self, mod: sp.Mod) -> str:  # noqa: N802 - the % of JavaScript keeps the sign
        value, turn = mod.args
        return f"({self._print(value - turn * sp.floor(value / turn))})"

    def _print_Mul(self, product: sp.Mul) -> str:  # noqa: N802
        return str(super()._print_Mul(_folded(product)))  # type: ignore[misc]

    def _print_Add(self, total: sp.Add, order: Any = None) -> str:  # noqa: N802
        return str(super()._print_Add(_folded(total), order=order))  # type: ignore[misc]

    def _print_NumberSymbol(self, number: sp.NumberSymbol) -> str:  # noqa: N802
        return repr(float(number))

    _print_Catalan = _print_EulerGamma = _print_GoldenRatio = _print_NumberSymbol  # noqa: N815
    _print_TribonacciConstant = _print_NumberSymbol  # noqa: N815

    def _print_Float(self, number: sp.Float) -> str:  # noqa: N802 - the shortest that is the same
        return f"({float(number)!r})" if number < 0 else repr(float(number))


class JavaScript(_Printer, JavascriptCodePrinter):  # type: ignore[misc]
    """Prints for a page, which has the names of `Math` and the searches."""

    _arrow, _call = "({})=>({})", "f{}({})"

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


class Python(_Printer, NumPyPrinter):  # type: ignore[misc]
    """Prints for the kernel, which has the names of NumPy and the searches."""

    _arrow, _nested, _call = "(lambda {}: {})", "pointwise(lambda z, _: {}(z))", "f[{}]({})"
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
