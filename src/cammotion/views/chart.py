"""The timing chart as one page that a workshop prints and hangs up, in black on white.

All is drawn in mm on A4: a lane for each mechanism between the lines of every 10 deg, and below
them what the page is of. A larger sheet is the same page, enlarged.
"""

import datetime
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure

from cammotion.arguments import checked
from cammotion.files import ending, write_new
from cammotion.machine.diagram import TimingDiagram, as_diagram
from cammotion.machine.kinematics import arc_mm
from cammotion.measured.inch import MM_PER_INCH
from cammotion.quantities import one_of
from cammotion.rules.checks import every_rule, find_clearances, find_violations
from cammotion.rules.rule import Rule
from cammotion.views.chart_lanes import (
    FULL_MM,
    MM_PER_POINT,
    Paper,
    beside,
    draw_grid,
    draw_lane,
    draw_violation,
    lane_names,
)
from cammotion.views.chart_rules import BLOCK_MM, FIRST_MM, INDENT_MM, Block, lay_out
from cammotion.views.named import readable
from cammotion.views.names import TITLE, by_name, cut, printable
from cammotion.views.pictures import on_paper
from cammotion.views.scales import short_number

PAPERS = {"A4": 297.0, "A3": 420.0}  # their widths in mm, lying
_WIDTH, _HEIGHT = 297.0, 210.0
_KINDS = {".pdf": "pdf", ".svg": "svg", ".png": "png"}
_DPI = 200  # of a PNG
_MARGIN = 10.0  # of the page, in mm
_TOP, _UNDER = 9.0, 6.0  # over and under the lanes
_NAMES, _PEAKS, _TITLE = 40.0, 33.0, 119.0  # wide is what stands beside and below the lanes
_BESIDE_RULES = 3.0  # of room at both sides of their lines


@checked
def write_chart(  # noqa: PLR0913 - what a page may have is given by name
    diagram: TimingDiagram,
    path: str | Path,
    *,
    title: str = "Timing chart",
    rules: Rule | Iterable[Rule] = (),
    paper: str = "A3",
    radius_mm: Mapping[str, float] | None = None,
    date: str | None = None,
    overwrite: bool = False,
) -> Path:
    """Write the timing chart as one page to be printed and hung up; return its path.

    The name of the file ends in .pdf or .svg, which hold lines and letters, or in .png. Each
    mechanism has a lane with its displacement over the cam angle, its name and stroke, the angle at
    each corner, its peak acceleration and its laws; there is a line every 10 deg. Where one of the
    `rules` is broken its two lanes are hatched. Below stand what each rule has left, the broken
    ones first, `title`, the machine rate and the `date`, today unless it is given. Long names have
    two lines or are shortened, none like another; rules and laws that have no room are counted.
    `paper` is "A3" or "A4", lying; the page is black on white. `radius_mm` says by the name of a
    motion that turns at which radius its mm are measured; its stroke is given in deg too. A file
    that is there already is left as it is, with an InputError, unless `overwrite` is True; raises
    InputError also for more than 24 mechanisms, another paper and another kind of file.

    >>> from tempfile import TemporaryDirectory
    >>> import cammotion as cm
    >>> with TemporaryDirectory() as folder:
    ...     page = write_chart(cm.EXAMPLE.diagram, f"{folder}/chart.pdf", rules=cm.EXAMPLE.rule)
    ...     page.read_bytes()[:5]
    b'%PDF-'
    """
    suffix = ending(path, "chart", [*_KINDS])
    width = PAPERS[one_of("paper", paper, PAPERS)]
    given = every_rule(diagram, rules)
    radii = _radii(diagram, radius_mm or {})
    day = datetime.date.today().isoformat() if date is None else date
    with mpl.rc_context({"pdf.fonttype": 42, "svg.fonttype": "none", "svg.hashsalt": "chart"}):
        page = draw_chart(diagram, width / _WIDTH, (title, day), given, radii)
        content = io.BytesIO()
        metadata: Any = None if suffix == ".png" else _metadata(suffix, printable(title))
        page.savefig(content, format=_KINDS[suffix], dpi=_DPI, metadata=metadata, facecolor="white")
    return write_new(path, content.getvalue(), overwrite=overwrite)


