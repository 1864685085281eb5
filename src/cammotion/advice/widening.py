"""How wide the moves of one mechanism can be beside all others, and what stops them there."""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cached_property, partial

from cammotion.advice.worse import SAME_DEG, Faults, faults_in, noted, worsened
from cammotion.laws.catalogue import as_law
from cammotion.limits.widest import widest_move
from cammotion.machine.arcs import Arc, arcs, complement, intersect
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, arcs_of, with_dwells
from cammotion.own import Machine
from cammotion.quantities import InputError
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Moving
from cammotion.rules.rule import Rule
from cammotion.whole.optimise import optimise

WORTH = 1e-3
"""Of a peak: less is no gain."""

_SECONDS = 5.0  # for all moves of one mechanism
_HARDEST = 3  # mechanisms whose rise and return are asked each for itself, which takes longer
_SHARES = (0.5, 0.5, 0.5, 1)  # of its room that an end may take at a time, and leave to others
_LEAST_DEG = 1e-3  # by which an end is put out, if it is
_HALVINGS = 20  # of that, until it is known where it stops
_HAIR_DEG, _HAIR = 0.1, 0.01  # by which an end is moved to see what stops it; of its move at most
_STILL_ARC = "its still arc"

Place = tuple[int, int]  # of an end: the number of its move, and 0 for its beginning, 1 for its end


def wider(
    machine: Machine, name: str, rules: Sequence[Rule], failed: list[str]
) -> Iterator[TimingDiagram]:
    """Yield diagrams with other angles of a mechanism's moves, wider ones or such that mend a rule.

    What cannot be told, since a check has failed, is put among the `failed`.
    """
    search = _Search(machine, name, rules, failed)
    yield from (found for found in search.found() if _stands(found[name], search.still))


def is_usual(motion: Motion) -> bool:
    """Tell whether a motion is of the build that can be widened about what stays of it."""
    return len(motion.moves) == (1 if motion.is_indexing else 2)


def stops(
    machine: Machine, changed: TimingDiagram, name: str, rules: Sequence[Rule]
) -> Iterator[str]:
    """Yield what stops the moves of a changed mechanism from being wider, the hardest move first.

    Each end of a move is put out by a hair, to see what that breaks; not so the ends at work.
    """
    motion, still = changed[name], machine.still.get(name, ())
    faults = faults_in(changed, rules)
    for place in _ends(motion, _at_work(motion, still)):
        put_out = _by_a_hair(motion, place)
        if not _stands(put_out, still):
            yield _STILL_ARC
        else:
            there = changed.with_motion(put_out)
            yield from map(str, worsened(faults, there, rules, strict=True))


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


