"""Inertias, against published tables, integrals over small cells, and each other."""

import dataclasses
import math
import pickle
import re
from collections.abc import Callable
from typing import Any, cast

import numpy as np
import pytest

import cammotion as cm

STEEL = {"thickness_mm": 10, "density_kg_per_m3": 7800}


@pytest.mark.parametrize(
    ("diameter", "kg", "kg_cm2"), [(200, 2.45, 122.5), (250, 3.83, 299.1), (300, 5.51, 620.3)]
)
def test_a_makers_table_of_steel_discs(diameter: float, kg: float, kg_cm2: float) -> None:
    disc = cm.Disc(radius_mm=diameter / 2, **STEEL)
    assert round(disc.mass_kg, 2) == kg
    assert round(disc.inertia_kg_m2 * 1e4, 1) == kg_cm2


def test_the_makers_cross_counts_its_middle_twice() -> None:
    bar = cm.Cuboid(length_mm=300, width_mm=25, **STEEL)
    printed = 2 * bar.mass_kg, 2 * bar.inertia_kg_m2 * 1e4
    assert printed == pytest.approx((1.17, 88.4), abs=0.06)
    cross = cm.Cross(length_mm=300, width_mm=25, **STEEL)
    square = cm.Cuboid(length_mm=25, width_mm=25, **STEEL)
    assert cross.mass_kg == pytest.approx(2 * bar.mass_kg - square.mass_kg)
    assert cross.inertia_kg_m2 == pytest.approx(2 * bar.inertia_kg_m2 - square.inertia_kg_m2)
    assert round(cross.mass_kg, 3) == 1.121
    assert round(cross.inertia_kg_m2 * 1e4, 2) == 88.31


