"""Exercises of notebook 10, the follower's vibration."""

import cmath
import math
from collections.abc import Callable
from functools import partial

from cammotion.dynamics.chain import two_masses
from cammotion.dynamics.springs import natural_frequency, springs_in_series
from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MINUTES_PER_HOUR,
    MM_PER_M,
    SECONDS_PER_MINUTE,
    STANDARD_GRAVITY,
    cycle_time,
    indexing_time,
)
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.lessons.lesson_03 import IN_DEGREES, law_in_degrees
from cammotion.teaching.lessons.lesson_07 import SINE_LOST, sine_added
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import swings_of_rod

_CYCLOID, _SMOOTH = LAWS["cycloidal"], LAWS["4-5-6-7 polynomial"]
_SIDE_BY_SIDE = (
    "The stiffnesses were subtracted, as of parts side by side. One behind the other, which of "
    "stiffness and give adds up?"
)
_NOT_SQUARED = (
    "The angular frequency enters only once. The mass times its square is the stiffness that both "
    "need together."
)
_NOT_PRESSED = "The spring is pressed together at the lowest position already. That is missing."
_WEIGHT = "The weight was taken for the mass. Kilograms are a mass already."
_BY_G = "The mass was divided by g. Kilograms are a mass already."
_IN_NEWTONS = (
    "The millimetres by which the spring is pressed together were taken for newtons. Its force "
    "there is that times its stiffness."
)
_WEIGHT_ADDED = (
    "The weight was added to the spring's force. The follower is level: its weight does not press "
    "it on the cam."
)
_WEIGHT_OFF = (
    "The weight was taken away from the spring's force. The follower is level: its weight does not "
    "pull it off the cam."
)
_NO_MASS = "The mass is missing. Braking the follower takes its mass times the acceleration."
_NO_ROOT = (
    "The root is missing: mass, stroke and the spring's force give the square of the time of the "
    "rise."
)
_WITH_VELOCITY = "This is with the velocity. A force on a mass makes an acceleration."
_NO_SLIP = 0.004  # a rounding on the way that changes less is none
_JUMPS = (4, -8, 4)  # of the constant acceleration, in hm/tm2: where it sets in, turns and ends


def _rise_s(m: MillAndDie) -> float:
    """Return the time of the rise of 10.1 in s."""
    return float(indexing_time(m.follower.rod.rise_deg, m.follower.rod.per_hour))


def _together(m: MillAndDie, time_s: float | None = None, omega: float = 2 * math.pi) -> float:
    """Return what lever and rod have to have together, in N/mm."""
    rate = omega * m.follower.rod.swings / (time_s or _rise_s(m))
    return m.follower.rod.slide_kg * rate**2 / MM_PER_M


def _not_squared(m: MillAndDie) -> float:
    """Return it with the angular frequency in place of its square."""
    return _together(m) * _rise_s(m) / (2 * math.pi * m.follower.rod.swings)


def _rod(m: MillAndDie, together: float | None = None) -> float:
    """Return the stiffness of the rod in N/mm that makes with the lever so much together."""
    return 1 / (1 / (together or _together(m)) - 1 / m.follower.rod.lever_N_per_mm)


def _rod_in_whole_hundredths(m: MillAndDie, rounded: Callable[[float], int]) -> float:
    """Return the rod for a time of the rise that was rounded; NaN where that changes nothing."""
    time_s = rounded(round(100 * _rise_s(m), 6)) / 100
    return _unless_alike(_rod(m, _together(m, time_s)), _rod(m))


def _unless_alike(wrong: float, right: float) -> float:
    return math.nan if math.isclose(wrong, right, rel_tol=_NO_SLIP) else wrong


def _swings(m: MillAndDie, rod: float) -> float:
    """Return how often the slide swings in its rise on the lever and a rod."""
    both = springs_in_series([m.follower.rod.lever_N_per_mm, rod])
    return natural_frequency(both, m.follower.rod.slide_kg) * _rise_s(m)


def _ratio(m: MillAndDie) -> float:
    """Return how often the slide of 10.2 swings during its move."""
    time_s, frequency = m.follower.ringing
    return time_s * frequency


def _ringing(m: MillAndDie, *jumps: float, omega: float = 2 * math.pi) -> float:
    """Return how far in mm it swings after jumps at the start, the middle and the end."""
    w = omega * _ratio(m)
    total = sum(jump * cmath.exp(-0.5j * w * at) for at, jump in enumerate(jumps or _JUMPS))
    return m.follower.jump_mm * abs(total) / w**2


def _shaken(m: MillAndDie, *, in_m_per_s2: bool) -> float:
    """Return the acceleration of its swing, in m/s² or in strokes by the square of the time."""
    strokes = _ringing(m) / m.follower.jump_mm * (2 * math.pi * _ratio(m)) ** 2
    unit = m.follower.jump_mm / MM_PER_M / m.follower.ringing[0] ** 2
    return strokes * unit if in_m_per_s2 else strokes


def _sinc(angle: float) -> float:
    return abs(math.sin(angle)) / angle


