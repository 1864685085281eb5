"""Cam tables written at random as programs write them, and read by plain rules that know how.

Nothing here is taken from the reader: the marks, the units and the words are its own.
"""

import re
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array: TypeAlias = NDArray[np.float64]
Rng: TypeAlias = np.random.Generator

MM = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "um": 1e-3, "in": 25.4}
MORE = {"mm": 0, "cm": 1, "m": 3, "um": -2, "in": 1}  # decimals that a unit needs beside mm
TURNS = {"deg": 360.0, "rad": 2 * np.pi, "turn": 1.0, "percent": 100.0}
FIRST_WORDS = {
    "deg": ["angle [deg]", "Winkel (Grad)", "cam_angle_deg", "phi/°", "Master [°]"],
    "rad": ["theta [rad]", "angle_rad", "phi (rad)"],
    "turn": ["angle [0..1]", "cam angle in turns", "Winkel (turn)"],
    "percent": ["cam angle (%)", "master [%]"],
    "time": ["time in s", "Zeit [ms]", "t [s]", "time_s"],
    "distance": ["master in mm", "Leitwert [mm]", "master distance [m]", "x [inch]"],
}
POSITION_WORDS = {
    "mm": ["position in mm", "Hub [mm]", "s [mm]", "lift_mm", "Slave/mm"],
    "cm": ["position in cm", "Hub [cm]"],
    "m": ["position in m", "lift [m]"],
    "um": ["Hub [µm]", "lift_um"],
    "in": ["lift in inch", "displacement (in)", "rise [inch]", "lift_in"],
}
THIRD_WORDS = ["velocity in m/s", "v [mm/s]", "acceleration", "pressure angle in deg", "Ruck"]
ENCODINGS = ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "cp1252"]
NUMBER = {
    ".": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d{1,3})?"),
    ",": re.compile(r"[+-]?\d+(,\d+)?([eE][+-]?\d{1,3})?"),
}


@dataclass(frozen=True)
class Form:
    """How a table is written."""

    separator: str
    decimal: str
    encoding: str
    newline: str
    first: str
    unit: str
    decimals: int
    style: str  # "fixed", "short" (no zeros at the end) or "power"
    heading: str  # "none", "one line", "two lines" or "comment"
    third: bool
    extras: tuple[str, ...]  # "sep", "title", "count", "blank", "remarks", "end", "trailing"
    cycle: float  # of a time or a distance
    quoted: bool = False


def draw_form(rng: Rng) -> Form:
    """Draw a form; a comma that separates and is a decimal mark is quoted."""
    separator, decimal = str(rng.choice([*"\t;|, "])), str(rng.choice([*".,"]))
    first, unit = str(rng.choice([*FIRST_WORDS])), str(rng.choice([*MM]))
    extras = ["sep", "title", "count", "blank", "remarks", "end", "trailing"]
    chosen = {e for e in extras if rng.random() < 0.2}
    if separator == " ":
        chosen -= {"trailing", "sep"}
    if "sep" in chosen:
        chosen -= {"title", "count"}
    return Form(
        separator=separator,
        decimal=decimal,
        encoding=str(rng.choice(ENCODINGS)),
        newline=str(rng.choice(["\n", "\r\n", "\r"])),
        first=first,
        unit=unit,
        decimals=int(rng.integers(2, 7)) + MORE[unit],
        style=str(rng.choice(["fixed", "fixed", "short", "power"])),
        heading=str(rng.choice(["none", "one line", "two lines", "comment"])),
        third=bool(rng.random() < 0.4),
        extras=tuple(sorted(chosen)),
        cycle=float(rng.choice([0.25, 1.5, 2.0, 1800.0, 12.5])),
        quoted=separator == decimal == ",",
    )


@dataclass(frozen=True)
class Written:
    """A written table: its bytes, and what there is in it."""

    form: Form
    text: str
    raw: bytes
    places: Array  # parts of the turn, before they were rounded
    rounding: float  # of the places, in parts of the turn
    position_mm: Array  # as printed
    step_mm: float
    lines: list[int]  # of the rows, counted from 1

    @property
    def decides(self) -> bool:
        """Whether its numbers tell a decimal comma from a mark of thousands."""
        cells = [cell for line in self.lines for cell in cells_of(self.form, self.line(line))[:2]]
        every = all(re.fullmatch(r"[1-9]\d{0,2}(,\d{3})+|\d+", cell) for cell in cells)
        return self.form.decimal == "." or not every

    @property
    def rises_evenly(self) -> bool:
        """Whether its positions may be taken for numbers of rows, and what is beside for them."""
        steps = np.diff(self.position_mm)
        return bool(self.form.third and steps.min() > 0 and np.ptp(steps) < 0.1 * steps.mean())

    def line(self, number: int) -> str:
        """Return a line, counted from 1."""
        return self.text.split(self.form.newline)[number - 1]


