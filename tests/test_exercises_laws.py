"""What the exercises on laws and limits say is true: integrated, or bounded, without the package.

Bounds come from a linear program: a divided difference of second order is a mean of the
acceleration between its places, so no motion has a smaller peak than the least largest of them.
"""

import re
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import sympy
from judging import MACHINES
from known_slips import die, later, place, stroke, time
from known_slips_laws import half_turn, hard, least, to_rest, up
from long_arrays import assert_near
from scipy.optimize import linprog

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.law_numbers import LawNumbers
from cammotion.teaching.lessons import EXERCISES, lesson_05, lesson_06
from cammotion.teaching.variants import LAW_CHOICES, NAMELESS, machine_for

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


@pytest.mark.parametrize("powers", [EXAMPLE.laws.powers, *LAW_CHOICES["powers"]])
def test_each_law_to_differentiate_rests_at_both_ends_and_jumps_at_its_hardest_braking(
    powers: tuple[int, int],
) -> None:
    m = with_laws(powers=powers)
    written = EXERCISES["02.2"].question(m).split("$")[1].removeprefix("h = h_m ")
    x, law = PLACES, PLACES ** np.array(powers)[:, None]
    low, high = powers
    curve = (high * law[0] - low * law[1]) / (high - low)
    assert eval_latex(written, 0.3) == pytest.approx(np.interp(0.3, x, curve), 1e-6)
    velocity = np.gradient(curve, x, edge_order=2)
    assert (curve[0], curve[-1]) == (0, 1)
    assert velocity[[0, -1]] == pytest.approx(0, abs=1e-4)
    t, h_m, t_m = sympy.symbols("t h_m t_m")
    given = sympy.lambdify(t, EXERCISES["02.2"].solution(m).subs({h_m: 1, t_m: 1}))(x)
    assert_near(np.gradient(velocity, x)[50:-50], given[50:-50], abs=1e-2)
    assert np.abs(given).argmax() == len(x) - 1 or powers == (2, 3)
    assert given[-1] == pytest.approx(-low * high) == pytest.approx(-np.abs(given).max())
    assert "jump, from its hardest braking" in EXERCISES["02.2"].right


def eval_latex(formula: str, x: float) -> float:
    """Return the value of a sum of two powers as it is written in a question."""
    top = re.search(r"(\d*)x\^(\d) - (\d*)x\^(\d)", formula)
    assert top
    first, low, second, high = (int(number or 1) for number in top.groups())
    over = re.search(r"\\frac\{.*\}\{(\d)\}$", formula)
    assert formula.startswith("\\frac" if over else "\\left(")
    return (first * x**low - second * x**high) / (int(over[1]) if over else 1)


def with_laws(**numbers: Any) -> MillAndDie:
    """Return the machine of the source with other numbers for the exercises on laws."""
    return MillAndDie(laws=LawNumbers(**numbers))


@pytest.mark.parametrize("p", [0, 0.1, 0.37, 0.5, 0.9])
@pytest.mark.parametrize("fastest", [2, *LAW_CHOICES["fastest"]])
def test_a_line_in_the_middle_of_an_integrated_law(p: float, fastest: float) -> None:
    """A power of the time has the mean that is asked for; so has the cycloid, with 2."""
    squeezed = np.minimum(PLACES, 1 - PLACES) / (1 - p)
    along = squeezed >= 1 / 2  # the line
    shapes = [(2 * squeezed) ** (fastest - 1)]
    if fastest == 2:
        shapes.append((1 - np.cos(2 * np.pi * squeezed)) / 2)
    answer = EXERCISES["05.4"].solution(with_laws(fastest=fastest))
    for velocity in shapes:
        way = integral(np.where(along, 1, velocity))[-1]
        assert float(answer.subs("p", p)) == pytest.approx(1 / way, 1e-5)


@pytest.mark.parametrize("r", [0.001, 0.05, 0.1, 0.125])
@pytest.mark.parametrize("pause", [0, *LAW_CHOICES["pause"]])
def test_the_peak_of_a_law_of_straight_ramps_by_integration(r: float, pause: float) -> None:
    y = np.where(PLACES <= 1 / 2, PLACES, 1 - PLACES)  # measured from the nearer end
    push = (1 - pause) / 2
    shape = np.clip(np.minimum(y, push - y) / r, 0, 1) * np.where(PLACES <= 1 / 2, 1, -1)
    velocity = integral(shape)
    way = integral(velocity)[-1]
    assert velocity[-1] == pytest.approx(0, abs=1e-12)
    right = float(EXERCISES["06.2"].solution(with_laws(pause=pause)).subs("r", r))
    assert right == pytest.approx(1 / way, 1e-4)


def test_sixteen_thirds_is_the_peak_with_ramps_of_an_eighth() -> None:
    exercise = EXERCISES["06.2"]
    assert exercise.solution(EXAMPLE).subs("r", sympy.Rational(1, 8)) == sympy.Rational(16, 3)
    assert exercise.judge(sympy.sympify("4/(1 - 2*r)"), EXAMPLE).state == "right"
    assert "Without a pause in the middle it is 4/(1 - 2r)." in exercise.right


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


