"""Fresh numbers for an exercise: three rounds as a learner plays them, and whatever goes wrong."""

import json
import re
from collections.abc import Iterator
from dataclasses import fields, replace
from datetime import date
from itertools import islice
from pathlib import Path
from typing import Any

import pytest
from desk import STRANGERS, files_in, line_of, read_file, restart, sit_down
from fresh import check_questions

import cammotion as cm
from cammotion.teaching import again as fresh_numbers
from cammotion.teaching import example, session
from cammotion.teaching.classroom.collect import read_class
from cammotion.teaching.classroom.page import write
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Exercise, Slip
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.places import FILE, GRADING
from cammotion.teaching.variants import machine_for

ASKED = [one for one in EXERCISES.values() if not isinstance(one, ChoiceExercise)]
CHOICES = [one for one in EXERCISES.values() if isinstance(one, ChoiceExercise)]
each_asked = pytest.mark.parametrize("exercise", ASKED, ids=lambda exercise: exercise.number)


@pytest.fixture(autouse=True)
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sit down in the folder of the copies of a workbook."""
    yield from sit_down(tmp_path, monkeypatch)


def now(number: str) -> MillAndDie:
    """Return the fresh numbers that an exercise asks about."""
    machine = session._SESSION.practice.machine(number)
    assert machine is not None
    return machine


def answer(number: str, *, factor: float = 1) -> str:
    """Answer an exercise by its fresh numbers, right if no factor spoils it."""
    return cm.check(number, factor * EXERCISES[number].solution(now(number))).text


def row_of(number: str, work: Path) -> Any:
    return read_file(work)["exercises"][number]["again"]


def test_three_rounds_as_a_learner_plays_them() -> None:
    anna = cm.variant("Anna")
    first = cm.check("02.1", EXERCISES["02.1"].solution(anna)).text
    assert "twice a move. With this peak" in first
    assert first.endswith('cm.again("02.1") asks it with fresh numbers.')
    asked = [cm.ask("02.1").text]
    said = []
    for _ in range(3):
        asked.append(cm.again("02.1").text)
        said.append(answer("02.1"))
    assert len({*asked}) == 4
    assert all("Exercise 02.1. With fresh numbers: The die goes" in text for text in asked[1:])
    assert [text.partition("where it has to press. ")[2] for text in said] == [
        'The first in a row. cm.again("02.1") asks once more.',
        'Two in a row. cm.again("02.1") asks once more.',
        "Three in a row: you can do this.",
    ]
    assert line_of("02.1") == "right, 1 try, three in a row"
    restart()
    assert line_of("02.1") == "right, 1 try, three in a row"


@each_asked
def test_every_exercise_can_be_asked_again_alone(exercise: Exercise) -> None:
    own = machine_for("Anna")
    check_questions.rounds(exercise, own, 2)
    first, second = islice(fresh_numbers.fresh_machines(exercise, own), 2)
    cm.variant("Anna")
    text = cm.again(exercise.number).text
    assert now(exercise.number) == first
    assert text.partition(": ")[2].startswith(fresh_numbers.whole_question(exercise, first))
    cm.again(exercise.number)
    assert now(exercise.number) == second
    assert cm.check(exercise.number, exercise.solution(second)).is_right
    assert not cm.check(exercise.number, exercise.solution(first)).is_right
    assert not cm.check(exercise.number, exercise.solution(own)).is_right


def test_a_cam_with_fresh_numbers_is_not_that_of_another_exercise() -> None:
    """Its shaft had 20 mm, and that of 11.1, which still has the learner's numbers, had 55."""
    assert re.search("With fresh numbers: A cam is held by a key", cm.again("11.4").text)


