"""A follower through some turns: on its cam, in the air, and back, one flight after the other."""

import math
from typing import NamedTuple

from cammotion.dynamics.flight import Cam, Fall
from cammotion.dynamics.loads import FollowerLoad
from cammotion.machine.arcs import Arc, unwrap
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M

_LEAST = 1e-11  # of the travel: a jump that is no higher is none, and a bounce the last
_BOUNCES = 1000  # without rest, after which a follower is taken as still


class Flight(NamedTuple):
    """A flight of a follower: where it leaves the cam and lands, how wide, and how hard.

    Cam angles are in deg and counted on from turn to turn; `gap_mm` is the widest gap, and
    `impact_m_per_s` the velocity in m/s with which cam and follower meet.
    """

    leaves_at_deg: float
    lands_at_deg: float
    gap_mm: float
    impact_m_per_s: float


class Run:
    """The follower on its way; `place` is a cam angle in deg, counted on from turn to turn."""

    def __init__(
        self, cam: Cam, load: FollowerLoad, loose: list[Arc], turns: float, restitution: float
    ) -> None:
        self._cam, self._load, self._restitution = cam, load, restitution
        self._loose = unwrap(loose)
        low, high = cam.motion.range_mm
        self._travel = high - low
        self._end = cam.motion.start_deg + turns * DEG_PER_TURN
        self.flights: list[tuple[Flight, Fall]] = []
        self.stuck_at: list[float] = []

    def go(self) -> None:
        """Go through the turns, from flight to flight."""
        place, thrown, bounces = self._cam.motion.start_deg, 0.0, 0
        while place < self._end:
            if not thrown:
                start, end = self._next_loose(place)
                if start >= self._end:
                    return
                place, bounces = self._fly(start, end - start, 0.0), 0
            else:
                place, bounces = self._fly(place, 0.0, thrown), bounces + 1
            thrown = self._thrown(place, bounces)

    def _fly(self, since: float, free: float, thrown: float) -> float:
        """Fly from a place on, thrown up with a velocity in mm/s; return where contact goes on."""
        lift, velocity = self._cam.state(since)
        fall = Fall(self._load, lift, velocity + thrown)
        if fall.swing:  # for half a swing the mass stays over a cam that falls away beneath it
            free = min(free, math.pi / fall.swing * self._cam.per_s)
        end = self._cam.landing(fall, since, free)
        gap = self._cam.widest(fall, since, end)
        if gap <= _LEAST * self._travel and not thrown:
            return max(end, since + free)
        meets = self._cam.state(end)[1] - fall((end - since) / self._cam.per_s, 1)
        flight = Flight(since, end, gap, max(float(meets), 0.0) / MM_PER_M)
        self.flights.append((flight, fall))
        return end

    def _thrown(self, place: float, bounces: int) -> float:
        """Return with which velocity in mm/s the follower leaves the place of a landing."""
        flight = self.flights[-1][0] if self.flights else None
        if not self._restitution or flight is None or flight.lands_at_deg != place:
            return 0.0
        thrown = self._restitution * flight.impact_m_per_s * MM_PER_M
        motion, rate = self._cam.motion, self._cam.per_s * 10
        pressed = abs(float(self._load.force_N(motion, place, rate))) * MM_PER_M
        is_small = thrown**2 * self._load.mass_kg <= 2 * pressed * _LEAST * self._travel
        if is_small or bounces >= _BOUNCES:
            self.stuck_at.append(place)
            return 0.0
        return thrown

    def _next_loose(self, place: float) -> Arc:
        """Return the next arc over which the follower is loose, or what is left of this one."""
        ends = []
        for start, end in self._loose:
            turn = math.ceil((place - end) / DEG_PER_TURN) * DEG_PER_TURN
            if end + turn <= place + 1e-9:
                turn += DEG_PER_TURN
            ends.append((max(start + turn, place), end + turn))
        return min(ends, default=(math.inf, math.inf))
