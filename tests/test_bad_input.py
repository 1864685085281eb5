"""The bad-input table: each public function, each of its quantities, each kind of nonsense.

A refusal is an InputError whose sentence names the quantity, the value and what to give instead.
"""

import math
from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy

import cammotion as cm

DIE = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
PUNCH = cm.motion("punch", cm.rise(50, over_deg=180), cm.return_(50, over_deg=180))
DIAGRAM = cm.TimingDiagram([PUNCH], rate_per_hour=2000)

NOT_FINITE = [(math.nan, "is nan"), (math.inf, "is inf"), (-math.inf, "is -inf")]
NOT_POSITIVE = [(0, "is 0"), (-5, "is -5"), ([30, -5.0], r"is -5 .*\(at position 1\)")]
NOT_A_NUMBER = [
    ("fifty", "not 'fifty'"),
    (None, "not None"),
    (True, "not True"),
    (1j, "not 1j"),
    ([[1], [2, 3]], r"not \[\[1\], \[2, 3\]\]"),
    (sympy.Symbol("B"), "not B"),
    ([1.0, None], r"not \[1.0, None\]"),
]
EMPTY = [([], "is empty"), (np.array([]), "is empty")]
ANYWHERE = NOT_FINITE + NOT_A_NUMBER + EMPTY
POSITIVE = ANYWHERE + NOT_POSITIVE
ONE_NUMBER = [(value, said) for value, said in ANYWHERE if not isinstance(value, list | np.ndarray)]
ONE_POSITIVE = [
    (value, said) for value, said in POSITIVE if not isinstance(value, list | np.ndarray)
]
ONE_PART = [*ONE_POSITIVE, (360.5, "is 360.5 deg")]

Call = Callable[[Any], object]
RATE = ("machine rate", "for example 2000 pieces/h")
ANGLE = ("indexing angle", "for example 55 deg")
STROKE = ("stroke", "for example 50 mm")
TIME = ("time", "for example 0.1375 s")
PLACE = ("dimensionless time x = t/tm", "for example 0.5")
WAY = ("dimensionless displacement S", "for example 0.5")
CAM_ANGLE = ("cam angle", "for example 180 deg")
ANY_TIME = ("time", "for example 0.9 s")
POSITION = ("position", "for example 50 mm")
LIMIT = ("limit", "for example 19 mm")
PART_ANGLE = ("angle of a segment", "for example 55 deg")
STEP = ("step of the table", "for example 1 deg")

