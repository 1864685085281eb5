"""Exercises of notebook 12, your machine."""

import math
from collections.abc import Iterable
from functools import partial
from operator import ne

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, indexing_time
from cammotion.teaching.copied import with_one_of_the_lesson
from cammotion.teaching.design_exercise import (
    DesignExercise,
    balanced,
    clearance_rule,
    largest_jerk,
    largest_peak,
)
from cammotion.teaching.example import EXAMPLE, QUIET_SHARE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction

_CYCLOID, _HARMONIC = 2 * math.pi, math.pi**2 / 2
_SUCKER = 90, 60  # mm and deg: its way and its angle in the lesson
_LESSONS_LEAST = 4.0  # m/s2, of the sucker at the lesson's rate
_LESSONS_BALANCED = 4198  # pieces/h; its table has the mill within 0.65 mm, and not 0.645
_ROOM, _LESS = 1.02, 0.9  # of the balance by the cycloid, that a design may have
_SHARPER = 2.0  # times the jerk of the gentle laws, that the contest allows
_GENTLE = ("modified trapezoid", "modified sine", "cycloidal")


def _peak(m: MillAndDie, stroke_mm: float, angle_deg: float, factor: float = _CYCLOID) -> float:
    time_s = float(indexing_time(angle_deg, m.rate_per_hour))
    return factor * stroke_mm / MM_PER_M / time_s**2


def _before(m: MillAndDie) -> float:
    """Return the peak of the die without overlap."""
    return _peak(m, m.stroke_mm, m.die_angle_deg)


def _die(m: MillAndDie) -> float:
    """Return the peak of the die with its widest move."""
    return _peak(m, m.stroke_mm, m.widest_deg)


def _mill(m: MillAndDie) -> float:
    return _peak(m, m.pitch_mm, m.mill_angle_deg)


def _at_peak(m: MillAndDie, allowed: float, die: float, mill: float) -> float:
    """Return the rate at which a machine with these peaks at its rate meets what is allowed."""
    return m.rate_per_hour * math.sqrt(allowed / max(die, mill))


def _peaks(m: MillAndDie) -> tuple[float, float, float]:
    """Return the peak of today, and those of the die and of the mill after it."""
    return _before(m), _die(m), _mill(m)


def _faster(m: MillAndDie) -> float:
    """Return the rate at which the overlapped machine meets the peak of today."""
    return _at_peak(m, *_peaks(m))


def _faster_alone(m: MillAndDie) -> float:
    """Return the rate to which the die could go on."""
    return _at_peak(m, _before(m), _die(m), 0)


def _mill_alone(m: MillAndDie) -> float:
    """Return the rate to which the mill could go on; NaN where the die could, too: it is right."""
    return _at_peak(m, _before(m), 0, _mill(m)) if _mill(m) < _die(m) else math.nan


def _by_velocity(m: MillAndDie) -> float:
    """Return the rate at which the mill has the die's velocity of today; NaN if the die is faster.

    Then it is what the angles of the die make, which is right where the die is hardest.
    """
    die, mill = (m.stroke_mm / m.die_angle_deg, m.pitch_mm / m.mill_angle_deg)
    return m.rate_per_hour * die / mill if mill > m.stroke_mm / m.widest_deg else math.nan


def _faster_balanced(m: MillAndDie) -> float:
    """Return the rate of the lesson's third machine: the angles of mill and die make peaks alike.

    From the middle of the mill's move until the die is down there is room for the mill to its quiet
    end, and from there for what the die has to go. NaN where the turn is too short for it.
    """
    ratio = math.sqrt(m.stroke_mm / m.pitch_mm)  # of the angles, with peaks alike
    to_go = 1 - float(LAWS["cycloidal"].inverse(m.limit_mm / m.stroke_mm))
    room_deg = m.mill_angle_deg / 2 + m.die_angle_deg
    mill_deg = room_deg / (1 / 2 - QUIET_SHARE + ratio * to_go)
    if m.work_deg + 2 * ratio * mill_deg > DEG_PER_TURN:
        return math.nan
    return _at_peak(m, _before(m), 0, _peak(m, m.pitch_mm, mill_deg))


def _unless_lessons(m: MillAndDie, rate: float) -> float:
    """Return a rate of the lesson, NaN for its own machine."""
    return math.nan if m == EXAMPLE else rate


def _with_lessons_peak(m: MillAndDie) -> Iterable[float]:
    """Yield what 12.1 is with a peak of the lesson, or with its widest move."""
    yield from with_one_of_the_lesson(partial(_at_peak, m), _peaks(m), _peaks(EXAMPLE))
    widest = _peak(m, m.stroke_mm, EXAMPLE.widest_deg)
    yield _at_peak(m, _before(m), widest, _mill(m))


