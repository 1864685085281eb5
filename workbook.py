"""Set the workbook up, open it, test it: ``python3 workbook.py --help`` says how.

Standard library only, in syntax that Python 3.6 can parse: an old Python gets a sentence.
"""

import sys

if sys.version_info < (3, 11):  # noqa: UP036
    sys.exit(
        "This is Python {}.{} ({}), and the workbook needs Python 3.11 or later.\n"
        "Install one from https://www.python.org/downloads/ and start the workbook with it, "
        "for example: python3.12 workbook.py".format(*sys.version_info[:2], sys.executable)
    )

try:
    from starter.commands import main
except ImportError as missing:
    if not str(missing.name).startswith("starter"):
        raise
    sys.exit("The folder starter is not whole: download the workbook again.")
except KeyboardInterrupt:
    sys.exit("\nStopped before anything was done.")

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
