"""A mass on a spring behind a curve, for many ratios of move and swing at once.

With w = 2 pi tm/Tn, the damping ratio D and the acceleration A of the cam over x = t/tm, the
deflection z obeys z'' + 2 D w z' + w^2 z = -A. The roots of that are r = w (-D + i sqrt(1 - D^2))
and its conjugate. With the complex number v = z' - conj(r) z that is one equation of first order,

    v' = r v - A,    z = Im v / Im r,    z' = Im(r v) / Im r,

which takes v over a way h to exp(r h) v less the integral of exp(r (h - u)) A(u). The integral is
taken by Gauss's rule with six places, over ways so short that all digits of it are right.
"""

from functools import cached_property
from typing import Any

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from cammotion.dynamics.forcing import accelerations
from cammotion.dynamics.peaks import narrowed
from cammotion.laws.curve import Curve
from cammotion.quantities import Floats

_PER_SWING = 12  # ways
_FEWEST = 32  # ways in a move
_GAUSS = leggauss(6)
_PLACES, _WEIGHTS = (_GAUSS[0] + 1) / 2, _GAUSS[1] / 2  # for a way from 0 to 1
_RESONANT = 1e-8  # of what swings that a turn takes away
Complexes = NDArray[np.complex128]


def ways_for(ratio: float) -> float:
    """Return how many ways a move has at least for all ratios up to this one."""
    return max(_FEWEST, _PER_SWING * ratio)


def is_endless(taken: NDArray[Any]) -> NDArray[np.bool_]:
    """Return whether a turn leaves something of what swings as it is, so that no turn repeats.

    `taken` is what a turn takes of the states, a square matrix or many of them: the states at the
    start less what the turn makes of them. What is left as it is but for 1e-8 counts.
    """
    return np.asarray(np.linalg.svd(taken, compute_uv=False)[..., -1] < _RESONANT)


