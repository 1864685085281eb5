"""The session of a learner: questions, checks, hints, predictions and progress."""

import os
from dataclasses import replace
from typing import Any

from cammotion.quantities import InputError, shorten
from cammotion.teaching.again import Practice, fresh_machines, whole_question
from cammotion.teaching.carried import after
from cammotion.teaching.controls import ChoiceControl, PredictionControl
from cammotion.teaching.design_exercise import DesignExercise
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Exercise, Verdict
from cammotion.teaching.lessons import EXERCISES, PREDICTIONS, find_exercise
from cammotion.teaching.messages import Feedback, Hint, Outcome, Progress, Question, Unseen
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.places import GRADING, find_place
from cammotion.teaching.reading import number_or_none
from cammotion.teaching.shown.choosing import show_answer
from cammotion.teaching.store import Record, Store, count, counts, right_for
from cammotion.teaching.variants import machine_for

_FRESH = 'cm.again("{}") asks it with fresh numbers.'
_LONGEST_NAME = 100  # that is offered
_OFFER = (
    "You have given a name before: write cm.variant({name!r}) here for the numbers of that name."
)


class Session:
    """The machine that the exercises ask about, and what was answered."""

    def __init__(self, store: Store) -> None:
        self.machine: MillAndDie = machine_for()
        self.store = store
        self.practice = Practice(store)
        self.hints: dict[str, int] = {}
        self.predictions: dict[tuple[str, str], PredictionControl] = {}

    def note(self, number: str, answer: Any, verdict: Verdict) -> str:
        """Keep what has become of an answer; what was right once stays right for these numbers.

        Return an offer of fresh numbers where it is right for the first time. A choice that is
        shown or checked again is no new try.
        """
        who, exercise = self.machine.who.casefold(), find_exercise(number)
        choice = exercise.letter(answer) if isinstance(exercise, ChoiceExercise) else ""
        score = None
        if isinstance(exercise, DesignExercise) and verdict.state == "right":
            score = exercise.score(answer, self.machine)
        given = number_or_none(answer) if isinstance(exercise, NumberExercise) else None
        was_right = False

        def change(before: Record) -> Record:
            nonlocal was_right
            is_same_who, right = before.get("who") == who, right_for(before)
            was_right = who in right
            right |= {who} if verdict.state == "right" else set()
            changes: Record = {"who": who, "state": "right" if who in right else verdict.state}
            if right:
                changes["right"] = sorted(right)
            if score is not None:
                best = before.get("best")
                changes["best"] = min(score, best) if isinstance(best, float) else score
            if given is not None or not is_same_who:
                changes["given"] = given
            if choice:
                changes["choice"] = choice
            if choice and choice == _letter(exercise, before):
                return changes | {"tries": count(before, "tries")}
            if verdict.reason:
                slips = counts(before.get("slips"))
                changes["slips"] = slips | {verdict.reason: slips.get(verdict.reason, 0) + 1}
            return changes | {"tries": count(before, "tries") + 1}

        self.store.change("exercises", number, change)
        is_first = verdict.state == "right" and not was_right
        offered = is_first and not isinstance(exercise, ChoiceExercise)
        return _FRESH.format(number) if offered else ""

    def record(self, number: str) -> Record:
        """Return what is kept of an exercise."""
        return self.store.records("exercises").get(number, {})

    def outcomes(self) -> tuple[Outcome, ...]:
        """Return how each exercise stands; it is right if it once was for the name of now."""
        who, records = self.machine.who.casefold(), self.store.records("exercises")
        kept = ((number, records.get(number, {})) for number in EXERCISES)
        return tuple(Outcome.of(n, each, is_right=who in right_for(each)) for n, each in kept)

    def choice(self, number: str) -> str | None:
        """Return the letter that was chosen, None if none was."""
        return _letter(find_exercise(number), self.record(number)) or None

    def next_hint(self, number: str, steps: int) -> int:
        """Return the step of the next hint, from 1 in each kernel; the furthest one is kept."""
        step = min(self.hints.get(number, 0) + 1, steps)
        self.hints[number] = step
        self.store.change(
            "exercises", number, lambda before: {"hints": max(step, count(before, "hints"))}
        )
        return step

    def prediction(self, key: str, asked: str) -> PredictionControl:
        """Return the field of a prediction, the same one each time: its reveals listen to it."""
        text = self.store.records("predictions").get(key, {}).get("text")
        kept = text if isinstance(text, str) else ""
        field = self.predictions.get((key, asked))
        if field is None:
            field = self.predictions[key, asked] = PredictionControl(
                asked,
                kept,
                lambda text: self.store.update("predictions", key, text=text),
                PREDICTIONS.get(key),
            )
        elif field.prediction != kept.strip():  # another notebook has changed it
            field.field.value = kept
        return field

    @property
    def name(self) -> str:
        """The name that was last given for a variant, in any notebook; "" if none was."""
        name = self.store.records("learner").get("variant", {}).get("name")
        return name.strip() if isinstance(name, str) and len(name) <= _LONGEST_NAME else ""

    def take(self, machine: MillAndDie) -> MillAndDie:
        """Ask about a machine from now on; keep whose it is, or offer the name given before."""
        name = self.name
        if machine.who and machine.who != name:
            self.store.update("learner", "variant", name=machine.who)
        if name and not machine.who:
            machine = replace(machine, remark=_OFFER.format(name=name))
        self.machine = machine
        self.practice.end()
        return machine


