"""Pictures of an indexer's torque and power are its own, and begin and end at rest."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot as plt

import cammotion as cm

mpl.use("agg")

TABLES = {
    "sine": cm.Indexer(38.5, stops=8, time_s=0.75, friction_N_m=10),
    "wheel": cm.Indexer(38.5, stops=8, time_s=0.75, law=cm.Geneva(8).law),
}


@pytest.fixture(autouse=True)
def _close_figures() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.mark.parametrize("quantity", ["torque", "power"])
def test_each_curve_is_that_of_its_table(quantity: str) -> None:
    ax = cm.plot_torque(TABLES, quantity=quantity)
    for (name, table), line in zip(TABLES.items(), ax.lines, strict=False):
        x, values = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        moving = (x > 0) & (x < 1)
        known = table.torque_N_m if quantity == "torque" else table.power_W
        assert values[moving] == pytest.approx(known(x[moving]))
        assert not values[(x < 0) | (x > 1)].any()
        assert line.get_label() == name


@pytest.mark.parametrize("quantity", ["torque", "power"])
def test_a_ramp_shorter_than_a_thousandth_of_the_time_has_its_peak(quantity: str) -> None:
    law = cm.LAWS["cycloidal"].with_constant_velocity(0.999)
    table = replace(TABLES["sine"], law=law)
    values = np.asarray(cm.plot_torque({"table": table}, quantity=quantity).lines[0].get_ydata())
    peak = table.peak_torque_N_m if quantity == "torque" else table.peak_power_W
    assert np.abs(values).max() == pytest.approx(peak, rel=2e-3)


def test_a_torque_that_is_there_at_once_is_a_jump() -> None:
    line = cm.plot_torque(TABLES).lines[1]
    at_start = np.asarray(line.get_ydata())[np.asarray(line.get_xdata()) == 0]
    assert sorted(at_start) == pytest.approx([0, float(TABLES["wheel"].torque_N_m(0))])


def test_nothing_and_another_quantity_are_refused() -> None:
    plot: Any = cm.plot_torque
    with pytest.raises(cm.InputError, match="no indexer to draw: give each by its name"):
        plot({})
    with pytest.raises(
        cm.InputError, match=r"indexers=.*: give a dictionary, for each name an Ind"
    ):
        plot(TABLES["sine"])
    with pytest.raises(cm.InputError, match="no quantity 'energy': use one of 'torque', 'power'"):
        plot(TABLES, quantity="energy")


def test_the_legend_has_two_columns() -> None:
    legend: Any = cm.plot_torque(TABLES).get_legend()
    assert legend._ncols == 2
