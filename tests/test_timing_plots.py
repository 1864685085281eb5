"""Timing diagram and clearance map show what the diagram says, and what the rules forbid."""

import dataclasses
from collections.abc import Iterator
from itertools import pairwise

import matplotlib as mpl
import numpy as np
import pytest
from machines import RULE, make_diagram, make_die, make_mill
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Rectangle
from matplotlib.transforms import Bbox

import cammotion as cm
from cammotion.rules.conditions import Condition
from cammotion.views.displacement import displacement
from cammotion.views.pictures import PictureFigure, describe

mpl.use("agg")

BEFORE = make_diagram()
AFTER = cm.widest_move(BEFORE, "die", RULE).diagram
TOO_WIDE = make_diagram(make_mill(), make_die(130))
TWELVE = make_diagram(
    make_mill(),
    *(
        cm.motion(
            f"tool {number}",
            cm.rise(10 + number, over_deg=60),
            cm.dwell(40),
            cm.return_(10 + number, over_deg=60),
            cm.dwell(200),
            start_deg=30 * number,
        )
        for number in range(11)
    ),
)


@pytest.fixture(autouse=True)
def _no_trace() -> Iterator[None]:
    settings = mpl.rcParams.copy()
    yield
    plt.close("all")
    assert mpl.rcParams == settings


def texts(ax: Axes) -> list[str]:
    return [text.get_text() for text in ax.texts]


def key(ax: Axes) -> list[str]:
    legend = ax.get_legend()
    assert legend is not None
    return [text.get_text() for text in legend.get_texts()]


def bars(ax: Axes) -> list[tuple[float, float, str | None]]:
    """Read start, end and hatch off the bars beneath the curves."""
    boxes = [patch for patch in ax.figure.axes[1].patches if isinstance(patch, Rectangle)]
    return [(box.get_x(), box.get_x() + box.get_width(), box.get_hatch()) for box in boxes]


def test_each_curve_is_the_movement_of_its_mechanism() -> None:
    ax = cm.plot_timing(AFTER)
    for line, motion in zip(ax.lines, AFTER.motions, strict=True):
        angles = np.asarray(line.get_xdata(), dtype=float)
        assert angles[0] == 0
        assert angles[-1] == 360
        assert np.allclose(line.get_ydata(), motion.position_mm(angles))
    assert len({line.get_color() for line in ax.lines}) == 2
    assert len({str(line.get_linestyle()) for line in ax.lines}) == 2
    assert texts(ax) == ["mill", "die"]


def test_the_angle_is_ticked_every_30_deg_in_every_row() -> None:
    ax = cm.plot_timing(BEFORE, rows=("velocity", "acceleration", "jerk"))
    assert len(ax.figure.axes) == 5
    for axis in ax.figure.axes:
        assert axis.get_xticks().tolist() == list(range(0, 361, 30))
        assert axis.get_xlim() == (0, 360)
    labels = [axis.get_xlabel() for axis in ax.figure.axes]
    assert labels == ["", "", "", "", "cam angle in deg"]
    assert ax.get_ylabel() == "displacement in mm"


@pytest.mark.parametrize("row", ["velocity", "acceleration", "jerk"])
def test_a_row_shows_its_curve(row: str) -> None:
    ax = cm.plot_timing(AFTER, rows=[row])
    for line, name in zip(ax.figure.axes[2].lines, AFTER.names, strict=False):
        angles = np.asarray(line.get_xdata(), dtype=float)
        assert np.array_equal(line.get_ydata(), getattr(AFTER, row)(name, angles))
    assert row in ax.figure.axes[2].get_ylabel()


def test_the_bars_show_each_segment_with_its_angle() -> None:
    ax = cm.plot_timing(BEFORE)
    assert bars(ax) == [
        (0, 150, "///"),
        (150, 360, ""),
        (150, 205, "///"),
        (205, 305, ""),
        (305, 360, "\\\\\\"),
        (0, 150, ""),
    ]
    assert texts(ax.figure.axes[1]) == ["150°", "210°", "55°", "100°", "55°", "150°"]
    assert [label.get_text() for label in ax.figure.axes[1].get_yticklabels()] == ["mill", "die"]


