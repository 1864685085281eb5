"""What a picture of a limit shades is proved, and the line on it was reached."""

from collections.abc import Iterator
from functools import cache
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
import sympy as sp
from machines import Array
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.text import Text

import cammotion as cm
from cammotion.limits.least import LeastAcceleration

mpl.use("agg")
EXAMPLE = cm.EXAMPLE
WORK = [(205, 305)]


@pytest.fixture(autouse=True)
def _close_figures() -> Iterator[None]:
    yield
    plt.close("all")


@cache
def die_with(jerk_m_per_s3: float, cells: int = 90) -> LeastAcceleration:
    return cm.least_acceleration(
        EXAMPLE.diagram,
        "die",
        EXAMPLE.rule,
        still=WORK,
        travel_mm=(0, 50),
        jerk_m_per_s3=jerk_m_per_s3,
        cells=cells,
    )


@cache
def least_with(name: str, limit: float, gap: float = 0.03) -> cm.LeastPeak:
    """Return the least peak of the other one where one of mill and die has a limit."""
    return cm.least_peak(
        EXAMPLE.diagram,
        EXAMPLE.rule,
        still={"mill": WORK, "die": WORK},
        travel_mm={"die": (0, 50)},
        weights={name: 0},
        at_most={name: limit},
        gap=gap,
    )


def peaks_of(found: cm.LeastPeak) -> tuple[float, float]:
    assert found.design
    return found.design.peak_acceleration("mill"), found.design.peak_acceleration("die")


def is_shaded(ax: Axes, x: float, y: float) -> bool:
    """Whether a point in the units of the axes is in the grey."""
    (shade,) = ax.collections
    return any(path.contains_point((x, y)) for path in shade.get_paths())


def test_no_motion_lies_in_the_grey_between_two_limits_of_the_jerk() -> None:
    ax = cm.plot_jerk_price([die_with(limit) for limit in (12.0, 6.7, 8.0)])
    for limit in (6.8, 7.2, 7.9, 9.0, 11.0):
        found = die_with(limit, 180)
        assert not is_shaded(ax, limit, found.reached)
        chord = np.interp(limit, [6.7, 8.0, 12.0], [die_with(j).bound for j in (6.7, 8.0, 12.0)])
        assert found.reached < chord  # it would lie in the grey below a chord
    assert is_shaded(ax, 7.9, die_with(8.0).bound - 1e-3)
    assert is_shaded(ax, 6.75, die_with(8.0).bound - 1e-3)


def test_the_line_is_what_was_reached_and_the_orange_what_is_named() -> None:
    found = [die_with(limit) for limit in (8.0, 12.0)]
    named = {"cycloidal": (8.12, 0.806), "MCV50": (49.2, 1.154)}
    ax = cm.plot_jerk_price(found, named, unlimited_m_per_s2=0.52)
    assert [*ax.lines[0].get_ydata()] == [each.reached for each in found]  # type: ignore[misc]
    texts = [text.get_text() for text in ax.texts]
    assert "cycloidal" in texts
    assert "MCV50" not in texts
    assert "jerk without limit: 0.520" in texts
    assert ax.lines[0].get_color() != ax.lines[-1].get_color()


def test_names_of_neighbours_do_not_cover_each_other() -> None:
    named = {"one": (9.0, 0.7), "two": (9.1, 0.701), "three": (9.0, 0.702)}
    ax = cm.plot_jerk_price([die_with(8.0), die_with(12.0)], named)
    ax.figure.draw_without_rendering()  # type: ignore[union-attr]
    boxes = [Text.get_window_extent(text) for text in ax.texts if text.get_text() in named]
    assert not any(one.overlaps(two) for one in boxes for two in boxes if one is not two)


