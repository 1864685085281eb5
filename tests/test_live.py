"""Live figures and explorers without a browser: what they draw, say and carry for a reader."""

import base64
import io
import re
from itertools import product
from typing import Any

import ipywidgets
import numpy as np
import pytest
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from PIL import Image

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.views.explorers.move import MoveExplorer
from cammotion.views.live import LiveFigure, NumberControl

DIE = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)


@pytest.fixture
def explorer() -> MoveExplorer:
    return cm.explore_move(DIE)


def pixels(png: bytes) -> "np.ndarray[Any, Any]":
    return np.asarray(Image.open(io.BytesIO(png)))


def heights(line: Line2D) -> Floats:
    """Read the drawn values off a curve."""
    return np.asarray(line.get_ydata(), dtype=float)


def drawn_peak(explorer: MoveExplorer) -> float:
    """Read the largest acceleration off the drawn curve."""
    return float(heights(explorer._chosen[2]).max())


def test_every_corner_of_the_sliders(explorer: MoveExplorer) -> None:
    for places in product(["min", "default", "max"], repeat=3):
        for control, place in zip(explorer.controls, places, strict=True):
            control.value = (
                control.default if place == "default" else getattr(control.slider, place)
            )
        move = explorer.move
        peak = cm.peak_acceleration(move.stroke_mm, move.angle_deg, move.rate_per_hour)
        design, _, ratio = explorer.text.splitlines()
        assert f"your design: tm = {move.time_s:.4g} s, a_max = {peak:.4g} m/s²" in design
        total, *parts = (float(number) for number in re.findall(r"\d[\d.e+-]*", ratio))
        assert total == pytest.approx(peak / DIE.peak_acceleration, rel=1e-3)
        assert np.prod(parts) == pytest.approx(total, rel=2e-3)
        assert drawn_peak(explorer) == pytest.approx(peak, rel=1e-3)
        assert_inside_its_axes(explorer)


def assert_inside_its_axes(explorer: MoveExplorer) -> None:
    for ax, line in zip(explorer._axes, explorer._chosen, strict=True):
        low, high = ax.get_ylim()
        assert low <= heights(line).min() <= heights(line).max() <= high
        assert np.asarray(line.get_xdata(), dtype=float).max() <= ax.get_xlim()[1]


def test_slider_and_number_field_hold_one_value() -> None:
    control = NumberControl("angle Bm, deg", 55, 20, 220, 1)
    control.slider.value = 70
    assert control.field.value == 70
    control.field.value = 124.84  # between the slider's steps
    assert control.value == 124.84
    assert control.slider.value == 125
    control.slider.value = 125.0  # the page says where the slider stands: no news
    assert control.value == 124.84
    control.field.value = 500  # beyond the range: the nearest that is allowed
    assert control.value == 220
    assert control.field.description == "angle Bm, deg"


def test_blitting_draws_what_a_full_drawing_draws(explorer: MoveExplorer) -> None:
    explorer.angle.value = 110
    blitted = explorer.live.value
    explorer.live.redraw()
    assert np.array_equal(pixels(blitted), pixels(explorer.live.value))


def test_a_change_of_limits_is_drawn() -> None:
    figure = Figure(figsize=(3, 2))
    ax = figure.subplots()
    (line,) = ax.plot([0, 1], [0, 1])
    live = LiveFigure(figure, [line])
    live.refresh()
    before = live.value
    live.refresh()
    assert live.value == before
    ax.set_ylim(0, 10)
    live.refresh()
    assert live.value != before


def test_the_pinned_design_becomes_the_reference(explorer: MoveExplorer) -> None:
    explorer.angle.value = 110
    before = explorer.live.value
    explorer.pin()
    assert explorer.reference.angle_deg == 110
    assert "ratio of the peaks: 1 = 1 (rate" in explorer.text
    assert explorer.live.value != before
    explorer.angle.value = 55
    assert "ratio of the peaks: 4 = 1 (rate, squared) × 4 (angle, squared)" in explorer.text


def test_the_button_pins(explorer: MoveExplorer) -> None:
    (button,) = [child for child in explorer.children if isinstance(child, ipywidgets.Button)]
    explorer.angle.value = 80
    button.click()
    assert explorer.reference.angle_deg == 80


def test_a_reader_without_a_kernel_gets_picture_and_text(explorer: MoveExplorer) -> None:
    explorer.stroke.value = 25
    bundle = explorer._repr_mimebundle_()
    assert base64.b64decode(bundle["image/png"]) == explorer.live.value
    assert bundle["text/plain"] == explorer.text
    assert "application/vnd.jupyter.widget-view+json" in bundle


def test_the_text_is_announced_to_screen_readers(explorer: MoveExplorer) -> None:
    assert 'role="status"' in explorer._shown_text.value
    assert "a_max = 4.154 m/s²" in explorer._shown_text.value


def test_a_machine_beyond_the_usual_ranges_widens_them() -> None:
    fast = cm.Move(stroke_mm=400, angle_deg=300, rate_per_hour=60_000)
    explorer = cm.explore_move(fast)
    assert explorer.move == fast
    assert drawn_peak(explorer) == pytest.approx(fast.peak_acceleration, rel=1e-3)
