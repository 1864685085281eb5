"""What ``workbook.py report MACHINE`` runs: read the table, write the report, say how it went.

It ends with 0 if all rules are kept, with 3 if the report was written and a rule is broken, with 2
for a table that cannot be read, of which nothing is written, or for a command that cannot be, and
with 1 for any other failure. After Ctrl-C with nothing written it ends with 130; what takes long to
load is loaded within `_write`, all of it before the search begins, so that this is answered from
the first second on, as soon as it is loaded.
"""

import argparse
import importlib
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from cammotion.terminal import interrupt_held_back, suit_any_terminal

if TYPE_CHECKING:
    from cammotion.own import Machine
    from cammotion.report.writing import Report

KEPT, FAILED, BAD_INPUT, BROKEN, INTERRUPTED = 0, 1, 2, 3, 130
_BAR, _WIDTH = 24, 100


def main(arguments: Sequence[str] | None = None) -> int:
    """Write a report; what stands in the way is said in a sentence."""
    parser = argparse.ArgumentParser(prog="workbook.py report")
    parser.add_argument("machine", type=Path, help="its table, CSV or .xlsx")
    parser.add_argument("--folder", type=Path, default=Path(), help="where the report is written")
    parser.add_argument("--seconds", type=float, default=20.0, help="for the proof of a bound: 20")
    parser.add_argument("--dxf", action="store_true", help="also a disc cam of what comes back")
    options = parser.parse_args(arguments)
    suit_any_terminal()
    try:
        done = _write(options)
    except KeyboardInterrupt:
        print("\nStopped. Nothing was written.", file=sys.stderr)
        return INTERRUPTED
    if isinstance(done, int):
        return done
    machine, report = done
    for violation in machine.violations:
        print(f"Broken: {violation}.")
    print(report)
    return KEPT if report.is_kept else BROKEN


def _write(options: argparse.Namespace) -> "tuple[Machine, Report] | int":
    """Write a report, or say what stands in the way and return the exit code."""
    with interrupt_held_back():
        from cammotion.exchange.machine_files import read_machine
        from cammotion.files import remedy
        from cammotion.quantities import InputError, WrongAnswerError
        from cammotion.report.writing import write_report
    try:
        machine = read_machine(options.machine)
    except InputError as wrong:
        print(wrong, file=sys.stderr)
        return BAD_INPUT
    with interrupt_held_back():
        importlib.import_module("scipy.optimize")
    try:
        report = write_report(
            machine, options.folder, seconds=options.seconds, dxf=options.dxf, progress=show_bar
        )
    except (InputError, WrongAnswerError) as wrong:
        print(f"\n{wrong}", file=sys.stderr)
        return FAILED
    except OSError as wrong:
        why, todo = wrong.strerror or wrong, remedy(wrong, "give another folder with --work")
        print(f"\nThe report cannot be written ({why}): {todo}.", file=sys.stderr)
        return FAILED
    return machine, report


def show_bar(share: float, what: str) -> None:
    """Show how far it is, in one line of a terminal or in a line each."""
    done = round(_BAR * share)
    line = f"[{'#' * done}{'.' * (_BAR - done)}] {what}"
    if sys.stderr.isatty():
        print(f"\r{line[:_WIDTH]:<{_WIDTH}}", end="\n" if share == 1 else "", file=sys.stderr)
        sys.stderr.flush()
    else:
        print(line, file=sys.stderr)


if __name__ == "__main__":
    sys.exit(main())
