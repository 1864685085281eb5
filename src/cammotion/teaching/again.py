"""The same question with fresh numbers, until three right answers in a row show that it is known.

The numbers depend on who asks and for the how many-th time, and on nothing else. What a record
keeps under "again" is: who; round, the last one asked for; row, how many were right in a row;
longest, the longest row so far.
"""

import math
import re
from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import islice
from typing import Any

from cammotion.quantities import InputError
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Exercise, Verdict
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.messages import in_a_row
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.reasons import NO_ANSWER
from cammotion.teaching.store import Record, Store, counts
from cammotion.teaching.variants import drawn

ENOUGH = 3
_ROUNDS = 100  # then the numbers are those of the first round again
_UNLIKE = ENOUGH - 1  # before each answer there are so many others
_APART = 1e-3  # as a share: four digits tell so much
_RANGES: Mapping[str, tuple[float, float]] = {"deg": (0, 360), "%": (0, 100)}
_ANY = (0.0, math.inf)
_MOST = 2000  # machines in a row that an exercise is not asked about
_SPOKEN_OF = re.compile(r"exercise (\d\d\.\d)")


def fresh_machines(exercise: Exercise, own: MillAndDie) -> Iterator[MillAndDie]:
    """Yield machines with numbers to ask an exercise about, without an end.

    The answer is never that for the learner's own machine, or for the last two. Raises InputError
    for a choice, which has no numbers, and where no numbers can be found.
    """
    if isinstance(exercise, ChoiceExercise):
        raise InputError(
            f"Exercise {exercise.number} is a choice, which has no numbers that could be fresh: "
            f"use choose({exercise.number!r}) to look at it again."
        )
    return _unlike(exercise, own)


def _unlike(exercise: Exercise, own: MillAndDie) -> Iterator[MillAndDie]:
    last: deque[Any] = deque(maxlen=_UNLIKE)
    own_answer, passed_over = exercise.solution(own), 0
    for machine in drawn(f"again {exercise.number} {own.who.casefold()}", own.who):
        before = (own_answer, *last)
        if not why_not(exercise, machine) and not _is_right(exercise, before, machine):
            last.append(exercise.solution(machine))
            passed_over = 0
            yield machine
        elif (passed_over := passed_over + 1) == _MOST:
            raise InputError(
                f"There are no fresh numbers for exercise {exercise.number}: {_MOST} in a row "
                "could not be asked about. Go on with another exercise."
            )


def _is_right(exercise: Exercise, answers: Iterable[Any], machine: MillAndDie) -> bool:
    """Tell whether one of several answers is right for a machine."""
    return any(exercise.judge(answer, machine).state == "right" for answer in answers)


def why_not(exercise: Exercise, machine: MillAndDie) -> str:
    """Return why an exercise is not asked about a machine, "" if it can be.

    Its answer has to be a number in the range of its unit, and four digits have to tell it from
    each known wrong one.
    """
    if not isinstance(exercise, NumberExercise):
        return ""
    right = exercise.solution(machine)
    low, high = _RANGES.get(exercise.unit, _ANY)
    if not low < right < high:
        return f"{right:g} is not between {low:g} and {high:g} {exercise.unit}"
    wrong = (float(slip.leads_to(machine)) for slip in exercise.slips)
    if any(math.isclose(value, right, rel_tol=_APART) for value in wrong):
        return f"a wrong way leads to {right:g}, or as good as that"
    return ""


def whole_question(exercise: Exercise, machine: MillAndDie) -> str:
    """Return a question so that it can be answered alone: after those that it speaks of."""
    asked = exercise.question(machine)
    told = [
        f"Exercise {number} would be: {EXERCISES[number].question(machine)}"
        for number in dict.fromkeys(_spoken_of(asked, machine))
    ]
    return " ".join([*told, f"And {exercise.number}: {asked}"]) if told else asked


def _spoken_of(asked: str, machine: MillAndDie) -> Iterator[str]:
    """Yield the exercises that a question speaks of, each after those that it speaks of itself."""
    for number in _SPOKEN_OF.findall(asked):
        yield from _spoken_of(EXERCISES[number].question(machine), machine)
        yield number


@dataclass(frozen=True)
class _Fresh:
    """The numbers that an exercise asks about now, and whether they have counted as right."""

    machine: MillAndDie
    has_counted: bool = False


class Practice:
    """Which exercises ask about fresh numbers now, and how many were right in a row."""

    def __init__(self, store: Store) -> None:
        self._store = store
        self._now: dict[str, _Fresh] = {}

    def begin(self, exercise: Exercise, own: MillAndDie) -> MillAndDie:
        """Return fresh numbers, and let the exercise ask about them until it is ended."""
        machines, who, turn = fresh_machines(exercise, own), own.who.casefold(), 1

        def change(before: Record) -> Record:
            nonlocal turn
            kept = _kept(before, who)
            turn = kept.get("round", 0) % _ROUNDS + 1
            return {"again": {**kept, "who": who, "round": turn}}

        self._store.change("exercises", exercise.number, change)
        fresh = _Fresh(next(islice(machines, turn - 1, None)))
        self._now[exercise.number] = fresh
        return fresh.machine

    def end(self, number: str | None = None) -> None:
        """Let an exercise, or all, ask about the learner's own numbers again."""
        for one in [*self._now] if number is None else [number]:
            self._now.pop(one, None)

    def machine(self, number: str) -> MillAndDie | None:
        """Return the fresh numbers that an exercise asks about, None if it asks about none."""
        fresh = self._now.get(number)
        return fresh.machine if fresh else None

    def count(self, number: str, verdict: Verdict) -> str:
        """Count an answer for fresh numbers, and say how many are right in a row."""
        fresh, before, row = self._now[number], 0, 0
        is_right = verdict.state == "right"
        who = fresh.machine.who.casefold()

        def change(record: Record) -> Record:
            nonlocal before, row
            kept = _kept(record, who)
            before = row = kept.get("row", 0)
            if is_right:
                row += not fresh.has_counted
            elif verdict.reason != NO_ANSWER:  # a slip of the pen is no wrong answer
                row = 0
            longest = max(row, kept.get("longest", 0))
            return {"again": {**kept, "who": who, "row": row, "longest": longest}}

        self._store.change("exercises", number, change)
        if is_right:
            self._now[number] = replace(fresh, has_counted=True)
        return _said_right(number, row) if is_right else _said_wrong(number, before, row)


def _kept(record: Record, who: str) -> dict[str, int]:
    """Return what a record keeps of rounds and rows, if it is of the same learner."""
    kept = record.get("again")
    return counts(kept) if isinstance(kept, dict) and kept.get("who") == who else {}


def _said_right(number: str, row: int) -> str:
    once_more = f'cm.again("{number}") asks once more.'
    if row >= ENOUGH:
        return f"{in_a_row(row).capitalize()}: you can do this."
    if row > 1:
        return f"{in_a_row(row).capitalize()}. {once_more}"
    if row == 1:
        return f"The first in a row. {once_more}"
    return f"These numbers have counted before. {once_more}"


def _said_wrong(number: str, before: int, row: int) -> str:
    anew = ["The row begins anew."] if row < before else []
    return " ".join(
        [*anew, f'This is about the fresh numbers; cm.ask("{number}") goes back to yours.']
    )
