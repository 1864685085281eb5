"""What the lessons let predict, and how far off a prediction is."""

import re
import unicodedata
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache

from cammotion.quantities import shorten
from cammotion.teaching import prediction_words as words
from cammotion.typed import readings

_NUMBER, _REMARK, _COUNTED = map(re.compile, (words.NUMBER, words.REMARK, words.COUNTED))
_WORD, _PART = map(re.compile, (words.WORD, words.PART))
_PLAIN, _NOT_OWN, _TELLING = (
    {*listed.split()} for listed in (words.PLAIN, words.NOT_OWN, words.TELLING)
)
_LARGEST = 1e12  # beyond that, or below its inverse, it is a joke and no prediction
_SENSIBLE = 999.0
_CLOSE = 0.02
_IN_TIMES = 1.95  # rounded it is 2; nearer than that it is said in percent


@dataclass(frozen=True)
class Prediction:
    """A prediction of a lesson, as `cm.predict(key, asked)` asks for it, and what turns out true.

    `true` is a number in the unit that `asked` names, or a text where no single number is asked
    for. What is as right as `true` is in `also`, and `why` one guesses otherwise is a word for the
    reveal: it stands here and not in the notebook's cell, where it would be read too soon. All of
    them are about the machine of the lessons, with the same numbers for everybody. Sensible
    predictions lie from `low` to `high`: this tells what a comma before three digits means, and
    what is below `low` is not meant so, and not read. As good as right is what is off by no more
    than the share `near`. Of a place in an order, `is_place`, it is said how many places it is
    off, and not how many times.
    """

    key: str
    asked: str
    true: float | str
    why: str = ""
    also: tuple[float, ...] = ()
    low: float = 0.0
    high: float = _SENSIBLE
    near: float = _CLOSE
    is_place: bool = False

    def numbers(self, text: str) -> tuple[float, ...]:
        """Return the numbers that a typed prediction may be: one, none, or two that make sense.

        >>> Prediction("02.peak", "m/s²", 1.039).numbers("1,039")
        (1.039,)
        >>> Prediction("-", "pieces/h", 2000.0, high=5000).numbers("2,400")
        (2.4, 2400.0)
        """
        found = tuple(one for one in numbers_in(text, self.asked) if abs(one) >= self.low)
        return tuple(number for number in found if abs(number) <= self.high) or found

    def unclear(self, text: str) -> str:
        """Say what a typed prediction may be, "" unless that is more than one number.

        >>> Prediction("-", "pieces/h", 2000.0, high=5000).unclear("2,400")
        '“2,400” may be 2.4 or 2400: write it with a point, or with no mark.'
        """
        numbers = () if isinstance(self.true, str) else self.numbers(text)
        said = " or ".join(f"{number:.12g}" for number in numbers)
        return (
            f"“{shorten(text, of=str)}” may be {said}: write it with a point, or with no mark."
            if len(numbers) > 1
            else ""
        )

    def how_far(self, text: str) -> str:
        """Say how far off a typed prediction is, "" where that is not one number beside another.

        >>> made = Prediction("01.half", "degrees for each way", 92.5)
        >>> made.how_far("about 110"), made.how_far("30"), made.how_far("92"), made.how_far("few")
        ('19 % too much', '3.1 times too little', 'as good as right', '')
        """
        numbers = self.numbers(text)
        if isinstance(self.true, str) or len(numbers) != 1:
            return ""
        (number,) = numbers
        if self.is_place:
            off = abs(number - self.true)
            return f"{off:g} place{'s' * (off != 1)} off" if off else "as good as right"
        if number == 0:
            return "too little"
        rights = (self.true, *self.also)
        is_close = any(abs(abs(number) / right - 1) <= self.near for right in rights)
        if number < 0:
            return "right but for its sign" if is_close else "of the wrong sign"
        if is_close:
            return "as good as right"
        may_be_share = "percent" in self.asked and "%" not in _plainly(text)
        return _off(number / self.true, may_be_share=may_be_share)


def _off(ratio: float, *, may_be_share: bool) -> str:
    """Say how far off a number is that is so many times what is true."""
    too = "too much" if ratio > 1 else "too little"
    times = max(ratio, 1 / ratio)
    if times < _IN_TIMES:
        return f"{100 * abs(ratio - 1):.0f} % {too}"
    if may_be_share and abs(100 * ratio - 1) <= _CLOSE:
        return "right, if it is a share (in percent it is a hundred times that)"
    return f"{float(f'{times:.2g}'):.15g} times {too}"


