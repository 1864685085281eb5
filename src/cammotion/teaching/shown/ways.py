"""An answer as a push: where the die is when its time is over, driven like this."""

from collections.abc import Callable, Iterable

import numpy as np

from cammotion.laws.catalogue import LAWS
from cammotion.machine.kinematics import MM_PER_M, indexing_time
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.shown.frame import (
    DIE,
    GREY,
    HEIGHT,
    INK,
    MILL,
    MILL_TEXT,
    PALE_MILL,
    PALEST_MILL,
    WIDTH,
    Frame,
    Measure,
    Point,
    Shown,
    Shows,
)
from cammotion.teaching.shown.strikes import ROUNDING

_LEFT, _RIGHT, _TOP, _BOTTOM = 132, WIDTH - 14, 16, HEIGHT - 24
_FARTHEST = 1.5  # strokes that are drawn; what goes farther leaves the picture
_SAMPLES = 60


def peak_of_die(
    given: str = "With this peak",
    *,
    peak: Callable[[MillAndDie, float], float] = lambda _, answer: answer,
    angle_deg: Measure = lambda m: m.die_angle_deg,
    rate_per_hour: Measure = lambda m: m.rate_per_hour,
    law: str = "cycloidal",
) -> Shows:
    """Show an answer as what drives the die by a law over its angle: how deep it gets.

    `given` begins the line, and `peak` is the peak acceleration in m/s2 that an answer leads to.
    """

    def show(machine: MillAndDie, answer: float) -> Shown:
        time_s = float(indexing_time(angle_deg(machine), rate_per_hour(machine)))
        way_mm = peak(machine, answer) * time_s**2 / LAWS[law].Ca * MM_PER_M
        frame = Frame()
        _draw_places(frame, machine, 0)
        share = np.linspace(0, 1, _SAMPLES)
        depth = way_mm * np.asarray(LAWS[law](share))
        _draw_curve(frame, machine, 0, zip(share, depth, strict=True))
        frame.text(_LEFT, HEIGHT - 8, "it sets off", GREY)
        frame.text(_RIGHT, HEIGHT - 8, "its time is over", GREY, "end")
        return frame.show(_tell_depth(machine, way_mm, f"{given} the die"))

    return show


def push_up(*, half_deg: Measure, seconds_per_deg: Measure, look_deg: Measure) -> Shows:
    """Show an answer in m/s2 as an even push from the bottom and an even brake.

    `half_deg` is how long each of them lasts, and `look_deg` after how many degrees the mill gets
    going.
    """

    def show(machine: MillAndDie, answer: float) -> Shown:
        half, look = half_deg(machine), look_deg(machine)
        per_deg2 = answer * MM_PER_M * seconds_per_deg(machine) ** 2

        def depth(angle_deg: float) -> float:
            braked = max(angle_deg - half, 0)
            return machine.stroke_mm - per_deg2 * (angle_deg**2 / 2 - braked**2)

        top = min(0, max(depth(2 * half), -0.6 * machine.stroke_mm))
        frame = Frame()
        _draw_places(frame, machine, top)
        at = _LEFT + look / (2 * half) * (_RIGHT - _LEFT)
        frame.line([(at, _TOP), (at, _BOTTOM)], GREY, 1, "2 3")
        frame.text(at, HEIGHT - 8, f"{look:g} deg: the mill gets going", GREY, "middle")
        shares = np.linspace(0, 1, _SAMPLES)
        _draw_curve(frame, machine, top, [(s, depth(2 * half * s)) for s in shares])
        y = _height(machine, top)(depth(look))
        if _TOP <= y <= _BOTTOM:
            frame.dot(at, y)
        return frame.show(_tell_height(machine, depth(look), look))

    return show


def _tell_depth(machine: MillAndDie, way_mm: float, head: str) -> str:
    off = way_mm - machine.stroke_mm
    if abs(off) < ROUNDING * machine.stroke_mm:
        return f"{head} comes to rest just where it has to press."
    if way_mm < 0.02 * machine.stroke_mm:
        return f"{head} hardly leaves its place."
    if way_mm < machine.wait_mm:
        return f"{head} comes to rest above the mill, and does not reach it."
    if off < 0:
        return f"{head} comes to rest in the pocket, but not as deep as it has to press."
    if off <= machine.gap_mm:
        return f"{head} comes to rest too deep, in the gap that has to stay above the floor."
    far = ", and on to more than twice its stroke" if way_mm > 2 * machine.stroke_mm else ""
    return f"{head} goes through the floor of the pocket{far}."


def _tell_height(machine: MillAndDie, depth_mm: float, look_deg: float) -> str:
    head = f"After {look_deg:g} degrees, when the mill gets going, the die"
    if depth_mm > machine.wait_mm + ROUNDING:
        return f"{head} is still {depth_mm - machine.wait_mm:.2g} mm below the rim: it strikes."
    if depth_mm > machine.limit_mm + ROUNDING:
        return f"{head} is out of the pocket, but by less than the margin."
    if depth_mm > machine.limit_mm - ROUNDING:
        return f"{head} is just as far out of the pocket as it has to be."
    return f"{head} is farther out of the pocket than it has to be: it is pushed harder for it."


def _height(machine: MillAndDie, top_mm: float) -> Callable[[float], float]:
    bottom = _FARTHEST * machine.stroke_mm if top_mm == 0 else machine.stroke_mm * 1.1
    return lambda depth: _TOP + (depth - top_mm) / (bottom - top_mm) * (_BOTTOM - _TOP)


def _draw_places(frame: Frame, machine: MillAndDie, top_mm: float) -> None:
    """Draw where the die waits, and the mill beneath it with the pocket."""
    y = _height(machine, top_mm)
    rim, floor, asked = map(
        y, (machine.wait_mm, machine.wait_mm + machine.pocket_mm, machine.stroke_mm)
    )
    frame.box(_LEFT, rim, _RIGHT - _LEFT, floor - rim, PALEST_MILL)
    frame.box(_LEFT, floor, _RIGHT - _LEFT, _BOTTOM - floor, PALE_MILL)
    for place in (rim, floor):
        frame.line([(_LEFT, place), (_RIGHT, place)], MILL, 1)
    frame.line([(_LEFT, asked), (_RIGHT, asked)], INK, 1.5, "6 4")
    frame.text(_LEFT - 6, y(0) + 4, "it waits", anchor="end")
    frame.text(_LEFT - 6, rim + 4, "rim of the mill", MILL_TEXT, "end")
    frame.text(_LEFT - 6, asked - 2, "it has to press", anchor="end")
    frame.text(_LEFT - 6, floor + 13, "floor of the pocket", MILL_TEXT, "end")


def _draw_curve(frame: Frame, machine: MillAndDie, top_mm: float, points: Iterable[Point]) -> None:
    """Draw depth over the share of the time; what leaves the picture ends at its edge."""
    y, placed = _height(machine, top_mm), list[Point]()
    for share, depth in points:
        here = (_LEFT + share * (_RIGHT - _LEFT), y(depth))
        edge = min(max(here[1], _TOP - 1), _BOTTOM)
        if placed and edge != here[1]:
            (x, before), (beyond, after) = placed[-1], here
            placed.append((x + (beyond - x) * (edge - before) / (after - before), edge))
            break
        placed.append(here)
    frame.line(placed, DIE, 2.5)
    frame.dot(*placed[-1])
