"""The explorers of the timing diagram and of the overlap, without a browser."""

import base64
import re
from itertools import product
from typing import Any

import ipywidgets
import numpy as np
import pytest
from machines import RULE, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion.views.explorers.overlap import OverlapExplorer
from cammotion.views.explorers.scca import SccaExplorer
from cammotion.views.explorers.shares import ShareExplorer
from cammotion.views.live import Explorer

DIAGRAM = make_diagram()


@pytest.fixture
def overlap() -> OverlapExplorer:
    return cm.explore_overlap(DIAGRAM, RULE, contact_mm=20)


@pytest.fixture
def shares() -> ShareExplorer:
    return cm.explore_shares(DIAGRAM)


@pytest.fixture
def scca() -> SccaExplorer:
    return cm.explore_scca()


def set_controls(explorer: Explorer, places: tuple[str, ...]) -> None:
    for control, place in zip(explorer.controls, places, strict=True):
        control.value = control.default if place == "default" else getattr(control.slider, place)


def peaks_said(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"a_max = ([\d.]+) m/s²", text)]


def data(line: Any) -> Any:
    return np.column_stack([line.get_xdata(), line.get_ydata()])


def test_every_corner_of_the_overlap(overlap: OverlapExplorer) -> None:
    for places in product(["min", "default", "max"], repeat=4):
        set_controls(overlap, places)
        diagram = overlap.diagram
        die, mill = (diagram.peak_acceleration(name) for name in ("die", "mill"))
        assert peaks_said(overlap.text) == pytest.approx([die, mill], abs=5e-4)
        violations = cm.find_violations(diagram, overlap.rule)
        assert ("COLLISION" in overlap.text) == bool(violations)
        assert ("No collision" in overlap.text) == (not violations)
        for line, name in zip(overlap._lines, ("mill", "die"), strict=True):
            angles, heights = data(line).T
            low, high = overlap._time.get_ylim()
            assert low <= np.min(heights) <= np.max(heights) <= high
            moved = np.asarray(diagram.position_mm(name, angles)) - heights
            assert np.allclose(moved / 100, np.round(moved / 100))  # of the mill, whole pitches


def test_a_collision_turns_up_at_once_and_is_named(overlap: OverlapExplorer) -> None:
    overlap.angle.value = 130
    overlap.start.value = 75
    worst = cm.find_violations(overlap.diagram, overlap.rule)[0]
    assert f"COLLISION: the die is 2.14 mm too deep at {worst.angle_deg:.5g} deg" in overlap.text
    for marks in (*overlap._marks, overlap._broken_path):
        marked = data(marks)
        assert np.isnan(marked).all(axis=1).sum() == 2  # one break after each of two arcs
    angles = data(overlap._marks[1])[:, 0]
    assert np.nanmin(angles) == pytest.approx(15.0383, abs=1e-4)
    assert np.nanmax(angles) == pytest.approx(134.9617, abs=1e-4)
    overlap.start.value = 82
    overlap.angle.value = 123
    assert "No collision" in overlap.text
    assert len(data(overlap._broken_path)) == 0


def test_the_button_finds_the_widest_move(overlap: OverlapExplorer) -> None:
    (button,) = [child for child in overlap.children if isinstance(child, ipywidgets.Button)]
    button.click()
    assert overlap.angle.value == pytest.approx(124.9053, abs=1e-4)
    assert overlap.start.value == pytest.approx(80.0947, abs=1e-4)
    assert "No collision. The smallest clearance is 0 mm" in overlap.text
    overlap.margin.value = 0
    assert "No collision" in overlap.text
    button.click()
    assert overlap.angle.value > 125


def test_equal_peaks_are_found_where_the_source_has_them(overlap: OverlapExplorer) -> None:
    overlap.mill_angle.value = 163.267
    overlap.widen()
    assert overlap.angle.value == pytest.approx(115.447, abs=5e-3)
    assert peaks_said(overlap.text) == pytest.approx([0.943, 0.943])


def test_a_refusal_of_the_solver_is_shown_and_nothing_changes(overlap: OverlapExplorer) -> None:
    overlap.start.value = 0  # down and at work in the middle of the mill's move
    before = overlap.angle.value
    overlap.widen()
    assert "No move of the die is free of collision" in overlap.text
    assert overlap.angle.value == before
    overlap.start.value = 150
    assert "No move" not in overlap.text


def test_the_margin_moves_the_forbidden_region(overlap: OverlapExplorer) -> None:
    overlap.margin.value = 3
    assert overlap._region.get_xy() == (0.65, 17)
    assert overlap.rule.when.limit_mm == 17


