"""Two versions of a machine: every change is told, and each number is what each version has."""

import math
from collections.abc import Iterator
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from cartons import packaging_machine, pusher_rule
from machines import RULE, die_mm, make_diagram, make_die, make_mill
from matplotlib import pyplot as plt

import cammotion as cm
from cammotion.versions.comparison import Comparison, Effect
from cammotion.views.pictures import PictureFigure, describe

mpl.use("agg")

BEFORE = make_diagram()
AFTER = cm.TimingDiagram([make_mill(), make_die(100, law="modified sine")], 3000)
LOADS = {"die": cm.FollowerLoad(mass_kg=12), "mill": cm.FollowerLoad(mass_kg=40)}


@pytest.fixture(autouse=True)
def _no_trace() -> Iterator[None]:
    yield
    plt.close("all")


def effect(found: Comparison, of: str, what: str) -> Effect:
    return next(each for each in found.effects if (each.of, each.what) == (of, what))


def test_what_was_changed_is_told() -> None:
    assert [str(change) for change in cm.compare(BEFORE, AFTER).changes] == [
        "machine, rate: 2000 pieces/h → 3000 pieces/h",
        "die, rise: 150 to 205 deg, 50 mm, cycloidal → 105 to 205 deg, 50 mm, modified sine",
        "die, return: 305 to 360 deg, 50 mm, cycloidal → 305 to 405 deg, 50 mm, modified sine",
    ]


def test_nothing_changed() -> None:
    found = cm.compare(BEFORE, make_diagram(make_die(), make_mill()))
    assert (found.changes, found.effects) == ((), ())
    assert repr(found) == "Comparison(no changes; largest peak acceleration 4.154 → 4.154 m/s²)"


def test_a_turned_list_of_moves_is_the_same_motion() -> None:
    """The same motion, begun with its return."""
    die = make_die()
    turned = cm.motion(
        "die",
        *(cm.return_(50, over_deg=55), cm.dwell(150), cm.rise(50, over_deg=55), cm.dwell(100)),
        start_deg=305,
        start_mm=50,
    )
    assert turned.position_mm(np.arange(360)) == pytest.approx(die.position_mm(np.arange(360)))
    assert cm.compare(make_diagram(die), make_diagram(turned)).changes == ()


def test_motions_that_come_and_go_and_moves_that_are_added() -> None:
    twice = cm.motion(
        "die", *[cm.rise(50, over_deg=40), cm.return_(50, over_deg=40), cm.dwell(100)] * 2
    )
    stamp = cm.motion("stamp", cm.dwell(360))
    found = cm.compare(make_diagram(make_mill(), make_die()), make_diagram(twice, stamp))
    said = [str(change) for change in found.changes]
    assert said[0] == "mill, motion: 1 move → –"
    assert "stamp, motion: – → no moves" in said
    assert sum("die, " in line for line in said) == 4
    assert "– → 180 to 220 deg, 50 mm, cycloidal" in said[3]
    gone = effect(found, "mill", "peak acceleration")
    assert (gone.after, gone.times) == (None, None)
    assert "1.117 → – m/s²" in str(gone)


def test_what_stayed_is_not_told_where_moves_are_added_before_it() -> None:
    turn = [cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=55)]
    more = [cm.rise(5, over_deg=20), cm.dwell(5), cm.return_(5, over_deg=20), cm.dwell(105)]
    longer = make_diagram(cm.motion("die", *more, *turn))
    added = [
        "die, rise: – → 0 to 20 deg, 5 mm, cycloidal",
        "die, return: – → 25 to 45 deg, 5 mm, cycloidal",
    ]
    assert [*map(str, cm.compare(make_diagram(make_die()), longer).changes)] == added
    taken = [change.before for change in cm.compare(longer, make_diagram(make_die())).changes]
    assert taken == ["0 to 20 deg, 5 mm, cycloidal", "25 to 45 deg, 5 mm, cycloidal"]


