"""The explorers of the timing diagram and of the SCCA family, without a browser."""

from typing import Any

import numpy as np
import pytest
import sympy as sp
from explored import (
    at_corners,
    control_of,
    drawn,
    limits_of,
    lines_of,
    panel_of,
    peaks_said,
    picture_in,
)
from machines import make_diagram, make_die, make_mill

import cammotion as cm
from cammotion.laws.scca_family import NAMED_PARTS, scca_factor
from cammotion.views.explorers.scca import b, c
from cammotion.views.explorers.shares import B_MILL, WORK
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.formulas import inverse

DIAGRAM = make_diagram()
X = np.linspace(0.0003, 0.9997, 401)
SAMPLED = cm.law_from_points(np.linspace(0, 1, 9), np.linspace(0, 1, 9) ** 3, end_slopes=(0, 3))


@pytest.fixture
def shares() -> LiveFigure:
    return cm.explore_shares(DIAGRAM)


@pytest.fixture
def scca() -> LiveFigure:
    return cm.explore_scca()


def check_shares(figure: LiveFigure, given: cm.TimingDiagram) -> None:
    """Compare what is drawn and said with the diagram that the controls stand for."""
    diagram = shared_out(given, *figure.values.values())
    assert diagram.overlap() == []
    assert peaks_said(figure.text)[:2] == pytest.approx(
        [diagram.peak_acceleration(name) for name in diagram.names], abs=5.1e-4
    )
    peaks = {diagram.peak_acceleration(name): name for name in reversed(diagram.names)}
    assert f"larger peak: {peaks[max(peaks)]}, " in figure.text
    at = np.linspace(0.01, 359.9, 301)
    low, high = limits_of(figure, "displacement")
    for motion, line in zip(diagram.motions, lines_of(figure, "displacement"), strict=True):
        heights = drawn(figure, line["y"], at)
        assert low <= np.min(heights) <= np.max(heights) <= high
        moved = np.asarray(motion.position_mm(at)) - heights
        pitches = np.round((moved - motion.start_mm) / motion.pitch_mm) if motion.stops else 0
        stops = motion.start_mm * motion.is_indexing + pitches * motion.pitch_mm
        assert moved == pytest.approx(stops, abs=1e-6)
    for name, line in zip(diagram.names, lines_of(figure, "acceleration"), strict=True):
        wanted = np.asarray(diagram.acceleration(name, at))
        assert drawn(figure, line["y"], at) == pytest.approx(wanted, abs=1e-8 * max(abs(wanted)))


def shared_out(given: cm.TimingDiagram, mill_deg: float, work_deg: float) -> cm.TimingDiagram:
    """Return the diagram with these angles, made by the words of the package."""
    mill, die = given.motions
    (index,), (down, up) = mill.moves, die.moves
    way = (360 - mill_deg - work_deg) / 2
    parts = [
        cm.rise(down.change_mm, over_deg=way, law=down.law),  # type: ignore[arg-type]
        *([cm.dwell(work_deg)] if work_deg else []),
        cm.return_(-up.change_mm, over_deg=way, law=up.law),  # type: ignore[arg-type]
        cm.dwell(mill_deg),
    ]
    place = {"start_deg": index.from_deg, "start_mm": mill.start_mm}
    step = cm.rise(index.change_mm, over_deg=mill_deg, law=index.law)  # type: ignore[arg-type]
    motions = [
        cm.indexing_motion(mill.name, step, cm.dwell(360 - mill_deg), stops=24, **place),
        cm.motion(die.name, *parts, start_deg=index.from_deg + mill_deg, start_mm=die.start_mm),
    ]
    return cm.TimingDiagram(motions, given.rate_per_hour)


SHARED = {
    "the example": DIAGRAM,
    "unequal": make_diagram(make_mill(200, middle_deg=100), make_die(45, down_deg=(250, 300))),
    "much work": make_diagram(make_mill(15, middle_deg=20), make_die(11, down_deg=(38, 360))),
    "a wide mill through 0 deg": make_diagram(
        make_mill(320, middle_deg=355), make_die(15, down_deg=(180, 190))
    ),
    "turning back at once": make_diagram(
        make_mill(middle_deg=700),
        cm.motion("die", cm.rise(50, over_deg=55), cm.return_(50, over_deg=55), cm.dwell(250)),
    ),
    "other heights, laws and names": make_diagram(
        cm.indexing_motion(
            "{0} <b>",
            cm.rise(33, over_deg=100, law=cm.MotionLaw("late {x}", cm.x**3 * (4 - 3 * cm.x))),
            cm.dwell(260),
            stops=24,
            start_mm=20,
            start_deg=-1000,
        ),
        cm.motion(
            "$\\frac$ {name}",
            cm.rise(70, over_deg=60, law="constant acceleration"),
            cm.dwell(30),
            cm.return_(70, over_deg=40, law=SAMPLED),
            cm.dwell(230),
            start_mm=-90,
        ),
    ),
}


