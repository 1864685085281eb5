"""Timing diagrams as tables, in CSV files that any spreadsheet opens.

Two tables: that of the segments says the whole diagram, and is read back as it was; that of the
curves lists position, velocity, acceleration and jerk of every motion over the turn.
"""

import csv
import io
import math
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

from cammotion.files import write_new
from cammotion.laws.catalogue import CONSTANT_VELOCITY, LAWS, as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment
from cammotion.quantities import InputError, Quantity

STEP = Quantity(
    "step of the table", "deg", example=1, low=1e-3, high=DEG_PER_TURN, low_included=True
)
DWELL = "dwell"

_ROUNDING = 1e-9  # the part of a step by which the last one may miss the full turn

_KNOWN = {CONSTANT_VELOCITY.name: CONSTANT_VELOCITY}  # beside those of the catalogue
_PLACES = np.linspace(0.0, 1.0, 41)  # at which two laws are compared

_NUMBERS = {
    "from_deg": "from in deg",
    "to_deg": "to in deg",
    "from_mm": "from in mm",
    "to_mm": "to in mm",
}
_RATE = "machine rate in pieces/h"
_HEADING = ["motion", "stops", *_NUMBERS.values(), "law", _RATE]
_CURVES: dict[str, Callable[[TimingDiagram, str, Any], Any]] = {
    "position in mm": TimingDiagram.position_mm,
    "velocity in m/s": TimingDiagram.velocity,
    "acceleration in m/s2": TimingDiagram.acceleration,
    "jerk in m/s3": TimingDiagram.jerk,
}


