"""Motion laws against closed forms, and the properties that every law has to have."""

from collections.abc import Callable
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from long_arrays import assert_near
from machines import CURVES, DIPPING, MONOTONE, OVERSHOOTING, TURNING, WAVY, examples

import cammotion as cm
from cammotion import LAWS, MotionLaw, x
from cammotion.laws.reader import cut

CYCLOIDAL = LAWS["cycloidal"]
unit_interval = st.floats(0, 1)

_pi, _inf = np.pi, np.inf
_m = 1125 / 1192
_mcv = 8 * _pi / (4 + 5 * _pi)

# name: Cv, Ca, Cj in closed form; each was derived by hand from S
FACTORS: dict[str, tuple[float, float, float]] = {
    "constant acceleration": (2, 4, _inf),
    "simple harmonic": (_pi / 2, _pi**2 / 2, _inf),
    "cycloidal": (2, 2 * _pi, 4 * _pi**2),
    "modified trapezoid": (2, 8 * _pi / (2 + _pi), 32 * _pi**2 / (2 + _pi)),
    "modified sine": (4 * _pi / (4 + _pi), 4 * _pi**2 / (4 + _pi), 16 * _pi**3 / (4 + _pi)),
    "3-4-5 polynomial": (15 / 8, 10 / 3**0.5, 60),
    "4-5-6-7 polynomial": (35 / 16, 84 * 5**0.5 / 25, 52.5),
    "Gutman 1-3": (2, 2 * _pi * (2 / 3) ** 0.5, 6 * _pi**2),
    "Freudenstein 1-3": (2, 12 * _pi / 7, 36 * _pi**2 / 7),
    "Freudenstein 1-3-5": (2, 2 * _pi * _m * 128 / 150, 6.4 * _pi**2 * _m),
    "cubic": (3 / 2, 6, _inf),
    "MCV50": (_mcv, 2 * _pi * _mcv, 16 * _pi**2 * _mcv),
}
# name: Cq, and Cj away from the jumps, as the table of the field has them
TORQUE = {
    "constant acceleration": 8,
    "cubic": 3.464,
    "simple harmonic": 3.876,
    "cycloidal": 8.162,
    "modified trapezoid": 8.090,
    "modified sine": 5.458,
    "MCV50": 5.733,
    "3-4-5 polynomial": 6.694,
    "4-5-6-7 polynomial": 10.750,
    "Gutman 1-3": 8.125,
    "Freudenstein 1-3": 7.918,
    "Freudenstein 1-3-5": 7.850,
}


@pytest.fixture(params=LAWS, ids=str)
def law(request: pytest.FixtureRequest) -> MotionLaw:
    return LAWS[request.param]


def test_a_law_goes_from_0_to_1_at_rest(law: MotionLaw) -> None:
    assert law.s.subs(x, 0) == 0
    assert law.s.subs(x, 1) == 1
    assert law(0.0, derivative=1) == 0
    assert law(1.0, derivative=1) == pytest.approx(0, abs=1e-15)


def test_a_law_covers_the_stroke(law: MotionLaw) -> None:
    assert integral(law) == pytest.approx(1, abs=1e-13)


def joints_of(law: MotionLaw) -> list[float]:
    return sorted({zone.low for zone in cut(law.name, law.s)} | {1.0})


