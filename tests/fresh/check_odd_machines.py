"""Checks of machines with any law and any name: as a table they are the same."""

from pathlib import Path
from tempfile import TemporaryDirectory

from odd_machines import draw, worst

import cammotion as cm
from fresh.drawing import Machine

NEAR = 1e-9


def odd_tables(machine: Machine) -> None:
    """Write a machine of one to five such mechanisms, and read it."""
    rng = machine.rng
    diagram = draw(rng, int(rng.integers(1, 6)))
    with TemporaryDirectory() as folder:
        back = cm.read_segments(cm.write_segments(diagram, Path(folder) / "m.csv"))
    off_mm, share = worst(diagram, back)
    assert off_mm <= NEAR, f"{diagram}: {off_mm} mm off"
    assert share <= NEAR, f"{diagram}: a peak is {share} off"
