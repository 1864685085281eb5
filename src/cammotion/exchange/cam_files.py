"""A cam as a file for the workshop: DXF, SVG on a scale of 1 : 1, or a table of points."""

import csv
import io
import math
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from ezdxf import units
from ezdxf.filemanagement import new as new_drawing

from cammotion.arguments import checked
from cammotion.files import ending, write_new
from cammotion.hardware.disc_cam import DiscCam
from cammotion.hardware.drawing import Stroke, strokes
from cammotion.hardware.flat_faced_cam import FlatFacedCam
from cammotion.hardware.outline import TOLERANCE, chords_along
from cammotion.hardware.prime_circle import smallest_base_radius, smallest_prime_radius
from cammotion.hardware.roller_cam import RollerCam
from cammotion.quantities import Floats, InputError

_COLOURS = {  # of each layer: AutoCAD's number, and what SVG writes
    "PROFILE": (7, "black"),
    "PITCH_CURVE": (5, "blue"),
    "FOLLOWER": (3, "green"),
    "CENTRE": (8, "gray"),
    "ZERO_MARK": (1, "red"),
    "ROTATION": (1, "red"),
    "BORE": (7, "black"),
}
_EDGE_MM, _LINE_MM = 5.0, 0.25
_FINE_MM = 0.01  # of a radius that is said to be enough
_TABLES = {".csv": ",", ".txt": "\t"}


@checked
def write_cam(  # noqa: PLR0913 - what a workshop may ask for
    cam: DiscCam,
    path: str | Path,
    *,
    tolerance_mm: float = 0.001,
    groove: bool = False,
    bore_mm: float | None = None,
    keyway_mm: tuple[float, float] | None = None,
    undercut: bool = False,
    overwrite: bool = False,
) -> Path:
    """Write a cam to a file that ends in .dxf, .svg, .csv or .txt, and return its path.

    All lengths are in mm, the cam's axis is the origin, and 0 deg of cam angle points up, along y.
    The outline misses the exact profile by at most `tolerance_mm`. It is a closed line of arcs in
    DXF and SVG, which have layers for the profile, the pitch curve, the follower at 0 deg, the
    centre, the zero mark and the sense of rotation; with `groove` the far flank is drawn too, with
    `bore_mm` a bore of that diameter, and with `keyway_mm` (width, height over the bore) its
    keyway, at 0 deg. The tables list profile and pitch curve alone, in as many points as chords
    need.

    Nothing is written for a cam whose profile is undercut, unless `undercut` says that you want it,
    nor over a file that is there already, unless `overwrite` does. Raises InputError.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(10), prime_radius_mm=160)
    >>> with TemporaryDirectory() as folder:
    ...     file = write_cam(cam, f"{folder}/die.csv", tolerance_mm=0.01)
    ...     for line in file.read_text().splitlines()[:2]:
    ...         print(line)
    cam angle in deg,x in mm,y in mm,pitch curve x in mm,pitch curve y in mm
    0.0,0.0,150.0,0.0,160.0
    """
    tolerance = TOLERANCE.number(tolerance_mm)
    kind = ending(path, "cam", [*_DRAWINGS, *_TABLES])
    is_bored = bore_mm is not None or keyway_mm is not None
    _check_wishes(cam, kind, groove=groove, bore=is_bored)
    if not undercut:
        _refuse_undercut(cam, groove=groove)
    if kind in _TABLES:
        return write_new(path, _table(cam, tolerance, _TABLES[kind]), overwrite=overwrite)
    drawn = strokes(cam, tolerance, groove=groove, bore_mm=bore_mm, keyway_mm=keyway_mm)
    return write_new(path, _DRAWINGS[kind]([*drawn]), overwrite=overwrite)


def _check_wishes(cam: DiscCam, kind: str, *, groove: bool, bore: bool) -> None:
    """Raise InputError for what would be left out of the file."""
    if groove and not isinstance(cam, RollerCam):
        raise InputError(
            "A groove is asked for, and this cam has a flat face, which runs in none: leave groove "
            "out, or give a RollerCam."
        )
    if kind in _TABLES and (groove or bore):
        raise InputError(
            f"A {kind} lists the profile and the pitch curve, and neither a far flank nor a bore: "
            "leave groove, bore_mm and keyway_mm out, or let the name end in .dxf or .svg."
        )


