"""What `explore` refuses, in words that help, and what it draws though it is not nice."""

import functools
import math
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy as sp
from sympy.physics.units import meter

import cammotion as cm
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.usual import quantity_of

t, k, b, c = sp.symbols("t k b c")
SPAN = (t, 0, 1)
ONE = {k: (0, 1)}
PAIR = {b: (0, 1), c: (0, 1)}
ALONE: Any = (1,)
PLACELESS: Any = [("there", 1)]
LAW = cm.LAWS["cycloidal"]
ENDLESS = functools.reduce(lambda inner, _: sp.sin(inner, evaluate=False), range(250), t + k)


def explore(curves: Any, over: Any = SPAN, *given: Any, **more: Any) -> LiveFigure:
    return cm.explore(curves, over, *given, **more)


def pad(x: Any, y: Any, *drags: Any) -> LiveFigure:
    point = cm.Point(x=x, y=y, drags=drags or (b, c))
    return explore(cm.Panel(lines=[cm.Line(y=t)], points=[point]), SPAN, PAIR)


def says(text: str, **numbers: Any) -> LiveFigure:
    return explore(t, says=[cm.Say(text, numbers)])


SYMBOLS: list[tuple[Callable[[], object], str]] = [
    (lambda: explore(k * t), r"k\*t contains k, .* add it to the controls, \{k: \(low, high\)\}"),
    (lambda: explore(b * t, SPAN, ONE), "contains b, which is neither the variable nor a control"),
    (
        lambda: explore(sp.Symbol("k", positive=True) * t, SPAN, ONE),
        "There are two symbols k, .* use",
    ),
    (lambda: explore(sp.Symbol("t", real=True), SPAN), "There are two symbols t, .* assumptions"),
    (lambda: explore(t, t), "A figure needs t_m, .* controls"),
    (lambda: explore(k, k, {b: (0, 1)}), r"not known from where to where k runs: .* \(k, 0, 1\)"),
    (
        lambda: explore(k * t, (k, 0, 1), ONE | {t: (0, 1)}),
        "k is the running variable, and a control",
    ),
    (lambda: explore(t, SPAN, values={t: 1}), "t is the running variable, and a control or value"),
    (
        lambda: explore(t * k, SPAN, values={k: t + 1}),
        r"The value of k is t \+ 1, in which t runs: put",
    ),
    (
        lambda: explore(t * b, values={b: c, c: b}),
        "values of b, c follow from one another in a circle",
    ),
    (
        lambda: explore(t * b, values={b: b + 1}),
        "values of b follow .* circle: give one .* a number",
    ),
    (
        lambda: explore(t, SPAN, {"k": (0, 1)}),
        "given for 'k', which is no symbol: use .* sp.Symbol",
    ),
    (lambda: explore(t, SPAN, "k"), "controls are 'k': give a mapping"),
    (lambda: explore(t, SPAN, [k]), r"controls are \[k\]: give a mapping"),
    (lambda: explore(t, values=[k]), r"values are \[k\]: give a mapping"),
    (lambda: explore(t, values={"k": 1}), "values are given for 'k', which is no symbol"),
]
FUNCTIONS: list[tuple[Callable[[], object], str]] = [
    *(
        (
            functools.partial(explore, function),
            f"cannot compute {name}, which is in .*: write it by",
        )
        for name, function in {
            "erf": sp.erf(t),
            "gamma": sp.gamma(t + 1),
            "besselj": sp.besselj(0, t),
            "factorial": sp.factorial(t),
            "LambertW": sp.LambertW(t),
            "f": sp.Function("f")(t),
            "Order": sp.sin(t).series(t, 0, 4),
        }.items()
    ),
    *(
        (functools.partial(explore, undone), r"is not worked out, .* call .doit\(\)")
        for undone in (
            sp.Derivative(sp.sin(t), t),
            sp.Integral(sp.sin(t) / t, (t, 0, 1)),
            1 + sp.Integral(sp.exp(-(b**2)), (b, 0, t)),
            sp.Sum(t**k, (k, 0, 3)),
            sp.Subs(sp.Derivative(sp.Function("f")(t), t), t, 0),
        )
    ),
    (lambda: explore(sp.I * t), r"I\*t is not real: .* take its real part"),
    (lambda: explore(sp.zoo + t), "is not real"),
    (
        lambda: explore(sp.sqrt(-1 - t**2)),
        "nothing to draw in 'sqrt.* no real value anywhere.* Look for",
    ),
    (lambda: explore(sp.log(k - 5), SPAN, ONE), "no real value anywhere in the range with k = 0.5"),
    (lambda: explore(sp.nan), "no real value anywhere"),
    (lambda: explore(t * meter), "cannot compute meter, which is in .* write a number"),
    (lambda: explore(sp.IndexedBase("A")[0] * t), "contains A"),
    (lambda: explore(10**400), "more than 300 digits, .* choose larger units"),
    (lambda: explore(t / 10**400), "more than 300 digits"),
    (lambda: explore(ENDLESS, SPAN, ONE), "nested too deeply: simplify"),
]
CURVES: list[tuple[Callable[[], object], str]] = [
    *(
        (
            functools.partial(explore, text, *given),
            "cannot draw .*: give an expression of SymPy",
        )
        for text, *given in [("sin(t)",), ("cycloidal", (cm.x, 0, 1)), ("__import__('os')",)]
    ),
    (lambda: explore({"a curve": "sin(t)"}), r"cannot draw 'sin\(t\)'"),
    (lambda: explore(t * k, values={k: "1"}), "cannot draw '1'"),
    (lambda: cm.largest("t**2", SPAN), "cannot draw"),
    (lambda: cm.inverse(t, SPAN, "t"), "cannot draw 't'"),
    (lambda: cm.largest(t, (t, "0", 1)), "cannot draw '0'"),
    (lambda: cm.pinned("k"), "cannot draw 'k'"),
    (lambda: cm.choice("law", {"a": "t**2"}), "cannot draw"),
    (lambda: cm.largest(t, t), r"span of a search is t: give \(symbol, low, high\)"),
    (lambda: cm.choice("law", {}), r"nothing to choose from in \{\}: give a mapping"),
    (lambda: cm.choice("law", {"a": (t, t), "b": (t,)}), "tuples of several lengths"),
    (lambda: cm.choice("law", {"a": LAW}), "is a law and no expression: take its s"),
    (lambda: explore(LAW, (cm.x, 0, 1)), r"MotionLaw\('cycloidal'\) is a law .* like law.s"),
    (lambda: explore([]), "nothing to draw: give an expression"),
    (lambda: explore({}), "nothing to draw: give an expression"),
    (lambda: explore([[t], []]), "nothing to draw in one of the columns: leave it out"),
    (lambda: explore(None), "cannot draw None"),
    (lambda: explore(np.sin), "cannot draw <ufunc 'sin'>"),
    (lambda: explore(sp.sin), "cannot draw sin"),
    (lambda: explore(np.array([1, 2])), r"cannot draw array\(\[1, 2\]\)"),
    (lambda: explore(t < sp.Rational(1, 2)), "is a condition and no curve: draw sp.Piecewise"),
    (lambda: explore(t, "t"), r"running variable is 't': give a symbol, .* \(t, 0, 1\)"),
    (lambda: explore(t, None), "running variable is None: give"),
    (lambda: explore(t, (t, "0", "1")), "cannot draw '0'"),
    (
        lambda: explore(t, (t, 1, 0)),
        "variable goes from 1 to 0, which is no range: give two finite",
    ),
    (lambda: explore(t, (t, k, 0), ONE), "variable goes from 0.5 to 0, which is no range"),
    (lambda: explore(t, (t, 0, math.nan)), "goes from 0 to nan, which is no range"),
    (lambda: explore(t, (t, 0, sp.oo)), "goes from 0 to inf, which is no range"),
    (lambda: explore(t, (t, 0, sp.I)), "I is not real"),
    (lambda: explore(t, (t, 0, t)), "runs from 0 to t, which contain t itself"),
]
RANGES: list[tuple[Callable[[], object], str]] = [
    *(
        (functools.partial(explore, k * t, SPAN, {k: ends}), f"control k.* {said}")
        for ends, said in [
            ((1, 1), "goes from 1 to 1: .* lower end first"),
            ((2, 1), "goes from 2 to 1: .* lower end first"),
            ((0, math.nan), r"has nan as a number of its range: give numbers up to 1e\+100"),
            ((0, math.inf), "has inf as a number"),
            ((0, sp.oo), "has oo as a number"),
            ((-1e308, 1e308), r"has -1e\+308 as a number"),
            ((0, 1j), "has 1j as a number"),
            (("0", "1"), "has '0' as a number"),
            ((0, 1, "a"), "has 'a' as a number"),
            ((0, 1, 0), "is 0: give one above 0 .* at most 1"),
            ((0, 1, 2), "is 2: give one above 0 .* at most 1"),
            ((0, 1, -1), "is -1"),
            (5, r"has 5 as its range: give \(low, high\)"),
            ("0 to 1", "has '0 to 1' as its range"),
        ]
    ),
    (lambda: explore(k * t, SPAN, ONE, values={k: 3}), "k starts at 3, outside .* widen the range"),
    (lambda: explore(k * t, SPAN, ONE, values={k: b}), "control k has b as a number"),
    (
        lambda: explore(k * t, SPAN, {k: cm.Control(low=0, high=1, start=-1)}),
        "starts at -1, outside",
    ),
    (
        lambda: explore(t, SPAN, {sp.Symbol(f"k{i}"): (0, 1) for i in range(300)}),
        "300 controls, .* 12",
    ),
]
PARTS: list[tuple[Callable[[], object], str]] = [
    (lambda: says("{a}"), r"has \{a\}, which is not given: add it"),
    (lambda: says("{}", a=t), r"has \{\}, which is not given"),
    (lambda: says("{a.real}", a=t), r"has \{a.real\}, which is not given"),
    (lambda: says("{a", a=t), "cannot be read: close each {"),
    *(
        (
            functools.partial(says, f"{{a{spec}}}", a=t),
            "is not known here: a number is written as {name",
        )
        for spec in [":d", ":.f", ":%", ":.999f", ":f", ":.\u0663f", ":{b}", "!r", ":s"]
    ),
    (lambda: explore(t, says=["hello"]), r"'hello' is none of a figure's sentences: write \[Say"),
    (
        lambda: explore(t, buttons=["press"]),
        r"'press' is none of a figure's buttons: write \[Button",
    ),
    (
        lambda: explore(t, buttons=[cm.Button("on", {k: 1})]),
        "k is no control of this figure: add it",
    ),
    (lambda: explore(t, clock="t"), "clock is 't': give the symbol"),
    (lambda: explore(t, clock=k), "k is no control of this figure: add it"),
    (lambda: explore(t, seconds=0), "clock to run once is 0"),
    (lambda: explore([[t], [t]], shares=(1,)), "shares of the width are .* 2 here"),
    (lambda: explore([[t], [t]], shares=(1, -1)), "share of a column in the width is -1"),
    (lambda: pad(b, k, b, k), "k is no control of this figure"),
    (lambda: pad(b**2, c), r"point at b\*\*2, c cannot be moved: its x and y have to follow"),
    (lambda: pad(sp.sin(b), c), "cannot be moved"),
    (lambda: pad(b * c, c), "cannot be moved"),
    (lambda: pad(b + c, b + c), "cannot be moved"),
    (lambda: pad(1, 2), "cannot be moved"),
    (lambda: pad(b, c, b), "pair of controls that a point drags is .* give two"),
    (lambda: cm.Line(y=t, role="bold"), "role of a line is 'bold': give one of own, reference"),
    (lambda: cm.Line(y=t, colour=-1), "colour is -1: count the colours from 0"),
    (lambda: cm.Line(y=t, over=ALONE), "span of a line is .* give two"),
    (lambda: cm.Panel(y_limits=ALONE), "y_limits is .* give two"),
    (lambda: cm.Panel(y_ticks=0), "y_ticks of a panel is 0"),
    (lambda: cm.Panel(height=0), "height of a panel is 0"),
    (
        lambda: cm.Panel(words=PLACELESS),
        r"words \('there', 1\) have no place: give \(text, x, y\)",
    ),
]
HANDS: list[tuple[Callable[[LiveFigure], object], str]] = [
    (lambda figure: setattr(figure, "values", {"k": 0.5}), "'k' is no control .* symbols k"),
    (lambda figure: setattr(figure, "values", {k: 5}), "value of k is 5: it goes from 0 to 1"),
    (lambda figure: setattr(figure, "values", {k: math.nan}), "value of k is nan: it goes"),
    (lambda figure: setattr(figure, "values", {k: "half"}), "value of k is 'half': it goes"),
    (lambda figure: setattr(figure, "values", [1]), r"values are \[1\]: give a mapping"),
    (lambda figure: figure.press("twice"), "no button 'twice': it has none"),
]


