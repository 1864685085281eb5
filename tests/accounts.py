"""An account of a picture: what is drawn in it, line by line, to be read and compared.

A number in an account is rounded to four digits; `differences` forgives a little more, for another
version of Matplotlib or another processor.
"""

import hashlib
import re
from collections.abc import Iterator, Sequence
from difflib import unified_diff
from typing import Any
from unittest.mock import patch
from xml.etree import ElementTree

import numpy as np
from bs4 import BeautifulSoup
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import Collection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.text import Text

from cammotion.views.live import picture
from cammotion.views.live.figure import LiveFigure

Account = list[str]

_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
_NEAR = 3e-3  # of a number
_LONG = 90  # an attribute that is longer is told by what it begins with, and a sum


def account(shown: Axes | LiveFigure | str) -> Account:
    """Return what is in a picture: of Matplotlib, live as it stands, or SVG and HTML."""
    if isinstance(shown, str):
        return list(_markup(shown))
    if isinstance(shown, LiveFigure):
        return [
            *_controls(shown),
            *_steps(shown),
            *shown.text.splitlines(),
            *_figure(figure_of(shown)),
        ]
    assert isinstance(shown.figure, Figure)
    return list(_figure(shown.figure))


def differences(before: Sequence[str], after: Sequence[str]) -> str:
    """Return what differs between two accounts but for the last digits, "" for nothing."""
    if len(before) == len(after) and all(map(_is_alike, before, after)):
        return ""
    return "\n".join(unified_diff(before, after, "stored", "drawn", n=1, lineterm=""))


def _is_alike(before: str, after: str) -> bool:
    if before == after:
        return True
    if _NUMBER.sub("#", before) != _NUMBER.sub("#", after):
        return False
    one, other = (np.array(_NUMBER.findall(line), float) for line in (before, after))
    return bool(np.allclose(one, other, rtol=_NEAR, atol=1e-9))


def _figure(figure: Figure) -> Iterator[str]:
    figure.canvas.draw()  # some artists find their places only then
    yield f"figure {_row(figure.get_size_inches())} in"
    for ax in figure.axes:
        yield from _axes(ax)


def _axes(ax: Axes) -> Iterator[str]:
    yield f"axes at {_row(ax.get_position().bounds)}"
    for name, axis in (("x", ax.xaxis), ("y", ax.yaxis)):
        low, high = axis.get_view_interval()
        labels = [text.get_text() for text in axis.get_ticklabels() if text.get_visible()]
        grid = any(line.get_visible() for line in axis.get_gridlines())
        label = axis.label.get_text()
        yield f" {name} {axis.get_scale()} {_row([low, high])} grid {grid} {label!r}"
        yield f"  ticks {_row(axis.get_ticklocs())} {labels} {axis.get_visible()}"
    yield f" spines {[name for name, spine in ax.spines.items() if spine.get_visible()]}"
    if ax.get_title():
        yield f" title {ax.get_title()!r}"
    if legend := ax.get_legend():
        names = [text.get_text() for text in legend.get_texts()]
        loc = legend._loc  # type: ignore[attr-defined]
        place = f"{'moved' if isinstance(loc, tuple) else loc} {legend.get_zorder():g}"
        yield f" legend {names} {place} framed {legend.get_frame_on()}"
    for artist in (*ax.lines, *ax.patches, *ax.collections, *ax.texts, *ax.images):
        yield f" {_artist(ax, artist)}"


def _artist(ax: Axes, artist: Artist) -> str:
    where = "" if artist.get_transform().contains_branch(ax.transData) else " off the data"
    label = str(artist.get_label())  # an underscore begins those that Matplotlib gives
    name = "" if label.startswith("_") else repr(label)
    said = f"{type(artist).__name__} {name} layer {artist.get_zorder():g}{where}"
    faint = f" alpha {artist.get_alpha():g}" if artist.get_alpha() is not None else ""
    hidden = "" if artist.get_visible() else " hidden"
    return f"{said}{faint}{hidden} {' '.join(_details(artist))}"