def integral(law: MotionLaw) -> float:
    """Integrate V from joint to joint, by Gauss."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    return sum(
        (high - low) / 2 * float(weights @ law((low + high) / 2 + (high - low) / 2 * nodes, 1))
        for low, high in pairwise(joints_of(law))
    )


def test_a_law_is_smooth_where_its_zones_meet(law: MotionLaw) -> None:
    """S and V do not jump at a joint, and A only where a jerk impulse is listed."""
    listed = {place for place, _ in law.jerk_impulses}
    for joint in joints_of(law)[1:-1]:
        for order in range(2 if joint in listed else 3):
            sides = [law(joint + side * 1e-9, order) for side in (-1, 1)]
            assert sides[0] == pytest.approx(sides[1], abs=1e-6)


def test_jerk_impulses_are_the_jumps_of_the_acceleration() -> None:
    assert LAWS["cycloidal"].jerk_impulses == ()
    assert LAWS["cubic"].jerk_impulses == ((0, 6), (1, 6))
    assert LAWS["constant acceleration"].jerk_impulses == ((0, 4), (0.5, -8), (1, 4))
    assert LAWS["cubic"].Cj_inside == pytest.approx(12)
    assert LAWS["simple harmonic"].Cj_inside == pytest.approx(np.pi**3 / 2)


def test_a_law_never_turns_back(law: MotionLaw) -> None:
    assert np.diff(law(np.linspace(0, 1, 10_001))).min() >= 0


@examples(25)
@given(unit_interval)
def test_a_law_is_symmetric(place: float) -> None:
    for law in LAWS.values():
        assert law(1 - place) == pytest.approx(1 - law(place), abs=1e-14)


@examples(15)
@given(unit_interval)
def test_compiled_and_symbolic_values_agree(place: float) -> None:
    for law in LAWS.values():
        for n, expression in enumerate([law.s, law.v, law.a, law.j]):
            exact = float(expression.subs(x, sympy.Rational(place)).evalf(30))
            assert law(place, derivative=n) == pytest.approx(exact, rel=1e-12, abs=1e-12)


@examples(25)
@given(st.floats(1e-3, 1 - 1e-3), st.integers(0, 2))
def test_each_derivative_is_the_slope_of_the_one_before(place: float, n: int) -> None:
    step = 1e-5
    for law in LAWS.values():
        if min(abs(place - joint) for joint in joints_of(law)) > 2 * step:
            slope = (law(place + step, n) - law(place - step, n)) / (2 * step)
            assert law(place, n + 1) == pytest.approx(slope, abs=1e-5)


def test_the_catalogue_and_the_table_of_factors_name_the_same_laws() -> None:
    assert [*FACTORS] == [*LAWS]
    assert set(TORQUE) == set(LAWS)


def test_peak_factors_are_the_closed_forms(law: MotionLaw) -> None:
    assert (law.Cv, law.Ca, law.Cj) == pytest.approx(FACTORS[law.name], rel=1e-13)
    assert law.Cq == pytest.approx(TORQUE[law.name], abs=6e-4)


def test_the_ranking_of_the_example() -> None:
    """50 mm over 55 deg at 2000 pieces per hour; the source's figures, in m/s2."""
    peaks = {name: round(cm.peak_acceleration(50, 55, 2000, name), 3) for name in LAWS}
    assert peaks == {
        "constant acceleration": 2.645,
        "modified trapezoid": 3.232,
        "simple harmonic": 3.263,
        "Freudenstein 1-3-5": 3.346,
        "Gutman 1-3": 3.392,
        "Freudenstein 1-3": 3.561,
        "modified sine": 3.655,
        "3-4-5 polynomial": 3.817,
        "cubic": 3.967,
        "cycloidal": 4.154,
        "4-5-6-7 polynomial": 4.967,
        "MCV50": 5.298,
    }


@examples(40)
@given(st.floats(0, 1), st.floats(0, 1))
def test_any_scca_law_keeps_what_every_law_keeps(one: float, other: float) -> None:
    b, c, d = sorted([one, other])[0], abs(one - other), 1 - max(one, other)
    if 0 < min(b, d) < 1e-3 or 0 < c < 1e-3:
        return  # thinner zones than a cam could follow
    law = cm.scca(b, c, 1 - b - c)
    b_, d_ = b, 1 - b - c
    bottom = (np.pi**2 - 8) * (b_**2 - d_**2) - 2 * np.pi * (np.pi - 2) * b_ + np.pi**2
    assert law.Ca == pytest.approx(4 * np.pi**2 / bottom, rel=1e-9)
    assert law.Cv == pytest.approx(law.Ca * ((b_ + d_) / np.pi + c / 2), rel=1e-9)
    assert (law(0.0), law(0.5), law(1.0)) == pytest.approx((0, 0.5, 1), abs=1e-12)
    assert integral(law) == pytest.approx(1, abs=1e-9)


def test_the_corners_of_the_scca_triangle_are_named_laws() -> None:
    places = np.linspace(0, 1, 501)
    for parts, name in (
        ((0, 1, 0), "constant acceleration"),
        ((0, 0, 1), "simple harmonic"),
        ((0.25, 0.5, 0.25), "modified trapezoid"),
        ((0.25, 0, 0.75), "modified sine"),
        ((0.5, 0, 0.5), "cycloidal"),
    ):
        assert cm.scca(*parts)(places) == pytest.approx(LAWS[name](places), abs=1e-13)


