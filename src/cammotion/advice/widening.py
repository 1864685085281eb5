"""How wide the moves of one mechanism can be beside all others, and what stops them there."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial

from cammotion.limits.frame import hands_over
from cammotion.limits.widest import widest_move
from cammotion.machine.arcs import Arc, arcs, complement, intersect
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, arcs_of, with_dwells
from cammotion.own import Machine
from cammotion.quantities import InputError
from cammotion.rules.checks import find_violations
from cammotion.rules.rule import Rule
from cammotion.whole.optimise import optimise

_SECONDS = 5.0  # for all moves of one mechanism
_HARDEST = 3  # mechanisms whose rise and return are asked each for itself, which takes longer
_SHARES = (0.5, 0.5, 0.5, 1)  # of its room that an end may take at a time, and leave to others
_HALVINGS = 20  # of that, until it is known where it stops
_HAIR_DEG, _HAIR = 0.1, 0.01  # by which an end is moved to see what stops it; of its move at most
_RISE_AND_RETURN = 2
_STILL_ARC = "its still arc"

Place = tuple[int, int]  # of an end: the number of its move, and 0 for its beginning, 1 for its end


def wider(machine: Machine, name: str, rules: Sequence[Rule]) -> TimingDiagram | None:
    """Return the diagram with the gentlest moves found of a mechanism by their angles alone.

    Of those that break fewest rules it is the one with the smallest peak.
    """
    found = [
        diagram
        for diagram in _found(machine, name, rules)
        if _stands(diagram[name], machine.still.get(name, ()))
    ]
    if not found:
        return None

    def merit(diagram: TimingDiagram) -> tuple[int, float]:
        return len(_broken(diagram, rules)), diagram.peak_acceleration(name)

    return min(found, key=merit)


def stops(
    machine: Machine, changed: TimingDiagram, name: str, rules: Sequence[Rule]
) -> Iterator[str]:
    """Yield what stops the moves of a changed mechanism from being wider, the hardest move first.

    Each end of a move is put out by a hair, to see what that breaks; not so the ends at work.
    """
    motion, still = changed[name], machine.still.get(name, ())
    broken = _broken(changed, rules)
    for place in _ends(motion, still if len(motion.moves) > _RISE_AND_RETURN else ()):
        put_out = _by_a_hair(motion, place)
        if not _stands(put_out, still):
            yield _STILL_ARC
        else:
            now = _broken(changed.with_motion(put_out), rules) - broken
            yield from (str(rule) for rule in rules if rule in now)


def _by_a_hair(motion: Motion, place: Place) -> Motion:
    """Return the motion with an end of a move a little further out, if need be into the next."""
    (number, end), count = place, len(motion.moves)
    hair = min(_HAIR_DEG, _HAIR * min(move.angle_deg for move in motion.moves))
    if _room(motion, place) < hair:
        if count == 1:
            return motion
        beside = (number + (1 if end else -1)) % count, 1 - end
        motion = _put_out(motion, beside, -hair)
    return _put_out(motion, place, hair)


def _found(machine: Machine, name: str, rules: Sequence[Rule]) -> Iterator[TimingDiagram]:
    """Yield diagrams with wider moves of a motion: about what stays of it, and within still arcs.

    A part that has to stand less long than it does now may also stand elsewhere.
    """
    about = _about(machine, name, rules)
    if about:
        yield about
    motion, still = machine.diagram[name], machine.still.get(name, ())
    if still and not (about and _stands(about[name], still) and _is_held(motion, still)):
        try:
            yield optimise(machine.diagram, rules, still={name: still}, seconds=_SECONDS).design
        except InputError:  # no moves of it keep the rules, or one of them is of another kind
            for start in (motion, *([about[name]] if about else ())):
                yield from _put_out_all(machine, start, rules)


def _about(machine: Machine, name: str, rules: Sequence[Rule]) -> TimingDiagram | None:
    """Return the diagram with the widest move about what stays of a motion.

    Rise and return of the three hardest get two angles. Where that is no gain, it is the other way
    round; a distance rule, for one, allows one angle.
    """
    is_hard = name in [*machine.peaks][:_HARDEST]
    found = None
    for each_way in (None, False) if is_hard else (False, None):
        with suppress(InputError):  # not of this build, or no move of it keeps the rules
            widest = widest_move(machine.diagram, name, rules, each_way=each_way)
            found = found or widest.diagram
            if widest.peak_acceleration < machine.peaks[name]:
                return widest.diagram
    return found


def _is_held(motion: Motion, still: Iterable[Arc]) -> bool:
    """Tell whether a part has to stand wherever `widest_move` lets it stand."""
    work = arcs([(motion.moves[0].to_deg, motion.moves[-1].from_deg)])
    return not motion.is_indexing and not intersect(work, complement(arcs(still)))


def _put_out_all(
    machine: Machine, motion: Motion, rules: Sequence[Rule]
) -> Iterator[TimingDiagram]:
    """Yield the diagram in which each end of the moves is put out as far as it goes.

    No rule breaks that is kept in the machine, and over its still arcs the part stands.
    """
    still = machine.still[motion.name]
    broken = _broken(machine.diagram, rules)

    def keeps(motion: Motion) -> bool:
        changed = machine.diagram.with_motion(motion)
        return _stands(motion, still) and _broken(changed, rules) <= broken

    if not keeps(motion) or hands_over(motion):
        return
    for share in _SHARES:
        for place in _ends(motion, still):
            most = share * _room(motion, place)
            motion = _furthest(partial(_put_out, motion, place), keeps, most)
    yield machine.diagram.with_motion(motion)


def _furthest(
    put_out: Callable[[float], Motion], keeps: Callable[[Motion], bool], most: float
) -> Motion:
    """Return what is put out all the way, or to where it is seen to stop."""
    if keeps(furthest := put_out(most)):
        return furthest
    reached = 0.0
    for _ in range(_HALVINGS):
        middle = (reached + most) / 2
        reached, most = (middle, most) if keeps(put_out(middle)) else (reached, middle)
    return put_out(reached)


def _ends(motion: Motion, still: Iterable[Arc]) -> list[Place]:
    """Return the ends of the moves that may be put out, those of the hardest move first.

    Between rise and return a part whose still arcs are not known is taken to work.
    """
    hardest = sorted(range(len(motion.moves)), key=lambda number: -_push(motion.moves[number]))
    places = [(number, end) for number in hardest for end in (0, 1)]
    last = len(motion.moves) - 1
    works = () if still or motion.is_indexing else ((0, 1), (last, 0))
    return [place for place in places if place not in works]


def _push(move: Segment) -> float:
    return move.curve.derived(2).largest


def _room(motion: Motion, place: Place) -> float:
    """Return how far an end of a move can be put out, in deg, until the next one begins or ends."""
    (number, end), moves = place, motion.moves
    begins = [*(move.from_deg for move in moves), moves[0].from_deg + DEG_PER_TURN]
    ends = [moves[-1].to_deg - DEG_PER_TURN, *(move.to_deg for move in moves)]
    return max(begins[number + end] - ends[number + end], 0.0)  # rounding may make them overlap


def _put_out(motion: Motion, place: Place, by_deg: float) -> Motion:
    """Return the motion with an end of a move that much further out."""
    (number, end), moves = place, [*motion.moves]
    move = moves[number]
    moves[number] = (
        replace(move, to_deg=move.to_deg + by_deg)
        if end
        else replace(move, from_deg=move.from_deg - by_deg)
    )
    return replace(motion, segments=tuple(with_dwells(moves)))


def _stands(motion: Motion, still: Iterable[Arc]) -> bool:
    """Tell whether a motion stands over its still arcs."""
    return not intersect(arcs_of(motion.moves), arcs(still))


def _broken(diagram: TimingDiagram, rules: Sequence[Rule]) -> set[Rule]:
    return {violation.rule for violation in find_violations(diagram, rules)} if rules else set()
