"""The two programs: what no motion can be below, and the best motion on a grid.

The unknowns are positions in mm at the nodes of a corridor, times being in any unit, and for each
of its bands the whole number of the stop that the motion is about. Both close over the turn.
"""

from itertools import pairwise

import numpy as np

from cammotion.limits.corridors import Corridor
from cammotion.limits.grid_motion import GridMotion
from cammotion.limits.linear import Matrix, Program, Solution, System, solve
from cammotion.quantities import Floats

STEADY = 1e-6
"""The price of a change of acceleration, for a motion without needless ones."""

_SCALE = 1e4  # of the objective, so that this price is more than the solver's rounding
_ACCELERATION, _JERK = 2, 3  # the orders of these derivatives


def from_below(room: Corridor, times: Floats, most_jerk: float) -> Solution:
    """Return what the peak acceleration cannot be below, as the bound of a program.

    The unknowns are the positions, their differences of each order, reckoned from those of the
    order before, and the peak. (As rows of the positions alone, those of third order are so steep
    that the solver can take minutes.)
    """
    steps = _differences(room, times, _JERK if np.isfinite(most_jerk) else _ACCELERATION)
    sizes = [len(times), *(matrix.shape[0] for matrix, _ in steps), 1, len(room.bands)]
    parts, ends = _split(sizes), np.cumsum(sizes)
    equal = [matrix @ parts[n] - parts[n + 1] for n, (matrix, _) in enumerate(steps)]
    beyond = [-added for _, added in steps]
    peaks = parts[-2][[0] * sizes[_ACCELERATION]]
    rows = [side * parts[_ACCELERATION] - peaks for side in (1, -1)]
    high = np.full(ends[-1], np.inf)
    low = -high
    peak = ends[-2] - 1
    low[: ends[0]], high[: ends[0]], low[peak] = room.low_mm, room.high_mm, 0.0
    if np.isfinite(most_jerk):
        third = slice(ends[_JERK - 1], ends[_JERK])
        low[third], high[third] = -most_jerk, most_jerk
    about, limits = _about_stops(room, parts[0], parts[-1])
    at_most = [*rows, *about], [*[np.zeros(sizes[_ACCELERATION])] * 2, *limits]
    bounds = np.column_stack([low, high])
    objective = np.eye(1, ends[-1], peak)[0]
    refusal = (
        "No motion keeps all of this: allow more jerk or more travel, a shorter still arc, or "
        "weaker rules."
    )
    whole, reach = range(ends[-2], ends[-1]), _sizes(room, times, sizes)
    program = Program(objective, at_most, (equal, beyond), bounds, refusal, whole, sizes=reach)
    return solve(program)


def _sizes(room: Corridor, times: Floats, counts: list[int]) -> tuple[Floats, Floats]:
    """Return how large the unknowns of `from_below` can be: fixed, and per unit of the peak.

    The motion starts from rest somewhere. So no velocity is above the peak times the turn, and no
    position is farther from where it stands than the peak times the square of the turn.
    """
    turn, limits = float(times.sum()), np.concatenate([room.low_mm, room.high_mm])
    place = np.abs(limits[np.isfinite(limits)]).max(initial=0.0) + abs(room.pitch_mm)
    spacing = min([band.spacing_mm for band in room.bands], default=1.0)
    stop, stop_per = 2 * (place / spacing + 2), 2 * turn**2 / spacing
    orders = len(counts) - 3  # of the differences
    fixed = [place, *[0.0] * orders, 0.0, stop]
    per = [turn**2, turn, *[1.0] * (orders - 1), 1.0, stop_per]
    return np.repeat(fixed, counts), np.repeat(per, counts)


def _about_stops(room: Corridor, position: Matrix, step: Matrix) -> System:
    """Return the rows that keep positions in the bands, each about a stop.

    `step` are the whole numbers that make up the stops.
    """
    from scipy import sparse

    rows, limits, steps_to = [], [], room.steps_to_bands
    for number, band in enumerate(room.bands):
        stop = sparse.csr_matrix(steps_to[[number] * len(band.nodes)]) @ step
        above = position[band.nodes] - band.spacing_mm * stop
        rows += [above, -above]
        limits += [band.high_mm - band.ahead_mm, band.ahead_mm - band.low_mm]
    return rows, limits


