"""A motion found on a grid: its acceleration is a straight line over each cell.

What a linear program finds is a list of numbers. Here it becomes a motion like any other, of
segments with motion laws, to be drawn, checked and animated. Cells over which the acceleration is
one line are made one zone of the law, so that of hundreds of cells a few zones remain.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cammotion.checks import Floats, InputError
from cammotion.corridors import Corridor
from cammotion.kinematics import DEG_PER_TURN
from cammotion.motion_law import MotionLaw
from cammotion.motions import Motion
from cammotion.segments import Segment
from cammotion.zones import Zone, join, x

_SAME = 1e-8  # accelerations that differ by so much of the largest are one
_ROUNDING_MM = 1e-9  # by so much positions may differ and be one
_ROUNDING_TIME = 1e-6  # of a cell
_STAYS_MM = 1e-6  # the solver's rounding of a motion that stays


@dataclass(frozen=True)
class GridMotion:
    """Position (mm) and velocity (mm/s) at the nodes of a grid, acceleration (mm/s2) by cells.

    `seconds` are the times of the cells; `starting` and `ending` the accelerations at the
    beginning and at the end of each, with a straight line in between.
    """

    seconds: Floats
    position: Floats
    velocity: Floats
    starting: Floats
    ending: Floats

    def strays(self, room: Corridor) -> Floats:
        """Return for each cell how far, in mm, the motion leaves the corridor inside of it."""
        high, low = (
            choose(limit, room.next_of(limit))
            for limit, choose in ((room.high_mm, np.maximum), (room.low_mm, np.minimum))
        )
        strays = np.zeros(len(self.seconds))
        for cell in map(int, np.flatnonzero(~room.still_cells)):
            for time in self._turns(cell):
                place = self._place(cell, time)
                strays[cell] = max(strays[cell], place - high[cell], low[cell] - place)
        return np.where(strays > _ROUNDING_MM, strays, 0.0)

    def build(self, motion: Motion, room: Corridor) -> Motion:
        """Return the motion in segments: a dwell where it has to stand, a move in between.

        Where it comes back to where it was, a rise and a return meet at the far end. An indexing
        motion begins at a stop; raises InputError if it stands at none.
        """
        segments: list[Segment] = []
        for first, last in _from_a_stop(motion, room):
            if segments and segments[-1].to_deg < _angle(room, first):
                segments.append(_dwell(segments[-1], _angle(room, first)))
            segments += self._segments(room, first, last)
        if not segments:  # nothing drives it from its place
            start, at = _angle(room, room.stretches[0][0]), _height(room, room.stretches[0][0])
            end = start + DEG_PER_TURN
            return Motion(motion.name, (Segment(from_deg=start, to_deg=end, from_mm=at, to_mm=at),))
        end = segments[0].from_deg + DEG_PER_TURN
        if segments[-1].to_deg < end:
            segments.append(_dwell(segments[-1], end))
        return Motion(motion.name, tuple(segments), motion.stops)

    def _segments(self, room: Corridor, first: int, last: int) -> Iterator[Segment]:
        """Yield the one or two moves of a stretch."""
        start, end = _height(room, first), _height(room, last)
        if abs(end - start) < _ROUNDING_MM and self._stays(room, first, last):
            return
        pieces = [self._piece(n) for n in range(first, last)]
        angles, heights, parts = [_angle(room, first)], [start], [pieces]
        if abs(end - start) < _ROUNDING_MM:
            cell, time = self._far_end(room, first, last)
            far = self._piece(cell)
            seconds = sum(piece.seconds for piece in pieces[: cell - first]) + time
            parts = [
                [*pieces[: cell - first], far.before(time)],
                [far.after(time), *pieces[cell - first + 1 :]],
            ]
            angles.append(angles[0] + seconds * DEG_PER_TURN / float(self.seconds.sum()))
            heights.append(self._height(room, cell, time))
        angles.append(_angle(room, last))
        heights.append(end)
        for number, part in enumerate(parts):
            from_mm, to_mm = heights[number : number + 2]
            yield Segment(
                from_deg=angles[number],
                to_deg=angles[number + 1],
                from_mm=from_mm,
                to_mm=to_mm,
                law=_law(part, to_mm - from_mm),
            )

    def _stays(self, room: Corridor, first: int, last: int) -> bool:
        start = _height(room, first)
        return all(abs(self._height(room, n, 0) - start) < _STAYS_MM for n in range(first, last))

    def _piece(self, number: int) -> "_Piece":
        cell = number % len(self.seconds)
        return _Piece(
            *(float(values[cell]) for values in (self.seconds, self.starting, self.ending))
        )

    def _far_end(self, room: Corridor, first: int, last: int) -> tuple[int, float]:
        """Return where a motion that comes back is farthest away: the cell and the time in it."""
        nodes, start = len(self.seconds), _height(room, first)
        turns = [(n, time) for n in range(first, last) for time in self._turns(n % nodes)]
        return max(turns, key=lambda turn: abs(self._height(room, *turn) - start))

    def _turns(self, cell: int) -> list[float]:
        """Return the times within a cell at which the velocity is zero."""
        piece = self._piece(cell)
        roots = np.roots([piece.slope / 2, piece.starting, self.velocity[cell]])
        real = roots[np.isreal(roots)].real
        slack = _ROUNDING_TIME * piece.seconds  # a turn at a node may lie in neither of its cells
        here = real[(real >= -slack) & (real <= piece.seconds + slack)]
        return [float(time) for time in np.clip(here, 0.0, piece.seconds)]

    def _height(self, room: Corridor, number: int, time: float) -> float:
        """Return the position within a cell, counted on into the next turns."""
        turns, cell = divmod(number, len(self.seconds))
        return self._place(cell, time) + turns * room.pitch_mm

    def _place(self, cell: int, time: float) -> float:
        piece = self._piece(cell)
        moved = self.velocity[cell] * time + piece.before(time).moved
        return float(self.position[cell] + moved)


class _Piece(NamedTuple):
    """A time over which the acceleration is a straight line."""

    seconds: float
    starting: float
    ending: float

    @property
    def slope(self) -> float:
        return (self.ending - self.starting) / self.seconds

    @property
    def gained(self) -> float:
        """The velocity gained."""
        return self.seconds * (self.starting + self.ending) / 2

    @property
    def moved(self) -> float:
        """The way made, from rest."""
        return self.seconds**2 * (self.starting / 3 + self.ending / 6)

    def before(self, time: float) -> "_Piece":
        return _Piece(time, self.starting, self.starting + self.slope * time)

    def after(self, time: float) -> "_Piece":
        return _Piece(self.seconds - time, self.starting + self.slope * time, self.ending)


def _law(pieces: list[_Piece], change_mm: float) -> MotionLaw:
    """Return the law of a move by `change_mm` from rest to rest."""
    pieces = _closed(_merged(pieces), change_mm)
    total = sum(piece.seconds for piece in pieces)
    zones, place, s, v = [], 0.0, 0.0, 0.0
    for piece in pieces:
        scaled = _Piece(
            piece.seconds / total,
            piece.starting * total**2 / change_mm,
            piece.ending * total**2 / change_mm,
        )
        u = x - place
        curve = s + v * u + scaled.starting * u**2 / 2 + scaled.slope * u**3 / 6
        end = place + scaled.seconds
        zones.append(Zone(curve, place, end))
        place, s, v = end, s + v * scaled.seconds + scaled.moved, v + scaled.gained
    zones[-1] = zones[-1]._replace(high=1.0)
    return MotionLaw("least acceleration", join(zones))


def _merged(pieces: list[_Piece]) -> list[_Piece]:
    """Return the pieces with those made one whose accelerations are one line."""
    rounding = _SAME * max(abs(end) for piece in pieces for end in piece[1:])
    found: list[_Piece] = []
    for piece in pieces:
        if piece.seconds <= 0:
            continue
        if found and _is_one_line(found[-1], piece, rounding):
            before = found.pop()
            piece = _Piece(before.seconds + piece.seconds, before.starting, piece.ending)
        found.append(piece)
    return found


def _is_one_line(one: _Piece, other: _Piece, rounding: float) -> bool:
    bend = (one.slope - other.slope) * min(one.seconds, other.seconds)
    return abs(one.ending - other.starting) <= rounding and abs(bend) <= rounding


def _closed(pieces: list[_Piece], change_mm: float) -> list[_Piece]:
    """Return the pieces without the rounding of what found them: ending at rest, in its place.

    The accelerations are changed as little as this takes. What is constant stays so, what is
    continuous too, and where a move begins or ends without acceleration it does so still.
    """
    ends = np.array([piece[1:] for piece in pieces])
    share = _free_ends(ends)
    seconds = [piece.seconds for piece in pieces]
    effect = np.array([_outcome(seconds, column.reshape(-1, 2)) for column in share.T]).T
    for _ in range(2):
        missing = np.array([0.0, change_mm]) - _outcome(seconds, ends)
        scale = np.abs(effect).max(axis=1)
        change = np.linalg.lstsq(effect / scale[:, None], missing / scale, rcond=None)[0]
        ends = ends + (share @ change).reshape(-1, 2)
    return [_Piece(time, *map(float, both)) for time, both in zip(seconds, ends, strict=True)]


def _free_ends(ends: Floats) -> Floats:
    """Return which ends of the pieces change together: a column for each that is free."""
    count = len(ends)
    rounding = _SAME * np.abs(ends).max()
    if np.all(np.abs(ends[:, 0] - ends[:, 1]) <= rounding):
        return np.repeat(np.eye(count), 2, axis=0)
    corners = np.zeros((2 * count, count + 1))
    for piece in range(count):
        corners[2 * piece, piece] = corners[2 * piece + 1, piece + 1] = 1.0
    values = np.append(ends[:, 0], ends[-1, 1])
    inner = (np.arange(count + 1) % count > 0) | (np.abs(values) > rounding)
    return corners[:, inner]


def _outcome(seconds: list[float], ends: Floats) -> Floats:
    """Return the velocity and the place, from rest, at the end of pieces."""
    place = velocity = 0.0
    for time, both in zip(seconds, ends, strict=True):
        piece = _Piece(time, *both)
        place += velocity * time + piece.moved
        velocity += piece.gained
    return np.array([velocity, place])


def _from_a_stop(motion: Motion, room: Corridor) -> list[tuple[int, int]]:
    """Return the stretches; those of an indexing motion from one on that begins at a stop.

    It does so before the motion in the diagram begins, so that both count the same turns.
    """
    stretches, nodes = room.stretches, len(room.still)
    if not motion.is_indexing:
        return stretches
    for number, (first, _) in enumerate(stretches):
        off = (_height(room, first) - motion.start_mm) / room.pitch_mm
        if abs(off - round(off)) * abs(room.pitch_mm) < _ROUNDING_MM:
            back = nodes if first else 0
            earlier = [(start - back, end - back) for start, end in stretches[number:]]
            later = [
                (start + nodes - back, end + nodes - back) for start, end in stretches[:number]
            ]
            return [*earlier, *later]
    raise InputError(
        f"The indexing motion {motion.name!r} stands at none of its stops: give a still arc over "
        "which it stands at one."
    )


def _angle(room: Corridor, node: int) -> float:
    turns, node = divmod(node, len(room.still))
    return float(room.angle_deg[node]) + turns * DEG_PER_TURN


def _height(room: Corridor, node: int) -> float:
    turns, node = divmod(node, len(room.still))
    return float(room.low_mm[node]) + turns * room.pitch_mm


def _dwell(before: Segment, to_deg: float) -> Segment:
    return Segment(from_deg=before.to_deg, to_deg=to_deg, from_mm=before.to_mm, to_mm=before.to_mm)
