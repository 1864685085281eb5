"""Which answers are shown: those that differ enough to be seen, and tell no right number."""

import math
import re
from collections.abc import Iterator

from cammotion.teaching.example import MillAndDie
from cammotion.teaching.shown.frame import Shown, Shows

_NEAREST = 0.01  # so near to the right answer nothing is to be seen
_FARTHEST = 1000.0
_ROUNDED = 0.012  # a number so near to the right one might be taken for it
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
_TEXT = re.compile(r"<text[^>]*>([^<]*)</text>")


def show_answer(
    shows: Shows, machine: MillAndDie, given: float, right: float, question: str
) -> Shown | None:
    """Return what an answer would do; None for an absurd one, and where nothing would be seen.

    Also None where the picture would hold the right number, though neither `question` nor the
    answer does.
    """
    ratio = given / right
    if not 1 / _FARTHEST < ratio < _FARTHEST or 0 < abs(ratio - 1) < _NEAREST:
        return None
    shown = shows(machine, given)
    if shown is None or given == right:
        return shown
    known = [given, *numbers_in(question)]
    told = [
        value
        for value in numbers_in(" ".join([shown.line, *_TEXT.findall(shown.svg)]))
        if math.isclose(value, right, rel_tol=_ROUNDED)
        and not any(math.isclose(value, other, rel_tol=_ROUNDED) for other in known)
    ]
    return None if told else shown


def numbers_in(text: str) -> Iterator[float]:
    """Yield the numbers that stand in a text, without their signs."""
    return map(float, _NUMBER.findall(text))
