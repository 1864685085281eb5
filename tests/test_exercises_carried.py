"""An error is carried forward: what is right for a wrong earlier answer is told so."""

import math

import pytest
from judging import MACHINES, NUMBERS, is_right, number_id, say

from cammotion.teaching.carried import link
from cammotion.teaching.example import EXAMPLE
from cammotion.teaching.exercise import NumberExercise, Slip
from cammotion.teaching.lessons import EXERCISES

GOING_ON = [exercise for exercise in NUMBERS if exercise.goes_on_from]
RIGHT_HERE = "What you did here is right, but with a wrong answer to "


def place(share: float) -> float:
    """Return x at which the cycloid has made a share of its way, by halving."""
    low, high = 0.0, 1.0
    for _ in range(60):
        x = (low + high) / 2
        low, high = (x, high) if x - math.sin(2 * math.pi * x) / math.tau < share else (low, x)
    return low


TOUCHING = 70 / (1 - place(20 / 50))  # the widest angle of the source without a margin
NO_SQUARE = 0.031 / (70 * 1.8 / 360)  # m/s; a velocity for the least acceleration


@pytest.mark.parametrize(
    ("number", "answer", "earlier", "said"),
    [
        ("03.4", 70 / (1 - (0.38 - math.sin(0.76 * math.pi) / math.tau)), "03.3", "way round"),
        ("03.4", 85 / (1 - place(19 / 50)), "03.2", "Both quiet ends"),
        ("03.5", (TOUCHING / 55) ** 2, "03.4", "margin was forgotten"),
        ("03.5", (85 / (1 - place(19 / 50)) / 55) ** 2, "03.2", "Both quiet ends"),
        ("06.4", 0.80636 / NO_SQUARE, "06.3", "mean velocity"),
    ],
)
def test_an_answer_that_is_right_for_a_wrong_earlier_one(
    number: str, answer: float, earlier: str, said: str
) -> None:
    text = say(EXERCISES[number], answer)
    assert text.startswith(RIGHT_HERE + earlier)
    assert said in text


def test_the_exercises_that_go_on() -> None:
    found = {exercise.number: [*exercise.goes_on_from] for exercise in GOING_ON}
    assert found == {"03.4": ["03.2", "03.3"], "03.5": ["03.4"], "05.3": ["05.2"], "06.4": ["06.3"]}


@pytest.mark.parametrize("exercise", GOING_ON, ids=number_id)
def test_with_the_right_earlier_answers_it_is_right(exercise: NumberExercise) -> None:
    for machine in MACHINES:
        for number, going_on in exercise.goes_on_from.items():
            earlier = EXERCISES[number].solution(machine)
            assert going_on(machine, earlier) == pytest.approx(exercise.solution(machine))


@pytest.mark.parametrize("exercise", GOING_ON, ids=number_id)
def test_every_carried_error_is_told_or_has_a_reason_of_its_own(exercise: NumberExercise) -> None:
    unknown = ("This is too", "Close, but", "The sign is wrong")
    told = set()
    for machine in MACHINES[:7]:
        for slip in exercise.carried:
            value = slip.answer(machine)
            if math.isfinite(value) and not is_right(exercise, value, machine):
                reason = say(exercise, value, machine)
                assert not reason.startswith(unknown)
                told.add(reason)
    assert sum(reason.startswith(RIGHT_HERE) for reason in told) >= 3


def test_what_nobody_would_go_on_with_is_nothing() -> None:
    first = NumberExercise(
        number="00.1",
        question=lambda _: "How much?",
        right="It is.",
        hints=("Look.", "Think.", "Count."),
        unit="rpm",
        answer=lambda _: 0.5,
        slips=(Slip(lambda _: 1, "One."), Slip(lambda _: 2, "Two.")),
    )
    second = NumberExercise(
        number="00.2",
        question=lambda _: "And then?",
        right="It is.",
        hints=("Look.", "Think.", "Count."),
        unit="rpm",
        answer=lambda _: 1 / math.sqrt(0.5),
        goes_on_from={"00.1": lambda _, x: 1 / math.sqrt(1 - x)},
    )
    linked = link([first, second])["00.2"]
    assert isinstance(linked, NumberExercise)
    assert all(math.isnan(slip.answer(EXAMPLE)) for slip in linked.carried)
    assert linked.judge(3, EXAMPLE).text.startswith("This is too large")
