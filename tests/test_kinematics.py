"""From N, Bm and hm to tm, v and a: the figures of the source, and how they scale."""

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

import cammotion as cm

DIE = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
strokes = st.floats(0.01, 1e4)
angles = st.floats(0.1, 180)
rates = st.floats(1, 1e5)


def test_the_die_of_the_source() -> None:
    assert cm.cycle_time(2000) == 1.8
    assert cm.indexing_time(55, 2000) == 0.275
    assert cm.peak_acceleration(50, 55, 2000) == pytest.approx(2 * np.pi * 0.050 / 0.275**2)
    assert cm.peak_acceleration(50, 55, 2000) == pytest.approx(4.15417, abs=5e-6)
    assert cm.peak_velocity(50, 55, 2000) == pytest.approx(2 * 0.050 / 0.275)
    assert cm.peak_jerk(50, 55, 2000) == pytest.approx(94.9, abs=0.05)


def test_the_other_designs_of_the_source() -> None:
    assert cm.peak_acceleration(50, 70, 2000) == pytest.approx(2.565, abs=5e-4)
    assert cm.peak_acceleration(50, 124.84, 2000) == pytest.approx(0.8064, abs=1e-4)
    assert cm.peak_acceleration(100, 150, 2000) == pytest.approx(1.117, abs=5e-4)  # the mill


@given(strokes, angles, rates)
def test_twice_the_angle_a_quarter_of_the_acceleration(
    stroke: float, angle: float, rate: float
) -> None:
    once, twice = cm.peak_acceleration(stroke, [angle, 2 * angle], rate)
    assert once / twice == pytest.approx(4, rel=1e-12)


@given(strokes, angles, rates)
def test_twice_the_rate_four_times_the_acceleration(
    stroke: float, angle: float, rate: float
) -> None:
    once, twice = cm.peak_acceleration(stroke, angle, [rate, 2 * rate])
    assert twice / once == pytest.approx(4, rel=1e-12)


@given(strokes, angles, rates)
def test_the_stroke_counts_once(stroke: float, angle: float, rate: float) -> None:
    once, twice = cm.peak_acceleration([stroke, 2 * stroke], angle, rate)
    assert twice / once == pytest.approx(2, rel=1e-12)


@given(strokes, angles, rates)
def test_the_curves_reach_their_peaks_and_no_more(stroke: float, angle: float, rate: float) -> None:
    move = cm.Move(stroke_mm=stroke, angle_deg=angle, rate_per_hour=rate)
    time = np.linspace(0, move.time_s, 1001)
    assert np.abs(move.velocity(time)).max() == pytest.approx(move.peak_velocity)
    assert np.abs(move.acceleration(time)).max() == pytest.approx(move.peak_acceleration)
    assert np.abs(move.jerk(time)).max() == pytest.approx(move.peak_jerk)
    assert move.displacement_mm(move.time_s) == pytest.approx(stroke)


def test_velocity_and_acceleration_are_slopes_in_si_units() -> None:
    """Second differences of the displacement know nothing of the formulas."""
    time = np.linspace(0, DIE.time_s, 2001)
    metres = np.asarray(DIE.displacement_mm(time)) / 1000
    velocity = np.gradient(metres, time, edge_order=2)
    acceleration = np.gradient(velocity, time, edge_order=2)
    assert velocity[5:-5] == pytest.approx(np.asarray(DIE.velocity(time))[5:-5], abs=1e-5)
    assert acceleration[5:-5] == pytest.approx(np.asarray(DIE.acceleration(time))[5:-5], abs=1e-3)


def test_arrays_broadcast_and_scalars_stay_scalars() -> None:
    assert isinstance(cm.indexing_time(55, 2000), float)
    table = cm.peak_acceleration(
        50, np.array([[55.0], [110.0]]), np.array([1000.0, 2000.0, 3000.0])
    )
    assert np.shape(table) == (2, 3)
    assert np.shape(cm.cycle_time([2000])) == (1,)


def test_arrays_that_do_not_fit_together_are_refused() -> None:
    with pytest.raises(cm.InputError, match=r"shapes differ .*angle_deg has \(2,\)"):
        cm.indexing_time([10, 20], [1000, 2000, 3000])
    with pytest.raises(
        cm.InputError, match=r"shapes differ .*stroke_mm has \(2,\), angle_deg has \(3,\)"
    ):
        cm.peak_acceleration([10, 20], [50, 60, 70], 2000)


@given(strokes, angles, rates, st.integers(-4, 4))
def test_a_time_that_misses_the_end_by_its_rounding_is_the_end(
    stroke: float, angle: float, rate: float, last: int
) -> None:
    """angle/360*3600/rate is often a last digit more than the package's own time."""
    move = cm.Move(stroke_mm=stroke, angle_deg=angle, rate_per_hour=rate)
    by_hand = angle / 360 * 3600 / rate
    for end in (by_hand, by_hand * (1 + last * 2.3e-16)):
        assert move.displacement_mm([end, 0])[0] == pytest.approx(stroke, rel=1e-12)
    with pytest.raises(cm.InputError, match=r"^The time is "):
        move.displacement_mm(by_hand * (1 + 1e-9))


@pytest.mark.parametrize(
    ("s", "fix"),
    [
        (2 * cm.x, r"subtract S\(0\), and divide by S\(1\) - S\(0\)"),
        (16 * cm.x**2 * (1 - cm.x) ** 2, "cut it at its top"),
        ((1 + cm.x) / 2, r"subtract S\(0\), and divide by S\(1\) - S\(0\)"),
    ],
)
def test_a_law_that_does_not_go_from_0_to_1_makes_no_move(s: sympy.Expr, fix: str) -> None:
    """Its stroke would be another one; its peaks were infinite, by the jump at its end."""
    law = cm.MotionLaw("mine", s)
    said = rf"^The law 'mine' goes from .*: {fix}"
    with pytest.raises(cm.InputError, match=said):
        cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000, law=law)
    for peak in (cm.peak_velocity, cm.peak_acceleration, cm.peak_jerk):
        with pytest.raises(cm.InputError, match=said):
            peak(50, 55, 2000, law)


def test_a_law_may_be_given_by_name_or_itself() -> None:
    own = cm.MotionLaw("cubic", 3 * cm.x**2 - 2 * cm.x**3)
    assert cm.peak_acceleration(50, 55, 2000, own) == pytest.approx(6 * 0.050 / 0.275**2)
    assert cm.peak_acceleration(50, 55, 2000, cm.LAWS["cycloidal"]) == cm.peak_acceleration(
        50, 55, 2000, "cycloidal"
    )


def test_a_move_is_told_apart_by_what_it_is_and_cannot_change() -> None:
    assert cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000) == DIE
    with pytest.raises(AttributeError):
        DIE.angle_deg = 60  # type: ignore[misc]
