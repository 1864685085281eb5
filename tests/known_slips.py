"""Lessons 01 to 04 by hand: right answers, and wrong ones that a student could give.

Each is computed from a machine's numbers. What stands here knows nothing of the package: neither
its laws nor the slips that it recognises. `said` is a pattern of which a fitting reason has to
contain a match. Any file known_slips*.py with RIGHT, SOURCE and SLIPS is found by its name.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any

import sympy

from cammotion.teaching.example import EXAMPLE, MillAndDie

G = 9.80665


@dataclass(frozen=True)
class KnownSlip:
    """A wrong answer to an exercise, how it comes about, and what a fitting reason speaks of."""

    number: str
    name: str
    answer: Callable[[MillAndDie], Any]
    said: str


def lessons(number: float) -> Callable[[MillAndDie], float]:
    """Return a number of the lesson's as a wrong answer; about its own machine it is none."""
    return lambda m: math.nan if m == EXAMPLE else number


def with_lessons(answer: Callable[[MillAndDie], float]) -> Callable[[MillAndDie], float]:
    """Return an answer with a number of the lesson in it; for its own machine it is no slip."""
    return lambda m: math.nan if m == EXAMPLE else answer(m)


def stroke(m: MillAndDie) -> float:
    """Return the stroke of the die in mm."""
    return m.wait_mm + m.pocket_mm - m.gap_mm


def die(m: MillAndDie) -> float:
    """Return the angle of the die without overlap."""
    return (360 - m.mill_angle_deg - m.work_deg) / 2


def later(m: MillAndDie) -> float:
    """Return the angle of the die with the quiet ends of the mill."""
    return (360 - 0.8 * m.mill_angle_deg - m.work_deg) / 2


def turn(m: MillAndDie) -> float:
    """Return the time of a turn in s."""
    return 3600 / m.rate_per_hour


def time(m: MillAndDie, angle: float) -> float:
    """Return the time of an angle in s."""
    return angle / 360 * turn(m)


def peak(m: MillAndDie, angle: float, way: float | None = None, *, per_hour: float = 1) -> float:
    """Return the peak acceleration in m/s²; `per_hour` spoils the rate."""
    return 2 * math.pi * (way or stroke(m)) / 1000 / (time(m, angle) / per_hour) ** 2


def law(x: float) -> float:
    """Return the share of the stroke by the cycloid."""
    return x - math.sin(2 * math.pi * x) / (2 * math.pi)


def law_in_degrees(x: float) -> float:
    """Return the share of the stroke as a calculator shows it that counts in degrees."""
    return x - math.sin(math.radians(2 * math.pi * x)) / (2 * math.pi)


def law_with_plus(x: float) -> float:
    """Return what the cycloid would be with a plus before its sine."""
    return x + math.sin(2 * math.pi * x) / (2 * math.pi)


def law_constant(x: float) -> float:
    """Return the share of the stroke by constant acceleration."""
    return 2 * x**2 if x < 0.5 else 1 - 2 * (1 - x) ** 2


@cache
def place(share: float, curve: Callable[[float], float] = law) -> float:
    """Return x at which a curve reaches a share, by halving."""
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if curve(middle) < share else (low, middle)
    return low


def deep(m: MillAndDie) -> float:
    """Return the share of its stroke at which the die is as deep as it may be."""
    return (m.wait_mm - m.margin_mm) / stroke(m)


def x_deep(m: MillAndDie, margin: float = -1) -> float:
    """Return x at which the die is as deep as it may be; `margin` times the margin comes on top."""
    return place((m.wait_mm + margin * m.margin_mm) / stroke(m))


@cache
def widest(m: MillAndDie) -> float:
    """Return the widest angle of the die."""
    return later(m) / (1 - x_deep(m))


def told(m: MillAndDie) -> float:
    """Return the widest angle as a question prints it."""
    return round(widest(m), 2)


def gain(m: MillAndDie) -> float:
    """Return how many times smaller the peak becomes."""
    return (widest(m) / die(m)) ** 2


def depth_x(m: MillAndDie) -> float:
    """Return which part of its move the die has done 30 degrees before it is down."""
    return 1 - 30 / widest(m)


def faster(m: MillAndDie) -> float:
    """Return the ratio of the rates in 02.4."""
    return (m.rate_per_hour + 400) / m.rate_per_hour


def slower(m: MillAndDie) -> float:
    """Return how many times slower the screen is in 04.2."""
    return 9 / turn(m)


def rest(m: MillAndDie) -> float:
    """Return the degrees in which the overlapped die rests at the top."""
    return 360 - m.work_deg - 2 * told(m)


t, h_m, t_m, x = sympy.symbols("t h_m t_m x")
X = t / t_m


