"""The site in a real Chromium, opened from the disk: it lives, it answers, and it asks nobody."""

import re
from collections.abc import Iterator
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from firefox import running_firefox
from lab import calm
from playwright.sync_api import Browser, Page, Route, expect
from site_pages import PAGES, ROOT, files, written
from site_reader import DESK, LIVES, LOADED, PHONE, TOO_WIDE, Reader, reader_in

from cammotion.teaching.exercise import ChoiceExercise
from cammotion.teaching.lessons import PREDICTIONS, find_exercise
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.variants import NAMELESS

BROKEN = """() => [...document.images].filter((image) => image.complete && !image.naturalWidth)
  .map((image) => image.src)"""
STATES = """() => [...document.querySelectorAll(".cm-angle, .cm-said")]
  .map((each) => each.innerText)"""
READABLE_PX = 9
"""So large is the smallest word in a picture, as it is shown."""
SMALLEST_PX = 14  # of a picture of Matplotlib: 10 points, 100 dots an inch
SHARES = """() => [...document.querySelectorAll(".cell img")]
  .map((image) => [image.src, image.width / image.naturalWidth])"""
PRINTED = """() => [...document.querySelectorAll(".printed")]
  .map((pre) => [pre.textContent, pre.scrollWidth > pre.clientWidth + 1])"""
LAID_OUT = """() => [...document.querySelectorAll(".printed")]
  .filter((pre) => pre.textContent.includes("  ")).map((pre) => getComputedStyle(pre).whiteSpace)"""
FOCUS = "(place) => document.querySelector(place).focus()"
NOTHING = "about:blank"  # a page that is left open moves on, and takes half a processor
WHITE = "rgb(253, 252, 249)"


@pytest.fixture(scope="module")
def at_a_desk(browser: Browser) -> Reader:
    return reader_in(browser, DESK, "light", "move")


@pytest.fixture(scope="module")
def with_a_phone(browser: Browser) -> Reader:
    return reader_in(browser, PHONE, "dark", "move")


@pytest.fixture
def reader(at_a_desk: Reader) -> Iterator[Reader]:
    yield at_a_desk
    at_a_desk.page.goto(NOTHING)


@pytest.fixture
def phone(with_a_phone: Reader) -> Iterator[Reader]:
    yield with_a_phone
    with_a_phone.page.goto(NOTHING)


@pytest.mark.parametrize("name", PAGES)
def test_a_page_lives_on_a_desk_and_complains_of_nothing(reader: Reader, name: str) -> None:
    page = reader.open(name)
    assert page.evaluate(LIVES) == 0
    assert page.evaluate(BROKEN) == []
    assert page.evaluate(TOO_WIDE) is False
    is_cut = dict(page.evaluate(PRINTED))  # but for tables, which have columns
    assert not [text for text, cut in is_cut.items() if cut and "  " not in text]
    assert reader.complaints == []


@pytest.mark.parametrize("name", PAGES)
def test_a_page_fits_a_telephone_in_the_dark(phone: Reader, name: str) -> None:
    page = phone.open(name)
    assert page.evaluate(LIVES) == 0
    assert words_too_small(page) == {}
    assert page.evaluate(TOO_WIDE) is False
    assert phone.complaints == []
    assert page.evaluate("() => getComputedStyle(document.documentElement).backgroundColor") != (
        WHITE
    )
    assert {*page.evaluate(LAID_OUT)} <= {"pre"}  # a table keeps its columns


def words_too_small(page: Page) -> dict[str, float]:
    """Return the pictures whose words nobody can read, and how much they are scaled."""
    page.evaluate(LOADED)
    shares = dict(page.evaluate(SHARES))
    return {one: share for one, share in shares.items() if SMALLEST_PX * share < READABLE_PX}


def test_a_live_figure_follows_the_keyboard(reader: Reader) -> None:
    page = reader.open("02_maximum_acceleration")
    figure = page.locator("#cell-explore-figure")
    slider = figure.get_by_role("slider", name="angle Bm, deg")
    slider.focus()
    before = figure.locator(".cm-column path.cm-own").first.get_attribute("d")
    for _ in range(5):
        page.keyboard.press("ArrowRight")
    expect(figure.get_by_role("textbox", name="angle Bm, deg")).to_have_value("60")
    assert figure.locator(".cm-column path.cm-own").first.get_attribute("d") != before
    expect(figure.get_by_text("a_max = 3.491 m/s²")).to_be_visible()


def test_an_animation_plays_and_pauses(reader: Reader) -> None:
    page = reader.open("04_machine_in_motion")
    player = page.locator("[data-module=player]").first
    player.scroll_into_view_if_needed()
    angle = player.locator(".cm-angle")
    first = angle.inner_text()
    expect(angle).not_to_have_text(first)
    player.get_by_role("button", name="Pause").press("Enter")
    expect(player.get_by_role("button", name="Play")).to_be_visible()
    stands = angle.inner_text()
    page.wait_for_timeout(200)
    assert angle.inner_text() == stands
    player.get_by_role("slider").press("ArrowRight")
    expect(angle).not_to_have_text(stands)


