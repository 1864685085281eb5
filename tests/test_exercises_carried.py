"""An error is carried forward: what is right for a wrong earlier answer is told so."""

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from desk import restart, sit_down
from judging import MACHINES, NUMBERS, is_right, number_id, say

import cammotion as cm
from cammotion.teaching.carried import after, link
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import Slip
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import YOURS, NumberExercise
from cammotion.teaching.places import FILE
from cammotion.teaching.reasons import short_name
from cammotion.teaching.variants import machine_for

GOING_ON = [exercise for exercise in NUMBERS if exercise.goes_on_from]
WITH_WRONG = "With a wrong answer to "


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
    assert WITH_WRONG + earlier in text
    assert said in text


def test_the_exercises_that_go_on() -> None:
    found = {exercise.number: [*exercise.goes_on_from] for exercise in GOING_ON}
    assert found == {
        "01.3": ["01.1"],
        "02.3": ["02.1"],
        "03.2": ["01.1"],
        "03.4": ["03.2", "03.3"],
        "03.5": ["03.4"],
        "05.3": ["05.2"],
        "06.4": ["06.3"],
        "08.2": ["08.1"],
        "08.3": ["08.1"],
    }


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
            value = slip.leads_to(machine)
            if math.isfinite(value) and not is_right(exercise, value, machine):
                reason = say(exercise, value, machine)
                assert not reason.startswith(unknown)
                told.add(reason)
    # The slips of 02.1 are known to 02.3 too, as its own: what is not carried is told better.
    assert sum(reason.startswith(WITH_WRONG) for reason in told) >= (exercise.number != "02.3")


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
    lessons, *slips = linked.carried
    assert lessons.leads_to(EXAMPLE) == second.solution(EXAMPLE)
    assert all(math.isnan(slip.leads_to(EXAMPLE)) for slip in slips)
    assert linked.judge(3, EXAMPLE).text.startswith("This is too large")


@pytest.fixture
def work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """Sit down in the folder of the copies of a workbook."""
    yield from sit_down(tmp_path, monkeypatch)


def unknown_answer(later: NumberExercise, earlier: str, machine: MillAndDie) -> tuple[float, float]:
    """Return a wrong earlier answer and what it leads to, which has no reason of its own."""
    right = float(EXERCISES[earlier].solution(machine))
    for factor in (1.17, 1.07, 0.93, 1.13, 0.87, 2.2, 0.3):
        answer = later.goes_on_from[earlier](machine, factor * right)
        if later.judge(answer, machine).text.startswith(("This is too", "Close, but", "Not far")):
            return factor * right, answer
    raise AssertionError("Each of them has a reason of its own.")


LINKS = [(one.number, number) for one in GOING_ON for number in one.goes_on_from]


@pytest.mark.usefixtures("work")
@pytest.mark.parametrize("who", ["", "Anna", "Bert"])
@pytest.mark.parametrize(("later", "earlier"), LINKS)
def test_any_wrong_number_is_carried_on(later: str, earlier: str, who: str) -> None:
    machine, exercise = cm.variant(who), EXERCISES[later]
    assert isinstance(exercise, NumberExercise)
    given, answer = unknown_answer(exercise, earlier, machine)
    assert "but with your" not in cm.check(later, answer).text
    cm.check(earlier, given)
    restart()
    cm.variant(who)
    said = cm.check(later, answer).text
    expected = f"but with your {given:.5g} from {earlier}, which was not right yet."
    assert said.startswith(f"{later}: Not yet. What you did here is right, {expected}")
    assert "but with your" not in cm.check(later, 1.06 * answer).text


@pytest.mark.usefixtures("work")
def test_the_number_of_the_message_is_the_one_that_was_typed_last() -> None:
    machine = cm.variant("Anna")
    cm.check("02.1", 1000)
    cm.check("02.1", 9)
    cm.check("02.1", "a text")  # no number takes its place
    assert "with your 9 from 02.1" in cm.check("02.3", machine.die_mass_kg * 9).text
    in_mm = cm.check("02.3", machine.die_mass_kg * 9000).text
    assert "with your 9 from 02.1, which was not right yet. Besides, a length is in mm" in in_mm
    assert "What you did here is right" not in in_mm
    assert "with your" not in cm.check("02.3", machine.die_mass_kg * 1000).text


