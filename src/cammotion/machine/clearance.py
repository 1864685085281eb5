"""Clearance rules: what two motions may not do at once, and where a diagram does it.

A clearance rule says that the die may be deeper than 19 mm only while the mill is within 0.65 mm
of a stop. Each half of it holds over some arcs of the turn. The ends of these arcs are solved for
on the motion laws' own expressions, between turning points that are proved to be all there are; so
what two arcs have in common is a violation, however short it is, and none can slip through
between samples.
"""

import math
from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from cammotion.arguments import checked
from cammotion.machine.arcs import Arc, complement, intersect, unwrap
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.segments import POSITION
from cammotion.quantities import InputError, listed, shorten


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
    """Return the condition that a motion is further than `limit_mm`, for a `ClearanceRule`.

    Further up: a part that works downwards from 0 has to be described with its depth upwards.
    An indexing motion counts from its nearest stop, both ways alike.

    >>> str(beyond("die", 19))
    'beyond 19 mm'
    """
    return Condition(motion, limit_mm, True)


def within(motion: str, limit_mm: float) -> Condition:
    """Return the condition that a motion is at most at `limit_mm`, for a `ClearanceRule`.

    An indexing motion counts from its nearest stop, both ways alike.

    >>> str(within("mill", 0.65))
    'within 0.65 mm'
    """
    return Condition(motion, limit_mm, False)


@checked
@dataclass(frozen=True, repr=False)
class ClearanceRule:
    """One motion may be somewhere only while another one is somewhere.

    >>> print(ClearanceRule(beyond("die", 19), only_while=within("mill", 0.65)))
    the die may be beyond 19 mm only while the mill is within 0.65 mm
    """

    when: Condition
    only_while: Condition

    def __post_init__(self) -> None:
        if self.when.motion == self.only_while.motion:
            raise InputError(
                f"Both halves of the clearance rule are about {self.when.motion!r}: name two "
                "motions."
            )

    def __repr__(self) -> str:
        return f"ClearanceRule({self})"

    def violated_arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs over which the rule is broken; one that crosses 360 deg ends above."""
        open_arcs = self.only_while.opposite.arcs(diagram)
        return unwrap(intersect(self.when.arcs(diagram), open_arcs)) if open_arcs else []

    def __str__(self) -> str:
        """Say it in words."""
        return (
            f"the {self.when.motion} may be {self.when} only while the {self.only_while.motion} "
            f"is {self.only_while}"
        )


@dataclass(frozen=True, repr=False)
class Clearance:
    """How near a diagram comes to breaking a rule, in mm, and the cam angle at which it does.

    It is the room that `rule.when` still has while the other motion is not where it has to be;
    below 0 the rule is broken. Where the other motion always is where it has to be the clearance
    is infinite, and the angle is None.
    """

    rule: ClearanceRule
    clearance_mm: float
    angle_deg: float | None

    def __repr__(self) -> str:
        at = "" if self.angle_deg is None else f" at {self.angle_deg:.5g} deg"
        return f"Clearance({self.clearance_mm:.4g} mm{at}: {self.rule})"


@dataclass(frozen=True, repr=False)
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

    def __repr__(self) -> str:
        return f"Violation({self})"

    def __str__(self) -> str:
        """Say what is too deep, by how much and where."""
        too_far = "too deep" if self.rule.when.is_beyond else "too near"
        turn = DEG_PER_TURN
        return (
            f"the {self.rule.when.motion} is {self.excess_mm:.3g} mm {too_far} at "
            f"{self.angle_deg % turn:.5g} deg, while the {self.rule.only_while.motion} is not "
            f"{self.rule.only_while} (from {self.start_deg % turn:.6g} to "
            f"{self.end_deg % turn or turn:.6g} deg)"
        )


def find_violations(
    diagram: TimingDiagram, rules: ClearanceRule | Iterable[ClearanceRule]
) -> tuple[Violation, ...]:
    """Return every violation of the rules, in the order of the rules and of the cam angle.

    None is missed, however short, down to the rounding of 1e-9 deg. Raises InputError for what is
    no rule and for a rule about an unknown motion.

    >>> import cammotion as cm
    >>> deeper = cm.EXAMPLE.diagram.with_motion(cm.with_angle(cm.EXAMPLE.die, 125))
    >>> len(find_violations(deeper, cm.EXAMPLE.rule)), find_violations(deeper, [])
    (2, ())
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
    """Return the smallest clearance that each rule leaves, and where, in the order of the rules.

    >>> import cammotion as cm
    >>> find_clearances(cm.EXAMPLE.diagram, cm.EXAMPLE.rule)[0].clearance_mm
    19.0
    """
    found = []
    for rule in as_rules(diagram, rules):
        open_arcs = rule.only_while.opposite.arcs(diagram)
        room, angle = _least_room(rule, diagram, open_arcs) if open_arcs else (math.inf, None)
        found.append(Clearance(rule, room, angle))
    return tuple(found)


def smallest_clearance(
    diagram: TimingDiagram, rules: ClearanceRule | Iterable[ClearanceRule]
) -> Clearance:
    """Return the smallest of the clearances that the rules leave; there has to be a rule.

    >>> import cammotion as cm
    >>> print(f"{smallest_clearance(cm.EXAMPLE.diagram, cm.EXAMPLE.rule).clearance_mm:g} mm")
    19 mm
    """
    found = find_clearances(diagram, rules)
    if not found:
        raise InputError("There is no rule, and so no clearance: give at least one.")
    return min(found, key=lambda found: found.clearance_mm)


def as_rules(
    diagram: TimingDiagram, rules: ClearanceRule | Iterable[ClearanceRule]
) -> tuple[ClearanceRule, ...]:
    """Return the rules as a tuple; raise InputError unless they are rules for this diagram."""
    as_diagram(diagram)
    anything: Any = [rules] if isinstance(rules, ClearanceRule) else rules
    given = listed(anything)
    is_none = isinstance(rules, list | tuple) and not rules
    if not (given or is_none) or not all(isinstance(rule, ClearanceRule) for rule in given):
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
        for angle in (start, end, *(after(turn, start) for turn in turns))
        if start <= angle <= end
    ]
    return min((rule.when.room_mm(diagram, angle), angle) for angle in places)


def after(angle: float, start: float) -> float:
    """Return the angle in the turn that begins at `start`."""
    return start + (angle - start) % DEG_PER_TURN
