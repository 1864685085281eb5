"""A machine in a file: what is typed is read, what is written comes back, xlsx and CSV alike."""

import re
import zipfile
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from cartons import all_dies, packaging_machine
from hypothesis import given
from hypothesis import strategies as st
from machines import examples

import cammotion as cm
from cammotion.exchange.machine_files import machine_rows
from cammotion.exchange.machine_source import open_source
from cammotion.exchange.rule_text import arcs_as_text, arcs_from_text, rule_as_text, rule_from_text
from cammotion.exchange.xlsx_in import read_sheets
from cammotion.exchange.xlsx_out import sheets_as_xlsx

HEADING = "motion; from in deg; to in deg; from in mm; to in mm; law; machine rate in pieces/h"
SAID = "die beyond 19 only while mill within 0.65"
TABLE = f"""
{HEADING}; stops; still; rule
mill; 0; 150; 0; 100; cycloidal; 2000; 24; 205 to 305; {SAID}
die; 150; 205; 0; 50; cycloidal; ; ; 205 to 305;
; 305; 360; 50; 0; cycloidal; ; ; ;
"""
RULE = cm.ClearanceRule(cm.beyond("die", 19), only_while=cm.within("mill", 0.65))
STILL = {"mill": ((205.0, 305.0),), "die": ((205.0, 305.0),)}
FULL = [
    "motion,stops,from in deg,to in deg,from in mm,to in mm,law,machine rate in pieces/h,still",
    "die,,150,205,0,50,cycloidal,2000,",
    "die,,205,305,50,50,dwell,2000,yes",
    "die,,305,360,50,0,cycloidal,2000,",
    "die,,360,510,0,0,,2000,",
]


def carton_machine(count: int) -> cm.Machine:
    diagram = packaging_machine(count)
    still = {diagram.names[0]: [(200, 300)]}
    return cm.Machine("cartons", diagram, all_dies(diagram), still)


def test_what_is_typed_is_the_machine_of_the_lessons() -> None:
    machine = cm.machine_from_text(TABLE, "press")
    example = cm.EXAMPLE
    assert (machine.name, [*machine.rules], machine.still) == ("press", [RULE], STILL)
    assert machine.diagram.rate_per_hour == 2000
    for motion in (example.mill, example.die):
        angles = [*range(0, 360, 7)]
        found = machine.diagram[motion.name].position_mm(angles)
        assert found.tolist() == motion.position_mm(angles).tolist()


def test_a_table_pasted_from_a_spreadsheet_has_tabs() -> None:
    pasted = TABLE.replace("; ", "\t").replace(";", "\t")
    assert cm.machine_from_text(pasted) == cm.machine_from_text(TABLE)


@pytest.mark.parametrize("separator", [";", "\t", ","])
@pytest.mark.parametrize("title", ["My press", "My press; as it is, 2000/h", "by\tus\n\n", "1,5\n"])
def test_the_heading_says_what_separates_the_cells_and_not_a_title(
    title: str, separator: str
) -> None:
    table = TABLE.replace(";", separator)
    machine = cm.machine_from_text(f"{title}\n{table}")
    assert machine == cm.machine_from_text(table)
    assert machine.rules == cm.machine_from_text(TABLE).rules


@pytest.mark.parametrize(
    ("column", "typed"),
    [
        *(("still", "stil"), ("still", "Still in deg"), ("rule", "rulle"), ("stops", "stop")),
        *(("still", "stands still"), ("still", "Rest"), ("rule", "clearance rule")),
        *(("rule", "Conditions"), ("rule", "Regel(n)"), ("rule", "Bedingung"), ("still", "Rast")),
    ],
)
def test_a_misspelt_column_that_may_be_left_out_is_told(column: str, typed: str) -> None:
    with pytest.raises(
        cm.InputError, match=rf"^Line 1 .*'{re.escape(typed)}' and none '{column}'"
    ) as refused:
        cm.machine_from_text(TABLE.replace(f"; {column}", f"; {typed}", 1))
    assert "yours" not in str(refused.value)  # once is enough


def test_a_rule_in_a_column_of_another_name_is_not_passed_over() -> None:
    """It was left out, and the report ended with all rules kept."""
    with pytest.raises(cm.InputError, match=r"column 'Notiz', which is yours: call .* 'rule', or"):
        cm.machine_from_text(TABLE.replace("; rule", "; Notiz", 1))
    noted = TABLE.replace("; rule", "; rule; Notiz", 1).replace(
        "mill within 0.65", "mill within 0.65; die beyond 19 only while mill within 0.65", 1
    )
    assert cm.machine_from_text(noted).rules == (RULE,)
    both = TABLE.replace("; rule", "; rule; Notiz", 1).replace("0.65", "0.65; see drawing", 1)
    assert len(cm.machine_from_text(both).rules) == len(cm.machine_from_text(TABLE).rules) > 0


