"""Pictures of what is called oddly, stands far from zero, is tiny, or stands still."""

import re
from collections.abc import Callable, Iterator
from itertools import pairwise
from typing import Any

import matplotlib as mpl
import numpy as np
import pytest
import sympy as sp
from machines import RULE, make_diagram, make_die, make_mill
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

import cammotion as cm
from cammotion import x
from cammotion.views.chart_lanes import beside
from cammotion.views.ends import inches
from cammotion.views.pictures import PictureFigure, describe

mpl.use("agg")

FORMULA, HIDDEN, LONG = "$x_1$", "_b", 200 * "W"
TABLE = cm.Indexer(38.5, stops=8, time_s=0.75)
ANGLES = np.arange(0.0, 360.0, 10.0)
CAM = cm.CamTable(ANGLES, 25 - 25 * np.cos(np.radians(ANGLES)), is_cycle=True)


@pytest.fixture(autouse=True)
def _close_figures() -> Iterator[None]:
    yield
    plt.close("all")


def words_of(ax: Axes) -> str:
    """Draw the picture that holds axes, and return its words."""
    assert isinstance(ax.figure, PictureFigure)
    ax.figure.png()
    return describe(ax.figure)


def named(*names: str) -> list[cm.Motion]:
    """Return motions that rise and return, one for each name."""
    moves = cm.rise(50, over_deg=55), cm.dwell(100), cm.return_(50, over_deg=55), cm.dwell(150)
    return [cm.motion(name, *moves) for name in names]


def law(name: str) -> cm.MotionLaw:
    return cm.MotionLaw(name, 3 * x**2 - 2 * x**3)


@pytest.mark.parametrize(
    "draw",
    [
        lambda name: cm.plot_laws([law(name)]),
        lambda name: cm.plot_residual([law(name)]),
        lambda name: cm.plot_torque({name: TABLE}),
        lambda name: cm.plot_measured({name: CAM}, 900),
        lambda name: cm.plot_clearance({name: make_diagram()}, RULE),
        lambda name: cm.plot_timing(cm.TimingDiagram(named(name), 2000)),
    ],
)
@pytest.mark.parametrize("name", [FORMULA, HIDDEN, LONG])
def test_a_curve_is_called_by_its_name_whatever_that_is(
    draw: Callable[[str], Axes], name: str
) -> None:
    ax = draw(name)
    assert f"{name} from " in words_of(ax)
    legend = ax.get_legend()
    written = [*ax.texts, *(legend.get_texts() if legend else ())]
    assert not any(text.get_parse_math() for text in written if "x_1" in text.get_text())


@pytest.mark.parametrize("name", [FORMULA, HIDDEN, LONG])
def test_the_legend_of_harmonics_has_their_names(name: str) -> None:
    ax = cm.plot_harmonics({name: [3, 1], "other": [1, 2]})
    words_of(ax)
    legend = ax.get_legend()
    assert legend is not None
    (first, _) = legend.get_texts()
    assert first.get_text().strip().startswith(name[:10])
    assert not first.get_parse_math()


def test_a_name_at_its_curve_is_no_formula() -> None:
    words = words_of(cm.plot_timing(cm.TimingDiagram(named(FORMULA, "a$b"), 2000)))
    assert "Written in it: $x_1$; a$b." in words


def test_what_is_called_by_a_number_is_drawn() -> None:
    assert "8 from " in words_of(cm.plot_torque({8: TABLE}))  # type: ignore[dict-item]


def test_bars_are_told_whatever_they_are_called() -> None:
    move = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    words = words_of(cm.plot_peaks([move, move], labels=[FORMULA, "1"]))
    assert "Bars: $x_1$; 1." in words


def test_what_has_no_name_in_a_cam_is_not_told() -> None:
    cam = cm.RollerCam(make_die(), cm.TranslatingRoller(10), prime_radius_mm=160)
    assert "Marked: cam; pitch curve; follower; prime circle 160 mm." in words_of(cm.plot_cam(cam))


