"""A motion law from points: the spline of SciPy, and a law like any other."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from long_arrays import assert_near
from machines import Array, examples
from scipy.interpolate import CubicSpline

import cammotion as cm
from cammotion import LAWS, MotionLaw, law_from_points
from cammotion.laws.reader import cut

CYCLOIDAL = LAWS["cycloidal"]


def table(number: int, law: MotionLaw = CYCLOIDAL) -> tuple[Array, Array]:
    """Return a law at equally spaced places."""
    places = np.linspace(0, 1, number)
    return places, law(places)


def uneven() -> tuple[Array, Array]:
    places = np.array([0, 0.05, 0.2, 1 / 3, 0.41, 0.66, 0.9, 1])
    return places, np.array([0, 0.02, 0.1, 0.31, 0.35, 0.8, 0.97, 1])


TABLES = {"uneven": uneven(), "4": table(4)} | {str(n): table(n) for n in (19, 37, 100)}


@pytest.mark.parametrize("points", TABLES.values(), ids=TABLES)
@pytest.mark.parametrize("slopes", [(0, 0), (0.5, -0.25)])
def test_it_is_the_spline_of_scipy(points: tuple[Array, Array], slopes: Any) -> None:
    law = law_from_points(*points, end_slopes=slopes)
    spline = CubicSpline(*points, bc_type=[(1, slopes[0]), (1, slopes[1])])
    places = np.setdiff1d(np.linspace(0, 1, 4001), points[0])
    for order in range(4):
        scale = np.max(np.abs(spline(places, order)))
        for some in (places, places[::-7]):
            assert_near(law(some, order), spline(some, order), abs=1e-12 * scale)
    assert (law(0.0, 1), law(1.0, 1)) == pytest.approx(slopes, abs=1e-13)


@pytest.mark.parametrize("points", TABLES.values(), ids=TABLES)
def test_it_goes_through_its_points_and_is_smooth_there(points: tuple[Array, Array]) -> None:
    law = law_from_points(*points)
    assert law(points[0]) == pytest.approx(points[1], abs=1e-15)
    assert (law(0.0), law(1.0)) == (0, pytest.approx(1, abs=1e-15))
    assert law.sampled_at == tuple(points[0])
    inner = points[0][1:-1]
    for order in range(3):
        scale = max(1, law.Cj_inside)  # what A changes by from one float to the next
        left, right = law(np.nextafter(inner, 0), order), law(np.nextafter(inner, 1), order)
        assert left == pytest.approx(right, abs=1e-12 * scale if order == 2 else 1e-12)


def test_a_sampled_cycloid_is_nearly_the_cycloid() -> None:
    """The errors of a cubic spline: S by the fourth power of the step, V the third, A the second.

    Half the step leaves a sixteenth, an eighth and a quarter of the error.
    """
    places = np.linspace(0, 1, 20_001)
    coarse, fine = (law_from_points(*table(n)) for n in (37, 73))
    errors = [
        [np.max(np.abs(law(places, n) - CYCLOIDAL(places, n))) for n in range(3)]
        for law in (coarse, fine)
    ]
    assert all(np.less(errors[0], [1e-5, 1e-3, 5e-2]))
    assert np.divide(errors[0], errors[1]) == pytest.approx([16, 8, 4], rel=0.15)
    assert coarse.Cv == pytest.approx(2, rel=1e-4)
    assert coarse.Ca == pytest.approx(2 * np.pi, rel=5e-3)


def test_the_jumps_at_the_ends_are_listed() -> None:
    law = law_from_points(*table(37))
    (start, first), (end, last) = law.jerk_impulses
    assert (start, end) == (0, 1)
    assert (first, last) == pytest.approx((law(0.0, 2), -law(1.0, 2)))
    assert law.Cj == np.inf
    assert law.Cj_inside == pytest.approx(np.max(np.abs(law(np.linspace(0, 1, 5000), 3))))


def test_a_cubic_is_found_again() -> None:
    law = law_from_points(*table(19, LAWS["cubic"]))
    assert (law.Cv, law.Ca, law.Cj_inside) == pytest.approx((1.5, 6, 12))
    assert law.Cq == pytest.approx(LAWS["cubic"].Cq)


@pytest.mark.parametrize("number", [19, 100, 361])
def test_it_is_a_law_like_any_other(number: int) -> None:
    law = law_from_points(*table(number), name="follower")
    assert repr(law) == f"MotionLaw('follower', sampled at {number} points)"
    assert isinstance(law, cm.SampledLaw)
    assert not isinstance(CYCLOIDAL, cm.SampledLaw)
    assert law.is_monotone
    assert law.is_symmetric
    assert len(cut(law.name, law.s)) == number - 1
    ways = np.linspace(0, 1, 51)
    assert law(law.inverse(ways)) == pytest.approx(ways, abs=1e-13)
    assert law.where_above(0.5) == [pytest.approx((0.5, 1))]
    assert cm.peak_acceleration(50, 55, 2000, law) == pytest.approx(4.154, rel=0.02)


def test_the_peaks_are_no_samples() -> None:
    """A cubic's A is straight between two points, so that its peaks lie at points or ends."""
    law = law_from_points(*uneven())
    assert law.Ca == pytest.approx(np.max(np.abs(law(uneven()[0], 2))), rel=1e-13)
    dense = np.linspace(0, 1, 200_001)
    assert law.Cv == pytest.approx(np.max(np.abs(law(dense, 1))), rel=1e-8)
    assert np.max(np.abs(law(dense, 1))) <= law.Cv * (1 + 1e-15)


