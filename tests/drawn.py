"""Pictures of each kind with what may be in them, and the accounts that are kept of them.

No change of a picture is an accident: `test_drawn.py` compares them with `data/drawn`. Look at the
pictures that have changed, then run this file to write the accounts anew.
"""

from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib as mpl
import numpy as np
import sympy as sp
from accounts import Account, account
from cam_machine import cam_machine
from cartons import all_dies, packaging_machine, pusher_rule
from explored import nyquist_figure, table_figure, weight_figure, zones_figure
from follower_pictures import flights
from judging import MACHINES
from machines import DIPPING, DOWN_DEG, RULE, make_diagram, make_die, make_mill
from matplotlib.axes import Axes
from measured_cam import CAM, RATE
from school import collect
from shafts import SHAFT
from table_machine import table_machine

import cammotion as cm
from cammotion.report.findings import find_all
from cammotion.report.markup import Beside
from cammotion.report.page import write_page
from cammotion.teaching.classroom import histogram, page
from cammotion.teaching.classroom.collect import read_class
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.number_exercise import NumberExercise
from cammotion.teaching.shown.choosing import show_answer
from cammotion.views.live.figure import LiveFigure

KEPT = Path(__file__).parent / "data" / "drawn"
PADS = cm.read_machine(Path(__file__).parents[1] / "notebooks" / "data" / "pad_press.csv")
CONSTANT_VELOCITY = cm.MotionLaw("constant velocity", cm.x)
LONG = "the carton former's left upper folding finger, at the infeed"

Drawing = Callable[[], Axes | LiveFigure | str]


def told_at_length(diagram: cm.TimingDiagram) -> cm.Machine:
    """Return a machine with a rule that takes several lines of a chart."""
    name = f"whatever happens, and as long as the machine turns, {LONG}, stays out of the way"
    return cm.Machine("cartons", diagram, [replace(pusher_rule(diagram), name=name)])


def wide() -> cm.TimingDiagram:
    """Return the running example with the widest die."""
    return cm.widest_move(cm.EXAMPLE.diagram, "die", RULE).diagram


def crowded() -> cm.TimingDiagram:
    """Return a machine of eight, one of them with a jump, one of constant speed, a long name."""
    jumps = cm.motion(
        LONG,
        cm.rise(12, over_deg=90, law=CONSTANT_VELOCITY),
        cm.dwell(100),
        cm.return_(12, over_deg=80, law="cubic"),
        cm.dwell(90),
        start_deg=310,
    )
    return cm.TimingDiagram([*PADS.diagram.motions, jumps], PADS.diagram.rate_per_hour)


def moves() -> list[cm.Move]:
    angles = 55, 124.8, 200
    laws = "cycloidal", "modified sine", "constant acceleration"
    return [
        cm.Move(stroke_mm=50, angle_deg=angle, rate_per_hour=2000, law=law)
        for angle, law in zip(angles, laws, strict=True)
    ]


def roller_cam(prime_mm: float = 60) -> cm.RollerCam:
    return cm.RollerCam(wide()["die"], cm.TranslatingRoller(10, offset_mm=5), prime_mm)


def flat_cam() -> cm.FlatFacedCam:
    up, down = (make(20, over_deg=180, law="simple harmonic") for make in (cm.rise, cm.return_))
    return cm.FlatFacedCam(cm.motion("valve", up, down), 25)


def jerk_price() -> Axes:
    found = [
        cm.LeastAcceleration(cm.EXAMPLE.diagram, bound, make_die(angle), limit)
        for limit, bound, angle in ((12, 0.9, 110), (8, 1.2, 100), (20, 0.8, 120))
    ]
    named = {"cycloidal": (8.12, 1.3), "MCV50": (49.2, 1.154), "modified sine": (13, 1.2)}
    return cm.plot_jerk_price(found, named, unlimited_m_per_s2=0.7)


def front() -> Axes:
    found = [
        cm.LeastPeak(
            cm.EXAMPLE.diagram,
            bound,
            make_diagram(make_mill(mill), make_die(die)),
            {"mill": 0.0 if of == "mill" else 1.0, "die": 0.0 if of == "die" else 1.0},
            at_most={of: limit},
        )
        for of, limit, bound, mill, die in (
            ("mill", 1.1, 0.8, 155, 120),
            ("mill", 0.7, 1.0, 190, 100),
            ("die", 0.9, 0.9, 170, 115),
        )
    ]
    return cm.plot_front(found, {"cycloids": [(0.9, 0.95), (1.2, 0.8)]}, {"03": (1.117, 0.806)})


def chart(machine: cm.Machine) -> str:
    with TemporaryDirectory() as folder:
        page = cm.write_chart(
            machine.diagram,
            f"{folder}/chart.svg",
            title="Press & <mill>",
            rules=machine.rules,
            radius_mm={machine.diagram.motions[0].name: 120},
            date="2026-11-28",
        )
        return page.read_text("utf-8")


