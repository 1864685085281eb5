"""The picture of what the mechanisms ask of their camshaft: forces and torque over the turn."""

import numpy as np
from matplotlib.axes import Axes
from mpl_toolkits.axes_grid1 import make_axes_locatable  # type: ignore[import-untyped]

from cammotion.arguments import checked
from cammotion.drive.camshaft import Camshaft
from cammotion.drive.rounding import torque_rounding
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, as_text
from cammotion.views.displacement import curve_angles
from cammotion.views.lanes import (
    BEFORE_DEG,
    LANE_INCHES,
    SHARED_AXIS,
    curves_of,
    draw_lanes,
    draw_shared,
    room_inches,
    show_turn,
)
from cammotion.views.named import readable
from cammotion.views.names import add_legend, labels
from cammotion.views.pictures import blank_axes, on_paper
from cammotion.views.plots import style_axes, write
from cammotion.views.timing_plots import LEFT_INCHES, WIDTH_INCHES

_TORQUE_INCHES, _FORCES_INCHES, _PAD_INCHES = 2.27, 2.0, 0.2
_SAMPLES = 1441
_LEVELS = {"mean": "-.", "rms": ":"}
_EDGE_DEG = 60  # so near to an end of the turn a text over the peak would leave the picture


@checked
@on_paper
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
    ax = blank_axes(WIDTH_INCHES, (_TORQUE_INCHES + high + _PAD_INCHES) / 0.77)
    left = max(LEFT_INCHES, room_inches(labels([motion.name for motion in loaded])) + 0.45)
    ax.figure.subplots_adjust(left=left / WIDTH_INCHES, right=1 - 1.35 / WIDTH_INCHES)
    style_axes(ax, "cam angle in deg", "torque in N m")
    forces = make_axes_locatable(ax).append_axes("top", size=high, pad=_PAD_INCHES, sharex=ax)
    style_axes(forces, "", "force in N")
    places = np.union1d(_places(shaft), np.concatenate([*map(curve_angles, loaded)]))

    def force(motion: Motion, angles: Floats) -> Floats:
        return np.asarray(shaft.force_N(motion.name, angles))

    curves = curves_of(loaded, force, places)
    if in_lanes:
        draw_lanes(forces, curves, [0.0] * len(curves))
    else:
        draw_shared(forces, curves, is_named=True)
    _draw_torque(ax, shaft, places)
    show_turn(ax)
    forces.tick_params(axis="x", labelbottom=False)
    return ax


def _draw_torque(ax: Axes, shaft: Camshaft, places: Floats) -> None:
    torque = np.asarray(shaft.torque_N_m(places))
    ax.plot(places, torque, color="#000000", linewidth=2, label="torque")
    ax.fill_between(places, torque, color="#dddddd", zorder=1)
    ax.axhline(0, color="#000000", linewidth=0.8)
    peak = shaft.peak_torque()
    least = torque_rounding(shaft)
    levels = {"mean": shaft.mean_torque_N_m, "rms": shaft.rms_torque_N_m}
    for name, exact in levels.items():
        value = 0.0 if abs(exact) <= least else exact
        level, style = np.full(places.shape, value), _LEVELS[name]
        said = f"{name} {_newton_metres(value)}"
        ax.plot(places, level, color="#333333", linewidth=1.4, linestyle=style, label=said)
    ax.plot(peak.at_deg, peak.value, "o", color="#000000", label="_peak")
    ax.margins(y=0.2)
    at_peak = 0.0 if abs(peak.value) <= least else peak.value
    if not at_peak:
        ax.set_ylim(-1, 1)  # and no scale for what is rounding
    aside = 8 * ((peak.at_deg < _EDGE_DEG) - (peak.at_deg > DEG_PER_TURN - _EDGE_DEG))
    said = f"{_newton_metres(at_peak)} at {peak.at_deg:.4g}°"
    write(ax, said, (peak.at_deg, peak.value), offset=(aside, -16 if peak.value < 0 else 7))
    add_legend(ax, loc="upper left", bbox_to_anchor=(1, 1), frameon=False)


def _newton_metres(torque: float) -> str:
    return f"{as_text(torque, '.3g')} N m".replace("-", "−")


def _places(shaft: Camshaft) -> Floats:
    """Return cam angles, close to one another, with both sides of each place that may jump."""
    ends = np.array([span.low for span in shaft.spans][1:])
    even = np.linspace(0, DEG_PER_TURN, _SAMPLES)
    return np.union1d(even, np.concatenate([ends, ends - BEFORE_DEG]))
