"""The machine in motion without a browser: its key frames, its texts, and what it refuses."""

import base64
import itertools
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import drawsvg as draw
import numpy as np
import pytest
from bs4 import BeautifulSoup
from hypothesis import given
from hypothesis import strategies as st
from machines import RULE, examples, make_diagram, make_die, make_mill
from notebook_lint import _svg_faults

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.views.animation.columns import Design
from cammotion.views.animation.keyframes import trace_acceleration
from cammotion.views.animation.picture import Animation, animate
from cammotion.views.animation.player import speeds_for
from cammotion.views.animation.slide import Slide
from cammotion.views.animation.svg import dark
from cammotion.views.ends import apart
from cammotion.views.names import text_px, wrap

MILL, DIE = make_mill(), make_die()
BEFORE = make_diagram(MILL, DIE)
AFTER = cm.widest_move(BEFORE, "die", RULE).diagram
EARLY_DIE = cm.motion(
    "die", cm.rise(50, over_deg=140), cm.dwell(100), cm.return_(50, over_deg=120), start_deg=65
)
COLLIDING = BEFORE.with_motion(EARLY_DIE)
DRUM = cm.TimingDiagram(
    [
        cm.indexing_motion(
            "drum", cm.return_(60, over_deg=120), cm.dwell(240), stops=5, start_deg=290, start_mm=7
        ),
        cm.motion(
            "needle",
            *(cm.return_(80, over_deg=60), cm.dwell(60), cm.rise(80, over_deg=80), cm.dwell(160)),
            start_deg=-70,
            start_mm=80,
        ),
    ],
    rate_per_hour=600,
)
DRUM_RULE = cm.ClearanceRule(cm.within("needle", 50), only_while=cm.within("drum", 1))
TWELVE = cm.TimingDiagram(
    [
        cm.indexing_motion(
            "table", cm.dwell(200), cm.rise(300, over_deg=160), stops=4, start_deg=30
        ),
        *(
            cm.motion(
                f"slide {number}",
                *(cm.rise(3**number / 9, over_deg=40), cm.dwell(20)),
                *(cm.return_(3**number / 9, over_deg=100), cm.dwell(200)),
                start_deg=31 * number,
            )
            for number in range(10)
        ),
        cm.motion("still", cm.dwell(360)),
    ],
    rate_per_hour=1500,
)
MACHINES: list[Any] = [
    pytest.param(BEFORE, [RULE], id="before"),
    pytest.param(AFTER, [RULE], id="after, over 360 deg"),
    pytest.param(COLLIDING, [RULE], id="colliding"),
    pytest.param(BEFORE, [], id="no rule"),
    pytest.param(DRUM, [DRUM_RULE], id="backwards"),
    pytest.param(TWELVE, [], id="twelve"),
]
ANGLES = np.linspace(0, 360, 3601)
NASTY = "<script>alert(1)</script>\"'&]]>\x08\n‮é漢"


def parse(svg: str) -> ElementTree.Element:
    return ElementTree.fromstring(svg)  # noqa: S314 - our own


def column_of(svg: str, number: int = 0) -> ElementTree.Element:
    """Return what is drawn of a design."""
    column = parse(svg).find(f".//*[@data-design='{number}']")
    assert column is not None
    return column


def part_of(column: ElementTree.Element, part: str, motion: int) -> ElementTree.Element:
    """Return a moving part by its name and the number of its motion."""
    found = column.findall(f".//*[@data-part='{part}'][@data-motion='{motion}']")
    assert found
    return found[0]


def moved(part: ElementTree.Element) -> Floats:
    """Return how far a part has gone from its place at 0 deg, at ANGLES, in px or deg."""
    animation = part.find("{*}animateTransform")
    if animation is None:
        return np.zeros_like(ANGLES)
    times = np.array([float(time) for time in animation.attrib["keyTimes"].split(";")])
    values = [float(value.split()[-1]) for value in animation.attrib["values"].split(";")]
    assert times[0] == 0
    assert times[-1] == 1
    assert (np.diff(times) >= 0).all()
    return np.interp(ANGLES, 360 * times, values)


