"""Curves in pieces: what laws and motions are asked alike, and what no law may be."""

import time
from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from machines import examples

import cammotion as cm
from cammotion import LAWS, MotionLaw, x
from cammotion.laws import turning
from cammotion.laws.curve import Curve
from cammotion.laws.expression import Expression
from cammotion.laws.series import Series, Wave

PARABOLA = Series((0.0, 4.0, -4.0))
BENT = Curve([Series((0.0, 1.0), (), 0.0, 0.4), Series((0.4, -2.0), (), 0.4, 1.0)])


def test_a_curve_of_two_pieces() -> None:
    assert BENT.ends == pytest.approx((0, -0.8))
    assert BENT.extremes == pytest.approx((-0.8, 0.4))
    assert BENT.largest == pytest.approx(0.8)
    assert BENT.steps == ((0.4, 0.0),)
    assert BENT.derivative.steps == ((0.4, -3.0),)
    assert BENT.derived(0) is BENT
    assert BENT.derived(2).largest == 0


def test_at_a_joint_it_is_the_piece_that_was_asked_for() -> None:
    slope = BENT.derivative
    for places in (np.array([0.4]), np.array([0.9, 0.4]), np.array([0.1, 0.4, 0.9])):
        at = list(places).index(0.4)
        assert (slope(places)[at], slope(places, "right")[at]) == (1, -2)
    assert slope(np.full((2, 3), 0.9)).shape == (2, 3)
    assert slope(np.array(0.4)) == 1


def test_where_it_is_above_and_below_a_height() -> None:
    [(low, high)] = BENT.where(0.2, 1)
    assert (low, high) == pytest.approx((0.2, 0.5))
    assert BENT.where(0.2, -1) == [(0.0, low), (high, 1.0)]
    assert BENT.where(0.4, 1) == []
    assert BENT.where(0.4 - 1e-10, 1, 1e-9) == []  # what is so near is at the height
    [(low, high)] = BENT.where(-1e-10, 1, 1e-9)
    assert (low, high) == pytest.approx((0.0, 0.6))


def test_a_curve_drawn_elsewhere_keeps_what_it_is() -> None:
    """Twice as long, turned round, upside down and three times as high, from 5 on."""
    placed = Curve([PARABOLA]).placed(7.0, -2.0, 1.0, -3.0)
    assert (placed.low, placed.high) == (5, 7)
    assert placed.extremes == (-2, 1)
    [turn] = placed.pieces[0].turns
    assert turn == pytest.approx(6)
    places = np.linspace(5, 7, 11)
    inner = (7 - places) / 2
    assert placed(places) == pytest.approx(1 - 3 * 4 * inner * (1 - inner))
    assert placed.derivative(places) == pytest.approx(3 / 2 * (4 - 8 * inner))
    solve = placed.pieces[0].solve
    ends = [end for arc in placed.where(0.25, 1) for end in arc]
    assert ends == pytest.approx([5, solve(0.25, 5, 6), solve(0.25, 6, 7), 7])
    as_written = placed.pieces[0].expression
    assert float(as_written.subs(x, 5.5)) == pytest.approx(float(placed(np.array([5.5]))[0]))


@examples(40)
@given(st.floats(0.01, 0.49), st.floats(0.51, 0.99), st.sampled_from(list(LAWS)))
def test_a_part_of_a_law_is_that_part_stretched(low: float, high: float, name: str) -> None:
    law, part = LAWS[name], LAWS[name].part(low, high)
    places = np.linspace(0, 1, 41)
    way, span = law(high) - law(low), high - low
    for order in range(4):
        wanted = law(np.clip(low + span * places, low, high), order) * span**order / way
        if order == 0:
            wanted = wanted - law(low) / way
        inner = slice(1, -1)  # at a joint the two may look to different sides
        assert np.count_nonzero(np.abs(part(places, order) - wanted)[inner] > 1e-6 * 50**order) <= 1
    samples = part(np.linspace(0, 1, 20_001), 2)
    assert part.curve.derived(2).largest == pytest.approx(np.max(np.abs(samples)), rel=1e-3)


def test_a_part_has_a_width() -> None:
    """Also about a jump, where the height changes over nothing."""
    jump = MotionLaw("jump", sympy.Piecewise((0, x <= 0.5), (1, True)))
    for low, high in ((0.5, 0.5), (0.5, 0.5 + 1e-13), (0.6, 0.4)):
        with pytest.raises(cm.InputError, match="give two places in order"):
            jump.part(low, high)


