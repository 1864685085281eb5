"""Pictures of machines with large strokes: their numbers are read without a power of ten."""

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import chain

import matplotlib as mpl
import pytest
from matplotlib import pyplot as plt
from matplotlib.axes import Axes
from matplotlib.text import Text

import cammotion as cm
from cammotion.quantities import as_text
from cammotion.report.markup import short
from cammotion.views.chart import draw_chart
from cammotion.views.pictures import describe
from cammotion.views.scales import short_number

mpl.use("agg")

POWER = re.compile(r"\de\+0[0-4]|\d\.$|\d\. ")
LIFT = cm.motion(
    *("lift", cm.rise(5000, over_deg=30), cm.dwell(100)),
    *(cm.return_(5000, over_deg=80), cm.dwell(150)),
)
LINE = cm.TimingDiagram([LIFT, cm.EXAMPLE.diagram["die"]], rate_per_hour=5000)
MANY = cm.TimingDiagram([replace(LIFT, name=f"lift {n}") for n in range(6)], rate_per_hour=5000)


@pytest.fixture(autouse=True)
def _no_trace() -> Iterator[None]:
    yield
    plt.close("all")


def written(ax: Axes) -> list[str]:
    """Return all that is written in a picture, but for the numbers of its axes."""
    return [text.get_text() for text in ax.figure.findobj(Text) if text.get_visible()]


def powers(texts: Iterable[str]) -> list[str]:
    return [text for text in texts if POWER.search(text)]


def test_numbers_below_a_hundred_thousand_are_written_out() -> None:
    assert [as_text(value, "#.3g") for value in (415.4, 1234, 99_990, 123_456)] == [
        *("415", "1230", "100000", "1.23e+05")
    ]
    assert [short_number(value) for value in (999.7, -41_542, 1_234_567)] == [
        *("1000", "−41540", "1.235e+06")
    ]
    assert [short(value) for value in (41_542, float("inf"))] == ["41540", "∞"]


@pytest.mark.parametrize("machine", [LINE, MANY], ids=["two", "six"])
def test_no_picture_writes_them_with_a_power_of_ten(machine: cm.TimingDiagram) -> None:
    moves = [*chain.from_iterable(machine.moves(name) for name in machine.names)]
    loads = {name: cm.FollowerLoad(mass_kg=0.1) for name in machine.names}
    pictures = [
        cm.plot_timing(machine, rows=["velocity", "acceleration"]),
        cm.plot_peaks(moves),
        cm.plot_inverse_square([moves[0], moves[0]]),
        cm.plot_camshaft(cm.Camshaft(machine, loads)),
    ]
    for ax in pictures:
        assert powers(written(ax)) == []
        assert not re.search(r"e[-+]\d", describe(ax.figure))  # type: ignore[arg-type]
    assert powers(re.findall(r">([^<>]+)<", cm.animate(machine).svg)) == []
    page = draw_chart(machine, 1, ("Line", "2026-11-28"), (), {}).axes[0]
    assert powers(text.get_text() for text in page.texts) == []


RULE = cm.ClearanceRule(cm.beyond("lift", 100), only_while=cm.within("die", 20))
UP, DOWN = (make(4000, over_deg=110) for make in (cm.rise, cm.return_))
SLIDE = cm.motion("slide", UP, cm.dwell(60), DOWN, cm.dwell(80), start_deg=150)
TABLE = cm.indexing_motion("table", cm.rise(8000, over_deg=140), cm.dwell(220), stops=8)
SLOW = cm.TimingDiagram([SLIDE, TABLE], rate_per_hour=30)
KEPT = cm.ClearanceRule(cm.beyond("slide", 3900), only_while=cm.within("table", 40))
LOAD = cm.FollowerLoad(mass_kg=20_000, preload_N=1)
SHAFT = cm.Camshaft(SLOW, {"slide": LOAD})
CAM = cm.RollerCam(SLIDE, cm.TranslatingRoller(800), 4800)
POINTS = CAM.profile_mm([*range(360)]).T
SPRUNG = cm.FollowerLoad(mass_kg=20_000, stiffness_N_per_mm=2, preload_N=8000)
FLIGHTS = cm.follower_flights(SLIDE, SPRUNG, 300)

SENTENCES: dict[str, Callable[[], object]] = {
    "broken rule": lambda: cm.find_violations(LINE, RULE),
    "too near": lambda: cm.find_violations(LINE, cm.DistanceRule("die", "lift", 10)),
    "reserves": lambda: [str(one) for one in cm.reserves(SLOW, KEPT)],
    "limits": lambda: cm.rate_limits(SHAFT, force_N=20_000, torque_N_m=30_000),
    "peaks": lambda: [*map(str, cm.compare(SLOW, SLOW.at_rate(9000), KEPT).effects)],
    "forces": lambda: [*map(str, cm.compare(SHAFT, SHAFT.at_rate(60)).effects)],
    "flat cam": lambda: cm.FlatFacedCam(SLIDE, 400).undercuts,
    "flights": lambda: [str(FLIGHTS), cm.animate_follower(FLIGHTS).description],
    "still": lambda: cm.animate(SLOW).still(70).description,
    "gap": lambda: cm.animate_follower(FLIGHTS).still(290).description,
    "cam": lambda: cm.explore_cam(SLIDE, roller_radius_mm=800, prime_radius_mm=4800).text,
    "undercut": lambda: cm.explore_cam(SLIDE, roller_radius_mm=3000, prime_radius_mm=1500).text,
    "overlap": lambda: cm.explore_overlap(SLOW, KEPT, contact_mm=3950).text,
    "profile": lambda: cm.lift_from_profile(
        *CAM.profile_mm([*range(360)]).T, follower=CAM.follower
    ),
}


@pytest.mark.parametrize("name", SENTENCES)
def test_no_sentence_writes_them_with_a_power_of_ten(name: str) -> None:
    said = str(SENTENCES[name]())
    assert re.search(r"\d{4}", said), said
    assert powers([said]) == []
