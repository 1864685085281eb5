"""The explorer of one move, without a browser: what it draws, says and carries for a reader."""

import math
import re
from typing import Any

import numpy as np
import pytest
from explored import at_corners, control_of, drawn, limits_of, lines_of, peaks_said, picture_in
from machines import OVERSHOOTING

import cammotion as cm
from cammotion.views.explorers.move import B_m, N, h_m
from cammotion.views.live.figure import LiveFigure

DIE = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
PLACES = np.linspace(0.001, 0.999, 97)
RATIO = r"ratio of the peaks: (.*) = (.*) \(rate, .*\) × (.*) \(angle, .*\) × (.*) \(st.* × (.*) \("


@pytest.fixture
def figure() -> LiveFigure:
    return cm.explore_move(DIE, laws=cm.LAWS)


def move_of(figure: LiveFigure, law: str | cm.MotionLaw = "cycloidal") -> cm.Move:
    """Return the move that the controls show."""
    values = figure.values
    return cm.Move(stroke_mm=values[h_m], angle_deg=values[B_m], rate_per_hour=values[N], law=law)


def check_drawn(figure: LiveFigure, move: cm.Move) -> None:
    """Compare the three curves with the move's own, and see that they are in the picture."""
    curves: dict[str, Any] = {
        "displacement": move.displacement_mm,
        "velocity": move.velocity,
        "acceleration": move.acceleration,
    }
    for name, curve in curves.items():
        (line,) = lines_of(figure, name)
        y = drawn(figure, line["y"], PLACES * move.angle_deg)
        wanted = curve(PLACES * move.time_s)
        assert y == pytest.approx(wanted, rel=1e-9, abs=1e-9 * np.abs(wanted).max())
        assert [figure._now[end]() for end in line["over"]] == pytest.approx([0, move.angle_deg])
        assert move.angle_deg <= limits_of(figure, name, "x")[1]
    low, high = limits_of(figure, "displacement")
    displacement = move.displacement_mm(PLACES * move.time_s)
    assert low <= np.min(displacement) <= np.max(displacement) <= high


def test_every_corner_of_the_controls(figure: LiveFigure) -> None:
    for _ in at_corners(figure, N, B_m, h_m):
        move = move_of(figure)
        peak = cm.peak_acceleration(move.stroke_mm, move.angle_deg, move.rate_per_hour)
        design, reference, ratio = figure.text.splitlines()
        assert f"your design: tm = {move.time_s:.4g} s, a_max = {peak:.4g} m/s²" in design
        assert f"reference: tm = 0.275 s, a_max = {DIE.peak_acceleration:.4g} m/s²" in reference
        found = re.match(RATIO, ratio)
        assert found
        total, *parts = map(float, found.groups())
        assert total == pytest.approx(peak / DIE.peak_acceleration, rel=1e-3)
        assert np.prod(parts) == pytest.approx(total, rel=2e-3)
        check_drawn(figure, move)


def test_every_law_can_be_chosen(figure: LiveFigure) -> None:
    (law,) = figure.values.keys() - {N, B_m, h_m}
    options = control_of(figure, law)["options"]
    assert sorted(options) == sorted(cm.LAWS)
    assert options[0] == "cycloidal"
    for number, name in enumerate(options):
        figure.values = {law: number}
        move = move_of(figure, name)
        assert peaks_said(figure.text)[0] == pytest.approx(move.peak_acceleration, rel=1e-3)
        factor = move.peak_acceleration / DIE.peak_acceleration
        assert f"× {factor:.4g} (law)" in figure.text
        check_drawn(figure, move)


def test_a_law_of_ones_own_comes_first_even_under_a_known_name() -> None:
    own = cm.MotionLaw("cycloidal", 3 * cm.x**2 - 2 * cm.x**3)
    move = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000, law=own)
    figure = cm.explore_move(move, laws=cm.LAWS)
    assert figure.chosen == {"motion law": "cycloidal"}
    check_drawn(figure, move_of(figure, own))


