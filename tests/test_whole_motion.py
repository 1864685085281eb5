"""Peaks of whole motions, with their joints; held to finite differences over the turn."""

from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from machines import examples

import cammotion as cm

RATE = 2000
TURN_S = 1.8
HARMONIC = cm.LAWS["simple harmonic"]
LAWS = [*cm.LAWS.values(), cm.MotionLaw("late", cm.x**3), cm.polynomial((0, 0.4, 0), (1, 0, 0))]


def peaks(motion: cm.Motion) -> tuple[float, float, float]:
    diagram = cm.TimingDiagram([motion], RATE)
    name = motion.name
    return diagram.peak_velocity(name), diagram.peak_acceleration(name), diagram.peak_jerk(name)


def test_up_and_down_by_a_half_cosine_each_is_a_pure_cosine() -> None:
    """Each move alone has an infinite jerk, since it would start from rest."""
    wave = cm.motion(
        "wave", cm.rise(50, over_deg=180, law=HARMONIC), cm.return_(50, over_deg=180, law=HARMONIC)
    )
    omega = 2 * np.pi / TURN_S
    assert peaks(wave) == pytest.approx([0.025 * omega**n for n in (1, 2, 3)], rel=1e-12)
    assert wave.steps(2) == wave.steps(3) == []
    waits = cm.motion(
        "waits",
        *(cm.rise(50, over_deg=90, law=HARMONIC), cm.dwell(100)),
        cm.return_(50, over_deg=170, law=HARMONIC),
    )
    assert peaks(waits)[2] == np.inf
    assert [at for at, _ in waits.steps(2)] == [0, 90, 190]


def test_a_shear_that_comes_up_to_speed_has_a_finite_peak() -> None:
    """The velocity of the middle part is that of the web; its neighbours are matched to it."""
    shear = cm.motion(
        "shear",
        cm.rise(20, over_deg=60, law=cm.MATCHED),
        cm.rise(60, over_deg=90, law=cm.CONSTANT_VELOCITY),
        cm.rise(20, over_deg=60, law=cm.MATCHED),
        cm.return_(100, over_deg=150),
        start_deg=400,
    )
    web = 0.060 / (90 / 360 * TURN_S)
    assert shear.derivative(1, [460, 505, 549.999], RATE) == pytest.approx(web)
    velocity, acceleration, jerk = peaks(shear)
    assert velocity == pytest.approx(2 * 0.100 / (150 / 360 * TURN_S))
    assert np.isfinite(acceleration)
    assert np.isfinite(jerk)  # matched to the cycloid, whose acceleration begins at 0
    assert shear.steps(1) == shear.steps(2) == []
    assert cm.rise(20, over_deg=60, law="Matched") == cm.rise(20, over_deg=60, law=cm.MATCHED)
    with pytest.raises(cm.InputError, match="is to be matched too"):
        cm.motion("a", *[cm.rise(1, over_deg=180, law=cm.MATCHED)] * 2)


@examples(40)
@given(st.lists(st.integers(1, 899), min_size=3, max_size=3), st.integers(-3600, 9000))
def test_at_a_joint_it_is_what_begins_there_in_any_turn(tenths: list[int], start: int) -> None:
    """The joints are told in tenths of a degree, which do not add up exactly in floats."""
    up, high, down = (tenth / 10 for tenth in tenths)
    parabolic = cm.LAWS["constant acceleration"]
    die = cm.motion(
        "die",
        *(cm.rise(5.26, over_deg=up, law=parabolic), cm.dwell(high)),
        *(cm.return_(5.26, over_deg=down, law=parabolic), cm.dwell(360 - up - high - down)),
        start_deg=start / 10,
    )
    begins = [4 * 5.26e-3 / (up / 360 * TURN_S) ** 2, 0, -4 * 5.26e-3 / (down / 360 * TURN_S) ** 2]
    joints = np.cumsum([start, *tenths[:2]])
    for turn in (-2, 0, 1, 24):
        places = (joints + 3600 * turn) / 10
        assert die.derivative(2, places, RATE) == pytest.approx(begins), places
        assert die.derivative(2, float(places[0]), RATE) == pytest.approx(begins[0])


def test_an_axis_at_constant_speed_is_not_accelerated() -> None:
    belt = cm.indexing_motion("belt", cm.rise(100, over_deg=360, law=cm.CONSTANT_VELOCITY), stops=1)
    assert peaks(belt) == pytest.approx((0.1 / TURN_S, 0, 0), abs=1e-15)
    assert peaks(cm.motion("table", cm.dwell(360))) == (0, 0, 0)


def test_a_real_jump_stays_infinite() -> None:
    there = cm.rise(50, over_deg=100, law=cm.CONSTANT_VELOCITY)
    hits = cm.motion("hits", there, cm.return_(50, over_deg=100), cm.dwell(160), start_deg=-30)
    assert peaks(hits) == pytest.approx((2 * 0.05 / 0.5, np.inf, np.inf))
    assert [at for at, _ in hits.steps(1)] == [70, 330]
    assert hits.steps(1)[0][1] == pytest.approx(-0.5)  # mm/deg, from the line into a cycloid


