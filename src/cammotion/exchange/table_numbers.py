"""Numbers as they are written: decimal marks, marks of thousands, how finely they are rounded."""

import math
import re
from collections.abc import Sequence

_GAPS = "'\N{RIGHT SINGLE QUOTATION MARK}\N{NO-BREAK SPACE}\N{NARROW NO-BREAK SPACE}\N{THIN SPACE}"
_GROUPED_BY_GAPS = re.compile(rf"[+-]?[1-9][0-9]{{0,2}}(?:[{_GAPS}][0-9]{{3}})+(?![0-9])")
_POWER = r"(?:[eE][+-]?[0-9]{1,3})?"
_PLAIN = {
    ".": re.compile(rf"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+){_POWER}"),
    ",": re.compile(rf"[+-]?[0-9]+(?:,[0-9]+)?{_POWER}"),
}
_GROUPED = {
    ".": re.compile(r"[+-]?[1-9][0-9]{0,2}(?:,[0-9]{3})+(?:\.[0-9]+)?"),
    ",": re.compile(r"[+-]?[1-9][0-9]{0,2}(?:\.[0-9]{3})+(?:,[0-9]+)?"),
}
ANGLE_DECIMALS = 10
"""Of an angle as it is written: 0.3, and not 0.30000000000000004."""

_OTHER = {".": ",", ",": "."}
_LARGE = 0.1  # of the largest: numbers from there on say how finely a column is rounded


def number_of(text: str, decimal: str) -> float | None:
    """Return the number that a cell is, with this decimal mark, or None if it is none.

    >>> number_of("1.234,5", ","), number_of("2,400", "."), number_of("2,400", ",")
    (1234.5, 2400.0, 2.4)
    >>> number_of("1.5", ",") is number_of("5 mm", ".") is None
    True
    """
    text = _tidied(text)
    if _PLAIN[decimal].fullmatch(text):
        number = float(text.replace(decimal, "."))
    elif _GROUPED[decimal].fullmatch(text):
        number = float(text.replace(_OTHER[decimal], "").replace(decimal, "."))
    else:
        return None
    return number if math.isfinite(number) else None


def is_grouped(text: str, decimal: str) -> bool:
    """Return whether a number of this decimal mark is written with a mark of thousands."""
    return not _PLAIN[decimal].fullmatch(_tidied(text))


def proves_groups(text: str, decimal: str) -> bool:
    """Return whether the mark of thousands in a number cannot be a decimal mark."""
    return decimal in text or text.count(_OTHER[decimal]) > 1


def step_of(cells: Sequence[str], decimal: str) -> float:
    """Return the step to which a column of numbers is rounded, judged from its digits.

    Zeros behind the decimal mark that all of them end with are no digits. Where their decimals
    differ in number, those of the large ones count: the digits of each may be alike in number.

    >>> step_of(["0.00", "12.35", "7.40"], "."), step_of(["0,0005", "0,2500"], ",")
    (0.01, 0.0001)
    >>> step_of(["1.2346e-05", "12.346"], "."), step_of(["0", "1200", "50"], ".")
    (0.001, 1.0)
    >>> step_of(["0.00", "0"], ".")
    0.01
    """
    cells = [*map(_tidied, cells)]
    numbers = [abs(number_of(cell, decimal) or 0.0) for cell in cells]
    printed = {_printed(cell, decimal) for cell in cells}
    if not any(numbers):
        return float(f"1e{-max(*printed, 0)}")
    if len(printed) == 1 and -1 not in printed:
        return float(f"1e{-max(_decimals(cell, decimal) for cell in cells)}")
    least = _LARGE * max(numbers)
    large = [cell for cell, number in zip(cells, numbers, strict=True) if number >= least]
    return float(f"1e{-max(_decimals(cell, decimal) for cell in large)}")


def _tidied(text: str) -> str:
    """Return a number with the minus of a keyboard, and without gaps between thousands."""
    text = text.replace("\N{MINUS SIGN}", "-")
    if _GROUPED_BY_GAPS.match(text):
        return re.sub(f"[{_GAPS}]", "", text)
    return text


def _decimals(cell: str, decimal: str) -> int:
    """Return how many decimals a number has; without a power of ten, no zeros at its end."""
    mantissa, _, power = cell.lower().partition("e")
    part = mantissa.partition(decimal)[2]
    return len(part) - int(power) if power else len(part.rstrip("0"))


def _printed(cell: str, decimal: str) -> int:
    """Return how many decimals a number is printed with, -1 for one with a power of ten."""
    return -1 if "e" in cell.lower() else len(cell.partition(decimal)[2])
