"""Lesson 10 by hand: right answers, and wrong ones that a student could give.

Nothing here knows of the package's springs, laws or followers, or of the slips that it recognises.
"""

import math
from collections.abc import Callable
from functools import cache, partial

import numpy as np
from known_slips import G, KnownSlip, law, law_in_degrees
from scipy.integrate import simpson, solve_ivp
from scipy.linalg import eigh
from scipy.optimize import minimize_scalar

from cammotion.teaching.example import MillAndDie


def rise_s(m: MillAndDie) -> float:
    """Return the time of the rise of 10.1."""
    return m.follower.rod.rise_deg / 360 * 3600 / m.follower.rod.per_hour


def both(m: MillAndDie) -> float:
    """Return what lever and rod need together, in N/mm."""
    per_second = m.follower.rod.swings / rise_s(m)
    return m.follower.rod.slide_kg * (2 * math.pi * per_second) ** 2 / 1000


def rod(m: MillAndDie, together: float | None = None) -> float:
    """Return the rod in N/mm whose give is what the lever leaves of the give of both."""
    give = 1 / (together or both(m)) - 1 / m.follower.rod.lever_N_per_mm
    return 1 / give


def with_rounded_time(m: MillAndDie, rounded: Callable[[float], int]) -> float:
    """Return the rod for whole hundredths of a second, NaN where nobody can tell."""
    time = rounded(round(100 * rise_s(m), 6)) / 100
    wrong = rod(m, both(m) * (rise_s(m) / time) ** 2)
    return wrong if abs(wrong / rod(m) - 1) > 0.004 else math.nan


def unsquared(m: MillAndDie) -> float:
    """Return the mass times the angular frequency for what lever and rod need together."""
    return m.follower.rod.slide_kg * math.tau * m.follower.rod.swings / rise_s(m) / 1000


def swings(m: MillAndDie) -> float:
    return math.prod(m.follower.ringing)


@cache
def pushed(m: MillAndDie) -> float:
    """Return how far the mass swings after the move, by integration over the time in moves."""
    w = 2 * math.pi * swings(m)

    def run(start: list[float], way: Callable[[float], float], low: float) -> list[float]:
        def rates(t: float, y: list[float]) -> list[float]:
            return [y[1], w**2 * (way(t) - y[0])]

        ends = solve_ivp(rates, (low, low + 0.5), start, method="DOP853", rtol=1e-11, atol=1e-13).y[
            :, -1
        ]
        return [*map(float, ends)]

    middle = run([0, 0], lambda t: 2 * t**2, 0)
    place, velocity = run(middle, lambda t: 1 - 2 * (1 - t) ** 2, 0.5)
    return m.follower.jump_mm * math.hypot(place - 1, velocity / w)


@cache
def arrows(m: MillAndDie, jumps: tuple[float, ...], w: float | None = None) -> float:
    """Return the length of the sum of the arrows of jumps, in mm."""
    w = w or 2 * math.pi * swings(m)
    across = sum(jump * math.cos(n * w / 2) for n, jump in enumerate(jumps))
    along = sum(jump * math.sin(n * w / 2) for n, jump in enumerate(jumps))
    return m.follower.jump_mm * math.hypot(across, along) / w**2


@cache
def harmonic(m: MillAndDie) -> float:
    """Return what the simple harmonic motion leaves: its acceleration, turned back and summed."""
    w, x = math.tau * swings(m), np.linspace(0, 1, 20_001)
    push = np.pi**2 / 2 * np.cos(np.pi * x) * np.exp(-1j * w * x)
    return float(m.follower.jump_mm * abs(simpson(push, x=x)) / w)


def turns(m: MillAndDie, time_s: float) -> float:
    """Return the turns a minute at which the rise of 10.3 takes a time."""
    return 60 / (time_s * 360 / m.follower.lift_deg)


def time_s(m: MillAndDie, pressed_mm: float, factor: float = 2 * math.pi) -> float:
    """Return the time of the rise with which a spring so pressed just brakes by a factor."""
    force = m.follower.spring_N_per_mm * pressed_mm
    return math.sqrt(m.follower.lifted_kg * m.follower.lift_mm / 1000 * factor / force)


