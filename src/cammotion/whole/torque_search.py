"""The starts, angles and laws of all moves with the least torque on the camshaft, from many starts.

The torques of several masses add up, and one that slows down pays for one that speeds up. So the
largest torque has many low places, and that the lowest of those found is the lowest of all, nothing
proves. All else is as with the least peak: once it is settled which arc comes first, all rules are
linear in starts and angles, and SciPy's SLSQP goes down within them, so that no step breaks a rule.
"""

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from time import monotonic
from typing import Any, NamedTuple

import numpy as np

from cammotion.drive.camshaft import Camshaft
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import Floats
from cammotion.whole.asked_of_all import Task
from cammotion.whole.free_moves import Apart, Mover
from cammotion.whole.inside import inside
from cammotion.whole.move_program import MoveProgram
from cammotion.whole.movers import built, today
from cammotion.whole.shaft_torque import Push, ShaftTorque, push
from cammotion.whole.wide_moves import hold_today, widened

_STARTS = 16
_LEAST_PEAK, _TODAY = 0, 1  # the first starts
_COARSE, _FINE = 16, 120  # samples of each move, at first and in the end
_SEARCHED = 0.75  # of the time; the rest is for polishing
_POLISHED = 3  # starts that are polished
_ROUNDS, _LAST = 40, 1e-7
_PART_DEG = 10.0  # in such parts of a turn all numbers are of one size
_FARTHEST = 0.6  # of the way to a corner of what is allowed, at which some angle is none
_EARLY = 0.03  # what a start that is a degree earlier counts, if a move of that many is one wide
_OFF_DEG = 1e-6  # by which a row may be missed
_NOTHING = 1e-9  # of what a mechanism asks by itself
_DIGITS = 7  # of a torque; what differs by less is rounding


class _Low(NamedTuple):
    """A low place that was found: its program, the unknowns there, and the torque in N m."""

    program: MoveProgram
    x: Floats
    torque: float


def peak_torque(shaft: Camshaft, design: TimingDiagram) -> float:
    """Return the largest torque in N m, in either direction, that a diagram asks of a shaft."""
    return abs(replace(shaft, diagram=design).peak_torque().value)


def least_torque(
    shaft: Camshaft, task: Task, movers: Sequence[Mover], apart: Sequence[Apart], seconds: float
) -> tuple[TimingDiagram, tuple[float, ...]] | None:
    """Return the best diagram found, and the torque in N m that was reached from each start.

    None if no moves keep all rules. No answer is worse than the machine of today, if that is
    allowed, or than the first start, which has the least peak: these two are looked at however
    short the time is. All else ends with it, but for the step that is being made.
    """
    search, now = _Search(shaft, task, movers), today(task, movers)
    end = monotonic() + seconds
    until = end - (1 - _SEARCHED) * seconds
    starts, lows = _Starts(task, movers, apart, is_kept=now is not None), dict[int, _Low]()
    found: list[tuple[float, TimingDiagram]] = []
    tried: dict[int, float] = {}  # the least from each start

    def offer(design: TimingDiagram, number: int) -> float:
        found.append((peak_torque(shaft, design), design))
        tried[number] = min(tried.get(number, np.inf), found[-1][0])
        return found[-1][0]

    for number in range(_STARTS):
        if number > _TODAY and (monotonic() > until or not lows):
            break
        best = min(lows.values(), key=lambda low: low.torque, default=None)
        start = starts.find(number, best, until - monotonic())
        if number == _TODAY and now:
            offer(now, number)
        if start is None:
            continue
        if number == _LEAST_PEAK:
            offer(built(task, start.program.moves(start.x)), number)
        low = search.lowered(start, _COARSE, until)
        lows[number] = low._replace(torque=offer(built(task, low.program.moves(low.x)), number))
    lowest = sorted(lows, key=lambda number: lows[number].torque)[:_POLISHED]
    for number in lowest:
        if number == lowest[0] or monotonic() < end:
            fine = search.lowered(lows[number], _FINE, end)
            offer(built(task, fine.program.moves(search.eased(fine))), number)
    if not found:
        return None
    least = min(found[::-1], key=lambda each: float(f"{each[0]:.{_DIGITS}g}"))  # the last are eased
    return least[1], tuple(sorted(max(torque, least[0]) for torque in tried.values()))


class _EndedError(Exception):
    """The time is over; SciPy 1.16 knows of no other way to end a search early."""


