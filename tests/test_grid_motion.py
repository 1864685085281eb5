"""A motion on a grid: what it does inside its cells, and the segments that are made of it."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from machines import Array

import cammotion as cm
from cammotion.limits.corridors import Corridor
from cammotion.limits.grid_motion import GridMotion

DIE = cm.motion("die", cm.rise(9, over_deg=90), cm.return_(9, over_deg=270))


def make_room(
    angles: list[float], still: list[int], heights: list[float], pitch: float = 0
) -> Corridor:
    """Return a corridor that is free but where the motion stands at some nodes."""
    low, high = (np.full(len(angles), side * math.inf) for side in (-1, 1))
    low[still] = high[still] = heights
    flags = np.isin(np.arange(len(angles)), still)
    return Corridor(np.array(angles), low, high, flags, pitch)


def integrate(
    pushes: Sequence[float], seconds: Array, start: float, ends: Array | None = None
) -> GridMotion:
    """Return the motion from rest with these accelerations over the cells."""
    starting = np.array(pushes, dtype=float)
    ending = starting if ends is None else ends
    places, speeds = [start], [0.0]
    for h, a, b in zip(seconds, starting, ending, strict=True):
        places.append(places[-1] + speeds[-1] * h + h**2 * (a / 3 + b / 6))
        speeds.append(speeds[-1] + h * (a + b) / 2)
    return GridMotion(seconds, np.array(places[:-1]), np.array(speeds[:-1]), starting, ending)


EVEN = np.full(8, 0.25)  # eight cells of 45 deg in a turn of 2 s
ANGLES = [45.0 * n for n in range(8)]


def test_a_parabola_up_and_a_parabola_down() -> None:
    """Up by 16 from 0 to 90 deg, standing until 180, down from there to 270."""
    curve = integrate([256, -256, 0, 0, -256, 256, 0, 0], EVEN, 3)
    room = make_room(ANGLES, [0, 2, 3, 4, 6, 7], [3, 19, 19, 19, 3, 3])
    found = curve.build(DIE, room)
    assert [(s.kind, s.from_deg, s.to_deg, s.from_mm, s.to_mm) for s in found.segments] == [
        ("rise", 0, 90, 3, 19),
        ("dwell", 90, 180, 19, 19),
        ("return", 180, 270, 19, 3),
        ("dwell", 270, 360, 3, 3),
    ]
    for move in found.moves:
        assert isinstance(move.law, cm.MotionLaw)
        assert move.law.Ca == pytest.approx(4, rel=1e-12)
        assert move.law(0.25) == pytest.approx(0.125, rel=1e-12)
    assert curve.strays(room) == pytest.approx(np.zeros(8))


def test_accelerations_that_are_ramps() -> None:
    """Ramps from 0 to 384 and back, and from there to -384 and back: four cells, four corners."""
    starts, ends = [0, 384, 0, -384, 0, 0, 0, 0], np.array([384, 0, -384, 0, 0, 0, 0, 0.0])
    curve = integrate(starts, EVEN, 0, ends)
    room = make_room(ANGLES, [0, 4, 5, 6, 7], [0, 48, 48, 48, 48], 48)
    mill = cm.indexing_motion("mill", cm.rise(48, over_deg=180), cm.dwell(180), stops=6)
    [move] = curve.build(mill, room).moves
    assert isinstance(move.law, cm.MotionLaw)
    assert move.law.Ca == pytest.approx(8)
    assert move.law.Cj == pytest.approx(32)
    assert len(move.law.curve.branches) == 3  # of ramp, ramp, ramp: the middle two are one line
    assert curve.strays(room) == pytest.approx(np.zeros(8))


def test_a_motion_that_comes_back_is_cut_at_its_far_end() -> None:
    """It turns between two cells, where a rounding may hide the turn from both."""
    for shift in (0.0, 1e-11, -1e-11):
        curve = integrate([-64, 64, 64, -64, 0, 0, 0, 0], EVEN, 50)
        curve.velocity[1:3] += -shift, shift
        room = make_room(ANGLES, [0, 4, 5, 6, 7], [50] * 5)
        found = curve.build(DIE, room)
        assert [s.kind for s in found.segments] == ["return", "rise", "dwell"]
        assert [s.to_deg for s in found.segments] == pytest.approx([90, 180, 360])
        assert found.segments[0].to_mm == pytest.approx(46)


def test_a_motion_that_is_twice_as_far_away_is_cut_at_the_first_place() -> None:
    """Down by 4 mm, up by 1, down by 1 and back; the solver rounds either place by a little."""
    seconds = np.array([0.25, 0.25, 0.125, 0.25, 0.125, 0.25, 0.25, 0.5])
    for shift in (0.0, 1e-9, -1e-9):
        curve = integrate([-64, 64, 32, -32, 32, 64, -64, 0], seconds, 50)
        curve.position[5] += shift
        angles = [0.0, *(np.cumsum(seconds)[:-1] * 180)]
        found = curve.build(DIE, make_room(angles, [0, 7], [50, 50]))
        assert [s.kind for s in found.segments] == ["return", "rise", "dwell"]
        assert found.segments[0].to_deg == pytest.approx(90)


def test_a_motion_that_stays_where_it_is_has_no_moves() -> None:
    curve = integrate([0] * 8, EVEN, 50)
    room = make_room(ANGLES, [0, 1, 4], [50] * 3)
    found = curve.build(DIE, room)
    assert [(s.kind, s.angle_deg, s.from_mm) for s in found.segments] == [("dwell", 360, 50)]
    assert found.start_deg == 45  # where the first stretch begins, in which it might move


def test_what_a_solver_rounds_is_put_right() -> None:
    """With accelerations that are wrong by a millionth the law still ends where it has to."""
    wrong = [256 * (1 + 1e-6), -256, 0, 0, -256, 256 * (1 - 2e-6), 0, 0]
    curve = integrate(wrong, EVEN, 3)
    room = make_room(ANGLES, [0, 2, 3, 4, 6, 7], [3, 19, 19, 19, 3, 3])
    for move in curve.build(DIE, room).moves:
        assert isinstance(move.law, cm.MotionLaw)
        ends = np.array([0.0, 1.0])
        assert move.law(ends) == pytest.approx([0, 1], abs=1e-14)
        assert move.law(ends, 1) == pytest.approx([0, 0], abs=1e-12)
        assert move.law.Ca == pytest.approx(4, rel=2e-6)


def test_what_begins_without_acceleration_still_does_when_it_is_put_right() -> None:
    starts = [0, 384 * (1 + 1e-6), 0, -384, 0, 0, 0, 0]
    ends = np.array([384 * (1 + 1e-6), 0, -384, 0, 0, 0, 0, 0])
    curve = integrate(starts, EVEN, 0, ends)
    room = make_room(ANGLES, [0, 4, 5, 6, 7], [0, 48, 48, 48, 48], 48)
    mill = cm.indexing_motion("mill", cm.rise(48, over_deg=180), cm.dwell(180), stops=6)
    [move] = curve.build(mill, room).moves
    assert isinstance(move.law, cm.MotionLaw)
    assert move.law(np.array([0.0, 1.0]), 2) == pytest.approx([0, 0], abs=1e-12)
    assert move.law(1) == 1
    assert move.law(1, 1) == pytest.approx(0, abs=1e-12)


def test_how_far_it_leaves_its_room_between_two_nodes() -> None:
    """It goes up to 4 mm at the end of cell 1 and to 4 + 64/32 half-way ... and comes back."""
    curve = integrate([64, -64, -64, 64, 0, 0, 0, 0], EVEN, 0)
    room = make_room(ANGLES, [0, 4, 5, 6, 7], [0] * 5)
    room.high_mm[1:4] = 3
    strays = curve.strays(room)
    assert strays[[1, 2]] == pytest.approx([1, 1])
    assert strays[[0, 3, 4, 5, 6, 7]] == pytest.approx(np.zeros(6))
    room.high_mm[1:4], room.low_mm[1:4] = math.inf, -math.inf
    mirrored = integrate([-64, 64, 64, -64, 0, 0, 0, 0], EVEN, 0)
    room.low_mm[1:4] = -3
    assert mirrored.strays(room)[[1, 2]] == pytest.approx([1, 1])


def test_a_turret_is_in_the_same_room_a_pitch_further_on() -> None:
    """Its last cell ends in the room of the first node plus a pitch; here it dips by 1 mm."""
    curve = GridMotion(
        EVEN,
        np.array([4, *[16] * 6, 20.0]),
        np.array([16, *[0] * 6, -16.0]),
        np.array([*[0] * 7, 128.0]),
        np.array([*[0] * 7, 128.0]),
    )
    room = make_room(ANGLES, [1, 2, 3, 4, 5, 6], [16] * 6, 16)
    room.low_mm[[0, 7]] = 3.5, 19.5
    assert curve.strays(room)[7] == pytest.approx(0.5)


def test_a_turret_begins_at_a_stop_before_it_begins_in_the_diagram() -> None:
    """A rise from -45 to 45 deg, so that both count the same turns."""
    mill = cm.indexing_motion("mill", cm.rise(16, over_deg=90), cm.dwell(270), stops=6)
    late = GridMotion(
        EVEN,
        np.array([8, *[16] * 7]).astype(float),
        np.array([64, *[0] * 7]).astype(float),
        np.array([-256, *[0] * 6, 256]).astype(float),
        np.array([-256, *[0] * 6, 256]).astype(float),
    )
    room = make_room(ANGLES, [1, 2, 3, 4, 5, 6, 7], [16] * 7, 16)
    found = late.build(mill, room)
    [move] = found.moves
    assert (move.from_deg, move.to_deg, move.from_mm, move.to_mm) == (-45, 45, 0, 16)
    assert found.position_mm([0, 90, 270, 315, 360]) == pytest.approx([8, 16, 16, 16, 24])


def test_a_motion_that_comes_back_is_cut_within_a_cell() -> None:
    """Down for 1/4 s, up for 1/2 s, down for 1/4 s: it turns at 1/2 s, in a cell from 0.4 s on."""
    seconds = np.array([0.25, 0.15, 0.35, 0.25, 0.5, 0.5])
    curve = integrate([-64, 64, 64, -64, 0, 0], seconds, 50)
    angles = [0, 45, 72, 135, 180, 270.0]
    room = make_room(angles, [0, 4, 5], [50] * 3)
    down, up, _ = curve.build(DIE, room).segments
    assert (down.to_deg, down.to_mm) == pytest.approx((90, 46))
    assert (up.from_deg, up.to_deg) == pytest.approx((90, 180))
    for move in (down, up):
        assert isinstance(move.law, cm.MotionLaw)
        assert move.law.Ca == pytest.approx(4)
        assert move.law(0.5) == pytest.approx(0.5)
