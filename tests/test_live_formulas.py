"""What a live figure computes in a page, in Node, against what it computes in Python."""

import math
import re
from collections.abc import Callable
from functools import cache
from typing import Any

import node
import numpy as np
import pytest
import sympy as sp
from explored import nyquist_figure, table_figure, weight_figure, zones_figure
from measured_cam import CAM, RATE

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.views.live.figure import LiveFigure

SETTINGS, SEARCHED, PLACES = 1000, 6, 4  # a search takes Python 100 times as long as a formula
EXACT = 1e-12
t, k, n, w = sp.symbols("t k n w", real=True)
PIECES = sp.Piecewise((0, t < k), (sp.sin(t - k), t < k + n), (n, True))
SEVERAL = [
    sp.Piecewise((t, (t > k) & (t < n) | (t > 3)), (-t, sp.Not(t > k / 2)), (0, True)),
    sp.Piecewise((t, t < n)),
    sp.Max(t, k, n) - sp.Min(t, k, sp.Rational(1, 3)) + sp.Abs(t - k) * sp.sign(t - n),
    sp.Heaviside(t - k) + sp.Mod(t - 3, k) + sp.floor(n * t) - sp.ceiling(-k * t) + sp.frac(t),
    sp.atan2(t - 1, k - 1) + sp.tan(t) + sp.asin(t / 5) + sp.acos(t / 5) + sp.atan(n * t),
    sp.sinh(t) + sp.cosh(k * t) - sp.tanh(n) + sp.asinh(t) + sp.acosh(t + 1) + sp.atanh(t / 5),
    sp.cot(t) + sp.sec(t) + sp.csc(t) + sp.acot(t) + sp.sinc(t) + sp.coth(t + k),
    sp.exp(-k * t) * sp.cos(n * t)
    + sp.log(t + k, 2)
    + 2**t
    + (t + 1) ** k
    + t ** sp.Rational(7, 3),
    sp.sqrt(t - k),
    sp.cbrt(t - n),
    (t - n) ** sp.Rational(2, 3),
    sp.EulerGamma * sp.GoldenRatio * sp.Catalan * sp.E**t + sp.pi * 10**30 / sp.Integer(7) ** 30,
    1 / (t - k),
]
CHOSEN = cm.choice("law", {"one": t**2, "two": sp.sin(k * t), "three": PIECES})
SEARCHES = [
    cm.largest(sp.sin(n * w) * w, (w, 0, 1 + t)),
    cm.place_of_largest(-((w - k) ** 2), (w, 0, 4)) + t,
    cm.inverse(w**3 + w, (w, 0, 4), n + t),
    cm.inverse(-w, (w, 0, 1), t),
    cm.largest(cm.inverse(w * sp.exp(w), (w, 0, 3), sp.Symbol("u")), (sp.Symbol("u"), 0, k)) + t,
]


def own_figure(curves: Any, **given: Any) -> LiveFigure:
    return cm.explore(curves, (t, 0, 4), {k: (0.5, 3), n: (1, 2)}, **given)


FIGURES: dict[str, Callable[[], LiveFigure]] = {
    "explore_move": lambda: cm.explore_move(
        cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000), laws=cm.LAWS
    ),
    "explore_move, laws that jump and hardly do not": lambda: cm.explore_move(
        cm.Move(
            stroke_mm=50,
            angle_deg=55,
            rate_per_hour=2000,
            law=cm.MotionLaw("line", cm.x),
        ),
        laws=[cm.fifth_degree_linear(0.99)],
    ),
    "explore_shares": lambda: cm.explore_shares(cm.EXAMPLE.diagram),
    "explore_scca": cm.explore_scca,
    "explore_cam": lambda: cm.explore_cam(cm.EXAMPLE.die),
    "explore_follower": cm.explore_follower,
    "explore_measured": lambda: cm.explore_measured(CAM, RATE, unit="in"),
    "explore_overlap": lambda: cm.explore_overlap(
        cm.EXAMPLE.diagram, cm.EXAMPLE.rule, contact_mm=20
    ),
    "explore_residual": cm.explore_residual,
    "explore_ways": lambda: cm.explore_ways(cm.EXAMPLE.diagram, cm.EXAMPLE.rule),
    "all functions": lambda: own_figure(SEVERAL, says=[]),
    "a choice": lambda: own_figure(
        [CHOSEN / (2 + cm.pinned(CHOSEN)), sp.diff(CHOSEN, t), k + cm.pinned(w * n)],
        values={w: k * n},
    ),
    "searches": lambda: own_figure(SEARCHES, says=[]),
    "the weight of notebook 06": weight_figure,
    "the table of notebook 08": table_figure,
    "the wave of notebook 09": nyquist_figure,
    "the zones of notebook 11": zones_figure,
}
COMPUTE = """
const make = compile(given.description);
return packed(given.cases.flatMap(([settings, pinned, places]) => {
  const formulas = make(settings, pinned);
  return given.numbers.flatMap((i) => places.map((x) => formulas[i](x, given.y)));
}));
"""
SAY = """
const make = compile(given.description), { controls, range } = given.description;
return given.cases.map(([settings, pinned]) => {
  const now = make(settings, pinned), [low, high] = range.map((i) => now[i]());
  return sentences(given.description, now, settings, low + 0.25 * (high - low)).join("\\n");
});
"""


