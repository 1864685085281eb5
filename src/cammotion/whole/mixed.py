"""Mixed-integer linear programs, gathered row by row: solved by HiGHS, or with a proof of ours."""

import os
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np

from cammotion.limits.linear import INFEASIBLE, Program, search
from cammotion.quantities import Floats

_SHORTEST_S = 0.05
_WITHIN = 1e-4  # of the objective: so near to the best is found


class Mixed(NamedTuple):
    """What came out: the unknowns if some were found, and what the objective is not below.

    `bound` is None where the time was too short to say anything, infinite where there is nothing
    to be found.
    """

    unknowns: Floats | None
    bound: float | None

    @property
    def is_open(self) -> bool:
        """Whether nothing was found, and not that there is nothing to be found."""
        return self.unknowns is None and self.bound != np.inf


class Rows:
    """Unknowns with their ends, and rows that bind them, gathered one after the other."""

    def __init__(self) -> None:
        self.low: list[float] = []
        self.high: list[float] = []
        self.cost: list[float] = []
        self.whole: list[int] = []
        self.choices: list[list[int]] = []
        self._rows: list[tuple[float, float]] = []
        self._entries: tuple[list[int], list[int], list[float]] = ([], [], [])

    def copied(self) -> "Rows":
        """Return the same once more, for what is asked only once."""
        twin = Rows()
        twin.low, twin.high, twin.cost, twin.whole = (
            [*self.low],
            [*self.high],
            [*self.cost],
            [*self.whole],
        )
        twin.choices, twin._rows = [*self.choices], [*self._rows]
        rows, columns, factors = self._entries
        twin._entries = [*rows], [*columns], [*factors]
        return twin

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

    def choice(self, count: int) -> list[int]:
        """Add so many unknowns of which one is 1 and all others 0; return their numbers."""
        taken = self.unknowns([0.0] * count, [1.0] * count, whole=True)
        self.row([(one, 1.0) for one in taken], 1.0, 1.0)
        self.choices.append(taken)
        return taken

    def row(self, terms: Sequence[tuple[int, float]], low: float, high: float) -> int:
        """Bind a sum of factors times unknowns to a range; return the number of the row."""
        rows, columns, factors = self._entries
        for column, factor in terms:
            rows.append(len(self._rows))
            columns.append(column)
            factors.append(factor)
        self._rows.append((low, high))
        return len(self._rows) - 1

    def tighten(self, numbers: Sequence[int], by: float) -> None:
        """Raise the low ends of rows."""
        for number in numbers:
            low, high = self._rows[number]
            self._rows[number] = low + by, high

    def within(self, terms: Sequence[tuple[int, float]], by: int, times: float) -> None:
        """Bind the magnitude of a sum to another unknown times a factor."""
        self.row([*terms, (by, -times)], -np.inf, 0.0)
        self.row([*terms, (by, times)], 0.0, np.inf)

    def solve(self, seconds: float = np.inf) -> Mixed:
        """Return the unknowns with the least cost, and a bound of it that is the solver's word."""
        from scipy.optimize import Bounds, LinearConstraint, milp

        options: dict[str, Any] = {"mip_rel_gap": _WITHIN}
        if np.isfinite(seconds):
            options["time_limit"] = max(seconds, _SHORTEST_S)
        with _silent():
            result = milp(
                np.array(self.cost),
                constraints=LinearConstraint(*self.scaled()),
                bounds=Bounds(np.array(self.low), np.array(self.high)),
                integrality=np.array(self.whole),
                options=options,
            )
        if result.status == INFEASIBLE:
            return Mixed(None, np.inf)
        bound = result.mip_dual_bound if any(self.whole) else result.fun
        return Mixed(result.x, None if bound is None else float(bound))

    def solve_with_proof(self, seconds: float) -> Mixed:
        """Return the unknowns with the least cost, all of them with ends, and a proved bound of it.

        The bound is computed from multipliers, and does not rest on the solver's word.
        """
        matrix, low, high = self.scaled()
        below, above = np.isfinite(low), np.isfinite(high)
        program = Program(
            np.array(self.cost),
            ([-matrix[below], matrix[above]], [-low[below], high[above]]),
            ([matrix[:0]], [low[:0]]),
            np.column_stack([self.low, self.high]),
            "",
            sorted(set(np.flatnonzero(self.whole).tolist()) - set().union(*self.choices)),
            self.choices,
        )
        return Mixed(*search(program, seconds=seconds))

    def scaled(self) -> tuple[Any, Floats, Floats]:
        """Return the rows as a matrix with their ends, the largest factor of each being 1.

        Unknowns that are fixed are taken out: their factors would make a row coarser.
        """
        from scipy import sparse

        rows, columns, factors = self._entries
        shape = len(self._rows), len(self.low)
        matrix = sparse.csr_matrix((factors, (rows, columns)), shape=shape)
        matrix.eliminate_zeros()
        least, most = np.array(self.low), np.array(self.high)
        fixed = least == most
        known = matrix @ np.where(fixed, least, 0.0)
        matrix = matrix @ sparse.diags(np.where(fixed, 0.0, 1.0))
        low, high = np.array(self._rows).reshape(-1, 2).T - known
        size = abs(matrix).max(axis=1).toarray().ravel()
        size[size == 0] = 1.0
        return (sparse.diags(1 / size) @ matrix).tocsr(), low / size, high / size


@contextmanager
def _silent() -> Iterator[None]:
    """Keep what HiGHS prints, whatever it is told, from the terminal."""
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
