"""The table of a machine: segments, rules and still arcs, read with all faults told at once."""

import math
from collections import defaultdict
from collections.abc import Iterable, Sequence
from itertools import groupby, pairwise
from typing import Any

from cammotion.exchange.all_faults import Faults
from cammotion.exchange.cells import Plain, decimal_mark
from cammotion.exchange.machine_heading import heading_of_table, may_be_stops
from cammotion.exchange.machine_lines import NUMBERS, RATE, STILL, STOPS, Laws, Record
from cammotion.exchange.machine_rules import ask_of_own_columns, rules_of, still_arcs
from cammotion.exchange.machine_source import Source
from cammotion.laws.motion_law import MotionLaw
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import Segment, with_dwells
from cammotion.own import Machine
from cammotion.quantities import InputError, one_of, shorten

_HALF_RAD, _NEAR_RAD = 3.0, 0.01  # of a turn in radians: nearly the half; what rounding leaves
_CUT = {
    ",": ", give the column a heading, or write numbers with a decimal point and texts that have a "
    "comma in quotation marks",
    ";": ", give the column a heading, or put a text that has a semicolon in quotation marks; each "
    "rule has a cell of its own",
}


def read_table(source: Source, given: Iterable[MotionLaw] = ()) -> Machine:
    """Return the machine that a table says, with the `given` laws that it names.

    Raises one InputError with all that is wrong, each with its line and column.
    """
    laws, faults = Laws(given), Faults()
    heading = heading_of_table(source, faults)
    records = _records(source, heading, faults)
    for record in records:
        record.read(laws, faults)
    _check_degrees(source, records, faults)
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
    _check_together([motion.name for motion in motions], segments, faults)
    rate = math.nan
    with faults.at():
        rate = _the_same(records, RATE)
    rules = rules_of(records, names, motions, faults)
    ask_of_own_columns(heading, records, names, rules, faults)
    still = still_arcs(records, faults)
    for motion in motions:
        for where, arc in still.get(motion.name, ()):
            with faults.at(f"{where}, '{STILL}'"):
                Machine("one part", TimingDiagram([motion], 1), (), {motion.name: [arc]})
    faults.check()
    diagram = TimingDiagram(tuple(motions), rate)
    arcs_of = {name: [arc for _, arc in arcs] for name, arcs in still.items()}
    return Machine(source.name, diagram, rules, arcs_of)


def _records(source: Source, heading: list[str], faults: Faults) -> list[Record]:
    """Return the lines below the heading in which anything stands."""
    below = source.heading_at + 1
    lines = [(source.where(n), line) for n, line in enumerate(source.rows) if n >= below]
    _check_widths(source.separator, len(heading), lines, faults)
    records = [Record(where, heading, line) for where, line in lines if any(map(str.strip, line))]
    _name_motions(records, faults)
    if not any(record.is_segment for record in records):
        faults.add(f"The {source.what} has no line with a segment: add some.")
        faults.check()
    angles = [NUMBERS["from_deg"], NUMBERS["to_deg"]]
    decimal = decimal_mark(
        _typed(records, [*NUMBERS.values(), STOPS, RATE]), _typed(records, angles)
    )
    for record in records:
        record.decimal = decimal
    return records


def _check_widths(
    separator: str, width: int, lines: list[tuple[str, list[str]]], faults: Faults
) -> None:
    """Add each line that is wider than the heading as a fault; where signs cut it, stop there."""
    wide = [(where, line) for where, line in lines if any(map(str.strip, line[width:]))]
    for where, line in wide:
        at = next(n for n, cell in enumerate(line) if n >= width and cell.strip())
        faults.add(
            f"{where} has {shorten(line[at].strip())} in column {at + 1}, but the heading has "
            f"{width} columns: leave it out{_CUT.get(separator, ', or give the column a heading')}."
        )
    if wide and separator:  # nobody knows which cells have shifted
        faults.check()


def _typed(records: list[Record], columns: Sequence[str]) -> list[str]:
    cells = (record.cells[column] for record in records for column in columns)
    return [cell for cell in cells if not isinstance(cell, Plain)]


