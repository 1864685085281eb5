"""A follower of masses and springs, against closed forms, energy, and an integrator."""

import math
from typing import Any

import numpy as np
import pytest
import sympy as sp
from fresh.stepping import Row, drives_of, drives_of_law
from machines import Array
from mpmath import mp
from numpy.polynomial.legendre import leggauss

import cammotion as cm
from cammotion.dynamics.forcing import TOLERANCE, accelerations
from cammotion.dynamics.peaks import extremes

DIE, RATE = cm.EXAMPLE.die, 2000
TURN_S = 1.8
REST = cm.x**2 * (1 - cm.x) ** 2
HARD = cm.MotionLaw("hard", 3 * cm.x**2 - 2 * cm.x**3 + REST * sp.sqrt(cm.x + sp.Rational(1, 50)))
ODD = cm.MotionLaw("odd", 3 * cm.x**2 - 2 * cm.x**3 + REST * sp.exp(cm.x))
POWER = cm.MotionLaw("power", cm.x ** sp.Rational(7, 2) * (9 - 7 * cm.x) / 2)
PLACES = np.linspace(0, 1, 9)
POINTS = cm.law_from_points(PLACES, PLACES**2 * (3 - 2 * PLACES))
SOFT = cm.two_masses(8, 2, k1_N_per_mm=9, k2_N_per_mm=4, b1_N_s_per_mm=0.01, b2_N_s_per_mm=0.002)
FREE = cm.two_masses(8, 2, k1_N_per_mm=9, k2_N_per_mm=4)


def move_of(law: str | cm.MotionLaw) -> cm.Move:
    return cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=RATE, law=law)


def turn_of(law: str | cm.MotionLaw) -> cm.Motion:
    return cm.motion(
        "follower",
        *(cm.rise(20, over_deg=100, law=law), cm.dwell(60)),
        *(cm.return_(20, over_deg=80, law=law), cm.dwell(120)),
        start_deg=30,
    )


def stepped(chain: cm.Chain, motion: cm.Motion, angles: Array) -> tuple[Array, Array]:
    """Return deflections in mm and accelerations, a column a mass, over the first turn."""
    times, still = (angles - motion.start_deg) / 360 * TURN_S, np.zeros(len(chain.masses_kg))
    states, moved, _ = Row.of(chain).stepped(drives_of(motion, RATE), times, still, still, 0.02)
    return 1000 * states[:, : len(still)], moved


DRIVEN = ["cycloidal", "constant acceleration", POINTS, ODD, HARD, POWER]
DAMPED = [("cycloidal", 0), ("constant acceleration", 0.6), (HARD, 0.6), (POINTS, 20)]


@pytest.mark.parametrize(("law", "damping"), [*((law, 0.004) for law in DRIVEN), *DAMPED])
def test_a_turn_stepped_through(law: str | cm.MotionLaw, damping: float) -> None:
    chain = cm.Chain([3, 0.7, 1.5], [2, 0.9, 4], [damping, damping / 3, damping])
    motion, angles = turn_of(law), np.linspace(31, 389, 23)
    response = cm.StartResponse(chain, motion, RATE)
    away, moved = stepped(chain, motion, angles)
    for mass in (1, 2, 3):
        deflection = response.deflection_mm(angles, mass)
        assert deflection == pytest.approx(away[:, mass - 1], abs=1e-9)
        push = response.acceleration(angles, mass)
        assert push == pytest.approx(moved[:, mass - 1], abs=1e-7 * np.abs(moved).max())


