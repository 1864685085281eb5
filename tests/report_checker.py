"""A second small program: it knows nothing of cammotion, only a report's workbook.

From the cam tables it computes peaks and clearances anew, by splines and dense samples, and says
where the report's own numbers disagree: ``python tests/report_checker.py tables.xlsx``.
"""

import re
import sys
import zipfile
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline

ROW, CELL = re.compile(r"<row [^>]*>(.*?)</row>", re.DOTALL), re.compile(r"<c ([^>]*)>(.*?)</c>")
PARTS = 40  # samples between two angles of a table
NEAR_MM, NEAR_SHARE = 0.02, 0.01  # what sampling may miss

BESIDE_DEG = 1e-9
OPPOSITE = {"beyond": "within", "within": "beyond", "moving": "standing", "standing": "moving"}

Table = list[list[Any]]
Half = tuple[list[Any], "Places"]
"""A half of a rule, its side and its limit, and where the mechanism is that it is about."""


def read(path: Path) -> dict[str, Table]:
    """Return the sheets of a workbook of plain rows."""
    with zipfile.ZipFile(path) as book:
        index = book.read("xl/workbook.xml").decode()
        names = [plain(name) for name in re.findall(r'<sheet name="([^"]*)"', index)]
        return {
            name: [row(text) for text in ROW.findall(book.read(part(n)).decode())]
            for n, name in enumerate(names, 1)
        }


def part(number: int) -> str:
    return f"xl/worksheets/sheet{number}.xml"


def plain(text: str) -> str:
    for code, sign in (("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&amp;", "&")):
        text = text.replace(code, sign)
    return text


def row(text: str) -> list[Any]:
    """Return the cells of a row, "" for those that are empty."""
    cells: dict[int, Any] = {}
    for attributes, content in CELL.findall(text):
        letters = re.findall(r'r="([A-Z]+)', attributes)[0]
        column = 0
        for letter in letters:
            column = 26 * column + ord(letter) - 64
        inside = re.sub(r"<[^>]*>", "", content)
        cells[column] = plain(inside) if "inlineStr" in attributes else float(inside)
    return [cells.get(column, "") for column in range(1, max(cells, default=0) + 1)]


def curve(table: Table, column: int) -> tuple[Any, Any]:
    """Return fine angles and the positions there, by a spline through a cam table."""
    angles, positions = (np.array([line[n] for line in table[1:]]) for n in (0, column))
    fine = np.linspace(0, 360, PARTS * (len(angles) - 1) + 1)
    return fine, CubicSpline(angles, positions)


def offsets(positions: Any, mechanism: list[Any]) -> Any:
    """Return what a rule asks of: the position, or of a turret how far from the nearest stop."""
    stops, stop, pitch = mechanism[1:4]
    if not stops:
        return positions
    passed = np.mod(positions - stop, abs(pitch))
    return np.minimum(passed, abs(pitch) - passed)


def check(path: Path) -> list[str]:
    """Return in words where the report's numbers are not those of its own tables."""
    sheets = read(path)
    mechanisms = {line[0]: line for line in sheets["mechanisms"][1:]}
    cycle_s = 3600 / mechanisms.pop("machine rate in pieces/h")[1]
    diagrams = ["today", "design"] if "design" in sheets else ["today"]
    wrong = []
    places: dict[tuple[str, str], Any] = {}
    for name, line in mechanisms.items():
        table = sheets[f"cam {name}"]
        for number, whose in enumerate(diagrams):
            column, told = 1 + 3 * number, line[5 + number]
            fine, spline = curve(table, column)
            inside = (fine > 1) & (fine < 359)  # a spline swings at its ends
            pushed = spline(fine, 2)[inside] * (360 / cycle_s) ** 2 / 1000
            found = float(np.abs(pushed).max())
            if abs(found - told) > NEAR_SHARE * told + 1e-3:
                wrong.append(f"peak of {name}, {whose}: {told:g} is told, {found:g} is found")
            listed = max(abs(each[column + 2]) for each in table[1:])
            if abs(listed - told) > NEAR_SHARE * told + 1e-3:
                wrong.append(f"table of {name}, {whose}: {told:g} is told, {listed:g} is listed")
            segments = sheets["design" if number else "machine"]
            ways = way_made(segments, name, fine, spline(fine))
            places[name, whose] = Places(offsets(spline(fine), line), ways)
    for line in sheets["rules"][1:]:
        for number, whose in enumerate(diagrams):
            told = line[6 + number]
            found = clearance(line, places[line[0], whose], places[line[3], whose])
            said = np.inf if told == "infinite" else told
            if found != said and not abs(found - said) <= NEAR_MM:
                wrong.append(f"{line[:6]}, {whose}: {told} mm is told, {found:g} is found")
    return wrong


class Places(NamedTuple):
    """Where a mechanism is at each angle, and its way from the nearer end of a move; nan: none."""

    offset: Any
    way: Any


def way_made(table: Table, name: str, angles: Any, positions: Any) -> Any:
    """Return how far a mechanism is under way at each angle, by the moves that its table lists."""
    found = np.full(len(angles), np.nan)
    for line in table[1:]:
        if line[0] == name and line[4] != line[5]:
            start, end, low, high = line[2:6]
            share = np.mod(angles - start + BESIDE_DEG, 360) - BESIDE_DEG
            inside = share <= end - start + BESIDE_DEG
            turn = high - low  # a turret is counted on from turn to turn
            passed = np.abs(np.mod(positions - low, abs(turn)))
            found[inside] = np.minimum(passed, abs(turn) - passed)[inside]
    return found


def clearance(line: list[Any], when: Places, only: Places) -> float:
    """Return the least room of one half of a rule while the other one is not as it has to be."""
    if line[1] == "at least above":
        return float((when.offset - only.offset).min()) - float(line[2])
    one, other = (line[1:3], when), (line[4:6], only)
    if is_way(one) and not (one[0][0] == "moving" and is_way(other)):
        one, other = opposite(other), opposite(one)
    found = room(one)[holds(opposite(other))]
    return float(found.min(initial=np.inf))


def is_way(half: Half) -> bool:
    return half[0][0] in ("moving", "standing")


def opposite(half: Half) -> Half:
    (side, limit), places = half
    return [OPPOSITE[side], limit], places


def holds(half: Half) -> Any:
    """Return at which angles a half of a rule holds."""
    (side, limit), (offset, way) = half
    if is_way(half):
        return np.isnan(way) == (side == "standing")
    return offset > limit if side == "beyond" else offset <= limit


def room(half: Half) -> Any:
    """Return how far it is at each angle from holding."""
    (side, limit), (offset, way) = half
    if side == "moving":
        return np.where(np.isnan(way), np.inf, -way)
    if side == "standing":
        return np.where(np.isnan(way), 0.0, way)
    return limit - offset if side == "beyond" else offset - limit


if __name__ == "__main__":
    found = check(Path(sys.argv[1]))
    print("\n".join(found) or "The report agrees with its tables.")
    sys.exit(bool(found))
