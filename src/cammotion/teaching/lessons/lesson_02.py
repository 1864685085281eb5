"""Exercises of notebook 02, how hard the die is pushed."""

import math
from collections.abc import Iterator

import sympy

from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MM_PER_M,
    STANDARD_GRAVITY,
    cycle_time,
    indexing_time,
    peak_acceleration,
    peak_jerk,
    peak_velocity,
)
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Slip
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.shown.ways import peak_of_die

FASTER = 400  # pieces/h more, in 02.4
ANGLE_FACTOR = 1.3  # in 02.5

_t, _h_m, _t_m, _x = sympy.symbols("t h_m t_m x")


def _powers(m: MillAndDie, x: sympy.Expr) -> sympy.Expr:
    """Return the law of 02.2, which rests at both ends whatever its two powers."""
    low, high = m.laws.powers
    return (high * x**low - low * x**high) / (high - low)


def _law(m: MillAndDie, derivative: int = 0, at: sympy.Expr = _t / _t_m) -> sympy.Expr:
    """Return the law of 02.2 differentiated by x, at x = t/t_m or elsewhere."""
    return sympy.diff(_powers(m, _x), _x, derivative).subs(_x, at)


def _in_x(m: MillAndDie) -> str:
    """Return the law of 02.2 as it is written, in brackets unless it is a fraction."""
    low, high = m.laws.powers
    parts, over = (high, low), high - low
    shared = math.gcd(high, low, over)
    first, second = ("" if part == shared else str(part // shared) for part in parts)
    sum_of_both = f"{first}x^{low} - {second}x^{high}"
    over //= shared
    return f"\\frac{{{sum_of_both}}}{{{over}}}" if over > 1 else f"\\left({sum_of_both}\\right)"


def _time(m: MillAndDie) -> float:
    return float(indexing_time(m.die_angle_deg, m.rate_per_hour))


def _peak(m: MillAndDie) -> float:
    return float(peak_acceleration(m.stroke_mm, m.die_angle_deg, m.rate_per_hour))


def _constant(m: MillAndDie) -> float:
    return 4 * m.stroke_mm / MM_PER_M / _time(m) ** 2


def _in_lessons_time(m: MillAndDie) -> Iterator[float]:
    """Yield the peak with the time that the die has in the lesson."""
    yield 2 * math.pi * m.stroke_mm / MM_PER_M / _time(EXAMPLE) ** 2


def _ratio(m: MillAndDie) -> float:
    return (m.rate_per_hour + FASTER) / m.rate_per_hour


def _terms(m: MillAndDie, lower: sympy.Expr = 1, higher: sympy.Expr = 1) -> sympy.Expr:
    """Return the acceleration of 02.2 with each of its two terms so many times."""
    low, high = m.laws.powers
    both = (lower * high * _x**low - higher * low * _x**high) / (high - low)
    return _h_m / _t_m**2 * sympy.diff(both, _x, 2).subs(_x, _t / _t_m)


def _only_the_first_divided(m: MillAndDie) -> sympy.Expr:
    low, high = m.laws.powers
    by = high - low
    return _terms(m, higher=by) if by > 1 else sympy.nan  # by 1 nothing is divided


def _numbers_of_one(m: MillAndDie) -> sympy.Expr:
    """Return the powers of two derivatives with the numbers of the first one."""
    low, high = (sympy.Integer(power) for power in m.laws.powers)
    return _terms(m, 1 / (low - 1), 1 / (high - 1))


_OTHER_LAWS = {
    "simple harmonic": "simple harmonic motion, with pi²/2",
    "modified trapezoid": "modified trapezoid, with 4.888",
    "modified sine": "modified sine, with 5.528",
    "3-4-5 polynomial": "3-4-5 polynomial, with 5.774",
}

_PEAK_SLIPS = (
    Slip(
        lambda m: m.stroke_mm / MM_PER_M / _time(m) ** 2,
        "The factor 2 pi has been lost. The chain rule brings it out when the velocity is "
        "differentiated, and this time nothing cancels it.",
    ),
    Slip(
        lambda m: 2 * math.pi * m.stroke_mm / MM_PER_M / _time(m),
        "The time enters only once here. Acceleration is displacement differentiated "
        "twice: the time has to be squared.",
    ),
    Slip(
        _constant,
        "This is the mean over the first half, or what a constant acceleration would need. "
        "The peak of the sine is higher.",
    ),
    Slip(
        lambda m: 2 * math.pi * m.stroke_mm / MM_PER_M / cycle_time(m.rate_per_hour) ** 2,
        "This is computed with the time of a whole turn. The die has only its indexing "
        "angle for the move.",
    ),
    Slip(
        lambda m: peak_velocity(m.stroke_mm, m.die_angle_deg, m.rate_per_hour),
        "This is the peak velocity, in m/s. Differentiate once more.",
    ),
    Slip(
        lambda m: peak_jerk(m.stroke_mm, m.die_angle_deg, m.rate_per_hour),
        "This is the peak jerk, in m/s³. That was differentiated once too often.",
    ),
    Slip(
        lambda m: peak_acceleration(m.pitch_mm, m.mill_angle_deg, m.rate_per_hour),
        "This is the mill's peak acceleration. The die's is asked for.",
    ),
    Slip(
        lambda m: peak_acceleration(m.pitch_mm, m.die_angle_deg, m.rate_per_hour),
        "This is with the way of the mill. How far does the die go?",
    ),
    Slip(
        lambda m: peak_acceleration(m.stroke_mm, m.mill_angle_deg, m.rate_per_hour),
        "This is with the angle of the mill. Over which does the die move?",
    ),
    Slip(
        lambda m: peak_acceleration(m.stroke_mm, m.work_deg, m.rate_per_hour),
        "This is with the degrees of the work, in which the die does not move.",
    ),
    Slip(
        lambda m: 2 * m.stroke_mm / MM_PER_M / _time(m) ** 2,
        "A constant acceleration would bring it so far in this time, but not to rest: the die has "
        "to be braked as well. And the peak of the sine is higher than a constant one.",
    ),
    Slip(
        lambda m: peak_acceleration(m.stroke_mm, 2 * m.die_angle_deg, m.rate_per_hour),
        "This is computed with twice the angle. The degrees of the question are for one way, down.",
    ),
    Slip(
        lambda m: peak_acceleration(m.stroke_mm, math.radians(m.die_angle_deg), m.rate_per_hour),
        "The angle was made radians. Its part of a turn is degrees out of 360.",
    ),
    Slip(
        lambda m: 2 * math.pi * m.stroke_mm / MM_PER_M / math.radians(m.die_angle_deg) ** 2,
        "The angle stands where the time belongs, in radians. How many seconds does the die have?",
    ),
    Slip(
        lambda m: 2 * math.pi * m.stroke_mm / MM_PER_M / m.die_angle_deg**2,
        "The degrees stand where the time belongs. How many seconds does the die have?",
    ),
    Slip(
        lambda m: 2 * math.pi * m.stroke_mm / MM_PER_M / (m.die_angle_deg / DEG_PER_TURN) ** 2,
        "The part of a turn stands where the time belongs. How many seconds does it take?",
    ),
    Slip(
        lambda m: m.stroke_mm / MM_PER_M / _time(m),
        "This is the mean velocity, in m/s. The acceleration is asked for.",
    ),
    Slip(
        lambda m: 8 * m.stroke_mm / MM_PER_M / _time(m) ** 2,
        "A constant acceleration of this size would go the whole way in half the time, and not "
        "half of it. The cycloid has 2 pi.",
    ),
    *(
        Slip(
            lambda m, law=law: peak_acceleration(  # type: ignore[misc]
                m.stroke_mm, m.die_angle_deg, m.rate_per_hour, law
            ),
            f"This is the {said}. The cycloid has 2 pi.",
        )
        for law, said in _OTHER_LAWS.items()
    ),
    Slip(
        lambda m: 2 * math.pi * m.stroke_mm / MM_PER_M / float(f"{_time(m):.1g}") ** 2,
        "The time was rounded to one digit on the way, and it counts twice. Keep all digits.",
    ),
)


def _of_the_force(slip: Slip) -> Slip:
    """Return what a slip in the acceleration becomes in the force."""
    return Slip(
        lambda m: m.die_mass_kg * slip.leads_to(m),
        f"The acceleration is not right. {slip.reason}",
    )


def _with_g(g: float) -> tuple[Slip, ...]:
    """Return the slips of 02.3 that come of weight, with a `g` in m/s²."""
    return (
        Slip(
            lambda m: m.die_mass_kg * g,
            "This is the weight of the die. It is there when the machine stands still, too.",
        ),
        Slip(
            lambda m: m.die_mass_kg * (_peak(m) + g),
            "Here the weight was added. The force of the inertia alone is asked for.",
        ),
        *(
            Slip(
                lambda m, sign=sign: sign * m.die_mass_kg * (_peak(m) - g),  # type: ignore[misc]
                "Weight and force were taken from each other. The force of the inertia alone is "
                "asked for.",
            )
            for sign in (1, -1)
        ),
        Slip(
            lambda m: m.die_mass_kg * _peak(m) / g,
            "This is in kilograms of weight, divided by g. Newtons are asked for.",
        ),
        Slip(
            lambda m: m.die_mass_kg * _peak(m) * g,
            "This was multiplied by g. Kilograms times m/s² already are newtons.",
        ),
    )


EXERCISES = (
    NumberExercise(
        number="02.1",
        question=lambda m: (
            f"The die goes {m.stroke_mm:g} mm down over {m.die_angle_deg:g} degrees, by the "
            f"cycloidal law, at {m.rate_per_hour:g} pieces per hour. What is its peak "
            "acceleration?"
        ),
        unit="m/s²",
        is_product=True,
        answer=_peak,
        mixed=_in_lessons_time,
        shows=peak_of_die(),
        right="Times the mass of the die this is the force its inertia asks for, twice a move.",
        slips=_PEAK_SLIPS,
        hints=(
            "You need the indexing time first: which part of a turn does the die have?",
            "For the cycloidal law the peak is 2 pi times the stroke over the time squared.",
            "Put the stroke in as metres and the time in seconds, 10 Bm/N.",
        ),
    ),
    ExpressionExercise(
        number="02.2",
        question=lambda m: (
            f"Another motion law: $h = h_m {_in_x(m)}$ with $x = t/t_m$. Derive its acceleration "
            "$a$ as an expression in the symbols `t`, `h_m` and `t_m`, or as a function of these "
            "three."
        ),
        variables=("t", "h_m", "t_m"),
        along="t",
        until="t_m",
        stands_for={"x": "t/t_m"},
        answer=lambda m: _h_m / _t_m**2 * _law(m, 2),
        right=(
            "It ends with a jump, from its hardest braking to nothing; a law with a square in it "
            "begins with one too. Notebook 05 shows what a jump in the acceleration does."
        ),
        slips=(
            Slip(
                lambda m: _h_m * _law(m, 2),
                "The chain rule is missing: each derivative by t brings out a factor 1/t_m.",
            ),
            Slip(
                lambda m: _h_m / _t_m * _law(m, 2),
                "The chain rule was used once only. Each of the two derivatives brings out a "
                "factor 1/t_m.",
            ),
            Slip(
                lambda m: _h_m / _t_m * _law(m, 1),
                "This is the velocity. Differentiate once more.",
            ),
            Slip(
                lambda m: _h_m * _law(m),
                "This is the displacement itself. Differentiate it twice.",
            ),
            Slip(
                lambda m: _h_m / _t_m**3 * _law(m, 3),
                "This is the jerk: differentiated once too often.",
            ),
            Slip(
                lambda m: _h_m / _t_m**2 * _law(m, 2, at=_t),
                "In the bracket t stands where x does: put in x = t/t_m there, too.",
            ),
            Slip(
                lambda m: _h_m / _t_m * _law(m, 2, at=_t),
                "In a power of x all of it is taken to that power: x³ is t³/t_m³, not t³/t_m.",
            ),
            Slip(
                _only_the_first_divided,
                "What stands below the bracket divides both of its terms, not the first alone.",
            ),
            Slip(
                lambda m: _terms(m, higher=0),
                "The term with the higher power is missing. Each of the two has a second "
                "derivative.",
            ),
            Slip(
                lambda m: _terms(m, lower=0),
                "The term with the lower power is missing. Each of the two has a second "
                "derivative.",
            ),
            Slip(
                lambda m: _terms(m, higher=-1),
                "The minus between the two terms has become a plus. Differentiating leaves it as "
                "it is.",
            ),
            Slip(
                _numbers_of_one,
                "The powers are those of two derivatives, the numbers those of one. Each of the "
                "two brings the power down as a factor.",
            ),
            Slip(
                lambda m: _h_m / _t_m**2 * _law(m, 1),
                "This is the first derivative of the law, with the square of the time below it. "
                "Differentiate once more.",
            ),
            Slip(
                lambda m: _h_m / _t_m**2 * _t / _t_m * _law(m, 2),
                "The numbers are those of two derivatives, the powers those of one. Each of the "
                "two takes one from the power.",
            ),
            Slip(
                lambda m: _law(m, 2) / _t_m**2,
                "The stroke is missing: h_m is a constant factor, and stays one when you "
                "differentiate.",
            ),
            Slip(
                lambda m: _law(m, 2),
                "This is the second derivative by x. In a the stroke is a factor, and each of the "
                "two derivatives by t brings out 1/t_m.",
            ),
            Slip(
                lambda m: _h_m / _t_m**2 * _law(m, 2, at=sympy.Integer(0)),
                "This is the acceleration at the start alone. What is asked for changes with t.",
            ),
            Slip(
                lambda m: _h_m / _t_m**2 * _law(m, 2, at=sympy.Integer(1)),
                "This is the acceleration at the end alone. What is asked for changes with t.",
            ),
            Slip(
                lambda m: 2 * sympy.pi * _h_m / _t_m**2 * sympy.sin(2 * sympy.pi * _t / _t_m),
                "This is the acceleration of the cycloid. Here the law is another one, without a "
                "sine.",
            ),
        ),
        hints=(
            "Put x = t/t_m into the law first, and differentiate by t.",
            "The velocity is h_m/t_m times the first derivative of the law by x. Once more the "
            "same way.",
            "Each derivative by t brings out 1/t_m. What is left is the second derivative of the "
            "law by x, a power less by one each time.",
        ),
    ),
    NumberExercise(
        number="02.3",
        question=lambda m: (
            f"The die has a mass of {m.die_mass_kg:g} kg and moves as in exercise 02.1. What is "
            "the largest force that its inertia asks for?"
        ),
        unit="N",
        is_product=True,
        answer=lambda m: m.die_mass_kg * _peak(m),
        mixed=lambda m: (m.die_mass_kg * peak for peak in _in_lessons_time(m)),
        goes_on_from={"02.1": lambda m, peak: m.die_mass_kg * peak},
        shows=peak_of_die("With this force", peak=lambda m, force: force / m.die_mass_kg),
        right="The force scales as the acceleration does: what halves the one halves the other.",
        slips=(
            Slip(_peak, "This is the acceleration. A force is mass times acceleration."),
            Slip(
                lambda m: _peak(m) / m.die_mass_kg,
                "The acceleration was divided by the mass. A force is mass times acceleration.",
            ),
            Slip(
                lambda m: m.die_mass_kg / _peak(m),
                "The mass was divided by the acceleration. A force is mass times acceleration.",
            ),
            *_with_g(STANDARD_GRAVITY),
            *_with_g(10),
            *map(_of_the_force, _PEAK_SLIPS),
        ),
        hints=(
            "Newton: force is mass times acceleration.",
            "The largest force comes with the largest acceleration, that of exercise 02.1.",
            "Kilograms times m/s² are newtons; nothing has to be converted.",
        ),
    ),
    NumberExercise(
        number="02.4",
        question=lambda m: (
            f"The machine is to make {m.rate_per_hour + FASTER:g} instead of "
            f"{m.rate_per_hour:g} pieces per hour, with the same cams. By which factor does the "
            "peak acceleration of the die grow?"
        ),
        unit="",
        is_quotient=True,
        answer=lambda m: _ratio(m) ** 2,
        shows=peak_of_die(
            "With this factor",
            peak=lambda m, factor: factor * _peak(m),
            rate_per_hour=lambda m: m.rate_per_hour + FASTER,
        ),
        right="A little more output is paid for twice. Ask for this before you turn up a rate.",
        slips=(
            Slip(
                _ratio,
                "The rate grows by this factor. The time shrinks by it, and it counts twice in the "
                "acceleration.",
            ),
            Slip(
                lambda m: _ratio(m) ** -2,
                "The acceleration would get smaller. A faster machine has less time for the move.",
            ),
            Slip(
                lambda m: math.sqrt(_ratio(m)),
                "This is the root of the ratio of the rates. The peak goes with its square.",
            ),
            Slip(
                lambda m: _ratio(m) - 1,
                "By this share the rate grows. By which factor does it, and the peak?",
            ),
            Slip(
                lambda m: 100 * (_ratio(m) - 1),
                "By so many percent the rate grows. By which factor does it, and the peak?",
            ),
            Slip(
                lambda m: 2 * _ratio(m),
                "This is twice the ratio of the rates. Its square is asked for: the ratio times "
                "itself.",
            ),
            Slip(
                lambda m: 1 / _ratio(m),
                "By this factor the time gets shorter. In the acceleration it stands squared, "
                "below.",
            ),
            Slip(
                lambda m: 2 * _ratio(m) - 1,
                "The growth of the rate was doubled. That is nearly right while it is small; the "
                "factor itself has to be squared.",
            ),
            Slip(
                lambda m: _ratio(m) ** 2 - 1,
                "This is by how much it grows. The factor is asked for: new by old.",
            ),
            Slip(
                lambda m: 100 * (_ratio(m) ** 2 - 1),
                "This is the growth in percent. The factor is asked for: new by old.",
            ),
            Slip(
                lambda m: _ratio(m) ** 3,
                "The third power belongs to the jerk. The acceleration has the second.",
            ),
            Slip(
                lambda _: 1,
                "With the same cams the angle stays, but not the time. What becomes of the time?",
            ),
            Slip(
                lambda _: 2,
                "The 2 is the power: the factor is the ratio of the rates, squared.",
            ),
            Slip(
                lambda _: 4,
                "Four times it would be at twice the rate. How many times the rate is it here?",
            ),
            Slip(_peak, "This is the peak itself. The factor by which it grows is asked for."),
            Slip(
                lambda m: _ratio(m) ** 2 * _peak(m),
                "This is the new peak itself, in m/s². The factor by which it grows is asked for.",
            ),
        ),
        hints=(
            "The cams are the same, so the angle stays. What becomes of the time?",
            "The time is shorter by the ratio of the rates.",
            "In the acceleration the time stands squared, below.",
        ),
    ),
    ChoiceExercise(
        number="02.5",
        question=lambda m: (
            f"You may either halve the die's stroke, or give it {ANGLE_FACTOR:g} times the angle. "
            "Which makes the peak acceleration smaller?"
        ),
        options={
            "a": "half the stroke",
            "b": f"{ANGLE_FACTOR:g} times the angle",
            "c": "both the same",
        },
        answer="a",
        reasons={
            "b": (
                "The angle does count twice, but 1/1.3² is 0.59, and half the stroke gives 0.5. "
                "From 1.42 times the angle on you would be right."
            ),
            "c": "Compare the two factors: 1/2, and 1 over the square of 1.3.",
        },
        right=(
            "Half the stroke gives 0.5, the angle 1/1.3² = 0.59. With the square root of 2, 1.41 "
            "times the angle, they are even."
        ),
        hints=(
            "By which factor does the peak change with the stroke, and by which with the angle?",
            "The stroke enters once. The angle enters squared, below.",
            "Compute 1 over the square of 1.3 and compare it with a half.",
        ),
    ),
)

PREDICTIONS = (
    Prediction(
        "02.fraction",
        "fraction of the time tm",
        0.25,
        "It is tempting to say 0, where the die has to get going, or 0.5, where it is fastest. But "
        "how fast it is says nothing of how hard it is pushed: what counts is how quickly its "
        "velocity changes.",
    ),
    Prediction(
        "02.peak",
        "peak at 110 deg in m/s²",
        1.039,
        "Half of it, 2.08, is a likely guess. In twice the time half the velocity is enough, "
        "and for that half there is twice the time: the time counts twice.",
    ),
    Prediction(
        "02.few",
        "percent less",
        15.97,
        "Five degrees are 9 % of 55, and 9 % is a likely guess. But the angle counts twice: 18 %, "
        "says who doubles the 9, and what is left is (55/60)², which is 16 % less. On "
        "top of 110 degrees the same five take away no more than 8.5 %, and of a smaller peak.",
    ),
)
