"""The search for the least peak of all parts from both sides, on grids that are made finer.

A grid is made finer where in the solution from below a rule passes from one part to another, for
there its nodes know least. Each round gives a bound that is true, and the highest of all is kept.

It begins with the best diagram of single moves. Then come the parts alone that are driven hardest
in it: what they cannot do by themselves, they cannot do with others beside them, so their bound is
one of all. One part more is taken each time, and at last all.
"""

from collections.abc import Iterator
from time import monotonic
from typing import NamedTuple

import numpy as np

from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError, WrongAnswerError
from cammotion.whole.asked_of_all import Task, faults_of, weighted_peak
from cammotion.whole.joint_bound import Outline, outline
from cammotion.whole.joint_motion import motions, unsettled
from cammotion.whole.optimise import best_moves
from cammotion.whole.sides import sides_of

_FIRST_CELLS = 60
_FIRST_LAW = "constant acceleration"  # with which single moves have the least peak
_FIRST_SECONDS, _FIRST_SHARE = 5.0, 0.5  # at most, and of the time that is left
_SMALLEST_DEG = 0.03
_WIDEST_DEG = 0.3  # finer than this no grid is all over
_RISE = 0.003  # of the bound, for a round that has brought something
_GROWTH = 1.1  # of a peak that is too small to be had
_MOST_GROWTH = 1e12
_FORGIVEN = 1e-5  # of the bound, by what a check of a motion forgives
_ROUNDING = 1e-6
_HARDEST = 0.999  # of the largest peak: so hard driven a part is one of the hardest
_IDLE = 3  # rounds that have brought nothing are enough
_SHARE = 0.25  # of the time that is left is theirs at most
_SOLVED = 0.995  # of the peak of motions: a bound that is near enough


class Best(NamedTuple):
    """The highest bound so far, in m/s2 times the weight, and the best design, if there is one."""

    bound: float
    design: TimingDiagram | None


class Search:
    """The search for what is asked, up to an `end` by the clock; `best` is the best so far."""

    def __init__(self, task: Task, end: float) -> None:
        self.task, self.end, self.best = task, end, Best(0.0, None)
        for design in (task.diagram, _at_rest(task), self._best_moves(task)):
            if design and not list(faults_of(task, design)):
                self._keep(design)

    @property
    def reached(self) -> float:
        """The largest weighted peak of the best design; infinite if there is none."""
        design = self.best.design
        return weighted_peak(design, self.task.weights) if design else np.inf

    def rounds(self) -> Iterator[Best]:
        """Yield the best so far after each round, until the grid is as fine as it gets."""
        if not self.reached:  # nothing moves, and nothing is below that
            return
        end = self.end
        for task in self._hardest():
            now, grid = monotonic(), _Grid(self, task)
            until, idle, bound = now + _SHARE * (end - now), 0, self.best.bound
            for best in grid.rounds(until):
                yield best
                idle, bound = 0 if best.bound > bound * (1 + _RISE) else idle + 1, best.bound
                solved = best.bound >= min(grid.least, self.reached) * _SOLVED
                if solved or idle > 2 * _IDLE or monotonic() >= until:
                    break
        yield from _Grid(self, self.task).rounds(end)

    def _hardest(self) -> Iterator[Task]:
        """Yield what is asked of the parts alone that are driven hardest, one more each time."""
        design = self.best.design
        if design is None:
            return
        hardness = {
            part.motion.name: max(
                part.weight * design.peak_acceleration(part.motion.name) / self.reached,
                self.task.in_degrees(design.peak_acceleration(part.motion.name)) / part.cap,
            )
            for part in self.task.parts
        }
        names = [name for name, share in hardness.items() if share >= _HARDEST]
        while len(names) < len(self.task.parts):
            hardest = self.task.of(names)
            if hardest.rules:
                yield hardest
            near = {
                name
                for rule in self.task.rules
                if {*rule.motions} & set(names)
                for name in rule.motions
                if name in hardness
            }
            left = (near or set(hardness)) - set(names) or set(hardness) - set(names)
            names.append(max(sorted(left), key=lambda name: hardness[name]))

    def build(self, task: Task, found: Outline, peak: float, seconds: float) -> float:
        """Build motions in an outline, and offer them; return their weighted peak."""
        sides = sides_of(task.diagram, task.parts, task.rules)
        built = motions(task.parts, sides, found, peak, seconds)
        if built is None:
            return np.inf
        design = task.diagram
        for motion in built:
            design = design.with_motion(motion)
        self.offer(design, task)
        return weighted_peak(design, task.weights)

    def raise_bound(self, push: float) -> None:
        """Keep a bound, in mm/deg2, if it is the highest so far."""
        bound = self.task.in_metres(push) * (1 - _FORGIVEN)
        highest = min(max(self.best.bound, bound), self.reached)
        self.best = self.best._replace(bound=highest)

    def offer(self, design: TimingDiagram, part_of_it: Task) -> None:
        """Keep a design if it is the best, in which the motions of a task are new.

        If these are not all parts, the others get the best single moves beside them. A design that
        stays at a limit is left out: that is not beyond it, and the nearest ones are none to build.
        """
        if part_of_it is not self.task:
            rest = self.task.beside(part_of_it, design)
            found = self._best_moves(rest)
            if found is None or list(faults_of(self.task, found)):
                return
            design = found
        faults = list(faults_of(self.task, design))
        if faults and not list(faults_of(self.task.eased, design)):
            return
        peak = weighted_peak(design, self.task.weights)
        if peak < self.best.bound * (1 - _ROUNDING) - _ROUNDING:
            faults.append(f"motions reach {peak:g}, less than the bound {self.best.bound:g}")
        if faults:
            raise WrongAnswerError("least_peak", "; ".join(faults))
        self._keep(design)

    def _best_moves(self, task: Task) -> TimingDiagram | None:
        """Return the best single moves, for which a share of the time that is left is taken."""
        left = max(self.end - monotonic(), 0.0)
        return best_moves(task, [_FIRST_LAW], min(_FIRST_SECONDS, _FIRST_SHARE * left))

    def _keep(self, design: TimingDiagram) -> None:
        peak = weighted_peak(design, self.task.weights)
        if peak < self.reached:
            self.best = Best(min(self.best.bound, peak), design)


