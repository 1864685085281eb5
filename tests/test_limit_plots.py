"""What a picture of a limit shades is proved, and the line on it was reached."""

from collections.abc import Iterator
from functools import cache

import matplotlib as mpl
import numpy as np
import pytest
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
def die_with(jerk_limit: float, cells: int = 90) -> LeastAcceleration:
    return cm.least_acceleration(
        EXAMPLE.diagram,
        "die",
        EXAMPLE.rule,
        still=WORK,
        travel_mm=(0, 50),
        jerk_limit=jerk_limit,
        cells=cells,
    )


@cache
def pair_at(mill_deg: float, cells: int = 90) -> tuple[LeastAcceleration, LeastAcceleration]:
    given = EXAMPLE.diagram.with_motion(cm.with_angle(EXAMPLE.mill, mill_deg))
    die = cm.least_acceleration(
        given, "die", EXAMPLE.rule, still=WORK, travel_mm=(0, 50), cells=cells
    )
    mill = cm.least_acceleration(die.design, "mill", EXAMPLE.rule, still=WORK, cells=cells)
    return mill, die


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
    ax = cm.plot_jerk_price(found, named, unlimited=0.52)
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
    ax = cm.plot_front([pair_at(angle) for angle in (160, 130, 145)])
    for angle in (134, 140, 152, 158):
        mill, die = pair_at(angle, 180)
        assert not is_shaded(ax, mill.reached, die.reached)
    for angle in (130, 145):
        mill, die = pair_at(angle)
        assert is_shaded(ax, mill.bound - 1e-3, die.bound - 1e-3)


def test_a_front_shows_designs_beside_what_was_reached() -> None:
    pairs = [pair_at(160), pair_at(130)]
    curve = [(1.0, 0.9), (1.2, 0.8)]
    ax = cm.plot_front(pairs, {"cycloids": curve}, {"balanced": (0.943, 0.943)}, ends=(0.2, 1.6))
    assert ax.get_xlim() == (0.2, 1.6)
    assert ax.get_xlabel() == "peak acceleration of the mill in m/s²"
    assert [*ax.lines[0].get_xdata()] == [mill.reached for mill, _ in pairs]  # type: ignore[misc]
    assert np.array_equal(ax.lines[1].get_xydata(), curve)
    assert "balanced" in [text.get_text() for text in ax.texts]


def test_a_single_result_is_no_curve() -> None:
    with pytest.raises(cm.InputError, match="two different jerk limits"):
        cm.plot_jerk_price([die_with(8.0), die_with(8.0)])
    with pytest.raises(cm.InputError, match="two different jerk limits"):
        cm.plot_jerk_price([die_with(8.0), die_with(np.inf)])
    with pytest.raises(cm.InputError, match="at least two pairs"):
        cm.plot_front([pair_at(130)])
