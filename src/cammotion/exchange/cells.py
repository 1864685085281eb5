"""The cells of a table: numbers with a decimal point or comma, and names that are no formulas."""

import csv
import io
import math
from collections.abc import Iterable

from cammotion.exchange.table_numbers import number_of
from cammotion.quantities import InputError

_QUOTE = "'"
_MOST_DEG = 3600  # ten turns; no machine counts more of them in a table
_ODD = ("=", "+", "-", "@", _QUOTE)  # a spreadsheet reckons with a cell that begins so


class Plain(str):
    """A cell whose decimal mark is a point, whatever other cells say: a number of a workbook."""

    __slots__ = ()

    def strip(self, chars: str | None = None, /) -> "Plain":
        """Return it without the blanks around it."""
        return Plain(super().strip(chars))


def cut_rows(file: str, text: str, separator: str) -> list[list[str]]:
    """Return the rows of a table, cut into cells, each in the place of its first line.

    A row that goes on over further lines, in quotes, has empty rows in theirs. `file` is the name
    to tell in the InputError for what cannot be cut.
    """
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    rows: list[list[str]] = []
    try:
        for row in reader:
            rows += [row, *([] for _ in range(len(rows) + 1, reader.line_num))]
    except csv.Error as wrong:
        raise InputError(
            f"Line {reader.line_num} of {file} cannot be cut into cells ({wrong}): look for a "
            "quotation mark too many."
        ) from None
    return rows


def rows_as_text(rows: Iterable[Iterable[object]]) -> str:
    """Return rows as the text of a file with commas between the cells."""
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return text.getvalue()


def decimal_mark(cells: Iterable[str], angles: Iterable[str] = ()) -> str:
    """Return the decimal mark of numbers, as far as they tell; "" if both are possible.

    A mark tells nothing where three digits follow it, since it may separate the thousands; of
    angles it does where there would be thousands of degrees.

    >>> decimal_mark(["2.400", "0,5"]), decimal_mark(["2.400", "55"])
    (',', '')
    >>> decimal_mark(["2.400"], angles=["353.366"])
    '.'
    """
    turns = ({m: n for m, n in _readings(cell).items() if abs(n) <= _MOST_DEG} for cell in angles)
    possible = (*map(_readings, cells), *turns)
    marks = {mark for found in possible if len(found) == 1 for mark in found}
    return marks.pop() if len(marks) == 1 else ""


def number_in(cell: str, decimal: str) -> float:
    """Return the number in a cell; nan for what is none, and for what can be read in two ways.

    >>> number_in("2.400", ","), number_in("2.400", "."), number_in("2.400", "")
    (2400.0, 2.4, nan)
    """
    readings = {*_readings(cell, decimal or ".,").values()}
    return readings.pop() if len(readings) == 1 else math.nan


def two_readings(cell: str) -> tuple[float, ...]:
    """Return both numbers that a cell may stand for, like 2400 and 2.4; () for any other cell."""
    readings = {*_readings(cell).values()}
    return tuple(sorted(readings, reverse=True)) if len(readings) > 1 else ()


def name_cell(name: str) -> str:
    """Return a name as it stands in a cell: what a spreadsheet would reckon with gets a quote.

    >>> name_cell("=1+1"), name_cell("die")
    ("'=1+1", 'die')
    """
    return _QUOTE + name if _is_odd(name) else name


def name_in(cell: str) -> str:
    """Return the name for which a cell of `name_cell` stands."""
    is_quoted = cell.startswith(_QUOTE) and _is_odd(cell[1:])
    return cell[1:] if is_quoted else cell


def _is_odd(name: str) -> bool:
    return name.startswith(_ODD) or name != name.lstrip()


def _readings(cell: str, marks: str = ".,") -> dict[str, float]:
    """Return the number in a cell for each decimal mark with which it is one."""
    numbers = ((mark, number_of(cell, mark)) for mark in marks)
    return {mark: number for mark, number in numbers if number is not None}
