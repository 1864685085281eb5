"""Checks of the widest move: what stays in place, and that no wider one is free."""

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

import cammotion as cm
from cammotion import InputError, Motion
from fresh.check_machines import NEAR_DEG, NEAR_MM, is_refused, same
from fresh.drawing import Machine
from fresh.sampling import Piece, Track, track_of, tracks_of, worst_of

SCAN = 60  # angles at which a wider move is tried
WIDER_DEG = 1e-2
FEW, MANY = 400, 20_000  # samples of the turn, to suspect and to be sure


def widenings(machine: Machine) -> None:
    """Give moves another angle: each stands where it has to."""
    for motion in machine.diagram.motions:
        if len(motion.moves) == (1 if motion.is_indexing else 2):
            angle = machine.rng.uniform(0.02, 1) * _most(motion)
            if is_refused(motion, partial(cm.with_angle, motion, angle)):
                continue
            try:
                found = track_of(cm.with_angle(motion, angle))
            except InputError as refusal:
                raise AssertionError(f"{angle} deg fit, but: {refusal}") from refusal
            own = widened(track_of(motion), angle)
            angles = machine.rng.uniform(0, 360, 200)
            same(
                found.offset(angles), own.offset(angles), 1e-8 * (1 + np.ptp(own.offset(own.grid)))
            )


def widest(machine: Machine) -> None:
    """See that the widest move is free, and no wider one is."""
    for motion in _widenable(machine):
        _check_widest(machine, motion)


def each_way(machine: Machine) -> None:
    """See that the best pair of angles for rise and return is free, and no better one is."""
    for motion in _widenable(machine):
        if not motion.is_indexing:
            _check_each_way(machine, motion)


def widened(track: Track, *angles: float) -> Track:
    """Return a motion with other angles for its moves, what stays staying in place."""
    moves = [piece for piece in track.pieces if piece.law is not None]
    first, last = moves[0], moves[-1]
    if track.pitch_mm:
        middle, half = (first.from_deg + first.to_deg) / 2, angles[0] / 2
        made = [replace(first, from_deg=middle - half, to_deg=middle + half)]
    else:
        made = [
            replace(first, from_deg=first.to_deg - angles[0]),
            replace(last, to_deg=last.from_deg + angles[-1]),
        ]
    pieces = []
    for piece, following in zip(made, [*made[1:], made[0]], strict=True):
        end = following.from_deg + (360 if following is made[0] else 0)
        pieces.append(piece)
        if end > piece.to_deg:
            pieces.append(Piece(piece.to_deg, end, piece.to_mm, piece.to_mm, None))
    return Track(pieces, track.pitch_mm)


class _Search:
    """A motion that is made wider among the others, and the rules in which it has a part."""

    def __init__(self, machine: Machine, motion: Motion) -> None:
        self.name, self.room = motion.name, _room(motion)
        self.rules = [rule for rule in machine.rules if motion.name in _motions_of(rule)]
        self.others = [rule for rule in machine.rules if rule not in self.rules]
        self.tracks = tracks_of(machine.diagram)
        self.own = self.tracks[motion.name]

    def broken_by(self, *angles: float, coarse: int = MANY) -> float:
        """Return by how much these angles break a rule, in mm; below 0 if none is."""
        wider = {**self.tracks, self.name: widened(self.own, *angles)}
        return worst_of(self.rules, wider, coarse=coarse, enough=NEAR_MM)

    def is_free(self, *angles: float) -> bool:
        """Tell whether angles surely keep all rules."""
        return self.broken_by(*angles, coarse=FEW) < -NEAR_MM and self.broken_by(*angles) < -NEAR_MM

    def solve(self, machine: Machine, *, each_way: bool) -> tuple[float, ...]:
        """Return the angles that the package finds, (0,) if none; see that they are free."""
        given = machine.diagram, self.name, machine.rules
        try:
            found = cm.widest_move(*given, each_way=each_way)
        except InputError as refusal:
            if not str(refusal).startswith("No move of the"):
                raise AssertionError(f"{self.name} is refused: {refusal}") from refusal
            return (0.0,)
        angles = found.angles_deg
        assert min(angles) > 0, f"{self.name}: {angles} deg"
        assert sum(angles) <= self.room + NEAR_DEG, f"{self.name}: {angles} deg of {self.room}"
        assert self.broken_by(*angles) <= NEAR_MM, f"{self.name} collides at {angles} deg"
        places = machine.rng.uniform(0, 360, 200)
        size = 1e-8 * (1 + np.ptp(self.own.offset(self.own.grid)))
        moved = found.diagram.offset_mm(self.name, places)
        same(moved, widened(self.own, *angles).offset(places), size)
        elsewhere = worst_of(self.others, self.tracks)
        assert found.elsewhere or elsewhere < NEAR_MM, "a violation elsewhere is not told"
        assert not found.elsewhere or elsewhere > -NEAR_MM, "a violation is told, and there is none"
        return angles


