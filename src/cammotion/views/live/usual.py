"""What a live figure says and writes on its axes when its author has not: by the notation."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import sympy as sp

from cammotion.views import notation
from cammotion.views.live.expressions import as_curve, check_computable, shortly
from cammotion.views.live.formulas import largest
from cammotion.views.live.parts import Line, Panel, Say

_LONGEST_LABEL = 20
_ROUNDING = 1e-9


def labelled_panel(panel: Panel) -> Panel:
    """Return a panel with a label for its heights, which follows from the units if it has none."""
    if panel.y or not panel.lines:
        return panel
    first, *others = panel.lines
    if symbol := quantity_of(first.y):
        return replace(panel, y=notation.labelled(symbol))
    text = "" if others else first.name or shortly(first.y)
    return replace(panel, y=text if len(text) <= _LONGEST_LABEL else "y")


def usual_sentences(
    columns: Sequence[Sequence[Panel]],
    variable: sp.Symbol,
    span: tuple[Any, Any],
    values: Mapping[sp.Symbol, Any],
) -> list[Say]:
    """Return three sentences: what follows, what is at the clock's place, and the peaks."""
    lines = [line for column in columns for panel in column for line in panel.lines]
    followed = [symbol for symbol, value in values.items() if as_curve(value).free_symbols]
    unit = notation.axis_label(variable.name, span[1]).partition(" in ")[2]
    where = "at {place:.4g} " + unit if unit else f"at {_as_it_is(variable.name)} = {{place:.4g}}"
    meanings = [(s, notation.meaning(s.name)) for s in followed]
    says = [Say(f"{_as_it_is(m.name)} = {{it:.4g}}{m.after}", {"it": s}) for s, m in meanings]
    now = {f"y{i}": line.y for i, line in enumerate(lines)}
    says.append(Say(f"{where}: {', '.join(_readouts(lines))}", {"place": variable, **now}))
    ends = variable, *span
    peaks = {f"y{i}": largest(sp.Abs(line.y, evaluate=False), ends) for i, line in enumerate(lines)}
    return [*says, Say(f"largest: {', '.join(_readouts(lines, '|{}|'))}", peaks)]


def _readouts(lines: Sequence[Line], written: str = "{}") -> Iterator[str]:
    for number, line in enumerate(lines):
        symbol = quantity_of(line.y)
        unit = notation.meaning(symbol).after if symbol else ""
        name = written.format(line.name or symbol or f"curve {number + 1}")
        yield f"{_as_it_is(name)} = {{y{number}:.4g}}{unit}"


def _as_it_is(name: str) -> str:
    """Return a name for the text of a sentence, in which braces hold numbers."""
    return name.replace("{", "{{").replace("}", "}}")


def quantity_of(expression: Any) -> str | None:
    """Return the symbol of the quantity that an expression is, by its units; None if unknown.

    How it grows with all lengths, and with all times, says the powers of m and s.

    >>> t, t_m, h_m = sp.symbols("t t_m h_m", positive=True)
    >>> quantity_of(h_m / t_m**2 * sp.sin(t / t_m)), quantity_of(sp.sin(t / t_m))
    ('a', None)
    """
    expression = as_curve(expression)
    check_computable(expression)
    metres, seconds = (_power(expression, unit) for unit in (notation.METRES, notation.SECONDS))
    return None if metres is None or seconds is None else notation.BY_POWERS.get((metres, seconds))


def _power(expression: sp.Expr, unit: Mapping[str, int]) -> int | None:
    symbols = sorted(expression.free_symbols, key=lambda symbol: symbol.sort_key())
    at = {symbol: (37 + 11 * number) / 100 for number, symbol in enumerate(symbols)}
    at |= {symbol: 0 for symbol in symbols if symbol.is_integer}
    grown = {symbol: value * 2.0 ** unit.get(symbol.name, 0) for symbol, value in at.items()}
    try:
        before, after = (float(expression.subs(values)) for values in (at, grown))
    except (TypeError, ValueError, OverflowError):  # not a number at all
        return None
    if not before or not math.isfinite(before):
        return None
    if not 0 < after / before < math.inf:
        return None
    power = math.log2(after / before)
    return round(power) if abs(power - round(power)) < _ROUNDING else None
