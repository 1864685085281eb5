"""Lesson 07 by hand: right answers, and wrong ones that a student could give."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from known_slips import (
    KnownSlip,
    die,
    law,
    law_in_degrees,
    lessons,
    peak,
    stroke,
    time,
    with_lessons,
)

from cammotion.teaching.example import EXAMPLE, MillAndDie

TAN_30 = 1 / math.sqrt(3)


def rad(m: MillAndDie) -> float:
    """Return the angle of the die in rad."""
    return die(m) * math.pi / 180


def mean(m: MillAndDie) -> float:
    """Return the mean slope in mm/rad."""
    return stroke(m) / rad(m)


def prime(m: MillAndDie) -> float:
    """Return the prime circle of the question, about twice the stroke, in tens."""
    return 10 * round(2 * stroke(m) / 10)


def high(m: MillAndDie) -> float:
    """Return how high the roller is at mid-stroke."""
    return prime(m) + stroke(m) / 2


def degrees(slope: float, height: float) -> float:
    """Return the angle whose tangent this is."""
    return math.atan(slope / height) * 180 / math.pi


def late(m: MillAndDie) -> float:
    """Return the displacement at x = 3/4."""
    return stroke(m) * law(0.75)


def bend(m: MillAndDie) -> float:
    """Return the second derivative at x = 1/4, in mm/rad²."""
    return 2 * math.pi * stroke(m) / rad(m) ** 2


def base(m: MillAndDie) -> float:
    """Return the base circle of the question: 25 mm more than a point would need, in tens."""
    return 10 * math.ceil((bend(m) - late(m) + 25) / 10)


def push(m: MillAndDie) -> float:
    """Return mass times peak acceleration."""
    return m.die_mass_kg * peak(m, die(m))


def spring(m: MillAndDie) -> float:
    """Return the stiffness of the question, to one digit, which is not 1/2, 1 or 2."""
    stiffness = float(f"{0.4 * push(m) / late(m):.0e}")
    return {0.5: 0.45, 1: 0.9, 2: 1.8}.get(stiffness, stiffness)


def needed(m: MillAndDie) -> float:
    """Return the prime circle for 30 deg at mid-stroke."""
    return 2 * mean(m) / TAN_30 - stroke(m) / 2


def preload(m: MillAndDie, **instead: float) -> float:
    """Return the preload, with a number in place of one of the question."""
    own = {"mass": m.die_mass_kg, "way": stroke(m), "angle": die(m), "rate": m.rate_per_hour}
    given = {**own, "k": spring(m), **instead}
    tm = given["angle"] / 360 * 3600 / given["rate"]
    pushed = given["mass"] * 2 * math.pi * given["way"] / 1000 / tm**2
    return pushed - given["k"] * given["way"] * law(0.75)


X = np.linspace(0, 1, 20_001)
RISEN = X - np.sin(2 * np.pi * X) / (2 * np.pi)


def needed_all_over(m: MillAndDie) -> float:
    """Return the prime circle for 30 deg at the worst of many places of the rise."""
    slope = mean(m) * (1 - np.cos(2 * np.pi * X))
    return float(np.max(slope / TAN_30 - stroke(m) * RISEN))


def preload_all_over(m: MillAndDie) -> float:
    """Return the preload for the worst of many places of the rise."""
    return float(np.max(-push(m) * np.sin(2 * np.pi * X) - spring(m) * stroke(m) * RISEN))


def steepest_all_over(m: MillAndDie) -> float:
    """Return the largest pressure angle of many places of the rise."""
    slope = mean(m) * (1 - np.cos(2 * np.pi * X))
    return float(np.degrees(np.arctan(np.max(slope / (prime(m) + stroke(m) * RISEN)))))


def sharpest_all_over(m: MillAndDie) -> float:
    """Return the least radius of curvature of many places of the rise."""
    return float(np.min(base(m) + stroke(m) * RISEN + bend(m) * np.sin(2 * np.pi * X)))


def sine_in_degrees(m: MillAndDie) -> float:
    """Return the displacement at x = 3/4 of a calculator that counts in degrees."""
    return stroke(m) * law_in_degrees(0.75)


def early(m: MillAndDie) -> float:
    """Return the displacement at x = 3/4 with a lost sign."""
    return stroke(m) * (0.75 - 1 / (2 * math.pi))


RIGHT: dict[str, Callable[[MillAndDie], Any]] = {
    "07.1": lambda m: degrees(2 * mean(m), high(m)),
    "07.2": needed,
    "07.3": lambda m: 4 * mean(m),
    "07.4": lambda m: base(m) + late(m) - bend(m),
    "07.5": lambda m: push(m) - spring(m) * late(m),
}

SOURCE = {"07.2": 155.435, "07.3": 208.348}

SLIPS = [
    KnownSlip("07.1", "per degree", lambda m: degrees(2 * stroke(m) / die(m), high(m)), "per deg"),
    KnownSlip("07.1", "the tangent", lambda m: 2 * mean(m) / high(m), "tangent"),
    KnownSlip(
        "07.1", "half the circle", lambda m: degrees(4 * mean(m), prime(m) + stroke(m)), "diameter"
    ),
    KnownSlip(
        "07.1",
        "no arctangent",
        lambda m: 2 * mean(m) / high(m) * 180 / math.pi,
        "Which angle has this tangent",
    ),
    KnownSlip("07.1", "mean slope", lambda m: degrees(mean(m), high(m)), "mean slope"),
    KnownSlip("07.1", "no stroke", lambda m: degrees(2 * mean(m), prime(m)), "half the stroke"),
    KnownSlip(
        "07.1", "whole stroke", lambda m: degrees(2 * mean(m), prime(m) + stroke(m)), "whole stroke"
    ),
    KnownSlip("07.1", "upside down", lambda m: degrees(high(m), 2 * mean(m)), "Upside down"),
    KnownSlip("07.1", "in rad", lambda m: math.atan(2 * mean(m) / high(m)), "radians"),
    KnownSlip(
        "07.1", "stroke alone", lambda m: degrees(2 * mean(m), stroke(m) / 2), "prime circle is"
    ),
    KnownSlip("07.1", "2 pi", lambda m: degrees(2 * math.pi * mean(m), high(m)), "acceleration"),
    KnownSlip("07.1", "all over", steepest_all_over, "all over"),
    KnownSlip("07.1", "roller", lambda m: degrees(2 * mean(m), high(m) + 10), "roller's radius"),
    KnownSlip("07.1", "roller off", lambda m: degrees(2 * mean(m), high(m) - 10), "roller's rad"),
    KnownSlip("07.1", "diameter", lambda m: degrees(2 * mean(m), prime(m) + high(m)), "diameter"),
    KnownSlip(
        "07.1", "less half", lambda m: degrees(2 * mean(m), prime(m) - stroke(m) / 2), "taken away"
    ),
    KnownSlip(
        "07.1",
        "the lesson's stroke",
        with_lessons(lambda m: degrees(100 / rad(m), prime(m) + 25)),
        "a number of the lesson",
    ),
    KnownSlip(
        "07.1",
        "the lesson's circle",
        lambda m: degrees(2 * mean(m), 60 + stroke(m) / 2),
        "a number of the lesson",
    ),
    *(
        KnownSlip(number, "all the lesson's", lessons(answer), "machine of the lesson")
        for number, answer in {
            "07.1": degrees(100 / math.radians(55), 85),
            "07.4": 296 + 50 * law(0.75) - 100 * math.pi / math.radians(55) ** 2,
            "07.5": preload(EXAMPLE, k=0.5),
        }.items()
    ),
    KnownSlip(
        "07.2", "2 pi", lambda m: 2 * math.pi * mean(m) / TAN_30 - stroke(m) / 2, "acceleration"
    ),
    KnownSlip(
        "07.2", "cosine", lambda m: 4 * mean(m) / math.sqrt(3) - stroke(m) / 2, "by the cosine"
    ),
    KnownSlip("07.2", "mean alone", lambda m: mean(m) / TAN_30, "mean slope, stroke"),
    KnownSlip("07.2", "roller", lambda m: needed(m) + 10, "roller's radius"),
    KnownSlip("07.2", "roller off", lambda m: needed(m) - 10, "roller's radius"),
    KnownSlip("07.2", "to the axis", lambda m: 2 * mean(m) / TAN_30, "nearer"),
    KnownSlip("07.2", "whole stroke", lambda m: 2 * mean(m) / TAN_30 - stroke(m), "whole stroke"),
    KnownSlip("07.2", "added", lambda m: 2 * mean(m) / TAN_30 + stroke(m) / 2, "added"),
    KnownSlip("07.2", "sine", lambda m: 4 * mean(m) - stroke(m) / 2, "sine"),
    KnownSlip("07.2", "times", lambda m: 2 * mean(m) * TAN_30 - stroke(m) / 2, "multiplied"),
    KnownSlip("07.2", "mean slope", lambda m: mean(m) / TAN_30 - stroke(m) / 2, "mean slope"),
    KnownSlip(
        "07.2",
        "per degree",
        lambda m: 2 * stroke(m) / die(m) / TAN_30 - stroke(m) / 2,
        "per degree",
    ),
    KnownSlip("07.2", "all over", needed_all_over, "all over"),
    KnownSlip("07.2", "diameter", lambda m: 2 * needed(m), "diameter"),
    KnownSlip(
        "07.2",
        "tan 30 rad",
        lambda m: 2 * mean(m) / math.tan(30) - stroke(m) / 2,
        "30 rad",
    ),
    KnownSlip("07.3", "one side", lambda m: 2 * mean(m), "one side"),
    KnownSlip("07.3", "per degree", lambda m: 4 * stroke(m) / die(m), "per degree"),
    KnownSlip("07.3", "one side per degree", lambda m: 2 * stroke(m) / die(m), "per degree"),
    KnownSlip("07.3", "twice twice", lambda m: 8 * mean(m), "twice"),
    KnownSlip("07.3", "stroke", stroke, "stroke"),
    KnownSlip("07.3", "two strokes", lambda m: 2 * stroke(m), "stroke"),
    KnownSlip("07.3", "2 pi", lambda m: 2 * math.pi * mean(m), "2 pi"),
    KnownSlip("07.3", "mean, one side", mean, "mean slope"),
    KnownSlip("07.3", "second derivative", bend, "second derivative"),
    KnownSlip("07.3", "second derivative, both", lambda m: 2 * bend(m), "second derivative"),
    KnownSlip("07.4", "no second", lambda m: base(m) + late(m), "second derivative"),
    KnownSlip("07.4", "plus", lambda m: base(m) + late(m) + bend(m), "brakes"),
    KnownSlip("07.4", "no displacement", lambda m: base(m) - bend(m), "displacement is missing"),
    KnownSlip("07.4", "3/4 h", lambda m: base(m) + 0.75 * stroke(m) - bend(m), "Three quarters"),
    KnownSlip(
        "07.4", "in degrees", lambda m: base(m) + sine_in_degrees(m) - bend(m), "sine counts in deg"
    ),
    KnownSlip("07.4", "all over", sharpest_all_over, "all over"),
    KnownSlip("07.4", "whole", lambda m: base(m) + stroke(m) - bend(m), "whole stroke"),
    KnownSlip(
        "07.4",
        "per degree",
        lambda m: base(m) + late(m) - 2 * math.pi * stroke(m) / die(m) ** 2,
        "per degree",
    ),
    KnownSlip(
        "07.4", "no pi", lambda m: base(m) + late(m) - 2 * stroke(m) / rad(m) ** 2, "2 in place"
    ),
    KnownSlip("07.4", "lost sign", lambda m: base(m) + early(m) - bend(m), "sign of the sine"),
    KnownSlip("07.4", "x = 1/4", lambda m: base(m) + stroke(m) * law(0.25) - bend(m), "1/4"),
    KnownSlip(
        "07.4", "all at 1/4", lambda m: base(m) + stroke(m) * law(0.25) + bend(m), "at x = 1/4"
    ),
    KnownSlip("07.4", "half", lambda m: base(m) + stroke(m) / 2 - bend(m), "mid-stroke"),
    KnownSlip("07.4", "no circle", lambda m: late(m) - bend(m), "base circle is missing"),
    KnownSlip("07.4", "roller", lambda m: base(m) + late(m) - bend(m) - 10, "roller's radius"),
    KnownSlip(
        "07.4", "2 pi lost", lambda m: base(m) + late(m) - stroke(m) / rad(m) ** 2, "factor 2 pi"
    ),
    KnownSlip(
        "07.4",
        "no square",
        lambda m: base(m) + late(m) - 2 * math.pi * stroke(m) / rad(m),
        "squared",
    ),
    KnownSlip(
        "07.4",
        "per degree once",
        lambda m: base(m) + late(m) - 2 * math.pi * stroke(m) / rad(m) / die(m),
        "square the angle",
    ),
    KnownSlip(
        "07.4",
        "the lesson's stroke",
        with_lessons(lambda m: base(m) + 50 * law(0.75) - 100 * math.pi / rad(m) ** 2),
        "a number of the lesson",
    ),
    KnownSlip(
        "07.4",
        "the lesson's angle",
        with_lessons(lambda m: base(m) + late(m) - 2 * math.pi * stroke(m) / math.radians(55) ** 2),
        "a number of the lesson",
    ),
    KnownSlip("07.5", "no spring", push, "whole force"),
    KnownSlip("07.5", "added", lambda m: push(m) + spring(m) * late(m), "added"),
    KnownSlip("07.5", "whole", lambda m: push(m) - spring(m) * stroke(m), "whole stroke"),
    KnownSlip("07.5", "3/4 h", lambda m: push(m) - spring(m) * 0.75 * stroke(m), "Three quarters"),
    KnownSlip(
        "07.5",
        "in degrees",
        lambda m: push(m) - spring(m) * sine_in_degrees(m),
        "sine counts in deg",
    ),
    KnownSlip("07.5", "lost sign", lambda m: push(m) - spring(m) * early(m), "sign of the sine"),
    KnownSlip("07.5", "all over", preload_all_over, "all over"),
    KnownSlip("07.5", "x = 1/4", lambda m: push(m) - spring(m) * stroke(m) * law(0.25), "1/4"),
    KnownSlip(
        "07.5", "in mm", lambda m: 1000 * push(m) - spring(m) * late(m), "mm/s², or .* grams"
    ),
    KnownSlip(
        "07.5",
        "2 pi lost, in mm",
        lambda m: 500 / math.pi * push(m) - spring(m) * late(m),
        "2 pi.*mm/s², or",
    ),
    KnownSlip(
        "07.5",
        "no square, in mm",
        lambda m: 1000 * push(m) * time(m, die(m)) - spring(m) * late(m),
        "squared.*mm/s², or",
    ),
    KnownSlip("07.5", "the 10 lost", lambda m: 100 * push(m) - spring(m) * late(m), "10 B/N"),
    KnownSlip(
        "07.5",
        "mid-stroke",
        lambda m: push(m) - spring(m) * stroke(m) / 2,
        r"^The spring was pressed together by half the stroke, as at mid-stroke.*law\.$",
    ),
    KnownSlip("07.5", "spring in m", lambda m: push(m) - spring(m) * late(m) / 1000, "metres"),
    KnownSlip("07.5", "spring alone", lambda m: spring(m) * late(m), "still missing"),
    KnownSlip(
        "07.5",
        "weight",
        lambda m: push(m) - spring(m) * late(m) + 9.80665 * m.die_mass_kg,
        "weight",
    ),
    KnownSlip(
        "07.5",
        "less weight",
        lambda m: push(m) - spring(m) * late(m) - 9.80665 * m.die_mass_kg,
        "weight",
    ),
    KnownSlip("07.5", "less 9.81 m", lambda m: preload(m) - 9.81 * m.die_mass_kg, "weight"),
    KnownSlip("07.5", "less 10 m", lambda m: preload(m) - 10 * m.die_mass_kg, "weight"),
    KnownSlip("07.5", "no stiffness", lambda m: preload(m, k=1), "stiffness of the spring is miss"),
    KnownSlip("07.5", "the way", lambda m: preload(m) / spring(m), "by how many mm"),
    KnownSlip(
        "07.5", "2 pi lost", lambda m: push(m) / 2 / math.pi - spring(m) * late(m), "factor 2 pi"
    ),
    KnownSlip(
        "07.5",
        "no square",
        lambda m: push(m) * time(m, die(m)) - spring(m) * late(m),
        "squared",
    ),
    *(
        KnownSlip("07.5", f"the lesson's {name}", with_lessons(answer), "a number of the lesson")
        for name, answer in {
            "mass": lambda m: preload(m, mass=12),
            "stroke": lambda m: preload(m, way=50),
            "angle": lambda m: preload(m, angle=55),
            "rate": lambda m: preload(m, rate=2000),
            "spring": lambda m: preload(m, k=0.5),
        }.items()
    ),
    KnownSlip(
        "07.5",
        "a whole turn",
        lambda m: m.die_mass_kg * peak(m, 360) - spring(m) * late(m),
        "whole turn",
    ),
    KnownSlip("07.5", "per minute", lambda m: 3600 * push(m) - spring(m) * late(m), "an hour has"),
    KnownSlip(
        "07.5",
        "constant acceleration",
        lambda m: 4 / 2 / math.pi * push(m) - spring(m) * late(m),
        "constant acceleration",
    ),
    KnownSlip("07.6", "1 mm", lambda _: "a", "below 0"),
    KnownSlip("07.6", "a point", lambda _: "c", "cutter takes away"),
    KnownSlip("07.6", "stuck", lambda _: "d", "hollow"),
]
