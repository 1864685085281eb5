"""A learner works through notebook 03 in JupyterLab: the explorer and the exercises."""

import json
import re
from collections.abc import Iterator
from io import BytesIO

import numpy as np
import pytest
from lab import ROOT, LabPage, type_into
from machines import RULE, make_diagram
from PIL import Image
from playwright.sync_api import Locator, expect

import cammotion as cm

LESSON = "03_overlap.ipynb"
EIGHT_EM = 8 * 13
BLACK, WHITE = 60, 220  # of 255: nearly
THEME = "theme => jupyterapp.commands.execute('apputils:change-theme', {theme})"


@pytest.fixture(scope="module")
def ran(jupyter: LabPage) -> LabPage:
    """Open notebook 03, and run all its cells."""
    jupyter.open(LESSON)
    jupyter.command("notebook:run-all-cells")
    return jupyter


@pytest.fixture
def lesson(ran: LabPage) -> Iterator[LabPage]:
    """Give the lesson, in which nothing may go wrong."""
    yield ran
    assert ran.troubles() == []
    assert ran.complaints == []


@pytest.fixture
def output(lesson: LabPage) -> Locator:
    """Give the output of the explorer."""
    return lesson.output_of("cm.explore_overlap(")


def set_to(output: Locator, name: str, value: float) -> None:
    type_into(output.get_by_role("textbox", name=name), f"{value:g}")


def test_the_widest_move_is_found_by_a_button(output: Locator) -> None:
    die = output.locator(".cm-columns path.cm-own").nth(1)
    before = die.get_attribute("d")
    output.get_by_role("button", name="Widest move of the die").press("Enter")
    widest = cm.widest_move(make_diagram(), "die", RULE)
    expect(output.get_by_role("status")).to_contain_text(f"die: {widest.angle_deg:.5g} deg")
    expect(output.get_by_role("status")).to_contain_text("The rule is kept.")
    assert die.get_attribute("d") != before


def test_a_collision_turns_up_at_once_and_is_named(output: Locator) -> None:
    set_to(output, "die: angle Bm, deg", 130)
    set_to(output, "die: start, deg", 75)
    status = output.get_by_role("status")
    expect(status).to_contain_text("RULE BROKEN: the die is 2.14 mm too deep at")
    for mark in output.locator(".cm-columns path.cm-alarm").all():
        assert mark.get_attribute("d")
    angle = output.get_by_role("slider").first
    angle.press("Home")
    expect(status).to_contain_text("die: 20 deg")
    angle.press("ArrowRight")
    expect(status).to_contain_text("die: 20.5 deg")


def test_every_control_has_a_name(output: Locator) -> None:
    for name in ("die: angle Bm, deg", "die: start, deg", "mill: angle, deg"):
        for role in ("textbox", "slider"):
            expect(output.get_by_role(role, name=name)).to_be_visible()
    expect(output.get_by_role("combobox", name="margin")).to_be_visible()


def kept_by(lab: LabPage) -> dict[str, dict[str, dict[str, object]]]:
    """Read the learner's progress off the disk."""
    content: dict[str, dict[str, dict[str, object]]] = json.loads(
        (ROOT / lab.work / "progress.json").read_text("utf-8")
    )
    return content


def test_every_picture_has_words_and_none_is_a_white_slab_in_the_dark(lesson: LabPage) -> None:
    pictures = lesson.notebook.locator("img")
    assert pictures.count() > len(("the machine", "three plots"))
    for picture in pictures.all():
        expect(picture).to_have_attribute("alt", re.compile(r"\w"))
    cards = lesson.notebook.locator("div.cm-paper").filter(visible=True)
    shown = [pictures.first, lesson.output_of("cm.plot_clearance(").locator("img"), cards.first]
    dark = [_brightness_in("JupyterLab Dark", lesson, one) for one in shown]
    light = [_brightness_in("JupyterLab Light", lesson, one) for one in shown]
    assert max(dark) < BLACK
    assert min(light) > WHITE


