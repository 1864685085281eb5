"""The magnifier shows the truth ten times as large, and a still is a moment of the picture."""

import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import motion_picture
import numpy as np
import pytest
from machines import RULE, make_diagram
from notebook_lint import _svg_faults
from test_animation import (
    AFTER,
    ANGLES,
    BEFORE,
    COLLIDING,
    DRUM,
    DRUM_RULE,
    MACHINES,
    TWELVE,
    column_of,
    moved,
    parse,
)

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.views.animation.magnifier import LENS_PX
from cammotion.views.animation.picture import animate

SECOND = cm.motion(
    "second die",
    cm.dwell(160),
    cm.rise(50, over_deg=50),
    cm.dwell(100),
    cm.return_(50, over_deg=50),
)
TWO = make_diagram(*make_diagram().motions, SECOND)
TWO_RULES = [
    RULE,
    cm.ClearanceRule(cm.beyond("second die", 19), only_while=cm.within("mill", 0.65)),
]
SIDES = {"left": -1, "right": 1}
SHOWN_MM = 0.02


def lens(root: ElementTree.Element, side: str, row: int = 0) -> ElementTree.Element:
    return root.findall(f".//*[@data-lens='{side}']")[row]


def turned(group: ElementTree.Element) -> Floats:
    """Return the angle of the wheel in a lens, at ANGLES, from all that turns it."""
    wheel = group.find(".//*[@data-part='turret']")
    assert wheel is not None
    upright, stand = group.findall(".//{*}g[@transform]")[1:3]
    fixed = sum(float(part.attrib["transform"][7:-1]) for part in (upright, stand))
    return fixed + moved(wheel)


def corners(group: ElementTree.Element) -> Floats:
    """Return the corners of the rim in a lens, in px about the turret's centre."""
    rim = group.find(".//*[@data-part='turret']/{*}path")
    assert rim is not None
    ends = re.findall(r"[MLA]([^MLAZ]+)", rim.attrib["d"])
    return np.array([complex(*map(float, end.split(",")[-2:])) for end in ends])


def play(group: ElementTree.Element, side: str) -> Floats:
    """Return how far the pocket's wall is outside of the die's edge, in mm at ANGLES."""
    body = group.find(".//*[@data-part='edge']")
    assert body is not None
    die = body.find("{*}rect")
    assert die is not None
    scale, edge = float(body.attrib["data-px-per-mm"]), float(die.attrib["width"]) / 2
    radius = np.abs(corners(group)).max()
    on_rim = corners(group)[np.abs(np.abs(corners(group)) - radius) < 0.5]
    places = on_rim[:, None] * np.exp(1j * np.radians(turned(group)))
    outside = SIDES[side] * places.real - edge
    near = np.where(places.imag < 0, np.abs(outside), np.inf)
    nearest = np.take_along_axis(outside, near.argmin(axis=0)[None], axis=0)[0]
    return np.asarray(nearest / scale)


@pytest.mark.parametrize("diagram", [BEFORE, AFTER, COLLIDING], ids=["before", "after", "early"])
@pytest.mark.parametrize("side", SIDES)
def test_a_lens_shows_by_how_much_the_pocket_is_off(diagram: cm.TimingDiagram, side: str) -> None:
    shown = play(lens(parse(animate(diagram, rules=RULE, magnify=10).svg), side), side)
    off = np.asarray(diagram.position_mm("mill", ANGLES))
    for near, distance in ((off < 8, off), (off > 92, off - 100)):
        wanted = 0.65 + SIDES[side] * distance[near]
        assert np.abs(shown[near] - wanted).max() < SHOWN_MM


def tips(group: ElementTree.Element) -> Floats:
    """Return how high the die's tip is over the rim in a lens, in mm at ANGLES."""
    body = group.find(".//*[@data-part='edge']")
    assert body is not None
    die = body.find("{*}rect")
    assert die is not None
    tip = -float(die.attrib["y"]) - float(die.attrib["height"]) - moved(body)
    return np.asarray(tip - np.abs(corners(group)).max()) / float(body.attrib["data-px-per-mm"])


def test_a_lens_shows_how_high_the_die_is() -> None:
    """The die starts from its place at 0 deg, in AFTER on its way up."""
    for diagram in (BEFORE, AFTER):
        group = lens(parse(animate(diagram, rules=RULE, magnify=10).svg), "left")
        depth = np.asarray(diagram.position_mm("die", ANGLES))
        wanted = 20 - (depth - diagram.position_mm("die", 0))
        assert np.abs(tips(group) - wanted).max() < SHOWN_MM


