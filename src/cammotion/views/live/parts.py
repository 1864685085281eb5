"""What a live figure is made of: panels of lines, points and boxes, controls, sentences, buttons.

Wherever a part takes an expression, it may hold the figure's variable, its controls, and the
symbols that have been given a value. In a line the variable runs; everywhere else it is where the
clock stands.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import sympy as sp

from cammotion.arguments import checked
from cammotion.quantities import InputError, Quantity, keep_numbers, one_of, shorten
from cammotion.views.live.expressions import as_curve, as_expression

OWN, REFERENCE, ALARM, FRAME, AREA = "own", "reference", "alarm", "frame", "area"


@dataclass(frozen=True, kw_only=True)
class Control:
    """What the reader changes: a number from `low` to `high`, by a field and a slider.

    `step` is the slider's; the field takes any number of the range. `start` is where it stands at
    first, the usual value or the middle unless given. `name` and `unit` are those of the notation
    unless given. Where another control is moved, this one gives way to stay below `most`, an
    expression in the others.

    >>> Control(low=20, high=220, step=1, unit="deg").high
    220
    """

    low: float
    high: float
    step: float | None = None
    start: float | None = None
    name: str | None = None
    unit: str | None = None
    most: Any = None


@dataclass(frozen=True, kw_only=True)
class Line:
    """A curve: `y` over the figure's variable, or `x` and `y` while the variable runs.

    Where `expressions.NOW` stands in them, the curve moves with the clock. `over` is the span of
    the variable, (low, high), the figure's own unless given. `joints` are where pieces meet, so
    that corners are drawn exactly. The curve is drawn only where the expression `only_where` is
    above 0. `colour` counts from 0 through the workbook's colours and line styles. `role` is "own",
    "reference" (thin and dashed, what stays), "alarm" (red and wide), "frame" (thin, black) or
    "area" (no line, the area between the curve and zero is shaded).

    >>> import sympy as sp
    >>> t = sp.Symbol("t")
    >>> Line(y=sp.sin(t), name="a sine").role
    'own'
    """

    y: Any
    x: Any = None
    name: str = ""
    over: tuple[Any, Any] | None = None
    joints: Sequence[Any] = ()
    only_where: Any = None
    colour: int | None = None
    role: str = OWN

    def __post_init__(self) -> None:
        """Raise InputError for an unknown role or colour, and for a span of other than two ends."""
        roles = (OWN, REFERENCE, ALARM, FRAME, AREA)
        if not isinstance(self.role, str) or self.role not in roles:
            raise InputError(
                f"The role of a line is {shorten(self.role)}: give one of {', '.join(roles)}."
            )
        _check_colour(self.colour)
        _check_ends("span of a line", self.over)


@dataclass(frozen=True, kw_only=True)
class Point:
    """A point that moves, at `x` and `y` of its panel, with a `name` beside it.

    Where `drags` names two controls, x and y being linear in them, the point is a pad: the reader
    moves it by mouse, finger or arrow key, and with it the two controls.

    >>> Point(x=0, y=1).name
    ''
    """

    x: Any
    y: Any
    name: str = ""
    colour: int = 1
    drags: tuple[sp.Symbol, sp.Symbol] | None = None

    def __post_init__(self) -> None:
        """Raise InputError for an unknown colour, and for other than two controls to drag."""
        _check_colour(self.colour)
        _check_ends("pair of controls that a point drags", self.drags)


@dataclass(frozen=True, kw_only=True)
class Box:
    """A shaded region from `low` to `high` in x, and in `y`: a side left out reaches to the edge.

    >>> Box(low=30, high=60, name="at work").y
    (None, None)
    """

    low: Any = None
    high: Any = None
    y: tuple[Any, Any] = (None, None)
    name: str = ""


@dataclass(frozen=True, kw_only=True)
class Panel:
    """One picture of a figure: its lines, points and boxes, and its axes.

    `y` and `x` label the axes, with a unit after "in". `y_limits` and `x_limits` are (low, high);
    left out, the axes follow what is drawn. `is_equal` draws both axes to one scale, `is_bare`
    draws none of them. `height` is in pixels. `words` stand at a place of the panel:
    (text, x, y). `y_ticks` and `x_ticks` are the steps between the numbers of an axis.

    >>> import sympy as sp
    >>> t = sp.Symbol("t")
    >>> Panel(lines=[Line(y=sp.sin(t))], y="acceleration a in m/s²").height
    108
    """

    lines: Sequence[Line] = ()
    points: Sequence[Point] = ()
    boxes: Sequence[Box] = ()
    words: Sequence[tuple[str, float, float]] = ()
    y: str = ""
    x: str | None = None
    y_limits: tuple[Any, Any] | None = None
    x_limits: tuple[Any, Any] | None = None
    y_ticks: float | None = None
    x_ticks: float | None = None
    is_equal: bool = False
    is_bare: bool = False
    height: float = 108
    title: str = ""

    def __post_init__(self) -> None:
        """Raise InputError for limits, ticks, heights and words that cannot be drawn."""
        for name in ("x_limits", "y_limits"):
            _check_ends(name, getattr(self, name))
        for name in ("x_ticks", "y_ticks", "height"):
            if getattr(self, name) is not None:
                size = Quantity(f"{name} of a panel", "", example=100)
                keep_numbers(self, **{name: partial(_short, size)})
        is_several = isinstance(self.words, Sequence) and not isinstance(self.words, str)
        for words in self.words if is_several else [self.words]:
            if not isinstance(words, tuple) or len(words) != 3:  # noqa: PLR2004
                raise InputError(f"The words {shorten(words)} have no place: give (text, x, y).")


@dataclass(frozen=True)
class Say:
    """A sentence with numbers in it: a text like `format` takes, and what its names stand for.

    `when` is a condition like `k > 1` or `sp.Eq(k, 1)`, or an expression, which has to be above 0.
    A number is formatted as Python does, by "g", ".4g" or ".3f"; a name may also stand for a text
    or for the symbol of a `choice`, and is the chosen name then. Where `when` does not hold, the
    `otherwise` is said instead, which is another Say.

    >>> Say("the peak is {peak:.3f} m/s²", {"peak": 4.154}).otherwise is None
    True
    """

    text: str
    numbers: Mapping[str, Any] = field(default_factory=dict)
    when: Any = None
    otherwise: "Say | None" = None


@dataclass(frozen=True)
class Button:
    """A button with a `text` that sets controls: each symbol to a number or an expression.

    Where one of them is no number (a search that has found nothing), the button changes nothing.

    >>> import sympy as sp
    >>> Button("twice the angle", {sp.Symbol("B_m"): 110}).text
    'twice the angle'
    """

    text: str
    sets: Mapping[sp.Symbol, Any]


def _check_colour(colour: Any) -> None:
    if colour is not None and not (isinstance(colour, int) and colour >= 0):
        raise InputError(f"The colour is {shorten(colour)}: count the colours from 0.")


def _short(quantity: Quantity, given: Any) -> float:
    """Return a number; a whole one that is no float stays short where it is stored."""
    number = quantity.number(given)
    return number if isinstance(given, float) or not number.is_integer() else int(number)


def _check_ends(name: str, ends: Any) -> None:
    if ends is not None and not (isinstance(ends, tuple | list) and len(ends) == 2):  # noqa: PLR2004
        raise InputError(f"The {name} is {shorten(ends)}: give two, for example (0, 1).")


class Choice(sp.Dummy):  # type: ignore[misc]
    """The symbol of a choice: its value is the number of the chosen name; made by `choice`."""

    options: tuple[str, ...]
    start: int  # the number of the name at which it stands first


@checked
def choice(name: str, options: Mapping[str, Any], *, start: str | None = None) -> Any:
    """Return an expression that is one of several, as the reader of a live figure chooses.

    `name` is said beside the choice; `options` maps what the reader chooses from to expressions,
    or each to a tuple of expressions, all as long: then a tuple of chosen expressions is returned.
    They are expressions like any other, to be differentiated and put into others. The choice stands
    at the name `start`, or at the first. Raises InputError where there is nothing to choose from,
    and for a start that is none of the names.

    >>> import sympy as sp
    >>> t = sp.Symbol("t")
    >>> chosen = choice("law", {"parabola": t**2, "sine": sp.sin(t)})
    >>> [piece.expr for piece in sp.diff(chosen, t).args]
    [2*t, cos(t)]
    """
    if not isinstance(options, Mapping) or not options:
        raise InputError(
            f"There is nothing to choose from in {shorten(options)}: give a mapping from names "
            "to expressions, for example {'parabola': t**2, 'sine': sp.sin(t)}."
        )
    symbol = Choice(name, integer=True, nonnegative=True)
    symbol.options = tuple(map(str, options))
    symbol.start = 0 if start is None else symbol.options.index(one_of("start", start, options))
    given = list(options.values())
    if not isinstance(given[0], tuple):
        return _chosen(symbol, given)
    if len({len(each) if isinstance(each, tuple) else 0 for each in given}) > 1:
        raise InputError(
            f"The options of the choice '{name}' are tuples of several lengths: let each have as "
            "many expressions as the first."
        )
    return tuple(_chosen(symbol, list(each)) for each in zip(*given, strict=True))


def _chosen(symbol: Choice, expressions: list[Any]) -> sp.Expr:
    *others, last = map(as_curve, expressions)
    pieces = [(expression, sp.Eq(symbol, number)) for number, expression in enumerate(others)]
    return sp.Piecewise(*pieces, (last, True), evaluate=False)


class Pinned(sp.Function):  # type: ignore[misc]
    """An expression as it is with the pinned settings; made by `pinned`."""

    nargs = 1


def pinned(expression: Any) -> sp.Expr:
    """Return what an expression is with the settings that the reader has pinned, as SymPy has it.

    >>> import sympy as sp
    >>> a = sp.Symbol("a")
    >>> (a / pinned(a)).has(Pinned)
    True
    """
    return Pinned(as_expression(expression))
