"""What only a browser shows: a learner works through notebook 02 in JupyterLab, and comes back."""

from collections.abc import Iterator

import pytest
from lab import LabPage, opened_lesson
from playwright.sync_api import Locator, expect

import cammotion as cm

WORK = "work-browser-test"
LESSON = "02_maximum_acceleration.ipynb"
STROKE, ANGLE, RATE = 50.0, 55.0, 2000.0  # the die, where every explorer of the lesson starts

expect.set_options(timeout=10_000)


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LabPage]:
    """Notebook 02, reached by the starter's address and notebook 00's link, and not run yet."""
    home = tmp_path_factory.mktemp("jupyter")
    with opened_lesson(home, WORK, "02 Maximum acceleration", LESSON) as lab:
        yield lab


@pytest.fixture(scope="module")
def ran(opened: LabPage) -> LabPage:
    """Notebook 02 with all its cells run."""
    opened.command("notebook:run-all-cells")
    return opened


@pytest.fixture
def lesson(ran: LabPage) -> Iterator[LabPage]:
    """Notebook 02 with all its cells run, in which nothing may go wrong."""
    yield ran
    assert ran.troubles() == []
    assert ran.complaints == []


class ExplorerOutput:
    """The explorer of notebook 02 as the page shows it."""

    def __init__(self, lab: LabPage) -> None:
        output = lab.output_of("cm.explore_move(")
        self.picture = output.get_by_role("img")
        self.text = output.get_by_role("status")
        self.angle = output.get_by_label("angle Bm, deg")
        self.angle_slider = output.get_by_role("slider").nth(1)
        self.pin = output.get_by_role("button", name="Pin this design as the reference")

    def set_angle(self, degrees: float) -> None:
        """Type an angle, and wait until the text follows."""
        self.angle.fill(f"{degrees:g}")
        self.angle.press("Enter")
        expect(self.text).to_contain_text(
            f"your design: tm = {cm.indexing_time(degrees, RATE):.4g}"
        )

    def expect_design(self, degrees: float, reference_degrees: float = ANGLE) -> None:
        """Expect the numbers that the package computes for the design."""
        peak = cm.peak_acceleration(STROKE, degrees, RATE)
        ratio = peak / cm.peak_acceleration(STROKE, reference_degrees, RATE)
        expect(self.angle).to_have_value(f"{degrees:g}")
        expect(self.text).to_contain_text(f"a_max = {peak:.4g} m/s²")
        expect(self.text).to_contain_text(f"ratio of the peaks: {ratio:.4g} =")


def assert_drawn(picture: Locator) -> None:
    """Assert that the picture is there and has been loaded."""
    expect(picture).to_be_visible()
    assert picture.evaluate("image => image.decode().then(() => image.naturalWidth)") > 400


def test_a_fresh_copy_shows_the_explorer_before_it_is_run(opened: LabPage) -> None:
    assert_drawn(ExplorerOutput(opened).picture)
    assert opened.troubles() == []


def test_all_cells_run(lesson: LabPage) -> None:
    explorer = ExplorerOutput(lesson)
    explorer.expect_design(ANGLE)
    assert_drawn(explorer.picture)


def test_an_arrow_key_moves_picture_and_numbers(lesson: LabPage) -> None:
    explorer = ExplorerOutput(lesson)
    explorer.set_angle(70)
    before = explorer.picture.screenshot()
    explorer.angle_slider.press("ArrowRight")
    explorer.expect_design(71)
    assert explorer.picture.screenshot() != before


def test_a_typed_value_between_the_steps_is_kept(lesson: LabPage) -> None:
    explorer = ExplorerOutput(lesson)
    explorer.set_angle(124.84)
    explorer.angle.blur()
    lesson.settle()
    explorer.expect_design(124.84)


def test_a_pinned_design_is_the_reference(lesson: LabPage) -> None:
    explorer = ExplorerOutput(lesson)
    explorer.set_angle(110)
    explorer.pin.click()
    explorer.expect_design(110, reference_degrees=110)


def test_a_reloaded_page_shows_the_live_explorer(lesson: LabPage) -> None:
    ExplorerOutput(lesson).set_angle(90)
    lesson.command("docmanager:save")
    lesson.reload(LESSON)
    explorer = ExplorerOutput(lesson)
    assert_drawn(explorer.picture)
    explorer.set_angle(91)


def test_the_next_day_the_explorer_is_still_a_picture(lesson: LabPage) -> None:
    """The kernel is gone with all widgets; the saved notebook is what is left."""
    lesson.command("docmanager:save")
    lesson.command("kernelmenu:shutdown")
    lesson.reload(LESSON)
    assert_drawn(ExplorerOutput(lesson).picture)
