"""The rules and the still arcs of a machine's table, and rules in columns where none are read."""

import math
import re

from cammotion.exchange.all_faults import Faults
from cammotion.exchange.machine_heading import may_be_still, meant_by, misspelt
from cammotion.exchange.machine_lines import RULE, STILL, Record
from cammotion.exchange.rule_text import (
    NO,
    arcs_from_text,
    is_nearly_rule,
    nameless,
    nearly_arcs,
    rule_from_text,
)
from cammotion.machine.arcs import ROUNDING_DEG, Arc, arcs, complement, unwrap
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, arcs_of
from cammotion.quantities import InputError, shorten
from cammotion.rules.checks import every_rule
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.distance import DistanceRule
from cammotion.rules.rule import Rule

_CALLED = {RULE: "rule", STILL: "still arc"}
_IN_DEG = re.compile("deg|°|grad", re.IGNORECASE)


def rules_of(
    records: list[Record], names: list[str], motions: list[Motion], faults: Faults
) -> list[Rule]:
    """Return the rules of all lines; two that forbid all between them are a fault, too."""
    rules: list[Rule] = []
    found: dict[Rule, str] = {}
    read = {motion.name: motion for motion in motions}
    for record in records:
        if not record.cells[RULE]:
            continue
        with faults.at(f"{record.where}, '{RULE}'"):
            rule = rule_from_text(record.cells[RULE], names, record.mark(RULE))
            own = [read[name] for name in rule.motions if name in read]
            if len(own) == len(rule.motions):
                every_rule(TimingDiagram(own, 1), rule)
            bare = nameless(rule)
            if where := found.get(bare):
                raise InputError(f"the rule stands in {where} already: leave out one of them.")
            for other, where in found.items():
                if forbidden := _forbidden(rule, other):
                    raise InputError(
                        f"with the rule in {where} it forbids {forbidden}: mend one of them."
                    )
            found[bare] = record.where
            rules.append(rule)
    return rules


def ask_of_own_columns(
    heading: list[str],
    records: list[Record],
    names: list[str],
    rules: list[Rule],
    faults: Faults,
) -> None:
    """Add as a fault each column of one's own in which stands what would be lost there.

    That is a rule that is not among these; and where the column for it is lacking, or is meant,
    also what is nearly a rule or a still arc.
    """
    told = {column for column, _ in misspelt(heading)}
    cells = [(record, *own) for record in records for own in record.others]
    known = {*map(nameless, rules)} if cells else set()
    dwells = _dwells(records) if cells else []
    for record, column, cell in cells:
        try:
            rule = rule_from_text(cell, names, record.decimal)
        except InputError:
            asked = [one for one in _CALLED if one not in heading or meant_by(column, [one])]
            is_nearly = {RULE: is_nearly_rule(cell, names), STILL: _is_arc(column, cell, dwells)}
            meant = next((one for one in asked if is_nearly[one]), "")
            what = f"{shorten(cell)}, much like a {_CALLED.get(meant)},"
            free = "call this otherwise" if meant in heading else f"add an empty column '{meant}'"
            fix = f"{free} if it is a remark"
        else:
            meant = "" if nameless(rule) in known else RULE
            what, fix = f"'{rule}'", "leave out the rule"
        if meant and column not in told:
            told.add(column)
            place = "write it into" if meant in heading else "call"
            faults.add(
                f"{record.where}: there stands {what} in the column {shorten(column)}, which is "
                f"yours: {place} the column '{meant}', or {fix}."
            )


def _is_arc(column: str, cell: str, dwells: list[Arc]) -> bool:
    """Return whether a cell is nearly a still arc; numbers without deg may be pages or years.

    They are one if a part stands over just that arc, or the column speaks of it.
    """
    found = nearly_arcs(cell)
    if may_be_still(column) or _IN_DEG.search(cell):
        return bool(found)
    within = [part for arc in found for part in unwrap(arcs([arc]))]
    return any(math.dist(part, dwell) <= ROUNDING_DEG for part in within for dwell in dwells)


def _dwells(records: list[Record]) -> list[Arc]:
    """Return the arcs between the moves of each motion, whether they are listed or left out."""
    moves: dict[str, list[Segment]] = {}
    for record in records:
        if record.segment and not record.segment.is_dwell:
            moves.setdefault(record.cells["motion"], []).append(record.segment)
    return [arc for own in moves.values() for arc in unwrap(complement(arcs_of(own)))]


def _forbidden(one: Rule, other: Rule) -> str:
    """Return what two rules together forbid for ever; nothing if they can both be kept."""
    if isinstance(one, ClearanceRule) and isinstance(other, ClearanceRule):
        contradict = one.when == other.when and one.only_while == other.only_while.opposite
        return f"that the {one.when.motion} is ever {one.when}" if contradict else ""
    if isinstance(one, DistanceRule) and isinstance(other, DistanceRule):
        crossed = one.motions == other.motions[::-1] and one.at_least_mm + other.at_least_mm > 0
        return f"every place of {one.part} and {one.above}" if crossed else ""
    return ""


def still_arcs(records: list[Record], faults: Faults) -> dict[str, list[tuple[str, Arc]]]:
    """Return the still arcs of each motion, each with its line."""
    found: dict[str, list[tuple[str, Arc]]] = {}
    for record in records:
        text = record.cells[STILL]
        if not text or text.casefold() in NO:
            continue
        with faults.at(f"{record.where}, '{STILL}'"):
            arcs = arcs_from_text(text, record.mark(STILL))
            if not arcs and (record.segment or not record.is_segment):
                if not record.segment or not record.segment.is_dwell:
                    marked = f"a {record.segment.kind}" if record.segment else "no segment"
                    raise InputError(
                        f"{shorten(text)} marks {marked}: mark a dwell, or write an arc like "
                        "'205 to 305'."
                    )
                arcs = [(record.segment.from_deg, record.segment.to_deg)]
            found.setdefault(record.cells["motion"], []).extend((record.where, arc) for arc in arcs)
    return found
