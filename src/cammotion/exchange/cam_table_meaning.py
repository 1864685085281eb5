"""What two columns are: the first the way of the master, the second that of the follower.

What is set is taken, else what the heading says, else what the range of the numbers tells beyond
doubt. The rest is a question.
"""

import math
from dataclasses import dataclass
from typing import NoReturn

import numpy as np

from cammotion.exchange.cam_table_cut import Columns
from cammotion.exchange.cam_table_headings import DISTANCE, LENGTHS, TIME, is_rate, odd_unit
from cammotion.exchange.table_numbers import step_of
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import Floats, InputError, Quantity, one_of, shorten

CYCLE = Quantity("cycle, in units of the first column,", "", example=360, high=1e9)
SCALE = Quantity("unit of a position", "mm", example=0.001, high=1e6)
TURNS = {"deg": 360.0, "rad": 2 * math.pi, "turn": 1.0, "percent": 100.0}
WORDS = {
    "deg": "the cam angle in deg",
    "rad": "the cam angle in rad",
    "turn": "the cam angle in parts of a turn",
    "percent": "the cam angle in percent of a turn",
    TIME: "the time",
    DISTANCE: "the way of the master",
}

_SEEN = ("deg", "rad", "turn")  # what a range tells; nobody writes percent without saying so
_CONTRARY = {("deg", "rad"), ("deg", "turn"), ("rad", "deg"), ("turn", "deg"), ("turn", "rad")}
_RISE, _RETURN = "a rise", "a return"
_HALF, _BOTH = 0.51, 1.01  # of the rounding: of one number, and of two
_QUARTER = 0.25  # of the step of the angles: a row too few or too many is more than that off
_CLOSED = 1e-6  # of the stroke: so much is missing at the end for a program's own rounding
_ALIKE = 1e-9  # of a turn: steps that differ by less are alike
_COUNTED = 0.05  # of a step: a column that rises so evenly is counted, not measured
_MOST_MM = 1e6


@dataclass(frozen=True)
class Master:
    """The first column: what it is, a turn of the cam in its units, its rounding, and its words.

    `closes` says that it ends a turn after it began, `is_open` that it ends one even step before.
    """

    kind: str
    turn: float
    rounding: float
    closes: bool
    is_open: bool
    said: str


@dataclass(frozen=True)
class Lift:
    """The second column: how many mm its unit is, its rounding in that unit, and its words."""

    scale: float
    step: float
    said: str


@dataclass(frozen=True)
class Shape:
    """What of a turn the table is; `is_repeated` if its last row is the first, a turn later."""

    is_cycle: bool
    is_repeated: bool
    said: str


def check_order(found: Columns) -> None:
    """Raise InputError unless the first column rises from row to row."""
    values, cells = found.numbers[:, 0], found.cells(0)
    wrong = np.flatnonzero(np.diff(values) <= 0)
    if not wrong.size:
        return
    n = int(wrong[0]) + 1
    if values[n] == values[n - 1]:
        raise InputError(
            f"{found.where(n)} has {cells[n]} in the first column, as line "
            f"{found.rows[n - 1].line} has: give each place once."
        )
    raise InputError(
        f"{found.where(n)} has {cells[n]} in the first column after {cells[n - 1]}: sort the rows, "
        "so that it rises from row to row."
    )


def check_not_counted(found: Columns) -> None:
    """Raise InputError where both columns rise evenly, and a third may be the position."""
    if found.rows[0].width < 3:  # noqa: PLR2004 - a third
        return
    steps = np.diff(found.numbers, axis=0)
    if (steps > 0).all() and (np.ptp(steps, axis=0) <= _COUNTED * steps.mean(axis=0)).all():
        one, other = (place + 1 for place in found.chosen)
        raise InputError(
            f"Columns {one} and {other} of {found.name} both rise in even steps, as numbers of "
            f"rows, angles and times do: give the two that you mean, for example columns=(2, 3), "
            f"or columns=({one}, {other}) if the position does so."
        )


def master_of(found: Columns, first: str | None, cycle: float | None) -> Master:
    """Return what the first column is; raise InputError where nothing says so."""
    values, rounding = found.numbers[:, 0], step_of(found.cells(0), found.decimal)
    kind, why = _kind(found, rounding, first, cycle)
    turn = _turn(found, kind, cycle)
    closes, is_open = _ends(values, rounding, turn)
    said = f"{WORDS[kind]} ({why})"
    if cycle is not None or kind not in TURNS:
        said += f", {turn:.6g} of it a turn"
    return Master(kind, turn, rounding, closes, is_open, said)