def test_what_it_cost_is_what_each_has() -> None:
    shafts = [cm.Camshaft(each, LOADS) for each in (BEFORE, AFTER)]
    found = cm.compare(shafts[0], shafts[1], RULE)
    at = np.linspace(0, 360, 36_001)
    for name, sampled in (("die", 50), ("mill", 100)):
        peaks = [np.abs(d.acceleration(name, at)).max() for d in (BEFORE, AFTER)]
        told = effect(found, name, "peak acceleration")
        assert [told.before, told.after] == pytest.approx(peaks, rel=1e-4)
        force = effect(found, name, "peak force")
        mass = LOADS[name].mass_kg
        assert [force.before, force.after] == pytest.approx([mass * p for p in peaks], rel=1e-4)
        assert sampled > 0
    torque = effect(found, "camshaft", "rms torque")
    rms = [math.sqrt(np.mean(np.asarray(s.torque_N_m(at)) ** 2)) for s in shafts]
    assert [torque.before, torque.after] == pytest.approx(rms, rel=1e-3)
    room = effect(found, str(RULE), "clearance")
    away = (at > 15.04) & (at < 134.9)
    assert room.before == pytest.approx(19 - die_mm(at)[away].max(), abs=0.01)
    assert room.after == cm.find_clearances(AFTER, RULE)[0].clearance_mm
    assert effect(found, str(RULE), "reserve").after == cm.reserves(AFTER, RULE)[0].deg
    assert repr(found).endswith("m/s²; no rule broken)")
    html = found._repr_html_()
    assert "<td>mill</td><td>peak force in N</td><td>44.68</td><td>100.5</td><td>2.25 times" in html


def test_a_broken_rule_is_counted() -> None:
    wide = make_diagram(make_mill(), make_die(130))
    loose = cm.ClearanceRule(cm.beyond("die", 60), cm.within("mill", 1), name="never")
    found = cm.compare(BEFORE, wide, [RULE, loose])
    assert repr(found).endswith("; 1 rule broken)")
    assert effect(found, "never", "clearance").after > 0  # type: ignore[operator]
    broken = cm.compare(BEFORE, wide, [RULE, cm.ClearanceRule(RULE.when, RULE.only_while, "again")])
    assert repr(broken).endswith("; 2 rules broken)")


def test_what_cannot_be_compared() -> None:
    with pytest.raises(cm.InputError, match="One version is a Camshaft and the other a Timing"):
        cm.compare(BEFORE, cm.Camshaft(AFTER, LOADS))
    with pytest.raises(cm.InputError, match="no motion 'die'"):
        cm.compare(BEFORE, make_diagram(make_mill()), RULE)
    with pytest.raises(cm.InputError, match="compare is given after=3"):
        cm.compare(BEFORE, 3)  # type: ignore[arg-type]


@pytest.mark.parametrize("count", [1, 3, 8, 24])
def test_the_picture_shows_both(count: int) -> None:
    before = packaging_machine(count)
    after = before.at_rate(1.2 * before.rate_per_hour)
    for motion in before.motions:
        after = after.with_motion(motion.shifted(7))
    rules = pusher_rule(before) if count > 4 else ()
    ax = cm.plot_comparison(cm.compare(before, after, rules))
    assert len(ax.lines) == 2 * count
    for n, motion in enumerate(before.motions):
        if not motion.is_indexing:
            old, new = ax.lines[2 * n : 2 * n + 2]
            assert old.get_label() == f"{motion.name} before"
            assert new.get_label() == f"{motion.name} after"
            assert new.get_linestyle() == "-" != old.get_linestyle()
            angles = np.asarray(new.get_xdata(), dtype=float)
            assert new.get_ydata() == pytest.approx(motion.position_mm(angles - 7), abs=1e-9)
            assert old.get_ydata() == pytest.approx(
                motion.position_mm(np.asarray(old.get_xdata(), dtype=float)), abs=1e-9
            )
    (bars,) = ax.figure.axes[1:]
    assert [patch.get_width() for patch in bars.patches] == pytest.approx([144] * count)  # type: ignore[attr-defined]
    assert isinstance(ax.figure, PictureFigure)
    assert f"{before.names[0]} before from" in describe(ax.figure)