def test_no_pair_of_motions_lies_in_the_grey_of_a_front() -> None:
    ax = cm.plot_front([least_with("mill", 0.7), least_with("die", 0.45), least_with("mill", 0.5)])
    for limit in (0.47, 0.55):
        assert not is_shaded(ax, *peaks_of(least_with("mill", limit)))
    for angle in (150, 163.267, 180):  # cycloids
        given = EXAMPLE.diagram.with_motion(cm.with_angle(EXAMPLE.mill, angle))
        die = cm.widest_move(given, "die", EXAMPLE.rule)
        assert not is_shaded(ax, given.peak_acceleration("mill"), die.peak_acceleration)
    for limit in (0.5, 0.7):
        assert is_shaded(ax, limit - 1e-3, least_with("mill", limit).bound - 1e-3)
    assert is_shaded(ax, least_with("die", 0.45).bound - 1e-3, 0.449)
    assert not is_shaded(ax, least_with("die", 0.45).bound + 1e-3, 0.449)


def test_a_front_shows_designs_beside_what_was_reached() -> None:
    found = [least_with("mill", 0.7), least_with("mill", 0.5)]
    curve = [(1.0, 0.9), (1.2, 0.8)]
    ax = cm.plot_front(
        found, {"cycloids": curve}, {"balanced": (0.943, 0.943)}, ends_m_per_s2=(0.2, 1.6)
    )
    assert ax.get_xlim() == (0.2, 1.6)
    assert ax.get_xlabel() == "peak acceleration of the mill in m/s²"
    assert np.array_equal(ax.lines[0].get_xydata(), sorted(map(peaks_of, found)))
    assert np.array_equal(ax.lines[1].get_xydata(), curve)
    assert "balanced" in [text.get_text() for text in ax.texts]


def test_names_in_a_front_leave_the_axes_as_they_are_and_do_not_cover_each_other() -> None:
    found = [least_with("mill", 0.7), least_with("mill", 0.5)]
    long = "the carton former's left upper folding finger"
    named = {"one": (0.9, 0.9), "two": (0.91, 0.9), "three": (0.9, 0.905), long: (1.4, 0.91)}
    widths = []
    for points in ({}, named):
        ax = cm.plot_front(found, points=points, ends_m_per_s2=(0.2, 1.6))
        ax.figure.draw_without_rendering()  # type: ignore[union-attr]
        widths.append(ax.bbox.width)
    assert widths[1] == pytest.approx(widths[0], rel=1e-3)
    boxes = [Text.get_window_extent(text) for text in ax.texts[1:]]
    assert len(boxes) == 4
    assert not any(one.overlaps(two) for one in boxes for two in boxes if one is not two)
    for box in boxes:
        assert ax.bbox.x0 <= box.x0 < box.x1 <= ax.bbox.x1


def test_a_single_result_is_no_curve() -> None:
    with pytest.raises(cm.InputError, match="two different jerk limits"):
        cm.plot_jerk_price([die_with(8.0), die_with(8.0)])
    with pytest.raises(cm.InputError, match="two different jerk limits"):
        cm.plot_jerk_price([die_with(8.0), die_with(np.inf)])
    with pytest.raises(cm.InputError, match="at least two results"):
        cm.plot_front([least_with("mill", 0.5)])
    alone = cm.least_peak(EXAMPLE.diagram, EXAMPLE.rule, still={"die": WORK}, gap=0.1)
    with pytest.raises(cm.InputError, match="of two mechanisms"):
        cm.plot_front([alone, alone])


DETOUR: Any = {"still": (205, 305), "corners": ((70, 31), (190, 31))}


def points_of(ax: Axes, number: int = 0) -> tuple[Array, Array]:
    """Return x and y of a line."""
    x, y = np.asarray(ax.lines[number].get_xydata(), dtype=float).T
    return x, y


def free_die() -> cm.TimingDiagram:
    """Return the machine with the die of the least peak: two parabolas up and two down."""
    height = 65**2 * 31 / 2425
    ways: Any = {"over_deg": 130, "law": "constant acceleration"}
    parts = cm.return_(height, **ways), cm.rise(height, **ways), cm.dwell(100)
    return EXAMPLE.diagram.with_motion(cm.motion("die", *parts, start_deg=305, start_mm=50))


