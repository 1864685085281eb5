"""The harmonics of a cycle: known waves, sums by hand, the handbook's cam, what Nyquist hides."""

from typing import Any

import numpy as np
import pytest
from machines import Array
from measured_cam import CAM, HALF, INCH_M, RATE, turn

import cammotion as cm


def sum_of(waves: dict[int, tuple[float, float]], angle: Array) -> Array:
    each = [a * np.cos(np.radians(k * angle - p)) for k, (a, p) in waves.items()]
    return np.asarray(np.sum(each, axis=0))


@pytest.mark.parametrize(("number", "start"), [(36, 0.0), (37, 0.0), (36, 7.0), (720, -33.0)])
def test_known_waves_are_found(number: int, start: float) -> None:
    angle = turn(number, start)
    waves = {1: (9.0, 20.0), 4: (0.7, -110.0), 17: (0.02, 75.0)}
    y = 12 + sum_of(waves, angle)
    found = cm.harmonics(cm.CamTable(angle, y, is_cycle=True))
    assert found.mean_mm == pytest.approx(12)
    for k, (a, p) in waves.items():
        assert (found.amplitude_mm[k - 1], found.phase_deg[k - 1]) == pytest.approx((a, p))
    others = np.delete(found.amplitude_mm, [k - 1 for k in waves])
    assert np.max(others) < 1e-13
    places = np.linspace(-50, 700, 301)
    assert found.rebuilt(17, places) == pytest.approx(12 + sum_of(waves, places))


