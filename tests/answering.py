"""Right answers put into a notebook, as a learner would type them."""

import json
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from cammotion.teaching.design_exercise import DesignExercise
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.expression_exercise import ExpressionExercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.variants import machine_for

Change = Callable[[str], str | None]
Notebook = dict[str, Any]
DESIGN = (
    "(lambda lessons, variants: lessons.EXERCISES['{number}'].solution("
    "variants.machine_for('{who}')))("
    "__import__('cammotion.teaching.lessons', fromlist=['x']), "
    "__import__('cammotion.teaching.variants', fromlist=['x']))"
)
"""A design that is right, as code in a single line."""


def read(path: Path) -> Notebook:
    """Read a notebook, the source of each cell as one text."""
    content: Notebook = json.loads(path.read_text("utf-8"))
    for cell in content["cells"]:
        cell["source"] = "".join(cell["source"])
    return content


def numbers_of(lesson: str) -> list[str]:
    return [number for number in EXERCISES if number.startswith(f"{lesson}.")]


def solution(number: str, machine: MillAndDie) -> str:
    """Return the right answer to an exercise as code."""
    exercise = EXERCISES[number]
    if isinstance(exercise, ExpressionExercise):
        return f"lambda {', '.join(exercise.variables)}: {exercise.solution(machine)}"
    if isinstance(exercise, DesignExercise):
        return DESIGN.format(number=number, who=machine.who)
    return repr(exercise.solution(machine))


def answering(who: str, numbers: Iterable[str], whose: str | None = None) -> Change:
    """Return a change: put in a name, and right answers to some exercises.

    They are right for the numbers of `whose`, if that is another than `who`.
    """
    machine = machine_for(who if whose is None else whose)
    answers = {f"answer_{number[3:]}": solution(number, machine) for number in numbers}

    def change(source: str) -> str:
        name, _, value = source.partition(" = ")
        if name in answers and value.startswith("None"):
            return f"{name} = {answers[name]}"
        return source.replace('cm.variant("")', f'cm.variant("{who}")')

    return change


def then(change: Change, special: Mapping[str, str | None]) -> Change:
    """Return a change that also replaces cells, known by how they begin; None deletes one."""

    def change_more(source: str) -> str | None:
        start = next((start for start in special if source.startswith(start)), None)
        return change(source) if start is None else special[start]

    return change_more


def changed(notebook: Notebook, change: Change) -> Notebook:
    """Return a notebook with the sources of its code cells changed."""
    cells = []
    for cell in notebook["cells"]:
        source = change(cell["source"]) if cell["cell_type"] == "code" else cell["source"]
        if source is not None:
            cells.append({**cell, "source": source})
    return {**notebook, "cells": cells}
