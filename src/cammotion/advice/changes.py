"""One change of one mechanism: a wider move or another law, with what it brings."""

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache, partial

from cammotion.laws.catalogue import LAWS, as_law
from cammotion.laws.piece import bisect
from cammotion.limits.frame import hands_over
from cammotion.limits.widest import WidestMove, widest_move, with_angle
from cammotion.machine.arcs import Arc, arcs, intersect
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, arcs_of
from cammotion.own import Machine
from cammotion.quantities import InputError, WrongAnswerError, in_decimals, plural, rate_as_text
from cammotion.rules.checks import find_violations, smallest_clearance
from cammotion.rules.rule import Rule, Violation
from cammotion.whole.optimise import optimise

WIDEN, NARROW, LAW, BALANCE = "widen", "narrow", "law", "balance"
_WORTH = 1e-3  # of a peak: less is no gain
_SAME_DEG = 0.005
_USED_MM, _USED = 1e-3, 1e-4  # of a rule that has no more room; and of the ways in it at most
_SECONDS = 5.0  # for all moves of one mechanism
_HARDEST = 3  # mechanisms whose rise and return are asked each for itself, which takes longer
_ROUNDING = 1e-9  # deg


@dataclass(frozen=True, repr=False)
class Improvement:
    """A change of a machine that is worth it, and what it brings.

    `kind` is "widen" or "law" for one mechanism, "narrow" where only that mends a broken rule, and
    "balance" for all moves at once. `before` and `after` are the peak acceleration of the
    `mechanism` in m/s2 (of the whole machine in a balance), `largest` is that of the machine once
    it is done. At `rate_per_hour` the changed machine meets the largest peak that it has today.
    `mends` counts the broken rules that are kept then, `worsens` those that are broken by more, or
    for longer. `machine` is the machine with the change.
    """

    kind: str
    rate_per_hour: float
    mechanism: str
    said: str
    machine: Machine
    before: float
    after: float
    largest: float
    mends: int = 0
    worsens: int = 0

    @property
    def gain(self) -> float:
        """How much the peak acceleration falls, in m/s2; below 0 where a mended rule costs some."""
        return self.before - self.after

    @property
    def row(self) -> tuple[str | float, ...]:
        """What a table says of it: the change, peak before and after, the largest one, the rate."""
        peaks = (in_decimals(peak, 3) for peak in (self.before, self.after, self.largest))
        return self.said, *peaks, rate_as_text(self.rate_per_hour)

    def __repr__(self) -> str:
        """Say it in a line."""
        mends = f", mends {plural(self.mends, 'rule')}" if self.mends else ""
        before, after = (in_decimals(peak, 3) for peak in (self.before, self.after))
        return f"{self.said}: {before} to {after} m/s²{mends}"


def changes_of(machine: Machine, name: str, laws: Sequence[str]) -> Iterator[Improvement]:
    """Yield what can be changed of one mechanism with a gain, or so that a broken rule is kept.

    What makes a broken rule worse is left out.
    """
    if not machine.diagram[name].moves:
        return
    rules = [rule for rule in machine.rules if name in rule.motions]
    for one in (*_wider(machine, name, rules), *_other_law(machine, name, rules, laws)):
        if not one.worsens:
            yield one


def improvement(
    kind: str, said: str, machine: Machine, changed: TimingDiagram, names: Sequence[str]
) -> Improvement:
    """Return what a changed diagram brings; raise WrongAnswerError if it breaks a rule anew."""
    after = machine.with_diagram(changed)
    touched = [r for r in machine.rules if {*r.motions} & {*names}]
    broken = _faults(v for v in machine.violations if v.rule in touched)
    now = _faults(find_violations(changed, touched) if touched else ())
    if anew := [rule for rule in now if rule not in broken]:
        raise WrongAnswerError("improvements", f"'{said}' breaks the rule '{anew[0]}'")
    peaks = {**machine.peaks, **{name: changed.peak_acceleration(name) for name in names}}
    most, largest = max(machine.peaks.values()), max(peaks.values())
    faster = math.sqrt(most / largest) if 0 < largest < math.inf else 1.0
    return Improvement(
        kind=kind,
        mechanism=names[0] if kind != BALANCE else "",
        said=said,
        machine=after,
        before=max(machine.peaks[name] for name in names),
        after=max(peaks[name] for name in names),
        largest=largest,
        rate_per_hour=machine.diagram.rate_per_hour * faster,
        mends=len(broken) - len(now),
        worsens=sum(
            _is_worse(broken[rule], fault, _used_mm(changed, rule)) for rule, fault in now.items()
        ),
    )


def _faults(violations: Iterable[Violation]) -> dict[Rule, tuple[float, float]]:
    """Return how far each broken rule is broken at the worst, in mm, and for how long, in deg."""
    found: dict[Rule, tuple[float, float]] = {}
    for one in violations:
        most, long = found.get(one.rule, (0.0, 0.0))
        found[one.rule] = max(most, one.excess_mm), long + one.end_deg - one.start_deg
    return found


def _is_worse(before: tuple[float, float], after: tuple[float, float], used_mm: float) -> bool:
    return after[0] > before[0] + used_mm or after[1] > before[1] + _SAME_DEG


def _used_mm(diagram: TimingDiagram, rule: Rule) -> float:
    """Return what a rule may have left, in mm, and be used up."""
    ranges = (diagram[name].range_mm for name in rule.motions)
    return min(_USED_MM, _USED * max(high - low for low, high in ranges))


