"""The report of a machine: whole or not at all, true by its own tables, quick and small."""

import errno
import html
import math
import re
import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from datetime import date
from pathlib import Path
from typing import Any, NoReturn
from urllib.parse import unquote

import pytest
from bs4 import BeautifulSoup
from cartons import all_dies, packaging_machine
from report_checker import check
from small_workbook import raiser

import cammotion as cm
from cammotion.advice.ranking import Improvements
from cammotion.exchange.xlsx_in import read_sheets
from cammotion.quantities import WrongAnswerError
from cammotion.report import findings, writing
from cammotion.report.__main__ import BROKEN, FAILED, KEPT, main
from cammotion.report.bound import bound_said, design_said
from cammotion.report.live import live_figure
from cammotion.report.numbers import of_peak, of_rate, of_velocity
from cammotion.report.page import rules_of, write_page
from cammotion.report.sheets import sheets_of

DATA = Path(__file__).parent.parent / "notebooks" / "data" / "pad_press.csv"
STILL = {"mill": [(205, 305)], "die": [(205, 305)]}
PRESS = cm.Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule], STILL)
LARGEST_BYTES = 2_000_000
CHECKER = Path(__file__).with_name("report_checker.py")


@pytest.fixture(scope="module")
def pads(tmp_path_factory: pytest.TempPathFactory) -> cm.Report:
    return cm.write_report(cm.read_machine(DATA), tmp_path_factory.mktemp("pads"))


@pytest.fixture(scope="module")
def page(pads: cm.Report) -> BeautifulSoup:
    return BeautifulSoup(pads.page.read_text("utf-8"), "html.parser")


def test_a_program_that_knows_only_the_tables_agrees(pads: cm.Report) -> None:
    ran = subprocess.run(
        [sys.executable, "-I", str(CHECKER), str(pads.folder / "tables.xlsx")],
        capture_output=True,
        text=True,
    )
    assert ran.stdout == "The report agrees with its tables.\n", ran.stdout + ran.stderr
    assert "cammotion" not in CHECKER.read_text("utf-8").split('"""')[2]


def test_what_each_rule_leaves_is_written_beside_it(page: BeautifulSoup) -> None:
    table = next(t for t in page("table") if "What each rule leaves" in t.get_text())
    rows = [row("td") for row in table("tr")]
    left = [row[0].get_text(" ").split()[0] for row in rows if row]
    assert left == ["19", "4", "70", "2", "15", "80", "5"]


def test_a_machine_without_rules_says_so(tmp_path: Path) -> None:
    found = cm.write_report(cm.Machine("press", PRESS.diagram), tmp_path)
    assert "The table has no rules." in found.page.read_text("utf-8")


@pytest.mark.parametrize(
    ("moves", "side", "is_said"),
    [
        (["turret; 12; 0; 60; 0; -30", "; ; 180; 240; -30; -60"], "within 0,3", True),
        (["turret; 12; 150; 210; 0; -30", "; ; 330; 390; -30; -60"], "beyond 0,3", True),
        (["turret; 12; 0; 60; 0; -30", "; ; 60; 240; -30; -60"], "within 0,3", False),
        (["turret; 12; 0; 60; 0; -30"], "within 0,3", False),
        (["turret; 12; 0; 60; 0; -30", "; ; 180; 240; -30; -60"], "standing", False),
    ],
)
def test_a_turret_that_stands_between_two_moves_of_a_turn_is_at_no_stop_there(
    moves: list[str], side: str, *, is_said: bool, tmp_path: Path
) -> None:
    machine = cm.machine_from_text(
        "motion; stops; from in deg; to in deg; from in mm; to in mm; law; "
        "machine rate in pieces/h; rule\n"
        f"arm; ; 60; 100; 0; 20; cycloidal; 2000; arm beyond 5 only while turret {side}\n"
        "; ; 140; 180; 20; 0; cycloidal\n" + "\n".join(f"{move}; cycloidal" for move in moves),
        "twice",
    )
    page = cm.write_report(machine, tmp_path).page.read_text("utf-8")
    start = f"{machine.diagram['turret'].start_deg:g}"
    said = f"A stop of the turret is where a turn of its moves begins, at {start} deg: where it "
    assert (said in page) == is_said


