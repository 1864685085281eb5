"""The smoothing spline, by its definition: least squares over a dense basis, SciPy, Monte Carlo."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import Array, examples
from measured_cam import CAM, HALF, RATE, turn
from scipy.interpolate import BSpline, CubicSpline, make_smoothing_spline

import cammotion as cm
from cammotion.measured.smoother import AnyPoints, EvenCycle, chosen_amount, score

PAIR: Any = np.array([0, 1])


def cost(table: cm.CamTable, values: Array, amount: float) -> float:
    """Return what the smoothing spline has least, of the spline through some values."""
    places, closed = np.radians(table.angle_deg), values
    if table.is_cycle:
        places, closed = np.append(places, places[0] + 2 * np.pi), np.append(values, values[0])
    spline = CubicSpline(places, closed, bc_type="periodic" if table.is_cycle else "natural")
    low, high = spline(places[:-1], 2), spline(places[1:], 2)
    bent = np.sum(np.diff(places) * (low**2 + low * high + high**2) / 3)
    length = places[-1] - places[0]
    return float(np.mean((table.position_mm - values) ** 2) + amount * bent / length)


def uneven(is_cycle: bool) -> cm.CamTable:
    rng = np.random.default_rng(7)
    angle = np.sort(rng.uniform(0, 350, 40))
    y = 20 * np.cos(np.radians(angle)) + rng.normal(0, 0.5, 40)
    return cm.CamTable(angle, y, is_cycle=is_cycle)


def near(by_deg: float, is_cycle: bool = False) -> cm.CamTable:
    """Return a cosine at every tenth degree, and at one place more, next to 100 deg."""
    angle = np.sort([*turn(36), 100 + by_deg])
    return cm.CamTable(angle, 20 - 20 * np.cos(np.radians(angle)), is_cycle=is_cycle)


TABLES = {
    "even cycle": CAM,
    "odd cycle": cm.CamTable(turn(9), np.arange(9.0) % 4, is_cycle=True),
    "uneven cycle": uneven(True),
    "half": HALF,
    "uneven half": uneven(False),
    "near cycle": near(1e-5, is_cycle=True),
}


@pytest.mark.parametrize("amount", [0.0, 1e-3, 1e3])
def test_a_cubic_between_given_slopes_stays_as_it_is(amount: float) -> None:
    """It is the smoothest with these slopes, whatever its ends are."""
    places = np.array([1, 1.3, 2, 2.2, 3, 4.5, 5])
    cubic = np.polynomial.Polynomial([7, -3, 1, 0.5])
    slopes = float(cubic.deriv()(1)), float(cubic.deriv()(5))
    smoother = AnyPoints(places, "clamped", slopes=slopes)
    assert smoother.smoothed(cubic(places), amount) == pytest.approx(cubic(places), rel=1e-9)


def test_what_is_smoothed_alike_is_equal() -> None:
    table = next(iter(TABLES.values()))
    one, again, more = (cm.smoothed(table, amount) for amount in (1e-4, 1e-4, 1e-3))
    assert one == again != more


@pytest.mark.parametrize("table", TABLES.values(), ids=TABLES)
@pytest.mark.parametrize("amount", [1e-6, 1e-4, 1e-1])
def test_no_neighbour_costs_less(table: cm.CamTable, amount: float) -> None:
    """The cost is convex, so that a least place is where no single value's change lowers it."""
    found = cm.smoothed(table, amount)
    values = np.asarray(found.at(table.angle_deg))
    assert values == pytest.approx(found.position_mm)
    least = cost(table, values, amount)
    for n in range(values.size):
        for by in (-1e-3, 1e-3):
            other = values.copy()
            other[n] += by
            assert cost(table, other, amount) > least


@pytest.mark.parametrize(
    "table",
    [HALF, uneven(False), near(1e-4), near(1e-5)],
    ids=["even", "uneven", "near", "very near"],
)
@pytest.mark.parametrize("amount", [1e-7, 1e-4, 1e-1])
def test_with_free_ends_it_is_the_spline_of_scipy(table: cm.CamTable, amount: float) -> None:
    places = np.radians(table.angle_deg)
    weight = amount * places.size / np.ptp(places)
    there = make_smoothing_spline(places, table.position_mm, lam=weight)
    found = cm.smoothed(table, amount)
    assert found.position_mm == pytest.approx(there(places), abs=1e-7)
    omega = 2 * np.pi / 4
    bend = there.derivative(2)(places) * omega**2 / 1000
    assert found.acceleration(RATE) == pytest.approx(bend, abs=1e-6)


def test_scipy_chooses_the_same_amount() -> None:
    rng = np.random.default_rng(3)
    angle = np.linspace(0, 180, 61)
    y = 30 * np.sin(np.radians(angle)) + rng.normal(0, 0.3, 61)
    found = cm.smoothed(cm.CamTable(angle, y))
    there = make_smoothing_spline(np.radians(angle), y)
    assert found.position_mm == pytest.approx(there(np.radians(angle)), abs=2e-3)


