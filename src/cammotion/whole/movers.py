"""The moves of the parts for the program that places them, and the motions of what it found."""

import math
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, with_dwells
from cammotion.quantities import InputError
from cammotion.rules.conditions import Condition
from cammotion.whole.asked_of_all import Task, faults_of
from cammotion.whole.asked_of_moves import read_angles, read_laws, read_starts
from cammotion.whole.crossings import Span, fixed_spans, spans
from cammotion.whole.free_moves import Apart, Begin, Mover, Placed
from cammotion.whole.parts import Part

_ROUNDING_DEG = 1e-6  # so near to where a part has to stand a move ends there


def read_moves(task: Task, laws: Any, ranges: tuple[Any, Any]) -> tuple[list[Mover], list[Apart]]:
    """Return the moves of all parts, and the arcs that may not overlap.

    `ranges` are those of the starts and of the indexing angles, as a user gives them.
    """
    chosen = read_laws(task, laws)
    starts, angles = read_starts(task, ranges[0]), read_angles(task, ranges[1])
    movers = [
        _mover(part, own, starts[part.motion.name], angles[part.motion.name])
        for part, own in zip(task.parts, chosen, strict=True)
    ]
    return movers, list(_apart(task, chosen))


def today(task: Task, movers: Sequence[Mover]) -> TimingDiagram | None:
    """Return the diagram as it is; None if its moves are not allowed or do not keep all."""
    allowed = all(map(_allows, movers, (part.motion for part in task.parts)))
    return task.diagram if allowed and not [*faults_of(task, task.diagram)] else None


def _allows(mover: Mover, motion: Motion) -> bool:
    """Whether the moves of a motion have laws, angles and starts that are allowed."""
    for number, move in enumerate(motion.moves):
        (low, high), begin = mover.angles[number], mover.begins[number]
        if as_law(move.law) not in mover.laws[number]:
            return False
        if not low - _ROUNDING_DEG <= move.angle_deg <= high + _ROUNDING_DEG:
            return False
        if begin:
            first, last = begin.range_deg
            late = (move.from_deg - first + _ROUNDING_DEG) % DEG_PER_TURN
            if late > last - first + 2 * _ROUNDING_DEG:
                return False
    return True


def built(task: Task, placed: Sequence[Sequence[Placed]]) -> TimingDiagram:
    """Return the diagram in which the moves of all parts are where they were found."""
    design = task.diagram
    for part, moves in zip(task.parts, placed, strict=True):
        if moves:
            design = design.with_motion(_built(part, moves))
    return design


def _mover(
    part: Part,
    laws: list[list[MotionLaw]],
    starts: list[tuple[float, float] | None],
    angles: list[tuple[float, float] | None],
) -> Mover:
    """Return the ranges of a part's moves: those given, within what its still arcs leave."""
    low, high, ends = _windows(part)
    turns = [
        given and _turns(given, low[number], min(high[number], ends[number]))
        for number, given in enumerate(starts)
    ]
    if any(both and both[0] > both[1] for both in turns):
        raise InputError(
            f"The start of a move of the {part.motion.name} would lie in a still arc, or beyond "
            "one: give a range in which its still arcs let that move begin."
        )
    strokes = [abs(move.change_mm) for move in part.motion.moves]
    return Mover(
        tuple(map(tuple, laws)),
        tuple(
            tuple(part.weight * law.Ca * stroke for law in own)
            for own, stroke in zip(laws, strokes, strict=True)
        ),
        tuple(
            tuple((law.Ca * stroke / part.cap) ** 0.5 for law in own)
            for own, stroke in zip(laws, strokes, strict=True)
        ),
        tuple(zip(low, high, strict=True)),
        tuple(
            Begin(given, both) if given and both else None
            for given, both in zip(starts, turns, strict=True)
        ),
        tuple(given or (0.0, float(DEG_PER_TURN)) for given in angles),
        tuple(ends),
    )


def _windows(part: Part) -> tuple[list[float], list[float], list[float]]:
    """Return from where and up to where each move may begin, and by where it has to have ended."""
    moves = part.motion.moves
    low = [move.from_deg - DEG_PER_TURN for move in moves]
    high = [move.from_deg + DEG_PER_TURN for move in moves]
    ends = [move.to_deg + DEG_PER_TURN for move in moves]
    for number, move in enumerate(moves):
        on = (number + 1) % len(moves)
        turn = 0.0 if on else float(DEG_PER_TURN)
        for start, end in part.still:
            turned = -((start - move.to_deg + _ROUNDING_DEG) // DEG_PER_TURN) * DEG_PER_TURN
            if end + turned <= moves[on].from_deg + turn + _ROUNDING_DEG:
                ends[number] = min(ends[number], start + turned)
                low[on] = max(low[on], end + turned - turn)
    for number in [*range(len(moves))] * 2:  # none begins before the one before, nor ends after
        low[number] = max(low[number], low[number - 1] - (0.0 if number else float(DEG_PER_TURN)))
    for number in [*range(len(moves))[::-1]] * 2:
        on = (number + 1) % len(moves)
        ends[number] = min(ends[number], ends[on] + (0.0 if on else float(DEG_PER_TURN)))
    return low, high, ends


def _turns(given: tuple[float, float], low: float, high: float) -> tuple[int, int]:
    """Return the first and the last turn in which a range of starts reaches into a window."""
    return (
        math.ceil((low - given[1] - _ROUNDING_DEG) / DEG_PER_TURN),
        math.floor((high - given[0] + _ROUNDING_DEG) / DEG_PER_TURN),
    )


def _apart(task: Task, laws: Sequence[list[list[MotionLaw]]]) -> Iterator[Apart]:
    """Yield all arcs that may not overlap: where a half holds, and where the other does not."""
    names = [part.motion.name for part in task.parts]

    def held(condition: Condition) -> list[Span]:
        motion = task.diagram[condition.motion]
        if condition.motion in names and motion.moves:
            part = names.index(condition.motion)
            return spans(part, motion, laws[part], condition)
        return fixed_spans(motion, condition)

    for rule in task.rules:
        these, those = held(rule.when), held(rule.only_while.opposite)
        yield from (Apart(*pair) for pair in product(these, those))


def _built(part: Part, placed: Sequence[Placed]) -> Motion:
    """Return the motion with its moves where they were found, beside its still arcs exactly."""
    known = [end for arc in part.still for end in arc]
    ends = [
        (_snap(one.start_deg, known), _snap(one.start_deg + one.angle_deg, known)) for one in placed
    ]
    following = [*(start for start, _ in ends[1:]), ends[0][0] + DEG_PER_TURN]
    moves = [
        Segment(
            from_deg=start,
            to_deg=on if abs(on - end) < _ROUNDING_DEG else end,
            from_mm=move.from_mm,
            to_mm=move.to_mm,
            law=one.law,
        )
        for move, one, (start, end), on in zip(
            part.motion.moves, placed, ends, following, strict=True
        )
    ]
    return Motion(part.motion.name, tuple(with_dwells(moves)), part.motion.stops)


def _snap(angle_deg: float, known: Sequence[float]) -> float:
    """Return what an angle is but for rounding: one of those known, in its turn."""
    for one in known:
        turned = one + round((angle_deg - one) / DEG_PER_TURN) * DEG_PER_TURN
        if abs(turned - angle_deg) < _ROUNDING_DEG:
            return turned
    return angle_deg
