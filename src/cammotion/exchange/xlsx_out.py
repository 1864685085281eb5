"""An .xlsx workbook of plain sheets, by the standard library alone: the same rows, the same bytes.

A text is written as a text, so that no spreadsheet takes it for a formula; what XML does not keep
stands there as spreadsheets write it, _x000D_ for a carriage return.
"""

import io
import math
import re
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from xml.sax.saxutils import escape, quoteattr

Sheet = Sequence[Sequence[object]]

_HEAD = '<?xml version="1.0" encoding="UTF-8" standalone="yes"?>\n'
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_OFFICE = "http://schemas.openxmlformats.org/officeDocument/2006/relationships"
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_KIND = "application/vnd.openxmlformats-officedocument.spreadsheetml"
_MADE = (1980, 1, 1, 0, 0, 0)  # the first day that a zip knows, so that files can be compared
_NO_NAME = re.compile(r"[\[\]:*?/\\\x00-\x1f\ud800-\udfff\ufffe\uffff]")  # in no name of a sheet
_HALF = re.compile(r"[\ud800-\udfff]")
_NO_XML = re.compile(r"[\x00-\x08\x0b-\x1f\ufffe\uffff]|_(?=x[0-9A-Fa-f]{4}_)")
_LONGEST_NAME = 31
_WIDTH = 16  # characters of a column
_STYLES = (  # plain, and bold for a heading
    f'<styleSheet xmlns="{_MAIN}"><fonts count="2">'
    '<font><sz val="11"/><name val="Calibri"/></font>'
    '<font><b/><sz val="11"/><name val="Calibri"/></font></fonts>'
    '<fills count="1"><fill><patternFill patternType="none"/></fill></fills>'
    '<borders count="1"><border/></borders><cellStyleXfs count="1"><xf/></cellStyleXfs>'
    '<cellXfs count="2"><xf fontId="0"/><xf fontId="1" applyFont="1"/></cellXfs>'
    '<cellStyles count="1"><cellStyle name="Normal" xfId="0" builtinId="0"/></cellStyles>'
    "</styleSheet>"
)


def sheets_as_xlsx(sheets: Mapping[str, Sheet]) -> bytes:
    """Return a workbook with these sheets, each a list of rows of texts and numbers.

    The first row is the heading, in bold, and stays in sight. Names are made fit for a sheet.
    """
    parts = _frame(_sheet_names(sheets))
    for number, sheet in enumerate(sheets.values(), 1):
        parts[f"xl/worksheets/sheet{number}.xml"] = _sheet(sheet)
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as book:
        for path, text in parts.items():
            entry = zipfile.ZipInfo(path, _MADE)
            entry.compress_type = zipfile.ZIP_DEFLATED
            book.writestr(entry, _HEAD + text)
    return content.getvalue()


def _frame(names: Sequence[str]) -> dict[str, str]:
    """Return the parts of a workbook but for its sheets, which have these names."""
    paths = [f"worksheets/sheet{number}.xml" for number in range(1, len(names) + 1)]
    types = "".join(
        f'<Override PartName="/xl/{path}" ContentType="{_KIND}.worksheet+xml"/>' for path in paths
    )
    sheets = "".join(
        f'<sheet name={quoteattr(name)} sheetId="{n}" r:id="rId{n}"/>'
        for n, name in enumerate(names, 1)
    )
    return {
        "[Content_Types].xml": f'<Types xmlns="{_PACKAGE}/content-types">'
        f'<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.'
        'relationships+xml"/><Default Extension="xml" ContentType="application/xml"/>'
        f'<Override PartName="/xl/workbook.xml" ContentType="{_KIND}.sheet.main+xml"/>'
        f'<Override PartName="/xl/styles.xml" ContentType="{_KIND}.styles+xml"/>{types}</Types>',
        "_rels/.rels": _relations([("officeDocument", "xl/workbook.xml")]),
        "xl/workbook.xml": f'<workbook xmlns="{_MAIN}" xmlns:r="{_OFFICE}">'
        f"<sheets>{sheets}</sheets></workbook>",
        "xl/_rels/workbook.xml.rels": _relations(
            [*(("worksheet", path) for path in paths), ("styles", "styles.xml")]
        ),
        "xl/styles.xml": _STYLES,
    }


def _sheet(rows: Sheet) -> str:
    lines = (
        f'<row r="{number}">'
        + "".join(
            _cell(value, f"{_letters(column)}{number}", bold=number == 1)
            for column, value in enumerate(row)
        )
        + "</row>"
        for number, row in enumerate(rows, 1)
    )
    columns = max((len(row) for row in rows), default=1)
    return (
        f'<worksheet xmlns="{_MAIN}"><sheetViews><sheetView workbookViewId="0">'
        '<pane ySplit="1" topLeftCell="A2" activePane="bottomLeft" state="frozen"/></sheetView>'
        f'</sheetViews><cols><col min="1" max="{columns}" width="{_WIDTH}" customWidth="1"/></cols>'
        f"<sheetData>{''.join(lines)}</sheetData></worksheet>"
    )


def _cell(value: object, at: str, *, bold: bool) -> str:
    style = ' s="1"' if bold else ""
    if value is None or value == "":
        return ""
    if isinstance(value, int | float) and math.isfinite(value):
        return f'<c r="{at}"{style}><v>{float(value)!r}</v></c>'
    text = _HALF.sub("\N{REPLACEMENT CHARACTER}", str(value))
    text = escape(_NO_XML.sub(lambda found: f"_x{ord(found[0]):04X}_", text))
    return f'<c r="{at}"{style} t="inlineStr"><is><t xml:space="preserve">{text}</t></is></c>'


def _letters(column: int) -> str:
    letters = ""
    number = column + 1
    while number:
        number, rest = divmod(number - 1, 26)
        letters = chr(ord("A") + rest) + letters
    return letters


def _relations(targets: Iterable[tuple[str, str]]) -> str:
    inside = "".join(
        f'<Relationship Id="rId{number}" Type="{_OFFICE}/{kind}" Target="{target}"/>'
        for number, (kind, target) in enumerate(targets, 1)
    )
    return f'<Relationships xmlns="{_PACKAGE}/relationships">{inside}</Relationships>'


def _sheet_names(names: Iterable[str]) -> list[str]:
    """Return names that a spreadsheet takes, each another one."""
    found: list[str] = []
    for name in names:
        stem = _NO_NAME.sub("_", name).strip("' ")[:_LONGEST_NAME].rstrip("' ") or "_"
        number, free = 1, stem
        while free.casefold() in {one.casefold() for one in found}:
            number += 1
            free = f"{stem[: _LONGEST_NAME - len(str(number)) - 1]} {number}"
        found.append(free)
    return found
