"""How quick and how large a live figure is, beside the same explorer drawn by the kernel."""

import json
import statistics
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from execution import make_notebook, write_notebook
from findings import Finding, percentile_95, ratio_of_medians, say
from playwright.sync_api import Browser, Locator

ROOT = Path(__file__).parent.parent
sys.path.append(str(ROOT / "tests"))

from lab import LabPage, opened_notebook, running_browser  # noqa: E402

WORK = "work-benchmark"
NOTEBOOK, LESSON = "ticks.ipynb", "02_maximum_acceleration.ipynb"
ROUNDS, TICKS = 20, 10  # over the angle's whole range, so that changes of the axes have their share
FIRST_PICTURES = 15
ANGLE, PRIME = 1, 0  # which slider of notebook 02's figure, and of 07's
IMPORTS = f"""\
import sys
sys.path.insert(0, {str(Path(__file__).parent)!r})
import cammotion as cm
from blitting import BlittedExplorer
die = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
for make in (cm.explore_move, BlittedExplorer):
    make(die)._repr_mimebundle_()  # what has to be loaded is loaded"""
OWN_CELL, RIVAL_CELL = "cm.explore_move(die)", "BlittedExplorer(die)"
OWN_PICTURE, RIVAL_PICTURE = ".cm-columns path.cm-own[d]", "img"
# from a key press to the picture: the curve's path, or another image that has been decoded
WATCH = """output => {
  const image = () => output.querySelector('img')?.src;
  const before = image();
  window.tick = new Promise(done => {
    let pressed;
    output.addEventListener('keydown', () => { pressed = performance.now(); },
      {capture: true, once: true});
    const watcher = new MutationObserver(async () => {
      if (image() === before && before) return;
      watcher.disconnect();
      await output.querySelector('img')?.decode();
      done(performance.now() - pressed);
    });
    watcher.observe(output, {subtree: true, attributeFilter: before ? ['src'] : ['d']});
  });
}"""
# from the command to run a cell to its first picture
FIRST = """async ([picture, number]) => {
  const notebook = jupyterapp.shell.currentWidget.content;
  notebook.activeCellIndex = number;
  await jupyterapp.commands.execute('notebook:clear-cell-output');
  const cell = notebook.widgets[number].node, begun = performance.now();
  const seen = new Promise(done => {
    const look = async () => {
      const found = cell.querySelector(picture);
      if (!found) return requestAnimationFrame(look);
      await found.decode?.();
      done(performance.now() - begun);
    };
    look();
  });
  await jupyterapp.commands.execute('notebook:run-cell');
  return await seen;
}"""


def measure_live() -> list[Finding]:
    """Press arrow keys on a live figure and on one drawn by the kernel; weigh page and notebook."""
    with running_browser() as browser:
        return [*_in_lab(browser), *_in_page(browser), *_growth(browser), *_sizes()]


def _in_lab(browser: Browser) -> list[Finding]:
    times: dict[str, list[float]] = {"own": [], "rival": []}
    first: dict[str, list[float]] = {"own": [], "rival": []}
    with open_notebook(browser, NOTEBOOK, IMPORTS, OWN_CELL, RIVAL_CELL) as lab:
        outputs = {"own": lab.output_of(OWN_CELL), "rival": lab.output_of(RIVAL_CELL)}
        for _ in range(FIRST_PICTURES):
            first["own"].append(lab.page.evaluate(FIRST, [OWN_PICTURE, 1]))
            first["rival"].append(lab.page.evaluate(FIRST, [RIVAL_PICTURE, 2]))
            lab.settle()
        for output in outputs.values():
            slider_of(output).press("Home")
        lab.settle()
        for number in range(ROUNDS):
            say(f"keys in JupyterLab, round {number + 1} of {ROUNDS}")
            for whose, output in outputs.items():
                times[whose] += press(output, TICKS)
    for whose, taken in first.items():
        say(f"first picture, {whose}: {', '.join(f'{time:.0f}' for time in taken)} ms")
    own, rival = times["own"], times["rival"]
    for whose, taken in times.items():
        say(f"{whose}: median {statistics.median(taken):.1f}, 95 % {percentile_95(taken):.1f} ms")
    what = "key to picture in JupyterLab"
    faster = "times faster than drawn by the kernel"
    return [
        Finding(f"{what}: median", statistics.median(own), 8, "ms"),
        Finding(f"{what}: 95th percentile", percentile_95(own), 30, "ms"),
        Finding(f"{what}: {faster}, medians", ratio_of_medians(rival, own), 10, "x", True),
        Finding(
            f"{what}: {faster}, 95th",
            percentile_95(rival) / percentile_95(own),
            10,
            "x",
            True,
        ),
        Finding(
            "first picture of a cell that ran, against the kernel's",
            ratio_of_medians(first["own"], first["rival"]),
            1,
            "x",
        ),
    ]


