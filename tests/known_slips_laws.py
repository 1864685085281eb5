"""Lessons 05 and 06 by hand: right answers, and wrong ones that a student could give.

Nothing here knows of the package's laws or of the slips that it recognises.
"""

import math
from collections.abc import Callable
from functools import cache

import numpy as np
import sympy
from known_slips import (
    G,
    KnownSlip,
    die,
    later,
    lessons,
    peak,
    place,
    stroke,
    time,
    told,
    widest,
    with_lessons,
)
from test_laws import FACTORS, TORQUE

from cammotion.teaching.example import MillAndDie

CYCLOID = 2 * math.pi
TRAPEZOID = 8 * math.pi / (2 + math.pi)
SINE = 4 * math.pi**2 / (4 + math.pi)
POLYNOMIAL = 10 / math.sqrt(3)
HARMONIC = math.pi**2 / 2

_X = np.linspace(1 / 8, 1 / 2, 200_001)  # where the modified sine has its largest torque
_TURN = 4 * math.pi / 3 * (_X - 1 / 8)
SINE_TORQUE = float(np.max(SINE**2 / (4 * math.pi) * (1 + 3 * np.sin(_TURN)) * np.cos(_TURN)))

POLYNOMIALS: dict[str, Callable[[float], float]] = {
    "3-4-5 polynomial": lambda x: 10 * x**3 - 15 * x**4 + 6 * x**5,
    "4-5-6-7 polynomial": lambda x: 35 * x**4 - 84 * x**5 + 70 * x**6 - 20 * x**7,
}
p, r = sympy.symbols("p r")


def hard(m: MillAndDie, angle: float, factor: float, way: float | None = None) -> float:
    """Return the peak acceleration in m/s² of a law with this factor."""
    return factor * (way or stroke(m)) / 1000 / time(m, angle) ** 2


def percent_less(one: float, other: float) -> float:
    """Return by how many percent one is smaller than the other."""
    return 100 * (1 - one / other)


@cache
def gentle(m: MillAndDie) -> float:
    """Return Ca of the law of 05.2 with the smaller peak."""
    return FACTORS[m.laws.compared[0]][1]


@cache
def harsh(m: MillAndDie) -> float:
    """Return Ca of the law of 05.2 with the larger peak."""
    return FACTORS[m.laws.compared[1]][1]


def jerk_more(m: MillAndDie) -> float:
    """Return by how many percent the first law's jerk is larger."""
    one, other = (FACTORS[name][2] for name in m.laws.compared)
    return 100 * (one / other - 1)


def jerk_less(m: MillAndDie) -> float:
    """Return by how many percent it would be smaller, which is below 0."""
    one, other = (FACTORS[name][2] for name in m.laws.compared)
    return 100 * (1 - one / other)


def velocity_less(m: MillAndDie) -> float:
    """Return by how many percent the first law's largest velocity is smaller."""
    one, other = (FACTORS[name][0] for name in m.laws.compared)
    return percent_less(one, other)


def torque_less(m: MillAndDie) -> float:
    """Return by how many percent its largest torque at an even drive is smaller."""
    return percent_less(*(TORQUE[name] for name in m.laws.compared))


def in_whole_degrees(m: MillAndDie) -> float:
    """Return the answer to 05.3 rounded up, NaN where that is how it is rounded anyway."""
    right = die(m) * math.sqrt(harsh(m) / gentle(m))
    return math.floor(right) + 1 if right % 1 < 0.5 else math.nan


def unless(m: MillAndDie, law: str, value: float) -> float:
    """Return what a mistake leads to; where the question is about that law there is none."""
    return math.nan if law in m.laws.compared else value


def of_another_law(law: str, said: str) -> KnownSlip:
    """Take another law than the first one of 05.2; where there is no slip the answer is NaN."""
    return KnownSlip(
        "05.2",
        law,
        lambda m: unless(m, law, percent_less(FACTORS[law][1], harsh(m))),
        f"{said}|finite",
    )


def than_another_law(law: str) -> KnownSlip:
    """Take another law than the second one of 05.2."""
    return KnownSlip(
        "05.2",
        f"than the {law}",
        lambda m: unless(m, law, percent_less(gentle(m), FACTORS[law][1])),
        f"compared with the {law.removesuffix('al')}|finite",
    )


def as_good_as(law: str) -> KnownSlip:
    """Take another law than the one of 05.3 to be as good as."""
    return KnownSlip(
        "05.3",
        law,
        lambda m: unless(m, law, die(m) * math.sqrt(harsh(m) / FACTORS[law][1])),
        f"{law}|finite",
    )


def moved_by(law: str, said: str) -> KnownSlip:
    """Take another law than the one by which the die of 05.3 moves."""
    return KnownSlip(
        "05.3",
        f"moved by the {law}",
        lambda m: unless(m, law, die(m) * math.sqrt(FACTORS[law][1] / gentle(m))),
        f"if it moved by the {said}|finite",
    )