def _check_widest(machine: Machine, motion: Motion) -> None:
    search = _Search(machine, motion)
    answer = search.solve(machine, each_way=False)[0]
    for angle in _wider(answer, _most(motion)):
        told = f"{motion.name}: {angle} deg is free, and {answer} deg was the answer"
        assert not search.is_free(angle), told


def _check_each_way(machine: Machine, motion: Motion) -> None:
    """Try pairs that would be better: none of them is free."""
    search = _Search(machine, motion)
    found = search.solve(machine, each_way=True)
    better = _wider_pairs if np.isinf(search.own.peak(2, 1.0)) else _gentler_pairs
    for pair in better(machine, search, found):
        told = f"{motion.name}: {pair} deg are free and better than {found}"
        assert min(pair) < NEAR_DEG or not search.is_free(*pair), told


def _wider_pairs(
    machine: Machine, search: _Search, found: tuple[float, ...]
) -> Iterator[tuple[float, float]]:
    """Yield pairs that take more of the turn: of any the peak is infinite."""
    least = sum(found) + WIDER_DEG
    for share, part in machine.rng.uniform(0, 1, (SCAN // 2, 2)) if least < search.room else ():
        total = least + share * (search.room - least)
        yield part * total, (1 - part) * total


def _gentler_pairs(
    machine: Machine, search: _Search, found: tuple[float, ...]
) -> Iterator[tuple[float, float]]:
    """Yield pairs that would have a smaller peak."""
    moves = [piece for piece in search.own.pieces if piece.law is not None]
    hard = [  # the peak times the square of the angle
        float(np.abs(m.curve(2, np.linspace(m.from_deg, m.to_deg, 2001))).max()) * width**2
        for m in moves
        for width in [m.to_deg - m.from_deg]
    ]
    least = [0.0, 0.0]
    if min(found) > 0:
        peak = 0.99 * max(h / angle**2 for h, angle in zip(hard, found, strict=True))
        least = [np.sqrt(h / peak) for h in hard]
    spare = search.room - sum(least)
    for share, part in machine.rng.uniform(0, 1, (SCAN // 2, 2)) if spare > 0 else ():
        yield least[0] + share * part * spare, least[1] + share * (1 - part) * spare


def _wider(answer: float, limit: float) -> Iterator[float]:
    """Yield angles wider than the answer: all over the rest, and some just above it."""
    yield from (angle for angle in answer + np.geomspace(1e-3, 1, 4) if angle < limit)
    if answer < limit - NEAR_DEG:
        yield from np.linspace(answer, limit, SCAN)[1:]


def _widenable(machine: Machine) -> Iterator[Motion]:
    for motion in machine.diagram.motions:
        has_part = any(motion.name in _motions_of(rule) for rule in machine.rules)
        if has_part and len(motion.moves) == (1 if motion.is_indexing else 2):
            ask = partial(cm.widest_move, machine.diagram, motion.name, machine.rules)
            if not is_refused(motion, ask):
                yield motion


def _room(motion: Motion) -> float:
    """Return what the turn has for all moves together."""
    first, last = motion.moves[0], motion.moves[-1]
    return 360.0 if motion.is_indexing else 360 - (last.from_deg - first.to_deg)


def _most(motion: Motion) -> float:
    return _room(motion) / len(motion.moves)


def _motions_of(rule: cm.ClearanceRule) -> tuple[str, str]:
    return rule.when.motion, rule.only_while.motion