@pytest.mark.parametrize(
    ("diagram", "rules"), [(BEFORE, [RULE]), (AFTER, [RULE]), (DRUM, [DRUM_RULE])]
)
def test_a_lens_is_covered_while_the_die_is_far_away(diagram: Any, rules: Any) -> None:
    group = lens(parse(animate(diagram, rules=rules, magnify=10).svg), "right")
    (cover,) = [
        part
        for part in group.findall("{*}g[@visibility]")
        if "near the rim" in "".join(part.itertext())
    ]
    animation = cover.find("{*}animate")
    assert animation is not None
    times = 360 * np.array([float(time) for time in animation.attrib["keyTimes"].split(";")])
    values = np.array(animation.attrib["values"].split(";"))
    covered = values[np.searchsorted(times, ANGLES, side="right") - 1] == "visible"
    name = diagram.names[1]
    low, high = diagram[name].range_mm
    position = np.asarray(diagram.position_mm(name, ANGLES))
    away = position if name == "needle" else high - position - 30  # over the rim, from its bottom
    limit = away[covered].min()
    assert (away[~covered] <= limit + 0.1).all()
    assert covered.any()
    assert not covered.all()
    assert low < high


def test_every_die_has_its_lenses() -> None:
    root = parse(animate(TWO, rules=TWO_RULES, magnify=10).svg)
    assert len(root.findall(".//*[@data-lens]")) == 4
    for row in range(2):
        for side in SIDES:
            group = lens(root, side, row)
            assert play(group, side)[ANGLES == 200][0] == pytest.approx(0.65, abs=SHOWN_MM)
        (said,) = {motion.name for motion in TWO.motions[1:]} & set(
            lens(root, "left", row).itertext()
        )
        assert said == TWO.names[row + 1]
    held = [each for each in root.iter() if each.find("./*[@data-lens]") is not None]
    places = {tuple(map(float, re.findall(r"[\d.]+", each.attrib["transform"]))) for each in held}
    wide, high = (max(ends) for ends in zip(*places, strict=True))
    assert places == {(0, 0), (wide, 0), (0, high), (wide, high)}
    assert high > LENS_PX


def test_a_magnifier_is_only_where_it_is_wanted() -> None:
    plain, magnified = (animate(AFTER, rules=RULE, magnify=each) for each in (None, 25))
    assert "data-lens" not in plain.svg
    assert "25 times as large" not in plain.description
    assert "25 times as large" in magnified.description
    scales = [
        float(
            parse(magnified.svg).findall(f".//*[@data-part='{part}']")[0].attrib["data-px-per-mm"]
        )
        for part in ("body", "edge")
    ]
    assert scales[1] / scales[0] == pytest.approx(25, rel=1e-4)


def test_the_lenses_turn_red_while_the_die_collides() -> None:
    root = parse(animate({"good": AFTER, "bad": COLLIDING}, rules=RULE, magnify=10).svg)
    (violation,) = cm.find_violations(COLLIDING, RULE)
    for number, is_red in ((0, False), (1, True)):
        body = column_of(ElementTree.tostring(root, "unicode"), number).find(
            ".//*[@data-part='edge']"
        )
        assert body is not None
        flags = body.findall("{*}g/{*}animate")
        assert len(flags) == is_red
        for flag in flags:
            start = 360 * float(flag.attrib["keyTimes"].split(";")[1])
            assert start == pytest.approx(violation.start_deg, abs=1e-3)


def test_magnified_designs_are_complete_and_not_large() -> None:
    seen: dict[str, bytes] = {}
    for diagram, rules in ((AFTER, RULE), (COLLIDING, RULE), (DRUM, DRUM_RULE), (TWO, TWO_RULES)):
        svg = animate({"one": diagram, "two": diagram}, rules=rules, magnify=10).svg
        assert list(_svg_faults(svg)) == []
        assert len(svg.encode()) < 125_000  # of two designs with two dies each
        for element in parse(svg).iter():
            if name := element.get("id"):
                content = ElementTree.tostring(element)
                assert seen.setdefault(name, content) == content
    assert any(name.startswith("cm-lens") for name in seen)


REFUSED: list[tuple[Any, dict[str, Any], str]] = [
    (BEFORE, {"magnify": 0}, r"^The magnification is 0; .*above 1 and at most 50: give .*10\.$"),
    (BEFORE, {"magnify": 1}, "^The magnification is 1; "),
    (BEFORE, {"magnify": 51}, "^The magnification is 51; "),
    (BEFORE, {"magnify": np.nan}, "^The magnification is nan; "),
    (BEFORE, {"magnify": "10"}, "^The magnification has to be a number, not '10': give"),
    (BEFORE, {"magnify": [10, 10]}, "^The magnification has to be a single number"),
    (TWELVE, {"magnify": 10}, "^The design 'One turn.*' has no die to magnify: give the clearance"),
]


@pytest.mark.parametrize(("diagram", "options", "said"), REFUSED)
def test_nonsense_is_refused_in_words(diagram: Any, options: Any, said: str) -> None:
    rules = () if diagram is TWELVE else RULE
    with pytest.raises(cm.InputError, match=said):
        animate(diagram, rules=rules, **options)


