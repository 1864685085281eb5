"""Two hundred damaged tables of a machine, each by its name, and what is wrong with it."""

import csv
import io
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import cammotion as cm

TABLE = Path(__file__).parent.parent / "notebooks" / "data" / "pad_press.csv"
HEADING, *ROWS = list(csv.reader(io.StringIO(TABLE.read_text("utf-8"))))
NUMBERS = ("from in deg", "to in deg", "from in mm", "to in mm")
NO_NUMBERS = ("abc", "1O0", "12..5", "--", "#REF!", "nan", "inf", "5 mm", "1e999", "½")
NO_RULES = (
    "the die may be beyond only while the mill is within 0.65 mm",
    "the die may be beyond 19 mm while the mill is within 0.65 mm",
    "die < 19 only while mill < 0.65",
    "only while",
    "the die may be beyond 19 mm only while the die is within 0.65 mm",
    "the die may be beyond nineteen mm only while the mill is within 0.65 mm",
    "the die may be beyond 19 mm only while the mill is within 0.65 mm only while nothing",
    "beyond 19 only while within 3",
    "TRUE",
    "=A1",
)
NO_ARCS = ("maybe", "100", "305 to 205", "205 to", "a to b", "205-305", "0 to 720", "0 to 0", "to")
NO_LAWS = ("cycloid", "sinus", "dwel", "constant", "7", "?", "modified", "polynomial", "none", "-")
BOOK, RELATIONS = "xl/workbook.xml", "xl/_rels/workbook.xml.rels"
BIG = 50_000_000

Damage = tuple[str, str, bytes]
"""The name of the damage, the ending of the file, and what it holds."""


def text_of(rows: list[list[str]], heading: list[str] = HEADING) -> bytes:
    """Return a table as the bytes of a CSV file."""
    out = io.StringIO(newline="")
    csv.writer(out).writerows([heading, *rows])
    return out.getvalue().encode()


def changed(row: int, column: str, cell: str) -> bytes:
    """Return the table with another cell."""
    rows = [[*line] for line in ROWS]
    rows[row][HEADING.index(column)] = cell
    return text_of(rows)


def each_row(step: int = 1) -> range:
    return range(0, len(ROWS), step)


