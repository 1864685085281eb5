"""Lesson 08 by hand: right answers, and wrong ones that a student could give.

Nothing here knows of the package's laws, wheels or inertias, or of the slips that it recognises.
"""

import math
from collections.abc import Callable
from functools import cache

import mpmath
import numpy as np
from known_slips import KnownSlip, lessons
from known_slips_laws import CYCLOID, POLYNOMIAL, SINE, TRAPEZOID

import cammotion as cm
from cammotion.teaching.example import MillAndDie


def on_a_cosine(factor: float, share: float, before: float) -> float:
    """Return the largest V A where A falls like a cosine over a `share` of the time.

    A = factor cos u, V = factor (before + share (2/pi) sin u): the sine of the best u solves a
    quadratic equation.
    """
    width = 2 * share / math.pi
    a = before / width
    sine = (-a + math.sqrt(a**2 + 8)) / 4
    return factor**2 * width * math.sqrt(1 - sine**2) * (a + sine)


CA = {
    "cycloidal": CYCLOID,
    "modified trapezoid": TRAPEZOID,
    "modified sine": SINE,
    "3-4-5 polynomial": POLYNOMIAL,
    "4-5-6-7 polynomial": 84 * math.sqrt(5) / 25,
}
CQ = {
    "cycloidal": 2 * math.pi * 3 * math.sqrt(3) / 4,
    "modified trapezoid": on_a_cosine(TRAPEZOID, 1 / 8, 1 / (4 * math.pi) + 1 / 4),
    "modified sine": on_a_cosine(SINE, 3 / 8, 1 / (4 * math.pi)),
    "3-4-5 polynomial": 1800 * (3 / 14) ** 3 * math.sqrt(1 / 7),
    "4-5-6-7 polynomial": 58800 * (5 / 22) ** 5 * math.sqrt(1 / 11),
}
CV = {
    "cycloidal": 2,
    "modified trapezoid": 2,
    "modified sine": SINE / math.pi,
    "3-4-5 polynomial": 15 / 8,
}


def plate(m: MillAndDie, sign: int = 1) -> float:
    """Return the inertia of the plate in kg m²: the integral of the ring's rings."""
    outer, inner = m.table.plate_mm / 1000, m.table.hole_mm / 1000
    density = m.table.plate_kg / (math.pi * (outer**2 - inner**2))
    if sign > 0:
        return density * 2 * math.pi * (outer**4 - inner**4) / 4
    return m.table.plate_kg * (outer**2 - inner**2) / 2


def stations(m: MillAndDie, radius_mm: float | None = None) -> float:
    """Return the inertia of the stations in kg m²."""
    radius = (radius_mm or m.table.plate_mm - m.table.inset_mm) / 1000
    return m.table.stops * m.table.station_kg * radius**2


def inertia(m: MillAndDie) -> float:
    return plate(m) + stations(m)


def push(m: MillAndDie, factor: float | None = None) -> float:
    """Return the largest angular acceleration in rad/s²."""
    step = 2 * math.pi / m.table.stops
    return (CA[m.table.law] if factor is None else factor) * step / m.table.time_s**2


def torque(m: MillAndDie, factor: float | None = None) -> float:
    return inertia(m) * push(m, factor) + m.table.friction_N_m


def shaft(
    m: MillAndDie, factor: float | None = None, shaft_rad_per_s: float | None = None
) -> float:
    """Return the largest torque of the camshaft: power by speed."""
    step = 2 * math.pi / m.table.stops
    cq = CQ[m.table.law] if factor is None else factor
    power = inertia(m) * step**2 / m.table.time_s**3 * cq
    return power / (shaft_rad_per_s or math.radians(m.table.angle_deg) / m.table.time_s)


def with_friction(m: MillAndDie) -> float:
    """Return the largest torque of the camshaft with the friction in it, among many places."""
    law, x = cm.LAWS[m.table.law], np.linspace(0, 1, 200_001)
    step, time = 2 * math.pi / m.table.stops, m.table.time_s
    torque = inertia(m) * law(x, 2) * step / time**2 + m.table.friction_N_m
    speed = law(x, 1) * step / time
    return float(np.max(torque * speed)) / (math.radians(m.table.angle_deg) / time)