def test_a_law_run_backwards() -> None:
    late = MotionLaw("late", x**3)
    back = late.reversed()
    assert sympy.expand(back.s - (1 - (1 - x) ** 3)) == 0
    assert back(0.25) == 1 - late(0.75)
    assert (back(0.0, 1), back(1.0, 1)) == (3, 0)
    assert back.Ca == late.Ca
    points = cm.law_from_points([0, 0.2, 0.6, 1], [0, 0.1, 0.7, 1]).reversed()
    assert points([0, 0.4, 0.8, 1]) == pytest.approx([0, 0.3, 0.9, 1])


def test_the_double_harmonic_comes_down_as_it_went_up() -> None:
    """Its peaks over a rise and a return, of which the source lists both: 5.552 and -9.8696."""
    pi = sympy.pi
    up = MotionLaw(
        "double harmonic", ((1 - sympy.cos(pi * x)) - (1 - sympy.cos(2 * pi * x)) / 4) / 2
    )
    assert (up.Cv, up.Ca) == pytest.approx((2.0405, 9.8696), abs=1e-4)
    assert max(up(np.linspace(0, 1, 10_001), 2)) == pytest.approx(5.552, abs=1e-3)
    lobe = cm.motion(
        "follower",
        cm.rise(20, over_deg=120, law=up),
        cm.return_(20, over_deg=120, law=up.reversed()),
        cm.dwell(120),
    )
    diagram = cm.TimingDiagram([lobe], 2000)
    assert np.isfinite(diagram.peak_jerk("follower"))
    assert diagram.peak_acceleration("follower") == pytest.approx(9.8696 * 0.020 / 0.6**2, rel=1e-5)


NOT_SMOOTH = {
    "nan": sympy.Piecewise((x, x < 0.5), (sympy.nan, True)),
    "zoo": x + sympy.zoo,
    "imaginary": x * sympy.I,
    "an infinite slope": sympy.sqrt(x),
    "an infinite jerk": x ** sympy.Rational(5, 2),
    "a root of what is below zero": (x - 1) ** sympy.Rational(1, 3) + 1,
    "a pole": 1 / (x - sympy.Rational(1, 3)),
    "a logarithm of zero": sympy.log(x),
    "more than a float can hold": sympy.Integer(10) ** 400 * x,
}


@pytest.mark.parametrize("curve", NOT_SMOOTH.values(), ids=NOT_SMOOTH)
def test_what_is_not_real_and_finite_is_no_law(curve: sympy.Expr) -> None:
    with pytest.raises(
        cm.InputError, match=r"not real and finite|real and finite: a position"
    ) as refusal:
        MotionLaw("no law", curve)
    assert len(str(refusal.value)) < 300


NOT_IN_ORDER = [
    sympy.Piecewise((x, x < 0.5), (x**2, x > 0.7)),
    # where these hold SymPy does not say
    sympy.Piecewise((x**2, sympy.cos(sympy.pi * x) > 0), (x, True)),
    1 + sympy.Piecewise((x**2, x * sympy.sin(x) > 0.25), (x, True)),
    sympy.Piecewise((x**2, sympy.Xor(x < 0.2, x < 0.4)), (x, True)),
]


@pytest.mark.parametrize("law", NOT_IN_ORDER, ids=str)
def test_what_is_not_defined_in_order_from_0_to_1_is_no_law(law: sympy.Expr) -> None:
    with pytest.raises(cm.InputError, match="do not follow each other from x = 0 to 1"):
        MotionLaw("no law", law)


def cycloid(y: Any) -> Any:
    return y - sympy.sin(2 * sympy.pi * y) / (2 * sympy.pi)


@cache
def twice() -> MotionLaw:
    """Return a cycloid of a cycloid, whose factors take seconds."""
    return MotionLaw("twice", cycloid(cycloid(x)))


def test_no_law_runs_for_minutes() -> None:
    """Some of these ran from half a minute to endlessly; what cannot be proved soon is refused."""
    half = sympy.Rational(1, 2)
    logistic = 1 / (1 + sympy.exp(-12 * (x - half)))
    start, end = logistic.subs(x, 0), logistic.subs(x, 1)
    waves = sum(sympy.sin(2 * sympy.pi * n * x) / (100 * n**2) for n in range(1, 100))
    makes: list[Callable[[], MotionLaw]] = [twice]
    for curve in (
        x + sympy.sin(2 * sympy.pi * 10**5 * x) / 10**6,
        x + waves,
        (logistic - start) / (end - start),
        sympy.chebyshevt(30, 2 * x - 1) ** 2,
    ):
        makes.append(partial(MotionLaw, "slow", curve))
    for make in makes:
        began, law = time.process_time(), make()
        try:
            assert np.isfinite([law.Cv, law.Ca, law.Cq, law.Cj_inside]).all()
        except cm.InputError as refusal:
            assert "cannot be proved in a reasonable time" in str(refusal)  # noqa: PT017
        assert time.process_time() - began < 20


