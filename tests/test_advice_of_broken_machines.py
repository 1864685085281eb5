"""Advice for machines whose rules are broken: what is there is found, what is not is not claimed.

The second way samples positions by the laws' formulas, which are written here once more.
"""

import math
from collections.abc import Callable, Mapping

import numpy as np
import pytest
from machines import Array

import cammotion as cm
from cammotion.advice import changes, ranking, widening
from cammotion.quantities import WrongAnswerError

ANGLES: Array = np.arange(0, 360, 0.01)
TRAPEZOID = "modified trapezoid"
WAYS: Mapping[str, Callable[[Array], Array]] = {
    "cycloidal": lambda x: x - np.sin(2 * np.pi * x) / (2 * np.pi),
    "3-4-5 polynomial": lambda x: x**3 * (10 - 15 * x + 6 * x**2),
    "4-5-6-7 polynomial": lambda x: x**4 * (35 - 84 * x + 70 * x**2 - 20 * x**3),
}


def die(law: str, angles: tuple[float, float, float], start_deg: float) -> cm.Motion:
    """Return a die that goes 50 mm, over three angles: rise, dwell and return."""
    rise, dwell, back = angles
    up, down = cm.rise(50, over_deg=rise, law=law), cm.return_(50, over_deg=back, law=law)
    rest = cm.dwell(360 - sum(angles))
    return cm.motion("die", up, cm.dwell(dwell), down, rest, start_deg=start_deg)


def mill(law: str, over_deg: float = 150, start_deg: float = 0) -> cm.Motion:
    move = cm.rise(100, over_deg=over_deg, law=law)
    return cm.indexing_motion("mill", move, cm.dwell(360 - over_deg), stops=24, start_deg=start_deg)


def machine(one: cm.Motion, other: cm.Motion, limit_mm: float) -> cm.Machine:
    rule = cm.ClearanceRule(cm.beyond("die", limit_mm), only_while=cm.within("mill", 0.65))
    return cm.Machine("m", cm.TimingDiagram([one, other], 2000), [rule])


POLYNOMIAL = "3-4-5 polynomial"
CURVED = machine(die(POLYNOMIAL, (70.8, 68.8, 61.6), 5.9), mill(POLYNOMIAL), 41.16)
STUCK = machine(die(TRAPEZOID, (30, 100, 30), 100), mill(TRAPEZOID, 80, 150), 19)
ABSURD = machine(die(POLYNOMIAL, (71.9, 56.0, 92.6), 33.1), mill(POLYNOMIAL), 33.06)


def offsets(motion: cm.Motion) -> Array:
    """Return where a motion is over the turn, a turret from its nearest stop."""
    start, found = motion.start_deg, np.full(len(ANGLES), motion.start_mm)
    phase = start + np.mod(ANGLES - start, 360)
    for move in motion.moves:
        way = np.clip((phase - move.from_deg) / (move.to_deg - move.from_deg), 0, 1)
        law = move.law if isinstance(move.law, str) else move.law.name  # type: ignore[union-attr]
        found = found + (move.to_mm - move.from_mm) * WAYS[law](way)
    away = np.mod(found - motion.start_mm, 100)
    return np.asarray(np.minimum(away, 100 - away) if motion.is_indexing else found)


def broken(diagram: cm.TimingDiagram, limit_mm: float) -> tuple[float, float]:
    """Return how far the die is too deep while the mill is not within 0.65 mm, and how long."""
    deep = (offsets(diagram["die"]) - limit_mm)[offsets(diagram["mill"]) > 0.65]
    return float(deep.max()), float((deep > 0).sum() * 0.01)


def test_a_law_that_makes_a_broken_rule_worse_hides_no_gentler_one_that_does_not() -> None:
    """The gentlest laws break it for longer; the modified sine for a shorter while."""
    found = {one.mechanism: one for one in cm.improvements(CURVED)}
    assert "give the die the law modified sine (now: 3-4-5 polynomial)" in found["die"].said
    assert found["die"].after == pytest.approx(found["die"].before * 5.528 / 5.7735, rel=1e-4)
    (before,), (after,) = CURVED.violations, found["die"].machine.violations
    assert after.start_deg > before.start_deg
    for name in ("die", "mill"):
        for law in changes.gentle_laws():
            changed = CURVED.diagram.with_motion(CURVED.diagram[name].with_law(law))
            (now,) = cm.find_violations(changed, CURVED.rules)
            longer = now.end_deg - now.start_deg > before.end_deg - before.start_deg + 0.005
            gentler = changed.peak_acceleration(name) < 0.999 * found[name].after
            assert longer or now.excess_mm > before.excess_mm or not gentler, law


def test_after_the_gentlest_law_comes_one_that_mends_the_rule() -> None:
    """A way of 4 % takes 0.170 of the time by the gentlest law, 0.177 by another; 0.173 is free."""
    one = machine(die("cubic", (70, 60, 70), 122.82), mill("cycloidal"), 2)
    laws = [each for each in cm.improvements(one) if (each.mechanism, each.kind) == ("die", "law")]
    assert [each.mends for each in laws] == [1, 0]
    assert "the law Freudenstein 1-3 (now: cubic)" in laws[0].said
    assert "the law modified trapezoid (now: cubic)" in laws[1].said
    assert laws[0].machine.violations == ()
    assert laws[1].after < laws[0].after < laws[0].before


