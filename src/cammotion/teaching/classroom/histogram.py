"""A histogram as one SVG: no script, a text beside it for who does not see it."""

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

_WIDTH, _HEIGHT = 660, 230
_TOP, _FOOT, _SIDE = 44, 190, 30
_MOST_BARS = 10
_FAR = 3.0  # so many quartile distances away a value gets no scale of its own
_BEYOND = 1e15  # in steps; what is on the scale is within some millions
_JUST = 1e-9  # a value on an edge belongs to the bar above it


@dataclass(frozen=True)
class Bars:
    """Numbers counted in bars of one width, and how many lie beyond them at either end."""

    first: int
    step: float
    counts: tuple[int, ...]
    below: int
    above: int

    def edge(self, number: int) -> float:
        """Return where a bar begins; the one after the last is the end of the last."""
        return (self.first + number) * self.step


def count(values: Sequence[float], shown: Sequence[float] = ()) -> Bars:
    """Count numbers in bars of a round width; `shown` have to be on the scale but do not count.

    What lies far from most of them is counted at the ends, so that one odd number does not press
    all others into one bar.
    """
    inside = [*_not_far(sorted(values)), *shown]
    step = _round_step(inside)
    places = [_place(value, step) for value in values]
    scale = [_place(value, step) for value in inside]
    first, last = min(scale), max(scale)
    counted = tuple(places.count(place) for place in range(first, last + 1))
    below = sum(place < first for place in places)
    return Bars(first, step, counted, below, sum(place > last for place in places))


def _place(value: float, step: float) -> int:
    return math.floor(max(-_BEYOND, min(value / step, _BEYOND)) + _JUST)


def _not_far(values: list[float]) -> list[float]:
    if len(values) == 1:
        return values
    low, middle, high = statistics.quantiles(values, n=4, method="inclusive")
    reach = _FAR * ((high - low) or abs(middle) / 4 or 1.0)
    return [value for value in values if low - reach <= value <= high + reach]


def _round_step(values: Sequence[float]) -> float:
    """Return 1, 2 or 5 times a power of ten, so that there are not too many bars."""
    largest = max(abs(value) for value in values)
    least = max((max(values) - min(values)) / (_MOST_BARS - 1), largest * 1e-6)
    if max(values) == min(values):
        least = largest / 10
    power: float = 10.0 ** math.floor(math.log10(least)) if least > 0 else 1.0
    return next((n * power for n in (1, 2, 5) if n * power >= least * (1 - _JUST)), 10 * power)


def draw(values: Sequence[float], asked: str, true: float | None = None) -> str:
    """Return the histogram of numbers as SVG; the true value is marked if it is given."""
    bars = count(values, () if true is None else (true,))
    slots = [bars.below] * (bars.below > 0) + [*bars.counts] + [bars.above] * (bars.above > 0)
    before = int(bars.below > 0)
    width = (_WIDTH - 2 * _SIDE) / len(slots)
    rise = (_FOOT - _TOP) / max(slots)
    columns = [(_SIDE + i * width, _FOOT - rise * n, n) for i, n in enumerate(slots) if n]
    shapes = [
        f'<rect x="{x + 1:.1f}" y="{y:.1f}" width="{width - 2:.1f}" height="{_FOOT - y:.1f}"/>'
        for x, y, _ in columns
    ]
    shapes.append(f'<path d="M{_SIDE} {_FOOT}H{_WIDTH - _SIDE}"/>')
    texts = [_text(x + width / 2, y - 6, f"{n}") for x, y, n in columns]
    texts += [
        _text(_SIDE + (before + number) * width, _FOOT + 20, f"{bars.edge(number):.6g}")
        for number in range(len(bars.counts) + 1)
    ]
    if bars.below:
        texts.append(_text(_SIDE + width / 2, _FOOT + 36, "less"))
    if bars.above:
        texts.append(_text(_WIDTH - _SIDE - width / 2, _FOOT + 36, "more"))
    if true is not None:
        x = _SIDE + (before + true / bars.step - bars.first) * width
        line = f"M{x:.1f} {_TOP - 22}V{_FOOT}"
        shapes += [f'<path class="{kind}" d="{line}"/>' for kind in ("halo", "true")]
        texts.append(_text(x, _TOP - 28, f"true: {true:g}", "true"))
    parts = [*shapes, *texts]
    return (
        f'<svg class="histogram" role="img" viewBox="0 0 {_WIDTH} {_HEIGHT}" '
        f'aria-label="{escape(describe(bars, asked, true))}">{"".join(parts)}</svg>'
    )


def describe(bars: Bars, asked: str, true: float | None = None) -> str:
    """Say in words what the histogram shows."""
    total = sum(bars.counts) + bars.below + bars.above
    said = [f"Histogram of {total} predictions, {asked}."]
    if bars.below:
        said.append(f"Below {bars.edge(0):.6g}: {bars.below}.")
    for number, counted in enumerate(bars.counts):
        if counted:
            low, high = bars.edge(number), bars.edge(number + 1)
            said.append(f"From {low:.6g} to below {high:.6g}: {counted}.")
    if bars.above:
        said.append(f"From {bars.edge(len(bars.counts)):.6g} on: {bars.above}.")
    if true is not None:
        said.append(f"True is {true:g}.")
    return " ".join(said)


def _text(x: float, y: float, text: str, kind: str = "") -> str:
    style = f' class="{kind}"' if kind else ""
    return f'<text x="{x:.1f}" y="{y:.1f}"{style}>{escape(text)}</text>'
