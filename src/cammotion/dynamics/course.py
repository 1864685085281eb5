"""The state of a driven follower over a curve: from piece to piece, and anywhere between.

Over a piece the follower and what drives it are one linear system without a drive, so that its
state anywhere in the piece is an exponential of one matrix, times the state at its beginning. That
is exact for polynomials and waves, in resonance and with any damping.
"""

from collections.abc import Sequence
from functools import cached_property
from typing import NamedTuple

import numpy as np

from cammotion.dynamics.chain import System
from cammotion.dynamics.flow import Flow
from cammotion.dynamics.forcing import Forcing, Generator
from cammotion.dynamics.peaks import Integers
from cammotion.quantities import Floats, InputError

_PER_SWING, _FEWEST = 24, 9  # samples
_MOST_SWINGS = 100_000  # between two places; the samples of more would fill the memory


class Spots(NamedTuple):
    """Places of a course: its pieces by number, and how far in each they are."""

    pieces: Integers
    within: Floats


class Course:
    """How a `system` goes over `forcings`, which follow one another; both by one unit of time.

    The last one may have no end: its `high` is infinite then, and `passage` goes to its beginning.
    """

    def __init__(self, system: System, forcings: Sequence[Forcing]) -> None:
        self.system = system
        self.lows = np.array([each.low for each in forcings])
        self.high = forcings[-1].high
        self._widths = np.diff(self.lows, append=self.high)
        kinds: dict[object, list[int]] = {}
        for number, each in enumerate(forcings):
            kinds.setdefault(each.kind, []).append(number)
        self._forcings = forcings
        self._kind_of = np.empty(len(forcings), dtype=np.intp)
        self._row_of = np.empty(len(forcings), dtype=np.intp)
        self._kinds = []
        for kind, numbers in enumerate(kinds.values()):
            self._kind_of[numbers], self._row_of[numbers] = kind, np.arange(len(numbers))
            self._kinds.append(_Kind(system, [forcings[number] for number in numbers]))

    def spots(self, places: Floats) -> Spots:
        """Return where places between both ends are; a joint belongs to the piece after it."""
        pieces = np.clip(np.searchsorted(self.lows, places, side="right") - 1, 0, None)
        return Spots(pieces, np.maximum(places - self.lows[pieces], 0.0))

    def begins(self, state: Floats) -> Floats:
        """Return the state at the beginning of each piece and at an end, a row for each."""
        found = [state]
        for passed, pushed in zip(*self._passages, strict=True):
            found.append(found[-1] @ passed + pushed)
        return np.array(found)

    @cached_property
    def passage(self) -> tuple[Floats, Floats]:
        """What the course does to a state, up to a piece without end: state @ matrix + row."""
        size = len(self.system.input)
        whole, shift = np.eye(size), np.zeros(size)
        for passed, pushed in zip(*self._passages, strict=True):
            whole, shift = whole @ passed, shift @ passed + pushed
        return whole, shift

    def seen(self, row: Floats, begins: Floats, spots: Spots, *, rates: int = 0) -> Floats:
        """Return row @ state at spots, from the states `begins`, in columns, where pieces begin.

        With `rates` 1 or 2 its first, or its first and second derivatives follow, a row for each.
        """
        found = np.empty((1 + rates, len(spots.within)))
        which = self._kind_of[spots.pieces]
        for number, kind in enumerate(self._kinds):
            here = slice(None) if len(self._kinds) == 1 else np.flatnonzero(which == number)
            numbers, within = self._row_of[spots.pieces[here]], spots.within[here]
            if len(numbers):
                found[:, here] = kind.after(begins[:, here], numbers, within, kind.seen(row, rates))
        return found

    def samples(self, over: Sequence[tuple[float, float]]) -> list[list[Spots]]:
        """Return spots from one place to another of each two, piece by piece, with both ends.

        There are 24 in each swing of the fastest mode or wave, and more where a piece begins, after
        which what is damped strongly changes soonest. Raises InputError for too many of all.
        """
        swings = sum(float(np.maximum(self._parts(*ends)[3], 1).sum()) for ends in over)
        if swings > _MOST_SWINGS:
            raise InputError(
                f"The follower can swing {swings:.3g} times between the places to look between, "
                f"once in each piece of its motion at least; at most {_MOST_SWINGS:g} are looked "
                "at: give places that are closer together, or a softer spring."
            )
        return [
            [
                Spots(np.full(len(within), number), within)
                for number, *ends in zip(*self._parts(*each), strict=True)
                for within in [self._within(*ends)]
            ]
            for each in over
        ]

    def _parts(self, low: float, high: float) -> tuple[Integers, Floats, Floats, Floats]:
        """Return the pieces between two places, from where to where in each, and its swings."""
        begins = np.maximum(low - self.lows, 0.0)
        ends = np.minimum(high - self.lows, self._widths)
        numbers = np.flatnonzero(begins < ends)
        begins, ends = begins[numbers], ends[numbers]
        return numbers, begins, ends, self._fastest[numbers] * (ends - begins) / (2 * np.pi)

    @cached_property
    def _fastest(self) -> Floats:
        """The fastest mode or wave of each piece."""
        modes = self.system.frequencies[-1]
        waves = ([abs(rate) for _, rate, _ in each.waves] for each in self._forcings)
        return np.array([max([modes, *rates]) for rates in waves])

    def _within(self, begin: float, end: float, swings: float) -> Floats:
        count = _FEWEST + int(_PER_SWING * swings)
        soonest = 1 / np.linalg.norm(self.system.matrix, 2)
        soon = np.arange(max(0.0, np.log2((end - begin) / soonest) + 1))
        early = (end - begin) * 2.0**-soon
        return np.union1d(np.linspace(begin, end, count), begin + early)

    @cached_property
    def _passages(self) -> tuple[Floats, Floats]:
        """What each piece that ends does to a state: a matrix from the right, a row to be added."""
        size = len(self.system.input)
        units = np.vstack([np.eye(size), np.zeros(size)])
        ends = np.isfinite(self._widths)
        passed = np.empty((np.count_nonzero(ends), size + 1, size))
        for number, kind in enumerate(self._kinds):
            here = np.flatnonzero((self._kind_of == number) & ends)
            begins = np.tile(units, (len(here), 1)).T
            numbers = np.repeat(np.arange(len(here)), size + 1)
            widths = np.repeat(self._widths[here], size + 1)
            after = kind.after(begins, numbers, widths, kind.states)
            passed[here] = after.T.reshape(len(here), size + 1, size)
        pushed = passed[:, -1]
        return passed[:, :-1] - pushed[:, None], pushed


class _Kind:
    """The system together with what brings forth all forcings of one kind."""

    def __init__(self, system: System, forcings: Sequence[Forcing]) -> None:
        generator = Generator(forcings)
        own, other = len(system.input), len(generator.sum)
        matrix = np.zeros((own + other, own + other))
        matrix[:own, :own], matrix[own:, own:] = system.matrix, generator.matrix
        scale = np.linalg.norm(matrix, 2) / np.linalg.norm(system.input)  # of like size, all of it
        matrix[:own, own:] = np.outer(system.input, generator.sum) * scale
        self._starts = generator.starts.T / scale
        self._flow = Flow(matrix)
        self.states = np.eye(own, own + other)

    def seen(self, row: Floats, rates: int) -> Floats:
        """Return the rows that make of all states what `row` makes of the follower's, and rates."""
        found = [row @ self.states]
        for _ in range(rates):
            found.append(found[-1] @ self._flow.matrix)
        return np.array(found)

    def after(self, begins: Floats, numbers: Integers, within: Floats, rows: Floats) -> Floats:
        """Return rows @ states after the pieces of those numbers have begun."""
        return self._flow(np.vstack([begins, self._starts[:, numbers]]), within, rows)
