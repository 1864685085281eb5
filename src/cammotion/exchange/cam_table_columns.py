"""Which columns of numbers a text holds: separators, decimal marks, headings and broken rows.

Each separator and each decimal mark is tried. The one with which most lines have two numbers is
taken if every line between them has; two that give different numbers are a question.
"""

import csv
import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property
from itertools import product
from typing import NoReturn

import numpy as np

from cammotion.exchange.all_faults import Faults
from cammotion.exchange.cam_table_cut import DECIMALS, SEPARATORS, Asked, Columns, Row, filled
from cammotion.exchange.cam_table_headings import (
    Heading,
    heading_of,
    odd_unit,
    pick,
    two_headings,
)
from cammotion.exchange.cam_table_marks import check_marks
from cammotion.exchange.cam_table_text import Line, Text
from cammotion.exchange.table_numbers import number_of
from cammotion.quantities import InputError, shorten

_NO_NUMBER = re.compile(
    r"[-+−]?(nan|inf|infinity|n/?a|null|none|nil|err|over(flow|load|range)?)|#.*", re.IGNORECASE
)
_WORD_OF_DIGITS = re.compile(r"\b0\.\.1\b|\bm/s\^?2")
_DAY, _YEAR = r"(0?[1-9]|[12]\d|3[01])", r"(19|20)\d\d"  # or a month
_DATE = re.compile(rf"({_YEAR}-{_DAY}-{_DAY}|{_DAY}[./]{_DAY}[./]{_YEAR})(?!\d)")
_LETTERS = 2  # a word has so many
_LIKE_DIGITS = frozenset("OoIl")  # letters of which a number may be mistyped
_HEADINGS = 2  # lines over the table that may be headings


def columns_of(text: Text, asked: Asked) -> Columns:
    """Return the two columns of a text; raise InputError for what is none, or is ambiguous."""
    attempts = [_Attempt(text, *marks, asked) for marks in _marks(text, asked)]
    most = max(len(attempt.good) for attempt in attempts)
    if not most:
        _refuse_all(text, asked)
    read, wrong = [], []
    for attempt in attempts:
        if len(attempt.good) == most:
            try:
                read.append(attempt.columns())
            except InputError as refused:
                wrong.append(refused)
    if not read:
        raise wrong[0]
    return _the_one(read)


def _refuse_all(text: Text, asked: Asked) -> NoReturn:
    """Raise InputError for a text without a row."""
    lines = (line for line in text.lines if len(re.findall(r"\d+", line.text)) > 1)
    near = next((f" (line {n} is {shorten(said.strip())})" for n, said, _ in lines), "")
    if asked.columns or asked.separator:
        one, other = (place + 1 for place in asked.columns or (0, 1))
        cut = f", cut at its {SEPARATORS[asked.separator]}," if asked.separator else ""
        raise InputError(
            f"The file {text.name}{cut} has no line with numbers in columns {one} and {other}"
            f"{near}: give other columns, counted from 1, or another separator, or leave them out."
        )
    raise InputError(
        f"The file {text.name} has no line with two numbers{near}: give a table with a row for "
        "each angle, in which the angle and the position stand in columns, without units."
    )


def _marks(text: Text, asked: Asked) -> Iterator[tuple[str, str]]:
    """Yield separators with decimal marks, the likely ones first."""
    used = [mark for mark in SEPARATORS if any(mark in line.text for line in text.lines)]
    separator = asked.separator or text.separator
    has_comma = any("," in line.text for line in text.lines)
    decimals = asked.decimal or (".," if has_comma else ".")
    yield from product(separator or used or SEPARATORS, decimals)


def _the_one(read: list[Columns]) -> Columns:
    """Return the reading on which all agree, or that alone whose first column rises."""
    different = [
        n
        for n, one in enumerate(read)
        if not any(np.array_equal(one.numbers, other.numbers) for other in read[:n])
    ]
    if len(different) > 1:
        rising = [n for n in different if (np.diff(read[n].numbers[:, 0]) > 0).all()]
        different = rising or different
    if len(different) == 1:
        return read[different[0]]
    one, other = (read[n] for n in different[:2])
    row = int(np.argmax((one.numbers != other.numbers).any(axis=1)))
    ways = " or ".join(
        f"{numbers[0]:.12g} and {numbers[1]:.12g} "
        f"(separator={each.separator!r}, decimal={each.decimal!r})"
        for each in (one, other)
        for numbers in [each.numbers[row]]
    )
    raise InputError(
        f"{one.where(row)}, {shorten(one.rows[row].text.strip())}, can be read as {ways}: nothing "
        "in the file decides it, so say so with these arguments."
    )


