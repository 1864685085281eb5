"""Where a push brings the die, as it is said and drawn, is where adding it up twice brings it."""

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from known_slips import die, later, stroke, time, told, widest
from machines import Array
from shown import curve, texts, wrong

from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.shown.frame import Shown
from cammotion.teaching.shown.ways import peak_of_die

SHAPES: dict[str, Callable[[Array], Any]] = {
    "cycloidal": lambda x: np.sin(2 * np.pi * x),
    "constant": lambda x: np.where(x < 0.5, 1.0, -1.0),
    "modified sine": lambda x: np.where(
        np.minimum(x, 1 - x) < 1 / 8,
        np.sin(4 * np.pi * np.minimum(x, 1 - x)) * np.sign(0.5 - x),
        np.cos((x - 1 / 8) * 4 * np.pi / 3),
    ),
}
"""Accelerations over the time with a peak of 1, written out."""


def pushed_mm(peak: float, time_s: float, shape: str) -> float:
    """Return how far a push brings the die, by adding it up twice."""
    count = 4000
    x = (np.arange(count) + 0.5) / count
    velocity = np.cumsum(SHAPES[shape](x))
    return float(peak * time_s**2 * np.sum(velocity) / count**2 * 1000)


def widest_by(machine: MillAndDie, shape: str) -> float:
    """Return the widest angle with a law, from its acceleration."""
    x = (np.arange(20000) + 0.5) / 20000
    way = np.cumsum(np.cumsum(SHAPES[shape](x)))
    at = np.interp((machine.wait_mm - machine.margin_mm) / stroke(machine), way / way[-1], x)
    return float(later(machine) / (1 - at))


def cycloid_peak(machine: MillAndDie, angle: float, way_mm: float) -> float:
    return 2 * math.pi * way_mm / 1000 / time(machine, angle) ** 2


def least(machine: MillAndDie) -> float:
    """Return the least peak of 06.3, by adding up a push of 1 m/s²."""
    return (stroke(machine) - machine.wait_mm + machine.margin_mm) / risen_mm(machine, 1.0)


def risen_mm(machine: MillAndDie, peak: float) -> float:
    """Return how far an even push and brake have brought the die up when the mill gets going."""
    whole, count = (360 - machine.work_deg) / 2, 40000
    at = (np.arange(count) + 0.5) / count * later(machine)
    push = np.where(at < whole / 2, peak, -peak)
    step = time(machine, later(machine)) / count
    return float(np.sum(np.cumsum(push)) * step**2 * 1000)


PUSHES: dict[str, Callable[[MillAndDie, float], tuple[float, float, str]]] = {
    "01.3": lambda m, a: (
        a * cycloid_peak(m, m.mill_angle_deg, m.pitch_mm),
        time(m, die(m)),
        "cycloidal",
    ),
    "02.1": lambda m, a: (a, time(m, die(m)), "cycloidal"),
    "02.3": lambda m, a: (a / m.die_mass_kg, time(m, die(m)), "cycloidal"),
    "02.4": lambda m, a: (
        a * cycloid_peak(m, die(m), stroke(m)),
        time(m, die(m)) * m.rate_per_hour / (m.rate_per_hour + 400),
        "cycloidal",
    ),
    "03.5": lambda m, a: (
        cycloid_peak(m, die(m), stroke(m)) / a,
        time(m, widest(m)),
        "cycloidal",
    ),
    "05.1": lambda m, a: (a, time(m, die(m)), "constant"),
    "05.5": lambda m, a: (a, time(m, widest_by(m, "modified sine")), "modified sine"),
    "06.4": lambda m, a: (a * least(m), time(m, told(m)), "cycloidal"),
}
"""Of an answer the peak that it leads to, the time of the move, and its law, by hand."""


@pytest.mark.parametrize("number", PUSHES)
def test_a_push_brings_the_die_where_the_line_says(number: str) -> None:
    said = set()
    for machine, answer, shown in wrong(number):
        way, whole = pushed_mm(*PUSHES[number](machine, answer)), stroke(machine)
        where = {
            "hardly leaves": (-math.inf, 0.02 * whole),
            "above the mill": (0.02 * whole, machine.wait_mm),
            "in the pocket": (machine.wait_mm, whole),
            "in the gap": (whole, whole + machine.gap_mm),
            "through the floor": (whole + machine.gap_mm, math.inf),
        }
        (words,) = [words for words in where if words in shown.line]
        assert where[words][0] - 1e-2 <= way <= where[words][1] + 1e-2, shown.line
        if abs(way - 2 * whole) > 1e-2:
            assert ("more than twice" in shown.line) == (way > 2 * whole)
        assert_curve_ends_at(shown, machine, way)
        said.add(words)
    assert len(said) >= 3


def assert_curve_ends_at(shown: Shown, machine: MillAndDie, way_mm: float) -> None:
    points = curve(shown)
    rim = next(float(text.attrib["y"]) - 4 for text in texts(shown) if "rim" in str(text.text))
    px_per_mm = (rim - points[0, 1]) / machine.wait_mm
    drawn = (points[-1, 1] - points[0, 1]) / px_per_mm
    assert drawn == pytest.approx(min(way_mm, 1.5 * stroke(machine)), abs=0.5)


def test_a_push_up() -> None:
    for machine, answer, shown in wrong("06.3"):
        depth = stroke(machine) - risen_mm(machine, answer)
        limit = machine.wait_mm - machine.margin_mm
        if min(abs(depth - machine.wait_mm), abs(depth - limit)) < 0.01:
            continue  # the sum is no better than that
        assert ("it strikes" in shown.line) == (depth > machine.wait_mm)
        assert ("less than the margin" in shown.line) == (limit < depth <= machine.wait_mm)
        assert ("farther out" in shown.line) == (depth < limit)
        if found := re.search(r"([\d.]+) mm below", shown.line):
            assert depth - machine.wait_mm == pytest.approx(
                float(found.group(1)), rel=0.06, abs=0.01
            )


def test_what_is_off_by_a_millionth_of_the_stroke_is_not_told() -> None:
    time_s = EXAMPLE.die_angle_deg / 360 * 3600 / EXAMPLE.rate_per_hour
    peak = 2 * math.pi * EXAMPLE.stroke_mm / 1000 / time_s**2  # the cycloid's
    for times, is_told in ((1 - 0.9e-6, False), (1 + 0.9e-6, False), (1 - 2e-6, True)):
        shown = peak_of_die()(EXAMPLE, times * peak)
        assert shown
        assert ("just where it has to press" not in shown.line) == is_told
