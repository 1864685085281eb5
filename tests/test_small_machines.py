"""Machines of the size of a watch: what is small there is not rounding."""

import re
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from bs4 import BeautifulSoup
from matplotlib import pyplot as plt

import cammotion as cm
from cammotion.report.sheets import _cam

mpl.use("agg")

BOTH = [(205, 305)]
STILL = {"mill": BOTH, "die": BOTH}


def machine(length: float, time: float) -> tuple[cm.TimingDiagram, cm.ClearanceRule]:
    """Return the lesson's machine with so many times its lengths and its times."""
    mill = cm.indexing_motion("mill", cm.rise(100 * length, over_deg=150), cm.dwell(210), stops=24)
    up, down = (make(50 * length, over_deg=55) for make in (cm.rise, cm.return_))
    die = cm.motion("die", up, cm.dwell(100), down, cm.dwell(150), start_deg=150)
    rule = cm.ClearanceRule(cm.beyond("die", 19 * length), cm.within("mill", 0.65 * length))
    return cm.TimingDiagram([mill, die], 2000 / time), rule


def shaft(length: float, time: float, mass: float) -> cm.Camshaft:
    """Return its shaft with so many times its masses."""
    loads = {"mill": cm.FollowerLoad(mass_kg=40 * mass), "die": cm.FollowerLoad(mass_kg=12 * mass)}
    return cm.Camshaft(machine(length, time)[0], loads)


SIZES = [(1.0, 1.0, 1.0), (4e-4, 1.0, 1e-4), (4e-4, 60.0, 1e-4), (80.0, 60.0, 1700.0)]


@pytest.mark.parametrize(("length", "time", "mass"), SIZES)
def test_the_torque_of_any_size_is_brought_down_alike(
    length: float, time: float, mass: float
) -> None:
    """A stroke of 0.02 mm and a gram ask for 1e-10 N m, which was taken for none."""
    given = shaft(length, time, mass)
    found = cm.optimise(given, machine(length, time)[1], still=STILL, minimise="torque")
    assert found.reached / abs(given.peak_torque().value) == pytest.approx(0.877 / 3.373, rel=2e-3)


@pytest.mark.parametrize(("length", "time", "mass"), SIZES)
def test_rates_of_any_size_are_alike(length: float, time: float, mass: float) -> None:
    unit = mass * length**2 / time**2
    (limit,) = cm.rate_limits(shaft(length, time, mass), torque_N_m=30 * unit)
    (usual,) = cm.rate_limits(shaft(1, 1, 1), torque_N_m=30)
    assert limit.rate_per_hour * time == pytest.approx(usual.rate_per_hour)


@pytest.mark.parametrize(("length", "time", "mass"), SIZES)
def test_torques_of_any_size_are_drawn_and_compared(
    length: float, time: float, mass: float
) -> None:
    given = shaft(length, time, mass)
    ax = cm.plot_camshaft(given)
    peak, top = given.peak_torque().value, np.abs(ax.get_ylim()).max()
    assert abs(peak) < top < 2 * abs(peak)
    assert not ax.texts[0].get_text().startswith("0 N m")
    plt.close("all")
    effects = cm.compare(given, given.at_rate(4000 / time)).effects
    times = {e.what: e.times for e in effects if e.of == "camshaft"}
    assert times["peak torque"] == pytest.approx(4)
    assert times["rms torque"] == pytest.approx(4)
    assert times["mean power"] is None  # masses give all back: what is left of it is rounding
    assert all(effect.said[0] != "0" for effect in effects if effect.what != "mean power")


@pytest.mark.parametrize("length", [1.0, 4e-4])
def test_a_rule_of_any_size_is_used_up_alike(length: float) -> None:
    """The mill's still arc holds it, and with 36 mm three hundredths of the stroke are left."""
    diagram, _ = machine(length, 1)
    still = {"mill": [(165, 305)], "die": BOTH}
    for limit, is_used in ((34, True), (36, False)):
        rule = cm.ClearanceRule(cm.beyond("die", limit * length), cm.within("mill", 0.65 * length))
        found = cm.improvements(cm.Machine("small", diagram, [rule], still), seconds=3)
        (said,) = (one.said for one in found if one.kind == "widen" and one.mechanism == "mill")
        assert (str(rule) in said) == is_used, said


