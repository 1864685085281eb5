"""What is said and drawn of an answer in a machine is what a machine built on its own does."""

import math
import re
from xml.etree import ElementTree

import numpy as np
import pytest
from known_slips import die, later, law, place, stroke, turn, widest
from known_slips_08 import inertia, push
from known_slips_10 import both
from known_slips_laws import gentle, harsh
from shown import NUMBER, SVG, curve, is_red, numbers, texts, wrong

import cammotion as cm
from cammotion.rules.checks import find_violations
from cammotion.rules.rule import Violation
from cammotion.teaching.example import MillAndDie
from cammotion.teaching.shown import frame
from cammotion.teaching.shown.frame import INK, Shown


def own_rule(machine: MillAndDie, limit_mm: float) -> cm.ClearanceRule:
    near = machine.pitch_mm * law(0.1)
    return cm.ClearanceRule(cm.beyond("die", limit_mm), only_while=cm.within("mill", near))


def own_machine(
    machine: MillAndDie, start: float, way: float, work: float | None = None
) -> cm.TimingDiagram:
    """Build a machine anew, with a die that sets off at an angle."""
    work = machine.work_deg if work is None else work
    rest = 360 - 2 * way - work
    mill = cm.indexing_motion(
        "mill",
        cm.rise(machine.pitch_mm, over_deg=machine.mill_angle_deg),
        cm.dwell(360 - machine.mill_angle_deg),
        stops=machine.stops,
    )
    goes = [cm.rise(stroke(machine), over_deg=way), cm.dwell(work)]
    goes += [cm.return_(stroke(machine), over_deg=way), *([cm.dwell(rest)] if rest > 1e-9 else [])]
    return cm.TimingDiagram([mill, cm.motion("die", *goes, start_deg=start)], machine.rate_per_hour)


def violations(built: cm.TimingDiagram, rule: cm.ClearanceRule) -> list[Violation]:
    return [found for found in find_violations(built, rule) if found.excess_mm > 1e-6]


def assert_strikes(shown: Shown, machine: MillAndDie, built: cm.TimingDiagram) -> None:
    """Compare line and hatch with what a machine does that was built on its own."""
    limit = machine.wait_mm - machine.margin_mm
    broken = violations(built, own_rule(machine, limit))
    touching = violations(built, own_rule(machine, machine.wait_mm))
    assert ("it strikes" in shown.line) == bool(touching), shown.line
    assert ("less than the margin" in shown.line) == (bool(broken) and not touching)
    if max((violation.end_deg - violation.start_deg for violation in broken), default=1) > 0.5:
        assert is_red(shown) == bool(broken)
    if found := re.search(r"At ([\d.]+) deg.* ([\d.]+) mm deep", shown.line):
        angle, depth = map(float, found.groups())
        assert built.position_mm("die", angle) == pytest.approx(depth, abs=0.1)
        assert 0 < built.position_mm("mill", angle) < machine.pitch_mm
        assert ("of the next turn" in shown.line) == (angle < built["die"].moves[0].from_deg)


NO_ROOM = "more than a turn"


@pytest.mark.parametrize("number", ["01.1", "03.2"])
def test_a_way_after_the_mill(number: str) -> None:
    for machine, angle, shown in wrong(number):
        right, quiet = (
            (die(machine), 0) if number == "01.1" else (later(machine), machine.mill_angle_deg / 10)
        )
        assert (NO_ROOM in shown.line) == (2 * angle + machine.work_deg > 360 + 1e-6)
        if NO_ROOM not in shown.line:
            assert ("is not up yet" in shown.line) == (angle > right)
            assert ("and waits" in shown.line) == (angle < right)
            built = own_machine(machine, machine.mill_angle_deg - quiet, angle)
            assert_strikes(shown, machine, built)


def test_work_in_a_turn() -> None:
    for machine, time_s, shown in wrong("01.2"):
        work = 360 * time_s / turn(machine)
        assert (NO_ROOM in shown.line) == (work > machine.mill_angle_deg + machine.work_deg + 1e-6)
        if found := re.search(r"about (\d+) of", shown.line):
            assert work == pytest.approx(float(found.group(1)), abs=5.001)
        else:
            assert work < 10
        if NO_ROOM not in shown.line:
            assert ("not up yet" in shown.line) == (work > machine.work_deg)
            assert ("cut short" in shown.line) == (work < machine.work_deg)
            built = own_machine(machine, machine.mill_angle_deg, die(machine), work)
            assert_strikes(shown, machine, built)


