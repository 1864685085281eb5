"""What a follower of masses and springs does behind a cam: over one move, from rest, in a run.

Three questions are kept apart. `MoveResponse` is a single move, from rest, and what swings after
it. `StartResponse` is a machine that is switched on: turn after turn from rest. `SteadyResponse`
is the machine that has run for long, where each turn is as the one before.
"""

import math
from abc import ABC, abstractmethod
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cammotion.alike import Alike
from cammotion.arguments import checked
from cammotion.dynamics.chain import Chain
from cammotion.dynamics.course import Course, Spots
from cammotion.dynamics.forcing import Forcing, accelerations, check_velocity
from cammotion.dynamics.peaks import Peak, extremes, ordered
from cammotion.dynamics.swing import is_endless
from cammotion.laws.catalogue import as_law
from cammotion.machine.kinematics import (
    DEG_PER_TURN,
    MM_PER_M,
    RATE,
    Move,
    cycle_time,
    into_turn,
)
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE
from cammotion.quantities import Floats, InputError, Numbers, Quantity, plain, shorten

_TIME = Quantity("time", "s", example=0.1, low=-1e9, high=1e9)
_MOST_TURNS = 100_000
_ROUNDING = 1e-9  # by so much deg a place may be before the start


class Response(Alike, ABC):
    """What a follower does behind a cam; `MoveResponse` and its neighbours are of this kind.

    All of it is asked `at` places: times in s since the beginning of a move, cam angles in deg for
    a machine; numbers or arrays of any shape, and the result has their shape. `mass` is the number
    of a mass, 1 for the one next to the cam; the last one unless given.
    """

    chain: Chain
    _course: Course
    span: tuple[float, float]
    """From where to where it is looked at unless said: the move in s, the (first) turn in deg."""
    _unit_s: float  # of the places

    def __repr__(self) -> str:
        count = len(self.chain.masses_kg)
        of = ", ".join(repr(getattr(self, name)) for name in self.made_of[1:])
        return f"{type(self).__name__}({count} mass{'es' * (count > 1)}, {of})"

    def deflection_mm(self, at: ArrayLike, mass: int | None = None) -> Numbers:
        """Return how far a mass is from where the cam would have it, in mm."""
        return plain(self._asked(self._of_mass(0, mass), at))

    def position_mm(self, at: ArrayLike, mass: int | None = None) -> Numbers:
        """Return the position of a mass in mm."""
        return plain(self._cam(0, at) + self._asked(self._of_mass(0, mass), at))

    def velocity(self, at: ArrayLike, mass: int | None = None) -> Numbers:
        """Return the velocity of a mass in m/s."""
        return plain(self._cam(1, at) + self._asked(self._of_mass(1, mass), at))

    def acceleration(self, at: ArrayLike, mass: int | None = None) -> Numbers:
        """Return the acceleration of a mass in m/s2, which goes on where that of the cam jumps."""
        return plain(self._asked(self._of_mass(2, mass), at))

    def cam_acceleration(self, at: ArrayLike) -> Numbers:
        """Return the acceleration of the cam in m/s2; where it jumps, what comes after."""
        return plain(self._cam(2, at))

    def force_N(self, at: ArrayLike, spring: int = 1) -> Numbers:  # noqa: N802
        """Return the force in N of a spring with its damper; 1 is the one on the cam.

        It is what accelerates all masses beyond, above 0 where it pushes them up.
        """
        return plain(self._asked(self._of_spring(spring), at))

    def peak_deflection_mm(
        self, mass: int | None = None, *, over: tuple[float, float] | None = None
    ) -> Peak:
        """Return the largest magnitude of `deflection_mm` between two places, and where it is.

        `over` is the `span` unless given.
        """
        return self._peak(self._of_mass(0, mass), over)

    def peak_acceleration(
        self, mass: int | None = None, *, over: tuple[float, float] | None = None
    ) -> Peak:
        """Return the largest magnitude of a mass's acceleration between two places, and where.

        It is in m/s2. `over` is the `span` unless given.
        """
        return self._peak(self._of_mass(2, mass), over)

    def force_range_N(  # noqa: N802
        self, spring: int = 1, *, over: tuple[float, float] | None = None
    ) -> tuple[Peak, Peak]:
        """Return the least and the largest force of a spring in N, and where they are."""
        return self._extremes(self._of_spring(spring), over)

    @abstractmethod
    def _located(self, at: ArrayLike) -> tuple[Floats, Spots]:
        """Return the states where the pieces of places begin, in columns, and the places."""

    @abstractmethod
    def _cam(self, derivative: int, at: ArrayLike) -> Any:
        """Return the position of the cam in mm, its velocity in m/s or acceleration in m/s2."""

    @abstractmethod
    def _runs(self, over: tuple[float, float] | None) -> list[tuple[float, Floats, Spots]]:
        """Return samples between two places.

        With each run of them is what a place in its piece is counted from, and the state there.
        """

    def _of_mass(self, derivative: int, mass: int | None) -> Floats:
        count = len(self.chain.masses_kg)
        number = self._number(count if mass is None else mass, "mass")
        to_m = MM_PER_M if derivative else 1.0
        row = self._course.system.rows(derivative)[number - 1]
        return np.asarray(row / (to_m * self._unit_s**derivative))

    def _of_spring(self, spring: int) -> Floats:
        first = self._number(spring, "spring")
        beyond = range(first, len(self.chain.masses_kg) + 1)
        rows = [self.chain.masses_kg[n - 1] * self._of_mass(2, n) for n in beyond]
        return np.asarray(np.sum(rows, axis=0))

    def _number(self, number: Any, what: str) -> int:
        count = len(self.chain.masses_kg)
        if isinstance(number, bool | np.ndarray) or number not in range(1, count + 1):
            raise InputError(
                f"The number of the {what} is {shorten(number)}; the follower has {count}: give a "
                f"whole number from 1, at the cam, to {count}."
            )
        return int(number)

    def _asked(self, row: Floats, at: ArrayLike) -> Floats:
        begins, spots = self._located(at)
        return np.asarray(self._course.seen(row, begins, spots)[0].reshape(np.shape(at)))

    def _peak(self, row: Floats, over: tuple[float, float] | None) -> Peak:
        least, most = self._extremes(row, over)
        best = max(most, Peak(-least.value, least.at), key=lambda each: each.value)
        return Peak(abs(best.value), best.at)

    def _extremes(self, row: Floats, over: tuple[float, float] | None) -> tuple[Peak, Peak]:
        runs = self._runs(over)
        pieces = np.array([spots.pieces[0] for _, _, spots in runs])
        begins = np.array([begin for _, begin, _ in runs])

        def quantity(which: Any, within: Floats) -> Floats:
            spots = Spots(pieces[which], within)
            return self._course.seen(row, begins[which].T, spots, rates=2)

        found = extremes(quantity, [spots.within for _, _, spots in runs])
        least, most = (Peak(peak.value, float(runs[run][0] + peak.at)) for peak, run in found)
        return least, most


