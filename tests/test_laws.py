"""Motion laws against closed forms, and the properties that every law has to have."""

import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from machines import CURVES, DIPPING, MONOTONE, OVERSHOOTING, TURNING, WAVY, examples

import cammotion as cm
from cammotion import LAWS, MotionLaw, x

CYCLOIDAL = LAWS["cycloidal"]
unit_interval = st.floats(0, 1)

# name: Cv, Ca, Cj in closed form
FACTORS = {"cycloidal": (2, 2 * np.pi, 4 * np.pi**2)}


@pytest.fixture(params=LAWS, ids=str)
def law(request: pytest.FixtureRequest) -> MotionLaw:
    return LAWS[request.param]


def test_a_law_goes_from_0_to_1_at_rest(law: MotionLaw) -> None:
    assert law.s.subs(x, 0) == 0
    assert law.s.subs(x, 1) == 1
    assert law(0.0, derivative=1) == 0
    assert law(1.0, derivative=1) == pytest.approx(0, abs=1e-15)


def test_a_law_covers_the_stroke(law: MotionLaw) -> None:
    assert sympy.integrate(law.v, (x, 0, 1)) == 1


def test_a_law_never_turns_back(law: MotionLaw) -> None:
    assert np.diff(law(np.linspace(0, 1, 10_001))).min() >= 0


@given(unit_interval)
def test_a_law_is_symmetric(place: float) -> None:
    for law in LAWS.values():
        assert law(1 - place) == pytest.approx(1 - law(place), abs=1e-14)


@given(unit_interval)
def test_compiled_and_symbolic_values_agree(place: float) -> None:
    for law in LAWS.values():
        for n, expression in enumerate([law.s, law.v, law.a, law.j]):
            exact = float(expression.subs(x, sympy.Rational(place)).evalf(30))
            assert law(place, derivative=n) == pytest.approx(exact, rel=1e-12, abs=1e-12)


@given(st.floats(1e-3, 1 - 1e-3), st.integers(0, 2))
def test_each_derivative_is_the_slope_of_the_one_before(place: float, n: int) -> None:
    step = 1e-5
    for law in LAWS.values():
        slope = (law(place + step, n) - law(place - step, n)) / (2 * step)
        assert law(place, n + 1) == pytest.approx(slope, abs=1e-6)


def test_the_catalogue_and_the_table_of_factors_name_the_same_laws() -> None:
    assert set(FACTORS) == set(LAWS)


def test_peak_factors_are_the_closed_forms(law: MotionLaw) -> None:
    assert (law.Cv, law.Ca, law.Cj) == pytest.approx(FACTORS[law.name], rel=1e-14)


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
    with pytest.raises(cm.InputError, match="it has to be 0 for S, 1 for V, 2 for A or 3 for J"):
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


@examples(100)
@given(unit_interval)
def test_the_inverse_is_solved_to_the_last_bit(s: float) -> None:
    for own in MONOTONE:
        assert own(own.inverse(s)) == pytest.approx(s, abs=2e-14)


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
    assert DIPPING.where_above(0) == [(0.4, 1.0)]
    assert DIPPING.where_below(0) == [(0.0, 0.4)]
    assert OVERSHOOTING.where_above(1) == [pytest.approx((0.6, 1.0))]
    assert [branch.high for branch in DIPPING.branches] == [4 / 15, 1]
    assert len(WAVY.where_above(0.5)) == 3
    lowest = DIPPING(4 / 15)
    assert DIPPING.where_below(lowest) == []
    assert DIPPING.where_above(lowest) == [(0.0, 1.0)]
