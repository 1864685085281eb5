"""The Geneva wheel, against the triangle of pin and axes, printed tables and its own samples."""

import math

import numpy as np
import pytest
import sympy as sp

import cammotion as cm

SLOTS = [3, 4, 5, 6, 8, 12, 24]


@pytest.mark.parametrize(
    ("slots", "printed", "digits"), [(3, 31.4, 1), (4, 5.41, 2), (6, 1.35, 2), (8, 0.700, 3)]
)
def test_the_peaks_of_the_handbooks(slots: int, printed: float, digits: int) -> None:
    assert round(cm.Geneva(slots).peak_acceleration, digits) == printed


@pytest.mark.parametrize("slots", SLOTS)
def test_the_wheel_follows_the_pin(slots: int) -> None:
    """The slot points at the pin: its place is that of the pin, seen from the wheel's axis."""
    wheel = cm.Geneva(slots)
    alpha = np.linspace(-wheel.angle_deg / 2, wheel.angle_deg / 2, 4001)
    pin = wheel.ratio * np.exp(1j * np.radians(alpha))
    seen = np.angle(1 - np.conj(pin))  # the driver turns one way, the wheel the other
    assert wheel(alpha) == pytest.approx(seen, abs=1e-14)
    assert wheel(alpha[[0, -1]]) == pytest.approx([-math.pi / slots, math.pi / slots])
    step = math.radians(alpha[1] - alpha[0])
    rate = np.gradient(seen, step)[1:-1]
    assert wheel(alpha, 1)[1:-1] == pytest.approx(rate, abs=2e-5 * wheel.peak_acceleration + 1e-4)
    second = np.diff(seen, 2) / step**2
    assert wheel(alpha, 2)[1:-1] == pytest.approx(second, abs=2e-3 * wheel.peak_acceleration)
    assert wheel.peak_velocity == pytest.approx(wheel(alpha, 1).max(), rel=1e-9)
    assert wheel.peak_acceleration == pytest.approx(abs(wheel(alpha, 2)).max(), rel=1e-4)
    assert wheel.peak_acceleration >= abs(wheel(alpha, 2)).max() * (1 - 1e-12)


@pytest.mark.parametrize("slots", SLOTS)
def test_it_enters_without_velocity_but_with_an_acceleration(slots: int) -> None:
    wheel = cm.Geneva(slots)
    end = wheel.angle_deg / 2
    assert wheel(-end, 1) == pytest.approx(0, abs=1e-15)
    assert wheel(-end, 2) == pytest.approx(math.tan(math.pi / slots))
    assert wheel(end, 2) == pytest.approx(-math.tan(math.pi / slots))
    assert wheel.entry_acceleration == pytest.approx(math.tan(math.pi / slots))
    assert wheel.share_of_turn * 360 == pytest.approx(wheel.angle_deg)


def test_the_place_of_the_peak_is_where_the_derivative_is_zero() -> None:
    a, k = sp.symbols("alpha lambda", positive=True)
    third = sp.diff(sp.atan(k * sp.sin(a) / (1 - k * sp.cos(a))), a, 3)
    for slots in SLOTS:
        wheel = cm.Geneva(slots)
        at = {a: math.radians(wheel.peak_alpha_deg), k: wheel.ratio}
        assert float(third.subs(at)) == pytest.approx(0, abs=1e-9 * wheel.peak_acceleration)


@pytest.mark.parametrize("slots", SLOTS)
def test_as_a_law_it_is_the_same_wheel(slots: int) -> None:
    wheel = cm.Geneva(slots)
    span = math.radians(wheel.angle_deg)
    x = np.linspace(0, 1, 101)
    alpha = wheel.angle_deg * (x - 0.5)
    for order, scale in ((1, span), (2, span**2)):
        known = wheel(alpha, order) * scale * slots / (2 * math.pi)
        assert wheel.law(x, order) == pytest.approx(known, abs=1e-9)
    assert wheel.law(x) == pytest.approx(0.5 + wheel(alpha) * slots / (2 * math.pi), abs=1e-13)
    assert wheel.law.Cv == pytest.approx(wheel.peak_velocity * span * slots / (2 * math.pi))
    assert wheel.law.Ca == pytest.approx(wheel.peak_acceleration * span**2 * slots / (2 * math.pi))
    assert math.isinf(wheel.law.Cj)


@pytest.mark.parametrize("slots", [2, 0, -4, 4.5, 61, math.nan, "eight", None, True])
def test_other_wheels_are_refused(slots: object) -> None:
    with pytest.raises(cm.InputError, match=r"number of slots .*for example 8"):
        cm.Geneva(slots)  # type: ignore[arg-type]


def test_out_of_the_slot_and_other_derivatives_are_refused() -> None:
    wheel = cm.Geneva(4)
    assert wheel.angle_deg == 90
    with pytest.raises(cm.InputError, match="driver angle is 46 deg"):
        wheel(46)
    with pytest.raises(cm.InputError, match="derivative is 3; it has to be a whole number at le"):
        wheel(0, 3)
