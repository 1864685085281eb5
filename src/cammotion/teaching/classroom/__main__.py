"""What ``workbook.py class FOLDER`` runs: read the files, write the page, say what is with both."""

import argparse
import os
import sys
from collections.abc import Sequence
from datetime import date
from pathlib import Path

from cammotion.files import write_new
from cammotion.quantities import InputError, plural
from cammotion.teaching.classroom import page
from cammotion.teaching.classroom.clean import clean
from cammotion.teaching.classroom.collect import read_class
from cammotion.terminal import suit_any_terminal


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
        return _write(options.folder, options.output, options.anonymous, options.overwrite)
    except InputError as wrong:
        print(wrong, file=sys.stderr)
    return 1


def _write(folder: Path, output: Path, anonymous: bool, overwrite: bool) -> int:
    written = Path(os.path.realpath(output))  # a link to itself is no error here
    if written.suffix.casefold() != ".html":  # a file that is read ends in .json
        raise InputError(
            f"The page of the class is {clean(str(output), 200)}, which is no name of a page: give "
            "one that ends in .html with --output."
        )
    if os.path.lexists(output) and not overwrite:
        raise InputError(
            f"The file {clean(str(output), 200)} is there already and was left as it is: give "
            "another name with --output, or add --overwrite."
        )
    school = read_class(folder)
    shown = school.anonymous() if anonymous else school
    write_new(output, page.write(shown, date.today()), overwrite=overwrite)
    for notice in school.notices:
        print(notice)
    print(f"{output} shows {plural(len(school.students), 'student')}. Open it in a browser.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
