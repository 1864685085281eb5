"""Machines at random whose limits are as high as parts rest, and a search for their best moves.

The search moves the ends of moves at random and keeps what is better. A rule is judged by arcs: of
each dwell it is looked at whether it is beyond the limit, and each move is halved until it is known
at which share of its angle it passes the limit.
"""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise

import numpy as np

import cammotion as cm
from cammotion.rules.conditions import Condition

Rng = np.random.Generator
Arc = tuple[float, float]
Times = list[float]
"""Where each move of a part begins and ends, one after the other, in deg."""

Law = Callable[[float], float]
LAWS: dict[str, tuple[Law, float]] = {
    "cycloidal": (lambda x: x - math.sin(2 * math.pi * x) / (2 * math.pi), 2 * math.pi),
    "constant acceleration": (lambda x: 2 * x * x if x < 0.5 else 1 - 2 * (1 - x) ** 2, 4.0),
    "3-4-5 polynomial": (lambda x: x**3 * (10 - 15 * x + 6 * x * x), 10 / 3**0.5),
}
"""Each law with the factor of its peak acceleration."""

SAME_MM, SAME_DEG = 1e-9, 1e-6
HALVINGS = 50
EDGE = 1e-3  # of a move: so near to its end it has left its dwell
TRIES = 400  # of rules for a machine
SNAPPED = 0.25  # of the steps, to something that is there already
MOST_STEP_DEG = 60.0


@dataclass(frozen=True)
class Part:
    """A part by its heights in mm: at the start of the first move, and at the end of each."""

    name: str
    heights: tuple[float, ...]
    laws: tuple[str, ...]
    times: tuple[float, ...]
    still: tuple[Arc, ...]
    is_turret: bool

    @property
    def pitch(self) -> float:
        """Its way in a turn."""
        return abs(self.heights[-1] - self.heights[0])

    def offset(self, height: float) -> float:
        """Return the height, or of a turret the way to the nearest stop."""
        if not self.is_turret:
            return height
        passed = (height - self.heights[0]) % self.pitch
        return min(passed, self.pitch - passed)

    def motion(self, times: Sequence[float]) -> cm.Motion:
        """Return the motion with its moves at these times."""
        parts = []
        on = [*times[2::2], times[0] + 360]
        for n, law in enumerate(self.laws):
            way = self.heights[n + 1] - self.heights[n]
            move = cm.rise if way > 0 else cm.return_
            parts.append(move(abs(way), over_deg=times[2 * n + 1] - times[2 * n], law=law))
            if on[n] - times[2 * n + 1] > SAME_DEG:
                parts.append(cm.dwell(on[n] - times[2 * n + 1]))
        begins = {"start_deg": times[0], "start_mm": self.heights[0]}
        if self.is_turret:
            return cm.indexing_motion(self.name, *parts, stops=8, **begins)
        return cm.motion(self.name, *parts, **begins)

    def stands(self, times: Sequence[float]) -> bool:
        """Whether its moves follow each other, and each arc lies in the dwell that it was in."""
        on = [*times[1:], times[0] + 360]
        if any(later < one - 1e-12 for one, later in zip(times, on, strict=True)):
            return False
        if min(np.diff(times)[::2]) < 0.5:
            return False
        before, now = ([*t[1::2], *t[2::2], t[0] + 360] for t in (self.times, times))
        count = len(self.laws)
        for start, end in self.still:
            for n in range(count):
                turn = (start - before[n] + SAME_DEG) // 360 * 360
                if end - turn <= before[n + count] + SAME_DEG:
                    if start - turn < now[n] - SAME_DEG or end - turn > now[n + count] + SAME_DEG:
                        return False
                    break
        return True

    def widths(self, times: Sequence[float]) -> list[float]:
        """Return how wide each move is, if its peak were 1 at a width of 1."""
        ways = np.abs(np.diff(self.heights))
        return [
            (times[2 * n + 1] - times[2 * n]) / (LAWS[law][1] * ways[n]) ** 0.5
            for n, law in enumerate(self.laws)
        ]


