"""A disc cam as a designer draws it: axis, prime circle, follower, rotation, dimensions."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, PathPatch
from matplotlib.path import Path

from cammotion.arguments import checked
from cammotion.hardware.drawing import strokes
from cammotion.hardware.flat_faced_cam import FlatFacedCam
from cammotion.hardware.roller_cam import RollerCam
from cammotion.quantities import as_text
from cammotion.views.pictures import on_paper
from cammotion.views.plots import COLOURS, styled, write

_TOLERANCE_MM = 0.01
_THIN: dict[str, Any] = {"edgecolor": "#555555", "linewidth": 1.0}
_STYLES: dict[str, dict[str, Any]] = {
    "PROFILE": {"facecolor": "#dbe9f4", "edgecolor": COLOURS[0], "linewidth": 2},
    "PITCH_CURVE": _THIN | {"linestyle": (0, (10, 3, 2, 3))},
    "FOLLOWER": {"edgecolor": COLOURS[1], "linewidth": 2},
    "CENTRE": _THIN | {"linestyle": (0, (10, 3, 2, 3)), "linewidth": 0.8},
    "ZERO_MARK": {"edgecolor": "#b3200e", "linewidth": 1.5},
    "ROTATION": {"edgecolor": "#000000", "linewidth": 1.2},
    "BORE": {"edgecolor": COLOURS[0], "linewidth": 1.5},
}
_NAMES = {"PITCH_CURVE": "pitch curve", "FOLLOWER": "follower"}
_SIZE_IN = 5.2
_STEM = 0.75  # of the follower over the roller, as a share of the travel


@checked
@on_paper
def plot_cam(
    cam: RollerCam | FlatFacedCam, *, bore_mm: float | None = None, ax: Axes | None = None
) -> Axes:
    """Draw a disc cam at 0 deg with its follower, in mm about its axis; return the Axes.

    With the profile are the pitch curve, the prime or base circle with its radius, the roller or
    the face, the mark of 0 deg, the sense of rotation, and a bore of `bore_mm`. Where the profile
    is undercut, it is drawn with the loops that no cutter leaves. Raises InputError for what is no
    cam, and for a bore that it has no room for.

    >>> import cammotion as cm
    >>> cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(10), prime_radius_mm=160)
    >>> plot_cam(cam).get_xlabel()
    'x in mm'
    """
    drawn = [*strokes(cam, _TOLERANCE_MM, bore_mm=bore_mm)]
    ax = styled(ax, "x in mm", "y in mm", (_SIZE_IN, _SIZE_IN), layout="constrained")
    ax.grid(visible=False)
    for stroke in drawn:
        name = _profile(cam) if stroke.layer == "PROFILE" else _NAMES.get(stroke.layer)
        style = {"facecolor": "none", "label": name} | _STYLES[stroke.layer]
        ax.add_patch(PathPatch(Path(stroke.filled()), **style))
    _circle(ax, cam)
    _stem(ax, cam)
    ax.set_aspect("equal")
    ax.margins(0.06)
    ax.autoscale_view()
    return ax


def _profile(cam: RollerCam | FlatFacedCam) -> str:
    """Return what a profile is called, with the cam angles of its undercuts."""
    undercuts = [f"from {each.start_deg:.5g} to {each.end_deg:.5g} deg" for each in cam.undercuts]
    return f"cam, undercut {' and '.join(undercuts)}" if undercuts else "cam"


def _circle(ax: Axes, cam: RollerCam | FlatFacedCam) -> None:
    """Draw the prime or base circle, and write its radius beside it."""
    if isinstance(cam, FlatFacedCam):
        name, radius = "base circle", cam.base_radius_mm
    else:
        name, radius = "prime circle", cam.prime_radius_mm
    size = as_text(radius, ".4g")
    ax.add_patch(
        Circle((0, 0), radius, fill=False, linestyle="--", **_THIN, label=f"{name} {size} mm")
    )
    place = radius * np.array([-np.sqrt(0.5), -np.sqrt(0.5)])
    write(ax, f"{name} R {size}", (place[0], place[1]), _THIN["edgecolor"], offset=(4, -4))


def _stem(ax: Axes, cam: RollerCam | FlatFacedCam) -> None:
    """Draw the slide or the arm, and name the roller."""
    low, high = cam.motion.range_mm
    if isinstance(cam, FlatFacedCam):
        foot = 0.0, cam.base_radius_mm + float(cam.lift(0).lift)
        ax.plot([0, 0], [foot[1], foot[1] + _STEM * (high - low)], color=COLOURS[1], linewidth=2)
    else:
        x, y = cam.pitch_mm(0).tolist()
        ends = cam.follower.body(complex(x, y), _STEM * (high - low))
        places = [end.real for end in ends], [end.imag for end in ends]
        ax.plot(*places, color=COLOURS[1], linewidth=2)
        ax.plot(x, y, "+", color=COLOURS[1])
        write(
            ax,
            f"roller r {as_text(cam.roller_radius_mm, '.4g')}",
            (x + cam.roller_radius_mm, y),
            COLOURS[1],
            (4, 2),
        )
