"""Pictures are the same whatever colours, sizes and layouts are set for Matplotlib."""

from collections.abc import Callable, Iterator
from pathlib import Path

import matplotlib as mpl
import pytest
from machines import RULE, make_diagram, make_die
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from measured_cam import CAM, RATE

import cammotion as cm
from cammotion.views.pictures import PictureFigure, on_paper

mpl.use("agg")

MOVES = [cm.Move(stroke_mm=50, angle_deg=angle, rate_per_hour=2000) for angle in (55, 110)]
LOADS = {"die": cm.FollowerLoad(mass_kg=12)}
FACED = cm.FlatFacedCam(make_die(), base_radius_mm=1500)
PLOTS: dict[str, Callable[..., Axes]] = {
    "timing": lambda: cm.plot_timing(make_diagram(), rules=RULE, rows=["velocity"]),
    "clearance": lambda **ax: cm.plot_clearance({"a": make_diagram()}, RULE, **ax),
    "curves": lambda **ax: cm.plot_curves(MOVES, **ax),
    "peaks": lambda **ax: cm.plot_peaks(MOVES, **ax),
    "inverse square": lambda **ax: cm.plot_inverse_square(MOVES, **ax),
    "laws": lambda **ax: cm.plot_laws(["cycloidal", "cubic"], **ax),
    "ranking": lambda **ax: cm.plot_ranking({"cycloidal": 4.154, "cubic": 4}, **ax),
    "comparison": lambda: cm.plot_comparison(
        cm.compare(make_diagram(), make_diagram().at_rate(2500))
    ),
    "camshaft": lambda: cm.plot_camshaft(cm.Camshaft(make_diagram(), LOADS)),
    "cam": lambda **ax: cm.plot_cam(FACED, **ax),
    "fit": lambda **ax: cm.plot_fit(cm.Fit("40 H7/g6"), **ax),
    "residual": lambda **ax: cm.plot_residual(["cycloidal", "cubic"], ratios=[1, 2], **ax),
    "measured": lambda **ax: cm.plot_measured({"cam": CAM}, RATE, unit="in", **ax),
    "harmonics": lambda **ax: cm.plot_harmonics({"cam": [3, 1, 2]}, **ax),
}


@pytest.fixture(autouse=True)
def _settings() -> Iterator[None]:
    """Leave the settings of Matplotlib, and no figure, as they were found."""
    with mpl.rc_context():
        yield
    plt.close("all")


def png(ax: Axes) -> bytes:
    assert isinstance(ax.figure, PictureFigure)
    return ax.figure.png()


@pytest.mark.parametrize("plot", PLOTS)
@pytest.mark.filterwarnings("error")
def test_a_picture_is_the_same_whatever_is_set(plot: str) -> None:
    usual = png(PLOTS[plot]())
    mpl.style.use("dark_background")
    mpl.rcParams["font.size"] = 20
    mpl.rcParams["figure.constrained_layout.use"] = True
    assert png(PLOTS[plot]()) == usual


def test_a_picture_is_saved_on_white_paper(tmp_path: Path) -> None:
    mpl.rcParams["savefig.facecolor"] = "black"
    PLOTS["curves"]().figure.savefig(tmp_path / "picture.png")  # type: ignore[union-attr]
    assert plt.imread(tmp_path / "picture.png")[0].min() == 1


def test_a_chart_and_a_live_figure_are_as_light_in_a_dark_style(tmp_path: Path) -> None:
    def drawn() -> tuple[bytes, bytes]:
        page = cm.write_chart(make_diagram(), tmp_path / "chart.png", date="", overwrite=True)
        return page.read_bytes(), cm.explore_move(MOVES[0]).picture()

    usual = drawn()
    mpl.style.use("dark_background")
    mpl.rcParams["savefig.facecolor"] = "black"
    assert drawn() == usual


@pytest.mark.parametrize("plot", ["peaks", "ranking", "harmonics"])
def test_what_is_written_in_the_axes_of_a_dark_figure_is_dark(plot: str) -> None:
    """They become white; what stands beside them has the colours of their own figure."""
    mpl.style.use("dark_background")
    _, ax = plt.subplots()
    PLOTS[plot](ax=ax)
    assert {text.get_color() for text in ax.texts} == {"black"}
    assert ax.xaxis.label.get_color() == "white"
    assert ax.get_xticklabels()[0].get_color() == "white"


def test_what_a_backend_switches_on_meanwhile_stays_on() -> None:
    """A notebook shows pictures only while it is interactive, which its backend makes it."""

    @on_paper
    def draw() -> None:
        mpl.interactive(True)

    try:
        draw()
        assert mpl.is_interactive()
    finally:
        mpl.interactive(False)