def test_an_angle_leaves_hatching_to_be_seen_at_both_sides() -> None:
    """Or rise and return look alike; where it has no room it is left out."""
    fourteen = [
        cm.motion(
            f"gripper {n}",
            cm.rise(30, over_deg=12 + 3 * n),
            cm.dwell(40),
            cm.return_(30, over_deg=12.5 + 3 * n),
            cm.dwell(295.5 - 6 * n),
        )
        for n in range(14)
    ]
    ax = cm.plot_timing(cm.TimingDiagram(fourteen, 3000)).figure.axes[1]
    ax.figure.canvas.draw()
    hatched = [
        box.get_window_extent()
        for box in ax.patches
        if isinstance(box, Rectangle) and box.get_hatch()
    ]
    point = ax.figure.dpi / 72
    papers = [mark for mark in ax.collections if isinstance(mark, PolyCollection)]
    corners = [path.vertices for mark in papers for path in mark.get_paths()]
    whites = [Bbox([*ax.transData.transform(each)[[0, 2]]]) for each in corners]
    inside = [(a, b) for a in whites for b in hatched if a.overlaps(b)]
    assert len(inside) > len(hatched) / 2
    for white, box in inside:
        assert white.x0 - box.x0 >= 3.9 * point
        assert box.x1 - white.x1 >= 3.9 * point


def test_a_bar_that_crosses_360_is_drawn_in_two_and_named_once() -> None:
    ax = cm.plot_timing(AFTER)
    start, end = AFTER["die"].moves[1].from_deg, AFTER["die"].moves[1].to_deg - 360
    parts = [(low, high) for low, high, hatch in bars(ax) if hatch == "\\\\\\"]
    assert np.allclose(parts, [(0, end), (start, 360)])
    assert texts(ax.figure.axes[1]).count("124.91°") == 2  # down and up


def shaded(ax: Axes) -> list[tuple[float, float]]:
    """Read the spans behind the curves off the picture."""
    spans = [patch for patch in ax.patches if isinstance(patch, Rectangle)]
    return sorted((span.get_x(), span.get_x() + span.get_width()) for span in spans)


def test_the_overlap_is_shaded() -> None:
    assert shaded(cm.plot_timing(BEFORE)) == []
    ax = cm.plot_timing(AFTER, rules=RULE)
    assert np.allclose(shaded(ax), [(0, 69.9053), (80.0947, 150)], atol=1e-4)
    assert key(ax) == ["rise", "return", "dwell", "overlap"]


def test_a_collision_is_marked_where_it_is() -> None:
    ax = cm.plot_timing(TOO_WIDE, rules=RULE)
    violations = cm.find_violations(TOO_WIDE, RULE)
    assert key(ax)[-1] == "rule broken"
    for violation in violations:
        distances = np.subtract(shaded(ax), (violation.start_deg, violation.end_deg))
        assert np.abs(distances).max(axis=1).min() < 1e-9


def test_what_rounding_leaves_of_a_belts_acceleration_is_none() -> None:
    x = np.linspace(0, 1, 37)
    even = cm.law_from_points(x, x, end_slopes=(1, 1))
    belt = cm.indexing_motion("belt", cm.rise(100, over_deg=360, law=even), stops=24)
    crowd = cm.TimingDiagram([belt, *TWELVE.motions[1:]], 2000)
    lower = cm.plot_timing(crowd, rows=["acceleration"]).figure.axes[2]
    assert not np.any(np.asarray(lower.lines[0].get_ydata()))
    assert texts(lower)[0] == "0"


