"""Overlap: the widest move that two motions may make at the same time without breaking a rule.

When a motion is made wider, every cam angle at which it meets a limit moves in proportion to its
indexing angle Bm. So a clearance rule can begin or cease to hold only at such Bm for which one of
these angles meets one at which another motion meets its own limit. These are tried, the widest
first; nothing is searched for in steps.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import product
from typing import NamedTuple

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.clearance import (
    Clearance,
    ClearanceRule,
    Violation,
    after,
    as_rules,
    find_violations,
)
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import InputError, Quantity, WrongAnswerError

_NARROW_DEG = 1e-4  # a move that takes no time, for all that a cam can do
_WIDER_DEG = 1e-3  # by so much a move is widened to see that it cannot be
_TOUCHING_MM = 1e-6


@dataclass(frozen=True)
class WidestMove:
    """The widest move of a motion that keeps every rule, and what stops it from being wider.

    `diagram` is the diagram with that move in it, `motion` the name of the motion and `angles_deg`
    the indexing angles Bm of its moves. `tight` is the clearance that is used up; it is None where
    nothing but the turn of 360 deg sets the bound. `elsewhere` are violations of rules in which
    the motion has no part: no move of it can mend them, and none is to blame for them.
    """

    diagram: TimingDiagram
    motion: str
    angles_deg: tuple[float, ...]
    tight: Clearance | None
    elsewhere: tuple[Violation, ...] = ()

    @property
    def angle_deg(self) -> float:
        """The indexing angle Bm in deg; the smaller one, if rise and return have their own."""
        return min(self.angles_deg)

    @property
    def start_deg(self) -> float:
        """The cam angle at which the first move begins, 0 to 360."""
        return self.diagram[self.motion].moves[0].from_deg % DEG_PER_TURN

    @property
    def peak_acceleration(self) -> float:
        """The peak acceleration of the motion in m/s2."""
        return self.diagram.peak_acceleration(self.motion)


class _Event(NamedTuple):
    """Where a rule can begin or cease to hold: a move's number and Bm, and the cam angle."""

    move: int
    bm: float
    rule: ClearanceRule
    at_deg: float


@checked
def widest_move(
    diagram: TimingDiagram,
    motion: str,
    rules: ClearanceRule | Iterable[ClearanceRule],
    *,
    each_way: bool | None = None,
) -> WidestMove:
    """Return the widest move of a motion that keeps every rule in which it has a part.

    A motion with one rise and one return keeps the dwell after the first of them where it is, an
    indexing motion with one move the middle of it; all other motions stay. Rise and return get one
    angle if they have one now. With `each_way` (or if they have two now) each gets its own: of all
    pairs the one with the smallest peak acceleration; with `each_way=False` both get one, even if
    that is harder. What is broken `elsewhere`, by others alone, is listed in the answer. The answer
    is checked before it is returned: no rule is broken, what stood still stands where it did, and
    no move that is a thousandth of a degree wider is free. Raises InputError if no move
    keeps the rules, for a motion of another build, and for what are no rules of this diagram.

    >>> import cammotion as cm
    >>> found = widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule)
    >>> print(f"{found.angle_deg:.2f} deg, {found.peak_acceleration:.3f} m/s2")
    124.84 deg, 0.806 m/s2
    """
    given = as_rules(diagram, rules)
    own = [rule for rule in given if motion in (rule.when.motion, rule.only_while.motion)]
    frame = _Frame(diagram[motion])
    events = list(_events(diagram, frame, own))
    for angles in frame.candidates(events, frame.has_two_angles if each_way is None else each_way):
        wider = diagram.with_motion(frame.with_angles(angles))
        if _keeps(wider, own):
            _check(diagram, frame, own, angles)
            tight = _tight(wider, frame.met(events, angles))
            others = [rule for rule in given if rule not in own]
            elsewhere = find_violations(diagram, others) if others else ()
            return WidestMove(wider, motion, angles, tight, elsewhere)
    narrow = diagram.with_motion(frame.with_angles([_NARROW_DEG] * len(frame.anchors)))
    broken = "; ".join(map(str, find_violations(narrow, own)))
    raise InputError(
        f"No move of the {motion} keeps the rules: however quickly it moves, {broken}. "
        "Move its dwell, or give the other motion less of the turn."
    )


