"""Still arcs: over which cam angles a motion has to stand where it does."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from cammotion.arguments.by_name import as_given, by_name
from cammotion.machine.arcs import Arc, intersect, unwrap
from cammotion.machine.arcs import arcs as as_set
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN, into_turn
from cammotion.machine.motions import Motion
from cammotion.machine.segments import CAM_ANGLE, Segment, arcs_of
from cammotion.quantities import Floats, InputError, listed, shorten
from cammotion.rules.rule import ROUNDING_MM

_ARCS = "a list of pairs of cam angles, for example [(205, 305)]"


def arcs_by_name(diagram: TimingDiagram, still: Any) -> dict[str, tuple[Arc, ...]]:
    """Return the still arcs that are given by the names of motions, as pairs of floats in deg.

    Raises InputError for what is not given by names, and for an arc over which its motion moves.
    """
    example = "still={'die': [(205, 305)]}"
    given = by_name("still arcs", still, diagram.names, as_given, example)
    found = {name: tuple(still_arcs(diagram[name], arcs)) for name, arcs in given.items()}
    for name, arcs in found.items():
        check_stands(diagram[name], arcs)
    return found


def still_arcs(motion: Motion, still: Any) -> list[Arc]:
    """Return the still arcs as pairs of floats in deg.

    Raises InputError for what is no list of them, and for one that is not longer than nothing and
    shorter than a turn.
    """
    given = [*listed(still)]
    if not given:
        raise InputError(
            f"The arcs over which the {motion.name} has to stand are {shorten(still)}: give at "
            "least one, for example still=[(205, 305)]."
        )
    pairs = [pair_of(arc, "A still arc", _ARCS) for arc in given]
    arcs = [(CAM_ANGLE.number(start), CAM_ANGLE.number(end)) for start, end in pairs]
    for start, end in arcs:
        if end - start >= DEG_PER_TURN and not motion.moves:
            raise InputError(
                f"The {motion.name} never moves, and its still arc goes from {start:g} to {end:g} "
                "deg: leave that out, or give one within a turn if it may move elsewhere."
            )
        if not start < end < start + DEG_PER_TURN:
            over = f", or from {start:g} to {end + DEG_PER_TURN:g} deg over the end of the turn"
            raise InputError(
                f"The still arc goes from {start:g} to {end:g} deg; it has to end after it begins "
                "and within a turn: let it go, for example, from 205 to 305 deg"
                f"{over if end < start < end + DEG_PER_TURN else ''}."
            )
    return arcs


def check_stands(motion: Motion, still: Sequence[Arc]) -> None:
    """Raise InputError for a still arc over which the motion moves."""
    moves = arcs_of(motion.moves)
    for start, end in still:
        for first, last in unwrap(intersect(as_set([(start, end)]), moves)):
            raise InputError(
                f"In the still arc from {start:g} to {end:g} deg the {motion.name} moves, from "
                f"{first:g} to {last:g} deg; a still arc is one over which it stands: give one of "
                "its dwells."
            )


def check_begins_at_a_stop(motion: Motion, still: Sequence[Arc]) -> None:
    """Raise InputError for an arc over which a motion moves, or if all are off an index's stops."""
    check_stands(motion, still)
    off = [abs(float(motion.offset_mm((start + end) / 2))) for start, end in still]
    if motion.is_indexing and min(off) > ROUNDING_MM:
        raise InputError(
            f"In its still arcs the indexing motion {motion.name!r} stands at none of its stops: "
            "give one over which it stands at one."
        )


def pair_of(given: Any, what: str, fix: str) -> tuple[float, float]:
    """Return the two of a pair; raise InputError for what is none."""
    try:
        first, second = given
    except (TypeError, ValueError):
        raise InputError(f"{what} is {shorten(given)}: give {fix}.") from None
    return first, second


def at_rest(motion: Motion, places_mm: Floats) -> Motion | None:
    """Return the motion that stands all of the turn; None for one that has to move.

    `places_mm` are the positions at which it has to stand.
    """
    if motion.pitch_mm or np.ptp(places_mm) > ROUNDING_MM:
        return None
    at, start = float(places_mm[0]), motion.start_deg
    end = start + DEG_PER_TURN
    return Motion(motion.name, (Segment(from_deg=start, to_deg=end, from_mm=at, to_mm=at),))


def unrolled_mm(motion: Motion, angles_deg: ArrayLike) -> Floats:
    """Return the positions at angles, without the leap back when a turret has closed."""
    turns, phase = into_turn(np.asarray(angles_deg), motion.start_deg)
    return np.asarray(motion.position_mm(phase) + motion.pitch_mm * turns)
