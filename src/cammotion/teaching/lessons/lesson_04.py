"""Exercises of notebook 04, the machine in motion."""

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial

from cammotion.laws.catalogue import LAWS
from cammotion.limits.widest import with_angle
from cammotion.machine.kinematics import DEG_PER_TURN, SECONDS_PER_HOUR, cycle_time, indexing_time
from cammotion.teaching.copied import with_one_of_the_lesson
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.lessons.lesson_03 import IN_DEGREES, LESSONS_DEG, PLUS, law_in_degrees
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import turn_on_screen
from cammotion.teaching.shown.places import depth_before_down
from cammotion.teaching.shown.turns import rest_in_turn

BEFORE_DOWN_DEG = 30  # in 04.1
TURN_S = 9  # in 04.2


def _depth(m: MillAndDie, angle_deg: float) -> float:
    """Return how deep the die is shortly before it is down, with an indexing angle."""
    die = with_angle(m.die, angle_deg)
    return float(die.position_mm(m.down_deg - BEFORE_DOWN_DEG))


def _x(m: MillAndDie) -> float:
    """Return which part of its move the overlapped die has done then."""
    return 1 - BEFORE_DOWN_DEG / m.widest_deg


def _with_lessons_numbers(
    of: Callable[..., float], own: Sequence[float], lessons: Sequence[float]
) -> Iterator[float]:
    """Yield what follows from the numbers of a question, the widest angle first, with one other."""
    for widest_deg in LESSONS_DEG:
        yield from with_one_of_the_lesson(of, own, (widest_deg, *lessons))


def _depth_of(widest_deg: float, down_deg: float, stroke_mm: float, asked_deg: float) -> float:
    """Return the depth of 04.1 by what stands in its question."""
    return stroke_mm * float(LAWS["cycloidal"](1 - (down_deg - asked_deg) / widest_deg))


def _from_the_quiet_end(m: MillAndDie) -> float:
    done_deg = m.down_deg - BEFORE_DOWN_DEG - (m.mill_angle_deg - m.quiet_deg)
    return (
        m.stroke_mm * float(LAWS["cycloidal"](done_deg / m.widest_deg))
        if done_deg > 0
        else math.nan
    )


def _rest_deg(m: MillAndDie) -> float:
    return DEG_PER_TURN - m.work_deg - 2 * m.told_deg


def _rest_ms(widest_deg: float, work_deg: float, rate_per_hour: float) -> float:
    """Return how long the die rests at the top by what stands in the question of 04.3.

    It may be below 0, with a number that is not one of the question's.
    """
    rest_deg = DEG_PER_TURN - work_deg - 2 * widest_deg
    return 1000 * rest_deg / DEG_PER_TURN * float(cycle_time(rate_per_hour))