def test_where_a_broken_rule_cannot_be_kept_moves_are_widened_beside_it() -> None:
    """The dwell of the die is in the way of the mill; its rise and its return are not."""
    for law in ("cycloidal", "3-4-5 polynomial"):
        one = machine(die(law, (30, 100, 30), 100), mill(law, 80, 150), 19)
        first = cm.improvements(one)[0]
        moves = first.machine.diagram["die"].moves
        assert (first.kind, first.mechanism, first.mends) == ("widen", "die", 0)
        assert sum(move.angle_deg for move in moves) == pytest.approx(260, abs=0.01)
        assert (moves[0].to_deg, moves[1].from_deg) == (130, 230)
        assert broken(first.machine.diagram, 19) == pytest.approx(broken(one.diagram, 19))
        assert first.after == pytest.approx(first.before * (30 / 130) ** 2, rel=1e-3)
    found = cm.improvements(STUCK)
    assert found[0].machine.violations == STUCK.violations
    assert "1 rule is broken, and no change here mends it." in repr(found)


def test_beside_a_rule_that_cannot_be_kept_another_one_is_mended() -> None:
    """The arm must not be up while the die is down: for that the rise of the die is too early."""
    arm = cm.motion(
        "arm", cm.rise(9, over_deg=40), cm.dwell(40), cm.return_(9, over_deg=40), cm.dwell(240)
    )
    three = cm.TimingDiagram(
        [die("cycloidal", (50, 80, 50), 100), mill("cycloidal", 80, 180), arm], 900
    )
    stays = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
    mended = cm.ClearanceRule(cm.beyond("arm", 1), only_while=cm.within("die", 0.5))
    given = cm.Machine("m", three, [stays, mended])
    assert {violation.rule for violation in given.violations} == {stays, mended}
    one = next(one for one in cm.improvements(given) if one.mechanism == "die")
    assert one.mends == 1
    assert {violation.rule for violation in one.machine.violations} == {stays}
    assert one.machine.violations == cm.find_violations(three, stays)


def test_a_move_that_hardly_a_machine_could_make_is_left_out_and_told() -> None:
    found = cm.improvements(ABSURD)
    assert [one.kind for one in found.left_out] == ["narrow"]
    assert found.left_out[0].mends == 1
    assert all(one.rate_per_hour >= ABSURD.diagram.rate_per_hour / 2 for one in found)
    assert max(one.after for one in found) < 5
    assert "no change here mends it" in repr(found)
    assert "pieces/h at today's largest peak, less than half of today's: narrow the" in repr(found)
    law = next(one for one in found if (one.mechanism, one.kind) == ("die", "law"))
    assert law.after == pytest.approx(2.1386, abs=1e-3)


HEAD = """
motion;stops;from in deg;to in deg;from in mm;to in mm;law;machine rate in pieces/h;still;rule
punch;;160;230;0;22;cycloidal;1800;230 to 280;arm beyond 30 only while punch within 6
;;280;345;22;0;3-4-5 polynomial;;;
"""
RETURN_FIRST = """\
arm;;10;100;80;0;cycloidal;;DOWN;
;;300;350;0;80;modified trapezoid;;UP;
"""
RISE_FIRST = """\
arm;;300;350;0;80;modified trapezoid;;UP;
;;370;460;80;0;cycloidal;;DOWN;
"""


@pytest.mark.parametrize(
    ("up", "down"),
    [
        ("350 to 370", "100 to 200"),
        ("350 to 370", ""),
        ("", "100 to 300"),
        ("355 to 365", "100 to 300"),
    ],
)
def test_a_machine_whose_return_comes_first_in_its_table_is_told_the_same(
    up: str, down: str
) -> None:
    """The rise begins where the rule stops it, and that was laid to a still arc."""
    tables = (
        HEAD + arm.replace("UP", up).replace("DOWN", down) for arm in (RETURN_FIRST, RISE_FIRST)
    )
    both = [cm.improvements(cm.machine_from_text(table, "m")) for table in tables]
    told = [
        [(one.said.partition(" (then")[2], one.kind, round(one.after, 4)) for one in found]
        for found in both
    ]
    assert told[0] == told[1]
    if down == "100 to 200":
        assert repr(both[0]) == repr(both[1])
        assert "(then: the arm may be beyond 30 mm only while the punch is within" in repr(both[0])


def wrong(*_: object, **__: object) -> None:
    raise WrongAnswerError("optimise", "it was tired")


def test_a_solver_at_fault_takes_no_other_advice_away(monkeypatch: pytest.MonkeyPatch) -> None:
    """What it was asked for is told, once; the same of the balance."""
    still = {"die": [(210, 300)], "mill": [(205, 305)]}
    press = cm.Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule], still)
    right = cm.improvements(press, seconds=5)
    monkeypatch.setattr(widening, "optimise", wrong)
    monkeypatch.setattr(ranking, "optimise", wrong)
    found = cm.improvements(press, seconds=5)
    assert [one for one in found if one.kind == "law"] == [
        one for one in right if one.kind == "law"
    ]
    assert len(found.failed) == len(set(found.failed)) == 3
    for told in ("all moves of the die", "all moves of the mill", "a balance of all moves"):
        assert f"Not known is what would come of {told}: optimise has checked" in repr(found)
        assert told in found._repr_html_()


def test_nothing_is_claimed_but_what_was_tried() -> None:
    """Both stand as wide as they can, with the gentlest law: that was tried, and it is said."""
    one = cm.indexing_motion("mill", cm.rise(9, over_deg=360, law=TRAPEZOID), stops=4)
    found = cm.improvements(cm.Machine("m", cm.TimingDiagram([one], 900)))
    assert not found
    said = "by itself: wider moves, and the laws of the catalogue with a finite jerk. None makes"
    assert said in repr(found)
    assert said in found._repr_html_()
    assert "<table" not in found._repr_html_()
    assert math.isfinite(found.machine.peaks["mill"])
