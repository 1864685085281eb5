"""The machine in motion in a real Chromium: as a picture, and with its player in JupyterLab."""

import base64
import io
import re
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import nbformat
import numpy as np
import pytest
from lab import ROOT, LabPage, calm, opened_notebook
from machines import RULE
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect
from test_animation import AFTER, BEFORE, COLLIDING, MACHINES

import cammotion as cm
from cammotion.views.animation.picture import animate

WORK = "work-animation-test"
NOTEBOOK = "motion.ipynb"
CELLS = (
    """\
import cammotion as cm
from cammotion.views.animation.picture import animate
mill = cm.indexing_motion("mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
die = cm.motion(
    "die",
    *(cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=55), cm.dwell(150)),
    start_deg=150,
)
before = cm.TimingDiagram([mill, die], rate_per_hour=2000)
rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
after = cm.widest_move(before, "die", rule).diagram""",
    'player = animate({"no overlap": before, "overlap": after}, rules=rule).player()\nplayer',
    "print(f'now at {player.angle_deg:.3f} deg')",
    "player.angle_deg = 255",
)
DESIGNS = (BEFORE, AFTER)
ANGLES = (0, 75, 140, 205, 255, 330, 359)
TOLERANCE_PX = 0.5
IMAGES = sorted((ROOT / "notebooks" / "images").glob("*.svg"))
MOVING_IMAGES = [path for path in IMAGES if "<animate" in path.read_text("utf-8")]
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"

# Where the parts of the drawing are, in the page's pixels, and how large those of the drawing are.
PLACES = """drawing => [...drawing.querySelectorAll('[data-design]')].map(column => {
  const box = part => column.querySelector(part).getBoundingClientRect();
  const frame = drawing.getBoundingClientRect();
  const turret = column.querySelector('[data-part=turret]').getScreenCTM();
  return {
    die: box('[data-part=body][data-motion="1"] rect:nth-of-type(2)').bottom - frame.top,
    cursor: box('[data-part=cursor] > path').x - frame.left,
    mill: Math.atan2(turret.b, turret.a) * 180 / Math.PI,
    scale: drawing.getScreenCTM().a,
    perMm: Number(column.querySelector('[data-part=body]').dataset.pxPerMm),
  };
})"""


def places(drawing: Locator) -> list[dict[str, float]]:
    found: list[dict[str, float]] = drawing.evaluate(PLACES)
    return found


def assert_at(angle: float, now: list[dict[str, float]], at_zero: list[dict[str, float]]) -> None:
    """Assert that both designs stand at a cam angle, as the package's formulas say."""
    for diagram, here, there in zip(DESIGNS, now, at_zero, strict=True):
        way = diagram["die"].position_mm(angle) - diagram["die"].position_mm(0)
        wanted = way * here["perMm"] * here["scale"]
        assert here["die"] - there["die"] == pytest.approx(wanted, abs=TOLERANCE_PX)
        turned = 360 / 24 / 100 * diagram["mill"].position_mm(angle)
        assert here["mill"] == pytest.approx(turned, abs=0.2)
    cursors = [here["cursor"] - there["cursor"] for here, there in zip(now, at_zero, strict=True)]
    assert cursors[0] == pytest.approx(cursors[1], abs=TOLERANCE_PX)


@pytest.fixture(scope="module")
def drawing(browser: Browser) -> Iterator[Locator]:
    """Show the drawing in a page, its clock stopped."""
    page = browser.new_page(viewport={"width": 900, "height": 700})
    page.set_content(animate({"no overlap": BEFORE, "overlap": AFTER}, rules=RULE).svg)
    found = page.locator("svg[role=img]")
    found.evaluate("drawing => drawing.pauseAnimations()")
    yield found
    page.close()


def set_angle(drawing: Locator, angle: float) -> None:
    drawing.evaluate("(drawing, seconds) => drawing.setCurrentTime(seconds)", angle / 360 * 9)


def test_both_designs_are_where_the_formulas_say(drawing: Locator) -> None:
    set_angle(drawing, 0)
    at_zero = places(drawing)
    for angle in ANGLES:
        set_angle(drawing, angle)
        now = places(drawing)
        assert_at(angle, now, at_zero)
        way = now[0]["cursor"] - at_zero[0]["cursor"]
        if angle:
            assert way / angle == pytest.approx(0.75, abs=0.1)  # px per deg


