"""The timing chart on paper: what is on the page, where, and that nothing covers anything."""

import re
import zlib
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from cartons import all_dies, packaging_machine, pusher_rule
from machines import RULE, make_diagram, make_die, make_mill
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.text import Text
from matplotlib.transforms import Bbox

import cammotion as cm
from cammotion.views.chart import _MARGIN, draw_chart
from cammotion.views.chart_lanes import beside
from cammotion.views.names import ELLIPSIS

DAY = "2026-11-27"
A4 = 297.0, 210.0


def page(diagram: cm.TimingDiagram, *rules: cm.ClearanceRule, scale: float = 1.0) -> Figure:
    return draw_chart(diagram, scale, ("Cartoner 7", DAY), rules, {})


def texts(figure: Figure) -> list[str]:
    return [text.get_text() for text in figure.axes[0].texts if text.get_text()]


def boxes(figure: Figure) -> list[tuple[str, Bbox]]:
    renderer = FigureCanvasAgg(figure).get_renderer()  # type: ignore[no-untyped-call]
    found = [text for text in figure.axes[0].texts if text.get_text()]
    for text in found:
        text.set_bbox(None)
    return [(text.get_text(), text.get_window_extent(renderer)) for text in found]


def grippers(count: int, called: str = "Übergabe-Greifer {} (Station {})") -> cm.TimingDiagram:
    """Return a machine of parts whose names differ in a number."""
    moves = cm.rise(30, over_deg=60), cm.dwell(40), cm.return_(30, over_deg=80), cm.dwell(180)
    return cm.TimingDiagram(
        [cm.motion(called.format(n, n + 2), *moves, start_deg=25 * n) for n in range(count)], 3000
    )


def names_beside(figure: Figure, count: int) -> list[str]:
    """Return what is written in bold beside each lane, its lines joined, from the top down."""
    bold = [text for text in figure.axes[0].texts if text.get_fontweight() == "bold"]
    beside = [text for text in bold if text.get_horizontalalignment() == "right"]
    curves = [line for line in figure.axes[0].lines if len(np.asarray(line.get_xdata())) > 10]
    middles = [np.mean([np.min(y), np.max(y)]) for y in (line.get_ydata() for line in curves)]
    assert len(middles) == count
    lanes: list[list[str]] = [[] for _ in middles]
    for text in beside:
        nearest = int(np.argmin(np.abs(np.subtract(middles, text.get_position()[1]))))
        lanes[nearest].append(text.get_text())
    return [" ".join(lines) for lines in lanes]


@pytest.mark.parametrize("count", [2, 8, 24])
@pytest.mark.parametrize("scale", [1.0, 2**0.5])
def test_no_text_covers_another_or_leaves_the_page(count: int, scale: float) -> None:
    diagram = packaging_machine(count)
    expect_clear(page(diagram, *((pusher_rule(diagram),) if count > 2 else ()), scale=scale), scale)


@pytest.mark.parametrize("count", [1, 8, 17, 24])
def test_long_names_and_many_broken_rules_cover_nothing(count: int) -> None:
    diagram = grippers(count, "Übergabe-Greifer {} an der Station {} des Auslaufbandes")
    first = diagram.names[0]
    rules = [cm.ClearanceRule(cm.beyond(n, 2), cm.within(first, 0.5)) for n in diagram.names[1:]]
    expect_clear(page(diagram, *rules))


def expect_clear(figure: Figure, scale: float = 1.0) -> None:
    """Fail where a text covers another or leaves the frame of the page."""
    found = boxes(figure)
    touch = 0.3 / 25.4 * figure.dpi * scale
    covering = [
        (one, other)
        for (one, a), (other, b) in combinations(found, 2)
        if min(a.x1, b.x1) - max(a.x0, b.x0) > touch and min(a.y1, b.y1) - max(a.y0, b.y0) > touch
    ]
    assert covering == []
    whole = Bbox.union([box for _, box in found])
    width, height = figure.get_size_inches() * figure.dpi
    edge = 10 / 297 * width
    assert whole.x0 >= edge
    assert whole.y0 >= edge
    assert whole.x1 <= width - edge
    assert whole.y1 <= height - edge