QUANTITIES: list[tuple[str, Call, tuple[str, str], list[tuple[Any, str]]]] = [
    ("cycle_time", cm.cycle_time, RATE, POSITIVE),
    ("indexing_time", lambda v: cm.indexing_time(v, 2000), ANGLE, [*POSITIVE, (361, "is 361 deg")]),
    ("indexing_time", lambda v: cm.indexing_time(55, v), RATE, POSITIVE),
    *[
        row
        for peak in (cm.peak_velocity, cm.peak_acceleration, cm.peak_jerk)
        for row in (
            (peak.__name__, lambda v, f=peak: f(v, 55, 2000), STROKE, POSITIVE),
            (peak.__name__, lambda v, f=peak: f(50, v, 2000), ANGLE, POSITIVE),
            (peak.__name__, lambda v, f=peak: f(50, 55, v), RATE, POSITIVE),
        )
    ],
    (
        "Move",
        lambda v: cm.Move(stroke_mm=v, angle_deg=55, rate_per_hour=2000),
        STROKE,
        ONE_POSITIVE,
    ),
    (
        "Move",
        lambda v: cm.Move(stroke_mm=50, angle_deg=v, rate_per_hour=2000),
        ANGLE,
        ONE_POSITIVE,
    ),
    (
        "Move",
        lambda v: cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=v),
        RATE,
        ONE_POSITIVE,
    ),
    *[
        (f"Move.{method.__name__}", method, TIME, [*ANYWHERE, (-0.1, "is -0.1 s"), (1, "is 1 s")])
        for method in (DIE.displacement_mm, DIE.velocity, DIE.acceleration, DIE.jerk)
    ],
    (
        "MotionLaw()",
        cm.LAWS["cycloidal"],
        PLACE,
        [*ANYWHERE, (-1e-9, "is -1e-09"), (1.5, "is 1.5;")],
    ),
    (
        "MotionLaw.inverse",
        cm.LAWS["cycloidal"].inverse,
        WAY,
        [*ANYWHERE, (-1e-9, "is -1e-09"), (1.5, "is 1.5;")],
    ),
    *[
        row
        for part in (cm.rise, cm.return_)
        for row in (
            (part.__name__, lambda v, f=part: f(v, over_deg=55), STROKE, ONE_POSITIVE),
            (part.__name__, lambda v, f=part: f(50, over_deg=v), PART_ANGLE, ONE_PART),
        )
    ],
    ("dwell", cm.dwell, PART_ANGLE, ONE_PART),
    *[
        row
        for end, segment in (
            ("from", {"to_deg": 55, "to_mm": 50}),
            ("to", {"from_deg": 0, "from_mm": 0}),
        )
        for row in (
            (
                f"Segment {end}_deg",
                lambda v, e=end, s=segment: cm.Segment(**{f"{e}_mm": 20, **s, f"{e}_deg": v}),
                CAM_ANGLE,
                ONE_NUMBER,
            ),
            (
                f"Segment {end}_mm",
                lambda v, e=end, s=segment: cm.Segment(**{f"{e}_deg": 20, **s, f"{e}_mm": v}),
                POSITION,
                ONE_NUMBER,
            ),
        )
    ],
    ("motion", lambda v: cm.motion("die", cm.dwell(360), start_deg=v), CAM_ANGLE, ONE_NUMBER),
    ("motion", lambda v: cm.motion("die", cm.dwell(360), start_mm=v), POSITION, ONE_NUMBER),
    (
        "indexing_motion",
        lambda v: cm.indexing_motion("mill", cm.rise(9, over_deg=360), stops=2, start_deg=v),
        CAM_ANGLE,
        ONE_NUMBER,
    ),
    ("TimingDiagram", lambda v: cm.TimingDiagram([PUNCH], v), RATE, ONE_POSITIVE),
    ("Motion.position_mm", PUNCH.position_mm, CAM_ANGLE, ANYWHERE),
    ("Motion.offset_mm", PUNCH.offset_mm, CAM_ANGLE, ANYWHERE),
    ("Motion.derivative", lambda v: PUNCH.derivative(1, v, 2000), CAM_ANGLE, ANYWHERE),
    ("Motion.derivative", lambda v: PUNCH.derivative(1, 180, v), RATE, ONE_POSITIVE),
    ("Motion.where_beyond", PUNCH.where_beyond, LIMIT, ONE_NUMBER),
    ("TimingDiagram.angle_deg", DIAGRAM.angle_deg, ANY_TIME, ANYWHERE),
    *[
        row
        for curve in ("position_mm", "offset_mm", "velocity", "acceleration", "jerk")
        for row in (
            (
                f"TimingDiagram.{curve}",
                lambda v, c=curve: getattr(DIAGRAM, c)("punch", v),
                CAM_ANGLE,
                [case for case in ANYWHERE if case[0] is not None],  # None is no angle given
            ),
            (
                f"TimingDiagram.{curve}",
                lambda v, c=curve: getattr(DIAGRAM, c)("punch", time_s=v),
                ANY_TIME,
                [case for case in ANYWHERE if case[0] is not None],
            ),
        )
    ],
    ("beyond", lambda v: cm.beyond("die", v), LIMIT, ONE_NUMBER),
    ("within", lambda v: cm.within("die", v), LIMIT, ONE_NUMBER),
    (
        "write_curves",
        lambda v: cm.write_curves(DIAGRAM, "never-written.csv", step_deg=v),
        STEP,
        [*ONE_POSITIVE, (1e-6, "is 1e-06 deg"), (361, "is 361 deg")],
    ),
]
CASES = [
    pytest.param(call, quantity, value, said, id=f"{name}-{quantity[0].split()[0]}-{value!r:.20}")
    for name, call, quantity, values in QUANTITIES
    for value, said in values
]


@pytest.mark.parametrize(("call", "quantity", "value", "said"), CASES)
def test_nonsense_is_refused_in_words(
    call: Call, quantity: tuple[str, str], value: object, said: str
) -> None:
    name, fix = quantity
    with pytest.raises(cm.InputError, match=rf"^The {name} .*{said}.*: give {fix}\.$"):
        call(value)


LAW_USERS: list[Call] = [
    cm.as_law,
    lambda law: cm.peak_velocity(50, 55, 2000, law),
    lambda law: cm.peak_acceleration(50, 55, 2000, law),
    lambda law: cm.peak_jerk(50, 55, 2000, law),
    lambda law: cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000, law=law),
    lambda law: cm.rise(50, over_deg=55, law=law),
    lambda law: cm.return_(50, over_deg=55, law=law),
]


@pytest.mark.parametrize("law", ["cyclodial", "", None, 3, math.nan, [], ["cycloidal"]])
@pytest.mark.parametrize("call", LAW_USERS)
def test_an_unknown_law_is_refused_with_the_known_ones(call: Call, law: object) -> None:
    known = "did you mean 'cycloidal'" if law == "cyclodial" else "use one of 'constant accel"
    with pytest.raises(cm.InputError, match=rf"^There is no motion law .*: {known}"):
        call(law)


