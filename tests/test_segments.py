"""Segments: the cycloid in closed form, and what is no segment."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any, cast

import numpy as np
import pytest
import sympy
from machines import CURVES, DIPPING, MONOTONE, TURNING

import cammotion as cm
from cammotion import MotionLaw, Segment
from cammotion.machine.kinematics import over_time
from cammotion.machine.parts import Part

RISE = Segment(from_deg=150, to_deg=205, from_mm=10, to_mm=60, law="cycloidal")
FALL = Segment(from_deg=305, to_deg=360, from_mm=60, to_mm=10, law="cycloidal")
REST = Segment(from_deg=205, to_deg=305, from_mm=60, to_mm=60)


def test_a_segment_says_what_it_is() -> None:
    assert [segment.kind for segment in (RISE, REST, FALL)] == ["rise", "dwell", "return"]
    assert [segment.angle_deg for segment in (RISE, REST, FALL)] == [55, 100, 55]
    assert [segment.change_mm for segment in (RISE, REST, FALL)] == [50, 0, -50]
    assert [segment.is_dwell for segment in (RISE, REST, FALL)] == [False, True, False]


def test_a_segment_keeps_plain_floats() -> None:
    """Whatever numbers it is given: exact fractions would not survive a table."""
    third, hundred = sympy.Rational(1, 3), cast("float", np.int64(100))
    exact = Segment(from_deg=third, to_deg=hundred, from_mm=0, to_mm=0)
    ends = (exact.from_deg, exact.to_deg, exact.from_mm, exact.to_mm)
    assert ends == (1 / 3, 100, 0, 0)
    assert {type(end) for end in ends} == {float}


def test_a_rise_and_a_return_follow_the_cycloid() -> None:
    part = np.linspace(0, 1, 12)
    s, v = part - np.sin(2 * np.pi * part) / (2 * np.pi), 1 - np.cos(2 * np.pi * part)
    a, j = 2 * np.pi * np.sin(2 * np.pi * part), 4 * np.pi**2 * np.cos(2 * np.pi * part)
    tm = 0.275  # 55 deg at 2000 pieces/h
    for segment, sign in ((RISE, 1), (FALL, -1)):
        angles = segment.from_deg + 55 * part
        assert segment.curve(angles) == pytest.approx(segment.from_mm + sign * 50 * s)
        for order, factor in enumerate((v, a, j), 1):
            found = over_time(order, segment.curve.derived(order)(angles), 1.8)
            assert found == pytest.approx(sign * 0.050 / tm**order * factor, abs=1e-9)


@pytest.mark.parametrize("stroke_mm", [50, 1, 0.999, 0.1, 1e-3])
def test_the_smallest_stroke_is_a_rise_or_a_return(stroke_mm: float) -> None:
    up = Segment(from_deg=0, to_deg=90, from_mm=0, to_mm=stroke_mm, law="cycloidal")
    down = Segment(from_deg=0, to_deg=90, from_mm=stroke_mm, to_mm=0, law="cycloidal")
    assert (up.kind, down.kind) == ("rise", "return")
    rest = Segment(from_deg=180, to_deg=360, from_mm=0, to_mm=0)
    die = cm.Motion("die", [up, replace(down, from_deg=90, to_deg=180), rest])
    assert die.where_beyond(stroke_mm / 2) == [(45, 135)]


def test_a_segment_is_said_by_name() -> None:
    with pytest.raises(TypeError):
        Segment(0, 90, 0, 50, "cycloidal")  # type: ignore[call-arg]
    with pytest.raises(TypeError):
        cm.rise(50, 55)  # type: ignore[call-arg]


@pytest.mark.parametrize("angle", [0.001, 359.999, 360])
def test_a_segment_takes_any_angle_up_to_a_turn(angle: float) -> None:
    assert Segment(from_deg=0, to_deg=angle, from_mm=0, to_mm=0).angle_deg == angle
    assert cm.dwell(angle) == Part(angle)
    assert cm.rise(0.5, over_deg=angle) == Part(angle, 0.5, cm.as_law("cycloidal"))
    for make in (cm.dwell, lambda wide: cm.return_(50, over_deg=wide)):
        for wrong in (-angle, 0, 360.001):
            with pytest.raises(cm.InputError, match=r"^The angle of a segment is"):
                make(wrong)
        with pytest.raises(cm.InputError, match="is 0 deg; leave it out"):
            make(0)


def test_a_dwell_stands_still() -> None:
    angles = np.array([205.0, 250.0, 305.0])
    assert REST.curve(angles).tolist() == [60, 60, 60]
    for order in (1, 2, 3):
        assert REST.curve.derived(order)(angles).tolist() == [0, 0, 0]


@pytest.mark.parametrize("law", [*MONOTONE, *TURNING], ids=str)
@pytest.mark.parametrize("ends_mm", [(10, 60), (60, 10), (10, 10.5), (0.3, -0.2), (5.26, 5.264)])
def test_where_it_is_above_or_below_a_limit(law: MotionLaw, ends_mm: tuple[float, float]) -> None:
    start, end = ends_mm
    low, stroke = min(ends_mm), abs(end - start)
    segment = Segment(from_deg=100, to_deg=200, from_mm=start, to_mm=end, law=law)
    angles = 100 + (np.arange(5000) + 0.5) / 50
    positions = start + (end - start) * CURVES[law.name]((angles - 100) / 100)
    for share in (-0.2, -0.004, 0, 0.26, 0.5, 0.98, 1, 1.02, 1.4):
        limit = low + share * stroke
        for parts, is_there in (
            (segment.curve.where(limit, 1), positions > limit),
            (segment.curve.where(limit, -1), positions < limit),
        ):
            inside = [(low < angles) & (angles < high) for low, high in [*parts, (0, 0)]]
            assert np.count_nonzero(np.any(inside, 0) != is_there) <= 2


def test_a_dwell_at_the_limit_is_neither_above_nor_below() -> None:
    where = REST.curve.where
    assert where(60, 1) == where(60, -1) == []
    assert where(59.999, 1) == where(60.001, -1) == [(205, 305)]
    assert where(60.001, 1) == where(59.999, -1) == []


def test_it_turns_where_its_law_does() -> None:
    down = Segment(from_deg=0, to_deg=150, from_mm=50, to_mm=0, law=DIPPING)
    assert [low for low, *_ in down.curve.branches] == [0, pytest.approx(40)]
    assert [low for low, *_ in RISE.curve.branches] == [150]
    assert REST.curve.ends == (60, 60)


def test_parts_are_said_in_words() -> None:
    assert cm.rise(50, over_deg=55) == Part(55, 50, cm.LAWS["cycloidal"])
    assert cm.return_(50, over_deg=55, law=DIPPING) == Part(55, -50, DIPPING)
    assert cm.dwell(100) == Part(100, 0, None)


HALF = MotionLaw("half", cm.x / 2)
REFUSED: list[tuple[Callable[[], object], str]] = [
    (
        lambda: Segment(from_deg=205, to_deg=305, from_mm=50, to_mm=49),
        "The dwell from 205 to 305 deg begins at 50 mm and ends at 49 mm; a dwell stays where it "
        "is: give it one position, or a law, for example 'cycloidal'.",
    ),
    (
        lambda: Segment(from_deg=150, to_deg=205, from_mm=50, to_mm=50, law="cycloidal"),
        "The move from 150 to 205 deg begins and ends at 50 mm: give it a stroke, or make it a "
        "dwell (law=None).",
    ),
    (
        lambda: Segment(from_deg=205, to_deg=150, from_mm=0, to_mm=0),
        "The segment from 205 to 150 deg ends before it begins: if it goes on over 360 deg, let "
        "it end at 510 deg.",
    ),
    (
        lambda: Segment(from_deg=0, to_deg=55, from_mm=0, to_mm=50, law=HALF),
        "The law 'half' goes from S(0) = 0 to S(1) = 0.5; a move goes from 0 to 1: subtract S(0), "
        "and divide by S(1) - S(0).",
    ),
    (
        lambda: Segment(from_deg=0, to_deg=55, from_mm=0, to_mm=50, law="cycloid"),
        "There is no motion law 'cycloid': did you mean 'cycloidal'",
    ),
]


@pytest.mark.parametrize(("make", "sentence"), REFUSED, ids=[said[:30] for _, said in REFUSED])
def test_what_is_no_segment_is_refused(make: Callable[[], Any], sentence: str) -> None:
    with pytest.raises(cm.InputError) as refusal:
        make()
    assert str(refusal.value).startswith(sentence)


@pytest.mark.parametrize("ends", [(350, 20), (400, 20), (1070, 20), (1070, -340), (360, 0)])
def test_the_end_that_is_proposed_for_a_segment_is_one(ends: tuple[float, float]) -> None:
    """From 400 to 20 deg it was 380, which lies before 400 too."""
    start, end = ends
    with pytest.raises(cm.InputError, match=r"ends before it begins") as refusal:
        Segment(from_deg=start, to_deg=end, from_mm=0, to_mm=0)
    proposed = float(str(refusal.value).partition("end at ")[2].removesuffix(" deg."))
    assert Segment(from_deg=start, to_deg=proposed, from_mm=0, to_mm=0).to_deg % 360 == end % 360
