"""What a law leaves behind, for many ratios at once, against closed forms and other solvers."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy as sp
from machines import HALF, Array
from scipy.integrate import quad

import cammotion as cm
from cammotion.dynamics import residual
from cammotion.dynamics.swing import Swing

RATIOS = np.concatenate([np.linspace(0.05, 20.01, 150), [0.5, 1, 2, 10, 10.5]])
EASY = [name for name in cm.LAWS if math.isfinite(cm.LAWS[name].Ca)]
ODD = cm.MotionLaw("odd", 3 * cm.x**2 - 2 * cm.x**3 + cm.x**2 * (1 - cm.x) ** 2 * sp.exp(cm.x))
LEANING = cm.polynomial((0, 0, 3), (1, 0, 0), name="leaning")
PLACES = np.linspace(0, 1, 8)
POINTS = cm.law_from_points(PLACES, PLACES**2 * (3 - 2 * PLACES))


def test_closed_forms() -> None:
    """All to 1e-12 of the stroke, in resonance too, where they are limits."""
    p = np.pi * RATIOS
    with np.errstate(all="ignore"):
        cycloid = np.abs(np.sin(p) / (p * (1 - RATIOS**2)))
        harmonic = np.abs(np.cos(p) / (1 - 4 * RATIOS**2))
    parabola = (np.sin(p / 2) / (p / 2)) ** 2
    cycloid[RATIOS == 1], harmonic[RATIOS == 0.5] = 1 / 2, np.pi / 4
    for law, known in (
        ("cycloidal", cycloid),
        ("simple harmonic", harmonic),
        ("constant acceleration", parabola),
    ):
        assert cm.residual_vibration(law, RATIOS) == pytest.approx(known, abs=1e-12), law


@pytest.mark.parametrize(
    ("ratio", "known"),
    [(10, (2.00, 2.00, 1.10)), (10.5, (3.24, 1.99, 1.10)), (5, (4.00, 2.02, 1.08))],
)
def test_three_two_and_1_06_are_one_phase(ratio: float, known: tuple[float, ...]) -> None:
    for law, factor in zip(
        ("constant acceleration", "simple harmonic", "cycloidal"), known, strict=True
    ):
        assert cm.dynamic_factor(law, ratio) == pytest.approx(factor, abs=0.0051)


@pytest.mark.parametrize("law", [*EASY, ODD, LEANING, POINTS])
def test_undamped_it_is_the_fourier_transform(law: str | cm.MotionLaw) -> None:
    move = cm.as_law(law)
    joints = [piece.low for piece in move.curve.pieces[1:]] + [
        *getattr(move, "sampled_at", ())[1:-1]
    ]
    for ratio in (0.4, 1.0, 3.3):
        w = 2 * math.pi * ratio
        parts = [
            quad(
                lambda at, f=f, w=w: move(at, 2) * f(w * at),
                0,
                1,
                points=joints or None,
                epsabs=1e-13,
            )[0]
            for f in (math.cos, math.sin)
        ]
        assert cm.residual_vibration(law, ratio) == pytest.approx(math.hypot(*parts) / w, abs=1e-10)
        assert cm.residual_vibration(move.reversed(), ratio) == pytest.approx(
            math.hypot(*parts) / w, abs=1e-10
        )


@pytest.mark.parametrize("damping", [0.0, 0.03, 0.4, 0.99])
@pytest.mark.parametrize("law", [*EASY, ODD, POINTS])
def test_the_response_of_one_mass_says_the_same(law: str | cm.MotionLaw, damping: float) -> None:
    move = cm.Move(stroke_mm=1000, angle_deg=360, rate_per_hour=3600, law=law)
    ratios = np.array([0.31, 1.0, 2.7, 9.4])
    left = cm.residual_vibration(law, ratios, damping)
    factors = cm.dynamic_factor(law, ratios, damping)
    for ratio, swung, factor in zip(ratios, left, factors, strict=True):
        mass = cm.MoveResponse(cm.tuned_mass(ratio, damping), move)
        known = mass.peak_deflection_mm(over=(1, 1 + 1 / ratio)).value / 1000
        assert swung == pytest.approx(known, rel=1e-9, abs=1e-13)
        peak = mass.peak_acceleration().value / cm.as_law(law).Ca
        assert factor == pytest.approx(peak, rel=1e-10)


@pytest.mark.parametrize("damping", [0.0, 0.03, 0.5])
@pytest.mark.parametrize(
    "law", ["cycloidal", "constant acceleration", "modified trapezoid", POINTS]
)
def test_a_run_says_the_same(law: str | cm.MotionLaw, damping: float) -> None:
    motion = cm.motion(
        "follower",
        *(cm.dwell(40), cm.return_(20, over_deg=90, law=law), cm.dwell(70)),
        *(cm.rise(20, over_deg=120, law=law), cm.dwell(40)),
        start_deg=-500,
    )
    ratios, rate = np.array([0.43, 1.71, 6.3]), 3000
    time_s = 90 / 360 * 1.2
    left = cm.running_residual(motion, ratios, damping)
    factors = cm.running_factor(motion, ratios, damping)
    first = motion.moves[0]
    for ratio, swung, factor in zip(ratios, left, factors, strict=True):
        run = cm.SteadyResponse(cm.tuned_mass(ratio / time_s, damping), motion, rate)
        w = 2 * math.pi * ratio / time_s
        z = run.deflection_mm(first.to_deg)
        v = 1000 * (run.velocity(first.to_deg) - motion.derivative(1, first.to_deg, rate))
        d = w * math.sqrt(1 - damping**2)
        times = np.linspace(0, 2 * math.pi / d, 100_001)
        swing = np.exp(-damping * w * times) * (
            z * np.cos(d * times) + (v + damping * w * z) / d * np.sin(d * times)
        )
        assert swung == pytest.approx(np.abs(swing).max() / 20, rel=1e-7)
        peak = run.peak_acceleration(over=(first.from_deg, first.to_deg)).value
        cam = cm.as_law(law).Ca * 0.02 / time_s**2
        assert factor == pytest.approx(peak / cam, rel=1e-9)


def test_many_points_are_one_curve() -> None:
    """A fine table of a law leaves what the law leaves."""
    places = np.linspace(0, 1, 301)
    table = cm.law_from_points(places, places**2 * (3 - 2 * places))
    assert cm.residual_vibration(table, RATIOS[:9]) == pytest.approx(
        cm.residual_vibration("cubic", RATIOS[:9]), abs=1e-9
    )


def test_shapes_and_alone_as_among_many() -> None:
    many = cm.dynamic_factor("modified sine", RATIOS, 0.02)
    assert cm.dynamic_factor("modified sine", float(RATIOS[40]), 0.02) == pytest.approx(
        many[40], rel=1e-11
    )
    assert isinstance(cm.residual_vibration("cubic", 3), float)
    assert np.shape(cm.residual_vibration("cubic", [[1, 2, 3]])) == (1, 3)
    assert np.shape(cm.running_factor(cm.EXAMPLE.die, [[1, 2], [3, 4]])) == (2, 2)


@pytest.mark.parametrize("waves", [2, 20, 32, 100])
def test_a_law_of_many_waves_by_its_closed_form(waves: int) -> None:
    """Its own waves were passed over where they are much shorter than a swing of the mass."""
    turns = 2 * sp.pi * waves
    law = cm.MotionLaw("waves", cm.x - sp.sin(turns * cm.x) / turns)
    places = np.linspace(0, 1, 400_001)
    for ratio in (0.4, 2.3):
        times = waves / ratio
        left = abs(math.sin(math.pi * ratio) / (math.pi * ratio) * times**2 / (times**2 - 1))
        assert cm.residual_vibration(law, ratio) == pytest.approx(left, abs=1e-12)
        own, free = np.sin(2 * np.pi * waves * places), np.sin(2 * np.pi * ratio * places)
        largest = np.abs(own - times * free).max() / abs(times**2 - 1)
        assert cm.dynamic_factor(law, ratio) == pytest.approx(largest, rel=1e-6)


def test_a_mass_that_hardly_swings_is_left_behind_by_the_whole_stroke() -> None:
    assert cm.residual_vibration("cycloidal", [1e-6, 1e-5, 1e-4]) == pytest.approx(1, abs=1e-6)
    assert cm.residual_vibration("cycloidal", 1e-6) == pytest.approx(1, abs=1e-9)


def test_many_ratios_are_taken_in_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever is asked, no block has more masses times ways than there is memory for."""
    asked: list[Callable[[], Array]] = [
        lambda: cm.residual_vibration("modified sine", RATIOS, 0.02),
        lambda: cm.dynamic_factor("modified sine", RATIOS, 0.02),
        lambda: cm.running_residual(cm.EXAMPLE.die, RATIOS, 0.02),
        lambda: cm.running_factor(cm.EXAMPLE.die, RATIOS, 0.02),
    ]
    at_once = [ask() for ask in asked]
    sizes: list[int] = []
    whole = Swing.__init__

    def counted(self: Swing, *given: Any) -> None:
        whole(self, *given)
        sizes.append(len(self.roots) * len(self.joints))

    monkeypatch.setattr(Swing, "__init__", counted)
    monkeypatch.setattr(residual, "_MOST", 10_000)
    for ask, known in zip(asked, at_once, strict=True):
        sizes.clear()
        assert ask() == pytest.approx(known, rel=1e-9)
        assert max(sizes) < 20_000


