"""An answer in mm, or as a place x: the die or the mill where it says they are, cut open."""

from collections.abc import Sequence
from dataclasses import dataclass

from cammotion.laws.catalogue import LAWS
from cammotion.limits.widest import with_angle
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.shown.frame import (
    DIE,
    DIE_TEXT,
    GREY,
    HEIGHT,
    INK,
    MILL,
    MILL_TEXT,
    PALE_DIE,
    PALE_MILL,
    WIDTH,
    Frame,
    Measure,
    Shown,
    Shows,
)
from cammotion.teaching.shown.strikes import ROUNDING, find_strike, fits_turn

_TOP, _BOTTOM = 14, HEIGHT - 8
_TOUCHES_MM = 0.01  # an x of four digits is as exact
_DIE_MM, _FLOOR_MM = 30, 9  # how wide the die is drawn, and how thick the floor of the pocket
_HALF, _MARGIN, _BESIDE = WIDTH / 2, 12, 120


def place_of_die(machine: MillAndDie, x: float) -> Shown | None:
    """Show an answer as the place x of the die in its move, with the mill on its way."""
    if x > 1:
        return None
    depth = machine.stroke_mm * float(LAWS["cycloidal"](x))
    room = machine.limit_mm - depth
    if abs(depth - machine.wait_mm) < _TOUCHES_MM:
        said = "the die is at the rim, and nothing is left of the margin."
    elif depth > machine.wait_mm:
        deep = f"{depth - machine.wait_mm:.2g} mm"
        said = f"the die is {deep} in the mill, which moves: it strikes."
    elif room < -ROUNDING:
        said = "the die is above the rim, but by less than the margin."
    elif room < ROUNDING:
        said = "just the margin is left between die and rim."
    else:
        said = "there is more than the margin between die and rim: it might be deeper."
    return _draw_die_at(machine, depth, off_mm=_DIE_MM, line=f"At this x {said}")


def depth_before_down(before_deg: float) -> Shows:
    """Show an answer in mm as the depth of the die, so many degrees before it is down."""

    def show(machine: MillAndDie, depth_mm: float) -> Shown:
        return _draw_die_at(machine, depth_mm, line=_tell_depth(machine, depth_mm, before_deg))

    return show


def mill_before_stop(before_deg: Measure) -> Shows:
    """Show an answer in mm as how far the mill is from its stop, as many degrees before its end."""

    def show(machine: MillAndDie, off_mm: float) -> Shown | None:
        if off_mm > machine.pitch_mm:
            return None
        law = LAWS["cycloidal"]
        still_deg = machine.mill_angle_deg * float(law.inverse(off_mm / machine.pitch_mm))
        asked = before_deg(machine)
        when = "already" if still_deg > asked else "only"
        if abs(still_deg - asked) < ROUNDING:
            said = "So near to its stop it is just when the question asks."
        else:
            said = (
                f"The mill is so far from its stop {when} {still_deg:.1f} degrees before the end "
                f"of its move, not {asked:g}."
            )
        return _draw_mill_off(machine, off_mm, said)

    return show


def _tell_depth(machine: MillAndDie, depth_mm: float, before_deg: float) -> str:
    if depth_mm > machine.wait_mm + machine.pocket_mm:
        return "So deep the die is through the floor of the pocket."
    if depth_mm >= machine.stroke_mm:
        return "So deep it never is: it would have pressed already, with all these degrees to come."
    way_deg = before_deg / (1 - float(LAWS["cycloidal"].inverse(depth_mm / machine.stroke_mm)))
    if abs(way_deg - machine.widest_deg) < ROUNDING:
        return "So deep it is with the angle of the question."
    if way_deg < machine.widest_deg:
        return (
            "A cycloid that is no deeper there sets off too late, at "
            f"{machine.down_deg - way_deg:.0f} deg, and has to hurry."
        )
    early = "A cycloid that is so deep there sets off too early"
    if not fits_turn(way_deg, machine.work_deg):
        return f"{early}, before it is up from the last turn."
    strike = find_strike(machine, with_angle(machine.die, way_deg))
    return f"{early}. {strike.said}" if strike else f"{early}."


