"""What notebook 09 says of its numbers, by NumPy alone, without the package's measured room."""

import math

import numpy as np
import pytest
from machines import Array
from measured_cam import SHOWN
from scipy.interpolate import CubicSpline
from test_claims import says

HALF = np.array([*map(float, SHOWN.split())])
Y = np.concatenate([HALF, HALF[-2:0:-1]])
"""The table in inches, mirrored by hand."""
DT = 4 / 36
BENT = (np.roll(Y, 1) - 2 * Y + np.roll(Y, -1)) / DT**2
WAVES = np.abs(np.fft.rfft(BENT)) / np.array([36, *[18] * 17, 36])
CUT = np.abs(np.fft.rfft(Y)) / np.array([36, *[18] * 17, 36])


def spline(values: Array) -> list[float]:
    """Return the acceleration in in/s² at the points of the periodic spline through all values."""
    closed = CubicSpline(np.arange(37) * DT, np.append(values, values[0]), bc_type="periodic")
    return [float(one) for one in closed(np.arange(36) * DT, 2)]


def bending() -> tuple[Array, Array]:
    """Return second derivatives by rad of the spline, by its points, and the mean of their square.

    The square of a piece that is straight has the mean (g0² + g0 g1 + g1²)/3.
    """
    knots = np.arange(37) * math.radians(10)
    each = [CubicSpline(knots, np.append(row, row[0]), bc_type="periodic") for row in np.eye(36)]
    bends = np.array([one(knots[:-1], 2) for one in each]).T
    gram = (4 * np.eye(36) + np.roll(np.eye(36), 1, 0) + np.roll(np.eye(36), -1, 0)) / 6
    return bends, bends.T @ gram @ bends


def smoothed(amount: float, values: Array) -> list[float]:
    """Return the acceleration of the smoothing spline, from its definition, by a dense solution."""
    bends, rough = bending()
    return [*(bends @ np.linalg.solve(np.eye(36) + amount * rough, values) * (np.pi / 2) ** 2)]


def test_the_acceleration_zigzags() -> None:
    assert (Y[13] - Y[11]) / (2 * DT) < 3.54
    assert BENT[13] - BENT[12] == pytest.approx(11.6, abs=0.05)
    assert says("09", "From 120 to 130 degrees it leaps by 11.6 in/s².")
    assert pytest.approx(90, abs=0.5) == 3.537 * 25.4
    assert 100 * 4 * 0.0005 / DT**2 / np.abs(BENT).max() == pytest.approx(1, abs=0.06)


def test_the_harmonics() -> None:
    order = np.argsort(-WAVES[1:]) + 1
    assert [*order[:3]] == [4, 3, 1]
    assert [*order].index(18) == 7
    assert WAVES[[4, 3, 1, 18]] == pytest.approx([6.03, 5.14, 4.84, 1.30], abs=5e-3)
    assert says("09", "the fourth has 6.03 in/s², the third 5.14, the first 4.84.")
    assert WAVES[18] / WAVES[4] == pytest.approx(1 / 5, abs=0.02)
    by_wave = CUT * (np.arange(19) * np.pi / 2) ** 2
    assert by_wave[18] == pytest.approx(3.20, abs=5e-3)
    assert np.count_nonzero(by_wave > by_wave[18]) == 4
    assert says("09", "from the displacement it would be 3.20 in/s², and fifth")
    assert pytest.approx(2.47, abs=5e-3) == math.pi**2 / 4
    assert CUT[18] == pytest.approx(0.004, abs=1e-12)
    assert says("09", "the 0.004 in of the eighteenth is its amplitude if the wave is a cosine")
    assert len({*HALF}) == 19  # no dwell
    assert np.min(np.diff(HALF)) > 0.07


def test_five_waves_are_enough_for_the_displacement() -> None:
    found = np.fft.rfft(Y)
    found[6:] = 0
    assert np.abs(np.fft.irfft(found) - Y).max() == pytest.approx(0.0254, abs=5e-5)
    assert says("09", "within 0.025 in")