@cache
def built(name: str) -> LiveFigure:
    return FIGURES[name]()


@pytest.fixture(params=FIGURES)
def figure(request: pytest.FixtureRequest) -> LiveFigure:
    return built(request.param)


def random_settings(figure: LiveFigure, rng: np.random.Generator) -> list[float]:
    """Return settings within the controls' ranges; every fifth number is an end of its range."""
    settings = []
    for control in figure.description["controls"]:
        low, high = control["low"], control["high"]
        value = rng.choice([low, high]) if rng.random() < 0.2 else rng.uniform(low, high)
        settings.append(float(round(value) if control["options"] else value))
    return settings


def random_cases(figure: LiveFigure, count: int, seed: int) -> list[Any]:
    """Return settings, other pinned ones, and places in the range and, at times, out of it."""
    rng = np.random.default_rng(seed)
    cases = []
    for _ in range(count):
        settings, pinned = random_settings(figure, rng), random_settings(figure, rng)
        with np.errstate(all="ignore"):
            now = figure._formulas.at(settings, pinned)
            low, high = (float(now[end]()) for end in figure.description["range"])
        places = [low, high, *rng.uniform(1.2 * low - 0.2 * high, high, PLACES - 2)]
        cases.append((settings, pinned, places))
    return cases


def searched(formulas: list[str]) -> list[bool]:
    """Return which formulas search, themselves or in one before them."""
    found: list[bool] = []
    for formula in formulas:
        calls = [found[int(number)] for number in re.findall(r"\bf(\d+)\(", formula)]
        found.append("largest(" in formula or "inverse(" in formula or any(calls))
    return found


def in_python(figure: LiveFigure, cases: list[Any], numbers: list[int], y: float) -> Floats:
    """Return the values as a notebook computes them: a case at a time, its places together."""
    values = np.empty((len(cases), len(numbers), PLACES))
    with np.errstate(all="ignore"):
        for case, (settings, pinned, places) in enumerate(cases):
            now = figure._formulas.at(settings, pinned)
            for at, number in enumerate(numbers):
                values[case, at] = now[number](np.array(places), y)
    return values


def together(figure: LiveFigure, cases: list[Any], numbers: list[int], y: float) -> Floats:
    """Return the values of all cases at once, each control a column; what searches cannot."""
    controls = np.array([(*settings, *pinned) for settings, pinned, _ in cases]).T[:, :, None]
    places = np.array([places for *_, places in cases])
    values = np.empty((len(cases), len(numbers), PLACES))
    now: list[Any] = []
    with np.errstate(all="ignore"):
        now.extend(figure._formulas._compiled(now, *controls))
        for at, number in enumerate(numbers):
            values[:, at] = now[number](places, y)
    return values


def assert_same(page: Floats, python: Floats, words: str) -> None:
    """Compare along the last axis, which is a curve at one setting.

    A curve may pass through zero, where its terms cancel and any last digit is off: so what is
    allowed is relative to the largest magnitude of the curve there.
    """
    finite = np.where(np.isfinite(python), np.abs(python), 0)
    allowed = EXACT * finite.max(axis=-1, keepdims=True)
    with np.errstate(invalid="ignore"):
        same = (page == python) | (np.abs(page - python) <= allowed)
    same |= np.isnan(page) & np.isnan(python)
    assert same.all(), f"{words}: {page[~same][:3]} in a page, {python[~same][:3]} in Python"


