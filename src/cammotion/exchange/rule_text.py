"""Rules and still arcs as a person types them into a cell."""

import math
import re
from collections.abc import Iterable, Sequence
from dataclasses import replace
from difflib import get_close_matches
from typing import Any

from cammotion.exchange.cells import number_in, two_readings
from cammotion.machine.arcs import Arc
from cammotion.quantities import InputError, one_of, shorten
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition, Moving, beyond, moving, standing, within
from cammotion.rules.distance import DistanceRule
from cammotion.rules.rule import Rule

EXAMPLE = "the die may be beyond 19 mm only while the mill is within 0.65 mm"
DISTANCE = "the pusher stays at least 5 mm above the flap"
ARC_EXAMPLE = "205 to 305"
YES, NO = ("yes", "x", "true"), ("no", "false")
_ONLY = re.compile(r"\s+only\s+(?:while|if|when)\s+", re.IGNORECASE)
_LIMIT = r"(?P<limit>[-+−.,\d]\S*?)\s*"
_HALF = re.compile(
    r"(?P<name>\S.*?)\s+(?:(?:may\s+be|is)\s+)?(?:(?P<side>beyond|within)\s+"
    rf"{_LIMIT}(?:mm)?|(?P<way>moving|standing))\.?",
    re.IGNORECASE | re.DOTALL,
)
_APART = [
    re.compile(pattern, re.IGNORECASE | re.DOTALL)
    for pattern in (
        rf"(?P<part>\S.*?)\s+(?:(?:stays|is)\s+)?at\s+least\s+{_LIMIT}(?:mm\s+)?"
        r"above\s+(?P<other>\S.*)",
        r"(?P<part>\S.*?)\s+[-−]\s+(?P<other>\S.*?)\s+(?:is\s+)?at\s+least\s+"
        rf"{_LIMIT}(?:mm)?\.?",
    )
]
_THE = re.compile(r"^the\s+", re.IGNORECASE)
_DEG = r"\s*(?:deg|°)?"
_ARC = re.compile(
    rf"(?:from\s+)?(?P<start>\S+?){_DEG}\s+to\s+(?P<end>\S+?){_DEG}\.?", re.IGNORECASE
)
_AND = re.compile(r"\s+and\s+|\s*;\s*", re.IGNORECASE)
_CONDITIONS = re.compile(r"\b(?:beyond|within|moving|standing|at\s+least)\b|mm\s+above\b")
_LIMITS = re.compile(r"\d|\b(?:mm|beyond|within|moving|standing)\b")
_JOINTS = re.compile(
    r"\b(?:only\s+(?:while|if|when|as\s+long)|nur\s+(?:während|wenn|solange|falls))\b"
)
_JOINED = re.compile(
    r"mm\s+above\b|\bat\s+least\s+\S*\d\s*(?:mm\b|$)|\bmay\s+be\s+(?:beyond|within)\s+\S*\d"
)
_END = r"([-+−]?\d[\dOoIl]*(?:[.,][\dOoIl]+)?)\s*(?:deg|°|grad)?"
_ARCS = re.compile(rf"(?:(?:from|von)\s+)?{_END}\s+(?:to|bis)\s+{_END}\.?", re.IGNORECASE)
_DIGITS = str.maketrans("OoIl,−", "0011.-")
_MARKS, _LIKE = 3, 0.8  # of a rule, in a text that is meant as one; of 1, of a misspelt name


def rule_from_text(text: str, names: Iterable[str], decimal: str = ".") -> Rule:
    """Return the rule that a sentence says about motions of these `names`.

    "the", "may be" and "is" may be left out; a name of the rule stands before it, with a colon.
    Raises InputError for anything else.

    >>> str(rule_from_text("die beyond 19 only while mill within 0.65", ["mill", "die"]))
    'the die may be beyond 19 mm only while the mill is within 0.65 mm'
    >>> rule_from_text("clear: die beyond 19 only while mill standing", ["mill", "die"]).name
    'clear'
    >>> str(rule_from_text("pusher - flap at least 5 mm", ["pusher", "flap"]))
    'the pusher stays at least 5 mm above the flap'
    """
    known = [*names]
    name, colon, said = text.strip().rpartition(": ")
    if not colon or any(": " in f"{motion} " for motion in known):
        name, said = "", text.strip()
    halves = _ONLY.split(said)
    if len(halves) == 2:  # noqa: PLR2004 - what may be, and while what is
        when, only_while = (_condition(half, text, known, decimal) for half in halves)
        return ClearanceRule(when, only_while, name)
    for form in _APART if len(halves) == 1 else ():
        if found := form.fullmatch(said):
            part, other = (_motion(found[side], known) for side in ("part", "other"))
            return DistanceRule(part, other, _number(found["limit"], text, decimal), name)
    alone = ", one in a cell" if len(halves) > 1 else ""
    raise InputError(
        f"The rule is {shorten(text)}: write it as '{EXAMPLE}' or '{DISTANCE}'{alone}."
    )


def _condition(half: str, text: str, names: list[str], decimal: str) -> Condition:
    found = _HALF.fullmatch(half)
    if not found:
        raise InputError(
            f"The rule has the half {shorten(half.strip())}: write it as '{EXAMPLE}', with "
            "'beyond', 'within', 'moving' or 'standing' in each half, and limits in mm."
        )
    name = _motion(found["name"], names)
    if found["way"]:
        return moving(name) if found["way"].lower() == "moving" else standing(name)
    make = beyond if found["side"].lower() == "beyond" else within
    return make(name, _number(found["limit"], text, decimal))


