"""How a law lies to its points: through them, smoothed, repeated without rest, never swung over.

All but the monotone fit are linear: the accelerations at the points are sums of shares of the
points' positions. So what an error of each does is known without trying: at most the sum of the
shares' magnitudes, and for random ones the root of the sum of their squares. On even points far
from the ends, h apart, the spline through them has the bound 12 e/h^2 (errors of alternating sign)
and the root mean square 6 e/h^2, exactly.

A law goes from 0 to 1, and so its ends are exact. In a table of positions they are not: what the
first and the last one are off shifts and scales all the others, so that each end has shares of its
own.
"""

from typing import Protocol

import numpy as np

from cammotion.laws.curve import Curve
from cammotion.laws.spline import Spline
from cammotion.measured.smoother import AnyPoints
from cammotion.quantities import Floats

_APART = 40  # points; half-way, what one adds to A has fallen to 4e-12 of it
_DRAWS, _DRAWN = (64, 1024), 200_000  # of random errors, where there is no formula


class Fit(Protocol):
    """A curve from points, and what errors of theirs do to its acceleration."""

    is_smooth: bool
    amount: float

    def curve(self, ways: Floats) -> Curve:
        """Return the curve over x."""

    def effects(self, ways: Floats, most: float, rounded_ends: bool, /) -> tuple[Floats, Floats]:
        """Return what errors up to `most` do to A: at most, and as a root mean square.

        With `rounded_ends` the positions are off at both ends, too, from which the law is made.
        """


class Through:
    """The cubic spline with given slopes at its ends, through all points or smoothed."""

    def __init__(
        self,
        places: Floats,
        slopes: tuple[float, float],
        smoother: AnyPoints | None = None,
        amount: float = 0.0,
    ) -> None:
        self.places, self.slopes, self.amount = places, slopes, amount
        self._smoother, self.is_smooth = smoother, smoother is not None

    def curve(self, ways: Floats) -> Curve:
        """Return the curve over x."""
        if self._smoother is not None:
            ways = self._smoother.smoothed(ways, self.amount)
        return Curve([Spline(self.places, self._spline(ways, self.slopes))])

    def effects(self, ways: Floats, most: float, rounded_ends: bool, /) -> tuple[Floats, Floats]:
        """Return what errors up to `most` do to A: at most, and as a root mean square."""
        ends = _of_ends(ways, rounded_ends)
        if self._smoother is not None:
            shares = self._smoother.shares(self.amount)
            return _sizes(np.hstack([shares, shares @ ends[1:-1]]), most)
        units = _units(self.places.size)
        units[[0, -1]] = 0
        units = np.hstack([units, ends])
        rows = self._spline(units, (np.zeros(units.shape[1]),) * 2)
        return _sizes(_bends(rows, self.places), most)

    def _spline(self, ways: Floats, slopes: object) -> Floats:
        from scipy.interpolate import CubicSpline  # it takes a second to load

        ends = [(1, slope) for slope in slopes]  # type: ignore[attr-defined]
        return np.asarray(CubicSpline(self.places, ways, bc_type=ends).c)


class Periodic:
    """The spline of a law repeated without rest: what it is beside S = x repeats itself."""

    def __init__(self, places: Floats, amount: float) -> None:
        self.places, self.amount, self.is_smooth = places, amount, amount != 0
        self._smoother = AnyPoints(places[:-1], "periodic", period=1.0) if self.is_smooth else None

    def curve(self, ways: Floats) -> Curve:
        """Return the curve over x."""
        beside = (ways - self.places)[:-1]
        if self._smoother is not None:
            beside = self._smoother.smoothed(beside, self.amount)
            beside = beside - beside[0]
        rows = self._spline(beside)
        rows[-2] += 1
        rows[-1] += self.places[:-1]
        return Curve([Spline(self.places, rows)])

    def effects(self, ways: Floats, most: float, rounded_ends: bool, /) -> tuple[Floats, Floats]:
        """Return what errors up to `most` do to A: at most, and as a root mean square."""
        ends = _of_ends(ways, rounded_ends)[1:-1]
        if self._smoother is not None:
            shares = self._smoother.shares(self.amount)
            inner = shares[:, 1:]
            return _sizes(np.hstack([inner, inner @ ends] if rounded_ends else [shares]), most)
        units = _units(self.places.size - 1)
        if rounded_ends:  # and not both by the same
            units[0] = 0
        rows = self._spline(np.hstack([units, np.pad(ends, ((1, 0), (0, 0)))]))
        return _sizes(_bends(rows, self.places), most)

    def _spline(self, beside: Floats) -> Floats:
        from scipy.interpolate import CubicSpline

        closed = np.concatenate([beside, beside[:1]])
        return np.array(CubicSpline(self.places, closed, bc_type="periodic").c)


