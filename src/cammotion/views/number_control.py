"""A slider and a number field for one value, which the setup of notebook 00 shows."""

import math
from typing import Any

import ipywidgets
import numpy as np

from cammotion.quantities import Quantity


class NumberControl(ipywidgets.HBox):  # type: ignore[misc]
    """A slider and a number field for one `value`.

    The field holds the value: any of the range, also between the slider's steps. The slider stands
    at the nearest step. The field also gives the pair the name that a screen reader reads. Raises
    InputError for what is no number, and for a step that is not above 0.
    """

    def __init__(self, name: str, value: float, low: float, high: float, step: float) -> None:
        ends = {"value": value, "low end": low, "high end": high}
        value, low, high = (
            Quantity(f"{what} of a control", "", example=5, low=-math.inf).number(given)
            for what, given in ends.items()
        )
        step = Quantity("step of a control", "", example=1).number(step)
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
            self.field.value = float(f"{self.slider.value:.12g}")  # 0.3, not 0.30000000000000004

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        bundle: dict[str, Any] = super()._repr_mimebundle_(**kwargs)
        return bundle | {"text/plain": f"{self._name}: {self.value:g}"}
