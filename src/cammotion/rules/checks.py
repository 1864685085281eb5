"""Diagrams looked at for rules: what breaks them, how near each comes to that, and what is a rule.

All kinds of rules are asked alike.
"""

import math
from collections.abc import Iterable
from typing import Any, TypeGuard

from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import InputError, listed, shorten
from cammotion.rules.clearance import ClearanceRule, in_mm
from cammotion.rules.rule import Clearance, Rule, Violation


def find_violations(diagram: TimingDiagram, rules: Rule | Iterable[Rule]) -> tuple[Violation, ...]:
    """Return every violation of the rules, in the order of the rules and of the cam angle.

    None of a clearance rule is missed, however short, down to the rounding of 1e-9 deg and 1e-9 mm;
    a distance is looked at in close samples. Raises InputError for what is no rule and for a rule
    about an unknown motion.

    >>> import cammotion as cm
    >>> deeper = cm.EXAMPLE.diagram.with_motion(cm.with_angle(cm.EXAMPLE.die, 125))
    >>> len(find_violations(deeper, cm.EXAMPLE.rule)), find_violations(deeper, [])
    (2, ())
    """
    return tuple(
        Violation(rule, start, end, 0.0 - room.mm, room.at_deg)  # 0, not -0
        for rule in every_rule(diagram, rules)
        for start, end in rule.violated_arcs(diagram)
        if (room := rule.room(diagram, (start, end)))
    )


def find_clearances(diagram: TimingDiagram, rules: Rule | Iterable[Rule]) -> tuple[Clearance, ...]:
    """Return the smallest clearance that each rule leaves, and where, in the order of the rules.

    >>> import cammotion as cm
    >>> find_clearances(cm.EXAMPLE.diagram, cm.EXAMPLE.rule)[0].clearance_mm
    19.0
    """
    found = ((rule, rule.room(diagram)) for rule in every_rule(diagram, rules))
    return tuple(
        Clearance(rule, room.mm, room.at_deg % DEG_PER_TURN)
        if room
        else Clearance(rule, math.inf, None)
        for rule, room in found
    )


def smallest_clearance(diagram: TimingDiagram, rules: Rule | Iterable[Rule]) -> Clearance:
    """Return the smallest of the clearances that the rules leave; there has to be a rule.

    >>> import cammotion as cm
    >>> print(f"{smallest_clearance(cm.EXAMPLE.diagram, cm.EXAMPLE.rule).clearance_mm:g} mm")
    19 mm
    """
    found = find_clearances(diagram, rules)
    if not found:
        raise InputError("There is no rule, and so no clearance: give at least one.")
    return min(found, key=lambda found: found.clearance_mm)


def every_rule(diagram: TimingDiagram, rules: Rule | Iterable[Rule]) -> tuple[Rule, ...]:
    """Return rules of any kind; raise InputError unless they are rules for this diagram."""
    as_diagram(diagram)
    anything: Any = [rules] if isinstance(rules, Rule) else rules
    given = listed(anything)
    is_none = isinstance(rules, Iterable) and not isinstance(rules, str | bytes) and not given
    if not (given or is_none) or not all(isinstance(rule, Rule) for rule in given):
        raise InputError(
            f"The clearance rules are {shorten(rules)}: give one or a list, for example "
            "ClearanceRule(beyond('die', 19), only_while=within('mill', 0.65))."
        )
    return tuple(_as_spelled(diagram, rule) for rule in given)


def _as_spelled(diagram: TimingDiagram, rule: Rule) -> Rule:
    """Return the rule with the names as the diagram spells them; it may have another case."""
    rule.check(diagram)
    called = {name: diagram[name].name for name in rule.motions}
    return rule if all(name == own for name, own in called.items()) else rule.renamed(called)


def idle_rules(diagram: TimingDiagram, rules: Iterable[Rule]) -> dict[Rule, str]:
    """Return the rules that nothing breaks, however a diagram is timed, and why."""
    said = {rule: rule.idle(diagram) for rule in rules}
    return {rule: why for rule, why in said.items() if why}


def has_limits(rule: Rule) -> TypeGuard[ClearanceRule]:
    """Tell whether a rule is a clearance rule with a limit in mm of each motion."""
    return isinstance(rule, ClearanceRule) and in_mm(rule)


def as_rules(diagram: TimingDiagram, rules: Rule | Iterable[Rule]) -> tuple[ClearanceRule, ...]:
    """Return clearance rules with limits in mm, for what knows no other kind.

    Raises InputError for another one, and unless they are rules for this diagram.
    """
    found = []
    for rule in every_rule(diagram, rules):
        if not has_limits(rule):
            raise InputError(
                f"The rule '{rule}' is one of those that are not covered here: say it by beyond "
                "and within if you can, like 'the die may be beyond 19 mm only while the mill is "
                "within 0.65 mm'. Whether it is broken, find_violations tells."
            )
        found.append(rule)
    return tuple(found)