def write_segments(diagram: TimingDiagram, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write every segment of every motion as a line of a CSV file; return its path.

    The heading names the units; `read_segments` reads the file back to the same diagram, if it is
    given the laws that are not in the catalogue. Raises InputError for two laws of one name. A file
    that is there already is left as it is, with an InputError, unless `overwrite` is True.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> with TemporaryDirectory() as folder:
    ...     path = write_segments(cm.EXAMPLE.diagram, f"{folder}/machine.csv")
    ...     print(path.name, read_segments(path) == cm.EXAMPLE.diagram)
    machine.csv True
    """
    rate = as_diagram(diagram).rate_per_hour
    _check_names(diagram)
    lines = (
        [motion.name, motion.stops or "", *_numbers(segment), _law_name(segment), rate]
        for motion in diagram.motions
        for segment in motion.segments
    )
    return _write(path, [_HEADING, *lines], overwrite)


def write_curves(
    diagram: TimingDiagram, path: str | Path, *, step_deg: float = 1, overwrite: bool = False
) -> Path:
    """Write the curves of every motion over the turn, a line each `step_deg`; return the path.

    Columns are the cam angle in deg, the time in s, and for each motion position in mm, velocity
    in m/s, acceleration in m/s2 and jerk in m/s3. A file that is there already is left as it is,
    with an InputError, unless `overwrite` is True; so is one for a step out of range.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> with TemporaryDirectory() as folder:
    ...     path = write_curves(cm.EXAMPLE.diagram, f"{folder}/curves.csv", step_deg=5)
    ...     print(path.read_text("utf-8").splitlines()[0][:36], len(path.read_text().splitlines()))
    cam angle in deg,time in s,mill posi 74
    """
    as_diagram(diagram)
    step = STEP.number(step_deg)
    steps = math.ceil(DEG_PER_TURN / step - _ROUNDING)
    angles = np.append(step * np.arange(steps), DEG_PER_TURN)
    times = angles * (diagram.cycle_time_s / DEG_PER_TURN)
    columns = {"cam angle in deg": angles, "time in s": times}
    for name in diagram.names:
        for what, curve in _CURVES.items():
            columns[f"{name} {what}"] = curve(diagram, name, angles)
    rows = np.column_stack([*columns.values()]).tolist()
    return _write(path, [[*columns], *rows], overwrite)


def read_segments(path: str | Path, *, laws: Iterable[MotionLaw] = ()) -> TimingDiagram:
    """Return the diagram that a file of `write_segments` holds.

    Also read is what a spreadsheet makes of it: semicolons with decimal commas, or a mark at the
    start of the file. `laws` are further motion laws that the file names. Raises InputError, with
    the line, for anything else.
    """
    lines, decimal = _lines(path)
    heading = [cell.strip() for cell in lines[0]] if lines else []
    if missing := [column for column in _HEADING if column not in heading]:
        raise InputError(
            f"The file {Path(path).name} lacks the column '{missing[0]}': its first line has to "
            f"be {', '.join(_HEADING)}."
        )
    known = _KNOWN | {law.name.strip(): law for law in laws}
    records = [
        _Record(Path(path).name, number, heading, line, decimal)
        for number, line in enumerate(lines[1:], 2)
        if any(cell.strip() for cell in line)
    ]
    if not records:
        raise InputError(f"The file {Path(path).name} has no line with a segment: add some.")
    names = dict.fromkeys(record.cells["motion"] for record in records)
    motions = [
        _motion(name, [record for record in records if record.cells["motion"] == name], known)
        for name in names
    ]
    return TimingDiagram(tuple(motions), _the_same(records, _RATE))


class _Record:
    """A line of a file, with the place to name if it is wrong."""

    def __init__(
        self, file: str, line: int, heading: list[str], cells: list[str], decimal: str
    ) -> None:
        self.where, self.decimal = f"Line {line} of {file}", decimal
        if any(cell.strip() for cell in cells[len(heading) :]):
            raise InputError(
                f"{self.where} has {len(cells)} cells, but the heading {len(heading)}: write one "
                "number in each, with a decimal point, or separate them by semicolons."
            )
        given = dict(zip(heading, cells, strict=False))
        self.cells = {column: given.get(column, "").strip() for column in _HEADING}

    def number(self, column: str) -> float:
        text = self.cells[column]
        try:
            number = float(text.replace(self.decimal, "."))
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise InputError(
                f"{self.where}: '{column}' is {text!r}; it has to be a number, for example 150."
            )
        return number

    def segment(self, known: dict[str, MotionLaw]) -> Segment:
        name = self.cells["law"]
        numbers = {field: self.number(column) for field, column in _NUMBERS.items()}
        try:
            return Segment(**numbers, law=None if name == DWELL else known.get(name, name))
        except InputError as wrong:
            raise InputError(f"{self.where}: {wrong}") from None


def _motion(name: str, records: list[_Record], known: dict[str, MotionLaw]) -> Motion:
    segments, stops = tuple(record.segment(known) for record in records), _stops(records)
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


def _numbers(segment: Segment) -> list[float]:
    return [getattr(segment, field) for field in _NUMBERS]


def _check_names(diagram: TimingDiagram) -> None:
    """Raise InputError for two laws of one name, of which the file could say only one."""
    known = {DWELL: CONSTANT_VELOCITY, **_KNOWN}
    for motion in diagram.motions:
        for move in motion.moves:
            law = as_law(move.law)
            name = law.name.strip()
            other = LAWS[name] if name in LAWS else known.setdefault(name, law)
            if other is not law and not np.array_equal(other(_PLACES), law(_PLACES)):
                raise InputError(
                    f"Two laws are called {law.name!r}, one of them that of the {motion.name}; a "
                    "table tells them apart by their names: give each its own."
                )


def _law_name(segment: Segment) -> str:
    return DWELL if segment.law is None else as_law(segment.law).name


def _write(path: str | Path, rows: Iterable[Iterable[object]], overwrite: bool) -> Path:
    text = io.StringIO(newline="")
    csv.writer(text).writerows(rows)
    return write_new(path, text.getvalue(), overwrite=overwrite)


def _lines(path: str | Path) -> tuple[list[list[str]], str]:
    """Return the lines of a file, cut into cells, and its decimal sign."""
    try:
        with Path(path).open(encoding="utf-8-sig", newline="") as file:
            text = file.read()
    except FileNotFoundError:
        raise InputError(f"There is no file {Path(path).name}: give the path of one.") from None
    except (OSError, UnicodeDecodeError) as wrong:
        raise InputError(f"The file {Path(path).name} cannot be read ({wrong}).") from None
    separator, decimal = (";", ",") if ";" in text.partition("\n")[0] else (",", ".")
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=separator, strict=True)
    try:
        return list(reader), decimal
    except csv.Error as wrong:
        raise InputError(
            f"Line {reader.line_num} of {Path(path).name} cannot be cut into cells ({wrong}): "
            "look for a quotation mark too many."
        ) from None