def test_a_widened_way() -> None:
    said = set()
    for machine, angle, shown in wrong("03.4"):
        has_room = 2 * angle + machine.work_deg < 360
        assert (NO_ROOM in shown.line) != has_room
        if has_room:
            down = machine.mill_angle_deg + die(machine)
            assert_strikes(shown, machine, own_machine(machine, down - angle, angle))
            assert ("keeps clear" in shown.line) == (angle < widest(machine))
        said.add(re.sub(NUMBER, "", shown.line)[:12])
    assert len(said) >= 3


def test_a_rest_in_a_turn() -> None:
    for machine, time_ms, shown in wrong("04.3"):
        rest = 360 * time_ms / 1000 / turn(machine)
        too_long = rest + 2 * widest(machine) + machine.work_deg > 360
        assert ("too late" in shown.line) == too_long
        assert ("too soon" in shown.line) != too_long


def test_a_place_of_the_die() -> None:
    for machine, x, shown in wrong("03.3"):
        depth = stroke(machine) * law(x)
        room = round(machine.wait_mm - depth, 9)
        assert ("at the rim" in shown.line) == (abs(room) < 0.01)
        assert ("it strikes" in shown.line) == (room <= -0.01)
        assert is_red(shown) == (room < 0)
        assert ("less than the margin" in shown.line) == (0.01 <= room < machine.margin_mm)
        assert ("might be deeper" in shown.line) == (room > machine.margin_mm)
        if "it strikes" in shown.line:
            assert numbers(shown.line)[0] == pytest.approx(-room, rel=0.06)


def test_a_depth_of_the_die() -> None:
    for machine, depth, shown in wrong("04.1"):
        floor, down = machine.wait_mm + machine.pocket_mm, machine.mill_angle_deg + die(machine)
        assert ("through the floor" in shown.line) == (depth > floor) == is_red(shown)
        assert ("never is" in shown.line) == (stroke(machine) <= depth <= floor)
        if depth >= stroke(machine):
            continue
        way = 30 / (1 - place(depth / stroke(machine)))
        assert ("too late" in shown.line) == (way < widest(machine))
        assert ("too early" in shown.line) == (way > widest(machine))
        if "too late" in shown.line:
            assert numbers(shown.line)[0] == pytest.approx(down - way, abs=0.51)
        elif "last turn" in shown.line:
            assert 2 * way + machine.work_deg >= 360
        else:
            built = own_machine(machine, down - way, way)
            limit = machine.wait_mm - machine.margin_mm
            assert violations(built, own_rule(machine, limit))
            touches = bool(violations(built, own_rule(machine, machine.wait_mm)))
            assert touches == ("it strikes" in shown.line)


def test_a_place_of_the_mill() -> None:
    for machine, off, shown in wrong("03.1"):
        still, asked = numbers(shown.line)
        assert asked == pytest.approx(machine.mill_angle_deg / 10)
        share = place(off / machine.pitch_mm)
        assert machine.mill_angle_deg * share == pytest.approx(still, abs=0.051)
        assert ("already" in shown.line) == (off > machine.pitch_mm * law(0.1))


def widths(shown: Shown) -> tuple[float, float]:
    root = ElementTree.fromstring(shown.svg)  # noqa: S314 - our own
    one, other = (float(bar.attrib["width"]) for bar in root.findall(f"{SVG}rect")[1:])
    return one, other


def assert_bars(shown: Shown, ratio: float) -> None:
    """Look whether the bars have a ratio, or the longer one is cut."""
    asked, made = widths(shown)
    if 1 / 12 < ratio < 12:
        assert made / asked == pytest.approx(ratio, rel=0.01)
    else:
        assert 'stroke="#fff"' in shown.svg


