"""Mixed-integer linear programs, solved by HiGHS, that can be stopped at any moment."""

import os
import sys
import threading
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import Future
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np

from cammotion.limits.linear import Program, search
from cammotion.quantities import Floats

_INFEASIBLE = 2
_TICK_S = 0.05
_GRACE_S = 2.0
_WITHIN = 1e-4  # of the objective: so near to the best is found


class Mixed(NamedTuple):
    """What came out: the unknowns if some were found, and what the objective is not below.

    `bound` is None where the time was too short to say anything, infinite where there is nothing
    to be found.
    """

    unknowns: Floats | None
    bound: float | None


class Rows:
    """Unknowns with their ends, and rows that bind them, gathered one after the other."""

    def __init__(self) -> None:
        self.low: list[float] = []
        self.high: list[float] = []
        self.cost: list[float] = []
        self.whole: list[int] = []
        self._rows: list[tuple[float, float]] = []
        self._entries: tuple[list[int], list[int], list[float]] = ([], [], [])

    def unknowns(self, low: Any, high: Any, *, whole: bool = False, cost: float = 0.0) -> list[int]:
        """Add unknowns between two ends, arrays of one length; return their numbers."""
        first, count = len(self.low), len(low)
        self.low += map(float, low)
        self.high += map(float, high)
        self.cost += [cost] * count
        self.whole += [int(whole)] * count
        return list(range(first, first + count))

    def unknown(self, low: float, high: float, *, cost: float = 0.0) -> int:
        """Add one unknown; return its number."""
        return self.unknowns([low], [high], cost=cost)[0]

    def row(self, terms: Sequence[tuple[int, float]], low: float, high: float) -> None:
        """Bind a sum of factors times unknowns to a range."""
        rows, columns, factors = self._entries
        for column, factor in terms:
            rows.append(len(self._rows))
            columns.append(column)
            factors.append(factor)
        self._rows.append((low, high))

    def within(self, terms: Sequence[tuple[int, float]], by: int, times: float) -> None:
        """Bind the magnitude of a sum to another unknown times a factor."""
        self.row([*terms, (by, -times)], -np.inf, 0.0)
        self.row([*terms, (by, times)], 0.0, np.inf)

    def solve(self, seconds: float = np.inf) -> Mixed:
        """Return the unknowns with the least cost, and a bound of it that is the solver's word.

        Runs in a thread of its own, so that an interrupt of the keyboard is heard. A solver that
        does not look at the clock for some seconds is left alone to end by itself.
        """
        found: Future[Mixed] = Future()

        def work() -> None:
            try:
                found.set_result(self._solve(seconds))
            except BaseException as error:
                found.set_exception(error)

        worker = threading.Thread(target=work, daemon=True)
        worker.start()
        with _silent():
            until = time.monotonic() + seconds + _GRACE_S
            while worker.is_alive() and time.monotonic() < until:
                worker.join(_TICK_S)
        return found.result() if found.done() else Mixed(None, None)

    def solve_with_proof(self, seconds: float) -> Mixed:
        """Return the unknowns with the least cost, all of them with ends, and a proved bound of it.

        The bound is computed from multipliers, and does not rest on the solver's word.
        """
        matrix, low, high = self._scaled()
        below, above = np.isfinite(low), np.isfinite(high)
        program = Program(
            np.array(self.cost),
            ([-matrix[below], matrix[above]], [-low[below], high[above]]),
            ([matrix[:0]], [low[:0]]),
            np.column_stack([self.low, self.high]),
            "",
            np.flatnonzero(self.whole).tolist(),
        )
        return Mixed(*search(program, seconds=seconds))

    def _solve(self, seconds: float) -> Mixed:
        from scipy.optimize import Bounds, LinearConstraint, milp

        options: dict[str, Any] = {"mip_rel_gap": _WITHIN}
        if np.isfinite(seconds):
            options["time_limit"] = max(seconds, _TICK_S)
        result = milp(
            np.array(self.cost),
            constraints=LinearConstraint(*self._scaled()),
            bounds=Bounds(np.array(self.low), np.array(self.high)),
            integrality=np.array(self.whole),
            options=options,
        )
        if result.status == _INFEASIBLE:
            return Mixed(None, np.inf)
        bound = result.mip_dual_bound if any(self.whole) else result.fun
        return Mixed(result.x, None if bound is None else float(bound))

    def _scaled(self) -> tuple[Any, Floats, Floats]:
        """Return the rows as a matrix with their ends, the largest factor of each being 1."""
        from scipy import sparse

        rows, columns, factors = self._entries
        shape = len(self._rows), len(self.low)
        matrix = sparse.csr_matrix((factors, (rows, columns)), shape=shape)
        matrix.eliminate_zeros()
        low, high = np.array(self._rows).T
        size = np.maximum(abs(matrix).max(axis=1).toarray().ravel(), 1e-12)
        return (sparse.diags(1 / size) @ matrix).tocsr(), low / size, high / size


@contextmanager
def _silent() -> Iterator[None]:
    """Keep what the solver prints, whatever it is told, from the terminal."""
    sys.stdout.flush()
    try:
        kept = os.dup(1)
    except OSError:  # there is no terminal, as on a server without one
        yield
        return
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        yield
    finally:
        os.dup2(kept, 1)
        os.close(nowhere)
        os.close(kept)
