"""The player of the machine in motion, in a notebook of JupyterLab."""

import re
from collections.abc import Iterator
from pathlib import Path

import nbformat
import pytest
from lab import ROOT, LabPage
from machines import RULE
from moving_drawing import ANGLES, assert_at, places
from playwright.sync_api import expect
from test_animation import AFTER, BEFORE

from cammotion.views.animation.picture import animate

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
WIDGET_VIEW = "application/vnd.jupyter.widget-view+json"


@pytest.fixture(scope="module")
def opened(jupyter: LabPage) -> LabPage:
    """Open a notebook with the player, and do not run it yet."""
    write_notebook(ROOT / jupyter.work / NOTEBOOK)
    jupyter.open(NOTEBOOK)
    return jupyter


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