def _differences(room: Corridor, times: Floats, orders: int) -> list[tuple[Matrix, Floats]]:
    """Return how the divided differences of each order, times order!, follow from those before.

    Each is a matrix, for those of the first order upon the positions, and what the pitch adds. A
    difference is a mean of the derivative of its order between its nodes. Where the motion begins
    or ends to move its derivatives are known to be zero: the node counts as often as that is so.
    """
    from scipy import sparse

    nodes, turn = len(times), times.sum()
    starts = np.cumsum(times) - times
    found: list[list[tuple[Matrix, Floats]]] = [[] for _ in range(orders)]
    for first, last in room.stretches:
        repeated = orders - 1
        knots = np.array([first] * repeated + [*range(first, last + 1)] + [last] * repeated)
        places = starts[knots % nodes] + turn * (knots // nodes)
        before = sparse.identity(nodes, format="csr")[knots % nodes]
        added = room.pitch_mm * (knots // nodes)
        for order in range(1, orders + 1):
            gaps = places[order:] - places[:-order]
            weights = np.divide(order, gaps, out=np.zeros_like(gaps), where=gaps > 0)
            found[order - 1].append(
                (sparse.diags(weights) @ (before[1:] - before[:-1]), weights * np.diff(added))
            )
            before, added = sparse.identity(len(gaps), format="csr"), np.zeros(len(gaps))
    return [
        (
            (sparse.block_diag if order else sparse.vstack)([matrix for matrix, _ in each]),
            np.concatenate([added for _, added in each]),
        )
        for order, each in enumerate(found)
    ]


def from_above(
    room: Corridor, times: Floats, most_jerk: float, held_off: Floats
) -> tuple[GridMotion, Floats]:
    """Return the best motion on the grid, `held_off` in mm from its limits, and its stops.

    The unknowns are position, velocity and acceleration at the nodes, the changes of the
    acceleration (or of the jerk, if it is limited) from cell to cell, and the peak.
    """
    from scipy import sparse

    nodes, has_limit = len(times), bool(np.isfinite(most_jerk))
    position, velocity, push, change, peak, step = _split([nodes] * 4 + [1, len(room.bands)])
    following = np.roll(np.arange(nodes), -1)
    late = push[following] if has_limit else push  # the acceleration at the end of each cell
    h, peaks = sparse.diags(times), peak[[0] * nodes]
    equal = [
        position[following] - position - h @ velocity - h @ h @ (push / 3 + late / 6),
        velocity[following] - velocity - h @ (push + late) / 2,
    ]
    closing = [np.append(np.zeros(nodes - 1), -room.pitch_mm), np.zeros(nodes)]
    jerk = sparse.diags(1 / times) @ (late - push)
    rate = jerk * (times.sum() / 100) if has_limit else push
    steady = rate[following] - rate
    rows = [side * push - peaks for side in (1, -1)]
    rows += [side * steady - change for side in (1, -1)]
    limits = [np.zeros(4 * nodes)]
    if has_limit:
        rows += [jerk, -jerk]
        limits.append(np.full(2 * nodes, most_jerk))
    about, about_limits = _about_stops(room, position, step)
    stops = len(room.bands)
    cost = [np.zeros(3 * nodes), np.full(nodes, STEADY), np.ones(1), np.zeros(stops)]
    program = Program(
        _SCALE * np.concatenate(cost),
        ([*rows, *about], [*limits, *about_limits]),
        (equal, closing),
        _ends(room, held_off, has_limit=has_limit),
        f"On a grid of {room.cells} cells no motion keeps all of this: take more cells, allow more "
        "jerk or more travel, or give a still arc where the rules leave it a single position.",
        whole=range(4 * nodes + 1, 4 * nodes + 1 + stops),
    )
    found = solve(program).unknowns
    y, v, a = found[: 3 * nodes].reshape(3, nodes)
    ending = a[following] if has_limit else a
    about_stops = room.steps_to_bands @ np.round(found[len(found) - stops :])
    return GridMotion(times, y, v, a, ending), about_stops


def _ends(room: Corridor, held_off: Floats, *, has_limit: bool) -> Floats:
    """Return the least and the largest value of each unknown of `from_above`."""
    nodes, free = len(room.still), np.full(len(room.bands), np.inf)
    rest = np.where(room.still, 0.0, np.inf)
    no_force = rest if has_limit else np.where(room.still_cells, 0.0, np.inf)
    off = np.minimum(held_off, np.maximum(room.high_mm - room.low_mm, 0) / 4)
    high = [room.high_mm - off, rest, no_force, np.full(nodes + 1, np.inf), free]
    low = [room.low_mm + off, -rest, -no_force, np.zeros(nodes + 1), -free]
    return np.column_stack([np.concatenate(low), np.concatenate(high)])


def _split(sizes: list[int]) -> list[Matrix]:
    """Return the unknowns in groups of these sizes, each as the rows that take them out of all."""
    from scipy import sparse

    ends = np.cumsum([0, *sizes])
    every = sparse.identity(ends[-1], format="csr")
    return [every[first:last] for first, last in pairwise(ends)]
