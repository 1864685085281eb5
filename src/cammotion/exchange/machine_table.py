"""The table of a machine: segments, rules and still arcs, read with all faults told at once."""

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from difflib import get_close_matches
from itertools import pairwise
from typing import Any

from cammotion.exchange.all_faults import Faults
from cammotion.exchange.cells import Plain, decimal_mark
from cammotion.exchange.machine_lines import (
    HEADING,
    IN_FULL,
    NUMBERS,
    RATE,
    RULE,
    STILL,
    STOPS,
    Laws,
    Record,
)
from cammotion.exchange.machine_source import Source
from cammotion.exchange.rule_text import NO, arcs_from_text, nameless, rule_from_text
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.arcs import Arc
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, with_dwells
from cammotion.own import Machine
from cammotion.quantities import InputError, shorten
from cammotion.rules.checks import every_rule
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.distance import DistanceRule
from cammotion.rules.rule import Rule

_SAID_OTHERWISE = {
    STILL: {"stand", "stands", "standing", "stay", "stays", "rest", "rests", "dwell", "dwells"},
    RULE: {"clearance", "clearances", "condition", "conditions", "constraint", "constraints"},
}
_LIKE = 0.8  # of 1: so like another name is a misspelt one


def read_table(source: Source, given: Iterable[MotionLaw] = ()) -> Machine:
    """Return the machine that a table says, with the `given` laws that it names.

    Raises one InputError with all that is wrong, each with its line and column.
    """
    laws, faults = Laws(given), Faults()
    records = _records(source, faults)
    for record in records:
        record.read(laws, faults)
    segments = [record for record in records if record.is_segment]
    names = [*dict.fromkeys(record.cells["motion"] for record in segments)]
    doubtful = _doubtful(segments, faults)
    motions: list[Motion] = []
    lines: dict[str, list[Record]] = {}
    for record in records:
        lines.setdefault(record.cells["motion"], []).append(record)
    for name in names:
        own = lines[name]
        with faults.at():
            stops = _stops(own)
            if name not in doubtful and all(one.segment for one in own if one.is_segment):
                motions.append(_motion(name, own, stops))
    rate = math.nan
    with faults.at():
        rate = _the_same(records, RATE)
    rules = _rules(records, names, motions, faults)
    _ask_of_rules_elsewhere(records, names, rules, faults)
    still = _still(records, faults)
    for motion in motions:
        for where, arc in still.get(motion.name, ()):
            with faults.at(f"{where}, '{STILL}'"):
                Machine("one part", TimingDiagram([motion], 1), (), {motion.name: [arc]})
    faults.check()
    diagram = TimingDiagram(tuple(motions), rate)
    arcs_of = {name: [arc for _, arc in arcs] for name, arcs in still.items()}
    return Machine(source.name, diagram, rules, arcs_of)


def _listed(what: str, names: Sequence[str]) -> str:
    """Return names with what they are, in the plural if there are several."""
    return f"the {what}{'s' * (len(names) > 1)} {', '.join(map(repr, names))}"


def _misspelt(heading: list[str]) -> Iterator[tuple[str, str]]:
    """Yield the columns that are called nearly, or mean, one that is not there, and that one."""
    lacking = [column for column in (STOPS, STILL, RULE) if column not in heading]
    for column in heading:
        if column in HEADING or column == IN_FULL:
            continue
        like = get_close_matches(column.casefold(), lacking, 1, _LIKE)
        begun = [one for one in lacking if column.casefold().startswith(one)]
        words = {*column.casefold().split()}
        alike = [one for one in lacking if words & _SAID_OTHERWISE.get(one, set())]
        yield from ((column, meant) for meant in (like or begun or alike)[:1])


