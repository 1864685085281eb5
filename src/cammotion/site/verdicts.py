"""What an exercise says to any number, tabled when a page is built, so that no page judges.

What `find_fault` says changes only at few numbers: where an answer is near enough to the right one
or to a slip, where it is rounded to one of them, where it is as near to the one as to the other.
Between two neighbours of these it says the same, so it is asked once there.
"""

import math
import re
from bisect import bisect
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from cammotion.machine.kinematics import MM_PER_M
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import Slip
from cammotion.teaching.number_exercise import EXACT, NEAR, NOT_FAR, NumberExercise
from cammotion.teaching.rounding import FEWEST, MOST, MOST_OFF, SAME, TYPED, WHOLE, last_place

_MEASURED = re.compile(r"(?<=off by )\S+(?= %)")
_MARK = "…"


@dataclass(frozen=True)
class Verdicts:
    """What is said below, between and above `edges`, by its place in `said`; "" is right.

    Where … stands in it, a page puts how many percent an answer is off `right`.
    """

    right: float
    edges: tuple[float, ...]
    places: tuple[int, ...]
    said: tuple[str, ...]

    def of(self, given: float) -> str:
        """Return what is said to a number."""
        return self.said[self.places[bisect(self.edges, given)]]


def table_of(exercise: NumberExercise, machine: MillAndDie) -> Verdicts:
    """Return what an exercise says to every number, asked about a machine."""
    edges = sorted({*_edges(exercise, machine)})
    texts = [_text(exercise, place, machine) for place in _between(edges)]
    said = [*dict.fromkeys(texts)]
    kept = [n for n, (one, next_) in enumerate(pairwise(texts)) if one != next_]
    places = [said.index(texts[n]) for n in (*kept, len(texts) - 1)]
    right = exercise.solution(machine)
    return Verdicts(right, tuple(edges[n] for n in kept), tuple(places), tuple(said))


def _text(exercise: NumberExercise, given: float, machine: MillAndDie) -> str:
    return _MEASURED.sub(_MARK, exercise.find_fault(given, machine))


def _edges(exercise: NumberExercise, machine: MillAndDie) -> Iterator[float]:
    """Yield every number at which something else may be said, and some more."""
    right = exercise.solution(machine)
    slips = sorted(_numbers(exercise.slips, machine))
    carried = _numbers(exercise.carried, machine)
    ratios = [ratio * right for ratio in exercise.ratios]
    yield from (0.0, right, -right)
    yield from ((one + other) / 2 for one, other in pairwise(slips))
    lessons = [*filter(math.isfinite, exercise.of_the_lesson(machine))]
    for value in lessons[:1]:
        yield from _rounded(value, FEWEST + 1)
    in_g = exercise.in_g(right)
    for value in (right, *lessons, *slips, *carried, *ratios, *in_g):
        yield from (*_beside(value, TYPED), *_rounded(value, MOST))
    for share in (NEAR, NOT_FAR):
        yield from _beside(right, share)
    for value in slips:
        yield (value + right) / 2
        yield from (*_beside(value, SAME), value * (1 - MOST_OFF), value * (1 + MOST_OFF))
    for value in (MM_PER_M * slip for slip in slips if exercise.is_product):
        yield from (*_beside(value, exercise.tolerance), *_rounded(value, FEWEST + 1))
    for value in (right, *slips, *carried, *ratios, *in_g):
        yield from _beside(value, exercise.tolerance)
        most = EXACT if value == right else MOST if value in slips else FEWEST + 1
        for digits in range(FEWEST, most + 1):
            yield from _rounded(value, digits)


def _numbers(slips: Iterable[Slip], machine: MillAndDie) -> list[float]:
    return [n for slip in slips if math.isfinite(n := float(slip.leads_to(machine)))]


def _beside(value: float, share: float) -> Iterator[float]:
    """Yield the ends of what is near to a value, measured by the one or by the other."""
    yield from (value * (1 - share), value * (1 + share), value / (1 - share), value / (1 + share))


def _rounded(value: float, digits: int) -> Iterator[float]:
    """Yield the ends of what is a value rounded to so many digits."""
    unit = last_place(value, digits) if value else SAME
    for whole in {math.floor(value / unit), math.ceil(value / unit)}:
        yield from ((whole + side * size) * unit for side in (-1, 1) for size in (WHOLE, 0.5))


def _between(edges: list[float]) -> Iterator[float]:
    """Yield a number below, between and above the edges."""
    yield 2 * edges[0] - 1
    yield from ((low + high) / 2 for low, high in pairwise(edges))
    yield 2 * edges[-1] + 1
