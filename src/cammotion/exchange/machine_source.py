"""Where the rows of a machine's table come from: CSV, a workbook, or a text in a notebook."""

from dataclasses import dataclass
from pathlib import Path

from cammotion.exchange.cells import Plain, cut_rows
from cammotion.exchange.xlsx_in import MOST_ROWS, OLD, ZIP, read_sheets
from cammotion.files import as_path, decode, read_bytes
from cammotion.quantities import InputError, shorten

LARGEST_BYTES = 10_000_000
"""Of a file: a machine of a hundred mechanisms has some ten thousand bytes."""

KEY = "motion"
"""A word of the heading: the row that has it is the heading."""

_SEARCHED = 30  # rows in which a heading is looked for
_SIGNS = ";\t,"


@dataclass(frozen=True)
class Source:
    """The rows of a table, and how a row of it is named: "Line 3 of machine.csv"."""

    file: str
    rows: list[list[str]]
    separator: str = ""  # of a workbook, whose cells stand apart by themselves

    @property
    def name(self) -> str:
        """The name of the file without its ending."""
        return self.file.rpartition(".")[0] or self.file

    @property
    def said(self) -> str:
        """The name of the file as sentences have it: a long one is shortened."""
        return shorten(self.file, of=str)

    @property
    def heading_at(self) -> int:
        """The place of the heading among the rows; the first if none is found."""
        rows = enumerate(self.rows[:_SEARCHED])
        return next((n for n, row in rows if is_heading(row)), 0)

    def where(self, place: int) -> str:
        """Return in words where a row is."""
        return f"{'Line' if self.separator else 'Row'} {place + 1} of {self.said}"


def is_heading(row: list[str]) -> bool:
    """Tell whether a row is the heading of a table of segments."""
    return KEY in {cell.strip().casefold() for cell in row}


def open_source(path: str | Path) -> Source:
    """Return the table that a file holds; raise InputError for what is none.

    What is too large, no text and no workbook is refused before anything of it is looked at.
    """
    file = as_path(path)
    content = read_bytes(file, at_most=LARGEST_BYTES)
    if content.startswith((*ZIP, OLD)):
        return from_book(file.name, content)
    return from_text(file.name, decode(shorten(file.name, of=str), content))


def from_text(name: str, text: str) -> Source:
    """Return the table that a text is."""
    separator, said = _separator(text), shorten(name, of=str)
    rows = cut_rows(said, text, separator)
    if len(rows) > MOST_ROWS:
        raise InputError(
            f"The table {said} has {len(rows)} lines, and that of a machine at most {MOST_ROWS}: "
            "give that table alone."
        )
    if separator == ",":  # only a cell in quotes can have a comma
        rows = [[cell if "," in cell else Plain(cell) for cell in row] for row in rows]
    return Source(name, rows, separator)


def _separator(text: str) -> str:
    """Return the sign between the cells of the heading; without one, that of the first line."""
    lines = text.split("\n", _SEARCHED)[:_SEARCHED]
    plain = (line.replace('"', "") for line in lines)
    found = (sign for line in plain for sign in _SIGNS if is_heading(line.split(sign)))
    return next(found, next((sign for sign in _SIGNS if sign in lines[0]), ","))


def from_book(name: str, content: bytes) -> Source:
    """Return the first sheet of a workbook that has the heading."""
    said = shorten(name, of=str)
    sheets = read_sheets(said, content)
    found = [Source(name, rows) for rows in sheets.values() if rows]
    if not found:
        raise InputError(f"The workbook {said} is empty: give one with a table of the segments.")
    return next((one for one in found if is_heading(one.rows[one.heading_at])), found[0])