def friction_on_shaft(m: MillAndDie) -> float:
    """Return what the friction asks of the shaft in the mean, in N m."""
    return m.table.friction_N_m * 360 / m.table.stops / m.table.angle_deg


def by_another_law(number: str, law: str, said: str) -> KnownSlip:
    """Take another law than that of the question; where it is that one the answer is NaN."""
    torque_of, factors = (torque, CA) if number == "08.2" else (shaft, CQ)
    return KnownSlip(
        number,
        f"by the {law}",
        lambda m: math.nan if m.table.law == law else torque_of(m, factors[law]),
        f"This is the {said}.* names another law|finite",
    )


def without_hole(m: MillAndDie) -> float:
    return m.table.plate_kg * (m.table.plate_mm / 1000) ** 2 / 2 + stations(m)


def from_the_axis(m: MillAndDie) -> float:
    """Return the inertia if the ring's density goes on through the hole."""
    outer, inner = m.table.plate_mm / 1000, m.table.hole_mm / 1000
    density = m.table.plate_kg / (math.pi * (outer**2 - inner**2))
    return density * 2 * math.pi * outer**4 / 4 + stations(m)


def omega(m: MillAndDie) -> float:
    return 2 * math.pi * m.table.per_minute / 60


def entry(m: MillAndDie) -> float:
    """Return at which angle before the middle the pin enters, in rad."""
    return math.pi / 2 - math.pi / m.table.slots


def bent(m: MillAndDie, alpha: float, order: int = 2) -> float:
    """Return a derivative of the angle under which the wheel sees the pin, by differences."""
    return seen_bent(m.table.slots, alpha, order)


@cache
def seen_bent(slots: float, alpha: float, order: int) -> float:
    ratio = mpmath.sin(mpmath.pi / slots)

    def seen(angle: mpmath.mpf) -> mpmath.mpf:
        return mpmath.atan2(ratio * mpmath.sin(angle), 1 - ratio * mpmath.cos(angle))

    with mpmath.workdps(40):
        return abs(float(mpmath.diff(seen, alpha, order)))


def wheel(m: MillAndDie) -> float:
    """Return the acceleration half-way from the entry to the middle, in rad/s²."""
    return bent(m, entry(m) / 2) * omega(m) ** 2


def of_half_the_slots(m: MillAndDie) -> float:
    """Return it with sin(2 pi/n) for sin(pi/n), NaN where that is 1."""
    if m.table.slots == 4:
        return math.nan
    return seen_bent(m.table.slots / 2, entry(m) / 2, 2) * omega(m) ** 2


def of_cosine(m: MillAndDie) -> float:
    """Return it with cos(pi/n) for sin(pi/n), NaN where these are one.

    The cosine is the sine of what is left to a right angle, pi/2 - pi/n, which is pi over that n.
    """
    n = m.table.slots
    return seen_bent(2 * n / (n - 2), entry(m) / 2, 2) * omega(m) ** 2 if n != 4 else math.nan


def in_degrees(m: MillAndDie, alpha: float) -> float:
    """Return it with the sine of 180/n for that of pi/n."""
    return seen_bent(math.radians(m.table.slots), alpha, 2) * omega(m) ** 2


def by_the_wheel(m: MillAndDie) -> float:
    """Return it where the wheel, and not its driver, is half-way: by halving."""
    n, ratio, low, high = m.table.slots, math.sin(math.pi / m.table.slots), 0.0, entry(m)
    for _ in range(60):
        middle = (low + high) / 2
        seen = math.atan2(ratio * math.sin(middle), 1 - ratio * math.cos(middle))
        low, high = (middle, high) if seen < math.pi / n / 2 else (low, middle)
    return bent(m, low) * omega(m) ** 2


def tangent(m: MillAndDie) -> float:
    """Return what the inside of the arctan is bent by, half-way."""
    ratio = mpmath.sin(mpmath.pi / m.table.slots)

    def inside(angle: mpmath.mpf) -> mpmath.mpf:
        return ratio * mpmath.sin(angle) / (1 - ratio * mpmath.cos(angle))

    with mpmath.workdps(40):
        return abs(float(mpmath.diff(inside, entry(m) / 2, 2))) * omega(m) ** 2


