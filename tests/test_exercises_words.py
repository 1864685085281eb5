"""Choices by their letters, the ladder of hints, and whether every sentence is one."""

import math
import re

import pytest
from judging import MACHINES, each_choice, each_exercise, is_right, reasons_of, say

import cammotion as cm
from cammotion.teaching.exercise import ChoiceExercise, Exercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.reasons import COMMON_RATIOS, UNIT_RATIOS
from cammotion.teaching.variants import machine_for


@each_choice
def test_a_choice_by_its_letter(exercise: ChoiceExercise) -> None:
    right = exercise.answer
    for spelling in ("{}", "{}.", "{})", "({})", " {} ", "( {} )", "{}:", "'{}'", "{}\n"):
        for letter in (right, right.upper(), chr(ord(right) + 0xFEE0)):  # the last is full-width
            assert is_right(exercise, spelling.format(letter)), spelling.format(letter)
    reasons = {say(exercise, letter) for letter in exercise.options if letter != right}
    assert reasons == {*exercise.reasons.values()}
    assert len(reasons) == len(exercise.options) - 1
    assert {*exercise.reasons} == exercise.options.keys() - {right}


@pytest.mark.parametrize("nonsense", ["z", "aa", "?", "all of them", 1, 2.5, ["a"], {"a"}, b"a"])
@each_choice
def test_a_choice_that_is_none_is_told_the_letters(
    exercise: ChoiceExercise, nonsense: object
) -> None:
    assert f"one of the letters {', '.join(exercise.options)}" in say(exercise, nonsense)


@each_exercise
def test_there_are_three_hints_and_none_holds_the_answer(exercise: Exercise) -> None:
    assert len({*exercise.hints}) == 3
    if isinstance(exercise, NumberExercise):
        said = [*exercise.hints, *(slip.reason for slip in exercise.slips)]
        held = {*re.findall(r"\d+(?:\.\d+)?", " ".join(said))}
        for machine in (machine_for(f"hints {n}") for n in range(10)):
            right = exercise.solution(machine)
            usual = {f"{right:.{digits}g}" for digits in range(2, 9)}
            usual |= {f"{right:.{digits}f}" for digits in range(2, 7)}
            usual -= {*"0123456789"}  # a lone digit says nothing: it is in too many sentences
            assert not held & usual, machine.who
    if isinstance(exercise, ChoiceExercise):
        assert not any(exercise.options[exercise.answer] in hint for hint in exercise.hints)
        assert not any(f"({exercise.answer})" in hint for hint in exercise.hints)


SAID = {
    "a tenth of what": 1 / 10,
    "a quarter of what": 1 / 4,
    "half of what": 1 / 2,
    "twice as much": 2.0,
    "four times as much": 4.0,
    "60 times": 60.0,
    "a hundred times": 100.0,
    "a thousand times": 1e3,
    "3600 times": 3600.0,
    "ten thousand times": 1e4,
    "a million times": 1e6,
    "3600 squared times": 3600.0**2,
    "pi times": math.pi,
    "2 pi times": 2 * math.pi,
    "180/pi times": 180 / math.pi,
    "not the sign": -1.0,
    "share": 1 / 100,
    "part of a turn": 1 / 360,
    "in mm": 1 / 1000,
    "in seconds": 1 / 1000,
    "in milliseconds": 1000.0,
    "in N/m": 1000.0,
    "swings a minute": 60.0,
    "pieces a minute": 1 / 60,
    "pieces a second": 1 / 3600,
}
"""Ratios of an answer to the right one, as they are put in words."""


def ratio_in(reason: str) -> float:
    """Return the ratio that a reason begins with, in words."""
    first = re.split(r"[.:]", reason)[0]
    said = max((words for words in SAID if f" {words}" in first), key=len)
    return 1 / SAID[said] if "too small" in first else SAID[said]


@pytest.mark.parametrize("unit", ["common", *UNIT_RATIOS])
def test_the_ratio_is_the_one_that_the_reason_says(unit: str) -> None:
    reasons = UNIT_RATIOS.get(unit, COMMON_RATIOS)
    assert {ratio: ratio_in(reason) for ratio, reason in reasons.items()} == {
        ratio: pytest.approx(ratio) for ratio in reasons
    }


CONDITIONS = [
    ("05.6", "tell that it is the law"),
    ("08.3", "in the same index time"),
    ("10.2", "At a given number of swings, undamped,"),
    ("11.4", "that may turn less than this"),
]


@pytest.mark.parametrize(("number", "condition"), CONDITIONS)
def test_what_is_said_of_a_right_answer_keeps_its_condition(number: str, condition: str) -> None:
    """At the same speed of the camshaft a longer angle gives the index more time, for example."""
    assert condition in EXERCISES[number].right


def test_what_the_last_hint_of_12_1_names_is_the_answer() -> None:
    """It is neither what the function returns nor its first entry."""
    wider = cm.with_angle(cm.EXAMPLE.die, cm.EXAMPLE.widest_deg)
    before = cm.EXAMPLE.diagram.peak_acceleration("die")
    found = cm.rate_limits(cm.EXAMPLE.diagram.with_motion(wider), acceleration_m_per_s2=before)
    named = re.findall(r"\.(\w+_\w+)\.$", EXERCISES["12.1"].hints[-1])
    assert [is_right(EXERCISES["12.1"], getattr(found[0], name)) for name in named] == [True]


@each_exercise
def test_every_sentence_is_a_sentence(exercise: Exercise) -> None:
    for machine in MACHINES:
        assert exercise.question(machine)[-1] in "?.", exercise.question(machine)
        assert not re.search(r"\.\d{6}|e[-+]\d\d|None|nan", exercise.question(machine))
    for said in (exercise.right, *exercise.hints, *reasons_of(exercise)):
        assert re.match(r"[A-Z(]", said), said
        assert said[-1] in "?.", said