def test_a_move_beside_another_has_a_factor_and_no_residual() -> None:
    up_and_down = cm.motion(
        "follower", cm.rise(10, over_deg=90), cm.return_(10, over_deg=90), cm.dwell(180)
    )
    assert cm.running_factor(up_and_down, 4) > 1
    with pytest.raises(cm.InputError, match=r"goes on with a return, .* put a dwell between them"):
        cm.running_residual(up_and_down, 4)


def test_a_first_move_without_an_acceleration_has_no_factor() -> None:
    """It ended in a division by zero."""
    feed = cm.indexing_motion("feed", cm.rise(100, over_deg=360, law=cm.CONSTANT_VELOCITY), stops=4)
    with pytest.raises(cm.InputError, match="motion 'feed' keeps its velocity, so that there is"):
        cm.running_factor(feed, 3)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("cycloidal", 0), "period ratio tm/Tn is 0; .* give for example 4"),
        (("cycloidal", [1, -2]), r"period ratio tm/Tn is -2 \(at position 1\)"),
        (("cycloidal", 1001), "at most 1000"),
        (("cycloidal", 1e-14), "period ratio tm/Tn is 1e-14; .* at least 1e-06 and at most 1000"),
        (("cycloidal", 3, 1), "damping ratio is 1; .* at most 0.99"),
        (("cycloid", 3), "no motion law 'cycloid'"),
        ((cm.CONSTANT_VELOCITY, 3), "velocity of the law 'constant velocity' jumps"),
        ((HALF, 3), r"law 'half' goes from S\(0\) = 0 to S\(1\) = 0.5"),
    ],
)
def test_what_is_refused(given: tuple[Any, ...], words: str) -> None:
    for asked in (cm.residual_vibration, cm.dynamic_factor):
        with pytest.raises(cm.InputError, match=words):
            asked(*given)


