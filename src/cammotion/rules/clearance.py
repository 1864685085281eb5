"""Clearance rules: one motion may be somewhere, or move, only while another one is somewhere.

A clearance rule says that the die may be deeper than 19 mm only while the mill is within 0.65 mm
of a stop. Each half of it holds over some arcs of the turn; what the arcs of the one have in common
with those over which the other does not hold is a violation.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

from cammotion.arguments import checked
from cammotion.machine.arcs import Arc, intersect, unwrap
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError
from cammotion.rules.conditions import Condition, Moving, after
from cammotion.rules.rule import ROUNDING_MM, Room, Rule


@checked
@dataclass(frozen=True, repr=False)
class ClearanceRule(Rule):
    """One motion may be somewhere, or move, only while another one is somewhere, or stands.

    `when` and `only_while` are conditions, made with `beyond`, `within`, `moving` and `standing`;
    with a `name` violations and pictures speak of it so. Raises InputError for two halves about one
    motion.

    >>> import cammotion as cm
    >>> print(ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65)))
    the die may be beyond 19 mm only while the mill is within 0.65 mm
    >>> print(ClearanceRule(cm.beyond("die", 19), cm.standing("mill"), name="die clear of mill"))
    die clear of mill: the die may be beyond 19 mm only while the mill is standing
    """

    when: Condition
    only_while: Condition
    name: str = ""

    def __post_init__(self) -> None:
        object.__setattr__(self, "name", self.name.strip())
        if self.when.motion == self.only_while.motion:
            raise InputError(
                f"Both halves of the clearance rule are about {self.when.motion!r}: name two "
                "motions."
            )

    @property
    def motions(self) -> tuple[str, str]:
        """The names of the two motions that it is about."""
        return self.when.motion, self.only_while.motion

    @property
    def reverse(self) -> "ClearanceRule":
        """The same rule said of the other motion: it leaves its place only while this one can."""
        return replace(self, when=self.only_while.opposite, only_while=self.when.opposite)

    def check(self, diagram: TimingDiagram) -> None:
        """Raise InputError for a diagram without its motions, or with such as it is not about."""
        for half in (self.when, self.only_while):
            half.check(diagram)

    def violated_arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs over which the rule is broken; one that crosses 360 deg ends above."""
        open_arcs = self.only_while.opposite.arcs(diagram)
        return unwrap(intersect(self.when.arcs(diagram), open_arcs)) if open_arcs else []

    def room(self, diagram: TimingDiagram, arc: Arc | None = None) -> Room | None:
        """Return the least room before the rule breaks, in an arc or a turn; None for no end."""
        return self._measured.room_of_when(diagram, arc)

    def room_of_when(self, diagram: TimingDiagram, arc: Arc | None = None) -> Room | None:
        """Return the least room of `when`, in an arc or while the other is not where it has to be.

        It is None where that never is, or where `when` has no end to its room. Of places that have
        as little room the first is named.
        """
        these = unwrap(self.only_while.opposite.arcs(diagram)) if arc is None else [arc]
        turns = self.when.turning_degs(diagram)
        places = [
            angle
            for start, end in these
            for angle in (start, end, *(after(turn, start) for turn in turns))
            if start <= angle <= end
        ]
        rooms = [Room(self.when.room_mm(diagram, angle), angle) for angle in places]
        least = min((room.mm for room in rooms), default=math.inf)
        if least == math.inf:
            return None
        return Room(least, min(room.at_deg for room in rooms if room.mm <= least + ROUNDING_MM))

    @checked
    def idle(self, diagram: TimingDiagram) -> str:
        """Return in words why nothing breaks it, however a diagram is timed; '' if something can.

        >>> import cammotion as cm
        >>> far = ClearanceRule(cm.beyond("die", 60), only_while=cm.within("mill", 0.65))
        >>> far.idle(cm.EXAMPLE.diagram)
        'the die is never beyond 60 mm'
        """
        if not self.when.arcs(diagram) and _is_of_its_way(self.when, diagram):
            return f"the {self.when.motion} is never {self.when}"
        if not self.only_while.opposite.arcs(diagram) and _is_of_its_way(self.only_while, diagram):
            return f"the {self.only_while.motion} is always {self.only_while}"
        return ""

    def describe(self) -> str:
        """Say in words what it asks, without its name."""
        when, only = self.motions
        return f"the {when} may be {self.when} only while the {only} is {self.only_while}"

    def describe_fault(self, excess_mm: float, at_deg: float) -> str:
        """Say in words how it is broken by so much, at a cam angle."""
        said = self._measured
        own, other = said.motions
        fault = said.when.describe_fault(excess_mm, at_deg)
        return f"the {own} {fault}, while the {other} is not {said.only_while}"

    def renamed(self, called: Mapping[str, str]) -> Self:
        """Return the rule about the same motions, which are called so in another diagram."""
        when, only = (
            replace(half, motion=called[half.motion]) for half in (self.when, self.only_while)
        )
        return replace(self, when=when, only_while=only)

    @property
    def _measured(self) -> "ClearanceRule":
        """It with a limit in mm in `when`, if one of the halves has one, or with what moves."""
        if not isinstance(self.when, Moving):
            return self
        is_limit = not isinstance(self.only_while, Moving)
        return self if self.when.is_beyond and not is_limit else self.reverse


def _is_of_its_way(half: Condition, diagram: TimingDiagram) -> bool:
    """Return whether that it never holds, or always, does not hang on when a motion moves."""
    return not isinstance(half, Moving) or not diagram[half.motion].moves


def in_mm(rule: ClearanceRule) -> bool:
    """Return whether both halves of a rule are limits in mm."""
    return not any(isinstance(half, Moving) for half in (rule.when, rule.only_while))
