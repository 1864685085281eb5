"""What to change first: the changes of all mechanisms, the largest gain first."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from cammotion.advice.changes import (
    BALANCE,
    NARROW,
    Improvement,
    changes_of,
    gentle_laws,
    improvement,
)
from cammotion.advice.worse import noted
from cammotion.arguments import checked
from cammotion.limits.frame import hands_over, is_usual
from cammotion.own import Machine
from cammotion.quantities import InputError, Quantity, in_decimals, rate_as_text
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
_LEAST_RATE = 0.5  # of today's: what leaves less at today's largest peak is no machine


@dataclass(frozen=True, repr=False)
class Improvements(Sequence[Improvement]):
    """What to change first in a machine, the best first; made by `improvements`.

    It is a sequence, so that `found[0]` is the first to do and `found[0].machine` the machine once
    that is done. The mechanisms `unasked` were not asked to be wider, for want of still arcs, and
    those in `handing` not at all, since their moves hand over a velocity. `left_out` are narrow
    moves that mend a rule, and would leave less than half of today's pieces at today's largest
    peak. `failed` says what could not be told, and why.
    """

    machine: Machine
    changes: tuple[Improvement, ...]
    unasked: tuple[str, ...] = ()
    handing: tuple[str, ...] = ()
    left_out: tuple[Improvement, ...] = ()
    failed: tuple[str, ...] = ()

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
        said = [in_decimals(peak, 3) for peak in peaks]
        first = f"The {names[0]} is driven hardest, with {said[0]} m/s²"
        if len(names) < _NEXT or not peaks[1]:
            return f"{first}."
        return f"{first}; after it comes the {names[1]}, with {said[1]} m/s²."

    @property
    def notes(self) -> tuple[str, ...]:
        """What is to be known beside the changes: rules that stay broken, who was not asked."""
        said = []
        broken = len({violation.rule for violation in self.machine.violations})
        mended = max((one.mends for one in self.changes), default=0)
        if mended < broken:
            many = f"{broken} rules are" if broken > 1 else "1 rule is"
            them = "it" if broken == 1 else "all" if mended else "any"
            said.append(f"{many} broken, and no change here mends {them}.")
        said += [
            f"Left out, since it leaves {rate_as_text(one.rate_per_hour)} pieces/h at today's "
            f"largest peak, less than half of today's: {one}."
            for one in self.left_out
        ]
        if self.unasked:
            names = " and the ".join(self.unasked)
            said.append(f"Not asked to be wider, for want of still arcs: the {names}.")
        if self.handing:
            names = " and the ".join(self.handing)
            said.append(f"Not asked, since its moves hand over a velocity: the {names}.")
        return (*said, *self.failed)

    @property
    def none(self) -> str:
        """What was tried in vain, in a sentence; empty where there is a change, or no push."""
        if self.changes or not any(self.machine.peaks.values()):
            return ""
        worse = " without making a broken rule worse" if self.machine.violations else ""
        return (
            "Tried for each mechanism that was asked, by itself: wider moves, and the laws of the "
            f"catalogue with a finite jerk. None makes its peak smaller{worse}."
        )

    def __repr__(self) -> str:
        """Say what is hardest, what is broken, and the first changes."""
        shown = [f"{number}. {one}" for number, one in enumerate(self.changes[:_SHOWN], 1)]
        left = len(self.changes) - len(shown)
        more = [f"and {left} more"] if left > 0 else []
        none = [self.none] if self.none else []
        return "\n".join([self.hardest, *self.notes, *shown, *more, *none])

    def _repr_html_(self) -> str:
        said = (self.hardest, *self.notes, *([self.none] if self.none else []))
        notes = "".join(f"<p>{escape(note)}</p>" for note in said)
        rows = [one.row for one in self.changes]
        return f"{notes}{as_table(_HEADING, rows)}" if rows else notes


@checked
def improvements(machine: Machine, *, seconds: float | None = None) -> Improvements:
    """Return what to change first in a machine, with the gain of each change before it is made.

    Each mechanism is asked by itself, all others as they are: how wide can its moves be
    (`widest_move`), and does a gentler law of the catalogue, one with a finite jerk, keep the
    rules? With still arcs its starts and angles are free between these (`optimise`), and the better
    of both is told. Where a rule or a move forbids these searches, or no moves of a part keep a
    rule that is broken, each end of a move is put out as far as it goes, which need not be the
    best: of which part, and why, is told. What mends a broken rule comes first, then what makes the
    largest peak of the machine smaller, then what makes that of its own mechanism smaller by most.
    What mends a rule only by a move so narrow that at today's largest peak the machine makes less
    than half of today's pieces, is told as `left_out`. (Rise and return of the three hardest may
    get two angles; of the others one, unless only two are a gain.) With `seconds` the balance of
    all moves at once is sought for so long (`optimise`; the parts with still arcs are free). Each
    change is checked before it is returned: it breaks no rule that was kept and makes none worse
    that is broken, and its peak is that of the changed diagram. Where a check fails, it is told
    what cannot be known, and the other changes are there. A motion that hands a velocity from move
    to move is not asked.
    Raises InputError for what is no Machine.

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
    laws, failed = gentle_laws(), list[str]()
    names = machine.diagram.names
    found = [one for name in names for one in changes_of(machine, name, laws, failed)]
    limit = None if seconds is None else _SECONDS.number(seconds)
    if limit is not None and machine.free:
        with noted(failed, "a balance of all moves"):
            found += _balance(machine, limit, failed)
    ordered = sorted(found, key=lambda one: (-one.mends, one.largest, -one.gain))
    left_out = [one for one in ordered if _is_too_slow(one, machine)]
    return Improvements(
        machine,
        tuple(one for one in ordered if not _is_too_slow(one, machine)),
        unasked=tuple(_unasked(machine)),
        handing=tuple(_handing(machine)),
        left_out=tuple(left_out),
        failed=tuple(dict.fromkeys(failed)),
    )


def _is_too_slow(one: Improvement, machine: Machine) -> bool:
    """Tell whether a move was made so narrow that hardly any machine is left."""
    return one.kind == NARROW and one.rate_per_hour < _LEAST_RATE * machine.diagram.rate_per_hour


def _handing(machine: Machine) -> Iterator[str]:
    """Yield whose moves go on with a velocity: with another angle or law it would jump."""
    yield from (motion.name for motion in machine.diagram.motions if hands_over(motion))


def _unasked(machine: Machine) -> Iterator[str]:
    """Yield who has several moves, of which nothing says where they have to stand."""
    for motion in machine.diagram.motions:
        is_other = bool(motion.moves) and not is_usual(motion) and not hands_over(motion)
        if is_other and motion.name not in machine.still:
            yield motion.name


def _balance(machine: Machine, seconds: float, failed: list[str]) -> Iterator[Improvement]:
    """Yield the best diagram of all moves at once, if it is better than what there is."""
    names = [*machine.free]
    try:
        found = optimise(machine.diagram, machine.rules, still=machine.free, seconds=seconds)
    except InputError as refusal:  # a part of another build, or no moves keep the rules
        failed.append(f"There is no balance of all moves. {refusal}")
        return
    said = f"balance all moves of {len(names)} mechanisms at once"
    one = improvement(BALANCE, said, machine, found.design, names)
    if (one.gain > 0 or one.mends) and not one.worsens:
        yield one
