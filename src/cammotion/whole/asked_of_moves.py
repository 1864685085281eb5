"""What is asked of the moves of parts, laws and ranges, read from what a user gives."""

import math
from collections.abc import Sequence
from typing import Any

from cammotion.arguments.by_name import as_given, by_name
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.limits.frame import rests_at
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import InputError, shorten
from cammotion.whole.asked_of_all import FREE, Task
from cammotion.whole.free_moves import NARROWEST_DEG

Laws = Sequence[str | MotionLaw]
Range = tuple[float, float]
Ranges = Sequence[Range | None]


def read_laws(task: Task, given: Any) -> list[list[list[MotionLaw]]]:
    """Return for each part and each of its moves the laws to choose from."""
    names = list(task.weights)
    chosen = by_name(
        "laws", given, names, as_given, "{'mill': ['cycloidal']}", of=FREE, one_for_all=True
    )
    found = []
    for part in task.parts:
        listed = chosen.get(part.motion.name)
        own = None if listed is None else [as_law(law) for law in listed]
        if own == []:
            raise InputError(f"The list of laws for the {part.motion.name} is empty: give one.")
        found.append([own or [as_law(move.law)] for move in part.motion.moves])
    for law in {law for part in found for move in part for law in move}:
        if not (rests_at(law, 0) and rests_at(law, 1)):
            raise InputError(
                f"The law {law.name!r} does not rest at both its ends, and only moves from rest to "
                "rest can be placed at will: give another one."
            )
        if not math.isfinite(law.Ca):
            raise InputError(
                f"The velocity of the law {law.name!r} jumps, so that its peak acceleration is "
                "infinite at any angle: give another one."
            )
    return found


def read_starts(task: Task, given: Any) -> dict[str, list[Range | None]]:
    """Return for each part the range of the start of each of its moves, or None."""
    return _read_ranges(task, "start", given)


def read_angles(task: Task, given: Any) -> dict[str, list[Range | None]]:
    """Return for each part the range of the indexing angle of each of its moves, or None.

    Raises InputError for one in which there is no angle that a move can have.
    """
    found, most = _read_ranges(task, "indexing angle", given), float(DEG_PER_TURN)
    for name, ranges in found.items():
        for low, high in filter(None, ranges):
            if low > most or high < NARROWEST_DEG:
                raise InputError(
                    f"The indexing angle of a move of the {name} would be from {low:g} to {high:g} "
                    f"deg; it can be from {NARROWEST_DEG:g} to {most:g} deg: give a range within "
                    "these, or None for any."
                )
        found[name] = [one and (one[0], min(one[1], most)) for one in ranges]
    return found


def _read_ranges(task: Task, what: str, given: Any) -> dict[str, list[Range | None]]:
    example = "{'mill': [(150, 160)]}"
    listed = by_name(
        f"ranges of each {what}", given, list(task.weights), as_given, example, of=FREE
    )
    return {
        part.motion.name: _ranges_of(part.motion, what, listed.get(part.motion.name))
        for part in task.parts
    }


def _ranges_of(motion: Motion, what: str, given: Any) -> list[Range | None]:
    count = len(motion.moves)
    if given is None:
        return [None] * count
    try:
        ranges = [None if one is None else (float(one[0]), float(one[1])) for one in given]
        fits = len(ranges) == count and all(one is None or one[0] <= one[1] for one in ranges)
    except (TypeError, ValueError, IndexError, KeyError):
        fits = False
    if not fits:
        raise InputError(
            f"The ranges of each {what} of the {motion.name} are {shorten(given)}: it has {count} "
            "moves, so give as many pairs in deg, the smaller one first, or None for any."
        )
    return ranges
