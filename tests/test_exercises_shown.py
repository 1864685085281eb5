"""What an answer would do is drawn and said, and is true; the right number stands nowhere in it."""

import math
import re
from collections.abc import Callable, Iterator
from itertools import combinations
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from judging import MACHINES, NUMBERS, number_id
from known_slips import die, later, law, place, stroke, time, turn, widest
from machines import Array

import cammotion as cm
from cammotion.machine.clearance import find_violations
from cammotion.teaching import session
from cammotion.teaching.example import EXAMPLE, MillAndDie
from cammotion.teaching.exercise import Exercise, NumberExercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.shown import frame
from cammotion.teaching.shown.choosing import show_answer
from cammotion.teaching.shown.frame import DIE, Frame, Shown
from cammotion.teaching.store import GRADING, Store
from cammotion.views.animation.svg import text_px
from cammotion.views.plots import COLOURS

SHOWN = [exercise for exercise in NUMBERS if exercise.shows]
TIMES = (0.05, 0.3, 0.6, 0.9, 0.97, 1.03, 1.1, 1.5, 2.2, 20)
SVG = "{http://www.w3.org/2000/svg}"
NUMBER = re.compile(r"\d+(?:\.\d+)?")
each_shown = pytest.mark.parametrize("exercise", SHOWN, ids=number_id)


def numbers(text: str) -> list[float]:
    return [float(number) for number in NUMBER.findall(text)]


def answers(exercise: NumberExercise, machine: MillAndDie) -> list[float]:
    """Return all its slips, and numbers near and far."""
    right = exercise.solution(machine)
    slips = [float(slip.answer(machine)) for slip in (*exercise.slips, *exercise.carried)]
    return [*slips, *(right * times for times in TIMES)]


def wrong(number: str) -> Iterator[tuple[MillAndDie, float, Shown]]:
    """Yield what is shown of wrong answers to an exercise, for all machines."""
    exercise = EXERCISES[number]
    assert isinstance(exercise, NumberExercise)
    for machine in MACHINES:
        for answer in answers(exercise, machine):
            shown = exercise.show(answer, machine)
            if shown and exercise.judge(answer, machine).state == "wrong":
                yield machine, answer, shown


def texts(shown: Shown) -> list[ElementTree.Element]:
    return ElementTree.fromstring(shown.svg).findall(f"{SVG}text")  # noqa: S314 - our own


def curve(shown: Shown) -> Array:
    """Return the points of the thick line in the colour of the die, in px."""
    root = ElementTree.fromstring(shown.svg)  # noqa: S314 - our own
    (path,) = [
        path
        for path in root.findall(f"{SVG}path")
        if path.get("stroke") == DIE and "stroke-dasharray" not in path.attrib
    ]
    return np.array([point.split() for point in path.attrib["d"][1:].split("L")], dtype=float)


def is_red(shown: Shown) -> bool:
    return "url(#alarm)" in shown.svg


def test_as_many_exercises_show_what_an_answer_would_do() -> None:
    assert " ".join(exercise.number for exercise in SHOWN) == (
        "01.1 01.2 01.3 02.1 02.3 02.4 03.1 03.2 03.3 03.4 03.5 04.1 04.2 04.3 05.1 05.3 05.5 "
        "06.3 06.4 06.5"
    )


@each_shown
def test_most_wrong_answers_and_every_right_one_are_shown(exercise: NumberExercise) -> None:
    near = [times for times in TIMES if 0.05 < times < 1.6]
    shown = 0
    for machine in MACHINES:
        right = exercise.solution(machine)
        assert exercise.show(right, machine) is not None
        shown += sum(exercise.show(right * times, machine) is not None for times in near)
    assert shown >= 0.9 * len(MACHINES) * len(near)


@each_shown
def test_a_picture_is_whole(exercise: NumberExercise) -> None:
    for machine in MACHINES[:8]:
        for answer in [*answers(exercise, machine), exercise.solution(machine)]:
            if shown := exercise.show(answer, machine):
                root = ElementTree.fromstring(shown.svg)  # noqa: S314 - our own
                assert int(root.attrib["width"]) <= 520
                assert int(root.attrib["height"]) <= 200
                assert root.findtext(f"{SVG}title") == shown.line
                assert "nan" not in shown.svg
                assert "inf" not in shown.svg
                assert "e+" not in shown.line + " ".join(str(text.text) for text in texts(shown))
                assert len(shown.svg) < 8000
                assert 20 < len(shown.line) < 260
                assert_texts_keep_apart(shown)


