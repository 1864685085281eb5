"""Machines at random whose parts pay for each other, and designs of them that keep the rules."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import linprog

import cammotion as cm
from cammotion.rules.checks import find_violations
from cammotion.rules.clearance import ClearanceRule

Rng = np.random.Generator
LAWS = ["cycloidal", "constant acceleration", "modified trapezoid", "3-4-5 polynomial", "MCV50"]


@dataclass(frozen=True)
class Crowd:
    """A machine with what its parts have to keep, all by their names."""

    diagram: cm.TimingDiagram
    rules: list[ClearanceRule]
    still: dict[str, list[tuple[float, float]]]
    travel_mm: dict[str, tuple[float, float]]


def draw(rng: Rng, count: int) -> Crowd:
    """Return a turret and so many slides less one, which go down one after the other.

    No two of them move at once, so that the rules are kept whatever their limits are.
    """
    cuts = np.sort(rng.uniform(0.5, 1.5, 3 * count))
    slots = np.cumsum(cuts / cuts.sum() * 360)
    begin = float(rng.uniform(-400, 400))
    pitch = float(rng.choice([-1, 1]) * rng.uniform(20, 150))
    first, last = begin, begin + float(slots[2])
    move = cm.rise if pitch > 0 else cm.return_
    turret = cm.indexing_motion(
        "turret",
        move(abs(pitch), over_deg=last - first, law=_law(rng)),
        cm.dwell(360 - last + first),
        stops=int(rng.integers(3, 30)),
        start_deg=first,
    )
    motions, rules = [turret], []
    rest = first + 360 - last
    still = {"turret": [(last + 0.3 * rest, last + float(rng.uniform(0.4, 0.6)) * rest)]}
    travel: dict[str, tuple[float, float]] = {}
    for number in range(1, count):
        name, stroke = f"slide {number}", float(rng.uniform(10, 80))
        down, work, up = (begin + float(slots[3 * number + n - 1]) for n in range(3))
        end = begin + float(slots[3 * number + 2])
        slide = cm.motion(
            name,
            cm.rise(stroke, over_deg=work - down, law=_law(rng)),
            cm.dwell(up - work),
            cm.return_(stroke, over_deg=end - up, law=_law(rng)),
            cm.dwell(360 - end + down),
            start_deg=down,
        )
        motions.append(slide)
        still[name] = [(work, up)]
        if rng.random() < 0.5:
            still[name].append((end + 0.8 * (360 - end + down), end + 0.9 * (360 - end + down)))
        if rng.random() < 0.6:
            travel[name] = (0.0, stroke)
        limit = float(rng.uniform(0.05, 0.7)) * stroke
        near = float(rng.choice([0.005, 0.05, 0.3])) * abs(pitch)
        rules.append(ClearanceRule(cm.beyond(name, limit), only_while=cm.within("turret", near)))
        if number > 1:
            other = f"slide {number - 1}"
            half = float(np.ptp(motions[-2].range_mm)) * float(rng.uniform(0.2, 0.8))
            rules.append(ClearanceRule(cm.beyond(name, limit), only_while=cm.within(other, half)))
    rate = float(rng.choice([2000, rng.uniform(300, 9000)]))
    return Crowd(cm.TimingDiagram(motions, rate), rules, still, travel)


def _law(rng: Rng) -> Any:
    return str(rng.choice(LAWS))


def draw_any(rng: Rng) -> Crowd:
    """Return two to four parts of any kind with rules of any kind, which they happen to keep."""
    count = int(rng.integers(2, 5))
    motions = [_any_part(rng, f"part {n}") for n in range(count)]
    diagram = cm.TimingDiagram(motions, float(rng.uniform(300, 6000)))
    rules: list[ClearanceRule] = []
    for _ in range(60):
        one, other = rng.permutation(count)[:2]
        halves = [_any_half(rng, motions[int(n)]) for n in (one, other)]
        rule = ClearanceRule(halves[0], only_while=halves[1])
        matters = rule.when.arcs(diagram) and rule.only_while.opposite.arcs(diagram)
        if matters and not find_violations(diagram, rule):
            rules.append(rule)
        if len(rules) == 4:
            break
    still, travel = {}, {}
    for motion in motions:
        dwells = [(s.from_deg, s.to_deg) for s in motion.segments if s.is_dwell]
        kept = [dwells[0]] if rng.random() < 0.5 else dwells
        still[motion.name] = [
            (a + float(rng.uniform(0, 0.2)) * (b - a), b - float(rng.uniform(0, 0.2)) * (b - a))
            for a, b in kept
        ]
        if not motion.is_indexing and rng.random() < 0.5:
            travel[motion.name] = motion.range_mm
    return Crowd(diagram, rules, still, travel)


def _any_part(rng: Rng, name: str) -> cm.Motion:
    start, way = float(rng.uniform(-500, 500)), float(rng.uniform(5, 120))
    if rng.random() < 0.4:
        move = cm.rise if rng.random() < 0.5 else cm.return_
        angle = float(rng.uniform(40, 250))
        parts = move(way, over_deg=angle, law=_law(rng)), cm.dwell(360 - angle)
        return cm.indexing_motion(name, *parts, stops=12, start_deg=start)
    cuts = rng.uniform(0.3, 1, 4)
    a, b, c, d = (float(cut) for cut in cuts / cuts.sum() * 360)
    moves = cm.rise(way, over_deg=a, law=_law(rng)), cm.return_(way, over_deg=c, law=_law(rng))
    return cm.motion(name, moves[0], cm.dwell(b), moves[1], cm.dwell(d), start_deg=start)


def _any_half(rng: Rng, motion: cm.Motion) -> Any:
    way = abs(motion.pitch_mm) / 2 if motion.is_indexing else float(np.ptp(motion.range_mm))
    limit = way * float(rng.choice([0.02, 0.1, 0.3, 0.5, 0.8, 0.95]))
    return (cm.beyond if rng.random() < 0.5 else cm.within)(motion.name, limit)


def designs(crowd: Crowd, rng: Rng) -> Iterator[cm.TimingDiagram]:
    """Yield designs that keep everything: as drawn, and with the widest moves in some orders."""
    yield crowd.diagram
    for _ in range(3):
        design = crowd.diagram
        for name in rng.permutation(np.array(design.names, dtype=object)):
            law, each_way = _law(rng), name != "turret" and bool(rng.random() < 0.5)
            design = design.with_motion(design[name].with_law(law))
            try:
                wide = cm.widest_move(design, name, crowd.rules, each_way=each_way).diagram
            except cm.InputError:
                continue
            share = float(rng.choice([1, 1, rng.uniform(0.8, 1)]))
            angle = min(move.angle_deg for move in wide[name].moves) * share
            narrower = wide.with_motion(cm.with_angle(wide[name], angle))
            for better in (wide, narrower):
                if keeps(crowd, better):
                    design = better
            yield design


def keeps(crowd: Crowd, design: cm.TimingDiagram) -> bool:
    """Whether the rules are kept, and each part stands where it has to and stays in its travel."""
    if find_violations(design, crowd.rules):
        return False
    for name, arcs in crowd.still.items():
        for start, end in arcs:
            angles = np.linspace(start, end, 50)
            off = design[name].offset_mm(angles) - crowd.diagram[name].offset_mm(angles)
            if np.abs(off).max() > 1e-9:
                return False
    return all(
        low - 1e-9 <= design[name].range_mm[0] and design[name].range_mm[1] <= high + 1e-9
        for name, (low, high) in crowd.travel_mm.items()
    )


@dataclass(frozen=True)
class Small:
    """Two parts on an even grid over a turn, the second one with a pitch, and one rule.

    The first may be above `limit` only while the second is within `near` of a stop.
    """

    nodes: int
    still: tuple[tuple[int, int], tuple[int, int]]
    places: tuple[float, float]
    pitch: float
    limit: float
    near: float


def least_by_trying(given: Small) -> float:
    """Return the least peak of the second differences, in mm/deg2, of all choices at the nodes.

    At each node the first part is low, or the second is near to the stop before or after it.
    """
    (a, b), (c, d) = given.still
    choices: list[list[float | None]] = []
    for node in range(given.nodes):
        near = [0.0] if c <= node <= d else [0.0, -given.pitch if node < c else given.pitch]
        choices.append([*near] if a <= node <= b else [None, *near])
    program = _Program(given)

    def best_from(chosen: tuple[float | None, ...], best: float) -> float:
        """Return the least peak after these choices at the first nodes, if it is below `best`."""
        least = program.least(chosen, best)
        if least >= best:  # further choices only ask for more
            return best
        if len(chosen) == given.nodes:
            return least
        for choice in choices[len(chosen)]:
            best = best_from((*chosen, choice), best)
        return best

    return best_from((), math.inf)


class _Program:
    """The linear program of one choice, by dense rows of its own."""

    def __init__(self, given: Small) -> None:
        n, self.given = given.nodes, given
        self.h = 360 / n
        rows, further = [], []
        for part, pitch in enumerate((0.0, given.pitch)):
            first, last = given.still[part]
            for node in range(n):
                row, add = np.zeros(2 * n + 1), 0.0
                if first < node < last:
                    continue
                if node in (first, last):
                    step = -1 if node == first else 1
                    sides = [(step, 2.0), (0, -2.0)]
                else:
                    sides = [(-1, 1.0), (0, -2.0), (1, 1.0)]
                for side, factor in sides:
                    turn, at = divmod(node + side, n)
                    row[part * n + at] += factor
                    add += factor * turn * pitch
                rows.append(row)
                further.append(add)
        self.rows, self.further = np.array(rows), np.array(further)

    def least(self, pattern: tuple[Any, ...], most: float) -> float:
        """Return the least peak, if below `most`, with a stop or None for the first nodes."""
        n, given = self.given.nodes, self.given
        low, high = np.full(2 * n, -1000.0), np.full(2 * n, 1000.0)
        for part in (0, 1):
            first, last = given.still[part]
            here = slice(part * n + first, part * n + last + 1)
            low[here] = high[here] = given.places[part]
        for node, stop in enumerate(pattern):
            if stop is None:
                high[node] = min(high[node], given.limit)
            else:
                low[n + node] = max(low[n + node], stop - given.near)
                high[n + node] = min(high[n + node], stop + given.near)
        if np.any(low > high):
            return math.inf
        peak = np.zeros(2 * n + 1)
        peak[-1] = self.h**2
        found = linprog(
            np.eye(1, 2 * n + 1, 2 * n)[0],
            A_ub=np.vstack([self.rows - peak, -self.rows - peak]),
            b_ub=np.concatenate([-self.further, self.further]),
            bounds=[*zip(low, high, strict=True), (0, most if math.isfinite(most) else None)],
            method="highs",
        )
        return float(found.fun) if found.status == 0 else math.inf
