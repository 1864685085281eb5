"""The explorer of the timing diagram: one turn shared out between two mechanisms, in sequence."""

from collections.abc import Iterator, Mapping
from typing import Any

import sympy as sp

from cammotion.arguments import checked
from cammotion.machine.diagram import TimingDiagram
from cammotion.machine.kinematics import DEG_PER_TURN
from cammotion.quantities import InputError
from cammotion.views.explorers.clearance import die_over, mill_over
from cammotion.views.explorers.moving import (
    ALPHA,
    check_rests,
    control,
    full_names,
    heights,
    of_peaks,
    work_deg,
)
from cammotion.views.lanes import TICK_DEG
from cammotion.views.live.explore import explore
from cammotion.views.live.figure import LiveFigure
from cammotion.views.live.parts import Line, Panel, Say
from cammotion.views.named import short_diagram
from cammotion.views.plots import CURVES

_SHARED_DEG = DEG_PER_TURN - 2 * 10  # what is left at least for each way of the tool is 10 deg
B_MILL, WORK = sp.symbols("B_mill work", positive=True)


@checked
def explore_shares(diagram: TimingDiagram) -> LiveFigure:
    """Return a live figure of how two mechanisms share out the turn when they move in sequence.

    `diagram` holds an indexing motion with one move and after it a motion that rises and returns
    once. The controls are the angle of the first and the dwell of the second at its far end, in
    deg; its two moves get what is left. Raises InputError for another diagram.

    >>> import cammotion as cm
    >>> figure = explore_shares(cm.EXAMPLE.diagram)
    >>> figure.values = {B_MILL: 100}
    >>> print(figure.text.splitlines()[1])
    die: moves over 80 and 80 deg, a_max = 1.963 m/s²
    """
    _check(diagram)
    mill, die = short_diagram(diagram).motions
    (index,) = mill.moves
    work = work_deg(die)
    most = min(max(_SHARED_DEG / 2, index.angle_deg), _SHARED_DEG - work)
    way = (DEG_PER_TURN - B_MILL - WORK) / 2
    first = mill_over(mill, B_MILL, index.from_deg)
    second = die_over(die, (way, way), WORK, index.from_deg + B_MILL)
    rate = diagram.rate_per_hour
    names = (mill.name, die.name)
    both = list(zip(names, (first, second), strict=True))
    over: dict[str, Any] = {"x_ticks": TICK_DEG, "height": 170}
    panels = [
        Panel(
            lines=[moving.line(name=name) for name, moving in both],
            y="displacement in mm",
            y_limits=heights(diagram.motions, (first, second)),
            **over,
        ),
        Panel(
            lines=[Line(y=m.acceleration(rate), joints=m.joints, name=name) for name, m in both],
            y=CURVES["acceleration"],
            **over,
        ),
    ]
    return explore(
        panels,
        ALPHA,
        {
            B_MILL: control(f"{mill.name}: angle", (20, most, 1), index.angle_deg),
            WORK: control(f"{die.name}: at work", (20, _SHARED_DEG - most, 1), work),
        },
        says=[
            *_sentences(
                of_peaks(diagram),
                {"name": mill.name, "angle": B_MILL, "peak": first.peak(rate)},
                {"name": die.name, "angle": way, "peak": second.peak(rate)},
            ),
            *full_names(diagram),
        ],
        title="One turn for two mechanisms",
    )


def _sentences(digits: str, first: Mapping[str, Any], second: Mapping[str, Any]) -> Iterator[Say]:
    """Say over which angles both move and how hard, and which is the harder driven."""
    peak = f"a_max = {{peak:{digits}}} m/s²"
    yield Say(f"{{name}}: moves over {{angle:.5g}} deg, {peak}", first)
    yield Say(f"{{name}}: moves over {{angle:.5g}} and {{angle:.5g}} deg, {peak}", second)
    larger = f"larger peak: {{name}}, {{peak:{digits}}} m/s²"
    is_first = first["peak"] >= second["peak"]
    yield Say(larger, first, when=is_first, otherwise=Say(larger, second))


def _check(diagram: TimingDiagram) -> None:
    motions = diagram.motions
    kinds = [[segment.kind for segment in moved.moves] for moved in motions]
    if kinds != [["rise"], ["rise", "return"]] or not motions[0].is_indexing:
        raise InputError(
            "The turn of this diagram cannot be shared out: give a TimingDiagram of an indexing "
            "motion with one rise and a motion with one rise and one return, in this order."
        )
    mill, die = motions
    taken = mill.moves[0].angle_deg + work_deg(die)
    if taken >= _SHARED_DEG:
        raise InputError(
            f"The move of the {mill.name} and the work of the {die.name} take "
            f"{taken:g} deg of the turn: leave more than 20 deg for the two ways of the latter."
        )
    check_rests(motions)
