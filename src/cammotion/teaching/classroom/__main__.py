"""What ``workbook.py class FOLDER`` runs: read the files, write the page, say what is with both.

What takes long to load is loaded within `main` and `_write`, which answer Ctrl-C then, too.
"""

import argparse
import os
import sys
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from cammotion.terminal import interrupt_held_back, suit_any_terminal


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the page of a class; what stands in the way is said in a sentence."""
    parser = argparse.ArgumentParser(prog="workbook.py class")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--output", type=Path, default=Path("class.html"))
    parser.add_argument("--anonymous", action="store_true")
    parser.add_argument("--overwrite", action="store_true")
    options = parser.parse_args(arguments)
    suit_any_terminal()
    try:
        with interrupt_held_back():
            from cammotion.quantities import InputError
        try:
            lines = _write(options.folder, options.output, options.anonymous, options.overwrite)
        except InputError as wrong:
            print(wrong, file=sys.stderr)
            return 1
    except KeyboardInterrupt:
        print("\nStopped. Nothing was written.", file=sys.stderr)
        return 130
    for line in lines:
        print(line)
    return 0


def _write(folder: Path, output: Path, anonymous: bool, overwrite: bool) -> list[str]:
    """Write the page, and return what is to be said; raise InputError if it cannot be."""
    with interrupt_held_back():
        from cammotion.files import write_new
        from cammotion.quantities import InputError, plural
        from cammotion.teaching.classroom import page
        from cammotion.teaching.classroom.clean import clean
        from cammotion.teaching.classroom.collect import read_class

    written = Path(os.path.realpath(output))  # a link to itself is no error here
    if written.suffix.casefold() != ".html":  # a file that is read ends in .json
        raise InputError(
            f"The page of the class is {clean(str(output), 200)}, which is no name of a page: give "
            "one that ends in .html with --output."
        )
    school = read_class(folder)  # first: an old page must not hide that there is no such folder
    if os.path.lexists(output) and not overwrite:
        raise InputError(
            f"The file {clean(str(output), 200)} is there already and was left as it is: give "
            "another name with --output, or add --overwrite."
        )
    shown = school.anonymous() if anonymous else school
    write_new(output, page.write(shown, date.today()), overwrite=overwrite)
    students = plural(len(school.students), "student")
    return [*school.notices, f"{output} shows {students}. Open it in a browser."]


if __name__ == "__main__":
    sys.exit(main())
