"""A motion law from ramps over which the acceleration is a straight line.

Neighbours with one line in common are made one zone of the law, so that of hundreds of ramps a
few zones remain.
"""

from typing import NamedTuple

import numpy as np

from cammotion.laws.curve import Curve
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.series import Series
from cammotion.quantities import Floats

_SAME = 1e-8  # accelerations that differ by so much of the largest are one


class Ramp(NamedTuple):
    """A time over which the acceleration is a straight line."""

    seconds: float
    starting: float
    ending: float

    @property
    def slope(self) -> float:
        """The jerk."""
        return (self.ending - self.starting) / self.seconds

    @property
    def gained(self) -> float:
        """The velocity gained."""
        return self.seconds * (self.starting + self.ending) / 2

    @property
    def moved(self) -> float:
        """The way made, from rest."""
        return self.seconds**2 * (self.starting / 3 + self.ending / 6)

    def before(self, time: float) -> "Ramp":
        """Return what comes before a time within it."""
        return Ramp(time, self.starting, self.starting + self.slope * time)

    def after(self, time: float) -> "Ramp":
        """Return what comes after a time within it."""
        return Ramp(self.seconds - time, self.starting + self.slope * time, self.ending)


def law_of(ramps: list[Ramp], change_mm: float) -> MotionLaw:
    """Return the law of a move by `change_mm` from rest to rest."""
    ramps = _closed(_merged(ramps), change_mm)
    total = sum(ramp.seconds for ramp in ramps)
    series, place, s, v = [], 0.0, 0.0, 0.0
    for number, ramp in enumerate(ramps, 1):
        seconds = ramp.seconds / total
        scaled = Ramp(
            seconds,
            ramp.starting * total**2 / change_mm,
            ramp.ending * total**2 / change_mm,
        )
        end = 1.0 if number == len(ramps) else place + seconds
        series.append(Series((s, v, scaled.starting / 2, scaled.slope / 6), (), place, end))
        place, s, v = end, s + v * seconds + scaled.moved, v + scaled.gained
    return MotionLaw("least acceleration", Curve(series))


def _merged(ramps: list[Ramp]) -> list[Ramp]:
    """Return the ramps with those made one whose accelerations are one line."""
    rounding = _SAME * max(abs(end) for ramp in ramps for end in ramp[1:])
    found: list[Ramp] = []
    for ramp in ramps:
        if ramp.seconds <= 0:
            continue
        if found and _is_one_line(found[-1], ramp, rounding):
            before = found.pop()
            ramp = Ramp(before.seconds + ramp.seconds, before.starting, ramp.ending)
        found.append(ramp)
    return found


def _is_one_line(one: Ramp, other: Ramp, rounding: float) -> bool:
    bend = (one.slope - other.slope) * min(one.seconds, other.seconds)
    return abs(one.ending - other.starting) <= rounding and abs(bend) <= rounding


def _closed(ramps: list[Ramp], change_mm: float) -> list[Ramp]:
    """Return the ramps without the rounding of what found them: ending at rest, in its place.

    The accelerations are changed as little as this takes. What is constant stays so, what is
    continuous too, and where a move begins or ends without acceleration it does so still.
    """
    ends = np.array([ramp[1:] for ramp in ramps])
    share = _free_ends(ends)
    seconds = [ramp.seconds for ramp in ramps]
    effect = np.array([_outcome(seconds, column.reshape(-1, 2)) for column in share.T]).T
    for _ in range(2):
        missing = np.array([0.0, change_mm]) - _outcome(seconds, ends)
        scale = np.abs(effect).max(axis=1)
        change = np.linalg.lstsq(effect / scale[:, None], missing / scale, rcond=None)[0]
        ends = ends + (share @ change).reshape(-1, 2)
    return [Ramp(time, *map(float, both)) for time, both in zip(seconds, ends, strict=True)]


def _free_ends(ends: Floats) -> Floats:
    """Return which ends of the ramps change together: a column for each that is free."""
    count = len(ends)
    rounding = _SAME * np.abs(ends).max()
    if np.all(np.abs(ends[:, 0] - ends[:, 1]) <= rounding):
        return np.repeat(np.eye(count), 2, axis=0)
    corners = np.zeros((2 * count, count + 1))
    for ramp in range(count):
        corners[2 * ramp, ramp] = corners[2 * ramp + 1, ramp + 1] = 1.0
    values = np.append(ends[:, 0], ends[-1, 1])
    inner = (np.arange(count + 1) % count > 0) | (np.abs(values) > rounding)
    return corners[:, inner]


def _outcome(seconds: list[float], ends: Floats) -> Floats:
    """Return the velocity and the place, from rest, at the end of ramps."""
    place = velocity = 0.0
    for time, both in zip(seconds, ends, strict=True):
        ramp = Ramp(time, *both)
        place += velocity * time + ramp.moved
        velocity += ramp.gained
    return np.array([velocity, place])
