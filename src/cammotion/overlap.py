"""Overlap: how far two motions may run at the same time without a collision.

A clearance rule says what may not happen at once: the die may be deeper than 19 mm only while the
mill is within 0.65 mm of a stop. Each half of it holds over some arcs of the turn. The ends of
these arcs are solved for on the motion laws' own expressions, between turning points that are
proved to be all there are; so what two arcs have in common is a violation, however short it is,
and none can slip through between samples.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from cammotion.arcs import ROUNDING_DEG, Arc, complement, intersect, join
from cammotion.checks import InputError, Quantity, shorten
from cammotion.diagram import TimingDiagram, as_diagram
from cammotion.kinematics import DEG_PER_TURN
from cammotion.motions import Motion
from cammotion.segments import POSITION, Segment

_NARROW_DEG = 1e-4  # a move that takes no time, for all that a cam can do
_TOUCHING_MM = 1e-6


@dataclass(frozen=True)
class Condition:
    """What a motion's offset may be: beyond a limit in mm, or within it (the limit included).

    The offset is `Motion.offset_mm`: the position, or of an indexing motion the distance from the
    nearest stop. Made by `beyond` and `within`.
    """

    motion: str
    limit_mm: float
    is_beyond: bool

    def __post_init__(self) -> None:
        object.__setattr__(self, "limit_mm", POSITION.number(self.limit_mm))

    @property
    def opposite(self) -> "Condition":
        """The condition that holds exactly where this one does not."""
        return replace(self, is_beyond=not self.is_beyond)

    def arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs of the turn over which it holds."""
        beyond = diagram[self.motion].where_beyond(self.limit_mm)
        return beyond if self.is_beyond else complement(beyond)

    def room_mm(self, diagram: TimingDiagram, angle_deg: float) -> float:
        """Return how far the motion still is from the condition; below 0 where it holds."""
        offset = float(diagram[self.motion].offset_mm(angle_deg))
        return self.limit_mm - offset if self.is_beyond else offset - self.limit_mm

    def __str__(self) -> str:
        """Say it in words."""
        return f"{'beyond' if self.is_beyond else 'within'} {self.limit_mm:g} mm"


def beyond(motion: str, limit_mm: float) -> Condition:
    """Return the condition that a motion is further than `limit_mm`, for a `ClearanceRule`."""
    return Condition(motion, limit_mm, True)


def within(motion: str, limit_mm: float) -> Condition:
    """Return the condition that a motion is at most at `limit_mm`, for a `ClearanceRule`."""
    return Condition(motion, limit_mm, False)