def _gentlest(m: MillAndDie, way_mm: float, angle_deg: float) -> float:
    return _peak(m, way_mm, angle_deg, 4)


def _carriage(m: MillAndDie) -> tuple[float, float]:
    """Return the way in mm and the angle in deg of the carriage of 12.2."""
    return m.pitch_mm, m.mill_angle_deg


def _with_the_suckers(m: MillAndDie) -> Iterable[float]:
    """Yield what 12.2 is with way, angle or time of the lesson's sucker."""
    yield from with_one_of_the_lesson(partial(_gentlest, m), _carriage(m), _SUCKER)
    yield 4 * m.pitch_mm / MM_PER_M / float(indexing_time(_SUCKER[1], EXAMPLE.rate_per_hour)) ** 2


def _of_the_sucker(m: MillAndDie) -> float:
    """Return what 12.2 is with way and angle of the lesson's sucker.

    NaN where one of them is the carriage's, too, and at the lesson's rate, which is told by itself.
    """
    has_own = m.rate_per_hour != EXAMPLE.rate_per_hour and all(map(ne, _carriage(m), _SUCKER))
    return _gentlest(m, *_SUCKER) if has_own else math.nan


def _least(m: MillAndDie, factor: float = 4.0) -> float:
    """Return the least peak of the mill's way, or what another factor makes of it."""
    return _peak(m, *_carriage(m), factor)


def _limit(m: MillAndDie) -> float:
    return float(f"{_ROOM * largest_peak(balanced(m)):.3g}")


def _hard_limit(m: MillAndDie) -> float:
    return float(f"{_LESS * largest_peak(balanced(m)):.3g}")


def _jerk_limit(m: MillAndDie) -> float:
    return float(f"{_SHARPER * largest_jerk(balanced(m, *_GENTLE)):.2g}")


def _task(m: MillAndDie) -> str:
    rule = clearance_rule(m)
    return (
        f"A mill of {m.stops} stops and a die make {m.rate_per_hour:g} pieces per hour. The mill "
        f"goes {m.pitch_mm:g} mm on in each turn, from 0 mm; the die goes from 0 to "
        f"{m.stroke_mm:g} mm and back. From {m.down_deg:g} to {m.down_deg + m.work_deg:g} degrees "
        f"both stand, the mill at {m.pitch_mm:g} and the die at {m.stroke_mm:g} mm, and always "
        f"{rule} of a stop. (What cm.ask and cm.again return has them too: task = cm.ask(...), "
        "then task.machine.diagram and task.machine.rule.) Starts and angles are yours"
    )


