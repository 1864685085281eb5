"""The distance of two parts that move on one axis.

It has no bounds that would prove its turns, so it is looked at closely between all places at which
one of the two motions, or one of its derivatives, turns; and what is least among the samples is
searched for between its neighbours.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from cammotion.arguments import checked
from cammotion.bracketed import Extreme, cuts, largest, where_positive
from cammotion.machine.arcs import Arc, unwrap
from cammotion.machine.diagram import TimingDiagram, as_diagram, name_of
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity, as_text, keep_numbers
from cammotion.rules.conditions import after
from cammotion.rules.rule import ROUNDING_MM, Room, Rule

_DISTANCE = Quantity("least distance", "mm", example=5, low=-math.inf)
_DIGITS = 11  # of a distance in mm; what differs by less is rounding, and level


class _Stretch:
    """A part of the turn, with the places between its ends at which something turns."""

    def __init__(self, low: float, high: float, turns: list[float]) -> None:
        self.low, self.high, self.turns = low, high, turns

    @property
    def derivative(self) -> "_Stretch":
        """It again, since its turns are those of all derivatives."""
        return self


@checked
@dataclass(frozen=True, repr=False)
class DistanceRule(Rule):
    """One part stays so many mm above another one that moves on the same axis.

    The positions of both are measured from one place and in one direction; a part that is measured
    from elsewhere begins at a `start_mm` of its own. With a `name` violations and pictures speak of
    it so. Raises InputError for a distance that is not finite, and for one name twice.

    >>> import cammotion as cm
    >>> up_and_down = cm.rise(40, over_deg=90), cm.return_(40, over_deg=90), cm.dwell(180)
    >>> pusher = cm.motion("pusher", *up_and_down, start_mm=20)
    >>> flap = cm.motion("flap", *up_and_down, start_deg=20)
    >>> machine = cm.TimingDiagram([pusher, flap], rate_per_hour=2000)
    >>> rule = DistanceRule("pusher", above="flap", at_least_mm=8)
    >>> least = rule.smallest(machine)
    >>> print(f"{least.value:.2f} mm at {least.at_deg:.2f} deg; {rule}")
    2.93 mm at 145.00 deg; the pusher stays at least 8 mm above the flap
    >>> print(*cm.find_violations(machine, rule))
    the pusher is 5.07 mm too near above the flap at 145 deg (from 128.086 to 161.914 deg)
    """

    part: str | Motion
    above: str | Motion
    at_least_mm: float
    name: str = ""

    def __post_init__(self) -> None:
        keep_numbers(self, at_least_mm=_DISTANCE.number)
        object.__setattr__(self, "name", self.name.strip())
        object.__setattr__(self, "part", name_of(self.part))
        object.__setattr__(self, "above", name_of(self.above))
        if self.part == self.above:
            raise InputError(f"The distance rule is about {self.part!r} twice: name two parts.")

    @property
    def motions(self) -> tuple[str, str]:
        """The names of the two motions that it is about."""
        return str(self.part), str(self.above)

    def check(self, diagram: TimingDiagram) -> None:
        """Raise InputError for an unknown name, and for an indexing motion."""
        for name in self.motions:
            self._motion(diagram, name)

    def distance_mm(self, diagram: TimingDiagram, angle_deg: Floats) -> Floats:
        """Return the distance in mm at cam angles in deg, above 0 while the part is above."""
        part, below = (self._motion(diagram, name) for name in self.motions)
        return np.asarray(part.position_mm(angle_deg) - below.position_mm(angle_deg))

    def smallest(self, diagram: TimingDiagram) -> Extreme:
        """Return the smallest distance in mm in a turn, and the cam angle in deg at which it is.

        Raises InputError for an unknown name, and for an indexing motion, which has no one place.
        """
        return self._smallest(diagram, 0.0, float(DEG_PER_TURN))

    def cuts_of(self, motion: Motion) -> list[float]:
        """Return where a motion or one of its derivatives turns, and where its pieces meet."""
        inner = [place for piece in motion.curve.pieces for place in cuts(piece)]
        return [*motion.turning_degs, *inner]

    def violated_arcs(self, diagram: TimingDiagram) -> list[Arc]:
        """Return the arcs over which the rule is broken; one that crosses 360 deg ends above.

        A billionth of a mm too little is rounding.
        """
        least, digits = self.at_least_mm - ROUNDING_MM, _DIGITS

        def lack(_: _Stretch, angles: Floats) -> Floats:
            return np.round(least - self.distance_mm(diagram, angles), digits)

        return unwrap(where_positive(lack, [self._stretch(diagram, 0.0, float(DEG_PER_TURN))]))

    def room(self, diagram: TimingDiagram, arc: Arc | None = None) -> Room:
        """Return the least room before the rule breaks, in an arc or a turn."""
        found = self._smallest(diagram, *(arc or (0.0, float(DEG_PER_TURN))))
        return Room(found.value - self.at_least_mm, found.at_deg)

    def describe(self) -> str:
        """Say in words what it asks, without its name."""
        return f"the {self.part} stays at least {self.at_least_mm:g} mm above the {self.above}"

    def describe_fault(self, excess_mm: float, at_deg: float) -> str:
        """Say in words how it is broken by so much, at a cam angle."""
        near = f"{as_text(excess_mm, '.3g')} mm too near above the {self.above}"
        return f"the {self.part} is {near} at {at_deg:.5g} deg"

    def renamed(self, called: Mapping[str, str]) -> Self:
        """Return the rule about the same motions, which are called so in another diagram."""
        part, above = self.motions
        return replace(self, part=called[part], above=called[above])

    def _smallest(self, diagram: TimingDiagram, start: float, end: float) -> Extreme:
        def nearness(_: _Stretch, angles: Floats) -> Floats:
            return np.round(-self.distance_mm(diagram, angles), _DIGITS)

        found = largest(nearness, [self._stretch(diagram, start, end)])
        return Extreme(-found.value, found.at_deg)

    def _stretch(self, diagram: TimingDiagram, start: float, end: float) -> _Stretch:
        places = {
            after(place, start)
            for name in self.motions
            for place in self.cuts_of(self._motion(diagram, name))
        }
        return _Stretch(start, end, sorted(place for place in places if start < place < end))

    def _motion(self, diagram: TimingDiagram, name: str) -> Motion:
        motion = as_diagram(diagram)[name]
        if motion.is_indexing:
            raise InputError(
                f"The motion {name!r} moves on from stop to stop, and a distance rule is about "
                "parts that come back: use a ClearanceRule for it."
            )
        return motion
