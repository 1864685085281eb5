"""The lines of a table of segments: what stands in which column, and the segment of a line."""

import math
import re
from collections.abc import Iterable
from typing import Any

from cammotion.exchange.all_faults import Faults
from cammotion.exchange.cells import Plain, name_in, number_in, two_readings
from cammotion.exchange.law_text import is_same_law, law_from_text
from cammotion.exchange.other_units import converted, unit_of
from cammotion.exchange.xlsx_in import A_DATE
from cammotion.laws.catalogue import CONSTANT_VELOCITY, LAWS
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.kinematics import RATE as MACHINE_RATE
from cammotion.machine.parts import MATCHED
from cammotion.machine.segments import Segment
from cammotion.quantities import InputError, one_of, shorten

DWELL = "dwell"
NUMBERS = {
    "from_deg": "from in deg",
    "to_deg": "to in deg",
    "from_mm": "from in mm",
    "to_mm": "to in mm",
}
"""The columns of a segment's numbers, by their names in the code."""

RATE, STOPS = "machine rate in pieces/h", "stops"
HEADING = ["motion", STOPS, *NUMBERS.values(), "law", RATE]
STILL, RULE = "still", "rule"
"""Two columns that may be left out: where a part has to stand, and the rules, one in a cell."""

IN_FULL = "law in full"
"""The column that says what a law is; further ones of this name go on where a cell is full."""

KNOWN_COLUMNS = *HEADING, STILL, RULE, IN_FULL
"""All others are of one's own."""

NEEDED = [column for column in HEADING if column != STOPS]
_COLUMNS = {column.casefold(): column for column in KNOWN_COLUMNS} | {"rules": RULE}

KNOWN = CONSTANT_VELOCITY.name, *LAWS
"""The laws that are known by their names."""

RESERVED = {DWELL, *KNOWN}
OWN = "own law, "
"""What stands before a law in full that is called by a reserved name and is another."""

_AS_A_NUMBER = ", and format the cell as a number"
_EXAMPLES = {RATE: 2000, STOPS: 24}
_NUMERIC = re.compile(r"[-+−.,]*\d|[=#]")  # a number, what may become one, or its error
_OF_A_SEGMENT = [*NUMBERS.values(), "law"]


def known_column(cell: str) -> str:
    """Return the column that a cell of a heading names; "" for one of one's own.

    >>> known_column("From  in deg"), known_column("remark")
    ('from in deg', '')
    """
    return _COLUMNS.get(" ".join(cell.split()).casefold(), "")


class Laws:
    """The laws that a table may name, or say in full."""

    def __init__(self, given: Any) -> None:
        is_list = isinstance(given, Iterable) and not isinstance(given, str)
        self._given = [*given] if is_list else [given]
        if wrong := [law for law in self._given if not isinstance(law, MotionLaw)]:
            raise InputError(
                f"Among the laws is {shorten(wrong[0])}: give a list of motion laws, for example "
                "laws=[my_law]. Those of the catalogue need not be given."
            )
        self._made: dict[tuple[str, str], MotionLaw] = {}

    def find(self, name: str, text: str) -> str | MotionLaw | None:
        """Return the law that a line names, and says in full if `text` is not empty."""
        if not text:
            if name.casefold() == MATCHED:
                raise InputError(
                    "A law that is matched depends on its neighbours, and a table has to say it "
                    "in full: build the motion with law=MATCHED, and write_machine writes "
                    f"'{IN_FULL}'."
                )
            named = {law.name.strip(): law for law in self._given}
            found = one_of("motion law", name or DWELL, [DWELL, *named, *KNOWN])
            return None if found == DWELL else named.get(found) or found
        if name in RESERVED and not text.startswith(OWN):
            raise InputError(
                f"The law is called {name!r}, but '{IN_FULL}' says another one: empty that cell "
                "if the name is right, or else change the name."
            )
        if (name, text) not in self._made:
            law = law_from_text(name, text.removeprefix(OWN))
            own = (own for own in self._given if own.name == name and is_same_law(own, law))
            self._made[name, text] = next(own, law)
        return self._made[name, text]


