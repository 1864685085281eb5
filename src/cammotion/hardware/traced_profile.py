"""Points round a cam as a curve, and what it says of a follower that goes over it.

A normal that is off by a small angle moves a point along the very curve that is sought: only its
square does harm. So normals may be taken over more points where noise asks for it.
"""

import math
from collections.abc import Iterator
from functools import cached_property
from typing import Any, NoReturn

import numpy as np

from cammotion.hardware.followers import Places, RollerFollower, SwingingRoller, TranslatingRoller
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats, InputError

_WINDOWS = (1, 2, 3, 5, 8, 13, 21, 34)  # points on either side, over which normals are taken
_DENSE, _PLACES = 16, 8000  # of the answer's own check: places between two points, and in all
_KINK, _KINKED = 0.05, 4.0  # rad at one point, beside so many times what its neighbours turn
_SHAKEN = 1.5 * math.sqrt(6)  # of the noise over the step, which turns the line at any point
_STRAY, _STRAYED = 0.025, 4.0  # of the step, beside so many times what neighbours are off
_SCATTERED = 5.0  # times what noise makes of it, which of thousands of points hardly one is off
_SWAYED = 3 * math.sqrt(2) * 4 / 27  # three scatters of a slope, and what it makes of a cubic
_EVEN = 1 + 34 / 36  # the sum of squares of 1 and the weights of four even neighbours
_ROUNDING = 1e-8  # of the size
_RESIDUAL = math.sqrt(18 / 35)  # of the noise is off a parabola through five points
_MEDIAN = 0.6745  # of a normal scatter is the median of its magnitude


