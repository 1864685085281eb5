"""Lesson 11 by hand: right answers, and wrong ones that a student could give.

Nothing here knows of the package's fits or of the slips that it recognises. The limits are those of
the table in tests/data that is not the package's.
"""

import json
import math
from bisect import bisect_left
from collections.abc import Callable
from pathlib import Path

from known_slips import KnownSlip

from cammotion.teaching.example import MillAndDie

TABLE = json.loads((Path(__file__).parent / "data" / "iso_286.json").read_text("utf-8"))
TABLE = TABLE["rf-tolerance"]
STEPS = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
UNITS = {5: 7, 6: 10, 7: 16, 8: 25, 9: 40, 10: 64, 11: 100}


def width(size: float, grade: int) -> float:
    """Return the width of a grade in um."""
    return float(TABLE["grades"][str(grade)][bisect_left(STEPS, size)])


def hole(m: MillAndDie) -> float:
    """Return the upper deviation of the hole of 11.2, an H, in um."""
    return width(m.fits.bore_mm, int(m.fits.pair[0][1:]))


def shaft_width(m: MillAndDie) -> float:
    """Return the tolerance of the shaft of 11.2."""
    return width(m.fits.bore_mm, int(m.fits.pair[1][1:]))


def gap(m: MillAndDie) -> float:
    """Return how far the zone of the shaft of 11.2 begins below the zero line."""
    return -float(TABLE["deviations"][m.fits.pair[1][0]][bisect_left(STEPS, m.fits.bore_mm)])


def most(m: MillAndDie) -> float:
    """Return the largest play of 11.2."""
    return hole(m) + gap(m) + shaft_width(m)


def most_of_row(m: MillAndDie, by: int) -> float:
    """Return the largest play of 11.2 read from a row so many below the right one."""
    at = bisect_left(STEPS, m.fits.bore_mm) + by
    grades = sum(float(TABLE["grades"][zone[1:]][at]) for zone in m.fits.pair)
    return grades - float(TABLE["deviations"][m.fits.pair[1][0]][at])


def most_by_formulas(m: MillAndDie) -> float:
    """Return the largest play of 11.2 as the formulas give it."""
    at = bisect_left(STEPS, m.fits.bore_mm)
    mean = math.sqrt(STEPS[at - 1] * STEPS[at])
    factor, power = {"d": (16, 0.44), "e": (11, 0.41), "f": (5.5, 0.41), "g": (2.5, 0.34)}[
        m.fits.pair[1][0]
    ]
    units = sum(UNITS[int(zone[1:])] for zone in m.fits.pair)
    wrong = units * (0.45 * mean ** (1 / 3) + 0.001 * mean) + factor * mean**power
    return unless_alike(wrong, most(m), 0.001)


def unless_alike(wrong: float, right: float, within: float = 0.004) -> float:
    """Return a wrong number, NaN where nobody can tell it from the right one."""
    return wrong if abs(wrong / right - 1) > within else math.nan


def arc(m: MillAndDie, by: float = 1) -> float:
    """Return the play in um along the circumference of the shaft of 11.1."""
    return m.fits.lag_deg / 360 * math.pi * m.fits.shaft[0] * 1000 * by


def step(m: MillAndDie) -> tuple[float, float]:
    """Return the ends of the step of 11.3."""
    at = bisect_left(STEPS, m.fits.turned_mm)
    return STEPS[at - 1], STEPS[at]


def geometric(m: MillAndDie) -> float:
    """Return D of 11.3."""
    low, high = step(m)
    return math.sqrt(low * high)


def grade(m: MillAndDie, mean: float | None = None, units: float | None = None) -> float:
    """Return the width of the grade of 11.3 by the formula."""
    mean = mean or geometric(m)
    return float((units or UNITS[m.fits.grade]) * (0.45 * mean ** (1 / 3) + 0.001 * mean))


def with_diameter(m: MillAndDie) -> float:
    """Return the width of the grade with the diameter for D, NaN where that changes little."""
    wrong = grade(m, m.fits.turned_mm)
    return wrong if abs(wrong / grade(m) - 1) > 0.02 else math.nan


def play(m: MillAndDie) -> float:
    """Return the largest play of the key of 11.4 in um."""
    return 2 * width(m.fits.shaft[1], 9)


def key_by_formula(m: MillAndDie) -> float:
    """Return the angle of 11.4 by the formula, with the mean diameter of the key's step."""
    at = bisect_left(STEPS, m.fits.shaft[1])
    mean = math.sqrt(STEPS[at - 1] * STEPS[at])
    um = 2 * UNITS[9] * (0.45 * mean ** (1 / 3) + 0.001 * mean)
    return turned(m, unless_alike(um, play(m)))


