"""What a notebook shows of a picture of Matplotlib: itself, and words for who does not see it."""

import base64
import functools
import io
from collections.abc import Callable, Iterable, Iterator
from html import escape
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
import numpy as np
from IPython.display import display
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.container import BarContainer
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.text import Text
from matplotlib.ticker import ScalarFormatter

from cammotion.quantities import as_text
from cammotion.views.names import printable
from cammotion.views.paper import STYLE
from cammotion.views.scales import more_digits

_EDGE_INCHES = 0.1
_QUICK = {"compress_level": 3}  # a cell that runs waits for it
_CURVE = 10  # points that a line has at least that is more than a mark

P = ParamSpec("P")
R = TypeVar("R")


class PictureFigure(Figure):
    """A figure of Matplotlib that a notebook shows with words and in the colours of its theme."""

    def _ipython_display_(self) -> None:
        """Show it ourselves: a plot's PNG alone has no words in JupyterLab."""
        display(as_bundle(self.png(), describe(self)), raw=True)  # type: ignore[no-untyped-call]

    def savefig(self, *args: Any, **kwargs: Any) -> None:
        """Save it cut to what is drawn, as a notebook shows it, unless told otherwise."""
        usual = {"bbox_inches": "tight", "facecolor": "auto"}
        super().savefig(*args, **usual | kwargs)

    def png(self) -> bytes:
        """Return the picture as a PNG, cut to what is drawn."""
        picture = io.BytesIO()
        edges: Any = "tight"
        if self.get_layout_engine() is None:  # found here they cost one drawing less
            renderer = RendererAgg(*self.bbox.size, self.dpi)  # type: ignore[no-untyped-call]
            edges = self.get_tightbbox(renderer).padded(_EDGE_INCHES)
        self.savefig(picture, format="png", bbox_inches=edges, pil_kwargs=_QUICK)
        return picture.getvalue()


def blank_axes(width: float, height: float, *, layout: Any = "none") -> Axes:
    """Return the axes of a new picture, its size in inches."""
    _, ax = plt.subplots(
        figsize=(width, height), facecolor="white", layout=layout, FigureClass=PictureFigure
    )
    return ax


def on_paper(draw: Callable[P, R]) -> Callable[P, R]:
    """Let a function draw for white paper, whatever colours somebody has set for Matplotlib.

    In axes of a figure that is not ours its words have the colours of that one.
    """

    @functools.wraps(draw)
    def drawn(*args: P.args, **kwargs: P.kwargs) -> R:
        ax = kwargs.get("ax")
        if isinstance(ax, Axes) and not isinstance(ax.get_figure(root=True), PictureFigure):
            return draw(*args, **kwargs)
        colours = {n: usual for n, usual in mpl.rcParamsDefault.items() if n.endswith("color")}
        before = {name: mpl.rcParams[name] for name in colours}
        mpl.rcParams.update(colours)  # these alone: a notebook's backend sets others meanwhile
        try:
            return draw(*args, **kwargs)
        finally:
            mpl.rcParams.update(before)

    return drawn


def taken(ax: Axes) -> tuple[bytes, str]:
    """Return the picture in which axes of ours are as a PNG, and in words; it is closed then."""
    figure = ax.figure
    assert isinstance(figure, PictureFigure)  # noqa: S101 - blank_axes made it
    found = figure.png(), describe(figure)
    plt.close(figure)
    return found


def as_bundle(png: bytes, words: str) -> dict[str, str]:
    """Return what a notebook is given for a picture, by MIME type.

    The PNG is within HTML, since JupyterLab's own renderer of PNGs takes no words.
    """
    data = base64.b64encode(png).decode("ascii")
    image = f'<img class="cm-paper" alt="{escape(words)}" src="data:image/png;base64,{data}">'
    return {"text/html": STYLE + image, "text/plain": words}


def describe(figure: Figure) -> str:
    """Return in words what a figure shows: its axes, curves and bars, and what is written in it.

    >>> import cammotion as cm
    >>> die = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    >>> print(describe(cm.plot_curves(die).figure))
    Acceleration a in m/s² over time t in s. Curves: 55° from -4.15 to 4.15. Written in it: 55°.
    """
    told = filter(None, (" ".join(_sentences(ax)) for ax in figure.axes))
    return "\n".join(told) or "An empty picture."


def _sentences(ax: Axes) -> Iterator[str]:
    across, up = _words([ax.xaxis.label]), _words([ax.yaxis.label])
    said = " over ".join([*up, *across])
    if said:
        yield said[0].upper() + said[1:] + "."
    drawn = (line for line in ax.lines if line.get_linestyle() != "None")
    curves = [line for line in drawn if len(np.atleast_1d(line.get_xdata())) > _CURVE]
    if curves:
        yield f"Curves: {'; '.join(map(_range, curves))}."
    if ax.containers and (bars := _bars(ax)):
        yield f"Bars: {'; '.join(bars)}."
    marks = [str(patch.get_label() or "") for patch in ax.patches]
    if named := [printable(mark) for mark in marks if mark and not mark.startswith("_")]:
        yield f"Marked: {'; '.join(named)}."
    words = _words(ax.texts)
    if words:
        yield f"Written in it: {'; '.join(words)}."


def _bars(ax: Axes) -> list[str]:
    """Return the names of bars: what stands at an axis that has no scale, and those of series."""
    named = (
        a for a in (ax.xaxis, ax.yaxis) if not isinstance(a.get_major_formatter(), ScalarFormatter)
    )
    names = _words(label for axis in named for label in axis.get_ticklabels())
    return names + [
        f"{printable(bars[0].get_gid() or str(bars.get_label()))} up to "
        f"{as_text(max(map(Rectangle.get_height, bars)), '.3g')}"
        for bars in ax.containers
        if isinstance(bars, BarContainer) and not str(bars.get_label()).startswith("_")
    ]


def _range(curve: Line2D) -> str:
    """Return the name of a curve, which it may not have, with its least and largest value."""
    low, high = (end(np.asarray(curve.get_ydata(), float)) + 0.0 for end in (np.nanmin, np.nanmax))
    label = str(curve.get_label())
    name = printable(curve.get_gid() or ("one" if label.startswith("_") else label))
    digits = f".{3 + more_digits(low, high)}g"
    return f"{name} from {as_text(low, digits)} to {as_text(high, digits)}"


def _words(texts: Iterable[Text]) -> list[str]:
    """Return texts on one line each, without those that are empty."""
    words = (
        text.get_text().replace("$", "") if text.get_parse_math() else text.get_text()
        for text in texts
    )
    return [line for line in map(printable, words) if line]
