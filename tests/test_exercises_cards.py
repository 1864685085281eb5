"""What an exercise shows: cards and controls, for eyes, for screen readers and without a kernel."""

from pathlib import Path
from typing import Any

import ipywidgets
import pytest
from bs4 import BeautifulSoup, Tag
from judging import each_choice

import cammotion as cm
from cammotion.teaching import session
from cammotion.teaching.controls import ChoiceControl
from cammotion.teaching.exercise import ChoiceExercise, Verdict
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.messages import _COLOURS, Feedback, Outcome, Progress
from cammotion.teaching.places import GRADING, Place
from cammotion.teaching.session import Session
from cammotion.teaching.store import Store


@pytest.fixture(autouse=True)
def _own_session(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep what is done in a folder of this test's own."""
    monkeypatch.delenv(GRADING, raising=False)
    monkeypatch.setattr(session, "_SESSION", Session(Store(lambda: Place(tmp_path))))


def restart() -> None:
    """Begin anew, as a new kernel does."""
    session._SESSION = Session(Store(session._SESSION.store.find_place))


def html_of(thing: Any) -> BeautifulSoup:
    """Return what a browser gets."""
    return BeautifulSoup(thing._repr_mimebundle_()["text/html"], "html.parser")


def only(page: BeautifulSoup, selector: str) -> Tag:
    """Return the one element that a selector of CSS finds."""
    (element,) = page.select(selector)
    return element


def luminance(colour: str) -> float:
    """Return the relative luminance of a colour like "#1b1b1b", as WCAG 2 defines it."""
    shares = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    linear = [s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours, from 1 to 21."""
    low, high = sorted([luminance(one), luminance(other)])
    return (high + 0.05) / (low + 0.05)


def test_the_contrast_is_computed_as_it_is_defined() -> None:
    assert contrast("#000000", "#ffffff") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("answer", [70, 140, None])
def test_the_colours_of_an_answer_can_be_read(answer: object) -> None:
    box = only(html_of(cm.check("01.1", answer)), "[role=status]")
    style = dict(part.split(": ", 1) for part in str(box["style"]).split("; "))
    assert contrast(style["color"], style["background"]) >= 4.5
    edge = style["border-left"].split()[-1]
    assert contrast(edge, style["background"]) >= 3


def test_the_three_states_differ_in_colour_and_in_words() -> None:
    assert len({*_COLOURS.values()}) == len(_COLOURS) == 3
    heads = [
        only(html_of(cm.check("01.1", answer)), "strong").get_text() for answer in (70, 140, None)
    ]
    assert heads == ["01.1: Right.", "01.1: Not yet.", "01.1 is not answered yet."]


def test_an_answer_as_text_and_as_html_say_the_same() -> None:
    for answer in (70, 140, None):
        said = cm.check("01.1", answer)
        assert repr(said) == said._repr_mimebundle_()["text/plain"] == said.text
        assert html_of(said).get_text(" ", strip=True) == said.text


def test_what_is_said_is_escaped() -> None:
    hostile = '<script>alert("x")</script> & <b>'
    for said in (
        cm.check("01.4", hostile),
        Feedback("01.1", Verdict("wrong", hostile), note=hostile),
        Progress((Outcome("01.1", "open"),), note=hostile),
    ):
        html = said._repr_mimebundle_()["text/html"]
        assert "<script" not in html
        assert "<b>" not in html
        assert "<script>" in html_of(said).get_text()


def test_a_note_on_the_file_comes_last() -> None:
    said = Feedback("01.1", Verdict("right", "So it is."), note="The disk is full.")
    assert said.text == "01.1: Right. So it is. The disk is full."
    assert only(html_of(said), "small").get_text() == "The disk is full."


def test_a_question_is_shown_with_its_unit_and_its_formulas() -> None:
    bundle = cm.ask("02.1")._repr_mimebundle_()
    assert [*bundle] == ["text/plain", "text/markdown"]
    assert bundle["text/plain"].startswith("Exercise 02.1. The die goes 51 mm down over 70 degrees")
    assert bundle["text/plain"].endswith("(Answer: one number in m/s².)")
    assert "$h = h_m" in cm.ask("02.2")._repr_mimebundle_()["text/markdown"]


def test_a_hint_is_announced() -> None:
    hint = cm.hint("02.3")
    assert only(html_of(hint), "[role=status]").get_text() == hint.text


def test_progress_is_a_table_with_heads() -> None:
    cm.check("01.1", 70)
    cm.check("01.2", 7)
    page = html_of(cm.progress())
    summary, where = page("p")
    assert summary.get_text() == f"1 of {len(EXERCISES)} exercises are right."
    assert where.get_text() == f"Your progress is kept in {session._SESSION.store.file}."
    assert [head.get_text() for head in page.find_all("th", scope="col")] == ["exercise", "state"]
    assert [head.get_text() for head in page.find_all("th", scope="row")] == [*EXERCISES]
    assert [cell.get_text() for cell in page.find_all("td")][:3] == [
        *("right, 1 try", "not yet, 1 try", "open")
    ]
    assert cm.progress().text.splitlines()[1:3] == ["01.1  right, 1 try", "01.2  not yet, 1 try"]


def feedback_of(control: ChoiceControl) -> str:
    """Return what a control says below its options."""
    said = control.children[-1]
    assert isinstance(said, ipywidgets.HTML)
    return BeautifulSoup(said.value, "html.parser").get_text(" ", strip=True)


@each_choice
def test_nothing_is_chosen_beforehand(exercise: ChoiceExercise) -> None:
    control = cm.choose(exercise.number)
    assert control.answer is None
    assert control.buttons.index is None
    assert feedback_of(control) == ""
    assert cm.progress().text.count("  open\n") == len(EXERCISES)


@each_choice
def test_a_control_has_a_name_and_every_option(exercise: ChoiceExercise) -> None:
    control = cm.choose(exercise.number)
    assert control.buttons.description == "Your choice:"
    assert [label for label, _ in control.buttons.options] == [
        f"({letter}) {text}" for letter, text in exercise.options.items()
    ]
    heading = BeautifulSoup(control.children[0].value, "html.parser").get_text()
    assert heading == f"Exercise {exercise.number}. {exercise.question(cm.variant())}"


@each_choice
def test_each_choice_is_answered_at_once_with_its_reason(exercise: ChoiceExercise) -> None:
    control = cm.choose(exercise.number)
    for letter in exercise.options:
        control.buttons.value = letter
        right = letter == exercise.answer
        reason = exercise.right if right else exercise.reasons[letter]
        word = "Right." if right else "Not yet."
        assert feedback_of(control) == f"{exercise.number}: {word} {reason}"
        assert cm.check(exercise.number, None).is_right is right
    restart()
    again = cm.choose(exercise.number)
    assert again.answer == letter
    assert letter in exercise.options
    assert feedback_of(again) == feedback_of(control)


def test_a_choice_given_in_a_cell_is_shown_by_the_control() -> None:
    cm.check("01.4", " (C). ")
    assert cm.choose("01.4").answer == "c"


@each_choice
def test_a_reader_without_a_kernel_gets_question_and_options(exercise: ChoiceExercise) -> None:
    control = cm.choose(exercise.number)
    for letter in (None, exercise.answer):  # what is stored does not change with the choice
        control.buttons.value = letter
        bundle = control._repr_mimebundle_()
        assert "application/vnd.jupyter.widget-view+json" in bundle
        options = [f"({letter}) {text}" for letter, text in exercise.options.items()]
        question = f"Exercise {exercise.number}. {exercise.question(cm.variant())}"
        assert bundle["text/plain"].splitlines() == [question, *options]
        assert [item.get_text() for item in html_of(control).find_all("li")] == options


def test_a_prediction_has_a_name_and_is_empty_at_first() -> None:
    control = cm.predict("01.half", "degrees for each way")
    label = BeautifulSoup(control.field.description, "html.parser")
    assert label.get_text() == "I predict, degrees for each way:"
    assert control.field.description_allow_html
    assert control.field.value == ""
    assert control.field.placeholder
    empty = control._repr_mimebundle_()["text/plain"]
    assert empty == "I predict, degrees for each way: run this cell, and type it here"
    control.field.value = "60"
    assert control._repr_mimebundle_()["text/plain"] == "I predict, degrees for each way: 60"
    assert "application/vnd.jupyter.widget-view+json" in control._repr_mimebundle_()


def test_a_prediction_that_is_taken_back() -> None:
    control = cm.predict("01.half", "deg")
    for typed in ("60", " "):
        control.field.value = typed
    restart()
    assert cm.predict("01.half", "deg").said == "You made no prediction."
