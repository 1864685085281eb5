"""What a page says to answers and predictions, against what the notebooks say, in Node too."""

import json
import math
import random
import re
from collections.abc import Iterator
from functools import cache
from typing import Any

import node
import pytest
from site_pages import unpack

from cammotion.site.answers import pack, packed_answers
from cammotion.site.shared import host_module
from cammotion.site.verdicts import Verdicts, _beside, table_of
from cammotion.teaching.exercise import ChoiceExercise
from cammotion.teaching.lessons import EXERCISES, PREDICTIONS, find_exercise
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.teaching.variants import NAMELESS, drawn
from cammotion.views.live.page import as_json

NUMBERS = sorted(n for n, one in EXERCISES.items() if isinstance(one, NumberExercise))
OFFS = (0, 1e-4, 0.0035, 0.0045, 0.0125, 0.019, 0.07)
TYPED = [
    *("92.5", "about 92,5", "1/4", "1/4 of tm", "25 %", "25%", "0.25", "−3", "-3.2", "1e3", "0"),
    *("50 or 60", "few", "", "1/0", "v2", "2.5.3", "3,000", "x^2", "1e999", "2e12", "a 7 b"),
    *(
        "10^0.667",
        "4*0.0005*81",
        "sqrt(10)",
        "less than 1",
        "64 per minute",
        "√10",
        "1e-13",
        "-1e-13",
        "1e-310",
        "1e-323",
        "1 %",
        "mm 4",
        "4 m/s^2",
        "4 m/s**2",
        "4**2",
    ),
    *("½", "10 percent", "100", "0.0001", ".5", "5.", "+4", "4 m/s2", "4 m/s²", "µ5", "5µ"),
    *(
        "4 500",
        "4\u00a0500",
        "4\u202f500 pieces",
        "1 000 000",
        "0.1 g",
        "0.1g",
        "5 s",
        "3 g's",
        "3 gears",
    ),
    *("16 % less", "16 percent less", "less than 16", "at least 6", "least 6", "minimum 5"),
    *("-.5", "1/.5", "1 .5", "..5", "0.03 m", "0.03m", "30 um", "30 µm", "30 μm", "30 microns"),
    *("5 in", "5 in.", "5 inches", "5 in each", "1 m/s²", "1 m / s", "1 in/s²", "1 inch/sec²"),
    *("0.8/s", "0.8 per s", "0.8 a second", "3k", "3K", "3 thousand", "64 rpm", "5 MM", "30°"),
    *("2x", "2 ×", "4.6× as fast", "5 times", "2x3", "2pi", "2 pi", "2π", "6.28 pixels", "3 PI"),
    *("half of 4.154", "twice 9", "1/4 of the peak", "2 thirds", "0.9 of it", "8/24"),
    *("8.6'", "9\u2032", "'92.5'", "\u201892.5\u2019", "'8.6''", "“8”", " '1/4' "),
    *("10 % lower", "by 10 %", "10 % off", "-10 %", "- 10 %", "90 % by it", "10 times smaller"),
    *("25 per cent", "25 Percent", "25 Prozent", "25 percent", "50 %, half the stroke"),
    *("0.14 deg of play", "a factor of 10", "8 of them", "0.3 of them", "8 of 24", "12of it"),
    *("1.04, a quarter of it", "1/4 (a quarter)", "140 (twice)", "8, a third", "1 half", "a half"),
    *("half of the 4.154", "half of -4", "twice .5", "a tenth of 4.154", "6 and a half"),
    *("9 tenths", "8.6 quarters", "the 5th", "0.25 of 1", "1/3 of them"),
    *("0.25 x tm", "1/4 X TM", "0.25 times tm", "1/4*tm", "4 x tms", "4 × tm²", "4 tm"),
    *("2 pi²", "2pi²", "²pi 2", "2 pier", "pi2", "1½", "1 ½", "6¼", "2¾ x", "1.5½", "8/18", "8th"),
    *("6.3 mm radius", "5 per minute", "MIN 4", "0.2 metres", "5 d", "4 ms", "°5", "3 deg/s"),
    *("a_max = 4", "x = 4", "I = 4", "Ca = 6", "2 pi = 6", "sqrt(4)/2 = 1.925", "8 (from the end)"),
    *("half, 2.08", "half, 0.5", "no, 3 mm", "none, 0", "$t_m$/4", "+3.4 %", "falls to 1.04"),
    *("3 times larger", "larger: 1.5", "smaller, 0.9", "its peak falls by 9 %", "halfway, 0.5"),
    *("\uff13\uff18", "٩٢", "90 % débyé", "1.04 ofü", "5 İn", "- 16 %", "3.857", "10²", "x4"),
]
PIECES = (
    "||||about|i think|my answer is|=|≈|a =|at least|under|up to|not|ca.|±|+-|-|−|x|1/|(|'|“",
    "8|92,5|0.25|.5|1½|¼|1 1/2|4,154|3.857|3 857|10'000|1e3|10²|٩٢|\uff11|half|a third|eight|tm/4",
    "|||%|percent|\uff05|deg|°|mm|cm|m/s²|m s⁻²|in/sec^2|in|in total|x tm|times|-fold|less|above",
    "|||of 24|of it|of the stroke|per hour|a day|pi|π|ü|k|\u017f|\u212a|, or so|or more|(cm)|)|”|.",
)
"""What a text is put together from: what stands before a number, a number, a unit, and the rest."""


