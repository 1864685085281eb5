"""The explorer's figure as `interact` and inline figures would show it, for comparison."""

from typing import Any

import ipywidgets
import matplotlib.pyplot as plt

from cammotion.machine.kinematics import Move
from cammotion.views.plots import CURVES, REFERENCE_STYLE, sample_curve, style_axes, style_line


def interact_with(reference: Move) -> Any:
    """Show what `explore_move` shows; return the function whose `widget` holds the sliders."""

    def draw(rate: float, angle: float, stroke: float) -> None:
        move = Move(stroke_mm=stroke, angle_deg=angle, rate_per_hour=rate)
        draw_figure(move, reference)
        for name, design in (("your design", move), ("reference", reference)):
            print(
                f"{name}: tm = {design.time_s:.4g} s, a_max = {design.peak_acceleration:.4g} m/s²"
            )
        print(f"ratio of the peaks: {move.peak_acceleration / reference.peak_acceleration:.4g}")

    return ipywidgets.interact(
        draw,
        rate=ipywidgets.FloatSlider(reference.rate_per_hour, min=500, max=5000, step=50),
        angle=ipywidgets.FloatSlider(reference.angle_deg, min=20, max=220, step=1),
        stroke=ipywidgets.FloatSlider(reference.stroke_mm, min=5, max=100, step=1),
    )


def draw_figure(move: Move, reference: Move) -> None:
    """Draw displacement, velocity and acceleration of both moves, in the explorer's size."""
    _, axes = plt.subplots(
        3, 1, sharex=True, figsize=(8.2, 5.6), dpi=100, facecolor="white", layout="constrained"
    )
    for ax, curve in zip(axes, ("displacement", "velocity", "acceleration"), strict=True):
        style_axes(ax, "", CURVES[curve].replace(" in ", "\nin "))
        for design, style in ((move, {"label": "your design"}), (reference, REFERENCE_STYLE)):
            time, values = sample_curve(design, curve)
            (line,) = ax.plot(time * (design.angle_deg / design.time_s), values, **style)
            if design is move:
                style_line(line, 0)
    axes[0].legend(["your design", "reference"], loc="lower right", fontsize=10)
    axes[-1].set_xlabel("cam angle from the start of the move in deg", fontsize=11)
    axes[-1].set(xlim=(0, 220), xticks=range(0, 221, 20))
    plt.show()
