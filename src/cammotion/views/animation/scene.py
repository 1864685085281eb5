"""The machine of a timing diagram: drawings of its mechanisms, from left to right and down.

A picture of a new kind of mechanism is a class like `Slide` in a file of its own, and an entry in
KINDS.
"""

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, Protocol

import drawsvg as draw

from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.rules.rule import Rule
from cammotion.views.animation import svg
from cammotion.views.animation.magnifier import Magnifier
from cammotion.views.animation.slide import Slide
from cammotion.views.animation.turret import Turret

_ROUNDING_PX = 1.0


class Drawing(Protocol):
    """A picture of one mechanism, or of a few that belong together.

    `names` are those of its motions; `width` and `height` are in px, with the room below it.
    """

    names: Sequence[str]
    width: float
    height: float

    @classmethod
    def find(
        cls, diagram: TimingDiagram, rules: Iterable[Rule], left: list[str], width: float
    ) -> "Sequence[Drawing]":
        """Return what can be drawn so of the motions that are `left`; a row is `width` wide."""

    def draw(self, turn_s: float, broken_arcs: dict[str, list[Arc]]) -> Any:
        """Draw it from (0, 0) to the right and down; `broken_arcs` are arcs by motion."""


KINDS: Sequence[type[Drawing]] = (Turret, Slide)
"""The kinds of mechanisms. Each takes of the motions what it can draw, and the last takes all."""


class Scene:
    """The drawings of a machine, in rows that are `width` px wide.

    Under each turret with dies its edges are seen `magnify` times as large, where that is given.
    """

    def __init__(
        self,
        diagram: TimingDiagram,
        rules: Iterable[Rule],
        width: float,
        magnify: float | None = None,
    ) -> None:
        drawings = _drawings(diagram, list(rules), width, magnify)
        self._placed = [*_in_rows(drawings, width)]
        self.height = max(top + drawing.height for _, top, drawing in self._placed)

    def draw(self, turn_s: float, broken_arcs: dict[str, list[Arc]]) -> Any:
        """Draw the machine from (0, 0) to the right and down; `broken_arcs` are arcs by motion."""
        placed = (
            svg.placed(x, y, drawing.draw(turn_s, broken_arcs)) for x, y, drawing in self._placed
        )
        return draw.Group([*placed])


def _drawings(
    diagram: TimingDiagram, rules: Iterable[Rule], width: float, magnify: float | None
) -> Iterator["Drawing | Magnifier"]:
    left = list(diagram.names)
    for kind in KINDS:
        for drawing in kind.find(diagram, rules, left, width):
            yield drawing
            if magnify is not None and isinstance(drawing, Turret) and drawing.dies:
                yield Magnifier(drawing, magnify)
            left = [name for name in left if name not in drawing.names]


def _in_rows(
    drawings: Iterable["Drawing | Magnifier"], width: float
) -> Iterator[tuple[float, float, "Drawing | Magnifier"]]:
    """Yield each drawing after its place; a row is as high as the highest in it."""
    x: float = 0
    y: float = 0
    row: float = 0
    for drawing in drawings:
        if x + drawing.width > width + _ROUNDING_PX:
            x, y, row = 0, y + row, 0
        yield x, y, drawing
        x, row = x + drawing.width, max(row, drawing.height)
