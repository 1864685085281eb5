"""A cam as a file: what is in it, and what is not written."""

import csv
import re
from itertools import pairwise
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import dxfgrabber  # type: ignore[import-untyped]
import numpy as np
import pytest
from rolling import dense
from scipy.spatial import cKDTree

import cammotion as cm

DIE = cm.EXAMPLE.die
CAM = cm.RollerCam(DIE, cm.TranslatingRoller(10), prime_radius_mm=160)
FACE = cm.FlatFacedCam(DIE, base_radius_mm=300)
LAYERS = {"PROFILE", "PITCH_CURVE", "FOLLOWER", "CENTRE", "ZERO_MARK", "ROTATION", "BORE"}


def entities(path: Path) -> dict[str, list[Any]]:
    """Return the entities of a DXF by their layers, as another program reads them."""
    drawing = dxfgrabber.readfile(str(path))
    assert drawing.header["$INSUNITS"] == 4  # mm
    found: dict[str, list[Any]] = {}
    for entity in drawing.entities:
        found.setdefault(entity.layer, []).append(entity)
    return found


def test_a_dxf_has_its_layers_and_keyway(tmp_path: Path) -> None:
    path = cm.write_cam(CAM, tmp_path / "die.dxf", groove=True, bore_mm=20, keyway_mm=(6, 2.8))
    found = entities(path)
    assert {*found} == LAYERS
    assert len(found["PROFILE"]) == 2
    (bore,) = found["BORE"]
    corners = zip(bore.points, bore.bulge, strict=True)
    line = dense([(x, y, bulge) for (x, y, *_), bulge in corners])
    assert line.imag.max() == pytest.approx(12.8)
    assert line.imag.min() == pytest.approx(-10, abs=1e-5)
    around = line[np.abs(line) < 10 + 1e-6]
    assert np.abs(around) == pytest.approx(10)
    (roller,) = found["FOLLOWER"]
    assert [x for x, *_ in roller.points] == pytest.approx([10, -10])
    assert [y for _, y, *_ in roller.points] == pytest.approx([160, 160])


def test_a_keyway_has_to_leave_the_cam_whole(tmp_path: Path) -> None:
    """Its corners reach farthest: from the axis to the top of the keyway and half its width."""
    least = np.hypot(*CAM.profile_mm(np.arange(0, 360, 0.1)).T).min()
    bore, width = 2 * (least - 4), 12.0
    height = np.sqrt(least**2 - (width / 2) ** 2) - bore / 2
    path = tmp_path / "whole.dxf"
    assert cm.write_cam(CAM, path, bore_mm=bore, keyway_mm=(width, height - 0.01)) == path
    with pytest.raises(
        cm.InputError, match=f"reach {np.hypot(bore / 2 + height + 0.01, 6):.4g} mm"
    ):
        cm.write_cam(CAM, tmp_path / "cut.dxf", bore_mm=bore, keyway_mm=(width, height + 0.01))


def test_the_cam_turns_the_way_that_its_arrow_says(tmp_path: Path) -> None:
    """The points that come under the follower later lie on the left: the cam turns clockwise."""
    found = entities(cm.write_cam(CAM, tmp_path / "die.dxf"))
    arrow = next(entity for entity in found["ROTATION"] if any(entity.bulge))
    assert arrow.points[0][0] < 0 < arrow.points[1][0]
    assert arrow.bulge[0] < 0
    assert CAM.profile_mm(90)[0] < -100