def _draw_die_at(machine: MillAndDie, depth_mm: float, line: str, off_mm: float = 0) -> Shown:
    """Draw the die at a depth, and the mill with its pocket so far away."""
    floor = machine.wait_mm + machine.pocket_mm
    scale = (_BOTTOM - _TOP) / (floor + _FLOOR_MM)

    def y(mm: float) -> float:
        return _TOP + mm * scale

    frame, bottom = Frame(), y(min(depth_mm, floor + _FLOOR_MM - 1))
    _Mill(machine, [_HALF - off_mm * scale], scale, y(machine.wait_mm), _BESIDE).draw(frame)
    half = _DIE_MM * scale / 2
    _draw_die(frame, half, bottom)
    stop = y(machine.wait_mm if off_mm else floor)
    if bottom > stop + ROUNDING:
        frame.alarm(_HALF - half, stop, 2 * half, bottom - stop)
    frame.line([(_BESIDE - 8, bottom), (_HALF - half, bottom)], DIE, 1, "4 3")
    frame.text(_MARGIN, bottom + 4, f"die: {depth_mm:.1f} mm", DIE_TEXT)
    frame.line([(_HALF + half, y(0)), (WIDTH - _BESIDE + 8, y(0))], GREY, 1, "2 3")
    frame.text(WIDTH - _MARGIN, y(0) + 4, "it waits: 0 mm", INK, "end")
    for name, place in (("rim", machine.wait_mm), ("floor", floor)):
        frame.text(WIDTH - _MARGIN, y(place) + 4, f"{name}: {place:g} mm", MILL_TEXT, "end")
    return frame.show(line)


def _draw_mill_off(machine: MillAndDie, off_mm: float, line: str) -> Shown:
    """Draw the die above the mill, whose pocket has so far to go to the right."""
    scale = WIDTH / (2.5 * machine.pitch_mm)
    frame, rim, low = Frame(), 76, HEIGHT - 24
    pockets = [_HALF + (n * machine.pitch_mm - off_mm) * scale for n in (-1, 0, 1, 2)]
    _Mill(machine, pockets, scale, rim).draw(frame)
    _draw_die(frame, _DIE_MM * scale / 2, rim - machine.wait_mm * scale)
    at = pockets[1]
    for place, colour in ((_HALF, DIE), (at, MILL)):
        frame.line([(place, 8), (place, low + 6)], colour, 1, "6 3")
    frame.line([(at, low), (_HALF, low)], INK, 2)
    frame.text(_HALF + 8, low + 4, f"{off_mm:.3g} mm to its stop")
    frame.text(_HALF + _DIE_MM * scale / 2 + 6, 16, "die", DIE_TEXT)
    frame.text(at + machine.pitch_mm * scale / 2, rim + 30, "mill", MILL_TEXT, "middle")
    return frame.show(line)


def _draw_die(frame: Frame, half: float, bottom: float) -> None:
    """Draw the die in the middle of the picture, as deep as this, in px."""
    left, right = _HALF - half, _HALF + half
    frame.box(left, 2, right - left, bottom - 2, PALE_DIE)
    frame.line([(left, 2), (left, bottom), (right, bottom), (right, 2)], DIE)


@dataclass(frozen=True)
class _Mill:
    """The mill, cut through pockets about these places; its rim, its ends and all else in px."""

    machine: MillAndDie
    pockets: Sequence[float]
    scale: float
    rim: float
    edge: float = 0.0

    def draw(self, frame: Frame) -> None:
        """Draw it from edge to edge."""
        floor = self.rim + self.machine.pocket_mm * self.scale
        half = (_DIE_MM / 2 + self.machine.rule.only_while.limit_mm) * self.scale
        first, last = self.edge, WIDTH - self.edge
        outline = [(first, self.rim)]
        for middle in self.pockets:
            left, right = (min(max(end, first), last) for end in (middle - half, middle + half))
            outline += [(left, self.rim), (left, floor), (right, floor), (right, self.rim)]
        outline.append((last, self.rim))
        bottom = floor + _FLOOR_MM * self.scale
        frame.area([*outline, (last, bottom), (first, bottom)], PALE_MILL)
        frame.line(outline, MILL, 1.5)
