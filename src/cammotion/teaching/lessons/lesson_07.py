"""Exercises of notebook 07, from the diagram to the cam."""

import math
from functools import partial

import numpy as np

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MINUTES_PER_HOUR,
    MM_PER_M,
    STANDARD_GRAVITY,
    indexing_time,
    peak_acceleration,
)
from cammotion.teaching.cam_numbers import HARDEST, LESSONS_CAM, bend_mm
from cammotion.teaching.copied import with_one_of_the_lesson
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.lessons.lesson_03 import IN_DEGREES, law_in_degrees
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.cams import face_under_contact, push_at_mid_stroke

STEEPEST_DEG = 30
ROLLER_MM = 10  # that of the lesson

PER_DEG = (
    "The slope was taken per degree. It is a length if the cam angle counts in radians: divide the "
    "angle in deg by 57.3 first."
)
_THREE_QUARTERS = (
    "Three quarters of the time are more than three quarters of the stroke: put x into the law."
)
SINE_LOST = (
    "The sign of the sine is lost: at x = 3/4 it is -1, so the displacement is more than three "
    "quarters of the stroke."
)
_ROLLER = (
    "The roller's radius was counted. The prime circle goes through the roller's centre, so that "
    "the radius is not in it."
)
_WEIGHT = "The weight was counted. The die moves level: it neither presses nor pulls."
_NO_2_PI = "The factor 2 pi of the peak acceleration is missing."
_ONCE = "The time of the rise has to be squared: in an acceleration it counts twice."
_MM_TAKEN = "acceleration was taken in mm/s², or the mass in grams."
_G = (STANDARD_GRAVITY, 9.81, 10)  # m/s², as one reckons with it
_BEND = (
    "This slope is the second derivative, 2 pi times the stroke over the square of the angle. How "
    "far the contact goes aside is the first one, twice the stroke over the angle."
)
_LAW = LAWS["cycloidal"]
_MOVE = EXAMPLE.stroke_mm, EXAMPLE.die_angle_deg
_LESSONS_ROLLER = *_MOVE, LESSONS_CAM.prime_mm
_LESSONS_FACE = *_MOVE, LESSONS_CAM.base_mm
_LESSONS_SPRING = EXAMPLE.die_mass_kg, *_MOVE, EXAMPLE.rate_per_hour, LESSONS_CAM.spring_N_per_mm


def _angle(m: MillAndDie) -> float:
    """Return the indexing angle of the die in rad."""
    return math.radians(m.die_angle_deg)


def _time(m: MillAndDie) -> float:
    """Return how long the rise takes in s."""
    return float(indexing_time(m.die_angle_deg, m.rate_per_hour))


def _slope(m: MillAndDie) -> float:
    """Return the largest slope in mm/rad, at mid-stroke."""
    return 2 * m.stroke_mm / _angle(m)


def _hardest_mm(m: MillAndDie) -> float:
    """Return where the die is when it brakes hardest, in mm."""
    return m.stroke_mm * float(_LAW(HARDEST))


def _bend(m: MillAndDie) -> float:
    """Return the largest second derivative in mm/rad²."""
    return bend_mm(m.stroke_mm, m.die_angle_deg)


def _pressure(slope: float, height: float) -> float:
    return math.degrees(math.atan2(slope, height))


def _sine_taken(ratio: float) -> float:
    """Return the angle in deg whose sine is a ratio, NaN for a ratio that is none."""
    return math.degrees(math.asin(ratio)) if ratio <= 1 else math.nan


def _height(m: MillAndDie) -> float:
    """Return how far the roller's centre is over the axis at mid-stroke, in mm."""
    return m.cam.prime_mm + m.stroke_mm / 2


def _needed(m: MillAndDie, ratio: float = math.tan(math.radians(STEEPEST_DEG))) -> float:
    return _slope(m) / ratio - m.stroke_mm / 2


def _needed_all_over(m: MillAndDie) -> float:
    """Return the prime circle in mm that keeps the angle all over the rise.

    The place that needs most is where tan(pi x) is 2 pi / (Bm tan(angle)).
    """
    ratio = 1 / (_angle(m) * math.tan(math.radians(STEEPEST_DEG)))
    x = math.atan(2 * math.pi * ratio) / math.pi
    return m.stroke_mm * (ratio * float(_LAW(x, 1)) - float(_LAW(x)))


