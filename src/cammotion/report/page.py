"""The page of a report: one HTML file that needs no network and no second file."""

from collections.abc import Iterator, Sequence
from datetime import date
from html import escape
from pathlib import Path

from cammotion.laws.catalogue import as_law
from cammotion.machine.motions import Motion
from cammotion.own import Machine
from cammotion.quantities import rate_as_text
from cammotion.report.bound import bound_said, design_said, free_parts, one_height_said, stay
from cammotion.report.findings import Findings
from cammotion.report.live import live_figure
from cammotion.report.markup import (
    Beside,
    Cell,
    Opened,
    beside,
    opened,
    paragraph,
    short,
    table,
)
from cammotion.report.numbers import of_peak, of_rate, of_velocity, start_deg
from cammotion.report.pictures import moving, timing
from cammotion.rules.clearance import ClearanceRule
from cammotion.rules.conditions import Moving
from cammotion.rules.rule import Clearance, Rule
from cammotion.views.whole_page import whole_page

_STYLE = Path(__file__).with_name("page.css")
_ORDER = (
    "First comes what mends a broken rule, then what makes the machine's largest peak smaller, "
    "then what takes most from the peak of its own mechanism. Each change is computed and checked."
)
_NOTHING = 2e-7  # of the ways in a rule, that is left where it is just kept
_NOTHING_DEG = 1e-5  # of the turn, likewise: a best design leaves about half of it, for rounding


def write_page(found: Findings, made: date, files: Sequence[Beside]) -> str:
    """Return the page as HTML; `made` is the day that stands on it, `files` are beside it."""
    machine = found.machine
    sections = (
        ("The machine in motion", moving(found)),
        ("The timing diagram", timing(found)),
        ("Rules", rules_of(found)),
        ("Mechanisms", _mechanisms(found)),
        ("What to change first", _ranking(found)),
        ("The design, and what no design can be below", _design(found)),
        ("Try it", live_figure(machine)),
        ("Files", _files(files)),
        ("How it was computed", _method(found)),
    )
    body = "".join(
        f"<section>\n<h2>{escape(head)}</h2>\n{text}</section>\n" for head, text in sections if text
    )
    day = f"<p>{made.day} {made:%B %Y}. Every number in blue opens to where it comes from.</p>\n"
    return whole_page(f"The report of {machine.name}", _STYLE, f"{day}{_summary(found)}{body}")


def _summary(found: Findings) -> str:
    machine = found.machine
    said = [paragraph(f"{machine!r}.", "broken" if machine.violations else "kept")]
    if found.best:
        today, then = machine.peaks[machine.hardest], max(found.improved.peaks.values())
        faster = of_rate(machine.diagram.rate_per_hour, today, then)
        rate = faster.rpartition(" = ")[2]
        whose = f" of {free}" if (free := free_parts(machine, "")) else ""
        said_rate = f" At the peak of today that is {rate}" if " = " in faster else ""
        said.append(
            paragraph(
                f"With all moves{whose} balanced the largest peak is {short(then)} m/s², today "
                f"{short(today)}."
                f"{said_rate}"
            )
        )
    if found.least:
        said.append(paragraph(bound_said(found)))
        said += [paragraph(held)] if (held := one_height_said(found)) else []
    if (found.best or found.least) and (left_out := stay(machine)):
        several = len(left_out) > 1
        what = "stay as they are" if several else "stays as it is"
        they = "they have" if several else "it has"
        whose = " and the ".join(left_out)
        said.append(paragraph(f"The {whose} {what}: the table does not say where {they} to stand."))
    said += [paragraph(note) for note in found.notes]
    return "".join(said)


