"""How far an answer may be rounded: to the fewest digits that tell it from the known wrong ones."""

import math
from collections.abc import Iterable

FEWEST, MOST = 2, 4  # significant digits that a question asks for
MOST_OFF = 0.012  # by what share a number may be off that is rounded to so few
TYPED = 2e-4  # by what share a number may be off that was typed from a page
SAME = 1e-9  # what is so near is one number: a wrong way may lead to the right one
WHOLE = 1e-4  # what is left of a whole number of units in the last digit


def is_rounded(given: float, value: float, digits: int) -> bool:
    """Tell whether a number is a value rounded to significant digits; a half goes either way.

    >>> is_rounded(3.7, 3.719, digits=2), is_rounded(3.72, 3.719, digits=2)
    (True, False)
    >>> is_rounded(0.22, 0.225, digits=2), is_rounded(0.23, 0.225, digits=2)
    (True, True)
    """
    if not value or not math.isfinite(value):
        return False
    if abs(given - value) > abs(value) / 10 ** (digits - 1):  # most are, and by more than a unit
        return False
    unit = last_place(value, digits)
    is_whole = abs(given / unit - round(given / unit)) < WHOLE
    return is_whole and abs(given - value) <= (0.5 + SAME) * unit


def last_place(value: float, digits: int) -> float:
    """Return what 1 in the last of so many significant digits of a value, not 0, is worth."""
    return float(10.0 ** (math.floor(math.log10(abs(value))) + 1 - digits))


def digits_needed(right: float, wrong: Iterable[float]) -> int:
    """Return to how many digits, 2 to 4, an answer may be rounded.

    So rounded it is within 1.2 %, and no known wrong answer, one of `wrong`, is rounded to the
    same number. More than four are never asked for.

    >>> digits_needed(3.719, [1.36]), digits_needed(124.84, [70]), digits_needed(3.719, [3.722])
    (2, 3, 4)
    """
    enough = FEWEST if abs(_round(right, FEWEST) - right) <= MOST_OFF * abs(right) else FEWEST + 1
    alike = [
        digits
        for other in wrong
        for digits in range(FEWEST, MOST)
        if not is_same(right, other) and _are_alike(right, other, digits)
    ]
    return max(enough, 1 + max(alike, default=0))


def is_same(one: float, other: float) -> bool:
    """Tell whether two numbers are one, but for the last digits of a computer."""
    return math.isclose(one, other, rel_tol=SAME, abs_tol=1e-12)


def is_as_typed(given: float, value: float, digits: int = MOST) -> bool:
    """Tell whether a number is a value as one types it off: nearly all of it, or these digits.

    >>> is_as_typed(4.1541, 4.15411), is_as_typed(124.8, 124.84), is_as_typed(4.15, 4.15411)
    (True, True, False)
    """
    return math.isclose(given, value, rel_tol=TYPED) or is_rounded(given, value, digits)


def _are_alike(one: float, other: float, digits: int) -> bool:
    return is_rounded(_round(one, digits), other, digits) or is_rounded(
        _round(other, digits), one, digits
    )


def _round(value: float, digits: int) -> float:
    return float(f"{value:.{digits}g}")
