"""One mass on a spring, against solvers that know nothing of its formulas."""

import math
import time
from typing import Any

import numpy as np
import pytest
import sympy as sp
from machines import HALF, Array, make_diagram, make_die, make_mill
from scipy.integrate import quad, solve_ivp
from scipy.signal import lsim

import cammotion as cm

NAMES = [*cm.LAWS]
n, damping = sp.symbols("n D", positive=True)
X = np.linspace(-0.25, 2.25, 101)
SAMPLED = cm.law_from_points(np.linspace(0, 1, 7), np.linspace(0, 1, 7) ** 2, end_slopes=(0, 2))


REST = cm.x**2 * (1 - cm.x) ** 2
ODD = cm.MotionLaw("odd", 3 * cm.x**2 - 2 * cm.x**3 + REST * sp.exp(cm.x))


def solved(law: cm.MotionLaw, swings: float, ratio: float, places: Array) -> dict[int, Array]:
    """Return position, velocity and acceleration by stepping through the equation of the spring."""
    w = 2 * math.pi * swings
    pieces = law.curve.derived(2).pieces
    state, found = np.zeros(2), {place: (0.0, 0.0) for place in places if place <= 0}
    for low, high, piece in [*((p.low, p.high, p) for p in pieces), (1.0, places[-1], None)]:

        def rates(at: float, z: Any, piece: Any = piece) -> list[float]:
            given = piece.at(at) if piece else 0.0
            return [z[1], -given - 2 * ratio * w * z[1] - w**2 * z[0]]

        inside = [place for place in places if low < place <= high]
        ran = solve_ivp(
            rates,
            (low, high),
            state,
            t_eval=sorted({*inside, high}),
            rtol=1e-10,
            atol=1e-12,
            max_step=0.02,
        )
        found |= {place: tuple(ran.y[:, at]) for at, place in enumerate(inside)}
        state = ran.y[:, -1]
    z, rate = np.array([found[place] for place in places]).T
    cam = [law(np.clip(places, 0, 1), order) * ((places >= 0) | (order == 0)) for order in range(2)]
    cam[1] = np.where((places < 0) | (places > 1), 0, cam[1])
    return {0: cam[0] + z, 1: cam[1] + rate, 2: -(2 * ratio * w * rate + w**2 * z)}


@pytest.mark.parametrize("law", [*cm.LAWS.values(), SAMPLED.part(0, 0.5), cm.scca(0.1, 0.7, 0.2)])
def test_the_equation_solved_step_by_step(law: cm.MotionLaw) -> None:
    for swings, ratio in ((0.7, 0.3), (3.3, 0.02)):
        if not math.isfinite(law.Ca):
            continue
        mass, known = cm.OneMass(law, swings, ratio), solved(law, swings, ratio, X)
        for derivative in range(3):
            found = mass(X, derivative)
            assert found == pytest.approx(known[derivative], abs=2e-7 * law.Ca), derivative


@pytest.mark.parametrize("name", ["cycloidal", "modified trapezoid", "3-4-5 polynomial"])
def test_the_transfer_function_of_scipy(name: str) -> None:
    w = 2 * math.pi * 2.6
    at = np.linspace(0, 2, 20001)
    cam = np.where(at <= 1, cm.LAWS[name](np.minimum(at, 1), 2), 0)
    _, known, _ = lsim(([0.1 * w, w**2], [1, 0.1 * w, w**2]), cam, at)
    assert cm.OneMass(name, 2.6, 0.05)(at, 2) == pytest.approx(known, abs=1e-4)


@pytest.mark.parametrize("name", NAMES)
def test_undamped_it_swings_on_as_the_fourier_transform_says(name: str) -> None:
    law = cm.LAWS[name]
    joints = [piece.low for piece in law.curve.pieces[1:]]
    for swings in (0.6, 1.0, 3.0, 4.4):
        w = 2 * math.pi * swings
        parts = [
            quad(lambda at, f=f, w=w: law(at, 2) * f(w * at), 0, 1, points=joints, limit=200)[0]
            for f in (math.cos, math.sin)
        ]
        after = np.linspace(1, 1 + 1 / swings, 721)
        swung = np.abs(cm.OneMass(law, swings, 0)(after, 2)).max()
        assert swung == pytest.approx(w * math.hypot(*parts), rel=2e-5, abs=1e-5 * law.Ca)


def test_a_stiff_spring_follows_a_smooth_law() -> None:
    inside = np.linspace(0, 1, 501)
    for name in ("cycloidal", "modified trapezoid", "4-5-6-7 polynomial"):
        law, stiff = cm.LAWS[name], cm.OneMass(name, 900, 0.02)
        assert stiff(inside, 2) == pytest.approx(law(inside, 2), abs=0.03)
        assert stiff(inside) == pytest.approx(law(inside), abs=1e-6)
        assert stiff.amplification == pytest.approx(1, abs=0.01)


