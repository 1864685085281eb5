"""The explorer of the follower, without a browser."""

import math
import re
from pathlib import Path

import node
import numpy as np
import pytest
from explored import at_corners, drawn, limits_of, lines_of, panel_of
from live_page import MOST_BYTES

import cammotion as cm
from cammotion.views.explorers.follower import n
from cammotion.views.live.figure import LiveFigure

LAWS = ("cycloidal", "simple harmonic", "constant acceleration")
X = np.linspace(0, 2.5, 301)
TRACED = """
const now = compile(given.description)(given.settings, given.settings);
return given.clocks.map((clock) => trace(given.line, now, clock));
"""


@pytest.fixture(scope="module")
def figure() -> LiveFigure:
    return cm.explore_follower()


def choose(figure: LiveFigure, law: str) -> None:
    (symbol,) = [symbol for symbol in figure.values if symbol is not n]
    figure.values = {symbol: LAWS.index(law)}


@pytest.mark.parametrize("law", LAWS)
def test_what_is_drawn_and_said(figure: LiveFigure, law: str) -> None:
    choose(figure, law)
    for settings in at_corners(figure, n):
        swings = settings[n]
        mass = cm.OneMass(law, swings)
        cam, *own = lines_of(figure, "acceleration")
        first, second = (line["over"] for line in own)  # which are one curve
        assert (first[0], first[1]) == (0, second[0])
        for line in own:
            assert drawn(figure, line["y"], X) == pytest.approx(mass(X, 2), abs=1e-9)
        inside = (X > 0.001) & (np.abs(X - 0.5) > 0.001) & (X < 0.999)
        assert drawn(figure, cam["y"], X[inside]) == pytest.approx(mass.law(X[inside], 2))
        assert not drawn(figure, cam["y"], X[X > 1]).any()
        first, after, _ = figure.text.splitlines()
        numbers = [float(number) for number in re.findall(r"[\d.]+", first)]
        assert first.startswith(law)
        assert numbers == pytest.approx([mass.law.Ca, mass.peak, mass.amplification], rel=6e-3)
        later = np.abs(mass(np.linspace(1, 1 + 1 / swings, 2001), 2)).max()
        assert float(after.split()[-1]) == pytest.approx(later, rel=6e-3)
        assert mass.peak < 20  # the axis


def test_the_picture_moves_with_the_clock(figure: LiveFigure) -> None:
    choose(figure, "cycloidal")
    figure.values = {n: 0.7}  # soft enough to be drawn as it is
    mass, picture = cm.OneMass("cycloidal", 0.7), panel_of(figure, "The cam moves")
    now = figure._now
    cam, own = ([now[point["x"]](at, at) for at in X] for point in picture["points"])
    assert cam == pytest.approx(cm.LAWS["cycloidal"](np.minimum(X, 1)))
    assert own == pytest.approx(0.85 + mass(X))
    rod, plate, spring, square = picture["lines"]
    for at in (0.0, 0.4, 1.7):
        ends = now[spring["x"]](np.array([0.0, 1.0]), at)
        assert ends[0] == now[plate["x"]](0.0, at) == now[rod["x"]](1.0, at)
        sides = now[square["x"]](np.linspace(0, 4, 41), at)
        assert [ends[1], ends[1] + 0.3] == pytest.approx([sides.min(), sides.max()])


def test_a_stiff_spring_is_drawn_larger_and_says_so(figure: LiveFigure) -> None:
    choose(figure, "cycloidal")
    figure.values = {n: 10}
    own = panel_of(figure, "The cam moves")["points"][1]["x"]
    mass, cam = cm.OneMass("cycloidal", 10)(0.3), cm.LAWS["cycloidal"](0.3)
    drawn_at = cam + 0.85 + (20 * math.pi) ** 2 / 60 * (mass - cam)
    assert figure._now[own](0.3, 0.3) == pytest.approx(drawn_at)
    assert figure.text.splitlines()[-1] == (
        f"(deflection of the spring drawn {(20 * math.pi) ** 2 / 60:.3g} times as large)"
    )


def test_own_laws_and_one_alone() -> None:
    """Where its mass is pushed harder than by the usual laws, the axis still holds that."""
    figure = cm.explore_follower(["MCV50"], start=3.2, damping_ratio=0.01)
    peak = cm.OneMass("MCV50", 3.2, 0.01).peak
    assert figure.text.startswith(f"MCV50: largest |A| of the cam 8.01, of the mass {peak:.3g}")
    assert 20 < peak < limits_of(figure, "acceleration")[1]
    sharp = cm.LAWS["cycloidal"].with_constant_velocity(0.95)  # crests one swing apart
    figure = cm.explore_follower([sharp], start=14.9, damping_ratio=0.005)
    peak = cm.OneMass(sharp, 14.9, 0.005).peak
    assert 130 < peak < 1.02 * limits_of(figure, "acceleration")[1]  # within the line's width
    with pytest.raises(cm.InputError, match="no motion law"):
        cm.explore_follower(["cycloid"])
    with pytest.raises(cm.InputError, match="the laws are"):
        cm.explore_follower([])


def test_its_page_is_small(figure: LiveFigure, tmp_path: Path) -> None:
    assert figure.save(tmp_path / "follower.html").stat().st_size <= MOST_BYTES


def test_the_spring_of_a_page_moves_with_its_clock(figure: LiveFigure) -> None:
    (_, _, spring, _) = panel_of(figure, "The cam moves")["lines"]
    given = {
        "description": figure.description,
        "line": spring,
        "settings": figure.settings,
        "clocks": [0.1, 0.7, 2.0],
    }
    page = node.run(TRACED, given)
    for clock, points in zip(given["clocks"], page, strict=True):
        x, y, _ = np.transpose(points)
        places = np.linspace(0, 1, len(points))
        assert x == pytest.approx(figure._now[spring["x"]](places, clock))
        assert y == pytest.approx(figure._now[spring["y"]](places, clock), abs=1e-12)
    assert page[0][0] != page[1][0] != page[2][0]


def test_what_is_left_after_the_move() -> None:
    figure = cm.explore_residual()
    symbols = [*figure.values]
    for number, law in enumerate(LAWS):
        for swings, damping in ((0.7, 0.005), (1, 0.005), (2.3, 0.1), (6.4, 0.3)):
            figure.values = dict(zip(symbols, (swings, damping, number), strict=True))
            mass = cm.OneMass(law, swings, damping)
            later = np.linspace(1, 1 + 1 / swings, 20001)
            left = np.abs(mass(later, 2)).max()
            share = cm.residual_vibration(law, swings, damping)
            found = re.findall(r"\d[\d.]*", figure.text.splitlines()[1])
            assert [*map(float, found)] == pytest.approx([left, 100 * share], rel=6e-3)
            over = figure.description["columns"][0][1]
            (line,), (now,) = over["lines"], over["points"]
            assert figure._now[now["x"]](0.0, 0.0) == pytest.approx(swings)
            assert figure._now[now["y"]](0.0, 0.0) == pytest.approx(left, rel=1e-6)
            at = 2.5 * (swings - 0.5) / 9.5
            assert figure._now[line["x"]](at, 0.0) == pytest.approx(swings)
            assert figure._now[line["y"]](at, 0.0) == pytest.approx(left, rel=1e-6)
