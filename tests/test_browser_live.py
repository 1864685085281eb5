"""Live figures as pages from a file, in a real Chromium without a network and in a real Firefox."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import nbformat
import numpy as np
import pytest
import sympy as sp
from firefox import running_firefox
from lab import ROOT, require_chromium, running_browser
from live_page import (
    ERRORS,
    FIELDS,
    FIGURES,
    LISTEN,
    OUTSIDE,
    PHONE_PX,
    RESTS_MS,
    SLIDE,
    TWICE,
    TYPE,
    UNSEEN,
    WAIT,
    Reader,
    built,
    started,
)
from playwright.sync_api import Browser, Locator, Page

import cammotion as cm
from cammotion.views.live import page
from cammotion.views.live.figure import MIME

NARROW_PX = 300  # what JupyterLab leaves for an output on a phone


@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    require_chromium()
    with running_browser() as browser:
        yield browser


@pytest.fixture(scope="module", params=["chromium", "firefox"])
def reader(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Reader]:
    """Give a page in each browser; of Chromium's, what goes wrong is collected."""
    folder = tmp_path_factory.mktemp("live")
    if request.param == "firefox":
        with running_firefox(folder) as firefox:
            yield Reader(firefox.goto, firefox.evaluate, firefox.press, folder, built("move"))
        return
    opened = request.getfixturevalue("chromium").new_page(offline=True)
    wrong: list[str] = []
    opened.on("console", lambda said: wrong.append(said.text))
    opened.on("pageerror", lambda error: wrong.append(str(error)))
    yield Reader(opened.goto, opened.evaluate, opened.keyboard.press, folder, built("move"))
    opened.close()
    assert wrong == []


def test_a_move_under_the_readers_hand(reader: Reader) -> None:
    figure = reader.open("move")
    rate, angle, _, law = figure.values
    reader.assert_as_in_python()
    reader.evaluate(SLIDE, "rate N")
    reader.press("ArrowRight")
    reader.press("ArrowRight")
    figure.values = {rate: 2100}
    reader.assert_as_in_python()
    reader.type("angle Bm", "55,5")
    figure.values = {angle: 55.5}
    reader.assert_as_in_python()
    reader.type("rate N", "2,100")  # thousands: 2.1 pieces an hour is out of the range
    figure.values = {rate: 2100}
    reader.assert_as_in_python()
    reader.push("Pin this design")
    figure.pin()
    reader.evaluate(TYPE, {"label": "motion law"})
    reader.press("ArrowDown")
    figure.values = {law: 1}
    reader.assert_as_in_python()
    assert figure.chosen == {"motion law": "constant acceleration"}
    reader.push("Start again")
    figure.values = {rate: 2000, angle: 55, law: 0}
    reader.assert_as_in_python()
    resources = "() => performance.getEntriesByType('resource').map((each) => each.name)"
    assert all(name.startswith("blob:") for name in reader.evaluate(resources))


def test_a_number_that_is_not_taken_is_told_and_changes_nothing(reader: Reader) -> None:
    figure = reader.open("move")
    reader.type("angle Bm", "300")
    error = "“300” was not taken: angle Bm goes from 20 to 220 deg."
    assert reader.evaluate(ERRORS) == error
    assert reader.evaluate(FIELDS)[1] == "300"
    assert reader.said() == figure.text
    reader.type("stroke hm", "abc")
    assert "“abc” was not taken: stroke hm goes from 5 to 100 mm." in reader.evaluate(ERRORS)
    reader.type("angle Bm", "60")
    assert "angle" not in reader.evaluate(ERRORS)
    reader.push("Start again")
    assert reader.evaluate(ERRORS) == ""
    assert reader.evaluate(FIELDS) == ["2000", "55", "50"]


def test_what_is_being_typed_stays_while_the_figure_is_drawn(reader: Reader) -> None:
    figure = reader.open("clock")
    (k,) = figure.values
    reader.push("Play")
    reader.evaluate(TYPE, {"label": "k"})
    for key in "7.5":
        reader.press(key)
        reader.evaluate(WAIT, 50)
    assert reader.evaluate(FIELDS) == ["7.5"]
    reader.press("Enter")
    reader.push("Pause")
    figure.values = {k: 7.5}
    assert reader.said().splitlines()[1] == figure.text.splitlines()[1]


