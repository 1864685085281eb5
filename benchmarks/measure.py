"""Measure what the README promises: ``python benchmarks/measure.py --help`` says how.

Run it with the workbook's own Python, the one in .venv. Ratios are of two things measured by
turns within one run, so that they mean the same on any machine.
"""

import argparse
import sys
from collections.abc import Callable

from accessibility import measure_accessibility
from advice import measure_advice
from animation import measure_animation
from browsers import measure_browsers, measure_browsers_hub, measure_browsers_ten
from cams import measure_cams, measure_rival_cams
from class_server import measure_hub
from curves import measure_factors, measure_lines
from dynamics import measure_residuals, measure_response
from exercises import measure_exercises, measure_shown
from findings import Finding
from laws import measure_first_use, measure_laws, measure_rival
from limits import measure_limits
from live import measure_live
from many import measure_many
from overlap import measure_overlap
from package import measure_import, measure_lesson, measure_setup, measure_test
from pages import measure_site, measure_site_accessibility
from questions import measure_again
from round_trip import measure_round_trips
from starting import measure_install, measure_start
from where import describe
from whole_machine import measure_whole_machine

MEASURES: dict[str, Callable[[], list[Finding]]] = {
    "accessibility": measure_accessibility,
    "advice": measure_advice,
    "again": measure_again,
    "animation": measure_animation,
    "browsers": measure_browsers,
    "browsers-ten": measure_browsers_ten,
    "browsers-hub": measure_browsers_hub,
    "cams": measure_cams,
    "cams-rival": measure_rival_cams,
    "exercises": measure_exercises,
    "hub": measure_hub,
    "import": measure_import,
    "install": measure_install,
    "law": measure_laws,
    "law-rival": measure_rival,
    "factors": measure_factors,
    "first-use": measure_first_use,
    "lesson": measure_lesson,
    "lines": measure_lines,
    "limits": measure_limits,
    "live": measure_live,
    "many": measure_many,
    "overlap": measure_overlap,
    "round-trip": measure_round_trips,
    "setup": measure_setup,
    "residuals": measure_residuals,
    "response": measure_response,
    "shown": measure_shown,
    "site": measure_site,
    "site-accessibility": measure_site_accessibility,
    "start": measure_start,
    "test": measure_test,
    "whole-machine": measure_whole_machine,
}
ROW = "{:<72} {:>10} {:>16}  {}"


def describe_measures() -> str:
    """Return a line for each measure."""
    wide = max(map(len, MEASURES)) + 1
    lines = (f"  {name:<{wide}}{measure.__doc__}" for name, measure in MEASURES.items())
    return "\n".join(["measures:", *lines])


def parse_arguments() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(
        description="Measure what the README promises.",
        epilog=describe_measures(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("names", nargs="*", metavar="measure", help="which to take (all)")
    parser.add_argument("--check", action="store_true", help="exit with 1 if a limit is passed")
    options = parser.parse_args()
    options.names = options.names or [*MEASURES]
    if unknown := [name for name in options.names if name not in MEASURES]:
        parser.error(f"there is no measure {', '.join(unknown)}: choose from {', '.join(MEASURES)}")
    return options


def print_row(finding: Finding) -> None:
    """Print a finding as a row of the table."""
    bound = "at least" if finding.at_least else "at most"
    value, limit = (f"{number:.3g} {finding.unit}" for number in (finding.value, finding.limit))
    print(ROW.format(finding.what, value, f"{bound} {limit}", "ok" if finding.ok else "over"))


def main() -> int:
    """Take the measures and print the table, row by row as they come."""
    options = parse_arguments()
    print(describe(), end="\n\n")
    print(ROW.format("measure", "value", "limit", "verdict"), flush=True)
    all_ok = True
    for name in options.names:
        print(f"measuring {name}", file=sys.stderr, flush=True)
        findings = MEASURES[name]()
        for finding in findings:
            print_row(finding)
        sys.stdout.flush()
        all_ok &= all(finding.ok for finding in findings)
    return 1 if options.check and not all_ok else 0


if __name__ == "__main__":
    sys.exit(main())