@examples(30)
@given(st.integers(8, 60), st.floats(-9, 1), st.integers(0, 10**6))
def test_the_closed_form_of_even_points_is_the_general_one(n: int, log: float, seed: int) -> None:
    values, amount = np.random.default_rng(seed).normal(size=n), 10.0**log
    even = EvenCycle(n)
    general = AnyPoints(2 * np.pi * np.arange(n) / n, "periodic", 2 * np.pi)
    assert np.sort(even.eigenvalues) == pytest.approx(
        np.sort(general.eigenvalues), rel=1e-7, abs=1e-9 * even.eigenvalues.max()
    )
    assert even.smoothed(values, amount) == pytest.approx(
        general.smoothed(values, amount), abs=1e-7
    )
    assert even.spreads(amount) == pytest.approx(general.spreads(amount), rel=1e-6)
    scores = [score(one, one.modes(values), amount) for one in (even, general)]
    assert scores[0] == pytest.approx(scores[1], rel=1e-6)


def test_a_low_harmonic_is_divided_by_one_and_its_fourth_power() -> None:
    angle, amount = turn(3600), 1e-4
    for rank in (1, 10, 20):
        wave = np.cos(rank * np.radians(angle))
        found = cm.smoothed(cm.CamTable(angle, wave, is_cycle=True), amount)
        assert found.position_mm[0] == pytest.approx(1 / (1 + amount * rank**4), rel=1e-6)


def test_an_even_cycle_is_a_penalised_least_square_in_b_splines() -> None:
    """A second way that shares nothing: a basis of splines, their integrals, normal equations."""
    n, amount = 24, 3e-4
    y = np.random.default_rng(11).normal(size=n)
    step = 2 * np.pi / n
    knots = step * np.arange(-3, n + 4)
    basis = [BSpline.basis_element(knots[i : i + 5], extrapolate=False) for i in range(n + 3)]
    places = np.asarray(step * np.arange(n))
    fine = np.asarray(step / 80 + step / 40 * np.arange(n * 40))

    def rows(at: Array, order: int) -> Array:
        each = [b.derivative(order) if order else b for b in basis]
        full = np.nan_to_num(np.array([one(at) for one in each])).T
        return np.asarray(full[:, :n] + np.pad(full[:, n:], ((0, 0), (0, n - 3))))

    value, bend = rows(np.asarray(places), 0), rows(fine, 2)
    # second derivatives are straight between knots: Simpson would be exact, 40 middles are to 1e-3
    normal = value.T @ value / n + amount * bend.T @ bend / fine.size
    f = value @ np.linalg.solve(normal, value.T @ y / n)
    found = cm.smoothed(cm.CamTable(turn(n), y, is_cycle=True), amount)
    assert found.position_mm == pytest.approx(f, abs=1e-3)


@pytest.mark.parametrize("table", [CAM, uneven(True), HALF], ids=["even", "uneven", "half"])
@pytest.mark.parametrize("amount", [0.0, 1e-5, 1e-2])
def test_error_bars_are_those_of_many_readings(table: cm.CamTable, amount: float) -> None:
    rng = np.random.default_rng(1)
    drawn = [
        cm.smoothed(
            cm.CamTable(
                table.angle_deg,
                table.position_mm + rng.normal(0, 0.05, table.position_mm.size),
                is_cycle=table.is_cycle,
            ),
            amount,
        ).acceleration(RATE)
        for _ in range(60)
    ]
    bars = cm.smoothed(table, amount).acceleration_rms(RATE, 0.05)
    assert np.std(drawn, axis=0) == pytest.approx(bars, rel=0.35, abs=1e-9)


def test_error_bars_of_the_spline_through_even_points() -> None:
    """6 e/h^2 exactly, as is derived in the notebook; differences have sqrt(6) e/h^2."""
    angle = turn(360)
    found = cm.smoothed(cm.CamTable(angle, np.cos(np.radians(angle)), is_cycle=True), 0)
    assert found.acceleration_rms(RATE, 0.01) == pytest.approx([6 * 1e-5 / (4 / 360) ** 2] * 360)


def test_the_chosen_amount_is_the_least_of_a_fine_scan() -> None:
    smoother = EvenCycle(36)
    modes = smoother.modes(CAM.position_mm)
    scan = [score(smoother, modes, a) for a in 10 ** np.linspace(-9, 3, 20_001)]
    found = chosen_amount(smoother, modes)
    assert score(smoother, modes, found) <= min(scan) * (1 + 1e-12)
    assert cm.smoothed(CAM).amount == found


def test_cross_validation_leaves_each_point_out() -> None:
    """On even points the score is the mean square of what a left-out point is missed by."""
    n, amount = 20, 1e-3
    y = np.random.default_rng(2).normal(size=n)
    smoother = EvenCycle(n)
    missed = []
    for left_out in range(n):
        guess = np.where(np.arange(n) == left_out, 0.0, y)
        for _ in range(300):  # a point on its own curve pulls at nothing
            guess[left_out] = smoother.smoothed(guess, amount)[left_out]
        missed.append(y[left_out] - guess[left_out])
    found = score(smoother, smoother.modes(y), amount)
    assert np.mean(np.square(missed)) == pytest.approx(found, rel=1e-6)


