"""What is kept of an answer, and by which names."""

import ast
import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from desk import files_in, line_of, read_file, restart, sit_down
from judging import each_exercise

import cammotion as cm
from cammotion.machine.diagram import TimingDiagram
from cammotion.teaching.example import EXAMPLE
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.places import FILE
from cammotion.teaching.reasons import NO_ANSWER, short_name
from cammotion.teaching.variants import machine_for


@pytest.fixture(autouse=True)
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sit down in the folder of the copies of a workbook."""
    yield from sit_down(tmp_path, monkeypatch)


def test_each_reason_is_counted_by_its_short_name(work: Path) -> None:
    for answer in (140, 140, 120, "x", [1], 70, 140):
        cm.check("01.1", answer)
    record = read_file(work)["exercises"]["01.1"]
    assert record["tries"] == 7
    assert record["slips"] == {
        short_name(EXERCISES["01.1"].slips[0].reason): 3,  # type: ignore[attr-defined]
        short_name(EXERCISES["01.1"].slips[1].reason): 1,  # type: ignore[attr-defined]
        NO_ANSWER: 2,
    }
    assert set(record) == {"state", "tries", "who", "slips", "given", "right"}  # no text of ours
    assert record["given"] == 140  # the last number, for what goes on from it
    for _ in range(2):
        cm.check("01.4", "a")
    assert [*read_file(work)["exercises"]["01.4"]["slips"].values()] == [1]  # shown again


def test_the_name_is_kept_as_it_was_given(work: Path) -> None:
    cm.variant("")
    assert files_in(work) == []
    cm.variant(" Anna Groß ")
    cm.variant("")
    assert read_file(work) == {"learner": {"variant": {"name": "Anna Groß"}}}


def test_a_name_given_once_is_offered_in_the_next_notebook_and_not_used_in_silence(
    work: Path,
) -> None:
    assert "name before" not in str(cm.variant(""))
    cm.variant("Anna Groß")
    restart()
    me = cm.variant("")
    assert me == machine_for() != machine_for("Anna Groß")
    assert str(me).endswith(
        " You have given a name before: write cm.variant('Anna Groß') here for the numbers of that "
        "name."
    )
    assert "You have given a name before" in me._repr_markdown_()
    assert f"{machine_for().mill_angle_deg:g} degrees" in cm.ask("01.1").text
    assert "name before" not in str(cm.variant("Anna Groß"))
    cm.variant("Bert")
    assert "cm.variant('Bert') here" in str(cm.variant(""))
    assert read_file(work) == {"learner": {"variant": {"name": "Bert"}}}


@pytest.mark.parametrize("who", [17, "o'Neill", 'a "b"', "a\nb", "`<b>`", "\\", "王"])
def test_what_is_offered_can_be_pasted(who: str | int) -> None:
    machine = cm.variant(who)
    restart()
    offered = str(cm.variant("")).partition("write cm.variant(")[2].partition(") here")[0]
    assert machine_for(ast.literal_eval(offered)) == machine


@pytest.mark.parametrize("name", [None, 3, ["Anna"], {"a": 1}, "", "  ", "x" * 1000])
def test_a_name_that_makes_no_sense_is_not_offered(work: Path, name: Any) -> None:
    (work / FILE).write_text(json.dumps({"learner": {"variant": {"name": name}}}))
    restart()
    assert str(cm.variant("")) == str(machine_for())


def test_a_file_of_the_version_before_is_read_and_nothing_in_it_is_lost(work: Path) -> None:
    old = {
        "exercises": {"01.1": {"state": "wrong", "tries": 2, "hints": 1, "who": "anna"}},
        "predictions": {"01.half": {"text": "60"}},
    }
    (work / FILE).write_text(json.dumps(old))
    restart()
    assert line_of("01.1") == "not yet, 2 tries, 1 hint"
    cm.variant("Anna")
    cm.check("01.1", 1)
    new = read_file(work)
    assert new["predictions"] == old["predictions"]
    assert new["exercises"]["01.1"].items() >= {"tries": 3, "hints": 1, "who": "anna"}.items()


@each_exercise
def test_the_short_names_of_an_exercise_tell_its_reasons_apart(exercise: Exercise) -> None:
    faults = {*exercise.faults}
    assert len({short_name(fault) for fault in faults}) == len(faults) >= 2
    assert all(len(short_name(fault)) < 60 for fault in faults)


@each_exercise
def test_a_reason_that_is_given_is_among_those_that_are_told_beforehand(exercise: Exercise) -> None:
    names = {NO_ANSWER, *map(short_name, exercise.faults)}
    right = exercise.solution(EXAMPLE)
    factors = (0.985, 1.01, 3, 1 / 3, 7, -5, -1, 2, 1000, 0.001, 1 / 9.80665, 3600)
    by_factor = (
        [] if isinstance(right, str | TimingDiagram) else [factor * right for factor in factors]
    )
    for answer in (*by_factor, *"abcdef", 1, [1]):
        verdict = exercise.judge(answer, EXAMPLE)
        assert verdict.reason in names if verdict.state == "wrong" else not verdict.reason


def test_what_is_measured_is_no_part_of_a_name() -> None:
    for number, factors in {"01.1": (0.985, 1.01), "02.2": (3, 5.5)}.items():
        right = EXERCISES[number].solution(EXAMPLE)
        verdicts = [EXERCISES[number].judge(factor * right, EXAMPLE) for factor in factors]
        assert verdicts[0].text != verdicts[1].text
        assert verdicts[0].reason == verdicts[1].reason != NO_ANSWER


def test_a_count_of_a_million_is_none(work: Path) -> None:
    for tries, said in ((999_999, "not yet, 999999 tries"), (10**6, "open")):
        record = {"state": "wrong", "tries": tries, "who": ""}
        (work / FILE).write_text(json.dumps({"exercises": {"01.1": record}}))
        restart()
        assert line_of("01.1") == said