@pytest.mark.parametrize(
    ("column", "heading", "cell"),
    [
        ("rule", "Notiz", "dei beyond 19 mm only while mill within 0.65"),
        ("rule", "", "die 19 mm tief, nur wenn mill within 0.65"),
        ("rule", "drawing", "the die stays five mm above the mill"),
        ("rule", "rule; rule 2", "; die is beyond 19 mm only when the mull is within 0.65"),
        ("still", "remark", "205 to 305"),
        ("still", "remark", "205° bis 3O5°"),
        ("still", "remark", "210 to 300 Grad"),
        ("still", "page", "205 bis 3O5"),
        ("still", "steht", "210 to 300"),
    ],
)
def test_what_a_table_would_use_but_for_a_slip_is_not_passed_over(
    column: str, heading: str, cell: str
) -> None:
    before = "205 to 305" if column == "still" else SAID
    table = TABLE.replace(f"; {column}", f"; {heading}", 1).replace(before, cell)
    with pytest.raises(cm.InputError, match=rf"^Line 2 .* like a .*, which is .* '{column}', or"):
        cm.machine_from_text(table)


@pytest.mark.parametrize(
    ("mill", "die", "remark"),
    [
        ("mill", "die", "see mill and die moving in video"),
        ("mill", "die", "grease mill and die at least monthly"),
        ("mill", "die", "replace die at least yearly, mill within 2 years"),
        ("mill", "die", "run die at 1500/h only if mill is warm"),
        ("table", "table 2", "table 2 cleaned only when table is standing"),
        ("lid", "slide", "lid within slide, see photo"),
    ],
)
def test_a_remark_on_two_parts_is_no_rule(mill: str, die: str, remark: str) -> None:
    noted = TABLE.replace("; rule", "; remark").replace(SAID, remark)
    parts = noted.replace("\nmill;", f"\n{mill};").replace("\ndie;", f"\n{die};")
    assert cm.machine_from_text(parts).rules == ()


def test_a_remark_like_a_rule_stands_beside_an_empty_column_of_rules() -> None:
    table = TABLE.replace("; rule", "; remark", 1).replace("beyond 19 only", "to 19 mm only")
    with pytest.raises(cm.InputError, match=r"or add an empty column 'rule' if it is a"):
        cm.machine_from_text(table)
    assert cm.machine_from_text(table.replace("; remark", "; remark; rule")).rules == ()


@pytest.mark.parametrize(
    ("heading", "cell"),
    [
        *(("page", "3 to 4"), ("Seite", "12 bis 14"), ("years", "2024 to 2025"), ("lot", "0 to 5")),
        *(("Interlock switch", "x1"), ("Bedingung (Kunde)", "x1"), ("steht auf", "x1")),
        *(("Ruhe", "x1"), ("halt", "x1")),
    ],
)
def test_pages_and_headings_of_ones_own_are_no_still_arcs(heading: str, cell: str) -> None:
    table = TABLE.replace("; rule", "").replace(f"; {SAID}", "").replace("205 to 305", cell)
    assert cm.machine_from_text(table.replace("; still", f"; {heading}")).still == {}


@pytest.mark.parametrize(
    ("needed", "named"), [("machine rate", "rate"), ("from in mm", "frm in mm")]
)
def test_a_column_of_ones_own_makes_no_other_one(needed: str, named: str) -> None:
    own = TABLE.replace("stops", "v max in m/s; wear in µm").replace("24;", "; ;")
    with pytest.raises(cm.InputError, match=r"unknown here: .* stops may be left out\.$"):
        cm.machine_from_text(own.replace(needed, named, 1))


def test_the_example_of_a_rate_is_a_rate() -> None:
    with pytest.raises(cm.InputError, match=r"'fast'; .* number, for example 2000"):
        cm.machine_from_text(TABLE.replace("2000", "fast"))


@pytest.mark.parametrize("rate", ["0", "-3000"])
def test_a_rate_that_is_none_is_told_with_its_line(rate: str) -> None:
    words = (
        rf"^Line 2 of .*, 'machine rate in pieces/h': The machine rate is {rate} pieces/h; it has"
    )
    with pytest.raises(cm.InputError, match=words):
        cm.machine_from_text(TABLE.replace("2000", rate))


@pytest.mark.parametrize("arc", ["205 to 205", "305 to 205", "0 to 360"])
def test_the_arc_that_is_offered_is_one_that_a_table_takes(arc: str) -> None:
    """It was "(205, 305)", as in Python, which a cell refuses."""
    before, last, after = TABLE.rpartition("205 to 305")
    with pytest.raises(cm.InputError, match=r"^Line 3 of .*, 'still': ") as refusal:
        cm.machine_from_text(before + arc + after)
    _, _, offered = str(refusal.value).partition("for example, ")
    assert cm.machine_from_text(before + offered.split(",")[0] + after) == (
        cm.machine_from_text(before + last + after)
    )


def test_a_matched_law_is_told_where_it_comes_from() -> None:
    with pytest.raises(cm.InputError, match=r"law=MATCHED, and write_machine writes 'law in full'"):
        cm.machine_from_text(TABLE.replace("cycloidal", "Matched", 1))


