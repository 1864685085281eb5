"""Checks of a machine: where it is, its peaks, what breaks a rule, the widest move, its table."""

from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

import cammotion as cm
from fresh.drawing import Machine
from fresh.sampling import (
    Array,
    Piece,
    Track,
    excesses,
    grid_of,
    margin,
    track_of,
    tracks_of,
    worst,
)

Flags: TypeAlias = NDArray[np.bool_]

NEAR_MM, NEAR_DEG = 1e-6, 1e-6


def positions(machine: Machine) -> None:
    """Compare positions, offsets and derivatives, at any angle and time."""
    diagram = machine.diagram
    angles = machine.rng.uniform(-1500, 3000, 400)
    deg_per_s = diagram.rate_per_hour / 10
    for name, track in tracks_of(diagram).items():
        motion = diagram[name]
        size = 1e-9 * (1 + np.ptp(track.curve(0, track.grid)) + abs(motion.start_mm))
        turns = np.floor((angles - motion.start_deg) / 360)
        passed = track.pitch_mm * np.mod(turns, motion.stops or 1)
        same(motion.position_mm(angles), track.curve(0, angles) + passed, size)
        same(diagram.position_mm(name, time_s=angles / deg_per_s), motion.position_mm(angles), size)
        same(diagram.offset_mm(name, angles), track.offset(angles), size)
        curves = (diagram.velocity, diagram.acceleration, diagram.jerk)
        for order, curve in enumerate(curves, 1):
            away = angles[_away_from_joints(track, angles)]
            own = track.curve(order, away) * deg_per_s**order / 1000
            scale = 1e-6 * (1e-9 + np.abs(own).max(initial=0))
            same(curve(name, away), own, scale)


def ranges(machine: Machine) -> None:
    """Find the lowest and the highest position, and where two move at once."""
    tracks = tracks_of(machine.diagram)
    for name, track in tracks.items():
        samples = track.curve(0, track.grid)
        if track.pitch_mm:
            samples = np.append(samples, track.pieces[-1].to_mm)
        low, high = machine.diagram[name].range_mm
        size = float(np.ptp(samples))
        assert low <= samples.min() + 1e-9 * (1 + size), f"{name} goes lower than {low}"
        assert high >= samples.max() - 1e-9 * (1 + size), f"{name} goes higher than {high}"
        same([low, high], [samples.min(), samples.max()], 1e-9 + 2e-2 * size)
    angles = machine.rng.uniform(0, 360, 500)
    moving = np.sum([_moves(track, angles) for track in tracks.values()], axis=0)
    found = _inside(angles, machine.diagram.overlap())
    near = np.any([~_away_from_joints(t, angles) for t in tracks.values()], axis=0)
    assert np.all((found == (moving >= 2)) | near), "two move at once, or do not"


def peaks(machine: Machine) -> None:
    """Find the peaks over the whole turn, its joints included."""
    diagram = machine.diagram
    for name, track in tracks_of(diagram).items():
        asked = (diagram.peak_velocity, diagram.peak_acceleration, diagram.peak_jerk)
        for order, ask in enumerate(asked, 1):
            own, found = track.peak(order, diagram.rate_per_hour / 10), ask(name)
            assert np.isclose(found, own, rtol=1e-3), f"peak {order} of {name}: {found}, not {own}"


def violations(machine: Machine) -> None:
    """Find every collision and none besides, how far it goes, and the clearance left."""
    diagram, tracks = machine.diagram, tracks_of(machine.diagram)
    for rule in machine.rules:
        found = cm.find_violations(diagram, rule)
        arcs = [(one.start_deg, one.end_deg) for one in found]
        grid = grid_of(rule, tracks, 5000)
        values = margin(rule, tracks, grid)
        broken = grid[values > NEAR_MM]
        missed = broken[~_inside(broken, arcs, NEAR_DEG)]
        assert not missed.size, f"missed at {missed[:3]} deg ({rule})"
        most, angle = worst(rule, tracks)
        assert most <= NEAR_MM or _inside(np.array([angle]), arcs, NEAR_DEG), f"missed at {angle}"
        for one in found:
            inside = one.start_deg + (one.end_deg - one.start_deg) * np.linspace(0.001, 0.999, 201)
            first, second = excesses(rule, tracks, inside)
            least = float(np.minimum(first, second).min())
            assert least > -NEAR_MM, f"no collision at {one}"
            here = excesses(rule, tracks, one.angle_deg)[0]
            same(one.excess_mm, here, NEAR_MM)
            assert first.max() <= one.excess_mm + NEAR_MM, f"it goes further than {one}"
        [left] = cm.find_clearances(diagram, rule)
        first, second = excesses(rule, tracks, grid)
        rooms = -first[second > NEAR_MM]
        if left.angle_deg is None:
            assert not rooms.size, f"there is a clearance ({rule})"
        else:
            assert left.clearance_mm <= rooms.min(initial=np.inf) + NEAR_MM, (
                f"less is left ({rule})"
            )
            room, other = excesses(rule, tracks, left.angle_deg)
            same(left.clearance_mm, -room, NEAR_MM)
            assert other > -NEAR_MM, f"the clearance is counted where {rule} asks for none"


