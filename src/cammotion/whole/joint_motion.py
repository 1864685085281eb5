"""Motions of several parts that can be built, from the outline of a program.

Each part has a constant acceleration over each cell of a grid. Which option of a rule is taken over
which cell the outline says; in the few cells in which a rule passes from one option to another, a
small program chooses the place.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise

import numpy as np

from cammotion.limits.corridors import Corridor, cells_of
from cammotion.limits.grid_motion import KEPT_MM, GridMotion
from cammotion.limits.programs import STEADY
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats
from cammotion.whole.joint_bound import Outline
from cammotion.whole.mixed import Rows
from cammotion.whole.parts import Part
from cammotion.whole.sides import Option, Side, cell_options

_PART_DEG = 18.0  # in such parts of a turn all numbers are of one size
_FINE_DEG = 2.0  # no cell is longer
_ROUNDS = 6  # of mending motions that stray between two nodes
_OTHERS = 1e-4  # the price of the peaks that are not the largest

Cells = list[list[tuple[Option, ...]]]
"""For each rule and cell, the options to choose from."""


def unsettled(sides: Sequence[tuple[Side, Side]], found: Outline) -> set[int]:
    """Return the cells of an outline in which some rule passes from one option to another."""
    cells = _cells(sides, found)
    return {cell for of_rule in cells for cell, options in enumerate(of_rule) if len(options) > 1}


def motions(
    parts: Sequence[Part],
    sides: Sequence[tuple[Side, Side]],
    found: Outline,
    peak: float,
    seconds: float,
) -> list[Motion] | None:
    """Return motions in the outline with no weighted peak above `peak`; None if none were found."""
    ahead = np.diff(found.angle_deg)
    counts = np.ceil(ahead / _FINE_DEG).astype(int)
    cells: Cells = [
        [options for options, count in zip(of_rule, counts, strict=True) for _ in range(count)]
        for of_rule in _cells(sides, found)
    ]
    angle = np.concatenate(
        [
            start + np.arange(count) * (way / count)
            for start, way, count in zip(found.angle_deg, ahead, counts, strict=False)
        ]
    )
    program = _OnGrid(parts, angle, cells, peak)
    held_off = [np.zeros(len(angle)) for _ in parts]
    for number in range(_ROUNDS):
        if not program.is_settled:
            program.solve(held_off, seconds)
        curves = program.solve(held_off, seconds) if program.is_settled else None
        if curves is None:
            return None
        rooms = program.rooms()
        strays = [curve.strays(room) for curve, room in zip(curves, rooms, strict=True)]
        if not any(stray.any() for stray in strays):
            return [
                curve.build(part.motion, room)
                for part, curve, room in zip(parts, curves, rooms, strict=True)
            ]
        for part, off, stray in zip(parts, held_off, strays, strict=True):
            if number >= _ROUNDS // 2:  # so far it cannot stray, however it is pushed
                stray = np.maximum(stray, part.most(peak) * program.ahead**2 / 12 - off)
            off += 1.5 * np.maximum(stray, np.roll(stray, 1))
    return None


def _cells(sides: Sequence[tuple[Side, Side]], found: Outline) -> Cells:
    """Return for each rule and cell of an outline the options that it leaves."""
    if found.places is None or found.chosen is None:
        return []
    middles = (found.angle_deg[1:] + found.angle_deg[:-1]) / 2
    places = list(zip(*(place.tolist() for place in found.places), strict=True))
    return [
        [
            cell_options(both, float(middle), ends, beside)
            for middle, ends, beside in zip(
                middles, pairwise(of_rule), pairwise(places), strict=True
            )
        ]
        for both, of_rule in zip(sides, found.chosen, strict=True)
    ]


class _OnGrid:
    """The motions on a grid that take one of the options left to each cell.

    Once solved, `cells` are settled.
    """

    def __init__(self, parts: Sequence[Part], angle_deg: Floats, cells: Cells, peak: float) -> None:
        self.parts, self.angle_deg, self.cells, self.peak = parts, angle_deg, cells, peak
        self.ahead = cells_of(angle_deg)
        self.standing = [part.standing(self.angle_deg) for part in self.parts]

    @property
    def is_settled(self) -> bool:
        """Whether each cell has one option."""
        return all(len(options) <= 1 for of_rule in self.cells for options in of_rule)

    def rooms(self) -> list[Corridor]:
        """Return the room of each part, where it is settled."""
        rooms = []
        for part, place in zip(self.parts, self.standing, strict=True):
            still = ~np.isnan(place)
            low, high = (np.where(still, place, end) for end in part.travel_mm)
            rooms.append(Corridor(self.angle_deg, low, high, still, part.motion.pitch_mm))
        for option, nodes in self._asked():
            if len(option) == 1 and option[0].part is not None:
                room = rooms[option[0].part]
                for node, turns in nodes:
                    least, most = option[0].moved(-turns * room.pitch_mm).interval
                    if not room.still[node]:
                        room.low_mm[node] = max(room.low_mm[node], least)
                        room.high_mm[node] = min(room.high_mm[node], most)
        return rooms

    def _asked(self) -> Iterator[tuple[tuple[Option, ...], list[tuple[int, int]]]]:
        """Yield the options of each rule and cell, and its nodes, each with its turn."""
        count = len(self.angle_deg)
        for of_rule in self.cells:
            for cell, options in enumerate(of_rule):
                yield options, [(cell, 0), ((cell + 1) % count, (cell + 1) // count)]

    def solve(self, held_off: Sequence[Floats], seconds: float) -> list[GridMotion] | None:
        """Return the motions with the least peak, held off their limits, and settle the cells."""
        rows, count = Rows(), len(self.angle_deg)
        share = rows.unknown(0.0, 1.0, cost=1.0)
        curves = [
            self._moving(rows, part, room, off, share)
            for part, room, off in zip(self.parts, self.rooms(), held_off, strict=True)
        ]
        picks = [
            self._pick(rows, options, nodes, [position for position, _, _ in curves])
            for options, nodes in self._asked()
        ]
        x = rows.solve(seconds).unknowns
        if x is None:
            return None
        flat = [
            (options[int(np.argmax(x[pick]))],) if pick else options
            for (options, _), pick in zip(self._asked(), picks, strict=True)
        ]
        self.cells = [flat[first : first + count] for first in range(0, len(flat), count)]
        return [
            GridMotion(self.ahead / _PART_DEG, x[position], x[velocity], x[push], x[push])
            for position, velocity, push in curves
        ]

    def _moving(
        self, rows: Rows, part: Part, room: Corridor, held_off: Floats, share: int
    ) -> tuple[list[int], list[int], list[int]]:
        """Add a part's positions, velocities and accelerations, each bound to those before."""
        count, slack = len(self.angle_deg), held_off + KEPT_MM
        reach = part.reach(self.angle_deg, part.most(self.peak))
        low, high = np.maximum(room.low_mm, reach[0]), np.minimum(room.high_mm, reach[1])
        off = np.where(room.inner, np.minimum(slack, np.maximum(high - low, 0) / 4), 0.0)
        rest = np.where(room.still, 0.0, np.inf)
        no_force = np.where(room.still_cells, 0.0, np.inf)
        position = rows.unknowns(np.minimum(low + off, high), high - off)
        velocity = rows.unknowns(-rest, rest)
        push = rows.unknowns(-no_force, no_force)
        most, is_settled = part.most(self.peak), self.is_settled
        own = rows.unknown(0.0, 1.0, cost=is_settled * _OTHERS)
        change = rows.unknowns(np.zeros(count), np.full(count, np.inf), cost=is_settled * STEADY)
        if part.weight:
            rows.row([(own, most * part.weight / self.peak), (share, -1.0)], -np.inf, 0.0)
        for cell, h in enumerate(map(float, self.ahead / _PART_DEG)):
            on = (cell + 1) % count
            way = room.pitch_mm if on == 0 else 0.0
            y, v, a = position[cell], velocity[cell], push[cell]
            rows.row([(position[on], 1), (y, -1), (v, -h), (a, -h * h / 2)], -way, -way)
            rows.row([(velocity[on], 1.0), (v, -1.0), (a, -h)], 0.0, 0.0)
            rows.within([(a, 1.0)], own, most * _PART_DEG**2)
            if is_settled:
                rows.within([(push[on], 1.0), (a, -1.0)], change[cell], most * _PART_DEG**2)
        return position, velocity, push

    def _pick(
        self,
        rows: Rows,
        options: tuple[Option, ...],
        nodes: list[tuple[int, int]],
        positions: Sequence[list[int]],
    ) -> list[int]:
        """Let a rule take one of its options over a cell."""
        if len(options) <= 1:
            return []
        pick = rows.unknowns(np.zeros(len(options)), np.ones(len(options)), whole=True)
        rows.row([(one, 1.0) for one in pick], 1.0, np.inf)
        for one, option in zip(pick, options, strict=True):
            part = option.part
            if part is None:
                continue
            for node, turns in nodes:
                low, high = option.moved(-turns * self.parts[part].motion.pitch_mm).interval
                column = positions[part][node]
                least, most = rows.low[column], rows.high[column]
                place = (column, 1.0)
                if low > least:
                    rows.row([place, (one, least - low)], least, np.inf)
                if high < most:
                    rows.row([place, (one, most - high)], -np.inf, most)
        return pick
