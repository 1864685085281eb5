"""What was downloaded: whether it is whole, and what environment.txt pins."""

import contextlib
import re
import tomllib
from typing import Any

from starter.errors import incomplete
from starter.paths import ENVIRONMENT, LAB_SETTING, NOTEBOOKS, PACKAGE, PROJECT, ROOT, SERVER_SWITCH

ENTRY = r"^([\w.-]+)(==.+)((?:\n +#.*)*)"


def check() -> None:
    """Refuse to work with half a workbook."""
    pinned_packages()
    for path in (PROJECT, PACKAGE, NOTEBOOKS, SERVER_SWITCH, LAB_SETTING):
        if not path.exists():
            raise incomplete(f"{path.relative_to(ROOT)} is missing")


def pinned_packages(whole: bool = True) -> set[str]:
    """Read the names of the packages that environment.txt pins."""
    return {name for name, _, _ in entries(whole)}


def requirements(whole: bool) -> list[str]:
    """Return what an installer is to install: all that environment.txt pins, or the learner's."""
    if whole:
        return ["-r", ENVIRONMENT.name]
    itself = re.findall(r"^-e (.+)$", ENVIRONMENT.read_text(encoding="utf-8"), re.MULTILINE)
    return [*(f"--editable={path}" for path in itself), *(n + pin for n, pin, _ in entries(whole))]


def entries(whole: bool) -> list[tuple[str, str, set[str]]]:
    """Read environment.txt: of each package its name, its pin, and who asks for it.

    Without `whole` those are left out that only the tests ask for.
    """
    text = ""
    with contextlib.suppress(OSError, UnicodeDecodeError):
        text = ENVIRONMENT.read_text(encoding="utf-8")
    found = [
        (name, pin, set(re.findall(r"([\w.-]+)$", comments, re.MULTILINE)))
        for name, pin, comments in re.findall(ENTRY, text, re.MULTILINE)
    ]
    if not found:
        raise incomplete("environment.txt is missing or unreadable")
    return found if whole else learners(found)


def learners(found: list[tuple[str, str, set[str]]]) -> list[tuple[str, str, set[str]]]:
    """Return the entries without those that only the tests ask for, step by step."""
    for_tests = only_for_tests()
    kept: set[str] = set()
    more = {n for n, _, by in found if not by or (PACKAGE.name in by and n not in for_tests)}
    while more:
        kept |= more
        more = {name for name, _, by in found if by & kept} - kept
    return [entry for entry in found if entry[0] in kept]


def only_for_tests() -> set[str]:
    """Read which packages pyproject.toml names for the tests alone."""
    project: dict[str, Any] = {}
    with contextlib.suppress(OSError, ValueError):
        project = tomllib.loads(PROJECT.read_text(encoding="utf-8")).get("project", {})
    extras = project.get("optional-dependencies", {})
    lists = [extras.get("test", []), [*project.get("dependencies", []), *extras.get("lab", [])]]
    tests, others = ({re.split(r"[^\w.-]", one)[0] for one in names} for names in lists)
    return tests - others
