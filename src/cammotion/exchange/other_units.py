"""Units that the table of a machine does not take, and the factors that make its own of them."""

import math
import re

from cammotion.exchange.cam_table_headings import LENGTHS, heading_of
from cammotion.exchange.cells import number_in, two_readings
from cammotion.machine.kinematics import DEG_PER_TURN

_PER_HOUR = {"h": 1.0, "m": 60.0, "s": 3600.0}
_RATE = re.compile(
    r"(?:/|\b(?:per|pro|a)\s)\s*(h|min|s)(?:ours?|utes?|ec(?:onds?)?)?\b|\b[cprs]pm\b"
)
_FACTORS = {"mm": LENGTHS, "deg": {"deg": 1.0, "rad": math.degrees(1), "turn": DEG_PER_TURN}}
_QUANTITY = re.compile(r"([-+−]?\d[\d.,]*)\s*(\D+)")


def unit_of(column: str) -> str:
    """Return the unit that stands in the name of a column: mm of "from in mm"."""
    return column.rpartition(" in ")[2]


def factor_of(words: str, unit: str) -> float:
    """Return by what a number of the unit in some words is multiplied; nan if they name none.

    >>> factor_of("from in inch", "mm"), factor_of("rate per minute", "pieces/h")
    (25.4, 60.0)
    """
    if unit in _FACTORS:
        return _FACTORS[unit].get(heading_of(words).unit, math.nan)
    found = _RATE.search(words.casefold()) if unit == "pieces/h" else None
    return _PER_HOUR[(found[1] or "m")[0]] if found else math.nan


def converted(cell: str, unit: str, decimal: str) -> str:
    """Return the number to write for one with its unit, as in "8 in"; "" for any other cell.

    Where nothing tells the decimal mark, three digits behind one are decimals of a larger unit.

    >>> converted("8 in", "mm", "."), converted("33,5/min", "pieces/h", ",")
    ('203.2', '2010')
    >>> converted("1.125 in", "mm", "")
    '28.5750'
    """
    found = _QUANTITY.fullmatch(cell)
    if not found:
        return ""
    factor, mark = factor_of(found[2], unit), decimal
    if not decimal and factor > 1 and two_readings(found[1]):
        mark = "," if "," in found[1] else "."
    number = number_in(found[1], mark) * factor
    write = f"{number:.12g}"
    write += "0" * (not decimal and bool(two_readings(write)))
    return "" if math.isnan(number) else write.replace(".", mark or ".")