@pytest.mark.parametrize("law", [*cm.LAWS.values(), ODD, HARD, POWER, POINTS])
def test_a_move_and_what_swings_after_it(law: cm.MotionLaw) -> None:
    if not math.isfinite(law.Ca):
        return
    move, times = move_of(law), np.linspace(0, 0.8, 17)
    drives = [*drives_of_law(law, 50, move.time_s), (move.time_s, 0.9, lambda _: 0.0)]
    states, moved, _ = Row.of(SOFT).stepped(drives, times, np.zeros(2), np.zeros(2), 0.05)
    response = cm.MoveResponse(SOFT, move)
    cam = 0.05 * law(np.minimum(times / move.time_s, 1))
    for mass in (1, 2):
        assert response.position_mm(times, mass) == pytest.approx(
            1000 * (cam + states[:, mass - 1]), abs=1e-9
        )
        slope = 0.05 / move.time_s * law(np.minimum(times / move.time_s, 1), 1)
        rate = states[:, mass + 1] + np.where(times < move.time_s, slope, 0)
        assert response.velocity(times, mass) == pytest.approx(rate, abs=1e-9)
        assert response.acceleration(times, mass) == pytest.approx(moved[:, mass - 1], abs=1e-6)
    assert response.position_mm(-1) == response.deflection_mm(-1) == response.velocity(-1) == 0


def test_the_second_turn_follows_the_first() -> None:
    response = cm.StartResponse(SOFT, DIE, RATE)
    still, begin = np.zeros(2), DIE.start_deg
    drives, row = drives_of(DIE, RATE), Row.of(SOFT)
    times = np.linspace(0, TURN_S, 9)
    state = np.zeros(4)
    for turn in range(3):
        states, _, state_end = row.stepped(drives, times, state[:2], state[2:], 0.05)
        found = response.deflection_mm(begin + 360 * turn + times / TURN_S * 360, 2)
        assert found == pytest.approx(1000 * states[:, 1], abs=1e-8), turn
        state = state_end
    assert still.any() or state.any()


@pytest.mark.parametrize("chain", [SOFT, cm.tuned_mass(12, 0.02), cm.Chain([2], [3], [5])])
def test_a_run_is_what_a_start_comes_to(chain: cm.Chain) -> None:
    steady, start = cm.SteadyResponse(chain, DIE, RATE), cm.StartResponse(chain, DIE, RATE)
    angles = np.linspace(150, 510, 37)
    later = np.asarray(start.acceleration(angles + 360 * 1000))
    assert steady.acceleration(angles) == pytest.approx(later, abs=1e-9)
    assert steady.acceleration(angles - 720) == pytest.approx(later, abs=1e-9)
    assert steady.position_mm(angles) == pytest.approx(
        start.position_mm(angles + 360_000), abs=1e-9
    )
    earlier = np.asarray(start.acceleration(angles))
    assert not np.allclose(earlier, later, atol=1e-6) or chain.damping_ratios[0] > 1


def test_an_undamped_machine_has_a_run_too() -> None:
    """Each turn is as the one before, although nothing dies away: it needs the right start."""
    steady = cm.SteadyResponse(FREE, DIE, RATE)
    begin, cam = DIE.start_deg, DIE.derivative(1, DIE.start_deg, RATE)
    away = np.array([steady.deflection_mm(begin, mass) / 1000 for mass in (1, 2)])
    rates = np.array([steady.velocity(begin, mass) - cam for mass in (1, 2)])
    times = np.linspace(0, TURN_S, 9)
    states, _, end = Row.of(FREE).stepped(drives_of(DIE, RATE), times, away, rates, 0.05)
    assert end == pytest.approx([*away, *rates], abs=1e-9)
    found = steady.deflection_mm(begin + times / TURN_S * 360, 1)
    assert found == pytest.approx(1000 * states[:, 0], abs=1e-8)


def test_equal_masses_and_springs() -> None:
    equal = cm.two_masses(5, 5, k1_N_per_mm=7, k2_N_per_mm=7)
    w = 2 * np.pi * equal.natural_Hz / math.sqrt(7000 / 5)
    golden = (1 + math.sqrt(5)) / 2
    assert w == pytest.approx([1 / golden, golden], rel=1e-14)
    assert equal.modes == pytest.approx(np.array([[1 / golden, 1], [1, -1 / golden]]), rel=1e-13)
    long = cm.Chain([2] * 9, [3] * 9)
    known = [2 * math.sqrt(1500) * math.sin((2 * n + 1) * math.pi / 38) for n in range(9)]
    assert 2 * np.pi * long.natural_Hz == pytest.approx(known, rel=1e-13)