def _in_page(browser: Browser) -> list[Finding]:
    from cammotion import EXAMPLE, LAWS, Move, explore_cam, explore_move

    move = Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    times, size = _keys_in_page(browser, explore_move(move, laws=LAWS), ANGLE)
    cam, _ = _keys_in_page(browser, explore_cam(EXAMPLE.die), PRIME)
    return [
        Finding("key to picture in a page: median", statistics.median(times), 8, "ms"),
        Finding("key to picture in a page: 95th percentile", percentile_95(times), 16, "ms"),
        Finding("page of notebook 02's figure, all laws", size / 1000, 30, "kB"),
        Finding("key to picture, the cam of notebook 07: median", statistics.median(cam), 16, "ms"),
    ]


def _keys_in_page(browser: Browser, figure: Any, number: int) -> tuple[list[float], int]:
    """Return the times in ms from a key on a slider to the picture, and the bytes of the page."""
    with tempfile.TemporaryDirectory() as folder:
        path = figure.save(Path(folder) / "figure.html")
        page = browser.new_context(offline=True).new_page()
        page.goto(path.as_uri())
        output = page.locator("main")
        slider_of(output, number).press("Home")
        times = press(output, ROUNDS * TICKS, number)
        page.context.close()
        return times, path.stat().st_size


def _growth(browser: Browser) -> list[Finding]:
    """Run notebook 02 whole, explore in it, save it, and do all of it again."""
    with running_workbook(browser, LESSON) as lab:
        stored = (ROOT / "notebooks" / LESSON).stat().st_size
        for _ in range(2):
            lab.command("notebook:run-all-cells")
            press(lab.output_of("cm.explore([h, v, a]"), TICKS)
            lab.settle()
            lab.command("docmanager:save")
        saved = (ROOT / WORK / LESSON).stat().st_size
    return [
        Finding("notebook 02 run, explored and saved, against stored", saved / stored, 1.2, "x")
    ]


def _sizes() -> list[Finding]:
    import cammotion as cm

    curves = cm.choice("law", {name: (law.s, law.v, law.a) for name, law in cm.LAWS.items()})
    figure = cm.explore(list(curves), cm.x)
    size = len(json.dumps(figure.description).encode())
    return [Finding(f"description of S, V, A of {len(cm.LAWS)} laws", size / 1000, 40, "kB")]


@contextmanager
def open_notebook(browser: Browser, name: str, *cells: str) -> Iterator[LabPage]:
    """Open a notebook of these cells in JupyterLab, and run it."""
    folder = ROOT / WORK
    folder.mkdir(exist_ok=True)
    write_notebook(make_notebook(*cells), folder / name)
    with running_workbook(browser, name) as lab:
        lab.command("notebook:run-all-cells")
        lab.notebook.locator(OWN_PICTURE).first.wait_for()
        yield lab


@contextmanager
def running_workbook(browser: Browser, name: str) -> Iterator[LabPage]:
    """Open a notebook of the folder for benchmarks, which is removed afterwards."""
    with (
        tempfile.TemporaryDirectory() as home,
        opened_notebook(browser, Path(home), WORK, name) as lab,
    ):
        yield lab


def slider_of(output: Locator, number: int = ANGLE) -> Locator:
    """Return a slider by its number, from 0 on; that of the angle unless given."""
    return output.get_by_role("slider").nth(number)


def press(output: Locator, ticks: int, number: int = ANGLE) -> list[float]:
    """Press the arrow key, each time after the last picture; return the times in ms."""
    times = []
    for _ in range(ticks):
        output.evaluate(WATCH)
        slider_of(output, number).press("ArrowRight")
        times.append(output.page.evaluate("window.tick"))
    return times
