"""Timing diagrams as tables, in CSV files that any spreadsheet opens.

Two tables: that of the segments says the whole diagram, and is read back as it was; that of the
curves lists position, velocity, acceleration and jerk of every motion over the turn.
"""

import csv
from collections.abc import Callable, Iterable, Iterator
from itertools import groupby
from pathlib import Path
from typing import Any

import numpy as np

from cammotion.checks import InputError, Quantity
from cammotion.diagram import TimingDiagram
from cammotion.kinematics import DEG_PER_TURN
from cammotion.laws import LAWS, MotionLaw, as_law
from cammotion.motions import Motion
from cammotion.segments import Segment

STEP = Quantity("step of the table", "deg", example=1, high=DEG_PER_TURN)
DWELL = "dwell"

_NUMBERS = {
    "from_deg": "from in deg",
    "to_deg": "to in deg",
    "from_mm": "from in mm",
    "to_mm": "to in mm",
}
_HEADING = ["motion", "stops", *_NUMBERS.values(), "law", "machine rate in pieces/h"]
_CURVES: dict[str, Callable[[TimingDiagram, str, Any], Any]] = {
    "position in mm": TimingDiagram.position_mm,
    "velocity in m/s": TimingDiagram.velocity,
    "acceleration in m/s2": TimingDiagram.acceleration,
    "jerk in m/s3": TimingDiagram.jerk,
}


def write_segments(diagram: TimingDiagram, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write every segment of every motion as a line of a CSV file; return its path.

    The heading names the units; `read_segments` reads the file back to the same diagram. A file
    that is there already is left as it is, with an InputError, unless `overwrite` is True.
    """
    lines = (
        [motion.name, motion.stops or "", *_numbers(segment), _law_name(segment), rate]
        for rate in [diagram.rate_per_hour]
        for motion in diagram.motions
        for segment in motion.segments
    )
    return _write(path, [_HEADING, *lines], overwrite)


def write_curves(
    diagram: TimingDiagram, path: str | Path, *, step_deg: float = 1, overwrite: bool = False
) -> Path:
    """Write the curves of every motion over the turn, a line each `step_deg`; return the path.

    Columns are the cam angle in deg, the time in s, and for each motion position in mm, velocity
    in m/s, acceleration in m/s2 and jerk in m/s3. Files are protected as in `write_segments`.
    """
    angles = np.append(np.arange(0.0, DEG_PER_TURN, STEP.number(step_deg)), DEG_PER_TURN)
    columns = {"cam angle in deg": angles, "time in s": angles * _seconds_per_deg(diagram)}
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
    lines = list(_lines(path))
    heading = [cell.strip() for cell in lines[0]] if lines else []
    if missing := [column for column in _HEADING if column not in heading]:
        raise InputError(
            f"The file {Path(path).name} lacks the column '{missing[0]}': its first line has to "
            f"be {', '.join(_HEADING)}."
        )
    known = {law.name: law for law in laws}
    records = [
        _Record(Path(path).name, number, dict(zip(heading, line, strict=False)))
        for number, line in enumerate(lines[1:], 2)
        if any(cell.strip() for cell in line)
    ]
    motions = [
        Motion(name, tuple(record.segment(known) for record in its), its[0].stops())
        for name, group in groupby(records, key=lambda record: record.cells["motion"])
        for its in [list(group)]
    ]
    rates = {record.number("machine rate in pieces/h") for record in records}
    if len(rates) != 1:
        raise InputError(
            f"The file {Path(path).name} names {len(rates)} machine rates; a diagram has one: "
            "write the same in every line."
        )
    return TimingDiagram(tuple(motions), rates.pop())


class _Record:
    """A line of a file, with the place to name if it is wrong."""

    def __init__(self, file: str, line: int, cells: dict[str, str]) -> None:
        self.where = f"Line {line} of {file}"
        self.cells = {column: cells.get(column, "").strip() for column in _HEADING}

    def number(self, column: str) -> float:
        text = self.cells[column]
        try:
            return float(text)
        except ValueError:
            raise InputError(
                f"{self.where}: '{column}' is {text!r}; it has to be a number, for example 150."
            ) from None

    def stops(self) -> int | None:
        return int(self.number("stops")) if self.cells["stops"] else None

    def segment(self, known: dict[str, MotionLaw]) -> Segment:
        name = self.cells["law"]
        numbers = {field: self.number(column) for field, column in _NUMBERS.items()}
        try:
            law = None if name == DWELL else known.get(name) or as_law(name)
            return Segment(**numbers, law=law if law is None or name not in LAWS else name)
        except InputError as wrong:
            raise InputError(f"{self.where}: {wrong}") from None


def _numbers(segment: Segment) -> list[float]:
    return [getattr(segment, field) for field in _NUMBERS]


def _law_name(segment: Segment) -> str:
    return DWELL if segment.law is None else as_law(segment.law).name


def _seconds_per_deg(diagram: TimingDiagram) -> float:
    return diagram.cycle_time_s / DEG_PER_TURN


def _write(path: str | Path, rows: Iterable[Iterable[object]], overwrite: bool) -> Path:
    path = Path(path)
    try:
        with path.open("w" if overwrite else "x", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows(rows)
    except FileExistsError:
        raise InputError(
            f"The file {path.name} is there already and was left as it is: choose another name, "
            "or add overwrite=True."
        ) from None
    except OSError as wrong:
        raise InputError(
            f"The file {path.name} cannot be written ({wrong.strerror}): choose a folder that is "
            "there and that you may write to."
        ) from None
    return path


def _lines(path: str | Path) -> Iterator[list[str]]:
    try:
        text = Path(path).read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InputError(f"There is no file {Path(path).name}: give the path of one.") from None
    except (OSError, UnicodeDecodeError) as wrong:
        raise InputError(f"The file {Path(path).name} cannot be read ({wrong}).") from None
    first = text.partition("\n")[0]
    if ";" in first:
        return csv.reader(text.replace(",", ".").splitlines(), delimiter=";")
    return csv.reader(text.splitlines())
