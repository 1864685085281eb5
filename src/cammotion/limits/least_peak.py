"""How good could a whole machine get: the least peak that any motions of its parts could have.

The parts pay for each other: a quicker mill leaves the die more of the turn. So all their motions
are sought at once, from both sides, as `least_acceleration` does it for one. From below a
mixed-integer program asks less than motions are asked, and no motions are below what comes out.
From above motions are built and checked. The grid is made finer where in the solution from below
a rule passes from one part to another, for there the node knows least; each round gives a bound
that is true, and the highest of all is kept.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from time import monotonic
from typing import Any

import numpy as np

from cammotion.limits.asked_of_all import Task, read_task, weighted_peak
from cammotion.limits.faults import Asked, find_faults
from cammotion.limits.joint_bound import Outline, outline
from cammotion.limits.joint_motion import motions, unsettled
from cammotion.limits.optimise import best_moves
from cammotion.limits.sides import Side, sides_of
from cammotion.machine.arcs import Arc
from cammotion.machine.clearance import ClearanceRule, find_violations
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import Floats, InputError, Quantity, WrongAnswerError

_GAP = Quantity("gap", "", example=0.02, high=1.0, low_included=True)
_SECONDS = Quantity("time", "s", example=60)
_FIRST_CELLS = 60
_FIRST_LAW = "constant acceleration"  # with which single moves have the least peak
_FIRST_SECONDS = 5.0
_SMALLEST_DEG = 0.03
_GROWTH = 1.1  # of a peak that is too small to be had
_MOST_GROWTH = 1e12
_TRUST = 1e-5  # of the bound, that the solver may have rounded away
_ROUNDING = 1e-6
_DIGITS = 4


@dataclass(frozen=True, repr=False)
class LeastPeak:
    """The least peak that any motions of several parts could have, from both sides.

    `bound` is what no motions of the `parts` can be below: in m/s2, times the weights if there are
    any, in `unit`. `design` is the diagram with the best motions that were found, None if none
    were; its largest weighted peak is `reached`. `conditions` say in words of which motions this
    is true.
    """

    diagram: TimingDiagram
    bound: float
    design: TimingDiagram | None
    weights: Mapping[str, float]
    unit: str = "m/s²"
    conditions: str = ""

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
        return 1 - self.bound / self.reached if np.isfinite(self.reached) else 1.0

    def __repr__(self) -> str:
        """Say what is reached, and what cannot be, rounded away from what is in between."""
        digits, unit = 10.0**_DIGITS, self.unit
        low = np.floor(self.bound * digits) / digits
        names = " and ".join(self.parts)
        if self.design is None:
            reached = "No motions were found yet"
        else:
            high = np.ceil(self.reached * digits) / digits
            reached = f"{high:.{_DIGITS}f} {unit}"
        return (
            f"{reached}; no motions of {names} can have less than {low:.{_DIGITS}f} {unit}. "
            f"{self.conditions}"
        )


def least_peak(  # noqa: PLR0913 - all but two are given by name
    diagram: TimingDiagram,
    rules: ClearanceRule | Iterable[ClearanceRule],
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
    (see `limits.joint_bound`). It is the bound that the solver HiGHS proves, lowered by a
    hundred-thousandth for its rounding; parts are rigid, and follow their motions exactly. The
    motions that are built are checked by `find_violations` and by their curves. Raises
    WrongAnswerError if they fail. Raises InputError for what is out of range, for an arc over
    which a part does not stand, and where no motions keep all of this.

    >>> import cammotion as cm
    >>> given = cm.EXAMPLE
    >>> both = {"mill": [(205, 305)], "die": [(205, 305)]}
    >>> found = least_peak(
    ...     given.diagram, given.rule, still=both, travel_mm={"die": (0, 50)}, gap=0.05)
    >>> 0.60 < found.bound < 0.64 < found.reached < 0.68
    True
    >>> cm.find_violations(found.design, given.rule)
    ()
    """
    task = read_task(
        diagram, rules, still=still, travel_mm=travel_mm, weights=weights, at_most=at_most
    )
    search = _Search(task, LeastPeak(diagram, 0.0, None, task.weights, unit, task.conditions))
    wanted, end = _GAP.number(gap), monotonic() + _SECONDS.number(seconds)
    try:
        for found in search.rounds(end):
            if progress:
                progress(found)
            if found.gap <= wanted or monotonic() >= end:
                break
    except KeyboardInterrupt:  # the best so far is wanted
        pass
    return search.best


