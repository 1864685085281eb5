"""Checks of a follower behind each motion, against an integrator and samples."""

import numpy as np

import cammotion as cm
from fresh.drawing import Machine, Rng
from fresh.sampling import Array
from fresh.stepping import Row, drives_of, drives_of_law, fastest_of

PLACES, FINE, PER_PIECE = 12, 20_001, 400
SAME, SHAKEN = 1e-9, 1e-10  # the second of what the integrator's own rounding is shaken by
SEEN = 1e-3  # by so much samples may miss a peak


def responses(machine: Machine) -> None:
    """Put a row of masses behind each motion: switched on, running for long, over one move."""
    rng, rate = machine.rng, machine.diagram.rate_per_hour
    for motion in machine.diagram.motions:
        if motion.steps(1):
            continue
        chain = _chain(rng, 3600 / rate)
        start = cm.StartResponse(chain, motion, rate)
        still = np.zeros(len(chain.masses_kg))
        _check_turn(start, motion, rate, (still, still), rng)
        move = motion.moves[rng.integers(len(motion.moves))]
        if np.isfinite(cm.as_law(move.law or "").Ca):
            _check_move(chain, move, rate, rng)
        try:
            steady = cm.SteadyResponse(chain, motion, rate)
        except cm.InputError:
            assert not any(chain.dampings_N_s_per_mm), f"{chain} has no steady state"
            continue
        begin = motion.start_deg
        cam = motion.derivative(1, begin, rate)
        away = [steady.deflection_mm(begin, n + 1) / 1000 for n in range(len(still))]
        rates = [steady.velocity(begin, n + 1) - cam for n in range(len(still))]
        end = _check_turn(steady, motion, rate, (np.array(away), np.array(rates)), rng)
        size = float(np.max(np.abs([*away, steady.peak_deflection_mm().value / 1000])))
        assert np.allclose(end[: len(still)], away, rtol=0, atol=SAME * size), "not periodic"


def _chain(rng: Rng, turn_s: float) -> cm.Chain:
    """Draw masses that swing from once in two turns to some twenty times in one."""
    count = int(rng.integers(1, 4))
    masses = np.exp(rng.uniform(-2, 3, count))
    w = 2 * np.pi * np.exp(rng.uniform(np.log(0.5), np.log(20), count)) / turn_s
    damped = rng.choice([0.0, 0.01, 0.1, 0.7, 1.0, 3.0]) * rng.uniform(rng.choice([0, 1]), 1, count)
    springs, dampers = masses * w**2 / 1000, 2 * damped * masses * w / 1000
    return cm.Chain(masses.tolist(), springs.tolist(), dampers.tolist())


def _check_turn(
    response: cm.StartResponse | cm.SteadyResponse,
    motion: cm.Motion,
    rate: float,
    begin: tuple[Array, Array],
    rng: Rng,
) -> Array:
    """Step through a turn; return the state at its end."""
    times = np.sort(rng.uniform(0, 3600 / rate, PLACES))
    angles = motion.start_deg + times / (3600 / rate) * 360
    drives, stroke = drives_of(motion, rate), float(np.ptp(motion.range_mm)) / 1000
    row = Row.of(response.chain)
    deflected = max(response.peak_deflection_mm(n + 1).value for n in range(len(row.masses))) / 1000
    counts = min(stroke, max(deflected, 1e-6 * stroke))
    states, moved, end = row.stepped(drives, times, *begin, counts)
    for n in range(len(row.masses)):
        away = np.asarray(response.deflection_mm(angles, n + 1)) / 1000
        pushed = np.asarray(response.acceleration(angles, n + 1))
        _compare(row, (states[:, n], moved[:, n]), (away, pushed), stroke)
        peak = response.peak_acceleration(n + 1)
        samples = np.linspace(motion.start_deg, motion.start_deg + 360, FINE)
        parts = np.array([(low, high) for low, high, _ in drives])
        closer = np.linspace(parts[:, 0], parts[:, 1], PER_PIECE) / (3600 / rate) * 360
        samples = np.append(samples, motion.start_deg + closer)
        seen = float(np.abs(response.acceleration(samples, n + 1)).max())
        at = abs(response.acceleration(peak.at, n + 1))
        assert seen * (1 - 1e-9) <= peak.value <= seen * (1 + SEEN) + 1e-6 * peak.value, (
            f"mass {n + 1} of {response.chain}: peak {peak}, but {seen} seen"
        )
        assert abs(at - peak.value) <= 1e-6 * peak.value, f"{peak}: {at}"
    return end


def _check_move(chain: cm.Chain, move: cm.Segment, rate: float, rng: Rng) -> None:
    """Step through one move and as long again after it; compare a single mass's residual."""
    law, stroke = cm.as_law(move.law or ""), abs(move.change_mm)
    one = cm.Move(stroke_mm=stroke, angle_deg=move.angle_deg, rate_per_hour=rate, law=law)
    response, still = cm.MoveResponse(chain, one), np.zeros(len(chain.masses_kg))
    drives = drives_of_law(law, stroke, one.time_s)
    drives.append((one.time_s, 2 * one.time_s, lambda _: 0.0))
    times = np.sort(rng.uniform(0, 2 * one.time_s, PLACES))
    row = Row.of(chain)
    states, moved, _ = row.stepped(drives, times, still, still, stroke / 1000)
    for n in range(len(still)):
        away = np.asarray(response.deflection_mm(times, n + 1)) / 1000
        pushed = np.asarray(response.acceleration(times, n + 1))
        _compare(row, (states[:, n], moved[:, n]), (away, pushed), stroke / 1000)
    ratio, damping = rng.uniform(0.2, 12), rng.choice([0.0, 0.02, 0.3, 0.9])
    mass = cm.MoveResponse(cm.tuned_mass(ratio / one.time_s, damping), one)
    swung = mass.peak_deflection_mm(over=(one.time_s, (1 + 1 / ratio) * one.time_s)).value
    left = cm.residual_vibration(law, ratio, damping)
    assert abs(left - swung / stroke) <= SAME * (left + 1e-3), f"{law}, {ratio}: {left}, {swung}"
    factor = mass.peak_acceleration().value / one.peak_acceleration
    said = cm.dynamic_factor(law, ratio, damping)
    assert abs(said - factor) <= SAME * factor, f"{law}, {ratio}: factor {said}, not {factor}"


def _compare(
    row: Row, known: tuple[Array, Array], found: tuple[Array, Array], stroke: float
) -> None:
    """Compare deflections and accelerations, the second as far as the integrator knows them."""
    size = max(stroke, float(np.abs(known[0]).max()))
    off = float(np.abs(found[0] - known[0]).max())
    assert off <= SAME * size, f"{row.masses}: {off} m off, of {size}"
    pushed = float(np.abs(known[1]).max())
    allowed = SAME * pushed + SHAKEN * fastest_of(row) ** 2 * size
    off = float(np.abs(found[1] - known[1]).max())
    assert off <= allowed, f"{row.masses}: {off} m/s2 off, of {pushed}, allowed {allowed}"
