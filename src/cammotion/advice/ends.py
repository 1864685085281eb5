"""The ends of the moves of a motion, each of which can be put out into the dwell beside it."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace

from cammotion.advice.worse import SAME_DEG
from cammotion.limits.frame import is_usual
from cammotion.machine.arcs import Arc, arcs, complement, intersect
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, arcs_of, with_dwells

_LEAST_DEG = 1e-3  # by which an end is put out, if it is
_HALVINGS = 20  # of that, until it is known where it stops
_HAIR_DEG, _HAIR = 0.1, 0.01  # by which an end is moved to see what stops it; of its move at most

Place = tuple[int, int]
"""Of an end: the number of its move, and 0 for its beginning, 1 for its end."""


def by_a_hair(motion: Motion, place: Place) -> Motion:
    """Return the motion with an end of a move a little further out, if need be into the next."""
    (number, end), count = place, len(motion.moves)
    hair = min(_HAIR_DEG, _HAIR * min(move.angle_deg for move in motion.moves))
    if room(motion, place) < hair:
        if count == 1:
            return motion
        beside = (number + (1 if end else -1)) % count, 1 - end
        motion = put_out(motion, beside, -hair)
    return put_out(motion, place, hair)


def furthest(
    motion: Motion, place: Place, most_deg: float, keeps: Callable[[Motion], bool]
) -> Motion:
    """Return the motion with an end put out all the way, or to where it stops, be it at once."""
    if keeps(whole := put_out(motion, place, most_deg)):
        return whole
    if not keeps(put_out(motion, place, min(most_deg / 2, _LEAST_DEG))):
        return motion
    reached, most = 0.0, most_deg
    for _ in range(_HALVINGS):
        middle = (reached + most) / 2
        kept = keeps(put_out(motion, place, middle))
        reached, most = (middle, most) if kept else (reached, middle)
    return put_out(motion, place, reached)


def ends(motion: Motion, fixed: Iterable[Place]) -> list[Place]:
    """Return the ends of the moves but for the fixed ones, those of the hardest move first.

    Of moves that are as hard the one that begins first comes first, in whatever order they are.
    """
    pushes = [float(f"{_push(move):.4g}") for move in motion.moves]
    starts = [move.from_deg % DEG_PER_TURN for move in motion.moves]
    hardest = sorted(range(len(pushes)), key=lambda number: (-pushes[number], starts[number]))
    places = [(number, end) for number in hardest for end in (0, 1)]
    return [place for place in places if place not in fixed]


def works(motion: Motion) -> tuple[Place, ...]:
    """Return the ends at work of a part whose still arcs are not known: between rise and return."""
    return () if motion.is_indexing else ((0, 1), (len(motion.moves) - 1, 0))


def at_work(motion: Motion, still: Sequence[Arc]) -> tuple[Place, ...]:
    """Return the ends of the dwell over which a part with one more dwell has to stand all along."""
    if not still:
        return works(motion)
    if motion.is_indexing or not is_usual(motion):
        return ()
    first, last = motion.moves
    dwells = {
        ((0, 1), (1, 0)): (first.to_deg, last.from_deg),
        ((1, 1), (0, 0)): (last.to_deg, first.from_deg + DEG_PER_TURN),
    }
    held = [both for both, arc in dwells.items() if is_still(arc, still)]
    return held[0] if len(held) == 1 else ()


def is_still(dwell: Arc, still: Iterable[Arc]) -> bool:
    """Tell whether a part has to stand all along a dwell."""
    over, free = arcs([dwell]), complement(arcs(still))
    return bool(over) and sum(end - start for start, end in intersect(over, free)) < SAME_DEG


def _push(move: Segment) -> float:
    return move.curve.derived(2).largest


def room(motion: Motion, place: Place) -> float:
    """Return how far an end of a move can be put out, in deg, until the next one begins or ends."""
    (number, end), moves = place, motion.moves
    nexts = [*(move.from_deg for move in moves), moves[0].from_deg + DEG_PER_TURN]
    lasts = [moves[-1].to_deg - DEG_PER_TURN, *(move.to_deg for move in moves)]
    return max(nexts[number + end] - lasts[number + end], 0.0)  # rounding may make them overlap


def put_out(motion: Motion, place: Place, by_deg: float) -> Motion:
    """Return the motion with an end of a move that much further out."""
    (number, end), moves = place, [*motion.moves]
    move = moves[number]
    moves[number] = (
        replace(move, to_deg=move.to_deg + by_deg)
        if end
        else replace(move, from_deg=move.from_deg - by_deg)
    )
    return replace(motion, segments=tuple(with_dwells(moves)))


def stands(motion: Motion, still: Iterable[Arc]) -> bool:
    """Tell whether a motion stands over its still arcs."""
    return not intersect(arcs_of(motion.moves), arcs(still))