def test_the_decimal_mark_of_a_rule_is_that_of_its_table() -> None:
    with pytest.raises(
        cm.InputError, match=r"'0,65': with the decimal mark of this table it is 0\.65"
    ):
        cm.machine_from_text(TABLE.replace("0.65", "0,65").replace("150;", "150.5;"))


@pytest.mark.parametrize("mark", [".", ","])
def test_an_angle_of_three_decimals_tells_the_mark(mark: str) -> None:
    """What is printed with three decimals is typed so; nobody writes 353366 deg."""
    typed = TABLE.replace("150", "150.125").replace("50;", "12.345;").replace(".", mark)
    machine = cm.machine_from_text(typed)
    assert machine.diagram["mill"].moves[0].to_deg == 150.125
    assert machine.diagram["die"].range_mm == (0, 12.345)
    with pytest.raises(cm.InputError, match=r"2[.]500', which may be 2500 or 2[.]5, and no other"):
        cm.machine_from_text(TABLE.replace("150", "2.500"))  # seven turns, or a little


def test_a_table_in_place_of_a_path_is_told_where_to_go() -> None:
    with pytest.raises(cm.InputError, match="no path: give it to machine_from_text"):
        cm.read_machine(TABLE)


def test_a_column_of_ones_own_is_left_out() -> None:
    heading = TABLE.replace("; rule", "; rule; drawing", 1)
    assert cm.machine_from_text(heading) == cm.machine_from_text(TABLE)
    plain = TABLE.replace("; still", "; remark", 1)
    for cell in (
        "ground to within 0.05 mm",
        "die: only while cold",
        "die standing",
        "1.2.24 to 1.3.24",
    ):
        assert cm.machine_from_text(plain.replace("205 to 305", cell)).still == {}


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (
            [FULL[0], FULL[3], FULL[1]],
            "150 deg stands below that from 305 deg: sort",
        ),
        ([FULL[0], *FULL[1:] * 2], "or, if another motion begins there, give it its own name"),
        (
            [FULL[0], FULL[1], FULL[3], "table,,0,360,5,5,,,yes"],
            "The table never moves, and its still arc goes from 0 to 360 deg: leave that out",
        ),
        (
            [FULL[0], FULL[1].replace(",2000,", ",2000,300 to 20"), FULL[3]],
            "or from 300 to 380 deg over the",
        ),
        ([FULL[0], FULL[1] + '"205 to 250, 260 to 300"', FULL[3]], "several with 'and' between"),
    ],
)
def test_what_is_typed_in_another_order_or_over_the_turn_is_told(
    lines: list[str], words: str
) -> None:
    with pytest.raises(cm.InputError, match=words):
        cm.machine_from_text("\n".join(lines))


@pytest.mark.parametrize("word", ["no", "FALSE", "No"])
def test_a_dwell_may_be_marked_as_none(word: str) -> None:
    table = "\n".join(FULL)
    assert cm.machine_from_text(table).still
    assert cm.machine_from_text(table.replace("yes", word)).still == {}


@pytest.mark.parametrize("name", ["press.ods", "press.pdf", "press.DXF"])
def test_no_table_under_the_name_of_another_format(tmp_path: Path, name: str) -> None:
    with pytest.raises(cm.InputError, match=rf"'{name}' would be CSV .* end in .csv or .xlsx"):
        cm.write_machine(cm.machine_from_text(TABLE), tmp_path / name)
    assert not [*tmp_path.iterdir()]


def test_a_rule_that_nothing_breaks_is_told() -> None:
    machine = cm.machine_from_text(TABLE.replace("beyond 19", "beyond 190"))
    assert "1 rule, kept (1 cannot be broken)" in repr(machine)
    assert [*machine.idle.values()] == ["the die is never beyond 190 mm"]
    wide = cm.machine_from_text(TABLE.replace("within 0.65", "within 50"))
    assert [*wide.idle.values()] == ["the mill is always within 50 mm"]
    assert cm.machine_from_text(TABLE).idle == {}


def test_dwells_may_be_left_out_but_not_one_of_several() -> None:
    complete = cm.machine_from_text("\n".join(FULL))
    moves = cm.machine_from_text("\n".join([FULL[0], FULL[1], FULL[3]]))
    assert moves.diagram == complete.diagram
    assert complete.still == {"die": ((205.0, 305.0),)}
    with pytest.raises(cm.InputError, match=r"add up to 210 deg; .* add a dwell of 150 deg"):
        cm.machine_from_text("\n".join(FULL[:4]))