def test_a_law_of_a_law_has_its_factors() -> None:
    """It was refused after a third of a second, as one that takes minutes."""
    law, half = twice(), sympy.Rational(1, 2)
    assert law.is_monotone
    assert law.Cv == pytest.approx(4)
    assert law.Ca == pytest.approx(np.abs(law(np.linspace(0, 1, 100_001), 2)).max(), rel=1e-6)
    soft = MotionLaw("soft", half + sympy.tanh(6 * (x - half)) / (2 * sympy.tanh(3)))
    assert soft.Cj_inside == pytest.approx(6**3 / np.tanh(3))


def test_what_cannot_be_proved_is_tried_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """A distance rule asked for it six times, for some seconds each."""
    tried, real = [], turning._Slopes

    def counted(piece: turning.Proved) -> turning._Slopes:
        tried.append(piece)
        return real(piece)

    monkeypatch.setattr(turning, "_Slopes", counted)
    often = MotionLaw("often", x + sympy.sin(2 * sympy.pi * 10**5 * x) / 10**6)
    counts = []
    for _ in range(2):
        with pytest.raises(cm.InputError, match="cannot be proved in a reasonable time"):
            often.Cv  # noqa: B018
        counts.append(len(tried))
    assert counts[0] == counts[1] > 0


def test_a_long_table_is_quick_and_exact() -> None:
    """The peaks of 30,001 points, of which today's two minutes were the reason for a spline."""
    places = np.linspace(0, 1, 30_001)
    law = cm.law_from_points(places, places - np.sin(2 * np.pi * places) / (2 * np.pi))
    began = time.process_time()
    assert (law.Cv, law.Ca, law.Cq) == pytest.approx((2, 2 * np.pi, 8.1621), rel=1e-4)
    assert time.process_time() - began < 2


@examples(40)
@given(
    st.lists(st.floats(-3, 3), min_size=1, max_size=5),
    st.floats(-2, 2),
    st.floats(0.1, 60),
    st.floats(-7, 7),
    st.integers(-5, 9),
)
def test_extremes_are_those_of_dense_samples(
    powers: list[float], amplitude: float, frequency: float, phase: float, quarters: int
) -> None:
    curve = Series(tuple(powers), (Wave(amplitude, frequency, phase, quarters),), 0.2, 0.9)
    values = curve.over(np.linspace(0.2, 0.9, 200_001))
    assert curve.extremes == pytest.approx((values.min(), values.max()), abs=1e-6)
    assert curve.extremes[0] <= values.min() + 1e-12
    assert curve.extremes[1] >= values.max() - 1e-12
    written = Expression(curve.expression, 0.2, 0.9)
    assert curve.at(0.55) == pytest.approx(written.at(0.55), abs=1e-12)


@pytest.mark.parametrize("share", [0.001, 0.3, 0.5, 0.7, 0.999])
@pytest.mark.parametrize("speed", [0, -1, -0.1])
def test_a_line_that_does_not_go_on_ends_where_it_can(speed: float, share: float) -> None:
    """At -1 and half of the time it ends where it began, and nothing is left to be stretched."""
    law = MotionLaw("waits", x + (speed - 1) * sympy.sin(4 * sympy.pi * x) / (4 * sympy.pi))
    way = share * speed + 1 - share  # of the whole law, before it is stretched
    if speed and abs(way) > 1e-9:
        middle = law.with_constant_velocity(share)(0.5, 1)
        assert middle == pytest.approx(speed / way)
        return
    lack = "would go back there as far as" if speed else "stands in its middle"
    with pytest.raises(cm.InputError, match=lack):
        law.with_constant_velocity(share)


def test_a_law_cannot_be_changed() -> None:
    for field in ("name", "s", "curve", "also_called"):
        with pytest.raises(AttributeError, match="A motion law cannot be changed"):
            setattr(LAWS["cubic"], field, None)