def without_return(t: float, h_m: float, t_m: float) -> None:
    """Forget to return the acceleration."""
    h_m / t_m**2 * (6 - 12 * t / t_m)


def way(m: MillAndDie, y: Any = X) -> Any:
    """Return the share of the stroke by the law of 02.2."""
    p, q = m.laws.powers
    return (q * y**p - p * y**q) / sympy.Integer(q - p)


def speed(m: MillAndDie, y: Any = X) -> Any:
    """Return its slope."""
    p, q = m.laws.powers
    return p * q * (y ** (p - 1) - y ** (q - 1)) / sympy.Integer(q - p)


def push(m: MillAndDie, y: Any = X, parts: tuple[int, int] = (1, 1)) -> Any:
    """Return the slope of that, with or without what each of the two powers has a part in."""
    p, q = m.laws.powers
    low, high = (p - 1) * y ** (p - 2), (q - 1) * y ** (q - 2)
    return p * q * (parts[0] * low - parts[1] * high) / sympy.Integer(q - p)


def numbers_of_one(m: MillAndDie) -> Any:
    """Return the powers of that with the numbers of the slope."""
    p, q = m.laws.powers
    return p * q * (X ** (p - 2) - X ** (q - 2)) / sympy.Integer(q - p)


def jolt(m: MillAndDie) -> Any:
    """Return the slope of that, once more."""
    p, q = m.laws.powers
    first, second = (n * (n - 1) * (n - 2) * X ** (n - 3) for n in (p, q))
    return (q * first - p * second) / sympy.Integer(q - p)


def between_the_ends(m: MillAndDie) -> Any:
    """Return a cosine that has the acceleration's values at both ends."""
    at_start, at_end = push(m, sympy.Integer(0)), push(m, sympy.Integer(1))
    return (at_start + at_end) / 2 + (at_start - at_end) / 2 * sympy.cos(sympy.pi * X)


RIGHT: dict[str, Callable[[MillAndDie], float]] = {
    "01.1": die,
    "01.2": lambda m: time(m, m.work_deg),
    "01.3": lambda m: peak(m, die(m)) / peak(m, m.mill_angle_deg, m.pitch_mm),
    "02.1": lambda m: peak(m, die(m)),
    "02.3": lambda m: m.die_mass_kg * peak(m, die(m)),
    "02.4": lambda m: faster(m) ** 2,
    "03.1": lambda m: m.pitch_mm * law(0.1),
    "03.2": later,
    "03.3": x_deep,
    "03.4": widest,
    "03.5": gain,
    "04.1": lambda m: stroke(m) * law(depth_x(m)),
    "04.2": lambda m: slower(m) ** 2,
    "04.3": lambda m: 1000 * time(m, rest(m)),
}

SOURCE = {
    "01.1": 55,
    "01.2": 0.5,
    "02.1": 4.15417,
    "03.1": 0.6451,
    "03.2": 70,
    "03.3": 0.43927,
    "03.4": 124.84,
    "03.5": 4.15417 / 0.8064,
}
"""Figures that the source itself gives, or that follow from them on paper."""

