"""What notebook 10 says of its numbers, by NumPy and SciPy, without the package's dynamics."""

import math
from collections.abc import Callable
from functools import cache

import follower_pictures
import numpy as np
import pytest
from machines import Array
from scipy.integrate import quad, solve_ivp
from test_claims import says

import cammotion as cm

NAMES = [name for name, law in cm.LAWS.items() if np.isfinite(law.Ca)]
N = 400_001
STEPS = 50_000


def left(acceleration: Callable[[Array], Array], n: float) -> float:
    """Return the undamped swing after a move, by the integral of notebook 10 on a fine grid."""
    u = (np.arange(N) + 0.5) / N
    wave = np.exp(2j * np.pi * n * u) * acceleration(u)
    return float(abs(wave.mean()) / (2 * np.pi * n))


def by_law(name: str, n: float) -> float:
    return left(lambda u: np.asarray(cm.LAWS[name](u, derivative=2)), n)


@cache
def peak(name: str, n: float, damping: float = 0.02) -> tuple[float, float]:
    """Return the largest accelerations of the mass during the move and after it.

    By Duhamel's integral, summed over small steps: what each push has left of itself until then.
    """
    w = 2 * math.pi * n
    swing = w * complex(-damping, math.sqrt(1 - damping**2))
    width = (1 + 1 / n) / STEPS
    u = (np.arange(STEPS) + 0.5) * width
    push = np.zeros(STEPS)
    push[u < 1] = cm.LAWS[name](u[u < 1], derivative=2)
    each = push * np.exp(-swing * u) * width
    state = np.exp(swing * u) * (np.cumsum(each) - each / 2) / swing.imag
    z, speed = -state.imag, -(swing * state).imag
    size = np.abs(2 * damping * w * speed + w**2 * z)
    return float(size[u < 1].max()), float(size[u >= 1].max())


def test_half_the_stroke_stays_after_one_swing() -> None:
    assert by_law("cycloidal", 1) == pytest.approx(0.5, abs=1e-6)
    for n in (0.5, 1.25, 3.7):
        formula = abs(math.sin(math.pi * n)) / (math.pi * n * abs(1 - n**2))
        assert by_law("cycloidal", n) == pytest.approx(formula, abs=1e-6)
        jumps = 16 * math.sin(math.pi * n / 2) ** 2 / (2 * math.pi * n) ** 2
        assert by_law("constant acceleration", n) == pytest.approx(jumps, abs=1e-5)


def test_what_is_to_be_found_in_the_figure() -> None:
    figure = cm.explore_residual()
    n, damping, law = figure.values
    found = {}
    for number in (0.9, 1.0, 1.1, 1.2, 7.6, 7.7, 8.5, 9.5, 10):
        figure.values = {n: number}
        found[number] = size_left(figure.text)
    assert max(found, key=found.__getitem__) == 1
    assert found[1.0] == pytest.approx(18.5, abs=0.05)
    assert [number for number, size in found.items() if size < 1] == [7.7, 8.5, 9.5, 10]
    figure.values = {n: 4, law: 2}
    assert size_left(figure.text) == pytest.approx(0.2, abs=0.05)
    figure.values = {damping: 0.2}
    assert size_left(figure.text) == pytest.approx(3.4, abs=0.05)
    assert says("10", "damping leaves *more* there, 3.4 in place of 0.2!")
    assert says("10", "From 7.7 swings on it stays below 1.")


def size_left(text: str) -> float:
    return float(text.splitlines()[1].split("up to ")[1].split(",")[0])