class Monotone:
    """PCHIP, with given slopes at the ends: cubics in pieces, between which A jumps."""

    is_smooth, amount = False, 0.0

    def __init__(self, places: Floats, slopes: tuple[float, float]) -> None:
        self.places, self.slopes = places, slopes

    def curve(self, ways: Floats) -> Curve:
        """Return the curve over x."""
        rows = self._rows(ways)
        return Curve(
            Spline(self.places[n : n + 2], rows[:, n : n + 1]) for n in range(rows.shape[1])
        )

    def effects(self, ways: Floats, most: float, rounded_ends: bool, /) -> tuple[Floats, Floats]:
        """Return what errors up to `most` do to A: the most of many draws, and their mean square.

        The first has errors up and down in turn, and counts for the most alone. PCHIP takes
        harmonic means of slopes, and so has no shares that could be summed.
        """
        count = self.places.size
        draws = np.clip(_DRAWN // count, *_DRAWS)
        errors = np.random.default_rng(0).uniform(-most, most, (count, draws))
        errors[:, 0] = -most * (-1) ** np.arange(count)
        shifts = _of_ends(ways, True) @ errors[[0, -1]] if rounded_ends else 0.0
        errors[[0, -1]] = 0
        errors += shifts
        off = self._bends(ways[:, None] + errors) - self._bends(ways[:, None])
        return np.max(np.abs(off), axis=1), np.sqrt(np.mean(off[:, 1:] ** 2, axis=1))

    def _bends(self, ways: Floats) -> Floats:
        """Return A before and after each point."""
        rows = self._rows(ways)
        widths = np.diff(self.places)[:, None]
        return np.concatenate([2 * rows[1], 2 * rows[1] + 6 * rows[0] * widths])

    def _rows(self, ways: Floats) -> Floats:
        from scipy.interpolate import CubicHermiteSpline, PchipInterpolator

        slopes = PchipInterpolator(self.places, ways).derivative()(self.places)
        slopes[0], slopes[-1] = self.slopes
        return np.asarray(CubicHermiteSpline(self.places, ways, slopes).c)


def _of_ends(ways: Floats, rounded_ends: bool) -> Floats:
    """Return by how much each point of a law is off where the first or the last position is, by 1.

    A column for each of them, and none for exact ends.
    """
    off = np.column_stack([ways - 1, -ways])
    off[[0, -1]] = 0
    return off if rounded_ends else off[:, :0]


def _units(number: int) -> Floats:
    """Return errors of 1, in a column all that are so far apart that they do not meet."""
    far = np.arange(number)
    even = number - number % _APART
    columns = np.where(far < even, far % _APART, _APART + far - even)
    return np.asarray(np.eye(columns.max() + 1)[columns])


def _bends(rows: Floats, places: Floats) -> Floats:
    """Return A at each point."""
    last = 2 * rows[1, -1:] + 6 * rows[0, -1:] * (places[-1] - places[-2])
    return np.concatenate([2 * rows[1], last])


def _sizes(shares: Floats, most: float) -> tuple[Floats, Floats]:
    """Return the largest sum of shares times errors up to `most`, and its root mean square."""
    spread = most / np.sqrt(3)  # of errors that are as likely anywhere in between
    return most * np.sum(np.abs(shares), axis=1), spread * np.sqrt(np.sum(shares**2, axis=1))
