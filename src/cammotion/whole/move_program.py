"""The best starts, angles and laws of all moves at once, as a mixed-integer linear program.

A peak acceleration goes with the inverse square of the indexing angle Bm. So the largest peak is
smallest where the least of all Bm / sqrt(what the peak is at 1 deg) is largest: linear in Bm. An
arc over which one half of a rule holds, and one over which the other does not, have to lie apart
in the turn: the one between the end of the other and its next beginning. How many turns that is
off, is a whole number.
"""

import math
from collections.abc import Sequence

import numpy as np

from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats, InputError
from cammotion.whole.crossings import Place
from cammotion.whole.free_moves import NARROWEST_DEG, Apart, Mover, Placed
from cammotion.whole.mixed import Mixed, Rows

_APART_DEG = 4e-6  # so far arcs are kept apart in the end, for what the solver rounds
_MORE_TURNS = 4  # than its start is one part ahead of another


class MoveProgram:
    """The unknowns: of each move its start, for each law its angle, and how wide it is."""

    def __init__(self, movers: Sequence[Mover], apart: Sequence[Apart]) -> None:
        self.movers, self.rows = movers, Rows()
        self.least = self.rows.unknown(0.0, np.inf)
        self.own: list[int] = []
        self.of_part: list[list[int]] = []
        self.starts: list[list[int]] = []
        self.widths: list[list[list[int]]] = []
        self.whole: list[int] = []
        self.apart: list[int] = []
        self.none_after: dict[tuple[int, int], int | None] = {}
        starts = [start for mover in movers for ends in mover.starts for start in ends]
        farthest = 2 * max(map(abs, starts), default=0.0)
        self.most_turns = _MORE_TURNS + math.ceil(farthest / DEG_PER_TURN)
        for mover in movers:
            self._add(mover)
        for pair in apart:
            self._keep_apart(pair)
        if not self.own:  # no peak counts
            self.rows.high[self.least] = 0.0

    def _add(self, mover: Mover) -> None:
        starts, counted = self._add_starts(mover), len(self.own)
        widths = [*map(self._add_width, mover.laws, mover.costs, mover.narrowest, mover.angles)]
        for number, end in enumerate(mover.ends):
            ending = [(starts[number], 1.0), *((one, 1.0) for one in widths[number])]
            self.rows.row(ending, -np.inf, end)
            on = (number + 1) % len(starts)
            turn = 0.0 if on else DEG_PER_TURN
            self.rows.row([*ending, (starts[on], -1.0)], -np.inf, turn)
        self.of_part.append(self.own[counted:])
        self.starts.append(starts)
        self.widths.append(widths)

    def _add_starts(self, mover: Mover) -> list[int]:
        """Add the starts of a part's moves, some of them in a range of any of some turns."""
        rows = self.rows
        starts = rows.unknowns(*np.array(mover.starts).reshape(-1, 2).T)
        for start, begin in zip(starts, mover.begins, strict=True):
            if begin:
                first, last = begin.turns
                turns = rows.unknowns([first], [last], whole=True)
                self.whole += turns
                rows.row([(start, 1.0), (turns[0], -float(DEG_PER_TURN))], *begin.range_deg)
        return starts

    def _add_width(
        self,
        laws: Sequence[MotionLaw],
        costs: Sequence[float],
        narrowest: Sequence[float],
        angles: tuple[float, float],
    ) -> list[int]:
        """Add the angle of a move for each of its laws, of which one is taken."""
        rows, (low, high) = self.rows, angles
        width = rows.unknowns([0.0] * len(laws), [high] * len(laws))
        rows.row([(one, 1.0) for one in width], max(low, NARROWEST_DEG), high)
        if len(laws) > 1:
            taken = rows.choice(len(laws))
            self.whole += taken
            for one, it in zip(width, taken, strict=True):
                rows.row([(one, 1.0), (it, -high)], -np.inf, 0.0)
        if all(costs):
            own = rows.unknown(0.0, np.inf)
            shares = [(one, 1 / math.sqrt(cost)) for one, cost in zip(width, costs, strict=True)]
            rows.row([*shares, (own, -1.0)], 0.0, np.inf)
            rows.row([(own, 1.0), (self.least, -1.0)], 0.0, np.inf)
            self.own.append(own)
        if any(narrowest):
            shares = [(one, 1 / angle) for one, angle in zip(width, narrowest, strict=True)]
            rows.row(shares, 1.0, np.inf)
        return width

    def _keep_apart(self, pair: Apart) -> None:
        """Let the second span lie between the end of the first and its next beginning.

        Or let one of both be a dwell that is none.
        """
        turns = self.rows.unknowns([-self.most_turns], [self.most_turns], whole=True)
        self.whole += turns
        (a, b), (c, d) = ((self._angle(span.start), self._angle(span.end)) for span in pair)
        none = [self._none_after(*span.after) for span in pair if span.after]
        waived = [(one, 2.0 * DEG_PER_TURN) for one in none if one is not None]
        shift = [(turns[0], float(DEG_PER_TURN))]
        for later, earlier, turned in ((c, b, shift), (a, d, [(turns[0], -float(DEG_PER_TURN))])):
            known = earlier[1] - later[1]
            if earlier is d:
                known -= DEG_PER_TURN
            minus = [(column, -factor) for column, factor in earlier[0]]
            terms = _summed([*later[0], *minus, *turned, *waived])
            self.apart.append(self.rows.row(terms, known, np.inf))

    def _none_after(self, part: int, move: int) -> int | None:
        """Return the unknown that is 1 only where there is no dwell after a move.

        None if there is always one, with a still arc in it.
        """
        key = part, move
        if key not in self.none_after:
            self.none_after[key] = self._add_none(part, move)
        return self.none_after[key]

    def _add_none(self, part: int, move: int) -> int | None:
        mover, starts = self.movers[part], self.starts[part]
        on = (move + 1) % len(starts)
        turn = 0 if on else DEG_PER_TURN
        if mover.starts[on][0] + turn > mover.ends[move] + _APART_DEG:
            return None
        none = self.rows.unknowns([0.0], [1.0], whole=True)
        self.whole += none
        gone = [starts[move], *self.widths[part][move]]
        dwell = [(starts[on], 1.0), *((one, -1.0) for one in gone)]
        longest = (none[0], float(DEG_PER_TURN))
        self.rows.row(_summed([*dwell, longest]), -np.inf, DEG_PER_TURN - turn)
        return none[0]

    def _angle(self, end: Place | float) -> tuple[list[tuple[int, float]], float]:
        """Return an end of a span as unknowns with factors, and what is known of it."""
        if not isinstance(end, Place):
            return [], end
        width = self.widths[end.part][end.move]
        shares = [end.shares[min(n, len(end.shares) - 1)] for n in range(len(width))]
        terms = [(self.starts[end.part][end.move], 1.0), *zip(width, shares, strict=True)]
        return terms, float(end.turns * DEG_PER_TURN)

    def solved(self, seconds: float) -> Mixed:
        """Return what the solver finds; raise InputError where the time was too short to tell."""
        found = self.rows.solve(seconds)
        if found.is_open:
            raise InputError(
                f"In {seconds:.3g} s no starts and angles were found that keep all of this, nor "
                "that there are none: give more seconds."
            )
        return found

    def settle(self, x: Floats) -> Floats | None:
        """Keep the whole numbers that were found; return the best unknowns with these.

        All arcs are a little apart then. None if there are none: then some have to touch each
        other, or only rounding, of numbers as large as a turn, has let them be.
        """
        for column in self.whole:
            self.rows.low[column] = self.rows.high[column] = float(np.round(x[column]))
            self.rows.whole[column] = 0
        self.rows.tighten(self.apart, _APART_DEG)
        return self.rows.solve().unknowns

    def touching(self) -> Floats | None:
        """Return what `settle` does, for arcs that may touch each other to the last digit."""
        self.rows.tighten(self.apart, -_APART_DEG)
        return self.rows.solve().unknowns

    def moves(self, x: Floats) -> list[list[Placed]]:
        """Return the moves of each part."""
        found = []
        for mover, starts, widths in zip(self.movers, self.starts, self.widths, strict=True):
            chosen = [int(np.argmax(x[width])) for width in widths]
            found.append(
                [
                    Placed(float(x[start]), float(x[width].sum()), laws[law])
                    for start, width, laws, law in zip(
                        starts, widths, mover.laws, chosen, strict=True
                    )
                ]
            )
        return found


def _summed(terms: Sequence[tuple[int, float]]) -> list[tuple[int, float]]:
    """Return a sum in which each unknown is once."""
    factors: dict[int, float] = {}
    for column, factor in terms:
        factors[column] = factors.get(column, 0.0) + factor
    return list(factors.items())