def _leaves(m: MillAndDie, pressed_mm: float | None = None) -> float:
    """Return above how many turns a minute the follower leaves its cam, by halving.

    It is where the spring's force by the brake is least, between the middle and 3/4 of the time.
    """
    pressed = m.follower.pressed_mm if pressed_mm is None else pressed_mm
    lift = m.follower.lift_mm
    low, high = 1 / 2, 3 / 4
    for _ in range(60):
        place = (low + high) / 2
        angle = 2 * math.pi * place
        spring = pressed + lift * (place - math.sin(angle) / (2 * math.pi))
        grows = lift * (math.cos(angle) - 1) * math.sin(angle)
        if grows + 2 * math.pi * math.cos(angle) * spring > 0:
            high = place
        else:
            low = place
    return _speed(m, spring, -2 * math.pi * math.sin(angle))


def _speed(m: MillAndDie, pressed_mm: float, factor: float = _CYCLOID.Ca) -> float:
    """Return at how many turns a minute a spring so pressed can just brake so hard."""
    f = m.follower
    pull = f.lifted_kg * factor * f.lift_mm / MM_PER_M  # over the square of the time, N s2
    time_s = math.sqrt(pull / (f.spring_N_per_mm * pressed_mm))
    return f.lift_deg / DEG_PER_TURN / time_s * SECONDS_PER_MINUTE


def _at_the_hardest(m: MillAndDie, more_mm: float = 0.0) -> float:
    """Return the speed by 3/4 of the time, where the cam brakes hardest."""
    return _speed(m, _at(m, 3 / 4) + more_mm)


def _without_root(m: MillAndDie, speed: float) -> float:
    """Return a speed as it comes out if the time of the rise is not the root."""
    return speed**2 / (m.follower.lift_deg / DEG_PER_TURN * SECONDS_PER_MINUTE)


def _pressed_as_force(m: MillAndDie) -> float:
    """Return by how many mm its spring is pressed if what is given in mm was in N."""
    return m.follower.pressed_mm / m.follower.spring_N_per_mm


def _weight(m: MillAndDie) -> float:
    """Return by how many mm the follower's weight would press its spring together."""
    return STANDARD_GRAVITY * m.follower.lifted_kg / m.follower.spring_N_per_mm


def _at(m: MillAndDie, place: float) -> float:
    """Return how far in mm its spring is pressed together at a place of the rise."""
    return m.follower.pressed_mm + m.follower.lift_mm * float(_CYCLOID(place))


def _at_in_degrees(m: MillAndDie, place: float) -> float:
    """Return it as it comes out if the sine of the cycloid takes 2 pi x for degrees."""
    return m.follower.pressed_mm + m.follower.lift_mm * law_in_degrees(place)


def _leaves_by(m: MillAndDie, way: Callable[[float], float]) -> float:
    """Return the least speed of many places with another law in the way of the spring alone."""
    f, places = m.follower, (place / 1000 for place in range(501, 1000))
    return min(_speed(m, f.pressed_mm + f.lift_mm * way(x), -float(_CYCLOID(x, 2))) for x in places)


def _hertz(stiffness: float, mass: float) -> float:
    return natural_frequency(stiffness, mass)


def _modes(m: MillAndDie, *, swap_m: bool = False, swap_k: bool = False) -> tuple[float, float]:
    """Return both natural frequencies of 10.4 in Hz."""
    f = m.follower
    m1, m2 = (f.m2_kg, f.m1_kg) if swap_m else (f.m1_kg, f.m2_kg)
    k1, k2 = (f.k2_N_per_mm, f.k1_N_per_mm) if swap_k else (f.k1_N_per_mm, f.k2_N_per_mm)
    lower, higher = two_masses(m1, m2, k1_N_per_mm=k1, k2_N_per_mm=k2).natural_Hz
    return float(lower), float(higher)


def _rod_alone(m: MillAndDie) -> float:
    """Return the lower frequency with k1 for k1 + k2 in the matrix, NaN where there is none.

    It is that of a push rod so much softer.
    """
    f = m.follower
    if f.k1_N_per_mm <= f.k2_N_per_mm:
        return math.nan
    softer = f.k1_N_per_mm - f.k2_N_per_mm
    chain = two_masses(f.m1_kg, f.m2_kg, k1_N_per_mm=softer, k2_N_per_mm=f.k2_N_per_mm)
    return float(chain.natural_Hz[0])


def _head_on_both(m: MillAndDie) -> float:
    """Return the lower frequency with k1 + k2 in the last place of the matrix, too."""
    f = m.follower
    masses, both = f.m1_kg * f.m2_kg, f.k1_N_per_mm + f.k2_N_per_mm
    middle = (f.m1_kg + f.m2_kg) * both / 2
    last = masses * (both**2 - f.k2_N_per_mm**2)
    return _hertz(middle - math.sqrt(middle**2 - last), masses)


def _row(m: MillAndDie) -> float:
    """Return the stiffness of both springs of 10.4 in a row."""
    return springs_in_series([m.follower.k1_N_per_mm, m.follower.k2_N_per_mm])


def _as_if_equal(m: MillAndDie) -> float:
    """Return the lower frequency by the factor of two equal masses, NaN where they are equal."""
    f = m.follower
    if (f.m1_kg, f.k1_N_per_mm) == (f.m2_kg, f.k2_N_per_mm):
        return math.nan
    return (math.sqrt(5) - 1) / 2 * _hertz(f.k1_N_per_mm, f.m1_kg)