alpha = sp.Symbol("alpha")
AS_A_STUDENT_WOULD: list[tuple[Callable[[], object], str]] = [
    (
        lambda: cm.explore(sp.sin(alpha), alpha),
        r"alpha is in deg, and sin\(alpha\) takes it for rad: write sin\(pi\*alpha/180\)",
    ),
    (
        lambda: explore(
            k * t, SPAN, {k: cm.Control(low=0, high=9)}, says=[cm.Say("", when=k == 1)]
        ),
        r"The condition of a sentence is False already: .*sp\.Eq\(k, 1\)",
    ),
    (
        lambda: explore(
            cm.choice("law", {"a": t})
            + cm.choice("law", {"b": t, "c": 1})
            + cm.choice("law", {"b": t, "c": 1})
        ),
        "There are several choices of one name among law, law: make one choice",
    ),
    (lambda: explore(cm.Panel(y=sp.sin(t))), r"The label of a panel's heights is sin\(t\): give a"),
]


@pytest.mark.parametrize(
    ("made", "said"), [*SYMBOLS, *FUNCTIONS, *CURVES, *RANGES, *PARTS, *AS_A_STUDENT_WOULD]
)
def test_what_is_refused_is_refused_in_words(made: Callable[[], object], said: str) -> None:
    with pytest.raises(cm.InputError, match=said) as refused:
        made()
    assert_is_a_sentence(str(refused.value))