def largest(m: MillAndDie) -> float:
    """Return the largest acceleration of the wheel, among many places."""
    return max(bent(m, entry(m) * n / 2000) for n in range(0, 2001, 4)) * omega(m) ** 2


RIGHT: dict[str, Callable[[MillAndDie], float]] = {
    "08.1": inertia,
    "08.2": torque,
    "08.3": shaft,
    "08.4": wheel,
}

SOURCE = {
    "08.1": 5.380 + 32.400,
    "08.2": 37.78 * math.pi / 4 / 0.75**2 * 5.52796 + 10,
    "08.3": 37.78 * (math.pi / 4) ** 2 / 0.75**2 * 5.458 / math.radians(150),
}

SLIPS = [
    # The moment of inertia.
    KnownSlip("08.1", "diameters for radii", lambda m: 4 * inertia(m), "diameter"),
    KnownSlip(
        "08.1", "radii halved", lambda m: inertia(m) / 4, "halved, as if they were diameters.$"
    ),
    KnownSlip(
        "08.1", "stations' halved", lambda m: plate(m) + stations(m) / 4, "print does so too"
    ),
    KnownSlip("08.1", "GD² in N m²", lambda m: 4 * 9.81 * inertia(m), "GD²"),
    KnownSlip("08.1", "the lesson's", lessons(5.380 + 32.400 + 0.720), "machine of the lesson"),
    KnownSlip("08.1", "plate alone", plate, "alone"),
    KnownSlip("08.1", "stations alone", stations, "alone"),
    KnownSlip(
        "08.1", "one station", lambda m: plate(m) + stations(m) / m.table.stops, "one station"
    ),
    KnownSlip(
        "08.1",
        "the hole twice",
        lambda m: plate(m, -1) * (1 + (m.table.hole_mm / m.table.plate_mm) ** 2) + stations(m),
        "once more",
    ),
    KnownSlip(
        "08.1",
        "half of the hole",
        lambda m: (
            stations(m)
            + m.table.plate_kg * (m.table.plate_mm**2 + m.table.hole_mm**2 / 4) / 2 / 1e6
        ),
        "as if it were a diameter",
    ),
    KnownSlip("08.1", "in cm", lambda m: 1e4 * inertia(m), "kg cm²"),
    KnownSlip("08.1", "in grams", lambda m: 1000 * inertia(m), "grams"),
    KnownSlip("08.1", "a hoop", lambda m: 2 * plate(m) + stations(m), "half"),
    KnownSlip("08.1", "stations as a plate", lambda m: plate(m) + stations(m) / 2, "halved"),
    KnownSlip(
        "08.1", "stations at the rim", lambda m: plate(m) + stations(m, m.table.plate_mm), "rim"
    ),
    KnownSlip(
        "08.1",
        "hole subtracted",
        lambda m: plate(m, -1) + stations(m) if m.table.hole_mm else math.nan,
        "taken away|finite",
    ),
    KnownSlip(
        "08.1",
        "no hole",
        lambda m: without_hole(m) if m.table.hole_mm else math.nan,
        "^Here the plate has no hole|finite",
    ),
    KnownSlip("08.1", "from the axis", from_the_axis, "begins at the axis"),
    KnownSlip(
        "08.1", "a quarter of M R²", lambda m: plate(m) / 2 + stations(m), "as about a diameter"
    ),
    KnownSlip(
        "08.1",
        "all of the plate at the rim",
        lambda m: 2 * without_hole(m) - stations(m),
        "all of the plate is at its rim",
    ),
    KnownSlip(
        "08.1",
        "the plate's radii halved",
        lambda m: plate(m) / 4 + stations(m),
        "radii of the plate were halved",
    ),
    KnownSlip("08.1", "in mm", lambda m: 1e6 * inertia(m), "mm"),
    KnownSlip("08.1", "the mass", lambda m: m.table.plate_kg + stations(m, 1000), "mass"),
    # The largest torque.
    KnownSlip("08.2", "no friction", lambda m: inertia(m) * push(m), "[Ff]riction"),
    KnownSlip("08.2", "friction helps", lambda m: 2 * inertia(m) * push(m) - torque(m), "subtract"),
    KnownSlip(
        "08.2", "friction twice", lambda m: torque(m) + m.table.friction_N_m, "was added twice"
    ),
    KnownSlip(
        "08.2",
        "in degrees",
        lambda m: math.degrees(inertia(m) * push(m)) + m.table.friction_N_m,
        "degrees",
    ),
    KnownSlip(
        "08.2",
        "a whole turn",
        lambda m: inertia(m) * push(m) * m.table.stops + m.table.friction_N_m,
        "whole turn",
    ),
    KnownSlip(
        "08.2", "the lesson's", lessons(38.5 * math.pi / 4 / 0.75**2 * SINE + 10), "of the lesson"
    ),
    KnownSlip("08.2", "no factor", lambda m: torque(m, 1), "factor Ca"),
    KnownSlip("08.2", "velocity factor", lambda m: torque(m, CV[m.table.law]), "velocity|Cv"),
    KnownSlip(
        "08.2",
        "the lesson's inertia",
        lambda m: lessons(38.5 - 0.72)(m) * push(m) + m.table.friction_N_m,
        "the lesson's answer to 08.1",
    ),
    KnownSlip("08.2", "in N mm", lambda m: 1000 * torque(m), "N mm"),
    KnownSlip("08.2", "in kN m", lambda m: torque(m) / 1000, "kN m"),
    KnownSlip("08.2", "power factor", lambda m: torque(m, CQ[m.table.law]), "Cq"),
    KnownSlip("08.2", "constant", lambda m: torque(m, 4), "constant"),
    *(
        by_another_law(number, law, said)
        for number in ("08.2", "08.3")
        for law, said in (
            ("modified sine", "modified sine"),
            ("cycloidal", "cycloid"),
            ("modified trapezoid", "modified trapezoid"),
            ("3-4-5 polynomial", "3-4-5"),
            ("4-5-6-7 polynomial", "4-5-6-7"),
        )
    ),
    KnownSlip(
        "08.2",
        "no hole",
        lambda m: without_hole(m) * push(m) + m.table.friction_N_m if m.table.hole_mm else math.nan,
        "wrong answer to 08.1 .*no hole|finite",
    ),
    KnownSlip(
        "08.2",
        "no square",
        lambda m: inertia(m) * push(m) * m.table.time_s + m.table.friction_N_m,
        "square",
    ),
    KnownSlip("08.2", "the acceleration", push, "acceleration, in rad"),
    # The torque of the camshaft.
    KnownSlip(
        "08.3",
        "peaks multiplied",
        lambda m: shaft(m, CA[m.table.law] * CV[m.table.law]),
        "same moment",
    ),
    KnownSlip("08.3", "the mean ratio", lambda m: shaft(m, CA[m.table.law]), "evenly|fast"),
    KnownSlip(
        "08.3",
        "the mean ratio, with friction",
        lambda m: shaft(m, CA[m.table.law]) + friction_on_shaft(m),
        "evenly too, and the friction",
    ),
    KnownSlip(
        "08.3", "friction added", lambda m: shaft(m) + friction_on_shaft(m), "Friction is in it"
    ),
    KnownSlip(
        "08.3",
        "friction at the largest speed",
        lambda m: shaft(m) + friction_on_shaft(m) * CV[m.table.law],
        "at the largest speed of the table",
    ),
    KnownSlip(
        "08.3", "the time squared", lambda m: shaft(m) * m.table.time_s, "the time counts three"
    ),
    KnownSlip(
        "08.3",
        "the table's friction added",
        lambda m: shaft(m) + m.table.friction_N_m,
        "friction on the table was added",
    ),
    KnownSlip("08.3", "the lesson's", lessons(91.8), "lesson's table asks, with its friction"),
    KnownSlip(
        "08.3",
        "no hole",
        lambda m: shaft(m) * without_hole(m) / inertia(m) if m.table.hole_mm else math.nan,
        "wrong answer to 08.1 .*no hole|finite",
    ),
    KnownSlip("08.3", "on the table, with friction", torque, "on the table, with the friction"),
    KnownSlip("08.3", "pi/n", lambda m: shaft(m) / 4, "not pi/n"),
    KnownSlip("08.3", "on the table", lambda m: inertia(m) * push(m), "on the table"),
    KnownSlip("08.3", "the power", lambda m: shaft(m, shaft_rad_per_s=1), "power, in W"),
    KnownSlip(
        "08.3",
        "in degrees",
        lambda m: shaft(m, shaft_rad_per_s=m.table.angle_deg / m.table.time_s),
        "degrees",
    ),
    KnownSlip(
        "08.3",
        "a whole turn",
        lambda m: shaft(m, shaft_rad_per_s=2 * math.pi / m.table.time_s),
        "whole turn",
    ),
    KnownSlip("08.3", "velocity factor", lambda m: shaft(m, CV[m.table.law]), "Cv"),
    KnownSlip("08.3", "pi/n, once", lambda m: shaft(m) / 2, "half .* in one place"),
    KnownSlip("08.3", "by the angle", lambda m: shaft(m) / m.table.time_s, "by the angle"),
    KnownSlip("08.3", "with friction", with_friction, "friction"),
    KnownSlip(
        "08.3",
        "ratio upside down",
        lambda m: shaft(m) * (math.radians(m.table.angle_deg) * m.table.stops / (2 * math.pi)) ** 2,
        "upside",
    ),
    # The Geneva wheel.
    KnownSlip("08.4", "at the entry", lambda m: bent(m, entry(m)) * omega(m) ** 2, "entry"),
    KnownSlip("08.4", "the largest", largest, "largest"),
    KnownSlip(
        "08.4", "pi/n", lambda m: bent(m, math.pi / m.table.slots) * omega(m) ** 2, "alpha is pi/n"
    ),
    KnownSlip(
        "08.4", "half of the wheel's way", by_the_wheel, "half-way in the angle of the wheel"
    ),
    KnownSlip(
        "08.4",
        "pi/2n",
        lambda m: bent(m, math.pi / 2 / m.table.slots) * omega(m) ** 2,
        r"alpha is pi/\(2n\)",
    ),
    KnownSlip("08.4", "2 pi/n", of_half_the_slots, "2 pi/n|finite"),
    KnownSlip("08.4", "cos(pi/n)", of_cosine, "lambda is the cosine|finite"),
    KnownSlip("08.4", "no arctan", tangent, "arctan is missing"),
    KnownSlip("08.4", "half of the entry", lambda m: bent(m, entry(m)) * omega(m) ** 2 / 2, "line"),
    KnownSlip(
        "08.4", "the velocity", lambda m: bent(m, entry(m) / 2, 1) * omega(m), "velocity, in"
    ),
    KnownSlip("08.4", "pi/n in degrees", lambda m: in_degrees(m, entry(m) / 2), "angle in degrees"),
    KnownSlip(
        "08.4",
        "pi/n and alpha in degrees",
        lambda m: in_degrees(m, math.degrees(entry(m) / 2)),
        "angle in degrees",
    ),
    KnownSlip(
        "08.4",
        "the speed in degrees",
        lambda m: bent(m, entry(m) / 2) * math.degrees(omega(m)) ** 2,
        "in degrees a second",
    ),
    KnownSlip(
        "08.4",
        "the first derivative",
        lambda m: bent(m, entry(m) / 2, 1) * omega(m) ** 2,
        "the first derivative with the square",
    ),
    KnownSlip("08.4", "half of the largest", lambda m: largest(m) / 2, "half of the largest one"),
    KnownSlip("08.4", "pi/4", lambda m: bent(m, math.pi / 4) * omega(m) ** 2, "pi/n is forgotten"),
    KnownSlip("08.4", "no square", lambda m: wheel(m) / omega(m), "square"),
    KnownSlip("08.4", "no speed", lambda m: wheel(m) / omega(m) ** 2, "speed"),
    KnownSlip(
        "08.4", "turns a minute", lambda m: wheel(m) * (60 / 2 / math.pi) ** 2, "[Tt]urns a minute"
    ),
    KnownSlip(
        "08.4", "turns a second", lambda m: wheel(m) / (2 * math.pi) ** 2, "[Tt]urns a second"
    ),
    KnownSlip("08.4", "per minute", lambda m: 3600 * wheel(m), "per minute"),
    KnownSlip("08.4", "downwards", lambda m: -wheel(m), "sign"),
    # The choice, each wrong option.
    KnownSlip("08.5", "a: no squares", lambda _: "a", "time"),
    KnownSlip("08.5", "c: as the power", lambda _: "c", "shaft"),
    KnownSlip("08.5", "d: power as torque", lambda _: "d", "velocity"),
]