@pytest.mark.parametrize(("diagram", "rules"), MACHINES)
def test_every_part_moves_as_its_formula_says(diagram: cm.TimingDiagram, rules: Any) -> None:
    column = column_of(animate(diagram, rules=rules).svg)
    for number, motion in enumerate(diagram.motions):
        way = np.asarray(motion.position_mm(ANGLES)) - motion.position_mm(0)
        if motion.stops is not None:
            degs = moved(part_of(column, "turret", number))
            wanted = way * 360 / (motion.stops * abs(motion.pitch_mm))
            apart = (
                degs - wanted + 180
            ) % 360 - 180  # the diagram counts from 0 after a whole turn
            assert np.abs(apart).max() < 0.2
            continue
        body = part_of(column, "body", number)
        goes_down = bool(rules) and motion.name == "die"
        shown = moved(body) / float(body.attrib["data-px-per-mm"]) * (1 if goes_down else -1)
        assert np.abs(shown - way).max() < 0.1


def test_a_turret_ends_its_turn_a_pitch_further() -> None:
    for diagram, way in ((BEFORE, 15), (DRUM, -72), (TWELVE, 90)):
        degs = moved(part_of(column_of(animate(diagram).svg), "turret", 0))
        assert degs[-1] == pytest.approx(way, abs=1e-3)


def test_a_dwell_needs_no_key_frames() -> None:
    body = part_of(column_of(animate(BEFORE, rules=RULE).svg), "body", 1)
    animation = body.find("{*}animateTransform")
    assert animation is not None
    times = [360 * float(time) for time in animation.attrib["keyTimes"].split(";")]
    assert not [time for time in times if 0 < time < 149.99 or 205.01 < time < 304.99]


@pytest.mark.parametrize(("diagram", "rules"), MACHINES)
def test_the_dots_stay_on_their_curves(diagram: cm.TimingDiagram, rules: Any) -> None:
    column = column_of(animate(diagram, rules=rules).svg)
    (cursor,) = column.findall(".//*[@data-part='cursor']")
    x = moved_across(cursor)
    assert np.abs(x - ANGLES / 360 * x[-1]).max() < 1e-3
    dots = column.findall(".//*[@data-part='dot']")
    lines = [
        line for line in column.findall(".//{*}path[@stroke-width='2']") if is_curve(line, x[-1])
    ]
    assert len(dots) == len(lines) > len(diagram.motions)
    parents = {child: parent for parent in column.iter() for child in parent}
    starts = [float(parents[dot].attrib["transform"].split()[-1].rstrip(")")) for dot in dots]
    for dot, start, line in zip(dots, starts, lines, strict=True):
        places = np.array([[float(n) for n in p.split(",")] for p in line.attrib["d"][1:].split()])
        is_jump = np.isin(np.round(x, 1), places[:-1, 0][np.diff(places[:, 0]) < 0.2])
        apart = np.abs(start + moved(dot) - np.interp(x, places[:, 0], places[:, 1]))
        assert apart[~is_jump].max() < 0.5


def moved_across(cursor: ElementTree.Element) -> Floats:
    animation = cursor.find("{*}animateTransform")
    assert animation is not None
    first, last = (float(value) for value in animation.attrib["values"].split(";"))
    return np.interp(ANGLES, [0, 360], [first, last])


def is_curve(line: ElementTree.Element, width: float) -> bool:
    """Whether a line goes through the whole chart."""
    places = line.attrib["d"].split()
    last = float(places[-1].split(",")[0])
    return len(places) > 1 and places[0].startswith("M0,") and abs(last - width) < 0.1


def test_the_acceleration_is_that_of_the_diagram() -> None:
    trace = trace_acceleration(AFTER["die"], 2000)
    wanted = np.asarray(AFTER.acceleration("die", ANGLES))
    drawn = np.interp(ANGLES, trace.angles_deg, trace.values)
    assert np.abs(drawn - wanted).max() < 2e-3 * AFTER.peak_acceleration("die")


def test_the_acceleration_has_its_peak_on_a_short_ramp() -> None:
    law = cm.fifth_degree_linear(0.99)
    parts = cm.rise(50, over_deg=90, law=law), cm.dwell(180), cm.return_(50, over_deg=90, law=law)
    fast = cm.TimingDiagram([cm.motion("fast", *parts, start_deg=300)], 2000)
    trace = trace_acceleration(fast["fast"], 2000)
    assert np.abs(trace.values).max() == pytest.approx(fast.peak_acceleration("fast"))


