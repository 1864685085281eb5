"""Limits and fits against tables that others published, worked examples and brute force."""

import json
import math
import re
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import pytest
from matplotlib.text import Annotation

import cammotion as cm
from cammotion.hardware.iso_286 import GRADES, LOWER, STEPS_MM, UPPER

PUBLISHED = json.loads((Path(__file__).parent / "data" / "iso_286.json").read_text("utf-8"))
ISOFITS = PUBLISHED["isofits"]
COMPACT = ("pressfit", "rf-tolerance")
OURS: dict[str, tuple[int | None, ...]] = {**UPPER, **LOWER}
WRONG_IN_ISOFITS = {
    *{("E7", high) for high in (355, 400)},
    ("K6", 10),
    *{("f6", high) for high in (140, 160, 180)},
}
"""The cells of isofits 1.0 whose width is not that of their grade: f6 has -48 for -68."""


def step(diameter: float) -> int:
    return next(at for at, high in enumerate(STEPS_MM) if diameter <= high)


def width(zone: str, diameter: float) -> int:
    """Return the width of a zone's grade by the table that is not ours."""
    grade = "".join(filter(str.isdigit, zone))
    return int(PUBLISHED["rf-tolerance"]["grades"][grade][step(diameter)])


def confirmed(letter: str) -> list[int]:
    """Return the steps at which two of the three published tables have one deviation."""
    found = []
    for at, high in enumerate(STEPS_MM):
        values = [PUBLISHED[name]["deviations"].get(letter, [None] * 13) for name in COMPACT]
        said = [row[at] for row in values if at < len(row) and isinstance(row[at], int)]
        zone = next((zone for zone in ISOFITS if zone[:-1] == letter), "")
        for last, upper, lower in ISOFITS.get(zone, ()):
            if last == high and (zone, last) not in WRONG_IN_ISOFITS:
                said.append(upper if letter in UPPER else lower)
        if any(said.count(value) >= 2 for value in said):
            found.append(at)
    return found


@pytest.mark.parametrize("name", COMPACT)
def test_all_grades_are_those_of_two_published_tables(name: str) -> None:
    grades = PUBLISHED[name]["grades"]
    assert {int(grade): tuple(row) for grade, row in grades.items()} == GRADES


@pytest.mark.parametrize("letter", OURS)
def test_a_deviation_stands_here_exactly_where_two_published_tables_agree(letter: str) -> None:
    assert [at for at, value in enumerate(OURS[letter]) if value is not None] == confirmed(letter)
    for name in COMPACT:
        for ours, theirs in zip(
            OURS[letter], PUBLISHED[name]["deviations"].get(letter, ()), strict=False
        ):
            assert ours is None or ours == theirs, (name, letter)


@pytest.mark.parametrize("zone", [zone for zone in ISOFITS if zone[0] not in "EK"])
def test_the_limits_are_those_of_a_third_table_but_for_its_wrong_cells(zone: str) -> None:
    for high, upper, lower in ISOFITS[zone]:
        if high <= 6 and zone[0] == "G":
            continue  # not confirmed: the other table has 2
        ours = cm.limits_of(f"{high} {zone}")
        if (zone, high) in WRONG_IN_ISOFITS:
            assert (ours.upper_um, ours.lower_um) != (upper, lower)
        else:
            rounded = 0.5 if zone.startswith("js") else 0
            assert ours.upper_um == pytest.approx(upper, abs=rounded)
            assert ours.lower_um == pytest.approx(lower, abs=rounded)


def test_the_width_test_finds_exactly_the_wrong_cells_of_that_table() -> None:
    found = {
        (zone, high)
        for zone, cells in ISOFITS.items()
        for high, upper, lower in cells
        if abs(upper - lower - width(zone, high)) > (1 if zone.startswith("js") else 0)
    }
    assert found == WRONG_IN_ISOFITS


