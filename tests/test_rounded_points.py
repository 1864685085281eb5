"""A law from rounded points says what the rounding does; smoothed, repeated or monotone fits."""

import itertools
import warnings
from types import FunctionType
from typing import Any

import numpy as np
import pytest
from machines import Array
from scipy.interpolate import CubicSpline, PchipInterpolator
from test_sampled import uneven

import cammotion as cm
from cammotion.measured.from_points import law_from_points, step_of

PLACES = np.linspace(0, 1, 361)
CYCLOID = PLACES - np.sin(2 * np.pi * PLACES) / (2 * np.pi)
ROUNDED = (50 * CYCLOID).round(2) / 50
"""50 mm of a cycloid, printed to a hundredth of a mm."""


def quietly(*given: Any, **named: Any) -> cm.SampledLaw:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        return cm.law_from_points(*given, **named)


def test_the_rounding_of_a_printed_table_is_told() -> None:
    """On even points the spline's A changes by 12 e/h² at most, by 6 e/h² as a mean square."""
    with pytest.warns(UserWarning, match=r"rounded to 0\.0002\. .* up to 156, where A is 112 at"):
        law = cm.law_from_points(PLACES, ROUNDED, name="cam")
    assert law.Ca == pytest.approx(112, abs=0.5)
    assert law.rounding.step == pytest.approx(0.0002)
    inside = quietly(PLACES, ROUNDED, fit="periodic").rounding
    assert inside.bound == pytest.approx(12 * 1e-4 * 360**2)
    assert inside.rms == pytest.approx(6 * 1e-4 / np.sqrt(3) * 360**2)
    assert law.rounding.bound == pytest.approx(inside.bound, rel=0.05)
    assert (
        repr(law) == "MotionLaw('cam', sampled at 361 points rounded to 0.0002: Ca within 1.6e+02)"
    )


def test_smoothing_by_cross_validation_finds_the_cycloid_again() -> None:
    law = cm.law_from_points(PLACES, ROUNDED, fit="smooth")  # and does not warn
    assert law.amount > 0
    assert law.Ca == pytest.approx(2 * np.pi, rel=0.01)
    assert np.max(np.abs(law(PLACES) - CYCLOID)) < 1e-4
    assert (law(0.0), law(1.0), law(0.0, 1), law(1.0, 1)) == pytest.approx((0, 1, 0, 0))
    off = np.max(np.abs(law(PLACES, 2) - 2 * np.pi * np.sin(2 * np.pi * PLACES)))
    assert off < 0.1


def dense_at_the_ends() -> tuple[Array, Array]:
    """Return 42 points of a cycloid: errors count most where the turn closes."""
    x = (1 - np.cos(np.pi * np.linspace(0, 1, 42))) / 2
    return x, x - np.sin(2 * np.pi * x) / (2 * np.pi)


@pytest.mark.parametrize(
    ("fit", "amount"), [("through", None), ("smooth", 1e-4), ("periodic", 1e-4), ("periodic", None)]
)
@pytest.mark.parametrize(
    "points",
    [uneven(), (PLACES[::30], CYCLOID[::30]), dense_at_the_ends()],
    ids=["uneven", "even", "dense at the ends"],
)
def test_the_bound_and_the_mean_square_are_reached(
    fit: Any, amount: float | None, points: tuple[Array, Array]
) -> None:
    """Each point off alone by half a step: what A changes by is summed by hand."""
    x, s = points
    law = quietly(x, s, fit=fit, smoothing=amount, step=0.001)
    first = 1 if fit != "periodic" else 0  # the ends are exact, of a repeated law the slope is not
    shares = []
    for n in range(1, x.size - 1):
        moved = s.copy()
        moved[n] += 0.0005
        shares.append(quietly(x, moved, fit=fit, smoothing=amount)(x, 2) - law(x, 2))
    if not first:
        shares.append(-np.sum(shares, axis=0))  # all moved alike change nothing
    bound = np.sum(np.abs(shares), axis=0).max()
    rms = np.sqrt(np.sum(np.square(shares), axis=0).max() / 3)
    assert law.rounding == pytest.approx((0.001, rms, bound), rel=1e-6)


