"""What one version of a machine has in another way than the other, by numbers and not by words."""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import zip_longest

from cammotion.laws.catalogue import as_law
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import plural

SAME = 1e-9  # by such a share two numbers may differ and be one
NONE = "–"
_DIGITS = 4, 7, 10  # of an angle: the first that show a difference


@dataclass(frozen=True)
class Change:
    """What one version has in another way than the other, in words; "–" is what it lacks.

    `of` is a motion, or "machine" for its rate.
    """

    of: str
    what: str
    before: str
    after: str

    def __str__(self) -> str:
        """Say it in words."""
        return f"{self.of}, {self.what}: {self.before} → {self.after}"


def changes(before: TimingDiagram, after: TimingDiagram) -> Iterator[Change]:
    """Yield what one version has in another way than the other: rate, motions, moves, laws."""
    if not math.isclose(before.rate_per_hour, after.rate_per_hour, rel_tol=SAME):
        rates = (f"{diagram.rate_per_hour:.6g} pieces/h" for diagram in (before, after))
        yield Change("machine", "rate", *rates)
    for name, old, new in pairs(before, after):
        if old is None or new is None:
            yield Change(name, "motion", *map(_whole, (old, new)))
        else:
            yield from _of_motion(old, new)


def _of_motion(old: Motion, new: Motion) -> Iterator[Change]:
    """Yield what is another thing in two versions of a motion: stops, position, moves."""
    if old.stops != new.stops:
        stops = (NONE if motion.stops is None else str(motion.stops) for motion in (old, new))
        yield Change(old.name, "stops", *stops)
    before, after = old.moves, _turned(old.moves, new.moves)
    start = (before or old.segments)[0]
    alike = [each for each in (after or new.segments) if each.kind == start.kind]
    other_start = (alike or after or new.segments)[0]
    if not _is_same(start.from_mm, other_start.from_mm, abs(old.pitch_mm)):
        what = f"position before the {start.kind}" if before else "position"
        places = (f"{each.from_mm:.12g} mm" for each in (start, other_start))
        yield Change(old.name, what, *places)
    for one, other in zip_longest(_not_in(after, before), _not_in(before, after)):
        kinds = {move.kind for move in (one, other) if move}
        yield Change(old.name, kinds.pop() if len(kinds) == 1 else "move", *_said(one, other))


def _is_same(one: float, other: float, period: float = 0.0) -> bool:
    """Whether two numbers are one but for rounding, or but for whole periods."""
    apart = abs(one - other)
    if period:
        apart = min(apart % period, period - apart % period)
    return apart <= SAME * max(1.0, abs(one), abs(other))


def _not_in(others: Iterable[Segment], moves: Iterable[Segment]) -> list[Segment]:
    """Return those moves of a version that the other one does not have."""
    return [move for move in moves if not any(_is_same_move(move, other) for other in others)]


def _is_same_move(one: Segment, other: Segment) -> bool:
    return (
        _is_same(one.from_deg, other.from_deg, DEG_PER_TURN)
        and _is_same(one.to_deg, other.to_deg, DEG_PER_TURN)
        and _is_same(one.change_mm, other.change_mm)
        and one.law == other.law
    )


def _said(one: Segment | None, other: Segment | None) -> tuple[str, str]:
    """Return two moves that differ in words, with so many digits that it can be seen."""
    for digits in _DIGITS:
        before, after = (NONE if move is None else _words(move, digits) for move in (one, other))
        if before != after:
            return before, after
    if one and other and one.kind != other.kind:
        return f"{before}, {one.kind}", f"{after}, {other.kind}"
    return before, f"{after} (another law of this name)"


def _words(move: Segment, digits: int) -> str:
    start = move.from_deg % DEG_PER_TURN
    angles = f"{start:.{digits}g} to {start + move.angle_deg:.{digits}g} deg"
    return f"{angles}, {abs(move.change_mm):.{digits + 2}g} mm, {as_law(move.law).name}"


def _whole(motion: Motion | None) -> str:
    """Return in words a motion that one of the versions lacks."""
    if motion is None:
        return NONE
    return plural(len(motion.moves) or "no", "move")


def pairs(
    before: TimingDiagram, after: TimingDiagram
) -> Iterator[tuple[str, Motion | None, Motion | None]]:
    """Yield each name with its motion in both versions, which may spell it in another case."""
    left = {motion.name: motion for motion in after.motions}
    for motion in before.motions:
        alike = [
            name
            for name in left
            if name.casefold() == motion.name.casefold() and name not in before.names
        ]
        name = motion.name if motion.name in left else alike[0] if len(alike) == 1 else ""
        yield motion.name, motion, left.pop(name, None)
    yield from ((name, None, motion) for name, motion in left.items())


def _turned(old: tuple[Segment, ...], new: tuple[Segment, ...]) -> tuple[Segment, ...]:
    """Return the new moves in such an order that each stands beside the old one that it was."""
    if len(old) != len(new) or not new:
        return new
    orders = [new[n:] + new[:n] for n in range(len(new))]
    return min(orders, key=lambda order: sum(map(_apart, old, order)))


def _apart(one: Segment, other: Segment) -> float:
    """Return how far the middles of two moves are from each other in deg, and if they are alike."""
    way = (one.from_deg + one.to_deg - other.from_deg - other.to_deg) / 2
    half = DEG_PER_TURN / 2
    return abs((way + half) % DEG_PER_TURN - half) + (one.kind != other.kind) * DEG_PER_TURN
