"""Timing diagrams in files: what is written is read back, and nothing is lost or overwritten."""

import csv
import errno
import os
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from machines import DIPPING, MONOTONE, examples, make_diagram, make_die, make_mill
from small_workbook import raiser

import cammotion as cm
from cammotion import Motion, MotionLaw, Segment, TimingDiagram, read_segments
from cammotion import write_curves as write_curves_of
from cammotion import write_segments as write
from cammotion.exchange.xlsx_out import sheets_as_xlsx

DIAGRAM = make_diagram(make_mill(), make_die(124.84))
PARABOLIC = MONOTONE[6]
OWN_LAWS = [DIPPING, PARABOLIC, MotionLaw('a, "b"; c', cm.x)]
LENGTHS = ["from in deg", "to in deg", "from in mm", "to in mm"]
HEADING = ["motion", "stops", *LENGTHS, "law", "machine rate in pieces/h"]
TURN = ["die", "", "0", "360", "0", "0", "dwell", "2000"]


@st.composite
def motions(draw: st.DrawFn, name: str) -> Motion:
    """Make a motion of any segments, that comes back or goes on."""
    ways = draw(st.lists(st.floats(0.001, 110), min_size=1, max_size=3))
    start = draw(st.floats(-1e3, 1e3))
    angles = [start, *(start + sum(ways[: n + 1]) for n in range(len(ways))), start + 360]
    heights = draw(st.lists(st.floats(-1e3, 1e3), min_size=len(angles), max_size=len(angles)))
    stops = draw(st.none() | st.integers(1, 10**6))
    if stops is None or abs(heights[-1] - heights[0]) < 1e-6:
        stops, heights[-1] = None, heights[0]
    own: st.SearchStrategy[str | MotionLaw] = st.sampled_from(["cycloidal", *OWN_LAWS])
    segments = [
        Segment(
            from_deg=angles[n],
            to_deg=angles[n + 1],
            from_mm=heights[n],
            to_mm=heights[n + 1],
            law=None if heights[n] == heights[n + 1] else draw(own),
        )
        for n in range(len(ways) + 1)
    ]
    return Motion(name, segments, stops)


names = st.text(min_size=1, max_size=12).map(str.strip).filter(bool)


@st.composite
def diagrams(draw: st.DrawFn) -> TimingDiagram:
    """Make a diagram of one to three motions with any names."""
    given_names = draw(st.lists(names, min_size=1, max_size=3, unique=True))
    return TimingDiagram([draw(motions(name)) for name in given_names], draw(st.floats(0.1, 1e5)))


@examples(30)
@given(diagram=diagrams())
def test_every_diagram_is_read_back_as_it_was(
    tmp_path_factory: pytest.TempPathFactory, diagram: TimingDiagram
) -> None:
    path = tmp_path_factory.getbasetemp() / "machine.csv"
    assert read_segments(write(diagram, path, overwrite=True), laws=OWN_LAWS) == diagram


def rewrite(path: Path, rows: list[list[str]], *, delimiter: str = ",", mark: str = "") -> Path:
    """Save rows as a spreadsheet would."""
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(mark)
        csv.writer(file, delimiter=delimiter).writerows(rows)
    return path


def test_the_heading_names_the_units(tmp_path: Path) -> None:
    first, second, *others = list(csv.reader(write(DIAGRAM, tmp_path / "m.csv").open()))
    assert first == [*HEADING, "law in full"]
    assert second == ["mill", "24", "0.0", "150.0", "0.0", "100.0", "cycloidal", "2000.0", ""]
    assert [row[6] for row in others] == ["dwell", "cycloidal", "dwell", "cycloidal", "dwell"]


@pytest.mark.parametrize("decimal", [",", "."])
def test_a_german_spreadsheet_is_read(tmp_path: Path, decimal: str) -> None:
    """It saves semicolons, decimal commas and a mark, and leaves the commas in names alone."""
    die = cm.motion("Stempel, links; 1,5", cm.dwell(359.5), cm.dwell(0.5), start_mm=-1.25)
    diagram = make_diagram(make_mill(124.5), die)
    rows = list(csv.reader(write(diagram, tmp_path / "m.csv").open(newline="")))
    german = [[*row[:2], *(cell.replace(".", decimal) for cell in row[2:])] for row in rows]
    path = rewrite(tmp_path / "g.csv", german, delimiter=";", mark="\ufeff")
    assert read_segments(path) == diagram


