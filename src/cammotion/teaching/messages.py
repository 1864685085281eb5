"""What an exercise shows: its question, a hint, what is said of an answer, and the progress."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from typing import Any

from cammotion.quantities import plural
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import State, Verdict
from cammotion.teaching.shown.frame import Shown
from cammotion.teaching.store import Record, count
from cammotion.views.paper import STYLE

# The ground and the edge; the word says what the colour says.
_COLOURS: dict[State, tuple[str, str]] = {
    "right": ("#e3f4e8", "#1e7b3a"),
    "wrong": ("#fdeee2", "#b3560b"),
    "open": ("#eef1f4", "#5b6670"),
}
_WORDS: dict[State, str] = {"right": "Right.", "wrong": "Not yet.", "open": ""}
_IN_WORDS = {2: "two", 3: "three"}


class Card(ABC):
    """Something that is shown as HTML, and as plain text where there is no HTML."""

    @property
    @abstractmethod
    def text(self) -> str:
        """The plain text."""

    @property
    @abstractmethod
    def html(self) -> str:
        """The HTML."""

    def __repr__(self) -> str:
        return self.text

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        return {"text/plain": self.text, "text/html": self.html}


@dataclass(frozen=True, repr=False)
class Question:
    """The question of an exercise, with the unit of its answer; it may hold formulas.

    So it is shown as Markdown, and as plain text where there is none. `machine` is what it asks
    about.
    """

    number: str
    question: str
    wanted: str
    machine: MillAndDie

    @property
    def text(self) -> str:
        """The plain text."""
        return f"Exercise {self.number}. {self.question} (Answer: {self.wanted}.)"

    def __repr__(self) -> str:
        return self.text

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        markdown = f"**Exercise {self.number}.** {self.question} *Answer: {self.wanted}.*"
        return {"text/plain": self.text, "text/markdown": markdown}


@dataclass(frozen=True, repr=False)
class Feedback(Card):
    """What is said of an answer, shown of what it would do, and offered next (`more`)."""

    number: str
    verdict: Verdict
    note: str = ""
    shown: Shown | None = None
    more: str = ""

    @property
    def is_right(self) -> bool:
        """Whether the answer is right."""
        return self.verdict.state == "right"

    @property
    def text(self) -> str:
        """The plain text."""
        return " ".join(filter(None, [*self._parts, self._line, self.more, self.note]))

    @property
    def html(self) -> str:
        """The HTML; a screen reader reads it out when it appears."""
        head, *rest = map(escape, self._parts)
        note = f"<div><small>{escape(self.note)}</small></div>" if self.note else ""
        shown = f"{self.shown.html}<div>{escape(self._line)}</div>" if self.shown else ""
        more = f"<div>{escape(self.more)}</div>" if self.more else ""
        said = f"<strong>{head}</strong> {' '.join(rest)}{shown}{more}{note}"
        return box(self.verdict.state, said)

    @property
    def _line(self) -> str:
        return self.shown.line if self.shown else ""

    @property
    def _parts(self) -> Sequence[str]:
        if self.verdict.state == "open":
            return (f"{self.number} is {self.verdict.text}.",)
        return (f"{self.number}: {_WORDS[self.verdict.state]}", self.verdict.text)


class Unseen(Feedback):
    """Feedback that shows nothing: nbgrader tries to read points out of what a cell shows."""

    def _ipython_display_(self) -> None:
        """Show nothing."""


@dataclass(frozen=True, repr=False)
class Hint(Card):
    """One step of the ladder of hints."""

    number: str
    step: int
    steps: int
    hint: str

    @property
    def text(self) -> str:
        """The plain text."""
        return f"Hint {self.step} of {self.steps} for {self.number}: {self.hint}"

    @property
    def html(self) -> str:
        """The HTML."""
        return box("open", escape(self.text))


@dataclass(frozen=True)
class Outcome:
    """What has become of an exercise: a line of the progress.

    `row` is how many were right in a row with fresh numbers, at most so far.
    """

    number: str
    state: State
    tries: int = 0
    hints: int = 0
    row: int = 0

    @classmethod
    def of(cls, number: str, record: Record, *, is_right: bool = False) -> "Outcome":
        """Read what has become of an exercise out of its record; it may be known to be right."""
        tries, hints = count(record, "tries"), count(record, "hints")
        is_right = is_right or record.get("state") == "right"
        state: State = "right" if is_right else "wrong" if tries else "open"
        row = count(record.get("again"), "longest")
        return cls(number, state, tries, hints, row)

    @property
    def said(self) -> str:
        """What has become of it, in words."""
        row = f", {in_a_row(self.row)}" if self.row > 1 else ""
        if self.state == "open":
            return f"open{row}"
        tries = f", {self.tries} {'try' if self.tries == 1 else 'tries'}" if self.tries else ""
        hints = f", {plural(self.hints, 'hint')}" if self.hints else ""
        return f"{'right' if self.state == 'right' else 'not yet'}{tries}{hints}{row}"


@dataclass(frozen=True, repr=False)
class Progress(Card):
    """What is done and what is open, over all notebooks, and where that is kept."""

    lines: tuple[Outcome, ...]
    note: str = ""
    where: str = ""

    @property
    def right(self) -> int:
        """The number of exercises that are right."""
        return sum(line.state == "right" for line in self.lines)

    @property
    def summary(self) -> str:
        """The state of all in a sentence."""
        return f"{self.right} of {len(self.lines)} exercises are right."

    @property
    def text(self) -> str:
        """The plain text."""
        lines = (f"{line.number}  {line.said}" for line in self.lines)
        return "\n".join(filter(None, [self.summary, *lines, self.note, self.where]))

    @property
    def html(self) -> str:
        """The HTML: a table with a row for each exercise."""
        rows = "".join(
            f'<tr><th scope="row">{line.number}</th><td style="text-align: left">{line.said}</td>'
            "</tr>"
            for line in self.lines
        )
        head = '<tr><th scope="col">exercise</th><th scope="col">state</th></tr>'
        notes = "".join(f"<p>{escape(said)}</p>" for said in (self.note, self.where) if said)
        return f"<p>{self.summary}</p><table>{head}{rows}</table>{notes}"


def box(state: State, content: str) -> str:
    """Return the HTML of a box with the colours of a state; it is read out when it appears."""
    ground, edge = _COLOURS[state]
    return (
        f'{STYLE}<div role="status" class="cm-paper" style="background: {ground}; color: #1b1b1b; '
        f"padding: 0.6em 0.9em; border-left: 5px solid {edge}; max-width: 50em; "
        f'line-height: 1.5">{content}</div>'
    )


def in_a_row(row: int) -> str:
    """Return how many were right in a row, in words.

    >>> in_a_row(3), in_a_row(12)
    ('three in a row', '12 in a row')
    """
    return f"{_IN_WORDS.get(row, row)} in a row"
