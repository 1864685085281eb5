"""Where moves meet a limit, wherever they are in the turn and whatever their angles are.

A move with a law meets a limit at a fixed share of its indexing angle. So the arcs over which a
condition holds begin and end at angles that are sums of starts and angles of moves, each times a
number. This is what lets all starts and angles be found by a program that is linear.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple

from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.arcs import Arc, complement, unwrap
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import InputError
from cammotion.rules.conditions import Condition

_ROUNDING_DEG = 1e-7


class End(NamedTuple):
    """The angle at which a move is at a share of its way in time: one for each law it may have.

    `turns` are added to it. With no move it is the angle `fixed_deg`.
    """

    move: int | None
    shares: tuple[float, ...] = ()
    turns: int = 0
    fixed_deg: float = 0.0


Span = tuple[End, End]


def fixed_spans(motion: Motion, condition: Condition) -> list[Span]:
    """Return where a motion that stays as it is keeps a condition."""
    return [
        (End(None, fixed_deg=start), End(None, fixed_deg=end))
        for start, end in _arcs(motion, condition)
    ]


def spans(motion: Motion, laws: Sequence[Sequence[MotionLaw]], condition: Condition) -> list[Span]:
    """Return where a motion keeps a condition, whatever the starts and angles of its moves.

    `laws` are those that each move may have. Raises InputError where one of them meets the limit
    another number of times than another.
    """
    tried = []
    for number in range(max(map(len, laws))):
        chosen = [own[min(number, len(own) - 1)] for own in laws]
        one = _with_laws(motion, chosen)
        ends = [
            (_end(one, start, is_start=True), _end(one, end, is_start=False))
            for start, end in _arcs(one, condition)
        ]
        tried.append(sorted(map(_first_turn, ends), key=lambda span: span[0].move or 0))
    shapes = {tuple((e.move, e.turns) for span in found for e in span) for found in tried}
    if len(shapes) > 1:
        raise InputError(
            f"The laws for the {motion.name} do not all meet its limit of {condition.limit_mm:g} "
            "mm as often: give laws of one kind, all of them monotone."
        )
    return [
        (_joined([found[n][0] for found in tried]), _joined([found[n][1] for found in tried]))
        for n in range(len(tried[0]))
    ]


def _arcs(motion: Motion, condition: Condition) -> list[Arc]:
    beyond = motion.where_beyond(condition.limit_mm)
    return unwrap(beyond if condition.is_beyond else complement(beyond))


def _with_laws(motion: Motion, laws: Sequence[MotionLaw]) -> Motion:
    left = iter(laws)
    segments = (s if s.is_dwell else replace(s, law=next(left)) for s in motion.segments)
    return replace(motion, segments=tuple(segments))


def _end(motion: Motion, angle_deg: float, *, is_start: bool) -> End:
    """Return an end of an arc as a place within a move: in the one that begins at its start."""
    for number, move in enumerate(motion.moves):
        turns = (angle_deg - move.from_deg + _ROUNDING_DEG) // DEG_PER_TURN
        since = angle_deg - move.from_deg - turns * DEG_PER_TURN
        share = min(max(since / move.angle_deg, 0.0), 1.0)
        inside = since <= move.angle_deg + _ROUNDING_DEG
        at_wrong_end = since > move.angle_deg - _ROUNDING_DEG if is_start else since < _ROUNDING_DEG
        if inside and not at_wrong_end:
            return End(number, (share,), int(turns))
    return End(None, fixed_deg=angle_deg)


def _first_turn(span: Span) -> Span:
    """Return a span that begins in the first turn: a turn more or less is the same."""
    start, end = span
    return start._replace(turns=0), end._replace(turns=end.turns - start.turns)


def _joined(ends: Sequence[End]) -> End:
    return ends[0]._replace(shares=tuple(share for end in ends for share in end.shares))