def test_nothing_in_a_line_without_a_segment_is_dropped() -> None:
    heading, die, *_ = FULL
    back = ",,305,360,50,0,cycloidal,,"
    bare = die.replace("2000", "")
    below = [heading, bare, back, ",,,,,,,2000,", ",,,,,,,,205 to 305"]
    known = cm.Machine("m", cm.machine_from_text("\n".join([heading, die, back])).diagram)
    assert cm.machine_from_text("\n".join(below), "m") == replace(
        known, still={"die": [(205, 305)]}
    )
    above = [heading, ",,,,,,,2000,", bare, back]
    assert cm.machine_from_text("\n".join(above), "m") == known
    mill = ["mill,,0,360,0,100,cycloidal,2000,", ",24,,,,,,,"]
    assert cm.machine_from_text("\n".join([heading, *mill])).diagram["mill"].stops == 24
    named = cm.machine_from_text("\n".join([heading, bare, back, *mill, "Die,,,,,,,,205 to 305"]))
    assert named.still == {"die": ((205, 305),)}


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (",,,,,,,3000,", "'machine rate in pieces/h' is 3000, but 2000 in the first"),
        (",8,,,,,,,", "The indexing motion 'die' ends where it began"),
        (",,,,,,,,bla bla", "'still': The still arc is 'bla bla': write"),
        (",,,,,,,,yes", "'still': 'yes' marks no segment: mark a dwell"),
        ("dei,,,,,,,,205 to 305", "There is no motion 'dei': did you mean 'die'?"),
        (
            "after rebuild,,,,,,,,",
            "no segment stands beside 'after rebuild': leave the line out, put",
        ),
        (
            "rebuilt, as drawn",
            "no segment stands beside 'rebuilt': leave the line out, put it above",
        ),
        ("die,,then,,,,,,", "no segment stands beside 'die': leave the line out, put it above"),
        (",,,,,,see drawing,,", "no segment stands beside 'see drawing': leave the line out, put"),
        ("#1,,l50,205,0,50,cycloidal,,", "Line 4 of my machine: 'from in deg' is 'l50'; it has"),
        ("# rebuilt, as drawn, 3 mm", "no segment stands beside '# rebuilt': leave the line out"),
        ("Total,,,,,50,,,", "no segment stands beside 'Total': leave the line out"),
    ],
)
def test_what_is_wrong_in_a_line_without_a_segment_is_told(line: str, words: str) -> None:
    with pytest.raises(cm.InputError) as refusal:
        cm.machine_from_text("\n".join([*FULL[:2], FULL[3], line]))
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("title", ["motion,of the press", "Press 7,as built", "stops,law"])
def test_the_heading_is_the_row_with_most_known_columns(title: str) -> None:
    assert cm.machine_from_text("\n".join([title, *FULL])) == cm.machine_from_text("\n".join(FULL))
    other = FULL[0].replace("motion", "mechanism").replace("pieces/h", "strokes/min")
    with pytest.raises(
        cm.InputError, match=r"lacks the columns 'motion', 'machine rate"
    ) as refusal:
        cm.machine_from_text("\n".join([title, other, *FULL[1:]]))
    assert "'machine rate in strokes/min' times 60 are pieces/h" in str(refusal.value)


def test_a_sheet_before_that_of_the_machine_is_passed_over_and_slips_name_theirs(
    tmp_path: Path,
) -> None:
    right = [line.split(",") for line in FULL]
    before = {"parts": [["motion", "supplier"], ["die", "Huber"]], "plan": [right[0][1:6]]}
    part, wrong = [["part", *right[0][1:]], *right[1:]], [*right[:3], ["die", "", "305"]]

    def read(sheet: list[list[str]]) -> cm.Machine:
        (tmp_path / "m.xlsx").write_bytes(sheets_as_xlsx({**before, "Machine": sheet}))
        return cm.read_machine(tmp_path / "m.xlsx")

    assert read(right).diagram == cm.machine_from_text("\n".join(FULL)).diagram
    with pytest.raises(
        cm.InputError, match=r"^The sheet 'Machine' of m\.xlsx lacks the column 'mo"
    ):
        read(part)
    with pytest.raises(cm.InputError, match=r"^Row 4 of the sheet 'Machine' of m\.xlsx: "):
        read(wrong)


@pytest.mark.parametrize("dwells", [[], ["die,,3.578,5.323,50,50,,,", "die,,6.283,8.901,0,0,,,"]])
def test_angles_in_radians_are_told(dwells: list[str]) -> None:
    lines = ["die,,2.618,3.578,0,50,cycloidal,2000,", "die,,5.323,6.283,50,0,cycloidal,,"]
    sorted_lines = sorted([*lines, *dwells], key=lambda line: float(line.split(",")[2]))
    with pytest.raises(
        cm.InputError, match=r"^The moves in m lie .* deg, .* times 57\.29577951\. If they are"
    ):
        cm.machine_from_text("\n".join([FULL[0], *sorted_lines]), "m")


def test_a_tiny_machine_in_degrees_is_none_in_radians(tmp_path: Path) -> None:
    for angle in (2, 8):  # of a whole machine that moves so little, and of a long one's short move
        lines = ["die,,0,1,0,50,cycloidal,2000,", f"die,,1,{angle},50,0,cycloidal,,"]
        assert cm.machine_from_text("\n".join([FULL[0], *lines])).diagram["die"].moves
    quick = [cm.rise(10, over_deg=5), cm.dwell(355)]
    table = cm.TimingDiagram([cm.indexing_motion("table", *quick, stops=60)], 600)
    path = cm.write_machine(cm.Machine("few", table), tmp_path / "few.csv")
    assert cm.read_machine(path).diagram["table"].moves[0].angle_deg == 5