@dataclass(frozen=True)
class ClearanceRule:
    """One motion may be somewhere only while another one is somewhere.

    >>> print(ClearanceRule(beyond("die", 19), only_while=within("mill", 0.65)))
    the die may be beyond 19 mm only while the mill is within 0.65 mm
    """

    when: Condition
    only_while: Condition

    def __post_init__(self) -> None:
        for condition in (self.when, self.only_while):
            if not isinstance(condition, Condition):
                raise InputError(
                    f"A half of the clearance rule is {shorten(condition)}: make it with "
                    "beyond('die', 19) or within('mill', 0.65)."
                )
        if self.when.motion == self.only_while.motion:
            raise InputError(
                f"Both halves of the clearance rule are about {self.when.motion!r}: name two "
                "motions."
            )

    def violated_arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs over which the rule is broken; one that crosses 360 deg ends above."""
        open_arcs = self.only_while.opposite.arcs(diagram)
        return join(intersect(self.when.arcs(diagram), open_arcs)) if open_arcs else []

    def __str__(self) -> str:
        """Say it in words."""
        return (
            f"the {self.when.motion} may be {self.when} only while the {self.only_while.motion} "
            f"is {self.only_while}"
        )


@dataclass(frozen=True)
class Clearance:
    """How near a diagram comes to breaking a rule, in mm, and the cam angle at which it does.

    It is the room that `rule.when` still has while the other motion is not where it has to be;
    below 0 the rule is broken. Where the other motion always is where it has to be the clearance
    is infinite, and the angle is None.
    """

    rule: ClearanceRule
    clearance_mm: float
    angle_deg: float | None


@dataclass(frozen=True)
class Violation:
    """A rule that is broken over an arc, and by how much at the worst place in it.

    `start_deg` and `end_deg` bound the arc, which ends above 360 deg where it crosses 360;
    `excess_mm` is how far `rule.when` goes too far, at `angle_deg`.
    """

    rule: ClearanceRule
    start_deg: float
    end_deg: float
    excess_mm: float
    angle_deg: float

    def __str__(self) -> str:
        """Name the collision: what is too deep, by how much and where."""
        too_far = "too deep" if self.rule.when.is_beyond else "too near"
        turn = DEG_PER_TURN
        return (
            f"the {self.rule.when.motion} is {self.excess_mm:.3g} mm {too_far} at "
            f"{self.angle_deg % turn:.5g} deg (from {self.start_deg % turn:.6g} to "
            f"{self.end_deg % turn or turn:.6g} deg the {self.rule.only_while.motion} is not "
            f"{self.rule.only_while})"
        )


def find_violations(
    diagram: TimingDiagram, rules: ClearanceRule | Iterable[ClearanceRule]
) -> tuple[Violation, ...]:
    """Return every violation of the rules, in the order of the rules and of the cam angle.

    None is missed, however short, down to the rounding of 1e-9 deg. Raises InputError for what is
    no rule and for a rule about an unknown motion.
    """
    return tuple(
        Violation(rule, start, end, -room, angle)
        for rule in as_rules(diagram, rules)
        for start, end in rule.violated_arcs(diagram)
        for room, angle in [_least_room(rule, diagram, [(start, end)])]
    )


def find_clearances(
    diagram: TimingDiagram, rules: ClearanceRule | Iterable[ClearanceRule]
) -> tuple[Clearance, ...]:
    """Return the smallest clearance that each rule leaves, and where; errors as above."""
    found = []
    for rule in as_rules(diagram, rules):
        open_arcs = rule.only_while.opposite.arcs(diagram)
        room, angle = _least_room(rule, diagram, open_arcs) if open_arcs else (math.inf, None)
        found.append(Clearance(rule, room, angle))
    return tuple(found)


def smallest_clearance(
    diagram: TimingDiagram, rules: ClearanceRule | Iterable[ClearanceRule]
) -> Clearance:
    """Return the smallest of the clearances that the rules leave."""
    return min(find_clearances(diagram, rules), key=lambda found: found.clearance_mm)


@dataclass(frozen=True)
class WidestMove:
    """The widest move of a motion that keeps every rule, and what stops it from being wider.

    `diagram` is the diagram with that move in it, `motion` the name of the motion and `angle_deg`
    its indexing angle Bm. `tight` is the clearance that is used up; it is None where nothing but
    the turn of 360 deg sets the bound.
    """

    diagram: TimingDiagram
    motion: str
    angle_deg: float
    tight: Clearance | None

    @property
    def start_deg(self) -> float:
        """The cam angle at which the move begins, 0 to 360."""
        return self.diagram[self.motion].moves[0].from_deg % DEG_PER_TURN

    @property
    def peak_acceleration(self) -> float:
        """The peak acceleration of the move in m/s2."""
        return self.diagram.peak_acceleration(self.motion)


_Event = tuple[float, ClearanceRule, float]


def widest_move(
    diagram: TimingDiagram, motion: str, rules: ClearanceRule | Iterable[ClearanceRule]
) -> WidestMove:
    """Return the widest symmetric move of a motion that keeps every rule, whatever the laws.

    A motion with one rise and one return keeps the dwell between them where it is, and gets one
    angle for both; an indexing motion with one move keeps the middle of it. All other motions
    stay. Raises InputError if no move of the motion is free of collision, for a motion of another
    build, and as `find_violations` does.
    """
    given = as_rules(diagram, rules)
    frame = _Frame(diagram[motion])
    events = list(_events(diagram, frame, given))
    for angle in sorted({frame.widest, *(angle for angle, _, _ in events)}, reverse=True):
        wider = diagram.with_motion(frame.with_angle(angle))
        if not any(rule.violated_arcs(wider) for rule in given):
            meetings = [event for event in events if abs(event[0] - angle) <= ROUNDING_DEG]
            meetings.sort(key=lambda event: _after(event[2], wider[motion].start_deg))
            return WidestMove(wider, motion, angle, _tight(wider, meetings))
    narrow = diagram.with_motion(frame.with_angle(_NARROW_DEG))
    collisions = "; ".join(map(str, find_violations(narrow, given)))
    raise InputError(
        f"No move of the {motion} is free of collision: however quickly it moves, {collisions}. "
        "Move its dwell, or give the other motion less of the turn."
    )


def as_rules(
    diagram: TimingDiagram, rules: ClearanceRule | Iterable[ClearanceRule]
) -> tuple[ClearanceRule, ...]:
    """Return the rules as a tuple; raise InputError unless they are rules for this diagram."""
    as_diagram(diagram)
    anything: Any = [rules] if isinstance(rules, ClearanceRule) else rules
    given = tuple(anything) if isinstance(anything, Iterable) else ()
    if not given or not all(isinstance(rule, ClearanceRule) for rule in given):
        raise InputError(
            f"The clearance rules are {shorten(rules)}: give one or a list, for example "
            "ClearanceRule(beyond('die', 19), only_while=within('mill', 0.65))."
        )
    for rule in given:
        for condition in (rule.when, rule.only_while):
            diagram[condition.motion]
    return given


def _least_room(
    rule: ClearanceRule, diagram: TimingDiagram, these: list[Arc]
) -> tuple[float, float]:
    """Return the least room in some arcs, and its angle: one of their ends, or where S turns."""
    turns = diagram[rule.when.motion].offset_turning_degs
    places = [
        angle
        for start, end in these
        for angle in (start, end, *(_after(turn, start) for turn in turns))
        if start <= angle <= end
    ]
    return min((rule.when.room_mm(diagram, angle), angle) for angle in places)


def _after(angle: float, start: float) -> float:
    """Return the angle in the turn that begins at `start`."""
    return start + (angle - start) % DEG_PER_TURN


def with_angle(motion: Motion, angle_deg: float) -> Motion:
    """Return the motion with another indexing angle Bm, in deg, for all its moves.

    What stays in place is told at `widest_move`. Raises InputError for a motion of another build,
    and for an angle that the turn has no room for.

    >>> import cammotion as cm
    >>> mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
    >>> with_angle(mill, 160).moves[0].to_deg
    155.0
    """
    frame = _Frame(motion)
    room = Quantity("indexing angle", "deg", example=frame.widest / 2, high=frame.widest)
    return frame.with_angle(room.number(angle_deg))


class _Frame:
    """A motion made wider or narrower about what stays in place.

    Place x of a move then stands at the cam angle anchor + (x - share) Bm, so every angle at which
    the motion meets a limit shifts in proportion to Bm.
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
            self.widest = float(DEG_PER_TURN)
        else:
            self.anchors = [(first, first.to_deg, 1.0), (last, last.from_deg, 0.0)]
            self.widest = (DEG_PER_TURN - (last.from_deg - first.to_deg)) / 2

    def with_angle(self, angle: float) -> Motion:
        """Return the motion with the indexing angle Bm."""
        moves = [
            replace(move, from_deg=anchor - share * angle, to_deg=anchor + (1 - share) * angle)
            for move, anchor, share in self.anchors
        ]
        ends = [*(move.from_deg for move in moves[1:]), moves[0].from_deg + DEG_PER_TURN]
        return replace(self.motion, segments=tuple(_with_dwells(moves, ends)))

    def angles_at(self, limit_mm: float, angle_deg: float) -> Iterator[float]:
        """Yield every Bm with which the motion meets a limit at a cam angle."""
        meetings = [end for arc in self.motion.where_beyond(limit_mm) for end in arc]
        for move, anchor, share in self.anchors:
            ways = [(_after(m, move.from_deg) - move.from_deg) / move.angle_deg for m in meetings]
            for place in {0.0, 1.0, *(way for way in ways if 0 < way < 1)} - {share}:
                for turn in (-1, 0, 1):
                    angle = (angle_deg + turn * DEG_PER_TURN - anchor % DEG_PER_TURN) / (
                        place - share
                    )
                    if _NARROW_DEG < angle < self.widest:
                        yield angle