@dataclass(frozen=True)
class _Search:
    """A mechanism whose moves are to be wider: about what stays of it, and within still arcs.

    A part that has to stand less long than it does now may also stand elsewhere.
    """

    machine: Machine
    name: str
    rules: Sequence[Rule]
    failed: list[str]
    refusals: list[str] = field(default_factory=list)

    @cached_property
    def still(self) -> Sequence[Arc]:
        return self.machine.still.get(self.name, ())

    @cached_property
    def motion(self) -> Motion:
        return self.machine.diagram[self.name]

    @cached_property
    def faults(self) -> Faults:
        return faults_in(self.machine.diagram, self.rules)

    def found(self) -> Iterator[TimingDiagram]:
        """Yield all that is found; where that is no gain, also what puts out each end by itself."""
        about, best = self._about(), None
        starts: list[Motion] = []
        if self.still and not (about and self._is_best(about)):
            best = self._best()
            starts = [] if best else [self.motion, *([about[self.name]] if about else ())]
        found = [each for each in (about, best) if each]
        yield from found
        if not starts and self._is_stuck(found):
            starts = [self.motion]
        if starts and self.refusals and not best:
            self.failed.append(
                f"Of the {self.name} each end of a move was put out by itself, which need not be "
                f"the best. {self.refusals[-1]}"
            )
        for start in starts:
            yield from self._put_out_all(start)

    def _is_stuck(self, found: Sequence[TimingDiagram]) -> bool:
        """Tell whether nothing that was found is a gain, though not every move was looked at."""
        before = self.machine.peaks[self.name] * (1 - WORTH)
        standing = (each for each in found if _stands(each[self.name], self.still))
        if any(each.peak_acceleration(self.name) < before for each in standing):
            return False
        is_asked = bool(self.still) or is_usual(self.motion)
        return is_asked and (bool(self.faults) or not found or self.motion.is_indexing)

    def _about(self) -> TimingDiagram | None:
        """Return the diagram with the widest move about what stays of a motion.

        Where no such move keeps all rules, what is broken and cannot be kept is only to get no
        worse.
        """
        if (found := self._widest(self.rules)) or not self.faults:
            return found
        kept = [r for r in self.rules if r not in self.faults or self._widest([r], once=True)]
        found = self._widest(kept) if len(kept) < len(self.rules) else None
        return found if found and not worsened(self.faults, found, self.rules) else None

    def _widest(self, rules: Sequence[Rule], *, once: bool = False) -> TimingDiagram | None:
        """Return the diagram with the widest move beside some rules, None if none keeps them.

        Rise and return of the three hardest get two angles. Where that is no gain, it is the other
        way round; a distance rule, for one, allows one angle. With `once` any move will do.
        """
        is_hard = self.name in [*self.machine.peaks][:_HARDEST]
        found = None
        for each_way in (None, False) if is_hard else (False, None):
            with self._noted("wider", is_last_word=each_way is False):
                widest = widest_move(self.machine.diagram, self.name, rules, each_way=each_way)
                found = found or widest.diagram
                if once or widest.peak_acceleration < self.machine.peaks[self.name]:
                    return widest.diagram
        return found

    def _best(self) -> TimingDiagram | None:
        """Return the best of all moves within still arcs, None if rules or moves forbid the search.

        Then no moves of it keep the rules, or one of these is of another kind.
        """
        still = {self.name: self.still}
        with self._noted("all"):
            found = optimise(self.machine.diagram, self.rules, still=still, seconds=_SECONDS)
            return found.design
        return None

    @contextmanager
    def _noted(self, which: str, *, is_last_word: bool = True) -> Iterator[None]:
        """Go on where a search is refused or its check fails, and keep why."""
        try:
            with noted(self.failed, f"{which} moves of the {self.name}"):
                yield
        except InputError as refusal:
            if is_last_word:
                self.refusals.append(f"{refusal}")

    def _is_best(self, about: TimingDiagram) -> bool:
        """Tell whether no other moves between the still arcs can be better than these.

        So it is where it has to stand all along between them, and no rule needs it to stand longer.
        """
        moves = self.motion.moves
        laws = {as_law(move.law) for move in moves}
        return (
            _is_still((moves[0].to_deg, moves[-1].from_deg), self.still)
            and not self.motion.is_indexing
            and len(laws) == 1  # with two of them one angle is not the best for both
            and laws.pop().is_monotone
            and all(self._forbids_its_place(rule) for rule in self.rules)
            and _stands(about[self.name], self.still)
        )

    def _forbids_its_place(self, rule: Rule) -> bool:
        """Tell whether a rule only ever forbids it to be where it stands between its moves."""
        if not isinstance(rule, ClearanceRule):
            return False
        own = rule.when if rule.when.motion == self.name else rule.only_while.opposite
        is_high = self.motion.moves[0].change_mm > 0
        return not isinstance(own, Moving) and own.is_beyond == is_high

    def _put_out_all(self, motion: Motion) -> Iterator[TimingDiagram]:
        """Yield the diagram in which each end of the moves is put out as far as it goes.

        No rule is worse off than in the machine of today, and over its still arcs the part stands.
        """

        def keeps(motion: Motion) -> bool:
            changed = self.machine.diagram.with_motion(motion)
            return _stands(motion, self.still) and not worsened(
                self.faults, changed, self.rules, strict=True
            )

        if not keeps(motion):
            return
        for share in _SHARES:
            for place in _ends(motion, () if self.still else _works(motion)):
                most = share * _room(motion, place)
                motion = _furthest(partial(_put_out, motion, place), keeps, most)
        yield self.machine.diagram.with_motion(motion)


def _furthest(
    put_out: Callable[[float], Motion], keeps: Callable[[Motion], bool], most: float
) -> Motion:
    """Return what is put out all the way, or to where it is seen to stop, be it at once."""
    if keeps(furthest := put_out(most)):
        return furthest
    if not keeps(put_out(min(most / 2, _LEAST_DEG))):
        return put_out(0.0)
    reached = 0.0
    for _ in range(_HALVINGS):
        middle = (reached + most) / 2
        reached, most = (middle, most) if keeps(put_out(middle)) else (reached, middle)
    return put_out(reached)


def _ends(motion: Motion, fixed: Iterable[Place]) -> list[Place]:
    """Return the ends of the moves but for the fixed ones, those of the hardest move first.

    Of moves that are as hard the one that begins first comes first, in whatever order they are.
    """
    pushes = [float(f"{_push(move):.4g}") for move in motion.moves]
    starts = [move.from_deg % DEG_PER_TURN for move in motion.moves]
    hardest = sorted(range(len(pushes)), key=lambda number: (-pushes[number], starts[number]))
    places = [(number, end) for number in hardest for end in (0, 1)]
    return [place for place in places if place not in fixed]


def _works(motion: Motion) -> tuple[Place, ...]:
    """Return the ends at work of a part whose still arcs are not known: between rise and return."""
    return () if motion.is_indexing else ((0, 1), (len(motion.moves) - 1, 0))


def _at_work(motion: Motion, still: Sequence[Arc]) -> tuple[Place, ...]:
    """Return the ends of the dwell over which a part with one more dwell has to stand all along."""
    if not still:
        return _works(motion)
    if motion.is_indexing or not is_usual(motion):
        return ()
    first, last = motion.moves
    dwells = {
        ((0, 1), (1, 0)): (first.to_deg, last.from_deg),
        ((1, 1), (0, 0)): (last.to_deg, first.from_deg + DEG_PER_TURN),
    }
    held = [ends for ends, arc in dwells.items() if _is_still(arc, still)]
    return held[0] if len(held) == 1 else ()


def _is_still(dwell: Arc, still: Iterable[Arc]) -> bool:
    """Tell whether a part has to stand all along a dwell."""
    over, free = arcs([dwell]), complement(arcs(still))
    return bool(over) and sum(end - start for start, end in intersect(over, free)) < SAME_DEG


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