@pytest.mark.parametrize(
    ("angles", "heights", "is_asked"),
    [
        ([100, 120, 0, 20, 140, 160], [(0, 9), (9, 0), (0, 5), (5, 0), (0, 7), (7, 0)], True),
        ([0, 20, 40, 60, 80, 100], [(0, 9), (9, 0), (0, 5), (5, 0), (0, 7), (7, 0)], False),
        ([100, 120, 0, 20, 140, 160], [(0, 9), (9, 3), (0, 5), (5, 0), (3, 7), (7, 0)], False),
        ([100, 120, 0, 20, 140, 160], [(0, 9), (9, 0), (0, 5), (5, 0), (0, 9), (9, 0)], False),
    ],
)
def test_two_parts_of_one_name_are_told_unless_their_lines_may_be_those_of_one(
    angles: list[int], heights: list[tuple[int, int]], *, is_asked: bool
) -> None:
    names = ["arm", "arm", "flap", "flap", "arm", "arm"]
    lines = [
        f"{name},,{at},{at + 10},{low},{high},cycloidal,2000,"
        for name, at, (low, high) in zip(names, angles, heights, strict=True)
    ]
    text = "\n".join([FULL[0], *lines])
    if not is_asked:
        assert cm.machine_from_text(text).diagram.names == ("arm", "flap")
        return
    with pytest.raises(cm.InputError, match=r"^Line 6 of .*: moves of the arm stand here again, "):
        cm.machine_from_text(text)


def test_a_cell_beside_the_heading_is_told_alone(tmp_path: Path) -> None:
    """With its line all that stands there was lost, and missing further down."""
    two = TABLE.replace("within 0.65", "within 0.65; mill moving only while die within 1")
    with pytest.raises(cm.InputError) as refusal:
        cm.machine_from_text(two)
    assert str(refusal.value) == (
        "Line 2 of my machine has 'mill moving only while die within 1' in column 11, but the "
        "heading has 10 columns: leave it out, give the column a heading, or put a text that has a "
        "semicolon in quotation marks; each rule has a cell of its own."
    )
    rows = [line.split(",") for line in FULL]
    rows[1].append("see drawing")
    rows[3][2] = "30S"
    (tmp_path / "m.xlsx").write_bytes(sheets_as_xlsx({"m": rows}))
    with pytest.raises(cm.InputError) as refusal:
        cm.read_machine(tmp_path / "m.xlsx")
    beside, slip = str(refusal.value).splitlines()
    assert beside.startswith(
        "Row 2 of m.xlsx has 'see drawing' in column 10, but the heading has 9"
    )
    assert slip.startswith("Row 4 of m.xlsx: 'from in deg' is '30S'")


@pytest.mark.parametrize(("column", "line"), [("stops", ",8,,,,,,,"), ("still", ",,,,,,,,0 to 9")])
def test_what_is_said_of_no_motion_is_told(column: str, line: str) -> None:
    with pytest.raises(cm.InputError, match=rf"^Line 2 of .*'{column}' is .* write its name"):
        cm.machine_from_text("\n".join([FULL[0], line, *FULL[1:]]))


def test_a_law_in_full_without_a_segment_is_told() -> None:
    lines = [f"{FULL[0]},law in full", *(f"{line}," for line in FULL[1:]), ",,,,,,,,,x**2"]
    with pytest.raises(cm.InputError, match=r"Line 6 of .*'from in deg' is ''"):
        cm.machine_from_text("\n".join(lines))


@pytest.mark.parametrize("say", [str.upper, str.title, str.lower])
def test_laws_and_dwells_may_be_in_any_case(say: Callable[[str], str]) -> None:
    said = [line.replace("cycloidal", say("cycloidal")) for line in FULL]
    said = [line.replace("dwell", say("dwell")) for line in said]
    assert cm.machine_from_text("\n".join(said)) == cm.machine_from_text("\n".join(FULL))
    straight = ["die,,0,180,0,9,constant velocity,2000,", "die,,180,360,9,0,constant velocity,,"]
    known, other = (
        cm.machine_from_text("\n".join([FULL[0], *lines]))
        for lines in (straight, [line.replace("constant", say("constant")) for line in straight])
    )
    assert known == other


def test_a_motion_in_another_case_is_asked() -> None:
    lines = [FULL[0], FULL[1], FULL[3].replace("die", "Die")]
    with pytest.raises(cm.InputError) as refusal:
        cm.machine_from_text("\n".join(lines), "m")
    assert str(refusal.value) == (
        "Line 3 of m: the motion is 'Die', but 'die' in Line 2 of m: write both alike, or list the "
        "dwells too if they are two motions."
    )


