"""Checks of what to change first: each gain is there, nothing stands less, no rule is worse off.

And that nothing is left out that helps: laws and wider moves are tried by brute force, by samples.
"""

from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from itertools import pairwise

import numpy as np

import cammotion as cm
from cammotion.rules.rule import Rule
from fresh.drawing import Machine, Rng
from fresh.sampling import Array, Piece, Track, Tracks, excesses, tracks_of, worst

NEAR_MM = 1e-5
EVEN, FINE = np.arange(0, 360, 0.01), np.arange(0, 360, 0.0005)
WORSE_MM, WORSE_SHARE = 0.05, 1e-3  # by samples
NEAR = 1e-4  # as a share
STANDS_MM = 1e-7
GAIN = 0.99  # of a peak: more than that may be no gain
TRIES = 25
SHARES = (1e-3, 0.02, 0.1, 0.4, 1.0)  # of its room, by which an end is put out


def advised(machine: Machine) -> None:
    """Ask what to change in a machine, whose rules may be broken, and try each change."""
    diagram, rng = machine.diagram, machine.rng
    rules = [_perhaps_broken(rule, diagram, rng) for rule in machine.rules]
    given = cm.Machine("drawn", diagram, rules, _still(diagram, rng))
    before = tracks_of(diagram)
    found = cm.improvements(given)
    _check_none_failed(found)
    for one in (*found, *found.left_out):
        changed = one.machine.diagram
        after, told = tracks_of(changed), f"{one}"
        speed = 360 / changed.cycle_time_s
        peak = after[one.mechanism].peak(2, speed)
        assert np.isclose(one.after, peak, rtol=1e-3), f"{told}: {peak} m/s²"
        assert one.mends or peak < before[one.mechanism].peak(2, speed), f"{told}: no gain"
        _check_rules(given, before, after, told)
        _check_stands(given, changed, told)
    _check_laws(found, before)
    _check_widths(found, before, rng)
    _check_the_best(given)


def _perhaps_broken(
    rule: cm.ClearanceRule, diagram: cm.TimingDiagram, rng: Rng
) -> cm.ClearanceRule:
    """Return a rule, half of them with a limit anywhere in the range, so that most are broken."""
    if rng.random() < 0.5:
        return rule
    half = rule.when
    low, high = diagram[half.motion].range_mm
    limit = round(float(rng.uniform(low, high)), 3)
    if diagram[half.motion].is_indexing:
        limit = round(float(rng.uniform(0, abs(diagram[half.motion].pitch_mm) / 2)), 3)
    made = cm.beyond if half.is_beyond else cm.within
    return replace(rule, when=made(half.motion, limit))


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


def _broken(rule: cm.ClearanceRule, tracks: Tracks, angles: Array = EVEN) -> tuple[float, float]:
    """Return how far one half goes too far where the other does not hold, and for how long."""
    when, other = excesses(rule, tracks, angles)
    here = (when > 0) & (other > 0)
    return float(np.max(when[here], initial=0.0)), float(here.mean())


def _check_stands(given: cm.Machine, changed: cm.TimingDiagram, told: str) -> None:
    for name, arcs in given.still.items():
        for start, end in arcs:
            off = np.ptp(changed[name].offset_mm(np.linspace(start, end, 40)))
            assert off < STANDS_MM, f"{told}: the {name} goes {off} mm in its still arc"


def _check_none_failed(found: cm.Improvements) -> None:
    """See that all that cannot be told is what a search was not made for."""
    wrong = [told for told in found.failed if "has checked its answer" in told]
    assert not wrong, wrong


def _check_the_best(given: cm.Machine) -> None:
    """See that what has to stand over a whole dwell is told nothing worse than what can be."""
    diagram = given.diagram
    still = {
        motion.name: [(first.to_deg, then.from_deg)]
        for motion in diagram.motions
        for first, then in pairwise(motion.moves[:2])
        if then.from_deg - first.to_deg > 1
    }
    found = cm.improvements(replace(given, still=still))
    _check_none_failed(found)
    for name, arcs in still.items():
        rules = [rule for rule in given.rules if name in rule.motions]
        with suppress(cm.InputError):  # no moves keep the rules, or its law does not rest
            best = cm.optimise(diagram, rules, still={name: arcs})
            mended = len({broken.rule for broken in cm.find_violations(diagram, rules)})
            told = [one for one in (*found, *found.left_out) if one.mechanism == name]
            least = min((one.after for one in told if one.mends == mended), default=np.inf)
            if mended or best.reached < GAIN * given.peaks[name]:
                assert least <= best.reached * (1 + NEAR), (
                    f"the {name}, {arcs}: {least} m/s², but {best.reached} can be"
                )