def test_a_law_is_found_in_any_case_and_by_its_other_names() -> None:
    assert cm.as_law("Cycloidal") is cm.LAWS["cycloidal"]
    for law in cm.LAWS.values():
        for name in (law.name.upper(), *law.also_called):
            assert cm.LAWS[name] is law
    assert "cycloidal spline" not in cm.LAWS
    assert cm.LAWS.get("cycloidal spline") is None


@pytest.mark.parametrize("typed", ["55", "4,15", " 4.154 ", "0,806", "-3"])
def test_a_number_in_quotes_is_asked_for_without(typed: str) -> None:
    number = typed.strip().replace(",", ".")
    with pytest.raises(cm.InputError, match=f": give it as a number, {number} without quotes"):
        cm.cycle_time(typed)


def test_a_comma_before_three_digits_is_read_as_makes_sense() -> None:
    with pytest.raises(cm.InputError, match=r"as a number, 2\.000 or 2000 without quotes"):
        cm.cycle_time("2,000")
    with pytest.raises(cm.InputError, match=r"as a number, 1\.250 without quotes"):
        cm.peak_acceleration(50, "1,250", 2000)


@pytest.mark.parametrize("value", [Decimal("2000.5"), Fraction(4001, 2), np.float32(2000.5)])
def test_a_number_may_be_of_any_kind(value: Any) -> None:
    assert cm.cycle_time(value) == cm.cycle_time(2000.5)


def test_a_number_that_no_float_can_hold_and_a_masked_one_are_refused() -> None:
    with pytest.raises(cm.InputError, match="The machine rate is inf pieces/h"):
        cm.cycle_time(10**400)
    for nan in (Decimal("nan"), Decimal("sNaN"), Decimal("-sNaN12")):
        with pytest.raises(cm.InputError, match="The indexing angle is nan deg"):
            cm.indexing_time(nan, 2000)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match=r"The machine rate has masked values.*compressed"):
        cm.cycle_time(np.ma.masked_array([1.0, 2.0], [False, True]))


@pytest.mark.parametrize("law", [None, "cycloid", math.nan])
def test_a_law_needs_an_expression_in_x_alone(law: object) -> None:
    with pytest.raises(cm.InputError, match=r"^The expression of the law 'own' is .*: give"):
        cm.MotionLaw("own", law)


def test_a_law_with_another_symbol_is_refused() -> None:
    t = sympy.Symbol("t")
    with pytest.raises(cm.InputError, match=r"has the symbol t; .* in cammotion\.x alone"):
        cm.MotionLaw("own", t**2)


MOVE_LISTS: list[Any] = [None, 3, "die", [DIE, None], [55]]


@pytest.mark.parametrize("moves", MOVE_LISTS, ids=repr)
@pytest.mark.parametrize("plot", [cm.plot_curves, cm.plot_peaks, cm.plot_inverse_square])
def test_a_plot_of_nothing_is_refused(plot: Call, moves: object) -> None:
    said = r"^plot_\w+ is given moves.*=.*: give .*a move, for example Move\("
    with pytest.raises(cm.InputError, match=said):
        plot(moves)
    with pytest.raises(cm.InputError, match="There is nothing to draw: give one Move"):
        plot([])


def test_plots_refuse_what_does_not_fit() -> None:
    with pytest.raises(cm.InputError, match="There is no curve 'speed': use one of 'displacement'"):
        cm.plot_curves(DIE, curve="speed")
    with pytest.raises(cm.InputError, match="1 moves but 2 labels"):
        cm.plot_peaks([DIE], labels=["a", "b"])
    slower = cm.Move(stroke_mm=50, angle_deg=110, rate_per_hour=1000)
    with pytest.raises(cm.InputError, match="differ in more than their angle"):
        cm.plot_inverse_square([DIE, slower])


@pytest.mark.parametrize("reference", [None, 55, "die", [DIE]])
def test_an_explorer_needs_a_move(reference: object) -> None:
    with pytest.raises(
        cm.InputError, match=r"^explore_move is given reference=.*: give a move, for"
    ):
        cm.explore_move(reference)  # type: ignore[arg-type]


def test_a_long_value_is_cut_in_the_sentence() -> None:
    with pytest.raises(cm.InputError) as refusal:
        cm.cycle_time(["x" * 10_000])
    assert len(str(refusal.value)) < 200


def test_refusals_are_value_errors() -> None:
    assert issubclass(cm.InputError, ValueError)