@pytest.mark.parametrize("other", ["upper\xa0die", "upper  die", "Upper die"])
def test_a_name_with_other_blanks_is_doubtful_too(other: str) -> None:
    table = [FULL[0], FULL[1].replace("die", other), FULL[3].replace("die", "upper die")]
    with pytest.raises(cm.InputError, match=r"the motion is 'upper die', but .* write both alike"):
        cm.machine_from_text("\n".join(table))


@pytest.mark.parametrize("ending", [".csv", ".xlsx"])
def test_two_motions_of_one_name_in_two_cases_come_back(tmp_path: Path, ending: str) -> None:
    motions = [cm.Motion(name, cm.EXAMPLE.die.segments) for name in ("die", "Die", "DIE")]
    rule = cm.ClearanceRule(cm.beyond("DIE", 19), only_while=cm.within("Die", 0.65))
    machine = cm.Machine("m", cm.TimingDiagram(motions, 2000), [rule], {"Die": [(205, 305)]})
    assert cm.read_machine(cm.write_machine(machine, tmp_path / f"m{ending}")) == machine


def test_a_turret_stands_between_its_moves_too() -> None:
    mill = cm.machine_from_text(TABLE).diagram["mill"]
    assert (mill.stops, mill.pitch_mm, mill.position_mm(360 + 75)) == (24, 100, 150)


def test_a_plain_table_of_segments_is_a_machine_without_rules(tmp_path: Path) -> None:
    path = cm.write_segments(cm.EXAMPLE.diagram, tmp_path / "m.csv")
    machine = cm.read_machine(path)
    assert (machine.diagram, machine.rules, machine.still) == (cm.EXAMPLE.diagram, (), {})
    assert cm.read_segments(path) == cm.EXAMPLE.diagram


def test_a_table_with_rules_is_read_as_segments(tmp_path: Path) -> None:
    machine = cm.machine_from_text(TABLE)
    for ending in (".csv", ".xlsx"):
        path = cm.write_machine(machine, tmp_path / f"m{ending}")
        assert cm.read_segments(path) == machine.diagram


@pytest.mark.parametrize("ending", [".csv", ".xlsx", ".XLSX", ""])
@pytest.mark.parametrize("count", [2, 8, 24])
def test_what_is_written_comes_back(tmp_path: Path, ending: str, count: int) -> None:
    machine = carton_machine(count)
    path = cm.write_machine(machine, tmp_path / f"cartons{ending}")
    assert cm.read_machine(path) == machine
    with pytest.raises(cm.InputError, match="is there already"):
        cm.write_machine(machine, path)
    assert zipfile.is_zipfile(path) == (ending.lower() == ".xlsx")


def test_more_rules_than_segments_have_lines_of_their_own(tmp_path: Path) -> None:
    rules = [
        cm.ClearanceRule(cm.beyond("die", depth), only_while=cm.within("mill", 0.65))
        for depth in range(19, 40)
    ]
    machine = cm.Machine("m", cm.EXAMPLE.diagram, rules)
    assert cm.read_machine(cm.write_machine(machine, tmp_path / "m.csv")) == machine


def named(name: str) -> cm.Machine:
    """Return a machine whose die has another name, with a rule on it."""
    die = cm.Motion(name, cm.EXAMPLE.die.segments)
    rule = cm.ClearanceRule(cm.beyond(name, 19), only_while=cm.within("mill", 0.65))
    return cm.Machine("m", cm.TimingDiagram([cm.EXAMPLE.mill, die], 2000), [rule])


def test_a_name_that_spoils_a_rule_is_refused(tmp_path: Path) -> None:
    with pytest.raises(cm.InputError, match=r"be written as a table.*rules plain names, without"):
        cm.write_machine(named("a only while b"), tmp_path / "m.csv")
    assert not [*tmp_path.iterdir()]


@pytest.mark.parametrize(
    "name",
    ["die beyond 3", "the beyond within", "The die", "=die", "die\xa02", "die  2\nb", "die:"],
)
def test_an_odd_name_comes_back(tmp_path: Path, name: str) -> None:
    path = cm.write_machine(named(name), tmp_path / "m.csv")
    assert cm.read_machine(path) == named(name)


def test_the_mark_at_the_start_of_a_file_is_no_part_of_its_text(tmp_path: Path) -> None:
    path = cm.write_machine(named("die"), tmp_path / "m.csv")
    text = path.read_text("utf-8")
    assert cm.machine_from_text("\ufeff" + text, "m") == cm.machine_from_text(text, "m")


numbers = st.floats(-1e6, 1e6)
halves = st.tuples(st.sampled_from([cm.beyond, cm.within]), numbers)


@examples(50)
@given(when=halves, only=halves)
def test_every_rule_is_read_back(when: tuple[object, float], only: tuple[object, float]) -> None:
    names = ("the upper die", "mill 2")
    made = [make(name, limit) for (make, limit), name in zip((when, only), names, strict=True)]  # type: ignore[operator]
    rule = cm.ClearanceRule(*made)
    assert rule_from_text(rule_as_text(rule), names) == rule
    assert (
        rule_from_text(
            rule_as_text(rule)
            .upper()
            .replace("MILL", "mill")
            .replace("THE UPPER DIE", "the upper die"),
            names,
        )
        == rule
    )


