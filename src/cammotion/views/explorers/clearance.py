"""What explorers of a clearance rule share: its two motions over other angles, and the verdict."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import sympy as sp

from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.symbols import x
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import InputError, Quantity
from cammotion.rules.checks import as_rules
from cammotion.rules.clearance import ClearanceRule
from cammotion.views.explorers.moving import (
    ALPHA,
    Moving,
    Part,
    check_rests,
    full_names,
    heights,
    of_lengths,
)
from cammotion.views.live.formulas import inverse, largest, place_of_largest
from cammotion.views.live.parts import ALARM, REFERENCE, Box, Line, Panel, Say
from cammotion.views.named import short_diagram, short_rule
from cammotion.views.names import short
from cammotion.views.timing_plots import describe_offset

ROUNDING_MM = NOTHING = 1e-9  # and of a stroke
_MAP_COLUMNS = 12  # of a name below the map, which is narrow
LIMIT, OUT, IN = sp.symbols("limit out in", real=True)  # where the die is deep, the mill away


class Linked(NamedTuple):
    """A die and a mill that a rule links, under short names, and where the die would touch."""

    diagram: TimingDiagram
    rule: ClearanceRule
    die: Motion
    mill: Motion
    contact_mm: float
    in_full: list[Say]  # what the short names stand for


def linked(diagram: TimingDiagram, rule: ClearanceRule, contact_mm: Any) -> Linked:
    """Return what a rule links; raise InputError for a rule that cannot be explored."""
    rule, contact = _checked(diagram, rule, contact_mm)
    in_full = full_names(diagram, rule.when.motion, rule.only_while.motion)
    diagram, rule = short_diagram(diagram), short_rule(diagram, rule)
    die, mill = diagram[rule.when.motion], diagram[rule.only_while.motion]
    return Linked(diagram, rule, die, mill, contact, in_full)


def die_over(die: Motion, angles: tuple[Any, Any], work: Any, start: Any = None) -> Moving:
    """Return the die with its moves and its work over other angles, from a start or its own."""
    down, up = die.moves
    parts = (
        Part(angles[0], down.change_mm, as_law(down.law)),
        Part(work),
        Part(angles[1], up.change_mm, as_law(up.law)),
        Part(DEG_PER_TURN - work - sum(angles)),
    )
    return Moving(down.from_deg if start is None else start, parts, start_mm=die.start_mm)


def mill_over(mill: Motion, angle: Any, start: Any = None) -> Moving:
    """Return the mill with its move over an angle, from a start; else the middle of it stays."""
    (index,) = mill.moves
    begin = (index.from_deg + index.to_deg) / 2 - angle / 2 if start is None else start
    parts = (Part(angle, index.change_mm, as_law(index.law)), Part(DEG_PER_TURN - angle))
    return Moving(begin, parts, is_indexing=True)


def window(mill: Motion, limit_mm: float, angle: Any) -> dict[sp.Symbol, sp.Expr]:
    """Return from which to which angle the mill, moving over an angle, is too far from a stop."""
    (index,) = mill.moves
    law, share = as_law(index.law), sp.Float(limit_mm / abs(mill.pitch_mm))
    start = (index.from_deg + index.to_deg) / 2 - angle / 2
    return {
        OUT: start + angle * place_in(law, share),
        IN: start + angle * place_in(law, 1 - share),
    }


def place_in(law: MotionLaw, way: sp.Expr) -> sp.Expr:
    """Return the x at which a law has come a share of its way; at an end of it, that end."""
    between = inverse(law.s, (x, 0, 1), way)
    start = sp.Float(NOTHING**2)  # no 0, since a number is divided by it
    return sp.Piecewise((start, way < NOTHING), (1, way > 1 - NOTHING), (between, True))


def verdict(die: Motion, moving: Moving, rule: ClearanceRule) -> Say:
    """Return what is said of the broken rule, or of the room that is left."""
    between = (ALPHA, OUT, IN)
    room = LIMIT - largest(moving.position(), between)
    place = sp.Mod(place_of_largest(moving.position(), between), DEG_PER_TURN)
    mm = of_lengths(die.range_mm[1] - die.range_mm[0])
    numbers = {
        "room": sp.Max(room - ROUNDING_MM, 0, evaluate=False),
        "excess": -room,
        "at": place,
        "die": die.name,
        "mill": rule.only_while.motion,
        "within": str(rule.only_while),
    }
    return Say(
        f"RULE BROKEN: the {{die}} is {{excess:{mm}}} mm too deep at {{at:.5g}} deg, while the "
        "{mill} is not {within}",
        numbers,
        room < -ROUNDING_MM,
        Say(
            f"The rule is kept. At the tightest place, {{at:.4g}} deg, {{room:{mm}}} mm are left.",
            numbers,
        ),
    )


def panels(
    both: Linked, moving: tuple[Moving, Moving], before: tuple[Moving, Moving]
) -> list[list[Panel]]:
    """Return timing diagram and clearance map of mill and die, as they are and as they were."""
    rule, mill, die = both.rule, both.mill, both.die
    moving_mill, moving_die = moving
    too_deep = moving_die.position() - LIMIT
    too_far = moving_mill.offset() - sp.Float(rule.only_while.limit_mm)
    broken = sp.Min(too_deep, too_far, evaluate=False) - ROUNDING_MM
    room = heights((mill, die), moving)
    return [
        [_timing({mill.name: moving_mill, die.name: moving_die}, before, broken, room)],
        [_map(both, moving_mill, moving_die, broken)],
    ]


def _timing(
    motions: Mapping[str, Moving], before: tuple[Moving, Moving], broken: Any, room: Any
) -> Panel:
    """Return the panel of the timing diagram: as it was, as it is, and where the rule is broken."""
    lines = [
        moving.line(name="" if number else "as it was", role=REFERENCE)
        for number, moving in enumerate(before)
    ]
    lines += [
        moving.line(name=name, colour=number)
        for number, (name, moving) in enumerate(motions.items())
    ]
    lines += [
        moving.line(name="" if number else "rule broken", only_where=broken, role=ALARM)
        for number, moving in enumerate(motions.values())
    ]
    return Panel(
        lines=lines,
        y="displacement in mm",
        y_limits=room,
        x_ticks=60,
        height=300,
        title="Timing diagram",
    )


def _map(both: Linked, mill: Moving, die: Moving, broken: Any) -> Panel:
    """Return the panel of the clearance map, with the region that is forbidden."""
    near, half = both.rule.only_while.limit_mm, abs(both.mill.pitch_mm) / 2
    lowest, highest = both.die.range_mm
    path = {"x": mill.offset(), "y": die.position(), "joints": [*mill.joints, *die.joints]}
    return Panel(
        lines=[Line(**path, colour=1), Line(**path, only_where=broken, role=ALARM)],
        boxes=[Box(low=near, y=(LIMIT, None), name="forbidden")],
        y=describe_offset(both.die, both.die.name),
        x=describe_offset(both.mill, short(both.mill.name, _MAP_COLUMNS)),
        x_limits=(0, min(half, max(8 * near, half / 20))),
        y_limits=(lowest, highest + (highest - lowest) / 10),
        height=300,
        title="Clearance map",
    )


def _checked(diagram: Any, rule: Any, contact_mm: Any) -> tuple[ClearanceRule, float]:
    (rule,) = as_rules(diagram, rule)
    contact = Quantity("position of contact", "mm", example=20, low=-math.inf).number(contact_mm)
    die, mill = diagram[rule.when.motion], diagram[rule.only_while.motion]
    shapes = [segment.kind for segment in die.moves] == ["rise", "return"] and mill.is_indexing
    sides = rule.when.is_beyond and not rule.only_while.is_beyond
    limit, near = rule.when.limit_mm, rule.only_while.limit_mm
    if not (shapes and sides and len(mill.moves) == 1):
        raise InputError(
            f"The rule '{rule}' cannot be explored: give one in which a motion that rises and "
            "returns once may be beyond a limit only while an indexing motion with one move is "
            "within another."
        )
    if limit > contact:
        raise InputError(
            f"The position of contact is {contact:g} mm, and the rule '{rule}' lets the "
            f"{die.name} pass it: give a contact_mm of at least {limit:g} mm."
        )
    if not (die.start_mm <= limit and die.start_mm < contact and near < abs(mill.pitch_mm) / 2):
        raise InputError(
            f"The rule '{rule}' is broken always or never, however the motions overlap: give a "
            f"limit of the {die.name} above its start, {die.start_mm:g} mm, and one of the "
            f"{mill.name} below half of its pitch, {abs(mill.pitch_mm) / 2:g} mm."
        )
    if not all(as_law(move.law).is_monotone for move in (*die.moves, *mill.moves)):
        raise InputError(
            f"A law of the {die.name} or the {mill.name} turns back on its way, and this explorer "
            "looks for one place only: give laws that do not, or ask widest_move."
        )
    check_rests((die, mill))
    return rule, contact
