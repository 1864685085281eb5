"""Pictures of a follower that swings: what a law leaves behind, what the masses do in a turn."""

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import FuncFormatter
from numpy.typing import ArrayLike

from cammotion.arguments import checked
from cammotion.dynamics.residual import (
    RATIO,
    dynamic_factor,
    residual_vibration,
    running_factor,
    running_residual,
)
from cammotion.dynamics.response import MoveResponse, Response, StartResponse, SteadyResponse
from cammotion.laws.catalogue import LAWS
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import Floats, InputError, Quantity, one_of
from cammotion.views.displacement import within_short_moves
from cammotion.views.ends import label_ends
from cammotion.views.law_plots import as_laws
from cammotion.views.names import add_legend_below, as_label, labels
from cammotion.views.pictures import on_paper
from cammotion.views.plots import style_line, styled

QUANTITIES = {
    "residual": "swing after the move / stroke",
    "worst": "largest swing at this tm/Tn or above / stroke",
    "factor": "peak acceleration, mass / cam",
}
_MASS = Quantity("number of a mass", "", example=1)
_RATIOS = np.linspace(0.02, 8, 400)
_FLOOR = 1e-4  # of the stroke, where the logarithmic axis begins
_PLACES = 1441  # of a turn
_AFTER = 1.5  # indexing times after a move
_BEYOND, _FINE = 4.0, 0.01  # how far above all tm/Tn the worst is looked for, and how finely


@checked
@on_paper
def plot_residual(  # noqa: PLR0913 - all but the laws are given by name
    laws: str | MotionLaw | Iterable[str | MotionLaw] | None = None,
    *,
    ratios: ArrayLike | None = None,
    damping_ratio: float = 0.0,
    quantity: str = "residual",
    motion: Motion | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw for each law how far a mass swings after its move, over tm/Tn, and return the Axes.

    `laws` are laws or their names, all of the catalogue whose velocity does not jump unless given;
    `ratios` are tm/Tn, from 0.02 to 8. With the `quantity` "worst" it is the largest swing at that
    ratio or any above it, up to 4 above the largest of all, so that no curve has a zero on which
    nobody can rely; with "factor" it is the peak acceleration of the mass during the move over the
    cam's. With a `motion` it is the machine that has run for long, each law in turn being that of
    all its moves; else a single move. Raises InputError as `residual_vibration` and
    `running_residual` do.

    >>> plot_residual(["cycloidal", "modified sine"]).get_xlabel()
    'tm/Tn, swings of the mass during the move'
    """
    drawn = as_laws([*LAWS] if laws is None else laws)
    at = _RATIOS if ratios is None else np.sort(np.ravel(RATIO.array(ratios)))
    quantity = one_of("quantity", quantity, QUANTITIES)
    if quantity == "worst" and motion is not None:
        raise InputError(
            "The quantity 'worst' is that of a single move; in a running machine it would be that "
            "of a resonance: leave the motion out, or ask for the 'residual'."
        )
    across = "tm/Tn, swings of the mass during the move"
    swings = [_values(law, at, quantity, damping_ratio, motion) for law in drawn]
    ax = styled(ax, across, QUANTITIES[quantity], (8.6, 5.2), layout="constrained")
    ends, lines = [], []
    for number, (law, values) in enumerate(zip(drawn, swings, strict=True)):
        line = style_line(ax.plot(at, values, label=as_label(law.name))[0], number)
        line.set(linewidth=1.6, marker="o" if at.size == 1 else "None")
        lines.append(line)
        late = values[at >= at[0] + 0.85 * (at[-1] - at[0])]
        ends.append(float(late.max()))
    if quantity != "factor":
        ax.set_yscale("log")
        ax.set_ylim(_FLOOR, 2 if motion is None else None)
        ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.set_xlim(0, at[-1])
    label_ends(ax, lines, ends, labels([law.name for law in drawn]))
    return ax


def _values(
    law: MotionLaw, at: Floats, quantity: str, damping_ratio: float, motion: Motion | None
) -> Floats:
    if quantity == "worst":
        fine = np.arange(at.min(), at.max() + _BEYOND, _FINE)
        swings = np.asarray(residual_vibration(law, fine, damping_ratio))
        return np.interp(at, fine, np.maximum.accumulate(swings[::-1])[::-1])
    if motion is None:
        single = residual_vibration if quantity == "residual" else dynamic_factor
        return np.asarray(single(law, at, damping_ratio))
    running = running_residual if quantity == "residual" else running_factor
    return np.asarray(running(motion.with_law(law), at, damping_ratio))


@checked
@on_paper
def plot_response(
    response: Response,
    *,
    over: tuple[float, float] | None = None,
    masses: Sequence[int] | None = None,
    ax: Axes | None = None,
) -> Axes:
    """Draw the accelerations of the cam and of the masses of a `response`; return the Axes.

    `over` is from where to where, in s after the beginning of a move or in deg of cam angle; the
    turn unless given, or the move and half as long again after it. `masses` are numbers, 1 at the
    cam; all unless given. Raises InputError as the response does.

    >>> import cammotion as cm
    >>> die = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    >>> plot_response(cm.MoveResponse(cm.tuned_mass(12, 0.02), die)).get_ylabel()
    'acceleration in m/s²'
    """
    is_move = isinstance(response, MoveResponse)
    low, high = response.span if over is None else over
    if is_move and over is None:
        high *= 1 + _AFTER
    if not low < high:
        raise InputError(
            f"The response is to be drawn over {low:g} to {high:g}: give where to begin first, for "
            f"example over={'(0, 0.3)' if is_move else '(90, 270)'}."
        )
    across = "time t in s" if is_move else "cam angle in deg"
    at = _places(response, low, high)
    count = len(response.chain.masses_kg)
    asked = range(1, count + 1) if masses is None else masses
    numbers: list[Any] = _MASS.array(asked).ravel().tolist()
    drawn = {number: np.asarray(response.acceleration(at, number)) for number in numbers}
    ax = styled(ax, across, "acceleration in m/s²", (8.6, 4.4), layout="constrained")
    for number, values in sorted(drawn.items(), reverse=True):  # the last swings most: lies below
        name = "mass" if count == 1 else f"mass {number:g}"
        style_line(ax.plot(at, values, label=name)[0], int(number)).set_linewidth(1.6)
    cam = np.asarray(response.cam_acceleration(at))
    ax.plot(at, cam, label="cam", color="#000000", linewidth=1.4)
    ax.axhline(0, color="#000000", linewidth=0.8)
    ax.margins(x=0)
    add_legend_below(ax, 4)
    return ax


def _places(response: Response, low: float, high: float) -> Floats:
    """Return times or cam angles close enough for a curve, also of a move that is short."""
    even = np.linspace(low, high, _PLACES)
    if not isinstance(response, StartResponse | SteadyResponse):
        return even
    turns = np.arange(low // DEG_PER_TURN, high // DEG_PER_TURN + 1) * DEG_PER_TURN
    in_turn = np.mod(within_short_moves(response.motion), DEG_PER_TURN)
    own = np.add.outer(turns, in_turn).ravel()
    return np.union1d(even, own[(own > low) & (own < high)])
