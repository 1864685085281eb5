"""The timing diagram: the motions of all mechanisms of a machine on one camshaft, at a rate."""

import math
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.machine.arcs import Arc, arcs, intersect, unwrap
from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MINUTES_PER_HOUR,
    RATE,
    Move,
    cycle_time,
    over_time,
)
from cammotion.machine.motions import HEADING, Motion
from cammotion.machine.segments import CAM_ANGLE, arcs_of
from cammotion.quantities import InputError, Numbers, Quantity, keep_numbers, one_of, plain, shorten
from cammotion.shown import as_table

TIME = Quantity("time", "s", example=0.9, low=-math.inf)

At = ArrayLike | None  # where a curve is asked for, by an angle or by a time


@checked
@dataclass(frozen=True, repr=False)
class TimingDiagram:
    """The motions of any number of mechanisms, and the machine rate N in pieces/h.

    A rate in cycles or turns of the camshaft a minute is `rate_per_hour=per_minute(40)`. Each
    motion has a name of its own: wherever one is asked about, its name is given or itself. Raises
    InputError for no motion, for two of one name, and for a rate that is not above 0.

    >>> import cammotion as cm
    >>> diagram = cm.TimingDiagram([cm.EXAMPLE.mill, cm.EXAMPLE.die], rate_per_hour=2000)
    >>> diagram.position_mm("die", 177.5)
    25.0
    >>> diagram.position_mm("die", time_s=0.8875)
    25.0
    >>> print(f"{diagram.peak_acceleration('die'):.3f} m/s2")
    4.154 m/s2
    """

    motions: Sequence[Motion]
    rate_per_hour: float

    def __post_init__(self) -> None:
        if not self.motions:
            raise InputError("The diagram has no motion: give at least one.")
        keep_numbers(self, rate_per_hour=RATE.number)
        name, times = Counter(self.names).most_common(1)[0]
        if times > 1:
            raise InputError(
                f"{times} motions of the diagram are called {name!r}: give each its own name."
            )

    def __repr__(self) -> str:
        names = shorten(", ".join(self.names), of=str)
        return f"TimingDiagram({names} at {self.rate_per_hour:g} pieces/h)"

    def _repr_html_(self) -> str:
        return as_table(HEADING, [row for motion in self.motions for row in motion.rows])

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the motions, in order."""
        return tuple(motion.name for motion in self.motions)

    @property
    def rpm(self) -> float:
        """How many turns a minute the camshaft makes, and how many cycles the machine."""
        return self.rate_per_hour / MINUTES_PER_HOUR

    @property
    def cycle_time_s(self) -> float:
        """The time of one turn in s."""
        return float(cycle_time(self.rate_per_hour))

    def __getitem__(self, motion: str | Motion) -> Motion:
        """Return the motion of that name, or the motion that is given, if the diagram has it.

        An unknown name raises InputError with the known, a motion that is another one here too.

        >>> import cammotion as cm
        >>> cm.EXAMPLE.diagram[cm.EXAMPLE.die.shifted(5)]
        Traceback (most recent call last):
        cammotion.InputError: The motion 'die' is another one in the diagram: put this one into it \