def test_an_svg_is_on_a_scale_of_one_to_one(tmp_path: Path) -> None:
    path = cm.write_cam(CAM, tmp_path / "die.svg")
    drawing = ElementTree.parse(path).getroot()  # noqa: S314 - our own
    width = float(drawing.attrib["width"].removesuffix("mm"))
    box = [float(number) for number in drawing.attrib["viewBox"].split()]
    assert box == pytest.approx([-width / 2, -width / 2, width, width], rel=1e-5)
    (profile,) = [path for path in drawing.iter() if path.get("class") == "PROFILE"]
    corner = r"[A-Z] (?:[\d.-]+ [\d.-]+ 0 [01] [01] )?([\d.-]+) ([\d.-]+)"
    ends = re.findall(corner, profile.attrib["d"])
    reached = np.array(ends, dtype=float)
    near = np.abs(reached[:, None] - CAM.profile_mm(np.arange(0, 360, 0.01))).max(axis=2)
    assert near.min(axis=1).max() < 0.02
    paths = [path.attrib["d"] for path in drawing.iter() if path.get("class")]
    corners = [re.findall(corner, path) for path in paths]
    is_open = [not path.endswith("Z") for path in paths]
    assert is_open == [ends[0] != ends[-1] for ends in corners]
    assert any(is_open)


@pytest.mark.parametrize("name", ["cam.csv", "cam.txt"])
def test_a_table_keeps_its_tolerance(name: str, tmp_path: Path) -> None:
    path = cm.write_cam(CAM, tmp_path / name, tolerance_mm=0.01)
    separator = "," if name.endswith("csv") else "\t"
    heading, *rows = csv.reader(path.read_text("utf-8").splitlines(), delimiter=separator)
    assert heading[:3] == ["cam angle in deg", "x in mm", "y in mm"]
    table = np.array(rows, dtype=float)
    assert max(len(cell.partition(".")[2]) for row in rows for cell in row) == 6
    assert np.all(np.diff(table[:, 0]) > 0)
    assert table[:, 1:3] == pytest.approx(CAM.profile_mm(table[:, 0]), abs=5e-6)
    ends = np.append(table[:, 0], 360)
    for start, end in pairwise(ends):
        along = CAM.profile_mm(np.linspace(start, end, 21))
        chord = (along[-1] - along[0]) @ [1, 1j]
        off = ((along - along[0]) @ [1, 1j] * np.conj(chord)).imag / abs(chord)
        assert np.abs(off).max() < 0.01


def test_the_outline_of_a_law_from_points_keeps_its_tolerance(tmp_path: Path) -> None:
    """The profile bends otherwise from each knot on."""
    places = np.linspace(0, 1, 12)
    law = cm.law_from_points(places, places**2 * (3 - 2 * places))
    up, down = (make(30, over_deg=100, law=law) for make in (cm.rise, cm.return_))
    motion = cm.motion("points", up, cm.dwell(60), down, cm.dwell(100))
    cam = cm.RollerCam(motion, cm.TranslatingRoller(5), prime_radius_mm=60)
    found = entities(cm.write_cam(cam, tmp_path / "points.dxf", tolerance_mm=0.01, undercut=True))
    (profile,) = found["PROFILE"]
    corners = zip(profile.points, profile.bulge, strict=True)
    line = dense([(x, y, bulge) for (x, y, *_), bulge in corners], step_mm=0.002)
    points = np.column_stack([line.real, line.imag])
    off, _ = cKDTree(points).query(cam.profile_mm(np.arange(0, 360, 0.05)))
    assert off.max() < 0.01 + 1e-4


def test_nothing_is_written_for_a_cam_that_cannot_be_made(tmp_path: Path) -> None:
    cut = cm.RollerCam(DIE, cm.TranslatingRoller(14), prime_radius_mm=15)
    path = tmp_path / "cut.dxf"
    with pytest.raises(cm.InputError, match=r"undercut from 194\.06 to 197\.64 deg") as said:
        cm.write_cam(cut, path)
    (least,) = re.findall(r"a prime circle of at least ([\d.]+) mm", str(said.value))
    enough = cm.RollerCam(DIE, cm.TranslatingRoller(14), float(least))
    assert enough.undercuts == ()
    with pytest.raises(cm.InputError, match="Give a larger prime circle, or a smaller roller"):
        cm.write_cam(cut, path, groove=True)  # whose far flank may need more
    assert not path.exists()
    assert cm.write_cam(cut, path, undercut=True).exists()
    hollow = cm.RollerCam(DIE, cm.TranslatingRoller(14), prime_radius_mm=40)
    assert hollow.undercuts == ()
    assert cm.write_cam(hollow, tmp_path / "open.dxf").exists()
    with pytest.raises(cm.InputError, match="far flank"):
        cm.write_cam(hollow, tmp_path / "groove.dxf", groove=True)
    face = cm.FlatFacedCam(DIE, base_radius_mm=100)
    with pytest.raises(cm.InputError, match="undercut from") as said:
        cm.write_cam(face, tmp_path / "face.csv")
    (least,) = re.findall(r"a base circle of at least ([\d.]+) mm", str(said.value))
    assert cm.write_cam(cm.FlatFacedCam(DIE, float(least)), tmp_path / "face.csv").exists()


