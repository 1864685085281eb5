"""What to change first: the changes of all mechanisms, the largest gain first."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from cammotion.advice.changes import (
    BALANCE,
    Improvement,
    changes_of,
    gentle_laws,
    improvement,
)
from cammotion.arguments import checked
from cammotion.own import Machine
from cammotion.quantities import InputError, Quantity
from cammotion.shown import as_table
from cammotion.whole.optimise import optimise

_HEADING = (
    "what to change",
    "peak before, m/s²",
    "after",
    "then the machine's largest",
    "pieces/h at today's largest",
)
_SECONDS = Quantity("time", "s", example=5)
_SHOWN = 8  # lines of a text
_NEXT = 2


@dataclass(frozen=True, repr=False)
class Improvements(Sequence[Improvement]):
    """What to change first in a machine, the best first; made by `improvements`.

    It is a sequence, so that `found[0]` is the first to do and `found[0].machine` the machine once
    that is done.
    """

    machine: Machine
    changes: tuple[Improvement, ...]

    def __len__(self) -> int:
        return len(self.changes)

    def __getitem__(self, place: Any) -> Any:
        return self.changes[place]

    def __iter__(self) -> Iterator[Improvement]:
        return iter(self.changes)

    @property
    def hardest(self) -> str:
        """What drives the machine hardest, in a sentence."""
        names = [*self.machine.peaks][:_NEXT]
        peaks = [self.machine.peaks[name] for name in names]
        if not peaks[0]:
            return "Nothing moves."
        first = f"The {names[0]} is driven hardest, with {peaks[0]:.3f} m/s²"
        if len(names) < _NEXT or not peaks[1]:
            return f"{first}."
        return f"{first}; after it comes the {names[1]}, with {peaks[1]:.3f} m/s²."

    def __repr__(self) -> str:
        """Say what is hardest, and the first changes."""
        shown = [f"{number}. {one}" for number, one in enumerate(self.changes[:_SHOWN], 1)]
        left = len(self.changes) - len(shown)
        more = [f"and {left} more"] if left > 0 else []
        none = [] if self.changes else ["No single change makes a peak smaller."]
        return "\n".join([self.hardest, *shown, *more, *none])

    def _repr_html_(self) -> str:
        return f"<p>{self.hardest}</p>{as_table(_HEADING, [one.row for one in self.changes])}"


@checked
def improvements(machine: Machine, *, seconds: float | None = None) -> Improvements:
    """Return what to change first in a machine, with the gain of each change before it is made.

    Each mechanism is asked by itself, all others as they are: how wide can its moves be
    (`widest_move`), and does a gentler law of the catalogue, one with a finite jerk, keep the
    rules? One with more than a rise and a return is asked where it has still arcs; between such
    arcs each move gets an angle of its own (`optimise`). What mends a broken rule comes first, then
    what makes the largest peak of the machine smaller, then what makes that of its own mechanism
    smaller by most. (Rise and return of the three hardest may get two angles; of the others one,
    unless only two are a gain.) With `seconds` the balance of all moves at once is sought for so
    long (`optimise`; the parts with still arcs are free). Each change is checked before it is
    returned: it breaks no rule that was kept, and its peak is that of the changed diagram. Raises
    InputError for what is no Machine, and WrongAnswerError if a check fails.

    >>> import cammotion as cm
    >>> both = {"mill": [(205, 305)], "die": [(205, 305)]}
    >>> machine = cm.Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule], both)
    >>> found = improvements(machine)
    >>> found.hardest
    'The die is driven hardest, with 4.154 m/s²; after it comes the mill, with 1.117 m/s².'
    >>> for one in found:
    ...     print(f"{one.kind} {one.mechanism}: {one.before:.3f} to {one.after:.3f} m/s²")
    widen die: 4.154 to 0.806 m/s²
    law die: 4.154 to 3.232 m/s²
    widen mill: 1.117 to 0.409 m/s²
    law mill: 1.117 to 0.869 m/s²
    >>> print(f"{found[0].rate_per_hour:.0f} pieces/h with the largest peak of today")
    3857 pieces/h with the largest peak of today
    """
    found = [one for name in machine.diagram.names for one in changes_of(machine, name, _laws())]
    limit = None if seconds is None else _SECONDS.number(seconds)
    if limit is not None and machine.free:
        found += _balance(machine, limit)
    ordered = sorted(found, key=lambda one: (-one.mends, one.largest, -one.gain))
    return Improvements(machine, tuple(ordered))


def _balance(machine: Machine, seconds: float) -> Iterator[Improvement]:
    """Yield the best diagram of all moves at once, if it is better than what there is."""
    names = [*machine.free]
    try:
        found = optimise(machine.diagram, machine.rules, still=machine.free, seconds=seconds)
    except InputError:  # a part of another build, or no moves keep the rules
        return
    said = f"balance all moves of {len(names)} mechanisms at once"
    one = improvement(BALANCE, said, machine, found.design, names)
    if one.gain > 0 or one.mends:
        yield one


@cache
def _laws() -> tuple[str, ...]:
    return tuple(gentle_laws())
