"""An answer of any type, read as a number; what is none is told so in a sentence."""

import cmath
import numbers
from collections.abc import Iterable, Mapping, Sized
from typing import Any

import numpy as np
import sympy

from cammotion.quantities import shorten
from cammotion.typed import readings, typed_numbers

_NO_IMAGINARY_PART = 1e-9  # what is left of one by rounding, as a share


class OddAnswerError(Exception):
    """An answer that is no answer to the question at all; the message says why."""


def to_number(answer: Any, wanted: str) -> float:
    """Return an answer as a float if it is one real, finite number, else raise OddAnswerError."""
    if isinstance(answer, str | bytes):
        meant = f": {' or '.join(typed)}" if (typed := typed_numbers(answer)) else ""
        raise OddAnswerError(f"This is a text. Write {wanted}, without quotes and unit{meant}.")
    if isinstance(answer, np.ndarray) and answer.ndim == 0:
        answer = answer.item()
    is_pair = isinstance(answer, tuple) and [type(part) for part in answer] == [int, int]
    if is_pair and answer[1] >= 0:
        meant = " or ".join(readings("{},{}".format(*answer)))
        raise OddAnswerError(
            f"Python takes a comma for two numbers. If you mean {meant}, write that, without the "
            f"comma. What is asked for is {wanted}."
        )
    if isinstance(answer, Iterable | Sized):
        has_places = hasattr(type(answer), "__getitem__") and not isinstance(answer, Mapping)
        raise OddAnswerError(
            f"This may hold several values (it is of type {type(answer).__name__}). What is asked "
            f"for is {wanted}: take it out{', for example with [0]' * has_places}."
        )
    symbols = sorted(map(str, getattr(answer, "free_symbols", ())))
    if symbols:
        raise OddAnswerError(
            f"There still is {', '.join(symbols)} in it. Put in the numbers, with subs."
        )
    is_number = isinstance(answer, numbers.Number | sympy.Expr)
    if not is_number or isinstance(answer, bool | np.bool_):
        raise OddAnswerError(f"{shorten(answer)} is no number. Write {wanted}.")
    try:
        value = complex(answer)
    except OverflowError:
        raise OddAnswerError(
            "This number is larger than any that a computer counts with."
        ) from None
    if not cmath.isfinite(value):
        raise OddAnswerError("This is not a finite number. Was something divided by zero?")
    if abs(value.imag) > _NO_IMAGINARY_PART * abs(value):
        raise OddAnswerError("This is a complex number. Is there a root of something negative?")
    return value.real


def number_or_none(answer: Any) -> float | None:
    """Return an answer as a number, None if it is none.

    >>> number_or_none(92), number_or_none("92")
    (92.0, None)
    """
    try:
        return to_number(answer, "one number")
    except Exception:  # an object may do anything when it is looked at
        return None