def test_random_rounding_stays_within_what_is_said() -> None:
    law = quietly(PLACES, ROUNDED)
    rng = np.random.default_rng(6)
    truth = 2 * np.pi * np.sin(2 * np.pi * PLACES)
    errors = []
    for _ in range(50):
        read = CYCLOID + 2e-4 * rng.uniform(-0.5, 0.5, 361)
        read[[0, -1]] = 0, 1
        errors.append((quietly(PLACES, read)(PLACES, 2) - truth)[5:-5])
    assert np.max(np.abs(errors)) < law.rounding.bound
    assert np.sqrt(np.mean(np.square(errors))) == pytest.approx(law.rounding.rms, rel=0.03)


@pytest.mark.parametrize("number", [12, 39, 40, 41, 200, 129])
def test_probing_many_points_at_once_is_exact(number: int) -> None:
    """40 at a time and the closed form, whatever is left over."""
    x = np.linspace(0, 1, number + 1)
    law = quietly(x, x**2 * (3 - 2 * x), fit="periodic", step=1e-6)
    if number % 2 == 0:
        assert law.rounding.bound == pytest.approx(6e-6 * number**2)
    eigen = np.pi * np.arange(number) / number
    bend = 12 * np.sin(eigen) ** 2 * number**2 / (3 - 2 * np.sin(eigen) ** 2)
    assert law.rounding.rms == pytest.approx(1e-6 / np.sqrt(12) * np.sqrt(np.mean(bend**2)))


def test_a_smoothed_law_costs_least() -> None:
    """The mean square of what is changed plus the amount times that of A, from the law alone."""
    x, s, amount = *uneven(), 1e-5

    def cost(values: Array) -> float:
        spline = CubicSpline(x, values, bc_type=[(1, 0.2), (1, -0.1)])
        low, high = spline(x[:-1], 2), spline(x[1:], 2)
        bent = np.sum(np.diff(x) * (low**2 + low * high + high**2) / 3)
        return float(np.mean((s - values)[1:-1] ** 2) + amount * bent)

    law = quietly(x, s, fit="smooth", smoothing=amount, end_slopes=(0.2, -0.1))
    values = np.asarray(law(x))
    for n in range(1, x.size - 1):
        for by in (-1e-5, 1e-5):
            other = values.copy()
            other[n] += by
            assert cost(other) > cost(values)


def test_a_repeated_law_goes_on_as_it_began() -> None:
    x = np.linspace(0, 1, 61)
    s = x + 0.05 * np.sin(2 * np.pi * x) - 0.02 * (np.cos(4 * np.pi * x) - 1)
    law = cm.law_from_points(x, s, fit="periodic")
    for order in (1, 2):
        assert law(0.0, order) == pytest.approx(law(1.0, order), abs=1e-9)
    assert law(0.37, 1) == pytest.approx(
        1 + 0.1 * np.pi * np.cos(2 * np.pi * 0.37) + 0.08 * np.pi * np.sin(4 * np.pi * 0.37),
        abs=1e-4,
    )
    smooth = cm.law_from_points(x, s, fit="periodic", smoothing=1e-6)
    assert (smooth(0.0), smooth(1.0)) == (0, pytest.approx(1, abs=1e-15))
    wave = 0.05 / (1 + 1e-6 * (2 * np.pi) ** 4)
    assert smooth(0.25) - smooth(0.75) + 0.5 == pytest.approx(2 * wave, rel=1e-4)


def test_the_monotone_law_never_swings_over() -> None:
    x, s = np.array([0, 0.2, 0.4, 0.5, 0.6, 0.8, 1]), np.array([0, 0, 0, 0.5, 1, 1, 1.0])
    law = cm.law_from_points(x, s, fit="monotone")
    assert law.is_monotone
    assert not cm.law_from_points(x, s).is_monotone
    there = np.linspace(0, 1, 401)
    assert law(there) == pytest.approx(PchipInterpolator(x, s)(there), abs=1e-12)
    assert law.Cj == np.inf  # its acceleration jumps at the points
    assert [at for at, _ in law.jerk_impulses] == pytest.approx([0.4, 0.5, 0.6])
    assert law.inverse(0.5) == pytest.approx(0.5)


