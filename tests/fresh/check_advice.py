"""Checks of what to change first: each gain is there, nothing stands less, no rule is worse off."""

import numpy as np

import cammotion as cm
from fresh.drawing import Machine, Rng
from fresh.sampling import Tracks, excesses, tracks_of, worst

NEAR_MM = 1e-5
EVEN = np.arange(0, 360, 0.01)
WORSE_MM, WORSE_SHARE = 0.05, 1e-3  # by samples
NEAR = 1e-4  # as a share
STANDS_MM = 1e-7


def advised(machine: Machine) -> None:
    """Ask what to change in a machine, whose rules may be broken, and try each change."""
    diagram, rng = machine.diagram, machine.rng
    given = cm.Machine("drawn", diagram, machine.rules, _still(diagram, rng))
    before = tracks_of(diagram)
    for one in cm.improvements(given):
        changed = one.machine.diagram
        after, told = tracks_of(changed), f"{one}"
        speed = 360 / changed.cycle_time_s
        peak = after[one.mechanism].peak(2, speed)
        assert np.isclose(one.after, peak, rtol=1e-3), f"{told}: {peak} m/s²"
        assert one.mends or peak < before[one.mechanism].peak(2, speed), f"{told}: no gain"
        _check_rules(given, before, after, told)
        _check_stands(given, changed, told)


def _still(diagram: cm.TimingDiagram, rng: Rng) -> dict[str, list[tuple[float, float]]]:
    """Return arcs in the dwells of some mechanisms."""
    still = {}
    for motion in diagram.motions:
        dwells = [s for s in motion.segments if s.is_dwell and s.to_deg - s.from_deg > 1]
        if dwells and rng.random() < 0.5:
            chosen = dwells if rng.random() < 0.5 else dwells[:1]
            still[motion.name] = [(s.from_deg + 0.2, s.to_deg - 0.2) for s in chosen]
    return still


def _check_rules(given: cm.Machine, before: Tracks, after: Tracks, told: str) -> None:
    for rule in given.rules:
        assert isinstance(rule, cm.ClearanceRule)
        if worst(rule, before)[0] < NEAR_MM:
            now = worst(rule, after)[0]
            assert now < NEAR_MM, f"{told}: {rule}, broken by {now} mm"
            continue
        (depth, share), (deeper, more) = _broken(rule, before), _broken(rule, after)
        assert deeper < depth + WORSE_MM, f"{told}: {rule}, {deeper} mm, not {depth}"
        assert more < share + WORSE_SHARE, f"{told}: {rule}, over {more} of the turn, not {share}"


def _broken(rule: cm.ClearanceRule, tracks: Tracks) -> tuple[float, float]:
    """Return how far one half goes too far where the other does not hold, and for how long."""
    when, other = excesses(rule, tracks, EVEN)
    here = (when > 0) & (other > 0)
    return float(np.max(when[here], initial=0.0)), float(here.mean())


def _check_stands(given: cm.Machine, changed: cm.TimingDiagram, told: str) -> None:
    for name, arcs in given.still.items():
        for start, end in arcs:
            off = np.ptp(changed[name].offset_mm(np.linspace(start, end, 40)))
            assert off < STANDS_MM, f"{told}: the {name} goes {off} mm in its still arc"