@cache
def leaves(m: MillAndDie, pressed: float | None = None, more: float = 0) -> float:
    """Return the turns a minute above which it leaves: the least over the rise."""
    pressed = m.follower.pressed_mm if pressed is None else pressed

    def speed(x: float) -> float:
        spring = pressed + m.follower.lift_mm * law(x) + more / m.follower.spring_N_per_mm
        return turns(m, time_s(m, spring, -2 * math.pi * math.sin(2 * math.pi * x)))

    found = minimize_scalar(speed, bounds=(0.51, 0.99), options={"xatol": 1e-10})
    return float(found.fun)


@cache
def leaves_in_degrees(m: MillAndDie, added: float = 1) -> float:
    """Return it with a way of the spring for which the sine counts in degrees, or not at all."""
    x = np.linspace(0.51, 0.99, 20_001)
    way = x - added * np.sin(np.radians(2 * math.pi * x)) / (2 * math.pi)
    force = m.follower.spring_N_per_mm * (m.follower.pressed_mm + m.follower.lift_mm * way)
    brake = -2 * math.pi * np.sin(2 * math.pi * x) * m.follower.lift_mm / 1000
    return turns(m, math.sqrt(float(np.max(m.follower.lifted_kg * brake / force))))


@cache
def at_the_hardest(m: MillAndDie) -> float:
    """Return how far the spring is pressed together at three quarters of the rise."""
    return m.follower.pressed_mm + m.follower.lift_mm * (0.75 + 1 / (2 * math.pi))


def hertz(stiffness: float, mass: float) -> float:
    return math.sqrt(1000 * stiffness / mass) / (2 * math.pi)


def modes(m: MillAndDie, m1: float, m2: float, *, swap: bool = False) -> list[float]:
    """Return both frequencies: w^4 m1 m2 - w^2 (m1 k2 + m2 (k1 + k2)) + k1 k2 = 0."""
    k1, k2 = m.follower.k1_N_per_mm, m.follower.k2_N_per_mm
    k1, k2 = (k2, k1) if swap else (k1, k2)
    squares = np.roots([m1 * m2, -(m1 * k2 + m2 * (k1 + k2)), k1 * k2])
    return sorted(hertz(float(square), 1) for square in squares)


def lower(m: MillAndDie) -> float:
    return modes(m, m.follower.m1_kg, m.follower.m2_kg)[0]


def off(m: MillAndDie, mm: float) -> float:
    """Return the turns a minute by the hardest place with the spring pressed so much more."""
    return turns(m, time_s(m, at_the_hardest(m) + mm))


def sags(m: MillAndDie) -> float:
    """Return by how many mm the follower's weight would press its spring."""
    return G * m.follower.lifted_kg / m.follower.spring_N_per_mm


def not_rooted(m: MillAndDie, speed: float) -> float:
    """Return the turns a minute if the square of the time of the rise is taken for the time."""
    return turns(m, turns(m, speed) ** 2)  # of so many turns a minute it is the time, too


def both_stretched(m: MillAndDie) -> float:
    """Return the lower frequency with k1 + k2 at the head, too: the other end of it is held."""
    f = m.follower
    both = f.k1_N_per_mm + f.k2_N_per_mm
    stiffness = [[both, -f.k2_N_per_mm], [-f.k2_N_per_mm, both]]
    squares = eigh(stiffness, np.diag([f.m1_kg, f.m2_kg]), eigvals_only=True)
    return hertz(float(squares[0]), 1)


def both_on_spindle(m: MillAndDie) -> float:
    """Return the swing of both masses on the spindle, NaN where nobody can tell."""
    wrong = hertz(m.follower.k2_N_per_mm, m.follower.m1_kg + m.follower.m2_kg)
    return wrong if abs(wrong / lower(m) - 1) > 0.002 else math.nan


def rod_alone(m: MillAndDie) -> float:
    """Return the lower frequency with k1 for k1 + k2 in the matrix, NaN where there is none.

    Then w^4 m1 m2 - w^2 (m1 k2 + m2 k1) + k2 (k1 - k2) = 0.
    """
    f = m.follower
    a, b = f.m1_kg * f.m2_kg, f.m1_kg * f.k2_N_per_mm + f.m2_kg * f.k1_N_per_mm
    c = f.k2_N_per_mm * (f.k1_N_per_mm - f.k2_N_per_mm)
    return hertz((b - math.sqrt(b**2 - 4 * a * c)) / (2 * a), 1) if c > 0 else math.nan


def in_a_row(m: MillAndDie) -> float:
    k1, k2 = m.follower.k1_N_per_mm, m.follower.k2_N_per_mm
    return k1 * k2 / (k1 + k2)


