"""Lesson 12 by hand: right answers, and wrong ones that a student could give.

The numbers know nothing of the package's solvers. A wrong design is a right one that was spoiled.
"""

import math
from collections.abc import Callable
from typing import Any

from known_slips import KnownSlip, die, lessons, place, stroke, time, widest, with_lessons

import cammotion as cm
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.lessons import EXERCISES

CYCLOID = 2 * math.pi


def peak(m: MillAndDie, way: float, angle: float, factor: float = CYCLOID) -> float:
    """Return the peak acceleration of a way in mm over an angle, in m/s²."""
    return factor * way / 1000 / time(m, angle) ** 2


def before(m: MillAndDie) -> float:
    """Return the peak of the die without overlap."""
    return peak(m, stroke(m), die(m))


def after(m: MillAndDie) -> float:
    """Return the largest peak when the die has its widest move."""
    return max(peak(m, stroke(m), widest(m)), mill(m))


def mill(m: MillAndDie) -> float:
    """Return the peak of the mill."""
    return peak(m, m.pitch_mm, m.mill_angle_deg)


def faster(m: MillAndDie, power: float = 0.5) -> float:
    """Return the rate of 12.1."""
    return float(m.rate_per_hour * (before(m) / after(m)) ** power)


def least(m: MillAndDie, factor: float = 4, angle: float = 0) -> float:
    """Return the least peak of 12.2: half the way is half the push by the square of half a time."""
    return peak(m, m.pitch_mm, angle or m.mill_angle_deg, factor)


def balanced(m: MillAndDie) -> float:
    """Return the rate of 12.1 if the mill's angle is changed, too, until both peaks are alike.

    The mill keeps its middle. The die is as deep as it may be when the mill has a tenth to go.
    """
    middle = m.mill_angle_deg / 2
    to_go = 1 - place((m.wait_mm - m.margin_mm) / stroke(m))
    low, high = 0.0, 2 * (m.mill_angle_deg + die(m) - middle)
    for _ in range(80):
        angle = (low + high) / 2
        its = (m.mill_angle_deg + die(m) - middle - 0.4 * angle) / to_go
        of_mill, of_die = peak(m, m.pitch_mm, angle), peak(m, stroke(m), its)
        low, high = (angle, high) if of_mill > of_die else (low, angle)
    return m.rate_per_hour * math.sqrt(before(m) / peak(m, m.pitch_mm, low))


def with_the_lessons_limit(limit: float) -> KnownSlip:
    """Let the machine meet the peak that the die of the lesson had, as it is printed there."""
    answer = with_lessons(lambda m: m.rate_per_hour * math.sqrt(limit / after(m)))
    return KnownSlip("12.1", f"the lesson's {limit}", answer, "a number of the lesson|finite")


def right_design(m: MillAndDie) -> cm.TimingDiagram:
    """Return what 12.3 asks for."""
    design: cm.TimingDiagram = EXERCISES["12.3"].solution(m)
    return design


def spoiled(change: Callable[[MillAndDie, cm.Motion, cm.Motion], list[cm.Motion]]) -> Any:
    """Return what makes a wrong design of a right one."""

    def make(m: MillAndDie) -> cm.TimingDiagram:
        right = right_design(m)
        return cm.TimingDiagram(change(m, right["mill"], right["die"]), m.rate_per_hour)

    return make


def other_stroke(m: MillAndDie, by: float) -> cm.Motion:
    """Return the die of a right design with a stroke that is `by` mm too long."""
    way, move = stroke(m) + by, right_design(m)["die"].moves[0]
    work = m.work_deg
    parts = [cm.rise(way, over_deg=move.angle_deg), cm.dwell(work)]
    back = [cm.return_(way, over_deg=move.angle_deg), cm.dwell(360 - work - 2 * move.angle_deg)]
    return cm.motion("die", *parts, *back, start_deg=move.from_deg)


def other_mill(m: MillAndDie, pitch: float, stops: int) -> cm.Motion:
    """Return a mill of another build."""
    move = right_design(m)["mill"].moves[0]
    parts = cm.rise(pitch, over_deg=move.angle_deg), cm.dwell(360 - move.angle_deg)
    return cm.indexing_motion("mill", *parts, stops=stops, start_deg=move.from_deg)


