"""The motion of one mechanism: where it is over the turns, and what does not make one."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import (
    CURVES,
    DIPPING,
    MONOTONE,
    TURNING,
    WAVY,
    die_mm,
    examples,
    make_die,
    make_mill,
    mill_off_mm,
)

import cammotion as cm
from cammotion import Motion, MotionLaw, Segment
from cammotion.machine.arcs import arcs
from cammotion.machine.parts import Part

DIE, MILL = make_die(), make_mill()
OVERLAPPED = make_die(124.84)  # from 80.16 deg to 429.84, that is 69.84 of the next turn
BACKWARDS = cm.indexing_motion(
    "mill", cm.dwell(100), cm.return_(30, over_deg=120), cm.dwell(140), stops=12, start_mm=5
)
TWO_STEPS = cm.indexing_motion(
    "mill",
    cm.rise(60, over_deg=100),
    cm.dwell(80),
    cm.rise(40, over_deg=100),
    cm.dwell(80),
    stops=6,
    start_mm=0.1,
)
ANGLES = np.linspace(-720, 720, 2881)
cam_angles = st.floats(-1e4, 1e4)


def test_the_die_of_the_source() -> None:
    assert DIE.position_mm([150, 177.5, 205, 305, 332.5, 360]).tolist() == [0, 25, 50, 50, 25, 0]
    assert [segment.kind for segment in DIE.segments] == ["rise", "dwell", "return", "dwell"]
    assert [segment.kind for segment in DIE.moves] == ["rise", "return"]
    assert (DIE.start_deg, DIE.start_mm, DIE.pitch_mm, DIE.range_mm) == (150, 0, 0, (0, 50))
    assert not DIE.is_indexing


@pytest.mark.parametrize("law", [*MONOTONE, *TURNING], ids=str)
def test_positions_and_offsets_agree_with_plain_formulas(law: MotionLaw) -> None:
    curve = CURVES[law.name]
    for width in (55, 124.84):
        die = make_die(width, law=law)
        assert die.position_mm(ANGLES) == pytest.approx(die_mm(ANGLES, width, curve=curve))
        assert die.offset_mm(ANGLES) == pytest.approx(die.position_mm(ANGLES))
    expected = mill_off_mm(ANGLES, curve=curve)
    assert make_mill(law=law).offset_mm(ANGLES) == pytest.approx(expected, abs=1e-9)


def test_an_overlapped_die_comes_up_in_the_next_turn() -> None:
    assert OVERLAPPED.start_deg == pytest.approx(80.16)
    assert OVERLAPPED.segments[2].to_deg == pytest.approx(429.84)
    returning = OVERLAPPED.position_mm([0, 30, 69.84, 75, 80.16])
    assert returning[:2].tolist() == OVERLAPPED.position_mm([360, 390]).tolist()
    assert returning[2:] == pytest.approx(0, abs=1e-9)
    assert returning[0] > returning[1] > 1


@examples(100)
@given(cam_angles, st.integers(-50, 50))
def test_a_motion_that_comes_back_repeats_every_turn(angle: float, turns: int) -> None:
    for die in (DIE, OVERLAPPED):
        here, later = die.position_mm([angle, angle + 360 * turns])
        assert later == pytest.approx(here, abs=1e-9)


@examples(100)
@given(cam_angles)
def test_an_indexing_motion_goes_on_by_its_pitch_each_turn(angle: float) -> None:
    for motion, stops in ((MILL, 24), (BACKWARDS, 12), (TWO_STEPS, 6)):
        positions = motion.position_mm(angle + 360 * np.arange(stops + 1))
        pitches = np.diff(positions) / motion.pitch_mm
        assert pitches % stops == pytest.approx(1)
        closed = abs(positions[-1] - positions[0])  # once around, or just before
        assert min(closed, abs(closed - stops * abs(motion.pitch_mm))) < 1e-9
        offsets = motion.offset_mm(angle + 360 * np.arange(stops))
        assert offsets == pytest.approx(offsets[0], abs=1e-9)


def test_the_mill_moves_on_from_stop_to_stop() -> None:
    assert (MILL.pitch_mm, MILL.stops, MILL.is_indexing) == (100, 24, True)
    assert MILL.position_mm([0, 75, 150, 359.9]).tolist() == [0, 50, 100, 100]
    turns = 360 * np.arange(25)
    assert MILL.position_mm(turns + 200).tolist() == [*range(100, 2500, 100), 100]
    assert MILL.position_mm(-160) == 2400  # the turn before the first is the 24th
    assert MILL.offset_mm(135) == pytest.approx(0.6451, abs=5e-5)
    assert MILL.offset_mm(15) == pytest.approx(MILL.offset_mm(135), abs=1e-12)


def test_an_indexing_motion_may_go_backwards() -> None:
    assert BACKWARDS.pitch_mm == -30
    assert BACKWARDS.position_mm([50, 160, 300, 410]).tolist() == [5, -10, -25, -25]
    assert BACKWARDS.offset_mm([50, 160, 300]).tolist() == [0, 15, 0]
    assert BACKWARDS.where_beyond(0) == [(100, 220)]
    [(start, end)] = BACKWARDS.where_beyond(3)
    assert BACKWARDS.offset_mm([start, end]) == pytest.approx(3)
    assert 100 < start < 160 < end < 220


def test_a_stop_between_two_is_judged_by_the_nearest() -> None:
    assert TWO_STEPS.offset_mm([0, 140, 170, 300]) == pytest.approx([0, 40, 40, 0], abs=1e-9)
    assert TWO_STEPS.offset_mm(360) == 0
    assert TWO_STEPS.where_beyond(0) == [(0, 280)]
    assert len(TWO_STEPS.where_beyond(45)) == 1  # only on the way through the middle


@examples(100)
@given(cam_angles.filter(lambda angle: angle % 10 > 1e-3))
def test_each_derivative_is_the_slope_of_the_one_before(angle: float) -> None:
    step = 1e-4
    seconds = step / 200  # 2000 pieces/h are 200 deg/s
    for motion in (DIE, OVERLAPPED, make_mill(law=MONOTONE[1])):
        curves = [motion.position_mm(angle + np.array([-step, step])) / 1000]
        curves += [motion.derivative(n, [angle - step, angle + step], 2000) for n in (1, 2)]
        for order, (before, after) in enumerate(curves, 1):
            if _has_a_joint(motion, angle, step):
                continue
            slope = (after - before) / (2 * seconds)
            assert motion.derivative(order, angle, 2000) == pytest.approx(slope, abs=2e-4)


def _has_a_joint(motion: Motion, angle: float, near: float) -> bool:
    ends = np.array([segment.to_deg for segment in motion.segments])
    return bool((np.abs((angle - ends + 180) % 360 - 180) <= near).any())


def test_where_two_segments_meet_the_one_that_begins_counts() -> None:
    end = DIE.derivative(3, [204.999999, 205, 305], 2000)
    assert end[0] == pytest.approx(94.9, abs=0.05)
    assert end[1] == 0
    assert end[2] == pytest.approx(-94.9, abs=0.05)
    assert DIE.derivative(3, 150 + 3600, 2000) == DIE.derivative(3, 150, 2000)


def test_shape_and_type_follow_the_angle() -> None:
    for curve in (DIE.position_mm, MILL.position_mm, MILL.offset_mm):
        assert isinstance(curve(30), float)
        assert isinstance(curve(np.int64(30)), float)
        assert curve([30]).shape == (1,)
        assert curve(np.zeros((2, 3))).shape == (2, 3)
    assert isinstance(DIE.derivative(1, 30, 2000), float)
    assert DIE.derivative(2, np.zeros((2, 3)), 2000).shape == (2, 3)


def test_any_finite_angle_is_allowed() -> None:
    assert DIE.position_mm([-1e-20, -10, -1e6, 1e15]).shape == (4,)
    assert DIE.position_mm(-155) == DIE.position_mm(205) == DIE.position_mm(205 + 360 * 10**6) == 50
    assert MILL.offset_mm(-1e-20) == 0


def test_a_law_that_turns_widens_the_range() -> None:
    dip = 50 * DIPPING(4 / 15)  # below the start of the rise, and above that of the return
    assert make_die(law=DIPPING).range_mm == pytest.approx((dip, 50 - dip))
    assert pytest.approx(150 + 55 * 4 / 15) in make_die(law=DIPPING).turning_degs
    low, high = make_die(law=WAVY).range_mm
    positions = make_die(law=WAVY).position_mm(np.linspace(0, 360, 100_001))
    assert (low, high) == pytest.approx((positions.min(), positions.max()), abs=1e-6)


MACHINES = [
    *[make_die(70, law=law) for law in (MONOTONE[0], MONOTONE[6], *TURNING)],
    *[make_mill(law=law) for law in (MONOTONE[0], MONOTONE[7], *TURNING)],
    BACKWARDS,
    TWO_STEPS,
    OVERLAPPED,
]


@pytest.mark.parametrize("motion", MACHINES, ids=lambda motion: str(motion.moves[0].law))
def test_where_it_is_beyond_a_limit_agrees_with_samples(motion: Motion) -> None:
    angles = (np.arange(7200) + 0.5) / 20
    offsets = motion.offset_mm(angles)
    for limit in (-2, -0.4, 0.001, 0.65, 3, 12.3, 19, 31, 47, 49.99, 51, 60):
        found = motion.where_beyond(limit)
        assert found == arcs(found)
        inside = [(low < angles) & (angles < high) for low, high in [*found, (0, 0)]]
        assert np.count_nonzero(np.any(inside, 0) != (offsets > limit)) <= 2


def smaller(motion: Motion, by: float) -> Motion:
    """Return a motion with every length a part of what it was."""
    segments = [replace(s, from_mm=s.from_mm * by, to_mm=s.to_mm * by) for s in motion.segments]
    return replace(motion, segments=segments)


@pytest.mark.parametrize("motion", MACHINES, ids=lambda motion: str(motion.moves[0].law))
@pytest.mark.parametrize("by", [0.015, 1e-4])
def test_a_tiny_motion_is_beyond_its_limits_where_a_large_one_is(motion: Motion, by: float) -> None:
    """Strokes below 1 mm are strokes like others."""
    tiny = smaller(motion, by)
    assert tiny.range_mm == pytest.approx(tuple(by * end for end in motion.range_mm), abs=1e-12)
    assert tiny.offset_mm(ANGLES) == pytest.approx(by * motion.offset_mm(ANGLES), abs=1e-12)
    for limit in (-2, -0.4, 0.001, 0.65, 3, 12.3, 19, 31, 47):
        found, wanted = tiny.where_beyond(by * limit), motion.where_beyond(limit)
        assert len(found) == len(wanted)
        assert np.ravel(found) == pytest.approx(np.ravel(wanted), abs=1e-5)


def test_at_the_limit_it_is_not_beyond() -> None:
    """The mill in its stop, the die at its top and bottom: a limit of 0 mm leaves no tolerance."""
    assert MILL.where_beyond(0) == [(0, 150)]
    assert DIE.where_beyond(0) == [(150, 360)]
    assert DIE.where_beyond(50) == MILL.where_beyond(50) == []
    assert TWO_STEPS.offset_mm(140) == pytest.approx(40)
    assert [end <= 100 or start >= 180 for start, end in TWO_STEPS.where_beyond(40)] == [True]
    assert MILL.where_beyond(-0.1) == DIE.where_beyond(-0.1) == [(0, 360)]
    for start in (0.1, 1 / 3, 12.34567):
        mill = cm.indexing_motion(
            "mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24, start_mm=start
        )
        assert mill.where_beyond(0) == [(0, 150)]


@pytest.mark.parametrize("motion", MACHINES, ids=lambda motion: str(motion.moves[0].law))
def test_an_offset_turns_only_where_it_is_said_to(motion: Motion) -> None:
    turns = np.sort(np.mod(motion.offset_turning_degs, 360))
    for low, high in zip(turns, [*turns[1:], turns[0] + 360], strict=True):
        between = np.diff(motion.offset_mm(np.linspace(low, high, 101)))
        assert (between >= -1e-9).all() or (between <= 1e-9).all()


REFUSED: dict[str, Callable[[], object]] = {
    "The segments of 'die' add up to 350 deg; a cam turn is 360: add a dwell of 10 deg.": (
        lambda: cm.motion(
            "die", cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=195)
        )
    ),
    "The segments of 'die' add up to 370 deg; a cam turn is 360: take away 10 deg.": (
        lambda: cm.motion(
            "die", cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=215)
        )
    ),
    "The motion 'die' ends 10 mm from where it began: add a return of 10 mm, or, if it moves "
    "on from stop to stop, give its stops (indexing_motion does).": (
        lambda: cm.motion("die", cm.rise(50, over_deg=180), cm.return_(40, over_deg=180))
    ),
    "The motion 'die' ends 50 mm from where it began: add a rise of 50 mm, or, if it moves "
    "on from stop to stop, give its stops (indexing_motion does).": (
        lambda: cm.motion("die", cm.return_(50, over_deg=180), cm.dwell(180))
    ),
    "The indexing motion 'mill' ends where it began, and an indexing motion moves on: leave out "
    "its return, or its stops (make it with motion).": (
        lambda: cm.indexing_motion(
            "mill", cm.rise(50, over_deg=180), cm.return_(50, over_deg=180), stops=24
        )
    ),
    "The motion 'die' has no segment: give at least one.": lambda: cm.motion("die"),
    "A part of 'die' is 100: make each with rise(50, over_deg=55), dwell(100) or "
    "return_(50, over_deg=55).": lambda: cm.motion(
        "die", cm.rise(50, over_deg=55), cast("Part", 100)
    ),
    "Segments of 'die' overlap: the rise ends at 200 deg, but the return after it begins at "
    "190 deg: let it begin 10 deg later.": lambda: _by_hand((0, 200, 0, 50), (190, 360, 50, 0)),
    "The segments of 'die' leave a gap from 200 to 210 deg: add a dwell of 10 deg.": (
        lambda: _by_hand((0, 200, 0, 50), (210, 360, 50, 0))
    ),
    "The motion 'die' jumps at 200 deg from 50 to 40 mm: let each segment begin where the one "
    "before it ends.": lambda: _by_hand((0, 200, 0, 50), (200, 360, 40, 0)),
}


def _by_hand(*numbers: tuple[float, float, float, float]) -> Motion:
    fields = ("from_deg", "to_deg", "from_mm", "to_mm")
    segments = [Segment(**dict(zip(fields, n, strict=True)), law="cycloidal") for n in numbers]
    return Motion("die", segments)


@pytest.mark.parametrize("sentence", REFUSED, ids=lambda sentence: sentence[:40])
def test_what_makes_no_motion_is_refused(sentence: str) -> None:
    with pytest.raises(cm.InputError) as refusal:
        REFUSED[sentence]()
    assert str(refusal.value) == sentence


@pytest.mark.parametrize("segments", [None, 3, "die", [None], [cm.rise(50, over_deg=55)]])
def test_a_motion_is_made_of_segments(segments: Any) -> None:
    match = r"^Motion is given segments(\[0\])?=.*: give (a list, each )?a Segment, or make the mot"
    with pytest.raises(cm.InputError, match=match):
        Motion("die", segments)


@pytest.mark.parametrize("stops", [0, -1, 1.5, True, "24", np.nan])
def test_stops_are_counted(stops: Any) -> None:
    match = r"^The number of stops of 'mill' .*(a whole number above 0|not '24'|not True).*: give"
    with pytest.raises(cm.InputError, match=match):
        cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=stops)


@pytest.mark.parametrize("stops", [24, 24.0, np.int64(24), np.float64(24)])
def test_a_whole_number_of_any_kind_counts_stops(stops: Any) -> None:
    mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=stops)
    assert mill.stops == 24
    assert type(mill.stops) is int


@pytest.mark.parametrize("name", ["", "  ", None, 3, ["die"]])
def test_a_motion_needs_a_name(name: Any) -> None:
    match = r"^(The name of a motion is|Motion is given name=).*: give (one like 'die'|a text)"
    with pytest.raises(cm.InputError, match=match):
        cm.motion(name, cm.dwell(360))


def test_white_space_about_a_name_does_not_count() -> None:
    assert cm.motion(" die\n", cm.dwell(360)).name == "die"


def test_sums_of_decimals_close() -> None:
    """0.1 + 0.2 is not 0.3 in floats; in mm and deg it is."""
    parts = [cm.rise(0.1, over_deg=0.1), cm.rise(0.2, over_deg=0.2), cm.return_(0.3, over_deg=0.3)]
    made = cm.motion("die", *parts, cm.dwell(359.4))
    assert made.segments[2].to_mm == 0


def test_motions_are_told_apart_by_what_they_are() -> None:
    assert make_die() == DIE
    assert make_die(60) != DIE
    assert hash(make_die()) == hash(DIE)
    assert Motion("die", list(DIE.segments)) == DIE
    with pytest.raises(AttributeError):
        DIE.name = "punch"  # type: ignore[misc]


def test_a_shifted_motion_does_the_same_later() -> None:
    angles = np.linspace(-360, 720, 271)
    for motion in (make_die(), make_mill()):
        later = motion.shifted(33.5)
        assert later.start_deg == motion.start_deg + 33.5
        assert later.offset_mm(angles + 33.5) == pytest.approx(motion.offset_mm(angles), abs=1e-9)
    with pytest.raises(cm.InputError, match="The cam angle is nan"):
        make_die().shifted(float("nan"))


def test_another_law_changes_how_and_not_where() -> None:
    die = make_die(55)
    other = die.with_law("modified sine")
    assert [s.law for s in other.moves] == [cm.LAWS["modified sine"]] * 2
    ends = [s.from_deg for s in die.segments]
    assert np.allclose(other.position_mm(ends), die.position_mm(ends))
    assert not np.allclose(other.position_mm(160), die.position_mm(160))
    with pytest.raises(cm.InputError, match="modified sine"):
        die.with_law("modified sin")


def test_an_index_backwards_begins_at_0_and_not_at_minus_0() -> None:
    back = cm.indexing_motion("back", cm.return_(5.26, over_deg=360), stops=3, start_deg=725)
    places = np.asarray(back.position_mm(725 + 360 * np.arange(4)))
    assert places.tolist() == [0, -5.26, -10.52, 0]
    assert not np.signbit(places[[0, 3]]).any()


@pytest.mark.parametrize("count", [6, 7, 9, 11, 12, 13])
def test_equal_parts_of_a_stroke_come_to_all_of_it(count: int) -> None:
    """Each was rounded to what the one before had come to, and so the errors added up."""
    for stroke in (50, 25.4, 31.7):
        rises = [cm.rise(stroke / count, over_deg=180 / count)] * count
        assert cm.motion("m", *rises, cm.return_(stroke, over_deg=180)).range_mm == (0, stroke)
        turret = cm.indexing_motion("t", *rises, cm.dwell(180), stops=8)
        assert turret.pitch_mm == stroke
