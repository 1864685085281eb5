"""Checks of limits that are as high as parts rest: nothing found at random beats the best."""

from resting import Resting, draw, search

import cammotion as cm
from fresh.drawing import Machine

STEPS, SECONDS, SHORT_S = 1500, 10.0, 1.5
NEAR = 1e-4  # as a share


def rests(machine: Machine) -> None:
    """Draw a machine of which a limit is as high as a dwell, and look for its best moves."""
    rng = machine.rng
    given = draw(rng)
    diagram, rules, still = given.diagram, given.made_rules(), given.still
    assert cm.find_violations(diagram, rules) == (), f"kept, but not so told: {given}"
    found = cm.optimise(diagram, rules, still=still, seconds=SECONDS)
    best = given.design(search(given, rng, STEPS))
    reached = _peak(given, best)
    assert given.is_kept(given.times(found.design)), f"broken: {given}, {found}"
    assert found.reached <= reached * (1 + NEAR), f"{found}, but {reached}: {given}, {best}"
    if rng.random() < 0.3:
        try:
            least = cm.least_peak(diagram, rules, still=still, gap=0.3, seconds=SHORT_S).bound
        except cm.InputError as refusal:  # of a turret that stands at a pause alone
            if "none of its stops" not in str(refusal):
                raise
            least = 0.0
        assert least <= min(reached, found.reached) * (1 + NEAR), f"{least}: {given}"
    if rng.random() < 0.3:
        loads = {part.name: cm.FollowerLoad(mass_kg=rng.uniform(1, 50)) for part in given.parts}
        shaft = cm.Camshaft(diagram, loads)
        eased = cm.optimise(shaft, rules, still=still, minimise="torque", seconds=SHORT_S)
        assert given.is_kept(given.times(eased.design)), f"broken: {given}, {eased}"


def _peak(given: Resting, design: cm.TimingDiagram) -> float:
    return max(design.peak_acceleration(name) for name in given.still)