def test_the_pinned_design_becomes_the_reference(figure: LiveFigure) -> None:
    figure.values = {B_m: 110}
    before = figure.picture()
    figure.pin()
    assert "ratio of the peaks: 1 = 1 (rate" in figure.text
    assert figure.picture() != before
    figure.values = {B_m: 55}
    assert "ratio of the peaks: 4 = 1 (rate, squared) × 4 (angle, squared)" in figure.text
    assert peaks_said(figure.text) == pytest.approx([4.154, 1.039], abs=1e-3)


def test_a_reader_without_a_kernel_gets_picture_and_text(figure: LiveFigure) -> None:
    figure.values = {h_m: 25}
    bundle, _ = figure._repr_mimebundle_()
    assert picture_in(bundle, figure.text) == figure.picture()
    assert "application/vnd.jupyter.widget-view+json" in bundle


@pytest.mark.parametrize(
    ("given", "rates", "strokes"),
    [
        ((400, 300, 30_000), (500, 30_000, 50), (5, 400, 1)),
        ((400, 300, 60_000), (50_000, 500_000, 5000), (5, 400, 1)),
        ((0.5, 3, 30), (5, 50, 0.5), (0.5, 10, 0.1)),
        ((0.02, 55, 200_000), (50_000, 500_000, 5000), (0.005, 0.1, 0.001)),
        ((4000, 220, 499), (50, 500, 5), (500, 10_000, 100)),
    ],
)
def test_a_machine_beyond_the_usual_ranges_has_others(
    given: tuple[float, float, float],
    rates: tuple[float, float, float],
    strokes: tuple[float, float, float],
) -> None:
    """A little above they are wider; far off they are of its size, and so is the axis."""
    stroke, angle, rate = given
    move = cm.Move(stroke_mm=stroke, angle_deg=angle, rate_per_hour=rate)
    figure = cm.explore_move(move)
    assert move_of(figure) == move
    angles = min(20, angle), max(220, angle), 1
    for symbol, span in ((N, rates), (B_m, angles), (h_m, strokes)):
        control = control_of(figure, symbol)
        assert [control[end] for end in ("low", "high", "step")] == pytest.approx(span)
    _, top = limits_of(figure, "displacement")
    assert top == pytest.approx(strokes[1])
    check_drawn(figure, move)


@pytest.mark.parametrize("share", [0.9, 0.97, 0.999])
def test_a_short_ramp_is_drawn_up_to_its_peak(share: float) -> None:
    """In the page, too, which takes 201 even places and the joints of a line."""
    law = cm.LAWS["modified sine"].with_constant_velocity(share)
    move = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000, law=law)
    figure = cm.explore_move(move, laws=["cubic"])
    (line,) = lines_of(figure, "acceleration")
    joints = [figure._now[joint]() for joint in line["joints"]]
    places = [*np.linspace(0, 55, 201), *(at for at in joints if 0 < at < 55)]
    highest = np.max(drawn(figure, line["y"], np.array(places)))
    assert highest == pytest.approx(move.peak_acceleration)
    assert limits_of(figure, "acceleration") == pytest.approx([-1.1 * highest, 1.1 * highest])


@pytest.mark.parametrize(
    "law",
    [
        OVERSHOOTING,
        cm.MotionLaw("line {x} <b>", cm.x),
        cm.law_from_points(np.linspace(0, 1, 12), np.linspace(0, 1, 12) ** 2),
        cm.LAWS["cycloidal"].with_constant_velocity(0.4),
        cm.polynomial((0, 0.3, 0), (1, 0.2, 0), name="leaning"),
    ],
    ids=str,
)
def test_any_law_can_be_explored(law: cm.MotionLaw) -> None:
    move = cm.Move(stroke_mm=30, angle_deg=80, rate_per_hour=1500, law=law)
    figure = cm.explore_move(move, laws=["cubic"])
    for _ in at_corners(figure, B_m, h_m):
        check_drawn(figure, move_of(figure, law))
        peak = move_of(figure, law).peak_acceleration
        assert peaks_said(figure.text)[0] == pytest.approx(peak, rel=1e-3)
        assert ("ratio of the peaks: none" in figure.text) == math.isinf(peak)
    assert control_of(figure, next(iter(figure.values.keys() - {N, B_m, h_m})))["options"][0] == (
        law.name
    )
    assert figure.picture()