@dataclass(frozen=True)
class Half:
    """A half of a rule: a part is beyond a limit, or is not."""

    part: int
    limit: float
    is_beyond: bool

    def arcs(self, part: Part, times: Sequence[float]) -> Iterator[Arc]:
        """Yield where a part is so."""
        on = [*times[2::2], times[0] + 360]
        for n, shares in enumerate(self._shares(part)):
            start, end = times[2 * n : 2 * n + 2]
            yield from ((start + a * (end - start), start + b * (end - start)) for a, b in shares)
            if self.holds(part, part.heights[n + 1]) and on[n] > end + SAME_DEG:
                yield end, on[n]

    def holds(self, part: Part, height: float) -> bool:
        """Return whether the part is so at a height."""
        return (part.offset(height) > self.limit + SAME_MM) == self.is_beyond

    def _shares(self, part: Part) -> list[list[Arc]]:
        key = id(part.heights), id(part.laws)
        if key not in self._found:
            self._found[key] = [self._of_move(part, n) for n in range(len(part.laws))]
        return self._found[key]

    @cached_property
    def _found(self) -> dict[tuple[int, int], list[list[Arc]]]:
        return {}

    def _of_move(self, part: Part, number: int) -> list[Arc]:
        law = LAWS[part.laws[number]][0]
        first, last = part.heights[number : number + 2]

        def holds(share: float) -> bool:
            return self.holds(part, first + (last - first) * law(share))

        grid = np.linspace(0, 1, 201).tolist()
        found: list[Arc] = []
        begun = 0.0
        inner = [EDGE, *grid[1:-1], 1 - EDGE]
        for low, high in pairwise(inner):
            if holds(low) == holds(high):
                continue
            a, b = low, high
            for _ in range(HALVINGS):
                a, b = ((a + b) / 2, b) if holds((a + b) / 2) == holds(low) else (a, (a + b) / 2)
            if holds(low):
                found.append((begun, a))
            begun = a
        return [*found, (begun, 1.0)] if holds(inner[-1]) else found


@dataclass(frozen=True)
class Rule:
    """While the one half holds, the other one has to hold."""

    when: Half
    only_while: Half

    def is_kept(self, parts: Sequence[Part], times: Sequence[Sequence[float]]) -> bool:
        """Whether no arc breaks it; an angle alone does not."""
        one, other = self.when, self.only_while
        these = one.arcs(parts[one.part], times[one.part])
        those = [*self._not.arcs(parts[other.part], times[other.part])]
        return not any(
            min(b, d + turn) - max(a, c + turn) > SAME_DEG
            for a, b in these
            for c, d in those
            for turn in (round((a - c) / 360 + k) * 360 for k in (-1, 0, 1))
        )

    @cached_property
    def _not(self) -> Half:
        return replace(self.only_while, is_beyond=not self.only_while.is_beyond)


@dataclass(frozen=True)
class Resting:
    """A machine whose rules are kept; parts without still arcs stay as they are."""

    parts: tuple[Part, ...]
    rules: tuple[Rule, ...]

    @property
    def diagram(self) -> cm.TimingDiagram:
        """Return the machine of today."""
        return cm.TimingDiagram([part.motion(part.times) for part in self.parts], 2000)

    @property
    def still(self) -> dict[str, list[Arc]]:
        """Return the arcs over which the free parts stand."""
        return {part.name: [*part.still] for part in self.parts if part.still}

    def made_rules(self) -> list[cm.ClearanceRule]:
        """Return the rules as the package has them."""

        def made(half: Half) -> Condition:
            kind = cm.beyond if half.is_beyond else cm.within
            return kind(self.parts[half.part].name, half.limit)

        return [cm.ClearanceRule(made(r.when), only_while=made(r.only_while)) for r in self.rules]

    def is_kept(self, times: Sequence[Sequence[float]]) -> bool:
        """Whether all parts stand where they have to, and all rules are kept."""
        return all(p.stands(t) for p, t in zip(self.parts, times, strict=True)) and all(
            rule.is_kept(self.parts, times) for rule in self.rules
        )

    def design(self, times: Sequence[Sequence[float]]) -> cm.TimingDiagram:
        """Return the machine with its moves at other times."""
        moved = [part.motion(own) for part, own in zip(self.parts, times, strict=True)]
        return cm.TimingDiagram(moved, 2000)

    def times(self, design: cm.TimingDiagram) -> list[Times]:
        """Return where the moves of a design are."""
        return [
            [end for move in design[part.name].moves for end in (move.from_deg, move.to_deg)]
            for part in self.parts
        ]

    def widths(self, times: Sequence[Sequence[float]]) -> list[float]:
        """Return the widths of the free moves, the least first."""
        of_each = zip(self.parts, times, strict=True)
        return sorted(width for part, own in of_each if part.still for width in part.widths(own))


