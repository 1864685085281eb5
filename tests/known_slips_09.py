"""Lesson 09 by hand: right answers, and wrong ones that a student could give.

Nothing here knows of the package's differences, harmonics or springs, or of the slips that it
recognises.
"""

import math
from collections.abc import Callable

import numpy as np
from known_slips import KnownSlip
from scipy.integrate import quad

from cammotion.teaching.example import MillAndDie


def between(m: MillAndDie) -> float:
    """Return the time from point to point in s."""
    return 60 / m.measured.per_minute / m.measured.points


def step(m: MillAndDie) -> float:
    """Return the step in um: half of it, with alternating signs, makes the limit."""
    worst = np.array([1, -1, 1]) @ np.array([1, -2, 1]) / between(m) ** 2  # of an error of 1 m
    return float(2 * m.measured.limit / worst * 1e6)


def swings(m: MillAndDie) -> float:
    springs = [m.measured.load_N / (give / 1000) for give in m.measured.gives_mm]
    together = 1 / sum(1 / spring for spring in springs)
    return math.sqrt(together / m.measured.mass_kg) / (2 * math.pi) * 60 / m.measured.per_minute


def of_two(m: MillAndDie, left_out: Callable[[tuple[float, ...]], float]) -> float:
    """Return the swings in a turn, if the softest or the stiffest of the parts did not give way."""
    gives = [give for give in m.measured.gives_mm if give != left_out(m.measured.gives_mm)]
    stiffness = m.measured.load_N / (sum(gives) / 1000)
    return math.sqrt(stiffness / m.measured.mass_kg) / (2 * math.pi) * 60 / m.measured.per_minute


