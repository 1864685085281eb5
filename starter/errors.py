"""A foreseen failure, and what the operating system refuses, in words."""

import errno
from pathlib import Path

from starter import reasons
from starter.paths import ROOT

CLOSED = (errno.EACCES, errno.EPERM, errno.EROFS)  # only to be read


class WorkbookError(Exception):
    """A foreseen failure: its text is what the user reads."""


def incomplete(what: str) -> WorkbookError:
    """Say that the download lacks something."""
    return WorkbookError(f"{what}: this copy of the workbook is incomplete. Download it again.")


def explain_os_error(error: OSError) -> str:
    """Say in words what the operating system refused, and what to do."""
    if error.errno in (errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)):
        return reasons.DISK_FULL
    if error.errno in CLOSED:
        place = Path(str(error.filename or ROOT))
        if place.suffix == ".part":  # a name that means nothing to the reader
            place = place.parent
        return (
            f"No permission to write {place}. Close what uses it, or put the "
            "workbook into a folder of your own, and start again."
        )
    return reasons.find(str(error)) or f"The operating system refused: {error}"
