"""Open exercises: what a design keeps, how far it is from the bound, and who is the best."""

import math
from pathlib import Path
from typing import Any

import pytest
from school import put, show, table_of

import cammotion as cm
from cammotion.teaching import session
from cammotion.teaching.classroom.collect import read_class
from cammotion.teaching.design_exercise import DesignExercise, balanced, bound_of, largest_jerk
from cammotion.teaching.example import EXAMPLE
from cammotion.teaching.exercise import Exercise
from cammotion.teaching.lessons import EXERCISES
from cammotion.teaching.places import GRADING, Place
from cammotion.teaching.reasons import short_name
from cammotion.teaching.session import Session
from cammotion.teaching.store import Store
from cammotion.teaching.variants import machine_for

OPEN, CONTEST = (EXERCISES[number] for number in ("12.3", "12.4"))
BOUND = 0.6358  # m/s2 of the example, its die within 50 mm, proved by least_peak to a hundredth
LAWS = ("modified trapezoid", "cycloidal")


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Session:
    """Keep what is done in a folder of this test's own."""
    monkeypatch.delenv(GRADING, raising=False)
    own = Session(Store(lambda: Place(tmp_path)))
    monkeypatch.setattr(session, "_SESSION", own)
    return own


def test_the_bound_is_that_of_the_example_within_a_tenth() -> None:
    assert 0.9 * BOUND < bound_of(EXAMPLE) < BOUND + 0.006


def test_a_right_design_is_told_how_far_it_is() -> None:
    said = OPEN.judge(balanced(EXAMPLE), EXAMPLE).text
    assert said.startswith("All requirements are met. It reaches 0.9433 m/s².")
    assert "No motions of these parts can have less than 0.59" in said
    above = 100 * (0.9433 / bound_of(EXAMPLE) - 1)
    assert f"at most {math.ceil(above)} % above the best there could be" in said


def test_a_design_may_be_a_machine() -> None:
    design = balanced(EXAMPLE)
    machine = cm.Machine("mine", design, [EXAMPLE.rule])
    assert OPEN.judge(machine, EXAMPLE) == OPEN.judge(design, EXAMPLE)


def test_a_design_may_be_what_a_solver_has_found() -> None:
    work = [(EXAMPLE.down_deg, EXAMPLE.down_deg + EXAMPLE.work_deg)]
    best = cm.optimise(EXAMPLE.diagram, EXAMPLE.rule, still={"mill": work, "die": work})
    assert OPEN.judge(best, EXAMPLE).state == "right"
    wide = cm.widest_move(EXAMPLE.diagram, "die", EXAMPLE.rule)
    assert OPEN.judge(wide, EXAMPLE) == OPEN.judge(wide.diagram, EXAMPLE)
    assert OPEN.judge(EXAMPLE, EXAMPLE) == OPEN.judge(EXAMPLE.diagram, EXAMPLE)


@pytest.mark.parametrize("turns", [-1, 1, 30])
def test_a_mill_may_begin_with_any_of_its_stops(turns: int) -> None:
    """Told over the end of the turn, an index stands at the stop before: they are alike."""
    design = balanced(EXAMPLE)
    later = design.with_motion(design["mill"].shifted(360 * turns))
    assert OPEN.judge(later, EXAMPLE) == OPEN.judge(design, EXAMPLE)
    askew = design.with_motion(design["mill"].shifted(360 * turns + 60))
    assert "have to stand where they stood. The mill does not." in OPEN.judge(askew, EXAMPLE).text


def test_what_is_not_met_is_told_all_at_once_with_what_is_measured() -> None:
    die = cm.with_angle(EXAMPLE.die, 127).shifted(-3)
    design = EXAMPLE.diagram.at_rate(1000).with_motion(die)
    said = OPEN.judge(design, EXAMPLE).text
    assert "The machine rate is not that of the question. It is 1000 pieces per hour." in said
    assert "have to stand where they stood. The die does not." in said
    assert "The clearance rule is broken. The die is" in said
    assert said.endswith("Of the 8 requirements 5 are met.")


@pytest.mark.parametrize("exercise", [OPEN, CONTEST])
def test_every_fault_of_a_design_is_counted_under_a_name_that_is_known(exercise: Exercise) -> None:
    alone = cm.TimingDiagram((EXAMPLE.mill,), EXAMPLE.rate_per_hour)
    slow = EXAMPLE.diagram.at_rate(1000)
    reasons = [exercise.judge(design, EXAMPLE).reason for design in (alone, slow)]
    assert len({*reasons}) == 2
    assert {*reasons} <= {*map(short_name, exercise.faults)}


@pytest.mark.parametrize("law", ["modified trapezoid", "3-4-5 polynomial"])
def test_the_law_that_is_asked_for_is_looked_at(law: str) -> None:
    other = balanced(EXAMPLE, law)
    said = OPEN.judge(other, EXAMPLE).text
    assert said.startswith("Each move has to have the law 'cycloidal'. The rise of the mill has ")
    own = cm.MotionLaw("mine", cm.LAWS["cycloidal"].s)
    mine = balanced(EXAMPLE)
    for name in mine.names:
        mine = mine.with_motion(mine[name].with_law(own))
    assert OPEN.judge(mine, EXAMPLE).state == "right"


def test_a_mill_with_other_stops_is_told_how_many_it_has() -> None:
    mill = cm.indexing_motion(
        "mill", *(cm.rise(100, over_deg=150), cm.dwell(210)), stops=EXAMPLE.stops - 1
    )
    said = OPEN.judge(EXAMPLE.diagram.with_motion(mill), EXAMPLE).text
    assert f"It goes 100 mm and has {EXAMPLE.stops - 1} stops." in said


