"""Cam tables of many programs are read to the digit; what is broken is named by its line."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from fresh.check_damaged_tables import check_damaged
from fresh.written_tables import (
    Rng,
    Written,
    draw_form,
    settings_of,
    waves,
    write,
)

import cammotion as cm
from cammotion import CamTable, InputError
from cammotion.exchange.cam_table_headings import two_headings

DATA = Path(__file__).parent / "data" / "cam_tables"


def draw_table(rng: Rng) -> tuple[Written, dict[str, Any], str]:
    """Draw a table, what has to be told of it, and what of a turn it is."""
    form, count = draw_form(rng), int(rng.integers(24, 200))
    shape = str(rng.choice(["closed", "open", "rise", "up and down"]))
    places = np.arange(count) / count
    if shape == "closed":
        places = np.append(places, 1.0)
    elif shape != "open":
        places *= rng.uniform(0.2, 0.9)
    positions = waves(places, rng)
    if shape == "rise":
        rising = 1 - np.cos(np.pi * places / places[-1])
        positions = positions.min() + 20 * rising
    told = settings_of(form, is_part=shape in {"rise", "up and down"}, is_open=shape == "open")
    return write(form, places, positions, rng), told, shape


def read(path: Path, raw: bytes, **told: Any) -> CamTable:
    path.write_bytes(raw)
    return cm.read_cam_table(path, **told)


def check_read(table: CamTable, written: Written, shape: str) -> None:
    count = len(written.places) - (shape == "closed")
    assert table.is_cycle == (shape in {"closed", "open"})
    assert table.angle_deg.size == count
    near = 1e-8 if table.is_cycle else 360 * 1.02 * written.rounding
    assert np.abs(table.angle_deg - 360 * written.places[:count]).max() < near
    assert np.allclose(table.position_mm, written.position_mm[:count], rtol=1e-14, atol=1e-12)
    if written.form.style == "fixed":
        assert table.step_mm == pytest.approx(written.step_mm, rel=1e-9)
    assert table.even_step_deg is not None


@pytest.mark.parametrize("seed", range(120))  # more are drawn in tests/fresh
def test_a_table_is_read_as_it_was_written(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng([seed, 14])
    written, told, shape = draw_table(rng)
    path = tmp_path / "cam.csv"
    if not written.decides:
        with pytest.raises(InputError, match="decimal="):
            read(path, written.raw, **told)
        told |= {"decimal": written.form.decimal}
    table = read(path, written.raw, **told)
    check_read(table, written, shape)
    for said in ("cam.csv has ", f"from line {written.lines[0]} to {written.lines[-1]}"):
        assert said in table.said


def lift_mm(angle_deg: float) -> float:
    """Return the motion of the sample files: 20 mm of cycloid, up from 40 to 160, down from 220."""
    share = (angle_deg - 40) / 120 if angle_deg < 160 else (340 - angle_deg) / 120
    share = min(max(share, 0), 1)
    return float(20 * (share - np.sin(2 * np.pi * share) / (2 * np.pi)))


# What each program's own pages say of its files is in the lines beside them; the files are ours.
SAMPLES: list[tuple[str, dict[str, Any], float, int, str]] = [
    # Lenze's Cam Loader: two columns and one of acceleration, spaces or tabs, point or comma as
    # decimal mark, empty lines and comments with // allowed
    ("lenze_cam_loader.txt", {}, 1e-4, 36, "decimal commas"),
    # CODESYS, cam data as an ASCII table: X and Y at even distances, and nothing else
    ("codesys_ascii_table.txt", {}, 1e-6, 36, "its range"),
    # Kollmorgen's KAS: semicolons, two lines above, a word behind each point, one line below
    ("kollmorgen_kas.csv", {}, 1e-5, 36, "from line 3 to 39"),
    # SEW's MOVISUITE: the first line is the number of points; a turn of the master is 36 here
    ("sew_curve_points.txt", {"first": "distance"}, 1e-3, 36, "36 of it a turn"),
    # Technosoft's EasyMotion Studio: whole numbers in units of the drive, a power of two apart
    (
        "technosoft_esm.txt",
        {"first": "distance", "position": "um"},
        1e-3,
        64,
        "4096 of it a turn",
    ),
    # The CNC kernel of ISG, and of Beckhoff: names above, # comments, 1e-4 deg and 1e-4 mm
    (
        "isg_cnc_table.txt",
        {"first": "distance", "cycle": 3.6e6, "position": 1e-4},
        1e-4,
        36,
        "units of 0.0001 mm",
    ),
    # A German spreadsheet: Unicode text, and CSV with the line that says the separator
    ("spreadsheet_unicode_text.txt", {}, 1e-3, 36, "not used: column 3 (Geschwindigkeit [mm/s])"),
    ("spreadsheet_german.csv", {}, 1e-2, 36, "cp1252"),
    # An American one, in inches, which does not repeat the first row
    ("spreadsheet_us_inch.csv", {}, 25.4e-4, 36, "a step before"),
    # NumPy's savetxt: the heading is a comment
    ("numpy_savetxt.txt", {}, 1e-12, 36, "rad (from the heading)"),
]


@pytest.mark.parametrize(("name", "told", "step", "count", "said"), SAMPLES)
def test_the_form_of_a_program(
    name: str, told: dict[str, Any], step: float, count: int, said: str
) -> None:
    table = cm.read_cam_table(DATA / name, **told)
    assert table.is_cycle
    assert table.even_step_deg == pytest.approx(360 / count, rel=1e-12)
    assert table.angle_deg[0] == 0
    wanted = [lift_mm(angle) for angle in table.angle_deg]
    assert table.position_mm == pytest.approx(wanted, abs=0.51 * step)
    assert table.step_mm == pytest.approx(step, rel=1e-9) or name == "numpy_savetxt.txt"
    assert said in table.said
    assert name in table.said


def test_a_motion_from_0_to_1_of_inventor_is_a_rise() -> None:
    table = cm.read_cam_table(DATA / "inventor_motion.txt", cycle=3)
    assert not table.is_cycle
    places = table.angle_deg / 120
    assert table.position_mm == pytest.approx(3 * places**2 - 2 * places**3, abs=1e-4)
    assert "a rise from 0 to 120 deg" in table.said
    assert "a rise from 0 to 360 deg" in cm.read_cam_table(DATA / "inventor_motion.txt").said


def test_our_own_curves_are_read(tmp_path: Path) -> None:
    path = cm.write_curves(cm.EXAMPLE.diagram, tmp_path / "curves.csv", step_deg=2)
    with pytest.raises(InputError, match=r"3 \(mill .*, 7 \(die .*columns=\(1, 3\)"):
        cm.read_cam_table(path)
    table = cm.read_cam_table(path, columns=(1, 7))
    assert table.is_cycle
    wanted = cm.EXAMPLE.diagram.position_mm("die", table.angle_deg)
    assert np.allclose(table.position_mm, wanted, rtol=0, atol=1e-12)


TURN = [f"{n};{10 * (1 - np.cos(np.radians(n))):.3f}" for n in range(0, 361, 10)]
HEADED = ["angle in deg;lift in mm", *TURN]


def put(lines: list[str], row: int, text: str) -> list[str]:
    """Return other lines, of which one (counted from 1) is another."""
    return [*lines[: row - 1], text, *lines[row:]]


REFUSED: list[tuple[list[str], str]] = [
    ([], "no line with two numbers"),
    (["nothing", "but;words"], "no line with two numbers"),
    (TURN[:7], "has 7 rows, from line 1 on; at least 8"),
    (put(HEADED, 5, "thirty;0.1"), "Line 5 of cam.csv is 'thirty;0.1'"),
    (put(HEADED, 5, "30;0,134"), "Line 5 of cam.csv is '30;0,134'"),
    (put(HEADED, 5, "30;"), "Line 5 of cam.csv is '30;'"),
    (put(HEADED, 5, "30"), "Line 5 of cam.csv is '30'"),
    (put(HEADED, 5, "30;1.2.3"), "Line 5 of cam.csv"),
    (put(HEADED, 5, "30;nan"), "Line 5 of cam.csv"),
    (put(HEADED, 5, "30;1e999"), "Line 5 of cam.csv"),
    (put(HEADED, 5, "30;#DIV/0!"), "Line 5 of cam.csv"),
    (put(HEADED, 5, "#NV;0.1"), "Line 5 of cam.csv"),
    (put(HEADED, 5, "30;1.340;7"), "Line 5 of cam.csv, '30;1.340;7', has 3 cells"),
    (put(HEADED, 2, "nan;0.000"), "Line 2 of cam.csv"),
    (put(HEADED, 2, "0;O.000"), "Line 2 of cam.csv"),
    (put(HEADED, 2, ";0.000"), "Line 2 of cam.csv"),
    (put(HEADED, 2, "0"), "Line 2 of cam.csv"),
    (put(HEADED, 2, "0.00.7373"), "Line 2 of cam.csv"),  # a row with a mark too few, no date
    (put(HEADED, 2, "12.13.20245"), "Line 2 of cam.csv"),
    (put(HEADED, 38, "360;?"), "Line 38 of cam.csv"),
    (put(HEADED, 38, "x;0"), "Line 38 of cam.csv"),
    ([*HEADED, "Second cam", *TURN], "Line 39 of cam.csv is 'Second cam'"),
    (put(HEADED, 5, "20;1.340"), "Line 5 of cam.csv has 20 in the first column, as line 4 has"),
    (put(HEADED, 5, "5;1.340"), "Line 5 of cam.csv has 5 in the first column after 20: sort"),
    ([HEADED[0], *TURN[::-1]], "Line 3 of cam.csv has 350 .* after 360: sort"),
    ([*HEADED[:5], *HEADED[6:]], "Line 6 of cam.csv: .* from 30 to 50, .* a row is missing"),
    (put(HEADED, 5, "31;1.340"), "Line 5 of cam.csv: .* from 20 to 31, .* uneven"),
    (put(HEADED, 38, "360;0.300"), r"Line 38 of cam.csv: the turn does not close, .* 0\.3 off"),
    ([*TURN[:20]], "goes from 0 to 190, and nothing says in what: give first='deg'"),
    (["angle in rad;s", *TURN], "says that the first column is in rad, .* as if it were in deg"),
    (["time in s;s", *TURN[1:]], "begins at 10 and not at 0, .*: give cycle"),
    (["angle in deg;angle in deg", *TURN], "second column is in deg: give the mm of one"),
    (["angle in deg;lift in mm;lift in inch", *(f"{t};1" for t in TURN)], "Several columns"),
    (["deg;m", *(f"{n};{n}000" for n in range(0, 361, 10))], "at most 1 km makes sense"),
    (["deg;mm", *(f"{n};{n % 40}" for n in range(0, 721, 10))], "a turn is 360: give one turn"),
    ([f"{n} 2,{400 + n}" for n in range(0, 361, 10)], "as 0 and 2400 .* or 0 and 2.4"),
    ([f"{n},{n % 7},5" for n in range(0, 361, 10)], "3 whole numbers between commas"),
    ([f"{n * (40 - n) / 8:.3f}".replace(".", ",") for n in range(40)], "'0,000', is one number if"),
    (["Hub", *(f"1{n},0{n}" for n in range(10, 30))], "'110,010', is one number if its comma is a"),
    ([f"{n // 10 + 1};{t}" for n, t in zip(range(0, 361, 10), TURN, strict=True)], "both rise in"),
    (put([c.replace(".", ",") for c in TURN], 20, "190;19.848"), "'19.848' may be 19.848 or 19848"),
]


@pytest.mark.parametrize(("lines", "said"), REFUSED, ids=[said for _, said in REFUSED])
def test_what_is_wrong_is_said_with_its_line(tmp_path: Path, lines: list[str], said: str) -> None:
    with pytest.raises(InputError, match=said) as refused:
        read(tmp_path / "cam.csv", "\n".join(lines).encode())
    assert str(refused.value).count(". ") <= 1  # a sentence, and at most the remedy


FILES: list[tuple[bytes, str]] = [
    (b"", "no line with two numbers"),
    (b"PK\x03\x04 and so on", "a workbook of a spreadsheet: save the sheet as CSV"),
    (b"\xd0\xcf\x11\xe0 and so on", "an old workbook"),
    (b"1;2\x01\n", "Line 1 of cam.csv has a character that is in no text"),
    (b"1;\x81\n", "no text in UTF-8, UTF-16 or cp1252"),
    ("1;2\n".encode("utf-16")[:-1], "no text in"),
]


@pytest.mark.parametrize(("raw", "said"), FILES)
def test_no_text(tmp_path: Path, raw: bytes, said: str) -> None:
    with pytest.raises(InputError, match=said):
        read(tmp_path / "cam.csv", raw)


def test_all_broken_rows_are_told_at_once(tmp_path: Path) -> None:
    lines = put(put(put(HEADED, 5, "3O;0.134"), 9, "70;"), 38, "360;?")
    with pytest.raises(InputError) as refused:
        read(tmp_path / "cam.csv", "\n".join(lines).encode())
    told = [line.partition(", where")[0] for line in str(refused.value).splitlines()]
    assert told == [
        "Line 5 of cam.csv is '3O;0.134'",
        "Line 9 of cam.csv is '70;'",
        "Line 38 of cam.csv is '360;?'",
    ]


@pytest.mark.parametrize("date", ["12.3.2024", "2024-03-12", "03/12/2024 14:05", "1.2.1999;9:30"])
def test_a_date_may_stand_over_a_table(tmp_path: Path, date: str) -> None:
    table = read(tmp_path / "cam.csv", "\n".join([date, *HEADED]).encode())
    assert table.angle_deg.size == 36


@pytest.mark.parametrize("line", ["{};{};", '"{}";"{}";'])
def test_a_mark_behind_the_last_column_is_no_column(tmp_path: Path, line: str) -> None:
    rows = [line.format(n, n / 4) for n in range(0, 91, 5)]
    table = read(tmp_path / "cam.csv", "\n".join(["angle in deg;lift in mm", *rows]).encode())
    assert np.array_equal(table.position_mm, np.arange(0, 91, 5) / 4)


def test_a_row_is_shown_where_no_line_has_two_numbers(tmp_path: Path) -> None:
    lines = ["Cam 7", "angle;lift", *(f"{line} mm" for line in TURN)]
    with pytest.raises(InputError, match=r"two numbers \(line 3 is '0;0\.000 mm'\): give"):
        read(tmp_path / "cam.csv", "\n".join(lines).encode())


HEADINGS = [
    '"angle\n[deg]";"lift\n[mm]"',
    '"angle [deg]"; "lift" max',
    'deg;"the ""lift"" in\n\nmm"',
]


@pytest.mark.parametrize("heading", HEADINGS)
def test_quotation_marks_are_no_inches(tmp_path: Path, heading: str) -> None:
    """A cell of a spreadsheet may go over several lines; those below keep their numbers."""
    path, lines = tmp_path / "cam.csv", [*heading.split("\n"), *TURN]
    table = read(path, "\r\n".join(lines).encode())
    assert (table.position_mm.max(), table.step_mm) == (20, 0.001)
    assert f"from line {len(lines) - 36} to {len(lines)}" in table.said
    with pytest.raises(InputError, match=f"Line {len(lines) - 1} of cam.csv is '350;x'"):
        read(path, "\n".join([*lines[:-2], "350;x", lines[-1]]).encode())
    assert read(path, "\n".join(['deg;lift "', *TURN]).encode()).position_mm.max() == 508


@pytest.mark.parametrize(
    "unit",
    ["1/100 mm", "[1/100 mm]", "(0,01 mm)", "10^-3 mm", "_0.01mm", "x10 um", "[thou]", "[-]"],
)
def test_a_unit_that_is_none_of_ours_is_asked(tmp_path: Path, unit: str) -> None:
    """And not taken for mm."""
    raw, said = "\n".join([f"deg;lift {unit}", *TURN]).encode(), unit.strip("_()[]")
    with pytest.raises(InputError, match=f"second column is in '{re.escape(said)}': give the mm"):
        read(tmp_path / "cam.csv", raw)
    assert read(tmp_path / "cam.csv", raw, position=0.01).position_mm.max() == pytest.approx(0.2)
    assert read(tmp_path / "cam.csv", raw, position="mm").position_mm.max() == 20


@pytest.mark.parametrize(
    "unit",
    [
        *["0.001 in", "[1e-3 in]", "(0.001 in)", "0.001 in.", '0.001"', "in 0.001 in units"],
        *["0.001 inches", "10 µm", "10 microns", "2.54e-2 mm", "10⁻³ mm", "0.01 m", "x1000 in"],
        *["1000x in", "mm x 100", "(mm*100)", "mm/100", "in 1/1000"],
        *["in thousandths of an inch", "Hundertstel mm", "milli-inch"],
        *["(x0.001) in", "* 1000 [mm]", "x1000 (in)", "[mm] x 100", "(in) / 100"],
        *["x 10^-3 in", "0,001 Zoll", "1/1000 in", "e-3 in", "micro inch", "µin"],
        *["mil", "in mils", "(thou)", "ft", "/feet", "nm", "in µ", "in counts"],
    ],
)
def test_a_factor_or_a_strange_unit_is_asked(tmp_path: Path, unit: str) -> None:
    raw = "\n".join([f"deg;lift {unit}", *TURN]).encode()
    with pytest.raises(
        InputError, match=r"second column is in '.*': give the mm of one"
    ) as refused:
        read(tmp_path / "cam.csv", raw)
    assert str(refused.value).split("'")[1] in unit
    assert read(tmp_path / "cam.csv", raw, position=0.0254).position_mm.max() == 0.508


@pytest.mark.parametrize("separator", [" ", ";"])
@pytest.mark.parametrize(
    "line",
    [
        *["deg lift 0.001 in", "angle lift 0.001 in", "deg lift mil", "angle [deg] lift [thou]"],
        "angle in deg lift in 1/100 mm v in mm/s",
    ],
)
def test_a_factor_is_seen_in_a_line_that_is_not_cut(
    tmp_path: Path, line: str, separator: str
) -> None:
    """As between spaces, where every word is a cell."""
    rows = [row.replace(";", separator) for row in TURN]
    with pytest.raises(InputError, match=r"second column is in '.*': give the mm of one"):
        read(tmp_path / "cam.csv", "\n".join([line, *rows]).encode())


RADII = [
    *[(f"radius {unit}", 25.4) for unit in ("in inch", "(in)", "in Zoll", "[inches]", ', "')],
    *[("cam radius, inches", 25.4), ("pitch radius inch", 25.4), ("radius_in", 25.4)],
    *[("radius in µm", 0.001), ("Radius/µm", 0.001), ("radius in micrometers", 0.001)],
    *[("radius cm", 10), ("radius m", 1000), ("Radius in meters", 1000), ("Radius (mm)", 1)],
    *[("error in µm", 0.001), ("radius of curvature in cm", 10)],
]


@pytest.mark.parametrize(("words", "unit_mm"), RADII)
def test_the_unit_of_a_radius_counts(tmp_path: Path, words: str, unit_mm: float) -> None:
    rows = [f"{n};{1.5 - 0.5 * np.cos(np.radians(n)):.4f}" for n in range(0, 361, 10)]
    table = read(tmp_path / "cam.csv", "\n".join([f"deg;{words}", *rows]).encode())
    assert table.position_mm.min() == pytest.approx(unit_mm, rel=1e-12)
    assert table.position_mm.max() == pytest.approx(2 * unit_mm, rel=1e-12)
    assert "(from the heading), printed" in table.said
    raw = "\n".join([f"deg {words}", *rows]).replace(";", " ").encode()
    spaced = read(tmp_path / "cam.csv", raw)
    assert np.array_equal(spaced.position_mm, table.position_mm)


@pytest.mark.parametrize(
    ("heading", "column"),
    [
        ("deg;radius in mm;lift in mm", 3),
        ("deg;v in mm/s;radius in mm", 3),
        ("deg;time in s;radius in mm", 3),
        ("deg;lift in mm;roller radius in mm", 2),
    ],
)
def test_a_radius_is_the_position_where_nothing_else_is(
    tmp_path: Path, heading: str, column: int
) -> None:
    rows = [f"{row};{row.partition(';')[2]}" for row in TURN]
    table = read(tmp_path / "cam.csv", "\n".join([heading, *rows]).encode())
    assert f"column {column} is the position in mm (from the heading)" in table.said


@pytest.mark.parametrize("words", ["velocity in mm/s", "v [mm/s]", "a in m/s²", "cm / Hub"])
def test_what_is_no_length_is_no_position(tmp_path: Path, words: str) -> None:
    raw = "\n".join([f"deg;{words}", *TURN]).encode()
    with pytest.raises(InputError, match=f"is '{re.escape(words)}', which is no length: give"):
        read(tmp_path / "cam.csv", raw)
    assert read(tmp_path / "cam.csv", raw, position="mm").position_mm.max() == 20


SWAPPED = [";".join(row.split(";")[::-1]) for row in TURN]
TITLES = ["Meßprotokoll 7", "Meßprotokoll 7;", "Prüfer;7", "12.3.2024", "37", "Hub 1;", "Tool 7"]


@pytest.mark.parametrize("title", TITLES)
@pytest.mark.parametrize("heading", [["Hub in µm;Winkel in Grad"], []])
def test_titles_are_passed_over_with_columns_too(
    tmp_path: Path, title: str, heading: list[str]
) -> None:
    raw = "\n".join([title, *heading, *SWAPPED]).encode()
    table = read(tmp_path / "cam.csv", raw, columns=(2, 1))
    assert table.angle_deg.size == 36
    assert table.position_mm.max() == pytest.approx(0.02 if heading else 20)
    if heading:
        assert np.array_equal(table.position_mm, read(tmp_path / "cam.csv", raw).position_mm)
    spaced = read(tmp_path / "cam.csv", raw.replace(b";", b" "), columns=(2, 1))
    assert np.array_equal(spaced.position_mm, table.position_mm)


@pytest.mark.parametrize(
    "row", ["1.0O;-10", "O.OOO;-10", ";-10", "nan;-10", "OVER;-10", "1.2.3;-10", "-10;", "12;34 x"]
)
def test_a_broken_first_row_is_no_title(tmp_path: Path, row: str) -> None:
    raw = "\n".join(["Hub in mm;Winkel in Grad", row, *SWAPPED]).encode()
    with pytest.raises(InputError, match=r"Line 2 of cam\.csv is "):
        read(tmp_path / "cam.csv", raw, columns=(2, 1))


@pytest.mark.parametrize(("beside", "is_near"), [(1201, False), (1201.4, True)])
def test_a_mark_of_thousands_is_one_where_the_neighbours_are_nearer_to_it(
    tmp_path: Path, beside: float, is_near: bool
) -> None:
    """Half-way from 2.4 to 2400 is 1201.2."""
    lifts = ["0.00", "600.50", f"{beside:.2f}", "2,400", f"{beside:.2f}", "600.50", "0.50", "0.25"]
    raw = "\n".join(["deg;mm", *(f"{45 * n};{lift}" for n, lift in enumerate(lifts))]).encode()
    if is_near:
        assert read(tmp_path / "cam.csv", raw).position_mm.max() == 2400
        return
    with pytest.raises(InputError, match=r"'2,400' may be 2\.4 or 2400"):
        read(tmp_path / "cam.csv", raw)


OPEN = put(HEADED, 38, "360;0.300")


@pytest.mark.parametrize("heading", ["angle in deg;lift in mm", "Winkel;Hub"])
def test_a_turn_of_an_angle_that_does_not_close_is_no_longer_one(
    tmp_path: Path, heading: str
) -> None:
    """What is said mends it, and is no cycle of 370 deg."""
    lines = put(OPEN, 1, heading)
    with pytest.raises(InputError, match=r"does not close, .* take the last row out if") as refused:
        read(tmp_path / "cam.csv", "\n".join(lines).encode())
    assert "cycle=370" not in str(refused.value)
    assert "or give is_cycle=False if it is not meant to close." in str(refused.value)
    assert read(tmp_path / "cam.csv", "\n".join(lines[:-1]).encode()).angle_deg.size == 36


def test_a_time_that_does_not_close_may_end_a_step_before(tmp_path: Path) -> None:
    lines = put(OPEN, 1, "time in s;lift in mm")
    with pytest.raises(InputError, match=r"or cycle=370 if the last row comes a step before"):
        read(tmp_path / "cam.csv", "\n".join(lines).encode())
    assert read(tmp_path / "cam.csv", "\n".join(lines).encode(), cycle=370).angle_deg.size == 37


@pytest.mark.parametrize(
    "words",
    [
        *["Hub2 mm", "y2 [mm]", "lift (at 2)", "cam;7\ndeg;mm", "position", "Hub 2 in mm"],
        *["cam 2 in Werk 3", "lift 1 in mm", "foot lift mm", "lift (cold)"],
        *["lift in x", "lift [mm] x", "lift of 10 (mm)", "lift 0.1 in mm", "lift in mm of 100"],
        *["lift in millimeters", "lift, millimetre", "lift in Millimeter"],
    ],
)
def test_a_number_beside_a_unit_is_no_scale(tmp_path: Path, words: str) -> None:
    heading = words if ";" in words else f"deg;{words}"
    raw = "\n".join([heading, *TURN]).encode()
    assert read(tmp_path / "cam.csv", raw).position_mm.max() == 20


def test_more_than_any_table_is_not_read(tmp_path: Path) -> None:
    with (tmp_path / "cam.csv").open("wb") as file:
        file.truncate(200_000_000)
    with pytest.raises(InputError, match=r"cam\.csv has more than 50 MB, far more"):
        cm.read_cam_table(tmp_path / "cam.csv")


def test_no_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"There is no file cam\.csv"):
        cm.read_cam_table(tmp_path / "cam.csv")
    with pytest.raises(InputError, match="cannot be read"):
        cm.read_cam_table(tmp_path)
    with pytest.raises(InputError, match=r"is given path=5: give a text in quotes or a Path"):
        cm.read_cam_table(5)  # type: ignore[arg-type]


TOLD: list[tuple[dict[str, Any], str]] = [
    ({"separator": "x"}, "no separator 'x'"),
    ({"separator": []}, "is given separator=.*: give a text in quotes"),
    ({"decimal": ""}, "no decimal mark ''"),
    ({"encoding": "klingon"}, "no encoding 'klingon'"),
    ({"encoding": 5}, "is given encoding=5: give a text in quotes"),
    ({"columns": (0, 1)}, "counted from 1"),
    ({"columns": (1, 1)}, "counted from 1"),
    ({"columns": (1.9, 2.7)}, r"The columns are \(1\.9, 2\.7\): give .* counted from 1"),
    ({"columns": (True, 2)}, "counted from 1"),
    ({"columns": 3}, "is given columns=3: give 2 values, each a whole number"),
    ({"uneven": "no"}, "is given uneven='no': give True or False"),
    ({"is_cycle": "no"}, "is given is_cycle='no': give True or False"),
    ({"columns": (1, 5)}, "no line with numbers in columns 1 and 5 .line 2 is "),
    ({"separator": "|"}, "cut at its bars, has no line with numbers in columns 1 and 2 .line 2"),
    ({"first": "degrees"}, "no kind of a first column 'degrees'"),
    ({"position": "feet"}, "no unit of a position 'feet'"),
    ({"position": -1}, "unit of a position is -1"),
    ({"cycle": 0}, "cycle, in units of the first column, is 0"),
    ({"cycle": 180}, "a turn is 180"),
    ({"cycle": 720, "is_cycle": True}, "a whole turn was asked for"),
]


@pytest.mark.parametrize(("told", "said"), TOLD)
def test_what_is_set_wrongly(tmp_path: Path, told: dict[str, Any], said: str) -> None:
    with pytest.raises(InputError, match=said):
        read(tmp_path / "cam.csv", "\n".join(HEADED).encode(), **told)


def test_what_is_asked_can_be_set(tmp_path: Path) -> None:
    path = tmp_path / "cam.csv"
    commas = "\n".join(f"{n} 2,{400 + n}" for n in range(0, 361, 10)).encode()
    told = {"is_cycle": False}
    assert read(path, commas, decimal=",", **told).position_mm[1] == pytest.approx(2.41)
    assert read(path, commas, decimal=".", **told).position_mm[1] == 2410
    threes = "\n".join(f"{n},{n % 360},5" for n in range(0, 361, 10)).encode()
    table = read(path, threes, separator=",", decimal=".", **told)
    assert table.position_mm[1] == 10
    off = put(HEADED, 38, "360;0.300")
    assert read(path, "\n".join(off).encode(), is_cycle=False).angle_deg[-1] == 360
    uneven = [*HEADED[:5], *HEADED[6:]]
    table = read(path, "\n".join(uneven).encode(), uneven=True)
    assert table.is_cycle
    assert table.even_step_deg is None
    assert table.angle_deg.size == 35
    half = read(path, "\n".join(HEADED).encode(), cycle=720)
    assert half.angle_deg[-1] == 180
    assert "up and down from 0 to 180 deg" in half.said
    assert read(path, "\n".join(HEADED).encode(), position="in").position_mm[18] == 508
    assert read(path, "\n".join(HEADED).encode(), position=2).position_mm[18] == 40


def test_thousands_are_told_by_the_rest_of_the_file(tmp_path: Path) -> None:
    path, ways = tmp_path / "cam.csv", range(0, 3601, 100)
    told: dict[str, Any] = {"first": "distance", "is_cycle": False}
    one = "\n".join(f"{n:,};{n / 7 + 900:,.2f}" for n in ways)
    table = read(path, one.encode(), **told)
    assert table.position_mm == pytest.approx([n / 7 + 900 for n in ways], abs=6e-3)
    other = one.replace(",", "_").replace(".", ",").replace("_", ".")
    assert np.array_equal(read(path, other.encode(), **told).position_mm, table.position_mm)
    swiss = one.replace(",", "'")
    assert np.array_equal(read(path, swiss.encode(), **told).position_mm, table.position_mm)


def test_of_two_readings_that_whose_angles_rise_is_right(tmp_path: Path) -> None:
    """1,500 may be a way of 1.5 mm, but not after 900."""
    ways = ("0", "300", "600", "900", "1,200", "1,500", "1,800", "2,100")
    text = "\n".join(f"{way};{n}" for n, way in enumerate(ways))
    told: dict[str, Any] = {"first": "distance", "is_cycle": False}
    table = read(tmp_path / "cam.csv", text.encode(), **told)
    assert np.diff(table.angle_deg) == pytest.approx([table.angle_deg[1]] * 7)


def test_a_turn_that_does_not_close_by_rounding_closes(tmp_path: Path) -> None:
    table = read(tmp_path / "cam.csv", "\n".join(put(HEADED, 38, "360;0.001")).encode())
    assert table.is_cycle
    assert table.angle_deg.size == 36
    assert "but for 0.001" in table.said


def test_damaged_files_are_read_as_they_stand_or_refused(tmp_path: Path) -> None:
    ends = [check_damaged(tmp_path / "cam.csv", seed) for seed in range(500)]
    assert ends.count("refused") > 150
    assert ends.count("read") > 50


def test_what_is_said_after_the_unit_of_a_position_is_of_something_else() -> None:
    line = "cam angle in deg lift in mm velocity in mm/s"
    assert [heading.words for heading in two_headings(line)] == ["", "lift in mm"]
    assert two_headings("lift in mm cam angle in deg")[1].words == "lift in mm"


@pytest.mark.parametrize(
    ("heading", "step", "told"),
    [
        ("cam angle %;lift [in]", 10, {"first": "percent"}),
        ("angle [deg];cam #2 lift [in]", 36, {}),
        ("angle [deg];load %;lift [in]", 36, {"columns": (1, 3)}),
    ],
)
def test_a_sign_within_a_heading_is_no_comment(
    heading: str, step: int, told: dict[str, Any], tmp_path: Path
) -> None:
    """The rest of the line was cut off, and inches became mm without a word."""
    between = ";7;" if heading.count(";") > 1 else ";"
    rows = [f"{step * n}{between}{1 - abs(n - 5) / 5:g}" for n in range(10)]
    (tmp_path / "cam.csv").write_text("\n".join([heading, *rows]), "utf-8")
    found = cm.read_cam_table(tmp_path / "cam.csv", **told)
    assert found.position_mm.max() == pytest.approx(25.4)


def test_a_heading_that_is_two_letters_and_a_sign_is_none_either(tmp_path: Path) -> None:
    rows = [f"{1 - abs(n - 5) / 5:g};{10 * n}" for n in range(10)]
    (tmp_path / "cam.csv").write_text("\n".join(["in;%", *rows]), "utf-8")
    found = cm.read_cam_table(tmp_path / "cam.csv", columns=(2, 1))
    assert found.position_mm.max() == pytest.approx(25.4)
    assert np.array_equal(found.angle_deg, np.arange(0, 360, 36))


@pytest.mark.parametrize("unit", ["%", "normalized", "turn", "rev"])
def test_a_position_in_parts_of_a_turn_is_asked_about(unit: str, tmp_path: Path) -> None:
    """It was read as mm, and said to have no unit."""
    rows = [f"{36 * n};{n % 5}" for n in range(10)]
    (tmp_path / "cam.csv").write_text("\n".join([f"angle [deg];lift [{unit}]", *rows]), "utf-8")
    with pytest.raises(InputError, match=r"second column is in .*: give the mm of one as"):
        cm.read_cam_table(tmp_path / "cam.csv")


def test_a_file_may_say_any_sign_between_its_cells(tmp_path: Path) -> None:
    rows = [f"{36 * n}:{n % 5}" for n in range(10)]
    (tmp_path / "cam.csv").write_text("\n".join(["sep=:", *rows]), "utf-8")
    assert "cells between ':'" in cm.read_cam_table(tmp_path / "cam.csv").said


def test_a_turn_closes_within_twice_its_largest_step(tmp_path: Path) -> None:
    """Of a table that ends a step before: the ends are 1.8 steps apart, and then 3.6."""

    def found(peak: float) -> CamTable:
        rows = [f"{10 * n};{peak - abs(n - peak):.3f}" for n in range(36)]
        (tmp_path / "cam.csv").write_text("\n".join(["angle [deg];lift [mm]", *rows]), "utf-8")
        return cm.read_cam_table(tmp_path / "cam.csv")

    assert found(18.4).is_cycle
    with pytest.raises(InputError, match=r"does not close, .* 3\.6 off"):
        found(19.3)