def german(path: Path, rate: str, *others: str) -> Path:
    """Save a dwell with such numbers, between semicolons."""
    turn = ["die", "", *others, "dwell", rate]
    return rewrite(path, [HEADING, turn], delimiter=";")


@pytest.mark.parametrize(
    ("rate", "others", "found"),
    [
        ("2.400", ["0,0", "360,0", "0,5", "0,5"], 2400),
        ("2,400", ["0.0", "360.0", "0.5", "0.5"], 2400),
        ("2,400", ["0,0", "360,0", "0,5", "0,5"], 2.4),
        ("2.400", ["0.0", "360.0", "0.5", "0.5"], 2.4),
        ("2.400,5", ["0", "360", "1", "1"], 2400.5),
        ("1.002.400", ["0", "360", "1", "1"], 1_002_400),
        ("2.40", ["0", "360", "1", "1"], 2.4),
        ("2400", ["0", "360", "1", "1"], 2400),
    ],
)
def test_a_mark_of_thousands_is_no_decimal_mark(
    tmp_path: Path, rate: str, others: list[str], found: float
) -> None:
    assert read_segments(german(tmp_path / "m.csv", rate, *others)).rate_per_hour == found


@pytest.mark.parametrize("rate", ["2.400", "2,400"])
def test_a_number_that_can_be_read_in_two_ways_is_a_question(tmp_path: Path, rate: str) -> None:
    path = german(tmp_path / "m.csv", rate, "0", "360", "1", "1")
    match = (
        rf"^Line 2 of m\.csv: 'machine rate in pieces/h' is '{rate}', which may be 2400 or 2\.4,"
    )
    with pytest.raises(cm.InputError, match=match):
        read_segments(path)
    german(path, f"{rate}0", "0", "360", "1", "1")
    assert read_segments(path).rate_per_hour == 2.4


@pytest.mark.parametrize(
    ("column", "cell", "write"),
    [
        (4, "1.125 in", "28.5750"),
        (4, "-1,125 in", "-28,5750"),
        (3, "6.283 rad", "359.989382681"),
        (7, "33.333/min", "1999.98"),
    ],
)
def test_three_decimals_before_a_larger_unit_are_converted(
    tmp_path: Path, column: int, cell: str, write: str
) -> None:
    row = ["die", "", "0", "360", "1", "1", "dwell", "2000"]
    row[column] = cell
    path = rewrite(tmp_path / "m.csv", [HEADING, row], delimiter=";")
    with pytest.raises(cm.InputError, match=rf"alone, in .*: write {re.escape(write)}\.$"):
        read_segments(path)


def test_in_a_table_with_commas_between_the_cells_a_point_is_decimal(tmp_path: Path) -> None:
    rows = [HEADING, ["die", "", "0", "360", "1.125", "1.125", "dwell", "2400"]]
    assert read_segments(rewrite(tmp_path / "m.csv", rows))["die"].start_mm == 1.125


def as_book(path: Path, rows: list[list[Any]]) -> Path:
    """Save rows as a workbook, texts as texts."""
    path.write_bytes(sheets_as_xlsx({"machine": rows}))
    return path


@pytest.mark.parametrize("save", [rewrite, as_book])
def test_a_text_with_a_comma_is_asked_beside_numbers_with_points(
    tmp_path: Path, save: Callable[..., Path]
) -> None:
    """Who has typed it tells the meaning, and not how the table keeps numbers."""
    turn: list[Any] = ["die", "", 0, 360, 1.125, 1.125, "dwell"]
    path = tmp_path / "m.csv"
    with pytest.raises(cm.InputError, match=r"^(Line|Row) 2 .* '2,400', which may be 2400 or 2\.4"):
        read_segments(save(path, [HEADING, [*turn, "2,400"]]))
    assert read_segments(save(path, [HEADING, [*turn, "2,4000"]])).rate_per_hour == 2.4
    turn[3] = "360,0"
    assert read_segments(save(path, [HEADING, [*turn, "2,400"]])).rate_per_hour == 2.4


def test_what_people_do_to_tables_is_read(tmp_path: Path) -> None:
    """Columns in another order, one more, blank lines, blanks about a cell, motions by turns."""
    rows = list(csv.reader(write(DIAGRAM, tmp_path / "m.csv").open()))
    mill, die = rows[1:3], rows[3:]
    mixed = [rows[0], mill[0], die[0], [], *die[1:], [""] * 9, mill[1]]
    changed = [[*(f" {cell} " for cell in reversed(row)), ""] for row in mixed]
    changed[0][-1] = "notes"
    assert read_segments(rewrite(tmp_path / "c.csv", changed)) == DIAGRAM


