"""What the lessons let predict, and how far off a prediction is."""

import math
import re
from dataclasses import dataclass

_NUMBER = re.compile(
    r"(?<![\w.,^/*])(?P<value>[-+−]?\d+(?:[.,]\d+)?(?:e[-+]?\d+)?)"
    r"(?:\s*/\s*(?P<over>\d+(?:[.,]\d+)?))?(?P<percent>\s*%)?",
    re.IGNORECASE,
)
_LARGEST = 1e12  # beyond that it is a joke and no prediction
_CLOSE = 0.02
_IN_TIMES = 2  # nearer than that it is said in percent


@dataclass(frozen=True)
class Prediction:
    """A prediction of a lesson, as `cm.predict(key, asked)` asks for it, and what turns out true.

    `true` is a number in the unit that `asked` names, or a text where no single number is asked
    for. What is as right as `true` is in `also`, and `why` one guesses otherwise is a word for the
    reveal: it stands here and not in the notebook's cell, where it would be read too soon. All of
    them are about the machine of the lessons, with the same numbers for everybody.
    """

    key: str
    asked: str
    true: float | str
    why: str = ""
    also: tuple[float, ...] = ()

    def how_far(self, text: str) -> str:
        """Say how far off a typed prediction is, "" where that is not one number beside another.

        >>> made = Prediction("01.half", "degrees for each way", 92.5)
        >>> made.how_far("about 110"), made.how_far("30"), made.how_far("92"), made.how_far("few")
        ('19 % too much', '3.1 times too little', 'as good as right', '')
        """
        number = None if isinstance(self.true, str) else number_in(text, self.asked)
        if number is None or isinstance(self.true, str):
            return ""
        if number <= 0:
            return "too little"
        ratio = number / self.true
        if any(abs(number / right - 1) <= _CLOSE for right in (self.true, *self.also)):
            return "as good as right"
        too = "too much" if ratio > 1 else "too little"
        times = max(ratio, 1 / ratio)
        if times < _IN_TIMES:
            return f"{100 * abs(ratio - 1):.0f} % {too}"
        return f"{times:.2g} times {too}"


def number_in(text: str, asked: str) -> float | None:
    """Return the number that a typed prediction is, None if it is none or more than one.

    A comma may stand for the point, a fraction for its value; units and words may stand around it.
    A share in percent is made a number where percent are not what is asked for.

    >>> number_in("about 1,04 m/s2", "m/s²"), number_in("1/4 of tm", "fraction")
    (1.04, 0.25)
    >>> number_in("25 %", "percent"), number_in("25 %", "fraction"), number_in("50 or 60", "deg")
    (25.0, 0.25, None)
    """
    found = [*_NUMBER.finditer(text)]
    if len(found) != 1:
        return None
    value, over = (_read(found[0][name]) for name in ("value", "over"))
    if value is None or over == 0:
        return None
    value /= over or 1
    if found[0]["percent"] and "percent" not in asked:
        value /= 100
    return value if math.isfinite(value) and abs(value) <= _LARGEST else None


def _read(digits: str | None) -> float | None:
    return float(digits.replace(",", ".").replace("−", "-")) if digits else None