def test_a_bound_is_that_of_the_parts_that_are_free(tmp_path: Path) -> None:
    hard = cm.indexing_motion("mill", cm.rise(100, over_deg=40), cm.dwell(320), stops=24)
    still = {"die": [(205, 305)]}
    machine = cm.Machine("press", PRESS.diagram.with_motion(hard), PRESS.rules, still)
    page = cm.write_report(machine, tmp_path).page.read_text("utf-8")
    text = " ".join(BeautifulSoup(page, "html.parser").get_text(" ").split())
    assert "With all moves of the die balanced the largest peak is 15.71 m/s², today 15.71." in text
    (low, reached, above) = re.findall(
        r"No motions of the die can have a largest peak below ([\d.]+) m/s², so that the design, "
        r"with ([\d.]+), is at most (\d+) % above the best",
        text,
    )[0]
    assert float(low) < float(reached) < 2
    assert int(above) == math.ceil(100 * (float(reached) / float(low) - 1))
    assert "The mill stays as it is: the table does not say where it has to stand." in text


def test_all_parts_that_stay_are_named_and_a_start_is_round() -> None:
    three = [cm.EXAMPLE.die.shifted(9.53674e-06 - 150), *cm.EXAMPLE.diagram.motions[:1]]
    three.append(replace(cm.EXAMPLE.die, name="flap"))
    machine = cm.Machine("odd", cm.TimingDiagram(three, 2000), (), {"die": [(60, 150)]})
    least = cm.LeastPeak(machine.diagram, 5.0, machine.diagram, {"die": 1.0})
    page = write_page(
        findings.Findings(machine, Improvements(machine, ()), (), None, least, ()), date.today(), []
    )
    said = "The flap and the mill stay as they are: the table does not say where they have to stand"
    assert said in page
    for told in of_peak, of_velocity:
        assert told(machine.diagram, "die").startswith("The rise from 0 deg")


def test_where_nothing_mends_a_rule_no_change_mends_any() -> None:
    deep = PRESS.diagram.with_motion(cm.with_angle(cm.EXAMPLE.die, 125))
    rules = [cm.EXAMPLE.rule, cm.ClearanceRule(cm.beyond("die", 18), cm.within("mill", 0.65))]
    machine = cm.Machine("press", deep, rules)
    (note,) = Improvements(machine, ()).notes
    assert note == "2 rules are broken, and no change here mends any."


def test_what_is_said_of_a_rate_at_an_infinite_peak() -> None:
    assert of_rate(1500, math.inf, 12) == "Today's peak is infinite: no rate reaches it."


def test_a_rule_without_a_limit_is_kept_and_one_that_nothing_breaks_never_in_the_way() -> None:
    rules = [
        cm.ClearanceRule(cm.moving("mill"), only_while=cm.standing("flap")),
        cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 60)),
    ]
    flap = cm.motion("flap", cm.rise(5, over_deg=60), cm.return_(5, over_deg=60), cm.dwell(240))
    motions = *PRESS.diagram.motions, flap.shifted(200)
    machine = cm.Machine("press", cm.TimingDiagram(motions, 2000), rules)
    left = cm.reserves(machine.diagram, machine.rules)
    found = findings.Findings(machine, Improvements(machine, ()), left, None, None, ())
    rows = BeautifulSoup(rules_of(found), "html.parser").select("tbody tr")
    assert [row("td")[0].get_text() for row in rows] == ["kept", "never in the way"]


def test_where_there_is_no_design_the_bound_is_not_compared_with_the_machine_of_today() -> None:
    """Its rule is broken, and so "the design is at most -95 % above the best"."""
    odd = cm.Machine("odd", PRESS.diagram, (), {"die": [(205, 305)]})
    least = cm.LeastPeak(odd.diagram, 5.0, odd.diagram, {"die": 1.0})
    found = findings.Findings(odd, cm.improvements(odd), (), None, least, ())
    said = "No motions of the die can have a largest peak below 5.0000 m/s²"
    assert bound_said(found) == (
        f"{said}; there is no design, but motions that keep their rules were found, with 4.1542."
    )
    assert bound_said(replace(found, least=replace(least, design=None))) == f"{said}."
    assert "The mill stays as it is" in write_page(found, date.today(), [])


