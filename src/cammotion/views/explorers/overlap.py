"""The explorer of the overlap: how far one motion may go while the other is on its way."""

import math
from collections.abc import Mapping
from typing import Any

import sympy as sp

from cammotion.laws.catalogue import as_law
from cammotion.laws.motion_law import MotionLaw
from cammotion.laws.symbols import x
from cammotion.machine.clearance import ClearanceRule, as_rules
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.quantities import InputError, Quantity
from cammotion.views.explorers.moving import (
    ALPHA,
    LARGEST,
    Moving,
    Part,
    check_rests,
    control,
    heights,
    work_deg,
)
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.formulas import inverse, largest, place_of_largest
from cammotion.views.live.parts import ALARM, REFERENCE, Box, Button, Line, Panel, Say
from cammotion.views.timing_plots import describe_offset

_MOST_MARGIN_MM = 5
_LEAST_DEG = 20
_ROUNDING_MM = _NOTHING = 1e-9  # and of a stroke
B_m, START, B_MILL, MARGIN = sp.symbols("B_m start B_mill margin", nonnegative=True)
_LIMIT, _OUT, _IN, _WIDEST, _END = sp.symbols("limit out in widest end", real=True)


def explore_overlap(
    diagram: TimingDiagram, rule: ClearanceRule, *, contact_mm: float
) -> LiveFigure:
    """Return a live figure of the two motions of a clearance rule: angle, start, and margin.

    `rule.when` is about a motion with one rise and one return, which is the one to be `beyond`;
    `rule.only_while` about an indexing motion with one move, `within`. `contact_mm` is where the
    first would touch, in mm; the margin is what the rule stays short of it. The button gives the
    first the widest move about its dwell where it now is. Raises InputError for a rule of another
    kind, and for a `contact_mm` that the rule lets the motion pass.

    >>> import cammotion as cm
    >>> figure = explore_overlap(cm.EXAMPLE.diagram, cm.EXAMPLE.rule, contact_mm=20)
    >>> figure.press("Widest move of the die")
    >>> print(figure.text.splitlines()[0])
    die: 124.84 deg, from 80.163 to 205 deg, a_max = 0.806 m/s² = 0.194 × 4.154
    """
    contact = _checked(diagram, rule, contact_mm)
    die, mill = diagram[rule.when.motion], diagram[rule.only_while.motion]
    (down, up), (index,) = die.moves, mill.moves
    work = work_deg(die)
    most = (DEG_PER_TURN - work) / 2
    least = min(_LEAST_DEG, most / 2)
    moving_die, moving_mill = _die(die, (B_m, B_m), START), _mill(mill, B_MILL)
    values = {
        _LIMIT: contact - MARGIN,
        **_window(mill, rule.only_while.limit_mm),
        _END: START + B_m,
        _WIDEST: _widest(die, work, most),
    }
    as_it_was = _die(die, (down.angle_deg, up.angle_deg), down.from_deg)
    before = {mill.name: _mill(mill, index.angle_deg), die.name: as_it_was}
    angle = min(down.angle_deg, most)
    start = (down.to_deg - angle) % DEG_PER_TURN
    margin, most_margin = contact - rule.when.limit_mm, min(_MOST_MARGIN_MM, contact - die.start_mm)
    controls = {
        B_m: control(f"{die.name}: angle Bm", (least, most, 0.5), angle),
        START: control(f"{die.name}: start", (0, DEG_PER_TURN, 0.5), start),
        B_MILL: control(f"{mill.name}: angle", (40, 240, 1), index.angle_deg),
        MARGIN: control("margin", (0, most_margin, 0.1), margin, "mm"),
    }
    too_deep = moving_die.position() - _LIMIT
    too_far = moving_mill.offset() - sp.Float(rule.only_while.limit_mm)
    collides = sp.Min(too_deep, too_far, evaluate=False) - _ROUNDING_MM
    room = heights((mill, die), (moving_mill, moving_die))
    widest = sp.Piecewise((_WIDEST, least <= _WIDEST), (sp.nan, True))
    return explore(
        [
            [_timing({mill.name: moving_mill, die.name: moving_die}, before, collides, room)],
            [_map(moving_mill, moving_die, diagram, rule, collides)],
        ],
        ALPHA,
        controls,
        values=values,
        says=[
            _describe(diagram, die, moving_die),
            _describe(diagram, mill, moving_mill),
            *_verdict(die, moving_die, rule, least),
        ],
        buttons=[
            Button(
                f"Widest move of the {die.name}",
                {B_m: widest, START: sp.Mod(_END - widest, DEG_PER_TURN)},
            )
        ],
        shares=(3, 2),
        title="How far may two motions overlap?",
    )


