"""One at a time: two notebooks of a learner, which are two processes, may write at once.

By the standard library: no package is needed for two calls of the operating system, and the lock
of a process that is killed is gone with it, as a file that only says "locked" is not.
"""

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

_PATIENCE_S = 5.0  # so long waits nobody: who holds it is not at work but stopped
_PAUSE_S = 0.01


@contextmanager
def only_one(file: Path) -> Iterator[None]:
    """Hold the lock of a file, which is made if need be and stays there, empty.

    After some seconds, and in a folder that knows no locks, go on without: what a learner does is
    kept all the same.
    """
    lock = None
    with suppress(OSError):
        lock = os.open(file, os.O_RDWR | os.O_CREAT)
    try:
        if lock is not None:
            _wait_for(lock)
        yield
    finally:
        if lock is not None:
            os.close(lock)  # which gives the lock back


def _wait_for(lock: int) -> None:
    end = time.monotonic() + _PATIENCE_S
    while not _take(lock) and time.monotonic() < end:
        time.sleep(_PAUSE_S)


def _take(lock: int) -> bool:
    """Take the lock; return False if another process, or another opening of the file, has it."""
    with suppress(OSError):
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(lock, msvcrt.LK_NBLCK, 1)
        else:
            import fcntl

            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        return True
    return False
