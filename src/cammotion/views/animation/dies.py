"""Dies: motions that a clearance rule links with a turret, and the measures that follow from it.

The rule says how deep the die may be while the turret is away from its stop: so it says where the
rim is. It also says how far off its stop the turret may be with the die inside: so it says how
much wider than the die the pocket is. Where the drawing shows a die in the rim the rule is broken.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from cammotion.machine.arcs import Arc, complement
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.rules.clearance import ClearanceRule, in_mm
from cammotion.rules.rule import Rule
from cammotion.views.animation.keyframes import Trace, trace_position

MARGIN_MM = 1.0  # less for a die that hardly moves


@dataclass(frozen=True)
class Die:
    """A motion that goes down into the pockets of a turret; all measures in mm."""

    number: int
    motion: Motion
    goes_down_as_it_rises: bool
    limit_mm: float
    tolerance_mm: float

    @property
    def travel(self) -> float:
        """How far it goes in a turn."""
        low, high = self.motion.range_mm
        return high - low or MARGIN_MM

    @property
    def margin(self) -> float:
        """How far over the rim the rule begins to hold; also what is left below at the bottom."""
        return min(MARGIN_MM, 0.05 * self.travel)

    @property
    def gap(self) -> float:
        """How far above the rim it waits."""
        low, high = self.motion.range_mm
        way = self.limit_mm - low if self.goes_down_as_it_rises else high - self.limit_mm
        return min(max(way + self.margin, -self.travel), 3 * self.travel)

    @property
    def pocket(self) -> float:
        """How deep the pocket has to be."""
        return max(self.travel + self.margin - self.gap, 0.3 * self.travel)

    @property
    def depth(self) -> Trace:
        """How far down it is."""
        return self.depth_by(trace_position(self.motion))

    def depth_by(self, position: Trace) -> Trace:
        """Return how far down it is by a trace of its position."""
        low, high = self.motion.range_mm
        rises = self.goes_down_as_it_rises
        sign, rest = (1, low) if rises else (-1, high)
        return position.scaled(sign, -sign * rest)

    def where_deeper(self, depth_mm: float) -> list[Arc]:
        """Return the arcs of the turn over which it is deeper than this."""
        low, high = self.motion.range_mm
        if self.goes_down_as_it_rises:
            return self.motion.where_beyond(low + depth_mm)
        return complement(self.motion.where_beyond(high - depth_mm))


def find_dies(diagram: TimingDiagram, rules: Iterable[Rule]) -> dict[str, list[Die]]:
    """Return for each turret the motions that a rule links with it, no more than it has stops."""
    found: dict[str, list[Die]] = {m.name: [] for m in diagram.motions if m.is_indexing}
    for rule in rules:
        if not isinstance(rule, ClearanceRule) or not in_mm(rule):
            continue
        for own, other in ((rule.when, rule.only_while), (rule.only_while, rule.when)):
            used = {die.motion.name for dies in found.values() for die in dies}
            if own.motion in found or own.motion in used or other.motion not in found:
                continue
            is_for_beyond = own.is_beyond == (own.motion == rule.when.motion)
            die = Die(
                diagram.names.index(own.motion),
                diagram[own.motion],
                is_for_beyond,
                own.limit_mm,
                abs(other.limit_mm),
            )
            if len(found[other.motion]) < (diagram[other.motion].stops or 0):
                found[other.motion].append(die)
    return found