@pytest.mark.usefixtures("work")
def test_what_carries_nothing() -> None:
    """A right answer, one for other numbers, one for fresh numbers, and what a slip explains."""
    machine, mass = cm.variant("Anna"), cm.variant("Anna").die_mass_kg
    cm.check("02.1", 9)
    cm.variant("Bert")
    cm.check("02.3", 1)
    assert "with your" not in cm.check("02.3", cm.variant("Bert").die_mass_kg * 9).text
    cm.variant("Anna")
    cm.again("02.3")
    assert "with your" not in cm.check("02.3", mass * 9).text
    cm.ask("02.3")
    assert "with your 9" in cm.check("02.3", mass * 9).text
    cm.again("02.1")
    cm.check("02.1", 7)  # of other numbers: the own answer stays
    assert "with your 9" in cm.check("02.3", mass * 9).text
    cm.ask("02.1")
    velocity = EXERCISES["02.1"].slips[4].answer(machine)  # type: ignore[attr-defined]
    cm.check("02.1", velocity)
    said = cm.check("02.3", mass * velocity).text
    assert f"{WITH_WRONG}02.1 this would be right. This is the peak velocity" in said
    assert "More than one way" not in said  # that the acceleration is not is the same
    cm.check("02.1", EXERCISES["02.1"].solution(machine))
    assert "with your" not in cm.check("02.3", mass * 9).text


@pytest.mark.usefixtures("work")
def test_nothing_is_carried_from_one_learner_to_the_next_who_types_a_text() -> None:
    cm.variant("Anna")
    cm.check("02.1", 9)
    mass = cm.variant("Bert").die_mass_kg
    cm.check("02.1", "9")
    assert "with your" not in cm.check("02.3", mass * 9).text


@pytest.mark.usefixtures("work")
def test_a_right_answer_that_was_rounded_is_not_called_wrong() -> None:
    for who in range(40):
        machine = cm.variant(who)
        given = float(f"{EXERCISES['02.1'].solution(machine):.2g}")
        later = cm.check("02.3", machine.die_mass_kg * given * 1.0001)
        if cm.check("02.1", given).is_right and not later.is_right:
            assert cm.check("02.3", machine.die_mass_kg * given * 1.0001).text == later.text
            return
    raise AssertionError("Nobody has such numbers.")


@pytest.mark.usefixtures("work")
def test_without_an_earlier_answer_a_ratio_is_told_first() -> None:
    machine = cm.variant("")
    twice = 2 * EXERCISES["03.4"].solution(machine)
    assert "twice as much" in cm.check("03.4", twice).text
    cm.check("03.2", 2 * EXERCISES["03.2"].solution(machine))
    said = cm.check("03.4", twice).text
    assert "With a wrong answer to 03.2 this would be right. These are both ways" in said


def slip_of_03_3(words: str, machine: MillAndDie) -> tuple[Slip, float, float]:
    """Return a slip of 03.3, what it leads to, and what that leads to in 03.4."""
    earlier, later = EXERCISES["03.3"], EXERCISES["03.4"]
    assert isinstance(earlier, NumberExercise)
    assert isinstance(later, NumberExercise)
    slip = next(slip for slip in earlier.slips if words in slip.reason)
    given = slip.leads_to(machine)
    return slip, given, later.goes_on_from["03.3"](machine, given)


@pytest.mark.usefixtures("work")
def test_a_known_slip_of_the_earlier_answer_says_more_than_its_number() -> None:
    slip, given, answer = slip_of_03_3("way round", cm.variant(""))
    cm.check("03.3", given)
    said = cm.check("03.4", answer).text
    assert slip.reason in said
    assert "With a wrong answer to 03.3" in said