@pytest.mark.parametrize(("diagram", "rules"), MACHINES)
def test_no_text_covers_another_or_leaves_the_drawing(
    browser: Browser, diagram: cm.TimingDiagram, rules: Any
) -> None:
    page = browser.new_page(viewport={"width": 900, "height": 1300})
    page.set_content(animate({"one": diagram, "two": diagram}, rules=rules).svg)
    drawing = page.locator("svg[role=img]")
    boxes: list[dict[str, Any]] = drawing.evaluate(
        """drawing => [...drawing.querySelectorAll('text')].map(text => {
          const {left, right, top, bottom} = text.getBoundingClientRect();
          return {text: text.firstChild.data, left, right, top, bottom};
        })"""
    )
    frame = drawing.bounding_box()
    assert frame is not None
    assert len(boxes) > 40
    for box in boxes:
        assert frame["x"] <= box["left"] <= box["right"] <= frame["x"] + frame["width"], box
        others = [other["text"] for other in boxes if other is not box and do_overlap(box, other)]
        assert not others, box["text"]
    page.close()


def do_overlap(one: dict[str, Any], other: dict[str, Any]) -> bool:
    across: float = min(one["right"], other["right"]) - max(one["left"], other["left"])
    down: float = min(one["bottom"], other["bottom"]) - max(one["top"], other["top"])
    return across > 1 and down > 4  # a line of text has some room above and below it


def test_a_collision_is_seen_while_it_lasts(browser: Browser) -> None:
    page = browser.new_page()
    page.set_content(animate(COLLIDING, rules=RULE).svg)
    drawing = page.locator("svg[role=img]")
    drawing.evaluate("drawing => drawing.pauseAnimations()")
    word = drawing.get_by_text("RULE BROKEN", exact=True)
    for angle, is_seen in ((125, False), (127, True), (134, True), (136, False)):
        set_angle(drawing, angle)
        expect(word).to_be_visible(visible=is_seen)
    page.close()


def frames_of(page: Page, count: int, pause_ms: int) -> list[Any]:
    """Return pictures of the page, one after the other."""
    shots = []
    for _ in range(count):
        page.wait_for_timeout(pause_ms)
        shots.append(np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("L")))
    return shots


def show_as_image(page: Page, svg: str) -> None:
    picture = base64.b64encode(svg.encode()).decode()
    page.set_content(f'<img src="data:image/svg+xml;base64,{picture}">')
    page.locator("img").evaluate("image => image.decode()")


def test_a_picture_moves_by_itself(browser: Browser) -> None:
    page = browser.new_page(viewport={"width": 900, "height": 700})
    show_as_image(page, animate(BEFORE, rules=RULE).svg)
    assert all((one != other).any() for one, other in pairwise(frames_of(page, 3, 300)))
    page.close()


@pytest.fixture(scope="module")
def calm_page(browser: Browser) -> Iterator[Page]:
    with calm(browser) as started:
        yield started.new_page(viewport={"width": 900, "height": 700})


@pytest.mark.parametrize("path", MOVING_IMAGES, ids=lambda path: path.stem)
def test_a_picture_of_a_lesson_stands_still_for_a_reader_who_wants_that(
    calm_page: Page, path: Path
) -> None:
    show_as_image(calm_page, path.read_text("utf-8"))
    first, later = frames_of(calm_page, 2, 400)
    assert (first == later).all()


def test_a_picture_stands_at_0_deg_for_a_reader_who_wants_that(calm_page: Page) -> None:
    """It is the same picture as with no animation elements in it."""
    svg = animate({"overlap": AFTER, "too early": COLLIDING}, rules=RULE).svg
    show_as_image(calm_page, svg)
    first, later = frames_of(calm_page, 2, 400)
    assert (first == later).all()
    calm_page.set_content("<body></body>")
    calm_page.evaluate(
        """svg => {
          const drawing = new DOMParser().parseFromString(svg, 'image/svg+xml');
          drawing.querySelectorAll('animate, animateTransform').forEach(e => e.remove());
          const image = new Image();
          image.src = 'data:image/svg+xml,'
            + encodeURIComponent(new XMLSerializer().serializeToString(drawing));
          document.body.append(image);
          return image.decode();
        }""",
        svg,
    )
    (still,) = frames_of(calm_page, 1, 100)
    assert (first == still).all()


