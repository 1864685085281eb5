"""A follower that a spring presses on its cam, and that leaves it: when, and how hard it lands.

The cam is rigid, and the follower one mass. It leaves where the force between the two would be
below 0, flies freely, and lands where the cam is in its way again. Of the velocity with which they
meet the part `restitution` is thrown back; without one the follower stays, and leaves at once where
the cam still falls away beneath it.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.dynamics.flight import Cam, Fall
from cammotion.dynamics.loads import FollowerLoad
from cammotion.dynamics.turns import Flight, Run
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, RATE
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE
from cammotion.quantities import (
    Floats,
    InputError,
    Numbers,
    Quantity,
    WrongAnswerError,
    as_text,
    plain,
    shorten,
)

TURNS = Quantity("number of turns", "", example=3, high=1000)
RESTITUTION = Quantity("restitution", "", example=0.3, high=1, low_included=True)
_SAME_DEG = 1e-6  # by so much the flights of two turns may differ that are the same
_MISSED = 1e-9  # of the travel
_LACK = 1e-6  # of the largest force
_PROBES = 129


@dataclass(frozen=True)
class Flights:
    """What a follower does on its cam over some turns; made by `follower_flights`.

    It is a sequence of `Flight`, in order. `stuck_at_deg` are the cam angles at which bounces
    without number were taken as at an end.
    """

    motion: Motion
    load: FollowerLoad
    rate_per_hour: float
    turns: float
    restitution: float
    flights: tuple[Flight, ...]
    stuck_at_deg: tuple[float, ...]
    falls: tuple[Fall, ...] = field(compare=False)

    def __repr__(self) -> str:
        rate, turns = f"{self.rate_per_hour:g} pieces/h", f"{len(self)} in {self.turns:g} turns"
        return f"Flights({shorten(self.motion.name, of=str)} at {rate}: {turns})"

    def __len__(self) -> int:
        return len(self.flights)

    def __iter__(self) -> Iterator[Flight]:
        return iter(self.flights)

    def __getitem__(self, number: int) -> Flight:
        return self.flights[number]

    @property
    def begins_at_deg(self) -> float:
        """The cam angle at which the follower is on the cam, at rest beside it."""
        return self.motion.start_deg

    @property
    def last_turn(self) -> tuple[Flight, ...]:
        """The flights that begin in the last turn."""
        return self._of_turn(1)

    @property
    def into_last_turn(self) -> Flight | None:
        """The flight in which the follower is where the last turn begins, None on the cam."""
        return self._over(self._begin_of(1), self._begin_of(1))

    @property
    def period(self) -> int | None:
        """After how many turns the flights come again; None if they have not yet.

        >>> import cammotion as cm
        >>> load = FollowerLoad(mass_kg=12, preload_N=10)
        >>> follower_flights(cm.EXAMPLE.die, load, 2000).period
        1
        """
        for turns in range(1, int(self.turns) // 2 + 1):
            if self._over(self._begin_of(2 * turns), self._begin_of(turns)):
                continue  # such a flight begins in none of the turns that are compared
            last, before = (
                [f for back in range(turns) for f in self._of_turn(first + back)]
                for first in (1, 1 + turns)
            )
            shifted = np.array([f[:2] for f in before]) + turns * DEG_PER_TURN
            if len(last) == len(before) and np.allclose(
                np.array([f[:2] for f in last]), shifted, rtol=0, atol=_SAME_DEG
            ):
                return turns
        return None

    def gap_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return the gap in mm at a cam angle in deg, a number or an array; 0 on the cam.

        Raises InputError for an angle outside of the turns.
        """
        angles = self._inside(angle_deg)
        gaps = np.zeros(angles.shape)
        for flight, fall in zip(self.flights, self.falls, strict=True):
            there = (angles > flight.leaves_at_deg) & (angles < flight.lands_at_deg)
            if there.any():
                gap = self._cam.gap(fall, flight.leaves_at_deg, angles[there])
                gaps[there] = np.maximum(gap, 0.0)
        return plain(gaps)

    def position_mm(self, angle_deg: ArrayLike) -> Numbers:
        """Return the follower's position in mm at a cam angle: the motion's, or above it."""
        return plain(np.asarray(self.motion.position_mm(angle_deg)) + self.gap_mm(angle_deg))

    def force_N(self, angle_deg: ArrayLike) -> Numbers:  # noqa: N802
        """Return the force in N between cam and follower; 0 in flight, and without the impacts."""
        angles = self._inside(angle_deg)
        force = np.asarray(self.load.force_N(self.motion, angles, self.rate_per_hour)).copy()
        for flight in self.flights:
            # from the very place on: a landing that throws it back presses for no time at all
            force[(angles >= flight.leaves_at_deg) & (angles < flight.lands_at_deg)] = 0.0
        return plain(force)

    def __str__(self) -> str:
        if not self.flights:
            return f"In {self.turns:g} turns the follower does not leave its cam."
        widest = max(self.flights, key=lambda flight: flight.gap_mm)
        hardest = max(self.flights, key=lambda flight: flight.impact_m_per_s)
        said = [
            f"In {self.turns:g} turns the follower leaves its cam {_times(len(self.flights))}, by "
            f"{as_text(widest.gap_mm, '.4g')} mm at most, and lands with up to "
            f"{as_text(hardest.impact_m_per_s, '.4g')} m/s."
        ]
        if self.stuck_at_deg:
            said.append(
                f"Bounces without number were taken as at an end {_times(len(self.stuck_at_deg))}, "
                f"first at {self.stuck_at_deg[0]:.6g} deg."
            )
        return " ".join(said)

    @cached_property
    def _cam(self) -> Cam:
        return Cam.of(self.motion, self.rate_per_hour)

    def _begin_of(self, back: int) -> float:
        """Return where the turn begins that is so many back from the end, the last being 1."""
        return self.begins_at_deg + DEG_PER_TURN * (self.turns - back)

    def _over(self, first_deg: float, last_deg: float) -> Flight | None:
        """Return the flight that begins before one angle and lands after another."""
        before, after = first_deg - _SAME_DEG, last_deg + _SAME_DEG
        return next((f for f in self.flights if f[0] < before and f[1] > after), None)

    def _of_turn(self, back: int) -> tuple[Flight, ...]:
        end = self._begin_of(back - 1)
        return tuple(
            flight
            for flight in self.flights
            if end - DEG_PER_TURN - _SAME_DEG <= flight.leaves_at_deg < end - _SAME_DEG
        )

    def _inside(self, angle_deg: ArrayLike) -> Floats:
        end = self.begins_at_deg + self.turns * DEG_PER_TURN
        known = Quantity(
            CAM_ANGLE.name, "deg", self.begins_at_deg, self.begins_at_deg, end, low_included=True
        )
        return known.array(angle_deg)


