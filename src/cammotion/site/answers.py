"""What a page has to say to answers, packed: it stands in the page, but not to be read.

It is packed and not locked. Who looks for an answer can unpack it, as they can open the package.
"""

import base64
import gzip
from collections.abc import Iterable
from typing import Any

from cammotion.site.verdicts import table_of
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.exercise import ChoiceExercise, Exercise
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.prediction import Prediction
from cammotion.views.live.page import as_json

_HINT = 'cm.hint("{}") gives a hint.'
_DIGITS = 12


def packed_answers(
    exercises: Iterable[Exercise], predictions: Iterable[Prediction], machine: MillAndDie
) -> str:
    """Return what the exercises and predictions of a page say, packed; "" if it asks nothing."""
    said: dict[str, Any] = {one.number: _of_exercise(one, machine) for one in exercises}
    said |= {made.key: _of_prediction(made) for made in predictions}
    return pack(as_json({key: value for key, value in said.items() if value})) if said else ""


def pack(text: str) -> str:
    """Return a text as letters that cannot be read; the same each time."""
    return base64.b64encode(gzip.compress(text.encode(), mtime=0)).decode("ascii")


def _of_exercise(exercise: Exercise, machine: MillAndDie) -> dict[str, Any]:
    if isinstance(exercise, NumberExercise):
        table = table_of(exercise, machine)
        hint = _HINT.format(exercise.number)
        return {
            "off": _short(table.right),
            "edges": [*map(_short, table.edges)],
            "places": table.places,
            "said": [_in_page(text, hint) or f"Right. {exercise.right}" for text in table.said],
        }
    if isinstance(exercise, ChoiceExercise):
        reasons = {letter: f"Not yet. {text}" for letter, text in exercise.reasons.items()}
        return {"letters": reasons | {exercise.answer: f"Right. {exercise.right}"}}
    return {}


def _in_page(text: str, hint: str) -> str:
    """Return why a number is wrong as a page says it, where hints are not run but unfolded."""
    return f"Not yet. {text.replace(hint, 'hints are below.')}" if text else ""


def _of_prediction(made: Prediction) -> dict[str, Any]:
    if isinstance(made.true, str):
        return {}
    ends = {"low": made.low, "high": made.high, "near": made.near}
    place = {"isPlace": True} if made.is_place else {}
    return {"asked": made.asked, "true": [made.true, *made.also], **ends, **place}


def _short(number: float) -> float:
    return float(f"{number:.{_DIGITS}g}")