def sharp(m: MillAndDie) -> cm.TimingDiagram:
    """Return the moves of 12.3 by a law with hardly any sine."""
    law, right = cm.scca(0.02, 0.96, 0.02), right_design(m)
    return right.with_motion(right["mill"].with_law(law)).with_motion(right["die"].with_law(law))


RIGHT: dict[str, Callable[[MillAndDie], Any]] = {
    "12.1": faster,
    "12.2": least,
}

SOURCE: dict[str, float] = {"12.1": 3857.1}

NUMBER_SLIPS = [
    KnownSlip(
        "12.1",
        "the die alone",
        lambda m: m.rate_per_hour * math.sqrt(before(m) / peak(m, stroke(m), widest(m))),
        r"^So fast the die could go\. Who else meets that peak, and at which rate\?$",
    ),
    KnownSlip(
        "12.1",
        "the mill alone",
        lambda m: m.rate_per_hour * math.sqrt(before(m) / mill(m)),
        r"^So fast the mill could go\. Who else meets that peak, and at which rate\?$",
    ),
    KnownSlip("12.1", "as today", lambda m: m.rate_per_hour, "today's rate"),
    KnownSlip("12.1", "no root", lambda m: faster(m, 1), "square of the rate"),
    KnownSlip("12.1", "upside down", lambda m: faster(m, -0.5), "upside down"),
    KnownSlip("12.1", "upside down, no root", lambda m: faster(m, -1), "slower than today"),
    KnownSlip(
        "12.1",
        "by the angles",
        lambda m: m.rate_per_hour * widest(m) / die(m),
        "[Aa]nd the mill|Who else",
    ),
    KnownSlip(
        "12.1",
        "mill against die",
        lambda m: m.rate_per_hour * math.sqrt(mill(m) / peak(m, stroke(m), widest(m))),
        "peak before",
    ),
    KnownSlip("12.1", "the lesson's", lessons(3857), "machine of the lesson"),
    KnownSlip("12.1", "only the factor", lambda m: faster(m) / m.rate_per_hour, "rate itself"),
    KnownSlip(
        "12.1",
        "peaks added",
        lambda m: (
            m.rate_per_hour * math.sqrt(before(m) / (mill(m) + peak(m, stroke(m), widest(m))))
        ),
        "added",
    ),
    KnownSlip(
        "12.1",
        "sums",
        lambda m: (
            m.rate_per_hour
            * math.sqrt((before(m) + mill(m)) / (peak(m, stroke(m), widest(m)) + mill(m)))
        ),
        "added|largest",
    ),
    KnownSlip(
        "12.1",
        "by the velocities",
        lambda m: (
            m.rate_per_hour
            * (stroke(m) / die(m))
            / max(m.pitch_mm / m.mill_angle_deg, stroke(m) / widest(m))
        ),
        r"velocities|So fast the die could go",
    ),
    KnownSlip("12.1", "both balanced", balanced, "mill got another angle"),
    with_the_lessons_limit(4.154),
    with_the_lessons_limit(4.15),
    KnownSlip("12.1", "the lesson's die", lessons(4542), "of the lesson: so fast its die|finite"),
    KnownSlip("12.1", "the lesson's balance", lessons(4198), "when mill and die|finite"),
    KnownSlip(
        "12.2",
        "the sucker's angle",
        lambda m: least(m, 4, 60),
        "number of the lesson",
    ),
    KnownSlip(
        "12.2",
        "the sucker's way",
        lambda m: peak(m, 90, m.mill_angle_deg, 4),
        "number of the lesson|finite",
    ),
    KnownSlip(
        "12.2",
        "the sucker's way and angle",
        lambda m: peak(m, 90, 60, 4),
        "^These are way and angle|number of the lesson|sucker of the lesson|finite",
    ),
    KnownSlip(
        "12.2",
        "the sucker's time",
        lambda m: 4 * m.pitch_mm / 1000 / 0.3**2,
        "number of the lesson",
    ),
    KnownSlip("12.2", "velocity", lambda m: least(m, 2) * time(m, m.mill_angle_deg), "peak vel"),
    KnownSlip(
        "12.2",
        "radians",
        lambda m: 4 * m.pitch_mm / 1000 / math.radians(m.mill_angle_deg) ** 2,
        "radians",
    ),
    KnownSlip("12.2", "mean velocity", lambda m: least(m, 1) * time(m, m.mill_angle_deg), "mean"),
    KnownSlip(
        "12.2",
        "degrees",
        lambda m: 4 * m.pitch_mm / 1000 / m.mill_angle_deg**2,
        "degrees",
    ),
    KnownSlip("12.2", "the lesson's", lambda _: 4.0, "lesson"),
    KnownSlip("12.2", "the cycloid", lambda m: least(m, CYCLOID), "cycloid"),
    KnownSlip("12.2", "the harmonic", lambda m: least(m, math.pi**2 / 2), "harmonic"),
    KnownSlip("12.2", "modified sine", lambda m: least(m, 5.52796), "modified sine"),
    KnownSlip("12.2", "never stops", lambda m: least(m, 2), "stop"),
    KnownSlip("12.2", "no factor", lambda m: least(m, 1), "factor"),
    KnownSlip("12.2", "half the time", lambda m: least(m, 8), "constant acceleration"),
    KnownSlip("12.2", "the 10 lost", lambda m: 100 * least(m), "10 B/N"),
    KnownSlip("12.2", "the cycloid, in mm", lambda m: least(m, 2000 * math.pi), "cyc.*in mm where"),
    KnownSlip("12.2", "the whole turn", lambda m: least(m, 4, 360), "whole turn"),
    KnownSlip(
        "12.2", "the rest", lambda m: least(m, 4, 360 - m.mill_angle_deg), "rest of the turn"
    ),
    KnownSlip(
        "12.2",
        "time not squared",
        lambda m: least(m) * time(m, m.mill_angle_deg),
        "squared",
    ),
    KnownSlip("12.2", "modified trapezoid", lambda m: least(m, 4.888), "trapezoid"),
]