def with_rounded_unit(m: MillAndDie) -> float:
    """Return the width of 11.3 with i to a tenth, NaN where nobody can tell."""
    return unless_alike(UNITS[m.fits.grade] * round(grade(m, units=1), 1), grade(m), 0.002)


def by_table(m: MillAndDie) -> float:
    """Return the width of 11.3 in the table, NaN where nobody can tell."""
    return unless_alike(width(m.fits.turned_mm, m.fits.grade), grade(m), 0.002)


def with_rounded_mean(m: MillAndDie) -> float:
    """Return the width of 11.3 with D to a mm, NaN where nobody can tell."""
    return unless_alike(grade(m, round(geometric(m))), grade(m), 0.002)


def key_of_row(m: MillAndDie, by: int) -> float:
    """Return the angle of 11.4 read from a row so many below the right one."""
    return turned(m, 2 * TABLE["grades"]["9"][bisect_left(STEPS, m.fits.shaft[1]) + by])


def turned(m: MillAndDie, um: float) -> float:
    """Return by how many degrees a cam turns on its shaft with a play."""
    return um / 1000 / (math.pi * m.fits.shaft[0]) * 360


RIGHT: dict[str, Callable[[MillAndDie], float]] = {
    "11.1": arc,
    "11.2": most,
    "11.3": grade,
    "11.4": lambda m: turned(m, play(m)),
}

SOURCE = {"11.1": 3.49066, "11.2": 50, "11.3": 15.6123, "11.4": 0.246372}

