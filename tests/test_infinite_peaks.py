"""Pictures and readouts where a velocity jumps, so that a peak is infinite, or where none is."""

from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from machines import RULE, make_diagram, make_die, make_mill
from matplotlib import pyplot as plt

import cammotion as cm
from cammotion.views.live import Explorer

mpl.use("agg")

LAWS: dict[str, Any] = {
    "line": cm.MotionLaw("line", cm.x),
    "a velocity at its end": cm.polynomial((0, 0, 0), (1, 1, 0)),
    "constant acceleration": "constant acceleration",  # its jerk is infinite
}
BELT = cm.indexing_motion("belt", cm.rise(100, over_deg=360, law=LAWS["line"]), stops=1)
STILL = cm.motion("still", cm.dwell(360))
DIAGRAMS = {
    **{name: make_diagram(make_mill(law=law), make_die(law=law)) for name, law in LAWS.items()},
    "a conveyor": make_diagram(BELT, make_die()),
    "nothing but a conveyor": make_diagram(BELT),
    "standing still": make_diagram(STILL),
    "a conveyor, and standing still": make_diagram(BELT, STILL),
}
INFINITE = ["line", "a velocity at its end"]


@pytest.fixture(autouse=True)
def _close() -> Iterator[None]:
    yield
    plt.close("all")


def moves(law: str, *more: cm.Move) -> list[cm.Move]:
    made = [
        cm.Move(stroke_mm=50, angle_deg=angle, rate_per_hour=2000, law=LAWS[law])
        for angle in (55, 110)
    ]
    return [*made, *more]


def assert_finite(*values: Any) -> None:
    for value in values:
        assert np.isfinite(np.asarray(value, dtype=float)).all()


def assert_says(text: str, peak: float) -> None:
    assert "nan" not in text
    assert "inf " not in text
    assert ("∞" in text) == np.isinf(peak)


@pytest.mark.parametrize("name", DIAGRAMS)
def test_every_machine_is_animated(name: str) -> None:
    diagram = DIAGRAMS[name]
    peak = max(map(diagram.peak_acceleration, diagram.names))
    for designs in (diagram, {"this": diagram, "one with a peak": make_diagram()}):
        animation = cm.animate(designs)
        assert_says(animation.description, peak)
        assert_says(animation.svg, peak)


@pytest.mark.parametrize("name", LAWS)
def test_a_die_over_a_turret_is_animated(name: str) -> None:
    assert "no collision" in cm.animate(DIAGRAMS[name], rules=RULE).description


@pytest.mark.parametrize("name", DIAGRAMS)
def test_every_row_of_a_timing_diagram_is_drawn(name: str) -> None:
    diagram = DIAGRAMS[name]
    rows = ("velocity", "acceleration", "jerk")
    ax = cm.plot_timing(diagram, rows=rows)
    ax.figure.canvas.draw()
    for row, axis in zip(rows, ax.figure.axes[2:], strict=True):
        assert_finite(axis.get_ylim())
        peak = getattr(diagram, f"peak_{row}")
        infinite = [name for name in diagram.names if np.isinf(peak(name))]
        said = [text.get_text() for text in axis.texts]
        assert said == ([f"peak ∞: {', '.join(infinite)}"] if infinite else [])


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("curve", ["displacement", "velocity", "acceleration", "jerk"])
def test_every_curve_of_a_move_is_drawn(law: str, curve: str) -> None:
    ax = cm.plot_curves(moves(law), curve=curve)
    ax.figure.canvas.draw()
    assert_finite(ax.get_ylim())
    is_infinite = curve == "jerk" or (curve == "acceleration" and law in INFINITE)
    assert [text.get_text() for text in ax.texts] == [
        f"{angle}°, peak ∞" if is_infinite else f"{angle}°" for angle in (55, 110)
    ]


@pytest.mark.parametrize("law", LAWS)
def test_the_bar_of_an_infinite_peak_is_no_number(law: str) -> None:
    known = cm.Move(stroke_mm=50, angle_deg=80, rate_per_hour=2000)
    for drawn in (moves(law), moves(law, known)):
        ax = cm.plot_peaks(drawn)
        ax.figure.canvas.draw()
        assert_finite(ax.get_ylim())
        peaks = [move.peak_acceleration for move in drawn]
        assert [text.get_text() for text in ax.texts] == [
            f"{peak:#.3g}" if np.isfinite(peak) else "∞" for peak in peaks
        ]
        heights = [bar.get_height() for bar in ax.containers[0]]
        for peak, height in zip(peaks, heights, strict=True):
            assert height == peak if np.isfinite(peak) else height == max(heights)


def test_no_inverse_square_is_drawn_through_infinite_peaks() -> None:
    for law in INFINITE:
        with pytest.raises(cm.InputError, match=r"is infinite at any angle.*: give moves by a law"):
            cm.plot_inverse_square(moves(law))
    assert len(cm.plot_inverse_square(moves("constant acceleration")).lines) == 2


def at_all_places(explorer: Explorer) -> Iterator[str]:
    """Yield what is said with each control at its least, at its most, and as it was."""
    for control in explorer.controls:
        for value in (control.slider.min, control.slider.max, control.default):
            control.value = value
            yield explorer.text


@pytest.mark.parametrize("law", LAWS)
def test_the_explorer_of_a_move(law: str) -> None:
    (move, *_) = moves(law)
    explorer = cm.explore_move(move)
    for text in at_all_places(explorer):
        assert_says(text, move.peak_acceleration)
        for ax in explorer._axes:
            assert_finite(ax.get_ylim())
    assert ("ratio of the peaks: none, both are infinite" in explorer.text) == (law in INFINITE)
    explorer.pin()


@pytest.mark.parametrize("law", LAWS)
def test_the_explorer_of_the_shares(law: str) -> None:
    diagram = DIAGRAMS[law]
    explorer = cm.explore_shares(diagram)
    for text in at_all_places(explorer):
        assert_says(text, diagram.peak_acceleration("die"))
        low, high = explorer._axes[1].get_ylim()
        for _, line in explorer._lines:
            assert low <= np.min(line.get_ydata()) <= np.max(line.get_ydata()) <= high


@pytest.mark.parametrize("law", LAWS)
def test_the_explorer_of_the_overlap(law: str) -> None:
    diagram = DIAGRAMS[law]
    explorer = cm.explore_overlap(diagram, RULE, contact_mm=20)
    for text in at_all_places(explorer):
        assert_says(text, diagram.peak_acceleration("die"))
    explorer.widen()
    assert "No collision" in explorer.text


def test_a_conveyor_leaves_nothing_to_share() -> None:
    with pytest.raises(cm.InputError, match=r"take 460 deg of the turn: leave 20 deg at least"):
        cm.explore_shares(DIAGRAMS["a conveyor"])


def test_the_explorer_of_the_overlap_over_a_conveyor() -> None:
    """A conveyor never rests at a stop: the die may never be down."""
    explorer = cm.explore_overlap(DIAGRAMS["a conveyor"], rule_for("belt"), contact_mm=20)
    assert "COLLISION" in explorer.text
    assert "nan" not in explorer.text
    explorer.widen()
    assert "No move of the die is free of collision" in explorer.text


def rule_for(belt: str) -> cm.ClearanceRule:
    return cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within(belt, 0.65))


def test_the_explorer_of_the_family_says_where_the_jerk_is_infinite() -> None:
    explorer = cm.explore_scca()
    explorer.choose("constant acceleration")
    assert "Cj infinite (A jumps at the ends and in the middle)" in explorer.text