def test_a_soft_spring_beside_a_hard_one() -> None:
    """The slow frequency keeps its digits; mpmath reckons with forty."""
    with mp.workdps(40):
        k1, k2, m1, m2 = (mp.mpf(each) for each in (1e9, 1e-3, 2, 5))
        b, c = -(k1 + k2) / m1 - k2 / m2, k1 * k2 / (m1 * m2)
        slow = mp.sqrt((-b - mp.sqrt(b * b - 4 * c)) / 2)
    chain = cm.two_masses(2, 5, k1_N_per_mm=1e6, k2_N_per_mm=1e-6)
    assert 2 * math.pi * chain.natural_Hz[0] == pytest.approx(float(slow), rel=1e-9)


def test_matrices_and_modes_belong_together() -> None:
    chain = cm.Chain([3, 0.7, 1.5], [2, 0.9, 4], [0.03, 0, 0.01])
    m, k, b = chain.mass_matrix, chain.stiffness_matrix, chain.damping_matrix
    assert k == pytest.approx(np.array([[2900, -900, 0], [-900, 4900, -4000], [0, -4000, 4000]]))
    assert b == pytest.approx(np.array([[30, 0, 0], [0, 10, -10], [0, -10, 10]]))
    w = 2 * np.pi * chain.natural_Hz
    assert k @ chain.modes == pytest.approx(m @ chain.modes * w**2, abs=1e-9)
    whole = np.block(
        [[np.zeros((3, 3)), np.eye(3)], [-np.linalg.solve(m, k), -np.linalg.solve(m, b)]]
    )
    known = np.linalg.eigvals(whole)
    for root in chain.roots_per_s:
        assert np.abs(known - root).min() < 1e-9 * abs(root)
    one = cm.tuned_mass(12, 0.3, mass_kg=4)
    assert one.damping_ratios == pytest.approx([0.3])
    assert one.roots_per_s == pytest.approx(
        2 * np.pi * 12 * np.array([-0.3 - 1j * math.sqrt(0.91), -0.3 + 1j * math.sqrt(0.91)])
    )


def test_reciprocity() -> None:
    """What a push on one mass does to another, that one's push does to the first (Maxwell)."""
    chain = cm.Chain([3, 0.7, 1.5], [2, 0.9, 4])
    modes, w = chain.system.modes, chain.system.frequencies
    for omega in (0.0, 11.0, 70.0):
        yields = modes / (w**2 - omega**2) @ modes.T
        stiff = chain.stiffness_matrix - omega**2 * chain.mass_matrix
        assert yields @ stiff == pytest.approx(np.eye(3), abs=1e-10)
        assert yields == pytest.approx(yields.T, rel=1e-12)


def dissipated_and_done(response: Any, spans: Array, deg_per_s: float) -> tuple[float, float]:
    """Return what the dampers take in J and what the cam does, by Gauss's rule on many parts."""
    places, weights = leggauss(12)
    half = np.diff(spans) / 2
    at = (spans[:-1] + half)[:, None] + half[:, None] * places
    shares = half[:, None] * weights / deg_per_s
    chain, cam = response.chain, response.motion.derivative(1, at, response.rate_per_hour)
    rates = [cam, *(response.velocity(at, n + 1) for n in range(len(chain.masses_kg)))]
    taken = sum(
        1000 * damper * (after - before) ** 2
        for damper, before, after in zip(chain.dampings_N_s_per_mm, rates, rates[1:], strict=False)
    )
    return float((taken * shares).sum()), float((response.force_N(at) * cam * shares).sum())


def test_what_the_cam_does_the_dampers_take() -> None:
    steady = cm.SteadyResponse(SOFT, DIE, RATE)
    spans = np.union1d(np.linspace(150, 510, 181), [150, 205, 305, 360])
    taken, done = dissipated_and_done(steady, spans, 360 / TURN_S)
    assert taken > 0.01
    assert done == pytest.approx(taken, rel=1e-10)