def test_a_broken_rule_is_marked_on_its_two_lanes_and_named() -> None:
    rule = cm.ClearanceRule(cm.beyond("tool 2", 5), cm.within("mill", 1), name="clear of mill")
    found = cm.find_violations(TWELVE, rule)
    ax = cm.plot_timing(TWELVE, rules=rule)
    boxes = [box for box in ax.patches if isinstance(box, Rectangle) and box.get_hatch() == "x"]
    lanes = {(box.get_x(), box.get_x() + box.get_width(), round(box.get_y())) for box in boxes}
    expected = {
        (start % 360, end % 360 or 360, 11 - row)
        for row in (0, 3)
        for start, end in ((one.start_deg, one.end_deg) for one in found)
    }
    assert all(any(np.allclose(lane, one) for one in expected) for lane in lanes)
    assert len(lanes) == len(expected) == 2 * len(found) > 0
    assert isinstance(ax.figure, PictureFigure)
    words = describe(ax.figure)
    assert f"clear of mill broken from {found[0].start_deg:.5g} to" in words
    assert "broken: clear of mill" in words
    many = [dataclasses.replace(rule, name=f"rule {n}") for n in range(5)]
    said = [
        text
        for text in texts(
            cm.plot_timing(
                TOO_WIDE, rules=[dataclasses.replace(RULE, name=one.name) for one in many]
            )
        )
        if "broken" in text
    ]
    assert said == ["broken: rule 2 (and 2 more)", "broken: rule 1", "broken: rule 0"]
    (named,) = [t for t in ax.texts if t.get_text() == "broken: clear of mill"]
    assert (getattr(named, "xy", None), named.get_horizontalalignment()) == (
        (1, 1),
        "right",
    )  # over the frame's end


def test_a_broken_rule_is_marked_on_both_curves() -> None:
    ax = cm.plot_timing(TOO_WIDE, rules=RULE)
    (first, *_) = cm.find_violations(TOO_WIDE, RULE)
    marks = [mark for mark in ax.collections if isinstance(mark, LineCollection)]
    assert len(marks) == 2 * len(cm.find_violations(TOO_WIDE, RULE))
    for mark, name in zip(marks[:2], ("die", "mill"), strict=True):
        ((start, low), *_, (end, high)) = mark.get_segments()[0]
        assert (start, end) == pytest.approx((first.start_deg, first.end_deg))
        assert [low, high] == pytest.approx(TOO_WIDE.position_mm(name, [start, end]))


def test_twelve_mechanisms_get_a_lane_each() -> None:
    """With its name beside it, and its range at the other end."""
    ax = cm.plot_timing(TWELVE)
    to_axes = ax.transData.inverted()
    spans = []
    for line, motion in zip(ax.lines, TWELVE.motions, strict=True):
        angles = np.asarray(line.get_xdata(), dtype=float)
        assert np.allclose(line.get_ydata(), motion.position_mm(angles))
        drawn = to_axes.transform(line.get_transform().transform(line.get_xydata()))
        spans.append((drawn[:, 1].min(), drawn[:, 1].max()))
    assert all(low - above == pytest.approx(0.25) for (low, _), (_, above) in pairwise(spans))
    assert [label.get_text() for label in ax.get_yticklabels()] == list(TWELVE.names)
    assert texts(ax)[:2] == ["0 to 100", "0 to 10"]


def test_the_movement_of_an_indexing_motion_counts_from_the_nearest_stop() -> None:
    """Also where its move crosses 360 deg, and where it goes backwards."""
    whole, half = (cm.rise(100, over_deg=150), cm.dwell(210)), (75, 255)
    late = cm.indexing_motion("late", *whole, stops=4, start_deg=285)
    assert displacement(late, np.array([0.0, *half])) == pytest.approx([-50, 0, 0], abs=1e-9)
    assert displacement(late, np.array([359.9999]))[0] == pytest.approx(50, abs=1e-3)
    assert np.all(np.diff(displacement(late, np.arange(360.0))) >= -1e-9)
    nearly = cm.indexing_motion("nearly", *whole, stops=4, start_deg=225)
    assert displacement(nearly, np.array([0.0, 15, 200]))[0] == pytest.approx(-0.6451, abs=1e-4)
    assert displacement(nearly, np.array([0.0, 15, 200]))[1:] == pytest.approx([0, 0], abs=1e-9)
    back = cm.indexing_motion("back", cm.return_(60, over_deg=90), cm.dwell(270), stops=6)
    assert displacement(back, np.array([0, 45, 90, 200])) == pytest.approx([0, -30, -60, -60])
    last = cm.indexing_motion("last", *whole, stops=1, start_deg=225)  # its stops close in the turn
    assert displacement(last, np.array([0, 15, 360])) == pytest.approx(
        [-0.6451, 0, 99.3549], abs=1e-4
    )