def test_of_many_bars_the_camshafts_and_those_that_changed_most_are_drawn_in_their_order() -> None:
    diagrams = packaging_machine(24), packaging_machine(24).at_rate(3000)
    before, after = (cm.Camshaft(d, dict.fromkeys(d.names, LOADS["die"])) for d in diagrams)
    found = cm.compare(before, after)
    told = {f"{e.of}, {e.what}": abs(math.log(e.times)) for e in found.effects if e.times}
    ends = (", peak acceleration", ", peak force", ", peak torque", ", rms torque")
    told = {row: change for row, change in told.items() if row.endswith(ends)}
    (bars,) = cm.plot_comparison(found).figure.axes[1:]
    shown = [row.get_text() for row in bars.get_yticklabels()]
    assert len(told) > len(shown) == 30
    assert shown == [row for row in told if row in shown]
    least = min(told[row] for row in shown if not row.startswith("camshaft"))
    assert least >= max(told[row] for row in {*told} - {*shown})
    assert {"camshaft, peak torque", "camshaft, rms torque"} <= {*shown}


def test_one_that_came_and_nothing_else() -> None:
    found = cm.compare(make_diagram(make_mill()), make_diagram())
    ax = cm.plot_comparison(found)
    assert len(ax.lines) == 3
    assert len(ax.figure.axes) == 1


def test_a_peak_that_is_infinite_in_one_version_is_drawn_with_its_numbers() -> None:
    jumps = cm.MotionLaw("constant velocity", cm.x)
    before, after = make_diagram(), make_diagram(make_mill(), make_die(law=jumps))
    for versions, said in (
        ((before, after), "4.15 → ∞ m/s²"),
        ((after, before), "∞ → 4.15 m/s²"),
    ):
        (below,) = cm.plot_comparison(cm.compare(*versions)).figure.axes[1:]
        assert [text.get_text() for text in below.texts] == [said]
        (row,) = below.get_yticklabels()
        assert row.get_text() == "die, peak acceleration"
        assert [bar.get_width() for bar in below.patches] == [0]  # type: ignore[attr-defined]
        assert below.get_xlim()[1] > 100


def die_like(
    *, start: float = 150, at_mm: float = 0, law: str | cm.MotionLaw = "cycloidal"
) -> cm.TimingDiagram:
    """Return the example with another die: other angles, elsewhere, or by another law."""
    die = cm.motion(
        "die",
        *(cm.rise(50, over_deg=55, law=law), cm.dwell(100)),
        *(cm.return_(50, over_deg=55), cm.dwell(150)),
        start_deg=start,
        start_mm=at_mm,
    )
    return BEFORE.with_motion(die)


def mill_like(*moves: Any, stops: int = 24, at_mm: float = 0) -> cm.TimingDiagram:
    mill = cm.indexing_motion("mill", *moves, cm.dwell(210), stops=stops, start_mm=at_mm)
    return BEFORE.with_motion(mill)


NAMESAKE = cm.MotionLaw("cycloidal", 3 * cm.x**2 - 2 * cm.x**3)
INDEX = cm.rise(100, over_deg=150)


@pytest.mark.parametrize(
    ("after", "told"),
    [
        (die_like(start=150.04), "150 to 205 deg, 50 mm, cycloidal → 150.04 to 205.04 deg"),
        (die_like(start=150.00002), "→ 150.00002 to 205.00002 deg"),
        (die_like(at_mm=10), "die, position before the rise: 0 mm → 10 mm"),
        (die_like(law=NAMESAKE), "cycloidal (another law of this name)"),
        (mill_like(INDEX, stops=20), "mill, stops: 24 → 20"),
        (mill_like(INDEX, at_mm=30), "mill, position before the rise: 0 mm → 30 mm"),
        (mill_like(cm.return_(100, over_deg=150)), "mill, move: 0 to 150 deg, 100 mm, cycloidal, "),
    ],
)
def test_small_changes_and_those_of_one_name_are_told(after: cm.TimingDiagram, told: str) -> None:
    assert told in str(cm.compare(BEFORE, after).changes[0])