EXERCISES = (
    NumberExercise(
        number="12.1",
        question=lambda m: (
            f"The mill of your machine moves {m.pitch_mm:g} mm over {m.mill_angle_deg:g} degrees, "
            f"its die {m.stroke_mm:g} mm over {m.die_angle_deg:g} degrees, at "
            f"{m.rate_per_hour:g} pieces per hour, both by the cycloid. Now the die gets its "
            f"widest move, {m.widest_deg:.2f} degrees. At which rate does the machine meet the "
            "largest peak acceleration that it had before?"
        ),
        unit="pieces/h",
        answer=_faster,
        mixed=_with_lessons_peak,
        right="The slowest of the mechanisms sets the pace, and it may be another one than before.",
        slips=(
            Slip(
                _faster_alone,
                "So fast the die could go. Who else meets that peak, and at which rate?",
                alone=True,  # any peak of the mill that is below the die's leads to it
            ),
            Slip(
                _mill_alone,
                "So fast the mill could go. Who else meets that peak, and at which rate?",
                alone=True,
            ),
            Slip(
                _by_velocity,
                "This compares the velocities. It is the acceleration that may be no larger.",
            ),
            Slip(
                _faster_balanced,
                "Here the mill got another angle, too, so that both have the same peak. In the "
                "question only the die gets another one, its widest.",
            ),
            Slip(
                lambda m: _unless_lessons(m, _faster_alone(EXAMPLE)),
                "This is a number of the lesson: so fast its die could go. Yours has other "
                "numbers, and who else meets that peak?",
            ),
            Slip(
                lambda m: _unless_lessons(m, _LESSONS_BALANCED),
                "This is a number of the lesson: so fast its machine is when mill and die are "
                "balanced. Yours has other numbers, and its mill keeps its angle.",
            ),
            Slip(
                lambda m: m.rate_per_hour * _before(m) / max(_die(m), _mill(m)),
                "The peak goes with the square of the rate. Which power of the ratio has the rate?",
            ),
            Slip(
                lambda m: (
                    m.rate_per_hour * _before(m) / (_die(m) if _mill(m) > _die(m) else math.nan)
                ),
                "This is the ratio of the die's peaks. The peak goes with the square of the rate, "
                "and the mill has a peak too.",
            ),
            Slip(
                lambda m: m.rate_per_hour * math.sqrt(_mill(m) / _die(m)),
                "This compares mill and die. What is not to be exceeded is the peak before.",
            ),
            Slip(
                lambda m: m.rate_per_hour * math.sqrt(_before(m) / (_die(m) + _mill(m))),
                "The peaks were added. Each mechanism has to keep the limit for itself.",
            ),
            Slip(
                lambda m: (
                    m.rate_per_hour * math.sqrt((_before(m) + _mill(m)) / (_die(m) + _mill(m)))
                ),
                "The peaks of both were added, before and after. Each keeps the limit for itself: "
                "the largest one counts.",
            ),
            Slip(
                lambda m: m.rate_per_hour * max(_die(m), _mill(m)) / _before(m),
                "This is slower than today. With the smaller peak the machine can run faster.",
            ),
            Slip(
                lambda m: m.rate_per_hour / math.sqrt(_before(m) / max(_die(m), _mill(m))),
                "The ratio stands upside down: this is slower than today.",
            ),
            Slip(
                lambda m: m.rate_per_hour,
                "This is today's rate. With the smaller peak the machine can run faster.",
            ),
            Slip(
                lambda m: math.sqrt(_before(m) / max(_die(m), _mill(m))),
                "So many times faster it is. The rate itself is asked for.",
            ),
        ),
        hints=(
            "Whose peak is the largest one before, and whose afterwards?",
            "All peaks grow with the square of the rate, by the same factor.",
            "Take the root of the ratio of the largest peaks, before and after; cm.rate_limits "
            "does it too: the first that it returns has the .rate_per_hour.",
        ),
    ),
    NumberExercise(
        number="12.2",
        question=lambda m: (
            f"A carriage goes {m.pitch_mm:g} mm from one still arc to the next; between them the "
            f"cam turns by {m.mill_angle_deg:g} degrees. At {m.rate_per_hour:g} pieces per hour, "
            "which peak acceleration can no motion be below, whatever its law?"
        ),
        unit="m/s²",
        is_product=True,
        answer=_least,
        mixed=_with_the_suckers,
        right="This is the first thing to compute for any move: no law, no solver, one line.",
        slips=(
            Slip(
                lambda m: _least(m, _CYCLOID),
                "This is the peak of the cycloid. Other laws have less.",
            ),
            Slip(
                lambda m: _least(m, _HARMONIC),
                "This is the simple harmonic motion. Is there none with less?",
            ),
            Slip(
                lambda m: _least(m, 2),
                "With this peak it would be there, but still at full speed. It has to stop.",
            ),
            Slip(lambda m: _least(m, 1), "A factor is missing: speed up half the way, then stop."),
            Slip(
                lambda m: _least(m, 8),
                "Half the way in half the time: how far does a constant acceleration take it?",
            ),
            Slip(
                lambda m: _least(m, 4.888),
                "This is the modified trapezoid, which has a bound on its jerk. None is asked for.",
            ),
            Slip(
                lambda m: _least(m, LAWS["modified sine"].Ca),
                "This is the modified sine, one law of many. Is there none with less?",
            ),
            Slip(
                lambda m: _peak(m, m.pitch_mm, DEG_PER_TURN - m.mill_angle_deg, 4),
                "This is with the rest of the turn. Over which angle does it move?",
            ),
            Slip(
                lambda m: _peak(m, m.pitch_mm, DEG_PER_TURN, 4),
                "The time of the whole turn was taken. The move has a part of it.",
            ),
            Slip(
                lambda m: _peak(m, m.stroke_mm, m.mill_angle_deg, 4),
                "This is with the stroke of the die. The carriage goes another way.",
            ),
            Slip(
                lambda m: (
                    4
                    * m.pitch_mm
                    / MM_PER_M
                    / float(indexing_time(m.mill_angle_deg, m.rate_per_hour))
                ),
                "The time has to be squared.",
            ),
            Slip(
                lambda m: (
                    m.pitch_mm / MM_PER_M / float(indexing_time(m.mill_angle_deg, m.rate_per_hour))
                ),
                "This is the mean velocity, in m/s. The acceleration is asked for.",
            ),
            Slip(
                lambda m: (
                    2
                    * m.pitch_mm
                    / MM_PER_M
                    / float(indexing_time(m.mill_angle_deg, m.rate_per_hour))
                ),
                "This is the peak velocity, in m/s. The acceleration is asked for.",
            ),
            Slip(
                lambda m: 4 * m.pitch_mm / MM_PER_M / m.mill_angle_deg**2,
                "The degrees were put in for the time. How long does the cam need for them?",
            ),
            Slip(
                lambda m: 4 * m.pitch_mm / MM_PER_M / math.radians(m.mill_angle_deg) ** 2,
                "The angle was put in for the time, in radians. How long does the cam need for it?",
            ),
            Slip(
                _of_the_sucker,
                "These are way and angle of the lesson's sucker. The carriage has its own.",
            ),
            Slip(
                lambda m: _LESSONS_LEAST,
                "This is the bound for the sucker of the lesson. The carriage goes another way.",
            ),
        ),
        hints=(
            "Which motion goes a way in a time with the least push?",
            "It speeds up with one acceleration for half the time, and slows down for the other.",
            "Half the way is half the acceleration times the square of half the time.",
        ),
    ),
    DesignExercise(
        number="12.3",
        question=lambda m: (
            f"{_task(m)}, the law is the cycloid. Bring the largest peak acceleration of the two "
            f"to at most {_limit(m):g} m/s²."
        ),
        answer=balanced,
        limit=_limit,
        law="cycloidal",
        right="All requirements are met.",
        hints=(
            "Give the die its widest move first. Who is the hardest then, and has it room?",
            "The less of the turn one takes, the more is left for the other: they pay each other.",
            "Give cm.optimise the diagram, the rule and the still arcs of both; or try angles of "
            "the mill with cm.with_angle, each with the widest move of the die.",
        ),
    ),
    DesignExercise(
        number="12.4",
        question=lambda m: (
            f"The contest. {_task(m)}, and so are the laws, as long as no jerk is above "
            f"{_jerk_limit(m):g} m/s³. Bring the largest peak acceleration to at most "
            f"{_hard_limit(m):g} m/s², and then as low as you can: the page of the class shows "
            "who came nearest to the bound."
        ),
        answer=lambda m: balanced(m, *_GENTLE),
        limit=_hard_limit,
        jerk_limit=_jerk_limit,
        is_contest=True,
        right="You are in the contest.",
        hints=(
            "With the cycloid it cannot be done. Which laws have a smaller peak?",
            "Rise and return may have angles and laws of their own, and so may mill and die.",
            "Give cm.optimise a list of laws, with laws of your own in it: cm.scca has three "
            "shares to play with, and the jerk says how far.",
        ),
    ),
    ChoiceExercise(
        number="12.5",
        question=lambda _: (
            "Of another machine of eight mechanisms only this is proved: no motions of its parts "
            "have a largest peak below 5.0 m/s². The design has 7.1 m/s². What follows from that "
            "alone?"
        ),
        options={
            "a": "There is a design with 5.0 m/s², it only has to be found.",
            "b": "Another law, or other angles, may bring it down, but never below 5.0 m/s², "
            "unless rules, strokes, still arcs or the rate are changed.",
            "c": "Each of the eight mechanisms can be brought to 5.0 m/s².",
            "d": "The machine cannot run faster than it does now.",
        },
        answer="b",
        reasons={
            "a": "The proof says what cannot be. That it can be reached is another claim: which "
            "motion shows it?",
            "c": "The largest of eight is bounded. What does that say of the other seven?",
            "d": "The peak grows with the rate. Is a limit of the machine met today?",
        },
        right="A bound is true under its conditions, and it says nothing of how to get there.",
        hints=(
            "Which two sentences are in a proof from both sides?",
            "What would have to be changed so that the bound moves?",
            "Ask of each option whether it speaks of what can be or of what cannot.",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "12.rate",
        "pieces per hour",
        3857,
        "One looks at the die, which could go on to 4542. But a machine is as fast as its slowest "
        "part, and after the overlap that is the mill.",
        low=10,
        high=99_999,
    ),
    Prediction(
        "12.next",
        "m/s²",
        13.103,
        "One expects 6.28, which is what is left of the first one. But the second was nearly as "
        "hard, and nobody has changed it.",
    ),
    Prediction(
        "12.bound",
        "m/s²",
        4.0,
        "One expects seven rules and seven other parts to cost something. But the sucker alone, in "
        "the sixty degrees between its still arcs, sets the bound, and it is not hindered.",
    ),
)