@pytest.mark.parametrize(
    "only_while", [cm.beyond("mill", 0.5), cm.within("mill", 49)], ids=["at the left", "at the end"]
)
def test_a_narrow_region_has_its_name_beside_it(only_while: Condition) -> None:
    """It lay over the axis and the names of angles."""
    ax = cm.plot_clearance(BEFORE, cm.ClearanceRule(cm.within("die", 5), only_while=only_while))
    (name,) = (text for text in ax.texts if text.get_text() == "forbidden")
    ax.figure.canvas.draw()
    word, region = name.get_window_extent(), ax.patches[0].get_window_extent()
    assert not word.overlaps(region)
    assert ax.bbox.x0 < word.x0 < word.x1 < ax.bbox.x1


def test_the_clearance_map_draws_each_path_and_the_forbidden_region() -> None:
    ax = cm.plot_clearance({"no overlap": BEFORE, "overlap": AFTER}, RULE)
    (region,) = [patch for patch in ax.patches if isinstance(patch, Rectangle)]
    assert region.get_xy() == (0.65, 19)
    assert region.get_hatch() == "xx"
    for line, diagram in zip(ax.lines[::2], (BEFORE, AFTER), strict=True):
        angles = np.union1d(np.linspace(0, 360, 721), [135])
        path = set(zip(line.get_xdata(), line.get_ydata(), strict=True))  # type: ignore[arg-type]
        walked = zip(
            diagram.offset_mm("mill", angles), diagram.offset_mm("die", angles), strict=True
        )
        assert set(walked) <= path
    assert key(ax) == ["no overlap", "overlap"]
    assert ax.get_xlabel() == "mill: distance from a stop in mm"
    assert ax.get_ylabel() == "die: position in mm"
    assert "forbidden" in texts(ax)


def test_the_angles_at_a_path_have_its_colour_also_where_the_last_one_has_none() -> None:
    ax = cm.plot_clearance({"overlap": AFTER, "no overlap": BEFORE}, RULE)
    angles = [text for text in ax.texts if text.get_text().endswith("°")]
    assert [text.get_text() for text in angles] == ["15/135°", "30/120°"]
    assert {text.get_color() for text in angles} == {ax.lines[0].get_color()}


@pytest.mark.parametrize("start_mm", [-50, -1000, 3, 1000])
@pytest.mark.parametrize("design", [BEFORE, AFTER])
def test_dots_are_where_both_motions_are_under_way_wherever_the_die_begins(
    design: cm.TimingDiagram, start_mm: float
) -> None:
    die = design["die"]
    parts = [
        dataclasses.replace(s, from_mm=s.from_mm + start_mm, to_mm=s.to_mm + start_mm)
        for s in die.segments
    ]
    rule = cm.ClearanceRule(cm.beyond("die", 19 + start_mm), only_while=cm.within("mill", 0.65))
    moved = cm.plot_clearance(design.with_motion(cm.Motion("die", parts)), rule)
    usual = cm.plot_clearance(design, RULE)
    dots, (x, y) = (np.asarray(ax.lines[1].get_data()) for ax in (moved, usual))
    assert dots == pytest.approx(np.array([x, y + start_mm]), abs=1e-9)
    assert texts(moved) == texts(usual)


def test_the_path_of_the_widest_move_touches_the_region_and_stays_out() -> None:
    ax = cm.plot_clearance(AFTER, RULE)
    across, up = (np.asarray(data) for data in ax.lines[0].get_data())
    assert not ((across > 0.65 + 1e-9) & (up > 19 + 1e-9)).any()


def test_a_rule_the_other_way_round_forbids_the_other_corner() -> None:
    gate = cm.ClearanceRule(cm.within("die", 5), only_while=cm.beyond("mill", 10))
    ax = cm.plot_clearance(BEFORE, gate, span_mm=50)
    (region,) = [patch for patch in ax.patches if isinstance(patch, Rectangle)]
    (left, low), (right, high) = region.get_bbox().get_points()
    assert left <= 0 >= low
    assert (right, high) == (10, 5)


def test_plots_draw_into_the_axes_they_are_given() -> None:
    _, axes = plt.subplots(1, 2)
    assert cm.plot_timing(AFTER, ax=axes[0]) is axes[0]
    assert cm.plot_clearance(AFTER, RULE, ax=axes[1]) is axes[1]
    assert len(plt.get_fignums()) == 1


