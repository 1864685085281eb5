"""What the exercises on laws and limits say is true: integrated, or bounded, without the package.

Bounds come from a linear program: a divided difference of second order is a mean of the
acceleration between its places, so no motion has a smaller peak than the least largest of them.
"""

import re
from itertools import pairwise

import numpy as np
import pytest
import sympy
from judging import MACHINES
from known_slips import die, later, place, stroke, time
from known_slips_laws import half_turn, hard, least, up
from scipy.optimize import linprog

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.lessons import EXERCISES, lesson_05, lesson_06
from cammotion.teaching.variants import machine_for

PLACES = np.linspace(0, 1, 40_001)
FEW = [EXAMPLE, *(machine_for(f"limit {n}") for n in range(20))]
BRAKED = [m for m in FEW if later(m) > half_turn(m) / 2]
PUSHED = [m for m in FEW if later(m) <= half_turn(m) / 2]


def integral(curve: Floats, places: Floats = PLACES) -> Floats:
    """Return the integral of a curve from the first place on, by trapezia."""
    steps = (curve[1:] + curve[:-1]) / 2 * np.diff(places)
    return np.concatenate([[0.0], np.cumsum(steps)])


def modified_sine() -> tuple[Floats, float]:
    """Return displacement and peak, from the three parts of the acceleration alone."""
    x = PLACES
    shape = np.select(
        [x < 1 / 8, x < 7 / 8],
        [np.sin(4 * np.pi * x), np.cos(4 * np.pi / 3 * (x - 1 / 8))],
        -np.cos(4 * np.pi * (x - 7 / 8)),
    )
    way = integral(integral(shape))
    return way / way[-1], 1 / way[-1]


def test_the_overlapped_modified_sine_is_that_of_its_integrated_acceleration() -> None:
    curve, peak = modified_sine()
    assert peak == pytest.approx(4 * np.pi**2 / (4 + np.pi), rel=1e-6)
    for m in MACHINES:
        deep = (m.wait_mm - m.margin_mm) / stroke(m)
        x = place(deep, lambda x: float(np.interp(x, PLACES, curve)))
        right = hard(m, later(m) / (1 - x), peak)
        assert EXERCISES["05.5"].solution(m) == pytest.approx(right, rel=1e-6)


@pytest.mark.parametrize("p", [0, 0.1, 0.37, 0.5, 0.9])
@pytest.mark.parametrize("law", ["cycloid", "triangle"])
def test_a_line_in_the_middle_of_an_integrated_law(p: float, law: str) -> None:
    """Both laws are fastest in the middle, with twice their mean velocity."""
    squeezed = np.minimum(PLACES, 1 - PLACES) / (1 - p) if p < 1 else PLACES
    fast = squeezed >= 1 / 2  # along the line
    velocity = {"cycloid": (1 - np.cos(2 * np.pi * squeezed)) / 2, "triangle": 2 * squeezed}[law]
    way = integral(np.where(fast, 1, velocity))[-1]
    assert float(EXERCISES["05.4"].solution(EXAMPLE).subs("p", p)) == pytest.approx(1 / way, 1e-7)


@pytest.mark.parametrize("r", [0.001, 0.05, 0.125, 0.2, 0.25])
def test_the_peak_of_a_law_of_straight_ramps_by_integration(r: float) -> None:
    y = np.where(PLACES <= 1 / 2, PLACES, 1 - PLACES)  # measured from the nearer end
    shape = np.clip(np.minimum(y, 1 / 2 - y) / r, 0, 1) * np.where(PLACES <= 1 / 2, 1, -1)
    velocity = integral(shape)
    way = integral(velocity)[-1]
    assert velocity[-1] == pytest.approx(0, abs=1e-12)
    assert velocity.max() / way == pytest.approx(2, 1e-6)
    right = float(EXERCISES["06.2"].solution(EXAMPLE).subs("r", r))
    assert right == pytest.approx(1 / way, 1e-6)


