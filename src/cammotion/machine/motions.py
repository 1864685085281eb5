"""The motion of one mechanism over a turn of the camshaft.

It is said as an engineer says it: rise 50 mm over 55 deg, dwell 100, return 50 over 55, dwell 150,
starting at 150 deg. It fills one turn of 360 deg, may run on from one turn into the next, and
repeats. Most mechanisms come back to where they began. One that does not is an indexing motion:
each turn takes it one pitch on, from stop to stop, until the stops have closed the turret.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import JUMP, MotionLaw
from cammotion.machine.arcs import Arc, arcs, intersect
from cammotion.machine.kinematics import DEG_PER_TURN, RATE, cycle_time, into_turn, over_time
from cammotion.machine.segments import CAM_ANGLE, LIMIT, Segment, told
from cammotion.quantities import Floats, InputError, Numbers, Quantity, keep_numbers, plain, shorten
from cammotion.shown import as_table

_NOISE = 1e-8  # what is less, as a share of the largest value of all, is rounding everywhere
_ROUNDING = 1e-9  # by so much angles in deg and positions in mm may differ and mean the same
_ORDER = Quantity("order of the derivative", "", example=2, high=3)
HEADING = ("motion", "from deg", "to deg", "from mm", "to mm", "law")


@checked
@dataclass(frozen=True, repr=False)
class Motion:
    """What one mechanism does during a turn; `motion` and `indexing_motion` make one in words.

    `segments` follow each other without a gap over 360 deg. `stops` is None for a motion that
    comes back to where it began; for an indexing one, the number of stops that close the turret.
    Raises InputError for segments that overlap, leave a gap, jump, or do not close.
    """

    name: str
    segments: Sequence[Segment]
    stops: int | None = None

    def __post_init__(self) -> None:
        if not self.name.strip():
            raise InputError(f"The name of a motion is {shorten(self.name)}: give one like 'die'.")
        object.__setattr__(self, "name", self.name.strip())
        if not self.segments:
            raise InputError(f"The motion {self.name!r} has no segment: give at least one.")
        for before, after in pairwise(self.segments):
            self._check_joint(before, after)
        self._check_turn()
        self._check_end()

    def __repr__(self) -> str:
        low, high = self.range_mm
        stops = f", {self.stops} stops" if self.stops else ""
        parts = f"{len(self.segments)} segments from {low:.6g} to {high:.6g} mm"
        return f"Motion({shorten(self.name)}, {parts}{stops})"

    @property
    def rows(self) -> list[tuple[str | float, ...]]:
        """What a table lists of each segment: motion, angles in deg, positions in mm, law."""
        return [(self.name, *segment.row) for segment in self.segments]

    def _repr_html_(self) -> str:
        return as_table(HEADING, self.rows)

    @property
    def is_indexing(self) -> bool:
        """Whether it moves on from stop to stop instead of coming back."""
        return self.stops is not None

    @property
    def start_deg(self) -> float:
        """The cam angle at which the first segment begins."""
        return self.segments[0].from_deg

    @property
    def start_mm(self) -> float:
        """The position at which the first segment begins; of an indexing motion, a stop."""
        return self.segments[0].from_mm

    @property
    def pitch_mm(self) -> float:
        """How far a turn takes it: from stop to stop, or 0 for a motion that comes back."""
        return self.segments[-1].to_mm - self.start_mm if self.is_indexing else 0.0

    @property
    def moves(self) -> tuple[Segment, ...]:
        """The segments that are no dwells."""
        return tuple(segment for segment in self.segments if not segment.is_dwell)

    @cached_property
    def curve(self) -> Curve:
        """The position in mm over the turn that begins at `start_deg`, as a curve over deg.

        Its derivatives are by the cam angle, in mm/deg and so on.
        """
        return Curve(piece for segment in self.segments for piece in segment.curve.pieces)

    def steps(self, order: int) -> list[Arc]:
        """Return where a derivative of order 1, 2, 3 jumps: cam angle in deg, step in mm/deg^order.

        Also where a turn meets the next. A millionth of the largest value beside it is rounding,
        and so is a hundred-millionth of the largest in the turn.
        """
        curve, steps = self.curve.derived(_ORDER.whole(order)), []
        pieces, noise = curve.pieces, _NOISE * curve.largest
        for before, after in zip((pieces[-1], *pieces), pieces, strict=False):
            by = after.at(after.low) - before.at(before.high)
            beside = max(map(abs, (*before.extremes, *after.extremes)))
            if abs(by) > max(JUMP * beside, noise):
                steps.append((after.low % DEG_PER_TURN, by))
        return sorted(steps)

    def peak(self, order: int) -> float:
        """Return the largest magnitude of a derivative of order 1, 2, 3 over the whole turn.

        It is in mm/deg^order, and infinite where the derivative before it jumps.
        """
        order = _ORDER.whole(order)
        jumps = any(self.steps(lower) for lower in range(1, order))
        return math.inf if jumps else self.curve.derived(order).largest

    @cached_property
    def turning_degs(self) -> tuple[float, ...]:
        """The cam angles at which the position can be largest or smallest, in order."""
        corners = [angle for piece in self.curve.pieces for angle, _ in piece.corners[:-1]]
        return (*corners, self.curve.high)

    @cached_property
    def offset_turning_degs(self) -> tuple[float, ...]:
        """The cam angles at which `offset_mm` can be largest or smallest.

        That of an indexing motion also turns at each stop it passes, and half-way between two.
        """
        if not self.is_indexing:
            return self.turning_degs
        levels = {level for low, high in self._pitches for level in (low, (low + high) / 2, high)}
        passed = (end for level in levels for arc in self._where(level, 1) for end in arc)
        return (*self.turning_degs, *passed)

    @property
    def range_mm(self) -> tuple[float, float]:
        """The lowest and the highest position in a turn, the first one of an indexing motion."""
        return self.curve.extremes

    def shifted(self, angle_deg: float) -> "Motion":
        """Return the same motion, begun so many deg later, or earlier if below 0."""
        by, old = CAM_ANGLE.number(angle_deg), self.segments
        new = (replace(s, from_deg=s.from_deg + by, to_deg=s.to_deg + by) for s in old)
        return replace(self, segments=tuple(new))

    def with_law(self, law: str | MotionLaw) -> "Motion":
        """Return the same motion with another law for all its moves.

        >>> import cammotion as cm
        >>> cm.EXAMPLE.mill.with_law("modified sine").moves[0].law
        MotionLaw('modified sine')
        """
        segments = (s if s.is_dwell else replace(s, law=law) for s in self.segments)
        return replace(self, segments=tuple(segments))

    def position_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return the position in mm at a cam angle in deg, a number or an array of any shape.

        Any finite angle is allowed. A motion that comes back repeats every 360 deg; an indexing
        one is a pitch further each turn, until its stops have closed the turret.

        >>> import cammotion as cm
        >>> cm.EXAMPLE.mill.position_mm([75, 150, 360 + 75, 23 * 360 + 75, 24 * 360 + 75])
        array([  50.,  100.,  150., 2350.,   50.])
        """
        turns, phase = self._phase(angle_deg)
        pitches = np.mod(turns, self.stops) if self.stops else 0.0
        return plain(self.curve(phase) + (self.pitch_mm * pitches + 0.0))  # 0, not -0

    def offset_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return what a clearance is judged by, in mm, at a cam angle in deg, number or array.

        For a motion that comes back it is the position, for an indexing one the distance from the
        nearest stop.

        >>> import cammotion as cm
        >>> cm.EXAMPLE.mill.offset_mm([0, 15, 75, 135, 150]).round(4)
        array([ 0.    ,  0.6451, 50.    ,  0.6451,  0.    ])
        """
        positions = self.curve(self._phase(angle_deg)[1])
        if self.is_indexing:
            passed = np.mod(positions - self.start_mm, abs(self.pitch_mm))
            positions = np.minimum(passed, abs(self.pitch_mm) - passed)
        return plain(positions)

    def derivative(self, order: int, angle_deg: ArrayLike, rate_per_hour: float) -> Numbers:
        """Return the velocity, acceleration or jerk (order 1, 2, 3) at a machine rate, in m and s.

        Where two segments meet, but for rounding, it is that of the one which begins there.
        """
        time_s = cycle_time(RATE.number(rate_per_hour))
        curve = self.curve.derived(_ORDER.whole(order))
        begun = curve.begun(self._phase(angle_deg)[1])
        return plain(over_time(order, curve(begun, "right"), time_s))

    def where_beyond(self, limit_mm: float) -> list[Arc]:
        """Return the arcs of the turn over which `offset_mm` is larger than a limit, in deg.

        They are solved for, not sampled. Raises InputError for a limit that is not finite.

        >>> import cammotion as cm
        >>> [(start, end)] = cm.EXAMPLE.mill.where_beyond(0.65)
        >>> print(f"{start:.4f} {end:.4f}")
        15.0383 134.9617
        """
        limit = LIMIT.number(limit_mm)
        if limit not in self._beyond:  # rules ask the same again and again
            self._beyond[limit] = self._solve_beyond(limit)
        return list(self._beyond[limit])

    @cached_property
    def _beyond(self) -> dict[float, list[Arc]]:
        return {}

    def _solve_beyond(self, limit: float) -> list[Arc]:
        if not self.is_indexing:
            return self._where(limit, 1)
        return arcs(
            arc
            for stop, next_stop in self._pitches
            for arc in intersect(self._where(stop + limit, 1), self._where(next_stop - limit, -1))
        )

    @property
    def _pitches(self) -> list[tuple[float, float]]:
        """Each stop that an indexing motion comes to in a turn, with the next one above it."""
        first, second = sorted((self.start_mm, self.segments[-1].to_mm))
        pitch = second - first
        low, high = (math.floor((end - first) / pitch) for end in self.range_mm)
        return [(first + n * pitch, second + n * pitch) for n in range(low, high + 1)]

    def _where(self, limit_mm: float, side: int) -> list[Arc]:
        """Return the arcs over which it is above a position (side 1) or below it (-1)."""
        return arcs(self.curve.where(limit_mm, side, _ROUNDING))

    def _phase(self, angle_deg: ArrayLike) -> tuple[Floats, Floats]:
        """Return how many turns after the first one, and the cam angle within that."""
        return into_turn(CAM_ANGLE.array(angle_deg), self.start_deg)

    def _check_joint(self, before: Segment, after: Segment) -> None:
        gap = after.from_deg - before.to_deg
        if gap < -_ROUNDING:
            raise InputError(
                f"Segments of {self.name!r} overlap: the {before.kind} ends at "
                f"{before.to_deg:.12g} deg, but the {after.kind} after it begins at "
                f"{after.from_deg:.12g} deg: let it begin {told(gap)} deg later."
            )
        if gap > _ROUNDING:
            raise InputError(
                f"The segments of {self.name!r} leave a gap from {before.to_deg:.12g} to "
                f"{after.from_deg:.12g} deg: add a dwell of {told(gap)} deg."
            )
        if abs(after.from_mm - before.to_mm) > _ROUNDING:
            raise InputError(
                f"The motion {self.name!r} jumps at {after.from_deg:g} deg from "
                f"{before.to_mm:.12g} to {after.from_mm:.12g} mm: let each segment begin where "
                "the one before it ends."
            )

    def _check_turn(self) -> None:
        total = self.segments[-1].to_deg - self.start_deg
        missing = DEG_PER_TURN - total
        if abs(missing) > _ROUNDING:
            fix = f"{'add a dwell of' if missing > 0 else 'take away'} {told(missing)}"
            raise InputError(
                f"The segments of {self.name!r} add up to {total:.12g} deg; a cam turn is "
                f"{DEG_PER_TURN}: {fix} deg."
            )

    def _check_end(self) -> None:
        way = self.segments[-1].to_mm - self.start_mm
        if self.stops is None and abs(way) > _ROUNDING:
            raise InputError(
                f"The motion {self.name!r} ends {told(way)} mm from where it began: add a "
                f"{'return' if way > 0 else 'rise'} of {told(way)} mm, or, if it "
                "moves on from stop to stop, give its stops (indexing_motion does)."
            )
        if self.stops is None:
            return
        stops = Quantity(f"number of stops of {self.name!r}", "", example=24, high=1e9)
        keep_numbers(self, stops=stops.whole)
        if abs(way) <= _ROUNDING:
            raise InputError(
                f"The indexing motion {self.name!r} ends where it began, and an indexing motion "
                "moves on: leave out its return, or its stops (make it with motion)."
            )
