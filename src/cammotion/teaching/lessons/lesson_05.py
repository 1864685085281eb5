"""Exercises of notebook 05, motion laws."""

import math

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
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, NumberExercise, Slip
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.bars import angle_with_peak_of
from cammotion.teaching.shown.ways import peak_of_die

_CYCLOIDAL = LAWS["cycloidal"]
_p = sympy.Symbol("p")


def _peak(m: MillAndDie, law: str, angle_deg: float | None = None) -> float:
    angle = angle_deg or m.die_angle_deg
    return float(peak_acceleration(m.stroke_mm, angle, m.rate_per_hour, law))


def _steady(m: MillAndDie) -> float:
    """Return the peak of the law of constant acceleration."""
    return _peak(m, "constant acceleration")


def _time(m: MillAndDie) -> float:
    return float(indexing_time(m.die_angle_deg, m.rate_per_hour))


def _kept() -> float:
    """Return what the modified trapezoid leaves of the cycloid's peak."""
    return LAWS["modified trapezoid"].Ca / _CYCLOIDAL.Ca


def _widest(m: MillAndDie, law: MotionLaw, limit_mm: float | None = None) -> float:
    """Return the widest angle of the die: it is at its limit, and has the angle of 03.2 left."""
    share = (limit_mm or m.limit_mm) / m.stroke_mm
    return m.overlapped_deg / (1 - float(law.inverse(share)))


def _overlapped(m: MillAndDie, law: str, of: str = "") -> float:
    """Return the peak of a law over the widest angle of that law, or of another one."""
    return _peak(m, law, _widest(m, LAWS[of or law]))


def _later(m: MillAndDie, angle_deg: float) -> float:
    """Return the peak of the modified sine over another angle than asked for."""
    return _peak(m, "modified sine", angle_deg)


def _still_to_go(m: MillAndDie) -> float:
    """Return 1 - x for the modified sine, the part of the move after it is at its limit."""
    return m.overlapped_deg / _widest(m, LAWS["modified sine"])


def _less_percent(law: str, than: str = "cycloidal") -> float:
    return 100 * (1 - LAWS[law].Ca / LAWS[than].Ca)


