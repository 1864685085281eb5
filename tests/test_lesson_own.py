"""What notebook 12 says of its numbers, by hand and by NumPy, without the package's solvers."""

import csv
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq
from test_claims import says

import cammotion as cm

DATA = Path(__file__).parent.parent / "notebooks" / "data" / "pad_press.csv"
TURN_S, CYCLOID, SINE = 1.8, 2 * math.pi, 5.5280  # s, and Ca of the cycloid and modified sine
ROWS = [row for row in csv.DictReader(DATA.open(encoding="utf-8")) if row["law"] != "dwell"]


def time(angle: float) -> float:
    return angle / 360 * TURN_S


def peak(way_mm: float, angle: float, factor: float = CYCLOID) -> float:
    return factor * way_mm / 1000 / time(angle) ** 2


def law(x: float) -> float:
    return x - math.sin(2 * math.pi * x) / (2 * math.pi)


def place(share: float) -> float:
    return float(brentq(lambda x: law(x) - share, 0, 1))


def die_deg(mill: float) -> float:
    """Return the angle of the die that has to wait for a mill of so many degrees."""
    return (205 - 75 - (0.5 - place(0.65 / 100)) * mill) / (1 - place(19 / 50))


def largest(mill: float) -> float:
    return max(peak(100, mill), peak(50, die_deg(mill)))


def test_the_rates_of_mill_and_die() -> None:
    before, wide = peak(50, 55), peak(50, die_deg(150))
    assert (before, wide) == pytest.approx((4.154, 0.805), abs=1e-3)
    assert 2000 * math.sqrt(before / peak(100, 150)) == pytest.approx(3857, abs=0.5)
    alike = float(brentq(lambda mill: peak(100, mill) - peak(50, die_deg(mill)), 150, 180))
    assert (alike, largest(alike)) == pytest.approx((163.267, 0.94285), abs=1e-3)
    assert 2000 * math.sqrt(before / largest(alike)) == pytest.approx(4198, abs=0.5)
    assert says("12", "Today the die is pushed with 4.15 m/s²")
    assert says("12", "the die needs only 0.81, a fifth")
    assert says("12", "2000 pieces an hour today, 3857 with the overlap, 4198 balanced")
    assert before / peak(100, 150) == pytest.approx(3.7, abs=0.05)
    assert says("12", "the mill 3.7 times as hard")
    for off in (-1, 1):
        assert largest(alike + off) / largest(alike) - 1 == pytest.approx(0.012, abs=1e-3)
    assert says("12", "each degree off costs about 1.2 percent, to either side")
    wider = 1.05 * largest(alike)
    ends = [brentq(lambda mill: largest(mill) - wider, *span) for span in ((150, 163), (164, 180))]
    assert ends == pytest.approx([159.3, 167.2], abs=0.05)
    assert die_deg(200) == pytest.approx(89, abs=0.5)
    assert peak(50, die_deg(200)) == pytest.approx(1.58, abs=5e-3)
    assert says("12", "At 163.3 degrees, with 0.943 m/s². From 159.3 to 167.2 degrees")
    assert says("12", "At 200 degrees the die has 89 left and pays 1.58 m/s²")


def test_the_press_of_eight() -> None:
    found: dict[str, float] = {}
    name = ""
    for row in ROWS:
        name = row["motion"] or name
        angle = float(row["to in deg"]) - float(row["from in deg"])
        way = abs(float(row["to in mm"]) - float(row["from in mm"]))
        factor = CYCLOID if row["law"] == "cycloidal" else SINE
        found[name] = max(found.get(name, 0), peak(way, angle, factor))
    ranked = sorted(found, key=lambda name: -found[name])
    assert len(found) == 8
    assert ranked[:2] == ["sucker", "gripper"]
    assert ranked.index("die") == 4
    assert says("12", "The die, our old friend, is only the fifth.")
    assert says("12", "90 mm in 40 degrees")
    assert found["sucker"] == pytest.approx(14.14, abs=5e-3)
    assert found["gripper"] == pytest.approx(13.10, abs=5e-3)
    assert peak(90, 60) == pytest.approx(6.28, abs=5e-3)
    assert says("12", "Its peak falls from 14.14 to 6.28 m/s².")
    assert 2000 * math.sqrt(peak(90, 40) / peak(90, 60)) == pytest.approx(3000)
    assert says("12", "From 14.14 to 6.28 m/s², and 3000 pieces an hour")
    assert says("12", "6.28 m/s² looked like the end")
    rules = [row["rule"] for row in csv.DictReader(DATA.open(encoding="utf-8")) if row["rule"]]
    assert len(rules) == 7
    assert says("12", "All seven rules are kept.")


def test_the_bound_of_eight_is_that_of_one() -> None:
    """The sucker stands until 175 deg and from 235 deg on: 90 mm in 60 degrees."""
    rows = [*csv.DictReader(DATA.open(encoding="utf-8"))]
    arcs = [row for row in rows if row["motion"] == "sucker" and row["still"]]
    assert [row["still"] for row in arcs] == ["yes", "165 to 175"]
    assert arcs[0]["from in deg"] == "235"
    push, half = 4.0, time(60) / 2
    times = np.linspace(0, 2 * half, 100_001)
    speed = np.where(times < half, push * times, push * (2 * half - times))
    way = np.trapezoid(speed, times)
    assert 1000 * way == pytest.approx(90, abs=1e-3)
    assert says("12", "*No motions of these parts are below 4.00 m/s²*")
    assert says("12", "the 60 degrees between the sucker's still arcs")
    assert pytest.approx(57, abs=0.5) == 100 * (CYCLOID / 4 - 1)
    assert says("12", "So 6.28 is 57 percent above the least there could be")
    assert pytest.approx(22, abs=0.5) == 100 * (4.8881 / 4 - 1)


HEAD = "motion;from in deg;to in deg;from in mm;to in mm;law;machine rate in pieces/h;still"
UP, DOWN = "lift;20;100;0;120;cycloidal;3000;{}", ";110;180;120;0;cycloidal;;"


@pytest.mark.parametrize(
    ("still", "travel", "has_to_go"),
    [
        ("100 to 110", None, False),
        ("100 to 110", {"lift": (0, 120)}, False),
        ("100 to 110 and 200 to 350", None, True),
    ],
)
def test_a_stroke_is_asked_for_by_two_still_arcs_alone(
    still: str, travel: dict[str, tuple[float, float]] | None, has_to_go: bool
) -> None:
    lift = cm.machine_from_text("\n".join([HEAD, UP.format(still), DOWN]))
    best = cm.least_peak(lift.diagram, lift.rules, still=lift.still, travel_mm=travel, gap=0.05)
    time_s = (200 - 110) / 360 * 3600 / 3000
    expected = 4 * 0.12 / time_s**2 if has_to_go else 0  # up it has longer
    assert best.reached == pytest.approx(expected, rel=0.05, abs=1e-12)
    assert says("12", "asks for a stroke only where a part has two still arcs")
    assert says("12", "limits to its travel do not change that")


def test_once_a_dwell_is_written_the_others_have_to_be() -> None:
    rest = ";100;110;120;120;;;"
    with pytest.raises(cm.InputError, match="add a dwell"):
        cm.machine_from_text("\n".join([HEAD, UP.format(""), rest, DOWN]))
    every = [HEAD, UP.format(""), rest, DOWN, ";180;380;0;0;;;"]
    assert cm.machine_from_text("\n".join(every)).diagram["lift"].stops is None
    assert says("12", "once one of them is written, the others must be too")