def test_static_limit() -> None:
    """A hard spring gives way by m a/k, and a mass that is hardly held stays where it is."""
    move, times = move_of("4-5-6-7 polynomial"), np.linspace(0.03, 0.25, 12)
    hard = cm.MoveResponse(cm.tuned_mass(20_000, 0.1), move)
    still = -np.asarray(move.acceleration(times)) / (2 * np.pi * 20_000) ** 2 * 1000
    assert hard.deflection_mm(times) == pytest.approx(still, rel=1e-3, abs=1e-10)
    assert hard.acceleration(times) == pytest.approx(move.acceleration(times), abs=1e-3)
    loose = cm.MoveResponse(cm.tuned_mass(1e-4), move)
    assert loose.position_mm(times) == pytest.approx(0, abs=1e-5)


def test_force_is_mass_times_acceleration() -> None:
    """By Hooke's law of the springs themselves."""
    steady, at = cm.SteadyResponse(SOFT, DIE, RATE), np.linspace(0, 360, 19)
    z1, z2 = (np.asarray(steady.deflection_mm(at, n)) for n in (1, 2))
    v1, v2 = (np.asarray(steady.velocity(at, n)) for n in (1, 2))
    cam = np.asarray(DIE.derivative(1, at, RATE))
    assert steady.force_N(at, 1) == pytest.approx(-9 * z1 - 10 * (v1 - cam), abs=1e-8)
    assert steady.force_N(at, 2) == pytest.approx(-4 * (z2 - z1) - 2 * (v2 - v1), abs=1e-8)
    least, most = steady.force_range_N(1)
    sampled = np.asarray(steady.force_N(np.linspace(0, 360, 20_001)))
    assert least.value == pytest.approx(sampled.min(), rel=1e-6)
    assert most.value == pytest.approx(sampled.max(), rel=1e-6)
    assert steady.force_N(least.at) == pytest.approx(least.value, rel=1e-9)


@pytest.mark.parametrize("law", ["cycloidal", "constant acceleration", "modified sine", HARD])
def test_peaks_are_not_missed(law: str | cm.MotionLaw) -> None:
    rng = np.random.default_rng(3)
    for damping in (0, 0.3):
        k1, k2 = np.exp(rng.uniform(0, 7, 2))
        chain = cm.two_masses(3, 1, k1_N_per_mm=k1, k2_N_per_mm=k2, b2_N_s_per_mm=damping)
        response = cm.StartResponse(chain, turn_of(law), RATE)
        for mass in (1, 2):
            for over in (None, (77.7, 91.3), (400, 1100)):
                low, high = over or response.span
                dense = np.abs(response.acceleration(np.linspace(low, high, 60_001), mass)).max()
                peak = response.peak_acceleration(mass, over=over)
                assert dense * (1 - 1e-12) <= peak.value <= dense * (1 + 1e-4)
                assert low <= peak.at <= high
                here = abs(response.acceleration(peak.at, mass))
                assert here == pytest.approx(peak.value, rel=1e-9)


def test_a_flat_peak_that_newton_creeps_up_to_is_one() -> None:
    """Of 1 - x^10 a step goes a ninth of the way: as far as they come, the value is right."""

    def flat(_: Any, x: Array) -> Array:
        return np.array([1 - x**10, -10 * x**9, -90 * x**8])

    _, (peak, _) = extremes(flat, [np.array([-0.3, 1.0])])
    assert peak.value == pytest.approx(1, abs=1e-15)
    assert peak.at == pytest.approx(0, abs=1e-3)


def test_a_peak_is_found_to_the_last_digits() -> None:
    """Undamped, a constant push 4 a0 put on at once is felt as 8, and turned round as -12, -16."""
    move = move_of("constant acceleration")
    a0 = 0.05 / move.time_s**2
    for swings, known in ((4, 8), (5, 16), (20, 8), (10, 8)):
        response = cm.MoveResponse(cm.tuned_mass(swings / move.time_s), move)
        assert response.peak_acceleration().value == pytest.approx(known * a0, rel=1e-12)


@pytest.mark.parametrize("ratio", [30, 3000])
def test_a_peak_soon_after_the_beginning_is_not_missed(ratio: float) -> None:
    """A stiff damper takes the mass along at once, and the cubic pushes hardest at first."""
    move = move_of("cubic")
    response = cm.MoveResponse(cm.tuned_mass(3, ratio), move)
    dense = np.abs(response.acceleration(move.time_s * np.geomspace(1e-9, 0.5, 40_001))).max()
    assert response.peak_acceleration(over=(0, 0.5 * move.time_s)).value == pytest.approx(
        dense, rel=1e-7
    )


