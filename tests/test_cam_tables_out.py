"""Cam tables out: what a controller reads is the motion, evenly spaced and closed."""

from dataclasses import replace
from decimal import Decimal
from itertools import product
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from machines import Array, make_diagram, make_die, make_mill
from odd_machines import draw

import cammotion as cm
from cammotion import InputError, read_cam_table, write_cam_tables

DIAGRAM = make_diagram()
MARKS = [
    (separator, decimal)
    for separator, decimal in product(["\t", ";", "|", ",", " "], [".", ","])
    if separator != decimal
]


def numbers(path: Path, separator: str = ";", decimal: str = ".") -> Array:
    """Read the rows of a file as plainly as can be."""
    lines = path.read_text("ascii").splitlines()
    rows = [line.replace(decimal, ".").split(separator) for line in lines]
    return np.array([row for row in rows if row[0][0].isdigit()], dtype=float)


@pytest.mark.parametrize(
    ("separator", "decimal", "derivatives"),
    [*((*marks, "s") for marks in MARKS), (*MARKS[0], None), (*MARKS[3], None), (*MARKS[3], "deg")],
)
def test_the_reader_reads_what_is_written(
    tmp_path: Path, separator: str, decimal: str, derivatives: str | None
) -> None:
    """With every pair of marks, and three decimals, which look like thousands."""
    asked: Any = {"separator": separator, "decimal": decimal, "derivatives": derivatives}
    for decimals, step in ((3, 1.0), (6, 0.5)):
        (tmp_path / str(decimals)).mkdir()
        folder = tmp_path / str(decimals)
        paths = write_cam_tables(DIAGRAM, folder, step_deg=step, decimals=decimals, **asked)
        table = read_cam_table(paths["die"])
        assert table.is_cycle
        assert table.angle_deg.tolist() == np.arange(0, 360, step).tolist()
        off = table.position_mm - DIAGRAM.position_mm("die", table.angle_deg)
        assert np.abs(off).max() <= 0.5000001 * 10**-decimals
        assert table.step_mm == 10**-decimals
        assert ("not used" in table.said) == (derivatives is not None)
        mill = read_cam_table(paths["mill"])  # a turret goes on, and does not close
        assert not mill.is_cycle
        assert (mill.angle_deg[-1], mill.position_mm[-1]) == (360, 100)


def test_random_machines_are_read_as_they_move(tmp_path: Path) -> None:
    rng = np.random.default_rng(3)
    for number in range(8):
        diagram = draw(rng, int(rng.integers(1, 6)))
        points = int(rng.choice([9, 100, 256, 361, 3601]))
        paths = write_cam_tables(diagram, tmp_path, points=points, decimals=9, overwrite=True)
        assert len({path.name.casefold() for path in paths.values()}) == len(diagram.motions)
        assert [*paths] == [*diagram.names]
        for motion in diagram.motions:
            table = read_cam_table(paths[motion.name], is_cycle=False if number % 2 else None)
            ways = table.position_mm - table.position_mm[0]
            off = np.abs(ways - moved(motion, table.angle_deg))
            assert off.max() <= 1.1e-9


def moved(motion: cm.Motion, angles: Array) -> Array:
    """Return how far a motion is from where it was at 0 deg, if it never closes its turret."""
    if motion.stops:
        turns = np.ceil(motion.start_deg / 360)
        motion = replace(motion.shifted(-360 * float(turns)), stops=10**6)
    places: Array = np.asarray(motion.position_mm(angles)) - motion.position_mm(0)
    return places


def test_a_turret_that_closes_within_the_turn_goes_on(tmp_path: Path) -> None:
    """At its last stop the position begins anew; a controller needs the way."""
    mill = cm.indexing_motion("mill", cm.rise(30, over_deg=360), stops=1, start_deg=500)
    paths = write_cam_tables(cm.TimingDiagram([mill], 2000), tmp_path)
    angles, positions = numbers(paths["mill"]).T
    assert (np.diff(positions) > -1e-9).all()
    assert positions[-1] - positions[0] == pytest.approx(30, abs=2e-6)
    assert positions[0] == pytest.approx(mill.position_mm(0), abs=1e-6)
    phase = ((angles - 140) % 360) / 360
    turns = np.floor((angles - 140) / 360) + 1
    own = 30 * (phase - np.sin(2 * np.pi * phase) / (2 * np.pi) + turns)
    assert positions == pytest.approx(own, abs=2e-6)