@pytest.mark.parametrize("rate_per_hour", [2000, 1])
def test_a_jump_of_the_acceleration_is_drawn_as_one(rate_per_hour: float) -> None:
    """Also of one that is smaller than what counts of a length in mm."""
    hard = cm.MotionLaw("parabola", cm.x**2 * (3 - 2 * cm.x))
    press = cm.motion(
        "press", cm.rise(10, over_deg=90, law=hard), cm.dwell(90), cm.return_(10, over_deg=180)
    )
    trace = trace_acceleration(press, rate_per_hour)
    at_90 = trace.values[np.isclose(trace.angles_deg, 90)]
    assert at_90[0] < -0.1 * (rate_per_hour / 2000) ** 2
    assert at_90[-1] == 0


def test_the_ticks_of_a_machine_that_hardly_turns_are_no_zeros() -> None:
    ticks = re.findall(r">(−?[\d.]+e−\d+)</text>", animate(BEFORE.at_rate(1e-3)).svg)
    assert ticks == ["−1e−12", "1e−12"]


def test_a_name_below_a_slide_is_shortened_once() -> None:
    parts = cm.rise(10, over_deg=60), cm.dwell(100), cm.return_(10, over_deg=60), cm.dwell(140)
    motions = [cm.motion(20 * f"m{number}", *parts) for number in range(10)]
    column = column_of(animate(cm.TimingDiagram(motions, 2000)).svg)
    bold = [text.text or "" for text in column.findall(".//{*}text[@font-weight='bold']")]
    for number in range(10):
        lines = [line for line in bold if f"m{number}" in line or f"{number}m" in line]
        assert "".join(lines).count("…") == 2  # there, and at its curve


def test_both_designs_share_their_scales() -> None:
    svg = animate({"no overlap": BEFORE, "overlap": AFTER}, rules=RULE).svg
    scales = [part_of(column_of(svg, n), "body", 1).attrib["data-px-per-mm"] for n in (0, 1)]
    assert scales[0] == scales[1]
    heights = [
        np.ptp(moved(column_of(svg, n).findall(".//*[@data-part='dot']")[-1])) for n in (0, 1)
    ]
    ratio = BEFORE.peak_acceleration("die") / AFTER.peak_acceleration("die")
    assert heights[0] / heights[1] == pytest.approx(ratio, rel=5e-3)


def test_the_die_waits_20_mm_above_a_pocket_31_mm_deep() -> None:
    """The measures of the picture in notebook 00 follow from the rule and the stroke."""
    column = column_of(animate(BEFORE, rules=RULE).svg)
    body = part_of(column, "body", 1)
    scale = float(body.attrib["data-px-per-mm"])
    tool = body.findall("{*}rect")[1].attrib
    tip, width = float(tool["y"]) + float(tool["height"]), float(tool["width"])
    rim = part_of(column, "turret", 0).find("{*}path")
    assert rim is not None
    pocket = near_the_top(rim.attrib["d"])
    assert -tip / scale == pytest.approx(24 * 100 / (2 * np.pi) + 20, abs=0.05)
    assert -pocket[1][1] / scale == pytest.approx(24 * 100 / (2 * np.pi) - 31, abs=0.05)
    assert (pocket[1][0] - pocket[0][0]) == pytest.approx(0, abs=0.1)
    assert (pocket[2][0] - pocket[1][0] - width) / scale == pytest.approx(2 * 0.65, abs=0.05)


def near_the_top(d: str) -> list[tuple[float, float]]:
    """Return the corners of the pocket under the die, in px."""
    ends = [tuple(map(float, part.split(",")[-2:])) for part in re.findall(r"[MLA]([^MLAZ]+)", d)]
    first = next(
        n for n, (x, y) in enumerate(ends) if -60 < x < 0 and abs(ends[n + 1][0] - x) < 0.1
    )
    return [(x, y) for x, y in ends[first : first + 4]]


