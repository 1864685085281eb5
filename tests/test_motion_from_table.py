"""Motions from tables of whole turns, against the motions and functions that the tables are of."""

import re
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import CURVES, MONOTONE, RULE, Array, examples, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion.measured.from_table import _turns

ANGLES: Array = np.arange(0.0, 360.0)
AT: Array = np.arange(0.0, 360.0, 0.13)
SMOOTH = ["cycloidal", "3-4-5", "4-5-6-7", "Gutman", "mod. sine"]


def table(positions: Array, angles: Array = ANGLES, step: float = 0.0) -> cm.CamTable:
    rounded = np.round(positions / step) * step if step else positions
    return cm.CamTable(angles, rounded, step_mm=step, is_cycle=True)


def lift(at: Array, start: float, widths: tuple[float, float, float], law: str) -> Array:
    """Return a rise of 40 mm, a dwell and a return, written out."""
    up, stay, down = widths
    since, curve = (at - start) % 360, CURVES[law]
    rise, back = np.clip(since / up, 0, 1), np.clip((since - up - stay) / down, 0, 1)
    return np.asarray(40 * (curve(rise) - curve(back)))


@examples(25)
@given(
    st.floats(-360, 360),
    st.tuples(st.floats(40, 100), st.floats(15, 100), st.floats(40, 100)),
    st.sampled_from(SMOOTH),
)
def test_a_rise_a_dwell_and_a_return(
    start: float, widths: tuple[float, float, float], law: str
) -> None:
    cam = cm.motion_from_table("cam", table(lift(ANGLES, start, widths, law)))
    kinds = [segment.kind for segment in cam.segments]
    assert sorted(kinds) == ["dwell", "dwell", "return", "rise"]
    assert 0 <= cam.start_deg < 360
    assert cam.position_mm(AT) == pytest.approx(lift(AT, start, widths, law), abs=0.01)
    rise = next(s for s in cam.segments if s.kind == "rise")
    assert rise.angle_deg == pytest.approx(widths[0], abs=3)
    factor = {law.name: law for law in MONOTONE}[law].Ca
    peak = max(cm.Move(stroke_mm=40, angle_deg=b, rate_per_hour=2000).time_s for b in widths[::2])
    fastest = min(cm.indexing_time(widths[n], 2000) for n in (0, 2))
    assert peak >= fastest
    expected = factor * 0.04 / fastest**2
    assert make_diagram(cam).peak_acceleration("cam") == pytest.approx(expected, rel=0.05)
    assert cam.steps(1) == []


@examples(20)
@given(st.floats(0, 360), st.sampled_from([2.0, 5.0, 7.5]), st.floats(0, 12))
def test_a_cam_that_never_stays(start: float, step: float, second: float) -> None:
    """An eccentric with a second harmonic: turned where its slope is zero, to the last bit."""

    def height(at: Array) -> Array:
        angle = np.radians(at - start)
        return np.asarray(50 - 25 * np.cos(angle) + second * np.sin(2 * angle))

    angles = np.arange(start % step, 360, step)
    cam = cm.motion_from_table("cam", table(height(angles), angles))
    assert cam.position_mm(AT) == pytest.approx(height(AT), abs=2e-3)
    close = np.arange(0, 360, 0.01)
    low, high = height(close).min(), height(close).max()
    assert cam.range_mm == pytest.approx((low, high), abs=2e-3)
    assert cam.steps(1) == cam.steps(2) == []
    slope = np.diff(height(close), 2) / np.radians(0.01) ** 2
    expected = np.abs(slope).max() * (2 * np.pi / 1.8) ** 2 / 1000
    assert make_diagram(cam).peak_acceleration("cam") == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("step", [0.1, 0.25, 2.0, 7.5])
@pytest.mark.parametrize("second", [1e-7, 1e-6, 1e-5, 1e-4, 1e-3])
def test_a_cam_that_turns_right_beside_a_point(step: float, second: float) -> None:
    """From 4e-7 to 4e-3 deg beside 0 and 180; it is the same turned to anywhere."""
    angles = np.arange(0, 360, step)
    a = np.radians(angles)
    heights = 50 - 25 * np.cos(a) + second * np.sin(2 * a)
    cam = cm.motion_from_table("cam", table(heights, angles))
    assert cam.steps(1) == cam.steps(2) == []
    assert cam.position_mm(angles) == pytest.approx(heights, abs=1e-6)
    turned = cm.motion_from_table("cam", table(np.roll(heights, 7), angles))
    assert turned.peak(3) == pytest.approx(cam.peak(3), rel=1e-3)


@pytest.mark.parametrize("start", [0.1, 0.7, 1.3, 1.9])
def test_a_dwell_over_the_end_of_the_turn(start: float) -> None:
    """The angles of the second turn are rounded otherwise than those of the first."""
    angles = start + np.arange(0.0, 360, 2)
    for first in np.arange(200.0, 360, 7):
        heights = lift(angles, first, (80, 60, 100), "cycloidal")
        cam = cm.motion_from_table("cam", table(heights, angles))
        assert cam.position_mm(angles) == pytest.approx(heights, abs=0.01)