first, with_motion(...), or give the name.
        """
        names = self.names
        own = self.motions[names.index(one_of("motion", name_of(motion), names))]
        if isinstance(motion, Motion) and motion != own:
            raise InputError(
                f"The motion {shorten(own.name)} is another one in the diagram: put this one into "
                "it first, with_motion(...), or give the name."
            )
        return own

    @checked
    def with_motion(self, motion: Motion) -> "TimingDiagram":
        """Return the diagram with this motion in the place of that of the same name."""
        old = self[motion.name]
        return replace(self, motions=[motion if each is old else each for each in self.motions])

    def at_rate(self, rate_per_hour: float) -> "TimingDiagram":
        """Return the same motions at another machine rate, in pieces/h."""
        return replace(self, rate_per_hour=rate_per_hour)

    def angle_deg(self, time_s: ArrayLike) -> Numbers:
        """Return the cam angle in deg at a time in s, a number or an array; 0 deg is at 0 s."""
        return plain(TIME.array(time_s) * (DEG_PER_TURN / self.cycle_time_s))

    def position_mm(
        self, motion: str | Motion, angle_deg: At = None, *, time_s: At = None
    ) -> Numbers:
        """Return the position in mm of a motion at a cam angle in deg or a time in s.

        Give the one or the other, a number or an array of any shape, of any size; the result has
        its shape. Raises InputError for what is not finite, for both or neither, and for
        what is no motion of the diagram.
        """
        return self[motion].position_mm(self._angle(angle_deg, time_s))

    def offset_mm(
        self, motion: str | Motion, angle_deg: At = None, *, time_s: At = None
    ) -> Numbers:
        """Return the position in mm at a cam angle or a time, of a turret how far from a stop."""
        return self[motion].offset_mm(self._angle(angle_deg, time_s))

    def velocity(self, motion: str | Motion, angle_deg: At = None, *, time_s: At = None) -> Numbers:
        """Return the velocity in m/s at a cam angle or a time; at a joint, what begins there."""
        return self._derivative(1, motion, angle_deg, time_s)

    def acceleration(
        self, motion: str | Motion, angle_deg: At = None, *, time_s: At = None
    ) -> Numbers:
        """Return the acceleration in m/s2 at a cam angle or a time; at a joint, what begins."""
        return self._derivative(2, motion, angle_deg, time_s)

    def jerk(self, motion: str | Motion, angle_deg: At = None, *, time_s: At = None) -> Numbers:
        """Return the jerk in m/s3 at a cam angle or a time; at a joint, what begins there."""
        return self._derivative(3, motion, angle_deg, time_s)

    def moves(self, motion: str | Motion) -> tuple[Move, ...]:
        """Return the rises and returns of a motion as moves, each as if from rest to rest."""
        rate = self.rate_per_hour
        return tuple(
            Move(stroke_mm=abs(way), angle_deg=segment.angle_deg, rate_per_hour=rate, law=law)
            for segment in self[motion].moves
            for way, law in [(segment.change_mm, as_law(segment.law))]
        )

    def peak_velocity(self, motion: str | Motion) -> float:
        """Return the peak velocity of a motion in m/s; 0 for one that stands still."""
        return self._peak(1, motion)

    def peak_acceleration(self, motion: str | Motion) -> float:
        """Return the peak acceleration of a motion in m/s2; infinite where its velocity jumps."""
        return self._peak(2, motion)

    def peak_jerk(self, motion: str | Motion) -> float:
        """Return the peak jerk of a motion in m/s3; infinite where its acceleration jumps."""
        return self._peak(3, motion)

    def overlap(self, *motions: str | Motion) -> list[Arc]:
        """Return the arcs of the turn in deg over which two or more of these motions move at once.

        Without names it looks at all motions. An arc that crosses 360 deg ends above 360.
        """
        names = {name_of(self[motion]) for motion in motions or self.names}
        moving = [arcs_of(self[name].moves) for name in names]
        return unwrap(
            arcs(arc for these, those in combinations(moving, 2) for arc in intersect(these, those))
        )

    def _angle(self, angle_deg: At, time_s: At) -> Numbers:
        if angle_deg is not None and time_s is None:
            return CAM_ANGLE.array(angle_deg)
        if angle_deg is None and time_s is not None:
            return self.angle_deg(time_s)
        raise InputError(
            "A curve is asked for at a cam angle or at a time, at one of the two: give "
            "angle_deg=180 or time_s=0.9."
        )

    def _peak(self, order: int, motion: str | Motion) -> float:
        return float(over_time(order, self[motion].peak(order), self.cycle_time_s))

    def _derivative(self, order: int, motion: str | Motion, angle_deg: At, time_s: At) -> Numbers:
        angle = self._angle(angle_deg, time_s)
        return self[motion].derivative(order, angle, self.rate_per_hour)


def name_of(motion: str | Motion) -> str:
    """Return the name of a motion that is given by it or itself."""
    return motion.name if isinstance(motion, Motion) else motion


def as_diagram(diagram: Any) -> TimingDiagram:
    """Return what is a timing diagram; raise InputError for anything else."""
    if isinstance(diagram, TimingDiagram):
        return diagram
    raise InputError(
        f"The diagram is {shorten(diagram)}: give a TimingDiagram of the motions, for example "
        "TimingDiagram([mill, die], rate_per_hour=2000)."
    )