def test_bars() -> None:
    for machine, angle, shown in wrong("05.3"):
        ratio = harsh(machine) / gentle(machine) * (die(machine) / angle) ** 2
        assert ("harder" in shown.line) == (ratio > 1)
        assert ("pushed less" in shown.line) == (ratio < 1)
        assert_bars(shown, ratio)
    for machine, factor, shown in wrong("04.2"):
        seconds = math.sqrt(factor) * turn(machine)
        assert ("longer" in shown.line) == (seconds > 9)
        assert ("sooner" in shown.line) == (seconds < 9)
        (about,) = numbers(shown.line)
        assert about == pytest.approx(seconds, rel=0.05)
        assert (about > 9) == (seconds > 9)
        assert_bars(shown, seconds / 9)
    for machine, force, shown in wrong("06.5"):
        made = force / (machine.die_mass_kg + 1e-4 * (2 * math.pi / 0.01) ** 2)
        assert (" harder than" in shown.line) == (made > 0.6)
        assert (" not as hard" in shown.line) == (made < 0.6)
        assert_bars(shown, made / 0.6)
    for machine, torque, shown in wrong("08.2"):
        made = (torque - machine.table.friction_N_m) / (inertia(machine) * push(machine))
        assert ("beyond" in shown.line) == (made > 1)
        assert ("does not get" in shown.line) == (made < 1)
        if not math.isclose(made, 12):  # a whole turn of 12 steps is as long as a bar gets
            assert_bars(shown, made)
    for machine, step, shown in wrong("09.1"):
        between = 60 / machine.measured.per_minute / machine.measured.points
        made = 2 * step / 1e6 / between**2 / machine.measured.limit
        assert ("more than it may" in shown.line) == (made > 1)
        assert (" by less." in shown.line) == (made < 1)
        assert_bars(shown, made)
    for machine, rod, shown in wrong("10.1"):
        give = 1 / machine.follower.rod.lever_N_per_mm + 1 / rod
        made = math.sqrt(1 / give / both(machine))
        assert ("more often" in shown.line) == (made > 1)
        assert ("does not swing often" in shown.line) == (made < 1)
        assert_bars(shown, made)


def label_at(shown: Shown, words: str) -> tuple[float, float]:
    """Return where the middle of a label is, in px."""
    (found,) = [text for text in texts(shown) if str(text.text).startswith(words)]
    return float(found.attrib["x"]), float(found.attrib["y"]) - 4


@pytest.mark.parametrize("number", ["01.1", "03.2", "03.4"])
def test_the_curve_of_a_turn_is_that_of_the_die(number: str) -> None:
    for machine, angle, shown in wrong(number):
        down = machine.mill_angle_deg + die(machine)
        early = machine.mill_angle_deg / 10 if number == "03.2" else 0
        start = down - angle if number == "03.4" else machine.mill_angle_deg - early
        if angle > 20 and 2 * angle + machine.work_deg < 360:  # steeper is no sharper than a px
            (zero, _), (whole, _) = label_at(shown, "0 deg"), label_at(shown, "360 deg")
            (_, top), (_, rim) = label_at(shown, "die"), label_at(shown, "rim")
            angles = (curve(shown)[:, 0] - zero) / (whole - zero) * 360
            in_turn = (angles >= start) & (angles < start + 360)
            depths = (curve(shown)[:, 1] - top) / (rim - top) * machine.wait_mm
            built = own_machine(machine, start, angle).position_mm("die", angles)
            assert depths[in_turn] == pytest.approx(np.asarray(built)[in_turn], abs=0.6)


@pytest.mark.parametrize("number", ["03.3", "04.1"])
def test_the_die_is_drawn_as_deep_as_it_is(number: str) -> None:
    for machine, answer, shown in wrong(number):
        depth = stroke(machine) * law(answer) if number == "03.3" else answer
        (_, top), (_, rim) = label_at(shown, "it waits"), label_at(shown, "rim")
        drawn = (curve(shown)[:, 1].max() - top) / (rim - top) * machine.wait_mm
        floor = machine.wait_mm + machine.pocket_mm
        assert drawn == pytest.approx(min(depth, floor + 8), abs=0.1)
        assert label_at(shown, "die")[1] == pytest.approx(curve(shown)[:, 1].max(), abs=0.1)


def test_the_mill_is_drawn_as_far_off_as_it_is() -> None:
    for machine, off, shown in wrong("03.1"):
        root = ElementTree.fromstring(shown.svg)  # noqa: S314 - our own
        (way,) = [path for path in root.findall(f"{SVG}path") if path.get("stroke") == INK]
        left, right = (float(end.split()[0]) for end in way.attrib["d"][1:].split("L"))
        assert (right - left) / frame.WIDTH * 2.5 * machine.pitch_mm == pytest.approx(off, abs=0.1)