def assert_texts_keep_apart(shown: Shown) -> None:
    boxes = []
    for text in texts(shown):
        # the widest of the fonts is allowed for, which this machine may not have
        width = text_px(str(text.text), 12)
        shift = {"start": 0.0, "middle": width / 2, "end": width}[text.attrib["text-anchor"]]
        left, y = float(text.attrib["x"]) - shift, float(text.attrib["y"])
        assert left >= 0, text.text
        assert left + width <= frame.WIDTH, text.text
        assert 10 <= y <= frame.HEIGHT - 3, text.text
        boxes.append((left, left + width, y - 10, y + 3))
    for (left, right, top, bottom), (other, end, high, low) in combinations(boxes, 2):
        assert right <= other or end <= left or bottom <= high or low <= top, shown.line


@each_shown
def test_the_right_number_stands_nowhere(exercise: NumberExercise) -> None:
    for machine in MACHINES:
        right = exercise.solution(machine)
        known = numbers(exercise.question(machine))
        for answer in answers(exercise, machine):
            shown = exercise.show(answer, machine)
            if shown is None or exercise.judge(answer, machine).state == "right":
                continue
            told = numbers(" ".join([shown.line, *(str(text.text) for text in texts(shown))]))
            for number in told:
                theirs = any(math.isclose(number, n, rel_tol=6e-3) for n in [*known, answer])
                assert theirs or not math.isclose(number, right, rel_tol=0.01), shown.line


def own_rule(machine: MillAndDie, limit_mm: float) -> cm.ClearanceRule:
    near = machine.pitch_mm * law(0.1)
    return cm.ClearanceRule(cm.beyond("die", limit_mm), only_while=cm.within("mill", near))


def own_machine(
    machine: MillAndDie, start: float, way: float, work: float | None = None
) -> cm.TimingDiagram:
    """Build a machine anew, with a die that sets off at an angle."""
    work = machine.work_deg if work is None else work
    rest = 360 - 2 * way - work
    mill = cm.indexing_motion(
        "mill",
        cm.rise(machine.pitch_mm, over_deg=machine.mill_angle_deg),
        cm.dwell(360 - machine.mill_angle_deg),
        stops=machine.stops,
    )
    goes = [cm.rise(stroke(machine), over_deg=way), cm.dwell(work)]
    goes += [cm.return_(stroke(machine), over_deg=way), *([cm.dwell(rest)] if rest > 0 else [])]
    return cm.TimingDiagram([mill, cm.motion("die", *goes, start_deg=start)], machine.rate_per_hour)


def assert_strikes(shown: Shown, machine: MillAndDie, built: cm.TimingDiagram) -> None:
    """The line and the hatch say what an independent machine does."""
    limit = machine.wait_mm - machine.margin_mm
    broken = find_violations(built, own_rule(machine, limit))
    touching = find_violations(built, own_rule(machine, machine.wait_mm))
    assert ("it strikes" in shown.line) == bool(touching), shown.line
    assert ("less than the margin" in shown.line) == (bool(broken) and not touching)
    if max((violation.end_deg - violation.start_deg for violation in broken), default=1) > 0.5:
        assert is_red(shown) == bool(broken)
    if found := re.search(r"At ([\d.]+) deg.* ([\d.]+) mm deep", shown.line):
        angle, depth = map(float, found.groups())
        assert built.position_mm("die", angle) == pytest.approx(depth, abs=0.1)
        assert 0 < built.position_mm("mill", angle) < machine.pitch_mm


NO_ROOM = "more than a turn"


