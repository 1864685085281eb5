"""Machines at random for files: turrets, starts past a turn, odd names, laws of every kind.

A machine has 1 to 24 mechanisms. Its laws come from a pool, in which several have one name, some
are called like those of the catalogue, and some are solved, measured or written by hand.
"""

import warnings
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
import sympy

import cammotion as cm
from cammotion import MotionLaw, x

Rng = np.random.Generator

NAMES = [
    *("=1+1", "+die", "-1", "@SUM(A1)", "'die'", "''", "'=die", "a;b", "1,5", '"', "Stößel, links"),
    *("dwell", "law in full", "line\nend", "line\r\nend", "= die", "'", "007", "x" * 300, "\x00"),
]
"""Names that a table could lose."""

MOST = 24


@cache
def pool() -> tuple[MotionLaw, ...]:
    """Return laws of every kind; the odd ones first."""
    rng = np.random.default_rng(15)
    return (*_named(), *_solved(), *_sampled(rng), *_written(rng), *_families(rng))


def draw(rng: Rng, count: int) -> cm.TimingDiagram:
    """Draw a machine of so many mechanisms."""
    names = [str(name) for name in rng.permutation(np.array(NAMES, dtype=object))[: count // 3]]
    names += [f"mechanism {n}" for n in range(count - len(names))]
    motions = [_shear(name) if rng.random() < 0.05 else _motion(rng, name) for name in names]
    return cm.TimingDiagram(motions, float(rng.choice([2000, 600.5, rng.uniform(1, 1e4)])))


def worst(one: cm.TimingDiagram, other: cm.TimingDiagram) -> tuple[float, float]:
    """Return by how much two machines differ: positions in mm, peaks as a share."""
    assert (one.names, one.rate_per_hour) == (other.names, other.rate_per_hour)
    angles = np.linspace(-400, 1200, 301)
    off, share = 0.0, 0.0
    for mine, theirs in zip(one.motions, other.motions, strict=True):
        assert mine.stops == theirs.stops
        assert [s.kind for s in mine.segments] == [s.kind for s in theirs.segments]
        places = np.abs(mine.position_mm(angles) - theirs.position_mm(angles))
        off = max(off, float(np.max(places)))
        for order in (1, 2, 3):
            peaks = mine.peak(order), theirs.peak(order)
            if peaks[0] != peaks[1]:  # both may be infinite
                share = max(share, abs(peaks[0] - peaks[1]) / max(map(abs, peaks)))
    return off, share


def _motion(rng: Rng, name: str) -> cm.Motion:
    moves = int(rng.integers(1, 5))
    turret = moves == 1 or bool(rng.random() < 0.3)
    heights = [float(rng.choice([0, 5.26, -0.1, rng.uniform(-50, 50)]))]
    for n in range(moves):
        way = float(rng.choice([5.26, 50, 0.1, rng.uniform(0.01, 400)]))
        heights.append(heights[-1] + way * (1 if turret or n % 2 == 0 else -1))
    if not turret:
        heights[-1] = heights[0]
        if abs(heights[-1] - heights[-2]) < 1e-6:
            heights[-2] += 1
    start = float(rng.choice([0, 359.5, 400, -90, 1234.5, rng.uniform(-1e4, 1e4)]))
    cuts = np.sort(rng.uniform(1, 359, 2 * moves - 1)).round(int(rng.choice([2, 9])))
    angles = [start, *(start + cuts[np.append(True, np.diff(cuts) > 0)]), start + 360]
    segments, at = [], 0
    for n, (low, high) in enumerate(pairwise(angles)):
        left, moving = len(angles) - 1 - n, moves - at
        law = None
        if moving and (left <= moving or rng.random() < 0.6):
            law, at = pool()[int(rng.triangular(0, 0, len(pool())))], at + 1
        ends = (heights[at - 1], heights[at]) if law else (heights[at], heights[at])
        numbers = {"from_deg": low, "to_deg": high, "from_mm": ends[0], "to_mm": ends[1]}
        segments.append(cm.Segment(**numbers, law=law))
    return cm.Motion(name, segments, int(rng.integers(1, 60)) if turret else None)


def _shear(name: str) -> cm.Motion:
    """Return a motion with laws matched to their neighbours."""
    parts: list[Any] = [
        cm.rise(20, over_deg=70, law=cm.MATCHED),
        cm.rise(60, over_deg=80, law=cm.CONSTANT_VELOCITY),
        cm.rise(20, over_deg=50, law=cm.MATCHED),
        cm.return_(100, over_deg=160),
    ]
    return cm.motion(name, *parts, start_deg=371.3)


def _named() -> list[MotionLaw]:
    """Return laws whose names say nothing, or something wrong."""
    forms = [x**2, 3 * x**2 - 2 * x**3, x - sympy.sin(2 * sympy.pi * x) / (2 * sympy.pi)]
    names = ["cycloidal", "cubic", "constant velocity", "dwell", "my", "", *NAMES]
    return [MotionLaw(name, form) for name in names for form in forms]


def _solved() -> list[MotionLaw]:
    """Return the laws of motions with the least acceleration."""
    machine = cm.EXAMPLE
    found = []
    for jerk in (np.inf, 100.0, 60.0):
        least = cm.least_acceleration(
            machine.diagram, "die", machine.rule, still=[(205, 305)], jerk_m_per_s3=jerk, cells=180
        )
        found += [cm.as_law(move.law) for move in least.motion.moves]
    return found


def _sampled(rng: Rng) -> list[MotionLaw]:
    found = []
    for count in (4, 5, 7, 12, 37, 73):
        places = np.linspace(0, 1, count)
        places[1:-1] += rng.uniform(-0.3, 0.3, count - 2) / count
        ways = (places**2 * (3 - 2 * places) + 0.001 * rng.normal(size=count)).round(4)
        ways[[0, -1]] = 0, 1
        slopes = (float(rng.choice([0, 1, rng.uniform(0, 3)])), 0.0)
        law = cm.law_from_points(places, ways, end_slopes=slopes, step=0)
        found += [law, law.reversed(), law.part(0, 0.83), law.part(0.21, 0.5)]
    even = np.linspace(0, 1, 25)
    mirrored = cm.law_from_points(even, even**2 * (3 - 2 * even))
    rough = (even - np.sin(2 * np.pi * even) / (2 * np.pi)).round(4)
    fits: list[dict[str, Any]] = [
        {"fit": "smooth"},
        {"fit": "smooth", "smoothing": 1e-5, "end_slopes": (0.3, 0)},
        {"fit": "smooth", "smoothing": 0},
        {"fit": "monotone", "end_slopes": (0, 0.03)},
        {"fit": "periodic"},
        {"fit": "periodic", "smoothing": 1e-6},
        {},
    ]
    with warnings.catch_warnings(action="ignore"):  # of their rounding
        found += [cm.law_from_points(even, rough, **fit) for fit in fits]
    return [*found, mirrored, mirrored.with_constant_velocity(0.3)]


def _written(rng: Rng) -> list[MotionLaw]:
    turn, lean = float(rng.uniform(0.1, 0.9)), float(rng.uniform(-5, 5))
    third, pi = sympy.Rational(1, 3), sympy.pi
    forms = [
        (sympy.exp(x) - 1) / (sympy.E - 1),
        sympy.sinh(x) / sympy.sinh(1),
        sympy.sqrt(1 + 3 * x) - 1,
        sympy.log(1 + x) / sympy.log(2),
        (1 + x) ** sympy.Rational(5, 2) / (2 ** sympy.Rational(5, 2) - 1)
        - 1 / (2 ** sympy.Rational(5, 2) - 1),
        sympy.EulerGamma * x**2 + (1 - sympy.EulerGamma) * x,
        sympy.gamma(third) * x**2 + (1 - sympy.gamma(third)) * x**3,
        x + sympy.sin(2 * pi * x) * sympy.cos(3 * pi * x) / 7,
        sympy.Piecewise((x**2 / turn, x <= turn), (1 - (1 - x) ** 2 / (1 - turn), True)),
        sympy.Piecewise((9 * x**2 / 5, x < third), ((6 * x - 1) / 5, True)),
        10 * x**3 - 15 * x**4 + 6 * x**5 + lean * x**3 * (1 - x) ** 3,
        sympy.Float("0.1", 40) * x**2 + (1 - sympy.Float("0.1", 40)) * x,
        sympy.Integer(10) ** 30 * x / (sympy.Integer(10) ** 30),
    ]
    return [MotionLaw("of my own", form) for form in forms]


def _families(rng: Rng) -> list[MotionLaw]:
    found = [*cm.LAWS.values(), cm.CONSTANT_VELOCITY, cm.fifth_degree_linear(0.37)]
    found += [cm.scca(1, 0, 0), cm.scca(0, 0.3, 0.7), cm.scca(1 / 3, 1 / 3, 1 / 3)]
    for _ in range(8):
        b, c, d = rng.dirichlet([1, 1, 1])
        found += [cm.scca(b, c, d), cm.fifth_degree_linear(float(rng.uniform(0, 0.9)))]
        v, a = rng.uniform(0, 1, 2)
        found.append(cm.polynomial((0, v, a), (1, a, -v), may_leave=True))
        law = list(cm.LAWS.values())[int(rng.integers(len(cm.LAWS)))]
        found += [law.reversed(), law.with_constant_velocity(float(rng.uniform(0, 0.9)))]
        found.append(law.part(float(rng.uniform(0, 0.4)), float(rng.uniform(0.6, 1))))
    return found
