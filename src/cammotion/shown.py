"""What a notebook shows of things that are best seen as a table."""

from collections.abc import Iterable
from html import escape


def as_table(heading: Iterable[str], rows: Iterable[Iterable[object]]) -> str:
    """Return a table in HTML; numbers have six digits, and texts are shown as they are.

    >>> as_table(["die"], [["<b>"]])
    '<table><tr><th>die</th></tr><tr><td>&lt;b&gt;</td></tr></table>'
    """
    lines = [_line("th", heading), *(_line("td", row) for row in rows)]
    return f"<table>{''.join(lines)}</table>"


def _line(cell: str, values: Iterable[object]) -> str:
    texts = (f"{v:.6g}" if isinstance(v, float) else escape(str(v)) for v in values)
    return f"<tr>{''.join(f'<{cell}>{text}</{cell}>' for text in texts)}</tr>"
