"""A cam table as lines of text, whatever wrote it: encodings, ends of lines, comments."""

import codecs
import re
from collections.abc import Iterator
from typing import Any, NamedTuple

from cammotion.exchange.xlsx_in import OLD, ZIP
from cammotion.files import as_path, read_bytes
from cammotion.quantities import InputError, shorten

LARGEST_BYTES = 50_000_000
"""Of a file: 400,000 points with all derivatives have 32 million."""

_MARKS = {  # at the start of a file; the longer ones first
    codecs.BOM_UTF32_LE: ("utf-32", "UTF-32"),
    codecs.BOM_UTF32_BE: ("utf-32", "UTF-32"),
    codecs.BOM_UTF8: ("utf-8-sig", "UTF-8 with a mark"),
    codecs.BOM_UTF16_LE: ("utf-16", "UTF-16"),
    codecs.BOM_UTF16_BE: ("utf-16", "UTF-16"),
}
_COMMENT = re.compile(r"(?:^|(?<=[\s;,|]))(?:#|//|%|!|\(\*)")
_ERROR_CELL = re.compile(r"#(?:NV|N/A|NAME\?|NUM!|NULL!|[A-Z]+!|DIV/0!)", re.IGNORECASE)
_TITLE = re.compile(r"\D*[^\W\d_]{2}\D*")  # before a sign that is no comment: load %, cam #2
_NO_TEXT = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f]")
_ENDS_INSIDE = re.compile(  # of lines, in a cell in quotes
    r'(?:^|(?<=[;\t,|]))"(?:[^"\n]|"")*(?:\n(?:[^"\n]|"")*){1,3}"(?=[;\t,|]|$)', re.MULTILINE
)
_SEP = re.compile(r' *"?sep=(\\t|.)"?[;, \t]*', re.IGNORECASE)
_BINARY = {**dict.fromkeys(ZIP, "a workbook of a spreadsheet"), OLD: "an old workbook"}


class Line(NamedTuple):
    """A line of a file: its number, counted from 1, its text, and the comment behind it."""

    number: int
    text: str
    comment: str


class Text(NamedTuple):
    """A file: its name, its lines, its encoding in words, and what `sep=` says, else None."""

    name: str
    lines: list[Line]
    encoding: str
    separator: str | None


def read_text(path: Any, encoding: str | None = None) -> Text:
    """Return the lines of a file; raise InputError, in words, for what is no text.

    UTF-8 and UTF-16 with a mark or without, or else cp1252, if no `encoding` is given.
    """
    name, raw = as_path(path).name, read_bytes(path, at_most=LARGEST_BYTES)
    for start, what in _BINARY.items():
        if raw.startswith(start):
            raise InputError(f"The file {name} is {what}: save the sheet as CSV, and read that.")
    text, said = _decoded(raw, name, encoding)
    text = text.rstrip("\x1a\0").replace("\r\n", "\n").replace("\r", "\n")
    numbered = [*_numbered(text)]
    for number, line in numbered:
        if odd := _NO_TEXT.search(line):
            raise InputError(
                f"Line {number} of {name} has a character that is in no text ({odd[0]!r}): save "
                "the table as text, or give the encoding, for example encoding='utf-16'."
            )
    separator = None
    if found := _SEP.fullmatch(numbered[0][1]):
        separator, numbered[0] = found[1].replace("\\t", "\t"), (1, "")
    return Text(name, [_line(*line) for line in numbered], said, separator)


def _numbered(text: str) -> Iterator[tuple[int, str]]:
    """Yield the lines with their numbers; a cell in quotes may hold ends of lines."""
    number = 1
    for line in _ENDS_INSIDE.sub(lambda cell: cell[0].replace("\n", "\r"), text).split("\n"):
        yield number, line.replace("\r", " ")
        number += 1 + line.count("\r")


def _line(number: int, text: str) -> Line:
    found = None if _ERROR_CELL.match(text.strip()) else _COMMENT.search(text)
    if not found or _TITLE.fullmatch(text, 0, found.start()):
        return Line(number, text, "")
    return Line(number, text[: found.start()], text[found.end() :].strip().lstrip("#/%!* \t"))


def _decoded(raw: bytes, name: str, encoding: str | None) -> tuple[str, str]:
    """Return the text of a file, and its encoding in words."""
    for codec, said in _codecs(raw, encoding):
        try:
            return raw.decode(codec), said
        except UnicodeDecodeError:
            continue
        except LookupError:
            raise InputError(
                f"There is no encoding {shorten(encoding)}: give one like 'utf-8' or 'cp1252'."
            ) from None
    raise InputError(
        f"The file {name} is no text in UTF-8, UTF-16 or cp1252: save it as text, or give its "
        "encoding, for example encoding='cp437'."
    )


def _codecs(raw: bytes, encoding: str | None) -> list[tuple[str, str]]:
    """Return the encodings to try, in turn."""
    if encoding is not None:
        return [(str(encoding), str(encoding))]
    for mark, codec in _MARKS.items():
        if raw.startswith(mark):
            return [codec]
    if b"\0" in raw:  # half of the bytes of plain text are zeros
        even, odd = raw[::2].count(0), raw[1::2].count(0)
        return [("utf-16-be" if even > odd else "utf-16-le", "UTF-16 without a mark")]
    return [("utf-8", "UTF-8"), ("cp1252", "cp1252")]
