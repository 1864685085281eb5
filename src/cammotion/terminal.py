"""Text that any terminal shows, whatever letters it lacks."""

import io
import sys


def suit_any_terminal() -> None:
    """Let what is printed appear line by line, with a ? for a letter that the terminal lacks."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace", line_buffering=True)