@checked
class MoveResponse(Response):
    """A follower that a `move` drives once, from rest, and then leaves alone; `at` is in s.

    Before the move it rests. Raises InputError for a law whose velocity jumps.

    >>> die = Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    >>> from cammotion.dynamics.chain import tuned_mass
    >>> soft = MoveResponse(tuned_mass(12, 0.02), die)
    >>> peak = soft.peak_acceleration()
    >>> print(f"{peak.value:.3f} m/s2 after {peak.at:.3f} s, the cam {die.peak_acceleration:.3f}")
    5.798 m/s2 after 0.064 s, the cam 4.154
    """

    made_of = ("chain", "move")

    def __init__(self, chain: Chain, move: Move) -> None:
        law = as_law(move.law)
        check_velocity(law)
        self.chain, self.move, self._unit_s = chain, move, 1.0
        self.span = 0.0, move.time_s
        curve = law.curve.placed(0.0, move.time_s, 0.0, move.stroke_mm)
        alone = Forcing(move.time_s, math.inf)
        self._course = Course(chain.system, [*accelerations(curve), alone])

    @cached_property
    def _begins(self) -> Floats:
        return self._course.begins(np.zeros(2 * len(self.chain.masses_kg)))

    def _located(self, at: ArrayLike) -> tuple[Floats, Spots]:
        spots = self._course.spots(np.maximum(_TIME.array(at).ravel(), 0.0))
        return self._begins[spots.pieces].T, spots

    def _cam(self, derivative: int, at: ArrayLike) -> Any:
        times = _TIME.array(at)
        inside = np.clip(times, 0.0, self.move.time_s)
        if derivative == 0:
            return self.move.displacement_mm(inside)
        moved = self.move.velocity if derivative == 1 else self.move.acceleration
        return np.where((times >= 0) & (times < self.move.time_s), moved(inside), 0.0)

    def _runs(self, over: tuple[float, float] | None) -> list[tuple[float, Floats, Spots]]:
        low, high = ordered(_TIME, self.span if over is None else over)
        if high <= 0:  # it rests
            return [(low, self._begins[0], Spots(np.zeros(1, dtype=np.intp), np.zeros(1)))]
        return [
            (self._course.lows[number], self._begins[number], spots)
            for spots in self._course.samples([(max(low, 0.0), high)])[0]
            for number in spots.pieces[:1]
        ]


