"""Pictures and the live figure of a measured cam show what NumPy finds, in either unit."""

import re
from collections.abc import Iterator
from itertools import combinations
from typing import Any

import matplotlib as mpl
import measured_picture
import numpy as np
import pytest
from accounts import figure_of
from machines import Array
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from measured_cam import CAM, HALF, INCH_M, RATE, turn

import cammotion as cm
from cammotion.views.explorers.measured import ERROR, EXPONENT, HARMONICS
from cammotion.views.live.figure import LiveFigure

mpl.use("agg")


@pytest.fixture(autouse=True)
def _close_figures() -> Iterator[None]:
    yield
    plt.close("all")


BENT = (np.roll(CAM.position_mm, 1) - 2 * CAM.position_mm + np.roll(CAM.position_mm, -1)) / (
    4 / 36
) ** 2
"""The second differences of the cam in mm/s2."""


@pytest.mark.parametrize(("unit", "scale"), [("m", 1e-3), ("in", 1 / 25.4)])
def test_the_differences_are_drawn_in_a_unit_and_closed(unit: str, scale: float) -> None:
    ax = cm.plot_measured({"cam": CAM}, RATE, unit=unit, error_mm=0.0127)
    line = ax.lines[0]
    assert np.asarray(line.get_ydata()) == pytest.approx(scale * np.append(BENT, BENT[0]))
    assert np.asarray(line.get_xdata())[[0, -1]] == pytest.approx([0, 360])
    assert ax.get_ylabel() == f"acceleration in {unit}/s²"
    (bars,) = ax.containers
    ends = np.array([segment[:, 1] for segment in bars[2][0].get_segments()])
    assert np.ptp(ends, axis=1) / 2 == pytest.approx([4 * 0.0127 * 81 * scale] * 37)


def test_half_a_cam_is_not_closed() -> None:
    line = cm.plot_measured({"cam": HALF}, RATE).lines[0]
    assert np.asarray(line.get_xdata()) == pytest.approx(np.arange(10, 180, 10))


def test_a_spline_is_drawn_within_its_band() -> None:
    smooth = cm.smoothed(CAM, 1e-4)
    ax = cm.plot_measured({"cam": CAM, "spline": smooth}, RATE, error_mm=0.02)
    x, values = (np.asarray(each) for each in ax.lines[-2].get_data())
    assert values == pytest.approx(np.asarray(smooth.at(x, 2, rate_per_hour=RATE)))
    (band,) = [one for one in ax.collections if "FillBetween" in type(one).__name__] or [
        ax.collections[-1]
    ]
    edges = np.asarray(band.get_paths()[0].vertices)[:, 1]
    high = np.max(edges)
    bars = smooth.acceleration_rms(RATE, 0.02)
    assert np.min(edges) == pytest.approx(min(smooth.acceleration(RATE) - bars), rel=1e-3)
    assert high == pytest.approx(
        max(smooth.acceleration(RATE) + smooth.acceleration_rms(RATE, 0.02)), rel=1e-3
    )


def test_bars_have_their_rank_and_the_critical_one_too() -> None:
    found = cm.harmonics(CAM).acceleration(RATE, "differences")
    ax = cm.plot_harmonics({"cam": found}, unit="in", critical=18)
    assert [bar.get_height() for bar in ax.containers[0]] == pytest.approx(found / INCH_M)
    assert [text.get_text() for text in ax.texts] == ["1: 4.84", "3: 5.14", "4: 6.03", "18: 1.30"]


def covered(ax: Axes) -> list[tuple[str, str]]:
    """Return which values lie over one another, and what lies under the legend."""
    assert isinstance(ax.figure, Figure)
    ax.figure.canvas.draw()
    found = [(text.get_text(), text.get_window_extent()) for text in ax.texts]
    bars = [("a bar", bar.get_window_extent()) for bars in ax.containers for bar in bars]
    legend = ax.get_legend()
    assert legend is not None
    key = ("legend", legend.get_window_extent())
    pairs = [*combinations(found, 2), *((key, other) for other in (*found, *bars))]
    return [(one, other) for (one, a), (other, b) in pairs if a.overlaps(b)]


def noisy(number: int) -> Array:
    """Return accelerations of a table with reading errors, which are large in high harmonics."""
    readings = wave(number).position_mm * 25 + np.random.default_rng(1).normal(0, 0.004, number)
    table = cm.CamTable(turn(number), readings, is_cycle=True)
    return cm.harmonics(table).acceleration(3600)