def write(form: Form, places: Array, position_mm: Array, rng: Rng) -> Written:
    """Write a table of places (parts of the turn) and positions in mm."""
    turn = TURNS.get(form.first, form.cycle)
    finest = float(np.diff(places).min()) * turn
    digits = max(2, int(np.ceil(-np.log10(finest))) + 1 + int(rng.integers(0, 3)))
    first = [_number(value, digits, form, fixed=True) for value in places * turn]
    second = [_number(value, form.decimals, form) for value in position_mm / MM[form.unit]]
    third = [_number(value, 4, form, fixed=True) for value in rng.normal(0, 3, len(first))]
    columns = [first, second, *([third] if form.third else [])]
    lines = _head(form, len(first), rng)
    rows: list[int] = []
    for row in zip(*columns, strict=True):
        if "blank" in form.extras and rng.random() < 0.1:
            lines.append("")
        lines.append(_joined(row, form))
        if "remarks" in form.extras and rng.random() < 0.2:
            lines[-1] += f" // point {len(rows) + 1}"
        rows.append(len(lines))
    if "end" in form.extras:
        lines.append(form.separator.join(["TABLE_END", ""]).rstrip(" "))
    text = form.newline.join([*lines, ""])
    mark = "\ufeff" if form.encoding in {"utf-16"} else ""
    codec = "utf-16-le" if mark else form.encoding
    return Written(
        form=form,
        text=text,
        raw=(mark + text).encode(codec),
        places=places,
        rounding=10.0**-digits / turn,
        position_mm=np.array([value_of(cell, form.decimal) for cell in second]) * MM[form.unit],
        step_mm=10.0**-form.decimals * MM[form.unit],
        lines=rows,
    )


def settings_of(form: Form, *, is_part: bool, is_open: bool) -> dict[str, Any]:
    """Return what a reader has to be told of a table that does not say it."""
    told: dict[str, Any] = {}
    if form.heading == "none":
        if form.first in {"percent", "time", "distance"} or is_part:
            told["first"] = form.first
        if form.unit != "mm":
            told["position"] = form.unit
    if form.first in {"time", "distance"} and (is_part or is_open):
        told["cycle"] = form.cycle
    return told


def cells_of(form: Form, line: str) -> list[str]:
    """Return the cells of a line, as one who knows the form cuts it."""
    line = re.sub(r"(^|[\s;,|])//.*", r"\1", line)
    if form.separator == " ":
        return line.split()
    if form.quoted:
        return re.findall(r'"([^"]*)"', line)
    return [cell.strip().strip('"') for cell in line.split(form.separator)]


def value_of(cell: str, decimal: str) -> float:
    """Return a number, or nan for what is none."""
    if not NUMBER[decimal].fullmatch(cell):
        return np.nan
    return float(cell.replace(",", "."))


def changed(form: Form, **named: Any) -> Form:
    """Return another form."""
    return replace(form, **named)


def _number(value: float, digits: int, form: Form, *, fixed: bool = False) -> str:
    if form.style == "power" and not fixed:
        text = f"{value:.{max(digits, 1)}e}"
    else:
        text = f"{value + 0.0:.{max(digits, 0)}f}"
        if form.style == "short" and "." in text:
            text = text.rstrip("0").rstrip(".")
    text = "0" if text == "-0" else text
    return text.replace(".", form.decimal)


def _joined(cells: Any, form: Form) -> str:
    cells = [f'"{cell}"' for cell in cells] if form.quoted else cells
    return form.separator.join([*cells, *([""] if "trailing" in form.extras else [])])


def _head(form: Form, count: int, rng: Rng) -> list[str]:
    head = []
    if "sep" in form.extras:
        head.append(f"sep={form.separator}")
    if "title" in form.extras:
        head.append("Cam of the die")
    if "count" in form.extras:
        head.append(str(count))
    words = [str(rng.choice(FIRST_WORDS[form.first])), str(rng.choice(POSITION_WORDS[form.unit]))]
    words += [str(rng.choice(THIRD_WORDS))] if form.third else []
    if form.separator == ",":
        words = [word.replace(",", "") for word in words]
    if form.heading == "one line":
        head.append(form.separator.join(words))
    elif form.heading == "two lines":
        split = [re.split(r" in |[ /_](?=[^ /_]*$)", word, maxsplit=1) for word in words]
        head.append(form.separator.join(part[0].replace(" ", "_") for part in split))
        head.append(form.separator.join(part[1] if len(part) > 1 else "-" for part in split))
    elif form.heading == "comment":
        head.append("# " + form.separator.join(words))
    return head


def waves(places: Array, rng: Rng) -> Array:
    """Return a motion in mm that comes back: some waves, above 0 or somewhere else."""
    total = np.zeros_like(places)
    for n in range(1, 5):
        total += rng.normal(0, 1 / n**2) * np.cos(2 * np.pi * (n * places + rng.random()))
    size = rng.choice([0.3, 8, 50, 400])
    total = (total - total.min()) / np.ptp(total) * size
    return np.asarray(total + rng.choice([0, 0, -20, 130]))
