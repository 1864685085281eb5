"""What `least_acceleration` finds is looked at once more, and a wrong answer is none."""

import math
import re
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from machines import DOWN_DEG, RULE, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion.limits import least
from cammotion.limits.corridors import corridor
from cammotion.limits.faults import Asked, find_faults
from cammotion.limits.linear import Solution
from cammotion.limits.programs import from_below

FREE = (-math.inf, math.inf)
STAYING = Asked([RULE], [DOWN_DEG], FREE, math.inf)


def test_the_motion_of_the_diagram_itself_has_no_faults() -> None:
    diagram = make_diagram()
    travel = (0, 50)
    for jerk in (math.inf, diagram.peak_jerk("die")):
        assert list(find_faults(diagram, make_die(), Asked([RULE], [DOWN_DEG], travel, jerk))) == []
        mill = Asked([RULE], [(200, 300), (-160, -60), (560, 660)], (0, 100), jerk)
        assert list(find_faults(diagram, make_mill(), mill)) == []


FAULTS: list[tuple[cm.Motion, dict[str, Any], str]] = [
    (make_die(129), {}, "the die is .* mm too deep"),
    (make_die(down_deg=(206, 305)), {}, "from 205 to 305 deg it does not stand"),
    (make_die(down_deg=(205, 304)), {}, "from 205 to 305 deg it does not stand"),
    (make_die(stroke_mm=49), {}, "from 205 to 305 deg it does not stand"),
    (make_die(), {"travel_mm": (0, 49.9)}, "it goes from 0 to 50 mm"),
    (make_die(), {"travel_mm": (0.1, 51)}, "it goes from 0 to 50 mm"),
    (make_die(), {"jerk_limit": 94}, "it changes its acceleration faster than by 94 m/s³"),
    (make_die(law="constant acceleration"), {"jerk_limit": 1e4}, "it changes its acceleration fa"),
    (make_mill(middle_deg=140), {}, "the die is .* mm too deep"),
    (make_mill(200), {"still": [(200, 345)]}, "from 200 to 345 deg it does not stand"),
    (make_mill(), {"travel_mm": (0, 99)}, "it goes from 0 to 100 mm"),
]


@pytest.mark.parametrize(("motion", "changes", "said"), FAULTS)
def test_a_motion_that_does_not_keep_what_was_asked(
    motion: cm.Motion, changes: dict[str, Any], said: str
) -> None:
    faults = list(find_faults(make_diagram(), motion, STAYING._replace(**changes)))
    assert any(re.match(said, fault) for fault in faults), faults


def test_rules_of_others_are_not_its_affair() -> None:
    gate = cm.motion("gate", cm.rise(50, over_deg=50), cm.return_(50, over_deg=50), cm.dwell(260))
    others = cm.ClearanceRule(cm.beyond("gate", 5), only_while=cm.within("mill", 0.65))
    diagram = make_diagram(make_mill(), make_die(), gate)
    assert cm.find_violations(diagram, others)
    assert list(find_faults(diagram, make_die(), STAYING._replace(rules=[others, RULE]))) == []
    with_it, without = (
        cm.least_acceleration(diagram, "die", rules, still=[DOWN_DEG], cells=36)
        for rules in ([others, RULE], RULE)
    )
    assert with_it.bound == without.bound


def test_a_bound_above_a_motion_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:

    def wrong(*given: Any) -> Solution:
        return from_below(*given)._replace(bound=1.1 * from_below(*given).bound)

    monkeypatch.setattr(least, "from_below", wrong)
    with pytest.raises(cm.WrongAnswerError, match=r"^least_acceleration has checked its answer an"):
        cm.least_acceleration(make_diagram(), "die", RULE, still=[DOWN_DEG], cells=90)


def test_a_motion_that_breaks_a_rule_is_no_answer(monkeypatch: pytest.MonkeyPatch) -> None:

    def wider(*given: Any, **more: Any) -> Any:
        room = corridor(*given, **more)
        return replace(room, high_mm=np.where(room.high_mm == 19, 19.1, room.high_mm))

    monkeypatch.setattr(least, "corridor", wider)
    with pytest.raises(cm.WrongAnswerError, match=r"the die is 0\.1 mm too deep at"):
        cm.least_acceleration(make_diagram(), "die", RULE, still=[DOWN_DEG], cells=90)
