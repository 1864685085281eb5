"""The machine in motion: one SVG that shows designs side by side, all by one clock.

It moves by its own (SMIL) animation elements, with no script: in a page, in an `<img>`, in a
notebook's stored output. In the lab a player pauses, scrubs and slows down the same SVG.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from cammotion.arguments import checked
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError, Quantity, shorten
from cammotion.rules.checks import every_rule
from cammotion.rules.rule import Rule
from cammotion.views.animation import svg
from cammotion.views.animation.columns import INNER_PX, Design, Layout
from cammotion.views.animation.dies import find_dies
from cammotion.views.animation.magnifier import MAGNIFICATION
from cammotion.views.animation.moving_picture import MovingPicture
from cammotion.views.animation.player import SHOWN_ANGLE
from cammotion.views.animation.scene import Scene
from cammotion.views.animation.still import Still, stopped
from cammotion.views.named import names_in_full, readable, short_diagram, short_rule
from cammotion.views.names import printable

TURN = Quantity("time of a turn in the animation", "s", example=9)
COLUMNS = 2  # more designs come below: smaller, they could not be read
MARGIN_PX = 12
COLUMN_PX = INNER_PX + 2 * MARGIN_PX
STILL_HEADER_PX = 52
LARGE: dict[str, Any] = {"size": svg.LARGE, "font_weight": "bold"}
_MAGNIFIED = "Both edges of a die at the rim are shown {:g} times as large too."
UNTITLED = "One turn of the camshaft"


@dataclass(frozen=True)
class Animation(MovingPicture):
    """Designs in motion on one clock; made by `animate`.

    As the last line of a cell it is a player; without a kernel it is the moving picture.
    """

    designs: tuple[Design, ...]
    turn_s: float
    magnify: float | None = None

    @cached_property
    def svg(self) -> str:
        """The SVG, which moves by itself; the same designs give the same text."""
        layout = Layout(self.designs, self.turn_s, self.magnify)
        titles = ", ".join(design.title for design in self.designs)
        columns = [layout.draw_column(design, n) for n, design in enumerate(self.designs)]
        title = f"The machine in motion: {titles}"
        return _sheet(columns, layout.height, title, self.description)

    def still(self, angle_deg: float) -> Still:
        """Return a picture of the machines at a cam angle from 0 to 360 deg, without the charts.

        Raises InputError for any other angle.

        >>> import cammotion as cm
        >>> animation = animate(cm.EXAMPLE.diagram, rules=cm.EXAMPLE.rule, magnify=10)
        >>> print(animation.still(135).description)
        At a cam angle of 135°: mill 0.645 mm from a stop, die at 0 mm
        """
        angle = SHOWN_ANGLE.number(angle_deg)
        scenes = [Scene(d.diagram, d.rules, INNER_PX, self.magnify) for d in self.designs]
        height = STILL_HEADER_PX + max(scene.height for scene in scenes)
        columns, said = [], []
        for design, scene in zip(self.designs, scenes, strict=True):
            state = design.state(angle)
            header = "" if design.title == UNTITLED else f"{design.title}: "
            said.append(f"{header}{state}")
            columns.append(
                svg.placed(
                    *(0, 0),
                    svg.label(f"{header}cam angle {angle:g}°", 0, 20, width=INNER_PX, **LARGE),
                    svg.label(state, 0, 39, width=INNER_PX),
                    svg.placed(0, STILL_HEADER_PX, scene.draw(self.turn_s, design.broken_arcs())),
                )
            )
        description = f"At a cam angle of {angle:g}°: {'; '.join(said)}"
        moving = _sheet(columns, height, f"The machine at {angle:g}°", description)
        return Still(stopped(moving, angle), printable(description))

    @property
    def description(self) -> str:
        """What there is to see, in words."""
        diagram = self.designs[0].diagram
        return "\n".join(
            [
                f"The machine in motion, {diagram.cycle_time_s:.4g} s a turn "
                f"({diagram.rate_per_hour:g} pieces/h), shown in {self.turn_s:g} s.",
                *(f"{design.title} ({design.describe()})" for design in self.designs),
                *dict.fromkeys(said for design in self.designs for said in design.in_full),
                *([_MAGNIFIED.format(self.magnify)] if self.magnify else []),
            ]
        )

    @property
    def cycle_s(self) -> float:
        """How long a turn takes in the machine, in s."""
        return float(self.designs[0].diagram.cycle_time_s)


@checked
def animate(
    designs: TimingDiagram | Mapping[str, TimingDiagram],
    *,
    rules: Rule | Iterable[Rule] = (),
    turn_s: float = 9.0,
    magnify: float | None = None,
) -> Animation:
    """Show one or more designs in motion, side by side and all by one clock.

    `designs` is a timing diagram, or several by their titles; they have one machine rate. `rules`
    are the clearance rules, which hold for all of them: what a rule links with an indexing motion
    is drawn as a die over the turret, and where a rule is broken that is shown. `turn_s` is
    how long one turn takes in the SVG, in s. `magnify`, from 1 to 50, shows both edges of each die
    at the rim so many times as large, below the turret. Raises InputError for anything else, and
    where there is no die to magnify.

    >>> import cammotion as cm
    >>> before, rule = cm.EXAMPLE.diagram, cm.EXAMPLE.rule
    >>> after = cm.widest_move(before, "die", rule).diagram
    >>> print(animate({"no overlap": before, "overlap": after}, rules=rule).description)
    The machine in motion, 1.8 s a turn (2000 pieces/h), shown in 9 s.
    no overlap (peak acceleration: mill 1.12, die 4.15 m/s²; rule kept)
    overlap (peak acceleration: mill 1.12, die 0.806 m/s²; rule kept)
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
    return Animation(made, turn, None if magnify is None else _magnification(magnify, made))


def _magnification(magnify: Any, designs: Iterable[Design]) -> float:
    times = MAGNIFICATION.number(magnify)
    for design in designs:
        if not any(find_dies(design.diagram, design.rules).values()):
            raise InputError(
                f"The design {design.title!r} has no die to magnify: give the clearance rules that "
                "link a motion with an indexing one, or leave magnify out."
            )
    return times


def _sheet(columns: Sequence[Any], height: float, title: str, description: str) -> str:
    """Return the SVG of columns `height` px high, side by side and below one another."""
    whole = height * -(-len(columns) // COLUMNS)
    width = COLUMN_PX * min(len(columns), COLUMNS)
    drawing = svg.sheet(width, whole, printable(title), printable(description))
    for number, column in enumerate(columns):
        row, place = divmod(number, COLUMNS)
        drawing.append(svg.placed(place * COLUMN_PX + MARGIN_PX, row * height, column))
    return str(drawing.as_svg(header=""))


def _design(title: Any, diagram: Any, rules: Any) -> Design:
    if not isinstance(title, str) or not printable(title):
        raise InputError(f"The title of a design is {shorten(title)}: give one like 'overlap'.")
    if not isinstance(diagram, TimingDiagram):
        raise InputError(
            f"The design {title!r} is {shorten(diagram)}: give a TimingDiagram of the motions, for "
            "example TimingDiagram([mill, die], rate_per_hour=2000)."
        )
    found = every_rule(readable(diagram), rules)
    return Design(
        printable(title),
        short_diagram(readable(diagram)),
        tuple(short_rule(diagram, rule) for rule in found),
        tuple(names_in_full(diagram)),
    )
