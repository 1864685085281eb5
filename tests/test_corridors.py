"""Corridors: the room that rules, travel and still arcs leave, node by node."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import DOWN_DEG, RULE, Array, die_mm, examples, make_diagram, make_die, make_mill

import cammotion as cm
from cammotion import ClearanceRule, beyond, within
from cammotion.limits.bands import Band
from cammotion.limits.corridors import Corridor, corridor

INFINITE = math.inf


def limits_at(room: Corridor, angle_deg: float) -> tuple[float, float]:
    """Return the limits at the node nearest to an angle."""
    node = np.argmin(np.abs((room.angle_deg - angle_deg + 180) % 360 - 180))
    return float(room.low_mm[node]), float(room.high_mm[node])


def test_the_die_may_be_19_mm_deep_while_the_mill_is_under_way() -> None:
    room = corridor(make_diagram(), "die", RULE, still=[DOWN_DEG])
    assert [limits_at(room, angle) for angle in (20, 75, 130)] == [(-INFINITE, 19)] * 3
    assert [limits_at(room, angle) for angle in (10, 140, 200, 310)] == [(-INFINITE, INFINITE)] * 4
    assert [limits_at(room, angle) for angle in (205, 250, 305)] == [(50, 50)] * 3
    [(start, end)] = make_mill().where_beyond(0.65)
    limited = room.angle_deg[room.high_mm == 19] % 360
    assert (limited.min(), limited.max()) == pytest.approx((start, end), abs=1e-7)
    assert room.pitch_mm == 0


def test_the_travel_holds_everywhere_and_the_narrower_limit_counts() -> None:
    room = corridor(make_diagram(), "die", RULE, still=[DOWN_DEG], travel_mm=(-3, 55))
    assert limits_at(room, 75) == (-3, 19)
    assert limits_at(room, 180) == (-3, 55)
    rules = [RULE, ClearanceRule(beyond("die", 12), only_while=within("mill", 20))]
    deeper = corridor(make_diagram(), "die", rules[::-1], still=[DOWN_DEG])
    assert [limits_at(deeper, angle)[1] for angle in (20, 75)] == [19, 12]


def test_a_rule_the_other_way_round_is_a_lower_limit() -> None:
    """The gate may be lower than 42 mm only while the die is not beyond 3.5 mm."""
    gate = cm.motion(
        "gate",
        *[cm.return_(60, over_deg=20), cm.dwell(40), cm.rise(60, over_deg=20), cm.dwell(280)],
        start_deg=20,
        start_mm=60,
    )
    rule = ClearanceRule(within("gate", 42), only_while=within("die", 3.5))
    room = corridor(make_diagram(gate, make_die()), "gate", rule, still=[(40, 80)])
    assert limits_at(room, 250) == (42, INFINITE)
    assert limits_at(room, 60) == (0, 0)
    assert limits_at(room, 120) == (-INFINITE, INFINITE)
    [(start, end)] = make_die().where_beyond(3.5)
    held = room.angle_deg[room.low_mm == 42]
    assert (held.min(), held.max()) == pytest.approx((start, end), abs=1e-7)


def test_the_second_half_of_a_rule_binds_as_well() -> None:
    """While the die is beyond 19 mm, the mill has to be within 0.65 mm of the stop it is at."""
    room = corridor(make_diagram(), "mill", RULE, still=[DOWN_DEG])
    assert limits_at(room, 200) == pytest.approx((99.35, 100.65))
    assert limits_at(room, 250) == (100, 100)
    assert limits_at(room, 75) == (-INFINITE, INFINITE)
    assert room.pitch_mm == 100


def test_a_turret_that_has_to_be_away_from_its_stops_is_between_two_whichever() -> None:
    parts = cm.rise(10, over_deg=10), cm.dwell(10), cm.return_(10, over_deg=10), cm.dwell(330)
    gate = cm.motion("gate", *parts, start_deg=60)
    rule = ClearanceRule(beyond("gate", 5), only_while=beyond("mill", 20))
    room = corridor(make_diagram(make_mill(), gate), "mill", rule, still=[(200, 300)])
    assert limits_at(room, 75) == (-INFINITE, INFINITE)
    assert limits_at(room.about([0]), 75) == (20, 80)
    assert limits_at(room.about([1]), 75) == (120, 180)
    backwards = cm.indexing_motion(
        "mill", cm.return_(100, over_deg=150), cm.dwell(210), stops=24, start_mm=7
    )
    room = corridor(make_diagram(backwards, gate), "mill", rule, still=[(200, 300)])
    assert limits_at(room.about([-1]), 75) == (-73, -13)
    assert (room.pitch_mm, limits_at(room, 250)) == (-100, (-93, -93))


def test_where_a_turret_stands_it_is_known_at_which_stop() -> None:
    """Also over an arc that goes on over the end of the grid, where it is a pitch further."""
    mill = cm.indexing_motion(
        "mill", cm.dwell(60), cm.rise(100, over_deg=200), cm.dwell(100), stops=24, start_mm=5.26
    )
    die = make_die(10, down_deg=(330, 400))
    near = ClearanceRule(beyond("die", 25), only_while=within("mill", 2))
    room = corridor(make_diagram(mill, die), "mill", near, still=[(340, 360)])
    assert room.bands == ()
    assert limits_at(room, 20) == pytest.approx((3.26, 7.26))
    assert limits_at(room, 330) == pytest.approx((103.26, 107.26))
    assert limits_at(room, 350) == pytest.approx((105.26, 105.26))
    [band] = corridor(make_diagram(mill, die), "mill", near, still=[(280, 290)]).bands
    assert set(band.ahead_mm) == {0, 100}
    free = ClearanceRule(beyond("die", 25), only_while=within("mill", 50))
    room = corridor(make_diagram(mill, die), "mill", free, still=[(280, 290)])
    assert room.bands == ()
    assert limits_at(room, 350) == (-INFINITE, INFINITE)


@pytest.mark.parametrize("cells", [12, 100, 720])
def test_the_grid_is_a_turn_with_the_ends_of_all_arcs_in_it(cells: int) -> None:
    room = corridor(make_diagram(), "die", RULE, still=[(210.1, 299.7)], cells=cells)
    assert room.cells_deg.sum() == pytest.approx(360)
    assert room.cells_deg.min() > 0.4 * 360 / cells or cells == 12
    assert room.cells_deg.max() < 1.51 * 360 / cells
    for angle in (210.1, 299.7, *make_mill().where_beyond(0.65)[0]):
        assert np.abs((room.angle_deg - angle + 180) % 360 - 180).min() < 1e-9
    assert abs(len(room.angle_deg) - cells) <= 4


def test_ends_of_arcs_that_differ_by_rounding_are_one_node() -> None:
    """252.188 + 360 - 232.188 is 380.00000000000006; cells of no length cannot be solved."""
    first, *others = make_die(5, stroke_mm=5, down_deg=(232.188, 252.188)).segments
    last = replace(first, from_deg=first.from_deg + 360, to_deg=first.to_deg + 360)
    die = cm.Motion("die", [*others, last])
    for way in np.linspace(0, 720, 400):
        diagram = make_diagram(make_mill(middle_deg=20), die.shifted(way))
        rule = ClearanceRule(beyond("die", 2.5), only_while=within("mill", 60))
        still = [(232.188 + way, 252.188 + way), (232.188 + way - 720, 252.188 + way - 720)]
        room = corridor(diagram, "die", rule, still=still, cells=60)
        assert room.cells_deg.min() > 1e-3
        assert room.cells_deg.sum() == pytest.approx(360)
        assert room.still.sum() > 3
        assert len(room.stretches) == 1


def test_where_it_moves_is_between_the_still_arcs() -> None:
    die = make_die(down_deg=(205, 265), stroke_mm=10)
    room = corridor(make_diagram(make_mill(), die), "die", RULE, still=[(350, 370), (205, 265)])
    ends = [
        tuple(round(float(room.angle_deg[n % len(room.still)]) % 360) % 360 for n in stretch)
        for stretch in room.stretches
    ]
    assert sorted(ends) == [(10, 205), (265, 350)]
    assert all(first < last for first, last in room.stretches)
    assert room.cells_deg[room.still_cells].sum() == pytest.approx(80)


def test_a_still_arc_of_a_turret_goes_on_over_the_beginning_of_its_turn() -> None:
    """Where its position at the first node is a pitch less than at the end of the last cell."""
    mill = cm.indexing_motion(
        "mill", cm.dwell(100), cm.rise(100, over_deg=100), cm.dwell(160), stops=24
    )
    free = ClearanceRule(beyond("die", 100), only_while=within("mill", 0.65))
    room = corridor(make_diagram(mill, make_die()), "mill", free, still=[(300, 420)], cells=36)
    assert room.cells_deg[room.still_cells].sum() == pytest.approx(120)
    [(first, last)] = room.stretches
    assert (room.angle_deg[first], room.angle_deg[last]) == pytest.approx((60, 300))
    assert room.next_of(room.low_mm)[-1] == 100


@examples(40)
@given(st.floats(-720, 720), st.integers(12, 200), st.floats(0.1, 45))
def test_no_place_in_the_room_breaks_the_rule(way: float, cells: int, off: float) -> None:
    """The die at its highest limit is never beyond 19 mm where the mill is not within."""
    rule = ClearanceRule(beyond("die", 19), only_while=within("mill", off))
    mill, die = make_mill().shifted(way), make_die().shifted(way)
    room = corridor(
        make_diagram(mill, die), "die", rule, still=[(205 + way, 305 + way)], cells=cells
    )
    ahead: Array = room.angle_deg
    middles = ahead + room.cells_deg / 2
    offs = np.asarray(mill.offset_mm(middles))
    limited = np.minimum(room.high_mm, room.next_of(room.high_mm)) <= 19
    assert np.all(limited[offs > off + 1e-6])
    held = (room.high_mm == 19) & (room.next_of(room.high_mm) == 19)
    assert np.all(offs[held] > off - 1e-6)
    assert room.low_mm[room.still] == pytest.approx(die_mm((ahead - way) % 360)[room.still])


@pytest.mark.parametrize("stop", [-3, 0, 1, 24])
def test_at_the_edge_of_a_band_it_is_about_the_same_stop(stop: int) -> None:
    """Also where a solver has rounded the least position by a little."""
    band = Band(np.arange(2), np.array([0.0, 100 / 24]), -0.65, 0.65, 100 / 24)
    low, high = band.limits_mm(stop)
    for places in (low, low - 1e-10, low + 1e-10, high):
        assert band.stops_at(places).tolist() == [stop, stop]


@pytest.mark.parametrize("still", ["#..##..", "....#..", ".#....#", "......."])
def test_a_node_in_a_still_arc_or_beside_one_is_not_held_off_its_limits(still: str) -> None:
    flags, free = np.array([*still]) == "#", np.full(len(still), INFINITE)
    angles = np.array([50.0 * n for n in range(len(still))])
    room = Corridor(angles, -free, free, flags, 0)
    around = [flags[[n - 1, n, (n + 1) % len(still)]].any() for n in range(len(still))]
    assert room.inner.tolist() == [not each for each in around]