def test_each_number_of_a_machine_is_changed_to_see_whether_a_question_tells_it() -> None:
    """Of 08.3 only the angle was told: plate, stations, time and law were fresh, and unknown."""
    own = machine_for("Anna")
    told = {field.name for field in fields(own) if field.compare}
    assert told == check_questions.OTHERS.keys() | check_questions.CHOICES.keys()
    for part, choices in check_questions.CHOICES.items():
        assert {field.name for field in fields(getattr(own, part))} == choices.keys()
    asked = fresh_numbers.whole_question(EXERCISES["08.3"], own)
    table = own.table
    for number in (table.plate_kg, table.hole_mm, table.stops, table.time_s, table.law):
        assert re.search(rf"(?<![\w.]){number}\b", asked)
    assert "the table of exercise 08.2" in EXERCISES["08.3"].question(own)


@pytest.mark.parametrize("number", ["02.1", "06.1"])
def test_the_numbers_depend_on_who_and_the_round_alone(number: str) -> None:
    exercise = EXERCISES[number]
    draws = {
        who: [
            exercise.question(machine)
            for machine in islice(fresh_numbers.fresh_machines(exercise, machine_for(who)), 3)
        ]
        for who in ("Anna", " ANNA ", "Bert", "")
    }
    assert draws["Anna"] == draws[" ANNA "]
    assert draws["Anna"] != draws["Bert"] != draws[""] != draws["Anna"]


def test_what_anna_is_asked_first_for_ever() -> None:
    machine = next(fresh_numbers.fresh_machines(EXERCISES["02.1"], machine_for("Anna")))
    assert (machine.rate_per_hour, machine.stroke_mm, machine.die_angle_deg) == (1700, 50, 60.0)


def test_a_wrong_answer_begins_the_row_anew_and_one_that_is_none_does_not() -> None:
    cm.again("02.1")
    answer("02.1")
    cm.again("02.1")
    for nothing in ("4.1", [1], None):
        cm.check("02.1", nothing)
    assert "Two in a row." in answer("02.1")
    cm.again("02.1")
    said = answer("02.1", factor=1.5)
    assert "The row begins anew. This is about the fresh numbers; cm.ask(" in said
    assert "begins anew" not in answer("02.1", factor=1.5)  # once is enough
    assert "The first in a row." in answer("02.1")  # these numbers had not been right before
    assert line_of("02.1") == "open, two in a row"  # the longest stays


def test_the_same_numbers_count_once() -> None:
    cm.again("02.1")
    for _ in range(3):
        assert "The first in a row." in answer("02.1")
    answer("02.1", factor=2)
    assert "These numbers have counted before." in answer("02.1")
    cm.again("02.1")
    assert "The first in a row." in answer("02.1")


def test_who_goes_on_after_three_may() -> None:
    for _ in range(4):
        cm.again("01.1")
        said = answer("01.1")
    assert said.endswith("4 in a row: you can do this.")
    assert line_of("01.1") == "open, 4 in a row"


def test_only_that_exercise_asks_about_fresh_numbers_and_only_until_it_is_asked_again() -> None:
    cm.again("02.1")
    assert not cm.check("02.1", EXERCISES["02.1"].solution(machine_for())).is_right
    assert cm.check("02.4", EXERCISES["02.4"].solution(machine_for())).is_right
    cm.ask("02.4")
    assert "fresh numbers; cm.ask" in answer("02.1", factor=3)
    cm.ask("02.1")
    assert cm.check("02.1", EXERCISES["02.1"].solution(machine_for())).is_right
    for number in ("01.1", "02.1"):
        cm.again(number)
    anna = cm.variant("Anna")
    for number in ("01.1", "02.1"):
        assert cm.check(number, EXERCISES[number].solution(anna)).is_right


def test_fresh_numbers_leave_what_was_done_with_the_own_ones(work: Path) -> None:
    cm.check("01.1", 140)
    before = read_file(work)["exercises"]["01.1"]
    cm.again("01.1")
    answer("01.1")
    answer("01.1", factor=1.1)
    after = read_file(work)["exercises"]["01.1"]
    assert after.pop("again") == {"who": "", "round": 1, "row": 0, "longest": 1}
    assert after == before
    assert line_of("01.1") == "not yet, 1 try"


