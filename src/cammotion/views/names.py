"""The names of mechanisms as pictures show them: one line, short, none like another.

A name is shortened here and nowhere else, before any text is laid out: what a long one costs is
then what a short one costs. In full it stands in the words of a picture.
"""

import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from functools import cache
from typing import Any

from matplotlib.axes import Axes
from matplotlib.font_manager import FontProperties, findfont, fontManager, get_font
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.text import Text

MOST = 24  # columns of a name in a picture; an ideograph takes two
TITLE = 48  # of a design, of which a legend holds fewer
ELLIPSIS, MISSING = "…", "□"
_EDGES = f"{ELLIPSIS} "  # of what is left of a name: none stands beside an ellipsis
_LEAST = 8  # columns of a name, which always have room
_OF_A_NUMBER = "0123456789.,-"
_LEGEND, _BELOW_POINTS = 10, 600  # the size of its names, and what they fill below a picture
_FEW = 6  # so many names have room in a legend among curves
_MARKS = 3  # more above and below one letter would run into the next line
_BLANKS = "\u115f\u1160\u2800\u3164\uffa0"  # letters to Python, and nothing to be seen
_OTHER_FONTS = (
    *("Noto Sans CJK JP", "Noto Sans CJK SC", "Noto Sans JP", "Noto Sans SC", "Noto Sans KR"),
    *("Yu Gothic", "MS Gothic", "Microsoft YaHei", "SimHei", "Malgun Gothic", "Hiragino Sans"),
    *("PingFang SC", "Apple SD Gothic Neo", "WenQuanYi Zen Hei", "Arial Unicode MS"),
    *("Noto Sans Arabic", "Noto Sans Devanagari", "Nirmala UI", "Segoe UI Symbol"),
)
"""Where letters are looked for that Matplotlib's own font lacks, if the machine has them."""
_BREAKS = re.compile(r"(?<= )(?!(?:mm|deg)\b)|(?<=\w-)(?=\w)")  # not before the unit of a number


def printable(text: str) -> str:
    r"""Return a text in one line, without what cannot be seen or XML cannot hold.

    >>> printable("a\tlower\u200b jaw\n")
    'a lower jaw'
    """
    seen = (c if c.isprintable() and c not in _BLANKS else _instead_of(c) for c in text)
    return " ".join("".join(seen).split())


