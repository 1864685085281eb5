"""A machine as an engineer has it: its diagram, its rules, and where its parts have to stand."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from cammotion.arguments import checked
from cammotion.limits.standing import arcs_by_name
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError, as_text, plural, shorten
from cammotion.rules.checks import every_rule, find_clearances, find_violations, idle_rules
from cammotion.rules.rule import Clearance, Rule, Violation
from cammotion.shown import as_table

_HEADING = ("mechanism", "moves", "travel in mm", "peak velocity in m/s", "peak acceleration, m/s²")


@checked
@dataclass(frozen=True, repr=False)
class Machine:
    """A machine of your own: a timing diagram, its rules and its still arcs.

    `still` names for each part the arcs, pairs of cam angles in deg, over which it has to stand
    where it does: there the work is done. `read_machine` reads one from a file, and
    `write_machine` writes one. Raises InputError for rules and arcs that do not fit the diagram.

    >>> import cammotion as cm
    >>> still = {"mill": [(205, 305)], "die": [(205, 305)]}
    >>> machine = Machine("example", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule], still)
    >>> machine
    example: 2 mechanisms at 2000 pieces/h, 1 rule, kept; the die is driven hardest, 4.154 m/s²
    >>> machine.at_rate(1000).hardest
    'die'
    """

    name: str
    diagram: TimingDiagram
    rules: Sequence[Rule] = ()
    still: Mapping[str, Sequence[tuple[float, float]]] = field(default_factory=dict, hash=False)

    def __post_init__(self) -> None:
        if not self.name.strip():
            raise InputError(
                f"The name of the machine is {shorten(self.name)}: give one like 'press'."
            )
        object.__setattr__(self, "rules", every_rule(self.diagram, self.rules))
        object.__setattr__(self, "still", arcs_by_name(self.diagram, self.still))

    @cached_property
    def violations(self) -> tuple[Violation, ...]:
        """Every violation of a rule."""
        return find_violations(self.diagram, self.rules)

    @cached_property
    def clearances(self) -> tuple[Clearance, ...]:
        """The smallest clearance that each rule leaves, in the order of the rules."""
        return find_clearances(self.diagram, self.rules)

    @cached_property
    def idle(self) -> dict[Rule, str]:
        """The rules that nothing breaks, however the machine is timed, and why: look at them."""
        return idle_rules(self.diagram, self.rules)

    @cached_property
    def peaks(self) -> dict[str, float]:
        """The peak acceleration of each mechanism in m/s2, the largest first."""
        peaks = {name: self.diagram.peak_acceleration(name) for name in self.diagram.names}
        return dict(sorted(peaks.items(), key=lambda item: -item[1]))

    @property
    def free(self) -> dict[str, tuple[Arc, ...]]:
        """The still arcs of the parts that move: what `optimise` and `least_peak` ask for."""
        return {name: tuple(arcs) for name, arcs in self.still.items() if self.diagram[name].moves}

    @property
    def hardest(self) -> str:
        """The name of the mechanism with the largest peak acceleration."""
        return next(iter(self.peaks))

    def at_rate(self, rate_per_hour: float) -> "Machine":
        """Return the same machine at another rate, in pieces/h."""
        return replace(self, diagram=self.diagram.at_rate(rate_per_hour))

    def with_diagram(self, diagram: TimingDiagram) -> "Machine":
        """Return the machine with another diagram of the same parts; rules and still arcs stay."""
        return replace(self, diagram=diagram)

    def __repr__(self) -> str:
        """Say it in a line."""
        count, rules = len(self.diagram.names), len(self.rules)
        broken = len({violation.rule for violation in self.violations})
        kept = f"{broken} broken" if broken else "kept" if rules == 1 else "all kept"
        kept += f" ({len(self.idle)} cannot be broken)" if self.idle else ""
        peak = as_text(self.peaks[self.hardest], ".4g")
        ruled = f", {plural(rules, 'rule')}, {kept}" if rules else ", no rules"
        return (
            f"{shorten(self.name, of=str)}: {plural(count, 'mechanism')} at "
            f"{self.diagram.rate_per_hour:g} pieces/h{ruled}; the {shorten(self.hardest, of=str)} "
            f"is driven hardest, {peak} m/s²"
        )

    @property
    def rows(self) -> list[tuple[Any, ...]]:
        """What a table says of each mechanism: its moves, travel, peak velocity and acceleration.

        In mm, m/s and m/s2; the hardest one first.
        """
        found = []
        for name, peak in self.peaks.items():
            motion = self.diagram[name]
            low, high = motion.range_mm
            said = ", ".join(f"{move.kind} over {move.angle_deg:.4g}°" for move in motion.moves)
            velocity = self.diagram.peak_velocity(name)
            found.append((name, said or "stands", high - low, velocity, peak))
        return found

    def _repr_html_(self) -> str:
        return f"<p>{self!r}</p>{as_table(_HEADING, self.rows)}"
