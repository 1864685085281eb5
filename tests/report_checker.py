"""A second small program: it knows nothing of cammotion, only a report's workbook.

From the cam tables it computes peaks and clearances anew, by splines and dense samples, and says
where the report's own numbers disagree: ``python tests/report_checker.py tables.xlsx``.
"""

import re
import sys
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

ROW, CELL = re.compile(r"<row [^>]*>(.*?)</row>", re.DOTALL), re.compile(r"<c ([^>]*)>(.*?)</c>")
PARTS = 40  # samples between two angles of a table
NEAR_MM, NEAR_SHARE = 0.02, 0.01  # what sampling may miss

Table = list[list[Any]]


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
    wrong = []
    places: dict[tuple[str, str], Any] = {}
    for name, line in mechanisms.items():
        table = sheets[f"cam {name}"]
        for whose, column, told in (("today", 1, line[5]), ("design", 4, line[6])):
            fine, spline = curve(table, column)
            inside = (fine > 1) & (fine < 359)  # a spline swings at its ends
            pushed = spline(fine, 2)[inside] * (360 / cycle_s) ** 2 / 1000
            found = float(np.abs(pushed).max())
            if abs(found - told) > NEAR_SHARE * told + 1e-3:
                wrong.append(f"peak of {name}, {whose}: {told:g} is told, {found:g} is found")
            listed = max(abs(each[column + 2]) for each in table[1:])
            if abs(listed - told) > NEAR_SHARE * told + 1e-3:
                wrong.append(f"table of {name}, {whose}: {told:g} is told, {listed:g} is listed")
            places[name, whose] = offsets(spline(fine), line)
    for line in sheets["rules"][1:]:
        for whose, told in (("today", line[6]), ("design", line[7])):
            found = clearance(line, places[line[0], whose], places[line[3], whose])
            if isinstance(told, str) or abs(found - told) > NEAR_MM:
                wrong.append(f"{line[:6]}, {whose}: {told} mm is told, {found:g} is found")
    return wrong


def clearance(line: list[Any], when: Any, only: Any) -> float:
    """Return the least room of `when` while the other one is not where it has to be."""
    room = line[2] - when if line[1] == "beyond" else when - line[2]
    is_open = only > line[5] if line[4] == "within" else only <= line[5]
    return float(room[is_open].min()) if is_open.any() else np.inf


if __name__ == "__main__":
    found = check(Path(sys.argv[1]))
    print("\n".join(found) or "The report agrees with its tables.")
    sys.exit(bool(found))
