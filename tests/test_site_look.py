"""The colours of the pages: a contrast that WCAG AA asks for, on light paper and on dark."""

import re

import pytest
from site_pages import LESSONS, NOTEBOOKS, PAGES, files, page

from cammotion.site.wording import OTHERWISE

ENOUGH = 4.5
PAIR = re.compile(r"light-dark\((#[0-9a-fA-F]{3,6}), ?(#[0-9a-fA-F]{3,6})\)")
STYLE_NAME = "shared/page.css"
INKS = ("ink", "soft", "link", "right", "wrong")
THEMES = ("light", "dark")
ORDER = re.compile(  # what only a kernel can do
    r"(?:Ask|Change|Choose|Paste|Put|Replace|Run|To keep|Write)\b"
    r".*\b(?:below|cell|explorer|expression|list|machine|numbers|place of|save|write)\b"
)


def style() -> str:
    return files()[STYLE_NAME].decode()


def colours(name: str) -> tuple[str, str]:
    """Return what a variable of the style is, in each theme."""
    found = re.search(rf"--{name}: {PAIR.pattern}", style())
    assert found, name
    return found[1], found[2]


def luminance(colour: str) -> float:
    digits = colour[1:] if len(colour) == 7 else "".join(2 * letter for letter in colour[1:])
    parts = [int(digits[place : place + 2], 16) / 255 for place in (0, 2, 4)]
    red, green, blue = (p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    low, high = sorted(map(luminance, (one, other)))
    return (high + 0.05) / (low + 0.05)


def test_the_measure_is_that_of_wcag() -> None:
    assert contrast("#000", "#ffffff") == pytest.approx(21)
    assert contrast("#767676", "#fff") == pytest.approx(4.54, abs=0.01)


@pytest.mark.parametrize("ink", INKS)
@pytest.mark.parametrize("ground", ["paper", "sunk"])
def test_text_can_be_read(ink: str, ground: str) -> None:
    for on, text in zip(colours(ground), colours(ink), strict=True):
        assert contrast(on, text) >= ENOUGH, (on, text)


def test_code_can_be_read() -> None:
    rules = re.findall(rf"\.code :is\(([^)]+)\)\{{color:{PAIR.pattern}\}}", style())
    assert len(rules) >= 5
    for names, *both in rules:
        for on, text in zip(colours("paper"), both, strict=True):
            assert contrast(on, text) >= ENOUGH, names


@pytest.mark.parametrize("lesson", LESSONS)
def test_code_is_coloured_and_long_code_is_folded(lesson: str) -> None:
    shown = page(lesson).select(".code pre")
    for code in shown:
        is_folded = code.find_parent("details") is not None
        lines = code.get_text().strip().count("\n") + 1
        is_setup = code.get_text().startswith(("import ", "from "))
        assert is_folded == (lines > 12 or is_setup), code.get_text()[:60]
    if lesson[:2] != "00":
        assert page(lesson).select(".code .kn, .code .mi")


def test_no_prompt_and_no_lab_is_left() -> None:
    for lesson in LESSONS:
        plain = page(lesson).get_text()
        assert not re.search(r"\b(In|Out)\s*\[", plain)
        assert "Write your answer in place of" not in plain
        assert "cm.check_setup" not in plain


def test_what_is_said_of_the_lab_is_said_otherwise_on_a_page() -> None:
    texts = [(NOTEBOOKS / f"{lesson}.ipynb").read_text("utf-8") for lesson in LESSONS]
    plain = [page(lesson).get_text() for lesson in LESSONS]
    for in_lab, here in OTHERWISE.items():
        assert sum(text.count(in_lab) for text in texts) == 1, in_lab
        assert not any(in_lab in text for text in plain)
        assert any(here in text for text in plain)
    assert not any("JupyterLab they are" in text for text in plain)


@pytest.mark.parametrize("lesson", LESSONS)
def test_no_page_orders_what_cannot_be_done_on_it(lesson: str) -> None:
    told = page(lesson).select(".prose p, .prose li")
    sentences = (one for tag in told for one in re.split(r"(?<=[.:?!])\s+", tag.get_text()))
    assert not [one for one in sentences if ORDER.match(one)]


@pytest.mark.parametrize("name", PAGES)
def test_a_page_says_before_its_text_that_its_code_has_been_run(name: str) -> None:
    before, _ = files()[f"{name}.html"].decode().split("<h1", 1)
    assert before.count(" has been run") == 1


def test_each_colour_of_a_theme_has_its_light_one_for_an_old_browser() -> None:
    themed = re.findall(rf"([\w-]+): ?{PAIR.pattern}", style())
    light = re.findall(r"@supports not \(color:light-dark\(red,red\)\)\{(.+?)\{(.+?)\}\}", style())
    plain = [tuple(one.split(":")) for _, rule in light for one in rule.split(";")]
    assert [one for one in plain if one[0] != "color-scheme"] == [(n, day) for n, day, _ in themed]
    assert plain.count(("color-scheme", "light")) == len(light) == 7
