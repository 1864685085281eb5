"""A machine that makes a piece a minute has peaks of less than 0.001 m/s²: they are said, too."""

import re
from collections.abc import Callable, Iterator
from functools import cache
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot as plt

import cammotion as cm
from cammotion.quantities import in_decimals, outward
from cammotion.report.numbers import of_peak, of_rate, of_velocity

mpl.use("agg")

RULE, WORK = cm.EXAMPLE.rule, [(205, 305)]
STILL = {"mill": WORK, "die": WORK}
SLOW = cm.Machine("slow", cm.EXAMPLE.diagram, [RULE], STILL).at_rate(60)
FEWEST = 3  # digits
TIMES = 2000 / 60


@pytest.fixture(autouse=True)
def _close_figures() -> Iterator[None]:
    yield
    plt.close("all")


@cache
def least(jerk_m_per_s3: float = np.inf) -> cm.LeastAcceleration:
    asked: dict[str, Any] = {"still": WORK, "travel_mm": (0, 50), "cells": 90}
    return cm.least_acceleration(
        SLOW.diagram, "die", RULE, jerk_m_per_s3=jerk_m_per_s3 / TIMES**3, **asked
    )


@cache
def both(limit: float) -> cm.LeastPeak:
    asked: dict[str, Any] = {"still": STILL, "travel_mm": {"die": (0, 50)}, "gap": 0.1}
    at_most = {"mill": limit / TIMES**2}
    return cm.least_peak(SLOW.diagram, RULE, weights={"mill": 0}, at_most=at_most, **asked)


TEXTS: dict[str, Callable[[], object]] = {
    "bound": least,
    "both": lambda: both(0.6123),
    "optimised": lambda: cm.optimise(SLOW.diagram, RULE, still=STILL),
    "advice": lambda: cm.improvements(SLOW),
    "hardest": lambda: cm.improvements(SLOW).hardest,
    "rows": lambda: [f"{cell} m/s²" for cell in cm.improvements(SLOW)[0].row[1:4]],
    "formula": lambda: of_peak(SLOW.diagram, "die"),
    "velocity": lambda: of_velocity(SLOW.diagram, "mill"),
    "overlap": lambda: sentences(cm.explore_overlap(SLOW.diagram, RULE, contact_mm=23)),
    "ways": lambda: sentences(cm.explore_ways(SLOW.diagram, RULE)),
    "shares": lambda: sentences(cm.explore_shares(SLOW.diagram)),
    "measured": lambda: sentences(cm.explore_measured(measured(), SLOW.diagram.rate_per_hour)),
    "measured in inches": lambda: sentences(
        cm.explore_measured(measured(), SLOW.diagram.rate_per_hour, unit="in")
    ),
}


def measured() -> cm.CamTable:
    angles = np.arange(0.0, 360, 10)
    return cm.CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), 0.01, is_cycle=True)


def sentences(figure: Any) -> str:
    return str(figure.text)


@pytest.mark.parametrize("name", TEXTS)
def test_a_slow_peak_keeps_its_digits(name: str) -> None:
    text = str(TEXTS[name]())
    said = re.findall(r"([\d.e−-]+)(?=(?: \(before.*\))? m/s)", text)
    assert said, text
    for number in said:
        assert len(number.partition("e")[0].replace(".", "").lstrip("−0")) >= FEWEST, text


@pytest.mark.parametrize("size", [1.0, 4e-4])
def test_the_gap_that_was_asked_for_is_reached_however_slow_and_small(size: float) -> None:
    """A stroke of 0.02 mm at 30 pieces/h: its peak of 6e-8 m/s² was taken for none at all."""
    mill = cm.indexing_motion("mill", cm.rise(100 * size, over_deg=150), cm.dwell(210), stops=24)
    up, down = (make(50 * size, over_deg=55) for make in (cm.rise, cm.return_))
    die = cm.motion("die", up, cm.dwell(100), down, cm.dwell(150), start_deg=150)
    rule = cm.ClearanceRule(cm.beyond("die", 19 * size), only_while=cm.within("mill", 0.65 * size))
    slow = cm.TimingDiagram([mill, die], 30)
    travel = {"die": (0.0, 50 * size)}
    found = cm.least_peak(slow, rule, still=STILL, travel_mm=travel, gap=0.05)
    assert 0 < found.gap <= 0.05
    assert found.gap == pytest.approx(1 - found.bound / found.reached)


def test_two_values_are_rounded_away_from_what_is_between_them() -> None:
    rng = np.random.default_rng(7)
    for low in 10.0 ** rng.uniform(-9, 3, 2000):
        high = low * (1 + rng.uniform(0, 0.1))
        least, most = map(float, outward(low, high))
        assert least <= low <= high <= most
        assert all(len(text) <= len("0.0001234") for text in outward(low, high))
        assert most - least <= high - low + 2.2e-3 * max(high, 0.1)


def test_decimals_become_digits_below_a_tenth() -> None:
    rng = np.random.default_rng(8)
    for value in 10.0 ** rng.uniform(-9, 3, 2000):
        near = float(in_decimals(value, 3))
        assert abs(near - value) <= (5.0001e-4 if value >= 0.1 else 5.0001e-3 * value)


def test_a_slow_rate_keeps_its_digits() -> None:
    """At two and a half pieces an hour a whole number may be off by a fifth."""
    (one, *_) = cm.improvements(SLOW.at_rate(2.5))
    formula = of_rate(2.5, one.before, one.largest)
    for said in (one.row[-1], formula.rpartition("= ")[2].split()[0]):
        assert float(said) == pytest.approx(one.rate_per_hour, rel=5e-3)


def test_the_axes_of_a_slow_bound_are_about_what_is_drawn() -> None:
    """As many of the machine's own units as the lesson's picture has of its."""
    jerk = cm.plot_jerk_price([least(8), least(12)], unlimited_m_per_s2=0.55 / TIMES**2)
    front = cm.plot_front([both(0.5), both(0.6)])
    for ax in (jerk, front):
        low, high = np.array(ax.get_ylim())
        drawn = np.concatenate([line.get_ydata() for line in ax.lines[:1]])
        assert low <= drawn.min() < drawn.max() <= high
        assert high <= 2.5 * drawn.max()
    assert jerk.get_ylim()[0] < 0.55 / TIMES**2
    assert f"jerk without limit: {0.55 / TIMES**2:.3g}" in {text.get_text() for text in jerk.texts}
