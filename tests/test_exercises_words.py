"""Choices by their letters, the ladder of hints, and whether every sentence is one."""

import re

import pytest
from judging import MACHINES, each_choice, each_exercise, is_right, reasons_of, say

from cammotion.teaching.exercise import ChoiceExercise, Exercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
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


@each_exercise
def test_every_sentence_is_a_sentence(exercise: Exercise) -> None:
    for machine in MACHINES:
        assert exercise.question(machine)[-1] in "?.", exercise.question(machine)
        assert not re.search(r"\.\d{6}|e[-+]\d\d|None|nan", exercise.question(machine))
    for said in (exercise.right, *exercise.hints, *reasons_of(exercise)):
        assert re.match(r"[A-Z(]", said), said
        assert said[-1] in "?.", said
