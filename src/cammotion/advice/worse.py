"""Which rules of a machine are broken, how far and for how long, and which a change makes worse."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager

from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import WrongAnswerError
from cammotion.rules.checks import find_violations
from cammotion.rules.rule import Rule, Violation

SAME_DEG = 0.005
"""Angles that differ by less are one."""

_USED_MM, _USED = 1e-3, 1e-4  # of a rule that has no more room; and of the ways in it at most
_STRICT = 0.01  # of these, while it is searched

Faults = Mapping[Rule, tuple[float, float]]
"""How far each broken rule is broken at the worst, in mm, and for how long, in deg."""


def faults_of(violations: Iterable[Violation]) -> Faults:
    """Return how far each broken rule is broken at the worst, in mm, and for how long, in deg."""
    found: dict[Rule, tuple[float, float]] = {}
    for one in violations:
        most, long = found.get(one.rule, (0.0, 0.0))
        found[one.rule] = max(most, one.excess_mm), long + one.end_deg - one.start_deg
    return found


def faults_in(diagram: TimingDiagram, rules: Sequence[Rule]) -> Faults:
    """Return the same of a diagram, and nothing where there are no rules."""
    return faults_of(find_violations(diagram, rules)) if rules else {}


def worsened(
    before: Faults, diagram: TimingDiagram, rules: Sequence[Rule], *, strict: bool = False
) -> list[Rule]:
    """Return the rules that a changed diagram breaks by more than before, for longer, or anew.

    A search asks strictly, so that what it finds is surely no worse for who asks again.
    """
    now, share = faults_in(diagram, rules), _STRICT if strict else 1.0
    return [
        rule
        for rule in rules
        if rule in now
        and (rule not in before or is_worse(before[rule], now[rule], used_mm(diagram, rule), share))
    ]


def is_worse(
    before: tuple[float, float], after: tuple[float, float], used_mm: float, share: float = 1.0
) -> bool:
    """Tell whether a rule is broken by more than before, or for longer, but for a little."""
    return after[0] > before[0] + share * used_mm or after[1] > before[1] + share * SAME_DEG


def used_mm(diagram: TimingDiagram, rule: Rule) -> float:
    """Return what a rule may have left, in mm, and be used up."""
    ranges = (diagram[name].range_mm for name in rule.motions)
    return min(_USED_MM, _USED * max(high - low for low, high in ranges))


@contextmanager
def noted(failed: list[str], what: str) -> Iterator[None]:
    """Go on where a check fails, and note in words of what there is no answer then."""
    try:
        yield
    except WrongAnswerError as wrong:
        failed.append(f"Not known is what would come of {what}: {wrong}")
