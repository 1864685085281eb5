"""What a timing chart says of its rules: whole ones, wrapped into the lines that a block has."""

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from cammotion.quantities import as_text
from cammotion.rules.rule import Clearance, Rule, Violation
from cammotion.views.chart_lanes import MM_PER_POINT
from cammotion.views.names import TITLE, printable, short, wrap

BLOCK_MM = 26.0  # high is a block at least
FIRST_MM = 4.0  # under the top of the block is the middle of the first line
INDENT_MM = 3.0  # of the further lines of a rule
_LAST_MM = 4.0  # over its foot is that of the last one
_SIZES = (7.0, 5.0)  # of the letters, in points; small ones where broken rules lack room
_LINE = 4.2 / 7.0  # from line to line, in mm for each point of that size


class Said(NamedTuple):
    """A rule with what it has left, in lines; those of a broken one are bold."""

    lines: list[str]
    is_broken: bool


class Block(NamedTuple):
    """What a block says of the rules, how large its letters are in points, how high it is in mm."""

    said: list[Said]
    size: float
    high_mm: float

    @property
    def line_mm(self) -> float:
        """How far its lines are apart."""
        return _LINE * self.size


def lay_out(
    left: Sequence[Clearance],
    violations: Iterable[Violation],
    called: Mapping[str, str],
    room: tuple[float, float],
) -> Block:
    """Return what a block says: as many rules as have room, broken ones first, and how many more.

    `called` is what the motions are called there. `room` is how wide a line may be and how high the
    block, in mm: it is only as high as the broken rules need.
    """
    wide, most = room
    broken = {found.rule for found in violations}
    ordered = sorted(left, key=lambda one: (one.rule not in broken, one.clearance_mm))
    told = [(_words(one, called, one.rule in broken), one.rule in broken) for one in ordered]
    block = Block([], _SIZES[0], BLOCK_MM)
    for size in _SIZES:
        said = [
            Said(wrap(words, (wide - INDENT_MM) / MM_PER_POINT, size, bold=bold), bold)
            for words, bold in told
        ]
        lines = sum(len(each.lines) for each in said if each.is_broken)
        needed = lines + any(not each.is_broken for each in said)
        high = FIRST_MM + (needed - 1) * _LINE * size + _LAST_MM
        block = Block(said, size, min(max(high, BLOCK_MM), most))
        if high <= most:
            break
    rows = 1 + int((block.high_mm - FIRST_MM - _LAST_MM) / block.line_mm + 1e-9)
    return block._replace(said=_fitting(block.said, rows))


def _words(found: Clearance, called: Mapping[str, str], is_broken: bool) -> str:
    mm = round(found.clearance_mm, 9) + 0.0
    kept = f"kept, {as_text(mm, '.3g')} mm left" if math.isfinite(mm) else "kept"
    left = f"BROKEN by {as_text(-mm, '.3g')} mm" if is_broken else kept
    return printable(f"{left}: {_rule(found.rule, called)}")


def _rule(rule: Rule, called: Mapping[str, str]) -> str:
    """Return a rule in words, also where someone gave it a name of many lines."""
    named = f"{short(rule.name, TITLE)}: " if rule.name else ""
    return named + rule.renamed(called).describe()


def _fitting(said: Sequence[Said], rows: int) -> list[Said]:
    """Return what fits into so many rows, with a last one that counts the rest if there is any."""
    if sum(len(each.lines) for each in said) <= rows:
        return [*said] or [Said(["no rules given"], is_broken=False)]
    shown: list[Said] = []
    for each in said:
        rows -= len(each.lines)
        if rows < 1:
            break
        shown.append(each)
    rest = said[len(shown) :]
    missing = sum(each.is_broken for each in rest)
    if missing:
        return [*shown, Said([f"and {len(rest)} more, {missing} of them broken"], is_broken=True)]
    broken = sum(each.is_broken for each in said)
    return [*shown, Said([f"and {len(rest)} more, {broken} of all are broken"], is_broken=False)]
