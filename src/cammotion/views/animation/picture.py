"""The machine in motion: one SVG that shows designs side by side, all by one clock.

It moves by its own (SMIL) animation elements, with no script: in a page, in an `<img>`, in a
notebook's stored output. In the lab a player pauses, scrubs and slows down the same SVG.
"""

import base64
import html
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import drawsvg as draw

from cammotion.files import write_new
from cammotion.machine.clearance import ClearanceRule, as_rules
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError, Quantity, shorten
from cammotion.views.animation import svg
from cammotion.views.animation.columns import INNER_PX, Design, Layout
from cammotion.views.animation.player import Player

TURN = Quantity("time of a turn in the animation", "s", example=9)
COLUMNS = 2  # more designs come below: smaller, they could not be read
MARGIN_PX = 12
COLUMN_PX = INNER_PX + 2 * MARGIN_PX
UNTITLED = "One turn of the camshaft"


@dataclass(frozen=True)
class Animation:
    """Designs in motion on one clock; made by `animate`.

    As the last line of a cell it is a player; without a kernel it is the moving picture.
    """

    designs: tuple[Design, ...]
    turn_s: float

    @cached_property
    def svg(self) -> str:
        """The SVG, which moves by itself; the same designs give the same text."""
        rows = -(-len(self.designs) // COLUMNS)
        width = COLUMN_PX * min(len(self.designs), COLUMNS)
        layout = Layout(self.designs, self.turn_s)
        drawing = draw.Drawing(
            width,
            layout.height * rows,
            class_="cm-still",
            role="img",
            font_family=svg.FONT,
            style="background: white",
        )
        drawing.append_css(svg.STYLE)
        titles = ", ".join(svg.printable(design.title) for design in self.designs)
        drawing.append_title(f"The machine in motion: {titles}")
        drawing.append(svg.Description(svg.printable(self.description)))
        drawing.append(svg.box(0, 0, width, layout.height * rows, fill="white"))
        for number, design in enumerate(self.designs):
            row, column = divmod(number, COLUMNS)
            place = column * COLUMN_PX + MARGIN_PX, row * layout.height
            drawing.append(svg.placed(*place, layout.draw_column(design, number)))
        return str(drawing.as_svg(header=""))

    @property
    def description(self) -> str:
        """What there is to see, in words."""
        diagram = self.designs[0].diagram
        return "\n".join(
            [
                f"The machine in motion, {diagram.cycle_time_s:.4g} s a turn "
                f"({diagram.rate_per_hour:g} pieces/h), shown in {self.turn_s:g} s.",
                *(f"{design.title} ({design.describe()})" for design in self.designs),
            ]
        )

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write the SVG to a file and return its path.

        A file that is there already is left as it is, with an InputError, unless `overwrite` is
        True.
        """
        return write_new(path, self.svg, overwrite=overwrite)

    def player(self) -> Player:
        """Return the SVG with a clock to play, pause and scrub, for the lab."""
        picture = base64.b64encode(self.svg.encode()).decode("ascii")
        image = (
            f'<figure style="margin: 0"><img alt="{html.escape(self.description)}" '
            f'style="max-width: 100%" src="data:image/svg+xml;base64,{picture}"></figure>'
        )
        return Player(
            self.svg,
            turn_s=self.turn_s,
            cycle_s=self.designs[0].diagram.cycle_time_s,
            reader={"text/html": image, "text/plain": self.description},
        )

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        return self.player()._repr_mimebundle_(**kwargs)


def animate(
    designs: TimingDiagram | Mapping[str, TimingDiagram],
    *,
    rules: ClearanceRule | Iterable[ClearanceRule] = (),
    turn_s: float = 9.0,
) -> Animation:
    """Show one or more designs in motion, side by side and all by one clock.

    `designs` is a timing diagram, or several by their titles; they have one machine rate. `rules`
    are the clearance rules, which hold for all of them: what a rule links with an indexing motion
    is drawn as a die over the turret, and where a rule is broken a collision is shown. `turn_s` is
    how long one turn takes in the SVG, in s. Raises InputError for anything else.

    >>> import cammotion as cm
    >>> before, rule = cm.EXAMPLE.diagram, cm.EXAMPLE.rule
    >>> after = cm.widest_move(before, "die", rule).diagram
    >>> print(animate({"no overlap": before, "overlap": after}, rules=rule).description)
    The machine in motion, 1.8 s a turn (2000 pieces/h), shown in 9 s.
    no overlap (peak acceleration: mill 1.12, die 4.15 m/s²; no collision)
    overlap (peak acceleration: mill 1.12, die 0.806 m/s²; no collision)
    """
    named = {UNTITLED: designs} if isinstance(designs, TimingDiagram) else designs
    if not isinstance(named, Mapping) or not named:
        raise InputError(
            f"The designs to animate are {shorten(designs)}: give a TimingDiagram, or several by "
            "their titles, for example {'before': before, 'after': after}."
        )
    turn = TURN.number(turn_s)
    given = tuple(rules) if isinstance(rules, Iterable) else rules
    made = tuple(_design(title, diagram, given) for title, diagram in named.items())
    rates = list(dict.fromkeys(design.diagram.rate_per_hour for design in made))
    if len(rates) > 1:
        raise InputError(
            f"The machine rates of the designs are {rates[0]:g} and {rates[1]:g} pieces/h; they "
            "run by one clock: give all designs the same rate."
        )
    return Animation(made, turn)


def _design(title: Any, diagram: Any, rules: Any) -> Design:
    if not isinstance(title, str) or not svg.printable(title):
        raise InputError(f"The title of a design is {shorten(title)}: give one like 'overlap'.")
    if not isinstance(diagram, TimingDiagram):
        raise InputError(
            f"The design {title!r} is {shorten(diagram)}: give a TimingDiagram of the motions, for "
            "example TimingDiagram([mill, die], rate_per_hour=2000)."
        )
    return Design(svg.printable(title), diagram, () if rules == () else as_rules(diagram, rules))