def test_what_stands_a_last_digit_off_its_stop_stands_at_it() -> None:
    rng = np.random.default_rng(5)
    for pitch, start in rng.uniform((1, -50), (200, 50), (3000, 2)).round(2):
        table = cm.indexing_motion(
            "table", cm.rise(pitch, over_deg=150), cm.dwell(210), stops=24, start_mm=start
        )
        assert table.where_beyond(0) == [(0, 150)]
    assert table.position_mm(-5e-324) == table.position_mm(0.0) == start


def differences(motion: cm.Motion, narrowest_deg: float) -> Any:
    """Return velocity, acceleration and jerk by finite differences over a turn that closes.

    The narrowest move of the motion is cut into 500 steps at least.
    """
    count = 36_000 * max(1, int(np.ceil(5 / narrowest_deg)))
    angles = motion.start_deg + np.linspace(0, 360, count + 1)
    places = np.asarray(motion.curve(np.minimum(angles, motion.curve.high)))
    step = 360 / count
    turned = np.concatenate(
        [places[-4:-1] - motion.pitch_mm, places, places[1:4] + motion.pitch_mm]
    )
    return [np.diff(turned, n) / step**n for n in (1, 2, 3)]


@examples(60)
@given(st.data())
def test_peaks_are_those_of_finite_differences(data: st.DataObject) -> None:
    """Where the differences grow as the step shrinks, the peak is infinite."""
    cuts = sorted(data.draw(st.sets(st.integers(20, 340), min_size=3, max_size=3)))
    widths = np.diff([0, *cuts, 360])
    laws = [data.draw(st.sampled_from(LAWS)) for _ in range(2)]
    laws[1] = laws[1].reversed() if data.draw(st.booleans()) else laws[1]
    parts = [
        cm.rise(40, over_deg=widths[0], law=laws[0]),
        cm.dwell(widths[1]),
        cm.return_(40, over_deg=widths[2], law=laws[1]),
        cm.dwell(widths[3]),
    ]
    start = data.draw(st.floats(-400, 800))
    motion = cm.motion("die", *parts, start_deg=start)
    for order, values in enumerate(differences(motion, min(widths[0], widths[2])), 1):
        peak, seen = motion.peak(order), np.max(np.abs(values))
        if np.isinf(peak):
            assert any(motion.steps(lower) for lower in range(1, order))
        else:
            assert seen <= peak * (1 + 1e-6) + 1e-4 * (order == 3)
            assert seen >= 0.97 * peak - 1e-4


@pytest.mark.parametrize("apart", [5e-10, 2e-14, 0, -2e-14, -5e-10])
def test_a_law_that_is_real_only_from_0_to_1_has_a_value_at_every_joint(apart: float) -> None:
    """Segments may miss each other by a billionth of a degree; there it was not a number."""
    power = sympy.Rational(7, 2)
    slowing, late = (cm.MotionLaw("root", s) for s in (1 - (1 - cm.x) ** power, cm.x**power))
    up = cm.Segment(from_deg=0.3, to_deg=90.1, from_mm=0, to_mm=50, law=slowing)
    down = cm.Segment(from_deg=90.1 + apart, to_deg=360.3, from_mm=50, to_mm=0, law=late)
    motion = cm.Motion("die", [up, down])
    places = 90.1 + np.array([0, apart / 2, apart, np.spacing(90.1), -np.spacing(90.1)])
    assert motion.position_mm(places) == pytest.approx(50)
    for order in (1, 2, 3):
        assert motion.derivative(order, places, RATE) == pytest.approx(0, abs=1e-3)


def test_a_start_with_many_digits_is_a_start_like_any_other() -> None:
    die = cm.motion(
        "die",
        cm.dwell(180),
        cm.rise(1, over_deg=90),
        cm.return_(1, over_deg=90),
        start_mm=-213.50412345678912,
    )
    assert die.start_mm == -213.504123457


def test_a_matched_return_may_overshoot() -> None:
    """The simplest flying shear: with the web, and back; it has to swing beyond both ends."""
    shear = cm.motion(
        "shear",
        cm.rise(100, over_deg=100, law=cm.CONSTANT_VELOCITY),
        cm.return_(100, over_deg=260, law=cm.MATCHED),
    )
    assert shear.steps(1) == shear.steps(2) == []
    assert shear.range_mm == pytest.approx((-31.2, 131.2), abs=0.1)
    assert np.isfinite(peaks(shear)).all()


def test_a_small_move_beside_a_large_one_keeps_its_jumps() -> None:
    both = cm.motion(
        "both",
        cm.rise(100, over_deg=10),
        cm.dwell(50),
        cm.rise(0.001, over_deg=100, law="constant acceleration"),
        cm.return_(100.001, over_deg=100),
        cm.dwell(100),
    )
    assert [at for at, _ in both.steps(2)] == [60, 110, 160]
    assert peaks(both)[2] == np.inf


def test_what_cannot_be_matched_is_refused_in_words() -> None:
    with pytest.raises(cm.InputError, match="begins and ends at"):
        cm.motion("a", cm.rise(1e-10, over_deg=10, law=cm.MATCHED), cm.dwell(350))
    with pytest.raises(cm.InputError, match="is to be matched too"):
        cm.indexing_motion("a", cm.rise(10, over_deg=360, law=cm.MATCHED), stops=4)