def test_the_bars_of_two_versions_are_called_as_their_lanes_and_apart() -> None:
    long = [f"the lower left sealing jaw {n} of the second machine" for n in (1, 2)]
    before = cm.TimingDiagram([*named(*long, "金")], 2000)
    ax = cm.plot_comparison(cm.compare(before, cm.TimingDiagram(before.motions, 2500)))
    below = ax.figure.axes[1]
    rows = [text.get_text().removesuffix(", peak acceleration") for text in below.get_yticklabels()]
    assert rows == [text.get_text() for text in ax.get_yticklabels()]
    assert len({*rows}) == len(rows)


def test_long_names_leave_room_for_the_angles_of_two_versions() -> None:
    before = cm.TimingDiagram(named(LONG), 2000)
    ax = cm.plot_comparison(cm.compare(before, cm.TimingDiagram(before.motions, 2500)))
    assert inches(ax)[0] > 4.5


def test_a_short_stroke_far_from_zero_is_told() -> None:
    moves = cm.rise(5, over_deg=90), cm.dwell(180), cm.return_(5, over_deg=90)
    far = [cm.motion(name, *moves, start_mm=12345) for name in "abcde"]
    ax = cm.plot_timing(cm.TimingDiagram(far, 2000))
    assert "a from 12345 to 12350;" in words_of(ax)
    assert {text.get_text() for text in ax.texts} == {"12345 to 12350"}
    slides = cm.animate(cm.TimingDiagram(far[:1], 2000)).svg
    assert {">12345<", ">12350<"} <= {f">{part.split('<')[0]}<" for part in slides.split(">")}


@pytest.mark.parametrize(("stroke_mm", "said"), [(123.4, "0 to 123.4 mm"), (50, "0 to 50 mm")])
def test_a_chart_has_the_stroke_that_is_to_be_set(stroke_mm: float, said: str) -> None:
    rise, back = cm.rise(stroke_mm, over_deg=90), cm.return_(stroke_mm, over_deg=90)
    assert beside(cm.motion("die", rise, back, cm.dwell(180)), 1, None).stroke == said


def test_a_chart_has_one_stop() -> None:
    belt = cm.indexing_motion("belt", cm.rise(100, over_deg=150), cm.dwell(210), stops=1)
    assert beside(belt, 1, None).stroke == "100 mm, 1 stop"


@pytest.mark.parametrize("angle_deg", [0.01, 0.5, 1, 3])
@pytest.mark.parametrize("start_deg", [0, 725.3])
def test_a_short_move_is_drawn_as_hard_as_it_is(angle_deg: float, start_deg: float) -> None:
    """At every half degree the acceleration of a move over one degree is 0."""
    still = cm.dwell(180 - angle_deg)
    moves = cm.rise(1, over_deg=angle_deg), still, cm.return_(1, over_deg=angle_deg), still
    diagram = cm.TimingDiagram([cm.motion("pin", *moves, start_deg=start_deg)], 600)
    ax = cm.plot_timing(diagram, rows=["acceleration"])
    drawn = np.asarray(ax.figure.axes[-1].lines[0].get_ydata())
    assert drawn.max() == pytest.approx(diagram.peak_acceleration("pin"), rel=0.01)
    shaft = cm.Camshaft(diagram, {"pin": cm.FollowerLoad(mass_kg=1)})
    torque = cm.plot_camshaft(shaft)
    assert np.max(np.abs(torque.lines[0].get_ydata())) == pytest.approx(
        abs(shaft.peak_torque().value), rel=0.01
    )


@pytest.mark.parametrize("over", [None, (100, 900)])
def test_a_short_move_drives_a_follower_as_hard_as_it_is(over: tuple[float, float] | None) -> None:
    moves = cm.rise(1, over_deg=0.5), cm.dwell(179.5), cm.return_(1, over_deg=0.5), cm.dwell(179.5)
    pin = cm.motion("pin", *moves, start_deg=725.5)
    response = cm.SteadyResponse(cm.tuned_mass(12, 0.05), pin, 60)
    cam = cm.plot_response(response, over=over).lines[-2]
    peak = cm.TimingDiagram([pin], 60).peak_acceleration("pin")
    assert cam.get_label() == "cam"
    assert np.max(cam.get_ydata()) == pytest.approx(peak, rel=0.01)