def test_a_jump_is_felt_twice_and_thrice() -> None:
    """Put on from rest 4 is felt as 8; from +4 at rest to -4 as -12, and as -16 if it swings."""
    undamped = cm.OneMass("constant acceleration", 20, 0)
    assert np.max(undamped(np.linspace(0, 0.5, 5001), 2)) == pytest.approx(8, abs=1e-4)
    quiet = cm.OneMass("constant acceleration", 1000, 0.003)  # the first swing has died away
    assert quiet.amplification == pytest.approx(3, abs=0.04)
    assert quiet(0.4999, 2) == pytest.approx(4, abs=1e-3)
    assert cm.OneMass("constant acceleration", 5, 0).amplification == pytest.approx(4, abs=1e-5)
    assert cm.OneMass("constant acceleration", 4, 0).amplification == pytest.approx(2, abs=1e-5)


def test_undamped_the_three_jumps_add_up_or_cancel() -> None:
    for swings in (1, 2, 2.5, 3, 4, 7.3):
        after = np.linspace(1, 1 + 1 / swings, 721)
        swung = np.abs(cm.OneMass("constant acceleration", swings, 0)(after, 2)).max()
        assert swung == pytest.approx(16 * math.sin(math.pi * swings / 2) ** 2, abs=1e-3)


@pytest.mark.parametrize(
    ("law", "at_12_hz", "at_4_55_hz"),
    [
        ("modified trapezoid", 0.815, 1.550),
        ("cycloidal", 0.905, 1.213),
        ("3-4-5 polynomial", 0.893, 1.232),
        ("modified sine", 0.955, 1.313),
    ],
)
def test_the_die_of_notebook_06(law: str, at_12_hz: float, at_4_55_hz: float) -> None:
    """What lsim finds there: a single rise over the widest angle, 50 mm, damped by 2 percent."""
    rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.6506))
    diagram = make_diagram(make_mill(), make_die(law=law))
    move = cm.widest_move(diagram, "die", rule).diagram.moves("die")[0]
    for hz, known in ((12, at_12_hz), (4.55, at_4_55_hz)):
        peak = cm.OneMass(law, hz * move.time_s).peak * 0.050 / move.time_s**2
        assert peak == pytest.approx(known, abs=2e-3)


def test_the_expressions_are_what_is_computed() -> None:
    for name in ("constant acceleration", "modified sine", "cubic"):
        mass = cm.OneMass(name, n, damping)
        assert mass.a.free_symbols == {cm.x, n, damping}
        numbers = cm.OneMass(name, 3.7, 0.1)
        for at in (-0.2, 0.13, 0.77, 1.4):
            values = {cm.x: at, n: 3.7, damping: 0.1}
            assert float(mass.a.subs(values)) == pytest.approx(numbers(at, 2), rel=1e-10)
            cam = float(cm.LAWS[name](min(max(at, 0), 1)))
            assert cam + float(mass.z.subs(values)) == pytest.approx(numbers(at), rel=1e-10)


def test_the_expression_obeys_the_equation() -> None:
    """In place and time, exactly: a'' + 2 D w a' + w^2 a of the mass is what the cam asks for."""
    w = 2 * sp.pi * n
    for name in ("constant acceleration", "cycloidal"):
        z = cm.OneMass(name, n, damping).z
        left = z.diff(cm.x, 2) + 2 * damping * w * z.diff(cm.x) + w**2 * z
        for at in (sp.Rational(1, 7), sp.Rational(4, 5)):
            values = {cm.x: at, n: sp.Rational(9, 4), damping: sp.Rational(1, 30)}
            given = cm.LAWS[name].a.subs(cm.x, at)
            assert abs(float((left.subs(values) + given).evalf(30))) < 1e-20


def test_undamped_in_resonance() -> None:
    """The cycloid's own frequency: Z'' + w^2 Z = -w sin wx has Z = (wx cos wx - sin wx)/(2 w)."""
    at = np.linspace(0, 1, 201)
    w = 2 * math.pi
    z = (w * at * np.cos(w * at) - np.sin(w * at)) / (2 * w)
    found = cm.OneMass("cycloidal", 1, 0)
    assert found(at, 2) == pytest.approx(-(w**2) * z, abs=1e-5)
    assert found.amplification == pytest.approx(math.pi, rel=1e-5)


