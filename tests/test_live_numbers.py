"""The numbers, axes and curves of a live figure's page, in Node: against Python and known ones."""

import math
from typing import Any

import node
import numpy as np
import pytest
import sympy as sp
from matplotlib.axes import Axes

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.views.live import picture
from cammotion.views.live.figure import LiveFigure

EXACT = 1e-12
t, k, n = sp.symbols("t k n", real=True)


def test_format_is_that_of_python() -> None:
    rng = np.random.default_rng(5)
    values = [*(rng.uniform(-1, 1, 14_000) * 10 ** rng.uniform(-30, 30, 14_000))]
    values += [*rng.uniform(-2000, 2000, 3000)]
    values += [*(rng.integers(-(10**6), 10**6, 3000) / 2 ** rng.integers(0, 12, 3000))]  # halves
    values += [0.5, 1.5, 2.5, -2.5, -0.5, 0.125, 0.375, 1e22, 1e21, -1.5e21, 9.9995, 123456.5]
    values += [123455.5, 1.25e10, -1.35e10, 2**-14, 3 * 2**-20, 9.5, 8.5, 99.5, 98.5, 0.0, -0.0]
    values += [-0.0004, 1e-4, 1e-5, 99999.5, 999999.5, 5e-324, 1.7e308]
    specs = [f".{digits}f" for digits in range(7)] + [f".{digits}g" for digits in range(1, 13)]
    script = "return given.values.map((v) => given.specs.map((s) => format(v, s)).join(' '));"
    page = node.run(script, {"values": values, "specs": [*specs, "g"]})
    for value, written in zip(values, page, strict=True):
        python = " ".join(format(value, f"z{spec}") for spec in [*specs, "g"])  # no -0
        assert written == python.replace("-", "−"), value


def test_format_of_what_is_no_number() -> None:
    page = node.run("return given.map((v) => format(Number(v), '.3f'))", ["NaN", "1e999", "-1e999"])
    assert page == ["–", "∞", "−∞"]


def test_what_a_typed_number_may_be() -> None:
    texts = {
        "55,5": [55.5],
        "55.5": [55.5],
        " 1e3 ": [1000],
        "−3": [-3],
        "-3": [-3],
        "+.5": [0.5],
        "1e-3": [1e-3],
        "4,154": [4.154, 4154],
        "-12,500": [-12.5, -12500],
        "0,154": [0.154],
        "2.400": [2.4],
        "1234,500": [1234.5],
        "4,1540": [4.154],
    }
    assert node.run("return given.map(readings)", [*texts]) == [*texts.values()]
    refused = ["abc", "", " ", "1,2,3", "1,234.5", "0x10", "1e", "1 2", "Infinity", "--3", "5 deg"]
    assert node.run("return given.map(readings)", refused) == [[]] * len(refused)


def test_settings_give_way_as_in_python() -> None:
    rng = np.random.default_rng(9)
    figure = cm.explore_scca()
    b, c = figure.values
    cases = []
    for _ in range(300):
        start = [float(each) for each in rng.dirichlet([1, 1, 1])[:2]]
        changes = {int(i): float(rng.random()) for i in rng.permutation(2)[: rng.integers(1, 3)]}
        cases.append((start, changes))
    cases += [([0.4, 0.4], {0: -5}), ([0.4, 0.4], {1: 5}), ([0.4, 0.4], {0: 0.6, 1: 1})]
    script = """
    const make = compile(given.description);
    return given.cases.map(([settings, changes]) =>
      change(given.description, make, settings, changes)
    );
    """
    page = node.run(script, {"description": figure.description, "cases": cases})
    for (start, changes), settings in zip(cases, page, strict=True):
        figure.settings = start
        figure._change(changes)
        assert figure.settings == settings
        assert sum(settings) <= 1 + EXACT
        if len(changes) == 1 and 0 <= next(iter(changes.values())) <= 1:
            ((number, value),) = changes.items()
            assert settings[number] == value  # who is moved does not give way
    figure.settings = [0.5, 0.5]
    figure.values = {b: 0.75}
    assert figure.values == {b: 0.75, c: 0.25}


def test_a_limit_that_is_no_number_changes_nothing() -> None:
    bound = cm.Control(low=0, high=2, start=1, most=sp.sqrt(n - 1))
    figure = cm.explore(t * k + n, (t, 0, 1), {k: bound, n: (0, 2)})
    script = "return change(given, compile(given), [1, 2], { 1: 0.5 })"
    assert node.run(script, figure.description) == [1, 0.5]
    figure.settings = [1, 2]
    figure.values = {n: 0.5}
    assert figure.settings == [1, 0.5]


