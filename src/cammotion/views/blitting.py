"""Live figures and their controls: what follows the learner's hand; `explorers` are made of them.

A live figure is drawn once. While a slider moves, only its moving artists are drawn again over the
stored background (blitting), which is fast enough to follow the hand. Its picture and its text are
kept beside the widget, so that a reader without a running kernel sees them too.
"""

import base64
import io
from collections.abc import Callable, Sequence
from html import escape
from typing import Any

import ipywidgets
import numpy as np
from matplotlib.artist import Artist
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image


class LiveFigure(ipywidgets.Image):  # type: ignore[misc]
    """A figure of which only the `moving` artists are drawn again at each `refresh`.

    The first `refresh` draws it whole. A change of axis limits is noticed and costs one full
    drawing. Call `redraw` after any other change of what does not move.
    """

    def __init__(self, figure: Figure, moving: Sequence[Artist], **layout: Any) -> None:
        super().__init__(format="png", **layout)
        self._figure, self._moving = figure, list(moving)
        self._canvas = FigureCanvasAgg(figure)
        self._limits: list[tuple[float, ...]] = []
        self._background: Any = None
        for artist in self._moving:
            artist.set_animated(True)

    def redraw(self) -> None:
        """Draw the whole figure."""
        self._limits = self._current_limits()
        self._canvas.draw()  # type: ignore[no-untyped-call]
        self._background = self._canvas.copy_from_bbox(self._figure.bbox)  # type: ignore[no-untyped-call]
        self._draw_moving()

    def refresh(self) -> None:
        """Draw the moving artists, and the rest only if an axis has changed its limits."""
        if self._limits != self._current_limits():
            self.redraw()
        else:
            self._canvas.restore_region(self._background)  # type: ignore[no-untyped-call]
            self._draw_moving()

    def _current_limits(self) -> list[tuple[float, ...]]:
        return [(*ax.get_xlim(), *ax.get_ylim()) for ax in self._figure.axes]

    def _draw_moving(self) -> None:
        for artist in self._moving:
            self._figure.draw_artist(artist)
        size = self._canvas.get_width_height(physical=True)
        pixels = self._canvas.buffer_rgba()  # type: ignore[no-untyped-call]
        picture = Image.frombuffer("RGBA", size, pixels, "raw", "RGBA", 0, 1)
        png = io.BytesIO()
        picture.convert("RGB").save(png, "png", compress_level=1)  # 1: speed before size
        self.value = png.getvalue()


class NumberControl(ipywidgets.HBox):  # type: ignore[misc]
    """A slider and a number field for one `value`.

    The field holds the value: any of the range, also between the slider's steps. The slider stands
    at the nearest step. The field also gives the pair the name that a screen reader reads.
    """

    def __init__(self, name: str, value: float, low: float, high: float, step: float) -> None:
        self.default = value
        span = {"value": value, "min": min(low, value), "max": max(high, value)}
        self.field = ipywidgets.BoundedFloatText(
            **span,
            description=name,
            style={"description_width": "11.5em"},
            layout={"width": "19em"},
        )
        self.slider = ipywidgets.FloatSlider(
            **span, step=step, readout=False, layout={"width": "22em"}
        )
        self._name = name
        self._follow_field()
        self.field.observe(lambda _: self._follow_field(), "value")
        self.slider.observe(lambda _: self._follow_slider(), "value")
        super().__init__([self.field, self.slider], layout={"flex_flow": "row wrap"})

    @property
    def value(self) -> float:
        """The value that the field shows."""
        return float(self.field.value)

    @value.setter
    def value(self, value: float) -> None:
        self.field.value = value

    def on_change(self, callback: Callable[[], None]) -> None:
        """Call `callback` whenever the value has changed."""
        self.field.observe(lambda _: callback(), "value")

    def _nearest_step(self) -> float:
        """Return where the slider stands for the field's value."""
        slider = self.slider
        steps = np.floor((self.value - slider.min) / slider.step + 0.5)
        return float(min(slider.min + steps * slider.step, slider.max))

    def _follow_field(self) -> None:
        self.slider.value = self._nearest_step()

    def _follow_slider(self) -> None:
        """Take the slider's value, unless it only stands at the step nearest to the field's."""
        if not np.isclose(self.slider.value, self._nearest_step()):
            self.field.value = self.slider.value

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        bundle: dict[str, Any] = super()._repr_mimebundle_(**kwargs)
        return bundle | {"text/plain": f"{self._name}: {self.value:g}"}


class Explorer(ipywidgets.VBox):  # type: ignore[misc]
    """Controls, a live figure and a text, shown as one; subclasses say what follows what.

    A subclass makes its controls and its figure, calls this constructor, and overrides `follow`,
    which moves the artists and returns the text.
    """

    def __init__(
        self, controls: Sequence[NumberControl], buttons: Sequence[Any], live: LiveFigure
    ) -> None:
        self.controls, self.live = list(controls), live
        self.text = ""
        self._shown_text = ipywidgets.HTML()
        for control in controls:
            control.on_change(self.update)
        super().__init__([*controls, *buttons, self._shown_text, live])
        self.update()

    def follow(self) -> str:
        """Move the artists to the controls' values and return what there is to say, one a line."""
        raise NotImplementedError

    def update(self) -> None:
        """Bring figure and text in line with the controls."""
        self.text = self.follow()
        self.live.refresh()
        lines = "".join(f"<div>{escape(line)}</div>" for line in self.text.splitlines())
        self._shown_text.value = f'<div role="status" style="line-height: 1.5">{lines}</div>'

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        """Show picture and text beside the widget, for a reader without a kernel."""
        bundle: dict[str, Any] = super()._repr_mimebundle_(**kwargs)
        picture = base64.b64encode(self.live.value).decode("ascii")
        return bundle | {"image/png": picture, "text/plain": self.text}
