"""A machine as pictures show it: not too many mechanisms, each under a short name."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TypeVar

from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.quantities import InputError
from cammotion.rules.rule import Rule
from cammotion.views.names import by_name, printable, short_names

R = TypeVar("R", bound=Rule)

MOST_MECHANISMS = 24


def readable(diagram: TimingDiagram) -> TimingDiagram:
    """Return a diagram that a picture can hold; raise InputError for one of too many mechanisms."""
    count = len(as_diagram(diagram).names)
    if count > MOST_MECHANISMS:
        raise InputError(
            f"The diagram has {count} mechanisms, and a picture holds {MOST_MECHANISMS} that can "
            "be read: draw it in parts, for example "
            f"TimingDiagram(diagram.motions[:{MOST_MECHANISMS}], diagram.rate_per_hour)."
        )
    return diagram


def short_diagram(diagram: TimingDiagram) -> TimingDiagram:
    """Return the diagram with a short name for each motion; itself where all are short."""
    called = _called(diagram)
    if all(name == short for name, short in called.items()):
        return diagram
    motions = [replace(motion, name=called[motion.name]) for motion in diagram.motions]
    return TimingDiagram(tuple(motions), diagram.rate_per_hour)


def short_rule(diagram: TimingDiagram, rule: R) -> R:
    """Return a rule about motions of the diagram for `short_diagram` of it."""
    return rule.renamed(_called(diagram))


def labels_of(diagram: TimingDiagram) -> dict[str, str]:
    """Return what each motion is called in a picture of Matplotlib, by its name."""
    return by_name(diagram.names)


def names_in_full(diagram: TimingDiagram, *names: str) -> list[str]:
    """Return a sentence for each of the `names`, all unless given, that was shortened."""
    called = _called(diagram)
    asked = [(called[name], printable(name)) for name in names or diagram.names]
    return [
        f"{short} is {full or 'a name without letters'}." for short, full in asked if short != full
    ]


def _called(diagram: TimingDiagram) -> Mapping[str, str]:
    return dict(zip(diagram.names, short_names(diagram.names), strict=True))
