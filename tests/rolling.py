"""A follower rolled over the outline of a cam, which knows nothing of how the outline was made."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

_DENSE_MM = 0.02
Outline = NDArray[np.complex128]


def dense(corners: list[tuple[float, float, float]], step_mm: float = _DENSE_MM) -> Outline:
    """Return points along a closed line of (x, y, bulge), whose arcs and chords are filled."""
    filled = []
    for (x, y, bulge), (next_x, next_y, _) in zip(corners, corners[1:] + corners[:1], strict=True):
        chord = complex(next_x - x, next_y - y)
        angle = 4 * math.atan(bulge)
        length = abs(chord) if abs(angle) < 1e-9 else abs(chord) * angle / 2 / math.sin(angle / 2)
        shares = np.linspace(0, 1, max(2, math.ceil(length / step_mm)), endpoint=False)
        if abs(angle) < 1e-9:
            filled.append(complex(x, y) + shares * chord)
        else:
            centre = complex(x, y) + chord * (0.5 + 0.5j / math.tan(angle / 2))
            filled.append(centre + (complex(x, y) - centre) * np.exp(1j * angle * shares))
    return np.concatenate(filled)


def turned(outline: Outline, angle_deg: float) -> Outline:
    """Return the outline as it stands in the machine: a cam that has turned clockwise."""
    return np.asarray(outline * np.exp(-1j * math.radians(angle_deg)))


def roller_height(outline: Outline, angle_deg: float, radius: float, beside: float) -> float:
    """Return how high a roller's centre lies that is let down `beside` the axis, right positive."""
    seen = turned(outline, angle_deg)
    near = np.abs(seen.real - beside) < radius
    above = seen.imag[near] + np.sqrt(radius**2 - (seen.real[near] - beside) ** 2)
    return float(above.max())


def face_height(outline: Outline, angle_deg: float) -> float:
    """Return how high a flat face lies on the cam."""
    return float(turned(outline, angle_deg).imag.max())


def arm_angle(outline: Outline, angle_deg: float, radius: float, arm: float, pivot: float) -> float:
    """Return the angle in rad at which an arm about a pivot on the right lies on the cam.

    It is counted from the direction of the axis of x, and falls as the roller goes outwards.
    """
    seen = turned(outline, angle_deg)

    def room(angle: Any) -> float:
        return float(np.abs(pivot + arm * np.exp(1j * angle) - seen).min()) - radius

    lifted = next(a for a in np.arange(0.02, math.pi, 0.01) if room(a) < 0)
    return float(brentq(room, lifted - 0.01, lifted, xtol=1e-13))
