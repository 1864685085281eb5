"""What is left until a rule breaks: in deg, in mm, and when the mechanisms are off their places.

A mechanism that may run early or late does over wider arcs what it did: a condition is spread by so
many deg. What two spread arcs have in common is a violation that the errors can bring about.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from itertools import product

from cammotion.arguments import checked
from cammotion.arguments.by_name import by_name
from cammotion.laws.piece import bisect
from cammotion.machine.arcs import ROUNDING_DEG, Arc, arcs, complement
from cammotion.machine.clearance import (
    ClearanceRule,
    Condition,
    after,
    as_rules,
    smallest_clearance,
)
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Quantity

_PHASE = Quantity("phase error", "deg", example=0.5, high=180, low_included=True)
_OFF = Quantity("error of the position", "mm", example=0.1, low_included=True)
_MOST = 2.0**60  # times the errors, which no rule bears


@dataclass(frozen=True)
class Spread(Condition):
    """A condition as it may hold when its motion runs early or late by up to `spread_deg`.

    Below 0 it is the condition as it holds for certain: its opposite may not.
    """

    spread_deg: float = 0.0

    @property
    def opposite(self) -> "Spread":
        """The condition that holds exactly where this one does not."""
        return replace(self, is_beyond=not self.is_beyond, spread_deg=-self.spread_deg)

    def arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs over which it may hold, or holds for certain."""
        sharp = super().arcs(diagram)
        if self.spread_deg >= 0:
            return _widened(sharp, self.spread_deg)
        return complement(_widened(complement(sharp), -self.spread_deg))

    def room_mm(self, diagram: TimingDiagram, angle_deg: float) -> float:
        """Return the least room that it may have, or of one for certain the largest."""
        width = abs(self.spread_deg)
        start, end = angle_deg - width, angle_deg + width
        turns = (after(turn, start) for turn in diagram[self.motion].offset_turning_degs)
        places = (start, angle_deg, end, *(turn for turn in turns if turn < end))
        rooms = [super(Spread, self).room_mm(diagram, place) for place in places]
        return min(rooms) if self.spread_deg >= 0 else max(rooms)


@dataclass(frozen=True)
class Reserve:
    """What a diagram leaves until a rule breaks, or what some errors leave of that.

    `early_deg` and `late_deg` are how much earlier or later the motion of `rule.when` may be
    against the other one, `when_mm` how far it may be off its place towards the limit, and
    `other_mm` how far the other motion may. Each is for itself, and below 0 where the rule is
    broken: then the degrees are the longest arc over which it is. They are infinite where the rule
    cannot be broken so. `times` is how many times the errors the rule bears, all of them growing
    alike: below 1 it breaks with them, 0 it does without any. It is infinite without errors.
    """

    rule: ClearanceRule
    early_deg: float
    late_deg: float
    when_mm: float
    other_mm: float
    times: float

    @property
    def deg(self) -> float:
        """The reserve in deg: the smaller one of early and late."""
        return min(self.early_deg, self.late_deg)

    def __str__(self) -> str:
        """Say it in words."""
        when, other = self.rule.when.motion, self.rule.only_while.motion
        left = (
            f"{self.early_deg:.3g} deg early, {self.late_deg:.3g} deg late, {self.when_mm:.3g} mm "
            f"of the {when}, {self.other_mm:.3g} mm of the {other}"
        )
        return f"{self.rule}: {'broken' if self.deg < 0 else 'kept'}; left are {left}"


@checked
def reserves(
    diagram: TimingDiagram,
    rules: ClearanceRule | Iterable[ClearanceRule],
    *,
    phase_deg: float | Mapping[str, float] = 0.0,
    off_mm: float | Mapping[str, float] = 0.0,
) -> tuple[Reserve, ...]:
    """Return what each rule has left, also with errors of the mechanisms; the first to break first.

    Each mechanism may be early or late by `phase_deg`, and off its place by `off_mm` either way:
    backlash of its drive, wear and play, added up. Both are a number for all, or numbers by the
    names of motions. All errors are taken at their worst at once. Raises InputError for errors
    below 0, unknown names, and for what are no rules of this diagram.

    >>> import cammotion as cm
    >>> (full,) = reserves(cm.EXAMPLE.diagram, cm.EXAMPLE.rule)
    >>> print(f"{full.deg:.2f} deg, {full.when_mm:.2f} mm, {full.other_mm:.3f} mm")
    39.16 deg, 19.00 mm, 0.645 mm
    >>> (left,) = reserves(cm.EXAMPLE.diagram, cm.EXAMPLE.rule, phase_deg=0.5, off_mm=0.1)
    >>> print(f"{left.deg:.2f} deg, {left.when_mm:.2f} mm; {left.times:.1f} times such errors")
    37.27 deg, 18.90 mm; 6.5 times such errors
    """
    given, names = as_rules(diagram, rules), diagram.names
    errors = _Errors(
        by_name("phase errors", phase_deg, names, _PHASE.number, "0.5", one_for_all=True),
        by_name("errors of position", off_mm, names, _OFF.number, "0.1", one_for_all=True),
    )
    found = (_reserve(diagram, rule, errors) for rule in given)
    return tuple(sorted(found, key=lambda reserve: reserve.times))


