"""What ``workbook.py site`` runs: build the pages, write the folder, say where it is."""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from cammotion.quantities import InputError
from cammotion.site import folder
from cammotion.site.build import build
from cammotion.terminal import suit_any_terminal

_MB = 1e6


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the folder of pages; what stands in the way is said in a sentence."""
    parser = argparse.ArgumentParser(prog="workbook.py site")
    parser.add_argument("notebooks", type=Path, metavar="NOTEBOOKS")
    parser.add_argument("folder", type=Path, metavar="FOLDER")
    parser.add_argument("--home", default="", metavar="URL")
    options = parser.parse_args(arguments)
    suit_any_terminal()
    try:
        return _write(options.notebooks, options.folder, options.home)
    except InputError as wrong:
        print(wrong, file=sys.stderr)
    return 1


def _write(notebooks: Path, target: Path, home: str) -> int:
    folder.check_free(target)  # before the work is done
    started = time.monotonic()
    files = build(notebooks, home)
    folder.write(target, files)
    pages = sum(name.endswith(".html") for name in files)
    size = sum(map(len, files.values())) / _MB
    print(f"{pages} pages, {size:.1f} MB, in {time.monotonic() - started:.0f} s.")
    print(f"Open {target / 'index.html'} in a browser, or put the folder on any web server.")
    return 0


if __name__ == "__main__":
    sys.exit(main())
