"""What a live figure draws and says, read off its description and its formulas."""

import base64
import json
import re
from collections.abc import Iterator
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp
from bs4 import BeautifulSoup
from machines import Array

import cammotion as cm
from cammotion.views.live.figure import LiveFigure

LESSONS = Path(__file__).parents[1] / "notebooks"


def weight_figure() -> LiveFigure:
    """Return the live figure of the weight over the acceleration, as the cells of 06 make it."""
    return made_by_cells("06", "weight-areas", "weight-figure")


def table_figure() -> LiveFigure:
    """Return the live figure of the torque over the index, as the cells of 08 make it."""
    return made_by_cells("08", "explore-symbols", "explore-figure")


def nyquist_figure() -> LiveFigure:
    """Return the live figure of a wave at Nyquist's limit, as the cells of 09 make it."""
    return made_by_cells("09", "nyquist-symbols", "nyquist-figure")


def made_by_cells(lesson: str, symbols: str, call: str) -> LiveFigure:
    """Return the live figure that two cells of a lesson make."""
    (path,) = LESSONS.glob(f"{lesson}_*.ipynb")
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    sources = {cell["id"]: "\n" + "".join(cell["source"]) for cell in cells}
    names: dict[str, Any] = {"sp": sp, "cm": cm}
    exec(sources[symbols], names)  # noqa: S102 - our own notebook
    before, _, call = sources[call].rpartition("\ncm.explore(")
    exec(f"{before}\nfigure = cm.explore({call}", names)  # noqa: S102
    return names["figure"]  # type: ignore[no-any-return]


def picture_in(bundle: dict[str, str], words: str) -> bytes:
    """Return the PNG of the one image in the HTML that a notebook is given, which has the words."""
    (image,) = BeautifulSoup(bundle["text/html"], "html.parser").select("img")
    assert image["alt"] == bundle["text/plain"] == words
    return base64.b64decode(str(image["src"]).removeprefix("data:image/png;base64,"))


def zones_figure() -> LiveFigure:
    """Return the live figure of tolerance zones over the diameter, as the cells of 11 make it."""
    (path,) = LESSONS.glob("11_*.ipynb")
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    sources = {cell["id"]: "".join(cell["source"]) for cell in cells}
    names: dict[str, Any] = {"sp": sp, "cm": cm}
    exec(sources["explore-parts"], names)  # noqa: S102 - our own notebook
    before, _, call = sources["explore-figure"].rpartition("\ncm.explore(")
    exec(f"{before}\nfigure = cm.explore({call}", names)  # noqa: S102
    return names["figure"]  # type: ignore[no-any-return]


def control_of(figure: LiveFigure, symbol: sp.Symbol) -> dict[str, Any]:
    """Return the description of a control."""
    controls = figure.description["controls"]
    return dict(zip(figure.values, controls, strict=True))[symbol]  # type: ignore[no-any-return]


def at_corners(figure: LiveFigure, *symbols: sp.Symbol) -> Iterator[dict[sp.Symbol, float]]:
    """Set controls to all of their least, first and largest numbers; yield the settings."""
    controls = [control_of(figure, symbol) for symbol in symbols]
    for places in product(["low", "start", "high"], repeat=len(symbols)):
        numbers = [control[place] for control, place in zip(controls, places, strict=True)]
        figure.values = dict(zip(symbols, numbers, strict=True))
        yield figure.values


def panel_of(figure: LiveFigure, title: str) -> dict[str, Any]:
    """Return the panel whose title begins so."""
    panels = [panel for column in figure.description["columns"] for panel in column]
    (found,) = [panel for panel in panels if panel["title"].startswith(title)]
    return found  # type: ignore[no-any-return]


def lines_of(figure: LiveFigure, title: str, role: str = "own") -> list[dict[str, Any]]:
    """Return the lines of a panel that have a role."""
    return [line for line in panel_of(figure, title)["lines"] if line["role"] == role]


def drawn(figure: LiveFigure, formula: int, at: Array) -> Array:
    """Return what a formula is at places of the running variable."""
    with np.errstate(all="ignore"):
        return np.array(np.broadcast_to(figure._now[formula](at), np.shape(at)), dtype=float)


def limits_of(figure: LiveFigure, title: str, axis: str = "y") -> list[float]:
    """Return the limits of an axis of a panel, which has some."""
    return [float(figure._now[end]()) for end in panel_of(figure, title)[f"{axis}_limits"]]


def peaks_said(text: str) -> list[float]:
    """Return all peak accelerations that a text names."""
    found = re.findall(r"a_max = ([\d.e+]+|∞) m/s²", text)
    return [float(number.replace("∞", "inf")) for number in found]
