"""One at a time: two notebooks of a learner, which are two processes, may write at once.

The locks are those of the package filelock. The first kind is the operating system's, which is
given back when a process is killed. Folders that know none, as on some network drives, take the
second: a file that names its process, and is removed by the next one when that is gone.
"""

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

_PAUSE_S = 0.01


@contextmanager
def only_one(file: Path, patience_s: float) -> Iterator[None]:
    """Hold the lock of a file, which is made if need be and stays there, empty.

    Raises TimeoutError if another one holds it for as long as `patience_s`, and another OSError
    where neither kind of lock can be had, as in a folder that may only be read.
    """
    if not file.parent.is_dir():  # which the package would make
        raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), str(file.parent))
    from filelock import FileLock, SoftFileLock  # here: 30 ms that no import has to wait for

    lock: FileLock | SoftFileLock = FileLock(file)
    try:
        lock.acquire(patience_s, poll_interval=_PAUSE_S)
    except TimeoutError:
        raise
    except (OSError, NotImplementedError):
        lock = SoftFileLock(file.with_name(f"{file.name}-soft"))
        lock.acquire(patience_s, poll_interval=_PAUSE_S)
    try:
        yield
    finally:
        lock.release()
