"""Finite differences of a table: closed forms, the handbook's figures, errors tried one by one."""

from itertools import product

import numpy as np
import pytest
from measured_cam import CAM, HALF, INCH_M, RATE, turn

import cammotion as cm


def test_the_figures_of_the_handbook() -> None:
    found = cm.differences(CAM, RATE)
    velocity, acceleration = found.velocity / INCH_M, found.acceleration / INCH_M
    assert velocity.max() == pytest.approx(3.537, abs=5e-4)
    assert found.angle_deg[np.argmax(velocity)] == 60
    assert (acceleration.min(), acceleration.max()) == pytest.approx((-17.172, 12.96), abs=5e-4)
    assert found.angle_deg[[np.argmin(acceleration), np.argmax(acceleration)]] == pytest.approx(
        [170, 0]
    )
    assert found.acceleration_bound(0.0005 * 25.4) / INCH_M == pytest.approx([0.162] * 36)


def test_half_a_cam_has_no_differences_at_its_ends() -> None:
    found, whole = cm.differences(HALF, RATE), cm.differences(CAM, RATE)
    assert found.angle_deg == pytest.approx(np.arange(10, 180, 10))
    assert found.acceleration == pytest.approx(whole.acceleration[1:18])
    assert found.velocity == pytest.approx(whole.velocity[1:18])


@pytest.mark.parametrize("number", [8, 9, 36, 360])
@pytest.mark.parametrize("rank", [1, 3])
def test_a_wave_is_differenced_by_its_closed_form(number: int, rank: int) -> None:
    angle, step, omega = turn(number), 2 * np.pi / number, 2 * np.pi * 1200 / 3600
    table = cm.CamTable(angle, 20 * np.sin(rank * np.radians(angle)), is_cycle=True)
    found = cm.differences(table, 1200)
    slope = 0.020 * np.cos(rank * np.radians(angle)) * np.sin(rank * step) / step * omega
    bend = -table.position_mm / 1000 * (2 * np.sin(rank * step / 2) / step * omega) ** 2
    assert found.velocity == pytest.approx(slope, abs=1e-13)
    assert found.acceleration == pytest.approx(bend, abs=1e-11)


def test_uneven_angles_give_a_parabola_exactly() -> None:
    angle = np.array([0, 3, 4, 9, 11, 12.5, 20, 28, 29])
    found = cm.differences(cm.CamTable(angle, 3 + 0.4 * angle + 0.05 * angle**2), 3600 / 360)
    assert found.velocity == pytest.approx((0.4 + 0.1 * angle[1:-1]) / 1000)  # 1 deg a second
    assert found.acceleration == pytest.approx([0.1 / 1000] * 7)


def test_the_bound_is_the_most_that_any_errors_can_do() -> None:
    """All 3^3 errors of 0 and +-e on three neighbours, even and uneven."""
    for angle in (turn(8), np.array([0, 3, 4, 9, 11, 12.5, 20, 28])):
        table = cm.CamTable(angle, 0 * angle)
        bound = cm.differences(table, RATE).acceleration_bound(0.01)[2]
        velocity = cm.differences(table, RATE).velocity_bound(0.01)[2]
        found, quick = [], []
        for errors in product((-0.01, 0, 0.01), repeat=3):
            readings = np.zeros(8)
            readings[2:5] = errors
            off = cm.differences(cm.CamTable(angle, readings), RATE)
            found.append(abs(off.acceleration[2]))
            quick.append(abs(off.velocity[2]))
        assert (max(found), max(quick)) == pytest.approx((bound, velocity))


@pytest.mark.parametrize(
    ("errors", "times"), [((-1, 1, -1), 4.0), ((0, 1, 0), 2.0), ((1, 1, 1), 0.0)]
)
def test_alternating_errors_a_dip_and_equal_ones(errors: tuple[int, ...], times: float) -> None:
    readings = np.zeros(36)
    readings[9:12] = errors
    off = cm.differences(cm.CamTable(turn(36), readings, is_cycle=True), RATE)
    dt = 4 / 36
    assert abs(off.acceleration[10]) == pytest.approx(times / dt**2 / 1000, abs=1e-12)


def test_random_errors_have_the_stated_mean_square() -> None:
    errors = np.random.default_rng(5).normal(0, 0.01, (2000, 36))
    off = [cm.differences(cm.CamTable(turn(36), each, is_cycle=True), RATE) for each in errors]
    stated, dt = cm.differences(CAM, RATE), 4 / 36
    expected = stated.acceleration_rms(0.01)
    assert expected == pytest.approx([np.sqrt(6) * 1e-5 / dt**2] * 36)
    bends = [each.acceleration for each in off]
    assert np.sqrt(np.mean(np.square(bends))) == pytest.approx(expected[0], rel=0.01)
    expected = stated.velocity_rms(0.01)
    assert expected == pytest.approx([np.sqrt(2) * 1e-5 / (2 * dt)] * 36)
    slopes = [each.velocity for each in off]
    assert np.sqrt(np.mean(np.square(slopes))) == pytest.approx(expected[0], rel=0.01)


@pytest.mark.parametrize("rate", [0, -900, np.nan])
def test_a_cam_that_does_not_turn_is_refused(rate: float) -> None:
    with pytest.raises(cm.InputError, match="machine rate is"):
        cm.differences(CAM, rate)


def test_a_negative_error_is_refused() -> None:
    with pytest.raises(cm.InputError, match=r"reading error is -0\.01 mm"):
        cm.differences(CAM, RATE).acceleration_bound(-0.01)


def test_springs_in_series_of_the_handbook() -> None:
    """100 lb give 0.0012, 0.0165 and 0.237 in; 185 lb hang on them; a quarter turn a second."""
    each = 100 * cm.N_PER_LBF / (np.array([0.0012, 0.0165, 0.237]) * cm.MM_PER_INCH)
    stiffness = cm.springs_in_series(each)
    assert stiffness * cm.MM_PER_INCH / cm.N_PER_LBF == pytest.approx(392.6, abs=0.05)
    frequency = cm.natural_frequency(stiffness, 185 * cm.KG_PER_LB)
    assert frequency == pytest.approx(np.sqrt(392.6 * 386 / 185) / (2 * np.pi), rel=2e-4)
    assert frequency == pytest.approx(4.55, abs=0.01)
    assert cm.critical_harmonic(frequency, RATE) == pytest.approx(18.2, abs=0.05)
    assert pytest.approx(25.4) == cm.MM_PER_INCH
    assert pytest.approx(4.4482216152605) == cm.N_PER_LBF


def test_springs_that_are_none_are_refused() -> None:
    with pytest.raises(cm.InputError, match=r"stiffness of a spring is 0 N/mm \(at position 1\)"):
        cm.springs_in_series([20, 0])
    with pytest.raises(cm.InputError, match="The mass is -1 kg"):
        cm.natural_frequency(20, -1)
    with pytest.raises(cm.InputError, match="natural frequency is 0 Hz"):
        cm.critical_harmonic(0, 900)
