"""Checks of a camshaft: forces, torque and the rates at which they meet limits, among samples."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

import cammotion as cm
from fresh.drawing import Machine, Rng
from fresh.sampling import Array, Track, tracks_of

PER_SPAN = 1500
NEAR, NEAR_PEAK = 1e-5, 1e-2
STILL = 1e-7  # of the largest speed, at which friction has no way that samples could tell


class _Asked(NamedTuple):
    """What is asked at a rate: the part of the masses at the machine's own rate, and the rest."""

    inertia: Array
    standing: Array
    counts: Array | bool = True  # where friction has a way

    def peak(self, faster: float = 1.0) -> float:
        return float(np.abs(self.counts * (self.inertia * faster**2 + self.standing)).max())


def camshafts(machine: Machine) -> None:
    """Load the motions that a force can move, and hold what the shaft says to sums of samples."""
    motions = [motion for motion in machine.diagram.motions if not motion.steps(1)]
    if not motions:
        return
    shaft = _loaded(machine, motions, machine.rng)
    tracks = tracks_of(machine.diagram)
    angles, weights = _samples([tracks[name] for name in shaft.loads], shaft.process)
    forces = {name: _force(shaft, name, tracks[name], angles) for name in shaft.loads}
    slopes = {name: tracks[name].curve(1, angles) * 180 / np.pi / 1000 for name in shaft.loads}
    whole = _Asked(
        *(np.asarray(sum(forces[n][part] * slopes[n] for n in shaft.loads)) for part in (0, 1))
    )
    torque = whole.inertia + whole.standing
    rms = float(np.sqrt(weights @ torque**2))
    size = rms + 1e-9
    assert abs(shaft.mean_torque_N_m - weights @ torque) < NEAR * size, "mean torque"
    assert abs(shaft.rms_torque_N_m - rms) < NEAR * size, f"rms {shaft.rms_torque_N_m}, not {rms}"
    _same_peak(shaft.peak_torque().value, whole.peak(), "torque")
    for name, asked in forces.items():
        _same_peak(shaft.peak_force(name).value, asked.peak(), f"force of {name}")
        limit = asked.peak() * machine.rng.uniform(0.3, 4) + 1e-6
        (found,) = cm.rate_limits(shaft, force_N={name: limit})
        _meets(found, asked, machine.diagram.rate_per_hour)
    limit = whole.peak() * machine.rng.uniform(0.3, 4) + 1e-6
    _meets(cm.rate_limits(shaft, torque_N_m=limit)[0], whole, machine.diagram.rate_per_hour)


def _loaded(machine: Machine, motions: list[cm.Motion], rng: Rng) -> cm.Camshaft:
    loads, friction, process = {}, {}, []
    for motion in motions:
        travel = float(np.ptp(motion.range_mm))
        hardest = 10 * motion.peak(2) * (machine.diagram.rate_per_hour / 10) ** 2 / 1000 + 1e-3
        spring, preload, weight, held = hardest * rng.choice([0.0, 0.1, 2.0], 4)
        loads[motion.name] = cm.FollowerLoad(
            mass_kg=10,
            stiffness_N_per_mm=0 if motion.is_indexing else spring / travel,
            preload_N=preload,
            weight_N=weight * rng.choice([-1, 1]),
        )
        friction[motion.name] = held
        start, width = rng.uniform(-300, 500), rng.uniform(1, 300)
        first, last = hardest * rng.uniform(-1, 1, 2)
        process.append(
            cm.ProcessForce(
                motion=motion.name, from_deg=start, to_deg=start + width, force_N=first, last_N=last
            )
        )
    return cm.Camshaft(machine.diagram, loads, process[: rng.integers(3)], friction)


def _samples(tracks: list[Track], process: Sequence[cm.ProcessForce]) -> tuple[Array, Array]:
    """Return angles within the parts between all joints, and what part of the turn is each's."""
    joints = [angle for track in tracks for piece in track.pieces for angle in piece.joints_deg]
    joints += [end for force in process for end in (force.from_deg, force.to_deg)]
    ends = np.unique([0.0, *np.mod(joints, 360), 360.0])
    inside = (np.arange(PER_SPAN) + 0.5) / PER_SPAN
    angles = np.concatenate([low + (high - low) * inside for low, high in pairwise(ends)])
    return angles, np.repeat(np.diff(ends) / 360 / PER_SPAN, PER_SPAN)


def _force(shaft: cm.Camshaft, name: str, track: Track, angles: Array) -> _Asked:
    load, per_s = shaft.loads[name], shaft.diagram.rate_per_hour / 10
    lift = track.curve(0, angles) - shaft.diagram[name].range_mm[0]
    standing = load.stiffness_N_per_mm * lift + load.preload_N + load.weight_N
    speed = np.abs(track.curve(1, angles))
    counts = (speed > STILL * speed.max()) | _stands(track, angles)
    standing += shaft.friction_N[name] * np.sign(track.curve(1, angles))
    for force in shaft.process:
        if force.motion == name:
            since, width = (angles - force.from_deg) % 360, force.to_deg - force.from_deg
            last = force.force_N if force.last_N is None else force.last_N
            pushed = force.force_N + (last - force.force_N) * since / width
            standing += np.where(since < width, pushed, 0)
    return _Asked(load.mass_kg * track.curve(2, angles) * per_s**2 / 1000, standing, counts)


def _stands(track: Track, angles: Array) -> Array:
    """Tell where a motion dwells."""
    dwells = [(piece.from_deg, piece.to_deg) for piece in track.pieces if piece.law is None]
    stands = [(angles - start) % 360 < end - start for start, end in dwells]
    return np.asarray(sum(stands, np.zeros(np.shape(angles), bool)))


def _same_peak(said: float, own: float, what: str) -> None:
    assert own <= abs(said) * (1 + 1e-9) + 1e-9, f"{what}: {said} is less than {own}"
    assert abs(said) <= own * (1 + NEAR_PEAK) + 1e-9, f"{what}: {said} is more than {own}"


def _meets(found: cm.RateLimit, asked: _Asked, rate: float) -> None:
    """See that the limit is met at the rate that was found, and not below it."""
    if not found.rate_per_hour:
        assert asked.peak(0) > found.limit * (1 - NEAR_PEAK), f"{found}"
    elif not np.isfinite(found.rate_per_hour):
        assert asked.peak(1e3) <= found.limit * (1 + NEAR_PEAK), f"{found}"
    else:
        _same_peak(found.limit, asked.peak(found.rate_per_hour / rate), str(found))
