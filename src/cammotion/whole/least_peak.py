"""How good could a whole machine get: the least peak that any motions of its parts could have.

The parts pay for each other: a quicker mill leaves the die more of the turn. So all their motions
are sought at once, from both sides, as `least_acceleration` does it for one. From below a
mixed-integer program asks less than motions are asked, and no motions are below what comes out.
From above motions are built and checked. How the search goes on, says `whole.joint_search`.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from textwrap import fill
from time import monotonic
from typing import Any

import numpy as np

from cammotion.arguments import checked
from cammotion.limits.standing import check_begins_at_a_stop
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import MM_PER_M
from cammotion.quantities import Quantity, outward
from cammotion.rules.rule import Rule
from cammotion.whole.asked_of_all import read_task, weighted_peak
from cammotion.whole.joint_search import Search

_GAP = Quantity("gap", "", example=0.02, high=1.0, low_included=True)
_SECONDS = Quantity("time", "s", example=60)
_NOTHING = 1e-5  # of a way in the square of a cycle, a peak that is rounding: all parts can stand
_COLUMNS = 96  # of a line; a notebook would break a longer one within its words


@dataclass(frozen=True, repr=False)
class LeastPeak:
    """The least peak that any motions of several parts could have, from both sides.

    `bound` is what no motions of the `parts` can be below: in m/s2, times the weights if there are
    any, in `unit`. `design` is the diagram with the best motions that were found, None if none
    were; its largest weighted peak is `reached`. `conditions` say in words of which motions this
    is true, `at_most` are the limits in m/s2 among them.
    """

    diagram: TimingDiagram
    bound: float
    design: TimingDiagram | None
    weights: Mapping[str, float]
    unit: str = "m/s²"
    conditions: str = ""
    at_most: Mapping[str, float] = field(default_factory=dict)

    @property
    def parts(self) -> tuple[str, ...]:
        """The names of the parts whose motions were free."""
        return tuple(self.weights)

    @property
    def reached(self) -> float:
        """The largest weighted peak of the design; infinite if there is none."""
        return weighted_peak(self.design, self.weights) if self.design else np.inf

    @property
    def gap(self) -> float:
        """How much better other motions could be at most, as a share of what is reached."""
        if self.can_stand:
            return 0.0
        return 1 - self.bound / self.reached if np.isfinite(self.reached) else 1.0

    @property
    def can_stand(self) -> bool:
        """Whether nothing makes the parts move: what is reached is no more than rounding."""
        return self.reached <= _NOTHING * self._size

    @property
    def _size(self) -> float:
        """A weighted peak of the size that the machine has."""
        ways_m = (
            weight * max(abs(motion.pitch_mm), float(np.ptp(motion.range_mm))) / MM_PER_M
            for motion, weight in ((self.diagram[n], w) for n, w in self.weights.items())
        )
        return max(ways_m) / self.diagram.cycle_time_s**2

    def __repr__(self) -> str:
        """Say what is reached, and what cannot be."""
        low, high = outward(self.bound, self.reached)
        names, unit = " and ".join(self.parts), self.unit
        reached = f"{high} {unit}" if self.design else "No motions were found yet"
        bound = f"{reached}; no motions of {names} can have less than {low} {unit}."
        return fill(f"{bound} {self.conditions}", _COLUMNS)


@checked
def least_peak(  # noqa: PLR0913 - all but two are given by name
    diagram: TimingDiagram,
    rules: Rule | Iterable[Rule],
    *,
    still: Mapping[str, Iterable[Arc]],
    travel_mm: Mapping[str, tuple[float, float]] | None = None,
    weights: Mapping[str, float] | None = None,
    at_most: Mapping[str, float] | None = None,
    unit: str = "m/s²",
    gap: float = 0.01,
    seconds: float = 60.0,
    progress: Callable[[LeastPeak], Any] | None = None,
) -> LeastPeak:
    """Return the least peak that any motions of several parts could have, and motions near to it.

    The parts named in `still` are free, whatever their laws, but for this: over these arcs, pairs
    of cam angles in deg, each stands where it stands in the diagram (so a stroke is kept by two
    arcs); with `travel_mm` it stays between two positions; all rules that a free part has a share
    in are kept. All other parts stay as they are. The largest of the peak accelerations is made
    small, each times its weight (1 if none is given; with masses in kg it is a force, and `unit`
    is "N"); with `at_most` no peak of a part is above a limit in m/s2. A weight of 0 leaves a part
    out, which needs such a limit then.

    The search ends when (reached - bound) / reached is at most `gap`, or after so many `seconds`,
    or by an interrupt of the keyboard; the best of both sides so far is returned. `progress` is
    called with it after each round.

    The bound is true of every motion, not of a grid alone: only what every motion keeps is asked
    (see `whole.joint_bound`). It does not rest on a solver's word: it is computed anew from the
    multipliers of each linear program that it is made of, and lowered by a hundred-thousandth for
    what a check forgives. A part that could get to more than 50 stops, so small is its pitch, adds
    nothing to it. Parts are rigid, and follow their motions exactly. The motions that are
    built are checked by `find_violations` and by their curves. Raises WrongAnswerError if they
    fail. Raises InputError for what is out of range, for an arc over which a part does not stand,
    for a turret that has to stand at none of its stops, for a rule that says no position of a free
    part, and where no motions keep all of this.

    >>> import cammotion as cm
    >>> given = cm.EXAMPLE
    >>> both = {"mill": [(205, 305)], "die": [(205, 305)]}
    >>> found = least_peak(
    ...     given.diagram, given.rule, still=both, travel_mm={"die": (0, 50)}, gap=0.05, seconds=9)
    >>> 0.60 < found.bound < 0.64 < found.reached < 0.68
    True
    >>> cm.find_violations(found.design, given.rule)
    ()
    """
    began = monotonic()
    task = read_task(
        diagram, rules, still=still, travel_mm=travel_mm, weights=weights, at_most=at_most
    )
    for part in task.parts:
        check_begins_at_a_stop(part.motion, part.still)
    wanted, end = _GAP.number(gap), began + _SECONDS.number(seconds)
    search = Search(task, end)

    def told() -> LeastPeak:
        bound, design = search.best
        return LeastPeak(diagram, bound, design, task.weights, unit, task.conditions, task.limits)

    try:
        for _ in search.rounds():
            if progress:
                progress(told())
            if told().gap <= wanted or monotonic() >= end:
                break
    except KeyboardInterrupt:  # the best so far is wanted
        pass
    return told()