def test_a_page_lives_where_the_browser_is_never_idle(browser: Browser) -> None:
    """Drawings that move may keep it busy for minutes."""
    busy = reader_in(browser, DESK, "light", "move")
    busy.page.add_init_script(
        "globalThis.requestIdleCallback = (then, { timeout = 1e6 } = {}) => "
        "setTimeout(then, timeout);"
    )
    assert busy.open("04_machine_in_motion").evaluate(LIVES) == 0
    busy.page.context.close()


class Host:
    """A host that sends a content security policy with each file of the site."""

    def __init__(self, browser: Browser, policy: str) -> None:
        self.page, self.policy, self.folder = browser.new_page(), policy, written()
        self.said: list[str] = []
        self.page.on("console", lambda each: self.said.append(each.text))
        self.page.on("pageerror", lambda error: self.said.append(str(error)))
        self.page.route("http://site.test/**", self.answer)

    def answer(self, route: Route) -> None:
        """Give a file."""
        path = self.folder / urlsplit(route.request.url).path.removeprefix("/")
        route.fulfill(path=path, headers={"Content-Security-Policy": self.policy})

    def open(self, name: str) -> None:
        """Open a page, and look at its first figure."""
        self.page.goto(f"http://site.test/{name}.html")
        self.page.locator("[data-module]").first.scroll_into_view_if_needed()


def test_a_page_lives_with_the_policy_that_the_docs_name(browser: Browser) -> None:
    """And with no word less."""
    (policy,) = re.findall(r"`(default-src .*?)`", (ROOT / "docs" / "site.md").read_text("utf-8"))
    host = Host(browser, policy)
    for name in ("02_maximum_acceleration", "04_machine_in_motion"):
        host.open(name)
        assert host.page.evaluate(LIVES) == 0
    assert host.said == []
    for word in (" blob:", " 'unsafe-eval'", " 'unsafe-inline'", " data:"):
        host.said.clear()
        host.policy = policy.replace(word, "")
        host.open("02_maximum_acceleration")
        for _ in range(200):
            if not host.said:
                host.page.wait_for_timeout(50)
        assert "Content Security Policy" in "".join(host.said), word
    host.page.close()


def test_what_nobody_sees_waits(reader: Reader) -> None:
    page = reader.open("04_machine_in_motion")
    assert page.evaluate(LIVES) == 0
    player = page.locator("[data-module=player]").last
    angle = player.locator(".cm-angle")
    player.scroll_into_view_if_needed()
    expect(angle).not_to_have_text(angle.inner_text())
    page.evaluate("() => scrollTo(0, 0)")
    page.wait_for_timeout(200)
    stands = angle.text_content()
    page.wait_for_timeout(400)
    assert angle.text_content() == stands
    player.scroll_into_view_if_needed()
    expect(angle).not_to_have_text(str(stands))


def test_a_drawing_that_moves_can_be_stopped(browser: Browser, reader: Reader) -> None:
    page = reader.open("00_start_here")
    image = page.locator(".moving img").first
    page.get_by_role("button", name="Stop the motion").first.press("Enter")
    expect(image).to_have_attribute("src", "images/cam-still.svg")
    page.get_by_role("button", name="Let it move").first.press("Enter")
    expect(image).to_have_attribute("src", "images/cam.svg")
    calm = reader_in(browser, DESK, "light", "reduce")
    page = calm.open("00_start_here")
    expect(page.get_by_role("button", name="Let it move").first).to_be_visible()
    current = page.locator(".moving img").first.evaluate("(image) => image.currentSrc")
    assert current.endswith("cam-still.svg")
    page.context.close()


def test_nothing_plays_by_itself_for_a_reader_who_wants_that(browser: Browser) -> None:
    played = [name for name in PAGES if b'data-module="player"' in files()[f"{name}.html"]]
    with calm(browser) as started:
        page = started.new_page(reduced_motion="null")  # the system's wish, not Playwright's
        for name in played:
            page.goto((written() / f"{name}.html").as_uri())
            assert page.evaluate(LIVES) == 0
            expect(page.get_by_role("button", name="Play").first).to_be_visible()
            expect(page.get_by_role("button", name="Pause")).to_have_count(0)
            states = page.evaluate(STATES)
            page.wait_for_timeout(200)
            assert page.evaluate(STATES) == states
        angle = page.locator("[data-module=player] .cm-angle").first
        stands = angle.inner_text()
        page.get_by_role("button", name="Play").first.press("Space")
        expect(angle).not_to_have_text(stands)
    assert len(played) > 1


