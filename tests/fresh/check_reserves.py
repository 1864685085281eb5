"""Checks of what is left until a rule breaks: motions are shifted, and limits, among samples."""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

import cammotion as cm
from cammotion import InputError
from fresh.check_machines import NEAR_MM, is_refused
from fresh.check_widest import widened
from fresh.drawing import Machine
from fresh.sampling import Track, Tracks, track_of, tracks_of, worst

NEAR_DEG = 1e-5
SHIFTS = 15


def reserves(machine: Machine) -> None:
    """Go to where each rule is said to break, and a little further."""
    tracks, rng = tracks_of(machine.diagram), machine.rng
    phase, off = rng.choice([0.0, 0.1, 5.0]), rng.choice([0.0, 1e-3, 0.5]) + 1e-4
    for found in cm.reserves(machine.diagram, machine.rules):
        _check_bare(found, tracks)
    for found in cm.reserves(machine.diagram, machine.rules, phase_deg=phase, off_mm=off):
        times = found.times
        if not np.isfinite(times) or times * phase > 90:
            continue
        for _ in range(SHIFTS if times else 0):
            one, other = rng.uniform(-1, 1, 2) * times * phase
            excess = _worst(found.rule, tracks, (one, other), times * off * rng.uniform(0, 1, 2))
            assert excess < NEAR_MM, f"{found}: broken by {excess} mm within {times} times"
        more, far = times + 1e-6, []
        for way in np.linspace(-1, 1, 41):
            shift = way * more * phase
            far.append(_worst(found.rule, tracks, (shift, -shift), (more * off, more * off)))
        assert max(far) > -1e-3 * (1 + phase), f"{found}: kept with {times} times the errors"


def reserved(machine: Machine) -> None:
    """See that the widest move with a reserve has it, and that no wider one does."""
    rng = machine.rng
    for motion in machine.diagram.motions:
        rules = [r for r in machine.rules if motion.name in (r.when.motion, r.only_while.motion)]
        if not rules or len(motion.moves) != (1 if motion.is_indexing else 2):
            continue
        if is_refused(motion, partial(cm.widest_move, machine.diagram, motion.name, rules)):
            continue
        deg, mm = rng.choice([0.0, 0.2, 4.0]), rng.choice([0.0, 0.01, 1.0])
        try:
            found = cm.widest_move(
                machine.diagram, motion.name, rules, each_way=False, reserve_deg=deg, reserve_mm=mm
            )
        except InputError as refusal:
            if not str(refusal).startswith("No move of the"):
                raise AssertionError(f"{motion.name} is refused: {refusal}") from refusal
            continue
        tracks, room = tracks_of(machine.diagram), _room(motion)
        answer = found.angle_deg
        own = track_of(motion)
        for angle in (answer, *rng.uniform(answer + 1e-3, max(room, answer + 1e-3), 5)):
            if angle > room:
                continue
            wider = {**tracks, motion.name: widened(own, angle)}
            shifts = np.linspace(-deg, deg, 41) if deg else [0.0]
            most = max(
                _worst(
                    rule, {**wider, motion.name: shifted(wider[motion.name], way)}, (0, 0), (mm, 0)
                )
                for rule in rules
                for way in shifts
            )
            told = f"{motion.name} with {angle} deg, {deg} deg and {mm} mm: {most} mm"
            assert angle > answer or most < NEAR_MM, f"{told}, the answer"
            assert angle == answer or most > -NEAR_MM - 0.05 * deg, f"{told}, and {answer} deg"


def shifted(track: Track, deg: float) -> Track:
    """Return the motion so many deg later."""
    pieces = [
        replace(piece, from_deg=piece.from_deg + deg, to_deg=piece.to_deg + deg)
        for piece in track.pieces
    ]
    return replace(track, pieces=pieces)


def _check_bare(found: cm.Reserve, tracks: Tracks) -> None:
    """Shift the motion, or move a limit, by what is left."""
    rule = found.rule
    if found.deg < 0:
        assert _worst(rule, tracks) > -NEAR_MM, f"{found}, and it is kept"
        return
    for way, deg in ((-1, found.early_deg), (1, found.late_deg)):
        if np.isfinite(deg):
            for more, is_broken in ((-NEAR_DEG, False), (NEAR_DEG, True)):
                excess = _worst(rule, tracks, (way * max(deg + more, 0), 0))
                near = NEAR_MM + NEAR_DEG * 50
                told = f"{found}: {excess} mm, {way * deg} deg later"
                assert excess > -near if is_broken else excess < near, told
    for place, room in enumerate((found.when_mm, found.other_mm)):
        if np.isfinite(room):
            off = [0.0, 0.0]
            off[place] = room
            excess = _worst(rule, tracks, (0, 0), off)
            assert -1e-3 < excess < 1e-5, f"{found}: {excess} mm with {off}"


def _worst(
    rule: Any,
    tracks: Tracks,
    later: tuple[float, float] = (0, 0),
    nearer: ArrayLike = (0, 0),
) -> float:
    """Return the excess with `when` and `only_while` later, and their limits so much nearer."""
    halves = rule.when, rule.only_while
    moved = {h.motion: shifted(tracks[h.motion], d) for h, d in zip(halves, later, strict=True)}
    when, only = (
        replace(half, limit_mm=half.limit_mm + side * (-mm if half.is_beyond else mm))
        for half, side, mm in zip(halves, (1, -1), np.asarray(nearer), strict=True)
    )
    return worst(replace(rule, when=when, only_while=only), moved)[0]


def _room(motion: cm.Motion) -> float:
    first, last = motion.moves[0], motion.moves[-1]
    whole = 360.0 if motion.is_indexing else 360 - (last.from_deg - first.to_deg)
    return whole / len(motion.moves)