def bound_of_law(*, rests_at_end: bool, head_start: float = 0) -> float:
    """Return what no law can be below in Ca that sets off from rest, or with a velocity.

    Without the way that this velocity makes a law is one from rest, with the same acceleration.
    """
    places = np.linspace(0, 1, 81)
    low, high = np.full(80, -np.inf), np.full(80, np.inf)
    low[-1] = high[-1] = 1 - head_start
    return bound(means(places, rests_at_end=rests_at_end), low, high)


@pytest.mark.parametrize("head_start", [0, *LAW_CHOICES["head_start"]])
def test_no_hammer_has_a_smaller_factor_whatever_velocity_it_sets_off_with(
    head_start: float,
) -> None:
    least = EXERCISES["06.1"].solution(with_laws(head_start=head_start))
    below = bound_of_law(rests_at_end=False, head_start=head_start)
    assert least == pytest.approx(below, rel=1e-6)
    velocity = head_start + integral(np.full(len(PLACES), least))  # and this hammer has it
    assert integral(velocity)[-1] == pytest.approx(1)


@pytest.mark.parametrize("start", [0, *LAW_CHOICES["head_start"]])
def test_to_have_to_stop_costs_a_hammer_at_least_as_much_again(start: float) -> None:
    """Pushed up to some moment and then braked as hard, it comes to rest and has made the way."""
    turn = np.roots([2 * start, -4, 2 - start]).min()
    fastest = 2 - start * turn
    peak = fastest / (1 - turn)
    assert (fastest - start) / turn == pytest.approx(peak)
    assert peak >= 2 * EXERCISES["06.1"].solution(with_laws(head_start=start)) - 1e-9


def least_to_rest(start: float, cells: int = 400) -> float:
    """Return the least peak from a velocity to rest, over a way and a time of 1.

    The push is even in each cell of the time; what is pushed early takes part in more of the way.
    """
    early = 1 - (np.arange(cells) + 0.5) / cells
    peaks = np.column_stack([np.vstack([np.eye(cells), -np.eye(cells)]), -np.ones(2 * cells)])
    solved = linprog(
        np.append(np.zeros(cells), 1),
        A_ub=peaks,
        b_ub=np.zeros(2 * cells),
        A_eq=[np.append(np.full(cells, 1 / cells), 0), np.append(early / cells, 0)],
        b_eq=[-start, 1 - start],
        bounds=(None, None),
    )
    assert solved.success
    return float(solved.fun)


@pytest.mark.parametrize("start", LAW_CHOICES["head_start"])
def test_a_hammer_that_has_to_stop_is_told_so_and_no_other(start: float) -> None:
    """With half taken from the weight the bound is lower, and no law comes down to it."""
    exercise, machine = EXERCISES["06.1"], with_laws(head_start=start)
    least = least_to_rest(start)
    assert to_rest(start) == pytest.approx(least, rel=1e-5)
    stops = "This is for a hammer that has to stop."
    assert stops in exercise.judge(to_rest(start), machine).text
    half = 4 - 2 * start
    assert half < 0.9999 * least
    assert stops not in exercise.judge(half, machine).text.split(" Or: ")[0]
    assert "one half was taken away from the weight" in exercise.judge(half, machine).text


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
    assert jerks == [61, 39]


@pytest.mark.parametrize(
    "compared", [("modified trapezoid", "cycloidal"), *LAW_CHOICES["compared"]]
)
def test_a_smaller_peak_is_paid_for_with_jerk_and_overlap_has_found_more(
    compared: tuple[str, str],
) -> None:
    gentle, harsh = (cm.LAWS[name] for name in compared)
    assert gentle.Ca < 0.95 * harsh.Ca
    assert harsh.Cj < gentle.Cj < np.inf
    assert "paid for with jerk" in EXERCISES["05.2"].right
    root = np.sqrt(harsh.Ca / gentle.Ca)
    assert all(m.widest_deg > root * m.die_angle_deg for m in MACHINES)
    assert "Overlap has found more" in EXERCISES["05.3"].right


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
            if "Cv = 2" in slip.reason or "the pause" in slip.reason:
                continue  # the source has that, and no pause
            assert exercise.judge(slip.leads_to(EXAMPLE), EXAMPLE).state == "wrong", slip.reason


@pytest.mark.parametrize("name", LAW_CHOICES)
def test_no_common_slip_is_taken_as_right_for_any_law(name: str) -> None:
    for choice in LAW_CHOICES[name]:
        m = replace(NAMELESS, laws=replace(NAMELESS.laws, **{name: choice}))
        for number in ("02.2", "05.2", "05.3", "05.4", "06.1", "06.2"):
            exercise = EXERCISES[number]
            assert exercise.judge(exercise.solution(m), m).state == "right"
            for slip in getattr(exercise, "slips", ()):
                assert exercise.judge(slip.leads_to(m), m).state == "wrong", (choice, slip.reason)


@pytest.mark.parametrize("m", FEW[:6], ids=lambda m: m.who or "source")
def test_the_cycloid_is_compared_with_the_least_peak(m: MillAndDie) -> None:
    x = place((m.wait_mm - m.margin_mm) / stroke(m), lambda x: _cycloid(x))
    peak = hard(m, round(later(m) / (1 - x), 2), 2 * np.pi)
    assert EXERCISES["06.4"].solution(m) == pytest.approx(peak / least(m), rel=1e-6)


def _cycloid(x: float) -> float:
    """Return the share of the way by the cycloid, its velocity integrated."""
    places = np.linspace(0, x, 20_001)
    return float(integral(1 - np.cos(2 * np.pi * places), places)[-1])
