"""Machines at random: each is drawn as code, and what is run is what can be printed."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

import numpy as np

import cammotion as cm
from cammotion import ClearanceRule, InputError, MotionLaw, TimingDiagram
from fresh.sampling import Array, tracks_of

Rng = np.random.Generator

HEAD = """\
import sympy
import cammotion as cm
from cammotion import x
"""


@dataclass(frozen=True)
class Machine:
    """A drawn machine: the code that builds it, and what it builds."""

    seed: str
    number: int
    code: str
    built: dict[str, Any]

    @property
    def diagram(self) -> TimingDiagram:
        """The diagram."""
        diagram: TimingDiagram = self.built["diagram"]
        return diagram

    @property
    def rules(self) -> list[ClearanceRule]:
        """The rules."""
        rules: list[ClearanceRule] = self.built["rules"]
        return rules

    @property
    def laws(self) -> list[MotionLaw]:
        """The laws of its moves, each once."""
        moves = [move for motion in self.diagram.motions for move in motion.moves]
        return [*dict.fromkeys(cm.as_law(move.law) for move in moves if move.law is not None)]

    @property
    def rng(self) -> Rng:
        """Numbers for a check, the same each time."""
        return _rng(self.seed, self.number, "check")


def draw(seed: str, number: int) -> Machine:
    """Draw the machine of that number; it is always the same one."""
    rng = _rng(seed, number, "machine")
    while True:
        motions = "\n".join([HEAD, *_motions(rng)])
        try:
            built = build(motions)
        except InputError:  # some drawn polynomials are refused
            continue
        rules = "\n".join(["rules = [", *(f"    {rule}," for rule in _rules(rng, built)), "]"])
        code = f"{motions}\n{rules}\n"
        return Machine(seed, number, code, build(rules, built))


def build(code: str, names: Mapping[str, Any] = MappingProxyType({})) -> dict[str, Any]:
    """Return the names that a machine's code gives, those that are there already among them."""
    found = dict(names)
    exec(code, found)  # noqa: S102 - the code is our own
    return found


def _rng(*words: object) -> Rng:
    return np.random.default_rng([*":".join(map(str, words)).encode()])


def _motions(rng: Rng) -> Iterator[str]:
    """Yield the lines of a machine without rules."""
    number = int(rng.choice([2, 2, 3]))
    names = ["a", "b", "c"][:number]
    for name, turrets in zip(names, (0.7, 0.15, 0.3), strict=False):
        is_turret = bool(rng.random() < turrets)
        count = int(rng.choice([1, 1, 1, 2, 3] if is_turret else [2, 2, 2, 3, 4]))
        for place in range(count):
            yield f"law_{name}{place} = {_law(rng)}"
        yield _motion(rng, name, _heights(rng, count, is_turret), is_turret)
    rate = _digits(np.exp(rng.uniform(np.log(100), np.log(20_000))), 4)
    yield f"diagram = cm.TimingDiagram([{', '.join(names)}], rate_per_hour={rate})"


def _rules(rng: Rng, built: dict[str, Any]) -> Iterator[str]:
    """Yield the code of some rules; mostly ones that the machine just keeps."""
    tracks = tracks_of(built["diagram"])
    keeps = rng.random() < 0.8
    for _ in range(rng.choice([1, 1, 2, 3])):
        first, second = (str(name) for name in rng.permutation([*tracks])[:2])
        grid = np.concatenate([np.arange(0, 360, 0.5), tracks[first].grid, tracks[second].grid])
        other = tracks[second].offset(grid)
        kind, limit = rng.choice(["within"] * 3 + ["beyond"]), _limit(rng, other)
        is_open = other > limit if kind == "within" else other <= limit
        only_while = f'cm.{kind}("{second}", {limit})'
        kind, own = rng.choice(["beyond"] * 3 + ["within"]), tracks[first].offset(grid)
        limit = _limit(rng, own)
        if keeps and is_open.any():
            room, side = rng.choice([1e-3, 0.05, 0.3]) * np.ptp(own), 1 if kind == "beyond" else -1
            limit = float(_digits(side * (side * own[is_open]).max() + side * room, 6))
            limit = max(limit, 0.0) if tracks[first].pitch_mm else limit  # as far as a stop is
        yield f'cm.ClearanceRule(cm.{kind}("{first}", {limit}), only_while={only_while})'


def _limit(rng: Rng, offsets: Array) -> float:
    """Return a limit somewhere in a range, now and then near to an end of it."""
    share = rng.choice([rng.uniform(0.02, 0.98), rng.uniform(0, 0.05), rng.uniform(0.95, 1)])
    return float(_digits(offsets.min() + share * np.ptp(offsets), 6))


def _heights(rng: Rng, moves: int, turret: bool) -> Any:
    """Return where it begins and where each move ends, in mm."""
    size = float(np.exp(rng.uniform(np.log(0.02), np.log(300))))
    start = rng.choice([0, 5.26, rng.uniform(-50, 50)])
    steps = size * rng.uniform(0.2, 1, moves) * rng.choice([-1, 1])
    if turret and moves > 1 and rng.random() < 0.3:
        steps[-1] *= -0.2  # it goes a little too far and comes back
    if not turret:
        steps[1::2] *= -1
        steps[-1] -= steps.sum()
    return np.round([start, *(start + np.cumsum(steps))], int(rng.choice([3, 6])))


