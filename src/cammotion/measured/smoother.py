"""The smoothing spline of points: how it divides what they consist of, and with what amount.

Of all curves f it is the one with the least

    mean of (points - f)^2  +  amount * mean of f''^2,

the first mean over the points, the second over the places. It is a cubic spline with a knot at each
point. Between the values f at the knots and the second derivatives g there, R g = Q f holds, with
two banded matrices of the widths between the knots; and the mean of f''^2 is g'Rg. So the points
fall apart into modes, the eigenvectors of Q'R^-1 Q, and each is divided by 1 + amount * (its own
eigenvalue): that is Demmler's and Reinsch's form. They are found from the root of that matrix, as
singular vectors: the eigenvalues of points that nearly touch are so large that in the matrix itself
their rounding would cover the small ones. On even points of a cycle the modes are the
harmonics. With the width d of a step the k-th has, for every amount, the eigenvalue

    48 sin(k d/2)^4 / (d^4 (2 + cos(k d))),    and    g = -12 sin(k d/2)^2 / (d^2 (2 + cos(k d))) f,

which for small k d are the k^4 and the -k^2 of differentiation.

The amount can be chosen by generalised cross-validation (Craven and Wahba): the least of

    mean of (points - f)^2 / (mean share of each mode that is taken away)^2,

which estimates how well a point that was left out would have been foretold.
"""

import math
from typing import Any, Literal

import numpy as np

from cammotion.quantities import Floats, InputError

Ends = Literal["natural", "clamped", "periodic"]
MOST = 1000  # points, of which every eigenvector is reckoned
_SCAN = 400  # amounts
_LINES = {"natural": 2, "clamped": 0, "periodic": 1}  # modes that do not bend


class EvenCycle:
    """The smoother of a whole turn of even points, of any number; angles in rad."""

    def __init__(self, number: int) -> None:
        step = 2 * np.pi / number
        sine = np.sin(np.pi * np.arange(number) / number) ** 2
        self.bends = -12 * sine / (step**2 * (3 - 2 * sine))
        self.eigenvalues = 48 * sine**2 / (step**4 * (3 - 2 * sine))

    def modes(self, values: Floats) -> Any:
        """Return the parts of the points, a complex number for each rank and its negative."""
        return np.fft.fft(values, norm="ortho")

    def smoothed(self, values: Floats, amount: float) -> Floats:
        """Return the values of the spline at the points."""
        modes = self.modes(values) / (1 + amount * self.eigenvalues)
        return np.fft.ifft(modes, norm="ortho").real

    def spreads(self, amount: float) -> Floats:
        """Return the root of the sum of squares of what each reading adds to f'', at each point."""
        shares = self.bends / (1 + amount * self.eigenvalues)
        return np.full(shares.size, np.sqrt(np.mean(shares**2)))


