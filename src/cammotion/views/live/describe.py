"""From the parts of a live figure to its description: plain data, which can be stored and drawn."""

import re
import string
from collections.abc import Hashable, Iterable, Mapping, Sequence
from itertools import chain
from typing import Any

import sympy as sp
from sympy.solvers.solveset import NonlinearError

from cammotion.quantities import InputError, shorten
from cammotion.views.live.expressions import (
    NOW,
    as_condition,
    as_curve,
    as_expression,
    parts_of,
    shortly,
)
from cammotion.views.live.formulas import Formulas
from cammotion.views.live.parts import (
    Box,
    Button,
    Choice,
    Control,
    Line,
    Panel,
    Pinned,
    Point,
    Say,
)
from cammotion.views.notation import axis_label, labelled

Description = dict[str, Any]

_FORMATS = r"a number is written as {name:.3f}, {name:.4g} or {name:g}"


class Describer:
    """Turns parts into plain data; every expression becomes the number of a formula.

    `variable` runs over `span`, (low, high), expressions in the controls and values. `controls`
    maps symbols to a Control each, `values` symbols to expressions.
    """

    def __init__(
        self,
        variable: sp.Symbol,
        span: tuple[Any, Any],
        controls: Mapping[sp.Symbol, Control],
        values: Mapping[sp.Symbol, Any],
    ) -> None:
        self.variable, self.span, self.controls = variable, span, dict(controls)
        self.symbols = list(controls)
        self._height = sp.Dummy("height")
        self._twins = {symbol: sp.Dummy(symbol.name) for symbol in controls}
        names = {variable: "x", self._height: "y", NOW: "y"}
        names |= {symbol: f"c{number}" for number, symbol in enumerate(controls)}
        names |= {twin: f"p{number}" for number, twin in enumerate(self._twins.values())}
        self.formulas = Formulas(names)
        self._quantities: dict[sp.Symbol, sp.Expr] = {}
        for symbol, expression in _in_order(values).items():
            if variable in expression.free_symbols:
                raise InputError(
                    f"The value of {symbol} is {shortly(expression)}, in which {variable} runs: "
                    f"put it into the curves, expression.subs({symbol}, ...)."
                )
            self._quantities[symbol] = expression
            self.formulas.add_quantity(symbol, expression)

    def formula(self, expression: Any) -> int:
        """Return the number of the formula of an expression, in which pinned ones may stand."""
        expression = as_expression(expression)
        if expression.has(Pinned):
            expression = expression.replace(Pinned, self._pinned)
        return self.formulas.add(expression)

    def control(self, symbol: sp.Symbol, control: Control) -> Description:
        """Return the description of a control, whose numbers have been checked."""
        most = None if control.most is None else self.formula(control.most)
        options = list(symbol.options) if isinstance(symbol, Choice) else None
        return {
            "name": control.name,
            "unit": control.unit,
            "low": control.low,
            "high": control.high,
            "step": control.step,
            "start": control.start,
            "most": most,
            "options": options,
        }

    def panel(self, panel: Panel) -> Description:
        """Return the description of a panel, as it is without others and without a clock."""
        is_over_variable = all(line.x is None for line in panel.lines)
        is_parametric = bool(panel.lines) and all(line.x is not None for line in panel.lines)
        over = "" if is_parametric else axis_label(self.variable.name, self.span[1])
        x_label = over if panel.x is None else panel.x
        return {
            "title": panel.title or f"{panel.y or 'Curves'}{' over ' * bool(x_label)}{x_label}",
            "lines": [self._line(at, line) for at, line in enumerate(panel.lines)],
            "points": [self._point(point) for point in panel.points],
            "boxes": [self._box(box) for box in panel.boxes],
            "words": [list(words) for words in panel.words],
            "x_label": x_label,
            "y_label": panel.y,
            "x_limits": self._formulas(panel.x_limits),
            "y_limits": self._formulas(panel.y_limits),
            "x_ticks": panel.x_ticks,
            "y_ticks": panel.y_ticks,
            "equal": panel.is_equal,
            "bare": panel.is_bare,
            "height": panel.height,
            "shares_x": False,
            "is_over_variable": is_over_variable and bool(panel.lines),
            "has_cursor": False,
        }

    def sentence(self, say: Say) -> list[Description]:
        """Return the alternatives of a sentence, each with the formula of its condition."""
        when = None if say.when is None else self.formula(as_condition(say.when))
        first = {"when": when, "pieces": list(self._pieces(say))}
        return [first, *(self.sentence(say.otherwise) if say.otherwise else [])]

    def button(self, button: Button) -> Description:
        """Return the description of a button: the numbers of the controls and of the formulas."""
        sets = [[self._control_number(s), self.formula(e)] for s, e in button.sets.items()]
        return {"text": button.text, "sets": sets}

    def clock(self, symbol: sp.Symbol, seconds: float) -> Description:
        """Return the description of what Play moves: the variable, or a control."""
        return {
            "name": labelled(symbol.name).split(" in ")[0],
            "control": None if symbol == self.variable else self._control_number(symbol),
            "seconds": seconds,
        }

    def ends(self) -> list[int]:
        """Return the formulas of where the variable begins and ends."""
        return [self.formula(end) for end in self.span]

    def _line(self, number: int, line: Line) -> Description:
        y = as_curve(line.y)
        curve = [y] if line.x is None else [y, as_curve(line.x)]
        joints = [*line.joints, *(joint for part in curve for joint in self._joints_of(part))]
        return {
            "y": self.formula(y),
            "x": None if line.x is None else self.formula(line.x),
            "over": self._formulas(line.over or self.span),
            "where": None if line.only_where is None else self.formula(line.only_where),
            "joints": sorted({self.formula(joint) for joint in joints}),
            "name": line.name,
            "role": line.role,
            "colour": number if line.colour is None else line.colour,
        }

    def _joints_of(self, expression: sp.Expr) -> Iterable[sp.Expr]:
        """Return where the variable passes from one piece of an expression to the next."""
        parts = parts_of(expression)
        relations = [part for part in parts if isinstance(part, sp.core.relational.Relational)]
        for relation in sorted(relations, key=sp.default_sort_key):
            difference = relation.lhs - relation.rhs
            slope = difference.diff(self.variable)
            if slope != 0 and self.variable not in slope.free_symbols:
                yield -difference.subs(self.variable, 0) / slope

    def _point(self, point: Point) -> Description:
        drags = self._inverse(point) if point.drags else None
        names = " and ".join(self.controls[symbol].name or "" for symbol in point.drags or ())
        return {
            "x": self.formula(point.x),
            "y": self.formula(point.y),
            "name": point.name,
            "colour": point.colour,
            "drags": drags,
            "label": f"point of {names}: arrow keys move it",
        }

    def _inverse(self, point: Point) -> list[list[int]]:
        """Return, for the two controls of a pad, what each is where the pointer is."""
        symbols = list(point.drags or ())
        pointer = [self.variable, self._height]
        equations = [as_curve(point.x) - pointer[0], as_curve(point.y) - pointer[1]]
        try:
            solved = sp.linsolve(equations, symbols)
        except NonlinearError:
            solved = sp.S.EmptySet
        if len(solved) != 1 or any(s in sol.free_symbols for sol in solved for s in symbols):
            raise InputError(
                f"The point at {shortly(point.x)}, {shortly(point.y)} cannot be moved: its x and y "
                f"have to follow from {symbols[0]} and {symbols[1]}, each place from one pair."
            )
        (found,) = solved
        return [
            [self._control_number(symbol), self.formula(value)]
            for symbol, value in zip(symbols, found, strict=True)
        ]

    def _box(self, box: Box) -> Description:
        sides = {"x_low": box.low, "x_high": box.high, "y_low": box.y[0], "y_high": box.y[1]}
        formulas = {
            side: None if value is None else self.formula(value) for side, value in sides.items()
        }
        return {**formulas, "name": box.name}

    def _pieces(self, say: Say) -> Iterable[str | Description]:
        try:
            parsed = list(string.Formatter().parse(say.text))
        except (TypeError, ValueError):
            raise InputError(
                f"The sentence {shorten(say.text)} cannot be read: close each {{ by a }}, and "
                "write {{ and }} for braces."
            ) from None
        for text, name, spec, conversion in parsed:
            if text:
                yield text
            if name is not None:
                if name not in say.numbers:
                    raise InputError(
                        f"The sentence '{say.text}' has {{{name}}}, which is not given: add it to "
                        "what the sentence's names stand for, or write {{ and }} for braces."
                    )
                yield self._piece(say.numbers[name], spec or "g", conversion or "")

    def _piece(self, value: Any, spec: str, conversion: str) -> str | Description:
        if isinstance(value, str):
            return value
        if isinstance(value, Choice):
            return {"choice": self._control_number(value)}
        if conversion or not re.fullmatch(r"g|\.[0-9]{1,2}[fg]", spec):
            spec = f"!{conversion}:{spec}" if conversion else spec
            raise InputError(f"The format '{spec}' is not known here: {_FORMATS}.")
        return {"formula": self.formula(value), "spec": spec}

    def _control_number(self, symbol: sp.Symbol) -> int:
        if symbol not in self.symbols:
            raise InputError(f"{symbol} is no control of this figure: add it to the controls.")
        return self.symbols.index(symbol)

    def _formulas(self, expressions: Sequence[Any] | None) -> list[int] | None:
        return None if expressions is None else [self.formula(each) for each in expressions]

    def _pinned(self, expression: sp.Expr) -> sp.Expr:
        """Return an expression with the pinned settings in the place of the settings."""
        for symbol in sorted(expression.free_symbols & self._quantities.keys(), key=str):
            if symbol not in self._twins:
                self._twins[symbol] = sp.Dummy(symbol.name)
                followed = self._pinned(self._quantities[symbol])
                self.formulas.add_quantity(self._twins[symbol], followed)
        return expression.xreplace(self._twins)