def _tight(diagram: TimingDiagram, meetings: Iterable[_Event]) -> Clearance | None:
    """Return the first meeting at which both motions of its rule do stand at their limits."""
    for _, rule, where in meetings:
        rooms = [half.room_mm(diagram, where) for half in (rule.when, rule.only_while)]
        if max(map(abs, rooms)) < _TOUCHING_MM:
            return Clearance(rule, rooms[0], where)
    return None


def _with_dwells(moves: Iterable[Segment], ends: Iterable[float]) -> Iterator[Segment]:
    """Yield the moves, each with the dwell that follows it until the next one begins."""
    for move, end in zip(moves, ends, strict=True):
        yield move
        if end > move.to_deg:
            height = move.to_mm
            yield Segment(from_deg=move.to_deg, to_deg=end, from_mm=height, to_mm=height)


def _events(
    diagram: TimingDiagram, frame: _Frame, rules: Iterable[ClearanceRule]
) -> Iterator[_Event]:
    """Yield each Bm at which a rule can begin or cease to hold, with the rule and the cam angle.

    There the widened motion meets its limit at the same angle as the other motion meets its own.
    Between two neighbours of these Bm nothing changes.
    """
    for rule in rules:
        for own, other in ((rule.when, rule.only_while), (rule.only_while, rule.when)):
            if own.motion == frame.motion.name:
                for meeting in {end for arc in other.arcs(diagram) for end in arc}:
                    for angle in frame.angles_at(own.limit_mm, meeting):
                        yield angle, rule, meeting