def numbers_in(text: str, asked: str) -> tuple[float, ...]:
    """Return the number that a typed prediction is, both if it may be two, none if it is no number.

    A comma may stand for the point, a fraction for its value. One comma before three digits may
    also part thousands, and a blank does. A share in percent is made a number where a fraction is
    asked for, and a fraction percent where those are. Beside the number may stand its unit and
    words that are known to say nothing more; with any other, as another unit, what is to be
    reckoned out, or no more than "less than", it is no number.

    >>> numbers_in("about 1,04 m/s2", "m/s²"), numbers_in("1/4 of tm", "fraction of the time tm")
    ((1.04,), (0.25,))
    >>> numbers_in("25 %", "percent"), numbers_in("25 %", "fraction"), numbers_in("50 or 60", "deg")
    ((25.0,), (0.25,), ())
    >>> numbers_in("10^0.667", "times"), numbers_in("64 per minute", "pieces per hour")
    ((), ())
    >>> numbers_in("2x", "times"), numbers_in("2x", "m/s²"), numbers_in("1/4 of it", "m/s²")
    ((2.0,), (), ())
    >>> numbers_in("4,154 m/s²", "m/s²"), numbers_in("0,806", "m/s²"), numbers_in("4.154", "m/s²")
    ((4.154, 4154.0), (0.806,), (4.154,))
    >>> numbers_in("4 500", "pieces per hour"), numbers_in("4.500", "pieces per hour")
    ((4500.0,), (4500.0,))
    >>> numbers_in("16 % less", "percent less"), numbers_in(".5", "mm"), numbers_in("5 in", "mm")
    ((16.0,), (0.5,), ())
    """
    question, said = _plainly(asked), _plainly(text)
    said = _written(said, (row for asks, *row in words.WHERE_ASKED if re.search(asks, question)))
    found = [*_NUMBER.finditer(said)]
    if len(found) != 1 or not _is_known(said, found[0].span(), question):
        return ()
    whole, value, over = found[0].groups()
    is_change = "%" in said and "%" not in question and value.startswith("-")
    if is_change or (over and _COUNTED.search(question)):
        return ()
    parts = _parts(question, said, is_fraction=bool(over and not whole))
    numbers = (
        (float(whole or 0) + a / b) / parts
        for a in _readings(value)
        for b in _readings(over or "1")
        if b != 0
    )
    return tuple(one for one in numbers if _is_believed(one, question))


def _parts(question: str, said: str, *, is_fraction: bool) -> float:
    """Return by what a number is divided, so that a share is in the unit that is asked for."""
    if "%" not in question:
        return 100.0 if "%" in said else 1.0
    return 0.01 if is_fraction and "%" not in said else 1.0


def _is_believed(number: float, question: str) -> bool:
    if _COUNTED.search(question) and number % 1 != 0:
        return False
    return number == 0 or 1 / _LARGEST <= abs(number) <= _LARGEST


@lru_cache
def _plainly(text: str) -> str:
    """Return a text in small letters, with what may be written in many ways in one of them."""
    made_plain = unicodedata.normalize("NFKC", _written(text, words.SIGNS).lower())
    return _written(made_plain, words.PLAINLY)


def _written(text: str, rows: Iterable[Sequence[str]]) -> str:
    for pattern, plain in rows:
        text = re.sub(pattern, plain.replace("$", "\\"), text)
    return text


def _is_known(said: str, number: tuple[int, int], question: str) -> bool:
    """Tell whether what stands beside a number says nothing else than what is asked."""
    start, end = number
    remark = _REMARK.search(said, end)
    behind = said[end : remark.start() if remark else None]
    telling = _TELLING.intersection(_PART.findall(remark[0])) if remark else set()
    own = {*_WORD.findall(question)} - _NOT_OWN
    known = own.union(_PLAIN, _known_where(words.BESIDE, question))
    known_behind = known | _known_where(words.BEHIND, question)
    return known.issuperset(_PART.findall(said[:start])) and known_behind.issuperset(
        [*_PART.findall(behind), *telling]
    )


def _known_where(rows: Iterable[Sequence[str]], question: str) -> set[str]:
    return {word for asks, known in rows if re.search(asks, question) for word in known.split()}


def _readings(digits: str) -> tuple[float, ...]:
    return tuple(float(reading) for reading in readings(digits))
