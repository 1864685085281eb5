"""What is asked of the motions of several parts, read from what a user gives."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np

from cammotion.arguments.by_name import as_given, by_name
from cammotion.limits.corridors import even_nodes, travel_ends
from cammotion.limits.faults import Asked, find_faults
from cammotion.limits.standing import arcs_by_name
from cammotion.machine.arcs import arcs, intersect, unwrap
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN, over_time
from cammotion.quantities import Floats, InputError, Quantity, plural
from cammotion.rules.checks import as_rules, find_violations
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.rule import Rule
from cammotion.whole.parts import Part
from cammotion.whole.sides import Side

_WEIGHT = Quantity("weight", "", example=1, low_included=True)
_LIMIT = Quantity("limit of a peak", "m/s²", example=1)
FREE = "free part"
_AT_A_LIMIT_MM = 1e-5  # so far beyond it, a motion may be at its limit
_ABOVE = 1e-6  # of a limit, that may be rounding


@dataclass(frozen=True)
class Task:
    """The free parts of a diagram and the rules that they have a share in."""

    diagram: TimingDiagram
    parts: tuple[Part, ...]
    rules: tuple[ClearanceRule, ...]

    @property
    def weights(self) -> dict[str, float]:
        """The weight of each part by its name."""
        return {part.motion.name: part.weight for part in self.parts}

    @property
    def limits(self) -> dict[str, float]:
        """The limit of a part's peak in m/s2, by the names of the parts that have one."""
        return {p.motion.name: self.in_metres(p.cap) for p in self.parts if np.isfinite(p.cap)}

    @property
    def conditions(self) -> str:
        """Of which motions the bound is true."""
        said = []
        for part in self.parts:
            name = part.motion.name
            arcs = " and ".join(f"from {start:g} to {end:g}" for start, end in part.still)
            low, high = part.travel_mm
            within = f" and stays within {low:g} to {high:g} mm" if np.isfinite(low) else ""
            cap = self.in_metres(part.cap)
            capped = f", its peak at most {cap:g} m/s²" if np.isfinite(cap) else ""
            said.append(f"the {name} stands {arcs} deg{within}{capped}")
        rules = f"{plural(len(self.rules), 'rule')} kept"
        rate = f"{self.diagram.rate_per_hour:g} pieces/h, rigid parts"
        return f"Conditions: {'; '.join([*said, rules, rate])}."

    @property
    def scale(self) -> float:
        """A weighted peak in mm/deg2 of the size that may be met."""
        ways = [abs(part.motion.pitch_mm) for part in self.parts]
        ways += [float(np.ptp(part.motion.range_mm)) for part in self.parts]
        least = min(part.weight for part in self.parts if part.weight)
        return least * max([*ways, 1e-3]) / DEG_PER_TURN**2

    def of(self, names: Sequence[str]) -> "Task":
        """Return what is asked of some parts by themselves."""
        parts = tuple(part for part in self.parts if part.motion.name in names)
        others = {part.motion.name for part in self.parts} - set(names)
        rules = [r for r in self.rules if not {*r.motions} & others]
        return Task(self.diagram, parts, _of_interest(rules, names))

    @property
    def eased(self) -> "Task":
        """The same but for limits that are farther off by what can be rounding."""
        rules = (
            replace(
                rule,
                when=rule.when.eased(-_AT_A_LIMIT_MM),
                only_while=rule.only_while.eased(_AT_A_LIMIT_MM),
            )
            for rule in self.rules
        )
        return replace(self, rules=tuple(rules))

    def beside(self, others: "Task", design: TimingDiagram) -> "Task":
        """Return what is asked of the parts that another task leaves, its own being as designed."""
        left = tuple(part for part in self.parts if part not in others.parts)
        return Task(design, left, _of_interest(self.rules, [part.motion.name for part in left]))

    def no_harder(self, names: Iterable[str]) -> "Task":
        """Return the same with the peaks of today as limits of these parts, if they have none."""
        today = {name: self.in_degrees(self.diagram.peak_acceleration(name)) for name in names}
        parts = (
            replace(part, cap=today.get(part.motion.name, np.inf)) if np.isinf(part.cap) else part
            for part in self.parts
        )
        return replace(self, parts=tuple(parts))

    def grid(self, sides: Sequence[tuple[Side, Side]], cells: int) -> Floats:
        """Return a grid with the ends of all arcs in it that are known beforehand.

        The middle between two stands is in it, too: without a node there a short move is not seen.
        """
        ends = [end for part in self.parts for arc in part.still for end in arc]
        ends += [middle for part in self.parts for middle in part.middles_deg]
        ends += [end for both in sides for side in both for arc in side.closed for end in arc]
        return even_nodes(min(ends), ends, cells)

    def in_metres(self, push: float) -> float:
        """Return an acceleration, given in mm/deg2, in m/s2."""
        return float(over_time(2, push, self.diagram.cycle_time_s))

    def in_degrees(self, push: float) -> float:
        """Return an acceleration, given in m/s2, in mm/deg2."""
        return push / self.in_metres(1.0)

    def too_hard(self, part: Part, design: TimingDiagram) -> bool:
        """Whether the peak of a part is above its own limit."""
        peak = self.in_degrees(design.peak_acceleration(part.motion.name))
        return bool(peak > part.cap * (1 + _ABOVE))