def test_critical_damping_has_a_closed_form() -> None:
    """Its matrix is defective: z = -A/w^2 (1 - (1 + w t) exp(-w t)) under a constant A."""
    move, hz = move_of("constant acceleration"), 9.0
    times, w = np.linspace(0, move.time_s / 2, 11), 2 * math.pi * hz
    a = 4 * 50 / move.time_s**2
    known = -a / w**2 * (1 - (1 + w * times) * np.exp(-w * times))
    found = cm.MoveResponse(cm.tuned_mass(hz, 1.0), move).deflection_mm(times)
    assert found == pytest.approx(known, rel=1e-11, abs=1e-13)


def test_resonance_has_a_closed_form() -> None:
    """The wave drives the mass at its own frequency, undamped: (w t cos w t - sin w t)/(2 w)."""
    move = move_of("cycloidal")
    w = 2 * math.pi / move.time_s
    times = np.linspace(0, move.time_s, 13)
    known = 50 / move.time_s * (w * times * np.cos(w * times) - np.sin(w * times)) / (2 * w)
    found = cm.MoveResponse(cm.tuned_mass(1 / move.time_s), move).deflection_mm(times)
    assert found == pytest.approx(known, abs=1e-12)


@pytest.mark.parametrize("ratio", [30, 300])
def test_far_above_critical_it_creeps(ratio: float) -> None:
    """A mass on a stiff damper: against mpmath's two roots, one fast and one slow."""
    move, hz = move_of("constant acceleration"), 3.0
    t, w = move.time_s / 2, 2 * math.pi * hz
    with mp.workdps(50):
        a = mp.mpf(4) * 50 / mp.mpf(move.time_s) ** 2
        root = mp.sqrt(mp.mpf(ratio) ** 2 - 1)
        fast, slow = w * (-ratio - root), w * (-ratio + root)
        grown = (slow * mp.exp(fast * t) - fast * mp.exp(slow * t)) / (slow - fast)
        known = -a / mp.mpf(w) ** 2 * (1 - grown)
    found = cm.MoveResponse(cm.tuned_mass(hz, ratio), move).deflection_mm(t)
    assert found == pytest.approx(float(known), rel=1e-10)


def test_three_masses_with_fast_and_slow_decay_in_forty_digits() -> None:
    """Roots from -2 to -4448 per s: where an integrator is lost, the matrix's own exponential."""
    masses, springs, dampers = (
        (2.145, 0.1497, 0.6769),
        (0.9943, 0.01366, 12.06),
        (0.277, 0.0086, 0.54),
    )
    move = move_of("constant acceleration")
    response, times = cm.MoveResponse(cm.Chain(masses, springs, dampers), move), (0.001, 0.02, 0.13)
    with mp.workdps(40):
        whole = mp.zeros(7)
        for i in range(3):
            whole[i, 3 + i], whole[3 + i, 6] = 1, -1
            for given, first in ((springs, 0), (dampers, 3)):
                own, after = mp.mpf(given[i]), mp.mpf(given[i + 1] if i < 2 else 0)
                mass = mp.mpf(masses[i]) / 1000
                whole[3 + i, first + i] = -(own + after) / mass
                if i:
                    whole[3 + i, first + i - 1] = own / mass
                if i < 2:
                    whole[3 + i, first + i + 1] = after / mass
        a = 4 * 50 / mp.mpf(move.time_s) ** 2
        known = [mp.expm(whole * mp.mpf(time))[:6, 6] * a for time in times]
        pushed = [(whole[3:6, :6] * state)[:, 0] for state in known]
    for time, state, push in zip(times, known, pushed, strict=True):
        for n in range(3):
            away, moved = response.deflection_mm(time, n + 1), response.acceleration(time, n + 1)
            assert away == pytest.approx(float(state[n]), rel=1e-12)
            assert moved == pytest.approx(float(push[n]) / 1000, rel=1e-12)