def _at_rest(task: Task) -> TimingDiagram:
    """Return the diagram in which all parts stand that need not move."""
    design = task.diagram
    for standing in filter(None, (part.at_rest for part in task.parts)):
        design = design.with_motion(standing)
    return design


class _Grid:
    """The rounds of a search for some parts or for all."""

    def __init__(self, search: Search, task: Task) -> None:
        self.search, self.task = search, task
        self.sides = sides_of(self.task.diagram, self.task.parts, self.task.rules)
        self.angle_deg = self.task.grid(self.sides, _FIRST_CELLS)
        self.idle, self.bound, self.least = 0, 0.0, np.inf

    def rounds(self, end: float) -> Iterator[Best]:
        """Yield the best so far after each round.

        Only motions a little above the bound are of interest: the smaller their peak, the less far
        they get, and the quicker the program is solved. If there are none, the bound is as much
        higher.
        """
        task, search = self.task, self.search
        peak, top = task.scale, task.scale * _MOST_GROWTH
        while peak <= top:
            best = task.in_degrees(search.reached) * (1 + _FORGIVEN)  # it is among them itself
            peak = min(max(peak, task.in_degrees(search.best.bound) * _GROWTH), best)
            found = outline(
                task.parts,
                self.sides,
                self.angle_deg,
                peak,
                end - monotonic(),
                least=task.in_degrees(search.best.bound) / peak,
            )
            if np.isinf(found.bound) and peak == best:
                raise WrongAnswerError("least_peak", f"the bound is above {search.reached:g}")
            search.raise_bound(peak * min(found.bound, 1.0))
            if np.isinf(found.bound):
                peak *= _GROWTH
                continue
            if found.places is not None:
                left = max(end - monotonic(), 1.0)
                built = search.build(task, found, min(2 * peak, best), left)
                self.least = min(self.least, built)
            yield search.best
            if found.places is None or not self._refine(found):  # a finer grid takes longer
                return
        raise InputError(
            "No motions keep all of this, however hard they are pushed: allow more travel or a "
            "larger peak, give shorter still arcs, or weaker rules."
        )

    def _refine(self, found: Outline) -> bool:
        """Halve the cells in which a rule passes on; return whether any is left to be halved.

        Where that brings nothing any more, since it may as well pass on in another cell, the widest
        are all halved.
        """
        width = np.diff(found.angle_deg)
        halved = {cell for cell in unsettled(self.sides, found) if width[cell] > _SMALLEST_DEG}
        rises = self.search.best.bound > self.bound * (1 + _RISE)
        self.idle, self.bound = 0 if rises else self.idle + 1, self.search.best.bound
        if (not halved or self.idle >= _IDLE) and width.max() > _WIDEST_DEG:
            halved |= {cell for cell in range(len(width)) if width[cell] > width.max() / 1.5}
            self.idle = 0
        middles = [found.angle_deg[cell] + width[cell] / 2 for cell in halved]
        self.angle_deg = np.sort(np.concatenate([self.angle_deg, middles]))
        return bool(halved)
