"""What no motions of several parts can be below, all sought at once: a mixed-integer program.

The unknowns are the positions of each part at the nodes of a grid over a turn, for each rule and
node which option is taken, and the largest of the weighted peaks, as a share of a peak that
bounds what is of interest. Only what every motion keeps is asked:

- Over a stand it stands. Elsewhere it is where it can get to from its stands (`Part.reach`).
- A divided difference of second order is a mean of the acceleration between its nodes, and no mean
  is above the peak. At the end of a stand the motion rests; then the node counts twice.
- At each node each rule is kept, so one of its options holds. What happens between the nodes is
  not asked; nor is anything about the order, the number or the place of the changes from one
  option to another.

So the positions of any motions that keep the rules, with no weighted peak above the one given,
are a solution, and what no solution is below no such motions are below.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from cammotion.limits.corridors import cells_of
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats
from cammotion.whole.mixed import Rows
from cammotion.whole.parts import Part
from cammotion.whole.sides import Choices, Option, Side, choices

_ROUNDING_MM = 1e-6


@dataclass(frozen=True)
class Outline:
    """What the program from below has found: a bound, and positions that come near to it.

    `angle_deg` are the nodes, and one more, a turn after the first. `places` has the positions of
    each part there, `chosen` the option of each rule; both are None where the time was too short.
    `bound` is a share of the peak asked for, infinite if no motions have a peak below it.
    """

    angle_deg: Floats
    bound: float
    places: list[Floats] | None = None
    chosen: list[list[Option]] | None = None


def outline(  # noqa: PLR0913 - the last is given by name
    parts: Sequence[Part],
    sides: Sequence[tuple[Side, Side]],
    angle_deg: Floats,
    peak: float,
    seconds: float,
    *,
    least: float = 0.0,
) -> Outline:
    """Return what the largest weighted peak is not below, as a share of `peak` in mm/deg2.

    It is known not to be below the share `least`.
    """
    closed = np.append(angle_deg, angle_deg[0] + DEG_PER_TURN)
    room = choices(parts, sides, angle_deg, peak)
    if room.too_many:
        return Outline(closed, 0.0)
    if room.refused or any(
        np.any(low > high + _ROUNDING_MM) for low, high in zip(room.low, room.high, strict=True)
    ):
        return Outline(closed, np.inf)
    rows = Rows()
    share = rows.unknown(min(least, 1.0), 1.0, cost=1.0)
    positions = [
        rows.unknowns(np.minimum(low, high), np.maximum(low, high))
        for low, high in zip(room.low, room.high, strict=True)
    ]
    for part, position in zip(parts, positions, strict=True):
        _hold(rows, part, position, angle_deg, (share, peak))
    picks = [_pick(rows, room, positions, of_rule) for of_rule in room.options]
    found = rows.solve_with_proof(seconds)
    if found.unknowns is None:
        return Outline(closed, 0.0 if found.bound is None else found.bound)
    x = found.unknowns
    places = [
        np.append(x[position], x[position[0]] + part.motion.pitch_mm)
        for part, position in zip(parts, positions, strict=True)
    ]
    taken = [
        [of_node[int(np.argmax(x[pick]))] if pick else of_node[0] for of_node, pick in both]
        for both in (zip(o, p, strict=True) for o, p in zip(room.options, picks, strict=True))
    ]
    chosen = [[*of_rule, _a_turn_on(parts, of_rule[0])] for of_rule in taken]
    return Outline(closed, found.bound or 0.0, places, chosen)


def _a_turn_on(parts: Sequence[Part], option: Option) -> Option:
    return option if option.part is None else option.moved(parts[option.part].motion.pitch_mm)


def _hold(
    rows: Rows,
    part: Part,
    position: list[int],
    angle_deg: Floats,
    limit: tuple[int, float],
) -> None:
    """Bind the means of a part's acceleration to its peak."""
    share, peak = limit
    standing = ~np.isnan(part.standing(angle_deg))
    for terms, added, halves in differences(angle_deg, standing, part.motion.pitch_mm):
        sums = [(position[node], factor) for node, factor in terms]
        if part.weight:
            most = peak / part.weight * halves
            rows.row([*sums, (share, -most)], -np.inf, -added)
            rows.row([*sums, (share, most)], -added, np.inf)
        if np.isfinite(part.cap):
            rows.row(sums, -part.cap * halves - added, part.cap * halves - added)


def differences(
    angle_deg: Floats, standing: Floats, pitch_mm: float
) -> list[tuple[list[tuple[int, float]], float, float]]:
    """Return all divided differences of second order of positions at nodes, over a turn.

    Each is given by nodes and factors, by what the pitch adds, and by the number that the sum of
    both is to be divided by for a mean of the acceleration. None is within a stand.
    """
    count = len(angle_deg)
    ahead = cells_of(angle_deg)
    found = []
    for node in range(count):
        before, after = (node - 1) % count, (node + 1) % count
        left, right = ahead[before], ahead[node]
        back, on = -pitch_mm if node == 0 else 0.0, pitch_mm if after == 0 else 0.0
        if not standing[node]:
            a, c = right / (left + right), left / (left + right)
            terms = [(before, a), (node, -1.0), (after, c)]
            found.append((terms, a * back + c * on, left * right / 2))
            continue
        if not standing[after]:
            found.append(([(after, 1.0), (node, -1.0)], on, right**2 / 2))
        if not standing[before]:
            found.append(([(before, 1.0), (node, -1.0)], back, left**2 / 2))
    return found


def _pick(
    rows: Rows, room: Choices, positions: list[list[int]], of_rule: list[tuple[Option, ...]]
) -> list[list[int]]:
    """Let each node take one of its options; return the numbers of those unknowns."""
    picks: list[list[int]] = []
    for node, options in enumerate(of_rule):
        if len(options) == 1:
            picks.append([])
            continue
        pick = rows.choice(len(options))
        picks.append(pick)
        for part in {option.part for option in options if option.part is not None}:
            low, high = room.low[part][node], room.high[part][node]
            mine = [
                (one, o.interval) for one, o in zip(pick, options, strict=True) if o.part == part
            ]
            place = (positions[part][node], 1.0)
            above = [(one, low - max(o.low_mm, low)) for one, o in mine]
            below = [(one, high - min(o.high_mm, high)) for one, o in mine]
            if any(factor for _, factor in above):
                rows.row([place, *above], low, np.inf)
            if any(factor for _, factor in below):
                rows.row([place, *below], -np.inf, high)
    return picks