def test_which_law_is_the_best() -> None:
    best = {1.0: "MCV50", 4.0: "cycloidal", 5.0: "cycloidal", 8.0: "modified trapezoid"}
    for n in (1.0, 2.5, 4.0, 5.0, 8.0, 20.0):
        all_of_it = {name: max(peak(name, n)) for name in NAMES}
        order = sorted(NAMES, key=all_of_it.__getitem__)
        assert order[0] == best.get(n, order[0])
        for name in order[:3]:
            assert all_of_it[name] == pytest.approx(cm.OneMass(name, n, 0.02).peak, rel=2e-4)
        if n == 2.5:
            assert "cycloidal" not in order[:3]
    assert order[-2] == "constant acceleration"  # at 20 swings
    assert max(NAMES, key=lambda name: cm.LAWS[name].Ca) == "MCV50"
    for n in (8.5, 13.5, 17, 30):
        order = sorted(NAMES, key=lambda name: max(peak(name, n)))
        assert "modified trapezoid" in order[:2]
    for n in (3.1, 3.6, 4.5, 5.2):
        assert min(NAMES, key=lambda name: max(peak(name, n))) == "cycloidal"


def test_the_rule_of_three_is_one_phase() -> None:
    waves = [peak("cycloidal", n, 0.0)[0] / (2 * math.pi) for n in np.arange(4, 20.1, 0.25)]
    assert 1.03 <= min(waves) < 1.06
    assert 1.29 < max(waves) < 1.31
    halves = [peak("simple harmonic", n, 0.0)[0] / (np.pi**2 / 2) for n in np.arange(4, 20, 0.5)]
    assert halves == pytest.approx([2] * len(halves), abs=0.04)
    for n, factor in ((10, 2), (10.5, 3.24), (11, 4)):
        during, _ = peak("constant acceleration", n, 0.0)
        assert during / 4 == pytest.approx(factor, abs=5e-3)
    assert says("10", "2 at 10 swings, 3.24 at 10.5 and 4 at 11")
    many = [peak("cycloidal", n, 0.0)[0] / (2 * math.pi) for n in (40, 100.25, 400.5)]
    assert all(1 < times < 1 + 2 / n for times, n in zip(many, (40, 100.25, 400.5), strict=True))
    assert says("10", "The 1.06 is up to 1.30, and tends to 1 with many swings")


def test_jumps_decide_who_stays_on_top() -> None:
    late = np.linspace(6, 12, 1201)
    worst = {name: float(np.max(cm.residual_vibration(name, late))) for name in NAMES}
    order = sorted(NAMES, key=worst.__getitem__)
    assert order[0] == "4-5-6-7 polynomial"
    assert {*order[-4:]} == {"constant acceleration", "simple harmonic", "cubic", "MCV50"}
    assert {name for name in NAMES if not np.isfinite(cm.LAWS[name].Cj)} == {
        "constant acceleration",
        "simple harmonic",
        "cubic",
    }
    half, more = (np.array([by_law(name, n) for name in NAMES]) for n in (0.5, 0.75))
    assert half.min() > 0.75
    assert (half.max() - half.min(), more.max() - more.min()) == pytest.approx(
        (0.12, 0.22), abs=0.01
    )
    assert says("10", "Below half a swing the mass notices hardly more than the stroke. Then the ")


def test_the_running_machine_by_the_gain_of_each_harmonic() -> None:
    die, count = cm.EXAMPLE.die, 2**14
    angles = np.arange(count) * 360 / count
    lift = np.fft.fft(np.asarray(die.position_mm(angles)))
    ranks = np.fft.fftfreq(count, 1 / count)
    for swings in (2.4, 2.5, 2.6, 5.0):
        r = ranks / (swings * 360 / 55)
        gain = (1 + 0.04j * r) / (1 - r**2 + 0.04j * r)
        mass = np.fft.ifft(lift * gain).real
        dwell = (angles > 205) & (angles < 305)
        swing = np.abs(mass - np.asarray(die.position_mm(angles)))[dwell].max() / 50
        assert swing == pytest.approx(cm.running_residual(die, swings, 0.02), rel=2e-3)