class AnyPoints:
    """The smoother of at most 1000 points at any places.

    With "natural" ends the spline ends straight. With "clamped" ones it keeps the first and the
    last value and has the slopes that are given there. A "periodic" one closes after the `period`.
    """

    def __init__(
        self,
        places: Floats,
        ends: Ends,
        period: float = 0.0,
        slopes: tuple[float, float] = (0.0, 0.0),
    ) -> None:
        if places.size > MOST:
            raise InputError(
                f"There are {places.size} points to be smoothed; at uneven places or between two "
                f"ends that is possible for at most {MOST}: take one of every "
                f"{math.ceil(places.size / MOST)}, or give a whole turn of even angles."
            )
        length = period or float(places[-1] - places[0])
        r, q = _matrices(places, period if ends == "periodic" else None)
        if ends == "natural":
            r, q = r[1:-1, 1:-1], q[1:-1]
        self._bends = np.linalg.solve(r, q)
        self._ends, self._places, self._slopes = ends, places, slopes
        self._free = slice(1, -1) if ends == "clamped" else slice(None)
        root = np.linalg.solve(np.linalg.cholesky(r), q)[:, self._free]
        _, values, vectors = np.linalg.svd(root)
        self._vectors, count = vectors.T, len(vectors)
        bending = count - _LINES[ends]
        self.eigenvalues = np.pad(values[:bending] ** 2, (0, _LINES[ends])) * count / length

    def modes(self, values: Floats) -> Floats:
        """Return the parts of the points, measured from the smoothest curve with these ends."""
        return self._vectors.T @ (values - self._smoothest(values))[self._free]

    def smoothed(self, values: Floats, amount: float) -> Floats:
        """Return the values of the spline at the points."""
        result = self._smoothest(values)
        parts = self.modes(values) / (1 + amount * self.eigenvalues)
        result[self._free] += self._vectors @ parts
        return result

    def shares(self, amount: float) -> Floats:
        """Return what each reading adds to f'' at each knot, knots by readings."""
        taken = self._vectors / (1 + amount * self.eigenvalues) @ self._vectors.T
        shares = self._bends[:, self._free] @ taken
        return np.pad(shares, ((1, 1), (0, 0))) if self._ends == "natural" else shares

    def spreads(self, amount: float) -> Floats:
        """Return the root of the sum of squares of what each reading adds to f'', at each point."""
        return np.asarray(np.sqrt(np.sum(self.shares(amount) ** 2, axis=1)))

    def _smoothest(self, values: Floats) -> Floats:
        """Return what an endless amount leaves: a line, the mean, or a cubic between the ends."""
        if self._ends == "natural":
            return np.asarray(np.polyval(np.polyfit(self._places, values, 1), self._places))
        if self._ends == "periodic":
            return np.full(values.size, values.mean())
        length = self._places[-1] - self._places[0]
        u = (self._places - self._places[0]) / length
        early = values[0] * (1 + 2 * u) + length * self._slopes[0] * u
        late = values[-1] * (3 - 2 * u) - length * self._slopes[1] * (1 - u)
        return np.asarray((1 - u) ** 2 * early + u**2 * late)


Smoother = EvenCycle | AnyPoints


def score(smoother: Smoother, modes: Any, amount: float) -> float:
    """Return the score of generalised cross-validation: the square of what the points are in."""
    away = smoother.eigenvalues / (1 + amount * smoother.eigenvalues)  # over amount, which cancels
    return float(np.mean(np.abs(away * modes) ** 2) / np.mean(away) ** 2)


def chosen_amount(smoother: Smoother, modes: Any) -> float:
    """Return the amount of the least score; 0 where any smoothing makes it larger."""
    from scipy.optimize import minimize_scalar

    stiff = smoother.eigenvalues[smoother.eigenvalues > 0]
    logs = np.linspace(np.log(1e-4 / stiff.max()), np.log(1e4 / stiff.min()), _SCAN)
    scores = [score(smoother, modes, float(np.exp(log))) for log in logs]
    best = int(np.argmin(scores))
    if best == 0:
        return 0.0
    around = logs[best - 1], logs[min(best + 1, _SCAN - 1)]
    found = minimize_scalar(
        lambda log: score(smoother, modes, float(np.exp(log))),
        bounds=around,
        method="bounded",
        options={"xatol": 1e-8},
    )
    return float(np.exp(found.x))


def _matrices(places: Floats, period: float | None) -> tuple[Floats, Floats]:
    """Return R and Q, a row for each knot."""
    closing = [] if period is None else [places[0] + period]
    widths = np.diff([*places, *closing])
    number, left = places.size, np.arange(widths.size)
    right = (left + 1) % number
    r, q, slopes = (np.zeros((rows, number)) for rows in (number, number, widths.size))
    for row, column, share in ((left, left, 3), (right, right, 3), (left, right, 6)):
        np.add.at(r, (row, column), widths / share)
    np.add.at(r, (right, left), widths / 6)
    slopes[left, right], slopes[left, left] = 1 / widths, -1 / widths
    np.add.at(q, left, slopes)
    np.add.at(q, right, -slopes)
    return r, q
