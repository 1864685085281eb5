"""Which side of a clearance rule gives way: the choice at a node of a grid, and over a cell.

Wherever a rule is kept, one of its halves gives way: the die is no deeper than 19 mm, or the mill
is within 0.65 mm of a stop, of one of its stops. Each such interval of one part is an option.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cammotion.limits.corridors import NEAR_DEG, is_in
from cammotion.machine.arcs import Arc, arcs, intersect, unwrap
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import Floats
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition
from cammotion.whole.parts import Interval, Part, intervals

_ROUNDING_MM = 1e-6  # the solver's
_MOST_STOPS = 50


class Option(NamedTuple):
    """The part of a number has to be in an interval; with no part, nothing has to be."""

    part: int | None
    interval: Interval

    def moved(self, way_mm: float) -> "Option":
        """Return the option with its interval further by so much."""
        low, high = self.interval
        return Option(self.part, Interval(low + way_mm, high + way_mm))

    def holds(self, places_mm: Sequence[float]) -> bool:
        """Whether the part is in the interval, of the positions of all."""
        low, high = self.interval
        return self.part is None or (
            low - _ROUNDING_MM <= places_mm[self.part] <= high + _ROUNDING_MM
        )


Places = Sequence[Sequence[float]]
"""Positions in mm of each part, at one end of a cell and at the other."""

_NOTHING = Option(None, Interval(-np.inf, np.inf))


@dataclass(frozen=True)
class Side:
    """What a half of a rule asks if it has to give way.

    `part` is the number of the part that it is about, None if that is not free. Over the arcs
    `closed` it cannot give way: there the motion is as in the diagram, since it is not free or has
    to stand, and not where it would have to be.
    """

    condition: Condition
    part: int | None
    closed: tuple[Arc, ...] = ()

    def is_closed(self, angle_deg: Floats, *, edges: bool) -> NDArray[np.bool_]:
        """Whether the half cannot give way at each angle, as the diagram has it.

        At the edges of an arc it cannot, if just beside them it cannot: motions do not jump.
        """
        slack = NEAR_DEG if edges else -NEAR_DEG
        found = np.zeros(len(angle_deg), dtype=bool)
        for arc in self.closed:
            found |= is_in(angle_deg, arc, slack)
        return found


@dataclass(frozen=True)
class Choices:
    """The options of each rule at each node, and the room of each part after what is settled.

    Where a rule has but one option its part has to take it: `low` and `high` know of it. It is
    `refused` where some rule has none at some node. With `too_many` stops that a part could get to
    nothing is chosen.
    """

    options: list[list[tuple[Option, ...]]]
    low: list[Floats]
    high: list[Floats]
    refused: bool = False
    too_many: bool = False


def sides_of(
    diagram: TimingDiagram, parts: Sequence[Part], rules: Sequence[ClearanceRule]
) -> list[tuple[Side, Side]]:
    """Return both sides of each rule: its halves that may give way."""
    names = [part.motion.name for part in parts]

    def side(condition: Condition) -> Side:
        closed = condition.opposite.arcs(diagram)
        if condition.motion not in names:
            return Side(condition, None, tuple(unwrap(closed)))
        number = names.index(condition.motion)
        return Side(condition, number, tuple(unwrap(intersect(closed, arcs(parts[number].still)))))

    return [(side(rule.when.opposite), side(rule.only_while)) for rule in rules]


def choices(
    parts: Sequence[Part],
    sides: Sequence[tuple[Side, Side]],
    angle_deg: Floats,
    peak: float,
) -> Choices:
    """Return what each rule leaves to choose at each node if no weighted peak is above `peak`."""
    reaches = [part.reach(angle_deg, part.most(peak)) for part in parts]
    low, high = [low for low, _ in reaches], [high for _, high in reaches]
    if any(
        part.motion.is_indexing and np.any(most - least > _MOST_STOPS * abs(part.motion.pitch_mm))
        for part, least, most in zip(parts, low, high, strict=True)
    ):
        return Choices([], low, high, too_many=True)
    options: list[list[tuple[Option, ...]]] = []
    for _ in range(2):  # what one rule settles, leaves another one less
        options = []
        for both in sides:
            closed = [side.is_closed(angle_deg, edges=True) for side in both]
            options.append([])
            for node in range(len(angle_deg)):
                room = [(float(a[node]), float(b[node])) for a, b in zip(low, high, strict=True)]
                found = _options(parts, both, [bool(c[node]) for c in closed], room)
                if not found:
                    return Choices(options, low, high, refused=True)
                if len(found) == 1:
                    _settle(found[0], low, high, node)
                options[-1].append(found)
    return Choices(options, low, high)


def _options(
    parts: Sequence[Part],
    both: tuple[Side, Side],
    closed: Sequence[bool],
    room: Sequence[tuple[float, float]],
) -> tuple[Option, ...]:
    """Return the options of a rule in the room of all parts; of one that always holds, only it."""
    found = []
    for side, is_closed in zip(both, closed, strict=True):
        if is_closed:
            continue
        if side.part is None:
            return (_NOTHING,)
        low, high = room[side.part]
        motion = parts[side.part].motion
        for interval in intervals(motion, side.condition, low - _ROUNDING_MM, high + _ROUNDING_MM):
            option = Option(side.part, interval)
            if interval.low_mm <= low and interval.high_mm >= high:
                return (option,)
            found.append(option)
    return tuple(found)


def _settle(only: Option, low: list[Floats], high: list[Floats], node: int) -> None:
    """Leave a part at a node the interval of the only option of a rule there."""
    part, (least, most) = only
    if part is not None:
        low[part][node] = max(low[part][node], least)
        high[part][node] = min(high[part][node], most)


def cell_options(
    both: tuple[Side, Side], middle_deg: float, ends: tuple[Option, Option], places: Places
) -> tuple[Option, ...]:
    """Return the options with which a rule can be kept over a whole cell: one if it is settled.

    `ends` are those chosen at its ends, `places` the positions of the parts there. An option
    settles the cell if it holds at both; if none does, the rule passes from the one to the other.
    """
    middle = np.array([middle_deg])
    for side in both:
        if side.part is None and not side.is_closed(middle, edges=False)[0]:
            return (_NOTHING,)
    free = tuple(option for option in ends if option.part is not None)
    settled = [option for option in free if all(option.holds(place) for place in places)]
    return tuple(settled[:1]) or free