@pytest.mark.parametrize("count", range(1, 5))
@pytest.mark.parametrize(("diagram", "rules"), MACHINES)
def test_a_drawing_is_complete_and_loads_nothing(
    diagram: cm.TimingDiagram, rules: Any, count: int
) -> None:
    animation = animate({f"design {n}": diagram for n in range(count)}, rules=rules)
    assert list(_svg_faults(animation.svg)) == []
    root = parse(animation.svg)
    assert root.attrib["role"] == "img"
    assert "design 0" in (root.findtext("{*}title") or "")
    assert (root.findtext("{*}desc") or "").startswith("The machine in motion")
    assert len(root.findall(".//*[@data-design]")) == count
    sizes = {
        float(text.attrib["font-size"]) for text in root.iter("{http://www.w3.org/2000/svg}text")
    }
    assert min(sizes) >= 11


parts_of_a_turn = st.lists(st.integers(5, 100), min_size=4, max_size=4).map(
    lambda parts: [part * 360 / sum(parts) for part in parts]
)


@st.composite
def machines(draw: st.DrawFn) -> tuple[cm.TimingDiagram, cm.ClearanceRule]:
    up, wait, down, rest = draw(parts_of_a_turn)
    start, stroke = draw(st.floats(-400, 800)), draw(st.floats(0.5, 400))
    die = cm.motion(
        "die",
        *(cm.rise(stroke, over_deg=up), cm.dwell(wait)),
        *(cm.return_(stroke, over_deg=down), cm.dwell(rest)),
        start_deg=start,
    )
    mill = cm.indexing_motion(
        "mill",
        *(cm.rise(draw(st.floats(1, 500)), over_deg=up), cm.dwell(360 - up)),
        stops=draw(st.integers(1, 60)),
        start_deg=-start,
    )
    return cm.TimingDiagram([mill, die], rate_per_hour=2000), cm.ClearanceRule(
        cm.beyond("die", draw(st.floats(-50, 500))),
        only_while=cm.within("mill", draw(st.floats(0, 100))),
    )


@examples(15)
@given(machine=machines())
def test_any_two_designs_are_small_and_exact(
    machine: tuple[cm.TimingDiagram, cm.ClearanceRule],
) -> None:
    diagram, rule = machine
    die = diagram["die"]
    animation = animate({"one": diagram, "two": diagram}, rules=rule)
    assert len(animation.svg.encode()) <= 60_000
    assert list(_svg_faults(animation.svg)) == []
    assert "nan" not in animation.svg
    body = part_of(column_of(animation.svg), "body", 1)
    shown = moved(body) / float(body.attrib["data-px-per-mm"])
    way = np.asarray(die.position_mm(ANGLES)) - die.position_mm(0)
    assert np.abs(shown - way).max() < 0.1
    collides = bool(cm.find_violations(diagram, rule))
    assert ("RULE BROKEN" in animation.svg) == collides == ("RULE BROKEN" in animation.description)


def test_a_collision_is_shown_in_words_while_it_lasts() -> None:
    (violation,) = cm.find_violations(COLLIDING, RULE)
    animation = animate({"overlap": AFTER, "too early": COLLIDING}, rules=RULE)
    assert str(violation) in animation.description
    good, bad = column_of(animation.svg, 0), column_of(animation.svg, 1)
    assert not good.findall(".//{*}animate")
    said = "".join(text for text in bad.itertext())
    assert "RULE BROKEN from 126.5 to 135°" in said
    assert "the die is 5.97 mm too deep at" in said
    flags = bad.findall(".//{*}animate")
    assert len(flags) == 3  # the die, the word, and what is said of it
    for flag in flags:
        assert flag.attrib["values"] == "hidden;visible;hidden"
        _, start, end = (360 * float(time) for time in flag.attrib["keyTimes"].split(";"))
        assert start == pytest.approx(violation.start_deg, abs=1e-3)
        assert end == pytest.approx(violation.end_deg, abs=1e-3)


def test_a_collision_over_the_end_of_the_turn_begins_visible() -> None:
    early = cm.motion(
        "die",
        *(cm.rise(50, over_deg=60), cm.dwell(100), cm.return_(50, over_deg=60), cm.dwell(140)),
        start_deg=250,
    )
    diagram = BEFORE.with_motion(early)
    late_mill = cm.indexing_motion(
        "mill", cm.rise(100, over_deg=150), cm.dwell(210), stops=24, start_deg=300
    )
    column = column_of(animate(diagram.with_motion(late_mill), rules=RULE).svg)
    flags = column.findall(".//{*}animate")
    assert flags
    for flag in flags:
        assert flag.attrib["values"].startswith("visible;hidden;")
        assert flag.attrib["values"].endswith(";visible")


