"""Checks of the least acceleration: against a motion that is allowed, and an own linear program."""

from typing import Any

import numpy as np
from scipy import sparse
from scipy.optimize import linprog

import cammotion as cm
from cammotion import InputError, Motion
from fresh.drawing import Machine
from fresh.sampling import Array, Tracks, excesses, track_of, tracks_of, worst_of

CELLS = 120
OWN_NODES = 90
NEAR_MM = 1e-5
NEAR = 1e-4  # of an acceleration, as a share


def least(machine: Machine) -> None:
    """See that nothing beats the bound, and that what is reached keeps the rules."""
    for motion in machine.diagram.motions:
        tracks = tracks_of(machine.diagram)
        rules = [
            rule
            for rule in machine.rules
            if motion.name in {rule.when.motion, rule.only_while.motion}
            and worst_of([rule], tracks) < -NEAR_MM
        ]
        if rules and motion.moves:
            _check(machine, motion, rules)


def _check(machine: Machine, motion: Motion, rules: list[cm.ClearanceRule]) -> None:
    diagram, name = machine.diagram, motion.name
    own = track_of(motion)
    deg_per_s = diagram.rate_per_hour / 10
    still = [
        (p.from_deg, p.to_deg)
        for p in own.pieces
        if p.law is None and _is_long(p.to_deg - p.from_deg)
    ]
    if not still:
        return
    try:
        found = cm.least_acceleration(diagram, name, rules, still=still, cells=CELLS)
    except InputError as refusal:
        if "more cells" in str(refusal) or "none of its stops" in str(refusal):
            return
        if "only passes its stop" in str(refusal) and any(map(_at_stop(motion), rules)):
            return
        raise AssertionError(f"{name} has a motion, but: {refusal}") from refusal
    assert found.bound <= found.reached * (1 + NEAR), f"{name}: {found.bound} > {found.reached}"
    allowed = own.peak(2, deg_per_s)
    assert found.bound <= allowed * (1 + NEAR), f"{name}: {found.bound}, but {allowed} is allowed"
    reached = track_of(found.motion)
    assert np.isclose(reached.peak(2, deg_per_s), found.reached, rtol=1e-3)
    broken = worst_of(rules, {**tracks_of(diagram), name: reached})
    assert broken <= NEAR_MM, f"{name}: the motion that is reached breaks a rule by {broken} mm"
    for start, end in still:
        angles = np.linspace(start, end, 41)
        off = reached.curve(0, angles) - own.curve(0, angles)
        if own.pitch_mm:  # it may be counted from another stop
            off -= own.pitch_mm * np.round(off / own.pitch_mm)
        assert np.abs(off).max() <= NEAR_MM, f"{name} does not stand from {start} to {end} deg"
    if not motion.is_indexing:
        bound = _own_bound(motion, rules, tracks_of(diagram), still) * deg_per_s**2 / 1000
        assert bound <= found.reached * (1 + NEAR) + 1e-9, f"{name}: no motion is below {bound}"
        assert found.bound >= 0.8 * bound - 1e-9, f"{name}: {found.bound} is a weak bound: {bound}"


def _at_stop(motion: Motion) -> Any:
    """Return what tells whether a rule asks an indexing motion not to be exactly at a stop."""
    ends = (cm.within(motion, 0), cm.beyond(motion, 0))
    return lambda rule: motion.is_indexing and (rule.when == ends[0] or rule.only_while == ends[1])


def _is_long(arc_deg: float) -> bool:
    return arc_deg > 0.5


def _own_bound(
    motion: Motion, rules: list[cm.ClearanceRule], tracks: Tracks, still: list[tuple[float, float]]
) -> float:
    """Return the least peak in mm/deg2 that second differences on an even grid allow."""
    angles = np.arange(OWN_NODES) * 360 / OWN_NODES
    low, high = _bounds(motion.name, rules, tracks, angles)
    for start, end in still:
        stands = np.mod(angles - start, 360) <= end - start
        low[stands] = high[stands] = track_of(motion).curve(0, angles[stands])
    one = sparse.identity(OWN_NODES, format="csr")
    before, after = (one[np.roll(np.arange(OWN_NODES), way)] for way in (1, -1))
    second = (before - 2 * one + after) / (360 / OWN_NODES) ** 2
    peak = sparse.csr_matrix(np.ones((OWN_NODES, 1)))
    rows = sparse.vstack([sparse.hstack([side * second, -peak]) for side in (1, -1)])
    bounds = [*zip(low, high, strict=True), (0, None)]
    objective = np.append(np.zeros(OWN_NODES), 1.0)
    scale = 1.0 / max(1e-9, float(np.ptp(track_of(motion).curve(0, angles))))
    scaled = [tuple(None if v is None else v * scale for v in pair) for pair in bounds]
    result = linprog(objective, A_ub=rows.tocsr(), b_ub=np.zeros(2 * OWN_NODES), bounds=scaled)
    assert result.status == 0, f"the own program: {result.message}"
    return float(result.fun) / scale


def _own_half(name: str, rule: cm.ClearanceRule) -> Any:
    return rule.when if rule.when.motion == name else rule.only_while


def _bounds(
    name: str, rules: list[cm.ClearanceRule], tracks: Tracks, angles: Array
) -> tuple[Array, Array]:
    """Hold a motion that comes back on its side of each limit, where the other one asks for it."""
    low, high = np.full(len(angles), -np.inf), np.full(len(angles), np.inf)
    for rule in rules:
        half = _own_half(name, rule)
        first, second = excesses(rule, tracks, angles)
        asked = (second if half is rule.when else first) > NEAR_MM
        if half.is_beyond == (half is rule.when):
            high[asked] = np.minimum(high[asked], half.limit_mm)
        else:
            low[asked] = np.maximum(low[asked], half.limit_mm)
    return low, high