def tightened(rule: ClearanceRule, motion: str, deg: float, mm: float) -> ClearanceRule:
    """Return the rule that is kept where this one keeps a reserve in deg, and in mm of `when`.

    What is spread is the half that is not about `motion`, whose own limit so stays sharp.
    """
    when, only = _eased(rule.when, mm), rule.only_while
    if when.motion == motion:
        return ClearanceRule(when, _spread(only, -deg))
    return ClearanceRule(_spread(when, deg), only)


@dataclass(frozen=True)
class _Errors:
    """How far each motion may be off, by its name."""

    phase_deg: Mapping[str, float]
    off_mm: Mapping[str, float]

    @property
    def are_none(self) -> bool:
        return not any((*self.phase_deg.values(), *self.off_mm.values()))

    def worst(self, rule: ClearanceRule, times: float = 1.0) -> ClearanceRule:
        """Return the rule that is kept where this one is kept with so many times the errors."""
        when, only = rule.when, rule.only_while
        phase = self.phase_deg.get(when.motion, 0.0) + self.phase_deg.get(only.motion, 0.0)
        eased = _eased(when, times * self.off_mm.get(when.motion, 0.0))
        kept = _eased(only.opposite, times * self.off_mm.get(only.motion, 0.0)).opposite
        return ClearanceRule(_spread(eased, times * phase), kept)


def _reserve(diagram: TimingDiagram, rule: ClearanceRule, errors: _Errors) -> Reserve:
    worst = errors.worst(rule)
    reverse = ClearanceRule(rule.only_while.opposite, only_while=rule.when.opposite)
    own, other = (
        smallest_clearance(diagram, asked).clearance_mm for asked in (worst, errors.worst(reverse))
    )

    def bears(times: float) -> bool:
        return not errors.worst(rule, times).violated_arcs(diagram)

    times = math.inf if bears(0.0) else 0.0
    if times and not errors.are_none and not bears(_MOST):
        times = bisect(bears, 0.0, _MOST)
    return Reserve(rule, *_gaps(diagram, worst), own, other, times)


def _gaps(diagram: TimingDiagram, rule: ClearanceRule) -> tuple[float, float]:
    """Return how far the arcs of `when` can come earlier, and later, until they meet the others."""
    if broken := rule.violated_arcs(diagram):
        longest = max(end - start for start, end in broken)
        return -longest, -longest
    open_arcs = rule.only_while.opposite.arcs(diagram)
    pairs = list(product(rule.when.arcs(diagram), open_arcs))
    early = [_ahead(start - end) for (start, _), (_, end) in pairs]
    late = [_ahead(start - end) for (_, end), (start, _) in pairs]
    return min(early, default=math.inf), min(late, default=math.inf)


def _ahead(way: float) -> float:
    """Return a way from one angle on to another, within a turn; what is just before it is 0."""
    ahead = way % DEG_PER_TURN
    return 0.0 if DEG_PER_TURN - ahead <= 2 * ROUNDING_DEG else ahead


def _eased(condition: Condition, mm: float) -> Condition:
    """Return the condition that holds where this one is so near as to hold."""
    way = -mm if condition.is_beyond else mm
    return replace(condition, limit_mm=condition.limit_mm + way)


def _spread(condition: Condition, deg: float) -> Condition:
    return Spread(condition.motion, condition.limit_mm, condition.is_beyond, deg)


def _widened(these: list[Arc], deg: float) -> list[Arc]:
    return arcs((start - deg, end + deg) for start, end in these)
