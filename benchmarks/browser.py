"""How long a tick takes in a real browser, from the key press to the new picture."""

import shutil
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from execution import make_notebook, write_notebook
from findings import Finding, judge_ticks, say
from playwright.sync_api import Locator

ROOT = Path(__file__).parent.parent
sys.path.append(str(ROOT / "tests"))

from lab import LabPage, running_browser, running_lab  # noqa: E402

WORK = "work-benchmark"
NOTEBOOK = "ticks.ipynb"
# Over the angle's whole range, so that changes of the axes have their natural share.
ROUNDS, OWN_TICKS, RIVAL_TICKS = 20, 10, 4
OWN_CELL = """\
import cammotion as cm
die = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
cm.explore_move(die)"""
RIVAL_CELL = f"""\
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
from rival import interact_with
interact_with(die);"""
# The picture is another, it is decoded, and the page is about to paint it.
WATCH = """output => {
  const image = () => output.querySelector('img');
  const before = image().src;
  window.tick = new Promise(done => {
    let pressed;
    const note = () => { pressed = performance.now(); };
    output.addEventListener('keydown', note, {capture: true, once: true});
    const watcher = new MutationObserver(async () => {
      if (!image() || image().src === before) return;
      watcher.disconnect();
      await image().decode();
      requestAnimationFrame(() => done(performance.now() - pressed));
    });
    watcher.observe(output, {subtree: true, childList: true, attributeFilter: ['src']});
  });
}"""


def measure_redraws() -> list[Finding]:
    """Press the arrow key on the explorer's angle and on that of `interact`, by turns."""
    times: dict[str, list[float]] = {"own": [], "rival": []}
    with open_notebook() as lab:
        own = lab.output_of("cm.explore_move(")
        rival = lab.output_of("interact_with(")
        for output in (own, rival):
            slider_of(output).press("Home")
            lab.settle()
        for number in range(ROUNDS):
            say(f"keys in the browser, round {number + 1} of {ROUNDS}")
            times["own"] += press(own, OWN_TICKS)
            times["rival"] += press(rival, RIVAL_TICKS)
    return judge_ticks("key press to redraw", times["own"], times["rival"], 110, 5)


@contextmanager
def open_notebook() -> Iterator[LabPage]:
    """Open a notebook with both figures in JupyterLab, and run it."""
    folder = ROOT / WORK
    folder.mkdir(exist_ok=True)
    write_notebook(make_notebook(OWN_CELL, RIVAL_CELL), folder / NOTEBOOK)
    try:
        with (
            tempfile.TemporaryDirectory() as home,
            running_browser() as browser,
            running_lab(Path(home), WORK) as address,
        ):
            lab = LabPage(browser, address.replace("00_start_here.ipynb", NOTEBOOK))
            lab.wait_for(NOTEBOOK)
            lab.command("notebook:run-all-cells")
            lab.notebook.locator(".jp-OutputArea img").nth(1).wait_for()
            yield lab
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def slider_of(output: Locator) -> Locator:
    """Return the slider of the angle."""
    return output.get_by_role("slider").nth(1)


def press(output: Locator, ticks: int) -> list[float]:
    """Press the arrow key, each time after the last redraw; return the times in ms."""
    times = []
    for _ in range(ticks):
        output.evaluate(WATCH)
        slider_of(output).press("ArrowRight")
        times.append(output.page.evaluate("window.tick"))
    return times