def _kind(
    found: Columns, rounding: float, first: str | None, cycle: float | None
) -> tuple[str, str]:
    """Return what the first column is, and who says so."""
    if first is not None:
        return one_of("kind of a first column", first, WORDS), "as set"
    values = found.numbers[:, 0]
    seen = next((unit for unit in _SEEN if any(_ends(values, rounding, TURNS[unit]))), "")
    named = _named(found)
    ends = f"goes from {found.cells(0)[0]} to {found.cells(0)[-1]}"
    if not named and not seen:
        raise InputError(
            f"The first column of {found.name} {ends}, and nothing says in what: give first='deg', "
            "'rad', 'turn' (parts of a turn), 'percent', 'time' or 'distance'."
        )
    if cycle is None and (named, seen) in _CONTRARY:
        raise InputError(
            f"The heading of {found.name} says that the first column is in {named}, and it {ends}, "
            f"as if it were in {seen}: give first={named!r} or first={seen!r}."
        )
    return (named, "from the heading") if named else (seen, "from its range")


def _named(found: Columns) -> str:
    """Return what the first column is as its heading says, or ''."""
    heading = found.headings[found.chosen[0]]
    if heading.unit in TURNS:
        return heading.unit
    if heading.unit in LENGTHS or heading.kind == DISTANCE:
        return DISTANCE
    return TIME if heading.kind == TIME else ""


def _turn(found: Columns, kind: str, cycle: float | None) -> float:
    if cycle is not None:
        return CYCLE.number(cycle)
    if kind in TURNS:
        return TURNS[kind]
    start, end = (float(value) for value in found.numbers[[0, -1], 0])
    if start:
        raise InputError(
            f"{found.where(0)}: {WORDS[kind]} begins at {start:g} and not at 0, so that its last "
            f"value, {end:g}, need not be a whole cycle: give cycle, in its unit."
        )
    return end


def _ends(values: Floats, rounding: float, turn: float) -> tuple[bool, bool]:
    """Return whether a column ends a turn after it began, and whether one even step before."""
    span, steps = float(values[-1] - values[0]), len(values) - 1
    near = min(_HALF * rounding, _QUARTER * span / steps) + _ALIKE * turn
    return abs(span - turn) <= near, abs(span - turn * steps / (steps + 1)) <= near


def evened(found: Columns, master: Master) -> Floats:
    """Return the first column as it was before it was rounded; raise InputError if it is uneven."""
    values, steps = found.numbers[:, 0], len(found.rows) - 1
    span = float(values[-1] - values[0])
    if master.closes or master.is_open:
        span = master.turn if master.closes else master.turn * steps / (steps + 1)
    even: Floats = values[0] + span * np.arange(steps + 1) / steps
    between = np.diff(values)
    usual = float(np.median(between))
    near = _ALIKE * master.turn
    is_exact = abs(usual * steps - span) <= near and np.mean(abs(between - usual) <= near) >= _HALF
    if not is_exact:
        near += min(_BOTH * master.rounding, _QUARTER * usual)
    if np.abs(values - even).max() <= near:
        return even
    n = int(np.argmax(np.abs(between - usual) > near)) + 1
    if abs(between[n - 1] - usual) <= near:  # the steps creep
        n = max(int(np.abs(values - even).argmax()), 1)
    count = round(float(between[n - 1]) / usual)
    is_missing = count > 1 and abs(between[n - 1] - count * usual) <= near
    what = "a row is missing before it" if is_missing else "the steps are uneven"
    cells = found.cells(0)
    raise InputError(
        f"{found.where(n)}: the first column goes from {cells[n - 1]} to {cells[n]}, and elsewhere "
        f"in steps of {usual:.6g}: {what}. Correct it, or give uneven=True if it is meant."
    )


