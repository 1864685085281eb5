"""What a notebook is given for a picture: the picture, and words for who does not see it."""

from collections.abc import Callable
from pathlib import Path

import pytest
from explored import picture_in
from machines import RULE
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

import cammotion as cm
from cammotion.views import pictures
from cammotion.views.pictures import PictureFigure, blank_axes, describe

PNG = b"\x89PNG"
PLOTS: dict[str, Callable[[], Axes]] = {
    "timing": lambda: cm.plot_timing(cm.EXAMPLE.diagram, rows=["acceleration"]),
    "clearance": lambda: cm.plot_clearance(cm.EXAMPLE.diagram, cm.EXAMPLE.rule),
    "curves": lambda: cm.plot_curves(cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)),
    "peaks": lambda: cm.plot_peaks([cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)]),
    "laws": lambda: cm.plot_laws("cycloidal"),
    "ranking": lambda: cm.plot_ranking({"cycloidal": 4.154}),
    "detour": lambda: cm.plot_detour(
        {"cycloid": cm.EXAMPLE.diagram}, "die", still=(205, 305), corners=((70, 31), (190, 31))
    ),
}


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> Callable[[Axes], dict[str, str]]:
    """Return what a notebook is given for the picture that holds axes."""
    given: list[dict[str, str]] = []
    monkeypatch.setattr(pictures, "display", lambda data, **_: given.append(data))

    def show(ax: Axes) -> dict[str, str]:
        ax.figure._ipython_display_()  # type: ignore[union-attr]
        return given.pop()

    return show


def test_a_notebook_gets_the_picture_with_words(shown: Callable[[Axes], dict[str, str]]) -> None:
    data = shown(cm.plot_laws("cycloidal"))
    assert {*data} == {"text/html", "text/plain"}
    assert picture_in(data, data["text/plain"]).startswith(PNG)
    assert "Curves: cycloidal" in data["text/plain"]


@pytest.mark.parametrize("plot", PLOTS)
def test_every_plot_says_in_words_what_it_shows(plot: str) -> None:
    picture = PLOTS[plot]()
    words = words_of(picture)
    for ax in picture.figure.axes:
        for label in filter(None, (ax.get_xlabel(), ax.get_ylabel())):
            assert " ".join(label.split()).lower() in words.lower()
    assert " from " in words or "Bars: " in words


def test_a_saved_picture_is_cut_to_what_is_drawn(tmp_path: Path) -> None:
    moves = [cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=rate) for rate in (2000, 2100)]
    shaft = cm.Camshaft(cm.EXAMPLE.diagram, {"die": cm.FollowerLoad(mass_kg=12)})
    for ax in (
        *(picture() for picture in PLOTS.values()),
        cm.plot_curves(9 * moves),
        cm.plot_camshaft(shaft),
    ):
        ax.figure.savefig(tmp_path / "picture.png")  # type: ignore[union-attr]
        picture = plt.imread(tmp_path / "picture.png")
        edges = picture[0], picture[-1], picture[:, 0], picture[:, -1]
        assert all(edge.min() == 1 for edge in edges), ax.get_ylabel()


def test_a_picture_that_was_taken_is_closed() -> None:
    ax = blank_axes(2, 2)
    assert plt.get_fignums()
    png, words = pictures.taken(ax)
    assert png.startswith(PNG)
    assert words == describe(ax.figure)  # type: ignore[arg-type]
    assert not plt.get_fignums()


def test_a_timing_diagram_is_told_with_its_moves_and_overlaps() -> None:
    design = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram
    words = words_of(cm.plot_timing(design))
    assert "mill: rise from 0 to 150 deg" in words
    assert "die: return from 0 to 69.837 deg" in words
    assert "overlap from 80.163 to 150 deg" in words


def test_the_words_of_harmonics_name_the_series() -> None:
    words = words_of(cm.plot_harmonics({"cam": [3, 0.2], 9 * "long ": [2.5, 0.3]}))
    assert f"Bars: cam up to 3; {' '.join(9 * ['long'])} up to 2.5." in words


def test_the_words_of_a_clearance_map_say_what_is_forbidden() -> None:
    words = words_of(cm.plot_clearance(cm.EXAMPLE.diagram, RULE))
    assert (
        "Marked: forbidden where the die is beyond 19 mm and the mill not within 0.65 mm." in words
    )


def test_the_words_of_an_undercut_cam_say_where_it_is() -> None:
    cam = cm.RollerCam(cm.EXAMPLE.die, cm.TranslatingRoller(30), 40)
    said = "cam, undercut from 187.9 to 200.11 deg and from 309.89 to 322.1 deg"
    assert f"Marked: {said}" in words_of(cm.plot_cam(cam))


def test_the_words_of_a_ranking_say_which_bars_are_hatched() -> None:
    words = words_of(cm.plot_ranking({"cycloidal": 4.154, "cubic": 3.97, "modified sine": 3.66}))
    assert "Marked: cubic, hatched." in words


def words_of(ax: Axes) -> str:
    """Return the words of the picture that holds axes."""
    assert isinstance(ax.figure, PictureFigure)
    return describe(ax.figure)


def drawn(**names: str) -> Axes:
    """Return axes with a curve, a mark of one point, and what `names` say."""
    ax = blank_axes(3, 2)
    ax.plot(range(11), range(11))
    ax.plot(3, 3, "o", label="a mark")
    ax.set(**names)
    return ax


def test_names_that_are_markup_stay_names(shown: Callable[[Axes], dict[str, str]]) -> None:
    words = '<b>x</b> & "y". Curves: one from 0 to 10.'
    assert picture_in(shown(drawn(xlabel='<b>x</b> & "y"')), words).startswith(PNG)


def test_a_bare_picture_has_words_too() -> None:
    assert words_of(drawn()) == "Curves: one from 0 to 10."
    assert words_of(blank_axes(3, 2)) == "An empty picture."
