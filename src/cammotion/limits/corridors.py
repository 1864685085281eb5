"""Corridors: where in the turn a motion has to stand still, and how far it may be elsewhere.

Clearance rules, together with the other motions of a diagram, leave one motion a corridor: the die
has to be down while it works, and may not be deeper than 19 mm while the mill is on its way. What
it does within the corridor is its own choice. `limits` looks for the best.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cammotion.machine.arcs import ROUNDING_DEG, Arc, intersect, unwrap
from cammotion.machine.arcs import arcs as as_set
from cammotion.machine.clearance import ClearanceRule, Condition, as_rules
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE, POSITION
from cammotion.quantities import Floats, InputError, shorten

_ARCS = "a list of pairs of cam angles, for example [(205, 305)]"
_ROUNDING_MM = 1e-9
_SLACK_DEG = 10 * ROUNDING_DEG  # ends of arcs that are nearer to each other are one node

Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Corridor:
    """The room of a motion at the nodes of a grid over one turn.

    `angle_deg` are the cam angles of the nodes in order, at most a turn apart; `low_mm` and
    `high_mm` the least and the largest position at each, infinite where it is free; `still` tells
    where the motion has to stand. After the turn it is `pitch_mm` further.
    """

    angle_deg: Floats
    low_mm: Floats
    high_mm: Floats
    still: Flags
    pitch_mm: float

    @property
    def cells_deg(self) -> Floats:
        """How far it is from each node to the next one; the last cell ends a turn after the 1st."""
        return np.diff(np.append(self.angle_deg, self.angle_deg[0] + DEG_PER_TURN))

    def next_of(self, limit_mm: Floats) -> Floats:
        """Return a limit at the end of each cell, given at its beginning."""
        return np.append(limit_mm[1:], limit_mm[0] + self.pitch_mm)

    @property
    def still_cells(self) -> Flags:
        """Over which cells it has to stand: those with both ends in one still arc."""
        at_one_height = np.isclose(
            self.low_mm, self.next_of(self.low_mm), rtol=0, atol=_ROUNDING_MM
        )
        return self.still & np.roll(self.still, -1) & at_one_height

    @property
    def stretches(self) -> list[tuple[int, int]]:
        """The nodes at which it may begin and end to move; past the last, the next turn counts on.

        Empty for a motion that need not stand anywhere.
        """
        size = len(self.still)
        ends = [n for n in range(size) if self.still[n] and not self.still_cells[n]]
        return [(n, next(m for m in range(n + 1, 2 * size) if self.still[m % size])) for n in ends]


def corridor(  # noqa: PLR0913 - all but three are given by name
    diagram: TimingDiagram,
    motion: str,
    rules: ClearanceRule | Iterable[ClearanceRule],
    *,
    still: Iterable[Arc] = (),
    travel_mm: tuple[float, float] | None = None,
    cells: int = 720,
) -> Corridor:
    """Return the corridor that the rules and the other motions of a diagram leave to a motion.

    The grid has `cells` cells to the turn; the ends of all arcs are nodes of it. Parameters and
    errors are those of `limits.least_acceleration`.
    """
    moved = diagram[motion]
    duties = list(_duties(diagram, motion, rules))
    arcs = _still_arcs(moved, still)
    _check_stands(moved, arcs)
    ends = [end for arc in (*arcs, *(arc for _, arc in duties)) for end in arc]
    nodes = _nodes(moved.start_deg, ends, cells)
    places = np.asarray(moved.position_mm(nodes))
    low, high = (np.full(len(nodes), limit) for limit in _travel(travel_mm))
    for condition, arc in duties:
        least, most = _band(moved, condition, places)
        here = _is_in(nodes, arc)
        low[here], high[here] = np.maximum(low, least)[here], np.minimum(high, most)[here]
    is_still = np.any([_is_in(nodes, arc) for arc in arcs], axis=0)
    too_far = is_still & ((places < low - _ROUNDING_MM) | (places > high + _ROUNDING_MM))
    if np.any(too_far):
        place, angle = places[too_far][0], nodes[too_far][0] % DEG_PER_TURN
        raise InputError(
            f"At {angle:g} deg the {motion} has to stand at {place:g} mm, where the rules or the "
            "travel do not let it be: change them, or the still arc."
        )
    low[is_still] = high[is_still] = places[is_still]
    return Corridor(nodes, low, high, is_still, moved.pitch_mm)


def _duties(
    diagram: TimingDiagram, motion: str, rules: ClearanceRule | Iterable[ClearanceRule]
) -> Iterator[tuple[Condition, Arc]]:
    """Yield what the motion has to keep, and over which arc, so that no rule is broken."""
    for rule in as_rules(diagram, rules):
        for own, other in (
            (rule.when.opposite, rule.only_while.opposite),
            (rule.only_while, rule.when),
        ):
            if own.motion == motion:
                for arc in other.arcs(diagram):
                    yield own, arc


def _band(motion: Motion, condition: Condition, places: Floats) -> tuple[Floats, Floats]:
    """Return between which positions a condition holds; for a turret, about the stop it is at."""
    limit, free = condition.limit_mm, np.full(len(places), np.inf)
    if not motion.is_indexing:
        at = np.full(len(places), limit)
        return (at, free) if condition.is_beyond else (-free, at)
    pitch = abs(motion.pitch_mm)
    passed = (places - motion.start_mm) / pitch
    if condition.is_beyond:
        stop = motion.start_mm + np.floor(passed) * pitch
        return stop + limit, stop + pitch - limit
    stop = motion.start_mm + np.round(passed) * pitch
    return stop - limit, stop + limit


def _still_arcs(motion: Motion, still: Any) -> list[Arc]:
    given = list(still) if isinstance(still, Iterable) else []
    if not given:
        raise InputError(
            f"The arcs over which the {motion.name} has to stand are {shorten(still)}: give at "
            "least one, for example still=[(205, 305)]."
        )
    pairs = [_pair(arc, "A still arc", _ARCS) for arc in given]
    arcs = [(CAM_ANGLE.number(start), CAM_ANGLE.number(end)) for start, end in pairs]
    for start, end in arcs:
        if not start < end < start + DEG_PER_TURN:
            raise InputError(
                f"The still arc goes from {start:g} to {end:g} deg; it has to end after it begins "
                "and within a turn: give, for example, (205, 305)."
            )
    return arcs


def _check_stands(motion: Motion, still: list[Arc]) -> None:
    moves = as_set((move.from_deg, move.to_deg) for move in motion.moves)
    for start, end in still:
        for first, last in unwrap(intersect(as_set([(start, end)]), moves)):
            raise InputError(
                f"In the still arc from {start:g} to {end:g} deg the {motion.name} moves, from "
                f"{first:g} to {last:g} deg; a still arc is one over which it stands: give one of "
                "its dwells."
            )


def _pair(given: Any, what: str, fix: str) -> tuple[float, float]:
    try:
        first, second = given
    except (TypeError, ValueError):
        raise InputError(f"{what} is {shorten(given)}: give {fix}.") from None
    return first, second


def _travel(travel_mm: Any) -> tuple[float, float]:
    if travel_mm is None:
        return -np.inf, np.inf
    ends = _pair(travel_mm, "The travel", "its lower and its upper end in mm, for example (0, 50)")
    low, high = (POSITION.number(end) for end in ends)
    if low >= high:
        raise InputError(
            f"The travel goes from {low:g} to {high:g} mm; give the lower end first, for example "
            "(0, 50)."
        )
    return low, high


def _nodes(start: float, ends: Sequence[float], cells: int) -> Floats:
    """Return an even grid over the turn with all `ends` in it, and nothing too near to them."""
    turn, step = DEG_PER_TURN, DEG_PER_TURN / cells
    fixed = np.sort(np.mod(np.asarray(ends, dtype=np.float64) - start + _SLACK_DEG, turn))
    fixed = fixed[np.diff(fixed, prepend=-turn) > 2 * _SLACK_DEG]
    fixed = np.maximum(fixed - _SLACK_DEG, 0.0)  # what is just below a turn is its beginning
    even = np.arange(cells) * step
    if fixed.size:
        away = np.abs((even[:, None] - fixed + turn / 2) % turn - turn / 2).min(axis=1)
        even = even[away > step / 2]
    return start + np.sort(np.concatenate([even, fixed]))


def _is_in(nodes: Floats, arc: Arc) -> Flags:
    start, end = arc
    since = np.mod(nodes - start + 3 * _SLACK_DEG, DEG_PER_TURN)
    return np.asarray(since <= end - start + 6 * _SLACK_DEG)