def in_cells() -> Iterator[Damage]:
    """Yield tables with one cell that is wrong."""
    for n in each_row(2):
        column = NUMBERS[n // 2 % 4]
        yield f"no '{column}' in row {n}", ".csv", changed(n, column, "")
        text = NO_NUMBERS[n // 2 % len(NO_NUMBERS)]
        yield f"{text} for a number in row {n}", ".csv", changed(n, column, text)
    moves = [n for n in each_row() if ROWS[n][HEADING.index("law")] != "dwell"]
    for n, law in zip(moves, NO_LAWS * 2, strict=False):
        yield f"the law {law} in row {n}", ".csv", changed(n, "law", law)
    for n in moves[:6]:
        yield f"no law of the move in row {n}", ".csv", changed(n, "law", "")
    for n, stops in enumerate(("0", "2.5", "-24", "many", "1e12", "24;")):
        yield f"{stops} stops, {n}", ".csv", changed(0, "stops", stops)
    for rate in ("0", "-5", "fast", "", "1e60", "2000/h"):
        yield f"the rate {rate}", ".csv", changed(0, "machine rate in pieces/h", rate)


def of_names() -> Iterator[Damage]:
    """Yield tables in which a mechanism is called like another one, or one row is."""
    names = [*dict.fromkeys(row[0] for row in ROWS)]
    for one, other in zip(names, [*names[1:], names[0]], strict=True):
        rows = [[other if row[0] == one else row[0], *row[1:]] for row in ROWS]
        yield f"the {one} is called {other}, too", ".csv", text_of(rows)
    for n in each_row(4):
        yield f"another name in row {n}", ".csv", changed(n, "motion", "somebody")


def of_angles() -> Iterator[Damage]:
    """Yield tables whose angles or positions do not go on."""
    for n in each_row(2):
        angle = float(ROWS[n][HEADING.index("to in deg")])
        yield f"row {n} ends 7 deg later", ".csv", changed(n, "to in deg", f"{angle + 7}")
    for n in each_row(3):
        height = float(ROWS[n][HEADING.index("to in mm")])
        yield f"row {n} ends 1 mm higher", ".csv", changed(n, "to in mm", f"{height + 1}")
    for n in each_row(6):
        yield f"row {n} is missing", ".csv", text_of([*ROWS[:n], *ROWS[n + 1 :]])
        yield f"row {n} is there twice", ".csv", text_of([*ROWS[: n + 1], *ROWS[n:]])


def of_rules() -> Iterator[Damage]:
    """Yield tables with rules and still arcs that are none, that nobody knows, or contradict."""
    for rule in NO_RULES:
        yield f"the rule {rule}", ".csv", changed(8, "rule", rule)
    first = ROWS[0][HEADING.index("rule")]
    for n, name in enumerate(("punch", "Mil", "", "knive", "the", "mill mill")):
        yield f"a rule on {name}, {n}", ".csv", changed(8, "rule", first.replace("mill", name))
    yield "a rule twice", ".csv", changed(8, "rule", first)
    opposite = first.replace("is within", "is beyond")
    yield "two rules that forbid all", ".csv", changed(8, "rule", opposite)
    for n, arc in enumerate(NO_ARCS):
        yield f"still over {arc}, {n}", ".csv", changed(2, "still", arc)
    for n in (0, 4, 8, 12):
        yield f"still in the move of row {n}", ".csv", changed(n, "still", "yes")
    yield "still while it moves", ".csv", changed(0, "still", "100 to 140")


def of_shape() -> Iterator[Damage]:
    """Yield tables with columns and cells too few or too many, and files that are no table."""
    for column in HEADING[:8]:
        if column != "stops":
            at = HEADING.index(column)
            rows = [[*row[:at], *row[at + 1 :]] for row in ROWS]
            heading = [*HEADING[:at], *HEADING[at + 1 :]]
            yield f"no column '{column}'", ".csv", text_of(rows, heading)
    for column in ("motion", "law", "rule"):
        double = text_of([[*row, ""] for row in ROWS], [*HEADING, column])
        yield f"the column '{column}' twice", ".csv", double
    for n in each_row(8):
        rows = [[*row, "7"] if k == n else row for k, row in enumerate(ROWS)]
        yield f"a cell too many in row {n}", ".csv", text_of(rows)
    good = TABLE.read_bytes()
    yield "empty", ".csv", b""
    yield "only the heading", ".csv", text_of([])
    yield "only blanks", ".csv", b" \n\n  \n"
    yield "an open quotation", ".csv", good + b'"knife'
    yield "a stray quotation", ".csv", good.replace(b"knife", b'"kn"ife', 1)
    yield "Latin-1", ".csv", good.replace(b"knife", "Stößel".encode("latin-1"))
    for encoding in ("utf-16", "utf-32", "utf-16-be"):
        yield encoding, ".csv", good.decode().encode(encoding)
    yield "bytes at random", ".csv", bytes(range(256)) * 20
    yield "a picture", ".csv", b"\x89PNG\r\n\x1a\n" + bytes(500)
    yield "null characters", ".csv", good.replace(b"0,90,", b"0,9\x00,")
    yield "a web page", ".csv", b"<!DOCTYPE html><html><body><table></table></body></html>"
    yield "50 MB", ".csv", good + b"\n" * BIG


def zipped(parts: dict[str, bytes | str]) -> bytes:
    """Return a zip with these parts."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as book:
        for name, part in parts.items():
            book.writestr(name, part)
    return content.getvalue()


def of_books(folder: Path) -> Iterator[Damage]:
    """Yield workbooks that are none, or damaged."""
    book = folder / "whole.xlsx"
    if not book.exists():
        cm.write_machine(cm.read_machine(TABLE), book)
    whole = book.read_bytes()
    for n in range(1, 9):
        yield f"a workbook cut to {n} tenths", ".xlsx", whole[: n * len(whole) // 10]
    sheet = whole.index(b"xl/worksheets/sheet1.xml") + 40
    for n in range(8):
        at = sheet + 100 * n
        broken = whole[:at] + bytes(255 - byte for byte in whole[at : at + 4]) + whole[at + 4 :]
        yield f"a workbook with other bytes at {n}", ".xlsx", broken
    yield "a zip of a text", ".xlsx", zipped({"word/document.xml": "<document/>"})
    yield "an empty zip", ".xlsx", zipped({})
    yield "a workbook without sheets", ".xlsx", zipped({BOOK: "<workbook/>"})
    bomb = b" " * 300_000_000
    yield "a zip bomb", ".xlsx", zipped({RELATIONS: bomb, BOOK: "<workbook/>"})
    entities = '<!DOCTYPE a [<!ENTITY b "' + "x" * 1000 + '">]><workbook>&b;</workbook>'
    yield "entities of its own", ".xlsx", zipped({RELATIONS: entities, BOOK: entities})
    yield "an old workbook", ".xlsx", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(600)
    yield "a CSV file called .xlsx, spoiled", ".xlsx", changed(3, "to in deg", "x")
    yield "no zip", ".xlsx", b"PK\x03\x04" + bytes(200)


def damages(folder: Path) -> Iterator[Damage]:
    """Yield all damaged tables; `folder` is for the workbook of which some are made."""
    plain: tuple[Callable[[], Iterator[Damage]], ...] = (
        in_cells,
        of_names,
        of_angles,
        of_rules,
        of_shape,
    )
    for kind in plain:
        yield from kind()
    yield from of_books(folder)