def _brightness_in(theme: str, lesson: LabPage, shown: Locator) -> float:
    """Return how bright most of an element is with a theme, from 0 to 255."""
    lesson.page.evaluate(THEME, theme)
    attribute = re.compile("false" if "Dark" in theme else "true")
    expect(lesson.page.locator("body")).to_have_attribute("data-jp-theme-light", attribute)
    picture = Image.open(BytesIO(shown.screenshot())).convert("L")
    return float(np.median(np.asarray(picture)))


def test_a_choice_is_made_by_keyboard_and_answered_with_a_reason(lesson: LabPage) -> None:
    control = lesson.output_of('cm.choose("03.6")')
    expect(control.get_by_role("status")).to_have_count(0)  # nothing is chosen beforehand
    wrong = control.get_by_role("button", name="(b) The left edge of the forbidden region")
    right = control.get_by_role("button", name="(a) The lower edge of the forbidden region")
    wrong.press("Space")
    said = control.get_by_role("status")
    expect(said).to_contain_text("03.6: Not yet. The left edge says how exactly the mill")
    wrong.press("Shift+Tab")
    expect(right).to_be_focused()
    right.press("Enter")
    expect(said).to_contain_text("03.6: Right. Safety has a price")
    assert kept_by(lesson)["exercises"]["03.6"]["state"] == "right"


def test_a_prediction_opens_the_answer_that_run_all_has_folded(lesson: LabPage) -> None:
    """Also where its cell was run again before something was typed into its field."""
    reveal = lesson.output_of("share_guess.reveal(")
    answer = reveal.get_by_text("0.645 % of the stroke.")
    expect(reveal.get_by_text("Show the answer (you made no prediction yet)")).to_be_visible()
    expect(answer).to_be_hidden()
    cell = lesson.notebook.locator(".jp-CodeCell", has_text='cm.predict("03.share"')
    cell.locator(".cm-content").click()
    lesson.command("notebook:run-cell")
    field = cell.get_by_label("I predict, percent of the stroke:")
    expect(field).to_have_value("")
    field.press_sequentially("3 percent")
    lesson.settle()
    expect(answer).to_be_hidden()  # it may be half of a number
    field.press("Enter")
    expect(reveal).to_contain_text("You predicted 3 percent: 4.7 times too much.")
    expect(answer).to_be_visible()
    assert kept_by(lesson)["predictions"]["03.share"]["text"] == "3 percent"


def test_an_answer_without_a_prediction_is_shown_on_wish(lesson: LabPage) -> None:
    reveal = lesson.output_of("widest_guess.reveal(")
    answer = reveal.get_by_text("The die may move over 124.84 degrees.")
    expect(answer).to_be_hidden()
    summary = reveal.locator("summary")
    summary.press("Enter")
    expect(answer).to_be_visible()
    summary.press("Space")
    expect(answer).to_be_hidden()


@pytest.mark.parametrize("width", [250, 900])
def test_the_field_of_a_prediction_is_wide_enough_and_on_the_page(
    lesson: LabPage, width: int
) -> None:
    """Also in what a page of 360 px leaves for an output, with the longest label."""
    output = lesson.output_of('cm.predict("03.widest"').locator(".jp-OutputArea-output")
    output.evaluate("(box, px) => { box.style.width = box.style.flex = `0 0 ${px}px`; }", width)
    for part in (output.get_by_role("textbox"), output.get_by_text("I predict")):
        inner, outer = part.bounding_box(), output.bounding_box()
        assert inner
        assert outer
        assert inner["width"] >= EIGHT_EM
        assert outer["x"] <= inner["x"]
        assert inner["x"] + inner["width"] <= outer["x"] + outer["width"]


def test_an_answer_is_checked_where_it_stands(lesson: LabPage) -> None:
    cell = lesson.notebook.locator(".jp-CodeCell", has_text="answer_1 = None")
    cell.locator(".cm-content").click()
    lesson.page.keyboard.press("ControlOrMeta+a")
    lesson.page.keyboard.type("answer_1 = 13")
    for _ in range(2):
        lesson.command("notebook:run-cell-and-select-next")
    said = lesson.output_of('cm.check("03.1"').get_by_role("status")
    expect(said).to_contain_text("03.1: Not yet. This would be so at constant velocity.")