@pytest.mark.usefixtures("work")
def test_a_slip_of_an_earlier_exercise_is_told_before_it_was_made_and_after() -> None:
    slip, given, answer = slip_of_03_3("sine counts in degrees", cm.variant("Chloe"))
    assert slip.reason in cm.check("03.4", answer).text
    cm.check("03.3", given)
    said = cm.check("03.4", answer).text
    assert said.startswith(f"03.4: Not yet. {WITH_WRONG}03.3")
    assert slip.reason in said
    assert "More than one way" not in said


@pytest.mark.usefixtures("work")
def test_a_wrong_answer_that_was_given_is_told_beside_a_slip_with_the_same_number() -> None:
    """Who answers 120 to 01.1 comes to 0.392 in 01.3, near the ratio of the strokes alone."""
    cm.variant("")
    assert "ratio of the strokes alone" in cm.check("01.3", 0.392).text
    cm.check("01.1", 120)
    said = cm.check("01.3", 0.392).text
    assert said.startswith("01.3: Not yet. More than one way leads to this number. ")
    assert f"{WITH_WRONG}01.1 this would be right. While the die is down" in said
    assert "ratio of the strokes alone" in said


@pytest.mark.usefixtures("work")
def test_no_wrong_answer_is_claimed_where_the_right_one_was_given() -> None:
    """A number that nobody carried may be what an earlier slip would lead to."""
    machine = cm.variant("Anna")
    earlier, later = EXERCISES["03.2"], EXERCISES["03.5"]
    assert isinstance(earlier, NumberExercise)
    assert isinstance(later, NumberExercise)
    both_ends = earlier.slips[1].leads_to(machine)
    angle = EXERCISES["03.4"].goes_on_from["03.2"](machine, both_ends)  # type: ignore[attr-defined]
    answer = later.goes_on_from["03.4"](machine, angle)
    for number in ("03.2", "03.4"):
        assert "With a wrong answer to 03.2" in cm.check("03.5", answer).text
        cm.check(number, EXERCISES[number].solution(machine))
        assert "With a wrong answer to" not in cm.check("03.5", answer).text
        cm.check(number, 7)


@pytest.mark.usefixtures("work")
@pytest.mark.parametrize("number", [1e308, -1e308, 1, 1.0000001, 0, -3, 100, 150])
@pytest.mark.parametrize("later", ["03.4", "03.5", "05.3", "06.4"])
def test_a_number_that_nobody_can_go_on_with_stops_nothing(later: str, number: float) -> None:
    exercise = EXERCISES[later]
    assert isinstance(exercise, NumberExercise)
    for earlier in exercise.goes_on_from:
        cm.check(earlier, number)
    for answer in (number, math.inf, 3):
        assert not cm.check(later, answer).is_right


@pytest.mark.parametrize("odd", [None, True, "9", [9], {"x": 9}, 10**400, math.nan])
def test_a_number_of_a_stranger_carries_nothing(work: Path, odd: Any) -> None:
    record = {"given": odd, "who": "", "tries": 1, "state": "wrong"}
    (work / FILE).write_text(json.dumps({"exercises": {"02.1": record}}))
    assert "with your" not in cm.check("02.3", 9 * machine_for().die_mass_kg).text


@pytest.mark.parametrize("exercise", GOING_ON, ids=number_id)
def test_it_is_counted_under_one_name_whatever_the_number(exercise: NumberExercise) -> None:
    known = {short_name(fault) for fault in exercise.faults}
    for number in exercise.goes_on_from:
        names = {short_name(YOURS.format(given, number)) for given in ("92", "1.5e+08", "-3")}
        assert len(names) == 1
        assert names <= known


def test_judging_changes_nothing() -> None:
    exercise = EXERCISES["02.3"]
    records = {"02.1": {"given": 9.0, "who": "", "state": "wrong"}}
    machine = machine_for()
    knowing = after(exercise, records, machine, EXERCISES.__getitem__)
    assert "with your 9" in knowing.judge(9 * machine.die_mass_kg, machine).text
    assert "with your" not in exercise.judge(9 * machine.die_mass_kg, machine).text
    assert records == {"02.1": {"given": 9.0, "who": "", "state": "wrong"}}
