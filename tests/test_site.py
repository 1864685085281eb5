"""The site without a browser: complete, small, and nothing in it asks for anything outside."""

import json
import re
from io import BytesIO
from itertools import pairwise
from pathlib import Path
from string import ascii_lowercase, ascii_uppercase
from urllib.parse import unquote, urlsplit

import pytest
from bs4 import BeautifulSoup, Tag
from fontTools.ttLib import TTFont
from site_pages import LESSONS, NOTEBOOKS, PAGES, files, page, unpack

from cammotion.site.cells import LAB_ONLY
from cammotion.site.lessons import find_lessons
from cammotion.site.pictures import Pictures
from cammotion.site.prose import Prose
from cammotion.teaching.design_exercise import DesignExercise
from cammotion.teaching.exercise import ChoiceExercise
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.lessons import EXERCISES, PREDICTIONS, find_exercise
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.variants import NAMELESS
from cammotion.views.live.figure import MIME

MOST_BYTES, MOST_SHARED, MOST_IN_ALL = 500_000, 200_000, 5_000_000
NEED_PYTHON = (DesignExercise, ExpressionExercise)
FORMULA = re.compile(r"\$\$.+?\$\$|\$[^$\n]+?\$", re.DOTALL)
CODE = re.compile(r"^(`{3,}).*?^\1|`[^`\n]+`", re.MULTILINE | re.DOTALL)
ADDRESSES = ("src", "href", "srcset", "data-still", "poster", "action")
OUTSIDE = re.compile(r"(?:url\(|@import|fetch\(|import\()\s*['\"]?(?:https?:)?//", re.IGNORECASE)


def cells(lesson: str) -> list[dict[str, object]]:
    stored = json.loads((NOTEBOOKS / f"{lesson}.ipynb").read_text("utf-8"))["cells"]
    return [cell for cell in stored if LAB_ONLY not in cell["metadata"].get("tags", ())]


def outputs(lesson: str) -> list[dict[str, str]]:
    shown = [output for cell in cells(lesson) for output in cell.get("outputs", ())]  # type: ignore[attr-defined]
    return [
        {kind: "".join(value) for kind, value in output["data"].items()}
        for output in shown
        if "data" in output
    ]


def addresses(name: str) -> list[str]:
    tags: list[Tag] = page(name).find_all(True)
    return [str(tag[key]) for tag in tags for key in ADDRESSES if tag.has_attr(key)]


def weight(name: str) -> int:
    """Return the bytes of a page with the pictures that it shares with no other."""
    others = {address for other in PAGES if other != name for address in addresses(other)}
    own = {a for a in addresses(name) if a in files() and a not in others}
    return len(files()[f"{name}.html"]) + sum(len(files()[each]) for each in own)


@pytest.mark.parametrize(
    ("url", "leads_to"),
    [
        ("02_maximum_acceleration.ipynb#Exercises", "02_maximum_acceleration.html#Exercises"),
        ("https://example.org/a?b#c", "https://example.org/a?b#c"),
        ("mailto:a@example.org", "mailto:a@example.org"),
        ("#below", "#below"),
        ("solutions/02_maximum_acceleration.ipynb", None),
        ("data/cam.csv", None),
    ],
)
def test_a_link_leads_to_a_page_or_out_or_is_plain_words(url: str, leads_to: str | None) -> None:
    prose = Prose(["02_maximum_acceleration"], Pictures("02", NOTEBOOKS / "images"))
    made = BeautifulSoup(prose.html(f"[there]({url})"), "html.parser")
    assert made.get_text().strip() == "there"
    assert [link["href"] for link in made("a")] == ([leads_to] if leads_to else [])


@pytest.mark.parametrize("name", PAGES)
def test_a_page_asks_for_nothing_outside_and_links_only_to_what_is_there(name: str) -> None:
    anchors = {str(tag["id"]) for tag in page(name).select("[id]")}
    for address in addresses(name):
        parts = urlsplit(address)
        if parts.scheme in ("data",):
            continue
        assert not parts.scheme or address.startswith("https://"), address
        if not parts.scheme and parts.path:
            assert unquote(parts.path) in files(), address
        elif not parts.scheme:
            assert unquote(parts.fragment) in anchors, address
    loaded = page(name).select("script[src], link[href], img[src], source[srcset], iframe, object")
    assert not [tag for tag in loaded if "//" in str(tag.attrs)]
    assert not OUTSIDE.search(files()[f"{name}.html"].decode())