@pytest.mark.parametrize("way_mm", [10, 40])
def test_a_rule_is_used_up_where_only_rounding_is_left(way_mm: float) -> None:
    """So quick a gate does some hundred-thousandths of a mm in the few of a degree left to it."""
    gate = cm.motion(
        "gate",
        *(cm.rise(way_mm, over_deg=5), cm.dwell(10), cm.return_(way_mm, over_deg=5)),
        cm.dwell(340),
    )
    arm = cm.motion(
        "arm",
        *(cm.rise(50, over_deg=40), cm.dwell(13), cm.return_(50, over_deg=40), cm.dwell(267)),
        start_deg=100,
    )
    diagram = cm.TimingDiagram([gate, arm], rate_per_hour=2000)
    rule = cm.ClearanceRule(cm.beyond("gate", way_mm / 2), cm.within("arm", 0.01))
    machine = cm.Machine("m", diagram, [rule], {"arm": [(10, 10.5)]})
    best = cm.optimise(diagram, rule, still=machine.free)
    found = findings.Findings(
        machine, cm.improvements(machine), cm.reserves(diagram, rule), best, None, ()
    )
    assert "The design uses up 1 of 1 rules" in rules_of(found)


def test_a_design_is_called_the_best_only_where_all_were_searched() -> None:
    best = cm.optimise(PRESS.diagram, PRESS.rules, still=STILL)
    all_of_them = "the best of all starts and angles with these laws, to a thousandth"
    assert all_of_them in design_said(best)
    said = design_said(replace(best, bound=0.5 * best.bound))
    assert said.startswith(
        "The design has 0.9435 m/s², and with these laws none has less than 0.47"
    )
    assert "the time was too short to search all starts and angles through" in said
    assert all_of_them not in said


def test_a_part_that_could_stand_all_the_turn_has_no_bound(tmp_path: Path) -> None:
    """Who says of its work alone that it has to stand there is told what is missing."""
    diagram = cm.TimingDiagram([cm.EXAMPLE.die], 2000)
    machine = cm.Machine("press", diagram, [], {"die": [(205, 305)]})
    page = cm.write_report(machine, tmp_path).page.read_text("utf-8")
    assert "Nothing in the table makes these parts move, so that no bound is above 0" in page
    assert "below 0.0000 m/s²" not in page.partition("The conditions of this bound")[0]


@pytest.mark.parametrize(
    ("die", "arm", "said"),
    [
        ("205 to 305", "0 to 20", "of the die and the arm: the table holds each of them"),
        ("205 to 305", "0 to 20 and 250 to 260", "of the die: the table holds it at one"),
        (
            "205 to 305 and 20 to 90",
            "250 to 260",
            "of the arm: the table holds it at one",
        ),
        ("205 to 305 and 20 to 90", "0 to 20 and 250 to 260", ""),
    ],
)
def test_a_part_that_is_held_at_one_height_is_said_to_be_asked_no_stroke(
    die: str, arm: str, said: str, tmp_path: Path
) -> None:
    """The mill goes on by a pitch in each turn, wherever it has to stand."""
    machine = cm.machine_from_text(
        f"""
motion;stops;from in deg;to in deg;from in mm;to in mm;law;machine rate in pieces/h;still;rule
mill; 24; 0; 150; 0; 100; cycloidal; 2000; 205 to 305; die beyond 19 only while mill within 0.65
die; ; 150; 205; 0; 50; cycloidal; ; {die};
; ; 305; 360; 50; 0; cycloidal; ; ;
arm; ; 100; 200; 0; 9; cycloidal; ; {arm};
; ; 270; 330; 9; 0; cycloidal; ; ;
""",
        "three",
    )
    page = cm.write_report(machine, tmp_path, seconds=1).page.read_text("utf-8")
    assert "No motions of these parts can have a largest peak below" in page
    assert ("The bound asks no stroke of the" in page) == bool(said)
    assert said in page
    assert "one height only. Say of more than one dwell" in page or not said