def _dunkerley(m: MillAndDie) -> float:
    """Return the estimate for 10.4 from each mass alone, in Hz."""
    alone = _hertz(m.follower.k1_N_per_mm, m.follower.m1_kg), _hertz(_row(m), m.follower.m2_kg)
    return 1 / math.hypot(1 / alone[0], 1 / alone[1])


def _periods_alone(m: MillAndDie) -> float:
    """Return the estimate as it comes out if the head, too, is on its own spring alone, in Hz."""
    f = m.follower
    alone = _hertz(f.k1_N_per_mm, f.m1_kg), _hertz(f.k2_N_per_mm, f.m2_kg)
    return 1 / math.hypot(1 / alone[0], 1 / alone[1])


def _rayleigh(m: MillAndDie) -> float:
    """Return the estimate for 10.4 from how far the weights would press the springs, in Hz."""
    f = m.follower
    slide = (f.m1_kg + f.m2_kg) / f.k1_N_per_mm
    head = slide + f.m2_kg / f.k2_N_per_mm
    return _hertz(f.m1_kg * slide + f.m2_kg * head, f.m1_kg * slide**2 + f.m2_kg * head**2)


def _law(m: MillAndDie, derivative: int = 0) -> float:
    return m.follower.wanted_mm * float(_SMOOTH(m.follower.wanted_x, derivative))


def _turns(m: MillAndDie) -> float:
    """Return 2 pi tm/Tn of 10.5."""
    return 2 * math.pi * m.follower.wanted_swings


def _cam(m: MillAndDie, law: str = _SMOOTH.name, omega: float | None = None) -> float:
    """Return how high in mm the cam's end of the spring is."""
    x, wanted = m.follower.wanted_x, LAWS[law]
    bend = float(wanted(x, 2)) / (omega or _turns(m)) ** 2
    return m.follower.wanted_mm * (float(wanted(x)) + bend)


def _with_the_peak(m: MillAndDie) -> float:
    """Return it with the peak of the second derivative, with the sign of this half."""
    peak = math.copysign(_SMOOTH.Ca, _law(m, 2)) * m.follower.wanted_mm
    return _law(m) + peak / _turns(m) ** 2


