"""Checks of distances, and of rules about moving and standing, among samples."""

from dataclasses import replace

import numpy as np

import cammotion as cm
from cammotion import Motion, TimingDiagram
from fresh.check_machines import same
from fresh.drawing import Machine
from fresh.sampling import Array, Track, track_of

EVEN: Array = np.arange(7200) / 20


def distances(machine: Machine) -> None:
    """Find how near two parts on one axis come, where that is too near, and what is left."""
    pair = _two_that_come_back(machine)
    if pair is None:
        return
    diagram, (upper, lower) = pair, [track_of(motion) for motion in pair.motions]
    grid = np.unique(np.concatenate([EVEN, upper.grid, lower.grid]))
    gaps = _gaps(upper, lower, grid)
    size = float(np.ptp(gaps)) + 1e-3
    least = float(gaps.min()) + float(machine.rng.choice([-0.2, 0.0, 0.3])) * size
    part, above = diagram.names
    rule = cm.DistanceRule(part, above, at_least_mm=least)
    found = rule.smallest(diagram)
    assert found.value <= gaps.min() + 1e-9 * (1 + size), f"nearer is {gaps.min()}, not {found}"
    same(_gaps(upper, lower, np.array([found.at_deg])), found.value, 1e-6 * (1 + size))
    arcs = rule.violated_arcs(diagram)
    inside = np.zeros(grid.shape, bool)
    for start, end in arcs:
        inside |= np.mod(grid - start, 360) <= end - start
    near = np.abs(gaps - least) < 1e-6 * (1 + size)
    assert np.all((inside == (gaps < least)) | near), f"broken elsewhere than over {arcs}"
    _check_left(diagram, rule, size)


def _check_left(diagram: TimingDiagram, rule: cm.DistanceRule, size: float) -> None:
    """Shift the part by what it is said to have, and by a little more."""
    (left,) = cm.reserves(diagram, rule)
    part, lower = diagram.motions
    other = track_of(lower)
    for way, reserve in ((-1, left.early_deg), (1, left.late_deg)):
        if not 0 <= reserve < np.inf:
            continue
        for share in np.linspace(0, 0.9999, 7):
            moved = track_of(part.shifted(way * share * reserve))
            nearest = _gaps(moved, other, np.concatenate([EVEN, moved.grid, other.grid])).min()
            assert nearest >= rule.at_least_mm - 1e-6 * (1 + size), f"{left} is too much"
        worse = diagram.with_motion(part.shifted(way * (reserve + 1e-3)))
        sharp = rule.smallest(worse).value - rule.at_least_mm
        assert sharp < 1e-6 * (1 + size), f"more is left than {left}: {sharp}"


def standings(machine: Machine) -> None:
    """Find where one is somewhere, or moves, while another one moves."""
    names = machine.diagram.names
    if len(names) < 2:
        return
    one, other = (str(name) for name in machine.rng.choice(names, 2, replace=False))
    tracks = {name: track_of(machine.diagram[name]) for name in (one, other)}
    offsets = tracks[one].offset(EVEN)
    limit = float(machine.rng.uniform(offsets.min() - 1e-3, offsets.max() + 1e-3))
    if machine.diagram[one].is_indexing:  # the way to the nearest stop is never below 0
        limit = max(limit, 0.0)
    pieces = [piece for track in tracks.values() for piece in track.pieces]
    joints = np.array([end for piece in pieces for end in (piece.from_deg, piece.to_deg)])
    near = np.abs((EVEN[:, None] - joints + 180) % 360 - 180).min(axis=1) < 1e-6
    for when, holds in (
        (cm.beyond(one, limit), offsets > limit),
        (cm.within(one, limit), offsets <= limit),
        (cm.moving(one), _moves(tracks[one])),
        (cm.standing(one), ~_moves(tracks[one])),
    ):
        rule = cm.ClearanceRule(when, only_while=cm.standing(other))
        broken = holds & _moves(tracks[other])
        for asked in (rule, rule.reverse):
            inside = np.zeros(EVEN.shape, bool)
            for found in cm.find_violations(machine.diagram, asked):
                inside |= np.mod(EVEN - found.start_deg, 360) <= found.end_deg - found.start_deg
                assert found.excess_mm >= -1e-9, f"{found}"
            close = near | (np.abs(offsets - limit) < 1e-9 * (1 + np.abs(limit)))
            assert np.all((inside == broken) | close), f"{asked} is broken elsewhere"


def _two_that_come_back(machine: Machine) -> TimingDiagram | None:
    """Return two parts on one axis; the second is the first one, later, where there is no other."""
    own = [motion for motion in machine.diagram.motions if not motion.is_indexing]
    if not own:
        return None
    one = own[int(machine.rng.integers(len(own)))]
    later: Motion = replace(one.shifted(machine.rng.uniform(-400, 400)), name="another")
    others = [motion for motion in own if motion is not one] or [later]
    other = others[int(machine.rng.integers(len(others)))]
    return TimingDiagram([one, other], machine.diagram.rate_per_hour)


def _gaps(upper: Track, lower: Track, angles: Array) -> Array:
    return np.asarray(upper.curve(0, angles) - lower.curve(0, angles))


def _moves(track: Track) -> np.ndarray:
    moving = np.zeros(EVEN.shape, bool)
    for piece in track.pieces:
        if piece.law is not None:
            moving |= np.mod(EVEN - piece.from_deg, 360) <= piece.to_deg - piece.from_deg
    return moving