@pytest.fixture(autouse=True)
def at_a_quarter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the clock stand where a curve is neither at its start nor at its peak."""
    monkeypatch.setattr("cammotion.views.live.figure.CLOCK", 0.25)


def test_every_formula_in_a_page_and_in_python(figure: LiveFigure) -> None:
    formulas = figure.description["formulas"]
    is_search = searched(formulas)
    for wanted, count in ((False, SETTINGS), (True, SEARCHED)):
        numbers = [number for number, search in enumerate(is_search) if search is wanted]
        if not numbers:
            continue
        cases = random_cases(figure, count, seed=count)
        given = {"description": figure.description, "cases": cases, "numbers": numbers, "y": 0.3}
        page = node.unpacked(node.run(COMPUTE, given)).reshape(len(cases), len(numbers), PLACES)
        if wanted or any(searched(figure.description["quantities"])):
            python = in_python(figure, cases, numbers, y=0.3)
        else:
            python = together(figure, cases, numbers, y=0.3)
            few = cases[:SEARCHED]
            assert_same(python[: len(few)], in_python(figure, few, numbers, y=0.3), "at once")
        for at, number in enumerate(numbers):
            assert_same(page[:, at], python[:, at], formulas[number])


def test_sentences_in_a_page_and_in_python(figure: LiveFigure) -> None:
    cases = [case[:2] for case in random_cases(figure, 12, seed=7)]
    page = node.run(SAY, {"description": figure.description, "cases": cases})
    for (settings, pinned), said in zip(cases, page, strict=True):
        figure.settings, figure.pinned = settings, pinned
        assert figure.text == said


@pytest.mark.parametrize("name", ["explore_move", "explore_scca", "all functions", "a choice"])
def test_formulas_in_a_page_against_sympy_with_30_digits(name: str) -> None:
    figure = built(name)
    known = {
        number: expression
        for expression, number in figure._formulas._known.items()
        if not expression.atoms(sp.Lambda) and expression.free_symbols
    }
    cases = random_cases(figure, 12, seed=30)
    given = {"description": figure.description, "cases": cases, "numbers": [*known], "y": 0.3}
    page = node.unpacked(node.run(COMPUTE, given)).reshape(len(cases), len(known), PLACES)
    rng = np.random.default_rng(31)
    for case, at in zip(
        rng.integers(len(cases), size=40), rng.integers(len(known), size=40), strict=True
    ):
        settings, pinned, places = cases[case]
        expression = [*known.values()][at]
        inside = slice(2, None)  # at an end of the range there may be a pole
        exact = [exactly(figure, expression, settings, pinned, x) for x in places[inside]]
        assert_same(page[case, at, inside], np.array(exact), str(expression))


def exactly(
    figure: LiveFigure, expression: sp.Expr, settings: list[float], pinned: list[float], x: float
) -> float:
    """Return an expression as SymPy itself works it out."""
    names = {f"c{i}": value for i, value in enumerate(settings)}
    names |= {f"p{i}": value for i, value in enumerate(pinned)} | {"x": x, "y": 0.3}
    q = {"c": settings, "p": pinned}
    values: dict[sp.Symbol, Any] = {}
    for symbol, short in figure._formulas.names.items():
        if short in names:
            values[symbol] = as_digits(names[short])
    for symbol, of in followed(figure, q).items():
        values[symbol] = as_digits(of)
    try:
        number = expression.xreplace(values)
        number = number.evalf(30) if isinstance(number, sp.Expr) else sp.Integer(bool(number))
    except ValueError:  # it would compare what is not real
        return math.nan
    if number in (sp.oo, -sp.oo):
        return math.inf if number == sp.oo else -math.inf
    return float(number) if number.is_real else math.nan


def followed(figure: LiveFigure, settings: dict[str, list[float]]) -> dict[sp.Symbol, float]:
    """Return t_m and w, the only values that these figures let follow."""
    found = {}
    for symbol, short in figure._formulas.names.items():
        if short[0] == "q":
            is_own = symbol in (sp.Symbol("t_m"), w)
            one, other = settings["c" if is_own else "p"][:2]
            found[symbol] = 10 * other / one if symbol.name == "t_m" else one * other
    return found


def as_digits(value: float) -> sp.Float:
    return sp.Float(value, 40)


def test_searches_find_what_is_known() -> None:
    figure = own_figure(SEARCHES[1:4], says=[])
    numbers = [figure.description["columns"][0][i]["lines"][0]["y"] for i in range(3)]
    case = [[1.75, 1.5], [1.75, 1.5], [0.5] * PLACES]
    given = {"description": figure.description, "cases": [case], "numbers": numbers, "y": 0}
    place, cubic, outside = node.unpacked(node.run(COMPUTE, given))[::PLACES]
    assert place == pytest.approx(1.75 + 0.5, abs=1e-7)
    assert cubic == pytest.approx(1, rel=1e-15)
    assert math.isnan(outside)