EXERCISES = (
    NumberExercise(
        number="10.1",
        question=lambda m: (
            "A slide of {0:g} kg rises over {1:g} degrees of its cam, at {2:g} pieces per hour. "
            "Between cam and slide are a lever of {4:g} N/mm and a rod, one behind the other. How "
            "stiff does the rod have to be, so that the slide, left alone, would swing {3:g} times "
            "during the rise?"
        ).format(*m.follower.rod),
        unit="N/mm",
        answer=_rod,
        shows=swings_of_rod(asked=lambda m: m.follower.rod.swings, made=_swings),
        right="One behind the other, two parts are softer than either. However stiff the rod, the "
        "slide never swings faster than on the lever alone.",
        slips=(
            Slip(
                _together,
                "This is what lever and rod need together. The lever gives way too, so that the "
                "rod has to be stiffer.",
            ),
            Slip(lambda m: m.follower.rod.lever_N_per_mm - _together(m), _SIDE_BY_SIDE),
            Slip(lambda m: _together(m) - m.follower.rod.lever_N_per_mm, _SIDE_BY_SIDE),
            Slip(
                lambda m: springs_in_series([_together(m), m.follower.rod.lever_N_per_mm]),
                "The give of the lever was added to that of both. It is a part of it: what is left "
                "for the rod?",
            ),
            Slip(
                lambda m: 1 / _rod(m),
                "This is by how many mm the rod gives way for each newton. Its stiffness is one "
                "over that.",
            ),
            Slip(
                lambda m: _together(m) + m.follower.rod.lever_N_per_mm,
                "The stiffnesses were added, as of parts side by side. One behind the other, which "
                "of stiffness and give adds up?",
            ),
            Slip(lambda m: _rod(m, _not_squared(m)), _NOT_SQUARED),
            Slip(_not_squared, _NOT_SQUARED),
            Slip(
                lambda m: 2 * _together(m),
                "This is for two parts that are alike. The lever has a stiffness of its own.",
            ),
            Slip(
                lambda m: _rod(m, _together(m, omega=1)),
                "The 2 pi is missing: the root of stiffness by mass is an angular frequency, in "
                "rad a second.",
            ),
            Slip(
                lambda m: _rod(m, _together(m, omega=DEG_PER_TURN)),
                "A swing was taken for 360, as in degrees. The root of stiffness by mass is in rad "
                "a second, and a swing is 2 pi of it.",
            ),
            Slip(
                lambda m: _rod(m, _together(m, float(cycle_time(m.follower.rod.per_hour)))),
                "This is for as many swings in a whole turn. How long does the rise take?",
            ),
            Slip(
                lambda m: _rod(m, _together(m) * MM_PER_M),
                "What both need is in N/m here, and the lever's stiffness in N/mm. No rod can have "
                "a stiffness below 0.",
            ),
            Slip(
                lambda m: _rod(m, _together(m, time_s=1)),
                "The swings are those of the rise, and were taken for those of a second.",
            ),
            Slip(lambda m: _rod(m, _together(m) / STANDARD_GRAVITY), _BY_G),
            Slip(
                lambda m: _rod(m, _together(m) * STANDARD_GRAVITY),
                "The weight was taken for the mass. Then the lever alone would be too soft, and no "
                "rod could help.",
            ),
            Slip(
                lambda m: _rod(m, _together(m) * MINUTES_PER_HOUR**2),
                "The time of the rise was taken 60 times too short: the pieces are by the hour, "
                "and an hour has 3600 seconds.",
            ),
            Slip(
                lambda m: _rod(m, _together(m) * 10**2),
                "The 10 of tm = 10 B/N is missing: an hour has 3600 seconds, and a turn 360 "
                "degrees.",
            ),
            Slip(
                lambda m: _rod(m, _together(m) / 10**2),
                "The time of the rise was taken ten times too long. It is 10 B/N: an hour has 3600 "
                "seconds, and a turn 360 degrees.",
            ),
            *(
                Slip(
                    partial(_rod_in_whole_hundredths, rounded=rounded),
                    "The time of the rise was rounded to a hundredth of a second. It counts as a "
                    "square, and in a difference: keep all digits until the end.",
                )
                for rounded in (math.floor, math.ceil)
            ),
            Slip(
                lambda m: _rod(m, _together(m) / 4),
                "This is for half as many swings. A swing is to and fro.",
            ),
        ),
        hints=(
            "How long does the rise take, in s, and how many times a second does the slide have "
            "to swing?",
            "The angular frequency is 2 pi times that. Its square times the mass is the stiffness "
            "of lever and rod together, in N/m.",
            "One behind the other the ways add up: one over this stiffness is the sum of one over "
            "the lever's and one over the rod's.",
        ),
    ),
    NumberExercise(
        number="10.2",
        question=lambda m: (
            f"A cam lifts a slide by {m.follower.jump_mm:g} mm, by the constant acceleration, in "
            f"{m.follower.ringing[0]:g} s. Left alone the slide swings {m.follower.ringing[1]:g} "
            "times a second, and nothing damps it. How far to each side does it swing after the "
            "move?"
        ),
        unit="mm",
        answer=_ringing,
        right="The law with the lowest peak jumps three times, and each jump leaves a swing. At a "
        "given number of swings, undamped, only how they meet can make it small.",
        slips=(
            Slip(
                lambda m: _ringing(m, 4),
                "This is what a single jump of the start's height leaves. How many jumps does the "
                "move have, and how high is the one in the middle?",
            ),
            Slip(
                lambda m: 16 * m.follower.jump_mm / (2 * math.pi * _ratio(m)) ** 2,
                "The swings of the jumps were added by their sizes, as if all came in step. When "
                "does each begin?",
            ),
            Slip(
                lambda m: _ringing(m, 4, -4, 4),
                "The jump in the middle was taken as high as that at the start. There it goes from "
                "the full push to the full brake.",
            ),
            Slip(
                lambda m: _ringing(m, 4, 0, 4),
                "The jump in the middle is missing, from push to brake.",
            ),
            Slip(
                lambda m: _ringing(m, 4, -4),
                "This is with two jumps, alike. The one in the middle is twice as high as that at "
                "the start, and at the end the brake is let go.",
            ),
            Slip(
                lambda m: _ringing(m, 4, -8),
                "The jump at the end is missing, where the brake is let go.",
            ),
            Slip(
                lambda m: _ringing(m, 0, -8),
                "This is the jump in the middle alone. The acceleration also jumps where the move "
                "begins and where it ends.",
            ),
            Slip(
                lambda m: m.follower.jump_mm * _sinc(math.pi * _ratio(m) / 2),
                "The square is missing: a jump in the acceleration counts by the square of the "
                "frequency.",
            ),
            Slip(
                lambda m: _ringing(m) / abs(math.sin(math.pi * _ratio(m) / 2)),
                "The square of the sine is missing: the three arrows together are as long as 16 "
                "times that square.",
            ),
            Slip(
                lambda m: 2 * math.pi * _ratio(m) * _ringing(m),
                "The angular frequency enters only once. A jump in the acceleration counts by its "
                "square.",
            ),
            Slip(
                lambda m: _ringing(m) * m.follower.ringing[0] ** 2,
                "The jumps were counted in strokes by the square of the time of the move, the "
                "angular frequency by the second. Take both by the second, or both by the move.",
            ),
            Slip(
                lambda m: 4 * m.follower.jump_mm * _sinc(math.pi * _ratio(m)) ** 2,
                "The jumps are half a move apart, not a whole one.",
            ),
            Slip(
                lambda m: m.follower.jump_mm * _sinc(math.pi * _ratio(m)) ** 2,
                "This is for a slide that swings twice as often during the move.",
            ),
            Slip(
                lambda m: m.follower.jump_mm * _sinc(math.pi * _ratio(m)) / abs(1 - _ratio(m) ** 2),
                "This is the cycloid of the lesson. Take the law that jumps.",
            ),
            Slip(
                lambda m: (
                    m.follower.jump_mm
                    * abs(math.cos(math.pi * _ratio(m)) / (1 - 4 * _ratio(m) ** 2))
                ),
                "This is the simple harmonic motion, which jumps at both ends alone. Take the "
                "constant acceleration.",
            ),
            Slip(
                lambda m: _ringing(m, omega=1),
                "The 2 pi is missing: swings were taken for radians.",
            ),
            Slip(
                lambda m: _ringing(m) * (2 * math.pi) ** 2,
                "The arrows were divided by the square of the swings. By that of the angular "
                "frequency it has to be, 2 pi times as large before it is squared.",
            ),
            Slip(
                lambda m: _ringing(m, omega=math.pi),
                "This is for half as many swings during the move. A swing is 2 pi of its angle.",
            ),
            Slip(
                lambda m: _ringing(m, 1, -2, 1),
                "One stroke by the square of the time was taken for the acceleration. It is 4, so "
                "that half of the stroke is done in half of the time; or the 2 of 2 sin is lost, "
                "and counts squared.",
            ),
            Slip(
                lambda m: _ringing(m, 2, -4, 2),
                "This is half of it. It was halved, though it is to each side already; or 2 "
                "strokes by the square of the time were taken for the acceleration, as if it "
                "pushed all the way. Here half of the stroke is done in half of the time.",
            ),
            *(
                Slip(
                    partial(_shaken, in_m_per_s2=in_m_per_s2),
                    "This is the acceleration with which it swings. How far it swings is that over "
                    "the square of the angular frequency.",
                )
                for in_m_per_s2 in (True, False)
            ),
            Slip(
                lambda m: 2 * _ringing(m),
                "This is from one end of the swing to the other. How far to each side is asked "
                "for.",
            ),
            Slip(
                lambda m: _ringing(m) / m.follower.jump_mm,
                "This is a part of the stroke. It is asked for in mm.",
            ),
            Slip(
                lambda m: 100 * _ringing(m) / m.follower.jump_mm,
                "This is in percent of the stroke. It is asked for in mm.",
            ),
            Slip(
                lambda m: (
                    m.follower.jump_mm
                    * (math.sin(math.radians(math.pi * _ratio(m) / 2)) / (math.pi * _ratio(m) / 2))
                    ** 2
                ),
                "The sine was taken of degrees. The angle is in radians.",
            ),
            Slip(
                lambda m: (
                    m.follower.jump_mm * (math.sin(90 * _ratio(m)) / (math.pi * _ratio(m) / 2)) ** 2
                ),
                "The angle was put in in degrees, and the sine takes it for radians.",
            ),
        ),
        hints=(
            "How often does the slide swing during the move? And where does the cam's "
            "acceleration jump, and by how much, in strokes by the square of the time?",
            "Each jump leaves a swing of its own, in mm: its height over the square of the angular "
            "frequency.",
            "Add them as arrows, each turned back by how far the swing goes until it begins. The "
            "length of the sum is asked for.",
        ),
    ),
    NumberExercise(
        number="10.3",
        question=lambda m: (
            f"A cam moves a follower {m.follower.lift_mm:g} mm out, on the level, over "
            f"{m.follower.lift_deg:g} degrees, by the cycloid. It has {m.follower.lifted_kg:g} kg, "
            f"and a spring of {m.follower.spring_N_per_mm:g} N/mm, pressed together by "
            f"{m.follower.pressed_mm:g} mm at the lowest position, holds it on the cam. Above "
            "which speed does it leave the cam during the rise?"
        ),
        unit="turns a minute",
        answer=_leaves,
        right="It leaves a little before the cam brakes hardest, where the spring is still weaker.",
        slips=(
            Slip(
                _at_the_hardest,
                "This is where the cam brakes hardest, at 3/4 of the time. But a little before, "
                "the spring is weaker. Which place is the worst?",
            ),
            Slip(
                lambda m: _speed(m, m.follower.pressed_mm),
                "The spring is taken as at the lowest position. How high is the follower when the "
                "cam brakes?",
            ),
            Slip(
                lambda m: _speed(m, m.follower.pressed_mm + m.follower.lift_mm),
                "The spring is taken as at the top. There the cam does not brake any more.",
            ),
            Slip(
                lambda m: _speed(m, m.follower.pressed_mm + m.follower.lift_mm / 2),
                "The spring is taken as half-way up. There the cam just goes from push to brake.",
            ),
            Slip(
                lambda m: _speed(m, m.follower.pressed_mm + 3 / 4 * m.follower.lift_mm),
                "Three quarters of the time are more than three quarters of the stroke: put x "
                "into the law. And is x = 3/4 the worst place?",
            ),
            Slip(
                lambda m: _speed(m, m.follower.pressed_mm + sine_added(m.follower.lift_mm)),
                SINE_LOST,
            ),
            Slip(lambda m: _speed(m, _at_in_degrees(m, 3 / 4)), IN_DEGREES),
            Slip(partial(_leaves_by, way=law_in_degrees), IN_DEGREES),
            Slip(
                partial(_leaves_by, way=float),
                "The share of the time was taken for that of the stroke: put x into the law.",
            ),
            Slip(
                lambda m: (
                    SECONDS_PER_MINUTE * _hertz(m.follower.spring_N_per_mm, m.follower.lifted_kg)
                ),
                "This is how often the follower would swing on its spring in a minute. It leaves "
                "where the cam brakes more than the spring can.",
            ),
            Slip(lambda m: _leaves(m, 0), _NOT_PRESSED),
            Slip(lambda m: _at_the_hardest(m, -m.follower.pressed_mm), _NOT_PRESSED),
            Slip(lambda m: _leaves(m, _pressed_as_force(m)), _IN_NEWTONS),
            Slip(
                lambda m: _at_the_hardest(m, _pressed_as_force(m) - m.follower.pressed_mm),
                _IN_NEWTONS,
            ),
            Slip(lambda m: math.sqrt(m.follower.lifted_kg) * _leaves(m), _NO_MASS),
            Slip(lambda m: math.sqrt(m.follower.lifted_kg) * _at_the_hardest(m), _NO_MASS),
            Slip(lambda m: _without_root(m, _leaves(m)), _NO_ROOT),
            Slip(lambda m: _without_root(m, _at_the_hardest(m)), _NO_ROOT),
            Slip(lambda m: _leaves(m) / math.sqrt(STANDARD_GRAVITY), _WEIGHT),
            Slip(lambda m: _leaves(m) * math.sqrt(STANDARD_GRAVITY), _BY_G),
            Slip(
                lambda m: _speed(m, _at(m, 3 / 4), 4),
                "This is with the peak of the constant acceleration. The cycloid's is higher.",
            ),
            Slip(
                lambda m: _speed(m, _at(m, 3 / 4), 1),
                "This is with the stroke over the square of the time as the peak. The cycloid has "
                "a factor before it.",
            ),
            Slip(lambda m: _leaves(m, m.follower.pressed_mm + _weight(m)), _WEIGHT_ADDED),
            Slip(lambda m: _at_the_hardest(m, _weight(m)), _WEIGHT_ADDED),
            Slip(lambda m: _leaves(m, m.follower.pressed_mm - _weight(m)), _WEIGHT_OFF),
            Slip(lambda m: _at_the_hardest(m, -_weight(m)), _WEIGHT_OFF),
            Slip(
                lambda m: _leaves(m) * DEG_PER_TURN / m.follower.lift_deg,
                "The time of the rise was taken for that of a turn.",
            ),
            Slip(
                lambda m: _leaves(m) * m.follower.lift_deg / DEG_PER_TURN,
                "The part of the turn was counted twice.",
            ),
            Slip(
                lambda m: _leaves(m) * 2 * math.pi / SECONDS_PER_MINUTE,
                "This is in rad a second. Turns a minute are asked for.",
            ),
            Slip(
                lambda m: _leaves(m) / SECONDS_PER_MINUTE,
                "This is in turns a second. Turns a minute are asked for.",
            ),
            Slip(
                lambda m: _leaves(m) * MINUTES_PER_HOUR,
                "This is in turns an hour, as pieces are counted. Turns a minute are asked for.",
            ),
            Slip(
                lambda m: _leaves(m) / math.sqrt(MM_PER_M),
                "The stroke is in mm here. With kg and N it has to be in m.",
            ),
        ),
        hints=(
            "What does the follower's mass need to be braked like the cam, and what does the "
            "spring give, both at the place x?",
            "For each x in the second half, both are equal if the rise takes a certain time. The "
            "longest of these times is the one at which it leaves first.",
            "Let the computer try many x between 0.5 and 1. From the time follows that of a turn, "
            "and the turns a minute.",
        ),
    ),
    NumberExercise(
        number="10.4",
        question=lambda m: (
            f"Outwards from a cam follow a push rod of {m.follower.k1_N_per_mm:g} N/mm, a slide of "
            f"{m.follower.m1_kg:g} kg, a spindle of {m.follower.k2_N_per_mm:g} N/mm and a head of "
            f"{m.follower.m2_kg:g} kg, one behind the other. The cam stands, and nothing damps. "
            "What is the lower one of the two natural frequencies?"
        ),
        unit="Hz",
        answer=lambda m: _modes(m)[0],
        right="Each mass alone on its spring would swing faster. Together they have a slower swing "
        "than either.",
        slips=(
            Slip(
                lambda m: _modes(m)[1],
                "This is the higher one, in which slide and head go against each other.",
            ),
            Slip(
                lambda m: _hertz(_row(m), m.follower.m2_kg),
                "This is the head on both springs, with a slide that has no mass.",
            ),
            Slip(
                lambda m: _hertz(_row(m), m.follower.m1_kg),
                "This is the slide alone, on both springs one behind the other. The slide is on "
                "the push rod, and the spindle comes after it.",
            ),
            Slip(
                _as_if_equal,
                "The factor 0.618 is that of two equal masses on two equal springs.",
            ),
            Slip(
                _dunkerley,
                "The squares of two periods were added, each of one mass alone. That is an "
                "estimate, and below the lower frequency for any two masses. The eigenvalue is "
                "asked for.",
            ),
            Slip(
                _periods_alone,
                "The squares of two periods were added, each of a mass on the spring before it "
                "alone. But under the head the push rod gives way too. And the eigenvalue is asked "
                "for, where such a sum is an estimate.",
            ),
            Slip(
                _rayleigh,
                "This is Rayleigh's quotient with the ways by which the weights would press the "
                "springs. That is an estimate, and above the lower frequency. The eigenvalue is "
                "asked for.",
            ),
            Slip(
                lambda m: _hertz(_row(m), m.follower.m1_kg + m.follower.m2_kg),
                "This is one mass on both springs. The slide is on the push rod alone.",
            ),
            Slip(
                lambda m: _hertz(m.follower.k1_N_per_mm, m.follower.m1_kg + m.follower.m2_kg),
                "This is both masses on the push rod, as if the spindle were rigid.",
            ),
            Slip(
                lambda m: _hertz(m.follower.k2_N_per_mm, m.follower.m1_kg + m.follower.m2_kg),
                "This is both masses on the spindle. It carries the head alone, and next to the "
                "cam is the push rod.",
            ),
            Slip(
                lambda m: _hertz(m.follower.k2_N_per_mm, m.follower.m2_kg),
                "This is the head on its spindle, with the slide held still.",
            ),
            Slip(
                lambda m: _hertz(m.follower.k1_N_per_mm, m.follower.m1_kg),
                "This is the slide on the push rod, without the head.",
            ),
            Slip(
                lambda m: _hertz(m.follower.k1_N_per_mm + m.follower.k2_N_per_mm, m.follower.m1_kg),
                "This is the slide between both springs, with the head held still.",
            ),
            Slip(
                lambda m: _hertz(
                    m.follower.k1_N_per_mm + m.follower.k2_N_per_mm,
                    m.follower.m1_kg + m.follower.m2_kg,
                ),
                "This is one mass on two springs side by side. They are one behind the other.",
            ),
            Slip(
                lambda m: _hertz(
                    m.follower.k2_N_per_mm,
                    1 / (1 / m.follower.m1_kg + 1 / m.follower.m2_kg),
                ),
                "This is how slide and head swing against each other without the push rod, free of "
                "the cam.",
            ),
            Slip(
                lambda m: _modes(m, swap_m=True)[0],
                "The two masses are exchanged. Which one is next to the cam?",
            ),
            Slip(
                lambda m: _modes(m, swap_k=True)[0],
                "The two springs are exchanged. Which one is next to the cam?",
            ),
            Slip(
                lambda m: _modes(m, swap_m=True, swap_k=True)[0],
                "Both masses and both springs are exchanged, as if counted from the head. Which "
                "ones are next to the cam?",
            ),
            Slip(
                _head_on_both,
                "In the last place of the stiffnesses stands the sum of both. The head is on the "
                "spindle alone.",
            ),
            Slip(
                _rod_alone,
                "In the first place of the stiffnesses stands the push rod alone. The slide is "
                "between both springs, and both add up there.",
            ),
            Slip(lambda m: _modes(m)[0] / math.sqrt(STANDARD_GRAVITY), _WEIGHT),
            Slip(lambda m: _modes(m)[0] * math.sqrt(STANDARD_GRAVITY), _BY_G),
            Slip(
                lambda m: _modes(m)[0] * 2 * math.pi,
                "This is in rad a second. A swing is 2 pi of it.",
            ),
            Slip(
                lambda m: _modes(m)[0] / math.sqrt(MM_PER_M),
                "The stiffnesses are in N/mm here. With kg and s they have to be in N/m.",
            ),
            Slip(
                lambda m: 1 / _modes(m)[0],
                "This is how many seconds a swing takes. How many there are in a second is asked "
                "for.",
            ),
            Slip(
                lambda m: (_modes(m)[0] * 2 * math.pi) ** 2,
                "This is the square of the angular frequency. Take the root, and swings for rad.",
            ),
            Slip(
                lambda m: (_modes(m)[0] * 2 * math.pi) ** 2 / (2 * math.pi),
                "The root is missing: the matrices give the square of the angular frequency.",
            ),
        ),
        hints=(
            "Which forces act on the slide, and which on the head, if both are off their places?",
            "Write them as two matrices: the masses on a diagonal, and the stiffnesses, in N/m, "
            "with the second spring in all four places.",
            "The eigenvalues of the stiffnesses by the masses are squares of angular frequencies. "
            "Take the smaller one.",
        ),
    ),
    NumberExercise(
        number="10.5",
        question=lambda m: (
            f"A mass on a spring, undamped, is to rise by {m.follower.wanted_mm:g} mm, by the "
            "4-5-6-7 polynomial. Left alone it swings "
            f"{m.follower.wanted_swings:g} times during the move. How high is the cam's end of the "
            f"spring when the share {m.follower.wanted_x:g} of the time is over?"
        ),
        unit="mm",
        answer=_cam,
        right="The cam leads where it has to push, and lags where it has to brake. It does so for "
        "this one rate alone.",
        slips=(
            Slip(
                _law,
                "This is how high the mass is. The spring pushes it only if its other end is "
                "somewhere else.",
            ),
            Slip(
                lambda m: m.follower.wanted_mm - _law(m),
                "This is how far the mass is from the top. The height of the cam's end of the "
                "spring is asked for.",
            ),
            Slip(
                lambda m: m.follower.wanted_x * m.follower.wanted_mm,
                "The share of the time was taken for that of the stroke. Put it into the law.",
            ),
            Slip(
                _with_the_peak,
                "The peak of the second derivative was taken. How large is it at this x?",
            ),
            Slip(
                lambda m: _law(m) - _law(m, 2) / _turns(m) ** 2,
                "The sign is wrong: the cam's end is ahead of the mass where it pushes, and behind "
                "it where it brakes.",
            ),
            Slip(
                lambda m: _law(m, 2) / _turns(m) ** 2,
                "This is by how much the spring is pressed together, below 0 if it is stretched. "
                "Where is its end?",
            ),
            Slip(
                lambda m: -_law(m, 2) / _turns(m) ** 2,
                "This is by how much the spring is stretched, below 0 if it is pressed together. "
                "Where is its end?",
            ),
            Slip(
                lambda m: _cam(m, omega=m.follower.wanted_swings),
                "The 2 pi is missing: swings were taken for radians.",
            ),
            Slip(
                lambda m: _law(m) + _law(m, 2) / _turns(m),
                "The second derivative is divided by the square of the angular frequency.",
            ),
            Slip(
                lambda m: _law(m) + _law(m, 2),
                "The second derivative was added as it is. Divide it by the square of the angular "
                "frequency.",
            ),
            Slip(
                lambda m: _law(m) + _law(m, 2) / (_turns(m) * m.follower.wanted_swings),
                "The swings are squared here, but not the 2 pi before them.",
            ),
            Slip(lambda m: _law(m) + _law(m, 1) / _turns(m), _WITH_VELOCITY),
            Slip(lambda m: _law(m) + _law(m, 1) / _turns(m) ** 2, _WITH_VELOCITY),
            Slip(
                lambda m: _cam(m, "cycloidal"),
                "This is with the cycloid. Its third derivative jumps at the ends, and the cam "
                "would have to jump in its velocity.",
            ),
            Slip(
                lambda m: _cam(m, "3-4-5 polynomial"),
                "This is with the 3-4-5 polynomial. Its third derivative jumps at the ends, and "
                "the cam would have to jump in its velocity.",
            ),
            Slip(
                lambda m: _cam(m) / m.follower.wanted_mm,
                "This is a part of the stroke. It is asked for in mm.",
            ),
            Slip(
                lambda m: m.follower.wanted_mm - _cam(m),
                "This is how far it is from the top. How high it is above the lowest position is "
                "asked for.",
            ),
            Slip(
                lambda m: _law(m) + _law(m, 2) / m.follower.wanted_mm / _turns(m) ** 2,
                "Only one of the two terms was multiplied by the stroke.",
            ),
            Slip(
                lambda m: _cam(m, omega=2 * _turns(m)),
                "This is for twice as many swings in the move.",
            ),
            Slip(
                lambda m: _cam(m, omega=_turns(m) / 2),
                "The 2 of the 2 pi is missing: a swing is a whole turn of the angle.",
            ),
        ),
        hints=(
            "Which acceleration does the mass have there, and which force does that take?",
            "The spring gives it if it is pressed together by the acceleration over the square of "
            "the angular frequency. Where that is below 0 it is stretched.",
            "With x as the time the angular frequency is 2 pi times the swings of the move. Add "
            "how much the spring is pressed together to the height of the mass, with its sign.",
        ),
    ),
    ChoiceExercise(
        number="10.6",
        question=lambda m: (
            "A cam moves a slide by the constant acceleration. It is found to leave hardly any "
            "swing behind: left alone the slide swings exactly 4 times during the move, and hardly "
            'anything damps it. "Then this law is the best for it", somebody says. What is true?'
        ),
        options={
            "a": "He is right: it leaves no swing, and no other law has so low a peak.",
            "b": "A stiffer spring can only help: the slide will follow the cam more closely.",
            "c": "Nothing swings on at this rate, but during the move the slide has twice the peak "
            "of the cam, and at a rate a fifth lower it does swing on.",
            "d": "The cycloid would let it swing on here, for it has the higher peak.",
        },
        answer="c",
        reasons={
            "a": "That is the peak of the cam. What has the slide during the move, after a jump in "
            "the acceleration?",
            "b": "How do the swings of the three jumps meet if the slide swings five times?",
            "d": "The peak does not decide that. What does the cycloid leave where the swings of a "
            "move are a whole number?",
        },
        right="The slide has a peak of 8 strokes by the square of the time, and with the cycloid "
        "one of 7.97. The jumps take away what the lowest peak of all has won.",
        hints=(
            "Draw the three jumps as arrows. How do they stand to each other with 4 swings, and "
            "how with 5?",
            "What does a slide at rest do when the acceleration of its cam jumps: how far does it "
            "overshoot?",
            "Ask cm.residual_vibration and cm.dynamic_factor, for both laws and some swings.",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "10.stay",
        "percent of the stroke",
        50,
        "The cycloid is the smooth law, so one expects next to nothing. But it is smooth only "
        "against a swing that is much shorter than the move. Over a single swing it is still half "
        "as bad as a sudden step, which would leave the whole stroke.",
    ),
    Prediction(
        "10.cure",
        "times smaller",
        10.06,
        "One expects 5 times, as for the peak, which falls with the square of the time. But what "
        "stays comes from the ends of the move, where the jerk jumps, and falls with the third "
        "power: the move is 2.27 times as long.",
        low=1,
    ),
    Prediction(
        "10.jump",
        "mm",
        1.495,
        "In proportion to the speed beyond the limit it would be 2.7 mm. But both the force that "
        "is lacking and the time for which it is lacking grow from nothing there, so just beyond "
        "the limit the gap grows nearly with the square of the excess.",
    ),
)