@pytest.mark.parametrize("form", ["plain", "codesys"])
@pytest.mark.parametrize(
    ("typed", "first_mm"),
    [
        *[((8, 340, 0, 157.08), -146.793585), ((8, 200, 30, -30), 30), ((8, 0, 30, -30), 30)],
        *[((8, 200, 100, 30), 100), ((1, 200, 30, -30), 30), ((1, 270, 0, 30), 0)],
        *[((8, 270, 0, 30), 0), ((12, 560, 0, 30), -30), ((3, -160, 0, -30), -30)],
    ],
)
def test_a_turret_stands_where_it_was_typed_and_no_whole_turn_further(
    typed: tuple[int, float, float, float], first_mm: float, form: str, tmp_path: Path
) -> None:
    stops, start_deg, from_mm, pitch_mm = typed
    move = cm.rise(pitch_mm, over_deg=90) if pitch_mm > 0 else cm.return_(-pitch_mm, over_deg=90)
    dial = cm.indexing_motion(
        "dial", move, cm.dwell(270), stops=stops, start_deg=start_deg, start_mm=from_mm
    )
    paths = write_cam_tables(cm.TimingDiagram([dial], 600), tmp_path, form=form)
    separator = ";" if form == "plain" else "\t"
    angles, positions = numbers(paths["dial"], separator).T
    assert positions[0] == pytest.approx(first_mm, abs=1e-6)
    assert positions[-1] == pytest.approx(first_mm + pitch_mm, abs=1e-6)
    turns = (start_deg % 360 - start_deg) / 360
    at_start = positions[angles == start_deg % 360]
    assert at_start == pytest.approx(from_mm + pitch_mm * turns, abs=1e-6)


def test_angles_are_written_as_one_writes_them(tmp_path: Path) -> None:
    path = write_cam_tables(DIAGRAM, tmp_path, step_deg=0.1)["die"]
    cells = [line.split(";")[0] for line in path.read_text().splitlines()]
    assert cells == ["cam angle in deg", *(f"{n // 10}.{n % 10}" for n in range(3601))]


def test_derivatives_are_those_of_the_motion(tmp_path: Path) -> None:
    """Per deg and per s, against differences of the positions; the first ones come again."""
    paths = write_cam_tables(DIAGRAM, tmp_path, step_deg=0.5, decimals=9, derivatives="deg")
    heading = paths["die"].read_text().splitlines()[0]
    assert heading == (
        "cam angle in deg;position in mm;velocity in mm/deg;acceleration in mm/deg2;jerk in mm/deg3"
    )
    per_deg = numbers(paths["die"])
    for n in (2, 3, 4):
        assert np.gradient(per_deg[:, n - 1], 0.5)[330:390] == pytest.approx(
            per_deg[330:390, n], rel=1e-2, abs=1e-4
        )
    paths = write_cam_tables(DIAGRAM, tmp_path, derivatives="s", overwrite=True, step_deg=0.5)
    per_s = numbers(paths["die"])
    curves = [DIAGRAM.velocity, DIAGRAM.acceleration, DIAGRAM.jerk]
    for column, curve in zip(per_s.T[2:], curves, strict=True):
        own = np.asarray(curve("die", per_s[:, 0])) * 1000
        assert column == pytest.approx(own, abs=1e-5)
        assert column[0] == column[-1]
    for order in (1, 2, 3):  # 2000 pieces/h are 200 deg/s
        assert per_s[:, 1 + order] == pytest.approx(per_deg[:, 1 + order] * 200**order, abs=1e-2)


def test_small_derivatives_keep_their_digits(tmp_path: Path) -> None:
    path = write_cam_tables(DIAGRAM, tmp_path, decimals=3, derivatives="deg")["mill"]
    rows = [line.split(";") for line in path.read_text().splitlines()[1:]]
    largest = [max((row[n] for row in rows), key=lambda cell: abs(float(cell))) for n in (2, 3, 4)]
    assert largest == ["1.333", "0.02792", "0.001170"]
    assert not any(cell.strip("-0.") == "" and "-" in cell for row in rows for cell in row)


def test_no_digit_is_more_than_a_float_has(tmp_path: Path) -> None:
    """Of a jerk of 94,919.7 mm/s3 the twelfth decimal is no part of the number."""
    paths = write_cam_tables(DIAGRAM, tmp_path, decimals=12, derivatives="s", step_deg=5)
    jerks = [line.split(";")[4] for line in paths["die"].read_text().splitlines()[1:]]
    time_s = mpmath.mpf(55) / 200  # of a rise of 50 mm by a cycloid
    for jerk, angle in zip(jerks[30:41], range(150, 205, 5), strict=True):
        wave = mpmath.cos(2 * mpmath.pi * mpmath.mpf(angle - 150) / 55)
        exact = wave * 50 * (2 * mpmath.pi) ** 2 / time_s**3
        assert len(jerk.partition(".")[2]) == 10
        assert abs(mpmath.mpf(jerk) - exact) < 1.1e-10


