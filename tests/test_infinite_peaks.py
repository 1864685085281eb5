"""Pictures and readouts where a velocity jumps, so that a peak is infinite, or where none is."""

import re
from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from explored import control_of, peaks_said
from machines import RULE, make_diagram, make_die, make_mill
from matplotlib import pyplot as plt

import cammotion as cm
from cammotion.views.live.figure import LiveFigure

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
    assert "rule kept" in cm.animate(DIAGRAMS[name], rules=RULE).description


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


def at_all_places(figure: LiveFigure) -> Iterator[str]:
    """Yield what is said with each control at its least, at its most, and as it was."""
    for symbol in figure.values:
        control = control_of(figure, symbol)
        if control["options"]:
            continue
        for place in ("low", "high", "start"):
            figure.values = {symbol: control[place]}
            yield figure.text


@pytest.mark.parametrize("law", LAWS)
def test_the_explorer_of_a_move(law: str) -> None:
    (move, *_) = moves(law)
    figure = cm.explore_move(move)
    for text in at_all_places(figure):
        assert_says(text, move.peak_acceleration)
        assert np.isinf(peaks_said(text)).all() == (law in INFINITE)
    no_ratio = "ratio of the peaks: none, since the velocity of a law jumps"
    assert (no_ratio in figure.text) == (law in INFINITE)
    figure.pin()
    assert (no_ratio in figure.text) == (law in INFINITE)
    assert figure.picture()


def test_from_a_law_with_a_peak_to_one_without_there_is_no_ratio() -> None:
    (move, *_) = moves("line")
    figure = cm.explore_move(move, laws=["cycloidal"])
    choice = next(symbol for symbol in figure.values if control_of(figure, symbol)["options"])
    figure.values = {choice: control_of(figure, choice)["options"].index("cycloidal")}
    assert peaks_said(figure.text) == pytest.approx([4.154, np.inf], abs=1e-3)
    assert "ratio of the peaks: none" in figure.text
    figure.pin()
    assert "ratio of the peaks: 1 = 1 (rate" in figure.text


@pytest.mark.parametrize("law", LAWS)
def test_the_explorer_of_the_shares(law: str) -> None:
    diagram = DIAGRAMS[law]
    figure = cm.explore_shares(diagram)
    for text in at_all_places(figure):
        assert_says(text, diagram.peak_acceleration("die"))
    assert figure.picture()


@pytest.mark.parametrize("law", LAWS)
def test_the_explorer_of_the_overlap(law: str) -> None:
    diagram = DIAGRAMS[law]
    figure = cm.explore_overlap(diagram, RULE, contact_mm=20)
    for text in at_all_places(figure):
        assert_says(text, diagram.peak_acceleration("die"))
        assert text.count(", as before") == 2 * (law in INFINITE)
    figure.press("Widest move of the die")
    assert "The rule is kept" in figure.text
    assert figure.picture()


def test_a_conveyor_leaves_nothing_to_share() -> None:
    with pytest.raises(cm.InputError, match=r"take 460 deg of the turn: leave more than 20 deg"):
        cm.explore_shares(DIAGRAMS["a conveyor"])


def test_a_conveyor_never_rests_so_no_overlap_with_it_can_be_explored() -> None:
    """Its velocity has no jump as it is, and one at any other angle."""
    rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("belt", 0.65))
    with pytest.raises(cm.InputError, match="'belt' goes from one move into the next without com"):
        cm.explore_overlap(DIAGRAMS["a conveyor"], rule, contact_mm=20)


def test_the_explorer_of_the_family_says_where_the_jerk_is_infinite() -> None:
    figure = cm.explore_scca()
    figure.press("constant acceleration")
    assert "Cj infinite (A jumps at the ends and in the middle)" in figure.text


def test_an_infinite_peak_is_said_with_its_sign() -> None:
    """In advice and comparison as in the line of the machine itself."""
    machine = cm.Machine("press", cm.TimingDiagram([make_die(law=cm.CONSTANT_VELOCITY)], 2000), ())
    compared = repr(cm.compare(machine.diagram, make_diagram()))
    advice = cm.improvements(machine)
    for said in (repr(machine), advice.hardest, compared, *map(str, (one.row for one in advice))):
        assert "∞" in said
        assert not re.search(r"\binf\b", said)
