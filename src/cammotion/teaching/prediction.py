"""What the lessons let predict, and how far off a prediction is."""

import re
from dataclasses import dataclass

from cammotion.quantities import shorten
from cammotion.typed import readings

_DIGITS = r"(?:\d+(?:[.,]\d+)?|\.\d+)"
_LETTER = r"[a-zµμ\u00c0-\u024f]"
_SHARE = re.compile(r"%|per ?cent|prozent", re.IGNORECASE)
_NUMBER = re.compile(
    rf"(?<![\w.,^/*])(?P<value>[-+−]?{_DIGITS}(?:e[-+]?\d+)?)"
    rf"(?:\s*/\s*(?P<over>{_DIGITS}))?(?![.,]?\d|\s*/\s*\d)",
    re.IGNORECASE,
)
_PART_WORDS = r"half|halves|thirds?|quarters?|(?:four|fif|six|seven|eigh|nin|ten)ths?"
_UNSURE = re.compile(
    rf"""
    (?<!/s)\^ | (?<!/s)(?<!/s\*)\*                      # but for the square of a second
    | [√×·=<>≤≥π] | (?<!{_LETTER})pi(?!{_LETTER})       # what is to be reckoned out
    | \b(?:at\ (?:least|most)|sqrt|root|less|more|below|above|least|most|than|minimum|times)\b
    | \b(?:{_PART_WORDS}|twice)\s+(?:(?:of|the|about)\s+)*(?=[-+−]?\.?\d)         # half of 4.154
    | (?:\d\s*|\band\s+an?\s+)(?:{_PART_WORDS})\b            # 2 thirds, 2 and a half
    """,
    re.IGNORECASE | re.VERBOSE,
)
_PLAIN = [  # what is written otherwise before a text is read
    (re.compile(r"^\s*['\u2018](.*)['\u2019]\s*$"), r"\1"),  # 'in quotes'
    (re.compile(r"(?<![\d.,])(\d{1,3})[ \u00a0\u202f](\d{3})(?![.,]?\d)"), r"\1\2"),  # 4 500
    (re.compile(r"(?<=\d)\s*½"), ".5"),
    (re.compile(r"(?<=\d)\s*¼"), ".25"),
    (re.compile(r"(?<=\d)\s*¾"), ".75"),
    (re.compile(rf"\s*(?:[x×*·]|times)\s*tm(?!{_LETTER})", re.IGNORECASE), " tm"),
    (re.compile(r"(?<=\d)\s*[x×](?!\w)", re.IGNORECASE), " times"),  # 2x
]
_PART = re.compile(r"(?P<count>(?<![\d.,/])\d+\s*of\b)|\d\s*of\b", re.IGNORECASE)  # 0.9 of it
_CHANGE = re.compile(  # 10 % lower: a share of what is to be told, and not what is left of it
    r"[-+−]\s*\.?\d|\b(?:lower|smaller|higher|larger|greater|bigger|better|worse)\b"
    r"|\b(?:off|under|over|by|minus|plus)\b",
    re.IGNORECASE,
)
_UNITS = {
    "m": r"m|met(?:er|re)s?",
    "cm": r"cm",
    "mm": r"mm",
    "um": r"[µμu]m|microns?",
    "inch": rf"inch(?:es)?|in(?!\s+{_LETTER})",  # 92 in each direction
    "rad": r"rad(?:ians?)?",
    "deg": r"deg(?:rees?)?|°",
    "min": r"min(?:utes?|s)?|rpm|['\u2032\u2019]",
    "s": r"s|sec(?:onds?|s)?",
    "g": r"g",
    "k": r"k|thousand",
}
_UNIT = re.compile(  # a short one only at a number, at a stroke or after "per"
    rf"(?:\d\s*|/\s*|\bper\s+|(?<!{_LETTER})(?={_LETTER}+\s*/|(?!in\b){_LETTER}{{2}}))"
    rf"(?:{'|'.join(f'(?P<{name}>{words})' for name, words in _UNITS.items())})(?!{_LETTER})",
    re.IGNORECASE,
)
_TIMES_THE = "times the"
_SHARES = ("percent", "fraction", _TIMES_THE)
_WHOLE = "out of"
_WHOLES = (_WHOLE, "place,")  # here a stroke parts what is asked for from all there are
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
    predictions lie from `low` to `high`: this tells what a comma before three digits means. Of a
    place in an order, `is_place`, it is said how many places it is off, and not how many times.
    """

    key: str
    asked: str
    true: float | str
    why: str = ""
    also: tuple[float, ...] = ()
    low: float = 0.0
    high: float = _SENSIBLE
    is_place: bool = False

    def numbers(self, text: str) -> tuple[float, ...]:
        """Return the numbers that a typed prediction may be: one, none, or two that make sense.

        >>> Prediction("02.peak", "m/s²", 1.039).numbers("1,039")
        (1.039,)
        >>> Prediction("-", "pieces/h", 2000.0, high=5000).numbers("2,400")
        (2.4, 2400.0)
        """
        found = numbers_in(text, self.asked)
        return tuple(number for number in found if self.low <= abs(number) <= self.high) or found

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
        is_close = any(abs(abs(number) / right - 1) <= _CLOSE for right in (self.true, *self.also))
        if number < 0:
            return "right but for its sign" if is_close else "of the wrong sign"
        if is_close:
            return "as good as right"
        may_be_share = "percent" in self.asked and not _is_share(text)
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

    A comma may stand for the point, a fraction for its value; units and words may stand around it.
    One comma before three digits may also part thousands, and a blank does. A share in percent is
    made a number where a fraction is asked for, and a fraction percent where those are. What is to
    be reckoned out, is a part or a multiple of something that is not asked for, has another unit,
    or says no more than "less than" is no number.

    >>> numbers_in("about 1,04 m/s2", "m/s²"), numbers_in("1/4 of tm", "fraction")
    ((1.04,), (0.25,))
    >>> numbers_in("25 %", "percent"), numbers_in("25 %", "fraction"), numbers_in("50 or 60", "deg")
    ((25.0,), (0.25,), ())
    >>> numbers_in("10^0.667", "times"), numbers_in("64 per minute", "pieces per hour")
    ((), ())
    >>> numbers_in("2x", "times"), numbers_in("2x", "m/s²"), numbers_in("1/4 of it", "m/s²")
    ((2.0,), (), ())
    >>> numbers_in("4,154 m/s²", "m/s²"), numbers_in("0,806", "m/s²"), numbers_in("4.154", "m/s²")
    ((4.154, 4154.0), (0.806,), (4.154,))
    >>> numbers_in("4 500", "pieces per hour"), numbers_in("0.1 g", "m/s²")
    ((4500.0,), ())
    >>> numbers_in("16 % less", "percent less"), numbers_in(".5", "mm"), numbers_in("5 in", "mm")
    ((16.0,), (0.5,), ())
    """
    for written, plain in _PLAIN:
        text = written.sub(plain, text)
    found = [*_NUMBER.finditer(text)]
    if len(found) != 1 or not _is_one_number(text, asked):
        return ()
    value, over = found[0]["value"], found[0]["over"] or "1"
    in_percent = "percent" in asked
    if _is_share(text):
        parts = 1.0 if in_percent else 100.0
    else:
        parts = 0.01 if found[0]["over"] and in_percent else 1.0
    numbers = [a / b / parts for a in _readings(value) for b in _readings(over) if b != 0]
    return tuple(one for one in numbers if one == 0 or 1 / _LARGEST <= abs(one) <= _LARGEST)