def test_numbers_are_answered_with_their_reasons(reader: Reader) -> None:
    one = find_exercise("03.4")
    assert isinstance(one, NumberExercise)
    page = reader.open("03_overlap")
    form = page.locator("#exercise-03\\.4")
    field, said = form.get_by_role("textbox"), form.locator(".said")
    slip = one.slips[0]
    for typed, text in {
        f"{one.solution(NAMELESS):.4f}": f"Right. {one.right}",
        f"{float(slip.answer(NAMELESS)):.4f}": f"Not yet. {slip.reason}",
        f"{1.031 * one.solution(NAMELESS):.6f}": "off by 3.1 %",
        "1": "hints are below.",
        "12 deg": "is no number: write it alone, without its unit.",
        "12 %": "“12 %” is no number: write it alone, without its unit.",
        "about 12": "is no number: write one number, in digits alone.",
        "1.2.3": "“1.2.3” is no number: write one number, in digits alone.",
        "1,234": "may be 1.234 or 1234: write it with a point, or with no mark.",
        "2 791": "hints are below.",
    }.items():
        field.fill(typed)
        field.press("Enter")
        expect(said).to_contain_text(text)
    field.fill("")
    form.get_by_role("button", name="Check").click()
    expect(said).to_be_empty()
    assert reader.complaints == []


def test_choices_are_answered_with_their_reasons(reader: Reader) -> None:
    one = find_exercise("03.6")
    assert isinstance(one, ChoiceExercise)
    form = reader.open("03_overlap").locator("#exercise-03\\.6")
    wrong = next(iter(one.reasons))
    form.locator(f"input[value={wrong}]").check()
    expect(form.locator(".said")).to_have_text(f"Not yet. {one.reasons[wrong]}")
    form.locator(f"input[value={one.answer}]").check()
    expect(form.locator(".said")).to_have_text(f"Right. {one.right}")


def test_a_prediction_opens_its_answer(reader: Reader) -> None:
    page = reader.open("02_maximum_acceleration")
    reveal = page.locator("[data-reveals='02.peak']")
    expect(reveal.locator("details")).not_to_have_attribute("open", "")
    field = page.locator("[data-predicts='02.peak']").get_by_role("textbox")
    field.fill("about 2.077")
    field.press("Enter")
    expect(reveal.locator("details")).to_have_attribute("open", "")
    far = PREDICTIONS["02.peak"].how_far("about 2.077")
    expect(reveal.locator(".said")).to_have_text(f"You predicted about 2.077: {far}.")
    assert far == "2 times too much"


def test_what_is_filled_in_before_the_script_has_come_stays_and_is_answered(
    browser: Browser,
) -> None:
    slow = reader_in(browser, DESK, "light", "reduce")
    page, held = slow.page, list[Route]()
    page.route("**/page.js", lambda asked: held.append(asked))
    page.goto((written() / "03_overlap.html").as_uri(), wait_until="commit")
    choice, number, other = (page.locator(f"#exercise-03\\.{n}") for n in (6, 4, 1))
    one = find_exercise("03.6")
    assert isinstance(one, ChoiceExercise)
    choice.locator(f"input[value={one.answer}]").check()
    for form, typed in ((number, "12 deg"), (other, "1")):
        form.get_by_role("textbox").fill(typed)
        form.get_by_role("textbox").press("Enter")
    held[0].continue_()
    expect(choice.locator(".said")).to_have_text(f"Right. {one.right}")
    expect(number.locator(".said")).to_contain_text("is no number")
    expect(other.get_by_role("textbox")).to_have_value("1")  # which is still being typed
    expect(other.locator(".said")).to_be_empty()
    page.context.close()


def test_without_scripts_it_is_still_a_page(browser: Browser) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((written() / "04_machine_in_motion.html").as_uri())
    expect(page.locator("[data-module=player] > svg").first).to_be_visible()
    expect(page.locator("[data-module=figure] > img").first).to_be_visible()
    page.locator("[data-reveals] summary").first.click()
    expect(page.locator("[data-reveals] details p").first).to_be_visible()
    for form in (page.locator("[data-predicts]").first, page.locator("#exercise-04\\.1")):
        form.get_by_role("textbox").fill("55")
        form.get_by_role("textbox").press("Enter")
    expect(page.locator("form input[type=text]").first).to_have_value("55")
    assert page.url.endswith(".html")
    context.close()


def test_a_page_lives_and_answers_in_firefox(tmp_path: Path) -> None:
    one = find_exercise("02.1")
    assert isinstance(one, NumberExercise)
    with running_firefox(tmp_path) as firefox:
        firefox.goto((written() / "02_maximum_acceleration.html").as_uri())
        assert firefox.evaluate(LIVES) == 0
        firefox.evaluate(FOCUS, "#exercise-02\\.1 input")
        for key in [*f"{one.solution(NAMELESS):.3f}", "Enter"]:
            firefox.press(key)
        said = firefox.evaluate(
            "(place) => document.querySelector(place).textContent", "#exercise-02\\.1 .said"
        )
        assert said == f"Right. {one.right}"
