"""How good could it get: the least peak acceleration that any motion could have.

A motion law is one choice among all the motions that keep the rules. Here nothing is chosen: the
position at every node of a fine grid is an unknown, and a linear program finds the least peak. It
is solved twice, from both sides.

From below: a divided difference of second order is a mean of the acceleration between its nodes,
and a mean is never larger than the peak. So whoever asks only that no such difference exceeds the
peak asks less than is asked of a motion, and no motion has a smaller peak than comes out. From
above: the acceleration is a constant over each cell, or with a limit to the jerk a straight line.
That is a motion, which can be built, so the best of all has no larger peak. In between lies the
least peak of all; the finer the grid, the nearer the two come.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from cammotion.limits.corridors import Corridor, corridor
from cammotion.limits.grid_motion import GridMotion
from cammotion.machine.arcs import Arc
from cammotion.machine.clearance import ClearanceRule
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity

Matrix = Any  # SciPy's sparse matrices come without types
System = tuple[Sequence[Matrix], Sequence[Floats]]
"""Rows of a program, and what they may be at most or have to be."""

_JERK_LIMIT = Quantity("jerk limit", "m/s³", example=20)
_CELLS = Quantity("number of cells", "", example=720, low=12, high=2880, low_included=True)
_ROUNDS = 6  # of mending a motion that strays between two nodes
_KEPT_MM = 1e-6  # the solver's rounding stays within the corridor
_STEADY = 1e-6  # the price of a change of acceleration, for a motion without needless ones
_SCALE = 100.0  # of the objective, so that this price is more than the solver's rounding
_SOLVED, _INFEASIBLE = 0, 2
_ACCELERATION, _JERK = 2, 3  # the orders of these derivatives
_DIGITS = 4


@dataclass(frozen=True, repr=False)
class LeastAcceleration:
    """The least peak acceleration that any motion of one mechanism could have.

    `bound` in m/s2 is what no motion that keeps the rules can be below; `motion` is one that keeps
    them and comes near to it. The least peak of all lies between `bound` and `reached`.
    """

    diagram: TimingDiagram
    bound: float
    motion: Motion
    jerk_limit: float

    @property
    def reached(self) -> float:
        """The peak acceleration of `motion` in m/s2, from its own laws."""
        return self.design.peak_acceleration(self.motion.name)

    @cached_property
    def design(self) -> TimingDiagram:
        """The diagram with `motion` in it, to draw, to check and to animate."""
        return self.diagram.with_motion(self.motion)

    def __repr__(self) -> str:
        """Say between which two values it lies, rounded away from what is between them."""
        digits = 10.0**_DIGITS
        low = np.floor(self.bound * digits) / digits
        high = np.ceil(self.reached * digits) / digits
        return (
            f"The least peak acceleration of the {self.motion.name} lies between "
            f"{low:.{_DIGITS}f} and {high:.{_DIGITS}f} m/s²."
        )


def least_acceleration(  # noqa: PLR0913 - all but three are given by name
    diagram: TimingDiagram,
    motion: str,
    rules: ClearanceRule | Iterable[ClearanceRule],
    *,
    still: Iterable[Arc],
    travel_mm: tuple[float, float] | None = None,
    jerk_limit: float = np.inf,
    cells: int = 720,
) -> LeastAcceleration:
    """Return the least peak acceleration of one motion, whatever its law, and a motion that has it.

    The motion is free but for this: it keeps every rule, the other motions of the diagram being as
    they are; over the arcs `still`, pairs of cam angles in deg, it stands where it stands in the
    diagram; with `travel_mm` it stays between two positions; with `jerk_limit`, in m/s3, its jerk
    is nowhere larger. The grid has `cells` cells to the turn, 12 to 2880. Raises InputError for
    what is out of range, for an arc over which the motion does not stand, and where no motion
    keeps all of this.

    >>> import cammotion as cm
    >>> mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
    >>> die = cm.motion(
    ...     "die", cm.rise(50, over_deg=55), cm.dwell(100),
    ...     cm.return_(50, over_deg=55), cm.dwell(150), start_deg=150)
    >>> machine = cm.TimingDiagram([mill, die], rate_per_hour=2000)
    >>> rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
    >>> least_acceleration(machine, "die", rule, still=[(205, 305)], travel_mm=(0, 50))
    The least peak acceleration of the die lies between 0.5189 and 0.5190 m/s².
    """
    is_free = isinstance(jerk_limit, float) and jerk_limit == np.inf
    most_jerk = np.inf if is_free else _JERK_LIMIT.number(jerk_limit)
    grid = _whole(_CELLS.number(cells))
    room = corridor(diagram, motion, rules, still=still, travel_mm=travel_mm, cells=grid)
    seconds = room.cells_deg * (diagram.cycle_time_s / DEG_PER_TURN)
    bound = _bound(room, seconds, most_jerk * MM_PER_M)
    curve = _reach(room, seconds, most_jerk * MM_PER_M)
    found = curve.build(diagram[motion], room)
    return LeastAcceleration(diagram, bound / MM_PER_M, found, most_jerk)


def _whole(cells: float) -> int:
    if cells != round(cells):
        raise InputError(
            f"The number of cells is {cells:g}; it has to be a whole number: give, for example, "
            f"{round(cells)}."
        )
    return round(cells)


def _bound(room: Corridor, seconds: Floats, most_jerk: float) -> float:
    """Return what the peak acceleration cannot be below, in mm/s2: the program from below.

    The unknowns are the positions, their differences of each order, reckoned from those of the
    order before, and the peak. (As rows of the positions alone, those of third order are so steep
    that the solver can take minutes.)
    """
    from scipy import sparse

    steps = _differences(room, seconds, _JERK if np.isfinite(most_jerk) else _ACCELERATION)
    ends = np.cumsum([len(seconds), *(matrix.shape[0] for matrix, _ in steps), 1])
    unknowns = sparse.identity(ends[-1], format="csr")
    parts = [unknowns[first:last] for first, last in pairwise([0, *ends])]
    equal = [matrix @ parts[n] - parts[n + 1] for n, (matrix, _) in enumerate(steps)]
    beyond = [-added for _, added in steps]
    peaks = sparse.csr_matrix(np.ones((parts[_ACCELERATION].shape[0], 1))) @ parts[-1]
    rows = [side * parts[_ACCELERATION] - peaks for side in (1, -1)]
    high = np.full(ends[-1], np.inf)
    low = -high
    low[: ends[0]], high[: ends[0]], low[-1] = room.low_mm, room.high_mm, 0.0
    if np.isfinite(most_jerk):
        third = slice(ends[_JERK - 1], ends[_JERK])
        low[third], high[third] = -most_jerk, most_jerk
    at_most = rows, [np.zeros(peaks.shape[0])] * 2
    bounds = np.column_stack([low, high])
    objective = np.eye(1, ends[-1], ends[-1] - 1)[0]
    refusal = (
        "No motion keeps all of this: allow more jerk or more travel, a shorter still arc, or "
        "weaker rules."
    )
    return float(_solve(objective, at_most, (equal, beyond), bounds, refusal)[-1])


def _differences(room: Corridor, seconds: Floats, orders: int) -> list[tuple[Matrix, Floats]]:
    """Return how the divided differences of each order, times order!, follow from those before.

    Each is a matrix, for those of the first order upon the positions, and what the pitch adds. A
    difference is a mean of the derivative of its order between its nodes. Where the motion begins
    or ends to move its derivatives are known to be zero: the node counts as often as that is so.
    """
    from scipy import sparse

    nodes, turn = len(seconds), seconds.sum()
    starts = np.cumsum(seconds) - seconds
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


def _reach(room: Corridor, seconds: Floats, most_jerk: float) -> GridMotion:
    """Return a motion with the least peak that a grid can have: the program from above.

    What strays from the corridor between two nodes is held off a little further at both, and the
    program is solved once more.
    """
    inner = ~(room.still | np.roll(room.still, 1) | np.roll(room.still, -1))
    held_off = np.where(inner, _KEPT_MM, 0.0)
    for _ in range(_ROUNDS):
        curve = _solve_motion(room, seconds, most_jerk, held_off)
        strays = curve.strays(room)
        if not strays.any():
            return curve
        held_off += np.where(inner, 1.5 * np.maximum(strays, np.roll(strays, 1)), 0.0)
    raise InputError(
        f"On a grid of {len(seconds)} cells the motion cannot be kept in its corridor between two "
        "nodes: take more cells."
    )


def _solve_motion(
    room: Corridor, seconds: Floats, most_jerk: float, held_off: Floats
) -> GridMotion:
    """Solve for position, velocity and acceleration at the nodes, over a turn that closes.

    The unknowns are these three, the changes of the acceleration (or of the jerk, if it is
    limited) from cell to cell, and the peak.
    """
    from scipy import sparse

    nodes = len(seconds)
    has_limit = bool(np.isfinite(most_jerk))
    one, none = sparse.identity(nodes, format="csr"), sparse.csr_matrix((nodes, nodes))
    following = one[np.roll(np.arange(nodes), -1)]
    late = following if has_limit else one  # takes the acceleration at the end of each cell
    h, peak, no_peak = sparse.diags(seconds), np.ones((nodes, 1)), sparse.csr_matrix((nodes, 1))
    step = following - one
    equal = [
        sparse.hstack([step, -h, -h @ h @ (one / 3 + late / 6), none, no_peak]),
        sparse.hstack([none, step, -h @ (one + late) / 2, none, no_peak]),
    ]
    jerk = sparse.diags(1 / seconds) @ (late - one)
    steady = step @ (jerk * (seconds.sum() / 100) if has_limit else one)
    rows = [sparse.hstack([none, none, side * one, none, -peak]) for side in (1, -1)]
    rows += [sparse.hstack([none, none, side * steady, -one, no_peak]) for side in (1, -1)]
    limits = [np.zeros(4 * nodes)]
    if has_limit:
        rows += [sparse.hstack([none, none, side * jerk, none, no_peak]) for side in (1, -1)]
        limits.append(np.full(2 * nodes, most_jerk))
    rest = np.where(room.still, 0.0, np.inf)
    no_force = rest if has_limit else np.where(room.still_cells, 0.0, np.inf)
    high = [room.high_mm - held_off, rest, no_force, np.full(nodes + 1, np.inf)]
    low = [room.low_mm + held_off, -rest, -no_force, np.zeros(nodes + 1)]
    objective = np.concatenate([np.zeros(3 * nodes), np.full(nodes, _STEADY), [1.0]])
    closing = np.append(np.zeros(nodes - 1), -room.pitch_mm), np.zeros(nodes)
    bounds = np.column_stack([np.concatenate(low), np.concatenate(high)])
    refusal = (
        f"On a grid of {nodes} cells no motion keeps all of this: take more cells, or allow more "
        "jerk or more travel."
    )
    found = _solve(_SCALE * objective, (rows, limits), (equal, closing), bounds, refusal)
    position, velocity, acceleration = found[: 3 * nodes].reshape(3, nodes)
    return GridMotion(seconds, position, velocity, acceleration, late @ acceleration)


def _solve(
    objective: Floats, at_most: System, equal: System, bounds: Floats, refusal: str
) -> Floats:
    """Solve a linear program with HiGHS; `refusal` says what is wrong if it has no solution."""
    from scipy import sparse
    from scipy.optimize import linprog

    for method in ("highs", "highs-ipm"):  # the second where the first cannot tell
        result = linprog(
            objective,
            A_ub=sparse.vstack(at_most[0]).tocsr(),
            b_ub=np.concatenate(at_most[1]),
            A_eq=sparse.vstack(equal[0]).tocsr(),
            b_eq=np.concatenate(equal[1]),
            bounds=bounds,
            method=method,
        )
        if result.status in (_SOLVED, _INFEASIBLE):
            break
    if result.status == _INFEASIBLE:
        raise InputError(refusal)
    if result.x is None:
        raise InputError(f"The linear program was not solved ({result.message}): change the grid.")
    return np.asarray(result.x)