def test_every_zone_is_as_wide_as_its_grade() -> None:
    for letter in [*OURS, "js"]:
        for grade in GRADES:
            for at, high in enumerate(STEPS_MM):
                if OURS.get(letter, OURS["h"])[at] is not None:
                    zone = cm.limits_of(f"{high} {letter}{grade}")
                    assert zone.width_um == width(f"{letter}{grade}", high)


def test_holes_mirror_the_shafts_and_larger_parts_have_larger_numbers() -> None:
    for hole in "FGH":
        for lower, upper in zip(LOWER[hole], UPPER[hole.lower()], strict=True):
            assert lower is None or lower == -(upper or 0)
    for row in [*GRADES.values(), *OURS.values()]:
        sizes = [abs(value) for value in row if value is not None]
        assert all(one <= other for one, other in pairwise(sizes))


@pytest.mark.parametrize(
    ("asked", "upper", "lower"),
    [
        ("40 g6", -9, -25),
        ("20 H7", 21, 0),
        ("20 s6", 48, 35),
        ("50 H7", 25, 0),
        ("50 s6", 59, 43),
        ("40 js7", 12.5, -12.5),
        ("12 H9", 43, 0),
        ("40 k6", 18, 2),
        ("40 k8", 39, 0),
        ("315 f9", -56, -186),  # ISO 286-2:1988/Cor.1:2006; before it -185 was printed
    ],
)
def test_worked_examples_of_books_and_the_standard(asked: str, upper: float, lower: float) -> None:
    found = cm.limits_of(asked)
    assert (found.upper_um, found.lower_um) == (upper, lower)
    assert found.largest_mm == pytest.approx(found.diameter_mm + upper / 1000)
    assert found.smallest_mm == pytest.approx(found.diameter_mm + lower / 1000)


def test_steps_end_with_their_last_diameter() -> None:
    assert cm.size_step_mm(30) == (18, 30)
    assert cm.size_step_mm(30.001) == (30, 50)
    assert cm.limits_of("500 h11").lower_um == -400
    assert cm.limits_of(" 40.5 mm g 6 ") == cm.Limits(40.5, "g6", -9, -25)


def test_40_g6_by_the_formula_as_the_source_has_it() -> None:
    assert cm.mean_diameter_mm(40) == pytest.approx(38.73, abs=0.005)
    assert cm.tolerance_unit(40) == pytest.approx(1.56, abs=0.005)
    assert cm.grade_um(40, 6) == pytest.approx(15.6, abs=0.05)
    assert cm.deviation_um(40, "g") == pytest.approx(-8.7, abs=0.05)
    lower = cm.deviation_um(40, "g") - cm.grade_um(40, 6)
    assert lower == pytest.approx(-24.3, abs=0.05)
    assert round(lower) == -24  # and the table has -25: both parts were rounded first
    assert round(cm.deviation_um(40, "g")) - round(cm.grade_um(40, 6)) == -25


def test_the_formulas_are_those_of_the_standard() -> None:
    """ISO 286-1: grades in tolerance units, from 6 on five of them to a power of ten, rounded."""
    for grade, units in enumerate((7, 10, 16, 25, 40, 64, 100), 5):
        assert cm.grade_um(40, grade) == pytest.approx(units * cm.tolerance_unit(40), rel=1e-12)
    for formula in ("-16d0.44", "-11e0.41", "-5.5f0.41", "-2.5g0.34", "0h1", "5n0.34"):
        times, letter, power = re.split("([a-z])", formula)
        wanted = float(times) * math.sqrt(30 * 50) ** float(power)
        assert cm.deviation_um(40, letter) == pytest.approx(wanted, rel=1e-12)
    assert cm.deviation_um(40, "k") == pytest.approx(0.6 * math.cbrt(math.sqrt(30 * 50)), rel=1e-12)