@on_paper
def draw_chart(
    diagram: TimingDiagram,
    scale: float,
    heading: tuple[str, str],
    rules: Sequence[Rule],
    radii_mm: Mapping[str, float],
) -> Figure:
    """Return the page, so many times as large as A4; `heading` is its title and its date."""
    size = scale * _WIDTH / MM_PER_INCH, scale * _HEIGHT / MM_PER_INCH
    page = Figure(figsize=size, facecolor="white")
    ax = page.add_axes((0, 0, 1, 1))
    ax.set_axis_off()
    ax.set(xlim=(0, _WIDTH), ylim=(0, _HEIGHT))
    names = readable(diagram).names
    violations = find_violations(diagram, rules)
    split = _WIDTH - _MARGIN - _TITLE
    block = lay_out(
        find_clearances(diagram, rules),
        violations,
        by_name(names, TITLE),
        (split - _MARGIN - 2 * _BESIDE_RULES, _most_block(len(names))),
    )
    paper = Paper(
        ax,
        left=_MARGIN + _NAMES,
        right=_WIDTH - _MARGIN - _PEAKS,
        top=_HEIGHT - _MARGIN - _TOP,
        bottom=_MARGIN + block.high_mm + _UNDER,
        lanes=len(names),
        scale=scale,
    )
    _frame(paper, (_MARGIN, _MARGIN), (_WIDTH - _MARGIN, _HEIGHT - _MARGIN))
    draw_grid(paper, _MARGIN, _WIDTH - _MARGIN)
    _draw_lanes(paper, diagram, radii_mm)
    for found in violations:
        rows = [names.index(name) for name in found.rule.motions]
        draw_violation(paper, rows, (found.start_deg, found.end_deg))
    _write_rules(paper, block, (_MARGIN, split))
    _write_title(paper, diagram, heading, (split, _WIDTH - _MARGIN))
    return page


def _draw_lanes(paper: Paper, diagram: TimingDiagram, radii_mm: Mapping[str, float]) -> None:
    called = lane_names(paper, diagram.names)
    for number, motion in enumerate(diagram.motions):
        peak = diagram.peak_acceleration(motion.name)
        said = beside(motion, peak, radii_mm.get(motion.name))
        draw_lane(paper, number, motion, called[number], said)


def _most_block(lanes: int) -> float:
    """Return how high the block below may become, which leaves lanes what their texts need."""
    return max(_HEIGHT - 2 * _MARGIN - _TOP - _UNDER - lanes * FULL_MM, BLOCK_MM)


def _write_rules(paper: Paper, block: Block, ends: tuple[float, float]) -> None:
    """Write what each rule has left, those that are broken first."""
    start, end = ends
    top = _MARGIN + block.high_mm
    _frame(paper, (start, _MARGIN), (end, top))
    y = top - FIRST_MM
    for lines, is_broken in block.said:
        for number, line in enumerate(lines):
            x = start + _BESIDE_RULES + (INDENT_MM if number else 0)
            _write(paper, (x, y), line, end - _BESIDE_RULES - x, block.size, bold=is_broken)
            y -= block.line_mm


def _write_title(
    paper: Paper, diagram: TimingDiagram, heading: tuple[str, str], ends: tuple[float, float]
) -> None:
    (title, date), (start, end) = heading, ends
    top, third = _MARGIN + BLOCK_MM, (end - start) / 3
    _frame(paper, (start, _MARGIN), (end, top))
    _write(paper, (start + 4, top - 8), title, end - start - 8, 15, bold=True)
    rpm = short_number(diagram.rpm, 1)
    cells = {
        "rate": f"{diagram.rate_per_hour:.6g} pieces/h",
        "camshaft, time of a turn": f"{rpm} rpm, {diagram.cycle_time_s:.4g} s",
        "date": date,
    }
    _line(paper, (start, top - 15), (end, top - 15))
    for number, (what, value) in enumerate(cells.items()):
        x = start + number * third
        if number:
            _line(paper, (x, _MARGIN), (x, top - 15))
        _write(paper, (x + 2, top - 17.5), what, third - 4, 5.5)
        _write(paper, (x + 2, _MARGIN + 4), value, third - 4, 8)


def _write(  # noqa: PLR0913, PLR0917 - a text, where it stands and how large it is
    paper: Paper,
    at: tuple[float, float],
    text: str,
    room: float,
    size: float,
    bold: bool = False,
) -> None:
    shown = cut(printable(text), room / MM_PER_POINT, size, bold=bold)
    weight = "bold" if bold else "normal"
    paper.write(*at, shown, size, weight=weight)


def _line(paper: Paper, *places: tuple[float, float]) -> None:
    x, y = zip(*places, strict=True)
    paper.line(x, y, 0.5)


def _frame(paper: Paper, lower: tuple[float, float], upper: tuple[float, float]) -> None:
    (left, bottom), (right, top) = lower, upper
    _line(paper, lower, (right, bottom), upper, (left, top), lower)


def _radii(diagram: TimingDiagram, radius_mm: Mapping[str, float]) -> dict[str, float]:
    for radius in radius_mm.values():
        arc_mm(1, radius)
    return {as_diagram(diagram)[name].name: radius for name, radius in radius_mm.items()}


def _metadata(suffix: str, title: str) -> dict[str, str | None]:
    """Return what a file says of itself: nothing of when or by what it was made."""
    if suffix == ".svg":
        return {"Title": title, "Date": None, "Creator": None}
    return {"Title": title, "CreationDate": None, "Creator": None, "Producer": None}