def test_limits_of_an_axis() -> None:
    pole = [1 / (i / 200 - 0.501) for i in range(201)]
    cases: list[list[float]] = [
        pole,
        [5, 5, 5],
        [7],
        [],
        [1e15, 3e15],
        [-4, -3],
        [-9, -1],
        [1e-9, 2e-9],
        [0],
        [-0.2],
    ]
    cases += [[1e299, -1e299], [1e308, -1e308], [0, 5e-324], [5, 5 + 1e-12], [9.7, 10.1], [-3, 11]]
    for values, (low, high, step) in zip(
        cases, np.array(node.run("return given.map(limits)", cases), dtype=float), strict=True
    ):
        assert low < high, values
        assert 2 <= round((high - low) / step) <= 8, values
        for end in (low, high):
            assert end / step == pytest.approx(round(end / step), abs=1e-6), values
        if values is not pole and max(map(abs, values), default=0) < 1e300:
            slack = 1e-9 * (high - low)
            assert all(low - slack <= value <= high + slack for value in values), values
    low, high, _ = node.run("return limits(given)", pole)
    assert -150 < low < 0 < high < 150  # the pole is not what the axis is made for
    assert node.run("return [limits([NaN, Infinity, 2, 3]), limits([2, 3])]") == [[2, 3, 0.25]] * 2


TRACE = """
const [{ lines: [line] }] = given.description.columns[0];
const now = compile(given.description)(given.settings, given.settings);
return trace(line, now).map(([x, y]) => [x, y]);
"""


def traced(figure: LiveFigure) -> Floats:
    given = {"description": figure.description, "settings": figure.settings}
    return np.array(node.run(TRACE, given), dtype=float)


def test_joints_are_drawn_from_both_sides() -> None:
    jump = sp.Piecewise((0, t < k), (1, True))
    points = traced(cm.explore(jump, (t, 0, 4), {k: (0, 4)}, values={k: math.pi}))
    (at,) = np.flatnonzero(np.diff(points[:, 1]))
    assert points[at] == pytest.approx([math.pi, 0], abs=1e-8)
    assert points[at + 1] == pytest.approx([math.pi, 1], abs=1e-8)
    assert points[at, 0] < math.pi < points[at + 1, 0]


def test_the_ends_of_what_is_real_are_found_by_halving() -> None:
    curve = sp.sqrt(t - 1) + sp.sqrt(sp.pi - t)
    points = traced(cm.explore(curve, (t, 0, 4)))
    real = points[np.isfinite(points[:, 0])]
    assert real[0, 0] == pytest.approx(1, abs=1e-9)
    assert real[-1, 0] == pytest.approx(math.pi, abs=1e-9)
    assert (np.diff(real[:, 0]) >= 0).all()


def test_a_line_is_only_where_its_condition_holds() -> None:
    line = cm.Line(y=t, only_where=sp.cos(t))
    points = traced(cm.explore(line, (t, 0, 6)))
    (gap,) = np.flatnonzero(np.isnan(points[:, 0]).astype(int)[1:] > 0)[:1] + 1
    assert points[gap - 1, 0] == pytest.approx(math.pi / 2, abs=1e-9)
    assert np.nanmax(points[:, 0]) == 6
    assert not ((points[:, 0] > math.pi / 2 + 1e-8) & (points[:, 0] < 1.5 * math.pi - 1e-8)).any()


