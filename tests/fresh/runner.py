"""Draw machines and check them until the time is up; print the seed of what is found.

The machine of a seed and a number is always the same one, and so is what a check does with it:
`--seed S --machine N --check NAME` runs one finding alone.
"""

import argparse
import secrets
import signal
import sys
import time
import traceback
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import count
from multiprocessing import Process, Queue
from queue import Empty
from types import FrameType
from typing import Any

from fresh import (
    check_advice,
    check_answers,
    check_cam_tables,
    check_cams,
    check_camshafts,
    check_contacts,
    check_crowds,
    check_damaged_tables,
    check_indexers,
    check_laws,
    check_limits,
    check_machines,
    check_measured,
    check_odd_machines,
    check_profiles,
    check_questions,
    check_reserves,
    check_responses,
    check_rests,
    check_rules,
    check_turrets,
    check_whole,
    check_widest,
)
from fresh.drawing import Machine, draw

Check = Callable[[Machine], None]

CHECKS: Mapping[str, Check] = {
    "positions": check_machines.positions,
    "ranges": check_machines.ranges,
    "peaks": check_machines.peaks,
    "violations": check_machines.violations,
    "widenings": check_widest.widenings,
    "widest": check_widest.widest,
    "each_way": check_widest.each_way,
    "reserves": check_reserves.reserves,
    "reserved": check_reserves.reserved,
    "advised": check_advice.advised,
    "distances": check_rules.distances,
    "standings": check_rules.standings,
    "tables": check_machines.tables,
    "odd_tables": check_odd_machines.odd_tables,
    "values": check_laws.values,
    "factors": check_laws.factors,
    "derived": check_laws.derived,
    "inverses": check_laws.inverses,
    "heights": check_laws.heights,
    "cam_tables": check_cam_tables.cam_tables,
    "damaged_tables": check_damaged_tables.damaged_tables,
    "profiles": check_profiles.profiles,
    "differences": check_measured.differences,
    "harmonics": check_measured.harmonics,
    "smoothings": check_measured.smoothings,
    "roundings": check_measured.roundings,
    "eccentrics": check_measured.eccentrics,
    "levelled": check_measured.levelled,
    "noisy": check_measured.noisy,
    "least": check_limits.least,
    "turrets": check_turrets.turrets,
    "whole": check_whole.whole,
    "crowds": check_crowds.crowds,
    "rests": check_rests.rests,
    "torques": check_whole.torques,
    "cams": check_cams.cams,
    "followers": check_cams.followers,
    "contacts": check_contacts.contacts,
    "camshafts": check_camshafts.camshafts,
    "indexers": check_indexers.indexers,
    "responses": check_responses.responses,
    "questions": check_questions.questions,
    "answers": check_answers.answers,
}
SELDOM = {
    "positions": 3,
    "reserves": 7,
    "advised": 7,
    "distances": 7,
    "whole": 7,
    "crowds": 15,
    "rests": 3,
    "turrets": 3,
    "contacts": 15,
    "camshafts": 3,
    "responses": 7,
}
"""Checks that take long: of one machine in so many. No number is even, as that of processes is."""
PROCESSES = 2
SECONDS = 1800.0  # half an hour, if nothing else is said
LONGEST = 120  # seconds for one check
SECONDS_BETWEEN_LINES = 10


@dataclass(frozen=True)
class Finding:
    """What a check has found."""

    machine: str  # the code, since what it builds does not go from process to process
    again: str
    trace: str

    def __str__(self) -> str:
        """Say how to run it again, and with what machine."""
        return f"FOUND: {self.again}\n{self.machine}\n{self.trace}"


def due(number: int) -> tuple[str, ...]:
    """Return the checks whose turn it is with the machine of this number."""
    return tuple(name for name in CHECKS if number % SELDOM.get(name, 1) == 0)