def rules_of(found: Findings) -> str:
    """Return what each rule leaves, today and in the design, and what is to be known of it."""
    machine = found.machine
    if not machine.rules:
        return paragraph("The table has no rules.")
    reserve = {one.rule: one for one in found.left}
    rows: list[tuple[bool, Sequence[Cell]]] = []
    both = zip(machine.rules, machine.clearances, found.improved.clearances, strict=True)
    for rule, now, then in both:
        left = reserve[rule]
        whence = f"{left}. The reserve is the smaller one of early and late."
        cells: list[Cell] = [str(rule), _clearance(machine, rule, now)]
        cells.append(Opened(short(left.deg), whence))
        if found.best:
            cells.append(_clearance(found.improved, rule, then))
        rows.append((now.clearance_mm < 0, cells))
    heading = ["rule", "clearance, mm", "reserve, deg"]
    broken = "".join(paragraph(f"Broken: {one}.", "broken") for one in machine.violations)
    for rule, why in machine.idle.items():
        broken += paragraph(
            f"Nothing can break this rule, however the machine is timed, since {why}: {rule}. See "
            "whether its limit is what was meant."
        )
    for name in _pausing(machine):
        start = f"{start_deg(machine.diagram[name]):g}"
        broken += paragraph(
            f"A stop of the {name} is where a turn of its moves begins, at {start} deg: where it "
            "stands between two moves of one turn is none."
        )
    heading += ["of the design, mm"] if found.best else []
    used = sum(
        one.clearance_mm < _nothing_mm(found.improved, one.rule)
        for one in found.improved.clearances
    )
    if found.best and used:
        broken += paragraph(
            f"The design uses up {used} of {len(machine.rules)} rules: it leaves nothing for play, "
            "wear and backlash. Tighten these rules by what the machine needs, and ask again."
        )
    return broken + table("What each rule leaves; below 0 it is broken", heading, rows)


def _pausing(machine: Machine) -> Iterator[str]:
    """Yield the turrets that stand between two moves of a turn, if a limit is one from a stop."""
    ruled = [rule for rule in machine.rules if isinstance(rule, ClearanceRule)]
    halves = [half for rule in ruled for half in (rule.when, rule.only_while)]
    measured = {half.motion for half in halves if not isinstance(half, Moving)}
    for motion in machine.diagram.motions:
        at = [n for n, segment in enumerate(motion.segments) if not segment.is_dwell]
        pauses = len(at) > 1 and at[-1] - at[0] >= len(at)
        if motion.is_indexing and motion.name in measured and pauses:
            yield motion.name


def _clearance(machine: Machine, rule: Rule, one: Clearance) -> Opened | str:
    if one.angle_deg is None:
        return "never in the way" if rule in machine.idle else "kept"
    at = one.angle_deg
    there = " and ".join(_place(machine.diagram[name], at) for name in rule.motions)
    whence = f"Least at {at:.5g} deg: there {there}. {_meant(rule)}"
    value = 0.0 if abs(one.clearance_mm) < _nothing_mm(machine, rule) else one.clearance_mm
    return Opened(short(value), whence)


def _place(motion: Motion, angle_deg: float) -> str:
    from_what = " from its stop" if motion.is_indexing else ""
    return f"the {motion.name} is at {float(motion.offset_mm(angle_deg)):.4g} mm{from_what}"


def _nothing_mm(machine: Machine, rule: Rule) -> float:
    """Return a clearance that is none: by the way of a part, or by what it does meanwhile."""
    motions = [machine.diagram[name] for name in rule.motions]
    ways = [high - low for low, high in (motion.range_mm for motion in motions)]
    steepest = [motion.curve.derived(1).largest for motion in motions]
    return max(_NOTHING * max(ways), _NOTHING_DEG * max(steepest))


def _meant(rule: Rule) -> str:
    """Return in a sentence what the clearance of a rule is."""
    if not isinstance(rule, ClearanceRule):
        return "The clearance is how much farther apart they are than they have to be."
    halves = (rule.when, rule.only_while)
    if all(isinstance(half, Moving) for half in halves):
        return "Below 0 it is the way of one of them from the nearer end of its move."
    if any(isinstance(half, Moving) for half in halves):
        return (
            "The clearance is how far the one with a limit is from passing it while the other one "
            "moves, or stands, when it must not."
        )
    side = "above" if rule.when.is_beyond else "below"
    return (
        f"The {rule.when.motion} has the limit {rule.when.limit_mm:g} mm. The clearance is how far "
        f"it still is from being {side} its limit while the other one is not where it has to be."
    )


