"""Set expressions in motion: what the learner gives, completed by what the workbook knows."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any, TypeVar

import sympy as sp

from cammotion.quantities import InputError, Quantity, is_masked, shorten
from cammotion.views import notation
from cammotion.views.live.controls import MOST_CONTROLS, chosen_control, complete
from cammotion.views.live.describe import Describer, describe
from cammotion.views.live.expressions import as_curve, as_expression, refusing_the_endless
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import Button, Choice, Control, Line, Panel, Say
from cammotion.views.live.usual import labelled_panel, usual_sentences

_Part = TypeVar("_Part")
SECONDS = 4.0  # for the clock to run once through the variable's range


@refusing_the_endless()
def explore(  # noqa: PLR0913 - each is a part that a figure may have
    curves: Any,
    over: sp.Symbol | tuple[sp.Symbol, Any, Any],
    controls: Mapping[sp.Symbol, Control | tuple[float, ...]] | None = None,
    *,
    values: Mapping[sp.Symbol, Any] | None = None,
    says: Iterable[Say] | None = None,
    buttons: Iterable[Button] = (),
    clock: sp.Symbol | None = None,
    seconds: float = SECONDS,
    pin: str = "",
    shares: Sequence[float] | None = None,
    title: str = "Live figure",
) -> LiveFigure:
    """Return a live figure of expressions: the reader moves the controls, and the curves follow.

    `curves` is an expression, a mapping from names to expressions that share one picture, a Panel,
    or a list of these, one below the other; a list of lists stands in columns, as wide as `shares`.
    `over` is the symbol that runs, or (symbol, low, high), where the ends may be expressions.
    `controls` maps symbols to (low, high), (low, high, step) or a Control. `values` gives other
    symbols a number or an expression, and controls a start. A `choice` in a curve makes a control
    of its own. Names, units and the range of t, x and alpha come from the workbook's notation.

    `says` are the sentences above the picture, `buttons` set controls, `clock` is what Play moves
    (the running symbol unless sentences are given), once through in `seconds`. With `pin`, the
    text of a button, the reader keeps the present settings as a dashed reference.

    The figure has `values`, which follow the hand and can be set, `text`, `chosen`, `press`, `pin`,
    `picture` and `save`. The notation knows N, B_m, h_m, t_m, t, x, alpha, h, v, a and j; give a
    Control a name and a unit where you mean something else. Sines take rad.

    Raises InputError, which says how to mend it, for a symbol that is neither variable nor control
    nor value, for a function that a page cannot compute, for an empty range, and for curves that
    have no real value.

    >>> import sympy as sp
    >>> t, t_m, B_m, N, h_m = sp.symbols("t t_m B_m N h_m", positive=True)
    >>> a = 2 * sp.pi * h_m / t_m**2 * sp.sin(2 * sp.pi * t / t_m)
    >>> figure = explore(a, t, {B_m: (20, 220), N: (500, 5000)}, values={h_m: 0.05})
    >>> print(figure.text)
    indexing time tm = 0.275 s
    at 0 s: a = 0 m/s²
    largest: |a| = 4.154 m/s²
    """
    columns = _columns(curves)
    given = {
        symbol: as_expression(value) for symbol, value in _mapping("values", values, "5").items()
    }
    says = None if says is None else _all_of(Say, says, "sentences", 'Say("...", {})')
    buttons = _all_of(Button, buttons, "buttons", 'Button("...", {})')
    parts = [columns, says, buttons]
    symbols = {s for part in _expressions_in([*parts, *given.values()]) for s in part.free_symbols}
    ready = _controls(_mapping("controls", controls, "(0, 1)"), given, symbols)
    fixed = {symbol: value for symbol, value in given.items() if symbol not in ready}
    variable, span = _span(over, {s.name: s for s in symbols | ready.keys() | fixed.keys()})
    _let_follow(
        fixed, {*symbols, *_symbols_of(span), *_symbols_of(fixed.values())} - ready.keys(), ready
    )
    if variable in ready.keys() | fixed.keys():
        raise InputError(
            f"{variable} is the running variable, and a control or value too: take it from one of "
            "them."
        )
    _refuse_bare_degrees(_expressions_in(parts), variable, span, ready)
    describer = Describer(variable, span, ready, fixed)
    if says is None:
        clock = variable if clock is None else clock
        says = usual_sentences(columns, variable, span, fixed)
    description = describe(
        describer,
        [[labelled_panel(panel) for panel in column] for column in columns],
        sentences=says,
        buttons=buttons,
        clock=None if clock is None else _clock(clock, seconds),
        pin=pin,
        shares=_shares(shares, len(columns)),
        title=title,
    )
    return LiveFigure(describer, description)


def _refuse_bare_degrees(
    expressions: Iterable[sp.Basic],
    variable: sp.Symbol,
    span: tuple[Any, Any],
    controls: Mapping[sp.Symbol, Control],
) -> None:
    """Raise InputError where an angle in deg stands in a sine as if it were in rad."""
    angles = {symbol for symbol, control in controls.items() if control.unit == "deg"}
    if notation.axis_label(variable.name, span[1]).endswith(" in deg"):
        angles.add(variable)
    for expression in expressions:
        for wave in expression.atoms(sp.sin, sp.cos, sp.tan):
            factor, angle = wave.args[0].as_coeff_Mul()
            if angle in angles and factor.is_Rational:
                raise InputError(
                    f"{angle} is in deg, and {wave} takes it for rad: write "
                    f"{wave.func(sp.pi * wave.args[0] / 180)}, or use another symbol."
                )


def _mapping(name: str, given: Any, example: str) -> Mapping[sp.Symbol, Any]:
    """Return what is given by symbols; raise InputError for anything else."""
    if not isinstance(given, Mapping | None):
        raise InputError(
            f"The {name} are {shorten(given)}: give a mapping from symbols, for example "
            f"{{k: {example}}}."
        )
    for symbol in given or {}:
        if not isinstance(symbol, sp.Symbol):
            raise InputError(
                f"The {name} are given for {shorten(symbol)}, which is no symbol: use one of "
                f"SymPy's, for example k = sp.Symbol('k') and {{k: {example}}}."
            )
    return given or {}


def _all_of(kind: type[_Part], given: Any, name: str, example: str) -> list[_Part]:
    """Return a list of parts of one kind; raise InputError for anything else."""
    is_list = isinstance(given, Iterable) and not isinstance(given, str) and not is_masked(given)
    parts = list(given) if is_list else [given]
    for part in parts:
        if not isinstance(part, kind):
            raise InputError(f"{shorten(part)} is none of a figure's {name}: write [{example}].")
    return parts


def _clock(symbol: Any, seconds: Any) -> tuple[sp.Symbol, float]:
    if not isinstance(symbol, sp.Symbol):
        raise InputError(
            f"The clock is {shorten(symbol)}: give the symbol that Play moves, the running "
            "variable or a control."
        )
    return symbol, Quantity("time for the clock to run once", "s", example=SECONDS).number(seconds)


def _shares(given: Any, count: int) -> list[float]:
    """Return how wide the columns are, to each other."""
    if given is None:
        return [1.0] * count
    width = Quantity("share of a column in the width", "", example=1)
    if not isinstance(given, tuple | list) or len(given) != count:
        raise InputError(
            f"The shares of the width are {shorten(given)}: give a number for each of the columns, "
            f"which are {count} here."
        )
    return [width.number(share) for share in given]


def _columns(curves: Any) -> list[list[Panel]]:
    if isinstance(curves, list | tuple) and curves and all(isinstance(c, list) for c in curves):
        if not all(curves):
            raise InputError("There is nothing to draw in one of the columns: leave it out.")
        return [[_panel(each) for each in column] for column in curves]
    each = list(curves) if isinstance(curves, list | tuple) else [curves]
    if not each or any(isinstance(one, Mapping) and not one for one in each):
        raise InputError("There is nothing to draw: give an expression, or a list of them.")
    return [[_panel(one) for one in each]]


def _panel(curve: Any) -> Panel:
    if isinstance(curve, Panel):
        given: Any = curve.lines
        lines = given if isinstance(given, list | tuple) else [given]
        if not isinstance(curve.y, str):
            raise InputError(
                f"The label of a panel's heights is {shorten(curve.y)}: give a text, and what is "
                "drawn as lines, Panel(lines=[...])."
            )
        return replace(curve, lines=[each for line in lines for each in _panel(line).lines])
    if isinstance(curve, Mapping):
        lines = [Line(y=as_curve(y), name=str(name)) for name, y in curve.items()]
        return Panel(lines=lines)
    if isinstance(curve, Line):
        return Panel(lines=[curve])
    return Panel(lines=[Line(y=as_curve(curve))])


def _controls(
    given: Mapping[sp.Symbol, Any], values: Mapping[sp.Symbol, sp.Expr], symbols: set[sp.Symbol]
) -> dict[sp.Symbol, Control]:
    """Return all controls, complete: the given ones, and one for each choice among the symbols."""
    if len(given) > MOST_CONTROLS:
        raise InputError(
            f"There are {len(given)} controls, more than a hand can follow: give at most "
            f"{MOST_CONTROLS}, and the other symbols a number in values."
        )
    ready: dict[sp.Symbol, Control] = {}
    for symbol, wanted in given.items():
        control = wanted if isinstance(wanted, Control) else _ranged(symbol, wanted)
        if symbol in values:
            control = replace(control, start=values[symbol])
        ready[symbol] = complete(symbol, control)
    choices = sorted((s for s in symbols if isinstance(s, Choice)), key=lambda s: s.dummy_index)
    names = [symbol.name for symbol in choices]
    if len({*names}) < len(names):
        raise InputError(
            f"There are several choices of one name among {', '.join(names)}: make one choice, "
            "whose options are tuples of expressions, so that they go together."
        )
    return ready | {symbol: chosen_control(symbol) for symbol in choices}


def _ranged(symbol: sp.Symbol, wanted: Any) -> Control:
    try:
        low, high, *step = wanted
        (step,) = step or [None]
    except (TypeError, ValueError):
        raise InputError(
            f"The control {symbol} has {shorten(wanted)} as its range: give (low, high) or "
            "(low, high, step)."
        ) from None
    return Control(low=low, high=high, step=step)


def _span(over: Any, by_name: Mapping[str, sp.Symbol]) -> tuple[sp.Symbol, tuple[Any, Any]]:
    """Return the variable and the ends of its range, as given or from the notation."""
    variable, *ends = over if isinstance(over, tuple | list | sp.Tuple) and over else (over,)
    if not isinstance(variable, sp.Symbol) or len(ends) not in (0, 2):
        raise InputError(
            f"The running variable is {shorten(over)}: give a symbol, or a symbol and its range, "
            "for example (t, 0, 1)."
        )
    if ends:
        low, high = map(as_curve, ends)
        if variable in low.free_symbols | high.free_symbols:
            raise InputError(
                f"The variable {variable} runs from {low} to {high}, which contain {variable} "
                "itself: give ends that do not."
            )
        return variable, (low, high)
    if variable.name not in notation.RUNS_TO:
        raise InputError(
            f"It is not known from where to where {variable} runs: give its range too, for "
            f"example ({variable}, 0, 1)."
        )
    end = notation.RUNS_TO[variable.name]
    return variable, (0, by_name.get(end, sp.Symbol(end)) if isinstance(end, str) else end)


def _let_follow(
    fixed: dict[sp.Symbol, Any], used: set[sp.Symbol], controls: Mapping[sp.Symbol, Control]
) -> None:
    """Add to the fixed values what the notation knows of symbols that have none."""
    by_name = {symbol.name: symbol for symbol in {*controls, *fixed}}
    for symbol in used - fixed.keys() - controls.keys():
        sources, follow = notation.FOLLOWS.get(symbol.name, ((), None))
        if follow and by_name.keys() >= set(sources):
            fixed[symbol] = follow(*(by_name[name] for name in sources))


def _expressions_in(part: Any) -> Iterator[sp.Basic]:
    """Return all expressions in a part, or in parts of a part."""
    if isinstance(part, sp.Basic):
        yield part
    elif is_dataclass(part):
        for each in fields(part):
            yield from _expressions_in(getattr(part, each.name))
    elif isinstance(part, Mapping):
        yield from _expressions_in(list(part.values()))
    elif isinstance(part, list | tuple):
        for each in part:
            yield from _expressions_in(each)


def _symbols_of(expressions: Iterable[Any]) -> set[sp.Symbol]:
    return {s for each in expressions for s in as_expression(each).free_symbols}
