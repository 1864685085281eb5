"""The best moves of all parts, one peak after the other: the largest first, then what is left."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from cammotion.laws.catalogue import as_law
from cammotion.quantities import Floats
from cammotion.whole.asked_of_all import Task
from cammotion.whole.free_moves import Apart, Mover, Placed
from cammotion.whole.move_program import MoveProgram

_HELD = 1e-8  # of what is held
_SAME = 1e-6  # what differs by less of it, is one
_AS_GIVEN_DEG = 1e-4  # so near to the moves of today are those that are taken for them


class Found(NamedTuple):
    """The moves of all parts, None if none were found, and the peak in mm/deg2 that none are below.

    If they are `touching`, arcs meet to the last digit, and rounding may have let them overlap.
    """

    moves: list[list[Placed]] | None
    bound: float
    touching: bool = False


def place(movers: Sequence[Mover], apart: Sequence[Apart], seconds: float) -> Found:
    """Return the best moves of all parts.

    The largest peak is as small as can be; with its part held that of the next one, and so on.
    Raises InputError where the time was too short to tell.
    """
    program = MoveProgram(movers, apart)
    program.rows.cost[program.least] = -1.0
    found = program.solved(seconds)
    bound = _peak_of(found.bound)
    if found.unknowns is None:
        return Found(None, bound)
    x = program.settle(found.unknowns)
    touching = x is None
    if x is None:
        x = program.touching()
    if x is None:
        return Found(None, bound)
    return Found(program.moves(widened(program, program.of_part, x)), bound, touching)


def _peak_of(bound: float | None) -> float:
    """Return the peak of the moves that the objective, how wide they are, is not below."""
    if not bound:  # none is known, or no peak counts
        return 0.0
    return np.inf if bound > 0 else 1 / bound**2


def place_as_today(
    task: Task, movers: Sequence[Mover], apart: Sequence[Apart]
) -> list[list[Placed]] | None:
    """Return the best moves of all parts in the order of today; None where that leaves them none.

    `place` finds an order for the largest peak; of those that are as good for it, any.
    """
    program = MoveProgram(movers, apart)
    rows = program.rows
    low, high = rows.low.copy(), rows.high.copy()
    if not hold_today(task, program):
        return None
    found = rows.solve().unknowns
    rows.low, rows.high = low, high
    x = None if found is None else program.settle(found)
    return None if x is None else program.moves(widened(program, program.of_part, x))


def hold_today(task: Task, program: MoveProgram) -> bool:
    """Hold all moves where they are today; return whether their laws are among those allowed."""
    low, high = program.rows.low, program.rows.high
    for part, mover, starts, widths in zip(
        task.parts, program.movers, program.starts, program.widths, strict=True
    ):
        for move, laws, start, width in zip(
            part.motion.moves, mover.laws, starts, widths, strict=True
        ):
            if as_law(move.law) not in laws:
                return False
            taken = width[laws.index(as_law(move.law))]
            for column, value in ((start, move.from_deg), (taken, move.angle_deg)):
                low[column] = max(low[column], value - _AS_GIVEN_DEG)
                high[column] = min(high[column], value + _AS_GIVEN_DEG)
                if low[column] > high[column]:
                    return False
    return True


def widened(program: MoveProgram, parts: Sequence[Sequence[int]], x: Floats) -> Floats:
    """Return the unknowns with the narrowest move of some parts as wide as can be.

    With its part held, so is that of the next one; with all parts held, their other moves. What is
    held stays so in the program.
    """
    x = _filled(program, parts, x)
    return _filled(program, [[own] for part in parts for own in part], x)


def _filled(program: MoveProgram, groups: Sequence[Sequence[int]], x: Floats) -> Floats:
    """Return the unknowns with the narrowest of each group as wide as those before leave it."""
    free = [group for group in groups if group]
    while free:
        owns = [own for group in free for own in group]
        least, x = _raised(program, owns, x)
        for own in owns:
            program.rows.low[own] = max(program.rows.low[own], least * (1 - _HELD))
        enough = least * (1 + _SAME)
        tight = [group for group in free if x[[*group]].min() <= enough]
        alone = [_raised(program, group, x)[0] for group in tight]
        enough = max(enough, min(alone))  # where rounding lets each get wider, it is the least
        held = [group for group, most in zip(tight, alone, strict=True) if most <= enough]
        free = [group for group in free if group not in held]
    return x


def _raised(program: MoveProgram, owns: Sequence[int], before: Floats) -> tuple[float, Floats]:
    """Return how wide some moves can be together, and the unknowns then.

    It is the least of these, to the last digit: what the solver says may be more by its rounding,
    and held by that, all else would seem to be stuck.
    """
    rows = program.rows.copied()
    rows.cost = [0.0] * len(rows.cost)
    together = rows.unknown(0.0, np.inf, cost=-1.0)
    for own in owns:
        rows.row([(own, 1.0), (together, -1.0)], 0.0, np.inf)
    found = rows.solve().unknowns
    x = before if found is None else found[:together]
    return float(x[[*owns]].min()), x
