"""Reveals: folded without a prediction, open with one, and a word on how far off it was."""

import time
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
RIGHT = "as good as right"
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


@pytest.mark.parametrize(
    ("key", "far", "typed"),
    [
        # another unit, or a part of the one that is asked for
        ("12.bound", "", ("4 kg", "4 N", "4 m", "4 s", "4 m/s3", "4 (m/s)", "4, in g")),
        ("02.peak", "", ("1.04 m/s", "1.04 deg", "a factor of 4", "a factor 4 smaller")),
        ("07.lift", "", ("6.3 km", "6.3 thou", '0.248"', "1/4 in", "0.63 (cm)")),
        ("04.start", "", ("31 deg", "3.09 centimetres", "10.9 mm below the rim")),
        ("11.play", "", ("8.6 arcmin", "2.5 mrad", '515"', "0.07 each side")),
        ("11.play", "", ("0.07, each side", "8.6 (arcminutes)")),
        ("10.jump", "", ("0.15 centimetres", "1500 micrometres")),
        ("08.plate", "", ("5.38 kg m²", "I = 5.38", "the inertia = 5.38", "86, the rest")),
        ("09.error", "", ("0.162 in", "0.162 in/s")),
        ("12.rate", "", ("3857 a day", "92500 per day", "1200pi", "2000x5", "2", "1.93")),
        ("12.rate", "", ("sqrt(4.15/1.12) = 1.925",)),
        # a direction, a bound, what is left
        ("02.few", "", ("16 % higher", "below 1.6 %", "16 % or less", "to 84 %", "84 % of it")),
        ("02.few", RIGHT, ("16 % lower", "down 16 %", "a drop of 16 %", "16, I guess")),
        ("02.few", RIGHT, ("16 percent less than before", "reduced by 16 %")),
        ("02.few", RIGHT, ("it drops by 16 %", "the peak falls by 16 %")),
        ("02.few", "right but for its sign", ("-16 %", "- 16 %", "minus 16 %")),
        ("06.jerk", "", ("3.4 % lower", "above 3 %", "3 % or more")),
        ("06.jerk", RIGHT, ("3.4 % above", "3.4 % more", "3.4 % more or less")),
        ("06.jerk", RIGHT, ("+3.4 %", "plus 3.4 %")),
        ("08.backlash", "", ("5x smaller", "10 times slower", "4.64 (slower)")),
        ("10.cure", "", ("10 times bigger", "1/10", "0.1 times", "down to 1/10", "1/5", "0")),
        ("10.cure", "", ("bigger = 10", "10 (larger)")),
        ("10.cure", "2 times too little", ("5 times less", "5x lower", "five times")),
        ("10.cure", "2 times too little", ("it becomes 5 times smaller",)),
        ("10.cure", RIGHT, ("x10", "10 times weaker", "ten times", "10-fold")),
        ("08.geneva", "", ("10 % gentler", "10 percent down", "10 % drop", "down 10 %", "+10 %")),
        ("08.geneva", "", ("10 % weaker", "1.12 times smaller", "20 % larger", "Ca = 4.95")),
        ("03.share", "", ("under 1 %", "not even 1 %", "up to 1 %", "max 1 %", "not 10 %")),
        ("03.share", "", ("1 %, at most", "0.01 of the stroke")),
        ("03.share", "7 % too little", ("0.6 of a percent", "0.6 %")),
        ("03.share", "22 % too little", ("half a percent",)),
        ("06.spring", "", ("at least 4.8", "least 6", "+2", "4x1.5", "a factor of 1.5")),
        ("06.spring", "", ("1.5 (times)", "2, in addition")),
        ("01.half", "", ("not 110", "+37.5", "185 in total", "ninety two", "a third more")),
        # what is to be reckoned out, and what is
        ("01.half", "", ("double 55", "185 halved", "1_000", "0x5c", "90..95", "10²", "2.27³")),
        ("01.half", "", ("(55/60)²", "16, since (55/60)² = 0.84", "1 -1/2")),
        ("01.half", RIGHT, ("= 92.5", "185/2 = 92.5", "92 1/2", "the answer = 92.5")),
        ("01.half", RIGHT, ("92.5 per way", "it gets 92")),
        ("02.peak", RIGHT, ("a = 1.04", "1.04 m / s^2", "1.04 m s⁻²", "at 110°: 1.04")),
        ("09.error", RIGHT, ("0.16 in/sec^2", "+-0.16", "±0.16", "4×0.04 = 0.16")),
        ("09.error", RIGHT, ("at worst 0.162", "up to 0.162", "by 0.162", "0.162 either way")),
        (
            "02.fraction",
            RIGHT,
            ("tm / 4", "tm/4", "tm/ 4", "$t_m$/4", "x=0.25", "25 pct", "25 \uff05"),
        ),
        ("02.fraction", RIGHT, ("¼", "a quarter", "1\u20444", "quarter of the time")),
        ("02.fraction", "", ("25 hundredths", "T/4")),
        ("10.stay", RIGHT, ("half", "½", "half of it", "±50 %", "50 to each side")),
        ("10.stay", RIGHT, ("50 % each way",)),
        ("08.plate", "2 % too much", ("1/7 of the inertia", "a seventh")),
        # places, lines and pieces are counted
        ("09.place", "", ("11th from the bottom", "3rd last", "8th from the end", "8th weakest")),
        ("09.place", "", ("8 (from the bottom)", "8, counted from the end")),
        ("09.place", RIGHT, ("8th", "eighth", "the 8th strongest", "8 of 18", "no. 8")),
        ("11.errors", "", ("16 are right", "8.5", "24/3")),
        ("11.errors", RIGHT, ("8 of 24", "8 out of 24 lines", "eight", "8 are wrong")),
        ("11.errors", RIGHT, ("8 errors", "8 break it", "I counted 8", "there are 8")),
        (
            "12.rate",
            RIGHT,
            ("3.857", "3,857", "3 857", "3'857", "٣٨٥٧", "\uff13\uff18\uff15\uff17"),
        ),
        ("12.rate", RIGHT, ("3857 an hour", "3857 pcs/h", "limited by the mill, 3857", "3.857e3")),
        ("12.rate", "2.6 times too much", ("10.000", "10000 in an hour")),
        # words that say nothing more
        ("01.half", RIGHT, ("I hope 92", "the answer is 92", "It'll be 92", "92-ish", "92?")),
        ("01.half", RIGHT, ("pretty much 92", "close to 92", "92 more or less")),
        ("01.half", RIGHT, ("maybe 92°, not sure", "92 or so", "I'd say 92, as it was")),
        ("04.start", "35 % too little", ("20 mm at the rim", "at the rim: 20", "a depth of 20")),
        (
            "11.play",
            "30 % too little",
            ("a tenth of a degree", "1/10 of a degree", "0.1, as before"),
        ),
        ("11.play", RIGHT, ("0.14 in total", "0.14 degrees of cam angle in all")),
        # what stands before "=" is read, too: a letter with an index is a name
        ("11.errors", "", ("right = 16", "16 (correct)", "16, right", "16 lines ok")),
        ("07.steel", "", ("diameter = 314 mm", "d = 314", "factor = 2.7", "314 (diameter)")),
        ("02.few", "", ("left = 84 %", "16 % (increase)", "it becomes 84 %", "falls to 84 %")),
        ("12.bound", "", ("kg = 4", "g = 4", "I = 4", "!= 4")),
        (
            "02.peak",
            RIGHT,
            ("a_max = 1.04", "peak = 1.04", "x=1.04", "a quarter, 1.04", "falls to 1.04"),
        ),
        ("04.start", RIGHT, ("depth = 31", "d = 31 mm")),
        ("06.spring", RIGHT, ("P = 6", "Ca = 6", "it pushes with 6")),
        # more of it, or another part of it, may stand in the remark
        ("08.geneva", "", ("half as much again", "Ca ≈ 4.95", "smaller, 1.12", "larger, 10 %")),
        ("02.peak", "", ("4 (times smaller)", "falls 3.1", "falls to 1/4", "a quarter, 0.25")),
        ("02.fraction", "", ("0.25 (from the end)", "0.25, before the end", "t_m = 0.06")),
        ("04.start", "", ("19 mm (from the bottom)", "down 19 mm", "no, 19 mm", "gap = 19 mm")),
        ("10.stay", "", ("100 in total", "100 % (in all)")),
        ("05.best", "", ("0.78 (of it)", "0.78, a share")),
        # in words, or with a place or a yes or no, and then in figures
        ("02.peak", "2 times too much", ("half, 2.08", "half: 2.08", "half of it, so 2.08")),
        ("12.rate", "4 % too much", ("twice, 4000", "twice as fast: 4000")),
        ("02.fraction", "2 times too much", ("at mid-stroke, 0.5", "halfway: 0.5")),
        ("02.fraction", "too little", ("at the start: 0", "none, 0", "not at all, 0")),
        ("07.lift", "2.1 times too little", ("no, 3 mm", "No. 3 mm", "no: off by 3 mm")),
        ("07.lift", RIGHT, ("6.3 mm at the worst place",)),
        ("04.start", "39 % too little", ("19 mm down", "falls to 19 mm")),
        ("08.geneva", "68 % too much", ("larger, 1.5", "1.5 times larger")),
        ("08.geneva", RIGHT, ("smaller, 0.9", "a bit smaller, 0.9")),
        ("05.best", RIGHT, ("modified trapezoid: 3.23", "3.23 with the modified trapezoid")),
        ("10.jump", RIGHT, ("it flies 1.5 mm", "1.5 mm off the cam", "1.5 mm away from the cam")),
        # the question prints it, and 2 % of it are all that can be gained
        ("06.machine", "2 % too much", ("0.5195",)),
        ("06.machine", RIGHT, ("0.51", "0.511")),
    ],
)
def test_an_unknown_word_beside_a_number_makes_it_none(
    key: str, far: str, typed: tuple[str, ...]
) -> None:
    assert {text: PREDICTIONS[key].how_far(text) for text in typed} == dict.fromkeys(typed, far)


def test_a_long_text_is_read_at_once() -> None:
    began = time.process_time()
    for text in ("a" + 20_000 * " " + "b", 10_000 * "=1", 10_000 * "- ", 7_000 * "1, "):
        assert PREDICTIONS["02.fraction"].how_far(text) == ""
    assert time.process_time() - began < 1


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