@pytest.mark.parametrize("number", [72, 360])
@pytest.mark.parametrize("unit", ["m", "in"])
def test_many_harmonics_can_be_read(number: int, unit: str) -> None:
    found = noisy(number)
    drawn = {"Nocken": found, "zweiter": 0.9 * found, "dritter": found[:-9]}
    for few in ({"Nocken": found}, drawn):
        ax = cm.plot_harmonics(few, unit=unit, critical=found.size // 4)
        ticks = ax.get_xticks()
        assert 4 <= ticks.size <= 12
        assert ticks == pytest.approx(np.arange(1, ticks.size + 1) * round(ticks[0]))
        assert ticks[-1] <= found.size
        assert covered(ax) == []


def test_a_value_is_not_hidden_by_bars_beside_it() -> None:
    """Where a bar is narrower than its value, this stands over the neighbours too."""
    heights = np.where(np.arange(180) == 89, 0.1, 1.0)
    ax = cm.plot_harmonics({"cam": heights}, critical=90)
    (critical,) = [text for text in ax.texts if text.get_text() == "90: 0.10"]
    assert covered(ax) == []
    ax.figure.draw_without_rendering()  # type: ignore[union-attr]
    foot = critical.get_window_extent().y0
    assert foot >= max(bar.get_window_extent().y1 for bar in ax.containers[0])


@pytest.mark.parametrize("series", [1, 2, 3, 4])
@pytest.mark.parametrize("ranks", [6, 12, 18, 24, 30])
def test_values_of_several_series_do_not_cover_each_other(series: int, ranks: int) -> None:
    heights = 3 / np.arange(1.0, ranks + 1)
    drawn = {f"cam {number}": (1 + number / 50) * heights for number in range(series)}
    assert covered(cm.plot_harmonics(drawn, critical=2)) == []


def test_what_is_nothing_has_no_value_above_it() -> None:
    ax = cm.plot_harmonics({"cam": [3, 0, 0, 0], "other": [0, 2, 0, 0]}, critical=3)
    assert [text.get_text() for text in ax.texts] == ["1: 3.00", "3: 0.00", "2: 2.00", "3: 0.00"]


def test_few_harmonics_have_a_tick_at_every_second() -> None:
    """And the legend in the corner, as long as no bar is there."""
    rising = np.arange(1.0, 19.0)
    inside, outside = (cm.plot_harmonics({"cam": each}) for each in (rising[::-1], rising))
    for drawn in (inside, outside):
        assert drawn.get_xticks() == pytest.approx(np.arange(2, 19, 2))
        assert covered(drawn) == []
    tops = [
        drawn.get_legend().get_window_extent().y1 - drawn.bbox.y1  # type: ignore[union-attr]
        for drawn in (inside, outside)
    ]
    assert tops[0] < 0 < tops[1]


@pytest.mark.parametrize("count", [1, 4])
def test_a_legend_over_the_bars_leaves_long_values_room(count: int) -> None:
    """Of four tables it has two rows."""
    others = {f"cam {n}": np.where(np.arange(18) % 4 == n, 2.0, 1.0) for n in range(1, count)}
    ax = cm.plot_harmonics({"cam": 40 * np.arange(1.0, 19.0), **others}, unit="in")
    legend = ax.get_legend()
    assert legend is not None
    assert covered(ax) == []
    assert legend.get_window_extent().y0 > max(text.get_window_extent().y1 for text in ax.texts) + 5


@pytest.mark.parametrize(
    ("draw", "said"),
    [
        (lambda: cm.plot_measured({}, RATE), "There is no table to draw"),
        (lambda: cm.plot_measured({"cam": CAM}, RATE, unit="ft"), "There is no unit of length"),
        (lambda: cm.plot_harmonics({}), "There are no harmonics to draw"),
        (lambda: cm.explore_measured(HALF, RATE), r"is no cycle; the harmonics of the figure are"),
        (lambda: cm.explore_measured(wave(9), RATE), r"has 9 points from 0 deg on; .* at most, f"),
        (lambda: cm.explore_measured(wave(74), RATE), r"has 74 points from 0 deg on"),
        (lambda: cm.explore_measured(CAM, 0), "machine rate is 0"),
    ],
)
def test_what_cannot_be_drawn_is_refused(draw: Any, said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        draw()


def wave(number: int) -> cm.CamTable:
    return cm.CamTable(turn(number), np.cos(np.radians(turn(number))), is_cycle=True)


@pytest.fixture(scope="module")
def figure() -> LiveFigure:
    return cm.explore_measured(CAM, RATE, unit="in")


def said(figure: LiveFigure) -> list[float]:
    return [float(n) for n in re.findall(r"-?\d+\.\d+", figure.text.replace("−", "-"))]


def wrong(kind: int) -> Array:
    """Return errors of a hundredth of an inch, of one of the kinds that can be chosen."""
    places = np.arange(36)
    return [np.where(places % 2, -1, 1), np.where(places == 9, 1, 0), np.ones(36)][kind] * 0.01


@pytest.mark.parametrize("exponent", [-7.0, -4.5, -2.0])
@pytest.mark.parametrize("kind", [0, 1, 2])
def test_it_says_what_the_smoothing_spline_makes(
    figure: LiveFigure, exponent: float, kind: int
) -> None:
    (errors,) = {*figure.values} - {ERROR, EXPONENT, HARMONICS}
    figure.values = {ERROR: 0.01, EXPONENT: exponent, HARMONICS: 18, errors: kind}
    readings = cm.CamTable(CAM.angle_deg, CAM.position_mm + 25.4 * wrong(kind), is_cycle=True)
    smooth = cm.smoothed(readings, 10**exponent)
    lowest = smooth.acceleration(RATE)[17]
    bars = smooth.acceleration_rms(RATE, 0.254 / np.sqrt(3))[0] / INCH_M
    assert said(figure) == pytest.approx([lowest / INCH_M, lowest, bars], abs=0.051)


@pytest.mark.parametrize("kind", [0, 1, 2])
def test_it_draws_how_far_the_smoothing_spline_is_from_each_reading(
    figure: LiveFigure, kind: int
) -> None:
    (errors,) = {*figure.values} - {ERROR, EXPONENT, HARMONICS}
    figure.values = {ERROR: 0.01, EXPONENT: -4.5, HARMONICS: 18, errors: kind}
    _, panel = figure_of(figure).axes
    places, drawn = np.asarray(panel.lines[0].get_xydata()).T
    readings = cm.CamTable(CAM.angle_deg, CAM.position_mm + 25.4 * wrong(kind), is_cycle=True)
    away = cm.smoothed(readings, 10**-4.5).position_mm - readings.position_mm
    away_in = np.interp(places, np.arange(0, 370, 10), np.append(away, away[0]) / 25.4)
    assert drawn == pytest.approx(1000 * away_in, abs=1e-3)
    assert np.abs(drawn).max() > 1


def test_the_one_error_is_at_a_reading_that_there_is() -> None:
    """A quarter of a turn lies between two of 30 readings."""
    controls = cm.explore_measured(wave(30), RATE).description["controls"]
    assert controls[-1]["options"] == ["alternate", "one, at 84°", "all alike"]


@pytest.mark.parametrize("number", [1, 4, 17])
def test_it_keeps_so_many_harmonics(figure: LiveFigure, number: int) -> None:
    figure.values = {ERROR: 0, EXPONENT: -7, HARMONICS: number}
    found = np.fft.rfft(CAM.position_mm)
    found[number + 1 :] = 0
    few = cm.CamTable(CAM.angle_deg, np.fft.irfft(found), is_cycle=True)
    lowest = cm.smoothed(few, 1e-7).acceleration(RATE)[17]
    assert said(figure)[:2] == pytest.approx([lowest / INCH_M, lowest], abs=0.051)


def test_the_moving_picture_is_drawn_anew_as_it_is_stored() -> None:
    assert measured_picture.PICTURE.read_text("utf-8") == measured_picture.drawn()


def test_a_critical_rank_that_no_list_has_is_refused_with_one_that_they_have() -> None:
    with pytest.raises(cm.InputError, match="at most 3: give for example 3"):
        cm.plot_harmonics({"long": [3, 0, 1], "short": [1]}, critical=4)
    with pytest.raises(cm.InputError, match="amplitude is empty"):
        cm.plot_harmonics({"cam": []}, critical=4)


def test_a_critical_rank_that_one_list_has_not() -> None:
    ax = cm.plot_harmonics({"long": [3, 0, 1], "short": [1]}, critical=3)
    told = sorted(text.get_text() for text in ax.texts)
    assert told == ["1: 1.00", "1: 3.00", "3: 1.00"]
