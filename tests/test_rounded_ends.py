"""A table's own ends are rounded too: each position off by itself, and what A does is summed."""

import re
import warnings
from typing import Any

import numpy as np
import pytest
from machines import Array
from scipy.interpolate import CubicSpline

import cammotion as cm
from cammotion.exchange.law_text import law_as_text, law_from_text

ANGLES = np.arange(61.0)
X = ANGLES / 60
LIFT = 100 + np.round(50 * (X - np.sin(2 * np.pi * X) / (2 * np.pi)), 2)
STEP, SLIGHT = 0.01, 1e-4


def of_table(positions: Array, fit: Any, smoothing: float | None) -> cm.SampledLaw:
    with warnings.catch_warnings(action="ignore"):
        return cm.law_from_table(
            cm.CamTable(ANGLES, positions, step_mm=STEP), fit=fit, smoothing=smoothing
        )


@pytest.mark.parametrize("positions", [LIFT, LIFT[::-1]], ids=["rise", "return"])
@pytest.mark.parametrize(
    ("fit", "smoothing"),
    [("smooth", 1.3e-7), ("through", None), ("periodic", None), ("periodic", 1e-5)],
)
def test_the_first_and_the_last_position_are_rounded_too(
    positions: Array, fit: Any, smoothing: float | None
) -> None:
    shares = []
    for moved in SLIGHT * np.eye(61):
        more, less = (of_table(positions + by, fit, smoothing)(X, 2) for by in (moved, -moved))
        shares.append((more - less) / (2 * SLIGHT) * STEP / 2)
    bound = np.sum(np.abs(shares), axis=0).max()
    rms = np.sqrt(np.sum(np.square(shares), axis=0).max() / 3)
    law = of_table(positions, fit, smoothing)
    assert law.rounding == pytest.approx((STEP / 50, rms, bound), rel=1e-6)
    s = (positions - positions[0]) / (positions[-1] - positions[0])
    with warnings.catch_warnings(action="ignore"):
        exact = cm.law_from_points(X, s, fit=fit, smoothing=smoothing, step=law.step)
    assert exact.rounding.bound < bound


def test_a_monotone_law_of_a_table_is_shaken_at_its_ends_too() -> None:
    """Not less than what some roundings, all positions of them, do to PCHIP's own A."""
    rng, law = np.random.default_rng(4), of_table(LIFT, "monotone", None)
    worst = 0.0
    for errors in rng.uniform(-STEP / 2, STEP / 2, (40, 61)):
        worst = max(
            worst, np.abs(of_table(LIFT + errors, "monotone", None)(X, 2) - law(X, 2)).max()
        )
    assert law.rounding.bound > worst


def test_a_written_law_still_knows_that_its_ends_are_rounded() -> None:
    law = of_table(LIFT, "through", None)
    back: Any = law_from_text("table", law_as_text(law))
    assert back.rounding == pytest.approx(law.rounding)
    with warnings.catch_warnings(action="ignore"):
        points = cm.law_from_points(law.sampled_at, law.ways, step=law.step)
    assert points.rounding.rms < back.rounding.rms


@pytest.mark.parametrize("beside_deg", [0.0, 0.02, 0.1, 1.3])
def test_a_turn_close_to_a_point_shakes_no_more_than_others(beside_deg: float) -> None:
    """What is warned of is what single positions do to the acceleration of SciPy's spline."""
    angles = np.arange(0, 360, 3.0)
    lift = np.round(25 - 25 * np.cos(np.radians(angles - beside_deg)), 2)
    with pytest.warns(UserWarning, match="change the acceleration") as told:
        cm.motion_from_table("cam", cm.CamTable(angles, lift, step_mm=0.01, is_cycle=True))
    closed = np.append(angles, 360)
    units = np.vstack([np.eye(120), np.eye(120)[:1]])
    shares = CubicSpline(closed, units, bc_type="periodic")(angles, 2)
    bends = CubicSpline(closed, np.append(lift, lift[0]), bc_type="periodic")(angles, 2)
    share = 0.005 * np.abs(shares).sum(axis=1).max() / np.abs(bends).max()
    (said,) = re.findall(r"by up to (\d+)% of its peak", str(told[0].message))
    assert int(said) == pytest.approx(100 * share, abs=1)
