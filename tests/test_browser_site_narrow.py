"""The site where it is narrow: on a telephone, on paper, with a word that has no end."""

import pytest
from playwright.sync_api import Browser, Page, expect
from site_pages import files, written
from site_reader import DESK, LIVES, LOADED, PHONE, TOO_WIDE, Reader, reader_in

NARROWER = """() => {
  const figure = document.querySelector(".cm-figure"),
    paper = figure.cloneNode(true); // nobody draws it anew, as on paper
  paper.style.width = `${0.6 * figure.clientWidth}px`;
  figure.after(paper);
  const columns = [...paper.querySelectorAll(".cm-column")];
  return [columns.length, columns.flatMap((column) => {
    const { right } = column.getBoundingClientRect();
    return [...column.querySelectorAll("text")]
      .filter((text) => text.getBoundingClientRect().right > right + 1)
      .map((text) => text.textContent);
  })];
}"""
ENDS = """(all) => all.map((each) => getComputedStyle(each))
  .flatMap(({ paddingLeft, borderLeftWidth }) => [paddingLeft, borderLeftWidth])"""
MIDDLES = """() => [...document.querySelectorAll("fieldset label")].map((label) => {
  const [mark, words] = ["input", "span"].map((of) => label.querySelector(of)),
    { top, height } = mark.getBoundingClientRect();
  return [top + height / 2,
    words.getBoundingClientRect().top + parseFloat(getComputedStyle(words).lineHeight) / 2];
})"""


@pytest.fixture(scope="module")
def reader(browser: Browser) -> Reader:
    return reader_in(browser, DESK, "light", "reduce")


@pytest.fixture(scope="module")
def phone(browser: Browser) -> Reader:
    return reader_in(browser, PHONE, "light", "reduce")


def test_a_figure_on_paper_is_scaled_and_not_cut(reader: Reader) -> None:
    page = reader.open("04_machine_in_motion")
    assert page.evaluate(LIVES) == 0
    assert page.evaluate(NARROWER) == [2, []]


def test_a_word_without_end_does_not_widen_the_page(phone: Reader) -> None:
    page = phone.open("02_maximum_acceleration")
    assert page.evaluate(LIVES) == 0
    for form in ("#exercise-02\\.1", "[data-predicts='02.peak']"):
        field = page.locator(form).get_by_role("textbox")
        field.fill(200 * "a")
        field.press("Enter")
    expect(page.locator("[data-reveals='02.peak'] .said")).to_contain_text(200 * "a")
    expect(page.locator("#exercise-02\\.1 .said")).to_contain_text(200 * "a")
    assert page.evaluate(TOO_WIDE) is False


def test_a_picture_that_is_moved_sideways_is_reached_by_keyboard(
    phone: Reader, reader: Reader
) -> None:
    for one, reached in ((phone, 0), (reader, -1)):
        page = one.open("01_timing_diagram")
        page.evaluate(LOADED)
        figures = page.locator(".cell > figure:not(.living)")
        expect(figures.first).to_have_js_property("tabIndex", reached)
        assert {*figures.evaluate_all("(all) => all.map((each) => each.tabIndex)")} == {reached}


def test_a_machine_that_has_room_on_a_telephone_is_seen_whole(phone: Reader) -> None:
    page = phone.open("04_machine_in_motion")
    assert page.evaluate(LIVES) == 0
    widths = page.locator("[data-module=player] svg.cm-drawing").evaluate_all(
        "(all) => all.map((svg) => [svg.viewBox.baseVal.width, svg.getBoundingClientRect().width])"
    )
    assert {drawn for drawn, _ in widths} == {430, 860}
    for drawn, shown in widths:
        assert (shown <= PHONE[0]) == (drawn < 500)


def test_a_slider_reaches_both_ends_of_its_line(reader: Reader) -> None:
    page = reader.open("04_machine_in_motion")
    assert page.evaluate(LIVES) == 0
    sliders = page.get_by_role("slider")
    assert sliders.count() > 4
    assert {*sliders.evaluate_all(ENDS)} == {"0px"}


