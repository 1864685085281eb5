"""Random turrets and dies, and a way to their least acceleration that is written from scratch.

A turret has to be near to a stop, or away from its stops, while dies are deep. Here every whole
number of stops is tried, on an even grid of its own, by second differences. What is asked there
is less than is asked of a motion, so that the result lies below the least peak of all.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, groupby, pairwise, permutations, product

import numpy as np
from machines import Array
from scipy.optimize import linprog

import cammotion as cm
from cammotion.rules.clearance import ClearanceRule

Arc = tuple[float, float]
ANGLES = np.linspace(0, 360, 1441)[:-1]
"""From the beginning of the first still arc."""
TOUCHING = 1e-9
"""By so much, in mm or deg, two bands or arcs may lie apart that have their ends in common."""


@dataclass(frozen=True)
class Duty:
    """A die that is deep from one angle to another, and how the turret has to be meanwhile."""

    start_deg: float
    end_deg: float
    limit_mm: float
    is_beyond: bool
    move_deg: float = 2

    def offs_mm(self, pitch_mm: float) -> tuple[float, float]:
        """Return how far from the nearest stop the turret may be, at least and at most."""
        return (self.limit_mm, pitch_mm / 2) if self.is_beyond else (0.0, self.limit_mm)


@dataclass(frozen=True)
class Turret:
    """A turret that stands over some arcs, given with its positions there; one turn is 1.8 s.

    It stands at a stop over the first of them.
    """

    pitch_mm: float
    still: tuple[tuple[float, float, float], ...]
    duties: tuple[Duty, ...]

    def diagram(self) -> cm.TimingDiagram:
        """Return the machine; the turret goes from one still arc to the next, somehow."""
        start, _, first = self.still[0]
        parts = []
        for (begin, end, place), (later, _, there) in pairwise(
            [*self.still, (start + 360, start + 360, first + self.pitch_mm)]
        ):
            way, gap = round(there - place, 9), later - end
            move = cm.rise if way > 0 else cm.return_
            parts.append(cm.dwell(end - begin))
            parts.append(move(abs(way), over_deg=gap) if way else cm.dwell(gap))
        mill = cm.indexing_motion("mill", *parts, stops=24, start_deg=start, start_mm=first)
        return cm.TimingDiagram([mill, *map(self._die, range(len(self.duties)))], 2000)

    def _die(self, number: int) -> cm.Motion:
        duty = self.duties[number]
        work, move = duty.end_deg - duty.start_deg, duty.move_deg
        parts = cm.rise(10, over_deg=move), cm.dwell(work - move), cm.return_(10, over_deg=move)
        rest = cm.dwell(360 - work - move)
        return cm.motion(f"die {number}", *parts, rest, start_deg=duty.start_deg - move / 2)

    def rules(self) -> list[ClearanceRule]:
        """Return the rules: a die may be deeper than half-way only while the turret is right."""
        return [
            ClearanceRule(
                cm.beyond(f"die {number}", 5),
                only_while=(cm.beyond if duty.is_beyond else cm.within)("mill", duty.limit_mm),
            )
            for number, duty in enumerate(self.duties)
        ]

    def asks_two_things(self) -> bool:
        """Return whether two arcs that overlap, however little, ask what cannot be at once."""
        pitch = abs(self.pitch_mm)
        asked = [(d.start_deg, d.end_deg, *d.offs_mm(pitch)) for d in self.duties]
        for start, end, place in self.still:
            passed = (place - self.still[0][2]) % pitch
            asked.append((start, end, *2 * (min(passed, pitch - passed),)))
        return any(
            max(one[2], other[2]) > min(one[3], other[3]) + 1e-9
            for one, other in permutations(asked, 2)
            if (other[0] - one[0]) % 360 < one[1] - one[0]
        )

    def strays_mm(self, places: Array, angles: Array, beside_deg: float = 0) -> float:
        """Return how far positions are from what the duties ask at their angles, at most.

        With `beside_deg` they ask it for so much longer, at either end.
        """
        passed = np.mod(places - self.still[0][2], abs(self.pitch_mm))
        off = np.minimum(passed, abs(self.pitch_mm) - passed)
        worst = 0.0
        for duty in self.duties:
            length = duty.end_deg - duty.start_deg + 2 * beside_deg
            here = np.mod(angles - duty.start_deg + beside_deg, 360) < length
            wrong = (duty.limit_mm - off) if duty.is_beyond else (off - duty.limit_mm)
            worst = max(worst, *wrong[here])
        return worst


def least_by_trying(turret: Turret, nodes: int = 200, *, may_touch: bool = False) -> float:
    """Return what no motion of the turret is below, in m/s2; infinite where there is none.

    Where two duties have one place in common and no more, as "within 10 mm" and "beyond 10 mm",
    there is a motion only if they `may_touch`: it stands there, to the last digit.
    """
    if turret.asks_two_things():
        return math.inf
    begin = sum(turret.still[0][:2]) / 2  # an arc that goes on over it stands there on both sides
    angles = begin + 360 / nodes * (np.arange(nodes) + 0.37)
    pitch, stands = abs(turret.pitch_mm), np.full(nodes, math.nan)
    for (start, end, place), turn in product(turret.still, (0, 1)):
        here = (angles >= start + 360 * turn) & (angles <= end + 360 * turn)
        stands[here] = place + turn * turret.pitch_mm
    arcs, choices, spans = [], [], []
    for duty in turret.duties:
        low = duty.limit_mm if duty.is_beyond else -duty.limit_mm
        high = pitch - duty.limit_mm if duty.is_beyond else duty.limit_mm
        if high - low >= pitch:
            continue
        if low >= high:
            return math.inf
        inside = np.mod(angles - duty.start_deg, 360) < duty.end_deg - duty.start_deg
        for run in runs(inside):
            here = np.array(run)
            arcs.append(here)
            since = float(np.mod(angles[run[0]] - duty.start_deg, 360))
            span = angles[run[0]] - since, angles[run[0]] - since + duty.end_deg - duty.start_deg
            spans.append(span)
            bands = [
                (turret.still[0][2] + k * pitch + low, turret.still[0][2] + k * pitch + high)
                for k in range(-3, 5)
            ]
            known = _places_over(span, turret)
            choices.append([(a, b) for a, b in bands if np.all((known >= a) & (known <= b))])
    best = math.inf
    shared = -TOUCHING if may_touch else TOUCHING
    for chosen in _agreeing(spans, choices, shared):
        low_mm, high_mm = np.full(nodes, -math.inf), np.full(nodes, math.inf)
        for here, (a, b) in zip(arcs, chosen, strict=True):
            low_mm[here] = np.maximum(low_mm[here], a)
            high_mm[here] = np.minimum(high_mm[here], b)
        if np.all(high_mm - low_mm >= min(shared, 0)):
            high_mm = np.maximum(low_mm, high_mm)
            fixed = ~np.isnan(stands)
            low_mm[fixed] = high_mm[fixed] = stands[fixed]
            best = min(best, _least_difference(low_mm, high_mm, turret.pitch_mm, best))
    return best


def _agreeing(
    spans: list[Arc], choices: list[list[Arc]], shared_mm: float
) -> Iterator[tuple[Arc, ...]]:
    """Yield a band for each arc; of arcs with a piece in common the bands share so much or more."""
    for chosen in product(*choices):
        each = [*zip(spans, chosen, strict=True)]
        pairs = combinations(each, 2)
        if all(
            _shared(one, other) > shared_mm or not _overlap(a, b) for (a, one), (b, other) in pairs
        ):
            yield chosen


def _places_over(span: Arc, turret: Turret) -> Array:
    """Return where the turret stands over a part of an arc, however small, and no node lies in."""
    every = product(turret.still, (-1, 0, 1, 2))
    found = [
        place + turn * turret.pitch_mm
        for (start, end, place), turn in every
        if _overlap(span, (start + 360 * turn, end + 360 * turn))
    ]
    return np.array(found)


def _overlap(one: Arc, other: Arc) -> bool:
    """Tell whether two arcs have a piece in common."""
    return _shared(one, other) > TOUCHING


def _shared(one: Arc, other: Arc) -> float:
    """Return how long the piece is that two arcs, or two bands, have in common; below 0 a gap."""
    return min(one[1], other[1]) - max(one[0], other[0])


def runs(inside: Array) -> list[list[int]]:
    """Return the runs of nodes that are inside."""
    grouped = groupby(range(len(inside)), key=lambda n: bool(inside[n]))
    return [list(group) for flag, group in grouped if flag]


def _least_difference(low: Array, high: Array, pitch: float, most: float) -> float:
    """Return the least peak of the second differences over a turn, in m/s2, if below `most`."""
    nodes = len(low)
    rows, further = np.zeros((nodes, nodes + 1)), np.zeros(nodes)
    for n, (side, weight) in product(range(nodes), ((-1, 1), (0, -2), (1, 1))):
        turn, node = divmod(n + side, nodes)
        rows[n, node] += weight
        further[n] += weight * turn * pitch
    peak = np.eye(1, nodes + 1, nodes)[0] * 1000 * (1.8 / nodes) ** 2
    found = linprog(
        np.eye(1, nodes + 1, nodes)[0],
        A_ub=np.vstack([rows - peak, -rows - peak]),
        b_ub=np.concatenate([-further, further]),
        bounds=[*zip(low, high, strict=True), (0, most if math.isfinite(most) else None)],
        method="highs",
    )
    return float(found.fun) if found.status == 0 else math.inf


def draw(rng: np.random.Generator) -> Turret:
    """Return a turret with one or two still arcs and one to three dies."""
    pitch = round(float(rng.choice([-1, 1]) * rng.uniform(10, 150)), 2)
    first, start = (
        round(float(rng.uniform(-300, 300)), 2),
        float(np.round(rng.uniform(-400, 400), 3)),
    )
    still = [(start, start + float(rng.uniform(8, 60)), first)]
    if rng.random() < 0.3:
        begin = start + float(rng.uniform(100, 250))
        place = round(first + float(rng.choice([0, 0.5, 1, 0.3])) * pitch, 2)
        still.append((begin, begin + float(rng.uniform(5, 50)), place))
    duties = []
    for _ in range(rng.integers(1, 4)):
        begin, length = start + float(rng.uniform(0, 360)), float(rng.choice([15, 40, 90, 150]))
        share = float(rng.choice([0.005, 0.02, 0.1, 0.3, 0.45, 0.6]))
        is_beyond = bool(rng.random() < 0.3)
        length *= float(rng.uniform(0.6, 1.2))
        move = float(rng.choice([2, 2, 10]))
        duties.append(
            Duty(begin, begin + length, share * abs(pitch), is_beyond, min(move, length / 2))
        )
    return Turret(pitch, tuple(still), tuple(duties))


def draw_motion(
    turret: Turret, rng: np.random.Generator, jerky: bool
) -> tuple[Array, float, float]:
    """Return the positions of some motion at `ANGLES`, its peak acceleration and its peak jerk.

    It stands where it has to, and goes from one still arc to the next in one to three moves; these
    are parabolas, or else polynomials of fifth order, whose jerk is finite.
    """
    start, _, first = turret.still[0]
    places, pushes, jerks = np.full(len(ANGLES), first), [0.0], [0.0]
    angles = start + ANGLES
    last = start + 360, start + 360, first + turret.pitch_mm
    for (_, end, place), (begin, _, there) in pairwise([*turret.still, last]):
        moves = int(rng.choice([1, 1, 2, 3]))
        cuts = np.sort(rng.uniform(end, begin, 2 * moves))
        cuts[[0, -1]] = np.where(rng.random(2) < 0.4, [end, begin], cuts[[0, -1]])
        stops = first + turret.pitch_mm * rng.integers(-1, 3, moves - 1)
        offs = abs(turret.pitch_mm) * rng.choice([0.002, 0.1, 0.5], moves - 1)
        heights = [place, *(stops + offs * rng.uniform(-1, 1, moves - 1)), there]
        for (low, high), (a, b) in zip(pairwise(heights), cuts.reshape(-1, 2), strict=True):
            u, seconds, way = (
                np.clip((angles - a) / (b - a), 0, 1),
                (b - a) / 200,
                (high - low) / 1000,
            )
            square = np.where(u < 0.5, 2 * u**2, 1 - 2 * (1 - u) ** 2)
            curve = square if jerky else u**3 * (10 - 15 * u + 6 * u**2)
            places += (high - low) * curve
            pushes.append(abs(way) / seconds**2 * (4 if jerky else 10 / math.sqrt(3)))
            jerks.append(math.inf if jerky else 60 * abs(way) / seconds**3)
        places[angles >= begin] = there
    return places, max(pushes), max(jerks)