@pytest.mark.parametrize(("done", "said"), HANDS)
def test_what_a_figure_is_not_set_to(done: Callable[[LiveFigure], object], said: str) -> None:
    figure = explore(k * t, SPAN, ONE)
    with pytest.raises(cm.InputError, match=said) as refused:
        done(figure)
    assert_is_a_sentence(str(refused.value))
    assert figure.values == {k: 0.5}


HALVES = [Decimal("0.5"), Fraction(1, 2), np.float32(0.5), np.float16(0.5), np.array(0.5)]


@pytest.mark.parametrize("half", HALVES, ids=lambda half: type(half).__name__)
def test_a_number_of_any_kind_is_drawn_as_it_is(half: Any) -> None:
    def made(it: Any) -> dict[str, Any]:
        return explore(b * t * k, (t, 0, it), {k: (it, 1)}, values={b: it}).description

    assert made(half) == made(0.5)


@pytest.mark.parametrize("three", [np.int8(3), np.array(3)])
def test_a_whole_number_stays_one(three: Any) -> None:
    assert (
        explore(t * k, values={k: three}).description == explore(t * k, values={k: 3}).description
    )


def assert_is_a_sentence(words: str) -> None:
    assert ":" in words  # what is wrong, and how to mend it
    assert words.endswith(".")
    assert "<class" not in words
    assert len(words) < 300


