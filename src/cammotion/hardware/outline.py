"""A closed curve of a cam as arcs of circles or as chords, as many as a tolerance asks for."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from cammotion.bracketed import cuts
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity

TOLERANCE = Quantity("tolerance of the outline", "mm", example=0.001, low=1e-6, low_included=True)

_FIRST_DEG, _LEAST_DEG = 15.0, 1e-6
_HALVINGS = 24
_SHARES = np.linspace(0, 1, 9)  # of a part, where it is looked at
_MIDDLE = len(_SHARES) // 2
_SURE = 0.9  # between the places that are looked at a curve may be a little further off


class Outline(NamedTuple):
    """Corners of a closed outline: cam angles in deg, points (x, y) in mm, and bulges.

    A bulge says how the outline goes to the next corner: 0 for a chord, else the tangent of a
    quarter of the angle of an arc, above 0 where that turns left, as DXF has it.
    """

    angles_deg: Floats
    points_mm: Floats
    bulges: Floats


def arcs_along(curve: Callable[[Floats], Floats], motion: Motion, tolerance_mm: float) -> Outline:
    """Return a closed curve over the cam angle as arcs, which miss it by at most a tolerance.

    `curve` returns points (n, 2) in mm for angles in deg, and is smooth within each segment of the
    motion.

    >>> import cammotion as cm
    >>> cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(10), prime_radius_mm=160)
    >>> [len(arcs_along(cam.profile_mm, cam.motion, t).angles_deg) for t in (0.1, 0.001)]
    [33, 77]
    """
    angles = _divided(curve, motion, tolerance_mm, _off_the_arc)
    ends = np.append(angles, angles[0] + DEG_PER_TURN)
    middle = curve((ends[:-1] + ends[1:]) / 2)
    points = curve(angles)
    before, after = middle - points, np.roll(points, -1, axis=0) - middle
    turned = np.arctan2(_cross(before, after), (before * after).sum(axis=1))
    return Outline(angles % DEG_PER_TURN, points, np.tan(turned / 2))


def chords_along(curve: Callable[[Floats], Floats], motion: Motion, tolerance_mm: float) -> Outline:
    """Return a closed curve over the cam angle as chords, which miss it by at most a tolerance."""
    angles = _divided(curve, motion, tolerance_mm, _off_the_chord)
    return Outline(angles % DEG_PER_TURN, curve(angles), np.zeros(len(angles)))


def _divided(
    curve: Callable[[Floats], Floats],
    motion: Motion,
    tolerance_mm: float,
    off: Callable[[Floats], Floats],
) -> Floats:
    """Return the cam angles in order at which the parts begin, halved until they are good."""
    tolerance = _SURE * TOLERANCE.number(tolerance_mm)
    starts, ends = _first_parts(motion)
    done: list[Floats] = []
    for _ in range(_HALVINGS):
        places = starts[:, None] + (ends - starts)[:, None] * _SHARES
        points = curve(places.ravel()).reshape(*places.shape, 2)
        is_good = off(points) <= tolerance
        done.append(starts[is_good])
        starts, ends, middle = starts[~is_good], ends[~is_good], places[~is_good, _MIDDLE]
        if not starts.size:
            return np.sort(np.concatenate(done))
        starts, ends = np.concatenate([starts, middle]), np.concatenate([middle, ends])
    raise InputError(
        f"The outline cannot be drawn to {tolerance_mm:g} mm: it has a corner at "
        f"{starts[0] % DEG_PER_TURN:.5g} deg. Give a larger tolerance, or a cam without a cusp."
    )


def _first_parts(motion: Motion) -> tuple[Floats, Floats]:
    starts, ends = [], []
    for piece in motion.curve.pieces:
        count = int(np.ceil((piece.high - piece.low) / _FIRST_DEG))
        places = np.union1d(np.linspace(piece.low, piece.high, count + 1), cuts(piece))
        wide = np.diff(places) > _LEAST_DEG  # a cut may lie just beside an end
        starts.append(places[:-1][wide])
        ends.append(places[1:][wide])
    return np.concatenate(starts), np.concatenate(ends)


def _off_the_chord(points: Floats) -> Floats:
    """Return how far the points between lie off the chord, at most, for each part (n, 9, 2)."""
    chord = points[:, -1] - points[:, 0]
    length = np.hypot(*chord.T)
    beside = points[:, 1:-1] - points[:, :1]
    return np.asarray(np.abs(_cross(chord[:, None], beside)).max(axis=1) / length)


def _off_the_arc(points: Floats) -> Floats:
    """Return how far the points between lie off the arc through both ends and the middle."""
    start, middle, end = points[:, 0], points[:, _MIDDLE], points[:, -1]
    one, two = middle - start, end - start
    twice = 2 * _cross(one, two)
    squares = (one**2).sum(axis=1), (two**2).sum(axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        across = np.stack(
            [
                (two[:, 1] * squares[0] - one[:, 1] * squares[1]) / twice,
                (one[:, 0] * squares[1] - two[:, 0] * squares[0]) / twice,
            ],
            axis=1,
        )
        radius = np.hypot(*across.T)
        away = np.hypot(*np.moveaxis(points[:, 1:-1] - (start + across)[:, None], -1, 0))
        off = np.abs(away - radius[:, None]).max(axis=1)
    return np.where(np.isfinite(off) & (radius < 1e6), off, _off_the_chord(points))  # noqa: PLR2004 - straight


def _cross(one: Floats, two: Floats) -> Floats:
    return np.asarray(one[..., 0] * two[..., 1] - one[..., 1] * two[..., 0])
