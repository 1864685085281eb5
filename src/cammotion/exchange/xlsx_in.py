"""The sheets of an .xlsx workbook as rows of texts, by the standard library alone.

Such a file is a zip of XML files, and a stranger's may be anything. So each part is read up to a
limit, whatever the file says of its size; what has entities of its own is refused.
"""

import io
import re
import zipfile
import zlib
from collections.abc import Iterator
from posixpath import dirname, join, normpath
from typing import NamedTuple
from xml.etree import ElementTree

from cammotion.exchange.cells import Plain
from cammotion.quantities import InputError

LARGEST = 20_000_000  # bytes that all parts together may unpack to
MOST_PARTS, MOST_ROWS, MOST_COLUMNS = 1000, 20_000, 200
ZIP, OLD = (b"PK\x03\x04", b"PK\x05\x06"), b"\xd0\xcf\x11\xe0"
"""What a zip begins with, and an old workbook or one that is locked by a password."""

A_DATE = " as a date"
"""What stands behind a number that a cell shows as a date or a time."""

_BOOK = "xl/workbook.xml"
_ESCAPED = re.compile(r"_x(?![Dd][89A-Fa-f])([0-9A-Fa-f]{4})_")  # no half of a character
_REFERENCE = re.compile(r"([A-Z]{1,3})([1-9][0-9]{0,6})")
_RELATION = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
_STRICT_RELATION = "{http://purl.oclc.org/ooxml/officeDocument/relationships}id"

_PERCENT, _DATE = "%", "date"  # what a number is shown as
_FORMATS = {9: _PERCENT, 10: _PERCENT, **dict.fromkeys([*range(14, 23), 45, 46, 47], _DATE)}
_NO_FORMAT = re.compile(r'"[^"]*"|\\.|\[[^\]]*\]')  # words, signs and colours in a format
_OF_A_DATE = re.compile(r"(?<![a-z])[dmyhs]+(?![a-z])")

Rows = list[list[str]]


class _NoDoctype(ElementTree.TreeBuilder):
    """A builder that refuses what no spreadsheet writes: a DOCTYPE, and with it all entities."""

    def doctype(self, *_: object) -> None:
        raise ElementTree.ParseError("a DOCTYPE")


def read_sheets(file: str, content: bytes) -> dict[str, Rows]:
    """Return the rows of each sheet by its name; `file` is the name to tell in an InputError.

    Sheets in sight come first. Numbers come as Python writes them, each a Plain one, but as a text
    where the sheet shows a date or a percentage; True as "yes", False as "". A formula that no
    spreadsheet has computed yet comes as it is, like "=B2".
    """
    if content.startswith(OLD):
        raise InputError(
            f"The file {file} is an old workbook, or one with a password: save it as .xlsx without "
            "a password, or as CSV."
        )
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as opened:
            return {name: _rows(file, *parts) for name, parts in _parts(_Book(file, opened))}
    except InputError:
        raise
    except (
        zipfile.BadZipFile,
        zlib.error,
        ElementTree.ParseError,
        EOFError,
        RuntimeError,  # a part is encrypted
        OSError,
        ValueError,
        LookupError,
        OverflowError,
    ):
        raise InputError(
            f"The workbook {file} is damaged: open it in the spreadsheet and save it again, or "
            "save the sheet as CSV."
        ) from None


class _Book:
    """The parts of a workbook, of which no more is unpacked than any table of a machine needs."""

    def __init__(self, file: str, opened: zipfile.ZipFile) -> None:
        self.file, self.names = file, opened.namelist()
        self._opened, self._left = opened, LARGEST

    def xml(self, part: str) -> ElementTree.Element:
        """Return the XML of a part."""
        with self._opened.open(part) as packed:
            content = packed.read(self._left + 1)
        self._left -= len(content)
        if self._left < 0:
            raise InputError(
                f"The workbook {self.file} unpacks to more than {LARGEST // 1_000_000} MB: a "
                "machine needs far less. Save its sheet alone as CSV."
            )
        parser = ElementTree.XMLParser(target=_NoDoctype())  # noqa: S314 - no entity passes
        parser.feed(content)
        root: ElementTree.Element = parser.close()
        return root


class _Shared(NamedTuple):
    """What all sheets share: texts, and as what the numbers of each style are shown."""

    texts: list[str]
    styles: list[str]


