"""What a linear system does when it is left alone, at many times at once.

x' = A x has the solution exp(A t) x(0). A time is written in binary, as a whole number of steps and
a rest: the exponentials of one step, of two, four, eight are made once by squaring, and each of
them takes on those times in which its digit is 1. The rest is so short that a few terms of the
series are exact. No eigenvectors are asked for: a system that is damped critically has too few.

What is squared is E = exp(A t) - 1, as exp(2 A t) - 1 = 2 E + E E: what changes little beside
something that changes fast would lose its digits in the 1.
"""

import math

import numpy as np

from cammotion.quantities import Floats, InputError

_STEP = 1.0  # how far A may turn or stretch anything in a step
_MOST_STEPS = 2.0**62  # whose number is one of 64 bits
_TERMS = 18  # of the series: the next one is below 1e-17


class Flow:
    """The solution of x' = A x for the square `matrix` A, whatever its eigenvectors are.

    >>> turn = Flow(np.array([[0.0, 1.0], [-1.0, 0.0]]))
    >>> turn(np.array([[1.0], [0.0]]), np.array([np.pi]), rows=np.eye(2)).round(12) + 0.0
    array([[-1.],
           [ 0.]])
    """

    def __init__(self, matrix: Floats) -> None:
        self.matrix = matrix
        size = float(np.linalg.norm(matrix, 2))
        self._step = 2.0 ** math.floor(math.log2(_STEP / size)) if size else 2.0**60
        change = term = matrix * self._step
        for n in range(2, _TERMS + 1):
            term = term @ matrix * (self._step / n)
            change = change + term
        self._changes = [change]  # exp(A t) - 1 for 1, 2, 4, ... steps

    def __call__(self, states: Floats, times: Floats, rows: Floats) -> Floats:
        """Return rows @ each column of `states` after its own time, at least 0, in units of 1/A.

        Raises InputError for a time in which A turns or stretches by more than 2^62.
        """
        steps = np.floor(times / self._step)
        most = steps.max(initial=0.0)
        if not most < _MOST_STEPS:
            raise InputError(
                f"The follower is so stiff or so strongly damped that the time asked for is "
                f"{most:.3g} of its shortest; it has to be below {_MOST_STEPS:.3g}: give softer "
                "springs, less damping, larger masses or an earlier time."
            )
        moved, left, level = states.copy(), steps.astype(np.int64), 0
        while left.any():
            taken = np.flatnonzero(left & 1)
            if taken.size:
                moved[:, taken] += self._change(level) @ moved[:, taken]
            left >>= 1
            level += 1
        return self._for_a_moment(moved, times - steps * self._step, rows)

    def _for_a_moment(self, states: Floats, times: Floats, rows: Floats) -> Floats:
        terms = [rows]
        for n in range(1, _TERMS + 1):
            terms.append(terms[-1] @ self.matrix / n)
        found = terms[-1] @ states
        for term in terms[-2::-1]:
            found *= times
            found += term @ states
        return found

    def _change(self, level: int) -> Floats:
        while len(self._changes) <= level:
            last = self._changes[-1]
            self._changes.append(2 * last + last @ last)
        return self._changes[level]
