"""Text that any terminal shows, whatever letters it lacks, and when Ctrl-C is answered."""

import io
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


def suit_any_terminal() -> None:
    """Let what is printed appear line by line, with a ? for a letter that the terminal lacks."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace", line_buffering=True)


@contextmanager
def interrupt_held_back() -> Iterator[None]:
    """Answer an interrupt of the keyboard at the end; a second one is answered at once.

    Libraries in C make another error of one that comes while they are loaded, or are broken by it.
    Where it is not answered by Python itself, as in the background of a script, that stays so.
    """
    if signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    came = False

    def remember(*given: Any) -> None:
        nonlocal came
        if came:
            signal.default_int_handler(*given)
        came = True

    before = signal.signal(signal.SIGINT, remember)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
        if came:
            raise KeyboardInterrupt
