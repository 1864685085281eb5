"""The picture of a camshaft shows the forces and the torque that samples of the laws have."""

from collections.abc import Iterator
from itertools import product

import matplotlib as mpl
import numpy as np
import pytest
from cartons import packaging_machine
from machines import Array, make_diagram
from matplotlib import pyplot as plt
from matplotlib.backends.backend_agg import FigureCanvasAgg

import cammotion as cm
from cammotion.views.ends import inches
from cammotion.views.pictures import PictureFigure, describe

mpl.use("agg")

LOADS = {"die": cm.FollowerLoad(mass_kg=12, preload_N=60), "mill": cm.FollowerLoad(mass_kg=40)}
PRESS = cm.ProcessForce(motion="die", from_deg=190, to_deg=205, force_N=0, last_N=600)


@pytest.fixture(autouse=True)
def _no_trace() -> Iterator[None]:
    yield
    plt.close("all")


def curve(line: object) -> tuple[Array, Array]:
    x, y = (np.asarray(values, dtype=float) for values in line.get_data())  # type: ignore[attr-defined]
    return x, y


def test_torque_and_forces_are_those_of_the_laws() -> None:
    machine = make_diagram()
    ax = cm.plot_camshaft(cm.Camshaft(machine, LOADS, process=[PRESS]))
    at, torque = curve(ax.lines[0])
    assert (at[0], at[-1]) == (0, 360)
    omega = 2 * np.pi / 1.8
    pressed = np.where((at >= 190) & (at < 205), (at - 190) / 15 * 600, 0)
    die = 12 * machine.acceleration("die", at) + 60 + pressed
    mill = 40 * machine.acceleration("mill", at)
    expected = die * machine.velocity("die", at) + mill * machine.velocity("mill", at)
    assert torque == pytest.approx(expected / omega, abs=1e-9)
    (forces,) = ax.figure.axes[1:]
    for line, force in zip(forces.lines, (mill, die), strict=False):
        assert curve(line)[1] == pytest.approx(force, abs=1e-9)
    assert curve(forces.lines[1])[1].max() == pytest.approx(660, abs=0.1)
    peak = np.abs(torque).max()
    assert ax.texts[0].get_text().lstrip("−").startswith(f"{peak:.3g} N m at ")


def test_mean_and_rms_are_drawn_and_said() -> None:
    shaft = cm.Camshaft(make_diagram(), LOADS, process=[PRESS], friction_N={"mill": 15})
    ax = cm.plot_camshaft(shaft)
    at, torque = curve(ax.lines[0])
    mean = np.trapezoid(torque, at) / 360
    rms = np.sqrt(np.trapezoid(torque**2, at) / 360)
    levels = [curve(line)[1] for line in ax.lines if "N m" in str(line.get_label())]
    assert [level[0] for level in levels] == pytest.approx([mean, rms], rel=1e-3)
    assert isinstance(ax.figure, PictureFigure)
    words = describe(ax.figure)
    assert f"mean {mean:.3g} N m from" in words
    assert f"rms {rms:.3g} N m from" in words
    assert "; die from 10.1 to 660" in words


@pytest.mark.parametrize("count", [5, 24])
def test_many_have_a_lane_each(count: int) -> None:
    machine = packaging_machine(count)
    loads = {name: cm.FollowerLoad(mass_kg=3) for name in machine.names}
    ax = cm.plot_camshaft(cm.Camshaft(machine, loads))
    forces = ax.figure.axes[1]
    assert [text.get_text() for text in forces.get_yticklabels()] == list(machine.names)


@pytest.mark.parametrize(
    ("count", "angle_deg", "start_deg"),
    [*product([1], [1, 30], [0, 20, 100, 200, 300, 330]), *product([12], [1, 30], [0, 330])],
)
def test_the_peak_is_written_in_the_frame_and_over_no_number(
    count: int, angle_deg: float, start_deg: float
) -> None:
    moves = cm.rise(50, over_deg=angle_deg), cm.dwell(50), cm.return_(50, over_deg=angle_deg)
    parts = [*moves, cm.dwell(360 - 50 - 2 * angle_deg)]
    motions = [cm.motion(f"no. {n}", *parts, start_deg=start_deg) for n in range(count)]
    machine = cm.TimingDiagram(motions, rate_per_hour=9000)
    loads = {name: cm.FollowerLoad(mass_kg=60) for name in machine.names}
    ax = cm.plot_camshaft(cm.Camshaft(machine, loads))
    renderer = FigureCanvasAgg(ax.figure).get_renderer()  # type: ignore[arg-type,no-untyped-call]
    ax.figure.draw(renderer)
    said, frame = ax.texts[0].get_window_extent(renderer), ax.get_window_extent(renderer)
    assert frame.x0 - 1 <= said.x0
    assert said.x1 <= frame.x1 + 1
    for number in [*ax.get_xticklabels(), *ax.get_yticklabels()]:
        assert not said.overlaps(number.get_window_extent(renderer)), number


def test_the_torque_of_many_is_as_high_as_that_of_few() -> None:
    heights = []
    for count in (2, 5, 24):
        machine = packaging_machine(count)
        loads = {name: cm.FollowerLoad(mass_kg=3) for name in machine.names}
        heights.append(inches(cm.plot_camshaft(cm.Camshaft(machine, loads)))[1])
    assert heights == pytest.approx([heights[0]] * 3, rel=1e-6)


def test_what_stands_has_no_torque_and_no_scale_of_rounding() -> None:
    still = cm.TimingDiagram([cm.motion("still", cm.dwell(360))], rate_per_hour=2000)
    ax = cm.plot_camshaft(cm.Camshaft(still, {"still": cm.FollowerLoad(mass_kg=12)}))
    assert ax.get_ylim() == (-1, 1)
    assert ax.texts[0].get_text().startswith("0 N m at ")


def test_what_has_no_load_is_refused() -> None:
    with pytest.raises(cm.InputError, match="no loads, and so no forces and no torque to draw"):
        cm.plot_camshaft(cm.Camshaft(make_diagram(), {}))
    with pytest.raises(cm.InputError, match="plot_camshaft is given shaft="):
        cm.plot_camshaft(make_diagram())  # type: ignore[arg-type]
