"""What only a browser shows: a learner works through notebook 02 in JupyterLab, and comes back."""

import json
from collections.abc import Iterator

import pytest
from keyboard import Keyboard
from lab import ROOT, LabPage, type_into
from playwright.sync_api import expect

import cammotion as cm

LESSON = "02_maximum_acceleration.ipynb"
STROKE, ANGLE, RATE = 50.0, 55.0, 2000.0  # the die, where every explorer of the lesson starts

OWN_FIGURE = "[o for o in Out.values() if hasattr(o, 'values') and len(o.values) == 2][-1].values"
ASK_KERNEL = """async expression => {
  const kernel = jupyterapp.shell.currentWidget.context.sessionContext.session.kernel;
  const asked = {code: '', user_expressions: {value: expression}, store_history: false};
  const reply = await kernel.requestExecute(asked).done;
  return reply.content.user_expressions.value.data['text/plain'];
}"""

expect.set_options(timeout=30_000)


@pytest.fixture(scope="module")
def opened(jupyter: LabPage) -> LabPage:
    """Notebook 02, reached by the starter's address and notebook 00's link, and not run yet."""
    jupyter.notebook.get_by_role("link", name="02 Maximum acceleration").click()
    jupyter.wait_for(LESSON)
    return jupyter


@pytest.fixture(scope="module")
def ran(opened: LabPage) -> LabPage:
    """Notebook 02 with all its cells run."""
    opened.command("application:close-other-tabs")  # or 00 would be laid out at each loading, too
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
        self.output = lab.output_of("cm.explore_move(")
        self.figure = self.output.locator(".cm-figure")
        self.curve = self.figure.locator(".cm-columns path.cm-own").last  # the acceleration
        self.text = self.figure.locator(".cm-said")
        self.angle = self.output.get_by_label("angle Bm, deg").first
        self.angle_slider = self.output.get_by_role("slider").nth(1)
        self.pin = self.output.get_by_role("button", name="Pin this design as the reference")

    def set_angle(self, degrees: float) -> None:
        """Type an angle, and wait until the text follows."""
        type_into(self.angle, f"{degrees:g}")
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


def assert_stands_as_picture(explorer: ExplorerOutput) -> None:
    """Assert that the stored picture is there and has been loaded."""
    picture = explorer.output.get_by_role("img").first
    expect(picture).to_be_visible()
    assert picture.evaluate("image => image.decode().then(() => image.naturalWidth)") > 400


def test_a_fresh_copy_shows_nothing_before_it_is_run(opened: LabPage) -> None:
    """What comes out would give the answers away; the stored notebook shows it."""
    expect(opened.notebook.locator(".jp-CodeCell").first).to_be_visible()
    expect(opened.notebook.locator(".jp-OutputArea-output")).to_have_count(0)
    assert opened.troubles() == []


def test_a_path_with_nothing_but_a_keyboard(opened: LabPage) -> None:
    """From the opened page: a prediction, the first figure and its clock, the answer, a check."""
    keys = Keyboard(opened)
    guess = keys.run_to('cm.predict("02.fraction"')
    keys.until("Tab", guess.get_by_label("I predict"))
    keys.type("0.4")
    keys.press("Enter")
    keys.press("Tab")  # the arrow keys are the field's

    cell = keys.run_to("cm.explore([h, h.diff(t)")
    figure, said = cell.locator(".cm-figure"), cell.locator(".cm-said")
    keys.until("Tab", figure.get_by_role("slider"))
    before = said.inner_text()
    keys.press("ArrowRight")
    expect(said).not_to_have_text(before)
    keys.until("Shift+Tab", figure.get_by_role("button", name="Play"))
    keys.press("Space")
    pause = figure.get_by_role("button", name="Pause")
    expect(pause).to_be_focused()
    before = said.inner_text()
    expect(said).not_to_have_text(before)
    keys.press("Space")
    expect(pause).to_have_count(0)
    keys.until("Shift+Tab", figure, "(element) => !element.contains(document.activeElement)")
    keys.press("Escape")  # it may have led into the code
    keys.until("ArrowUp", cell)

    reveal = keys.run_to("fraction_guess.reveal(")
    expect(reveal).to_contain_text("You predicted 0.4:")
    expect(reveal.locator("details")).to_have_attribute("open", "")

    keys.stand_on("answer_1 = None")
    keys.press("Enter")
    keys.press("ControlOrMeta+a")
    keys.type("answer_1 = 5")
    check = keys.run_to('cm.check("02.1"')
    expect(check.get_by_role("status")).to_contain_text("02.1: Not yet.")
    assert opened.troubles() == []
    assert opened.complaints == []


def test_all_cells_run(lesson: LabPage) -> None:
    explorer = ExplorerOutput(lesson)
    explorer.expect_design(ANGLE)
    expect(explorer.curve).to_be_visible()


@pytest.mark.parametrize("key", ["ArrowRight", "ArrowUp"])
def test_an_arrow_key_moves_curve_and_numbers(lesson: LabPage, key: str) -> None:
    """The notebook has uses of its own for these keys, which are not meant here."""
    explorer = ExplorerOutput(lesson)
    explorer.set_angle(70)
    before = explorer.curve.get_attribute("d")
    explorer.angle_slider.press(key)
    explorer.expect_design(71)
    assert explorer.curve.get_attribute("d") != before


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


def test_the_next_cell_goes_on_with_what_the_hand_has_set(lesson: LabPage) -> None:
    output = lesson.output_of("cm.explore([h, v, a]")
    type_into(output.get_by_label("indexing angle Bm, deg").first, "123,5")
    expect(output.locator(".cm-said")).to_contain_text("indexing time tm = 0.6175 s")
    assert "B_m: 123.5" in lesson.page.evaluate(ASK_KERNEL, OWN_FIGURE)


def test_a_reloaded_page_shows_the_live_explorer(lesson: LabPage) -> None:
    ExplorerOutput(lesson).set_angle(90)
    lesson.command("docmanager:save")
    lesson.reload(LESSON)
    explorer = ExplorerOutput(lesson)
    expect(explorer.curve).to_be_visible()
    explorer.set_angle(91)


def test_an_explored_notebook_does_not_grow(lesson: LabPage) -> None:
    """Nor does it keep anything of a figure when all outputs are cleared."""
    saved = ROOT / lesson.work / LESSON
    stored = (ROOT / "notebooks" / LESSON).stat().st_size
    lesson.command("notebook:run-all-cells")  # they have run before
    ExplorerOutput(lesson).set_angle(90)
    lesson.command("docmanager:save")
    assert saved.stat().st_size < 1.2 * stored
    assert "widgets" not in json.loads(saved.read_text("utf-8"))["metadata"]


def test_the_next_day_the_explorer_is_still_a_picture(lesson: LabPage) -> None:
    """The kernel is gone with all widgets; the saved notebook is what is left."""
    lesson.command("docmanager:save")
    lesson.command("kernelmenu:shutdown")
    lesson.reload(LESSON)
    assert_stands_as_picture(ExplorerOutput(lesson))
    reveal = lesson.output_of("few_guess.reveal(")
    expect(reveal.get_by_text("By 16 %.")).to_be_hidden()
    reveal.get_by_text("Show the answer (you made no prediction yet)").click()
    expect(reveal.get_by_text("By 16 %.")).to_be_visible()
