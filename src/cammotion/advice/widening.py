"""How wide the moves of one mechanism can be beside all others, and what stops them there."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import cached_property

from cammotion.advice.ends import (
    at_work,
    by_a_hair,
    ends,
    furthest,
    is_still,
    room,
    stands,
    works,
)
from cammotion.advice.worse import SAME_DEG, Faults, faults_in, noted, worsened
from cammotion.laws.catalogue import as_law
from cammotion.limits.frame import is_usual
from cammotion.limits.widest import widest_move
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.machine.segments import with_dwells
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
_STILL_ARC = "its still arc"


def wider(
    machine: Machine, name: str, rules: Sequence[Rule], failed: list[str]
) -> Iterator[TimingDiagram]:
    """Yield diagrams with other angles of a mechanism's moves, wider ones or such that mend a rule.

    What cannot be told, since a check has failed or a search is refused, is put among the `failed`.
    """
    search = _Search(machine, name, rules, failed)
    found = (each for each in search.found() if stands(each[name], search.still))
    yield from map(search.as_today, found)


def stops(
    machine: Machine, changed: TimingDiagram, name: str, rules: Sequence[Rule]
) -> Iterator[str]:
    """Yield what stops the moves of a changed mechanism from being wider, the hardest move first.

    Each end of a move is put out by a hair, to see what that breaks; not so the ends at work.
    """
    motion, still = changed[name], machine.still.get(name, ())
    faults = faults_in(changed, rules)
    for place in ends(motion, at_work(motion, still)):
        farther = by_a_hair(motion, place)
        if not stands(farther, still):
            yield _STILL_ARC
        else:
            there = changed.with_motion(farther)
            yield from map(str, worsened(faults, there, rules, strict=True))


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

    def as_today(self, found: TimingDiagram) -> TimingDiagram:
        """Return the diagram with each move as wide as today that was made narrower for nothing.

        So it is where all rules are kept as well with it, and no peak is higher.
        """
        faults, peak = faults_in(found, self.rules), found.peak_acceleration(self.name)
        for number, today in enumerate(self.motion.moves):
            motion = found[self.name]
            moves = [*motion.moves]
            if moves[number].angle_deg > today.angle_deg - SAME_DEG:
                continue
            moves[number] = today
            with noted(self.failed, f"other angles of the {self.name}"), suppress(InputError):
                motion = replace(motion, segments=tuple(with_dwells(moves)))
                wide = found.with_motion(motion)
                is_as_good = wide.peak_acceleration(self.name) <= peak
                if (
                    is_as_good
                    and stands(motion, self.still)
                    and not worsened(faults, wide, self.rules, strict=True)
                ):
                    found = wide
        return found

    def _is_stuck(self, found: Sequence[TimingDiagram]) -> bool:
        """Tell whether nothing that was found is a gain, though not every move was looked at."""
        before = self.machine.peaks[self.name] * (1 - WORTH)
        standing = (each for each in found if stands(each[self.name], self.still))
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
        found, told = None, len(self.refusals)
        for each_way in (None, False) if is_hard else (False, None):
            with self._noted("wider", is_last_word=each_way is False):
                widest = widest_move(self.machine.diagram, self.name, rules, each_way=each_way)
                found = found or widest.diagram
                if once or widest.peak_acceleration < self.machine.peaks[self.name]:
                    found = widest.diagram
                    break
        if found:  # another way was refused, but not this one
            del self.refusals[told:]
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
            is_still((moves[0].to_deg, moves[-1].from_deg), self.still)
            and not self.motion.is_indexing
            and len(laws) == 1  # with two of them one angle is not the best for both
            and laws.pop().is_monotone
            and all(self._forbids_its_place(rule) for rule in self.rules)
            and stands(about[self.name], self.still)
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
            return stands(motion, self.still) and not worsened(
                self.faults, changed, self.rules, strict=True
            )

        if not keeps(motion):
            return
        for share in _SHARES:
            for place in ends(motion, () if self.still else works(motion)):
                motion = furthest(motion, place, share * room(motion, place), keeps)
        yield self.machine.diagram.with_motion(motion)