def test_coarse_points_are_swung_over() -> None:
    law = law_from_points([0, 0.4, 0.5, 0.6, 1], [0, 0, 0.5, 1, 1])
    assert not law.is_monotone
    assert law(np.linspace(0, 1, 1001)).min() < -0.01
    with pytest.raises(cm.InputError, match=r"turns back on its way.*: use where_above"):
        law.inverse(0.5)
    assert law.where_above(1) == [pytest.approx((0.6, 1))]


def test_a_share_of_constant_velocity_is_put_into_it() -> None:
    law = law_from_points(*table(19)).with_constant_velocity(0.5)
    assert law.Cv == pytest.approx(4 / 3, rel=1e-3)


@examples(20)
@given(st.lists(st.tuples(st.floats(0.01, 1), st.floats(0.01, 1)), min_size=3, max_size=40))
def test_any_rising_table_is_a_law(steps: list[tuple[float, float]]) -> None:
    x, s = np.cumsum([(0, 0), *steps], axis=0).T / np.sum(steps, axis=0)[:, None]
    law = law_from_points(x, s)
    assert law(x) == pytest.approx(s, abs=1e-13)
    assert np.max(np.abs(law(np.linspace(0, 1, 999), 1))) <= law.Cv * (1 + 1e-12)
    law.check_way()


GOOD = [0, 0.3, 0.6, 1]


@pytest.mark.parametrize(
    ("x", "s", "said"),
    [
        ([0, 0.6, 0.3, 1], GOOD, r"x of the points is 0\.3 \(at position 2\) after 0\.6; .*: sort"),
        ([0, 0.3, 0.3, 1], GOOD, r"is 0\.3 \(at position 2\) after 0\.3; it has to rise"),
        ([0.1, 0.3, 0.6, 1], GOOD, r"The x of the points goes from 0\.1 to 1; .*: subtract the fi"),
        (GOOD, [0, 0.3, 0.6, 0.9], r"The s of the points goes from 0 to 0\.9; a motion law goes"),
        (GOOD, [0, 0.3, np.nan, 1], r"s of the points is nan \(at position 2\)"),
        (GOOD, [0, 0.3, 50, 1], r"s of the points is 50 \(at position 2\); .* at most 2: give"),
        (
            GOOD,
            [0, 0.3, 2.001, 1],
            r"s of the points is 2\.001 \(at position 2\); .* at most 2: giv",
        ),
        (
            GOOD,
            [0, -1.001, 0.6, 1],
            r"s of the points is -1\.001 .* number at least -1 and at most",
        ),
        (GOOD, [0, 0.5, 1], r"shape \(4,\) in x and \(3,\) in s: give two lists of the same"),
        ([0, 0.5, 1], [0, 0.5, 1], "with at least 4 numbers each"),
        ([GOOD], [GOOD], r"are an array of shape \(1, 4\) in x"),
        (GOOD, ["a"] * 4, "s of the points has to be a number"),
        ([], [], "x of the points is empty"),
        (0.5, 0.5, r"are an array of shape \(\) in x"),
    ],
)
def test_points_that_are_no_law_are_refused(x: Any, s: Any, said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        law_from_points(x, s)


def test_points_may_lie_far_out_and_slopes_be_steep() -> None:
    law = law_from_points(GOOD, [0, -1, 2, 1], end_slopes=(-100, 100))
    assert law([0, 0.3, 0.6, 1]) == pytest.approx([0, -1, 2, 1])
    assert law([0, 1], 1) == pytest.approx([-100, 100])


@pytest.mark.parametrize("slopes", [(0,), 0, (0, 1e9), (0, None), (0, 100.1), (-100.1, 0)])
def test_other_end_slopes_are_refused(slopes: Any) -> None:
    with pytest.raises(cm.InputError, match=r"end_slopes have to be|velocity V at an end"):
        law_from_points(GOOD, GOOD, end_slopes=slopes)


def test_the_points_themselves_are_left_alone() -> None:
    x, s = np.array(GOOD, float), np.array([1e-14, 0.3, 0.6, 1])
    law_from_points(x, s)
    assert s[0] == 1e-14