def test_what_swings_while_the_die_is_down_in_the_running_machine() -> None:
    """By the gain of each harmonic; what the page prints is in its stored output."""
    wide = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram["die"]
    follower = cm.tuned_mass(math.sqrt(150_000 / 12) / (2 * math.pi), 0.02)
    count, turn_s = 2**14, 1.8
    angles = np.arange(count) * 360 / count
    omega = 2 * math.pi * np.fft.fftfreq(count, 1 / count) / turn_s
    r = omega / math.sqrt(150_000 / 12)
    gain = (1 + 0.04j * r) / (1 - r**2 + 0.04j * r)
    for motion, whole, down in ((cm.EXAMPLE.die, 4.665, 0.588), (wide, 0.895, 0.046)):
        pushed = np.fft.fft(np.asarray(motion.derivative(2, angles, 2000)))
        mass = np.abs(np.fft.ifft(pushed * gain).real)
        dwell = (angles > 205) & (angles < 305)
        assert [mass.max(), mass[dwell].max()] == pytest.approx([whole, down], abs=1e-3)
        found = cm.SteadyResponse(follower, motion, 2000)
        assert found.peak_acceleration().value == pytest.approx(mass.max(), rel=1e-3)


def test_overlap_cures_the_vibration() -> None:
    frequency = math.sqrt(150_000 / 12) / (2 * math.pi)
    wide = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).angle_deg
    times = [angle / 360 * 1.8 for angle in (55, wide)]
    swings = [frequency * time for time in times]
    assert swings == pytest.approx([4.9, 11.1], abs=0.05)
    assert times[1] / times[0] == pytest.approx(2.27, abs=5e-3)
    assert (times[1] / times[0]) ** 3 == pytest.approx(11.7, abs=0.05)
    after = [peak("cycloidal", n)[1] / time**2 for n, time in zip(swings, times, strict=True)]
    assert after[0] / after[1] == pytest.approx(10.1, abs=0.1)
    for hertz, ratio in ((18.2, 4.9), (16.1, 25)):
        found = [peak("cycloidal", hertz * time)[1] / time**2 for time in times]
        assert found[0] / found[1] == pytest.approx(ratio, rel=0.02)
    assert says("10", "with the damping of 0.02 it would be 4.9 times at 18.2 swings a second")


def test_two_masses_swing_by_their_matrices() -> None:
    stiff = np.array([[800e3, -200e3], [-200e3, 200e3]])
    found = np.linalg.eigvals(np.diag([1 / 3, 1 / 12]) @ stiff)
    lower, upper = np.sort(np.sqrt(found)) / (2 * math.pi)
    assert lower == pytest.approx(17.65, abs=5e-3)
    assert upper == pytest.approx(83, abs=0.5)
    assert upper * 55 / 360 * 1.8 == pytest.approx(23, abs=0.5)
    assert pytest.approx(150) == 1 / (1 / 600 + 1 / 200)


def flight(rate: float, begins: float) -> tuple[float, float]:
    """Return gap in mm and landing in m/s of the first flight after an angle, step by step."""
    die, speed = cm.EXAMPLE.die, rate / 10  # deg a second

    def cam(at: float, order: int) -> float:
        if order == 0:
            return float(die.position_mm(at)) / 1000
        return float(die.derivative(order, at, rate))

    def force(at: float) -> float:
        return 12 * cam(at, 2) + 500 * cam(at, 0) + 40

    low, high = begins, begins + 20
    while high - low > 1e-10:
        middle = (low + high) / 2
        low, high = (middle, high) if force(middle) > 0 else (low, middle)

    def gap(t: float, state: Array) -> float:
        return float(state[0]) - cam(low + speed * t, 0)

    def landed(t: float, state: Array) -> float:
        return gap(t, state) if t > 1e-4 else 1.0

    landed.terminal = True  # type: ignore[attr-defined]
    start = [cam(low, 0), cam(low, 1)]
    found = solve_ivp(
        lambda _, state: [state[1], -(500 * state[0] + 40) / 12],
        (0, 0.5),
        start,
        events=landed,
        rtol=1e-10,
        atol=1e-13,
        max_step=1e-4,
    )
    widest = max(gap(t, state) for t, state in zip(found.t, found.y.T, strict=True))
    blow = abs(found.y[1, -1] - cam(low + speed * found.t[-1], 1))
    return 1000 * widest, float(blow)