def _details(artist: Artist) -> Iterator[str]:
    match artist:
        case Line2D():
            yield f"{to_hex(artist.get_color())} {artist.get_linewidth():g} {_dashes(artist)}"
            yield f"marker {artist.get_marker()} {artist.get_markersize():g}"
            yield from (_values(axis, artist.get_data()[n]) for n, axis in enumerate("xy"))
        case Patch():
            yield f"face {_colour(artist.get_facecolor())} edge {_colour(artist.get_edgecolor())}"
            yield f"{artist.get_linewidth():g} {artist.get_linestyle()} hatch {artist.get_hatch()}"
            path = artist.get_path().transformed(artist.get_patch_transform())
            yield from (
                _values(axis, np.asarray(path.vertices)[:, n]) for n, axis in enumerate("xy")
            )
        case Collection():
            yield f"face {_colours(artist.get_facecolor())} edge {_colours(artist.get_edgecolor())}"
            yield f"width {_row(artist.get_linewidth())} hatch {artist.get_hatch()}"
            points = [path.vertices for path in artist.get_paths()] or [np.zeros((1, 2))]
            every = np.concatenate([*points, np.asarray(artist.get_offsets()).reshape(-1, 2)])
            yield from (_values(axis, every[:, n]) for n, axis in enumerate("xy"))
        case Text():
            yield f"{artist.get_text()!r} at {_row(artist.get_position())}"
            if hasattr(artist, "xy"):
                yield f"beside {_row(artist.xy)}"
            yield f"{artist.get_horizontalalignment()} {artist.get_verticalalignment()}"
            yield f"turned {artist.get_rotation():g}"
            yield f"{_colour(artist.get_color())} size {artist.get_fontsize():g}"
            yield f"{artist.get_fontweight()} {artist.get_bbox_patch() is not None}"


def _values(axis: str, given: Any) -> str:
    """Tell many values by their number, ends, extremes and two sums, in which each has a part."""
    values = np.asarray(np.ma.filled(given, np.nan), dtype=np.float64).ravel()
    if values.size <= 5:
        return f"{axis} {_row(values)}"
    known = values[np.isfinite(values)]
    if not known.size:
        return f"{axis} {values.size} values, none finite"
    share = np.linspace(0, 1, known.size)
    told = [known[0], known[-1], known.min(), known.max(), known.mean(), (known * share).mean()]
    return f"{axis} {values.size} values {_row(told)}"


def _row(numbers: Any) -> str:
    values = np.asarray(numbers, dtype=np.float64).ravel()
    tiny = 1e-9 * np.abs(values[np.isfinite(values)]).max(initial=0.0)
    return f"({', '.join(f'{0.0 if abs(v) <= tiny else v:.4g}' for v in values)})"


def _dashes(line: Line2D) -> str:
    offset, dashes = line._dash_pattern  # type: ignore[attr-defined]
    return "whole" if dashes is None else f"dashes {offset:g} {_row(dashes)}"


def _colour(given: Any) -> str:
    return to_hex(given, keep_alpha=True)


def _colours(given: Any) -> list[str]:
    return list(dict.fromkeys(map(_colour, np.atleast_2d(given)))) if len(given) else []


def figure_of(live: LiveFigure) -> Figure:
    """Return the picture that a live figure draws of itself."""
    drawn: list[Figure] = []

    class Caught(FigureCanvasAgg):
        def print_png(self, *_: Any, **__: Any) -> None:
            drawn.append(self.figure)

    with patch.object(picture, "FigureCanvasAgg", Caught):
        live.picture()
    FigureCanvasAgg(drawn[0])  # one that draws
    return drawn[0]


def _controls(live: LiveFigure) -> Iterator[str]:
    for control in live.description["controls"]:
        yield "control " + " ".join(f"{key}={value!r}" for key, value in sorted(control.items()))
    for button in live.description["buttons"]:
        yield f"button {button['text']!r}"


def _steps(live: LiveFigure) -> Iterator[str]:
    """Tell from tick to tick of each panel, where that is given: the page alone knows."""
    for panel in (panel for column in live.description["columns"] for panel in column):
        if panel["x_ticks"] is not None or panel["y_ticks"] is not None:
            yield f"panel {panel['y_label']!r} steps {panel['x_ticks']} and {panel['y_ticks']}"


def _markup(text: str) -> Iterator[str]:
    if text.lstrip().lower().startswith("<!doctype html"):
        yield from _page(BeautifulSoup(text, "html.parser"))
        return
    for place, element in enumerate(ElementTree.fromstring(text).iter()):  # noqa: S314 - our own
        tag = element.tag.rpartition("}")[2]
        given = " ".join(f"{name}={_cut(value)}" for name, value in element.attrib.items())
        words = " ".join((element.text or "").split())
        yield f"{place} {tag} {given} {_cut(words) if words else ''}".rstrip()


def _page(page: BeautifulSoup) -> Iterator[str]:
    """Tell of a page all but its style, what it runs, and the files and pages that it holds."""
    for place, element in enumerate(page(lambda tag: tag.name not in {"script", "style"})):
        given = " ".join(
            f"{name}={value!r}"
            for name, value in element.attrs.items()
            if name != "srcdoc" and not str(value).startswith("data:")
        )
        words = " ".join("".join(element.find_all(string=True, recursive=False)).split())
        yield f"{place} {element.name} {given} {words}".rstrip()


def _cut(text: str) -> str:
    if len(text) <= _LONG:
        return repr(text)
    return f"{text[:_LONG]!r}... {hashlib.sha256(text.encode()).hexdigest()[:12]}"
