"""The rules and the still arcs of a machine's table, and rules in columns where none are read."""

from contextlib import suppress

from cammotion.exchange.all_faults import Faults
from cammotion.exchange.machine_lines import RULE, STILL, Record
from cammotion.exchange.rule_text import NO, arcs_from_text, nameless, rule_from_text
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.motions import Motion
from cammotion.quantities import InputError, shorten
from cammotion.rules.checks import every_rule
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.distance import DistanceRule
from cammotion.rules.rule import Rule


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


def ask_of_rules_elsewhere(
    records: list[Record], names: list[str], rules: list[Rule], faults: Faults
) -> None:
    """Add as a fault each column of another name in which a rule stands that is not among these."""
    found: list[tuple[str, str, Rule]] = []
    for record in records:
        for column, cell in record.others.items():
            with suppress(InputError):
                found.append((record.where, column, rule_from_text(cell, names, record.decimal)))
    known = {*map(nameless, rules)} if found else set()
    strange = [one for one in found if nameless(one[2]) not in known]
    first = {column: (where, rule) for where, column, rule in reversed(strange)}
    for column, (where, rule) in first.items():
        faults.add(
            f"{where}: there stands '{rule}' in the column {shorten(column)}, which is yours: call "
            f"the column '{RULE}', or leave out the rule."
        )


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
