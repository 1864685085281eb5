"""Reveals: folded without a prediction, open with one, and a word on how far off it was."""

from pathlib import Path

import pytest
from bs4 import BeautifulSoup, Tag
from hypothesis import given
from hypothesis import strategies as st

import cammotion as cm
from cammotion.teaching import session
from cammotion.teaching.controls import PredictionControl, Reveal
from cammotion.teaching.lessons import PREDICTIONS
from cammotion.teaching.places import GRADING, Place
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.session import Session
from cammotion.teaching.store import Store

HALF = PREDICTIONS["01.half"]
ANSWER = ("It is 92.5 & no more.", "Not <b>110</b>.")
SHOWN = [*ANSWER, HALF.why]
FOLDED = "The answer is folded: you made no prediction yet."


@pytest.fixture(autouse=True)
def _own_session(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep what is done in a folder of this test's own."""
    monkeypatch.delenv(GRADING, raising=False)
    monkeypatch.setattr(session, "_SESSION", Session(Store(lambda: Place(tmp_path))))


def details(page: str) -> Tag:
    """Return the one part of a page that can be folded."""
    (found,) = BeautifulSoup(page, "html.parser")("details")
    assert isinstance(found, Tag)
    return found


def assert_folded(reveal: Reveal) -> None:
    """Assert that live and stored the answer is folded, and that no plain text tells it."""
    bundle = reveal._repr_mimebundle_()
    assert bundle["text/plain"] == repr(reveal) == FOLDED
    assert bundle["text/html"] == reveal.value
    folded = details(reveal.value)
    assert not folded.has_attr("open")
    assert folded.summary is not None
    assert folded.summary.get_text() == "Show the answer (you made no prediction yet)"
    assert [p.get_text() for p in folded("p")] == SHOWN
    page = BeautifulSoup(reveal.value, "html.parser")
    for part in page("details"):
        part.decompose()
    assert page.get_text() == ""


def assert_open(reveal: Reveal, said: str) -> None:
    """Assert that the answer is open, under what is said of the prediction."""
    page = BeautifulSoup(reveal.value, "html.parser")
    assert details(reveal.value).has_attr("open")
    assert page.strong is not None
    assert page.strong.get_text() == said
    assert reveal._repr_mimebundle_()["text/plain"] == "\n".join([said, *SHOWN])


def test_run_all_folds_the_answer_and_a_prediction_typed_later_opens_it() -> None:
    guess = cm.predict(HALF.key, HALF.asked)
    reveal = guess.reveal(*ANSWER)
    assert_folded(reveal)
    guess.field.value = "110"
    assert_open(reveal, "You predicted 110: 19 % too much.")
    guess.field.value = " "
    assert_folded(reveal)


def test_a_prediction_counts_in_each_run_of_its_cell_and_after_a_restart() -> None:
    """The reveal below may be of an earlier run than the field into which is typed."""
    reveal = cm.predict(HALF.key, HALF.asked).reveal(*ANSWER)
    cm.predict(HALF.key, HALF.asked).field.value = "60"
    assert_open(reveal, "You predicted 60: 35 % too little.")
    session._SESSION = Session(Store(session._SESSION.store.find_place))
    again = cm.predict(HALF.key, HALF.asked).reveal(*ANSWER)
    assert_open(again, "You predicted 60: 35 % too little.")


def test_what_another_notebook_has_kept_is_shown() -> None:
    reveal = cm.predict(HALF.key, HALF.asked).reveal(*ANSWER)
    other = Session(Store(session._SESSION.store.find_place))
    other.prediction(HALF.key, HALF.asked).field.value = "92"
    assert_folded(reveal)
    assert cm.predict(HALF.key, HALF.asked).prediction == "92"
    assert_open(reveal, "You predicted 92: as good as right.")


def test_a_prediction_that_no_lesson_knows_is_revealed_without_a_word_of_its_own() -> None:
    guess = cm.predict("my.own", "mm")
    guess.field.value = "7"
    assert repr(guess.reveal("It is 8.")) == "You predicted 7.\nIt is 8."


def test_half_a_number_is_no_prediction() -> None:
    """A prediction counts when the field is left, not with its first digit."""
    assert cm.predict(HALF.key, HALF.asked).field.continuous_update is False


@pytest.mark.parametrize("typed", ["<script>alert()</script>", "a\u202eb", "about 50 or 60"])
def test_what_is_no_number_is_said_as_it_was_typed(typed: str) -> None:
    guess = cm.predict(HALF.key, HALF.asked)
    guess.field.value = typed
    assert_open(guess.reveal(*ANSWER), f"You predicted {typed}.")


@pytest.mark.parametrize(
    ("key", "typed", "far"),
    [
        ("01.half", "about 55 degrees", "41 % too little"),
        ("01.half", "92,5", "as good as right"),
        ("01.half", "185", "2 times too much"),
        ("01.half", "0", "too little"),
        ("01.half", "-5", "of the wrong sign"),
        ("02.few", "-16", "right but for its sign"),
        ("01.harder", "the die, 4 times", ""),
        ("02.fraction", "1/2", "2 times too much"),
        ("02.fraction", "75 %", "3 times too much"),  # the braking, and the push is asked for
        ("02.fraction", "1/4 of tm", "as good as right"),
        ("02.peak", "a quarter of 4.154", ""),
        ("02.peak", "1/4 of the peak", ""),
        ("02.few", "twice 9", ""),
        ("12.bound", "2pi", ""),
        ("12.bound", "2π", ""),
        ("12.bound", "2 pi", ""),
        ("12.rate", "2x", ""),
        ("12.rate", "5 times", ""),
        ("08.backlash", "2x", "2.3 times too little"),
        ("08.geneva", "90 %", "as good as right"),
        ("08.geneva", "0.9 of it", "as good as right"),
        ("11.errors", "8/24", ""),
        ("11.play", "8.6'", ""),
        ("03.share", "10 %", "16 times too much"),
        ("03.share", "0.1 percent", "6.5 times too little"),
        ("06.spring", "5", "17 % too little"),
        ("02.peak", "1,039", "as good as right"),
        ("02.peak", "0,806 m/s²", "22 % too little"),
        ("02.peak", "2.08", "2 times too much"),
        ("02.peak", "2.077", "2 times too much"),
        ("02.peak", "0.52", "2 times too little"),
        ("02.peak", "2", "92 % too much"),
        ("05.best", "about 4,154", "29 % too much"),
        ("02.few", "15,970", "as good as right"),
        ("11.play", "0.14", "as good as right"),  # the lesson writes it so
        ("11.play", "0.135", "6 % too little"),
        ("08.plate", "1/7", "2 % too much"),
        ("08.plate", "0.14", "right, if it is a share (in percent it is a hundred times that)"),
        ("08.plate", "0.14 %", "100 times too little"),
        ("08.plate", "1400", "100 times too much"),
        ("02.few", "0.01597", "1000 times too little"),
        ("10.stay", "0.5", "right, if it is a share (in percent it is a hundred times that)"),
        ("08.backlash", "10^0.667", ""),
        ("08.backlash", "√10", ""),
        ("09.error", "4*0.0005*81", ""),
        ("09.error", "4.1 mm/s²", ""),
        ("09.error", "1 %", ""),
        ("09.error", "1 percent", ""),
        ("08.geneva", "less than 1", ""),
        ("12.rate", "64 per minute", ""),
        ("12.rate", "3857 pieces per hour", "as good as right"),
        ("09.place", "1", "7 places off"),
        ("09.place", "9", "1 place off"),
        ("09.place", "8", "as good as right"),
        *[("08.geneva", change, "") for change in ("10 % lower", "by 10 %", "10% off", "-10 %")],
        ("10.cure", "10 times smaller", "as good as right"),
        ("11.play", "0.143 deg of cam angle", "as good as right"),
        ("10.cure", "a factor of 10", "as good as right"),
        ("11.errors", "8 of them", "as good as right"),
        ("11.errors", "0.3 of them", ""),
        ("12.next", "13.1, that of the second", "as good as right"),
        ("02.peak", "0.9 of it", ""),
        ("02.peak", "a tenth of 4.154", ""),
        ("02.peak", "half of the 4.154", ""),
        ("02.peak", "2 thirds", ""),
        ("06.spring", "6 and a half", ""),
        ("02.peak", "1.04, a quarter of it", "as good as right"),
        ("02.fraction", "1/4 (a quarter)", "as good as right"),
        ("10.stay", "50 %, half the stroke", "as good as right"),
        ("01.half", "110, twice as many", "19 % too much"),
        *[("02.fraction", f"0.25 {of} tm", "as good as right") for of in ("x", "×", "*", "times")],
        *[("02.fraction", f"25 {p}", "as good as right") for p in ("per cent", "Prozent")],
        ("09.error", "25 Percent", ""),
        *[("01.half", typed, "as good as right") for typed in ("'92.5'", "\u201892.5\u2019")],
        ("02.peak", "2 pi²", ""),
        ("06.spring", "1½", "4 times too little"),
        ("09.place", "8/18", ""),
    ],
)
def test_how_far_off_it_is(key: str, typed: str, far: str) -> None:
    assert PREDICTIONS[key].how_far(typed) == far


def test_what_may_be_two_numbers_is_asked_and_the_answer_stays_folded() -> None:
    made = Prediction("k", "pieces/h", 2000.0, HALF.why, high=5000)
    guess = PredictionControl(made.asked, "", lambda _: None, made)
    reveal = guess.reveal(*ANSWER)
    guess.field.value = "2,000"
    asked = "“2,000” may be 2 or 2000: write it with a point, or with no mark."
    assert repr(reveal) == f"The answer is folded: {asked}"
    assert asked in guess.children[1].value
    assert "<details open" not in reveal.html
    guess.field.value = "2000"
    assert_open(reveal, "You predicted 2000: as good as right.")
    assert "may be" not in guess.children[1].value


@pytest.mark.parametrize("made", PREDICTIONS.values(), ids=PREDICTIONS)
def test_no_prediction_of_a_lesson_is_asked_about(made: Prediction) -> None:
    assert isinstance(made.true, str) or made.true < made.high
    assert made.unclear("4,154") == ""


@given(st.floats(1e-6, 1e6), st.floats(1e-6, 1e6))
def test_how_far_off_two_numbers_are(true: float, typed: float) -> None:
    said = Prediction("k", "mm", true).how_far(f"{typed:.17g}")
    if abs(typed / true - 1) <= 0.02:
        assert said == "as good as right"
    else:
        assert said.endswith("too much" if typed > true else "too little")
        assert not said.startswith(("0 %", "1 %", "1 times"))
