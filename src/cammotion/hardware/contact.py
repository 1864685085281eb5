"""The pressure between a cam and its roller, after Hertz."""

import math

import numpy as np
from numpy.typing import ArrayLike

from cammotion.hardware.followers import ROLLER
from cammotion.quantities import Floats, InputError, Numbers, Quantity, broadcast, plain

FORCE = Quantity("force on the cam", "N", example=500, low=-math.inf)
RADIUS = Quantity("radius of curvature of the profile", "mm", example=60, low=-math.inf)
WIDTH = Quantity("width of the contact", "mm", example=12)
MODULUS = Quantity("modulus of elasticity", "N/mm²", example=210_000)
POISSON = Quantity("Poisson ratio", "", example=0.3, high=0.5)


def hertz_pressure(  # noqa: PLR0913 - each is in the formula
    force_N: ArrayLike,  # noqa: N803 - newton
    profile_radius_mm: ArrayLike,
    *,
    roller_radius_mm: float,
    width_mm: float,
    modulus_N_per_mm2: float = 210_000,  # noqa: N803
    poisson: float = 0.3,
) -> Numbers:
    """Return the largest pressure in N/mm² between a cam and a roller of one material.

    `force_N` is along the normal: the load over the cosine of the pressure angle. The radius of the
    profile is above 0 where it bulges outwards, below 0 where it is hollow and infinite where it is
    straight; force and radius are numbers or arrays of one shape. Where the force is not above 0
    nothing presses, whatever the radius. For a line contact of cylinders, which the crowned roller
    of a real cam is not quite (Hertz 1881; in any book on machine elements). Raises InputError
    where a hollow that is narrower than the roller is pressed.

    >>> print(f"{hertz_pressure(500, 60, roller_radius_mm=10, width_mm=12):.0f} N/mm²")
    423 N/mm²
    """
    force, radius = FORCE.array(force_N), _radii(profile_radius_mm)
    broadcast(force_N=force, profile_radius_mm=radius)
    roller, width = ROLLER.number(roller_radius_mm), WIDTH.number(width_mm)
    modulus, ratio = MODULUS.number(modulus_N_per_mm2), POISSON.number(poisson)
    force, radius = np.broadcast_arrays(np.maximum(force, 0), radius)
    _check(radius[force > 0], roller)
    curvature = 1 / roller + 1 / np.where(force > 0, radius, math.inf)
    stiffness = modulus / (2 * math.pi * (1 - ratio**2))
    return plain(np.sqrt(force / width * curvature * stiffness))


def _radii(profile_radius_mm: ArrayLike) -> Floats:
    """Return radii of curvature as floats, of which a straight flank has an infinite one."""
    try:
        known = np.array(profile_radius_mm, dtype=np.float64)
    except (TypeError, ValueError):  # to be refused in words
        return RADIUS.array(profile_radius_mm)
    straight = np.isinf(known)
    if not straight.any():
        return RADIUS.array(profile_radius_mm)
    return np.where(straight, known, RADIUS.array(np.where(straight, 1.0, known)))


def _check(radius: Floats, roller: float) -> None:
    """Raise InputError for a radius of what presses that the roller cannot touch."""
    narrow = (radius <= 0) & (radius >= -roller)
    if narrow.any():
        raise InputError(
            f"The profile's radius of curvature is {radius[narrow].max():g} mm, which the roller "
            f"of {roller:g} mm cannot touch: give a cam without an undercut, and a smaller roller "
            "for a hollow."
        )