def with_factor_of(law: str) -> KnownSlip:
    """Take Ca of another law in 05.1."""
    return KnownSlip(
        "05.1",
        f"the factor of the {law}",
        lambda m: hard(m, die(m), FACTORS[law][1]),
        f"^This is the peak of the {law}",
    )


def all_of(law: str) -> KnownSlip:
    """Take a polynomial in 05.5, for the angle and for the peak."""
    return KnownSlip(
        "05.5",
        f"all the {law}'s",
        lambda m: hard(m, later(m) / (1 - deep(m, POLYNOMIALS[law])), FACTORS[law][1]),
        f"^This is the {law}",
    )


def over_the_sines_angle(law: str) -> KnownSlip:
    """Take Ca of another law in 05.5, over the angle of the modified sine."""
    return KnownSlip(
        "05.5",
        f"the {law}'s factor",
        lambda m: hard(m, sine_widest(m), FACTORS[law][1]),
        f"the peak that of the {law}",
    )


def fastest(m: MillAndDie) -> sympy.Rational:
    """Return Cv in 05.4."""
    return sympy.Rational(f"{m.laws.fastest:g}")


def over(m: MillAndDie) -> sympy.Expr:
    """Return what that is divided by."""
    return 1 - p + fastest(m) * p


def pause(m: MillAndDie) -> sympy.Rational:
    """Return the share of the time in 06.2 in which nothing pushes."""
    return sympy.Rational(f"{m.laws.pause:g}")


def ramped(m: MillAndDie, counted: sympy.Expr) -> sympy.Expr:
    """Return Ca in 06.2 if so much of the push is counted."""
    return 2 / (1 + pause(m)) / counted


def pushed(m: MillAndDie) -> sympy.Expr:
    """Return how long the push lasts there."""
    return sympy.Rational(1, 2) - pause(m) / 2


def sine(x: float) -> float:
    """Return the share of the stroke by the modified sine, from its acceleration in three parts."""
    k = 4 * math.pi
    scale = SINE / k
    if x > 1 / 2:
        return 1 - sine(1 - x)
    if x <= 1 / 8:
        return scale * (x - math.sin(k * x) / k)
    u = k / 3 * (x - 1 / 8)
    s_1 = scale * (1 / 8 - 1 / k)
    return s_1 + scale * (x - 1 / 8) + 9 * scale / k * (1 - math.cos(u))


def trapezoid(x: float) -> float:
    """Return the share of the stroke by the modified trapezoid, added up in small steps."""
    y = np.linspace(0, 1, 4001)
    phase = np.minimum(np.mod(y, 1 / 2), 1 / 2 - np.mod(y, 1 / 2))
    a = np.where(phase < 1 / 8, np.sin(4 * math.pi * np.minimum(phase, 1 / 8)), 1)
    a = TRAPEZOID * np.where(y < 1 / 2, a, -a)
    v = np.concatenate([[0], np.cumsum((a[1:] + a[:-1]) / 2)]) / 4000
    s = np.concatenate([[0], np.cumsum((v[1:] + v[:-1]) / 2)]) / 4000
    return float(np.interp(x, y, s))


@cache
def deep(m: MillAndDie, curve: Callable[[float], float], margin: float = -1) -> float:
    """Return x at which the die is as deep as it may be by a law."""
    return place((m.wait_mm + margin * m.margin_mm) / stroke(m), curve)


@cache
def sine_widest(m: MillAndDie) -> float:
    """Return the widest angle of the die by the modified sine."""
    return later(m) / (1 - deep(m, sine))


def sine_peak(m: MillAndDie) -> float:
    """Return the peak of the die by the modified sine over its widest angle."""
    return hard(m, sine_widest(m), SINE)


@cache
def deep_share(m: MillAndDie) -> float:
    """Return which share of its stroke the die may be deep."""
    return (m.wait_mm - m.margin_mm) / stroke(m)


def up(m: MillAndDie) -> float:
    """Return how far the die has to be up in 06.3, in mm."""
    return stroke(m) - m.wait_mm + m.margin_mm


def half_turn(m: MillAndDie) -> float:
    """Return the angle after which the die turns round."""
    return (360 - m.work_deg) / 2


def least(
    m: MillAndDie,
    way: float | None = None,
    angle: float | None = None,
    push: float | None = None,
) -> float:
    """Return how hard the die is pushed in 06.3, in m/s², for so many degrees."""
    push, at = time(m, push or half_turn(m) / 2), time(m, angle or later(m))
    if at <= push:
        per_unit = at**2 / 2
    else:
        rest = at - push
        per_unit = push**2 / 2 + push * rest - rest**2 / 2
    return (way or up(m)) / 1000 / per_unit


def not_braked(m: MillAndDie) -> float:
    """Push in the first half, and let the die go on as fast as it is."""
    push, at = time(m, half_turn(m)) / 2, time(m, later(m))
    return up(m) / 1000 / (push**2 / 2 + push * (at - push))


