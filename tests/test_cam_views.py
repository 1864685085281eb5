"""The cam as it is drawn: the explorer against the package, and the designer's picture."""

from collections.abc import Callable

import numpy as np
import pytest
from explored import drawn, panel_of
from matplotlib.backends.backend_agg import FigureCanvasAgg

import cammotion as cm
from cammotion.views.explorers.cam import OFFSET, PRIME, ROLLER
from cammotion.views.live.figure import LiveFigure

AFTER = cm.widest_move(cm.EXAMPLE.diagram, "die", cm.EXAMPLE.rule).diagram["die"]
AT = np.linspace(0.3, 359.7, 311)
SETTINGS = [(60, 0, 10), (120, 15, 12), (40, -20, 5), (20, 5, 14), (20, 0, 15)]


@pytest.fixture(
    scope="module", params=[cm.EXAMPLE.die, AFTER], ids=["without overlap", "with overlap"]
)
def motion(request: pytest.FixtureRequest) -> cm.Motion:
    return request.param  # type: ignore[no-any-return]


@pytest.fixture(scope="module")
def figure(motion: cm.Motion) -> LiveFigure:
    return cm.explore_cam(motion)


@pytest.mark.parametrize("times", [1, 1e-3, 0.1, 10, 100])
def test_the_controls_of_a_cam_of_another_size_are_of_that_size(times: float) -> None:
    """Also of one that a magnifier shows, or one as large as a house."""
    up, down = (make(50 * times, over_deg=120) for make in (cm.rise, cm.return_))
    small = cm.motion("slide", up, cm.dwell(60), down, cm.dwell(60))
    figure = cm.explore_cam(small, roller_radius_mm=10 * times, prime_radius_mm=60 * times)
    spans = [
        [control[end] / times for end in ("low", "high", "step")]
        for control in figure.description["controls"]
    ]
    assert spans == [pytest.approx(span) for span in ([15, 240, 1], [-30, 30, 1], [3, 30, 1])]


@pytest.mark.parametrize(("prime", "offset", "roller"), SETTINGS)
def test_the_explorer_draws_the_cam_of_the_package(
    figure: LiveFigure, motion: cm.Motion, prime: float, offset: float, roller: float
) -> None:
    figure.values = {PRIME: prime, OFFSET: offset, ROLLER: roller}
    cam = cm.RollerCam(motion, cm.TranslatingRoller(roller, offset), prime)
    lines = {line["name"]: line for line in panel_of(figure, "The cam turns")["lines"]}
    for name, points in (("cam", cam.profile_mm), ("pitch curve", cam.pitch_mm)):
        for now in (0.0, 130.0):
            x, y = (figure._now[lines[name][axis]](AT, now) for axis in "xy")
            turned = (x + 1j * y) * np.exp(1j * np.radians(now))
            assert np.stack([turned.real, turned.imag], -1) == pytest.approx(points(AT), abs=1e-6)
    pressure, sharpness = (
        drawn(figure, panel["lines"][0]["y"], AT) for panel in figure.description["columns"][1]
    )
    assert pressure == pytest.approx(cam.pressure_angle_deg(AT), abs=1e-6)
    assert sharpness == pytest.approx(roller / cam.pitch_radius_mm(AT), abs=1e-6)
    assert f"up to {cam.largest_pressure_angle.value:.3g} deg" in figure.text
    digits = 3 + bool(cam.undercuts)  # 14.987 and 15 would look alike
    assert f"a radius of {cam.sharpest.value:.{digits}g} mm" in figure.text
    assert ("UNDERCUT" in figure.text) == bool(cam.undercuts)


@pytest.mark.parametrize(
    ("prime", "offset", "roller"),
    [(15, 30, 3), (15, -30, 3), (15, 0, 30), (20, 20, 3), (20, 0, 20)],
)
def test_a_cam_that_cannot_be_is_neither_drawn_nor_praised(
    figure: LiveFigure, motion: cm.Motion, prime: float, offset: float, roller: float
) -> None:
    figure.values = {PRIME: prime, OFFSET: offset, ROLLER: roller}
    with pytest.raises(cm.InputError, match="more than"):
        cm.RollerCam(motion, cm.TranslatingRoller(roller, offset), prime)
    assert figure.text.startswith(f"NO CAM: the prime circle has a radius of {prime} mm, and has")
    assert len(figure.text.splitlines()) == 1
    for panel in (panel for column in figure.description["columns"] for panel in column):
        for line in panel["lines"]:
            if line["role"] in {"own", "alarm"} and line["name"] != "roller":
                assert np.all(figure._now[line["where"]](AT, 0.0) <= 0)
    assert figure.picture()