SLIPS = [
    KnownSlip("11.1", "diameter for radius", lambda m: arc(m, 2), "diameter"),
    KnownSlip("11.1", "half", lambda m: arc(m, 0.5), "half"),
    KnownSlip("11.1", "pi r", lambda m: arc(m) / 2, "pi times the radius"),
    KnownSlip("11.1", "degrees", lambda m: arc(m, 180 / math.pi), "radian"),
    KnownSlip("11.1", "degrees, diameter", lambda m: arc(m, 360 / math.pi), "diameter"),
    KnownSlip("11.1", "no pi", lambda m: arc(m, 1 / math.pi), "pi times the diameter"),
    KnownSlip("11.1", "in mm", lambda m: arc(m, 1e-3), "in mm"),
    KnownSlip("11.1", "share of a turn", lambda m: m.fits.lag_deg / 0.36, "share"),
    KnownSlip("11.1", "no radius", lambda m: arc(m) * 2 / m.fits.shaft[0], "radius"),
    KnownSlip("11.1", "divided", lambda m: arc(m) * 4 / m.fits.shaft[0] ** 2, "divided"),
    KnownSlip("11.1", "the wrong way to radians", lambda m: arc(m, (180 / math.pi) ** 2), "180"),
    KnownSlip("11.1", "twice the diameter", lambda m: arc(m, 4), "four times|too large"),
    KnownSlip("11.1", "minus", lambda m: -arc(m), "sign"),
    KnownSlip("11.2", "smallest", gap, "least play"),
    KnownSlip("11.2", "both tolerances", lambda m: hole(m) + shaft_width(m), "gap"),
    KnownSlip("11.2", "a row above", lambda m: most_of_row(m, -1), "row beside"),
    KnownSlip("11.2", "a row below", lambda m: most_of_row(m, 1), "row beside"),
    KnownSlip("11.2", "the hole", hole, "hole"),
    KnownSlip("11.2", "the shaft", lambda m: gap(m) + shaft_width(m), "shaft"),
    KnownSlip("11.2", "thick shaft", lambda m: hole(m) + gap(m), "thickest"),
    KnownSlip("11.2", "grade of the hole", lambda m: 2 * hole(m) + gap(m), "of the hole for both"),
    KnownSlip(
        "11.2", "of the shaft", lambda m: 2 * shaft_width(m) + gap(m), "of the shaft for both"
    ),
    KnownSlip("11.2", "sign", lambda m: hole(m) - gap(m) - shaft_width(m), "sign"),
    KnownSlip(
        "11.2", "sign, above 0", lambda m: abs(hole(m) - gap(m) - shaft_width(m)), "sign is lost"
    ),
    KnownSlip("11.2", "mean", lambda m: (most(m) + gap(m)) / 2, "mean"),
    KnownSlip("11.2", "in mm", lambda m: most(m) / 1000, "in mm"),
    KnownSlip("11.2", "one side", lambda m: most(m) / 2, "one side"),
    KnownSlip("11.2", "with diameter", lambda m: m.fits.bore_mm + most(m) / 1000, "diameter"),
    KnownSlip("11.2", "tolerance of the shaft", shaft_width, "tolerance"),
    KnownSlip("11.2", "shaft subtracted", lambda m: hole(m) + gap(m) - shaft_width(m), "thinner"),
    KnownSlip("11.2", "by the formulas", most_by_formulas, "formulas|finite"),
    KnownSlip("11.3", "by the table", by_table, "table says|finite"),
    KnownSlip("11.3", "D to a mm", with_rounded_mean, "D was rounded|finite"),
    KnownSlip("11.3", "i to a tenth", with_rounded_unit, "rounded on the way|finite"),
    KnownSlip("11.3", "D itself", with_diameter, "whole step|finite|Not far"),
    KnownSlip("11.3", "arithmetic", lambda m: grade(m, sum(step(m)) / 2), "arithmetic|Close"),
    KnownSlip("11.3", "lower end", lambda m: grade(m, step(m)[0]), "lower end"),
    KnownSlip("11.3", "upper end", lambda m: grade(m, step(m)[1]), "upper end"),
    KnownSlip("11.3", "one unit", lambda m: grade(m, units=1), "tolerance unit"),
    KnownSlip("11.3", "grade as factor", lambda m: grade(m, units=m.fits.grade), "no factor"),
    KnownSlip("11.3", "coarser", lambda m: grade(m, units=UNITS[m.fits.grade + 1]), "too coarse"),
    KnownSlip("11.3", "finer", lambda m: grade(m, units=UNITS[m.fits.grade - 1]), "too fine"),
    KnownSlip(
        "11.3",
        "first term alone",
        lambda m: UNITS[m.fits.grade] * 0.45 * geometric(m) ** (1 / 3),
        "second term",
    ),
    KnownSlip(
        "11.3",
        "square root",
        lambda m: UNITS[m.fits.grade] * (0.45 * geometric(m) ** 0.5 + 0.001 * geometric(m)),
        "square root",
    ),
    KnownSlip("11.3", "in mm", lambda m: grade(m) / 1000, "in mm"),
    KnownSlip(
        "11.3",
        "a third",
        lambda m: UNITS[m.fits.grade] * (0.45 * geometric(m) ** 1 / 3 + 0.001 * geometric(m)),
        "cube root",
    ),
    KnownSlip("11.4", "one tolerance", lambda m: turned(m, play(m) / 2), "half"),
    KnownSlip("11.4", "both halves", lambda m: turned(m, play(m) / 4), "a quarter of it: the"),
    KnownSlip("11.4", "to and fro", lambda m: turned(m, 2 * play(m)), "twice"),
    KnownSlip("11.4", "pi r", lambda m: turned(m, 2 * play(m)), "pi times the radius"),
    KnownSlip(
        "11.4",
        "no pi",
        lambda m: play(m) / 1000 / m.fits.shaft[0] * 360,
        "pi times the diameter, and a rad is 180/pi degrees",
    ),
    KnownSlip("11.4", "by the formula", key_by_formula, "formula|finite"),
    KnownSlip("11.4", "the row before", lambda m: key_of_row(m, -1), "beside the right one"),
    KnownSlip("11.4", "the row after", lambda m: key_of_row(m, 1), "beside the right one"),
    KnownSlip("11.4", "radians", lambda m: play(m) / 500 / m.fits.shaft[0], "radian"),
    KnownSlip(
        "11.4",
        "by the shaft's size",
        lambda m: turned(m, 2 * width(m.fits.shaft[0], 9)),
        "width of the key",
    ),
    KnownSlip(
        "11.4",
        "by the shaft's size, one",
        lambda m: turned(m, width(m.fits.shaft[0], 9)),
        "width of the key",
    ),
    KnownSlip(
        "11.4",
        "radius of the key",
        lambda m: math.degrees(play(m) / 500 / m.fits.shaft[1]),
        "width of the key",
    ),
    KnownSlip("11.4", "µm over mm", lambda m: 1000 * turned(m, play(m)), "Micrometres"),
    KnownSlip("11.4", "the play", play, "in µm"),
    KnownSlip("11.4", "the play in mm", lambda m: play(m) / 1000, "in mm"),
    KnownSlip("11.4", "grade 7", lambda m: turned(m, 2 * width(m.fits.shaft[1], 7)), "grade 7"),
    KnownSlip("11.4", "a part of a turn", lambda m: turned(m, play(m)) / 360, "part of a turn"),
    KnownSlip("11.5", "a: always", lambda _: "a", "40 mm"),
    KnownSlip("11.5", "c: never", lambda _: "c", "above zero"),
    KnownSlip("11.5", "d: alike", lambda _: "d", "zone"),
]