_SESSION = Session(Store(find_place))


def variant(who: str | int = "") -> MillAndDie:
    """Return the machine of a learner, and let all exercises ask about it from now on.

    `who` is a name or a number; the same one gives the same numbers, on any day and any computer.
    Without one they are those of a machine that no lesson speaks of, and a name that was given in
    an earlier notebook is offered in words. Raises InputError for anything else.

    >>> variant("Anna").rate_per_hour == variant("anna ").rate_per_hour
    True
    >>> variant().rate_per_hour
    2600
    """
    return _SESSION.take(machine_for(who))


def ask(number: str) -> Question:
    """Return the question of an exercise, by its number like "02.1", with the learner's numbers.

    Raises InputError for an unknown number.

    >>> ask("01.1")
    Exercise 01.1. The mill moves over 120 degrees of each turn, ...
    """
    exercise = find_exercise(number)
    machine = _SESSION.machine
    _SESSION.practice.end(number)
    return Question(number, exercise.question(machine), exercise.wanted_for(machine), machine)


def again(number: str) -> Question:
    """Return the question of an exercise with fresh numbers, which `check` then judges by.

    It does so for this exercise alone, and until `ask(number)` or `variant(who)` is run. Ask again
    until three are right in a row: `check` counts them, and `progress` tells of it. The numbers
    depend on who asks and how often, and are the same on any computer. Raises InputError for an
    unknown number, and for a choice, which has no numbers. While nbgrader grades nothing changes.

    >>> again("01.1")
    Exercise 01.1. With fresh numbers: The mill moves over ... degrees of each turn, ...
    >>> check("01.1", 70)
    01.1: Not yet. ... This is about the fresh numbers; cm.ask("01.1") goes back to yours.
    >>> ask("01.1")
    Exercise 01.1. The mill moves over 120 degrees of each turn, ...
    """
    exercise = find_exercise(number)
    fresh_machines(exercise, _SESSION.machine)  # raises for a choice, also while it is graded
    if GRADING in os.environ:
        return ask(number)
    machine = _SESSION.practice.begin(exercise, _SESSION.machine)
    question = f"With fresh numbers: {whole_question(exercise, machine)}"
    return Question(number, question, exercise.wanted_for(machine), machine)