def test_the_cam_is_drawn_all_around(figure: LiveFigure) -> None:
    low, high = (float(figure._now[end](0.0, 0.0)) for end in figure.description["range"])
    assert (low, high) == (0, 360)


@pytest.mark.parametrize(("prime", "roller"), [(10, 10), (700, 40), (60, 2)])
def test_the_controls_reach_what_is_given(prime: float, roller: float) -> None:
    figure = cm.explore_cam(cm.EXAMPLE.die, roller_radius_mm=roller, prime_radius_mm=prime)
    assert (figure.values[PRIME], figure.values[ROLLER]) == (prime, roller)


def test_a_short_move_is_judged_too() -> None:
    parts = cm.rise(5, over_deg=3), cm.dwell(100), cm.return_(5, over_deg=7), cm.dwell(250)
    motion = cm.motion("short", *parts, start_deg=350)
    cam = cm.RollerCam(motion, cm.TranslatingRoller(10), 60)
    text = cm.explore_cam(motion).text
    assert f"up to {cam.largest_pressure_angle.value:.3g} deg" in text
    assert f"a radius of {cam.sharpest.value:.4g} mm" in text


def test_a_bad_cam_is_refused_in_words() -> None:
    with pytest.raises(cm.InputError, match="moves on from stop to stop"):
        cm.explore_cam(cm.EXAMPLE.mill)
    with pytest.raises(cm.InputError, match="radius of the roller is 0 mm"):
        cm.explore_cam(cm.EXAMPLE.die, roller_radius_mm=0)


CAMS: dict[str, Callable[[], cm.RollerCam | cm.FlatFacedCam]] = {
    "slide": lambda: cm.RollerCam(AFTER, cm.TranslatingRoller(10, 5), 60),
    "arm": lambda: cm.RollerCam(AFTER, cm.SwingingRoller(10, 150, 165), 60),
    "face": lambda: cm.FlatFacedCam(AFTER, 40),
}


@pytest.mark.parametrize("name", CAMS)
def test_a_cam_is_drawn_with_all_that_a_designer_wants(name: str) -> None:
    cam = CAMS[name]()
    ax = cm.plot_cam(cam, bore_mm=20)
    (profile,) = [patch for patch in ax.patches if patch.get_label() == "cam"]
    drawn_at = np.asarray(profile.get_path().vertices) @ [1, 1j]
    exact = cam.profile_mm(np.arange(0, 360, 0.02)) @ [1, 1j]
    assert max(np.abs(point - exact).min() for point in drawn_at) < 0.03
    written = {text.get_text() for text in ax.texts}
    if isinstance(cam, cm.FlatFacedCam):
        assert written == {"base circle R 40"}
    else:
        assert written == {"prime circle R 60", "roller r 10"}
    assert ax.get_aspect() == 1


@pytest.mark.parametrize("size", [0.01, 0.1, 1, 100])
@pytest.mark.parametrize("prime_mm", [15, 60])
def test_a_small_and_a_large_cam_are_drawn_alike(size: float, prime_mm: float) -> None:
    """What is written covers no number of an axis, and the arrow has the head of an arrow."""
    parts = cm.rise(50 * size, over_deg=55), cm.dwell(100), cm.return_(50 * size, over_deg=55)
    roller = cm.TranslatingRoller(10 * size)
    ax = cm.plot_cam(cm.RollerCam(cm.motion("die", *parts, cm.dwell(150)), roller, prime_mm * size))
    renderer = FigureCanvasAgg(ax.figure).get_renderer()  # type: ignore[arg-type,no-untyped-call]
    ax.figure.draw(renderer)
    for text in ax.texts:
        assert "e+" not in text.get_text()
        for number in [*ax.get_xticklabels(), *ax.get_yticklabels()]:
            said = text.get_window_extent(renderer)
            assert not said.overlaps(number.get_window_extent(renderer)), number
    arrow = [p for p in ax.patches if p.get_edgecolor()[:3] == (0, 0, 0)]
    arc, *barbs = (np.asarray(patch.get_path().vertices) for patch in arrow)
    radius = np.hypot(*arc[0])
    lengths = [float(np.hypot(*(barb[1] - barb[0]))) / radius for barb in barbs]
    assert lengths == pytest.approx([0.13, 0.13], abs=0.02)


def test_what_is_no_cam_is_not_drawn() -> None:
    with pytest.raises(cm.InputError, match="give a RollerCam or a FlatFacedCam"):
        cm.plot_cam(cm.EXAMPLE.die)  # type: ignore[arg-type]