def test_a_follower_goes_up_in_a_short_move_as_its_cam_does() -> None:
    moves = cm.rise(1, over_deg=0.5), cm.dwell(179.5), cm.return_(1, over_deg=90), cm.dwell(90)
    load = cm.FollowerLoad(mass_kg=0.1, stiffness_N_per_mm=1, preload_N=3000)
    drawn = cm.animate_follower(cm.follower_flights(cm.motion("pin", *moves), load, 60)).svg
    (times,) = re.findall(
        r'data-part="follower">\s*<animateTransform[^>]*keyTimes="([^"]*)"', drawn
    )
    assert sum(0 < float(time) < 0.5 / 360 for time in times.split(";")) > 30


def test_a_detour_of_short_moves_is_as_hard_as_it_is() -> None:
    moves = cm.rise(50, over_deg=0.5), cm.dwell(100), cm.return_(50, over_deg=0.5), cm.dwell(259)
    diagram = cm.TimingDiagram([cm.motion("pin", *moves, start_deg=100)], 60)
    corners = (50, 20), (120, 20)
    ax = cm.plot_detour(
        {"design": diagram}, "pin", still=(250, 60), corners=corners, with_acceleration=True
    )
    drawn = np.asarray(ax.figure.axes[-1].lines[0].get_ydata())
    assert drawn.max() == pytest.approx(diagram.peak_acceleration("pin"), rel=0.01)


def test_a_map_reaches_to_where_a_motion_only_just_comes() -> None:
    moves = cm.rise(50, over_deg=0.2), cm.dwell(0.1), cm.return_(50, over_deg=0.2), cm.dwell(359.5)
    pin = cm.motion("die", *moves, start_deg=10.001)
    ax = cm.plot_clearance(cm.TimingDiagram([make_mill(), pin], 2000), RULE)
    assert ax.get_ylim()[1] > 50


def test_the_rounding_of_a_large_torque_is_no_mean() -> None:
    diagram = cm.TimingDiagram([make_die(), make_mill()], 1e9)
    shaft = cm.Camshaft(diagram, {name: cm.FollowerLoad(mass_kg=12) for name in diagram.names})
    assert "mean 0 N m from 0 to 0" in words_of(cm.plot_camshaft(shaft))


def test_small_peaks_and_harmonics_keep_their_digits() -> None:
    ranking = cm.plot_ranking({"cycloidal": 0.000415, "simple harmonic": 0.000326})
    assert [text.get_text() for text in ranking.texts] == ["0.0004150", "0.0003260"]
    harmonics = cm.plot_harmonics({"cam": [5.14, 0.00412]})
    assert [text.get_text() for text in harmonics.texts] == ["2: 0.00412", "1: 5.14"][::-1]


def test_harmonics_that_are_no_dictionary_are_refused_in_plain_words() -> None:
    with pytest.raises(cm.InputError, match="for each name a number or a list of numbers"):
        cm.plot_harmonics([1])  # type: ignore[arg-type]


def test_the_swing_at_one_ratio_is_a_point() -> None:
    assert cm.plot_residual("cycloidal", ratios=5).lines[0].get_marker() == "o"
    assert cm.plot_residual("cycloidal", ratios=[4, 5]).lines[0].get_marker() == "None"


def test_a_response_is_drawn_forwards_and_each_mass_once() -> None:
    move = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
    response = cm.MoveResponse(cm.tuned_mass(12, 0.02), move)
    for over in ((0, 0), (1, 0)):
        with pytest.raises(cm.InputError, match=f"over {over[0]} to 0: give where to begin first"):
            cm.plot_response(response, over=over)
    assert words_of(cm.plot_response(response, masses=[1, 1])).count("mass from") == 1


u, n = sp.symbols("u n")