def stopped_between(m: MillAndDie) -> float:
    """Forget the speed that the die has when it begins to be braked."""
    push, at = time(m, half_turn(m)) / 2, time(m, later(m))
    return up(m) / 1000 / (push**2 / 2 - max(at - push, 0) ** 2 / 2)


def braked_twice(m: MillAndDie) -> float:
    """Take a time squared, and not half of it, for the way that the brake takes; NaN before it."""
    push, at = time(m, half_turn(m)) / 2, time(m, later(m))
    way = push**2 / 2 + push * (at - push) - (at - push) ** 2
    return up(m) / 1000 / way if at > push else math.nan


def braked_too_early(m: MillAndDie) -> float:
    """Take away the way of the brake, whether it has begun or not: where it has, this is right."""
    push, at = time(m, half_turn(m)) / 2, time(m, later(m))
    return up(m) / 1000 / (at**2 / 2 - (at - push) ** 2)


def times_least(m: MillAndDie) -> float:
    """Return how many times the least possible peak the cycloid's is."""
    return peak(m, told(m)) / least(m)


def servo(m: MillAndDie, motor_kg: float, die_kg: float | None = None, a: float = 0.6) -> float:
    """Return the force for die and motor in N, the motor counted as so many kg."""
    return ((m.die_mass_kg if die_kg is None else die_kg) + motor_kg) * a


def to_rest(start: float) -> float:
    """Return the even push, and brake, from a velocity to rest, over a way and a time of 1.

    The brake begins at the share u of the time: start + a u = a (1 - u), and the way of both
    is 1. So with w = 1 - u it is start (1 - w) + a (1 - w)²/2 + a w²/2 = 1,
    a = start/(2 w - 1).
    """
    low, high = 0.5 + 1e-12, 1.0
    for _ in range(80):
        w = (low + high) / 2
        a = start / (2 * w - 1)
        way = start * (1 - w) + a * ((1 - w) ** 2 + w**2) / 2
        low, high = (w, high) if way > 1 else (low, w)
    return start / (2 * low - 1) if start else 4.0


SCREW = 2 * math.pi / 0.01  # how far the screw turns, in rad for a metre
MOTOR_KG = 1e-4 * SCREW**2

RIGHT: dict[str, Callable[[MillAndDie], float]] = {
    "05.1": lambda m: hard(m, die(m), 4),
    "05.2": lambda m: percent_less(gentle(m), harsh(m)),
    "05.3": lambda m: die(m) * math.sqrt(harsh(m) / gentle(m)),
    "05.5": sine_peak,
    "06.1": lambda m: 2 * (1 - m.laws.head_start),
    "06.3": least,
    "06.4": times_least,
    "06.5": lambda m: servo(m, MOTOR_KG),
}
"""The right numbers; test_exercises_laws.py integrates for those of notebook 06."""

SOURCE = {
    "05.1": 2.64463,
    "05.2": 22.203,
    "05.3": 62.357,
    "05.5": 0.73028,
    "06.1": 2,
    "06.3": 0.51134,
    "06.4": 1.57695,
    "06.5": 30.887,
}

