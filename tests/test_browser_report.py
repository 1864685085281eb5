"""The page of a report in a real Chromium: nothing is cut, and numbers stay beside their names."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser

import cammotion as cm
from cammotion.report.live import live_figure
from cammotion.report.markup import table

HEADS = ("peak today, m/s²", "then, m/s²", "largest of the machine then, m/s²", "rate, pieces/h")
SIZES = (1280, 768, 390, 320)
HEBREW, ARABIC = "\u05de\u05db\u05d5\u05e0\u05d4", "\u0645\u0637\u0631\u0642\u0629"
FITS = """async () => {
  const { body } = document, wait = () => new Promise((then) => setTimeout(then, 25));
  for (let n = 0; n < 400 && !document.querySelector(".cm-column path[d^=M]"); n++) await wait();
  for (let n = 0; n < 400 && innerHeight < body.offsetHeight; n++) await wait();
  return [body.offsetHeight > 300, innerHeight - body.offsetHeight];
}"""
PLACES = """(name) => {
  const text = [...document.querySelectorAll("text")]
      .find((each) => each.textContent.startsWith("peak acceleration")),
    words = text.textContent,
    middle = (at) => text.getStartPositionOfChar(at).x + text.getEndPositionOfChar(at).x,
    start = words.indexOf(name),
    letters = [...name].map((_, n) => middle(start + n)),
    number = words.indexOf("4", start);
  return [Math.min(...letters), Math.max(...letters), middle(number)];
}"""


@pytest.mark.parametrize("width", SIZES)
def test_the_live_figure_is_seen_whole(browser: Browser, tmp_path: Path, width: int) -> None:
    machine = cm.Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule])
    style = Path(cm.__file__).with_name("report") / "page.css"
    page = tmp_path / "page.html"
    rows = table(
        "How", ["change", *HEADS], [(False, ["widen the " + "die " * 9, 1.0, 2.0, 3.0, 4.0])]
    )
    page.write_text(
        f"<!DOCTYPE html><style>{style.read_text('utf-8')}</style>{rows}{live_figure(machine)}",
        "utf-8",
    )
    shown = browser.new_page(viewport={"width": width, "height": 800})
    shown.goto(page.as_uri())
    shown.locator("iframe").scroll_into_view_if_needed()
    _, frame = shown.frames
    is_drawn, room = frame.evaluate(FITS)
    assert is_drawn
    assert 0 <= room < 20
    assert shown.evaluate("document.querySelector('.wide').scrollWidth <= innerWidth")
    shown.close()


@pytest.mark.parametrize("name", [HEBREW, ARABIC])
def test_a_number_stands_behind_a_name_that_runs_to_the_left(
    browser: Browser, tmp_path: Path, name: str
) -> None:
    parts = cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=55), cm.dwell(150)
    motions = [cm.motion(name, *parts), cm.motion("die", *parts, start_deg=150)]
    drawing = tmp_path / "machine.svg"
    drawing.write_text(cm.animate(cm.TimingDiagram(motions, rate_per_hour=2000)).svg, "utf-8")
    shown = browser.new_page()
    shown.goto(drawing.as_uri())
    low, high, number = shown.evaluate(PLACES, name)
    assert low < high < number
    shown.close()