def test_sixteen_thirds_is_the_peak_with_ramps_of_an_eighth() -> None:
    exercise = EXERCISES["06.2"]
    assert exercise.solution(EXAMPLE).subs("r", sympy.Rational(1, 8)) == sympy.Rational(16, 3)
    assert "With r = 1/8 it is 16/3" in exercise.right


def means(places: Floats, *, rests_at_end: bool) -> Floats:
    """Return, as rows, means of the acceleration of a motion that rests at its first place.

    They apply to the positions at all places but the first, where the motion is at 0.
    """
    slopes = np.diff(np.eye(len(places)), axis=0) / np.diff(places)[:, None]
    widths = np.diff(places)
    rows = [2 * slopes[0] / widths[0]]
    rows += [
        2 * (after - before) / (one + other)
        for (before, after), (one, other) in zip(pairwise(slopes), pairwise(widths), strict=True)
    ]
    if rests_at_end:
        rows.append(-2 * slopes[-1] / widths[-1])
    return np.array(rows)[:, 1:]


def bound(rows: Floats, low: Floats, high: Floats) -> float:
    """Return the least largest size of the rows, the positions being between two limits."""
    count = rows.shape[1]
    both = np.vstack([rows, -rows])
    solved = linprog(
        np.append(np.zeros(count), 1),
        A_ub=np.column_stack([both, -np.ones(len(both))]),
        b_ub=np.zeros(len(both)),
        bounds=[*zip(low, high, strict=True), (0, None)],
    )
    assert solved.success
    return float(solved.fun)


def bound_of_law(*, rests_at_end: bool) -> float:
    """Return what no law from rest can be below in Ca."""
    places = np.linspace(0, 1, 81)
    low, high = np.full(80, -np.inf), np.full(80, np.inf)
    low[-1] = high[-1] = 1
    return bound(means(places, rests_at_end=rests_at_end), low, high)


def test_no_hammer_has_a_smaller_factor_and_no_move_to_rest() -> None:
    hammer, to_rest = bound_of_law(rests_at_end=False), bound_of_law(rests_at_end=True)
    assert EXERCISES["06.1"].solution(EXAMPLE) == pytest.approx(hammer, rel=1e-6)
    assert EXERCISES["05.1"].solution(EXAMPLE) == pytest.approx(
        hard(EXAMPLE, die(EXAMPLE), to_rest), rel=1e-6
    )


def bound_of_die(m: MillAndDie, travel_mm: float = np.inf) -> float:
    """Return what no motion of the die can be below in m/s², over both ways and without symmetry.

    It leaves the bottom at rest and comes back to rest there, and is high enough from the first
    angle on to as long before the end. That it turns round in the middle is not asked for.
    """
    turn, first = half_turn(m), later(m)
    places = np.unique([*np.linspace(0, 2 * turn, 121), first, 2 * turn - first])
    inner = places[1:]
    low = np.where((inner >= first) & (inner <= 2 * turn - first), up(m), -np.inf)
    high = np.full(len(inner), travel_mm)
    low[-1] = high[-1] = 0
    unit = half_turn(m)  # so that the program has numbers of a size
    found = bound(means(places / unit, rests_at_end=True), low, high)
    return found / 1000 / time(m, unit) ** 2


def test_machines_of_both_kinds_are_tried() -> None:
    assert len(BRAKED) >= 5
    assert len(PUSHED) >= 5


@pytest.mark.parametrize("m", [*BRAKED[:6], *PUSHED[:6]], ids=lambda m: m.who or "source")
def test_no_motion_of_the_die_can_do_with_less_and_the_one_of_the_question_does(
    m: MillAndDie,
) -> None:
    """Also where the first angle comes before the brake: then the push alone decides."""
    right = EXERCISES["06.3"].solution(m)
    below = bound_of_die(m)
    assert 0.995 * right <= below <= right * (1 + 1e-7)
    seconds = np.linspace(0, time(m, half_turn(m)), 20_001)
    pushed = seconds < seconds[-1] / 2
    speed = right * np.where(pushed, seconds, seconds[-1] - seconds)
    height = 1000 * integral(speed, seconds)
    at = np.searchsorted(seconds, time(m, later(m)))
    assert speed[-1] == 0
    assert height[at:].min() >= up(m) * (1 - 1e-3)
    assert np.interp(time(m, later(m)), seconds, height) == pytest.approx(up(m), rel=1e-6)