def test_it_is_offered_with_the_first_right_answer_only() -> None:
    assert "cm.again" not in cm.check("01.1", 140).text
    assert "cm.again" in cm.check("01.1", 70).text
    assert "cm.again" not in cm.check("01.1", 70).text
    assert "cm.again" not in cm.check("01.4", "b").text
    cm.variant("Anna")
    assert "cm.again" in cm.check("01.1", machine_for("Anna").die_angle_deg).text


def test_again_before_anything_was_asked_or_answered() -> None:
    cm.again("06.4")
    assert "The first in a row." in answer("06.4")


@pytest.mark.parametrize("number", ["99.9", "", None, 2.1, []])
def test_an_unknown_number_is_refused_with_the_known(number: Any) -> None:
    with pytest.raises(cm.InputError, match=r"^There is no exercise .*: use one of '01\.1'"):
        cm.again(number)


@pytest.mark.parametrize("exercise", CHOICES, ids=lambda exercise: exercise.number)
def test_a_choice_has_no_again(exercise: ChoiceExercise, work: Path) -> None:
    with pytest.raises(cm.InputError, match=r"is a choice, which has no numbers.*: use choose\("):
        cm.again(exercise.number)
    assert files_in(work) == []


def test_a_kernel_that_begins_anew_asks_about_the_own_numbers_and_keeps_the_row() -> None:
    cm.again("02.1")
    answer("02.1")
    asked = cm.again("02.1").text
    restart()
    assert cm.check("02.1", EXERCISES["02.1"].solution(machine_for())).is_right
    assert cm.again("02.1").text != asked  # the third round
    assert "Two in a row." in answer("02.1")


def test_another_learner_has_a_row_of_their_own() -> None:
    cm.variant("Anna")
    for _ in range(2):
        cm.again("02.1")
        answer("02.1")
    cm.variant("Bert")
    cm.again("02.1")
    assert "The first in a row." in answer("02.1")


def test_two_notebooks_of_one_learner_have_rounds_of_their_own() -> None:
    one, other = restart(), restart()
    asked = []
    for session._SESSION in (one, other):
        asked.append(cm.again("02.1").text)
    assert asked[0] != asked[1]
    said = []
    for session._SESSION in (one, other, one, other):
        said.append(answer("02.1"))
    assert ["first" in text for text in said] == [True, False, False, False]
    assert all("Two in a row." in text for text in said[1:])


@pytest.mark.parametrize("content", STRANGERS.values(), ids=STRANGERS)
def test_a_damaged_file_begins_the_row_anew_and_stops_nothing(work: Path, content: bytes) -> None:
    cm.again("02.1")
    answer("02.1")
    restart()
    (work / FILE).write_bytes(content)
    cm.again("02.1")
    said = answer("02.1")
    assert "The first in a row." in said
    assert "progress-unreadable-1.json" in cm.progress().note


@pytest.mark.parametrize(
    "odd", [None, 3, "x", [1], {"who": 3}, {"who": "", "round": -1, "row": "x", "longest": 1e99}]
)
def test_a_row_of_a_stranger_counts_as_far_as_it_makes_sense(work: Path, odd: object) -> None:
    (work / FILE).write_text(json.dumps({"exercises": {"02.1": {"again": odd}}}))
    assert line_of("02.1") == "open"
    cm.again("02.1")
    assert "The first in a row." in answer("02.1")
    assert row_of("02.1", work)["round"] == 1


def test_a_round_beyond_all_reason_takes_no_time(work: Path) -> None:
    kept = {"who": "", "round": 999_999, "row": 1}
    (work / FILE).write_text(json.dumps({"exercises": {"02.1": {"again": kept}}}))
    cm.again("02.1")
    assert "Two in a row." in answer("02.1")


