"""A camshaft that moves mill and die, and what it asks written out once more in NumPy.

What stands here in NumPy is of cycloids: it knows no span, no piece and no integral of the package.
"""

import math
from typing import NamedTuple

import numpy as np
from machines import RATE, Array, make_diagram, make_die, make_mill

import cammotion as cm

TURN_S = 3600 / RATE
SPEED = 2 * math.pi / TURN_S
COUNT = 360_000
AT = (np.arange(COUNT) + 0.5) * 360 / COUNT
DIE = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=5, preload_N=100, weight_N=117.7)
MILL = cm.FollowerLoad(mass_kg=40)
PRESSING = cm.ProcessForce(motion="die", from_deg=190, to_deg=205, force_N=100, last_N=700)
SHAFT = cm.Camshaft(
    make_diagram(make_mill(), make_die(120)),
    {"die": DIE, "mill": MILL},
    process=[PRESSING],
    friction_N={"die": 20, "mill": 35},
    inertia_kg_m2=2,
)


class Sampled(NamedTuple):
    """Position in mm, velocity in m/s and acceleration in m/s2."""

    mm: Array
    velocity: Array
    acceleration: Array


def cycloid(at: Array, start: float, angle: float, stroke: float) -> Sampled:
    """Return a rise, or with a negative stroke a return, that begins at 0 mm."""
    x, tm = np.clip((at - start) / angle, 0, 1), angle / 360 * TURN_S
    moves = (x > 0) & (x < 1)
    w = 2 * math.pi * x
    return Sampled(
        stroke * (x - np.sin(w) / (2 * math.pi)),
        moves * stroke / 1000 / tm * (1 - np.cos(w)),
        moves * stroke / 1000 / tm**2 * 2 * math.pi * np.sin(w),
    )


def die(at: Array) -> Sampled:
    """Return the die, down from 205 to 305 deg; its rise begins at 85, its return ends at 425."""
    at = np.where(at < 65, at + 360, at)
    both = zip(cycloid(at, 85, 120, 50), cycloid(at, 305, 120, -50), strict=True)
    return Sampled(*(down + up for down, up in both))


def mill(at: Array) -> Sampled:
    """Return the mill, which moves from 0 to 150 deg."""
    return cycloid(at, 0, 150, 100)


def forces(at: Array, rate: float = RATE) -> dict[str, Array]:
    """Return the force of each mechanism in N at a rate in pieces/h."""
    moved, turret = die(at), mill(at)
    faster = (rate / RATE) ** 2
    pressed = np.where((at >= 190) & (at < 205), 100 + 40 * (at - 190), 0)
    standing = 5 * moved.mm + 217.7 + 20 * np.sign(moved.velocity) + pressed
    return {
        "die": 12 * faster * moved.acceleration + standing,
        "mill": 40 * faster * turret.acceleration + 35 * np.sign(turret.velocity),
    }


def torque(at: Array, rate: float = RATE) -> Array:
    """Return the torque on the shaft in N m at a rate in pieces/h."""
    found = forces(at, rate)
    power = found["die"] * die(at).velocity + found["mill"] * mill(at).velocity
    return np.asarray(power / SPEED)
