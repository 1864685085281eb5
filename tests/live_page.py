"""A reader of live figures in a page: what a test does there and reads off, in any browser."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import sympy as sp
from explored import weight_figure

import cammotion as cm
from cammotion.views.live.figure import LiveFigure

t, k = sp.symbols("t k")
MOST_BYTES = 30_000
RESTS_MS = 750  # the hand: longer than the figure waits before it speaks
PHONE_PX = 360
FIGURES: dict[str, Callable[[], LiveFigure]] = {
    "move": lambda: cm.explore_move(
        cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000), laws=cm.LAWS
    ),
    "scca": cm.explore_scca,
    "overlap": lambda: cm.explore_overlap(cm.EXAMPLE.diagram, cm.EXAMPLE.rule, contact_mm=20),
    "weight": weight_figure,
    "clock": lambda: cm.explore(
        {"a sine": sp.sin(k * t), "a pole": 1 / (t - sp.Rational(1, 3))},
        (t, 0, 1),
        {k: (1, 9)},
        seconds=2,
        title="<b>A sine</b> & </script>",
    ),
}
SAID = """() => [...document.querySelector(".cm-figure [role=status]").previousSibling.children]
  .map((line) => line.textContent).filter((line) => line).join("\\n")"""
WAIT = "(ms) => new Promise((resolve) => setTimeout(resolve, ms))"
DRAWN = """(panel) => {
  const svg = document.querySelectorAll(".cm-column > svg")[panel];
  const numbers = [...svg.querySelectorAll(".cm-grid text")].map((text) => [
    text.getAttribute("text-anchor"), Number(text.getAttribute("x")),
    Number(text.getAttribute("y")), Number(text.textContent.replace("−", "-"))])
    .filter((text) => !Number.isNaN(text[3]));
  const lines = [...svg.querySelectorAll(".cm-own")];
  return { numbers, paths: lines.map((line) => line.getAttribute("d")) };
}"""
TYPE = """({ label, value }) => {
  const row = [...document.querySelectorAll(".cm-settings label")]
    .find((each) => each.textContent.startsWith(label));
  const field = document.getElementById(row.htmlFor);
  field.focus();
  if (value !== undefined) field.value = value;
  field.select?.();
}"""
SLIDE = """(label) => [...document.querySelectorAll(".cm-settings input[type=range]")]
  .find((slider) => slider.getAttribute("aria-label").startsWith(label)).focus()"""
PRESS = """(words) => [...document.querySelectorAll(".cm-figure button")]
  .find((button) => button.textContent.startsWith(words)).focus()"""
ERRORS = """() => [...document.querySelectorAll("[role=alert]")]
  .map((error) => error.textContent).join("")"""
FIELDS = """() => [...document.querySelectorAll(".cm-settings input[type=text]")]
  .map((field) => field.value)"""
LISTEN = """() => {
  window.heard = [];
  const status = document.querySelector(".cm-figure [role=status]");
  new MutationObserver(() => heard.push(status.textContent))
    .observe(status, { childList: true, characterData: true, subtree: true });
}"""
OUTSIDE = """() => [...document.querySelectorAll("body *")].filter((element) =>
  !element.closest("[clip-path]") && (element.getBoundingClientRect().right > innerWidth + 1
    || element.getBoundingClientRect().left < -1)).map((element) => element.outerHTML.slice(0, 99))
  .concat(document.documentElement.scrollWidth > innerWidth ? ["the page itself"] : [])"""
TWICE = """async ({ script, datas }) => {
  document.body.textContent = "";
  for (const data of datas) {
    const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
    const { default: figure } = await import(url);
    const model = { get: (key) => data[key], on() {}, off() {}, set() {}, save_changes() {} };
    const el = document.createElement("div");
    document.body.append(el);
    figure.render({ model, el });
  }
  await new Promise((resolve) => setTimeout(resolve, 100));
  const ids = [...document.querySelectorAll("[id]")].map((element) => element.id);
  const asked = [...document.querySelectorAll("[for]")].map((label) => label.htmlFor);
  for (const name of ["aria-describedby", "aria-labelledby", "clip-path"])
    for (const element of document.querySelectorAll(`[${name}]`))
      asked.push(element.getAttribute(name).replace(/url\\(#(.*)\\)/, "$1"));
  const figures = [...document.querySelectorAll(".cm-figure")];
  const isOwn = (id) => figures.filter((each) => each.querySelector(`[id="${id}"]`)).length === 1;
  return { ids, missing: asked.filter((id) => !ids.includes(id) || !isOwn(id)) };
}"""
UNSEEN = """async ({ script, data }) => {
  const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  const { default: figure, modelOf } = await import(url);
  const el = document.createElement("div");
  figure.render({ model: modelOf(data), el });
  const asked = [...el.querySelectorAll("button")].find((each) => each.textContent === data.press);
  asked?.click();
  const texts = (words) => [...el.querySelectorAll(words)];
  return {
    settings: data.settings,
    fields: texts("input[type=text]").map((field) => field.value),
    said: texts(".cm-said > div").map((line) => line.textContent),
  };
}"""


@cache
def built(name: str) -> LiveFigure:
    return FIGURES[name]()


def started(figure: LiveFigure) -> list[float]:
    return [control["start"] for control in figure.description["controls"]]


@dataclass
class Reader:
    """Somebody with a page in some browser, and with the same figure in Python."""

    goto: Callable[[str], object]
    evaluate: Callable[..., Any]
    press: Callable[[str], object]
    folder: Path
    figure: LiveFigure

    def open(self, name: str) -> LiveFigure:
        """Save a figure as a page and open it; return a figure like it."""
        self.figure = built(name)
        self.figure.pinned = self.figure.settings = started(self.figure)
        path = self.figure.save(self.folder / f"{name}.html", overwrite=True)
        assert path.stat().st_size <= MOST_BYTES or name in ("scca", "overlap")  # many formulas
        self.goto(path.as_uri())
        for _ in range(100):
            if self.evaluate(
                "() => document.querySelector('.cm-column path.cm-own')?.matches('[d]')"
            ):
                return self.figure
            self.evaluate(WAIT, 20)
        raise AssertionError(f"{name} is not drawn")

    def type(self, label: str, text: str) -> None:
        """Type over what is in a field, and leave it by Enter."""
        self.evaluate(TYPE, {"label": label})
        for key in [*text, "Enter"]:
            self.press(key)

    def push(self, words: str) -> None:
        """Press a button by key."""
        self.evaluate(PRESS, words)
        self.press("Space")

    def said(self) -> str:
        """Return the sentences of the page."""
        return str(self.evaluate(SAID))

    def assert_as_in_python(self) -> None:
        """Compare sentences and drawn curves with those of Python's figure."""
        assert self.said() == self.figure.text
        (column, *_) = self.figure.description["columns"][-1:]
        first = sum(map(len, self.figure.description["columns"][:-1]))
        for number, panel in enumerate(column):
            drawn = self.evaluate(DRAWN, first + number)
            numbers = self.evaluate(DRAWN, first + len(column) - 1)["numbers"]  # of the last x axis
            own = [line for line in panel["lines"] if line["role"] == "own"]
            for line, path in zip(own, drawn["paths"], strict=True):
                assert_follows(self.figure, line, path, numbers, drawn["numbers"])


def assert_follows(
    figure: LiveFigure, line: dict[str, Any], path: str, below: list[Any], beside: list[Any]
) -> None:
    """Compare a drawn path with what Python computes, on the axes that the page has numbered."""
    across = [(at, value) for anchor, at, _, value in below if anchor == "middle"]
    up = [(at - 4, value) for anchor, _, at, value in beside if anchor == "end"]
    (x0, x_px), (y0, y_px) = (
        (scale[0], (scale[-1][1] - scale[0][1]) / (scale[-1][0] - scale[0][0]))
        for scale in (across, up)
    )
    points = np.array([pair.split() for pair in re.findall(r"[\d.-]+ [\d.-]+", path)], dtype=float)
    x, y = x0[1] + (points[:, 0] - x0[0]) * x_px, y0[1] + (points[:, 1] - y0[0]) * y_px
    with np.errstate(all="ignore"):  # Python's heights up to a pixel's tenth to the left and right
        around = [figure._now[line["y"]](x + side * x_px / 10) for side in (-1, 0, 1)]
    low, high = np.nanmin(around, axis=0), np.nanmax(around, axis=0)
    is_seen = np.abs(y) <= max(abs(value) for _, value in up)  # beyond the picture a curve is cut
    off = np.maximum(low - y, y - high)[is_seen] / abs(y_px)
    assert len(points) > 150
    assert off.max() < 0.2  # pixels
