"""How far an answer may be rounded, over all numbers that are asked for."""

import re
from dataclasses import replace

import pytest
import rounding
from judging import MACHINES, each_number, is_right, say
from known_slips import peak
from known_slips_laws import least

import cammotion as cm
from cammotion.teaching.example import EXAMPLE
from cammotion.teaching.exercise import Slip
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.reasons import short_name
from cammotion.teaching.variants import machine_for


def simple(answer: float, *slips: float) -> NumberExercise:
    """Return an exercise with this answer and slips that are named after what they lead to."""
    return NumberExercise(
        number="00.0",
        question=lambda _: "How much?",
        right="It is.",
        hints=("Look.", "Think.", "Count."),
        unit="rpm",
        answer=lambda _: answer,
        slips=tuple(Slip(lambda _, at=at: at, f"slip {at}") for at in slips),  # type: ignore[misc]
    )


@each_number
def test_an_answer_rounded_as_the_question_asks_is_right(exercise: NumberExercise) -> None:
    for machine in MACHINES:
        rounding.assert_rounded_as_asked_is_right(exercise, machine)


@each_number
def test_two_digits_are_enough_unless_they_are_too_far_off_or_a_slips(
    exercise: NumberExercise,
) -> None:
    for machine in MACHINES:
        rounding.assert_two_digits_are_enough(exercise, machine)


@each_number
def test_no_known_wrong_way_is_right_for_anybody(exercise: NumberExercise) -> None:
    for machine in MACHINES:
        rounding.assert_no_wrong_way_is_right(exercise, machine)


@pytest.mark.parametrize(
    ("number", "answer", "is_enough"),
    [
        ("01.3", 3.7, True),
        ("05.2", 22, True),
        ("05.2", 22.2, True),
        ("05.1", 2.6, False),
        ("05.1", 2.64, True),
        ("06.3", 0.51, False),
        ("06.3", 0.511, True),
        ("06.4", 1.6, False),
        ("06.4", 1.58, True),
    ],
)
def test_what_the_source_may_be_rounded_to(number: str, answer: float, is_enough: bool) -> None:
    assert is_right(EXERCISES[number], answer) is is_enough


@pytest.mark.parametrize(
    ("number", "who", "digits"),
    [
        ("04.3", "x 312", 2),
        ("04.3", "x 533", 2),
        *(("06.4", f"x {who}", digits) for who, digits in ((154, 3), (28, 4), (53, 5), (90, 16))),
        *(("06.4", f"x {who}", digits) for who, digits in ((57, 5), (76, 4), (431, 4), (53, 16))),
    ],
)
def test_who_reckons_with_the_angle_that_the_question_prints_is_right_and_so_is_who_has_more(
    number: str, who: str, digits: int
) -> None:
    m = machine_for(who)
    (printed,) = re.findall(r"\d+\.\d\d(?= degrees)", EXERCISES[number].question(m))
    for angle in (float(printed), m.widest_deg):
        rest = 360 - m.work_deg - 2 * angle
        answer = {
            "04.3": rest / 360 * 3_600_000 / m.rate_per_hour,
            "06.4": peak(m, angle) / least(m),
        }[number]
        assert is_right(EXERCISES[number], float(f"{answer:.{digits}g}"), m)


def test_the_effective_angle_of_the_mill_is_a_slip_and_not_the_rounded_angle_of_the_die() -> None:
    assert "effective angle of the mill" in say(EXERCISES["03.4"], 120)


def test_a_question_says_how_many_digits_it_wants_where_two_are_too_few() -> None:
    assert EXERCISES["06.3"].wanted_for(EXAMPLE) == "one number in m/s², to three digits"
    cm.variant("")
    assert cm.ask("03.4").text.endswith("(Answer: one number in deg, to three digits.)")
    assert cm.ask("03.5").text.endswith("(Answer: one number.)")


def test_a_half_may_be_rounded_either_way() -> None:
    for answer in (62, 63, 62.5):
        assert is_right(simple(62.5), answer)
    for answer in (61, 64):
        assert not is_right(simple(62.5), answer)


def test_a_rounded_number_more_than_1_2_percent_off_is_told_so() -> None:
    assert say(simple(124.84), 120).endswith("give three digits at least.")
    assert is_right(simple(124.84), 125)


def test_who_leads_to_the_same_number_by_another_way_is_told_both() -> None:
    same = simple(3.719, 7, 7.0000000001, 8)
    both = "More than one way leads to this number. slip 7 Or: slip 7.0000000001"
    assert say(same, 7) == both
    assert say(same, 8) == "slip 8"
    near = simple(245.1, 231.63, 231.53)
    assert say(near, 231.63) == "slip 231.63"
    assert say(near, 231.5) == "slip 231.53"
    assert say(near, 232) == "More than one way leads to this number. slip 231.63 Or: slip 231.53"
    assert near.judge(232, EXAMPLE).reason == short_name("slip 231.63")