def test_the_reading_error_that_the_points_suggest() -> None:
    """By cross-validation as it is written, on a scan of amounts."""
    _, rough = bending()
    found = []
    for amount in 10 ** np.linspace(-5, -4, 201):
        away = np.eye(36) - np.linalg.inv(np.eye(36) + amount * rough)
        left, free = np.sum((away @ Y) ** 2), np.trace(away)
        found.append((36 * left / free**2, amount, math.sqrt(left / np.sum(away**2))))
    _, amount, error = min(found)
    assert (amount, error) == pytest.approx((3.4e-5, 0.0125), rel=0.02)
    ranks = np.linspace(13, 14, 1001)
    step = math.radians(10)
    factor = 48 * np.sin(ranks * step / 2) ** 4 / (step**4 * (2 + np.cos(ranks * step)))
    assert ranks[np.argmin(np.abs(amount * factor - 1))] == pytest.approx(13.5, abs=0.1)
    rounding = 0.001 / math.sqrt(12)
    assert rounding == pytest.approx(0.0003, abs=2e-5)
    assert 42 < error / rounding < 45
    assert says("09", "The points suggest forty times as much")
    share = r"\left(1 - \frac{1}{1 + \lambda\mu_k}\right)^2"
    assert says("09", rf"of what it took, divided by $\sum{share}$ over all 36.")


def test_what_is_found_in_the_live_figure() -> None:
    zigzag: Array = np.where(np.arange(36) % 2, -0.01, 0.01)
    single: Array = np.where(np.arange(36) == 9, 0.01, 0.0)
    least = 1e-7  # where the slider of the smoothing begins
    assert max(smoothed(least, zigzag)) == pytest.approx(9.7, abs=0.05)
    assert -smoothed(least, single)[9] == pytest.approx(3.5, abs=0.05)
    assert says("09", "±9.7 in/s². A single one makes 3.5 at its place")
    assert max(spline(zigzag)) == pytest.approx(12 * 0.01 / DT**2)
    assert spline(Y)[17] == pytest.approx(-24, abs=0.1) == min(spline(Y))
    for exponent, low, high in ((-3.75, 0.9, 1), (-3.8, 1, 1.1)):
        left = max(smoothed(10**exponent, zigzag))
        assert low < left < high
    lowest = smoothed(10**-3.75, Y)
    assert lowest[17] == pytest.approx(-15.4, abs=0.1)
    assert lowest[18] == min(lowest) == pytest.approx(-15.6, abs=0.1)
    risen = "has come up to −15, without the errors, and the lowest point, −16, is at 180"
    assert says("09", risen)
    few = {}
    for number in (1, 2, 3, 4, 5):
        found = np.fft.rfft(Y)
        found[number + 1 :] = 0
        few[number] = spline(np.fft.irfft(found))
    both = {n: one[0] > 8 and max(one[11:16]) > 8 for n, one in few.items()}
    assert both == {1: False, 2: False, 3: False, 4: False, 5: True}
    assert few[5][0] == pytest.approx(8.7, abs=0.05)
    assert min(few[5][5:13]) == pytest.approx(-8.1, abs=0.05)
    assert few[5][13:15] == pytest.approx([8.6, 8.6], abs=0.05)
    assert max(few[3][10:16]) == pytest.approx(2.2, abs=0.05)
    assert int(np.argmax(few[4][:9])) == 3
    assert says(
        "09", "Of three the second hill has only 2, and of four the first one has moved to 30"
    )


def test_the_resonance() -> None:
    swings = math.sqrt(100 / 0.2547 * 386 / 185) / (2 * math.pi) / 0.25
    ratios, true = np.arange(19) / swings, CUT * (np.arange(19) * np.pi / 2) ** 2
    for damping in (0.01, 0.02, 0.05, 0.1, 0.2):
        loss = 2j * damping * ratios
        gain = np.abs((1 + loss) / (1 - ratios**2 + loss))
        assert np.argmax(gain * true) == 18
    assert says("09", "With each of these dampings the eighteenth is the strongest of all.")
    assert swings / 17 == pytest.approx(1.07, abs=0.005)
    assert says("09", "With a camshaft 7 percent faster the seventeenth meets the follower.")