def test_slopes_with_which_it_would_swing_over_are_refused() -> None:
    x = np.linspace(0, 1, 21)
    s = 3 * x**2 - 2 * x**3
    steepest = 3 * s[1] / x[1]
    for slopes, end in (((8, 8), "first"), ((0, 1.001 * steepest), "last"), ((-0.1, 0), "first")):
        with pytest.raises(cm.InputError, match=f"V at the {end} point .* swing over"):
            cm.law_from_points(x, s, fit="monotone", end_slopes=slopes)
    kept = cm.law_from_points(x, s, fit="monotone", end_slopes=(0.999 * steepest, 0))
    assert kept.is_monotone


def test_a_monotone_law_says_what_its_rounding_does() -> None:
    law = quietly(PLACES, ROUNDED, fit="monotone")
    assert law.rounding.bound > law.rounding.rms > 40
    errors = 1e-4 * np.random.default_rng(8).uniform(-1, 1, (361, 1000))  # half a step, as drawn
    in_turn = 1e-4 * (-1) ** np.arange(361)
    errors[[0, -1]] = in_turn[[0, -1]] = 0
    sides = np.concatenate([PLACES[5:-5] - 1e-9, PLACES[5:-5] + 1e-9])
    bends = [
        PchipInterpolator(PLACES, ways, axis=0).derivative(2)(sides)
        for ways in (ROUNDED[:, None] + errors, ROUNDED[:, None], (ROUNDED + in_turn)[:, None])
    ]
    assert law.rounding.bound > np.abs(bends[2] - bends[1]).max() * 0.999
    rms = np.sqrt(np.mean(np.square(bends[0] - bends[1]), axis=1))
    assert law.rounding.rms == pytest.approx(rms.max(), rel=0.1)
    assert quietly(PLACES, CYCLOID, fit="monotone").rounding == (0, 0, 0)


EXACT = {
    "a cubic in full digits": np.linspace(0, 1, 19) ** 2 * (3 - 2 * np.linspace(0, 1, 19)),
    "a straight line": np.linspace(0, 1, 101),
    "squares": np.linspace(0, 1, 101) ** 2,
    "the cycloid": CYCLOID,
}


@pytest.mark.parametrize("s", EXACT.values(), ids=EXACT)
def test_exact_points_are_taken_for_exact(s: Array) -> None:
    law = cm.law_from_points(np.linspace(0, 1, s.size), s)
    assert law.step == 0
    assert law.rounding == (0, 0, 0)


def test_few_points_are_chosen_by_hand() -> None:
    assert cm.law_from_points(*uneven()).step == 0
    assert quietly(*uneven(), step=0.01).step == 0.01


@pytest.mark.parametrize(
    ("stroke", "digits", "step"), [(50, 2, 0.0002), (40, 1, 0.0025), (100, 3, 1e-5), (1, 4, 1e-4)]
)
def test_the_step_is_told_from_the_digits(stroke: float, digits: int, step: float) -> None:
    assert step_of((stroke * CYCLOID).round(digits) / stroke) == pytest.approx(step)


def test_a_table_knows_its_step() -> None:
    """For a stroke of 47.3 mm the digits of s tell nothing."""
    angles = np.arange(20.0, 201.0)
    s = CYCLOID[::2]
    table = cm.CamTable(angles, 100 - (47.3 * s).round(2), step_mm=0.01)
    with pytest.warns(UserWarning, match=r"rounded to 0\.000211"):
        law = cm.law_from_table(table)
    assert law(0.3) == pytest.approx(0.3 - np.sin(0.6 * np.pi) / (2 * np.pi), abs=3e-4)
    smooth = cm.law_from_table(table, fit="smooth", name="return")
    assert smooth.Ca == pytest.approx(2 * np.pi, rel=0.02)
    assert smooth.rounding.step == pytest.approx(0.01 / 47.3)