def _check_laws(found: cm.Improvements, before: Tracks) -> None:
    """See that no law is a gain where none is offered."""
    offered = {one.mechanism for one in found if one.kind == "law"}
    smooth = [law for law in cm.LAWS.values() if np.isfinite(law.Cj)]
    for motion in found.machine.diagram.motions:
        if motion.moves and motion.name not in {*offered, *found.handing}:
            for law in smooth:
                track = before[motion.name]
                pieces = [p if p.law is None else replace(p, law=law) for p in track.pieces]
                changed = Track(pieces, track.pitch_mm)
                told = f"the {motion.name} could have the law {law.name}, and none is offered"
                assert not _is_gain(found.machine, before, motion.name, changed), told


def _check_widths(found: cm.Improvements, before: Tracks, rng: Rng) -> None:
    """See that no wider moves are a gain where none are offered."""
    offered = {one.mechanism for one in found if one.kind in {"widen", "change"}}
    asked = {motion.name for motion in found.machine.diagram.motions if motion.moves}
    for name in asked - {*offered, *found.unasked, *found.handing}:
        still = found.machine.still.get(name, ())
        for changed in _wider(before[name], still, rng):
            told = f"the {name} could move as {changed.pieces}, and nothing wider is offered"
            assert not _is_gain(found.machine, before, name, changed), told


def _is_gain(machine: cm.Machine, before: Tracks, name: str, changed: Track) -> bool:
    """Tell whether a changed motion surely has a smaller peak, and makes no rule worse."""
    if not changed.peak(2, 1.0) < GAIN * before[name].peak(2, 1.0):
        return False
    after = {**before, name: changed}
    rules = [rule for rule in machine.rules if name in rule.motions]
    return all(_is_no_worse(rule, before, after) for rule in rules)


def _is_no_worse(rule: Rule, before: Tracks, after: Tracks) -> bool:
    assert isinstance(rule, cm.ClearanceRule)
    if worst(rule, before)[0] < NEAR_MM:
        return worst(rule, after)[0] < -NEAR_MM
    for angles in (EVEN, FINE):
        (depth, share), (deeper, more) = (_broken(rule, at, angles) for at in (before, after))
        if deeper > depth or more > share:
            return False
    return True


def _wider(track: Track, still: Sequence[tuple[float, float]], rng: Rng) -> Iterator[Track]:
    """Yield the motion with ends of its moves put out, as far as it still stands where it must.

    Where nothing says so, that is between its first and its last move.
    """
    moves = [piece for piece in track.pieces if piece.law is not None]
    works = {(0, 1), (len(moves) - 1, 0)} if not still and not track.pitch_mm else set()
    for _ in range(TRIES):
        made = [*moves]
        for number, move in enumerate(moves):
            rooms = _rooms(moves, number)
            by = [0.0 if (number, end) in works else room for end, room in enumerate(rooms)]
            early, late = (room * rng.choice(SHARES) * (rng.random() < 0.7) / 2 for room in by)
            made[number] = replace(move, from_deg=move.from_deg - early, to_deg=move.to_deg + late)
        changed = _with_dwells(made, track.pitch_mm)
        if all(_stands(changed, *arc) for arc in still):
            yield changed


def _rooms(moves: Sequence[Piece], number: int) -> tuple[float, float]:
    """Return how long it stands before a move and after it, in deg."""
    move, last = moves[number], len(moves) - 1
    before = moves[number - 1].to_deg - (0 if number else 360)
    after = moves[number + 1].from_deg if number < last else moves[0].from_deg + 360
    return max(move.from_deg - before, 0.0), max(after - move.to_deg, 0.0)


def _with_dwells(moves: Sequence[Piece], pitch_mm: float) -> Track:
    pieces = []
    ends = [*(move.from_deg for move in moves[1:]), moves[0].from_deg + 360]
    for move, end in zip(moves, ends, strict=True):
        pieces.append(move)
        if end - move.to_deg > NEAR_MM:
            pieces.append(Piece(move.to_deg, end, move.to_mm, move.to_mm, None))
    return Track(pieces, pitch_mm)


def _stands(track: Track, start: float, end: float) -> bool:
    return float(np.ptp(track.curve(0, np.linspace(start, end, 40)))) < STANDS_MM
