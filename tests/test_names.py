"""Names in pictures: one line, short, none like another, and no dearer for being long."""

import time
import unicodedata
import warnings

import pytest
from cartons import ODD_NAMES
from matplotlib import font_manager
from matplotlib import pyplot as plt

from cammotion.views import names
from cammotion.views.names import MOST, as_label, cut, labels, plain, printable, short, short_names

_SCRIPT_A = "\N{MATHEMATICAL SCRIPT CAPITAL A}"


def columns(text: str) -> int:
    """Return how many columns a terminal would give a text, counted by hand."""
    seen = (c for c in text if not unicodedata.category(c).startswith("M"))
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in seen)


@pytest.mark.parametrize("name", ODD_NAMES)
@pytest.mark.parametrize("most", [5, 12, MOST])
def test_a_short_name_is_one_printable_line_of_few_columns(name: str, most: int) -> None:
    shown = short(name, most)
    assert columns(shown) <= most
    assert shown.isprintable()
    assert "  " not in shown


@pytest.mark.parametrize(
    ("name", "shown"),
    [
        ("die", "die"),
        ("n" * 24, "n" * 24),
        ("a" * 14 + "b" * 9 + "cc", "a" * 14 + "…" + "b" * 7 + "cc"),
        ("包装機の製品プッシャー", "包装機の製品プッシャー"),
        ("包装機の製品プッシャー二号機の一", "包装機の製品プ…号機の一"),
        ("Sto\u0308ßel", "Stößel"),
        ("a\tb\nc\r\nd", "a b c d"),
        ("\x00\x07bell", "bell"),
        ("\u202eright to left\u200b", "right to left"),
        ("\u0301\u0301", ""),
        ("\u3164\u2800", ""),
    ],
)
def test_what_is_shown_for_a_name(name: str, shown: str) -> None:
    assert short(name) == shown


def test_marks_stay_with_their_letter_and_do_not_pile_up() -> None:
    assert short("e\u0301\u0323" * 40, 5) == "ẹ\u0301" * 3 + "…" + "ẹ\u0301"
    assert short("a" + "\u0301" * 5000) == "á\u0301\u0301\u0301…"


def test_names_that_are_shortened_alike_have_their_numbers() -> None:
    alike = ["n" * 1000, "die", "n" * 1001, "\u200b", "\u2800", "die "]
    shown = short_names(alike)
    assert len({*shown}) == len(alike)
    assert shown[1:4:2] == ["die (2)", "no. 4"]
    assert all(columns(name) <= MOST for name in shown)
    taken = short_names(["a", "a ", "a (2)"])  # called like another with its number
    assert len({*taken}) == 3


def test_a_long_name_costs_no_more_than_a_short_one() -> None:
    """The rest of it is not looked at: ten times as long takes as long."""

    def seconds(name: str) -> float:
        best = float("inf")
        for _ in range(5):
            started = time.perf_counter()
            for _ in range(20):
                short(name)
            best = min(best, time.perf_counter() - started)
        return best

    assert seconds("n" * 1_000_000) < 3 * seconds("n" * 1000)


def test_letters_that_no_font_has_are_boxes_and_do_not_warn() -> None:
    assert labels(["𓀀 die", "𓀀𓀁", "die"]) == ["□ die", "no. 2", "die"]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figure = plt.figure()
        for odd in ODD_NAMES:
            plain(figure.text(0.1, 0.5, short(odd)))
        text = figure.text(0.1, 0.5, "$x_1$\n\x07𓀀")
        plain(text)
        figure.canvas.draw()
    assert text.get_text() == "$x_1$\n□"
    plt.close("all")


def test_letters_are_taken_from_another_font_that_is_here(monkeypatch: pytest.MonkeyPatch) -> None:
    """Matplotlib brings one with mathematical letters, which its usual font lacks."""
    assert labels([_SCRIPT_A]) == ["no. 1"]
    monkeypatch.setattr(names, "_OTHER_FONTS", ("No Such Font", "STIXGeneral"))
    names._other_families.cache_clear()
    try:
        assert labels([_SCRIPT_A]) == [_SCRIPT_A]
        text = plt.figure().text(0, 0, _SCRIPT_A)
        plain(text)
        assert text.get_fontfamily()[-1] == "STIXGeneral"
        assert {"STIXGeneral"} <= {font.name for font in font_manager.fontManager.ttflist}
    finally:
        names._other_families.cache_clear()
        plt.close("all")


def test_a_line_is_cut_to_its_width_at_its_end() -> None:
    assert cut("die", 100, 12) == "die"
    assert cut("the lower left jaw", 60, 12) == "the lo…"
    assert cut("𓀀" * 100_000, 30, 12).endswith("…")


def test_a_name_with_a_line_before_it_is_a_label_too() -> None:
    assert as_label("_die").strip() == "_die"
    assert not as_label("_die").startswith("_")
    assert printable("die\u00ad\u200d") == "die"