def _die(die: Motion, angles: tuple[Any, Any], start: Any) -> Moving:
    """Return the die with its moves over two angles; its dwell keeps its length."""
    (down, up), work = die.moves, work_deg(die)
    parts = (
        Part(angles[0], down.change_mm, as_law(down.law)),
        Part(work),
        Part(angles[1], up.change_mm, as_law(up.law)),
        Part(DEG_PER_TURN - work - sum(angles)),
    )
    return Moving(start, parts, start_mm=die.start_mm)


def _mill(mill: Motion, angle: Any) -> Moving:
    """Return the mill with its move over an angle; the middle of its move stays."""
    (index,) = mill.moves
    middle = (index.from_deg + index.to_deg) / 2
    parts = (Part(angle, index.change_mm, as_law(index.law)), Part(DEG_PER_TURN - angle))
    return Moving(middle - angle / 2, parts, is_indexing=True)


def _window(mill: Motion, limit_mm: float) -> dict[sp.Symbol, sp.Expr]:
    """Return from which to which angle the mill is too far from a stop."""
    (index,) = mill.moves
    law, share = as_law(index.law), sp.Float(limit_mm / abs(mill.pitch_mm))
    start = (index.from_deg + index.to_deg) / 2 - B_MILL / 2
    return {
        _OUT: start + B_MILL * _place_in(law, share),
        _IN: start + B_MILL * _place_in(law, 1 - share),
    }


def _widest(die: Motion, work: float, most: float) -> sp.Expr:
    """Return the widest angle with which the die is free of collision about its dwell.

    It is deep from the part of its way down that brings it to the limit, to the part of its way
    up: the one has to come after the mill is in, the other to be over before it is out again.
    """
    down, up = die.moves
    share = (_LIMIT - die.start_mm) / down.change_mm
    deep_down = 1 - _place_in(as_law(down.law), share)
    deep_up = _place_in(as_law(up.law), 1 - share)
    before = sp.Mod(_END - _IN, DEG_PER_TURN)  # from where the mill is in to the dwell
    behind = DEG_PER_TURN - (_IN - _OUT) - before - work
    free = sp.Min(before / deep_down, behind / deep_up, most, evaluate=False)
    return sp.Piecewise((most, share > 1 - _NOTHING), (free, True))  # never deep


def _place_in(law: MotionLaw, way: sp.Expr) -> sp.Expr:
    """Return the x at which a law has come a share of its way; at an end of it, that end."""
    between = inverse(law.s, (x, 0, 1), way)
    start = sp.Float(_NOTHING**2)  # no 0, since a number is divided by it
    return sp.Piecewise((start, way < _NOTHING), (1, way > 1 - _NOTHING), (between, True))


def _timing(
    motions: Mapping[str, Moving], before: Mapping[str, Moving], collides: Any, room: Any
) -> Panel:
    """Return the panel of the timing diagram: as it was, as it is, and where it collides."""
    lines = [
        Line(
            y=moving.movement(),
            joints=moving.joints,
            name="" if number else "as it was",
            role=REFERENCE,
        )
        for number, moving in enumerate(before.values())
    ]
    lines += [
        Line(y=moving.movement(), joints=moving.joints, name=name, colour=number)
        for number, (name, moving) in enumerate(motions.items())
    ]
    lines += [
        Line(
            y=moving.movement(),
            joints=moving.joints,
            name="" if number else "collision",
            only_where=collides,
            role=ALARM,
        )
        for number, moving in enumerate(motions.values())
    ]
    return Panel(
        lines=lines,
        y="movement in mm",
        y_limits=room,
        x_ticks=60,
        height=300,
        title="Timing diagram",
    )


