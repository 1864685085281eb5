"""Mechanisms of an explorer under short names: its controls, legends and sentences have them."""

from collections.abc import Mapping
from dataclasses import replace

from cammotion.machine.clearance import ClearanceRule, Condition
from cammotion.machine.diagram import TimingDiagram
from cammotion.views.live.parts import Say
from cammotion.views.names import printable, short_names


def short_diagram(diagram: TimingDiagram) -> TimingDiagram:
    """Return the diagram with a short name for each motion."""
    called = _called(diagram)
    motions = [replace(motion, name=called[motion.name]) for motion in diagram.motions]
    return TimingDiagram(tuple(motions), diagram.rate_per_hour)


def short_rule(diagram: TimingDiagram, rule: ClearanceRule) -> ClearanceRule:
    """Return a rule about motions of the diagram for `short_diagram` of it."""
    called = _called(diagram)

    def half(condition: Condition) -> Condition:
        return replace(condition, motion=called[condition.motion])

    return ClearanceRule(half(rule.when), only_while=half(rule.only_while))


def names_in_full(diagram: TimingDiagram, *names: str) -> list[Say]:
    """Return a sentence for each of the `names`, all unless given, that was shortened."""
    called = _called(diagram)
    asked = [(called[name], printable(name)) for name in names or diagram.names]
    return [
        Say("{short} is {full}.", {"short": short, "full": full or "a name without letters"})
        for short, full in asked
        if short != full
    ]


def _called(diagram: TimingDiagram) -> Mapping[str, str]:
    return dict(zip(diagram.names, short_names(diagram.names), strict=True))
