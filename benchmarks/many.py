"""What pictures of many mechanisms and of long names cost."""

import sys
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import cast

import matplotlib as mpl
from findings import Finding, ratio_of_medians, say
from matplotlib import pyplot as plt

sys.path.append(str(Path(__file__).parent.parent / "tests"))

from cartons import packaging_machine

import cammotion as cm
from cammotion.views.pictures import PictureFigure, describe

ROUNDS = 9
MANY, FEW = 24, 2
LONG, SHORT = "n" * 10_000, "n" * 20


def measure_many() -> list[Finding]:
    """Draw machines of 24 mechanisms and of 2, of long names and of short ones, by turns."""
    mpl.use("agg")
    many, few = packaging_machine(MANY), packaging_machine(FEW)
    long, short = (packaging_machine(MANY, [name]) for name in (LONG, SHORT))
    plots = by_turns(draw, many, few, long, short)
    moving = by_turns(lambda machine: cm.animate(machine).svg, long, short)
    say(f"medians: {median(plots[0]):.2f} s for {MANY} mechanisms, {median(plots[1]):.2f} s for 2")
    return [
        Finding(f"timing diagram of {MANY} mechanisms, drawn and told", min(plots[0]), 0.6, "s"),
        Finding(f"  : that of {FEW}", ratio_of_medians(plots[0], plots[1]), 6, "x"),
        Finding(
            "a name of 10,000 letters : one of 20, in a timing diagram",
            *(ratio_of_medians(plots[2], plots[3]), 1.15, "x"),
        ),
        Finding("  in the machine in motion", ratio_of_medians(moving[0], moving[1]), 1.25, "x"),
    ]


def draw(machine: cm.TimingDiagram) -> None:
    """Do what a notebook does with a timing diagram: its picture, and its words."""
    figure = cast(PictureFigure, cm.plot_timing(machine).figure)
    figure.png()
    describe(figure)
    plt.close(figure)


def by_turns(
    call: Callable[[cm.TimingDiagram], object], *machines: cm.TimingDiagram
) -> list[list[float]]:
    """Return the times in s for each machine, taken by turns after one that is not counted.

    It is the processor's time: one thread draws, and what else runs here does not count.
    """
    times: list[list[float]] = [[] for _ in machines]
    for number in range(ROUNDS + 1):
        for machine, spent in zip(machines, times, strict=True):
            started = time.process_time()
            call(machine)
            if number:
                spent.append(time.process_time() - started)
    return times
