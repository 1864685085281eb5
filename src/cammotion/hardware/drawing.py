"""What a drawing of a cam consists of, for every program that is to show it.

All lengths are in mm, the cam's axis is the origin, and 0 deg of cam angle points up, along y.
"""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from cammotion.hardware.disc_cam import DiscCam
from cammotion.hardware.flat_faced_cam import FlatFacedCam
from cammotion.hardware.outline import arcs_along
from cammotion.hardware.roller_cam import RollerCam
from cammotion.quantities import Floats, InputError, Quantity, as_text, shorten

BORE = Quantity("diameter of the bore", "mm", example=20)
KEY = Quantity("width and the height of the keyway", "mm", example=6)

_ARROW_DEG, _ARROW_RADIUS = 50, 0.6  # to each side of the top; as a share of the least radius
_HEAD_RAD = 0.1  # so long is the head of the arrow along its arc
_CROSS = 1.25  # the centre's lines, as a share of the arrow's radius


class Stroke(NamedTuple):
    """A line of a drawing on a layer: corners (x, y) in mm, and bulges as an Outline has them."""

    layer: str
    points_mm: Floats
    bulges: Floats
    is_closed: bool = True

    def filled(self) -> Floats:
        """Return it as points (n, 2) in mm, its arcs of at most 2 deg filled with chords."""
        corners = self.points_mm @ [1, 1j]
        ends = np.roll(corners, -1)[: None if self.is_closed else -1]
        parts = [
            _along(start, end, bulge)
            for start, end, bulge in zip(corners, ends, self.bulges, strict=False)
        ]
        points = np.concatenate([*parts, corners[:1] if self.is_closed else corners[-1:]])
        return np.stack([points.real, points.imag], axis=-1)


def strokes(
    cam: DiscCam,
    tolerance_mm: float,
    *,
    groove: bool = False,
    bore_mm: float | None = None,
    keyway_mm: tuple[float, float] | None = None,
) -> Iterator[Stroke]:
    """Yield all strokes of a cam; the outline is arcs that miss it by at most a tolerance."""
    if keyway_mm is not None and bore_mm is None:
        raise InputError(
            f"The keyway is {shorten(keyway_mm)}, and there is no bore for it: give bore_mm too."
        )
    profile = arcs_along(cam.profile_mm, cam.motion, tolerance_mm)
    least = float(np.hypot(*profile.points_mm.T).min())
    yield Stroke("PROFILE", profile.points_mm, profile.bulges)
    if isinstance(cam, RollerCam):
        yield from _of_roller(cam, tolerance_mm, groove)
    if isinstance(cam, FlatFacedCam):
        height = float(cam.base_radius_mm + cam.lift(0).lift)
        yield _line("FOLLOWER", *((end, height) for end in cam.face_mm))
    yield from _centre(least)
    if bore_mm is not None:
        yield _bore(BORE.number(bore_mm) / 2, keyway_mm, least)


def _of_roller(cam: RollerCam, tolerance: float, groove: bool) -> Iterator[Stroke]:
    if groove:
        far = arcs_along(lambda at: cam.profile_mm(at, outer=True), cam.motion, tolerance)
        yield Stroke("PROFILE", far.points_mm, far.bulges)
    pitch = arcs_along(cam.pitch_mm, cam.motion, tolerance)
    yield Stroke("PITCH_CURVE", pitch.points_mm, pitch.bulges)
    yield _circle("FOLLOWER", cam.pitch_mm(0), cam.roller_radius_mm)


def _centre(least: float) -> Iterator[Stroke]:
    """Yield the cross at the axis, the mark of 0 deg and the arrow of the clockwise rotation."""
    radius = _ARROW_RADIUS * least
    reach = _CROSS * radius
    yield _line("CENTRE", (-reach, 0.0), (reach, 0.0))
    yield _line("CENTRE", (0.0, -reach), (0.0, reach))
    yield _line("ZERO_MARK", (0.0, reach), (0.0, least))
    start, end = (math.radians(90 + side * _ARROW_DEG) for side in (1, -1))
    along = np.array([[math.cos(angle), math.sin(angle)] for angle in (start, end)]) * radius
    turn = -math.tan((start - end) / 4)
    yield Stroke("ROTATION", along, np.array([turn, 0.0]), is_closed=False)
    for side in (0.82, 1.18):  # the arrow's head: back along the arc, inwards and outwards
        back = end + _HEAD_RAD
        barb = radius * side**0.5 * math.cos(back), radius * side**0.5 * math.sin(back)
        yield _line("ROTATION", tuple(along[1]), barb)


def _bore(radius: float, keyway: tuple[float, float] | None, least: float) -> Stroke:
    reach = radius
    if keyway is not None:
        width, height = KEY.array(keyway).tolist()
        reach = math.hypot(radius + height, width / 2)
        if width >= 2 * radius:
            raise InputError(
                f"The keyway is {width:g} mm wide and the bore {2 * radius:g}: give a narrower one."
            )
    if reach >= least:
        far, near = (as_text(radius, ".4g") for radius in (reach, least))
        raise InputError(
            f"The bore and its keyway reach {far} mm from the axis, and the profile comes as "
            f"near as {near} mm: give a smaller bore, or a larger cam."
        )
    if keyway is None:
        return _circle("BORE", np.zeros(2), radius)
    half = width / 2
    foot, top = math.sqrt(radius**2 - half**2), radius + height
    corners = np.array([[-half, foot], [-half, top], [half, top], [half, foot]])
    around = 2 * math.pi - 2 * math.asin(half / radius)  # clockwise, under the axis
    return Stroke("BORE", corners, np.array([0.0, 0.0, 0.0, -math.tan(around / 4)]))


def _along(start: complex, end: complex, bulge: float) -> NDArray[np.complex128]:
    """Return points from a corner to before the next one, along an arc or a chord."""
    angle = 4 * math.atan(bulge)
    shares = np.linspace(0, 1, 1 + math.ceil(abs(math.degrees(angle)) / 2), endpoint=False)
    if shares.size <= 1:
        return np.array([start])
    centre = start + (end - start) * (0.5 + 0.5j / math.tan(angle / 2))
    return np.asarray(centre + (start - centre) * np.exp(1j * angle * shares))


def _line(layer: str, *points: tuple[float, float]) -> Stroke:
    return Stroke(layer, np.array(points), np.zeros(len(points)), is_closed=False)


def _circle(layer: str, centre: Floats, radius: float) -> Stroke:
    return Stroke(layer, centre + np.array([[radius, 0.0], [-radius, 0.0]]), np.ones(2))