def examine(seed: str, number: int, names: tuple[str, ...]) -> list[Finding]:
    """Check one machine; return what is found."""
    machine = draw(seed, number)
    found = []
    for name in names:
        try:
            with _limited(LONGEST):
                CHECKS[name](machine)
        except (Exception, _TooLong):
            again = f"--seed {seed} --machine {number} --check {name}"
            found.append(Finding(machine.code, again, traceback.format_exc()))
    return found


def run(
    seed: str, seconds: float, *, names: tuple[str, ...] = (), processes: int = PROCESSES
) -> int:
    """Check machine after machine for so long; return 1 if anything is found.

    Without `names` all checks take part, each when it is due. With `processes` 0 it all runs in
    this one.
    """
    started, machines, findings = time.time(), 0, 0
    shown = started
    print(f"seed {seed}, {seconds:g} s", flush=True)
    with suppress(KeyboardInterrupt):
        for found in _in_turn(seed, started + seconds, names, processes):
            machines, findings = machines + 1, findings + len(found)
            for finding in found:
                print(f"\n{finding}", flush=True)
            now = time.time()
            if now - shown > SECONDS_BETWEEN_LINES:
                shown = now
                print(f"{_tell(machines, findings)}, {now - started:.0f} s", flush=True)
    print(_tell(machines, findings))
    return 1 if findings else 0


def _tell(machines: int, findings: int) -> str:
    return f"{machines} machine{'s' * (machines != 1)}, {findings} finding{'s' * (findings != 1)}"


def _in_turn(
    seed: str, end: float, names: tuple[str, ...], processes: int
) -> Iterator[list[Finding]]:
    """Yield what is found in each machine, as they are done, until the time is up."""
    if not processes:
        yield from _examined(seed, 0, 1, end, names)
        return
    results: Queue[list[Finding] | None] = Queue()
    workers = [
        Process(target=_work, args=(results, seed, n, processes, end, names), daemon=True)
        for n in range(processes)
    ]
    for worker in workers:
        worker.start()
    try:
        while workers:
            with suppress(Empty):
                found = results.get(timeout=1)
                if found is None:
                    processes -= 1
                else:
                    yield found
            if not processes:
                return
            if any(worker.exitcode for worker in workers):
                raise RuntimeError("A process has died at its work.")
    finally:
        for worker in workers:
            worker.terminate()


def _work(results: "Queue[list[Finding] | None]", *given: Any) -> None:
    """Put into a queue what is found, and None at the end; Ctrl-C is the other process's."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for found in _examined(*given):
        results.put(found)
    results.put(None)


def _examined(
    seed: str, first: int, step: int, end: float, names: tuple[str, ...]
) -> Iterator[list[Finding]]:
    for number in count(first, step):
        if time.time() >= end:
            return
        yield examine(seed, number, names or due(number))


class _TooLong(BaseException):
    """A check has taken too long."""


@contextmanager
def _limited(seconds: int) -> Iterator[None]:
    """End what takes too long, where the system can."""

    def stop(_signal: int, _frame: FrameType | None) -> None:
        raise _TooLong(f"not done after {seconds} s")

    if not hasattr(signal, "SIGALRM"):
        yield
        return
    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(seconds)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def main(arguments: list[str]) -> int:
    """Read the command line and run."""
    parser = argparse.ArgumentParser(description="Check machines that are drawn anew.")
    parser.add_argument("--seconds", type=float, default=SECONDS, help="how long (half an hour)")
    parser.add_argument("--seed", default="", help="any word, such as a commit; a new one if none")
    parser.add_argument("--machine", type=int, help="only the machine of this number")
    parser.add_argument("--check", action="append", choices=[*CHECKS], help="only this check")
    options = parser.parse_args(arguments)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    seed, names = options.seed or secrets.token_hex(4), tuple(options.check or ())
    if options.machine is None:
        return run(seed, options.seconds, names=names)
    found = examine(seed, options.machine, names or tuple(CHECKS))
    print(*found, _tell(1, len(found)), sep="\n")
    return 1 if found else 0
