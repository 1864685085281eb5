"""The explorer of one move: rate, angle and stroke, over a reference that stays."""

from collections.abc import Sequence

import ipywidgets
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from cammotion.machine.kinematics import STANDARD_GRAVITY, Move
from cammotion.quantities import InputError
from cammotion.views.live import Explorer, LiveFigure, NumberControl
from cammotion.views.plots import CURVES, REFERENCE_STYLE, sample_curve, style_axes, style_line
from cammotion.views.scales import as_text, drawn_peak, has_ratio, round_up


class MoveExplorer(Explorer):
    """A move to be changed, over a pinned reference; made by `explore_move`."""

    def __init__(self, reference: Move) -> None:
        self.reference = reference
        self.rate = NumberControl("rate N, pieces/h", reference.rate_per_hour, 500, 5000, 50)
        self.angle = NumberControl("angle Bm, deg", reference.angle_deg, 20, 220, 1)
        self.stroke = NumberControl("stroke hm, mm", reference.stroke_mm, 5, 100, 1)
        pin = ipywidgets.Button(
            description="Pin this design as the reference", layout={"width": "19em"}
        )
        pin.on_click(lambda _: self.pin())
        figure = Figure(figsize=(8.2, 5.6), dpi=100, facecolor="white")
        figure.subplots_adjust(left=0.11, right=0.98, bottom=0.09, top=0.98, hspace=0.16)
        self._axes = self._draw_axes(figure)
        self._chosen = [style_line(ax.plot([], [])[0], 0) for ax in self._axes]
        self._pinned = [ax.plot([], [], **REFERENCE_STYLE)[0] for ax in self._axes]
        self._axes[0].legend(
            [self._chosen[0], self._pinned[0]],
            ["your design", "reference"],
            loc="lower right",
            fontsize=10,
        )
        self._show(self._pinned, reference)
        live = LiveFigure(figure, self._chosen, layout={"max_width": "100%", "width": "820px"})
        super().__init__([self.rate, self.angle, self.stroke], [pin], live)

    @property
    def move(self) -> Move:
        """The move that the controls show."""
        return Move(
            stroke_mm=self.stroke.value,
            angle_deg=self.angle.value,
            rate_per_hour=self.rate.value,
            law=self.reference.law,
        )

    def pin(self) -> None:
        """Make the present design the reference."""
        self.reference = self.move
        self._show(self._pinned, self.reference)
        self.live.redraw()
        self.update()

    def follow(self) -> str:
        """Draw the chosen move; return its peak and how it compares with the reference."""
        move = self.move
        self._show(self._chosen, move)
        self._fit(move)
        return compare(move, self.reference)

    def _draw_axes(self, figure: Figure) -> list[Axes]:
        axes: list[Axes] = list(figure.subplots(3, 1, sharex=True))
        for ax, curve in zip(axes, self._curves, strict=True):
            style_axes(ax, "", CURVES[curve].replace(" in ", "\nin "))
        last = axes[-1]
        last.set_xlabel("cam angle from the start of the move in deg", fontsize=11)
        last.set_xlim(0, self.angle.slider.max)
        last.set_xticks(np.arange(0, self.angle.slider.max + 1, 20))
        return axes

    _curves = ("displacement", "velocity", "acceleration")

    def _show(self, lines: Sequence[Line2D], move: Move) -> None:
        for line, curve in zip(lines, self._curves, strict=True):
            time, values = sample_curve(move, curve)
            line.set_data(time * (move.angle_deg / move.time_s), values)

    def _fit(self, move: Move) -> None:
        """Widen the axes to hold both designs, in coarse steps, since each costs a drawing."""
        displacement, velocity, acceleration = self._axes
        displacement.set_ylim(0, 1.05 * self.stroke.slider.max)
        both = move, self.reference
        velocity.set_ylim(0, round_up(max(_drawn_peak(one, "velocity") for one in both)))
        top = round_up(max(_drawn_peak(one, "acceleration") for one in both))
        acceleration.set_ylim(-top, top)


def explore_move(reference: Move) -> MoveExplorer:
    """Return an explorer of rate, angle and stroke, drawn over the `reference` move.

    It shows displacement, velocity and acceleration over the cam angle, the peak acceleration and
    its ratio to the reference's. `explorer.move` is the move the learner has set.

    >>> explorer = explore_move(Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000))
    >>> explorer.angle.value = 110
    >>> print(explorer.text.splitlines()[-1])
    ratio of the peaks: 0.25 = 1 (rate, squared) × 0.25 (angle, squared) × 1 (stroke)
    """
    if not isinstance(reference, Move):
        raise InputError(
            f"The reference is {reference!r}; it has to be a Move, for example "
            "Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)."
        )
    return MoveExplorer(reference)


def compare(move: Move, reference: Move) -> str:
    """Return three lines: the peak of the move, that of the reference, and what their ratio is."""
    rate = (move.rate_per_hour / reference.rate_per_hour) ** 2
    angle = (reference.angle_deg / move.angle_deg) ** 2
    stroke = move.stroke_mm / reference.stroke_mm
    peak, before = move.peak_acceleration, reference.peak_acceleration
    ratio = "none, both are infinite, because the velocity of this law jumps"
    if has_ratio(peak, before):
        ratio = (
            f"{peak / before:.4g} = {rate:.4g} (rate, squared) × {angle:.4g} (angle, squared) × "
            f"{stroke:.4g} (stroke)"
        )
    described = f"{_describe('your design', move)}\n{_describe('reference', reference)}"
    return f"{described}\nratio of the peaks: {ratio}"


def _describe(name: str, move: Move) -> str:
    a_max = move.peak_acceleration
    in_g = as_text(a_max / STANDARD_GRAVITY, ".3g")
    return f"{name}: tm = {move.time_s:.4g} s, a_max = {as_text(a_max, '.4g')} m/s² = {in_g} g"


def _drawn_peak(move: Move, curve: str) -> float:
    return drawn_peak(getattr(move, f"peak_{curve}"), sample_curve(move, curve)[1])
