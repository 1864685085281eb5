"""What spreadsheets make of a table: dates, percentages, formulas, hidden sheets, their minus."""

import re
from io import BytesIO
from pathlib import Path
from zipfile import ZipFile

import pytest
from damaged import zipped

import cammotion as cm
from cammotion.exchange.machine_files import machine_rows
from cammotion.exchange.xlsx_out import sheets_as_xlsx

HEADING, *ROWS = machine_rows(cm.Machine("press", cm.EXAMPLE.diagram, [cm.EXAMPLE.rule]))
SHEET, STYLES, BOOK = "xl/worksheets/sheet1.xml", "xl/styles.xml", "xl/workbook.xml"
OWN = '<numFmts><numFmt numFmtId="170" formatCode="{}"/></numFmts><fonts'


def changed(part: str, pattern: str, new: str, content: bytes | None = None) -> bytes:
    """Return a workbook of which one place in one part is another."""
    with ZipFile(BytesIO(content or sheets_as_xlsx({"press": [HEADING, *ROWS]}))) as book:
        parts: dict[str, bytes | str] = {name: book.read(name).decode() for name in book.namelist()}
    parts[part], count = re.subn(pattern, lambda _: new, str(parts[part]), count=1)
    assert count == 1
    return zipped(parts)


def styled(number: int, code: str = "") -> bytes:
    """Return a workbook whose rate has a format of this number, perhaps one of its own."""
    style = f'<xf numFmtId="{number}"/></cellXfs>'
    content = changed(STYLES, "</cellXfs>", style)
    content = changed(STYLES, "<fonts", OWN.format(code), content) if code else content
    return changed(SHEET, r'<c r="H2">', '<c r="H2" s="2">', content)


def refusal(path: Path, content: bytes) -> str:
    path.write_bytes(content)
    with pytest.raises(cm.InputError) as refused:
        cm.read_machine(path)
    return str(refused.value)


@pytest.mark.parametrize(
    ("number", "code", "shown"),
    [
        *((number, "", "2000 as a date") for number in (14, 22, 45)),
        (170, "yyyy\\-mm\\-dd", "2000 as a date"),
        (170, "[$-407]d/\\ mmm", "2000 as a date"),
        (170, "[h]:mm", "2000 as a date"),
        *((number, "", "200000 %") for number in (9, 10)),
        (170, "0.0%", "200000 %"),
    ],
)
def test_a_number_that_is_shown_as_something_else_is_no_number(
    tmp_path: Path, number: int, code: str, shown: str
) -> None:
    """Who types 1.5 into a German sheet gets the first of May, whose number is some 45,000."""
    said = refusal(tmp_path / "m.xlsx", styled(number, code))
    format_it = ", and format the cell as a number" if shown.endswith("date") else ""
    assert said == (
        f"Row 2 of m.xlsx: 'machine rate in pieces/h' is '{shown}'; it has to be a number, for "
        f"example 2000{format_it}."
    )


@pytest.mark.parametrize(
    "code", ["0.00&quot; mm/s&quot;", "#,##0\\ \\d\\e\\g", "[Red]0.0", "General", "Standard"]
)
def test_a_number_with_a_unit_or_a_colour_is_one(tmp_path: Path, code: str) -> None:
    (tmp_path / "m.xlsx").write_bytes(styled(170, code))
    assert cm.read_machine(tmp_path / "m.xlsx").diagram == cm.EXAMPLE.diagram


@pytest.mark.parametrize(
    ("cell", "column", "said"),
    [
        ("C2", "from in deg", r"Row 2 of m\.xlsx: 'from in deg' is '=D9'; it has to be a number"),
        ("K2", "rule", r"Row 2 of m\.xlsx, 'rule': The rule is '=D9': write it as"),
    ],
)
def test_a_formula_that_nobody_has_computed_is_not_an_empty_cell(
    tmp_path: Path, cell: str, column: str, said: str
) -> None:
    """As programs write them: a rule would be lost without a word."""
    assert HEADING[ord(cell[0]) - ord("A")] == column
    new = f'<c r="{cell}"><f>D9</f></c>'
    content = changed(SHEET, rf'<c r="{cell}".*?</c>', new)
    assert re.search(said, refusal(tmp_path / "m.xlsx", content))


