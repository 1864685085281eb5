"""Rules of every kind in the table of a machine and in its report: read, written, checked, told."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import examples
from report_checker import check

import cammotion as cm
from cammotion.exchange.rule_text import rule_as_text, rule_from_text
from cammotion.rules.rule import Rule

CHECKER = Path(__file__).with_name("report_checker.py")
HEADING = "motion; from in deg; to in deg; from in mm; to in mm; law; machine rate in pieces/h; "
TABLE = f"""
{HEADING}still; rule
pusher; 40; 130; 20; 60; cycloidal; 2000; 130 to 180; the pusher stays at least 2.5 mm above flap
; 180; 270; 60; 20; cycloidal; ; ; apart: pusher - flap at least 1 mm
flap; 60; 150; 0; 40; cycloidal; ; 150 to 180; flap may be moving only while the gate is standing
; 180; 280; 40; 0; cycloidal; ; ; gate beyond 5 only while pusher standing
gate; 290; 310; 0; 10; modified sine; ; 310 to 350; pusher moving only while gate within 5 mm
; 350; 400; 10; 0; modified sine; ; ;
"""
RULES: list[Rule] = [
    cm.DistanceRule("pusher", above="flap", at_least_mm=2.5),
    cm.DistanceRule("pusher", above="flap", at_least_mm=1, name="apart"),
    cm.ClearanceRule(cm.moving("flap"), only_while=cm.standing("gate")),
    cm.ClearanceRule(cm.beyond("gate", 5), only_while=cm.standing("pusher")),
    cm.ClearanceRule(cm.moving("pusher"), only_while=cm.within("gate", 5)),
]


@pytest.fixture(scope="module")
def gate() -> cm.Machine:
    return cm.machine_from_text(TABLE, "gate")


def test_every_kind_is_read(gate: cm.Machine) -> None:
    assert [*gate.rules] == RULES
    assert gate.violations == cm.find_violations(gate.diagram, RULES) == ()


@pytest.mark.parametrize("ending", [".csv", ".xlsx"])
def test_every_kind_comes_back(gate: cm.Machine, tmp_path: Path, ending: str) -> None:
    assert cm.read_machine(cm.write_machine(gate, tmp_path / f"gate{ending}")) == gate


@pytest.mark.parametrize("rule", [*RULES[1:2], *RULES[3:4]])
def test_a_rule_may_have_a_colon_in_its_name(gate: cm.Machine, tmp_path: Path, rule: Rule) -> None:
    machine = replace(gate, rules=[replace(rule, name="station 3: clear")])  # type: ignore[type-var]
    assert cm.read_machine(cm.write_machine(machine, tmp_path / "gate.csv")) == machine


def test_a_motion_may_be_called_by_a_short_form() -> None:
    rule = cm.DistanceRule("slide", above="clamp r.", at_least_mm=5)
    assert rule_from_text(rule_as_text(rule), ["slide", "clamp r."]) == rule
    assert rule_from_text(f"{rule_as_text(rule)}.", ["slide", "clamp r."]) == rule


limits = st.floats(-1e6, 1e6)
ways = st.sampled_from([lambda name, _: cm.moving(name), lambda name, _: cm.standing(name)])
halves = st.tuples(st.one_of(ways, st.sampled_from([cm.beyond, cm.within])), limits)


@examples(25)
@given(when=halves, only=halves, name=st.sampled_from(["", "clear", "a b"]))
def test_every_clearance_rule_is_read_back(
    when: tuple[object, float], only: tuple[object, float], name: str
) -> None:
    made = [
        make(who, mm)  # type: ignore[operator]
        for (make, mm), who in zip((when, only), ("the upper die", "mill 2"), strict=True)
    ]
    rule = cm.ClearanceRule(made[0], made[1], name=name)
    assert rule_from_text(rule_as_text(rule), ["the upper die", "mill 2"]) == rule


@examples(15)
@given(mm=limits, name=st.sampled_from(["", "apart"]))
def test_every_distance_is_read_back(mm: float, name: str) -> None:
    names = ["the upper die", "flap above", "at least"]
    for part in names:
        for other in names:
            if part != other:
                rule = cm.DistanceRule(part, other, mm, name)
                assert rule_from_text(rule_as_text(rule), names) == rule


@pytest.mark.parametrize(
    ("row", "spoiled", "words"),
    [
        ("2.5 mm above flap", "2.5 mm above wheel", "Line 2 of it, 'rule': There is no"),
        ("2.5 mm above flap", "much mm above flap", "Line 2 of it, 'rule': The rule is"),
        ("2.5 mm above flap", "2.5 mm above pusher", "Line 2 of it, 'rule': The distance rule"),
        ("gate is standing", "gate is resting", "Line 4 of it, 'rule': The rule has the half"),
        ("pusher - flap at least 1 mm", "flap - pusher at least 0 mm", "forbids every place"),
        ("at least 1 mm", "at least 2.5", "stands in line 2 of it already"),
        ("pusher moving only while gate within 5 mm", "flap moving only while gate is moving",
         "forbids that the flap is ever moving"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told_with_its_line(row: str, spoiled: str, words: str) -> None:
    assert row in TABLE
    with pytest.raises(cm.InputError) as refused:
        cm.machine_from_text(TABLE.replace(row, spoiled), "it")
    assert words.casefold() in str(refused.value).casefold()


def test_a_turret_has_no_distance() -> None:
    mill = "mill; 0; 150; 0; 100; cycloidal; ; ; mill - flap at least 1 mm"
    table = TABLE.replace(HEADING, f"{HEADING}stops; ").replace("cycloidal; ; ", "cycloidal; ; ; ")
    table = table.replace("cycloidal; 2000; ", "cycloidal; 2000; ; ")
    table = table.replace("modified sine; ; ", "modified sine; ; ; ")
    assert [*cm.machine_from_text(table).rules] == RULES
    with pytest.raises(cm.InputError, match=r"Line 8 of it, 'rule': The motion 'mill' moves on"):
        cm.machine_from_text(table + mill.replace("; ; ;", "; ; 24; ;"), "it")
    with pytest.raises(cm.InputError, match="moves on from stop to stop"):
        cm.Machine("m", cm.EXAMPLE.diagram, [cm.DistanceRule("mill", "die", 1)])


# The report


def broken(gate: cm.Machine) -> cm.Machine:
    """Return the machine with the gate open too long, and the flap too high."""
    late = gate.diagram.with_motion(gate.diagram["gate"].shifted(40))
    return replace(gate, diagram=late.with_motion(gate.diagram["flap"].shifted(-25)), still={})


MEANT = (
    "The clearance is how much farther apart they are than they have to be.",
    "The clearance is how far the one with a limit is from passing it while the other one moves, "
    "or stands, when it must not.",
)
"""What the clearance of a rule is that knows a distance, or what moves."""


def test_the_report_tells_every_kind_and_the_checker_agrees(
    gate: cm.Machine, tmp_path: Path
) -> None:
    for machine in (replace(gate, still={}), broken(gate)):
        report = cm.write_report(machine, tmp_path)
        book = report.folder / "tables.xlsx"
        ran = subprocess.run(
            [sys.executable, "-I", str(CHECKER), str(book)], capture_output=True, text=True
        )
        assert ran.stdout == "The report agrees with its tables.\n", ran.stdout + ran.stderr
        assert cm.read_machine(book) == replace(machine, name="tables")
        page = report.page.read_text("utf-8")
        for rule in machine.rules:
            assert str(rule) in page
        for meant in MEANT:
            assert meant in page
        assert report.is_kept == (not machine.violations)
    assert len({violation.rule for violation in machine.violations}) >= 3


def test_the_checker_sees_a_wrong_clearance_of_every_kind(
    gate: cm.Machine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    right = cm.Machine.clearances.func  # type: ignore[attr-defined]
    more = property(
        lambda self: tuple(replace(one, clearance_mm=one.clearance_mm + 1) for one in right(self))
    )
    monkeypatch.setattr(cm.Machine, "clearances", more)
    machine = broken(gate)
    wrong = check(cm.write_report(machine, tmp_path).folder / "tables.xlsx")
    told = {one.split(", ")[1] for one in wrong}
    assert {"'at least above'", "'moving'", "'beyond'"} <= told


def test_what_knows_no_such_rules_says_so(gate: cm.Machine, tmp_path: Path) -> None:
    for solve in (cm.optimise, cm.least_peak):
        with pytest.raises(cm.InputError, match="is one of those that are not covered here"):
            solve(gate.diagram, gate.rules, still=gate.free)
    page = cm.write_report(gate, tmp_path).page.read_text("utf-8")
    assert "No design was sought and no bound: both know rules of beyond and within alone" in page
    assert "Say it by these if you can, like" in page
    assert "ClearanceRule" not in page