@pytest.mark.parametrize(
    ("text", "decimal", "arcs"),
    [
        ("205 to 305", ".", [(205, 305)]),
        ("from 205,5 to 305 deg", ",", [(205.5, 305)]),
        ("205° to 305°", ".", [(205, 305)]),
        ("from 205.5 deg to 305deg.", ".", [(205.5, 305)]),
        ("205° to 305° and 350 ° to 370", ".", [(205, 305), (350, 370)]),
        ("205°° to 305", ".", None),
        ("205mm to 305", ".", None),
        ("205 to 305 and 350 to 370", ".", [(205, 305), (350, 370)]),
        ("205 to 305; 350 to 370", ".", [(205, 305), (350, 370)]),
        (" YES ", ".", []),
        ("x", ".", []),
    ],
)
def test_arcs_as_people_type_them(
    text: str, decimal: str, arcs: list[tuple[float, float]] | None
) -> None:
    if arcs is None:
        with pytest.raises(cm.InputError, match="give a number"):
            arcs_from_text(text, decimal)
        return
    assert arcs_from_text(text, decimal) == arcs
    if arcs:
        assert arcs_from_text(arcs_as_text(arcs)) == arcs


def test_a_german_workbook_and_a_german_file_say_the_same(tmp_path: Path) -> None:
    german = TABLE.replace("0.65", "0,65").replace("; 150; 205;", "; 150,0; 205,0;")
    (tmp_path / "g.csv").write_text(german.strip(), "utf-8-sig")
    assert cm.read_machine(tmp_path / "g.csv").rules == cm.machine_from_text(TABLE).rules


@pytest.mark.parametrize("ending", [".csv", ".xlsx"])
def test_numbers_of_three_decimals_in_sentences_come_back(tmp_path: Path, ending: str) -> None:
    """They look like thousands; what is written can be read in one way alone."""
    rule = cm.ClearanceRule(cm.beyond("die", 19.125), only_while=cm.within("mill", 0.65))
    machine = cm.Machine("m", cm.EXAMPLE.diagram, [rule], {"die": [(205.125, 304.875)]})
    assert cm.read_machine(cm.write_machine(machine, tmp_path / f"m{ending}")) == machine


@pytest.mark.parametrize("said", ["die beyond 2,400 only while mill within 0.65", "205,125 to 305"])
def test_a_number_in_a_sentence_is_asked_too(tmp_path: Path, said: str) -> None:
    rows: list[list[object]] = [*machine_rows(cm.Machine("m", cm.EXAMPLE.diagram))]
    rows[4][-1 if "only" in said else -2] = said
    (tmp_path / "m.xlsx").write_bytes(sheets_as_xlsx({"m": rows}))
    with pytest.raises(cm.InputError, match=r"^Row 5 .* stands '2.*': write it with a 0 more"):
        cm.read_machine(tmp_path / "m.xlsx")


ODD = ["=1+1", "a & b < c", '"quoted"', "ß日本😀", " edge ", "tab\there", "x" * 5000]
CONTROLS = [
    "a\rb",
    "a\r\nb",
    "a\nb",
    "a\x00b",
    "a\x01b",
    "a\x0bb",
    "a\ufffeb",
    "_x0041_",
    "_xD800_",
]
CONTROLS += ["_x005F_x0041_", "__x0041_", "_x00411_"]


def test_a_workbook_keeps_texts_and_numbers() -> None:
    numbers = [1.5, -2, 1e-300, 12345678.9, 0.1]
    rows: list[list[object]] = [["heading", *ODD], ["", *numbers]]
    found = read_sheets("b.xlsx", sheets_as_xlsx({"one": rows, "a:b/c": [["x"]], "A_B_C": []}))
    assert [*found] == ["one", "a_b_c", "A_B_C 2"]
    assert found["one"][0] == rows[0]
    assert [float(cell) for cell in found["one"][1][1:]] == numbers


def test_the_name_of_a_sheet_never_ends_in_an_apostrophe() -> None:
    names = ["cam " + 26 * "a" + "'b", 40 * "'", "a" * 30 + " b"]
    found = read_sheets("b.xlsx", sheets_as_xlsx({name: [["x"]] for name in names}))
    assert len(found) == len(names)
    assert not any(name.startswith("'") or name.endswith(("'", " ")) for name in found)


def test_long_names_of_sheets_are_cut_where_a_spreadsheet_cuts_them() -> None:
    found = read_sheets("b.xlsx", sheets_as_xlsx({"a" * 40: [["x"]], "a" * 41: [["x"]]}))
    assert [*found] == ["a" * 31, "a" * 29 + " 2"]