def _is_one_number(text: str, asked: str) -> bool:
    """Tell whether all that is typed is a number in the unit that is asked for."""
    if "/" in text and any(whole in asked for whole in _WHOLES):
        return False
    is_other = _is_part(text, asked) or _is_unsure(text, asked)
    return not (is_other or (asked and _units(text) - _units(asked)))


def _is_part(text: str, asked: str) -> bool:
    """Tell whether a text is a part of something that is not typed, but for a part that is asked.

    Of what is so many times something, a share is one, unless it is by how much that changes. So
    many of them are no part where it is asked how many.
    """
    if any(share in asked for share in _SHARES):
        return _TIMES_THE in asked and _is_share(text) and bool(_CHANGE.search(text))
    parts = (found for found in _PART.finditer(text) if not (found["count"] and _WHOLE in asked))
    return _is_share(text) or any(parts)


def _is_unsure(text: str, asked: str) -> bool:
    """Tell whether a text has a sign or a word that makes its number none, but for those asked.

    Where nothing says what is asked, times may be.
    """
    return any(found[0].lower() not in (asked or "times") for found in _UNSURE.finditer(text))


def _units(text: str) -> set[str | None]:
    return {found.lastgroup for found in _UNIT.finditer(text)}


def _is_share(text: str) -> bool:
    return bool(_SHARE.search(text))


def _readings(digits: str) -> tuple[float, ...]:
    return tuple(float(reading) for reading in readings(digits.replace("−", "-")))