@pytest.mark.parametrize("file", ["shared/page.css", "shared/page.js"])
def test_what_is_shared_asks_for_nothing_outside(file: str) -> None:
    assert not OUTSIDE.search(files()[file].decode())


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_small(name: str) -> None:
    assert weight(name) <= MOST_BYTES


def test_all_pages_together_are_small() -> None:
    used = [address for name in PAGES for address in {*addresses(name)} if address in files()]
    shared = {each for each in used if used.count(each) > 1 and not each.endswith(".html")}
    assert {"shared/page.css", "shared/page.js"} <= shared
    assert sum(len(files()[each]) for each in shared) <= MOST_SHARED
    assert sum(map(len, files().values())) <= MOST_IN_ALL
    assert {f"{name}.html" for name in PAGES} == {n for n in files() if n.endswith(".html")}


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_formula_is_mathml(lesson: str) -> None:
    prose = ["".join(c["source"]) for c in cells(lesson) if c["cell_type"] == "markdown"]  # type: ignore[arg-type]
    shown = [o.get("text/markdown", o.get("text/latex", "")) for o in outputs(lesson)]
    wanted = sum(len(FORMULA.findall(CODE.sub("", text))) for text in [*prose, *shown])
    made = page(lesson).select("math")
    assert len(made) >= wanted
    assert not page(lesson).select("merror, math mtext[class]")
    for tag in BeautifulSoup(str(page(lesson)), "html.parser").select("main"):
        for other in tag.select("pre, code, script, svg, math"):
            other.decompose()
        assert not re.search(r"\$|\\[a-zA-Z]{2,}", tag.get_text())


def test_the_font_has_every_letter_of_the_formulas() -> None:
    """A single letter in <mi> is drawn in italics, which has letters of its own; h is Planck's."""
    font = TTFont(BytesIO(files()["shared/formulas.woff"]))
    has, italic = {*font.getBestCmap()}, {"h": 0x210E}
    italic |= {letter: 0x1D434 + n for n, letter in enumerate(ascii_uppercase)}
    italic |= {letter: 0x1D44E + n for n, letter in enumerate(ascii_lowercase) if letter != "h"}
    for lesson in LESSONS:
        for tag in page(lesson).select("mi, mn, mo"):
            for letter in tag.get_text().strip("\u2061\u2062\u2063"):
                is_upright = len(tag.get_text()) > 1 or tag.name != "mi"
                assert (ord(letter) if is_upright else italic.get(letter, ord(letter))) in has, tag
    assert "MATH" in font
    assert "STIX" not in str(font["name"].getDebugName(1))  # a name that its licence reserves


@pytest.mark.parametrize("name", PAGES)
def test_every_picture_has_words_and_a_size(name: str) -> None:
    for image in page(name).select("img"):
        assert len(str(image["alt"])) > 10, image["src"]
        assert int(str(image["width"])) > 0
        assert int(str(image["height"])) > 0
    for drawing in page(name).select("main svg.cm-drawing"):
        assert drawing["role"] == "img"
        assert drawing.select_one("title")


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_figure_and_every_animation_is_there_with_its_state(lesson: str) -> None:
    stored = [output[MIME] for output in outputs(lesson) if MIME in output]
    figures = page(lesson).select("[data-module=figure]")
    states = [each.parent.select_one("script").string for each in figures if each.parent]  # type: ignore[union-attr]
    assert [json.loads(str(state)) for state in states] == [json.loads(each) for each in stored]
    moving = [o for o in outputs(lesson) if "data:image/svg+xml" in o.get("text/html", "")]
    assert len(page(lesson).select("[data-module=player] > svg")) == len(moving)


@pytest.mark.parametrize("lesson", LESSONS)
def test_every_exercise_is_there_and_can_be_answered(lesson: str) -> None:
    numbers = [number for number in EXERCISES if number.startswith(lesson[:2])]
    forms = {str(form["data-exercise"]): form for form in page(lesson).select("form.exercise")}
    assert [*forms] == numbers
    for number, form in forms.items():
        one = find_exercise(number)
        if isinstance(one, NumberExercise):
            (field,) = form.select("input[type=text]")
            (label,) = form.select(f"label[for='{field['id']}']")
            asked = one.wanted_for(NAMELESS)
            assert label.get_text() == asked[:1].upper() + asked[1:]
        elif isinstance(one, ChoiceExercise):
            assert [str(i["value"]) for i in form.select("input[type=radio]")] == [*one.options]
        else:
            assert isinstance(one, NEED_PYTHON)
            assert "needs Python" in form.get_text()
        assert len(form.select(".hints details:not([open])")) == len(one.hints)
    stored = page(lesson).select_one("#answers")
    if numbers:
        assert stored
        answered = json.loads(unpack(json.loads(str(stored.string))))
        assert {n for n in numbers if not isinstance(find_exercise(n), NEED_PYTHON)} <= {*answered}