def test_the_formulas_come_near_the_table_and_do_not_give_it() -> None:
    for grade, row in GRADES.items():
        for high, um in zip(STEPS_MM, row, strict=True):
            near = 0.15 if high == STEPS_MM[0] else 0.1
            assert cm.grade_um(high, grade) == pytest.approx(um, rel=near, abs=0.6)
    for letter in "defghkn":
        for high, listed in zip(STEPS_MM, OURS[letter], strict=True):
            assert cm.deviation_um(high, letter) == pytest.approx(listed, rel=0.05, abs=2.1)
    same = [
        round(cm.grade_um(high, grade)) == um
        for grade, row in GRADES.items()
        for high, um in zip(STEPS_MM, row, strict=True)
    ]
    assert 0.5 < sum(same) / len(same) < 0.8


@pytest.mark.parametrize("designation", ["40 H7/g6", "40 H7/k6", "40 H7/p6", "4 H7/p6", "8 H8/h9"])
def test_a_fit_by_trying_every_pair_of_parts(designation: str) -> None:
    fit = cm.Fit(designation)
    plays = [
        hole - shaft
        for hole in range(int(fit.hole.lower_um), int(fit.hole.upper_um) + 1)
        for shaft in range(int(fit.shaft.lower_um), int(fit.shaft.upper_um) + 1)
    ]
    assert (min(plays), max(plays)) == (fit.smallest_clearance_um, fit.largest_clearance_um)
    kinds = {
        "clearance": min(plays) >= 0,
        "interference": max(plays) <= 0,
        "transition": min(plays) < 0 < max(plays),
    }
    assert [kind for kind, holds in kinds.items() if holds] == [fit.kind]
    assert fit.summary.startswith(fit.kind)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ("600 g6", "diameter is 600 mm; .* at most 500 mm: give for example 40 mm"),
        ("0 g6", "diameter is 0 mm; .* above 0"),
        ("40 g4", "grade is 4; .* 5 to 11 here: give for example 7"),
        ("40 g12", "grade is 12; .* 5 to 11"),
        (
            "60 s6",
            "the letter s is confirmed here only for diameters up to 50 mm: give .* 50 mm",
        ),
        ("5 G7", "5 mm, and the letter G is confirmed here only for diameters over 6 up to 400 mm"),
        ("2 F7", "only for diameters over 3 up to 400 mm: give for example 6 mm"),
        ("450 F7", "only for diameters over 3 up to 400 mm: give for example 400 mm"),
        ("40 cd7", "zone with the letter 'cd': use one of 'd', 'e'"),  # another one than d
        ("40 t6", "no confirmed tolerance zone with the letter 't': use one of 'd', 'e'"),
        ("40 JS7", "letter 'JS': use one of 'F', 'G', 'H'"),  # js is a shaft
        ("40 K7", "letter 'K': use one of 'F', 'G', 'H'"),
        ("40 h7g", "not '40 h7g': give for example '40 g6'"),
        ("40,5 g6", r"not '40,5 g6': give it with a point for the comma, '40\.5 g6'"),
        ("g6", "by a diameter in mm, a letter and a grade, not 'g6': give for example '40 g6'"),
        ("40 H7/g6", "not '40 H7/g6': give for example '40 g6'"),
        ("-40 g6", "give for example '40 g6'"),
        ("", "give for example '40 g6'"),
        (40, "not 40: give for example '40 g6'"),
        (None, "not None"),
    ],
)
def test_what_cannot_be_confirmed_is_refused_in_words(asked: Any, words: str) -> None:
    with pytest.raises(cm.InputError, match=words):
        cm.limits_of(asked)


def test_limits_the_wrong_way_round_are_refused() -> None:
    with pytest.raises(cm.InputError, match=r"upper deviation is -25 µm and the lower one -9"):
        cm.Limits(40, "g6", upper_um=-25, lower_um=-9)
    assert cm.Limits(40, "g6", upper_um=-9, lower_um=-9).width_um == 0