def test_the_sentences_are_read_out_when_the_hand_rests(reader: Reader) -> None:
    reader.open("move")
    reader.evaluate(WAIT, RESTS_MS)
    reader.evaluate(LISTEN)
    reader.evaluate(SLIDE, "angle Bm")
    for _ in range(5):
        reader.press("ArrowRight")
        assert reader.evaluate("() => heard") == []
    reader.evaluate(WAIT, RESTS_MS)
    assert reader.evaluate("() => heard") == [reader.said()]


def test_the_clock_plays_and_stands(reader: Reader) -> None:
    figure = reader.open("clock")
    assert reader.said() == figure.text
    reader.evaluate(WAIT, RESTS_MS)
    reader.evaluate(LISTEN)
    reader.push("Play")
    before = reader.said()
    reader.evaluate(WAIT, 200)
    during = reader.said()
    reader.evaluate(WAIT, RESTS_MS)
    assert before.splitlines()[0] != during.splitlines()[0] != reader.said().splitlines()[0]
    assert reader.evaluate("() => heard") == []
    reader.push("Pause")
    paused = reader.said()
    reader.evaluate(WAIT, RESTS_MS)
    assert reader.said() == paused
    assert reader.evaluate("() => heard") == [paused]
    place, sine = map(float, re.findall(r"[-\d.]+", paused.replace("−", "-"))[:2])
    assert sine == pytest.approx(np.sin(5 * place), abs=0.002)
    assert reader.evaluate("() => document.querySelector('h1').textContent").startswith("<b>A sine")


def test_the_pad_follows_the_arrow_keys(reader: Reader) -> None:
    figure = reader.open("scca")
    b, c = figure.values
    reader.assert_as_in_python()
    reader.evaluate("() => document.querySelector('[role=application]').focus()")
    for key in ["ArrowUp", "ArrowUp", "ArrowUp", "ArrowRight"]:
        reader.press(key)
    up = 0.03 / (3**0.5 / 2)
    figure.values = {b: 0.5 - 0.01 - up / 2, c: up}
    reader.assert_as_in_python()


def test_figures_of_one_notebook_share_no_id(reader: Reader) -> None:
    datas = [reader.open("move")._data, built("scca")._data]
    found = reader.evaluate(TWICE, {"script": page.module(), "datas": [*datas, datas[0]]})
    assert len(set(found["ids"])) == len(found["ids"]) > 20
    assert found["missing"] == []
    reader.open("move")


def test_a_figure_that_is_not_in_sight_has_its_numbers_and_sentences(reader: Reader) -> None:
    """Who listens to a page need not scroll, and JupyterLab lays out what is near the window."""
    reader.open("move")
    figure = built("move")
    found = reader.evaluate(
        UNSEEN, {"script": page.module() + page.model(), "data": {**figure._data}}
    )
    rate, angle, stroke, _law = started(figure)
    assert [float(value) for value in found["fields"]] == [rate, angle, stroke]
    assert found["said"] == figure.text.splitlines()


def test_a_button_works_before_the_figure_comes_in_sight(reader: Reader) -> None:
    """What is below the window is laid out when it comes into it, and a key may be quicker."""
    reader.open("move")
    figure = built("overlap")
    wide = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).angle_deg
    for press, angle in (("Widest move of the die", wide), ("Start again", 55)):
        given = {**figure._data, "press": press}
        found = reader.evaluate(UNSEEN, {"script": page.module() + page.model(), "data": given})
        assert angle in [pytest.approx(value, rel=1e-6) for value in found["settings"]]


