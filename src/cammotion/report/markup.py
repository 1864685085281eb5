"""Parts of a page: tables, numbers that open, pictures with their words."""

import base64
from collections.abc import Iterable, Sequence
from html import escape
from typing import NamedTuple
from urllib.parse import quote

from cammotion.quantities import as_text
from cammotion.views.whole_page import wide_table


class Opened(NamedTuple):
    """A number or a word that opens to where it comes from."""

    shown: str
    whence: str


Cell = str | float | Opened


class Beside(NamedTuple):
    """What is said of files beside the page, with their paths from there; none where none is."""

    said: str
    paths: Sequence[str] = ()


def short(value: float) -> str:
    """Return a number with four digits."""
    return as_text(value, ".4g")


def beside(one: Beside) -> str:
    """Return what is said of files, with links to them."""
    links = ", ".join(f'<a href="{quote(path)}">{escape(path)}</a>' for path in one.paths)
    return f"{links}{': ' if links else ''}{escape(one.said)}"


def table(caption: str, heading: Sequence[str], rows: Iterable[tuple[bool, Sequence[Cell]]]) -> str:
    """Return a table; a row comes with whether it is to be marked as broken."""
    head = "".join(f'<th scope="col">{escape(name)}</th>' for name in heading)
    body = "".join(
        f"<tr{_BROKEN if broken else ''}>"
        f"{''.join(_cell(cell, n, heading[n]) for n, cell in enumerate(row))}</tr>\n"
        for broken, row in rows
    )
    return wide_table(caption, head, body)


def opened(one: Opened) -> str:
    """Return something that opens to where it comes from."""
    return f"<details><summary>{escape(one.shown)}</summary><p>{escape(one.whence)}</p></details>"


def paragraph(text: str, kind: str = "") -> str:
    """Return a paragraph, of a kind that has a colour if one is given."""
    return f"<p{f' class={chr(34)}{kind}{chr(34)}' if kind else ''}>{escape(text)}</p>\n"


def picture(content: bytes, mime: str, words: str) -> str:
    """Return a picture that is a part of the page, with its words for who does not see it."""
    data = base64.b64encode(content).decode("ascii")
    return f'<figure><img alt="{escape(words)}" src="data:{mime};base64,{data}"></figure>\n'


_BROKEN = ' class="broken"'


def _cell(cell: Cell, column: int, head: str) -> str:
    """Return a cell; on a narrow page it stands in a line of its own, beside its heading."""
    named = f' data-head="{escape(head)}"'
    if isinstance(cell, Opened):
        return f'<td class="number"{named}>{opened(cell)}</td>'
    if isinstance(cell, float):
        return f'<td class="number"{named}>{short(cell)}</td>'
    tag, of_it = ("td", named) if column else ("th", ' scope="row"')
    return f"<{tag}{of_it}>{escape(cell)}</{tag}>"