def test_what_a_run_refuses() -> None:
    die = cm.EXAMPLE.die  # 55 of 360 deg: 11/4 swings in the move are 18 in the turn
    with pytest.raises(cm.InputError, match=r"At the period ratio 2.75 .* whole number of times"):
        cm.running_residual(die, [2.6, 2.75], 0)
    assert cm.running_residual(die, 2.75, 1e-3) > 0
    line = cm.motion(
        "line",
        *(cm.rise(10, over_deg=90, law=cm.CONSTANT_VELOCITY), cm.dwell(90)),
        *(cm.return_(10, over_deg=90), cm.dwell(90)),
    )
    with pytest.raises(cm.InputError, match="velocity of 'line' jumps"):
        cm.running_factor(line, 3)


@pytest.mark.parametrize("ask", [cm.running_residual, cm.running_factor])
@pytest.mark.parametrize("start_deg", [0, 150, 37.3])
def test_a_resonance_that_the_motion_leaves_out_is_one(ask: Any, start_deg: float) -> None:
    """Fifty swings in a turn, five in each move: the integral of A over the turn is 0 there.

    So nothing says how much it swings already, and 0/0 of rounding was the answer.
    """
    up, down = (make(50, over_deg=36) for make in (cm.rise, cm.return_))
    table = cm.motion("table", up, cm.dwell(60), down, cm.dwell(228), start_deg=start_deg)
    with pytest.raises(cm.InputError, match=r"period ratio 5 .* may swing more with each: give"):
        ask(table, [4.93, 5], 0)
    near = [ask(table, ratio, 0) for ratio in (5 - 1e-5, 5 + 1e-5)]  # what it comes to there
    assert near[0] == pytest.approx(near[1], rel=1e-3)


@pytest.mark.parametrize("ask", [cm.running_residual, cm.running_factor])
def test_where_nothing_moves_nothing_swings(ask: Any) -> None:
    with pytest.raises(cm.InputError, match="The motion 'table' has no move"):
        ask(cm.motion("table", cm.dwell(360)), [1, 2.5])
