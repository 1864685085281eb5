"""Overlap: the widest move that two motions may make at the same time without breaking a rule.

When a motion is made wider, every cam angle at which it meets a limit moves in proportion to its
indexing angle Bm. So a clearance rule can begin or cease to hold only at such Bm for which one of
these angles meets one at which another motion meets its own limit. These are tried, the widest
first; nothing is searched for in steps.
"""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.laws.piece import bisect
from cammotion.limits.frame import NARROW_DEG, Event, Frame
from cammotion.limits.spread import tightened
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import InputError, Quantity, WrongAnswerError, as_text, shorten
from cammotion.rules.checks import every_rule, find_violations, idle_rules, smallest_clearance
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.rule import Clearance, Rule, Violation

_WIDER_DEG = 1e-3  # by so much a move is widened to see that it cannot be
_TOUCHING_MM = 1e-6
_RESERVE_DEG = Quantity("reserve", "deg", example=1, high=180, low_included=True)
_RESERVE_MM = Quantity("reserve", "mm", example=0.5, low_included=True)


@dataclass(frozen=True)
class WidestMove:
    """The widest move of a motion that keeps every rule, and what stops it from being wider.

    `diagram` is the diagram with that move in it, `mechanism` the name of its motion, `angles_deg`
    are the indexing angles Bm of its moves. `tight` is the clearance that is used up; it is None
    where nothing but the turn of 360 deg sets the bound, and where a reserve was asked for it is
    what is left. `elsewhere` are violations of rules in which the motion has no part: no move of it
    can mend them, and none is to blame for them. `idle` says of each rule that nothing can break
    why that is so, like "the die is never beyond 60 mm": see whether its limit is what was meant.
    """

    diagram: TimingDiagram
    mechanism: str
    angles_deg: tuple[float, ...]
    tight: Clearance | None
    elsewhere: tuple[Violation, ...] = ()
    idle: tuple[str, ...] = ()

    def __repr__(self) -> str:
        angles = " and ".join(f"{angle:.4g}" for angle in dict.fromkeys(self.angles_deg))
        name, peak = shorten(self.mechanism, of=str), as_text(self.peak_acceleration, ".4g")
        idle = "".join(f"; a rule that nothing can break: {why}" for why in self.idle)
        return f"WidestMove(the {name} over {angles} deg, {peak} m/s²{idle})"

    @property
    def angle_deg(self) -> float:
        """The indexing angle Bm in deg; the smaller one, if rise and return have their own."""
        return min(self.angles_deg)

    @property
    def start_deg(self) -> float:
        """The cam angle at which the first move begins, 0 to 360."""
        return self.diagram[self.mechanism].moves[0].from_deg % DEG_PER_TURN

    @property
    def peak_acceleration(self) -> float:
        """The peak acceleration of the motion in m/s2."""
        return self.diagram.peak_acceleration(self.mechanism)


