"""Why an answer is wrong: ratios that betray what has happened, and short names of reasons."""

import hashlib
import math
import re
from collections.abc import Iterable, Mapping

COMMON_RATIOS: Mapping[float, str] = {
    -1.0: "The size is right, but not the sign.",
    2 * math.pi: "This is 2 pi times too large. There is a factor 2 pi too many.",
    1 / (2 * math.pi): "This is 2 pi times too small. Has the factor 2 pi been lost?",
    math.pi: "This is pi times too large. There is a factor pi too many.",
    1 / math.pi: "This is pi times too small. Has a factor pi been lost?",
    2.0: "This is twice as much as it should be. Is there a factor 2 too many?",
    1 / 2: "This is half of what it should be. Is there a factor 2 missing?",
    4.0: (
        "This is four times as much as it should be. Was twice the right number squared on the "
        "way, or half of it where it divides?"
    ),
    1 / 4: (
        "This is a quarter of what it should be. Was half the right number squared on the way, or "
        "twice of it where it divides?"
    ),
    1e6: "This is a million times too large. Are mm, or ms, squared on the way?",
    1e-6: "This is a million times too small. Are mm, or ms, squared on the way?",
    math.pi
    / 180: "This is 180/pi times too small: degrees were made radians, but the formula counts in "
    "degrees.",
    180 / math.pi: "This is 180/pi times too large: degrees and radians are mixed.",
}
"""Ratios of an answer to the right one, and what has usually happened where one is met."""

RATIOS_OF_SUMS = {ratio: COMMON_RATIOS[ratio] for ratio in (-1.0, 2.0, 1 / 2, math.pi / 180)}
"""Those that may be met in a sum of degrees, which has neither a factor pi nor squares in it."""

_HUNDREDFOLD = (
    "This is a hundred times too large. Was a 10 lost that counts twice, as that of tm = 10 B/N? "
    "Or is a length in cm where metres belong?"
)
_TOO_FAST: Mapping[float, str] = {
    3600.0: (
        "This is 3600 times too large, 60 squared. Were pieces per hour taken for pieces per "
        "minute, or is the time in minutes?"
    ),
    3600.0**2: (
        "This is 3600 squared times too large. Were pieces per hour taken for pieces per second, "
        "or is the time in hours?"
    ),
}
_TIMES: Mapping[float, str] = {
    3600.0: "This is 3600 times too large. Was an hour made seconds twice?",
    1 / 3600: (
        "This is 3600 times too small: the time in hours, or pieces per hour taken for pieces per "
        "second."
    ),
    1 / 10: (
        "This is a tenth of what it should be. An hour has 3600 seconds and a turn 360 degrees, "
        "which makes a factor 10."
    ),
    60.0: "This is 60 times too large. An hour has 60 minutes, and 3600 seconds.",
    1 / 60: (
        "This is 60 times too small: the time in minutes, or pieces per hour taken for pieces per "
        "minute."
    ),
}
UNIT_RATIOS: Mapping[str, Mapping[float, str]] = {
    "": {
        100.0: "This is a hundred times too large. Is it in percent?",
        1000.0: "This is a thousand times too large. Is one length in mm, the other in metres?",
        1 / 1000: "This is a thousand times too small. Is one length in mm, the other in metres?",
    },
    "%": {1 / 100: "This is a share. In percent it is a hundred times that."},
    "deg": {1 / 360: "This is a part of a turn. Multiply it by the 360 degrees of a turn."},
    "m/s²": {
        1000.0: "This is a thousand times too large. Is a length in mm where metres belong?",
        1 / 1000: "This is a thousand times too small. Was a length divided by 1000 twice?",
        100.0: _HUNDREDFOLD,
        **_TOO_FAST,
    },
    "mm": {
        1000.0: "This is a thousand times too large. Was a length taken for metres?",
        1 / 1000: "This is a thousand times too small: it is in metres. mm are asked for.",
        1 / 10: "This is a tenth of what it should be: it is in cm. mm are asked for.",
    },
    "µm": {
        1000.0: "This is a thousand times too large: it is in nm. Micrometres are asked for.",
        1 / 1000: "This is in mm. Micrometres are asked for.",
        1e-6: "This is a million times too small: it is in metres. Micrometres are asked for.",
    },
    "N/mm": {1000.0: "This is in N/m. It is asked for in N/mm."},
    "Hz": {60.0: "This is in swings a minute. A hertz is one in a second."},
    "pieces/h": {
        1 / 60: "This is in pieces a minute. It is asked for by the hour.",
        1 / 3600: "This is in pieces a second. It is asked for by the hour.",
    },
    "ms": {**_TIMES, 1 / 1000: "This is in seconds. Milliseconds are asked for."},
    "N": {
        1000.0: "This is a thousand times too large. Is a length in mm where metres belong, or a "
        "mass in grams?",
        1 / 1000: "This is a thousand times too small: it is in kN. Newtons are asked for.",
        100.0: _HUNDREDFOLD,
        **_TOO_FAST,
    },
    "s": {**_TIMES, 1000.0: "This is in milliseconds. Seconds are asked for."},
    "N m": {
        1000.0: "This is a thousand times too large: it is in N mm. N m are asked for.",
        1 / 1000: "This is a thousand times too small: it is in kN m. N m are asked for.",
        100.0: "This is a hundred times too large: it is in N cm. N m are asked for.",
    },
    "kg m²": {
        1e4: "This is ten thousand times too large: it is in kg cm². kg m² are asked for.",
        1000.0: "This is a thousand times too large. Is a mass in grams?",
    },
}
"""Ratios by the unit of the answer: a thousand is mm for m in a length, and ms in a time."""

NO_ANSWER = "no-answer"
"""The short name of all reasons that speak of what is no answer to the question at all."""
_MEASURED = re.compile(r"\S+ (?=%|times what it|from \d\d\.\d, which)")
_WORDS = 4
_SEVERAL, _OR = "More than one way leads to this number. ", " Or: "


def in_one(reasons: Iterable[str]) -> str:
    """Return reasons that a number may have as one: none of them is claimed if there are several.

    >>> in_one(["The time enters only once.", "This is the velocity."])
    'More than one way leads to this number. The time enters only once. Or: This is the velocity.'
    >>> in_one(["The time enters only once."])
    'The time enters only once.'
    """
    each = [*dict.fromkeys(part for reason in reasons for part in those_in(reason))]
    return (_SEVERAL if len(each) > 1 else "") + _OR.join(each)


def those_in(reason: str) -> list[str]:
    """Return the reasons that were made one.

    >>> those_in(in_one(["It is.", "So it is."])), those_in("It is.")
    (['It is.', 'So it is.'], ['It is.'])
    """
    return reason.removeprefix(_SEVERAL).split(_OR)


def short_name(reason: str) -> str:
    """Return the name under which a reason is counted: its first words, and four signs of the rest.

    What was measured, a percentage or a factor, is no part of it, nor is what was given before. Of
    several reasons in one it is the name of the first.

    >>> short_name("Close, but off by 1.5 %.") == short_name("Close, but off by 0.8 %.")
    True
    >>> short_name("The size is right, but not the sign.")
    'the-size-is-right-744f'
    """
    text = _MEASURED.sub("", those_in(reason)[0])
    words = re.findall(r"\w+", text.casefold())[:_WORDS]
    return "-".join([*words, hashlib.sha256(text.encode()).hexdigest()[:4]])