@checked
def with_angle(motion: Motion, angle_deg: float) -> Motion:
    """Return the motion with another indexing angle Bm, in deg, for all its moves.

    A motion with one rise and one return keeps the dwell after the first of them where it is, an
    indexing motion with one move the middle of it. Raises InputError for a motion of another build,
    and for an angle that the turn has no room for.

    >>> import cammotion as cm
    >>> with_angle(cm.EXAMPLE.mill, 160).moves[0].to_deg
    155.0
    """
    frame = _Frame(motion)
    widest = frame.room / len(frame.anchors)
    room = Quantity("indexing angle", "deg", example=widest / 2, high=widest)
    return frame.with_angles([room.number(angle_deg)] * len(frame.anchors))


class _Frame:
    """A motion made wider or narrower about what stays in place.

    Place x of a move then stands at the cam angle anchor + (x - share) Bm, so every angle at which
    the motion meets a limit shifts in proportion to Bm. `room` is what the turn has for all moves.
    """

    def __init__(self, motion: Motion) -> None:
        self.motion, moves = motion, motion.moves
        if len(moves) != (1 if motion.is_indexing else 2):
            build = "one move" if motion.is_indexing else "one rise and one return"
            raise InputError(
                f"The motion {motion.name!r} has {len(moves)} moves, and only one with {build} can "
                "be widened symmetrically: give it that, or widen it by hand and look for "
                "violations."
            )
        first, last = moves[0], moves[-1]
        if motion.is_indexing:
            self.anchors = [(first, (first.from_deg + first.to_deg) / 2, 0.5)]
            self.room = float(DEG_PER_TURN)
        else:
            self.anchors = [(first, first.to_deg, 1.0), (last, last.from_deg, 0.0)]
            self.room = DEG_PER_TURN - (last.from_deg - first.to_deg)

    @property
    def has_two_angles(self) -> bool:
        """Whether its moves have different angles now."""
        angles = [move.angle_deg for move, _, _ in self.anchors]
        return max(angles) - min(angles) > ROUNDING_DEG

    def with_angles(self, angles: Sequence[float]) -> Motion:
        """Return the motion with these indexing angles Bm, one for each move."""
        moves = [
            replace(move, from_deg=anchor - share * bm, to_deg=anchor + (1 - share) * bm)
            for (move, anchor, share), bm in zip(self.anchors, angles, strict=True)
        ]
        ends = [*(move.from_deg for move in moves[1:]), moves[0].from_deg + DEG_PER_TURN]
        return replace(self.motion, segments=tuple(_with_dwells(moves, ends)))

    def angles_at(self, limit_mm: float, angle_deg: float) -> Iterator[tuple[int, float]]:
        """Yield every Bm with which a move meets a limit at a cam angle, and the move's number."""
        meetings = [end for arc in self.motion.where_beyond(limit_mm) for end in arc]
        for number, (move, anchor, share) in enumerate(self.anchors):
            ways = [(after(m, move.from_deg) - move.from_deg) / move.angle_deg for m in meetings]
            for place in {0.0, 1.0, *(way for way in ways if 0 < way < 1)} - {share}:
                for turn in (-1, 0, 1):
                    since = angle_deg + turn * DEG_PER_TURN - anchor % DEG_PER_TURN
                    if _NARROW_DEG < (bm := since / (place - share)) < self.room:
                        yield number, bm

    def candidates(self, events: Iterable[_Event], each_way: bool) -> Iterator[tuple[float, ...]]:
        """Yield the indexing angles that can be the widest, the best first.

        One angle for all moves: the widest first. Each its own: the smallest peak first, and of
        two that share the whole room with each other also what one leaves to the other.
        """
        count, bms = (
            len(self.anchors),
            [{event.bm for event in events if event.move == n} for n in (0, 1)],
        )
        if not each_way or count == 1:
            most = self.room / count
            one_angle = {most, *(bm for bm in bms[0] | bms[1] if bm < most)}
            yield from ((bm,) * count for bm in sorted(one_angle, reverse=True))
            return
        now = [move.angle_deg for move, _, _ in self.anchors]
        even = self._even_share()
        rises, returns = (
            {*found, *more} for found, more in zip(bms, ([now[0]], [now[1]]), strict=True)
        )
        pairs = {
            (rise, back)
            for rise, back in (
                (even, self.room - even),
                *product(rises, returns),
                *((rise, self.room - rise) for rise in rises),
                *((self.room - back, back) for back in returns),
            )
            if min(rise, back) > _NARROW_DEG and rise + back <= self.room + ROUNDING_DEG
        }
        yield from sorted(pairs, key=lambda pair: (self._peak(pair), -sum(pair)))

    def met(self, events: Iterable[_Event], angles: Sequence[float]) -> list[_Event]:
        """Return the events at which the motion with these angles is, in the order of the turn."""
        start = self.with_angles(angles).moves[0].from_deg
        met = [e for e in events if abs(e.bm - angles[e.move]) <= ROUNDING_DEG]
        return sorted(met, key=lambda event: after(event.at_deg, start))

    def _peak(self, angles: Sequence[float]) -> float:
        """Return the largest acceleration within the moves, in mm/deg2.

        Of a move that goes on at one speed, and so is pushed at its ends, it is that speed.
        """
        return max(
            abs(move.change_mm) * (curve.derived(2).largest or curve.derived(1).largest) / bm**2
            for (move, _, _), bm in zip(self.anchors, angles, strict=True)
            for curve in [as_law(move.law).curve]
        )

    def _even_share(self) -> float:
        """Return the angle of the first move with which both, sharing the room, peak alike."""
        roots = [self._peak([1.0, 1e9]) ** 0.5, self._peak([1e9, 1.0]) ** 0.5]
        return self.room * (roots[0] / sum(roots) if any(roots) else 0.5)


