"""The least acceleration of turrets: at which stop they are best is a part of the answer."""

import math
from typing import Any

import numpy as np
import pytest
from turrets import ANGLES, Turret, draw, draw_motion, least_by_trying

import cammotion as cm
from cammotion import ClearanceRule, beyond, within
from cammotion.limits.least import LeastAcceleration, least_acceleration


def make_case(*die: Any, start_deg: float, move_deg: float = 150) -> cm.TimingDiagram:
    """Return a mill with a pitch of 100 mm and a die of these parts."""
    rest = cm.dwell(360 - sum(part.angle_deg for part in die))
    mill = cm.indexing_motion(
        "mill", cm.rise(100, over_deg=move_deg), cm.dwell(360 - move_deg), stops=24
    )
    return cm.TimingDiagram([mill, cm.motion("die", *die, rest, start_deg=start_deg)], 2000)


def near(limit_mm: float) -> ClearanceRule:
    return ClearanceRule(beyond("die", 19), only_while=within("mill", limit_mm))


def single_index(over_deg: float) -> float:
    """Return the peak acceleration of an index by constant acceleration, in m/s2."""
    return 4 * 0.1 / (1.8 * over_deg / 360) ** 2


@pytest.mark.parametrize("cells", [48, 180, 720])
def test_a_die_that_is_down_in_the_middle_of_the_present_move(cells: int) -> None:
    """The mill need not be half-way there: it goes on later, over 158 deg from 192 on."""
    diagram = make_case(
        cm.rise(50, over_deg=2), cm.dwell(120), cm.return_(50, over_deg=2), start_deg=76
    )
    found = least_acceleration(diagram, "mill", near(0.65), still=[(350, 360)], cells=cells)
    assert found.bound <= single_index(158) == pytest.approx(0.641, abs=5e-4)
    assert found.bound <= found.reached <= 1.01 * found.bound
    assert cm.find_violations(found.design, near(0.65)) == ()


def test_a_die_that_is_down_from_before_the_middle_until_after_the_move() -> None:
    """Nothing was possible, it was said; an index from 204 to 350 deg is."""
    diagram = make_case(
        cm.rise(50, over_deg=2), cm.dwell(128), cm.return_(50, over_deg=2), start_deg=70
    )
    found = least_acceleration(diagram, "mill", near(0.65), still=[(350, 360)], cells=180)
    assert found.bound <= found.reached <= single_index(146)
    assert cm.find_violations(found.design, near(0.65)) == ()


def test_a_present_motion_that_breaks_the_rule() -> None:
    """The die is still deep when the mill is half-way: the stop it is at changed there."""
    die = cm.rise(50, over_deg=55), cm.dwell(145), cm.return_(50, over_deg=55)
    diagram = make_case(*die, start_deg=150, move_deg=34)
    assert len(cm.find_violations(diagram, near(13))) == 1
    found = least_acceleration(diagram, "mill", near(13), still=[(350, 360)], cells=48)
    assert found.reached < 2.7
    assert cm.find_violations(found.design, near(13)) == ()


# Against a way that knows nothing of the package


def solve_turret(turret: Turret, **more: Any) -> LeastAcceleration:
    still = [arc[:2] for arc in turret.still]
    return least_acceleration(turret.diagram(), "mill", turret.rules(), still=still, **more)


@pytest.mark.parametrize("seed", range(36))
def test_every_choice_of_stops_tried_is_as_good(seed: int) -> None:
    turret = draw(np.random.default_rng(seed))
    least = least_by_trying(turret)
    try:
        found = solve_turret(turret, cells=90)
    except cm.InputError as refusal:
        assert math.isinf(least) or str(refusal).startswith("On a grid of 9")  # noqa: PT017
        return
    assert least <= found.reached * (1 + 1e-6)
    assert found.bound <= found.reached
    angles = np.linspace(0, 360, 7201)
    assert turret.strays_mm(found.motion.position_mm(angles), angles) < 1e-5
    for start, end, place in turret.still:
        off = found.motion.position_mm(np.linspace(start, end, 9)) - place
        turns = off / (24 * turret.pitch_mm)
        assert turns == pytest.approx(np.round(turns), abs=1e-8)


@pytest.mark.parametrize("seed", [39, 107, 154])
def test_the_finer_the_tried_grid_the_nearer_it_comes(seed: int) -> None:
    """It has no nodes at the ends of arcs, so that it only comes near from below."""
    turret = draw(np.random.default_rng(seed))
    found = solve_turret(turret, cells=180)
    coarse, fine = (least_by_trying(turret, nodes) for nodes in (200, 700))
    assert coarse < fine <= found.reached
    assert found.reached - fine < 0.6 * (found.reached - coarse)


@pytest.mark.parametrize("seed", range(40))
def test_no_motion_made_by_hand_is_below_the_bound(seed: int) -> None:
    rng = np.random.default_rng(seed)
    turret, jerky = draw(rng), bool(rng.random() < 0.5)
    angles = turret.still[0][0] + ANGLES
    drawn = [draw_motion(turret, rng, jerky) for _ in range(300)]
    good = [motion for motion in drawn if not turret.strays_mm(motion[0], angles, 0.26)]
    if not good:
        return
    places, peak, jerk = min(good, key=lambda motion: motion[1])
    more = {"travel_mm": (places.min() - 0.01, places.max() + 0.01)} if seed % 3 == 0 else {}
    try:
        found = solve_turret(turret, cells=90, jerk_limit=jerk * (1 + 1e-9), **more)
    except cm.InputError as refusal:
        assert str(refusal).startswith("On a grid of 9")  # noqa: PT017
        return
    assert found.bound <= peak * (1 + 1e-6)