def check(number: str, answer: Any) -> Feedback:
    """Return what there is to say of an answer to an exercise: right, or the reason why not.

    `answer` may be anything, None while there is none. For an exercise with a control the choice
    counts where the answer is None. Raises InputError only for an unknown number. While nbgrader
    grades it raises AssertionError for an answer that is not right, which costs the points.

    >>> check("02.1", 4420.8)
    02.1: Not yet. This is a thousand times too large. Is a length in mm where metres belong?
    """
    exercise = find_exercise(number)
    if answer is None and isinstance(exercise, ChoiceExercise) and GRADING not in os.environ:
        answer = _SESSION.choice(number)
    return _judge(number, answer)


def hint(number: str) -> Hint:
    """Return the next of three hints for an exercise; they end before the answer.

    Raises InputError for an unknown number.

    >>> hint("02.3")
    Hint 1 of 3 for 02.3: Newton: force is mass times acceleration.
    """
    hints = find_exercise(number).hints
    step = _SESSION.next_hint(number, len(hints))
    return Hint(number, step, len(hints), hints[step - 1])


def choose(number: str) -> ChoiceControl:
    """Return the options of an exercise as a control that answers each choice at once.

    Raises InputError for an unknown number and for an exercise without options.

    >>> type(choose("01.4")).__name__
    'ChoiceControl'
    """
    exercise = find_exercise(number)
    if not isinstance(exercise, ChoiceExercise):
        raise InputError(
            f"Exercise {number} has no options to choose from: use ask({number!r}) for its "
            f"question and check({number!r}, answer) for your answer."
        )
    return ChoiceControl(
        exercise,
        exercise.question(_SESSION.machine),
        _SESSION.choice(number),
        lambda letter: _judge(number, letter),
    )


def predict(key: str, asked: str) -> PredictionControl:
    """Return a field for a prediction; what was typed is kept under `key` and shown again.

    `asked` says what is predicted, with its unit, like "degrees for each way". The control's
    `reveal` shows an answer that is folded until a prediction is made; its `said` is a sentence
    that says which one was. Raises InputError for a key that is no text.

    >>> guess = predict("01.example", "degrees for each way")
    >>> guess.said
    'You made no prediction.'
    >>> guess.reveal("It is 92.5 for each way.")
    The answer is folded: you made no prediction yet.
    """
    if not isinstance(key, str) or not key.strip():
        raise InputError(f"The key of a prediction is {shorten(key)}: give one like '01.half'.")
    return _SESSION.prediction(key, str(asked))


def progress() -> Progress:
    """Return what is done and what is open, over all notebooks and since the first day.

    It says where that is kept: with the learner's copies, or where the notebook is.

    >>> progress().text.splitlines()[0]  # doctest: +ELLIPSIS
    '... exercises are right.'
    """
    return Progress(_SESSION.outcomes(), _SESSION.store.complaint, _SESSION.store.where)


def _judge(number: str, answer: Any) -> Feedback:
    exercise = find_exercise(number)
    if GRADING in os.environ:
        verdict = exercise.judge(answer, _SESSION.machine)
        if verdict.state != "right":
            raise AssertionError(f"{number}: {verdict.text}")
        return Unseen(number, verdict)
    fresh = _SESSION.practice.machine(number)
    machine = fresh or _SESSION.machine
    if not fresh:
        records = _SESSION.store.records("exercises")
        exercise = after(exercise, records, machine, find_exercise)
    verdict = exercise.judge(answer, machine)
    more = ""
    if verdict.state != "open" and fresh:
        more = _SESSION.practice.count(number, verdict)
    elif verdict.state != "open":
        more = _SESSION.note(number, answer, verdict)
    shown = show_answer(exercise, answer, machine)
    store = _SESSION.store
    note = store.complaint if verdict.state == "open" else store.tell()
    return Feedback(number, verdict, note, shown, more)


def _letter(exercise: Exercise, record: Record) -> str:
    """Return the letter that was chosen, "" if none was."""
    chosen = record.get("choice")
    return exercise.letter(chosen) if isinstance(exercise, ChoiceExercise) else ""
