"""What to change first: each gain is what the changed machine has, and no rule is broken anew."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from cartons import all_dies, packaging_machine, pusher_rule
from machines import Array

import cammotion as cm
from cammotion.advice import changes, ranking, widening, worse
from cammotion.advice.changes import Improvement, gentle_laws
from cammotion.machine.segments import with_dwells

DATA = Path(__file__).parent.parent / "notebooks" / "data" / "pad_press.csv"
STILL = {"mill": [(205, 305)], "die": [(205, 305)]}
PRESS = cm.Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule], STILL)
CARTONS = packaging_machine(8)
MACHINES = [
    PRESS,
    cm.read_machine(DATA),
    cm.Machine("cartons", CARTONS, all_dies(CARTONS)),
    cm.Machine("pusher", CARTONS, [pusher_rule(CARTONS)], {CARTONS.names[0]: [(150, 300)]}),
]
names = pytest.mark.parametrize("machine", MACHINES, ids=lambda machine: machine.name)


def sampled_peak(diagram: cm.TimingDiagram, name: str) -> float:
    """Return the peak acceleration in m/s2 by differences of dense samples of the position."""
    angles: Array = np.linspace(0, 360, 72_001)
    motion = diagram[name]
    inside = motion.start_deg + angles
    steps = np.diff(motion.curve(inside), 2) / (angles[1] * diagram.cycle_time_s / 360) ** 2
    return float(np.abs(steps).max() / 1000)


@names
def test_each_gain_is_that_of_the_changed_machine(machine: cm.Machine) -> None:
    found = cm.improvements(machine)
    assert len(found) > 2
    before = {violation.rule for violation in machine.violations}
    for one in found:
        diagram = one.machine.diagram
        assert one.before == machine.diagram.peak_acceleration(one.mechanism)
        assert one.after == pytest.approx(sampled_peak(diagram, one.mechanism), rel=1e-3)
        assert one.largest == max(diagram.peak_acceleration(name) for name in diagram.names)
        now = {violation.rule for violation in cm.find_violations(diagram, machine.rules)}
        assert now <= before
        assert one.mends == len(before - now)
        others = [name for name in diagram.names if name != one.mechanism]
        assert all(diagram[name] == machine.diagram[name] for name in others)
        for name, arcs in machine.still.items():
            for start, end in arcs:
                stay = np.ptp(diagram[name].offset_mm(np.linspace(start, end, 50)))
                assert stay == pytest.approx(0, abs=1e-9)


@names
def test_the_first_is_what_helps_the_machine_most(machine: cm.Machine) -> None:
    found = cm.improvements(machine)
    keys = [(-one.mends, one.largest, -one.gain) for one in found]
    assert keys == sorted(keys)
    hardest = max(machine.diagram.names, key=machine.diagram.peak_acceleration)
    assert found.hardest.startswith(f"The {hardest} is driven hardest")


def test_the_numbers_of_the_lessons() -> None:
    wider, law, *_ = cm.improvements(PRESS)
    assert (wider.kind, wider.mechanism, law.kind) == ("widen", "die", "law")
    assert wider.after == pytest.approx(0.8064, abs=1e-4)
    assert law.after == pytest.approx(4.154 * 4.888 / 6.283, rel=1e-3)
    assert wider.rate_per_hour == pytest.approx(3857, abs=0.5)
    assert "124.84 deg" in wider.said


def test_the_balance_is_one_change_of_all() -> None:
    rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
    first = cm.improvements(replace(PRESS, rules=[rule]), seconds=10)[0]
    assert (first.kind, first.mechanism) == ("widen", "die") or first.kind == "balance"
    (balance,) = [one for one in cm.improvements(PRESS, seconds=10) if one.kind == "balance"]
    assert balance.after == pytest.approx(0.9433, abs=1e-3)
    assert balance.rate_per_hour == pytest.approx(4198, abs=2)


def test_a_broken_rule_is_mended_first() -> None:
    wide = PRESS.diagram.with_motion(cm.with_angle(cm.EXAMPLE.die, 126))
    found = cm.improvements(cm.Machine("wide", wide, PRESS.rules))
    assert found[0].kind == "narrow"
    assert found[0].mends == 1
    assert not found[0].machine.violations
    assert found[0].gain < 0
    assert "narrow" in repr(found)


def test_what_mends_no_rule_comes_last_however_much_it_gains() -> None:
    fan = cm.motion(
        "fan",
        *(cm.rise(9, over_deg=20), cm.dwell(120), cm.return_(9, over_deg=20), cm.dwell(200)),
    )
    wide = PRESS.diagram.with_motion(cm.with_angle(cm.EXAMPLE.die, 126))
    both = cm.TimingDiagram([*wide.motions, fan], wide.rate_per_hour)
    found = cm.improvements(cm.Machine("wide", both, PRESS.rules))
    assert [one.mends for one in found] == [1, 1, 0, 0]
    assert found[2].mechanism == "fan"
    assert found[2].largest < found[0].largest


def test_a_still_arc_bounds_the_widest_move() -> None:
    near = replace(PRESS, still={"die": [(205, 305), (100, 140)]})
    wider = next(one for one in cm.improvements(near) if one.mechanism == "die")
    assert wider.machine.diagram["die"].moves[0].from_deg == pytest.approx(140, abs=1e-6)
    assert "then: its still arc" in wider.said


def test_laws_are_tried_by_their_peaks_and_have_a_bounded_jerk() -> None:
    laws = gentle_laws()
    factors = [cm.LAWS[law].Ca for law in laws]
    assert factors == sorted(factors)
    assert "constant acceleration" not in laws
    assert "modified trapezoid" in laws


def test_a_machine_that_cannot_be_better_says_so() -> None:
    bed = cm.motion("bed", cm.dwell(360))
    found = cm.improvements(cm.Machine("bed", cm.TimingDiagram([bed], 60)))
    assert (len(found), repr(found)) == (0, "Nothing moves.")


def test_a_motion_of_another_build_keeps_its_angles() -> None:
    parts = [cm.rise(10, over_deg=40), cm.dwell(20), cm.rise(10, over_deg=40), cm.dwell(20)]
    back = [cm.return_(20, over_deg=60), cm.dwell(180)]
    step = cm.motion("step", *parts, *back)
    found = cm.improvements(cm.Machine("step", cm.TimingDiagram([step], 600)))
    assert [one.kind for one in found] == ["law"]
    standing = cm.Machine("step", cm.TimingDiagram([step], 600), still={"step": [(45, 55)]})
    wider = next(one for one in cm.improvements(standing) if one.kind == "widen")
    moves = wider.machine.diagram["step"].moves
    assert len(moves) == 3
    assert sum(move.angle_deg for move in moves) == pytest.approx(350, abs=1e-3)
    assert moves[0].to_deg <= 45 + 1e-6 < 55 - 1e-6 <= moves[1].from_deg


def pair(start_deg: float) -> cm.TimingDiagram:
    """Return two slides A and B, each out for 100 deg."""
    both = [
        cm.motion(
            name,
            *(cm.rise(20, over_deg=60), cm.dwell(100), cm.return_(20, over_deg=60), cm.dwell(140)),
            start_deg=start,
        )
        for name, start in (("A", 0), ("B", start_deg))
    ]
    return cm.TimingDiagram(both, 3600)


def test_what_makes_a_broken_rule_worse_is_left_out_and_that_it_is_broken_is_said() -> None:
    rule = cm.ClearanceRule(cm.beyond("A", 5), only_while=cm.within("B", 5))
    for still in ({}, {"A": [(60, 160)], "B": [(90, 190)]}):
        machine = cm.Machine("k", pair(30), [rule], still)
        found = cm.improvements(machine)
        assert "1 rule is broken, and no change here mends it." in repr(found)
        assert "no change here mends it" in found._repr_html_()
        (before,) = machine.violations
        for one in found:
            (now,) = one.machine.violations
            assert now.excess_mm <= before.excess_mm + 1e-3
            assert now.end_deg - now.start_deg <= before.end_deg - before.start_deg + 0.005
    wider = machine.diagram.with_motion(cm.with_angle(machine.diagram["A"], 90))
    wide = changes.improvement("widen", "wider", machine, wider, "A")
    assert (wide.mends, wide.worsens) == (0, 1)


@pytest.mark.parametrize(
    ("after", "is_worse"),
    [((2, 30), False), ((2.1, 20), True), ((1, 31), True), ((2.009, 30), False), ((31, 1), True)],
)
def test_worse_is_what_is_broken_by_more_or_for_longer(
    after: tuple[float, float], is_worse: bool
) -> None:
    """In mm at the worst, and in deg; 0.01 mm of the rule may be used up."""
    assert worse.is_worse((2, 30), after, 0.01) is is_worse


def test_with_a_distance_rule_unequal_ways_may_become_one_angle() -> None:
    up = cm.motion(
        "upper",
        *(cm.rise(30, over_deg=80), cm.dwell(60), cm.return_(30, over_deg=80), cm.dwell(140)),
        start_deg=40,
        start_mm=12,
    )
    low = cm.motion(
        "lower",
        *(cm.rise(30, over_deg=60), cm.dwell(40), cm.return_(30, over_deg=70), cm.dwell(190)),
        start_deg=75,
    )
    rule = cm.DistanceRule("upper", above="lower", at_least_mm=5)
    diagram = cm.TimingDiagram([up, low], 5400)
    first = cm.improvements(cm.Machine("m", diagram, [rule]))[0]
    assert (first.kind, first.mechanism) == ("widen", "lower")
    widest = cm.widest_move(diagram, "lower", rule, each_way=False)
    assert first.after == pytest.approx(widest.peak_acceleration)
    assert first.after < first.before / 3


def test_a_table_that_would_stand_nowhere_is_said_to() -> None:
    table = cm.indexing_motion("table", cm.rise(275, over_deg=120), cm.dwell(240), stops=8)
    first = cm.improvements(cm.Machine("m", cm.TimingDiagram([table], 3000)))[0]
    assert (
        first.said == "widen the rise from 120 to 360 deg of the table, so that it stands nowhere"
    )


def test_a_move_that_hands_on_its_velocity_keeps_its_law() -> None:
    """A law from rest to rest would stop it there."""
    lifts = cm.polynomial((0, 0.15, 0, 0), (1, 0, -4, 0), name="lifts", may_leave=True)
    valve = cm.motion(
        "valve",
        cm.rise(0.25, over_deg=20, law=cm.MATCHED),
        cm.rise(8.75, over_deg=58, law=lifts),
        cm.return_(8.75, over_deg=66, law=cm.MATCHED),
        cm.return_(0.25, over_deg=25, law="cubic"),
        cm.dwell(191),
        start_deg=100,
    )
    found = cm.improvements(cm.Machine("v", cm.TimingDiagram([valve], 90_000)))
    assert not len(found)
    assert found.unasked == ()
    assert "Not asked, since its moves hand over a velocity: the valve." in repr(found)


def test_moves_that_hand_over_a_velocity_are_not_torn_apart() -> None:
    """The first advice was an infinite peak; rounding puts the joint of the turn just below 360."""
    slide = cm.motion(
        "slide",
        cm.rise(130, over_deg=200, law=cm.MATCHED),
        cm.return_(130, over_deg=160, law=cm.CONSTANT_VELOCITY),
    )
    gate = cm.motion(
        "gate",
        *(cm.rise(20, over_deg=60), cm.dwell(60), cm.return_(20, over_deg=60), cm.dwell(180)),
        start_deg=180,
    )
    rule = cm.ClearanceRule(cm.beyond("slide", 60), only_while=cm.within("gate", 15))
    for start_deg in (0, 0.1, 33.3, 359.7):
        diagram = cm.TimingDiagram([slide.shifted(start_deg), gate], 3000)
        for one in cm.improvements(cm.Machine("m", diagram, [rule])):
            assert one.mechanism == "gate"
            assert math.isfinite(one.after)
        for asked in (
            lambda: cm.widest_move(diagram, "slide", rule),  # noqa: B023
            lambda: cm.with_angle(diagram["slide"], 100),  # noqa: B023
        ):
            with pytest.raises(cm.InputError, match=r"'slide' go on with a velocity .* would jump"):
                asked()


def test_a_velocity_that_jumps_is_mended_by_a_law() -> None:
    line = cm.MotionLaw("line", cm.x)
    slide = cm.motion(
        "slide", cm.rise(5, over_deg=180, law=line), cm.return_(5, over_deg=180, law=line)
    )
    first = cm.improvements(cm.Machine("m", cm.TimingDiagram([slide], 2000)))[0]
    assert (first.kind, first.before) == ("law", math.inf)
    assert first.after < 0.04


def test_a_still_arc_that_stops_one_move_and_a_rule_that_stops_the_other() -> None:
    """The rise has to end before the arc, the return is stopped by the rule or by the turn."""
    up, down = cm.rise(60, over_deg=70), cm.return_(60, over_deg=90)
    out, back = cm.rise(40, over_deg=45), cm.return_(40, over_deg=45)
    gripper = cm.motion("gripper", up, cm.dwell(20), down, cm.dwell(180))
    slide = cm.motion("slide", out, cm.dwell(60), back, cm.dwell(210), start_deg=200)
    diagram = cm.TimingDiagram([gripper, slide], 5400)
    rule = cm.ClearanceRule(cm.beyond("gripper", 25), only_while=cm.within("slide", 15))
    for arc in [(200, 240), (215, 290), (230, 340), (300, 359)]:
        machine = cm.Machine("m", diagram, [rule], {"gripper": [arc]})
        one = next(c for c in cm.improvements(machine) if c.mechanism == "gripper")
        assert one.kind == "widen"
        assert one.after < 0.8 * one.before
        assert one.machine.violations == ()
        off = one.machine.diagram["gripper"].position_mm(np.linspace(*arc, 50))
        assert np.abs(off).max() < 1e-9


def test_a_change_that_breaks_a_rule_is_no_answer_and_takes_no_other_away(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    real = cm.widest_move

    def too_wide(diagram: cm.TimingDiagram, name: str, *more: object, **named: object) -> object:
        found = real(diagram, name, *more, **named)  # type: ignore[arg-type]
        motion = cm.with_angle(diagram[name], min(found.angle_deg + 2, 129))
        return replace(found, diagram=diagram.with_motion(motion))

    monkeypatch.setattr(widening, "widest_move", too_wide)
    found = cm.improvements(PRESS)
    assert "other angles of the die: improvements has checked its answer" in repr(found)
    assert "breaks the rule 'the die may be beyond 19 mm" in repr(found)
    assert [one for one in found if one.mechanism == "die" and one.kind == "widen"] == []
    assert [one.kind for one in found if one.mechanism == "die"] == ["law"]


FILLER = cm.machine_from_text(
    """
