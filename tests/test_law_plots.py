"""Pictures of laws show the law itself, from rest to rest, with all its names."""

from collections.abc import Iterator

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib import pyplot as plt

import cammotion as cm
from cammotion.views.law_plots import CURVES, full_name

mpl.use("agg")


@pytest.fixture(autouse=True)
def _close_figures() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.mark.parametrize("curve", CURVES)
def test_each_line_is_its_law_and_rests_before_and_after(curve: str) -> None:
    names = ["constant acceleration", "modified sine"]
    ax = cm.plot_laws(names, curve=curve)
    for name, line in zip(names, ax.lines, strict=False):
        x, values = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
        moving = (x > 0) & (x < 1)
        assert values[moving] == pytest.approx(cm.LAWS[name](x[moving], [*CURVES].index(curve)))
        assert values[x < 0] == pytest.approx(0)
        assert values[x > 1] == pytest.approx(float(curve == "S"))


@pytest.mark.parametrize("curve", ["V", "A", "J"])
def test_a_ramp_shorter_than_a_thousandth_of_the_time_has_its_peak(curve: str) -> None:
    law = cm.LAWS["cycloidal"].with_constant_velocity(0.999)
    values = np.asarray(cm.plot_laws(law, curve=curve).lines[0].get_ydata())
    assert np.abs(values).max() == pytest.approx({"V": law.Cv, "A": law.Ca, "J": law.Cj}[curve])


def test_a_jump_of_the_acceleration_is_drawn() -> None:
    line = cm.plot_laws("constant acceleration").lines[0]
    x, values = np.asarray(line.get_xdata()), np.asarray(line.get_ydata())
    assert {*values[x == 0]} == {0, 4}


def test_the_legend_has_every_name() -> None:
    ax = cm.plot_laws(cm.LAWS)
    legend = ax.get_legend()
    assert legend
    said = [text.get_text() for text in legend.get_texts()]
    assert said == [full_name(law) for law in cm.LAWS.values()]
    assert all(
        other in words
        for law, words in zip(cm.LAWS.values(), said, strict=True)
        for other in law.also_called
    )


@pytest.mark.parametrize(
    ("laws", "curve", "fragment"),
    [([], "A", "nothing to draw"), ("cycloid", "A", "cycloidal"), ("cycloidal", "B", "curve")],
)
def test_what_cannot_be_drawn_is_refused(laws: object, curve: str, fragment: str) -> None:
    with pytest.raises(cm.InputError, match=fragment):
        cm.plot_laws(laws, curve=curve)  # type: ignore[arg-type]


def test_a_ranking_has_the_smallest_on_top_and_hatches_what_jumps() -> None:
    peaks = {name: cm.peak_acceleration(50, 55, 2000, law=name) for name in cm.LAWS}
    ax = cm.plot_ranking(peaks, quantity="peak of the die in m/s²")
    names = [label.get_text() for label in ax.get_yticklabels()][::-1]
    assert names == sorted(peaks, key=lambda name: peaks[name])
    bars = list(ax.patches)[::-1]
    assert [bar.get_width() for bar in bars] == pytest.approx(sorted(peaks.values()))  # type: ignore[attr-defined]
    jumps = [np.isinf(cm.LAWS[name].Cj) for name in names]
    assert [bool(bar.get_hatch()) for bar in bars] == jumps
    assert ax.get_xlabel().startswith("peak of the die in m/s² (hatched")


@pytest.mark.parametrize(
    ("peaks", "fragment"),
    [
        ({}, r'nothing to draw.*Give each by its law, .* \{"cycloidal": 4.154\}\.$'),
        ({"cycloid": 1.0}, "cycloidal"),
        ({"cycloidal": np.inf}, r"is given peaks\['cycloidal'\]=.*inf.*: give a finite number"),
    ],
)
def test_a_ranking_that_cannot_be_drawn_is_refused(peaks: dict[str, float], fragment: str) -> None:
    with pytest.raises(cm.InputError, match=fragment):
        cm.plot_ranking(peaks)