def tables(machine: Machine) -> None:
    """Write a table and read it back: it gives the same machine, with no law given beside it."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "machine.csv"
        cm.write_segments(machine.diagram, path)
        back = cm.read_segments(path)
        steps = int(machine.rng.choice([8, 360, 720, 1001]))
        paths = cm.write_cam_tables(machine.diagram, folder, points=steps + 1, decimals=9)
        cams = {
            motion.name: cm.read_cam_table(paths[motion.name])
            for motion in machine.diagram.motions
            if not motion.is_indexing
        }
    angles = machine.rng.uniform(-400, 400, 100)
    assert back.names == machine.diagram.names
    assert back.rate_per_hour == machine.diagram.rate_per_hour
    for name in back.names:
        one, other = machine.diagram[name], back[name]
        same(other.position_mm(angles), one.position_mm(angles), 1e-9)
        if cam := cams.get(name):
            same(cam.position_mm, one.position_mm(cam.angle_deg), 1.1e-9)
        for order in (1, 2, 3):
            peaks = one.peak(order), other.peak(order)
            assert peaks[0] == peaks[1] or np.isclose(*peaks, rtol=1e-9, atol=0), f"peaks {peaks}"


def same(found: object, own: object, within: float) -> None:
    """Assert that numbers are the same, within so much."""
    off = np.abs(np.subtract(found, own))  # type: ignore[call-overload]
    assert np.all(off <= within), f"{off.max()} off, and {within} is allowed"


def _inside(angles: Array, arcs: list[tuple[float, float]], slack: float = 0.0) -> Flags:
    """Tell which angles lie in one of some arcs."""
    found = np.zeros(np.shape(angles), bool)
    for start, end in arcs:
        found |= np.mod(angles - start + slack, 360) <= end - start + 2 * slack
    return found


def _moves(track: Track, angles: Array) -> Flags:
    arcs = [(p.from_deg, p.to_deg) for p in track.pieces if p.law is not None]
    return _inside(angles, arcs)


def _away_from_joints(track: Track, angles: Array) -> Flags:
    joints = np.array([angle for piece in track.pieces for angle in piece.joints_deg])
    off = np.abs((angles[:, None] - joints + 180) % 360 - 180)
    return np.asarray(off.min(axis=1) > NEAR_DEG)


def is_refused(motion: cm.Motion, ask: Callable[[], object]) -> bool:
    """Tell whether moves hand over a velocity, and see that other angles are refused for them."""
    if not _hands_over(track_of(motion)):
        return False
    said = "nothing"
    try:
        ask()
    except cm.InputError as refusal:
        said = str(refusal)
    assert "with other angles it would jump" in said, f"{motion.name} is torn apart: {said}"
    return True


def _hands_over(track: Track) -> bool:
    """Tell by the laws' own expressions whether a velocity goes on at a joint and jumps nowhere."""

    def speed(piece: Piece, angle: float) -> float:
        return float(piece.curve(1, np.array(angle)))

    beside, joints = [], []
    for before, after in zip([track.pieces[-1], *track.pieces], track.pieces, strict=False):
        joints.append((speed(before, before.to_deg), speed(after, after.from_deg)))
        near = 1e-9 * (after.to_deg - after.from_deg)
        inner = after.joints_deg[1:-1]
        beside += [(speed(after, at - near), speed(after, at + near)) for at in inner]
    least = 1e-6 * max(1e-12, *(abs(one) for pair in joints + beside for one in pair))
    jumps = any(abs(one - other) > least for one, other in joints + beside)
    return not jumps and any(abs(one) > least for one, _ in joints)