def test_every_corner_of_the_shares(shares: ShareExplorer) -> None:
    for places in product(["min", "default", "max"], repeat=2):
        set_controls(shares, places)
        diagram = shares.diagram
        assert diagram.overlap() == []
        assert peaks_said(shares.text) == pytest.approx(
            [diagram.peak_acceleration(name) for name in diagram.names], abs=5e-4
        )
        low, high = shares._axes[1].get_ylim()
        for lines in shares._lines:
            values = np.asarray(lines[1].get_ydata(), dtype=float)
            assert low <= values.min() <= values.max() <= high


def test_shares_that_begin_unequal_never_take_more_than_the_turn() -> None:
    wide = make_diagram(make_mill(200, middle_deg=100), make_die(45, down_deg=(250, 300)))
    explorer = cm.explore_shares(wide)
    for places in product(["min", "default", "max"], repeat=2):
        set_controls(explorer, places)
        assert min(move.angle_deg for move in explorer.diagram["die"].moves) >= 10


def test_the_best_share_of_a_turn_without_overlap(shares: ShareExplorer) -> None:
    """Equal peaks: 100/b^2 = 50/d^2 with b + 2 d = 260."""
    shares.mill_angle.value = 260 / (1 + 2**0.5)
    assert peaks_said(shares.text) == pytest.approx([2.167, 2.167])


@pytest.mark.parametrize("explorer", ["overlap", "shares", "scca"])
def test_a_reader_without_a_kernel_gets_picture_and_text(
    explorer: str, request: pytest.FixtureRequest
) -> None:
    shown = request.getfixturevalue(explorer)
    bundle = shown._repr_mimebundle_()
    assert base64.b64decode(bundle["image/png"]) == shown.live.value
    assert bundle["text/plain"] == shown.text


