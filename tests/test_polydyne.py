"""A cam designed backwards, against the equation and a solver that steps through it."""

import math
from typing import Any

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

import cammotion as cm

SMOOTH = "4-5-6-7 polynomial"
COEFFICIENTS = {5: 126, 6: -420, 7: 540, 8: -315, 9: 70}
SMOOTHER = cm.MotionLaw(
    "5-6-7-8-9 polynomial", sum(factor * cm.x**n for n, factor in COEFFICIENTS.items())
)
WAVES = cm.MotionLaw(
    "two waves",
    cm.x - (4 * sp.sin(2 * sp.pi * cm.x) / 3 - sp.sin(4 * sp.pi * cm.x) / 6) / (2 * sp.pi),
)


@pytest.mark.parametrize("law", [SMOOTH, SMOOTHER, WAVES])
@pytest.mark.parametrize(("swings", "ratio"), [(0.8, 0.0), (3.0, 0.05), (12.0, 0.4)])
def test_the_equation_holds(law: Any, swings: float, ratio: float) -> None:
    made, w = cm.polydyne(law, swings, ratio), 2 * math.pi * swings
    at = np.linspace(0, 1, 401)
    y, rate, bend = (made.mass(at, n) for n in range(3))
    left = bend + 2 * ratio * w * (rate - made.cam(at, 1)) + w**2 * (y - made.cam(at))
    assert np.abs(left).max() < 1e-8 * (w**2 + made.cam.Ca)
    for each in (made.cam, made.mass):
        assert each.curve.ends == pytest.approx((0, 1), abs=1e-10)
        assert each([0, 1], 1) == pytest.approx([0, 0], abs=1e-8)
    if ratio == 0:
        assert y == pytest.approx(made.law(at), abs=1e-12)


def test_the_mass_makes_it_and_rests_and_at_another_rate_it_does_not() -> None:
    made, w = cm.polydyne(SMOOTH, 2.5, 0.03), 5 * math.pi

    def after(factor: float) -> float:
        faster = w / factor

        def rates(at: float, state: Any) -> list[float]:
            cam, slope = (float(made.cam(min(at, 1.0), n)) for n in range(2))
            pull = 2 * 0.03 * faster * (slope - state[1]) + faster**2 * (cam - state[0])
            return [state[1], pull]

        ran = solve_ivp(rates, (0, 1), [0, 0], rtol=1e-10, atol=1e-12)
        return math.hypot(ran.y[0, -1] - 1, ran.y[1, -1] / faster)

    assert after(1) < 1e-8
    assert after(1.2) > 5e-3
    mass = made.at_rate(1.2)
    ends = mass(1.0) - 1, mass(1.0, 1) / (w / 1.2)
    assert math.hypot(*ends) == pytest.approx(after(1.2), rel=1e-6)


def test_in_closed_form() -> None:
    made = cm.polydyne(SMOOTH, 2)
    law = cm.LAWS[SMOOTH]
    assert sp.expand(made.cam.s - law.s - law.a / (16 * sp.pi**2)) == 0
    assert sp.expand(made.mass.s - law.s) == 0
    assert made.at_rate(1).peak == pytest.approx(law.Ca, rel=1e-6)
    assert (made.swings, made.damping_ratio, made.law) == (2, 0, law)


def test_a_stiff_follower_needs_no_other_cam() -> None:
    made = cm.polydyne(SMOOTH, 900)
    at = np.linspace(0, 1, 101)
    assert made.cam(at) == pytest.approx(made.law(at), abs=1e-6)


def test_the_cam_is_a_law_like_others() -> None:
    cam = cm.polydyne(SMOOTH, 3).cam
    motion = cm.motion("f", cm.rise(20, over_deg=90, law=cam), cm.dwell(60),
                       cm.return_(20, over_deg=90, law=cam), cm.dwell(120))  # fmt: skip
    prime = cm.smallest_prime_radius(motion, cm.TranslatingRoller(8))
    assert cm.RollerCam(motion, cm.TranslatingRoller(8), prime).undercuts == ()
    assert math.isinf(cam.Cj)  # its acceleration jumps, as the law's fourth derivative does
    assert math.isfinite(cm.polydyne(SMOOTHER, 3).cam.Cj)


def test_a_jump_that_is_rounding_is_none() -> None:
    x, off = cm.x, 1e-10
    s = 35 * x**4 - 84 * x**5 + 70 * x**6 - 20 * (1 + off) * x**7
    rounded = cm.MotionLaw("rounded", s / (1 - 20 * off))
    assert 0 < abs(float(rounded.j.subs(x, 1))) < 1e-6
    assert cm.polydyne(rounded, 3).cam.Ca == pytest.approx(cm.polydyne(SMOOTH, 3).cam.Ca)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("cycloidal", 3), "jerk of the law 'cycloidal' jumps at x = 0, .* in its velocity"),
        (("3-4-5 polynomial", 3), "jerk of .* as smooth as the '4-5-6-7 polynomial'"),
        (("modified trapezoid", 3), "jerk of"),
        (("constant acceleration", 3), "acceleration of the law .* would have to jump itself"),
        ((cm.MotionLaw("line", cm.x), 3), "velocity of the law 'line' jumps .* infinitely high"),
        ((cm.MotionLaw("half", cm.x / 2), 3), "goes from"),
        ((SMOOTH, 0), "period ratio .* is 0"),
        ((SMOOTH, 3, 1.5), "damping ratio is 1.5"),
        (("nothing", 3), "no motion law 'nothing'"),
    ],
)
def test_what_is_refused(given: tuple[Any, ...], words: str) -> None:
    with pytest.raises(cm.InputError, match=words):
        cm.polydyne(*given)
    with pytest.raises(cm.InputError, match="factor of the rate"):
        cm.polydyne(SMOOTH, 3).at_rate(0)