def _records(source: Source, faults: Faults) -> list[Record]:
    """Return the lines below the heading in which anything stands."""
    at, file = source.heading_at, source.said
    named = {column.casefold(): column for column in (*HEADING, STILL, RULE, IN_FULL)}
    named["rules"] = RULE
    first = source.rows[at] if source.rows else []
    heading = [named.get(" ".join(cell.split()).casefold(), cell.strip()) for cell in first]
    needed = [column for column in HEADING if column != STOPS]
    if missing := [column for column in needed if column not in heading]:
        unknown = [repr(cell) for cell in heading if cell and cell not in named.values()]
        strange = f", and has {', '.join(unknown)}, unknown here" if unknown else ""
        raise InputError(
            f"The file {file} lacks {_listed('column', missing)}{strange}: its first line has to "
            f"be {', '.join(HEADING)}, with the numbers in these units; stops may be left out."
        )
    for column in (*HEADING, STILL, RULE):
        if heading.count(column) > 1:
            faults.add(f"{source.where(at)}: the column '{column}' stands there twice: drop one.")
    for column, meant in _misspelt(heading):
        faults.add(
            f"{source.where(at)}: there is a column '{column}' and none '{meant}': call it "
            f"'{meant}', or something else."
        )
    records: list[Record] = []
    for place, line in enumerate(source.rows[at + 1 :], at + 1):
        if any(cell.strip() for cell in line):
            with faults.at():
                records.append(Record(source.where(place), heading, line))
    _name_motions(records, faults)
    if not any(record.is_segment for record in records):
        faults.add(f"The file {file} has no line with a segment: add some.")
        faults.check()
    angles = [NUMBERS["from_deg"], NUMBERS["to_deg"]]
    decimal = decimal_mark(
        _typed(records, [*NUMBERS.values(), STOPS, RATE]), _typed(records, angles)
    )
    for record in records:
        record.decimal = decimal
    return records


def _typed(records: list[Record], columns: Sequence[str]) -> list[str]:
    cells = (record.cells[column] for record in records for column in columns)
    return [cell for cell in cells if not isinstance(cell, Plain)]


def _name_motions(records: list[Record], faults: Faults) -> None:
    """Give a line that names no motion that of the line above."""
    before = ""
    for record in records:
        before = record.cells["motion"] = record.cells["motion"] or before
        for column in (STOPS, STILL) if not before else ():
            if cell := record.cells[column]:
                faults.add(
                    f"{record.where}: '{column}' is {shorten(cell)}, but no motion stands there or "
                    "above: write its name."
                )


def _doubtful(segments: list[Record], faults: Faults) -> set[str]:
    """Return the names that differ by their case or blanks alone, where one fills no turn."""
    lines: dict[str, dict[str, list[Record]]] = {}
    for record in segments:
        name = record.cells["motion"]
        lines.setdefault(" ".join(name.split()).casefold(), {}).setdefault(name, []).append(record)
    doubtful: set[str] = set()
    for alike in lines.values():
        first, *others = alike
        if all(map(_fills_turn, alike.values())):
            continue
        for other in others:
            faults.add(
                f"{alike[other][0].where}: the motion is {shorten(other)}, but {shorten(first)} in "
                f"{alike[first][0].where}: write both alike, or list the dwells too if they are "
                "two motions."
            )
            doubtful |= {first, other}
    return doubtful


def _fills_turn(records: list[Record]) -> bool:
    segments = [record.segment for record in records if record.segment]
    return math.isclose(sum(one.to_deg - one.from_deg for one in segments), DEG_PER_TURN)


def _motion(name: str, records: list[Record], stops: Any) -> Motion:
    segments = [record.segment for record in records if record.segment]
    try:
        return Motion(name, tuple(_filled(segments)), stops)
    except InputError as wrong:
        raise InputError(f"{records[0].where} and further: {wrong}") from None


def _filled(segments: list[Segment]) -> list[Segment]:
    """Return the segments with dwells between them if the table lists moves alone.

    Where it lists some dwell, a gap is a slip: Motion says so.
    """
    for before, after in pairwise(segments):
        if after.from_deg < before.from_deg:
            raise InputError(
                f"the segment from {after.from_deg:g} deg stands below that from "
                f"{before.from_deg:g} deg: sort the lines by their angles, which count on over "
                f"{DEG_PER_TURN} deg, or, if another motion begins there, give it its own name."
            )
    if any(segment.is_dwell for segment in segments):
        return segments
    return [*with_dwells(segments)]


def _rules(
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


def _ask_of_rules_elsewhere(
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


def _still(records: list[Record], faults: Faults) -> dict[str, list[tuple[str, Arc]]]:
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


def _stops(records: list[Record]) -> Any:
    if not any(record.cells[STOPS] for record in records):
        return None
    stops = _the_same(records, STOPS)
    return int(stops) if stops.is_integer() else stops  # Motion refuses what is not whole


def _the_same(records: list[Record], column: str) -> float:
    """Return the number that stands in this column of every line, or of those that have one."""
    filled = [record for record in records if record.cells[column]] or records
    first = filled[0].number(column)
    for record in filled:
        if record.number(column) != first:
            raise InputError(
                f"{record.where}: '{column}' is {record.number(column):g}, but {first:g} in the "
                f"first line of the {'motion' if column == STOPS else 'diagram'}: write the same "
                "in both."
            )
    return first