def test_slides_collide_too() -> None:
    arm = cm.motion("arm", cm.rise(30, over_deg=180), cm.return_(30, over_deg=180))
    diagram = cm.TimingDiagram([DIE, arm], rate_per_hour=2000)
    rule = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("arm", 5))
    svg = animate(diagram, rules=rule).svg
    assert "the die is 31 mm too deep" in svg
    for motion in (0, 1):
        assert part_of(column_of(svg), "body", motion).findall(".//{*}animate")


def test_the_same_designs_give_the_same_bytes() -> None:
    """Whatever a run of Python takes for the hash of a name."""
    code = (
        "import cammotion as cm; wide = cm.EXAMPLE.diagram.with_motion("
        "cm.with_angle(cm.EXAMPLE.die, 69)); print(end=cm.animate("
        "{'a': cm.EXAMPLE.diagram, 'b': wide}, rules=cm.EXAMPLE.rule).svg)"
    )
    ran = subprocess.run(
        [sys.executable, "-c", code],
        env=os.environ | {"PYTHONHASHSEED": "0", "PYTHONUTF8": "1"},
        capture_output=True,
        encoding="utf-8",
        check=True,
    )
    before = cm.EXAMPLE.diagram
    wide = before.with_motion(cm.with_angle(cm.EXAMPLE.die, 69))
    assert ran.stdout == cm.animate({"a": before, "b": wide}, rules=cm.EXAMPLE.rule).svg


def test_whatever_a_user_types_stays_text() -> None:
    mill = cm.indexing_motion(NASTY, cm.rise(100, over_deg=150), cm.dwell(210), stops=24)
    die = cm.motion(NASTY + " die" * 40, *(cm.rise(50, over_deg=180), cm.return_(50, over_deg=180)))
    rule = cm.ClearanceRule(cm.beyond(die.name, 19), only_while=cm.within(mill.name, 0.65))
    diagram = cm.TimingDiagram([mill, die], rate_per_hour=2000)
    for rules in (rule, ()):
        animation = animate({NASTY: diagram}, rules=rules)
        assert list(_svg_faults(animation.svg)) == []
        root = parse(animation.svg)
        values = [value for element in root.iter() for value in element.attrib.values()]
        assert not any("alert" in value or "漢" in value for value in values)
        assert "<script>alert(1)</script>\"'&]]>" in "".join(root.itertext())
        page = BeautifulSoup(animation.player()._repr_mimebundle_()[0]["text/html"], "html.parser")
        assert page.script is None
        assert [tag.name for tag in page.find_all()] == ["style", "figure", "img"]
        assert "<script>" in str(page.img and page.img["alt"])


def test_ids_mean_the_same_in_every_drawing() -> None:
    """Two drawings in one page may share an id only if it is that of the same thing."""
    seen: dict[str, bytes] = {}
    for machine in MACHINES:
        diagram, rules = machine.values
        root = parse(animate(diagram, rules=rules).svg)
        for element in root.iter():
            if name := element.get("id"):
                content = ElementTree.tostring(element)
                assert seen.setdefault(name, content) == content
    assert seen


def test_a_reader_without_a_kernel_gets_the_moving_picture_and_words() -> None:
    animation = animate({"no overlap": BEFORE, "overlap": AFTER}, rules=RULE)
    data, _ = animation._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in data
    assert data["text/plain"] == animation.description
    image = BeautifulSoup(data["text/html"], "html.parser").select_one("figure > img")
    assert image is not None
    assert image["alt"] == animation.description
    picture = str(image["src"]).removeprefix("data:image/svg+xml;base64,")
    assert base64.b64decode(picture).decode() == animation.svg


def test_every_showing_says_the_same() -> None:
    bundles = [animate(BEFORE, rules=RULE)._repr_mimebundle_()[0] for _ in range(2)]
    for mime in ("text/plain", "text/html"):
        assert bundles[0][mime] == bundles[1][mime]


