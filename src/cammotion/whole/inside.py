"""The moves of a program as SciPy's SLSQP takes them: starts and angles, and what binds them."""

from collections.abc import Iterator
from typing import Any, NamedTuple

import numpy as np

from cammotion.quantities import Floats
from cammotion.whole.move_program import MoveProgram


class Inside(NamedTuple):
    """What binds the start and the angle of each move, these two after each other: rows and ends.

    `columns` are their numbers among all unknowns.
    """

    columns: list[int]
    rows: Floats
    low: Floats
    high: Floats
    ends: tuple[Floats, Floats]

    def linear(self, unit: float) -> Iterator[dict[str, Any]]:
        """Yield the rows of both sides as SLSQP takes them, all unknowns in parts of `unit`."""
        rows = np.column_stack([unit * self.rows, np.zeros(len(self.rows))])
        for side, ends in ((1, self.low), (-1, self.high)):
            bound = np.isfinite(ends)
            matrix, limits = side * rows[bound], side * ends[bound]
            if bound.any():
                yield {
                    "type": "ineq",
                    "fun": lambda z, matrix=matrix, limits=limits: matrix @ z - limits,
                    "jac": lambda _, matrix=matrix: matrix,
                }

    def missed(self, z: Floats) -> float:
        """Return by how much the rows are missed."""
        values = self.rows @ z
        return float(np.maximum(self.low - values, values - self.high).max(initial=0.0))


def inside(program: MoveProgram, x: Floats) -> Inside:
    """Return what binds starts and angles, with whole numbers and laws as they were found."""
    rows, columns = program.rows, list[int]()
    for starts, widths in zip(program.starts, program.widths, strict=True):
        for start, width in zip(starts, widths, strict=True):
            chosen = width[int(np.argmax(x[width]))]
            columns += [start, chosen]
            for other in {*width} - {chosen}:
                rows.low[other] = rows.high[other] = 0.0
    matrix, low, high = rows.scaled()
    others = np.setdiff1d(np.arange(matrix.shape[1]), columns)
    own = abs(matrix[:, others]).sum(axis=1).A1 == 0
    ends = np.array(rows.low)[columns], np.array(rows.high)[columns]
    return Inside(columns, matrix[own][:, columns].toarray(), low[own], high[own], ends)