def test_the_mark_of_a_choice_stands_at_its_first_line(phone: Reader) -> None:
    places = phone.open("03_overlap").evaluate(MIDDLES)
    assert len(places) > 3
    assert all(abs(mark - line) < 5 for mark, line in places)


def test_a_field_has_keys_for_all_numbers_of_its_range(phone: Reader) -> None:
    found: dict[bool, set[str]] = {}
    for name in ("05_motion_laws", "07_from_diagram_to_cam"):
        page = phone.open(name)
        assert page.evaluate(LIVES) == 0
        for is_below, keys in page.locator(".cm-settings > div:has(input[type=text])").evaluate_all(
            "(all) => all.map((row) => [row.querySelector('[type=range]').min < 0,"
            " row.querySelector('[type=text]').inputMode])"
        ):
            found.setdefault(is_below, set()).add(keys)
    assert found == {True: {"text"}, False: {"decimal"}}


def test_a_prediction_that_may_be_two_numbers_is_asked_about(reader: Reader) -> None:
    page = reader.open("12_your_machine")
    form = page.locator("[data-predicts='12.rate']")
    for typed, said, is_open in (
        ("20,000", "“20,000” may be 20 or 20000: write it with a point, or with no mark.", False),
        ("20000", "The answer opens further down.", True),
    ):
        form.get_by_role("textbox").fill(typed)
        form.get_by_role("textbox").press("Enter")
        expect(form.locator(".said")).to_have_text(said)
        details = page.locator("[data-reveals='12.rate'] details")
        assert details.evaluate("(each) => each.open") is is_open


def test_a_long_formula_does_not_widen_a_page_of_large_letters(phone: Reader) -> None:
    for name in ("07_from_diagram_to_cam", "09_a_measured_cam", "10_the_followers_vibration"):
        page = phone.open(name)
        page.add_style_tag(content="html { font-size: 24px !important }")
        assert page.evaluate("() => document.documentElement.scrollWidth") == PHONE[0]


def test_each_lesson_of_the_contents_is_told_without_a_gap(phone: Reader) -> None:
    for item in phone.open("index").locator(".lessons li:has(.minutes)").all():
        above, below = (item.locator(f".{name}").bounding_box() for name in ("minutes", "question"))
        assert above
        assert below
        assert below["y"] - above["y"] - above["height"] < 4


def test_a_drawing_without_its_player_is_dark_in_the_dark(browser: Browser) -> None:
    context = browser.new_context(java_script_enabled=False, color_scheme="dark")
    page: Page = context.new_page()
    page.goto((written() / "04_machine_in_motion.html").as_uri())
    drawing = page.locator("[data-module=player] > svg").first
    expect(drawing).to_have_css("filter", "invert(0.933) hue-rotate(180deg)")
    context.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_browser_that_does_not_know_both_themes_shows_the_light_one(
    browser: Browser, scheme: str
) -> None:
    """One that takes light-dark() for no colour, as Chrome 122 does."""
    old = reader_in(browser, DESK, scheme, "reduce")
    style = files()["shared/page.css"].decode().replace("light-dark(", "of-both(")
    old.page.route("**/page.css", lambda asked: asked.fulfill(body=style, content_type="text/css"))
    page = old.open("04_machine_in_motion")
    assert page.evaluate(LIVES) == 0
    curve, field = page.locator(".cm-column path.cm-own"), page.locator(".cm-settings input")
    expect(curve.first).to_have_css("stroke", "rgb(0, 114, 178)")
    expect(field.first).to_have_css("border-top-color", "rgb(85, 85, 85)")
    expect(field.first).to_have_css("color-scheme", "light")
    expect(page.locator("body")).to_have_css("color", "rgb(31, 30, 27)")
    expect(page.locator("html")).to_have_css("background-color", "rgb(253, 252, 249)")
    expect(page.locator(".cm-paper").first).to_have_css("filter", "none")
    page.context.close()
