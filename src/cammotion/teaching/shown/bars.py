"""An answer that is compared: a bar for what is asked for, and one for what the answer makes."""

import math
from collections.abc import Callable

from cammotion.machine.kinematics import UM_PER_MM, cycle_time, peak_acceleration
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.shown.frame import (
    DIE,
    DIE_TEXT,
    GREY,
    INK,
    WIDTH,
    Frame,
    Measure,
    Shown,
    Shows,
)
from cammotion.teaching.shown.strikes import ROUNDING

_LEFT, _LONGEST = 16, WIDTH - 32
_FARTHEST = 12.0  # so many times the shorter bar a bar is drawn at most


def angle_with_the_same_peak(machine: MillAndDie, angle_deg: float) -> Shown:
    """Show an answer in deg by the peak of the harsher law over it, beside the gentler law's."""
    gentle, harsh = machine.laws.compared
    asked, made = (
        float(peak_acceleration(machine.stroke_mm, angle, machine.rate_per_hour, law))
        for angle, law in ((machine.die_angle_deg, gentle), (angle_deg, harsh))
    )
    said = _compare(
        made,
        asked,
        f"is still pushed harder than the {gentle}.",
        f"is pushed just as hard as the {gentle}.",
        f"is pushed less than the {gentle}: it does not need all of them.",
    )
    names = (
        f"peak of the {gentle} over {machine.die_angle_deg:g} deg",
        f"peak of the {harsh} over {angle_deg:.4g} deg",
    )
    return _draw_bars(names, (asked, made), f"Over so many degrees the {harsh} {said}")


def turn_on_screen(turn_s: float) -> Shows:
    """Show an answer as the factor between accelerations, by how long a turn is on the screen."""

    def show(machine: MillAndDie, factor: float) -> Shown:
        made = math.sqrt(factor) * float(cycle_time(machine.rate_per_hour))
        about = f"about {_told_from(turn_s, made)} s"
        said = _compare(
            made,
            turn_s,
            f"last longer than it does, {about}.",
            "last as long as the question says.",
            f"be over sooner than it is, in {about}.",
        )
        own = f"by your factor: {about}" if made != turn_s else "by your factor"
        names = (f"a turn on the screen: {turn_s:g} s", own)
        return _draw_bars(
            names, (turn_s, made), f"With this factor a turn on the screen would {said}"
        )

    return show


def _told_from(asked: float, made: float) -> str:
    """Return a number in two digits, or in as many as tell it from the one that is asked for."""
    rounded = (float(f"{made:.{digits}g}") for digits in range(2, 10))
    return f"{next((number for number in rounded if number != asked), made):.9g}"


def turn_by_play(asked_deg: Measure, radius_mm: Measure) -> Shows:
    """Show an answer in um of play by how far it lets a cam turn, beside the angle it may turn."""

    def show(machine: MillAndDie, play_um: float) -> Shown:
        asked = asked_deg(machine)
        made = math.degrees(play_um / UM_PER_MM / radius_mm(machine))
        said = _compare(made, asked, "farther than", "just as far as", "less far than")
        names = (f"how far the cam may turn: {asked:g} deg", "how far your play lets it turn")
        return _draw_bars(
            names, (asked, made), f"With this play the cam turns {said} it may, to and fro."
        )

    return show


def push_of_force(asked: float, mass_kg: Measure) -> Shows:
    """Show an answer in N by the acceleration that it gives to a mass, beside that asked for."""

    def show(machine: MillAndDie, force: float) -> Shown:
        made = force / mass_kg(machine)
        said = _compare(made, asked, "harder than", "just as hard as", "not as hard as")
        names = (f"asked for: {asked:g} m/s²", "what your force gives to die and motor")
        return _draw_bars(
            names, (asked, made), f"This force accelerates die and motor {said} it has to."
        )

    return show


def error_of_reading(limit: Measure, made: Callable[[MillAndDie, float], float]) -> Shows:
    """Show an answer in um, a step of readings, by what it does to an acceleration in m/s2."""

    def show(machine: MillAndDie, step_um: float) -> Shown | None:
        asked, off = limit(machine), made(machine, step_um)
        if off <= 0:
            return None
        said = _compare(off, asked, "more than it may.", "just as much as it may.", "less.")
        names = (f"allowed: {asked:g} m/s²", "what the rounding to your step can make")
        return _draw_bars(
            names, (asked, off), f"With your step the rounding changes an acceleration by {said}"
        )

    return show


def swings_of_rod(asked: Measure, made: Callable[[MillAndDie, float], float]) -> Shows:
    """Show an answer in N/mm, a rod, by how often a slide behind it swings, beside what it has to.

    `made` is how often it swings during its move with a rod of a stiffness.
    """

    def show(machine: MillAndDie, rod: float) -> Shown | None:
        if rod <= 0:
            return None
        wanted, swings = asked(machine), made(machine, rod)
        said = _compare(
            swings,
            wanted,
            "swings more often than it has to",
            "swings just often enough",
            "does not swing often enough",
        )
        names = (f"asked for: {wanted:g} swings during the rise", "with lever and your rod")
        return _draw_bars(
            names, (wanted, swings), f"With this rod the slide {said} during its rise."
        )

    return show


def step_of_torque(step_deg: Measure, needed: Measure, drag: Measure) -> Shows:
    """Show an answer in N m by how far a table gets with it in its time, beside its step.

    `needed` is what its inertia needs, and `drag` what friction takes of the answer before.
    """

    def show(machine: MillAndDie, torque: float) -> Shown | None:
        step = step_deg(machine)
        made = step * (torque - drag(machine)) / needed(machine)
        if made <= 0:
            return None  # friction holds it
        said = _compare(
            made,
            step,
            "goes beyond its next stop.",
            "comes just to its next stop.",
            "does not get to its next stop.",
        )
        names = (f"one step: {step:g}°", "as far as your torque brings it in this time")
        return _draw_bars(names, (step, made), f"With this largest torque the table {said}")

    return show


def _compare(made: float, asked: float, more: str, same: str, less: str) -> str:
    if math.isclose(made, asked, rel_tol=ROUNDING):
        return same
    return more if made > asked else less


def _draw_bars(names: tuple[str, str], values: tuple[float, float], line: str) -> Shown:
    """Draw a bar under each name; a cut in it says that it is longer than can be drawn."""
    frame, most = Frame(), min(max(values), _FARTHEST * min(values))
    rows = zip(names, values, (GREY, DIE), (INK, DIE_TEXT), strict=True)
    for row, (name, value, fill, ink) in enumerate(rows):
        top, length = 40 + 78 * row, _LONGEST * min(value, most) / most
        frame.text(_LEFT, top - 10, name, ink)
        frame.box(_LEFT, top, length, 28, fill)
        if value > most:
            for back in (30, 38):
                end = _LEFT + length - back
                frame.line([(end, top + 32), (end + 8, top - 4)], "#fff", 3)
    return frame.show(line)
