"""A learner overlaps mill and die in the explorer of notebook 03, in JupyterLab."""

import shutil
from collections.abc import Iterator

import pytest
from lab import ROOT, LabPage, require_chromium, running_browser, running_lab
from machines import RULE, make_diagram
from playwright.sync_api import Locator, expect

import cammotion as cm

WORK = "work-overlap-test"
LESSON = "03_overlap.ipynb"


@pytest.fixture(scope="module")
def ran(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LabPage]:
    """Open notebook 03 by the link of notebook 00, and run all its cells."""
    require_chromium()
    home = tmp_path_factory.mktemp("jupyter")
    try:
        with running_browser() as browser, running_lab(home, WORK) as address:
            lab = LabPage(browser, address)
            lab.wait_for("00_start_here.ipynb")
            lab.notebook.get_by_role("link", name="03 Overlap").click()
            lab.wait_for(LESSON)
            lab.command("notebook:run-all-cells")
            yield lab
    finally:
        shutil.rmtree(ROOT / WORK, ignore_errors=True)


@pytest.fixture
def output(ran: LabPage) -> Iterator[Locator]:
    """Give the output of the explorer; nothing may go wrong while it is used."""
    yield ran.output_of("cm.explore_overlap(")
    assert ran.troubles() == []
    assert ran.complaints == []


def set_to(output: Locator, name: str, value: float) -> None:
    field = output.get_by_label(name)
    field.fill(f"{value:g}")
    field.press("Enter")


def test_the_widest_move_is_found_by_a_button(output: Locator) -> None:
    picture = output.get_by_role("img")
    before = picture.screenshot()
    output.get_by_role("button", name="Widest move of the die").press("Enter")
    widest = cm.widest_move(make_diagram(), "die", RULE)
    expect(output.get_by_role("status")).to_contain_text(f"die: {widest.angle_deg:.5g} deg")
    expect(output.get_by_role("status")).to_contain_text("No collision.")
    assert picture.screenshot() != before


def test_a_collision_turns_up_at_once_and_is_named(output: Locator) -> None:
    set_to(output, "die: angle Bm, deg", 130)
    set_to(output, "die: start, deg", 75)
    status = output.get_by_role("status")
    expect(status).to_contain_text("COLLISION: the die is 2.14 mm too deep at 15.038 deg")
    angle = output.get_by_role("slider").first
    angle.press("Home")
    expect(status).to_contain_text("die: 20 deg")
    angle.press("ArrowRight")
    expect(status).to_contain_text("die: 20.5 deg")
    assert output.get_by_role("img").evaluate("image => image.naturalWidth") == 940


def test_every_control_has_a_name(output: Locator) -> None:
    for name in ("die: angle Bm, deg", "die: start, deg", "mill: angle, deg", "margin, mm"):
        expect(output.get_by_label(name)).to_be_visible()
