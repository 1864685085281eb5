"""The live figure of notebook 08 says what its folded answers and the teacher's page say."""

import math
import re

import pytest
import sympy as sp
from explored import table_figure

import cammotion as cm
from cammotion.views.live.figure import LiveFigure

LAWS = ("modified sine", "cycloidal", "modified trapezoid", "3-4-5 polynomial")
n, t_m, r_s = sp.symbols("n t_m r_s", positive=True)


@pytest.fixture(scope="module")
def figure() -> LiveFigure:
    return table_figure()


def said(figure: LiveFigure) -> tuple[float, float, float]:
    """Return inertia, torque and power of the sentences."""
    i, torque, power = (float(number) for number in re.findall(r"[\d.]+", figure.text)[:3])
    return i, torque, power


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize(
    ("stops", "time", "radius"), [(8, 0.75, 450), (24, 0.3, 50), (4, 1.5, 300)]
)
def test_the_sentences_are_those_of_an_indexer(
    figure: LiveFigure, law: str, stops: int, time: float, radius: float
) -> None:
    (choice,) = {*figure.values} - {n, t_m, r_s}
    figure.values = {n: stops, t_m: time, r_s: radius, choice: LAWS.index(law)}
    inertia = 5.38 + 160 * (radius / 1000) ** 2 + 0.72
    known = cm.Indexer(inertia, stops, time, law, friction_N_m=10)
    assert said(figure) == pytest.approx(
        (inertia, known.peak_torque_N_m, known.peak_power_W), rel=1e-4, abs=0.51
    )


def test_the_key_of_the_teachers_page() -> None:
    whole = cm.Indexer(38.5, 8, 0.75, friction_N_m=10).peak_torque_N_m
    half = cm.Indexer(6.1 + 160 * 0.280**2, 8, 0.75, friction_N_m=10).peak_torque_N_m
    assert half == pytest.approx(whole / 2, rel=5e-3)
    short = 0.75 * math.sqrt(8 / 12)
    assert round(short, 2) == 0.61
    assert cm.Indexer(38.5, 12, short, friction_N_m=10).peak_torque_N_m == pytest.approx(whole)
    tables = {law: cm.Indexer(38.5, 8, 0.75, law, friction_N_m=10) for law in LAWS}
    assert [round(table.peak_torque_N_m) for table in tables.values()] == [307, 348, 273, 320]
    assert [round(table.peak_power_W) for table in tables.values()] == [321, 475, 473, 391]