def test_where_the_push_alone_decides_the_least_peak_is_that_of_a_push_to_the_first_angle() -> None:
    for m in PUSHED:
        assert EXERCISES["06.3"].solution(m) == pytest.approx(hard(m, later(m), 2, up(m)))
    for m in BRAKED:
        assert EXERCISES["06.3"].solution(m) > 1.0001 * hard(m, later(m), 2, up(m))


def test_the_two_numbers_of_the_last_exercise_hold_the_least_peak_with_limited_travel() -> None:
    low, high = (float(number) for number in re.findall(r"0\.\d+", _question("06.6")))
    x = np.sqrt(0.38 / 2)  # where 19 of 50 mm are made by a constant acceleration
    built = hard(EXAMPLE, later(EXAMPLE) / (1 - x), 4)
    assert low <= built <= high
    assert least(EXAMPLE) < 0.999 * low
    assert 0.997 * low <= bound_of_die(EXAMPLE, travel_mm=50) <= built


def _question(number: str) -> str:
    return EXERCISES[number].question(EXAMPLE)


def test_the_force_of_the_servo_by_its_energy() -> None:
    """A second with 0.6 m/s² from rest: what the force has worked is in die, motor and screw."""
    for m in MACHINES:
        speed, way = 0.6, 0.3
        turning = 2 * np.pi * speed / (lesson_06.SCREW_LEAD_MM / 1000)
        energy = m.die_mass_kg * speed**2 / 2 + lesson_06.MOTOR_INERTIA * turning**2 / 2
        assert EXERCISES["06.5"].solution(m) == pytest.approx(energy / way)
        assert EXERCISES["06.5"].solution(m) > 2 * 0.6 * m.die_mass_kg  # most is for the motor


def test_the_modified_trapezoid_is_the_best_named_law_without_a_jump() -> None:
    smooth = {name: float(law.Ca) for name, law in cm.LAWS.items() if np.isfinite(float(law.Cj))}
    assert min(smooth, key=lambda name: smooth[name]) == "modified trapezoid"
    jerks = [round(float(cm.LAWS[name].Cj)) for name in ("modified trapezoid", "cycloidal")]
    assert "Cj is {} in place of {}".format(*jerks) in EXERCISES["05.2"].right


def test_with_the_jerk_of_the_modified_trapezoid_straight_ramps_gain_little() -> None:
    """As notebook 06 and the answer to 05.2 say."""
    ca, jerk = (float(getattr(cm.LAWS["modified trapezoid"], name)) for name in ("Ca", "Cj"))
    r = sympy.Symbol("r")
    ramped = EXERCISES["06.2"].solution(EXAMPLE)
    best = min(
        float(ramped.subs(r, ramp)) for ramp in sympy.solve(ramped / r - sympy.nsimplify(jerk), r)
    )
    assert 1.02 < ca / best < 1.04


def test_no_common_slip_is_taken_as_right_with_the_numbers_of_the_source() -> None:
    for exercise in (*lesson_05.EXERCISES, *lesson_06.EXERCISES):
        for slip in getattr(exercise, "slips", ()):
            assert exercise.judge(slip.answer(EXAMPLE), EXAMPLE).state == "wrong", slip.reason


@pytest.mark.parametrize("m", FEW[:6], ids=lambda m: m.who or "source")
def test_the_cycloid_is_compared_with_the_least_peak(m: MillAndDie) -> None:
    x = place((m.wait_mm - m.margin_mm) / stroke(m), lambda x: _cycloid(x))
    peak = hard(m, later(m) / (1 - x), 2 * np.pi)
    assert EXERCISES["06.4"].solution(m) == pytest.approx(peak / least(m), rel=1e-6)


def _cycloid(x: float) -> float:
    """Return the share of the way by the cycloid, its velocity integrated."""
    places = np.linspace(0, x, 20_001)
    return float(integral(1 - np.cos(2 * np.pi * places), places)[-1])
