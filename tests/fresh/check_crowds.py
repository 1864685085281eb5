"""Checks of machines whose parts pay for each other: nothing found beats a bound or the best."""

from typing import Any

from crowds import LAWS, Crowd, designs, draw, draw_any, keeps

import cammotion as cm
from fresh.drawing import Machine, Rng

GAP, SECONDS, TORQUE_S = 0.1, 4.0, 3.0
CELLS = 90
NEAR = 1e-4  # as a share


def crowds(machine: Machine) -> None:
    """Draw a crowd, and look for its least peak, for its best diagram or for its least torque."""
    rng = machine.rng
    check = [_peaks, _any_rules, _torques][rng.integers(3)]
    check(rng)


def _peaks(rng: Rng) -> None:
    crowd = draw(rng, int(rng.integers(2, 6)))
    others = [_peak(design) for design in designs(crowd, rng) if keeps(crowd, design)]
    found = _least_peak(crowd)
    assert found.bound <= min(others) * (1 + NEAR), f"{found.bound}, but {min(others)} can be"
    assert found.reached <= min(others) * (1 + NEAR), f"{found.reached}, but {min(others)} can be"
    best = cm.optimise(crowd.diagram, crowd.rules, still=crowd.still, laws=LAWS, seconds=SECONDS)
    assert cm.find_violations(best.design, crowd.rules) == ()
    assert found.bound <= best.reached * (1 + NEAR), f"{found.bound} is above {best.reached}"
    assert best.reached <= min(others) * (1 + NEAR), f"{best.reached}, but {min(others)} can be"


def _any_rules(rng: Rng) -> None:
    """Make each part in turn as good as it can be beside the others."""
    crowd = draw_any(rng)
    if not crowd.rules:
        return
    found = _least_peak(crowd)
    design = found.design or crowd.diagram
    others = [_peak(crowd.diagram), _peak(design)]
    for name in design.names:
        own = [r for r in crowd.rules if name in {r.when.motion, r.only_while.motion}]
        if own:
            asked: dict[str, Any] = {"still": crowd.still[name], "cells": CELLS}
            travel = crowd.travel_mm.get(name)
            design = cm.least_acceleration(design, name, own, travel_mm=travel, **asked).design
            others.append(_peak(design))
    assert found.bound <= min(others) * (1 + NEAR), f"{found.bound}, but {min(others)} can be"


def _torques(rng: Rng) -> None:
    crowd = draw(rng, int(rng.integers(2, 6)))
    masses = {name: float(rng.uniform(1, 50)) for name in crowd.diagram.names}
    loads = {name: cm.FollowerLoad(mass_kg=mass) for name, mass in masses.items()}
    shaft = cm.Camshaft(crowd.diagram, loads)
    asked: dict[str, Any] = {"still": crowd.still, "laws": LAWS, "seconds": TORQUE_S}
    found = cm.optimise(shaft, crowd.rules, minimise="torque", **asked)
    assert keeps(crowd, found.design)
    peak = cm.optimise(crowd.diagram, crowd.rules, **asked).design
    other = abs(cm.Camshaft(peak, loads).peak_torque().value)
    assert found.reached <= other * (1 + NEAR), f"{found.reached} N m, but {other} can be"


def _least_peak(crowd: Crowd) -> cm.LeastPeak:
    found = cm.least_peak(
        crowd.diagram,
        crowd.rules,
        still=crowd.still,
        travel_mm=crowd.travel_mm,
        gap=GAP,
        seconds=SECONDS,
    )
    assert found.bound <= found.reached * (1 + NEAR)
    assert found.design is None or keeps(crowd, found.design)
    return found


def _peak(design: cm.TimingDiagram) -> float:
    return max(design.peak_acceleration(name) for name in design.names)