def seen(m: MillAndDie) -> float:
    """Return the rank whose cosine has the same values at the points."""
    points, rank = m.measured.folded
    places = np.arange(points) * 2 * np.pi / points
    true = np.cos(rank * places)
    (found,) = [k for k in range(points // 2 + 1) if np.allclose(np.cos(k * places), true)]
    return found


def left(m: MillAndDie) -> float:
    rank, percent, other = m.measured.left
    amount = (100 / percent - 1) / rank**4
    return 100 / (1 + amount * other**4)


def scaled(m: MillAndDie) -> float:
    """Return the share of the other harmonic, if it went with the fourth power itself."""
    rank, percent, other = m.measured.left
    return percent * (rank / other) ** 4


def push(m: MillAndDie) -> float:
    """Return the acceleration of the parabola in m/s²: half the way in half the time."""
    half = 60 / m.measured.per_minute / 4
    return m.measured.stroke_mm / 1000 / half**2


def wave(m: MillAndDie) -> float:
    """Return the amplitude by the Fourier integral over a turn, piece by piece."""
    k, total = m.measured.rank, 0.0
    for low, high, sign in ((0, 0.5, 1), (0.5, 1.5, -1), (1.5, 2, 1)):
        total += sign * quad(lambda at: math.cos(k * at), low * math.pi, high * math.pi)[0]
    return abs(total) / math.pi * push(m)


def way_mm(m: MillAndDie) -> float:
    """Return the amplitude in mm of the harmonic of the displacement."""
    per_second = m.measured.rank * 2 * math.pi * m.measured.per_minute / 60
    return 1000 * wave(m) / per_second**2


RIGHT: dict[str, Callable[[MillAndDie], float]] = {
    "09.1": step,
    "09.2": swings,
    "09.3": seen,
    "09.4": left,
    "09.5": wave,
}

SOURCE = {
    "09.1": 0.004 / 9**2 / 2 * 1e6,
    "09.2": math.sqrt(100 / 0.2547 * 386.0886 / 185) / (2 * math.pi) * 4,
    "09.3": 14,
    "09.4": 100 / (1 + 1 / 16),
    "09.5": 4 / math.pi * 0.1143 / 1**2 / 17,
}

SLIPS = [
    # The step of the readings.
    KnownSlip("09.1", "the error", lambda m: step(m) / 2, "half a step"),
    KnownSlip("09.1", "one reading off", lambda m: 2 * step(m), "single"),
    KnownSlip("09.1", "a neighbour off", lambda m: 4 * step(m), "neighbour"),
    KnownSlip("09.1", "root of six", lambda m: step(m) * 4 / math.sqrt(6), "random|mean square"),
    KnownSlip(
        "09.1",
        "mean squares",
        lambda m: m.measured.limit * between(m) ** 2 / math.sqrt(6) * math.sqrt(12) * 1e6,
        "random|mean square",
    ),
    KnownSlip("09.1", "no square", lambda m: step(m) / between(m), "squared"),
    KnownSlip("09.1", "a turn", lambda m: step(m) * m.measured.points**2, "whole turn"),
    KnownSlip("09.1", "in mm", lambda m: step(m) / 1000, "mm"),
    KnownSlip("09.1", "one degree", lambda m: step(m) * (m.measured.points / 360) ** 2, "degree"),
    KnownSlip("09.1", "in minutes", lambda m: step(m) / 3600, "minutes"),
    KnownSlip(
        "09.1",
        "radians for the time",
        lambda m: m.measured.limit * (2 * math.pi / m.measured.points) ** 2 / 2 * 1e6,
        "in rad",
    ),
    KnownSlip("09.1", "the lesson's", lambda m: m.measured.limit / 81 / 2 * 1e6, "lesson"),
    KnownSlip("09.1", "twice the time", lambda m: 4 * step(m), "doubled"),
    KnownSlip("09.1", "half the error", lambda m: step(m) / 4, "not half of it"),
    KnownSlip(
        "09.1",
        "as a fence",
        lambda m: step(m) * (m.measured.points / (m.measured.points - 1)) ** 2,
        "as many steps",
    ),
    # The swings in a turn.
    KnownSlip(
        "09.2",
        "parallel",
        lambda m: (
            math.sqrt(
                sum(m.measured.load_N / (g / 1000) for g in m.measured.gives_mm)
                / m.measured.mass_kg
            )
            / (2 * math.pi)
            * 60
            / m.measured.per_minute
        ),
        "side by side",
    ),
    KnownSlip(
        "09.2",
        "the softest",
        lambda m: swings(m) * math.sqrt(sum(m.measured.gives_mm) / max(m.measured.gives_mm)),
        "softest",
    ),
    KnownSlip("09.2", "N/mm", lambda m: swings(m) / math.sqrt(1000), "N/m"),
    KnownSlip("09.2", "without the softest", lambda m: of_two(m, max), "softest part was left"),
    KnownSlip("09.2", "without the stiffest", lambda m: of_two(m, min), "stiffest part was left"),
    KnownSlip("09.2", "rad", lambda m: swings(m) * 2 * math.pi, "rad a turn"),
    KnownSlip(
        "09.2",
        "rad a second",
        lambda m: swings(m) * 2 * math.pi * m.measured.per_minute / 60,
        "rad a second",
    ),
    KnownSlip("09.2", "a second", lambda m: swings(m) * m.measured.per_minute / 60, "a second"),
    KnownSlip(
        "09.2", "times rate", lambda m: swings(m) * (m.measured.per_minute / 60) ** 2, "multiplied"
    ),
    KnownSlip("09.2", "in minutes", lambda m: swings(m) / 60, "minute"),
    KnownSlip("09.2", "by g", lambda m: swings(m) * math.sqrt(9.81), r"\bg\b"),
    KnownSlip("09.2", "weight", lambda m: swings(m) / math.sqrt(9.81), "weight"),
    KnownSlip("09.2", "a minute", lambda m: swings(m) * m.measured.per_minute, "swings a minute"),
    KnownSlip("09.2", "upside down", lambda m: 1 / swings(m), "turns a swing"),
    KnownSlip(
        "09.2",
        "static deflection",
        lambda m: (
            math.sqrt(9.81 / (sum(m.measured.gives_mm) / 1000))
            / (2 * math.pi)
            * 60
            / m.measured.per_minute
        ),
        "under the weight",
    ),
    KnownSlip("09.2", "averaged", lambda m: swings(m) * math.sqrt(3), "averaged"),
    # What folds back.
    KnownSlip("09.3", "itself", lambda m: m.measured.folded[1], "limit"),
    KnownSlip("09.3", "once", lambda m: m.measured.folded[1] - m.measured.folded[0], "once more"),
    KnownSlip("09.3", "the limit", lambda m: m.measured.folded[0] / 2, "limit"),
    KnownSlip(
        "09.3", "above", lambda m: m.measured.folded[1] - m.measured.folded[0] / 2, "above the"
    ),
    KnownSlip(
        "09.3", "halves", lambda m: m.measured.folded[1] % (m.measured.folded[0] / 2), "Halves"
    ),
    KnownSlip("09.3", "added", lambda m: sum(m.measured.folded), "added"),
    KnownSlip("09.3", "the points", lambda m: m.measured.folded[0], "number of points"),
    KnownSlip("09.3", "downwards", lambda m: -seen(m), "sign"),
    # What a spline leaves.
    KnownSlip(
        "09.4",
        "squares",
        lambda m: (
            100
            / (1 + (100 / m.measured.left[1] - 1) * (m.measured.left[2] / m.measured.left[0]) ** 2)
        ),
        "square",
    ),
    KnownSlip(
        "09.4",
        "once",
        lambda m: (
            100 / (1 + (100 / m.measured.left[1] - 1) * m.measured.left[2] / m.measured.left[0])
        ),
        "once",
    ),
    KnownSlip(
        "09.4",
        "upside down",
        lambda m: (
            100
            / (1 + (100 / m.measured.left[1] - 1) * (m.measured.left[0] / m.measured.left[2]) ** 4)
        ),
        "upside",
    ),
    KnownSlip(
        "09.4",
        "proportion",
        lambda m: m.measured.left[1] * m.measured.left[0] / m.measured.left[2],
        "proportion",
    ),
    KnownSlip(
        "09.4",
        "proportion upside down",
        lambda m: m.measured.left[1] * m.measured.left[2] / m.measured.left[0],
        "^This is by simple proportion, upside down[^O]*$",
    ),
    KnownSlip("09.4", "the share scaled", scaled, "share itself"),
    KnownSlip("09.4", "taken away", lambda m: 100 - left(m), "taken away"),
    KnownSlip(
        "09.4",
        "read as taken",
        lambda m: (
            100
            / (
                1
                + (1 / (1 - m.measured.left[1] / 100) - 1)
                * (m.measured.left[2] / m.measured.left[0]) ** 4
            )
        ),
        "read as",
    ),
    KnownSlip("09.4", "the same", lambda m: m.measured.left[1], "other harmonic"),
    KnownSlip(
        "09.4",
        "no one",
        lambda m: (
            100 / (1 + 100 / m.measured.left[1] * (m.measured.left[2] / m.measured.left[0]) ** 4)
        ),
        "forgotten",
    ),
    KnownSlip(
        "09.4",
        "scaled",
        lambda m: 100 - (100 - m.measured.left[1]) * (m.measured.left[2] / m.measured.left[0]) ** 4,
        "scaled",
    ),
    KnownSlip("09.4", "one not added", lambda m: 100 / (100 / left(m) - 1), "not added"),
    KnownSlip("09.4", "a share", lambda m: left(m) / 100, "share of 1"),
    # The harmonic of the parabola.
    KnownSlip("09.5", "a second for a minute", lambda m: wave(m) * 3600, "turns a second"),
    KnownSlip("09.5", "the whole turn", lambda m: wave(m) / 4, "half of it"),
    KnownSlip("09.5", "2h/t²", lambda m: wave(m) / 2, "not twice: half the stroke"),
    KnownSlip("09.5", "counted twice", lambda m: wave(m) / 2, "four times"),
    KnownSlip("09.5", "counted once", lambda m: wave(m) / 4, "counted once"),
    KnownSlip("09.5", "the way in mm", way_mm, "displacement, in mm"),
    KnownSlip("09.5", "the cycloid's peak", lambda m: wave(m) * math.pi / 2, "cycloid"),
    KnownSlip("09.5", "no pi²", lambda m: wave(m) * math.pi**2, "pi²"),
    KnownSlip("09.5", "the push", push, "itself"),
    KnownSlip("09.5", "no 4/pi", lambda m: push(m) / m.measured.rank, "4/pi"),
    KnownSlip("09.5", "half", lambda m: wave(m) / 2, "half"),
    KnownSlip("09.5", "rank squared", lambda m: wave(m) / m.measured.rank, "once too often"),
    KnownSlip("09.5", "the first", lambda m: wave(m) * m.measured.rank, "first"),
    KnownSlip("09.5", "no Ca", lambda m: wave(m) / 4, "peak"),
    KnownSlip("09.5", "a quarter", lambda m: wave(m) * 4, "half a turn"),
    KnownSlip("09.5", "in mm", lambda m: 1000 * wave(m), "mm"),
    KnownSlip(
        "09.5",
        "the cycloid",
        lambda m: (
            16
            * m.measured.stroke_mm
            / 1000
            * (2 * math.pi * m.measured.per_minute / 60) ** 2
            / (math.pi**2 * (m.measured.rank**2 - 4))
        ),
        "cycloid",
    ),
    # The choice, each wrong option.
    KnownSlip("09.6", "a: five stronger", lambda _: "a", "damping"),
    KnownSlip("09.6", "b: the amplitude", lambda _: "b", "points"),
    KnownSlip("09.6", "d: finer", lambda _: "d", "half the angle"),
]