def _steepest_all_over(m: MillAndDie) -> float:
    """Return the largest pressure angle all over the rise in deg, of many places."""
    x = np.linspace(0, 1, 20_001)
    slopes, places = m.stroke_mm * _LAW(x, 1) / _angle(m), m.stroke_mm * _LAW(x)
    return float(np.degrees(np.arctan2(slopes, m.cam.prime_mm + places)).max())


def _push(m: MillAndDie, angle_deg: float | None = None) -> float:
    """Return the largest inertia force in N, of the die's angle or of another."""
    peak = peak_acceleration(m.stroke_mm, angle_deg or m.die_angle_deg, m.rate_per_hour)
    return m.die_mass_kg * float(peak)


def _preload(m: MillAndDie, stretched_mm: float | None = None) -> float:
    way = _hardest_mm(m) if stretched_mm is None else stretched_mm
    return _push(m) - m.cam.spring_N_per_mm * way


def _with_push(m: MillAndDie, times: float) -> float:
    """Return the preload in N with so many times the push."""
    return times * _push(m) - m.cam.spring_N_per_mm * _hardest_mm(m)


def _weighed(m: MillAndDie, g: float) -> float:
    return _preload(m) + g * m.die_mass_kg


def _preload_all_over(m: MillAndDie) -> float:
    """Return the preload in N that keeps the die on its cam all over the rise.

    The place that needs most is where the derivative of the brake less the spring's force is 0.
    """
    gain = m.cam.spring_N_per_mm * m.stroke_mm
    angle = 2 * math.pi - math.acos(gain / (gain - 2 * math.pi * _push(m)))
    return -_push(m) * math.sin(angle) - gain * float(_LAW(angle / (2 * math.pi)))


def sine_added(stroke_mm: float) -> float:
    """Return where a cycloid would be at x = 3/4 if its sine had another sign, in mm."""
    return stroke_mm * (2 * HARDEST - float(_LAW(HARDEST)))


def _in_degrees(m: MillAndDie) -> float:
    """Return where the die would be at x = 3/4 if the sine took 2 pi x for degrees, in mm."""
    return m.stroke_mm * law_in_degrees(HARDEST)


def _radius(m: MillAndDie) -> float:
    return _radius_of(m.stroke_mm, m.die_angle_deg, m.cam.base_mm)


def _pressure_of(stroke_mm: float, angle_deg: float, prime: float) -> float:
    """Return the pressure angle of 07.1 by what stands in its question."""
    return _pressure(2 * stroke_mm / math.radians(angle_deg), prime + stroke_mm / 2)


def _radius_of(stroke_mm: float, angle_deg: float, base: float) -> float:
    """Return the radius of 07.4 by what stands in its question."""
    return base + stroke_mm * float(_LAW(HARDEST)) - bend_mm(stroke_mm, angle_deg)


def _preload_of(
    mass_kg: float, stroke_mm: float, angle_deg: float, rate: float, spring: float
) -> float:
    """Return the preload of 07.5 by what stands in its question."""
    peak = float(peak_acceleration(stroke_mm, angle_deg, rate))
    return mass_kg * peak - spring * stroke_mm * float(_LAW(HARDEST))


def _sharpest_all_over(m: MillAndDie) -> float:
    """Return the least radius of curvature all over the rise in mm.

    It is where the derivative of displacement and second derivative is 0.
    """
    x = 1 - math.acos(1 / (1 - (2 * math.pi / _angle(m)) ** 2)) / (2 * math.pi)
    return m.cam.base_mm + m.stroke_mm * float(_LAW(x) + _LAW(x, 2) / _angle(m) ** 2)