@pytest.mark.parametrize("law", [ODD, HARD, POWER])
def test_what_is_neither_polynomial_nor_wave_keeps_the_tolerance(law: cm.MotionLaw) -> None:
    places = np.linspace(0, 1, 1001)
    for curve in (law.curve, law.reversed().curve):
        known, worst = curve.derived(2)(places), 0.0
        for each in accelerations(curve):
            inside = (places >= each.low) & (places <= each.high)
            found = np.polyval(each.powers[::-1], places[inside] - each.low)
            worst = max(worst, float(np.abs(found - known[inside]).max(initial=0)))
        assert worst <= 5 * TOLERANCE * law.Ca


@pytest.mark.parametrize(
    "law", [*cm.LAWS.values(), POINTS, POINTS.part(0.2, 0.9), cm.scca(0.2, 0.5, 0.3)]
)
def test_a_curve_is_read_as_it_is(law: cm.MotionLaw) -> None:
    for curve in (law.curve, law.reversed().curve, law.curve.placed(30.0, -55.0, 4.0, 7.0)):
        for each in accelerations(curve):
            u = np.linspace(0, each.high - each.low, 7)[1:-1]
            found = np.polyval(each.powers[::-1], u) if each.powers else 0 * u
            for amplitude, frequency, phase in each.waves:
                found = found + amplitude * np.sin(frequency * u + phase)
            known = curve.derived(2)(each.low + u)
            assert found == pytest.approx(known, abs=1e-11 * curve.derived(2).largest)


def test_a_turret_and_shapes() -> None:
    response = cm.SteadyResponse(SOFT, cm.EXAMPLE.mill, RATE)
    at = np.array([[10.0, 80.0], [370.0, 440.0]])
    positions = response.position_mm(at)
    assert positions.shape == (2, 2)
    assert positions[1] - positions[0] == pytest.approx([100, 100])
    assert isinstance(response.acceleration(10.0), float)
    assert isinstance(response.velocity(10), float)
    assert response.cam_acceleration(75 / 2) == pytest.approx(1.117, abs=1e-3)


def test_the_source_s_symbols_are_one_chain() -> None:
    assert cm.Chain([8, 2], [9, 4], [0.01, 0.002]) == SOFT
    assert cm.Chain([8, 2], [9, 4]) == FREE


BAD_CHAINS: list[tuple[tuple[Any, ...], str]] = [
    (([-1], [2]), "mass is -1 kg; .* above 0 kg: give for example 12 kg"),
    (([1, 0], [2, 2]), "mass is 0 kg"),
    (([1], [0]), "stiffness of a spring is 0 N/mm; .* above 0 N/mm: give for example 50 N/mm"),
    (([1], [math.inf]), "stiffness of a spring is inf"),
    (([1], [2], [-0.1]), "damping is -0.1 N s/mm; .* at least 0 N s/mm"),
    (([1, 2], [2]), "has 2 masses, 1 springs and 2 dampers: give each mass a spring"),
    (([1, 2], [2, 2], [1]), "1 dampers"),
    (([], []), "0 masses"),
    ((5, [2]), "Of the mass a list is wanted, a number for each mass, and not 5: give for example"),
    ((["a"], [2]), "mass has to be a number in kg"),
]


@pytest.mark.parametrize(("given", "words"), BAD_CHAINS)
def test_what_a_chain_refuses(given: tuple[Any, ...], words: str) -> None:
    with pytest.raises(cm.InputError, match=words):
        cm.Chain(*given)