def draw(rng: Rng) -> Resting:
    """Return a machine of two parts or three with one rule or two."""
    while True:
        parts = tuple(_part(rng, name) for name in "abc"[: rng.choice([2, 2, 3])])
        rules: list[Rule] = []
        for _ in range(TRIES):
            one, other = (int(n) for n in rng.permutation(len(parts))[:2])
            rule = Rule(_half(rng, one, parts[one]), _half(rng, other, parts[other]))
            if rule.is_kept(parts, [p.times for p in parts]) and _matters(rule, parts):
                rules.append(rule)
            if len(rules) == 2:
                break
        if rules and any(part.still for part in parts):
            return Resting(parts, tuple(rules[: rng.integers(1, 3)]))


def _matters(rule: Rule, parts: Sequence[Part]) -> bool:
    """Whether some motions of these heights break it."""
    at = {}
    for half, holds in ((rule.when, True), (rule.only_while, False)):
        part = parts[half.part]
        levels = np.linspace(min(part.heights), max(part.heights), 200)
        at[half.part] = any(half.holds(part, float(level)) == holds for level in levels)
    return all(at.values())


def _part(rng: Rng, name: str) -> Part:
    way, first = float(rng.choice([20, 50, 83.7])), float(rng.choice([0, 0, 5.26, -12]))
    share = float(rng.choice([0.3, 0.5, 0.4]))
    kinds: dict[str, tuple[list[float], bool]] = {
        "up and down": ([0, 1, 0], False),
        "two stages": ([0, share, 1, 0], False),
        "there and back": ([0, share, 1, share, 0], False),
        "twice": ([0, 1, 0, share, 0], False),
        "turret": ([0, 1], True),
        "turret of two stages": ([0, share, 1], True),
    }
    steps, is_turret = kinds[str(rng.choice([*kinds]))]
    sign = -1 if rng.random() < 0.3 else 1
    heights = tuple(round(first + sign * way * step, 9) for step in steps)
    count = len(steps) - 1
    dwells = rng.random(count) < rng.choice([0.6, 1, 1])
    shares = rng.dirichlet(np.full(2 * count, 2.0)) * 0.9 + 0.1 / (2 * count)
    shares[1::2] *= dwells
    widths = np.round(shares / shares.sum() * 360, 2)
    widths[0] += 360 - widths.sum()
    start = round(float(rng.uniform(-300, 700)), 2)
    times = np.round(start + np.cumsum([0, *widths[:-1]]), 6).tolist()
    still = []
    for n, wide in enumerate(widths[1::2].tolist()):
        if wide > 4 and rng.random() < 0.75:
            begin = times[2 * n + 1] + rng.uniform(0, 0.5) * (wide - 3)
            still.append((round(begin, 3), round(begin + rng.uniform(1, 3), 3)))
    free = rng.random() < 0.8
    laws = tuple(str(rng.choice([*LAWS])) for _ in range(count))
    return Part(name, heights, laws, tuple(times), tuple(still) if free else (), is_turret)


def _half(rng: Rng, number: int, part: Part) -> Half:
    limits = [round(part.offset(height), 9) for height in part.heights]
    if rng.random() < 0.25:
        limits = [float(rng.uniform(0.02, 0.98) * (max(limits) or 50))]
    return Half(number, float(rng.choice(limits)), bool(rng.random() < 0.5))


def search(machine: Resting, rng: Rng, steps: int) -> list[Times]:
    """Return the best times of all moves that are found by so many steps at random."""
    free = [n for n, part in enumerate(machine.parts) if part.still]
    now = best = [list(part.times) for part in machine.parts]
    for step in range(steps):
        if step % 400 == 0:
            now = best
        new = [list(times) for times in now]
        for _ in range(int(rng.choice([1, 1, 2, 3]))):
            _step(machine, rng, new, int(rng.choice(free)))
        if not machine.is_kept(new):
            continue
        is_better = machine.widths(new) >= machine.widths(now)
        if is_better or rng.random() < 0.05:
            now = new
        if machine.widths(new) > machine.widths(best):
            best = new
    return best


def _step(machine: Resting, rng: Rng, times: list[Times], number: int) -> None:
    """Move an end of a move, or some ends together, a little or as far as something else is."""
    own = times[number]
    first = int(rng.integers(len(own)))
    last = first + int(rng.choice([1, 1, 1, 2, len(own)]))
    by = float(rng.normal() * MOST_STEP_DEG * 10 ** rng.uniform(-3, 0))
    if rng.random() < SNAPPED:
        still = [end for part in machine.parts for arc in part.still for end in arc]
        there = float(rng.choice([*still, *own, *times[int(rng.integers(len(times)))]]))
        by = (there - own[first] + 180) % 360 - 180
    for end in range(first, min(last, len(own))):
        own[end] += by