SLIPS = [
    KnownSlip("01.1", "both ways", lambda m: 360 - m.mill_angle_deg - m.work_deg, "both ways"),
    KnownSlip("01.1", "work forgotten", lambda m: (360 - m.mill_angle_deg) / 2, "work"),
    KnownSlip("01.1", "mill forgotten", lambda m: (360 - m.work_deg) / 2, "mill"),
    KnownSlip("01.1", "in radians", lambda m: math.radians(die(m)), "radian"),
    KnownSlip(
        "01.1", "no brackets", lambda m: 360 - m.mill_angle_deg - m.work_deg / 2, "bracket|both"
    ),
    KnownSlip(
        "01.1",
        "the sum halved",
        lambda m: 360 - (m.mill_angle_deg + m.work_deg) / 2,
        "bracket|both ways",
    ),
    KnownSlip("01.1", "work twice", lambda m: die(m) - m.work_deg / 2, "work was taken away twice"),
    KnownSlip("01.1", "work added", lambda m: die(m) + m.work_deg, "work was added"),
    KnownSlip(
        "01.1",
        "the mill halved",
        lambda m: 360 - m.mill_angle_deg / 2 - m.work_deg,
        "only the mill's degrees",
    ),
    KnownSlip("01.1", "mill and work", lambda m: m.mill_angle_deg + m.work_deg, "mill and work"),
    KnownSlip("01.1", "half of them", lambda m: (m.mill_angle_deg + m.work_deg) / 2, "half of wh"),
    KnownSlip("01.1", "less each other", lambda m: m.mill_angle_deg - m.work_deg, "from the mill"),
    KnownSlip("01.1", "less the mill", lambda m: 360 - m.mill_angle_deg, "what the mill leaves"),
    KnownSlip("01.1", "less the work", lambda m: 360 - m.work_deg, "what the work leaves"),
    KnownSlip("01.1", "the lesson's", lessons(55), "machine of the lesson"),
    KnownSlip("01.1", "turned round", lambda m: -die(m), "sign"),
    KnownSlip("01.1", "share of a turn", lambda m: die(m) / 360, "turn"),
    KnownSlip("01.2", "whole turn", turn, "whole turn"),
    KnownSlip("01.2", "in ms", lambda m: 1000 * time(m, m.work_deg), "millisecond|ms"),
    KnownSlip("01.2", "in minutes", lambda m: time(m, m.work_deg) / 60, "minute"),
    KnownSlip("01.2", "in hours", lambda m: m.work_deg / 360 / m.rate_per_hour, "hour"),
    KnownSlip("01.2", "times degrees", lambda m: m.work_deg * turn(m), "degrees"),
    KnownSlip(
        "01.2",
        "rate upside down",
        lambda m: m.rate_per_hour / 3600 * m.work_deg / 360,
        "upside down",
    ),
    KnownSlip("01.2", "the mill's time", lambda m: time(m, m.mill_angle_deg), "mill"),
    KnownSlip("01.2", "the die's way", lambda m: time(m, die(m)), "each way"),
    KnownSlip(
        "01.2", "with the mill", lambda m: time(m, m.work_deg + m.mill_angle_deg), "together"
    ),
    KnownSlip("01.2", "one degree", lambda m: time(m, 1), "one degree"),
    KnownSlip("01.2", "while not down", lambda m: time(m, 360 - m.work_deg), "not down|rest of"),
    KnownSlip("01.2", "both ways", lambda m: time(m, 2 * die(m)), "both ways"),
    KnownSlip("01.2", "the mill stands", lambda m: time(m, 360 - m.mill_angle_deg), "mill stands"),
    KnownSlip("01.2", "the 10 lost", lambda m: m.work_deg / m.rate_per_hour, "factor 10"),
    KnownSlip(
        "01.3",
        "work forgotten",
        lambda m: peak(m, (360 - m.mill_angle_deg) / 2) / peak(m, m.mill_angle_deg, m.pitch_mm),
        "degrees of its work are not free",
    ),
    KnownSlip(
        "01.3",
        "less one",
        lambda m: peak(m, die(m)) / peak(m, m.mill_angle_deg, m.pitch_mm) - 1,
        "By this share the die's peak is larger",
    ),
    KnownSlip("01.3", "the peak", lambda m: peak(m, die(m)), "die's peak itself"),
    KnownSlip(
        "01.3",
        "the mill's peak",
        lambda m: peak(m, m.mill_angle_deg, m.pitch_mm),
        "mill's peak itself",
    ),
    KnownSlip("01.3", "angles alone", lambda m: m.mill_angle_deg / die(m), "angles alone"),
    KnownSlip(
        "01.3",
        "strokes alone, upside down",
        lambda m: m.pitch_mm / stroke(m),
        "strokes alone, and upside down",
    ),
    KnownSlip(
        "01.3",
        "velocities upside down",
        lambda m: m.pitch_mm / stroke(m) * die(m) / m.mill_angle_deg,
        "velocities, the mill's divided by",
    ),
    KnownSlip(
        "01.3",
        "no square",
        lambda m: stroke(m) / m.pitch_mm * m.mill_angle_deg / die(m),
        "square",
    ),
    KnownSlip("01.3", "no strokes", lambda m: (m.mill_angle_deg / die(m)) ** 2, "strokes"),
    KnownSlip(
        "01.3",
        "mill by die",
        lambda m: m.pitch_mm / stroke(m) * (die(m) / m.mill_angle_deg) ** 2,
        "[Tt]urn it over",
    ),
    KnownSlip(
        "01.3",
        "angles upside down",
        lambda m: stroke(m) / m.pitch_mm * (die(m) / m.mill_angle_deg) ** 2,
        "upside down",
    ),
    KnownSlip(
        "01.3",
        "both ways' angle",
        lambda m: peak(m, 2 * die(m)) / peak(m, m.mill_angle_deg, m.pitch_mm),
        "twice the angle",
    ),
    KnownSlip(
        "01.3",
        "the work's angle",
        lambda m: peak(m, m.work_deg) / peak(m, m.mill_angle_deg, m.pitch_mm),
        "degrees of the work",
    ),
    KnownSlip("01.3", "strokes alone", lambda m: stroke(m) / m.pitch_mm, "strokes alone"),
    KnownSlip(
        "01.3",
        "strokes upside down",
        lambda m: m.pitch_mm / stroke(m) * (m.mill_angle_deg / die(m)) ** 2,
        "strokes",
    ),
    KnownSlip(
        "01.3",
        "all squared",
        lambda m: (stroke(m) / m.pitch_mm * m.mill_angle_deg / die(m)) ** 2,
        "stroke",
    ),
    KnownSlip(
        "01.3",
        "third power",
        lambda m: stroke(m) / m.pitch_mm * (m.mill_angle_deg / die(m)) ** 3,
        "jerk",
    ),
    KnownSlip(
        "01.3",
        "in percent",
        lambda m: 100 * stroke(m) / m.pitch_mm * (m.mill_angle_deg / die(m)) ** 2,
        "percent",
    ),
    KnownSlip(
        "02.1",
        "no square",
        lambda m: 2 * math.pi * stroke(m) / 1000 / time(m, die(m)),
        "square",
    ),
    KnownSlip("02.1", "in mm", lambda m: 1000 * peak(m, die(m)), "mm"),
    KnownSlip("02.1", "in cm", lambda m: 100 * peak(m, die(m)), "cm"),
    KnownSlip(
        "02.1",
        "the 10 lost",
        lambda m: math.tau * stroke(m) / 1000 / (die(m) / m.rate_per_hour) ** 2,
        "10 B/N",
    ),
    *(
        KnownSlip("02.1", f"{name}, in mm", answer, f"{said}.*in mm where metres")
        for name, answer, said in (
            ("no square", lambda m: math.tau * stroke(m) / time(m, die(m)), "square"),
            ("mean", lambda m: 4 * stroke(m) / time(m, die(m)) ** 2, "mean"),
            ("2 pi lost", lambda m: stroke(m) / time(m, die(m)) ** 2, "2 pi"),
            ("velocity", lambda m: 2 * stroke(m) / time(m, die(m)), "velocity"),
            ("both ways' angle", lambda m: 1000 * peak(m, 2 * die(m)), "twice the angle"),
        )
    ),
    *(
        KnownSlip("02.1", name, lambda m, ca=ca: ca / math.tau * peak(m, die(m)), name)  # type: ignore[misc]
        for name, ca in (
            ("modified sine", 5.52796),
            ("modified trapezoid", 4.88812),
            ("3-4-5 polynomial", 10 / math.sqrt(3)),
        )
    ),
    KnownSlip(
        "02.1",
        "angle for the time",
        lambda m: math.tau * stroke(m) / 1000 / die(m) ** 2,
        "degrees stand where the time",
    ),
    KnownSlip(
        "02.1",
        "part of a turn",
        lambda m: math.tau * stroke(m) / 1000 / (die(m) / 360) ** 2,
        "part of a turn stands",
    ),
    KnownSlip("02.1", "mean velocity", lambda m: stroke(m) / 1000 / time(m, die(m)), "mean veloc"),
    KnownSlip(
        "02.1",
        "8 for 4",
        lambda m: 8 * stroke(m) / 1000 / time(m, die(m)) ** 2,
        "whole way in half the time",
    ),
    KnownSlip(
        "02.1",
        "the lesson's time",
        with_lessons(lambda m: math.tau * stroke(m) / 1000 / 0.275**2),
        "a number of the lesson|finite",
    ),
    KnownSlip("02.1", "2 pi lost", lambda m: peak(m, die(m)) / (2 * math.pi), "2 pi"),
    KnownSlip("02.1", "2 pi twice", lambda m: peak(m, die(m)) * 2 * math.pi, "2 pi"),
    KnownSlip("02.1", "pi for 2 pi", lambda m: peak(m, die(m)) / 2, "factor 2"),
    KnownSlip("02.1", "mean", lambda m: 4 * stroke(m) / 1000 / time(m, die(m)) ** 2, "mean"),
    KnownSlip(
        "02.1",
        "constant all the way",
        lambda m: 2 * stroke(m) / 1000 / time(m, die(m)) ** 2,
        "constant",
    ),
    KnownSlip("02.1", "whole turn", lambda m: peak(m, 360), "whole turn"),
    KnownSlip("02.1", "velocity", lambda m: 2 * stroke(m) / 1000 / time(m, die(m)), "velocity"),
    KnownSlip(
        "02.1",
        "jerk",
        lambda m: 4 * math.pi**2 * stroke(m) / 1000 / time(m, die(m)) ** 3,
        "jerk",
    ),
    KnownSlip("02.1", "in g", lambda m: peak(m, die(m)) / G, r"in g\b"),
    KnownSlip("02.1", "the mill", lambda m: peak(m, m.mill_angle_deg, m.pitch_mm), "mill"),
    KnownSlip("02.1", "both ways' angle", lambda m: peak(m, 2 * die(m)), "both ways|twice the"),
    KnownSlip("02.1", "per minute", lambda m: peak(m, die(m), per_hour=60), "per minute"),
    KnownSlip("02.1", "per second", lambda m: peak(m, die(m), per_hour=3600), "per second"),
    KnownSlip("02.1", "angle in radians", lambda m: peak(m, math.radians(die(m))), "radian"),
    KnownSlip("02.1", "time in ms", lambda m: peak(m, die(m)) / 1e6, r"\bms\b"),
    KnownSlip("02.1", "the lesson's", lessons(4.154), "machine of the lesson"),
    KnownSlip("02.1", "the lesson's stroke", lambda m: peak(m, die(m), 50), "a number of the less"),
    KnownSlip("02.1", "the lesson's angle", lambda m: peak(m, 55), "a number of the lesson"),
    KnownSlip("02.1", "the mill's way", lambda m: peak(m, die(m), m.pitch_mm), "way of the mill"),
    KnownSlip("02.1", "the mill's angle", lambda m: peak(m, m.mill_angle_deg), "angle of the mill"),
    KnownSlip("02.1", "the work's angle", lambda m: peak(m, m.work_deg), "degrees of the work"),
    KnownSlip("02.1", "upwards", lambda m: -peak(m, die(m)), "sign"),
    KnownSlip(
        "02.1",
        "time rounded to 1/100 s",
        lambda m: 2 * math.pi * stroke(m) / 1000 / round(time(m, die(m)), 2) ** 2,
        "rounded",
    ),
    KnownSlip("02.2", "no chain rule", lambda m: h_m * push(m), "chain rule"),
    KnownSlip("02.2", "chain rule once", lambda m: h_m / t_m * push(m), "once"),
    KnownSlip("02.2", "velocity", lambda m: h_m / t_m * speed(m), "velocity"),
    KnownSlip("02.2", "displacement", lambda m: h_m * way(m), "displacement"),
    KnownSlip("02.2", "first", lambda m: h_m / t_m**2 * speed(m), "first derivative"),
    KnownSlip("02.2", "powers of one", lambda m: h_m * t / t_m**3 * push(m), "powers those of"),
    KnownSlip("02.2", "jerk", lambda m: h_m / t_m**3 * jolt(m), "jerk"),
    KnownSlip("02.2", "sign", lambda m: -h_m / t_m**2 * push(m), "sign"),
    KnownSlip("02.2", "left in x", lambda m: h_m / t_m**2 * push(m, x), r"\.subs\(x, t/t_m\)"),
    KnownSlip("02.2", "t for x", lambda m: h_m / t_m**2 * push(m, t), "t/t_m"),
    KnownSlip("02.2", "a cosine", lambda m: h_m / t_m**2 * between_the_ends(m), "ends"),
    KnownSlip(
        "02.2",
        "the cycloid's",
        lambda _: 2 * sympy.pi * h_m / t_m**2 * sympy.sin(2 * sympy.pi * X),
        "cycloid",
    ),
    KnownSlip("02.2", "factor 2 lost", lambda m: h_m / t_m**2 * push(m) / 2, "half"),
    KnownSlip("02.2", "no higher power", lambda m: h_m / t_m**2 * push(m, X, (1, 0)), "higher"),
    KnownSlip("02.2", "no lower power", lambda m: h_m / t_m**2 * push(m, X, (0, 1)), "lower"),
    KnownSlip("02.2", "a plus", lambda m: h_m / t_m**2 * push(m, X, (1, -1)), "plus"),
    KnownSlip("02.2", "numbers of one", lambda m: h_m / t_m**2 * numbers_of_one(m), "numbers thos"),
    KnownSlip("02.2", "no stroke", lambda m: push(m) / t_m**2, "h_m"),
    KnownSlip("02.2", "by x", push, "by x"),
    KnownSlip(
        "02.2", "the start alone", lambda m: h_m / t_m**2 * push(m, sympy.Integer(0)), "alone"
    ),
    KnownSlip(
        "02.2", "the end alone", lambda m: h_m / t_m**2 * push(m, sympy.Integer(1)), "end alone"
    ),
    KnownSlip("02.2", "no return", lambda _: without_return, "return"),
    KnownSlip("02.2", "a text", lambda _: "h_m/t_m**2*(6 - 12*t/t_m)", "quotes"),
    KnownSlip("02.3", "weight", lambda m: m.die_mass_kg * G, "weight"),
    KnownSlip(
        "02.3", "weight added", lambda m: m.die_mass_kg * (peak(m, die(m)) + G), "weight was added"
    ),
    KnownSlip("02.3", "less weight", lambda m: m.die_mass_kg * (peak(m, die(m)) - G), "each other"),
    KnownSlip("02.3", "less force", lambda m: m.die_mass_kg * (10 - peak(m, die(m))), "each other"),
    KnownSlip("02.3", "weight with 10", lambda m: m.die_mass_kg * 10, "weight"),
    KnownSlip("02.3", "times 10", lambda m: m.die_mass_kg * peak(m, die(m)) * 10, r"\bg\b"),
    KnownSlip("02.3", "by 10", lambda m: m.die_mass_kg * peak(m, die(m)) / 10, r"\bg\b"),
    KnownSlip(
        "02.3", "10 added", lambda m: m.die_mass_kg * (peak(m, die(m)) + 10), "weight was added"
    ),
    KnownSlip(
        "02.3",
        "the lesson's peak",
        lambda m: m.die_mass_kg * lessons(4.154)(m),
        "the lesson's answer to 02.1",
    ),
    KnownSlip("02.3", "by the mass", lambda m: peak(m, die(m)) / m.die_mass_kg, "divided by the m"),
    KnownSlip("02.3", "mass by it", lambda m: m.die_mass_kg / peak(m, die(m)), "mass was divided"),
    KnownSlip("02.3", "acceleration", lambda m: peak(m, die(m)), "the acceleration"),
    KnownSlip(
        "02.3",
        "mean",
        lambda m: m.die_mass_kg * 4 * stroke(m) / 1000 / time(m, die(m)) ** 2,
        "mean",
    ),
    KnownSlip(
        "02.3",
        "no square",
        lambda m: m.die_mass_kg * 2 * math.pi * stroke(m) / 1000 / time(m, die(m)),
        "square",
    ),
    KnownSlip("02.3", "in kilograms", lambda m: m.die_mass_kg * peak(m, die(m)) / G, r"\bg\b"),
    KnownSlip("02.3", "times g", lambda m: m.die_mass_kg * peak(m, die(m)) * G, r"\bg\b"),
    KnownSlip("02.3", "mm/s²", lambda m: 1000 * m.die_mass_kg * peak(m, die(m)), "mm"),
    KnownSlip(
        "02.3",
        "mean, mm/s²",
        lambda m: m.die_mass_kg * 4 * stroke(m) / time(m, die(m)) ** 2,
        "mean.*in mm where metres belong, or a mass in grams",
    ),
    KnownSlip("02.3", "the 10 lost", lambda m: 100 * m.die_mass_kg * peak(m, die(m)), "10 B/N"),
    KnownSlip("02.3", "in kN", lambda m: m.die_mass_kg * peak(m, die(m)) / 1000, "kN"),
    KnownSlip(
        "02.3",
        "the mill",
        lambda m: m.die_mass_kg * peak(m, m.mill_angle_deg, m.pitch_mm),
        "mill",
    ),
    KnownSlip("02.4", "no square", faster, "counts twice|square"),
    KnownSlip("02.4", "upside down", lambda m: 1 / faster(m) ** 2, "smaller|upside"),
    KnownSlip("02.4", "the root", lambda m: faster(m) ** 0.5, "root of the ratio"),
    KnownSlip("02.4", "the share", lambda m: faster(m) - 1, "share the rate grows"),
    KnownSlip("02.4", "the time", lambda m: 1 / faster(m), "time gets shorter"),
    KnownSlip("02.4", "growth doubled", lambda m: 2 * faster(m) - 1, "doubled"),
    KnownSlip("02.4", "the increase", lambda m: faster(m) ** 2 - 1, "by how much"),
    KnownSlip("02.4", "percent", lambda m: 100 * (faster(m) ** 2 - 1), "percent"),
    KnownSlip("02.4", "factor in percent", lambda m: 100 * faster(m) ** 2, "percent"),
    KnownSlip("02.4", "percent of the rate", lambda m: 100 * (faster(m) - 1), "percent the rate"),
    KnownSlip("02.4", "twice the ratio", lambda m: 2 * faster(m), "twice the ratio"),
    KnownSlip("02.4", "third power", lambda m: faster(m) ** 3, "jerk"),
    KnownSlip("02.4", "nothing changes", lambda _: 1, "angle stays, but not the time"),
    KnownSlip("02.4", "the power", lambda _: 2, "2 is the power"),
    KnownSlip("02.4", "its square", lambda _: 4, "at twice the rate"),
    KnownSlip("02.4", "the new peak", lambda m: faster(m) ** 2 * peak(m, die(m)), "peak itself"),
    KnownSlip("03.1", "constant velocity", lambda m: 0.1 * m.pitch_mm, "constant velocity"),
    KnownSlip("03.1", "how far it came", lambda m: m.pitch_mm * law(0.9), "has come"),
    KnownSlip("03.1", "die's stroke", lambda m: stroke(m) * law(0.1), "stroke of the die"),
    KnownSlip("03.1", "share", lambda _: law(0.1), "share"),
    KnownSlip("03.1", "percent", lambda _: 100 * law(0.1), "percent"),
    KnownSlip("03.1", "degree mode", lambda m: m.pitch_mm * law_in_degrees(0.1), "radian"),
    KnownSlip(
        "03.1",
        "not by 2 pi",
        lambda m: m.pitch_mm * (0.1 - math.sin(0.2 * math.pi)),
        "2 pi",
    ),
    KnownSlip("03.1", "series", lambda m: m.pitch_mm * 2 * math.pi**2 / 3 * 0.1**3, "series"),
    KnownSlip(
        "03.1",
        "x of the whole turn",
        lambda m: m.pitch_mm * law(0.1 * m.mill_angle_deg / 360),
        "whole turn|of its move",
    ),
    KnownSlip("03.1", "in m", lambda m: m.pitch_mm * law(0.1) / 1000, "metres"),
    KnownSlip("03.1", "0.65 %", lambda m: m.pitch_mm * 0.0065, "rounded"),
    KnownSlip("03.1", "done", lambda _: law(0.9), "share of the stroke that is done"),
    KnownSlip("03.1", "both ends", lambda m: m.pitch_mm * law(0.2), "both ends"),
    KnownSlip(
        "03.1",
        "x of the die",
        lambda m: m.pitch_mm * law(0.1 * m.mill_angle_deg / die(m)),
        "die's move",
    ),
    KnownSlip(
        "03.1",
        "simple harmonic",
        lambda m: m.pitch_mm * (1 - math.cos(0.1 * math.pi)) / 2,
        "simple harmonic",
    ),
    KnownSlip("03.1", "constant", lambda m: m.pitch_mm * 0.02, "constant acceleration"),
    KnownSlip("03.2", "no overlap", die, "without overlap"),
    KnownSlip("03.2", "ends twice", lambda m: die(m) + 0.2 * m.mill_angle_deg, "[Bb]oth quiet"),
    KnownSlip("03.2", "one end", lambda m: (2 * die(m) + 0.1 * m.mill_angle_deg) / 2, "one of the"),
    KnownSlip("03.2", "both ways", lambda m: 2 * later(m), "both ways"),
    KnownSlip("03.2", "work forgotten", lambda m: (360 - 0.8 * m.mill_angle_deg) / 2, "work"),
    KnownSlip(
        "03.2", "half effective", lambda m: 0.4 * m.mill_angle_deg, "half of the mill's effective"
    ),
    KnownSlip("03.2", "effective angle", lambda m: 0.8 * m.mill_angle_deg, "effective"),
    KnownSlip("03.3", "share", lambda m: (m.wait_mm - m.margin_mm) / stroke(m), "share"),
    KnownSlip("03.3", "share at the touch", lambda m: m.wait_mm / stroke(m), "touches the mill"),
    KnownSlip("03.3", "plus", lambda m: place(deep(m), law_with_plus), "minus before the sine"),
    KnownSlip("03.3", "constant", lambda m: place(deep(m), law_constant), "constant acceleration"),
    KnownSlip(
        "03.3",
        "simple harmonic",
        lambda m: math.acos(1 - 2 * deep(m)) / math.pi,
        "simple harmonic",
    ),
    KnownSlip(
        "03.3",
        "the lesson's stroke",
        with_lessons(lambda m: place((m.wait_mm - m.margin_mm) / 50)),
        "a number of the lesson",
    ),
    KnownSlip("03.3", "no margin", lambda m: x_deep(m, 0), "margin"),
    KnownSlip("03.3", "margin added", lambda m: x_deep(m, 1), "margin was added"),
    KnownSlip("03.3", "1 - x", lambda m: 1 - x_deep(m), "still to come"),
    KnownSlip(
        "03.3",
        "law for its inverse",
        lambda m: law((m.wait_mm - m.margin_mm) / stroke(m)),
        "wrong way round",
    ),
    KnownSlip(
        "03.3",
        "degree mode",
        lambda m: place((m.wait_mm - m.margin_mm) / stroke(m), law_in_degrees),
        "radian",
    ),
    KnownSlip("03.3", "the depth", lambda m: m.wait_mm - m.margin_mm, "mm"),
    KnownSlip("03.3", "percent", lambda m: 100 * x_deep(m), "percent"),
    KnownSlip("03.3", "in degrees", lambda m: x_deep(m) * die(m), "degrees"),
    KnownSlip("03.4", "by x", lambda m: later(m) / x_deep(m), "1 - x"),
    KnownSlip("03.4", "times 1 - x", lambda m: later(m) * (1 - x_deep(m)), "larger"),
    KnownSlip("03.4", "no quiet end", lambda m: die(m) / (1 - x_deep(m)), "quiet end"),
    KnownSlip(
        "03.4",
        "share for x",
        lambda m: later(m) / (1 - (m.wait_mm - m.margin_mm) / stroke(m)),
        "share",
    ),
    KnownSlip("03.4", "no margin", lambda m: later(m) / (1 - x_deep(m, 0)), "margin"),
    KnownSlip("03.4", "as in 03.2", later, "only the part 1 - x"),
    KnownSlip("03.4", "effective angle", lambda m: 0.8 * m.mill_angle_deg, "effective"),
    KnownSlip("03.4", "x = 1/2", lambda m: 2 * later(m), "half-way"),
    KnownSlip("03.4", "the start", lambda m: m.mill_angle_deg + die(m) - widest(m), "start|begin"),
    KnownSlip("03.5", "no square", lambda m: widest(m) / die(m), "square"),
    KnownSlip("03.5", "new by old", lambda m: 1 / gain(m), "new by old"),
    KnownSlip("03.5", "quiet ends alone", lambda m: (later(m) / die(m)) ** 2, "quiet ends"),
    KnownSlip("03.5", "the peak", lambda m: peak(m, widest(m)), "peak itself"),
    KnownSlip("03.5", "the old peak", lambda m: peak(m, die(m)), "old peak"),
    KnownSlip("03.5", "share less", lambda m: 1 - 1 / gain(m), "by which share"),
    KnownSlip(
        "03.5",
        "the lesson's angle",
        with_lessons(lambda m: (widest(m) / 55) ** 2),
        "a number of the lesson",
    ),
    KnownSlip(
        "03.5",
        "the lesson's widest angle",
        with_lessons(lambda m: (124.91 / die(m)) ** 2),
        "a number of the lesson",
    ),
    KnownSlip("03.5", "percent less", lambda m: 100 * (1 - 1 / gain(m)), "percent"),
    KnownSlip("03.5", "difference", lambda m: peak(m, die(m)) - peak(m, widest(m)), "difference"),
    KnownSlip("03.5", "third power", lambda m: gain(m) ** 1.5, "jerk"),
    KnownSlip(
        "04.1",
        "the lesson's angle",
        with_lessons(lambda m: stroke(m) * law(1 - 30 / 124.84)),
        "a number of the lesson|finite",
    ),
    KnownSlip(
        "04.1",
        "the lesson's stroke",
        with_lessons(lambda m: 50 * law(depth_x(m))),
        "a number of the lesson",
    ),
    *(
        KnownSlip("04.3", f"the lesson's {name}", with_lessons(answer), "a number of the lesson")
        for name, answer in {
            "angle": lambda m: 1000 * time(m, 110.32 - m.work_deg),
            "exact angle": lambda m: 1000 * time(m, 110.18 - m.work_deg),
            "work": lambda m: 1000 * time(m, 260 - 2 * told(m)),
        }.items()
    ),
    KnownSlip("04.1", "x", depth_x, "x itself"),
    KnownSlip("04.1", "no overlap", lambda m: stroke(m) * law(1 - 30 / die(m)), "without overlap"),
    KnownSlip("04.1", "still to go", lambda m: stroke(m) * law(1 - depth_x(m)), "still has to go"),
    KnownSlip("04.1", "constant velocity", lambda m: stroke(m) * depth_x(m), "constant velocity"),
    KnownSlip("04.1", "share", lambda m: law(depth_x(m)), "share"),
    KnownSlip("04.1", "degree mode", lambda m: stroke(m) * law_in_degrees(depth_x(m)), "radian"),
    KnownSlip(
        "04.1",
        "x of the turn",
        lambda m: stroke(m) * law((m.mill_angle_deg + die(m) - 30) / 360),
        "whole turn|its move",
    ),
    KnownSlip("04.2", "no square", slower, "counts twice|square"),
    KnownSlip("04.2", "upside down", lambda m: 1 / slower(m) ** 2, "[Uu]pside down"),
    KnownSlip("04.2", "both", lambda m: 1 / slower(m), "Upside down, and not squared"),
    KnownSlip("04.2", "third power", lambda m: slower(m) ** 3, "jerk"),
    KnownSlip("04.2", "per minute", lambda m: (60 * slower(m)) ** 2, "per minute"),
    KnownSlip("04.3", "in s", lambda m: time(m, rest(m)), r"in seconds"),
    KnownSlip("04.3", "one move", lambda m: 1000 * time(m, told(m)), "one move"),
    KnownSlip("04.3", "no overlap", lambda m: 1000 * time(m, m.mill_angle_deg), "without overlap"),
    KnownSlip("04.3", "both moves", lambda m: 1000 * time(m, 2 * told(m)), "both moves"),
    KnownSlip("04.3", "in degrees", rest, "in degrees"),
    KnownSlip(
        "04.3",
        "one way",
        lambda m: 1000 * time(m, 360 - m.work_deg - told(m)),
        "twice in a turn",
    ),
    KnownSlip("04.3", "the work", lambda m: 1000 * time(m, m.work_deg), "works"),
    KnownSlip("04.3", "no work", lambda m: 1000 * time(m, 360 - 2 * told(m)), "work"),
]
