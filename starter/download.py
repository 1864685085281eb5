"""What was downloaded: whether it is whole, and what environment.txt pins."""

import contextlib
import re

from starter.errors import incomplete
from starter.paths import ENVIRONMENT, LAB_SETTING, NOTEBOOKS, PACKAGE, PROJECT, ROOT, SERVER_SWITCH


def check() -> None:
    """Refuse to work with half a workbook."""
    pinned_packages()
    for path in (PROJECT, PACKAGE, NOTEBOOKS, SERVER_SWITCH, LAB_SETTING):
        if not path.exists():
            raise incomplete(f"{path.relative_to(ROOT)} is missing")


def pinned_packages() -> set[str]:
    """Read the names of the packages that environment.txt pins."""
    text = ""
    with contextlib.suppress(OSError, UnicodeDecodeError):
        text = ENVIRONMENT.read_text(encoding="utf-8")
    names = set(re.findall(r"^([\w.-]+)==", text, re.MULTILINE))
    if not names:
        raise incomplete("environment.txt is missing or unreadable")
    return names