@pytest.mark.parametrize("sign", "⌀Øø∅φΦϕ")
def test_the_sign_of_a_diameter_may_stand_before_it(sign: str) -> None:
    assert cm.Fit(f"{sign}40 H7/g6").summary == cm.Fit(f" {sign} 40 H7/g6").summary
    assert cm.limits_of(f"{sign}40 g6") == cm.limits_of("40 g6")


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ("25 g6/H7", "not '25 g6/H7': give it with the hole first, '25 H7/g6'"),
        ("40,5 H7/g6", r"give it with a point for the comma, '40\.5 H7/g6'"),
        ("40,5 g6 / H7", r"for the comma and with the hole first, '40\.5 H7/g6'"),
        ("40 H7/t6", "the letter 't': use one of 'd', 'e', 'f', 'g', 'h', 'js', 'k', 'm', 'n'"),
    ],
)
def test_how_a_fit_is_written_is_said(asked: str, words: str) -> None:
    with pytest.raises(cm.InputError, match=words):
        cm.Fit(asked)


@pytest.mark.parametrize(
    "asked",
    ["40 g6/H7", "40 jS6/H7", "40 t6/H7", "40 H7", "H7/g6", "40 H7/G6", 40, None, "40 H7/g6/"],
)
def test_what_is_no_fit_is_refused_in_words(asked: Any) -> None:
    with pytest.raises(cm.InputError, match=r"capital letter and a shaft .* '40 H7/g6'\.$"):
        cm.Fit(asked)


def test_bad_formulas_are_refused_in_words() -> None:
    for bad in (0, -1, math.nan, math.inf, 501, "forty", None, [40, 50]):
        with pytest.raises(cm.InputError, match=r"diameter .* for example 40 mm"):
            cm.tolerance_unit(bad)  # type: ignore[arg-type]
    with pytest.raises(cm.InputError, match="no formula here for the letter 'p': use one of 'd'"):
        cm.deviation_um(40, "p")
    with pytest.raises(cm.InputError, match="the letter 'G': did you mean 'g'"):  # of a hole
        cm.deviation_um(40, "G")
    for grade in (4, 12, 6.5, "7", True, None, [7]):
        with pytest.raises(cm.InputError, match="grades 5 to 11"):
            cm.grade_um(40, grade)  # type: ignore[arg-type]


def test_a_fit_is_drawn_to_scale() -> None:
    ax = cm.plot_fit([cm.Fit("40 H7/g6"), cm.Fit("40 H7/p6")])
    zones = [bar.get_extents().transformed(ax.transData.inverted()) for bar in ax.patches]
    ends = [(round(zone.y0, 6), round(zone.y1, 6)) for zone in zones]
    assert ends == [(0, 25), (-25, -9), (0, 25), (26, 42)]
    assert {"+25", "0", "-9", "-25", "50", "9", "-1", "-42"} <= {t.get_text() for t in ax.texts}
    words = [tick.get_text().replace("\n", " ") for tick in ax.get_xticklabels()]
    assert words == [
        "40 H7/g6 clearance, 9 to 50 µm",
        "40 H7/p6 interference, 1 to 42 µm",
    ]
    at = {text.get_text(): text.xyann for text in ax.texts if isinstance(text, Annotation)}
    assert (at["+25"], at["-25"]) == ((0, 3), (0, -3))
    beside = cm.plot_fit([cm.Fit("3 H5/g5"), cm.Fit("400 H11/d11")])  # flat, and its name is not
    at = {text.get_text(): text.xyann for text in beside.texts if isinstance(text, Annotation)}
    assert at["+360"] == (0, 3)
    assert [at["+4"][1], at["-6"][1]] == pytest.approx([10.6, -10.6], abs=0.3)
    figure, places = plt.subplots(2, 2, figsize=(7, 5))
    small = cm.plot_fit(cm.Fit("40 H11/h5"), ax=places[0, 0])
    figure.draw_without_rendering()
    below = next(text for text in small.texts if text.get_text() == "-11")
    assert below.get_window_extent().y0 >= small.get_window_extent().y0
    with pytest.raises(cm.InputError, match="no fit to draw"):
        cm.plot_fit([])