def lift_of(found: Columns, position: str | float | None) -> Lift:
    """Return what the second column is; raise InputError if it is an angle."""
    heading = found.headings[found.chosen[1]]
    unit = heading.unit
    step, scale, why = step_of(found.cells(1), found.decimal), 1.0, "as set"
    if isinstance(position, str):
        unit = one_of("unit of a position", position, LENGTHS)
    elif position is not None:
        scale = SCALE.number(position)
        unit = f"units of {scale:g} mm"
    elif odd := odd_unit(heading):
        raise InputError(
            f"The heading of {found.name} says that the second column is in {shorten(odd)}: give "
            "the mm of one as position, for example position=0.01, or a unit, position='mm'."
        )
    elif is_rate(heading):
        raise InputError(
            f"The heading of {found.name} says that the second column is "
            f"{shorten(heading.words)}, which is no length: give the column of the position, for "
            "example columns=(1, 3), or its unit, position='mm', if it is one."
        )
    elif unit in LENGTHS:
        why = "from the heading"
    elif unit in TURNS:
        raise InputError(
            f"The heading of {found.name} says that the second column is in {unit}: give the mm of "
            "one as position; for an arm that is its length in mm times the rad of one."
        )
    else:
        unit, why = "mm", "no unit is named"
    scale = LENGTHS.get(unit, scale)
    worst = int(np.abs(found.numbers[:, 1]).argmax())
    if abs(found.numbers[worst, 1]) * scale > _MOST_MM:
        raise InputError(
            f"{found.where(worst)}: the position is {found.cells(1)[worst]} in {unit}, and at most "
            "1 km makes sense: give its unit, for example position='um' or position=1e-4."
        )
    said = "inches" if unit == "in" else unit
    return Lift(scale, step, f"the position in {said} ({why}), printed to {step:g}")


def shape_of(found: Columns, master: Master, is_cycle: bool | None, *, is_even: bool) -> Shape:
    """Return what of a turn the table is; raise InputError for one that does not close."""
    values = found.numbers[:, 0]
    whole = master.closes or (master.is_open and is_even)
    ends = f"{found.where(-1)}: the first column goes from {values[0]:g} to {values[-1]:g}, and a "
    if values[-1] - values[0] > master.turn and not master.closes:
        raise InputError(f"{ends}turn is {master.turn:.6g}: give one turn, or another cycle.")
    if is_cycle and is_even and not whole:
        raise InputError(
            f"{ends}turn is {master.turn:.6g}: a whole turn was asked for. Give cycle or first."
        )
    gap, closes = _gap(found, master)
    way = _way(found.numbers[:, 1])
    if is_cycle is None:
        is_wrong = whole and not closes and way not in {_RISE, _RETURN}
    else:
        is_wrong = is_cycle and master.closes and not closes
    if is_wrong:
        _refuse_open(found, master, gap)
    if is_cycle is None:
        is_cycle = whole and closes
    if not is_cycle:
        first, last = values[[0, -1]] * DEG_PER_TURN / master.turn
        return Shape(False, False, f"{way} from {first:.6g} to {last:.6g} deg")
    how = "its last row repeats the first" if master.closes else "its last row comes a step before"
    if master.closes and gap:
        how += f" but for {gap:.2g}"
    return Shape(True, master.closes, f"a whole turn that closes ({how})")


def _gap(found: Columns, master: Master) -> tuple[float, bool]:
    """Return how far the end is from the beginning, and whether that closes a turn."""
    positions = found.numbers[:, 1]
    gap = abs(float(positions[-1] - positions[0]))
    near = 2 * _BOTH * step_of(found.cells(1), found.decimal) + _CLOSED * float(np.ptp(positions))
    if not master.closes:  # there is one step more
        near += 2 * float(np.abs(np.diff(positions)).max())
    return gap, gap <= near


def _refuse_open(found: Columns, master: Master, gap: float) -> NoReturn:
    """Raise InputError for a turn that does not close, with the ways out that fit its angles."""
    cells, values = found.cells(1), found.numbers[:, 0]
    ways = ["Correct it", "give is_cycle=False if it is not meant to close"]
    if master.closes and master.kind in TURNS:
        ways.insert(1, "take the last row out if it is the first one measured once more")
    elif master.closes:
        cycle = f"{values[-1] + values[1] - 2 * values[0]:.6g}"
        ways.append(f"cycle={cycle} if the last row comes a step before the end")
    where = "at its end" if master.closes else "a step before its end"
    raise InputError(
        f"{found.where(-1)}: the turn does not close, since the position is {cells[-1]} {where} "
        f"and {cells[0]} at its beginning, {gap:.4g} off. {', '.join(ways[:-1])}, or {ways[-1]}."
    )


def _way(positions: Floats) -> str:
    """Return how the follower goes over the table, in words."""
    steps = np.diff(positions)
    if not steps.any():
        return "a dwell"
    if (steps >= 0).all() or (steps <= 0).all():
        return _RISE if steps.max() > 0 else _RETURN
    is_back = abs(positions[-1] - positions[0]) <= _QUARTER * np.ptp(positions)
    return "up and down" if is_back else "a part of a turn"
