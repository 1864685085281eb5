"""Exercises of notebook 05, motion laws."""

import math
from functools import partial

import sympy

from cammotion.laws.catalogue import LAWS
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MM_PER_M,
    indexing_time,
    peak_acceleration,
    peak_velocity,
)
from cammotion.teaching.copied import with_one_of_the_lesson
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.number_exercise import OF_THE_LESSON, NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import angle_with_the_same_peak
from cammotion.teaching.shown.ways import peak_of_die

_p = sympy.Symbol("p")
_WITH_CJ = (
    "This compares the jerks. What is saved in acceleration is paid for in jerk; the acceleration "
    "is asked for."
)
SPOKEN_LAWS = {
    "cycloidal": "cycloid",
    "modified sine": "modified sine",
    "modified trapezoid": "modified trapezoid",
    "3-4-5 polynomial": "3-4-5 polynomial",
    "4-5-6-7 polynomial": "4-5-6-7 polynomial",
}
"""How an exercise calls the laws that may be taken one for another."""

_NOT_THE_SINE = {law: said for law, said in SPOKEN_LAWS.items() if law != "modified sine"}
_WITH_CV = "This is with Cv, the factor of the velocity. The acceleration has Ca."
_WITH_CQ = "This is with Cq, the factor of the torque. The acceleration has Ca."
_FORCE = "This is the force, mass times acceleration. The acceleration is asked for."
_HALF_OF_THE_PERCENTAGE = (
    "Half of the percentage was taken for the root, which is nearly right for small changes, or "
    "the root was rounded. It is exact, with all its digits."
)


def _peak(m: MillAndDie, law: str, angle_deg: float | None = None) -> float:
    angle = angle_deg or m.die_angle_deg
    return float(peak_acceleration(m.stroke_mm, angle, m.rate_per_hour, law))


def _steady(m: MillAndDie) -> float:
    """Return the peak of the law of constant acceleration."""
    return _peak(m, "constant acceleration")


def _time(m: MillAndDie) -> float:
    return float(indexing_time(m.die_angle_deg, m.rate_per_hour))


def _gentle(m: MillAndDie) -> MotionLaw:
    """Return the law of 05.2 and 05.3 with the smaller peak."""
    return LAWS[m.laws.compared[0]]


def _harsh(m: MillAndDie) -> MotionLaw:
    """Return the law of 05.2 and 05.3 with the larger peak."""
    return LAWS[m.laws.compared[1]]


def _kept(m: MillAndDie) -> float:
    """Return what the gentler of the two laws leaves of the other one's peak."""
    return float(_gentle(m).Ca / _harsh(m).Ca)


def _no_larger(m: MillAndDie) -> float:
    """Return the angle with which the harsher law has no larger a peak than the gentler one."""
    return m.die_angle_deg / math.sqrt(_kept(m))


def _no_larger_in_whole_degrees(m: MillAndDie) -> float:
    """Return it rounded up, NaN where that is the nearest whole number anyway."""
    up = math.ceil(_no_larger(m))
    return up if up != round(_no_larger(m)) else math.nan


def _widest(m: MillAndDie, law: MotionLaw, limit_mm: float | None = None) -> float:
    """Return the widest angle of the die: it is at its limit, and has the angle of 03.2 left."""
    share = (limit_mm or m.limit_mm) / m.stroke_mm
    return m.overlapped_deg / (1 - float(law.inverse(share)))


def _with_factor(m: MillAndDie, factor: float) -> float:
    """Return the peak of 05.5 as it comes out with another factor of the modified sine."""
    return _overlapped(m, "modified sine") * factor / LAWS["modified sine"].Ca


def _overlapped(m: MillAndDie, law: str, of: str = "") -> float:
    """Return the peak of a law over the widest angle of that law, or of another one."""
    return _peak(m, law, _widest(m, LAWS[of or law]))


def _limits(m: MillAndDie) -> tuple[float, float]:
    """Return how deep the die of 05.5 may be, in mm, and what is left then, in deg."""
    return m.limit_mm, m.overlapped_deg


def _sine_within(m: MillAndDie, limit_mm: float, left_deg: float) -> float:
    """Return the peak of 05.5 with such limits."""
    law = LAWS["modified sine"]
    return _later(m, left_deg / (1 - float(law.inverse(limit_mm / m.stroke_mm))))


def _later(m: MillAndDie, angle_deg: float) -> float:
    """Return the peak of the modified sine over another angle than asked for."""
    return _peak(m, "modified sine", angle_deg)