def test_codesys_reads_two_rising_columns(tmp_path: Path) -> None:
    paths = write_cam_tables(DIAGRAM, tmp_path, form="codesys", points=256)
    assert [path.name for path in paths.values()] == ["mill.txt", "die.txt"]
    for name, path in paths.items():
        table = numbers(path, "\t")
        assert table.shape == (256, 2)
        assert len(path.read_text().splitlines()) == 256  # no heading
        assert (table[0, 0], table[-1, 0]) == (0, 360)
        assert np.diff(table[:, 0]) == pytest.approx(360 / 255, abs=1e-9)
        assert table[-1, 1] - table[0, 1] == DIAGRAM[name].pitch_mm


def test_the_last_position_is_the_first_to_the_last_digit(tmp_path: Path) -> None:
    for start in np.random.default_rng(1).uniform(-500, 900, 20):
        die = make_die().shifted(float(start))
        paths = write_cam_tables(
            make_diagram(die), tmp_path, decimals=12, form="codesys", overwrite=True
        )
        lines = paths["die"].read_text().splitlines()
        assert lines[0].split()[1] == lines[-1].split()[1]


def test_a_dwell_at_half_a_digit_has_no_step(tmp_path: Path) -> None:
    """It stands at -825.625 mm up to the end of the turn, but for what a float rounds."""
    move = cm.Segment(from_deg=10.5, to_deg=104.5, from_mm=7.7, to_mm=-25.633, law="modified sine")
    dwell = cm.Segment(from_deg=104.5, to_deg=370.5, from_mm=-25.633, to_mm=-25.633)
    turret = cm.TimingDiagram([cm.Motion("turret", (move, dwell), stops=24)], 2000)
    path = write_cam_tables(turret, tmp_path, decimals=2)["turret"]
    stands = [line.split(";")[1] for line in path.read_text().splitlines()[110:]]
    assert len(set(stands)) == 1
    assert not read_cam_table(path).is_cycle


def test_the_last_digit_is_that_of_the_number(tmp_path: Path) -> None:
    """As exact arithmetic rounds it: 1.115 is a little less, and 100 times it is not."""
    for way in (1.115, 4.035, 8.325):
        die = cm.motion("die", cm.dwell(360), start_mm=way)
        diagram = cm.TimingDiagram([die], 2000)
        path = write_cam_tables(diagram, tmp_path, decimals=2, overwrite=True)["die"]
        exact = Decimal(way).quantize(Decimal("0.01"))
        assert {line.split(";")[1] for line in path.read_text().splitlines()[1:]} == {str(exact)}


def test_no_zero_has_a_sign(tmp_path: Path) -> None:
    still = cm.TimingDiagram([cm.motion("still", cm.dwell(360), start_mm=-1e-8)], 2000)
    path = write_cam_tables(still, tmp_path)["still"]
    assert "-" not in path.read_text()


@pytest.mark.parametrize(
    ("asked", "match"),
    [
        (
            {"step_deg": 7},
            r"^The step of a cam table is 7 deg, which does not divide 360 deg \(51\.4286 steps\): "
            r"give points=52 \(steps of 7\.05882 deg\) or points=53 \(steps of 6\.92308 deg\)\.$",
        ),
        ({"step_deg": 0.7}, "does not divide 360 deg"),
        ({"step_deg": 0}, "^The step of a cam table is 0 deg; it has to be"),
        ({"step_deg": True}, "^The step of a cam table has to be a number in deg, not True"),
        ({"step_deg": 1, "points": 361}, "^Both step_deg and points are given: give one"),
        ({"points": 7}, "^The number of points of a cam table is 7; it has to be"),
        ({"points": 360.5}, "^The number of points of a cam table is 360.5; it has to be a whole"),
        ({"decimals": -1}, "^The number of decimals is -1; it has to be"),
        ({"decimals": 2.5}, "^The number of decimals is 2.5; it has to be a whole number"),
        ({"decimals": "6"}, "^The number of decimals has to be a number, not '6'"),
        ({"form": "siemens"}, "^There is no form of a cam table 'siemens': use one of 'plain'"),
        ({"derivatives": "rad"}, "^There is no unit of the derivatives 'rad': use one of 'deg'"),
        ({"separator": "tab"}, "^There is no separator 'tab': use one of"),
        ({"decimal": ";"}, "^There is no decimal mark ';': use one of"),
        ({"separator": ",", "decimal": ","}, "^The comma cannot be both separator and decimal"),
        ({"form": "codesys", "derivatives": "deg"}, "^CODESYS reads a table of two columns"),
        ({"form": "codesys", "step_deg": 0.01}, "^A cam of CODESYS has at most 32767 points, and"),
    ],
    ids=str,
)
def test_what_no_controller_reads_is_refused(
    tmp_path: Path, asked: dict[str, object], match: str
) -> None:
    with pytest.raises(InputError, match=match):
        write_cam_tables(DIAGRAM, tmp_path, **asked)  # type: ignore[arg-type]
    assert not [*tmp_path.iterdir()]


