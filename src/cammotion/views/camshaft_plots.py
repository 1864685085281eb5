"""The picture of what the mechanisms ask of their camshaft: forces and torque over the turn."""

from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.axes_grid1 import make_axes_locatable  # type: ignore[import-untyped]

from cammotion.arguments import checked
from cammotion.drive.camshaft import Camshaft
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError
from cammotion.views.lanes import (
    LANE_INCHES,
    SHARED_AXIS,
    curves_of,
    draw_lanes,
    draw_shared,
    room_inches,
)
from cammotion.views.named import readable
from cammotion.views.names import add_legend, labels
from cammotion.views.pictures import blank_axes
from cammotion.views.plots import style_axes, write
from cammotion.views.timing_plots import LEFT_INCHES, TICK_DEG, WIDTH_INCHES

_TORQUE_INCHES, _FORCES_INCHES, _EDGES_INCHES = 2.6, 2.0, 1.2
_SAMPLES = 1441
_BEFORE_DEG = 1e-6  # so near before a jump is just before it
_LEVELS = {"mean": "-.", "rms": ":"}


@checked
def plot_camshaft(shaft: Camshaft) -> Axes:
    """Draw what a camshaft has to give over the turn, and return the Axes of the torque.

    The torque is in N m over the cam angle in deg, with its peak, its mean and its root mean
    square; above 0 the shaft drives. Over it is the force in N on each mechanism that has a load,
    on one scale, or for more than four in a lane each with its range beside it. Raises InputError
    for a camshaft without loads, and for more than 24 mechanisms.

    >>> import cammotion as cm
    >>> shaft = cm.Camshaft(cm.EXAMPLE.diagram, {"die": cm.FollowerLoad(mass_kg=12)})
    >>> plot_camshaft(shaft).get_ylabel()
    'torque in N m'
    """
    diagram = readable(shaft.diagram)
    names = {diagram[name].name for name in shaft.loads}  # given in any case
    loaded = [motion for motion in diagram.motions if motion.name in names]
    if not loaded:
        raise InputError(
            "The camshaft has no loads, and so no forces and no torque to draw: give some, for "
            "example loads={'die': FollowerLoad(mass_kg=12)}."
        )
    in_lanes = len(loaded) > SHARED_AXIS
    high = LANE_INCHES * len(loaded) if in_lanes else _FORCES_INCHES
    ax = blank_axes(WIDTH_INCHES, _TORQUE_INCHES + high + _EDGES_INCHES)
    left = max(LEFT_INCHES, room_inches(labels([motion.name for motion in loaded])) + 0.45)
    ax.figure.subplots_adjust(left=left / WIDTH_INCHES, right=1 - 1.35 / WIDTH_INCHES)
    style_axes(ax, "cam angle in deg", "torque in N m")
    forces = make_axes_locatable(ax).append_axes("top", size=high, pad=0.2, sharex=ax)
    style_axes(forces, "", "force in N")
    places = _places(shaft)

    def force(motion: Motion, angles: Floats) -> Floats:
        return np.asarray(shaft.force_N(motion.name, angles))

    curves = [
        replace(curve, angles=places, values=force(curve.motion, places))
        for curve in curves_of(loaded, force)
    ]
    if in_lanes:
        draw_lanes(forces, curves, [0.0] * len(curves))
    else:
        draw_shared(forces, curves, is_named=True)
    _draw_torque(ax, shaft, places)
    ax.set_xlim(0, DEG_PER_TURN)
    ax.set_xticks(range(0, DEG_PER_TURN + 1, TICK_DEG))
    forces.tick_params(axis="x", labelbottom=False)
    return ax


def _draw_torque(ax: Axes, shaft: Camshaft, places: Floats) -> None:
    torque = np.asarray(shaft.torque_N_m(places))
    ax.plot(places, torque, color="#000000", linewidth=2, label="torque")
    ax.fill_between(places, torque, color="#dddddd", zorder=1)
    ax.axhline(0, color="#000000", linewidth=0.8)
    levels = {"mean": shaft.mean_torque_N_m, "rms": shaft.rms_torque_N_m}
    for name, value in levels.items():
        said = f"{name} {0.0 if abs(value) < 1e-9 else value:.3g} N m"  # noqa: PLR2004 - rounding
        level, style = np.full(places.shape, value), _LEVELS[name]
        ax.plot(places, level, color="#333333", linewidth=1.4, linestyle=style, label=said)
    peak = shaft.peak_torque()
    ax.plot(peak.at_deg, peak.value, "o", color="#000000", label="_peak")
    ax.margins(y=0.2)
    below = peak.value < 0
    where = min(max(peak.at_deg, 30.0), DEG_PER_TURN - 30.0)
    said = f"{peak.value:.3g} N m at {peak.at_deg:.4g}°".replace("-", "−")
    write(ax, said, (where, peak.value), offset=(0, -16 if below else 7))
    add_legend(ax, loc="upper left", bbox_to_anchor=(1, 1), frameon=False)


def _places(shaft: Camshaft) -> Floats:
    """Return cam angles, close to one another, with both sides of each place that may jump."""
    ends = np.array([span.low for span in shaft.spans][1:])
    even = np.linspace(0, DEG_PER_TURN, _SAMPLES)
    return np.union1d(even, np.concatenate([ends, ends - _BEFORE_DEG]))