def test_each_curve_has_its_angles_at_its_corners() -> None:
    figure = page(make_diagram())
    curves = {line.get_label(): line for line in figure.axes[0].lines}
    x, y = (np.asarray(curves["die"].get_data()[n], dtype=float) for n in (0, 1))
    left, right = x.min(), x.max()
    angles = (x - left) / (right - left) * 360
    heights = (y - y.min()) / (y.max() - y.min()) * 50
    assert heights == pytest.approx(make_die().position_mm(angles), abs=1e-9)
    dots = [line for line in figure.axes[0].lines if line.get_marker() == "o"]
    places = sorted(
        (round((float(np.asarray(dot.get_xdata())[0]) - left) / (right - left) * 360, 6))
        for dot in dots
    )
    assert places == [0, 0, 150, 150, 205, 305]
    written = texts(figure)
    assert [text for text in written if text in {"0", "150", "205", "305"}].count("150") == 2
    heights_of = {text.get_text(): text.get_position()[1] for text in figure.axes[0].texts}
    assert heights_of["205"] == heights_of["305"] > y.max()  # over what is high, under what is low
    assert any(
        text.get_text() == "150" and text.get_position()[1] < y.min()
        for text in figure.axes[0].texts
    )
    grid = [line for line in figure.axes[0].lines if np.ptp(np.asarray(line.get_xdata())) == 0]
    lines = {round(float(np.asarray(line.get_xdata())[0]), 6) for line in grid}
    assert {round(left + n * (right - left) / 36, 6) for n in range(37)} <= lines


def test_what_is_said_beside_the_lanes_and_in_the_block() -> None:
    said = texts(draw_chart(make_diagram(), 1.0, ("Cartoner 7", DAY), [RULE], {"die": 80}))
    for words in (
        *("mill", "100 mm, 24 stops", "1.12 m/s²", "die", "0 to 50 mm (35.8°)", "4.15 m/s²"),
        *("cycloidal", "Cartoner 7", "2000 pieces/h", "33.33 rpm, 1.8 s", DAY),
    ):
        assert words in said
    assert any(line.startswith("kept, 19 mm left: the die may be beyond") for line in said)
    still = cm.TimingDiagram([cm.motion("gate", cm.dwell(360), start_mm=3)], 60)
    assert {"stands", "3 mm", "no rules given"} <= {*texts(page(still))}


def test_a_broken_rule_is_hatched_in_its_two_lanes() -> None:
    wide = make_diagram(make_mill(), make_die(130), cm.motion("gate", cm.dwell(360)))
    figure = page(wide, RULE)
    found = cm.find_violations(wide, RULE)
    hatched = [p for p in figure.axes[0].patches if isinstance(p, Rectangle) and p.get_hatch()]
    assert len(hatched) == 2 * len(found)
    assert len({round(box.get_y(), 6) for box in hatched}) == 2
    assert any(line.startswith(f"BROKEN by {found[0].excess_mm:.3g} mm") for line in texts(figure))


def test_more_rules_than_have_room_are_counted() -> None:
    loose = [
        cm.ClearanceRule(cm.beyond("die", 20 + n), RULE.only_while, name=f"rule {n}")
        for n in range(9)
    ]
    said = texts(page(make_diagram(), *loose))
    assert "and 5 more, 0 of all are broken" in said


@pytest.mark.parametrize("count", [4, 8])
def test_a_name_that_is_long_has_two_lines(count: int) -> None:
    diagram = grippers(count)
    assert names_beside(page(diagram), count) == [*diagram.names]