class _TurnResponse(Response):
    """A follower that a motion drives turn after turn; `at` is a cam angle in deg."""

    made_of = ("chain", "motion", "rate_per_hour")

    @checked
    def __init__(self, chain: Chain, motion: Motion, rate_per_hour: float) -> None:
        check_velocity(motion)
        self.chain, self.motion = chain, motion
        self.span = motion.start_deg, motion.start_deg + DEG_PER_TURN
        self.rate_per_hour = RATE.number(rate_per_hour)
        self._unit_s = float(cycle_time(self.rate_per_hour)) / DEG_PER_TURN
        self._course = Course(chain.system.by(self._unit_s), accelerations(motion.curve))

    @abstractmethod
    def _start(self, turn: int) -> Floats:
        """Return the state at the beginning of a turn, the first of which is 0."""

    def _located(self, at: ArrayLike) -> tuple[Floats, Spots]:
        turns, phases = self._phase(CAM_ANGLE.array(at).ravel())
        spots = self._course.spots(phases)
        numbers, which = np.unique(turns, return_inverse=True)
        begins = np.array([self._course.begins(self._start(int(number))) for number in numbers])
        return begins[which, spots.pieces].T, spots

    def _cam(self, derivative: int, at: ArrayLike) -> Any:
        if derivative == 0:
            return self.motion.position_mm(at)
        return self.motion.derivative(derivative, at, self.rate_per_hour)

    def _between(self, over: tuple[float, float] | None) -> tuple[float, float]:
        return ordered(CAM_ANGLE, self.span if over is None else over, turn=DEG_PER_TURN)

    @abstractmethod
    def _phase(self, angles: Floats) -> tuple[Any, Floats]:
        """Return the number of the turn and the angle in the first one of it."""

    def _runs(self, over: tuple[float, float] | None) -> list[tuple[float, Floats, Spots]]:
        low, high = self._between(over)
        self._phase(np.array([low, high]))  # refuses what is none of its places
        ends = (int((angle - self.motion.start_deg) // DEG_PER_TURN) for angle in (low, high))
        first, last = ends
        turns = [(turn, turn * DEG_PER_TURN) for turn in range(first, last + 1)]
        samples = self._course.samples([(low - before, high - before) for _, before in turns])
        found = []
        for (turn, before), parts in zip(turns, samples, strict=True):
            begins = self._course.begins(self._start(turn))
            for spots in parts:
                number = spots.pieces[0]
                found.append((before + self._course.lows[number], begins[number], spots))
        return found


class StartResponse(_TurnResponse):
    """A follower at rest that a machine begins to drive, turn after turn; `at` is in deg.

    At the angle `motion.start_deg` of the first turn the masses are where the cam has them, and as
    fast as it. An angle before that is refused; the next turns are 360 deg further each.
    """

    def _start(self, turn: int) -> Floats:
        matrix, row = self._course.passage
        turned = np.block([[matrix, np.zeros((len(row), 1))], [row, np.ones(1)]])
        return np.asarray(np.linalg.matrix_power(turned, turn)[-1, :-1])

    def _between(self, over: tuple[float, float] | None) -> tuple[float, float]:
        places = CAM_ANGLE.array(self.span if over is None else over)
        if places.shape == (2,):
            self._phase(places[:1])  # what begins too early does so over the end of a turn, too
        return super()._between(over)

    def _runs(self, over: tuple[float, float] | None) -> list[tuple[float, Floats, Spots]]:
        low, high = self._between(over)
        begin = self.motion.start_deg
        return super()._runs((begin if abs(low - begin) <= _ROUNDING else low, high))

    def _phase(self, angles: Floats) -> tuple[Any, Floats]:
        begin = self.motion.start_deg
        high = begin + _MOST_TURNS * DEG_PER_TURN
        outside = (angles < begin - _ROUNDING) | (angles > high)
        if outside.any():
            raise InputError(
                f"The cam angle is {angles[outside][0]:g} deg; the machine starts at {begin:g}: "
                f"give an angle from there on, and up to {high:g} deg."
            )
        turns, phases = into_turn(np.maximum(angles, begin), begin)
        return turns.astype(np.intp), phases


class SteadyResponse(_TurnResponse):
    """A follower in a machine that has run for long: each turn is as the one before.

    `at` is any cam angle in deg. Raises InputError where nothing damps the follower and it swings
    a whole number of times in a turn: then no turn settles how it swings, and it may swing more
    with each; and where it is damped so strongly that a turn brings it back by less than 1e-8 of
    its deflection.
    """

    @checked
    def __init__(self, chain: Chain, motion: Motion, rate_per_hour: float) -> None:
        super().__init__(chain, motion, rate_per_hour)
        matrix, row = self._course.passage
        taken = np.eye(len(row)) - matrix
        if is_endless(taken):
            raise InputError(f"At {self.rate_per_hour:g} pieces/h the follower {self._endless()}")
        self._repeated = np.linalg.solve(taken.T, row)

    def _endless(self) -> str:
        """Return in words why no turn is as the one before, and what to give."""
        turn_s, roots = float(cycle_time(self.rate_per_hour)), self.chain.roots_per_s
        root = roots[np.argmin(np.abs(np.expm1(roots * turn_s)))]  # of what is left after a turn
        if not root.imag:
            return (
                "is damped so strongly that it creeps back by less than a hundred millionth of its "
                "deflection in a turn: give it less damping, or stiffer springs."
            )
        swings = abs(root.imag) / (2 * np.pi) * turn_s
        what = "hardly anything" if any(self.chain.dampings_N_s_per_mm) else "nothing"
        return (
            f"swings {swings:.9g} times in a turn and {what} damps it, so that no turn settles how "
            "it swings, and it may swing more with each: give it some damping, or another rate."
        )

    def _start(self, turn: int) -> Floats:  # noqa: ARG002 - all turns are alike
        return np.asarray(self._repeated)

    def _phase(self, angles: Floats) -> tuple[Any, Floats]:
        _, phases = into_turn(angles, self.motion.start_deg)
        return np.zeros(phases.shape, dtype=np.intp), phases

    def _runs(self, over: tuple[float, float] | None) -> list[tuple[float, Floats, Spots]]:
        low, high = self._between(over)
        return super()._runs((low, min(high, low + DEG_PER_TURN)))
