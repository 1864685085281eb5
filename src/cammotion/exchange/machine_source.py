"""Where the rows of a machine's table come from: CSV, a workbook, or a text in a notebook."""

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from cammotion.exchange.cells import Plain, cut_rows
from cammotion.exchange.machine_lines import NEEDED, known_column
from cammotion.exchange.xlsx_in import MOST_ROWS, OLD, ZIP, read_sheets
from cammotion.files import as_path, decode, read_bytes
from cammotion.quantities import InputError, shorten

LARGEST_BYTES = 10_000_000
"""Of a file: a machine of a hundred mechanisms has some ten thousand bytes."""

_KEY = "motion"
_ENOUGH = 4  # columns that a machine needs, with the key: a row of so many is a heading
_SEARCHED = 30  # rows in which a heading is looked for
_SIGNS = ";\t,"


@dataclass(frozen=True)
class Source:
    """The rows of a table, and how a row of it is named: "Line 3 of machine.csv"."""

    file: str
    rows: list[list[str]]
    separator: str = ""  # of a workbook, whose cells stand apart by themselves
    sheet: str = ""  # of a workbook with several

    @property
    def name(self) -> str:
        """The name of the file without its ending."""
        return self.file.rpartition(".")[0] or self.file

    @property
    def said(self) -> str:
        """The name of the file as sentences have it, a long one shortened, with the sheet."""
        file = shorten(self.file, of=str)
        return f"the sheet {shorten(self.sheet)} of {file}" if self.sheet else file

    @property
    def what(self) -> str:
        """What it is, with its name: a file, or a sheet of several."""
        return self.said.removeprefix("the ") if self.sheet else f"file {self.said}"

    @property
    def heading_at(self) -> int:
        """The place of the heading among the rows; the first if none is found."""
        rows = self.rows[:_SEARCHED]
        return max(range(len(rows)), key=lambda n: needed_in(rows[n]), default=0)

    @property
    def found(self) -> int:
        """How many columns that a machine needs stand in the heading."""
        return needed_in(self.rows[self.heading_at])

    def where(self, place: int) -> str:
        """Return in words where a row is."""
        return f"{'Line' if self.separator else 'Row'} {place + 1} of {self.said}"


def needed_in(row: Iterable[str]) -> int:
    """Return how many columns that a machine needs a row names.

    >>> needed_in(["motion", "supplier"]), needed_in(NEEDED)
    (1, 7)
    """
    return len({*NEEDED}.intersection(map(known_column, row)))


def is_heading(row: list[str]) -> bool:
    """Tell whether a row is the heading of a machine, be it with slips."""
    return _KEY in map(known_column, row) and needed_in(row) >= _ENOUGH


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
    cut = [(needed_in(line.split(sign)), sign) for line in plain for sign in _SIGNS]
    most, found = max(cut, key=lambda one: one[0])
    return found if most else next((sign for sign in _SIGNS if sign in lines[0]), ",")


def from_book(name: str, content: bytes) -> Source:
    """Return the first sheet of a workbook that has the heading, or what is most like it."""
    said = shorten(name, of=str)
    sheets = {sheet: rows for sheet, rows in read_sheets(said, content).items() if rows}
    if not sheets:
        raise InputError(f"The workbook {said} is empty: give one with a table of the segments.")
    found = [Source(name, rows, "", sheet * (len(sheets) > 1)) for sheet, rows in sheets.items()]
    known = (one for one in found if is_heading(one.rows[one.heading_at]))
    return next(known, max(found, key=lambda one: one.found))