@pytest.mark.parametrize("count", [4, 16, 24])
@pytest.mark.parametrize(
    "called",
    [
        "Übergabe-Greifer {} (Station {})",
        "Übergabegreiferschwenkeinheit {}",
        "the gripper number {} of those that hand over the cartons to the belt",
    ],
)
def test_long_names_stay_apart_and_are_shortened_once(count: int, called: str) -> None:
    shown = names_beside(page(grippers(count, called)), count)
    assert len({*shown}) == count
    assert not any(name.endswith(ELLIPSIS) or 2 * ELLIPSIS in name for name in shown)


def rules_of(figure: Figure) -> str:
    """Return what the block below says of the rules, its lines joined."""
    below = [text for text in figure.axes[0].texts if text.get_position()[0] < 40]
    lines = [text for text in below if text.get_horizontalalignment() == "left"]
    lines.sort(key=lambda text: -text.get_position()[1])
    return " ".join(text.get_text() for text in lines)


def broken_by_all(diagram: cm.TimingDiagram) -> list[cm.ClearanceRule]:
    first = diagram.names[0]
    return [
        cm.ClearanceRule(cm.beyond(first, 12), cm.within(name, 3.5 + n / 10))
        for n, name in enumerate(diagram.names[1:])
    ]


def test_a_long_rule_is_wrapped_and_keeps_its_limit() -> None:
    long = "Vorderschlitten mit Greiferzange {}"
    diagram = grippers(2, long)
    said = rules_of(page(diagram, *broken_by_all(diagram)))
    assert said.startswith("BROKEN by ")
    assert said.endswith(
        f"the {long.format(0)} may be beyond 12 mm only while the {long.format(1)} is within 3.5 mm"
    )


def test_all_broken_rules_are_listed_where_the_page_has_room() -> None:
    diagram = grippers(6, "Vorderschlitten mit Greiferzange {}")
    rules = broken_by_all(diagram)
    assert len({found.rule for found in cm.find_violations(diagram, rules)}) == 5
    kept = cm.ClearanceRule(cm.beyond(diagram.names[1], 39), cm.within(diagram.names[2], 3))
    said = rules_of(page(diagram, kept, *rules))
    for rule in rules:
        assert f"mm: {rule}" in said
    assert said.count("BROKEN") == 5


def test_broken_rules_without_room_are_counted() -> None:
    diagram = packaging_machine(24)
    rules = all_dies(diagram)
    broken = len({found.rule for found in cm.find_violations(diagram, rules)})
    said = rules_of(page(diagram, *rules))
    shown = said.count("BROKEN")
    assert 5 <= shown < broken
    assert said.endswith(f"and {len(rules) - shown} more, {broken - shown} of them broken")


@pytest.mark.parametrize(("paper", "points"), [("A4", (842, 595)), ("A3", (1191, 842))])
def test_the_page_is_one_of_lines_and_letters(
    tmp_path: Path, paper: str, points: tuple[int, int]
) -> None:
    file = cm.write_chart(make_diagram(), tmp_path / "chart.pdf", rules=RULE, paper=paper)
    content = file.read_bytes()
    ((width, height),) = re.findall(rb"/MediaBox \[ 0 0 ([\d.]+) ([\d.]+) \]", content)
    assert (float(width), float(height)) == pytest.approx(points, abs=1)
    assert b"/Subtype /Image" not in content
    streams = re.findall(rb"stream\n(.*?)\nendstream", content, re.DOTALL)
    drawn = b"".join(map(zlib.decompress, streams))
    assert re.search(rb"[\d.]+ G\b", drawn)  # a grey
    assert not re.search(rb"[\d.]+ [\d.]+ [\d.]+ (?:rg|RG)\b", drawn)  # and no colour
    again = cm.write_chart(make_diagram(), tmp_path / "same.pdf", rules=RULE, paper=paper)
    assert again.read_bytes() == content