@pytest.mark.parametrize("number", ["01.1", "03.2"])
def test_a_way_after_the_mill(number: str) -> None:
    for machine, angle, shown in wrong(number):
        right, quiet = (
            (die(machine), 0) if number == "01.1" else (later(machine), machine.mill_angle_deg / 10)
        )
        assert (NO_ROOM in shown.line) == (2 * angle + machine.work_deg > 360 + 1e-6)
        if NO_ROOM not in shown.line:
            assert ("is not up yet" in shown.line) == (angle > right)
            assert ("and waits" in shown.line) == (angle < right)
            built = own_machine(machine, machine.mill_angle_deg - quiet, angle)
            assert_strikes(shown, machine, built)


def test_work_in_a_turn() -> None:
    for machine, time_s, shown in wrong("01.2"):
        work = 360 * time_s / turn(machine)
        assert (NO_ROOM in shown.line) == (work > machine.mill_angle_deg + machine.work_deg + 1e-6)
        if found := re.search(r"about (\d+) of", shown.line):
            assert work == pytest.approx(float(found.group(1)), abs=5.001)
        else:
            assert work < 10
        if NO_ROOM not in shown.line:
            assert ("not up yet" in shown.line) == (work > machine.work_deg)
            assert ("cut short" in shown.line) == (work < machine.work_deg)
            built = own_machine(machine, machine.mill_angle_deg, die(machine), work)
            assert_strikes(shown, machine, built)


def test_a_widened_way() -> None:
    said = set()
    for machine, angle, shown in wrong("03.4"):
        has_room = 2 * angle + machine.work_deg < 360
        assert (NO_ROOM in shown.line) != has_room
        if has_room:
            down = machine.mill_angle_deg + die(machine)
            assert_strikes(shown, machine, own_machine(machine, down - angle, angle))
            assert ("keeps clear" in shown.line) == (angle < widest(machine))
        said.add(re.sub(NUMBER, "", shown.line)[:12])
    assert len(said) >= 3


def test_a_rest_in_a_turn() -> None:
    for machine, time_ms, shown in wrong("04.3"):
        rest = 360 * time_ms / 1000 / turn(machine)
        too_long = rest + 2 * widest(machine) + machine.work_deg > 360
        assert ("too late" in shown.line) == too_long
        assert ("too soon" in shown.line) != too_long


SHAPES: dict[str, Callable[[Array], Any]] = {
    "cycloidal": lambda x: np.sin(2 * np.pi * x),
    "constant": lambda x: np.where(x < 0.5, 1.0, -1.0),
    "modified sine": lambda x: np.where(
        np.minimum(x, 1 - x) < 1 / 8,
        np.sin(4 * np.pi * np.minimum(x, 1 - x)) * np.sign(0.5 - x),
        np.cos((x - 1 / 8) * 4 * np.pi / 3),
    ),
}
"""Accelerations over the time with a peak of 1, written out."""


def pushed_mm(peak: float, time_s: float, shape: str) -> float:
    """Return how far a push brings the die, by adding it up twice."""
    count = 4000
    x = (np.arange(count) + 0.5) / count
    velocity = np.cumsum(SHAPES[shape](x))
    return float(peak * time_s**2 * np.sum(velocity) / count**2 * 1000)


def widest_by(machine: MillAndDie, shape: str) -> float:
    """Return the widest angle with a law, from its acceleration."""
    x = (np.arange(20000) + 0.5) / 20000
    way = np.cumsum(np.cumsum(SHAPES[shape](x)))
    at = np.interp((machine.wait_mm - machine.margin_mm) / stroke(machine), way / way[-1], x)
    return float(later(machine) / (1 - at))


def cycloid_peak(machine: MillAndDie, angle: float, way_mm: float) -> float:
    return 2 * math.pi * way_mm / 1000 / time(machine, angle) ** 2


def least(machine: MillAndDie) -> float:
    """Return the least peak of 06.3, by adding up a push of 1 m/s²."""
    return (stroke(machine) - machine.wait_mm + machine.margin_mm) / risen_mm(machine, 1.0)


def risen_mm(machine: MillAndDie, peak: float) -> float:
    """Return how far an even push and brake have brought the die up when the mill gets going."""
    whole, count = (360 - machine.work_deg) / 2, 40000
    at = (np.arange(count) + 0.5) / count * later(machine)
    push = np.where(at < whole / 2, peak, -peak)
    step = time(machine, later(machine)) / count
    return float(np.sum(np.cumsum(push)) * step**2 * 1000)