def _map(
    mill: Moving, die: Moving, diagram: TimingDiagram, rule: ClearanceRule, collides: Any
) -> Panel:
    """Return the panel of the clearance map, with the region that is forbidden."""
    near, half = rule.only_while.limit_mm, abs(diagram[rule.only_while.motion].pitch_mm) / 2
    lowest, highest = diagram[rule.when.motion].range_mm
    path = {"x": mill.offset(), "y": die.position(), "joints": [*mill.joints, *die.joints]}
    named = {"": diagram}
    return Panel(
        lines=[Line(**path, colour=1), Line(**path, only_where=collides, role=ALARM)],
        boxes=[Box(low=near, y=(_LIMIT, None), name="forbidden")],
        y=describe_offset(rule.when, named),
        x=describe_offset(rule.only_while, named),
        x_limits=(0, min(half, max(8 * near, half / 20))),
        y_limits=(lowest, highest + (highest - lowest) / 10),
        height=300,
        title="Clearance map",
    )


def _describe(diagram: TimingDiagram, motion: Motion, moving: Moving) -> Say:
    peak, before = moving.peak(diagram.rate_per_hour), diagram.peak_acceleration(motion.name)
    angle = moving.parts[0].angle
    numbers = {
        "name": motion.name,
        "angle": angle,
        "start": sp.Mod(moving.start, DEG_PER_TURN),
        "end": sp.Mod(moving.start + angle, DEG_PER_TURN),
        "peak": peak,
        "times": peak / sp.Float(before),
        "before": sp.Float(before),
    }
    text = "{name}: {angle:.5g} deg, from {start:.5g} to {end:.5g} deg, a_max = {peak:.3f} m/s²"
    return Say(
        text + " = {times:.3g} × {before:.3f}",
        numbers,
        peak < LARGEST,
        Say(text + ", as before", numbers),
    )


def _verdict(die: Motion, moving: Moving, rule: ClearanceRule, least: float) -> list[Say]:
    """Return what is said of the collision, or of the room that is left."""
    window = (ALPHA, _OUT, _IN)
    room = _LIMIT - largest(moving.position(), window)
    place = sp.Mod(place_of_largest(moving.position(), window), DEG_PER_TURN)
    numbers = {
        "room": sp.Max(room - _ROUNDING_MM, 0, evaluate=False),
        "excess": -room,
        "at": place,
        "die": die.name,
    }
    numbers |= {"mill": rule.only_while.motion, "within": str(rule.only_while)}
    return [
        Say(
            "COLLISION: the {die} is {excess:.3g} mm too deep at {at:.5g} deg, while the {mill} is "
            "not {within}",
            numbers,
            room < -_ROUNDING_MM,
            Say("No collision. The smallest clearance is {room:.3g} mm, at {at:.4g} deg.", numbers),
        ),
        Say(
            f"About this dwell the {{die}} has no move of {least:g} deg or more that is free of "
            "collision: move its start.",
            numbers,
            least > _WIDEST,
        ),
    ]


def _checked(diagram: Any, rule: Any, contact_mm: Any) -> float:
    as_rules(diagram, rule)
    contact = Quantity("position of contact", "mm", example=20, low=-math.inf).number(contact_mm)
    die, mill = diagram[rule.when.motion], diagram[rule.only_while.motion]
    shapes = [segment.kind for segment in die.moves] == ["rise", "return"] and mill.is_indexing
    sides = rule.when.is_beyond and not rule.only_while.is_beyond
    limit, near = rule.when.limit_mm, rule.only_while.limit_mm
    if not (shapes and sides and len(mill.moves) == 1 and limit <= contact):
        raise InputError(
            f"The rule '{rule}' cannot be explored: give one in which a motion that rises and "
            "returns once may be beyond a limit, short of contact_mm, only while an indexing "
            "motion with one move is within another."
        )
    if not (
        die.start_mm <= limit and die.start_mm < contact and 0 <= near < abs(mill.pitch_mm) / 2
    ):
        raise InputError(
            f"The rule '{rule}' is broken always or never, however the motions overlap: give a "
            f"limit of the {die.name} above its start, {die.start_mm:g} mm, and one of the "
            f"{mill.name} from 0 to half of its pitch, {abs(mill.pitch_mm) / 2:g} mm."
        )
    if not all(as_law(move.law).is_monotone for move in (*die.moves, *mill.moves)):
        raise InputError(
            f"A law of the {die.name} or the {mill.name} turns back on its way, and this explorer "
            "looks for one place only: give laws that do not, or ask widest_move."
        )
    check_rests((die, mill))
    return contact