def test_nothing_is_written_over_a_file(tmp_path: Path) -> None:
    (tmp_path / "die.csv").write_text("a week's work")
    for overwrite in (False, "no", 1):
        with pytest.raises(InputError, match=r"^The file die.csv is there already, and nothing "):
            write_cam_tables(DIAGRAM, tmp_path, overwrite=overwrite)  # type: ignore[arg-type]
    assert [path.name for path in tmp_path.iterdir()] == ["die.csv"]
    assert (tmp_path / "die.csv").read_text() == "a week's work"
    assert len(write_cam_tables(DIAGRAM, tmp_path, overwrite=True)) == 2


def test_all_files_are_written_or_none(tmp_path: Path) -> None:
    (tmp_path / "mill.csv").write_text("a week's work")
    (tmp_path / "die.csv").mkdir()
    with pytest.raises(InputError, match=r"^The file die.csv cannot be written \("):
        write_cam_tables(DIAGRAM, tmp_path, overwrite=True)
    assert (tmp_path / "mill.csv").read_text() == "a week's work"
    assert len([*tmp_path.iterdir()]) == 2


def test_what_was_replaced_comes_back_if_another_cannot_be(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As where a program has the second file open."""
    before = {path: path.read_bytes() for path in write_cam_tables(DIAGRAM, tmp_path).values()}
    first, _ = before
    first.write_bytes(b"")  # an empty file is a file, too
    before[first] = b""
    replace, done = Path.replace, list[Path]()

    def once(self: Path, target: Path) -> Path:
        if done:
            raise PermissionError(13, "Permission denied")
        done.append(target)
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", once)
    with pytest.raises(InputError, match=r"cannot be written \(Permission denied\)"):
        write_cam_tables(DIAGRAM, tmp_path, step_deg=10, overwrite=True)
    assert done
    assert {path: path.read_bytes() for path in tmp_path.iterdir()} == before


def test_a_folder_is_a_folder(tmp_path: Path) -> None:
    for folder in (tmp_path / "no", tmp_path / "die.csv"):
        with pytest.raises(InputError, match=r"^There is no folder '(no|die.csv)': make it, or"):
            write_cam_tables(DIAGRAM, folder)
    (tmp_path / "f.txt").touch()
    with pytest.raises(InputError, match=r"^'f\.txt' is a file: give a folder\.$"):
        write_cam_tables(DIAGRAM, tmp_path / "f.txt")
    with pytest.raises(InputError, match=r"^The path of the file is None"):
        write_cam_tables(DIAGRAM, None)  # type: ignore[arg-type]
    with pytest.raises(InputError, match=r"^The diagram is Motion.*: give a TimingDiagram"):
        write_cam_tables(make_mill(), tmp_path)  # type: ignore[arg-type]


def test_the_files_have_names_that_every_system_takes(tmp_path: Path) -> None:
    names = ["a/b", "a\\b", "..", "CON", "Aux.csv", "die", "DIE", "x" * 300, "x" * 299, "é\n", "?"]
    motions = [cm.motion(name, cm.dwell(360)) for name in names]
    paths = write_cam_tables(cm.TimingDiagram(motions, 2000), tmp_path, points=9)
    assert [path.name for path in paths.values()] == [
        *("a_b.csv", "a_b 2.csv", "_.csv", "_CON.csv", "_Aux.csv.csv", "die.csv", "DIE 2.csv"),
        *(f"{'x' * 60}.csv", f"{'x' * 60} 2.csv", "é.csv", "_ 2.csv"),
    ]
    assert len([*tmp_path.iterdir()]) == len(names)