def _keeps(diagram: TimingDiagram, rules: Iterable[ClearanceRule]) -> bool:
    return not any(rule.violated_arcs(diagram) for rule in rules)


def _check(
    diagram: TimingDiagram,
    frame: _Frame,
    rules: Sequence[ClearanceRule],
    angles: tuple[float, ...],
) -> None:
    """Raise WrongAnswerError for a move that can be made wider, or that moves what stood."""
    name = frame.motion.name
    found = diagram.with_motion(frame.with_angles(angles))
    if find_violations(found, rules) if rules else ():
        raise WrongAnswerError("widest_move", f"the {name} with {angles} deg breaks a rule")
    for _, anchor, _ in frame.anchors:
        moved = found[name].position_mm(anchor) - frame.motion.position_mm(anchor)
        if abs(moved) > _TOUCHING_MM:
            raise WrongAnswerError("widest_move", f"the {name} was moved at {anchor:g} deg")
    if len(set(angles)) > 1 or sum(angles) + len(angles) * _WIDER_DEG > frame.room:
        return
    wider = [bm + _WIDER_DEG for bm in angles]
    if _keeps(diagram.with_motion(frame.with_angles(wider)), rules):
        raise WrongAnswerError("widest_move", f"the {name} could take more than {angles[0]} deg")


def _tight(diagram: TimingDiagram, meetings: Iterable[_Event]) -> Clearance | None:
    """Return the first meeting at which both motions of its rule do stand at their limits."""
    for _, _, rule, where in meetings:
        rooms = [half.room_mm(diagram, where) for half in (rule.when, rule.only_while)]
        if max(map(abs, rooms)) < _TOUCHING_MM:
            return Clearance(rule, rooms[0], where)
    return None


def _with_dwells(moves: Iterable[Segment], ends: Iterable[float]) -> Iterator[Segment]:
    """Yield the moves, each with the dwell that follows it until the next one begins."""
    for move, end in zip(moves, ends, strict=True):
        yield move
        if end - move.to_deg > ROUNDING_DEG:
            height = move.to_mm
            yield Segment(from_deg=move.to_deg, to_deg=end, from_mm=height, to_mm=height)


def _events(
    diagram: TimingDiagram, frame: _Frame, rules: Iterable[ClearanceRule]
) -> Iterator[_Event]:
    """Yield each Bm at which a rule can begin or cease to hold.

    There the widened motion meets its limit at the same angle as the other motion meets its own.
    Between two neighbours of these Bm nothing changes.
    """
    for rule in rules:
        for own, other in ((rule.when, rule.only_while), (rule.only_while, rule.when)):
            if own.motion == frame.motion.name:
                for meeting in {end for arc in other.arcs(diagram) for end in arc}:
                    for move, bm in frame.angles_at(own.limit_mm, meeting):
                        yield _Event(move, bm, rule, meeting)