def test_nothing_is_written_over(tmp_path: Path) -> None:
    file = cm.write_chart(make_diagram(), tmp_path / "chart.svg")
    before = file.read_bytes()
    with pytest.raises(cm.InputError, match="is there already and was left as it is"):
        cm.write_chart(make_diagram(), file, title="another")
    assert file.read_bytes() == before
    cm.write_chart(make_diagram(), file, title="another", overwrite=True)
    assert file.read_bytes() != before


def test_what_is_no_chart(tmp_path: Path) -> None:
    with pytest.raises(cm.InputError, match=r"let its name end in .pdf, .svg or .png"):
        cm.write_chart(make_diagram(), tmp_path / "chart.doc")
    with pytest.raises(cm.InputError, match="There is no paper 'A5'"):
        cm.write_chart(make_diagram(), tmp_path / "chart.pdf", paper="A5")
    with pytest.raises(cm.InputError, match="no motion 'arm'"):
        cm.write_chart(make_diagram(), tmp_path / "chart.pdf", radius_mm={"arm": 80})
    with pytest.raises(cm.InputError, match="radius is -1 mm"):
        cm.write_chart(make_diagram(), tmp_path / "chart.pdf", radius_mm={"die": -1})
    with pytest.raises(cm.InputError, match="has 25 mechanisms"):
        cm.write_chart(packaging_machine(25), tmp_path / "chart.pdf")
    assert list(tmp_path.iterdir()) == []


def test_rise_and_return_by_two_laws_have_a_line_each() -> None:
    rise = cm.rise(40, over_deg=80, law="modified trapezoid")
    gripper = cm.motion("gripper", rise, cm.return_(40, over_deg=100), cm.dwell(180))
    dial = cm.indexing_motion("dial", cm.rise(50, over_deg=90), cm.dwell(270), stops=12)
    assert beside(gripper, 1, None).laws == ["↑ modified trapezoid", "↓ cycloidal"]
    assert beside(dial, 1, 100).stroke == "50 mm (28.6°), 12 stops"
    page = draw_chart(cm.TimingDiagram([dial, gripper], 2000), 1, ("cams", ""), (), {})
    words = {text.get_text() for text in page.findobj(Text)}
    assert {"↑ modified trapezoid", "↓ cycloidal", "cycloidal"} <= words


@pytest.mark.parametrize(("count", "shown"), [(1, 3), (8, 3), (24, 1)])
def test_laws_that_have_no_room_beside_their_lane_are_counted(count: int, shown: int) -> None:
    laws, ways = [*cm.LAWS][:8], [cm.rise, cm.return_] * 4
    moves = [way(20, over_deg=40, law=law) for way, law in zip(ways, laws, strict=True)]
    dies = [cm.motion(f"die {n}", *moves, cm.dwell(40)) for n in range(count)]
    figure = page(cm.TimingDiagram(dies, 2000))
    expect_clear(figure, 1)
    assert texts(figure).count(f"and {len(laws) - shown} more") == count


def test_a_title_ends_within_its_frame() -> None:
    for count in range(20, 120, 20):
        figure = draw_chart(make_diagram(), 1.0, ("M" + "a" * count, DAY), [RULE], {})
        (title,) = (box for said, box in boxes(figure) if said.startswith("Ma"))
        assert title.x1 < figure.bbox.width * (1 - _MARGIN / 297)


def test_what_stands_is_at_one_place_and_a_fast_shaft_is_counted_in_whole() -> None:
    still = cm.motion("stop", cm.dwell(360), start_mm=5.26)
    assert beside(still, 0, None).stroke == "5.26 mm"
    said = texts(page(cm.TimingDiagram([still], 1e6)))
    assert any(text.startswith("16667 rpm, ") for text in said)


def test_a_rule_without_a_distance_is_kept_without_one() -> None:
    still = cm.TimingDiagram([make_mill(), cm.motion("stop", cm.dwell(360))], 2000)
    rule = cm.ClearanceRule(cm.moving("stop"), only_while=cm.standing("mill"))
    (said,) = [text for text in texts(page(still, rule)) if text.startswith("kept")]
    assert said.startswith("kept: ")