def test_a_slip_that_rounds_to_the_same_digits_asks_for_more_of_them() -> None:
    for slip, two, three in ((3.68, 3.7, 3.72), (3.7, 3.7, 3.72)):
        exercise = simple(3.719, slip)
        assert exercise.wanted_for(EXAMPLE) == "one number in rpm, to three digits"
        said = "give three digits" if slip != two else f"slip {slip}"
        assert said in say(exercise, two)
        assert is_right(exercise, three)
    close = simple(3.7188, 3.721)
    assert "give four digits" in say(close, 3.72)
    assert is_right(close, 3.719)
    assert say(close, 3.721) == "slip 3.721"


def test_between_a_slip_and_the_right_number_the_nearer_one_counts() -> None:
    exercise = simple(0.737, 0.7372)
    assert is_right(exercise, 0.73705)
    assert say(exercise, 0.73717) == "slip 0.7372"


def test_a_slip_is_known_by_two_digits_too() -> None:
    assert say(simple(0.737, 0.5234), 0.52) == "slip 0.5234"
    assert "too small" in say(simple(0.737, 0.5234), 0.53)


def test_a_slip_is_known_by_three_digits_where_they_are_further_off_than_the_tolerance() -> None:
    assert say(simple(3.719, 1.0249), 1.02) == "slip 1.0249"
    assert "too small" in say(simple(3.719, 1.0249), 1.03)


def test_a_number_with_too_few_digits_is_not_called_a_slip() -> None:
    """1.318 and 1.296 are both 1.3."""
    assert "give three digits" in say(simple(1.31824, 1.2963), 1.3)


def test_a_slip_that_leads_to_the_right_number_does_not_count() -> None:
    assert is_right(simple(0.737, 0.737), 0.74)


def test_a_slip_is_claimed_for_certain_only_where_the_digits_that_are_typed_agree() -> None:
    exercise = simple(1.28062, 1.28252)
    for typed in (1.28252, 1.282520001, 1.2825, 1.283):
        assert say(exercise, typed) == "slip 1.28252"
    said = say(exercise, 1.2831823)
    assert said.startswith("More than one way leads to this number. slip 1.28252 Or: Close, but")
    assert "rounded on the way" not in say(simple(1.28062, 5.13), 5.1345)  # far off the right one
    assert "rounded on the way" not in say(replace(exercise, is_count=True), 1.2831823)


@pytest.mark.parametrize(
    ("number", "who", "per_step", "places"),
    [("06.3", "Anna", 3600 / 360, 4), ("06.3", "", 3600 / 360, 3), ("09.1", "N17", 60, 3)],
)
def test_a_time_that_was_rounded_is_not_taken_for_a_slip_alone(
    number: str, who: str, per_step: float, places: int
) -> None:
    """Its square brings the answer near to a slip, by chance."""
    machine = machine_for(who)
    measured = machine.measured
    rate = measured.per_minute * measured.points if number == "09.1" else machine.rate_per_hour
    time = per_step / rate
    power = 2 if number == "09.1" else -2
    right = EXERCISES[number].solution(machine)
    given = right * (round(time, places) / time) ** power
    assert "rounded on the way" in say(EXERCISES[number], given, machine)


def test_a_round_number_that_came_out_of_a_rounded_time_is_told_so() -> None:
    """With 0.02 s from point to point it is 30 to all digits: more of them cannot be given."""
    machine = machine_for()
    time = round(60 / machine.measured.per_minute / machine.measured.points, 2)
    given = machine.measured.limit * time**2 / 2 * 1e6
    assert given == pytest.approx(30)
    assert "rounded on the way" in say(EXERCISES["09.1"], given, machine)


def test_a_right_answer_that_is_nearly_round_is_right_with_all_its_digits() -> None:
    """109.99947 is no answer to two digits, though it is nearly 110."""
    right = 109.99946558430335
    slips = (Slip(lambda _: 112.0, "two too many"),)
    exercise = EXERCISES["03.4"]
    assert isinstance(exercise, NumberExercise)
    exercise = replace(exercise, answer=lambda _: right, slips=slips)
    for given in (right, 109.9995, 110.0, 109.999):
        assert is_right(exercise, given)
    assert say(exercise, 112.0) == "two too many"


def test_a_right_answer_beside_another_way_may_have_five_digits() -> None:
    """For this name a number of the lesson's machine leads to 140.72, the right way to 140.74."""
    machine = machine_for("torn1 201")
    exercise = EXERCISES["04.3"]
    assert isinstance(exercise, NumberExercise)
    assert f"{exercise.solution(machine):.2f}" == "140.74"
    rounding.assert_rounded_as_asked_is_right(exercise, machine)