def _still_to_go(m: MillAndDie) -> float:
    """Return 1 - x for the modified sine, the part of the move after it is at its limit."""
    return m.overlapped_deg / _widest(m, LAWS["modified sine"])


def _is_another(m: MillAndDie, law: str) -> bool:
    """Tell whether a law is none of the two that are compared: only then it can be a slip."""
    return law not in m.laws.compared


def _less_percent(m: MillAndDie, law: str) -> float:
    """Return by how many percent another law's peak would be smaller."""
    return 100 * (1 - LAWS[law].Ca / _harsh(m).Ca) if _is_another(m, law) else math.nan


def _less_percent_than(m: MillAndDie, law: str) -> float:
    """Return by how many percent the peak is smaller than another law's."""
    return 100 * (1 - _gentle(m).Ca / LAWS[law].Ca) if _is_another(m, law) else math.nan


def _lessons_percent(m: MillAndDie) -> float:
    """Return what the lesson says of its two laws, in whole percent; NaN for these two."""
    same = m.laws.compared == EXAMPLE.laws.compared
    return math.nan if same else round(100 * (1 - _kept(EXAMPLE)))


def _as_wide(m: MillAndDie, law: str) -> float:
    """Return the angle that is needed to be no worse than another law."""
    root = math.sqrt(_harsh(m).Ca / LAWS[law].Ca)
    return m.die_angle_deg * root if _is_another(m, law) else math.nan


def _moved_by(m: MillAndDie, law: str) -> float:
    """Return the angle that is needed if the die moves by another law than that of 05.3."""
    root = math.sqrt(LAWS[law].Ca / _gentle(m).Ca)
    return m.die_angle_deg * root if _is_another(m, law) else math.nan


def _fastest(m: MillAndDie) -> sympy.Expr:
    """Return Cv of the law of 05.4."""
    return sympy.Rational(str(m.laws.fastest))


def _line(m: MillAndDie) -> sympy.Expr:
    """Return what Cv is divided by in the answer to 05.4."""
    return 1 + (_fastest(m) - 1) * _p