def test_a_rough_choice_of_smoothing_is_warned_of() -> None:
    with pytest.warns(UserWarning, match=r"take more smoothing, or points with more digits"):
        cm.law_from_points(PLACES, ROUNDED, fit="smooth", smoothing=1e-12)


RISE = cm.CamTable(np.arange(361.0), (50 * CYCLOID).round(2), step_mm=0.01)
WAVE = (25 - 25 * np.cos(2 * np.pi * PLACES[:-1])).round(1)
TURN = cm.CamTable(np.arange(360.0), WAVE, step_mm=0.1, is_cycle=True)


@pytest.mark.parametrize(
    "make",
    [
        lambda: cm.law_from_points(PLACES, ROUNDED),
        lambda: law_from_points(PLACES, ROUNDED),
        lambda: cm.law_from_table(RISE),
        lambda: cm.law_from_table(table=RISE, name="cam"),
        lambda: cm.motion_from_table("cam", TURN),
    ],
)
def test_the_line_that_is_warned_of_is_the_callers(make: FunctionType) -> None:
    with pytest.warns(UserWarning, match="That alone (changes|may change)") as told:
        make()
    (where,) = {(each.filename, each.lineno) for each in told}
    assert where == (__file__, make.__code__.co_firstlineno)


def test_a_law_from_points_keeps_no_rounding_when_it_is_changed() -> None:
    law = quietly(PLACES, ROUNDED)
    assert repr(law.reversed()) == "MotionLaw('sampled law, reversed')"
    assert law.reversed()(0.25) == pytest.approx(1 - law(0.75))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"fit": "best"}, "There is no fit 'best': use one of 'through', 'smooth', 'monotone'"),
        ({"smoothing": 1e-6}, "smoothing is 1e-06, and a fit 'through' has none"),
        (
            {"fit": "periodic", "end_slopes": (5, -5)},
            "end_slopes are .5, -5., and a fit",
        ),
        ({"fit": "smooth", "smoothing": -1}, "amount of smoothing is -1"),
        ({"step": -0.1}, r"step of the points is -0\.1"),
        ({"fit": "smooth", "step": np.nan}, "step of the points is nan"),
    ],
)
def test_other_fits_are_refused(given: Any, said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.law_from_points(PLACES, CYCLOID, **given)


def test_too_many_points_to_smooth_are_refused() -> None:
    x = np.linspace(0, 1, 1001)
    with pytest.raises(cm.InputError, match="There are 1001 points to be smoothed"):
        cm.law_from_points(x, x**2 * (3 - 2 * x), fit="smooth")


@pytest.mark.parametrize(
    ("angles", "positions", "is_cycle", "said"),
    [
        (range(8), [0, 1, 2, 3, 3, 2, 1, 0], False, "goes from 0 to 0 mm; a law is one rise"),
        (range(8), range(8), True, "goes from 0 to 7 mm and is a cycle; a law is"),
        (range(8), [0, 5, 9, 5, 0, -3, -2, 1], False, "0 to 1 mm by way of -3 and 9 mm; a law is"),
    ],
)
def test_a_table_that_is_no_rise_is_refused(
    angles: Any, positions: Any, is_cycle: bool, said: str
) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.law_from_table(cm.CamTable(list(angles), list(positions), is_cycle=is_cycle))  # type: ignore[arg-type]


def test_all_signs_on_a_few_points() -> None:
    """With 5 points between the ends every pattern of signs can be tried."""
    x = np.array([0, 0.15, 0.3, 0.55, 0.7, 0.9, 1])
    law = quietly(x, x, step=0.02)
    most = 0.0
    for signs in itertools.product((-1, 1), repeat=5):
        moved = x + 0.01 * np.array([0, *signs, 0])
        most = max(most, float(np.max(np.abs(quietly(x, moved)(x, 2) - law(x, 2)))))
    assert law.rounding.bound == pytest.approx(most)