@pytest.mark.parametrize(("length", "time", "_"), SIZES)
def test_a_report_of_any_size_warns_of_a_rule_that_is_used_up(
    length: float, time: float, _: float, tmp_path: Path
) -> None:
    """Of a stroke of 4 m some 0.0003 mm were left in the best design, and so no word of it."""
    diagram, rule = machine(length, time)
    report = cm.write_report(cm.Machine("press", diagram, [rule], STILL), tmp_path, seconds=1)
    soup = BeautifulSoup(report.page.read_text("utf-8"), "html.parser")
    page = " ".join(soup.get_text(" ").split())
    assert "The design uses up 1 of 1 rules" in page
    rate = float(re.findall(r"At the peak of today that is ([\d.e+]+) pieces/h", page)[0])
    assert rate * time == pytest.approx(4198, rel=5e-3)


@pytest.mark.parametrize(("length", "time", "_"), SIZES)
def test_the_cam_tables_of_a_report_of_any_size_have_their_digits(
    length: float, time: float, _: float
) -> None:
    diagram = machine(length, time)[0]
    columns = np.array(_cam("die", diagram, diagram)[1:]).T
    for exact, column in zip((diagram.velocity, diagram.acceleration), columns[2:4], strict=True):
        wanted = exact("die", columns[0])
        assert column == pytest.approx(wanted, abs=1e-5 * np.abs(wanted).max())


@pytest.mark.parametrize("stroke", [0.0123456789, 1.23456789e-5, 6.17283945e-7])
def test_a_small_stroke_keeps_its_digits(stroke: float) -> None:
    """All positions were rounded to 1e-9 mm, which of the last is half a thousandth."""
    thirds = [cm.rise(stroke / 3, over_deg=60)] * 3
    die = cm.motion("die", *thirds, cm.return_(stroke, over_deg=100), cm.dwell(80))
    assert die.range_mm == pytest.approx((0, stroke), rel=1e-8)
    assert die.segments[-1].to_mm == 0
    peak = cm.TimingDiagram([die], 2000).peak_acceleration("die")
    assert peak == pytest.approx(cm.peak_acceleration(stroke, 100, 2000), rel=1e-8)


def test_the_rate_of_a_slow_machine_has_three_digits() -> None:
    """From 3 pieces/h to 6.3, and not to 6."""
    diagram, rule = machine(1, 2000 / 3)
    found = cm.improvements(cm.Machine("slow", diagram, [rule], STILL), seconds=3)
    assert found[0].row[-1] == "6.3"


@pytest.mark.parametrize("length", [1.0, 80.0])
@pytest.mark.parametrize("cells", [90, 360])
def test_the_bound_of_what_can_stand_is_not_below_zero(length: float, cells: int) -> None:
    """It was -2e-19 m/s², and rounded outward -0.0001."""
    up, down = (make(50 * length, over_deg=110) for make in (cm.rise, cm.return_))
    slide = cm.motion("slide", up, cm.dwell(70), down, cm.dwell(70))
    pin = cm.motion("pin", cm.rise(20, over_deg=40), cm.dwell(100), cm.return_(20, over_deg=220))
    rule = cm.ClearanceRule(cm.beyond("pin", 5), only_while=cm.beyond("slide", 19 * length))
    found = cm.least_acceleration(
        cm.TimingDiagram([slide, pin], 30),
        *("slide", rule),
        still=[(110, 180)],
        travel_mm=(0, 50 * length),
        cells=cells,
    )
    assert (found.bound, found.reached) == (0, 0)
    assert "-0" not in repr(found)