@dataclass
class _Search:
    """The search from both sides on a grid that is made finer; `best` is the best so far."""

    task: Task
    best: LeastPeak
    sides: list[tuple[Side, Side]] = field(init=False)
    angle_deg: Floats = field(init=False)

    def __post_init__(self) -> None:
        self.sides = sides_of(self.task.diagram, self.task.parts, self.task.rules)
        self.angle_deg = self.task.grid(self.sides, _FIRST_CELLS)
        for start in (self.task.diagram, best_moves(self.task, [_FIRST_LAW], _FIRST_SECONDS)):
            if start and not list(self._faults(start)):
                better = replace(self.best, design=start)
                self.best = min(self.best, better, key=lambda found: found.reached)

    def rounds(self, end: float) -> Iterator[LeastPeak]:
        """Yield the best so far after each round, until the grid is as fine as it gets.

        Only motions a little above the bound are of interest: the smaller their peak, the less far
        they get, and the quicker the program is solved. If there are none, the bound is as much
        higher.
        """
        peak, top = self.task.scale, self.task.scale * _MOST_GROWTH
        while peak <= top:
            best = self.task.in_degrees(self.best.reached) * (1 + _TRUST)  # it is among them itself
            peak = min(max(peak, self.task.in_degrees(self.best.bound) * _GROWTH), best)
            left = end - monotonic()
            found = outline(self.task.parts, self.sides, self.angle_deg, peak, left)
            if np.isinf(found.bound) and peak == best:
                raise WrongAnswerError("least_peak", f"the bound is above {self.best.reached:g}")
            self._raise_bound(peak * min(found.bound, 1.0))
            if np.isinf(found.bound):
                peak *= _GROWTH
                continue
            if found.places is not None:
                self._build(found, min(2 * peak, best), max(end - monotonic(), 1.0))
            yield self.best
            if not self._refine(found):
                return
        raise InputError(
            "No motions keep all of this, however hard they are pushed: allow more travel or a "
            "larger peak, give shorter still arcs, or weaker rules."
        )

    def _raise_bound(self, push: float) -> None:
        """Keep a bound, in mm/deg2, if it is the highest so far."""
        bound = self.task.in_metres(push) * (1 - _TRUST)
        highest = min(max(self.best.bound, bound), self.best.reached)
        self.best = replace(self.best, bound=highest)

    def _build(self, found: Outline, peak: float, seconds: float) -> None:
        """Build motions in an outline, and keep them if they are the best."""
        built = motions(self.task.parts, self.sides, found, peak, seconds)
        if built is None:
            return
        design = self.task.diagram
        for motion in built:
            design = design.with_motion(motion)
        faults = list(self._faults(design))
        if faults:
            raise WrongAnswerError("least_peak", "; ".join(faults))
        better = replace(self.best, design=design)
        if better.reached < self.best.bound * (1 - _ROUNDING) - _ROUNDING:
            raise WrongAnswerError(
                "least_peak",
                f"motions reach {better.reached:g}, less than the bound {self.best.bound:g}",
            )
        if better.reached < self.best.reached:
            self.best = replace(better, bound=min(self.best.bound, better.reached))

    def _faults(self, design: TimingDiagram) -> Iterator[str]:
        """Yield in words what a design does not keep."""
        if self.task.rules:
            yield from map(str, find_violations(design, self.task.rules))
        for part in self.task.parts:
            asked = Asked((), part.still, part.travel_mm, np.inf)
            before = design.with_motion(part.motion)
            new = design[part.motion.name]
            if not np.isfinite(design.peak_acceleration(new.name)):
                yield f"the velocity of the {new.name} jumps"
                continue
            yield from find_faults(before, new, asked)
            if self.task.too_hard(part, design):
                yield f"the peak of the {new.name} is above its limit"

    def _refine(self, found: Outline) -> bool:
        """Halve the cells in which a rule passes on, or the widest; return whether any is left."""
        width = np.diff(found.angle_deg)
        there = [cell for cell in unsettled(self.sides, found) if width[cell] > _SMALLEST_DEG]
        if not there:
            free = [cell for cell in range(len(width)) if width[cell] > width.max() / 1.5]
            there = free if width.max() > 10 * _SMALLEST_DEG else []
        middles = [found.angle_deg[cell] + width[cell] / 2 for cell in there]
        self.angle_deg = np.sort(np.concatenate([self.angle_deg, middles]))
        return bool(there)
