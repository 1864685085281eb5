"""Whether a motion that was found is what was asked for, by the curves and rules of its diagram.

Nothing here knows of grids and programs: the motion is looked at like any other.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from cammotion.limits.standing import unrolled_mm
from cammotion.machine.arcs import Arc, arcs, intersect
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import arcs_of
from cammotion.quantities import Floats
from cammotion.rules.checks import find_violations
from cammotion.rules.clearance import ClearanceRule

_MM = 1e-5  # by so much a motion may be off its place or beyond a limit
_DEG = 1e-6
_SHARE = 1e-6  # of a bound or a limit that may be rounding
_BESIDE_DEG = 1e-7  # so near to a joint is just before it and just after it
_STEPS = 7200  # of a turn, in which its curves are compared


class Asked(NamedTuple):
    """What is asked of a motion: `jerk_limit` is in m/s3, and infinite if there is none."""

    rules: Sequence[ClearanceRule]
    still: Sequence[Arc]
    travel_mm: tuple[float, float]
    jerk_limit: float


def find_faults(before: TimingDiagram, after: Motion, asked: Asked) -> Iterator[str]:
    """Yield in words what the motion `after` does not keep of what was asked of it.

    It takes the place of the motion of its name in the diagram `before`. It has to keep the rules
    that it has a part in; to stand over the still arcs where that one stands; to stay within its
    travel in the turn with which that one begins; and to change its velocity nowhere faster than
    by its peak acceleration, its acceleration nowhere faster than by the limit of its jerk.
    """
    old, design = before[after.name], before.with_motion(after)
    for rule in asked.rules:
        loose = _loosened(rule, after.name)
        yield from map(str, find_violations(design, loose) if loose else ())
    for start, end in asked.still:
        if not _stands(old, after, (start, end)):
            yield f"from {start:g} to {end:g} deg it does not stand where it has to"
    lowest, highest = _range_mm(after, old.start_deg)
    if lowest < asked.travel_mm[0] - _MM or highest > asked.travel_mm[1] + _MM:
        yield f"it goes from {lowest:g} to {highest:g} mm"
    peak = design.peak_acceleration(after.name)
    if _is_exceeded(design, after, 1, peak):
        yield f"it changes its velocity faster than by its peak acceleration of {peak:g} m/s²"
    if _is_exceeded(design, after, 2, asked.jerk_limit):
        yield f"it changes its acceleration faster than by {asked.jerk_limit:g} m/s³"


def _loosened(rule: ClearanceRule, name: str) -> ClearanceRule | None:
    """Return a rule with the limit of this motion farther off by a rounding; None without it."""
    if rule.when.motion == name:
        return replace(rule, when=rule.when.eased(-_MM))
    if rule.only_while.motion == name:
        return replace(rule, only_while=rule.only_while.eased(_MM))
    return None


def _stands(old: Motion, new: Motion, arc: Arc) -> bool:
    """Whether one motion stands over an arc, and where the other one does."""
    angles = np.linspace(*arc, 33)
    off = np.asarray(new.position_mm(angles) - old.position_mm(angles))
    if old.stops is not None:
        turret = old.pitch_mm * old.stops  # after which it is where it was
        off -= turret * np.round(off / turret)
    moves = intersect(arcs([arc]), arcs_of(new.moves))
    return bool(np.all(np.abs(off) < _MM)) and all(end - start < _DEG for start, end in moves)


def _range_mm(motion: Motion, start_deg: float) -> tuple[float, float]:
    """Return the least and the largest position in the turn that begins at an angle."""
    turning = np.array(motion.turning_degs)
    angles = start_deg + np.mod(turning - start_deg, DEG_PER_TURN)
    places = unrolled_mm(motion, np.array([start_deg, *angles]))
    return float(np.min(places)), float(np.max(places))


def _is_exceeded(design: TimingDiagram, motion: Motion, order: int, limit: float) -> bool:
    """Whether a derivative, in m and s, changes faster than by a limit, be it by a jump."""
    joints = np.array([segment.from_deg for segment in motion.segments])
    even = motion.start_deg + np.linspace(0, DEG_PER_TURN, _STEPS + 1)
    angles = np.sort(np.concatenate([even, joints - _BESIDE_DEG, joints + _BESIDE_DEG]))
    values: Floats = motion.derivative(order, angles, design.rate_per_hour)
    allowed = limit * np.diff(angles) * (design.cycle_time_s / DEG_PER_TURN)
    rounding = _SHARE * np.abs(values).max()
    return bool(np.any(np.abs(np.diff(values)) > (1 + _SHARE) * allowed + rounding))
