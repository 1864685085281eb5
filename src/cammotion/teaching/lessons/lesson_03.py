"""Exercises of notebook 03, how far two motions may overlap."""

import math
from collections.abc import Iterator

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import DEG_PER_TURN, peak_acceleration
from cammotion.teaching.copied import with_one_of_the_lesson
from cammotion.teaching.example import EXAMPLE, QUIET_SHARE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.places import mill_before_stop, place_of_die
from cammotion.teaching.shown.turns import way_after, widened_way
from cammotion.teaching.shown.ways import peak_of_die

IN_DEGREES = (
    "This comes out if the sine counts in degrees. 2 pi x is in radians: let the sine count in "
    "radians."
)

PLUS = "There is a minus before the sine of the law, which makes it start gently."

_LAW = LAWS["cycloidal"]
LESSONS_DEG = (round(EXAMPLE.widest_deg, 2), 124.91)  # the widest angles that 03 and 04 print
_CONSTANT, _HARMONIC = LAWS["constant acceleration"], LAWS["simple harmonic"]
_BY_CONSTANT = (
    "This is so by the law of constant acceleration. The cycloid starts and ends more gently."
)
_BY_HARMONIC = "This is so by the simple harmonic law. The cycloid starts and ends more gently."


def _way(share: float) -> float:
    """Return x at which the cycloid has covered a share of the stroke."""
    return float(_LAW.inverse(share))


def _share(m: MillAndDie) -> float:
    return m.limit_mm / m.stroke_mm


def _place(m: MillAndDie) -> float:
    return _way(_share(m))


def law_in_degrees(x: float) -> float:
    """Return S(x) as it comes out if the sine takes 2 pi x for degrees."""
    return x - math.sin(math.radians(2 * math.pi * x)) / (2 * math.pi)


def _place_in_degrees(m: MillAndDie) -> float:
    """Return the place that this law leads to; as good as a straight line, so by the rule of three.

    The sine of so small an angle is the angle.
    """
    return m.limit_mm / m.stroke_mm / law_in_degrees(1)


def _place_with_plus(share: float) -> float:
    """Return x at which x + sin(2 pi x)/(2 pi) is a share: the law, half a move further on."""
    turns, place = divmod(share + 0.5, 1)
    return turns + _way(place) - 0.5


def _place_of(stroke_mm: float, wait_mm: float, margin_mm: float) -> float:
    """Return the x of 03.3 by what stands in its question."""
    return _way((wait_mm - margin_mm) / stroke_mm)


def _with_lessons_angle(m: MillAndDie) -> Iterator[float]:
    """Yield what 03.5 is with one of its two angles as the lesson has it."""
    yield (m.widest_deg / EXAMPLE.die_angle_deg) ** 2
    for widest_deg in LESSONS_DEG if m != EXAMPLE else ():
        yield (widest_deg / m.die_angle_deg) ** 2


def _quiet_way_mm(m: MillAndDie) -> float:
    return m.pitch_mm * float(_LAW(QUIET_SHARE))