PUSHES: dict[str, Callable[[MillAndDie, float], tuple[float, float, str]]] = {
    "01.3": lambda m, a: (
        a * cycloid_peak(m, m.mill_angle_deg, m.pitch_mm),
        time(m, die(m)),
        "cycloidal",
    ),
    "02.1": lambda m, a: (a, time(m, die(m)), "cycloidal"),
    "02.3": lambda m, a: (a / m.die_mass_kg, time(m, die(m)), "cycloidal"),
    "02.4": lambda m, a: (
        a * cycloid_peak(m, die(m), stroke(m)),
        time(m, die(m)) * m.rate_per_hour / (m.rate_per_hour + 400),
        "cycloidal",
    ),
    "03.5": lambda m, a: (
        cycloid_peak(m, die(m), stroke(m)) / a,
        time(m, widest(m)),
        "cycloidal",
    ),
    "05.1": lambda m, a: (a, time(m, die(m)), "constant"),
    "05.5": lambda m, a: (a, time(m, widest_by(m, "modified sine")), "modified sine"),
    "06.4": lambda m, a: (a * least(m), time(m, widest(m)), "cycloidal"),
}
"""Of an answer the peak that it leads to, the time of the move, and its law, by hand."""

WHERE = {
    "hardly leaves": (-1, 0.02),
    "above the mill": (0.02, None),
    "in the pocket": (None, 1),
    "in the gap": (1, None),
    "through the floor": (None, math.inf),
}


@pytest.mark.parametrize("number", PUSHES)
def test_a_push_brings_the_die_where_the_line_says(number: str) -> None:
    said = set()
    for machine, answer, shown in wrong(number):
        way, whole = pushed_mm(*PUSHES[number](machine, answer)), stroke(machine)
        (words,) = [words for words in WHERE if words in shown.line]
        bounds = {
            "hardly leaves": (-math.inf, 0.02 * whole),
            "above the mill": (0.02 * whole, machine.wait_mm),
            "in the pocket": (machine.wait_mm, whole),
            "in the gap": (whole, whole + machine.gap_mm),
            "through the floor": (whole + machine.gap_mm, math.inf),
        }[words]
        slack = 2e-3 * way
        assert bounds[0] - slack <= way <= bounds[1] + slack, (shown.line, way)
        assert ("more than twice" in shown.line) == (way > 2 * whole)
        assert_curve_ends_at(shown, machine, way)
        said.add(words)
    assert len(said) >= 3


def assert_curve_ends_at(shown: Shown, machine: MillAndDie, way_mm: float) -> None:
    points = curve(shown)
    rim = next(float(text.attrib["y"]) - 4 for text in texts(shown) if "rim" in str(text.text))
    px_per_mm = (rim - points[0, 1]) / machine.wait_mm
    drawn = (points[-1, 1] - points[0, 1]) / px_per_mm
    assert drawn == pytest.approx(min(way_mm, 1.5 * stroke(machine)), abs=0.5)


def test_a_push_up() -> None:
    for machine, answer, shown in wrong("06.3"):
        depth = stroke(machine) - risen_mm(machine, answer)
        limit = machine.wait_mm - machine.margin_mm
        assert ("it strikes" in shown.line) == (depth > machine.wait_mm)
        assert ("less than the margin" in shown.line) == (limit < depth <= machine.wait_mm)
        assert ("farther out" in shown.line) == (depth < limit)
        if found := re.search(r"([\d.]+) mm below", shown.line):
            assert depth - machine.wait_mm == pytest.approx(float(found.group(1)), abs=0.06)


def test_a_place_of_the_die() -> None:
    for machine, x, shown in wrong("03.3"):
        depth = stroke(machine) * law(x)
        room = machine.wait_mm - depth
        assert ("it strikes" in shown.line) == (room < 0) == is_red(shown)
        assert ("less than the margin" in shown.line) == (0 <= room < machine.margin_mm)
        assert ("might be deeper" in shown.line) == (room > machine.margin_mm)
        if room < 0:
            assert numbers(shown.line)[0] == pytest.approx(-room, abs=0.06)