@pytest.mark.parametrize("powers", [(4, 6), (7, 8), (2, 8), (8, 2)])
def test_a_rise_return_law_is_cut_at_its_top(powers: tuple[int, int]) -> None:
    """Also where the expanded polynomial misses 0 by rounding."""
    a, b = powers
    top = sympy.Rational(a, a + b)
    lobe = MotionLaw("lobe", x**a * (1 - x) ** b / (top**a * (1 - top) ** b))
    parts = [lobe.part(0, float(top)), lobe.part(float(top), 1)]
    motion = cm.motion(
        "lobe",
        cm.rise(30, over_deg=180 * float(top), law=parts[0]),
        cm.return_(30, over_deg=180 - 180 * float(top), law=parts[1]),
        cm.dwell(180),
    )
    assert motion.steps(1) == []
    assert motion.position_mm(90) == pytest.approx(30 * lobe(0.5), abs=1e-6)


def test_a_power_of_a_sum_is_reckoned_as_it_is_written() -> None:
    """Multiplied out, its terms are as large as 3^29 and cancel each other."""
    y = 2 * x - 1
    law = MotionLaw("steep", (y**29 + 1) / 2)
    places = np.linspace(0, 1, 2001)
    assert law(places) == pytest.approx(((2 * places - 1) ** 29 + 1) / 2, abs=1e-12)
    assert law(law.inverse(0.9)) == pytest.approx(0.9, abs=1e-9)
    assert (law.Cv, law.curve.derived(2).largest) == pytest.approx((29, 1624))


def test_turns_that_rounding_hides_are_not_passed_over_in_silence() -> None:
    """Expanded, this one is its rounding; today's answer was a law that stands."""
    wave = sympy.expand((sympy.chebyshevt(21, 2 * x - 1) + 1) / 2)
    with pytest.raises(cm.InputError, match="cannot be proved in a reasonable time"):
        MotionLaw("hidden", wave).curve.extremes  # noqa: B018


def test_a_part_of_a_sampled_law_has_the_jerk_of_that_part() -> None:
    rng = np.random.default_rng(8)
    knots = np.linspace(0, 1, 11)
    for _ in range(40):
        noise = 0.02 * rng.uniform(-1, 1, 11) * (knots > 0) * (knots < 1)
        law = cm.law_from_points(knots, knots**2 * (3 - 2 * knots) + noise)
        start, end = sorted(rng.choice(10, 2, replace=False))
        low, high = knots[start], knots[end + 1]
        for part in (law.part(low, high), law.part(low, high).reversed()):
            dense = part(np.linspace(1e-9, 1 - 1e-9, 20_001), 3)
            assert part.Cj_inside == pytest.approx(np.abs(dense).max(), rel=1e-9)


def test_a_law_that_jumps_moves_nothing() -> None:
    half = sympy.Rational(1, 2)
    jump = MotionLaw("jump", sympy.Piecewise((x / 2, x <= half), (x / 2 + half, True)))
    assert np.isinf([jump.Cv, jump.Ca, jump.Cj]).all()
    for use in (lambda: jump.inverse(0.3), lambda: cm.EXAMPLE.die.with_law(jump)):
        with pytest.raises(cm.InputError, match=r"jumps at x = 0\.5"):
            use()
    for gap in (4e-7, 1e-8):  # as of numbers with six or eight digits: no jump, and it is passed
        steep = 2 - 2 * gap
        meets = sympy.Piecewise((steep * x**2, x <= half), (1 - steep * (1 - x) ** 2, True))
        typed = MotionLaw("typed", meets)
        assert typed.inverse(np.linspace(0.499, 0.501, 41)) == pytest.approx(
            cm.LAWS["parabolic"].inverse(np.linspace(0.499, 0.501, 41)), abs=gap
        )
        assert typed.inverse(0.5) == pytest.approx(0.5)
    back = MotionLaw("b", sympy.Piecewise((8 * x / 5, x <= half), (0.2 + 0.8 * x, True)))
    assert not back.is_monotone


@pytest.mark.parametrize("count", [5, 12, 37, 119])
def test_the_rounding_of_a_table_is_no_turn(count: int) -> None:
    places = np.linspace(0, 1, count)
    for ways in (places**2 * (3 - 2 * places), (1 - np.cos(np.pi * places)) / 2):
        for law in (cm.law_from_points(places, ways), cm.law_from_points(places, ways).reversed()):
            assert law.is_monotone
            assert law(law.inverse(0.3)) == pytest.approx(0.3)