def short(name: str, most: int = MOST) -> str:
    """Return a name in at most so many columns, an ellipsis in its middle where it was longer.

    >>> short("the lower left one of both sealing jaws")
    'the lower left…ling jaws'
    """
    many = 8 * most  # of characters, more than are shown: the rest is not looked at
    is_whole = len(name) <= 2 * many
    head = _letters(name if is_whole else name[:many])
    tail = head if is_whole else _letters(name[-many:])
    if is_whole and sum(map(_columns, head)) <= most:
        return "".join(head)
    end = _fitting(tail[::-1], (most - 1) * 2 // 5)[::-1]
    start = _fitting(head, most - 1 - sum(map(_columns, end)))
    return f"{''.join(start).rstrip(_EDGES)}{ELLIPSIS}{''.join(end).lstrip(_EDGES)}"


def short_names(names: Sequence[str], most: int = MOST) -> list[str]:
    r"""Return names in at most so many columns, no two alike, none of them empty.

    One that is empty to the eye is called by its number, and alike ones have theirs behind them.

    >>> short_names(["die", 20 * "jaw ", 30 * "jaw ", "\u200b"], 12)
    ['die', 'jaw jaw… (2)', 'jaw jaw… (3)', 'no. 4']
    """
    return _distinct([short(name, most) for name in names], most)


def labels(names: Sequence[str], most: int = MOST) -> list[str]:
    """Return short names for a picture of Matplotlib, in letters that its fonts have.

    What somebody calls by a number, as in {8: indexer}, has it as its name.
    """
    drawn = [_drawable(short(str(name), most)) for name in names]
    readable = [each if each.strip(f"{MISSING}{ELLIPSIS} ") else "" for each in drawn]
    return _distinct(readable, most)


def names_that_fit(
    names: Sequence[str],
    fits: Callable[[Sequence[str]], bool],
    *,
    most: int = MOST,
    called: Callable[[Sequence[str], int], list[str]] = short_names,
) -> list[str]:
    """Return short names that fit where they stand, at most so many columns long, no two alike.

    They are shortened at once and by as much as it takes: cut there, they could look alike again.

    >>> jaws = ["sealing jaw, left side 1", "sealing jaw, left side 2"]
    >>> names_that_fit(jaws, lambda names: all(len(name) < 15 for name in names))
    ['sealing…ide 1', 'sealing…ide 2']
    """
    found = called(names, most)
    while most > _LEAST and not fits(found):
        most -= 1
        found = called(names, most)
    return found


def by_name(names: Iterable[str], most: int = MOST) -> dict[str, str]:
    """Return the label of each of several names, by the name."""
    given = [*names]
    return dict(zip(given, labels(given, most), strict=True))


def as_label(name: str) -> str:
    """Return what to label a curve with: a name with _ before it is hidden from Matplotlib."""
    return f" {name}" if name.startswith("_") else name


def plain(*texts: Text) -> None:
    """Let texts of Matplotlib be drawn as they are: $ begins no formula, and no letter warns."""
    for text in texts:
        text.set_parse_math(False)
        words = text.get_text()
        if not words.isascii() or not words.isprintable():
            text.set_text("\n".join(map(_drawable, words.split("\n"))))
            text.set_fontfamily(_families())


def name_line(line: Line2D, name: str, full_name: str) -> Line2D:
    """Give a line a short name for a legend, and for the words of the picture its full one."""
    line.set_label(as_label(name))
    line.set_gid(str(full_name))
    return line


def add_legend(ax: Axes, **place: Any) -> Legend:
    """Add a legend, in which names stand as they are, and return it."""
    _, names = ax.get_legend_handles_labels()
    if len(names) > _FEW and place.get("loc") == "upper right":  # no room among the curves
        place = {"loc": "upper left", "bbox_to_anchor": (1, 1), "frameon": False}
    legend = ax.legend(fontsize=_LEGEND, **place)
    plain(*legend.get_texts())
    return legend


def add_legend_below(ax: Axes, columns: int) -> None:
    """Add a legend under axes of our usual width, in so many columns if its names are short."""
    _, names = ax.get_legend_handles_labels()
    below: dict[str, Any] = {"loc": "upper center", "bbox_to_anchor": (0.5, -0.16)}
    add_legend(ax, **below, ncols=columns_below(names, columns), frameon=False)


def columns_below(names: Iterable[str], columns: int) -> int:
    """Return in how many columns names have room under axes, at most so many.

    >>> columns_below(["die", "mill"], 2), columns_below(["die", 60 * "x"], 2)
    (2, 1)
    """
    widest = max(text_px(name, _LEGEND) for name in names)
    return max(1, min(columns, int(_BELOW_POINTS / widest)))


def text_px(text: str, size: float, *, bold: bool = False) -> float:
    """Return how wide a text becomes in the widest of the fonts, about, in the unit of `size`."""
    return size * (1.13 if bold else 1) * sum(map(_ems, text))


def cut(text: str, width: float, size: float, *, bold: bool = False) -> str:
    """Return a line with an ellipsis at its end where it could be wider than `width`.

    A number stays whole or is left out, unless the line begins with it.

    >>> cut("gripper at 110 mm", 200, 10), cut("gripper at 110 mm", 72, 10)
    ('gripper at 110 mm', 'gripper at…')
    """
    room, whole = width - text_px(ELLIPSIS, size, bold=bold), 0.0
    shown = ""
    for c in text:
        whole += text_px(c, size, bold=bold)
        if whole > width:
            goes_on = text[len(shown)] in _OF_A_NUMBER
            ends = shown.rstrip(_OF_A_NUMBER) if goes_on else shown
            return (ends or shown).rstrip() + ELLIPSIS
        if whole <= room:
            shown += c
    return text


def wrap(
    text: str, width: float, size: float, *, bold: bool = False, most: int | None = None
) -> list[str]:
    """Return a text in lines that are not wider than `width`, broken in a word only if need be.

    Where that is more than `most` lines, the last one ends in an ellipsis.

    >>> wrap("the upper-left jaw, 12 mm", 90, 10), wrap("the upper-left jaw", 90, 10, most=1)
    (['the upper-left', 'jaw, 12 mm'], ['the upper-left…'])
    """

    def fits(line: str) -> bool:
        return text_px(line.rstrip(), size, bold=bold) <= width

    lines = [""]
    for piece in _BREAKS.split(text):
        for part in [piece] if fits(piece) else piece:
            if lines[-1] and not fits(lines[-1] + part):
                lines.append("")
            lines[-1] += part
    if most and len(lines) > most:
        lines[most - 1 :] = [cut("".join(lines[most - 1 :]), width, size, bold=bold)]
    return [line.rstrip() for line in lines]


def _letters(text: str) -> list[str]:
    """Return the letters of a text, each with the marks above and below it."""
    letters: list[str] = []
    for c in unicodedata.normalize("NFC", printable(text)):
        if not unicodedata.category(c).startswith("M"):
            letters.append(c)
        elif letters and len(letters[-1]) <= _MARKS:
            letters[-1] += c
    return letters


def _fitting(letters: Iterable[str], columns: int) -> list[str]:
    """Return the first letters, as many as fit into so many columns."""
    fitting = []
    for letter in letters:
        columns -= _columns(letter)
        if columns < 0:
            break
        fitting.append(letter)
    return fitting


def _columns(letter: str) -> int:
    return 2 if unicodedata.east_asian_width(letter[0]) in "WF" else 1


def _distinct(names: Sequence[str], most: int) -> list[str]:
    times = Counter(names)
    numbered = [
        name if name and times[name] == 1 else _numbered(name, number, most)
        for number, name in enumerate(names, start=1)
    ]
    if len({*numbered}) == len(numbered):
        return numbered
    return [_numbered(name, number, most) for number, name in enumerate(names, start=1)]


def _numbered(name: str, number: int, most: int) -> str:
    """Return a name with its number, within so many columns."""
    if not name:
        return f"no. {number}"
    behind = f" ({number})"
    room = most - len(behind)
    letters = _letters(name)
    if sum(map(_columns, letters)) > room:
        return f"{''.join(_fitting(letters, room - 1)).rstrip(_EDGES)}{ELLIPSIS}{behind}"
    return name + behind


def _instead_of(character: str) -> str:
    """Return nothing for what only says how others are set, and a space for what parts them."""
    return "" if unicodedata.category(character) == "Cf" else " "


def _drawable(text: str) -> str:
    """Return a line with a box for each letter that no font here has."""
    if text.isascii() and text.isprintable():
        return text
    families = _families()
    return "".join(c if _has_glyph(c, families) else MISSING for c in printable(text))


@cache
def _has_glyph(character: str, families: tuple[str, ...]) -> bool:
    return any(_font(family).get_char_index(ord(character)) for family in families)


def _families() -> tuple[str, ...]:
    """Return the fonts of Matplotlib's settings, and those of the others that are here."""
    return (*FontProperties().get_family(), *_other_families())


@cache
def _other_families() -> tuple[str, ...]:
    known = {font.name for font in fontManager.ttflist}
    return tuple(name for name in _OTHER_FONTS if name in known)


@cache
def _font(family: str) -> Any:
    return get_font(findfont(FontProperties(family=[family])))


def _ems(character: str) -> float:
    """Return how wide a character is, in the widest of the fonts."""
    if unicodedata.east_asian_width(character) in "WF" or character in "mwMW@%…":
        return 1.0
    if unicodedata.category(character).startswith("M"):
        return 0.0
    if character in "fijlrt.,;:()'|! -":
        return 0.42
    return 0.74 if character.isupper() else 0.64
