"""Checks of a follower that leaves its cam: integrated step by step, from joint to joint."""

from collections.abc import Callable, Iterable, Iterator
from itertools import islice

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import cammotion as cm
from fresh.drawing import Machine
from fresh.sampling import Array, track_of

STEP_DEG, PER_PIECE = 0.05, 41
NEAR_DEG = 2e-5
OFTEN = 0.85
LEAST = 1e-5  # of the travel
FIRST = 6  # flights; with bounces what differs grows from flight to flight
BESIDE = 1e-9  # deg beside a joint
Force = Callable[[Array], Array]
Found = tuple[float, float, float, float]


def contacts(machine: Machine) -> None:
    """Let a follower on each motion fly and land, and integrate the same."""
    rng = machine.rng
    for motion in machine.diagram.motions:
        if motion.is_indexing or motion.steps(1):
            continue
        rate = machine.diagram.rate_per_hour
        mass, travel = rng.uniform(0.1, 20), float(np.ptp(motion.range_mm))
        hardest = mass * motion.peak(2) * (rate / 10) ** 2 / 1000
        load = cm.FollowerLoad(
            mass_kg=mass,
            preload_N=hardest * rng.choice([0.02, rng.uniform(0.05, 1.2)]),
            stiffness_N_per_mm=rng.choice([0.0, rng.uniform(0, 3), 30.0]) * hardest / travel,
            weight_N=hardest * rng.choice([0.0, 0.01, -0.01]),
        )
        leaves = load.lift_off_rate(motion)
        if np.isfinite(leaves) and rng.random() < OFTEN:  # else most would stay on the cam
            rate = leaves * rng.uniform(1.001, 3)
        bounce = float(rng.choice([0.0, 0.3, 0.8]))
        found = cm.follower_flights(motion, load, rate, turns=3, restitution=bounce)
        compare(found, integrated(motion, load, rate, bounce), travel)


def compare(found: cm.Flights, known: Iterable[Found], travel: float) -> None:
    """Hold the first flights to those known, without the lowest, which steps may have missed."""
    seen = [flight for flight in found if flight.gap_mm > LEAST * travel][:FIRST]
    others = [*islice((flight for flight in known if flight[2] > LEAST * travel), FIRST)]
    assert len(seen) == len(others), f"{len(seen)} flights, not {len(others)}"
    for flight, other in zip(seen, others, strict=True):
        near = NEAR_DEG * (1 + 1e-3 / min(1.0, flight.gap_mm / travel))
        assert np.allclose(flight[:2], other[:2], rtol=0, atol=near), f"{flight}, not {other}"
        assert np.isclose(flight.gap_mm, other[2], rtol=1e-4, atol=1e-7 * travel)  # of samples
        assert np.isclose(flight.impact_m_per_s, other[3], rtol=1e-4, atol=1e-6 * travel)


def integrated(
    motion: cm.Motion, load: cm.FollowerLoad, rate: float, bounce: float, turns: float = 3
) -> Iterator[Found]:
    """Yield the flights in order: leaves, lands, widest gap, impact; by steps of the gap alone."""
    track, low_mm = track_of(motion), motion.range_mm[0]
    per_s, start = rate / 10, track.pieces[0].from_deg
    end = start + 360 * turns
    omega = load.stiffness_N_per_mm * 1000 / load.mass_kg

    def force(angles: Array) -> Array:
        """Return the force in N on a follower that stays on the cam."""
        lift, bend = (track.curve(order, angles) for order in (0, 2))
        standing = load.stiffness_N_per_mm * (lift - low_mm) + load.preload_N + load.weight_N
        return np.asarray(load.mass_kg * bend * per_s**2 / 1000 + standing)

    joints = np.unique([a for piece in track.pieces for a in piece.joints_deg])
    every = np.unique([a + 360 * n for n in range(-1, int(turns) + 30) for a in joints])
    place, thrown = start, 0.0
    while place < end:
        if not thrown:
            place = _leaves(force, place, end, every)
            if place >= end:
                return
        since, state, gaps, landed = place, np.array([0.0, thrown]), [0.0], False
        while not landed:
            stop = float(every[np.searchsorted(every, place + 1e-9)])

            def rates(
                angle: float, y: Array, low: float = place, high: float = stop
            ) -> list[float]:
                inside = np.array([min(max(angle, low + 1e-10), high - 1e-10)])
                pull = -float(force(inside)[0]) * 1000 / load.mass_kg - omega * y[0]
                return [y[1] / per_s, pull / per_s]

            def closed(_: float, y: Array) -> float:
                return float(y[0])

            closed.terminal, closed.direction = True, -1  # type: ignore[attr-defined]
            ran = solve_ivp(
                rates, (place, stop), state, method="DOP853", events=closed, dense_output=True,
                rtol=1e-10, atol=1e-13 * max(1.0, abs(thrown)), max_step=4.0,
            )  # fmt: skip
            fine = np.linspace(place, ran.t[-1], 400)
            gaps.append(float(ran.sol(fine)[0].max()))
            place, state, landed = float(ran.t[-1]), ran.y[:, -1], bool(ran.t_events[0].size)
        yield since, place, max(gaps), -state[1] / 1000
        thrown = -bounce * state[1]
        size = abs(float(force(np.array([place]))[0])) * 1000 / load.mass_kg
        if thrown**2 < 2e-9 * size * max(gaps[-1], 1e-3):
            thrown = 0.0


def _leaves(force: Force, place: float, end: float, joints: Array) -> float:
    """Return the next angle at which the force falls below 0."""
    ends = np.array([place, *joints[(joints > place) & (joints < end)], end])
    between = np.linspace(ends[:-1], ends[1:], PER_PIECE)  # also of a move over 0.06 deg
    places = np.union1d(np.arange(place, end, STEP_DEG), between)
    places = places[np.append(np.diff(places) > 2 * BESIDE, True)]  # at a joint, not just before it
    lows, highs = force(places[:-1] + BESIDE), force(places[1:] - BESIDE)
    loose = np.flatnonzero((lows < 0) | (highs < 0))
    if not loose.size:
        return end
    first = int(loose[0])
    low, high = float(places[first]), float(places[first + 1])
    if lows[first] < 0:
        return low
    return float(
        brentq(lambda at: float(force(np.array([at]))[0]), low + BESIDE, high - BESIDE, xtol=1e-11)
    )
