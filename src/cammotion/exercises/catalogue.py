"""All exercises by their numbers."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from cammotion.checks import one_of
from cammotion.exercises import (
    lesson_01,
    lesson_02,
    lesson_03,
    lesson_04,
    lesson_05,
    lesson_06,
)
from cammotion.exercises.kinds import Exercise

LESSONS = (lesson_01, lesson_02, lesson_03, lesson_04, lesson_05, lesson_06)

EXERCISES: Mapping[str, Exercise] = MappingProxyType(
    {exercise.number: exercise for lesson in LESSONS for exercise in lesson.EXERCISES}
)


def find_exercise(number: Any) -> Exercise:
    """Return the exercise of that number; an unknown one raises InputError with the known."""
    return EXERCISES[one_of("exercise", number, EXERCISES)]