def _as_wide(m: MillAndDie, law: str, root: float = 2) -> float:
    """Return the angle that the cycloid needs to be no worse than a law, by a root of the ratio."""
    return float(m.die_angle_deg * (_CYCLOIDAL.Ca / LAWS[law].Ca) ** (1 / root))


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
            Slip(
                lambda m: _peak(m, "cycloidal"),
                "This is the peak of the cycloid. Here the acceleration is the same all the time, "
                "but for its sign.",
            ),
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
            "Among the named laws without a jump in the acceleration the modified trapezoid has "
            "the smallest peak. By how many percent is it smaller than that of the cycloid?"
        ),
        unit="%",
        answer=lambda m: 100 * (1 - _kept()),
        right=(
            "It is paid for with jerk: Cj is 61 in place of 39. Notebook 06 shows how little more "
            "there is to gain."
        ),
        slips=(
            Slip(
                lambda m: 100 * _kept(),
                "So many percent are left. By how many percent is it smaller?",
            ),
            Slip(lambda m: _kept(), "This is what is left, as a share. How much is gone, in %?"),
            Slip(
                lambda m: 100 * (1 / _kept() - 1),
                "By so many percent the cycloid's peak is larger. Compare with the cycloid's, not "
                "with the smaller one.",
            ),
            Slip(
                lambda m: _less_percent("constant acceleration"),
                "This is what the law of constant acceleration saves, which jumps. The modified "
                "trapezoid has to ramp up first.",
            ),
            Slip(
                lambda m: _less_percent("modified sine"),
                "This is the modified sine. The modified trapezoid has a flat top.",
            ),
            Slip(
                lambda m: _less_percent("3-4-5 polynomial"),
                "This is the 3-4-5 polynomial. Look for the modified trapezoid in the table.",
            ),
            Slip(
                lambda m: _less_percent("simple harmonic"),
                "This is the simple harmonic motion, which jumps at both ends.",
            ),
            Slip(
                lambda m: _less_percent("modified trapezoid", than="modified sine"),
                "Here it is compared with the modified sine. Compare it with the cycloid.",
            ),
            Slip(
                lambda m: _CYCLOIDAL.Ca - LAWS["modified trapezoid"].Ca,
                "This is the difference of the two factors. How much of the cycloid's is that, "
                "in %?",
            ),
            Slip(
                lambda m: 1 / _kept(),
                "So many times larger is the cycloid's. By how many percent is the other smaller?",
            ),
            Slip(
                lambda m: 100 * (LAWS["modified trapezoid"].Cj / _CYCLOIDAL.Cj - 1),
                "By so much the jerk is larger, which is the price. The acceleration is asked for.",
            ),
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
            f"The cycloidal die moves over {m.die_angle_deg:g} degrees. How many degrees would it "
            "need to have no larger a peak than the modified trapezoid has over "
            f"{m.die_angle_deg:g}?"
        ),
        unit="deg",
        answer=lambda m: m.die_angle_deg / math.sqrt(_kept()),
        goes_on_from={"05.2": lambda m, percent: m.die_angle_deg / math.sqrt(1 - percent / 100)},
        shows=angle_with_peak_of("modified trapezoid"),
        right="So a better law is worth a few degrees. Overlap has found dozens.",
        slips=(
            Slip(
                lambda m: m.die_angle_deg / _kept(),
                "The angle counts squared. So the ratio of the angles is the root of that of the "
                "peaks.",
            ),
            Slip(
                lambda m: m.die_angle_deg * math.sqrt(_kept()),
                "With fewer degrees the peak gets larger. The cycloid needs more of them.",
            ),
            Slip(
                lambda m: m.die_angle_deg * _kept(),
                "With fewer degrees the peak gets larger, and the angle counts squared.",
            ),
            Slip(
                lambda m: m.die_angle_deg * (1 / math.sqrt(_kept()) - 1),
                "So many degrees it needs in addition. How many is that altogether?",
            ),
            Slip(
                lambda m: m.die_angle_deg * (2 - _kept()),
                "The percentage of the peak was put on the angle. The peak goes with the inverse "
                "square of the angle.",
            ),
            Slip(
                lambda m: m.die_angle_deg * (3 - _kept()) / 2,
                "Half of the percentage was put on the angle. For small changes that is nearly "
                "right; the root is exact.",
            ),
            Slip(
                lambda m: m.die_angle_deg / _kept() ** 2,
                "The ratio of the peaks was squared. In the peak the angle is squared: the other "
                "way round that is a root.",
            ),
            Slip(
                lambda m: _as_wide(m, "modified trapezoid", root=3),
                "The third root belongs to the jerk. In the acceleration the angle is squared.",
            ),
            Slip(
                lambda m: 1 / math.sqrt(_kept()),
                "This is how many times wider it has to be. How many degrees is that?",
            ),
            Slip(
                lambda m: m.die_angle_deg,
                "With this angle it has the larger peak of the two. It needs more.",
            ),
            Slip(
                lambda m: _as_wide(m, "modified sine"),
                "So it would be no worse than the modified sine. Take Ca of the modified "
                "trapezoid.",
            ),
            Slip(
                lambda m: _as_wide(m, "constant acceleration"),
                "So it would be no worse than the law of constant acceleration. Take Ca of the "
                "modified trapezoid.",
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
            "A symmetric law is fastest in the middle, with $C_v = 2$, like the cycloid. It is cut "
            "there, and a straight line is put in that takes the share `p` of the whole time, with "
            "no kink where they meet. What is its new velocity factor? An expression in the symbol "
            "`p`, or a function of it."
        ),
        variables=("p",),
        between=(0.0, 1.0),
        answer=2 / (1 + _p),
        right="From 2, without a line, it comes down to 1, the velocity of the line alone.",
        slips=(
            Slip(
                lambda m: 2 - _p,
                "At p = 0 and 1 this is right, but the factor is no straight line between. How far "
                "does the law come in each of its three parts?",
            ),
            Slip(
                lambda m: 2 * (1 - _p),
                "With p = 1 only the line is left, and it has to go all the way in all the time: "
                "its velocity is 1, not 0.",
            ),
            Slip(
                lambda m: 1 / (_p + 2 * (1 - _p)),
                "The ends are slower than the line: their mean velocity is half of it, not twice.",
            ),
            Slip(
                lambda m: 2 / (1 - _p),
                "A longer line makes it slower, not faster. The ends are only squeezed here, as "
                "if they still made the whole way; but the line makes a part of it.",
            ),
            Slip(
                lambda m: 1 / _p,
                "This lets the line make the whole way. The two ends have their part in it.",
            ),
            Slip(
                lambda m: 2 / (1 + 2 * _p),
                "Here the two ends keep all of their time, and the line comes on top. All three "
                "share the time: for the ends 1 - p is left.",
            ),
            Slip(
                lambda m: (1 + _p) / 2,
                "This is upside down. Without a line, at p = 0, it has to be 2.",
            ),
            Slip(
                lambda m: 2 * (1 + _p),
                "With a line it gets slower, not faster. What is it at p = 1, where only the line "
                "is left?",
            ),
            Slip(
                lambda m: 2 / (1 + _p) ** 2,
                "At p = 1 only the line is left, whose velocity is 1. Was something squared?",
            ),
            Slip(
                lambda m: sympy.Integer(2),
                "This is what it is without the line, at p = 0. How does it change with p?",
            ),
            Slip(
                lambda m: sympy.Integer(1),
                "This is the line alone, at p = 1. How does it change with p?",
            ),
            Slip(
                lambda m: 2 / (1 + _p / 100),
                "Here p is in percent. It is a share of the time, between 0 and 1.",
            ),
            Slip(
                lambda m: 2 * sympy.pi / (1 - _p**2),
                "This is the factor of the acceleration, for a cycloid. The velocity is asked for.",
            ),
            Slip(
                lambda m: (1 - _p) / (1 + _p),
                "So much of the way the two ends make. How fast is the line?",
            ),
            Slip(
                lambda m: 2 * _p / (1 + _p),
                "So much of the way the line makes. How fast is it, if that takes p of the time?",
            ),
        ),
        hints=(
            "Call the new velocity V. How far does the line go, which lasts p?",
            "Over the two ends the mean velocity is V/2: without a line it was 1, with Cv = 2.",
            "V p + V/2 (1 - p) = 1.",
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
        shows=peak_of_die(
            angle_deg=lambda m: _widest(m, LAWS["modified sine"]), law="modified sine"
        ),
        right="Each law has its own widest angle: one that sets off gently may set off earlier.",
        slips=(
            Slip(
                lambda m: _overlapped(m, "modified sine", of="cycloidal"),
                "This takes the cycloid's widest angle. The modified sine is at the limit at "
                "another x, so it has an angle of its own.",
            ),
            Slip(
                lambda m: _overlapped(m, "cycloidal", of="modified sine"),
                "The angle is that of the modified sine, but the peak that of the cycloid: take Ca "
                "of the same law.",
            ),
            Slip(
                lambda m: _overlapped(m, "cycloidal"),
                "This is the cycloid, as in notebook 03. Take the modified sine, for the angle and "
                "for the peak.",
            ),
            Slip(
                lambda m: _overlapped(m, "modified trapezoid"),
                "This is the modified trapezoid. The modified sine is asked for.",
            ),
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
            Slip(
                lambda m: _overlapped(m, "modified sine") * m.die_mass_kg,
                "This is the force, mass times acceleration. The acceleration is asked for.",
            ),
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
        right="It passes every test, and that is the only reason to believe it.",
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
        "The constant acceleration has 2.645 and jumps, so it is above that. Many hope for half "
        "the peak or less. But whatever the law, the die has to make the same way in the same "
        "time.",
    ),
    Prediction(
        "05.widest",
        "gently or quickly",
        "gently",
        "So it is one that starts gently. A quick start sounds like a head start. But what is "
        "asked for is a long move, and the quick one is 19 mm deep too soon.",
    ),
)
