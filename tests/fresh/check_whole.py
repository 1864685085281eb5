"""Checks of the whole machine: its best diagram, and what no motions of its parts are below."""

from typing import Any

import numpy as np

import cammotion as cm
from cammotion import InputError, TimingDiagram
from fresh.drawing import Machine
from fresh.sampling import track_of, tracks_of, worst_of

NEAR_MM = 1e-5
NEAR = 1e-4  # of an acceleration, as a share
NEAR_TORQUE, TINY = 1e-2, 1e-9  # what samples may miss
STEP_DEG, IN_A_MOVE = 0.01, 4001  # also in one of a degree, with a jump at its largest velocity
SECONDS, TORQUE_S = 4.0, 3.0
LONG_DEG = 0.5
NEAR_DEG = 1e-6
Arcs = dict[str, list[tuple[float, float]]]


def whole(machine: Machine) -> None:
    """See that nothing beats the bound, and that the best diagram is as good as any found here."""
    diagram = machine.diagram
    rules, still = _asked(machine)
    if not rules or not still:
        return
    try:
        found = cm.least_peak(diagram, rules, still=still, gap=0.02, seconds=SECONDS)
    except InputError as refusal:  # of a turret that stands at a pause alone
        if "none of its stops" not in str(refusal):
            raise
        found = None
    widened = _one_after_the_other(diagram, rules, still)
    known = [_peak(design, still) for design in (diagram, *widened)]
    try:
        best = cm.optimise(diagram, rules, still=still, seconds=SECONDS)
    except InputError as refusal:  # laws that do not rest at their ends
        if "rest" not in str(refusal):
            raise
    else:
        _keeps(diagram, best.design, rules, still)
        assert best.reached <= min(known) * (1 + NEAR), f"{best.reached}, but {min(known)} can be"
        assert best.bound <= known[0], f"today's {known[0]} is below the bound {best.bound}"
        _take_what_is_there(widened[0], rules, still)
        known.append(best.reached)
    if found is None:
        return
    assert found.bound <= min(known) * (1 + NEAR), f"no motions below {found.bound}: {min(known)}"
    if found.design is not None:
        _keeps(diagram, found.design, rules, still)
        assert found.bound <= found.reached * (1 + NEAR)
        assert np.isclose(_peak(found.design, still), found.reached)


def torques(machine: Machine) -> None:
    """See that the least torque is what samples say, with all rules kept, and no worse than others.

    The others are today's machine and the one with the least peak.
    """
    diagram, rng = machine.diagram, machine.rng
    rules, still = _asked(machine)
    masses = {m.name: float(rng.uniform(1, 50)) for m in diagram.motions if not m.steps(1)}
    if not still or not masses:
        return
    shaft = cm.Camshaft(diagram, {n: cm.FollowerLoad(mass_kg=kg) for n, kg in masses.items()})
    asked: dict[str, Any] = {"still": still, "seconds": TORQUE_S}
    try:
        peak = cm.optimise(diagram, rules, **asked)
        best = cm.optimise(shaft, rules, minimise="torque", **asked)
    except InputError as refusal:
        if "rest" not in str(refusal):
            raise
        return
    _keeps(diagram, best.design, rules, still)
    known = [_torque(design, masses) for design in (best.design, diagram, peak.design)]
    for other in known:
        assert best.reached <= other * (1 + NEAR_TORQUE) + TINY, f"{best.reached}, {other} can be"
    assert best.reached >= known[0] * (1 - NEAR) - TINY, f"{best.reached} is less than {known[0]}"