def old_table(path: Path) -> Path:
    """Make a table what it was before laws were written in full."""
    return rewrite(path, [row[:8] for row in csv.reader(path.open(newline=""))])


def test_an_older_table_is_read_with_the_laws_that_it_names(tmp_path: Path) -> None:
    diagram = make_diagram(make_die(law=PARABOLIC))
    path = old_table(write(diagram, tmp_path / "m.csv"))
    assert read_segments(path, laws=[PARABOLIC]) == diagram
    with pytest.raises(
        cm.InputError, match=r"^Line 2 of m\.csv: There is no motion law 'parabolic'"
    ):
        read_segments(path)


def test_a_name_that_begins_with_a_quote_may_be_typed(tmp_path: Path) -> None:
    rows = [[*HEADING, "law in full"], [*changed(motion="'tis"), ""]]
    assert read_segments(rewrite(tmp_path / "m.csv", rows)).names == ("'tis",)


def test_names_of_an_older_table_are_read_as_they_are(tmp_path: Path) -> None:
    rows = [HEADING, changed(motion="'=die")]
    assert read_segments(rewrite(tmp_path / "m.csv", rows)).names == ("'=die",)


@pytest.mark.parametrize("known", [cm.LAWS["cycloidal"], cm.CONSTANT_VELOCITY])
def test_a_law_of_ones_own_goes_before_the_catalogue(tmp_path: Path, known: MotionLaw) -> None:
    own = MotionLaw(known.name, cm.x**2)
    path = old_table(write(make_diagram(make_die(law=known)), tmp_path / "m.csv"))
    assert read_segments(path, laws=[own])["die"].moves[0].law is own


@pytest.mark.parametrize(
    "laws", [("cubic", MotionLaw("cubic", cm.x)), (MotionLaw("my", cm.x), MotionLaw("my", cm.x**2))]
)
def test_two_laws_of_one_name_come_back(tmp_path: Path, laws: tuple[Any, Any]) -> None:
    parts = [cm.rise(50, over_deg=90, law=laws[0]), cm.return_(50, over_deg=90, law=laws[1])]
    diagram = cm.TimingDiagram([cm.motion("die", *parts, cm.dwell(180))], 2000)
    back = read_segments(write(diagram, tmp_path / "m.csv"))["die"]
    assert [cm.as_law(move.law).name for move in back.moves] == [
        cm.as_law(law).name for law in laws
    ]
    angles = np.arange(0, 360, 7.3)
    assert back.position_mm(angles).tolist() == diagram.position_mm("die", angles).tolist()


def test_a_shear_that_is_matched_to_the_web_comes_back(tmp_path: Path) -> None:
    shear = cm.motion(
        "shear",
        cm.rise(20, over_deg=70, law=cm.MATCHED),
        cm.rise(60, over_deg=80, law=cm.CONSTANT_VELOCITY),
        cm.rise(20, over_deg=50, law=cm.MATCHED),
        cm.return_(100, over_deg=160),
    )
    diagram = cm.TimingDiagram([shear], 2000)
    path = write(diagram, tmp_path / "m.csv")
    assert read_segments(path, laws=[cm.as_law(move.law) for move in shear.moves]) == diagram


def test_a_law_of_the_catalogue_is_written_by_its_name(tmp_path: Path) -> None:
    diagram = make_diagram(make_die(law=cm.LAWS["cycloidal"]))
    assert read_segments(write(diagram, tmp_path / "m.csv")) == make_diagram(make_die())


@pytest.mark.parametrize("write_table", [write, write_curves_of])
def test_a_file_that_is_there_is_left_as_it_is(
    tmp_path: Path, write_table: Callable[..., Path]
) -> None:
    path = tmp_path / "mine.csv"
    path.write_text("a week's work")
    match = r"^The file mine\.csv is there already and was left as it is: .*, or add overwrite=True"
    with pytest.raises(cm.InputError, match=match):
        write_table(DIAGRAM, path)
    assert path.read_text() == "a week's work"
    assert write_table(DIAGRAM, str(path), overwrite=True) == path
    assert path.read_text() != "a week's work"


