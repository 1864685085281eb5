"""A live figure in a notebook: a widget that carries its own description, picture and text."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import anywidget
import numpy as np
import sympy as sp
import traitlets

from cammotion.files import ending, write_new
from cammotion.quantities import InputError, shorten
from cammotion.views.live import page
from cammotion.views.live.describe import Describer, Description
from cammotion.views.live.parts import Choice
from cammotion.views.live.picture import draw
from cammotion.views.pictures import as_bundle

MIME = "application/vnd.cammotion.figure"  # holds JSON as text, one line of a stored notebook
CLOCK = 0.0  # of the variable's range: where the cursor stands at first; tests set another


class LiveFigure(anywidget.AnyWidget):
    """Curves under the reader's hand; made by `explore`.

    `values` are the settings, by their symbols: they follow the reader's hand, and can be set.
    `text` is what the sentences say with them. `save` writes a page that lives without a kernel.
    """

    _esm = page.module()
    _css = page.style()
    description = traitlets.Dict().tag(sync=True)
    settings = traitlets.List(traitlets.CFloat()).tag(sync=True)
    pinned = traitlets.List(traitlets.CFloat()).tag(sync=True)

    def __init__(self, describer: Describer, description: Description) -> None:
        self._symbols, self._formulas = describer.symbols, describer.formulas
        start = [control["start"] for control in description["controls"]]
        super().__init__(description=description, settings=start, pinned=start)
        self._check_drawn()

    @property
    def values(self) -> dict[sp.Symbol, float]:
        """What each control is set to, by its symbol; of a choice the number of the name.

        Setting some of them moves the figure too. Raises InputError for a symbol that is no control
        of the figure, and for a value outside its range.

        >>> import sympy as sp
        >>> import cammotion as cm
        >>> t, B_m = sp.symbols("t B_m")
        >>> figure = cm.explore(sp.sin(B_m * t), (t, 0, 1), {B_m: (20, 220)})
        >>> figure.values = {B_m: 110}
        >>> figure.values
        {B_m: 110.0}
        """
        return dict(zip(self._symbols, self.settings, strict=True))

    @values.setter
    def values(self, values: Mapping[sp.Symbol, float]) -> None:
        changes = {}
        if not isinstance(values, Mapping):
            raise InputError(
                f"The values are {shorten(values)}: give a mapping from controls to numbers."
            )
        for symbol, value in values.items():
            if symbol not in self._symbols:
                known = ", ".join(map(str, self._symbols))
                raise InputError(
                    f"{shorten(symbol)} is no control of this figure: set one of the symbols "
                    f"{known}."
                )
            number = self._symbols.index(symbol)
            changes[number] = self._checked(number, value)
        self._change(changes)

    @property
    def chosen(self) -> dict[str, str]:
        """The chosen name of each choice, by what the choice is called."""
        return {
            symbol.name: symbol.options[int(value)]
            for symbol, value in self.values.items()
            if isinstance(symbol, Choice)
        }

    @property
    @np.errstate(all="ignore")
    def text(self) -> str:
        """The figure's sentences with its present numbers, one a line."""
        now, clock = self._now, self._clock
        said = []
        for alternatives in self.description["sentences"]:
            for one in alternatives:
                if one["when"] is None or bool(now[one["when"]](clock)):
                    said.append(
                        "".join(self._written(piece, now, clock) for piece in one["pieces"])
                    )
                    break
        return "\n".join(line for line in said if line)

    @np.errstate(all="ignore")
    def press(self, text: str) -> None:
        """Press the button with that text, as the reader would.

        Raises InputError where the figure has no such button.
        """
        now, clock = self._now, self._clock
        for button in self.description["buttons"]:
            if button["text"] == text:
                sets = {number: float(now[f](clock)) for number, f in button["sets"]}
                if all(map(math.isfinite, sets.values())):
                    self._change(sets)
                return
        known = ", ".join(f"'{button['text']}'" for button in self.description["buttons"])
        raise InputError(f"This figure has no button {shorten(text)}: it has {known or 'none'}.")

    def pin(self) -> None:
        """Make the present settings the reference, drawn dashed."""
        self.pinned = list(self.settings)

    @np.errstate(all="ignore")
    def picture(self) -> bytes:
        """Return a PNG of the figure as it stands."""
        then = self._formulas.at(self.pinned, self.pinned)
        return draw(self.description, self._now, then, self._clock)

    def save(self, path: str | Path, *, overwrite: bool = False) -> Path:
        """Write a page with the living figure, which needs neither kernel nor network.

        The name of the file ends in .html. It begins with the present settings. A file that is
        there already is left as it is, with an InputError, unless `overwrite` is True. Returns the
        path.
        """
        ending(path, "figure", [".html", ".htm"])
        return write_new(path, self.as_page(), overwrite=overwrite)

    def as_page(self) -> str:
        """Return the page that `save` writes."""
        return page.write_page(self._data, self.text)

    @property
    def _data(self) -> dict[str, Any]:
        keys = ("description", "settings", "pinned")
        return {key: getattr(self, key) for key in keys}

    @property
    def _now(self) -> Any:
        return self._formulas.at(self.settings, self.pinned)

    @property
    def _clock(self) -> Any:
        """Where the variable stands: NumPy's number, which divides by zero as JavaScript does."""
        low, high = self._ends
        return low + CLOCK * (high - low)

    @property
    @np.errstate(all="ignore")
    def _ends(self) -> list[Any]:
        now = self._now
        return [np.float64(now[end]()) for end in self.description["range"]]

    @np.errstate(all="ignore")
    def _change(self, changes: Mapping[int, float]) -> None:
        """Change settings, kept in their ranges; others give way, by the steps of `formulas.js`."""
        controls = self.description["controls"]

        def within(number: int, value: float) -> float:
            return float(min(controls[number]["high"], max(controls[number]["low"], value)))

        changed = list(self.settings)
        for number, value in changes.items():
            changed[number] = within(number, value)
        limited = [n for n, control in enumerate(controls) if control["most"] is not None]
        others = [number for number in limited if number not in changes]
        for number in [*others, *limited]:  # the others first, then what has been moved
            most = float(self._formulas.at(changed, changed)[controls[number]["most"]]())
            if most < changed[number]:  # and not where it is no number
                changed[number] = within(number, most)
        self.settings = changed

    def _written(self, piece: str | dict[str, Any], now: Any, clock: Any) -> str:
        if isinstance(piece, str):
            return piece
        if "choice" in piece:
            number = piece["choice"]
            return str(self.description["controls"][number]["options"][int(self.settings[number])])
        value = float(now[piece["formula"]](clock))
        if not math.isfinite(value):
            return "–" if math.isnan(value) else "∞" if value > 0 else "−∞"
        return format(value, f"z{piece['spec']}").replace("-", "−")  # z: what is written as 0 is 0

    def _checked(self, number: int, value: Any) -> float:
        control = self.description["controls"][number]
        low, high = control["low"], control["high"]
        try:
            checked = float(value)
        except (TypeError, ValueError):
            checked = math.nan
        names, is_inside = control["options"], low <= checked <= high
        if names and not (is_inside and checked.is_integer()):
            said = ", ".join(f"{place} ({name})" for place, name in enumerate(names))
            raise InputError(
                f"The value of {control['name']} is {shorten(value)}: give the number of a name, "
                f"{said}."
            )
        if not is_inside:
            raise InputError(
                f"The value of {control['name']} is {shorten(value)}: it goes from {low:g} to "
                f"{high:g}{' ' * bool(control['unit'])}{control['unit']} in this figure."
            )
        return checked

    def _check_drawn(self) -> None:
        """Raise InputError if a panel would be blank, since nothing in it is a real number."""
        now, (low, high) = self._now, self._ends
        if not low < high < np.inf or low == -np.inf:
            raise InputError(
                f"The running variable goes from {low:g} to {high:g}, which is no range: give two "
                "finite ends, the lower one first."
            )
        for panel in (panel for column in self.description["columns"] for panel in column):
            lines = [line for line in panel["lines"] if line["role"] == "own"]
            if lines and not any(_is_real(line, now) for line in lines):
                settings = ", ".join(f"{s} = {v:g}" for s, v in self.values.items())
                raise InputError(
                    f"There is nothing to draw in '{panel['title']}': its curves have no real "
                    f"value anywhere in the range{' with ' * bool(settings)}{settings}. Look for "
                    "the root or logarithm of a negative number, or for a division by zero."
                )

    def _repr_mimebundle_(self, **kwargs: Any) -> tuple[dict[str, Any], dict[str, Any]]:
        """Show picture and text beside the widget, and what a page can be made from."""
        data, metadata = super()._repr_mimebundle_(**kwargs) or ({}, {})
        shown = {MIME: page.as_json(self._data), **as_bundle(self.picture(), self.text)}
        return data | shown, metadata


def _is_real(line: dict[str, Any], now: Any) -> bool:
    low, high = (float(now[end]()) for end in line["over"])
    with np.errstate(all="ignore"):
        return bool(np.isfinite(now[line["y"]](np.linspace(low, high, 101))).any())