def _motion(rng: Rng, name: str, heights: Any, turret: bool) -> str:
    """Return the line that makes a motion."""
    parts = []
    changes = np.round(np.diff(heights), 9)
    dwells = rng.random(len(changes)) < rng.choice([0, 0.6, 0.9])
    widths = iter(_widths(rng, len(changes) + int(dwells.sum())))
    for place, (change, dwells_then) in enumerate(zip(changes, dwells, strict=True)):
        kind = "rise" if change > 0 else "return_"
        law = f"law_{name}{place}"
        parts.append(f"cm.{kind}({abs(change)}, over_deg={next(widths)}, law={law})")
        if dwells_then:
            parts.append(f"cm.dwell({next(widths)})")
    if rng.random() < 0.3:  # begin in the middle of the list: with a dwell, or another move
        parts = [*parts[-1:], *parts[:-1]] if dwells[-1] else parts
    start_deg = rng.choice([0, 150, rng.uniform(0, 360), rng.uniform(-800, 1500)])
    more = f"start_deg={_digits(start_deg, 7)}, start_mm={heights[0]}"
    stops = f"stops={rng.choice([1, 2, 3, 8, 24])}, " if turret else ""
    maker = "indexing_motion" if turret else "motion"
    lines = "".join(f"    {part},\n" for part in parts)
    return f'{name} = cm.{maker}(\n    "{name}",\n{lines}    {stops}{more},\n)'


def _widths(rng: Rng, count: int) -> list[float]:
    """Return angles in deg that fill the turn."""
    grain = float(rng.choice([5, 1, 1e-2, 1e-5]))
    shares = rng.dirichlet(np.full(count, rng.choice([1.0, 5.0])))
    widths = np.maximum(np.round(shares * 360 / grain), 1) * grain
    widths[np.argmax(widths)] += 360 - widths.sum()
    return [float(width) for width in np.round(widths, 6)]


def _law(rng: Rng) -> str:
    """Return the code of a law."""
    makers: list[Callable[[Rng], str]] = [
        *[_named] * 4,
        *(_scca, _slow, _straight, _leaning, _two_parabolas),
        *(_boundaries, _dipping, _overshooting, _wavy, _points, _reversed, _part),
    ]
    return makers[rng.integers(len(makers))](rng)


def _named(rng: Rng) -> str:
    return f"cm.LAWS[{str(rng.choice([*cm.LAWS]))!r}]"


def _scca(rng: Rng) -> str:
    b, c = (round(float(part), 3) for part in rng.dirichlet([1, 1, 1])[:2])
    return f"cm.scca({b}, {c}, {round(1 - b - c, 3)})"


def _slow(rng: Rng) -> str:
    return f"{_named(rng)}.with_constant_velocity({_digits(rng.uniform(0, 0.9), 3)})"


def _straight(rng: Rng) -> str:
    return f"cm.fifth_degree_linear({_digits(rng.uniform(0, 0.9), 3)})"


def _leaning(rng: Rng) -> str:
    """Draw a polynomial of degree six from rest to rest, without symmetry."""
    lean = _digits(rng.uniform(-12, 12), 3)
    form = f"10*x**3 - 15*x**4 + 6*x**5 + ({lean})*x**3*(1 - x)**3"
    return f'cm.MotionLaw("leaning {lean}", {form})'


def _two_parabolas(rng: Rng) -> str:
    """Draw a law that is harder at one end than at the other."""
    turn = _digits(rng.uniform(0.05, 0.95), 3)
    form = f"sympy.Piecewise((x**2/{turn}, x <= {turn}), (1 - (1 - x)**2/(1 - {turn}), True))"
    return f'cm.MotionLaw("parabolas {turn}", {form})'


def _boundaries(rng: Rng) -> str:
    v, w = (_digits(v, 3) for v in rng.uniform(0, 1.2, 2))
    a, b = (_digits(a, 3) for a in rng.uniform(-2, 2, 2))
    return f"cm.polynomial((0, {v}, {a}), (1, {w}, {b}), name='ends {v} {a} {w} {b}')"


def _dipping(rng: Rng) -> str:
    dip = _digits(rng.uniform(0.05, 2), 3)
    return f'cm.MotionLaw("dipping {dip}", x**2*((1 + {dip})*x - {dip}))'


def _overshooting(rng: Rng) -> str:
    over = _digits(rng.uniform(0.05, 2), 3)
    return f'cm.MotionLaw("overshooting {over}", 1 - (1 - x)**2*((1 + {over})*(1 - x) - {over}))'


def _wavy(rng: Rng) -> str:
    waves, size = rng.integers(1, 4), _digits(rng.uniform(-0.25, 0.25), 3)
    return f'cm.MotionLaw("wavy {waves} {size}", x - ({size})*sympy.sin(2*{waves}*sympy.pi*x))'


def _points(rng: Rng) -> str:
    count = int(rng.integers(5, 14))
    places = np.round(np.linspace(0, 1, count), 4)
    ways = places**2 * (3 - 2 * places) + rng.choice([0, 0.01, 0.05]) * rng.normal(size=count)
    ways = np.round(np.clip(ways, -0.5, 1.5), 5)
    ways[[0, -1]] = 0, 1
    named = f"points {rng.integers(10**6)}"
    return f"cm.law_from_points({places.tolist()}, {ways.tolist()}, name={named!r})"


def _reversed(rng: Rng) -> str:
    makers = [_leaning, _two_parabolas, _boundaries, _dipping, _points]
    return f"{makers[rng.integers(len(makers))](rng)}.reversed()"


def _part(rng: Rng) -> str:
    start, end = sorted(rng.uniform(0, 1, 2))
    return f"{_named(rng)}.part({_digits(start * 0.9, 3)}, {_digits(0.1 + 0.9 * end, 3)})"


def _digits(value: Any, digits: int) -> str:
    """Return a number with so many digits, as code."""
    return repr(float(f"{float(value):.{digits}g}"))
