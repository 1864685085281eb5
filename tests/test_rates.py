"""The rates at which limits are met, against references, closed forms and bisection of samples."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from machines import RULE, Array, make_diagram, make_die, make_mill
from shafts import AT, SHAFT, forces, torque

import cammotion as cm
from cammotion.bracketed import Extreme, largest

SEQUENTIAL = cm.EXAMPLE.diagram
PEAK = 4.15417  # m/s2 of the die without overlap


def test_the_rates_after_the_overlap() -> None:
    """2000 pieces/h become 3857 at the same peak, where the mill limits; balanced they are 4198."""
    overlapped = cm.widest_move(SEQUENTIAL, "die", cm.EXAMPLE.rule).diagram
    first, second = cm.rate_limits(
        overlapped, acceleration_m_per_s2=SEQUENTIAL.peak_acceleration("die")
    )
    assert first.rate_per_hour == pytest.approx(3857, abs=0.5)
    assert (first.mechanism, second.mechanism) == ("mill", "die")
    assert first.at_deg == pytest.approx(37.5)
    wide_mill = make_diagram(make_mill(163.267), make_die())
    balanced = cm.widest_move(wide_mill, "die", RULE).diagram
    for limit in cm.rate_limits(balanced, acceleration_m_per_s2=PEAK):
        assert limit.rate_per_hour == pytest.approx(4198, abs=0.5)


def test_a_peak_of_acceleration_goes_with_the_square() -> None:
    for limit in (0.1, 4.0, 50.0):
        for found in cm.rate_limits(SEQUENTIAL, acceleration_m_per_s2=limit):
            at_rate = SEQUENTIAL.at_rate(found.rate_per_hour)
            assert at_rate.peak_acceleration(found.mechanism) == pytest.approx(limit, rel=1e-12)
            value = at_rate.acceleration(found.mechanism, found.at_deg)
            assert abs(value) == pytest.approx(limit)


def sampled_rate(peak: Callable[[float], float], limit: float) -> float:
    """Return by bisection the rate at which a peak over samples passes a limit."""
    low, high = 0.0, 1e6
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if peak(middle) < limit else (low, middle)
    return low


SOME = AT[::50]


def peak_of(values: Callable[[float], Array]) -> Callable[[float], float]:
    return lambda rate: float(np.abs(values(rate)).max())


@pytest.mark.parametrize("limit", [1000, 1190, 1500, 4000])
def test_the_rate_of_a_force_with_a_spring(limit: float) -> None:
    """Standing still the die takes 1187.7 N; what that leaves of the limit goes with the square."""
    (found,) = cm.rate_limits(SHAFT, force_N={"die": limit})
    expected = sampled_rate(peak_of(lambda rate: forces(SOME, rate)["die"]), limit)
    assert found.rate_per_hour == pytest.approx(expected, rel=1e-4, abs=1e-3)
    assert bool(found.rate_per_hour) == (limit > 1187.7)


@pytest.mark.parametrize("limit", [5, 15, 40, 200])
def test_the_rate_of_a_torque(limit: float) -> None:
    (found,) = cm.rate_limits(SHAFT, torque_N_m=limit)
    expected = sampled_rate(peak_of(lambda rate: torque(SOME, rate)), limit)
    assert found.rate_per_hour == pytest.approx(expected, rel=1e-4, abs=1e-3)
    if expected:
        at = np.array([found.at_deg])
        assert abs(torque(at, found.rate_per_hour)) == pytest.approx(limit, rel=1e-6)


def test_without_springs_force_and_torque_go_with_the_square() -> None:
    shaft = cm.Camshaft(SEQUENTIAL, {"die": cm.FollowerLoad(mass_kg=12)})
    force, moment = cm.rate_limits(shaft, force_N=100, torque_N_m=20)
    assert force.quantity == "force"
    assert force.rate_per_hour == pytest.approx(2000 * math.sqrt(100 / (12 * PEAK)), rel=1e-5)
    speed, most = 2 * math.pi / 1.8, 12 * 0.050**2 / 0.275**3 * 8.1621
    assert moment.rate_per_hour == pytest.approx(2000 * math.sqrt(20 * speed / most), rel=1e-4)


def test_a_spring_is_met_sooner_or_later_than_the_square_says() -> None:
    """A preload of 50 N leaves 50 of 100 N to what pushes up, and gives 150 to what pulls."""
    pressed = cm.Camshaft(SEQUENTIAL, {"die": cm.FollowerLoad(mass_kg=12, preload_N=50)})
    (found,) = cm.rate_limits(pressed, force_N=100)
    assert found.rate_per_hour == pytest.approx(2000 * math.sqrt(50 / (12 * PEAK)), rel=1e-5)


def test_what_no_rate_meets_and_what_every_rate_exceeds() -> None:
    still = cm.TimingDiagram([cm.motion("pin", cm.dwell(360))], 2000)
    (never,) = cm.rate_limits(still, acceleration_m_per_s2=1)
    assert never == cm.RateLimit(math.inf, "acceleration", 1, "pin", None)
    assert str(never) == "at no rate the pin meets the acceleration of 1 m/s²"
    jumping = make_diagram(make_die(law=cm.CONSTANT_VELOCITY))
    (always,) = cm.rate_limits(jumping, acceleration_m_per_s2=1)
    assert always.rate_per_hour == 0
    assert str(always) == "at any rate the die exceeds the acceleration of 1 m/s², at 0 deg"
    preloaded = {"die": cm.FollowerLoad(mass_kg=12, preload_N=100)}
    (standing,) = cm.rate_limits(cm.Camshaft(make_diagram(), preloaded), force_N=100)
    assert str(standing).startswith("at any rate the die exceeds the force of 100 N, at ")
    weighted = cm.FollowerLoad(mass_kg=1, preload_N=50)
    rates = cm.rate_limits(cm.Camshaft(still, {"pin": weighted}), force_N=60, torque_N_m=1)
    assert [limit.rate_per_hour for limit in rates] == [math.inf, math.inf]
    (heavy,) = cm.rate_limits(cm.Camshaft(still, {"pin": weighted}), force_N=40)
    assert heavy.rate_per_hour == 0


def test_who_has_the_largest_part_of_the_torque() -> None:
    alone = cm.Camshaft(SEQUENTIAL, {"die": cm.FollowerLoad(mass_kg=12)})
    assert cm.rate_limits(alone, torque_N_m=40)[0].mechanism == "die"
    heavy = cm.Camshaft(
        SEQUENTIAL, {"die": cm.FollowerLoad(mass_kg=1), "mill": cm.FollowerLoad(mass_kg=90)}
    )
    (found,) = cm.rate_limits(heavy, torque_N_m=40)
    assert "the mill has the largest part of the torque of 40 N m" in str(found)


def test_the_lowest_rate_comes_first_and_its_place_is_in_the_turn() -> None:
    """The die is the second of the motions, and the harder one; its rise ends at 405 deg."""
    late = SEQUENTIAL.with_motion(SEQUENTIAL["die"].shifted(200))
    first, second = cm.rate_limits(late, acceleration_m_per_s2=4)
    assert (first.mechanism, second.mechanism) == ("die", "mill")
    assert first.rate_per_hour < second.rate_per_hour
    assert first.at_deg is not None
    assert 0 <= first.at_deg < 360
    assert abs(late.acceleration("die", first.at_deg)) == pytest.approx(PEAK, rel=1e-5)


def test_a_limit_that_is_met_at_rest_leaves_no_rate() -> None:
    pressed = cm.Camshaft(SEQUENTIAL, {"die": cm.FollowerLoad(mass_kg=12, preload_N=50)})
    assert cm.rate_limits(pressed, force_N=50)[0].rate_per_hour < 0.01


def test_a_rate_at_which_the_limit_is_not_met_is_never_returned(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def missed(function: Any, over: Any) -> Extreme:
        found = largest(function, over)
        return found._replace(value=1.001 * found.value)

    monkeypatch.setattr("cammotion.drive.rates.largest", missed)
    with pytest.raises(cm.WrongAnswerError, match=r"rate_limits has checked .* pieces/h the peak"):
        cm.rate_limits(SHAFT, torque_N_m=60)


@pytest.mark.parametrize(
    ("limits", "said"),
    [
        ({}, "No limit is given: give at least one"),
        ({"acceleration_m_per_s2": 0}, "limit of the acceleration is 0 m/s2"),
        ({"acceleration_m_per_s2": {"dye": 3}}, "There is no motion 'dye': did you mean 'die'"),
        ({"force_N": {"dye": 3}}, "There is no load of a motion 'dye': did you mean 'die'"),
        ({"force_N": -1}, "limit of the force is -1 N"),
        ({"torque_N_m": math.nan}, "limit of the torque is nan N m"),
    ],
)
def test_bad_limits(limits: dict[str, float], said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.rate_limits(SHAFT, **limits)
    with pytest.raises(cm.InputError, match="asked of a diagram, which has no masses"):
        cm.rate_limits(SEQUENTIAL, force_N=3)


@pytest.mark.parametrize("limits", [{"force_N": 5}, {"torque_N_m": 5}, {"force_N": {"die": 5}}])
def test_a_camshaft_without_loads_has_no_force_to_limit(limits: dict[str, Any]) -> None:
    bare = cm.Camshaft(SEQUENTIAL, {})
    with pytest.raises(cm.InputError, match=r"asked of a camshaft without loads: give .* loads"):
        cm.rate_limits(bare, **limits)
    assert cm.rate_limits(bare, acceleration_m_per_s2=4)
