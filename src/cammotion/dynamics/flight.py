"""A mass that has left its cam: how it moves, and where it meets the cam again.

Free of the cam the mass swings about the place where spring and weight are in balance, or falls in
a parabola where there is no spring. With a the acceleration at its start and w its natural angular
frequency, both are one formula,

    y = y0 + v0 t sin(wt)/(wt) - a t^2/2 (sin(wt/2)/(wt/2))^2.

No landing is stepped over. In a smooth piece of the motion the gap cannot be pulled together faster
than the mass can fall and the cam can rise at most; from a gap and its rate of change follows how
long it certainly stays open. So long a step is made, and another from there, until a step is less
than rounding. Near a landing each of them has twice as many right digits as the one before. While
the mass is higher than the cam ever gets, the turns beneath it are stepped over.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from cammotion.bracketed import searched
from cammotion.dynamics.loads import FollowerLoad
from cammotion.laws.piece import Piece
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M, cycle_time
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Numbers, WrongAnswerError

_CLOSE_DEG = 1e-10  # a step that is no longer has arrived
_MOST_STEPS = 100_000
_FINE_DEG = 0.25  # between places of a flight that are looked at for the widest gap
_FEWEST = 65
_MOST_TURNS = 20_000  # of a flight; after more of them a float is no longer exact enough
_OVER = 1e-6  # of the travel: surely higher than the cam ever gets


class Fall:
    """The free flight of a mass from a height in mm and a velocity in mm/s, upwards."""

    def __init__(self, load: FollowerLoad, lift_mm: float, velocity: float) -> None:
        self._start, self._velocity = lift_mm, velocity
        self._pull = load.standing_N(lift_mm) * MM_PER_M / load.mass_kg
        self.swing = math.sqrt(load.stiffness_N_per_mm * MM_PER_M / load.mass_kg)
        self.hardest = math.hypot(self._pull, velocity * self.swing)

    @property
    def top_s(self) -> float:
        """When it is at its highest; 0 if it only falls."""
        rise = max(self._velocity, 0.0)
        if not self.swing:
            return float(rise / self._pull)
        return math.atan2(rise * self.swing, self._pull) / self.swing

    def down_s(self, height_mm: float) -> float:
        """Return when it is down at a height again; 0 if it does not get over it.

        About its top it swings too, by hardest/w^2.
        """
        over = float(self(self.top_s)) - height_mm
        if over <= 0:
            return 0.0
        root = math.sqrt(over / (2 * self.hardest))
        if not self.swing:
            return self.top_s + 2 * root
        return self.top_s + 2 * math.asin(min(self.swing * root, 1.0)) / self.swing

    def __call__(self, time_s: Numbers, order: int = 0) -> Numbers:
        """Return the height in mm, or the velocity (order 1) in mm/s, a time after the start."""
        whole, half = (np.sinc(share * self.swing * time_s / math.pi) for share in (1.0, 0.5))
        if order:
            turned = np.cos(self.swing * time_s)
            return self._velocity * turned - self._pull * time_s * whole
        return self._start + self._velocity * time_s * whole - self._pull * (time_s * half) ** 2 / 2


class _Part(NamedTuple):
    """A smooth piece of the motion, where it ends, and how hard the cam can push up in it."""

    low: float
    high: float
    piece: Piece
    hardest: float


@dataclass(frozen=True)
class Cam:
    """What the mass leaves and meets: heights in mm over the lowest position, at a machine rate.

    Places are cam angles in deg that are counted on from turn to turn.
    """

    motion: Motion
    per_s: float
    """How many deg the camshaft turns in a second."""
    parts: tuple[_Part, ...]

    @classmethod
    def of(cls, motion: Motion, rate_per_hour: float) -> "Cam":
        """Return the cam of a motion."""
        per_s = DEG_PER_TURN / float(cycle_time(rate_per_hour))
        parts = tuple(
            _Part(p.low, p.high, p, max(p.derivative.derivative.extremes[1], 0.0) * per_s**2)
            for p in motion.curve.pieces
        )
        return cls(motion, per_s, parts)

    def lift(self, places: Floats) -> Floats:
        """Return the heights at many places."""
        return np.asarray(self.motion.position_mm(places)) - self.motion.range_mm[0]

    def state(self, place: float) -> tuple[float, float]:
        """Return height and velocity in mm/s at a place."""
        part, back = next(self._from(place))
        return self._at(part, place - back)

    def landing(self, fall: Fall, since: float, free: float) -> float:
        """Return where a flight that began at a place ends; for `free` deg it certainly lasts."""
        place, steps = since + free, 0
        over, down = self._over(fall, since)
        for part, back in self._from(place):
            end, most = part.high + back, fall.hardest + part.hardest
            while place < end:
                height, velocity = self._at(part, place - back)
                time = (place - since) / self.per_s
                if fall(time) > over and down > place + DEG_PER_TURN:
                    return self.landing(fall, since, down - since)
                gap, opens = fall(time) - height, fall(time, 1) - velocity
                step = _certainly_open(gap, opens, most) * self.per_s
                if step < max(_CLOSE_DEG, math.ulp(place)):
                    return float(place)
                place, steps = place + step, steps + 1
                if steps > _MOST_STEPS:
                    raise WrongAnswerError("follower_flights", f"no landing after {place:g} deg")
            place = end
        raise AssertionError  # turns have no end

    def widest(self, fall: Fall, since: float, end: float) -> float:
        """Return the largest gap in mm of a flight, which is within a turn of where it is highest.

        For the cam is at its lowest once in that turn. A cam may hit it before its top.
        """
        top = since + fall.top_s * self.per_s
        first = max(since, min(top, end) - DEG_PER_TURN)
        last = min(end, top + DEG_PER_TURN)
        length = last - first
        places = np.linspace(first, last, max(_FEWEST, math.ceil(length / _FINE_DEG) + 1))
        gaps = self.gap(fall, since, places)
        best = int(np.argmax(gaps))
        beside = places[max(best - 1, 0)], places[min(best + 1, len(places) - 1)]
        found = searched(lambda at: self.gap(fall, since, at), *beside)
        return max(found.value, float(gaps[best]))

    def gap(self, fall: Fall, since: float, places: Floats) -> Floats:
        """Return the gaps in mm at places of a flight."""
        return np.asarray(fall((places - since) / self.per_s) - self.lift(places))

    def _over(self, fall: Fall, since: float) -> tuple[float, float]:
        """Return a height over all of the cam, and where a flight is down at it again."""
        low, high = self.motion.range_mm
        over = (high - low) * (1 + _OVER)
        turns = fall.down_s(over) * self.per_s / DEG_PER_TURN
        if turns > _MOST_TURNS:
            raise InputError(
                f"At {10 * self.per_s:g} pieces/h the follower leaves its cam at {since:.5g} deg "
                f"and flies for {turns:.3g} turns, so weakly is it pressed; up to {_MOST_TURNS} "
                "are followed: give it a stronger spring, or a lower rate."
            )
        return over, since + turns * DEG_PER_TURN

    def _from(self, place: float) -> Iterator[tuple[_Part, float]]:
        """Yield the parts from a place on, and by how much their angles are behind."""
        first = self.motion.start_deg
        turn = math.floor((place - first) / DEG_PER_TURN)
        while True:
            back = turn * DEG_PER_TURN
            yield from ((part, back) for part in self.parts if part.high + back > place)
            turn += 1

    def _at(self, part: _Part, angle: float) -> tuple[float, float]:
        inside = min(max(angle, part.low), part.high)
        height = part.piece.at(inside) - self.motion.range_mm[0]
        return height, part.piece.derivative.at(inside) * self.per_s


def _certainly_open(gap: float, opens: float, most: float) -> float:
    """Return how long in s a gap cannot close that is pulled together at most so hard."""
    if gap <= 0 >= opens:
        return 0.0
    root = math.sqrt(opens**2 + 2 * most * max(gap, 0.0))
    return (opens + root) / most if opens > 0 else 2 * gap / (root - opens)
