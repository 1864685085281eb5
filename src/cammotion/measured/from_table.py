"""The motion of a mechanism whose cam is given by a table over the whole turn.

Where the positions stay the motion dwells. What lies between two dwells is one cubic spline, and a
cam without a dwell is one that goes on over the end of the turn; it is cut where it turns, each
part being a rise or a return with a law from its points.
"""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise
from typing import Literal

import numpy as np

from cammotion.arguments import checked, warn
from cammotion.laws.spline import Spline
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.measured.cam_table import CamTable
from cammotion.measured.fits import Periodic
from cammotion.measured.from_points import FEWEST, MUCH, NARROW, law_from_points
from cammotion.measured.resting import Stay, eased
from cammotion.measured.smoothing import SmoothedTable
from cammotion.quantities import Floats, InputError, Quantity

_DWELL = Quantity("shortest dwell", "deg", example=10, high=360.0)
_SWING = 1e-5  # of the travel: what turns back by less is the spline's, or rounding
_STEPS = 1.5  # of the table, within which the positions of a dwell lie
_NEAR_DEG = 5e-3  # a turn so near to a point is there, or the last bit of both shows in A
_ROUNDS = 40  # of moving points to turns beside them; two are enough for a smooth table
_SETTLED_DEG = 1e-11
_MOST = 24  # moves of a turn
_NOISE = 6  # times the error of a smoothed table, within which it dwells