@pytest.mark.parametrize("name", [n for n in FACTORS if n not in ("cubic",)])
@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
def test_a_share_of_constant_velocity(name: str, share: float) -> None:
    """The closed forms of how the factors change, and a straight line in the middle."""
    law, rest = LAWS[name], 1 - share
    longer = law.with_constant_velocity(share)
    velocity = 1 / (share + rest / law.Cv)
    assert longer.Cv == pytest.approx(velocity, rel=1e-12)
    assert longer.Ca == pytest.approx(law.Ca * velocity / (law.Cv * rest), rel=1e-12)
    assert longer.Cj == pytest.approx(law.Cj * velocity / (law.Cv * rest**2), rel=1e-12)
    assert longer(0.5 + 0.49 * share) - longer(0.5) == pytest.approx(0.49 * share * velocity)
    assert integral(longer) == pytest.approx(1, abs=1e-12)


def test_no_constant_velocity_is_the_law_itself() -> None:
    assert CYCLOIDAL.with_constant_velocity(0) is CYCLOIDAL
    with pytest.raises(cm.InputError, match="is not symmetric, so that no constant velocity"):
        MotionLaw("slow", x**3).with_constant_velocity(0.5)
    with pytest.raises(cm.InputError, match="share of constant velocity is 1"):
        CYCLOIDAL.with_constant_velocity(1)


@pytest.mark.parametrize("name", [None, 5, ["cubic"]])
def test_the_name_of_a_law_is_a_text(name: Any) -> None:
    with pytest.raises(cm.InputError, match="give a text in quotes"):
        cm.MotionLaw(name, x)
    with pytest.raises(cm.InputError, match="give a text in quotes"):
        cm.law_from_points([0, 0.3, 0.6, 1], [0, 0.2, 0.7, 1], name=name)


def test_polynomials_from_their_boundary_values() -> None:
    assert cm.polynomial((0, 0, 0), (1, 0, 0)).s == 10 * x**3 - 15 * x**4 + 6 * x**5
    lively = cm.polynomial((0, 0.5, 0), (1, 0.5, 0))
    assert (lively(0.0, 1), lively(1.0, 1), lively(0.0, 2)) == (0.5, 0.5, 0)
    mixed = cm.polynomial((0, 0, 0, 0), (1, 1.5, 0))
    assert [mixed(0.0, n) for n in range(4)] == [0, 0, 0, 0]
    assert [mixed(1.0, n) for n in range(3)] == pytest.approx([1, 1.5, 0])