def test_the_reading_error_is_found_again() -> None:
    rng = np.random.default_rng(4)
    angle = turn(720)
    y = 25 * np.cos(np.radians(angle)) + rng.normal(0, 0.02, 720)
    found = cm.smoothed(cm.CamTable(angle, y, is_cycle=True))
    assert found.error_mm == pytest.approx(0.02, rel=0.06)
    truth = -0.025 * np.cos(np.radians(angle)) * (2 * np.pi / 4) ** 2
    off, bars = found.acceleration(RATE) - truth, found.acceleration_rms(RATE)
    assert np.sqrt(np.mean(off**2)) < 2 * bars[0]
    raw = cm.differences(cm.CamTable(angle, y, is_cycle=True), RATE).acceleration - truth
    assert np.std(raw) > 100 * np.std(off)


@pytest.mark.parametrize("amount", [1e-10, 1e-6, 1e-4])
@pytest.mark.parametrize("step", [2, 10])
def test_the_reading_error_is_found_again_however_little_is_smoothed(
    amount: float, step: int
) -> None:
    """Noise that is nearly all left in the points is told by the little that is not."""
    rng, angle = np.random.default_rng(6), turn(360 // step)
    told = []
    for _ in range(60):
        y = 5 * np.cos(np.radians(angle)) + rng.normal(0, 0.02, angle.size)
        told.append(cm.smoothed(cm.CamTable(angle, y, is_cycle=True), amount).error_mm)
    assert np.mean(told) == pytest.approx(0.02, rel=0.06)


def test_the_error_is_over_what_noise_would_lose() -> None:
    """Each unit reading leaves a column of what is smoothed away of any readings."""
    left = [
        unit - cm.smoothed(cm.CamTable(CAM.angle_deg, unit, is_cycle=True), 1e-4).position_mm
        for unit in np.eye(36)
    ]
    found = cm.smoothed(CAM, 1e-4)
    off = np.sum((found.position_mm - CAM.position_mm) ** 2)
    assert found.error_mm == pytest.approx(np.sqrt(off / np.sum(np.square(left))))


def test_points_of_a_smooth_curve_are_left_as_they_are() -> None:
    angle = turn(36)
    found = cm.smoothed(cm.CamTable(angle, np.cos(np.radians(angle)), is_cycle=True))
    assert found.position_mm == pytest.approx(np.cos(np.radians(angle)), abs=1e-6)


def test_velocity_and_angles_between_the_points() -> None:
    found = cm.smoothed(CAM, 1e-4)
    d, omega = 1e-4, 90.0  # deg, deg/s
    slope = (found.at(33 + d) - found.at(33 - d)) / (2 * d) * omega / 1000
    assert found.at(33, 1, rate_per_hour=RATE) == pytest.approx(slope, rel=1e-6)
    bends = found.at([-10, 350, 710], 2, rate_per_hour=RATE)
    assert bends == pytest.approx([found.at(350, 2, rate_per_hour=RATE)] * 3)
    for order in (1, 2):  # a second number was taken for a rate, and the position returned
        with pytest.raises(
            cm.InputError, match=rf"derivative {order} by the time .* give the rate"
        ):
            found.at(33, order)
    assert found.at(33, rate_per_hour=RATE) == found.at(33)
    assert found.acceleration(2 * RATE) == pytest.approx(4 * found.acceleration(RATE))


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (lambda: cm.smoothed(CAM, -1), "amount of smoothing is -1"),
        (lambda: cm.smoothed(CAM, np.nan), "amount of smoothing is nan"),
        (
            lambda: cm.smoothed(HALF, 1).at(181),
            "cam angle is 181 deg; .* at least 0 and at most 18",
        ),
        (
            lambda: cm.smoothed(CAM, 1).at(0, 3, rate_per_hour=RATE),
            "derivative is 3; it has to be a whole",
        ),
        (
            lambda: cm.smoothed(CAM, 1).at(0, PAIR, rate_per_hour=RATE),
            "derivative has to be a sing",
        ),
        (lambda: cm.smoothed(CAM, 1).at(0, 1, rate_per_hour=0), "machine rate is 0"),
        (
            lambda: cm.smoothed(cm.CamTable(np.arange(1001.0), np.arange(1001.0))),
            "There are 1001 points to be smoothed; .* at most 1000: take one of every 2, or give",
        ),
        (
            lambda: cm.smoothed(cm.CamTable(np.arange(3598.0), np.arange(3598.0))),
            "There are 3598 points .*: take one of every 4, or give",
        ),
    ],
)
def test_what_makes_no_sense_is_refused(wrong: Any, said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        wrong()