EXERCISES = (
    NumberExercise(
        number="05.1",
        question=lambda m: (
            f"The die goes {m.stroke_mm:g} mm down over {m.die_angle_deg:g} degrees, at "
            f"{m.rate_per_hour:g} pieces per hour. By the law of constant acceleration it is "
            "pushed evenly for half of the time and braked as hard for the other half. How hard is "
            "that?"
        ),
        unit="m/s²",
        answer=_steady,
        shows=peak_of_die(law="constant acceleration"),
        right="No law from rest to rest can do with less. Notebook 06 has the proof.",
        slips=(
            Slip(
                lambda m: _steady(m) / 2,
                "This brings it down in the time, but at full speed. It has to be braked too: in "
                "half of the time it makes half of the way.",
            ),
            Slip(
                lambda m: 2 * _steady(m),
                "This makes the whole way in half of the time. In half of the time it makes half "
                "of the way.",
            ),
            Slip(
                lambda m: _steady(m) / 4,
                "This is the stroke over the time squared. The factor Ca is missing: the way that "
                "is made in half of the time tells what it is.",
            ),
            Slip(
                lambda m: LAWS["constant acceleration"].Ca,
                "This is Ca, which has no unit. Times the stroke over the time squared it is an "
                "acceleration.",
            ),
            *(
                Slip(
                    partial(_peak, law=law),
                    f"This is the peak of the {said}. Here the acceleration is the same all the "
                    "time, but for its sign.",
                )
                for law, said in SPOKEN_LAWS.items()
            ),
            Slip(lambda m: _steady(m) * m.die_mass_kg, _FORCE),
            Slip(
                lambda m: _peak(m, "constant acceleration", DEG_PER_TURN),
                "This is computed with the time of a whole turn. The die has only its indexing "
                "angle for the move.",
            ),
            Slip(
                lambda m: float(
                    peak_velocity(
                        m.stroke_mm, m.die_angle_deg, m.rate_per_hour, "constant acceleration"
                    )
                ),
                "This is the peak velocity, in m/s. How long does it take to reach it?",
            ),
            Slip(
                lambda m: _steady(m) / 4 * _time(m),
                "This is the mean velocity, in m/s. What is asked for is how hard it is pushed.",
            ),
            Slip(
                lambda m: _steady(m) * _time(m),
                "Here the time enters only once. It has to be squared for an acceleration.",
            ),
            Slip(
                lambda m: _peak(m, "simple harmonic"),
                "This is the peak of the simple harmonic motion, whose push gets less and less. "
                "Here it stays the same for half of the time.",
            ),
            Slip(
                lambda m: float(
                    peak_acceleration(
                        m.pitch_mm, m.mill_angle_deg, m.rate_per_hour, "constant acceleration"
                    )
                ),
                "This is the mill with this law. The die is asked for.",
            ),
            Slip(
                lambda m: _peak(m, "constant acceleration", math.radians(m.die_angle_deg)),
                "The angle was made radians. Its part of a turn is degrees out of 360.",
            ),
        ),
        hints=(
            "How far does the die come in the first half of its time?",
            "From rest, the way is half the acceleration times the time squared.",
            "Half the stroke is a (tm/2)²/2. Solve for a.",
        ),
    ),
    NumberExercise(
        number="05.2",
        question=lambda m: (
            f"The same stroke in the same time, by the law *{_gentle(m).name}* and by the law "
            f"*{_harsh(m).name}*. By how many percent is the peak acceleration of the first "
            "smaller than that of the second?"
        ),
        unit="%",
        answer=lambda m: 100 * (1 - _kept(m)),
        right=(
            "It is paid for with jerk: compare Cj of the two. Notebook 06 shows how far any law "
            "can go."
        ),
        slips=(
            Slip(
                lambda m: 100 * _kept(m),
                "So many percent are left. By how many percent is it smaller?",
            ),
            Slip(_kept, "This is what is left, as a share. How much is gone, in %?"),
            Slip(
                lambda m: 100 * (1 / _kept(m) - 1),
                "By so many percent the larger peak is larger. Compare with the larger one, not "
                "with the smaller.",
            ),
            Slip(
                lambda m: _less_percent(m, "constant acceleration"),
                "This is what the law of constant acceleration saves, which jumps. The first law "
                "of the question has to ramp up.",
            ),
            Slip(
                lambda m: _less_percent(m, "modified trapezoid"),
                "This is the modified trapezoid. Take the first law of the question.",
            ),
            Slip(
                lambda m: _less_percent(m, "modified sine"),
                "This is the modified sine. Take the first law of the question.",
            ),
            Slip(
                lambda m: _less_percent(m, "3-4-5 polynomial"),
                "This is the 3-4-5 polynomial. Take the first law of the question.",
            ),
            Slip(
                lambda m: _less_percent(m, "simple harmonic"),
                "This is the simple harmonic motion, which jumps at both ends.",
            ),
            Slip(
                lambda m: _less_percent_than(m, "modified sine"),
                "Here it is compared with the modified sine. Compare it with the second law of "
                "the question.",
            ),
            Slip(
                lambda m: _less_percent_than(m, "cycloidal"),
                "Here it is compared with the cycloid. Compare it with the second law of the "
                "question.",
            ),
            Slip(
                lambda m: _harsh(m).Ca - _gentle(m).Ca,
                "This is the difference of the two factors. How much of the larger one is that, "
                "in %?",
            ),
            Slip(
                lambda m: 100 * (_harsh(m).Ca - _gentle(m).Ca),
                "This is the difference of the two factors, times 100. How much of the larger one "
                "is the difference?",
            ),
            Slip(
                lambda m: 1 / _kept(m),
                "So many times larger is the larger peak. By how many percent is the other "
                "smaller?",
            ),
            Slip(
                lambda m: 100 / _kept(m),
                "So many percent of the smaller peak is the larger. By how many percent is the "
                "other smaller?",
            ),
            Slip(
                lambda m: 1 / _kept(m) - 1,
                "By this share of the smaller peak the larger one is larger. How much of the "
                "larger is gone, in %?",
            ),
            Slip(_lessons_percent, OF_THE_LESSON),
            Slip(lambda m: 100 * (1 - _gentle(m).Cv / _harsh(m).Cv), _WITH_CV),
            Slip(lambda m: 100 * (1 - _gentle(m).Cq / _harsh(m).Cq), _WITH_CQ),
            Slip(lambda m: 100 * (_gentle(m).Cj / _harsh(m).Cj - 1), _WITH_CJ),
            Slip(lambda m: 100 * (1 - _gentle(m).Cj / _harsh(m).Cj), _WITH_CJ),
        ),
        hints=(
            "Stroke and time are the same for both. Which factor differs?",
            "The table of factors gives Ca of both laws.",
            "Take the ratio of the two away from 1, and write it in percent.",
        ),
    ),
    NumberExercise(
        number="05.3",
        question=lambda m: (
            f"The die moves over {m.die_angle_deg:g} degrees by the law *{_harsh(m).name}*. How "
            "many degrees would it need to have no larger a peak than the law "
            f"*{_gentle(m).name}* has over {m.die_angle_deg:g}?"
        ),
        unit="deg",
        answer=_no_larger,
        goes_on_from={"05.2": lambda m, percent: m.die_angle_deg / math.sqrt(1 - percent / 100)},
        shows=angle_with_the_same_peak,
        right="So many degrees are what a better law is worth. Overlap has found more.",
        slips=(
            Slip(
                lambda m: m.die_angle_deg / _kept(m),
                "The angle counts squared. So the ratio of the angles is the root of that of the "
                "peaks.",
            ),
            Slip(
                lambda m: m.die_angle_deg * math.sqrt(_kept(m)),
                "With fewer degrees the peak gets larger. The harsher law needs more of them.",
            ),
            Slip(
                lambda m: m.die_angle_deg * _kept(m),
                "With fewer degrees the peak gets larger, and the angle counts squared.",
            ),
            Slip(
                _no_larger_in_whole_degrees,
                "This is enough, but rounded up to whole degrees. Give a digit more.",
            ),
            Slip(
                lambda m: m.die_angle_deg * (1 / math.sqrt(_kept(m)) - 1),
                "So many degrees it needs in addition. How many is that altogether?",
            ),
            Slip(
                lambda m: m.die_angle_deg * (2 - _kept(m)),
                "The percentage of the peak was put on the angle. The peak goes with the inverse "
                "square of the angle.",
            ),
            Slip(lambda m: m.die_angle_deg * (3 - _kept(m)) / 2, _HALF_OF_THE_PERCENTAGE),
            Slip(lambda m: m.die_angle_deg * (1 + 1 / _kept(m)) / 2, _HALF_OF_THE_PERCENTAGE),
            Slip(lambda m: m.die_angle_deg * 2 / (1 + _kept(m)), _HALF_OF_THE_PERCENTAGE),
            Slip(
                lambda m: m.die_angle_deg / _kept(m) ** 2,
                "The ratio of the peaks was squared. In the peak the angle is squared: the other "
                "way round that is a root.",
            ),
            Slip(
                lambda m: m.die_angle_deg / _kept(m) ** (1 / 3),
                "The third root belongs to the jerk. In the acceleration the angle is squared.",
            ),
            Slip(
                lambda m: 1 / math.sqrt(_kept(m)),
                "This is how many times wider it has to be. How many degrees is that?",
            ),
            Slip(
                lambda m: m.die_angle_deg,
                "With this angle it has the larger peak of the two. It needs more.",
            ),
            Slip(
                lambda m: _as_wide(m, "modified sine"),
                "So it would be no worse than the modified sine. Take Ca of the law in the "
                "question.",
            ),
            Slip(
                lambda m: _as_wide(m, "cycloidal"),
                "So it would be no worse than the cycloid. Take Ca of the law in the question.",
            ),
            Slip(
                lambda m: _as_wide(m, "modified trapezoid"),
                "So it would be no worse than the modified trapezoid. Take Ca of the law in the "
                "question.",
            ),
            Slip(
                lambda m: _as_wide(m, "constant acceleration"),
                "So it would be no worse than the law of constant acceleration. Take Ca of the "
                "law in the question.",
            ),
            *(
                Slip(
                    partial(_moved_by, law=law),
                    f"So many it would need if it moved by the {said}. The question names another "
                    "law.",
                )
                for law, said in SPOKEN_LAWS.items()
            ),
        ),
        hints=(
            "The peak is Ca times something that goes with 1/Bm².",
            "Ca/Bm² has to be the same for both.",
            "The angle grows by the root of the ratio of the two Ca.",
        ),
    ),
    ExpressionExercise(
        number="05.4",
        question=lambda m: (
            f"A symmetric law is fastest in the middle, with $C_v = {m.laws.fastest:g}$. It is cut "
            "there, and a straight line is put in that takes the share `p` of the whole time, with "
            "no kink where they meet. What is its new velocity factor? An expression in the symbol "
            "`p`, or a function of it."
        ),
        variables=("p",),
        between=(0.0, 1.0),
        answer=lambda m: _fastest(m) / _line(m),
        right="From Cv, without a line, it comes down to 1, the velocity of the line alone.",
        slips=(
            Slip(
                lambda m: _fastest(m) - (_fastest(m) - 1) * _p,
                "At p = 0 and 1 this is right, but the factor is no straight line between. How far "
                "does the law come in each of its three parts?",
            ),
            Slip(
                lambda m: _fastest(m) * (1 - _p),
                "With p = 1 only the line is left, and it has to go all the way in all the time: "
                "its velocity is 1, not 0.",
            ),
            Slip(
                lambda m: 1 / (_p + _fastest(m) * (1 - _p)),
                "The ends are slower than the line: their mean velocity is the line's divided by "
                "Cv, not times Cv.",
            ),
            Slip(
                lambda m: _fastest(m) / (1 - _p),
                "A longer line makes it slower, not faster. The ends are only squeezed here, as "
                "if they still made the whole way; but the line makes a part of it.",
            ),
            Slip(
                lambda m: 1 / _p,
                "This lets the line make the whole way. The two ends have their part in it.",
            ),
            Slip(
                lambda m: _fastest(m) / (1 + _fastest(m) * _p),
                "Here the two ends keep all of their time, and the line comes on top. All three "
                "share the time: for the ends 1 - p is left.",
            ),
            Slip(
                lambda m: 2 / (1 + _p),
                "This is for a law with Cv = 2. The question names another.",
            ),
            Slip(
                lambda m: _fastest(m) / (1 + _p),
                "At p = 1 only the line is left, and its velocity is 1. The 1 + p belongs to a law "
                "with Cv = 2.",
            ),
            Slip(
                lambda m: _line(m) / _fastest(m),
                "This is upside down. Without a line, at p = 0, it has to be Cv.",
            ),
            Slip(
                lambda m: _fastest(m) * (1 + _p),
                "With a line it gets slower, not faster. What is it at p = 1, where only the line "
                "is left?",
            ),
            Slip(
                lambda m: _fastest(m) / _line(m) ** 2,
                "At p = 1 only the line is left, whose velocity is 1. Was something squared?",
            ),
            Slip(
                _fastest,
                "This is what it is without the line, at p = 0. How does it change with p?",
            ),
            Slip(
                lambda m: sympy.Integer(1),
                "This is the line alone, at p = 1. How does it change with p?",
            ),
            Slip(
                lambda m: _fastest(m) / _line(m).subs(_p, _p / 100),
                "Here p is in percent. It is a share of the time, between 0 and 1.",
            ),
            Slip(
                lambda m: (1 - _p) / _line(m),
                "So much of the way the two ends make. How fast is the line?",
            ),
            Slip(
                lambda m: _fastest(m) * _p / _line(m),
                "So much of the way the line makes. How fast is it, if that takes p of the time?",
            ),
        ),
        hints=(
            "Call the new velocity V. How far does the line go, which lasts p?",
            "Over the two ends the mean velocity is V/Cv: without a line it was 1, where the "
            "largest was Cv.",
            "V p + V/Cv (1 - p) = 1.",
        ),
    ),
    NumberExercise(
        number="05.5",
        question=lambda m: (
            f"Back to the overlap. The die has a stroke of {m.stroke_mm:g} mm, may be "
            f"{m.limit_mm:g} mm deep {m.overlapped_deg:g} degrees before it has to be down, and "
            f"the machine makes {m.rate_per_hour:g} pieces per hour. Let it move by the *modified "
            "sine*, over the widest angle that this law allows. What is its peak acceleration?"
        ),
        unit="m/s²",
        answer=lambda m: _overlapped(m, "modified sine"),
        mixed=lambda m: with_one_of_the_lesson(
            partial(_sine_within, m), _limits(m), _limits(EXAMPLE)
        ),
        shows=peak_of_die(
            angle_deg=lambda m: _widest(m, LAWS["modified sine"]), law="modified sine"
        ),
        right="A law counts twice here: by its Ca, and by how early it may set off.",
        slips=(
            Slip(
                lambda m: _overlapped(m, "modified sine", of="cycloidal"),
                "This takes the cycloid's widest angle. The modified sine is at the limit at "
                "another x, so it has an angle of its own.",
            ),
            *(
                Slip(
                    partial(_overlapped, law=law, of="modified sine"),
                    f"The angle is that of the modified sine, but the peak that of the {said}: "
                    "take Ca of the same law.",
                )
                for law, said in _NOT_THE_SINE.items()
            ),
            *(
                Slip(
                    partial(_overlapped, law=law),
                    f"This is the {said}. Take the modified sine, for the angle and for the peak.",
                )
                for law, said in _NOT_THE_SINE.items()
            ),
            Slip(lambda m: _with_factor(m, LAWS["modified sine"].Cv), _WITH_CV),
            Slip(lambda m: _with_factor(m, LAWS["modified sine"].Cq), _WITH_CQ),
            Slip(
                lambda m: _peak(m, "modified sine", m.overlapped_deg),
                "These degrees are only what is left at the limit. The whole move is wider, for "
                "the die starts before.",
            ),
            Slip(
                lambda m: _peak(m, "modified sine"),
                "This is without overlap. With it the die has more than its old angle.",
            ),
            Slip(
                lambda m: _peak(
                    m, "modified sine", m.overlapped_deg / (1 - m.limit_mm / m.stroke_mm)
                ),
                "Here the share of the stroke was taken for x. At which x has the law come so far?",
            ),
            Slip(
                lambda m: _later(m, m.overlapped_deg / (1 - _still_to_go(m))),
                "This takes the degrees for the part before x. They are for the part after it, "
                "1 - x.",
            ),
            Slip(
                lambda m: _later(m, m.overlapped_deg * _still_to_go(m)),
                "These degrees are the part 1 - x of the whole. The whole has to be larger.",
            ),
            Slip(
                lambda m: _later(m, m.die_angle_deg / _still_to_go(m)),
                "The quiet end of the mill was forgotten: take the degrees of the question.",
            ),
            Slip(
                lambda m: _later(m, _widest(m, LAWS["modified sine"], m.wait_mm)),
                "The margin was forgotten: take the depth of the question.",
            ),
            Slip(
                lambda m: _overlapped(m, "modified sine") * m.limit_mm / m.stroke_mm,
                "The angle is right, but not the way. The whole stroke is made over it, not only "
                "the part down to the limit.",
            ),
            Slip(lambda m: _overlapped(m, "modified sine") * m.die_mass_kg, _FORCE),
            Slip(
                lambda m: float(
                    peak_velocity(
                        m.stroke_mm,
                        _widest(m, LAWS["modified sine"]),
                        m.rate_per_hour,
                        "modified sine",
                    )
                ),
                "This is the peak velocity, in m/s. The acceleration is asked for.",
            ),
            Slip(
                lambda m: (
                    LAWS["modified sine"].Ca
                    * m.stroke_mm
                    / MM_PER_M
                    / float(indexing_time(_widest(m, LAWS["modified sine"]), m.rate_per_hour))
                ),
                "Here the time enters only once. It has to be squared for an acceleration.",
            ),
        ),
        hints=(
            "At which x has the modified sine made this share of the stroke? Its inverse knows.",
            "The part 1 - x of the move lasts the degrees of the question.",
            'With the angle: cm.peak_acceleration(stroke, angle, rate, "modified sine").',
        ),
    ),
    ChoiceExercise(
        number="05.6",
        question=lambda m: "One of the six implementations of the bug hunt is right. Which one?",
        options={
            "a": "law_a, a modified sine",
            "b": "law_b, a modified trapezoid",
            "c": "law_c, a modified trapezoid",
            "d": "law_d, a modified sine",
            "e": "law_e, a modified sine",
            "f": "law_f, a modified trapezoid",
        },
        answer="e",
        reasons={
            "a": "Where does it end? Look at S(1).",
            "b": "It is smooth and true to itself. Is it the law it says it is? Look at its peak.",
            "c": "It begins and ends well. Is S continuous in the middle, and is V its slope?",
            "d": "It begins and ends well, and so does V. Does S jump somewhere?",
            "f": "S and V are right. Is A the slope of V everywhere, also just after the middle?",
        },
        right="It fails no test, and each of the others fails at least one. Cv, Cj or some values "
        "of S besides tell that it is the law it says it is.",
        hints=(
            "Test each one alike: the ends, jumps, S' = V, V' = A, the peak.",
            "The slope is np.diff(S) / np.diff(x); compare it with the mean of V at both ends.",
            'The peaks come from the table: cm.LAWS["modified sine"].Ca.',
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "05.best",
        "peak of the die in m/s²",
        3.232,
        "The constant acceleration has 2.645 and jumps, and nothing is below it: it lies between "
        "that and 4.154. Half the peak, 2.08, cannot be, since the die has to make the same way in "
        "the same time.",
    ),
    Prediction(
        "05.widest",
        "large or small Cv",
        "large",
        "Of these laws, the larger Cv, the wider the angle. Less velocity sounds gentler. But who "
        "is slow in the middle has gone further before it, and is 19 mm deep too soon.",
    ),
)