class _Search:
    """The way down from a start; what the moves ask of the shaft is computed once."""

    def __init__(self, shaft: Camshaft, task: Task, movers: Sequence[Mover]) -> None:
        self.shaft, self.task, self.movers = shaft, task, movers
        self._pushes: dict[tuple[Any, ...], Push] = {}

    def lowered(self, start: _Low, samples: int, end: float) -> _Low:
        """Return the low place below a start, or what is reached when the clock says `end`.

        It is the same if no lower one was found.
        """
        from scipy.optimize import minimize

        program, x = start.program, start.x
        within = inside(program, x)
        torque = self._torque(program, x, samples)
        first = x[within.columns]
        most = float(np.abs(torque.at_samples(first.reshape(-1, 2))).max(initial=0.0))
        if most <= _NOTHING * torque.size:
            return _Low(program, x, most)

        def room(z: Floats) -> Floats:
            asked = torque.at_samples(_PART_DEG * z[:-1].reshape(-1, 2)) / most
            return np.concatenate([z[-1] - asked, z[-1] + asked])

        begin = seen = np.append(first / _PART_DEG, 1.0)

        def watch(z: Floats) -> None:
            nonlocal seen
            seen = np.array(z)
            if monotonic() > end:
                raise _EndedError

        last = np.eye(1, len(first) + 1, len(first))[0]
        with suppress(_EndedError):
            seen = minimize(
                lambda z: z[-1],
                begin,
                jac=lambda _: last,
                method="SLSQP",
                bounds=[
                    *zip(*(ends / _PART_DEG for ends in within.ends), strict=True),
                    (0.0, None),
                ],
                constraints=[{"type": "ineq", "fun": room}, *within.linear(_PART_DEG)],
                callback=watch,
                options={"maxiter": _ROUNDS, "ftol": _LAST},
            ).x
        z = np.clip(_PART_DEG * seen[:-1], *within.ends)
        reached = float(np.abs(torque.at_samples(z.reshape(-1, 2))).max())
        if reached >= most or within.missed(z) > _OFF_DEG:
            return _Low(program, x, most)
        lower = x.copy()
        lower[within.columns] = z
        return _Low(program, lower, reached)

    def eased(self, low: _Low) -> Floats:
        """Return the unknowns with the moves that ask nothing of the shaft as wide as can be."""
        program, rows = low.program, low.program.rows
        loose: list[list[int]] = []
        for part, starts, widths, own in zip(
            self.task.parts, program.starts, program.widths, program.of_part, strict=True
        ):
            if part.motion.name not in self.shaft.loads:
                loose.append(own)
                continue
            for column in [*starts, *(one for width in widths for one in width)]:
                rows.low[column] = max(rows.low[column], low.x[column] - _OFF_DEG)
                rows.high[column] = min(rows.high[column], low.x[column] + _OFF_DEG)
        return widened(program, loose, low.x) if loose else low.x

    def _torque(self, program: MoveProgram, x: Floats, samples: int) -> ShaftTorque:
        pushes: list[Push | None] = []
        for part, moves in zip(self.task.parts, program.moves(x), strict=True):
            name = part.motion.name
            for number, (move, placed) in enumerate(zip(part.motion.moves, moves, strict=True)):
                key = name, number, id(placed.law), samples
                if name in self.shaft.loads and key not in self._pushes:
                    self._pushes[key] = push(self.shaft, name, move, placed.law, samples)
                pushes.append(self._pushes.get(key))
        free = [part.motion.name for part in self.task.parts]
        return ShaftTorque(self.shaft, pushes, free, samples)


class _Starts:
    """Programs with unknowns that keep all rules, from which to go down."""

    def __init__(
        self, task: Task, movers: Sequence[Mover], apart: Sequence[Apart], *, is_kept: bool
    ) -> None:
        self.task, self.movers, self.apart, self.is_kept = task, movers, apart, is_kept
        self.rng = np.random.default_rng(0)
        self.counts = [len(laws) for mover in movers for laws in mover.laws]

    def find(self, number: int, best: _Low | None, seconds: float) -> _Low | None:
        """Return the start of a number; None where nothing keeps the rules.

        Those at random are between two of one order: one at random, and the one with the least
        peak, so that no move is hardly there. Raises InputError where the time was too short to
        tell whether there is the first, unless today's diagram tells it.
        """
        program = MoveProgram(self.movers, self.apart)
        rows = program.rows
        is_at_random = number not in (_LEAST_PEAK, _TODAY)
        if number == _LEAST_PEAK:
            rows.cost[program.least] = -1.0
        if is_at_random:
            self._choose(program, self._laws(number, best))
            _wish(program, self.rng)
        low, high = rows.low.copy(), rows.high.copy()
        if number == _TODAY and not hold_today(self.task, program):
            return None
        is_asked = number == _LEAST_PEAK and not self.is_kept
        solve = program.solved if is_asked else rows.solve
        x = solve(seconds).unknowns
        rows.low, rows.high = low, high
        settled = None if x is None else program.settle(x)
        if x is None or settled is None:
            return None
        if number == _TODAY:
            return _Low(program, x, np.inf)
        widest = widened(program, program.of_part, settled)
        for own in program.own:  # what is held there
            rows.low[own] = 0.0
        share = float(self.rng.uniform(0, _FARTHEST)) if is_at_random else 0.0
        widest += share * (x - widest)
        return _Low(program, widest, np.inf)

    def _laws(self, number: int, best: _Low | None) -> list[int]:
        """Return the law of each move: one for all, any, or those of the best but for one move."""
        alike = number - _TODAY - 1
        if not self.counts or alike < max(self.counts):
            return [alike % count for count in self.counts]
        laws = [int(self.rng.integers(count)) for count in self.counts]
        if best is None or number % 2:
            return laws
        widths = [width for moves in best.program.widths for width in moves]
        changed = self.rng.integers(len(laws))
        return [
            law if move == changed else int(np.argmax(best.x[width]))
            for move, (law, width) in enumerate(zip(laws, widths, strict=True))
        ]

    def _choose(self, program: MoveProgram, laws: Sequence[int]) -> None:
        """Leave each move one law."""
        widths = (width for moves in program.widths for width in moves)
        for law, width in zip(laws, widths, strict=True):
            for number, one in enumerate(width):
                if number != law:
                    program.rows.high[one] = 0.0


def _wish(program: MoveProgram, rng: np.random.Generator) -> None:
    """Ask for moves that are early or late, some of them wider than others, and none narrow."""
    cost, count = program.rows.cost, len(program.own)
    cost[program.least] = -count * float(rng.uniform())
    for own, wish in zip(program.own, rng.uniform(size=count), strict=True):
        cost[own] = -float(wish)
    for start in (one for starts in program.starts for one in starts):
        cost[start] = _EARLY * float(rng.normal())
