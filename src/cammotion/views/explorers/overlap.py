"""The explorer of the overlap: how far one motion may go while the other is on its way."""

import sympy as sp

from cammotion.arguments import checked
from cammotion.laws.catalogue import as_law
from cammotion.machine.arcs import ROUNDING_DEG
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.machine.segments import told
from cammotion.quantities import InputError
from cammotion.rules.clearance import ClearanceRule
from cammotion.views.explorers.clearance import (
    IN,
    LIMIT,
    NOTHING,
    OUT,
    die_over,
    linked,
    mill_over,
    panels,
    place_in,
    verdict,
    window,
)
from cammotion.views.explorers.moving import ALPHA, LARGEST, Moving, control, of_peaks, work_deg
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import Button, Say, choice

_MARGINS_MM = 0, 1, 2, 3, 5
_LEAST_DEG = 20
B_m, START, B_MILL = sp.symbols("B_m start B_mill", nonnegative=True)
_WIDEST, _END = sp.symbols("widest end", real=True)


@checked
def explore_overlap(
    diagram: TimingDiagram, rule: ClearanceRule, *, contact_mm: float
) -> LiveFigure:
    """Return a live figure of the two motions of a clearance rule: angle, start, and margin.

    `rule.when` is about a motion with one rise and one return over one angle, which is the one to
    be `beyond` (of two angles, see `explore_ways`); `rule.only_while` about an indexing motion with
    one move, `within`. `contact_mm` is where the first would touch, in mm; the margin is what the
    rule stays short of it. The button gives the first the widest move about its dwell where it now
    is. Raises InputError for a rule of another kind, for a rise and a return over two angles, and
    for a `contact_mm` that the rule lets the motion pass.

    >>> import cammotion as cm
    >>> figure = explore_overlap(cm.EXAMPLE.diagram, cm.EXAMPLE.rule, contact_mm=20)
    >>> figure.press("Widest move of the die")
    >>> print(figure.text.splitlines()[0])
    die: 124.84 deg, from 80.163 to 205 deg, a_max = 0.806 m/s² = 0.194 × 4.154
    """
    both = linked(diagram, rule, contact_mm)
    diagram, rule, die, mill, contact, in_full = both
    (down, up), (index,) = die.moves, mill.moves
    if abs(down.angle_deg - up.angle_deg) > ROUNDING_DEG:
        raise InputError(
            f"The {die.name} rises over {told(down.angle_deg)} deg and returns over "
            f"{told(up.angle_deg)} deg, and this explorer has one angle for both: use explore_ways."
        )
    work = work_deg(die)
    most = (DEG_PER_TURN - work) / 2
    least = min(_LEAST_DEG, most / 2)
    moving_die, moving_mill = die_over(die, (B_m, B_m), work, START), mill_over(mill, B_MILL)
    values = {
        LIMIT: contact - _margin(contact - rule.when.limit_mm, contact - die.start_mm),
        **window(mill, rule.only_while.limit_mm, B_MILL),
        _END: START + B_m,
        _WIDEST: _widest(die, work, most),
    }
    before = mill_over(mill, index.angle_deg), die_over(die, (down.angle_deg, up.angle_deg), work)
    controls = {
        B_m: control(f"{die.name}: angle Bm", (least, most, 0.5), down.angle_deg),
        START: control(f"{die.name}: start", (0, DEG_PER_TURN, 0.5), down.from_deg % DEG_PER_TURN),
        B_MILL: control(f"{mill.name}: angle", (40, 240, 1), index.angle_deg),
    }
    widest = sp.Piecewise((_WIDEST, least <= _WIDEST), (sp.nan, True))
    return explore(
        panels(both, (moving_mill, moving_die), before),
        ALPHA,
        controls,
        values=values,
        says=[
            _describe(diagram, die, moving_die),
            _describe(diagram, mill, moving_mill),
            verdict(die, moving_die, rule),
            Say(
                f"About this dwell the {{die}} has no move of {least:g} deg or more that keeps the "
                "rule: move its start.",
                {"die": die.name},
                least > _WIDEST,
            ),
            *in_full,
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


def _margin(own: float, most: float) -> sp.Expr:
    """Return the margin in mm that is chosen, first its `own`, of those that the die can keep."""
    margins = sorted({own, *(margin for margin in _MARGINS_MM if margin <= most)})
    named = {f"{margin:.4g} mm": margin for margin in margins} | {f"{own:.4g} mm": own}
    return choice("margin", named, start=f"{own:.4g} mm")


def _widest(die: Motion, work: float, most: float) -> sp.Expr:
    """Return the widest angle with which the die keeps the rule about its dwell.

    It is deep from the part of its way down that brings it to the limit, to the part of its way
    up: the one has to come after the mill is in, the other to be over before it is out again.
    """
    down, up = die.moves
    share = (LIMIT - die.start_mm) / down.change_mm
    deep_down = 1 - place_in(as_law(down.law), share)
    deep_up = place_in(as_law(up.law), 1 - share)
    before = sp.Mod(_END - IN, DEG_PER_TURN)  # from where the mill is in to the dwell
    behind = DEG_PER_TURN - (IN - OUT) - before - work
    free = sp.Min(before / deep_down, behind / deep_up, most, evaluate=False)
    return sp.Piecewise((most, share > 1 - NOTHING), (free, True))  # never deep


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
    digits = of_peaks(diagram)
    moves = "{name}: {angle:.5g} deg, from {start:.5g} to {end:.5g} deg"
    text = f"{moves}, a_max = {{peak:{digits}}} m/s²"
    return Say(
        f"{text} = {{times:.3g}} × {{before:{digits}}}",
        numbers,
        peak < LARGEST,
        Say(text + ", as before", numbers),
    )
