"""Exercises of notebook 06, how good it can get."""

import math
from functools import partial

import sympy

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MM_PER_M,
    STANDARD_GRAVITY,
    cycle_time,
    peak_acceleration,
)
from cammotion.teaching.copied import with_one_of_the_lesson
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import push_of_force
from cammotion.teaching.shown.ways import peak_of_die, push_up

SCREW_LEAD_MM = 10
MOTOR_INERTIA = 1e-4
"""Of the servo in 06.5, in kg m2."""

_ACCELERATION = 0.6
_r = sympy.Symbol("r")
_HALF = sympy.Rational(1, 2)


def _turn_deg(m: MillAndDie) -> float:
    """Return how long the die is on its way to the farthest point, in deg."""
    return (DEG_PER_TURN - m.work_deg) / 2


def _rise_mm(m: MillAndDie) -> float:
    """Return how high the die has to be when the mill sets off."""
    return m.stroke_mm - m.limit_mm


def _per_acceleration(time: float, half: float) -> float:
    """Return the way made after a time, pushed for `half` and then braked, by unit acceleration."""
    late = max(time - half, 0)
    return time**2 / 2 - late**2


def _seconds(m: MillAndDie) -> float:
    """Return the time of a degree."""
    return float(cycle_time(m.rate_per_hour)) / DEG_PER_TURN


def _times(m: MillAndDie) -> tuple[float, float, float]:
    """Return when the die has to be so high and when the brake begins, in deg; a degree in s."""
    return m.overlapped_deg, _turn_deg(m) / 2, _seconds(m)


def _push(m: MillAndDie, high_deg: float, half_deg: float, seconds: float) -> float:
    """Return the push in m/s2 by which the die of a machine is so high in time."""
    return _rise_mm(m) / MM_PER_M / _per_acceleration(high_deg, half_deg) / seconds**2


def _least(m: MillAndDie) -> float:
    """Return the least peak of the die, in m/s2, free to move as it likes."""
    return _push(m, *_times(m))


def _cycloidal(m: MillAndDie, angle_deg: float | None = None) -> float:
    angle = angle_deg or m.told_deg
    return float(peak_acceleration(m.stroke_mm, angle, m.rate_per_hour))


def _times_least(m: MillAndDie, stroke_mm: float, widest_deg: float) -> float:
    return float(peak_acceleration(stroke_mm, widest_deg, m.rate_per_hour)) / _least(m)


def _widest(m: MillAndDie) -> tuple[float, float]:
    """Return the stroke in mm and the widest angle in deg that 06.4 asks about."""
    return m.stroke_mm, m.told_deg


def _steady(m: MillAndDie, way_mm: float, angle_deg: float) -> float:
    """Return the peak of the law of constant acceleration, from rest to rest."""
    return float(peak_acceleration(way_mm, angle_deg, m.rate_per_hour, law="constant acceleration"))


def _by_way(m: MillAndDie, way_deg2: float) -> float:
    """Return how hard it would be if so much way were made by an acceleration of 1 per deg2."""
    return _rise_mm(m) / MM_PER_M / way_deg2 / _seconds(m) ** 2


def _braked_deg(m: MillAndDie) -> float:
    """Return for how many deg it is braked until it has to be so high, NaN if not yet at all."""
    braked = m.overlapped_deg - _turn_deg(m) / 2
    return braked if braked > 0 else math.nan


def _still_pushed_deg(m: MillAndDie) -> float:
    """Return for how many deg it is pushed on after it has to be so high, NaN if no more."""
    pushed = _turn_deg(m) / 2 - m.overlapped_deg
    return pushed if pushed > 0 else math.nan


def _turned() -> float:
    """Return by how many radians the screw turns in a metre."""
    return 2 * math.pi / SCREW_LEAD_MM * MM_PER_M


def _added_mass() -> float:
    """Return for how many kg at the die the inertia of the motor counts."""
    return MOTOR_INERTIA * _turned() ** 2


def _force(m: MillAndDie) -> float:
    return (m.die_mass_kg + _added_mass()) * _ACCELERATION


def _left(m: MillAndDie) -> float:
    """Return which share of its way the hammer of 06.1 would not make with the speed it has."""
    return 1 - m.laws.head_start


def _to_rest(start: float) -> float:
    """Return the least factor from a velocity at the start to rest at the end."""
    left = 2 - start
    return left + math.hypot(left, start)


