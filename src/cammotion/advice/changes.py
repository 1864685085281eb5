"""One change of one mechanism: a wider move or another law, with what it brings."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cache

from cammotion.advice.widening import WORTH, stops, wider
from cammotion.advice.worse import SAME_DEG, faults_in, faults_of, noted, worsened
from cammotion.laws.catalogue import LAWS, as_law
from cammotion.limits.frame import hands_over
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.own import Machine
from cammotion.quantities import WrongAnswerError, in_decimals, plural, rate_as_text
from cammotion.rules.rule import Rule

WIDEN, NARROW, LAW, BALANCE = "widen", "narrow", "law", "balance"


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


def changes_of(
    machine: Machine, name: str, laws: Sequence[str], failed: list[str]
) -> Iterator[Improvement]:
    """Yield what can be changed of one mechanism with a gain, or so that a broken rule is kept.

    What makes a broken rule worse is left out. What cannot be told, since a check has failed or a
    search is refused, is put among the `failed`.
    """
    motion = machine.diagram[name]
    if not motion.moves or hands_over(motion):  # it would get a stop where it has none
        return
    rules = [rule for rule in machine.rules if name in rule.motions]
    yield from _wider(machine, name, rules, failed)
    with noted(failed, f"other laws of the {name}"):
        yield from _other_law(machine, name, rules, laws)


def improvement(
    kind: str, said: str, machine: Machine, changed: TimingDiagram, names: Sequence[str]
) -> Improvement:
    """Return what a changed diagram brings; raise WrongAnswerError if it breaks a rule anew."""
    after = machine.with_diagram(changed)
    touched = [r for r in machine.rules if {*r.motions} & {*names}]
    broken = faults_of(v for v in machine.violations if v.rule in touched)
    now = faults_in(changed, touched)
    worse = worsened(broken, changed, touched)
    if anew := [rule for rule in worse if rule not in broken]:
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
        worsens=len(worse),
    )


def _wider(
    machine: Machine, name: str, rules: Sequence[Rule], failed: list[str]
) -> Iterator[Improvement]:
    """Yield the other angles that mend most; if these cost something, also the gentlest ones."""
    tried: list[Improvement] = []
    for changed in wider(machine, name, rules, failed):
        with noted(failed, f"other angles of the {name}"):
            tried.append(_with_angles(machine, changed, name, rules))
    tried = [one for one in tried if not one.worsens]
    gentler = [one for one in tried if one.after < one.before * (1 - WORTH)]
    most = max((one.mends for one in tried), default=0)
    if most > max((one.mends for one in gentler), default=0):
        mending = (one for one in tried if one.mends == most)
        yield replace(min(mending, key=lambda one: one.after), kind=NARROW)
    if gentler:
        yield min(gentler, key=lambda one: (-one.mends, one.after))


def _with_angles(
    machine: Machine, changed: TimingDiagram, name: str, rules: Sequence[Rule]
) -> Improvement:
    stopped = dict.fromkeys(stops(machine, changed, name, rules))
    held = f" (then: {'; '.join(stopped)})" if stopped else ""
    if _dwells(machine.diagram[name]) and not _dwells(changed[name]):
        held = f"{held}, so that it stands nowhere"
    pairs = [*zip(machine.diagram[name].moves, changed[name].moves, strict=True)]
    what = " and ".join(
        f"the {before.kind} from {before.angle_deg:.4g} to {after.angle_deg:.5g} deg"
        for before, after in pairs
        if abs(before.angle_deg - after.angle_deg) > SAME_DEG
    )
    return improvement(
        WIDEN, f"{_verb(pairs)} {what} of the {name}{held}", machine, changed, [name]
    )


def _verb(pairs: Iterable[tuple[Segment, Segment]]) -> str:
    """Return whether moves before and after are all wider, all narrower, or neither."""
    more = [after.angle_deg - before.angle_deg for before, after in pairs]
    if min(more) >= -SAME_DEG:
        return "widen"
    return "narrow" if max(more) <= SAME_DEG else "change"


def _dwells(motion: Motion) -> bool:
    return any(segment.is_dwell for segment in motion.segments)


def _other_law(
    machine: Machine, name: str, rules: Sequence[Rule], laws: Sequence[str]
) -> Iterator[Improvement]:
    """Yield the change to the first of these laws, the gentlest first, that breaks no rule more.

    After it come those that mend more of the broken rules, and are still gentler than today's.
    """
    motion, before = machine.diagram[name], machine.peaks[name]
    broken = {violation.rule for violation in machine.violations}
    old = " and ".join(dict.fromkeys(as_law(move.law).name for move in motion.moves))
    mended = -1
    for law in laws:
        changed = machine.diagram.with_motion(motion.with_law(law))
        if changed.peak_acceleration(name) >= before * (1 - WORTH):
            return  # the others are no gentler
        if not faults_in(changed, rules).keys() <= broken:
            continue
        said = f"give the {name} the law {law} (now: {old})"
        one = improvement(LAW, said, machine, changed, [name])
        if not one.worsens and one.mends > mended:
            mended = one.mends
            yield one
        if mended == len(broken.intersection(rules)):
            return


@cache
def gentle_laws() -> tuple[str, ...]:
    """Return the laws of the catalogue with a finite jerk, the least peak acceleration first."""
    finite = [name for name, law in LAWS.items() if math.isfinite(law.Cj)]
    return tuple(sorted(finite, key=lambda name: LAWS[name].Ca))
