"""An error that is carried forward: a later answer that is right for a wrong earlier one."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial

from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.number_exercise import (
    WITH_LESSONS,
    WITH_WRONG,
    YOURS,
    Carried,
    GoingOn,
    NumberExercise,
)
from cammotion.teaching.reading import number_or_none
from cammotion.teaching.store import Record


def link(exercises: Iterable[Exercise]) -> dict[str, Exercise]:
    """Return exercises by their numbers; those that go on from earlier ones know their slips.

    The earlier ones come first. An error is carried on over more than one exercise. The lesson's
    answer to an earlier one is such a slip, too.
    """
    linked: dict[str, Exercise] = {}
    for exercise in exercises:
        if isinstance(exercise, NumberExercise) and exercise.goes_on_from:
            linked[exercise.number] = replace(exercise, carried=tuple(_carry(exercise, linked)))
        else:
            linked[exercise.number] = exercise
    return linked


def after(
    exercise: Exercise,
    records: Mapping[str, Record],
    machine: MillAndDie,
    find: Callable[[str], Exercise],
) -> Exercise:
    """Return an exercise that knows what a learner's wrong answers to earlier ones lead to.

    It forgets the slips of those that were answered right. `records` keep the number that was last
    given to an exercise, and whose numbers that was asked for; only those of this machine count.
    `find` returns the exercise of a number.
    """
    if not isinstance(exercise, NumberExercise):
        return exercise
    earlier = {number for slip in exercise.carried for number in slip.through}
    right, brought = set(), []
    for number in sorted(earlier | exercise.goes_on_from.keys()):
        record = records.get(number, {})
        given = number_or_none(record.get("given"))
        if given is None or record.get("who") != machine.who.casefold():
            continue
        if find(number).judge(given, machine).state == "right":
            right.add(number)
        elif number in exercise.goes_on_from:
            said = YOURS.format(f"{given:.5g}", number)
            going_on = _going_on(exercise.goes_on_from[number], given)
            brought.append(Carried(going_on, said, (number,)))
    carried = tuple(slip for slip in exercise.carried if right.isdisjoint(slip.through))
    return replace(exercise, brought=tuple(brought), carried=carried)


def _carry(exercise: NumberExercise, linked: dict[str, Exercise]) -> Iterator[Carried]:
    for number, going_on in exercise.goes_on_from.items():
        earlier = linked[number]
        if isinstance(earlier, NumberExercise):
            lessons = _going_on(going_on, partial(_of_the_lesson, earlier))
            yield Carried(lessons, WITH_LESSONS.format(number), (number,))
            for slip in earlier.slips:
                said = f"{WITH_WRONG.format(number)} {slip.reason}"
                yield Carried(_going_on(going_on, slip.answer), said, (number,), slip.reason)
            for before in earlier.carried:  # its reason names the exercise that it comes from
                answer, through = _going_on(going_on, before.answer), (*before.through, number)
                yield replace(before, answer=answer, through=through)


def _of_the_lesson(earlier: NumberExercise, _: MillAndDie) -> float:
    return earlier.solution(EXAMPLE)


def _going_on(
    going_on: GoingOn, earlier: float | Callable[[MillAndDie], float]
) -> Callable[[MillAndDie], float]:
    def answer(machine: MillAndDie) -> float:
        """Return what an earlier answer leads to, NaN where nobody would go on with it."""
        try:
            value = earlier(machine) if callable(earlier) else earlier
            return float(going_on(machine, float(value)))
        except (ValueError, ArithmeticError):
            return math.nan

    return answer