SLIPS = [
    # How hard the law of constant acceleration is.
    KnownSlip("05.1", "the factor alone", lambda _: 4, "Ca, which has no unit"),
    KnownSlip("05.1", "the cycloid's factor", lambda m: hard(m, die(m), CYCLOID), "cycloid"),
    with_factor_of("modified sine"),
    with_factor_of("modified trapezoid"),
    *map(with_factor_of, POLYNOMIALS),
    KnownSlip("05.1", "force", lambda m: m.die_mass_kg * hard(m, die(m), 4), "force"),
    KnownSlip("05.1", "the harmonic's", lambda m: hard(m, die(m), HARMONIC), "harmonic|sine|pi"),
    KnownSlip("05.1", "pushed all the way", lambda m: hard(m, die(m), 2), "half"),
    KnownSlip("05.1", "half the time, all the way", lambda m: hard(m, die(m), 8), "twice|half"),
    KnownSlip("05.1", "no halves at all", lambda m: hard(m, die(m), 1), "quarter|half"),
    KnownSlip("05.1", "16: a square too many", lambda m: hard(m, die(m), 16), "half|16"),
    KnownSlip(
        "05.1", "no square", lambda m: 4 * stroke(m) / 1000 / time(m, die(m)), "square|counts twice"
    ),
    KnownSlip("05.1", "velocity", lambda m: 2 * stroke(m) / 1000 / time(m, die(m)), "velocity"),
    KnownSlip(
        "05.1", "mean velocity", lambda m: stroke(m) / 1000 / time(m, die(m)), "velocity|speed"
    ),
    KnownSlip("05.1", "in mm", lambda m: 1000 * hard(m, die(m), 4), "mm"),
    KnownSlip("05.1", "in g", lambda m: hard(m, die(m), 4) / G, r"in g\b"),
    KnownSlip("05.1", "whole turn", lambda m: hard(m, 360, 4), "whole turn"),
    KnownSlip(
        "05.1",
        "both ways' angle",
        lambda m: hard(m, 2 * die(m), 4),
        "quarter|over the time squared",
    ),
    KnownSlip("05.1", "per minute", lambda m: 3600 * hard(m, die(m), 4), "minute"),
    KnownSlip("05.1", "the mill", lambda m: hard(m, m.mill_angle_deg, 4, m.pitch_mm), "mill"),
    KnownSlip("05.1", "angle in radians", lambda m: hard(m, math.radians(die(m)), 4), "radian"),
    # By how many percent the peak of one law is smaller than that of another.
    KnownSlip(
        "05.2", "of the smaller", lambda m: 100 * (harsh(m) / gentle(m) - 1), "Compare with the"
    ),
    KnownSlip("05.2", "as a share", lambda m: 1 - gentle(m) / harsh(m), "share|percent|100"),
    KnownSlip("05.2", "what is left", lambda m: 100 * gentle(m) / harsh(m), "are left"),
    KnownSlip("05.2", "ratio", lambda m: gentle(m) / harsh(m), "what is left"),
    KnownSlip("05.2", "ratio upside down", lambda m: harsh(m) / gentle(m), "ratio|times|percent"),
    KnownSlip(
        "05.2",
        "upside down, in percent",
        lambda m: 100 * harsh(m) / gentle(m),
        "percent of the smaller peak is",
    ),
    KnownSlip(
        "05.2",
        "of the smaller, as a share",
        lambda m: harsh(m) / gentle(m) - 1,
        "share of the smaller peak",
    ),
    KnownSlip("05.2", "difference", lambda m: harsh(m) - gentle(m), "difference"),
    of_another_law("modified trapezoid", "modified trapezoid"),
    of_another_law("modified sine", "modified sine"),
    of_another_law("3-4-5 polynomial", "polynomial|3-4-5"),
    of_another_law("constant acceleration", "constant|jump"),
    of_another_law("simple harmonic", "harmonic|jump"),
    KnownSlip("05.2", "negative", lambda m: -percent_less(gentle(m), harsh(m)), "sign"),
    than_another_law("modified sine"),
    than_another_law("cycloidal"),
    KnownSlip("05.2", "the lesson's", lessons(22), "machine of the lesson"),
    KnownSlip("05.2", "the jerk", jerk_more, "jerk"),
    KnownSlip("05.2", "the jerk, turned round", jerk_less, "jerk"),
    KnownSlip("05.2", "the velocity", velocity_less, "with Cv"),
    KnownSlip("05.2", "the torque", torque_less, "with Cq"),
    # How many degrees the harsher law needs.
    KnownSlip("05.3", "no root", lambda m: die(m) * harsh(m) / gentle(m), "root|square"),
    KnownSlip(
        "05.3",
        "upside down",
        lambda m: die(m) * math.sqrt(gentle(m) / harsh(m)),
        "more of them",
    ),
    KnownSlip(
        "05.3", "upside down, no root", lambda m: die(m) * gentle(m) / harsh(m), "fewer degrees"
    ),
    KnownSlip("05.3", "rounded up", in_whole_degrees, "rounded up|finite"),
    KnownSlip("05.3", "squared", lambda m: die(m) * (harsh(m) / gentle(m)) ** 2, "root"),
    KnownSlip(
        "05.3",
        "how many more",
        lambda m: die(m) * (math.sqrt(harsh(m) / gentle(m)) - 1),
        "in addition",
    ),
    KnownSlip(
        "05.3",
        "factor",
        lambda m: math.sqrt(harsh(m) / gentle(m)),
        "factor|ratio|how many times",
    ),
    KnownSlip(
        "05.3",
        "the percent of 05.2 added",
        lambda m: die(m) * (2 - gentle(m) / harsh(m)),
        "percent|square|root",
    ),
    KnownSlip(
        "05.3",
        "half the percent added",
        lambda m: die(m) * (1 + percent_less(gentle(m), harsh(m)) / 200),
        "percent",
    ),
    KnownSlip(
        "05.3",
        "half of how much more added",
        lambda m: die(m) * (harsh(m) / gentle(m) + 1) / 2,
        "Half of the percentage",
    ),
    KnownSlip(
        "05.3",
        "divided by half the percent less",
        lambda m: die(m) / (1 - percent_less(gentle(m), harsh(m)) / 200),
        "Half of the percentage",
    ),
    as_good_as("modified sine"),
    as_good_as("modified trapezoid"),
    as_good_as("constant acceleration"),
    moved_by("cycloidal", "cycloid"),
    moved_by("modified sine", "modified sine"),
    moved_by("modified trapezoid", "modified trapezoid"),
    moved_by("3-4-5 polynomial", "3-4-5"),
    moved_by("4-5-6-7 polynomial", "4-5-6-7"),
    KnownSlip("05.3", "both ways", lambda m: 2 * die(m) * math.sqrt(harsh(m) / gentle(m)), "twice"),
    KnownSlip("05.3", "the same", die, "larger peak"),
    KnownSlip(
        "05.3", "third root", lambda m: die(m) * (harsh(m) / gentle(m)) ** (1 / 3), "jerk|root"
    ),
    # The velocity factor with a straight line in the middle.
    KnownSlip("05.4", "way not shared", lambda m: fastest(m) / (1 - p), "slower, not faster"),
    KnownSlip("05.4", "time not shared", lambda m: fastest(m) / (1 + fastest(m) * p), "time"),
    KnownSlip(
        "05.4", "upside down", lambda m: over(m) / fastest(m), "upside|turned over|faster than"
    ),
    KnownSlip("05.4", "times 1 + p", lambda m: fastest(m) * (1 + p), "slower|upside"),
    KnownSlip("05.4", "times 1 - p", lambda m: fastest(m) * (1 - p), "p = 1"),
    KnownSlip(
        "05.4",
        "mixed by time",
        lambda m: fastest(m) * (1 - p) + p,
        "straight line between",
    ),
    KnownSlip("05.4", "half", lambda m: fastest(m) / over(m) / 2, "half"),
    KnownSlip("05.4", "unchanged", fastest, "depend|without the line|p = "),
    KnownSlip("05.4", "line takes all", lambda _: 1 / p, "two ends"),
    KnownSlip("05.4", "squared", lambda m: fastest(m) / over(m) ** 2, "squared|once"),
    KnownSlip(
        "05.4", "p in percent", lambda m: fastest(m) / over(m).subs(p, p / 100), "percent|share"
    ),
    KnownSlip("05.4", "the cycloid", lambda _: 2 / (1 + p), "Cv = 2"),
    KnownSlip("05.4", "half the cycloid", lambda m: fastest(m) / (1 + p), "Cv = 2"),
    KnownSlip("05.4", "ends as fast", lambda m: 1 / (p + fastest(m) * (1 - p)), "ends are slower"),
    KnownSlip("05.4", "share of the way", lambda m: (1 - p) / over(m), "way|stroke"),
    KnownSlip(
        "05.4", "a line's share of the way", lambda m: fastest(m) * p / over(m), "way|stroke"
    ),
    KnownSlip("05.4", "a line through all", lambda _: sympy.Integer(1), "depend|alone|p = "),
    # The overlap by the modified sine.
    KnownSlip(
        "05.5", "the cycloid's factor", lambda m: hard(m, sine_widest(m), CYCLOID), "same law"
    ),
    KnownSlip(
        "05.5", "the cycloid's angle", lambda m: hard(m, widest(m), SINE), "angle of its own"
    ),
    KnownSlip(
        "05.5",
        "the trapezoid's factor",
        lambda m: hard(m, sine_widest(m), TRAPEZOID),
        "trapezoid: take Ca of the same",
    ),
    KnownSlip("05.5", "the velocity's", lambda m: hard(m, sine_widest(m), SINE / math.pi), "Cv"),
    KnownSlip("05.5", "the torque's", lambda m: hard(m, sine_widest(m), SINE_TORQUE), "Cq"),
    KnownSlip("05.5", "all the cycloid's", lambda m: peak(m, widest(m)), "cycloid"),
    KnownSlip("05.5", "no overlap", lambda m: hard(m, die(m), SINE), "without overlap"),
    KnownSlip("05.5", "quiet ends alone", lambda m: hard(m, later(m), SINE), "wider"),
    KnownSlip(
        "05.5",
        "no margin",
        lambda m: hard(m, later(m) / (1 - deep(m, sine, 0)), SINE),
        "margin",
    ),
    KnownSlip(
        "05.5",
        "share for x",
        lambda m: hard(m, later(m) / (1 - deep_share(m)), SINE),
        "share|inverse",
    ),
    KnownSlip(
        "05.5", "by x", lambda m: hard(m, later(m) / deep(m, sine), SINE), "1 - x|still to|rest"
    ),
    KnownSlip(
        "05.5",
        "times 1 - x",
        lambda m: hard(m, later(m) * (1 - deep(m, sine)), SINE),
        "wider|larger|multipl",
    ),
    KnownSlip(
        "05.5",
        "no square",
        lambda m: SINE * stroke(m) / 1000 / time(m, sine_widest(m)),
        "square",
    ),
    KnownSlip(
        "05.5",
        "velocity",
        lambda m: SINE / math.pi * stroke(m) / 1000 / time(m, sine_widest(m)),
        "velocity",
    ),
    KnownSlip(
        "05.5",
        "modified trapezoid",
        lambda m: hard(m, later(m) / (1 - deep(m, trapezoid)), TRAPEZOID),
        "trapezoid",
    ),
    *map(all_of, POLYNOMIALS),
    *map(over_the_sines_angle, POLYNOMIALS),
    KnownSlip(
        "05.5",
        "the lesson's 19 mm",
        with_lessons(lambda m: hard(m, later(m) / (1 - place(19 / stroke(m), sine)), SINE)),
        "a number of the lesson|finite",
    ),
    KnownSlip(
        "05.5",
        "the lesson's 70 degrees",
        with_lessons(lambda m: hard(m, 70 / (1 - deep(m, sine)), SINE)),
        "a number of the lesson|finite",
    ),
    KnownSlip("05.5", "in mm", lambda m: 1000 * sine_peak(m), "mm"),
    KnownSlip("05.5", "in g", lambda m: sine_peak(m) / G, r"in g\b"),
    KnownSlip("05.5", "force", lambda m: m.die_mass_kg * sine_peak(m), "force"),
    KnownSlip(
        "05.5",
        "the way up to there",
        lambda m: hard(m, sine_widest(m), SINE, m.wait_mm - m.margin_mm),
        "stroke",
    ),
    KnownSlip(
        "05.5",
        "no quiet end",
        lambda m: hard(m, die(m) / (1 - deep(m, sine)), SINE),
        "quiet",
    ),
    # The least factor of a hammer.
    KnownSlip("06.1", "at rest at both ends", lambda _: 4.0, "rest|brak|arrive"),
    KnownSlip(
        "06.1",
        "has to stop",
        lambda m: to_rest(m.laws.head_start),
        "This is for a hammer that has to|rest to rest",
    ),
    KnownSlip("06.1", "half from the weight", lambda m: 4 - 2 * m.laws.head_start, "weight 1 - x"),
    KnownSlip("06.1", "half forgotten", lambda m: 1 - m.laws.head_start, "half"),
    KnownSlip("06.1", "half upside down", lambda _: 0.5, "divided by|upside"),
    KnownSlip(
        "06.1", "all of it upside down", lambda m: (1 - m.laws.head_start) / 2, "quarter|divided"
    ),
    KnownSlip("06.1", "from rest", lambda _: 2.0, "from rest"),
    KnownSlip("06.1", "against it", lambda m: 2 + 2 * m.laws.head_start, "against|helps"),
    KnownSlip("06.1", "taken away once", lambda m: 2 - m.laws.head_start, "once"),
    KnownSlip("06.1", "the cycloid", lambda _: CYCLOID, "cycloid"),
    KnownSlip(
        "06.1", "the cycloid for the rest", lambda m: CYCLOID * (1 - m.laws.head_start), "cycloid"
    ),
    KnownSlip("06.1", "half the cycloid", lambda _: math.pi, "cycloid"),
    KnownSlip("06.1", "none", lambda _: 0.0, "does not arrive"),
    KnownSlip(
        "06.1",
        "half the harmonic",
        lambda m: math.pi**2 / 4 * (1 - m.laws.head_start),
        "cosine|sine|not all the time|only at",
    ),
    KnownSlip("06.1", "the harmonic", lambda _: HARMONIC, "harmonic|at rest"),
    KnownSlip("06.1", "in the square of half", lambda m: 8 * (1 - m.laws.head_start), "half|four"),
    KnownSlip(
        "06.1", "a cubic", lambda m: 6 * (1 - m.laws.head_start), "all the time|at once|jump"
    ),
    KnownSlip("06.1", "modified trapezoid", lambda _: TRAPEZOID, "trapezoid"),
    KnownSlip("06.1", "free fall", lambda _: G, "gravity|fall"),
    # The trapezoid of straight lines.
    KnownSlip("06.2", "one ramp", lambda m: ramped(m, pushed(m) - r / 2), "ramp"),
    KnownSlip(
        "06.2",
        "area of the flat part",
        lambda m: ramped(m, pushed(m) - 2 * r),
        "ramp|line|flat|triang",
    ),
    KnownSlip("06.2", "mean velocity", lambda m: ramped(m, 2 * (pushed(m) - r)), "half|velocity"),
    KnownSlip("06.2", "twice", lambda m: ramped(m, (pushed(m) - r) / 2), "twice"),
    KnownSlip(
        "06.2",
        "upside down",
        lambda m: ramped(m, pushed(m)) * (1 - r / pushed(m)),
        "upside|larger peak|higher|ramps cost",
    ),
    KnownSlip(
        "06.2",
        "sign",
        lambda m: ramped(m, pushed(m) + r),
        "sign|larger|higher|ramps cost",
    ),
    KnownSlip(
        "06.2",
        "half of the time",
        lambda m: ramped(m, sympy.Rational(1, 2) - r),
        "pause",
    ),
    KnownSlip("06.2", "no ramps", lambda m: ramped(m, pushed(m)), "depend|r = 0|without ramps"),
    KnownSlip("06.2", "no pause", lambda _: 4 / (1 - 2 * r), "pause"),
    KnownSlip("06.2", "2 in the middle", lambda m: 2 / (pushed(m) - r), "pause"),
    KnownSlip("06.2", "velocity factor", lambda m: 2 / (1 + pause(m)), "velocity"),
    KnownSlip("06.2", "jerk", lambda m: ramped(m, r * (pushed(m) - r)), "jerk"),
    KnownSlip(
        "06.2",
        "sines for lines",
        lambda m: ramped(m, pushed(m) - 2 * r + 4 * r / sympy.pi),
        "sine|line|area",
    ),
    KnownSlip(
        "06.2",
        "a straight guess",
        lambda m: ramped(m, pushed(m)) * (1 + 2 * r / pushed(m)),
        "ends|r = |straight|between",
    ),
    KnownSlip("06.2", "a triangle", lambda m: ramped(m, pushed(m) / 2), "triang|r = 1/4"),
    KnownSlip("06.2", "all of the time", lambda m: ramped(m, 4 * (pushed(m) - r)), "quarter|half"),
    KnownSlip(
        "06.2",
        "one ramp of both pushes",
        lambda m: ramped(m, 2 * pushed(m) - r),
        "r = 0|half",
    ),
    KnownSlip("06.2", "a text", lambda _: "4/(1 - 2*r)", "quotes"),
    KnownSlip("06.2", "a number", lambda _: 4.76, "no r in it"),
    KnownSlip("06.2", "a round number", lambda _: 5, "no r in it|pause"),
    # The least peak of the die.
    KnownSlip(
        "06.3", "pushed all the way", lambda m: hard(m, later(m), 2, up(m)), "brak|first half|push"
    ),
    KnownSlip(
        "06.3", "rest to rest", lambda m: hard(m, later(m), 4, up(m)), "to rest at that height"
    ),
    KnownSlip(
        "06.3",
        "up only at the turn",
        lambda m: hard(m, half_turn(m), 4, up(m)),
        "turn|too late|by then",
    ),
    KnownSlip(
        "06.3",
        "the stroke at the turn",
        lambda m: hard(m, half_turn(m), 4),
        "stroke",
    ),
    KnownSlip(
        "06.3",
        "the push does all",
        lambda m: hard(m, half_turn(m) / 2, 2, up(m)),
        "end of the push",
    ),
    KnownSlip("06.3", "not braked", not_braked, "brak"),
    KnownSlip("06.3", "speed forgotten", stopped_between, "speed|velocity|fast"),
    KnownSlip("06.3", "braked twice", braked_twice, "without its half|finite"),
    KnownSlip("06.3", "braked too early", braked_too_early, "before it begins"),
    KnownSlip("06.3", "no margin", lambda m: least(m, stroke(m) - m.wait_mm), "margin"),
    KnownSlip("06.3", "the stroke", lambda m: least(m, stroke(m)), "stroke"),
    KnownSlip("06.3", "the depth", lambda m: least(m, m.wait_mm - m.margin_mm), "deep|down|from"),
    KnownSlip("06.3", "without overlap", lambda m: least(m, angle=die(m)), "quiet|overlap"),
    KnownSlip("06.3", "velocity", lambda m: up(m) / 1000 / time(m, later(m)), "velocity"),
    KnownSlip("06.3", "half lost", lambda m: least(m) / 2, "half"),
    KnownSlip("06.3", "in mm", lambda m: 1000 * least(m), "mm"),
    KnownSlip("06.3", "in g", lambda m: least(m) / G, r"in g\b"),
    KnownSlip("06.3", "the cycloid", lambda m: hard(m, widest(m), CYCLOID), "cycloid"),
    KnownSlip("06.3", "default law", lambda m: hard(m, later(m), CYCLOID, up(m)), "cycloid"),
    KnownSlip(
        "06.3",
        "the lesson's degrees",
        with_lessons(lambda m: least(m, angle=70)),
        "number of the lesson|finite",
    ),
    KnownSlip(
        "06.3",
        "the lesson's push",
        with_lessons(lambda m: least(m, push=65)),
        "number of the lesson|finite",
    ),
    KnownSlip("06.3", "the lesson's height", lambda m: least(m, 31), "lesson|finite"),
    KnownSlip("06.3", "in mm/deg²", lambda m: 1000 * least(m) * time(m, 1) ** 2, "mm/deg²"),
    KnownSlip("06.3", "time not squared", lambda m: least(m) * time(m, 1), "squared"),
    KnownSlip("06.3", "per minute", lambda m: 3600 * least(m), "minute"),
    KnownSlip("06.3", "braked upwards", lambda m: -least(m), "sign"),
    # How far the cycloid is from it.
    KnownSlip("06.4", "upside down", lambda m: 1 / times_least(m), "other way round"),
    KnownSlip("06.4", "how much more", lambda m: times_least(m) - 1, "how much more|times"),
    KnownSlip("06.4", "percent more", lambda m: 100 * (times_least(m) - 1), "percent"),
    KnownSlip("06.4", "percent", lambda m: 100 * times_least(m), "percent|hundred"),
    KnownSlip("06.4", "the peak", lambda m: peak(m, told(m)), "peak, in m"),
    KnownSlip("06.4", "difference", lambda m: peak(m, told(m)) - least(m), "difference"),
    KnownSlip(
        "06.4", "no overlap", lambda m: peak(m, die(m)) / least(m), "without overlap|no overlap"
    ),
    KnownSlip("06.4", "quiet ends alone", lambda m: peak(m, later(m)) / least(m), "quiet|widest"),
    KnownSlip("06.4", "gain by the overlap", lambda m: (told(m) / die(m)) ** 2, "overlap"),
    KnownSlip(
        "06.4",
        "by the law of constant acceleration",
        lambda m: peak(m, told(m)) / hard(m, told(m), 4),
        "same|factor|constant|angle|right",
    ),
    KnownSlip("06.4", "squared", lambda m: times_least(m) ** 2, "square"),
    KnownSlip("06.4", "root", lambda m: math.sqrt(times_least(m)), "root|square"),
    KnownSlip(
        "06.4",
        "constant over the turn",
        lambda m: peak(m, told(m)) / hard(m, half_turn(m), 4),
        "stroke",
    ),
    KnownSlip(
        "06.4",
        "the lesson's angle",
        with_lessons(lambda m: peak(m, 124.84) / least(m)),
        "number of the lesson|finite",
    ),
    # The force of a servo.
    KnownSlip("06.5", "the die alone", lambda m: servo(m, 0), "motor|alone"),
    KnownSlip("06.5", "lead in mm", lambda m: servo(m, 1e-4 * (2 * math.pi / 10) ** 2), "in mm"),
    KnownSlip("06.5", "no brackets", lambda m: servo(m, 1e-4 * 2 * math.pi / 0.01**2), "2 pi with"),
    KnownSlip("06.5", "the motor alone", lambda m: servo(m, MOTOR_KG, 0), "die|alone"),
    KnownSlip("06.5", "2 pi forgotten", lambda m: servo(m, 1e-4 / 0.01**2), "2 pi|radian"),
    KnownSlip("06.5", "not squared", lambda m: servo(m, 1e-4 * SCREW), "square"),
    KnownSlip(
        "06.5",
        "lead in cm",
        lambda m: servo(m, 1e-4 * (2 * math.pi) ** 2),
        "in cm",
    ),
    KnownSlip("06.5", "inertia as a mass", lambda m: servo(m, 1e-4), "added to the kg"),
    KnownSlip("06.5", "upside down", lambda m: servo(m, 1e-4 / SCREW**2), "motor's inertia"),
    KnownSlip("06.5", "lead for a radius", lambda m: servo(m, 1e-4 / 0.005**2), "radius"),
    KnownSlip("06.5", "pi for 2 pi", lambda m: servo(m, MOTOR_KG / 4), "2 pi"),
    KnownSlip("06.5", "half of J", lambda m: servo(m, MOTOR_KG / 2), "[Hh]alf of the inertia"),
    KnownSlip("06.5", "the mass", lambda m: m.die_mass_kg + MOTOR_KG, "the mass"),
    KnownSlip("06.5", "the torque", lambda m: servo(m, MOTOR_KG) / SCREW, "torque|lever"),
    KnownSlip("06.5", "in N mm", lambda m: 1000 * servo(m, MOTOR_KG) / SCREW, "in N mm"),
    KnownSlip("06.5", "the motor's mass", lambda _: MOTOR_KG, "kg at the die"),
    KnownSlip("06.5", "in degrees", lambda m: servo(m, 1e-4 * (360 / 0.01) ** 2), "in degrees"),
    KnownSlip(
        "06.5",
        "weight added",
        lambda m: servo(m, MOTOR_KG) + m.die_mass_kg * G,
        "weight",
    ),
    KnownSlip("06.5", "subtracted", lambda m: abs(servo(m, -MOTOR_KG)), "add|both|subtract|minus"),
    KnownSlip("06.5", "in kN", lambda m: servo(m, MOTOR_KG) / 1000, "kN"),
    KnownSlip("06.5", "in g", lambda m: servo(m, MOTOR_KG) * G, "by g|g too"),
    KnownSlip(
        "06.5", "the torque added", lambda m: servo(m, 0) + 1e-4 * 0.6 * SCREW, "torque|square"
    ),
    # The choices, each wrong option.
    KnownSlip("05.6", "a: another constant", lambda _: "a", "end|arrive|come|reach"),
    KnownSlip("05.6", "b: another law", lambda _: "b", "polynomial|not the|another law|peak"),
    KnownSlip("05.6", "c: a square lost", lambda _: "c", "continuous"),
    KnownSlip("05.6", "d: not joined", lambda _: "d", "jump"),
    KnownSlip("05.6", "f: a wrong bound", lambda _: "f", "sign|derivative|slope"),
    KnownSlip("06.6", "a: converged", lambda _: "a", "converge|gap|lower|bound|better|exact"),
    KnownSlip("06.6", "b: finer", lambda _: "b", "bound|below|lower|no motion|never"),
    KnownSlip("06.6", "d: a grid", lambda _: "d", "grid|motion|between|bound"),
]