def test_the_pad_follows_the_mouse(chromium: Browser, tmp_path: Path) -> None:
    opened = chromium.new_page(viewport={"width": 1000, "height": 900}, offline=True)
    reader = Reader(opened.goto, opened.evaluate, opened.keyboard.press, tmp_path, built("scca"))
    reader.open("scca")
    dots = opened.locator(".cm-column").first.locator("circle")
    place = {at: dots.nth(at).bounding_box() for at in range(6)}
    here, there = (
        box and (box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        for box in (place[5], place[1])
    )
    assert here
    assert there
    opened.mouse.move(*here)
    opened.mouse.down()
    opened.mouse.move(here[0], there[1], steps=3)
    opened.mouse.move(*there, steps=3)
    opened.mouse.up()
    opened.mouse.move(10, 10)
    moved = [float(value.replace("−", "-")) for value in reader.evaluate(FIELDS)]
    assert moved == pytest.approx([0, 0], abs=1e-6)  # the corner of the simple harmonic law
    opened.mouse.move(there[0] - 47, there[1] - 11)
    opened.mouse.down()
    opened.mouse.up()
    assert all(re.fullmatch(r"0\.\d{1,3}", value) for value in reader.evaluate(FIELDS))
    opened.close()


@pytest.fixture
def phone(chromium: Browser) -> Iterator[Page]:
    context = chromium.new_context(
        viewport={"width": PHONE_PX, "height": 640}, has_touch=True, is_mobile=True, offline=True
    )
    yield context.new_page()
    context.close()


# How far the page is down once it rests: a swipe before, or what brought a place there, may go on.
AT_REST = """async () => {
    let before;
    do {
        before = scrollY;
        await new Promise((later) => setTimeout(later, 150));
    } while (scrollY !== before);
    return before;
}"""


def swipe(page: Page, place: Locator, across: float, down: float, beside: float = 0) -> float:
    """Touch the middle of a place, or beside it, swipe, and return how far the page has moved."""
    place.evaluate("(each) => each.scrollIntoView({ block: 'center' })")
    before, box = page.evaluate(AT_REST), place.bounding_box()
    assert box
    x, y = box["x"] + box["width"] / 2 + beside, box["y"] + box["height"] / 2
    finger = page.context.new_cdp_session(page)

    def tell(kind: str, *points: dict[str, float]) -> None:
        finger.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [*points]})

    tell("touchStart", {"x": x, "y": y})
    for part in range(1, 9):
        tell("touchMove", {"x": x + across * part / 8, "y": y + down * part / 8})
        page.wait_for_timeout(20)
    tell("touchEnd")
    page.wait_for_timeout(150)
    return abs(float(page.evaluate(AT_REST)) - float(before))


def test_a_swipe_over_a_slider_scrolls_the_page_and_changes_nothing(
    phone: Page, tmp_path: Path
) -> None:
    figure = built("move")
    reader = Reader(phone.goto, phone.evaluate, phone.keyboard.press, tmp_path, figure)
    reader.open("move")
    phone.add_style_tag(content="body { padding-block: 900px !important }")
    phone.evaluate("() => document.addEventListener('pointercancel', () => (window.left = true))")
    slider = phone.get_by_role("slider").first
    assert swipe(phone, slider, across=0, down=-200, beside=60) > 50
    assert phone.evaluate("() => left")
    assert reader.evaluate(FIELDS) == ["2000", "55", "50"]
    assert slider.input_value() == "2000"
    assert reader.said() == figure.text
    assert swipe(phone, slider, across=60, down=0) == 0
    assert reader.evaluate(FIELDS)[0] != "2000"


def test_a_finger_moves_the_point_and_beside_it_the_page(phone: Page, tmp_path: Path) -> None:
    reader = Reader(phone.goto, phone.evaluate, phone.keyboard.press, tmp_path, built("scca"))
    reader.open("scca")
    phone.add_style_tag(content="body { padding-block: 900px !important }")
    started_at, point = reader.evaluate(FIELDS), phone.get_by_role("application")
    assert swipe(phone, point, across=0, down=-200, beside=70) > 50
    assert reader.evaluate(FIELDS) == started_at
    assert swipe(phone, point, across=10, down=-60, beside=18) == 0
    moved = reader.evaluate(FIELDS)
    assert moved != started_at
    assert all(re.fullmatch(r"0\.\d{1,3}", value) for value in moved)