@pytest.mark.parametrize("number", [8, 9, 10, 36, 101])
def test_all_harmonics_together_are_the_points(number: int) -> None:
    y = np.random.default_rng(number).normal(size=number)
    table = cm.CamTable(turn(number, 3.0), y, is_cycle=True)
    found = cm.harmonics(table)
    assert (len(found.rank), found.nyquist) == (number // 2, number / 2)
    assert np.max(np.abs(found.residual_mm(number // 2, table))) < 1e-12
    power = np.sum(found.amplitude_mm**2) / 2
    if number % 2 == 0:
        power += found.amplitude_mm[-1] ** 2 / 2
    assert power == pytest.approx(np.var(y))  # Parseval


def test_the_harmonics_of_the_handbook_cam() -> None:
    found = cm.harmonics(CAM)
    of_differences = found.acceleration(RATE, "differences") / INCH_M
    order = np.argsort(-of_differences)
    assert [*(order[:3] + 1)] == [4, 3, 1]
    assert of_differences[order[:3]] == pytest.approx([6.03, 5.14, 4.84], abs=5e-3)
    assert [*(order + 1)].index(18) + 1 == 8
    ratio = found.acceleration(RATE)[17] / of_differences[17] / INCH_M
    assert ratio == pytest.approx(np.pi**2 / 4)
    assert ratio == pytest.approx(2.47, abs=5e-3)


def test_a_mirrored_cam_has_cosines_only() -> None:
    found = cm.harmonics(CAM)
    strong = found.amplitude_mm > 1e-9
    assert np.sin(np.radians(found.phase_deg[strong])) == pytest.approx(0, abs=1e-9)
    angle, y = CAM.angle_deg, CAM.position_mm
    sums = [np.mean(y * np.cos(np.radians(k * angle))) * 2 for k in range(1, 18)]
    signs = np.cos(np.radians(found.phase_deg[:17]))
    assert found.amplitude_mm[:17] * signs == pytest.approx(sums)


def test_the_differences_of_the_rebuilt_table_are_its_harmonics() -> None:
    """Each harmonic rebuilt alone and differenced has the amplitude that is said."""
    found = cm.harmonics(CAM)
    said = found.acceleration(RATE, "differences")
    for k in (1, 4, 11, 18):
        alone = np.subtract(*(found.rebuilt(n, CAM.angle_deg) for n in (k, k - 1)))
        off = cm.differences(cm.CamTable(CAM.angle_deg, alone, is_cycle=True), RATE)
        waves = np.abs(np.fft.rfft(off.acceleration))[k] / (36 if k == 18 else 18)
        assert waves == pytest.approx(said[k - 1])
        assert found.acceleration(RATE)[k - 1] == pytest.approx(
            found.amplitude_mm[k - 1] / 1000 * (k * 2 * np.pi / 4) ** 2
        )


def test_the_derivatives_of_what_is_rebuilt() -> None:
    found, places, d = cm.harmonics(CAM), np.linspace(0, 360, 50), 0.01
    before, here, after = (found.rebuilt(9, places + shift) for shift in (-d, 0, d))
    rad = np.radians(d)
    assert found.rebuilt(9, places, 1) == pytest.approx((after - before) / (2 * rad), abs=1e-3)
    bend = (after - 2 * here + before) / rad**2
    assert found.rebuilt(9, places, 2) == pytest.approx(bend, abs=1e-2)


@pytest.mark.parametrize("phase", [0.0, 60.0, 90.0])
def test_at_nyquist_amplitude_and_phase_are_one_number(phase: float) -> None:
    angle = turn(36)
    found = cm.harmonics(
        cm.CamTable(angle, 2 * np.cos(np.radians(18 * angle - phase)), is_cycle=True)
    )
    assert found.amplitude_mm[17] == pytest.approx(2 * np.cos(np.radians(phase)), abs=1e-12)


def test_what_is_above_nyquist_folds_back() -> None:
    angle = turn(36)
    found = cm.harmonics(cm.CamTable(angle, np.cos(np.radians(22 * angle)), is_cycle=True))
    assert np.flatnonzero(found.amplitude_mm > 1e-12) + 1 == pytest.approx([14])


def test_half_a_cam_and_uneven_angles_are_refused() -> None:
    with pytest.raises(cm.InputError, match=r"0 to 180 deg and is no cycle; .* table\.mirrored"):
        cm.harmonics(HALF)
    angle = turn(36)
    angle[5] += 1
    with pytest.raises(cm.InputError, match="angles of the table are uneven; harmonics need"):
        cm.harmonics(cm.CamTable(angle, CAM.position_mm, is_cycle=True))


@pytest.mark.parametrize("number", [-1, 19, 3.0])
def test_a_number_of_harmonics_that_there_is_not(number: float) -> None:
    with pytest.raises(cm.InputError, match=r"number of harmonics is .*; this table has 18"):
        cm.harmonics(CAM).rebuilt(number, 0)  # type: ignore[arg-type]


def test_what_is_left_is_left_of_a_table() -> None:
    with pytest.raises(cm.InputError, match="residual_mm is given table=5: give a CamTable"):
        cm.harmonics(CAM).residual_mm(3, 5)  # type: ignore[arg-type]


@pytest.mark.parametrize("derivative", [3, -1, 1.5, "a", np.array([0, 1])])
def test_a_derivative_that_there_is_not(derivative: Any) -> None:
    with pytest.raises(cm.InputError, match=r"^The derivative "):
        cm.harmonics(CAM).rebuilt(1, [0, 90], derivative)


def test_another_kind_of_acceleration_is_refused() -> None:
    with pytest.raises(cm.InputError, match="kind of acceleration"):
        cm.harmonics(CAM).acceleration(RATE, of="jerk")  # type: ignore[arg-type]


def test_a_rise_of_less_than_half_a_turn_is_mirrored_too() -> None:
    angles = np.arange(0, 100, 10.0)
    table = cm.CamTable(angles, angles**2 / 100, step_mm=0.1).mirrored()
    assert not table.is_cycle
    assert table.step_mm == 0.1
    assert table.angle_deg == pytest.approx(np.arange(0, 190, 10))
    assert table.position_mm == pytest.approx(
        np.minimum(table.angle_deg, 180 - table.angle_deg) ** 2 / 100
    )
    for table in (CAM, cm.CamTable(np.arange(0, 200, 10.0), np.arange(20.0))):
        with pytest.raises(cm.InputError, match=r"(a cycle|190 deg) and cannot be mirrored"):
            table.mirrored()