def cartons(count: int) -> str:
    diagram = packaging_machine(count)
    return cm.animate(diagram, rules=all_dies(diagram)).still(150).svg


def report(machine: cm.Machine) -> str:
    found = find_all(machine, 20, lambda *_: None)
    files = [Beside("of the design", ["tables.xlsx", "codesys/die.txt"]), Beside("no DXF")]
    return write_page(found, date(2026, 11, 28), files)


def class_page() -> str:
    with TemporaryDirectory() as folder:
        return page.write(read_class(collect(Path(folder))), date(2026, 11, 28))


def response() -> cm.MoveResponse:
    return cm.MoveResponse(cm.tuned_mass(12, 0.02), moves()[1])


def long_flights() -> cm.Flights:
    """Return those of a soft spring, which brings the follower back turns later: none repeats."""
    load = cm.FollowerLoad(mass_kg=12, stiffness_N_per_mm=0.01, preload_N=1)
    return cm.follower_flights(cm.EXAMPLE.die, load, 2000, turns=4)


def pressed(figure: LiveFigure, *buttons: str) -> LiveFigure:
    """Return a live figure after the first settings were pinned and buttons were pressed."""
    figure.pin()
    for button in buttons:
        figure.press(button)
    return figure


BROKEN = cm.TimingDiagram([make_mill(), make_die(130)], 2000)
INDEXER = cm.Indexer(38.5, stops=8, time_s=0.75)