@checked
def motion_from_table(
    name: str, table: CamTable | SmoothedTable, *, least_dwell_deg: float = 10
) -> Motion:
    """Return the motion of a cam that is given by a table of one whole turn, or a smoothed one.

    It goes through the points, with a velocity and an acceleration that do not jump where it turns;
    a point within 0.005 deg of a turn is taken for the turn. Where the positions of three points or
    more stay the same over `least_dwell_deg`, to one and a half of the table's step, it dwells, and
    rests at both ends. Of a table that `smoothed` returned, it dwells where the positions stay the
    same to six times its error, and goes over to that over ten degrees at most. Its moves have laws
    from points, so that it is checked, drawn and written like any motion; the `rounding` of such a
    law is too large where the table turns close beside a point, as it takes both for readings. What
    the table's rounding does is reckoned from all of it, and warned of above a fifth of the peak.
    Raises InputError for a table that is no cycle, that stays where it is, or that turns back too
    often, as one of measured noise does.

    >>> angles = np.arange(0.0, 360.0, 5)
    >>> table = CamTable(angles, 25 - 25 * np.cos(np.radians(angles)), is_cycle=True)
    >>> cam = motion_from_table("cam", table)
    >>> [f"{move.kind} {move.angle_deg:.2f}" for move in cam.segments]
    ['rise 180.00', 'return 180.00']
    >>> print(f"{cam.position_mm(92.5):.4f} mm")
    26.0905 mm
    """
    shortest, noise = _DWELL.number(least_dwell_deg), 0.0
    if isinstance(table, SmoothedTable):
        noise, table = _NOISE * table.error_mm, table.as_table
    if not table.is_cycle:
        raise InputError(_no_cycle(table))
    travel = float(np.ptp(table.position_mm))
    swing = max(table.step_mm, noise, _SWING * travel)
    within = max(_STEPS * table.step_mm, noise, 1e-9 * travel)
    if travel <= within:
        raise InputError(
            f"The table goes over {travel:g} mm, which is no more than {within:.3g} mm of rounding "
            "or noise, and so stays where it is: make a motion of a dwell of 360 deg."
        )
    stays = _dwells(table, within, swing, shortest)
    if noise:
        table, stays = eased(table, stays)
    moves = _with_dwells(table, stays, swing) if stays else _without_dwells(table, swing)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # of each law; said of the table once, below
        found = Motion(name, _from_lowest(list(moves)))
    _warn(found, table)
    return found.shifted(-(found.start_deg // DEG_PER_TURN) * DEG_PER_TURN)


def _no_cycle(table: CamTable) -> str:
    """Say what becomes of a table of a part of the turn, or of a turret's, which goes on."""
    way = float(table.position_mm[-1] - table.position_mm[0])
    kind, over = "rise" if way > 0 else "return_", float(np.ptp(table.angle_deg))
    return (
        "The table is no whole turn, and a motion fills one: give CamTable(..., is_cycle=True), "
        "mirror a table of its rise with table.mirrored(), or make a move of it, "
        f"{kind}({abs(way):g}, over_deg={over:g}, law=law_from_table(table)), that of a turret for "
        "indexing_motion."
    )


def _dwells(table: CamTable, within_mm: float, alike_mm: float, shortest: float) -> list[Stay]:
    """Return the first and the last point of each dwell, the last one after it, and its height.

    Points count on over the end of the turn.
    """
    size = table.angle_deg.size
    angles, heights = _twice(table)
    found: list[Stay] = []
    n = int(np.argmax(np.abs(np.diff(heights[: size + 1])))) + 1  # where it surely moves
    end = n + size
    while n < end:
        last = n
        while last + 1 < end and np.ptp(heights[n : last + 2]) <= within_mm:
            last += 1
        if angles[last] - angles[n] >= shortest and last - n > 1:  # two may lie beside a turn
            middle = float(np.median(heights[n : last + 1]))
            known = (stay for _, _, stay in found if abs(stay - middle) <= max(within_mm, alike_mm))
            height, first = next(known, middle), n
            if found and found[-1][1] == n - 1 and found[-1][2] == height:  # it goes on
                first, _, _ = found.pop()
            found.append((first, last, height))
            n = last
        n += 1
    return found


def _with_dwells(table: CamTable, stays: Sequence[Stay], swing: float) -> Iterator[Segment]:
    """Yield each dwell and the moves to the next one."""
    size = table.angle_deg.size
    angles, heights = _twice(table)
    first, _, height = stays[0]
    following = [*stays[1:], (first + size, 0, height)]
    for (start, last, stay), (then, _, there) in zip(stays, following, strict=True):
        yield _stay(angles[start], angles[last], stay)
        turns, which = np.divmod(np.arange(last, then + 1), size)
        places = angles[which] + DEG_PER_TURN * turns
        values = np.array([stay, *heights[which[1:-1]], there])
        spline = _settled(places, values, _near(table), "clamped")
        moves = list(_moves(spline, table, swing))
        yield from moves or [_stay(places[0], places[-1], stay)]


def _without_dwells(table: CamTable, swing: float) -> Iterator[Segment]:
    """Yield the moves of a cam that never stays, from its lowest point on."""
    size = table.angle_deg.size
    angles, heights = _twice(table)
    first = int(np.argmax(np.abs(np.diff(heights[: size + 1]))))  # where it turns is not here
    turn = slice(first, first + size + 1)
    near = _near(table)
    spline = _settled(angles[turn], heights[turn], near, "periodic")
    low = min(spline.turns, key=spline.at)
    knots = np.concatenate([spline.knots, spline.knots[1:] + DEG_PER_TURN])
    inside = knots[(knots > low + near) & (knots < low + DEG_PER_TURN - near)]
    places = np.array([low, *inside, low + DEG_PER_TURN])
    values = spline.over(np.where(places > spline.high, places - DEG_PER_TURN, places))
    values[-1] = values[0]
    yield from _moves(_through(places, values, "clamped"), table, swing)


def _settled(
    places: Floats, values: Floats, near: float, ends: Literal["clamped", "periodic"]
) -> Spline:
    """Return a spline that turns at a point, and not right beside it.

    A point beside which it turns is moved there along the spline. Left out of the laws on both
    sides, it would be missed by their accelerations, which then were not the same at the turn.
    """
    moved, heights, apart = places.copy(), values.copy(), np.diff(places).min()
    spline = _through(moved, heights, ends)
    for _ in range(_ROUNDS):
        turns = np.array(spline.turns)
        after = np.searchsorted(moved, turns)
        point = after - (turns - moved[after - 1] < moved[after] - turns)
        point = np.clip(point, 1, len(places) - 2)  # both ends stay
        off = np.abs(turns - moved[point])
        beside = (off > _SETTLED_DEG) & (off < near)
        beside &= np.abs(turns - places[point]) < apart / 3  # or it could pass its neighbour
        if not beside.any():
            break
        moved[point[beside]] = turns[beside]
        heights[point[beside]] = spline.over(turns[beside])
        spline = _through(moved, heights, ends)
    return spline


def _near(table: CamTable) -> float:
    angles, _ = _twice(table)
    return min(_NEAR_DEG, float(np.diff(angles).min()) / 4)


def _through(places: Floats, values: Floats, ends: Literal["clamped", "periodic"]) -> Spline:
    """Return the spline through points, at rest at both ends, or going on over the end."""
    from scipy.interpolate import CubicSpline  # it takes a second to load

    return Spline(places, np.array(CubicSpline(places, values, bc_type=ends).c))


def _moves(spline: Spline, table: CamTable, swing: float) -> Iterator[Segment]:
    """Yield the rises and returns of a spline between two rests, each with a law of its points."""
    places, near = spline.knots, _near(table)
    ends = _turns(spline.corners, swing)
    if len(ends) > _MOST:
        raise InputError(
            f"The table turns back {len(ends) - 2} times by more than {swing:.3g} mm, as one of "
            "measured noise does: give what smoothed returns for it, with a larger amount if that "
            "is no help, or a CamTable with its step_mm."
        )
    for (low, start), (high, end) in pairwise(ends):
        at = np.array([low, *places[(places > low + near) & (places < high - near)], high])
        _check_apart(at)
        while at.size < FEWEST:  # further points on the same spline
            widest = int(np.argmax(np.diff(at)))
            at = np.insert(at, widest + 1, (at[widest] + at[widest + 1]) / 2)
        x, s = (at - low) / (high - low), (spline.over(at) - start) / (end - start)
        s[0], x[-1], s[-1] = 0.0, 1.0, 1.0
        step = table.step_mm / abs(end - start)
        name = f"table, {low % DEG_PER_TURN:.6g} deg"
        law = law_from_points(x, s, name=name, step=min(step, 1), rounded_ends=True)
        yield Segment(from_deg=low, to_deg=high, from_mm=start, to_mm=end, law=law)


def _check_apart(at: Floats) -> None:
    """Raise InputError for two points of a move that a law cannot tell from each other."""
    n = int(np.argmin(np.diff(at)))
    if at[n + 1] - at[n] < NARROW * (at[-1] - at[0]):
        one, other = (f"{place % DEG_PER_TURN:.9g}" for place in at[n : n + 2])
        raise InputError(
            f"The table has points at {one} and {other} deg, closer to each other than a millionth "
            f"of their move of {at[-1] - at[0]:.3g} deg: leave one of them out."
        )


def _from_lowest(segments: list[Segment]) -> tuple[Segment, ...]:
    """Return the segments from the rise on that begins lowest, after a dwell if there is one."""
    rises = [n for n, segment in enumerate(segments) if segment.kind == "rise"]
    near = _SWING * max(abs(segment.change_mm) for segment in segments)
    lowest = min(segments[n].from_mm for n in rises) + near
    low = [n for n in rises if segments[n].from_mm <= lowest]
    first = min(low, key=lambda n: segments[n - 1].kind != "dwell")
    later = (
        replace(s, from_deg=s.from_deg + DEG_PER_TURN, to_deg=s.to_deg + DEG_PER_TURN)
        for s in segments[:first]
    )
    return (*segments[first:], *later)


def _turns(corners: Sequence[tuple[float, float]], swing: float) -> list[tuple[float, float]]:
    """Return both ends and the corners between them at which it turns back by more than `swing`.

    No move between two of them goes over less than that, and none goes beyond its ends by more. Of
    what goes nowhere only the start is left.
    """
    kept = [corners[0]]
    for place, height in corners[1:]:
        goes_on = len(kept) > 1 and (height - kept[-1][1]) * (kept[-1][1] - kept[-2][1]) > 0
        if goes_on:
            kept[-1] = place, height
        elif abs(height - kept[-1][1]) > swing:
            kept.append((place, height))
    while len(kept) > 1 and abs(corners[-1][1] - kept[-2][1]) <= swing:
        kept.pop()  # it turned back by more, but the end lies less apart
    return [*kept[:-1], corners[-1]] if len(kept) > 1 else kept


def _warn(motion: Motion, table: CamTable) -> None:
    """Say it where the rounding of the positions may be much of what the acceleration is.

    All positions lie on one spline. That of a single move would take its own turn for exact, or for
    another reading, and what lies beside it for free to be off by itself.
    """
    since = np.append(table.angle_deg - table.angle_deg[0], DEG_PER_TURN) / DEG_PER_TURN
    bound, _ = Periodic(since, 0.0).effects(since, table.step_mm / 2, False)  # by the turn
    angles = table.angle_deg[:, None]
    moves = np.array([(move.from_deg, move.angle_deg) for move in motion.moves])
    is_moving = np.any(np.mod(angles - moves[:, 0], DEG_PER_TURN) <= moves[:, 1], axis=1)
    share = bound[:-1][is_moving].max(initial=0.0) / DEG_PER_TURN**2 / motion.peak(2)
    if share > MUCH:
        much = f"up to {share:.0%}" if share < 1 else "more than all"
        warn(
            f"The positions of the table are rounded to {table.step_mm:g} mm. That alone may "
            f"change the acceleration of {motion.name} by {much} of its peak: take positions with "
            "more digits, or what smoothed returns for the table."
        )


def _stay(start: float, end: float, height: float) -> Segment:
    return Segment(from_deg=float(start), to_deg=float(end), from_mm=height, to_mm=height)


def _twice(table: CamTable) -> tuple[Floats, Floats]:
    """Return the angles and positions of two turns."""
    angles, heights = table.angle_deg, table.position_mm
    return np.concatenate([angles, angles + DEG_PER_TURN]), np.concatenate([heights, heights])