def test_the_player_gets_the_clock_of_the_drawing() -> None:
    player = animate(BEFORE, rules=RULE, turn_s=9).player()
    assert player.svg == animate(BEFORE, rules=RULE).svg
    assert (player.turn_s, player.cycle_s, player.speed) == (9, 1.8, 0.2)
    player.angle_deg = 75
    for angle in (400, -1, np.nan, "seventy", None):
        with pytest.raises(cm.InputError, match=r"^The cam angle .*: give .*180 deg"):
            player.angle_deg = angle
    assert player.angle_deg == 75


@pytest.mark.parametrize("cycle_s", [1e-3, 0.2, 1.8, 60, 1e5])
def test_every_machine_can_be_watched(cycle_s: float) -> None:
    speeds = speeds_for(cycle_s)
    assert 1.0 in speeds
    assert speeds == sorted(speeds)
    assert any(1 <= cycle_s / speed <= 40 for speed in speeds)


def test_saving_never_overwrites_unasked(tmp_path: Path) -> None:
    animation = animate(BEFORE, rules=RULE)
    path = animation.save(tmp_path / "machine.svg")
    assert path.read_text("utf-8") == animation.svg
    path.write_text("mine")
    with pytest.raises(cm.InputError, match=r"^The file machine\.svg is there already .*overwrite"):
        animation.save(path)
    assert path.read_text() == "mine"
    animation.save(str(path), overwrite=True)
    assert path.read_text("utf-8") == animation.svg
    with pytest.raises(cm.InputError, match=r"cannot be written .*choose a folder"):
        animation.save(tmp_path / "nowhere" / "machine.svg")
    with pytest.raises(cm.InputError, match="The path of the file is None: give one"):
        animation.save(None)  # type: ignore[arg-type]
    for name in ("a.gif", "a.mp4", "a.png", "a.html", "a"):
        for picture in (animation, animation.still(0)):
            with pytest.raises(cm.InputError, match=rf" {name}: let its name end in .svg"):
                picture.save(tmp_path / name)


SLOWER = cm.TimingDiagram([MILL, DIE], rate_per_hour=1800)
REFUSED: list[tuple[Any, dict[str, Any], str]] = [
    (None, {}, r"is given designs=None: give a timing diagram, .* or a dictionary"),
    ({}, {}, r"The designs to animate are \{\}: give"),
    ([BEFORE], {}, r"is given designs=\[TimingDiagram.*: give"),
    ("before", {}, "is given designs='before': give"),
    ({"a": BEFORE, "b": DIE}, {}, r"is given designs\['b'\]=Motion.*: give a timing diagram"),
    ({1: BEFORE}, {}, "The title of a design is 1: give one like"),
    ({" \n": BEFORE}, {}, "The title of a design is .*: give one like"),
    ({"a": BEFORE, "b": SLOWER}, {}, "machine rates .* 2000 and 1800 pieces/h; .*the same rate"),
    (
        BEFORE,
        {"turn_s": 0},
        r"The time of a turn in the animation is 0 s; .*: give .*9 s\.",
    ),
    (BEFORE, {"turn_s": np.nan}, r"The time of a turn in the animation is nan s"),
    (BEFORE, {"turn_s": "9"}, "The time of a turn in the animation .* not '9'"),
    (BEFORE, {"turn_s": [9, 9]}, r"The time of a turn .* single number here, not \[9, 9\]"),
    (BEFORE, {"rules": None}, r"is given rules=None: give a ClearanceRule or .* or a list"),
    (BEFORE, {"rules": "die"}, r"is given rules='die': give a ClearanceRule or .* or a list"),
    (BEFORE, {"rules": [RULE, 3]}, r"is given rules\[1\]=3: give a ClearanceRule"),
    (DRUM, {"rules": RULE}, "There is no motion '(die|mill)': use one of 'drum', 'needle'"),
]


@pytest.mark.parametrize(("designs", "options", "said"), REFUSED)
def test_nonsense_is_refused_in_words(designs: Any, options: dict[str, Any], said: str) -> None:
    with pytest.raises(cm.InputError, match=said):
        animate(designs, **options)


def test_rules_may_come_one_by_one() -> None:
    for rules in (RULE, [RULE], iter([RULE])):
        assert isinstance(animate({"a": BEFORE, "b": AFTER}, rules=rules), Animation)


