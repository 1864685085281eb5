"""What an answer would do is drawn whole, without the right number, and nothing breaks."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from judging import MACHINES
from shown import (
    SHOWN,
    TIMES,
    assert_any_number_breaks_nothing,
    assert_right_fits,
    assert_tells_nothing,
    assert_whole,
    each_shown,
    texts,
    wrong,
)

import cammotion as cm
from cammotion.teaching import session
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.places import GRADING, Place
from cammotion.teaching.shown import frame
from cammotion.teaching.shown.choosing import show_answer
from cammotion.teaching.shown.frame import Frame, Shown
from cammotion.teaching.store import Store
from cammotion.views.plots import COLOURS


def test_as_many_exercises_show_what_an_answer_would_do() -> None:
    assert " ".join(exercise.number for exercise in SHOWN) == (
        "01.1 01.2 01.3 02.1 02.3 02.4 03.1 03.2 03.3 03.4 03.5 04.1 04.2 04.3 05.1 05.3 05.5 "
        "06.3 06.4 06.5 07.2 07.3 08.2 09.1 10.1 11.1"
    )


@each_shown
def test_most_wrong_answers_and_every_right_one_are_shown(exercise: NumberExercise) -> None:
    near = [times for times in TIMES if 0.05 < times < 1.6]
    shown = 0
    for machine in MACHINES:
        right = exercise.solution(machine)
        assert show_answer(exercise, right, machine) is not None
        shown += sum(show_answer(exercise, right * times, machine) is not None for times in near)
    assert shown >= 0.9 * len(MACHINES) * len(near)


@each_shown
def test_a_picture_is_whole(exercise: NumberExercise) -> None:
    right = show_answer(exercise, exercise.solution(EXAMPLE), EXAMPLE)
    for shown in filter(None, [right, *(shown for _, _, shown in wrong(exercise.number))]):
        assert_whole(shown)


@each_shown
def test_what_is_wrong_does_not_fit_and_the_right_number_stands_nowhere(
    exercise: NumberExercise,
) -> None:
    for machine, answer, shown in wrong(exercise.number):
        assert_tells_nothing(exercise, machine, answer, shown)


@each_shown
def test_what_is_right_fits_however_it_is_rounded(exercise: NumberExercise) -> None:
    for machine in MACHINES:
        assert_right_fits(exercise, machine)


ODD: list[Any] = [
    None, ..., "", "4.15", "a" * 1000, b"1", [], [1.0], {}, np.zeros(3), object(), True, 1j,
    math.nan, math.inf, -math.inf, 0, 0.0, -0.0, -5e-324, 5e-324, 1e308, -1, 10**400, 1e-30,
]  # fmt: skip


@each_shown
@pytest.mark.parametrize("answer", ODD, ids=lambda answer: repr(answer)[:20])
def test_an_odd_answer_shows_nothing_and_breaks_nothing(
    exercise: NumberExercise, answer: Any
) -> None:
    shown = show_answer(exercise, answer, EXAMPLE)
    number = isinstance(answer, int | float) and 0.1 < answer < 1e5 and answer is not True
    assert shown is None or number


@each_shown
def test_any_number_breaks_nothing(exercise: NumberExercise) -> None:
    assert_any_number_breaks_nothing(exercise, EXAMPLE, np.geomspace(1e-4, 1e4, 82))


def test_exercises_of_other_kinds_show_nothing() -> None:
    others = [exercise for exercise in EXERCISES.values() if exercise not in SHOWN]
    assert {type(exercise).__name__ for exercise in others} >= {"ChoiceExercise"}
    assert all(
        show_answer(exercise, exercise.solution(EXAMPLE), EXAMPLE) is None for exercise in others
    )


def write(text: str) -> Callable[[MillAndDie, float], Shown]:
    def show(machine: MillAndDie, answer: float) -> Shown:  # noqa: ARG001
        drawn = Frame()
        drawn.text(10, 20, text)
        return drawn.show("A line.")

    return show


def test_a_picture_that_holds_the_right_number_is_kept_back() -> None:
    exercise = EXERCISES["01.1"]
    assert isinstance(exercise, NumberExercise)
    for text, answer, is_seen in [
        ("55.1 deg", 70, False),
        ("56 deg", 70, True),
        ("70 deg", 70, True),
        ("55 deg", 55, True),
    ]:
        writing = replace(exercise, shows=write(text))
        assert (show_answer(writing, answer, EXAMPLE) is not None) == is_seen
    asked = replace(exercise, shows=write("55 deg"), question="Is it 55 deg, {!r}?".format)
    assert show_answer(asked, 70, EXAMPLE) is not None


def test_texts_are_escaped() -> None:
    shown = write('<script>"&')(EXAMPLE, 1)
    assert [text.text for text in texts(shown)] == ['<script>"&']


def test_the_colours_are_those_of_all_pictures() -> None:
    assert COLOURS[:2] == (frame.MILL, frame.DIE)


@pytest.fixture
def _own_session(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(GRADING, raising=False)
    monkeypatch.setattr(session, "_SESSION", session.Session(Store(lambda: Place(tmp_path))))


@pytest.mark.usefixtures("_own_session")
def test_a_check_says_and_shows_it_after_the_reason() -> None:
    said = cm.check("01.1", 140)
    assert said.shown is not None
    assert said.text == f"01.1: Not yet. {said.verdict.text} {said.shown.line}"
    html = said.html
    assert html.index(said.verdict.text[:20]) < html.index("data:image/svg+xml;base64,")
    assert f'alt="{said.shown.line}"' in html
    assert "max-width: 100%" in html
    assert cm.check("01.1", 70).is_right
    assert "closes" in cm.check("01.1", 70).text


@pytest.mark.usefixtures("_own_session")
@pytest.mark.parametrize("answer", [None, "x", -3, 1e9])
def test_a_check_without_a_picture_is_as_it_was(answer: Any) -> None:
    said = cm.check("01.1", answer)
    assert said.shown is None
    assert "<img" not in said.html


@pytest.mark.usefixtures("_own_session")
@pytest.mark.parametrize("error", [ZeroDivisionError(), RecursionError(), MemoryError()])
def test_a_drawing_that_fails_leaves_the_sentence(
    error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(machine: MillAndDie, answer: float) -> Shown:  # noqa: ARG001
        raise error

    exercise = EXERCISES["01.1"]
    assert isinstance(exercise, NumberExercise)
    failing = replace(exercise, shows=fail)
    monkeypatch.setattr(session, "find_exercise", lambda _: failing)
    said = cm.check("01.1", 140)
    assert said.shown is None
    assert said.text == f"01.1: Not yet. {said.verdict.text}"


@pytest.mark.usefixtures("_own_session")
def test_a_grader_sees_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(GRADING, "1")
    right = EXERCISES["01.1"].solution(session._SESSION.machine)
    said = cm.check("01.1", right)
    assert said.is_right
    assert said.shown is None
    with pytest.raises(AssertionError, match=r"both ways together.*half of them[.]$"):
        cm.check("01.1", 2 * right)