def test_plots_refuse_what_they_cannot_draw() -> None:
    with pytest.raises(cm.InputError, match="There is no row 'speed': use one of 'velocity'"):
        cm.plot_timing(BEFORE, rows=["speed"])
    with pytest.raises(cm.InputError, match="There is no design to draw"):
        cm.plot_clearance({}, RULE)
    with pytest.raises(cm.InputError, match="There is no motion 'arm': use one of 'mill', 'die'"):
        cm.plot_clearance(BEFORE, cm.ClearanceRule(cm.beyond("arm", 1), cm.within("mill", 1)))
    with pytest.raises(cm.InputError, match="is given diagram=None: give a timing diagram"):
        cm.plot_timing(None)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="colour"):
        cm.plot_timing(BEFORE, colour="red")  # type: ignore[call-arg]


@pytest.mark.filterwarnings("error")
def test_a_map_beside_what_never_moves_has_a_width() -> None:
    table = cm.motion("table", cm.dwell(360))
    gate = cm.ClearanceRule(cm.beyond("die", 60), only_while=cm.within("table", 0.65))
    ax = cm.plot_clearance(cm.TimingDiagram([table, cm.EXAMPLE.die], 2000), gate)
    assert ax.get_xlim()[1] == 1


@pytest.mark.parametrize("start", [0, -80, 400])
def test_a_clearance_map_shows_a_part_wherever_it_moves(start: float) -> None:
    """Below 0, or far from it: the whole path is in the picture, and no warning is given."""
    down = cm.return_(36, over_deg=75), cm.dwell(105), cm.rise(36, over_deg=100), cm.dwell(80)
    low = cm.motion("low", *down, start_mm=start)
    moves = cm.rise(2, over_deg=170), cm.return_(2, over_deg=190)
    slide = cm.motion("slide", *moves, start_mm=start)
    rule = cm.ClearanceRule(cm.beyond("low", start - 10), only_while=cm.within("slide", start + 1))
    ax = cm.plot_clearance(cm.TimingDiagram([low, slide], 2000), rule)
    path = np.concatenate([line.get_xydata() for line in ax.lines])
    for values, (near, far), stroke in zip(
        path.T, (ax.get_xlim(), ax.get_ylim()), (2, 36), strict=True
    ):
        assert near <= values.min() <= values.max() <= far
        assert far - near < 1.2 * stroke


def test_broken_rules_without_a_name_are_counted_beside_those_with_one() -> None:
    named, bare = (
        cm.ClearanceRule(cm.beyond("die", mm), only_while=cm.within("mill", 0.65), name=name)
        for mm, name in ((19, "die clear"), (19.2, ""))
    )
    ax = cm.plot_timing(TOO_WIDE, rules=[named, bare])
    said = [text.get_text() for text in ax.texts]
    assert "broken: die clear (and 1 rule without a name)" in said


@pytest.mark.parametrize(
    ("row", "law", "count"),
    [
        ("velocity", "4-5-6-7 polynomial", 5),
        ("acceleration", "4-5-6-7 polynomial", 5),
        ("acceleration", "cubic", 5),  # it is largest just before it jumps
        ("acceleration", "cubic", 2),
        ("jerk", "4-5-6-7 polynomial", 5),
    ],
)
def test_the_range_of_a_curve_is_that_of_the_peaks(row: str, law: str, count: int) -> None:
    up, down = cm.rise(50, over_deg=16.6, law=law), cm.return_(50, over_deg=20.6, law=law)
    moves = up, cm.dwell(100), down, cm.dwell(222.8)
    motions = [cm.motion(f"m{n}", *moves, start_deg=10.13 + 40 * n) for n in range(count)]
    diagram = cm.TimingDiagram(motions, 2000)
    ax = cm.plot_timing(diagram, rows=[row])
    peak = getattr(diagram, f"peak_{row}")("m0")
    order = 1 + ["velocity", "acceleration", "jerk"].index(row)
    for line, motion in zip(ax.figure.axes[-1].lines[:: 1 + (count > 4)], motions, strict=False):
        drawn = np.asarray(line.get_ydata(), dtype=float)
        assert np.abs(drawn).max() == pytest.approx(peak, rel=1e-9)
        ends = np.array(motion.curve.derived(order).extremes) / diagram.cycle_time_s**order
        ends *= 360**order / 1000
        assert [drawn.min(), drawn.max()] == pytest.approx(ends, rel=1e-6)