@pytest.mark.parametrize(
    ("rate", "gap", "blow"), [(2300, 0.1, 0.018), (2500, 1.495, 0.136), (3000, 7.9, 0.444)]
)
def test_how_far_it_flies(rate: float, gap: float, blow: float) -> None:
    both = [flight(rate, 175), flight(rate, 305.001)]
    assert max(gap for gap, _ in both) == pytest.approx(gap, rel=0.03)
    assert max(blow for _, blow in both) == pytest.approx(blow, rel=0.01)
    assert says("10", "At 2300 pieces an hour the gap is 0.1 mm, at 3000 it is 7.9.")


def test_what_the_landing_is_like() -> None:
    assert pytest.approx([2 * 9.81 * 1e-3, 2 * 9.81 * 1e-2], rel=0.07) == [0.136**2, 0.444**2]
    assert pytest.approx(2.7, abs=0.05) == 7.9 * (2500 - 2241) / (3000 - 2241)


@pytest.mark.parametrize(("angle", "rate"), [(55, 2241), (0, 5087)])
def test_when_it_leaves_its_cam(angle: float, rate: float) -> None:
    angle = angle or cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).angle_deg
    u = np.linspace(0.5, 1, N)
    pull = 12 * 0.05 * 2 * math.pi * np.sin(-2 * math.pi * u) / (angle / 360 * 3600) ** 2
    spring = 500 * 0.05 * (u - np.sin(2 * math.pi * u) / (2 * math.pi)) + 40
    assert 1 / math.sqrt(np.max(pull / spring)) == pytest.approx(rate, abs=0.5)


def test_a_cam_designed_backwards() -> None:
    w, law = 2 * math.pi * 2.5, cm.LAWS["4-5-6-7 polynomial"]
    fourth = np.polynomial.Polynomial([0, 0, 0, 0, 35, -84, 70, -20]).deriv(4)

    def cam(u: Array) -> Array:
        return np.asarray(law(u, derivative=2)) + fourth(u) / w**2

    for rate, here, plain in (
        (0.5, 0.49, 0.16),
        (0.9, 0.44, 1.89),
        (1.1, 0.10, 0.57),
        (1.5, 8.76, 15.76),
    ):
        assert 100 * left(cam, 2.5 / rate) == pytest.approx(here, abs=6e-3)
        assert 100 * by_law("4-5-6-7 polynomial", 2.5 / rate) == pytest.approx(plain, abs=6e-3)
    assert left(cam, 2.5) < 1e-9
    assert fourth(0.0) / w**2 == pytest.approx(3.40, abs=5e-3)
    assert says("10", "a peak of 7.51 where the polynomial itself would have given it 12.08")
    assert max(peak("4-5-6-7 polynomial", 2.5, 0.0)) == pytest.approx(12.08, abs=6e-3)


def test_overlap_is_the_same_machine_slower() -> None:
    wide = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).angle_deg
    assert 2241.11 * wide / 55 == pytest.approx(5087, abs=0.5)


def test_a_kick_adds_up() -> None:
    """The integral of the lesson is that of the swings of all kicks."""
    w = 2 * math.pi * 1.3
    law = cm.LAWS["modified sine"]
    cosine = quad(lambda u: float(law(u, derivative=2)) * math.cos(w * u), 0, 1, limit=200)[0]
    sine = quad(lambda u: float(law(u, derivative=2)) * math.sin(w * u), 0, 1, limit=200)[0]
    size = math.hypot(cosine, sine) / w
    assert size == pytest.approx(by_law("modified sine", 1.3), abs=1e-6)
    assert cm.residual_vibration("modified sine", 1.3) == pytest.approx(size)


def test_the_pictures_are_those_of_the_lesson() -> None:
    assert follower_pictures.JUMP.read_text("utf-8") == follower_pictures.jump()
    assert follower_pictures.TWO_MASSES.read_text("utf-8") == follower_pictures.two_masses()