def test_where_no_prime_circle_would_do_nothing_is_written_either(tmp_path: Path) -> None:
    arm = cm.SwingingRoller(14, arm_mm=60, pivot_mm=65)
    with pytest.raises(cm.InputError, match=r"Nothing was written: .* a larger prime circle"):
        cm.write_cam(cm.RollerCam(DIE, arm, 16), tmp_path / "arm.dxf")


def test_no_file_is_lost(tmp_path: Path) -> None:
    path = tmp_path / "die.svg"
    path.write_text("mine")
    with pytest.raises(cm.InputError, match="is there already"):
        cm.write_cam(CAM, path)
    assert path.read_text() == "mine"
    assert cm.write_cam(CAM, path, overwrite=True).read_text() != "mine"


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"path": "cam.step"}, "let its name end in .dxf, .svg, .csv or .txt"),
        ({"path": 3}, "is given path=3: give a text in quotes or a Path"),
        ({"path": "cam.dxf", "cam": DIE}, "give a RollerCam or a FlatFacedCam"),
        ({"path": "cam.dxf", "tolerance_mm": 0}, "tolerance of the outline is 0 mm"),
        ({"path": "cam.dxf", "bore_mm": 320}, "give a smaller bore"),
        ({"path": "cam.dxf", "cam": FACE, "groove": True}, "has a flat face, which runs in none"),
        ({"path": "cam.csv", "groove": True}, "A .csv lists the profile and the pitch curve, and"),
        ({"path": "cam.csv", "keyway_mm": (6, 3)}, "leave groove, bore_mm and keyway_mm out"),
        ({"path": "cam.txt", "bore_mm": 20}, "let the name end in .dxf or .svg"),
        ({"path": "cam.dxf", "bore_mm": 20, "keyway_mm": (20, 3)}, "give a narrower one"),
        ({"path": "cam.dxf", "bore_mm": 20, "keyway_mm": (6, -1)}, "keyway is -1 mm"),
    ],
)
def test_bad_wishes(arguments: dict[str, Any], said: str, tmp_path: Path) -> None:
    path = arguments.pop("path")
    with pytest.raises(cm.InputError, match=re.escape(said)):
        cm.write_cam(**{"cam": CAM} | arguments, path=path if path == 3 else tmp_path / path)


def test_a_keyway_needs_a_bore(tmp_path: Path) -> None:
    path = tmp_path / "die.svg"
    with pytest.raises(cm.InputError, match=r"keyway is \(6, 3\).* give bore_mm"):
        cm.write_cam(CAM, path, keyway_mm=(6, 3))
    assert not path.exists()


def test_a_layer_has_one_colour_in_both_drawings(tmp_path: Path) -> None:
    """AutoCAD counts its colours: 1 is red, 3 green, 5 blue, 7 black on white and 8 grey."""
    counted = {1: "red", 3: "green", 5: "blue", 7: "black", 8: "gray"}
    svg = cm.write_cam(CAM, tmp_path / "die.svg", bore_mm=20)
    dxf = cm.write_cam(CAM, tmp_path / "die.dxf", bore_mm=20)
    drawn = {
        line.get("class"): line.get("stroke")
        for line in ElementTree.parse(svg).iter("{http://www.w3.org/2000/svg}path")  # noqa: S314
    }
    layers = {layer.name: counted[layer.color] for layer in dxfgrabber.readfile(str(dxf)).layers}
    assert {name: layers[name] for name in LAYERS} == drawn