EXERCISES = (
    NumberExercise(
        number="03.1",
        question=lambda m: (
            f"The mill moves {m.pitch_mm:g} mm over {m.mill_angle_deg:g} degrees by the cycloidal "
            f"law. How far is it from its stop {m.quiet_deg:g} degrees before the end of its move?"
        ),
        unit="mm",
        answer=_quiet_way_mm,
        shows=mill_before_stop(lambda m: m.quiet_deg),
        right="Not a hundredth of the way in a tenth of the time: this is where overlap lives.",
        slips=(
            Slip(
                lambda m: QUIET_SHARE * m.pitch_mm,
                "This would be so at constant velocity. The cycloid is slow at its ends: put x "
                "into the law.",
            ),
            Slip(
                lambda m: m.pitch_mm - _quiet_way_mm(m),
                "This is how far it has come. How far does it still have to go?",
            ),
            Slip(
                lambda m: 100 * float(_LAW(QUIET_SHARE)),
                "This is the share of the stroke in percent. How many millimetres is that?",
            ),
            Slip(
                lambda m: float(_LAW(QUIET_SHARE)),
                "This is S, the share of the stroke. Multiply it by the stroke.",
            ),
            Slip(
                lambda m: m.stroke_mm * float(_LAW(QUIET_SHARE)),
                "This is with the stroke of the die. How far does the mill move?",
            ),
            Slip(
                lambda m: m.pitch_mm * 2 * math.pi**2 / 3 * QUIET_SHARE**3,
                "This is the first term of the series, which is good for small x only. Put x into "
                "the whole law.",
            ),
            Slip(lambda m: m.pitch_mm * law_in_degrees(QUIET_SHARE), IN_DEGREES),
            Slip(lambda m: m.pitch_mm * (1 - law_in_degrees(1 - QUIET_SHARE)), IN_DEGREES),
            Slip(lambda m: m.pitch_mm * (2 * QUIET_SHARE - float(_LAW(QUIET_SHARE))), PLUS),
            Slip(
                lambda m: m.pitch_mm * (QUIET_SHARE - math.sin(2 * math.pi * QUIET_SHARE)),
                "Something is missing below the sine: it has to be divided by 2 pi.",
            ),
            Slip(
                lambda m: m.pitch_mm * float(_LAW(m.quiet_deg / DEG_PER_TURN)),
                "Here x is a part of the whole turn. x counts within the mill's own move: 0 at its "
                "start, 1 at its end.",
            ),
            Slip(
                lambda m: m.pitch_mm * float(_LAW(m.quiet_deg / m.die_angle_deg)),
                "Here x is a part of the die's move. It is the mill that moves: take its angle.",
            ),
            Slip(
                lambda m: m.pitch_mm * float(_LAW(2 * QUIET_SHARE)),
                "This is with x = 0.2, both ends of the move. Only the last one is asked about.",
            ),
            Slip(
                lambda _: 1 - float(_LAW(QUIET_SHARE)),
                "This is the share of the stroke that is done. How many millimetres are still to "
                "go?",
            ),
            Slip(lambda m: m.pitch_mm * float(_CONSTANT(QUIET_SHARE)), _BY_CONSTANT),
            Slip(lambda m: m.pitch_mm * float(_HARMONIC(QUIET_SHARE)), _BY_HARMONIC),
        ),
        hints=(
            "How large a part of its move is still to come, in x?",
            "By symmetry as much is left in the last part as was covered in the first.",
            "Put x = 0.1 into S(x) = x - sin(2 pi x)/(2 pi), and multiply by the way of the mill.",
        ),
    ),
    NumberExercise(
        number="03.2",
        question=lambda m: (
            f"For the die the mill counts as standing during the first and last {m.quiet_deg:g} "
            f"of its {m.mill_angle_deg:g} degrees. The die works for {m.work_deg:g} degrees, and "
            "its ways lie where the mill counts as standing. How many degrees does the die get for "
            "each way?"
        ),
        unit="deg",
        is_sum=True,
        answer=lambda m: m.overlapped_deg,
        goes_on_from={"01.1": lambda m, degrees: degrees + m.quiet_deg},
        shows=way_after(quiet=True),
        right="A first improvement that costs nothing: only the mill's effective angle is blocked.",
        slips=(
            Slip(
                lambda m: m.die_angle_deg,
                "This is the angle without overlap. The quiet ends of the mill's move come on top.",
            ),
            Slip(
                lambda m: m.die_angle_deg + 2 * m.quiet_deg,
                "Both quiet ends were given to one way. There are two ways, and one quiet end for "
                "each.",
            ),
            Slip(
                lambda m: m.die_angle_deg + m.quiet_deg / 2,
                "Only one of the two quiet ends was counted.",
            ),
            Slip(
                lambda m: 2 * m.overlapped_deg,
                "These are both ways together. Each gets half.",
            ),
            Slip(
                lambda m: (DEG_PER_TURN - m.mill_angle_deg) / 2 + m.quiet_deg,
                "The degrees of the work were forgotten. While the die works it does not move.",
            ),
            Slip(
                lambda m: m.mill_angle_deg - 2 * m.quiet_deg,
                "This is the effective angle of the mill. What does it leave for the die?",
            ),
            Slip(
                lambda m: m.mill_angle_deg / 2 - m.quiet_deg,
                "This is half of the mill's effective angle. What does all of it leave for the "
                "die?",
            ),
            Slip(
                lambda m: m.die_angle_deg - m.quiet_deg,
                "The quiet ends were added to the mill's degrees. They are taken away from them.",
            ),
            Slip(
                lambda m: m.work_deg / 2,
                "This is half of the work, in which the die does not move. What do work and mill "
                "leave?",
            ),
        ),
        hints=(
            "What is the effective angle of the mill, without its two quiet ends?",
            "Take the effective angle and the work away from 360 degrees.",
            "What is left is for two ways.",
        ),
    ),
    NumberExercise(
        number="03.3",
        question=lambda m: (
            f"The die has a stroke of {m.stroke_mm:g} mm and touches the mill after {m.wait_mm:g} "
            f"mm. With a margin of {m.margin_mm:g} mm: at which x of its cycloidal move is it as "
            "deep as it may be as long as the mill is not near its stop?"
        ),
        unit="",
        answer=_place,
        mixed=lambda m: with_one_of_the_lesson(
            _place_of,
            (m.stroke_mm, m.wait_mm, m.margin_mm),
            (EXAMPLE.stroke_mm, EXAMPLE.wait_mm, EXAMPLE.margin_mm),
        ),
        shows=place_of_die,
        right="The unknown stands inside a sine: there is an answer, but no closed formula for it.",
        slips=(
            Slip(
                lambda m: m.limit_mm / m.stroke_mm,
                "This is S, the share of the stroke. At which x does the law have this value?",
            ),
            Slip(
                lambda m: m.wait_mm / m.stroke_mm,
                "This is the share of the stroke at which the die touches the mill. Take the "
                "margin away first. And at which x does the law have that value?",
            ),
            Slip(lambda m: _place_with_plus(_share(m)), PLUS),
            Slip(lambda m: float(_CONSTANT.inverse(_share(m))), _BY_CONSTANT),
            Slip(lambda m: float(_HARMONIC.inverse(_share(m))), _BY_HARMONIC),
            Slip(
                lambda m: _way(m.wait_mm / m.stroke_mm),
                "At this x the die touches the mill. With a margin it may be less deep than that.",
            ),
            Slip(
                lambda m: _way((m.wait_mm + m.margin_mm) / m.stroke_mm),
                "The margin was added. It is to stay free: the die may be less deep, not deeper.",
            ),
            Slip(
                lambda m: 1 - _place(m),
                "This is the part of the move that is still to come. Which part is done?",
            ),
            Slip(
                lambda m: float(_LAW(m.limit_mm / m.stroke_mm)),
                "The law was used the wrong way round: S is known, and x is wanted.",
            ),
            Slip(_place_in_degrees, IN_DEGREES),
            Slip(
                lambda m: 2 * _share(m) - float(_LAW(_share(m))),
                "This is one step on the way, S + sin(2 pi S)/(2 pi). Put it in for x, and go on "
                "until nothing changes.",
            ),
            Slip(
                lambda m: m.limit_mm,
                "This is how deep it may be, in mm. Which share of the stroke is that, and at "
                "which x?",
            ),
            Slip(
                lambda m: m.die_angle_deg * _place(m),
                "This is in degrees of cam angle. x itself is asked for, between 0 and 1.",
            ),
        ),
        hints=(
            "How deep may the die be, in mm? And what share of its stroke is that?",
            "Solve x - sin(2 pi x)/(2 pi) = this share.",
            "Let SymPy search from the middle on, sympy.nsolve(equation, x, 0.5), or ask the law's "
            "own inverse.",
        ),
    ),
    NumberExercise(
        number="03.4",
        question=lambda m: (
            f"The die may start so early that it is at x of exercise 03.3 when the quiet end of "
            f"the mill's move begins, at {m.mill_angle_deg - m.quiet_deg:g} degrees. It has to be "
            f"down at {m.down_deg:g}. What is the widest indexing angle of the die?"
        ),
        unit="deg",
        answer=lambda m: m.overlapped_deg / (1 - _place(m)),
        goes_on_from={
            "03.2": lambda m, degrees: degrees / (1 - _place(m)),
            "03.3": lambda m, x: m.overlapped_deg / (1 - x),
        },
        shows=widened_way,
        right="The move's first part costs nothing, since nobody is in the way of it.",
        slips=(
            Slip(
                lambda m: m.overlapped_deg / _place(m),
                "This takes the degrees for the part before x. They are for the part after it, "
                "1 - x.",
            ),
            Slip(
                lambda m: m.overlapped_deg * (1 + _place(m)),
                "The part x was added to these degrees. They are the part 1 - x of the whole: "
                "divide by it.",
            ),
            Slip(
                lambda m: m.overlapped_deg * (1 - _place(m)),
                "These degrees are the part 1 - x of the whole. The whole has to be larger.",
            ),
            Slip(
                lambda m: m.die_angle_deg / (1 - _place(m)),
                "The quiet end of the mill was forgotten. It comes on top of the angle without "
                "overlap.",
            ),
            Slip(
                lambda m: m.overlapped_deg,
                "These are the degrees from the quiet end until the die is down. Its move has "
                "begun before: they are only the part 1 - x of it.",
            ),
            Slip(
                lambda m: m.mill_angle_deg - 2 * m.quiet_deg,
                "This is the effective angle of the mill. How wide is the move of the die?",
            ),
            Slip(
                lambda m: m.overlapped_deg / (1 - m.limit_mm / m.stroke_mm),
                "Here the share of the stroke was taken for x. They would be equal at constant "
                "velocity only.",
            ),
            Slip(
                lambda m: 2 * m.overlapped_deg,
                "This would be so if the die were half-way, at x = 0.5. Exercise 03.3 has its x.",
            ),
            Slip(
                lambda m: m.overlapped_deg / (1 - _way(m.wait_mm / m.stroke_mm)),
                "The margin was forgotten: this is with the x at which the die touches the mill.",
            ),
            Slip(
                lambda m: m.overlapped_deg / (1 - _way((m.wait_mm + m.margin_mm) / m.stroke_mm)),
                "The margin was added. It is to stay free: the die may be less deep, not deeper.",
            ),
            Slip(
                lambda m: m.down_deg - m.overlapped_deg / (1 - _place(m)),
                "This is the cam angle at which the die starts. How long is its move, in degrees?",
            ),
        ),
        hints=(
            "Which part of the move is still to come at x?",
            "This part, 1 - x, takes the degrees between the two angles of the question.",
            "(1 - x) Bm is known. Solve it for Bm.",
        ),
    ),
    NumberExercise(
        number="03.5",
        question=lambda m: (
            f"The die had {m.die_angle_deg:g} degrees without overlap and has the angle of "
            "exercise 03.4 now. How many times smaller is its peak acceleration?"
        ),
        unit="",
        answer=lambda m: (m.overlapped_deg / (1 - _place(m)) / m.die_angle_deg) ** 2,
        goes_on_from={"03.4": lambda m, angle: (angle / m.die_angle_deg) ** 2},
        mixed=_with_lessons_angle,
        shows=peak_of_die(
            "With a peak so many times smaller",
            peak=lambda m, times: (
                peak_acceleration(m.stroke_mm, m.die_angle_deg, m.rate_per_hour) / times
            ),
            angle_deg=lambda m: m.widest_deg,
        ),
        right="The inverse square again. No part of the machine was made better to get it.",
        slips=(
            Slip(
                lambda m: m.overlapped_deg / (1 - _place(m)) / m.die_angle_deg,
                "The angle is so many times longer. The acceleration goes with its square.",
            ),
            Slip(
                lambda m: (m.die_angle_deg * (1 - _place(m)) / m.overlapped_deg) ** 2,
                "This is new by old. How many times smaller is it: old by new.",
            ),
            Slip(
                lambda m: (m.overlapped_deg / m.die_angle_deg) ** 2,
                "This is what the quiet ends alone bring. Take the angle of exercise 03.4.",
            ),
            Slip(
                lambda m: peak_acceleration(
                    m.stroke_mm, m.overlapped_deg / (1 - _place(m)), m.rate_per_hour
                ),
                "This is the new peak itself, in m/s². How many times smaller than the old one?",
            ),
            Slip(
                lambda m: peak_acceleration(m.stroke_mm, m.die_angle_deg, m.rate_per_hour),
                "This is the old peak itself, in m/s². How many times smaller is the new one?",
            ),
            Slip(
                lambda m: 1 - (m.die_angle_deg * (1 - _place(m)) / m.overlapped_deg) ** 2,
                "This is by which share it is smaller. How many times is it: old by new.",
            ),
            Slip(
                lambda m: (m.overlapped_deg / (1 - _place(m)) / m.die_angle_deg) ** 3,
                "The third power belongs to the jerk. The acceleration has the second.",
            ),
            Slip(
                lambda m: 100 * (1 - (m.die_angle_deg * (1 - _place(m)) / m.overlapped_deg) ** 2),
                "This is by how many percent it is smaller. How many times is it: old by new.",
            ),
            Slip(
                lambda m: (
                    peak_acceleration(m.stroke_mm, m.die_angle_deg, m.rate_per_hour)
                    - peak_acceleration(
                        m.stroke_mm, m.overlapped_deg / (1 - _place(m)), m.rate_per_hour
                    )
                ),
                "This is the difference of the two peaks, in m/s². Divide the old one by the new.",
            ),
        ),
        hints=(
            "Stroke, rate and law are the same. Only the angle has changed.",
            "The peak goes with 1 over the angle squared.",
            "Square the ratio of the new angle to the old one.",
        ),
    ),
    ChoiceExercise(
        number="03.6",
        question=lambda m: (
            "On the clearance map the margin above the mill is made larger. What happens?"
        ),
        options={
            "a": "The lower edge of the forbidden region comes down, and the widest angle shrinks.",
            "b": "The left edge of the forbidden region moves right, and the widest angle grows.",
            "c": "The region stays; the path of the machine moves away from it.",
            "d": "The lower edge goes up, and the widest angle grows.",
        },
        answer="a",
        reasons={
            "b": "The left edge says how exactly the mill has to stand. The margin is about depth.",
            "c": "The region is made by the rule, and the margin is a part of the rule.",
            "d": "A larger margin allows the die less depth while the mill moves, not more.",
        },
        right="Safety has a price, and the map shows which edge it is paid at.",
        hints=(
            "Which of the two halves of the rule does the margin belong to?",
            "With a larger margin, may the die be deeper, or less deep, while the mill moves?",
            "The depth is drawn vertically. Which edge of the region is the allowed depth?",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "03.share",
        "percent of the stroke",
        0.645,
        "At constant velocity it would be 10 %. Who knows that it starts gently says 5 % "
        "or 2 %. It starts far more gently than that.",
    ),
    Prediction(
        "03.widest",
        "degrees for each way",
        124.84,
        "113 comes out if 19/50 of the way is taken for 19/50 of the time. And those who expect "
        "a small gain say 80 or 90.",
    ),
    Prediction(
        "03.harder",
        "mill or die",
        "the mill",
        "It is tempting to say the die still: it has been the hard-driven one for three notebooks.",
    ),
)