class Swing:
    """What masses do behind a `curve`, by `ratios` tm/Tn above 0, with a `damping` ratio below 1.

    A move takes `width` of the curve's places, in which x goes from 0 to 1, and a stroke is
    `stroke` of its heights. Masses are counted by their ratios, places by `joints` between ways.
    """

    def __init__(
        self, curve: Curve, ratios: Floats, damping: float, width: float = 1.0, stroke: float = 1.0
    ) -> None:
        self._bend, self._scale, self._width = curve.derived(2), width**2 / stroke, width
        self._w, self._loss = 2 * np.pi * ratios, 4 * np.pi * ratios * damping
        self.roots = self._w * complex(-damping, np.sqrt(1 - damping**2))
        longest = width / ways_for(float(ratios.max()))
        self._pieces: list[tuple[int, int, float]] = []
        joints: list[float] = []
        for each in accelerations(curve):
            length = each.high - each.low
            swings = max((abs(rate) * length / (2 * np.pi) for _, rate, _ in each.waves), default=0)
            count = int(np.ceil(max(length / longest, _PER_SWING * swings)))
            self._pieces.append((len(joints), count, length / count))
            joints += np.linspace(each.low, each.high, count, endpoint=False).tolist()
        self.joints = np.array([*joints, curve.high])

    @cached_property
    def from_rest(self) -> Complexes:
        """The number v at each joint, a row, of each mass, a column, from rest at the first one."""
        v = np.zeros((len(self.joints), len(self.roots)), dtype=complex)
        for first, count, way in self._pieces:
            h = way / self._width
            places = self.joints[first : first + count, None] + way * _PLACES
            weights = np.exp(np.outer(h * (1 - _PLACES), self.roots)) * (h * _WEIGHTS)[:, None]
            turn = np.exp(h * self.roots)
            pushes = np.einsum("nk,km->nm", self._given(places), weights)
            for n, push in enumerate(pushes, first):
                v[n + 1] = turn * v[n] - push
        return v

    @cached_property
    def steady(self) -> Complexes:
        """The number v at each joint where the curve has been repeated without end.

        It is of no use for the masses that are `endless`.
        """
        since = (self.joints - self.joints[0])[:, None] / self._width
        with np.errstate(all="ignore"):
            start = self.from_rest[-1] / self._taken
            return np.asarray(self.from_rest + start * np.exp(self.roots * since))

    @property
    def endless(self) -> NDArray[np.bool_]:
        """Which masses nothing damps that swing a whole number of times over the curve."""
        return is_endless(self._taken[:, None, None])

    @property
    def _taken(self) -> Complexes:
        """How much of a mass's swing is gone after the whole curve."""
        return np.asarray(-np.expm1(self.roots * (self.joints[-1] - self.joints[0]) / self._width))

    def furthest(self, v: Complexes) -> Floats:
        """Return the largest deflection of masses that begin with v and are left alone."""
        turning = -np.angle(self.roots * v) / self.roots.imag  # where z' = 0
        turning += np.where(turning < 0, np.pi / self.roots.imag, 0.0)
        both = v.imag, (v * np.exp(self.roots * turning)).imag
        return np.asarray(np.max(np.abs(both), axis=0) / self.roots.imag)

    def largest(self, v: Complexes, first: int, last: int) -> Floats:
        """Return the largest acceleration of each mass from one joint to another, by its number."""
        ways = np.arange(first, last)
        sizes = np.abs(self._moved(v[first : last + 1])[1])
        best = sizes.max(axis=0)
        before, after = self._slopes(v, ways, "right"), self._slopes(v, ways + 1, "left")
        h = np.diff(self.joints[first : last + 1])[:, None] / self._width
        reach = np.maximum(np.abs(before), np.abs(after)) * h
        turns = (before * after < 0) & (np.maximum(sizes[1:], sizes[:-1]) + reach >= best)
        way, mass = np.nonzero(turns)
        if len(way):
            which = np.arange(len(way))
            starts, widths = self.joints[first + way], h[way, 0] * self._width

            def quantity(numbers: Any, within: Floats) -> Floats:
                begin = v[first + way[numbers], mass[numbers]]
                return self._inside(begin, mass[numbers], starts[numbers], within)

            places = narrowed(quantity, which, np.zeros(len(way)), widths)
            np.maximum.at(best, mass, np.abs(quantity(which, places)[0]))
        return np.asarray(best)

    def _given(self, places: Floats, joint_of: Any = "left") -> Floats:
        """Return the acceleration A of the cam."""
        return np.asarray(self._scale * self._bend(places, joint_of))

    def _moved(self, v: Complexes, mass: Any = slice(None)) -> tuple[Floats, Floats]:
        """Return the rate z' and the acceleration of the masses, A + z''."""
        roots = self.roots[mass]
        z, rate = v.imag / roots.imag, (roots * v).imag / roots.imag
        return rate, -self._loss[mass] * rate - self._w[mass] ** 2 * z

    def _slopes(self, v: Complexes, joints: Any, side: str) -> Floats:
        """Return how the masses' acceleration changes at joints, on one side of them."""
        rate, moved = self._moved(v[joints])
        given = self._given(self.joints[joints], side)[:, None]
        return -self._loss * (moved - given) - self._w**2 * rate

    def _inside(self, v: Complexes, mass: Any, starts: Floats, within: Floats) -> Floats:
        """Return the masses' acceleration, its slope and the slope of that within ways."""
        roots, h = self.roots[mass], within / self._width
        given = self._given(starts[:, None] + within[:, None] * _PLACES)
        weights = np.exp(roots[:, None] * h[:, None] * (1 - _PLACES)) * h[:, None] * _WEIGHTS
        v = np.exp(roots * h) * v - (given * weights).sum(axis=1)
        rate, moved = self._moved(v, mass)
        places, loss, square = starts + within, self._loss[mass], self._w[mass] ** 2
        second = moved - self._given(places)
        slope = -loss * second - square * rate
        jerk = self._scale * self._width * self._bend.derivative(places)
        bend = -loss * (slope - jerk) - square * second
        return np.array([moved, slope / self._width, bend / self._width**2])
