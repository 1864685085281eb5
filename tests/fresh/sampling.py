"""Where the parts of a machine are, sampled: plain NumPy upon the laws' own expressions.

It takes from the package what was said of a machine (segments, laws, rules), and none of its
solvers, arcs and curves.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import pairwise
from typing import Any, TypeAlias

import numpy as np
import sympy
from numpy.typing import NDArray

import cammotion as cm
from cammotion import ClearanceRule, Motion, MotionLaw, TimingDiagram, x

Array: TypeAlias = NDArray[np.float64]

COARSE, PER_PIECE = 1500, 150  # samples of the turn, and of each piece
PEAKS, ZOOMS = 8, 4  # so many of the largest are refined, so often


@lru_cache(300)
def function_of(law: MotionLaw, order: int) -> Callable[[Any], Array]:
    """Return S, V, A or J of a law, compiled from its expression alone."""
    expression = sympy.diff(law.s, x, order)
    compiled = sympy.lambdify(x, expression, "numpy")
    return lambda places: np.asarray(compiled(places) + np.zeros(np.shape(places)), np.float64)


@lru_cache(300)
def joints_of(law: MotionLaw) -> tuple[float, ...]:
    """Return the places at which a law goes from one expression to the next."""
    bounds = {
        float(bound)
        for pieces in law.s.atoms(sympy.Piecewise)
        for _, condition in pieces.args
        for bound in condition.atoms(sympy.Number)
    }
    return tuple(sorted(place for place in bounds if 0 < place < 1))


def jumps_at(curve: Callable[[Any], Array], places: Any, near: float) -> Array:
    """Return how a curve jumps at some places, without what it changes by its slope on the way."""
    here = np.asarray(places, float)
    one, two = (curve(here + n * near) - curve(here - n * near) for n in (1, 2))
    return np.asarray(2 * one - two)


@dataclass(frozen=True)
class Piece:
    """A piece of a motion: a move by a law, or a dwell."""

    from_deg: float
    to_deg: float
    from_mm: float
    to_mm: float
    law: MotionLaw | None

    def curve(self, order: int, angles: Array) -> Array:
        """Return the position in mm, or its derivative by the angle in deg."""
        if self.law is None:
            return np.full(np.shape(angles), 0.0 if order else self.from_mm)
        width = self.to_deg - self.from_deg
        places = np.clip((angles - self.from_deg) / width, 0, 1)
        change = (self.to_mm - self.from_mm) / width**order
        values = change * function_of(self.law, order)(places)
        return np.asarray(values if order else self.from_mm + values)

    @property
    def joints_deg(self) -> list[float]:
        """The angles at which its curve may jump: its ends, and the joints of its law."""
        inner = joints_of(self.law) if self.law else ()
        ways = [self.from_deg + place * (self.to_deg - self.from_deg) for place in inner]
        return [self.from_deg, *ways, self.to_deg]


@dataclass(frozen=True)
class Track:
    """A motion over the turn, piece by piece; `pitch_mm` is 0 for one that comes back."""

    pieces: Sequence[Piece]
    pitch_mm: float = 0.0

    def curve(self, order: int, angles: Any) -> Array:
        """Return the position within the turn in mm, or its derivative by the angle in deg."""
        start = self.pieces[0].from_deg
        phase = start + np.mod(np.asarray(angles, float) - start, 360)
        ends = np.array([piece.to_deg for piece in self.pieces[:-1]])
        which = np.searchsorted(ends, phase, side="right")
        values = np.empty(np.shape(phase))
        for number, piece in enumerate(self.pieces):
            here = which == number
            values[here] = piece.curve(order, phase[here])
        return values

    def offset(self, angles: Any) -> Array:
        """Return the position, or of a turret the distance from the nearest stop."""
        positions = self.curve(0, angles)
        if not self.pitch_mm:
            return positions
        passed = np.mod(positions - self.pieces[0].from_mm, abs(self.pitch_mm))
        return np.asarray(np.minimum(passed, abs(self.pitch_mm) - passed))

    @cached_property
    def grid(self) -> Array:
        """Angles that show all of it: some over the turn, more in each piece."""
        fine = [np.linspace(p.from_deg, p.to_deg, PER_PIECE) for p in self.pieces]
        joints = [angle for piece in self.pieces for angle in piece.joints_deg]
        return np.asarray(np.mod(np.concatenate([*fine, joints]), 360))

    def peak(self, order: int, deg_per_s: float) -> float:
        """Return the largest derivative in m and s; infinite where the one before it jumps."""
        if any(self._jumps(lower) for lower in range(1, order)):
            return np.inf
        return self._largest(order) * deg_per_s**order / 1000

    def _largest(self, order: int) -> float:
        """Return the largest size of a derivative between the joints, in mm and deg."""
        most = 0.0
        for piece in self.pieces:
            for low, high in pairwise(piece.joints_deg):
                inside = np.linspace(low, high, 2001)[1:-1]
                values = np.abs(piece.curve(order, np.array([*_nudged(low, high), *inside])))
                most = max(most, float(values.max()))
        return most

    def _jumps(self, order: int) -> bool:
        """Whether a derivative jumps anywhere in the turn, also beside a move that is far harder.

        Rounding is a millionth of the move before or after, and 1e-8 of the largest of all.
        """
        sizes = [abs(p.to_mm - p.from_mm) / (p.to_deg - p.from_deg) ** order for p in self.pieces]
        rounding = 1e-8 * self._largest(order)
        for number, piece in enumerate(self.pieces):
            on = (number + 1) % len(self.pieces)
            end = piece.curve(order, np.array(piece.to_deg))
            step = abs(end - self.pieces[on].curve(order, np.array(self.pieces[on].from_deg)))
            if step > max(1e-6 * max(sizes[number], sizes[on]), rounding):
                return True
            if piece.law is not None:
                inner = np.array(joints_of(piece.law))
                steps = np.abs(jumps_at(function_of(piece.law, order), inner, 1e-7))
                if np.any(steps * sizes[number] > max(1e-6 * sizes[number], rounding)):
                    return True
        return False


def _nudged(low: float, high: float) -> tuple[float, float]:
    """Return the ends of an interval, just inside: at a joint the law is the one before it."""
    return low + 1e-9 * (high - low), high - 1e-9 * (high - low)


def track_of(motion: Motion) -> Track:
    """Return what was said of a motion."""
    pieces = [
        Piece(s.from_deg, s.to_deg, s.from_mm, s.to_mm, None if s.law is None else cm.as_law(s.law))
        for s in motion.segments
    ]
    pitch = pieces[-1].to_mm - pieces[0].from_mm if motion.stops is not None else 0.0
    return Track(pieces, pitch)


Tracks: TypeAlias = dict[str, Track]


def tracks_of(diagram: TimingDiagram) -> Tracks:
    """Return the tracks by their names."""
    return {motion.name: track_of(motion) for motion in diagram.motions}


def excesses(rule: ClearanceRule, tracks: Tracks, angles: Any) -> tuple[Array, Array]:
    """Return how far `when` holds and how far `only_while` does not, in mm; above 0 if so."""
    sides = [(rule.when, 1), (rule.only_while, -1)]
    first, second = (
        side * (1 if half.is_beyond else -1) * (tracks[half.motion].offset(angles) - half.limit_mm)
        for half, side in sides
    )
    return first, second


def margin(rule: ClearanceRule, tracks: Tracks, angles: Any) -> Array:
    """Return by how much a rule is broken, in mm: as far as both halves say."""
    return np.minimum(*excesses(rule, tracks, angles))


def grid_of(rule: ClearanceRule, tracks: Tracks, coarse: int = COARSE) -> Array:
    """Return angles in order that show both motions of a rule."""
    own = [tracks[half.motion].grid for half in (rule.when, rule.only_while)]
    return np.unique(np.concatenate([np.arange(coarse) * 360 / coarse, *own]))


def worst(
    rule: ClearanceRule, tracks: Tracks, *, coarse: int = COARSE, enough: float = np.inf
) -> tuple[float, float]:
    """Return the largest margin over the turn and its angle, refined where it is largest.

    Of a level stretch the ends are enough: else they are lost among so many as high. A margin of
    `enough` is as good as any larger one: then it is not refined.
    """
    grid = grid_of(rule, tracks, coarse)
    values = margin(rule, tracks, grid)
    most, angle = float(values.max()), float(grid[np.argmax(values)])
    before, after = np.roll(values, 1), np.roll(values, -1)
    is_level = (values == before) & (values == after)
    if most >= enough or is_level.all():
        return most, angle
    gaps = np.diff(grid, append=grid[0] + 360)
    reaches = np.maximum(gaps, np.roll(gaps, 1))
    peaks = np.flatnonzero((values >= before) & (values >= after) & ~is_level)
    peaks = peaks[np.argsort(-values[peaks])][:PEAKS]
    centers, reach = grid[peaks], reaches[peaks]
    for _ in range(ZOOMS):
        near = centers[:, None] + reach[:, None] * np.linspace(-1, 1, 41)
        here = margin(rule, tracks, near)
        centers = near[np.arange(len(peaks)), np.argmax(here, axis=1)]
        reach = reach / 15
        if here.max() > most:
            most, angle = float(here.max()), float(near.flat[np.argmax(here)])
    return most, angle


def worst_of(
    rules: Iterable[ClearanceRule], tracks: Tracks, *, coarse: int = COARSE, enough: float = np.inf
) -> float:
    """Return the largest margin of several rules, above 0 if one is broken; or one of `enough`."""
    most = -np.inf
    for rule in rules:
        if most < enough:
            most = max(most, worst(rule, tracks, coarse=coarse, enough=enough)[0])
    return most