@pytest.fixture(scope="module")
def opened(browser: Browser, tmp_path_factory: pytest.TempPathFactory) -> Iterator[LabPage]:
    """Open a notebook with the player in JupyterLab, and do not run it yet."""
    folder = ROOT / WORK
    folder.mkdir(exist_ok=True)
    write_notebook(folder / NOTEBOOK)
    home = tmp_path_factory.mktemp("jupyter")
    with opened_notebook(browser, home, WORK, NOTEBOOK) as lab:
        yield lab


@pytest.fixture(scope="module")
def lab(opened: LabPage) -> Iterator[LabPage]:
    """Run the notebook's cells but the last one; nothing may go wrong from then on."""
    for _ in CELLS[:-1]:
        opened.command("notebook:run-cell-and-select-next")
    yield opened
    assert opened.troubles() == []
    assert opened.complaints == []


def write_notebook(path: Path) -> None:
    """Write the notebook as it is stored: with the picture, without a widget."""
    cells = [nbformat.v4.new_code_cell(source) for source in CELLS]  # type: ignore[no-untyped-call]
    stored, _ = animate({"no overlap": BEFORE, "overlap": AFTER}, rules=RULE)._repr_mimebundle_()
    del stored[WIDGET_VIEW]
    cells[1]["outputs"] = [nbformat.v4.new_output("execute_result", stored)]  # type: ignore[no-untyped-call]
    kernel = {"name": "python3", "display_name": "Python 3"}
    notebook = nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": kernel})  # type: ignore[no-untyped-call]
    nbformat.write(notebook, path)  # type: ignore[no-untyped-call]


class PlayerOutput:
    """The player as the page shows it."""

    def __init__(self, lab: LabPage) -> None:
        output = lab.output_of('"no overlap"')
        self.drawing = output.get_by_role("img", name="The machine in motion: no overlap, overlap")
        self.play = output.get_by_role("button", name="Play", exact=True)
        self.pause = output.get_by_role("button", name="Pause", exact=True)
        self.slider = output.get_by_role("slider", name="cam angle in deg")
        self.speed = output.get_by_role("combobox", name="speed")
        self.status = output.get_by_role("status")
        self.lab = lab

    def stop(self) -> None:
        """Pause it if it plays."""
        expect(self.play.or_(self.pause)).to_be_visible()
        if self.pause.is_visible():
            self.pause.click()
        expect(self.play).to_be_visible()

    def told_angle(self) -> float:
        """Run the cell that prints the angle; return it."""
        cell = self.lab.notebook.locator(".jp-CodeCell", has_text="now at")
        cell.locator(".cm-content").click()
        self.lab.command("notebook:run-cell")
        text = cell.locator(".jp-OutputArea-output").inner_text()
        return float(text.split()[2])


@pytest.fixture
def player(lab: LabPage) -> PlayerOutput:
    """Stop the player at 0 deg."""
    found = PlayerOutput(lab)
    found.stop()
    found.slider.press("Home")
    expect(found.status).to_have_text("cam angle 0°")
    return found


def test_a_stored_notebook_shows_the_moving_picture_before_it_is_run(opened: LabPage) -> None:
    """Nobody has said yet that the notebook is to be trusted."""
    image = opened.output_of('"no overlap"').get_by_role("img")
    expect(image).to_have_attribute("alt", re.compile("^The machine in motion, 1.8 s a turn"))
    image.scroll_into_view_if_needed()
    assert image.evaluate("image => image.decode().then(() => image.naturalWidth)") == 860
    assert image.screenshot() != image.screenshot()


def test_it_plays_at_first(lab: LabPage) -> None:
    """Nobody has asked for less motion here."""
    found = PlayerOutput(lab)
    expect(found.pause).to_be_visible()
    before = places(found.drawing)
    lab.page.wait_for_timeout(400)
    assert places(found.drawing) != before


def test_the_slider_scrubs_by_keyboard(player: PlayerOutput) -> None:
    at_zero = places(player.drawing)
    for key, angle in (
        ("ArrowRight", 1),
        ("ArrowUp", 2),
        ("ArrowLeft", 1),
        ("PageUp", 37),
        ("End", 360),
        ("Home", 0),
    ):
        player.slider.press(key)
        expect(player.status).to_have_text(f"cam angle {angle}°")
        expect(player.slider).to_have_attribute("aria-valuetext", f"{angle} deg")
        assert_at(min(angle, 359.96), places(player.drawing), at_zero)
    assert player.slider.evaluate("slider => slider === document.activeElement")