class Traced:
    """Points round a cam, in order against the clock, and the follower that is to go over them.

    `away_mm` is how far outside them the pitch curve lies, or the profile for a flat face; `way` is
    -1 for a cam that turns the other way.
    """

    def __init__(
        self, points: Places, away_mm: float, follower: RollerFollower | str, way: int = 1
    ) -> None:
        self._way = way
        self.points, self.away_mm, self.follower = points, away_mm, follower
        ends = np.append(points, points[0])
        self.along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(ends)))])
        self.size_mm = float(np.abs(points).mean())

    @cached_property
    def curve(self) -> Any:
        """The closed curve through the points, over the length of the chords."""
        from scipy.interpolate import CubicSpline

        return CubicSpline(self.along, np.append(self.points, self.points[0]), bc_type="periodic")

    @cached_property
    def noise_mm(self) -> float:
        """How far the points scatter, from how far each is off a parabola through five."""
        fitted = self._parabolas(2)
        off = (self.points - fitted[:, 0]) * np.conj(1j * fitted[:, 1]) / np.abs(fitted[:, 1])
        return float(np.median(np.abs(off.real))) / (_MEDIAN * _RESIDUAL)

    def answers(self, angles: Floats) -> Iterator[tuple[float, Floats]]:
        """Yield by how much answers are off, and the positions over the cam angles in rad."""
        from scipy.interpolate import CubicSpline

        for window in _WINDOWS:
            if 2 * window + 1 > len(self.points) / 8:
                return
            seen, lift = self._seen(window)
            if np.diff(seen).min() <= 0:
                continue
            around = np.append(lift, lift[0])
            spline = CubicSpline(seen, around, bc_type="periodic")
            position = spline(seen[0] + np.mod(angles - seen[0], 2 * math.pi))
            off = self._off(angles, position)
            yield off, position
            if off <= max(self.noise_mm, _ROUNDING * self.size_mm):
                return

    def prime_of(self, lowest: float) -> float:
        """Return the radius of the prime circle, or the base circle, of the lowest position."""
        if isinstance(self.follower, TranslatingRoller):
            return math.hypot(lowest, self.follower.offset_mm)
        if isinstance(self.follower, SwingingRoller):
            return float(np.abs(self._place(np.array(lowest))))
        return lowest

    def refuse_kinks(self) -> None:
        """Raise InputError where the probe has not followed a hollow down to its bottom."""
        ends = np.concatenate([self.points[-1:], self.points, self.points[:1]])
        steps = np.diff(ends)
        turned = np.angle(steps[1:] / steps[:-1])
        bend = np.abs(turned) / self._steps
        beside = np.mean([np.roll(bend, n) for n in (-5, -4, -3, 3, 4, 5)], axis=0)
        shaken = _SHAKEN * self.noise_mm / self._steps
        net = turned + np.roll(turned, 1) + np.roll(turned, -1)  # a stray's own turns cancel
        sharper = np.minimum(-turned, -net) - _KINKED * np.maximum(beside * self._steps, shaken)
        worst = int(np.argmax(sharper))
        if sharper[worst] > _KINK:
            raise InputError(
                f"The points have a kink inwards {self._where(worst)}: a hollow there is narrower "
                "than the probe, which has not touched its bottom, or has too few points. Measure "
                "it with a smaller probe, or at more points."
            )

    def refuse_strays(self) -> None:
        """Raise InputError for a point that lies off where its neighbours say it should."""
        off = self._off_neighbours()
        beside = np.max([np.roll(off, n) for n in (-6, -5, -4, -3, 3, 4, 5, 6)], axis=0)
        scatter = _SCATTERED * math.sqrt(_EVEN) * self.noise_mm
        further = (off - np.maximum(_STRAYED * beside, scatter)) / self._steps
        worst = int(np.argmax(further))
        if further[worst] > _STRAY:
            raise InputError(
                f"The point {self._where(worst)} lies about {off[worst]:.2g} mm off the line "
                "of its neighbours: leave it out, or measure it again."
            )

    def refuse_gaps(self, allowed_mm: float) -> None:
        """Raise InputError where noise of points close together sways the curve over a long step.

        What it turns the curve by, at the end of the long step, goes by the short one beside it.
        """
        steps = np.diff(self.along)
        times = steps / np.minimum(np.roll(steps, 1), np.roll(steps, -1))
        worst = int(np.argmax(times))
        swayed = _SWAYED * self.noise_mm * times[worst]
        if swayed > allowed_mm:
            raise InputError(
                f"The step from the point {self._where(worst)} is {times[worst]:.3g} times as long "
                f"as one beside it, and the points scatter by {self.noise_mm:.2g} mm: over it the "
                f"curve through them may be {swayed:.2g} mm off. Measure there, too, or leave "
                "points out where they lie close together."
            )

    def refuse_turning_back(self) -> NoReturn:
        """Raise InputError where the follower would have to go backwards."""
        seen, _ = self._seen(1)
        worst = int(np.diff(seen).argmin())
        what = "has a hollow or a flat" if self.follower == "flat face" else "has a hollow"
        raise InputError(
            f"The profile {what} {self._where(worst)} into which the follower does not reach, or "
            "its points are not in order there. Give them in order, or the follower that the cam "
            "was made for."
        )

    def refuse_cut(self, off: float) -> NoReturn:
        """Raise InputError for an answer that misses the points."""
        raise InputError(
            f"No lift fits these points: the follower would be {off:.3g} mm off them, and they "
            f"scatter by {self.noise_mm:.2g} mm. Look for stray points, give more of them, or the "
            "follower that the cam was made for: a hollow may be narrower than it."
        )

    def _where(self, number: int) -> str:
        """Return in words at which cam angle a point is above the axis."""
        angle = self._way * math.degrees(float(np.angle(self.points[number] / 1j))) % DEG_PER_TURN
        return f"at {angle:.4g} deg of cam angle"

    def _tangents(self, window: int) -> Places:
        """Return the direction of the curve at each point, from so many on either side."""
        found = self.curve(self.along[:-1], 1) if window == 1 else self._parabolas(window)[:, 1]
        return np.asarray(found / np.abs(found))

    @property
    def _steps(self) -> Floats:
        """How far each point is from its two neighbours, in the mean."""
        steps = np.diff(self.along)
        return (steps + np.roll(steps, 1)) / 2

    def _off_neighbours(self) -> Floats:
        """Return how far each point is off the cubic through two neighbours on either side.

        Of uneven points it is less by as much as noise of theirs would make it more.
        """
        apart = np.array([np.roll(self.points, n) - self.points for n in (2, 1, -1, -2)])
        seen = apart / self._tangents(2)
        off, noise = np.zeros(len(self.points)), np.ones(len(self.points))
        for number, way in enumerate(seen.real):
            others = np.delete(seen.real, number, axis=0)
            weight = np.prod(others / (others - way), axis=0)
            off += weight * seen.imag[number]
            noise += weight**2
        return np.asarray(np.abs(off) * np.sqrt(_EVEN / noise))

    def _parabolas(self, window: int) -> Places:
        """Return at each point the parabola that fits best about it: where it is, and whither."""
        count, length = len(self.points), self.along[-1]
        near = np.arange(count)[:, None] + np.arange(-window, window + 1)
        turns, near = np.divmod(near, count)
        way = self.along[near] + turns * length - self.along[:count, None]
        size = np.abs(way).max(axis=1)
        powers = (way / size[:, None])[..., None] ** np.arange(3)
        normal = np.einsum("nki,nkj->nij", powers, powers)
        right = np.einsum("nki,nk->ni", powers, self.points[near])
        return np.asarray(np.linalg.solve(normal.astype(complex), right[..., None])[..., 0])

    def _seen(self, window: int) -> tuple[Floats, Floats]:
        """Return the cam angles in rad at which the points count, a turn's last too, and lifts."""
        outwards = -1j * self._tangents(window)
        if self.follower == "flat face":
            lift = (self.points * outwards.conj()).real + self.away_mm
            angles = np.angle(outwards / 1j)
        else:
            pitch = self.points + self.away_mm * outwards
            lift = self._lift(np.abs(pitch))
            angles = np.angle(pitch / self._place(lift))
        ends = np.append(angles, angles[0])
        steps = np.mod(np.diff(ends) + math.pi, 2 * math.pi) - math.pi
        seen = angles[0] + np.concatenate([[0.0], np.cumsum(steps)])
        if abs(steps.sum() - 2 * math.pi) > 1:
            seen[-1] = -math.inf  # not once round: no answer
        return seen, lift

    def _lift(self, distance: Floats) -> Floats:
        """Return where the follower is along its way, from how far its roller is off the axis."""
        follower = self.follower
        with np.errstate(invalid="ignore"):
            if isinstance(follower, TranslatingRoller):
                found = np.sqrt(distance**2 - follower.offset_mm**2)
            else:
                arm, pivot = self._arm
                found = -arm * np.arccos((distance**2 - pivot**2 - arm**2) / (2 * pivot * arm))
        if np.isnan(found).any():
            raise InputError(
                f"The follower, {follower}, cannot be {distance[np.isnan(found)][0]:.5g} mm off "
                "the axis, as these points ask: give its own offset, arm and pivot."
            )
        return np.asarray(found)

    def _place(self, lift: Floats) -> Places:
        """Return where the roller's centre is in the machine."""
        if isinstance(self.follower, TranslatingRoller):
            return np.asarray(1j * lift - self.follower.offset_mm)
        arm, pivot = self._arm
        return np.asarray(pivot + arm * np.exp(-1j * lift / arm))

    @property
    def _arm(self) -> tuple[float, float]:
        """The arm of a swinging follower, and how far its pivot is from the axis, in mm."""
        if isinstance(self.follower, SwingingRoller):
            return self.follower.arm_mm, self.follower.pivot_mm
        raise TypeError(f"no arm in {self.follower}")

    def _off(self, angles: Floats, position: Floats) -> float:
        """Return by how much at most a follower at these positions misses the curve."""
        count = int(np.clip(_PLACES // len(self.points), 2, _DENSE))
        finer = np.linspace(0, 1, count, endpoint=False)
        dense = self.curve((self.along[:-1, None] + np.diff(self.along)[:, None] * finer).ravel())
        turned = np.exp(1j * angles)
        if self.follower == "flat face":
            hull = _hull(dense)
            reach = (hull[:, None] * (1j * turned).conj()).real.max(axis=0)
            return float(np.abs(reach + self.away_mm - position).max())
        from scipy.spatial import cKDTree

        centres = self._place(position) * turned
        tree = cKDTree(np.column_stack([dense.real, dense.imag]))
        _, nearest = tree.query(np.column_stack([centres.real, centres.imag]))
        apart = np.minimum(
            *(
                _distance(
                    centres,
                    dense[(nearest + n) % len(dense)],
                    dense[(nearest + n + 1) % len(dense)],
                )
                for n in (-1, 0)
            )
        )
        return float(np.abs(apart - abs(self.away_mm)).max())


def _hull(points: Places) -> Places:
    """Return the corners of the convex hull."""
    from scipy.spatial import ConvexHull

    return np.asarray(points[ConvexHull(np.column_stack([points.real, points.imag])).vertices])


def _distance(places: Places, start: Places, end: Places) -> Floats:
    """Return how far places are from chords."""
    chord = end - start
    share = np.clip(((places - start) * chord.conj()).real / np.abs(chord) ** 2, 0, 1)
    return np.asarray(np.abs(places - start - share * chord))