def _torque(diagram: TimingDiagram, masses: dict[str, float]) -> float:
    """Return the largest torque of masses in N m, among close samples."""
    tracks = tracks_of(diagram)
    moves = [piece for track in tracks.values() for piece in track.pieces if piece.law]
    within = [np.linspace(piece.from_deg, piece.to_deg, IN_A_MOVE) % 360 for piece in moves]
    angles = np.concatenate([np.arange(0, 360, STEP_DEG) + STEP_DEG / 3, *within])
    per_s, total = diagram.rate_per_hour / 10, np.zeros(len(angles))
    for name, track in tracks.items():
        if name in masses:
            push = masses[name] * track.curve(2, angles) * per_s**2 / 1000
            total += push * track.curve(1, angles) * 180 / np.pi / 1000
    return float(np.abs(total).max())


def _asked(machine: Machine) -> tuple[list[cm.ClearanceRule], Arcs]:
    """Return the rules that a machine keeps, and where those of its motions rest that move."""
    diagram = machine.diagram
    tracks = tracks_of(diagram)
    rules = [rule for rule in machine.rules if worst_of([rule], tracks) < -NEAR_MM]
    still = {
        motion.name: arcs
        for motion in diagram.motions
        if motion.moves and (arcs := _stands(motion))
    }
    return rules, still


def _stands(motion: cm.Motion) -> list[tuple[float, float]]:
    """Return where a motion rests, as said of it."""
    return [
        (piece.from_deg, piece.to_deg)
        for piece in track_of(motion).pieces
        if piece.law is None and piece.to_deg - piece.from_deg > LONG_DEG
    ]


def _peak(diagram: TimingDiagram, still: Arcs) -> float:
    """Return the largest peak of the free motions; the check of peaks holds these to samples."""
    return max(diagram.peak_acceleration(name) for name in still)


def _one_after_the_other(
    diagram: TimingDiagram, rules: list[cm.ClearanceRule], still: Arcs
) -> list[TimingDiagram]:
    """Return diagrams in which one move after the other is widened, until it touches another."""
    designs = []
    for order in (list(still), list(still)[::-1]):
        design = diagram
        for name in order:
            try:
                wider = cm.widest_move(design, name, rules).diagram
            except InputError:
                continue
            if all(_covers(_stands(wider[one]), arc) for one in still for arc in still[one]):
                design = wider
        designs.append(design)
    return designs


def _take_what_is_there(design: TimingDiagram, rules: list[cm.ClearanceRule], still: Arcs) -> None:
    """See that a diagram whose arcs touch is no worse than itself, with its peaks as limits."""
    limits = {name: design.peak_acceleration(name) for name in still}
    again = cm.optimise(design, rules, still=still, at_most=limits, seconds=SECONDS)
    _keeps(design, again.design, rules, still)
    own = max(limits.values())
    assert again.bound <= own, f"the bound {again.bound} is above {own}, which is there"
    assert again.reached <= own * (1 + NEAR_DEG), f"{again.reached}, but {own} is there"


def _covers(stands: list[tuple[float, float]], arc: tuple[float, float]) -> bool:
    """Whether one of the arcs over which a motion stands has another in it."""
    start, end = arc
    return any(
        (start - first + NEAR_DEG) % 360 + end - start <= last - first + 2 * NEAR_DEG
        for first, last in stands
    )


def _rests(design: TimingDiagram, before: TimingDiagram, name: str, arcs: list[Any]) -> bool:
    """Whether a motion stands over its arcs where it did before."""
    own, other = track_of(design[name]), track_of(before[name])
    for start, end in arcs:
        angles = np.linspace(start, end, 41)
        off = own.curve(0, angles) - other.curve(0, angles)
        if own.pitch_mm:  # it may be counted from another stop
            off -= own.pitch_mm * np.round(off / own.pitch_mm)
        if np.abs(off).max() > NEAR_MM:
            return False
    return True


def _keeps(
    before: TimingDiagram, design: TimingDiagram, rules: list[cm.ClearanceRule], still: Arcs
) -> None:
    broken = worst_of(rules, tracks_of(design))
    assert broken <= NEAR_MM, f"a rule is broken by {broken} mm"
    for name, arcs in still.items():
        assert _rests(design, before, name, arcs), f"{name} does not stand over {arcs}"
