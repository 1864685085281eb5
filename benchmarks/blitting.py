"""The explorer of a move as the kernel drew it until version 0.1, for comparison.

A Matplotlib figure is drawn once; at each tick its moving lines are drawn again over the stored
background, and the picture goes to the page.
"""

import io
from typing import Any

import ipywidgets
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from cammotion.machine.kinematics import Move
from cammotion.views.plots import CURVES, REFERENCE_STYLE, sample_curve, style_axes, style_line

NAMES = ("displacement", "velocity", "acceleration")
CONTROLS = {"rate": (500, 5000, 50), "angle": (20, 220, 1), "stroke": (5, 100, 1)}


class BlittedExplorer(ipywidgets.VBox):  # type: ignore[misc]
    """Three sliders, a text and a picture of the kernel's."""

    def __init__(self, reference: Move) -> None:
        self.reference = reference
        starts = reference.rate_per_hour, reference.angle_deg, reference.stroke_mm
        self.sliders = [
            ipywidgets.FloatSlider(value=start, min=low, max=high, step=step, description=name)
            for start, (name, (low, high, step)) in zip(starts, CONTROLS.items(), strict=True)
        ]
        self.figure = Figure(figsize=(8.2, 5.6), dpi=100, facecolor="white")
        self.canvas = FigureCanvasAgg(self.figure)
        self.axes = self.figure.subplots(3, 1, sharex=True)
        self.lines = [style_line(ax.plot([], [], animated=True)[0], 0) for ax in self.axes]
        for ax, name in zip(self.axes, NAMES, strict=True):
            style_axes(ax, "", CURVES[name].replace(" in ", "\nin "))
            ax.plot(*self.curve(reference, name), **REFERENCE_STYLE)
        self.axes[0].set(ylim=(0, 105), xlim=(0, 220), xticks=range(0, 221, 20))
        self.limits: tuple[float, ...] = ()
        self.said, self.image = ipywidgets.HTML(), ipywidgets.Image(format="png")
        for slider in self.sliders:
            slider.observe(lambda _: self.update(), "value")
        super().__init__([*self.sliders, self.said, self.image])
        self.update()

    def curve(self, move: Move, name: str) -> tuple[Any, Any]:
        """Return a curve of a move over the cam angle."""
        time, values = sample_curve(move, name)
        return time * (move.angle_deg / move.time_s), values

    def top(self, name: str, *moves: Move) -> float:
        """Return a coarse height that holds a curve of these moves, so that axes seldom change."""
        peak = 1.05 * max(np.abs(self.curve(move, name)[1]).max() for move in moves)
        decade = 10.0 ** np.floor(np.log10(peak))
        return float(next(step * decade for step in (1, 2, 5, 10) if step * decade >= peak))

    def update(self) -> None:
        """Draw the move of the sliders: its lines, and the rest where an axis has to change."""
        rate, angle, stroke = (slider.value for slider in self.sliders)
        move = Move(stroke_mm=stroke, angle_deg=angle, rate_per_hour=rate)
        for line, name in zip(self.lines, NAMES, strict=True):
            line.set_data(*self.curve(move, name))
        top = [self.top(name, move, self.reference) for name in NAMES[1:]]
        if self.limits != (limits := tuple(top)):
            self.limits = limits
            self.axes[1].set_ylim(0, top[0])
            self.axes[2].set_ylim(-top[1], top[1])
            self.canvas.draw()  # type: ignore[no-untyped-call]
            self.background = self.canvas.copy_from_bbox(self.figure.bbox)  # type: ignore[no-untyped-call]
        else:
            self.canvas.restore_region(self.background)  # type: ignore[no-untyped-call]
        for line in self.lines:
            self.figure.draw_artist(line)
        size = self.canvas.get_width_height(physical=True)
        pixels = self.canvas.buffer_rgba()  # type: ignore[no-untyped-call]
        png = io.BytesIO()
        picture = Image.frombuffer("RGBA", size, pixels, "raw", "RGBA", 0, 1).convert("RGB")
        picture.save(png, "png", compress_level=1)
        self.said.value = f"<div>a_max = {move.peak_acceleration:.4g} m/s²</div>"
        self.image.value = png.getvalue()
