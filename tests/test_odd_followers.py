"""What is odd to ask of a follower is refused in a sentence, and whole numbers are whole."""

import re
from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import cammotion as cm

DIE = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
SOFT = cm.MoveResponse(cm.two_masses(8, 2, k1_N_per_mm=900, k2_N_per_mm=400), DIE)
ODD: list[Any] = ["first", None, np.array(["a", "b"]), [1, 2], 1.5, 0, 3, True, np.nan]


@pytest.mark.parametrize("mass", ODD[:1] + ODD[2:], ids=repr)
def test_the_number_of_a_mass_is_one_that_there_is(mass: Any) -> None:
    with pytest.raises(cm.InputError, match=r"^The number of the mass is .*whole number from 1"):
        SOFT.peak_acceleration(mass)


@pytest.mark.parametrize("masses", [5, "ab", [1.5], [], [np.nan], np.array([1, "a"], dtype=object)])
def test_so_are_those_to_be_drawn(masses: Any) -> None:
    with pytest.raises(cm.InputError, match=r"The number of (a|the) mass |masses=.*: give a list"):
        cm.plot_response(SOFT, masses=masses)


@pytest.mark.parametrize("over", [np.array([0.1, 0.0]), (), [1], ("a", "b"), np.array([[1, 2]])])
def test_places_to_look_between_are_two_in_order(over: Any) -> None:
    with pytest.raises(cm.InputError):
        SOFT.peak_acceleration(over=over)


@pytest.mark.parametrize("over", [(-2, -1), (-1, 0)])
def test_before_its_move_a_follower_rests(over: tuple[float, float]) -> None:
    rest = (0.0, over[0])
    assert SOFT.peak_acceleration(over=over) == SOFT.peak_deflection_mm(over=over) == rest
    assert SOFT.force_range_N(over=over) == (rest, rest)


def test_an_array_may_say_where_to_look() -> None:
    asked = SOFT.peak_acceleration(over=np.array([0.0, 0.1]))  # type: ignore[arg-type]
    assert asked == SOFT.peak_acceleration(over=(0.0, 0.1))


@pytest.mark.parametrize("masses", [np.ma.masked, np.array(3.0), 3, "12", None], ids=repr)
def test_masses_are_a_list(masses: Any) -> None:
    with pytest.raises(cm.InputError, match=r"^Of the mass a list is wanted, a number for each"):
        cm.Chain(masses, [900])


@pytest.mark.parametrize("count", [360.5, "many", np.nan])
def test_a_count_of_angles_is_whole(count: Any) -> None:
    angles = np.radians(np.arange(0, 360, 2))
    with pytest.raises(cm.InputError, match="count of angles"):
        cm.lift_from_profile(
            *(50 * np.cos(angles), 50 * np.sin(angles)), follower="flat face", count=count
        )


def test_a_turn_that_is_not_as_the_one_before_is_said_to_be() -> None:
    load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=1, preload_N=30)
    for restitution, turns, is_repeated in ((0.0, 3, True), (0.9, 3, False), (0.9, 2, False)):
        flights = cm.follower_flights(
            cm.EXAMPLE.die, load, 3000, restitution=restitution, turns=turns
        )
        assert (flights.period == 1) is is_repeated
        picture = cm.animate_follower(flights)
        assert ("the turn before was another" in picture.svg) is not is_repeated
        assert ("The turn before was another" in picture.description) is not is_repeated


def test_a_landing_that_throws_it_back_has_no_force_but_its_impact() -> None:
    load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=1, preload_N=30)
    flights = cm.follower_flights(cm.EXAMPLE.die, load, 3000, restitution=0.9)
    pairs = pairwise(flights.flights)
    thrown = [f.lands_at_deg for f, g in pairs if f.lands_at_deg == g.leaves_at_deg]
    assert len(thrown) > 3
    assert not np.any(flights.force_N(thrown))
    stays = cm.follower_flights(cm.EXAMPLE.die, load, 3000)
    assert np.min(stays.force_N([flight.lands_at_deg for flight in stays])) > 0


@pytest.mark.parametrize(
    "chain", [cm.Chain([1], [1], [1e6]), cm.tuned_mass(12, 1e5), cm.tuned_mass(2e6, 0.02)]
)
def test_damping_and_stiffness_as_large_as_you_like(chain: cm.Chain) -> None:
    """So held the mass goes with the cam, and is still there long after."""
    response = cm.MoveResponse(chain, DIE)
    assert response.position_mm(0.1) == pytest.approx(DIE.displacement_mm(0.1), abs=1e-3)
    assert response.position_mm(1e3) == pytest.approx(50, abs=1e-3)


@pytest.mark.parametrize(
    ("chain", "asked", "said"),
    [
        (cm.tuned_mass(12, 0.02), lambda it: it.position_mm(1e20), r"time is 1e\+20 s; it has to"),
        (cm.tuned_mass(1e20, 0.02), lambda it: it.position_mm(0.1), "so stiff or so strongly dam"),
        (
            cm.tuned_mass(12, 0.02),
            lambda it: it.peak_acceleration(over=(0, 1e9)),
            r"can swing 1.2e\+10 times between the places",
        ),
    ],
)
def test_what_is_too_late_or_too_fast_is_refused(
    chain: cm.Chain, asked: Callable[[cm.MoveResponse], object], said: str
) -> None:
    with pytest.raises(cm.InputError, match=said):
        asked(cm.MoveResponse(chain, DIE))


@pytest.mark.parametrize(("swings", "turns", "said"), [(120, 500, 1.08e5), (0.2, 30_000, 1.2e5)])
def test_swings_are_counted_over_all_turns(swings: float, turns: int, said: float) -> None:
    """216 in a turn of 1.8 s, or one in each of 4 segments: the limit held for each of them."""
    start = cm.StartResponse(cm.tuned_mass(swings, 0.02), cm.EXAMPLE.die, 2000)
    with pytest.raises(cm.InputError, match=re.escape(f"can swing {said:.3g} times between")):
        start.peak_acceleration(over=(150, 150 + 360 * turns))
