"""Names of what stands close together, in a column at either side, each with a line to its own."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import drawsvg as draw

from cammotion.views.animation import svg
from cammotion.views.animation.charts import LABEL_PX
from cammotion.views.ends import apart
from cammotion.views.names import names_that_fit, text_px
from cammotion.views.plots import colour

ASIDE_PX = 120  # how wide a column is
_EDGE_PX, _LINE_PX = 8, 4


@dataclass(frozen=True)
class Named:
    """What has a name: its number, and its place in px."""

    number: int
    name: str
    x: float
    y: float


def names_aside(named: Iterable[Named], width: float, span: tuple[float, float]) -> Iterable[Any]:
    """Yield the names in columns at both sides of `width` px, from `span[0]` down to `span[1]`."""
    each_own = [*named]
    called = names_that_fit([each.name for each in each_own], _fit)
    short = [replace(each, name=name) for each, name in zip(each_own, called, strict=True)]
    given = sorted(short, key=lambda each: each.y)
    for is_left in (True, False):
        yield from _column([n for n in given if (n.x < width / 2) == is_left], width, span, is_left)


def _fit(names: Sequence[str]) -> bool:
    return all(text_px(name, svg.SMALL) <= ASIDE_PX for name in names)


def _column(
    these: Sequence[Named], width: float, span: tuple[float, float], is_left: bool
) -> Iterable[Any]:
    way, edge = (1, _EDGE_PX) if is_left else (-1, width - _EDGE_PX)
    for each, y in zip(these, apart([n.y for n in these], LABEL_PX, *span), strict=True):
        end = edge + way * (text_px(each.name, svg.SMALL) + _LINE_PX)
        line = draw.Path(stroke=colour(each.number), stroke_width=0.8, fill="none")
        yield line.M(svg.px(end), svg.px(y)).L(svg.px(each.x), svg.px(each.y))
        yield svg.label(
            each.name,
            edge,
            y + 4,
            width=ASIDE_PX,
            size=svg.SMALL,
            text_anchor="start" if is_left else "end",
            fill=svg.dark(each.number),
        )