EXERCISES = (
    NumberExercise(
        number="04.1",
        question=lambda m: (
            f"With overlap the die moves over {m.widest_deg:.2f} degrees and is down at "
            f"{m.down_deg:g}. Its stroke is {m.stroke_mm:g} mm. How deep is it at "
            f"{m.down_deg - BEFORE_DOWN_DEG:g} degrees?"
        ),
        unit="mm",
        answer=lambda m: _depth(m, m.widest_deg),
        mixed=lambda m: _with_lessons_numbers(
            partial(_depth_of, asked_deg=m.down_deg - BEFORE_DOWN_DEG),
            (m.widest_deg, m.down_deg, m.stroke_mm),
            (EXAMPLE.down_deg, EXAMPLE.stroke_mm),
        ),
        shows=depth_before_down(BEFORE_DOWN_DEG),
        right="You can now stop the animation anywhere and say beforehand what it will show.",
        slips=(
            Slip(
                lambda m: _depth(m, m.die_angle_deg),
                "This is where the die without overlap is. The overlapped one is ahead of it.",
            ),
            Slip(
                lambda m: m.stroke_mm - _depth(m, m.widest_deg),
                "This is how far it still has to go. How deep is it?",
            ),
            Slip(
                lambda m: m.stroke_mm * (1 - BEFORE_DOWN_DEG / m.widest_deg),
                "This would be so at constant velocity. Put x into the law.",
            ),
            Slip(_x, "This is x itself. Put it into the law, and multiply by the stroke."),
            Slip(
                lambda m: _depth(m, m.widest_deg) / m.stroke_mm,
                "This is S, the share of the stroke. Multiply it by the stroke.",
            ),
            Slip(
                lambda m: m.stroke_mm * law_in_degrees(1 - BEFORE_DOWN_DEG / m.widest_deg),
                IN_DEGREES,
            ),
            Slip(
                lambda m: 2 * m.stroke_mm * _x(m) - _depth(m, m.widest_deg),
                PLUS,
            ),
            Slip(
                _from_the_quiet_end,
                "Here the move begins with the quiet end of the mill. It began before: it ends "
                "where the die is down, and has all its degrees before that.",
            ),
            Slip(
                lambda m: (
                    m.stroke_mm
                    * float(LAWS["cycloidal"]((m.down_deg - BEFORE_DOWN_DEG) / DEG_PER_TURN))
                ),
                "Here x is a part of the whole turn. x counts within the die's own move: 0 where "
                "it starts, 1 where it is down.",
            ),
        ),
        hints=(
            "When did the die start? Its move ends when it is down.",
            "At the angle asked for, which part x of its move has it done?",
            "Put x into the law and multiply by the stroke; or ask the motion with position_mm.",
        ),
    ),
    NumberExercise(
        number="04.2",
        question=lambda m: (
            f"At {m.rate_per_hour:g} pieces per hour, the animation shows a turn in {TURN_S} "
            "seconds. By which factor is an acceleration smaller in this film than in the machine, "
            "with lengths as in the machine?"
        ),
        unit="",
        answer=lambda m: (TURN_S / cycle_time(m.rate_per_hour)) ** 2,
        shows=turn_on_screen(TURN_S),
        right="That is why slow motion makes every machine look gentle.",
        slips=(
            Slip(
                lambda m: TURN_S / cycle_time(m.rate_per_hour),
                "The motion is so many times slower. In an acceleration the time counts twice.",
            ),
            Slip(
                lambda m: (cycle_time(m.rate_per_hour) / TURN_S) ** 2,
                "Upside down: how many times smaller is it on the screen?",
            ),
            Slip(
                lambda m: cycle_time(m.rate_per_hour) / TURN_S,
                "Upside down, and not squared: in an acceleration the time counts twice.",
            ),
            Slip(
                lambda m: (TURN_S / cycle_time(m.rate_per_hour)) ** 3,
                "The third power belongs to the jerk.",
            ),
            Slip(
                lambda m: (TURN_S / (m.rate_per_hour / SECONDS_PER_HOUR)) ** 2,
                "N/3600 says how many turns there are in a second. A turn takes 3600/N seconds.",
            ),
            Slip(
                lambda m: (TURN_S / cycle_time(m.rate_per_hour) * 60) ** 2,
                "Pieces per hour were taken for pieces per minute: a turn takes 3600/N seconds.",
            ),
            Slip(
                lambda m: (TURN_S / cycle_time(m.rate_per_hour) * 3600) ** 2,
                "Pieces per hour were taken for pieces per second: a turn takes 3600/N seconds.",
            ),
        ),
        hints=(
            "How long does a turn take in the machine?",
            "How many times longer does it take on the screen?",
            "A velocity is smaller by this factor. And an acceleration?",
        ),
    ),
    NumberExercise(
        number="04.3",
        question=lambda m: (
            f"With overlap the die moves over {m.told_deg:.2f} degrees each way and works for "
            f"{m.work_deg:g}. How long does it rest at the top, in milliseconds, at "
            f"{m.rate_per_hour:g} pieces per hour?"
        ),
        unit="ms",
        is_sum=True,
        answer=lambda m: _rest_ms(m.told_deg, m.work_deg, m.rate_per_hour),
        also=lambda m: _rest_ms(m.widest_deg, m.work_deg, m.rate_per_hour),
        mixed=lambda m: _with_lessons_numbers(
            _rest_ms,
            (m.told_deg, m.work_deg, m.rate_per_hour),
            (EXAMPLE.work_deg, EXAMPLE.rate_per_hour),
        ),
        tolerance=0.01,
        shows=rest_in_turn,
        right=(
            "The degrees that it does not rest at the top go into its moves, and make them gentle."
        ),
        slips=(
            Slip(
                _rest_deg,
                "This is the rest in degrees. How long does the machine take for them?",
            ),
            Slip(
                lambda m: (
                    1000 * indexing_time(DEG_PER_TURN - m.work_deg - m.told_deg, m.rate_per_hour)
                ),
                "The die moves twice in a turn, down and up.",
            ),
            Slip(
                lambda m: 1000 * indexing_time(2 * m.told_deg, m.rate_per_hour),
                "This is the time of both moves. How long does it rest?",
            ),
            Slip(
                lambda m: 1000 * indexing_time(m.told_deg, m.rate_per_hour),
                "This is the time of one move. What do both moves and the work leave?",
            ),
            Slip(
                lambda m: 1000 * indexing_time(m.mill_angle_deg, m.rate_per_hour),
                "This is how long the die rests without overlap, while the mill moves. With "
                "overlap its moves take more of the turn.",
            ),
            Slip(
                lambda m: 1000 * indexing_time(m.work_deg, m.rate_per_hour),
                "This is how long it works at the bottom. How long does it rest at the top?",
            ),
            Slip(
                lambda m: 1000 * indexing_time(DEG_PER_TURN - 2 * m.told_deg, m.rate_per_hour),
                "The degrees of the work have to be taken away as well. What is left is at the "
                "top.",
            ),
        ),
        hints=(
            "What is left of 360 degrees without the work and both ways?",
            "A degree takes 3600/N/360 seconds.",
            "Multiply, and mind that milliseconds are asked for.",
        ),
    ),
    ChoiceExercise(
        number="04.4",
        question=lambda m: (
            "You have watched a design at a twentieth of its speed, for ten turns, and nothing "
            "touched. Its parts are taken as rigid. What do you know?"
        ),
        options={
            "a": "The design is free of collision.",
            "b": "Nothing goes wrong that is large enough to see; the rest has to be solved for.",
            "c": "Nothing: an animation has no value.",
            "d": "It is free of collision at this speed, but perhaps not at full speed.",
        },
        answer="b",
        reasons={
            "a": (
                "A violation of a tenth of a millimetre, or of a hundredth of a degree, is there "
                "and cannot be seen."
            ),
            "c": (
                "It shows large mistakes at once, and it shows whether you have understood what "
                "you computed."
            ),
            "d": (
                "Where rigid parts are depends on the cam angle, not on the speed. What speed "
                "changes are the forces, and with them how far real parts bend."
            ),
        },
        right="Watch to understand, and solve to be sure.",
        hints=(
            "How long would a violation of a hundredth of a degree be on the screen?",
            "Do the positions in a timing diagram depend on the rate?",
            "Two options claim too much, one too little.",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "04.start",
        "depth of the die in mm, at 0 deg",
        30.9,
        "It is tempting to say 0, since the die has to be out of the way, or 19, the depth of the "
        "rule. But the mill starts so gently that it needs 15 degrees for its first 0.65 mm, and "
        "in these the die comes up to 19 mm.",
    ),
    Prediction(
        "04.collision",
        "from which angle; down, up or both",
        "at 126.5 deg, on the way down",
        "Both ways seems likely, because the turn is full. But the way up has only 120 "
        "degrees, and more would be allowed.",
    ),
)
