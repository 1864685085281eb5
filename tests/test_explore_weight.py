"""The live figure of notebook 06: its areas against sums over fine cells, and what it draws."""

import re

import node
import numpy as np
import pytest
import sympy as sp
from explored import drawn, weight_figure

import cammotion as cm
from cammotion.views.live.figure import LiveFigure

PATHS = """
const [points, isArea] = given, itself = (value) => value;
const panel = { view: { X: itself, Y: itself, top: -9, bottom: 9 } };
return Panel.prototype.pathOf.call(panel, points, isArea);
"""
CELLS = 200_000
X = (np.arange(CELLS) + 0.5) / CELLS
LAWS = {
    "cycloidal": 2 * np.pi * np.sin(2 * np.pi * X),
    "modified trapezoid": cm.scca(0.25, 0.5, 0.25)(X, derivative=2),
    "constant acceleration": np.where(X < 0.5, 4.0, -4.0),
    "one that brakes late": 24 * X - 36 * X**2,
}


@pytest.fixture(scope="module")
def figure() -> LiveFigure:
    return weight_figure()


def set_to(figure: LiveFigure, law: int, share: float) -> list[float]:
    """Set law and share; return all numbers of the sentences."""
    by_name = {symbol.name: symbol for symbol in figure.values}
    figure.values = {by_name["k"]: share, by_name["law"]: law}
    return [float(number) for number in re.findall(r"\d+\.?\d*", figure.text)]


@pytest.mark.parametrize("share", [0, 0.35, 0.5, 0.65, 1])
@pytest.mark.parametrize("law", range(len(LAWS)))
def test_the_areas_are_sums(figure: LiveFigure, law: int, share: float) -> None:
    *_, total, of_weight, most = set_to(figure, law, share)
    (name,) = figure.chosen.values()
    a = LAWS[name]
    product, weight = (1 - share - X) * a, np.abs(1 - share - X)
    assert total == 1 == pytest.approx(product.mean(), abs=1e-8)
    assert of_weight == pytest.approx(weight.mean(), abs=1e-4)
    assert most == pytest.approx(np.abs(a).max() * weight.mean(), rel=1e-3)
    assert most >= 1


def test_only_one_setting_reaches_the_bound(figure: LiveFigure) -> None:
    found = {
        (law, share)
        for law in range(len(LAWS))
        for share in (0.45, 0.5, 0.55)
        if set_to(figure, law, share)[-1] == 1
    }
    assert found == {([*LAWS].index("constant acceleration"), 0.5)}


def test_what_is_drawn_lies_within_the_panels(figure: LiveFigure) -> None:
    (panels,) = figure.description["columns"]
    for law in range(len(LAWS)):
        for share in (0.0, 0.35, 1.0):
            set_to(figure, law, share)
            weight, a = 1 - share - X, list(LAWS.values())[law]
            curves = a, weight, weight * a, np.cumsum(weight * a) / CELLS
            for panel, wanted in zip(panels, curves, strict=True):
                low, high = (float(figure._now[end]()) for end in panel["y_limits"])
                heights = drawn(figure, panel["lines"][0]["y"], X)
                assert np.abs(heights - wanted).max() <= 1e-4  # approx takes a minute for these
                assert low <= heights.min() <= heights.max() <= high


def test_an_area_is_shaded_between_its_curve_and_zero() -> None:
    t = sp.Symbol("t")
    shade = cm.Line(y=sp.cos(t), role="area", colour=0)
    figure = cm.explore(cm.Panel(lines=[cm.Line(y=sp.cos(t)), shade]), (t, 0, 2))
    bare = cm.explore(cm.Panel(lines=[cm.Line(y=sp.cos(t))]), (t, 0, 2))
    assert figure.picture() != bare.picture()
    paths = node.run(PATHS, [[[0, 1], [1, 2], [2, -1]], True])
    assert paths == "M0.0 0.0L0.0 1.0L1.0 2.0L2.0 -1.0L2.0 0.0"
    assert node.run(PATHS, [[[0, 1], [1, 2]], False]) == "M0.0 1.0L1.0 2.0"
