"""What is filled in on a page: an exercise, a prediction, and the reveal that waits for it."""

from collections.abc import Callable
from html import escape

from bs4 import BeautifulSoup

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Exercise
from cammotion.teaching.number_exercise import NumberExercise

Render = Callable[[str], str]
# Where no script has come yet, Enter loads nothing, and what was typed stays
_FORM = 'method="dialog" autocomplete="off"'
_SAID = '<p class="said" role="status"></p>'
_ELSEWHERE = (
    "What is asked for is {}. Such an answer needs Python: write it in the workbook, which checks "
    "it there."
)
_NUMBERS, _LETTERS = "decimal", "text"  # the keys that a telephone shows
_FOLDED = "Show the answer (you made no prediction yet)"


def exercise_form(exercise: Exercise, machine: MillAndDie, render: Render) -> str:
    """Return the form of an exercise, with its question and its hints; `render` is of Markdown."""
    name = escape(exercise.number)
    question = render(f"**Exercise {name}.** {exercise.question(machine)}")
    fields = _fields(exercise, machine, render)
    return (
        f'<form class="exercise" id="exercise-{name}" data-exercise="{name}" {_FORM} '
        f'aria-label="Exercise {name}">{question}{fields}{_SAID}{_hints(exercise, render)}</form>'
    )


def _fields(exercise: Exercise, machine: MillAndDie, render: Render) -> str:
    if isinstance(exercise, NumberExercise):
        asked = exercise.wanted_for(machine)
        return _text_field(f"answer-{exercise.number}", asked, "Check", _NUMBERS)
    if isinstance(exercise, ChoiceExercise):
        options = "".join(
            f'<label><input type="radio" name="choice" value="{letter}"> '
            f"<span>({letter}) {_inline(render(text))}</span></label>"
            for letter, text in exercise.options.items()
        )
        return f"<fieldset><legend>Your choice</legend>{options}</fieldset>"
    return f"<p><em>{escape(_ELSEWHERE.format(exercise.wanted))}</em></p>"


def _text_field(name: str, asked: str, button: str, keys: str) -> str:
    label = asked[0].upper() + asked[1:]
    return (
        f'<p class="field"><label for="{name}">{escape(label)}</label> '
        f'<input id="{name}" type="text" inputmode="{keys}" maxlength="200"> '
        f'<button type="submit">{button}</button></p>'
    )


def _hints(exercise: Exercise, render: Render) -> str:
    """Return the hints, each folded in the one before."""
    inner = ""
    for step, hint in reversed([*enumerate(exercise.hints, 1)]):
        inner = f"<details><summary>Hint {step}</summary>{render(hint)}{inner}</details>"
    return f'<div class="hints">{inner}</div>'


def prediction_form(key: str, asked: str, *, is_number: bool) -> str:
    """Return the form of a prediction, a number or words."""
    name = escape(key)
    keys = _NUMBERS if is_number else _LETTERS
    field = _text_field(f"prediction-{name}", f"I predict, {asked}", "Predict", keys)
    return (
        f'<form class="prediction" data-predicts="{name}" {_FORM} '
        f'aria-label="Prediction {name}">'
        f"{field}{_SAID}</form>"
    )


def reveal(stored: str, key: str) -> str:
    """Return a stored reveal, folded, for the prediction of that key."""
    output = BeautifulSoup(stored, "html.parser")
    paragraphs = "".join(f"<p>{escape(p.get_text())}</p>" for p in output.select("details p"))
    return (
        f'<div class="reveal" data-reveals="{escape(key)}">{_SAID}'
        f"<details><summary>{_FOLDED}</summary>{paragraphs}</details></div>"
    )


def _inline(html: str) -> str:
    """Return a rendered line without its paragraph."""
    return html.strip().removeprefix("<p>").removesuffix("</p>")