EXERCISES = (
    NumberExercise(
        number="07.1",
        question=lambda m: (
            f"The die's stroke is {m.stroke_mm:g} mm, over {m.die_angle_deg:g} degrees, by the "
            f"cycloidal law. Its follower is a roller on a slide over the cam's axis, and the "
            f"prime circle has a radius of {m.cam.prime_mm:g} mm. How large is the pressure angle "
            "at mid-stroke?"
        ),
        unit="deg",
        answer=lambda m: _pressure(_slope(m), _height(m)),
        mixed=lambda m: with_one_of_the_lesson(
            _pressure_of, (m.stroke_mm, m.die_angle_deg, m.cam.prime_mm), _LESSONS_ROLLER
        ),
        lessons=lambda: _pressure_of(*_LESSONS_ROLLER),
        right="Only slope and distance from the axis count: the roller's radius is not in it.",
        slips=(
            Slip(
                lambda m: math.degrees(_slope(m) / math.degrees(1) / _height(m)),
                "This is what a slope per degree leads to, and the tangent itself is nearly the "
                "same number. Let the cam angle count in radians, and take the angle of the "
                "tangent.",
            ),
            Slip(
                lambda m: _pressure(_slope(m) / 2, _height(m)),
                "This is the angle for the mean slope, stroke over angle. At mid-stroke the "
                "cycloid goes twice as fast.",
            ),
            Slip(
                lambda m: _pressure(_slope(m), m.cam.prime_mm),
                "The roller's centre is on the prime circle only before the rise. At mid-stroke "
                "it is half the stroke further out.",
            ),
            Slip(
                _steepest_all_over,
                "This is the largest angle all over the rise: a little before mid-stroke the "
                "roller is nearer to the axis. Asked for is mid-stroke.",
            ),
            Slip(lambda m: _pressure(_slope(m), _height(m) + ROLLER_MM), _ROLLER),
            Slip(lambda m: _pressure(_slope(m), _height(m) - ROLLER_MM), _ROLLER),
            Slip(
                lambda m: _pressure(_slope(m), (m.cam.prime_mm + m.stroke_mm) / 2),
                "Half of the prime circle's radius was taken, as if that were its diameter.",
            ),
            Slip(
                lambda m: _pressure(_slope(m), 2 * m.cam.prime_mm + m.stroke_mm / 2),
                "The prime circle's diameter was taken. The distance from the axis is its radius, "
                "and half the stroke.",
            ),
            Slip(
                lambda m: _pressure(_slope(m), m.cam.prime_mm - m.stroke_mm / 2),
                "Half the stroke was taken away. At mid-stroke the roller has gone out by it: add "
                "it.",
            ),
            Slip(
                lambda m: math.degrees(_slope(m) / _height(m)),
                "This is the tangent, made degrees as if it were the angle in radians. Which angle "
                "has this tangent?",
            ),
            Slip(
                lambda m: _pressure(_slope(m), m.cam.prime_mm + m.stroke_mm),
                "The whole stroke was added. At mid-stroke the die has done half of it.",
            ),
            Slip(
                lambda m: _pressure(_height(m), _slope(m)),
                "Upside down: the slope stands above, the distance from the axis below.",
            ),
            Slip(
                lambda m: math.atan2(_slope(m), _height(m)),
                "This is the angle in radians. It is asked for in degrees.",
            ),
            Slip(
                lambda m: _pressure(_slope(m), m.stroke_mm / 2),
                "The prime circle is missing: the distance counts from the cam's axis.",
            ),
            Slip(
                lambda m: _pressure(math.pi * _slope(m), _height(m)),
                "This slope is 2 pi times the mean one, and 2 pi belongs to the acceleration. The "
                "largest slope of the cycloid is twice the mean one.",
            ),
            Slip(
                lambda m: _sine_taken(_slope(m) / _height(m)),
                "Slope and distance are the two short sides of the triangle: take the tangent, "
                "not the sine.",
            ),
        ),
        hints=(
            "Which two lengths make the tangent of the pressure angle?",
            "The slope of the cycloid at mid-stroke is twice the stroke over the angle in rad.",
            "The distance of the roller's centre from the axis is the prime circle's radius and "
            "half the stroke.",
        ),
    ),
    NumberExercise(
        number="07.2",
        question=lambda m: (
            f"The same die, {m.stroke_mm:g} mm over {m.die_angle_deg:g} degrees, cycloidal. Which "
            f"prime circle keeps the pressure angle at mid-stroke at {STEEPEST_DEG} degrees? Give "
            "its radius."
        ),
        unit="mm",
        answer=_needed,
        shows=push_at_mid_stroke(STEEPEST_DEG),
        right="Half the angle of the move, twice the slope: a small angle is paid for in steel.",
        slips=(
            Slip(
                lambda m: _needed(m) + m.stroke_mm / 2,
                "This is how far the roller's centre is from the axis at mid-stroke. The prime "
                "circle is where it begins, half the stroke nearer.",
            ),
            Slip(
                lambda m: _needed(m) - m.stroke_mm / 2,
                "The whole stroke was taken away. At mid-stroke the die has done half of it.",
            ),
            Slip(
                lambda m: _needed(m) + m.stroke_mm,
                "Half the stroke was added. The roller has gone out by it already: take it away.",
            ),
            Slip(
                lambda m: _needed(m, math.sin(math.radians(STEEPEST_DEG))),
                "The slope was divided by the sine. The two lengths are the short sides of the "
                "triangle: take the tangent.",
            ),
            Slip(
                lambda m: _needed(m, 1 / math.tan(math.radians(STEEPEST_DEG))),
                "The slope was multiplied by the tangent. The tangent is the slope over the "
                "distance: divide by it.",
            ),
            Slip(
                lambda m: _needed(m, 2 * math.tan(math.radians(STEEPEST_DEG))),
                "This comes out with the mean slope, stroke over angle. At mid-stroke the cycloid "
                "goes twice as fast.",
            ),
            Slip(
                lambda m: _needed(m, math.degrees(1) * math.tan(math.radians(STEEPEST_DEG))),
                PER_DEG,
            ),
            Slip(
                lambda m: _needed(m, math.tan(math.radians(STEEPEST_DEG)) / math.pi),
                "This slope is 2 pi times the mean one, and 2 pi belongs to the acceleration. The "
                "largest slope of the cycloid is twice the mean one.",
            ),
            Slip(
                lambda m: _needed(m, math.cos(math.radians(STEEPEST_DEG))),
                "The slope was divided by the cosine. The two lengths are the short sides of the "
                "triangle: take the tangent.",
            ),
            Slip(
                lambda m: (_needed(m) + m.stroke_mm / 2) / 2,
                "This is the mean slope, stroke over angle, over the tangent. At mid-stroke the "
                "cycloid goes twice as fast, and the roller is half the stroke further out.",
            ),
            Slip(
                lambda m: _needed(m, math.tan(STEEPEST_DEG)),
                f"The tangent was taken of {STEEPEST_DEG} rad. Tell your calculator, or NumPy, "
                "that it is in degrees.",
            ),
            Slip(
                _needed_all_over,
                "This keeps the angle all over the rise: the worst place is a little before "
                "mid-stroke, where the roller is nearer to the axis. Asked for is mid-stroke.",
            ),
            Slip(lambda m: _needed(m) + ROLLER_MM, _ROLLER),
            Slip(lambda m: _needed(m) - ROLLER_MM, _ROLLER),
            Slip(
                lambda m: 2 * _needed(m),
                "This is the diameter. The radius is asked for.",
            ),
        ),
        hints=(
            "Turn the formula of 07.1 round: which distance from the axis makes the angle 30 deg?",
            "The distance is the slope over the tangent of the angle.",
            "It is the prime circle's radius and half the stroke together.",
        ),
    ),
    NumberExercise(
        number="07.3",
        question=lambda m: (
            f"Now the same die, {m.stroke_mm:g} mm over {m.die_angle_deg:g} degrees each way, "
            "cycloidal, gets a follower with a flat face. How wide does the face have to be at "
            "least, from the contact furthest left to the one furthest right?"
        ),
        unit="mm",
        answer=lambda m: 2 * _slope(m),
        shows=face_under_contact,
        right="The contact wanders as far as the slope is long, and no base circle changes that.",
        slips=(
            Slip(
                _slope,
                "This is one side, or both with the mean slope. The contact goes out by the "
                "largest slope, to the right on the one way and to the left on the other.",
            ),
            Slip(lambda m: 2 * _slope(m) / math.degrees(1), PER_DEG),
            Slip(lambda m: _slope(m) / math.degrees(1), PER_DEG),
            Slip(
                lambda m: 4 * _slope(m),
                "This is twice too wide: the largest slope is twice the mean one, and the face "
                "has two sides. That makes four times the mean slope.",
            ),
            Slip(
                lambda m: m.stroke_mm,
                "The stroke is how far the face goes up. How far does the contact go aside?",
            ),
            Slip(
                lambda m: 2 * m.stroke_mm,
                "The stroke is how far the face goes up. How far does the contact go aside?",
            ),
            Slip(
                lambda m: math.pi * _slope(m),
                "This slope is 2 pi times the mean one, and on one side. 2 pi belongs to the "
                "acceleration; the largest slope of the cycloid is twice the mean one.",
            ),
            Slip(
                lambda m: _slope(m) / 2,
                "This is the mean slope. The largest one counts, and on both sides.",
            ),
            Slip(_bend, _BEND),
            Slip(lambda m: 2 * _bend(m), _BEND),
        ),
        hints=(
            "How far from the axis is the face touched, in terms of the displacement?",
            "As far as the slope of the displacement, in mm per rad.",
            "The largest slope is twice the stroke over the angle in radians, and the return "
            "needs as much on the other side.",
        ),
    ),
    NumberExercise(
        number="07.4",
        question=lambda m: (
            f"The same die with its flat face: {m.stroke_mm:g} mm over {m.die_angle_deg:g} "
            f"degrees, cycloidal. The base circle has a radius of {m.cam.base_mm:g} mm. How large "
            "is the profile's radius of curvature where the rise brakes hardest, at x = 3/4?"
        ),
        unit="mm",
        answer=_radius,
        mixed=lambda m: with_one_of_the_lesson(
            _radius_of, (m.stroke_mm, m.die_angle_deg, m.cam.base_mm), _LESSONS_FACE
        ),
        lessons=lambda: _radius_of(*_LESSONS_FACE),
        right="The acceleration is in the steel: what brakes hard makes the cam sharp.",
        slips=(
            Slip(
                lambda m: m.cam.base_mm + _hardest_mm(m),
                "This is how far the face is from the axis. The second derivative by the rad is "
                "missing: it makes the profile sharper.",
            ),
            Slip(
                lambda m: m.cam.base_mm + _hardest_mm(m) + _bend(m),
                "The second derivative was added with its magnitude. At x = 3/4 the die brakes, "
                "and it is below 0.",
            ),
            Slip(
                lambda m: m.cam.base_mm - _bend(m),
                "The displacement is missing: the face has gone out already.",
            ),
            Slip(
                _sharpest_all_over,
                "This is the least radius all over the rise: a little before x = 3/4 the face is "
                "nearer to the axis. Asked for is x = 3/4.",
            ),
            Slip(
                lambda m: m.cam.base_mm + 0.75 * m.stroke_mm - _bend(m),
                _THREE_QUARTERS,
            ),
            Slip(lambda m: m.cam.base_mm + sine_added(m.stroke_mm) - _bend(m), SINE_LOST),
            Slip(lambda m: m.cam.base_mm + _in_degrees(m) - _bend(m), IN_DEGREES),
            Slip(
                lambda m: m.cam.base_mm + m.stroke_mm - _bend(m),
                "The whole stroke was added. At x = 3/4 the die has not quite done it.",
            ),
            Slip(
                lambda m: m.cam.base_mm + _hardest_mm(m) - _bend(m) / math.degrees(1) ** 2,
                "The second derivative was taken per degree. It has to be by the radian, squared.",
            ),
            Slip(
                lambda m: m.cam.base_mm + _hardest_mm(m) - _bend(m) / math.pi,
                "This second derivative has a factor of 2 in place of 2 pi. Differentiate the law "
                "twice.",
            ),
            Slip(
                lambda m: m.cam.base_mm + m.stroke_mm - _hardest_mm(m) - _bend(m),
                "This displacement is the one at x = 1/4, where the die is still pushed.",
            ),
            Slip(
                lambda m: m.cam.base_mm + m.stroke_mm - _hardest_mm(m) + _bend(m),
                "This is the radius at x = 1/4, where the die is pushed hardest, displacement and "
                "second derivative. Put in x = 3/4.",
            ),
            Slip(
                lambda m: m.cam.base_mm + m.stroke_mm / 2 - _bend(m),
                "This displacement is that of mid-stroke. At x = 3/4 the die has gone further.",
            ),
            Slip(
                lambda m: _hardest_mm(m) - _bend(m),
                "The base circle is missing: it is the first of the three lengths.",
            ),
            Slip(
                lambda m: _radius(m) - ROLLER_MM,
                "A roller's radius was taken off. Under a flat face there is none: this is the "
                "profile itself.",
            ),
            Slip(
                lambda m: m.cam.base_mm + _hardest_mm(m) - _bend(m) / (2 * math.pi),
                "The factor 2 pi of the second derivative is missing. Differentiate the law twice.",
            ),
            Slip(
                lambda m: m.cam.base_mm + _hardest_mm(m) - _bend(m) * _angle(m),
                "The angle has to be squared: in the second derivative it counts twice.",
            ),
            Slip(
                lambda m: m.cam.base_mm + _hardest_mm(m) - _bend(m) / math.degrees(1),
                "The second derivative was made one by the radian once, and it has to be twice: "
                "square the angle in radians.",
            ),
        ),
        hints=(
            "Which three lengths add up to the radius of curvature under a flat face?",
            "Base radius, displacement, and its second derivative by the rad.",
            "The second derivative at x = 3/4 is -2 pi times the stroke over the square of the "
            "angle in radians.",
        ),
    ),
    NumberExercise(
        number="07.5",
        question=lambda m: (
            f"The die, {m.die_mass_kg:g} kg, moves level, {m.stroke_mm:g} mm over "
            f"{m.die_angle_deg:g} degrees, cycloidal, at {m.rate_per_hour:g} pieces per hour. A "
            f"spring of {m.cam.spring_N_per_mm:g} N/mm presses it on its open cam. Which preload "
            "at the start of the rise keeps it there at x = 3/4, where it brakes hardest?"
        ),
        unit="N",
        answer=_preload,
        mixed=lambda m: with_one_of_the_lesson(
            _preload_of,
            (m.die_mass_kg, m.stroke_mm, m.die_angle_deg, m.rate_per_hour, m.cam.spring_N_per_mm),
            _LESSONS_SPRING,
        ),
        lessons=lambda: _preload_of(*_LESSONS_SPRING),
        right="The spring brakes an open follower: four times as hard at twice the rate. A little "
        "before x = 3/4 it is pressed less, so all over the rise it needs a little more.",
        slips=(
            Slip(
                _push,
                "This is the whole force that brakes the die. The spring has been pressed "
                "together meanwhile, which gives a part of it.",
            ),
            Slip(
                lambda m: _preload(m, -_hardest_mm(m)),
                "The force from pressing the spring together was added. It helps: take it away.",
            ),
            Slip(
                lambda m: _preload(m, m.stroke_mm),
                "The spring is not yet pressed together by the whole stroke: put x = 3/4 into the "
                "law.",
            ),
            Slip(lambda m: _preload(m, 0.75 * m.stroke_mm), _THREE_QUARTERS),
            Slip(lambda m: _preload(m, sine_added(m.stroke_mm)), SINE_LOST),
            Slip(lambda m: _preload(m, _in_degrees(m)), IN_DEGREES),
            Slip(
                _preload_all_over,
                "This keeps the die on its cam all over the rise: a little before x = 3/4 the "
                "spring gives less, and the brake is nearly as hard. Asked for is x = 3/4.",
            ),
            Slip(
                lambda m: _preload(m, m.stroke_mm - _hardest_mm(m)),
                "This is how far the spring is pressed at x = 1/4, where the cam pushes the die.",
            ),
            Slip(
                lambda m: _preload(m, m.stroke_mm / 2),
                "The spring was pressed together by half the stroke, as at mid-stroke, where "
                "nothing brakes the die. At x = 3/4 it is pressed by more: put that into the law.",
            ),
            Slip(
                partial(_with_push, times=MM_PER_M),
                f"The {_MM_TAKEN} For newtons they have to be in m/s² and kg.",
            ),
            Slip(
                partial(_with_push, times=MM_PER_M / (2 * math.pi)),
                f"{_NO_2_PI} Besides, the {_MM_TAKEN}",
            ),
            Slip(
                lambda m: _with_push(m, MM_PER_M * _time(m)),
                f"{_ONCE} Besides, the {_MM_TAKEN}",
            ),
            Slip(
                partial(_with_push, times=100),
                "The 10 of tm = 10 B/N has been lost, which counts twice, or the stroke was taken "
                "in cm where metres belong.",
            ),
            Slip(
                lambda m: _push(m) - m.cam.spring_N_per_mm * _hardest_mm(m) / 1000,
                "The spring's way was taken in metres, and its stiffness is per millimetre.",
            ),
            Slip(
                lambda m: m.cam.spring_N_per_mm * _hardest_mm(m),
                "This is what the spring gains by being pressed together. What is still missing?",
            ),
            *(Slip(partial(_weighed, g=sign * g), _WEIGHT) for g in _G for sign in (1, -1)),
            Slip(
                lambda m: _push(m) - _hardest_mm(m),
                "The stiffness of the spring is missing: the way that it is pressed together is in "
                "mm. Multiply it by the stiffness, then take it away.",
            ),
            Slip(
                lambda m: _preload(m) / m.cam.spring_N_per_mm,
                "This is by how many mm the spring has to be pressed together at the start. Which "
                "force has it then?",
            ),
            Slip(partial(_with_push, times=1 / (2 * math.pi)), _NO_2_PI),
            Slip(lambda m: _with_push(m, _time(m)), _ONCE),
            Slip(
                lambda m: _push(m, DEG_PER_TURN) - m.cam.spring_N_per_mm * _hardest_mm(m),
                "The time of a whole turn was taken for that of the rise.",
            ),
            Slip(
                partial(_with_push, times=MINUTES_PER_HOUR**2),
                "The time of the rise was taken 60 times too short: the pieces are by the hour, "
                "and an hour has 3600 seconds.",
            ),
            Slip(
                partial(_with_push, times=4 / (2 * math.pi)),
                "This is the peak of the constant acceleration, factor 4. The cycloid has 2 pi.",
            ),
        ),
        hints=(
            "Which force brakes the die, and what can give it if the cam can only push?",
            "Mass times the peak acceleration has to come from the spring.",
            "At x = 3/4 the spring has been pressed together by the displacement there. The rest "
            "is the preload.",
        ),
    ),
    ChoiceExercise(
        number="07.6",
        question=lambda _: (
            "The pitch curve of a cam has a radius of 9 mm at its sharpest place, where it bulges "
            "outwards. The roller has 10. What becomes of the follower there?"
        ),
        options={
            "a": "Nothing special: the profile has a radius of 1 mm there, and it rolls over it.",
            "b": "It does not go as far out as it should, and its acceleration jumps.",
            "c": "It goes further out than it should, because the profile has a point.",
            "d": "It gets stuck, because the roller does not fit into the hollow.",
        },
        answer="b",
        reasons={
            "a": "Inside, the profile's radius is the pitch curve's less the roller's: 9 - 10 is "
            "below 0. What has no radius cannot be cut.",
            "c": "The cutter takes away what it meets on its way to and from the place. What is "
            "left is lower than what was wanted.",
            "d": "The place bulges outwards. In a hollow the roller's radius is added, not taken "
            "away.",
        },
        right="The cutter has taken the point away. The roller turns about the corner that is "
        "left, and its acceleration jumps where that begins and where it ends.",
        hints=(
            "How large would the profile's radius of curvature be?",
            "A cutter as large as the roller goes along the pitch curve. What does it take away "
            "where its path bends more sharply than its own edge?",
            "It takes away a part of the profile that it has just made.",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "07.lift",
        "mm",
        6.3,
        "It feels as if a roller of any size would do the same, since it only rolls. It touches "
        "the cam beside its lowest point wherever the cam is steep.",
    ),
    Prediction(
        "07.steel",
        "mm",
        156.8,
        "Five times 58 is too much: the acceleration goes with the square of the angle, the slope "
        "with the angle. And 2.27 times 58 is too little: what the die has risen counts too.",
    ),
)
