"""Start the tests from fresh seeds: ``python3 workbook.py test --fresh`` runs this file."""

import sys

from fresh.runner import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
