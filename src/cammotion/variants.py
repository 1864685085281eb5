"""The running example's machine, and one with numbers of their own for each learner.

A die presses into an indexing mill. Its numbers are those of the source unless a learner asks for
a variant: other numbers of the same machine, the same for the same name on any day and any
computer, so that neighbours cannot copy a result but can compare how they came to it.
"""

import hashlib
import numbers
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from cammotion.checks import InputError, shorten
from cammotion.clearance import ClearanceRule, beyond, within
from cammotion.diagram import TimingDiagram
from cammotion.kinematics import DEG_PER_TURN
from cammotion.laws import LAWS
from cammotion.motions import Motion, indexing_motion, motion
from cammotion.overlap import widest_move
from cammotion.segments import dwell, return_, rise

QUIET_SHARE = 0.1
"""The share of the mill's time, at either end of its move, in which it does the die no harm."""

_LAW = LAWS["cycloidal"]


@dataclass(frozen=True, kw_only=True, repr=False)
class Machine:
    """The numbers of a die that presses into an indexing mill; lengths in mm, angles in deg.

    >>> SOURCE.die_angle_deg
    55.0
    >>> print(f"{SOURCE.widest_deg:.2f}")
    124.84
    """

    who: str = field(default="", compare=False)
    rate_per_hour: int = 2000
    pitch_mm: float = 100
    stops: int = 24
    mill_angle_deg: float = 150
    work_deg: float = 100
    wait_mm: float = 20
    pocket_mm: float = 31
    gap_mm: float = 1
    margin_mm: float = 1
    die_mass_kg: float = 12

    def __repr__(self) -> str:
        """Say all the numbers in words."""
        whose = f"The machine of {self.who}" if self.who else "The machine of the source"
        return (
            f"{whose}: {self.rate_per_hour:g} pieces per hour. The mill moves {self.pitch_mm:g} mm "
            f"over {self.mill_angle_deg:g} degrees and has {self.stops} stops. The die, "
            f"{self.die_mass_kg:g} kg, waits {self.wait_mm:g} mm above it and goes into a pocket "
            f"of {self.pocket_mm:g} mm, to {self.gap_mm:g} mm above the bottom: a stroke of "
            f"{self.stroke_mm:g} mm. It works for {self.work_deg:g} degrees."
        )

    def _repr_markdown_(self) -> str:
        return repr(self)

    @property
    def stroke_mm(self) -> float:
        """The stroke of the die: to the mill, and into the pocket but for a gap."""
        return self.wait_mm + self.pocket_mm - self.gap_mm

    @property
    def die_angle_deg(self) -> float:
        """The indexing angle of the die without overlap: half of what mill and work leave."""
        return (DEG_PER_TURN - self.mill_angle_deg - self.work_deg) / 2

    @property
    def down_deg(self) -> float:
        """The cam angle at which the die is down, without overlap and with it."""
        return self.mill_angle_deg + self.die_angle_deg

    @property
    def quiet_deg(self) -> float:
        """The cam angle at either end of the mill's move in which it hardly moves."""
        return QUIET_SHARE * self.mill_angle_deg

    @property
    def limit_mm(self) -> float:
        """How deep the die may be while the mill is on its way."""
        return self.wait_mm - self.margin_mm

    @property
    def overlapped_deg(self) -> float:
        """The indexing angle of the die if it only uses the quiet ends of the mill's move."""
        return self.die_angle_deg + self.quiet_deg

    @cached_property
    def widest_deg(self) -> float:
        """The widest indexing angle of the die that keeps the rule."""
        return widest_move(self.diagram, "die", self.rule).angle_deg

    @property
    def mill(self) -> Motion:
        """The motion of the mill, from 0 deg on."""
        return indexing_motion(
            "mill",
            rise(self.pitch_mm, over_deg=self.mill_angle_deg),
            dwell(DEG_PER_TURN - self.mill_angle_deg),
            stops=self.stops,
        )

    @property
    def die(self) -> Motion:
        """The motion of the die without overlap: from when the mill stands."""
        return motion(
            "die",
            rise(self.stroke_mm, over_deg=self.die_angle_deg),
            dwell(self.work_deg),
            return_(self.stroke_mm, over_deg=self.die_angle_deg),
            dwell(self.mill_angle_deg),
            start_deg=self.mill_angle_deg,
        )

    @property
    def diagram(self) -> TimingDiagram:
        """The timing diagram of both without overlap."""
        return TimingDiagram((self.mill, self.die), self.rate_per_hour)

    @property
    def rule(self) -> ClearanceRule:
        """The clearance rule: deep only while the mill is as near a stop as in its quiet ends."""
        near = float(self.mill.offset_mm(self.mill_angle_deg - self.quiet_deg))
        return ClearanceRule(beyond("die", self.limit_mm), only_while=within("mill", near))


SOURCE = Machine()
"""The machine of the source."""

_CHOICES: Mapping[str, Sequence[float]] = {
    "rate_per_hour": range(1200, 3001, 100),
    "pitch_mm": range(80, 131, 10),
    "stops": range(16, 33, 4),
    "mill_angle_deg": range(120, 171, 10),
    "work_deg": range(70, 121, 10),
    "wait_mm": range(15, 31),
    "pocket_mm": range(20, 41),
    "margin_mm": (1, 1.5, 2, 2.5, 3),
    "die_mass_kg": range(5, 31),
}
_LEAST_DIE_DEG = 40
_LEAST_REST_DEG = 4  # what the overlapped die rests at the top


def machine_for(who: Any = "") -> Machine:
    """Return the machine with the numbers of a learner, given by a name or a number.

    The same name gives the same numbers; capitals and blanks at its ends do not matter. Without
    one it is the machine of the source. Raises InputError for what is neither name nor number.

    >>> machine_for("Anna") == machine_for(" anna ")
    True
    >>> machine_for() == SOURCE
    True
    """
    if isinstance(who, bool) or not isinstance(who, str | numbers.Integral):
        raise InputError(
            f"A variant is asked for by a name or a whole number, not {shorten(who)}: give for "
            "example 'Anna' or 17."
        )
    try:
        name = unicodedata.normalize("NFKC", str(who)).strip()
    except ValueError:  # Python writes out no more than 4300 digits
        raise InputError(
            "The number of a variant is too long: give a shorter one, for example 17."
        ) from None
    if not name:
        return SOURCE
    return next(filter(_is_sensible, _machines(name)))


def _machines(who: str) -> Iterator[Machine]:
    """Yield machines with drawn numbers, without an end; the draw depends on the name alone."""
    numbers = _draws(who.casefold())
    while True:
        drawn: dict[str, Any] = {
            name: choices[next(numbers) % len(choices)] for name, choices in _CHOICES.items()
        }
        yield Machine(who=who, **drawn)


def _draws(seed: str) -> Iterator[int]:
    """Yield whole numbers, by a hash: the same with any version of Python."""
    count = 0
    while True:
        drawn = hashlib.sha256(f"{seed}|{count}".encode("utf-8", "surrogatepass"))
        yield int.from_bytes(drawn.digest()[:8])
        count += 1


def _is_sensible(machine: Machine) -> bool:
    """Tell whether the die has room without overlap, and the turn has room for its widest move."""
    if machine.die_angle_deg < _LEAST_DIE_DEG or machine.limit_mm > 0.7 * machine.stroke_mm:
        return False
    before = _LAW.inverse(machine.limit_mm / machine.stroke_mm)
    widest = machine.overlapped_deg / (1 - before)
    rest = DEG_PER_TURN - machine.work_deg - 2 * widest
    return rest >= _LEAST_REST_DEG and machine != SOURCE
