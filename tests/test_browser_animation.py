"""The machine in motion in a real Chromium: as a drawing in a page, and as a picture."""

import base64
import io
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from lab import ROOT, calm
from machines import RULE
from moving_drawing import ANGLES, assert_at, places
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, expect
from test_animation import AFTER, BEFORE, COLLIDING, MACHINES

import cammotion as cm
from cammotion.views.animation.picture import animate

IMAGES = sorted((ROOT / "notebooks" / "images").glob("*.svg"))
MOVING_IMAGES = [path for path in IMAGES if "<animate" in path.read_text("utf-8")]


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