PICTURES: dict[str, Drawing] = {
    "timing": lambda: cm.plot_timing(BROKEN, rules=RULE, rows=["velocity", "acceleration", "jerk"]),
    "timing of many": lambda: cm.plot_timing(
        crowded(), rules=PADS.rules, rows=["velocity", "acceleration"]
    ),
    "timing alone": lambda: cm.plot_timing(cm.TimingDiagram([make_die(law=DIPPING)], 2000)),
    "clearance": lambda: cm.plot_clearance(cm.EXAMPLE.diagram, RULE),
    "clearance of designs": lambda: cm.plot_clearance(
        {"before": cm.EXAMPLE.diagram, "after": wide(), "broken": BROKEN}, RULE, span_mm=20
    ),
    "curves": lambda: cm.plot_curves(moves()),
    "velocity": lambda: cm.plot_curves(moves()[:1], curve="velocity", labels=["die"]),
    "peaks": lambda: cm.plot_peaks(moves(), labels=["a", "b", LONG]),
    "inverse square": lambda: cm.plot_inverse_square(
        cm.Move(stroke_mm=50, angle_deg=angle, rate_per_hour=2000) for angle in (55, 80, 124.8)
    ),
    "laws": lambda: cm.plot_laws(["cycloidal", "modified sine", CONSTANT_VELOCITY]),
    "all laws": lambda: cm.plot_laws(list(cm.LAWS), curve="V"),
    "jerk of laws": lambda: cm.plot_laws(["3-4-5 polynomial", "cubic"], curve="J"),
    "ranking": lambda: cm.plot_ranking({"cycloidal": 4.154, "modified sine": 3.66, "MCV50": 5.3}),
    "cam": lambda: cm.plot_cam(roller_cam(), bore_mm=20),
    "flat-faced cam": lambda: cm.plot_cam(flat_cam()),
    "camshaft": lambda: cm.plot_camshaft(SHAFT),
    "comparison": lambda: cm.plot_comparison(cm.compare(cm.EXAMPLE.diagram, wide())),
    "comparison of many": lambda: cm.plot_comparison(
        cm.compare(PADS.diagram, crowded().with_motion(cm.with_angle(PADS.diagram["mill"], 120)))
    ),
    "detour": lambda: cm.plot_detour(
        {"cycloid": cm.EXAMPLE.diagram, LONG: wide()},
        "die",
        still=(205, 305),
        corners=((70, 31), (190, 31)),
        usual_mm=50,
        with_acceleration=True,
    ),
    "detour of many": lambda: cm.plot_detour(
        {f"design {n}": make_diagram(make_mill(), make_die(55 + 10 * n)) for n in range(7)},
        "die",
        still=(205, 305),
        corners=((70, 31), (190, 31)),
    ),
    "weight": lambda: cm.plot_weight(
        sp.Piecewise((65 - sp.Symbol("u"), sp.Symbol("u") < 70), (-5, True)),
        (sp.Symbol("u"), 0, 130),
    ),
    "fit": lambda: cm.plot_fit([cm.Fit("40 H7/g6"), cm.Fit("40 H7/p6"), cm.Fit("6 H9/d9")]),
    "jerk price": jerk_price,
    "front": front,
    "measured": lambda: cm.plot_measured(
        {"measured": CAM, "smoothed": cm.smoothed(CAM)}, RATE, unit="in", error_mm=0.01
    ),
    "harmonics": lambda: cm.plot_harmonics(
        {"cam": [3, 0.2, 1, 0.1], LONG: [2.5, 0.3, 0.9, 0.4]}, critical=3
    ),
    "residual": lambda: cm.plot_residual(["cycloidal", "modified sine"], damping_ratio=0.02),
    "worst residual": lambda: cm.plot_residual(
        "cycloidal", ratios=np.linspace(1, 4, 31), quantity="worst"
    ),
    "response": lambda: cm.plot_response(response()),
    "running response": lambda: cm.plot_response(
        cm.SteadyResponse(cm.tuned_mass(12, 0.02), cm.EXAMPLE.die, 2000), over=(100, 300)
    ),
    "torque": lambda: cm.plot_torque(
        {"even": INDEXER, "braked": cm.Indexer(38.5, stops=8, time_s=0.75, friction_N_m=40)}
    ),
    "power": lambda: cm.plot_torque({"table": INDEXER}, quantity="power"),
    "chart": lambda: chart(cm.Machine("press", BROKEN, [RULE], {})),
    "chart of many": lambda: chart(PADS),
    "chart of more": lambda: chart(told_at_length(packaging_machine(20))),
    "report": lambda: report(
        cm.Machine("press", BROKEN, [RULE], {"mill": [DOWN_DEG], "die": [DOWN_DEG]})
    ),
    "report of many": lambda: report(cm.Machine(PADS.name, PADS.diagram, PADS.rules)),
    "class": class_page,
    "histogram": lambda: histogram.draw([4, 4.1, 4.2, 4.2, 5, 3.3, 60, -9], "<m/s²>", 4.154),
    "leaving": lambda: cm.animate_follower(flights()).svg,
    "leaving for turns": lambda: cm.animate_follower(long_flights()).svg,
    "die magnified": lambda: cm.animate(wide(), rules=RULE, magnify=10).still(135).svg,
    "broken die magnified": lambda: cm.animate(BROKEN, rules=RULE, magnify=10).still(135).svg,
    "machine of many": lambda: cm.animate(crowded(), rules=PADS.rules).still(135).svg,
    "machine of eight": lambda: cartons(8),
    "cam machine": lambda: cam_machine(make_diagram(), RULE),
    "table machine": lambda: table_machine(INDEXER, 150),
    "explore cam": lambda: pressed(cm.explore_cam(wide()["die"])),
    "explore follower": lambda: pressed(cm.explore_follower()),
    "explore residual": lambda: pressed(cm.explore_residual()),
    "explore measured": lambda: pressed(cm.explore_measured(CAM, RATE, unit="in")),
    "explore move": lambda: pressed(cm.explore_move(moves()[0], laws=cm.LAWS)),
    "explore overlap": lambda: pressed(
        cm.explore_overlap(cm.EXAMPLE.diagram, RULE, contact_mm=20), "Widest move of the die"
    ),
    "explore scca": lambda: pressed(cm.explore_scca(), "modified trapezoid"),
    "explore shares": lambda: pressed(cm.explore_shares(cm.EXAMPLE.diagram)),
    "explore ways": lambda: pressed(cm.explore_ways(cm.EXAMPLE.diagram, RULE)),
    "explore weight": lambda: pressed(weight_figure()),
    "explore table": lambda: pressed(table_figure()),
    "explore wave": lambda: pressed(nyquist_figure()),
    "explore zones": lambda: pressed(zones_figure()),
}
"""Each picture by its name."""


def accounts() -> dict[str, Account]:
    """Return what is kept: of each picture, and of what wrong answers show."""
    found = {name: account(draw()) for name, draw in PICTURES.items()}
    return found | {"answers": answers()}


def answers() -> Account:
    """Return what wrong answers to the exercises show: one too large, one too small."""
    lines: Account = []
    for exercise in EXERCISES.values():
        if not isinstance(exercise, NumberExercise) or not exercise.shows:
            continue
        machine = MACHINES[2]
        for times in (0.6, 1.5):
            if shown := show_answer(exercise, times * exercise.solution(machine), machine):
                lines += [f"{exercise.number} x {times}: {shown.line}", *account(shown.svg)]
    return lines


def file_of(name: str) -> Path:
    """Return the file in which the account of a picture is kept."""
    return KEPT / f"{name.replace(' ', '_')}.txt"


def write() -> None:
    """Write all accounts anew."""
    KEPT.mkdir(exist_ok=True)
    with mpl.rc_context({"figure.max_open_warning": 0}):
        drawn = accounts()  # all of them, before one that is kept is lost
    for old in KEPT.glob("*.txt"):
        old.unlink()
    for name, lines in drawn.items():
        file_of(name).write_text("\n".join(lines) + "\n", "utf-8", newline="")


if __name__ == "__main__":
    write()
