"""Controls for choices and predictions, and reveals that wait for a prediction."""

from collections.abc import Callable, Sequence
from html import escape
from typing import Any

import ipywidgets

from cammotion.teaching.exercise import ChoiceExercise
from cammotion.teaching.messages import Feedback, box
from cammotion.teaching.prediction import Prediction

# A line of its own above the field, which wraps on a narrow page.
_LABEL = '<span style="display: block; white-space: normal; text-align: left">I predict, {}:</span>'


class ChoiceControl(ipywidgets.VBox):  # type: ignore[misc]
    """The options of an exercise; each choice is answered at once, with its reason.

    `answer` is the letter that is chosen, None if there is none.
    """

    def __init__(
        self,
        exercise: ChoiceExercise,
        question: str,
        chosen: str | None,
        judge: Callable[[str], Feedback],
    ) -> None:
        self._exercise, self._judge = exercise, judge
        options = [(f"({letter}) {text}", letter) for letter, text in exercise.options.items()]
        # Not radio buttons: JupyterLab takes the arrow keys away from them.
        self.buttons = ipywidgets.ToggleButtons(
            options=options,
            value=chosen,
            description="Your choice:",
            style={"button_width": "auto", "description_width": "initial"},
        )
        self._question = question
        self._heading = f"<strong>Exercise {exercise.number}.</strong> {escape(question)}"
        self._said = ipywidgets.HTML()
        self.buttons.observe(lambda _: self._answer(), "value")
        super().__init__([ipywidgets.HTML(self._heading), self.buttons, self._said])
        self._answer()

    @property
    def answer(self) -> str | None:
        """The chosen letter."""
        return self.buttons.value  # type: ignore[no-any-return]

    def _answer(self) -> None:
        if self.answer:
            self._said.value = self._judge(self.answer).html

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        """Show question and options beside the widget, for a reader without a kernel."""
        bundle: dict[str, Any] = super()._repr_mimebundle_(**kwargs)
        options = [f"({letter}) {text}" for letter, text in self._exercise.options.items()]
        text = [f"Exercise {self._exercise.number}. {self._question}", *options]
        items = "".join(f"<li>{escape(option)}</li>" for option in options)
        html = f'<p>{self._heading}</p><ul style="list-style: none">{items}</ul>'
        return bundle | {"text/plain": "\n".join(text), "text/html": html}


class PredictionControl(ipywidgets.HBox):  # type: ignore[misc]
    """A field for a prediction, empty at first; what is typed is kept and can be shown again.

    It counts when the field is left or Enter is pressed, so that no half of a number does.
    """

    def __init__(
        self,
        asked: str,
        kept: str,
        keep: Callable[[str], None],
        made: Prediction | None = None,
    ) -> None:
        self._asked, self._made = asked, made
        self.field = ipywidgets.Text(
            value=kept,
            placeholder="your prediction",
            description=_LABEL.format(escape(asked)),
            description_allow_html=True,
            continuous_update=False,
            style={"description_width": "100%"},
            layout={
                "width": "32em",
                "max_width": "100%",
                "height": "auto",
                "flex_flow": "row wrap",
            },
        )
        self._asks = ipywidgets.HTML()
        self.field.observe(lambda _: keep(self.prediction), "value")
        self.field.observe(lambda _: self._ask(), "value")
        self._ask()
        super().__init__([self.field, self._asks], layout={"flex_flow": "row wrap"})

    @property
    def prediction(self) -> str:
        """What was predicted, as it was typed; "" if nothing was."""
        return str(self.field.value).strip()

    @property
    def unclear(self) -> str:
        """What is asked about a prediction that may be two numbers, "" about any other."""
        return self._made.unclear(self.prediction) if self._made else ""

    @property
    def is_made(self) -> bool:
        """Whether there is a prediction, and it is clear."""
        return bool(self.prediction) and not self.unclear

    def _ask(self) -> None:
        self._asks.value = f'<span role="alert">{escape(self.unclear)}</span>'

    @property
    def said(self) -> str:
        """A sentence for the reveal."""
        if not self.prediction:
            return "You made no prediction."
        return f"You predicted {self.prediction}."

    @property
    def said_how_far(self) -> str:
        """The sentence with a word on how far off the prediction is, if there is one to say."""
        far = self._made and self.prediction and self._made.how_far(self.prediction)
        return f"You predicted {self.prediction}: {far}." if far else self.said

    def reveal(self, *sentences: str) -> "Reveal":
        """Return the answer, folded while there is no prediction, and open as soon as there is.

        Each of `sentences` becomes a paragraph. Why one guesses otherwise follows by itself, where
        the lesson knows it.

        >>> guess = PredictionControl("degrees", "", print)
        >>> guess.reveal("It is 92.5.")
        The answer is folded: you made no prediction yet.
        >>> guess.field.value = "110"
        110
        >>> guess.reveal("It is 92.5.")
        You predicted 110.
        It is 92.5.
        """
        why = [self._made.why] if self._made and self._made.why else []
        return Reveal(self, [*sentences, *why])

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        bundle: dict[str, Any] = super()._repr_mimebundle_(**kwargs)
        shown = self.prediction or "run this cell, and type it here"
        return bundle | {"text/plain": f"I predict, {self._asked}: {shown}"}


class Reveal(ipywidgets.HTML):  # type: ignore[misc]
    """The answer to a prediction: folded without one, open with one, also one made later."""

    def __init__(self, guess: PredictionControl, sentences: Sequence[str]) -> None:
        self._guess, self._sentences = guess, [str(sentence) for sentence in sentences]
        super().__init__(self.html)
        guess.field.observe(lambda _: self.set_trait("value", self.html), "value")

    @property
    def text(self) -> str:
        """The plain text; while the answer is folded it does not say it."""
        if not self._guess.is_made:
            return f"The answer is folded: {self._still}"
        return "\n".join([self._guess.said_how_far, *self._sentences])

    @property
    def html(self) -> str:
        """The HTML."""
        answer = "".join(f"<p>{escape(sentence)}</p>" for sentence in self._sentences)
        if self._guess.is_made:
            said = f"<strong>{escape(self._guess.said_how_far)}</strong>"
            return box(
                "open", f"{said}<details open><summary>The answer</summary>{answer}</details>"
            )
        summary = escape(f"Show the answer ({self._still.rstrip('.')})")
        return box("open", f"<details><summary>{summary}</summary>{answer}</details>")

    @property
    def _still(self) -> str:
        """What is still to be done."""
        return self._guess.unclear or "you made no prediction yet."

    def __repr__(self) -> str:
        return self.text

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        bundle: dict[str, Any] = super()._repr_mimebundle_(**kwargs)
        return bundle | {"text/plain": self.text, "text/html": self.html}