@contextmanager
def full_after(most: int) -> Iterator[None]:
    """Let no file become longer than so many bytes, as on a disk that is full."""
    resource = pytest.importorskip("resource")
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.mark.parametrize("there", [True, False])
def test_a_full_disk_loses_nothing_and_leaves_nothing(tmp_path: Path, there: bool) -> None:
    path = tmp_path / "mine.csv"
    if there:
        path.write_text("a week's work")
    with full_after(100), pytest.raises(cm.InputError, match=r"^The file mine\.csv cannot be"):
        write(DIAGRAM, path, overwrite=there)
    assert [*tmp_path.iterdir()] == [path] * there
    assert not there or path.read_text() == "a week's work"
    assert write(DIAGRAM, path, overwrite=there).stat().st_size > 100


@pytest.mark.parametrize("there", [True, False])
def test_a_name_is_that_of_a_whole_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, there: bool
) -> None:
    """Where it is killed while it writes: what bears the name is no half table."""
    path, write_bytes, seen = tmp_path / "mine.csv", Path.write_bytes, []
    if there:
        path.write_text("a week's work")

    def watched(part: Path, content: bytes) -> int:
        written = write_bytes(part, content[: len(content) // 2])
        seen.append(path.read_text())
        return written + write_bytes(part, content)

    monkeypatch.setattr(Path, "write_bytes", watched)
    write(DIAGRAM, path, overwrite=there)
    assert seen == ["a week's work" if there else ""]
    assert [*tmp_path.iterdir()] == [path]
    assert read_segments(path) == DIAGRAM


def test_what_is_written_over_stays_what_it_was(tmp_path: Path) -> None:
    """A link stays a link, and who may read a file may read the new one."""
    path, link = tmp_path / "mine.csv", tmp_path / "link.csv"
    path.write_text("a week's work")
    path.chmod(0o640)
    mode = path.stat().st_mode
    try:
        link.symlink_to(path)
    except OSError:
        link = path
    write(DIAGRAM, link, overwrite=True)
    assert (link.is_symlink(), path.stat().st_mode) == (link != path, mode)
    assert read_segments(path) == DIAGRAM
    assert {*tmp_path.iterdir()} == {path, link}


def test_a_file_that_may_not_be_written_to_is_not_replaced(tmp_path: Path) -> None:
    path = tmp_path / "mine.csv"
    path.write_text("a week's work")
    path.chmod(0o440)
    if os.access(path, os.W_OK):
        pytest.skip("this user may write everywhere")
    with pytest.raises(cm.InputError, match=r"^The file mine\.csv cannot be written \(Permission"):
        write(DIAGRAM, path, overwrite=True)
    assert path.read_text() == "a week's work"


@pytest.mark.parametrize("number", [errno.ENOSPC, getattr(errno, "EDQUOT", errno.ENOSPC)])
def test_on_a_full_disk_room_is_asked_for(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    monkeypatch.setattr(Path, "write_bytes", raiser(OSError(number, "full")))
    with pytest.raises(cm.InputError, match=r"written \(full\): make room on the disk\.$"):
        write(DIAGRAM, tmp_path / "m.csv")
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize("write_table", [write, write_curves_of])
def test_a_folder_that_is_not_there_is_named(
    tmp_path: Path, write_table: Callable[..., Path]
) -> None:
    with pytest.raises(
        cm.InputError, match=r"^The file m\.csv cannot be written \(No such file .*:"
    ):
        write_table(DIAGRAM, tmp_path / "no" / "m.csv")


@pytest.mark.parametrize("write_table", [write, write_curves_of])
def test_no_table_under_the_name_of_a_workbook(
    tmp_path: Path, write_table: Callable[..., Path]
) -> None:
    with pytest.raises(cm.InputError, match=r"'m\.xlsx' would be CSV .* end in \.csv\.$"):
        write_table(DIAGRAM, tmp_path / "m.xlsx")
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize("write_table", [write, write_curves_of])
@pytest.mark.parametrize("diagram", [None, 3, make_die()], ids=["None", "3", "a motion"])
def test_only_a_diagram_is_written(
    tmp_path: Path, write_table: Callable[..., Path], diagram: Any
) -> None:
    with pytest.raises(cm.InputError, match=r"^The diagram is .*: give a TimingDiagram"):
        write_table(diagram, tmp_path / "m.csv")
    assert not (tmp_path / "m.csv").exists()


def test_the_curves_are_those_of_the_diagram(tmp_path: Path) -> None:
    heading, *rows = csv.reader(write_curves_of(DIAGRAM, tmp_path / "m.csv", step_deg=7).open())
    assert heading[:3] == ["cam angle in deg", "time in s", "mill position in mm"]
    assert heading[3:6] == [
        f"mill {curve}" for curve in ("velocity in m/s", "acceleration in m/s2", "jerk in m/s3")
    ]
    assert heading[6] == "die position in mm"
    angle, time, *columns = np.array(rows, dtype=float).T
    assert angle.tolist() == [*range(0, 360, 7), 360]
    assert time == pytest.approx(angle / 200)  # 2000 pieces/h are 200 deg/s
    curves = [DIAGRAM.position_mm, DIAGRAM.velocity, DIAGRAM.acceleration, DIAGRAM.jerk]
    for n, column in enumerate(columns):
        name, curve = DIAGRAM.names[n // 4], curves[n % 4]
        assert column.tolist() == np.asarray(curve(name, angle)).tolist()


@pytest.mark.parametrize("parts", [1, 7, 161, 175, 227, 3600])
def test_the_table_ends_once(tmp_path: Path, parts: int) -> None:
    """Some steps, such as 360/161, fit 161 times into the turn and a rounding more."""
    path = write_curves_of(DIAGRAM, tmp_path / "m.csv", step_deg=360 / parts)
    angles = [float(row[0]) for row in list(csv.reader(path.open()))[1:]]
    assert len(angles) == parts + 1
    assert angles == pytest.approx(np.linspace(0, 360, parts + 1))


@pytest.mark.parametrize("step", [0.00099, 360.001, 0, -1])
def test_a_step_is_at_least_a_thousandth_of_a_degree_and_at_most_a_turn(
    tmp_path: Path, step: float
) -> None:
    with pytest.raises(
        cm.InputError, match=r"^The step of the table is .* at least 0\.001 and at m"
    ):
        write_curves_of(DIAGRAM, tmp_path / "m.csv", step_deg=step)
    assert not [*tmp_path.iterdir()]


def changed(**cells: str) -> list[str]:
    """Return the line of a dwell over the whole turn with other cells in it."""
    columns = [column.split(" in ")[0].replace(" ", "_") for column in HEADING]
    units = ["", "", "_deg", "_deg", "_mm", "_mm", "", ""]
    keys = [column + unit for column, unit in zip(columns, units, strict=True)]
    return [cells.get(key, cell) for key, cell in zip(keys, TURN, strict=True)]


MALFORMED: dict[str, list[list[str]]] = {
    "The file bad.csv lacks the columns 'motion', 'from in deg', 'to in deg', 'from in mm',": [],
    "The file bad.csv lacks the column 'to in mm': its first line has to be motion, stops,": [
        [column for column in HEADING if column != "to in mm"],
        TURN,
    ],
    **{
        f"The file bad.csv lacks the column '{column}', and has '{other}', unknown here: its first "
        f"line has to be {', '.join(HEADING[:8])}, with the numbers in these units; stops may be "
        f"left out. The numbers of '{other}' times {factor} are {unit}.": [
            [other if one == column else one for one in HEADING],
            TURN,
        ]
        for column, other, factor, unit in [
            ("from in mm", "from in inch", 25.4, "mm"),
            ("to in deg", "to (rad)", 57.29577951, "deg"),
            ("machine rate in pieces/h", "rate per minute", 60, "pieces/h"),
            ("machine rate in pieces/h", "pieces/min", 60, "pieces/h"),
        ]
    },
    "The file bad.csv has no line with a segment: add some.": [HEADING, []],
    "Line 2 of bad.csv: 'to in deg' is 'full'; it has to be a number, for example 150.": [
        HEADING,
        changed(to_deg="full"),
    ],
    "Line 3 of bad.csv: 'from in mm' is ''; it has to be a number, for example 150.": [
        HEADING,
        [],
        TURN[:4],
    ],
    "Line 2 of bad.csv: 'from in deg' is 'nan'; it has to be a number, for example 150.": [
        HEADING,
        changed(from_deg="nan"),
    ],
    "Line 2 of bad.csv: 'to in mm' is '8 in'; it has to be a number alone, in mm: write 203.2.": [
        HEADING,
        changed(to_mm="8 in"),
    ],
    "Line 2 of bad.csv: 'machine rate in pieces/h' is '33 rpm'; it has to be a number alone, in "
    "pieces/h: write 1980.": [HEADING, changed(machine_rate="33 rpm")],
    "Line 2 of bad.csv and further: The motion 'die' ends 5 mm from where it began: add a return "
    "of 5 mm, or, if it moves on from stop to stop, give its stops (indexing_motion does). In a "
    "table the stops stand in the column 'stops'; call 'stations' so if it says them.": [
        [column.replace("stops", "stations") for column in HEADING],
        changed(stops="12", law="cycloidal", to_mm="5"),
    ],
    "Line 2 of bad.csv: 'machine rate in pieces/h' is 'inf'; it has to be a number,": [
        HEADING,
        changed(machine_rate="inf"),
    ],
    "Line 2 of bad.csv: 'to in deg' is '150,5,1'; it has to be a number, for example 150.": [
        HEADING,
        changed(to_deg="150,5,1"),
    ],
    "Line 2 of bad.csv has '2000' in column 9, but the heading has 8 columns: leave it out, give "
    "the column a heading, or write numbers with a decimal point and texts that have a comma in "
    "quotation marks.": [HEADING, [*TURN[:3], "359", *TURN[3:]]],
    "Line 2 of bad.csv: The dwell from 0 to 360 deg begins at 0 mm and ends at 5 mm;": [
        HEADING,
        changed(to_mm="5"),
    ],
    "Line 2 of bad.csv: There is no motion law 'cycloid': did you mean 'cycloidal'": [
        HEADING,
        changed(law="cycloid", to_mm="5"),
    ],
    "Line 2 of bad.csv: The angle of a segment is 0 deg;": [HEADING, changed(to_deg="0")],
    "Line 2 of bad.csv and further: The segments of 'die' add up to 350 deg; a cam turn is 360: "
    "add a dwell of 10 deg.": [HEADING, changed(to_deg="350")],
    "Line 3 of bad.csv and further: Segments of 'die' overlap: the dwell ends at 200 deg, but": [
        HEADING,
        changed(motion="mill"),
        changed(to_deg="200"),
        changed(from_deg="100"),
    ],
    "Line 2 of bad.csv and further: The name of a motion is ''": [HEADING, changed(motion=" ")],
    "Line 2 of bad.csv and further: The number of stops of 'die' is 2.5; it has to be a whole": [
        HEADING,
        changed(stops="2.5"),
    ],
    "Line 2 of bad.csv and further: The number of stops of 'die' is 0; it has to be a whole": [
        HEADING,
        changed(stops="0"),
    ],
    "Line 2 of bad.csv: 'stops' is 'many'; it has to be a number, for example 24.": [
        HEADING,
        changed(stops="many"),
    ],
    "Line 3 of bad.csv: 'stops' is 12, but 24 in the first line of the motion: write the same in "
    "both.": [HEADING, changed(stops="24", to_deg="10"), changed(stops="12", from_deg="10")],
    "Line 3 of bad.csv: 'machine rate in pieces/h' is 1000, but 2000 in the first line of the "
    "diagram: write the same in both.": [
        HEADING,
        TURN,
        changed(motion="mill", machine_rate="1000"),
    ],
    "Line 2 of bad.csv, 'machine rate in pieces/h': The machine rate is -5 pieces/h; it has": [
        HEADING,
        changed(machine_rate="-5"),
    ],
}


@pytest.mark.parametrize("sentence", MALFORMED, ids=lambda sentence: sentence[:60])
def test_a_malformed_file_is_refused_with_the_line(tmp_path: Path, sentence: str) -> None:
    path = rewrite(tmp_path / "bad.csv", MALFORMED[sentence])
    with pytest.raises(cm.InputError) as refusal:
        read_segments(path)
    assert str(refusal.value).startswith(sentence)


@pytest.mark.parametrize(
    ("content", "match"),
    [
        (b"a\nSt\xf6\xdfel", r"^The file bad\.csv .* line 2 has the byte 0xf6, .* as 'CSV UTF-8'"),
        (
            ",".join(HEADING).encode() + b'\n"die,,0',
            r"^Line 2 of bad\.csv cannot be cut into cells",
        ),
        (
            b'motion,"a"b\n',
            r"^Line 1 of bad\.csv cannot be cut into cells \(.*: look for a quotatio",
        ),
    ],
    ids=["no text", "open quotation", "stray quotation"],
)
def test_what_is_no_table_is_refused(tmp_path: Path, content: bytes, match: str) -> None:
    path = tmp_path / "bad.csv"
    path.write_bytes(content)
    with pytest.raises(cm.InputError, match=match):
        read_segments(path)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(cm.InputError, match=r"^There is no file m\.csv: give the path of one\.$"):
        read_segments(tmp_path / "m.csv")
    with pytest.raises(cm.InputError, match=r"cannot be read \(.*[Dd]irectory"):
        read_segments(tmp_path)
    for path in (".", Path("/")):
        with pytest.raises(cm.InputError, match=rf"^The file {path} cannot be read \("):
            read_segments(path)