def mixed(dice: random.Random) -> str:
    """Return a text as somebody might type it."""
    return dice.choice((" ", "", "\u00a0")).join(dice.choice(row.split("|")) for row in PIECES)


def exercise(number: str) -> NumberExercise:
    found = find_exercise(number)
    assert isinstance(found, NumberExercise)
    return found


@cache
def table(number: str) -> Verdicts:
    return table_of(exercise(number), NAMELESS)


def given_to(one: NumberExercise, machine: Any) -> Iterator[float]:
    """Yield what somebody may type: about the right number and every slip, rounded, and at random.

    Nobody's number lies on an edge to the last bit: those that do are moved off it.
    """
    dice = random.Random(one.number)  # noqa: S311 - the same numbers each time
    ways = [float(slip.leads_to(machine)) for slip in (*one.slips, *one.carried[:4])]
    ways += [1000 * way for way in ways[:3] if one.is_product]
    for value in filter(math.isfinite, (one.solution(machine), *ways)):
        for off in OFFS:
            near = value * (1 + dice.choice((-1, 1)) * off)
            yield from (float(f"{near:.{digits}g}") for digits in (2, 3, 9))
    yield from (dice.choice((-1, 1)) * 10 ** dice.uniform(-4, 7) for _ in range(20))


def is_off_the_edges(given: float, edges: tuple[float, ...]) -> bool:
    return all(abs(given - edge) > 1e-9 * abs(given) for edge in edges)


def told(one: NumberExercise, given: float, machine: Any) -> str:
    """Return what the notebook says, with the sign in place of a percentage."""
    fault = one.find_fault(given, machine)
    head, found, rest = fault.partition("off by ")
    return f"{head}{found}…{rest[rest.index(' %') :]}" if found and " %" in rest else fault


@pytest.mark.parametrize("number", NUMBERS)
def test_the_table_says_what_the_exercise_says(number: str) -> None:
    one, said = exercise(number), table(number)
    given = [g for g in given_to(one, NAMELESS) if is_off_the_edges(g, said.edges)]
    assert len(given) > 100
    wrong = {g: said.of(g) for g in given if said.of(g) != told(one, g, NAMELESS)}
    assert not wrong
    assert said.of(one.solution(NAMELESS)) == ""


def test_it_does_so_for_another_machine() -> None:
    machine = next(drawn("another", "Another"))
    one = exercise("03.4")
    said = table_of(one, machine)
    given = [g for g in given_to(one, machine) if is_off_the_edges(g, said.edges)]
    assert all(said.of(g) == told(one, g, machine) for g in given)


def test_a_page_says_the_same_to_a_number() -> None:
    """The page's script reads the packed table as Python does, and fills in how far off it is."""
    asked = [
        (number, given, exercise(number).find_fault(given, NAMELESS))
        for number in NUMBERS[::5]
        for given in [*given_to(exercise(number), NAMELESS)][::7]
        if is_off_the_edges(given, table(number).edges)
    ]
    tables = json.loads(unpack(packed_answers(map(exercise, NUMBERS[::5]), [], NAMELESS)))
    said = run(
        "return given.asked.map(([number, value]) => "
        "verdict(given.tables[number], value, format));",
        {"tables": tables, "asked": asked},
    )
    for (number, given, fault), text in zip(asked, said, strict=True):
        head = f"Not yet. {fault}" if fault else f"Right. {exercise(number).right}"
        assert text == head.replace(f'cm.hint("{number}") gives a hint.', "hints are below."), given