def two_equal(m: MillAndDie) -> float:
    """Return the lower frequency of two equal masses and springs, NaN where it is the right one."""
    f = m.follower
    if f.m1_kg == f.m2_kg and f.k1_N_per_mm == f.k2_N_per_mm:
        return math.nan
    return 0.6180339887498949 * hertz(f.k1_N_per_mm, f.m1_kg)


def dunkerley(m: MillAndDie) -> float:
    """Return one over the root of the sum of m over k, each mass with all that is beneath it."""
    gives = m.follower.m1_kg / m.follower.k1_N_per_mm + m.follower.m2_kg / in_a_row(m)
    return hertz(1, gives)


def each_alone(m: MillAndDie) -> float:
    """Return it with each mass on its own spring alone."""
    f = m.follower
    return hertz(1, f.m1_kg / f.k1_N_per_mm + f.m2_kg / f.k2_N_per_mm)


def rayleigh(m: MillAndDie) -> float:
    """Return Rayleigh's quotient in Hz for the shape that the weights make, NaN where it is right.

    It is x K x over x M x, with K x = M 1.
    """
    f = m.follower
    k1, k2 = f.k1_N_per_mm, f.k2_N_per_mm
    masses, stiffness = np.diag([f.m1_kg, f.m2_kg]), np.array([[k1 + k2, -k2], [-k2, k2]])
    x = np.linalg.solve(stiffness, np.diag(masses))
    wrong = hertz(float(x @ stiffness @ x), float(x @ masses @ x))
    return wrong if abs(wrong / lower(m) - 1) > 0.002 else math.nan


POLYNOMIAL = np.polynomial.Polynomial([0, 0, 0, 0, 35, -84, 70, -20])


@cache
def wanted(m: MillAndDie, derivative: int = 0) -> float:
    """Return the mass's place in mm, or a derivative of it by the share of the time."""
    curve = POLYNOMIAL.deriv(derivative) if derivative else POLYNOMIAL
    return float(m.follower.wanted_mm * curve(m.follower.wanted_x))


def w_of(m: MillAndDie) -> float:
    return 2 * math.pi * m.follower.wanted_swings


@cache
def end(m: MillAndDie) -> float:
    """Return the height of the cam's end of the spring in mm."""
    return wanted(m) + wanted(m, 2) / w_of(m) ** 2


def with_peak(m: MillAndDie) -> float:
    """Return it with 84 sqrt(5)/25, the most that the bend of the 4-5-6-7 polynomial has."""
    peak = 84 * math.sqrt(5) / 25 * m.follower.wanted_mm / w_of(m) ** 2
    return wanted(m) + (peak if m.follower.wanted_x < 0.5 else -peak)


RIGHT: dict[str, Callable[[MillAndDie], float]] = {
    "10.1": rod,
    "10.2": pushed,
    "10.3": leaves,
    "10.4": lower,
    "10.5": end,
}

SOURCE = {
    "10.1": 1 / (1000 / (12 * (20 * math.pi / 0.624) ** 2) - 1 / 150),
    "10.2": 200 * (math.sin(4.895 * math.pi / 2) / (4.895 * math.pi)) ** 2,
    "10.3": 779.8,
    "10.4": 0.618034 * math.sqrt(1000) / (2 * math.pi),
    "10.5": 50 * (0.070557 + 7.3828 / (5 * math.pi) ** 2),
}