@pytest.mark.parametrize("name", SHARED)
def test_every_corner_of_the_shares(name: str) -> None:
    figure = cm.explore_shares(SHARED[name])
    for values in at_corners(figure, B_MILL, WORK):
        assert (360 - sum(values.values())) / 2 >= 10 - 1e-9
        check_shares(figure, SHARED[name])
    assert figure.picture()


def test_the_best_share_of_a_turn_without_overlap(shares: LiveFigure) -> None:
    """Equal peaks: 100/b^2 = 50/d^2 with b + 2 d = 260."""
    shares.values = {B_MILL: 260 / (1 + 2**0.5)}
    assert peaks_said(shares.text)[:2] == pytest.approx([2.167, 2.167])


@pytest.mark.parametrize(
    "diagram", [None, "mill", make_diagram(make_die()), make_diagram(make_die(), make_mill())]
)
def test_shares_need_a_mill_and_a_die(diagram: Any) -> None:
    with pytest.raises(
        cm.InputError,
        match=r"give a timing diagram|cannot be shared out: give a TimingDiagram of an",
    ):
        cm.explore_shares(diagram)


def test_shares_leave_both_ways_their_angle() -> None:
    with pytest.raises(cm.InputError, match="take 345 deg of the turn: leave more than 20 deg for"):
        cm.explore_shares(make_diagram(make_mill(245), make_die(55)))


def test_moves_that_go_on_into_one_another_are_not_shared_out() -> None:
    """No law says the peak of the two alone, and a dwell between them would be a jump."""
    fast = cm.polynomial((0, 0, 0), (1, 1, 0))
    up = cm.rise(50, over_deg=55, law=fast)
    die = cm.motion("die", up, cm.return_(50, over_deg=55, law=cm.MATCHED), cm.dwell(250))
    assert np.isfinite(die.peak(2))
    with pytest.raises(cm.InputError, match="'die' goes from one move into the next without"):
        cm.explore_shares(make_diagram(make_mill(), die))


@pytest.mark.parametrize("explorer", ["shares", "scca"])
def test_a_reader_without_a_kernel_gets_picture_and_text(
    explorer: str, request: pytest.FixtureRequest
) -> None:
    shown = request.getfixturevalue(explorer)
    bundle, _ = shown._repr_mimebundle_()
    assert picture_in(bundle, shown.text) == shown.picture()


def check_scca(figure: LiveFigure) -> None:
    """Compare what is drawn and said with the law itself."""
    b_now, c_now = figure.values[b], figure.values[c]
    law = cm.scca(b_now, c_now, max(0.0, 1 - b_now - c_now))
    joints = np.array([b_now / 2, (b_now + c_now) / 2, 0.5])
    between = X[np.min(np.abs(X - np.concatenate([joints, 1 - joints])[:, None]), axis=0) > 1e-6]
    for order, letter in enumerate("SVAJ"):
        line, *impulses = [
            *lines_of(figure, f"{letter} over"),
            *lines_of(figure, f"{letter} over", "reference"),
        ]
        heights = drawn(figure, line["y"], between)
        assert heights == pytest.approx(law(between, order), rel=1e-9, abs=1e-9)
        low, high = limits_of(figure, f"{letter} over")
        assert order == 3 or low <= np.min(heights) <= np.max(heights) <= high
        shown = [i for i in impulses if figure._now[i["where"]](1.0) > 0]
        found = [(figure._now[i["x"]](0.0), np.sign(figure._now[i["y"]](1.0))) for i in shown]
        jumps = law.jerk_impulses if order == 3 else ()
        assert found == [(place, np.sign(size)) for place, size in jumps]
    said = figure.text.splitlines()[1]
    for factor in ("Cv", "Ca", "Cq"):
        assert f"{factor} = {getattr(law, factor):.4g}" in said
    assert (f"Cj = {law.Cj:.4g}," if np.isfinite(law.Cj) else "Cj infinite (A jumps ") in said


def own_point(figure: LiveFigure) -> list[float]:
    """Return where the point is that can be dragged."""
    points = panel_of(figure, "The triangle")["points"]
    (own,) = [point for point in points if point["drags"]]
    return [float(figure._now[own[axis]]()) for axis in "xy"]


def test_every_corner_of_the_scca_triangle(scca: LiveFigure) -> None:
    for parts in [(0, 0), (0, 1), (1, 0), (0.5, 0.5), (0.5, 0), (0, 0.4), (1e-3, 0.5), (0.2, 0.79)]:
        scca.values = {b: parts[0], c: parts[1]}
        assert [*scca.values.values()] == [*parts]
        check_scca(scca)