def test_labels_keep_apart() -> None:
    for places in itertools.permutations([0.0, 1.0, 99.0, 100.0]):
        moved_places = sorted(apart(places, 14, 0, 100))
        assert min(np.diff(moved_places)) >= 14
        assert moved_places[0] >= 0
        assert moved_places[-1] <= 100


def test_lines_are_broken_between_words() -> None:
    text = "the die is 5.97 mm too deep at 134.96 deg"
    lines = wrap(text, 100, 12, most=9)
    assert " ".join(lines) == text
    assert len(lines) > 1
    assert all(text_px(line, 12) <= 100 for line in lines)


def test_a_rule_that_is_broken_up_to_the_end_of_the_turn_says_so_and_is_drawn_so() -> None:
    mill = cm.indexing_motion(
        "mill", cm.rise(100, over_deg=60), cm.dwell(300), stops=24, start_deg=300
    )
    rule = cm.ClearanceRule(cm.beyond("die", -5), only_while=cm.standing("mill"))
    late = animate(cm.TimingDiagram([mill, make_die()], 2000), rules=rule)
    assert late.designs[0].verdict == "RULE BROKEN from 300 to 360°"
    early = animate(cm.TimingDiagram([mill.shifted(60), make_die()], 2000), rules=rule)
    assert [alarms(early, angle) for angle in (0, 30, 100, 360)] == [1, 1, 0, 1]


def test_arcs_of_several_rules_are_merged_the_longest_first_and_none_is_cut() -> None:
    """An arc within another one is no news; where not all have room, it says how much they are."""
    deep = [cm.ClearanceRule(cm.beyond("die", n), only_while=cm.beyond("mill", 3)) for n in (30, 9)]
    still = cm.ClearanceRule(cm.moving("mill"), only_while=cm.beyond("die", 0.0))
    one = Design("today", BEFORE, (deep[0], still, deep[1]))
    said = "RULE BROKEN from 167.8 to 342.2° and from 0 to 150°"
    assert one.verdict == one.short_verdict(500) == said
    assert one.short_verdict(344) == "RULE BROKEN over 324.5° of the turn"


def alarms(animation: Animation, angle_deg: float) -> int:
    return animation.still(angle_deg).svg.count('visibility="visible"')


@pytest.mark.parametrize(
    "name", ["sealing jaw, left side {}", "WERKZEUGSCHLITTEN LINKS {}", "Schweissbacke an Welle {}"]
)
@pytest.mark.parametrize("has_turret", [False, True])
def test_mechanisms_with_long_names_are_called_apart_wherever_they_are_named(
    name: str, has_turret: bool
) -> None:
    names = [name.format(letter) for letter in "xy"]
    moves = cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=55), cm.dwell(150)
    dies = [cm.motion(name, *moves, start_deg=150 + 9 * n) for n, name in enumerate(names)]
    turret = cm.indexing_motion("mill", cm.rise(60, over_deg=150), cm.dwell(210), stops=12)
    rules = [cm.ClearanceRule(cm.beyond(name, 5), cm.within("mill", 1)) for name in names]
    motions = [turret, *dies] if has_turret else dies
    svg = animate(cm.TimingDiagram(motions, 2000), rules=rules if has_turret else ()).svg
    for number, motion in enumerate(motions):
        if motion.name != "mill":
            own = re.findall(rf'<text[^>]*fill="{dark(number)}"[^>]*>([^<]*)', svg)
            ends = [text for text in own if text.endswith(motion.name[-1])]
            assert len(ends) == 3, own  # at the machine, and at its curve in both charts


def test_a_slide_moves_between_the_ends_of_its_scale_wherever_these_are() -> None:
    """Its body does the same from 0 to 50 mm and from 30 to 80: only the numbers are others."""
    drawn = []
    for low in (0, 30):
        parts = cm.rise(50, over_deg=55), cm.return_(50, over_deg=305)
        page = draw.Drawing(200, 200)
        page.append(Slide(0, cm.motion("die", *parts, start_mm=low), 120, "die").draw(2, {}))
        drawn.append(re.sub(r">[0-9]+</text>", "", str(page.as_svg())))
    assert drawn[0] == drawn[1]