def _mechanisms(found: Findings) -> str:
    machine, improved = found.machine, found.improved
    rows: list[tuple[bool, Sequence[Cell]]] = []
    for name, moves, travel, velocity, peak in machine.rows:
        cells: list[Cell] = [name, moves, travel]
        cells.append(Opened(short(velocity), of_velocity(machine.diagram, name)))
        cells.append(Opened(short(peak), of_peak(machine.diagram, name)))
        if found.best:
            cells.append(Opened(short(improved.peaks[name]), of_peak(improved.diagram, name)))
        rows.append((False, cells))
    heading = ["mechanism", "moves", "travel, mm", "peak velocity, m/s", "peak acceleration, m/s²"]
    heading += ["of the design, m/s²"] if found.best else []
    return table("The hardest first", heading, rows)


def _ranking(found: Findings) -> str:
    machine = found.machine
    if not found.ranking:
        said = (*found.ranking.notes, found.ranking.none)
        return "".join(paragraph(one) for one in said if one)
    today = machine.peaks[machine.hardest]
    rows: list[tuple[bool, Sequence[Cell]]] = []
    for one in found.ranking:
        before = Opened(short(one.before), of_peak(machine.diagram, one.mechanism))
        after = Opened(short(one.after), of_peak(one.machine.diagram, one.mechanism))
        rate = Opened(
            rate_as_text(one.rate_per_hour),
            of_rate(machine.diagram.rate_per_hour, today, one.largest),
        )
        hardest = one.machine.hardest
        largest = Opened(short(one.largest), of_peak(one.machine.diagram, hardest))
        rows.append((False, [one.said, before, after, largest, rate]))
    heading = [
        "change",
        "peak today, m/s²",
        "then, m/s²",
        "largest of the machine then, m/s²",
        "rate at today's largest peak, pieces/h",
    ]
    caption = "One change at a time, all else as it is"
    notes = map(paragraph, (found.ranking.hardest, _ORDER, *found.ranking.notes))
    return f"{''.join(notes)}{table(caption, heading, rows)}"


def _design(found: Findings) -> str:
    parts = []
    if found.best:
        rows: list[tuple[bool, Sequence[Cell]]] = [
            (
                False,
                [
                    name,
                    f"{move.kind} {abs(move.change_mm):g} mm",
                    start_deg(move),
                    move.angle_deg,
                    as_law(move.law).name,
                ],
            )
            for name in found.improved.peaks
            for move in found.design[name].moves
        ]
        heading = ["mechanism", "move", "from, deg", "over, deg", "law"]
        parts.append(table("Starts and angles of all moves", heading, rows))
        parts.append(paragraph(design_said(found.best)))
    if found.least:
        parts.append(paragraph(bound_said(found)))
        parts.append(opened(Opened("The conditions of this bound", f"{found.least!r}")))
    return "".join(parts)


def _files(files: Sequence[Beside]) -> str:
    return f"<ul>{''.join(f'<li>{beside(one)}</li>' for one in files)}</ul>\n"


def _method(found: Findings) -> str:
    return "".join(paragraph(said) for said in _sentences(found))


def _sentences(found: Findings) -> Iterator[str]:
    yield (
        "Peaks are those of the laws' own expressions over the whole turn, not of samples. Rules "
        "are solved for: the ends of the arcs over which a condition holds are found by bisection "
        "between turning points that are proved to be all, so that no violation slips through."
    )
    yield (
        "What to change first: each mechanism by itself gets wider moves beside the others, or a "
        "gentler law with a finite jerk; narrower moves only where they mend a broken rule. Its "
        "moves are the widest about what stays of it, or the best that was found of all that stand "
        "where the table says. Where a rule or a move forbids that search, or no moves of it keep "
        "a rule that is broken today, each end is put out as far as it goes, and there may be "
        "better ones: of whom that is true, and why, is said above. Each change was checked again "
        "by the rules: it breaks none, and none that is broken by more or for longer."
    )
    if found.least:
        yield (
            "The bound holds for any motions of the parts: a mixed-integer program asks less than "
            "any motion is asked, and each linear program that it is made of is bounded by its "
            "multipliers, whatever a solver says of it. All parts are rigid in it."
        )