@pytest.mark.parametrize("start", [2.5, 5.0, 22.5])
def test_two_points_of_one_height_are_no_dwell(start: float) -> None:
    """They lie beside a turn, and it has no dwell, nor a jump where few points make a move."""
    angles = np.arange(start, 360, 2 * start)
    heights = 10 * np.cos(np.radians(angles)) + 3 * np.cos(3 * np.radians(angles))
    cam = cm.motion_from_table("cam", table(heights, angles))
    assert {segment.kind for segment in cam.segments} == {"rise", "return"}
    assert cam.steps(1) == cam.steps(2) == []


def test_two_strokes_a_turn() -> None:
    parts = cm.rise(20, over_deg=60), cm.return_(20, over_deg=50), cm.dwell(100)
    more = cm.rise(30, over_deg=80), cm.return_(30, over_deg=70)
    twice = cm.motion("twice", *parts, *more, start_deg=313.3)
    cam = cm.motion_from_table("twice", table(np.asarray(twice.position_mm(ANGLES))))
    assert [s.kind for s in cam.segments] == ["rise", "return", "rise", "return", "dwell"]
    assert cam.position_mm(AT) == pytest.approx(twice.position_mm(AT), abs=1e-3)


def test_it_is_checked_drawn_and_written(tmp_path: Path) -> None:
    cam = cm.motion_from_table("die", table(lift(ANGLES, 150, (55, 100, 55), "cycloidal")))
    machine = make_diagram(make_mill(), cam)
    assert cm.find_violations(machine, RULE) == ()
    rule = cm.ClearanceRule(cm.beyond("die", 10), only_while=cm.within("mill", 0.65))
    exact = make_diagram(make_mill(), make_die(55, stroke_mm=40))
    widest = [cm.widest_move(each, "die", rule).angle_deg for each in (exact, machine)]
    assert 60 < widest[0] < 129
    assert widest[1] == pytest.approx(widest[0], abs=0.01)
    assert cm.plot_timing(machine, rules=RULE).lines
    again = cm.read_segments(cm.write_segments(machine, tmp_path / "machine.csv"))
    assert again["die"].position_mm(AT) == pytest.approx(cam.position_mm(AT), abs=1e-9)


def test_what_is_rounded_is_told_once() -> None:
    fine = table(lift(ANGLES, 150, (55, 100, 55), "cycloidal"), step=0.01)
    with pytest.warns(UserWarning, match="to 0.01 mm. That alone may change") as told:
        cam = cm.motion_from_table("die", fine)
    assert len(told) == 1
    assert cam.position_mm(AT) == pytest.approx(lift(AT, 150, (55, 100, 55), "cycloidal"), abs=0.02)


@pytest.mark.parametrize("noise", [0.0003, 0.001, 0.003, 0.01, 0.03])
@pytest.mark.parametrize("law", SMOOTH)
def test_a_measured_cam_moves_as_its_smoothed_table(law: str, noise: float) -> None:
    heights = lift(ANGLES, 150, (75, 60, 55), law)
    measured = table(heights + np.random.default_rng(3).normal(0, noise, heights.size))
    with pytest.raises(cm.InputError, match="give what smoothed returns"):
        cm.motion_from_table("die", measured)
    smooth = cm.smoothed(measured)
    cam = cm.motion_from_table("die", smooth)
    assert [move.kind for move in cam.moves] == ["rise", "return"]
    stays = [segment.angle_deg for segment in cam.segments if segment.is_dwell]
    assert 230 - 4 * 12 < sum(stays) < 245  # ten degrees at each end are for going over
    assert np.abs(cam.position_mm(AT) - lift(AT, 150, (75, 60, 55), law)).max() < 4 * noise
    diagram = cm.TimingDiagram([cam], 900)
    assert diagram.peak_acceleration("die") == pytest.approx(
        np.abs(np.asarray(smooth.at(AT, 2, rate_per_hour=900))).max(), rel=0.01
    )


@pytest.mark.parametrize("seed", [3171, 3317, 3567, 3718, 3825])
def test_a_table_that_turns_back_by_a_little_just_before_it_dwells(seed: int) -> None:
    """It ends less than six errors from where it turned before; a move between would be nothing."""
    widths = 60, 20, 80
    noise = np.random.default_rng(seed).normal(0, 1e-4, ANGLES.size)
    smooth = cm.smoothed(table(lift(ANGLES, 0, widths, "3-4-5") + noise))
    cam = cm.motion_from_table("die", smooth)
    assert all(abs(move.change_mm) > 6 * smooth.error_mm for move in cam.moves)
    off = cam.position_mm(AT) - np.asarray(smooth.at(AT))
    assert np.abs(off).max() < 12 * smooth.error_mm