def _sets_off(m: MillAndDie) -> str:
    start = m.laws.head_start
    return f"sets off with {start:g} times its mean velocity" if start else "starts from rest"


def _and_stays(m: MillAndDie) -> str:
    pause = m.laws.pause
    if not pause:
        return " at $x = 1/2$"
    return f", where it stays for the share {pause:g} of the whole time, about $x = 1/2$"


def _still(m: MillAndDie) -> sympy.Expr:
    """Return the share of the time for which nothing pushes in 06.2."""
    return sympy.Rational(str(m.laws.pause))


def _in_the_middle(m: MillAndDie) -> sympy.Expr:
    """Return the velocity of the law of 06.2 in the middle, where it stays for its pause."""
    return 2 / (1 + _still(m))


def _pushed(m: MillAndDie) -> sympy.Expr:
    """Return for which share of the time it is pushed, before the pause."""
    return (1 - _still(m)) / 2


def _ramped(m: MillAndDie) -> sympy.Expr:
    return _in_the_middle(m) / (_pushed(m) - _r)


def _without_ramps(m: MillAndDie) -> sympy.Expr:
    return _in_the_middle(m) / _pushed(m)


def _times_longer(m: MillAndDie) -> sympy.Expr:
    """Return r as a share of the push."""
    return _r / _pushed(m)