def test_a_choice_is_set_to_the_number_of_a_name() -> None:
    """Between two of them the figure would show another curve than it says."""
    figure = cm.explore(cm.choice("law", {"one": t, "two": 2 * t, "three": 3 * t}), (t, 0, 1))
    (symbol,) = figure.values
    figure.values = {symbol: 2}
    wrong: list[Any] = [1.5, 3, "two"]
    for value in wrong:
        with pytest.raises(cm.InputError, match=r"give the number of a name, 0 \(one\), 1 \(two\)"):
            figure.values = {symbol: value}
    assert figure.chosen == {"law": "three"}


def test_a_control_of_the_notation_stands_at_the_lesson_s_machine() -> None:
    t, t_m, h_m, B_m, N = sp.symbols("t t_m h_m B_m N", positive=True)  # noqa: N806
    ranges = {h_m: (0.01, 0.2), t_m: (0.1, 1), B_m: (10, 100), N: (100, 5000)}
    figure = cm.explore(h_m * t / t_m * B_m * N, (t, 0, 1), ranges)
    assert figure.values == {h_m: 0.05, t_m: 0.275, B_m: 55, N: 2000}


def test_braces_in_a_name_are_said_as_they_are() -> None:
    """SymPy's own names have them, like a_{max}."""
    place, speed = sp.symbols("u_{1} v_{q}")
    figure = explore({"a_{max}": speed * place}, (place, 0, 1), ONE, values={speed: 2 * k + 1})
    assert [line.rstrip() for line in figure.text.splitlines()] == [
        "v{q} = 2",
        "at u_{1} = 0: a_{max} = 0",
        "largest: |a_{max}| = 2",
    ]


def test_a_power_that_is_not_whole_is_no_quantity() -> None:
    h, time = sp.symbols("h_m t_m", positive=True)
    assert quantity_of(h / time**2) == "a"
    assert quantity_of(h ** sp.Rational(3, 2) / time**2) is None
