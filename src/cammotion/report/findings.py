"""All that a report says of a machine: computed once, before a line of it is written."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from cammotion.advice.ranking import Improvements, improvements
from cammotion.limits.reserves import Reserve, reserves
from cammotion.machine.diagram import TimingDiagram
from cammotion.own import Machine
from cammotion.quantities import InputError, WrongAnswerError
from cammotion.rules.checks import has_limits
from cammotion.whole.least_peak import LeastPeak, least_peak
from cammotion.whole.optimise import Optimised, optimise

Progress = Callable[[float, str], None]
"""Is told the share that is done, and what is being done."""

_GAP = 0.01
_RANKED, _BALANCED, _PROVED = 0.1, 0.3, 0.8  # the shares of what is done then
_OPTIMISING_S = 10.0
_UNASKED = (
    "No part that moves has still arcs, so that no design was sought and no bound: say in the "
    "column 'still' of the table over which arcs each part has to stand."
)


@dataclass(frozen=True)
class Findings:
    """What is known of a machine; `notes` say what could not be found, and why."""

    machine: Machine
    ranking: Improvements
    left: tuple[Reserve, ...]
    best: Optimised | None
    least: LeastPeak | None
    notes: tuple[str, ...]

    @property
    def design(self) -> TimingDiagram:
        """What is drawn and written: the best diagram, if one was found, or else that of today."""
        return self.best.design if self.best else self.machine.diagram

    @cached_property
    def improved(self) -> Machine:
        """The machine with that diagram."""
        return self.machine.with_diagram(self.design)


def find_all(machine: Machine, seconds: float, progress: Progress) -> Findings:
    """Return what there is to say; the search for the bound takes at most so many seconds.

    An interrupt of the keyboard ends what is being searched for, and what was found is kept.
    """
    progress(0.0, "checking rules, looking what to change first")
    ranking = improvements(machine)
    left = reserves(machine.diagram, machine.rules)
    best, least = None, None
    if why := _not_sought(machine):
        return Findings(machine, ranking, left, best, least, (why,))
    notes: list[str] = []
    refused: dict[str, str] = {}  # by the reason, which both may have
    progress(_RANKED, "balancing all moves at once")
    try:
        best = optimise(machine.diagram, machine.rules, still=machine.free, seconds=_OPTIMISING_S)
    except KeyboardInterrupt:
        notes.append("The balance of all moves was interrupted: there is none.")
    except (InputError, WrongAnswerError) as wrong:
        refused[str(wrong)] = "There is no balance of all moves"
    progress(_BALANCED, "proving what no motions can be below (Ctrl-C takes the best so far)")

    def told(found: LeastPeak) -> None:
        share = _BALANCED + (_PROVED - _BALANCED) * (1 - min(found.gap, 1.0))
        reached = f"{found.reached:.4g}" if found.design else "none"
        progress(share, f"found {reached}, none below {found.bound:.4g} m/s² (Ctrl-C: enough)")

    try:
        least = least_peak(
            machine.diagram,
            machine.rules,
            still=machine.free,
            gap=_GAP,
            seconds=seconds,
            progress=told,
        )
    except KeyboardInterrupt:
        notes.append("The search for the bound was interrupted before it had one.")
    except (InputError, WrongAnswerError) as wrong:
        both = f"{refused[str(wrong)]}, and no bound" if str(wrong) in refused else ""
        refused[str(wrong)] = both or "There is no bound"
    notes += [f"{what}. {why}" for why, what in refused.items()]
    return Findings(machine, ranking, left, best, least, tuple(notes))


def _not_sought(machine: Machine) -> str:
    """Return why neither a design nor a bound can be sought; "" if both can."""
    if not machine.free:
        return _UNASKED if any(machine.peaks.values()) else "Nothing moves."
    others = [rule for rule in machine.rules if not has_limits(rule)]
    if not others:
        return ""
    return (
        "No design was sought and no bound: both know rules of beyond and within alone, and none "
        f"like '{others[0]}'. Say it by these if you can, like 'the die may be beyond 19 mm only "
        "while the mill is within 0.65 mm'. What it leaves today is in the table of the rules."
    )
