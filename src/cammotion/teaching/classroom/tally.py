"""Count what a class has done: reasons of wrong answers, words of predictions."""

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from cammotion.teaching.classroom.clean import clean
from cammotion.teaching.classroom.collect import Student
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.reasons import NO_ANSWER, short_name
from cammotion.teaching.store import counts

_LITTLE_WORDS = frozenset(("a", "an", "and", "at", "by", "in", "is", "it", "of", "or", "the", "to"))


@dataclass(frozen=True)
class Told:
    """A reason for a wrong answer, as the learners read it; how many did, and how often."""

    reason: str
    students: int
    times: int


def slips(exercise: Exercise, students: Iterable[Student]) -> list[Told]:
    """Return why answers to an exercise were wrong, first what most students met with."""
    said = {short_name(fault): fault for fault in exercise.faults}
    said[NO_ANSWER] = f"No answer to the question. What is asked for is {exercise.wanted}."
    made = [counts(s.exercises.get(exercise.number, {}).get("slips")) for s in students]
    who = Counter(name for slips in made for name in slips)
    told = (
        Told(
            said.get(name) or f"A reason of another version of the workbook: {clean(name, 60)}",
            count,
            sum(slips.get(name, 0) for slips in made),
        )
        for name, count in who.items()
    )
    return sorted(told, key=lambda one: (-one.students, -one.times, one.reason))


def words(texts: Sequence[str]) -> list[tuple[str, int]]:
    """Return the words of typed predictions, and in how many of them each stands.

    Capitals do not count, nor do words that say nothing by themselves.

    >>> words(["The die, 4 times", "die", "mill"])
    [('die', 2), ('4', 1), ('mill', 1), ('times', 1)]
    """
    each = ({*re.findall(r"\w+(?:[.,]\d+)?", text.casefold())} for text in texts)
    counted = Counter(clean(word) for found in each for word in found - _LITTLE_WORDS)
    return sorted(counted.items(), key=lambda item: (-item[1], item[0]))
