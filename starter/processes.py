"""Children: listen to them, wait for them with a line of progress, end them; one at a time."""

import contextlib
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import IO

SECONDS_BETWEEN_LINES = 10
ASTRAY = ("PYTHONPATH", "PYTHONHOME")  # they lead a Python to packages that are not its own


def environ(**more: str) -> dict[str, str]:
    """Return the variables for a child, without those that lead its Python astray."""
    return {name: value for name, value in os.environ.items() if name not in ASTRAY} | more


def listen(stream: IO[str] | None, take: Callable[[str], object]) -> threading.Thread:
    """Hand the lines of a child's output to `take` as they come."""

    def read() -> None:
        for line in stream or ():
            take(line)

    reader = threading.Thread(target=read, daemon=True)
    reader.start()
    return reader


def wait_until(is_over: Callable[[], bool], describe: Callable[[], str]) -> None:
    """Wait, with one line that is updated on a terminal, and a line now and then elsewhere."""
    started = shown = time.monotonic()
    while not is_over():
        now = time.monotonic()
        line = f"      {describe()}, {now - started:.0f} s"
        if sys.stdout.isatty():
            print(f"\r{line[:78]:78}", end="", flush=True)
        elif now - shown >= SECONDS_BETWEEN_LINES:
            print(line)
            shown = now
        time.sleep(0.1)
    if sys.stdout.isatty():
        print(f"\r{'':78}", end="\r", flush=True)


def wait_for(process: "subprocess.Popen[str]") -> int:
    """Wait for a child on our terminal: Ctrl-C reaches it too, and is its own business."""
    previous = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        return process.wait()
    finally:
        stop(process)
        signal.signal(signal.SIGINT, previous)


def stop(process: "subprocess.Popen[str]", grace: float = 0) -> None:
    """End a child: wait `grace` seconds, ask it to end, in the end kill it."""
    for act, patience in ((process.poll, grace), (process.terminate, 10), (process.kill, None)):
        if process.poll() is None:
            act()
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(patience)


def tail(lines: list[str]) -> str:
    """Indent the last lines of a child's output."""
    return "".join(f"    {line.rstrip()[:200]}\n" for line in lines[-15:])


@contextlib.contextmanager
def only_one_in(folder: Path, other: str) -> Iterator[None]:
    """Let one of us at a time work in a folder, where the system can lock a folder."""
    if sys.platform == "win32":
        yield
        return
    import fcntl

    lock = os.open(folder, os.O_RDONLY)
    # The installer inherits the lock: if we are killed, it still holds it until it ends too.
    os.set_inheritable(lock, True)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        print(f"{other}: waiting until it ends.")
        fcntl.flock(lock, fcntl.LOCK_EX)
    except OSError:
        pass  # some network folders know no locks
    try:
        yield
    finally:
        os.close(lock)
