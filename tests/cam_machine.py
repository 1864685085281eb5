"""The die and the turret of a machine with all that drives the die: camshaft, cam, roller, lever.

It is one SVG that moves by itself, like that of `animate`. The cam is no symbol: it is the one
that gives the die its motion through this lever.
"""

from collections.abc import Iterable
from functools import cached_property
from typing import Any

import drawsvg as draw
import numpy as np
from plate_cam import STEP_DEG, PlateCam

from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.diagram import TimingDiagram
from cammotion.quantities import InputError
from cammotion.rules.checks import as_rules
from cammotion.rules.clearance import ClearanceRule
from cammotion.views.animation import svg
from cammotion.views.animation.dial import draw_dial
from cammotion.views.animation.dies import Die, find_dies
from cammotion.views.animation.keyframes import CAMSHAFT, Trace
from cammotion.views.animation.picture import TURN
from cammotion.views.animation.turret import HALF_TURN, Turret
from cammotion.views.named import short_diagram, short_rule
from cammotion.views.names import printable
from cammotion.views.plots import colour

WIDTH_PX, HEIGHT_PX = 760, 380
TRAVEL_PX = 62.5  # of the die, and the measure of all sizes that do not follow from the machine
PIVOT_PX = (266.0, 96.0)
CAM = 2  # the number of its colour
FRAME: dict[str, Any] = {"fill": "#f1f1f1", "stroke": "#9a9a9a", "stroke_width": 1.5}
_BASE, _TIP, _TOOL, _GUIDE = 240.0, 170.0, 50.0, (48.0, 84.0)  # below pivot, pin or pivot
_BRACKET, _SPRING_X, _COILS = 58.0, 92.0, 5
_SEEN_PX, _FADE = 195.0, 0.09  # of the turret to each side; of that the share that fades away


def cam_machine(diagram: TimingDiagram, rule: ClearanceRule, *, turn_s: float = 9.0) -> str:
    """Return the SVG of a machine of one turret and one die, with the cam that drives the die.

    `rule` is the clearance rule that links the two; `turn_s` is how long one turn takes in the
    SVG, in s. Raises InputError for any other machine, and for a die that no good cam can drive.
    """
    found = find_dies(diagram, as_rules(diagram, (rule,)))
    if len(diagram.names) != len(found) + 1 or [*map(len, found.values())] != [1]:
        raise InputError(
            f"The motions of the diagram are {', '.join(map(repr, diagram.names))}: give one "
            "indexing motion and one other, and the clearance rule that links the two."
        )
    short, rule = short_diagram(diagram), short_rule(diagram, rule)
    ((name, (die,)),) = find_dies(short, (rule,)).items()
    turret = Turret(short.names.index(name), short[name], [die], WIDTH_PX)
    return _Machine(turret, die, TURN.number(turn_s)).draw()


