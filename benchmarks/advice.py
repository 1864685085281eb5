"""What it costs to look at a machine of one's own, and to write its report."""

import time
from dataclasses import replace
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

from findings import Finding, say
from whole_machine import machine_of

from cammotion import Machine, TimingDiagram, improvements, read_machine, write_report

DATA = Path(__file__).parent.parent / "notebooks" / "data" / "pad_press.csv"
MECHANISMS, RULES, ROUNDS = 12, 20, 7
LOOK_S, REPORT_S, REPORT_MB = 0.2, 5.0, 2.0


def measure_advice() -> list[Finding]:
    """Check and rank a machine of 12 mechanisms with 20 rules; write the report of a press."""
    looks = [look() for _ in range(ROUNDS + 1)][1:]
    with TemporaryDirectory() as folder:
        machine = read_machine(DATA)
        write_report(machine, folder, seconds=1)  # what is imported and compiled once
        started = time.process_time()
        report = write_report(machine, folder)
        seconds = time.process_time() - started
        megabytes = sum(file.stat().st_size for file in report.folder.rglob("*")) / 1e6
    say(f"the report of eight mechanisms: {seconds:.1f} s, {megabytes:.2f} MB")
    what = f"{MECHANISMS} mechanisms, {RULES} rules: diagram, checks and ranking"
    return [
        Finding(what, median(looks), LOOK_S, "s"),
        Finding("report of eight mechanisms, with its bound", seconds, REPORT_S, "s"),
        Finding("  : all its files", megabytes, REPORT_MB, "MB"),
    ]


def look() -> float:
    """Return the processor's time in s for a machine that nobody has looked at before."""
    diagram, rules, still = machine_of(MECHANISMS)
    motions = [replace(motion) for motion in diagram.motions]
    started = time.process_time()
    fresh = TimingDiagram(motions, diagram.rate_per_hour)
    machine = Machine("twelve", fresh, rules[:RULES], still)
    assert machine.violations == ()  # noqa: S101 - it is a part of what is measured
    improvements(machine)
    return time.process_time() - started
