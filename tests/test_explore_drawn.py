"""What `explore` draws and says though it is not nice: poles, pieces, corners, searches."""

import io
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import sympy as sp
from accounts import figure_of
from explored import picture_in
from PIL import Image

import cammotion as cm

t, k, b = sp.symbols("t k b")
SPAN = (t, 0, 1)


@pytest.fixture(autouse=True)
def at_a_quarter(monkeypatch: pytest.MonkeyPatch) -> None:
    """Let the clock stand where a curve is neither at its start nor at its peak."""
    monkeypatch.setattr("cammotion.views.live.figure.CLOCK", 0.25)


def test_numbers_of_numpy_are_numbers() -> None:
    ends: Any = np.float32(0), np.int64(2), np.float64(0.5)
    figure = cm.explore(
        k * t * b, (t, np.int64(0), np.float64(1)), {k: ends}, values={b: np.float64(3)}
    )
    figure.values = {k: np.float64(1.5)}
    assert "curve 1 = 1.125" in figure.text


def test_a_pole_breaks_the_curve_and_spares_the_axes() -> None:
    figure = cm.explore(1 / (t - sp.Rational(1, 4)), SPAN)  # where the clock stands, too
    assert figure.text == "at 0.25 s: curve 1 = ∞\nlargest: |curve 1| = ∞"
    flat = cm.explore(sp.Piecewise((4, t < sp.Rational(1, 4)), (-4, True)), SPAN)
    assert figure.picture() != flat.picture()
    shown = np.asarray(Image.open(io.BytesIO(figure.picture())).convert("L"))
    assert (shown[:, shown.shape[1] // 2 :] < 100).any()  # there is a curve, far from the pole


def test_what_is_real_in_places_only_is_drawn_and_told() -> None:
    pieces = cm.explore(sp.Piecewise((t, t > sp.Rational(1, 2))), SPAN)
    assert pieces.text == "at 0.25 s: curve 1 = –\nlargest: |curve 1| = 1"
    root = cm.explore(sp.cbrt(t - 2) + sp.sqrt(t - 1), (t, 0, 3))
    assert root.text.startswith("at 0.75 s: curve 1 = –")
    for figure in (pieces, root):
        assert picture_in(figure._repr_mimebundle_()[0], figure.text)


@pytest.mark.parametrize(
    "curve",
    [
        sp.Max(t, k, sp.Rational(1, 2)) + sp.Min(t, k),
        sp.Abs(t - k) + sp.sign(t - k) + sp.Heaviside(t - k),
        sp.Mod(t, k) + sp.floor(3 * t) + sp.ceiling(t) + sp.frac(t) + sp.atan2(t, k),
        sp.Piecewise((1, (t > k) & (t < 1) | sp.Eq(t, 0)), (0, sp.Not(t > 2)), (t, True)),
        sp.Piecewise((1, sp.Ne(k, 1)), (0, True)),
        sp.Integer(2),
        cm.inverse(b**2, (b, 0, 1), t),
    ],
)
def test_all_that_a_curve_may_be_made_of(curve: sp.Expr) -> None:
    figure = cm.explore(curve, SPAN, {k: (0.2, 1)})
    assert figure.picture()
    assert "largest" in figure.text
    assert figure._data["description"]["formulas"]


def test_a_sentence_may_hold_braces_texts_and_conditions() -> None:
    say = cm.Say("{{{who}}} = {it:.2f}", {"who": "k", "it": k}, k > 2, cm.Say("small"))
    figure = cm.explore(k * t, SPAN, {k: (1, 3)}, says=[say])
    assert figure.text == "small"
    figure.values = {k: 2.5}
    assert figure.text == "{k} = 2.50"


def test_a_line_or_an_expression_is_a_panels_line() -> None:
    alone = cm.Panel(lines=cm.Line(y=t))  # type: ignore[arg-type]
    bare = cm.Panel(lines=[t])
    described = [cm.explore(panel, (t, 0, 1)).description for panel in (alone, bare)]
    assert described[0] == described[1]


@pytest.mark.parametrize(
    ("curve", "largest"),
    [
        (1 / (1 - t**2), "∞"),
        (sp.tan(t), "∞"),
        (2 * sp.exp(-(((t - 1.2345) / 0.001) ** 2)), "2"),
        (sp.sin(t + 2), "1"),
    ],
)
def test_what_grows_without_end_is_infinite_and_a_narrow_peak_not(curve: Any, largest: str) -> None:
    assert cm.explore(curve, (t, 0, 3)).text.endswith(f"largest: |curve 1| = {largest}")


def test_a_control_starts_on_a_step() -> None:
    figure = cm.explore(k * t, (t, 0, 1), {k: (0, 5, 1)})
    assert figure.values == {k: 2}


@pytest.mark.parametrize("ends", [(0.005, 0.02), (0, 0.015), (0.03, 0.045), (0, 15)])
def test_a_control_of_any_width_has_a_round_step(ends: tuple[float, float]) -> None:
    (control,) = cm.explore(k * t, (t, 0, 1), {k: ends}).description["controls"]
    width = ends[1] - ends[0]
    assert 150 <= round(width / control["step"]) <= 375
    assert f"{control['step']:.3e}".startswith(("1.000", "2.000", "5.000"))


def test_a_condition_may_be_an_expression_that_has_to_be_above_0() -> None:
    figure = cm.explore(k * t, (t, 0, 1), {k: (-3, 5)}, says=[cm.Say("above", when=k)])
    assert figure.text == "above"
    for below in (-1, 0):
        figure.values = {k: below}
        assert figure.text == ""


def test_a_symbol_with_another_range_has_another_meaning() -> None:
    labels = [
        cm.explore(over[0], over).description["columns"][0][0]["x_label"]
        for over in ((cm.x, 0, 1), (cm.x, 0, 2), (sp.Symbol("phi"), 0, 1))
    ]
    assert labels == ["x = t/tm", "x", "φ"]


def test_what_is_limited_gives_way_when_it_is_moved_itself() -> None:
    limited = cm.Control(low=0, high=4, start=1, most=4 - k)
    a = sp.Symbol("a_1")
    figure = cm.explore(a * k * t, (t, 0, 1), {k: (0, 4), a: limited}, values={k: 3})
    figure.values = {a: 4}
    assert figure.values == {k: 3, a: 1}


def test_a_figure_and_a_player_in_one_notebook_have_styles_of_their_own() -> None:
    views = Path(cm.__file__).parent / "views"
    figure, player = (
        {*re.findall(r"\.cm-[a-z-]+", (views / sheet).read_text("utf-8"))}
        for sheet in ("live/figure.css", "animation/player.css")
    )
    assert figure
    assert player
    assert not figure & player


@pytest.mark.parametrize(
    ("other", "is_one"),
    [
        (cm.Panel(lines=[cm.Line(y=t**2)]), True),
        (cm.Panel(lines=[cm.Line(y=t**2)], x="x"), False),
        (cm.Panel(lines=[cm.Line(y=t**2)], x_limits=(0, 5)), False),
        (cm.Panel(lines=[cm.Line(y=t**2, over=(0, 5))]), False),
        (cm.Panel(lines=[cm.Line(y=t**2, x=5 * t)]), False),
        (cm.Panel(lines=[cm.Line(y=t**2)], is_bare=True), False),  # which has no numbers
        (cm.Panel(lines=[cm.Line(y=t**2)], is_equal=True), False),
    ],
)
def test_panels_share_the_numbers_of_an_axis_that_is_the_same(
    other: cm.Panel, is_one: bool
) -> None:
    (column,) = cm.explore([t, other], SPAN).description["columns"]
    assert [panel["shares_x"] for panel in column] == [is_one, is_one]


def test_a_panel_over_nothing_is_called_by_its_heights() -> None:
    circle = cm.Panel(lines=[cm.Line(x=sp.cos(t), y=sp.sin(t))], y="height in mm")
    ((panel,),) = cm.explore(circle, SPAN).description["columns"]
    assert panel["title"] == "height in mm"


@pytest.mark.parametrize("number", [1.0, -0.05, -12345.0])
@pytest.mark.parametrize("columns", [1, 2])
def test_a_label_beside_wide_numbers_is_whole_and_over_no_panel(
    number: float, columns: int
) -> None:
    panel = cm.Panel(lines=[cm.Line(y=number * t)], y="difference in 0.001 in")
    drawn = figure_of(cm.explore([[panel]] * columns, SPAN))
    drawn.draw_without_rendering()
    labels = [ax.yaxis.label.get_window_extent() for ax in drawn.axes]
    assert labels[0].x0 > 0
    for label, before in zip(labels[1:], drawn.axes, strict=False):
        assert label.x0 > before.bbox.x1


def test_the_cursor_marks_no_line_of_reference() -> None:
    lines = [cm.Line(y=t), cm.Line(y=sp.Integer(1), role="reference")]
    (ax,) = figure_of(cm.explore(cm.Panel(lines=lines), SPAN)).axes
    marked = [line for line in ax.lines if line.get_marker() == "o"]
    assert [[*map(float, np.ravel(line.get_ydata()))] for line in marked] == [[0.25]]


def test_a_number_without_a_unit_ends_its_sentence() -> None:
    figure = cm.explore(b * t, SPAN, {k: (1, 3)}, values={b: 2 * k})
    assert figure.text.splitlines()[0] == "b = 4"


LONG = "Werkzeugschlitten in front: distance from a stop in mm"


def test_a_label_under_a_narrow_panel_is_whole_and_in_lines() -> None:
    panel = cm.Panel(lines=[cm.Line(y=t)], x=LONG)
    drawn = figure_of(cm.explore([[panel], [panel], [panel]], SPAN))
    drawn.draw_without_rendering()
    for ax in drawn.axes:
        label = ax.xaxis.label.get_window_extent()
        assert ax.get_xlabel().replace("\n", " ") == LONG
        assert label.y0 > 0
        assert label.x0 > ax.bbox.x0 - 14
        assert label.x1 < ax.bbox.x1 + 14


def test_a_label_that_has_room_stays_on_its_line() -> None:
    drawn = figure_of(cm.explore(cm.Panel(lines=[cm.Line(y=t)], x=LONG), SPAN))
    assert drawn.axes[0].get_xlabel() == LONG


def test_the_unit_of_a_label_is_what_stands_behind_the_last_in() -> None:
    panel = cm.Panel(lines=[cm.Line(y=1e-3 * t)], y="arm in front: position in mm")
    (ax,) = figure_of(cm.explore(panel, SPAN)).axes
    assert ax.get_ylabel() == "arm in front: position\nin 10⁻³ mm"


def test_given_steps_are_those_of_the_picture_too() -> None:
    limits: dict[str, Any] = {"x_limits": (0, 3), "y_limits": (-75, 75)}
    panel = cm.Panel(lines=[cm.Line(y=t)], x_ticks=0.75, y_ticks=30, height=150, **limits)
    (ax,) = figure_of(cm.explore(panel, SPAN)).axes
    x, y = (axis.get_majorticklocs() for axis in (ax.xaxis, ax.yaxis))
    assert [at for at in x if 0 <= at <= 3] == [0, 0.75, 1.5, 2.25, 3]
    assert [at for at in y if abs(at) <= 75] == [-60, -30, 0, 30, 60]


def test_no_spike_flattens_the_rest() -> None:
    """Twice as high as nine tenths of the values are wide, on its side; all of the other side."""
    for sign in (1, -1):
        spike = 1000 * sp.exp(-(((t - 1) / 0.01) ** 2))
        (ax,) = figure_of(cm.explore(sign * (t + spike), (t, 0, 2))).axes
        ends = sorted(sign * end for end in ax.get_ylim())
        assert ends == pytest.approx([0, 3.75], abs=0.15)


def test_steps_that_are_too_small_are_thinned() -> None:
    panel = cm.Panel(lines=[cm.Line(y=t)], x_ticks=1e-6, y_ticks=1e-6)
    (ax,) = figure_of(cm.explore(panel, SPAN)).axes
    for axis in (ax.xaxis, ax.yaxis):
        assert 2 <= len(axis.get_majorticklocs()) <= 20


def test_a_legend_hides_no_curve_where_there_is_room_for_it() -> None:
    """Over the second curve, left of a panel without axes, and beside no numbers of others."""
    up = [100 * sp.Min(1, 2.4 * t), 50 * sp.Max(0, sp.Min(1, 8 * t - 3.2, 8 - 8 * t))]
    crossed = cm.Panel(lines=[cm.Line(y=y, name=4 * name) for y in up for name in "ab"], height=300)
    turn = 2 * sp.pi * t
    rings = [cm.Line(x=r * sp.cos(turn), y=r * sp.sin(turn), name=f"{r}") for r in (1, 3, 5)]
    bare = cm.Panel(lines=rings, is_equal=True, is_bare=True, height=300)
    flat = [cm.Line(x=r * sp.cos(turn), y=r * sp.sin(turn) / 3, name=9 * "r") for r in (1, 3, 5)]
    low = cm.Panel(lines=flat, is_equal=True, height=400, x="x in mm", y="y in mm")
    for panel, columns in ((crossed, 1), (bare, 2), (low, 2)):
        drawn = figure_of(cm.explore([[panel]] * columns, SPAN))
        ax = drawn.axes[0]
        drawn.draw_without_rendering()
        legend = ax.get_legend()
        assert legend is not None
        hides = legend.get_window_extent()
        for line in ax.lines:
            path = line.get_path().transformed(line.get_transform())
            assert not path.intersects_bbox(hides, filled=False)
        assert 0 <= hides.x0 < hides.x1 <= drawn.bbox.x1