def test_a_machine_is_told_where_exercises_ask_about_it() -> None:
    told = {lesson[:2] for lesson in LESSONS if repr(NAMELESS) in page(lesson).get_text()}
    own = {"08", "09", "10", "11"}  # a table, a cam, followers and fits, with numbers of their own
    assert told == {number[:2] for number in EXERCISES} - own
    for one in map(find_exercise, EXERCISES):
        names = re.findall(r"\b(?:mill|die)\b", one.question(NAMELESS))
        assert not (names and one.number[:2] in own)


@pytest.mark.parametrize("lesson", LESSONS)
def test_no_answer_and_no_reason_stands_in_plain_text(lesson: str) -> None:
    text = files()[f"{lesson}.html"].decode()
    plain = page(lesson).get_text(" ")
    for number in page(lesson).select("form.exercise"):
        one = find_exercise(str(number["data-exercise"]))
        assert one.right[:40] not in text
        if isinstance(one, NumberExercise):
            assert not any(slip.reason[:40] in text for slip in one.slips)
            assert f"{one.solution(NAMELESS):.5g}" not in number.get_text() or (
                f"{one.solution(NAMELESS):.5g}" in one.question(NAMELESS)
            )
    assert "answer_1" not in plain
    assert "cm.check(" not in plain


@pytest.mark.parametrize("lesson", LESSONS)
def test_what_is_revealed_is_folded_and_waits_for_its_prediction(lesson: str) -> None:
    asked = [str(form["data-predicts"]) for form in page(lesson).select("form.prediction")]
    revealed = [str(each["data-reveals"]) for each in page(lesson).select("[data-reveals]")]
    assert {*revealed} <= {*asked}
    assert len(asked) == len({*asked})
    assert page(lesson).select("main details, main form, main h2")
    assert not page(lesson).select("main details[open]")


def test_a_telephone_shows_letters_where_words_are_asked_for() -> None:
    """Its keys for numbers have no letters, and some no sign."""
    fields = {
        str(field["id"]): str(field["inputmode"])
        for lesson in LESSONS
        for field in page(lesson).select("form input[type=text]")
    }
    for number, one in EXERCISES.items():
        if isinstance(one, NumberExercise):
            assert fields[f"answer-{number}"] == "decimal"
            assert one.solution(NAMELESS) >= 0
    for key, made in PREDICTIONS.items():
        wanted = "text" if isinstance(made.true, str) else "decimal"
        assert fields[f"prediction-{key}"] == wanted, key
    assert {"text", "decimal"} == {*fields.values()}


@pytest.mark.parametrize("lesson", LESSONS)
def test_a_page_lists_its_sections(lesson: str) -> None:
    listed = [link["href"] for link in page(lesson).select("nav.sections li a")]
    assert listed == [f"#{heading['id']}" for heading in page(lesson).select("main h2[id]")] != []


def test_pages_follow_one_another() -> None:
    for before, after in pairwise(LESSONS):
        assert page(before).select_one(f"footer a[rel=next][href='{after}.html']")
        assert page(after).select_one(f"footer a[rel=prev][href='{before}.html']")
    links = [str(link["href"]) for link in page("index").select(".lessons a")]
    assert links == [f"{lesson}.html" for lesson in LESSONS]


@pytest.mark.parametrize("name", PAGES)
def test_a_page_has_one_title_and_no_level_is_skipped(name: str) -> None:
    levels = [int(tag.name[1]) for tag in page(name).select("h1, h2, h3, h4")]
    assert levels.count(1) == 1
    assert levels[0] == 1
    assert all(after - before <= 1 for before, after in pairwise(levels))
    ids = [str(tag["id"]) for tag in page(name).select("[id]") if not tag.find_parent("svg")]
    assert len(ids) == len({*ids})


def test_no_path_of_this_computer_is_in_any_file() -> None:
    for name, content in files().items():
        assert str(NOTEBOOKS.parent).encode() not in content, name
        assert str(Path.home()).encode() + b"/" not in content, name


def test_what_the_contents_say_is_in_the_notebooks() -> None:
    lesson = next(one for one in find_lessons(NOTEBOOKS) if one.number == "02")
    assert (lesson.title, lesson.minutes) == ("How hard is the die pushed?", "35")
    assert lesson.question.startswith("How hard is it pushed")