def test_the_checker_sees_a_wrong_peak(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    report = cm.write_report(PRESS, tmp_path, seconds=1)
    assert check(report.folder / "tables.xlsx") == []
    right = cm.Machine.peaks.func  # type: ignore[attr-defined]
    fewer = property(lambda self: {name: 0.97 * peak for name, peak in right(self).items()})
    monkeypatch.setattr(cm.Machine, "peaks", fewer)
    wrong = check(cm.write_report(replace(PRESS), tmp_path, seconds=1).folder / "tables.xlsx")
    assert len(wrong) == 8
    assert all(one.startswith(("peak of", "table of")) for one in wrong)


def test_the_tables_can_be_read_as_machines(pads: cm.Report) -> None:
    machine = cm.read_machine(pads.folder / "tables.xlsx")
    assert machine == replace(cm.read_machine(DATA), name="tables")
    table = cm.read_cam_table(pads.folder / "cam tables" / "die.csv")
    assert len(table.angle_deg) == 360
    assert (pads.folder / "codesys" / "mill.txt").is_file()


def test_no_part_is_told_to_stay_where_all_have_still_arcs(tmp_path: Path) -> None:
    page = cm.write_report(PRESS, tmp_path, seconds=1).page.read_text("utf-8")
    assert "stays as it is" not in page


def test_the_page_needs_nothing_else(pads: cm.Report, page: BeautifulSoup) -> None:
    text = pads.page.read_text("utf-8")
    outside = [tag["src"] for tag in page.find_all(True) if tag.get("src")]
    assert outside
    assert all(str(one).startswith("data:") for one in outside)
    assert not re.search(r"https?://(?!www\.w3\.org)", text.split("<iframe")[0])
    assert all(image["alt"] for image in page("img"))
    assert sum(file.stat().st_size for file in pads.folder.rglob("*")) < LARGEST_BYTES


def test_each_file_is_linked_and_said_to_be_of_the_design(
    pads: cm.Report, page: BeautifulSoup
) -> None:
    linked = [pads.folder / unquote(str(link["href"])) for link in page("a")]
    assert {*linked, pads.page} == {file for file in pads.folder.rglob("*") if file.is_file()}
    book, *tables = (item.get_text() for item in page.select("li:has(a)"))
    assert "of today's machine and of the design: " in book
    assert all("of the design, not of today's machine: " in said for said in tables)


def test_each_cell_says_what_it_is_where_a_row_is_a_block(page: BeautifulSoup) -> None:
    for table in page("table"):
        _, *heads = [head.get_text() for head in table.select("thead th")]
        for row in table.select("tbody tr"):
            assert [cell["data-head"] for cell in row("td")] == heads


def test_the_page_speaks_to_a_shop(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of Python it says nothing, of a turret only where there is one, and a reason once."""
    flap = cm.motion("flap", cm.return_(20, over_deg=180), cm.rise(20, over_deg=180))
    diagram = cm.TimingDiagram([*cm.EXAMPLE.diagram.motions, flap], 2000)
    rules = [cm.EXAMPLE.rule, cm.DistanceRule("die", above="flap", at_least_mm=1)]
    monkeypatch.setattr(findings, "improvements", lambda _: ())  # which take long
    found = findings.find_all(cm.Machine("press", diagram, rules, STILL), 1, lambda *_: None)
    (note,) = found.notes
    assert "none like 'the die stays at least 1 mm above the flap'" in note
    of_turret, of_flap = BeautifulSoup(rules_of(found), "html.parser").select("tbody tr")
    assert "mm from its stop" in of_turret.get_text()
    assert "stop" not in of_flap.get_text()
    assert not re.search(r"\(\)|find_", note + of_turret.get_text())


def test_a_reason_why_there_is_neither_design_nor_bound_is_said_once() -> None:
    rule = cm.ClearanceRule(cm.beyond("die", 40), only_while=cm.beyond("mill", 3))
    machine = cm.Machine("press", PRESS.diagram, [rule], STILL)
    found = findings.find_all(machine, 1, lambda *_: None)
    (note,) = found.notes
    assert note.startswith("There is no balance of all moves, and no bound. ")


def test_every_number_opens_to_its_formula(page: BeautifulSoup) -> None:
    table = next(one for one in page("table") if "The hardest first" in one.get_text())
    assert {len(row(["th", "td"])) for row in table("tr")} == {6}
    sucker = table("tr")[1]
    peak = sucker("details")[1]
    assert peak.get_text().startswith("14.14")
    assert "6.2832 · 0.09 m / (0.2 s)² = 14.1372 m/s²" in peak.get_text()
    assert len(page("details")) > 60


def test_the_page_says_what_is_proved_and_under_which_conditions(page: BeautifulSoup) -> None:
    text = page.get_text()
    assert "No motions of these parts can have a largest peak below 3.99" in text
    assert "is at most 58 % above the best" in text
    assert "At the peak of today that is 3000 pieces/h" in text
    assert "Conditions: the mill stands from 205 to 305 deg" in text


def test_nothing_is_written_over(tmp_path: Path) -> None:
    quick = replace(PRESS, still={})
    names = [cm.write_report(quick, tmp_path).folder.name for _ in range(3)]
    assert names == ["report-press", "report-press-2", "report-press-3"]
    (tmp_path / "report-press-4").write_text("mine")
    assert cm.write_report(quick, tmp_path).folder.name == "report-press-5"
    assert (tmp_path / "report-press-4").read_text() == "mine"
    assert not [*tmp_path.glob(".*")]


@pytest.mark.parametrize("failing", ["sheets_as_xlsx", "write_page", "write_cam_tables", "_move"])
@pytest.mark.parametrize("how", [OSError("disk full"), KeyboardInterrupt(), MemoryError()])
def test_a_crash_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing: str, how: BaseException
) -> None:
    def fail(*_: Any, **__: Any) -> NoReturn:
        raise how

    monkeypatch.setattr(writing, failing, fail)
    with pytest.raises(type(how)):
        cm.write_report(replace(PRESS, still={}), tmp_path)
    assert not [*tmp_path.iterdir()]


def test_a_law_that_no_table_holds_is_refused_before_the_search(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    searched: list[cm.Machine] = []
    monkeypatch.setattr(writing, "find_all", lambda machine, *_: searched.append(machine))
    odd = cm.MotionLaw("odd ", cm.x)
    slide = cm.motion("slide", cm.rise(5, over_deg=180, law=odd), cm.return_(5, over_deg=180))
    with pytest.raises(cm.InputError, match="odd "):
        cm.write_report(cm.Machine("m", cm.TimingDiagram([slide], 2000)), tmp_path)
    assert not searched
    assert not [*tmp_path.iterdir()]


def test_a_cam_that_fails_does_not_take_the_report_with_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: Any, **__: Any) -> NoReturn:
        raise WrongAnswerError("smallest_prime_radius", "it is too small")

    monkeypatch.setattr(writing, "smallest_prime_radius", fail)
    report = cm.write_report(replace(PRESS, still={}), tmp_path, dxf=True)
    assert "no DXF of the die: " in report.page.read_text("utf-8")


def test_a_folder_that_cannot_be_renamed_says_why(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was tried a thousand times, and told that there are so many folders."""

    def held(*_: Any) -> NoReturn:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "rename", held)
    with pytest.raises(cm.InputError, match=r"report-press \(Permission denied\): close what"):
        cm.write_report(replace(PRESS, still={}), tmp_path)
    assert not [*tmp_path.iterdir()]


def test_an_interrupt_at_the_last_word_leaves_nothing(tmp_path: Path) -> None:
    def stop(share: float, _: str) -> None:
        if share == 1:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        cm.write_report(replace(PRESS, still={}), tmp_path, progress=stop)
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize("stopped", ["optimise", "least_peak"])
def test_an_interrupt_takes_the_best_so_far(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stopped: str
) -> None:
    def interrupt(*_: Any, **__: Any) -> NoReturn:
        raise KeyboardInterrupt

    monkeypatch.setattr(findings, stopped, interrupt)
    text = cm.write_report(PRESS, tmp_path, seconds=1).page.read_text("utf-8")
    assert "interrupted" in text
    assert ("No motions of these parts" in text) == (stopped == "optimise")
    assert ("With all moves balanced" in text) == (stopped == "least_peak")


def test_an_interrupt_within_the_search_keeps_the_bound(tmp_path: Path) -> None:
    told: list[float] = []

    def tell(share: float, what: str) -> None:
        told.append(share)
        if what.startswith("built"):
            raise KeyboardInterrupt

    page = cm.write_report(PRESS, tmp_path, seconds=2, progress=tell).page.read_text("utf-8")
    assert "No motions of these parts can have a largest peak below" in page
    assert told == sorted(told)
    assert (told[0], told[-1]) == (0, 1)


def spoiled(machine: cm.Machine) -> cm.Machine:
    return machine.with_diagram(machine.diagram.with_motion(cm.with_angle(cm.EXAMPLE.die, 126)))


def test_a_broken_rule_is_shown_and_is_the_exit_code(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    broken = replace(spoiled(PRESS), still={})
    path = cm.write_machine(broken, tmp_path / "broken.csv")
    assert main([str(path), "--folder", str(tmp_path)]) == BROKEN
    said = capsys.readouterr()
    assert "Broken: the die is" in said.out
    assert "[########################] done" in said.err
    page = BeautifulSoup((tmp_path / "report-broken" / "report.html").read_text(), "html.parser")
    assert page.select("tr.broken")
    assert page.select_one("p.broken")


def test_a_machine_without_rules_has_a_report(tmp_path: Path) -> None:
    still = cm.motion("bed", cm.dwell(360))
    machine = cm.Machine("bed", cm.TimingDiagram([still], 60))
    assert cm.write_report(machine, tmp_path).is_kept
    path = cm.write_machine(replace(PRESS, rules=(), still={}), tmp_path / "free.csv")
    assert main([str(path), "--folder", str(tmp_path)]) == KEPT


def test_a_folder_that_is_none_is_a_sentence(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = cm.write_machine(replace(PRESS, still={}), tmp_path / "m.csv")
    assert main([str(path), "--folder", str(tmp_path / "none")]) == FAILED
    assert "The folder 'none' is not there" in capsys.readouterr().err


def test_a_full_disk_is_a_sentence(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = cm.write_machine(replace(PRESS, still={}), tmp_path / "m.csv")
    monkeypatch.setattr(writing, "write_report", raiser(OSError(errno.ENOSPC, "full")))
    assert main([str(path)]) == FAILED
    said = "\nThe report cannot be written (full): make room on the disk.\n"
    assert capsys.readouterr().err == said


def test_names_are_no_markup_and_no_paths(tmp_path: Path) -> None:
    name = '../<img src=x onerror="alert(1)">'
    die = cm.Motion(name, cm.EXAMPLE.die.segments)
    machine = cm.Machine(name, cm.TimingDiagram([cm.EXAMPLE.mill, die], 2000))
    report = cm.write_report(machine, tmp_path)
    assert report.folder.parent == tmp_path
    page = BeautifulSoup(report.page.read_text("utf-8"), "html.parser")
    assert not page.select("img[onerror]")
    assert name in page.h1.get_text()  # type: ignore[union-attr]


def test_dxf_of_each_mechanism_that_comes_back(tmp_path: Path) -> None:
    report = cm.write_report(replace(PRESS, still={}), tmp_path, dxf=True)
    assert [file.name for file in (report.folder / "dxf").iterdir()] == ["2 die.dxf"]
    text = report.page.read_text("utf-8")
    assert "no DXF of the mill: it goes on by a pitch in each turn" in text
    (said,) = re.findall(
        r"of today's machine: disc cam, radius of the prime circle ([\d.]+) mm, of the roller 10 ",
        html.unescape(text),
    )
    roller = cm.TranslatingRoller(10)
    least = cm.smallest_prime_radius(cm.EXAMPLE.die, roller, pressure_angle_deg=30)
    assert float(said) == pytest.approx(
        1.02 * least, rel=1e-3
    )  # the die's, with something to spare


@pytest.mark.parametrize("make", [lambda: packaging_machine(25), lambda: packaging_machine(12)])
def test_many_mechanisms_have_a_report(
    tmp_path: Path, make: Callable[[], cm.TimingDiagram]
) -> None:
    diagram = make()
    report = cm.write_report(cm.Machine("cartons", diagram, all_dies(diagram)), tmp_path)
    text = report.page.read_text("utf-8")
    assert ("It is not drawn." in text) == (len(diagram.names) > 24)
    assert len(text) < LARGEST_BYTES


def test_what_is_no_machine_is_refused(tmp_path: Path) -> None:
    for wrong in (None, cm.EXAMPLE.diagram, "press.csv"):
        with pytest.raises(cm.InputError, match=r" is given machine=.*: give a Machine"):
            cm.write_report(wrong, tmp_path)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match=r"^The time for the bound is 0 s"):
        cm.write_report(PRESS, tmp_path, seconds=0)
    assert not [*tmp_path.iterdir()]


def odd(name: str, *motions: cm.Motion, still: dict[str, list[tuple[float, float]]]) -> cm.Machine:
    return cm.Machine(name, cm.TimingDiagram(motions, 2000), [], still)


BELT = cm.motion(
    "belt",
    cm.rise(10, over_deg=60, law=cm.CONSTANT_VELOCITY),
    cm.dwell(60),
    cm.return_(10, over_deg=60),
    cm.dwell(180),
)
SHEAR = cm.motion(
    "shear",
    cm.rise(20, over_deg=70, law=cm.MATCHED),
    cm.rise(60, over_deg=80, law=cm.CONSTANT_VELOCITY),
    cm.rise(20, over_deg=50, law=cm.MATCHED),
    cm.return_(100, over_deg=160),
)
LATCH = cm.motion("latch", cm.rise(0.1, over_deg=0.01), cm.return_(0.1, over_deg=359.99))
ODD_MACHINES = [
    odd("jumps", BELT, cm.EXAMPLE.die, still={"belt": [(70, 110)], "die": [(210, 300)]}),
    odd("matched", SHEAR, cm.EXAMPLE.mill, still={"mill": [(205, 305)]}),
    odd("stands", cm.motion("bed", cm.dwell(360)), still={"bed": [(0, 10)]}),
    odd("short", LATCH, still={}),
    odd("n" * 3000, cm.EXAMPLE.mill, still={}),
]


@pytest.mark.parametrize("machine", ODD_MACHINES, ids=lambda machine: machine.name[:10])
def test_an_odd_machine_has_a_report(tmp_path: Path, machine: cm.Machine) -> None:
    text = cm.write_report(machine, tmp_path, seconds=1).page.read_text("utf-8")
    assert "nan" not in BeautifulSoup(text, "html.parser").main.get_text()  # type: ignore[union-attr]
    assert ("of the table over which arcs each part has to stand" in text) == (not machine.still)


def test_the_figure_is_of_a_move_from_rest_to_rest() -> None:
    """Only such a one has a bound: a law that does not rest has no peak that could be drawn."""
    law = cm.LAWS["cycloidal"].part(0, 0.5)
    moves = cm.rise(50, over_deg=60, law=law), cm.dwell(100), cm.return_(50, over_deg=60, law=law)
    jumping = cm.TimingDiagram([cm.motion("die", *moves, cm.dwell(140))], 2000)
    assert not live_figure(cm.Machine("press", jumping))
    assert "none from rest to rest is below" in live_figure(cm.Machine("a", cm.EXAMPLE.diagram))


@pytest.mark.parametrize(("first", "second"), [((30, 110), (20, 50)), ((20, 49), (30, 50))])
def test_the_figure_is_of_the_move_with_the_highest_peak(
    first: tuple[float, float], second: tuple[float, float]
) -> None:
    """The shorter way is driven harder over less than half the angle, not over about as much."""
    rises = [cm.rise(way_mm, over_deg=angle_deg) for way_mm, angle_deg in (first, second)]
    parts = rises[0], cm.dwell(40), rises[1], cm.dwell(40)
    die = cm.motion("die", *parts, cm.return_(50, over_deg=280 - first[1] - second[1]))
    figure = live_figure(cm.Machine("press", cm.TimingDiagram([die], 2000)))
    assert "50.0" in re.findall(r"&quot;start&quot;: ?([\d.]+)", figure)


def test_each_column_of_a_sheet_says_what_it_holds_and_of_which_design(pads: cm.Report) -> None:
    file = pads.folder / "tables.xlsx"
    headings = {name: rows[0] for name, rows in read_sheets(file.name, file.read_bytes()).items()}
    curves = ["position in mm", "velocity in m/s", "acceleration in m/s2"]
    of_design = [f"{curve} of the design" for curve in curves]
    assert headings["cam ejector"] == [
        "cam angle in deg",
        *curves,
        *of_design,
        "cam of the ejector",
    ]
    assert headings["mechanisms"][4:] == [
        "peak velocity in m/s",
        "peak acceleration in m/s2",
        "peak acceleration of the design in m/s2",
    ]
    assert headings["rules"][-2:] == ["clearance in mm", "clearance of the design in mm"]


def test_no_cell_says_minus_nought_nor_speaks_of_a_design_where_there_is_none() -> None:
    """A die that goes down stands at -0.0 m/s where it rests, as floats have it."""
    found = findings.find_all(cm.Machine("press", cm.EXAMPLE.diagram), 1, lambda *_: None)
    cells = [cell for sheet in sheets_of(found).values() for row in sheet for cell in row]
    noughts = [cell for cell in cells if cell == 0 and isinstance(cell, float)]
    assert noughts
    assert {math.copysign(1, cell) for cell in noughts} == {1.0}
    assert not [cell for cell in cells if "design" in str(cell)]
    assert sheets_of(found)["cam die"][0][-1] == "cam of the die"  # its sheet's name may be cut