@pytest.mark.parametrize("angle", [0, 100.7, 129, 135, 205, 360])
@pytest.mark.parametrize(("diagram", "rules"), MACHINES)
def test_a_still_is_the_machine_at_that_moment(
    diagram: cm.TimingDiagram, rules: Any, angle: float
) -> None:
    animation = animate({"it": diagram}, rules=rules)
    still = animation.still(angle)
    assert list(_svg_faults(still.svg)) == []
    root, moving = parse(still.svg), column_of(animation.svg)
    assert not [tag for tag in root.iter() if "animate" in str(tag.tag)]
    assert not [tag for tag in root.iter() if tag.get("class") in {"cm-moves", "cm-on", "cm-off"}]
    assert not root.findall(".//*[@data-part='dot']")
    for part in ("body", "turret"):
        for there in moving.findall(f".//*[@data-part='{part}']"):
            number = there.attrib["data-motion"]
            here = root.find(f".//*[@data-part='{part}'][@data-motion='{number}']")
            assert here is not None
            shown = float(re.split(r"[ (]", here.get("transform", "translate(0 0)"))[-1][:-1])
            assert shown == pytest.approx(np.interp(angle, ANGLES, moved(there)), abs=0.02)
    for name in diagram.names:
        assert name in still.description


def test_a_still_shows_a_collision_only_while_there_is_one() -> None:
    animation = animate(COLLIDING, rules=RULE, magnify=10)
    for angle, is_seen in ((120, "hidden"), (130, "visible"), (140, "hidden")):
        body = parse(animation.still(angle).svg).find(".//*[@data-part='edge']")
        assert body is not None
        red = body.find("{*}g")
        assert red is not None
        assert red.attrib["visibility"] == is_seen


def test_a_still_says_where_everything_is(tmp_path: Path) -> None:
    still = animate({"good": AFTER, "<bad>": COLLIDING}, rules=RULE).still(135)
    assert still.description == (
        "At a cam angle of 135°: good: mill 0.645 mm from a stop, die at 19.03 mm; "
        "<bad>: mill 0.645 mm from a stop, die at 25 mm"
    )
    bundle = still._repr_mimebundle_()
    assert bundle["text/plain"] == still.description
    assert "&lt;bad&gt;" in bundle["text/html"]
    assert still.save(tmp_path / "still.svg").read_text("utf-8") == still.svg
    with pytest.raises(cm.InputError, match=r"^The file still\.svg is there already"):
        still.save(tmp_path / "still.svg")


@pytest.mark.parametrize("angle", [-1, 361, np.nan, None, "noon", [1, 2]])
def test_a_still_of_no_angle_is_refused_in_words(angle: Any) -> None:
    with pytest.raises(cm.InputError, match=r"^The cam angle .*: give .*180 deg"):
        animate(BEFORE, rules=RULE).still(angle)


def test_the_still_of_notebook_03_is_the_moment_of_its_rule() -> None:
    """If not, tests/motion_picture.py draws it anew."""
    kept = motion_picture.STILL.read_text("utf-8")
    assert kept == motion_picture.still()
    assert "mill 0.645 mm from a stop, die at 19 mm" in kept


MACHINE = (motion_picture.IMAGES / "machine.svg").read_text("utf-8")


def measures(part: str) -> list[float]:
    found = parse(MACHINE).find(f".//*[@id='{part}']")
    assert found is not None
    return [float(number) for number in re.findall(r"-?\d+\.?\d*", found.attrib["d"])]


def test_the_machine_of_notebook_00_is_drawn_to_its_measures() -> None:
    """2.3 px are a mm: pockets 100 mm apart, and play of 0.65 mm; in the detail ten times that."""
    left, tip = measures("die")[:2]
    half = 360 - left
    places = np.array(
        re.findall(r"([\d.]+) ([\d.]+)(?= [ALZ])", MACHINE.split('id="mill" d="')[1].split('"')[0])
    ).astype(float)
    inner = places[np.abs(places[:, 0] - 360) < 40]
    wall = np.unique(np.abs(inner[:, 0] - 360).round(1))
    assert (wall.min() - half) / 2.3 == pytest.approx(0.65, abs=0.03)
    assert wall.max() == pytest.approx(wall.min(), abs=0.11)
    down = measures("down")
    assert (down[2] - tip) / 2.3 == pytest.approx(50, abs=0.05)
    assert (inner[:, 1].max() - down[2]) / 2.3 == pytest.approx(1, abs=0.05)
    assert (190 - tip) / 2.3 == pytest.approx(20, abs=0.05)
    assert (measures("wall")[0] - measures("edge")[2]) / 23 == pytest.approx(0.65, abs=0.01)


def test_the_machine_of_notebook_00_answers_nothing_that_notebook_01_asks() -> None:
    said = " ".join(parse(MACHINE).itertext())
    assert "°" not in said
    assert not re.search(r"\b(55|100 deg|150|110|210)\b", said)
    for length in (
        "20 mm",
        "31 mm",
        "stroke 50 mm",
        "1 mm above the bottom",
        "100 mm along the rim",
    ):
        assert length in said
    assert "0.65 mm" in said
    assert list(_svg_faults(MACHINE)) == []