def _parts(book: _Book) -> Iterator[tuple[str, tuple[ElementTree.Element, _Shared]]]:
    """Yield the name of each sheet, with its XML and what all sheets share."""
    if _BOOK not in book.names:
        raise InputError(
            f"The file {book.file} is a zip of something else, not a workbook: give an .xlsx file "
            "that a spreadsheet has saved, or CSV."
        )
    if len(book.names) > MOST_PARTS:
        raise InputError(
            f"The workbook {book.file} has {len(book.names)} parts: save the sheet as CSV."
        )
    places = {
        relation.get("Id"): normpath(join(dirname(_BOOK), str(relation.get("Target"))))
        for relation in book.xml("xl/_rels/workbook.xml.rels")
    }
    texts, styles = (
        book.xml(part) if part in book.names else ElementTree.Element("none")
        for part in ("xl/sharedStrings.xml", "xl/styles.xml")
    )
    shared = _Shared([_text(one) for one in _named(texts, "si")], _styles(styles))
    sheets = _named(book.xml(_BOOK), "sheet")
    for sheet in sorted(sheets, key=lambda one: one.get("state", "visible") != "visible"):
        where = str(places[sheet.get(_RELATION) or sheet.get(_STRICT_RELATION)])
        if "worksheets/" in where:  # no sheet of charts
            yield str(sheet.get("name")), (book.xml(where.removeprefix("/")), shared)


def _styles(styles: ElementTree.Element) -> list[str]:
    """Return as what the numbers of each style are shown, "" for numbers."""
    own = {one.get("numFmtId"): one.get("formatCode", "") for one in _named(styles, "numFmt")}
    numbers = [one.get("numFmtId", "0") for xfs in _named(styles, "cellXfs") for one in xfs]
    return [_shown(own[n]) if n in own else _FORMATS.get(int(n), "") for n in numbers]


def _shown(code: str) -> str:
    signs = _NO_FORMAT.sub("", code).lower()
    return _PERCENT if "%" in signs else _DATE if _OF_A_DATE.search(signs) else ""


def _rows(file: str, sheet: ElementTree.Element, shared: _Shared) -> Rows:
    rows: Rows = []
    number = 0
    for row in _named(sheet, "row"):
        number = int(row.get("r") or number + 1)
        cells: dict[int, str] = {}
        column = -1
        for cell in _named(row, "c"):
            found = _REFERENCE.fullmatch(cell.get("r") or "")
            column = _column(found[1]) if found else column + 1
            if text := _value(cell, shared):
                cells[column] = text
        if cells and (number > MOST_ROWS or max(cells) >= MOST_COLUMNS or number <= len(rows)):
            raise InputError(
                f"The workbook {file} has a cell in row {number}, column {max(cells) + 1}; a table "
                f"of a machine has at most {MOST_ROWS} rows and {MOST_COLUMNS} columns: delete "
                "what is far from it, or save the table as CSV."
            )
        if cells:
            rows += [[] for _ in range(number - len(rows) - 1)]
            rows.append([cells.get(column, "") for column in range(max(cells) + 1)])
    return rows


def _column(letters: str) -> int:
    number = 0
    for letter in letters:
        number = 26 * number + ord(letter) - ord("A") + 1
    return number - 1


def _value(cell: ElementTree.Element, shared: _Shared) -> str:
    """Return what a cell holds, as a text."""
    kind = cell.get("t", "n")
    if kind == "inlineStr":
        return _text(cell)
    inside = {_tag(one): one.text or "" for one in cell}
    value = inside.get("v", "")
    if "f" in inside and "v" not in inside:
        return f"={inside['f']}"
    if kind == "s":
        return shared.texts[int(value)]
    if kind == "b":
        return "yes" if value == "1" else ""
    if kind == "n" and value:
        return _number(float(value), shared.styles[int(cell.get("s", "0")) :][:1])
    return _unescaped(value)


def _number(number: float, style: list[str]) -> str:
    """Return a number as a text; what is shown as something else is no number for us."""
    if style == [_PERCENT]:
        return f"{100 * number:g} %"
    text = repr(number).removesuffix(".0")
    return f"{text}{A_DATE}" if style == [_DATE] else Plain(text)


def _text(element: ElementTree.Element) -> str:
    """Return the text of a string in all its runs; how it is pronounced does not belong to it."""
    if _tag(element) == "rPh":
        return ""
    if _tag(element) == "t":
        return _unescaped(element.text or "")
    return "".join(map(_text, element))


def _unescaped(text: str) -> str:
    """Return a text with the characters that XML does not keep, like _x000D_."""
    return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), text)


def _named(root: ElementTree.Element, tag: str) -> Iterator[ElementTree.Element]:
    return (element for element in root.iter() if _tag(element) == tag)


def _tag(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2]
