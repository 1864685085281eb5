"""The indexer: from a law, an inertia and a time to torque and power, over the whole index.

A table of inertia I turns by h = 2 pi / stops in the time tm. With the law's S over x = t/tm,

    omega = h/tm V,   alpha = h/tm^2 A,   torque = I alpha + friction + work,

and the power is torque times omega.

A camshaft that turns by Bm meanwhile, at the even speed Omega = Bm/tm, has to give that power:
its torque is power/Omega. It is positive while the shaft drives, negative while the table does.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import chain, pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cammotion.bracketed import cuts, largest
from cammotion.hardware.rotor import Rotor
from cammotion.laws.catalogue import as_law
from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.piece import Piece, bisect
from cammotion.machine.kinematics import ANGLE
from cammotion.quantities import Floats, InputError, Numbers, Quantity, keep_numbers, plain

_INERTIA = Quantity("inertia", "kg m2", example=38.5, instead="a Rotor of its parts")
_STOPS = Quantity("number of stops", "", example=8, low=2, low_included=True)
_TIME = Quantity("indexing time", "s", example=0.75)
_CYCLE = Quantity("cycle time", "s", example=1.8)
_FRICTION = Quantity("friction torque", "N m", example=10, low_included=True)
_WORK = Quantity("work torque", "N m", example=0, low_included=True)
_SAFETY = Quantity("safety factor", "", example=1.5, low=1, low_included=True)
_BACKLASH = Quantity("backlash", "deg", example=0.02)
_SAME = 1e-12  # of the index: 0.1 + 0.2 s are a cycle of 0.3
_STILL = 1e-9  # of index and time: a speed that is none
_NODES = 24  # with which a smooth part is integrated


@dataclass(frozen=True)
class Indexer:
    """A table that a law turns from stop to stop, and what that takes.

    `turns` is what turns, a Rotor or its inertia in kg m2, `stops` the number of stops in a turn of
    the table, `time_s` the indexing time tm. `friction_N_m` acts against the motion, the other way
    round where the law goes backwards; `work_N_m` is what else holds the table back; both are taken
    as constant while the table moves. `safety` is what the required torque is larger by. Raises
    InputError for numbers out of range, and for a law whose velocity jumps or that does not go from
    0 to 1.

    >>> table = Indexer(38.5, stops=8, time_s=0.75, law="modified sine", friction_N_m=10)
    >>> print(f"{table.peak_acceleration_rad_per_s2:.3f} rad/s2, {table.peak_torque_N_m:.2f} N m")
    7.718 rad/s2, 307.16 N m
    """

    turns: float | Rotor
    stops: int
    time_s: float
    law: str | MotionLaw = "modified sine"
    friction_N_m: float = 0.0  # noqa: N815 (units)
    work_N_m: float = 0.0  # noqa: N815
    safety: float = 1.0

    def __post_init__(self) -> None:
        if not isinstance(self.turns, Rotor):
            keep_numbers(self, turns=_INERTIA.number)
        _INERTIA.number(self.inertia_kg_m2)  # that of a rotor may be 0
        keep_numbers(
            self,
            stops=_STOPS.whole,
            time_s=_TIME.number,
            friction_N_m=_FRICTION.number,
            work_N_m=_WORK.number,
            safety=_SAFETY.number,
        )
        object.__setattr__(self, "law", as_law(self.law))
        self._law.check_way()
        if not math.isfinite(self._law.Ca):
            raise InputError(
                f"The velocity of the law {self._law.name!r} jumps, and no torque turns a table "
                "like that: give a law from rest to rest, for example 'modified sine'."
            )

    @property
    def inertia_kg_m2(self) -> float:
        """The moment of inertia of what turns, in kg m2."""
        return self.turns.inertia_kg_m2 if isinstance(self.turns, Rotor) else self.turns

    @property
    def step_rad(self) -> float:
        """The angle of one index, in rad."""
        return 2 * math.pi / self.stops

    @property
    def peak_velocity_rad_per_s(self) -> float:
        """The largest angular velocity, Cv h/tm, in rad/s."""
        return self._law.Cv * self.step_rad / self.time_s

    @property
    def peak_acceleration_rad_per_s2(self) -> float:
        """The largest angular acceleration, Ca h/tm^2, in rad/s2."""
        return self._law.Ca * self._per_a

    @property
    def inertia_torque_N_m(self) -> float:  # noqa: N802 (units, here and below)
        """The largest torque of the inertia alone, in N m."""
        return self.inertia_kg_m2 * self.peak_acceleration_rad_per_s2

    @property
    def peak_torque_N_m(self) -> float:  # noqa: N802
        """The largest torque of all, in either direction, without the safety factor, in N m."""
        runs = ((drag, curve.derived(2).extremes) for curve, drag in self._runs)
        per_a = self.inertia_kg_m2 * self._per_a
        return max(abs(per_a * a + drag) for drag, ends in runs for a in ends)

    @property
    def required_torque_N_m(self) -> float:  # noqa: N802
        """The largest torque times the safety factor, in N m."""
        return self.safety * self.peak_torque_N_m

    @property
    def kinetic_energy_J(self) -> float:  # noqa: N802
        """The energy of the table at its fastest, in J: put in, and taken out again."""
        return self.inertia_kg_m2 * self.peak_velocity_rad_per_s**2 / 2

    def velocity_rad_per_s(self, x: ArrayLike) -> Numbers:
        """Return the angular velocity in rad/s at x = t/tm, 0 to 1, a number or an array."""
        return self._law(x, 1) * self.step_rad / self.time_s

    def acceleration_rad_per_s2(self, x: ArrayLike) -> Numbers:
        """Return the angular acceleration in rad/s2 at x = t/tm, 0 to 1, a number or an array."""
        return self._law(x, 2) * self._per_a

    def torque_N_m(self, x: ArrayLike) -> Numbers:  # noqa: N802
        """Return the torque on the table in N m at x = t/tm, 0 to 1, a number or an array.

        >>> table = Indexer(38.5, stops=8, time_s=0.75, friction_N_m=10)
        >>> table.torque_N_m([0.125, 0.5, 0.875]).round(1)
        array([ 307.2,   10. , -287.2])
        """
        return plain(self.inertia_kg_m2 * self.acceleration_rad_per_s2(x) + self._drag_at(x))

    def power_W(self, x: ArrayLike) -> Numbers:  # noqa: N802
        """Return the power in W at x = t/tm, 0 to 1: negative where the table drives."""
        return self.torque_N_m(x) * self.velocity_rad_per_s(x)

    @cached_property
    def peak_power_W(self) -> float:  # noqa: N802
        """The largest power in either direction, in W; without friction I hm^2/tm^3 Cq.

        >>> print(f"{Indexer(38.5, stops=8, time_s=0.75).peak_power_W:.0f} W")
        307 W
        """

        def power(piece: Piece, places: Floats) -> Floats:
            speed = piece.derivative.over(places.copy()) * (self.step_rad / self.time_s)
            return np.abs(self._torque_over(piece, places) * speed)

        return largest(power, self._pieces).value

    def camshaft_torque_N_m(self, x: ArrayLike, angle_deg: float) -> Numbers:  # noqa: N802
        """Return the torque on the camshaft in N m at x = t/tm, 0 to 1, a number or an array.

        `angle_deg` is the indexing angle Bm, which the shaft turns evenly in the indexing time.
        The cam is taken as without losses. Raises InputError for an angle out of range.

        >>> mill = Indexer(38.5, stops=8, time_s=0.75)
        >>> mill.camshaft_torque_N_m([0.25, 0.5, 0.75], angle_deg=150).round(1)
        array([ 84.9,   0. , -84.9])
        """
        return self.power_W(x) / self._shaft_rad_per_s(angle_deg)

    def peak_camshaft_torque_N_m(self, angle_deg: float) -> float:  # noqa: N802
        """Return the largest torque on the camshaft, in either direction, in N m."""
        return self.peak_power_W / self._shaft_rad_per_s(angle_deg)

    def rms_torque_N_m(self, cycle_s: float) -> float:  # noqa: N802
        """Return the root mean square of the torque over a cycle, in N m, as it heats a servo.

        `cycle_s` is the time from index to index; while it rests the table takes no torque. Raises
        InputError for a cycle that is shorter than the index.

        >>> print(f"{Indexer(38.5, stops=8, time_s=0.75).rms_torque_N_m(1.8):.1f} N m")
        135.6 N m
        """
        cycle = _CYCLE.number(cycle_s)
        if cycle < self.time_s * (1 - _SAME):
            raise InputError(
                f"The cycle time is {cycle:g} s, and the index alone takes {self.time_s:g} s: give "
                f"a cycle of at least {self.time_s:g} s."
            )
        nodes, weights = np.polynomial.legendre.leggauss(_NODES)
        total = 0.0
        for piece in self._pieces:
            ends = np.array([piece.low, *cuts(piece), piece.high])
            half = np.diff(ends) / 2
            places = ends[:-1, None] + half[:, None] * (1 + nodes)
            torque = self._torque_over(piece, places.ravel()).reshape(places.shape)
            total += float(half @ (torque**2 @ weights))
        return math.sqrt(total * self.time_s / cycle)

    @property
    def braking(self) -> list[tuple[float, float]]:
        """The intervals of x in which the torque is negative: the drive holds the table back.

        Where friction turns with the law, one of them ends and the next begins.

        >>> Indexer(38.5, stops=8, time_s=0.75).braking
        [(0.5, 1.0)]
        """
        per_a = self.inertia_kg_m2 * self._per_a
        found = (curve.derived(2).where(-drag / per_a, -1, 1e-12) for curve, drag in self._runs)
        return [*chain.from_iterable(found)]

    def impact_rad_per_s(self, backlash_deg: float) -> float:
        """Return how fast the table runs into the other flank when the torque turns, in rad/s.

        `backlash_deg` is how far the table can turn while the drive stands. From where the torque
        becomes negative the table runs free, slowed by friction and work alone, until the drive,
        which goes on by its law, has fallen back by the backlash. Where they stop it first,
        friction holds it, or a larger work turns it back. A table that is braked only by these
        never gets there: 0. Raises InputError for a backlash that is not used up while the table is
        faster than its drive and before the index ends.

        >>> print(f"{Indexer(38.5, stops=8, time_s=0.75).impact_rad_per_s(0.02):.4f} rad/s")
        0.0286 rad/s
        """
        backlash = _BACKLASH.number(backlash_deg)
        gap = math.radians(backlash) / self.step_rad
        if not self.braking:
            return 0.0
        law, start = self._law, self.braking[0][0]
        at, free = law(start), self._let_go(start)

        def ahead(x: float) -> float:
            return float(free(x)[0] - (law(x) - at))

        def faster(x: float) -> float:
            return float(free(x)[1] - law(x, 1))

        end = self._gained_until(faster)
        if ahead(end) < gap:
            most = math.degrees(ahead(end) * self.step_rad)
            raise InputError(
                f"The backlash is {backlash:g} deg, and while it is faster than its drive the "
                f"table gains only {most:.4g} deg on it: give a smaller backlash."
            )
        hit = bisect(lambda x: ahead(x) < gap, start, end)
        return faster(hit) * self.step_rad / self.time_s

    def _let_go(self, start: float) -> Callable[[float], tuple[float, float]]:
        """Return, over x, how far a table has turned that is let go at `start`, and how fast it is.

        Stopped, it is held by friction, or turned back by what work is larger by.
        """
        speed, slowed = float(self._law(start, 1)), self._as_a(self.work_N_m + self.friction_N_m)
        turned = self._as_a(max(self.work_N_m - self.friction_N_m, 0.0))
        stops = max(speed, 0.0) / slowed if slowed else math.inf

        def free(x: float) -> tuple[float, float]:
            on = min(x - start, stops)
            then, left = x - start - on, speed - slowed * on
            way = speed * on - slowed * on**2 / 2 + left * then - turned * then**2 / 2
            return way, left - turned * then

        return free

    def _gained_until(self, faster: Callable[[float], float]) -> float:
        """Return the x up to which a free table is faster than its drive, 1 if it is to the end.

        While the drive brakes it becomes slower than the table, and between only less so.
        """
        braked = [end for _, end in self.braking]
        again = [*(start for start, _ in self.braking[1:]), 1.0]
        for low, high in zip(braked, again, strict=True):
            if faster(high) < _STILL:  # both may stand there
                return bisect(lambda x: faster(x) > 0, low, high)
        return 1.0

    @cached_property
    def _law(self) -> MotionLaw:
        return as_law(self.law)

    @property
    def _per_a(self) -> float:
        return self.step_rad / self.time_s**2

    @cached_property
    def _runs(self) -> list[tuple[Curve, float]]:
        """The law cut where friction turns back with it, and what friction and work take in N m."""
        law, found = self._law.curve, []
        backwards = law.derived(1).where(0.0, -1, _SAME) if self.friction_N_m else []
        for number, ends in enumerate(pairwise([0.0, *chain.from_iterable(backwards), 1.0])):
            if pieces := law.between(*ends) if backwards else law.pieces:
                friction = -self.friction_N_m if number % 2 else self.friction_N_m
                found.append((Curve(pieces), friction + self.work_N_m))
        return found

    @property
    def _pieces(self) -> list[Piece]:
        return [piece for curve, _ in self._runs for piece in curve.pieces]

    def _drag_at(self, x: ArrayLike) -> Any:
        """Return friction and work in N m at x, where the law turns back of what comes after."""
        curves, drags = zip(*self._runs, strict=True)
        return np.array(drags)[np.searchsorted([each.low for each in curves[1:]], x, side="right")]

    def _as_a(self, torque_N_m: float) -> float:  # noqa: N803 (units)
        """Return how the law's A would be if that torque alone braked the table."""
        return torque_N_m / (self.inertia_kg_m2 * self._per_a)

    def _torque_over(self, piece: Piece, places: Floats) -> Floats:
        """Return the torque in N m over a piece of the law."""
        a = piece.derivative.derivative.over(places.copy())
        return np.asarray(self.inertia_kg_m2 * self._per_a * a + self._drag_at(places))

    def _shaft_rad_per_s(self, angle_deg: Any) -> float:
        return math.radians(ANGLE.number(angle_deg)) / self.time_s