@pytest.mark.parametrize("name", FIGURES)
def test_a_notebook_on_a_phone_leaves_a_figure_little_room(
    chromium: Browser, tmp_path: Path, name: str
) -> None:
    """And next to none while the page is laid out."""
    opened = chromium.new_page(viewport={"width": NARROW_PX, "height": 740}, offline=True)
    wrong: list[str] = []
    opened.on("console", lambda said: wrong.append(said.text))
    reader = Reader(opened.goto, opened.evaluate, opened.keyboard.press, tmp_path, built(name))
    reader.open(name)
    assert reader.evaluate(OUTSIDE) == []
    opened.set_viewport_size({"width": 60, "height": 740})
    reader.evaluate(WAIT, 100)
    assert wrong == []
    opened.close()


@pytest.mark.parametrize("name", FIGURES)
def test_a_phone_in_the_dark(chromium: Browser, tmp_path: Path, name: str) -> None:
    context = chromium.new_context(
        viewport={"width": PHONE_PX, "height": 740}, color_scheme="dark", offline=True
    )
    opened = context.new_page()
    reader = Reader(opened.goto, opened.evaluate, opened.keyboard.press, tmp_path, built(name))
    figure = reader.open(name)
    assert reader.evaluate(OUTSIDE) == []
    assert reader.said() == figure.text
    style = "(place) => getComputedStyle(document.querySelector(place))"
    ink, paper = (
        sum(
            map(
                int,
                re.findall(r"\d+", reader.evaluate(f"() => ({style})('.cm-figure').{part}"))[:3],
            )
        )
        for part in ("color", "backgroundColor")
    )
    assert (ink > 600, paper < 150) == (True, True)
    context.close()


def test_a_page_from_a_stored_notebook_without_running_anything(
    chromium: Browser, tmp_path: Path
) -> None:
    lesson = nbformat.read(ROOT / "notebooks" / "02_maximum_acceleration.ipynb", as_version=4)  # type: ignore[no-untyped-call]
    outputs = [output for cell in lesson.cells for output in cell.get("outputs", [])]
    stored = [output.data for output in outputs if MIME in output.get("data", {})]
    assert len(stored) == 3
    opened = chromium.new_page(offline=True)
    for number, data in enumerate(stored):
        path = tmp_path / f"{number}.html"
        text = data["text/plain"]
        path.write_text(page.write_page(json.loads(data[MIME]), text), encoding="utf-8")
        opened.goto(path.as_uri())
        said = opened.locator(".cm-said")
        said.wait_for()
        assert said.inner_text().splitlines() == text.splitlines()
    opened.close()


def test_of_two_pads_the_nearest_is_dragged_and_start_again_brings_all_back(
    chromium: Browser, tmp_path: Path
) -> None:
    u, *ends = sp.symbols("u x_1 y_1 x_2 y_2")
    x_1, y_1, x_2, y_2 = ends
    controls = {
        symbol: cm.Control(low=0, high=1, step=0.1, start=start)
        for symbol, start in zip(ends, (0.2, 0.2, 0.8, 0.8), strict=True)
    }
    points = [cm.Point(x=x, y=y, drags=(x, y)) for x, y in ((x_1, y_1), (x_2, y_2))]
    line = cm.Line(x=x_1 + u * (x_2 - x_1), y=y_1 + u * (y_2 - y_1))
    panel = cm.Panel(lines=[line], points=points, x_limits=(0, 1), y_limits=(0, 1), is_equal=True)
    path = cm.explore(panel, (u, 0, 1), controls).save(tmp_path / "two.html")
    opened = chromium.new_page(offline=True)
    opened.goto(path.as_uri())
    second = opened.locator("circle[role=application]").nth(1)
    box = second.bounding_box()
    assert box
    across, down = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    opened.mouse.move(across, down)
    opened.mouse.down()
    opened.mouse.move(across - 60, down + 60, steps=3)
    opened.mouse.up()
    fields = opened.locator("input[type=text]")
    moved = [float(field.input_value()) for field in fields.all()]
    assert moved[:2] == [0.2, 0.2]
    assert max(moved[2:]) < 0.75
    opened.get_by_role("button", name="Play").click()
    opened.wait_for_timeout(300)
    opened.get_by_role("button", name="Start again").click()
    assert [float(field.input_value()) for field in fields.all()] == [0.2, 0.2, 0.8, 0.8]
    assert opened.get_by_role("button", name="Play").is_visible()
    assert opened.get_by_role("slider").last.input_value() == "0"
    opened.close()