@pytest.mark.parametrize("noise", [0.001, 0.03, 0.3])
def test_a_measured_cam_that_turns_slowly_does_not_dwell(noise: float) -> None:
    wave = 25 - 25 * np.cos(np.radians(ANGLES))
    measured = table(wave + np.random.default_rng(4).normal(0, noise, wave.size))
    cam = cm.motion_from_table("cam", cm.smoothed(measured))
    assert [segment.kind for segment in cam.segments] == ["rise", "return"]
    at_once = np.radians(1) ** 2 * 25  # mm/deg2
    assert cam.peak(2) == pytest.approx(at_once, rel=0.1)


def test_a_dwell_that_creeps_is_one() -> None:
    """Its steps of rounding make three dwells of one height, one after the other."""
    creep = np.interp(ANGLES, [0, 80, 110, 111, 200, 280, 360], [0, 40, 40, 40.01, 40, 0, 0])
    cam = cm.motion_from_table("cam", table(creep, step=0.01))
    assert [segment.kind for segment in cam.segments] == ["rise", "dwell", "return", "dwell"]


def test_the_table_of_a_turret_is_one_by_the_way_that_is_told(tmp_path: Path) -> None:
    index = cm.rise(80, over_deg=120, law="modified sine")
    dial = cm.indexing_motion("dial", cm.dwell(240), index, stops=12)
    machine = cm.TimingDiagram([dial], 5400)
    read = cm.read_cam_table(cm.write_cam_tables(machine, tmp_path)["dial"])
    with pytest.raises(cm.InputError, match=r"indexing_motion") as refused:
        cm.motion_from_table("dial", read)
    (told,) = re.findall(r"rise\(.*\)(?=, that)", str(refused.value))
    move = eval(told, {"rise": cm.rise, "law_from_table": cm.law_from_table, "table": read})  # noqa: S307 - our own words
    again = cm.TimingDiagram([cm.indexing_motion("dial", move, stops=12)], 5400)
    assert again.peak_acceleration("dial") == pytest.approx(
        machine.peak_acceleration("dial"), rel=1e-3
    )


def test_what_is_no_motion() -> None:
    wave = 25 - 25 * np.cos(np.radians(ANGLES))
    with pytest.raises(cm.InputError, match="no whole turn, and a motion fills one"):
        cm.motion_from_table("cam", cm.CamTable(ANGLES, wave))
    with pytest.raises(
        cm.InputError, match=r"goes over 0 mm, .* 0.015 mm of rounding or noise, and so stays"
    ):
        cm.motion_from_table("cam", table(0 * wave, step=0.01))
    noise = np.random.default_rng(1).normal(0, 0.5, wave.size)
    with pytest.raises(cm.InputError, match=r"turns back \d+ times .* give what smoothed returns"):
        cm.motion_from_table("cam", table(wave + noise))
    twice = np.sort([*ANGLES, 100.00001])
    close = 25 - 25 * np.cos(np.radians(twice))
    with pytest.raises(cm.InputError, match=r"points at 100 and 100.00001 deg, closer .* 180 deg"):
        cm.motion_from_table("cam", table(close, twice))
    with pytest.raises(cm.InputError, match="shortest dwell is 0 deg"):
        cm.motion_from_table("cam", table(wave), least_dwell_deg=0)


def test_rates_and_strokes_in_other_units() -> None:
    assert cm.per_minute(40) == 2400
    assert cm.TimingDiagram([cm.EXAMPLE.die], cm.per_minute(33.5)).rpm == pytest.approx(33.5)
    assert cm.per_minute([1, 2]).tolist() == [60, 120]
    assert cm.arc_mm(180, radius_mm=10) == pytest.approx(10 * np.pi)
    with pytest.raises(cm.InputError, match="radius is 0 mm"):
        cm.arc_mm(30, radius_mm=0)


@pytest.mark.parametrize(
    ("heights", "left"),
    [
        ([5, 5, 5], [5]),
        ([0, 1.5, 0.8], [0]),
        ([0, 4, 1, 3, 9], [0, 4, 1, 9]),
        ([0, 4, 4.5, 8], [0, 8]),
        ([9, 2, 3, 1], [9, 1]),
    ],
)
def test_what_turns_back_by_little_is_no_move(heights: list[float], left: list[float]) -> None:
    assert [height for _, height in _turns([*enumerate(heights)], 1.0)] == left


def test_a_dwell_that_is_printed_at_two_levels_is_one() -> None:
    """The last digit goes up within it, by less than the table's own step."""
    at = np.arange(0, 360, 2.0)
    lift = np.interp(at, [0, 100, 240, 340], [0, 50, 50, 0])
    smooth = 25 * (1 - np.cos(np.pi * lift / 50))
    smooth[(at >= 160) & (at <= 180)] += 1e-4
    found = cm.motion_from_table("cam", cm.CamTable(at, smooth, is_cycle=True))
    (top,) = (s for s in found.segments if s.is_dwell and s.from_mm > 49)
    assert (top.from_deg, top.to_deg) == pytest.approx((100, 240), abs=4)