SHAPES: dict[str, tuple[Any, Callable[[Any, Any], Any]]] = {
    "disc": (cm.Disc(radius_mm=300, **STEEL), lambda x, y: np.hypot(x, y) <= 300),
    "ring": (
        cm.Ring(radius_mm=300, inner_mm=200, **STEEL),
        lambda x, y: (np.hypot(x, y) <= 300) & (np.hypot(x, y) >= 200),
    ),
    "bar": (
        cm.Cuboid(length_mm=600, width_mm=200, **STEEL),
        lambda x, y: (abs(x) <= 300) & (abs(y) <= 100),
    ),
    "cross": (
        cm.Cross(length_mm=600, width_mm=200, **STEEL),
        lambda x, y: (abs(x) <= 100) | (abs(y) <= 100),
    ),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_body_is_the_sum_of_its_cells(shape: str) -> None:
    part, is_inside = SHAPES[shape]
    side = np.arange(-299.75, 300, 0.5)
    x, y = np.meshgrid(side, side)
    cell = np.where(is_inside(x, y), 7800 * 0.01 * 0.0005**2, 0)
    assert part.mass_kg == pytest.approx(cell.sum(), rel=2e-3)
    inertia = (cell * (x**2 + y**2)).sum() / 1e6
    assert part.inertia_kg_m2 == pytest.approx(inertia, rel=3e-3)


def test_a_given_mass_and_the_same_mass_by_density_agree() -> None:
    for part, _ in SHAPES.values():
        sizes = {
            name: getattr(part, name)
            for name in ("radius_mm", "inner_mm", "length_mm", "width_mm")
            if hasattr(part, name)
        }
        same = type(part)(mass_kg=part.mass_kg, **sizes)
        assert same.inertia_kg_m2 == pytest.approx(part.inertia_kg_m2, rel=1e-14)


def test_masses_on_a_radius_carry_their_own_inertia() -> None:
    own = cm.Cuboid(length_mm=120, width_mm=80, mass_kg=20).inertia_kg_m2
    stations = cm.PointMasses(each_kg=20, radius_mm=450, count=8, own_kg_m2=own)
    assert stations.inertia_kg_m2 == pytest.approx(8 * (20 * 0.45**2 + 20 * 0.0208 / 12))


def example(station_kg: float = 20, divided_by: int = 1) -> cm.Rotor:
    return cm.Rotor(
        {
            "dial plate": cm.Disc(radius_mm=500, mass_kg=43.04),
            "stations": cm.PointMasses(each_kg=station_kg, radius_mm=450 / divided_by, count=8),
            "further parts": cm.PointMasses(each_kg=8, radius_mm=300 / divided_by),
        }
    )


def test_the_worked_example_to_its_printed_digits() -> None:
    table = example()
    assert f"{table.inertia_kg_m2:.3f}" == "38.500"
    assert f"{table.mass_kg:.2f}" == "211.04"
    assert f"{table.radius_of_gyration_mm:.3f}" == "427.118"
    assert table.gd2_N_m2(9.81) == pytest.approx(1510.74, abs=1e-9)
    assert table.gd2_N_m2() == pytest.approx(4 * 9.80665 * 38.5)


def test_two_ways_to_the_printed_739() -> None:
    """The print gives no reason; a rounded radius and a plate of 20 mm at 2740 kg/m3 both do."""
    assert f"{4 * 9.81 * 211.04 * 0.427118**2:.3f}" == "1510.739"
    plate = cm.Disc(radius_mm=500, thickness_mm=20, density_kg_per_m3=2740)
    assert f"{plate.mass_kg:.2f} {plate.inertia_kg_m2:.3f}" == "43.04 5.380"
    whole = cm.Rotor({**example().parts, "dial plate": plate})
    assert f"{whole.inertia_kg_m2:.3f} {whole.gd2_N_m2(9.81):.3f}" == "38.500 1510.739"


def test_its_misprints_do_not_lead_to_its_results() -> None:
    assert example(station_kg=15).mass_kg == pytest.approx(171.04)
    assert example(divided_by=2).inertia_kg_m2 == pytest.approx(5.38 + (32.4 + 0.72) / 4)


@pytest.mark.parametrize(
    "body",
    [
        cm.Disc(radius_mm=500, mass_kg=43.04),
        cm.Disc(radius_mm=500, thickness_mm=20, density_kg_per_m3=2740),
        cm.Ring(radius_mm=500, inner_mm=400, thickness_mm=20, density_kg_per_m3=2740),
        cm.Cuboid(length_mm=300, width_mm=100, thickness_mm=20, density_kg_per_m3=2740),
        cm.Cross(length_mm=300, width_mm=100, thickness_mm=20, density_kg_per_m3=2740),
    ],
)
def test_a_body_is_copied_and_read_back(body: Any) -> None:
    """One given by density had its mass beside it and was refused; the copy has its own mass."""
    assert eval(repr(body), vars(cm).copy()) == body  # noqa: S307 - its own text
    assert dataclasses.replace(body) == pickle.loads(pickle.dumps(body)) == body  # noqa: S301
    if body.thickness_mm is not None:
        thicker = dataclasses.replace(body, thickness_mm=60)
        assert thicker.mass_kg == pytest.approx(3 * body.mass_kg)
        assert thicker.inertia_kg_m2 == pytest.approx(3 * body.inertia_kg_m2)
        with pytest.raises(cm.InputError, match="weighed in one way"):
            dataclasses.replace(body, mass_kg=1)


def test_a_rotor_is_equal_by_its_parts_and_stays_as_it_is() -> None:
    """It had no hash, and its parts could be changed."""
    one, other = example(), cm.Rotor(dict(reversed([*example().parts.items()])))
    again = pickle.loads(pickle.dumps(one))  # noqa: S301
    assert one == other == dataclasses.replace(one) == again != example(station_kg=15)
    assert len({one, other, again, cm.Indexer(one, 8, 0.75).turns, example(station_kg=15)}) == 2
    with pytest.raises(TypeError):
        cast("dict[str, object]", one.parts)["plate"] = 1


def test_a_rotor_as_a_table() -> None:
    rows = str(example()).splitlines()
    assert re.split(r" {2,}", rows[1]) == ["dial plate", "43.040", "5.380"]
    assert re.split(r" {2,}", rows[-1]) == ["together", "211.040", "38.500"]


ANY: Any = cm  # what a learner may type, unseen by a type checker
BAD: list[tuple[Callable[[], object], str]] = [
    (lambda: ANY.Disc(radius_mm=500, mass_kg=-43), r"mass is -43 kg.*give for example 20 kg"),
    (lambda: ANY.Disc(radius_mm=0, mass_kg=43), r"radius is 0 mm.*for example 450 mm"),
    (lambda: ANY.Disc(radius_mm=math.nan, mass_kg=43), r"radius is nan mm"),
    (lambda: ANY.Disc(radius_mm=500), r"Disc is weighed in one way: give its mass_kg, or"),
    (lambda: ANY.Disc(radius_mm=500, mass_kg=1, density_kg_per_m3=7850), r"weighed in one way"),
    (lambda: ANY.Disc(radius_mm=500, thickness_mm=10), r"weighed in one way"),
    (lambda: ANY.Disc(radius_mm=500, mass_kg=1, thickness_mm=-3), r"weighed in one way"),
    (lambda: ANY.Disc(radius_mm=500, mass_kg=1, thickness_mm="abc"), r"weighed in one way"),
    (lambda: ANY.Disc(radius_mm=500, thickness_mm=-1, density_kg_per_m3=1), r"thickness is -1 mm"),
    (lambda: ANY.Disc(radius_mm=500, thickness_mm=1, density_kg_per_m3=0), r"density is 0 kg/m3"),
    (lambda: ANY.Ring(radius_mm=100, inner_mm=100, mass_kg=1), r"smaller, for example 50 mm"),
    (lambda: ANY.Ring(radius_mm=100, inner_mm=0, mass_kg=1), r"inner radius is 0 mm"),
    (lambda: ANY.Cuboid(length_mm="long", width_mm=1, mass_kg=1), r"length has to be a number"),
    (lambda: ANY.Cuboid(length_mm=10, width_mm=-1, mass_kg=1), r"width is -1 mm"),
    (lambda: ANY.Cross(length_mm=25, width_mm=300, mass_kg=1), r"width below the length.*2.5 mm"),
    (lambda: ANY.PointMasses(each_kg=-20, radius_mm=450), r"mass is -20 kg"),
    (lambda: ANY.PointMasses(each_kg=20, radius_mm=-450), r"radius is -450 mm"),
    (lambda: ANY.PointMasses(each_kg=20, radius_mm=450, count=7.5), r"7.5.*whole.*example 8"),
    (lambda: ANY.PointMasses(each_kg=20, radius_mm=450, count=0), r"number of masses is 0"),
    (lambda: ANY.PointMasses(each_kg=20, radius_mm=450, own_kg_m2=-1), r"inertia is -1 kg m2"),
    (lambda: ANY.OwnInertia(mass_kg=0, inertia_kg_m2=1), r"mass is 0 kg"),
    (lambda: ANY.OwnInertia(mass_kg=1, inertia_kg_m2=math.inf), r"inertia is inf kg m2"),
    (lambda: ANY.Rotor({}), r"The parts are \{\}: give each a name"),
    (lambda: ANY.Rotor([ANY.OwnInertia(mass_kg=1, inertia_kg_m2=1)]), r"give each a name"),
    (lambda: ANY.Rotor({"plate": "disc"}), r"part 'plate' is 'disc'.*kinds Disc, Ring.*give for"),
    (lambda: example().gd2_N_m2(-9.81), r"gravity is -9.81 m/s2.*9.81"),
]


@pytest.mark.parametrize(("make", "said"), BAD)
def test_what_makes_no_sense_is_refused_with_what_would_do(
    make: Callable[[], object], said: str
) -> None:
    with pytest.raises(cm.InputError, match=said):
        make()


@pytest.mark.parametrize("times", [1.0, 1e-3, 1e-6, 1e3])
def test_the_table_of_a_rotor_of_any_size_says_three_digits(times: float) -> None:
    """The dial of a watch has some 1e-9 kg m², and no 0.000."""
    ring = cm.OwnInertia(mass_kg=0.1 * times, inertia_kg_m2=4e-5 * times)
    rotor = cm.Rotor({"plate": cm.Disc(radius_mm=20, mass_kg=0.3 * times), "ring": ring})
    *_, together = (line.split() for line in str(rotor).splitlines())
    for said, total in zip(together[1:], (rotor.mass_kg, rotor.inertia_kg_m2), strict=True):
        assert float(said) == pytest.approx(total, rel=5.1e-3)
