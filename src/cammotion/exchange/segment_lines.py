"""The lines of a table of segments, and how a timing diagram is read from them."""

import math
from collections.abc import Iterable
from typing import Any

from cammotion.exchange.cells import cut_rows, decimal_mark, name_in, number_in, two_readings
from cammotion.exchange.law_text import is_same_law, law_from_text
from cammotion.laws.catalogue import CONSTANT_VELOCITY, LAWS
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
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

RATE = "machine rate in pieces/h"
HEADING = ["motion", "stops", *NUMBERS.values(), "law", RATE]
IN_FULL = "law in full"
"""The column that says what a law is; further ones of this name go on where a cell is full."""

KNOWN = {CONSTANT_VELOCITY.name: CONSTANT_VELOCITY}
"""The laws that are known by their names, beside those of the catalogue."""

RESERVED = {DWELL, *KNOWN, *LAWS}
OWN = "own law, "
"""What stands before a law in full that is called by a reserved name and is another."""


def read_diagram(file: str, text: str, given: Iterable[MotionLaw] = ()) -> TimingDiagram:
    """Return the diagram that the text of a file says, with the `given` laws that it names.

    Raises InputError, with the line, for any other text.
    """
    laws = _Laws(given)
    rows, separator = cut_rows(file, text)
    heading = [cell.strip() for cell in rows[0]] if rows else []
    if missing := [column for column in HEADING if column not in heading]:
        raise InputError(
            f"The file {file} lacks the column '{missing[0]}': its first line has to "
            f"be {', '.join(HEADING)}."
        )
    records = [
        _Record(f"Line {number} of {file}", heading, line)
        for number, line in enumerate(rows[1:], 2)
        if any(cell.strip() for cell in line)
    ]
    if not records:
        raise InputError(f"The file {file} has no line with a segment: add some.")
    numbers = (
        record.cells[column] for record in records for column in (*NUMBERS.values(), "stops", RATE)
    )
    decimal = "." if separator == "," else decimal_mark(numbers)
    for record in records:
        record.decimal = decimal
    names = dict.fromkeys(record.cells["motion"] for record in records)
    motions = [
        _motion(name, [record for record in records if record.cells["motion"] == name], laws)
        for name in names
    ]
    return TimingDiagram(tuple(motions), _the_same(records, RATE))


class _Laws:
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
            named = {law.name.strip(): law for law in self._given}
            if name == DWELL:
                return None
            found = (
                named.get(name) or KNOWN.get(name) or one_of("motion law", name, [*named, *LAWS])
            )
            if isinstance(found, str) and found != name:  # in an older table another law's name
                raise InputError(
                    f"There is no motion law {shorten(name)}: write {found!r}, or give your own "
                    "among the `laws`."
                )
            return found
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


class _Record:
    """A line of a file, with the place to name if it is wrong."""

    def __init__(self, where: str, heading: list[str], cells: list[str]) -> None:
        self.where, self.decimal = where, ""
        if any(cell.strip() for cell in cells[len(heading) :]):
            raise InputError(
                f"{self.where} has {len(cells)} cells, but the heading {len(heading)}: write one "
                "number in each, with a decimal point, or separate them by semicolons."
            )
        given = [*zip(heading, cells, strict=False)]
        stripped = {column: cell.strip() for column, cell in given}
        self.cells = {column: stripped.get(column, "") for column in HEADING}
        parts = (name_in(cell.strip()) for column, cell in given if column == IN_FULL)
        self.in_full = " ".join(parts).strip()
        if IN_FULL in heading:  # older versions wrote names as they are
            self.cells |= {column: name_in(self.cells[column]) for column in ("motion", "law")}

    def number(self, column: str) -> float:
        cell = self.cells[column]
        number = number_in(cell, self.decimal)
        if math.isnan(number) and (readings := two_readings(cell)):
            raise InputError(
                f"{self.where}: '{column}' is {cell!r}, which may be {readings[0]:.12g} or "
                f"{readings[1]:.12g}, and no other number of the file tells which: write it "
                f"without a mark of thousands, or with a 0 more behind ({cell}0)."
            )
        if math.isnan(number):
            raise InputError(
                f"{self.where}: '{column}' is {shorten(cell)}; it has to be a number, for example "
                "150."
            )
        return number

    def segment(self, laws: _Laws) -> Segment:
        numbers = {field: self.number(column) for field, column in NUMBERS.items()}
        try:
            return Segment(**numbers, law=laws.find(self.cells["law"], self.in_full))
        except InputError as wrong:
            raise InputError(f"{self.where}: {wrong}") from None


def _motion(name: str, records: list[_Record], laws: _Laws) -> Motion:
    segments, stops = tuple(record.segment(laws) for record in records), _stops(records)
    try:
        return Motion(name, segments, stops)
    except InputError as wrong:
        raise InputError(f"{records[0].where} and further: {wrong}") from None


def _stops(records: list[_Record]) -> Any:
    if not any(record.cells["stops"] for record in records):
        return None
    stops = _the_same(records, "stops")
    return int(stops) if stops.is_integer() else stops  # Motion refuses what is not whole


def _the_same(records: list[_Record], column: str) -> float:
    """Return the number that stands in this column of every line."""
    first = records[0].number(column)
    for record in records:
        if record.number(column) != first:
            raise InputError(
                f"{record.where}: '{column}' is {record.number(column):g}, but {first:g} in the "
                f"first line of the {'motion' if column == 'stops' else 'diagram'}: write the same "
                "in both."
            )
    return first