def test_a_computed_formula_is_its_value(tmp_path: Path) -> None:
    content = changed(SHEET, r'<c r="H2"><v>', '<c r="H2"><f>1000+1000</f><v>')
    (tmp_path / "m.xlsx").write_bytes(content)
    assert cm.read_machine(tmp_path / "m.xlsx").diagram == cm.EXAMPLE.diagram


@pytest.mark.parametrize("state", ["hidden", "veryHidden"])
def test_a_sheet_in_sight_comes_first(tmp_path: Path, state: str) -> None:
    old = [[3000 if cell == 2000 else cell for cell in row] for row in ROWS]
    both = sheets_as_xlsx({"old": [HEADING, *old], "new": [HEADING, *ROWS]})
    path = tmp_path / "m.xlsx"
    path.write_bytes(both)
    assert cm.read_machine(path).diagram.rate_per_hour == 3000
    path.write_bytes(changed(BOOK, 'name="old"', f'name="old" state="{state}"', both))
    assert cm.read_machine(path).diagram.rate_per_hour == 2000


def test_a_cell_far_from_the_table_is_told_by_its_column(tmp_path: Path) -> None:
    """Counted as spreadsheets do after Z: AA, AB, and GS is the 201st."""
    said = refusal(tmp_path / "m.xlsx", changed(SHEET, r'<c r="K2"', '<c r="GS2"'))
    assert "has a cell in row 2, column 201; a table of a machine has at most 20000 rows" in said


@pytest.mark.parametrize(("row", "is_read"), [(20_000, True), (20_001, False)])
def test_the_last_row_that_is_read(tmp_path: Path, row: int, is_read: bool) -> None:
    last = len(ROWS) + 1
    content = changed(SHEET, f'<row r="{last}">', f'<row r="{row}">')
    path = tmp_path / "press.xlsx"
    if is_read:
        path.write_bytes(content)
        assert cm.read_machine(path).diagram == cm.EXAMPLE.diagram
    else:
        assert f"has a cell in row {row}" in refusal(path, content)


def test_cells_and_rows_need_not_say_where_they_are(tmp_path: Path) -> None:
    """They follow one another, and an empty one is one too."""
    with ZipFile(BytesIO(sheets_as_xlsx({"press": [HEADING, *ROWS]}))) as book:
        sheet = book.read(SHEET).decode()
    rows = []
    for row in re.findall(r"<row .*?</row>", sheet):
        cells = dict(re.findall(r'<c r="([A-Z]+)\d+"(.*?</c>)', row))
        rows.append("".join(f"<c{cells.get(column, '/>')}" for column in "ABCDEFGHIJK"))
    data = "<row/>".join(f"<row>{row}</row>" for row in rows)
    content = changed(SHEET, "<sheetData>.*</sheetData>", f"<sheetData>{data}</sheetData>")
    path = tmp_path / "press.xlsx"
    path.write_bytes(content)
    assert cm.read_machine(path).diagram == cm.EXAMPLE.diagram
    said = refusal(path, changed(SHEET, "<v>150.0</v>", "<v>15.0</v>", content))
    assert said.startswith("Row 3 of press.xlsx")


def test_the_minus_of_a_spreadsheet_is_one(tmp_path: Path) -> None:
    """Swedish and Norwegian ones write U+2212; a name keeps its own."""
    motion = cm.motion("a−b", cm.rise(50, over_deg=180), cm.return_(50, over_deg=180), start_mm=-9)
    other = cm.motion("c", cm.dwell(360))
    rule = cm.ClearanceRule(cm.beyond("a−b", -3.5), only_while=cm.within("c", 1))
    machine = cm.Machine("m", cm.TimingDiagram([motion, other], 2000), [rule])
    path = cm.write_machine(machine, tmp_path / "m.csv")
    path.write_text(path.read_text("utf-8").replace("-", "−"), "utf-8")
    assert cm.read_machine(path) == machine