def test_a_detour_shows_the_height_over_the_angle_from_the_place_it_leaves() -> None:
    ax = cm.plot_detour({"free": free_die()}, "die", **DETOUR)
    u, y = points_of(ax)
    push, back = 31 / 2425, 260 - u
    near = np.minimum(u, back)
    parabola = np.where(near < 65, near**2 / 2, 65**2 - (130 - near) ** 2 / 2) * push
    assert (u[0], u[-1]) == (0, pytest.approx(260, abs=0.3))
    assert y == pytest.approx(parabola, abs=1e-9)
    assert np.interp([70, 190], u, y) == pytest.approx(31, abs=1e-3)
    assert max(y) == pytest.approx(54.01, abs=5e-3)
    labels = [label.get_text() for label in ax.get_xticklabels()]
    assert labels == ["0", "70", "130", "190", "260"]
    (above,) = ax.child_axes
    assert [label.get_text() for label in above.get_xticklabels()] == [
        "305",
        "15",
        "75",
        "135",
        "205",
    ]
    assert is_shaded(ax, 130, 30.9)
    assert not is_shaded(ax, 130, 31.1)
    assert not is_shaded(ax, 69, 10)


def test_a_detour_shows_several_motions_what_was_meant_and_the_acceleration() -> None:
    given = {"cycloid": EXAMPLE.diagram, "free": free_die()}
    ax = cm.plot_detour(given, "die", usual_mm=50, with_acceleration=True, **DETOUR)
    (lower,) = (other for other in ax.figure.axes if other is not ax)
    assert "50 mm" in [text.get_text() for text in ax.texts]
    assert [text.get_text() for text in ax.get_legend().get_texts()] == [*given]  # type: ignore[union-attr]
    u, a = points_of(lower, 1)
    assert np.abs(a) == pytest.approx(0.51134, abs=1e-5)
    assert [np.interp(place, u, a) > 0 for place in (30, 100, 160, 230)] == [1, 0, 0, 1]
    assert points_of(lower)[1].max() == pytest.approx(4.154, abs=5e-3)


def test_a_place_may_be_one_over_the_end_of_the_turn() -> None:
    usual, machine = points_of(cm.plot_detour({"": free_die()}, "die", **DETOUR)), free_die()
    later = machine.with_motion(machine["die"].shifted(100))
    ax = cm.plot_detour({"": later}, "die", **DETOUR | {"still": (305, 45)})
    shown = np.interp(usual[0], *points_of(ax))
    assert shown == pytest.approx(usual[1], abs=0.05)
    assert ax.get_xlim() == (0, 260)


def test_a_detour_needs_a_design() -> None:
    with pytest.raises(cm.InputError, match="no design to draw"):
        cm.plot_detour({}, "die", **DETOUR)


def test_a_weight_is_drawn_and_its_area_shaded() -> None:
    u = sp.Symbol("u")
    ax = cm.plot_weight(sp.Piecewise((65 - u, u < 70), (-5, True)), (u, 0, 130))
    places, heights = points_of(ax)
    assert np.interp([0, 65, 68, 70, 130], places, heights) == pytest.approx([65, 0, -3, -5, -5])
    assert np.trapezoid(np.abs(heights), places) == pytest.approx(2425, rel=1e-4)
    assert is_shaded(ax, 20, 40)
    assert is_shaded(ax, 100, -4)
    assert not is_shaded(ax, 100, 4)
    assert ax.get_xlabel() == "u in deg"
    constant = cm.plot_weight(sp.Integer(3), (u, 0, 130))
    assert {*points_of(constant)[1]} == {3}


def test_the_price_of_a_jerk_is_that_of_one_mechanism() -> None:
    other = cm.least_acceleration(
        EXAMPLE.diagram, "mill", EXAMPLE.rule, still=WORK, jerk_m_per_s3=12, cells=60
    )
    with pytest.raises(cm.InputError, match="of one mechanism, and these results are for 2"):
        cm.plot_jerk_price([die_with(8), other])