def test_a_learner_gets_the_diagram_and_the_rule_of_the_question(own: Session) -> None:
    """Asked by name, with fresh numbers and again: a design for them is right."""
    cm.variant("Anna")
    for asked in (cm.ask, cm.again, cm.ask):
        machine = asked("12.3").machine
        work = [(machine.down_deg, machine.down_deg + machine.work_deg)]
        still = {"mill": work, "die": work}
        found = cm.optimise(machine.diagram, machine.rule, still=still)
        assert cm.check("12.3", found.design).is_right
    assert own.machine == machine_for("Anna")


def test_the_contest_has_a_limit_to_the_jerk() -> None:
    sharp = balanced(EXAMPLE).with_motion(
        balanced(EXAMPLE)["die"].with_law(cm.scca(0.01, 0.98, 0.01))
    )
    assert "The largest jerk is above what is asked for." in CONTEST.judge(sharp, EXAMPLE).text
    right = CONTEST.solution(EXAMPLE)
    assert largest_jerk(right) < largest_jerk(sharp) / 3


def test_what_has_no_bound_is_told_by_its_sign() -> None:
    struck = EXAMPLE.diagram.with_motion(EXAMPLE.die.with_law(cm.CONSTANT_VELOCITY))
    said = CONTEST.judge(struck, EXAMPLE).text
    assert (
        "It is ∞ m/s², that of the die. The largest jerk is above what is asked for. It is ∞ m/s³, "
        "that of the die." in said
    )


def test_who_has_the_largest_peak_is_told() -> None:
    """With its widest move the die has less than the mill, whose peak is as before."""
    wide = cm.widest_move(EXAMPLE.diagram, "die", EXAMPLE.rule).diagram
    mill = 2 * math.pi * 0.1 / (150 / 360 * 1.8) ** 2
    assert f"It is {mill:.4g} m/s², that of the mill." in OPEN.judge(wide, EXAMPLE).text
    assert "m/s², that of the die." in OPEN.judge(EXAMPLE.diagram, EXAMPLE).text


def test_where_a_part_does_not_stand_is_told() -> None:
    design = balanced(EXAMPLE)
    late = design.with_motion(design["die"].shifted(2.5))
    said = OPEN.judge(late, EXAMPLE).text
    assert "The die does not. The die moves from 205 to 207.5 degrees." in said
    both = late.with_motion(design["mill"].shifted(150))
    assert "The mill and the die do not. The mill moves from " in OPEN.judge(both, EXAMPLE).text
    low = cm.motion(
        "die",
        cm.rise(40, over_deg=100),
        cm.dwell(100),
        cm.return_(40, over_deg=100),
        cm.dwell(60),
        start_deg=105,
    )
    said = OPEN.judge(design.with_motion(low), EXAMPLE).text
    assert "The die does not. The die stands at 40 mm." in said


@pytest.mark.parametrize("exercise", [OPEN, CONTEST])
def test_a_table_as_text_is_told_what_makes_a_machine_of_it(exercise: Exercise) -> None:
    table = """
        motion;from in deg;to in deg;from in mm;to in mm;law;machine rate in pieces/h
        die;150;205;0;50;cycloidal;2000
    """
    said = exercise.judge(table, EXAMPLE).text
    assert "cm.machine_from_text makes a machine of it" in said
    assert "machine_from_text" not in exercise.judge(3, EXAMPLE).text


@pytest.mark.parametrize("answer", [3, "a design", EXAMPLE.die, [EXAMPLE.diagram], object()])
def test_what_is_no_design_is_told_so(answer: Any) -> None:
    verdict = OPEN.judge(answer, EXAMPLE)
    assert verdict.state == "wrong"
    assert "This is no design" in verdict.text


def test_a_score_is_kept_for_right_designs_alone_and_the_best_one_stays(own: Session) -> None:
    own.take(machine_for("Anna"))
    machine = own.machine
    assert isinstance(CONTEST, DesignExercise)
    better, good = (balanced(machine, law) for law in (LAWS[0], "Freudenstein 1-3"))
    assert not cm.check("12.4", machine.diagram).is_right
    assert "best" not in own.record("12.4")
    scores = [CONTEST.score(design, machine) for design in (good, better)]
    assert scores[0] is not None
    assert scores[1] is not None
    assert scores[0] > scores[1] > 1
    for design, best in ((good, scores[0]), (better, scores[1]), (good, scores[1])):
        assert cm.check("12.4", design).is_right
        assert own.record("12.4")["best"] == best
    assert CONTEST.score(machine.diagram, machine) is None
    own.take(machine_for("Ben"))
    cm.check("12.4", own.machine.diagram)
    assert own.record("12.4")["best"] == scores[1]
    assert cm.check("12.4", balanced(own.machine, "Freudenstein 1-3")).is_right
    assert own.record("12.4")["best"] == scores[1]  # a multiple of the bound, for any name


def record(best: object) -> dict[str, Any]:
    return {"exercises": {"12.4": {"state": "right", "tries": 1, "best": best}}}


def test_the_best_design_of_the_class_is_ranked(tmp_path: Path) -> None:
    kept = {"Anna": 1.18, "Ben": 1.12, "Eva": "1.0", "Tom": 0.5, "Ida": None, "Max": True}
    for name, best in kept.items():
        put(tmp_path, f"{name}/progress.json", record(best))
    rows = table_of(show(read_class(tmp_path)), "The largest peak of each design")
    assert rows[1:] == [
        ["1", "Ben", "12.4", "1.120", "12.0 %"],
        ["2", "Anna", "12.4", "1.180", "18.0 %"],
    ]


def test_without_a_design_there_is_no_table(tmp_path: Path) -> None:
    put(tmp_path, "Anna/progress.json", record(None))
    assert "The best design of the class" not in show(read_class(tmp_path)).get_text()