def _refuse_undercut(cam: DiscCam, *, groove: bool) -> None:
    cuts = [*map(str, cam.undercuts)]
    if isinstance(cam, RollerCam):
        cuts += [f"the far flank: {cut}" for cut in cam.outer_undercuts if groove]
        cuts += [
            f"the cutter takes the profile away from {start:.5g} to {end:.5g} deg"
            for flank in (False, True)[: 1 + groove]
            for start, end in cam.cut_away(outer=flank)
        ]
    if cuts:
        raise InputError(
            f"Nothing was written: {cuts[0]}. Give {_enough(cam, groove=groove)}, or undercut=True "
            "if you want the file all the same."
        )


def _enough(cam: DiscCam, *, groove: bool) -> str:
    """Return in words what cam of this motion would have no undercut; of a groove no number."""
    if isinstance(cam, FlatFacedCam):
        return f"a base circle of at least {_rounded_up(smallest_base_radius(cam.motion))} mm"
    if isinstance(cam, RollerCam) and cam.undercuts and not groove:
        with suppress(InputError):  # an arm may reach none
            least = smallest_prime_radius(cam.motion, cam.follower, pressure_angle_deg=90)
            return f"a prime circle of at least {_rounded_up(least)} mm, or a smaller roller"
    return "a larger prime circle, or a smaller roller"


def _rounded_up(mm: float) -> str:
    return f"{math.ceil(mm / _FINE_MM) * _FINE_MM:.8g}"


def _as_dxf(drawn: Iterable[Stroke]) -> str:
    drawing = new_drawing("R2000", units=units.MM)
    for layer, (colour, _) in _COLOURS.items():
        drawing.layers.add(layer, color=colour)
    for stroke in drawn:
        corners = np.column_stack([stroke.points_mm, stroke.bulges]).tolist()
        drawing.modelspace().add_lwpolyline(
            corners, format="xyb", close=stroke.is_closed, dxfattribs={"layer": stroke.layer}
        )
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue()


def _as_svg(drawn: Iterable[Stroke]) -> str:
    drawn = [*drawn]
    every = np.concatenate([stroke.points_mm for stroke in drawn])
    reach = float(np.abs(every).max()) + _EDGE_MM
    paths = "\n".join(
        f'<path class="{stroke.layer}" d="{_path(stroke)}" stroke="{_COLOURS[stroke.layer][1]}"/>'
        for stroke in drawn
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{2 * reach:.6g}mm" '
        f'height="{2 * reach:.6g}mm" viewBox="{-reach:.6g} {-reach:.6g} {2 * reach:.6g} '
        f'{2 * reach:.6g}">\n<title>A cam on a scale of 1 : 1, in mm</title>\n'
        f'<g fill="none" stroke-width="{_LINE_MM}" transform="scale(1 -1)">\n{paths}\n</g>\n'
        "</svg>\n"
    )


def _path(stroke: Stroke) -> str:
    """Return the path of a stroke; its bulges become arcs of circles."""
    ends = np.roll(stroke.points_mm, -1, axis=0)
    count = len(ends) if stroke.is_closed else len(ends) - 1
    said = ["M {:.6f} {:.6f}".format(*stroke.points_mm[0])]
    parts = zip(stroke.points_mm, ends[:count], stroke.bulges, strict=False)
    for start, end, bulge in parts:
        radius = np.hypot(*(end - start)) * (1 + bulge**2) / (4 * abs(bulge)) if bulge else 0.0
        arc = f"A {radius:.6f} {radius:.6f} 0 {int(abs(bulge) > 1)} {int(bulge > 0)}"
        said.append(f"{arc if bulge else 'L'} {end[0]:.6f} {end[1]:.6f}")
    return " ".join([*said, *["Z"] * stroke.is_closed])


def _table(cam: DiscCam, tolerance: float, separator: str) -> str:
    outline = chords_along(cam.profile_mm, cam.motion, tolerance)
    order = np.argsort(outline.angles_deg)
    angles = outline.angles_deg[order]
    columns: dict[str, Floats] = {"cam angle in deg": angles}
    curves: dict[str, Callable[[Any], Floats]] = {"": cam.profile_mm}
    if isinstance(cam, RollerCam):
        curves["pitch curve "] = cam.pitch_mm
    for name, curve in curves.items():
        columns |= {f"{name}{axis} in mm": curve(angles)[:, i] for i, axis in enumerate("xy")}
    text = io.StringIO()
    writer = csv.writer(text, delimiter=separator, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows((np.column_stack([*columns.values()]).round(6) + 0.0).tolist())
    return text.getvalue()


_DRAWINGS: dict[str, Callable[[Iterable[Stroke]], str]] = {".dxf": _as_dxf, ".svg": _as_svg}