def test_a_typed_answer_is_read_as_a_number_or_told_that_it_is_none() -> None:
    """With marks between thousands too; what is said names no number, which might be right."""
    marked = ("4,420.8", "4.420,8", "4 420.8", "4 420,8", "4'420.8", "+4420,8")
    others = {"1,234,567": 1234567, "1.234.567": 1234567, "2 791": 2791, "−1,234.5": -1234.5}
    numbers = dict.fromkeys(marked, 4420.8) | others
    refused = ("a word", "1.2.3", "1,23,456", "4,420,8", "4,42.8", "12 mm", "about 12", "0,806.5")
    (packed,) = json.loads(unpack(packed_answers([exercise("02.1")], [], NAMELESS))).values()
    script = "return given[1].map((text) => answerTo(given[0], text, { format, readings }));"
    said = run(script, [packed, [*numbers, *map(str, numbers.values()), *refused]])
    assert said[: len(numbers)] == said[len(numbers) : 2 * len(numbers)]
    assert "in mm where metres belong" in said[0]
    for text, told in zip(refused, said[2 * len(numbers) :], strict=True):
        assert told.startswith(f"“{text}” is no number: write ")
        assert not re.search(r"\d", told.replace(text, ""))


def test_a_choice_has_a_reason_for_each_letter() -> None:
    choices = [one for one in EXERCISES.values() if isinstance(one, ChoiceExercise)]
    said = unpack(packed_answers(choices, [], NAMELESS))
    for one in choices:
        assert f"Right. {one.right}" in said
        assert all(f"Not yet. {reason}" in said for reason in one.reasons.values())


def test_a_page_says_how_far_off_a_prediction_is_as_python_does() -> None:
    made = [each for each in PREDICTIONS.values() if not isinstance(each.true, str)]
    dice = random.Random(41)  # noqa: S311 - the same texts each time
    typed = [
        [
            *TYPED,
            *(mixed(dice) for _ in range(40)),
            *(
                f"{float(each.true) * times:.4g}"
                for times in (-1, -1.4, 0.01, 0.2, 0.7, 0.985, 1.01, 1.4, 1.97, 3, 100, 1234)
            ),
        ]
        for each in made
    ]
    tables = json.loads(unpack(packed_answers([], made, NAMELESS)))
    said = run(
        "return given.map(([made, typed]) => "
        "typed.map((text) => howFar(made, text, { format, readings })));",
        [[tables[each.key], texts] for each, texts in zip(made, typed, strict=True)],
    )
    for each, texts, answers in zip(made, typed, said, strict=True):
        assert answers == [each.how_far(text) for text in texts], each.key


@pytest.mark.parametrize("key", ["12.rate", "02.fraction"])
def test_a_page_asks_what_a_prediction_means_as_python_does(key: str) -> None:
    made = PREDICTIONS[key]
    typed = [*TYPED, "20,000", "3,857", "12.345", "about 10,500", "10,000 or 20,000"]
    typed += ["1,001 %", "2,004 %", "20,000 " + 10 * "I think ", "2,004 % " + 10 * "I think "]
    (table,) = json.loads(unpack(packed_answers([], [made], NAMELESS))).values()
    said = run(
        "return given.typed.map((text) => unclear(given.made, text, { readings }));",
        {"made": table, "typed": typed},
    )
    assert said == [made.unclear(text) for text in typed]
    assert len([text for text in said if text]) >= 2


def test_predictions_in_percent_are_read_as_such() -> None:
    made = Prediction("00.test", "percent", 30)
    said = run(
        "return howFar(given, '25 %', { format, readings });",
        {"asked": "percent", "true": [30], "low": 0, "high": 999, "near": 0.02},
    )
    assert said == made.how_far("25 %") == "17 % too little"


def run(body: str, given: Any) -> Any:
    """Run JavaScript with all that a page's host knows."""
    return node.run(body, given, host_module())


def test_what_is_packed_is_unpacked_as_it_was() -> None:
    assert unpack(pack("0.6451 mm")) == "0.6451 mm"


def test_what_is_packed_is_one_line_that_cannot_be_read() -> None:
    one = exercise("03.4")
    packed = packed_answers([one], PREDICTIONS.values(), NAMELESS)
    assert packed.isascii()
    assert "\n" not in packed
    assert f"{one.solution(NAMELESS):.3f}"[:5] not in packed
    assert as_json(unpack(packed)).count("Not yet.") > 5


@pytest.mark.parametrize("share", [0.1, 0.002])
def test_what_is_near_ends_where_it_differs_by_the_share_of_either(share: float) -> None:
    for end in (*_beside(4.0, share), *_beside(-4.0, share)):
        off = abs(abs(end) - 4)
        assert any(off == pytest.approx(share * of, rel=1e-9) for of in (4, abs(end)))
    assert len({*_beside(4.0, share)}) == 4