def test_a_long_name_of_a_file_is_that_of_the_machine(tmp_path: Path) -> None:
    """It was shortened as in a sentence."""
    machine = cm.Machine("press", cm.EXAMPLE.diagram)
    path = cm.write_machine(machine, tmp_path / f"{70 * 'a'}.csv")
    assert cm.read_machine(path).name == 70 * "a"


def test_a_workbook_keeps_what_xml_does_not() -> None:
    found = read_sheets("b.xlsx", sheets_as_xlsx({"one": [CONTROLS]}))
    assert found["one"] == [CONTROLS]


@pytest.mark.parametrize("ending", [".csv", ".xlsx"])
@pytest.mark.parametrize("name", CONTROLS)
def test_a_name_of_any_characters_comes_back(tmp_path: Path, name: str, ending: str) -> None:
    die = cm.Motion(name, cm.EXAMPLE.die.segments)
    machine = cm.Machine("m", cm.TimingDiagram([die], 2000))
    assert cm.read_machine(cm.write_machine(machine, tmp_path / f"m{ending}")) == machine


def test_half_a_character_is_in_no_file(tmp_path: Path) -> None:
    die = cm.Motion("a\ud800b", cm.EXAMPLE.die.segments)
    machine = cm.Machine("m", cm.TimingDiagram([die], 2000))
    for ending in (".csv", ".xlsx"):
        with pytest.raises(cm.InputError):
            cm.write_machine(machine, tmp_path / f"m{ending}")
    assert not [*tmp_path.iterdir()]


def test_the_same_rows_are_the_same_bytes() -> None:
    assert sheets_as_xlsx({"a": [["b", 1]]}) == sheets_as_xlsx({"a": [["b", 1]]})


def test_a_machine_refuses_what_does_not_fit() -> None:
    diagram = cm.EXAMPLE.diagram
    with pytest.raises(cm.InputError, match=r"the die moves"):
        cm.Machine("m", diagram, [RULE], {"die": [(150, 160)]})
    with pytest.raises(cm.InputError, match=r"There is no motion 'punch'"):
        cm.Machine("m", diagram, [], {"punch": [(150, 160)]})
    with pytest.raises(cm.InputError, match=r"The name of the machine"):
        cm.Machine(" ", diagram)
    other = cm.ClearanceRule(cm.beyond("punch", 19), only_while=cm.within("mill", 0.65))
    with pytest.raises(cm.InputError, match=r"There is no motion 'punch'"):
        cm.Machine("m", diagram, [other])


def test_a_machine_says_what_is_broken() -> None:
    wide = cm.EXAMPLE.diagram.with_motion(cm.with_angle(cm.EXAMPLE.die, 126))
    machine = cm.Machine("m", wide, [RULE])
    assert "1 rule, 1 broken" in repr(machine)
    assert len(machine.violations) == 2
    assert machine.hardest == "mill"


def test_a_named_rule_comes_back_with_its_name(tmp_path: Path) -> None:
    rule = replace(RULE, name="die clear of mill")
    machine = cm.Machine("press", cm.EXAMPLE.diagram, [rule])
    back = cm.read_machine(cm.write_machine(machine, tmp_path / "press.csv"))
    assert back.rules == (rule,)


@pytest.mark.parametrize("ending", [".csv", ".xlsx"])
@pytest.mark.parametrize("name", ["=1+1", "@SUM(1)", "-2", "+3", "'=4", "'tis"])
def test_no_cell_is_a_formula(tmp_path: Path, name: str, ending: str) -> None:
    rule = replace(RULE, name=name)
    die = cm.Motion(name, cm.EXAMPLE.die.segments)
    diagram = cm.TimingDiagram([cm.EXAMPLE.mill, cm.EXAMPLE.die, die], 2000)
    still = {"mill": [(-155, -55)], name: [(-155, -55)]}
    machine = cm.Machine("press", diagram, [rule], still)
    path = cm.write_machine(machine, tmp_path / f"press{ending}")
    assert cm.read_machine(path) == machine
    cells = [cell for row in open_source(path).rows for cell in row]
    assert not any(cell.startswith(("=", "@", "+")) for cell in cells)
    assert not any(cell.startswith("-") for cell in cells if not cell[1:2].isdigit() or " " in cell)


def test_a_rule_in_another_case_is_one_of_the_machine() -> None:
    """As `widest_move` takes it; else a widened move would break it without a word."""
    shouted = cm.ClearanceRule(cm.beyond("Die", 19), only_while=cm.within("MILL", 0.65))
    machines = [cm.Machine("press", cm.EXAMPLE.diagram, [rule]) for rule in (shouted, RULE)]
    assert machines[0].rules == (RULE,)
    found, known = map(cm.improvements, machines)
    assert [one.after for one in found] == [one.after for one in known]


def test_still_arcs_that_are_given_twice_are_refused() -> None:
    twice = {"die": [(205, 305)], "Die": [(0, 10)]}
    with pytest.raises(cm.InputError, match="twice for the motion 'die', as 'die' and as 'Die'"):
        cm.Machine("press", cm.EXAMPLE.diagram, (), twice)