class _Attempt:
    """A text as one separator cuts it."""

    def __init__(self, text: Text, separator: str, decimal: str, asked: Asked) -> None:
        self.name, self.separator, self.decimal = text.name, separator, decimal
        self.asked, self.lines = asked, text.lines
        self.cells = [_cut(line.text, separator) for line in text.lines]
        self.chosen = asked.columns or (0, 1)
        self.good = [n for n in range(len(self.cells)) if self._is_row(n)]

    def columns(self) -> Columns:
        """Return the columns; raise InputError for all lines that break the table."""
        first, last = self.good[0], self.good[-1]
        self._refuse(
            n
            for n in range(len(self.lines))
            if (
                not self._is_row(n) and any(self.cells[n])
                if first <= n <= last
                else not self._may_stand_outside(n, is_above=n < first)
            )
        )
        self._check_widths()
        headings = self._headings()
        if not self.asked.columns:
            self.chosen = pick(headings)
            self._refuse(n for n in self.good if not self._is_row(n))
        rows = [Row(self.lines[n].number, self.lines[n].text, self.cells[n]) for n in self.good]
        numbers = [[number_of(r.cells[c], self.decimal) for c in self.chosen] for r in rows]
        columns = Columns(
            *(self.name, self.separator, self.decimal, rows, headings, self.chosen),
            np.array(numbers, dtype=float),
        )
        check_marks(columns, self.asked)
        return columns

    def _is_row(self, n: int) -> bool:
        cells = self.cells[n]
        return max(self.chosen) < len(cells) and all(
            number_of(cells[place], self.decimal) is not None for place in self.chosen
        )

    def _may_stand_outside(self, n: int, *, is_above: bool) -> bool:
        """Return whether a line above or below the table is no broken row of it."""
        if not any(self.cells[n]):
            return True
        ways: list[tuple[int, ...]] = [self.chosen]
        if is_above and self._begins_with_numbers:  # where titles stand, chosen or not
            ways.append((0, *self.chosen))
        return any(self._is_no_row(n, way, is_above=is_above) for way in ways)

    @cached_property
    def _begins_with_numbers(self) -> bool:
        """Whether the first column of the file is one of numbers."""
        return all(number_of(self.cells[n][0], self.decimal) is not None for n in self.good)

    def _is_no_row(self, n: int, places: Sequence[int], *, is_above: bool) -> bool:
        """Return whether a line is no row, as its first cell of these says, and then the rest."""
        cells = self.cells[n]
        first, *others = (cells[at] if at < len(cells) else "" for at in places)
        number = number_of(first, self.decimal)
        if number is not None:  # alone it may say how many rows there are
            return is_above and sum(map(bool, cells)) == 1 and number == len(self.good)
        if _DATE.match(first):
            return is_above
        if _NO_NUMBER.fullmatch(first):
            return False
        letters = [*filter(str.isalpha, first)]
        has_word = len(letters) >= _LETTERS and not _LIKE_DIGITS.issuperset(letters)
        if not is_above:
            return has_word and not any(map(str.isdigit, self.lines[n].text))
        return has_word or not any(
            map(str.isdigit, _WORD_OF_DIGITS.sub("", "".join([first, *others])))
        )

    def _refuse(self, broken: Iterable[int]) -> None:
        """Raise one InputError for all these lines, unless there is none."""
        faults = Faults()
        for line in (self.lines[n] for n in broken):
            faults.add(
                f"Line {line.number} of {self.name} is {shorten(line.text.strip())}, where a row "
                "with two numbers was expected (cells between "
                f"{SEPARATORS.get(self.separator, 'marks')}, {DECIMALS[self.decimal]}): correct "
                "it, take it out, or make it a comment with # in front."
            )
        faults.check()

    def _check_widths(self) -> None:
        """Raise InputError unless all rows have as many cells, empty ones at the end or not."""
        whole = [len(self.cells[n]) for n in self.good]
        counts = [filled(self.cells[n]) for n in self.good]
        if len(set(whole)) == 1 or len(set(counts)) == 1:
            return
        usual = max(set(counts), key=counts.count)
        odd = next(n for n, count in zip(self.good, counts, strict=True) if count != usual)
        line = self.lines[odd]
        raise InputError(
            f"Line {line.number} of {self.name}, {shorten(line.text.strip())}, has "
            f"{filled(self.cells[odd])} cells and most others have {usual}: correct it."
        )

    def _headings(self) -> list[Heading]:
        """Return what stands over each column."""
        count = max(len(self.cells[n]) for n in self.good)
        words: list[list[str]] = [[] for _ in range(count)]
        for n in self._above():
            cells = [c for c in _cut(_said(self.lines[n]), self.separator) if c]
            if len(cells) == min(count, filled(self.cells[self.good[0]])):
                for word, cell in zip(words, cells, strict=False):
                    word.append(cell)
        if any(words) or not self._above():
            return [heading_of(", ".join(word)) for word in words]
        headings, (first, second) = [Heading("", "")] * count, self.chosen
        headings[first], headings[second] = two_headings(_said(self.lines[self._above()[-1]]))
        return headings

    def _above(self) -> list[int]:
        """Return the lines over the table that may be its headings."""
        found = [
            n
            for n in range(self.good[0])
            if _said(self.lines[n])
            and (
                not any(number_of(cell, self.decimal) is not None for cell in self.cells[n])
                or self._has_factor(n)
            )
        ]
        return found[-_HEADINGS:]

    def _has_factor(self, n: int) -> bool:
        """Return whether spaces make a cell of the factor in a heading like lift in 0.001 in."""
        return self.separator == " " and bool(odd_unit(two_headings(_said(self.lines[n]))[1]))


def _said(line: Line) -> str:
    """Return the text of a line, or its comment if it is nothing else."""
    return line.text if line.text.strip() else line.comment


def _cut(line: str, separator: str) -> list[str]:
    if separator == " ":
        return re.split(r"[ \t]+", line.strip(" \t"))
    if separator == "|":
        line = line.strip().strip("|")
    if '"' in (line := line if separator == "\t" else line.strip()):
        try:
            (cells,) = csv.reader([line], delimiter=separator, strict=True, skipinitialspace=True)
        except (csv.Error, ValueError):
            cells = line.split(separator)
    else:
        cells = line.split(separator)
    return [cell.strip() for cell in cells]
