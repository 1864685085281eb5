"""The explorer of the two ways: a rise and a return over angles of their own, beside a mill."""

from collections.abc import Iterator
from dataclasses import replace

import sympy as sp

from cammotion.arguments import checked
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.machine.motions import Motion
from cammotion.rules.clearance import ClearanceRule
from cammotion.views.explorers.clearance import (
    LIMIT,
    NOTHING,
    die_over,
    linked,
    mill_over,
    panels,
    verdict,
    window,
)
from cammotion.views.explorers.moving import ALPHA, Moving, control, of_peaks, work_deg
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import Say

_LEAST_DEG, _MOST_DEG, _MOST_WORK_DEG = 20, 200, 140  # 200 + 140 + 20 are a turn
RISE, RETURN, WORK = sp.symbols("rise return work", positive=True)


@checked
def explore_ways(diagram: TimingDiagram, rule: ClearanceRule) -> LiveFigure:
    """Return a live figure of a clearance rule: rise, return and work of a motion, in deg.

    `rule.when` is about a motion with one rise and one return, which is the one to be `beyond`;
    `rule.only_while` about an indexing motion with one move, `within`. The middle of the work, the
    dwell between rise and return, stays; where the three would be longer than a turn, another gives
    way. `figure.values` are rise, return and work. Raises InputError for a rule of another kind.

    >>> import cammotion as cm
    >>> figure = explore_ways(cm.EXAMPLE.diagram, cm.EXAMPLE.rule)
    >>> figure.values = {RISE: 140, RETURN: 120}
    >>> print(figure.text.splitlines()[0])
    die: rise 140 deg from 65 deg on, work 100 deg, return 120 deg, rest 0 deg
    """
    both = linked(diagram, rule, rule.when.limit_mm)
    diagram, rule, die, mill, _, in_full = both
    (down, up), (index,) = die.moves, mill.moves
    middle = (down.to_deg + up.from_deg) / 2
    moving_die = die_over(die, (RISE, RETURN), WORK, middle - WORK / 2 - RISE)
    moving_mill = mill_over(mill, index.angle_deg)
    as_it_was = die_over(die, (down.angle_deg, up.angle_deg), work_deg(die))
    ways = {RISE: ("rise", down.angle_deg), RETURN: ("return", up.angle_deg)}
    spans = dict.fromkeys(ways, (_LEAST_DEG, _MOST_DEG, 0.5))
    ways[WORK], spans[WORK] = ("work", work_deg(die)), (_LEAST_DEG, _MOST_WORK_DEG, 1)
    return explore(
        panels(both, (moving_mill, moving_die), (moving_mill, as_it_was)),
        ALPHA,
        {
            symbol: replace(
                control(f"{die.name}: {name}", spans[symbol], start),
                most=DEG_PER_TURN - sum(other for other in ways if other != symbol),
            )
            for symbol, (name, start) in ways.items()
        },
        values={
            LIMIT: rule.when.limit_mm,
            **window(mill, rule.only_while.limit_mm, sp.Float(index.angle_deg)),
        },
        says=[
            *_describe(diagram, die, moving_die),
            verdict(die, moving_die, rule),
            *in_full,
        ],
        shares=(3, 2),
        title="Two ways of their own",
    )


def _describe(diagram: TimingDiagram, die: Motion, moving: Moving) -> Iterator[Say]:
    """Return what is said of the turn, and of the peaks of both ways."""
    rest = DEG_PER_TURN - RISE - RETURN - WORK
    text = (
        "{name}: rise {rise:.5g} deg from {start:.5g} deg on, work {work:.5g} deg, "
        "return {back:.5g} deg, rest {rest:.5g} deg"
    )
    numbers = {
        "name": die.name,
        "rise": RISE,
        "start": sp.Mod(moving.start, DEG_PER_TURN),
        "work": WORK,
        "back": RETURN,
        "rest": sp.Piecewise((0, rest < NOTHING), (rest, True)),
    }
    yield Say(text, numbers)
    down, up = (
        replace(moving, parts=(part,)).peak(diagram.rate_per_hour)
        for part in (moving.parts[0], moving.parts[2])
    )
    digits = of_peaks(diagram)
    text = f"a_max = {{down:{digits}}} m/s² on the rise, {{up:{digits}}} m/s² on the return"
    yield Say(f"{{name}}: {text}", {"name": die.name, "down": down, "up": up})
