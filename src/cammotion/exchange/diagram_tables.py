"""Timing diagrams as tables, in CSV files that any spreadsheet opens.

Two tables: that of the segments says the whole diagram, and is read back as it was; that of the
curves lists position, velocity, acceleration and jerk of every motion over the turn.
"""

import math
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from textwrap import wrap
from typing import Any

import numpy as np

from cammotion.exchange.cells import name_cell, rows_as_text
from cammotion.exchange.law_text import is_same_law, law_as_text
from cammotion.exchange.machine_lines import (
    DWELL,
    HEADING,
    IN_FULL,
    KNOWN,
    NUMBERS,
    OWN,
    RESERVED,
)
from cammotion.exchange.machine_source import from_text, open_source
from cammotion.exchange.machine_table import read_table
from cammotion.exchange.table_numbers import ANGLE_DECIMALS
from cammotion.files import table_ending, write_new
from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import InputError, Quantity, WrongAnswerError, shorten

STEP = Quantity(
    "step of the table", "deg", example=1, low=1e-3, high=DEG_PER_TURN, low_included=True
)
_ROUNDING = 1e-9  # the part of a step by which the last one may miss the full turn
_LONGEST = 30_000  # characters of a cell, of which a spreadsheet takes 32,767

_CURVES: dict[str, Callable[[TimingDiagram, str, Any], Any]] = {
    "position in mm": TimingDiagram.position_mm,
    "velocity in m/s": TimingDiagram.velocity,
    "acceleration in m/s2": TimingDiagram.acceleration,
    "jerk in m/s3": TimingDiagram.jerk,
}


def write_segments(diagram: TimingDiagram, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write every segment of every motion as a line of a CSV file; return its path.

    The heading names the units. Laws that are not in the catalogue are written in full, so that
    `read_segments` reads the file back to the same machine; what cannot be read back so is not
    written, with an InputError. A name that a spreadsheet would take for a formula gets a quote
    before it. A file that is there already is left as it is, with an InputError, unless
    `overwrite` is True; a name with the ending of another format gets one, too.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> with TemporaryDirectory() as folder:
    ...     path = write_segments(cm.EXAMPLE.diagram, f"{folder}/machine.csv")
    ...     print(path.name, read_segments(path) == cm.EXAMPLE.diagram)
    machine.csv True
    """
    text = rows_as_text(segment_rows(as_diagram(diagram)))
    table_ending(path)
    _check_comes_back(diagram, text)
    return write_new(path, text, overwrite=overwrite)


def segment_rows(diagram: TimingDiagram) -> list[list[Any]]:
    """Return the rows of the table of a diagram's segments, the heading first."""
    laws = {id(law): law for law in _laws(diagram)}
    in_full = {key: _in_full(law) for key, law in laws.items()}
    rows: list[list[Any]] = [HEADING + [IN_FULL] * max([1, *map(len, in_full.values())])]
    for motion in diagram.motions:
        for segment in motion.segments:
            first = [_cell("motion", motion.name), motion.stops or ""]
            numbers, law, last = [getattr(segment, field) for field in NUMBERS], DWELL, [""]
            if segment.law is not None:
                law, last = _cell("law", as_law(segment.law).name), in_full[id(segment.law)]
            rows.append([*first, *numbers, law, diagram.rate_per_hour, *last])
    return rows


def write_curves(
    diagram: TimingDiagram, path: str | Path, *, step_deg: float = 1, overwrite: bool = False
) -> Path:
    """Write the curves of every motion over the turn, a line each `step_deg`; return the path.

    Columns are the cam angle in deg, the time in s, and for each motion position in mm, velocity
    in m/s, acceleration in m/s2 and jerk in m/s3. A file that is there already is left as it is,
    with an InputError, unless `overwrite` is True; so is one for a step out of range, and
    for a name with the ending of another format.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> with TemporaryDirectory() as folder:
    ...     path = write_curves(cm.EXAMPLE.diagram, f"{folder}/curves.csv", step_deg=5)
    ...     print(path.read_text("utf-8").splitlines()[0][:36], len(path.read_text().splitlines()))
    cam angle in deg,time in s,mill posi 74
    """
    as_diagram(diagram)
    table_ending(path)
    step = STEP.number(step_deg)
    steps = math.ceil(DEG_PER_TURN / step - _ROUNDING)
    angles = np.append(step * np.arange(steps), DEG_PER_TURN).round(ANGLE_DECIMALS)
    times = angles * (diagram.cycle_time_s / DEG_PER_TURN)
    columns = {"cam angle in deg": angles, "time in s": times}
    for name in diagram.names:
        for what, curve in _CURVES.items():
            columns[name_cell(f"{name} {what}")] = curve(diagram, name, angles)
    rows = np.column_stack([*columns.values()]).tolist()
    return write_new(path, rows_as_text([[*columns], *rows]), overwrite=overwrite)


def read_segments(path: str | Path, *, laws: Iterable[MotionLaw] = ()) -> TimingDiagram:
    """Return the diagram that a file of `write_segments` holds.

    Also read is what a spreadsheet makes of it: semicolons with decimal commas, a mark at the
    start of the file, or an .xlsx workbook. It is the table of `read_machine`, which says what may
    be left out, and also returns the rules. A table of an older version names laws of your own
    without saying what they are: give them as `laws`. Raises one InputError with all that is
    wrong, each with its line, also for a number that can be read in two ways.
    """
    return read_table(open_source(path), laws).diagram


def _in_full(law: MotionLaw) -> list[str]:
    """Return the cells that say what a law is; empty for one of the catalogue under its name."""
    if law.name in KNOWN and is_same_law(as_law(law.name), law):
        return [""]
    text = (OWN if law.name in RESERVED else "") + law_as_text(law)
    return [name_cell(part) for part in wrap(text, _LONGEST, break_on_hyphens=False)]


def _cell(what: str, name: str) -> str:
    """Return the name of a motion or a law as a cell; raise InputError for what fits in none."""
    if len(name) >= _LONGEST or name != name.rstrip():
        raise InputError(
            f"The name of a {what} is {shorten(name)}, which no cell of a table gives back: give "
            "it a text without blanks at its end, shorter than a page."
        )
    return name_cell(name)


def _check_comes_back(diagram: TimingDiagram, text: str) -> None:
    """Raise an error unless the text is read as the same diagram."""
    try:
        back = read_table(from_text("the table", text)).diagram
    except InputError as wrong:
        raise WrongAnswerError("write_segments", f"its table is not read ({wrong})") from None
    if not is_same(back, diagram):
        raise WrongAnswerError("write_segments", "the table gives back another machine")


def is_same(one: TimingDiagram, other: TimingDiagram) -> bool:
    """Return whether two diagrams have the same motions, with laws that are the same curves."""

    def numbers(diagram: TimingDiagram) -> list[Any]:
        return [
            [
                motion.name,
                motion.stops,
                *([getattr(s, f) for f in NUMBERS] for s in motion.segments),
            ]
            for motion in diagram.motions
        ]

    pairs = zip(_laws(one), _laws(other), strict=False)
    return numbers(one) == numbers(other) and all(is_same_law(*pair) for pair in pairs)


def _laws(diagram: TimingDiagram) -> Iterator[MotionLaw]:
    return (as_law(move.law) for motion in diagram.motions for move in motion.moves)