def _wider(machine: Machine, name: str, rules: Sequence[Rule]) -> Iterator[Improvement]:
    changed, held = _asked_wider(machine, name, rules)
    if changed is None:
        return
    if _dwells(machine.diagram[name]) and not _dwells(changed[name]):
        held = f"{held}, so that it stands nowhere"
    pairs = [*zip(machine.diagram[name].moves, changed[name].moves, strict=True)]
    what = " and ".join(
        f"the {before.kind} from {before.angle_deg:.4g} to {after.angle_deg:.5g} deg"
        for before, after in pairs
        if abs(before.angle_deg - after.angle_deg) > _SAME_DEG
    )
    said = f"{_verb(pairs)} {what} of the {name}{held}"
    one = improvement(WIDEN, said, machine, changed, [name])
    if one.after < one.before * (1 - _WORTH):
        yield one
    elif one.mends:
        yield replace(one, kind=NARROW)


def _verb(pairs: Iterable[tuple[Segment, Segment]]) -> str:
    """Return whether moves before and after are all wider, all narrower, or neither."""
    more = [after.angle_deg - before.angle_deg for before, after in pairs]
    if min(more) >= -_SAME_DEG:
        return "widen"
    return "narrow" if max(more) <= _SAME_DEG else "change"


def _asked_wider(
    machine: Machine, name: str, rules: Sequence[Rule]
) -> tuple[TimingDiagram | None, str]:
    """Return the diagram with the widest moves of a motion, and in words what stops them."""
    found, arcs = _widest(machine, name, rules), machine.still.get(name, ())
    if not arcs or (found and _stands(found.diagram[name], arcs)):
        held = f" (then: {found.tight.rule})" if found and found.tight else ""
        return (found.diagram if found else None), held
    changed = _between(machine, name, rules)
    used = [str(rule) for rule in rules if changed and _is_used_up(changed, rule)]
    return changed, f" (then: {'; '.join(['its still arc', *used])})"


def _is_used_up(diagram: TimingDiagram, rule: Rule) -> bool:
    return abs(smallest_clearance(diagram, rule).clearance_mm) < _used_mm(diagram, rule)


def _dwells(motion: Motion) -> bool:
    return any(segment.is_dwell for segment in motion.segments)


def _widest(machine: Machine, name: str, rules: Sequence[Rule]) -> WidestMove | None:
    """Return the widest move of a motion, of the three hardest with an angle for each way.

    Where that is no gain, it is the other way round; a distance rule, for one, allows one angle.
    """
    is_hard = name in [*machine.peaks][:_HARDEST]
    found = None
    for each_way in (None, False) if is_hard else (False, None):
        with suppress(InputError):  # not of this build, or no move of it keeps the rules
            wider = widest_move(machine.diagram, name, rules, each_way=each_way)
            found = found or wider
            if wider.peak_acceleration < machine.peaks[name]:
                return wider
    return found


def _between(machine: Machine, name: str, rules: Sequence[Rule]) -> TimingDiagram | None:
    """Return the diagram with the widest moves of a motion that stands over its still arcs."""
    still = {name: machine.still[name]}
    try:
        return optimise(machine.diagram, rules, still=still, seconds=_SECONDS).design
    except InputError:  # no moves of it keep the rules, or one of them is of another kind
        changed = _beside(machine, name)
    broken = {one.rule for one in machine.violations}
    is_worse = changed and {one.rule for one in machine.with_diagram(changed).violations} - broken
    return None if is_worse else changed


def _beside(machine: Machine, name: str) -> TimingDiagram | None:
    """Return the diagram with the widest move of a motion beside its still arcs, rules aside."""
    motion, arcs = machine.diagram[name], machine.still[name]
    narrow = min(move.angle_deg for move in motion.moves)
    fits = partial(_fits, motion, arcs)
    if not fits(narrow):
        return None
    angle = bisect(fits, narrow, float(DEG_PER_TURN)) - _ROUNDING
    return machine.diagram.with_motion(with_angle(motion, angle))


def _fits(motion: Motion, arcs: Sequence[Arc], angle_deg: float) -> bool:
    try:
        return _stands(with_angle(motion, angle_deg), arcs)
    except InputError:  # the turn has no room for it
        return False


def _stands(motion: Motion, still: Iterable[Arc]) -> bool:
    """Tell whether a motion stands over its still arcs."""
    return not intersect(arcs_of(motion.moves), arcs(still))


def _other_law(
    machine: Machine, name: str, rules: Sequence[Rule], laws: Sequence[str]
) -> Iterator[Improvement]:
    """Yield the change to the first of these laws, the gentlest first, that keeps the rules."""
    motion, before = machine.diagram[name], machine.peaks[name]
    if hands_over(motion):  # it would get a stop from a law that rests at its ends
        return
    broken = {violation.rule for violation in machine.violations}
    for law in laws:
        changed = machine.diagram.with_motion(motion.with_law(law))
        if changed.peak_acceleration(name) >= before * (1 - _WORTH):
            return  # the others are no gentler
        if {one.rule for one in find_violations(changed, rules)} <= broken:
            old = " and ".join(dict.fromkeys(as_law(move.law).name for move in motion.moves))
            said = f"give the {name} the law {law} (now: {old})"
            yield improvement(LAW, said, machine, changed, [name])
            return


@cache
def gentle_laws() -> tuple[str, ...]:
    """Return the laws of the catalogue with a finite jerk, the least peak acceleration first."""
    finite = [name for name, law in LAWS.items() if math.isfinite(law.Cj)]
    return tuple(sorted(finite, key=lambda name: LAWS[name].Ca))
