"""What every kind of rule is asked: whom it concerns, where it is broken, and what room it leaves.

The ends of the arcs over which a clearance rule is broken are solved for on the motion laws' own
expressions, between turning points that are proved to be all there are; so what two arcs have in
common is a violation, however short it is, and none can slip through between samples.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple, Self

from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import as_text

ROUNDING_MM = 1e-9  # what places differ by without being two


class Room(NamedTuple):
    """The least room in mm in some part of the turn, and at which cam angle it is."""

    mm: float
    at_deg: float


class Rule(ABC):
    """What two motions may not do at once. Kinds of it are `ClearanceRule` and `DistanceRule`."""

    name: str
    """What it is called in violations and pictures; empty for a rule without a name."""

    @property
    @abstractmethod
    def motions(self) -> tuple[str, str]:
        """The names of the two motions that it is about."""

    def check(self, diagram: TimingDiagram) -> None:
        """Raise InputError for a diagram without its motions, or with such as it is not about."""
        for name in self.motions:
            diagram[name]  # which knows who there is

    @abstractmethod
    def violated_arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs over which the rule is broken; one that crosses 360 deg ends above."""

    @abstractmethod
    def room(self, diagram: TimingDiagram, arc: Arc | None = None) -> Room | None:
        """Return the least room before the rule breaks, in an arc or a turn; None for no end."""

    def idle(self, diagram: TimingDiagram) -> str:
        """Return in words why nothing breaks it, however a diagram is timed; '' if none is known.

        So it is of a limit beyond a stroke, which is a slip more often than it is meant. Of a
        distance none is known.
        """
        self.check(diagram)
        return ""

    @abstractmethod
    def describe(self) -> str:
        """Say in words what it asks, without its name."""

    @abstractmethod
    def describe_fault(self, excess_mm: float, at_deg: float) -> str:
        """Say in words how it is broken by so much, at a cam angle."""

    @abstractmethod
    def renamed(self, called: Mapping[str, str]) -> Self:
        """Return the rule about the same motions, which are called so in another diagram."""

    def __str__(self) -> str:
        """Say it in words."""
        return self._called + self.describe()

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self})"

    @property
    def _called(self) -> str:
        return f"{self.name}: " if self.name else ""


@dataclass(frozen=True, repr=False)
class Clearance:
    """How near a diagram comes to breaking a rule, in mm, and the cam angle at which it does.

    Of a clearance rule it is the room that `rule.when` still has while the other motion is not
    where it has to be, of a distance what it is more than the least; below 0 the rule is broken.
    Where nothing can break the rule the clearance is infinite, and the angle is None.
    """

    rule: Rule
    clearance_mm: float
    angle_deg: float | None

    def __repr__(self) -> str:
        at = "" if self.angle_deg is None else f" at {self.angle_deg:.5g} deg"
        return f"Clearance({as_text(self.clearance_mm, '.4g')} mm{at}: {self.rule})"


@dataclass(frozen=True, repr=False)
class Violation:
    """A rule that is broken over an arc, and by how much at the worst place in it.

    `start_deg` and `end_deg` bound the arc, which ends above 360 deg where it crosses 360;
    `excess_mm` is how far `rule.when` goes too far, or a distance is too small, at `angle_deg`.
    """

    rule: Rule
    start_deg: float
    end_deg: float
    excess_mm: float
    angle_deg: float

    def __repr__(self) -> str:
        return f"Violation({self})"

    def __str__(self) -> str:
        """Say what is too deep or too near, by how much and where."""
        turn = DEG_PER_TURN
        named = f"{self.rule.name}: " if self.rule.name else ""
        fault = self.rule.describe_fault(self.excess_mm, self.angle_deg % turn)
        start, end = f"{self.start_deg % turn:.6g}", f"{self.end_deg % turn or turn:.6g}"
        return f"{named}{fault}" + (f" (from {start} to {end} deg)" if start != end else "")
