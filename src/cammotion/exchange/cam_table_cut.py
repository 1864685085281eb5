"""What the text of a cam's table is once it is cut: rows, and two columns of numbers."""

from collections.abc import Sequence
from dataclasses import dataclass

from cammotion.exchange.cam_table_headings import Heading
from cammotion.quantities import Floats

SEPARATORS = {"\t": "tabs", ";": "semicolons", "|": "bars", ",": "commas", " ": "spaces"}
DECIMALS = {".": "decimal points", ",": "decimal commas"}


@dataclass(frozen=True)
class Asked:
    """What is set of a table, and not to be found out."""

    separator: str | None = None
    decimal: str | None = None
    columns: tuple[int, int] | None = None


@dataclass(frozen=True)
class Row:
    """A row of a table: the number of its line, its text, and its cells."""

    line: int
    text: str
    cells: list[str]

    @property
    def width(self) -> int:
        """How many cells it has up to the last that is not empty."""
        return filled(self.cells)


@dataclass(frozen=True, eq=False)
class Columns:
    """Two columns of a file as they are written and as numbers, and how they were read."""

    name: str
    separator: str
    decimal: str
    rows: list[Row]
    headings: list[Heading]
    chosen: tuple[int, int]
    numbers: Floats  # (rows, 2)

    def cells(self, which: int) -> list[str]:
        """Return the cells of the first or the second chosen column, as they are written."""
        return [row.cells[self.chosen[which]] for row in self.rows]

    def where(self, row: int) -> str:
        """Return the place of a row in words."""
        return f"Line {self.rows[row].line} of {self.name}"


def filled(cells: Sequence[str]) -> int:
    """Return how many cells there are up to the last that is not empty."""
    return max((n for n, cell in enumerate(cells, 1) if cell), default=0)