@pytest.mark.parametrize(
    ("start", "end", "said"),
    [
        ((0, 0, 0), (1, 3, 0), r"dips below 0, to S = -0\.01276"),
        ((0, 3, 0), (1, 0, 0), r"rises above 1, to S = 1\.013"),
        ((0, 3, 0), (1, 0, 0), "choose end velocities nearer to 1, or join a straight line"),
        ((0, 1, -30), (1, 1, 0), "nearer to 1, accelerations and jerks nearer to 0, or join"),
        ((0, 1, 0, -200), (1, 1, 0), "nearer to 1, accelerations and jerks nearer to 0, or join"),
        ((0.1, 0, 0), (1, 0, 0), "goes from s = 0.1 to 1; a motion law goes from 0 to 1"),
        ((0, 0), (1, 0, 0), r"values at the start are \(0, 0\): give s, v and a"),
        ((0, 0, 0), None, "is given end=None: give a list"),
        (
            (0, 2e9, 0),
            (1, 0, 0),
            r"2e\+09 \(at position 1\); .* at least -1e\+09 and at most 1e\+09",
        ),
        ((0, -2e9, 0), (1, 0, 0), r"-2e\+09 \(at position 1\); .* at least -1e\+09 and at most"),
        ((0, np.nan, 0), (1, 0, 0), r"is given start\[1\]=nan: give a finite number"),
    ],
)
def test_a_polynomial_that_is_no_law_is_refused(start: object, end: object, said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.polynomial(start, end)  # type: ignore[arg-type]


def test_fifth_degree_and_a_line() -> None:
    law = cm.fifth_degree_linear(0.5)
    assert law.Cv == pytest.approx(4 / 3)
    assert law.Cj < np.inf
    assert law(0.6, 1) == law(0.5, 1)
    assert integral(law) == pytest.approx(1)
    with pytest.raises(cm.InputError, match="share of the straight line is 1"):
        cm.fifth_degree_linear(1)


def test_zones_of_a_scca_law_are_refused_in_words() -> None:
    with pytest.raises(cm.InputError, match=r"add up to 0\.9: let b, c and d add up to 1"):
        cm.scca(0.3, 0.3, 0.3)
    with pytest.raises(cm.InputError, match=r"zone of the SCCA law is -0\.1"):
        cm.scca(-0.1, 0.6, 0.5)


BROKEN = {
    "1/(3 pi)": x - sympy.sin(2 * sympy.pi * x) / (3 * sympy.pi),
    "jump at 0.625": sympy.Piecewise(
        (LAWS["modified sine"].s, x <= 0.625), (LAWS["modified sine"].s + 0.01, True)
    ),
    "modified trapezoid": LAWS["4-5-6-7 polynomial"].s,
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_laws_are_caught(name: str) -> None:
    """As they stand in print and in programs; one of the checks above refuses each."""
    broken = MotionLaw(name, BROKEN[name])
    checks = [
        abs(broken(0.0, 1)) < 1e-12 and abs(broken(1.0) - 1) < 1e-12,
        np.isfinite(broken.Cv),
        abs(broken.Ca - FACTORS.get(broken.name, (0, broken.Ca))[1]) < 1e-9,
    ]
    assert not all(checks)


@examples(20)
@given(st.lists(unit_interval, max_size=30))
def test_places_in_any_order_get_the_same_values(places: list[float]) -> None:
    law, at = LAWS["modified sine"], np.array([*places, 0.125, 0.875])
    together = [law(at, n) for n in range(4)]
    assert together == [pytest.approx([law(place, n) for place in at]) for n in range(4)]


def test_a_peak_between_the_samples_is_solved_for() -> None:
    """Three polynomials whose peaks are known and lie where no sample is."""
    poly345 = MotionLaw("3-4-5", 10 * x**3 - 15 * x**4 + 6 * x**5)
    poly4567 = MotionLaw("4-5-6-7", 35 * x**4 - 84 * x**5 + 70 * x**6 - 20 * x**7)
    cubic = MotionLaw("cubic", 3 * x**2 - 2 * x**3)
    assert poly345.Ca == pytest.approx(10 / 3**0.5, rel=1e-13)
    assert poly4567.Ca == pytest.approx(84 * 5**0.5 / 25, rel=1e-13)
    assert (poly4567.Cj, cubic.Ca) == pytest.approx((52.5, 6), rel=1e-13)


def test_shape_and_type_follow_the_argument() -> None:
    assert isinstance(CYCLOIDAL(0.3), float)
    assert isinstance(CYCLOIDAL(1), float)
    assert CYCLOIDAL([0.1, 0.2]).shape == (2,)
    assert CYCLOIDAL(np.zeros((3, 4)), derivative=2).shape == (3, 4)
    assert CYCLOIDAL(sympy.Rational(1, 2)) == 0.5


@pytest.mark.parametrize("derivative", [-1, 4, 1.5, "1", None])
def test_only_four_derivatives(derivative: object) -> None:
    with pytest.raises(cm.InputError, match=r"^The derivative \(S, V, A, J\) (is|has to be)"):
        CYCLOIDAL(0.5, derivative=derivative)  # type: ignore[arg-type]


def test_the_learners_own_symbol_fits() -> None:
    assert sympy.Symbol("x") == x


def test_the_catalogue_cannot_be_changed() -> None:
    with pytest.raises(TypeError):
        LAWS["mine"] = CYCLOIDAL  # type: ignore[index]


def test_a_broken_law_is_caught() -> None:
    """A wrong coefficient, as it stands in print: the tests above would refuse it."""
    broken = MotionLaw("broken", x - sympy.sin(2 * sympy.pi * x) / (3 * sympy.pi))
    assert broken(0.0, derivative=1) != 0
    assert broken.Ca != pytest.approx(2 * np.pi)


@pytest.mark.parametrize("own", [*MONOTONE, *TURNING], ids=str)
def test_the_curves_of_the_tests_are_the_laws_once_more(own: MotionLaw) -> None:
    places = np.linspace(0, 1, 1001)
    assert own(places) == pytest.approx(CURVES[own.name](places), abs=1e-13)


@pytest.mark.parametrize("own", MONOTONE, ids=str)
def test_the_inverse_leads_back(own: MotionLaw) -> None:
    ways = np.linspace(0, 1, 501)
    places = own.inverse(ways)
    assert places[[0, -1]].tolist() == [0, 1]
    assert own(places) == pytest.approx(ways, abs=1e-13)
    well_conditioned = np.linspace(0.1, 0.9, 81)
    assert own.inverse(own(well_conditioned)) == pytest.approx(well_conditioned, abs=1e-12)


@pytest.mark.parametrize("own", MONOTONE, ids=str)
@pytest.mark.parametrize("count", [1, 8, 9, 4000])
def test_many_inverses_at_once_are_those_of_one_after_the_other(own: MotionLaw, count: int) -> None:
    ways = np.random.default_rng(count).permutation(np.linspace(0, 1, count))
    alone = [own.inverse(way) for way in ways[:25]]
    assert own.inverse(ways)[:25] == pytest.approx(alone, abs=1e-14)


@examples(100)
@given(unit_interval)
def test_the_inverse_is_solved_to_the_last_bit(s: float) -> None:
    for own in MONOTONE:
        assert own(own.inverse(s)) == pytest.approx(s, abs=2e-14)


@pytest.mark.parametrize("own", MONOTONE, ids=str)
def test_what_a_law_returns_is_not_refused_by_its_inverse(own: MotionLaw) -> None:
    """Its own rounding may carry it past 1 by some last digits."""
    ways = own(np.concatenate([np.geomspace(1e-6, 0.5, 4000), 1 - np.geomspace(1e-6, 0.5, 4000)]))
    assert own(own.inverse(ways)) == pytest.approx(ways, abs=1e-13)


def test_the_inverse_near_a_flat_end() -> None:
    """There S = 2/3 pi^2 x^3, so that x is the cube root of a very small number."""
    assert CYCLOIDAL.inverse(1e-9) == pytest.approx((1e-9 * 3 / 2 / np.pi**2) ** (1 / 3), rel=1e-5)
    assert CYCLOIDAL.inverse(0.5) == 0.5
    assert MONOTONE[6].inverse(0.5) == 0.5  # the joint of the parabolic law


def test_the_inverse_follows_the_shape_of_its_argument() -> None:
    assert isinstance(CYCLOIDAL.inverse(0.3), float)
    assert isinstance(CYCLOIDAL.inverse(1), float)
    assert np.shape(CYCLOIDAL.inverse([0.3])) == (1,)
    assert np.shape(CYCLOIDAL.inverse(np.full((2, 3), 0.3))) == (2, 3)


@pytest.mark.parametrize("own", TURNING, ids=str)
def test_a_law_that_turns_back_has_no_inverse(own: MotionLaw) -> None:
    assert not own.is_monotone
    with pytest.raises(cm.InputError, match=rf"^The law '{own.name}' turns back .*: use where_ab"):
        own.inverse(0.5)


def test_a_law_that_waits_on_its_way_is_left_at_the_first_place() -> None:
    half, quarter = sympy.Rational(1, 2), sympy.Rational(1, 4)
    pieces = (2 * x, x <= quarter), (half, x <= 3 * quarter), (2 * x - 1, True)
    waiting = MotionLaw("waiting", sympy.Piecewise(*pieces))
    assert waiting.is_monotone
    assert waiting.inverse([0.25, 0.5, 0.75]).tolist() == [0.125, 0.25, 0.875]
    assert waiting.where_above(0.5) == [(0.75, 1)]
    assert waiting.where_below(0.5) == [(0, 0.25)]


@pytest.mark.parametrize("s", [x / 2, x + 1, 1 - x])
def test_only_a_law_from_0_to_1_has_an_inverse(s: sympy.Expr) -> None:
    with pytest.raises(cm.InputError, match=r"^The law 'part' goes from S\(0\) = .*: subtract S"):
        MotionLaw("part", s).inverse(0.9)


def test_a_law_that_comes_back_is_to_be_cut_at_its_top() -> None:
    """It was to be divided by S(1) - S(0), which is 0."""
    lobe = MotionLaw("lobe", 16 * x**2 * (1 - x) ** 2)
    with pytest.raises(cm.InputError, match=r"cut it at its top, as with part\(0, 0\.5\) and part"):
        cm.peak_velocity(50, 55, 2000, lobe)
    parts = lobe.part(0, 0.5), lobe.part(0.5, 1)
    assert [part.curve.ends for part in parts] == [(0, 1), (0, 1)]


@pytest.mark.parametrize("own", [*MONOTONE, *TURNING], ids=str)
def test_where_a_law_is_above_agrees_with_samples(own: MotionLaw) -> None:
    places = (np.arange(20_000) + 0.5) / 20_000
    for s in (-0.5, -0.01, 0.0, 0.001, 0.3, 0.5, 0.77, 1.0, 1.01, 1.5):
        for parts, is_there in (
            (own.where_above(s), CURVES[own.name](places) > s),
            (own.where_below(s), CURVES[own.name](places) < s),
        ):
            covered = np.any(
                [(low < places) & (places < high) for low, high in [*parts, (2, 3)]], 0
            )
            assert np.count_nonzero(covered != is_there) <= 2  # where it ends


def test_a_law_that_dips_is_below_its_start_and_comes_back() -> None:
    assert DIPPING.where_above(0) == [pytest.approx((0.4, 1.0))]
    assert DIPPING.where_below(0) == [pytest.approx((0.0, 0.4))]
    assert OVERSHOOTING.where_above(1) == [pytest.approx((0.6, 1.0))]
    assert [branch.high for branch in DIPPING.curve.branches] == [
        pytest.approx(4 / 15, abs=1e-14),
        1,
    ]
    assert len(WAVY.where_above(0.5)) == 3
    lowest = DIPPING.curve.branches[0].at_high
    assert DIPPING.where_below(lowest) == []
    assert DIPPING.where_above(lowest) == [(0.0, 1.0)]


@pytest.mark.parametrize("name", LAWS)
def test_a_law_begins_at_0_and_ends_at_1_and_nowhere_else(name: str) -> None:
    law = LAWS[name]
    just = (np.nextafter(0, -1), -1e-9, np.nextafter(1, 2), 1 + 1e-9, 1.5, 2.0)
    for derivative in range(4):
        assert np.isfinite(law(np.array([0.0, 1.0]), derivative)).all()
        for outside in just:
            for places in (outside, [0.5, outside], np.array([0.5, outside])):
                with pytest.raises(cm.InputError, match=r"^The dimensionless time x = t/tm is"):
                    law(places, derivative)
    for outside in (-1e-9, 1 + 1e-9, 1.5, 2.0):  # what is nearer is rounding
        with pytest.raises(cm.InputError, match=r"^The dimensionless displacement S is"):
            law.inverse(outside)
    for wrong in (-1, 4, 1.5):
        with pytest.raises(cm.InputError, match=r"^The derivative \(S, V, A, J\) is"):
            law(0.5, wrong)  # type: ignore[arg-type]


MADE = {
    "slowed": lambda law: law.with_constant_velocity(0.3),
    "reversed": MotionLaw.reversed,
    "a part": lambda law: law.part(0.1, 0.7),
    "the slowest part": lambda law: law.part(0, 0.2),
    "a part of the slowed": lambda law: law.with_constant_velocity(0.3).part(0.1, 0.45),
}


@pytest.mark.parametrize("name", ["cycloidal", "modified sine", "3-4-5 polynomial"])
@pytest.mark.parametrize("make", MADE.values(), ids=MADE)
def test_what_is_made_of_a_law_has_its_own_factors(
    name: str, make: Callable[[MotionLaw], MotionLaw]
) -> None:
    law = make(LAWS[name])
    places = np.linspace(0, 1, 20_001)
    v, a = law(places, 1), law(places, 2)
    assert law.Cv == pytest.approx(np.abs(v).max(), rel=1e-6)
    assert law.Cq == pytest.approx(np.abs(v * a).max(), rel=1e-6)
    assert law.Cj_inside == pytest.approx(np.abs(law(places, 3)).max(), rel=1e-3)
    assert_near(v, np.gradient(law(places), places), abs=1e-2)


def test_constant_velocity_is_found_by_its_name() -> None:
    """It was taken for the constant acceleration, as tables were not."""
    named = cm.rise(50, over_deg=60, law="Constant velocity")
    assert named == cm.rise(50, over_deg=60, law=cm.CONSTANT_VELOCITY)
