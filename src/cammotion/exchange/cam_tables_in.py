"""Tables of a cam as people have them: files of two or three columns, from any program."""

from pathlib import Path
from typing import Any

import numpy as np

from cammotion.arguments import checked
from cammotion.exchange.cam_table_columns import columns_of
from cammotion.exchange.cam_table_cut import DECIMALS, SEPARATORS, Asked, Columns
from cammotion.exchange.cam_table_meaning import (
    check_not_counted,
    check_order,
    evened,
    lift_of,
    master_of,
    shape_of,
)
from cammotion.exchange.cam_table_text import read_text
from cammotion.exchange.table_numbers import ANGLE_DECIMALS
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.measured.cam_table import CamTable
from cammotion.quantities import Floats, InputError, Quantity, one_of, shorten

_FEWEST = 8
_COLUMN = Quantity("number of a column", "", example=1)


@checked
def read_cam_table(  # noqa: PLR0913 - what can be set of a file
    path: str | Path,
    *,
    first: str | None = None,
    position: str | float | None = None,
    cycle: float | None = None,
    is_cycle: bool | None = None,
    uneven: bool = False,
    columns: tuple[int, int] | None = None,
    separator: str | None = None,
    decimal: str | None = None,
    encoding: str | None = None,
) -> CamTable:
    r"""Return the table of a cam that a file of two or three columns holds, from any program.

    The file is text: cells between tabs, semicolons, bars, commas or spaces, with decimal points or
    commas, in UTF-8, UTF-16 or cp1252, with headings and comments (#, //, %, !) or without. `said`
    of the table is the sentence on what it was taken for. Each of it can be set:

    `first` is what the first column is: 'deg', 'rad', 'turn' (from 0 to 1), 'percent', 'time' or
    'distance'. `position` is the unit of the second: 'mm', 'cm', 'm', 'um', 'in', or how many mm a
    unit is. `cycle` is a whole turn of the cam in units of the first column: 360 deg, say, or 720
    of a crank, and of a time or a distance the last one, if nothing is said. `is_cycle` says
    whether the table is a whole closed turn, and `uneven` that its angles may be unevenly spaced.
    `columns` are the numbers of both columns, counted from 1, `separator`, `decimal` and `encoding`
    the marks and the code of the file.

    Raises InputError, with the line, for what is broken, doubled, unsorted, missing or uneven, for
    a turn that does not close, for fewer than 8 rows, and for what can be read in two ways.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     path = Path(folder, "valve.csv")
    ...     rows = [f"{n};{n * (360 - n) / 648:.2f}\n".replace(".", ",") for n in range(0, 361, 5)]
    ...     _ = path.write_text("Winkel;Hub\n" + "".join(rows), "utf-8")
    ...     table = read_cam_table(path)
    >>> table
    CamTable(72 points every 5 deg, a whole turn, 0 to 50 mm in steps of 0.01)
    >>> print(table.said[table.said.index("text:") :])
    text: column 1 is the cam angle in deg (from its range), ...
    """
    if separator is not None:
        one_of("separator", separator, SEPARATORS)
    if decimal is not None:
        one_of("decimal mark", decimal, DECIMALS)
    asked = Asked(separator, decimal, _columns(columns))
    text = read_text(path, encoding)
    found = columns_of(text, asked)
    if len(found.rows) < _FEWEST:
        raise InputError(
            f"The table of {text.name} has {len(found.rows)} rows, from line {found.rows[0].line} "
            f"on; at least {_FEWEST} are needed: measure or print the cam at more angles."
        )
    if not asked.columns:
        check_not_counted(found)
    check_order(found)
    master = master_of(found, first, cycle)
    angles, is_even = found.numbers[:, 0], True
    try:
        angles = evened(found, master)
    except InputError:
        if not uneven:
            raise
        is_even = False
    lift = lift_of(found, position)
    shape = shape_of(found, master, is_cycle, is_even=is_even)
    kept = slice(None, -1 if shape.is_repeated else None)
    return CamTable(
        _tidy(angles[kept] * (DEG_PER_TURN / master.turn)),
        found.numbers[kept, 1] * lift.scale,
        step_mm=lift.step * lift.scale,
        is_cycle=shape.is_cycle,
        said=_said(found, text.encoding, (master.said, lift.said, shape.said)),
    )


def _columns(given: Any) -> tuple[int, int] | None:
    if given is None:
        return None
    try:
        first, second = map(_COLUMN.whole, given)
    except InputError:
        first = second = 0
    if first == second:
        raise InputError(
            f"The columns are {shorten(given)}: give the numbers of two columns, counted from 1, "
            "for example (1, 3)."
        )
    return first - 1, second - 1


def _tidy(angles: Floats) -> Floats:
    """Return angles without the last digits that a change of unit brings."""
    return np.round(angles, ANGLE_DECIMALS) + 0.0


def _said(found: Columns, encoding: str, parts: tuple[str, str, str]) -> str:
    place, other = (f"column {n + 1}" for n in found.chosen)
    master, lift, shape = parts
    unused = [
        f"column {n + 1}" + (f" ({heading.words})" if heading.words else "")
        for n, heading in enumerate(found.headings)
        if n not in found.chosen
    ]
    left = f"; not used: {', '.join(unused)}" if unused else ""
    between = SEPARATORS.get(found.separator, repr(found.separator))
    return (
        f"{found.name} has {len(found.rows)} rows from line {found.rows[0].line} to "
        f"{found.rows[-1].line}, cells between {between}, "
        f"{DECIMALS[found.decimal]} and {encoding} text: {place} is {master}, {other} is "
        f"{lift}, and together they are {shape}{left}."
    )
