"""A whole machine in a file: segments, rules and still arcs in one table, CSV or a workbook."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from cammotion.arguments import checked
from cammotion.exchange.cells import name_cell, rows_as_text
from cammotion.exchange.diagram_tables import is_same, segment_rows
from cammotion.exchange.machine_lines import RULE, STILL
from cammotion.exchange.machine_source import Source, from_book, from_text, open_source
from cammotion.exchange.machine_table import read_table
from cammotion.exchange.rule_text import arcs_as_text, rule_as_text
from cammotion.exchange.xlsx_out import sheets_as_xlsx
from cammotion.files import table_ending, write_new
from cammotion.laws.motion_law import MotionLaw
from cammotion.own import Machine
from cammotion.quantities import InputError, shorten

_BOOK = ".xlsx"
_PLAIN = (
    "give mechanisms and rules plain names, without words like 'beyond' or 'only while' and "
    "without colons"
)


def read_machine(path: str | Path, *, laws: Iterable[MotionLaw] = ()) -> Machine:
    r"""Return the machine of a table: a CSV file, or the first such sheet in sight of an .xlsx.

    A line is a segment, as `write_segments` writes it: motion, stops, from and to in deg, from and
    to in mm, law, machine rate in pieces/h. A motion that is not named is that of the line above.
    The rate may stand in one line alone, and the stops of a turret too. A line without a segment
    says its stops and still arcs of the motion that it names, or else of that above. Dwells may be
    left out, all those of a motion: it then stands between its moves.

    Two columns more, if you like: `still` says over which arc a part has to stand, "yes" in the
    line of a dwell or "205 to 305", and `rule` has a rule in each cell, in any line: "the die may
    be beyond 19 mm only while the mill is within 0.65 mm", where "moving" or "standing" may be in
    place of a limit, or "the pusher stays at least 5 mm above the flap".

    Other columns are yours, unless they mean `still` or `rule` by another name where that is
    lacking, or something like a rule or a still arc stands there. The machine does not keep them:
    written again, it is without your remarks. A line of notes may stand above the heading alone.

    Raises one InputError with all that is wrong, a line each, with its place in the table; so for
    a file of more than 10 MB and for a workbook that is none.

    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     _ = Path(folder, "press.csv").write_text(
    ...         "motion,from in deg,to in deg,from in mm,to in mm,law,machine rate in pieces/h\n"
    ...         "die,150,205,0,50,cycloidal,2000\n"
    ...         ",305,360,50,0,cycloidal,\n")
    ...     read_machine(f"{folder}/press.csv")
    press: 1 mechanism at 2000 pieces/h, no rules; the die is driven hardest, 4.154 m/s²
    """
    if isinstance(path, str) and "\n" in path.strip():
        raise InputError("This is a table itself and no path: give it to machine_from_text.")
    return read_table(open_source(path), laws)


def machine_from_text(text: str, name: str = "my machine") -> Machine:
    """Return the machine that a text says: the table of `read_machine`, typed or pasted.

    Its cells are separated by commas, semicolons, or the tabs of a spreadsheet. Raises InputError
    like `read_machine`, and for what is no text.

    >>> machine_from_text('''
    ... motion; from in deg; to in deg; from in mm; to in mm; law;       machine rate in pieces/h
    ... die;    150;         205;       0;          50;       cycloidal; 2000
    ...       ; 305;         360;       50;         0;        cycloidal;
    ... ''', "press")
    press: 1 mechanism at 2000 pieces/h, no rules; the die is driven hardest, 4.154 m/s²
    """
    for what, given in (("table", text), ("name", name)):
        if not isinstance(given, str) or not given.strip():
            raise InputError(f"The {what} of the machine is {shorten(given)}: give a text.")
    return read_table(from_text(name.strip(), text.removeprefix("\ufeff").strip("\r\n")))


@checked
def write_machine(machine: Machine, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write a machine into one table that `read_machine` reads back; return its path.

    Its name stands nowhere in the table: read back, it is called as the file is. Columns of your
    own in the table from which it was read are not written, since it does not keep them. A name
    that ends in .xlsx makes a workbook, one of another format like .ods or .pdf is refused, any
    other makes a CSV file. Nothing is written over a file that is there, unless `overwrite` is
    True, and nothing that cannot be read back; raises InputError.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> both = {"mill": [(205, 305)], "die": [(205, 305)]}
    >>> machine = Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule], both)
    >>> with TemporaryDirectory() as folder:
    ...     path = write_machine(machine, f"{folder}/press.xlsx")
    ...     read_machine(path) == machine
    True
    """
    is_book = table_ending(path, [_BOOK]) == _BOOK
    rows = machine_rows(machine)
    content = sheets_as_xlsx({"machine": rows}) if is_book else rows_as_text(rows)
    try:
        back = read_table(_source("the table", content))
        same = is_same(back.diagram, machine.diagram) and back.still == machine.still
    except InputError as wrong:
        raise InputError(
            f"This machine cannot be written as a table. {wrong} If a name is misread, {_PLAIN}."
        ) from None
    if not same or [*back.rules] != [*machine.rules]:
        raise InputError(
            f"The rules or still arcs of this machine are not given back by a table: {_PLAIN}."
        )
    return write_new(path, content, overwrite=overwrite)


def _source(name: str, content: str | bytes) -> Source:
    return from_text(name, content) if isinstance(content, str) else from_book(name, content)


def machine_rows(machine: Machine) -> list[list[Any]]:
    """Return the rows of the table of a machine, the heading first."""
    heading, *rows = segment_rows(machine.diagram)
    still = {name: name_cell(arcs_as_text(arcs)) for name, arcs in machine.still.items()}
    rules = [name_cell(rule_as_text(rule)) for rule in machine.rules]
    lines = [motion.name for motion in machine.diagram.motions for _ in motion.segments]
    found = [[*heading, STILL, RULE]]
    for number in range(max(len(rows), len(rules))):
        row = rows[number] if number < len(rows) else [""] * len(heading)
        arc = still.pop(lines[number], "") if number < len(rows) else ""
        found.append([*row, arc, rules[number] if number < len(rules) else ""])
    return found