def test_a_depth_of_the_die() -> None:
    for machine, depth, shown in wrong("04.1"):
        floor, down = machine.wait_mm + machine.pocket_mm, machine.mill_angle_deg + die(machine)
        assert ("through the floor" in shown.line) == (depth > floor) == is_red(shown)
        assert ("never is" in shown.line) == (stroke(machine) <= depth <= floor)
        if depth >= stroke(machine):
            continue
        way = 30 / (1 - place(depth / stroke(machine)))
        assert ("too late" in shown.line) == (way < widest(machine))
        assert ("too early" in shown.line) == (way > widest(machine))
        if "too late" in shown.line:
            assert numbers(shown.line)[0] == pytest.approx(down - way, abs=0.51)
        elif "last turn" in shown.line:
            assert 2 * way + machine.work_deg >= 360
        else:
            built = own_machine(machine, down - way, way)
            limit = machine.wait_mm - machine.margin_mm
            assert find_violations(built, own_rule(machine, limit))
            touches = bool(find_violations(built, own_rule(machine, machine.wait_mm)))
            assert touches == ("it strikes" in shown.line)


def test_a_place_of_the_mill() -> None:
    for machine, off, shown in wrong("03.1"):
        still, asked = numbers(shown.line)
        assert asked == pytest.approx(machine.mill_angle_deg / 10)
        share = place(off / machine.pitch_mm)
        assert machine.mill_angle_deg * share == pytest.approx(still, abs=0.051)
        assert ("already" in shown.line) == (off > machine.pitch_mm * law(0.1))


def widths(shown: Shown) -> tuple[float, float]:
    root = ElementTree.fromstring(shown.svg)  # noqa: S314 - our own
    one, other = (float(bar.attrib["width"]) for bar in root.findall(f"{SVG}rect")[1:])
    return one, other


def assert_bars(shown: Shown, ratio: float) -> None:
    """The bars have a ratio, or the longer one is cut."""
    asked, made = widths(shown)
    if 1 / 12 < ratio < 12:
        assert made / asked == pytest.approx(ratio, rel=0.01)
    else:
        assert 'stroke="#fff"' in shown.svg


def test_bars() -> None:
    trapezoid = 8 * math.pi / (2 + math.pi)
    for machine, angle, shown in wrong("05.3"):
        ratio = 2 * math.pi / trapezoid * (die(machine) / angle) ** 2
        assert ("harder" in shown.line) == (ratio > 1)
        assert ("pushed less" in shown.line) == (ratio < 1)
        assert_bars(shown, ratio)
    for machine, factor, shown in wrong("04.2"):
        seconds = math.sqrt(factor) * turn(machine)
        assert ("longer" in shown.line) == (seconds > 9)
        assert ("sooner" in shown.line) == (seconds < 9)
        assert numbers(shown.line)[0] == pytest.approx(seconds, rel=0.34)
        assert_bars(shown, seconds / 9)
    for machine, force, shown in wrong("06.5"):
        made = force / (machine.die_mass_kg + 1e-4 * (2 * math.pi / 0.01) ** 2)
        assert (" harder than" in shown.line) == (made > 0.6)
        assert (" not as hard" in shown.line) == (made < 0.6)
        assert_bars(shown, made / 0.6)


FITS = "just|closes|as long as the question|with the angle of the question"


@each_shown
def test_the_right_answer_fits_however_it_is_rounded(exercise: NumberExercise) -> None:
    for machine in MACHINES:
        right = exercise.solution(machine)
        for answer in (right, float(f"{right:.3g}"), float(f"{right:.2g}")):
            if exercise.judge(answer, machine).state == "right":
                shown = exercise.show(answer, machine)
                assert shown is not None
                assert re.search(FITS, shown.line)


@each_shown
def test_a_wrong_answer_never_fits(exercise: NumberExercise) -> None:
    for _, answer, shown in wrong(exercise.number):
        assert not re.search(FITS, shown.line), answer


ODD: list[Any] = [
    None, ..., "", "4.15", "a" * 1000, b"1", [], [1.0], {}, np.zeros(3), object(), True, 1j,
    math.nan, math.inf, -math.inf, 0, 0.0, -0.0, -5e-324, 5e-324, 1e308, -1, 10**400, 1e-30,
]  # fmt: skip