EXERCISES = (
    NumberExercise(
        number="06.1",
        question=lambda m: (
            f"A hammer {_sets_off(m)}, and it may arrive at any speed. What is the smallest $C_a$ "
            "that any law for it can have?"
        ),
        unit="",
        answer=lambda m: 2 * _left(m),
        lessons=lambda: math.nan,  # it has no hammer
        right=(
            "It is pushed evenly all the way. To have to stop as well would cost at least as much "
            "again."
        ),
        slips=(
            Slip(
                lambda m: 4.0,
                "This holds for a move from rest to rest. Without rest at the end there is nothing "
                "to take away from the weight 1 - x.",
            ),
            Slip(
                lambda m: 4 * _left(m) if m.laws.head_start else math.nan,
                "This brakes in the second half, as if it had to stop. The hammer may arrive at "
                "any speed, and can be pushed all the way.",
            ),
            Slip(
                lambda m: _to_rest(m.laws.head_start) if m.laws.head_start else math.nan,
                "This is for a hammer that has to stop. It may arrive at any speed, and can be "
                "pushed all the way.",
            ),
            Slip(
                lambda m: 4 - 2 * m.laws.head_start if m.laws.head_start else math.nan,
                "Here one half was taken away from the weight 1 - x. That is done for a hammer "
                "that has to stop, and with a speed at the start even such a one needs more than "
                "this. Yours may arrive at any speed: take nothing away.",
            ),
            Slip(
                lambda m: 2.0 if m.laws.head_start else math.nan,
                "This is for a hammer that starts from rest. The speed at the start makes a part "
                "of the way.",
            ),
            Slip(
                lambda m: 2 * (2 - _left(m)) if m.laws.head_start else math.nan,
                "The speed at the start was counted against the hammer. It helps: what is left to "
                "do gets less.",
            ),
            Slip(
                lambda m: 2 - m.laws.head_start if m.laws.head_start else math.nan,
                "The speed at the start was taken away once. How far does the hammer come with it "
                "alone, and what is then the push for the rest?",
            ),
            Slip(
                lambda m: 0.5,
                "This is the integral of the weight 1 - x. The bound is divided by it.",
            ),
            Slip(
                _left,
                "This even push brings it only half as far as it has to: the way that a push adds "
                "is half the acceleration times the time squared.",
            ),
            Slip(
                lambda m: 0.0,
                "With the speed that it has at the start alone it does not arrive in its time.",
            ),
            Slip(
                lambda m: LAWS["cycloidal"].Ca,
                "This is the cycloid, which comes to rest at the end. The hammer need not.",
            ),
            Slip(
                lambda m: LAWS["cycloidal"].Ca * _left(m) if m.laws.head_start else math.nan,
                "This is the cycloid for the rest of the way. It comes to rest at the end; the "
                "hammer need not.",
            ),
            Slip(
                lambda m: LAWS["cycloidal"].Ca / 2,
                "This is half of the cycloid. Half is a good thought, but of which law?",
            ),
            Slip(
                lambda m: LAWS["modified trapezoid"].Ca,
                "This is the modified trapezoid, which comes to rest at the end. The hammer need "
                "not.",
            ),
            Slip(
                lambda m: LAWS["simple harmonic"].Ca,
                "This is the simple harmonic motion, which comes to rest at the end. The hammer "
                "need not.",
            ),
            Slip(
                lambda m: LAWS["simple harmonic"].Ca / 2 * _left(m),
                "This is half a simple harmonic motion, pushed by a cosine. That is at its peak "
                "only for a moment. Can a law be there for longer?",
            ),
            Slip(
                lambda m: LAWS["cubic"].Ca * _left(m),
                "This is a push that grows evenly from nothing, as for S = x³, and is not at its "
                "peak all the time. Can a law be there for longer?",
            ),
            Slip(
                lambda m: STANDARD_GRAVITY,
                "This is free fall. Ca has no unit, and is good for any stroke and any time.",
            ),
        ),
        hints=(
            "S(1) = 1 is still the integral of (1 - x) A, and what the speed at the start brings "
            "comes on top. What has become of the other condition?",
            "V(1) is free now, so nothing may be taken away from the weight.",
            "The integral of 1 - x from 0 to 1 is one half. The peak times this is at least what "
            "is left to do.",
        ),
    ),
    ExpressionExercise(
        number="06.2",
        question=lambda m: (
            "The acceleration of a symmetric law rises along a straight line over the time `r`, "
            f"stays at its peak, and comes down along a line over `r` to zero{_and_stays(m)}; then "
            "the same with the other sign. What is $C_a$? An expression in `r`, or a function of "
            "it."
        ),
        variables=("r",),
        between=(0.0, 0.125),
        answer=_ramped,
        right=(
            "This is the price of a limited jerk, in closed form. Without a pause in the middle "
            "it is 4/(1 - 2r)."
        ),
        slips=(
            Slip(
                lambda m: _in_the_middle(m) / (_pushed(m) - _r / 2),
                "Only one ramp was counted. Up to the middle there are two, one up and one down.",
            ),
            Slip(
                lambda m: _in_the_middle(m) / (_pushed(m) - 2 * _r),
                "A ramp is worth half of a flat piece of its length. Here it counts for nothing.",
            ),
            Slip(
                lambda m: _ramped(m) / 2,
                "Nearly: this comes to rest at the end, but only half-way. While it is pushed its "
                "mean velocity is only half of that in the middle.",
            ),
            Slip(
                lambda m: 4 / (1 - 2 * _r),
                "This is without the pause in the middle. The question has one.",
            ),
            Slip(
                lambda m: 2 / (_pushed(m) - _r),
                "The push is as long as it is, but the velocity in the middle is not 2: through "
                "the pause the law goes on with it, and it need not be so large.",
            ),
            Slip(
                lambda m: _without_ramps(m) * (1 + _times_longer(m)),
                "This is right for very short ramps only. Do not stop after the first term.",
            ),
            Slip(
                lambda m: (
                    _ramped(m) * (1 + _still(m)) / (1 - _still(m)) if _still(m) else sympy.nan
                ),
                "The way of the pause is missing: while nothing pushes, the law goes on with the "
                "velocity that it has in the middle.",
            ),
            Slip(
                lambda m: _in_the_middle(m) / (_HALF - _r) if _still(m) else sympy.nan,
                "The push was taken to last half of the time. A part of that is the pause.",
            ),
            Slip(
                lambda m: 1 / (_pushed(m) - _r) if _still(m) else sympy.nan,
                "The area below A up to the middle is the velocity there, and not the way. How "
                "far does the law come with it, while it is pushed and in the pause?",
            ),
            Slip(
                lambda m: (
                    1 / ((_HALF + _still(m)) * (_HALF - _still(m) - _r)) if _still(m) else sympy.nan
                ),
                "The whole pause was taken off each half of the time. It is shared: half of it "
                "lies before the middle, half after it.",
            ),
            Slip(
                lambda m: _ramped(m) / _r,
                "This is the jerk, the peak over the time of a ramp. The peak itself is asked for.",
            ),
            Slip(
                _without_ramps,
                "This is the law without ramps, at r = 0. A ramp has less area below it, so the "
                "peak has to be higher.",
            ),
            Slip(
                lambda m: 2 * _without_ramps(m),
                "This is a triangle, with the longest ramps that there can be. And before that?",
            ),
            Slip(
                _in_the_middle,
                "This is the velocity in the middle. From which area does it come?",
            ),
            Slip(
                lambda m: _without_ramps(m) * (1 + 2 * _times_longer(m)),
                "This is right without ramps and for a triangle, with the longest ramps, but it is "
                "no straight line between. What is the area below A?",
            ),
            Slip(
                lambda m: _without_ramps(m) * (1 - _times_longer(m)),
                "With longer ramps the peak has to be higher, not lower. Is something upside down?",
            ),
            Slip(
                lambda m: _without_ramps(m) / (1 + _times_longer(m)),
                "With longer ramps the peak has to be higher, not lower. Look at the sign of r.",
            ),
            Slip(
                lambda m: _in_the_middle(m) / (2 * _pushed(m) - _r),
                "Without ramps, at r = 0, this is half of what it has to be. How long is the push, "
                "and how much of it are the ramps?",
            ),
            Slip(
                lambda m: _in_the_middle(m) / (_pushed(m) - 2 * _r + 4 * _r / sympy.pi),
                "This is with quarter waves of a sine, which are fuller. Here the ramps are "
                "straight lines.",
            ),
        ),
        hints=(
            "The area below A up to the middle is the velocity there.",
            "It is Ca times the time of the push less r: a flat piece, and two ramps that count "
            "half.",
            "While it is pushed the mean velocity is half of that in the middle, and in a pause it "
            "is all of it. Up to the middle the way is 1/2.",
        ),
    ),
    NumberExercise(
        number="06.3",
        question=lambda m: (
            f"Your die leaves the bottom at rest, has to be {_rise_mm(m):g} mm up "
            f"{m.overlapped_deg:g} degrees later, and turns round, at rest, after "
            f"{_turn_deg(m):g} degrees; how high that is does not matter. It is pushed evenly for "
            f"the first {_turn_deg(m) / 2:g} degrees and braked as hard for the rest, at "
            f"{m.rate_per_hour:g} pieces per hour. How hard is that?"
        ),
        unit="m/s²",
        answer=_least,
        mixed=lambda m: with_one_of_the_lesson(partial(_push, m), _times(m), _times(EXAMPLE)),
        shows=push_up(
            half_deg=lambda m: _turn_deg(m) / 2,
            seconds_per_deg=_seconds,
            look_deg=lambda m: m.overlapped_deg,
        ),
        right="No motion whatever of this die can do with less, cam or not.",
        slips=(
            Slip(
                lambda m: _by_way(m, m.overlapped_deg**2 / 2),
                "This pushes it all the way to that height. It is being braked already for the "
                "last of these degrees.",
            ),
            Slip(
                lambda m: _least(m) * m.stroke_mm / _rise_mm(m),
                "This is for the whole stroke. So early it need not be all the way up.",
            ),
            Slip(
                lambda m: _least(m) * m.limit_mm / _rise_mm(m),
                "This takes how deep it may be. How far up from the bottom is that?",
            ),
            Slip(
                lambda m: _steady(m, m.stroke_mm, _turn_deg(m)),
                "This makes just the stroke, in the whole time. What counts is the height at the "
                "first angle.",
            ),
            Slip(
                lambda m: _steady(m, _rise_mm(m), m.overlapped_deg),
                "This brings it to rest at that height. It need not rest there, only at the top.",
            ),
            Slip(
                lambda m: _cycloidal(m),
                "This is the cycloid over its widest angle. Here it is an even push, and then an "
                "even brake.",
            ),
            Slip(
                lambda m: _steady(m, _rise_mm(m), _turn_deg(m)),
                "So high it is only where it turns round, too late for the mill. It has to be "
                "there at the first angle.",
            ),
            Slip(
                lambda m: _by_way(m, (_turn_deg(m) / 2) ** 2 / 2),
                "So high it is at the end of the push. Is that the angle at which it has to be so "
                "high?",
            ),
            Slip(
                lambda m: _by_way(m, (_turn_deg(m) / 2) * (_turn_deg(m) / 4 + _braked_deg(m))),
                "Here it goes on after the push with the speed it has. But from there on it is "
                "braked.",
            ),
            Slip(
                lambda m: _by_way(
                    m, (_turn_deg(m) / 2) * (_turn_deg(m) / 4 - _still_pushed_deg(m))
                ),
                "This counts with the speed at the end of the push. But when it has to be so high "
                "it is still being pushed.",
            ),
            Slip(
                lambda m: _by_way(m, m.overlapped_deg**2 / 2 - _still_pushed_deg(m) ** 2),
                "The brake was counted before it begins: at that angle it is still being pushed.",
            ),
            Slip(
                lambda m: _by_way(
                    m,
                    (_turn_deg(m) / 2) ** 2 / 2 - _braked_deg(m) ** 2 / 2,
                ),
                "The brake is in it, but the speed at the end of the push has been forgotten: the "
                "die goes on with that.",
            ),
            Slip(
                lambda m: _by_way(m, m.overlapped_deg**2 / 2 - 3 / 2 * _braked_deg(m) ** 2),
                "The brake is in it, but without its half: it takes away half the acceleration "
                "times the time squared.",
            ),
            Slip(
                lambda m: _least(m) * (m.stroke_mm - m.wait_mm) / _rise_mm(m),
                "The margin was forgotten: take the height of the question.",
            ),
            Slip(
                lambda m: (
                    _rise_mm(m)
                    / MM_PER_M
                    / _per_acceleration(m.die_angle_deg, _turn_deg(m) / 2)
                    / _seconds(m) ** 2
                ),
                "This is without the quiet end of the mill: take the degrees of the question.",
            ),
            Slip(
                lambda m: float(peak_acceleration(_rise_mm(m), m.overlapped_deg, m.rate_per_hour)),
                "This is the cycloid, which cm.peak_acceleration takes unless it is told a law. "
                "Here it is an even push, and then an even brake.",
            ),
            Slip(
                lambda m: (
                    _least(m) * _rise_mm(EXAMPLE) / _rise_mm(m)
                    if _rise_mm(m) != _rise_mm(EXAMPLE)
                    else math.nan
                ),
                "This is with the height of the lesson's die. Yours has another.",
            ),
            Slip(
                lambda m: _least(m) * _seconds(m) ** 2 * MM_PER_M,
                "This is in mm/deg². A degree takes a part of a second: divide by its square, and "
                "make metres of the mm.",
            ),
            Slip(
                lambda m: _least(m) * _seconds(m),
                "The time of a degree has to be squared.",
            ),
            Slip(
                lambda m: _rise_mm(m) / MM_PER_M / (m.overlapped_deg * _seconds(m)),
                "This is the mean velocity up to there, in m/s. The acceleration is asked for.",
            ),
        ),
        hints=(
            "How high is it, with an acceleration of 1 mm/deg², at the end of the first push?",
            "After the push it goes on with the speed it has, less what the brake takes away.",
            "The height is a (u²/2 - (u - p)²) after u degrees, p of them pushed; leave out the "
            "second term as long as u is below p. Then turn mm/deg² into m/s².",
        ),
    ),
    NumberExercise(
        number="06.4",
        question=lambda m: (
            f"With the cycloid, {m.stroke_mm:g} mm over its widest angle of {m.told_deg:.2f} "
            "degrees, the die of exercise 06.3 overlaps as far as it can. How many times the least "
            "possible peak is its peak?"
        ),
        unit="",
        answer=lambda m: _times_least(m, *_widest(m)),
        also=lambda m: _times_least(m, m.stroke_mm, m.widest_deg),
        mixed=lambda m: with_one_of_the_lesson(
            partial(_times_least, m), _widest(m), _widest(EXAMPLE)
        ),
        goes_on_from={"06.3": lambda m, least: _cycloidal(m) / least},
        tolerance=0.002,  # with 0.004 the slip of pi/2 would be right for the source
        shows=peak_of_die(
            "With this ratio",
            peak=lambda m, ratio: ratio * _least(m),
            angle_deg=lambda m: m.told_deg,
        ),
        right="This factor is all that is left to gain, and you now know that it is all.",
        slips=(
            Slip(
                lambda m: _least(m) / _cycloidal(m),
                "This is the other way round. How many times the least one is it?",
            ),
            Slip(
                lambda m: 100 * (_cycloidal(m) / _least(m) - 1),
                "By so many percent it is larger. How many times the least one is it?",
            ),
            Slip(
                lambda m: _cycloidal(m) - _least(m),
                "This is the difference, in m/s². Divide the one by the other.",
            ),
            Slip(
                lambda m: _cycloidal(m),
                "This is the cycloid's peak, in m/s². Divide it by the least one.",
            ),
            Slip(
                lambda m: math.pi / 2,
                "This is 2 pi over 4, good for two moves with the same angle and stroke. The best "
                "motion has others.",
            ),
            Slip(
                lambda m: _cycloidal(m, m.die_angle_deg) / _least(m),
                "This is the die without overlap. Take the widest angle.",
            ),
            Slip(
                lambda m: _cycloidal(m, m.overlapped_deg) / _least(m),
                "This is with the quiet ends of the mill alone. Take the widest angle.",
            ),
            Slip(
                lambda m: _cycloidal(m, m.die_angle_deg) / _cycloidal(m),
                "This is what the overlap has brought so far. How far is it from the least one?",
            ),
            Slip(
                lambda m: _cycloidal(m) / _least(m) - 1,
                "This is by how much it is larger, as a share. How many times the least one is it?",
            ),
            Slip(
                lambda m: _cycloidal(m) / _steady(m, m.stroke_mm, _turn_deg(m)),
                "Here it is compared with a die that makes just the stroke in the whole time. The "
                "least possible peak is that of exercise 06.3.",
            ),
            Slip(
                lambda m: (_cycloidal(m) / _least(m)) ** 2,
                "This was squared. Two peaks are compared as they are.",
            ),
            Slip(
                lambda m: math.sqrt(_cycloidal(m) / _least(m)),
                "This is the root. It would compare angles; two peaks are compared as they are.",
            ),
        ),
        hints=(
            "You need the peak of the cycloid over its widest angle.",
            "The function cm.peak_acceleration gives it, with the angle of the question.",
            "Divide it by your answer to 06.3.",
        ),
    ),
    NumberExercise(
        number="06.5",
        question=lambda m: (
            f"The cam is replaced by a servo with a ball screw: lead {SCREW_LEAD_MM} mm, inertia "
            f"of motor and screw {MOTOR_INERTIA:.4f} kg m². The die has a mass of "
            f"{m.die_mass_kg:g} kg. Which force would accelerate die *and* motor with "
            f"{_ACCELERATION:g} m/s², both counted at the die?"
        ),
        unit="N",
        answer=_force,
        shows=push_of_force(_ACCELERATION, lambda m: m.die_mass_kg + _added_mass()),
        right="Motor and screw count for more than the die: most of the force is for themselves.",
        slips=(
            Slip(
                lambda m: m.die_mass_kg * _ACCELERATION,
                "This is for the die alone. For how many kg at the die does the motor's inertia "
                "count?",
            ),
            Slip(
                lambda m: (m.die_mass_kg + MOTOR_INERTIA) * _ACCELERATION,
                "The kg m² were added to the kg as they are. For how many kg at the die does the "
                "inertia count?",
            ),
            Slip(
                lambda m: (m.die_mass_kg + _added_mass() / MM_PER_M**2) * _ACCELERATION,
                "The lead was taken in mm. So the motor counts for nearly nothing: take it in "
                "metres, as J is in kg m².",
            ),
            Slip(
                lambda m: (m.die_mass_kg + _added_mass() / 100**2) * _ACCELERATION,
                "The lead was taken in cm. Take it in metres, as J is in kg m².",
            ),
            Slip(
                lambda m: (m.die_mass_kg + _added_mass() / (2 * math.pi)) * _ACCELERATION,
                "Only the lead was squared. The whole ratio counts squared, 2 pi with it.",
            ),
            Slip(
                lambda m: _added_mass() * _ACCELERATION,
                "This is for the motor alone. The die has to be accelerated too.",
            ),
            Slip(
                lambda m: (
                    (m.die_mass_kg + MOTOR_INERTIA / (SCREW_LEAD_MM / MM_PER_M) ** 2)
                    * _ACCELERATION
                ),
                "A turn is 2 pi radians: for each metre the screw turns by 2 pi over the lead.",
            ),
            Slip(
                lambda m: (
                    (m.die_mass_kg + MOTOR_INERTIA * 2 * math.pi / (SCREW_LEAD_MM / MM_PER_M))
                    * _ACCELERATION
                ),
                "The ratio of the screw counts squared: once for the speed, once for the force.",
            ),
            Slip(
                lambda m: m.die_mass_kg + _added_mass(),
                "This is the mass, in kg. The force is this times the acceleration.",
            ),
            Slip(
                lambda m: _added_mass(),
                "The motor's inertia counts for so many kg at the die. Add the die's own mass: "
                "which force gives both that acceleration?",
            ),
            Slip(
                lambda m: (
                    (m.die_mass_kg + MOTOR_INERTIA * (DEG_PER_TURN / SCREW_LEAD_MM * MM_PER_M) ** 2)
                    * _ACCELERATION
                ),
                "The turn of the screw was counted in degrees. J in kg m² wants radians: a turn is "
                "2 pi of them.",
            ),
            Slip(
                lambda m: (m.die_mass_kg + _added_mass() / 2) * _ACCELERATION,
                "Half of the inertia is missing. The 1/2 is in both energies, in J w²/2 and in "
                "m v²/2, and cancels.",
            ),
            Slip(
                lambda m: (m.die_mass_kg + _added_mass() / 4) * _ACCELERATION,
                "This has pi where there should be 2 pi: a turn is 2 pi radians.",
            ),
            Slip(
                lambda m: (
                    (m.die_mass_kg + MOTOR_INERTIA / (SCREW_LEAD_MM / 2 / MM_PER_M) ** 2)
                    * _ACCELERATION
                ),
                "Half of the lead was taken for a radius. The lead is the way that a whole turn "
                "makes.",
            ),
            Slip(
                lambda m: abs(m.die_mass_kg - _added_mass()) * _ACCELERATION,
                "One was subtracted from the other. Both have to be accelerated, so they add up.",
            ),
            Slip(
                lambda m: _force(m) / _turned(),
                "This is the torque of the motor, in N m. The force at the die is asked for.",
            ),
            Slip(
                lambda m: _force(m) / _turned() * MM_PER_M,
                "This is the torque of the motor, in N mm. The force at the die is asked for.",
            ),
            Slip(
                lambda m: _force(m) + m.die_mass_kg * STANDARD_GRAVITY,
                "Here the weight was added. The force for the acceleration alone is asked for.",
            ),
            Slip(
                lambda m: _force(m) * STANDARD_GRAVITY,
                "This was multiplied by g. Kilograms times m/s² already are newtons.",
            ),
        ),
        hints=(
            "How fast does the screw turn, in rad/s, while the die moves with 1 m/s?",
            "Its energy is J w²/2. Which mass with v = 1 m/s has the same?",
            "The mass is J (2 pi/lead)², with the lead in metres. Add the die's.",
        ),
    ),
    ChoiceExercise(
        number="06.6",
        question=lambda m: (
            "The program from below says 0.5195 m/s², the motion that was found has 0.5196. What "
            "is proved?"
        ),
        options={
            "a": "The least peak is 0.5195, since the solver has converged.",
            "b": "A finer grid will find a motion below 0.5195.",
            "c": "The least peak lies between the two, whatever the grid.",
            "d": "Nothing, since both are computed on a grid.",
        },
        answer="c",
        reasons={
            "a": "The solver solves its program exactly, but that asks less than a motion needs. "
            "What then is 0.5195?",
            "b": "The program from below asks less than is asked of a motion. Can a motion do "
            "better than it?",
            "d": "Both are statements about real motions, not about a grid: a mean is no larger "
            "than the peak, and the motion that was found can be built.",
        },
        right="Two programs, one from each side, say more than one on a very fine grid.",
        hints=(
            "What does a divided difference have to do with the acceleration between its nodes?",
            "Can a real motion have a smaller peak than the program from below says?",
            "Can the best motion have a larger peak than one that was found?",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "06.spring",
        "the least push, where it was 4",
        6,
        "Five is tempting: one more here, one less there. But the die, pushed and braked evenly, "
        "gets up to a velocity of 2. A brake of 3 needs two thirds of the time to take that away. "
        "One third is left for the push, and 2 divided by 1/3 is 6. Less cannot do it: with the "
        "weight 1/3 - x a push of P gives at most P/18, the brake 3 times 2/9, and 1 is needed.",
    ),
    Prediction(
        "06.machine",
        "m/s²",
        0.511,
        "It is easy to expect more of all the motions that nobody has tried yet. They gain less "
        "than 2 %.",
        near=0.01,  # 0.5195, which the question has, is 1.7 % off
    ),
    Prediction(
        "06.jerk",
        "percent above",
        3.4,
        "Ten or twenty percent would be no wonder: the law was found with pencil and paper.",
    ),
)
