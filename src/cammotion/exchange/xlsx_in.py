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
from xml.etree import ElementTree

from cammotion.exchange.cells import Plain
from cammotion.quantities import InputError

LARGEST = 20_000_000  # bytes that all parts together may unpack to
MOST_PARTS, MOST_ROWS, MOST_COLUMNS = 1000, 20_000, 200
ZIP, OLD = b"PK", b"\xd0\xcf\x11\xe0"
"""What a zip begins with, and an old workbook or one that is locked by a password."""

_BOOK = "xl/workbook.xml"
_ESCAPED = re.compile(r"_x(?![Dd][89A-Fa-f])([0-9A-Fa-f]{4})_")  # no half of a character
_REFERENCE = re.compile(r"([A-Z]{1,3})([1-9][0-9]{0,6})")
_RELATION = "{http://schemas.openxmlformats.org/officeDocument/2006/relationships}id"
_STRICT_RELATION = "{http://purl.oclc.org/ooxml/officeDocument/relationships}id"

Rows = list[list[str]]


class _NoDoctype(ElementTree.TreeBuilder):
    """A builder that refuses what no spreadsheet writes: a DOCTYPE, and with it all entities."""

    def doctype(self, *_: object) -> None:
        raise ElementTree.ParseError("a DOCTYPE")


def read_sheets(file: str, content: bytes) -> dict[str, Rows]:
    """Return the rows of each sheet by its name; `file` is the name to tell in an InputError.

    Numbers come as Python writes them, each a Plain one; True as "yes", False as "".
    """
    if content.startswith(OLD):
        raise InputError(
            f"The file {file} is an old workbook, or one with a password: save it as .xlsx without "
            "a password, or as CSV."
        )
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as opened:
            return {name: _rows(file, *parts) for name, parts in _parts(_Book(file, opened))}
    except (
        zipfile.BadZipFile,
        zlib.error,
        ElementTree.ParseError,
        EOFError,
        RuntimeError,  # a part is encrypted
        NotImplementedError,
        OSError,
        ValueError,
        LookupError,
        OverflowError,
    ) as wrong:
        if isinstance(wrong, InputError):
            raise
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


def _parts(book: _Book) -> Iterator[tuple[str, tuple[ElementTree.Element, list[str]]]]:
    """Yield the name of each sheet, with its XML and the texts that all sheets share."""
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
    shared_at = "xl/sharedStrings.xml"
    shared = []
    if shared_at in book.names:
        shared = [_text(one) for one in _named(book.xml(shared_at), "si")]
    for sheet in _named(book.xml(_BOOK), "sheet"):
        where = str(places[sheet.get(_RELATION) or sheet.get(_STRICT_RELATION)])
        if "worksheets/" in where:  # no sheet of charts
            yield str(sheet.get("name")), (book.xml(where.removeprefix("/")), shared)


def _rows(file: str, sheet: ElementTree.Element, shared: list[str]) -> Rows:
    rows: Rows = []
    for row in _named(sheet, "row"):
        number = int(row.get("r") or len(rows) + 1)
        cells: dict[int, str] = {}
        for cell in _named(row, "c"):
            found = _REFERENCE.fullmatch(cell.get("r") or "")
            column = _column(found[1]) if found else max(cells, default=-1) + 1
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


def _value(cell: ElementTree.Element, shared: list[str]) -> str:
    """Return what a cell holds, as a text."""
    kind = cell.get("t", "n")
    if kind == "inlineStr":
        return _text(cell)
    value = next((one.text or "" for one in _named(cell, "v")), "")
    if kind == "s":
        return shared[int(value)]
    if kind == "b":
        return "yes" if value == "1" else ""
    if kind == "n" and value:
        return Plain(repr(float(value)).removesuffix(".0"))
    return _unescaped(value)


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