class _Machine:
    """The drawing, in px about the lever's pivot."""

    def __init__(self, turret: Turret, die: Die, turn_s: float) -> None:
        self.die, self.turn_s = die, turn_s
        self.cam = PlateCam.fitting(die)
        self.scale = TRAVEL_PX / die.travel
        self.die_x = self.cam.die_arm * self.scale
        self.turret = turret.at_scale(self.scale, 2 * _SEEN_PX)
        self.turret.stroke_px = 1.2
        self.angles = self.cam.angles_deg

    def draw(self) -> str:
        """Draw it all and return the SVG."""
        drawing = svg.sheet(WIDTH_PX, HEIGHT_PX, "A cam drives a die", self._description)
        about_pivot = svg.placed(*PIVOT_PX)
        about_pivot.extend([*self._frame(), self._wheel(), self._ram(), self._guide()])
        about_pivot.extend([self._spring(), *self._camshaft(), self._lever(), self._pin()])
        about_pivot.extend(self._texts())
        drawing.append(about_pivot)
        drawing.append(svg.placed(WIDTH_PX - 74, 58, *self._dial()))
        return str(drawing.as_svg(header=""))

    @property
    def _description(self) -> str:
        mill, die = self.turret.motion, self.die.motion
        return printable(
            f"One turn of the camshaft, shown in {self.turn_s:g} s. A cam on the shaft lifts a "
            f"roller at the left end of a lever; the right end pushes the {die.name} "
            f"{self.die.travel:g} mm down, into a pocket of the {mill.name}, which has moved on "
            f"by {abs(mill.pitch_mm):g} mm before. A spring under the lever holds the roller on "
            "the cam."
        )

    def _wheel(self) -> Any:
        """Draw the part of the turret that is in sight; at both sides it fades away."""
        turret = self.turret
        top = self._pin_y.values.min() + _TIP + self.die.gap * self.scale
        radius = turret.radius * self.scale
        half = turret.width / 2
        fade = draw.LinearGradient(-half, 0, half, 0, gradientUnits="userSpaceOnUse", id="cm-fade")
        for at, light in ((0, "black"), (_FADE, "white"), (1 - _FADE, "white"), (1, "black")):
            fade.add_stop(at, light)
        area = {"x": -half, "y": -radius - 4, "width": 2 * half, "height": HEIGHT_PX}
        window = draw.Mask(maskUnits="userSpaceOnUse", id="cm-window", **area)
        window.append(svg.box(*area.values(), fill=fade))
        seen = draw.Group(mask=window)
        seen.append(turret.draw_wheel(turret.turning, self.turn_s))
        return svg.placed(self.die_x, top + radius, seen, turret.draw_arrow())

    @cached_property
    def _pin_y(self) -> Trace:
        """How far below the pivot the die's pin is, in px."""
        return Trace(self.angles, -self.scale * self.cam.pin_height(self.angles))

    def _frame(self) -> Iterable[Any]:
        """Draw what stands still: the ground, the shaft's bearing, the column and its bracket."""
        x, y = self._axis
        yield draw.Path(**FRAME).M(x - 30, _BASE).L(x - 15, y).h(30).L(x + 30, _BASE).Z()
        column = draw.Path(**FRAME).M(-19, _BASE).L(-17, 0).A(17, 17, 0, 0, 1, 17, 0)
        yield column.L(18, _BRACKET).H(svg.px(self.die_x)).v(14).H(18.5).L(22, _BASE).Z()
        left, right = x - 46, 50.0
        yield draw.Path(stroke="#777777", stroke_width=2, fill="none").M(left, _BASE).H(right)
        hatch = draw.Path(stroke="#999999", stroke_width=1, fill="none")
        for start in np.arange(left + 8, right, 9):
            hatch.M(svg.px(start), _BASE + 1).l(-8, 8)
        yield hatch

    def _camshaft(self) -> Iterable[Any]:
        """Draw the cam, turning on its shaft."""
        turning = svg.moving(CAMSHAFT, self.turn_s, "rotate", data={"part": "cam"})
        turning.append(self._profile())
        turning.append(draw.Circle(0, 0, 21, fill="white", stroke=colour(CAM), stroke_width=1.5))
        turning.append(draw.Circle(0, 0, 13, **svg.STEEL))
        turning.append(svg.box(-3, -16.5, 6, 7, fill="#555555"))  # the key
        least = float(np.abs(self.cam.profile(self.angles)).min()) * self.scale
        mark = draw.Path(stroke=colour(CAM), stroke_width=1.5, fill="none")
        turning.append(mark.M(0, svg.px(-least + 3)).v(12))
        yield svg.placed(*self._axis, turning)
        bold: dict[str, Any] = {"fill": svg.dark(CAM), "font_weight": "bold"}
        middle: dict[str, Any] = {"text_anchor": "middle"}
        x, y = self._axis
        yield svg.label("cam", x, y - 32, size=svg.LARGE, **bold, **middle)
        yield svg.label("camshaft", x, y + 42, **middle)
        way = draw.Path(fill="none", stroke=colour(CAM), stroke_width=2.5)
        yield svg.placed(x, y, way.M(44, -20).A(48.3, 48.3, 0, 0, 1, 45, 17.5))
        yield svg.placed(
            x + 45, y + 17.5, draw.Path(fill=colour(CAM)).M(5, 1.5).L(-4, -2).L(-3, 8).Z()
        )

    def _profile(self) -> Any:
        """Draw the profile: arcs where the die dwells, and from degree to degree elsewhere."""
        places = self.cam.profile(self.angles) * self.scale
        path = draw.Path(
            fill=svg.pale(CAM), stroke=colour(CAM), stroke_width=1.5, stroke_linejoin="round"
        )
        path.args["data-part"] = "profile"
        path.M(*_at(places[0]))
        for start, end, place in zip(self.angles, self.angles[1:], places[1:], strict=False):
            if end - start > STEP_DEG + ROUNDING_DEG:
                radius = svg.px(abs(place))
                path.A(radius, radius, 0, int(end - start > HALF_TURN), 0, *_at(place))
            else:
                path.L(*_at(place))
        return path.Z()

    def _lever(self) -> Any:
        """Draw the lever with its roller, rocking about the pivot."""
        degs = Trace(self.angles, -self.cam.lever_deg(self.angles))
        lever = svg.moving(degs, self.turn_s, "rotate", data={"part": "lever"})
        left, right, end = -self.cam.roller_arm * self.scale, self.die_x, 26.0
        roller = self.cam.roller_radius * self.scale
        body = draw.Path(**svg.STEEL, stroke_linejoin="round")
        body.M(svg.px(left), -9).L(0, -17).L(svg.px(right - 8), -10).h(end)
        body.a(4, 4, 0, 0, 1, 4, 4).v(12).a(4, 4, 0, 0, 1, -4, 4).h(-end).L(0, 17)
        body.L(svg.px(left), 9).A(9, 9, 0, 0, 1, svg.px(left), -9).Z()
        lever.append(body)
        lever.append(svg.label("lever", 0.4 * right, 4, text_anchor="middle", stroke="none"))
        lever.append(svg.box(right - 17, -5.5, 34, 11, rx=5.5, fill="white", stroke="#555555"))
        at_roller = svg.placed(left, 0)
        at_roller.append(
            draw.Circle(
                *(0, 0, svg.px(roller)),
                fill="#f7f7f7",
                stroke="#333333",
                stroke_width=1.5,
                data_part="roller",
            )
        )
        at_roller.append(draw.Circle(0, 0, 4.5, fill="#555555"))
        lever.append(at_roller)
        lever.append(draw.Circle(0, 0, 8, fill="#f7f7f7", stroke="#555555", stroke_width=1.5))
        lever.append(draw.Circle(0, 0, 3, fill="#555555"))
        turned = draw.Group(transform=f"rotate({svg.px(degs.values[0], 4):g})")
        turned.append(lever)
        return turned

    def _ram(self) -> Any:
        """Draw the die on its ram, which hangs on the pin."""
        body = self._with_pin("body")
        half = self.turret.tool_width * self.scale / 2
        shape: dict[str, Any] = {"stroke": colour(self.die.number), "stroke_width": 1.2}
        shape["fill"] = svg.pale(self.die.number)
        ram = draw.Path(**shape).M(-8, _TIP - _TOOL).V(-6).A(8, 8, 0, 0, 1, 8, -6)
        body.append(ram.V(_TIP - _TOOL))
        body.append(svg.box(-half, _TIP - _TOOL, 2 * half, _TOOL, **shape, data_part="die"))
        return svg.placed(self.die_x, self._pin_y.values[0], body)

    def _pin(self) -> Any:
        pin = self._with_pin("pin")
        pin.append(draw.Circle(0, 0, 5.5, fill=colour(self.die.number), stroke="white"))
        return svg.placed(self.die_x, self._pin_y.values[0], pin)

    def _with_pin(self, part: str) -> Any:
        data = {"part": part, "px-per-mm": svg.px(self.scale, 6)}
        return svg.moving(self._pin_y, self.turn_s, data=data)

    def _guide(self) -> Any:
        """Draw the two jaws between which the ram slides."""
        top, bottom = _GUIDE
        jaws = svg.placed(self.die_x, top)
        for left in (-22, 9):
            jaws.append(svg.box(left, 0, 13, bottom - top, **svg.STEEL))
        return jaws

    def _spring(self) -> Any:
        """Draw the spring that stands on the bracket and pushes the lever up."""
        slope = np.tan(np.radians(self.cam.lever_deg(self.angles)))
        lever = 13.5 - _SPRING_X * slope  # the lever's lower edge
        heights = _BRACKET - lever
        many = svg.moving(Trace(self.angles, heights / heights[0]), self.turn_s, "stretch")
        step = heights[0] / (2 * _COILS + 1)
        coil = draw.Path(
            stroke="#555555", stroke_width=2, fill="none", vector_effect="non-scaling-stroke"
        )
        coil.M(-9, 0).H(9)
        for turn in range(2 * _COILS + 1):
            coil.L(9 if turn % 2 else -9, svg.px(-step * (turn + 1)))
        many.append(coil)
        return svg.placed(_SPRING_X, _BRACKET, many)

    def _dial(self) -> Iterable[Any]:
        """Draw the cam angle: a dial with the degrees of its four ticks."""
        yield draw.Group([draw_dial(self.turn_s)], transform="scale(1.5)")
        small: dict[str, Any] = {"size": svg.SMALL, "fill": svg.GREY}
        yield svg.label("0°", 0, -33, text_anchor="middle", **small)
        yield svg.label("90°", 33, 4, **small)
        yield svg.label("180°", 0, 41, text_anchor="middle", **small)
        yield svg.label("270°", -33, 4, text_anchor="end", **small)
        yield svg.label("cam angle", 0, 60, text_anchor="middle")

    def _texts(self) -> Iterable[Any]:
        bold: dict[str, Any] = {"font_weight": "bold"}
        die, mill = self.die, self.turret
        left = -self.cam.roller_arm * self.scale
        yield svg.label("roller", left - 28, -7, text_anchor="end")
        yield svg.label("spring", _SPRING_X + 18, 42)
        half = mill.tool_width * self.scale / 2
        y = self._pin_y.values.min() + _TIP - 12
        yield svg.label(
            die.motion.name, self.die_x + half + 10, y, fill=svg.dark(die.number), **bold
        )
        rim = self._pin_y.values.min() + _TIP + (die.gap + mill.radius - mill.inner) * self.scale
        yield svg.label(
            f"{mill.motion.name}: {mill.stops} stops",
            *(self.die_x, rim + 22),
            text_anchor="middle",
            fill=svg.dark(mill.number),
            **bold,
        )

    @property
    def _axis(self) -> tuple[float, float]:
        return _at(self.cam.axis * self.scale)


def _at(place: complex) -> tuple[float, float]:
    """Return a place in px, down being positive."""
    return svg.px(place.real), svg.px(-place.imag)
