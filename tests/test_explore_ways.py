"""The explorer of the two ways, without a browser: what it judges, against the package's solver."""

import re

import numpy as np
import pytest
from explored import at_corners, drawn, lines_of
from machines import RULE, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion.views.explorers.ways import RETURN, RISE, WORK
from cammotion.views.live.figure import LiveFigure

DIAGRAM = make_diagram()
AT = np.linspace(0.013, 359.987, 400)
TURN = "rise (.*) deg from (.*) deg on, work (.*) deg, return (.*) deg, rest (.*) deg"
ROUNDING_DEG = 1e-6


@pytest.fixture
def figure() -> LiveFigure:
    return cm.explore_ways(DIAGRAM, RULE)


def set_die(rise: float, back: float, work: float) -> cm.TimingDiagram:
    """Return the diagram with a die of these angles, its work about 255 deg."""
    rest = 360 - rise - back - work
    die = cm.motion(
        "die",
        cm.rise(50, over_deg=rise),
        cm.dwell(work),
        cm.return_(50, over_deg=back),
        *([cm.dwell(rest)] if rest > ROUNDING_DEG else []),
        start_deg=255 - work / 2 - rise,
    )
    return DIAGRAM.with_motion(die)


def check(figure: LiveFigure) -> None:
    """Compare all that is said and drawn with the diagram that the controls stand for."""
    rise, back, work = figure.values.values()
    diagram, text = set_die(rise, back, work), figure.text
    ((*angles,),) = [map(float, found) for found in re.findall(TURN, text)]
    wanted = rise, (255 - work / 2 - rise) % 360, work, back, 360 - rise - back - work
    assert angles == pytest.approx(wanted, abs=0.01)
    peaks = [float(said) for said in re.findall(r"([\d.]+) m/s²", text)]
    assert peaks == pytest.approx([cm.peak_acceleration(50, w, 2000) for w in (rise, back)], 1e-3)
    violations = cm.find_violations(diagram, RULE)
    assert ("RULE BROKEN" in text) == bool(violations)
    if violations:
        excess = float(re.findall(r"is ([^ ]*) mm too deep", text)[0])
        assert excess == pytest.approx(max(v.excess_mm for v in violations), rel=6e-3)
    position = lines_of(figure, "Timing")[1]["y"]
    assert drawn(figure, position, AT) == pytest.approx(diagram.position_mm("die", AT), abs=1e-6)


def test_every_corner_of_the_controls(figure: LiveFigure) -> None:
    for _ in at_corners(figure, RISE, RETURN, WORK):
        assert sum(figure.values.values()) <= 360 + ROUNDING_DEG
        check(figure)
    assert figure.picture()


def test_what_is_moved_takes_from_the_others_where_the_turn_is_full(figure: LiveFigure) -> None:
    figure.values = {RISE: 140, RETURN: 120}
    assert "rest 0 deg" in figure.text
    figure.values = {RISE: 200}
    assert figure.values == {RISE: 200, RETURN: 60, WORK: 100}
    check(figure)


def test_the_widest_rise_and_a_shorter_work(figure: LiveFigure) -> None:
    figure.values = {RISE: 124.9, RETURN: 120}
    assert "The rule is kept" in figure.text
    figure.values = {RISE: 125}
    assert "RULE BROKEN" in figure.text
    figure.values = {RISE: 150, WORK: 60}
    figure.values = {RETURN: 150}
    assert (
        "a_max = 0.559 m/s² on the rise, 0.559 m/s² on the return\nThe rule is kept" in figure.text
    )


def test_ways_need_a_rule_between_a_die_and_a_mill() -> None:
    with pytest.raises(cm.InputError, match="cannot be explored: give one in"):
        cm.explore_ways(
            make_diagram(make_mill(), make_die()),
            cm.ClearanceRule(cm.beyond("mill", 19), only_while=cm.within("die", 0.65)),
        )
