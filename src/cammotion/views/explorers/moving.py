"""Motions of a live figure: what a mechanism does over the turn, in symbols of the controls."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import sympy as sp

from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.symbols import x
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN, MM_PER_M
from cammotion.machine.motions import Motion
from cammotion.quantities import InputError
from cammotion.views.live.expressions import as_expression
from cammotion.views.live.parts import Control, Line, Say
from cammotion.views.named import names_in_full

ALPHA = sp.Symbol("alpha", real=True)  # the cam angle, in deg, over which a figure draws a turn
SECONDS_BY_DEG_AND_RATE = 10  # tm = 10 Bm / N
_0, _360 = sp.Integer(0), sp.Integer(DEG_PER_TURN)
Span = tuple[float, float, float]
LARGEST = 1e300  # above it a peak is infinite
_SLOW = 0.5  # m/s2: half of it has fewer than three digits among three decimals


@dataclass(frozen=True)
class Part:
    """A part of the turn: over an angle in deg, by so many mm, by a law unless it is a dwell."""

    angle: Any
    change_mm: Any = 0
    law: MotionLaw | None = None


@dataclass(frozen=True)
class Moving:
    """A motion from its `start`, in deg, at `start_mm`: its parts fill the turn.

    `is_indexing` says that it goes on by a pitch each turn and does not come back.
    """

    start: Any
    parts: tuple[Part, ...]
    start_mm: float = 0.0
    is_indexing: bool = False

    @property
    def ends(self) -> list[Any]:
        """How far after the start each part ends, in deg."""
        return [sum(part.angle for part in self.parts[: n + 1]) for n in range(len(self.parts))]

    @property
    def joints(self) -> list[Any]:
        """The cam angles in the turn at which one part passes into the next."""
        return [sp.Mod(self.start + end, DEG_PER_TURN) for end in (0, *self.ends[:-1])]

    def position(self) -> sp.Expr:
        """Return where the motion is, in mm, from 0 on each turn."""
        return self.start_mm + self._over_parts(0)

    def displacement(self) -> sp.Expr:
        """Return the position as it is drawn: an indexing motion from the stop nearest at 0 deg."""
        if not self.is_indexing:
            return self.position()
        pitch = sum(part.change_mm for part in self.parts)
        turns = (ALPHA - self.start - self._since()) / DEG_PER_TURN
        way = self.position() + pitch * turns
        return way - pitch * sp.floor(
            way.xreplace({ALPHA: sp.Integer(0)}) / pitch + 1 / sp.Integer(2)
        )

    def line(self, **how: Any) -> Line:
        """Return the curve of the displacement."""
        return Line(y=self.displacement(), joints=self.joints, **how)

    def offset(self) -> sp.Expr:
        """Return what a clearance is judged by, in mm: of an indexing motion, from a stop."""
        if not self.is_indexing:
            return self.position()
        pitch = sum(part.change_mm for part in self.parts)
        way = self.position() if pitch > 0 else -self.position()
        return sp.Min(way, abs(pitch) - way, evaluate=False)

    def acceleration(self, rate: Any) -> sp.Expr:
        """Return the acceleration in m/s² at a machine rate in pieces per hour."""
        return self._over_parts(2, rate)

    def by_rad(self, order: int) -> sp.Expr:
        """Return a derivative of the position by the cam angle, in mm/rad or mm/rad²."""
        per_rad = SECONDS_BY_DEG_AND_RATE * 180 / sp.pi  # the rate at which a second takes a rad
        return MM_PER_M * self._over_parts(order, per_rad)

    def peak(self, rate: Any) -> sp.Expr:
        """Return the largest acceleration in m/s², by the factors Ca of the laws."""
        peaks = [
            as_expression(part.law.Ca) * abs(part.change_mm) * _per_time(part.angle, rate, 2)
            for part in self.parts
            if part.law
        ]
        return sp.Max(*peaks, evaluate=False) if len(peaks) > 1 else peaks[0]

    def _since(self) -> sp.Expr:
        """Return how far the turn that begins at the start has come, in deg."""
        return sp.Mod(ALPHA - self.start, DEG_PER_TURN, evaluate=False)

    def _over_parts(self, order: int, rate: Any = None) -> sp.Expr:
        """Return a derivative of the position, each part by its law since it began."""
        since = self._since()
        pieces, come, begin = [], sp.Integer(0), sp.Integer(0)
        for part, end in zip(self.parts, self.ends, strict=True):
            value = come if order == 0 else sp.Integer(0)
            if part.law:
                curve = (part.law.s, part.law.v, part.law.a)[order]
                scale = part.change_mm * (1 if order == 0 else _per_time(part.angle, rate, order))
                value += scale * curve.xreplace({x: (since - begin) / part.angle})
            pieces.append((value, since <= end))
            come, begin = come + part.change_mm, end
        last = pieces.pop()[0]
        return sp.Piecewise(*pieces, (last, True), evaluate=False)


def tens(start: float, low: float, high: float) -> float:
    """Return the power of ten by which a span has to be taken for a start far off it; else 1.

    So a figure of a machine of another size has controls and axes of that size. A start up to ten
    times above the span only widens it.

    >>> tens(50, 5, 100), tens(300, 5, 100), tens(0.02, 5, 100), tens(4000, 5, 100)
    (1.0, 1.0, 0.001, 100.0)
    """
    return 1.0 if low <= start <= 10 * high else float(f"1e{math.floor(math.log10(start / low))}")


def sized(span: Span, times: float) -> Span:
    """Return a span (low, high, step) of a control so many times as large.

    >>> sized((5, 100, 1), 0.001)
    (0.005, 0.1, 0.001)
    """
    low, high, step = (float(f"{each * times:.12g}") for each in span)
    return low, high, step


def control(name: str, span: Span, start: float, unit: str = "deg") -> Control:
    """Return a control over a span (low, high, step), made as wide as its start and `high` need."""
    low, high, step = span
    low, high = min(low, high / 2, start), max(high, start)
    return Control(
        low=low, high=high, step=min(step, high - low), start=start, name=name, unit=unit
    )


def work_deg(motion: Motion) -> float:
    """Return how long a motion that rises and returns stays at its far end, in deg."""
    down, up = motion.moves
    return round(up.from_deg - down.to_deg, 9)


def heights(motions: Iterable[Motion], moving: Iterable[Moving]) -> tuple[sp.Expr, sp.Expr]:
    """Return limits in mm of an axis for motions as they are drawn, whatever is their angle."""
    ranges = [[end - m.start_mm * m.is_indexing for end in m.range_mm] for m in motions]
    low, high = min(map(min, ranges)), max(map(max, ranges))
    room = (high - low) / 16
    over_zero = [m.displacement().xreplace({ALPHA: at}) for m in moving for at in (_0, _360)]
    lowest, highest = (
        f(*over_zero, end, evaluate=False) for f, end in ((sp.Min, low), (sp.Max, high))
    )
    return lowest - room, highest + 2 * room


def of_peaks(diagram: TimingDiagram) -> str:
    """Return the format of peak accelerations: three decimals, or digits where all is slow."""
    hardest = max(diagram.peak_acceleration(name) for name in diagram.names)
    return ".3f" if hardest >= _SLOW else ".3g"


def of_lengths(largest_mm: float) -> str:
    """Return the format of lengths up to one: three digits, or all before the point.

    >>> of_lengths(50), of_lengths(4000)
    ('.3g', '.4g')
    """
    return f".{max(3, 1 + math.floor(math.log10(largest_mm)))}g"


def full_names(diagram: TimingDiagram, *names: str) -> list[Say]:
    """Return a sentence for each of the names, all unless given, that a figure shortens."""
    return [Say("{said}", {"said": said}) for said in names_in_full(diagram, *names)]


def check_rests(motions: Iterable[Motion]) -> None:
    """Raise InputError for moves that go on into the next, whose peaks no law says alone."""
    for motion in motions:
        factors = [as_law(move.law).Ca for move in motion.moves]
        if math.isinf(max(factors)) and math.isfinite(motion.peak(2)):
            raise InputError(
                f"The motion '{motion.name}' goes from one move into the next without coming to "
                "rest, which cannot be explored with other angles: give moves from rest to rest."
            )


def _per_time(angle: Any, rate: Any, order: int) -> sp.Expr:
    """Return what makes a stroke in mm a velocity or acceleration, in m, by the indexing time."""
    return (rate / (SECONDS_BY_DEG_AND_RATE * angle)) ** order / sp.Integer(1000)