def test_the_drawing_follows_the_slider(player: PlayerOutput) -> None:
    at_zero = places(player.drawing)
    for angle in ANGLES:
        player.slider.fill(str(angle))
        assert_at(angle, places(player.drawing), at_zero)


def test_play_moves_and_pause_stops(player: PlayerOutput) -> None:
    player.play.press("Enter")
    expect(player.pause).to_be_focused()
    expect(player.status).to_have_attribute("aria-live", "off")  # not read out at each frame
    expect(player.status).not_to_have_text("cam angle 0°")
    player.pause.press("Space")
    expect(player.status).to_have_attribute("aria-live", "polite")
    stopped = places(player.drawing)
    player.lab.page.wait_for_timeout(300)
    assert places(player.drawing) == stopped


def test_the_speed_is_that_of_the_choice(player: PlayerOutput) -> None:
    shown = player.speed.locator("option").all_inner_texts()
    assert shown[0] == "1/20 (36 s a turn)"
    assert shown[-1] == "real time (1.8 s a turn)"
    expect(player.speed).to_have_value("0.2")
    turned = {}
    for speed in ("0.05", "0.5"):
        player.speed.select_option(speed)
        player.slider.press("Home")
        turned[speed] = player.play.evaluate(
            """async button => {
              const slider = button.parentElement.querySelector('input');
              button.click();
              const frame = () => new Promise(requestAnimationFrame);
              await frame(); await frame();
              const start = performance.now(), from = slider.valueAsNumber;
              let now = start;
              while (now - start < 900) now = await frame();
              button.click();
              return (slider.valueAsNumber - from) / (now - start) * 1800;
            }"""
        )
    player.speed.select_option("0.2")
    for speed, degrees in turned.items():
        assert degrees / 360 == pytest.approx(float(speed), rel=0.1, abs=0.01)


def test_python_hears_of_pause_and_scrub_and_can_set_the_angle(player: PlayerOutput) -> None:
    at_zero = places(player.drawing)
    player.slider.press("PageUp")
    assert player.told_angle() == 36
    cell = player.lab.notebook.locator(".jp-CodeCell", has_text="player.angle_deg = 255")
    cell.locator(".cm-content").click()
    player.lab.command("notebook:run-cell")
    expect(player.status).to_have_text("cam angle 255°")
    assert_at(255, places(player.drawing), at_zero)


def test_the_focus_is_seen(player: PlayerOutput) -> None:
    for control in (player.play, player.slider, player.speed):
        control.focus()
        player.lab.page.keyboard.press("Shift")
        outline = control.evaluate("control => getComputedStyle(control).outlineStyle")
        assert outline == "solid"


def test_a_second_view_clips_for_itself(player: PlayerOutput) -> None:
    """Every drawing in the page refers to a clip of its own."""
    clips = player.drawing.evaluate(
        """drawing => [...drawing.querySelectorAll('[clip-path]')]
          .map(clipped => clipped.getAttribute('clip-path'))"""
    )
    ids = player.drawing.evaluate(
        "drawing => [...drawing.querySelectorAll('clipPath')].map(e => `url(#${e.id})`)"
    )
    assert set(clips) == set(ids)
    assert all(len(name) > len("url(#cm-panel-406-206)") for name in ids)


def test_less_motion_starts_it_paused(player: PlayerOutput) -> None:
    """The widget is shown anew to a reader who wants less motion; then the controls decide."""
    player.lab.page.emulate_media(reduced_motion="reduce")
    try:
        cell = player.lab.notebook.locator(".jp-CodeCell", has_text='"no overlap"')
        cell.locator(".cm-content").click()
        player.lab.command("notebook:run-cell")
        fresh = PlayerOutput(player.lab)
        expect(fresh.play).to_be_visible()
        at_zero = places(fresh.drawing)
        player.lab.page.wait_for_timeout(300)
        assert places(fresh.drawing) == at_zero
        fresh.slider.fill("205")
        assert_at(205, places(fresh.drawing), at_zero)
    finally:
        player.lab.page.emulate_media(reduced_motion="no-preference")