@pytest.mark.parametrize(
    ("weight", "span", "said"),
    [
        (1 / u, (0, 130), "1/u: give an expression in u alone that is a finite"),
        (sp.sqrt(u - 50), (0, 130), "a finite real number everywhere"),
        (sp.I * u, (0, 130), "a finite real number everywhere"),
        (sp.Function("f")(u), (0, 130), r"weight is f\(u\)"),
        (sp.polylog(2, u / 200), (0, 130), r"weight is polylog\(2, u/200\)"),
        (sp.Derivative(sp.sin(u), u), (0, 130), r"weight is Derivative\(sin\(u\), u\)"),
        (sp.Integral(sp.sin(u * n), (n, 0, 1)), (0, 130), "weight is Integral"),
        (10**400 * u, (0, 130), "a finite real number everywhere"),
        (65 - u, (130, 0), "goes from 130 to 0 deg"),
        (65 - u, (7, 7), "goes from 7 to 7 deg"),
    ],
)
def test_a_weight_that_is_none_is_refused(
    weight: sp.Expr, span: tuple[float, float], said: str
) -> None:
    with pytest.raises(cm.InputError, match=said):
        cm.plot_weight(weight, (u, *span))


def test_a_follower_that_stands_still_is_refused_at_once() -> None:
    load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=1, preload_N=30)
    flights = cm.follower_flights(cm.motion("gate", cm.dwell(360)), load, 3000)
    with pytest.raises(cm.InputError, match="'gate' stands still"):
        cm.animate_follower(flights)


@pytest.mark.parametrize("explore", [cm.explore_follower, cm.explore_residual])
def test_no_law_is_told_as_that(explore: Callable[[Any], Any]) -> None:
    with pytest.raises(cm.InputError, match="the laws are"):
        explore([])


MOVE = cm.Move(stroke_mm=50, angle_deg=55, rate_per_hour=2000)
RESPONSE = cm.MoveResponse(cm.tuned_mass(12, 0.02), MOVE)
DETOUR: dict[str, Any] = {"still": (205, 305), "corners": ((70, 31), (190, 31))}
MILL_ALONE = make_diagram(make_mill())


@pytest.mark.parametrize(
    "draw",
    [
        lambda: cm.plot_harmonics({"cam": [1]}, critical=4),
        lambda: cm.plot_harmonics({"cam": [-1]}),
        lambda: cm.plot_measured({"cam": CAM}, 900, error_mm=-1),
        lambda: cm.plot_measured({"cam": CAM}, -900),
        lambda: cm.plot_residual(damping_ratio=2),
        lambda: cm.plot_residual(cm.MotionLaw("constant velocity", x)),
        lambda: cm.plot_response(RESPONSE, masses=[7]),
        lambda: cm.plot_cam(cm.RollerCam(make_die(), cm.TranslatingRoller(10), 160), bore_mm=900),
        lambda: cm.plot_clearance(make_diagram(), RULE, span_mm=-1),
        lambda: cm.plot_detour({"a": make_diagram(), "b": MILL_ALONE}, "die", **DETOUR),
        lambda: cm.plot_detour({"a": make_diagram()}, "die", **DETOUR, usual_mm=np.nan),
        lambda: cm.plot_jerk_price(
            [cm.LeastAcceleration(make_diagram(), 0.9, make_die(), jerk) for jerk in (8, 12)],
            unlimited_m_per_s2=-1,
        ),
    ],
)
def test_what_is_refused_leaves_no_blank_picture(draw: Callable[[], Axes]) -> None:
    """A notebook shows every picture that was begun, under the sentence too."""
    with pytest.raises(cm.InputError):
        draw()
    assert not plt.get_fignums()


@pytest.mark.parametrize("rate", [20, 2000, 2e7])
def test_the_values_of_many_peaks_do_not_cover_one_another(rate: float) -> None:
    angles = range(20, 32)
    ax = cm.plot_peaks(
        [cm.Move(stroke_mm=50, angle_deg=angle, rate_per_hour=rate) for angle in angles]
    )
    words_of(ax)
    boxes = [text.get_window_extent() for text in ax.texts]
    assert not any(one.overlaps(other) for one, other in pairwise(boxes))