@checked
def widest_move(  # noqa: PLR0913 - what is left out is none
    diagram: TimingDiagram,
    motion: str | Motion,
    rules: Rule | Iterable[Rule],
    *,
    each_way: bool | None = None,
    reserve_deg: float = 0.0,
    reserve_mm: float = 0.0,
) -> WidestMove:
    """Return the widest move of a motion that keeps every rule in which it has a part.

    A motion with one rise and one return keeps the dwell after the first of them where it is, an
    indexing motion with one move the middle of it; all other motions stay. Rise and return get one
    angle if they have one now. With `each_way` (or if they have two now) each gets its own: of all
    pairs the one with the smallest peak acceleration (where a velocity jumps at any angle: of the
    widest pairs the one with the smallest peak velocity); with `each_way=False` both get one, even
    if that is harder. Of each rule `reserve_deg` and `reserve_mm` are kept in hand: however much of
    the one the motion is early or late, a clearance of the other is left. What is broken
    `elsewhere`, by others alone, is listed in the answer, and why a rule is `idle`. With a
    `DistanceRule` both get one angle, and laws that do not turn back. The answer is checked before
    it is returned: no rule is broken, what stood still stands where it did, and no single angle
    that is a thousandth of a degree wider is free. Raises InputError if no move keeps the rules,
    for a motion of another build or one whose moves hand over a velocity, for a reserve below 0,
    and for what are no rules of this diagram.

    >>> import cammotion as cm
    >>> found = widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule)
    >>> print(f"{found.angle_deg:.2f} deg, {found.peak_acceleration:.3f} m/s2")
    124.84 deg, 0.806 m/s2
    >>> found = widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule, reserve_deg=1)
    >>> print(f"{found.angle_deg:.2f} deg")
    123.05 deg
    """
    given, motion = every_rule(diagram, rules), diagram[motion].name  # given in any case
    touching = [rule for rule in given if motion in rule.motions]
    deg, mm = _RESERVE_DEG.number(reserve_deg), _RESERVE_MM.number(reserve_mm)
    own = [tightened(rule, motion, deg, mm) for rule in touching] if deg or mm else touching
    frame = Frame(diagram[motion])
    is_each_way = frame.has_two_angles if each_way is None else each_way
    events = list(_events(diagram, frame, own, is_each_way))
    for angles in frame.candidates(events, is_each_way):
        wider = diagram.with_motion(frame.with_angles(angles))
        if _keeps(wider, own):
            _check(diagram, frame, own, angles)
            tight = _tight(wider, frame.met(events, angles), dict(zip(own, touching, strict=True)))
            others = [rule for rule in given if rule not in touching]
            elsewhere = find_violations(diagram, others)
            idle = tuple(idle_rules(wider, given).values())
            return WidestMove(wider, motion, angles, tight, elsewhere, idle)
    narrow = diagram.with_motion(frame.with_angles([NARROW_DEG] * len(frame.anchors)))
    broken = "; ".join(map(str, find_violations(narrow, own)))
    reserve = f" with {deg:g} deg and {mm:g} mm to spare" if own != touching else ""
    raise InputError(
        f"No move of the {motion} keeps the rules{reserve}: however quickly it moves, {broken}. "
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
    frame = Frame(motion)
    widest = frame.room / len(frame.anchors)
    room = Quantity("indexing angle", "deg", example=widest / 2, high=widest)
    return frame.with_angles([room.number(angle_deg)] * len(frame.anchors))


def _keeps(diagram: TimingDiagram, rules: Iterable[Rule]) -> bool:
    return not any(rule.violated_arcs(diagram) for rule in rules)


def _check(
    diagram: TimingDiagram,
    frame: Frame,
    rules: Sequence[Rule],
    angles: tuple[float, ...],
) -> None:
    """Raise WrongAnswerError for a move that can be made wider, or that moves what stood."""
    name = frame.motion.name
    found = diagram.with_motion(frame.with_angles(angles))
    if find_violations(found, rules):
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


def _tight(
    diagram: TimingDiagram, meetings: Iterable[Event], rules: Mapping[Rule, Rule]
) -> Clearance | None:
    """Return the first meeting at which both motions of its rule do stand at their limits.

    `rules` has for each rule that one of which it keeps a reserve.
    """
    for _, _, rule, where in meetings:
        rooms = _rooms_mm(diagram, rule, where)
        if max(map(abs, rooms)) < _TOUCHING_MM:
            loose = rules[rule]
            return (
                Clearance(rule, rooms[0], where)
                if loose is rule
                else smallest_clearance(diagram, loose)
            )
    return None


def _rooms_mm(diagram: TimingDiagram, rule: Rule, where: float) -> list[float]:
    """Return how far each motion of a rule is from its limit at a cam angle, or both together."""
    if isinstance(rule, ClearanceRule):
        return [half.room_mm(diagram, where) for half in (rule.when, rule.only_while)]
    found = rule.room(diagram)
    return [found.mm if found else math.inf]


def _events(
    diagram: TimingDiagram, frame: Frame, rules: Iterable[Rule], each_way: bool
) -> Iterator[Event]:
    """Yield each Bm at which a rule can begin or cease to hold.

    There the widened motion meets its limit at the same angle as the other motion meets its own.
    Between two neighbours of these Bm nothing changes.
    """
    for rule in rules:
        if not isinstance(rule, ClearanceRule):
            yield from _narrowed(diagram, frame, rule, each_way)
            continue
        for own, other in ((rule.when, rule.only_while), (rule.only_while, rule.when)):
            if own.motion == frame.motion.name:
                for meeting in {end for arc in other.arcs(diagram) for end in arc}:
                    for move, bm in frame.angles_at(own.limit_mm, meeting):
                        yield Event(move, bm, rule, meeting)


def _narrowed(diagram: TimingDiagram, frame: Frame, rule: Rule, each_way: bool) -> Iterator[Event]:
    """Yield the Bm at which a distance begins to be too small, if there is one.

    The wider its moves, the nearer the motion is at every cam angle to where it stays: so the
    distance only grows with Bm, or only shrinks.
    """
    moves = frame.motion.moves
    if each_way or not all(as_law(move.law).is_monotone for move in moves):
        why = "gives rise and return one angle" if each_way else "takes laws that do not turn back"
        fix = "each_way=False" if each_way else "such a law, or widen it by hand"
        raise InputError(
            f"With the rule '{rule}' the widest move of the {frame.motion.name} {why}: give {fix}."
        )

    def wide(bm: float) -> TimingDiagram:
        return diagram.with_motion(frame.with_angles([bm] * len(moves)))

    def keeps(bm: float) -> bool:
        room = rule.room(wide(bm))
        return room is None or room.mm >= 0

    most = frame.room / len(moves)
    if keeps(NARROW_DEG) and not keeps(most):
        bm = math.nextafter(bisect(keeps, NARROW_DEG, most), 0.0)
        room = rule.room(wide(bm))
        yield Event(0, bm, rule, room.at_deg if room else 0.0)