def test_without_node_it_is_said_that_nothing_is_tested(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", "")
    monkeypatch.delenv("REQUIRE_BROWSER", raising=False)
    with pytest.raises(pytest.skip.Exception, match=r"NOT TESTED: .* node is not on the PATH"):
        node.run("return 1")
    monkeypatch.setenv("REQUIRE_BROWSER", "1")
    with pytest.raises(pytest.fail.Exception, match=r"NOT TESTED: .* node is not on the PATH"):
        node.run("return 1")


POWERS: dict[str, dict[tuple[float, ...], tuple[int, str]]] = {
    "way in mm": {
        (0, 0.0002, 0.0004): (-4, "way in 10⁻⁴ mm"),
        (-0.015, 0, 0.015): (-2, "way in 10⁻² mm"),
        (0, 200_000): (5, "way in 10⁵ mm"),
        (0, 2000, 8000): (0, "way in mm"),
        (-4000, -2000, 0): (3, "way in 10³ mm"),
        (-0.05, 0, 0.05): (0, "way in mm"),
        (0, 1.5e-12): (-12, "way in 10⁻¹² mm"),
        (0, 1e-06, 2e-06): (-6, "way in 10⁻⁶ mm"),
        (): (0, "way in mm"),
    },
    "arm in front: way in mm": {(0, 0.0002): (-4, "arm in front: way in 10⁻⁴ mm")},
    "roller over radius": {(0, 0.0002): (0, "roller over radius")},
    "difference in 0.001 in": {(0, 0.0002): (0, "difference in 0.001 in")},
}


@pytest.mark.parametrize("label", POWERS)
def test_numbers_that_have_no_room_at_an_axis_get_a_power_of_ten(label: str) -> None:
    script = """return given.axes.map((numbers) => {
      const power = powerOf(numbers, given.label);
      return [power, withPower(given.label, power)];
    });"""
    known = POWERS[label]
    said = node.run(script, {"axes": [*map(list, known)], "label": label})
    assert [*map(tuple, said)] == [*known.values()]


@pytest.mark.parametrize(
    ("times", "label", "last"),
    [
        (1.0, "way in mm", "3"),
        (1e-3, "way\nin 10⁻³ mm", "3"),
        (1e-9, "way\nin 10⁻⁹ mm", "3"),
        (1e6, "way\nin 10⁶ mm", "3"),
        (1e-2, "way\nin mm", "0.03"),
    ],
)
def test_so_has_the_picture_of_a_figure(
    times: float, label: str, last: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[Axes] = []
    plain_draw = picture._Drawn.draw

    def draw(own: picture._Drawn, *given: Any) -> None:
        plain_draw(own, *given)
        drawn.append(own.ax)

    monkeypatch.setattr(picture._Drawn, "draw", draw)
    panel = cm.Panel(lines=[cm.Line(y=3 * times * t)], y="way in mm")
    cm.explore(panel, (t, 0, 1), {k: (1, 2)}).picture()
    (ax,) = drawn
    assert ax.get_ylabel() == label.replace("way in", "way\nin")
    assert f"{3 * times:g}" == last or ax.yaxis.get_major_formatter()(3 * times, 0) == last


_BLANK_PAGE = """
  const element = () => ({
    style: {}, setAttribute(name, value) { this[name] = value; }, append() {}, replaceChildren() {},
  });
  globalThis.document = { createElementNS: element, createElement: element };
"""
_DRAWN = """
  const now = compile(given)([], []), drawn = new Panel(given.columns[0][0], "p", true);
  drawn.keep(now, 0);
  drawn.draw(now, now, 0);
"""


@pytest.mark.parametrize(
    ("line", "y"),
    [
        (cm.Line(y=sp.sqrt(t - 0.5)), [0, 0.8]),  # real in a part of the range
        (cm.Line(y=t, only_where=t - 0.5), [0, 1]),
        (cm.Line(y=1 / (t - sp.Rational(1, 3))), [-100, 100]),  # a pole
    ],
)
def test_an_axis_whose_ticks_are_given_holds_a_curve_with_gaps(
    line: cm.Line, y: list[float]
) -> None:
    panel = cm.Panel(lines=[line], y="way", y_ticks=0.2, x_ticks=0.1)
    figure = cm.explore(panel, (t, 0, 1), says=[])
    across, up = node.run(
        f"{_DRAWN} return [drawn.view.x, drawn.view.y];", figure.description, more=_BLANK_PAGE
    )
    assert across == [0, 1, 0.1]
    assert up == pytest.approx([*y, 0.2])


def test_the_largest_of_what_is_no_number_is_none() -> None:
    figure = cm.explore(sp.sqrt(k - t**2), (t, 0, 1), {k: (-5, 5)})
    figure.values = {k: -1}
    script = """
    const [description, settings] = given, now = compile(description)(settings, settings);
    return sentences(description, now, settings, 0);
    """
    page = node.run(script, [figure.description, figure.settings])
    assert page == figure.text.splitlines() == ["at 0 s: curve 1 = –", "largest: |curve 1| = –"]


@pytest.mark.parametrize(
    ("box", "middle"),
    [
        (cm.Box(low=0.5, name="at work"), (0.75, 0.5)),
        (cm.Box(low=-9, high=0.5, y=(-9, 0.5), name="at work"), (0.25, 0.25)),
        (cm.Box(y=(0.5, 9), name="at work"), (0.5, 0.75)),
        (cm.Box(y=(7, None), name="at work"), None),
        (cm.Box(low=7, name="at work"), None),
        (cm.Box(low=0.7, high=0.3, name="at work"), None),
    ],
)
def test_a_box_has_its_name_in_the_middle_of_what_is_seen_of_it(
    box: cm.Box, middle: tuple[float, float] | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    panel = cm.Panel(lines=[cm.Line(y=t)], boxes=[box], x_limits=(0, 1), y_limits=(0, 1))
    figure = cm.explore(panel, (t, 0, 1), says=[])
    script = """
    const [{ word }] = drawn.boxes, { X, Y } = drawn.view;
    return word.style.display === "none" ? null : [X.back(word.x), Y.back(word.y)];
    """
    page = node.run(_DRAWN + script, figure.description, more=_BLANK_PAGE)
    drawn: list[Axes] = []
    monkeypatch.setattr(picture, "_take_out_a_power", lambda axis: drawn.append(axis.axes))
    figure.picture()
    words = [text.get_position() for text in drawn[0].texts]
    assert len(words) == (middle is not None)
    assert page == (middle if middle is None else pytest.approx(middle))
    assert words == [pytest.approx(each) for each in [middle] if each]
