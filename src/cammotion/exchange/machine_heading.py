"""The heading of the table of a machine: which column is which, and which may be meant."""

import re
from collections.abc import Iterable, Iterator, Sequence
from difflib import get_close_matches

from cammotion.exchange.all_faults import Faults
from cammotion.exchange.machine_lines import (
    HEADING,
    KNOWN_COLUMNS,
    NEEDED,
    RULE,
    STILL,
    STOPS,
    known_column,
)
from cammotion.exchange.machine_source import Source
from cammotion.exchange.other_units import factor_of, unit_of
from cammotion.quantities import InputError

_SAID_OTHERWISE = {
    STILL: {
        *("stand", "stands", "standing", "standstill", "stay", "stays", "rest", "rests", "dwell"),
        "dwells",
    },
    RULE: {
        *("clearance", "clearances", "condition", "conditions", "constraint", "constraints"),
    },
}
_ALONE = {
    STILL: {"rast", "raste", "rasten"},
    RULE: {
        *("interlock", "interlocks", "regel", "regeln", "bedingung", "bedingungen"),
        *("verriegelung", "verriegelungen"),
    },
}
"""Words that mean a column only where they are all of its heading."""

_STILL = {"ruhe", "steht", "stehen", "halt"}
_STOPS = {"station", "stations", "stationen", "pocket", "pockets", "nest", "nests", "teilung"}
_WORD = re.compile(r"[^\W\d_]{2,}")  # none is the (n) of Regel(n)
_LIKE = 0.8  # of 1: so like another name is a misspelt one


def heading_of_table(source: Source, faults: Faults) -> list[str]:
    """Return the columns by the names that they have here; those of one's own as they are.

    Raises InputError where one is missing that is needed.
    """
    at = source.heading_at
    first = source.rows[at] if source.rows else []
    heading = [known_column(cell) or cell.strip() for cell in first]
    if missing := [column for column in NEEDED if column not in heading]:
        unknown = [cell for cell in heading if cell and cell not in KNOWN_COLUMNS]
        strange = f", and has {', '.join(map(repr, unknown))}, unknown here" if unknown else ""
        raise InputError(
            f"The {source.what} lacks {_listed('column', missing)}{strange}: its first line has to "
            f"be {', '.join(HEADING)}, with the numbers in these units; stops may be left "
            f"out.{''.join(_conversions(missing, unknown))}"
        )
    for column in (*HEADING, STILL, RULE):
        if heading.count(column) > 1:
            faults.add(f"{source.where(at)}: the column '{column}' stands there twice: drop one.")
    for column, meant in misspelt(heading):
        faults.add(
            f"{source.where(at)}: there is a column '{column}' and none '{meant}': call it "
            f"'{meant}', or something else."
        )
    return heading


def _conversions(missing: list[str], unknown: list[str]) -> Iterator[str]:
    """Yield a sentence on each unit of unknown columns of which one that is missing can be made.

    They share a word with it: "from", "to", "rate" or "pieces".
    """
    for unit in dict.fromkeys(map(unit_of, missing)):
        said = {word for one in missing if unit_of(one) == unit for word in _WORD.findall(one)}
        alike = [column for column in unknown if _says(column, said - {"in", unit})]
        factors = {column: factor_of(column, unit) for column in alike}
        for factor in dict.fromkeys(one for one in factors.values() if one > 0 and one != 1):
            columns = [repr(column) for column, one in factors.items() if one == factor]
            yield f" The numbers of {' and '.join(columns)} times {factor:.10g} are {unit}."


def _says(column: str, words: Iterable[str]) -> bool:
    """Return whether one of these words stands in a heading, or nearly so."""
    found = _WORD.findall(column.casefold())
    return any(get_close_matches(word, found, 1, _LIKE) for word in words)


def _listed(what: str, names: Sequence[str]) -> str:
    """Return names with what they are, in the plural if there are several."""
    return f"the {what}{'s' * (len(names) > 1)} {', '.join(map(repr, names))}"


def misspelt(heading: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Yield the columns that are called nearly, or mean, one that is not there, and that one."""
    lacking = [column for column in (STOPS, STILL, RULE) if column not in heading]
    for column in heading:
        if column not in KNOWN_COLUMNS and (meant := meant_by(column, lacking)):
            yield column, meant


def may_be_stops(column: str) -> bool:
    """Return whether a column of one's own may say how many stops a turret has."""
    return bool(_STOPS & {*_WORD.findall(column.casefold())})


def may_be_still(column: str) -> bool:
    """Return whether a column of one's own may say where a part stands."""
    return bool(_STILL & {*_WORD.findall(column.casefold())})


def meant_by(column: str, known: Sequence[str]) -> str:
    """Return which of the `known` columns one of another name means; "" for none.

    >>> meant_by("Regeln", ["still", "rule"]), meant_by("remark", ["still", "rule"])
    ('rule', '')
    """
    folded = column.casefold()
    like = get_close_matches(folded, known, 1, _LIKE)
    begun = [one for one in known if folded.startswith(one)]
    words = {*_WORD.findall(folded)}
    alike = [one for one in known if words & _SAID_OTHERWISE.get(one, set())]
    alone = [one for one in known if words and words <= _ALONE.get(one, set())]
    return next(iter([*like, *begun, *alike, *alone]), "")
