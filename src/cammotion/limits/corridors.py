"""Corridors: where in the turn a motion has to stand still, and how far it may be elsewhere.

Clearance rules, together with the other motions of a diagram, leave one motion a corridor: the die
has to be down while it works, and may not be deeper than 19 mm while the mill is on its way. What
it does within the corridor is its own choice. `limits` looks for the best.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from cammotion.limits.bands import Band, check_agree, make_band
from cammotion.limits.standing import check_stands, pair_of, still_arcs
from cammotion.machine.arcs import ROUNDING_DEG, Arc, unwrap
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.segments import POSITION, told
from cammotion.quantities import Floats, InputError
from cammotion.rules.checks import every_rule
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition, Moving
from cammotion.rules.rule import ROUNDING_MM, Rule

_SLACK_DEG = 10 * ROUNDING_DEG  # ends of arcs that are nearer to each other are one node
NEAR_DEG = 3 * _SLACK_DEG
"""So near to an end of an arc a node is at it."""

Flags = NDArray[np.bool_]


@dataclass(frozen=True)
class Corridor:
    """The room of a motion at the nodes of a grid over one turn.

    `angle_deg` are the cam angles of the nodes in order, at most a turn apart; `low_mm` and
    `high_mm` the least and the largest position at each, infinite where it is free; `still` tells
    where the motion has to stand. After the turn it is `pitch_mm` further. `bands` are the arcs
    over which it has to be about a stop besides, whichever it is; `about` chooses the stops.
    `cells` are as many as were asked for; the ends of arcs make a few more.
    """

    angle_deg: Floats
    low_mm: Floats
    high_mm: Floats
    still: Flags
    pitch_mm: float
    bands: tuple[Band, ...] = ()
    cells: int = 0

    def about(self, stops: Iterable[float]) -> "Corridor":
        """Return the corridor with the bands about these stops, given by their numbers."""
        low, high = self.low_mm.copy(), self.high_mm.copy()
        for band, stop in zip(self.bands, stops, strict=True):
            least, most = band.limits_mm(stop)
            low[band.nodes] = np.maximum(low[band.nodes], least)
            high[band.nodes] = np.minimum(high[band.nodes], most)
        return replace(self, low_mm=low, high_mm=high, bands=())

    @property
    def cells_deg(self) -> Floats:
        """How far it is from each node to the next one."""
        return cells_of(self.angle_deg)

    @property
    def inner(self) -> Flags:
        """Which nodes are in no still arc and beside none: there it may be held off its limits."""
        return ~(self.still | np.roll(self.still, 1) | np.roll(self.still, -1))

    def next_of(self, limit_mm: Floats) -> Floats:
        """Return a limit at the end of each cell, given at its beginning."""
        return np.append(limit_mm[1:], limit_mm[0] + self.pitch_mm)

    @property
    def still_cells(self) -> Flags:
        """Over which cells it stands: those with both ends in still arcs, at one height.

        Where that is the cell between two arcs, it need not stand there, but nothing drives it.
        """
        at_one_height = np.isclose(self.low_mm, self.next_of(self.low_mm), rtol=0, atol=ROUNDING_MM)
        return self.still & np.roll(self.still, -1) & at_one_height

    @property
    def stretches(self) -> list[tuple[int, int]]:
        """The nodes at which it may begin and end to move; past the last, the next turn counts on.

        Empty for a motion that need not stand anywhere, and for one that has to everywhere.
        """
        size = len(self.still)
        ends = [int(n) for n in np.flatnonzero(self.still & ~self.still_cells)]
        return [(n, next(m for m in range(n + 1, 2 * size) if self.still[m % size])) for n in ends]

    @property
    def steps_to_bands(self) -> Floats:
        """Which steps, from band to band, add up to the stop of each: a row of 0 and 1 for each.

        The first band after a still arc is a step from stop number 0, one that follows a step from
        the band before. What the motion can do in between decides on this step, and not at which
        stop it is.
        """
        first = np.array([band.nodes[np.argmax(band.ahead_mm == 0)] for band in self.bands], int)
        since = np.mod(first[:, None] - np.flatnonzero(self.still), len(self.still)).min(axis=1)
        begin = np.mod(first - since, len(self.still))
        order = np.argsort(np.argsort(since, kind="stable"))
        steps = (begin[:, None] == begin) & (order[:, None] >= order)
        return np.asarray(steps, dtype=np.float64)


def cells_of(angle_deg: Floats) -> Floats:
    """Return how far it is from each node to the next one; the last is a turn before the first."""
    return np.diff(np.append(angle_deg, angle_deg[0] + DEG_PER_TURN))


def corridor(  # noqa: PLR0913 - all but three are given by name
    diagram: TimingDiagram,
    motion: str,
    rules: Rule | Iterable[Rule],
    *,
    still: Iterable[Arc] = (),
    travel_mm: tuple[float, float] | None = None,
    cells: int = 720,
) -> Corridor:
    """Return the corridor that the rules and the other motions of a diagram leave to a motion.

    Over the arcs `still`, pairs of cam angles in deg, the motion stands where it does in the
    diagram; `travel_mm` are the ends of its travel, in the turn with which it begins. The grid has
    `cells` cells to the turn, and the ends of all arcs are nodes of it. Raises InputError for what
    is no rule, no still arc or no travel, for an arc over which the motion does not stand, and
    where rules and travel do not let it.

    >>> import cammotion as cm
    >>> given = cm.EXAMPLE
    >>> room = corridor(given.diagram, "die", given.rule, still=[(205, 305)], cells=36)
    >>> [float(limit) for limit in room.high_mm[room.still]][:2]
    [50.0, 50.0]
    """
    moved = diagram[motion]
    duties = list(_duties(diagram, moved.name, rules))
    arcs = still_arcs(moved, still)
    check_stands(moved, arcs)
    ends = [end for arc in (*arcs, *(arc for _, arc in duties)) for end in arc]
    nodes = even_nodes(moved.start_deg, ends, cells)
    places = np.asarray(moved.position_mm(nodes))
    is_still = np.any([is_in(nodes, arc) for arc in arcs], axis=0)
    low, high = (np.full(len(nodes), limit) for limit in travel_ends(travel_mm))
    # a pitch further, at the end of the turn, it is within its travel too
    low[0], high[0] = low[0] - min(moved.pitch_mm, 0), high[0] - max(moved.pitch_mm, 0)
    bands = []
    for condition, arc in duties:
        here = is_in(nodes, arc)
        if moved.is_indexing:
            ahead = moved.pitch_mm * _turns(nodes, arc)[here]
            bands.append(make_band(moved, condition, arc, np.flatnonzero(here), ahead))
        elif condition.is_beyond:
            low[here] = np.maximum(low[here], condition.limit_mm)
        else:
            high[here] = np.minimum(high[here], condition.limit_mm)
    limited = Corridor(nodes, low, high, is_still, moved.pitch_mm, cells=cells)
    return _standing(motion, limited, [band for band in bands if band], places)


def _standing(name: str, limited: Corridor, bands: list[Band], places: Floats) -> Corridor:
    """Return the corridor of a motion that stands where it has to, at its places.

    A band in which it stands is about the stop that it is at there. The others remain.
    """
    still = limited.still
    known = [band for band in bands if still[band.nodes].any()]
    stops = [band.stops_at(places[band.nodes])[still[band.nodes]][0] for band in known]
    room = replace(limited, bands=tuple(known)).about(stops)
    too_far = still & ((places < room.low_mm - ROUNDING_MM) | (places > room.high_mm + ROUNDING_MM))
    if np.any(too_far):
        place, angle = places[too_far][0], room.angle_deg[too_far][0] % DEG_PER_TURN
        raise InputError(
            f"At {told(angle)} deg the {name} has to stand at {place:g} mm, where the rules or the "
            "travel do not let it be: change them, or the still arc."
        )
    check_agree(name, bands, room.angle_deg)
    room.low_mm[still] = room.high_mm[still] = places[still]
    return replace(room, bands=tuple(band for band in bands if not still[band.nodes].any()))


def _duties(
    diagram: TimingDiagram, motion: str, rules: Rule | Iterable[Rule]
) -> Iterator[tuple[Condition, Arc]]:
    """Yield what the motion has to keep, and over which arcs in one piece: that no rule breaks."""
    for rule in of_places(diagram, motion, rules):
        for own, other in (
            (rule.when.opposite, rule.only_while.opposite),
            (rule.only_while, rule.when),
        ):
            if own.motion == motion:
                for arc in unwrap(other.arcs(diagram)):
                    yield own, arc


def of_places(
    diagram: TimingDiagram, motion: str, rules: Rule | Iterable[Rule]
) -> tuple[ClearanceRule, ...]:
    """Return the rules in which a motion has a part.

    Raises InputError for one that does not say where it may be: of a distance, or whether it moves.
    """
    found, given = [], every_rule(diagram, rules)
    motion = diagram[motion].name  # it may be given in another case
    for rule in given:
        if motion not in rule.motions:
            continue
        halves = (rule.when, rule.only_while) if isinstance(rule, ClearanceRule) else ()
        own = [half for half in halves if half.motion == motion]
        if not isinstance(rule, ClearanceRule) or isinstance(own[0], Moving):
            raise InputError(
                f"The rule '{rule}' does not say between which positions the {motion} may be, and "
                "here all depends on that: leave it out, and give the dwells that it needs as "
                "still arcs or what it asks as a ClearanceRule of beyond or within."
            )
        found.append(rule)
    return tuple(found)


def travel_ends(travel_mm: Any) -> tuple[float, float]:
    """Return the lower and the upper end of a travel in mm, infinite for None.

    Raises InputError for what is no pair of positions, and for the upper end given first.
    """
    if travel_mm is None:
        return -np.inf, np.inf
    ends = pair_of(
        travel_mm, "The travel", "its lower and its upper end in mm, for example (0, 50)"
    )
    low, high = (POSITION.number(end) for end in ends)
    if low >= high:
        raise InputError(
            f"The travel goes from {low:g} to {high:g} mm; give the lower end first, for example "
            "(0, 50)."
        )
    return low, high


def even_nodes(start: float, ends: Sequence[float], cells: int) -> Floats:
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


def is_in(angles_deg: Floats, arc: Arc, slack_deg: float = NEAR_DEG) -> Flags:
    """Return which angles are in an arc, or outside of it by less than a slack."""
    start, end = arc
    inside: Flags = _since(angles_deg, start, slack_deg) <= end - start + slack_deg
    return inside


def _turns(nodes: Floats, arc: Arc) -> Floats:
    """Return for each node how many turns it is further in the arc: 1 past the grid's end."""
    begins = nodes[0] + _since(arc[0], nodes[0])
    turns: Floats = np.round((begins + _since(nodes, arc[0]) - nodes) / DEG_PER_TURN)
    return turns


def _since(angles: Any, start: float, slack: float = NEAR_DEG) -> Floats:
    """Return how far angles are after another one, within a turn; what is just before it is 0."""
    since: Floats = np.mod(np.asarray(angles) - start + slack, DEG_PER_TURN) - slack
    return since
