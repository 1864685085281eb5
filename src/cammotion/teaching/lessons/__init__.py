"""Exercises and predictions of every lesson; a file `lesson_NN.py` beside this one is found."""

import importlib
import pkgutil
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

from cammotion.quantities import one_of
from cammotion.teaching.carried import link
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.prediction import Prediction

LESSONS = tuple(
    importlib.import_module(f"{__name__}.{found.name}")
    for found in pkgutil.iter_modules(__path__)
    if found.name.startswith("lesson_")
)

EXERCISES: Mapping[str, Exercise] = MappingProxyType(
    link(exercise for lesson in LESSONS for exercise in lesson.EXERCISES)
)

PREDICTIONS: Mapping[str, Prediction] = MappingProxyType(
    {made.key: made for lesson in LESSONS for made in lesson.PREDICTIONS}
)


def find_exercise(number: Any) -> Exercise:
    """Return the exercise of that number; an unknown one raises InputError with the known."""
    return EXERCISES[one_of("exercise", number, EXERCISES)]
