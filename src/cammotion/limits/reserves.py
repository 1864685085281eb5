"""What is left until a rule breaks: in deg, in mm, and when the mechanisms are off their places."""

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import product

from cammotion.arguments import checked
from cammotion.arguments.by_name import by_name
from cammotion.laws.piece import bisect
from cammotion.limits.spread import SpreadDistance, with_errors
from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Quantity, as_text, shorten
from cammotion.rules.checks import every_rule
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.rule import ROUNDING_MM, Rule

_PHASE = Quantity("phase error", "deg", example=0.5, high=180, low_included=True)
_OFF = Quantity("error of the position", "mm", example=0.1, low_included=True)
_CLOSE = 1e-8
_DOUBLINGS, _TURNS = 60, 10  # of the errors, and of a deg: more than a turn
_MOST = 2.0**60  # times the errors, which no rule bears


@dataclass(frozen=True)
class Reserve:
    """What a diagram leaves until a rule breaks, or what some errors leave of that.

    `early_deg` and `late_deg` are how much earlier or later the first motion of the rule, that of
    `rule.when`, may be against the other one, `when_mm` how far it may be off its place towards the
    limit, and `other_mm` how far the other motion may. Each is for itself, and below 0 where the
    rule is broken: then the degrees are the longest arc over which it is. They are infinite where
    the rule cannot be broken so. `times` is how many times the errors the rule bears, all of them
    growing alike: below 1 it breaks with them, 0 it does without any. It is infinite without
    errors.
    """

    rule: Rule
    early_deg: float
    late_deg: float
    when_mm: float
    other_mm: float
    times: float

    @property
    def deg(self) -> float:
        """The reserve in deg: the smaller one of early and late."""
        return min(self.early_deg, self.late_deg)

    def __repr__(self) -> str:
        return f"Reserve({as_text(self.deg, '.4g')} deg: {shorten(self.rule, of=str)})"

    def __str__(self) -> str:
        """Say it in words."""
        when, other = self.rule.motions
        rooms = (self.early_deg, self.late_deg, self.when_mm, self.other_mm)
        early, late, when_mm, other_mm = (as_text(room, ".3g") for room in rooms)
        left = (
            f"{early} deg early, {late} deg late, {when_mm} mm of the {when}, {other_mm} mm of the "
            f"{other}"
        )
        return f"{self.rule}: {'broken' if self.deg < 0 else 'kept'}; left are {left}"


@checked
def reserves(
    diagram: TimingDiagram,
    rules: Rule | Iterable[Rule],
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
    given, names = every_rule(diagram, rules), diagram.names
    errors = _Errors(
        by_name("phase errors", phase_deg, names, _PHASE.number, "0.5", one_for_all=True),
        by_name("errors of position", off_mm, names, _OFF.number, "0.1", one_for_all=True),
    )
    found = (_reserve(diagram, rule, errors) for rule in given)
    return tuple(sorted(found, key=lambda reserve: reserve.times))


@dataclass(frozen=True)
class _Errors:
    """How far each motion may be off, by its name."""

    phase_deg: Mapping[str, float]
    off_mm: Mapping[str, float]

    @property
    def are_none(self) -> bool:
        return not any((*self.phase_deg.values(), *self.off_mm.values()))

    def worst(self, rule: Rule, times: float = 1.0) -> Rule:
        """Return the rule that is kept where this one is kept with so many times the errors."""
        one, other = rule.motions
        phase = self.phase_deg.get(one, 0.0) + self.phase_deg.get(other, 0.0)
        off_mm = self.off_mm.get(one, 0.0), self.off_mm.get(other, 0.0)
        return with_errors(rule, times * phase, (times * off_mm[0], times * off_mm[1]))


def _reserve(diagram: TimingDiagram, rule: Rule, errors: _Errors) -> Reserve:
    worst = errors.worst(rule)
    own = _room(diagram, worst)
    if not isinstance(rule, ClearanceRule):
        times = math.inf
        if not errors.are_none or own < -ROUNDING_MM:
            times = _first(lambda times: _room(diagram, errors.worst(rule, times)))
        return Reserve(rule, *_either_way(diagram, worst), own, own, times)

    def bears(times: float) -> bool:
        return not errors.worst(rule, times).violated_arcs(diagram)

    times = math.inf if bears(0.0) else 0.0
    if times and not errors.are_none and not bears(_MOST):
        times = bisect(bears, 0.0, _MOST)
    other = _room(diagram, errors.worst(rule.reverse))
    return Reserve(rule, *_either_way(diagram, worst), own, other, times)


def _room(diagram: TimingDiagram, rule: Rule) -> float:
    """Return the room in mm of the first motion of a rule."""
    found = rule.room_of_when(diagram) if isinstance(rule, ClearanceRule) else rule.room(diagram)
    return math.inf if found is None else found.mm


def _either_way(diagram: TimingDiagram, rule: Rule) -> tuple[float, float]:
    """Return the reserve early and late in deg; below 0 the longest arc over which it is broken."""
    if broken := rule.violated_arcs(diagram):
        longest = max(end - start for start, end in broken)
        return -longest, -longest
    if isinstance(rule, SpreadDistance):
        return _ways(diagram, rule)
    return _gaps(diagram, rule) if isinstance(rule, ClearanceRule) else (math.inf, math.inf)


def _gaps(diagram: TimingDiagram, rule: ClearanceRule) -> tuple[float, float]:
    """Return how far the arcs of `when` can come earlier, and later, until they meet the others."""
    open_arcs = rule.only_while.opposite.arcs(diagram)
    pairs = list(product(rule.when.arcs(diagram), open_arcs))
    early = [_ahead(start - end) for (start, _), (_, end) in pairs]
    late = [_ahead(start - end) for (_, end), (start, _) in pairs]
    return min(early, default=math.inf), min(late, default=math.inf)


def _ways(diagram: TimingDiagram, rule: SpreadDistance) -> tuple[float, float]:
    """Return how far a part can come earlier, and later, until its distance is too small."""

    def wider(field: str, way: float) -> float:
        return _room(diagram, replace(rule, **{field: getattr(rule, field) + way}))

    early, late = (_first(partial(wider, field), _TURNS) for field in ("early_deg", "late_deg"))
    return early, late


def _first(room_mm: Callable[[float], float], doublings: int = _DOUBLINGS) -> float:
    """Return how far it is until a room that only shrinks is used up; infinite where it never is.

    A billionth of a mm too little is rounding.
    """
    from scipy.optimize import brentq  # it takes a second to load

    def left(way: float) -> float:
        return room_mm(way) + ROUNDING_MM

    if left(0.0) < 0:
        return 0.0
    ways = (2.0**power for power in range(doublings))
    most = next((way for way in ways if left(way) < 0), None)
    return math.inf if most is None else float(brentq(left, 0.0, most, xtol=_CLOSE))


def _ahead(way: float) -> float:
    """Return a way from one angle on to another, within a turn; what is just before it is 0."""
    ahead = way % DEG_PER_TURN
    return 0.0 if DEG_PER_TURN - ahead <= 2 * ROUNDING_DEG else ahead