def test_the_cycloid() -> None:
    assert 2 * math.pi * 4.5 / 2**2 == pytest.approx(7.1, abs=0.05)
    places = np.arange(20_000) / 20_000 * 2 * np.pi
    pushed = 2 * np.pi * 4.5 / 4 * np.sin(2 * places) * np.sign(np.sin(places))
    waves = np.abs(np.fft.rfft(pushed)) / 10_000
    assert waves[17] == pytest.approx(4.5 * 4 / (17**2 - 4), rel=1e-5)
    assert waves[18] < 1e-12
    assert CUT[17] * (17 * np.pi / 2) ** 2 / waves[17] == pytest.approx(11, abs=0.3)
    assert says("09", "the seventeenth harmonic is eleven times smaller than in the table")
    assert 0.001 * (18 * np.pi / 2) ** 2 == pytest.approx(0.80, abs=0.005)


def test_what_reading_errors_make_of_a_harmonic() -> None:
    """Many cams of nothing but errors, 19 readings of them and their mirror."""
    errors = np.random.default_rng(5).normal(0, 0.0125, (19, 40_000))
    waves = np.abs(np.fft.rfft(np.concatenate([errors, errors[-2:0:-1]]), axis=0))
    spread = np.sqrt(np.mean(waves**2, axis=1)) / np.array([36, *[18] * 17, 36])
    assert spread[18] / CUT[18] == pytest.approx(3 / 4, abs=0.03)
    assert says("09", "reading errors of 0.0125 in would make most of it")
    assert spread[17] * (17 * np.pi / 2) ** 2 == pytest.approx(3, abs=0.15)
    assert says("09", "reading errors of 0.0125 in alone would make 3 in/s² there")


def test_beside_the_mirror_a_difference_has_two_readings() -> None:
    errors = np.random.default_rng(6).normal(size=(19, 100_000))
    bent = np.diff(np.concatenate([errors[1:2], errors]), 2, axis=0)
    spread = np.sqrt(np.mean(bent**2, axis=1))
    assert spread[0] ** 2 == pytest.approx(8, rel=0.02)
    assert spread[5] ** 2 == pytest.approx(6, rel=0.02)


def test_a_law_turned_round_has_no_even_harmonics() -> None:
    """Of the constant acceleration, which is anything but smooth."""
    x = np.arange(720) / 720
    rise = np.where(x < 0.5, 2 * x**2, 1 - 2 * (1 - x) ** 2)
    turn = np.concatenate([rise, 1 - rise])
    waves = np.abs(np.fft.rfft(turn))[1:200]
    assert waves[1::2].max() < 1e-9 < waves[::2].min()


def test_the_softest_part_nearly_decides() -> None:
    assert pytest.approx(422, abs=0.5) == 100 / 0.237
    assert says("09", "alone it would have 422 lb/in")


@pytest.mark.parametrize("damping", [0.01, 0.02, 0.05, 0.1, 0.2])
def test_with_the_harmonics_of_the_table_a_slower_cam_shakes_the_follower_less(
    damping: float,
) -> None:
    """All amplitudes of its acceleration together, from half the speed up to that of the lesson."""
    swings, ranks = math.sqrt(100 / 0.2547 * 386 / 185) / (2 * math.pi) / 0.25, np.arange(19)
    shaken = []
    for speed in np.linspace(0.5, 1, 51):
        r = ranks * speed / swings
        gain = np.sqrt((1 + (2 * damping * r) ** 2) / ((1 - r**2) ** 2 + (2 * damping * r) ** 2))
        shaken.append(float(np.sum(CUT * (ranks * speed * np.pi / 2) ** 2 * gain)))
    assert np.all(np.diff(shaken) > 0)
    assert says("09", "a slower cam help too")
