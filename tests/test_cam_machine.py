"""The cam that drives the die: what is drawn is what rolls, by brute force from the picture."""

import re
from functools import cache
from xml.etree import ElementTree

import motion_picture
import numpy as np
import pytest
from cam_machine import cam_machine
from machines import RULE, make_diagram, make_die, make_mill
from notebook_lint import _svg_faults
from plate_cam import STEEPEST_DEG, Places, PlateCam
from test_animation import parse

import cammotion as cm
from cammotion.quantities import Floats
from cammotion.views.animation.dies import Die, find_dies

DIAGRAM = make_diagram()
ROOT = parse(cam_machine(DIAGRAM, RULE))
PARENTS = {child: parent for parent in ROOT.iter() for child in parent}
ANGLES = np.arange(0, 360, 0.35)  # most lie between the key frames
CONTACT_MM = 0.05


def part(name: str) -> ElementTree.Element:
    (found,) = ROOT.findall(f".//*[@data-part='{name}']")
    return found


SCALE = float(part("body").attrib["data-px-per-mm"])


def numbers(text: str) -> list[float]:
    return [float(number) for number in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", text)]


def place_of(element: ElementTree.Element) -> complex:
    """Return where the nearest translated group round an element is, in px."""
    while "translate" not in element.attrib.get("transform", ""):
        element = PARENTS[element]
    return complex(*numbers(element.attrib["transform"]))


def moved(name: str) -> Floats:
    """Return the last number of what moves a part, at ANGLES."""
    animation = part(name).find("{*}animateTransform")
    assert animation is not None
    times = np.array(numbers(animation.attrib["keyTimes"]))
    values = [numbers(value)[-1] for value in animation.attrib["values"].split(";")]
    return np.asarray(np.interp(ANGLES, 360 * times, values))


@cache
def profile() -> Places:
    """Return points of the drawn profile in px about the shaft, 0.06 px apart at most."""
    points: list[complex] = []
    for command, text in re.findall(r"([MLA])([^MLAZ]+)", part("profile").attrib["d"]):
        values = numbers(text)
        end = complex(*values[-2:])
        if command == "A":
            radius, _, large, sweep = *values[:2], *values[3:5]
            assert sweep == 0
            start = np.angle(points[-1])
            way = -((start - np.angle(end)) % (2 * np.pi))
            assert (-way > np.pi) == bool(large)
            assert abs(points[-1]) == pytest.approx(radius, abs=0.02)
            points += list(radius * np.exp(1j * (start + np.linspace(0, way, 6000))))
        elif command == "L":
            points += list(np.linspace(points[-1], end, 90))
        points.append(end)
    dense = np.array(points)
    assert np.abs(np.diff(np.append(dense, dense[0]))).max() < 0.06
    return dense


@cache
def rolled() -> tuple[Places, Places]:
    """Return the roller's centre and the nearest point of the profile about the shaft, in px."""
    lever, roller = part("lever"), part("roller")
    at_zero = numbers(PARENTS[lever].attrib["transform"])[-1]
    turned = np.exp(1j * np.radians(at_zero + moved("lever")))
    centre = place_of(roller) * turned - place_of(part("cam"))  # both stand in the pivot's group
    nearest = []
    for angle, place in zip(moved("cam"), centre, strict=True):
        turned_profile = profile() * np.exp(1j * np.radians(angle))
        nearest.append(turned_profile[np.argmin(np.abs(turned_profile - place))])
    return centre, np.array(nearest)


def test_the_roller_touches_the_cam_at_every_angle_and_never_enters_it() -> None:
    centre, nearest = rolled()
    distance = np.abs(centre - nearest) / SCALE
    radius = float(part("roller").attrib["r"]) / SCALE
    assert np.abs(distance - radius).max() < CONTACT_MM


def test_the_die_moves_as_the_diagram_says_and_its_pin_stays_in_the_slot() -> None:
    lowered = moved("body") / SCALE
    wanted = np.asarray(DIAGRAM.position_mm("die", ANGLES))
    assert np.abs(lowered - wanted).max() < CONTACT_MM
    assert (moved("pin") == moved("body")).all()
    die = place_of(PARENTS[part("pin")])
    pin = die + 1j * moved("pin")
    at_zero = numbers(PARENTS[part("lever")].attrib["transform"])[-1]
    beside = pin * np.exp(-1j * np.radians(at_zero + moved("lever")))
    assert np.abs(beside.imag / SCALE).max() < CONTACT_MM


def test_the_cam_pushes_the_lever_and_not_its_bearing() -> None:
    """The pressure angle once more, from the places of the roller and of what touches it."""
    centre, nearest = rolled()
    push = centre - nearest
    lever = centre + place_of(part("cam"))
    along = np.abs((push * (1j * lever).conj()).real) / np.abs(push * lever)
    found = np.degrees(np.arccos(along))
    plate = PlateCam.fitting(die_of(DIAGRAM))
    away = np.abs(found - plate.pressure_angle_deg(ANGLES))
    assert away.max() < 1.2  # the drawn profile has a chord for each degree
    assert away.mean() < 0.3
    assert 30 < found.max() < STEEPEST_DEG == 35


def die_of(diagram: cm.TimingDiagram) -> Die:
    return find_dies(diagram, [RULE])["mill"][0]


def test_nothing_is_cut_away_from_the_profile() -> None:
    """The radius of the pitch curve once more, as that of the circle through three places."""
    plate = PlateCam.fitting(die_of(DIAGRAM))
    angles = np.arange(0, 360, 0.05)
    seen = (plate.roller_centre(angles) - plate.axis) * np.exp(1j * np.radians(angles))
    before, after = np.roll(seen, 1), np.roll(seen, -1)
    area = ((seen - before).conj() * (after - seen)).imag / 2
    sides = np.abs(seen - before) * np.abs(after - seen) * np.abs(after - before)
    least = 1 / (4 * area / sides).max()
    assert plate.sharpest_radius(angles) == pytest.approx(least, rel=2e-3)
    assert least > 2 * plate.roller_radius


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("law", ["cycloidal", "modified sine"])
def test_any_die_gets_its_cam(law: str, sign: int) -> None:
    """The profile is never nearer to the roller than its radius, nor further away."""
    up, down = (cm.rise, cm.return_) if sign > 0 else (cm.return_, cm.rise)
    motion = cm.motion(
        "die",
        *(up(20, over_deg=90, law=law), cm.dwell(60), down(20, over_deg=110, law=law)),
        cm.dwell(100),
        start_deg=-50,
        start_mm=0 if sign > 0 else 20,
    )
    plate = PlateCam.fitting(Die(1, motion, sign > 0, 5, 0.5))
    dense = plate.profile(np.arange(0, 360, 0.02))
    for angle in np.arange(0, 360, 3.7):
        place = (plate.roller_centre(angle) - plate.axis) * np.exp(1j * np.radians(angle))
        assert np.abs(dense - place).min() == pytest.approx(plate.roller_radius, abs=1e-4)
    tangent = np.tan(np.radians(plate.lever_deg([40, 110])))
    lifted = plate.die_arm * (tangent[1] - tangent[0])
    deep = np.asarray(motion.position_mm([40, 110]))
    assert lifted == pytest.approx(-sign * (deep[1] - deep[0]))


def test_a_bad_cam_is_refused_in_words() -> None:
    hasty = make_diagram(make_mill(), make_die(40))
    with pytest.raises(cm.InputError, match=r"pressure angle .* 'die' reaches 4\d\.\d deg; .*give"):
        cam_machine(hasty, RULE)
    sizes = PlateCam.fitting(die_of(DIAGRAM))
    fat = PlateCam(sizes.die, sizes.roller_arm, sizes.die_arm, sizes.prime_radius, 40)
    with pytest.raises(cm.InputError, match=r"one of 40 mm, so that the profile is undercut: give"):
        fat.check()


def test_another_machine_is_refused_in_words() -> None:
    lamp = cm.motion("lamp", cm.rise(1, over_deg=180), cm.return_(1, over_deg=180))
    more = make_diagram(*DIAGRAM.motions, lamp)
    with pytest.raises(cm.InputError, match=r"are 'mill', 'die', 'lamp': give one indexing motion"):
        cam_machine(more, RULE)
    with pytest.raises(cm.InputError, match="The time of a turn in the animation is 0 s"):
        cam_machine(DIAGRAM, RULE, turn_s=0)


def test_the_picture_of_notebook_00_is_the_cam_of_the_example() -> None:
    """If not, tests/motion_picture.py draws it anew."""
    kept = motion_picture.CAM.read_text("utf-8")
    assert kept == motion_picture.cam()
    assert len(kept.encode()) < 60_000


def test_the_picture_is_complete_and_can_stand_still() -> None:
    assert list(_svg_faults(cam_machine(DIAGRAM, RULE))) == []
    animated = [PARENTS[animation] for animation in ROOT.iter() if "animate" in animation.tag]
    assert len(animated) == 7  # mill, die, pin, cam, lever, spring, hand
    assert all("cm-moves" in element.attrib["class"] for element in animated)
    assert "cm-still" in ROOT.attrib["class"]
    texts = list(ROOT.iter("{http://www.w3.org/2000/svg}text"))
    assert {"cam", "camshaft", "roller", "lever", "die"} <= {text.text for text in texts}
    assert min(float(text.attrib["font-size"]) for text in texts) >= 11