def designs(number: str) -> list[KnownSlip]:
    """Return the wrong designs for one of the two open exercises."""
    wrong: list[tuple[str, Any, str]] = [
        ("nothing changed", lambda m: m.diagram, "above what is asked"),
        (
            "the widest die alone",
            lambda m: m.diagram.with_motion(cm.with_angle(m.die, m.widest_deg)),
            "above what is asked.*that of the mill",
        ),
        ("a table", lambda _: "motion;stops\nmill;24", "cm.machine_from_text"),
        ("another rate", lambda m: right_design(m).at_rate(m.rate_per_hour / 2), "machine rate"),
        ("no mill", spoiled(lambda *both: [both[2]]), "two motions"),
        (
            "another name",
            spoiled(lambda _, mill, die: [mill, cm.Motion("punch", die.segments)]),
            "two motions",
        ),
        (
            "a shorter stroke",
            spoiled(lambda m, mill, _: [mill, other_stroke(m, -5)]),
            "full stroke",
        ),
        (
            "another pitch",
            spoiled(lambda m, _, die: [other_mill(m, m.pitch_mm / 2, m.stops), die]),
            "one pitch on",
        ),
        (
            "other stops",
            spoiled(lambda m, _, die: [other_mill(m, m.pitch_mm, m.stops + 1), die]),
            "one pitch on",
        ),
        (
            "the die later",
            spoiled(lambda _, mill, die: [mill, die.shifted(3)]),
            "stand where they stood.*The die moves from",
        ),
        (
            "a jump of the acceleration",
            lambda m: m.diagram.with_motion(m.die.with_law("constant acceleration")),
            "jerk has no bound",
        ),
        (
            "the mill too wide",
            spoiled(lambda _, mill, die: [cm.with_angle(mill, mill.moves[0].angle_deg + 5), die]),
            "rule is broken",
        ),
    ]
    return [KnownSlip(number, name, make, said) for name, make, said in wrong]


SLIPS = [
    *NUMBER_SLIPS,
    *designs("12.3"),
    *designs("12.4"),
    KnownSlip("12.4", "hardly any sine", sharp, "largest jerk is above"),
    KnownSlip("12.5", "a", lambda _: "a", "another claim"),
    KnownSlip("12.5", "c", lambda _: "c", "other seven"),
    KnownSlip("12.5", "d", lambda _: "d", "met today"),
]