def _name_motions(records: list[Record], faults: Faults) -> None:
    """Give a line that names no motion that of the line above."""
    named = (record.cells["motion"] for record in records if record.is_segment)
    names = [*dict.fromkeys(filter(None, named))]
    before = ""
    for record in records:
        with faults.at(record.where):
            before = record.cells["motion"] = _named(record, names) or before
            for column in (STOPS, STILL) if not before else ():
                if cell := record.cells[column]:
                    raise InputError(
                        f"'{column}' is {shorten(cell)}, but no motion stands there or above: "
                        "write its name."
                    )


def _named(record: Record, names: list[str]) -> str:
    """Return the motion that a line names; without a segment it has to be one of these."""
    name = record.cells["motion"]
    if record.is_segment or (not name and not record.lone_text):
        return name
    try:
        if record.names_alone:
            return one_of("motion", name, names)
    except InputError:
        if not record.lone_text:
            raise
    raise InputError(
        f"no segment stands beside {shorten(record.lone_text)}: leave the line out, put it above "
        "the heading or into a column of notes; the name of a motion stands with its numbers."
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
        moves_on = stops is None and segments[0].from_mm != segments[-1].to_mm
        raise InputError(
            f"{records[0].where} and further: {wrong}{_where_stops_stand(records) * moves_on}"
        ) from None


def _check_degrees(source: Source, records: list[Record], faults: Faults) -> None:
    """Raise what is wrong where the angles are in radians: no segment goes beyond a turn of these.

    Or those of a motion that lists its dwells add up to one. What moves within 3 deg is a machine
    that somebody tries, and a dwell up to 360 deg proves degrees.
    """
    lines = [record for record in records if record.is_segment]
    read = [(record.cells["motion"], record.segment) for record in lines if record.segment]
    moves = [segment for _, segment in read if not segment.is_dwell]
    if not moves or len(read) < len(lines):
        return
    low, high = min(one.from_deg for one in moves), max(one.to_deg for one in moves)
    last = max(segment.to_deg for _, segment in read)
    turns = dict.fromkeys((name for name, segment in read if segment.is_dwell), 0.0)
    for name, segment in read:
        if name in turns:
            turns[name] += segment.angle_deg
    is_closed = any(abs(turn - math.tau) < _NEAR_RAD for turn in turns.values())
    if is_closed or (low >= 0 and _HALF_RAD < high <= last < math.tau + _NEAR_RAD):
        faults.add(
            f"The moves in {source.said} lie between {low:g} and {high:g} deg, as in radians: give "
            f"all angles in deg, the numbers times {math.degrees(1):.10g}. If they are in deg, add "
            "the dwell that makes it a turn of 360 deg."
        )
        faults.check()


def _check_together(names: list[str], segments: list[Record], faults: Faults) -> None:
    """Note where one name may be that of two parts, whose lines stand apart.

    The moves of each then come back, and have another travel. In a table that is sorted by angle
    they are those of one.
    """
    read = [(record, record.segment) for record in segments if record.segment]
    moves = [(record, segment) for record, segment in read if not segment.is_dwell]
    angles = [segment.from_deg for _, segment in moves]
    blocks: dict[str, list[list[tuple[Record, Segment]]]] = defaultdict(list)
    for name, block in groupby(moves, lambda one: one[0].cells["motion"]):
        blocks[name].append([*block])
    for name in names if angles != sorted(angles) else ():
        whole = all(block[0][1].from_mm == block[-1][1].to_mm for block in blocks[name])
        travels = {max(abs(one.change_mm) for _, one in block) for block in blocks[name]}
        if len(travels) > 1 and whole:
            faults.add(
                f"{blocks[name][1][0][0].where}: moves of the {name} stand here again, below those "
                "of another motion, with another travel, and each time they come back to where "
                "they began: give the second one a name of its own, or put all lines of the first "
                "together."
            )


def _where_stops_stand(records: list[Record]) -> str:
    """Return a sentence on the column of the stops, and on one that may mean it."""
    own = (column for record in records for column, _ in record.others)
    also = next(filter(may_be_stops, own), "")
    meant = f"; call {shorten(also)} so if it says them" if also else ""
    return f" In a table the stops stand in the column '{STOPS}'{meant}."


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