@pytest.mark.parametrize("after", [die_like(start=510), mill_like(INDEX, at_mm=300)])
def test_the_same_counted_in_another_way_is_no_change(after: cm.TimingDiagram) -> None:
    assert cm.compare(BEFORE, after, RULE).changes == ()


def test_a_name_in_another_case_is_the_same_motion() -> None:
    after = BEFORE.with_motion(cm.Motion("Die", make_die(100).segments))
    same = make_diagram(make_mill(), make_die(100))
    found, as_before = (cm.compare(BEFORE, diagram, RULE) for diagram in (after, same))
    assert found.changes == as_before.changes
    assert found.effects == as_before.effects
    shafts = cm.compare(cm.Camshaft(BEFORE, LOADS), cm.Camshaft(after, LOADS))
    assert {each.of for each in shafts.effects} == {"die", "mill", "camshaft"}


def narrow(over_deg: float, start_deg: float) -> cm.TimingDiagram:
    """Return the example with a die that comes down at once."""
    parts = cm.rise(50, over_deg=over_deg), cm.dwell(100), cm.return_(50, over_deg=55)
    die = cm.motion("die", *parts, cm.dwell(205 - over_deg), start_deg=start_deg)
    return BEFORE.with_motion(die)


def test_a_change_of_an_angle_is_told_as_one_or_lost_in_rounding() -> None:
    before = narrow(0.3, 150)
    for turns in (0, 30_000):
        for exponent in range(-13, 1):
            after = narrow(0.3 + 10.0**exponent, 150 + 360 * turns)
            for change in cm.compare(before, after).changes:
                assert change.before != change.after
                assert "another law" not in change.after
    assert cm.compare(before, narrow(0.3, 150 + 360 * 30_000)).changes == ()
    assert cm.compare(before, narrow(0.3 + 1e-6, 150)).changes != ()


def test_no_ticks_stand_before_the_names_of_changes() -> None:
    ax = cm.plot_comparison(cm.compare(cm.EXAMPLE.diagram, cm.EXAMPLE.diagram.at_rate(3000)))
    (bars,) = ax.figure.axes[1:]
    assert {tick.tick1line.get_markersize() for tick in bars.yaxis.get_major_ticks()} == {0}


def test_of_numbers_below_0_no_ratio_is_told() -> None:
    """A rule that was broken is kept: its clearance grew from -2 to 19 mm, and not by -975 %."""
    broken = BEFORE.with_motion(cm.with_angle(BEFORE["die"], 128))
    worse = BEFORE.with_motion(cm.with_angle(BEFORE["die"], 130))
    for before, after in ((broken, BEFORE), (BEFORE, broken), (broken, worse)):
        found = cm.compare(before, after, RULE)
        signed = [effect for effect in found.effects if effect.unit in {"mm", "deg"}]
        assert len(signed) > 1
        assert all(effect.times is None for effect in signed)
    assert effect(cm.compare(BEFORE, AFTER), "die", "peak acceleration").times is not None


def test_a_position_is_told_beside_that_before_a_like_move() -> None:
    """In both the die returns from 50 mm; the 0 mm were before the rise."""
    down = (cm.return_(50, over_deg=60), cm.dwell(100), cm.rise(50, over_deg=60), cm.dwell(140))
    up = (cm.rise(20, over_deg=60), cm.rise(30, over_deg=60), cm.dwell(60))
    before = cm.motion("die", *down, start_mm=50)
    after = cm.motion("die", *up, cm.return_(50, over_deg=60), cm.dwell(120))
    found = cm.compare(cm.TimingDiagram([before], 2000), cm.TimingDiagram([after], 2000))
    assert not [change for change in found.changes if "position" in change.what]