def test_what_a_response_refuses() -> None:
    with pytest.raises(cm.InputError, match=r"machine rate is 0 pieces/h; .* for example 2000"):
        cm.SteadyResponse(SOFT, DIE, 0)
    with pytest.raises(cm.InputError, match="machine rate is -5"):
        cm.StartResponse(SOFT, DIE, -5)
    line = turn_of(cm.CONSTANT_VELOCITY)
    with pytest.raises(cm.InputError, match=r"velocity of 'follower' jumps \(at 30 deg\), .* give"):
        cm.StartResponse(SOFT, line, RATE)
    with pytest.raises(cm.InputError, match="velocity of the law 'constant velocity' jumps"):
        cm.MoveResponse(SOFT, move_of(cm.CONSTANT_VELOCITY))
    start = cm.StartResponse(SOFT, DIE, RATE)
    with pytest.raises(cm.InputError, match="cam angle is 149 deg; the machine starts at 150"):
        start.acceleration([200, 149])
    with pytest.raises(cm.InputError, match="starts at 150"):
        start.peak_acceleration(over=(100, 300))
    with pytest.raises(cm.InputError, match="cam angle is 10 deg; the machine starts at 150"):
        start.peak_acceleration(over=(10, -10))  # nor over the end of a turn, (10, 350)
    with pytest.raises(cm.InputError, match="number of the mass is 3; the follower has 2"):
        start.acceleration(200, 3)
    with pytest.raises(cm.InputError, match="number of the spring is 0"):
        start.force_N(200, 0)
    with pytest.raises(
        cm.InputError, match=r"look between are \(300, 200\): give two in order.* \(300, 560\)"
    ):
        start.peak_acceleration(over=(300, 200))
    with pytest.raises(cm.InputError, match="damping ratio is -1"):
        cm.tuned_mass(12, -1)
    with pytest.raises(cm.InputError, match="natural frequency is 0 Hz"):
        cm.tuned_mass(0)


def test_a_follower_that_creeps_is_not_called_undamped() -> None:
    stiff, syrup = cm.Chain([1, 1], [10, 20], [1e6] * 2), cm.Chain([1, 1], [10, 20], [1e12] * 2)
    assert cm.SteadyResponse(stiff, DIE, RATE).peak_deflection_mm().value < 1e-4
    mixed = cm.Chain([1, 1], [10, 20], [0.01, 1e12])  # of its modes one swings
    for chain in (syrup, mixed):
        with pytest.raises(
            cm.InputError, match=r"creeps back by less than .* give it less damping"
        ):
            cm.SteadyResponse(chain, DIE, RATE)


def test_resonance_undamped_is_refused() -> None:
    with pytest.raises(cm.InputError, match="swings 18 times in a turn and nothing damps it"):
        cm.SteadyResponse(cm.tuned_mass(10), DIE, RATE)
    with pytest.raises(cm.InputError, match="swings 18 times in a turn and hardly anything damps"):
        cm.SteadyResponse(cm.tuned_mass(10, 1e-12), DIE, RATE)
    near = cm.SteadyResponse(cm.tuned_mass(10.0001), DIE, RATE)
    assert near.peak_acceleration().value > 10
    assert cm.SteadyResponse(cm.tuned_mass(10, 1e-4), DIE, RATE).peak_acceleration().value > 1


def test_a_law_that_bends_too_sharply() -> None:
    """One whose jerk is finite, and so it is a law, and that swings ever faster towards its end."""
    waves = sp.sin(1 / (cm.x + sp.Rational(1, 5000))) / 100
    needle = cm.MotionLaw("needle", cm.x**3 * (4 - 3 * cm.x) + cm.x**3 * (1 - cm.x) ** 3 * waves)
    with pytest.raises(cm.InputError, match="bends too sharply"):
        accelerations(needle.curve)


def test_of_many_turns_that_are_alike_one_is_enough() -> None:
    steady = cm.SteadyResponse(cm.tuned_mass(12, 0.02), DIE, RATE)
    one, many = (steady.peak_acceleration(over=(100, 100 + turns)) for turns in (360, 360e6))
    assert one == many == steady.peak_acceleration(over=(100, 500))
    assert one.value == steady.peak_acceleration().value


def test_a_response_shows_what_it_is_of() -> None:
    die = cm.EXAMPLE.die
    shown = repr(cm.StartResponse(cm.tuned_mass(12, 0.02), die, 2000))
    assert shown == f"StartResponse(1 mass, {die!r}, 2000.0)"


def test_a_start_that_rounding_puts_before_itself_is_the_start() -> None:
    """The turn before it was begun, of a chain whose passage through a turn cannot be undone."""
    response = cm.StartResponse(cm.tuned_mass(300, 0.9), DIE, 200)
    low, high = response.span
    assert response.peak_acceleration(over=(low - 5e-10, high)) == response.peak_acceleration()
