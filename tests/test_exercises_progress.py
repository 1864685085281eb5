"""The learner's desk: what is done is kept over restarts, whatever becomes of the file."""

import errno
import json
import os
import shutil
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NoReturn

import pytest
from desk import STRANGERS, files_in, line_of, read_file, restart, sit_down

import cammotion as cm
from cammotion.teaching import session, store
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.places import FILE, GRADING


@pytest.fixture(autouse=True)
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sit down in the folder of the copies of a workbook."""
    yield from sit_down(tmp_path, monkeypatch)


def refuse(error: BaseException) -> Any:
    """Return a function that raises, in the place of one that writes."""

    def refusing(*_: Any, **__: Any) -> NoReturn:
        raise error

    return refusing


DISK_FULL = OSError(errno.ENOSPC, "No space left on device")


def test_at_first_all_is_open_and_no_file_is_there(work: Path) -> None:
    assert cm.progress().text.startswith(f"0 of {len(EXERCISES)} exercises are right.\n01.1  open")
    assert all(line.said == "open" for line in cm.progress().lines)
    cm.check("01.1", None)
    cm.ask("01.1")
    assert files_in(work) == []


def test_progress_is_kept_over_restarts(work: Path) -> None:
    cm.check("01.1", 140)
    assert line_of("01.1") == "not yet, 1 try"
    cm.check("01.1", 70)
    cm.hint("01.2")
    cm.check("01.2", 3)
    restart()
    assert line_of("01.1") == "right, 2 tries"
    assert line_of("01.2") == "not yet, 1 try, 1 hint"
    assert cm.progress().right == 1
    assert files_in(work) == [FILE]


def test_right_stays_right_for_the_same_numbers_only() -> None:
    cm.check("01.1", 70)
    cm.check("01.1", 140)
    assert line_of("01.1") == "right, 2 tries"
    anna = cm.variant("Anna")
    assert cm.check("01.1", anna.die_angle_deg).is_right
    cm.variant("  ANNA ")
    cm.check("01.1", 1)
    assert line_of("01.1") == "right, 4 tries"
    cm.variant("Bert")
    cm.check("01.1", 1)
    assert line_of("01.1") == "not yet, 5 tries"


def test_all_exercises_ask_about_the_variant() -> None:
    machine = cm.variant("Anna")
    assert f"{machine.mill_angle_deg:g} degrees of each turn" in cm.ask("01.1").text
    for number, exercise in EXERCISES.items():
        assert cm.check(number, exercise.solution(machine)).is_right
    assert cm.progress().right == len(EXERCISES)
    assert cm.variant().rate_per_hour == 2600
    assert cm.check("01.1", 70).is_right


def test_the_hints_stay_at_the_third_and_begin_anew_in_each_kernel(work: Path) -> None:
    hints = EXERCISES["02.1"].hints
    for step in (1, 2, 3, 3, 3):
        assert cm.hint("02.1").text == f"Hint {step} of 3 for 02.1: {hints[step - 1]}"
    restart()
    assert cm.hint("02.1").step == 1
    assert read_file(work)["exercises"]["02.1"]["hints"] == 3  # the furthest


def test_a_choice_is_kept_and_no_new_try_when_it_is_shown_again() -> None:
    control = cm.choose("01.4")
    control.buttons.value = "a"
    assert line_of("01.4") == "not yet, 1 try"
    control.buttons.value = "b"
    assert line_of("01.4") == "right, 2 tries"
    for _ in range(3):
        restart()
        assert cm.choose("01.4").answer == "b"
        assert cm.check("01.4", None).is_right
    assert line_of("01.4") == "right, 2 tries"


ODD_CHOICES: list[Any] = ["z", 1, [1], {"b"}, object(), 2j, "\ud800", b"b", float("nan")]


@pytest.mark.parametrize("answer", ODD_CHOICES, ids=lambda answer: type(answer).__name__)
def test_what_is_no_choice_is_not_kept_as_one(work: Path, answer: object) -> None:
    cm.check("01.4", "a")
    assert not cm.check("01.4", answer).is_right
    assert read_file(work)["exercises"]["01.4"]["choice"] == "a"
    assert cm.choose("01.4").answer == "a"
    assert files_in(work) == [FILE]


def test_predictions_are_kept_and_shown_again(work: Path) -> None:
    control = cm.predict("01.half", "degrees for each way")
    assert control.said == "You made no prediction."
    control.field.value = "  about 60 "
    assert control.said == "You predicted about 60."
    restart()
    assert cm.predict("01.half", "degrees for each way").said == "You predicted about 60."
    assert cm.predict("01.other", "mm").prediction == ""
    assert read_file(work)["predictions"]["01.half"] == {"text": "about 60"}


@pytest.mark.parametrize("key", ["", " ", None, 3, ["a"]])
def test_a_prediction_needs_a_key(key: Any) -> None:
    with pytest.raises(cm.InputError, match=r"^The key of a prediction is .*: give one like"):
        cm.predict(key, "mm")


@pytest.mark.parametrize("who", ["Jörg", "王", "\ud800", "a\nb", '"'], ids=ascii)
def test_any_name_and_any_prediction_can_be_written(work: Path, who: str) -> None:
    cm.variant(who)
    cm.check("01.1", 1)
    cm.predict(who, "mm").field.value = who
    restart()
    assert cm.progress().note == ""
    assert cm.predict(who, "mm").field.value == who
    assert files_in(work) == [FILE]


@pytest.mark.parametrize("content", STRANGERS.values(), ids=STRANGERS)
def test_a_file_that_cannot_be_read_is_kept_aside(work: Path, content: bytes) -> None:
    (work / FILE).write_bytes(content)
    said = cm.check("01.1", 70)
    assert said.is_right
    assert "progress.json could not be read. It was kept as progress-unreadable-1.json" in said.text
    assert (work / "progress-unreadable-1.json").read_bytes() == content
    assert line_of("01.1") == "right, 1 try"
    (work / FILE).write_bytes(content)
    assert "progress-unreadable-2.json" in cm.progress().note
    cm.check("01.2", 0.3846)
    restart()
    assert cm.progress().right == 2
    assert cm.progress().note == ""


@pytest.mark.parametrize("place", ["pathlib.Path.read_bytes", "pathlib.Path.exists"])
def test_what_cannot_be_read_for_now_is_left_and_tried_again(
    work: Path, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    cm.check("01.1", 70)
    kept = (work / FILE).read_bytes()
    restart()
    with monkeypatch.context() as broken:
        broken.setattr(place, refuse(OSError(errno.ESTALE, "Stale file handle")))
        assert "could not be read (Stale file handle)" in cm.progress().note
        assert "could not be written (Stale" in cm.check("01.2", 0.3846).text
    assert (work / FILE).read_bytes() == kept
    assert cm.progress().right == 2
    assert "could not be read" not in cm.progress().note
    assert cm.check("02.4", 1.331).note == ""
    restart()
    assert cm.progress().right == 3
    assert files_in(work) == [FILE]


def test_a_folder_in_the_place_of_the_file(work: Path) -> None:
    (work / FILE).mkdir()
    assert "was kept as" in cm.check("01.1", 70).text
    assert line_of("01.1") == "right, 1 try"


def test_a_thousandth_unreadable_file_raises_nothing(work: Path) -> None:
    for number in range(1, 1000):
        (work / f"progress-unreadable-{number}.json").touch()
    (work / FILE).write_bytes(b"[]")
    assert cm.check("01.1", 70).is_right
    assert cm.progress().right == 1


def test_records_of_a_stranger_are_read_as_far_as_they_make_sense(work: Path) -> None:
    odd: list[Any] = [None, "x", [1], {"a": 1}, True, -3, 2.5, 10**30]
    for value in odd:
        names = ("state", "tries", "hints", "who", "choice", "text", "slips", "name")
        record = dict.fromkeys(names, value)
        content = {"exercises": dict.fromkeys((*EXERCISES, "99.9"), record), "else": {"x": {}}}
        content["predictions"] = {"k": record}
        content["learner"] = {"variant": record}
        (work / FILE).write_text(json.dumps(content))
        restart()
        assert cm.progress().right == 0
        assert cm.choose("01.4").answer is None
        assert cm.check("01.4", None).text == "01.4 is not answered yet."
        said = "You predicted x." if value == "x" else "You made no prediction."
        assert cm.predict("k", "mm").said == said
        assert cm.check("01.1", 70).is_right
        assert read_file(work)["else"] == {"x": {}}  # what is not ours is left
        assert cm.hint("01.1").step == 1
        assert cm.progress().note == ""


@pytest.mark.parametrize(
    "place", ["json.dump", "pathlib.Path.replace", "os.fsync", f"{store.__name__}.only_one"]
)
def test_what_cannot_be_written_is_kept_in_memory_and_said(
    work: Path, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    cm.check("01.1", 70)
    with monkeypatch.context() as broken:
        broken.setattr(place, refuse(DISK_FULL))
        said = cm.check("01.2", 0.3846)
        assert said.is_right
        assert "could not be written (No space left on device); it is kept until" in said.text
        assert said.text.endswith(" closed: make room on the disk.")
        cm.check("02.4", 1.331)
        assert cm.progress().right == 3
        assert "could not be written" in cm.progress().note
        assert "is kept in" not in repr(cm.progress())
        assert cm.hint("02.1").step == 1
        assert [*read_file(work)["exercises"]] == ["01.1"]
        assert files_in(work) == [FILE]
    assert cm.check("03.2", 82).note == ""
    restart()
    assert cm.progress().right == 4


def test_a_folder_that_is_gone(work: Path) -> None:
    cm.check("01.1", 70)
    shutil.rmtree(work)
    said = cm.check("01.2", 0.3846)
    assert said.is_right
    assert cm.progress().right >= 1


@pytest.mark.parametrize("place", ["json.dump", "pathlib.Path.replace"])
def test_a_kernel_that_is_killed_while_it_writes(
    work: Path, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    cm.check("01.1", 70)
    whole = (work / FILE).read_bytes()
    with monkeypatch.context() as broken:
        broken.setattr(place, refuse(KeyboardInterrupt()))
        for _ in range(3):
            with pytest.raises(KeyboardInterrupt):
                cm.check("01.2", 0.3846)
    assert (work / FILE).read_bytes() == whole
    assert files_in(work) == [FILE]


def test_what_a_killed_kernel_left_behind_is_removed(work: Path) -> None:
    old, young = work / f".{FILE}.old", work / f".{FILE}.young"
    for part in (old, young):
        part.write_text("{")
    long_ago = time.time() - 3600
    os.utime(old, (long_ago, long_ago))
    cm.check("01.1", 70)
    assert files_in(work) == [young.name, FILE]  # the young one may be of another kernel


def test_two_kernels_do_not_lose_each_others_records() -> None:
    one, other = restart(), restart()
    for number, exercise in EXERCISES.items():
        session._SESSION = one if session._SESSION is other else other
        cm.check(number, exercise.solution(session._SESSION.machine))
        cm.predict(number, "mm").field.value = number
    for session._SESSION in (one, other, restart()):
        assert cm.progress().right == len(EXERCISES)
        assert all(cm.predict(number, "mm").prediction == number for number in EXERCISES)


def test_two_kernels_when_the_disk_was_full_for_one(monkeypatch: pytest.MonkeyPatch) -> None:
    one, other = restart(), restart()
    session._SESSION = one
    with monkeypatch.context() as broken:
        broken.setattr("json.dump", refuse(DISK_FULL))
        cm.check("01.1", 70)
    session._SESSION = other
    cm.check("01.2", 0.3846)
    session._SESSION = one
    assert cm.progress().right == 2
    cm.check("02.4", 1.331)
    restart()
    assert cm.progress().right == 3


@pytest.mark.parametrize("place", ["work/deeper", "work-anna", "work2/solutions"])
def test_every_folder_of_copies_has_its_own(
    work: Path, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    folder = work.parent / place
    folder.mkdir(parents=True)
    monkeypatch.chdir(folder)
    restart()
    cm.check("01.1", 70)
    assert (work.parent / Path(place).parts[0] / FILE).is_file()


def test_while_nbgrader_grades_an_answer_that_is_not_right_raises(
    work: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cm.check("01.4", "b")
    cm.check("01.1", 140)
    kept = (work / FILE).read_bytes()
    monkeypatch.setenv(GRADING, "1")
    restart()
    assert cm.check("01.1", 70).is_right
    assert cm.check("01.4", "(B)").is_right
    for number, answer, said in [
        ("01.1", 140, "both ways"),
        ("01.1", None, "not answered yet"),
        ("01.4", None, "not answered yet"),  # the kept choice does not count
        ("01.4", "a", "says when, not where"),
        ("02.2", "t", "without quotes"),
    ]:
        with pytest.raises(AssertionError, match=rf"^{number}: .*{said}"):
            cm.check(number, answer)
    assert cm.choose("01.4").answer is None
    assert cm.progress().right == 0
    cm.hint("01.1")
    cm.predict("k", "mm").field.value = "3"
    assert (work / FILE).read_bytes() == kept
    assert files_in(work) == [FILE]


@pytest.mark.parametrize("number", ["99.9", "", None, 1.1, [], "01.1 "])
@pytest.mark.parametrize("call", [cm.ask, cm.hint, cm.choose, lambda n: cm.check(n, 1)])
def test_an_unknown_exercise_is_refused_with_the_known_ones(call: Any, number: Any) -> None:
    known = "did you mean" if number == "01.1 " else "use one of"
    with pytest.raises(cm.InputError, match=rf"^There is no exercise .*: {known} '01\.1'"):
        call(number)


def test_an_exercise_without_options_is_no_choice() -> None:
    with pytest.raises(cm.InputError, match=r"has no options to choose from: use ask\('01\.1'\)"):
        cm.choose("01.1")


def test_what_was_right_for_a_name_is_right_when_the_name_comes_back(work: Path) -> None:
    def right(who: str) -> None:
        machine = cm.variant(who)
        cm.check("01.1", EXERCISES["01.1"].solution(machine))

    right("Anna")
    cm.variant("Ben")
    cm.check("01.1", 1)
    assert line_of("01.1").startswith("not yet")
    cm.variant("anna ")
    assert line_of("01.1").startswith("right")
    cm.check("01.1", 1)  # what was right once stays right
    assert line_of("01.1").startswith("right")
    right("Ben")
    restart()
    assert all(line_of("01.1").startswith("right") for who in ("Anna", "Ben") if cm.variant(who))
    assert read_file(work)["exercises"]["01.1"]["right"] == ["anna", "ben"]


def test_so_it_is_where_an_earlier_version_kept_only_whose_answer_was_the_last(work: Path) -> None:
    old = {"01.1": {"state": "right", "tries": 1, "who": "anna"}}
    (work / FILE).write_text(json.dumps({"exercises": old}))
    restart()
    cm.variant("Ben")
    cm.check("01.1", 1)
    assert line_of("01.1").startswith("not yet")
    cm.variant("Anna")
    assert line_of("01.1").startswith("right")


@pytest.mark.parametrize("tries", [None, "three", -1])
def test_what_is_right_is_no_open_exercise_where_its_tries_cannot_be_read(
    tries: object, work: Path
) -> None:
    record = {"state": "right", "tries": tries}
    (work / FILE).write_text(json.dumps({"exercises": {"01.1": record}}))
    restart()
    assert cm.progress().right == 1
    assert line_of("01.1") == "right"
    assert line_of("01.2") == "open"


def test_what_another_version_has_written_beside_it_stays(work: Path) -> None:
    others = {"version": 3, "notes": ["a"], "later": {"01.1": None}}
    cm.check("01.1", 70)
    (work / FILE).write_text(json.dumps(read_file(work) | others), "utf-8")
    restart()
    cm.check("01.2", 7)
    assert line_of("01.1").startswith("right")
    assert read_file(work).items() >= others.items()
    assert files_in(work) == [FILE]