def test_a_law_between_the_named_ones(scca: LiveFigure) -> None:
    scca.values = {b: 0.1, c: 0.3}
    check_scca(scca)
    assert scca.text.splitlines() == [
        "b = 0.1, c = 0.3, d = 0.6",
        "Cv = 1.732, Ca = 4.646, Cj = 145.9, Cq = 5.184",
        "Ca is 1.161 times the least that is possible, 4",
    ]
    assert own_point(scca) == pytest.approx([0.3 / 2 + 0.6, 0.3 * 3**0.5 / 2])


def test_the_point_sets_the_two_parts(scca: LiveFigure) -> None:
    """Where the pointer is, x and y, gives b and c, and these bring the point there."""
    scca.values = {b: 0.15, c: 0.25}
    x, y = own_point(scca)
    points = panel_of(scca, "The triangle")["points"]
    (drags,) = [point["drags"] for point in points if point["drags"]]
    assert [scca._now[formula](x, y) for _, formula in drags] == pytest.approx([0.15, 0.25])


def test_the_lines_of_one_ca_are_where_ca_is_that(scca: LiveFigure) -> None:
    levels = lines_of(scca, "The triangle", "reference")
    at, found = np.linspace(0, 1, 201), []
    for line in levels:
        across, up, inside = (drawn(scca, line[what], at) for what in ("x", "y", "where"))
        there = inside > 1e-6
        assert there.any()
        of_c = up[there] * 2 / 3**0.5
        of_d = np.maximum(across[there] - of_c / 2, 0)  # rounding may leave them below 0
        of_b = np.maximum(1 - of_c - of_d, 0)
        factors = np.asarray(scca_factor(of_b, of_d, np.pi))
        assert factors == pytest.approx(factors[0], rel=1e-9)
        found.append(factors[0])
    assert found == pytest.approx([4.2, 4.5, 5, 5.5, 6, 7, 8])


@pytest.mark.parametrize(
    ("name", "first"),
    [
        ("constant acceleration", "b = 0, c = 1, d = 0: constant acceleration, also called par"),
        ("simple harmonic", "b = 0, c = 0, d = 1: simple harmonic, also called cosine"),
        ("modified trapezoid", "b = 0.25, c = 0.5, d = 0.25: modified trapezoid, also called"),
        ("modified sine", "b = 0.25, c = 0, d = 0.75: modified sine, also called modified sin"),
        ("cycloidal", "b = 0.5, c = 0, d = 0.5: cycloidal, also called inclined sine or Best"),
    ],
)
def test_the_buttons_set_the_named_laws(scca: LiveFigure, name: str, first: str) -> None:
    scca.values = {b: 0.8}  # so that no button finds its law already set
    scca.press(name)
    assert scca.text.startswith(first)
    assert [*scca.values.values()] == [*NAMED_PARTS[name][:2]]
    check_scca(scca)
    law = cm.LAWS[name]
    (line,) = lines_of(scca, "S over")
    assert drawn(scca, line["y"], X) == pytest.approx(law(X))


def test_where_the_acceleration_jumps_a_line_stands(scca: LiveFigure) -> None:
    scca.press("constant acceleration")
    (line,) = lines_of(scca, "A over")
    beside = np.array([-1e-6, 1e-6, 0.5 - 1e-6, 0.5 + 1e-6, 1 - 1e-6, 1 + 1e-6])
    assert drawn(scca, line["y"], beside) == pytest.approx([0, 4, 4, -4, -4, 0])
    joints = [float(scca._now[joint]()) for joint in line["joints"]]
    assert {0, 0.5, 1} <= set(joints)
    assert "(A jumps at the ends and in the middle)" in scca.text
    assert scca.text.endswith("Ca is the least that is possible, 4")
    scca.press("simple harmonic")
    assert "Cj infinite (A jumps at the ends)," in scca.text
    scca.values = {b: 1}
    assert "Cj infinite (A jumps in the middle)," in scca.text


def test_the_other_part_gives_way(scca: LiveFigure) -> None:
    scca.values = {c: 0.8}  # b was 0.5
    assert scca.values == pytest.approx({b: 0.2, c: 0.8})
    scca.values = {b: 0.7}
    assert scca.values == pytest.approx({b: 0.7, c: 0.3})
    scca.values = {b: 0.4}  # nothing has to give way
    assert scca.values == pytest.approx({b: 0.4, c: 0.3})
    scca.values = {c: 1}
    scca.values = {b: 0.123456789012345}  # between the steps, and 1 less it is no round number
    assert scca.values == pytest.approx({b: 0.123456789012345, c: 0.876543210987655})
    check_scca(scca)
    assert control_of(scca, b)["high"] == control_of(scca, c)["high"] == 1


def test_what_is_searched_for_can_be_named_in_a_sentence() -> None:
    """SymPy has functions of its own called Inverse, whose printing fails on others."""
    x, depth = sp.symbols("x depth")
    with pytest.raises(cm.InputError, match="contains depth, which is neither the variable nor"):
        cm.explore(x + inverse(x**2, (x, 0, 1), depth), (x, 0, 1))
