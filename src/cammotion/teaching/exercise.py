"""What all exercises have in common, and those with options: how an answer is judged."""

import unicodedata
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, Literal

from cammotion.quantities import shorten
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.reading import OddAnswerError
from cammotion.teaching.reasons import NO_ANSWER, short_name

State = Literal["open", "right", "wrong"]
_AROUND_A_LETTER = " \t\n().:'\""


@dataclass(frozen=True)
class Verdict:
    """What there is to say of an answer, and the short name of the reason if it is wrong."""

    state: State
    text: str
    reason: str = ""


@dataclass(frozen=True)
class Slip:
    """A known way to go wrong: what it leads to, a number or an expression, and the reason.

    NaN stands for a number where nobody would go that way. Where it is told `alone`, it is not
    said beside it that a number of the lesson's machine may lead there, too.
    """

    answer: Callable[[MillAndDie], Any]
    reason: str
    alone: bool = field(default=False, kw_only=True)

    def leads_to(self, machine: MillAndDie) -> Any:
        """Return what it leads to for a machine."""
        return led_to(self.answer, machine)


@lru_cache(maxsize=2**16)
def led_to(answer: Callable[[MillAndDie], Any], machine: MillAndDie) -> Any:
    """Work out an answer once: each that is given is held against the right one and all slips."""
    return answer(machine)


@dataclass(frozen=True, kw_only=True)
class Exercise(ABC):
    """What all kinds have in common.

    `number` names the notebook and the exercise, like "02.3". `question` asks it with the numbers
    of a machine. `right` says why a right answer matters. `hints` are three steps towards the
    answer, which end before it.
    """

    number: str
    question: Callable[[MillAndDie], str]
    right: str
    hints: tuple[str, str, str]

    def judge(self, answer: Any, machine: MillAndDie) -> Verdict:
        """Judge an answer of any type, by the numbers of a machine; never raise."""
        try:
            if answer is None or answer is ... or (isinstance(answer, str) and not answer.strip()):
                return Verdict("open", "not answered yet")
            fault = self.find_fault(answer, machine)
        except OddAnswerError as odd:
            return Verdict("wrong", str(odd), NO_ANSWER)
        except Exception:  # an object may do anything when it is looked at
            text = f"This cannot be read as an answer. What is asked for is {self.wanted}."
            return Verdict("wrong", text, NO_ANSWER)
        return Verdict("wrong", fault, short_name(fault)) if fault else Verdict("right", self.right)

    @property
    @abstractmethod
    def wanted(self) -> str:
        """What kind of answer is asked for, in words."""

    def wanted_for(self, machine: MillAndDie) -> str:  # noqa: ARG002 - only numbers need it
        """Return what is asked for, with how many digits where so many are needed."""
        return self.wanted

    @abstractmethod
    def solution(self, machine: MillAndDie) -> Any:
        """Return the right answer, computed for a machine."""

    @abstractmethod
    def find_fault(self, answer: Any, machine: MillAndDie) -> str:
        """Return why an answer is wrong, "" for a right one; raise OddAnswerError for no answer."""

    @property
    @abstractmethod
    def faults(self) -> tuple[str, ...]:
        """All that `find_fault` may return, with … in the place of a number that it measures."""


@dataclass(frozen=True, kw_only=True)
class ChoiceExercise(Exercise):
    """One of several options by their letters; each wrong one has a reason."""

    options: Mapping[str, str]
    answer: str
    reasons: Mapping[str, str]

    @property
    def wanted(self) -> str:
        """What kind of answer is asked for, in words."""
        return f"one of the letters {', '.join(self.options)}, as a text like 'a'"

    def solution(self, machine: MillAndDie) -> str:  # noqa: ARG002 - it is the same for all
        """Return the letter of the right option."""
        return self.answer

    def find_fault(self, answer: Any, machine: MillAndDie) -> str:  # noqa: ARG002
        """Return why an option is wrong; "" for the right one."""
        if not isinstance(answer, str):
            raise OddAnswerError(
                f"This is no letter (it is of type {type(answer).__name__}). Write {self.wanted}."
            )
        letter = self.letter(answer)
        if not letter:
            raise OddAnswerError(f"There is no {shorten(answer[:60])} here. Write {self.wanted}.")
        return "" if letter == self.answer else self.reasons[letter]

    @property
    def faults(self) -> tuple[str, ...]:
        """All that `find_fault` may return."""
        return tuple(self.reasons.values())

    def letter(self, answer: Any) -> str:
        """Return the letter of the option that an answer means, "" if it means none."""
        if not isinstance(answer, str):
            return ""
        letter = unicodedata.normalize("NFKC", answer).strip(_AROUND_A_LETTER).casefold()
        return letter if letter in self.options else ""