motion;stops;from in deg;to in deg;from in mm;to in mm;law;machine rate in pieces/h;still;rule
wheel; 10; 195; 280; 24; 0; modified sine; 6000; 25 to 110; arm beyond 4 only while wheel within .2
arm; ; -30; 30; 0; 16; cycloidal; ; ; tamper beyond 2 only while arm within 13
; ; 60; 150; 16; 0; cycloidal; ; ;
tamper; ; 115; 140; 0; 7; cycloidal; ; 140 to 150; tamper beyond 1 only while wheel within 0.1
; ; 150; 185; 7; 0; cycloidal; ; ;
""",
    "filler",
)
FOLDER = """
motion; from in deg; to in deg; from in mm; to in mm; law; machine rate in pieces/h; still; rule
pusher; 100; 180; 60; 10; cycloidal; 600; 180 to 190; pusher - flap at least 5 mm
; 200; 320; 10; 60; cycloidal; ; 320 to 350;
flap; -60; 0; 0; HEIGHT; cycloidal; ; 205 to 300;
; 60; 150; HEIGHT; 0; cycloidal; ; ;
"""
EARLY = cm.machine_from_text(
    """
motion;stops;from in deg;to in deg;from in mm;to in mm;law;machine rate in pieces/h;still;rule
mill; 24; 0; 150; 0; 100; cycloidal; 2000; 200 to 215; die beyond 19 only while mill within 0.65
die; ; 165; 200; 0; 50; cycloidal; ; 200 to 215;
; ; 215; 270; 50; 0; cycloidal; ; ;
""",
    "early",
)


def folder(flap_mm: float) -> cm.Machine:
    return cm.machine_from_text(FOLDER.replace("HEIGHT", f"{flap_mm}"), "folder")


def widened(machine: cm.Machine, name: str) -> Improvement:
    (found,) = (c for c in cm.improvements(machine) if (c.mechanism, c.kind) == (name, "widen"))
    return found


def test_a_turret_may_be_wider_elsewhere_than_about_its_middle() -> None:
    """A search of all angles, in steps, finds nothing that is gentler."""
    one = widened(FILLER, "wheel")
    diagram = FILLER.diagram
    about = cm.widest_move(diagram, "wheel", FILLER.rules).peak_acceleration
    (move,) = diagram["wheel"].moves
    peaks = []
    for begin in range(110, 260, 6):
        for end in range(begin + 90, 386, 6):
            moved = replace(move, from_deg=begin, to_deg=end)
            rest = replace(move, from_deg=end, to_deg=begin + 360, from_mm=0, to_mm=0, law=None)
            there = diagram.with_motion(replace(diagram["wheel"], segments=(moved, rest)))
            if not cm.find_violations(there, FILLER.rules):
                peaks.append(there.peak_acceleration("wheel"))
    assert one.after < 0.8 * about
    assert 0.9 * min(peaks) < one.after < min(peaks)


def test_what_stops_the_hardest_move_is_named_first() -> None:
    """Of the tamper, the return is driven harder; what is named breaks if a move is wider."""
    one = widened(FILLER, "tamper")
    wheel, arm = "beyond 1 mm only while the wheel", "beyond 2 mm only while the arm"
    assert 0 < one.said.index(wheel) < one.said.index(arm)
    assert "still arc" not in one.said
    rise, back = one.machine.diagram["tamper"].moves
    for changed, rule in (
        (replace(back, to_deg=back.to_deg + 0.2), wheel),
        (replace(rise, from_deg=rise.from_deg - 0.2), arm),
    ):
        moves = [changed if move.kind == changed.kind else move for move in (rise, back)]
        motion = replace(one.machine.diagram["tamper"], segments=tuple(with_dwells(moves)))
        wider = one.machine.diagram.with_motion(motion)
        assert any(rule in str(v.rule) for v in cm.find_violations(wider, FILLER.rules))


def test_what_stops_a_move_that_shares_the_turn_is_named() -> None:
    one = widened(EARLY, "die")
    assert sum(move.angle_deg for move in one.machine.diagram["die"].moves) == pytest.approx(345)
    assert one.said.endswith(
        "of the die (then: the die may be beyond 19 mm only while the mill is within 0.65 mm)"
    )


def test_beside_a_distance_no_move_is_narrowed_for_nothing() -> None:
    """One angle was told for both: the rise fell from 85 to 80 deg, though no rule is broken."""
    gripper = cm.motion(
        "gripper",
        *(cm.rise(55, over_deg=70), cm.dwell(120), cm.return_(55, over_deg=60), cm.dwell(110)),
        start_deg=10,
        start_mm=20,
    )
    eye = cm.motion(
        "eye",
        *(cm.rise(66, over_deg=85), cm.dwell(90), cm.return_(66, over_deg=60), cm.dwell(125)),
        start_deg=15,
    )
    lock = cm.motion(
        "lock",
        *(cm.rise(8, over_deg=40), cm.dwell(120), cm.return_(8, over_deg=40), cm.dwell(160)),
        start_deg=110,
    )
    rules = [
        cm.DistanceRule("gripper", above="eye", at_least_mm=2),
        cm.ClearanceRule(cm.moving("eye"), only_while=cm.standing("lock")),
    ]
    machine = cm.Machine("m", cm.TimingDiagram([gripper, eye, lock], 1200), rules)
    changed = next(widening.wider(machine, "eye", rules, []))
    assert [move.angle_deg for move in changed["eye"].moves] == pytest.approx([85, 80])
    assert not cm.find_violations(changed, rules)
    hardest = 2 * math.pi * 0.066 / (80 / 360 * 3) ** 2
    assert changed.peak_acceleration("eye") == pytest.approx(hardest)


def test_beside_a_distance_each_move_has_its_own_angle() -> None:
    """The rule stops nothing: the pusher is never below 10 mm, the flap never above 5 mm."""
    found = cm.improvements(folder(5))
    (one,) = (each for each in found if (each.mechanism, each.kind) == ("pusher", "widen"))
    assert one.said == (
        "widen the return from 80 to 190 deg and the rise from 120 to 130 deg of the pusher "
        "(then: its still arc)"
    )
    assert one.after == pytest.approx(2 * math.pi * 0.05 / (130 / 360 * 6) ** 2, rel=1e-6)
    told = [f"Of the {name} each end of a move was put out by itself" for name in folder(5).still]
    assert [note.partition(", which need not be the best. ")[0] for note in found.notes] == told
    assert all("the pusher stays at least 5 mm above the flap" in note for note in found.notes)


@pytest.mark.parametrize("limit_mm", [4, 2])
def test_a_part_that_has_to_stand_over_a_whole_dwell_may_stand_longer(limit_mm: float) -> None:
    """It has to be up until the gate is down; about its dwell that left the rise 40 deg."""
    up, down = cm.rise(16, over_deg=107), cm.return_(16, over_deg=183)
    out, back = cm.rise(10, over_deg=20), cm.return_(10, over_deg=40)
    slide = cm.motion("slide", up, cm.dwell(70), down, start_deg=355)
    gate = cm.motion("gate", cm.dwell(140), out, cm.dwell(150), back, cm.dwell(10))
    rule = cm.ClearanceRule(cm.beyond("gate", 5), only_while=cm.beyond("slide", limit_mm))
    diagram, still = cm.TimingDiagram([slide, gate], 5400), {"slide": [(102, 172)]}
    machine = cm.Machine("m", diagram, [rule], still)
    first = cm.improvements(machine)[0]
    assert (first.mechanism, first.mends) == ("slide", 1)
    assert first.after == pytest.approx(cm.optimise(diagram, rule, still=still).reached)
    widest = cm.widest_move(diagram, "slide", rule)
    assert first.after < 0.5 * widest.peak_acceleration


def test_no_refusal_is_told_of_a_search_that_found_moves() -> None:
    """With one angle for both no moves keep the rule; with two they do."""
    arm = cm.motion(
        "arm",
        *(cm.rise(20, over_deg=80), cm.dwell(60), cm.return_(20, over_deg=100), cm.dwell(120)),
        start_deg=-20,
    )
    gate = cm.motion(
        "gate",
        *(cm.rise(10, over_deg=5), cm.dwell(20), cm.return_(10, over_deg=5), cm.dwell(330)),
        start_deg=205,
    )
    rule = cm.ClearanceRule(cm.beyond("gate", 1), only_while=cm.beyond("arm", 10))
    found = cm.improvements(cm.Machine("m", cm.TimingDiagram([arm, gate], 2000), [rule]))
    assert (found[0].mechanism, found[0].mends) == ("arm", 1)
    assert not [note for note in found.failed if note.startswith("Of the arm")]


def test_a_distance_that_stops_a_move_is_named() -> None:
    """The flap is so high before that the pusher may not come down early."""
    one = widened(folder(40), "pusher")
    assert one.said.endswith("; the pusher stays at least 5 mm above the flap)")
    assert not one.machine.violations


def test_moves_that_share_the_whole_turn_are_stopped_by_each_other() -> None:
    """360.1 - 360 is not 0.1: by that rounding a move seemed to have all of the turn left."""
    ends = (0.1, 120.3, 0, 50), (120.3, 360.1, 50, 0)
    names = ("from_deg", "to_deg", "from_mm", "to_mm")
    moves = [cm.Segment(**dict(zip(names, of, strict=True)), law="cubic") for of in ends]
    full = cm.TimingDiagram([cm.Motion("die", moves), cm.EXAMPLE.mill], 2000)
    machine = cm.Machine("full", full, [cm.EXAMPLE.rule], {})
    assert not [*widening.stops(machine, full, "die", [])]


def test_what_is_no_machine_is_refused() -> None:
    with pytest.raises(cm.InputError, match=r" is given machine=.*: give a Machine"):
        cm.improvements(PRESS.diagram)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match=r"^The time is 0 s"):
        cm.improvements(PRESS, seconds=0)
    assert ranking.improvements is cm.improvements
