"""Marks in the table of a cam that may mean two things: of decimals, columns or thousands."""

import re

import numpy as np

from cammotion.exchange.cam_table_cut import DECIMALS, Asked, Columns
from cammotion.exchange.table_numbers import is_grouped, number_of, proves_groups
from cammotion.quantities import InputError, shorten

_ONE_NUMBER, _PADDED = re.compile(r"[-+−]?\d+,\d+"), re.compile(r"0\d")


def check_marks(columns: Columns, asked: Asked) -> None:
    """Raise InputError where a mark that was taken for one thing may be another."""
    _check_cut_in_two(columns, asked)
    _check_one_column(columns, asked)
    if asked.decimal is None:
        _check_groups(columns)


def _check_cut_in_two(columns: Columns, asked: Asked) -> None:
    """Raise InputError where commas may be decimal marks as well as separators."""
    row = columns.rows[0]
    if columns.separator != "," or '"' in row.text or row.width < 3:  # noqa: PLR2004 - a third
        return
    has_point = any("." in cell for row in columns.rows for cell in row.cells)
    if has_point or (asked.separator == "," and asked.decimal == "."):
        return
    raise InputError(
        f"Line {row.line} of {columns.name}, {shorten(row.text.strip())}, has {row.width} "
        "whole numbers between commas, some of which may be decimal marks: give separator=',' and "
        "decimal='.' if none is; else write the table with semicolons between the columns."
    )


def _check_one_column(columns: Columns, asked: Asked) -> None:
    """Raise InputError where the commas of one column of numbers were taken for separators.

    It is one if the places would not rise, or if whole numbers would begin with a 0.
    """
    is_said = asked.separator or asked.columns or asked.decimal == "."
    is_said = is_said or all(one.words for one in columns.headings)
    if is_said or not all(_ONE_NUMBER.fullmatch(row.text.strip()) for row in columns.rows):
        return
    firsts, seconds = (any(map(_PADDED.match, columns.cells(n))) for n in (0, 1))
    if (seconds and not firsts) or (np.diff(columns.numbers[:, 0]) <= 0).any():
        raise InputError(
            f"{columns.where(0)}, {shorten(columns.rows[0].text.strip())}, is one number if its "
            "comma is a decimal mark, and then nothing says at which angle it stands: write the "
            "angle before each number, with a semicolon between, or give separator=',' if there "
            "are two."
        )


def _check_groups(columns: Columns) -> None:
    """Raise InputError where a mark of thousands may be a decimal mark, as in 2,400."""
    for which, values in enumerate(columns.numbers.T):
        cells = columns.cells(which)
        grouped = [n for n, cell in enumerate(cells) if is_grouped(cell, columns.decimal)]
        if any(proves_groups(cells[n], columns.decimal) for n in grouped):
            continue
        other = "," if columns.decimal == "." else "."
        for n in grouped:
            beside = [values[m] for m in (n - 1, n + 1) if 0 <= m < len(values)]
            small = number_of(cells[n], other)
            near = sum(beside) / len(beside) if beside else 0.0
            if small is not None and abs(values[n] - near) >= abs(small - near):
                raise InputError(
                    f"{columns.where(n)}: {cells[n]!r} may be {small:.12g} or {values[n]:.12g}, "
                    f"since other numbers have {DECIMALS[columns.decimal]}: correct the line, or "
                    f"give decimal={columns.decimal!r} if it is {values[n]:.12g}."
                )