def test_a_file_that_cannot_be_written_is_said_and_the_row_goes_on(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def refuse(*_: Any, **__: Any) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as full:
        full.setattr("json.dump", refuse)
        for _ in range(2):
            cm.again("02.1")
            said = answer("02.1")
    assert "Two in a row." in said
    assert "could not be written" in said
    cm.again("02.1")
    assert "Three in a row" in answer("02.1")
    restart()
    assert line_of("02.1") == "open, three in a row"


def test_while_it_is_graded_the_numbers_stay(work: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(GRADING, "1")
    assert cm.again("01.1").text == cm.ask("01.1").text
    assert cm.check("01.1", 70).is_right
    assert "cm.again" not in cm.check("01.1", 70).text
    with pytest.raises(AssertionError, match=r"^01\.1: .*both ways"):
        cm.check("01.1", 140)
    monkeypatch.delenv(GRADING)
    cm.again("01.1")
    monkeypatch.setenv(GRADING, "1")
    assert cm.check("01.1", 70).is_right
    assert files_in(work) == [FILE]


def test_the_class_page_tells_of_the_row(work: Path) -> None:
    cm.check("01.1", 70)
    for _ in range(3):
        cm.again("01.1")
        answer("01.1")
    page = write(read_class(work), date(2026, 1, 2))
    assert "✓ right<small>1 try, three in a row</small>" in page


def test_no_number_is_asked_for_that_a_wrong_way_leads_to() -> None:
    exercise = EXERCISES["01.1"]
    assert isinstance(exercise, NumberExercise)
    half = MillAndDie(mill_angle_deg=120, work_deg=120)  # 01.1: 60, as 360/6
    assert fresh_numbers.why_not(exercise, half) == ""
    nowhere = MillAndDie(mill_angle_deg=240, work_deg=120)
    assert "0 is not between 0 and 360 deg" in fresh_numbers.why_not(exercise, nowhere)
    doubled = MillAndDie(mill_angle_deg=100, work_deg=0)
    assert "a wrong way leads to 130" in fresh_numbers.why_not(exercise, doubled)


def test_no_number_is_asked_for_that_four_digits_do_not_tell_from_a_wrong_one() -> None:
    def beside(share: float) -> NumberExercise:
        return NumberExercise(
            number="00.0",
            question=lambda _: "How much?",
            right="It is.",
            hints=("Look.", "Think.", "Count."),
            unit="s",
            answer=lambda _: 3,
            slips=(Slip(lambda _: 3 * (1 + share), "Beside it."),),
        )

    assert "a wrong way leads to 3" in fresh_numbers.why_not(beside(0.0005), machine_for())
    assert fresh_numbers.why_not(beside(0.002), machine_for()) == ""


@pytest.mark.parametrize("ends", [(0, 70), (70, 100)])
def test_an_answer_at_the_end_of_its_range_is_not_asked_for(
    ends: tuple[float, float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(fresh_numbers._RANGES, "deg", ends)
    assert "70 is not between" in fresh_numbers.why_not(EXERCISES["01.1"], machine_for())


def test_the_widest_angle_is_sought_once_for_all_rates_and_masses(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Else each round takes longer than the last: thirty of them took 42 s in a new kernel."""
    sought = []

    def seek(*args: Any) -> Any:
        sought.append(args)
        return cm.widest_move(*args)

    monkeypatch.setattr(example, "widest_move", seek)
    own = replace(machine_for("Anna"), pocket_mm=33.25, rate_per_hour=1111)
    alike = [replace(own, who="Ben"), replace(own, rate_per_hour=2222), replace(own, die_mass_kg=1)]
    assert len({own.widest_deg, *(machine.widest_deg for machine in alike)}) == 1
    assert len(sought) == 1
    for name in example._GEOMETRY:
        other = replace(own, **{name: getattr(own, name) + 2})
        fresh = cm.widest_move(other.diagram, "die", other.rule).angle_deg
        assert other.widest_deg == pytest.approx(fresh, abs=1e-9)
    assert len(sought) == 1 + len(example._GEOMETRY)


def test_fresh_numbers_are_not_sought_for_ever(monkeypatch: pytest.MonkeyPatch) -> None:
    """An exercise of which one wrong way is always right let the kernel hang."""
    exercise = EXERCISES["12.1"]
    monkeypatch.setattr(fresh_numbers, "why_not", lambda *_: "a wrong way is right")
    with pytest.raises(cm.InputError, match=r"^There are no fresh numbers for exercise 12\.1"):
        next(fresh_numbers.fresh_machines(exercise, machine_for("Anna")))
