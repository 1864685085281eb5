"""Controls for choices and predictions: with names, and with nothing chosen beforehand."""

from collections.abc import Callable
from html import escape
from typing import Any

import ipywidgets

from cammotion.teaching.exercise import ChoiceExercise
from cammotion.teaching.messages import Feedback


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
        self._said = ipywidgets.HTML()
        heading = f"<strong>Exercise {exercise.number}.</strong> {escape(question)}"
        self.buttons.observe(lambda _: self._answer(), "value")
        super().__init__([ipywidgets.HTML(heading), self.buttons, self._said])
        if self.answer:
            self._said.value = self._judge(self.answer).html

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
        number = self._exercise.number
        options = self._exercise.options.items()
        text = [f"Exercise {number}. {self._question}", *(f"({a}) {text}" for a, text in options)]
        items = "".join(f"<li>({letter}) {escape(text)}</li>" for letter, text in options)
        html = (
            f"<p><strong>Exercise {number}.</strong> {escape(self._question)}</p>"
            f'<ul style="list-style: none">{items}</ul>'
        )
        return bundle | {"text/plain": "\n".join(text), "text/html": html}


class PredictionControl(ipywidgets.HBox):  # type: ignore[misc]
    """A field for a prediction, empty at first; what is typed is kept and can be shown again."""

    def __init__(self, asked: str, kept: str, keep: Callable[[str], None]) -> None:
        self._asked = asked
        self.field = ipywidgets.Text(
            value=kept,
            placeholder="your prediction",
            description=f"I predict, {asked}:",
            style={"description_width": "initial"},
            layout={"width": "32em", "max_width": "100%"},
        )
        self.field.observe(lambda _: keep(self.prediction), "value")
        super().__init__([self.field])

    @property
    def prediction(self) -> str:
        """What was predicted, as it was typed; "" if nothing was."""
        return str(self.field.value).strip()

    @property
    def said(self) -> str:
        """A sentence for the reveal."""
        if not self.prediction:
            return "You made no prediction."
        return f"You predicted {self.prediction}."

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        bundle: dict[str, Any] = super()._repr_mimebundle_(**kwargs)
        shown = self.prediction or "run this cell, and type it here"
        return bundle | {"text/plain": f"I predict, {self._asked}: {shown}"}