def _motion(text: str, names: list[str]) -> str:
    """Return the name of a motion; "the" may stand before it, and a full stop after it."""
    ended = text.removesuffix(".")
    ways = [way for said in (text, ended) for way in (said, " ".join(said.split()))]
    said = [bare for way in ways for bare in (way, _THE.sub("", way))]
    return one_of("motion", next((way for way in said if way in names), said[-1]), names)


def is_nearly_rule(text: str, names: Sequence[str]) -> bool:
    """Return whether a text has so much of a rule that it is hardly a remark.

    Three marks make one: its words, what joins its halves, and motions, also misspelt ones. And it
    is joined as a rule is: a limit on both sides of "only while", or one with its "mm above".

    >>> is_nearly_rule("dei 19 mm deep only while mill within 0.65", ["mill", "die"])
    True
    >>> is_nearly_rule("die within 0.02 mm of drawing, mill too", ["mill", "die"])
    False
    """
    folded = text.casefold()
    marks = len(_CONDITIONS.findall(folded)) + len(_JOINTS.findall(folded))
    if not marks:
        return False
    known = [name.casefold() for name in names]
    named = {name for name in known if re.search(rf"(?<!\w){re.escape(name)}(?!\w)", folded)}
    for word in re.findall(r"\w+", folded):
        named |= {*get_close_matches(word, known, 1, _LIKE)}
    return marks + len(named) >= _MARKS and _is_joined(folded, named)


def _is_joined(folded: str, named: Iterable[str]) -> bool:
    """Return whether a text has the joint of a rule, and its limits; those of names are none."""
    for name in sorted(named, key=len, reverse=True):
        folded = re.sub(rf"(?<!\w){re.escape(name)}(?!\w)", "", folded)
    halves = _JOINTS.split(folded)
    return bool(_JOINED.search(folded)) or (len(halves) > 1 and all(map(_LIMITS.search, halves)))


def nearly_arcs(text: str) -> list[Arc]:
    """Return the still arcs of a text that is nothing else, or would be without a slip; else [].

    >>> nearly_arcs("205 to 3O5 deg"), nearly_arcs("as drawn on pages 3 to 4")
    ([(205.0, 305.0)], [])
    """
    found = [_ARCS.fullmatch(part) for part in _AND.split(text.strip())]
    ends = [[float(end.translate(_DIGITS)) for end in one.groups()] for one in found if one]
    return [(start, end) for start, end in ends] if all(found) else []


def arcs_from_text(text: str, decimal: str = ".") -> list[Arc]:
    """Return the arcs that a cell says, pairs of cam angles in deg; [] for a mark of YES.

    >>> arcs_from_text("205 to 305 and 350 to 370 deg"), arcs_from_text("yes")
    ([(205.0, 305.0), (350.0, 370.0)], [])
    """
    if text.strip().casefold() in YES:
        return []
    arcs = []
    for part in _AND.split(text.strip()):
        found = _ARC.fullmatch(part)
        if not found:
            raise InputError(
                f"The still arc is {shorten(text)}: write 'yes' for the whole dwell, or an arc in "
                f"deg like '{ARC_EXAMPLE}', several with 'and' between them."
            )
        start, end = (_number(found[end], text, decimal) for end in ("start", "end"))
        arcs.append((start, end))
    return arcs


def arcs_as_text(arcs: Iterable[Arc]) -> str:
    """Return arcs as `arcs_from_text` reads them.

    >>> arcs_as_text([(205, 305.5), (350, 370)])
    '205 to 305.5 and 350 to 370'
    """
    return " and ".join(f"{_plain(start)} to {_plain(end)}" for start, end in arcs)


def rule_as_text(rule: Rule) -> str:
    """Return a rule as `rule_from_text` reads it, with all digits of its numbers.

    >>> rule_as_text(ClearanceRule(beyond("die", 19), only_while=within("mill", 0.65)))
    'the die may be beyond 19 mm only while the mill is within 0.65 mm'
    """
    name = f"{rule.name}: " if rule.name else ""
    if isinstance(rule, ClearanceRule):
        when, only = (
            (half.motion, str(half) if isinstance(half, Moving) else _limit(half))
            for half in (rule.when, rule.only_while)
        )
        return f"{name}the {when[0]} may be {when[1]} only while the {only[0]} is {only[1]}"
    if isinstance(rule, DistanceRule):
        apart = f"at least {_plain(rule.at_least_mm)} mm above the {rule.above}"
        return f"{name}the {rule.part} stays {apart}"
    raise InputError(f"The rule '{rule}' is of a kind of its own, which no table knows.")


def nameless(rule: Rule) -> Rule:
    """Return a rule without its name, which asks the same."""
    known: Any = rule  # each kind of rule is a record with a name
    without: Rule = replace(known, name="")
    return without


def _limit(half: Condition) -> str:
    return f"{'beyond' if half.is_beyond else 'within'} {_plain(half.limit_mm)} mm"


def _plain(number: float) -> str:
    """Return a number that can be read in one way alone."""
    text = repr(float(number)).removesuffix(".0")
    return f"{text}0" if two_readings(text) else text


def _number(text: str, whole: str, decimal: str) -> float:
    """Return a number in a sentence, whose decimal mark is that of the table, or the only one."""
    number = number_in(text, decimal)
    if math.isnan(number):
        fix, other = "give a number, for example 19", {".": ",", ",": "."}.get(decimal, "")
        if two_readings(text):
            fix = "write it with a 0 more behind"
        elif other and not math.isnan(number_in(text, other)):
            fix = f"with the decimal mark of this table it is {text.replace(other, decimal)}"
        raise InputError(f"In {shorten(whole)} stands {shorten(text)}: {fix}.")
    return number
