"""Text that others have typed, made fit for one line of a page."""

from typing import Any


def clean(text: Any, length: int = 40) -> str:
    r"""Return a text in one line, of signs that print, and not longer than it should be.

    What turns the direction of writing or moves the cursor is no sign that prints. It is not yet
    escaped for HTML. What is no text becomes "".

    >>> clean("  An\u202ena \n Groß\x07 ")
    'Anna Groß'
    """
    if not isinstance(text, str):
        return ""
    line = " ".join("".join(c for c in part if c.isprintable()) for part in text.split())
    line = " ".join(line.split())
    return line if len(line) <= length else line[: length - 1] + "…"