def test_names_are_shown_as_they_are() -> None:
    """A name is text, never markup."""
    mill = cm.indexing_motion("<b>mill</b>", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
    explorer = cm.explore_shares(make_diagram(mill, make_die()))
    assert "&lt;b&gt;mill&lt;/b&gt;" in explorer._shown_text.value
    assert "<b>" not in explorer._shown_text.value


@pytest.mark.parametrize(
    "diagram", [None, "mill", make_diagram(make_die()), make_diagram(make_die(), make_mill())]
)
def test_shares_need_a_mill_and_a_die(diagram: Any) -> None:
    with pytest.raises(cm.InputError, match="cannot be shared out: give a TimingDiagram of an"):
        cm.explore_shares(diagram)


@pytest.mark.parametrize(
    "rule",
    [
        cm.ClearanceRule(cm.beyond("mill", 19), only_while=cm.within("die", 0.65)),
        cm.ClearanceRule(cm.within("die", 19), only_while=cm.within("mill", 0.65)),
        cm.ClearanceRule(cm.beyond("die", 21), only_while=cm.within("mill", 0.65)),
    ],
    ids=str,
)
def test_the_overlap_needs_a_rule_of_its_kind(rule: cm.ClearanceRule) -> None:
    with pytest.raises(cm.InputError, match="cannot be explored: give one in which"):
        cm.explore_overlap(DIAGRAM, rule, contact_mm=20)


def test_a_die_that_turns_back_at_once_can_be_explored() -> None:
    """It has no dwell at the bottom, which the explorer would have to keep."""
    die = cm.motion(
        "die",
        cm.rise(50, over_deg=55),
        cm.return_(50, over_deg=55),
        cm.dwell(250),
        start_deg=200,
    )
    explorer = cm.explore_overlap(make_diagram(make_mill(), die), RULE, contact_mm=20)
    explorer.widen()
    assert "No collision" in explorer.text
    assert explorer.angle.value > 55


def limits_of(scca: SccaExplorer) -> list[tuple[float, float]]:
    axes: list[Any] = [line.axes for line in scca._lines]
    return [ax.get_ylim() for ax in axes]


def check_scca(scca: SccaExplorer) -> None:
    """Compare what is drawn and said with the law itself."""
    law = scca.law
    for order, (line, limits) in enumerate(zip(scca._lines, limits_of(scca), strict=True)):
        x, heights = data(line).T
        inside = np.isfinite(heights) & (np.min(np.abs(x - joints(scca)), axis=0) > 1e-6)
        assert heights[inside] == pytest.approx(law(x[inside], order), rel=1e-9, abs=1e-9)
        low, high = limits
        assert order == 3 or low <= np.min(heights) <= np.max(heights) <= high
    said = scca.text.splitlines()[1]
    for factor in ("Cv", "Ca", "Cq"):
        assert f"{factor} = {getattr(law, factor):.4g}" in said
    assert (f"Cj = {law.Cj:.4g}," if np.isfinite(law.Cj) else "Cj infinite (A jumps ") in said


def joints(scca: SccaExplorer) -> Any:
    b, c, _ = scca.parts
    first = np.array([0, b / 2, (b + c) / 2, 0.5])
    return np.concatenate([first, 1 - first])[:, np.newaxis]


def test_every_corner_of_the_scca_triangle(scca: SccaExplorer) -> None:
    limits = limits_of(scca)
    for places in [*product(["min", "default", "max"], repeat=2), ("default", "default")]:
        set_controls(scca, places)
        check_scca(scca)
        assert limits_of(scca) == limits


def test_a_law_between_the_named_ones(scca: SccaExplorer) -> None:
    scca.b.value, scca.c.value = 0.1, 0.3
    check_scca(scca)
    assert scca.text.splitlines() == [
        "b = 0.1, c = 0.3, d = 0.6",
        "Cv = 1.732, Ca = 4.646, Cj = 145.9, Cq = 5.184",
        "Ca is 1.161 times the least that is possible, 4",
    ]
    assert scca._note.get_text() == "peak 145.9 cut off"
    assert scca.law.name == "SCCA(0.1, 0.3, 0.6)"
    assert data(scca._point)[0] == pytest.approx([0.3 / 2 + 0.6, 0.3 * 3**0.5 / 2])


@pytest.mark.parametrize(
    ("number", "first", "jerk"),
    [
        (0, "b = 0, c = 1, d = 0: constant acceleration, also called parabolic", (0, 0.5, 1)),
        (1, "b = 0, c = 0, d = 1: simple harmonic, also called cosine", (0, 1)),
        (2, "b = 0.25, c = 0.5, d = 0.25: modified trapezoid, also called modified tr", ()),
        (3, "b = 0.25, c = 0, d = 0.75: modified sine, also called modified sinusoidal", ()),
        (4, "b = 0.5, c = 0, d = 0.5: cycloidal, also called inclined sine or Bestehorn", ()),
    ],
)
def test_the_buttons_set_the_named_laws(
    scca: SccaExplorer, number: int, first: str, jerk: tuple[float, ...]
) -> None:
    scca.b.value = 0.8  # so that no button finds its law already set
    (row,) = [child for child in scca.children if type(child) is ipywidgets.HBox]
    button = row.children[number]
    button.click()
    assert scca.text.startswith(first)
    check_scca(scca)
    named = cm.LAWS[button.description]
    assert (scca.law.name, scca.law.also_called) == (named.name, named.also_called)
    assert scca.law(0.3) == pytest.approx(named(0.3))
    ups = data(scca._jumps)[1::3]
    assert tuple(place for place, height in ups if height) == jerk
    assert [np.sign(height) for place, height in ups if height] == [
        np.sign(size) for _, size in named.jerk_impulses
    ]


def test_where_the_acceleration_jumps_a_line_stands(scca: SccaExplorer) -> None:
    scca.choose("constant acceleration")
    x, heights = data(scca._lines[2]).T
    for place, sides in ((0, {0, 4}), (0.5, {4, -4}), (1, {-4, 0})):
        assert {*np.round(heights[x == place], 12)} == sides
    assert "(A jumps at the ends and in the middle)" in scca.text
    assert scca.text.endswith("Ca is the least that is possible, 4")
    scca.choose("simple harmonic")
    assert "Cj infinite (A jumps at the ends)," in scca.text
    scca.b.value = 1
    assert "Cj infinite (A jumps in the middle)," in scca.text


def test_the_other_part_gives_way_and_the_figure_is_drawn_once(
    scca: SccaExplorer, monkeypatch: pytest.MonkeyPatch
) -> None:
    drawn: list[Any] = []
    monkeypatch.setattr(scca.live, "refresh", lambda: drawn.append(scca.parts))
    scca.c.value = 0.8  # b was 0.5
    assert drawn == [pytest.approx((0.2, 0.8, 0))]
    assert [scca.b.value, scca.b.slider.value] == pytest.approx([0.2, 0.2])
    scca.b.value = 0.7
    assert drawn[1:] == [pytest.approx((0.7, 0.3, 0))]
    scca.b.slider.value = 0.4  # nothing has to give way
    assert drawn[2:] == [pytest.approx((0.4, 0.3, 0.3))]
    scca.choose("modified trapezoid")
    assert drawn[3:] == [(0.25, 0.5, 0.25)]
    scca.c.value = 1
    scca.b.value = 0.123456789012345  # between the steps, and 1 less it is no round number
    assert drawn[4:] == [(0, 1, 0), pytest.approx((0.123456789012345, 0.876543210987655, 0))]
    assert drawn[-1][2] == 0
    check_scca(scca)


def test_only_named_laws_of_the_family_can_be_chosen(scca: SccaExplorer) -> None:
    with pytest.raises(cm.InputError, match="There is no law of the SCCA family 'cubic': use one"):
        scca.choose("cubic")