SLIPS = [
    # The rod.
    KnownSlip("10.1", "both together", both, "together"),
    KnownSlip(
        "10.1", "subtracted", lambda m: m.follower.rod.lever_N_per_mm - both(m), "side by side"
    ),
    KnownSlip(
        "10.1",
        "subtracted from both",
        lambda m: both(m) - m.follower.rod.lever_N_per_mm,
        "side by side",
    ),
    KnownSlip(
        "10.1",
        "gives added",
        lambda m: 1 / (1 / both(m) + 1 / m.follower.rod.lever_N_per_mm),
        "give of the lever",
    ),
    KnownSlip("10.1", "the give", lambda m: 1 / rod(m), "one over"),
    KnownSlip("10.1", "two alike", lambda m: 2 * both(m), "alike"),
    KnownSlip("10.1", "no square", lambda m: rod(m, unsquared(m)), "enters only once"),
    KnownSlip("10.1", "no square, both", unsquared, "enters only once"),
    KnownSlip("10.1", "the 10 lost", lambda m: rod(m, 100 * both(m)), "The 10 of"),
    KnownSlip("10.1", "ten times as long", lambda m: rod(m, both(m) / 100), "ten times too long"),
    KnownSlip(
        "10.1", "added", lambda m: both(m) + m.follower.rod.lever_N_per_mm, "stiffnesses were added"
    ),
    KnownSlip("10.1", "no 2 pi", lambda m: rod(m, both(m) / (2 * math.pi) ** 2), "2 pi"),
    KnownSlip(
        "10.1",
        "a whole turn",
        lambda m: rod(m, both(m) * (m.follower.rod.rise_deg / 360) ** 2),
        "whole turn",
    ),
    KnownSlip("10.1", "in N/m", lambda m: rod(m, 1000 * both(m)), "N/m"),
    KnownSlip("10.1", "a second", lambda m: rod(m, both(m) * rise_s(m) ** 2), "of a second"),
    KnownSlip("10.1", "by g", lambda m: rod(m, both(m) / G), r"\bg\b"),
    KnownSlip("10.1", "the weight", lambda m: rod(m, both(m) * G), "weight"),
    KnownSlip("10.1", "per minute", lambda m: rod(m, 3600 * both(m)), "hour"),
    KnownSlip("10.1", "360", lambda m: rod(m, both(m) * (180 / math.pi) ** 2), "taken for 360"),
    *(
        KnownSlip(
            "10.1",
            f"time rounded {way}",
            partial(with_rounded_time, rounded=rounded),
            "hundredth of a second|finite",
        )
        for way, rounded in (("down", math.floor), ("up", math.ceil))
    ),
    KnownSlip("10.1", "half swings", lambda m: rod(m, both(m) / 4), "half as many"),
    # What the constant acceleration leaves.
    KnownSlip("10.2", "one jump", lambda m: arrows(m, (4,)), "single jump"),
    KnownSlip(
        "10.2",
        "in step",
        lambda m: 16 * m.follower.jump_mm / (2 * math.pi * swings(m)) ** 2,
        "sizes|in step",
    ),
    KnownSlip("10.2", "middle too low", lambda m: arrows(m, (4, -4, 4)), "middle"),
    KnownSlip("10.2", "no middle", lambda m: arrows(m, (4, 0, 4)), "missing"),
    KnownSlip("10.2", "no end", lambda m: arrows(m, (4, -8)), "at the end is missing"),
    KnownSlip(
        "10.2",
        "strokes by the square of the time",
        lambda m: pushed(m) / m.follower.jump_mm * (math.tau * swings(m)) ** 2,
        "acceleration with which",
    ),
    KnownSlip(
        "10.2",
        "m/s2",
        lambda m: pushed(m) / 1000 * (math.tau * m.follower.ringing[1]) ** 2,
        "acceleration with which",
    ),
    KnownSlip("10.2", "half of it", lambda m: pushed(m) / 2, "halved"),
    KnownSlip("10.2", "the middle", lambda m: arrows(m, (0, 8)), "middle alone"),
    KnownSlip(
        "10.2",
        "no square",
        lambda m: (
            m.follower.jump_mm * abs(math.sin(math.pi * swings(m) / 2)) / (math.pi * swings(m) / 2)
        ),
        "square",
    ),
    KnownSlip(
        "10.2",
        "no square of the sine",
        lambda m: (
            16
            * m.follower.jump_mm
            * abs(math.sin(math.pi * swings(m) / 2))
            / (math.tau * swings(m)) ** 2
        ),
        "square of the sine",
    ),
    KnownSlip(
        "10.2",
        "no square of the frequency",
        lambda m: math.tau * swings(m) * pushed(m),
        "enters only once",
    ),
    KnownSlip(
        "10.2", "by the second", lambda m: m.follower.ringing[0] ** 2 * pushed(m), "by the second"
    ),
    KnownSlip(
        "10.2",
        "a move apart",
        lambda m: arrows(m, (4, 0, -8, 0, 4)),
        "half a move apart",
    ),
    KnownSlip(
        "10.2",
        "twice the swings",
        lambda m: arrows(m, (4, -8, 4), 4 * math.pi * swings(m)),
        "twice as often",
    ),
    KnownSlip(
        "10.2",
        "sine of degrees",
        lambda m: (
            16
            * m.follower.jump_mm
            * math.sin(math.radians(math.pi * swings(m) / 2)) ** 2
            / (math.tau * swings(m)) ** 2
        ),
        "sine was taken of degrees",
    ),
    KnownSlip(
        "10.2",
        "the cycloid",
        lambda m: (
            m.follower.jump_mm
            * abs(math.sin(math.pi * swings(m)) / (math.pi * swings(m) * (1 - swings(m) ** 2)))
        ),
        "cycloid",
    ),
    KnownSlip("10.2", "no 2 pi", lambda m: arrows(m, (4, -8, 4), swings(m)), "2 pi"),
    KnownSlip("10.2", "one push", lambda m: arrows(m, (2, -4, 2)), "half of the stroke"),
    KnownSlip(
        "10.2", "half the swings", lambda m: arrows(m, (4, -8, 4), math.pi * swings(m)), "half"
    ),
    KnownSlip("10.2", "two alike", lambda m: arrows(m, (4, -4)), "two jumps"),
    KnownSlip("10.2", "no factor", lambda m: arrows(m, (1, -2, 1)), "One stroke .* 2 of 2 sin"),
    KnownSlip("10.2", "harmonic", harmonic, "simple harmonic"),
    KnownSlip("10.2", "no 2 pi below", lambda m: pushed(m) * math.tau**2, "square of the swings"),
    KnownSlip(
        "10.2",
        "degrees put in",
        lambda m: (
            16 * m.follower.jump_mm * np.sin(90 * swings(m)) ** 2 / (2 * math.pi * swings(m)) ** 2
        ),
        "put in in degrees",
    ),
    KnownSlip("10.2", "end to end", lambda m: 2 * pushed(m), "each side"),
    KnownSlip("10.2", "a share", lambda m: pushed(m) / m.follower.jump_mm, "part of the stroke"),
    KnownSlip("10.2", "in percent", lambda m: 100 * pushed(m) / m.follower.jump_mm, "percent"),
    KnownSlip("10.2", "in m", lambda m: pushed(m) / 1000, "metres"),
    # Where the follower leaves.
    KnownSlip(
        "10.3", "the hardest", lambda m: turns(m, time_s(m, at_the_hardest(m))), "brakes hardest"
    ),
    KnownSlip(
        "10.3",
        "lowest",
        lambda m: turns(m, time_s(m, m.follower.pressed_mm)),
        "lowest position",
    ),
    KnownSlip(
        "10.3",
        "at the top",
        lambda m: turns(m, time_s(m, m.follower.pressed_mm + m.follower.lift_mm)),
        "top",
    ),
    KnownSlip(
        "10.3",
        "half-way",
        lambda m: turns(m, time_s(m, m.follower.pressed_mm + m.follower.lift_mm / 2)),
        "half-way",
    ),
    KnownSlip(
        "10.3",
        "3/4 h",
        lambda m: turns(m, time_s(m, m.follower.pressed_mm + 0.75 * m.follower.lift_mm)),
        "Three quarters",
    ),
    KnownSlip(
        "10.3",
        "lost sign",
        lambda m: turns(m, time_s(m, at_the_hardest(m) - m.follower.lift_mm / math.pi)),
        "sign of the sine",
    ),
    KnownSlip(
        "10.3",
        "its own swing",
        lambda m: 60 * hertz(m.follower.spring_N_per_mm, m.follower.lifted_kg),
        "would swing on its spring",
    ),
    KnownSlip(
        "10.3",
        "in degrees, the hardest",
        lambda m: turns(
            m, time_s(m, m.follower.pressed_mm + m.follower.lift_mm * law_in_degrees(0.75))
        ),
        "sine counts in degrees",
    ),
    KnownSlip("10.3", "in degrees", leaves_in_degrees, "sine counts in degrees"),
    KnownSlip("10.3", "x for s", lambda m: leaves_in_degrees(m, 0), "that of the stroke: put x"),
    KnownSlip("10.3", "less weight", lambda m: leaves(m, None, -G * m.follower.lifted_kg), "level"),
    KnownSlip(
        "10.3",
        "not pressed, the hardest",
        lambda m: turns(m, time_s(m, at_the_hardest(m) - m.follower.pressed_mm)),
        "already",
    ),
    KnownSlip(
        "10.3",
        "mm for N",
        lambda m: leaves(m, m.follower.pressed_mm / m.follower.spring_N_per_mm),
        "for newtons",
    ),
    KnownSlip(
        "10.3",
        "mm for N, the hardest",
        lambda m: off(m, m.follower.pressed_mm * (1 / m.follower.spring_N_per_mm - 1)),
        "for newtons",
    ),
    KnownSlip("10.3", "less weight, the hardest", lambda m: off(m, -sags(m)), "taken away"),
    KnownSlip("10.3", "more weight, the hardest", lambda m: off(m, sags(m)), "weight was added"),
    KnownSlip(
        "10.3",
        "no mass",
        lambda m: leaves(m) * math.sqrt(m.follower.lifted_kg),
        "mass is missing",
    ),
    KnownSlip(
        "10.3",
        "no mass, the hardest",
        lambda m: off(m, 0) * math.sqrt(m.follower.lifted_kg),
        "mass is missing",
    ),
    KnownSlip("10.3", "no root", lambda m: not_rooted(m, leaves(m)), "root is missing"),
    KnownSlip(
        "10.3", "no root, the hardest", lambda m: not_rooted(m, off(m, 0)), "root is missing"
    ),
    KnownSlip("10.3", "by g", lambda m: math.sqrt(G) * leaves(m), r"\bg\b"),
    KnownSlip("10.3", "weight for mass", lambda m: leaves(m) / math.sqrt(G), "for the mass"),
    KnownSlip("10.3", "not pressed", lambda m: leaves(m, 0), "already"),
    KnownSlip(
        "10.3",
        "Ca of 4",
        lambda m: turns(m, time_s(m, at_the_hardest(m), 4)),
        "constant acceleration",
    ),
    KnownSlip("10.3", "weight", lambda m: leaves(m, None, G * m.follower.lifted_kg), "level"),
    KnownSlip("10.3", "a turn", lambda m: leaves(m) * 360 / m.follower.lift_deg, "of a turn"),
    KnownSlip("10.3", "rad/s", lambda m: leaves(m) * 2 * math.pi / 60, "rad"),
    KnownSlip("10.3", "a second", lambda m: leaves(m) / 60, "turns a second"),
    KnownSlip("10.3", "an hour", lambda m: 60 * leaves(m), "hour"),
    KnownSlip("10.3", "in mm", lambda m: leaves(m) / math.sqrt(1000), "mm"),
    # Two masses.
    KnownSlip(
        "10.4", "higher", lambda m: modes(m, m.follower.m1_kg, m.follower.m2_kg)[1], "higher"
    ),
    KnownSlip("10.4", "no m1", lambda m: hertz(in_a_row(m), m.follower.m2_kg), "no mass"),
    KnownSlip(
        "10.4",
        "one mass",
        lambda m: hertz(in_a_row(m), m.follower.m1_kg + m.follower.m2_kg),
        "one mass on both",
    ),
    KnownSlip(
        "10.4",
        "rigid spindle",
        lambda m: hertz(m.follower.k1_N_per_mm, m.follower.m1_kg + m.follower.m2_kg),
        "rigid",
    ),
    KnownSlip(
        "10.4",
        "head alone",
        lambda m: hertz(m.follower.k2_N_per_mm, m.follower.m2_kg),
        "slide held still",
    ),
    KnownSlip(
        "10.4",
        "slide alone",
        lambda m: hertz(m.follower.k1_N_per_mm, m.follower.m1_kg),
        "without the head",
    ),
    KnownSlip(
        "10.4",
        "head still",
        lambda m: hertz(m.follower.k1_N_per_mm + m.follower.k2_N_per_mm, m.follower.m1_kg),
        "head held still",
    ),
    KnownSlip(
        "10.4", "slide on both", lambda m: hertz(in_a_row(m), m.follower.m1_kg), "the slide alone"
    ),
    KnownSlip("10.4", "0.618", two_equal, "0.618|finite"),
    KnownSlip("10.4", "periods", dunkerley, "squares of two periods .* any two masses"),
    KnownSlip("10.4", "Rayleigh", rayleigh, "Rayleigh|finite"),
    KnownSlip("10.4", "periods alone", each_alone, "squares of two periods .* spring before it"),
    KnownSlip(
        "10.4",
        "masses exchanged",
        lambda m: modes(m, m.follower.m2_kg, m.follower.m1_kg)[0],
        "masses",
    ),
    KnownSlip(
        "10.4",
        "springs exchanged",
        lambda m: modes(m, m.follower.m1_kg, m.follower.m2_kg, swap=True)[0],
        "springs",
    ),
    KnownSlip(
        "10.4",
        "both exchanged",
        lambda m: modes(m, m.follower.m2_kg, m.follower.m1_kg, swap=True)[0],
        "Both masses and both springs",
    ),
    KnownSlip("10.4", "both on the spindle", both_on_spindle, "masses on the spindle|finite"),
    KnownSlip("10.4", "last place", both_stretched, "last place"),
    KnownSlip("10.4", "the period", lambda m: 1 / lower(m), "how many seconds"),
    KnownSlip("10.4", "push rod alone", rod_alone, "push rod alone|finite"),
    KnownSlip("10.4", "by g", lambda m: math.sqrt(G) * lower(m), r"\bg\b"),
    KnownSlip("10.4", "weight", lambda m: lower(m) / math.sqrt(G), "weight"),
    KnownSlip("10.4", "rad/s", lambda m: 2 * math.pi * lower(m), "rad"),
    KnownSlip("10.4", "N/mm", lambda m: lower(m) / math.sqrt(1000), "N/m"),
    KnownSlip("10.4", "squared", lambda m: (2 * math.pi * lower(m)) ** 2, "square"),
    # The cam that is designed backwards.
    KnownSlip("10.5", "the mass", wanted, "how high the mass"),
    KnownSlip("10.5", "sign", lambda m: 2 * wanted(m) - end(m), "sign"),
    KnownSlip("10.5", "the spring", lambda m: end(m) - wanted(m), "pressed together, below 0"),
    KnownSlip("10.5", "stretched", lambda m: wanted(m) - end(m), "is stretched, below 0"),
    KnownSlip(
        "10.5",
        "no 2 pi",
        lambda m: wanted(m) + wanted(m, 2) / m.follower.wanted_swings**2,
        "2 pi",
    ),
    KnownSlip("10.5", "the peak", with_peak, "The peak of the second"),
    KnownSlip(
        "10.5", "a share", lambda m: m.follower.wanted_x * m.follower.wanted_mm, "share of the time"
    ),
    KnownSlip(
        "10.5", "mass from the top", lambda m: m.follower.wanted_mm - wanted(m), "mass is from the"
    ),
    KnownSlip("10.5", "as it is", lambda m: wanted(m) + wanted(m, 2), "as it is"),
    KnownSlip(
        "10.5",
        "2 pi unsquared",
        lambda m: wanted(m) + wanted(m, 2) / (math.tau * m.follower.wanted_swings**2),
        "not the 2 pi",
    ),
    KnownSlip("10.5", "no square", lambda m: wanted(m) + wanted(m, 2) / w_of(m), "square"),
    KnownSlip(
        "10.5",
        "velocity over the square",
        lambda m: wanted(m) + wanted(m, 1) / w_of(m) ** 2,
        "velocity",
    ),
    KnownSlip("10.5", "velocity", lambda m: wanted(m) + wanted(m, 1) / w_of(m), "velocity"),
    KnownSlip(
        "10.5",
        "cycloid",
        lambda m: (
            m.follower.wanted_mm
            * (
                law(m.follower.wanted_x)
                + 2 * math.pi * math.sin(2 * math.pi * m.follower.wanted_x) / w_of(m) ** 2
            )
        ),
        "cycloid",
    ),
    KnownSlip("10.5", "a part", lambda m: end(m) / m.follower.wanted_mm, "part of the stroke"),
    KnownSlip("10.5", "from the top", lambda m: m.follower.wanted_mm - end(m), "from the top"),
    KnownSlip(
        "10.5",
        "stroke once",
        lambda m: wanted(m) + (end(m) - wanted(m)) / m.follower.wanted_mm,
        "multiplied by the stroke",
    ),
    KnownSlip("10.5", "only pi", lambda m: wanted(m) + 4 * (end(m) - wanted(m)), "2 of the 2 pi"),
    KnownSlip("10.5", "in m", lambda m: end(m) / 1000, "metres"),
    # The choice, each wrong option.
    KnownSlip("10.6", "a: the best", lambda _: "a", "peak of the cam"),
    KnownSlip("10.6", "b: stiffer", lambda _: "b", "five times"),
    KnownSlip("10.6", "d: the cycloid", lambda _: "d", "whole number"),
]
