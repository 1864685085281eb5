"""The pictures show the numbers they claim to show, and touch nothing else."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import combinations, pairwise

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot as plt
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.container import BarContainer

import cammotion as cm
from cammotion.views.plots import COLOURS, CURVES

mpl.use("agg")

ANGLES = [27.5, 55, 110, 165, 220]
MOVES = [cm.Move(stroke_mm=50, angle_deg=angle, rate_per_hour=2000) for angle in ANGLES]


@pytest.fixture(autouse=True)
def _no_trace() -> Iterator[None]:
    settings = mpl.rcParams.copy()
    yield
    plt.close("all")
    assert mpl.rcParams == settings


@pytest.mark.parametrize("move", [MOVES[1], replace(MOVES[1], law=cm.fifth_degree_linear(0.99))])
@pytest.mark.parametrize("curve", CURVES)
def test_a_curve_reaches_the_peak_of_its_move(curve: str, move: cm.Move) -> None:
    """Also where it is over before a 241st of the time has gone."""
    ax = cm.plot_curves(move, curve=curve)
    drawn = ax.lines[0].get_ydata()
    peak = {
        "displacement": 50,
        "velocity": move.peak_velocity,
        "acceleration": move.peak_acceleration,
        "jerk": move.peak_jerk,
    }[curve]
    assert np.max(np.abs(drawn)) == pytest.approx(peak)
    assert ax.get_xlabel() == "time t in s"
    assert ax.get_ylabel() == CURVES[curve]


def test_a_name_stands_where_its_move_brakes_whatever_ramps_it_has() -> None:
    law = cm.LAWS["cubic"].with_constant_velocity(0.97)  # its first ramp has more of the places
    ax = cm.plot_curves([replace(MOVES[1], law=law), MOVES[2]], curve="jerk")
    assert getattr(ax.texts[0], "xy", (0,))[0] > 0.9 * MOVES[1].time_s


def test_curves_differ_in_colour_and_in_line_style() -> None:
    ax = cm.plot_curves(MOVES)
    curves = ax.lines[: len(MOVES)]
    assert len({line.get_color() for line in curves}) == len(MOVES)
    assert len({str(line.get_linestyle()) for line in curves}) >= 4
    assert [text.get_text() for text in ax.texts] == ["27.5°", "55°", "110°", "165°", "220°"]


def test_bars_are_as_high_as_the_peaks() -> None:
    ax = cm.plot_peaks(MOVES, labels=list("abcde"))
    (bars,) = ax.containers
    assert isinstance(bars, BarContainer)
    assert bars.datavalues == pytest.approx([move.peak_acceleration for move in MOVES])
    assert [text.get_text() for text in ax.get_xticklabels()] == list("abcde")


@pytest.mark.parametrize("angles", [(0.01, 1, 359), (0.5, 300), (55, 110), (55, 56)])
def test_each_number_of_a_logarithmic_scale_is_that_of_its_place(angles: Sequence[float]) -> None:
    moves = [cm.Move(stroke_mm=50, angle_deg=angle, rate_per_hour=2000) for angle in angles]
    ax = cm.plot_inverse_square(moves)
    renderer = FigureCanvasAgg(ax.figure).get_renderer()  # type: ignore[arg-type,no-untyped-call]
    ax.figure.draw(renderer)
    for axis in (ax.xaxis, ax.yaxis):
        low, high = axis.get_view_interval()
        seen = [tick for tick in axis.get_major_ticks() if low <= tick.get_loc() <= high]
        assert len(seen) >= 2
        assert [float(tick.label1.get_text()) for tick in seen] == pytest.approx(
            [tick.get_loc() for tick in seen]
        )
        boxes = [tick.label1.get_window_extent(renderer) for tick in seen]
        assert not any(one.overlaps(other) for one, other in pairwise(boxes))


def test_the_names_of_near_angles_stay_apart() -> None:
    near = [replace(MOVES[0], stroke_mm=5000, angle_deg=angle) for angle in (58, 55, 57, 56)]
    ax = cm.plot_inverse_square(near)
    ax.figure.canvas.draw()
    boxes = [text.get_window_extent() for text in ax.texts if "°" in text.get_text()]
    assert not any(one.overlaps(other) for one, other in combinations(boxes, 2))


def test_the_inverse_square_line_goes_through_every_point() -> None:
    ax = cm.plot_inverse_square(MOVES)
    line, points = ax.lines
    slope, intercept = np.polyfit(np.log(line.get_xdata()), np.log(line.get_ydata()), 1)
    assert slope == pytest.approx(-2, abs=1e-12)
    law = np.exp(intercept) * np.array(points.get_xdata()) ** slope
    assert points.get_ydata() == pytest.approx(law)


def test_plots_draw_into_the_axes_they_are_given() -> None:
    _, axes = plt.subplots(1, 3)
    assert cm.plot_curves(MOVES, ax=axes[0]) is axes[0]
    assert cm.plot_peaks(MOVES, ax=axes[1]) is axes[1]
    assert cm.plot_inverse_square(MOVES, ax=axes[2]) is axes[2]
    assert len(plt.get_fignums()) == 1


def test_the_colours_are_made_for_the_colour_blind() -> None:
    palette = {
        "#000000",
        "#e69f00",
        "#56b4e9",
        "#009e73",
        "#f0e442",
        "#0072b2",
        "#d55e00",
        "#cc79a7",
    }
    assert {drawn.lower() for drawn in COLOURS} <= palette


def test_an_unknown_keyword_is_an_error() -> None:
    with pytest.raises(TypeError, match="colour"):
        cm.plot_curves(MOVES, colour="red")  # type: ignore[call-arg]