def test_the_largest_is_not_missed() -> None:
    rng = np.random.default_rng(5)
    for name in NAMES:
        for swings in (0.3, 0.7, rng.uniform(1, 30)):  # after the move, where the spring is soft
            mass = cm.OneMass(name, swings, rng.uniform(0, 0.5))
            dense = np.abs(mass(np.linspace(0, 5, 60001), 2)).max()
            assert dense * (1 - 1e-8) <= mass.peak <= dense * (1 + 1e-4)


def test_shapes() -> None:
    mass = cm.OneMass("cycloidal", 3)
    assert isinstance(mass(0.5), float)
    assert mass([[0.1, 0.2], [0.3, 1.7]], 2).shape == (2, 2)
    assert mass([-1.0, 0.0], 0) == pytest.approx([0, 0])
    assert mass(50.0) == pytest.approx(1)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("cycloidal", 0), "period ratio .* is 0; .* give for example 4"),
        (("cycloidal", math.nan), "period ratio"),
        (("cycloidal", 1001), "at most 1000"),
        (("cycloidal", 3, 1), "damping ratio is 1; .* at most 0.99"),
        (("cycloidal", 3, -0.1), "damping ratio"),
        ((ODD, 3), "no power and no wave"),
        (("cycloid", 3), "no motion law 'cycloid': did you mean 'cycloidal'"),
        ((cm.MotionLaw("line", cm.x), 3), "velocity of the law 'line' jumps"),
        ((HALF, 3), r"law 'half' goes from S\(0\) = 0 to S\(1\) = 0.5"),
    ],
)
def test_what_is_refused(given: tuple[Any, ...], words: str) -> None:
    with pytest.raises(cm.InputError, match=words):
        cm.OneMass(*given)


def test_numbers_take_no_formula() -> None:
    """It was written out first: 6 s for 361 points."""
    even = np.linspace(0, 1, 361)
    law = cm.law_from_points(even, even**2 * (3 - 2 * even))
    began = time.perf_counter()
    assert cm.OneMass(law, 4).peak == pytest.approx(cm.OneMass("cubic", 4).peak, rel=1e-6)
    assert time.perf_counter() - began < 1.5


HALF_TURN, CUBIC = sp.pi * cm.x / 2, 3 * cm.x**2 - 2 * cm.x**3


@pytest.mark.parametrize(
    ("power", "waves"),
    [
        (sp.sin(HALF_TURN) ** 2, (1 - sp.cos(2 * HALF_TURN)) / 2),
        (
            CUBIC + sp.sin(2 * HALF_TURN) ** 4,
            CUBIC + (3 - 4 * sp.cos(4 * HALF_TURN) + sp.cos(8 * HALF_TURN)) / 8,
        ),
    ],
)
def test_a_power_of_a_wave_is_waves(power: sp.Expr, waves: sp.Expr) -> None:
    """It was refused as no wave."""
    laws = (cm.MotionLaw("it", s) for s in (power, waves))
    found, known = (cm.OneMass(law, 4.3).a.subs(cm.x, 0.3) for law in laws)
    assert float(found) == pytest.approx(float(known), rel=1e-12)


def test_what_is_refused_later() -> None:
    with pytest.raises(cm.InputError, match=r"^The derivative .*acceleration\) is 3; .* at most 2"):
        cm.OneMass("cycloidal", 3)(0.5, 3)
    with pytest.raises(cm.InputError, match=r"OneMass\('cycloidal', swings=n, .* has symbols"):
        cm.OneMass("cycloidal", n)(0.5)


@pytest.mark.parametrize(("law", "swings"), [("cycloidal", 1), ("simple harmonic", 0.5)])
def test_in_resonance_an_undamped_mass_has_numbers_and_no_formula(law: str, swings: float) -> None:
    """There the formula is 0/0, and what was written was nan; the numbers are its limit."""
    exact, near = cm.OneMass(law, swings, 0), cm.OneMass(law, swings + 1e-6, 0)
    for written in ("z", "a"):
        with pytest.raises(cm.InputError, match=r"formula is 0/0: call it for numbers"):
            getattr(exact, written)
    assert exact(0.3, 2) == pytest.approx(float(near.a.subs(cm.x, 0.3)), rel=1e-4)
    assert not cm.OneMass(law, swings, 0.02).z.has(sp.nan)


def test_a_number_of_sympys_is_a_number() -> None:
    """It was told to have symbols; and what is nearly no swing is refused at once."""
    assert cm.OneMass("cycloidal", sp.Integer(4)).peak == cm.OneMass("cycloidal", 4).peak
    with pytest.raises(cm.InputError, match=r"is 1e-12; it has to be .* at least 1e-06"):
        cm.OneMass("cycloidal", 1e-12)
