"""A motion found on a grid: its acceleration is a straight line over each cell.

What a linear program finds is a list of numbers. Here it becomes a motion like any other, of
segments with motion laws, to be drawn, checked and animated.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from cammotion.limits.corridors import Corridor
from cammotion.limits.ramps import Ramp, law_of
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import Floats
from cammotion.rules.rule import ROUNDING_MM

_ROUNDING_TIME = 1e-6  # of a cell
_STAYS_MM = 1e-6  # the solver's rounding of a motion that stays
KEPT_MM = 1e-6
"""So far from its limits a motion is held, that the solver's rounding stays within the corridor."""


@dataclass(frozen=True)
class GridMotion:
    """Position in mm and velocity at the nodes of a grid, acceleration by cells.

    `times` are those of the cells; `starting` and `ending` the accelerations at the
    beginning and at the end of each, with a straight line in between.
    """

    times: Floats
    position: Floats
    velocity: Floats
    starting: Floats
    ending: Floats

    @property
    def peak(self) -> float:
        """Its largest acceleration, either way."""
        return float(np.abs([self.starting, self.ending]).max())

    def strays(self, room: Corridor) -> Floats:
        """Return for each cell how far, in mm, the motion leaves the corridor inside of it."""
        high, low = (
            choose(limit, room.next_of(limit))
            for limit, choose in ((room.high_mm, np.maximum), (room.low_mm, np.minimum))
        )
        strays = np.zeros(len(self.times))
        for cell in map(int, np.flatnonzero(~room.still_cells)):
            for time in self._turns(cell):
                place = self._place(cell, time)
                strays[cell] = max(strays[cell], place - high[cell], low[cell] - place)
        return np.where(strays > ROUNDING_MM, strays, 0.0)

    def build(self, motion: Motion, room: Corridor) -> Motion:
        """Return the motion in segments: a dwell where it has to stand, a move in between.

        Where it comes back to where it was, a rise and a return meet at the far end. An indexing
        motion begins at a stop: in the corridor it has to stand at one.
        """
        segments: list[Segment] = []
        for first, last in _from_a_stop(motion, room):
            if segments and segments[-1].to_deg < _angle(room, first):
                segments.append(_dwell(segments[-1], _angle(room, first)))
            segments += self._segments(room, first, last)
        if not segments:  # nothing drives it from its place
            first = room.stretches[0][0] if room.stretches else 0
            start, at = _angle(room, first), _height(room, first)
            end = start + DEG_PER_TURN
            return Motion(motion.name, (Segment(from_deg=start, to_deg=end, from_mm=at, to_mm=at),))
        end = segments[0].from_deg + DEG_PER_TURN
        if segments[-1].to_deg < end:
            segments.append(_dwell(segments[-1], end))
        return Motion(motion.name, tuple(segments), motion.stops)

    def _segments(self, room: Corridor, first: int, last: int) -> Iterator[Segment]:
        """Yield the one or two moves of a stretch."""
        start, end = _height(room, first), _height(room, last)
        if abs(end - start) < ROUNDING_MM and self._stays(room, first, last):
            return
        ramps = [self._ramp(n) for n in range(first, last)]
        angles, heights, parts = [_angle(room, first)], [start], [ramps]
        if abs(end - start) < ROUNDING_MM:
            cell, time = self._far_end(room, first, last)
            far = self._ramp(cell)
            time_to = sum(ramp.seconds for ramp in ramps[: cell - first]) + time
            parts = [
                [*ramps[: cell - first], far.before(time)],
                [far.after(time), *ramps[cell - first + 1 :]],
            ]
            angles.append(angles[0] + time_to * DEG_PER_TURN / float(self.times.sum()))
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
                law=law_of(part, to_mm - from_mm),
            )

    def _stays(self, room: Corridor, first: int, last: int) -> bool:
        start = _height(room, first)
        return all(abs(self._height(room, n, 0) - start) < _STAYS_MM for n in range(first, last))

    def _ramp(self, number: int) -> Ramp:
        cell = number % len(self.times)
        return Ramp(*(float(values[cell]) for values in (self.times, self.starting, self.ending)))

    def _far_end(self, room: Corridor, first: int, last: int) -> tuple[int, float]:
        """Return where a motion that comes back is first farthest away: the cell, the time in it.

        Places that differ by the solver's rounding are equally far.
        """
        nodes, start = len(self.times), _height(room, first)
        turns = [(n, time) for n in range(first, last) for time in self._turns(n % nodes)]
        ways = [abs(self._height(room, *turn) - start) for turn in turns]
        far = max(ways) - _STAYS_MM
        return next(turn for turn, way in zip(turns, ways, strict=True) if way > far)

    def _turns(self, cell: int) -> list[float]:
        """Return the times within a cell at which the velocity is zero."""
        ramp = self._ramp(cell)
        times = _zeros(ramp.slope / 2, ramp.starting, float(self.velocity[cell]))
        slack = _ROUNDING_TIME * ramp.seconds  # a turn at a node may lie in neither of its cells
        here = [time for time in times if -slack <= time <= ramp.seconds + slack]
        return [min(max(time, 0.0), ramp.seconds) for time in here]

    def _height(self, room: Corridor, number: int, time: float) -> float:
        """Return the position within a cell, counted on into the next turns."""
        turns, cell = divmod(number, len(self.times))
        return self._place(cell, time) + turns * room.pitch_mm

    def _place(self, cell: int, time: float) -> float:
        ramp = self._ramp(cell)
        moved = self.velocity[cell] * time + ramp.before(time).moved
        return float(self.position[cell] + moved)


def _zeros(a: float, b: float, c: float) -> list[float]:
    """Return the real zeros of a t² + b t + c in their order; none if it is zero everywhere."""
    inside = b * b - 4 * a * c
    if inside < 0:
        return []
    half = -(b + math.copysign(math.sqrt(inside), b)) / 2  # no cancellation
    quotients = ((c, half), (half, a))
    return sorted(over / under for over, under in quotients if under)


def _from_a_stop(motion: Motion, room: Corridor) -> list[tuple[int, int]]:
    """Return the stretches; those of an indexing motion from one on that begins at a stop.

    It does so before the motion in the diagram begins, so that both count the same turns.
    """
    stretches, nodes = room.stretches, len(room.still)
    if not motion.is_indexing:
        return stretches
    pitch = room.pitch_mm
    turns = [(_height(room, first) - motion.start_mm) / pitch for first, _ in stretches]
    off = [abs((turn - round(turn)) * pitch) for turn in turns]
    number = next(n for n, way in enumerate(off) if way <= ROUNDING_MM)
    ahead = [
        *stretches[number:],
        *((start + nodes, end + nodes) for start, end in stretches[:number]),
    ]
    back = nodes if stretches[number][0] else 0
    return [(start - back, end - back) for start, end in ahead]


def _angle(room: Corridor, node: int) -> float:
    turns, node = divmod(node, len(room.still))
    return float(room.angle_deg[node]) + turns * DEG_PER_TURN


def _height(room: Corridor, node: int) -> float:
    turns, node = divmod(node, len(room.still))
    return float(room.low_mm[node]) + turns * room.pitch_mm


def _dwell(before: Segment, to_deg: float) -> Segment:
    return Segment(from_deg=before.to_deg, to_deg=to_deg, from_mm=before.to_mm, to_mm=before.to_mm)
