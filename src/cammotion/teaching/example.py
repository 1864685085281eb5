"""The running example: a die that presses into an indexing mill, and its numbers."""

from dataclasses import dataclass, field, fields
from functools import cached_property, lru_cache
from typing import Any

from cammotion.limits.widest import widest_move
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN, peak_acceleration
from cammotion.machine.motions import Motion
from cammotion.machine.parts import dwell, indexing_motion, motion, return_, rise
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import beyond, within
from cammotion.teaching.cam_numbers import CamNumbers, cam_numbers
from cammotion.teaching.fit_numbers import FitNumbers
from cammotion.teaching.follower_numbers import FollowerNumbers
from cammotion.teaching.law_numbers import LawNumbers
from cammotion.teaching.measured_numbers import MeasuredNumbers
from cammotion.teaching.table_numbers import TableNumbers

QUIET_SHARE = 0.1
"""The share of the mill's time, at either end of its move, in which it does the die no harm."""

_GEOMETRY = (
    "pitch_mm",
    "stops",
    "mill_angle_deg",
    "work_deg",
    "wait_mm",
    "pocket_mm",
    "gap_mm",
    "margin_mm",
)


@dataclass(frozen=True, kw_only=True, repr=False)
class MillAndDie:
    """The numbers of a die that presses into an indexing mill; lengths in mm, angles in deg.

    >>> EXAMPLE.die_angle_deg
    55.0
    >>> print(f"{EXAMPLE.widest_deg:.2f}")
    124.84
    """

    who: str = field(default="", compare=False)
    remark: str = field(default="", compare=False)
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
    fits: FitNumbers = field(default_factory=FitNumbers)
    laws: LawNumbers = field(default_factory=LawNumbers)
    table: TableNumbers = field(default_factory=TableNumbers)
    measured: MeasuredNumbers = field(default_factory=MeasuredNumbers)
    follower: FollowerNumbers = field(default_factory=FollowerNumbers)

    def __hash__(self) -> int:
        """Return the hash of the numbers, worked out once: what follows from them is kept by it."""
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash(tuple(getattr(self, each.name) for each in fields(self) if each.compare))

    def __repr__(self) -> str:
        """Say all the numbers in words."""
        nobodys = "The machine of the source" if self == EXAMPLE else "Another machine"
        whose = f"The machine of {self.who}" if self.who else nobodys
        remark = f" {self.remark}" if self.remark else ""
        return (
            f"{whose}: {self.rate_per_hour:g} pieces per hour. The mill moves {self.pitch_mm:g} mm "
            f"over {self.mill_angle_deg:g} degrees and has {self.stops} stops. The die, "
            f"{self.die_mass_kg:g} kg, waits {self.wait_mm:g} mm above it and goes into a pocket "
            f"of {self.pocket_mm:g} mm, to {self.gap_mm:g} mm above the bottom: a stroke of "
            f"{self.stroke_mm:g} mm. It works for {self.work_deg:g} degrees.{remark}"
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
        return _widest_deg(*(getattr(self, name) for name in _GEOMETRY))

    @property
    def told_deg(self) -> float:
        """The widest indexing angle of the die as questions tell it, to two decimals."""
        return round(self.widest_deg, 2)

    @cached_property
    def cam(self) -> CamNumbers:
        """The cam of the die, without overlap, that notebook 07 asks about."""
        peak = float(peak_acceleration(self.stroke_mm, self.die_angle_deg, self.rate_per_hour))
        return cam_numbers(self.stroke_mm, self.die_angle_deg, self.die_mass_kg * peak)

    @cached_property
    def mill(self) -> Motion:
        """The motion of the mill, from 0 deg on."""
        return indexing_motion(
            "mill",
            rise(self.pitch_mm, over_deg=self.mill_angle_deg),
            dwell(DEG_PER_TURN - self.mill_angle_deg),
            stops=self.stops,
        )

    @cached_property
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

    @cached_property
    def diagram(self) -> TimingDiagram:
        """The timing diagram of both without overlap."""
        return TimingDiagram((self.mill, self.die), self.rate_per_hour)

    @cached_property
    def rule(self) -> ClearanceRule:
        """The clearance rule: deep only while the mill is as near a stop as in its quiet ends."""
        near = float(self.mill.offset_mm(self.mill_angle_deg - self.quiet_deg))
        return ClearanceRule(beyond("die", self.limit_mm), only_while=within("mill", near))


@lru_cache(maxsize=2**10)
def _widest_deg(*geometry: float) -> float:
    """Return the widest angle by all that it depends on: many machines ask about the same one."""
    given: dict[str, Any] = dict(zip(_GEOMETRY, geometry, strict=True))
    machine = MillAndDie(**given)
    return widest_move(machine.diagram, "die", machine.rule).angle_deg


EXAMPLE = MillAndDie()
"""The machine of the source."""