@checked
def follower_flights(
    motion: Motion,
    load: FollowerLoad,
    rate_per_hour: float,
    *,
    turns: float = 3,
    restitution: float = 0.0,
) -> Flights:
    """Return where a follower leaves its cam, and where and how hard it lands, over some turns.

    `motion` comes back, `load` says what presses the follower on the cam, at a machine rate in
    pieces/h. The follower begins on the cam where the motion begins, with the machine at its rate.
    `restitution`, 0 to 1, is the part of the impact's velocity that is thrown back. Bounces that
    become ever smaller, or that are a thousand without a rest, are taken as at an end, and
    `stuck_at_deg` says where; jumps of less than 1e-11 of the travel are none. Angles are exact to
    1e-9 of a turn, and every flight is checked. Raises InputError for an indexing motion, for one
    whose velocity jumps, for a follower that does not rest on its cam when the machine stands, for
    one that is pressed so weakly that it flies for 20 000 turns, and for numbers out of range.

    >>> import cammotion as cm
    >>> load = FollowerLoad(mass_kg=12, stiffness_N_per_mm=0.2, preload_N=10)
    >>> found = follower_flights(cm.EXAMPLE.die, load, 2000)
    >>> print(f"{len(found)} flights, the first {found[0].leaves_at_deg:.2f} to "
    ...       f"{found[0].lands_at_deg:.2f} deg, {found[0].gap_mm:.2f} mm wide")
    6 flights, the first 180.37 to 248.23 deg, 18.09 mm wide
    """
    _check(motion, load)
    rate = RATE.number(rate_per_hour)
    numbers = TURNS.number(turns), RESTITUTION.number(restitution)
    before = motion.start_deg // DEG_PER_TURN * DEG_PER_TURN
    near = motion.shifted(-before)  # floats far from 0 are too far apart to land between
    run = Run(Cam.of(near, rate), load, load.where_loose(near, rate), *numbers)
    run.go()
    flights, falls = zip(*run.flights, strict=True) if run.flights else ((), ())
    found = Flights(near, load, rate, *numbers, flights, tuple(run.stuck_at), falls)
    _check_answer(found)
    return replace(
        found,
        motion=motion,
        flights=tuple(Flight(start + before, end + before, *rest) for start, end, *rest in flights),
        stuck_at_deg=tuple(place + before for place in run.stuck_at),
    )


def _check(motion: Motion, load: FollowerLoad) -> None:
    if motion.is_indexing or motion.steps(1):
        fault = "moves on from stop to stop" if motion.is_indexing else "has a velocity that jumps"
        raise InputError(
            f"The motion {motion.name!r} {fault}: give one that comes back, with moves whose "
            "velocities meet."
        )
    resting = load.standing_N(0.0)
    if resting <= 0:
        raise InputError(
            f"At the lowest position spring and weight press the follower on its cam with "
            f"{resting:g} N, so that it does not rest there: give a preload above "
            f"{load.preload_N - resting:g} N."
        )


def _check_answer(found: Flights) -> None:
    """Raise WrongAnswerError unless gaps are open, landings closed, and what is between pressed."""
    low, high = found.motion.range_mm
    place, near = found.begins_at_deg, _MISSED * (high - low)
    ends = [*found.flights, Flight(place + found.turns * DEG_PER_TURN, 0, 0, 0)]
    size = found.load.mass_kg * found.motion.peak(2) * (found.rate_per_hour / 10) ** 2 / MM_PER_M
    size += float(found.load.standing_N(high - low))
    for number, flight in enumerate(ends):
        if flight.leaves_at_deg > place + _SAME_DEG:
            between = np.linspace(place, flight.leaves_at_deg, _PROBES)[1:-1]
            force = found.load.force_N(found.motion, between, found.rate_per_hour)
            if np.min(force) < -_LACK * size:
                at = between[np.argmin(force)]
                raise WrongAnswerError("follower_flights", f"{min(force):g} N at {at:g} deg")
        place = flight.lands_at_deg
        if number < len(found.falls):
            since, fall = flight.leaves_at_deg, found.falls[number]
            gaps = found._cam.gap(fall, since, np.linspace(since, place, _PROBES))
            if min(gaps) < -near or abs(gaps[-1]) > near:
                raise WrongAnswerError(
                    "follower_flights", f"gaps {min(gaps):g} and {gaps[-1]:g} mm near {place:g} deg"
                )


def _times(count: int) -> str:
    return {1: "once", 2: "twice"}.get(count, f"{count} times")
