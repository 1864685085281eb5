"""Damaged cam tables: what is read of them is what stands there, or they are refused."""

import re
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import cammotion as cm
from fresh.drawing import Machine
from fresh.written_tables import Form, Rng, changed, draw_form, value_of, waves, write

EACH_TIME = 20
GAP = "['\N{RIGHT SINGLE QUOTATION MARK}\N{NO-BREAK SPACE}]"  # which a damage may put in
THOUSANDS = re.compile(rf"[+-]?[1-9]\d{{0,2}}(?:{GAP}\d{{3}})+(?!\d)")


def damaged_tables(machine: Machine) -> None:
    """Read some damaged tables."""
    seeds = machine.rng.integers(0, 2**62, EACH_TIME)
    with TemporaryDirectory() as folder:
        for seed in seeds:
            check_damaged(Path(folder) / "cam.csv", int(seed))


DAMAGES: dict[str, Callable[[bytearray, Rng], bytearray]] = {
    "a byte is another": lambda raw, rng: spliced(raw, rng, 1, bytes([rng.integers(32, 127)])),
    "a mark is another": lambda raw, rng: spliced(
        raw, rng, 1, bytes([rng.choice([*b".,;\t -+e"])])
    ),
    "a byte is gone": lambda raw, rng: spliced(raw, rng, 1, b""),
    "a byte is new": lambda raw, rng: spliced(raw, rng, 0, bytes([rng.choice([*b"0.,; x\n\t"])])),
    "any byte": lambda raw, rng: spliced(raw, rng, 1, bytes([rng.integers(0, 256)])),
    "some are gone": lambda raw, rng: spliced(raw, rng, int(rng.integers(2, 60)), b""),
    "the end is gone": lambda raw, rng: raw[: rng.integers(0, len(raw))],
    "a piece comes twice": lambda raw, rng: spliced(raw, rng, 0, bytes(raw[: rng.integers(1, 80)])),
}


def spliced(raw: bytearray, rng: Rng, count: int, new: bytes) -> bytearray:
    at = int(rng.integers(0, len(raw)))
    return raw[:at] + new + raw[at + count :]


def without_gaps(cell: str) -> str:
    """Return a number as 21878 that is written as 21'878."""
    return re.sub(GAP, "", cell) if THOUSANDS.match(cell) else cell


def rows_of(form: Form, text: str) -> tuple[list[tuple[float, float]], bool]:
    """Return the rows of a damaged text, and whether a line was to be one and is none."""
    rows, broken = [], False
    for line in text.replace("\r\n", "\n").replace("\r", "\n").split("\n"):
        if not line.strip(" ;|,\t") or line.lstrip().startswith(("#", "//", "%", "!")):
            continue
        is_spaced = form.separator in {" ", "\t"}  # no cell of ours is empty
        cut = re.split("[ \t]+", line.strip(" \t")) if is_spaced else line.split(form.separator)
        cells = [without_gaps(cell.strip()) for cell in cut]
        first, second = ([*(value_of(cell, form.decimal) for cell in cells), np.nan, np.nan])[:2]
        if np.isfinite(first) and np.isfinite(second):
            rows.append((first, second))
        else:
            broken |= not re.search(r"[^\W\d_]{3}", line)  # a word, as in a heading
    return rows, broken


def damaged(seed: int) -> tuple[Form, bytes]:
    """Return a table in deg and mm after one or two damages, none of them to its heading."""
    rng = np.random.default_rng([seed, 15])
    form = draw_form(rng)
    decimal = "." if form.separator == "," else form.decimal
    form = changed(
        form, first="deg", unit="mm", encoding="utf-8", style="fixed", heading="one line"
    )
    form = changed(form, extras=(), decimals=3, decimal=decimal, quoted=False, newline="\n")
    count = int(rng.integers(9, 60))
    written = write(
        form, np.arange(count + 1) / count, waves(np.arange(count + 1) / count, rng), rng
    )
    head, _, rows = written.raw.partition(b"\n")
    raw = bytearray(rows)
    for name in rng.choice([*DAMAGES], int(rng.integers(1, 3))):
        raw = DAMAGES[name](raw, rng) if raw else raw
    return form, head + b"\n" + bytes(raw)


def check_damaged(path: Path, seed: int) -> str:
    """Read a damaged file: what comes back is what stands there, or a sentence."""
    form, raw = damaged(seed)
    try:
        path.write_bytes(raw)
        table = cm.read_cam_table(path)
    except cm.InputError:
        return "refused"
    rows, broken = rows_of(form, raw.decode("cp1252" if "cp1252" in table.said else "utf-8"))
    assert not broken, f"seed {seed}: a broken row was left out\n{table.said}"
    angles, positions = np.array(rows).T
    assert len(table.position_mm) == len(rows) - ("repeats" in table.said), f"seed {seed}"
    assert np.array_equal(table.position_mm, positions[: table.position_mm.size]), f"seed {seed}"
    off = np.abs(table.angle_deg - angles[: table.angle_deg.size]).max()
    assert off < 0.25 * np.diff(table.angle_deg).min(), f"seed {seed}"
    return "read"
