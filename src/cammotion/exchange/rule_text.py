"""Clearance rules and still arcs as a person types them into a cell."""

import re
from collections.abc import Iterable

from cammotion.exchange.cells import number_in, two_readings
from cammotion.machine.arcs import Arc
from cammotion.quantities import InputError, one_of, shorten
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Condition, beyond, within

EXAMPLE = "the die may be beyond 19 mm only while the mill is within 0.65 mm"
ARC_EXAMPLE = "205 to 305"
YES = ("yes", "x", "true")
_ONLY = re.compile(r"\s+only\s+(?:while|if|when)\s+", re.IGNORECASE)
_HALF = re.compile(
    r"(?P<name>\S.*?)\s+(?:(?:may\s+be|is)\s+)?(?P<side>beyond|within)\s+"
    r"(?P<limit>[-+\d]\S*?)\s*(?:mm)?\.?",
    re.IGNORECASE | re.DOTALL,
)
_THE = re.compile(r"^the\s+", re.IGNORECASE)
_ARC = re.compile(r"(?:from\s+)?(?P<start>\S+)\s+to\s+(?P<end>\S+?)\s*(?:deg|°)?\.?", re.IGNORECASE)
_AND = re.compile(r"\s+and\s+|\s*;\s*", re.IGNORECASE)


def rule_from_text(text: str, names: Iterable[str], decimal: str = ".") -> ClearanceRule:
    """Return the rule that a sentence says about motions of these `names`.

    "the", "may be" and "is" may be left out; a name of the rule stands before it, with a colon.
    Raises InputError for anything else.

    >>> str(rule_from_text("die beyond 19 only while mill within 0.65", ["mill", "die"]))
    'the die may be beyond 19 mm only while the mill is within 0.65 mm'
    >>> rule_from_text("clear: die beyond 19 only while mill within 0.65", ["mill", "die"]).name
    'clear'
    """
    known = [*names]
    name, colon, said = text.strip().partition(": ")
    if not colon or any(": " in motion for motion in known):
        name, said = "", text.strip()
    halves = _ONLY.split(said)
    if len(halves) != 2:  # noqa: PLR2004 - what may be, and while what is
        raise InputError(f"The rule is {shorten(text)}: write it as '{EXAMPLE}'.")
    when, only_while = (_condition(half, text, known, decimal) for half in halves)
    return ClearanceRule(when, only_while, name)


def _condition(half: str, text: str, names: list[str], decimal: str) -> Condition:
    found = _HALF.fullmatch(half)
    if not found:
        raise InputError(
            f"The rule has the half {shorten(half.strip())}: write it as '{EXAMPLE}', with "
            "'beyond' or 'within' in each half."
        )
    said = " ".join(found["name"].split())
    name = said if said in names else _THE.sub("", said)
    make = beyond if found["side"].lower() == "beyond" else within
    return make(one_of("motion", name, names), _number(found["limit"], text, decimal))


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
                f"deg like '{ARC_EXAMPLE}'."
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


def rule_as_text(rule: ClearanceRule) -> str:
    """Return a rule as `rule_from_text` reads it, with all digits of its numbers.

    >>> rule_as_text(ClearanceRule(beyond("die", 19), only_while=within("mill", 0.65)))
    'the die may be beyond 19 mm only while the mill is within 0.65 mm'
    """
    when, only = rule.when, rule.only_while
    sides = ["beyond" if half.is_beyond else "within" for half in (when, only)]
    name = f"{rule.name}: " if rule.name else ""
    return (
        f"{name}the {when.motion} may be {sides[0]} {_plain(when.limit_mm)} mm only while "
        f"the {only.motion} is {sides[1]} {_plain(only.limit_mm)} mm"
    )


def _plain(number: float) -> str:
    return repr(float(number)).removesuffix(".0")


def _number(text: str, whole: str, decimal: str) -> float:
    """Return a number in a sentence, whose decimal mark is that of the table, or the only one."""
    number = number_in(text, decimal)
    if number != number:  # noqa: PLR0124 - it is no number
        others = two_readings(text)
        fix = "write it with a 0 more behind" if others else "give a number, for example 19"
        raise InputError(f"In {shorten(whole)} stands {shorten(text)}: {fix}.")
    return number
