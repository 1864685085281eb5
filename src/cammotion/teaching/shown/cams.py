"""An answer put into a cam: a prime circle, and a flat face, at mid-stroke of the rise."""

import cmath
import math

import numpy as np

from cammotion.hardware.disc_cam import DiscCam
from cammotion.hardware.flat_faced_cam import FlatFacedCam
from cammotion.hardware.followers import TranslatingRoller
from cammotion.hardware.prime_circle import smallest_base_radius
from cammotion.hardware.roller_cam import RollerCam
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.shown.frame import (
    ALARM,
    DIE,
    DIE_TEXT,
    GREY,
    HEIGHT,
    INK,
    MILL,
    PALE_MILL,
    Frame,
    Point,
    Shown,
    Shows,
)
from cammotion.teaching.shown.strikes import ROUNDING

_LEFT_PX, _TEXT_PX = 150, 280  # the slide's line, and where words begin
_TOP, _BOTTOM = 62, HEIGHT - 6
_SEEN = 0.55  # of the roller's height over the axis is in the picture, from the top down
_ROLLER = 0.08  # its radius, as a share of that height
_PUSH_PX, _ARC_STEP_DEG = 52, 1.5


def push_at_mid_stroke(most_deg: float) -> Shows:
    """Show an answer in mm as the prime circle of the die's cam, by the pressure angle."""

    def show(machine: MillAndDie, prime_mm: float) -> Shown:
        middle = machine.mill_angle_deg + machine.die_angle_deg / 2
        roller = _ROLLER * (prime_mm + machine.stroke_mm / 2)
        cam = RollerCam(machine.die, TranslatingRoller(roller), prime_mm)
        angle = float(cam.pressure_angle_deg(middle))
        frame = Frame()
        centre, px = _draw_cam(frame, cam, middle, prime_mm + machine.stroke_mm / 2)
        _draw_push(frame, centre, math.radians(angle))
        frame.line(_circle(centre, roller * px), DIE)
        frame.text(_TEXT_PX, 60, f"the cam pushes {angle:.3g} deg", INK)
        frame.text(_TEXT_PX, 76, "beside the slide's way", INK)
        return frame.show(f"With this prime circle the cam's push {_judged(angle, most_deg)}")

    return show


def face_under_contact(machine: MillAndDie, width_mm: float) -> Shown:
    """Show an answer in mm as the width of a flat face, by where the cam touches it."""
    cam = FlatFacedCam(machine.die, smallest_base_radius(machine.die, profile_radius_mm=1))
    middle = machine.mill_angle_deg + machine.die_angle_deg / 2
    height, contact = cam.base_radius_mm + machine.stroke_mm / 2, float(cam.contact_mm(middle))
    frame = Frame()
    (x, y), px = _draw_cam(frame, cam, middle, height)
    half = px * width_mm / 2
    frame.line([(max(x - half, 0), y), (min(x + half, 2 * _LEFT_PX - 20), y)], DIE, 4)
    frame.line([(x, y), (x, 20)], DIE, 4)
    frame.dot(x + px * contact, y, ALARM)
    frame.text(_TEXT_PX + 20, 60, "the red dot: where the cam", INK)
    frame.text(_TEXT_PX + 20, 76, "touches at mid-stroke", INK)
    is_same = math.isclose(width_mm / 2, abs(contact), rel_tol=ROUNDING)
    return frame.show(
        "This face ends just where the cam touches it at mid-stroke."
        if is_same
        else "The cam touches this face within its edges. It is wider than it has to be."
        if width_mm / 2 > abs(contact)
        else "At mid-stroke the cam would touch beside this face: it would run on the edge."
    )


def _judged(angle: float, most: float) -> str:
    if math.isclose(angle, most, rel_tol=1e-3):
        return f"leans over by just {most:g} deg at mid-stroke, as the question asks."
    if angle > most:
        return f"leans over by more than {most:g} deg at mid-stroke: the slide could jam."
    return f"leans over by less than {most:g} deg at mid-stroke: there a smaller cam would do."


def _draw_cam(
    frame: Frame, cam: DiscCam, at_deg: float, height_mm: float
) -> tuple[tuple[float, float], float]:
    """Draw a cam as it stands at a cam angle; return the follower's place and the scale, in px."""
    px = (_BOTTOM - _TOP) / (_SEEN * height_mm)
    around = at_deg + np.arange(-90, 90, _ARC_STEP_DEG)
    seen = cam.profile_mm(around) @ [1, 1j] * cmath.exp(-1j * math.radians(at_deg))
    points = [(_LEFT_PX + px * place.real, _TOP + px * (height_mm - place.imag)) for place in seen]
    inside = [(min(max(x, 4), _TEXT_PX - 12), min(y, _BOTTOM)) for x, y in points]
    frame.area(inside, PALE_MILL)
    frame.line(inside, MILL)
    frame.line([(_LEFT_PX, 6), (_LEFT_PX, _BOTTOM)], GREY, 1, "8 3 2 3")
    return (_LEFT_PX, _TOP), px


def _draw_push(frame: Frame, start: Point, angle: float) -> None:
    x, y = start
    tip = x + _PUSH_PX * math.sin(angle), y - _PUSH_PX * math.cos(angle)
    frame.line([start, tip], ALARM, 3)
    frame.text(tip[0] + 6, max(tip[1], 16), "push", DIE_TEXT)


def _circle(centre: Point, radius: float) -> list[Point]:
    angles = np.linspace(0, 2 * math.pi, 49)
    return [(centre[0] + radius * math.cos(a), centre[1] + radius * math.sin(a)) for a in angles]