@each_shown
@pytest.mark.parametrize("answer", ODD, ids=lambda answer: repr(answer)[:20])
def test_an_odd_answer_shows_nothing_and_breaks_nothing(
    exercise: NumberExercise, answer: Any
) -> None:
    shown = exercise.show(answer, EXAMPLE)
    number = isinstance(answer, int | float) and 0.1 < answer < 1e5 and answer is not True
    assert shown is None or number


@each_shown
def test_any_number_breaks_nothing(exercise: NumberExercise) -> None:
    assert exercise.shows is not None
    for machine in MACHINES[:4]:
        right = exercise.solution(machine)
        for times in np.geomspace(1e-4, 1e4, 161):
            shown = exercise.show(float(right * times), machine)
            assert shown is None or 1e-3 < times < 1e3
            if shown:  # it is not an error that keeps a picture away
                exercise.shows(machine, float(right * times))
                assert_texts_keep_apart(shown)


def test_exercises_of_other_kinds_show_nothing() -> None:
    others = [exercise for exercise in EXERCISES.values() if exercise not in SHOWN]
    assert {type(exercise).__name__ for exercise in others} >= {"ChoiceExercise"}
    assert all(exercise.show(exercise.solution(EXAMPLE), EXAMPLE) is None for exercise in others)


def write(text: str) -> Callable[[MillAndDie, float], Shown]:
    def show(machine: MillAndDie, answer: float) -> Shown:  # noqa: ARG001
        drawn = Frame()
        drawn.text(10, 20, text)
        return drawn.show("A line.")

    return show


def test_a_picture_that_holds_the_right_number_is_kept_back() -> None:
    question = "Is it 7 mm?"
    assert show_answer(write("55.1 deg"), EXAMPLE, 110, 55, question) is None
    assert show_answer(write("56 deg"), EXAMPLE, 110, 55, question) is not None
    assert show_answer(write("7 mm"), EXAMPLE, 110, 7, question) is not None
    assert show_answer(write("55 deg"), EXAMPLE, 55, 55, question) is not None


def test_texts_are_escaped() -> None:
    shown = write('<script>"&')(EXAMPLE, 1)
    assert [text.text for text in texts(shown)] == ['<script>"&']


def test_the_colours_are_those_of_all_pictures() -> None:
    assert (frame.MILL, frame.DIE) == COLOURS[:2]


@pytest.fixture
def _own_session(tmp_path: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv(GRADING, raising=False)
    monkeypatch.setattr(session, "_SESSION", session.Session(Store(lambda: tmp_path)))


@pytest.mark.usefixtures("_own_session")
def test_a_check_says_and_shows_it_after_the_reason() -> None:
    said = cm.check("01.1", 140)
    assert said.shown is not None
    assert said.text == f"01.1: Not yet. {said.verdict.text} {said.shown.line}"
    html = said.html
    assert html.index(said.verdict.text[:20]) < html.index("data:image/svg+xml;base64,")
    assert f'alt="{said.shown.line}"' in html
    assert "max-width: 100%" in html
    assert cm.check("01.1", 70).is_right
    assert "closes" in cm.check("01.1", 70).text


@pytest.mark.usefixtures("_own_session")
@pytest.mark.parametrize("answer", [None, "x", -3, 1e9])
def test_a_check_without_a_picture_is_as_it_was(answer: Any) -> None:
    said = cm.check("01.1", answer)
    assert said.shown is None
    assert "<img" not in said.html


@pytest.mark.usefixtures("_own_session")
def test_a_drawing_that_fails_leaves_the_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> Any:
        raise ZeroDivisionError

    monkeypatch.setattr("cammotion.teaching.exercise.show_answer", fail)
    assert cm.check("01.1", 140).text.startswith("01.1: Not yet.")


@pytest.mark.usefixtures("_own_session")
def test_a_grader_sees_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any) -> Any:
        raise AssertionError("it was drawn")

    monkeypatch.setattr(Exercise, "show", fail)
    monkeypatch.setattr(NumberExercise, "show", fail)
    monkeypatch.setenv(GRADING, "1")
    right = EXERCISES["01.1"].solution(session._SESSION.machine)
    assert cm.check("01.1", right).shown is None
