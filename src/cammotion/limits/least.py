"""How good could it get: the least peak acceleration that any motion could have.

A motion law is one choice among all the motions that keep the rules. Here nothing is chosen: the
position at every node of a fine grid is an unknown, and a linear program finds the least peak. It
is solved twice, from both sides.

From below: a divided difference of second order is a mean of the acceleration between its nodes,
and a mean is never larger than the peak. So whoever asks only that no such difference exceeds the
peak asks less than is asked of a motion, and no motion has a smaller peak than comes out. From
above: the acceleration is a constant over each cell, or with a limit to the jerk a straight line.
That is a motion, which can be built, so the best of all has no larger peak. In between lies the
least peak of all; the finer the grid, the nearer the two come. The number from below is computed
anew from the multipliers that the solver gives, so that it does not rest on the solver's word;
only that no motion at all goes by some stops is left to that.

Both ask of an indexing motion that it is near to a stop, or away from its stops, while another one
is where it may meet it. Which stop that is, is a whole number for each such arc, found by both
programs for themselves.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from cammotion.limits.corridors import Corridor, corridor, of_places, travel_ends
from cammotion.limits.faults import Asked, find_faults
from cammotion.limits.grid_motion import KEPT_MM, GridMotion
from cammotion.limits.programs import from_above, from_below
from cammotion.limits.quickest import limit_of
from cammotion.limits.standing import at_rest, check_begins_at_a_stop, still_arcs
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity, WrongAnswerError, outward
from cammotion.rules.checks import find_violations
from cammotion.rules.rule import Rule

_JERK_LIMIT = Quantity("jerk limit", "m/s³", example=20)
_CELLS = Quantity("number of cells", "", example=720, low=12, high=2880, low_included=True)
_ROUNDING = 1e-6  # of the bound, or in m/s2
_PARTS = 20  # of a turn, the unit of time
_ROUNDS = 6  # of mending a motion that strays between two nodes


@dataclass(frozen=True, repr=False)
class LeastAcceleration:
    """The least peak acceleration that any motion of one mechanism could have.

    `bound` in m/s2 is what no motion that keeps the rules can be below; `motion` is one that keeps
    them and comes near to it. The least peak of all lies between `bound` and `reached`.
    Where no better one was found than that of `diagram`, and that keeps them, it is that one.
    `jerk_m_per_s3` is the limit of the jerk that was asked for.
    """

    diagram: TimingDiagram
    bound: float
    motion: Motion
    jerk_m_per_s3: float

    @property
    def reached(self) -> float:
        """The peak acceleration of `motion` in m/s2, from its own laws."""
        return self.design.peak_acceleration(self.motion.name)

    @cached_property
    def design(self) -> TimingDiagram:
        """The diagram with `motion` in it, to draw, to check and to animate."""
        return self.diagram.with_motion(self.motion)

    def __repr__(self) -> str:
        """Say between which two values it lies."""
        low, high = outward(self.bound, self.reached)
        name = self.motion.name
        if not self.reached:
            return f"Nothing makes the {name} move: it can stand all the turn."
        return f"The least peak acceleration of the {name} lies between {low} and {high} m/s²."


def least_acceleration(  # noqa: PLR0913 - all but three are given by name
    diagram: TimingDiagram,
    motion: str | Motion,
    rules: Rule | Iterable[Rule],
    *,
    still: Iterable[Arc],
    travel_mm: tuple[float, float] | None = None,
    jerk_m_per_s3: float = np.inf,
    cells: int = 720,
) -> LeastAcceleration:
    """Return the least peak acceleration of one motion, whatever its law, and a motion that has it.

    The motion is free but for this: it keeps every rule that it has a part in, each one that says
    where it may be, the other motions of the diagram being as they are; over the arcs `still`,
    pairs of cam angles in deg, it stands where it stands in the diagram; with `travel_mm` it stays
    between two positions in the turn with which it begins there; with `jerk_m_per_s3` its jerk is
    nowhere larger. The grid has `cells` cells to the turn, 12 to 2880.

    An indexing motion has to be near to a stop over some arcs, or away from its stops. At which
    stop it is over an arc in which it need not stand is found with it, and takes longer: with 720
    cells about 0.7 s for each such arc, at most some seconds.

    The answer is checked before it is returned, by the curves of its diagram: the rules, the still
    arcs, the travel, the jerk, and the order of `bound` and `reached`. Raises WrongAnswerError if
    it fails. Raises InputError for what is out of range, for an arc over which the motion does not
    stand, where the solver says that no motion keeps all of this, and where none was found on a
    grid of so many cells.

    >>> import cammotion as cm
    >>> least_acceleration(
    ...     cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule, still=[(205, 305)], travel_mm=(0, 50))
    The least peak acceleration of the die lies between 0.5195 and 0.5196 m/s².
    """
    most_jerk = limit_of(_JERK_LIMIT, jerk_m_per_s3)
    grid = _CELLS.whole(cells)
    own = as_diagram(diagram)[motion]
    asked = Asked(
        of_places(diagram, own.name, rules),
        still_arcs(own, still),
        travel_ends(travel_mm),
        most_jerk,
    )
    check_begins_at_a_stop(own, asked.still)
    room = corridor(
        diagram, own.name, asked.rules, still=asked.still, travel_mm=travel_mm, cells=grid
    )
    # in parts of a turn all numbers are of one size, and the solver rounds least
    times, part = room.cells_deg * (_PARTS / DEG_PER_TURN), diagram.cycle_time_s / _PARTS
    limit = most_jerk * MM_PER_M * part**3
    stands = at_rest(own, room.low_mm[room.still])
    if stands and (room.still_cells.all() or _is_allowed(diagram, stands, asked)):
        lowest, best = 0.0, stands
    else:
        lowest = max(from_below(room, times, limit).bound, 0.0) / part**2  # no peak is below 0
        room, curve = _reach(room, times, limit)
        best = curve.build(own, room)
    found = LeastAcceleration(diagram, lowest / MM_PER_M, best, most_jerk)
    today = replace(found, motion=own)
    if today.reached < found.reached and not any(find_faults(diagram, own, asked)):
        found = today  # which a grid need not have
    _check(found, asked)
    return replace(found, bound=min(found.bound, found.reached))  # but for rounding it is so


def _is_allowed(diagram: TimingDiagram, motion: Motion, asked: Asked) -> bool:
    """Whether a motion keeps all that is asked, and its rules to the last digit."""
    return not find_violations(diagram.with_motion(motion), asked.rules) and not any(
        find_faults(diagram, motion, asked)
    )


def _check(found: LeastAcceleration, asked: Asked) -> None:
    """Raise WrongAnswerError unless the motion keeps what it has to and the bound lies below it."""
    faults = list(find_faults(found.diagram, found.motion, asked))
    if not found.bound <= found.reached * (1 + _ROUNDING) + _ROUNDING:
        faults.append(f"a motion reaches {found.reached:g} m/s², less than {found.bound:g} m/s²")
    if faults:
        raise WrongAnswerError("least_acceleration", "; ".join(faults))


def _reach(room: Corridor, times: Floats, most_jerk: float) -> tuple[Corridor, GridMotion]:
    """Return a motion with the least peak that a grid can have, and its corridor about its stops.

    What strays from the corridor between two nodes is held off a little further at both, and the
    program is solved once more. If that is not enough, it is held off so far that no acceleration
    up to the peak lets it stray: two nodes at a distance d from a limit, a time h apart, keep it
    there if d is the peak times h²/8.
    """
    if room.bands:
        room = room.about(from_above(room, times, most_jerk, np.zeros(len(times)))[1])
    held_off = np.where(room.inner, KEPT_MM, 0.0)
    for number in range(_ROUNDS):
        curve, _ = from_above(room, times, most_jerk, held_off)
        strays = curve.strays(room)
        if not strays.any():
            return room, curve
        off = 1.5 * strays
        if number >= _ROUNDS // 2:
            off = np.where(strays > 0, np.maximum(off, curve.peak * times**2 / 8), 0.0)
        held_off += np.where(room.inner, np.maximum(off, np.roll(off, 1)), 0.0)
    raise InputError(
        f"On a grid of {room.cells} cells the motion cannot be kept in its corridor between two "
        "nodes: take more cells."
    )