FLAT_ENDED = {
    f"degree {2 * power + 1}": sympy.expand(
        sympy.integrate(x**power * (1 - x) ** power, x)
        / sympy.integrate(x**power * (1 - x) ** power, (x, 0, 1))
    )
    for power in (4, 5, 6)
}
STEEP = {
    "eleven waves": x
    - sum(sympy.sin(2 * sympy.pi * n * x) / (2 * sympy.pi * n**3) for n in range(1, 12)),
    **FLAT_ENDED,
}


@pytest.mark.parametrize("formula", STEEP.values(), ids=STEEP)
def test_laws_that_are_flat_at_their_ends_have_all_factors(formula: sympy.Expr) -> None:
    """Their factors were refused: waves of one frequency stood side by side, terms cancelled."""
    law = MotionLaw("steep", formula)
    v, a = (sympy.lambdify(x, sympy.diff(formula, x, order)) for order in (1, 2))
    places = (
        np.linspace(0, 0.5, 100_001)
        if formula in FLAT_ENDED.values()
        else np.linspace(0, 1, 200_001)
    )
    assert law.Cv == pytest.approx(np.abs(v(places)).max(), rel=1e-8)
    assert law.Cq == pytest.approx(np.abs(v(places) * a(places)).max(), rel=1e-8)


def test_a_law_that_comes_back_has_the_factors_of_its_curve() -> None:
    """The double harmonic, up and down: it does not jump where it ends."""
    wave = 2 * sympy.pi * x
    law = MotionLaw("double", ((1 - sympy.cos(wave)) - (1 - sympy.cos(2 * wave)) / 4) / 2)
    places = np.linspace(0, 1, 100_001)
    for order, factor in ((1, law.Cv), (2, law.Ca), (3, law.Cj)):
        assert factor == pytest.approx(np.abs(law(places, order)).max(), rel=1e-8)
    assert law.jerk_impulses == ()
    with pytest.raises(cm.InputError, match=r"to S\(1\) = .*cut it at its top"):
        law.check_way()


OVERFLOWS = [(sympy.exp(800 * x) - 1) / (sympy.exp(800) - 1), sympy.exp(800 * x) / sympy.exp(800)]


@pytest.mark.parametrize("formula", OVERFLOWS)
def test_what_a_computer_cannot_reckon_with_is_refused(formula: sympy.Expr) -> None:
    """Exact intervals have no largest number, floats have: a peak was nan."""
    with pytest.raises(cm.InputError, match="real and finite"):
        MotionLaw("steep", formula)


def test_what_overflows_in_a_product_is_refused() -> None:
    law = MotionLaw("c", (sympy.cosh(400 * x) - 1) / (sympy.cosh(400) - 1))
    with pytest.raises(cm.InputError, match="cannot be proved"):
        law.Cq  # noqa: B018


def test_waves_of_one_frequency_are_one() -> None:
    one = Series((0.5,), tuple(Wave(0.3, n, 0.0) for n in range(1, 8)), 0.0, 1.0)
    product = one.times(one.derivative)
    assert product is not None
    assert len(product.waves) <= 28  # and not 98 + 7
    places = np.linspace(0, 1, 101)
    assert product.over(places) == pytest.approx(one.over(places) * one.derivative.over(places))


def test_the_other_symbol_x_is_told_apart() -> None:
    with pytest.raises(cm.InputError, match=r"from cammotion import x"):
        MotionLaw("square", sympy.Symbol("x", positive=True) ** 2)


def test_an_expression_in_place_of_a_law_is_told_what_makes_one() -> None:
    with pytest.raises(cm.InputError, match=r"an expression, .*MotionLaw\('mine', \.\.\.\)"):
        cm.peak_velocity(50, 55, 2000, law=3 * x**2 - 2 * x**3)
    with pytest.raises(cm.InputError, match="did you mean 'constant velocity'"):
        cm.peak_velocity(50, 55, 2000, law="constant velocty")


def test_a_bump_of_one_point_is_no_symmetry() -> None:
    places = np.linspace(0, 1, 1001)
    ways = places**2 * (3 - 2 * places)
    assert cm.law_from_points(places, ways, fit="monotone", step=0).is_symmetric
    ways[705] += 5e-4
    law = cm.law_from_points(places, ways, fit="monotone", step=0)
    assert not law.is_symmetric
    with pytest.raises(cm.InputError, match="is not symmetric"):
        law.with_constant_velocity(0.2)