class Record:
    """A line of a file, with the place to name if it is wrong.

    One without a segment may say what is for the motion above, or for the machine.
    """

    def __init__(self, where: str, heading: list[str], cells: list[str]) -> None:
        self.where, self.decimal = where, ""
        given = [*zip(heading, cells, strict=False)]
        stripped = {column: cell.strip() for column, cell in given}
        self.cells = {column: stripped.get(column, "") for column in (*HEADING, STILL, RULE)}
        own = ((column, cell.strip()) for column, cell in given if column not in KNOWN_COLUMNS)
        self.others = [(column, cell) for column, cell in own if cell]
        parts = (name_in(cell.strip()) for column, cell in given if column == IN_FULL)
        self.in_full = " ".join(parts).strip()
        quoted = [STILL, RULE]
        if IN_FULL in heading:  # older versions wrote names as they are
            quoted += ["motion", "law"]
        self.cells |= {column: name_in(self.cells[column]) for column in quoted}
        self.names_alone = not any(self.cells[c] for c in _OF_A_SEGMENT) and not self.in_full
        self.is_segment = not self.names_alone and not self.lone_text
        self.segment: Segment | None = None

    @property
    def lone_text(self) -> str:
        """A text that stands where a segment should, with no number beside it; or "".

        What begins with # is one, too, whatever its commas make of it, unless it has two angles, or
        all numbers but one and a law: the name of a part may begin so. So is one with a number
        alone, like the total of a column.
        """
        first, *others = [self.cells[column] for column in ("motion", STOPS, *_OF_A_SEGMENT)]
        numeric = [bool(_NUMERIC.match(self.cells[column])) for column in NUMBERS.values()]
        has_slip = numeric.count(False) == 1 and self.cells["law"]
        if first.startswith("#") and not (all(numeric[:2]) or has_slip):
            return first
        texts = [*filter(None, (first, *others))]
        is_alone = len(texts) == 1 and [*filter(None, self.cells.values())] == texts
        is_cut = first and any(others) and not self.cells["law"]
        if first and sum(map(bool, others)) == sum(numeric) == 1 and not self.in_full:
            return first
        if self.in_full or any(map(_NUMERIC.match, others)) or not (is_alone or is_cut):
            return ""
        return texts[0]

    def mark(self, column: str) -> str:
        """Return the decimal mark of a cell, "" if nothing tells it."""
        return "." if isinstance(self.cells[column], Plain) else self.decimal

    def number(self, column: str) -> float:
        """Return the number in a column; raise InputError, with the line and the column."""
        cell = self.cells[column]
        number = number_in(cell, self.mark(column))
        if math.isnan(number) and (readings := two_readings(cell)):
            raise InputError(
                f"{self.where}: '{column}' is {cell!r}, which may be {readings[0]:.12g} or "
                f"{readings[1]:.12g}, and no other number that stands so tells which: write it "
                f"without a mark of thousands, or with a 0 more behind ({cell}0)."
            )
        if math.isnan(number):
            fix = f", for example {_EXAMPLES.get(column, 150)}"
            fix += _AS_A_NUMBER if cell.endswith(A_DATE) else ""
            if write := converted(cell, unit_of(column), self.mark(column)):
                fix = f" alone, in {unit_of(column)}: write {write}"
            raise InputError(
                f"{self.where}: '{column}' is {shorten(cell)}; it has to be a number{fix}."
            )
        if column == RATE:
            try:
                MACHINE_RATE.number(number)
            except InputError as wrong:
                raise InputError(f"{self.where}, '{column}': {wrong}") from None
        return number

    def read(self, laws: Laws, faults: Faults) -> None:
        """Make the segment of the line, if it says one and nothing of it is wrong."""
        if not self.is_segment:
            return
        numbers: dict[str, float] = {}
        for field, column in NUMBERS.items():
            with faults.at():
                numbers[field] = self.number(column)
        with faults.at(self.where):
            law = laws.find(self.cells["law"], self.in_full)
            if law is None and not self.cells["law"] and len(numbers) == len(NUMBERS):
                self._check_stands(numbers)
            if len(numbers) == len(NUMBERS):
                self.segment = Segment(**numbers, law=law)

    def _check_stands(self, numbers: dict[str, float]) -> None:
        if numbers["from_mm"] != numbers["to_mm"]:
            raise InputError(
                "'law' is empty, but the segment moves: write the name of a law, for example "
                "cycloidal."
            )