def weighted_peak(diagram: TimingDiagram, weights: Mapping[str, float]) -> float:
    """Return the largest of the peak accelerations, in m/s2, each times its weight."""
    return max(
        weight * diagram.peak_acceleration(name) for name, weight in weights.items() if weight
    )


def faults_of(task: Task, design: TimingDiagram) -> Iterator[str]:
    """Yield in words what a design does not keep."""
    yield from map(str, find_violations(design, task.rules))
    for part in task.parts:
        new = design[part.motion.name]
        if not np.isfinite(design.peak_acceleration(new.name)):
            yield f"the velocity of the {new.name} jumps"
            continue
        asked = Asked((), part.still, part.travel_mm, np.inf)
        yield from find_faults(design.with_motion(part.motion), new, asked)
        if task.too_hard(part, design):
            yield f"the peak of the {new.name} is above its limit"


def read_task(  # noqa: PLR0913 - all but two are given by name
    diagram: TimingDiagram,
    rules: Rule | Iterable[Rule],
    *,
    still: Any,
    weights: Any,
    at_most: Any,
    travel_mm: Any = None,
) -> Task:
    """Return what is asked of the parts; raises InputError for what makes no sense."""
    given = as_rules(diagram, rules)
    listed = arcs_by_name(diagram, still)
    standing = {name: tuple(unwrap(arcs(own))) for name, own in listed.items()}
    if not standing:
        raise InputError(
            "No part is free: give still arcs of at least one, for example "
            "still={'die': [(205, 305)]}."
        )
    names = tuple(standing)
    free = partial(by_name, names=names, of=FREE)
    travels = free("travels", travel_mm, read=as_given, example="{'die': (0, 50)}")
    weight = free("weights", weights, read=_WEIGHT.number, example="{'die': 12}")
    limits = free("limits", at_most, read=_LIMIT.number, example="{'mill': 1.1}")
    task = Task(diagram, (), ())
    parts = []
    for name in names:
        cap = task.in_degrees(limits[name]) if name in limits else np.inf
        travel = travel_ends(travels.get(name))
        parts.append(Part(diagram[name], standing[name], travel, weight.get(name, 1.0), cap))
        _check(parts[-1])
    if not any(part.weight for part in parts):
        raise InputError("All weights are 0: give at least one part a weight above 0.")
    task = Task(diagram, tuple(parts), _of_interest(given, names))
    _check_can_stand(task)
    return task


def _check(part: Part) -> None:
    """Raise InputError for what makes no sense of a part by itself."""
    name = part.motion.name
    if part.motion.is_indexing and np.isfinite(part.travel_mm[0]):
        raise InputError(
            f"The {name} is an indexing motion, which goes on for ever: leave out its travel."
        )
    if part.weight == 0 and np.isinf(part.cap):
        raise InputError(
            f"The {name} has the weight 0 and no limit, so that its peak may be anything: give "
            f"it a limit, for example at_most={{{name!r}: 1.1}}, or a weight above 0."
        )


def _check_can_stand(task: Task) -> None:
    """Raise InputError where a rule is broken while all free parts in it have to stand."""
    for broken in find_violations(task.diagram, task.rules):
        free = [part for part in task.parts if part.motion.name in broken.rule.motions]
        where = arcs([(broken.start_deg, broken.end_deg)])
        for part in free:
            where = intersect(where, arcs(part.still))
        if where:
            names = " and the ".join(part.motion.name for part in free)
            start, end = where[0]
            raise InputError(
                f"From {start:g} to {end:g} deg the {names} ha{'s' if len(free) == 1 else 've'} to "
                f"stand, and there the rule '{broken.rule}' is broken: change it or the still arcs."
            )


def _of_interest(rules: Iterable[ClearanceRule], names: Iterable[str]) -> tuple[ClearanceRule, ...]:
    """Return the rules in which some of these parts have a share."""
    own = set(names)
    return tuple(rule for rule in rules if {*rule.motions} & own)