def _in_order(values: Mapping[sp.Symbol, Any]) -> dict[sp.Symbol, sp.Expr]:
    """Return values in an order in which each follows from those before it."""
    waiting = {symbol: as_expression(value) for symbol, value in values.items()}
    ordered: dict[sp.Symbol, sp.Expr] = {}
    while waiting:
        ready = [s for s, e in waiting.items() if not e.free_symbols & waiting.keys()]
        if not ready:
            names = ", ".join(sorted(map(str, waiting)))
            raise InputError(
                f"The values of {names} follow from one another in a circle: give one of them a "
                "number, or make it a control."
            )
        ordered |= {symbol: waiting.pop(symbol) for symbol in ready}
    return ordered


def describe(  # noqa: PLR0913 - the parts of a figure, each once
    describer: Describer,
    columns: Sequence[Sequence[Panel]],
    *,
    sentences: Iterable[Say],
    buttons: Iterable[Button],
    clock: tuple[sp.Symbol, float] | None,
    pin: str,
    shares: Sequence[float],
    title: str,
) -> Description:
    """Return the description of a figure: plain data for JSON, all its formulas in one list."""
    described = [[describer.panel(panel) for panel in column] for column in columns]
    for column, given in zip(described, columns, strict=True):
        is_one = len({*map(_across, given, column)}) == 1 and not any(p.is_equal for p in given)
        for panel in column:
            panel["shares_x"] = is_one
    if clock is not None and clock[0] == describer.variable:
        for panel in chain.from_iterable(described):
            panel["has_cursor"] = panel["is_over_variable"]
    controls = [describer.control(s, c) for s, c in describer.controls.items()]
    ends = describer.ends()
    said = [describer.sentence(say) for say in sentences]
    pressed = [describer.button(button) for button in buttons]
    return {
        "version": 1,
        "title": str(title),
        "range": ends,
        "controls": controls,
        "columns": described,
        "shares": list(shares),
        "sentences": said,
        "buttons": pressed,
        "clock": None if clock is None else describer.clock(*clock),
        "pin": pin,
        "quantities": describer.formulas.quantities,
        "formulas": describer.formulas.javascript,
    }


def _across(panel: Panel, described: Description) -> Hashable:
    """Return what the numbers under a panel follow from: panels with the same may share them."""
    curves = frozenset((line["x"], *line["over"]) for line in described["lines"])
    return panel.x, panel.is_bare, tuple(described["x_limits"] or ()) or curves
